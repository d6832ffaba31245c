"""Where the wire of one contour cuts into another one, and how deep: measured between the pieces (shapely)."""

from __future__ import annotations

from dataclasses import dataclass
from math import acos

import numpy as np
import shapely

from skg.cutting.near import Floats, Pieces, Whole, spread
from skg.plane import XY

#: The chords that stand for an arc leave it by no more than this, mm.
_CHORD = 2e-4


@dataclass(frozen=True)
class Crossing:
    """The wire of one route comes into another's contour by `depth` mm, the deepest at a place of that contour; its
    middle too where it `is_through`, then it may be more."""

    route: int
    other: int
    place: XY
    depth: float
    is_through: bool


def crossings(
    wire: Pieces, some: Whole, contours: Pieces, others: Whole, least: Floats, limit: float
) -> list[Crossing]:
    """Return who cuts by more than `limit` into whom, each pair of routes once.

    `some`: the pieces of the wire that come near, `others`: the owners of the contours that they come near to.
    `least`: how far the wire of each route must stay off what is not its own, mm.
    """
    near = np.flatnonzero(np.isin(contours.owner, others))
    lines, there = _lines(wire, some), _lines(contours, near)
    reach = float(least.max(initial=0.0))
    one, other = shapely.STRtree(there).query(lines, predicate="dwithin", distance=reach)
    routes, owners = wire.owner[some[one]], contours.owner[near[other]]
    far = shapely.distance(lines[one], there[other])
    depth = least[routes] - far
    deep = np.flatnonzero((routes != owners) & (depth > limit))
    # The deepest of each pair comes first.
    deep = deep[np.lexsort((-depth[deep], owners[deep], routes[deep]))]
    _, first = np.unique(np.stack((routes[deep], owners[deep])), axis=1, return_index=True)
    found = []
    for at in deep[np.sort(first)].tolist():
        x, y = shapely.get_coordinates(shapely.shortest_line(lines[one[at]], there[other[at]]))[1].tolist()
        found.append(Crossing(int(routes[at]), int(owners[at]), (x, y), float(depth[at]), bool(far[at] == 0)))
    return found


def _lines(pieces: Pieces, which: Whole) -> np.ndarray:
    """Pieces as chords."""
    spaces = np.ones(len(which), np.int64)
    arcs = np.flatnonzero(pieces.is_arc[which])
    for at in arcs.tolist():
        piece = which[at]
        step = 2 * acos(max(0.9, 1 - _CHORD / pieces.radius[piece]))
        spaces[at] = max(2, int(abs(pieces.sweep[piece]) / step) + 1)
    of, part = spread(spaces, 0, len(spaces))
    return shapely.linestrings(pieces.at(which[of], part), indices=of)
