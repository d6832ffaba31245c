"""Arcs of G-code: where their centre lies, and what controls take for a full circle. All lengths in µm."""

from __future__ import annotations

from math import hypot

from skg.tape.gcode import Spot
from skg.tape.gcode_line import Modes
from skg.tape.gcode_program import rounded_one
from skg.tape.gcode_words import Misread, Word

#: Controls let an arc's end lie so far off the circle through its start: the first, and a thousandth of the radius up
#: to the second.
_OFF_CONTROL, _OFF_MOST = 5, 500
#: Controls take an arc of less than so many radians for a full circle.
_LEAST_SWEEP = 1e-6


def to_centre(modes: Modes, values: dict[str, Word], to_end: Spot, column: int) -> Spot:
    """From an arc's start to its centre; `to_end` is the way to its end."""
    if "K" in values:
        raise Misread(values["K"].column, "K belongs to arcs of another plane")
    if "R" in values:
        if not values.keys().isdisjoint("IJ"):
            raise Misread(column, "an arc has its centre, I and J, or its radius, R, not both")
        return _by_radius(to_end, float(modes.value(values, "R")), modes.sense, column)
    x, y = (rounded_one(modes.value(values, letter)) for letter in "IJ")
    if (x, y) == (0, 0):
        raise Misread(column, "an arc needs its centre, I and J")
    off = abs(hypot(to_end[0] - x, to_end[1] - y) - hypot(x, y))
    if off > min(max(_OFF_CONTROL, hypot(x, y) / 1000), _OFF_MOST):
        raise Misread(column, f"the arc's end is {off:.0f} µm off the circle through its start")
    return x, y


def _by_radius(vector: Spot, radius: float, sense: int, column: int) -> Spot:
    """The vector from an arc's start to its centre, by that to its end and the radius; below 0: over half a turn."""
    chord = hypot(*vector)
    if not chord:
        raise Misread(column, "an arc by its radius that ends where it begins")
    if chord / 2 - abs(radius) > _OFF_CONTROL:
        raise Misread(column, f"the arc's ends are {chord / 1000:g} mm apart, more than twice its radius")
    aside = max(radius * radius - chord * chord / 4, 0) ** 0.5 / chord
    if (radius > 0) != (sense > 0):
        aside = -aside
    return round(vector[0] / 2 - vector[1] * aside), round(vector[1] / 2 + vector[0] * aside)


def is_no_way(modes: Modes, values: dict[str, Word], x: float, y: float) -> bool:
    """Tell whether an arc, rounded to a full circle, ends so little ahead of where it begins: x and y less than 1."""
    if "R" in values:
        return modes.value(values, "R") > 0
    i, j = (float(modes.value(values, letter)) for letter in "IJ")
    ahead = y * i - x * j
    return (ahead < 0) == (modes.sense > 0) and abs(ahead) > _LEAST_SWEEP * (i**2 + j**2)


def is_flat(start: Spot, end: Spot, sense: int) -> bool:
    """Tell whether controls take an arc for a full circle, though its ends, told from its centre, differ."""
    cross, dot = sense * (start[0] * end[1] - start[1] * end[0]), start[0] * end[0] + start[1] * end[1]
    return start != end and 0 <= cross < _LEAST_SWEEP * dot
