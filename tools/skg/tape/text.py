"""The text of 3B tapes: strict reading, and writing."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from io import BytesIO

from skg.files import read_bytes, without_filling
from skg.messages.finding import Finding, Phrase
from skg.messages.render import data, text
from skg.tape.block import CODES, MAX_DIGITS, Block, Stop, Tape
from skg.tape.block_list import Blocks
from skg.tape.positions import WITHOUT_DRIFT
from skg.tape.styles import read_any, to_style

#: From so many blocks on it takes less time to load numpy than to look at them one by one.
_MANY = 20_000
#: The code of a line end that is let pass where a tape is read.
BARE_LF = "bare-lf"
_DIGITS = rf"(0|[1-9]\d{{0,{MAX_DIGITS - 1}}})"
_BLOCK = re.compile(rf"B{_DIGITS}B{_DIGITS}B{_DIGITS}G([XY])({'|'.join(CODES)})", re.ASCII)
#: The same with its line's end, as the punch makes all of them.
_LINE = re.compile(rf"{_BLOCK.pattern}\r\n", re.ASCII)
#: The parts of a block: what is read, what a message expects, and the name of a number.
_PARTS: tuple[tuple[str, str | Phrase, str], ...] = (
    *(part for name in ("x", "y", "J") for part in (("B", "B", ""), ("[0-9]+", Phrase("digits-of", name=name), name))),
    ("G", "G", ""),
    ("[XY]", Phrase("x-or-y"), ""),
    ("|".join(CODES), Phrase("codes-of-blocks"), ""),
)


@dataclass(frozen=True)
class TapeFault:
    """Something wrong on a tape: block number (from 1), column (from 1) and what."""

    block: int
    column: int
    why: Finding

    @property
    def finding(self) -> Finding:
        """The finding with its place."""
        return self.why.within(Phrase("at-block", block=self.block, column=self.column))

    def plain(self) -> dict[str, object]:
        """The fault for other programs."""
        known = data(self.why)
        return {"block": self.block, "column": self.column, "message": text(self.why)} | {
            name: known[name] for name in ("code", "values")
        }


def _values(block: re.Match[str]) -> tuple[int, int, int, str, str]:
    """x, y, J, count direction and code of a block that was matched."""
    x, y, j, axis, code = block.groups()
    return int(x), int(y), int(j), axis, code


def _first_fault(text: str) -> tuple[int, Finding]:
    """The first thing that does not fit in a text that is no block: its index, and what was expected."""
    index = 0
    for pattern, expected, name in _PARTS:
        part = re.compile(pattern).match(text, index)
        if not part:
            return index, Finding("expected-found", expected=expected, found=_quoted(text, index))
        if name and len(part[0]) > MAX_DIGITS:
            return index, Finding("too-many-digits", name=name, digits=len(part[0]), most=MAX_DIGITS)
        if name and part[0][0] == "0" and len(part[0]) > 1:
            return index, Finding("leading-zeros", name=name)
        index = part.end()
    return index, Finding("expected-found", expected=Phrase("end-of-block"), found=_quoted(text, index))


def _quoted(text: str, index: int) -> str | Phrase:
    """Quote the text at a place, for a message."""
    if index >= len(text):
        return Phrase("end-of-line")
    return repr(text[index]) if text[index].isprintable() else Phrase("byte", byte=ord(text[index]))


class _Reading:
    """A tape that is read line by line; blocks whose text cannot be read are left out."""

    def __init__(self) -> None:
        self.blocks, self.stops = Blocks(), list[Stop]()
        self.findings: list[TapeFault] = []
        # Of the last block; whether DD was there; at which block a line ends with LF alone (0: none does).
        self.number, self.ended, self.bare = 0, False, 0

    def take(self, text: str) -> None:
        """A line and its end."""
        if not self.ended and (block := _LINE.fullmatch(text)):
            self.number += 1
            self.blocks.add(*_values(block), self.number)
            return
        whole, text = text.endswith("\n"), text.removesuffix("\n")
        if not whole and not text.strip("\0"):
            return
        line = text.removesuffix("\r")
        if self.ended:
            self._behind(line.strip("\0"))
            return
        if line == text and not self.bare:
            self.bare = self.number + 1
        if not whole:
            self._find(
                self.number + 1, len(line), Finding("expected-found", expected="CR LF", found=Phrase("end-of-tape"))
            )
        if line == "D":
            self.stops.append(Stop(len(self.blocks)))
        elif line == "DD":
            self.ended = True
        else:
            self._block(line)

    def _block(self, line: str) -> None:
        """A block that is not as the punch makes it."""
        self.number += 1
        if block := _BLOCK.fullmatch(line):
            self.blocks.add(*_values(block), self.number)
        else:
            self._find(self.number, *_first_fault(line))

    def _behind(self, rest: str) -> None:
        """Report text behind DD."""
        if rest:
            self._find(self.number, 0, Finding("nothing-after", end="DD", found=_quoted(rest, 0)))

    def end(self) -> None:
        """No more lines."""
        if self.bare:
            self._find(self.bare, 0, Finding(BARE_LF))
        if not self.ended:
            self._find(self.number + 1, 0, Finding("expected-found", expected="DD", found=Phrase("end-of-tape")))

    def _find(self, block: int, index: int, why: Finding) -> None:
        self.findings.append(TapeFault(block, index + 1, why))


def scan(data: bytes, name: str = "-", positions: str = "auto") -> tuple[Tape, list[TapeFault]]:
    """Read a whole tape and everything that is wrong with it.

    Blocks whose text cannot be read are left out of the tape; blocks that can be read but cannot be right
    (see `Block.problems`, which goes by `positions`) are in it. NULs before the first block and after `DD` are blank
    tape, ctrl-Zs at the end CP/M's.
    """
    reading = _Reading()
    for raw in BytesIO(without_filling(data).lstrip(b"\0")):
        reading.take(raw.decode("latin-1"))
    reading.end()
    tape = Tape(name, reading.blocks, tuple(reading.stops))
    # (of a block there is either this or what could not be read)
    wrong = [
        TapeFault(block.number, 1, why) for block in _doubtful(tape, positions) for why in block.problems(positions)
    ]
    if why := odd_stops(tape):
        wrong.append(TapeFault(why["number"], 1, why))
    return tape, sorted(wrong + reading.findings, key=lambda finding: (finding.block, finding.column))


def odd_stops(tape: Tape) -> Finding | None:
    """The reason why a drive's wire, which each stop turns off or on, is off where a tape cuts: the first block of the
    kind; else None.

    What stands between the 1st stop and the 2nd, the 3rd and the 4th, …, or behind the last of an odd number, is no
    re-positioning, which is at most one straight move. A run that was broken off leaves such a tape, when another one
    goes on behind it.
    """
    for count, (first, last) in enumerate(tape.bounds):
        if count % 2 and (last - first > 1 or last > first and not tape.blocks[first].is_line):
            return Finding("odd-stops", count=count, number=tape.blocks[first].number)
    return None


def _doubtful(tape: Tape, positions: str) -> Iterable[Block]:
    """The blocks of a tape but for those of which one can tell quickly, all at once, that nothing is wrong."""
    if len(tape.blocks) < _MANY or positions == "machine":
        return tape.blocks
    import numpy as np

    from skg.tape.columns import columns_of

    is_sound = np.concatenate([columns.is_plainly_sound for _, columns in columns_of(tape).shares()])
    return [tape.blocks[index] for index in np.flatnonzero(~is_sound)]


def parse(data: bytes, name: str = "-") -> Tape:
    """Return the tape in `data`, in the punch's own style or another one (see `skg.tape.styles`), or raise `UserError`
    with the first thing that is wrong.

    Line ends of LF alone are let pass here (an editor may have made them); `skg check` reports them.
    """
    tape, findings = scan(data, name)
    return read_any(data, name) if any(fault.why.code != BARE_LF for fault in findings) else tape


def read(path: str) -> Tape:
    """Read a tape from a file or, for `-`, the standard input; raises as `parse` does.

    One whose name ends in `WITHOUT_DRIFT` is without drift.
    """
    tape = parse(read_bytes(path), path)
    return replace(tape, drift=False, drift_by=Phrase("its-name")) if path.lower().endswith(WITHOUT_DRIFT) else tape


def to_bytes(items: Iterable[Block | Stop]) -> bytes:
    """Return the bytes that the punch makes of blocks and stops, `DD` included.

    A number of more than 8 digits does not fit: `UserError`.
    """
    return to_style(items, "punch")
