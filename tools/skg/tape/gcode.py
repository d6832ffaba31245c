"""ISO G-code as it is written: the dialect of the milling ROM (milling.md, section "The tape"), which LinuxCNC and GRBL
take as it is. `skg.tape.gcode_reader` reads it, and others' dialects."""

from __future__ import annotations

from decimal import Decimal
from math import pi
from typing import TYPE_CHECKING

from skg.tape.block import Tape

if TYPE_CHECKING:
    from skg.tape.layout import Placed

#: A place, or a cutting and a travel height, µm.
Spot = tuple[int, int]

#: Endings of the names of G-code files.
ENDINGS = (".nc", ".ngc", ".gcode", ".tap", ".iso")
#: The first block: plane XY, millimetres, absolute places, feed in mm/min.
PREAMBLE = "G17G21G90G94"
LAST_NUMBER = 9999


def is_gcode(name: str) -> bool:
    """Tell whether a file holds G-code, by its name."""
    return name.lower().endswith(ENDINGS)


class _GcodeWriter:
    """Blocks in the order of writing; keeps the place and height of the tool in whole µm, and the last F."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.spot: Spot | None = None
        self.height: int | None = None
        self.feed = ""
        self.block(PREAMBLE)

    def block(self, words: str) -> None:
        self.lines.append(f"N{len(self.lines) % LAST_NUMBER + 1}{words}")

    def rapid(self, end: Spot) -> None:
        if end != self.spot:
            self.block(f"G0{_pair('XY', end)}")
            self.spot = end

    def to_height(self, g: int, height: int, feed: str = "") -> None:
        if height != self.height:
            self.block(f"G{g}Z{millimetres(height)}{self._fed(feed)}")
            self.height = height

    def line(self, end: Spot, feed: str) -> None:
        if end != self.spot:
            self.block(f"G1{_pair('XY', end)}{self._fed(feed)}")
            self.spot = end

    def arc(self, end: Spot, centre: Spot, sense: int, feed: str) -> None:
        to_centre = centre[0] - self.spot[0], centre[1] - self.spot[1]
        self.block(f"G{3 if sense > 0 else 2}{_pair('XY', end)}{_pair('IJ', to_centre)}{self._fed(feed)}")
        self.spot = end

    def _fed(self, feed: str) -> str:
        if not feed or feed == self.feed:
            return ""
        self.feed = feed
        return f"F{feed}"


def millimetres(micrometres: int) -> str:
    """Whole µm as a word of a tape has them: millimetres without zeros behind."""
    whole, rest = divmod(abs(micrometres), 1000)
    sign = "-" if micrometres < 0 else ""
    return f"{sign}{whole}.{rest:03}".rstrip("0") if rest else f"{sign}{whole}"


def _pair(letters: str, values: Spot) -> str:
    return "".join(f"{letter}{millimetres(value)}" for letter, value in zip(letters, values, strict=True))


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
    from skg.tape.layout import place  # which loads numpy

    plane, down = map(decimal, feeds)
    writer = _GcodeWriter()
    routes = iter(place(tape, start, positions))
    stretches, moves = tape.stretches(), tape.positioning()
    if heights:
        writer.to_height(0, heights[1])
    writer.rapid(start)
    for index, (blocks, is_move) in enumerate(zip(stretches, moves, strict=True)):
        if index and not (heights and (is_move or moves[index - 1])):
            writer.block("M0")
        for placed in next(routes).blocks if blocks else ():
            if is_move:
                if heights:
                    writer.to_height(0, heights[1])
                writer.rapid(grid(placed.end))
                continue
            if heights:
                writer.to_height(1, heights[0], down)
            _cut(writer, placed, plane)
    if heights:
        writer.to_height(0, heights[1])
    writer.block("M30")
    return "".join(f"{line}\r\n" for line in writer.lines)


def _cut(writer: _GcodeWriter, placed: Placed, feed: str) -> None:
    """A block that cuts; as a line an arc with an end at its centre, or so flat that a control might take it for a full
    circle (milling.md)."""
    end, turns = grid(placed.end), abs(placed.sweep)
    if not placed.is_line and turns > 2 * pi - 1e-9:
        # Round once, and the few µm by which a block goes on.
        writer.arc(writer.spot, grid(placed.centre), placed.block.sense, feed)
        writer.line(end, feed)
        return
    (dx, dy), (x, y) = minus(end, writer.spot), placed.block.start
    is_flat = turns <= pi and (dx * dx + dy * dy) ** 2 <= 4 * (x * x + y * y)
    if placed.is_line or is_flat or grid(placed.centre) in (writer.spot, end):
        writer.line(end, feed)
    else:
        writer.arc(end, grid(placed.centre), placed.block.sense, feed)


def grid(place: tuple[float, float]) -> Spot:
    """A place in whole µm."""
    return round(place[0]), round(place[1])


def minus(end: tuple[float, float], start: tuple[float, float]) -> tuple[float, float]:
    """The vector from the start to the end."""
    return end[0] - start[0], end[1] - start[1]
