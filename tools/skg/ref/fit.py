"""Smooth curves through nodes: biarcs (language.md, section 5)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from skg.ref import near, real
from skg.ref.fault import Code, Fault
from skg.ref.geometry import same_point, unit
from skg.ref.real import NEARLY, Real
from skg.ref.values import Circle, Point

#: |t × w| in mm up to which an arc goes out as its chord, and the radius in mm from which it does.
FLAT = Real("0.002")
STRAIGHT = Real(50000)
#: Relative distance to these that is a close call: 32 bits know |t × w| to some 10⁻⁷ mm.
FLAT_NEAR = Real("1e-4")


@dataclass(frozen=True)
class Node:
    """A node, its unit tangent where it is known, and the R of its statement."""

    point: Point
    tangent: Point | None
    offset: Real


def reflected(t: Point, chord: Point) -> Point:
    """A direction mirrored about a chord: the other end's tangent of the circle that begins with it."""
    return chord * (2 * t.dot(chord) / chord.dot(chord)) - t


def circle_tangent(a: Point, b: Point, c: Point) -> Point:
    """Unit tangent at b of the circle through a, b, c in that order; error 6 for a, b, a.

    Inversion about b takes the circle to the line through the images of a and c, parallel to the tangent.
    """
    if same_point(a, c):
        raise Fault(Code.GEOMETRY)
    v, w = b - a, c - b
    t = v * w.dot(w) + w * v.dot(v)
    return t * (1 / t.length())


def joint(p: Point, t: Point, q: Point, u: Point) -> Point:
    """Where the two arcs of a biarc from p (unit tangent t) to q (unit tangent u) meet.

    Both tangent lengths are d = v·v / (v·(t+u) + √((v·(t+u))² + 2(1 - t·u) v·v)) with v = q - p; the joint is
    halfway between p + d·t and q - d·u. Error 6 when there is no positive d.
    """
    v = q - p
    along = v.dot(t + u)
    below = along + real.mp.sqrt(along**2 + 2 * max(1 - t.dot(u), real.ZERO) * v.dot(v))
    if near.at_most(below, NEARLY, "biarc"):
        raise Fault(Code.GEOMETRY)
    d = v.dot(v) / below
    return (p + t * d + q - u * d) * (real.ONE / 2)


def arc(p: Point, t: Point, q: Point) -> Circle | None:
    """The arc from p to q that starts in the unit direction t, or None where its chord goes out."""
    w = q - p
    bulge = t.cross(w)
    near.note("flat arc", (abs(bulge) - FLAT) / FLAT, FLAT_NEAR)
    if abs(bulge) <= FLAT:
        return None
    r = w.dot(w) / (2 * bulge)
    near.note("flat arc", (abs(r) - STRAIGHT) / STRAIGHT, FLAT_NEAR)
    if abs(r) >= STRAIGHT:
        return None
    centre = p + t.left() * r
    return Circle(centre.x, centre.y, r)


class Curve:
    """A run of FIT statements. `feed` takes points and arcs with their R, in the order of the route."""

    def __init__(self, feed: Callable[[Point | Circle, Real], None]) -> None:
        self.feed = feed
        self.nodes: list[Node] = []

    def add(self, node: Node) -> None:
        """The next node; puts out the spans that it makes known."""
        if not self.nodes:
            self.feed(node.point, node.offset)
        elif same_point(self.nodes[-1].point, node.point):
            return
        self.nodes.append(node)
        self._advance(last=False)

    def finish(self) -> None:
        """No more nodes: put out what is left."""
        self._advance(last=True)

    def _advance(self, last: bool) -> None:
        while len(self.nodes) >= 2:
            a, b = self.nodes[:2]
            if b.tangent is None and not self._find_tangent(last):
                return
            b = self.nodes[1]
            if a.tangent is None:
                a = replace(a, tangent=reflected(b.tangent, b.point - a.point))
            self._span(a, b)
            del self.nodes[0]

    def _find_tangent(self, last: bool) -> bool:
        """Find the second node's tangent; False when it takes another node."""
        a, b = self.nodes[:2]
        if len(self.nodes) > 2:
            tangent = circle_tangent(a.point, b.point, self.nodes[2].point)
        elif not last:
            return False
        elif a.tangent is None:
            tangent = unit(a.point, b.point)
        else:
            tangent = reflected(a.tangent, b.point - a.point)
        self.nodes[1] = replace(b, tangent=tangent)
        return True

    def _span(self, a: Node, b: Node) -> None:
        middle = joint(a.point, a.tangent, b.point, b.tangent)
        self._arc(a.point, a.tangent, middle, b.offset)
        if not same_point(middle, b.point):
            self._arc(middle, reflected(b.tangent, b.point - middle), b.point, b.offset)

    def _arc(self, p: Point, t: Point, q: Point, offset: Real) -> None:
        circle = arc(p, t, q)
        if circle is not None:
            self.feed(circle, offset)
        self.feed(q, offset)
