"""Where the blocks of a tape should end."""

from __future__ import annotations

import numpy as np

from skg.tape.block import Tape
from skg.tape.columns import Columns, Flags, Numbers, Reals, columns_of, kept


def closed_moves(tape: Tape) -> Numbers:
    """Return the moves of a tape's blocks (n × 2, µm), so that a route that is meant to close does close.

    A block tells an arc's end exactly along the count axis, but across it only as well as its start gives the
    radius: the tape's own rounded end may be a µm away from `Block.end`. Where those µm leave a gap that they
    can explain, the arcs whose end was the closest call give a µm each until the gap is gone.
    """
    return kept(tape, "closed moves", lambda: _closed_moves(columns_of(tape), tape.bounds))


def _closed_moves(columns: Columns, bounds: list[tuple[int, int]]) -> Numbers:
    moves = columns.moves.copy()
    for axis in (0, 1):
        gives = columns.is_arc & (columns.across == axis)
        firsts, lasts = np.array(bounds).T
        sums, counts = (np.concatenate([[0], np.cumsum(column)]) for column in (moves[:, axis], gives))
        gaps = sums[lasts] - sums[firsts]
        for at in np.flatnonzero((gaps != 0) & (abs(gaps) <= counts[lasts] - counts[firsts])):
            gap, rows = gaps[at], firsts[at] + np.flatnonzero(gives[firsts[at] : lasts[at]])
            way, arcs = -1 if gap > 0 else 1, columns[rows]
            may_give = _may_give(arcs, axis, way)
            ranked = np.argsort(-way * _doubts(arcs, axis), kind="stable")
            moves[rows[ranked[may_give[ranked]][: abs(gap)]], axis] += way
    return moves


def _doubts(arcs: Columns, axis: int) -> Reals:
    """The unrounded ends of arcs minus their rounded ones, across the count axis, µm."""
    return arcs.on_circles(arcs.ends)[:, axis] - arcs.ends[:, axis]


def _may_give(arcs: Columns, axis: int, way: int) -> Flags:
    """Whether the count direction is still right when an arc's end moves by a µm across it."""
    other, along = abs(arcs.ends[:, axis] + way), abs(arcs.ends[:, 1 - axis])
    return np.where(arcs.counts_y, along < other, along <= other)
