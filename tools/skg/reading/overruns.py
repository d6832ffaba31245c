"""Ends that run a little past the corner that they meet at: the outline goes from corner to corner.

Two open contours, or both ends of one, cross or touch each other within `REACH` of their ends: that is a corner, and
what lies behind it is no outline. Nothing is put in: what is cut lies on what was drawn.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from dataclasses import dataclass, replace

import numpy as np
import shapely

from skg.geometry.contour import Contour, Edge, part_of
from skg.geometry.plane import XY
from skg.job.read_options import MEET
from skg.reading.chain import Chains, Styles, chained_again

#: An overrun past a corner is no longer than this, mm, and no more than this part of its line or arc.
REACH, _PART = 0.2, 0.25
#: Ends that do not cross meet within this part of the tolerance: an arc is then moved, not bent, to the corner.
_NEAR = 0.4
#: A shorter piece is no piece, mm.
_NONE = 1e-6
#: The chords that an end of an arc is looked at as: they are within a hundredth of a micrometre of it.
_CHORDS = 32


@dataclass(frozen=True)
class Overrun:
    """A piece that runs past a corner, and the corner. `is_whole`: it is an edge of the drawing, not a part of one."""

    piece: Edge
    corner: XY
    is_whole: bool = False


def without_overruns(chains: Chains, tolerance: float, styles: Styles = ()) -> tuple[Chains, list[Overrun]]:
    """The chains without what runs past corners, and these pieces; as they were where no outline closes for that.

    `styles`: see `chain`.
    """
    freed, rest, cuts = _without_stubs(chains.rest)
    opened = dict(enumerate([contour for contour in chains.contours if not contour.is_closed] + freed))
    for pair in _pairs(opened, min(tolerance, MEET)):
        shorter = [without_end(opened[number], is_last, corner) for (number, is_last), corner in pair]
        for ((number, is_last), corner), (edge, piece) in zip(pair, shorter, strict=True):
            edges = opened[number].edges
            opened[number] = replace(opened[number], edges=(*edges[:-1], edge) if is_last else (edge, *edges[1:]))
            if piece is not None:
                cuts.append(Overrun(piece, corner))
    if not cuts:
        return chains, []
    again, closes = chained_again(chains, list(opened.values()), rest, tolerance, styles)
    return (again, cuts) if closes else (chains, [])


def _without_stubs(rest: list[Contour]) -> tuple[list[Contour], list[Contour], list[Overrun]]:
    """Of runs at junctions those that meet at none any more without the stubs that run past a corner by themselves;
    the other runs; and the stubs."""
    corners: dict[XY, list[int]] = defaultdict(list)
    for number, run in enumerate(rest):
        for end in run.ends:
            corners[end].append(number)
    stubs: dict[int, Overrun] = {}
    for corner, numbers in corners.items():
        for number in numbers if len(numbers) > 2 else ():
            edges, ends = rest[number].edges, rest[number].ends
            free = ends[ends[0] == corner]
            shortest = min(_last(rest[other], corner).length for other in numbers if other != number)
            if len(edges) == 1 and len(corners[free]) == 1 and edges[0].length <= min(REACH, _PART * shortest):
                stubs[number] = Overrun(edges[0], corner, is_whole=True)
    freed: list[Contour] = []
    kept: list[Contour] = []
    cuts: list[Overrun] = []
    for part in _parts(rest, corners) if stubs else ():
        gone = part & stubs.keys()
        meeting = Counter(end for number in part - gone for end in rest[number].ends)
        is_free = gone and max(meeting.values(), default=3) <= 2
        (freed if is_free else kept).extend(rest[number] for number in sorted(part - gone if is_free else part))
        cuts += [stubs[number] for number in sorted(gone) if is_free]
    return freed, kept if stubs else rest, cuts


def _last(run: Contour, corner: XY) -> Edge:
    """The edge of a run that ends at a corner."""
    return run.edges[0] if run.edges[0].start == corner else run.edges[-1]


def _parts(runs: list[Contour], corners: dict[XY, list[int]]) -> list[set[int]]:
    """The runs that hang together, by their numbers."""
    parts: list[set[int]] = []
    seen: set[int] = set()
    for begin in range(len(runs)):
        if begin in seen:
            continue
        part, open_ones = {begin}, [begin]
        while open_ones:
            first, last = runs[open_ones.pop()].ends
            more = {*corners[first], *corners[last]} - part
            part |= more
            open_ones += more
        parts.append(part)
        seen |= part
    return parts


#: An end of a contour: the contour's number, and whether it is the end of its last edge; with the corner near it.
_End = tuple[int, bool]


def _pairs(contours: dict[int, Contour], tolerance: float) -> list[list[tuple[_End, XY]]]:
    """Ends that meet, with the place of each: two by two, where no third one is."""
    ends: list[_End] = []
    tails: list[shapely.LineString] = []
    for number, contour in contours.items():
        for is_last in (False, True):
            edge = contour.edges[-1] if is_last else contour.edges[0]
            if not edge.nodes and edge.length > _NONE:
                ends.append((number, is_last))
                tails.append(_tail(edge if is_last else edge.reversed()))
    if len(ends) < 2:
        return []
    lines = np.array(tails)
    firsts, seconds = shapely.STRtree(lines).query(lines, predicate="dwithin", distance=_NEAR * tolerance)
    meeting = [(p, q) for p, q in zip(firsts.tolist(), seconds.tolist(), strict=True) if p < q]
    count = Counter(end for pair in meeting for end in pair)
    pairs = []
    for p, q in meeting:
        # (the two ends of a single edge are no corner)
        is_same = ends[p][0] == ends[q][0] and len(contours[ends[p][0]].edges) == 1
        if count[p] == count[q] == 1 and not is_same:
            places = _corner(lines[p], lines[q])
            pairs.append(list(zip((ends[p], ends[q]), places, strict=True)))
    return pairs


def _tail(edge: Edge) -> shapely.LineString:
    """The last piece of an edge, from its end backwards."""
    part = min(_PART, REACH / edge.length)
    pieces = 1 if edge.is_line else _CHORDS
    return shapely.LineString([edge.at(1 - part * k / pieces) for k in range(pieces + 1)])


def _corner(first: shapely.LineString, second: shapely.LineString) -> tuple[XY, XY]:
    """Return the place on each of two ends where they cross, else where they are nearest."""
    common = shapely.get_coordinates(shapely.intersection(first, second))
    if len(common) == 1:
        place = (float(common[0][0]), float(common[0][1]))
        return place, place
    if len(common):
        # They lie on each other: one of them goes on from the other's end.
        end = first.coords[0]
        return end, end
    nearest = shapely.get_coordinates(shapely.shortest_line(first, second)).tolist()
    return (nearest[0][0], nearest[0][1]), (nearest[1][0], nearest[1][1])


def without_end(contour: Contour, is_last: bool, corner: XY) -> tuple[Edge, Edge | None]:
    """A contour's edge at an end up to the corner, and the piece behind that, if there is any."""
    edge = contour.edges[-1] if is_last else contour.edges[0].reversed()
    part = edge.nearest(corner)
    piece = None
    if (1 - part) * edge.length > _NONE:
        edge, piece = part_of(edge, 0, part), part_of(edge, part, 1)
    return edge if is_last else edge.reversed(), piece
