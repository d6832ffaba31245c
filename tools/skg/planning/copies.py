"""Copies of a planned part on the machine, in rows or around a place: as it is, elsewhere; how near they come."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import shapely

from skg.errors import UserError
from skg.geometry.contour import Contour, Edge
from skg.geometry.edge_arrays import boxes_of
from skg.geometry.placement import Placement
from skg.geometry.plane import XY
from skg.job.placing import Copies
from skg.messages.finding import Finding
from skg.planning.planned import PlannedContour

#: Chords leave a contour by no more when it is measured how near copies come, mm; what is nearer touches.
_FINE, _TOUCH = 0.0002, 1e-6
#: A start hole keeps off no more copies.
_MOST_BESIDE = 24


@dataclass(frozen=True)
class Pattern:
    """Copies on the machine. `centre`: the place that they lie around, mm."""

    copies: Copies
    centre: XY = (0.0, 0.0)

    @cached_property
    def placements(self) -> list[Placement]:
        """The way from the first copy to each, row by row."""
        copies = self.copies
        if copies.around > 1:
            turns = (Placement.of(number * copies.angle) for number in range(copies.around))
            return [replace(turn, origin=self.centre, at=self.centre) for turn in turns]
        x, y = copies.step or (0.0, 0.0)
        return [Placement(at=(column * x, row * y)) for row in range(copies.rows) for column in range(copies.columns)]

    def all_of(self, contours: Sequence[PlannedContour]) -> list[PlannedContour]:
        """All copies of planned contours, one after the other."""
        every = [elsewhere(planned, placement) for placement in self.placements for planned in contours]
        return [replace(planned, turn=turn) for turn, planned in enumerate(every, 1)]

    def beside(self, contours: Sequence[Contour], reach: float) -> list[Contour]:
        """The contours of copies that may be within reach (mm) of one: around a copy in the midst of all."""
        boxes, _ = boxes_of(contours)
        low, high = boxes[:, :2].min(0) - reach, boxes[:, 2:].max(0) + reach
        corners = [(x, y) for x in (low[0], high[0]) for y in (low[1], high[1])]
        ways = []
        for to in self._differences:
            places = np.array([to.place(corner) for corner in corners])
            if (places.min(0) < high).all() and (places.max(0) > low).all():
                ways.append((float(np.hypot(*(places - corners).T).max()), to))
        nearest = sorted(ways, key=lambda way: way[0])[:_MOST_BESIDE]
        return [to.contour(contour) for _, to in nearest for contour in contours]

    @property
    def _differences(self) -> list[Placement]:
        """The ways from a copy to others."""
        copies = self.copies
        if copies.around > 1:
            turns = (number * copies.angle for number in range(1 - copies.around, copies.around) if number)
            return [replace(Placement.of(turn), origin=self.centre, at=self.centre) for turn in turns]
        x, y = copies.step or (0.0, 0.0)
        return [
            Placement(at=(column * x, row * y))
            for row in range(1 - copies.rows, copies.rows)
            for column in range(1 - copies.columns, copies.columns)
            if row or column
        ]

    def has(self, contours: Sequence[PlannedContour]) -> bool:
        """Tell whether some planned contours are copies of the first ones of them."""
        count = len(contours) // self.copies.count
        return count * self.copies.count == len(contours) and self.all_of(contours[:count]) == list(contours)


def elsewhere(planned: PlannedContour, placement: Placement) -> PlannedContour:
    """A planned contour at another place, turned."""
    if placement.is_nothing:
        return planned
    edge = planned.contour.edges[0]
    if edge.is_circle and not planned.tabs.each and planned.start == edge.centre:
        # (from its very centre a circle is entered at its +X side, however it is turned: language.md, section 4.2)
        x, y = placement.place(edge.centre)
        placement = Placement(at=(x - edge.centre[0], y - edge.centre[1]))
    go = placement.place
    tabs = tuple(tab._replace(before=go(tab.before), behind=go(tab.behind)) for tab in planned.tabs.each)
    wire, remarks = planned.rung.wire, planned.remarks
    if wire:
        paths = tuple(tuple(map(placement.edge, path)) for path in wire.paths)
        wire = replace(wire, paths=paths, entered=wire.entered and go(wire.entered))
    loops, whiskers = (
        tuple(trim._replace(place=go(trim.place)) for trim in trims) for trims in (remarks.loops, remarks.whiskers)
    )
    around = remarks.around
    if around and around.gap:
        around = around._replace(gap=around.gap._replace(place=go(around.gap.place)))
    return replace(
        planned,
        contour=placement.contour(planned.contour),
        start=go(planned.start),
        tabs=replace(planned.tabs, each=tabs),
        rung=replace(planned.rung, wire=wire),
        remarks=replace(remarks, loops=loops, whiskers=whiskers, around=around),
    )


def refuse_near(pattern: Pattern, contours: Sequence[Contour], kerf: float, may_gouge: bool) -> None:
    """Refuse copies that touch, or of which the wire, which takes a kerf beside each (mm), would cut into the next one.
    `may_gouge`: only those that touch."""
    shapes = _outside(contours)
    boxes, _ = boxes_of(contours)
    whole = shapely.box(*boxes[:, :2].min(0), *boxes[:, 2:].max(0))
    wholes = np.array([shapely.transform(whole, placement.places) for placement in pattern.placements])
    firsts, seconds = shapely.STRtree(wholes).query(wholes, predicate="dwithin", distance=kerf + _TOUCH)
    seen: set[XY | int] = set()
    for first, second in zip(firsts.tolist(), seconds.tolist(), strict=True):
        way = _way(pattern, first, second)
        if first >= second or way in seen:
            continue
        seen.add(way)
        one, other = (shapely.transform(shapes, pattern.placements[number].places) for number in (first, second))
        gap = float(shapely.distance(one, other))
        if gap <= _TOUCH or gap < kerf - _TOUCH and not may_gouge:
            (x, y), (u, v) = shapely.get_coordinates(shapely.shortest_line(one, other)).tolist()
            about = {"first": first + 1, "other": second + 1, "place": ((x + u) / 2, (y + v) / 2)}
            raise UserError(
                Finding("copies-touch", **about)
                if gap <= _TOUCH
                else Finding("copies-near", gap=gap, kerf=kerf, **about)
            )


def _way(pattern: Pattern, first: int, second: int) -> XY | int:
    """The key of a pair of copies: two pairs of the same key lie alike."""
    if pattern.copies.around > 1:
        return second - first
    (row, column), (other_row, other) = (divmod(number, pattern.copies.columns) for number in (first, second))
    return other_row - row, other - column


def _outside(contours: Sequence[Contour]) -> shapely.Geometry:
    """All that a part covers: its closed contours, filled, and open ones."""
    shapes = []
    for contour in contours:
        points = [point for edge in contour.edges for point in _finely(edge)]
        closed = contour.is_closed
        shapes.append(shapely.make_valid(shapely.Polygon(points)) if closed else shapely.LineString(points))
    return shapely.unary_union(shapes)


def _finely(edge: Edge) -> list[XY]:
    return edge.points() if edge.is_line or edge.nodes else edge.parted(edge.chords(_FINE))
