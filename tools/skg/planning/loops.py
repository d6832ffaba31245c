"""What of a contour means nothing to the wire: loops that are smaller than it, and whiskers, lines that the contour
runs along and back on the wire's side. (laser cutters' programs round inner corners so, and overshoot some)"""

from __future__ import annotations

from dataclasses import replace
from math import hypot, pi

import shapely

from skg.geometry.contour import Contour, Edge
from skg.geometry.plane import XY, cross, distance, dot, minus

#: What is no further apart is one place, mm.
_SAME = 1e-6
#: Directions that differ by no more (radians), or by half a turn, are parallel.
_PARALLEL = 1e-6


def without_loops(contour: Contour, r: float) -> tuple[Contour, tuple[XY, ...]]:
    """Return a closed contour without what leaves a place of it and comes back there within the circumference of a
    wire, R (mm) beside it; and these places."""
    kept: list[Edge] = []
    places: list[XY] = []
    for edge in contour.edges:
        kept.append(edge)
        if (first := _loop(kept, 2 * pi * abs(r))) is not None:
            places.append(edge.end)
            del kept[first:]
    return (replace(contour, edges=tuple(kept)), tuple(places)) if places and kept else (contour, ())


def _loop(edges: list[Edge], most: float) -> int | None:
    """The first of the last edges that come back to where they leave within a length, mm."""
    length = 0.0
    for first in range(len(edges) - 1, -1, -1):
        length += edges[first].length
        if length > most:
            return None
        if distance(edges[first].start, edges[-1].end) < _SAME:
            return first
    return None


def without_whiskers(contour: Contour, is_outside: bool) -> tuple[Contour, tuple[XY, ...]]:
    """Return a closed contour without its whiskers, and their tips; `is_outside`: the wire runs outside of it. One that
    is a slit, on the other side, stays, and all others with it."""
    edges = list(contour.edges)
    tips: list[XY] = []
    number = 0
    while number < len(edges) > 2:
        one, other = edges[number - 1], edges[number]
        way = minus(one.end, one.start), minus(other.end, other.start)
        is_along = one.is_line and other.is_line and abs(cross(*way)) <= _PARALLEL * hypot(*way[0]) * hypot(*way[1])
        is_back = is_along and dot(*way) < 0
        # (where a whisker was, lines may run straight on)
        if not (is_back or is_along and tips):
            number += 1
            continue
        if is_back:
            tips.append(one.end)
        edges[number] = replace(one, end=other.end)
        if distance(one.start, other.end) < _SAME:
            del edges[number]
        del edges[number - 1]
        number = max(number - 2, 0)
    whole = replace(contour, edges=tuple(edges))
    area = shapely.Polygon(whole.points()) if tips and len(edges) > 1 else None
    if area is None or not area.is_valid:
        return contour, ()
    places = shapely.points(tips)
    is_slit = shapely.contains(area, places) if is_outside else ~shapely.covers(area, places)
    return (contour, ()) if is_slit.any() else (whole, tuple(tips))
