"""Disc cams: a follower's motion law over the turn of the cam."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import accumulate
from math import atan2, cos, hypot, pi, radians, sin

from skg.cutting.ladder import CutResult, make
from skg.errors import UserError
from skg.geometry.contour import Contour, Edge
from skg.geometry.fitting import curve_edge
from skg.geometry.plane import XY
from skg.job.job import Job
from skg.job.machine import UNASKED
from skg.job.wanted import CutSettings
from skg.messages.finding import Finding
from skg.planning.plan import plan

#: Largest deviation of FIT from the cam between its nodes, mm.
TOLERANCE = 0.0002

#: A motion law: what part of the lift is done at a part of the rise, and the first two derivatives of that.
Law = Callable[[float], tuple[float, float, float]]


def _harmonic(t: float) -> tuple[float, float, float]:
    return (1 - cos(pi * t)) / 2, pi * sin(pi * t) / 2, pi**2 * cos(pi * t) / 2


def _cycloidal(t: float) -> tuple[float, float, float]:
    return t - sin(2 * pi * t) / (2 * pi), 1 - cos(2 * pi * t), 2 * pi * sin(2 * pi * t)


def _polynomial(t: float) -> tuple[float, float, float]:
    """3-4-5: no jump of the acceleration at the ends."""
    return t**3 * (10 - 15 * t + 6 * t**2), 30 * t**2 * (1 - t) ** 2, 60 * t * (1 - t) * (1 - 2 * t)


LAWS: dict[str, Law] = {"harmonic": _harmonic, "cycloidal": _cycloidal, "polynomial": _polynomial}


@dataclass(frozen=True)
class Cam:
    """A disc cam about the origin that begins to rise at the X axis and turns its profile counter-clockwise.

    `base`: its smallest radius, `lift`, `roller` (the follower's roller's diameter, 0: a point): mm. `rise`, `dwell`
    (at the top) and `fall` are degrees, the rest of the turn rests on the base circle.
    """

    base: float
    lift: float
    rise: float
    dwell: float
    fall: float
    law: str = "cycloidal"
    roller: float = 0.0

    def height(self, angle: float) -> tuple[float, float, float]:
        """The follower's lift at an angle of the cam (radians), and its first two derivatives."""
        rise, top, fall = (radians(turn) for turn in accumulate((self.rise, self.dwell, self.fall)))
        law = LAWS[self.law]
        if angle <= rise:
            span, (s, v, a) = rise, law(angle / rise)
        elif angle <= top:
            return self.lift, 0.0, 0.0
        elif angle < fall:
            span, (s, v, a) = fall - top, law((fall - angle) / (fall - top))
            v = -v
        else:
            return 0.0, 0.0, 0.0
        return self.lift * s, self.lift * v / span, self.lift * a / span**2

    def place(self, angle: float) -> XY:
        """The profile's place at an angle of the cam: beside the roller's centre, square to its path."""
        height, slope, _ = self.height(angle)
        pitch = self.base + self.roller / 2 + height
        # The roller's path runs (slope, pitch) in the directions out and along; its normal to the inside is this.
        length = hypot(slope, pitch)
        out, along = -pitch / length, slope / length
        x, y = pitch + self.roller / 2 * out, self.roller / 2 * along
        return x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)

    def places(self, angles: list[float]) -> list[XY]:
        """The profile's places at angles of the cam."""
        return [self.place(angle) for angle in angles]

    def heading(self, angle: float) -> float:
        """The direction of the profile there, radians: the roller's path runs the same way."""
        height, slope, _ = self.height(angle)
        return angle + atan2(self.base + self.roller / 2 + height, slope)

    def contours(self) -> list[Contour]:
        """The profile, counter-clockwise. A cam that cannot be is a `UserError`."""
        stations = [0.0, *(radians(turn) for turn in accumulate((self.rise, self.dwell, self.fall)))]
        if stations[-1] > 2 * pi + 1e-9:
            raise UserError(Finding("cam-over-a-turn", degrees=self.rise + self.dwell + self.fall))
        self._refuse_undercut()
        edges: list[Edge] = []
        for low, high, is_dwell in zip(stations, [*stations[1:], 2 * pi], (False, True, False, True), strict=True):
            if high - low < 1e-9:
                continue
            if is_dwell:
                edges.append(Edge(self.place(low), self.place(high), (0.0, 0.0), high - low))
            else:
                parts = [low + (high - low) * k / 4 for k in range(5)]
                edges.append(curve_edge(self.places, self.heading, parts, TOLERANCE))
        return [Contour(tuple(edges), True)]

    def cut(self, name: str, wanted: CutSettings) -> CutResult:
        """Make a tape of the cam."""
        return make(plan(self.contours(), [], wanted), Job(name, policy=UNASKED))

    def _refuse_undercut(self) -> None:
        """Refuse a roller's path that bends more than the roller: it would cut into the profile."""
        for step in range(3600):
            angle = step * pi / 1800
            height, slope, more = self.height(angle)
            r = self.base + self.roller / 2 + height
            bend = (r**2 + 2 * slope**2 - r * more) / hypot(r, slope) ** 3
            if bend * self.roller / 2 >= 1:
                raise UserError(Finding("cam-undercut", degrees=step / 10, bend=1 / bend))
