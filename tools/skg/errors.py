"""The one exception that a user of the tools ever meets."""


class UserError(Exception):
    """An error in the user's input, in one line with its place; the command line prints it and exits with 2."""
