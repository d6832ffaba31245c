"""Smooth curves as nodes for FIT: as few as its biarcs need to come near enough (language.md, section 5)."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import ceil, cos, pi, sin, sqrt

from skg.drawing.contour import CurveNode, Edge
from skg.plane import XY, cross, distance, dot, minus, turn
from skg.ref.fit import FLAT, STRAIGHT

#: A curve's point and the direction angle of its tangent (radians) at a parameter.
Parametric = Callable[[float], tuple[XY, float]]
#: FIT cuts an arc as a line that leaves its tangent by no more than the first, or with the second radius or more, mm.
_FLAT, _STRAIGHT = float(FLAT), float(STRAIGHT)


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
    return tuple((p + d * a + q - d * b) / 2
                 for p, a, q, b in zip(one.point, t, other.point, u, strict=True))


def _off_arc(point: XY, start: XY, angle: float, end: XY) -> float:
    """Distance of a point from the arc that leaves `start` in direction `angle` for `end`, as FIT cuts it: a flat
    or a very large one as the line of its chord (language.md, section 5)."""
    normal = -sin(angle), cos(angle)
    w = minus(end, start)
    height = dot(normal, w)
    square = dot(w, w)
    if abs(height) <= _FLAT or square >= 2 * _STRAIGHT * abs(height):
        return abs(cross(w, minus(point, start))) / sqrt(square)
    radius = square / (2 * height)
    centre = start[0] + radius * normal[0], start[1] + radius * normal[1]
    return abs(distance(point, centre) - abs(radius))


def _fits(curve: Parametric, low: float, high: float, tolerance: float) -> bool:
    """Whether the biarc between two parameters stays within the tolerance of the curve."""
    one, other = (CurveNode(*curve(t)) for t in (low, high))
    if distance(one.point, other.point) < 1e-6 or abs(turn(one.angle, other.angle)) > 1.2:
        return False
    joint = biarc_joint(one, other)
    if joint is None:
        return False
    chord = minus(other.point, one.point)
    middle = dot(minus(joint, one.point), chord)
    for k in range(1, 12):
        point = curve(low + k / 12 * (high - low))[0]
        if dot(minus(point, one.point), chord) < middle:
            off = _off_arc(point, one.point, one.angle, joint)
        else:
            # Seen from its end the second arc leaves along the reversed tangent.
            off = _off_arc(point, other.point, other.angle + pi, joint)
        if off > tolerance:
            return False
    return True


def curve_edge(curve: Parametric, breaks: list[float], tolerance: float) -> Edge:
    """Return a smooth curve as an edge whose nodes FIT takes to within `tolerance`, mm.

    `breaks` are parameters, the first and the last one included, between which halving begins.
    """
    found = [breaks[0]]

    def halve(low: float, high: float, depth: int) -> None:
        if depth < 14 and not _fits(curve, low, high, tolerance):
            middle = (low + high) / 2
            halve(low, middle, depth + 1)
            halve(middle, high, depth + 1)
        else:
            found.append(high)

    for low, high in pairwise(breaks):
        halve(low, high, 0)
    nodes = tuple(CurveNode(*curve(t)) for t in found)
    samples: list[XY] = []
    for low, high in pairwise(found):
        # n chords of a span of length l that bends by θ are lθ/8n² away from it: 0.05 µm here.
        one, other = (CurveNode(*curve(t)) for t in (low, high))
        bend = abs(turn(one.angle, other.angle)) + 0.01
        pieces = ceil(sqrt(distance(one.point, other.point) * bend / 8 / 5e-5)) + 3
        samples += [curve(low + k / pieces * (high - low))[0] for k in range(pieces)]
    return Edge(nodes[0].point, nodes[-1].point, nodes=nodes, samples=(*samples, nodes[-1].point))
