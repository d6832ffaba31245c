"""A line of G-code: what its words say, and what of that stays in force behind it.

Numbers are in millimetres or inches as G21 and G20 say; without them they are millimetres where some have a decimal
point, and micrometres where none has, as a CAD package has it beside its 3B tapes.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from decimal import Decimal

from skg.tape import gcode_known as known
from skg.tape.block import MAX_DIGITS
from skg.tape.gcode_tool import OUTPUTS, TURNS
from skg.tape.gcode_words import Findings, Misread, Word, words

#: µm in a number of each unit.
INCH, MILLIMETRE = Decimal(25400), Decimal(1000)


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
            if self.ended and (letter in known.PLACES or letter == "G"):
                raise Misread(word.column, "expected nothing after M02")
            if is_board and letter not in "GMS":
                continue
            if letter in known.VALUES:
                if letter in line.values:
                    raise Misread(word.column, f"{letter} stands here twice")
                line.values[letter] = word
            elif letter == "G":
                self._preparatory(word, line)
                is_board = False
            elif letter == "M":
                self._miscellaneous(word, line)
                is_board |= known.is_of_board(word.number) and not (line.codes or line.values)
            elif letter == "S":
                line.power = word.number
            elif letter == "P":
                line.output = word.number
            elif letter == "Q" and (known.BLEND in line.codes or self.motion in known.CYCLES):
                pass
            elif letter not in known.SILENT and not (letter in known.OTHERS and not word.number):
                raise Misread(word.column, f"{letter} is not known here, expected G, M, X, Y, Z, I, J or R")
        if line.output is None:  # another control's words
            line.turns = [code for code in line.turns if code not in OUTPUTS]
        if known.NO_MOTION in line.codes and not known.MOTIONS.intersection(line.codes):
            self.motion = None
        return line

    def _preparatory(self, word: Word, line: GcodeLine) -> None:
        """Carry out a G word."""
        for code in line.codes:
            if any({code, word.number} <= group for group in known.GROUPS):
                raise Misread(word.column, f"G{code:f} and G{word.number:f} in one line")
        line.codes.append(word.number)
        match word.number:
            case n if n in known.WAYS:
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
            case n if n in known.OFFSETS:
                if self.offset not in (None, n):
                    raise Misread(word.column, f"G{n:f} after G{self.offset:f}: how far apart the two are is not known")
                self.offset = n
            case n if n in known.MODES or n in known.HOMES or n == known.MACHINE:
                pass
            case n:
                raise Misread(word.column, f"G{n:f} is not known, expected {known.EXPECTED}")

    def _miscellaneous(self, word: Word, line: GcodeLine) -> None:
        """Carry out an M word."""
        if word.number in TURNS and TURNS.intersection(line.turns):
            raise Misread(word.column, f"M{line.turns[0]:f} and M{word.number:f} in one line")
        line.turns.append(word.number)
        if word.number in (2, 30):
            self.ended = True
        elif word.number in known.CALLS:
            raise Misread(word.column, f"M{word.number:f}: a sub-program is not known here")
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
                how = "all numbers are taken for mm, since some have a point"
                if self.untold is None:
                    how = "a number with a point is taken for mm, a whole one for µm"
                self.findings.warn(word.column, f"no G20 or G21 yet: {how}", is_guess=True)
        if word.number.adjusted() >= MAX_DIGITS:
            raise Misread(word.column, f"{letter} has more than {MAX_DIGITS} digits in front of its point")
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
            message = "no G90 or G91 yet: places are taken for absolute, as G90 says"
            self.findings.warn(values[letter].column, message, is_guess=True)
        value = self.value(values, letter)
        return value + origin if self.absolute else here + value
