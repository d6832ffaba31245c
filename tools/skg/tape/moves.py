"""Moves of a tape's blocks: as programmed, and as the controller goes (see `skg.tape.controller`)."""

from __future__ import annotations

import ctypes
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from skg.geometry.arrays import Flags, Floats, Whole, hypots
from skg.tape.block import Tape
from skg.tape.columns import FIELDS, Columns, columns_of, kept
from skg.tape.controller import CHUNK, State, library, stalled

#: So many blocks are followed at once, at most.
_CHUNK = 10_000
_FIELDS = [field[0] for field in State._fields_]


@dataclass(frozen=True)
class Walk:
    """The controller's outcome of blocks, a row for each; lengths in µm.

    `moves` is where it went (dx, dy), `steps` in how many steps; `off_curve` the largest distance from the line or arc
    as it starts where the controller stands, `off_path` from where that line or arc should lie. Both are distances from
    the whole line and the whole circle: `Block.move` − `moves` tells the end's miss.
    """

    moves: Whole
    steps: Whole
    off_curve: Floats
    off_path: Floats


def _distances(columns: Columns, highest: Whole, lowest: Whole) -> Floats:
    """Turn extremes of F into the largest distances from the curves, µm."""
    radii, squares = hypots(columns.x, columns.y), columns.squares
    # (a line far off its path has an F far below 0, and no squares that are those of arcs)
    farthest, nearest = (np.sqrt(np.maximum(0, squares + f).astype(float)) for f in (highest, lowest))
    outside, inside = farthest - radii, radii - nearest
    return np.where(columns.is_line, np.maximum(highest, -lowest) / radii, np.maximum(outside, inside))


def expected_steps(columns: Columns) -> Whole:
    """About how many steps blocks take: those on both axes, from their shape alone."""
    return np.where(columns.is_line, columns.x + columns.y, 2 * columns.j)


def _parts(steps: Whole) -> Iterator[slice]:
    """The blocks that are followed at once: so many, or of so many steps."""
    first, behind = 0, np.cumsum(steps)
    while first < len(steps):
        most = int(np.searchsorted(behind, behind[first] + CHUNK))
        last = max(first + 1, min(first + _CHUNK, most, len(steps)))
        yield slice(first, last)
        first = last


def walk(
    tape: Tape,
    rows: Whole,
    should: Whole | None = None,
    progress: Callable[[int], object] = lambda steps: None,
) -> Walk:
    """Follow the blocks of a tape in some rows, one after the other.

    `should`: the moves (n × 2) that they ought to make: what a block misses is the next one's drift. Without it all are
    followed from where they start. `progress` is called with the number of steps taken since its last call. A block
    that never ends is a `UserError`.
    """
    columns = columns_of(tape)[rows]
    if should is None:
        # (equal blocks go equal ways: one of them is followed)
        first, like = columns.alike()
        rows, columns = rows[first], columns[first]
    else:
        like = np.arange(len(rows))
    many = np.bincount(like, minlength=len(rows))
    given = [getattr(columns, name) for name in FIELDS]
    moves, steps = np.zeros((len(rows), 2), np.int64), np.zeros(len(rows), np.int64)
    extremes = np.zeros((len(rows), 4), np.int64)
    drift = np.zeros(2, np.int64)

    def follow(part: slice) -> int:
        """Follow some of the blocks; returns the number of steps, with those of their like."""
        states = np.zeros((part.stop - part.start, len(_FIELDS)), np.int64)
        for index, column in enumerate(given):
            states[:, index] = column[part]
        states[0, 6:8] = drift
        wanted = None if should is None else np.ascontiguousarray(should[part], np.int64)
        address = None if wanted is None else ctypes.c_void_p(wanted.ctypes.data)
        done = library().skgsim_walk(ctypes.c_void_p(states.ctypes.data), len(states), address)
        if done < len(states):
            raise stalled(tape.blocks[int(rows[part.start + done])])
        moves[part] = states[:, _FIELDS.index("px") : _FIELDS.index("py") + 1]
        steps[part] = states[:, _FIELDS.index("steps")]
        extremes[part] = states[:, _FIELDS.index("f_max") :]
        if wanted is not None:
            drift[:] += (moves[part] - wanted).sum(axis=0)
        return int((steps[part] * many[part]).sum())

    parts = list(_parts(expected_steps(columns)))
    if should is None and len(parts) > 1:
        from concurrent.futures import ThreadPoolExecutor  # (slow to import, and needed here alone)

        # (no block waits for the one before it)
        with ThreadPoolExecutor(os.cpu_count()) as threads:
            for count in threads.map(follow, parts):
                progress(count)
    else:
        for part in parts:
            progress(follow(part))
    off_curve, off_path = (_distances(columns, *extremes[:, pair].T) for pair in (slice(0, 2), slice(2, 4)))
    return Walk(moves[like], steps[like], off_curve[like], off_path[like])


def machine_moves(tape: Tape) -> Whole:
    """Return the controller's move of each block of a tape (n × 2); an arc that never ends is a `UserError`."""
    return kept(tape, "machine moves", lambda: _machine_moves(tape))


def _machine_moves(tape: Tape) -> Whole:
    columns = columns_of(tape)
    # (a line ends where it should)
    machine_moves, rows = columns.moves.copy(), np.flatnonzero(~columns.is_line)
    machine_moves[rows] = walk(tape, rows).moves
    return machine_moves


def closed_moves(tape: Tape) -> Whole:
    """Return the moves of a tape's blocks (n × 2, µm), so that a route that is meant to close does close.

    A block tells an arc's end exactly along the count axis, but across it only as well as its start gives the
    radius: the tape's own rounded end may be a µm away from `Block.end`. Where those µm leave a gap that they
    can explain, the arcs whose end was the closest call give a µm each until the gap is gone.
    """
    return kept(tape, "closed moves", lambda: _closed_moves(columns_of(tape), tape.bounds))


def _closed_moves(columns: Columns, bounds: list[tuple[int, int]]) -> Whole:
    moves = columns.moves.copy()
    for axis in (0, 1):
        gives = columns.is_arc & (columns.across == axis)
        firsts, lasts = np.array(bounds).T
        sums, counts = (np.concatenate([[0], np.cumsum(column)]) for column in (moves[:, axis], gives))
        gaps = sums[lasts] - sums[firsts]
        for index in np.flatnonzero((gaps != 0) & (abs(gaps) <= counts[lasts] - counts[firsts])):
            gap, rows = gaps[index], firsts[index] + np.flatnonzero(gives[firsts[index] : lasts[index]])
            step, arcs = -1 if gap > 0 else 1, columns[rows]
            may_give = _may_give(arcs, axis, step)
            ranked = np.argsort(-step * _doubts(arcs, axis), kind="stable")
            moves[rows[ranked[may_give[ranked]][: abs(gap)]], axis] += step
    return moves


def _doubts(arcs: Columns, axis: int) -> Floats:
    """The unrounded ends of arcs minus their rounded ones, across the count axis, µm."""
    return arcs.on_circles(arcs.ends)[:, axis] - arcs.ends[:, axis]


def _may_give(arcs: Columns, axis: int, step: int) -> Flags:
    """Tell whether the count direction is still right when an arc's end moves by a µm across it."""
    other, along = abs(arcs.ends[:, axis] + step), abs(arcs.ends[:, 1 - axis])
    return np.where(arcs.counts_y, along < other, along <= other)
