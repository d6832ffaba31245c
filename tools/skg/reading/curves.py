"""Ellipses and splines as edges: lines and arcs where they are that, else curves for FIT; lengths in millimetres."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from itertools import accumulate, pairwise
from math import atan2, cos, hypot, isfinite, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from skg.geometry.contour import Edge, Places
from skg.geometry.fitting import curve_edge
from skg.geometry.plane import XY, cross, distance, dot, minus, polar, turn

if TYPE_CHECKING:
    from ezdxf.math import BSpline

#: A curve this near (mm) to a line or a circle is one.
_SAME = 1e-6
#: A larger arc is cut as FIT does it, in chords: its centre would lie off the tape (100 m), mm.
_LARGEST = 50_000.0
#: A part of a spline's parameters so small that it needs a look.
_NARROW = 1e-6
#: A spline's direction is that of a chord if it runs slower than this part of its mean speed.
_SLOW = 1e-4
#: A place as small as this (mm) where a spline turns by more than this (radians) is a corner.
_NOOK, _NOOK_TURN = 0.004, 0.3
#: A spline's direction jumps by more than this (radians) at a corner.
_CORNER = 1e-4


def is_number(value: float) -> bool:
    """Neither infinite nor NaN, and of a size that a drawing can have."""
    return isfinite(value) and abs(value) < 1e12


def conic(centre: XY, u: XY, v: XY, first: float, sweep: float, tolerance: float, entity: int = -1) -> Edge:
    """The curve centre + u·cos t + v·sin t for t from `first` to `first + sweep` (radians, up to 2π), of an entity.

    An arc or a circle where u and v are square to each other and of one length; else an ellipse, for FIT.
    """
    is_full = sweep > 2 * pi - 1e-9
    (x, y), (p, q), (r, s) = centre, u, v
    size = max(hypot(*u), hypot(*v))
    ends = ((cos(t), sin(t)) for t in (first, first + sweep))
    start, end = ((x + c * p + d * r, y + c * q + d * s) for c, d in ends)
    if abs(cross(u, v)) <= 1e-9 * size**2:
        # Seen from its side it is a line.
        return Edge(start, end if sweep <= pi else start, entity=entity)
    sense = 1 if cross(u, v) > 0 else -1
    # (an arc longer than a tape is refused for its size)
    is_arc = size < _LARGEST or size * sweep > 2 * _LARGEST
    if abs(dot(u, v)) <= 1e-9 * size**2 and abs(hypot(*u) - hypot(*v)) <= 1e-9 * size and is_arc:
        signed = sense * (2 * pi if is_full else sweep)
        return Edge(start, start if is_full else end, centre, signed, entity=entity)
    edge = _ellipse(u, v, first, sweep, tolerance).shifted(centre)
    return replace(edge, end=edge.start if is_full else edge.end, entity=entity)


@lru_cache(maxsize=100)
def _ellipse(u: XY, v: XY, first: float, sweep: float, tolerance: float) -> Edge:
    """The same about the origin. (a drawing may have the same ellipse a thousand times)"""
    (p, q), (r, s) = u, v

    def points_at(angles: list[float]) -> list[XY]:
        return [(c * p + d * r, c * q + d * s) for t in angles for c in (cos(t),) for d in (sin(t),)]

    def heading(t: float) -> float:
        c, d = cos(t), sin(t)
        return atan2(c * s - d * q, c * r - d * p)

    return curve_edge(points_at, heading, [first, first + sweep], tolerance)


def spline_edges(tool: BSpline, tolerance: float) -> Iterator[Edge]:
    """A spline as edges, cut in two where it has a corner."""
    if tool.degree == 1:
        controls = [(point.x, point.y) for point in tool.control_points]
        yield from (Edge(p, q) for p, q in pairwise(controls))
        return
    spline = _Spline(tool)
    for first, behind in spline.smooth_runs():
        yield from map(simplest, _without_nooks(spline.curve(first, behind, tolerance)))


class _Spline:
    """A spline that is run through evenly: by its own parameter, or by `way`, a measure that grows along it.

    Between knots it is smooth, at a knot it may have a corner. `spans` are the stretches between its knots, by their
    first and last parameter; span number k begins at `ways[k]` along the curve and has the length `lengths[k]` (mm).
    """

    def __init__(self, tool: BSpline) -> None:
        # (a new one each time that the spline is asked for it)
        self.evaluator = tool.evaluator
        self.spans: list[tuple[float, float]] = []
        self.lengths: list[float] = []
        stations = _stations(tool)
        size = sum(p.distance(q) for p, q in pairwise(tool.control_points))
        for first, last in pairwise(stations):
            places = self.places([first + k / 8 * (last - first) for k in range(9)])
            length = sum(distance(p, q) for p, q in pairwise(places))
            if length > 1e-9 * size:
                # (else it stands still, its controls are one place)
                self.spans.append((first, last))
                self.lengths.append(length)
        low, high = stations[0], stations[-1]
        self.least = 1e-15 * max(abs(low), abs(high))
        parts = [last - first for first, last in self.spans]
        if min(parts, default=0.0) < _NARROW * (high - low):
            # Rounded knots lie next to each other, maybe with much of the curve between them: by length, then.
            parts = [max(_SAME, length) for length in self.lengths]
        self.ways = [0.0, *accumulate(parts)]
        # Each span: where it begins along the curve, how long it is there, and the same of its parameters.
        extents = ((begin, end - begin) for begin, end in pairwise(self.ways))
        self._table = [
            (*extent, first, last - first) for extent, (first, last) in zip(extents, self.spans, strict=True)
        ]

    def places(self, parameters: list[float]) -> list[XY]:
        """The places at some parameters."""
        return [(point.x, point.y) for point in self.evaluator.points(parameters)]

    def heading(self, t: float, k: int) -> float:
        """The direction (radians) at parameter t in span number k."""
        first, last = self.spans[k]
        tangent = self.evaluator.derivative(t, 1)[1]
        beside = 1e-5 * (last - first)
        while tangent.magnitude * (last - first) < _SLOW * self.lengths[k] and beside < last - first:
            # Controls that coincide, or nearly: the direction is that of a chord.
            chord = self.evaluator.point(min(last, t + beside)) - self.evaluator.point(max(first, t - beside))
            if chord.magnitude > 0.01 * _SLOW * self.lengths[k]:
                tangent = chord
                break
            beside *= 2
        return atan2(tangent.y, tangent.x)

    def behind_begin(self, k: int) -> float:
        """The parameter just behind the beginning of span number k."""
        first, last = self.spans[k]
        return first + max(1e-6 * (last - first), self.least)

    def before_end(self, k: int) -> float:
        """The parameter just before the end of span number k."""
        first, last = self.spans[k]
        return last - max(1e-6 * (last - first), self.least)

    def smooth_runs(self) -> Iterator[tuple[int, int]]:
        """The runs of spans without a corner between them: the first span, and the one behind the last."""
        if self.spans:
            yield from pairwise([0, *filter(self.has_corner, range(1, len(self.spans))), len(self.spans)])

    def has_corner(self, k: int) -> bool:
        """Tell whether the direction jumps where span number k begins."""
        before, after = self.heading(self.before_end(k - 1), k - 1), self.heading(self.behind_begin(k), k)
        return abs(turn(before, after)) > _CORNER

    def span_at(self, way: float) -> int:
        """The span at a way along the curve."""
        return bisect_right(self.ways, way, 1, len(self.spans)) - 1

    def parameters(self, ways: list[float]) -> list[float]:
        """The parameters at some ways along the curve."""
        parameters = []
        for way in ways:
            begin, length, first, more = self._table[self.span_at(way)]
            parameters.append(first + (way - begin) / length * more)
        return parameters

    def curve(self, first: int, behind: int, tolerance: float) -> Edge:
        """The spans from number `first` to the one before `behind`, which have no corner, as a curve for FIT."""
        last = behind - 1
        # At a corner the tangent is that of this run, not of its neighbour.
        begin = self.behind_begin(first) if first else self.spans[first][0]
        end = self.before_end(last) if behind < len(self.spans) else self.spans[last][1]

        def points_at(ways: list[float]) -> list[XY]:
            return self.places(self.parameters(ways))

        def heading(way: float) -> float:
            (t,) = self.parameters([way])
            return self.heading(min(max(t, begin), end), min(max(self.span_at(way), first), last))

        return curve_edge(points_at, heading, self.ways[first : behind + 1], tolerance)


def _stations(tool: BSpline) -> list[float]:
    """The knots between which a spline is drawn, those that are one in floats as one."""
    knots = list(tool.knots())
    low, high = knots[tool.degree], knots[len(tool.control_points)]
    stations = [low]
    for knot in sorted(knots):
        if stations[-1] < knot <= high and knot - stations[-1] > 1e-13 * (high - low):
            stations.append(knot)
    stations[-1] = high
    return stations


def _without_nooks(edge: Edge) -> Iterator[Edge]:
    """A curve in pieces, with a line where it turns within a few micrometres: no controller follows that."""
    nodes, samples = edge.nodes, edge.samples
    first = begun = 0
    for last in range(1, len(nodes)):
        before, after = nodes[last - 1], nodes[last]
        if distance(before.point, after.point) >= _NOOK or abs(turn(before.angle, after.angle)) <= _NOOK_TURN:
            continue
        ends = _sample_at(samples, begun, before.point)
        if last - 1 > first:
            yield replace(
                edge,
                end=before.point,
                start=nodes[first].point,
                nodes=nodes[first:last],
                samples=samples[begun : ends + 1],
            )
        if before.point != after.point:
            yield Edge(before.point, after.point)
        first, begun = last, _sample_at(samples, ends, after.point)
    if first < len(nodes) - 1:
        yield replace(edge, start=nodes[first].point, nodes=nodes[first:], samples=samples[begun:])


def _sample_at(samples: Places, begin: int, place: XY) -> int:
    """The first sample from number `begin` on that is a place."""
    return begin + int(np.argmax((samples[begin:] == place).all(1)))


def simplest(edge: Edge) -> Edge:
    """A curve as a line or an arc where it is one."""
    start, end, samples = edge.start, edge.end, edge.samples
    if edge.is_line:
        return edge
    length = distance(start, end)
    if length > _SAME and abs(edge.length - length) < _SAME:
        chord = minus(end, start)
        off = np.abs((chord[0], -chord[1]) @ (samples - start).T[::-1]).max() / length
        return Edge(start, end) if off < _SAME else edge
    # The circle through three samples.
    p, q, r = samples[[0, len(samples) // 3, 2 * len(samples) // 3]].tolist()
    to_q, to_r = minus(q, p), minus(r, p)
    area = 2 * cross(to_q, to_r)
    if abs(area) < _SAME:
        return edge
    squares = dot(to_q, to_q), dot(to_r, to_r)
    x = (to_r[1] * squares[0] - to_q[1] * squares[1]) / area
    y = (to_q[0] * squares[1] - to_r[0] * squares[0]) / area
    centre, radius = (p[0] + x, p[1] + y), hypot(x, y)
    about = samples - centre
    if radius > _LARGEST or (np.abs(np.hypot(*about.T) - radius) > _SAME).any():
        return edge
    angles = [atan2(v, u) for u, v in about.tolist()]
    sweep = sum(turn(a, b) for a, b in pairwise(angles))
    if abs(sweep) > 2 * pi - 1e-6:
        return Edge(start, start, centre, 2 * pi if sweep > 0 else -2 * pi) if abs(sweep) < 2 * pi + 1e-6 else edge
    return Edge(start, polar(centre, radius, angles[0] + sweep), centre, sweep)
