"""Points, directed lines and directed circles of the plane with 50 digits; lengths in mm, angles in degrees.

What the translators compute with. "Near" is the micrometre of the specifications: curves that miss each other, or
cross, by no more than that touch.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, overload

import mpmath

from skg.messages.finding import Phrase

mp = mpmath.mp.clone()
mp.dps = 50
if TYPE_CHECKING:
    from mpmath import mpf as Real
else:
    Real = mp.mpf

ZERO = Real(0)
#: 1 µm in mm.
NEAR = Real("0.001")
#: Below this a length (mm) or the sine of an angle is zero.
TINY = Real("1e-7")
#: Directions closer than this (radians) are one direction.
SAME_WAY = Real("0.001")


class PlaneError(Exception):
    """Geometry that there is not: the reason, `why`."""

    def __init__(self, code: str, **values: Any) -> None:  # noqa: ANN401
        super().__init__(code)
        self.why = Phrase(code, **values)


@dataclass(frozen=True)
class ExactPoint:
    """The point (x, y); a vector too."""

    x: Real
    y: Real

    def __add__(self, other: ExactPoint) -> ExactPoint:
        return ExactPoint(self.x + other.x, self.y + other.y)

    def __sub__(self, other: ExactPoint) -> ExactPoint:
        return ExactPoint(self.x - other.x, self.y - other.y)

    def __mul__(self, factor: Real) -> ExactPoint:
        return ExactPoint(self.x * factor, self.y * factor)

    def __neg__(self) -> ExactPoint:
        return ExactPoint(-self.x, -self.y)

    def dot(self, other: ExactPoint) -> Real:
        """Scalar product."""
        return self.x * other.x + self.y * other.y

    def cross(self, other: ExactPoint) -> Real:
        """z of the vector product: positive when `other` points to the left."""
        return self.x * other.y - self.y * other.x

    def left(self) -> ExactPoint:
        """Turned by +90 degrees."""
        return ExactPoint(-self.y, self.x)

    def size(self) -> Real:
        """Length."""
        return mp.hypot(self.x, self.y)

    def unit(self) -> ExactPoint:
        """The unit vector; `PlaneError` for none."""
        size = self.size()
        if size <= TINY:
            raise PlaneError("rival-no-direction")
        return self * (1 / size)


@dataclass(frozen=True)
class ExactLine:
    """The line through `point` along the unit vector `way`."""

    point: ExactPoint
    way: ExactPoint

    def __neg__(self) -> ExactLine:
        return ExactLine(self.point, -self.way)

    def beside(self, p: ExactPoint) -> Real:
        """Distance of a point to the left."""
        return self.way.cross(p - self.point)

    def ahead(self, p: ExactPoint) -> Real:
        """Distance of a point ahead of the line's own."""
        return self.way.dot(p - self.point)


@dataclass(frozen=True)
class ExactCircle:
    """A circle with the sign of its sense: r > 0 runs counter-clockwise, r < 0 clockwise."""

    centre: ExactPoint
    r: Real

    def __neg__(self) -> ExactCircle:
        return ExactCircle(self.centre, -self.r)

    def beside(self, p: ExactPoint) -> Real:
        """Distance of a point to the left of the way (inside, counter-clockwise)."""
        off = abs(self.r) - (p - self.centre).size()
        return off if self.r > 0 else -off


ExactCurve = ExactLine | ExactCircle
ExactElement = ExactPoint | ExactCurve
#: A row of linear equations a·x + b·y + k·R = m, and a place of their space.
_Row = tuple[Real, Real, Real, Real]
_Triple = tuple[Real, Real, Real]


# Angles ------------------------------------------------------------------------------------------------------


def direction(angle: Real) -> ExactPoint:
    """Unit vector at a direction angle, exact at multiples of 90 degrees."""
    quarters = angle / 90
    if quarters == mp.floor(quarters):
        x, y = ((1, 0), (0, 1), (-1, 0), (0, -1))[int(quarters) % 4]
        return ExactPoint(Real(x), Real(y))
    radians = mp.radians(mp.fmod(angle, 360))
    return ExactPoint(mp.cos(radians), mp.sin(radians))


def turn(u: ExactPoint, v: ExactPoint) -> Real:
    """Angle from one vector to another, radians in (−π, π], left positive."""
    angle = mp.atan2(u.cross(v), u.dot(v))
    return mp.pi if angle <= -mp.pi else angle


@overload
def rotated(e: ExactPoint, angle: Real, about: ExactPoint) -> ExactPoint: ...
@overload
def rotated(e: ExactLine, angle: Real, about: ExactPoint) -> ExactLine: ...
@overload
def rotated(e: ExactCircle, angle: Real, about: ExactPoint) -> ExactCircle: ...
def rotated(e: ExactElement, angle: Real, about: ExactPoint) -> ExactElement:
    """Turned about a point, counter-clockwise; circles keep their sense."""
    d = direction(angle)

    def spin(v: ExactPoint) -> ExactPoint:
        return ExactPoint(v.x * d.x - v.y * d.y, v.x * d.y + v.y * d.x)

    match e:
        case ExactPoint():
            return about + spin(e - about)
        case ExactLine(point, way):
            return ExactLine(about + spin(point - about), spin(way))
        case ExactCircle(centre, r):
            return ExactCircle(about + spin(centre - about), r)


@overload
def moved(e: ExactPoint, by: ExactPoint) -> ExactPoint: ...
@overload
def moved(e: ExactLine, by: ExactPoint) -> ExactLine: ...
@overload
def moved(e: ExactCircle, by: ExactPoint) -> ExactCircle: ...
def moved(e: ExactElement, by: ExactPoint) -> ExactElement:
    """Moved by a vector."""
    match e:
        case ExactPoint():
            return e + by
        case ExactLine(point, way):
            return ExactLine(point + by, way)
        case ExactCircle(centre, r):
            return ExactCircle(centre + by, r)


@overload
def mirrored(e: ExactPoint, mirror: ExactLine) -> ExactPoint: ...
@overload
def mirrored(e: ExactLine, mirror: ExactLine) -> ExactLine: ...
@overload
def mirrored(e: ExactCircle, mirror: ExactLine) -> ExactCircle: ...
def mirrored(e: ExactElement, mirror: ExactLine) -> ExactElement:
    """Mirror image; a line's arrow is mirrored with it, a circle keeps its sense."""

    def image(p: ExactPoint) -> ExactPoint:
        return p - mirror.way.left() * (2 * mirror.beside(p))

    match e:
        case ExactPoint():
            return image(e)
        case ExactLine(point, way):
            return ExactLine(image(point), image(mirror.point + way) - image(mirror.point))
        case ExactCircle(centre, r):
            return ExactCircle(image(centre), r)


# Lines and circles from others -------------------------------------------------------------------------------


def foot(p: ExactPoint, line: ExactLine) -> ExactPoint:
    """The nearest point of a line."""
    return line.point + line.way * line.ahead(p)


@overload
def parallel(curve: ExactLine, to_right: Real) -> ExactLine: ...
@overload
def parallel(curve: ExactCircle, to_right: Real) -> ExactCircle: ...
def parallel(curve: ExactCurve, to_right: Real) -> ExactCurve:
    """Moved to the right of its way; a circle's radius is not looked at."""
    if isinstance(curve, ExactLine):
        return ExactLine(curve.point - curve.way.left() * to_right, curve.way)
    return ExactCircle(curve.centre, curve.r + to_right)


def touching_line(place: ExactPoint | ExactCircle, direction: ExactPoint) -> ExactLine:
    """The line along a unit vector through a point, or touching a circle where it runs that way."""
    if isinstance(place, ExactPoint):
        return ExactLine(place, direction)
    return ExactLine(place.centre - direction.left() * place.r, direction)


def belt_line(e: ExactPoint | ExactCircle, f: ExactPoint | ExactCircle) -> ExactLine | None:
    """The line that leaves e and joins f, each in its own direction; its point is where it leaves.

    None where the circles touch running the same way (near): there is no line between them. `PlaneError` when
    there is no such line. With u the unit vector from centre to centre, at distance d, the sought way w has
    w·u = cos t and lies left of u by sin t = (r1 − r2)/d: both centres lie left of it by their signed radii.
    """
    (c1, r1), (c2, r2) = ((g, ZERO) if isinstance(g, ExactPoint) else (g.centre, g.r) for g in (e, f))
    v = c2 - c1
    d = v.size()
    if abs(d - abs(r1 - r2)) <= NEAR and r1 != r2:
        return None
    if d <= NEAR or d < abs(r1 - r2):
        raise PlaneError("rival-no-tangent")
    u = v * (1 / d)
    sine = (r1 - r2) / d
    direction = u * mp.sqrt(1 - sine * sine) + u.left() * sine
    return ExactLine(c1 - direction.left() * r1, direction)


def joining_line(e: ExactPoint | ExactCircle, f: ExactPoint | ExactCircle) -> ExactLine:
    """The line that leaves e and joins f, each in its own direction; where they touch, the tangent there."""
    line = belt_line(e, f)
    if line is not None:
        return line
    if isinstance(e, ExactCircle):
        touch = f if isinstance(f, ExactPoint) else touching_point(e, f)
        return ExactLine(touch, way_at(e, touch))
    assert isinstance(f, ExactCircle), "between two points there is a line"
    return ExactLine(e, way_at(f, e))


# Places on a curve -------------------------------------------------------------------------------------------


def way_at(curve: ExactCurve, p: ExactPoint) -> ExactPoint:
    """Unit vector of travel at (or square beside) a point of a curve."""
    if isinstance(curve, ExactLine):
        return curve.way
    out = (p - curve.centre).unit()
    return out.left() if curve.r > 0 else -out.left()


def on(curve: ExactCurve, p: ExactPoint) -> bool:
    """True if the curve passes through the point (near)."""
    return abs(curve.beside(p)) <= NEAR


def same_point(p: ExactPoint, q: ExactPoint) -> bool:
    """Near each other."""
    return (q - p).size() <= NEAR


def same_circle(c1: ExactCircle, c2: ExactCircle) -> bool:
    """Centre and radius near, the same sense."""
    return same_point(c1.centre, c2.centre) and abs(c1.r - c2.r) <= NEAR


def nearest(p: ExactPoint, curve: ExactCurve) -> ExactPoint:
    """The nearest point of a curve; on a circle, from its centre, the one on its +X side."""
    if isinstance(curve, ExactLine):
        return foot(p, curve)
    if same_point(p, curve.centre):
        return curve.centre + ExactPoint(abs(curve.r), ZERO)
    return curve.centre + (p - curve.centre).unit() * abs(curve.r)


def sweep(circle: ExactCircle, start: ExactPoint, end: ExactPoint) -> Real:
    """Angle travelled on a circle by its sense, radians in [0, 2π)."""
    angle = turn(start - circle.centre, end - circle.centre)
    if circle.r < 0:
        angle = -angle
    return angle if angle >= 0 else angle + 2 * mp.pi


def touching_point(circle: ExactCircle, other: ExactCurve) -> ExactPoint:
    """The place on a circle that is nearest to a curve that touches it, and runs as the circle does there."""
    if isinstance(other, ExactLine):
        return circle.centre + other.way.left() * (-circle.r)
    apart = (other.centre - circle.centre).unit()
    # Running the same way: the centres lie on one side where the senses are equal.
    inside = circle.r * other.r > 0 and abs(circle.r) < abs(other.r)
    return circle.centre + apart * (-abs(circle.r) if inside else abs(circle.r))


# Crossings ---------------------------------------------------------------------------------------------------


def crossings(e: ExactCurve, f: ExactCurve, touch: Real = NEAR) -> tuple[ExactPoint, ...]:
    """Crossings of two curves: two points, or one if they touch (within `touch`) or are lines.

    `PlaneError` when they miss each other by more than near, or never cross.
    """
    if isinstance(e, ExactLine):
        return (_of_lines(e, f),) if isinstance(f, ExactLine) else _of_line(e, f, touch)
    return _of_line(f, e, touch) if isinstance(f, ExactLine) else _of_circles(e, f, touch)


def _of_lines(e: ExactLine, f: ExactLine) -> ExactPoint:
    sine = e.way.cross(f.way)
    if abs(sine) <= TINY:
        raise PlaneError("rival-parallel")
    return e.point + e.way * ((f.point - e.point).cross(f.way) / sine)


def _of_line(line: ExactLine, circle: ExactCircle, touch: Real) -> tuple[ExactPoint, ...]:
    middle = foot(circle.centre, line)
    d, r = (middle - circle.centre).size(), abs(circle.r)
    if d > r + NEAR:
        raise PlaneError("rival-line-misses")
    if d >= r - touch:
        return (circle.centre + (middle - circle.centre).unit() * r,)
    half = line.way * mp.sqrt(r * r - d * d)
    return middle - half, middle + half


def _of_circles(c1: ExactCircle, c2: ExactCircle, touch: Real) -> tuple[ExactPoint, ...]:
    v = c2.centre - c1.centre
    d, r1, r2 = v.size(), abs(c1.r), abs(c2.r)
    if d <= max(touch, TINY):
        raise PlaneError("rival-concentric")
    u = v * (1 / d)
    gap = max(d - r1 - r2, abs(r1 - r2) - d)
    if gap > NEAR:
        raise PlaneError("rival-circles-miss")
    if gap >= -touch:
        inner = abs(r1 - r2) - d > d - r1 - r2
        return (c1.centre + u * (-r1 if inner and r1 < r2 else r1),)
    along = (d * d + r1 * r1 - r2 * r2) / (2 * d)
    half = u.left() * mp.sqrt(r1 * r1 - along * along)
    return c1.centre + u * along - half, c1.centre + u * along + half


def entering(e: ExactCurve, circle: ExactCircle) -> ExactPoint:
    """Point at which e, run along its way, enters a circle; the touching point if it touches."""
    points = crossings(e, circle)
    if len(points) == 1:
        return points[0]
    return min(points, key=lambda p: way_at(e, p).dot(p - circle.centre))


def nearest_crossing(e: ExactCurve, f: ExactCurve, p: ExactPoint) -> ExactPoint:
    """Of the crossings of two curves the one nearest to a point, however little they cross."""
    return min(crossings(e, f, ZERO), key=lambda q: (q - p).size())


def crossing_that_turns(e: ExactCurve, f: ExactCurve, left: bool) -> ExactPoint:
    """Of the crossings of two curves the one where f runs to the left (else right) of e."""
    points = crossings(e, f, ZERO)
    return max(points, key=lambda p: way_at(e, p).cross(way_at(f, p)) * (1 if left else -1))


# Circles that touch ------------------------------------------------------------------------------------------


def touching_two(e: ExactElement, f: ExactElement, r: Real) -> ExactCircle:
    """The clockwise circle of radius r that touches e and f in their directions, by less than half a turn from e to f.

    Its centre lies r to the right of each.
    """
    circles = [ExactCircle(centre, -r) for centre in crossings(_right_of(e, r), _right_of(f, r))]
    if len(circles) == 1:
        return circles[0]
    return min(circles, key=lambda c: sweep(c, _touch(c, e), _touch(c, f)))


def _right_of(e: ExactElement, r: Real) -> ExactCurve:
    if isinstance(e, ExactPoint):
        return ExactCircle(e, r)
    beside = parallel(e, r)
    if isinstance(beside, ExactCircle) and abs(beside.r) <= TINY:
        raise PlaneError("rival-touches-itself")
    return beside


def _touch(c: ExactCircle, e: ExactElement) -> ExactPoint:
    return e if isinstance(e, ExactPoint) else touching_point(c, e)


def touching_three(e: ExactElement, f: ExactElement, g: ExactElement) -> ExactCircle:
    """The clockwise circle that touches three elements in their directions, in this order.

    With centre c and radius R: (c − ci)² = (ri + R)² for a circle or point (ri = 0); c lies R to the right of a line.
    Lines, and differences of two of the former, are linear in (c, R); what is left is one more line, or a quadratic.
    """
    given = (e, f, g)
    origin = e.point if isinstance(e, ExactLine) else e.centre if isinstance(e, ExactCircle) else e
    rounds = [
        (h.centre - origin, h.r) if isinstance(h, ExactCircle) else (h - origin, ZERO)
        for h in given
        if not isinstance(h, ExactLine)
    ]
    # A linear equation a·x + b·y + k·R = m as the tuple (a, b, k, m).
    rows = [
        (h.way.y, -h.way.x, Real(-1), h.way.y * (h.point - origin).x - h.way.x * (h.point - origin).y)
        for h in given
        if isinstance(h, ExactLine)
    ]
    for centre, r in rounds[1:]:
        first, s = rounds[0]
        step = centre - first
        rows.append((2 * step.x, 2 * step.y, 2 * (r - s), centre.dot(centre) - first.dot(first) - r * r + s * s))
    circles = [ExactCircle(ExactPoint(x, y) + origin, -size) for x, y, size in _solutions(rows, rounds) if size > TINY]
    circles = [
        c
        for c in circles
        if all(
            isinstance(h, ExactPoint) or not isinstance(h, ExactCircle) or (h.centre - c.centre).size() > NEAR
            for h in given
        )
    ]
    if len(circles) > 1:
        circles = [c for c in circles if sweep(c, _touch(c, e), _touch(c, f)) <= sweep(c, _touch(c, e), _touch(c, g))]
    if not circles:
        raise PlaneError("rival-no-circle")
    return circles[0]


def _solutions(rows: list[_Row], rounds: list[tuple[ExactPoint, Real]]) -> list[_Triple]:
    """Solve the first two rows, then the third row or the first circle's quadratic, for (x, y, R)."""
    rows = [
        (row[0] / scale, row[1] / scale, row[2] / scale, row[3] / scale)
        for row in rows
        if (scale := mp.sqrt(row[0] ** 2 + row[1] ** 2 + row[2] ** 2)) > TINY
    ]
    if len(rows) < 2 or len(rows) == 2 and not rounds:
        return []
    (a1, b1, k1, m1), (a2, b2, k2, m2) = rows[:2]
    along = (b1 * k2 - k1 * b2, k1 * a2 - a1 * k2, a1 * b2 - b1 * a2)
    square = sum(v * v for v in along)
    if square <= TINY**2:
        return []
    # The point of the line of solutions that is nearest to the origin.
    n1, n2 = (a1, b1, k1), (a2, b2, k2)
    x, y, s = ((m1 * u + m2 * v) / square for u, v in zip(_cross(n2, along), _cross(along, n1), strict=True))
    base = x, y, s
    if len(rows) > 2:
        a, b, k, m = rows[2]
        slope = a * along[0] + b * along[1] + k * along[2]
        if abs(slope) <= TINY * mp.sqrt(square):
            return []
        t = (m - a * base[0] - b * base[1] - k * base[2]) / slope
        return [_ahead(base, along, t)]
    centre, r = rounds[0]
    x, y, s = base[0] - centre.x, base[1] - centre.y, base[2] + r
    u, v, w = along
    roots = _roots(u * u + v * v - w * w, 2 * (x * u + y * v - s * w), x * x + y * y - s * s)
    return [_ahead(base, along, t) for t in roots]


def _ahead(base: _Triple, along: _Triple, t: Real) -> _Triple:
    return base[0] + t * along[0], base[1] + t * along[1], base[2] + t * along[2]


def _cross(a: _Triple, b: _Triple) -> _Triple:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _roots(a: Real, b: Real, c: Real) -> list[Real]:
    """Roots of a·t² + b·t + c; a double one once, also where rounding has just lost it."""
    noise = Real("1e-30")
    if abs(a) <= noise:
        return [] if abs(b) <= noise else [-c / b]
    inner = b * b - 4 * a * c
    if abs(inner) <= noise * max(b * b, abs(4 * a * c), noise):
        return [-b / (2 * a)]
    if inner < 0:
        return []
    root = mp.sqrt(inner)
    return [(-b - root) / (2 * a), (-b + root) / (2 * a)]
