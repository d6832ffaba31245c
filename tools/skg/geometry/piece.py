"""A piece of a path: a line or an arc, in plain floats.

All paths of the tools are made of these: a tape laid out, the edges of a drawing, a program's nominal contour. (The
reference has segments of its own, with 50 digits.)
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import atan2, ceil, copysign, pi

from skg.geometry.plane import XY, distance, dot, minus, polar


@dataclass(frozen=True, slots=True)
class Piece:
    """A line, or an arc with a `centre` and a signed `sweep` in radians: positive counter-clockwise, ±2π for a circle.

    Lengths are in the unit that the path has: mm on drawings, µm on tapes. `part` is how far along the piece, 0 to 1.
    """

    start: XY
    end: XY
    centre: XY | None = None
    sweep: float = 0.0

    @property
    def is_line(self) -> bool:
        """Not an arc."""
        return self.centre is None

    @property
    def is_circle(self) -> bool:
        """A full circle."""
        return self.centre is not None and abs(self.sweep) > 2 * pi - 1e-9

    @property
    def radius(self) -> float:
        """Radius of an arc, as its start has it."""
        assert self.centre is not None, "a line has no radius"
        return distance(self.start, self.centre)

    @property
    def angles(self) -> tuple[float, float]:
        """Start and end angle of an arc, radians; the end is the start plus the sweep."""
        assert self.centre is not None, "a line has no angles"
        x, y = minus(self.start, self.centre)
        first = atan2(y, x)
        return first, first + self.sweep

    @property
    def length(self) -> float:
        """Length."""
        return distance(self.start, self.end) if self.centre is None else self.radius * abs(self.sweep)

    def at(self, part: float) -> XY:
        """The place at `part` of the length."""
        if self.centre is None:
            return (
                self.start[0] + part * (self.end[0] - self.start[0]),
                self.start[1] + part * (self.end[1] - self.start[1]),
            )
        return polar(self.centre, self.radius, self.angles[0] + part * self.sweep)

    def direction(self, part: float = 0.0) -> float:
        """Direction angle of travel at `part` of the length, radians."""
        if self.centre is None:
            x, y = minus(self.end, self.start)
            return atan2(y, x)
        return self.angles[0] + part * self.sweep + copysign(pi / 2, self.sweep)

    def extremes(self) -> list[XY]:
        """The ends, and where an arc is farthest left, right, up or down."""
        extremes = [self.start, self.end]
        if self.centre is not None:
            low, high = sorted(self.angles)
            quarters = range(ceil(low / (pi / 2)), int(high // (pi / 2)) + 1)
            extremes += [polar(self.centre, self.radius, quarter * pi / 2) for quarter in quarters]
        return extremes

    def nearest(self, place: XY) -> float:
        """The part of the piece that lies nearest to a place."""
        if self.centre is None:
            way = minus(self.end, self.start)
            return min(1.0, max(0.0, dot(minus(place, self.start), way) / dot(way, way)))
        x, y = minus(place, self.centre)
        ahead = atan2(y, x) - self.angles[0]
        part = (ahead if self.sweep > 0 else -ahead) % (2 * pi) / abs(self.sweep)
        if part <= 1:
            return part
        return 0.0 if distance(place, self.start) < distance(place, self.end) else 1.0

    def reversed(self) -> Piece:
        """The same piece, run through backwards."""
        return replace(self, start=self.end, end=self.start, sweep=-self.sweep)

    def parted(self, pieces: int) -> list[XY]:
        """The places that part it into equal pieces, both ends included."""
        if self.centre is None:
            return [self.start, *(self.at(k / pieces) for k in range(1, pieces)), self.end]
        radius, first = self.radius, self.angles[0]
        inner = (polar(self.centre, radius, first + k / pieces * self.sweep) for k in range(1, pieces))
        return [self.start, *inner, self.end]
