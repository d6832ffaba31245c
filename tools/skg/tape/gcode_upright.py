"""Arcs of G-code in an upright plane, ZX (G18) or YZ (G19), as they are seen from above: there and back on a line.

CAM programs go down into the work by such arcs, and come up. Lengths are in µm.
"""

from __future__ import annotations

from math import atan2, cos, floor, hypot, pi, sin, tau
from typing import NamedTuple

#: The axis of the plane XY that an upright plane has, and its two axes, counter-clockwise from the first to the second.
AXES = {18: "X", 19: "Y"}
PLANES = {18: "ZX", 19: "YZ"}


class SeenFromAbove(NamedTuple):
    """Where an upright arc goes along its axis, from its start: places, one after another, between which it goes
    straight; and how much lower than both of its ends it comes."""

    places: list[float]
    dip: float


def seen_from_above(
    plane: int, sense: int, to_centre: tuple[float, float], to_end: tuple[float, float]
) -> SeenFromAbove:
    """An arc with its centre and its end as seen from its start, in the order of `PLANES`; `sense` is 1
    counter-clockwise, -1 clockwise. Equal ends are a full circle."""
    radius = hypot(*to_centre)
    start = atan2(-to_centre[1], -to_centre[0])
    sweep = (sense * (atan2(to_end[1] - to_centre[1], to_end[0] - to_centre[0]) - start)) % tau
    if to_end == (0, 0) or not sweep:
        sweep = tau
    along = PLANES[plane].index(AXES[plane])

    def turns(axis: int) -> list[tuple[float, float]]:
        """How far along the arc it turns round in an axis, and where it is then."""
        first = 0 if axis == 0 else pi / 2
        found = []
        for n in range(5):
            # (the n-th time that its angle is a multiple of half a turn, from `first`)
            angle = first + pi * (floor((start - first) / pi) + (1 + n if sense > 0 else -n))
            gone = sense * (angle - start)
            if 0 < gone < sweep:
                found.append((gone, to_centre[axis] + radius * (sin if axis else cos)(angle)))
        return found

    places = [place for _, place in turns(along)]
    heights = [height for _, height in turns(1 - along)]
    lower = min(0.0, to_end[1 - along])
    return SeenFromAbove([*places, to_end[along]], lower - min([lower, *heights]))
