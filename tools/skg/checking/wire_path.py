"""The wire's path on a tape, as the controller goes, for comparing it with the drawing."""

from __future__ import annotations

from collections.abc import Iterator
from copy import copy
from dataclasses import dataclass

import numpy as np

from skg.checking.follow import Followed
from skg.geometry.arrays import Floats, Whole
from skg.geometry.pieces import Pieces
from skg.geometry.plane import XY
from skg.planning.route import PlannedContour
from skg.tape.controller import trace_array

#: The controller may go this far from where the drawing has the wire, mm.
LIMIT = 0.003
#: A pass ends where a block ends that is no further from a start hole, mm.
_HOLE = 0.002
#: A path is looked at in no more places than this.
_MOST_PLACES = 400_000


@dataclass(frozen=True)
class Misfit:
    """A place (mm) where the wire is not where the drawing has it: `route` by its number in the order of cutting,
    how far it is off (infinite: far), whether it runs into its own contour there, whether it never came there."""

    route: int
    place: XY
    off: float
    is_into: bool = False
    is_missed: bool = False


class WirePath:
    """The wire's path: the pieces of all cuts, and how far the controller's steps go aside of each.

    What is compared with the drawing is where the controller goes. A piece and the largest of its steps tell that at
    most; where this is too much, its steps are looked at one by one.
    """

    def __init__(self, followed: Followed, routes: list[PlannedContour]) -> None:
        cuts = followed.cuts
        self.laid = followed.laid
        #: Which of the blocks they are.
        self.rows = np.concatenate([np.arange(cut.blocks.start, cut.blocks.stop) for cut in cuts])
        counts = np.array([cut.blocks.stop - cut.blocks.start for cut in cuts])
        owners = np.repeat([cut.route for cut in cuts], counts)
        places = (side[self.rows] / 1000 for side in (self.laid.starts, self.laid.ends, self.laid.centres))
        sweeps = np.where(self.laid.is_line, 0.0, self.laid.sweeps)[self.rows]
        self.pieces = Pieces.of_columns(*places, sweeps, owners)
        self.aside = followed.off_curve[self.rows] / 1000
        #: Which pass each piece belongs to; -1: to any, or that cannot be told.
        self.passes = np.repeat([cut.passes[0] for cut in cuts], counts)
        for cut, end, count in zip(cuts, np.cumsum(counts).tolist(), counts.tolist(), strict=True):
            if len(cut.passes) > 1:
                some = slice(end - count, end)
                self.passes[some] = _passes(cut.passes, routes[cut.route], self.pieces.end[some])

    def of_pass(self, number: int) -> Pieces:
        """The pieces; those that surely belong to other passes are nobody's."""
        pieces = copy(self.pieces)
        pieces.owner = np.where((self.passes == number) | (self.passes < 0), self.pieces.owner, -1)
        return pieces

    def doubtful(self, off: Floats, total: Floats) -> Whole:
        """Return the places, with their distances without and with the steps, that are too far off by the steps
        alone."""
        return np.flatnonzero((off <= LIMIT) & (total > LIMIT))

    def steps(self, number: int) -> Floats:
        """The controller's places on a piece, mm (m, 2)."""
        piece = self.laid[int(self.rows[number])]
        places = np.frombuffer(trace_array(piece.block), np.int64).reshape(-1, 2)
        return (places - piece.block.start + piece.start) / 1000


def _passes(passes: tuple[int, ...], route: PlannedContour, ends: Floats) -> Whole:
    """Return the passes of pieces that end at these places: a pass ends in a start hole."""
    holes = np.array([route.start, route.tab_hole] if route.tab else [route.start])
    is_last = (np.hypot(*(ends[:, None] - holes).T) < _HOLE).any(0)
    if is_last.sum() != len(passes):
        return np.full(len(ends), -1)
    return np.array(passes)[np.cumsum(is_last) - is_last]


def spacing_of(pieces: Pieces, widest: float) -> float:
    """Return the sampling distance of a path: nothing as large as the wire is missed."""
    return max(widest / 2, float(pieces.length.sum()) / _MOST_PLACES) if widest else np.inf


def first_of_each(owners: Whole, mask: np.ndarray) -> Iterator[tuple[int, int]]:
    """The owners of places where something is so, each with the first one."""
    marked = np.flatnonzero(mask)
    each, first = np.unique(owners[marked], return_index=True)
    return zip(each.tolist(), marked[first].tolist(), strict=True)


def place_of(place: Floats) -> XY:
    return float(place[0]), float(place[1])
