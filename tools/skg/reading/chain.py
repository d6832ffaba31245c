"""Chaining: the contours that edges make, and what is left where more than two of them meet.

What closes by itself (a circle, a closed polyline, a part of a path) is a contour, whatever touches it. All other edges
are the lines of a graph whose corners are places where ends meet. A corner of two edges is a corner of a contour; where
more meet, the closed outlines are found so:

1. a ring of edges of one layer and type of line that meet no others of these is an outline, whatever else meets it
   (lines to measure to, lines to bend along);
2. of the others what hangs on a junction and ends free is no outline, nor is what alone joins two parts (a bridge);
3. what then is left falls into blocks that hang together at single corners: a block that is a ring is an outline;
4. of a block with junctions the boundary around all of it is an outline, followed from its lowest place on;
5. what lies within that is looked at once more, and rings are outlines unless they turn off at a junction where
   another edge goes straight on (cells between crossing lines).

The rest is handed back, nothing is dropped.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Collection, Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from math import asin, atan2, copysign, hypot, pi

import numpy as np
import shapely

from skg.geometry.chords import MEASURED, chords_of
from skg.geometry.contour import Contour, CurveNode, Edge
from skg.geometry.plane import XY, cross, distance, dot, minus, turn
from skg.job.read_options import MEET

#: Lines at a smaller angle (its sine) do not go on to where they cross.
_ACROSS = 0.1
#: Shorter edges of one polyline (mm) go into their neighbour: the ROM takes such places for one.
_LEAST = 1e-3
#: Ends of neighbours in one entity lie within this of each other, mm.
_EXACT = 1e-6
#: Directions within this (radians) run straight on.
_STRAIGHT_ON = 0.02
#: An arc whose ends were moved may leave the drawn one by this, mm; else it is bent at its ends alone.
_BENT = 1e-3


@dataclass(frozen=True)
class Join:
    """Ends that were joined: a place between them and the gap, mm; `bridge`: the line that was put in, None where the
    ends were moved, or lines went on to where they cross."""

    place: XY
    width: float
    bridge: Edge | None = None


#: Of each entity how it is drawn: its layer, its type of line.
Styles = Sequence[Hashable]


@dataclass
class Chains:
    """Chains of edges; each edge is in one of them, once.

    `contours`: in the order of the edges, their ends moved to common corners; `rest`: runs of edges at junctions that
    belong to no closed outline; `doubles`: drawn twice, with the edge that each was drawn on; `short`: too short for
    two corners; `joins`: ends that do not meet, but were joined.
    """

    contours: list[Contour] = field(default_factory=list)
    rest: list[Contour] = field(default_factory=list)
    doubles: list[tuple[Edge, Edge]] = field(default_factory=list)
    short: list[Edge] = field(default_factory=list)
    joins: list[Join] = field(default_factory=list)


class _Corners:
    """Ends of edges, those within a tolerance of each other taken as one corner, in their middle."""

    def __init__(self, tolerance: float) -> None:
        self.tolerance = tolerance
        self.cells: dict[tuple[int, int], list[int]] = defaultdict(list)
        self.first: list[XY] = []
        self.members: list[list[XY]] = []

    def index(self, point: XY) -> int:
        """The number of the corner at a point."""
        column, row = (int(ordinate // self.tolerance) for ordinate in point)
        for i in (column, column - 1, column + 1):
            for j in (row, row - 1, row + 1):
                for known in self.cells.get((i, j), ()):
                    if distance(self.first[known], point) <= self.tolerance:
                        self.members[known].append(point)
                        return known
        self.first.append(point)
        self.members.append([point])
        self.cells[column, row].append(len(self.first) - 1)
        return len(self.first) - 1

    def points(self) -> list[XY]:
        """Places of the corners."""
        return [
            (sum(x for x, _ in members) / len(members), sum(y for _, y in members) / len(members))
            for members in self.members
        ]


def moved(edge: Edge, start: XY, end: XY) -> Edge:
    """The edge with its ends moved to given places; it stays where it was as nearly as it can."""
    if (edge.start, edge.end) == (start, end):
        return edge
    if edge.nodes:
        nodes = (CurveNode(start, edge.nodes[0].angle), *edge.nodes[1:-1], CurveNode(end, edge.nodes[-1].angle))
        samples = edge.samples.copy()
        samples[0], samples[-1] = start, end
        return replace(edge, start=start, end=end, nodes=nodes, samples=samples)
    if edge.centre is None or edge.is_circle:
        return replace(edge, start=start, end=end)
    off = max(abs(distance(point, edge.centre) - edge.radius) for point in (start, end))
    if off < 1e-4:
        return replace(edge, start=start, end=end)
    # The centre goes to the nearest place that has the same distance from both ends.
    chord = minus(end, start)
    length = hypot(*chord)
    if length > 0:
        middle = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
        part = dot(minus(middle, edge.centre), chord) / length**2
        centre = edge.centre[0] + part * chord[0], edge.centre[1] + part * chord[1]
        if distance(centre, edge.centre) < _BENT:
            angles = (atan2(*reversed(minus(point, centre))) for point in (start, end))
            sweep = edge.sweep + turn(edge.sweep, turn(*angles))
            return replace(edge, start=start, end=end, centre=centre, sweep=sweep)
    pieces = max(3, int(abs(edge.sweep) / 0.5) + 1)
    curve = [CurveNode(edge.at(k / pieces), edge.direction(k / pieces)) for k in range(pieces + 1)]
    curve[0], curve[-1] = CurveNode(start, curve[0].angle), CurveNode(end, curve[-1].angle)
    fine = max(pieces, chords_of(edge.radius, edge.sweep, MEASURED))
    places = [start, *edge.parted(fine)[1:-1], end]
    return Edge(start, end, nodes=tuple(curve), samples=np.array(places), entity=edge.entity)


def _twin(edge: Edge, others: list[Edge], tolerance: float) -> Edge | None:
    """The edge that one was drawn on, if there is any."""
    for other in others:
        for candidate in (other, other.reversed()):
            if max(distance(edge.start, candidate.start), distance(edge.end, candidate.end)) > tolerance:
                continue
            if edge.nodes or other.nodes:
                # (a curve run through backwards has other samples)
                is_on = _off(edge, other) <= tolerance >= _off(other, edge)
            else:
                is_on = distance(edge.at(0.5), candidate.at(0.5)) <= tolerance
            if is_on:
                return other
    return None


def _off(edge: Edge, other: Edge) -> float:
    """Largest distance of an edge's points from another edge."""
    if other.nodes:
        return float(shapely.distance(shapely.points(edge.points()), shapely.linestrings(other.samples)).max())
    return max(map(other.far, edge.points()))


def chain(edges: Iterable[Edge], tolerance: float, styles: Styles = ()) -> Chains:
    """Return what edges make whose ends meet; ends that nothing meets are joined to the next one within `tolerance`
    (mm), and nothing that is drawn is moved for that.

    `styles`: of each entity how it is drawn; empty where all are drawn alike.
    """
    result, near = Chains(), min(tolerance, MEET)
    loose: list[Edge] = []
    groups: dict[int, list[Edge]] = defaultdict(list)
    for edge in edges:
        groups[edge.entity if edge.entity >= 0 else -1 - len(groups)].append(edge)
    for group in groups.values():
        is_whole = _is_ring(group, near)
        for part in [group] if is_whole else _parts(group):
            kept, short = _without_short(part) if is_whole or _is_ring(part, near) else ([], [])
            if not kept:
                loose += part
                continue
            result.short += short
            result.contours.append(Contour(tuple(kept), True))
    graph = _Graph(loose, near, result)
    if tolerance > near:
        graph.join(tolerance)
    graph.chain(styles)
    result.contours.sort(key=lambda contour: min(edge.entity for edge in contour.edges))
    return result


def chained_again(
    chains: Chains, opened: Iterable[Contour], rest: list[Contour], tolerance: float, styles: Styles
) -> tuple[Chains, bool]:
    """Return the chains in which what was open, or hung together, is what some runs and a rest are now, and whether any
    of that closes."""
    again = chain((edge for contour in opened for edge in contour.edges), tolerance, styles)
    closed = [contour for contour in chains.contours if contour.is_closed]
    merged = Chains(
        sorted(closed + again.contours, key=lambda contour: min(edge.entity for edge in contour.edges)),
        rest + again.rest,
        chains.doubles + again.doubles,
        chains.short + again.short,
        chains.joins + again.joins,
    )
    return merged, any(contour.is_closed for contour in again.contours)


def _parts(group: list[Edge]) -> Iterator[list[Edge]]:
    """The edges of one entity in parts, such as those of a path: each up to a break, or to where it began."""
    part: list[Edge] = []
    for edge in group:
        if part and (distance(part[-1].end, edge.start) > _EXACT or part[-1].end == part[0].start):
            yield part
            part = []
        part.append(edge)
    yield part


def _is_ring(group: list[Edge], tolerance: float) -> bool:
    """Tell whether edges that follow each other close by themselves, around some area."""
    if len(group) == 1:
        edge = group[0]
        return edge.is_circle or (edge.start == edge.end and edge.length > 3 * tolerance)
    following = [*group[1:], group[0]]
    if any(distance(edge.end, other.start) > _EXACT for edge, other in zip(group, following, strict=True)):
        return False
    length = sum(edge.length for edge in group)
    return abs(Contour(tuple(group), True).area) > 0.1 * tolerance * length


def _without_short(group: list[Edge]) -> tuple[list[Edge], list[Edge]]:
    """A ring's edges without those that are too short for the ROM, and these."""
    kept: list[Edge] = []
    short: list[Edge] = []
    for edge in group:
        # (many short ones that follow each other are not short together)
        start = kept[-1].end if kept else group[0].start
        if distance(start, edge.end) < _LEAST and edge.length < 2 * _LEAST:
            short.append(edge)
        else:
            kept.append(moved(edge, start, edge.end))
    if kept and kept[-1].end != kept[0].start:
        kept[-1] = moved(kept[-1], kept[-1].start, kept[0].start)
    return kept, short


#: An edge of the graph by its number, and whether it is run through from its first end to its last.
_Step = tuple[int, bool]


def _middle(one: XY, other: XY) -> XY:
    """The place halfway between two."""
    return (one[0] + other[0]) / 2, (one[1] + other[1]) / 2


def _crossing(one: Edge, other: Edge) -> XY | None:
    """The place near the end of a line and the start of another where the two cross, or would if they went on."""
    if not (one.is_line and other.is_line):
        return None
    way, to = minus(one.end, one.start), minus(other.end, other.start)
    area = cross(way, to)
    if abs(area) < _ACROSS * hypot(*way) * hypot(*to):
        return None
    away = minus(other.start, one.start)
    part, other_part = cross(away, to) / area, cross(away, way) / area
    place = one.at(part)
    far = max(distance(place, one.end), distance(place, other.start))
    return place if part > 0 and other_part < 1 and far <= distance(one.end, other.start) else None


class _Graph:
    """Edges whose ends are corners."""

    def __init__(self, edges: list[Edge], tolerance: float, chains: Chains) -> None:
        self.chains = chains
        corners = _Corners(tolerance)
        self.edges: list[Edge] = []
        self.ends: list[tuple[int, int]] = []
        self.edges_at: dict[int, list[int]] = defaultdict(list)
        known: dict[tuple[int, int], list[Edge]] = defaultdict(list)
        for edge in edges:
            first, last = corners.index(edge.start), corners.index(edge.end)
            alike = known[min(first, last), max(first, last)]
            if first == last and edge.length <= 3 * tolerance:
                chains.short.append(edge)
            elif twin := _twin(edge, alike, tolerance):
                chains.doubles.append((edge, twin))
            elif first == last:
                alike.append(edge)
                chains.contours.append(Contour((moved(edge, edge.start, edge.start),), True))
            else:
                alike.append(edge)
                for corner in (first, last):
                    self.edges_at[corner].append(len(self.edges))
                self.edges.append(edge)
                self.ends.append((first, last))
        corner_places = corners.points()
        #: The places of each edge's ends: their corners, if these are no further than that of two ends.
        self.places = [
            tuple(
                corner_places[corner] if distance(corner_places[corner], end) <= MEET / 2 else end
                for corner, end in zip(corners_of, (edge.start, edge.end), strict=True)
            )
            for edge, corners_of in zip(self.edges, self.ends, strict=True)
        ]

    def join(self, tolerance: float) -> None:
        """Make one corner of each end that nothing meets and the nearest corner within a tolerance, mm."""
        places: dict[int, XY] = {}
        for ends, ends_places in zip(self.ends, self.places, strict=True):
            places.update(zip(ends, ends_places, strict=True))
        free = {corner: numbers[0] for corner, numbers in self.edges_at.items() if len(numbers) == 1}
        if not free:
            return
        corners, loose = np.array(list(places)), np.array(list(free))
        points = shapely.points(list(places.values()))
        ones, others = shapely.STRtree(points).query(
            shapely.points([places[corner] for corner in free]), predicate="dwithin", distance=tolerance
        )
        pairs = zip(loose[ones].tolist(), corners[others].tolist(), strict=True)
        root = {corner: corner for corner in places}

        def of(corner: int) -> int:
            while root[corner] != corner:
                corner = root[corner]
            return corner

        for corner, other in sorted(pairs, key=lambda pair: (distance(places[pair[0]], places[pair[1]]), pair)):
            number = free.get(corner, -1)
            if number < 0 or of(corner) == of(other):
                continue
            # (a short edge is no ring with itself)
            if of(self.other(number, corner)) == of(other) and self.edges[number].length <= 3 * tolerance:
                continue
            root[of(corner)] = of(other)
            free.pop(corner), free.pop(other, None)
        self.ends = [(of(first), of(last)) for first, last in self.ends]
        self.edges_at = defaultdict(list)
        for number, ends in enumerate(self.ends):
            for corner in ends:
                self.edges_at[corner].append(number)

    def other(self, number: int, corner: int) -> int:
        """The corner at an edge's other end."""
        first, last = self.ends[number]
        return last if first == corner else first

    def chain(self, styles: Styles) -> None:
        """Find all contours; `styles`: see `chain`."""
        loops = {number for number, (first, last) in enumerate(self.ends) if first == last}
        self.chains.contours += [self.contour([(number, True)], True) for number in sorted(loops)]
        for part in self.parts(dict.fromkeys(number for number in range(len(self.edges)) if number not in loops)):
            degrees = self.degrees(part)
            if max(degrees.values()) <= 2:
                (run,) = self.runs(part)
                self.chains.contours.append(self.contour(run, 1 not in degrees.values()))
                continue
            own = list(self.rings_of_styles(part, styles)) if styles else []
            rings, rest = self.outlines(part.difference(*own))
            rings += [ring for edges in own for ring in self.runs(edges)]
            self.chains.contours += [self.contour(ring, True) for ring in rings]
            self.chains.rest += [self.contour(run, self.is_closed(run)) for run in self.runs(rest)]

    def is_closed(self, run: list[_Step]) -> bool:
        """Tell whether a run ends where it begins."""
        (first, ahead), (last, goes) = run[0], run[-1]
        return self.ends[first][not ahead] == self.ends[last][goes]

    def contour(self, run: list[_Step], is_closed: bool) -> Contour:
        """A run of edges, their ends moved to where they meet, or joined."""
        steps = [self.edges[number] if ahead else self.edges[number].reversed() for number, ahead in run]
        ends = {}
        if not is_closed:
            # (others that end at a junction end there, too)
            (first, begins), (last, ahead) = run[0], run[-1]
            ends = {0: self.places[first][not begins], len(steps): self.places[last][ahead]}
        bridges: dict[int, Edge] = {}
        for index in range(len(steps) if is_closed else len(steps) - 1):
            following = (index + 1) % len(steps)
            end, start = steps[index].end, steps[following].start
            place: XY | None = _middle(end, start)
            if distance(end, start) > MEET:
                place = _crossing(steps[index], steps[following])
                if place is None:
                    bridges[index] = Edge(end, start, entity=steps[index].entity)
                self.chains.joins.append(Join(_middle(end, start), distance(end, start), bridges.get(index)))
            if place is not None:
                steps[index] = moved(steps[index], steps[index].start, place)
                steps[following] = moved(steps[following], place, steps[following].end)
        if ends:
            steps[0] = moved(steps[0], ends[0], steps[0].end)
            steps[-1] = moved(steps[-1], steps[-1].start, ends[len(steps)])
        edges = [part for index, step in enumerate(steps) for part in (step, bridges.get(index)) if part is not None]
        return Contour(tuple(edges), is_closed)

    def degrees(self, part: Iterable[int]) -> Counter[int]:
        """Count of these edges at each corner."""
        return Counter(corner for number in part for corner in self.ends[number])

    def parts(self, numbers: Collection[int]) -> Iterator[set[int]]:
        """Groups of edges that hang together."""
        seen: set[int] = set()
        for begin in numbers:
            if begin in seen:
                continue
            part, open_ones = {begin}, [begin]
            while open_ones:
                for corner in self.ends[open_ones.pop()]:
                    for number in self.edges_at[corner]:
                        if number not in part and number in numbers:
                            part.add(number)
                            open_ones.append(number)
            seen |= part
            yield part

    def rings_of_styles(self, part: set[int], styles: Styles) -> Iterator[set[int]]:
        """The rings of edges that meet no others drawn as they are; none where all are drawn alike."""
        by_style: dict[Hashable, set[int]] = defaultdict(set)
        for number in part:
            by_style[styles[self.edges[number].entity]].add(number)
        if len(by_style) > 1:
            for alike in by_style.values():
                yield from filter(self.is_ring, self.parts(alike))

    def runs(self, part: Iterable[int]) -> Iterator[list[_Step]]:
        """Edges that follow each other, from where none or more than one other edge meets them to the next such
        place; a ring from its first edge's start on."""
        part = sorted(part)
        degrees = self.degrees(part)
        free = set(part)
        begins = [
            (number, ahead) for number in part for ahead in (True, False) if degrees[self.ends[number][not ahead]] != 2
        ]
        for begin in [*begins, *((number, True) for number in part)]:
            if begin[0] not in free:
                continue
            number, ahead = begin
            run = []
            while True:
                free.discard(number)
                run.append((number, ahead))
                corner = self.ends[number][ahead]
                following = [other for other in self.edges_at[corner] if other in free]
                if degrees[corner] != 2 or not following:
                    break
                number = following[0]
                ahead = self.ends[number][0] == corner
            yield run

    def outlines(self, part: set[int]) -> tuple[list[list[_Step]], set[int]]:
        """The closed outlines of edges with junctions, and what is left."""
        rings: list[list[_Step]] = []
        for block in self.blocks(self.peeled(part)):
            if self.is_ring(block):
                rings += [ring for ring in self.runs(block) if not self.is_cell(ring)]
                continue
            boundary = self.boundary(block)
            if boundary is None:
                continue
            rings.append(boundary)
            inner = block - {number for number, _ in boundary}
            for within in self.blocks(self.peeled(inner)):
                if self.is_ring(within):
                    rings += [ring for ring in self.runs(within) if not self.is_cell(ring)]
        return rings, part - {number for ring in rings for number, _ in ring}

    def is_ring(self, part: set[int]) -> bool:
        """Tell whether edges that hang together are one ring."""
        return all(degree == 2 for degree in self.degrees(part).values())

    def peeled(self, part: set[int]) -> set[int]:
        """Edges without those that end free."""
        part = set(part)
        degrees = self.degrees(part)
        open_ones = [corner for corner, degree in degrees.items() if degree == 1]
        while open_ones:
            corner = open_ones.pop()
            for number in self.edges_at[corner]:
                if number in part:
                    part.discard(number)
                    other = self.other(number, corner)
                    degrees[other] -= 1
                    if degrees[other] == 1:
                        open_ones.append(other)
        return part

    def blocks(self, part: set[int]) -> Iterator[set[int]]:
        """The blocks of more than one edge: edges any two of which lie on a ring. (Hopcroft and Tarjan, 1973.)"""
        number: dict[int, int] = {}
        low: dict[int, int] = {}
        for root in self.degrees(part):
            if root in number:
                continue
            number[root] = low[root] = len(number)
            passed: list[int] = []
            stack = [(root, -1, iter(self.edges_at[root]))]
            while stack:
                corner, came, edges = stack[-1]
                edge = next(edges, None)
                if edge is None:
                    stack.pop()
                    if not stack:
                        continue
                    before = stack[-1][0]
                    low[before] = min(low[before], low[corner])
                    if low[corner] >= number[before]:
                        block: set[int] = set()
                        while came not in block:
                            block.add(passed.pop())
                        if len(block) > 1:
                            yield block
                    continue
                if edge == came or edge not in part:
                    continue
                other = self.other(edge, corner)
                if other not in number:
                    number[other] = low[other] = len(number)
                    passed.append(edge)
                    stack.append((other, edge, iter(self.edges_at[other])))
                elif number[other] < number[corner]:
                    passed.append(edge)
                    low[corner] = min(low[corner], number[other])

    def ahead(self, number: int, corner: int, reach: float) -> float:
        """The direction from a corner to where an edge leaves the circle of radius `reach` around it."""
        edge = self.edges[number] if self.ends[number][0] == corner else self.edges[number].reversed()
        if edge.is_line:
            return edge.direction()
        if edge.centre is not None:
            return edge.direction() + copysign(asin(min(1.0, reach / (2 * edge.radius))), edge.sweep)
        samples = edge.samples
        far = np.hypot(*(samples - edge.start).T)
        # (the first sample that is as far away, else the last one)
        index = 1 + int(np.argmax(far[1:] >= reach)) if far[1:].max() >= reach else len(far) - 1
        part = (reach - far[index - 1]) / (far[index] - far[index - 1]) if far[index] > far[index - 1] else 0.0
        x, y = samples[index - 1] + part * (samples[index] - samples[index - 1]) - edge.start
        return atan2(y, x)

    def boundary(self, block: set[int]) -> list[_Step] | None:
        """The ring around all edges of a block, counter-clockwise; None where they cross so that there is none."""
        lowest = min(((y, x, number, k) for number in block for k, (x, y) in enumerate(self.edges[number].points())))
        number, index = lowest[2:]
        points = self.edges[number].points()
        if 0 < index < len(points) - 1:
            begin = number, points[index + 1][0] > points[index - 1][0]
        else:
            corner = self.ends[number][index > 0]
            begin = self.rightmost([other for other in self.edges_at[corner] if other in block], corner, 0.0)
        run: list[_Step] = []
        seen: set[int] = set()
        step = begin
        while True:
            number, ahead = step
            run.append(step)
            corner = self.ends[number][ahead]
            if corner in seen:
                return None
            seen.add(corner)
            others = [other for other in self.edges_at[corner] if other in block and other != number]
            reach = self.reach([number, *others])
            step = self.rightmost(others, corner, self.ahead(number, corner, reach) + pi, reach)
            if step == begin:
                return run

    def reach(self, edges: list[int]) -> float:
        """Distance along edges at which their directions are compared."""
        chords = (distance(self.edges[number].start, self.edges[number].end) for number in edges)
        return min(1.0, 0.3 * min(chords))

    def rightmost(self, edges: list[int], corner: int, heading: float, reach: float | None = None) -> _Step:
        """The edge that turns most to the right of a heading at a corner."""
        far = self.reach(edges) if reach is None else reach
        number = min(edges, key=lambda other: turn(heading, self.ahead(other, corner, far)))
        return number, self.ends[number][0] == corner

    def is_cell(self, ring: list[_Step]) -> bool:
        """Tell whether a ring turns off at junctions alone, and each time another edge goes straight on."""
        within = {number for number, _ in ring}
        turns = 0
        for (number, ahead), (following, _) in zip(ring, [*ring[1:], ring[0]], strict=True):
            corner = self.ends[number][ahead]
            others = [other for other in self.edges_at[corner] if other not in within]
            reach = self.reach([number, following, *others])
            heading = self.ahead(number, corner, reach) + pi
            if abs(turn(heading, self.ahead(following, corner, reach))) < _STRAIGHT_ON:
                continue
            turns += 1
            if not any(abs(turn(heading, self.ahead(other, corner, reach))) < _STRAIGHT_ON for other in others):
                return False
        return turns > 0


#: Circles whose middles and radii are no further apart are one, as programs write them that turn curves into arcs, mm.
#: (As two, each with places of its own, they may end a micrometre beside where they began)
_SAME = 1e-5


def _merge(edge: Edge, other: Edge) -> Edge | None:
    """Two neighbours as one edge, where they lie on one line or circle and run the same way, else None."""
    if edge.is_line and other.is_line:
        if abs(turn(edge.direction(), other.direction())) < 1e-7:
            return replace(edge, end=other.end)
    elif edge.centre is not None and other.centre is not None:
        sweep = edge.sweep + other.sweep
        is_same = distance(edge.centre, other.centre) < _SAME and abs(edge.radius - other.radius) < _SAME
        if is_same and edge.sweep * other.sweep > 0 and abs(sweep) <= 2 * pi + 1e-6:
            if distance(edge.start, other.end) < 1e-6 and abs(sweep) > pi:
                return replace(edge, end=edge.start, sweep=2 * pi if sweep > 0 else -2 * pi)
            return replace(edge, end=other.end, sweep=sweep)
    return None


def merged(contour: Contour) -> Contour:
    """The contour with neighbours merged where they are the same line or circle."""
    edges: list[Edge] = []
    for edge in contour.edges:
        both = _merge(edges[-1], edge) if edges else None
        if both is None:
            edges.append(edge)
        else:
            edges[-1] = both
    if contour.is_closed and len(edges) > 1:
        both = _merge(edges[-1], edges[0])
        if both is not None:
            edges = [both, *edges[1:-1]]
    return contour if len(edges) == len(contour.edges) else replace(contour, edges=tuple(edges))
