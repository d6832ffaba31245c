"""The kinds of value (language.md, section 1).

Lengths are in millimetres, angles in degrees. A number is a `Real`; the other kinds are the classes here.
"""

from __future__ import annotations

from dataclasses import dataclass

from skg.ref import real
from skg.ref.fault import Code, Fault
from skg.ref.real import ZERO, Real


@dataclass(frozen=True)
class Point:
    """The point (x, y); also serves as a vector."""

    x: Real
    y: Real

    def __add__(self, other: Point) -> Point:
        return Point(self.x + other.x, self.y + other.y)

    def __sub__(self, other: Point) -> Point:
        return Point(self.x - other.x, self.y - other.y)

    def __mul__(self, factor: Real) -> Point:
        return Point(self.x * factor, self.y * factor)

    def __neg__(self) -> Point:
        return Point(-self.x, -self.y)

    def dot(self, other: Point) -> Real:
        """Scalar product."""
        return self.x * other.x + self.y * other.y

    def cross(self, other: Point) -> Real:
        """z of the vector product: positive when `other` points to the left of this vector."""
        return self.x * other.y - self.y * other.x

    def left(self) -> Point:
        """This vector turned by +90 degrees."""
        return Point(-self.y, self.x)

    def length(self) -> Real:
        """Length of the vector."""
        return real.mp.hypot(self.x, self.y)


@dataclass(frozen=True)
class Circle:
    """Centre (x, y) and radius r: r > 0 runs counter-clockwise, r < 0 clockwise."""

    x: Real
    y: Real
    r: Real

    @property
    def centre(self) -> Point:
        """The centre."""
        return Point(self.x, self.y)


@dataclass(frozen=True)
class Line:
    """αx + βy = γ with α² + β² = 1; it runs along (-β, α), so that (α, β) points to the right of travel."""

    a: Real
    b: Real
    g: Real

    @property
    def normal(self) -> Point:
        """Unit vector (α, β), to the right of travel."""
        return Point(self.a, self.b)

    @property
    def direction(self) -> Point:
        """Unit vector of travel."""
        return Point(-self.b, self.a)

    def distance(self, p: Point) -> Real:
        """Signed distance of a point, positive on the right."""
        return self.a * p.x + self.b * p.y - self.g


@dataclass(frozen=True)
class Rotation:
    """`A:P`, a rotation about P; lives only between `:` and `#` or in REP."""

    angle: Real
    centre: Point


Value = Real | Point | Circle | Line | Rotation
Curve = Line | Circle

#: Names of values in the table of operations; T is a rotation, which is no value of its own.
D, P, C, S, T = "D", "P", "C", "S", "T"

ORIGIN = Point(ZERO, ZERO)
X_AXIS = Line(ZERO, -real.ONE, ZERO)
Y_AXIS = Line(real.ONE, ZERO, ZERO)


def kind(v: Value) -> str:
    """D, P, C, S, or T for a rotation, which is not a value yet."""
    match v:
        case Point():
            return P
        case Circle():
            return C
        case Line():
            return S
        case Rotation():
            return T
    return D


def canonical(v: Value) -> tuple[Real, ...]:
    """The canonical numbers of a point, circle or line; error 4 for anything else."""
    match v:
        case Point(x, y):
            return (x, y)
        case Circle(x, y, r):
            return (x, y, r)
        case Line(a, b, g):
            return (a, b, g)
    raise Fault(Code.KINDS)
