"""Lines, arcs and polylines of a DXF drawing, as they stand in a block, as edges on the drawing in millimetres."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from math import atan, atan2, pi
from typing import TYPE_CHECKING

from skg.geometry.contour import Edge
from skg.geometry.plane import XY, distance, minus, polar
from skg.messages.finding import Phrase
from skg.reading.curves import conic, is_number

if TYPE_CHECKING:
    from ezdxf.math import OCS, Matrix44

#: A place, or a way: x, y, z. (ezdxf's own are such)
XYZ = Sequence[float]
#: Ends whose heights differ by more than this (mm) do not lie in one flat drawing.
LEVEL = 1e-3
#: Why an entity is left that does not lie in one.
LEAVES = Phrase("reason-leaves-plane")
#: Angles are whole turns apart when they miss it by no more than this part of one; those that are the same angle but
#: for a float's rounding by no more than that: what is longer than nothing is drawn so (where two fillets meet).
_WHOLE, _NONE = 1e-8, 1e-13


class NotFlat(Exception):
    """An entity that is not understood, or leaves the drawing's plane, for a reason."""

    def __init__(self, reason: Phrase) -> None:
        super().__init__(reason)
        self.reason = reason


class Placing:
    """Places entities on the drawing.

    `factor`: mm in one unit of the drawing; `tolerance` (mm) that of FIT for ellipses. `matrix`: from where the present
    block's entities stand to the drawing, None where they stand on it; `entity`: the number of the present one.
    """

    def __init__(self, factor: float, tolerance: float) -> None:
        self.factor = factor
        self.tolerance = tolerance
        self.matrix: Matrix44 | None = None
        self.entity = -1

    def _on_drawing(self, points: Sequence[XYZ]) -> Sequence[XYZ]:
        """Places of the present block on the drawing; those of different heights are refused."""
        result = points if self.matrix is None else list(self.matrix.transform_vertices(points))
        heights = [point[2] for point in result]
        if heights and (max(heights) - min(heights)) * self.factor > LEVEL:
            raise NotFlat(LEAVES)
        return result

    def points(self, points: Sequence[XYZ]) -> list[XY]:
        """Places of the present block in mm."""
        result = [(point[0] * self.factor, point[1] * self.factor) for point in self._on_drawing(points)]
        if not all(is_number(x) and is_number(y) for x, y in result):
            raise NotFlat(Phrase("reason-no-number"))
        return result

    def line(self, start: XYZ, end: XYZ) -> Edge:
        """A line."""
        first, last = self.points([start, end])
        return Edge(first, last, entity=self.entity)

    def arc(self, centre: XYZ, radius: float, first: float, sweep: float, ocs: OCS | None = None) -> list[Edge]:
        """An arc or circle, which may stand in a coordinate system of its own."""
        radius = abs(radius)
        frame: list[XYZ] = [centre, (radius, 0.0, 0.0), (0.0, radius, 0.0)]
        middle, u, v = frame if ocs is None else list(ocs.points_to_wcs(frame))
        return self.conic(middle, u, v, first, sweep)

    def conic(self, centre: XYZ, u: XYZ, v: XYZ, first: float, sweep: float) -> list[Edge]:
        """centre + u cos t + v sin t from `first` on."""
        x, y, z = centre
        ends = [(x + along, y + up, z + high) for along, up, high in (u, v)]
        middle, p, q = self.points([centre, *ends])
        return [conic(middle, minus(p, middle), minus(q, middle), first, sweep, self.tolerance, self.entity)]

    def polyline(
        self, points: list[XYZ], bulges: list[float], is_closed: bool, ocs: OCS | None = None
    ) -> Iterator[Edge]:
        """Lines and arcs through points; those of a flat polyline may stand in a coordinate system of its own."""
        if is_closed and points:
            points, bulges = [*points, points[0]], [*bulges, 0.0]
        on_drawing = self.points(list(ocs.points_to_wcs(points)) if ocs else points)
        for (p, q), (start, end), bulge in zip(pairwise(points), pairwise(on_drawing), bulges, strict=False):
            if not bulge or start == end:
                yield Edge(start, end, entity=self.entity)
                continue
            (x, y), radius, first, last = _arc_of(p, q, bulge)
            sweep = (last - first) % (2 * pi)
            for edge in self.arc((x, y, p[2]), radius, first, sweep, ocs):
                turned = edge if bulge > 0 else edge.reversed()
                yield turned if turned.nodes else replace(turned, start=start, end=end)


def _arc_of(start: XYZ, end: XYZ, bulge: float) -> tuple[XY, float, float, float]:
    """Centre, radius, first and last angle (counter-clockwise) of the arc between two vertices of a polyline: the bulge
    is the tangent of a quarter of its sweep."""
    p, q = (start[0], start[1]), (end[0], end[1])
    radius = distance(p, q) * (1.0 + bulge * bulge) / 4.0 / bulge
    centre = polar(p, radius, _angle(p, q) + (pi / 2 - 2 * atan(bulge)))
    first, last = _angle(centre, p), _angle(centre, q)
    return centre, abs(radius), *((first, last) if bulge > 0 else (last, first))


def _angle(p: XY, q: XY) -> float:
    """The direction from p to q."""
    x, y = minus(q, p)
    return atan2(y, x)


def swept(first: float, last: float) -> float:
    """From one angle on to the other, radians; whole turns, as files round them, are one."""
    return 2 * pi if is_full((last - first) / (2 * pi)) else (last - first) % (2 * pi)


def is_full(turns: float) -> bool:
    """Tell whether so many turns are whole ones that were rounded."""
    return abs(turns - round(turns)) < _WHOLE and not _NONE < turns < _WHOLE
