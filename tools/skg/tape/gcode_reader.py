"""G-code that is read: the dialect of `skg.tape.gcode`, and what CAD packages write.

Absolute or relative places, numbers in millimetres or inches as G21 and G20 say; without them they are millimetres
where some have a decimal point, and micrometres where none has, as a CAD package has it beside its 3B tapes. What G1 to
G3 go through with the beam off (M5, S0) or the tool up is no cut but a move.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from decimal import Decimal
from math import hypot

from skg.errors import UserError
from skg.tape import gcode_known as known
from skg.tape.block import MAX_DIGITS, Block, Stop, arc_block, line_block
from skg.tape.gcode import Spot, minus
from skg.tape.gcode_program import Drilled, GcodePath, GcodeProgram, rounded_one
from skg.tape.gcode_tool import OUTPUTS, TURNS, Idle, Tool
from skg.tape.gcode_upright import AXES, PLANES, SeenFromAbove, seen_from_above
from skg.tape.gcode_words import SPACE, Misread, Word, words

#: GRBL takes no line that is longer.
LONGEST = 70
#: Controls let an arc's end lie so far off the circle through its start, µm: the first, and a thousandth of the radius
#: up to the second.
OFF_CONTROL, OFF_MOST = 5, 500
#: Controls take an arc of less than so many radians for a full circle.
LEAST_SWEEP = 1e-6


@dataclass(frozen=True)
class GcodeFinding:
    """Something wrong in G-code: line and column, from 1, and what.

    `is_fatal`: it cannot be read further. `is_guess`: it is read as the message says, and might mean something else.
    """

    line: int
    column: int
    message: str
    is_fatal: bool = field(default=True, repr=False)
    is_guess: bool = field(default=False, repr=False)

    def __str__(self) -> str:
        return f"line {self.line}, column {self.column}: {self.message}"


#: What GRBL alone knows: settings, and what it is asked and told; `$H` sends it home.
_SYSTEM = re.compile(r"(\$(?:\d+\s*=\s*[\d.]+|[GHICNX#$]|RST\s*=.*|SLP)?|\?)" + SPACE.pattern, re.I)
#: What begins and ends a file for some controls.
_MARK = re.compile(r"([%:O])\d*" + SPACE.pattern, re.I)
#: How lines begin that may be no block of words.
_APART = "%:Oo$?"
#: What is said of a program that has rapids and nothing else.
_GOES_ONLY = "nothing is cut: it goes everywhere with G0"
#: µm in a number of each unit; None: by the decimal point.
_INCH, _MILLIMETRE = Decimal(25400), Decimal(1000)


class _Reader:
    """State of a program that is being read; places and heights in µm. What it does goes to `path`, if there is one."""

    def __init__(self, idle: Idle, path: GcodePath | None, untold: Decimal | None) -> None:
        self.tool, self.path = Tool(idle), path
        # µm in a number without G20 and G21 (None: by its point); whether some have a point, and some others none.
        self.untold = untold
        self.has_points = self.has_wholes = False
        self.line = 0
        # Where the tool is in the plane, and that in whole µm.
        self.at = Decimal(0), Decimal(0)
        self.spot: Spot = (0, 0)
        self.height: Decimal | None = None
        # (heights that begin with a relative one are from an unknown place)
        self.knows_height = False
        self.depths: dict[Decimal, None] = {}
        self.travels: dict[Decimal, None] = {}
        self.dipped: Spot | None = None
        self.motion: int | None = 0
        # Of a drilling cycle: its Z and R, and whether it comes up to R alone (G99).
        self.cycle: dict[str, Decimal] = {}
        self.is_low = False
        self.plane = 17
        self.absolute: bool | None = None
        self.unit: Decimal | None = None
        self.offset: Decimal | None = None
        self.ended = False
        self.blocks = 0
        self.begun = False
        self.home: Spot = (0, 0)
        self.fed = self.warned_unit = self.has_rapids = False
        # Gone to a place of the machine's own, nobody knows where in the plane.
        self.is_away = False
        # Where a G92 in mid-program has moved the origin of its places to; `at` goes on from the first one.
        self.origin = {"X": Decimal(0), "Y": Decimal(0)}
        self.findings: list[GcodeFinding] = []

    def warn(self, column: int, message: str, is_guess: bool = False) -> None:
        """What can be read, and yet stops a control, or might be meant otherwise."""
        self.findings.append(GcodeFinding(self.line, column, message, is_fatal=False, is_guess=is_guess))

    def take(self, line: str) -> None:
        """Carry out one line."""
        self.line += 1
        text = line.strip()
        if len(text) > LONGEST:
            self.warn(LONGEST + 1, f"a line of {len(text)} characters, GRBL takes {LONGEST}")
        if not text or (text[0] in _APART and self.is_apart(text)):
            return
        values, codes, turns, power, is_origin, is_stop = self.gather(line)
        if turns or power is not None:
            self.tool.turn(self.line, turns, power, known.DWELL in codes)
        if known.NO_MOTION in codes and not known.MOTIONS.intersection(codes):
            self.motion = None
        feed = values.pop("F", None)
        if feed:
            self.fed = feed.number > 0
            if not self.fed:
                self.warn(feed.column, "a feed that is not more than 0")
        if self.motion not in known.CYCLES:
            self.cycle.clear()
        if values and known.DWELL in codes:
            place = next(iter(values.values()))
            raise Misread(place.column, f"{place.letter} in a line with G4: a time, or a place to go to?")
        if is_origin:
            self.name_place(values)
        elif not known.AWAY.isdisjoint(codes):
            self.go_away(values, known.MACHINE not in codes)
        elif values and self.motion in known.CYCLES:
            self.drill(values)
        elif values:
            self.move(values)
        if is_stop:
            self.mark(Stop(self.blocks))

    def gather(self, text: str) -> tuple[dict[str, Word], list[Decimal], list[Decimal], Decimal | None, bool, bool]:
        """The words of a line: places and feed by their letters, the numbers of G and of M words, the S; whether there
        is a G92, and a stop. G and M words hold from where they stand; the others wait for the line's end."""
        values: dict[str, Word] = {}
        codes: list[Decimal] = []
        turns: list[Decimal] = []
        power: Decimal | None = None
        output: Decimal | None = None
        is_origin = is_stop = is_board = False
        for word in words(text):
            letter = word.letter
            if self.ended and (letter in known.PLACES or letter == "G"):
                raise Misread(word.column, "expected nothing after M02")
            if is_board and letter not in "GMS":
                continue
            if letter in known.VALUES:
                if letter in values:
                    raise Misread(word.column, f"{letter} stands here twice")
                values[letter] = word
            elif letter == "G":
                for code in codes:
                    if any({code, word.number} <= group for group in known.GROUPS):
                        raise Misread(word.column, f"G{code:f} and G{word.number:f} in one line")
                codes.append(word.number)
                is_origin |= self.preparatory(word)
                is_board = False
            elif letter == "M":
                if word.number in TURNS and TURNS.intersection(turns):
                    raise Misread(word.column, f"M{turns[0]:f} and M{word.number:f} in one line")
                turns.append(word.number)
                is_stop |= self.miscellaneous(word)
                is_board |= (word.number >= known.BOARDS or word.number in known.BOARD) and not (codes or values)
            elif letter == "S":
                power = word.number
            elif letter == "P":
                output = word.number
            elif letter == "Q" and (known.BLEND in codes or self.motion in known.CYCLES):
                pass
            elif letter not in known.SILENT and not (letter in known.OTHERS and not word.number):
                raise Misread(word.column, f"{letter} is not known here, expected G, M, X, Y, Z, I, J or R")
        if OUTPUTS.intersection(turns):
            if output is None:  # another control's words
                turns = [code for code in turns if code not in OUTPUTS]
            else:
                self.tool.outputs.add(output)
        return values, codes, turns, power, is_origin, is_stop

    def is_apart(self, text: str) -> bool:
        """Whether a line is no block of words: what begins and ends a file, or is between a person and GRBL."""
        if mark := _MARK.fullmatch(text):
            self.warn(1, f"GRBL does not know {mark[1]}")
        elif system := _SYSTEM.fullmatch(text):
            self.warn(1, f"{system[1]} is GRBL's: no other control knows it")
            if system[1].upper() == "$H":
                self.go_away({}, is_home=True)
        else:
            return False
        return True

    def mark(self, mark: Drilled | Stop) -> None:
        """A hole or a stop."""
        self.begun = True
        if self.path is not None:
            self.path.mark(mark)

    def name_place(self, values: dict[str, Word]) -> None:
        """G92: the tool's place has these coordinates; what is not named keeps its own."""
        here = dict(zip("XY", self.at, strict=True))
        named = {letter: self.value(values, letter, here[letter] - self.origin[letter]) for letter in "XY"}
        if "Z" in values:
            self.height = self.value(values, "Z", Decimal(0))
        if self.is_away and {"X", "Y"} <= values.keys():
            if self.begun:
                raise Misread(min(word.column for word in values.values()), "G92 at a place of the machine's own")
            self.is_away = False
        if self.begun:
            self.origin = {letter: here[letter] - named[letter] for letter in "XY"}
        else:
            self.at = named["X"], named["Y"]
            self.home = self.spot = _rounded(self.at)

    def preparatory(self, word: Word) -> bool:
        """Carry out a G word; True for G92."""
        match word.number:
            case n if n in known.WAYS:
                self.motion = int(word.number)
            case 98 | 99:
                self.is_low = word.number == 99
            case 90 | 91:
                self.absolute = word.number == 90
            case 92:
                return True
            case 17 | 18 | 19:
                self.plane = int(word.number)
            case 20 | 21:
                self.unit = _INCH if word.number == 20 else _MILLIMETRE
            case n if n in known.OFFSETS:
                if self.offset not in (None, n):
                    raise Misread(word.column, f"G{n:f} after G{self.offset:f}: how far apart the two are is not known")
                self.offset = n
            case n if n in known.MODES or n in known.HOMES or n == known.MACHINE:
                pass
            case n:
                raise Misread(word.column, f"G{n:f} is not known, expected {known.EXPECTED}")
        return False

    def miscellaneous(self, word: Word) -> bool:
        """Carry out an M word; True for a stop."""
        if word.number in (2, 30):
            self.ended = True
        elif word.number in known.CALLS:
            raise Misread(word.column, f"M{word.number:f}: a sub-program is not known here")
        return word.number in (0, 1)

    def value(self, values: dict[str, Word], letter: str, default: Decimal) -> Decimal:
        """A word's number in µm."""
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
                self.warn(word.column, f"no G20 or G21 yet: {how}", True)
        if word.number.adjusted() >= MAX_DIGITS:
            raise Misread(word.column, f"{letter} has more than {MAX_DIGITS} digits in front of its point")
        unit = self.unit or self.untold or (_MILLIMETRE if word.is_decimal else Decimal(1))
        return word.number * unit

    def goal(self, values: dict[str, Word], letter: str, here: Decimal) -> Decimal:
        """Where a coordinate goes to, µm."""
        if letter not in values:
            return here
        if self.absolute is None:
            self.absolute = True
            self.warn(values[letter].column, "no G90 or G91 yet: places are taken for absolute, as G90 says", True)
        value = self.value(values, letter, Decimal(0))
        return value + self.origin.get(letter, 0) if self.absolute else here + value

    def move(self, values: dict[str, Word]) -> None:
        """What a block that moves does."""
        column = next(iter(values.values())).column
        if self.motion is None:
            raise Misread(column, "a place to go to, and no G00…G03 behind G80")
        feeds = self.motion > 0
        if feeds:
            self.look_for_feed(column)
        start, before = self.spot, self.height
        if "Z" in values:
            self.to_height(self.goal(values, "Z", self.height or Decimal(0)), start, feeds)
        if values.keys() == {"Z"}:
            return
        goal = self.place(values, feeds)
        end = _rounded(goal)
        moves = start != end or self.motion >= 2
        seen = (
            self.upright(values, minus(end, start), before, column) if self.motion >= 2 and self.plane != 17 else None
        )
        lowest = (self.height if before is None else min(before, self.height)) if self.knows_height else None
        if seen and lowest is not None:
            lowest -= round(seen.dip)
        if moves and lowest is not None and not feeds:
            self.tool.rapid_heights.add(lowest)
        cuts = feeds and not (moves and self.tool.is_idle(lowest))
        if lowest is not None and (moves or not feeds):
            (self.depths if cuts else self.travels)[lowest if cuts else self.height] = None
        if self.motion < 2:
            if not values.keys().isdisjoint("IJKR"):
                raise Misread(column, "I, J, K and R belong to G02 and G03")
            self.go(goal, end, cuts)
            return
        if seen:
            at = start
            for place in seen.places:
                to = (start[0] + round(place), start[1]) if self.plane == 18 else (start[0], start[1] + round(place))
                self.straight(at, to, cuts)
                at = to
        elif not self.is_no_way(values, goal):
            self.arc(start, end, self.to_centre(values, "XY", minus(end, start), column), column, cuts)
        self.at, self.spot = goal, end

    def is_no_way(self, values: dict[str, Word], goal: tuple[Decimal, Decimal]) -> bool:
        """Whether an arc ends less than 1 µm ahead of where it begins: rounded it would be a full circle."""
        x, y = (float(to - here) for to, here in zip(goal, self.at, strict=True))
        if (x, y) == (0, 0) or _rounded(goal) != self.spot:
            return False
        if "R" in values:
            return self.value(values, "R", Decimal(0)) > 0
        to_centre = [float(self.value(values, letter, Decimal(0))) for letter in known.CENTRES["XY"]]
        ahead = y * to_centre[0] - x * to_centre[1]
        return (ahead < 0) == (self.motion == 3) and abs(ahead) > LEAST_SWEEP * (to_centre[0] ** 2 + to_centre[1] ** 2)

    def look_for_feed(self, column: int) -> None:
        """Say, once, that there has been no F."""
        if not self.fed:
            self.fed = True
            self.warn(column, "cuts, and there has been no F")

    def place(self, values: dict[str, Word], feeds: bool) -> tuple[Decimal, Decimal]:
        """Where a line goes to in the plane, µm."""
        goal = self.goal(values, "X", self.at[0]), self.goal(values, "Y", self.at[1])
        if self.is_away and (feeds or not self.absolute or not values.keys() >= {"X", "Y"}):
            column = next(iter(values.values())).column
            raise Misread(column, "from a place of the machine's own, expected a rapid to X and Y")
        self.is_away = False
        return goal

    def go(self, goal: tuple[Decimal, Decimal], end: Spot, cuts: bool) -> None:
        """Straight to a place, `end` in whole µm; until something has been cut that is where all begins."""
        start = self.spot
        self.at, self.spot = goal, end
        self.has_rapids |= not cuts and start != end
        if not cuts and not self.begun:
            self.home = end
        else:
            self.straight(start, end, cuts)

    def drill(self, values: dict[str, Word]) -> None:
        """A line of a drilling cycle: to a place, down and up again."""
        for letter in filter("IJK".__contains__, values):
            raise Misread(values[letter].column, f"{letter} in a drilling cycle is not known here")
        column = next(iter(values.values())).column
        if self.absolute is False:
            raise Misread(column, "a drilling cycle with relative places is not known here, expected G90")
        self.cycle |= {letter: self.value(values, letter, Decimal(0)) for letter in values.keys() & {"Z", "R"}}
        if len(self.cycle) < 2:
            raise Misread(column, "a drilling cycle needs its depth Z and the height R")
        if self.cycle["R"] < self.cycle["Z"]:
            raise Misread(column, "a drilling cycle whose height R lies below its depth Z")
        self.look_for_feed(column)
        retract = self.cycle["R"]
        travels = max(retract, self.height) if self.knows_height and self.height is not None else retract
        goal = self.place(values, feeds=False)
        end = _rounded(goal)
        if end != self.spot:
            self.tool.rapid_heights.add(travels)
        self.travels[travels] = None
        self.go(goal, end, cuts=False)
        self.dipped = None
        self.mark(Drilled(end, self.cycle["Z"]))
        self.height, self.knows_height = retract if self.is_low else travels, True

    def to_centre(self, values: dict[str, Word], plane: str, to_end: Spot, column: int) -> Spot:
        """From an arc's start to its centre, in a plane; `to_end` is the way to its end."""
        letters = known.CENTRES[plane]
        for letter in filter(known.OTHER_CENTRES[plane].__contains__, values):
            raise Misread(values[letter].column, f"{letter} belongs to arcs of another plane")
        if "R" in values:
            if not values.keys().isdisjoint(letters):
                raise Misread(column, f"an arc has its centre, {' and '.join(letters)}, or its radius, R, not both")
            return self.by_radius(to_end, float(self.value(values, "R", Decimal(0))), column)
        x, y = (rounded_one(self.value(values, letter, Decimal(0))) for letter in letters)
        if (x, y) == (0, 0):
            raise Misread(column, f"an arc needs its centre, {' and '.join(letters)}")
        off = abs(hypot(to_end[0] - x, to_end[1] - y) - hypot(x, y))
        if off > min(max(OFF_CONTROL, hypot(x, y) / 1000), OFF_MOST):
            raise Misread(column, f"the arc's end is {off:.0f} µm off the circle through its start")
        return x, y

    def upright(self, values: dict[str, Word], way: Spot, before: Decimal | None, column: int) -> SeenFromAbove:
        """An arc of G18 or G19, from the height `before`, with that way in the plane."""
        if way["XY".index(AXES[self.plane]) - 1]:
            raise Misread(column, f"an arc of G{self.plane} that leaves its plane is not known here")
        if before is None and self.absolute and "Z" in values:
            raise Misread(column, f"an arc of G{self.plane} from a height that is not known")
        ways = dict(zip("XY", way, strict=True), Z=rounded_one(self.height - (before or 0)) if "Z" in values else 0)
        to_end = ways[PLANES[self.plane][0]], ways[PLANES[self.plane][1]]
        to_centre = self.to_centre(values, PLANES[self.plane], to_end, column)
        return seen_from_above(self.plane, 1 if self.motion == 3 else -1, to_centre, to_end)

    def go_away(self, values: dict[str, Word], is_home: bool) -> None:
        """G28, G30: home, all of it or the axes that are named; G53: to a place in the machine's coordinates."""
        if self.motion and not is_home and values.keys() & {"X", "Y"}:
            raise Misread(min(word.column for word in values.values()), "G53 in a line that cuts")
        named = values.keys() or (set("XYZ") if is_home else set())
        if "Z" in named:
            self.leave(self.spot, self.height)
            self.height, self.knows_height = None, False
        self.is_away |= bool(named & {"X", "Y"})

    def to_height(self, height: Decimal, place: Spot, cuts: bool) -> None:
        """Up or down: a hole is what is entered and left again."""
        is_down = self.height is None or height < self.height
        before, self.height = self.height, height
        self.knows_height |= bool(self.absolute)
        if is_down and cuts:
            self.dipped = place
        elif not is_down:
            self.leave(place, before)

    def leave(self, place: Spot, depth: Decimal | None) -> None:
        """Up from a place: has it been drilled?"""
        if self.dipped == place:
            self.mark(Drilled(place, depth if self.knows_height else None))
        self.dipped = None

    def by_radius(self, way: Spot, radius: float, column: int) -> Spot:
        """From an arc's start to its centre, of the way to its end and its radius; below 0: more than half a turn."""
        chord = hypot(*way)
        if not chord:
            raise Misread(column, "an arc by its radius that ends where it begins")
        if chord / 2 - abs(radius) > OFF_CONTROL:
            raise Misread(column, f"the arc's ends are {chord / 1000:g} mm apart, more than twice its radius")
        aside = max(radius * radius - chord * chord / 4, 0) ** 0.5 / chord
        if (radius > 0) != (self.motion == 3):
            aside = -aside
        return round(way[0] / 2 - way[1] * aside), round(way[1] / 2 + way[0] * aside)

    def straight(self, start: Spot, end: Spot, cuts: bool) -> None:
        """A line in its place, unless it ends where it begins."""
        if start != end:
            self.lay(line_block(*minus(end, start)), start, end, cuts)

    def arc(self, start: Spot, end: Spot, to_centre: Spot, column: int, cuts: bool) -> None:
        """An arc in its place."""
        xs, ys = -to_centre[0], -to_centre[1]
        to_end = xs + end[0] - start[0], ys + end[1] - start[1]
        sense = 1 if self.motion == 3 else -1
        cross, dot = sense * (xs * to_end[1] - ys * to_end[0]), xs * to_end[0] + ys * to_end[1]
        if start != end and 0 <= cross < LEAST_SWEEP * dot:
            self.warn(column, "an arc so flat that LinuxCNC and GRBL take it for a full circle")
        self.lay(arc_block((xs, ys), to_end, sense), start, end, cuts)

    def lay(self, block: Block, start: Spot, end: Spot, cuts: bool) -> None:
        """A block in its place."""
        self.begun = True
        self.dipped = None
        if cuts:
            self.blocks += 1
        if self.path is not None:
            self.path.lay(block, self.blocks, start, end, not cuts)

    def notes(self) -> tuple[str, ...]:
        """What there is to say of what does not cut."""
        return (_GOES_ONLY,) if self.goes_only else self.tool.notes()

    @property
    def goes_only(self) -> bool:
        """Whether there are rapids and nothing else."""
        return self.has_rapids and not self.begun


def _rounded(place: tuple[Decimal, ...]) -> Spot:
    return rounded_one(place[0]), rounded_one(place[1])


def _read_through(text: str, idle: Idle, keeps: bool, untold: Decimal | None) -> _Reader:
    """Read a program; what cannot be read is left out. Unless `keeps`, nothing of what it does is kept."""
    reader = _Reader(idle, GcodePath() if keeps else None, untold)
    for line in text.splitlines():
        try:
            reader.take(line)
        except Misread as error:
            reader.findings.append(GcodeFinding(reader.line, error.column, str(error)))
    return reader


def _read_all(text: str, keeps: bool) -> _Reader:
    """The same, where it is known what does not cut; and what is wrong with the program as a whole."""
    reader = _read_through(text, Idle(), keeps, None)
    if reader.has_points and reader.has_wholes:
        reader = _read_through(text, Idle(), keeps, _MILLIMETRE)
    # (what does not cut is known when all has been read; mostly there is nothing)
    idle = reader.tool.idle_in_all()
    if idle != Idle():
        again = _read_through(text, idle, keeps, reader.untold)
        if again.tool.idled < again.tool.feeds:
            reader = again
    for beam, line in reader.tool.always_off.items():
        said = f"each G1 finds the beam off ({beam}), as if nothing were cut: taken for cuts all the same"
        reader.findings.append(GcodeFinding(line, 1, said, is_fatal=False, is_guess=True))
    if not reader.ended:
        # (with nothing in front of it, it is no program)
        missing = "expected M02 or M30, found the end of the program"
        if any(reader.tool.is_on.values()):
            missing += ", with beam or spindle on"
        is_program = reader.begun
        if reader.goes_only:
            missing += f"; {_GOES_ONLY}"
        reader.findings.append(GcodeFinding(reader.line + 1, 1, missing, is_fatal=not is_program, is_guess=is_program))
    return reader


def look(text: str) -> tuple[list[GcodeFinding], tuple[str, ...]]:
    """Everything that is wrong with a program, and its notes, as `GcodeProgram` has them."""
    reader = _read_all(text, keeps=False)
    return reader.findings, reader.notes()


def scan(text: str, name: str = "-") -> tuple[GcodeProgram, list[GcodeFinding]]:
    """Read a program and everything that is wrong with it; what cannot be read is left out of it."""
    reader = _read_all(text, keeps=True)
    guesses = tuple(str(finding) for finding in reader.findings if finding.is_guess)
    program = GcodeProgram(
        name, reader.path, reader.home, tuple(reader.depths), tuple(reader.travels), guesses, reader.notes()
    )
    return program, reader.findings


def read(text: str, name: str = "-") -> GcodeProgram:
    """Return a program; what cannot be read is a `UserError` with line and column, what is guessed is among it."""
    program, findings = scan(text, name)
    for finding in findings:
        if finding.is_fatal:
            raise UserError(f"{name}: {finding}")
    return program
