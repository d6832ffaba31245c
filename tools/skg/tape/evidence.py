"""Whether a tape is one without drift, by what its blocks tell."""

from __future__ import annotations

from collections import Counter
from math import log, pi

import numpy as np

from skg.geometry.arrays import Floats
from skg.tape.block import Tape
from skg.tape.columns import Columns, columns_of
from skg.tape.moves import machine_moves
from skg.tape.roundings import WholeEnds, closes, gap_of, whole_ends

#: Log likelihood for a tape without drift where a route closes on the machine alone; against it, as programmed alone.
_SURE = 10
#: So many arcs are looked at at once: each has six ends, and much is to be said of each.
_ARCS = 20_000


def drift_evidence(tape: Tape) -> float:
    """Log likelihood that a tape's blocks start where the controller stands, against a tape with drift.

    Where they do, a route that closes does so on the machine, and the circle of an arc whose centre was moved
    (docs/drift.md) passes close to a whole micrometre at the block's end, the closer the shorter the arc. On another
    tape it passes anywhere, and routes that close as programmed seldom do so on the machine. Where the tape does not
    tell, because the drawing lies on whole micrometres or is symmetrical, that is near 0.
    """
    columns = columns_of(tape)
    rows = np.flatnonzero(columns.is_arc)
    evidence = _evidence_of_circles(columns).sum()
    for part in np.array_split(rows, len(rows) // _ARCS + 1):
        evidence += _evidence(columns[part], whole_ends(tape, part)).sum()
    arcs = np.concatenate([[0], np.cumsum(columns.is_arc)])
    ends = np.concatenate([[[0, 0]], np.cumsum(machine_moves(tape), axis=0)])
    for first, last in tape.bounds:
        if arcs[first] < arcs[last]:
            evidence += _evidence_of_route(columns[first:last], bool((ends[first] == ends[last]).all()))
    return float(evidence)


def _evidence_of_route(columns: Columns, is_closed: bool) -> float:
    """Log likelihood that the blocks between two stops are without drift, by whether they close, on the machine
    (`is_closed`) and as programmed; there is an arc among them."""
    if not closes(*gap_of(columns)):
        return _SURE * is_closed
    if not is_closed:
        return -_SURE
    # Chance closes a route of many arcs the less; the misses of arcs that are congruent in pairs take each other away.
    arcs = columns[columns.is_arc]
    small, large = np.minimum(arcs.x, arcs.y), np.maximum(arcs.x, arcs.y)
    alike = Counter(zip(small.tolist(), large.tolist(), arcs.j.tolist(), strict=True))
    return log(1 + sum(count % 2 for count in alike.values()))


def _evidence_of_circles(columns: Columns) -> Floats:
    """Log likelihood of full circles: whether J counts the radius, or where the controller turns (docs/drift.md)."""
    tells = columns.is_full_circle & (columns.radii != columns.turns)
    return np.where(tells, np.where(columns.j == 4 * columns.turns, _SURE, -_SURE), 0)


def _evidence(arcs: Columns, ends: WholeEnds) -> Floats:
    """Log likelihood of each arc on a tape without drift, against any other tape."""
    # The centre was not moved; or a drawing on whole micrometres: its arcs fit on any tape.
    tells = ((arcs.starts * ends.machine).sum(axis=1) < 0) | (abs(arcs.sweeps) <= pi)
    tells &= ~ends.is_on_circle.any(axis=1)
    return np.where(tells, np.log(np.maximum(ends.likelihoods.sum(axis=1), 1e-3)), 0.0)
