"""The one exception that a user of the tools ever meets."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skg.messages.finding import Finding, Phrase

if TYPE_CHECKING:
    from skg.messages.render import Speech


class UserError(Exception):
    """An error in the user's input: a finding. The command line prints it in one line and exits with 2."""

    def __init__(self, finding: Finding) -> None:
        super().__init__(finding)
        self.finding = finding
        #: The language and the medium of its text, where they are not the process's.
        self.way: Speech | None = None

    def __str__(self) -> str:
        from skg.messages.render import line

        return line(self.finding, self.way)

    @property
    def contour(self) -> int | None:
        """The number (from 0) of the contour, among those that were read, that it is about."""
        return self.finding.contour

    @property
    def place(self) -> tuple[float, float] | None:
        """The place that it is about, mm."""
        return self.finding.place

    def within(self, *source: str | Phrase) -> UserError:
        """The same error, in a file or a part of one."""
        self.finding = self.finding.within(*source)
        return self
