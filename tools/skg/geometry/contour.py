"""Contours: lines, arcs and curves that follow each other; lengths in millimetres."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from math import cos, hypot, pi, sin

import numpy as np
from numpy.typing import NDArray

from skg.geometry.chords import chords_of
from skg.geometry.piece import Piece
from skg.geometry.plane import XY, cross, distance, shifted

#: Places (m, 2), mm.
Places = NDArray[np.float64]
#: Chords between the points of an arc turn by no more than this, radians: they leave it by 0.08 % of its radius.
_COARSE = 0.08
#: An edge that is no curve has no samples.
_NONE: Places = np.empty((0, 2))


@dataclass(frozen=True, slots=True)
class CurveNode:
    """A point of a curve and the direction angle of the tangent there, radians."""

    point: XY
    angle: float


@dataclass(frozen=True)
class Edge(Piece):
    """A line, an arc, or a curve: `nodes` from start to end, `samples` close to each other on the true curve (an array
    that nobody writes to).

    Of a curve `at` gives a sample and `direction` the one at an end; `nearest` is for lines and arcs. `entity`: the
    number of the entity of the drawing that it comes from, -1 for none.
    """

    nodes: tuple[CurveNode, ...] = ()
    # (curves with the same nodes are the same)
    samples: Places = field(default_factory=lambda: _NONE, repr=False, compare=False)
    entity: int = -1

    @property
    def is_line(self) -> bool:
        """Neither an arc nor a curve."""
        return self.centre is None and not self.nodes

    @cached_property
    def length(self) -> float:
        """Length."""
        return sum(self.steps()) if self.nodes else super().length

    def steps(self) -> list[float]:
        """The lengths of a curve's chords."""
        return list(map(hypot, *np.diff(self.samples, axis=0).T.tolist()))

    def far(self, place: XY) -> float:
        """Distance of a place from the edge; of a curve from its samples."""
        places = self.points() if self.nodes else [self.at(self.nearest(place))]
        return min(distance(point, place) for point in places)

    def reversed(self) -> Edge:
        """The same edge, run through backwards."""
        nodes = tuple(CurveNode(node.point, node.angle + pi) for node in reversed(self.nodes))
        return Edge(self.end, self.start, self.centre, -self.sweep, nodes, self.samples[::-1], self.entity)

    def shifted(self, by: XY) -> Edge:
        """The same edge elsewhere."""
        return replace(
            self,
            start=shifted(self.start, by),
            end=shifted(self.end, by),
            centre=self.centre and shifted(self.centre, by),
            nodes=tuple(CurveNode(shifted(node.point, by), node.angle) for node in self.nodes),
            samples=self.samples + by,
        )

    def at(self, part: float) -> XY:
        """The place at `part` of the length."""
        if self.nodes:
            x, y = self.samples[int(part * (len(self.samples) - 1))].tolist()
            return x, y
        return super().at(part)

    def direction(self, part: float = 0.0) -> float:
        """Direction angle of travel at `part` of the length, radians."""
        if self.nodes:
            return self.nodes[-1 if part else 0].angle
        return super().direction(part)

    def chords(self, off: float | None = None) -> int:
        """Number of chords between `points`, or of those that leave an arc by no more than `off`, mm."""
        if self.nodes:
            return len(self.samples) - 1
        if self.centre is None:
            return 1
        return max(2, int(abs(self.sweep) / _COARSE) + 1) if off is None else chords_of(self.radius, self.sweep, off)

    def points(self) -> list[XY]:
        """Points along the edge, both ends included: a chord is never further than 0.1 % of a radius away."""
        if self.nodes:
            return list(map(tuple, self.samples.tolist()))
        if self.centre is None:
            return [self.start, self.end]
        pieces = self.chords()
        (x, y), radius, first = self.centre, self.radius, self.angles[0]
        angles = [first + k / pieces * self.sweep for k in range(1, pieces)]
        return [self.start, *[(x + radius * cos(angle), y + radius * sin(angle)) for angle in angles], self.end]

    def extremes(self) -> list[XY]:
        """The ends, and where it is farthest left, right, up or down."""
        if not self.nodes:
            return super().extremes()
        farthest = [*self.samples.argmin(0), *self.samples.argmax(0)]
        return [self.start, self.end, *map(tuple, self.samples[farthest].tolist())]

    @property
    def area(self) -> float:
        """Signed area that the edge runs around as seen from the origin: positive counter-clockwise."""
        if self.nodes:
            return self._curve_area
        segment = self.radius**2 * (self.sweep - sin(self.sweep)) if self.centre is not None else 0.0
        return (cross(self.start, self.end) + segment) / 2

    @cached_property
    def _curve_area(self) -> float:
        (x, y), (u, v) = self.samples[:-1].T, self.samples[1:].T
        return sum((x * v - y * u).tolist()) / 2


def part_of(edge: Edge, first: float, last: float) -> Edge:
    """A line's or an arc's piece between two parts of its length."""
    start = edge.start if first == 0 else edge.at(first)
    end = edge.end if last == 1 else edge.at(last)
    return Edge(start, end, edge.centre, edge.sweep * (last - first), entity=edge.entity)


@dataclass(frozen=True)
class Contour:
    """Edges that follow each other; the last one's end is the first one's start when it is closed.

    `layers`: the drawing's layers that its edges come from, in their order along it.
    """

    edges: tuple[Edge, ...]
    is_closed: bool
    layers: tuple[str, ...] = ()

    def points(self) -> list[XY]:
        """Points along the contour, see `Edge.points`."""
        return [point for edge in self.edges for point in edge.points()[:-1]] + [self.edges[-1].end]

    @property
    def ends(self) -> tuple[XY, XY]:
        """Its first and its last place."""
        return self.edges[0].start, self.edges[-1].end

    @cached_property
    def area(self) -> float:
        """Signed area: positive when a closed contour runs counter-clockwise."""
        return sum(edge.area for edge in self.edges)

    def reversed(self) -> Contour:
        """The same contour, run through backwards."""
        return replace(self, edges=tuple(edge.reversed() for edge in reversed(self.edges)))

    def shifted(self, by: XY) -> Contour:
        """The same contour elsewhere."""
        return replace(self, edges=tuple(edge.shifted(by) for edge in self.edges))
