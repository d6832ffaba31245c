"""A planned contour with its start hole, entry, passes and tab, and the ways of the wire that cut it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from math import cos, inf, pi, sin

import numpy as np
import shapely

from skg.geometry.chords import CUT, chords_of
from skg.geometry.contour import Contour, Edge, part_of
from skg.geometry.offset import part_between, roomy_place, wire_way
from skg.geometry.plane import XY, distance, minus, polar, turn
from skg.messages.finding import Phrase
from skg.planning.loops import Trim
from skg.planning.nesting import Around

#: A tab that goes around corners ends no nearer to one than this part of the edge there.
_INSIDE = 0.2
#: Directions (radians) that differ by less go the same way; how far a start hole may stand beside the square to its
#: entry for a lead that is an arc.
_SQUARE = 1e-6


def kind_of(kind: str, count: int = 1) -> Phrase:
    """The noun for some contours of a kind."""
    return Phrase(f"kind-{kind.replace(' ', '-')}", count=count)


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
    the operator is to do before it, the machine stops for it; empty: nothing.
    """

    edges: tuple[Edge, ...]
    offset: float
    into: Lead | None = None
    out: Lead | None = None
    stop: str = ""

    @property
    def is_closed(self) -> bool:
        """Tell whether it ends where it began."""
        return distance(self.edges[0].start, self.edges[-1].end) < 1e-9


@dataclass(frozen=True)
class PlannedContour:
    """A contour with where it is entered: from `start` to the point at `part` of its first edge.

    `offset` is R of the last pass: positive, the wire runs on the right of travel. `depth`: how many contours lie
    around it. `passes`: R of each pass, as if all were cut in the contour's direction; every second one is cut
    backwards. `tab`: the length before the entry that stays until the last cut, mm; `tab_hole`: the other start hole.
    `number`: its place among the contours that were read, from 0; `turn`: in the order of cutting, from 1. `room`: from
    the start hole to what is nearest.
    `traced`: the wire's own way in each pass, where the contour has edges that it cannot follow, or the controller does
    not; see `with_wire_ways` and `in_chords`.
    `is_moved`: they are entered where they are nearest to the start hole.
    `is_around`: they are there for tips alone, which the wire goes around.
    `has_fillets`: arcs between lines are written as radii of fillets, where these make them.
    `around`: what lies around it and is not cut.
    `is_cramped`: a lead that is an arc was asked for, and has no room. `is_short`: a tab was asked for, and has none.
    `loops`, `whiskers`: where the drawing has some that are not in the contour; see `tidied`.
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
    turn: int = 0
    room: float = inf
    traced: tuple[tuple[Edge, ...], ...] = ()
    is_moved: bool = False
    is_cramped: bool = False
    is_around: bool = False
    is_short: bool = False
    loops: tuple[Trim, ...] = ()
    whiskers: tuple[Trim, ...] = ()
    has_fillets: bool = True
    around: Around | None = None

    @property
    def entry(self) -> XY:
        """Place of entry on the contour (on its first edge, without the offset)."""
        return self.contour.edges[0].at(self.part)

    @property
    def widest(self) -> float:
        """R of the pass that is furthest aside, mm."""
        return max(self.passes, key=abs)

    @property
    def is_square(self) -> bool:
        """Tell whether the start hole stands square to the entry: a lead that is an arc touches the contour only
        then."""
        edge = self.chain[0]
        return _is_square(self.start, edge.start, edge.direction())

    @property
    def is_opening(self) -> bool:
        """Tell whether it is cut from inside: what falls out is the slug."""
        return self.contour.is_closed and self.depth % 2 == 1

    @property
    def kind(self) -> str:
        """Its name: outline, opening or open contour."""
        if not self.contour.is_closed:
            return "open contour"
        return "opening" if self.is_opening else "outline"

    @property
    def name(self) -> Phrase:
        """Its name in a message: number in the order of cutting, kind, beginning, layers."""
        layers = Phrase("on-layers", layers=tuple(self.contour.layers)) if self.contour.layers else None
        start = self.contour.edges[0].start
        return Phrase("contour-name", turn=self.turn, kind=kind_of(self.kind), start=start, layers=layers)

    @property
    def is_outside(self) -> bool:
        """Tell whether the wire runs outside of it, with an R that is not 0."""
        return (self.contour.area > 0) == (self.widest > 0)

    @cached_property
    def chain(self) -> tuple[Edge, ...]:
        """The edges from the entry on; a closed contour's come back to it."""
        return chain_from(self.contour, self.part)

    def runs(self) -> Iterator[Way]:
        """Every way of the wire, in order."""
        edges = self.chain
        passes = self.passes or (self.offset,)
        if not self.contour.is_closed:
            yield Way(edges, passes[-1])
        elif self.tab:
            yield from self._with_tab(edges, passes)
        else:
            lead = self._lead(self.start, edges[0]) if self.is_arc else None
            for index, r in enumerate(passes):
                falls = "IS" if index == 1 and len(passes) > 1 else ""
                stop = falls and ("TAKE THE SLUG OUT" if self.is_opening else "THE PART IS FREE")
                run = self._way(index, Way(edges, r, lead, lead, stop))
                yield _backwards(run) if index % 2 else run

    def _lead(self, hole: XY, edge: Edge, at_end: bool = False) -> Lead:
        direction = edge.direction(1.0 if at_end else 0.0)
        entry = edge.end if at_end else edge.start
        return Lead(hole, entry, direction, self.is_arc and _is_square(hole, entry, direction))

    def _with_tab(self, edges: tuple[Edge, ...], passes: tuple[float, ...]) -> Iterator[Way]:
        """The passes up to the tab, forth and back, then the tab."""
        main, tab = split_at_end(edges, self.tab)
        into, out = self._lead(self.start, main[0]), self._lead(self.tab_hole, main[-1], True)
        for index, r in enumerate(passes):
            run = self._way(index, Way(main, r, into, out))
            yield _backwards(run) if index % 2 else run
        is_there = len(passes) % 2 == 1
        last = self._way(-1, Way(tab, passes[-1], out, into, "HOLD THE PART, THE NEXT CUT FREES IT"))
        yield last if is_there else _backwards(last)

    def with_wire_ways(self) -> PlannedContour:
        """The same, cut along the wire's own ways; `NoRoom` where there are none (skg.geometry.offset)."""
        traced = self._wire_ways
        result = replace(self, traced=traced)
        if self.is_outside or self.room == inf:
            return result
        # (a start hole that was chosen, square to the contour, may be where the wire does not come to)
        place = roomy_place(traced[self.passes.index(self.widest)], self.start)
        return result if place == self.start else replace(result, start=place, is_moved=True)

    @cached_property
    def _wire_ways(self) -> tuple[tuple[Edge, ...], ...]:
        return tuple(wire_way(self.contour, r) for r in self.passes)

    def in_chords(self) -> PlannedContour:
        """The same without an offset, cut along chords of its arcs and curves: a controller may end an arc too early or
        too late by more than may be, a line never."""
        edges = tuple(chord for edge in self.contour.edges for chord in _chords(edge))
        return replace(self, traced=(edges,) * len(self.passes))

    def _way(self, index: int, run: Way) -> Way:
        """A run of a pass along the wire's own way, if there are such."""
        if not self.traced:
            return run
        first, last = (
            _beside(place, direction, run.offset)
            for place, direction in (
                (run.edges[0].start, run.edges[0].direction()),
                (run.edges[-1].end, run.edges[-1].direction(1.0)),
            )
        )
        edges = part_between(
            self.traced[index], self.start if self.is_moved else first, None if run.is_closed else last
        )
        into, out = run.into, run.out
        if into and out:
            into = replace(into, entry=edges[0].start, is_arc=into.is_arc and distance(edges[0].start, first) < _SQUARE)
            out = replace(out, entry=edges[-1].end, is_arc=out.is_arc and distance(edges[-1].end, last) < _SQUARE)
        return replace(run, edges=edges, offset=0.0, into=into, out=out)


def _chords(edge: Edge) -> list[Edge]:
    """An arc or a curve as chords."""
    if edge.is_line:
        return [edge]
    if edge.nodes:
        line = shapely.LineString(edge.samples).simplify(CUT)
        return [Edge(start, end, entity=edge.entity) for start, end in pairwise(line.coords)]
    places = edge.parted(chords_of(edge.radius, edge.sweep, CUT))
    return [Edge(start, end, entity=edge.entity) for start, end in pairwise(places)]


def _backwards(run: Way) -> Way:
    edges = tuple(edge.reversed() for edge in reversed(run.edges))
    into, out = (lead and lead.reversed() for lead in (run.out, run.into))
    return Way(edges, -run.offset, into, out, run.stop)


def _beside(place: XY, direction: float, r: float) -> XY:
    """The place R to the right of one that is passed in a direction (radians)."""
    return place[0] + r * sin(direction), place[1] - r * cos(direction)


def _is_square(hole: XY, entry: XY, direction: float) -> bool:
    """Tell whether a hole stands square to a place that is passed in a direction (radians)."""
    return abs(cos(_angle(minus(hole, entry)) - direction)) < _SQUARE


def _angle(vector: XY) -> float:
    return float(np.arctan2(vector[1], vector[0]))


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
    near = [node_sample(last, index) for index in range(len(last.nodes))]
    index = max((index for index in range(1, len(near) - 1) if lengths[-1] - lengths[near[index]] >= left), default=0)
    if not index:
        return tuple(before), (last, *tail)
    head, rest = split_curve(last, index)
    return (*before, head), (rest, *tail)


def node_sample(edge: Edge, index: int) -> int:
    """The number of the sample at a curve's node."""
    return int(np.argmin(((edge.samples - edge.nodes[index].point) ** 2).sum(1)))


def split_curve(edge: Edge, index: int) -> tuple[Edge, Edge]:
    """A curve as two, the first up to its node number `index`."""
    point, cut = edge.nodes[index].point, node_sample(edge, index)
    head = replace(edge, end=point, nodes=edge.nodes[: index + 1], samples=edge.samples[: cut + 1])
    return head, replace(edge, start=point, nodes=edge.nodes[index:], samples=edge.samples[cut:])
