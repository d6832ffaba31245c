"""A line of G-code: its words, what they say, and what of that stays in force behind it.

Numbers are in millimetres or inches as G21 and G20 say; without them they are millimetres where some have a decimal
point, and micrometres where none has, as a CAD package has it beside its 3B tapes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from decimal import Decimal
from typing import NamedTuple

from skg.messages.finding import Finding, Phrase
from skg.messages.render import data
from skg.messages.render import text as sentence
from skg.tape.block import MAX_DIGITS
from skg.tape.gcode_tool import OUTPUTS, TURNS

#: Text between words, or behind a line: blanks, comments in parentheses and after `;`.
SPACE = re.compile(r"(?:\s|\([^()]*\)|;.*)*")
_WORD = re.compile(r"([A-Z])\s*([+-]?(?:\d+\.?\d*|\.\d+))" + SPACE.pattern)
#: M words behind which the rest of the line is a text, on boards for printers.
_TEXTS = {117, 118}
#: Letters that say nothing of the path.
SILENT = "FSTPHDL"
#: Other axes, which may stand at 0.
OTHERS = "ABCUVW"
#: G words that say nothing of it: a dwell, lengths of tools, path modes.
MODES = {Decimal(n) for n in ("4", "8", "9", "40", "43", "49", "50", "61", "64", "69", "80", "91.1", "94", "97")}
#: Work offsets: a program may have one of them.
OFFSETS = {Decimal(n) for n in range(54, 60)}
#: M words of sub-programs, which are no part of a path.
CALLS = {96, 97, 98, 99}
#: Cycles that drill, or bore: at each place down and up again. Their Q is the depth of a peck.
CYCLES = {73, 81, 82, 83, 85, 89}
#: G words that say what a place does; the first ones are the motions.
MOTIONS = set(map(Decimal, range(4)))
WAYS = {*MOTIONS, *map(Decimal, CYCLES)}
#: Of the G words of one of these groups a line has one at most: which of two would count differs among controls.
GROUPS = [
    WAYS,
    *(set(map(Decimal, group.split())) for group in ("17 18 19", "20 21", "90 91", "43 49", "61 64", "98 99")),
    OFFSETS,
]
#: Words that are places, and what G4 has besides P on some controls.
PLACES = "XYZIJKR"
VALUES = PLACES + "F"
DWELL, NO_MOTION = Decimal(4), Decimal(80)
#: Path blending of G64: P, the tolerance at corners, and Q, that for lines that are nearly one.
BLEND = Decimal(64)
#: G words that go to a place of the machine's own: home, or what the line says in its coordinates.
HOMES, MACHINE = {Decimal(28), Decimal(30)}, Decimal(53)
AWAY = {*HOMES, MACHINE}
#: M words of boards for printers: from the first on, and these. The words behind one are its own (`M92 X80`: steps).
BOARDS, BOARD = 100, {17, 18, 84, 92}
#: µm in a number of each unit.
INCH, MILLIMETRE = Decimal(25400), Decimal(1000)


class Misread(Exception):
    """A text that cannot be read, at a column, from 1."""

    def __init__(self, column: int, why: Finding) -> None:
        super().__init__(why)
        self.column, self.why = column, why


@dataclass(frozen=True)
class GcodeFinding:
    """Something wrong in G-code: line and column, from 1, and what.

    `is_fatal`: it cannot be read further. `is_guess`: it is read as the message says, and might mean something else.
    """

    line: int
    column: int
    why: Finding
    is_fatal: bool = field(default=True, repr=False)
    is_guess: bool = field(default=False, repr=False)

    @property
    def finding(self) -> Finding:
        """The finding with its place."""
        return self.why.within(Phrase("at-column", line=self.line, column=self.column))

    def plain(self) -> dict[str, object]:
        """The finding for other programs."""
        known = data(self.why)
        place = {"line": self.line, "column": self.column, "message": sentence(self.why)}
        kind = {"is_fatal": self.is_fatal, "is_guess": self.is_guess}
        return place | kind | {name: known[name] for name in ("code", "values")}


class Findings:
    """Findings in a program that is being read; `line`, from 1, is the current one."""

    def __init__(self) -> None:
        self.line = 0
        self.all: list[GcodeFinding] = []

    def misread(self, error: Misread) -> None:
        """Add an error: a text that cannot be read."""
        self.all.append(GcodeFinding(self.line, error.column, error.why))

    def warn(self, column: int, why: Finding, is_guess: bool = False) -> None:
        """Add a warning: a text that stops some controls, or might be meant otherwise."""
        self.all.append(GcodeFinding(self.line, column, why, is_fatal=False, is_guess=is_guess))


class Word(NamedTuple):
    """A letter and its number; `is_decimal`: it has a point; `column`, from 1."""

    letter: str
    number: Decimal
    is_decimal: bool
    column: int


def words(text: str) -> Iterator[Word]:
    """Split a line into words; comments in parentheses and after `;` are nothing, and N words say nothing."""
    text = text.upper()
    blank = SPACE.match(text)
    index, end = blank.end() if blank else 0, len(text)
    while index < end:
        match = _WORD.match(text, index)
        if not match:
            raise Misread(index + 1, Finding("gcode-no-word", found=repr(text[index])))
        letter, number = match.groups()
        if letter != "N":
            word = Word(letter, Decimal(number), "." in number, index + 1)
            yield word
            if letter == "M" and word.number in _TEXTS:
                return
        index = match.end()


def _both(letter: str, first: Decimal, other: Decimal) -> Finding:
    """Two words of which a line has one at most."""
    return Finding("gcode-both", first=f"{letter}{first:f}", other=f"{letter}{other:f}")


@dataclass
class GcodeLine:
    """The content of a line: places and feed by their letters, the numbers of its G and M words, its S, the output
    that its P names; whether there is a G92, and a stop."""

    values: dict[str, Word] = field(default_factory=dict)
    codes: list[Decimal] = field(default_factory=list)
    turns: list[Decimal] = field(default_factory=list)
    power: Decimal | None = None
    output: Decimal | None = None
    is_origin: bool = False
    is_stop: bool = False


class Modes:
    """Modal state of a program that is being read. Faults and guesses go to `findings`."""

    def __init__(self, findings: Findings, untold: Decimal | None) -> None:
        self.findings = findings
        # µm in a number without G20 and G21 (None: by its point); whether some have a point, and some others none.
        self.untold = untold
        self.has_points = self.has_wholes = False
        self.unit: Decimal | None = None
        self.warned_unit = False
        # G0 to G3 or a drilling cycle, None behind G80; of a cycle, whether it comes up to its R alone (G99).
        self.motion: int | None = 0
        self.is_low = False
        self.plane = 17
        self.absolute: bool | None = None
        self.offset: Decimal | None = None
        self.ended = False

    @property
    def sense(self) -> int:
        """1: arcs run counter-clockwise, -1: clockwise."""
        return 1 if self.motion == 3 else -1

    def take(self, text: str) -> GcodeLine:
        """The words of a line. G and M words hold from where they stand; the others wait for the line's end."""
        line = GcodeLine()
        is_board = False
        for word in words(text):
            letter = word.letter
            if self.ended and (letter in PLACES or letter == "G"):
                raise Misread(word.column, Finding("gcode-after-end"))
            if is_board and letter not in "GMS":
                continue
            if letter in VALUES:
                if letter in line.values:
                    raise Misread(word.column, Finding("gcode-twice", letter=letter))
                line.values[letter] = word
            elif letter == "G":
                self._preparatory(word, line)
                is_board = False
            elif letter == "M":
                self._miscellaneous(word, line)
                is_board |= (word.number >= BOARDS or word.number in BOARD) and not (line.codes or line.values)
            elif letter == "S":
                line.power = word.number
            elif letter == "P":
                line.output = word.number
            elif letter == "Q" and (BLEND in line.codes or self.motion in CYCLES):
                pass
            elif letter not in SILENT and not (letter in OTHERS and not word.number):
                raise Misread(word.column, Finding("gcode-letter", letter=letter))
        if line.output is None:  # another control's words
            line.turns = [code for code in line.turns if code not in OUTPUTS]
        if NO_MOTION in line.codes and not MOTIONS.intersection(line.codes):
            self.motion = None
        return line

    def _preparatory(self, word: Word, line: GcodeLine) -> None:
        """Carry out a G word."""
        for code in line.codes:
            if any({code, word.number} <= group for group in GROUPS):
                raise Misread(word.column, _both("G", code, word.number))
        line.codes.append(word.number)
        match word.number:
            case n if n in WAYS:
                self.motion = int(word.number)
            case 98 | 99:
                self.is_low = word.number == 99
            case 90 | 91:
                self.absolute = word.number == 90
            case 92:
                line.is_origin = True
            case 17 | 18 | 19:
                self.plane = int(word.number)
            case 20 | 21:
                self.unit = INCH if word.number == 20 else MILLIMETRE
            case n if n in OFFSETS:
                if self.offset not in (None, n):
                    raise Misread(word.column, Finding("gcode-offset", word=f"G{n:f}", before=f"G{self.offset:f}"))
                self.offset = n
            case n if n in MODES or n in HOMES or n == MACHINE:
                pass
            case n:
                raise Misread(word.column, Finding("gcode-word", word=f"G{n:f}"))

    def _miscellaneous(self, word: Word, line: GcodeLine) -> None:
        """Carry out an M word."""
        if word.number in TURNS and TURNS.intersection(line.turns):
            raise Misread(word.column, _both("M", line.turns[0], word.number))
        line.turns.append(word.number)
        if word.number in (2, 30):
            self.ended = True
        elif word.number in CALLS:
            raise Misread(word.column, Finding("gcode-call", word=f"M{word.number:f}"))
        line.is_stop |= word.number in (0, 1)

    def value(self, values: dict[str, Word], letter: str, default: Decimal = Decimal(0)) -> Decimal:
        """A word's number in µm; `default` where there is none."""
        word = values.get(letter)
        if word is None:
            return default
        if self.unit is None:
            self.has_points |= word.is_decimal
            self.has_wholes |= bool(word.number) and not word.is_decimal
            if not self.warned_unit:
                self.warned_unit = True
                code = "gcode-units-by-point" if self.untold is None else "gcode-units-mm"
                self.findings.warn(word.column, Finding(code), is_guess=True)
        if word.number.adjusted() >= MAX_DIGITS:
            raise Misread(word.column, Finding("gcode-digits", letter=letter, most=MAX_DIGITS))
        unit = self.unit or self.untold or (MILLIMETRE if word.is_decimal else Decimal(1))
        return word.number * unit

    @property
    def is_mixed(self) -> bool:
        """Tell whether some numbers without G20 and G21 have a point, and some others none: then all are mm."""
        return self.has_points and self.has_wholes

    def goal(self, values: dict[str, Word], letter: str, here: Decimal, origin: Decimal = Decimal(0)) -> Decimal:
        """Return a coordinate's goal from `here`, µm; an absolute one counts from `origin`."""
        if letter not in values:
            return here
        if self.absolute is None:
            self.absolute = True
            self.findings.warn(values[letter].column, Finding("gcode-absolute"), is_guess=True)
        value = self.value(values, letter)
        return value + origin if self.absolute else here + value
