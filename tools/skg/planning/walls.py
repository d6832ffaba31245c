"""Thin walls: what stays between two cuts, where these take more beside it than it is thick."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import shapely

from skg.geometry.arrays import Whole
from skg.geometry.contour import Edge
from skg.geometry.edge_arrays import boxes_of
from skg.geometry.plane import XY
from skg.messages.finding import Finding
from skg.planning.planned import PlannedContour

#: Chords leave a contour by no more when a wall is measured, mm; and when walls are looked for.
_FINE, _COARSE = 0.0002, 0.1
#: No wire takes more than this to its middle, mm: what does is a cutter, whose walls are another matter.
_WIRE = 0.5
#: Walls that have a line of the report each.
_PLACES = 5


class Wall(NamedTuple):
    """A wall between two contours: how thick it is, how much the cuts beside it take together, mm, and its middle where
    it is thinnest."""

    first: PlannedContour
    second: PlannedContour
    thick: float
    kerfs: float
    place: XY


def thin_walls(contours: Sequence[PlannedContour]) -> list[Wall]:
    """The walls that are thinner than what the cuts on their sides take, the thinnest first."""
    closed = [planned for planned in contours if planned.contour.is_closed and 0 < abs(planned.passes[-1]) <= _WIRE]
    closed.sort(key=lambda planned: planned.number)
    if len(closed) < 2:
        return []
    kerfs = np.array([2 * abs(planned.passes[-1]) for planned in closed])
    boxes, _ = boxes_of([planned.contour for planned in closed])
    # (most contours of many lie far from all others)
    rows = [shapely.box(*(boxes + sign * kerfs.max() * np.array([-1, -1, 1, 1])).T) for sign in (0, 2)]
    ones, others = _pairs(closed, *shapely.STRtree(rows[0]).query(rows[1]))
    rings = np.full(len(closed), None, object)
    for number in np.unique([*ones, *others]).tolist():
        rings[number] = shapely.linearrings(_ring(closed[number], None))
    is_near = shapely.dwithin(rings[ones], rings[others], 2 * kerfs.max() + _COARSE)
    ones, others = ones[is_near], others[is_near]
    for number in np.unique([*ones, *others]).tolist():
        rings[number] = shapely.linearrings(_ring(closed[number], _FINE))
    thick = shapely.distance(rings[ones], rings[others])
    walls = []
    for one, other, wide in zip(ones.tolist(), others.tolist(), thick.tolist(), strict=True):
        taken = float(kerfs[one] + kerfs[other])
        # (contours that touch or cross are told of as such)
        if not 0 < wide < taken:
            continue
        (x, y), (u, v) = shapely.get_coordinates(shapely.shortest_line(rings[one], rings[other])).tolist()
        walls.append(Wall(closed[one], closed[other], wide, taken, ((x + u) / 2, (y + v) / 2)))
    return sorted(walls, key=lambda wall: wall.thick)


class Walls:
    """The thin walls of contours that are planned again and again: they are the same while nothing but start holes,
    entries and the order of cutting is another."""

    def __init__(self) -> None:
        self._known: tuple[list[tuple[int, float]], list[Wall]] = [], []

    def of(self, contours: Sequence[PlannedContour]) -> list[Wall]:
        """The walls; their contours are those that were planned first."""
        key = sorted((planned.number, planned.passes[-1]) for planned in contours)
        if key != self._known[0]:
            self._known = key, thin_walls(contours)
        return self._known[1]


def findings(contours: Sequence[PlannedContour], known: Walls | None = None) -> Iterator[Finding]:
    """Report the walls that are thinner than what the cuts beside them take; `known`: from plans before."""
    walls = (known or Walls()).of(contours)
    turns = {planned.number: planned.turn for planned in contours} if walls else {}
    for wall in walls[:_PLACES]:
        yield Finding(
            "thin-wall",
            turn=turns[wall.first.number],
            other=turns[wall.second.number],
            wide=wall.thick,
            kerf=wall.kerfs,
            contour=wall.first.number,
            place=wall.place,
        )
    if (more := len(walls) - _PLACES) > 0:
        yield Finding("more-thin-walls", count=more)


def _pairs(closed: Sequence[PlannedContour], ones: Whole, others: Whole) -> tuple[Whole, Whole]:
    """Those pairs of contours, by their numbers, that have a wall between them, each once."""
    is_pair = ones < others
    ones, others = ones[is_pair], others[is_pair]
    is_wall = np.fromiter(
        (_is_wall(closed[one], closed[other]) for one, other in zip(ones.tolist(), others.tolist(), strict=True)),
        bool,
        len(ones),
    )
    return ones[is_wall], others[is_wall]


def _ring(planned: PlannedContour, off: float | None) -> list[XY]:
    """A contour as chords that leave it by no more, mm; None: as they are at hand."""
    edges = planned.contour.edges
    if off is None:
        return [point for edge in edges for point in edge.points()[:-1]]
    return [point for edge in edges for point in _finely(edge, off)[:-1]]


def _finely(edge: Edge, off: float) -> list[XY]:
    return edge.points() if edge.is_line or edge.nodes else edge.parted(edge.chords(off))


def _is_wall(one: PlannedContour, other: PlannedContour) -> bool:
    """Tell whether material stays between two contours: two openings of a part, or one and the outline around it."""
    inner, outer = max(one.depth, other.depth), min(one.depth, other.depth)
    return inner % 2 == 1 and inner - outer <= 1
