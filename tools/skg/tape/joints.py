"""Where a tape's joints lay on the drawing, to a fraction of a micrometre, as far as the tape tells.

A tape has whole micrometres only, and of an arc's end it tells the coordinate along the count axis alone. What is
known about the rest, and why the estimates here are the best ones, stands in docs/drift.md, section "Back to the
drawing". All lengths are micrometres. δ is what rounding added to a joint, γ to a centre: evenly spread over ±½ on
each axis.
"""

from __future__ import annotations

from array import array
from dataclasses import dataclass
from math import cos, exp, hypot, sin, sqrt

import numpy as np

from skg.geometry.arrays import Flags, Whole, hypots
from skg.geometry.plane import XY, distance, dot, minus, shifted
from skg.tape.block import Tape
from skg.tape.columns import Columns, columns_of
from skg.tape.layout import AT_ONCE, Laid, PlacedRoute, lay, routes_of
from skg.tape.moves import machine_moves
from skg.tape.roundings import LEAST, VARIANCE, MayEnd, Misses, Vector, closes, gap_of, unrounded_moves, whole_ends

#: Arcs of a larger sweep (radians) were drawn as arcs; those of fitted curves are shorter.
_DRAWN = 0.25
#: Radii of arcs on a tape that follow each other this closely are taken for the roundings of one radius: a
#: radius is off by δ − γ along a line, by at most √2 to each side.
_SAME_RADIUS, _RADIUS_SPREAD = 0.8, 2 * sqrt(2)


@dataclass(frozen=True)
class Radii:
    """The radii of a tape's blocks that others have too: of each block its group's mean, and how many are in it (0: it
    is in none)."""

    means: Vector
    counts: Whole


def estimate(tape: Tape, start: tuple[int, int], without_drift: bool) -> list[PlacedRoute]:
    """Lay a tape out from `start` with its joints where the drawing most likely had them."""
    if without_drift:
        return _from_machine(tape, start)
    columns = columns_of(tape)
    drawn = _drawn(columns)
    radii = _same_radii(drawn, hypots(columns.x[drawn], columns.y[drawn]), len(columns))
    return lay(tape, start, lambda part, at: _from_programmed(tape, part, at, radii))


# Arcs -----------------------------------------------------------------------------------------------------


def _drawn(columns: Columns) -> Whole:
    """Which blocks are circles, or arcs that are too long to be part of a fitted curve."""
    return np.flatnonzero(abs(columns.sweeps) > _DRAWN)


def _same_radii(rows: Whole, radii: Vector, count: int) -> Radii:
    """Group the radii of some of `count` blocks that are nearly equal, each group with its mean; single ones are left
    out."""
    order = np.argsort(radii, kind="stable")
    found = Radii(np.zeros(count), np.zeros(count, int))
    ranked, first = radii[order].tolist(), 0
    for at in range(1, len(ranked) + 1):
        if (
            at < len(ranked)
            and ranked[at] - ranked[at - 1] <= _SAME_RADIUS
            and ranked[at] - ranked[first] <= _RADIUS_SPREAD
        ):
            continue
        if at > first + 1:
            group = rows[order[first:at]]
            found.means[group], found.counts[group] = sum(ranked[first:at]) / (at - first), at - first
        first = at
    return found


def _between(start: XY, end: XY, centre: XY) -> XY:
    """The centre moved along the chord to where start and end are equally far from it; numbers, or columns of them."""
    dx, dy = minus(end, start)
    part = (((start[0] + end[0]) / 2 - centre[0]) * dx + ((start[1] + end[1]) / 2 - centre[1]) * dy) / (
        dx * dx + dy * dy
    )
    return centre[0] + part * dx, centre[1] + part * dy


def _moved(is_arc: Flags, starts: Vector, ends: Vector, centres: Vector) -> Vector:
    """Centres (n × 2), those of arcs moved between their joints."""
    found, rows = centres.copy(), np.flatnonzero(is_arc & (ends != starts).any(axis=1))
    found[rows] = np.column_stack(_between(starts[rows].T, ends[rows].T, centres[rows].T))
    return found


# A tape with drift ----------------------------------------------------------------------------------------


def _from_programmed(tape: Tape, part: slice, at: XY, radii: Radii) -> tuple[Laid, XY]:
    """Lay out a route whose blocks start at the rounded ends: the roundings are those with the least sum of squares
    by which arcs of one radius have it and a closed route closes."""
    columns = columns_of(tape)[part]
    gap, spread = gap_of(columns)
    is_closed = len(columns) > 1 and closes(gap, spread)
    misses = Misses(columns, is_closed)
    # (a list of lists would take a kilobyte for each block)
    pulls = [array("d", pull.tobytes()) for pull in misses.pulls()] if is_closed else []
    known = array("d", misses.none().tobytes())
    rows = np.flatnonzero(radii.counts[part])
    own, joints, starts = hypots(columns.x[rows], columns.y[rows]), misses.joints[rows], columns.starts[rows]
    halves = (own - radii.means[part][rows]) / 2
    found = zip(*(column.tolist() for column in (rows, joints, halves, starts / own[:, None])), strict=True)
    for k, joint, half, first in found:
        # A radius is a condition on δ and γ of its own: s·(δ₀ − γ) = the tape's radius − the true one.
        centre = misses.centres[k]
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
    moves = unrounded_moves(columns) - misses.of(roundings)
    rounded = np.concatenate([[at], at + np.cumsum(moves, axis=0)])
    centres = rounded[:-1] - columns.starts - roundings[misses.centres.start : misses.centres.stop]
    joints = rounded - roundings[misses.joints]
    centres = _moved(columns.is_arc, joints[:-1], joints[1:], centres)
    return Laid.between(tape.blocks[part], columns, joints, centres), tuple(rounded[-1].tolist())


def _shift(roundings: array[float], one: int, other: int, by: float, way: XY) -> None:
    """Move one rounding (by its number) by so much along `way`, and the other one against it."""
    for k in (0, 1):
        roundings[2 * one + k] += by * way[k]
        roundings[2 * other + k] -= by * way[k]


# A tape without drift -------------------------------------------------------------------------------------


def _from_machine(tape: Tape, start: XY) -> list[PlacedRoute]:
    """Lay out a tape whose blocks start where the controller stands: an arc meant to end at the rounded place that its
    centre was moved for, a line and a circle do end there."""
    columns = columns_of(tape)
    stands = np.concatenate([[start], machine_moves(tape)]).cumsum(axis=0).astype(float)
    # A route begins where the controller stands, not where the block before was meant to end: it has one joint more.
    routes = np.repeat(np.arange(len(tape.bounds)), [last - first for first, last in tape.bounds])
    begins = np.arange(len(columns)) + routes
    joints, centres = np.zeros((len(columns) + len(tape.bounds), 2)), (stands[:-1] - columns.starts).astype(float)
    joints[begins], joints[begins + 1] = stands[:-1], stands[1:]
    arcs = np.flatnonzero(columns.is_arc)
    for first in range(0, len(arcs), AT_ONCE):
        rows = arcs[first : first + AT_ONCE]
        joints[begins[rows] + 1] = centres[rows] + whole_ends(tape, rows).means()
    drawn = _drawn(columns)
    sides = joints[begins[drawn]], joints[begins[drawn] + 1]
    arms = sides[0] - _moved(columns.is_arc[drawn], *sides, centres[drawn])
    radii = _same_radii(drawn, hypots(*arms.T), len(columns))
    _meet_radii(tape, radii, begins, joints, centres)
    starts, ends = joints[begins], joints[begins + 1]
    centres = _moved(columns.is_arc, starts, ends, centres)
    return routes_of(tape, Laid.apart(tape.blocks, columns, starts, ends, centres))


def _meet_radii(tape: Tape, radii: Radii, begins: Whole, joints: Vector, centres: Vector) -> None:
    """Move the joints of arcs, and joint and centre of circles, that have a radius together with others; `begins`: the
    joint where a block begins, the next one is that where it ends."""
    columns, shared = columns_of(tape), np.flatnonzero(radii.counts)
    for first in range(0, len(shared), AT_ONCE):
        rows = shared[first : first + AT_ONCE]
        some = columns[rows]
        tells = (rows, begins[rows], some.is_arc, abs(some.sweeps) / 2, some.starts, centres[rows])
        told = zip(*(column.tolist() for column in (*tells, radii.means[rows], radii.counts[rows])), strict=True)
        for end, (k, joint, is_arc, half, start, centre, radius, count) in zip(
            whole_ends(tape, rows).each(), told, strict=True
        ):
            if is_arc:
                begin = minus(joints[joint].tolist(), centre)
                joints[joint + 1] = shifted(centre, _meant(end, begin, half, radius, count))
            else:
                # A circle among circles of its size: half of what its radius is off is due to the start, half to the
                # centre, see `_from_programmed`.
                own = hypot(*start)
                off = (own - radius) / 2 / own * np.array(start)
                joints[joint] = joints[joint + 1] = centres[k] + start - off
                centres[k] += off


def _meant(end: MayEnd, start: XY, half: float, radius: float, count: int) -> XY:
    """The mean of the rounded ends that an arc may have been meant to have, about its moved centre.

    Each weighs as the likelihood that the centre was rounded so far along the chord and, since the arc's radius is
    known (with how many arcs have it), that it was rounded to what `start` (the joint, about the centre) and end
    make of it. `half` is half the sweep.
    """
    total = mean = 0.0
    for beside, weight in zip(end.beside, end.likelihoods, strict=True):
        if weight:
            # The centre's two roundings count as cos half, the chord's two as half of sin half.
            variance = VARIANCE * (2 * cos(half) ** 2 + sin(half) ** 2 / 2 + 1 / count)
            off = distance(start, _between(start, end.at(beside), (0.0, 0.0))) - radius
            weight *= exp(-(off**2) / 2 / variance)
        total += weight
        mean += weight * beside
    return end.at(mean / total) if total > LEAST else end.machine
