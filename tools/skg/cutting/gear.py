"""Involute gears: contours, and the program that cuts them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import chain
from math import acos, asin, atan2, cos, hypot, pi, radians, sin, sqrt, tan

import numpy as np

from skg.cutting.ladder import CutResult, make, run
from skg.cutting.program import Program, RoutePart, parts_of
from skg.errors import UserError
from skg.geometry.contour import Contour, Edge
from skg.geometry.fitting import curve_edge
from skg.geometry.plane import XY, polar
from skg.job.job import Job
from skg.job.machine import UNASKED
from skg.job.wanted import CutSettings
from skg.messages.finding import Finding
from skg.planning.plan import plan
from skg.planning.planned import PlannedContour
from skg.tape.block import MAX_DIGITS

#: Largest deviation of FIT from the involute between its nodes, mm.
TOLERANCE = 0.0002
#: The number of a block that is one more than the largest, mm.
_TOO_LARGE = 10.0 ** (MAX_DIGITS - 3)


def involute(angle: float) -> float:
    """tan a - a: how far an involute has turned where its pressure angle is `angle` (radians)."""
    return tan(angle) - angle


@dataclass(frozen=True)
class Gear:
    """A spur gear (ISO 21771): module and lengths in mm, angles in degrees.

    `shift`: profile shift, `clearance` and `fillet` (of the root, 0: none), all in modules. `bore`: diameter of the
    hole, 0: none; `key_width`, and `key_depth` from the bore's far side to the keyway's bottom, as tables have it.
    """

    module: float
    teeth: int
    pressure_angle: float = 20.0
    shift: float = 0.0
    clearance: float = 0.25
    fillet: float = 0.2
    bore: float = 0.0
    key_width: float = 0.0
    key_depth: float = 0.0

    @property
    def pitch_radius(self) -> float:
        """Half the pitch circle's diameter."""
        return self.module * self.teeth / 2

    @property
    def base_radius(self) -> float:
        """The circle that the flanks unwind from."""
        return self.pitch_radius * cos(radians(self.pressure_angle))

    @property
    def tip_radius(self) -> float:
        """Half the outer diameter."""
        return self.pitch_radius + self.module * (1 + self.shift)

    @property
    def root_radius(self) -> float:
        """Half the diameter between the teeth."""
        return self.pitch_radius - self.module * (1 + self.clearance - self.shift)

    def half_angle(self, radius: float) -> float:
        """Half of a tooth as an angle at the centre, radians, on a circle of at least the base radius."""
        angle = radians(self.pressure_angle)
        at_pitch = pi / (2 * self.teeth) + 2 * self.shift * tan(angle) / self.teeth
        return at_pitch + involute(angle) - involute(acos(min(1.0, self.base_radius / radius)))

    def contours(self) -> list[Contour]:
        """The outline, counter-clockwise, and the bore. A gear that cannot be is a `UserError`."""
        self._refuse()
        return [self._outline(), *([self._bore()] if self.bore else [])]

    def cut(self, name: str, wanted: CutSettings) -> CutResult:
        """Make a tape of the gear. The program has one tooth, and REP for the others; all of them with a tab, whose
        lead would be repeated, and where the board has no room for so long a tooth."""
        contours, job = plan(self.contours(), [], wanted), Job(name, policy=UNASKED)
        if not wanted.tab:
            contours = [planned if planned.number else self._from_a_tip(planned, wanted.lead) for planned in contours]
            with suppress(UserError):
                return run(Program(contours, name, self._parts), job)
        return make(contours, job)

    def _from_a_tip(self, planned: PlannedContour, lead: float) -> PlannedContour:
        """The outline, entered where a tooth begins: there the next one goes on."""
        outline = self._outline()
        start = polar((0, 0), self.tip_radius + lead + planned.offset, -self.half_angle(self.tip_radius))
        return replace(planned, contour=outline, start=start, part=0.0)

    def _parts(self, planned: PlannedContour) -> Iterator[RoutePart]:
        """The bore, and of the outline one tooth with its copies."""
        if planned.number:
            return parts_of(planned)
        edges = planned.contour.edges
        tooth = replace(planned, contour=Contour(edges[: len(edges) // self.teeth], False))
        return chain(parts_of(tooth), [f"REP {self.teeth},360/{self.teeth}", "BACK"])

    def _refuse(self) -> None:
        if self.tip_radius >= _TOO_LARGE:
            # (blocks of the tip circle would have its radius in them)
            raise UserError(Finding("gear-too-large", radius=self.tip_radius / 1000))
        if self.root_radius <= 0:
            raise UserError(Finding("gear-no-root", teeth=self.teeth))
        if self.half_angle(self.tip_radius) <= 0:
            raise UserError(Finding("gear-pointed"))
        if self.half_angle(max(self.root_radius, self.base_radius)) >= pi / self.teeth:
            raise UserError(Finding("gear-no-gap"))
        reach = max(self.bore / 2, self.key_depth - self.bore / 2)
        if self.bore and reach >= self.root_radius:
            raise UserError(Finding("gear-bore", reach=reach, root=self.root_radius))
        if self.key_width and not (self.key_width < self.bore < self.key_depth):
            raise UserError(Finding("gear-keyway"))

    def _root(self) -> tuple[float, float, XY]:
        """Return the root fillet's contacts: its angle beside the tooth's middle on the root circle, its radius on the
        flank, and (radius, angle) of its centre. Without a fillet all are where flank and root circle meet."""
        rf, rb, f = self.root_radius, self.base_radius, self.fillet * self.module
        low = self.half_angle(max(rf, rb))
        if not f:
            return low, max(rf, 0.0), (0.0, 0.0)
        centre = rf + f
        roll = sqrt(max(0.0, centre**2 - rb**2)) - f
        if centre > rb and roll > 0:
            # A curve beside an involute is the same involute, turned; along the normal the roll differs by f.
            angle, touch = self.half_angle(centre) + f / rb, hypot(rb, roll)
        else:
            angle, touch = low + asin(f / centre), sqrt(centre**2 - f**2)
        if angle >= pi / self.teeth or touch > self.tip_radius or (roll <= 0 and touch > max(rb, rf)):
            raise UserError(Finding("gear-fillet", fillet=f))
        return angle, touch, (centre, angle)

    def _outline(self) -> Contour:
        rf, rb, ra = self.root_radius, self.base_radius, self.tip_radius
        angle, touch, (centre, beside) = self._root()
        first = max(rb, touch)
        flank = _flank(self, first, ra)
        tip = self.half_angle(ra)
        half: list[Edge] = []
        if centre:
            middle = polar((0, 0), centre, -beside)
            end = polar((0, 0), touch, -self.half_angle(max(touch, rb)))
            half.append(_arc(polar((0, 0), rf, -angle), end, middle, -1))
        if touch < rb - 1e-9:
            half.append(Edge(polar((0, 0), touch, -self.half_angle(rb)), polar((0, 0), rb, -self.half_angle(rb))))
        half.append(flank)
        other = [_mirrored(edge).reversed() for edge in reversed(half)]
        pitch = 2 * pi / self.teeth
        next_half = [_turned(edge, pitch) for edge in half]
        edges: list[Edge] = []
        for tooth in range(self.teeth):
            turned = tooth * pitch
            top = Edge(polar((0, 0), ra, -tip), polar((0, 0), ra, tip), (0.0, 0.0), 2 * tip)
            gap = pitch - 2 * angle
            root = Edge(polar((0, 0), rf, angle), polar((0, 0), rf, pitch - angle), (0.0, 0.0), gap)
            edges += [_turned(edge, turned) for edge in (top, *other, *([root] if gap > 1e-9 else []), *next_half)]
        return Contour(tuple(edges), True)

    def _bore(self) -> Contour:
        radius = self.bore / 2
        if not self.key_width:
            return Contour((Edge((radius, 0.0), (radius, 0.0), (0.0, 0.0), -2 * pi),), True)
        half, top = self.key_width / 2, self.key_depth - radius
        foot = sqrt(radius**2 - half**2)
        beside = 2 * asin(half / radius)
        corners = [(-half, foot), (-half, top), (half, top), (half, foot)]
        lines = [Edge(p, q) for p, q in zip(corners, corners[1:], strict=False)]
        return Contour((*lines, Edge(corners[-1], corners[0], (0.0, 0.0), beside - 2 * pi)), True)


def _flank(gear: Gear, low: float, high: float) -> Edge:
    """The flank on the right of a tooth that points along X, outwards, by its roll angle."""
    rb = gear.base_radius
    begin = gear.half_angle(rb)

    def turned(roll: float) -> float:
        return roll - atan2(roll, 1) - begin

    def place(roll: float) -> XY:
        return polar((0, 0), rb * hypot(1, roll), turned(roll))

    def heading(roll: float) -> float:
        # (an involute stands square to its string)
        return turned(roll) + atan2(roll, 1)

    first, last = (sqrt(max(0.0, (radius / rb) ** 2 - 1)) for radius in (low, high))
    return curve_edge(lambda rolls: [*map(place, rolls)], heading, [first, last], TOLERANCE)


def _arc(start: XY, end: XY, centre: XY, sense: int) -> Edge:
    """The arc about a centre from one place to another, in the direction of `sense`: 1 or -1."""
    sweep = atan2(end[1] - centre[1], end[0] - centre[0]) - atan2(start[1] - centre[1], start[0] - centre[0])
    return Edge(start, end, centre, sense * ((sense * sweep) % (2 * pi)))


def _moved(edge: Edge, move: Callable[[XY], XY], turn: Callable[[float], float], sense: int) -> Edge:
    nodes = tuple(replace(node, point=move(node.point), angle=turn(node.angle)) for node in edge.nodes)
    samples = np.array([*map(move, edge.points())]) if edge.nodes else edge.samples
    centre = edge.centre and move(edge.centre)
    return replace(
        edge,
        start=move(edge.start),
        end=move(edge.end),
        centre=centre,
        sweep=sense * edge.sweep,
        nodes=nodes,
        samples=samples,
    )


def _mirrored(edge: Edge) -> Edge:
    """An edge mirrored by the X axis."""
    return _moved(edge, lambda p: (p[0], -p[1]), lambda angle: -angle, -1)


def _turned(edge: Edge, by: float) -> Edge:
    """An edge turned about the origin."""
    c, s = cos(by), sin(by)
    return _moved(edge, lambda p: (c * p[0] - s * p[1], s * p[0] + c * p[1]), lambda angle: angle + by, 1)
