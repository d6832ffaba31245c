"""The wire's path on a tape, as the controller goes, for comparing it with the drawing."""

from __future__ import annotations

from collections.abc import Iterator
from copy import copy
from dataclasses import dataclass
from math import hypot, inf
from typing import NamedTuple

import numpy as np

from skg.checking.follow import Followed
from skg.geometry.arrays import Floats, Whole
from skg.geometry.pieces import Pieces
from skg.geometry.plane import XY
from skg.planning.planned import PlannedContour
from skg.tape.controller import trace_array

#: The controller may go this far from where the drawing has the wire, mm.
LIMIT = 0.003
#: A pass ends where a block ends that is no further from a start hole, mm.
_HOLE = 0.002
#: A path is looked at in no more places than this.
_MOST_PLACES = 400_000


@dataclass(frozen=True)
class Misfit:
    """A place (mm) where the wire is not where the drawing has it: `contour` by its number in the order of cutting,
    how far it is off (infinite: far), whether it runs into its own contour there, whether it never came there."""

    contour: int
    place: XY
    off: float
    is_into: bool = False
    is_missed: bool = False


class Beside:
    """The wire's intended distances from its own contours and from others, mm.

    `offsets`: R of its passes and of the cuts of its tabs, in its own direction; one that has fewer has its last one
    again. `passes`: how many of them are passes; `cuts`: how many there are. `aside`: the offsets without a sign;
    `wires`: the wire's pieces of each. `least`: how far it must stay off what is not its own.
    `is_on`: it runs on its line, of no side. Places that are looked at are `wire_spacing` apart on the wire, `spacing`
    on contours: nothing as large as the wire is missed. What is further from the wire than `reach` does not matter.
    """

    def __init__(self, path: WirePath, contours: list[PlannedContour]) -> None:
        self.contours = contours
        self.passes = np.array([len(planned.passes) for planned in contours])
        self.cuts = np.array([len(planned.offsets) for planned in contours])
        most = self.cuts.max()
        padded = [(*planned.offsets, *(most - len(planned.offsets)) * planned.offsets[-1:]) for planned in contours]
        self.offsets = np.array(padded, float)
        self.aside = np.abs(self.offsets)
        self.wires = [path.of_pass(number) for number in range(most)]
        self.widest = float(self.aside.max(initial=0.0))
        self.is_open = np.array([not planned.contour.is_closed for planned in contours])
        self.least = self.aside.min(1)
        # What is cut on its line takes as much away on each side as the wire beside the other contours.
        self.is_on = self.is_open & (self.least == 0)
        self.least[self.is_on] = self.least.max()
        self.wire_spacing = self.spacing = inf
        self.slack = 0.0
        if self.widest:
            nominal = sum(edge.length for planned in contours for edge in planned.contour.edges)
            self.wire_spacing = max(self.widest / 2, float(path.pieces.length.sum()) / _MOST_PLACES)
            self.spacing = max(self.widest / 2, nominal / _MOST_PLACES)
            # Between two places the wire may be as much nearer to a corner.
            self.slack = hypot(self.widest, self.wire_spacing / 2) - self.widest + LIMIT
        self.reach = self.widest + self.slack + 2 * LIMIT

    def beside(self, owners: Whole, passes: Whole) -> Floats:
        """Intended distance of places from their contours: in their pass, or in any (passes of -1)."""
        found, known = self.aside[owners], passes >= 0
        if found.shape[1] == 1:
            return found
        found[known] = found[known, passes[known]][:, None]
        return found


class Share(NamedTuple):
    """Some of the contours, that follow each other: their numbers; the nominal pieces of these, and of all others that
    their wire may come near to; which of these pieces, and of the wire's, are theirs."""

    numbers: slice
    nominal: Pieces
    own: Whole
    wire: Whole


class WirePath:
    """The wire's path: the pieces of all cuts, and how far the controller's steps go aside of each.

    What is compared with the drawing is where the controller goes. A piece and the largest of its steps tell that at
    most; where this is too much, its steps are looked at one by one.
    """

    def __init__(self, followed: Followed, contours: list[PlannedContour]) -> None:
        cuts = followed.cuts
        self.laid = followed.laid
        #: Which of the blocks they are.
        self.rows = np.concatenate([np.arange(cut.blocks.start, cut.blocks.stop) for cut in cuts])
        counts = np.array([cut.blocks.stop - cut.blocks.start for cut in cuts])
        owners = np.repeat([cut.contour for cut in cuts], counts)
        start, end, centre = (side[self.rows] / 1000 for side in (self.laid.starts, self.laid.ends, self.laid.centres))
        sweeps = np.where(self.laid.is_line, 0.0, self.laid.sweeps)[self.rows]
        self.pieces = Pieces.of_columns(start, end, centre, sweeps, owners)
        self.aside = followed.off_curve[self.rows] / 1000
        #: Which pass each piece belongs to; -1: to any, or that cannot be told.
        self.passes = np.repeat([cut.passes[0] for cut in cuts], counts)
        for cut, last, count in zip(cuts, np.cumsum(counts).tolist(), counts.tolist(), strict=True):
            if len(cut.passes) > 1:
                some = slice(last - count, last)
                self.passes[some] = _passes(cut.passes, contours[cut.contour], self.pieces.end[some])

    def lengths(self, contours: list[PlannedContour]) -> tuple[float, ...]:
        """Length of the wire's path in each pass, mm: the cuts of a tab begin anew with the first."""
        of_contour = np.array([len(planned.passes) for planned in contours])[self.pieces.owner]
        # (an open contour has one pass; where passes cannot be told apart they are the first)
        turns = np.maximum(np.where(self.passes < of_contour, self.passes, self.passes - of_contour), 0)
        return tuple(np.bincount(turns, self.pieces.length).tolist())

    def of_pass(self, number: int) -> Pieces:
        """The pieces; those that surely belong to other passes are nobody's."""
        self.pieces.index()  # (made once: each copy has it)
        pieces = copy(self.pieces)
        pieces.owner = np.where((self.passes == number) | (self.passes < 0), self.pieces.owner, -1)
        return pieces

    def near(self, low: Floats, high: Floats) -> Whole:
        """The pairs (2, m) of a contour and of a box, of n (their smallest and largest x and y), that its wire may
        come into."""
        pairs = [np.empty((2, 0), np.int64)]
        for box, piece in self.pieces.index().within(low, high):
            pairs.append(np.unique((self.pieces.owner[piece], box), axis=1))
        return np.concatenate(pairs, axis=1)

    def doubtful(self, off: Floats, total: Floats) -> Whole:
        """Return the places, with their distances without and with the steps, that are too far off by the steps
        alone."""
        return np.flatnonzero((off <= LIMIT) & (total > LIMIT))

    def steps(self, number: int) -> Floats:
        """The controller's places on a piece, mm (m, 2)."""
        piece = self.laid[int(self.rows[number])]
        places = np.frombuffer(memoryview(trace_array(piece.block)), np.int64).reshape(-1, 2)
        return (places - piece.block.start + piece.start) / 1000


def _passes(passes: tuple[int, ...], planned: PlannedContour, ends: Floats) -> Whole:
    """Return the passes of pieces that end at these places: a pass ends in a start hole."""
    holes = np.array([*planned.holes, *(tab.before for tab in planned.tabs.each)])
    is_last = (np.hypot(*(ends[:, None] - holes).T) < _HOLE).any(0)
    if is_last.sum() != len(passes):
        return np.full(len(ends), -1)
    return np.array(passes)[np.cumsum(is_last) - is_last]


def first_of_each(owners: Whole, mask: np.ndarray) -> Iterator[tuple[int, int]]:
    """The owners of places where something is so, each with the first one."""
    marked = np.flatnonzero(mask)
    each, first = np.unique(owners[marked], return_index=True)
    return zip(each.tolist(), marked[first].tolist(), strict=True)


def place_of(place: Floats) -> XY:
    return float(place[0]), float(place[1])
