"""The order in which places are gone to: the nearest one is always next."""

from __future__ import annotations

from collections import defaultdict
from math import inf

import numpy as np

from skg.geometry.arrays import Floats
from skg.geometry.plane import XY

#: So many rings of cells around a place are looked at for the one that is nearest to it, before all are.
_RINGS = 4


def nearest_order(places: Floats, begin: XY) -> list[int]:
    """The order of places when from `begin` on the nearest one is always next; of equally near ones the first."""
    x, y = places.T.copy()
    xs, ys = x.tolist(), y.tolist()
    (left, low), size = places.min(0).tolist(), (places.max(0) - places.min(0)).tolist()
    cell = max((size[0] * size[1] / len(xs)) ** 0.5 * 1.5, max(size) / len(xs), 1e-9)
    columns, rows = int(size[0] / cell), int(size[1] / cell)
    # (cells by one number: what lies so many rings beside the last row is not in the next column)
    column = rows + 1 + 2 * _RINGS
    rings = [[i * column + j for i, j in _ring(ring)] for ring in range(_RINGS)]
    cells: dict[int, list[int]] = defaultdict(list)
    home = [int((p - left) / cell) * column + int((q - low) / cell) for p, q in zip(xs, ys, strict=True)]
    for index, key in enumerate(home):
        cells[key].append(index)
    order: list[int] = []
    p, q = begin
    for _ in xs:
        here = min(max(int((p - left) // cell), 0), columns) * column + min(max(int((q - low) // cell), 0), rows)
        nearest, best = -1, inf
        for number, ring in enumerate(rings):
            for beside in ring:
                for index in cells.get(here + beside, ()):
                    u, v = xs[index] - p, ys[index] - q
                    far = u * u + v * v
                    if far < best or far == best and index < nearest:
                        nearest, best = index, far
            # All that is in no ring yet is at least so many cells away.
            if best < (number * cell) ** 2 * (1 - 1e-9):
                break
        else:
            nearest = int(np.argmin((x - p) ** 2 + (y - q) ** 2))
        order.append(nearest)
        cells[home[nearest]].remove(nearest)
        p, q = xs[nearest], ys[nearest]
        x[nearest] = inf
    return order


def _ring(number: int) -> list[tuple[int, int]]:
    """Columns and rows from a cell to those that are so many cells around it."""
    if not number:
        return [(0, 0)]
    sides = [(i, j) for i in range(-number, number + 1) for j in (-number, number)]
    return sides + [(i, j) for i in (-number, number) for j in range(1 - number, number)]
