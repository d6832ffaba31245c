"""Smooth curves through nodes: biarcs (language.md, section 5)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from skg.ref import near, real
from skg.ref.fault import Code, Fault
from skg.ref.geometry import same_point, unit
from skg.ref.real import MICRON, NEARLY, Real
from skg.ref.values import Circle, Point

#: |t × w| in mm up to which an arc goes out as its chord, and the radius in mm from which it does.
FLAT = Real("0.002")
STRAIGHT = Real(50000)
#: Relative distance to these that is a close call: 32 bits know |t × w| to some 10⁻⁷ mm.
FLAT_NEAR = Real("1e-4")

#: Sums that are smaller than their terms by this have lost bits: the biarc's denominator where the tangents run back,
#: the tangent of a circle where the nodes do.
BACKWARDS = Real("2e-2")
#: mm: what 32 bits leave open of how far a node is from a biarc, at 100 mm; 33 bits miss it by up to 4·10⁻⁸.
PASSED_NEAR = Real("3e-7")
#: Most nodes that TOL may pass over between two that it keeps.
MOST_PASSED = 15


@dataclass(frozen=True)
class Node:
    """A node, its unit tangent where it is known, and the R of its statement."""

    point: Point
    tangent: Point | None
    offset: Real

    @property
    def way(self) -> Point:
        """The unit tangent, once it is known."""
        assert self.tangent is not None
        return self.tangent


def mirrored(t: Point, chord: Point) -> Point:
    """A direction mirrored about a chord: the other end's tangent of the circle that begins with it."""
    return chord * (2 * t.dot(chord) / chord.dot(chord)) - t


def circle_tangent(a: Point, b: Point, c: Point) -> Point:
    """Unit tangent at b of the circle through a, b, c in that order; error 6 for a, b, a.

    Inversion about b takes the circle to the line through the images of a and c, parallel to the tangent.
    """
    if same_point(a, c):
        raise Fault(Code.GEOMETRY)
    v, w = b - a, c - b
    near.note("there and back", (c - a).length() / (v.length() + w.length()), BACKWARDS)
    t = v * w.dot(w) + w * v.dot(v)
    return t * (1 / t.length())


def corners(p: Point, t: Point, q: Point, u: Point) -> tuple[Point, Point]:
    """Points at which the end tangents of a biarc from p (unit tangent t) to q (unit tangent u) meet that at its joint.

    All tangent lengths are d = v·v / (v·(t+u) + √((v·(t+u))² + 2(1 - t·u) v·v)) with v = q - p, so the corners are
    p + d·t and q - d·u, and the joint is halfway between them. Error 6 when there is no positive d.
    """
    v = q - p
    along = v.dot(t + u)
    below = along + real.mp.sqrt(along**2 + 2 * max(1 - t.dot(u), real.ZERO) * v.dot(v))
    near.note("backward tangents", below / v.length(), BACKWARDS)
    if below <= NEARLY:
        raise Fault(Code.GEOMETRY)
    d = v.dot(v) / below
    return p + t * d, q - u * d


def joint(p: Point, t: Point, q: Point, u: Point) -> Point:
    """The joint of a biarc's two arcs; error 6 as in `corners`."""
    c, d = corners(p, t, q, u)
    return (c + d) * (real.ONE / 2)


def within(a: Node, b: Node, passed: list[Node], tolerance: Real) -> bool:
    """True if all passed nodes lie within the tolerance of the biarc from a to b (TOL, docs/curves.md).

    The biarc must begin and end forwards on the whole: v·(t+u) > 1 µm, v the chord; it exists then. (Half a circle has
    0, and so has a curve that ends where it began: neither may hang on the last bits.) The joint's normal parts the
    nodes: those before it are compared with the arc at a, the others with the arc at b, walked backwards. Where a node
    lies on that very line both arcs give the same answer: no close call.
    """
    chord = b.point - a.point
    forwards = chord.dot(a.way + b.way)
    near.note("passed node", forwards - MICRON, near.RELATIVE * max(chord.length(), real.ONE))
    if forwards <= MICRON:
        return False
    c, d = corners(a.point, a.way, b.point, b.way)
    middle, across = (c + d) * (real.ONE / 2), d - c
    ends = [(n.point, t, middle - n.point) for n, t in ((a, a.way), (b, -b.way))]
    worst = max(excess(*ends[(n.point - middle).dot(across) > 0], n.point, tolerance) for n in passed)
    near.note("passed node", worst, PASSED_NEAR)
    return worst <= 0


def excess(p: Point, t: Point, w: Point, node: Point, tolerance: Real) -> Real:
    """By how much (mm) a node is too far from the arc from p in the unit direction t with the chord w; 0 will do.

    With q the node from p and k = t×w / w·w, half the arc's curvature, the node is within e of the circle when
    |k (q·q - e²) - t×q| <= e, exactly, and of a line too (k = 0). Each arc of a biarc turns less than half round, so
    q·t >= 0 is all that is left to ask.
    """
    q = node - p
    k = t.cross(w) / w.dot(w)
    off = k * (q.dot(q) - tolerance**2) - t.cross(q)
    outside, inside = (off, -off) if k > 0 else (-off, off)
    if 2 * abs(k) * tolerance > 1:  # within the circle nothing is farther from it than its radius
        inside = outside
    return max(max(outside, inside) - tolerance, -q.dot(t))


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


class FittedCurve:
    """A run of FIT statements. `feed` takes points and arcs with their R, in the order of the route.

    With a tolerance (mm on the tape) nodes are passed over: a span is held back until the next node, and goes on to
    that one when the biarc from the last kept node still comes within the tolerance of every node between.
    """

    def __init__(self, feed: Callable[[Point | Circle, Real], None], tolerance: Real = real.ZERO) -> None:
        self.feed = feed
        self.tolerance = tolerance
        self.nodes: list[Node] = []
        # With a tolerance: the last kept node, and the nodes after it, of which the last ends the span held back.
        self.kept: Node | None = None
        self.after: list[Node] = []

    def add(self, node: Node) -> None:
        """The next node; puts out the spans that it makes known."""
        if not self.nodes:
            self.feed(node.point, node.offset)
        elif same_point(self.nodes[-1].point, node.point):
            return
        else:
            near.note("short chord", (node.point - self.nodes[-1].point).length(), near.SHORT)
        self.nodes.append(node)
        self._advance(last=False)

    def finish(self) -> None:
        """No more nodes: put out what is left."""
        self._advance(last=True)
        if self.kept is not None:
            self._span(self.kept, self.after[-1])

    def _advance(self, last: bool) -> None:
        while len(self.nodes) >= 2:
            a, b = self.nodes[:2]
            if b.tangent is None and not self._find_tangent(last):
                return
            b = self.nodes[1]
            if a.tangent is None:
                a = replace(a, tangent=mirrored(b.way, b.point - a.point))
            if self.tolerance:
                self._hold(a, b)
            else:
                self._span(a, b)
            del self.nodes[0]

    def _hold(self, a: Node, b: Node) -> None:
        """Hold back the span to b, in the place of the one to a when it can be, else after that one."""
        if self.kept is not None:
            if len(self.after) <= MOST_PASSED and within(self.kept, b, self.after, self.tolerance):
                self.after.append(b)
                return
            self._span(self.kept, a)
        self.kept, self.after = a, [b]

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
            tangent = mirrored(a.tangent, b.point - a.point)
        self.nodes[1] = replace(b, tangent=tangent)
        return True

    def _span(self, a: Node, b: Node) -> None:
        middle = joint(a.point, a.way, b.point, b.way)
        self._arc(a.point, a.way, middle, b.offset)
        if same_point(middle, b.point):
            self.feed(b.point, b.offset)  # which the route drops, unless the joint is the node before as well
        else:
            self._arc(middle, mirrored(b.way, b.point - middle), b.point, b.offset)

    def _arc(self, p: Point, t: Point, q: Point, offset: Real) -> None:
        circle = self._circle(p, t, q)
        if circle is not None:
            self.feed(circle, offset)
        self.feed(q, offset)

    def _circle(self, p: Point, t: Point, q: Point) -> Circle | None:
        return arc(p, t, q)
