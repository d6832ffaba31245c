"""The true curves of the fit examples, from the textbooks' formulas: places as complex numbers x + iy, in mm.

The parameter is the angle that the example's loop counts, in degrees (the parabola: x in mm). `nodes` are the
parameters of the example's own nodes; that these lie on the curve is measured, not believed. Where the example
gives tangents at inner nodes `way` has the direction of the curve there, as the derivative gives it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

#: From parameters to places or to unit directions.
Formula = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class TrueCurve:
    """One curve: its name, its places, its nodes' parameters and the directions of travel (None: not used)."""

    name: str
    at: Formula
    nodes: np.ndarray
    way: Formula | None = None


def cis(angle: np.ndarray | float) -> np.ndarray:
    """e to the i·angle, the angle in degrees."""
    return np.exp(1j * np.radians(angle))


def unit(z: np.ndarray) -> np.ndarray:
    """A direction of length 1."""
    return z / np.abs(z)


def steps(first: float, last: float, step: float) -> np.ndarray:
    """Parameters from the first to the last one, both included."""
    return np.linspace(first, last, round((last - first) / step) + 1)


def cam(name: str, lift: Formula, slope: Formula | None, nodes: np.ndarray) -> TrueCurve:
    """A disc cam by its radius; `slope` is the radius' derivative by the angle in radians."""
    way = None if slope is None else (lambda a: unit((slope(a) + 1j * lift(a)) * cis(a)))
    return TrueCurve(name, lambda a: lift(a) * cis(a), nodes, way)


def harmonic(a: np.ndarray) -> np.ndarray:
    """Radius: up 8 mm in 120°, dwell, down from 150° to 240°, dwell."""
    up, down = 22 + 4 * (1 - np.cos(np.radians(1.5 * a))), 26 + 4 * np.cos(np.radians(2 * (a - 150)))
    return np.select([a <= 120, a <= 150, a <= 240], [up, 30.0, down], 22.0)


def harmonic_slope(a: np.ndarray) -> np.ndarray:
    """The derivative of `harmonic`."""
    up, down = 6 * np.sin(np.radians(1.5 * a)), -8 * np.sin(np.radians(2 * (a - 150)))
    return np.select([a <= 120, a <= 150, a <= 240], [up, 0.0, down], 0.0)


def cycloidal(a: np.ndarray) -> np.ndarray:
    """Radius: up 8 mm in 120°, dwell, down from 180° to 300°, dwell."""
    x = np.clip(np.minimum(a, 300 - a), 0, 120)
    return 20 + 8 * (x / 120 - np.sin(np.radians(3 * x)) / (2 * np.pi))


def cycloidal_slope(a: np.ndarray) -> np.ndarray:
    """The derivative of `cycloidal`."""
    x = np.clip(np.minimum(a, 300 - a), 0, 120)
    return np.sign(150 - a) * 8 * np.degrees(1 - np.cos(np.radians(3 * x))) / 120


def two_lobes(base: float) -> tuple[Formula, Formula]:
    """Lift of a follower twice a turn, and its derivative."""
    return (
        lambda a: base + 3 * (1 - np.cos(np.radians(2 * a))),
        lambda a: 6 * np.sin(np.radians(2 * a)),
    )


def flat_follower() -> TrueCurve:
    """The envelope of a flat follower's face: D along the follower, its derivative along the face."""
    lift, slope = two_lobes(20)
    return TrueCurve(
        "cam of a flat follower",
        lambda a: (lift(a) + 1j * slope(a)) * cis(a),
        steps(0, 360, 15),
        lambda a: cis(a + 90),
    )


def roller_follower() -> TrueCurve:
    """The envelope of the roller: the pitch curve moved inwards by 6 mm along its normal."""
    lift, slope = two_lobes(28)
    pitch = cam("", lift, slope, steps(0, 360, 12))
    return replace(pitch, name="cam of a roller follower", at=lambda a: pitch.at(a) + 6j * pitch.way(a))


def three_lobes() -> TrueCurve:
    """A cam with a radius of 22 to 26 mm, three times a turn."""
    return cam(
        "cam of three lobes",
        lambda a: 24 + 2 * np.cos(np.radians(3 * a)),
        lambda a: -6 * np.sin(np.radians(3 * a)),
        steps(0, 360, 1.8),
    )


def ellipse(a: float, b: float, step: float) -> TrueCurve:
    """An ellipse with the semi-axes a and b."""
    return TrueCurve(
        "ellipse",
        lambda t: a * np.cos(np.radians(t)) + 1j * b * np.sin(np.radians(t)),
        steps(0, 360, step),
        lambda t: unit(-a * np.sin(np.radians(t)) + 1j * b * np.cos(np.radians(t))),
    )


def trochoid(name: str, fixed: float, rolling: float, last: float, step: float) -> TrueCurve:
    """Epicycloid (rolling > 0, outside) or hypocycloid (rolling < 0, inside) of a circle on a fixed one."""
    distance = fixed + rolling
    return TrueCurve(name, lambda a: distance * cis(a) - rolling * cis(a * (fixed / rolling + 1)), steps(0, last, step))


def involute() -> TrueCurve:
    """A flank of the gear: module 2, 20 teeth, 20°; from the base circle to the tip at radius 22.

    The flank's beginning lies 90/20 + tan 20° - 20° (degrees) before the tooth's middle line, at which it is cut.
    """
    base = 20 * np.cos(np.radians(20))
    start = -(90 / 20 + np.degrees(np.tan(np.radians(20))) - 20)
    tip = np.degrees(np.sqrt((22 / base) ** 2 - 1))
    return TrueCurve(
        "involute",
        lambda a: base * (1 - 1j * np.radians(a)) * cis(a + start),
        np.linspace(0, tip, 7),
        lambda a: cis(a + start),
    )


#: By the name of the example's file.
TRUE_CURVES = {
    "fit-ellipse": ellipse(32, 18, 10),
    "fit-parabola": TrueCurve(
        "parabola", lambda x: x + 1j * x * x / 60, steps(40, -40, -5), lambda x: -unit(1 + 1j * x / 30)
    ),
    "fit-spiral": TrueCurve("Archimedean spiral", lambda a: (20 + a / 30) * cis(a), steps(0, 360, 12)),
    "fit-cycloid": TrueCurve("cycloid", lambda a: 8 * (np.radians(a) + 1j - 1j * cis(-a)), steps(360, 0, -20)),
    "fit-epicycloid": trochoid("epicycloid", 21, 4.2, 72, 4),
    "fit-hypocycloid": trochoid("hypocycloid", 30, -7.5, 90, 6),
    "fit-gear": involute(),
    "fit-cam": cam("harmonic cam", harmonic, harmonic_slope, steps(0, 360, 12)),
    "fit-cam-constant": cam("constant-speed cam", lambda a: 20 + a / 15, None, steps(0, 150, 10)),
    "fit-cam-cycloidal": cam("cycloidal cam", cycloidal, cycloidal_slope, steps(0, 360, 10)),
    "fit-tol-cam": three_lobes(),
    "fit-tol-ellipse": ellipse(30, 18, 3),
    "fit-envelope": flat_follower(),
    "fit-roller": roller_follower(),
}
