"""Ends that run a little past the corner that they meet at: the outline goes from corner to corner.

Two open contours, or both ends of one, cross or touch each other within `REACH` of their ends: that is a corner, and
what lies behind it is no outline. Nothing is put in: what is cut lies on what was drawn.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace

import numpy as np
import shapely

from skg.drawing.chain import Chains, Styles, chain
from skg.drawing.contour import Contour, Edge, part_of
from skg.plane import XY

#: What runs past a corner is no longer than this, mm, and no more than this part of its line or arc.
REACH, _PART = 0.2, 0.25
#: Ends that do not cross meet within this part of the tolerance: an arc is then moved, not bent, to the corner.
_NEAR = 0.4
#: A shorter piece is no piece, mm.
_NONE = 1e-6
#: The chords that an end of an arc is looked at as: they are within a hundredth of a micrometre of it.
_CHORDS = 32


@dataclass(frozen=True)
class Overrun:
    """A piece that runs past a corner, and the corner."""

    piece: Edge
    corner: XY


def without_overruns(chains: Chains, tolerance: float, styles: Styles = ()) -> tuple[Chains, list[Overrun]]:
    """The chains without what runs past corners, and these pieces; as they were where no outline closes for that.

    `styles`: see `chain`.
    """
    opened = [at for at, contour in enumerate(chains.contours) if not contour.is_closed]
    found = {at: chains.contours[at] for at in opened}
    cuts: list[Overrun] = []
    for pair in _pairs(found, tolerance):
        shorter = [_without(found[at], is_last, corner) for (at, is_last), corner in pair]
        for ((at, is_last), corner), (edge, piece) in zip(pair, shorter, strict=True):
            edges = found[at].edges
            found[at] = replace(found[at], edges=(*edges[:-1], edge) if is_last else (edge, *edges[1:]))
            cuts += [Overrun(piece, corner)] * (piece is not None)
    if not cuts:
        return chains, []
    again = chain((edge for contour in found.values() for edge in contour.edges), tolerance, styles)
    if not any(contour.is_closed for contour in again.contours):
        return chains, []
    closed = [contour for contour in chains.contours if contour.is_closed]
    merged = Chains(
        sorted(closed + again.contours, key=lambda contour: min(edge.entity for edge in contour.edges)),
        chains.rest + again.rest,
        chains.doubles + again.doubles,
        chains.short + again.short,
    )
    return merged, cuts


#: An end of a contour: the contour's number, and whether it is the end of its last edge; with the corner near it.
_End = tuple[int, bool]


def _pairs(contours: dict[int, Contour], tolerance: float) -> list[list[tuple[_End, XY]]]:
    """Ends that meet, with the place of each: two by two, where no third one is."""
    ends: list[_End] = []
    tails: list[shapely.LineString] = []
    for at, contour in contours.items():
        for is_last in (False, True):
            edge = contour.edges[-1] if is_last else contour.edges[0]
            if not edge.nodes and edge.length > _NONE:
                ends.append((at, is_last))
                tails.append(_tail(edge if is_last else edge.reversed()))
    if len(ends) < 2:
        return []
    lines = np.array(tails)
    one, other = shapely.STRtree(lines).query(lines, predicate="dwithin", distance=_NEAR * tolerance)
    meeting = [(p, q) for p, q in zip(one.tolist(), other.tolist(), strict=True) if p < q]
    count = Counter(end for pair in meeting for end in pair)
    found = []
    for p, q in meeting:
        # (the two ends of a single edge are no corner)
        is_same = ends[p][0] == ends[q][0] and len(contours[ends[p][0]].edges) == 1
        if count[p] == count[q] == 1 and not is_same:
            places = _corner(lines[p], lines[q])
            found.append(list(zip((ends[p], ends[q]), places, strict=True)))
    return found


def _tail(edge: Edge) -> shapely.LineString:
    """The last piece of an edge, from its end backwards."""
    part = min(_PART, REACH / edge.length)
    pieces = 1 if edge.is_line else _CHORDS
    return shapely.LineString([edge.at(1 - part * k / pieces) for k in range(pieces + 1)])


def _corner(one: shapely.LineString, other: shapely.LineString) -> tuple[XY, XY]:
    """Where two ends meet, on each: where they cross, else where they are nearest."""
    common = shapely.get_coordinates(shapely.intersection(one, other))
    if len(common) == 1:
        place = (float(common[0][0]), float(common[0][1]))
        return place, place
    if len(common):
        # They lie on each other: one of them goes on from the other's end.
        end = one.coords[0]
        return end, end
    nearest = shapely.get_coordinates(shapely.shortest_line(one, other)).tolist()
    return (nearest[0][0], nearest[0][1]), (nearest[1][0], nearest[1][1])


def _without(contour: Contour, is_last: bool, corner: XY) -> tuple[Edge, Edge | None]:
    """A contour's edge at an end up to the corner, and the piece behind that, if there is any."""
    edge = contour.edges[-1] if is_last else contour.edges[0].reversed()
    part = edge.nearest(corner)
    piece = None
    if (1 - part) * edge.length > _NONE:
        edge, piece = part_of(edge, 0, part), part_of(edge, part, 1)
    return edge if is_last else edge.reversed(), piece
