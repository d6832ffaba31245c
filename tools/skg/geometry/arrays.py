"""Arrays: their types, and what is worked out of them to the last bit alike on every machine."""

from __future__ import annotations

from collections.abc import Iterable
from math import atan2, cos, hypot, sin

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Whole = NDArray[np.int64]
Flags = NDArray[np.bool_]


def headings(angles: Floats) -> Floats:
    """Unit vectors (n, 2) in directions, radians."""
    # (numpy's own cosine is another one on another processor)
    return np.column_stack([np.fromiter(map(of, _each(angles)), float, len(angles)) for of in (cos, sin)])


def directions(ways: NDArray) -> Floats:
    """Direction angles of ways (n × 2), radians."""
    # (math.atan2 is the same on every machine, numpy's is not)
    return np.fromiter(map(atan2, _each(ways[:, 1]), _each(ways[:, 0])), float, len(ways))


def hypots(x: NDArray, y: NDArray) -> Floats:
    """Lengths of ways, as math.hypot has them."""
    return np.fromiter(map(hypot, _each(x), _each(y)), float, len(x))


def _each(column: NDArray) -> Iterable[float]:
    """The numbers of a column, as Python has them. (a list of them takes four times as much memory as they do)"""
    return column.tolist() if column.dtype == object else column.data


def numbers_up_to(counts: Whole) -> Whole:
    """0, 1, 2 and so on, up to each of some counts in turn."""
    return np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)


def columns_at(table: Floats, rows: Whole) -> tuple[Floats, Floats]:
    """x and y of some rows. (numpy is slow along rows of two)"""
    return table[:, 0][rows], table[:, 1][rows]
