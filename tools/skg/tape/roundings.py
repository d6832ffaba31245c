"""What rounding to whole micrometres did to the blocks of a route, as far as the tape tells: see docs/drift.md,
section "Back to the drawing".

All lengths are micrometres. δ is what rounding added to a joint, γ to a centre: evenly spread over ±½ on each axis.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from skg.geometry.arrays import Flags, Whole
from skg.geometry.arrays import Floats as Vector
from skg.geometry.plane import XY
from skg.tape.block import Tape
from skg.tape.columns import Columns, columns_of
from skg.tape.moves import machine_moves

#: Variance of an error spread evenly over ±½.
VARIANCE = 1 / 12
#: An arc whose whole ends are less likely than this, all of them together, is not known to have been meant for any.
LEAST = 1e-9
#: A route is meant to close when it does so to this many standard deviations.
_CLOSES = 4


def unrounded_ends(columns: Columns) -> Vector:
    """The ends of arcs about their centres (n × 2): whole along the count axis, across it on the circle."""
    return columns.on_circles(columns.ends)


def unrounded_moves(columns: Columns) -> Vector:
    """From each block's start to its end (n × 2), not rounded."""
    return np.where(columns.is_arc[:, None], unrounded_ends(columns) - columns.starts, columns.moves).astype(float)


class Misses:
    """What the roundings do to the ends of the arcs of a route, to first order.

    The roundings are one array: the δ of the joints, then the γ of each block's centre. An arc's true end lies off
    its unrounded end by e = (s·δ₀ − t·δ₁ + (t − s)·γ) / t across the count axis, s and t the directions from the
    centre to start and end: both true ends are equally far from the true centre.
    """

    def __init__(self, columns: Columns, closed: bool) -> None:
        self.count = len(columns)
        # A circle ends at the joint where it starts, a closed route too.
        joints = np.concatenate([[0], np.cumsum(~columns.is_full_circle)])
        if closed:
            joints[joints == joints[-1]] = 0
        self.joints = joints
        self.centres = range(self.count + 1, 2 * self.count + 1)
        # Of each arc: which block it is, its axis across, the three roundings and how e goes by each of them.
        rows = np.flatnonzero(columns.is_arc)
        arcs = columns[rows]
        ends = unrounded_ends(arcs)
        across = ends[np.arange(len(rows)), arcs.across]
        # By its count axis an arc ends at 0.7 across it, but for circles of a few µm.
        tells = abs(across) > 0.1 * np.sqrt(arcs.squares.astype(float))
        rows, arcs, ends, across = rows[tells], arcs[tells], ends[tells], across[tells, None]
        first, last = arcs.starts / across, ends / across
        self.blocks, self.axes = rows, arcs.across
        self.places = np.column_stack([joints[rows], joints[rows + 1], self.count + 1 + rows])
        self.ways = np.stack([first, -last, last - first], axis=1).astype(float)

    def none(self) -> Vector:
        """Roundings, all 0."""
        return np.zeros((2 * self.count + 1, 2))

    def pulls(self) -> Vector:
        """How much each rounding adds to the sum of all e on each axis (2 × roundings × 2)."""
        found = np.zeros((2, 2 * self.count + 1, 2))
        np.add.at(found, (self.axes[:, None], self.places), self.ways)
        return found

    def of(self, roundings: Vector) -> Vector:
        """Every block's e as a vector (blocks × 2)."""
        found = np.zeros((self.count, 2))
        found[self.blocks, self.axes] = (self.ways * roundings[self.places]).sum(axis=(1, 2))
        return found


def gap_of(columns: Columns) -> tuple[Vector, Vector]:
    """By how much a route's unrounded moves do not close, and the standard deviation of that, were it closed."""
    pulls = Misses(columns, True).pulls()
    return unrounded_moves(columns).sum(axis=0), np.sqrt(VARIANCE * (pulls**2).sum(axis=(1, 2)))


def closes(gap: Vector, spread: Vector) -> bool:
    """Whether roundings alone explain a route's gap."""
    return bool((abs(gap) <= _CLOSES * spread + 1e-6).all())


class MayEnd(NamedTuple):
    """The whole ends near to where one arc ends on the machine: a row of `WholeEnds`."""

    machine: XY
    along: int
    beside: list[int]
    likelihoods: list[float]
    across: int

    def at(self, beside: float) -> XY:
        """The place beside the count axis."""
        return (beside, self.along) if self.across == 0 else (self.along, beside)


@dataclass(frozen=True)
class WholeEnds:
    """The whole ends near to where arcs end on the machine, six for each: their coordinate along the count axis (n),
    and those beside it (n × 6).

    `machine`: where the machine ends (n × 2), across the count axis on the circle: a tape without drift counts J as it
    does. `is_on_circle` (n × 6). `likelihoods` (n × 6): density at a whole end of how far along the chord the centre
    was rounded, per µm across the count axis. `across` (n): as `Block.across`.
    """

    machine: Vector
    along: Whole
    beside: Whole
    is_on_circle: Flags
    likelihoods: Vector
    across: Whole

    def means(self) -> Vector:
        """The mean of each arc's whole ends by their likelihoods (n × 2); where none is likely, the machine's end."""
        total = mean = np.zeros(len(self.along))
        for beside, weight in zip(self.beside.T.astype(float), self.likelihoods.T, strict=True):
            total = total + weight
            mean = mean + weight * beside
        tells, found = np.flatnonzero(total > LEAST), self.machine.astype(float)
        across = self.across[tells]
        found[tells, across], found[tells, 1 - across] = mean[tells] / total[tells], self.along[tells]
        return found

    def each(self) -> Iterator[MayEnd]:
        """One arc after the other."""
        columns = (self.machine, self.along, self.beside, self.likelihoods, self.across)
        return map(MayEnd._make, zip(*(column.tolist() for column in columns), strict=True))


def whole_ends(tape: Tape, rows: Whole) -> WholeEnds:
    """What the ends of the arcs in some rows of a tape may have been.

    With d the chord, r the rounding and n = x² + y²: |end|² − n = −2 r·d, and r is spread evenly over ±½ on
    each axis. The sum of two such is a trapezoid.
    """
    arcs, each = columns_of(tape)[rows], np.arange(len(rows))
    stands = arcs.starts + machine_moves(tape)[rows]
    machine, across = arcs.on_circles(stands), arcs.across
    along, from_along = stands[each, 1 - across], arcs.starts[each, 1 - across]
    beside = np.floor(machine[each, across]).astype(along.dtype)[:, None] + np.arange(-2, 4)
    squares = beside * beside + (along * along)[:, None]
    ways = abs(beside - arcs.starts[each, across][:, None]), abs(along - from_along)[:, None]
    short, long = np.minimum(*ways).astype(float), np.maximum(*ways).astype(float)
    off = (abs(squares - arcs.squares[:, None]) / 2).astype(float)
    inside = (long + short) / 2 - off
    with np.errstate(divide="ignore", invalid="ignore"):
        part = np.where(short > 0, np.minimum(1.0, inside / short), 1.0)
        likelihoods = np.where(inside > 0, part / long * abs(beside), 0.0)
    return WholeEnds(machine, along, beside, squares == arcs.squares[:, None], likelihoods.astype(float), across)
