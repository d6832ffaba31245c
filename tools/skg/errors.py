"""The one exception that a user of the tools ever meets."""

from __future__ import annotations

import errno
from typing import TYPE_CHECKING

from skg.messages.finding import Finding, Phrase

if TYPE_CHECKING:
    from skg.messages.render import Speech


#: Errors of the system that have a sentence of their own: their numbers, their codes.
_OF_SYSTEM = {
    errno.ENOENT: "system-no-file",
    errno.EACCES: "system-no-permission",
    errno.EISDIR: "system-is-folder",
    errno.ENOTDIR: "system-no-folder",
    errno.ENOSPC: "system-full",
    errno.EROFS: "system-read-only",
    errno.EIO: "system-input-output",
    errno.EBUSY: "system-busy",
    errno.ENAMETOOLONG: "system-long-name",
    errno.EADDRINUSE: "system-port-taken",
    errno.EFBIG: "system-too-large",
    errno.EPERM: "system-not-permitted",
    errno.ELOOP: "system-links",
    errno.ENXIO: "system-no-address",
    errno.ENODEV: "system-no-device",
    errno.ECONNREFUSED: "system-refused",
    errno.EINVAL: "system-invalid",
}


def of_system(error: OSError) -> Finding:
    """An error of the system."""
    number = error.errno or 0
    if code := _OF_SYSTEM.get(number):
        return Finding(code)
    name = errno.errorcode.get(number, type(error).__name__)
    return Finding("system", error=name, detail=error.strerror or str(error) or name)


def of_library(error: Exception) -> Finding:
    """An error of a library: its kind, and its own words, which are English."""
    name, detail = type(error).__name__, " ".join(str(error).split())
    return Finding("library-error", error=name, detail=detail) if detail else Finding("plain", text=name)


class UserError(Exception):
    """An error in the user's input: a finding. The command line prints it in one line and exits with 2."""

    def __init__(self, finding: Finding) -> None:
        super().__init__(finding)
        self.finding = finding
        #: The language and the medium of its text, where they are not the process's.
        self.audience: Speech | None = None

    def __str__(self) -> str:
        from skg.messages.render import line

        return line(self.finding, self.audience)

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
