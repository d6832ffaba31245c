"""ISO G-code: one writer and one reader.

Written is the dialect of the milling ROM (milling.md, section "The tape"), which LinuxCNC and GRBL take as it is.
Read are that and what CAD packages write: absolute or relative places, numbers in millimetres or inches as G21 and G20
say; without them a number with a decimal point is millimetres and a whole one micrometres, as a CAD package has it
beside its 3B tapes.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from decimal import ROUND_HALF_UP, Decimal
from math import hypot, pi

from skg.errors import UserError
from skg.tape.block import Block, Stop, Tape, arc_block, line_block
from skg.tape.placed import Placed, PlacedRoute

Spot = tuple[int, int]

#: How a file's name ends that holds G-code.
ENDINGS = (".nc", ".ngc", ".gcode", ".tap", ".iso")
#: What stands in front of everything: plane XY, millimetres, absolute places, feed in mm/min.
PREAMBLE = "G17G21G90G94"
LAST_NUMBER = 9999
#: GRBL takes no line that is longer.
LONGEST = 70
#: An arc's end may lie so far off the circle through its start, µm: for a 3B block (each of the two is rounded, and so
#: is the centre), and for a control, which also lets pass a thousandth of the radius, up to half a millimetre.
OFF_BLOCK, OFF_CONTROL, OFF_MOST = 2, 5, 500
#: Controls take an arc of less than so many radians for a full circle.
LEAST_SWEEP = 1e-6


def is_gcode(name: str) -> bool:
    """Whether a file holds G-code, by its name."""
    return name.lower().endswith(ENDINGS)


# Writing ------------------------------------------------------------------------------------------------------------


class _GcodeWriter:
    """Blocks in the order of writing; keeps the place and height of the tool in whole µm, and the last F."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.at: Spot | None = None
        self.height: int | None = None
        self.feed = ""
        self.block(PREAMBLE)

    def block(self, words: str) -> None:
        self.lines.append(f"N{len(self.lines) % LAST_NUMBER + 1}{words}")

    def rapid(self, end: Spot) -> None:
        if end != self.at:
            self.block(f"G0{_pair('XY', end)}")
            self.at = end

    def to_height(self, g: int, height: int, feed: str = "") -> None:
        if height != self.height:
            self.block(f"G{g}Z{_millimetres(height)}{self._fed(feed)}")
            self.height = height

    def line(self, end: Spot, feed: str) -> None:
        if end != self.at:
            self.block(f"G1{_pair('XY', end)}{self._fed(feed)}")
            self.at = end

    def arc(self, end: Spot, centre: Spot, sense: int, feed: str) -> None:
        to_centre = centre[0] - self.at[0], centre[1] - self.at[1]
        self.block(f"G{3 if sense > 0 else 2}{_pair('XY', end)}{_pair('IJ', to_centre)}{self._fed(feed)}")
        self.at = end

    def _fed(self, feed: str) -> str:
        if not feed or feed == self.feed:
            return ""
        self.feed = feed
        return f"F{feed}"


def _millimetres(micrometres: int) -> str:
    whole, rest = divmod(abs(micrometres), 1000)
    sign = "-" if micrometres < 0 else ""
    return f"{sign}{whole}.{rest:03}".rstrip("0") if rest else f"{sign}{whole}"


def _pair(letters: str, values: Spot) -> str:
    return "".join(f"{letter}{_millimetres(value)}" for letter, value in zip(letters, values, strict=True))


def decimal(value: float) -> str:
    """A feed as the tape has it: at most 8 significant digits, no exponent."""
    return f"{Decimal(f'{value:.8g}'):f}"


def write(
    tape: Tape,
    start: Spot = (0, 0),
    feeds: tuple[float, float] = (100.0, 100.0),
    heights: Spot | None = None,
    positions: str = "auto",
) -> str:
    """Return the G-code of a 3B tape whose wire begins at `start` (µm), lines ended by CR LF.

    `feeds` are mm/min in the plane and downwards. With `heights`, cutting and travel height in µm, a re-positioning
    between two stops is an up, a rapid and a down; without them the stops are M0. `positions` is one of
    `skg.tape.positions.POSITIONS`.
    """
    from skg.tape.laid import place  # which loads numpy

    plane, down = map(decimal, feeds)
    writer = _GcodeWriter()
    routes = iter(place(tape, start, positions))
    stretches, moves = tape.stretches(), tape.positioning()
    if heights:
        writer.to_height(0, heights[1])
    writer.rapid(start)
    for at, (blocks, is_move) in enumerate(zip(stretches, moves, strict=True)):
        if at and not (heights and (is_move or moves[at - 1])):
            writer.block("M0")
        for placed in next(routes).blocks if blocks else ():
            if is_move:
                if heights:
                    writer.to_height(0, heights[1])
                writer.rapid(_grid(placed.end))
                continue
            if heights:
                writer.to_height(1, heights[0], down)
            _cut(writer, placed, plane)
    if heights:
        writer.to_height(0, heights[1])
    writer.block("M30")
    return "".join(f"{line}\r\n" for line in writer.lines)


def _cut(writer: _GcodeWriter, placed: Placed, feed: str) -> None:
    """A block that cuts; an arc so flat that a control might take it for a full circle as a line (milling.md)."""
    end, turns = _grid(placed.end), abs(placed.sweep)
    if not placed.is_line and turns > 2 * pi - 1e-9:
        # Round once, and the few µm by which a block goes on.
        writer.arc(writer.at, _grid(placed.centre), placed.block.sense, feed)
        writer.line(end, feed)
        return
    (dx, dy), (x, y) = _minus(end, writer.at), placed.block.start
    is_flat = turns <= pi and (dx * dx + dy * dy) ** 2 <= 4 * (x * x + y * y)
    if placed.is_line or is_flat:
        writer.line(end, feed)
    else:
        writer.arc(end, _grid(placed.centre), placed.block.sense, feed)


def _grid(place: tuple[float, float]) -> Spot:
    return round(place[0]), round(place[1])


# Reading ------------------------------------------------------------------------------------------------------------


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


@dataclass(frozen=True)
class Drilled:
    """A hole: down and up again at a place, µm; its depth, if the program's heights are known."""

    place: Spot
    depth: Decimal | None = None


@dataclass(frozen=True)
class Rapid:
    """A rapid move in the plane."""

    placed: Placed


@dataclass(frozen=True)
class GcodeProgram:
    """What G-code does in the plane, in order: cuts, rapids, holes, stops; `home` (µm) is where it begins.

    `depths` and `travels`: the heights (µm) at which it cuts and at which it is moved, each once, in the order in which
    they come; empty where no height is known. `guesses`: how it is read where it does not say.
    """

    name: str
    items: tuple[Placed | Rapid | Drilled | Stop, ...]
    home: Spot = (0, 0)
    depths: tuple[Decimal, ...] = ()
    travels: tuple[Decimal, ...] = ()
    guesses: tuple[str, ...] = ()

    @property
    def holes(self) -> list[Spot]:
        """Where it drills, each place once."""
        return list(dict.fromkeys(item.place for item in self.items if isinstance(item, Drilled)))

    @property
    def stop_places(self) -> list[Spot]:
        """Where it stops, each place once."""
        at, found = self.home, []
        for item in self.items:
            if isinstance(item, Stop):
                found.append(at)
            else:
                at = item.place if isinstance(item, Drilled) else _grid(_placed(item).end)
        return list(dict.fromkeys(found))

    def routes(self) -> list[PlacedRoute]:
        """What is cut and how it is moved between, as `skg.tape.placed.place` has it."""
        found: list[tuple[bool, list[Placed]]] = []
        for item in self.items:
            if isinstance(item, Stop | Drilled):
                found.append((False, []))
                continue
            is_move = isinstance(item, Rapid)
            if not found or found[-1][0] != is_move:
                found.append((is_move, []))
            found[-1][1].append(_placed(item))
        return [PlacedRoute(tuple(blocks), is_move) for is_move, blocks in found if blocks]

    def heights(self) -> str:
        """What there is to say of the heights of cuts, holes and rapids; empty where none is known."""
        holes = [item.depth for item in self.items if isinstance(item, Drilled)]
        deep = list(dict.fromkeys(depth for depth in holes if depth is not None))
        said = [
            f"cuts at {_several(self.depths)}" if self.depths else "",
            f"{_counted_holes(len(holes))} down to {_several(deep)}" if deep else "",
            f"travels at {_several(self.travels)}" if self.travels else "",
        ]
        return ", ".join(filter(None, said))

    def left_out(self) -> tuple[str, ...]:
        """What a 3B tape of the same path has no word for, to be said."""
        holes = sum(isinstance(item, Drilled) for item in self.items)
        said = [
            _counted_holes(holes) if holes else "",
            f"the heights of its cuts, {_several(self.depths)}" if self.depths else "",
        ]
        return (f"left out, as 3B has no word for it: {' and '.join(filter(None, said))}",) if any(said) else ()

    def tape(self) -> Tape:
        """The 3B tape of the same path: a rapid is a move between two stops; holes have no blocks.

        An arc whose end is farther off its circle than a block can be is a `UserError`.
        """
        items: list[Block | Stop] = []
        at, moved_from = self.home, None
        for item in self.items:
            if isinstance(item, Drilled):
                continue
            if isinstance(item, Rapid):
                if moved_from is None:
                    moved_from = at
                    if not items or isinstance(items[-1], Block):
                        items.append(Stop(len(items)))
                at = _grid(item.placed.end)
                continue
            if moved_from is not None:
                items += _between(moved_from, at)
                if not isinstance(item, Stop):
                    items.append(Stop(len(items)))
                moved_from = None
            if isinstance(item, Stop):
                items.append(item)
                continue
            off = 0 if item.is_line else abs(hypot(*_minus(item.end, item.centre)) - item.radius)
            if off > OFF_BLOCK:
                raise UserError(f"{self.name}: block {item.block.number}: the arc's end is {off:.0f} µm off its circle")
            items.append(item.block)
            at = _grid(item.end)
        if moved_from is not None:
            items += _between(moved_from, at)
        return Tape.of(self.name, _counted(items), drift=True)


def _counted_holes(number: int) -> str:
    return f"{number} hole{'s' * (number > 1)}"


def _several(heights: Sequence[Decimal]) -> str:
    """Some heights, or the first and the last of many."""
    words = [f"Z{_millimetres(_rounded_one(height))}" for height in heights]
    return ", ".join(words) if len(words) <= 3 else f"{words[0]} … {words[-1]} ({len(words)} heights)"


def _between(start: Spot, end: Spot) -> list[Block]:
    return [] if start == end else [line_block(*_minus(end, start))]


def _minus(one: tuple[float, float], other: tuple[float, float]) -> tuple[float, float]:
    return one[0] - other[0], one[1] - other[1]


def _placed(item: Placed | Rapid) -> Placed:
    return item.placed if isinstance(item, Rapid) else item


def _counted(items: Iterable[Block | Stop]) -> Iterator[Block | Stop]:
    """Blocks and stops with the numbers that they have on a tape."""
    number = 0
    for item in items:
        if isinstance(item, Stop):
            yield Stop(number)
        else:
            number += 1
            yield Block(item.x, item.y, item.j, item.axis, item.code, number)


class _Misread(Exception):
    def __init__(self, column: int, message: str) -> None:
        super().__init__(message)
        self.column = column


@dataclass(frozen=True)
class _Word:
    letter: str
    number: Decimal
    is_decimal: bool
    column: int


_WORD = re.compile(r"([A-Z])\s*([+-]?(?:\d+\.?\d*|\.\d+))")
_SPACE = re.compile(r"(?:\s|\([^()]*\)|;.*)*")
#: Letters that say nothing of the path; and the G and M words that do not either: a dwell, lengths of tools, path
#: modes, work offsets (one of them, see there); sub-programs are no part of a path.
_SILENT = "FSTPHDL"
_MODES = {
    Decimal(n) for n in ("4", "8", "9", "17", "40", "43", "49", "50", "61", "64", "69", "80", "91.1", "94", "97", "98")
}
_OFFSETS = {Decimal(n) for n in range(54, 60)}
_CALLS = {96, 97, 98, 99}
#: Of the G words of one of these groups a line has one at most: which of two would count differs among controls.
_MOTIONS = set(map(Decimal, range(4)))
_GROUPS = [_MOTIONS, *(set(map(Decimal, group.split())) for group in ("20 21", "90 91", "43 49", "61 64")), _OFFSETS]
#: Words that are places, and what G4 has besides P on some controls.
_PLACES = "XYZIJR"
_DWELL, _NO_MOTION = Decimal(4), Decimal(80)
_KNOWN = "G00…G03, G17, G20, G21, G40, G90, G91, G92 or one that does not move"
#: µm in a number of each unit; None: by the decimal point.
_INCH, _MILLIMETRE = Decimal(25400), Decimal(1000)


class _Reader:
    """State of a program that is being read; places in µm, `height` in the program's own unit."""

    def __init__(self) -> None:
        self.line = 0
        self.at = Decimal(0), Decimal(0)
        self.height: Decimal | None = None
        # (heights that begin with a relative one are from an unknown place)
        self.knows_height = False
        self.depths: dict[Decimal, None] = {}
        self.travels: dict[Decimal, None] = {}
        self.dipped: Spot | None = None
        self.motion: int | None = 0
        self.absolute: bool | None = None
        self.unit: Decimal | None = None
        self.offset: Decimal | None = None
        self.ended = False
        self.blocks = 0
        self.begun = False
        self.home: Spot = (0, 0)
        self.fed = self.warned_unit = False
        # Where a G92 in mid-program has moved the origin of its places to; `at` goes on from the first one.
        self.origin = {"X": Decimal(0), "Y": Decimal(0)}
        self.findings: list[GcodeFinding] = []

    def warn(self, column: int, message: str, is_guess: bool = False) -> None:
        """What can be read, and yet stops a control, or might be meant otherwise."""
        self.findings.append(GcodeFinding(self.line, column, message, is_fatal=False, is_guess=is_guess))

    def words(self, text: str) -> Iterator[_Word]:
        """Split a line into words; comments in parentheses and after `;` are nothing."""
        text = text.upper()
        at = _SPACE.match(text).end()
        while at < len(text):
            match = _WORD.match(text, at)
            if not match:
                raise _Misread(at + 1, f"expected a word such as G01 or X-9900, found {text[at]!r}")
            yield _Word(match[1], Decimal(match[2]), "." in match[2], at + 1)
            at = _SPACE.match(text, match.end()).end()

    def take(self, line: str) -> Iterator[Placed | Rapid | Drilled | Stop]:
        """Carry out one line."""
        self.line += 1
        text = line.strip()
        if len(text) > LONGEST:
            self.warn(LONGEST + 1, f"a line of {len(text)} characters, GRBL takes {LONGEST}")
        if text == "%" or re.fullmatch(r"[Oo]\d+", text):
            self.warn(1, f"GRBL does not know {text[0]}")
            return
        if not text:
            return
        values: dict[str, _Word] = {}
        codes: list[Decimal] = []
        is_origin, stop = False, False
        for word in self.words(line):
            if self.ended:
                raise _Misread(word.column, "expected nothing after M02")
            if word.letter == "G":
                for code in codes:
                    if any({code, word.number} <= group for group in _GROUPS):
                        raise _Misread(word.column, f"G{code:f} and G{word.number:f} in one line")
                codes.append(word.number)
                is_origin |= self.preparatory(word)
            elif word.letter == "M":
                stop |= self.miscellaneous(word)
            elif word.letter in _PLACES + "F":
                if word.letter in values:
                    raise _Misread(word.column, f"{word.letter} stands here twice")
                values[word.letter] = word
            elif word.letter not in "N" + _SILENT:
                raise _Misread(word.column, f"{word.letter} is not known here, expected G, M, X, Y, Z, I, J or R")
        if _NO_MOTION in codes and not _MOTIONS.intersection(codes):
            self.motion = None
        feed = values.pop("F", None)
        if feed:
            self.fed = feed.number > 0
            if not self.fed:
                self.warn(feed.column, "a feed that is not more than 0")
        places = [word for letter, word in values.items() if letter in _PLACES]
        if _DWELL in codes and places:
            raise _Misread(places[0].column, f"{places[0].letter} in a line with G4: a time, or a place to go to?")
        if is_origin:
            self.name_place(values)
        elif values:
            yield from self.move(values)
        if stop:
            self.begun = True
            yield Stop(self.blocks)

    def name_place(self, values: dict[str, _Word]) -> None:
        """G92: the tool's place has these coordinates; what is not named keeps its own."""
        here = dict(zip("XY", self.at, strict=True))
        named = {letter: self.value(values, letter, here[letter] - self.origin[letter]) for letter in "XY"}
        if "Z" in values:
            self.height = self.value(values, "Z", Decimal(0))
        if self.begun:
            self.origin = {letter: here[letter] - named[letter] for letter in "XY"}
        else:
            self.at = named["X"], named["Y"]
            self.home = _rounded(self.at)

    def preparatory(self, word: _Word) -> bool:
        """Carry out a G word; True for G92."""
        match word.number:
            case 0 | 1 | 2 | 3:
                self.motion = int(word.number)
            case 90 | 91:
                self.absolute = word.number == 90
            case 92:
                return True
            case 20 | 21:
                self.unit = _INCH if word.number == 20 else _MILLIMETRE
            case n if n in _OFFSETS:
                if self.offset not in (None, n):
                    raise _Misread(
                        word.column, f"G{n:f} after G{self.offset:f}: how far apart the two are is not known"
                    )
                self.offset = n
            case n if n in _MODES:
                pass
            case n:
                raise _Misread(word.column, f"G{n:f} is not known, expected {_KNOWN}")
        return False

    def miscellaneous(self, word: _Word) -> bool:
        """Carry out an M word; True for a stop."""
        if word.number in (2, 30):
            self.ended = True
        elif word.number in _CALLS:
            raise _Misread(word.column, f"M{word.number:f}: a sub-program is not known here")
        return word.number in (0, 1)

    def value(self, values: dict[str, _Word], letter: str, default: Decimal) -> Decimal:
        """A word's number in µm."""
        word = values.get(letter)
        if word is None:
            return default
        if self.unit is None and not self.warned_unit:
            self.warned_unit = True
            self.warn(word.column, "no G20 or G21 yet: a number with a point is taken for mm, a whole one for µm", True)
        unit = self.unit or (_MILLIMETRE if word.is_decimal else Decimal(1))
        return word.number * unit

    def goal(self, values: dict[str, _Word], letter: str, here: Decimal) -> Decimal:
        """Where a coordinate goes to, µm."""
        if letter not in values:
            return here
        if self.absolute is None:
            self.absolute = True
            self.warn(values[letter].column, "no G90 or G91 yet: places are taken for absolute, as G90 says", True)
        value = self.value(values, letter, Decimal(0))
        return value + self.origin.get(letter, 0) if self.absolute else here + value

    def move(self, values: dict[str, _Word]) -> Iterator[Placed | Rapid | Drilled]:
        """What a block that moves does."""
        column = min(word.column for word in values.values())
        if self.motion is None:
            raise _Misread(column, "a place to go to, and no G00…G03 behind G80")
        cuts = self.motion > 0
        if cuts and not self.fed:
            self.fed = True
            self.warn(column, "cuts, and there has been no F")
        start = _rounded(self.at)
        if "Z" in values:
            yield from self.to_height(self.goal(values, "Z", self.height or Decimal(0)), start, cuts)
        if not values.keys() - {"Z"}:
            return
        goal = tuple(self.goal(values, letter, here) for letter, here in zip("XY", self.at, strict=True))
        end = _rounded(goal)
        if self.knows_height:
            (self.depths if cuts else self.travels)[self.height] = None
        if self.motion < 2:
            if values.keys() & set("IJR"):
                raise _Misread(column, "I, J and R belong to G02 and G03")
            self.at = goal
            if not cuts and not self.begun:
                self.home = end
            elif start != end:
                yield from self.lay(line_block(*_minus(end, start)), start, end, cuts)
            return
        if "R" in values:
            if values.keys() & set("IJ"):
                raise _Misread(column, "an arc has its centre, I and J, or its radius, R, not both")
            to_centre = self.by_radius(_minus(end, start), float(self.value(values, "R", Decimal(0))), column)
        else:
            to_centre = tuple(_rounded_one(self.value(values, letter, Decimal(0))) for letter in "IJ")
        yield from self.arc(start, end, (-to_centre[0], -to_centre[1]), column)
        self.at = goal

    def to_height(self, height: Decimal, place: Spot, cuts: bool) -> Iterator[Drilled]:
        """Up or down: a hole is what is entered and left again."""
        is_down = self.height is None or height < self.height
        before, self.height = self.height, height
        self.knows_height |= bool(self.absolute)
        if is_down and cuts:
            self.dipped = place
        elif not is_down:
            if self.dipped == place:
                self.begun = True
                yield Drilled(place, before if self.knows_height else None)
            self.dipped = None

    def by_radius(self, way: Spot, radius: float, column: int) -> Spot:
        """From an arc's start to its centre, of the way to its end and its radius; below 0: more than half a turn."""
        chord = hypot(*way)
        if not chord:
            raise _Misread(column, "an arc by its radius that ends where it begins")
        if chord / 2 - abs(radius) > OFF_CONTROL:
            raise _Misread(column, f"the arc's ends are {chord / 1000:g} mm apart, more than twice its radius")
        aside = max(radius * radius - chord * chord / 4, 0) ** 0.5 / chord
        if (radius > 0) != (self.motion == 3):
            aside = -aside
        return round(way[0] / 2 - way[1] * aside), round(way[1] / 2 + way[0] * aside)

    def arc(self, start: Spot, end: Spot, from_centre: Spot, column: int) -> Iterator[Placed]:
        xs, ys = from_centre
        if (xs, ys) == (0, 0):
            raise _Misread(column, "an arc needs its centre, I and J")
        to_end = xs + end[0] - start[0], ys + end[1] - start[1]
        radius = hypot(xs, ys)
        off = abs(hypot(*to_end) - radius)
        if off > min(max(OFF_CONTROL, radius / 1000), OFF_MOST):
            raise _Misread(column, f"the arc's end is {off:.0f} µm off the circle through its start")
        sense = 1 if self.motion == 3 else -1
        cross, dot = sense * (xs * to_end[1] - ys * to_end[0]), xs * to_end[0] + ys * to_end[1]
        if start != end and dot > 0 and abs(cross) < LEAST_SWEEP * dot:
            self.warn(column, "an arc so flat that LinuxCNC and GRBL take it for a full circle")
        yield from self.lay(arc_block((xs, ys), to_end, sense), start, end, True)

    def lay(self, block: Block, start: Spot, end: Spot, cuts: bool) -> Iterator[Placed | Rapid]:
        """A block in its place."""
        self.begun = True
        self.dipped = None
        if cuts:
            self.blocks += 1
        numbered = Block(block.x, block.y, block.j, block.axis, block.code, self.blocks)
        placed = Placed.between(numbered, start, end)
        yield placed if cuts else Rapid(placed)


def _rounded_one(value: Decimal) -> int:
    """Whole µm, halves away from zero."""
    return int(value.quantize(Decimal(1), ROUND_HALF_UP))


def _rounded(place: tuple[Decimal, ...]) -> Spot:
    return _rounded_one(place[0]), _rounded_one(place[1])


def scan(text: str, name: str = "-") -> tuple[GcodeProgram, list[GcodeFinding]]:
    """Read a program and everything that is wrong with it; what cannot be read is left out of it."""
    reader = _Reader()
    items: list[Placed | Rapid | Drilled | Stop] = []
    for line in text.splitlines():
        try:
            items += reader.take(line)
        except _Misread as error:
            reader.findings.append(GcodeFinding(reader.line, error.column, str(error)))
    if not reader.ended:
        # (with nothing in front of it, it is no program)
        missing = "expected M02 or M30, found the end of the program"
        reader.findings.append(GcodeFinding(reader.line + 1, 1, missing, is_fatal=not items, is_guess=bool(items)))
    guesses = tuple(str(finding) for finding in reader.findings if finding.is_guess)
    program = GcodeProgram(name, tuple(items), reader.home, tuple(reader.depths), tuple(reader.travels), guesses)
    return program, reader.findings


def read(text: str, name: str = "-") -> GcodeProgram:
    """Return a program; what cannot be read is a `UserError` with line and column, what is guessed is among it."""
    program, findings = scan(text, name)
    for finding in findings:
        if finding.is_fatal:
            raise UserError(f"{name}: {finding}")
    return program
