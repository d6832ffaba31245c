"""Where a tape's joints lay on the drawing, to a fraction of a micrometre, as far as the tape tells.

A tape has whole micrometres only, and of an arc's end it tells the coordinate along the count axis alone. What is
known about the rest, and why the estimates here are the best ones, stands in docs/drift.md, section "Back to the
drawing". All lengths are micrometres. δ is what rounding added to a joint, γ to a centre: evenly spread over ±½ on
each axis.
"""

from __future__ import annotations

from itertools import accumulate, pairwise
from math import cos, exp, floor, hypot, sin, sqrt

import numpy as np

from skg.plane import XY
from skg.tape.block import Block, Tape
from skg.tape.placed import Placed, PlacedRoute, lay
from skg.tape.roundings import (
    VARIANCE,
    Misses,
    Vector,
    closes,
    end_on_machine,
    gap_of,
    goes,
    likelihood,
    move_of,
)

#: Arcs of a larger sweep (radians) were drawn as arcs; those of fitted curves are shorter.
_DRAWN = 0.25
#: Radii of arcs on a tape that follow each other this closely are taken for the roundings of one radius: a
#: radius is off by δ − γ along a line, by at most √2 to each side.
_SAME_RADIUS, _RADIUS_SPREAD = 0.8, 2 * sqrt(2)

#: Block number -> the radius of its group and how many arcs and circles have it.
Radii = dict[int, tuple[float, int]]


def estimate(tape: Tape, start: tuple[int, int], without_drift: bool) -> list[PlacedRoute]:
    """Lay a tape out from `start` with its joints where the drawing most likely had them."""
    if not without_drift:
        radii = _same_radii({block.number: hypot(block.x, block.y) for block in tape.blocks if _is_drawn(block)})
        return lay(tape, start, lambda blocks, at: _from_programmed(blocks, at, radii))
    first = lay(tape, start, lambda blocks, at: _from_machine(blocks, at, {}))
    radii = _same_radii({placed.block.number: placed.radius for route in first for placed in route.blocks
                         if _is_drawn(placed.block)})
    return lay(tape, start, lambda blocks, at: _from_machine(blocks, at, radii))


# Arcs -----------------------------------------------------------------------------------------------------

def _is_drawn(block: Block) -> bool:
    """A circle, or an arc that is too long to be part of a fitted curve."""
    return abs(block.sweep) > _DRAWN


def _same_radii(radii: dict[int, float]) -> Radii:
    """Group radii (by block number) that are nearly equal, each group with its mean; single ones are left out."""
    found: Radii = {}
    group: list[int] = []
    for number in [*sorted(radii, key=radii.__getitem__), None]:
        if group and (number is None or radii[number] - radii[group[-1]] > _SAME_RADIUS
                      or radii[number] - radii[group[0]] > _RADIUS_SPREAD):
            if len(group) > 1:
                mean = sum(radii[one] for one in group) / len(group)
                found |= dict.fromkeys(group, (mean, len(group)))
            group = []
        group.append(number)
    return found


def _between(start: Vector, end: Vector, centre: Vector) -> Vector:
    """The centre moved along the chord to where start and end are equally far from it."""
    chord = end - start
    square = chord @ chord
    return centre + ((start + end) / 2 - centre) @ chord / square * chord if square else centre


def _placed(blocks: list[Block], joints: list[Vector], centres: list[Vector]) -> list[Placed]:
    """Blocks between their joints, arcs about the centres moved between them."""
    found = []
    for block, (start, end), centre in zip(blocks, pairwise(joints), centres, strict=True):
        if block.is_arc:
            centre = _between(start, end, centre)
        found.append(Placed.between(block, _xy(start), _xy(end), _xy(centre)))
    return found


def _xy(point: Vector) -> XY:
    return float(point[0]), float(point[1])


# A tape with drift ----------------------------------------------------------------------------------------

def _from_programmed(blocks: list[Block], at: XY, radii: Radii) -> tuple[list[Placed], XY]:
    """Lay out a route whose blocks start at the rounded ends: the roundings are those with the least sum of squares
    by which arcs of one radius have it and a closed route closes."""
    gap, spread = gap_of(blocks)
    is_closed = len(blocks) > 1 and closes(gap, spread)
    misses = Misses(blocks, is_closed)
    roundings, pulls = misses.none(), misses.pulls()
    for k, block in enumerate(blocks):
        if block.number not in radii:
            continue
        # A radius is a condition on δ and γ of its own: s·(δ₀ − γ) = the tape's radius − the true one.
        radius = hypot(block.x, block.y)
        first, joint, centre = np.array(block.start) / radius, misses.joints[k], misses.centres[k]
        half = (radius - radii[block.number][0]) / 2
        roundings[joint] += half * first
        roundings[centre] -= half * first
        # What closes the route shall not disturb it.
        for pull in pulls:
            part = (pull[joint] - pull[centre]) @ first / 2
            pull[joint] -= part * first
            pull[centre] += part * first
    if is_closed:
        products = np.einsum("ikl,jkl->ij", pulls, pulls)
        roundings += np.einsum("i,ikl->kl", np.linalg.pinv(products, rcond=1e-9)
                               @ (gap - misses.of(roundings).sum(axis=0)), pulls)
    ends = misses.of(roundings)
    # The rounded joints as far as the estimate goes, and from them the true ones.
    rounded = list(accumulate((move_of(block) - end for block, end in zip(blocks, ends, strict=True)),
                              initial=np.array(at, float)))
    joints = [place - roundings[joint] for place, joint in zip(rounded, misses.joints, strict=True)]
    centres = [place - block.start - roundings[centre]
               for block, place, centre in zip(blocks, rounded, misses.centres, strict=False)]
    return _placed(blocks, joints, centres), _xy(rounded[-1])


# A tape without drift -------------------------------------------------------------------------------------

def _from_machine(blocks: list[Block], at: XY, radii: Radii) -> tuple[list[Placed], XY]:
    """Lay out a route whose blocks start where the controller stands: an arc meant to end at the rounded place that
    its centre was moved for, a line and a circle do end there."""
    stands = list(accumulate((np.array(goes(block)) for block in blocks), initial=np.array(at)))
    joints, centres = [np.array(at, float)], []
    for block, (start, end) in zip(blocks, pairwise(stands), strict=True):
        centre = np.array(start - block.start, float)
        if block.is_arc:
            end = centre + _meant(block, joints[-1] - centre, radii.get(block.number))
        elif block.number in radii and not block.is_line:
            # A circle among circles of its size: half of what its radius is off is due to the start, half to the
            # centre, see `_from_programmed`.
            radius = hypot(block.x, block.y)
            half = (radius - radii[block.number][0]) / 2 / radius
            joints[-1] = end = start - half * np.array(block.start)
            centre += half * np.array(block.start)
        joints.append(np.array(end, float))
        centres.append(centre)
    return _placed(blocks, joints, centres), _xy(stands[-1])


def _meant(block: Block, start: Vector, radius: tuple[float, int] | None) -> Vector:
    """The mean of the rounded ends that an arc may have been meant to have, about its moved centre.

    Each weighs as the likelihood that the centre was rounded so far along the chord and, where the arc's radius is
    known (with how many arcs have it), that it was rounded to what `start` (the joint, about the centre) and end
    make of it.
    """
    end, across = end_on_machine(block), block.across
    centre = np.zeros(2)
    half = abs(block.sweep) / 2
    total = mean = 0.0
    for whole in range(floor(end[across]) - 2, floor(end[across]) + 4):
        place = end.copy()
        place[across] = whole
        weight = likelihood(block, place)
        if radius and weight:
            # The centre's two roundings count as cos half, the chord's two as half of sin half.
            variance = VARIANCE * (2 * cos(half) ** 2 + sin(half) ** 2 / 2 + 1 / radius[1])
            off = hypot(*(start - _between(start, place, centre))) - radius[0]
            weight *= exp(-off**2 / 2 / variance)
        total += weight
        mean += weight * whole
    if total > 1e-9:
        end[across] = mean / total
    return end
