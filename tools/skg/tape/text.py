"""The text of 3B tapes: strict reading, and writing."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from io import BytesIO

from skg.errors import UserError
from skg.files import read_bytes, without_filling
from skg.tape.block import CODES, MAX_DIGITS, Block, Stop, Tape
from skg.tape.block_list import Blocks
from skg.tape.positions import WITHOUT_DRIFT
from skg.tape.styles import read_any, to_style

#: From so many blocks on it takes less time to load numpy than to look at them one by one.
_MANY = 20_000
_DIGITS = rf"(0|[1-9]\d{{0,{MAX_DIGITS - 1}}})"
_BLOCK = re.compile(rf"B{_DIGITS}B{_DIGITS}B{_DIGITS}G([XY])({'|'.join(CODES)})", re.ASCII)
#: The same with its line's end, as the punch makes all of them.
_LINE = re.compile(rf"{_BLOCK.pattern}\r\n", re.ASCII)


@dataclass(frozen=True)
class Finding:
    """Something wrong on a tape: block number (from 1), column (from 1) and what was expected."""

    block: int
    column: int
    message: str

    def __str__(self) -> str:
        return f"block {self.block}, column {self.column}: {self.message}"


class _Scanner:
    """Reads one block's text from left to right; the first thing that does not fit raises `_Unexpected`."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.index = 0

    def take(self, *words: str, expected: str = "") -> str:
        """Take whichever of `words` stands here."""
        for word in words:
            if self.text.startswith(word, self.index):
                self.index += len(word)
                return word
        raise _Unexpected(self.index, f"expected {expected or words[0]}, found {self.found()}")

    def found(self) -> str:
        """Quote the text here, for a message."""
        if self.index >= len(self.text):
            return "the end of the line"
        character = self.text[self.index]
        return repr(character) if character.isprintable() else f"byte {ord(character):02X}H"

    def number(self, name: str) -> int:
        """Take a whole number of 1 to 8 digits without leading zeros."""
        first = self.index
        while self.text[self.index : self.index + 1] in tuple("0123456789"):
            self.index += 1
        digits = self.text[first : self.index]
        if not digits:
            raise _Unexpected(first, f"expected digits of {name}, found {self.found()}")
        if len(digits) > MAX_DIGITS:
            raise _Unexpected(first, f"{name} has {len(digits)} digits, at most {MAX_DIGITS} fit")
        if digits[0] == "0" and len(digits) > 1:
            raise _Unexpected(first, f"{name} has leading zeros")
        return int(digits)


class _Unexpected(Exception):
    def __init__(self, index: int, message: str) -> None:
        super().__init__(message)
        self.index = index


def parse_block(text: str, number: int = 0) -> Block:
    """Read one block without its line end; raises `UserError` with the column of what does not fit."""
    try:
        return Block(*_parse(text), number)
    except _Unexpected as error:
        raise UserError(str(Finding(number, error.index + 1, str(error)))) from None


def _values(block: re.Match[str]) -> tuple[int, int, int, str, str]:
    """x, y, J, count direction and code of a block that was matched."""
    x, y, j, axis, code = block.groups()
    return int(x), int(y), int(j), axis, code


def _parse(text: str) -> tuple[int, int, int, str, str]:
    """x, y, J, count direction and code of a block."""
    if block := _BLOCK.fullmatch(text):
        return _values(block)
    # Something is wrong: where, and what was expected?
    scanner = _Scanner(text)
    values = []
    for name in ("x", "y", "J"):
        scanner.take("B")
        values.append(scanner.number(name))
    scanner.take("G")
    axis = scanner.take("X", "Y", expected="X or Y")
    code = scanner.take(*CODES, expected="L1…L4, NR1…NR4 or SR1…SR4")
    if scanner.index < len(text):
        raise _Unexpected(scanner.index, f"expected the end of the block, found {scanner.found()}")
    return *values, axis, code


class _Reading:
    """A tape that is read line by line; blocks whose text cannot be read are left out."""

    def __init__(self) -> None:
        self.blocks, self.stops = Blocks(), list[Stop]()
        self.findings: list[Finding] = []
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
            self._find(self.number + 1, len(line), "expected CR LF, found the end of the tape")
        if line == "D":
            self.stops.append(Stop(len(self.blocks)))
        elif line == "DD":
            self.ended = True
        else:
            self._block(line)

    def _block(self, line: str) -> None:
        """A block that is not as the punch makes it."""
        self.number += 1
        try:
            self.blocks.add(*_parse(line), self.number)
        except _Unexpected as error:
            self._find(self.number, error.index, str(error))

    def _behind(self, rest: str) -> None:
        """Report text behind DD."""
        if rest:
            self._find(self.number, 0, f"expected nothing after DD, found {_Scanner(rest).found()}")

    def end(self) -> None:
        """No more lines."""
        if self.bare:
            self._find(self.bare, 0, "expected CR LF at the line's end, found LF alone (the first)")
        if not self.ended:
            self._find(self.number + 1, 0, "expected DD, found the end of the tape")

    def _find(self, block: int, index: int, message: str) -> None:
        self.findings.append(Finding(block, index + 1, message))


def scan(data: bytes, name: str = "-", positions: str = "auto") -> tuple[Tape, list[Finding]]:
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
        Finding(block.number, 1, text) for block in _doubtful(tape, positions) for text in block.problems(positions)
    ]
    return tape, sorted(wrong + reading.findings, key=lambda finding: (finding.block, finding.column))


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
    return read_any(data, name) if any("LF" not in finding.message for finding in findings) else tape


def read(path: str) -> Tape:
    """Read a tape from a file or, for `-`, the standard input; raises as `parse` does.

    One whose name ends in `WITHOUT_DRIFT` is without drift.
    """
    tape = parse(read_bytes(path), path)
    return replace(tape, drift=False, drift_by="its name") if path.lower().endswith(WITHOUT_DRIFT) else tape


def to_bytes(items: Iterable[Block | Stop]) -> bytes:
    """Return the bytes that the punch makes of blocks and stops, `DD` included.

    A number of more than 8 digits does not fit: `UserError`.
    """
    return to_style(items, "punch")
