"""Why a part of a drawing cannot be read, whoever found it: this package, or a library that reads for it."""

from __future__ import annotations

from skg.errors import of_library
from skg.messages.finding import Phrase


class Unread(ValueError):
    """A part of a drawing that is not as it must be; `what`: the part, or what is wrong with it."""

    def __init__(self, what: Phrase) -> None:
        super().__init__(what)
        self.what = what


def what_of(error: Exception) -> Phrase:
    """The part that cannot be read, or what a library says of it."""
    return error.what if isinstance(error, Unread) else of_library(error)


def reason_of(error: Exception) -> Phrase:
    """The reason why an entity or an element is left that cannot be read."""
    if isinstance(error, OverflowError):
        return Phrase("reason-too-large")
    return Phrase("reason-unread", what=what_of(error))
