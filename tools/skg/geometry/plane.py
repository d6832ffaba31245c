"""Places and vectors of the plane in plain floats; the unit is the caller's."""

from __future__ import annotations

from math import cos, hypot, pi, sin

#: x and y of a place, or of a way from one place to another.
XY = tuple[float, float]


def minus(p: XY, q: XY) -> XY:
    """The vector from q to p."""
    return p[0] - q[0], p[1] - q[1]


def shifted(p: XY, by: XY) -> XY:
    """The place a way from p."""
    return p[0] + by[0], p[1] + by[1]


def dot(p: XY, q: XY) -> float:
    """Scalar product."""
    return p[0] * q[0] + p[1] * q[1]


def cross(p: XY, q: XY) -> float:
    """z of the vector product: positive when q points to the left of p."""
    return p[0] * q[1] - p[1] * q[0]


def distance(p: XY, q: XY) -> float:
    """Distance of two places."""
    return hypot(p[0] - q[0], p[1] - q[1])


def polar(centre: XY, radius: float, angle: float) -> XY:
    """The place on a circle at an angle in radians."""
    return centre[0] + radius * cos(angle), centre[1] + radius * sin(angle)


def turn(one: float, other: float) -> float:
    """Angle from one direction to another, in (−π, π]."""
    angle = (other - one) % (2 * pi)
    return angle - 2 * pi if angle > pi else angle
