"""ISO G-code as it is written, in a `GcodeDialect`. `skg.tape.gcode_reader` reads it, and more."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from decimal import Decimal
from math import atan2, ceil, hypot, pi
from typing import TYPE_CHECKING

from skg.geometry.plane import polar
from skg.tape.block import Tape, micrometres
from skg.tape.dialect import LINE_ENDS, MILL, GcodeDialect

if TYPE_CHECKING:
    from skg.tape.layout import Placed

#: A place, or a cutting and a travel height, µm.
Spot = tuple[int, int]

#: Endings of the names of G-code files.
ENDINGS = (".nc", ".ngc", ".gcode", ".tap", ".iso")
LAST_NUMBER = 9999


def is_gcode(name: str) -> bool:
    """Tell whether a file holds G-code, by its name."""
    return name.lower().endswith(ENDINGS)


class GcodeWriter:
    """Blocks in the order of writing; keeps the place and height of the tool in whole µm, and the last F."""

    def __init__(self, dialect: GcodeDialect) -> None:
        self.dialect = dialect
        self.lines: list[str] = []
        self.spot: Spot | None = None
        self.height: int | None = None
        self.feed = ""

    @property
    def here(self) -> Spot:
        """The tool's place, once it has one."""
        assert self.spot is not None, "a program begins at a place"
        return self.spot

    @property
    def text(self) -> str:
        """The program."""
        end = LINE_ENDS[self.dialect.line_end]
        return "".join(f"{line}{end}" for line in self.lines)

    def block(self, *words: str) -> None:
        """Add a block."""
        number = [f"N{len(self.lines) % LAST_NUMBER + 1}"] * self.dialect.numbers
        self.lines.append((" " if self.dialect.space else "").join([*number, *filter(None, words)]))

    def all_of(self, lines: Iterable[str]) -> None:
        """Add lines of the dialect."""
        for line in lines:
            self.block(line)

    def begin(self, spot: Spot) -> None:
        """Begin at a place."""
        start = self.dialect.start
        if not any("{x}" in line for line in start):
            self.rapid(spot)
        self.spot = spot
        x, y = map(self.dialect.length, spot)
        self.all_of(line.replace("{x}", x).replace("{y}", y) for line in start)

    def rapid(self, end: Spot) -> None:
        """Go to a place."""
        if end != self.spot:
            self.block(self.dialect.rapid, *self._goal(end))
            self.spot = end

    def to_height(self, g: int, height: int, feed: str = "") -> None:
        """Go up or down."""
        if height != self.height:
            self.block(f"G{g}", f"Z{self.dialect.length(height)}", self._fed(feed))
            self.height = height

    def line(self, end: Spot, feed: str) -> None:
        """Cut straight to a place."""
        if end != self.spot:
            self.block(self.dialect.line, *self._goal(end), self._fed(feed))
            self.spot = end

    def arc(self, end: Spot, centre: Spot, sense: int, feed: str) -> None:
        """Cut along an arc to a place; one that is told by its radius, and is no less than half a circle, in pieces."""
        for place in self._ends(end, centre, sense) if self.dialect.arcs == "r" else [end]:
            word = self.dialect.counterclockwise if sense > 0 else self.dialect.clockwise
            goal, to_centre = self._goal(place), minus(centre, self.here)
            match self.dialect.arcs:
                case "r":
                    how = [f"R{self.dialect.length(round(hypot(*to_centre)))}"]
                case "ij-absolute":
                    how = self._pair("IJ", centre)
                case _:
                    how = self._pair("IJ", to_centre)
            self.block(word, *goal, *how, self._fed(feed))
            self.spot = place

    def drill(self, holes: Sequence[Spot], depth: int, clear: int, feed: str) -> None:
        """Drill holes by a cycle, G81, from a height down to another (µm), and up to the first again."""
        for number, hole in enumerate(holes):
            cycle = ["G99", "G81"] if number == 0 else []
            heights = [f"{letter}{self.dialect.length(height)}" for letter, height in (("Z", depth), ("R", clear))]
            self.block(*cycle, *self._goal(hole), *(heights if cycle else []), self._fed(feed) if cycle else "")
            self.spot = hole
        self.block("G80")

    def _ends(self, end: Spot, centre: Spot, sense: int) -> list[Spot]:
        """The ends of quarters of a circle, at most, that make an arc."""
        (x, y), (u, v) = minus(self.here, centre), minus(end, centre)
        radius, first = hypot(x, y), atan2(y, x)
        sweep = sense * (atan2(v, u) - first) % (2 * pi) or 2 * pi
        count = ceil(sweep / (pi / 2) - 1e-9)
        angles = [first + sense * sweep * number / count for number in range(1, count)]
        return [*(grid(polar(centre, radius, angle)) for angle in angles), end]

    def _goal(self, end: Spot) -> list[str]:
        if self.dialect.places == "relative" and self.spot is not None:
            # (what rounding leaves goes into the next block)
            rounded = self.dialect.rounded
            end = minus((rounded(end[0]), rounded(end[1])), (rounded(self.spot[0]), rounded(self.spot[1])))
        return self._pair("XY", end)

    def _pair(self, letters: str, values: Spot) -> list[str]:
        return [f"{letter}{self.dialect.length(value)}" for letter, value in zip(letters, values, strict=True)]

    def _fed(self, feed: str) -> str:
        if not feed or feed == self.feed:
            return ""
        self.feed = feed
        return self.dialect.feed.replace("{feed}", feed)


def millimetres(micrometres: int) -> str:
    """Whole µm as millimetres without zeros behind."""
    return MILL.length(micrometres)


def decimal(value: float) -> str:
    """A feed as the tape has it: at most 8 significant digits, no exponent."""
    return f"{Decimal(f'{value:.8g}'):f}"


def write(
    tape: Tape,
    start: Spot = (0, 0),
    feeds: tuple[float, float] = (100.0, 100.0),
    heights: Spot | None = None,
    positions: str = "auto",
    dialect: GcodeDialect = MILL,
) -> str:
    """Return the G-code of a 3B tape whose wire begins at `start` (µm).

    `feeds` are mm/min in the plane and downwards. With `heights`, cutting and travel height in µm, a re-positioning
    between two stops is an up, a rapid and a down; without them it is a rapid between two of the dialect's stops.
    `positions` is one of `skg.tape.positions.POSITIONS`.
    """
    from skg.tape.layout import place  # which loads numpy

    plane, down = map(decimal, feeds)
    writer = GcodeWriter(dialect)
    routes = iter(place(tape, start, positions))
    stretches, moves = tape.stretches(), tape.positioning()
    writer.all_of(dialect.head)
    if heights:
        writer.to_height(0, heights[1])
    writer.begin(start)
    # (what does not move is no positioning: the wire stays in)
    is_way = [is_move and bool(blocks) for blocks, is_move in zip(stretches, moves, strict=True)]
    for index, (blocks, is_move) in enumerate(zip(stretches, moves, strict=True)):
        if index and not (heights and (is_move or moves[index - 1])):
            writer.all_of(dialect.unthread if is_way[index] else dialect.thread if is_way[index - 1] else dialect.stop)
        placed_blocks = next(routes).blocks if blocks else ()
        if placed_blocks and not is_move:
            writer.all_of(dialect.begin)
        for placed in placed_blocks:
            if is_move:
                if heights:
                    writer.to_height(0, heights[1])
                writer.rapid(grid(placed.end))
                continue
            if heights:
                writer.to_height(1, heights[0], down)
            _cut(writer, placed, plane)
        if placed_blocks and not is_move:
            writer.all_of(dialect.end)
    if heights:
        writer.to_height(0, heights[1])
    writer.all_of(dialect.foot)
    return writer.text


def drilling(holes: Sequence[Spot], depth: int, clear: int, feed: float, note: str) -> str:
    """Return the program that drills holes (µm) to a depth below Z 0, from a height above it; `feed`: mm/min; `note`: a
    comment at its head."""
    writer = GcodeWriter(MILL)
    writer.block(f"({note})")
    writer.all_of(MILL.head)
    writer.to_height(0, clear)
    writer.drill(holes, depth, clear, decimal(feed))
    writer.all_of(MILL.foot)
    return writer.text


def _cut(writer: GcodeWriter, placed: Placed, feed: str) -> None:
    """A block that cuts; as a line an arc with an end at its centre, or so flat that a control might take it for a full
    circle (milling.md)."""
    end, turns = grid(placed.end), abs(placed.sweep)
    centre = None if placed.centre is None else grid(placed.centre)
    if centre and turns > 2 * pi - 1e-9:
        # Round once, and the few µm by which a block goes on.
        writer.arc(writer.here, centre, placed.block.sense, feed)
        writer.line(end, feed)
        return
    (dx, dy), (x, y) = minus(end, writer.here), placed.block.start
    is_flat = turns <= pi and (dx * dx + dy * dy) ** 2 <= 4 * (x * x + y * y)
    if centre is None or is_flat or centre in (writer.here, end):
        writer.line(end, feed)
    else:
        writer.arc(end, centre, placed.block.sense, feed)


def grid(place: tuple[float, float]) -> Spot:
    """A place in whole µm."""
    return round(place[0]), round(place[1])


def spot(place: tuple[float, float]) -> Spot:
    """A place in mm in whole µm, rounded as places on a tape are."""
    return micrometres(place[0]), micrometres(place[1])


def minus(end: Spot, start: Spot) -> Spot:
    """The vector from the start to the end."""
    return end[0] - start[0], end[1] - start[1]
