"""3B tapes to ISO G-code and back.

The dialect is the one that a CAD package gives beside its 3B tapes: whole micrometres, relative moves, I and
J from the start to the centre. A number with a decimal point is read as millimetres, as controllers do.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from decimal import ROUND_HALF_UP, Decimal
from math import hypot

from skg.errors import UserError
from skg.tape.block import Block, Stop, Tape, arc_block, line_block
from skg.tape.placed import closed_moves

#: An arc's end may lie this far off the circle through its start, µm: each of the two is rounded, and so is
#: the centre.
_OFF_CIRCLE = 2
_WORD = re.compile(r"([A-Z])\s*([+-]?(?:\d+\.?\d*|\.\d+))")
_SPACE = re.compile(r"(?:\s|\([^()]*\))*")


def write(tape: Tape, start: tuple[int, int] = (0, 0), millimetres: bool = False) -> str:
    """Return the G-code of a tape, one line each block; `start` is the G92 position in µm."""

    def number(micrometres: int) -> str:
        return str(Decimal(micrometres).scaleb(-3)) if millimetres else str(micrometres)

    def pair(first: str, second: str, values: tuple[int, int]) -> str:
        return f"{first}{number(values[0])} {second}{number(values[1])}"

    lines = [f"G91 G92 {pair('X', 'Y', start)}"]
    if millimetres:
        lines.insert(0, "G21")
    moves = (move for blocks in tape.stretches() for move in closed_moves(blocks))
    for item in tape.items:
        if isinstance(item, Stop):
            lines.append("M00")
            continue
        move = pair("X", "Y", next(moves))
        if item.is_line:
            lines.append(f"G01 {move}")
        else:
            centre = -item.start[0], -item.start[1]
            lines.append(f"{'G03' if item.sense > 0 else 'G02'} {move} {pair('I', 'J', centre)}")
    return "\n".join([*lines, "M02"]) + "\n"


@dataclass(frozen=True)
class _Word:
    letter: str
    number: Decimal
    is_decimal: bool
    column: int

    @property
    def micrometres(self) -> Decimal:
        return self.number * 1000 if self.is_decimal else self.number


class _Reader:
    """State of a G-code program that is being read; positions in µm."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.line = 0
        self.at = Decimal(0), Decimal(0)
        self.motion = 0
        self.absolute = False
        self.ended = False
        self.blocks = 0

    def error(self, column: int, message: str) -> UserError:
        return UserError(f"{self.name}: line {self.line}, column {column}: {message}")

    def words(self, text: str) -> Iterator[_Word]:
        """Split a line into words; comments in parentheses and after `;` are nothing."""
        text = text.partition(";")[0].upper()
        at = _SPACE.match(text).end()
        while at < len(text):
            match = _WORD.match(text, at)
            if not match:
                raise self.error(at + 1, f"expected a word such as G01 or X-9900, found {text[at]!r}")
            yield _Word(match[1], Decimal(match[2]), "." in match[2], at + 1)
            at = _SPACE.match(text, match.end()).end()

    def read(self, line: str) -> Iterator[Block | Stop]:
        """Carry out one line."""
        self.line += 1
        if line.strip() in ("%", ""):
            return
        values: dict[str, _Word] = {}
        is_origin, stop = False, False
        for word in self.words(line):
            if self.ended:
                raise self.error(word.column, "expected nothing after M02")
            if word.letter == "G":
                is_origin |= self.preparatory(word)
            elif word.letter == "M":
                stop |= self.miscellaneous(word)
            elif word.letter in "XYIJ":
                if word.letter in values:
                    raise self.error(word.column, f"{word.letter} stands here twice")
                values[word.letter] = word
            elif word.letter not in "NF":
                raise self.error(word.column, f"{word.letter} is not known here, expected G, M, X, Y, I or J")
        if is_origin:
            self.at = tuple(self.value(values, letter, Decimal(0)) for letter in "XY")
        elif values:
            yield from self.move(values)
        if stop:
            yield Stop(self.blocks)

    def preparatory(self, word: _Word) -> bool:
        """Carry out a G word; True for G92."""
        match word.number:
            case 0 | 1 | 2 | 3:
                self.motion = int(word.number)
            case 90 | 91:
                self.absolute = word.number == 90
            case 92:
                return True
            case 17 | 21 | 40:
                pass
            case _:
                raise self.error(word.column, f"G{word.number:f} is not known, expected "
                                              "G00…G03, G17, G21, G40, G90, G91 or G92")
        return False

    def miscellaneous(self, word: _Word) -> bool:
        """Carry out an M word; True for a stop."""
        if word.number in (2, 30):
            self.ended = True
        elif word.number not in (0, 1):
            raise self.error(word.column, f"M{word.number:f} is not known, expected M00 or M02")
        return word.number in (0, 1)

    @staticmethod
    def value(values: dict[str, _Word], letter: str, default: Decimal) -> Decimal:
        return values[letter].micrometres if letter in values else default

    def move(self, values: dict[str, _Word]) -> Iterator[Block]:
        """Make the block of a move."""
        column = min(word.column for word in values.values())
        goal = tuple(
            self.value(values, letter, here if self.absolute else Decimal(0)) + (0 if self.absolute else here)
            for letter, here in zip("XY", self.at, strict=True))
        dx, dy = (_round(there) - _round(here) for there, here in zip(goal, self.at, strict=True))
        self.at = goal
        if self.motion < 2:
            if "I" in values or "J" in values:
                raise self.error(column, "I and J belong to G02 and G03")
            if (dx, dy) == (0, 0):
                return
            block = line_block(dx, dy)
        else:
            xs, ys = (-_round(self.value(values, letter, Decimal(0))) for letter in "IJ")
            end = xs + dx, ys + dy
            if (xs, ys) == (0, 0):
                raise self.error(column, "an arc needs its centre, I and J")
            off = abs(hypot(*end) - hypot(xs, ys))
            if off > _OFF_CIRCLE:
                raise self.error(column, f"the arc's end is {off:.0f} µm off the circle through its start")
            block = arc_block((xs, ys), end, 1 if self.motion == 3 else -1)
        self.blocks += 1
        yield block


def _round(value: Decimal) -> int:
    """Whole µm, halves away from zero."""
    return int(value.quantize(Decimal(1), ROUND_HALF_UP))


def read(text: str, name: str = "-") -> Tape:
    """Return the tape of a G-code program; what cannot be read is a `UserError` with line and column."""
    reader = _Reader(name)
    items = [item for line in text.splitlines() for item in reader.read(line)]
    if not reader.ended:
        reader.line += 1
        raise reader.error(1, "expected M02, found the end of the program")
    return Tape(name, tuple(items))
