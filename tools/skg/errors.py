"""The one exception that a user of the tools ever meets."""


class UserError(Exception):
    """An error in the user's input, in one line with its place; the command line prints it and exits with 2.

    `contour`: the number (from 0) of the contour, among those that were read, that it is about; `place`: where, mm.
    """

    def __init__(self, message: str, contour: int | None = None, place: tuple[float, float] | None = None) -> None:
        super().__init__(message)
        self.contour = contour
        self.place = place
