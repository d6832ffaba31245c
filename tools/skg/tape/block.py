"""The blocks of a 3B tape and their geometry, all in whole micrometres.

A block is ``B x B y B J G Z`` (tape-3b.md, sections "Line" and "Arc"); how the end of an arc follows from J stands in
docs/tools.md, section "The controller". Everything here is exact integer arithmetic: two tools that read one tape
always see the same points.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import zip_longest
from math import atan2, copysign, floor, hypot, isqrt, pi
from typing import Any

from skg.messages.finding import Finding, Phrase

#: No x, y or J has more digits.
MAX_DIGITS = 8
#: Most that an arc may go on past a full circle, as its ends are rounded (tape-3b.md) or the controller's position.
MAX_OVERLAP = 4
CODES = tuple(f"{kind}{quadrant}" for kind in ("L", "NR", "SR") for quadrant in range(1, 5))
#: Signs of x and y in quadrants 1 to 4 (index 0 is unused).
_SIGNS = ((0, 0), (1, 1), (-1, 1), (-1, -1), (1, -1))
#: Parts of a code: the quadrant, the sense, and the signs of the block's start (a line's is its origin).
_QUADRANTS = {code: int(code[-1]) for code in CODES}
_SENSES = {code: {"L": 0, "N": 1, "S": -1}[code[0]] for code in CODES}
_STARTS = {code: _SIGNS[_QUADRANTS[code] if _SENSES[code] else 0] for code in CODES}


def round_sqrt(square: int) -> int:
    """Return the square root of a non-negative integer, rounded to the nearest integer, exactly."""
    return (isqrt(4 * square) + 1) // 2


def is_decreasing(axis: str, quadrant: int, sense: int) -> bool:
    """Tell whether the distance from the centre along `axis` shrinks on an arc in `quadrant`.

    Counter-clockwise (sense 1) that is x in the odd quadrants and y in the even ones; clockwise the reverse.
    """
    shrinking = "X" if (quadrant % 2 == 1) == (sense > 0) else "Y"
    return axis == shrinking


def next_quadrant(quadrant: int, sense: int) -> int:
    """Return the quadrant that an arc of the given sense enters when it leaves `quadrant`."""
    return (quadrant - 1 + sense) % 4 + 1


@dataclass(frozen=True, slots=True)
class Block:
    """One block as it stands on the tape.

    `x`, `y`, `j` are micrometres; `axis` is the count direction, "X" or "Y"; `code` one of `CODES`;
    `number` the block's number on its tape, counted from 1 (0: not on a tape yet).
    """

    x: int
    y: int
    j: int
    axis: str
    code: str
    number: int = field(default=0, compare=False)
    #: An arc's end and sweep, once they were asked for.
    _end: tuple[int, int] | None = field(default=None, init=False, compare=False, repr=False)
    _sweep: float | None = field(default=None, init=False, compare=False, repr=False)

    def __str__(self) -> str:
        return f"B{self.x}B{self.y}B{self.j}G{self.axis}{self.code}"

    @property
    def is_line(self) -> bool:
        """True for L1 to L4."""
        return self.code[0] == "L"

    @property
    def quadrant(self) -> int:
        """The quadrant a line points into, or the one an arc moves into from its start."""
        return _QUADRANTS[self.code]

    @property
    def sense(self) -> int:
        """0 for a line, 1 for a counter-clockwise arc (NR), −1 for a clockwise one (SR)."""
        return _SENSES[self.code]

    @property
    def start(self) -> tuple[int, int]:
        """Start of the block: of a line (0, 0), of an arc relative to its centre."""
        sign_x, sign_y = _STARTS[self.code]
        return sign_x * self.x, sign_y * self.y

    @property
    def radius(self) -> int:
        """An arc's radius rounded to the µm, as J counts it."""
        return round_sqrt(self.x**2 + self.y**2)

    @property
    def is_arc(self) -> bool:
        """True for an arc that is no full circle."""
        return not self.is_line and not self.is_full_circle

    @property
    def across(self) -> int:
        """The axis that the block does not count: 0 for x, 1 for y."""
        return 0 if self.axis == "Y" else 1

    @property
    def turn(self) -> int:
        """Coordinate at which the controller passes an axis on an arc: the least whole number whose square + 1 is x² +
        y² or more. A tape without drift counts it as the radius (docs/drift.md).
        """
        square = self.x**2 + self.y**2 - 1
        return isqrt(square - 1) + 1 if square > 0 else 0

    @property
    def is_full_circle(self) -> bool:
        """True for an arc that counts four radii."""
        if self.is_line or self.j % 4:
            return False
        # (both counts of the radius are near the root of x² + y²)
        radius = self.j // 4
        return abs(radius**2 - self.x**2 - self.y**2) <= 2 * radius + 1 and radius in (self.radius, self.turn)

    def count_end(self, radius: int | None = None) -> tuple[int, int]:
        """Return (distance from the centre along the count axis, quadrant) of an arc's end.

        The distance shrinks to 0 or grows to the rounded radius (or the `radius` given) in each quadrant in turn until
        J is used up.
        """
        radius = self.radius if radius is None else radius
        distance = self.x if self.axis == "X" else self.y
        quadrant, left = self.quadrant, self.j
        while True:
            shrinks = is_decreasing(self.axis, quadrant, self.sense)
            room = distance if shrinks else radius - distance
            if left <= room:
                return distance - left if shrinks else distance + left, quadrant
            left -= room
            distance = 0 if shrinks else radius
            quadrant = next_quadrant(quadrant, self.sense)

    @property
    def end(self) -> tuple[int, int]:
        """Intended end of the block, relative to the same origin as `start`.

        On an arc J gives the coordinate along the count axis exactly; the other one is the nearest µm on the
        circle, but not so near 0 that the count direction would be the other one (a tape rounds ends off
        their circle by up to a micrometre, and its rule for G looks at the rounded end).
        """
        if self.is_line:
            sign_x, sign_y = _SIGNS[self.quadrant]
            return sign_x * self.x, sign_y * self.y
        end = self._end
        if end is None:
            end = self._arc_end()
            object.__setattr__(self, "_end", end)
        return end

    def _arc_end(self) -> tuple[int, int]:
        if self.is_full_circle:
            return self.start
        distance, quadrant = self.count_end()
        other = self._beside(distance)
        least = distance if self.axis == "X" else distance + 1
        if least - 2 <= other < least:
            other = least
        sign_x, sign_y = _SIGNS[quadrant]
        x, y = (distance, other) if self.axis == "X" else (other, distance)
        return sign_x * x, sign_y * y

    @property
    def move(self) -> tuple[int, int]:
        """From start to end, (dx, dy)."""
        (xs, ys), (xe, ye) = self.start, self.end
        return xe - xs, ye - ys

    @property
    def sweep(self) -> float:
        """An arc's signed sweep in radians, 0 for a line; a full circle is ±2π."""
        if self.is_line:
            return 0.0
        sweep = self._sweep
        if sweep is None:
            sweep = self._arc_sweep()
            object.__setattr__(self, "_sweep", sweep)
        return sweep

    def _arc_sweep(self) -> float:
        if self.is_full_circle:
            return 2 * pi * self.sense
        (xs, ys), (xe, ye) = self.start, self.end
        turn = self.sense * (atan2(ye, xe) - atan2(ys, xs)) % (2 * pi)
        # An end rounded to just behind the start of a short arc is no full turn, nor is the reverse.
        quarters = (self.count_end()[1] - self.quadrant) * self.sense % 4
        if quarters == 0 and turn > 3 * pi / 2 and self.j < 2 * self.radius:
            turn = 0.0
        if quarters == 0 and turn < pi / 2 and self.j > 2 * self.radius:
            turn += 2 * pi
        return self.sense * turn

    @property
    def length(self) -> float:
        """Length of the programmed line or arc in micrometres."""
        return hypot(self.x, self.y) * (1 if self.is_line else abs(self.sweep))

    def problems(self, positions: str = "auto") -> list[Finding]:
        """Return the errors of this block; empty when it is sound.

        `positions`: "programmed" on a tape with drift, "machine" on one without, which count J in their own way
        (docs/drift.md); "auto": either is right.
        """
        if self.x == 0 and self.y == 0:
            return [Finding("block-nowhere")]
        return self._line_problems() if self.is_line else self._arc_problems(positions)

    def _beside(self, distance: int) -> int:
        """The other coordinate of a place on an arc's circle, to the nearest µm, without its sign."""
        return round_sqrt(max(0, self.x**2 + self.y**2 - distance**2))

    def _line_problems(self) -> list[Finding]:
        problems = []
        along = ("x", self.x) if self.quadrant % 2 else ("y", self.y)
        if along[1] == 0:
            problems.append(Finding("block-quadrant", word=self.code, side=along[0]))
        longer = max(self.x, self.y)
        if self.j != longer:
            problems.append(Finding("line-j-less" if self.j < longer else "line-j-more", j=self.j, longer=longer))
        axis = _line_axis(self.x, self.y, self.quadrant)
        if self.axis != axis:
            problems.append(Finding("line-axis", axis=self.axis, expected=axis))
        return problems

    def _arc_problems(self, positions: str) -> list[Finding]:
        problems = []
        # The coordinate that shrinks in a quadrant cannot be 0 at the start: that is the next quadrant.
        axis = "X" if is_decreasing("X", self.quadrant, self.sense) else "Y"
        if (self.x if axis == "X" else self.y) == 0:
            problems.append(Finding("block-quadrant", word=self.code, side=axis.lower()))
        counts = {"programmed": [self.radius], "machine": [max(self.turn, 1)]}
        radii = counts.get(positions, [self.radius, max(self.turn, 1)])
        if self.j == 0:
            problems.append(Finding("arc-j-zero"))
        elif self.j > 4 * max(self.radius, self.turn) + MAX_OVERLAP:
            problems.append(Finding("arc-j-beyond", j=self.j, full=4 * self.radius))
        elif self.is_full_circle:
            if self.j not in [4 * radius for radius in radii]:
                problems.append(Finding("arc-j-other-count", j=self.j, expected=4 * radii[0]))
        else:
            # The counts of a tape without drift differ by up to 4 (docs/drift.md): one of the two must fit.
            ends = [self.count_end(radius)[0] for radius in radii]
            if all(distance > self._beside(distance) + 3 for distance in ends):
                axis = "Y" if self.axis == "X" else "X"
                problems.append(Finding("arc-axis", j=self.j, side=self.axis.lower(), end=ends[0], expected=axis))
        return problems


@dataclass(frozen=True)
class Stop:
    """A `D`: the controller stops after so many blocks."""

    after: int


@dataclass(frozen=True)
class Tape:
    """A tape: its blocks, and its stops in order; `name` is where it came from.

    `drift`: whether it is a tape with drift, None when it does not say so; `drift_by` is what says so (None: it
    was made just now). `notes`: what there is to say of how it was read. `start`: where the wire starts on the
    drawing, mm. `kept`: what was worked out of the blocks (`skg.tape.columns.kept`).
    """

    name: str
    blocks: Sequence[Block]
    stops: tuple[Stop, ...] = ()
    drift: bool | None = None
    drift_by: Phrase | None = None
    notes: tuple[Finding, ...] = ()
    start: tuple[float, float] = (0.0, 0.0)
    kept: dict[str, Any] = field(default_factory=dict, compare=False, repr=False)

    @classmethod
    def of(cls, name: str, items: Iterable[Block | Stop], **fields: Any) -> Tape:  # noqa: ANN401
        """The tape of blocks and stops one after the other, with other fields of it."""
        blocks: list[Block] = []
        stops: list[Stop] = []
        for item in items:
            if isinstance(item, Stop):
                stops.append(Stop(len(blocks)))
            else:
                blocks.append(item)
        return cls(name, blocks, tuple(stops), **fields)

    @property
    def items(self) -> Iterator[Block | Stop]:
        """Blocks and stops, one after the other."""
        for stop, (first, last) in zip_longest(self.stops, self.bounds):
            yield from self.blocks[first:last]
            if stop:
                yield stop

    @cached_property
    def bounds(self) -> list[tuple[int, int]]:
        """For each of `stretches` which of all blocks it is: the first, and the one behind the last, from 0."""
        ends = [*(stop.after for stop in self.stops), len(self.blocks)]
        return list(zip([0, *ends], ends, strict=False))

    def stretches(self) -> list[Sequence[Block]]:
        """Return the blocks between stops; none where two stops follow each other."""
        return [self.blocks[first:last] for first, last in self.bounds]

    def positioning(self) -> list[bool]:
        """Tell for each of `stretches` whether it is positioning, with the wire out, and no cut.

        A re-positioning is a stop, at most one straight move and another stop (language.md, section 3), so on a tape
        of such every second stretch is one, and what stands between two of them is cut, a single line too. Any other
        tape does not tell: a single line between two stops is taken for positioning.
        """
        stretches = self.stretches()
        is_straight = [not blocks or (len(blocks) == 1 and blocks[0].is_line) for blocks in stretches]
        if all(is_straight[1:-1:2]):
            return [index % 2 == 1 and index < len(stretches) - 1 for index in range(len(stretches))]
        return [
            bool(blocks) and is_straight[index] and 0 < index < len(stretches) - 1
            for index, blocks in enumerate(stretches)
        ]


def micrometres(length: float) -> int:
    """A length in mm as whole µm, rounded as places on a tape are (tape-3b.md): ⌊1000·|v| + 0.502⌋, with v's sign."""
    return int(copysign(floor(1000 * abs(length) + 0.502), length))


def _line_axis(x: int, y: int, quadrant: int) -> str:
    """The count direction of a line: the longer axis, on a diagonal Y in the odd quadrants, X in the even."""
    if x == y:
        return "Y" if quadrant % 2 else "X"
    return "X" if x > y else "Y"


def line_block(dx: int, dy: int) -> Block:
    """Return the block of a straight move of (dx, dy) µm; (0, 0) is a `ValueError`."""
    if dx > 0 and dy >= 0:
        quadrant = 1
    elif dy > 0:
        quadrant = 2
    elif dx < 0:
        quadrant = 3
    elif dy < 0:
        quadrant = 4
    else:
        raise ValueError("a line of no length has no block")
    x, y = abs(dx), abs(dy)
    return Block(x, y, max(x, y), _line_axis(x, y, quadrant), f"L{quadrant}")


def start_quadrant(x: int, y: int, sense: int) -> int:
    """Return the quadrant that an arc moves into from (x, y), taken relative to its centre."""
    if sense < 0:
        # Clockwise is counter-clockwise seen in the mirror x = y, which swaps quadrants 2 and 4.
        return (0, 1, 4, 3, 2)[start_quadrant(y, x, 1)]
    if x > 0 and y >= 0:
        return 1
    if y > 0:
        return 2
    return 3 if x < 0 else 4


def arc_block(start: tuple[int, int], end: tuple[int, int], sense: int) -> Block:
    """Return the block of an arc from `start` to `end`, both relative to its centre, in µm.

    `sense` is 1 counter-clockwise, −1 clockwise; equal ends are a full circle. An arc too short to count
    (J = 0) goes out as the line between its ends.
    """
    (xs, ys), (xe, ye) = start, end
    axis = "X" if abs(xe) <= abs(ye) else "Y"
    quadrant = start_quadrant(xs, ys, sense)
    code = f"{'N' if sense > 0 else 'S'}R{quadrant}"
    if start == end:
        return Block(abs(xs), abs(ys), 4 * round_sqrt(xs**2 + ys**2), axis, code)
    radius = round_sqrt(xs**2 + ys**2)
    distance, goal = (abs(xs), abs(xe)) if axis == "X" else (abs(ys), abs(ye))
    # The end belongs to the quadrant that it is moved into against the arc's sense.
    last = start_quadrant(xe, ye, -sense)
    ahead = sense * (xs * ye - ys * xe)
    same = xs * xe + ys * ye
    near = max(abs(xe - xs), abs(ye - ys)) <= 1
    if same > 0 and (ahead == 0 or (ahead < 0 and near)):
        # An end a hair behind the start is a short arc that rounding turned back: it goes out as a line.
        return line_block(xe - xs, ye - ys)
    whole_turn = quadrant == last and ahead < 0
    j = 0
    while quadrant != last or whole_turn:
        j += distance if is_decreasing(axis, quadrant, sense) else radius - distance
        distance = 0 if is_decreasing(axis, quadrant, sense) else radius
        quadrant = next_quadrant(quadrant, sense)
        whole_turn = False
    j += abs(goal - distance)
    if j == 0:
        return line_block(xe - xs, ye - ys)
    return Block(abs(xs), abs(ys), j, axis, code)
