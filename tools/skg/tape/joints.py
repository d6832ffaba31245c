"""Where a tape's joints lay on the drawing, to a fraction of a micrometre, as far as the tape tells.

A tape has whole micrometres only, and of an arc's end it tells the coordinate along the count axis alone. What is
known about the rest, and why the estimates here are the best ones, stands in docs/drift.md, section "Back to the
drawing". All lengths are micrometres. δ is what rounding added to a joint, γ to a centre: evenly spread over ±½ on
each axis.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import accumulate, pairwise
from math import cos, exp, floor, hypot, log, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from skg.errors import UserError
from skg.plane import XY
from skg.tape.block import Block, Tape
from skg.tape.controller import run_block
from skg.tape.placed import Placed, PlacedRoute, lay

#: Variance of an error spread evenly over ±½.
_VARIANCE = 1 / 12
#: Arcs of a larger sweep (radians) were drawn as arcs; those of fitted curves are shorter.
_DRAWN = 0.25
#: Radii of arcs on a tape that follow each other this closely are taken for the roundings of one radius: a
#: radius is off by δ − γ along a line, by at most √2 to each side.
_SAME_RADIUS, _RADIUS_SPREAD = 0.8, 2 * sqrt(2)
#: A route is meant to close when it does so to this many standard deviations.
_CLOSES = 4
#: Log likelihood for a tape without drift where a route closes on the machine alone; against it, as programmed alone.
_SURE = 10
#: No more than this, and it is a tape of the standard ROM, of which there are more.
_DOUBT = 1

Vector = NDArray[np.float64]
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


def is_without_drift(tape: Tape) -> bool:
    """Whether a tape's blocks start where the controller stands.

    Then a route that closes does so on the machine, and the circle of an arc whose centre was moved (docs/drift.md)
    passes close to a whole micrometre at the block's end, the closer the shorter the arc. On another tape it passes
    anywhere, and routes that close as programmed seldom do so on the machine. Where the tape does not tell, because
    the drawing lies on whole micrometres or is symmetrical, the answer is a guess.
    """
    try:
        return sum(map(_evidence_of_route, tape.stretches())) > _DOUBT
    except UserError:
        # A block that never ends on the controller (a circle of a few µm): it cannot tell where it stands.
        return False


def _evidence_of_route(blocks: list[Block]) -> float:
    """Log likelihood that the blocks between two stops are without drift, against a tape with drift."""
    arcs = [block for block in blocks if block.is_arc]
    if not arcs:
        return 0.0
    evidence = sum(map(_evidence, arcs))
    gap, spread = _gap(blocks)
    is_closed = [sum(ordinates) for ordinates in zip(*map(_goes, blocks), strict=True)] == [0, 0]
    if not _closes(gap, spread):
        return evidence + _SURE * is_closed
    return evidence + (log(1 + len(arcs)) if is_closed else -_SURE)


# Arcs -----------------------------------------------------------------------------------------------------

def _is_drawn(block: Block) -> bool:
    """A circle, or an arc that is too long to be part of a fitted curve."""
    return abs(block.sweep) > _DRAWN


def _end(block: Block) -> Vector:
    """An arc's end about its centre: whole along the count axis, across it on the circle."""
    return np.array(block.on_circle(block.end))


@lru_cache(maxsize=100_000)
def _goes(block: Block) -> tuple[int, int]:
    """Where the controller goes with a block, (dx, dy)."""
    return run_block(block).move


def _end_on_machine(block: Block) -> Vector:
    """An arc's end where the controller stops: a tape without drift counts J as it does."""
    (xs, ys), (dx, dy) = block.start, _goes(block)
    return np.array(block.on_circle((xs + dx, ys + dy)))


def _move(block: Block) -> Vector:
    """From a block's start to its end, not rounded."""
    return _end(block) - block.start if block.is_arc else np.array(block.move, float)


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

class _Misses:
    """What the roundings do to the ends of the arcs of a route, to first order.

    The roundings are one array: the δ of the joints, then the γ of each block's centre. An arc's true end lies off
    its unrounded end by e = (s·δ₀ − t·δ₁ + (t − s)·γ) / t across the count axis, s and t the directions from the
    centre to start and end: both true ends are equally far from the true centre.
    """

    def __init__(self, blocks: list[Block], closed: bool) -> None:
        self.blocks = blocks
        count = len(blocks)
        # A circle ends at the joint where it starts, a closed route too.
        joints = list(accumulate((not block.is_full_circle for block in blocks), initial=0))
        if closed:
            joints = [0 if joint == joints[-1] else joint for joint in joints]
        self.joints = joints
        self.centres = range(count + 1, 2 * count + 1)
        self.parts: list[list[tuple[int, Vector]]] = []
        for at, block in enumerate(blocks):
            self.parts.append([])
            if block.is_arc:
                radius, across = hypot(block.x, block.y), block.across
                first, last = np.array(block.start) / radius, _end(block) / radius
                # By its count axis an arc ends at 0.7 across it, but for circles of a few µm.
                if abs(last[across]) > 0.1:
                    self.parts[at] = [(place, way / last[across]) for place, way in (
                        (joints[at], first), (joints[at + 1], -last), (self.centres[at], last - first))]

    def none(self) -> Vector:
        """Roundings, all 0."""
        return np.zeros((2 * len(self.blocks) + 1, 2))

    def pulls(self) -> Vector:
        """How much each rounding adds to the sum of all e on each axis (2 × roundings × 2)."""
        found = np.array([self.none(), self.none()])
        for block, parts in zip(self.blocks, self.parts, strict=True):
            for place, way in parts:
                found[block.across, place] += way
        return found

    def of(self, roundings: Vector) -> Vector:
        """Every block's e as a vector (blocks × 2)."""
        found = np.zeros((len(self.blocks), 2))
        for at, (block, parts) in enumerate(zip(self.blocks, self.parts, strict=True)):
            for place, way in parts:
                found[at, block.across] += way @ roundings[place]
        return found


def _gap(blocks: list[Block]) -> tuple[Vector, Vector]:
    """By how much a route's unrounded moves do not close, and the standard deviation of that, were it closed."""
    pulls = _Misses(blocks, True).pulls()
    return sum(map(_move, blocks)), np.sqrt(_VARIANCE * (pulls**2).sum(axis=(1, 2)))


def _closes(gap: Vector, spread: Vector) -> bool:
    """Whether roundings alone explain a route's gap."""
    return bool((abs(gap) <= _CLOSES * spread + 1e-6).all())


def _from_programmed(blocks: list[Block], at: XY, radii: Radii) -> tuple[list[Placed], XY]:
    """Lay out a route whose blocks start at the rounded ends: the roundings are those with the least sum of squares
    by which arcs of one radius have it and a closed route closes."""
    gap, spread = _gap(blocks)
    closes = len(blocks) > 1 and _closes(gap, spread)
    misses = _Misses(blocks, closes)
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
    if closes:
        products = np.einsum("ikl,jkl->ij", pulls, pulls)
        roundings += np.einsum("i,ikl->kl", np.linalg.pinv(products, rcond=1e-9)
                               @ (gap - misses.of(roundings).sum(axis=0)), pulls)
    ends = misses.of(roundings)
    # The rounded joints as far as the estimate goes, and from them the true ones.
    rounded = list(accumulate((_move(block) - end for block, end in zip(blocks, ends, strict=True)),
                              initial=np.array(at, float)))
    joints = [place - roundings[joint] for place, joint in zip(rounded, misses.joints, strict=True)]
    centres = [place - block.start - roundings[centre]
               for block, place, centre in zip(blocks, rounded, misses.centres, strict=False)]
    return _placed(blocks, joints, centres), _xy(rounded[-1])


# A tape without drift -------------------------------------------------------------------------------------

def _from_machine(blocks: list[Block], at: XY, radii: Radii) -> tuple[list[Placed], XY]:
    """Lay out a route whose blocks start where the controller stands: an arc meant to end at the rounded place that
    its centre was moved for, a line and a circle do end there."""
    stands = list(accumulate((np.array(_goes(block)) for block in blocks), initial=np.array(at)))
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
    end, across = _end_on_machine(block), block.across
    centre = np.zeros(2)
    half = abs(block.sweep) / 2
    total = mean = 0.0
    for whole in range(floor(end[across]) - 2, floor(end[across]) + 4):
        place = end.copy()
        place[across] = whole
        weight = _likelihood(block, place)
        if radius and weight:
            # The centre's two roundings count as cos half, the chord's two as half of sin half.
            variance = _VARIANCE * (2 * cos(half) ** 2 + sin(half) ** 2 / 2 + 1 / radius[1])
            off = hypot(*(start - _between(start, place, centre))) - radius[0]
            weight *= exp(-off**2 / 2 / variance)
        total += weight
        mean += weight * whole
    if total > 1e-9:
        end[across] = mean / total
    return end


def _likelihood(block: Block, end: Vector) -> float:
    """Density at a whole end of how far along the chord the centre was rounded, per µm across the count axis.

    With d the chord, r the rounding and n = x² + y²: |end|² − n = −2 r·d, and r is spread evenly over ±½ on
    each axis. The sum of two such is a trapezoid.
    """
    dx, dy = end - block.start
    short, long = sorted((abs(dx), abs(dy)))
    off = abs(end @ end - block.x**2 - block.y**2) / 2
    inside = (long + short) / 2 - off
    if inside <= 0:
        return 0.0
    return min(1.0, inside / short if short else 1.0) / long * abs(end[block.across])


def _evidence(block: Block) -> float:
    """Log likelihood of an arc on a tape without drift, against any other tape."""
    start, end, across = np.array(block.start), _end_on_machine(block), block.across
    is_near = start @ end >= 0
    if is_near and abs(block.sweep) > np.pi:
        # The centre was not moved.
        return 0.0
    density = 0.0
    for whole in range(floor(end[across]) - 2, floor(end[across]) + 4):
        place = end.copy()
        place[across] = whole
        if place @ place == block.x**2 + block.y**2:
            # A drawing on whole micrometres: its arcs fit on any tape.
            return 0.0
        density += _likelihood(block, place)
    return log(max(density, 1e-3))
