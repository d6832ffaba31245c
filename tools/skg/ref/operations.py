"""The table of operations (language.md, section 2.1)."""

from __future__ import annotations

from collections.abc import Callable

from skg.ref import real
from skg.ref.fault import Code, Fault
from skg.ref.geometry import belt, circle, crossings, mirrored, parallel, turned, unit
from skg.ref.real import ZERO, Real, in_range
from skg.ref.values import C, Circle, D, Line, P, Point, Rotation, S, T, Value, kind


def _checked(p: Point) -> Point:
    return Point(in_range(p.x), in_range(p.y))


def _angle(s: Line, t: Line) -> Real:
    """Angle from the first direction to the second, in (-180, 180]."""
    angle = real.mp.degrees(real.mp.atan2(s.direction.cross(t.direction), s.direction.dot(t.direction)))
    return Real(180) if real.nearly_equal(angle, Real(-180)) else in_range(angle)


def _polar(d: Real, angle: Real) -> Point:
    return _checked(Point(d * real.cos(angle), d * real.sin(angle)))


def _bisector(p: Point, q: Point) -> Line:
    """Perpendicular bisector, p on its left."""
    n = unit(p, q)
    return Line(n.x, n.y, n.dot(p + q) / 2)


def _same_direction(s: Line, p: Point, r: Real = ZERO) -> Line:
    """Parallel to s, leaving the circle of centre p and radius r along its direction."""
    return Line(s.a, s.b, s.normal.dot(p) + r)


def _as_circle(p: Point) -> Circle:
    return Circle(p.x, p.y, ZERO)


#: Each takes values of the kinds in its key.
_Operation = Callable[..., Value]

OPERATIONS: dict[tuple[str, str, str], _Operation] = {
    (D, ",", D): Point,
    (P, ",", P): lambda p, q: in_range((q - p).length()),
    (P, ",", S): lambda p, s: in_range(s.distance(p)),
    (S, ",", P): lambda s, p: in_range(s.distance(p)),
    (S, ",", S): _angle,
    (P, ":", D): circle,
    (C, ":", D): lambda c, d: circle(c.centre, in_range(c.r + d)),
    (S, ":", D): parallel,
    (S, ":", P): _same_direction,
    (S, ":", C): lambda s, c: _same_direction(s, c.centre, c.r),
    (P, ":", P): lambda p, q: belt(_as_circle(p), _as_circle(q)),
    (C, ":", C): belt,
    (C, ":", P): lambda c, p: belt(c, _as_circle(p)),
    (P, ":", C): lambda p, c: belt(_as_circle(p), c),
    (D, ":", P): Rotation,
    (D, "#", D): _polar,
    (P, "#", D): turned,
    (C, "#", D): turned,
    (S, "#", D): turned,
    (P, "#", T): lambda v, t: turned(v, t.angle, t.centre),
    (C, "#", T): lambda v, t: turned(v, t.angle, t.centre),
    (S, "#", T): lambda v, t: turned(v, t.angle, t.centre),
    (P, "#", P): _bisector,
    (P, "#", S): lambda p, s: p - s.normal * s.distance(p),
    (D, "*", D): lambda a, b: in_range(a * b),
    (S, "*", S): lambda e, f: crossings(e, f).left,
    (S, "*", C): lambda e, f: crossings(e, f).left,
    (C, "*", S): lambda e, f: crossings(e, f).left,
    (C, "*", C): lambda e, f: crossings(e, f).left,
    (P, "*", D): lambda p, d: _checked(p * d),
    (D, "*", P): lambda d, p: _checked(p * d),
    (P, "*", P): lambda p, q: in_range(p.dot(q)),
    (P, "/", D): lambda p, d: Point(real.divide(p.x, d), real.divide(p.y, d)),
    (D, "/", D): real.divide,
    (P, "/", S): mirrored,
    (C, "/", S): mirrored,
    (S, "/", S): mirrored,
    (P, "/", P): lambda p, q: circle(p, (q - p).length()),
    (D, "+", D): lambda a, b: in_range(a + b),
    (D, "-", D): lambda a, b: in_range(a - b),
    (P, "+", P): lambda p, q: _checked(p + q),
    (P, "-", P): lambda p, q: _checked(p - q),
}


def operate(left: Value, operator: str, right: Value) -> Value:
    """The result of a two-place operation; error 4 when the table has no such pair."""
    operation = OPERATIONS.get((kind(left), operator, kind(right)))
    if operation is None:
        raise Fault(Code.KINDS)
    return operation(left, right)
