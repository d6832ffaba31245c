"""Smooth curves as nodes for FIT: as few as its biarcs need to come near enough (language.md, section 5)."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from math import ceil, cos, hypot, inf, pi, sin, sqrt

import numpy as np

from skg.geometry.chords import MEASURED
from skg.geometry.contour import CurveNode, Edge, Places
from skg.geometry.plane import XY, distance, dot, minus, turn

#: A curve's points at parameters, and the direction angle of its tangent at one (radians).
At = Callable[[list[float]], list[XY]]
Heading = Callable[[float], float]
#: One biarc bends by no more than this, radians.
_BEND = 1.2
#: The part of a tolerance that the tried places take: between them the curve may be a little further away.
_SPARE = 0.9
#: The parts of a biarc at which it is tried.
_TRIED = [part / 12 for part in range(1, 12)]
#: A span has no more samples than this.
_MOST = 4096
#: FIT cuts an arc as a line that leaves its tangent by no more than the first, or with the second radius or more, mm
#: (language.md, section 5).
FLAT, STRAIGHT = 0.002, 50_000.0


def biarc_joint(one: CurveNode, other: CurveNode) -> XY | None:
    """Return the joint of the biarc between two nodes (language.md, section 5); None if there is none."""
    v = minus(other.point, one.point)
    t, u = (cos(one.angle), sin(one.angle)), (cos(other.angle), sin(other.angle))
    along, square = dot(v, (t[0] + u[0], t[1] + u[1])), dot(v, v)
    below = along + sqrt(along**2 + 2 * (1 - dot(t, u)) * square)
    if below <= 1e-12 * sqrt(square):
        return None
    d, (x, y), (p, q) = square / below, one.point, other.point
    return (x + d * t[0] + p - d * u[0]) / 2, (y + d * t[1] + q - d * u[1]) / 2


def _off_arc(points: list[XY], start: XY, angle: float, end: XY) -> tuple[float, float]:
    """Largest distance of points from the arc that leaves `start` in direction `angle` for `end`: from the arc itself,
    and as FIT cuts it, a flat or a very large one as the line of its chord (language.md, section 5)."""
    if not points:
        return 0.0, 0.0
    normal = -sin(angle), cos(angle)
    (x, y), (u, v) = start, minus(end, start)
    height = dot(normal, (u, v))
    square = dot((u, v), (u, v))
    radius = square / (2 * height) if abs(height) >= 1e-9 else inf
    off_chord = 0.0
    if is_line := abs(height) <= FLAT or abs(radius) >= STRAIGHT:
        off_chord = max([abs(u * (q - y) - v * (p - x)) for p, q in points]) / sqrt(square)
    if radius == inf:
        return off_chord, off_chord
    x, y, far = x + radius * normal[0], y + radius * normal[1], abs(radius)
    off = max([abs(hypot(p - x, q - y) - far) for p, q in points])
    return off, off_chord if is_line else off


def _off(
    places_at: At, heading: Heading, one: CurveNode, low: float, high: float, breaks: Sequence[float]
) -> tuple[float, float]:
    """Distance of the curve from the biarc between two parameters, and from what FIT cuts of it; infinity without a
    good one. It is tried at eleven places, and at three between two breaks. `one`: the node at `low`."""
    other = CurveNode(places_at([high])[0], heading(high))
    if distance(one.point, other.point) < 1e-6:
        # A stretch without any length is one place; else the curve comes back to where it was.
        between = places_at([low + k / 8 * (high - low) for k in range(1, 8)])
        return (0.0, 0.0) if all(distance(place, one.point) < 1e-6 for place in between) else (inf, inf)
    if abs(turn(one.angle, other.angle)) > _BEND:
        return inf, inf
    joint = biarc_joint(one, other)
    if joint is None:
        return inf, inf
    chord = minus(other.point, one.point)
    middle = dot(minus(joint, one.point), chord)
    span = high - low
    tried = [low + part * span for part in _TRIED]
    inner = [low, *breaks[bisect_right(breaks, low) : bisect_left(breaks, high)], high]
    if len(inner) > 2:
        tried += [p + k / 4 * (q - p) for p, q in pairwise(inner) for k in range(1, 5)][:-1]
    (x, y), (u, v) = one.point, chord
    before: list[XY] = []
    behind: list[XY] = []
    for place in places_at(tried):
        (behind if (place[0] - x) * u + (place[1] - y) * v >= middle else before).append(place)
    first = _off_arc(before, one.point, one.angle, joint)
    # Seen from its end the second arc leaves along the reversed tangent.
    second = _off_arc(behind, other.point, other.angle + pi, joint)
    return max(first[0], second[0]), max(first[1], second[1])


def curve_edge(places_at: At, heading: Heading, breaks: Sequence[float], tolerance: float) -> Edge:
    """Return a smooth curve as an edge whose nodes FIT takes to within `tolerance`, mm.

    `breaks`: parameters in rising order, the first and the last one included; between two of them the curve is as
    smooth as a polynomial of low degree.
    """
    stations = list(_stations(places_at, heading, breaks, tolerance))
    nodes = tuple(CurveNode(place, heading(t)) for place, t in zip(places_at(stations), stations, strict=True))
    spans: list[tuple[float, float, float]] = []
    for (one, other), (low, high) in zip(pairwise(nodes), pairwise(stations), strict=True):
        bend = abs(turn(one.angle, other.angle)) + 0.01
        inner = [low, *breaks[bisect_right(breaks, low) : bisect_left(breaks, high)], high]
        spans += [(begin, end, bend) for begin, end in pairwise(inner)]
    ends = places_at([stations[0], *(end for _, end, _ in spans)])
    samples = [
        _samples(places_at, *span, distance(p, q))[:-1] for span, (p, q) in zip(spans, pairwise(ends), strict=True)
    ]
    samples.append(np.array([nodes[-1].point]))
    return Edge(nodes[0].point, nodes[-1].point, nodes=nodes, samples=np.concatenate(samples))


def _samples(places_at: At, low: float, high: float, bend: float, chord: float) -> Places:
    """Places along a span that bends by an angle, or a part of it without a break in it, both ends included: so many
    that the chords between them are near the curve. `chord`: from end to end, mm."""
    # n chords of a span of length l that bends by θ are lθ/8n² away from it, where it is run through evenly.
    pieces = 2 * ceil(sqrt(chord * bend / 8 / MEASURED) / 2) + 2
    while True:
        places = np.array(places_at([low + k / pieces * (high - low) for k in range(pieces + 1)]))
        # (chords that are twice as long are four times as far away)
        if _off_chords(places[1::2], places[::2]) <= 4 * MEASURED or pieces > _MOST:
            return places
        pieces *= 2


def _off_chords(between: Places, places: Places) -> float:
    """Largest distance of places from the lines that join those before and behind them."""
    (u, v), (p, q) = (places[1:] - places[:-1]).T, (between - places[:-1]).T
    length = np.hypot(u, v)
    if length.all():
        return float((np.abs(u * q - v * p) / length).max())
    stands = length == 0
    return float(np.where(stands, np.hypot(p, q), np.abs(u * q - v * p) / (length + stands)).max())


def _stations(places_at: At, heading: Heading, breaks: Sequence[float], tolerance: float) -> Iterator[float]:
    """The parameters of the nodes: each span as long as the tolerance allows, the last two of one length.

    A biarc's error is of third order: what is tried next follows from the error found. A flat arc is cut as its chord
    and is worse than a longer one that is not flat: so the longest good biarc is looked for, and only where FIT does
    not cut that one well a shorter.
    """
    now, end = breaks[0], breaks[-1]
    least = (end - now) * 1e-6
    step = (end - now) / 8
    tolerance *= _SPARE
    yield now
    while now < end:
        node = CurveNode(places_at([now])[0], heading(now))
        # The longest good step, how far FIT's cut is off there; the shortest bad one.
        good, off_cut, bad = 0.0, inf, inf
        for _ in range(16):
            step = min(step, end - now)
            if step < least:
                break
            off, off_this = _off(places_at, heading, node, now, now + step, breaks)
            if off <= tolerance:
                good, off_cut = step, off_this
                if now + step >= end or off > 0.6 * tolerance:
                    break
            else:
                bad = step
            wanted = step * min(3.0, max(0.2, 0.93 * (tolerance / off) ** (1 / 3) if off else 3.0))
            step = min(wanted, 0.5 * (good + bad) if bad < inf else inf)
            if step <= 1.05 * good:
                break
        step = good or least
        while step > least and off_cut > tolerance:
            step *= 0.8
            off_cut = _off(places_at, heading, node, now, now + step, breaks)[1]
        if now + step < end < now + 1.4 * step:
            step = (end - now) / 2
        now = end if now + step > end - least else now + step
        yield now
        # (behind a place that no biarc takes well, such as a cusp, the way is free again)
        step = step if good else (end - now) / 8
