"""Gouges: places where the wire of one contour cuts into another one, and their depth (shapely).

What is spoiled is an edge that the finished part has. Where a window reaches past the edge of its part, or into another
window, that edge is cut away, whatever the wire does there. A window is smaller than its part.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from skg.checking.wire_path import LIMIT
from skg.geometry.arrays import Flags, Floats, Whole
from skg.geometry.chords import MEASURED, chords_of
from skg.geometry.pieces import Pieces, spread
from skg.geometry.plane import XY

Shapes = NDArray[np.object_]

#: Contours cross when each has more than this inside the other one and outside; what is this near to a window's edge is
#: on it, mm.
_HAIR = 1e-3


@dataclass(frozen=True)
class Crossing:
    """The wire of one contour comes into another by `depth` mm, the deepest at a place of that contour; its
    middle too where it `is_through`, then it may be more."""

    contour: int
    other: int
    place: XY
    depth: float
    is_through: bool


def crossings(
    wire: Pieces,
    some: Whole,
    contours: Callable[[Whole], Pieces],
    others: Whole,
    least: Floats,
    inner: Flags,
    outer: Flags,
) -> list[Crossing]:
    """Return who cuts by more than `LIMIT` into whom, each pair of contours once.

    `some`: the pieces of the wire that come near, `others`: the owners of the contours that they come near to;
    `contours` gives the pieces of the contours with some owners. `least`: how far the wire of each must stay off
    what is not its own, mm. `inner`, `outer`: on which side of each contour its wire runs; on neither of an
    open one.
    """
    lines = lines_of(wire.some(some))

    def deep(near: Pieces, there: Shapes) -> list[Crossing]:
        one, other = shapely.STRtree(there).query(lines, predicate="dwithin", distance=float(least.max(initial=0.0)))
        wires, owners = wire.owner[some[one]], near.owner[other]
        far = shapely.distance(lines[one], there[other])
        depth = least[wires] - far
        deep = np.flatnonzero((wires != owners) & (depth > LIMIT))
        # The deepest of each pair comes first.
        deep = deep[np.lexsort((-depth[deep], owners[deep], wires[deep]))]
        _, first = np.unique(np.stack((wires[deep], owners[deep])), axis=1, return_index=True)
        found = []
        for at in deep[np.sort(first)].tolist():
            x, y = shapely.get_coordinates(shapely.shortest_line(lines[one[at]], there[other[at]]))[1].tolist()
            found.append(Crossing(int(wires[at]), int(owners[at]), (x, y), float(depth[at]), bool(far[at] == 0)))
        return found

    near = contours(np.unique(others))
    found = deep(near, lines_of(near))
    if not found:
        return found
    # (behind an edge that is cut away there may be one that is not)
    near = contours(np.arange(len(least)))
    there = lines_of(near)
    return deep(near, there) if _cut_away(there, near.owner, inner, outer) else found


def _cut_away(lines: Shapes, owners: Whole, inner: Flags, outer: Flags) -> bool:
    """Take what other contours cut away from the edges of contours, which are lines in their order; False: nothing."""
    closed = [owner for owner in np.unique(owners).tolist() if inner[owner] or outer[owner]]
    pieces = {owner: slice(*np.searchsorted(owners, (owner, owner + 1))) for owner in closed}
    rings = np.array([shapely.LinearRing(shapely.get_coordinates(lines[pieces[owner]])) for owner in closed])
    # (what has no width in one that crosses itself is no area)
    areas = shapely.buffer(shapely.make_valid(shapely.polygons(rings)), 0)
    sizes = shapely.area(areas)
    one, other = shapely.STRtree(rings).query(rings, predicate="intersects")
    parts: dict[int, list[shapely.Geometry]] = {}
    holes: dict[int, list[shapely.Geometry]] = {}
    for a, b in zip(one.tolist(), other.tolist(), strict=True):
        mine, its = closed[a], closed[b]
        is_hole = inner[its]
        # (an island that reaches over the edge of its opening takes nothing from that, nor has it anything taken away)
        if a == b or not (is_hole or inner[mine]) or (is_hole != inner[mine] and (sizes[b] < sizes[a]) != is_hole):
            continue
        area = areas[b].buffer(_HAIR, join_style="mitre") if is_hole else areas[b]
        left, within = shapely.difference(rings[a], area), shapely.intersection(rings[a], area)
        if left.length > _HAIR and within.length > _HAIR:
            (holes if is_hole else parts).setdefault(mine, []).append(area)
    for mine, some in parts.items():
        # (a window may reach from one part into another)
        lines[pieces[mine]] = _clipped(lines[pieces[mine]], shapely.union_all(some), True)
    for mine, some in holes.items():
        lines[pieces[mine]] = _clipped(lines[pieces[mine]], shapely.union_all(some), False)
    return bool(parts or holes)


def _clipped(lines: Shapes, area: shapely.Geometry, is_inner: bool) -> Shapes:
    """The parts of lines in an area, or those outside of it. (only lines that cross its edge are worked out)"""
    shapely.prepare(area)
    within, outside = shapely.contains_properly(area, lines), shapely.disjoint(area, lines)
    clipped, crossing = lines.copy(), ~(within | outside)
    clipped[outside if is_inner else within] = shapely.LineString()
    clipped[crossing] = (shapely.intersection if is_inner else shapely.difference)(lines[crossing], area)
    return clipped


def lines_of(pieces: Pieces) -> Shapes:
    """Pieces as chords."""
    spaces = np.ones(len(pieces.owner), np.int64)
    for arc in np.flatnonzero(pieces.is_arc).tolist():
        spaces[arc] = chords_of(pieces.radius[arc], pieces.sweep[arc], MEASURED)
    which, part = spread(spaces, 0, len(spaces))
    return shapely.linestrings(pieces.at(which, part), indices=which)
