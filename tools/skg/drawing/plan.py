"""Planning: in which order and direction contours are cut, from which start holes, in which passes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import cos, inf, pi, sin
from typing import NamedTuple

import numpy as np

from skg.drawing.contour import Contour, Edge, part_of
from skg.drawing.field import Field, Floats, headings, nearest_order, rows_of
from skg.drawing.parallel import part_between, wire_way
from skg.errors import UserError
from skg.plane import XY, distance, minus, polar, turn
from skg.tape.columns import Flags, directions, hypots

#: Where the wire may run, see `plan`.
SIDES = ("auto", "inside", "outside", "left", "right", "on")
#: A start hole is this far from the contour where there is room, mm.
LEAD = 3.0
#: How many edges of a contour are tried for a start hole with room around it.
_TRIED = 8
#: A start hole has room enough when nothing is nearer than this part of the lead.
_ENOUGH = 0.5
#: A lead that is an arc has a radius of so often R.
_ROOMY = 1.5
#: Edges of so often R are surely there beside the contour.
_SURE = 4.0
#: A start hole that is not a circle's centre is further from that than this part of the radius.
_BESIDE = 0.1
#: A tab that goes around corners ends no nearer to one than this part of the edge there.
_INSIDE = 0.2
#: A contour with a tab is so many times as long as that, or has an edge that is so many times as long.
_LONG, _ROOM = 3, 1.2
#: A lead that is an arc is no smaller, mm; chords of a contour lie inside of it by the rest of this, of the radius.
_LEAST_ARC, _ROUND = 0.05, 0.998
#: Directions (radians) that differ by less go the same way; how far a start hole may stand beside the square to its
#: entry for a lead that is an arc.
_SQUARE = 1e-6


@dataclass(frozen=True)
class Lead:
    """The way between a start hole and the contour: straight, or from the hole to an arc about it, and along that.

    `hole`: where the wire is threaded; `entry`: the place on the contour. `way`: the direction of travel along the
    contour there, radians. `is_arc`: a quarter of a circle about the hole touches the contour at the entry.
    """

    hole: XY
    entry: XY
    way: float
    is_arc: bool

    def arc(self, is_in: bool) -> Edge:
        """The arc that comes to the entry, or that leaves it."""
        aside = turn(self.way, _angle(minus(self.entry, self.hole)))
        sweep = pi / 2 if aside < 0 else -pi / 2
        reach = distance(self.hole, self.entry)
        if is_in:
            return Edge(polar(self.hole, reach, self.way + pi), self.entry, self.hole, sweep)
        return Edge(self.entry, polar(self.hole, reach, self.way), self.hole, sweep)

    def reversed(self) -> Lead:
        """The same lead, for the contour run through backwards."""
        return replace(self, way=self.way + pi)


@dataclass(frozen=True)
class Way:
    """One way of the wire along a contour, or a part of it: edges that follow each other, at one offset.

    `offset` is R for this direction. `into`, `out`: how the wire comes from its start hole and goes to one; without
    them a closed run begins and ends at the start hole of its route (BACK), an open one at its own ends. `stop`: what
    the operator is to do before it, the machine stops for it; empty: nothing. `copies`: see `Contour`.
    """

    edges: tuple[Edge, ...]
    offset: float
    into: Lead | None = None
    out: Lead | None = None
    stop: str = ""
    copies: int = 1

    @property
    def is_closed(self) -> bool:
        """Whether it ends where it began."""
        return distance(self.edges[0].start, self.edges[-1].end) < 1e-9


@dataclass(frozen=True)
class PlannedContour:
    """A contour with where it is entered: from `start` to the point at `part` of its first edge.

    `offset` is R of the last pass: positive, the wire runs on the right of travel. `depth`: how many contours lie
    around it. `passes`: R of each pass, as if all were cut in the contour's direction; every second one is cut
    backwards. `tab`: the length before the entry that stays until the last cut, mm; `tab_hole`: the other start hole.
    `number`: its place among the contours that were planned, from 0. `room`: from the start hole to what is nearest.
    `traced`: the wire's own way in each pass, where the contour has edges that it cannot follow; see `with_wire_ways`.
    `is_cramped`: a lead that is an arc was asked for, and has no room. `is_short`: a tab was asked for, and has none.
    """

    contour: Contour
    start: XY
    part: float
    offset: float
    depth: int
    passes: tuple[float, ...] = ()
    tab: float = 0.0
    tab_hole: XY = (0.0, 0.0)
    is_arc: bool = False
    number: int = 0
    room: float = inf
    traced: tuple[tuple[Edge, ...], ...] = ()
    is_cramped: bool = False
    is_short: bool = False

    @property
    def entry(self) -> XY:
        """Where the contour is entered (on its first edge, without the offset)."""
        return self.contour.edges[0].at(self.part)

    @property
    def is_opening(self) -> bool:
        """Whether it is cut from inside: what falls out is the slug."""
        return self.contour.is_closed and self.depth % 2 == 1

    def chain(self) -> tuple[Edge, ...]:
        """The edges from the entry on; a closed contour's come back to it."""
        return chain_from(self.contour, self.part)

    def runs(self) -> Iterator[Way]:
        """Every way of the wire, in order."""
        edges = self.chain()
        passes = self.passes or (self.offset,)
        if not self.contour.is_closed:
            yield Way(edges, passes[-1])
        elif self.tab:
            yield from self._with_tab(edges, passes)
        else:
            lead = self._lead(self.start, edges[0]) if self.is_arc else None
            for at, r in enumerate(passes):
                falls = "IS" if at == 1 and len(passes) > 1 else ""
                stop = falls and ("TAKE THE SLUG OUT" if self.is_opening else "THE PART IS FREE")
                # (what is repeated would have the lead too)
                copies = 1 if lead or self.part else self.contour.copies
                run = self._way(at, Way(edges, r, lead, lead, stop, copies))
                yield _backwards(run) if at % 2 else run

    def _lead(self, hole: XY, edge: Edge, at_end: bool = False) -> Lead:
        way = edge.direction(1.0 if at_end else 0.0)
        entry = edge.end if at_end else edge.start
        square = abs(cos(_angle(minus(hole, entry)) - way)) < _SQUARE
        return Lead(hole, entry, way, self.is_arc and square)

    def _with_tab(self, edges: tuple[Edge, ...], passes: tuple[float, ...]) -> Iterator[Way]:
        """The passes up to the tab, forth and back, then the tab."""
        main, tab = split_at_end(edges, self.tab)
        into, out = self._lead(self.start, main[0]), self._lead(self.tab_hole, main[-1], True)
        for at, r in enumerate(passes):
            run = self._way(at, Way(main, r, into, out))
            yield _backwards(run) if at % 2 else run
        is_there = len(passes) % 2 == 1
        last = self._way(-1, Way(tab, passes[-1], out, into, "HOLD THE PART, THE NEXT CUT FREES IT"))
        yield last if is_there else _backwards(last)

    def with_wire_ways(self) -> PlannedContour:
        """The same, cut along the wire's own ways; `NoRoom` where there are none (skg.drawing.parallel)."""
        return replace(self, traced=tuple(wire_way(self.contour, r) for r in self.passes))

    def _way(self, at: int, run: Way) -> Way:
        """A run of a pass along the wire's own way, if there are such."""
        if not self.traced:
            return run
        first, last = (
            _beside(place, way, run.offset)
            for place, way in (
                (run.edges[0].start, run.edges[0].direction()),
                (run.edges[-1].end, run.edges[-1].direction(1.0)),
            )
        )
        edges = part_between(self.traced[at], first, None if run.is_closed else last)
        into, out = run.into, run.out
        if into and out:
            into = replace(into, entry=edges[0].start, is_arc=into.is_arc and distance(edges[0].start, first) < _SQUARE)
            out = replace(out, entry=edges[-1].end, is_arc=out.is_arc and distance(edges[-1].end, last) < _SQUARE)
        return replace(run, edges=edges, offset=0.0, into=into, out=out, copies=1)

    def one_by_one(self) -> PlannedContour:
        """The same, every copy with edges of its own in the program."""
        return replace(self, contour=replace(self.contour, copies=1))


def _backwards(run: Way) -> Way:
    edges = tuple(edge.reversed() for edge in reversed(run.edges))
    into, out = (lead and lead.reversed() for lead in (run.out, run.into))
    return Way(edges, -run.offset, into, out, run.stop)


def _beside(place: XY, way: float, r: float) -> XY:
    """The place R to the right of one that is passed in a direction (radians)."""
    return place[0] + r * sin(way), place[1] - r * cos(way)


def _angle(way: XY) -> float:
    return float(np.arctan2(way[1], way[0]))


def chain_from(contour: Contour, part: float) -> tuple[Edge, ...]:
    """A contour's edges from `part` of the first one on; a closed one's come back there."""
    first, *others = contour.edges
    if part == 0:
        return contour.edges
    if first.is_circle:
        place = first.at(part)
        return (replace(first, start=place, end=place),)
    return (part_of(first, part, 1), *others, part_of(first, 0, part))


def split_at_end(edges: tuple[Edge, ...], length: float) -> tuple[tuple[Edge, ...], tuple[Edge, ...]]:
    """The edges up to `length` before their end, and those from there on: no less than that, and cut within an edge.

    A curve is split at the node there, or at the one before it.
    """
    before, tail, left = list(edges), (), length
    while len(before) > 1 and (1 - left / before[-1].length < _INSIDE if tail else left > before[-1].length):
        tail = (before.pop(), *tail)
        left = max(0.0, left - tail[0].length)
    last = before.pop()
    if not last.nodes:
        part = 1 - left / last.length
        part = min(1 - _INSIDE, max(_INSIDE, part)) if tail else part
        return (*before, part_of(last, 0, part)), (part_of(last, part, 1), *tail)
    lengths = np.cumsum([0.0, *last.steps()])
    near = [node_sample(last, at) for at in range(len(last.nodes))]
    at = max((at for at in range(1, len(near) - 1) if lengths[-1] - lengths[near[at]] >= left), default=0)
    if not at:
        return tuple(before), (last, *tail)
    head, rest = split_curve(last, at)
    return (*before, head), (rest, *tail)


def node_sample(edge: Edge, at: int) -> int:
    """The number of the sample at a curve's node."""
    return int(np.argmin(((edge.samples - edge.nodes[at].point) ** 2).sum(1)))


def split_curve(edge: Edge, at: int) -> tuple[Edge, Edge]:
    """A curve as two, the first up to its node number `at`."""
    point, cut = edge.nodes[at].point, node_sample(edge, at)
    head = replace(edge, end=point, nodes=edge.nodes[: at + 1], samples=edge.samples[: cut + 1])
    return head, replace(edge, start=point, nodes=edge.nodes[at:], samples=edge.samples[cut:])


def _oriented(contour: Contour, side: str, depth: int, reverse: bool) -> tuple[Contour, float]:
    """Return the contour in the direction in which it is cut, and the sign of R."""
    if not contour.is_closed:
        sign = {"left": -1.0, "right": 1.0}.get(side, 0.0)
        return (contour.reversed(), -sign) if reverse else (contour, sign)
    # With the wire on the right of travel an outline is cut counter-clockwise and an opening clockwise.
    is_opening = depth % 2 == 1
    if side in ("inside", "outside"):
        is_opening = side == "inside"
    sign = {"on": 0.0, "left": -1.0}.get(side, 1.0)
    if (contour.area < 0) != is_opening:
        contour = contour.reversed()
    if reverse:
        contour, sign = contour.reversed(), -sign
    return contour, sign


def _turned_to(contour: Contour, at: int) -> Contour:
    """The closed contour, beginning with another of its edges."""
    return contour if not at else replace(contour, edges=contour.edges[at:] + contour.edges[:at])


def _entry_near(contour: Contour, start: XY, offset: float) -> tuple[Contour, float]:
    """Begin a closed contour where it is nearest to the start hole, but well inside an edge."""
    best = (inf, 0, 0.0)
    for at, edge in enumerate(contour.edges):
        if edge.nodes:
            continue
        margin = min(0.4, (2 * abs(offset) + 0.05) / edge.length)
        part = edge.nearest(start)
        if not edge.is_circle:
            part = min(1 - margin, max(margin, part))
        # A full circle is entered by a straight radial move; elsewhere any place of the edge will do.
        best = min(best, (distance(edge.at(part), start), at, part))
    if best[0] == inf:
        entry = next(_entries_on_curve(contour))
        return entry.begun(contour), entry.part
    return _turned_to(contour, best[1]), best[2]


class _Entry(NamedTuple):
    """Where a closed contour may begin: at `part` of its edge number `at`, or at a `node` of that edge, a curve."""

    at: int
    part: float = 0.0
    node: int = 0

    def begun(self, contour: Contour) -> Contour:
        """The contour, beginning with the edge of the entry: at its part, at the node."""
        turned = _turned_to(contour, self.at)
        if not self.node:
            return turned
        before, after = split_curve(turned.edges[0], self.node)
        return replace(contour, edges=(after, *turned.edges[1:], before), copies=1)


def _entries_on_curve(contour: Contour) -> Iterator[_Entry]:
    """Begin a contour at nodes inside its longest curve (first, a closed one at its seam)."""
    at = max(range(len(contour.edges)), key=lambda k: contour.edges[k].length)
    edge = contour.edges[at]
    is_smooth = len(contour.edges) == 1 and abs(turn(edge.nodes[0].angle, edge.nodes[-1].angle)) < 1e-3
    inner = {len(edge.nodes) * k // 4 for k in (1, 2, 3)} - {0, len(edge.nodes) - 1}
    if is_smooth or not inner:
        yield _Entry(at)
    for node in sorted(inner, key=lambda k: abs(2 * k - len(edge.nodes))):
        yield _Entry(at, node=node)


def _is_long(contour: Contour, tab: float) -> bool:
    """Whether there is room for a tab that goes around corners."""
    return sum(edge.length for edge in contour.edges) > _LONG * tab


def longest_tab(contour: Contour) -> float:
    """A closed contour has room for a tab that is shorter than this (mm): in an edge, or around corners."""
    lengths = [edge.length for edge in contour.edges]
    return max(max(lengths) / _ROOM, sum(lengths) / _LONG)


def _entries(contour: Contour, tab: float, widest: float) -> Iterator[_Entry]:
    """Where a closed contour may begin: in its longest lines, else in its longest arcs, else on a curve.

    The tab lies before the entry, on the same edge where there is one that is long enough. `widest`: the largest R.
    Copies of a tooth are entered where one of them begins: there the next one goes on.
    """
    if contour.copies > 1 and not tab:
        yield _Entry(0)
    lengths = [edge.length for edge in contour.edges]
    ranked = sorted(
        (at for at, edge in enumerate(contour.edges) if not edge.nodes),
        key=lambda at: (not contour.edges[at].is_line, -lengths[at]),
    )
    fitting = [at for at in ranked if lengths[at] > _ROOM * tab]
    # (a short edge may not be there any more beside the contour)
    sure = [at for at in fitting if lengths[at] > _SURE * widest]
    unsure = [at for at in fitting if lengths[at] <= _SURE * widest]
    yield from _on_edges(contour, sure[:_TRIED], tab)
    if any(edge.nodes and length > _ROOM * tab for edge, length in zip(contour.edges, lengths, strict=True)):
        yield from _entries_on_curve(contour)
    yield from _on_edges(contour, unsure[:_TRIED], tab)
    if not fitting and _is_long(contour, tab):
        for at in ranked[:_TRIED]:
            yield _Entry(at, 0.5)
        if not ranked:
            yield from _entries_on_curve(contour)


def _on_edges(contour: Contour, edges: list[int], tab: float) -> Iterator[_Entry]:
    """Entries in the middle of edges and aside from it, behind a tab."""
    for at in edges:
        edge = contour.edges[at]
        aside = tab / 2 / edge.length
        for part in (0.0, 0.25, 0.5, 0.75) if edge.is_circle else (0.5, 0.3, 0.7):
            part += aside
            if edge.is_circle or part - 2 * aside > 0.05 and part < 0.95:
                yield _Entry(at, part % 1)


@dataclass(frozen=True)
class Method:
    """How contours are cut. `passes`: what each pass leaves to the last offset, mm; see `plan` for the rest."""

    offset: float = 0.0
    side: str = "auto"
    reverse: bool = False
    lead: float = LEAD
    passes: tuple[float, ...] = (0.0,)
    tab: float = 0.0
    is_arc: bool = False


class _Choice:
    """A closed contour whose entry is chosen. `entry`: the one that is tried next, None when all were; `room`: that of
    the best one so far, which `made` has; `reach`: how far the start hole is to be from the contour."""

    def __init__(self, made: PlannedContour, is_outside: bool, reach: float, entries: Iterator[_Entry]) -> None:
        self.made = made
        self.is_outside = is_outside
        self.is_right = is_outside == (made.contour.area > 0)
        self.reach = reach
        self.entries = entries
        self.entry = next(entries, None)
        self.room = -inf
        self.found: tuple[_Entry, float, XY, XY] | None = None

    def take(self, part: float, start: XY, tab_hole: XY, room: float, is_enough: bool) -> None:
        """Keep what was found for the entry if it is the best one, and go on to the next one if it is not enough."""
        if room > self.room:
            self.room, self.found = room, (self.entry, part, start, tab_hole)
        self.entry = None if is_enough else next(self.entries, None)

    def planned(self) -> PlannedContour:
        """The contour as it is entered best."""
        entry, part, start, tab_hole = self.found
        contour = entry.begun(self.made.contour)
        return replace(self.made, contour=contour, start=start, part=part, tab_hole=tab_hole, room=self.room)


class _Planner:
    """Plans contours, each by itself; knows what lies around them. All contours look around together."""

    def __init__(self, contours: list[Contour], method: Method) -> None:
        self.field = Field(contours)
        self.method = method
        self.widest = method.offset + max(method.passes) if method.side != "on" else 0.0

    def plan(
        self, ready: Sequence[tuple[Contour, float]], depths: Sequence[int], given: dict[int, XY]
    ) -> list[PlannedContour]:
        """Plan contours, each with the sign of R; `given`: the start holes that some of them have."""
        done: dict[int, PlannedContour] = {}
        choices: list[_Choice] = []
        method = self.method
        for number, ((contour, sign), depth) in enumerate(zip(ready, depths, strict=True)):
            passes = tuple(sign * (method.offset + more) for more in method.passes)
            start, offset = given.get(number), passes[-1]
            if not contour.is_closed:
                start = start or contour.edges[0].start
                done[number] = PlannedContour(contour, start, 0.0, offset, depth, passes, number=number)
                continue
            is_ccw = contour.area > 0
            is_outside = is_ccw == (sign > 0) if sign else depth % 2 == 0
            tab = method.tab if is_outside else 0.0
            is_short = tab > 0 and tab >= longest_tab(contour)
            made = PlannedContour(
                contour,
                start or (0.0, 0.0),
                0.0,
                offset,
                depth,
                passes,
                0.0 if is_short else tab,
                is_arc=method.is_arc,
                number=number,
                is_short=is_short,
            )
            if start is not None:
                done[number] = self._entered(made, is_outside == is_ccw)
                continue
            choices.append(self._choice(made, is_outside))
        self._choose(choices)
        # (an arc takes more room than a line)
        cramped = [at for at, one in enumerate(choices) if one.made.is_arc and one.room < _ROOMY * self.widest]
        for at in cramped:
            made = replace(choices[at].made, is_arc=False, is_cramped=True)
            choices[at] = self._choice(made, choices[at].is_outside)
        self._choose([choices[at] for at in cramped])
        done |= {choice.made.number: choice.planned() for choice in choices}
        return [done[number] for number in range(len(done))]

    def _choice(self, made: PlannedContour, is_outside: bool) -> _Choice:
        reach = self.method.lead + max(map(abs, made.passes))
        return _Choice(made, is_outside, reach, _entries(made.contour, made.tab, self.widest))

    def _entered(self, made: PlannedContour, is_right: bool) -> PlannedContour:
        """A contour with its start hole, and where it is entered from there."""
        contour, part = _entry_near(made.contour, made.start, max(made.passes, key=abs))
        if not made.tab:
            return replace(made, contour=contour, part=part)
        contour, part = self._tab_before(contour, part)
        end, reach = _before_tab(contour, part, made.tab), distance(made.start, contour.edges[0].at(part))
        one = (np.array([what]) for what in (is_right, reach, made.is_arc))
        ((x, y),) = self._tab_holes([end], *one).tolist()
        return replace(made, contour=contour, part=part, tab_hole=(x, y))

    def _choose(self, choices: Sequence[_Choice]) -> None:
        """Choose the entry with the most room: the first one with enough, else the best one."""
        edges = [choice.made.contour.edges for choice in choices]
        first = np.cumsum([0, *map(len, edges)])
        rows = rows_of([edge for some in edges for edge in some])
        while len(some := np.flatnonzero([choice.entry is not None for choice in choices])):
            tried = [choices[at] for at in some.tolist()]
            at = np.array([choice.entry.at for choice in tried])
            parts = np.array([choice.entry.part for choice in tried])
            self._try(tried, rows[first[some] + at], parts)

    def _try(self, choices: Sequence[_Choice], rows: Floats, parts: Floats) -> None:
        """Try the next entries of contours, at parts of the edges in some rows: find start holes, and how far the
        nearest contour is from these."""
        places, ways = _places(rows, parts)
        for at, choice in enumerate(choices):
            if choice.made.contour.edges[choice.entry.at].nodes:
                edge = choice.entry.begun(choice.made.contour).edges[0]
                places[at], ways[at] = edge.at(0.0), edge.direction()
        is_right = np.array([choice.is_right for choice in choices])
        reach = np.array([choice.reach for choice in choices])
        is_arc = np.array([choice.made.is_arc for choice in choices])
        is_inside = np.array([not choice.is_outside for choice in choices])
        # An opening that is one circle is entered from its centre, on its +X side (language.md, section 4.2).
        circles = np.flatnonzero(_are_circles(rows) & is_inside & ~is_arc)
        central = circles[self._is_clear_from_centre(rows[circles])]
        for at in central.tolist():
            edge = choices[at].made.contour.edges[choices[at].entry.at]
            parts[at] = _part_at(edge, (edge.centre[0] + edge.radius, edge.centre[1]))
            places[at] = edge.at(float(parts[at]))
        starts = rows[:, 4:6].copy()
        others = np.delete(np.arange(len(choices)), central)
        starts[others] = self._holes(*(some[others] for some in (places, ways, rows, is_right, reach, is_arc)))
        far = hypots(*(starts - places).T)
        # How far the nearest contour is from the start holes.
        around = 2 * far + 1e-3
        room = self.field.near(starts, around)
        tab_holes = np.zeros((len(choices), 2))
        tabs = [at for at, choice in enumerate(choices) if choice.made.tab]
        if tabs:
            begun = [(choices[at].made, choices[at].entry, float(parts[at])) for at in tabs]
            ends = [_before_tab(entry.begun(made.contour), part, made.tab) for made, entry, part in begun]
            # The start hole at the other side of the tab is as far from the contour as the first one.
            tab_holes[tabs] = self._tab_holes(ends, is_right[tabs], far[tabs], is_arc[tabs])
            room[tabs] = np.minimum(room[tabs], self.field.near(tab_holes[tabs], around[tabs]))
        is_centre = (rows[:, 8] != 0) & (starts == rows[:, 4:6]).all(1)
        is_enough = (room >= _ENOUGH * reach) | is_centre
        found = (some.tolist() for some in (parts, starts, tab_holes, room, is_enough))
        for choice, part, start, tab_hole, space, enough in zip(choices, *found, strict=True):
            choice.take(part, tuple(start), tuple(tab_hole), space, enough)

    def _tab_holes(self, edges: Sequence[Edge], is_right: Flags, reach: Floats, is_arc: Flags) -> Floats:
        """The start holes at the other sides of tabs, which begin where some edges end."""
        rows = rows_of(edges)
        places, ways = _places(rows, np.ones(len(edges)))
        for at, edge in enumerate(edges):
            if edge.nodes:
                places[at], ways[at] = edge.at(1.0), edge.direction(1.0)
        return self._holes(places, ways, rows, is_right, reach, is_arc)

    def _tab_before(self, contour: Contour, part: float) -> tuple[Contour, float]:
        edge = contour.edges[0]
        aside = self.method.tab / edge.length
        if edge.is_circle:
            return contour, part
        if aside > 0.8 and _is_long(contour, self.method.tab):
            return contour, part
        if aside > 0.8:
            x, y = edge.start
            raise UserError(
                f"the edge from ({x:.3f}, {y:.3f}), which the start hole is at, has no room for a tab of "
                f"{self.method.tab:g} mm: a shorter --tab, or another start hole"
            )
        return contour, min(0.95, max(part, aside + 0.05))

    def _holes(
        self, places: Floats, ways: Floats, rows: Floats, is_right: Flags, reach: Floats, is_arc: Flags
    ) -> Floats:
        """Start holes square to the ways at places on edges (in rows), on the wire's side: `reach` away, or in the
        middle of the room there is."""
        square = headings(np.where(is_right, ways - pi / 2, ways + pi / 2))
        # An arc's own chords lie up to 0.1 % of its radius inside of it.
        least = np.where(rows[:, 8] != 0, 1e-3 * (1 + rows[:, 6]), 1e-3)
        reach = np.minimum(reach, self.field.ahead(places, square, 2 * reach + least, least) / 2)
        reach = self._clear(places, square, reach)
        central = hypots(*(places + reach[:, None] * square - rows[:, 4:6]).T) < _BESIDE * rows[:, 6]
        # (from the centre the ROM would go to the +X side)
        reach[central & _are_circles(rows)] *= 1 - _BESIDE
        tight = np.flatnonzero(is_arc & (reach > _LEAST_ARC))
        while len(tight):
            # (the quarters of the circle to the contour and from it must be free)
            near = self.field.near(places[tight] + reach[tight, None] * square[tight], reach[tight])
            tight = tight[near < _ROUND * reach[tight]]
            reach[tight] *= 0.8
            tight = tight[reach[tight] > _LEAST_ARC]
        return places + reach[:, None] * square

    def _is_clear_from_centre(self, circles: Floats) -> Flags:
        """Whether the wire gets from circles' centres to their +X sides and cuts nothing that lies in the circle."""
        r, radius = self.widest, circles[:, 6]
        ways, wide = np.tile((1.0, 0.0), (len(circles), 1)), np.full(len(circles), max(_ROUND * r, 1e-3))
        # (not as far as the circle itself)
        reach = np.maximum(0.0, _ROUND * radius - r)
        return self.field.before(circles[:, 4:6], ways, reach, np.zeros(len(circles)), wide) == inf

    def _clear(self, places: Floats, square: Floats, reach: Floats) -> Floats:
        """How far the wire gets away from entries: all the way it stays R off what it does not cut there."""
        r = self.widest
        some = np.flatnonzero(reach > r) if r else np.empty(0, int)
        least, wide = np.full(len(some), r), np.full(len(some), _ROUND * r)
        far = self.field.before(places[some], square[some], reach[some], least, wide)
        # (halfway to where it is no longer free)
        found = reach.copy()
        found[some] = np.where(far == inf, reach[some], (r + far) / 2)
        return found


def _are_circles(rows: Floats) -> Flags:
    """Which of the edges in rows are whole circles, as `Piece.is_circle` has it."""
    return np.abs(rows[:, 8]) > 2 * pi - 1e-9


def _places(rows: Floats, parts: Floats) -> tuple[Floats, Floats]:
    """The places at parts of the lengths of lines and arcs (n, 2), and the direction angles there: as `Piece.at` and
    `Piece.direction` have them."""
    sides = rows[:, 2:4] - rows[:, 0:2]
    places, ways = rows[:, 0:2] + parts[:, None] * sides, directions(sides)
    arcs = np.flatnonzero(rows[:, 8])
    radius, first, sweep = rows[arcs, 6:].T
    angles = first + parts[arcs] * sweep
    places[arcs] = rows[arcs, 4:6] + radius[:, None] * headings(angles)
    ways[arcs] = angles + np.copysign(pi / 2, sweep)
    return places, ways


def _before_tab(contour: Contour, part: float, tab: float) -> Edge:
    """The edge that ends where the tab begins, of a contour that is entered at `part` of its first edge."""
    return split_at_end(chain_from(contour, part), tab)[0][-1]


def _part_at(edge: Edge, place: XY) -> float:
    part = edge.nearest(place)
    return 0.0 if distance(place, edge.start) < 1e-9 else part


def plan(
    contours: list[Contour],
    starts: Sequence[XY],
    offset: float,
    side: str,
    reverse: bool = False,
    lead: float = LEAD,
    *,
    passes: tuple[float, ...] = (0.0,),
    tab: float = 0.0,
    arc: bool = False,
) -> list[PlannedContour]:
    """Return the contours in the order in which they are cut: inner ones first, and then the nearest.

    Each start hole goes to the innermost contour around it that is cut from inside, else to the nearest one. `passes`:
    what each pass leaves to `offset`, mm. `tab`: the bridge that keeps a part cut from outside, mm. `arc`: the wire
    comes to the contour along an arc.
    """
    method = Method(offset, side, reverse, lead, passes, tab, arc)
    planner = _Planner(contours, method)
    depths = planner.field.depths()
    ready = [_oriented(one, side, depth, reverse) for one, depth in zip(contours, depths, strict=True)]
    given = _given_starts(planner.field, depths, list(starts))
    return _ordered(planner.plan(ready, depths, given))


def _ordered(routes: list[PlannedContour]) -> list[PlannedContour]:
    """Inner routes before those around them, then the nearest next."""
    places = np.array([route.start for route in routes], float).reshape(-1, 2)
    depths = np.array([route.depth for route in routes], int)
    ordered: list[PlannedContour] = []
    at_now = 0.0, 0.0
    for depth in sorted(set(depths.tolist()), reverse=True):
        some = np.flatnonzero(depths == depth)
        ordered += [routes[at] for at in some[nearest_order(places[some], at_now)].tolist()]
        at_now = ordered[-1].start
    return ordered


def _given_starts(field: Field, depths: list[int], starts: list[XY]) -> dict[int, XY]:
    """Which contour (by its number) each given start hole belongs to."""
    found: dict[int, XY] = {}
    if len(starts) > len(depths):
        raise UserError(f"{len(starts)} start holes for {len(depths)} contours")
    for start, holding in zip(starts, field.around(starts), strict=True):
        around = [at for at in holding if at not in found and depths[at] % 2]
        chosen = max(around, key=depths.__getitem__) if around else field.nearest(start, found)
        found[chosen] = start
    return found
