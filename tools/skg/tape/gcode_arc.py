"""Arcs of G-code: where their centre lies, and what controls take for a full circle. All lengths in µm."""

from __future__ import annotations

from decimal import Decimal
from math import hypot

from skg.tape import gcode_known as known
from skg.tape.gcode import Spot
from skg.tape.gcode_line import Modes
from skg.tape.gcode_program import rounded_one
from skg.tape.gcode_upright import AXES, PLANES, SeenFromAbove, seen_from_above
from skg.tape.gcode_words import Misread, Word

#: Controls let an arc's end lie so far off the circle through its start: the first, and a thousandth of the radius up
#: to the second.
_OFF_CONTROL, _OFF_MOST = 5, 500
#: Controls take an arc of less than so many radians for a full circle.
_LEAST_SWEEP = 1e-6


def to_centre(modes: Modes, values: dict[str, Word], plane: str, to_end: Spot, column: int) -> Spot:
    """From an arc's start to its centre, in a plane; `to_end` is the way to its end."""
    letters = known.CENTRES[plane]
    for letter in filter(known.OTHER_CENTRES[plane].__contains__, values):
        raise Misread(values[letter].column, f"{letter} belongs to arcs of another plane")
    if "R" in values:
        if not values.keys().isdisjoint(letters):
            raise Misread(column, f"an arc has its centre, {' and '.join(letters)}, or its radius, R, not both")
        return _by_radius(to_end, float(modes.value(values, "R")), modes.sense, column)
    x, y = (rounded_one(modes.value(values, letter)) for letter in letters)
    if (x, y) == (0, 0):
        raise Misread(column, f"an arc needs its centre, {' and '.join(letters)}")
    off = abs(hypot(to_end[0] - x, to_end[1] - y) - hypot(x, y))
    if off > min(max(_OFF_CONTROL, hypot(x, y) / 1000), _OFF_MOST):
        raise Misread(column, f"the arc's end is {off:.0f} µm off the circle through its start")
    return x, y


def _by_radius(way: Spot, radius: float, sense: int, column: int) -> Spot:
    """From an arc's start to its centre, of the way to its end and its radius; below 0: more than half a turn."""
    chord = hypot(*way)
    if not chord:
        raise Misread(column, "an arc by its radius that ends where it begins")
    if chord / 2 - abs(radius) > _OFF_CONTROL:
        raise Misread(column, f"the arc's ends are {chord / 1000:g} mm apart, more than twice its radius")
    aside = max(radius * radius - chord * chord / 4, 0) ** 0.5 / chord
    if (radius > 0) != (sense > 0):
        aside = -aside
    return round(way[0] / 2 - way[1] * aside), round(way[1] / 2 + way[0] * aside)


def upright(
    modes: Modes, values: dict[str, Word], way: Spot, before: Decimal | None, height: Decimal | None, column: int
) -> SeenFromAbove:
    """An arc of G18 or G19, from the height `before` to `height` (None: not known), with that way in the plane XY."""
    if way["XY".index(AXES[modes.plane]) - 1]:
        raise Misread(column, f"an arc of G{modes.plane} that leaves its plane is not known here")
    if before is None and modes.absolute and "Z" in values:
        raise Misread(column, f"an arc of G{modes.plane} from a height that is not known")
    ways = dict(zip("XY", way, strict=True), Z=rounded_one(height - (before or 0)) if "Z" in values else 0)
    plane = PLANES[modes.plane]
    to_end = ways[plane[0]], ways[plane[1]]
    return seen_from_above(modes.plane, modes.sense, to_centre(modes, values, plane, to_end, column), to_end)


def is_no_way(modes: Modes, values: dict[str, Word], x: float, y: float) -> bool:
    """Whether an arc, rounded to a full circle, ends so little ahead of where it begins: x and y less than 1."""
    if "R" in values:
        return modes.value(values, "R") > 0
    i, j = (float(modes.value(values, letter)) for letter in known.CENTRES["XY"])
    ahead = y * i - x * j
    return (ahead < 0) == (modes.sense > 0) and abs(ahead) > _LEAST_SWEEP * (i**2 + j**2)


def is_flat(start: Spot, end: Spot, sense: int) -> bool:
    """Whether controls take an arc for a full circle, though its ends, told from its centre, differ."""
    cross, dot = sense * (start[0] * end[1] - start[1] * end[0]), start[0] * end[0] + start[1] * end[1]
    return start != end and 0 <= cross < _LEAST_SWEEP * dot
