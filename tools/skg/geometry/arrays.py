"""Arrays: their types, and what is worked out of them to the last bit alike on every machine."""

from __future__ import annotations

from math import atan2, cos, hypot, sin

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Whole = NDArray[np.int64]
Flags = NDArray[np.bool_]


def headings(angles: Floats) -> Floats:
    """Unit vectors (n, 2) in directions, radians."""
    # (numpy's own cosine is another one on another processor)
    turns = angles.tolist()
    return np.column_stack([np.fromiter(map(of, turns), float, len(turns)) for of in (cos, sin)])


def directions(ways: NDArray) -> Floats:
    """Direction angles of ways (n × 2), radians."""
    # (math.atan2 is the same on every machine, numpy's is not)
    return np.fromiter(map(atan2, ways[:, 1].tolist(), ways[:, 0].tolist()), float, len(ways))


def hypots(x: NDArray, y: NDArray) -> Floats:
    """Lengths of ways, as math.hypot has them."""
    return np.fromiter(map(hypot, x.tolist(), y.tolist()), float, len(x))


def numbers_up_to(counts: Whole) -> Whole:
    """0, 1, 2 and so on, up to each of some counts in turn."""
    return np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)


def columns_at(table: Floats, rows: Whole) -> tuple[Floats, Floats]:
    """x and y of some rows. (numpy is slow along rows of two)"""
    return table[:, 0][rows], table[:, 1][rows]
