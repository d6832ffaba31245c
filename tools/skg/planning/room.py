"""Room for the wire beside planned contours: the tightest of some, and the inner corners that it does not come into."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from math import copysign
from typing import NamedTuple

from skg.geometry.contour import Contour
from skg.geometry.offset import NoRoom, sharpest, uncut, widest, wire_path
from skg.geometry.plane import XY
from skg.planning.planned import PlannedContour, Reason

#: Of a contour with more edges than this the largest offset that fits is not looked for.
_MANY = 2000
#: Sharp corners that are measured exactly: the worst ones.
_MEASURED = 5


def tightest(contours: Mapping[int, PlannedContour], none: Mapping[int, NoRoom]) -> tuple[int, float | None]:
    """The contour with the least room of some that the wire does not get around, and how far the wire may be beside
    it, mm; None when that is not looked for."""
    least: tuple[int, float] | None = None
    for number, no_room in none.items():
        if least and not least[1]:
            break
        if no_room.is_crossing:
            return number, 0.0
        contour, r = contours[number].contour, contours[number].widest
        if len(contour.edges) <= _MANY and (least is None or not _fits(contour, copysign(least[1], r))):
            least = number, widest(contour, r)
    return least or (next(iter(none)), None)


def _fits(contour: Contour, r: float) -> bool:
    """Tell whether the wire gets around a closed contour, R (mm) to the right of it."""
    with suppress(NoRoom):
        return bool(wire_path(contour, r))
    return False


class Corner(NamedTuple):
    """The inner corner of a contour that the last pass of the wire stays farthest off, by more than R: by how much
    (mm), and where."""

    far: float
    place: XY
    planned: PlannedContour


def corners(contours: Sequence[PlannedContour]) -> list[Corner]:
    """The corner of each contour that has one, the worst of the sharp ones first; those that are only worked out from
    the angle stand behind `_MEASURED` worse ones."""
    beside = [planned for planned in contours if planned.contour.is_closed and planned.offset]
    return [*_sharp([planned for planned in beside if not _leaves_edges_out(planned)]), *_passed(beside)]


def _leaves_edges_out(planned: PlannedContour) -> bool:
    return bool(planned.rung.wire and planned.rung.wire.reason is Reason.EDGES)


def _sharp(contours: Sequence[PlannedContour]) -> list[Corner]:
    """Corners of contours that are cut as they are."""
    sharp = [Corner(*corner, planned) for planned in contours if (corner := sharpest(planned.contour, planned.offset))]
    sharp.sort(key=lambda corner: -corner.far)
    for number, (_, _, planned) in enumerate(sharp[:_MEASURED]):
        with suppress(NoRoom):
            wire = planned.rung.wire
            path = wire.paths[-1] if wire else wire_path(planned.contour, planned.offset)
            sharp[number] = Corner(*uncut(planned.contour, path, planned.offset), planned)
    return sharp


def _passed(contours: Sequence[PlannedContour]) -> list[Corner]:
    """Corners of contours that the wire leaves edges out of."""
    pairs = ((planned, planned.rung.wire) for planned in contours if _leaves_edges_out(planned))
    return [Corner(*uncut(planned.contour, wire.paths[-1], planned.offset), planned) for planned, wire in pairs if wire]
