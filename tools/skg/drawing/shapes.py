"""Ellipses and splines as edges: lines and arcs where they are that, else curves for FIT; lengths in millimetres."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from math import atan2, copysign, cos, hypot, isfinite, pi, sin

from ezdxf.math import BSpline

from skg.drawing.contour import Edge
from skg.drawing.curve import curve_edge
from skg.plane import XY, cross, distance, dot, minus, polar, turn

#: What is this near (mm) to a line or a circle is one.
_SAME = 1e-6
#: A larger arc is cut as FIT does it, in chords: its centre would lie off the tape (100 m), mm.
_LARGEST = 50_000.0
#: A part of a spline's parameters so small that it needs a look.
_NARROW = 1e-6
#: A spline's direction jumps by more than this (radians) at a corner.
_CORNER = 1e-4


def is_number(value: float) -> bool:
    """Neither infinite nor NaN, and of a size that a drawing can have."""
    return isfinite(value) and abs(value) < 1e12


def conic(centre: XY, u: XY, v: XY, first: float, sweep: float, tolerance: float) -> Edge:
    """The curve centre + u·cos t + v·sin t for t from `first` to `first + sweep` (radians, up to 2π).

    An arc or a circle where u and v are square to each other and of one length; else an ellipse, for FIT.
    """
    last = first + sweep
    is_full = sweep > 2 * pi - 1e-9

    def at(t: float) -> XY:
        return centre[0] + cos(t) * u[0] + sin(t) * v[0], centre[1] + cos(t) * u[1] + sin(t) * v[1]

    def heading(t: float) -> float:
        return atan2(cos(t) * v[1] - sin(t) * u[1], cos(t) * v[0] - sin(t) * u[0])

    size = max(hypot(*u), hypot(*v))
    start = at(first)
    if abs(cross(u, v)) <= 1e-9 * size**2:
        # Seen from its side it is a line.
        reach = [at(t) for t in (first, last)]
        return Edge(*reach) if sweep <= pi else Edge(start, start)
    sense = 1 if cross(u, v) > 0 else -1
    if abs(dot(u, v)) <= 1e-9 * size**2 and abs(hypot(*u) - hypot(*v)) <= 1e-9 * size and size < _LARGEST:
        return Edge(start, start if is_full else at(last), centre, sense * (2 * pi if is_full else sweep))
    edge = curve_edge(at, heading, [first, last], tolerance)
    return replace(edge, end=edge.start) if is_full else edge


def spline_edges(tool: BSpline, tolerance: float) -> Iterator[Edge]:
    """A spline as edges, cut in two where it has a corner."""
    if tool.degree == 1:
        controls = [(point.x, point.y) for point in tool.control_points]
        yield from (Edge(p, q) for p, q in pairwise(controls))
        return
    knots = list(tool.knots())
    low, high = knots[tool.degree], knots[len(tool.control_points)]
    aside = 1e-9 * (high - low)
    # (a new one each time that the spline is asked for it)
    evaluator = tool.evaluator

    def at(t: float) -> XY:
        point = evaluator.point(t)
        return point.x, point.y

    def heading(t: float) -> float:
        way = evaluator.derivative(t, 1)[1]
        if way.magnitude < 1e-9:
            # Controls that coincide: the direction is that from just before to just behind.
            way = evaluator.point(min(high, t + 1e4 * aside)) - evaluator.point(max(low, t - 1e4 * aside))
        return atan2(way.y, way.x)

    # Between knots a spline is smooth; at a knot it may have a corner, where it is cut in two.
    stations = [low]
    for knot in sorted(knots):
        if stations[-1] < knot <= high and knot - stations[-1] > 1e-13 * (high - low):
            stations.append(knot)
    stations[-1] = high
    ways = stations
    if min(other - one for one, other in pairwise(stations)) < _NARROW * (high - low):
        # Rounded knots lie next to each other, maybe with much of the curve between them: it is run through by length.
        ways = [0.0]
        for one, other in pairwise(stations):
            places = [at(one + k / 8 * (other - one)) for k in range(9)]
            ways.append(ways[-1] + max(_SAME, sum(distance(p, q) for p, q in pairwise(places))))

    def parameter(way: float) -> float:
        k = min(max(bisect_right(ways, way) - 1, 0), len(stations) - 2)
        return stations[k] + (way - ways[k]) / (ways[k + 1] - ways[k]) * (stations[k + 1] - stations[k])

    def beside(k: int, other: int) -> float:
        """Just before or just behind a station, towards another one."""
        gap = stations[other] - stations[k]
        return stations[k] + copysign(max(1e-6 * abs(gap), 1e-15 * max(abs(low), abs(high))), gap)

    corners = [0]
    for k in range(1, len(stations) - 1):
        if abs(turn(heading(beside(k, k - 1)), heading(beside(k, k + 1)))) > _CORNER:
            corners.append(k)
    for first, last in pairwise([*corners, len(stations) - 1]):
        # At a corner the tangent is that of this piece, not of its neighbour.
        inside = beside(first, first + 1) if first else low, beside(last, last - 1) if stations[last] < high else high

        def inner(way: float, inside: tuple[float, float] = inside) -> float:
            return heading(min(max(parameter(way), inside[0]), inside[1]))

        yield simplest(curve_edge(lambda way: at(parameter(way)), inner, ways[first : last + 1], tolerance))


def simplest(edge: Edge) -> Edge:
    """A curve as a line or an arc where it is one."""
    start, end, samples = edge.start, edge.end, edge.samples
    length = distance(start, end)
    if length > _SAME and abs(edge.length - length) < _SAME:
        way = minus(end, start)
        off = max(abs(cross(way, minus(sample, start))) for sample in samples) / length
        return Edge(start, end) if off < _SAME else edge
    # The circle through three samples.
    p, q, r = samples[0], samples[len(samples) // 3], samples[2 * len(samples) // 3]
    one, other = minus(q, p), minus(r, p)
    area = 2 * cross(one, other)
    if abs(area) < _SAME:
        return edge
    squares = dot(one, one), dot(other, other)
    x = (other[1] * squares[0] - one[1] * squares[1]) / area
    y = (one[0] * squares[1] - other[0] * squares[0]) / area
    centre, radius = (p[0] + x, p[1] + y), hypot(x, y)
    if radius > _LARGEST or any(abs(distance(sample, centre) - radius) > _SAME for sample in samples):
        return edge
    angles = [atan2(*reversed(minus(sample, centre))) for sample in samples]
    sweep = sum(turn(a, b) for a, b in pairwise(angles))
    if abs(sweep) > 2 * pi - 1e-6:
        return Edge(start, start, centre, 2 * pi if sweep > 0 else -2 * pi) if abs(sweep) < 2 * pi + 1e-6 else edge
    return Edge(start, polar(centre, radius, angles[0] + sweep), centre, sweep)
