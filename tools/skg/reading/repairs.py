"""Repairs that somebody asked for by their places, and those that could be asked for: nothing is put in but a bridge.

- "bridge": a line between two ends that do not meet;
- "corner": two ends go to where their lines or arcs cross, each made longer or shorter;
- "stray": an open line that is no outline is left.

A place is one in the file, in mm. A drawing that was saved anew has its ends a little elsewhere, or all of them
somewhere else: each repair goes to the nearest ends, and all of them to where most find theirs.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from math import atan2, hypot, pi, sqrt

import numpy as np
import shapely

from skg.geometry.contour import Contour, Edge
from skg.geometry.plane import XY, cross, distance, dot, minus, polar, shifted, turn
from skg.job.read_options import MEET, ReadOptions
from skg.messages.finding import Finding, Phrase
from skg.reading.account import Mend, OpenEnd, Repair

#: An end is no farther from where it was, mm.
FOUND = 0.5
#: Ends of a drawing that was moved lie to each other as before, mm.
_ALIKE = 0.01
#: Ends go no farther to where they cross, mm, and an edge loses no more than this part of it.
REACH, _MOST_LOST = 5.0, 0.5
#: No more ends are looked at for crossings.
_MOST_ENDS = 1000


@dataclass
class Repaired:
    """The edges of a drawing as they were repaired. `bridges`: put in; `pieces`: cut off at corners; `mends`: where
    what is cut is not what is drawn; `findings`: what was done, and what has lost its place; `by`: how far the drawing
    was moved since the repairs were asked for, mm."""

    edges: list[Edge]
    bridges: list[Edge] = field(default_factory=list)
    pieces: list[Edge] = field(default_factory=list)
    mends: list[Mend] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)
    by: XY = (0.0, 0.0)


def repaired(edges: Sequence[Edge], options: ReadOptions) -> Repaired:
    """The edges with corners made and bridges put in, where `options` has them."""
    result = Repaired(list(edges))
    if not (options.bridges or options.corners or options.strays):
        return result
    ends = _Ends(edges)
    result.by = ends.moved([*options.bridges, *options.corners])
    for kind, asked in (("corner", options.corners), ("bridge", options.bridges)):
        for x, y, u, v in asked:
            places = shifted((x, y), result.by), shifted((u, v), result.by)
            pair = ends.pair(*places)
            make = _corner if kind == "corner" else _bridge
            if pair is None or not make(result, *pair):
                result.findings.append(lost(kind, (x, y)))
    return result


def lost(kind: str, place: XY) -> Finding:
    """The finding that nothing is at the place of a repair."""
    return Finding("repair-lost", kind=Phrase(f"repair-{kind}"), place=place)


class _Ends:
    """The ends of edges, each with the number of its edge and whether it is the last place of that one."""

    def __init__(self, edges: Sequence[Edge]) -> None:
        self.of = [(number, is_last) for number in range(len(edges)) for is_last in (False, True)]
        self.places = [place for edge in edges for place in (edge.start, edge.end)]
        self.tree = shapely.STRtree(shapely.points(self.places))

    def pair(self, first: XY, last: XY) -> tuple[tuple[int, bool], tuple[int, bool]] | None:
        """The ends nearest to two places; None where one is not near, or both are one."""
        one, other = self.tree.nearest(shapely.points([first, last])).tolist()
        far = max(distance(self.places[one], first), distance(self.places[other], last))
        return None if far > FOUND or self.places[one] == self.places[other] else (self.of[one], self.of[other])

    def moved(self, asked: Sequence[tuple[float, float, float, float]]) -> XY:
        """The way that the drawing was moved, mm: where no repair finds its ends, the one way on which most do, else 0,
        0."""
        if not asked or any(self.pair(each[:2], each[2:]) for each in asked):
            return 0.0, 0.0
        x, y, u, v = asked[0]
        places = np.array(self.places)
        seconds = shapely.points(places + (u - x, v - y))
        ones = np.unique(self.tree.query(seconds, predicate="dwithin", distance=_ALIKE)[0])
        ways = {(round(bx, 3), round(by, 3)): (bx, by) for bx, by in (places[ones] - (x, y)).tolist()}
        counts = {
            way: sum(self.pair(shifted(each[:2], way), shifted(each[2:], way)) is not None for each in asked)
            for way in list(ways.values())[:_MOST_ENDS]
        }
        most = max(counts.values(), default=0)
        best = [way for way, count in counts.items() if count == most]
        return best[0] if len(best) == 1 else (0.0, 0.0)


def _bridge(result: Repaired, one: tuple[int, bool], other: tuple[int, bool]) -> bool:
    """Put a line in between two ends."""
    edges = result.edges
    first, last = (edges[number].end if is_last else edges[number].start for number, is_last in (one, other))
    if first == last:
        return False
    bridge = Edge(first, last, entity=edges[one[0]].entity)
    result.bridges.append(bridge)
    result.mends.append(Mend("joined", bridge.at(0.5), bridge.length))
    return True


def _corner(result: Repaired, one: tuple[int, bool], other: tuple[int, bool]) -> bool:
    """Let two ends go to where they cross."""
    towards = [_towards(result.edges[number], is_last) for number, is_last in (one, other)]
    corner = _crossing(*towards) if one[0] != other[0] else None
    if corner is None:
        return False
    longer = shorter = 0.0
    for (number, is_last), edge in zip((one, other), towards, strict=True):
        after, piece, far = _ended(edge, corner)
        result.edges[number] = after if is_last else after.reversed()
        if piece is not None:
            result.pieces.append(piece)
            result.mends.append(Mend("past", corner, far))
            shorter = max(shorter, far)
        elif far:
            result.mends.append(Mend("extended", corner, far))
            longer = max(longer, far)
    result.findings.append(Finding("corner-made", place=corner, longer=longer, shorter=shorter))
    return True


def _towards(edge: Edge, is_last: bool) -> Edge:
    """An edge in the direction in which it comes to an end of it."""
    return edge if is_last else edge.reversed()


def _ended(edge: Edge, place: XY) -> tuple[Edge, Edge | None, float]:
    """An edge that ends at a place on its line or circle; the piece of it that lies behind that, if any; and how much
    longer or shorter it is, mm."""
    if edge.centre is None:
        way = minus(edge.end, edge.start)
        is_longer = dot(minus(place, edge.end), way) >= 0
        after, far = replace(edge, end=place), distance(edge.end, place)
    else:
        by = turn(edge.angles[1], atan2(*reversed(minus(place, edge.centre))))
        is_longer = by * edge.sweep >= 0
        after, far = replace(edge, end=place, sweep=edge.sweep + by), abs(by) * edge.radius
    if is_longer or far < 1e-9:
        return after, None, far if is_longer else 0.0
    return after, Edge(place, edge.end, edge.centre, edge.sweep - after.sweep, entity=edge.entity), far


def _crossing(one: Edge, other: Edge) -> XY | None:
    """The place that two edges cross at which come to their ends there, or would if they went on: the one nearest to
    both ends, within `REACH` of each."""
    if one.nodes or other.nodes or one.is_circle or other.is_circle:
        return None
    best, least = None, REACH
    for place in _common(one, other):
        far = 0.0
        for edge in (one, other):
            after, piece, by = _ended(edge, place)
            is_most = piece is not None and by > _MOST_LOST * edge.length
            is_round = edge.centre is not None and abs(after.sweep) >= 2 * pi - 1e-6
            far = max(far, REACH if is_most or is_round else by)
        if far < least:
            best, least = place, far
    return best


def _common(one: Edge, other: Edge) -> Iterator[XY]:
    """The places on the lines or circles of two edges, wherever these end."""
    if one.centre is None and other.centre is None:
        way, to = minus(one.end, one.start), minus(other.end, other.start)
        area = cross(way, to)
        if abs(area) > 1e-9 * hypot(*way) * hypot(*to):
            part = cross(minus(other.start, one.start), to) / area
            yield one.start[0] + part * way[0], one.start[1] + part * way[1]
        return
    if one.centre is None or other.centre is None:
        line, arc = (one, other) if one.centre is None else (other, one)
        way = minus(line.end, line.start)
        length = hypot(*way)
        to = minus(arc.centre or arc.start, line.start)
        along, beside = dot(way, to) / length, cross(way, to) / length
        half = arc.radius**2 - beside**2
        if half >= 0:
            for side in (-1, 1):
                part = (along + side * sqrt(half)) / length
                yield line.start[0] + part * way[0], line.start[1] + part * way[1]
        return
    between = minus(other.centre, one.centre)
    far = hypot(*between)
    if far < 1e-9:
        return
    along = (far**2 + one.radius**2 - other.radius**2) / (2 * far)
    half = one.radius**2 - along**2
    if half >= 0:
        middle, turned = atan2(between[1], between[0]), atan2(sqrt(half), along)
        yield from (polar(one.centre, one.radius, middle + side * turned) for side in (-1, 1))


def without_strays(runs: Sequence[Contour], places: Iterable[XY]) -> tuple[list[int], list[tuple[XY, int | None]]]:
    """The numbers of the runs that are left, and of each place the run that lies there, None if there is none."""
    lying: list[tuple[XY, int | None]] = []
    for place in places:
        near = [(min(edge.far(place) for edge in run.edges), number) for number, run in enumerate(runs)]
        far, number = min(near, default=(2 * FOUND, -1))
        lying.append((place, number if far <= FOUND else None))
    gone = {number for _, number in lying}
    return [number for number in range(len(runs)) if number not in gone], lying


def possible(opened: Sequence[Contour], ends: Sequence[OpenEnd]) -> list[Repair]:
    """The repairs that open lines may need, the smallest of each kind first. `ends`: those of open contours, each with
    the nearest other one."""
    corners = list(_corners(opened))
    # (nothing is put in beside what runs past a corner, or from one end of a line to its other)
    none = {frozenset(corner.places) for corner, is_trimmed in corners if is_trimmed}
    none |= {frozenset((run.edges[0].start, run.edges[0].end)) for run in opened if len(run.edges) == 1}
    gaps = {
        tuple(sorted((end.place, end.other))): end.gap
        for end in ends
        if end.other is not None and end.place != end.other and frozenset((end.place, end.other)) not in none
    }
    bridges = [Repair("bridge", (one, other), (*one, *other), gap) for (one, other), gap in gaps.items()]
    strays = [Repair("stray", run.ends, _middle(run), sum(edge.length for edge in run.edges)) for run in opened]
    groups = bridges, [corner for corner, _ in corners], strays
    return [repair for group in groups for repair in sorted(group, key=lambda repair: repair.size)]


def _middle(run: Contour) -> XY:
    """A place on a run that no other run has."""
    return run.edges[len(run.edges) // 2].at(0.5)


def _corners(opened: Sequence[Contour]) -> Iterator[tuple[Repair, bool]]:
    """Pairs of free ends that could go to where they cross, each end with the one that is nearest so; whether something
    is cut off for that."""
    runs = [run for run in opened if not run.is_closed]
    known = Counter(place for run in runs for place in run.ends)
    edges = [
        _towards(run.edges[-1] if is_last else run.edges[0], is_last)
        for run in runs
        for is_last in (False, True)
        if known[run.edges[-1].end if is_last else run.edges[0].start] == 1
    ][:_MOST_ENDS]
    if len(edges) < 2:
        return
    points = shapely.points([edge.end for edge in edges])
    pairs = shapely.STRtree(points).query(points, predicate="dwithin", distance=2 * REACH)
    crossings = []
    for first, second in zip(*pairs.tolist(), strict=True):
        one, other = edges[first], edges[second]
        # (the two ends of a single edge are no corner)
        is_same = (one.start, one.end) == (other.end, other.start)
        corner = _crossing(one, other) if first < second and not is_same else None
        if corner is not None:
            changed = [_ended(edge, corner) for edge in (one, other)]
            far = max(by for _, _, by in changed)
            if far > MEET:
                crossings.append((far, first, second, any(piece is not None for _, piece, _ in changed)))
    used: set[int] = set()
    for far, first, second, is_trimmed in sorted(crossings):
        if not {first, second} & used:
            used |= {first, second}
            ends = edges[first].end, edges[second].end
            yield Repair("corner", ends, (*ends[0], *ends[1]), far), is_trimmed
