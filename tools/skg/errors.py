"""The one exception that a user of the tools ever meets."""


class UserError(Exception):
    """What is wrong and where, in one line; the command line prints it and exits with 2."""
