"""Smooth curves as nodes for FIT: as few as its biarcs need to come near enough (language.md, section 5)."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from math import ceil, cos, inf, pi, sin, sqrt

from skg.drawing.contour import CurveNode, Edge
from skg.plane import XY, cross, distance, dot, minus, turn

#: A curve's point at a parameter, and the direction angle of its tangent there (radians).
At = Callable[[float], XY]
Heading = Callable[[float], float]
#: One biarc bends by no more than this, radians.
_BEND = 1.2
#: The part of a tolerance that the tried places take: between them the curve may be a little further away.
_SPARE = 0.9
#: The chords between samples are about this far from the curve, mm; a span has no more samples than the second.
_NEAR, _MOST = 5e-5, 4096
#: FIT cuts an arc as a line that leaves its tangent by no more than the first, or with the second radius or more, mm
#: (language.md, section 5).
_FLAT, _STRAIGHT = 0.002, 50_000.0


def biarc_joint(one: CurveNode, other: CurveNode) -> XY | None:
    """Where the biarc between two nodes changes arcs (language.md, section 5); None if there is none."""
    v = minus(other.point, one.point)
    t, u = ((cos(node.angle), sin(node.angle)) for node in (one, other))
    both = t[0] + u[0], t[1] + u[1]
    square = dot(v, v)
    below = dot(v, both) + sqrt(dot(v, both) ** 2 + 2 * (1 - dot(t, u)) * square)
    if below <= 1e-12 * sqrt(square):
        return None
    d = square / below
    return tuple((p + d * a + q - d * b) / 2 for p, a, q, b in zip(one.point, t, other.point, u, strict=True))


def _off_arc(point: XY, start: XY, angle: float, end: XY) -> tuple[float, float]:
    """Distance of a point from the arc that leaves `start` in direction `angle` for `end`: from the arc itself, and as
    FIT cuts it, a flat or a very large one as the line of its chord (language.md, section 5)."""
    normal = -sin(angle), cos(angle)
    w = minus(end, start)
    height = dot(normal, w)
    square = dot(w, w)
    off_chord = abs(cross(w, minus(point, start))) / sqrt(square)
    if abs(height) < 1e-9:
        return off_chord, off_chord
    radius = square / (2 * height)
    centre = start[0] + radius * normal[0], start[1] + radius * normal[1]
    off = abs(distance(point, centre) - abs(radius))
    return off, off_chord if abs(height) <= _FLAT or abs(radius) >= _STRAIGHT else off


def _off(at: At, heading: Heading, low: float, high: float, breaks: Sequence[float]) -> tuple[float, float]:
    """How far the curve leaves the biarc between two parameters, and what FIT cuts of it; infinity where there is no
    good one. It is tried at eleven places, and at three between two breaks."""
    one, other = (CurveNode(at(t), heading(t)) for t in (low, high))
    if distance(one.point, other.point) < 1e-6:
        # A stretch without any length is one place; else the curve comes back to where it was.
        is_place = all(distance(at(low + k / 8 * (high - low)), one.point) < 1e-6 for k in range(1, 8))
        return (0.0, 0.0) if is_place else (inf, inf)
    if abs(turn(one.angle, other.angle)) > _BEND:
        return inf, inf
    joint = biarc_joint(one, other)
    if joint is None:
        return inf, inf
    chord = minus(other.point, one.point)
    middle = dot(minus(joint, one.point), chord)
    tried = [low + k / 12 * (high - low) for k in range(1, 12)]
    inner = [low, *breaks[bisect_right(breaks, low) : bisect_left(breaks, high)], high]
    if len(inner) > 2:
        tried += [p + k / 4 * (q - p) for p, q in pairwise(inner) for k in range(1, 5)][:-1]
    worst = as_cut = 0.0
    for t in tried:
        point = at(t)
        if dot(minus(point, one.point), chord) < middle:
            off = _off_arc(point, one.point, one.angle, joint)
        else:
            # Seen from its end the second arc leaves along the reversed tangent.
            off = _off_arc(point, other.point, other.angle + pi, joint)
        worst, as_cut = max(worst, off[0]), max(as_cut, off[1])
    return worst, as_cut


def curve_edge(at: At, heading: Heading, breaks: Sequence[float], tolerance: float) -> Edge:
    """Return a smooth curve as an edge whose nodes FIT takes to within `tolerance`, mm.

    `breaks`: parameters in rising order, the first and the last one included; between two of them the curve is as
    smooth as a polynomial of low degree.
    """
    found = list(_stations(at, heading, breaks, tolerance))
    nodes = tuple(CurveNode(at(t), heading(t)) for t in found)
    samples: list[XY] = []
    for (one, other), (low, high) in zip(pairwise(nodes), pairwise(found), strict=True):
        bend = abs(turn(one.angle, other.angle)) + 0.01
        inner = [low, *breaks[bisect_right(breaks, low) : bisect_left(breaks, high)], high]
        for begin, end in pairwise(inner):
            samples += _samples(at, begin, end, bend)[:-1]
    return Edge(nodes[0].point, nodes[-1].point, nodes=nodes, samples=(*samples, nodes[-1].point))


def _samples(at: At, low: float, high: float, bend: float) -> list[XY]:
    """Places along a span that bends by an angle, or a part of it without a break in it, both ends included: so many
    that the chords between them are near the curve."""
    # n chords of a span of length l that bends by θ are lθ/8n² away from it, where it is run through evenly.
    pieces = ceil(sqrt(distance(at(low), at(high)) * bend / 8 / _NEAR) / 2) + 1
    places = [at(low + k / pieces * (high - low)) for k in range(pieces + 1)]
    while True:
        between = [at(low + (k + 0.5) / pieces * (high - low)) for k in range(pieces)]
        off = max(_off_chord(place, p, q) for place, (p, q) in zip(between, pairwise(places), strict=True))
        places = [place for pair in zip(places, between, strict=False) for place in pair] + places[-1:]
        pieces *= 2
        if off <= 4 * _NEAR or pieces > _MOST:
            return places


def _off_chord(place: XY, p: XY, q: XY) -> float:
    """Distance of a place from the line through p and q."""
    length = distance(p, q)
    return abs(cross(minus(q, p), minus(place, p))) / length if length > 0 else distance(place, p)


def _stations(at: At, heading: Heading, breaks: Sequence[float], tolerance: float) -> Iterator[float]:
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
        good, bad = 0.0, inf
        for _ in range(16):
            step = min(step, end - now)
            if step < least:
                break
            off = _off(at, heading, now, now + step, breaks)[0]
            if off <= tolerance:
                good = step
                if now + step >= end or off > 0.6 * tolerance:
                    break
            else:
                bad = step
            wanted = step * min(3.0, max(0.2, 0.93 * (tolerance / off) ** (1 / 3) if off else 3.0))
            step = min(wanted, 0.5 * (good + bad) if bad < inf else inf)
            if step <= 1.05 * good:
                break
        step = good or least
        while step > least and _off(at, heading, now, now + step, breaks)[1] > tolerance:
            step *= 0.8
        if now + step < end < now + 1.4 * step:
            step = (end - now) / 2
        now = end if now + step > end - least else now + step
        yield now
        # (behind a place that no biarc takes well, such as a cusp, the way is free again)
        step = step if good else (end - now) / 8
