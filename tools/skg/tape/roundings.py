"""What rounding to whole micrometres did to the blocks of a route, as far as the tape tells: see docs/drift.md,
section "Back to the drawing".

All lengths are micrometres. δ is what rounding added to a joint, γ to a centre: evenly spread over ±½ on each axis.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import accumulate
from math import floor, hypot

import numpy as np
from numpy.typing import NDArray

from skg.plane import XY, dot, minus
from skg.tape.block import Block
from skg.tape.controller import run_block

#: Variance of an error spread evenly over ±½.
VARIANCE = 1 / 12
#: A route is meant to close when it does so to this many standard deviations.
_CLOSES = 4

Vector = NDArray[np.float64]


def end_of(block: Block) -> XY:
    """An arc's end about its centre: whole along the count axis, across it on the circle."""
    return block.on_circle(block.end)


@lru_cache(maxsize=100_000)
def goes(block: Block) -> tuple[int, int]:
    """Where the controller goes with a block, (dx, dy)."""
    return block.move if block.is_line else run_block(block).move


def end_on_machine(block: Block) -> XY:
    """An arc's end where the controller stops: a tape without drift counts J as it does."""
    (xs, ys), (dx, dy) = block.start, goes(block)
    return block.on_circle((xs + dx, ys + dy))


def move_of(block: Block) -> XY:
    """From a block's start to its end, not rounded."""
    return minus(end_of(block), block.start) if block.is_arc else block.move


class Misses:
    """What the roundings do to the ends of the arcs of a route, to first order.

    The roundings are one array: the δ of the joints, then the γ of each block's centre. An arc's true end lies off
    its unrounded end by e = (s·δ₀ − t·δ₁ + (t − s)·γ) / t across the count axis, s and t the directions from the
    centre to start and end: both true ends are equally far from the true centre.
    """

    def __init__(self, blocks: list[Block], closed: bool) -> None:
        self.count = len(blocks)
        # A circle ends at the joint where it starts, a closed route too.
        joints = list(accumulate((not block.is_full_circle for block in blocks), initial=0))
        if closed:
            joints = [0 if joint == joints[-1] else joint for joint in joints]
        self.joints = joints
        self.centres = range(self.count + 1, 2 * self.count + 1)
        # Of each arc: which block it is, its axis across, the three roundings and how e goes by each of them.
        found: list[tuple[int, int, tuple[int, int, int], tuple[XY, XY, XY]]] = []
        for at, block in enumerate(blocks):
            if not block.is_arc:
                continue
            radius, (xs, ys), (xe, ye) = hypot(block.x, block.y), block.start, end_of(block)
            across = (xe, ye)[block.across]
            # By its count axis an arc ends at 0.7 across it, but for circles of a few µm.
            if abs(across) > 0.1 * radius:
                first, last = (xs / across, ys / across), (xe / across, ye / across)
                ways = first, (-last[0], -last[1]), minus(last, first)
                found.append((at, block.across, (joints[at], joints[at + 1], self.centres[at]), ways))
        self.blocks = np.array([one[0] for one in found], int)
        self.axes = np.array([one[1] for one in found], int)
        self.places = np.array([one[2] for one in found], int).reshape(-1, 3)
        self.ways = np.array([one[3] for one in found], float).reshape(-1, 3, 2)

    def none(self) -> Vector:
        """Roundings, all 0."""
        return np.zeros((2 * self.count + 1, 2))

    def pulls(self) -> Vector:
        """How much each rounding adds to the sum of all e on each axis (2 × roundings × 2)."""
        found = np.array([self.none(), self.none()])
        np.add.at(found, (self.axes[:, None], self.places), self.ways)
        return found

    def of(self, roundings: Vector) -> Vector:
        """Every block's e as a vector (blocks × 2)."""
        found = np.zeros((self.count, 2))
        found[self.blocks, self.axes] = (self.ways * roundings[self.places]).sum(axis=(1, 2))
        return found


def gap_of(blocks: list[Block]) -> tuple[Vector, Vector]:
    """By how much a route's unrounded moves do not close, and the standard deviation of that, were it closed."""
    pulls = Misses(blocks, True).pulls()
    return np.array([move_of(block) for block in blocks]).sum(axis=0), np.sqrt(VARIANCE * (pulls**2).sum(axis=(1, 2)))


def closes(gap: Vector, spread: Vector) -> bool:
    """Whether roundings alone explain a route's gap."""
    return bool((abs(gap) <= _CLOSES * spread + 1e-6).all())


def likelihood(block: Block, end: XY) -> float:
    """Density at a whole end of how far along the chord the centre was rounded, per µm across the count axis.

    With d the chord, r the rounding and n = x² + y²: |end|² − n = −2 r·d, and r is spread evenly over ±½ on
    each axis. The sum of two such is a trapezoid.
    """
    dx, dy = minus(end, block.start)
    short, long = sorted((abs(dx), abs(dy)))
    off = abs(dot(end, end) - block.x**2 - block.y**2) / 2
    inside = (long + short) / 2 - off
    if inside <= 0:
        return 0.0
    return min(1.0, inside / short if short else 1.0) / long * abs(end[block.across])


def whole_ends(block: Block) -> list[XY]:
    """The whole ends near to where an arc ends on the machine: its coordinate along the count axis, and beside it."""
    end, across = end_on_machine(block), block.across
    wholes = range(floor(end[across]) - 2, floor(end[across]) + 4)
    return [(whole, end[1]) if across == 0 else (end[0], whole) for whole in wholes]
