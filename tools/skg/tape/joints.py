"""Where a tape's joints lay on the drawing, to a fraction of a micrometre, as far as the tape tells.

A tape has whole micrometres only, and of an arc's end it tells the coordinate along the count axis alone. What is
known about the rest, and why the estimates here are the best ones, stands in docs/drift.md, section "Back to the
drawing". All lengths are micrometres. δ is what rounding added to a joint, γ to a centre: evenly spread over ±½ on
each axis.
"""

from __future__ import annotations

from array import array
from itertools import pairwise
from math import cos, exp, hypot, sin, sqrt

import numpy as np

from skg.plane import XY, distance, dot, minus
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
    whole_ends,
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
    radii = _same_radii(
        {placed.block.number: placed.radius for route in first for placed in route.blocks if _is_drawn(placed.block)}
    )
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
        if group and (
            number is None
            or radii[number] - radii[group[-1]] > _SAME_RADIUS
            or radii[number] - radii[group[0]] > _RADIUS_SPREAD
        ):
            if len(group) > 1:
                mean = sum(radii[one] for one in group) / len(group)
                found |= dict.fromkeys(group, (mean, len(group)))
            group = []
        group.append(number)
    return found


def _between(start: XY, end: XY, centre: XY) -> XY:
    """The centre moved along the chord to where start and end are equally far from it."""
    dx, dy = minus(end, start)
    square = dx * dx + dy * dy
    if not square:
        return centre
    part = (((start[0] + end[0]) / 2 - centre[0]) * dx + ((start[1] + end[1]) / 2 - centre[1]) * dy) / square
    return centre[0] + part * dx, centre[1] + part * dy


def _placed(blocks: list[Block], joints: list[XY], centres: list[XY]) -> list[Placed]:
    """Blocks between their joints, arcs about the centres moved between them."""
    found = []
    for block, (start, end), centre in zip(blocks, pairwise(joints), centres, strict=True):
        if block.is_arc:
            centre = _between(start, end, centre)
        found.append(Placed.between(block, start, end, centre))
    return found


def _xys(points: Vector) -> list[XY]:
    return [(x, y) for x, y in points.tolist()]


# A tape with drift ----------------------------------------------------------------------------------------


def _from_programmed(blocks: list[Block], at: XY, radii: Radii) -> tuple[list[Placed], XY]:
    """Lay out a route whose blocks start at the rounded ends: the roundings are those with the least sum of squares
    by which arcs of one radius have it and a closed route closes."""
    gap, spread = gap_of(blocks)
    is_closed = len(blocks) > 1 and closes(gap, spread)
    misses = Misses(blocks, is_closed)
    # (a list of lists would take a kilobyte for each block)
    pulls = [array("d", pull.tobytes()) for pull in misses.pulls()]
    known = array("d", misses.none().tobytes())
    for k, block in enumerate(blocks):
        if block.number not in radii:
            continue
        # A radius is a condition on δ and γ of its own: s·(δ₀ − γ) = the tape's radius − the true one.
        radius, joint, centre = hypot(block.x, block.y), misses.joints[k], misses.centres[k]
        first = block.start[0] / radius, block.start[1] / radius
        half = (radius - radii[block.number][0]) / 2
        _shift(known, joint, centre, half, first)
        # What closes the route shall not disturb it.
        for pull in pulls:
            apart = pull[2 * joint] - pull[2 * centre], pull[2 * joint + 1] - pull[2 * centre + 1]
            _shift(pull, joint, centre, -dot(apart, first) / 2, first)
    roundings = np.array(known).reshape(-1, 2)
    if is_closed:
        ways = np.array(pulls).reshape(2, -1, 2)
        products = np.einsum("ikl,jkl->ij", ways, ways)
        roundings += np.einsum(
            "i,ikl->kl", np.linalg.pinv(products, rcond=1e-9) @ (gap - misses.of(roundings).sum(axis=0)), ways
        )
    # The rounded joints as far as the estimate goes, and from them the true ones.
    moves = np.array([move_of(block) for block in blocks]) - misses.of(roundings)
    rounded = np.concatenate([[at], at + np.cumsum(moves, axis=0)])
    joints = rounded - roundings[misses.joints]
    centres = rounded[:-1] - [block.start for block in blocks] - roundings[misses.centres.start : misses.centres.stop]
    return _placed(blocks, _xys(joints), _xys(centres)), _xys(rounded[-1:])[0]


def _shift(roundings: array[float], one: int, other: int, by: float, way: XY) -> None:
    """Move one rounding (by its number) by so much along `way`, and the other one against it."""
    for k in (0, 1):
        roundings[2 * one + k] += by * way[k]
        roundings[2 * other + k] -= by * way[k]


# A tape without drift -------------------------------------------------------------------------------------


def _from_machine(blocks: list[Block], at: XY, radii: Radii) -> tuple[list[Placed], XY]:
    """Lay out a route whose blocks start where the controller stands: an arc meant to end at the rounded place that
    its centre was moved for, a line and a circle do end there."""
    stands = [at]
    for dx, dy in map(goes, blocks):
        stands.append((stands[-1][0] + dx, stands[-1][1] + dy))
    joints, centres = [at], []
    for block, (start, end) in zip(blocks, pairwise(stands), strict=True):
        centre = minus(start, block.start)
        if block.is_arc:
            x, y = _meant(block, minus(joints[-1], centre), radii.get(block.number))
            end = centre[0] + x, centre[1] + y
        elif block.number in radii and not block.is_line:
            # A circle among circles of its size: half of what its radius is off is due to the start, half to the
            # centre, see `_from_programmed`.
            radius = hypot(block.x, block.y)
            half = (radius - radii[block.number][0]) / 2 / radius
            dx, dy = half * block.start[0], half * block.start[1]
            joints[-1] = end = start[0] - dx, start[1] - dy
            centre = centre[0] + dx, centre[1] + dy
        joints.append(end)
        centres.append(centre)
    return _placed(blocks, joints, centres), stands[-1]


def _meant(block: Block, start: XY, radius: tuple[float, int] | None) -> XY:
    """The mean of the rounded ends that an arc may have been meant to have, about its moved centre.

    Each weighs as the likelihood that the centre was rounded so far along the chord and, where the arc's radius is
    known (with how many arcs have it), that it was rounded to what `start` (the joint, about the centre) and end
    make of it.
    """
    across, half = block.across, abs(block.sweep) / 2
    total = mean = 0.0
    for place in whole_ends(block):
        weight = likelihood(block, place)
        if radius and weight:
            # The centre's two roundings count as cos half, the chord's two as half of sin half.
            variance = VARIANCE * (2 * cos(half) ** 2 + sin(half) ** 2 / 2 + 1 / radius[1])
            off = distance(start, _between(start, place, (0.0, 0.0))) - radius[0]
            weight *= exp(-(off**2) / 2 / variance)
        total += weight
        mean += weight * place[across]
    if total <= 1e-9:
        return end_on_machine(block)
    return (mean / total, place[1]) if across == 0 else (place[0], mean / total)
