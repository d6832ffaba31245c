"""G-code that is read: the dialect of `skg.tape.gcode`, and what CAD packages write.

What G1 to G3 go through with the beam off (M5, S0) or the tool up is no cut but a move.
"""

from __future__ import annotations

import re
from decimal import Decimal
from math import hypot

from skg.errors import UserError
from skg.messages.finding import Finding, Phrase
from skg.tape import gcode_line as known
from skg.tape.block import Block, Stop, arc_block, line_block
from skg.tape.dialect import UNITS, GcodeDialect
from skg.tape.gcode import Spot, minus
from skg.tape.gcode_dialect import understood
from skg.tape.gcode_line import MILLIMETRE, SPACE, Findings, GcodeFinding, Misread, Modes, Word
from skg.tape.gcode_program import Drilled, GcodePath, GcodeProgram, rounded_one
from skg.tape.gcode_tool import OFF_WORDS, OUTPUTS, Idle, Tool

#: GRBL takes no line that is longer.
LONGEST = 70
#: Lines that GRBL alone knows: settings, queries and commands; `$H` sends it home.
_SYSTEM = re.compile(r"(\$(?:\d+\s*=\s*[\d.]+|[GHICNX#$]|RST\s*=.*|SLP)?|\?)" + SPACE.pattern, re.I)
#: Marks of a file's beginning and end for some controls.
_MARK = re.compile(r"([%:O])\d*" + SPACE.pattern, re.I)
#: First characters of lines that may be no block of words.
_APART = "%:Oo$?"
#: Controls let an arc's end lie so far off the circle through its start: the first, and a thousandth of the radius up
#: to the second, µm.
_OFF_CONTROL, _OFF_MOST = 5, 500
#: Controls take an arc of less than so many radians for a full circle.
_LEAST_SWEEP = 1e-6


class _Reader:
    """State of a program that is being read; places and heights in µm. What it does goes to `path`."""

    def __init__(self, idle: Idle, untold: Decimal | None, dialect: GcodeDialect | None) -> None:
        self.tool, self.path = Tool(idle), GcodePath()
        self.findings = Findings()
        self.modes = Modes(self.findings, untold)
        self.has_centres = dialect is not None and dialect.arcs == "ij-absolute"
        if dialect:
            self.modes.unit = Decimal(UNITS[dialect.unit])
            self.modes.absolute = dialect.places == "absolute"
        # The tool's position in the plane, and the same in whole µm.
        self.position = Decimal(0), Decimal(0)
        self.spot: Spot = (0, 0)
        self.height: Decimal | None = None
        # (heights that begin with a relative one are from an unknown place)
        self.knows_height = False
        self.depths: dict[Decimal, None] = {}
        self.travels: dict[Decimal, None] = {}
        self.dipped: Spot | None = None
        # Of a drilling cycle: its Z and R.
        self.cycle: dict[str, Decimal] = {}
        self.blocks = 0
        self.begun = False
        self.home: Spot = (0, 0)
        # (a control without F words has its feed set by hand)
        self.fed, self.has_rapids = dialect is not None and not dialect.feed, False
        # A machine whose programs begin with such a mark is none with GRBL.
        self.is_marked = dialect is not None and any(map(_MARK.fullmatch, (*dialect.head, *dialect.foot)))
        # Gone to a place of the machine's own, nobody knows where in the plane.
        self.is_away = False
        # The origin of places after a G92 in mid-program; `position` goes on from the first one.
        self.origin = {"X": Decimal(0), "Y": Decimal(0)}

    def take(self, line: str) -> None:
        """Carry out one line."""
        self.findings.line += 1
        text = line.strip()
        if len(text) > LONGEST and not self.is_marked:
            self.findings.warn(LONGEST + 1, Finding("gcode-long-line", length=len(text), most=LONGEST))
        if not text or (text[0] in _APART and self.is_apart(text)):
            return
        block = self.modes.take(line)
        values, codes = block.values, block.codes
        if block.output is not None and OUTPUTS.intersection(block.turns):
            self.tool.outputs.add(block.output)
        if block.turns or block.power is not None:
            self.tool.turn(self.findings.line, block.turns, block.power, known.DWELL in codes)
        if feed := values.pop("F", None):
            self.fed = feed.number > 0
            if not self.fed:
                self.findings.warn(feed.column, Finding("gcode-no-feed"))
        if self.modes.motion not in known.CYCLES:
            self.cycle.clear()
        if values and known.DWELL in codes:
            place = next(iter(values.values()))
            raise Misread(place.column, Finding("gcode-dwell", letter=place.letter))
        if block.is_origin:
            self.name_place(values)
        elif not known.AWAY.isdisjoint(codes):
            self.go_away(values, known.MACHINE not in codes)
        elif values and self.modes.motion in known.CYCLES:
            self.drill(values)
        elif values:
            self.move(values)
        if block.is_stop:
            self.mark(Stop(self.blocks))

    def is_apart(self, text: str) -> bool:
        """Tell whether a line is no block of words: what begins and ends a file, or is between a person and GRBL."""
        if mark := _MARK.fullmatch(text):
            if not self.is_marked:
                self.findings.warn(1, Finding("gcode-not-grbl", word=mark[1]))
        elif system := _SYSTEM.fullmatch(text):
            self.findings.warn(1, Finding("gcode-grbl-only", word=system[1]))
            if system[1].upper() == "$H":
                self.go_away({}, is_home=True)
        else:
            return False
        return True

    def mark(self, mark: Drilled | Stop) -> None:
        """A hole or a stop."""
        self.begun = True
        self.path.mark(mark)

    def name_place(self, values: dict[str, Word]) -> None:
        """G92: the tool's place has these coordinates; what is not named keeps its own."""
        here = dict(zip("XY", self.position, strict=True))
        named = {letter: self.modes.value(values, letter, here[letter] - self.origin[letter]) for letter in "XY"}
        if "Z" in values:
            self.height = self.modes.value(values, "Z")
        if self.is_away and {"X", "Y"} <= values.keys():
            if self.begun:
                raise Misread(min(word.column for word in values.values()), Finding("gcode-origin-away"))
            self.is_away = False
        if self.begun:
            self.origin = {letter: here[letter] - named[letter] for letter in "XY"}
        else:
            self.position = named["X"], named["Y"]
            self.home = self.spot = _rounded(self.position)

    def move(self, values: dict[str, Word]) -> None:
        """Carry out a block that moves."""
        modes = self.modes
        column = next(iter(values.values())).column
        if modes.motion is None:
            raise Misread(column, Finding("gcode-no-motion"))
        feeds, is_arc = modes.motion > 0, modes.motion >= 2
        if feeds:
            self.look_for_feed(column)
        start, before = self.spot, self.height
        if "Z" in values:
            self.to_height(modes.goal(values, "Z", self.height or Decimal(0)), start, feeds)
        if values.keys() == {"Z"}:
            return
        goal = self.place(values, feeds)
        end = _rounded(goal)
        chord = minus(end, start)
        height = self.height if self.knows_height else None
        lowest = height if height is None or before is None else min(before, height)
        cuts = self.cuts(lowest, feeds, is_arc or start != end)
        if is_arc:
            if modes.plane != 17:
                raise Misread(column, Finding("gcode-upright", word=f"G{modes.plane}"))
            if not self.is_no_way(values, goal, end):
                middle = start if self.has_centres else (0, 0)
                self.arc(start, end, _to_centre(modes, values, chord, middle, column), column, cuts)
        elif not values.keys().isdisjoint("IJKR"):
            raise Misread(column, Finding("gcode-centre-of-line"))
        else:
            self.go(start, end, cuts)
        self.position, self.spot = goal, end

    def cuts(self, lowest: Decimal | None, feeds: bool, moves: bool) -> bool:
        """Tell whether a move that comes down to `lowest` cuts; record its height as cutting or travel."""
        if moves and lowest is not None and not feeds:
            self.tool.rapid_heights.add(lowest)
        cuts = feeds and not (moves and self.tool.is_idle(lowest))
        if lowest is not None and (moves or not feeds):
            (self.depths if cuts else self.travels)[lowest if cuts or self.height is None else self.height] = None
        return cuts

    def is_no_way(self, values: dict[str, Word], goal: tuple[Decimal, Decimal], end: Spot) -> bool:
        """Tell whether an arc ends less than 1 µm ahead of where it begins: rounded it would be a full circle."""
        x, y = (float(to - here) for to, here in zip(goal, self.position, strict=True))
        if (x, y) == (0, 0) or end != self.spot:
            return False
        if "R" in values:
            return self.modes.value(values, "R") > 0
        i, j = (float(self.modes.value(values, letter)) for letter in "IJ")
        ahead = y * i - x * j
        return (ahead < 0) == (self.modes.sense > 0) and abs(ahead) > _LEAST_SWEEP * (i**2 + j**2)

    def look_for_feed(self, column: int) -> None:
        """Say, once, that there has been no F."""
        if not self.fed:
            self.fed = True
            self.findings.warn(column, Finding("gcode-feed-missing"))

    def place(self, values: dict[str, Word], feeds: bool) -> tuple[Decimal, Decimal]:
        """Return a line's goal in the plane, µm."""
        x, y = (
            self.modes.goal(values, letter, here, self.origin[letter])
            for letter, here in zip("XY", self.position, strict=True)
        )
        if self.is_away and (feeds or not self.modes.absolute or not values.keys() >= {"X", "Y"}):
            column = next(iter(values.values())).column
            raise Misread(column, Finding("gcode-away"))
        self.is_away = False
        return x, y

    def go(self, start: Spot, end: Spot, cuts: bool) -> None:
        """Straight to a place; until something has been cut that is where all begins."""
        self.has_rapids |= not cuts and start != end
        if not cuts and not self.begun:
            self.home = end
        else:
            self.straight(start, end, cuts)

    def drill(self, values: dict[str, Word]) -> None:
        """A line of a drilling cycle: to a place, down and up again."""
        for letter in filter("IJK".__contains__, values):
            raise Misread(values[letter].column, Finding("cycle-letter", letter=letter))
        column = next(iter(values.values())).column
        if self.modes.absolute is False:
            raise Misread(column, Finding("cycle-relative"))
        self.cycle |= {letter: self.modes.value(values, letter) for letter in values if letter in "ZR"}
        if len(self.cycle) < 2:
            raise Misread(column, Finding("cycle-incomplete"))
        if self.cycle["R"] < self.cycle["Z"]:
            raise Misread(column, Finding("cycle-upside-down"))
        self.look_for_feed(column)
        retract = self.cycle["R"]
        travels = max(retract, self.height) if self.knows_height and self.height is not None else retract
        goal = self.place(values, feeds=False)
        end = _rounded(goal)
        if end != self.spot:
            self.tool.rapid_heights.add(travels)
        self.travels[travels] = None
        self.go(self.spot, end, cuts=False)
        self.position, self.spot = goal, end
        self.dipped = None
        self.mark(Drilled(end, self.cycle["Z"]))
        self.height, self.knows_height = retract if self.modes.is_low else travels, True

    def go_away(self, values: dict[str, Word], is_home: bool) -> None:
        """G28, G30: home, all of it or the axes that are named; G53: to a place in the machine's coordinates."""
        if self.modes.motion and not is_home and values.keys() & {"X", "Y"}:
            raise Misread(min(word.column for word in values.values()), Finding("gcode-machine-cuts"))
        named = values.keys() or (set("XYZ") if is_home else set())
        if "Z" in named:
            self.leave(self.spot, self.height)
            self.height, self.knows_height = None, False
        self.is_away |= bool(named & {"X", "Y"})

    def to_height(self, height: Decimal, place: Spot, cuts: bool) -> None:
        """Up or down: a hole is what is entered and left again."""
        is_down = self.height is None or height < self.height
        before, self.height = self.height, height
        self.knows_height |= bool(self.modes.absolute)
        if is_down and cuts:
            self.dipped = place
        elif not is_down:
            self.leave(place, before)

    def leave(self, place: Spot, depth: Decimal | None) -> None:
        """Up from a place: has it been drilled?"""
        if self.dipped == place:
            self.mark(Drilled(place, depth if self.knows_height else None))
        self.dipped = None

    def straight(self, start: Spot, end: Spot, cuts: bool) -> None:
        """A line in its place, unless it ends where it begins."""
        if start != end:
            self.lay(line_block(*minus(end, start)), start, end, cuts)

    def arc(self, start: Spot, end: Spot, to_centre: Spot, column: int, cuts: bool) -> None:
        """An arc in its place."""
        first = -to_centre[0], -to_centre[1]
        last = first[0] + end[0] - start[0], first[1] + end[1] - start[1]
        if _is_flat(first, last, self.modes.sense):
            self.findings.warn(column, Finding("gcode-flat"))
        self.lay(arc_block(first, last, self.modes.sense), start, end, cuts)

    def lay(self, block: Block, start: Spot, end: Spot, cuts: bool) -> None:
        """A block in its place."""
        self.begun = True
        self.dipped = None
        if cuts:
            self.blocks += 1
        self.path.lay(block, self.blocks, start, end, not cuts)

    def notes(self) -> tuple[Finding, ...]:
        """The notes on what does not cut."""
        return (Finding("gcode-rapids-only"),) if self.goes_only else self.tool.notes()

    @property
    def goes_only(self) -> bool:
        """Tell whether there are rapids and nothing else."""
        return self.has_rapids and not self.begun


def _rounded(place: tuple[Decimal, ...]) -> Spot:
    return rounded_one(place[0]), rounded_one(place[1])


def _to_centre(modes: Modes, values: dict[str, Word], to_end: Spot, start: Spot, column: int) -> Spot:
    """From an arc's start to its centre; `to_end` is the way to its end, `start` the place of its start where I and J
    count from that of places."""
    if "K" in values:
        raise Misread(values["K"].column, Finding("gcode-k"))
    if "R" in values:
        if not values.keys().isdisjoint("IJ"):
            raise Misread(column, Finding("gcode-centre-and-radius"))
        return _by_radius(to_end, float(modes.value(values, "R")), modes.sense, column)
    x, y = minus((rounded_one(modes.value(values, "I")), rounded_one(modes.value(values, "J"))), start)
    if (x, y) == (0, 0):
        raise Misread(column, Finding("gcode-no-centre"))
    off = abs(hypot(to_end[0] - x, to_end[1] - y) - hypot(x, y))
    if off > min(max(_OFF_CONTROL, hypot(x, y) / 1000), _OFF_MOST):
        raise Misread(column, Finding("gcode-off-circle", off=off))
    return x, y


def _by_radius(vector: Spot, radius: float, sense: int, column: int) -> Spot:
    """The vector from an arc's start to its centre, by that to its end and the radius; below 0: over half a turn."""
    chord = hypot(*vector)
    if not chord:
        raise Misread(column, Finding("gcode-radius-of-circle"))
    if chord / 2 - abs(radius) > _OFF_CONTROL:
        raise Misread(column, Finding("gcode-radius-short", chord=chord / 1000))
    aside = max(radius * radius - chord * chord / 4, 0) ** 0.5 / chord
    if (radius > 0) != (sense > 0):
        aside = -aside
    return round(vector[0] / 2 - vector[1] * aside), round(vector[1] / 2 + vector[0] * aside)


def _is_flat(start: Spot, end: Spot, sense: int) -> bool:
    """Tell whether controls take an arc for a full circle, though its ends, told from its centre, differ."""
    cross, dot = sense * (start[0] * end[1] - start[1] * end[0]), start[0] * end[0] + start[1] * end[1]
    return start != end and 0 <= cross < _LEAST_SWEEP * dot


def _read_through(text: str, idle: Idle, untold: Decimal | None, dialect: GcodeDialect | None) -> _Reader:
    """Read a program; what cannot be read is left out."""
    reader = _Reader(idle, untold, dialect)
    for line in text.splitlines():
        try:
            reader.take(line)
        except Misread as error:
            reader.findings.misread(error)
    return reader


def _read_all(text: str, dialect: GcodeDialect | None) -> _Reader:
    """The same, where it is known what does not cut; and what is wrong with the program as a whole."""
    reader = _read_through(text, Idle(), None, dialect)
    if reader.modes.is_mixed:
        reader = _read_through(text, Idle(), MILLIMETRE, dialect)
    # (moves that do not cut are known when all has been read; mostly there are none)
    idle = reader.tool.idle_in_all()
    if idle != Idle():
        again = _read_through(text, idle, reader.modes.untold, dialect)
        if again.tool.idled < again.tool.feeds:
            reader = again
    for beam, line in reader.tool.always_off.items():
        why = Finding("gcode-beam-always-off", beam=OFF_WORDS[beam])
        reader.findings.all.append(GcodeFinding(line, 1, why, is_fatal=False, is_guess=True))
    if not reader.modes.ended:
        # (with nothing in front of it, it is no program)
        is_on = any(reader.tool.is_on.values())
        missing = Finding(
            "gcode-no-end",
            more=Phrase("still-on") if is_on else None,
            nothing=Phrase("rapids-only-too") if reader.goes_only else None,
        )
        is_program = reader.begun
        behind = reader.findings.line + 1
        reader.findings.all.append(GcodeFinding(behind, 1, missing, is_fatal=not is_program, is_guess=is_program))
    return reader


def scan(text: str, name: str = "-", dialect: GcodeDialect | None = None) -> tuple[GcodeProgram, list[GcodeFinding]]:
    """Read a program and everything that is wrong with it; what cannot be read is left out of it. `dialect`: that of
    its machine, None: not told."""
    notes: tuple[Finding, ...] = ()
    if dialect:
        text, notes = understood(text, dialect)
    reader = _read_all(text, dialect)
    guesses = tuple(each.finding for each in reader.findings.all if each.is_guess)
    program = GcodeProgram(
        name, reader.path, reader.home, tuple(reader.depths), tuple(reader.travels), guesses, (*notes, *reader.notes())
    )
    return program, reader.findings.all


def read(text: str, name: str = "-", dialect: GcodeDialect | None = None) -> GcodeProgram:
    """Return a program; what cannot be read is a `UserError` with line and column, guesses are listed."""
    program, findings = scan(text, name, dialect)
    for finding in findings:
        if finding.is_fatal:
            raise UserError(finding.finding.within(name))
    return program
