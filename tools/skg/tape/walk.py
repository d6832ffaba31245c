"""Following all blocks of a tape with the controller, one after the other (see `skg.tape.controller`)."""

from __future__ import annotations

import ctypes
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from skg.tape.block import Tape
from skg.tape.columns import FIELDS, Columns, Numbers, Reals, columns_of, hypots, kept
from skg.tape.controller import CHUNK, State, library, stalled

#: So many blocks are followed at once, at most.
_CHUNK = 10_000
_FIELDS = [name for name, _ in State._fields_]


@dataclass(frozen=True)
class Walk:
    """What the controller made of blocks, a row for each: as `Outcome` of one."""

    moves: Numbers
    steps: Numbers
    off_curve: Reals
    off_path: Reals


def _distances(columns: Columns, highest: Numbers, lowest: Numbers) -> Reals:
    """Turn extremes of F into the largest distances from the curves, µm."""
    radii, squares = hypots(columns.x, columns.y), columns.squares
    # (a line far off its path has an F far below 0, and no squares that are those of arcs)
    farthest, nearest = (np.sqrt(np.maximum(0, squares + f).astype(float)) for f in (highest, lowest))
    outside, inside = farthest - radii, radii - nearest
    return np.where(columns.is_line, np.maximum(highest, -lowest) / radii, np.maximum(outside, inside))


def expected_steps(columns: Columns) -> Numbers:
    """About how many steps blocks take: those on both axes, from their shape alone."""
    return np.where(columns.is_line, columns.x + columns.y, 2 * columns.j)


def _parts(steps: Numbers) -> Iterator[slice]:
    """The blocks that are followed at once: so many, or of so many steps."""
    first, behind = 0, np.cumsum(steps)
    while first < len(steps):
        most = int(np.searchsorted(behind, behind[first] + CHUNK))
        last = max(first + 1, min(first + _CHUNK, most, len(steps)))
        yield slice(first, last)
        first = last


def walk(
    tape: Tape,
    rows: Numbers,
    should: Numbers | None = None,
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
        for at, column in enumerate(given):
            states[:, at] = column[part]
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
    off_curve, off_path = (_distances(columns, *extremes[:, some].T) for some in (slice(0, 2), slice(2, 4)))
    return Walk(moves[like], steps[like], off_curve[like], off_path[like])


def machine_moves(tape: Tape) -> Numbers:
    """Where the controller goes with each block of a tape (n × 2); an arc that never ends is a `UserError`."""
    return kept(tape, "machine moves", lambda: _machine_moves(tape))


def _machine_moves(tape: Tape) -> Numbers:
    columns = columns_of(tape)
    # (a line ends where it should)
    found, rows = columns.moves.copy(), np.flatnonzero(~columns.is_line)
    found[rows] = walk(tape, rows).moves
    return found
