"""Lines and arcs that share a stretch: it is drawn twice, and is cut once.

Two free ends that lie on each other's edge, on one line or circle, become one: the second edge goes as far as the first
one's end. A line or an arc at such an end that lies on another one goes as a whole.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from dataclasses import dataclass, field, replace

import shapely

from skg.geometry.areas import lines_of
from skg.geometry.chords import SEEN
from skg.geometry.contour import Contour, Edge
from skg.geometry.plane import XY
from skg.reading.chain import Chains, Styles, chained_again
from skg.reading.overruns import without_end

#: Parts of an edge that are looked at to tell whether it lies on another.
_PARTS = (0.0, 0.25, 0.5, 0.75, 1.0)


@dataclass
class Overlaps:
    """Second copies, each with the edge that it lies on: `pieces` of edges, and `whole` edges."""

    pieces: list[tuple[Edge, Edge]] = field(default_factory=list)
    whole: list[tuple[Edge, Edge]] = field(default_factory=list)


def without_overlaps(chains: Chains, tolerance: float, near: float, styles: Styles = ()) -> tuple[Chains, Overlaps]:
    """The chains without what is drawn twice, and that. `near`: what is no further apart lies on each other, mm;
    `tolerance`, `styles`: see `chain`."""
    overlaps = Overlaps()
    runs = [contour for contour in chains.contours if not contour.is_closed] + chains.rest
    if not runs:
        return chains, overlaps
    free = {end for end, count in Counter(end for run in runs for end in run.ends).items() if count == 1}
    overlaps.whole, kept = _peeled(runs, free, near)
    ends = [(number, is_last) for number in kept for is_last in (False, True) if runs[number].ends[is_last] in free]
    towards = [_towards(kept[number], is_last) for number, is_last in ends]
    on = _on([edge.end for edge in towards], towards, near) if towards else set()
    neighbours = _neighbours({(first, second) for first, second in on if (second, first) in on})
    used: set[int] = set()
    for first, edge in enumerate(towards):
        for second in neighbours.get(first, ()):
            other = towards[second]
            is_one = ends[first][0] == ends[second][0] and len(kept[ends[first][0]].edges) == 1
            if second <= first or is_one or {first, second} & used or not _overlap(edge, other, near):
                continue
            number, is_last = ends[second]
            shorter, piece = without_end(kept[number], is_last, edge.end)
            if piece is None:
                continue
            used |= {first, second}
            edges = kept[number].edges
            kept[number] = replace(kept[number], edges=(*edges[:-1], shorter) if is_last else (shorter, *edges[1:]))
            overlaps.pieces.append((piece, edge))
    if not overlaps.pieces and not overlaps.whole:
        return chains, overlaps
    again, _ = chained_again(chains, list(kept.values()), [], tolerance, styles)
    # (of three that share a stretch two were left)
    again, more = without_overlaps(again, tolerance, near, styles)
    return again, Overlaps(overlaps.pieces + more.pieces, overlaps.whole + more.whole)


def _peeled(runs: list[Contour], free: set[XY], near: float) -> tuple[list[tuple[Edge, Edge]], dict[int, Contour]]:
    """Take from the free ends of runs the edges that lie on others: these, each with the one that it lies on, and what
    is left of the runs, by their numbers."""
    every = [edge for run in runs for edge in run.edges]
    starts, ends = (_on([getattr(edge, side) for edge in every], every, near) for side in ("start", "end"))
    neighbours = _neighbours(starts & ends)
    gone: list[tuple[Edge, Edge]] = []
    lost: set[int] = set()
    kept: dict[int, Contour] = {}
    before = 0
    for number, run in enumerate(runs):
        left = list(range(before, before := before + len(run.edges)))
        for is_last, end in zip((False, True), run.ends, strict=True):
            while left and end in free:
                index = left[-is_last]
                others = (other for other in neighbours.get(index, ()) if other not in lost)
                on = next((other for other in others if _lies_on(every[index], every[other], _PARTS, near)), None)
                if on is None:
                    break
                gone.append((every[index], every[on]))
                lost.add(index)
                del left[-is_last]
        if left:
            kept[number] = replace(run, edges=tuple(every[index] for index in left))
    return gone, kept


def _on(places: list[XY], edges: list[Edge], near: float) -> set[tuple[int, int]]:
    """Pairs of a place and an edge that it lies on, by their numbers."""
    lines = lines_of([Contour((edge,), False) for edge in edges])
    pairs = shapely.STRtree(lines).query(shapely.points(places), predicate="dwithin", distance=near + 2 * SEEN)
    return set(zip(*pairs.tolist(), strict=True))


def _neighbours(pairs: set[tuple[int, int]]) -> dict[int, list[int]]:
    """The second ones of pairs that are not one with itself, by the first ones."""
    result: dict[int, list[int]] = defaultdict(list)
    for first, second in sorted(pairs):
        if first != second:
            result[first].append(second)
    return result


def _towards(run: Contour, is_last: bool) -> Edge:
    """The edge at an end of a run, in the direction in which it ends there."""
    return run.edges[-1] if is_last else run.edges[0].reversed()


def _lies_on(edge: Edge, other: Edge, parts: tuple[float, ...], near: float) -> bool:
    """Tell whether places on a line or an arc, at some parts of its length, lie on another one."""
    if edge.nodes or other.nodes or edge.is_line != other.is_line:
        return False
    return all(other.far(edge.at(part)) <= near for part in parts)


def _overlap(edge: Edge, other: Edge, near: float) -> bool:
    """Tell whether two edges run over each other's end."""
    if not _lies_on(edge, other, (1.0,), near) or not _lies_on(other, edge, (1.0,), near):
        return False
    part = edge.nearest(other.end)
    return (1 - part) * edge.length > near and _lies_on(edge, other, (part, (1 + part) / 2), near)
