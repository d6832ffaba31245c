"""Points, circles and lines put together: crossings, tangents, images, places on a curve.

Lengths are in millimetres, angles in degrees. Everything is solved directly from the equations of the curves.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import overload

from skg.ref import near, real
from skg.ref.fault import Code, Fault
from skg.ref.real import MICRON, NEARLY, Real
from skg.ref.values import ORIGIN, Circle, Curve, Line, Point, Rotation, Value

#: Sine of a crossing angle below which a float's last bits are magnified a hundred times: worth a note.
SHALLOW = 1e-2


def circle(centre: Point, r: Real) -> Circle:
    """A circle; error 5 when its radius is zero."""
    if near.at_most(abs(r), NEARLY, "zero radius"):
        raise Fault(Code.RANGE)
    return Circle(centre.x, centre.y, r)


def line_along(direction: Point, p: Point) -> Line:
    """The line through p in a unit direction."""
    normal = -direction.left()
    return Line(normal.x, normal.y, normal.dot(p))


def unit(p: Point, q: Point) -> Point:
    """Unit vector from p to q; error 6 when they are one point."""
    v = q - p
    length = v.length()
    if near.at_most(length, NEARLY, "same point"):
        raise Fault(Code.GEOMETRY)
    return v * (1 / length)


def through(p: Point, q: Point) -> Line:
    """P:P, the line from p to q."""
    return line_along(unit(p, q), p)


# Crossings -----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Crossings:
    """Meeting points of two curves: the left-turn and the right-turn point from the first curve to the second.

    One point alone (lines; curves that touch) is both. `gap` is by how much the curves miss each other
    (negative: by how much they cross) at their closest approach, None for two lines.
    """

    left: Point
    right: Point
    gap: Real | None = None


def crossings(e: Curve, f: Curve, touch: Real = MICRON) -> Crossings:
    """Both crossings of two curves; error 6 when there is none.

    Curves that miss each other by 1 µm or less, or cross by `touch` (mm) or less, touch: one point, on the circle
    (of two, on the first). Circles whose centres lie no more than `touch` apart, nor than 10⁻⁷ mm, are concentric.
    """
    if isinstance(e, Line):
        if isinstance(f, Line):
            return _line_line(e, f)
        return _line_circle(e, f, touch)
    if isinstance(f, Line):
        c = _line_circle(f, e, touch)
        return Crossings(c.right, c.left, c.gap)
    return _circle_circle(e, f, touch)


def _touch(gap: Real, touch: Real) -> bool:
    """True if the curves touch; error 6 when they miss each other."""
    if gap > 0:
        if not near.at_most(gap, MICRON, "touching"):
            raise Fault(Code.GEOMETRY)
        return True
    near.note("touching", gap + touch, 1e-7)
    return -gap <= touch


def _line_line(e: Line, f: Line) -> Crossings:
    sine = e.normal.cross(f.normal)
    if near.at_most(abs(sine), NEARLY, "parallel lines"):
        raise Fault(Code.GEOMETRY)
    near.note("shallow crossing", sine, SHALLOW)
    p = Point((e.g * f.b - f.g * e.b) / sine, (e.a * f.g - f.a * e.g) / sine)
    return Crossings(p, p)


def _line_circle(e: Line, c: Circle, touch: Real) -> Crossings:
    distance = e.distance(c.centre)
    foot = c.centre - e.normal * distance
    gap = abs(distance) - abs(c.r)
    if _touch(gap, touch):
        p = c.centre - e.normal * (abs(c.r) if distance > 0 else -abs(c.r))
        return Crossings(p, p, gap)
    half_chord = real.mp.sqrt(c.r**2 - distance**2)
    near.note("shallow crossing", half_chord / c.r, SHALLOW)
    ahead = e.direction * (half_chord if c.r > 0 else -half_chord)
    return Crossings(foot + ahead, foot - ahead, gap)


def _circle_circle(c1: Circle, c2: Circle, touch: Real) -> Crossings:
    d = (c2.centre - c1.centre).length()
    if near.at_most(d, max(touch, NEARLY), "concentric"):
        raise Fault(Code.GEOMETRY)
    to_second = (c2.centre - c1.centre) * (1 / d)
    r1, r2 = abs(c1.r), abs(c2.r)
    outer, inner = d - (r1 + r2), abs(r1 - r2) - d
    gap = max(outer, inner)
    if _touch(gap, touch):
        p = c1.centre + to_second * (r1 if outer >= inner or r1 > r2 else -r1)
        return Crossings(p, p, gap)
    along = (d**2 + r1**2 - r2**2) / (2 * d)
    half_chord = real.mp.sqrt(r1**2 - along**2)
    near.note("shallow crossing", half_chord * d / (r1 * r2), SHALLOW)
    foot = c1.centre + to_second * along
    aside = to_second.left() * (half_chord if c1.r * c2.r > 0 else -half_chord)
    return Crossings(foot + aside, foot - aside, gap)


def belt(c1: Circle, c2: Circle) -> Line:
    """The line that leaves c1 along its direction and joins c2 along its own; a radius may be 0.

    From α·xi + β·yi + ri = γ for both, the normal's part along the line of centres is (r1 - r2)/d; of its
    two other parts the one is taken that makes the line run from the first circle to the second.
    """
    v = c2.centre - c1.centre
    d = v.length()
    if near.at_most(d, MICRON, "concentric"):
        raise Fault(Code.GEOMETRY)
    along = v * (1 / d)
    difference = c1.r - c2.r
    gap = abs(difference) - d
    if difference != 0 and near.at_most(abs(gap), MICRON, "touching"):
        normal = along if difference > 0 else -along
        return Line(normal.x, normal.y, normal.dot(c1.centre) + c1.r)
    if gap > 0:
        raise Fault(Code.GEOMETRY)
    k = difference / d
    normal = along * k - along.left() * real.mp.sqrt(1 - k * k)
    return Line(normal.x, normal.y, normal.dot(c1.centre) + c1.r)


# Moves that keep the kind --------------------------------------------------------------------------------


def negate(v: Value) -> Value:
    """Unary minus: a number, both coordinates, the sense of a circle, the direction of a line."""
    match v:
        case Point():
            return -v
        case Circle(x, y, r):
            return Circle(x, y, -r)
        case Line(a, b, g):
            return Line(-a, -b, -g)
        case Rotation():
            raise Fault(Code.KINDS)
    return -v


@overload
def turned(v: Point, angle: Real, about: Point = ...) -> Point: ...
@overload
def turned(v: Circle, angle: Real, about: Point = ...) -> Circle: ...
@overload
def turned(v: Line, angle: Real, about: Point = ...) -> Line: ...
def turned(v: Point | Circle | Line, angle: Real, about: Point = ORIGIN) -> Point | Circle | Line:
    """Turned counter-clockwise about a point."""
    c, s = real.cos(angle), real.sin(angle)

    def spin(p: Point) -> Point:
        return Point(p.x * c - p.y * s, p.x * s + p.y * c)

    match v:
        case Point():
            return about + spin(v - about)
        case Circle():
            p = about + spin(v.centre - about)
            return Circle(p.x, p.y, v.r)
        case Line():
            n = spin(v.normal)
            return Line(n.x, n.y, v.g - v.normal.dot(about) + n.dot(about))


@overload
def mirrored(v: Point, s: Line) -> Point: ...
@overload
def mirrored(v: Circle, s: Line) -> Circle: ...
@overload
def mirrored(v: Line, s: Line) -> Line: ...
def mirrored(v: Point | Circle | Line, s: Line) -> Point | Circle | Line:
    """Mirror image of a point, quasi-mirror image of a circle (same sense) or a line (reversed)."""
    match v:
        case Point():
            return v - s.normal * (2 * s.distance(v))
        case Circle():
            p = mirrored(v.centre, s)
            return Circle(p.x, p.y, v.r)
        case Line():
            k = 2 * v.normal.dot(s.normal)
            n = v.normal - s.normal * k
            return Line(n.x, n.y, v.g - k * s.g)


@overload
def enlarged(v: Point, factor: Real) -> Point: ...
@overload
def enlarged(v: Circle, factor: Real) -> Circle: ...
@overload
def enlarged(v: Line, factor: Real) -> Line: ...
def enlarged(v: Point | Circle | Line, factor: Real) -> Point | Circle | Line:
    """The drawing enlarged about O (SCALE)."""
    match v:
        case Point():
            return v * factor
        case Circle(x, y, r):
            return Circle(x * factor, y * factor, r * factor)
        case Line(a, b, g):
            return Line(a, b, g * factor)


@overload
def parallel(v: Line, distance: Real) -> Line: ...
@overload
def parallel(v: Circle, distance: Real) -> Circle: ...
def parallel(v: Curve, distance: Real) -> Curve:
    """`S:D`, `C:D`: moved to the right of travel. The radius is not checked."""
    match v:
        case Line(a, b, g):
            return Line(a, b, g + distance)
        case Circle(x, y, r):
            return Circle(x, y, r + distance)


# Places on a curve ---------------------------------------------------------------------------------------


def outward(c: Circle, p: Point) -> Point:
    """Unit vector from the centre towards p; error 6 at the centre."""
    return unit(c.centre, p)


def right(curve: Curve, p: Point) -> Point:
    """Unit vector to the right of travel at a point of the curve."""
    if isinstance(curve, Line):
        return curve.normal
    return outward(curve, p) if curve.r > 0 else -outward(curve, p)


def direction(curve: Curve, p: Point) -> Point:
    """Unit vector of travel at a point of the curve."""
    return right(curve, p).left()


def turn_angle(e: Curve, f: Curve, p: Point) -> Real:
    """Angle in radians from e's direction to f's at a point of both, in (-π, π], left positive."""
    d, t = direction(e, p), direction(f, p)
    return real.mp.atan2(d.cross(t), d.dot(t))


def place(curve: Curve, p: Point, offset: Real) -> Point:
    """A point of a curve, moved by the offset to the right of travel."""
    return p if offset == 0 else p + right(curve, p) * offset


def nearest(curve: Curve, p: Point) -> Point:
    """The nearest point of a curve; on a circle, from its very centre, the one at its +X side."""
    if isinstance(curve, Line):
        return p - curve.normal * curve.distance(p)
    if near.at_most((p - curve.centre).length(), MICRON, "at the centre"):
        return curve.centre + Point(abs(curve.r), real.ZERO)
    return curve.centre + outward(curve, p) * abs(curve.r)


def check_on(curve: Curve, p: Point) -> None:
    """Error 6 when the curve does not pass the point within 1 µm."""
    off = curve.distance(p) if isinstance(curve, Line) else (p - curve.centre).length() - abs(curve.r)
    if not near.at_most(abs(off), MICRON, "point on curve"):
        raise Fault(Code.GEOMETRY)


def same_point(p: Point, q: Point) -> bool:
    """Within 1 µm."""
    return near.at_most((q - p).length(), MICRON, "same point")


def same_circle(c1: Circle, c2: Circle) -> bool:
    """Centre and radius within 1 µm."""
    return near.at_most((c2.centre - c1.centre).length(), MICRON, "same circle") and near.at_most(
        abs(c2.r - c1.r), MICRON, "same circle"
    )


def sweep(c: Circle, start: Point, end: Point) -> Real:
    """Angle in radians travelled on a circle by its sense between two points of it, in (0, 2π]."""
    u, v = start - c.centre, end - c.centre
    angle = real.mp.atan2(u.cross(v), u.dot(v))
    if c.r < 0:
        angle = -angle
    return angle if angle > 0 else angle + 2 * real.mp.pi
