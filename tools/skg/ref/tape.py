"""The 3B tape, made from true places in integer arithmetic (tape-3b.md)."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import isqrt

from skg.ref import near, real
from skg.ref.fault import Code, Fault
from skg.ref.real import Real
from skg.ref.values import Point

#: The summand, in µm, of a length that is then cut off to whole micrometres.
ROUNDING = Real("0.502")
#: One more than the largest number of 8 digits.
TOO_LONG = 10**8

Grid = tuple[int, int]


def micrometres(value: Real) -> int:
    """A length in mm rounded to the µm: ⌊1000·|v| + 0.502⌋ with the sign of v; error 10 for 100 m or more, 5 where
    1000·|v| is no number."""
    scaled = real.in_range(1000 * abs(value)) + ROUNDING
    size = int(real.mp.floor(scaled))
    near.note("rounding", scaled - real.mp.nint(scaled), 1e-3)
    if size >= TOO_LONG:
        raise Fault(Code.TAPE)
    return size if value >= 0 else -size


def grid(p: Point) -> Grid:
    """A place in whole micrometres."""
    return micrometres(p.x), micrometres(p.y)


def quadrant_into(x: int, y: int) -> int:
    """Quadrant that a counter-clockwise move from direction (x, y) goes into: 1 for 0° ≤ it < 90°, …"""
    if x > 0 and y >= 0:
        return 1
    if y > 0:
        return 2
    return 3 if x < 0 else 4


def quadrant_out_of(x: int, y: int) -> int:
    """Quadrant that a counter-clockwise move to direction (x, y) comes out of: 1 for 0° < it ≤ 90°, …"""
    return 5 - quadrant_into(x, -y)


def line_block(dx: int, dy: int) -> str:
    """The block of a straight move, which is not zero."""
    x, y = abs(dx), abs(dy)
    axis = "Y" if y > x or (x == y and dx * dy > 0) else "X"
    return block(x, y, max(x, y), axis, f"L{quadrant_into(dx, dy)}")


def block(x: int, y: int, j: int, axis: str, z: str) -> str:
    """A block; error 10 when a number has more than 8 digits."""
    if max(x, y, j) >= TOO_LONG:
        raise Fault(Code.TAPE)
    return f"B{x}B{y}B{j}G{axis}{z}"


def arc_block(start: Grid, end: Grid, clockwise: bool, true_sweep: Real) -> str | None:
    """The block of an arc from its ends relative to its rounded centre, or None where it goes as a line.

    `true_sweep` is in radians, positive, 2π for a full circle. A clockwise arc is counted as its
    counter-clockwise image about the X axis: the travel along each axis is the same.
    """
    (xs, ys), (xe, ye) = start, end
    if clockwise:
        ys, ye = -ys, -ye
    turns = full_turns((xs, ys), (xe, ye), true_sweep)
    if turns is None:
        return None
    axis = "Y" if abs(xe) > abs(ye) else "X"
    travel = _travel((xs, ys), (xe, ye), turns, axis)
    if travel == 0:
        return None
    quadrant = quadrant_into(xs, ys)
    z = f"SR{5 - quadrant}" if clockwise else f"NR{quadrant}"
    return block(abs(xs), abs(ys), travel, axis, z)


def full_turns(start: Grid, end: Grid, true_sweep: Real) -> int | None:
    """Full turns that a counter-clockwise arc makes besides the way from start to end, relative to its rounded centre.

    0 or 1; None where it goes out as a line: an end in the centre, or a rounded sweep that is not positive.
    """
    (xs, ys), (xe, ye) = start, end
    if (xs, ys) == (0, 0) or (xe, ye) == (0, 0):
        return None
    cross, dot = xs * ye - ys * xe, xs * xe + ys * ye
    rounded = real.mp.atan2(cross, dot) % (2 * real.mp.pi)
    turns = _nearest_turns(rounded, true_sweep)
    if turns < 0 or (turns == 0 and cross == 0 and dot > 0):
        return None
    return turns


def _nearest_turns(rounded: Real, true_sweep: Real) -> int:
    """Number of full turns that brings the rounded values' sweep nearest to the true one: -1, 0 or 1."""
    full = 2 * real.mp.pi
    misses = sorted((abs(rounded + n * full - true_sweep), n) for n in (-1, 0, 1))
    near.note("sweep", misses[1][0] - misses[0][0], 1e-6)
    return misses[0][1]


def _travel(start: Grid, end: Grid, turns: int, axis: str) -> int:
    """J: the travel along one axis, counter-clockwise, with `turns` full turns added (0 or 1)."""
    (xs, ys), (xe, ye) = start, end
    radius = (isqrt(4 * (xs * xs + ys * ys)) + 1) // 2
    quadrant = quadrant_into(xs, ys)
    cross, dot = xs * ye - ys * xe, xs * xe + ys * ye
    crossed = (quadrant_out_of(xe, ye) - quadrant) % 4
    if cross == 0 and dot > 0:
        crossed = 0  # the same direction; an axis that both lie on is not extreme in the counted coordinate
    elif crossed == 0 and cross < 0:
        crossed = 4
    # The axis crossings' values of the counted coordinate, in the order 90°, 180°, 270°, 360°.
    extremes = (None, -radius, None, radius) if axis == "X" else (radius, None, -radius, None)
    ordinate, last = (xs, xe) if axis == "X" else (ys, ye)
    total = 0
    for i in range(crossed + 4 * turns):
        extreme = extremes[(quadrant - 1 + i) % 4]
        if extreme is not None:
            total += abs(extreme - ordinate)
            ordinate = extreme
    return total + abs(last - ordinate)


@dataclass
class Punch:
    """Blocks in the order of punching; keeps the place of the wire in whole micrometres."""

    position: Grid = (0, 0)
    lines: list[str] = field(default_factory=list)

    def place(self, p: Point) -> None:
        """Take the wire to be at p without a block."""
        self.position = grid(p)

    def check_move(self, end: Point) -> None:
        """Error 10 when the straight move to a place does not fit in a block."""
        x, y = grid(end)
        line_block(x - self.position[0], y - self.position[1])

    def line(self, end: Point) -> None:
        """A straight move; nothing when the rounded ends coincide."""
        self._line(grid(end))

    def _line(self, end: Grid) -> None:
        dx, dy = end[0] - self.position[0], end[1] - self.position[1]
        if dx or dy:
            self.lines.append(line_block(dx, dy))
        self.position = end

    def arc(self, end: Point, centre: Point, clockwise: bool, sweep: Real) -> None:
        """An arc of a true sweep in radians; where the rounded values make none of it, a straight move."""
        last, middle = grid(end), grid(centre)
        xs, ys = self.position[0] - middle[0], self.position[1] - middle[1]
        if last == self.position:
            near.note("sweep", sweep - real.mp.pi, 1e-6)
            if sweep > real.mp.pi:
                self._full_circle(xs, ys, clockwise)
            return
        block = arc_block((xs, ys), (last[0] - middle[0], last[1] - middle[1]), clockwise, sweep)
        if block is None:
            self._line(last)
        else:
            self.lines.append(block)
            self.position = last

    def _full_circle(self, xs: int, ys: int, clockwise: bool) -> None:
        block = arc_block((xs, ys), (xs, ys), clockwise, 2 * real.mp.pi)
        if block is not None:
            self.lines.append(block)

    def stop(self) -> None:
        """`D`: the controller stops."""
        self.lines.append("D")

    def end(self) -> None:
        """`DD`: end of the tape."""
        self.lines.append("DD")

    def bytes(self) -> bytes:
        """The tape as it is punched."""
        return "".join(line + "\r\n" for line in self.lines).encode("ascii")
