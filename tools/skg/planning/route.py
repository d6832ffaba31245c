"""A planned contour with its start hole, entry, passes and tabs, and the ways of the wire that cut it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from math import cos, inf, pi, sin
from typing import NamedTuple

import numpy as np
import shapely

from skg.geometry.chords import CUT, chords_of
from skg.geometry.contour import Contour, Edge, part_of
from skg.geometry.offset import NoRoom, part_between, roomy_place, wire_way
from skg.geometry.plane import XY, distance, minus, polar, turn
from skg.messages.finding import Phrase
from skg.planning.loops import Trim
from skg.planning.nesting import Around

#: A tab that goes around corners ends no nearer to one than this part of the edge there.
_INSIDE = 0.2
#: Directions (radians) that differ by less go the same way; how far a start hole may stand beside the square to its
#: entry for a lead that is an arc.
_SQUARE = 1e-6
#: What is shorter is no edge, mm.
_NOTHING = 1e-6


def kind_of(kind: str, count: int = 1) -> Phrase:
    """The noun for some contours of a kind."""
    return Phrase(f"kind-{kind.replace(' ', '-')}", count=count)


@dataclass(frozen=True)
class Lead:
    """The way between a start hole and the contour: straight, or from the hole to an arc about it, and along that.

    `hole`: where the wire is threaded; `entry`: the place on the contour. `way`: the direction of travel along the
    contour there, radians. `is_arc`: a quarter of a circle about the hole touches the contour at the entry. `home`:
    the wire is threaded there instead, and goes straight to the hole, None: in the hole.
    """

    hole: XY
    entry: XY
    way: float
    is_arc: bool
    home: XY | None = None

    @property
    def threaded(self) -> XY:
        """The place where the wire is threaded."""
        return self.home or self.hole

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

    def moved(self, entry: XY, way: float) -> Lead:
        """The lead to another entry, passed in a direction (radians), from a hole that lies beside it likewise."""
        aside = _angle(minus(self.hole, self.entry)) - self.way
        hole = polar(entry, distance(self.hole, self.entry), way + aside)
        return Lead(hole, entry, way, self.is_arc, self.threaded)


@dataclass(frozen=True)
class Way:
    """One way of the wire along a contour, or a part of it: edges that follow each other, at one offset.

    `offset` is R for this direction; `number`: of the pass, among the contour's `offsets`. `into`, `out`: how the wire
    comes from its start hole and goes to one; without them a closed run begins and ends at the start hole of its route
    (BACK), an open one at its own ends. `stop`: what the operator is to do before it, the machine stops for it; empty:
    nothing.
    """

    edges: tuple[Edge, ...]
    offset: float
    number: int = 0
    into: Lead | None = None
    out: Lead | None = None
    stop: str = ""

    @property
    def is_closed(self) -> bool:
        """Tell whether it ends where it began."""
        return distance(self.edges[0].start, self.edges[-1].end) < 1e-9


class Tab(NamedTuple):
    """A bridge between contour and stock. `end`: where it ends, mm along the contour from its entry, infinite: at the
    entry again; `before`, `behind`: the start holes on its two sides, in the contour's direction."""

    end: float
    before: XY
    behind: XY


@dataclass(frozen=True)
class PlannedContour:
    """A contour with where it is entered: from `start` to the point at `part` of its first edge.

    `offset` is R of the last pass: positive, the wire runs on the right of travel. `depth`: how many contours lie
    around it. `passes`: R of each pass, as if all were cut in the contour's direction; every second one is cut
    backwards. `tab`: the length of each of the `tabs`, mm, which stay until the last cuts, the last one before the
    entry; `tab_passes`: R of the cuts of a tab, likewise. `overlap`: closed cuts go on past their end by this, those of
    tabs at both ends, mm.
    `number`: its place among the contours that were read, from 0; `turn`: in the order of cutting, from 1. `room`: from
    the start hole to what is nearest.
    `traced`: the wire's own way in each pass, where the contour has edges that it cannot follow, or the controller does
    not; see `with_wire_ways` and `in_chords`.
    `is_moved`: they are entered where they are nearest to the start hole.
    `is_around`: they are there for tips alone, which the wire goes around.
    `has_fillets`: arcs between lines are written as radii of fillets, where these make them.
    `around`: what lies around it and is not cut.
    `is_cramped`: a lead that is an arc was asked for, and has no room. `fits`: the longest tab that does, mm, where a
    longer one was asked for.
    `loops`, `whiskers`: where the drawing has some that are not in the contour; see `tidied`.
    """

    contour: Contour
    start: XY
    part: float
    offset: float
    depth: int
    passes: tuple[float, ...] = ()
    tab: float = 0.0
    tabs: tuple[Tab, ...] = ()
    tab_passes: tuple[float, ...] = ()
    overlap: float = 0.0
    is_arc: bool = False
    number: int = 0
    turn: int = 0
    room: float = inf
    traced: tuple[tuple[Edge, ...], ...] = ()
    is_moved: bool = False
    is_cramped: bool = False
    is_around: bool = False
    fits: float | None = None
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
    def offsets(self) -> tuple[float, ...]:
        """R of each pass, and then of each cut of a tab, mm."""
        return (*self.passes, *self.tab_passes) if self.tabs else self.passes

    @property
    def proud(self) -> float:
        """Height that is left where the tabs were, mm."""
        return abs(self.tab_passes[-1]) - abs(self.passes[-1]) if self.tabs else 0.0

    @property
    def holes(self) -> tuple[XY, ...]:
        """The start holes to be drilled."""
        return (self.start, *(tab.behind for tab in self.tabs[:-1]))

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

    @property
    def frees(self) -> str:
        """The name of what its last cut frees: the part, or the slug."""
        is_outside = self.is_outside if self.widest else not self.is_opening
        return "part" if is_outside else "slug"

    @cached_property
    def chain(self) -> tuple[Edge, ...]:
        """The edges from the entry on; a closed contour's come back to it."""
        return chain_from(self.contour, self.part)

    @cached_property
    def spans(self) -> tuple[tuple[tuple[Edge, ...], tuple[Edge, ...]], ...]:
        """The edges up to each tab, and those of the tab."""
        rest, spans = self.chain, []
        for number, tab in reversed(list(enumerate(self.tabs))):
            if tab.end < inf:
                rest = split_at(rest, tab.end)[0]
            before, bridge = split_at_end(rest, self.tab)
            begin = self.tabs[number - 1].end if number else 0.0
            spans.append((split_at(before, begin)[1] if number else before, bridge))
        return tuple(reversed(spans))

    @property
    def parts(self) -> tuple[tuple[Edge, ...], ...]:
        """The edges in order: those up to a tab, those of the tab, and so on."""
        return tuple(part for span in self.spans for part in span) if self.tabs else (self.chain,)

    def runs(self) -> Iterator[Way]:
        """Every way of the wire, in order."""
        passes = self.passes or (self.offset,)
        if not self.contour.is_closed:
            yield Way(self.chain, passes[-1])
        elif self.tabs:
            yield from self._up_to_tabs()
            yield from self._along_tabs()
        else:
            for index, r in enumerate(passes):
                falls = "IS" if index == 1 and len(passes) > 1 else ""
                stop = falls and ("TAKE THE SLUG OUT" if self.is_opening else "THE PART IS FREE")
                run = self._around(Way(self.chain, r, index, stop=stop))
                yield _backwards(run) if index % 2 else run

    def _around(self, run: Way) -> Way:
        """A way all around, with its leads, and past its end by the overlap."""
        if self.is_arc or self.overlap:
            lead = self._lead(self.start, run.edges[0])
            run = replace(run, into=lead, out=lead)
        run = self._way(run)
        if not self.overlap:
            return run
        more = _beginning(run.edges, self.overlap)
        out = run.out.moved(more[-1].end, more[-1].direction(1.0))
        return replace(run, edges=(*run.edges, *more), out=out)

    def _lead(self, hole: XY, edge: Edge, at_end: bool = False) -> Lead:
        direction = edge.direction(1.0 if at_end else 0.0)
        entry = edge.end if at_end else edge.start
        is_arc = self.is_arc and _is_square(hole, entry, direction)
        if is_arc and self.tabs and (radius := arc_beside(self.tab, self.widest)) < distance(hole, entry):
            # (the arcs on its two sides come over the tab)
            return Lead(polar(entry, radius, _angle(minus(hole, entry))), entry, direction, True, hole)
        return Lead(hole, entry, direction, is_arc)

    def _up_to_tabs(self) -> Iterator[Way]:
        """The passes up to each tab, forth and back."""
        for (edges, _), hole, tab in zip(self.spans, self.holes, self.tabs, strict=True):
            into, out = self._lead(hole, edges[0]), self._lead(tab.before, edges[-1], True)
            for index, r in enumerate(self.passes):
                stop = "GO TO THE NEXT START HOLE" if not index and hole != self.start else ""
                run = self._way(Way(edges, r, index, into, out))
                yield replace(_backwards(run) if index % 2 else run, stop=stop)

    @property
    def tab_order(self) -> list[int]:
        """The tabs, by their numbers, in the order in which they are cut: from the one that the wire has come to on."""
        count = len(self.tabs)
        return [(turn - 1 if len(self.passes) % 2 else -2 - turn) % count for turn in range(count)]

    def _along_tabs(self) -> Iterator[Way]:
        """The cuts of the tabs."""
        count, is_before = len(self.tabs), len(self.passes) % 2 == 1
        for cut, number in enumerate(self.tab_order, 1):
            (before, edges), (behind, _) = self.spans[number], self.spans[(number + 1) % count]
            into = self._lead(self.tabs[number].before, before[-1], True)
            out = self._lead(self.holes[(number + 1) % count], behind[0])
            if self.overlap:
                early = _reversed(_beginning(_reversed(before), self.overlap))
                late = _beginning(behind, self.overlap)
                edges = (*early, *edges, *late)
                into = into.moved(early[0].start, early[0].direction())
                out = out.moved(late[-1].end, late[-1].direction(1.0))
            for index, r in enumerate(self.tab_passes):
                stop = ""
                if not index:
                    hold = f"HOLD THE {self.frees.upper()}, THE NEXT CUT FREES IT"
                    stop = hold if cut == count else "GO TO THE NEXT TAB"
                elif index == 1 and cut == count and self.frees == "slug":
                    stop = "TAKE THE SLUG OUT"
                run = self._way(Way(edges, r, len(self.passes) + index, into, out))
                yield replace(run if is_before == (index % 2 == 0) else _backwards(run), stop=stop)

    def with_wire_ways(self) -> PlannedContour:
        """The same, cut along the wire's own ways; `NoRoom` where there are none (skg.geometry.offset)."""
        traced = self._wire_ways
        result = replace(self, traced=traced)
        if self.tabs:
            list(result.runs())  # (`NoRoom` where the wire does not come to a tab)
            return result
        if self.is_outside or self.room == inf:
            return result
        # (a start hole that was chosen, square to the contour, may be where the wire does not come to)
        place = roomy_place(traced[self.passes.index(self.widest)], self.start)
        return result if place == self.start else replace(result, start=place, is_moved=True)

    @cached_property
    def _wire_ways(self) -> tuple[tuple[Edge, ...], ...]:
        return tuple(wire_way(self.contour, r) for r in self.offsets)

    def in_chords(self) -> PlannedContour:
        """The same without an offset, cut along chords of its arcs and curves: a controller may end an arc too early or
        too late by more than may be, a line never."""
        edges = tuple(chord for edge in self.contour.edges for chord in _chords(edge))
        return replace(self, traced=(edges,) * len(self.offsets))

    def _way(self, run: Way) -> Way:
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
            self.traced[run.number], self.start if self.is_moved else first, None if run.is_closed else last
        )
        if not edges:
            raise NoRoom(run.edges[0].start, "room-over-tab", is_crossing=True)
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
    edges = _reversed(run.edges)
    into, out = (lead and lead.reversed() for lead in (run.out, run.into))
    return Way(edges, -run.offset, run.number, into, out, run.stop)


def _reversed(edges: tuple[Edge, ...]) -> tuple[Edge, ...]:
    return tuple(edge.reversed() for edge in reversed(edges))


def _beside(place: XY, direction: float, r: float) -> XY:
    """The place R to the right of one that is passed in a direction (radians)."""
    return place[0] + r * sin(direction), place[1] - r * cos(direction)


def _is_square(hole: XY, entry: XY, direction: float) -> bool:
    """Tell whether a hole stands square to a place that is passed in a direction (radians)."""
    return abs(cos(_angle(minus(hole, entry)) - direction)) < _SQUARE


def _angle(vector: XY) -> float:
    return float(np.arctan2(vector[1], vector[0]))


def arc_beside(tab: float, r: float) -> float:
    """The radius of the arcs that lead to the contour at the two ends of a tab, mm: between the arcs is left half of
    what straight leads leave, with a wire R beside."""
    return (tab - 2 * abs(r)) / 4


def chain_from(contour: Contour, part: float) -> tuple[Edge, ...]:
    """A contour's edges from `part` of the first one on; a closed one's come back there."""
    first, *others = contour.edges
    if part == 0:
        return contour.edges
    if first.is_circle:
        place = first.at(part)
        return (replace(first, start=place, end=place),)
    return (part_of(first, part, 1), *others, part_of(first, 0, part))


def split_at(edges: tuple[Edge, ...], length: float) -> tuple[tuple[Edge, ...], tuple[Edge, ...]]:
    """The edges up to a length along them, mm, and those from there on; a curve is split at the inner node next to it,
    or behind it where there is none."""
    for index, edge in enumerate(edges):
        if length > edge.length and index + 1 < len(edges):
            length -= edge.length
            continue
        if edge.nodes:
            lengths = np.cumsum([0.0, *edge.steps()])
            off = [abs(lengths[node_sample(edge, node)] - length) for node in range(len(edge.nodes))]
            node = int(np.argmin(off[1:-1])) + 1 if len(off) > 2 else 1
            if node == len(edge.nodes) - 1:
                return edges[: index + 1], edges[index + 1 :]
            one, other = split_curve(edge, node)
            return (*edges[:index], one), (other, *edges[index + 1 :])
        if length < _NOTHING or edge.length - length < _NOTHING:
            behind = index + (length >= _NOTHING)
            return edges[:behind], edges[behind:]
        part = length / edge.length
        return (*edges[:index], part_of(edge, 0, part)), (part_of(edge, part, 1), *edges[index + 1 :])
    return edges, ()


def _beginning(edges: tuple[Edge, ...], length: float) -> tuple[Edge, ...]:
    """The edges up to a length along them, mm."""
    return split_at(edges, length)[0]


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
