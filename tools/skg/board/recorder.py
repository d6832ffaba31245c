"""The file of a tape that is being punched: NAME.part until all of the tape is there, and NAME then."""

from __future__ import annotations

import os
import re
from pathlib import Path
from types import TracebackType

from skg.errors import UserError, of_system
from skg.files import hold, is_held, part_of, write_bytes
from skg.messages.finding import Finding
from skg.tape.text import scan
from skg.terminal import remark

#: A block on the paper: its number, and the block as it is punched.
_LISTED = re.compile(rb"(\d{4}) (B\d+B\d+B\d+G[XY](?:L|NR|SR)[1-4])")
#: A block of the ROM that mills.
_MILLED = re.compile(rb"N(\d+)((?:[GXYZIJPFSTM]-?\d*\.?\d+)+)")
#: A line of a program that SAVE punches, which ends with ctrl-Z.
_SAVED = re.compile(rb"\d{1,4} ")
#: The number of a block behind which comes number 1 again.
_LAST_NUMBER = 9999


class Listing:
    """The blocks that the paper lists as they are punched, by which it is seen whether any got lost."""

    def __init__(self) -> None:
        self.blocks: list[bytes] = []
        self._number = 0
        self.is_broken = False

    def take(self, paper_line: bytes) -> None:
        """Take a line of the paper."""
        if not (listed := _LISTED.fullmatch(paper_line)):
            return
        number = int(listed[1])
        self.is_broken |= number != (self._number % _LAST_NUMBER + 1 if self.blocks else 1)
        self._number = number
        self.blocks.append(listed[2])


def wrong_with(data: bytes, listing: Listing) -> Finding | None:
    """The reason why what was punched is no whole tape, or not the one that the paper lists; None: it is."""
    data = data.strip(b"\0")
    if data.endswith(b"\x1a") and all(map(_SAVED.match, data.replace(b"\0", b"").splitlines()[:-1])):
        return None
    if data.startswith(b"N"):
        return _wrong_with_milling(data)
    _, faults = scan(data)
    if faults:
        return Finding("tape-not-whole", number=faults[0].block, why=faults[0].why)
    blocks = [each for each in data.split(b"\r\n") if each.startswith(b"B")]
    if listing.is_broken or listing.blocks and listing.blocks != blocks:
        return Finding("tape-not-listed", count=len(blocks), listed=len(listing.blocks))
    return None


def _wrong_with_milling(data: bytes) -> Finding | None:
    *blocks, end = data.split(b"\r\n")
    for at, block in enumerate(blocks):
        parts = _MILLED.fullmatch(block)
        if not parts or int(parts[1]) != at % _LAST_NUMBER + 1:
            return Finding("tape-not-in-order", number=at + 1, found=block.decode("ascii", "replace"))
    if end or not blocks or not blocks[-1].endswith(b"M30"):
        return Finding("tape-no-end", end="M30")
    return None


class Recorder:
    """Writes what is punched to `NAME.part`, and gives it its name at the end, by `finish`; else it stays so, and that
    is said. What is no plain file, a printer for one, gets it as it comes."""

    def __init__(self, name: str) -> None:
        self.name = name
        target = Path(os.path.realpath(name))
        self._is_plain = not target.exists() or target.is_file()
        self._path = Path(part_of(name)) if self._is_plain else target
        try:
            if self._is_plain:
                if self._path.is_file() and is_held(self._path):
                    raise UserError(Finding("being-recorded").within(str(self._path)))
                # (an older part goes by its name alone: it may be a link to something else)
                self._path.unlink(missing_ok=True)
            self._file = self._path.open("w+b" if self._is_plain else "wb", buffering=0)
            hold(self._file.fileno())
        except OSError as error:
            raise UserError(of_system(error).within(str(self._path))) from None
        self._is_open = True

    def __enter__(self) -> Recorder:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._is_open:
            self._leave(Finding("tape-broken-off"))

    def write(self, data: bytes) -> None:
        """Write bytes that were punched."""
        try:
            self._file.write(data)
        except OSError as error:
            raise UserError(of_system(error).within(self.name)) from None

    def finish(self, listing: Listing, is_doubtful: bool) -> bool:
        """Tell whether the tape is whole: it has its name then. `is_doubtful`: something of it may be lost."""
        if not self._is_plain:
            self._file.close()
            self._is_open = False
            return True
        self._file.seek(0)
        data = self._file.readall()
        why = Finding("tape-doubtful") if is_doubtful else wrong_with(data, listing)
        if why or not data:
            self._leave(why or Finding("tape-broken-off"))
            return not data
        try:
            os.fsync(self._file.fileno())
            self._file.close()
            self._is_open = False
            target = Path(self.name)
            if target.exists() and target.stat().st_nlink > 1:
                write_bytes(self.name, data)
                self._path.unlink()
            else:
                self._path.replace(os.path.realpath(self.name))
        except OSError as error:
            finding = Finding("tape-not-named", why=of_system(error), part=str(self._path))
            raise UserError(finding.within(self.name)) from None
        return True

    def _leave(self, why: Finding) -> None:
        """Keep a part of a tape as it is; where there is none, no file."""
        is_empty = self._is_plain and not self._path.stat().st_size
        self._file.close()
        self._is_open = False
        if is_empty:
            self._path.unlink()
        elif self._is_plain:
            remark(why.within(str(self._path)), "skg term")
