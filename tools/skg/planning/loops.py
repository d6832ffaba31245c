"""Contours without loops, which are smaller than the wire, and without whiskers: lines that a contour runs along and
back, on the wire's side. (laser cutters' programs round inner corners so, and overshoot some)"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import hypot, pi
from typing import NamedTuple

import shapely

from skg.geometry.contour import Contour, Edge
from skg.geometry.plane import XY, cross, distance, dot, minus

#: Places so near to each other (mm) are one.
_SAME = 1e-6
#: Directions that differ by no more (radians), or by half a turn, are parallel.
_PARALLEL = 1e-6


class Trim(NamedTuple):
    """A loop, or a whisker: where it begins, or its tip, and its length, mm."""

    place: XY
    length: float


def tidied(contour: Contour, r: float, is_outside: bool) -> tuple[Contour, tuple[Trim, ...], tuple[Trim, ...]]:
    """Return a closed contour that touches or crosses itself without its loops smaller than a wire that runs R (mm)
    beside it, or outside of it, and without its whiskers; and both. Any other is as it was."""
    if len(contour.edges) < 3 or _is_simple(contour):
        return contour, (), ()
    most = 2 * pi * abs(r)
    whole, loops = _without_loops(contour, most)
    if not _is_simple(whole):
        # (it may begin within one)
        half = len(whole.edges) // 2
        other, more = _without_loops(replace(whole, edges=whole.edges[half:] + whole.edges[:half]), most)
        whole, loops = (other, loops + more) if more else (whole, loops)
    whole, whiskers = _without_whiskers(whole, is_outside)
    return whole, loops, whiskers


def _is_simple(contour: Contour) -> bool:
    places = contour.points()
    return len(places) > 3 and shapely.Polygon(places).is_valid


def _without_loops(contour: Contour, most: float) -> tuple[Contour, tuple[Trim, ...]]:
    """A contour without loops of a length (mm), from a place back to it; and these."""
    kept: list[Edge] = []
    places: list[Trim] = []
    for edge in contour.edges:
        kept.append(edge)
        if loop := _loop(kept, most):
            first, place = loop
            before, behind = replace(kept[first], end=place), replace(edge, start=place)
            parts = distance(place, kept[first].end), *(one.length for one in kept[first + 1 : -1])
            length = kept[first].length if len(kept) == first + 1 else sum(parts) + distance(edge.start, place)
            kept[first:] = [part for part in (before, behind) if distance(part.start, part.end) > _SAME]
            places.append(Trim(place, length))
    if not places or not kept:
        return contour, ()
    # (the ends of a loop may differ by rounding)
    edges = (replace(edge, start=one.end) if edge.is_line else edge for one, edge in pairwise([kept[-1], *kept]))
    return replace(contour, edges=tuple(edges)), tuple(places)


def _loop(edges: list[Edge], most: float) -> tuple[int, XY] | None:
    """The first of the last edges that come back to where they leave, and this place: a corner, or where two lines
    cross."""
    last, length = edges[-1], 0.0
    for number in range(len(edges) - 1, -1, -1):
        one = edges[number]
        if length + last.length + one.length * (one is not last) <= most and distance(one.start, last.end) < _SAME:
            return number, one.start
        place = _crossing(one, last) if number < len(edges) - 2 else None
        if place and distance(place, one.end) + length + distance(last.start, place) <= most:
            return number, place
        length += one.length * (one is not last)
        if length > most:
            return None
    return None


def _crossing(one: Edge, other: Edge) -> XY | None:
    """The place where two lines cross."""
    way, to, gap = minus(one.end, one.start), minus(other.end, other.start), minus(other.start, one.start)
    area = cross(way, to)
    if not (one.is_line and other.is_line) or abs(area) <= _PARALLEL * hypot(*way) * hypot(*to):
        return None
    part = cross(gap, to) / area
    is_there = 0 <= part <= 1 and 0 <= cross(gap, way) / area <= 1
    return one.at(part) if is_there else None


def _without_whiskers(contour: Contour, is_outside: bool) -> tuple[Contour, tuple[Trim, ...]]:
    """A contour without its whiskers, and these. One that is a slit, on the other side than the wire, stays, and
    all others with it."""
    edges = list(contour.edges)
    tips: list[Trim] = []
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
            tips.append(Trim(one.end, min(one.length, other.length)))
        edges[number] = replace(one, end=other.end)
        if distance(one.start, other.end) < _SAME:
            del edges[number]
        del edges[number - 1]
        number = max(number - 2, 0)
    whole = replace(contour, edges=tuple(edges))
    area = shapely.Polygon(whole.points()) if tips and len(edges) > 1 else None
    if area is None or not area.is_valid:
        return contour, ()
    places = shapely.points([tip.place for tip in tips])
    is_slit = shapely.contains(area, places) if is_outside else ~shapely.covers(area, places)
    return (contour, ()) if is_slit.any() else (whole, tuple(tips))
