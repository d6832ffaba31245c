"""The contour as drawn, from the segments that the reference makes of it."""

from __future__ import annotations

from itertools import pairwise
from math import atan2, hypot, sqrt

from skg.geometry.piece import Piece
from skg.geometry.plane import XY
from skg.ref.route import Segment
from skg.ref.values import Circle, Curve, Point


def nominal(path: list[Segment]) -> tuple[Piece, ...]:
    """Return the contour as drawn, mm, from the segments of the wire's path.

    Where two elements meet the contour has its corner at their crossing nearest to the wire's corner; where
    they have none (they touch, or FIT's chords replace them), at the wire's corner moved back by R.
    """
    pieces: list[Piece] = []
    run: list[Segment] = []
    for segment in [*path, None]:
        if segment is not None and segment.nominal is not None:
            run.append(segment)
        elif run:
            pieces += _contour(run)
            run = []
    return tuple(pieces)


def _contour(run: list[Segment]) -> list[Piece]:
    corners = [_foot(run[0], run[0].start)]
    corners += [_corner(before, after) for before, after in pairwise(run)]
    corners.append(_foot(run[-1], run[-1].end))
    result = []
    for segment, (start, end) in zip(run, pairwise(corners), strict=True):
        if not segment.is_arc:
            result.append(Piece(start, end))
            continue
        centre = float(segment.centre.x), float(segment.centre.y)
        sense = 1 if segment.radius > 0 else -1
        # The sweep of the wire's arc, set right for corners that lie elsewhere on the nominal one.
        sweep = sense * float(segment.sweep)
        for corner, wire, side in ((end, segment.end, 1), (start, segment.start, -1)):
            sweep += side * _turn(centre, _xy(wire), corner)
        result.append(Piece(start, end, centre, sweep))
    return result


def _xy(point: Point) -> XY:
    return float(point.x), float(point.y)


def _turn(centre: XY, first: XY, second: XY) -> float:
    """Angle from one point to another as seen from the centre, −π…π."""
    (x, y), (u, v) = ((p[0] - centre[0], p[1] - centre[1]) for p in (first, second))
    return atan2(x * v - y * u, x * u + y * v)


def _foot(segment: Segment, wire: Point) -> XY:
    """The nominal curve's point nearest to a place of the wire, mm."""
    x, y = _xy(wire)
    curve = segment.nominal
    if not isinstance(curve, Circle):
        off = float(curve.a) * x + float(curve.b) * y - float(curve.g)
        return x - off * float(curve.a), y - off * float(curve.b)
    xc, yc, radius = float(curve.x), float(curve.y), abs(float(curve.r))
    distance = hypot(x - xc, y - yc) or 1.0
    return xc + radius * (x - xc) / distance, yc + radius * (y - yc) / distance


def _corner(first: Segment, second: Segment) -> XY:
    """Return the crossing of two neighbours' nominal curves."""
    wire = _xy(first.end)
    # A crossing much further away than the offsets explain belongs to another place of the same curves.
    reach = 50 * max(abs(float(first.offset)), abs(float(second.offset))) + 0.01
    crossings = [
        point
        for point in _crossings(first.nominal, second.nominal)
        if hypot(point[0] - wire[0], point[1] - wire[1]) <= reach
    ]
    if not crossings:
        return _foot(first, first.end)
    return min(crossings, key=lambda point: hypot(point[0] - wire[0], point[1] - wire[1]))


def _crossings(first: Curve, second: Curve) -> list[XY]:
    """Crossings of two of the reference's curves in floats; none where they only touch or run parallel."""
    if isinstance(first, Circle) and not isinstance(second, Circle):
        return _crossings(second, first)
    if not isinstance(second, Circle):
        (a, b, g), (c, d, h) = ((float(s.a), float(s.b), float(s.g)) for s in (first, second))
        area = a * d - b * c
        return [((g * d - b * h) / area, (a * h - g * c) / area)] if abs(area) > 1e-3 else []
    xc, yc, radius = float(second.x), float(second.y), abs(float(second.r))
    if isinstance(first, Circle):
        # The common chord of two circles is a line.
        dx, dy = float(first.x) - xc, float(first.y) - yc
        distance = hypot(dx, dy)
        if distance < 1e-9:
            return []
        along = (distance**2 + radius**2 - float(first.r) ** 2) / (2 * distance)
        a, b = dx / distance, dy / distance
    else:
        a, b = float(first.a), float(first.b)
        along = float(first.g) - a * xc - b * yc
    if abs(along) > radius * (1 - 1e-6):
        return []
    half = sqrt(radius**2 - along**2)
    return [(xc + a * along - b * side, yc + b * along + a * side) for side in (half, -half)]
