"""A planned contour: what is cut, from which start hole, in which passes; and on which rung of the ladder it is."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from enum import Enum
from functools import cached_property
from itertools import pairwise
from math import inf
from typing import Any, NamedTuple

import shapely

from skg.geometry.chords import CUT, chords_of
from skg.geometry.contour import Contour, Edge
from skg.geometry.offset import SPIKE, NoRoom, has_spike, part_between, roomy_place, wire_path
from skg.geometry.plane import XY, distance, minus, polar
from skg.messages.finding import Phrase
from skg.planning.loops import Trim
from skg.planning.nesting import Around
from skg.planning.runs import (
    SQUARE,
    Lead,
    Run,
    angle,
    arc_beside,
    backwards,
    beginning,
    beside,
    chain_from,
    reverse,
    split_at,
    split_at_end,
    stands_square,
)


def kind_of(kind: str, count: int = 1) -> Phrase:
    """The noun for some contours of a kind."""
    return Phrase(f"kind-{kind.replace(' ', '-')}", count=count)


class Tab(NamedTuple):
    """A bridge between contour and stock. `end`: where it ends, mm along the contour from its entry, infinite: at the
    entry again; `before`, `behind`: the start holes on its two sides, in the contour's direction."""

    end: float
    before: XY
    behind: XY


@dataclass(frozen=True)
class Tabs:
    """The tabs of a contour, which stay until the last cuts. `length`: of each, mm, 0: none; `passes`: R of the cuts
    that take them off, as if all were made in the contour's direction; `each`: the last one is before the entry."""

    length: float = 0.0
    passes: tuple[float, ...] = ()
    each: tuple[Tab, ...] = ()


class LeadShape(Enum):
    """The shape of leads. `CRAMPED`: straight, since the arc that was asked for has no room."""

    STRAIGHT = "straight"
    ARC = "arc"
    CRAMPED = "cramped"


class Reason(Enum):
    """Reasons to cut a contour along another path than R beside it: edges that the wire cannot follow, tips that it
    would run far past, arcs that the controller would end too early or too late."""

    EDGES = "edges"
    TIPS = "tips"
    CHORDS = "chords"


@dataclass(frozen=True)
class WirePaths:
    """The paths of the wire's middle, one for each of a contour's `offsets`, that are cut instead of R beside it.

    `entered`: they begin where they are nearest to this place; None: beside the contour's entry.
    """

    paths: tuple[tuple[Edge, ...], ...]
    reason: Reason
    entered: XY | None = None


@dataclass(frozen=True)
class Rung:
    """A contour's rung on the ladder of remedies (skg.cutting.ladder): how its program is written. The top one is as
    asked for. `lead`: the shape of its leads; `has_fillets`: arcs between lines are written as radii of fillets, where
    these make them; `wire`: the paths of the wire itself, None: the contour and R."""

    lead: LeadShape = LeadShape.STRAIGHT
    has_fillets: bool = True
    wire: WirePaths | None = None


@dataclass(frozen=True)
class Remarks:
    """Facts about a contour for the report. `loops`, `whiskers`: those of the drawing that are not in the contour, see
    `tidied`; `around`: what lies around it and is not cut; `longest_tab`: where a longer one was asked for, mm."""

    loops: tuple[Trim, ...] = ()
    whiskers: tuple[Trim, ...] = ()
    around: Around | None = None
    longest_tab: float | None = None


@dataclass(frozen=True)
class PlannedContour:
    """A contour with where it is entered: from `start` to the point at `part` of its first edge.

    `passes`: R of each pass, as if all were cut in the contour's direction, positive with the wire on the right of
    travel; every second one is cut backwards. `depth`: how many contours lie around it. `overlap`: closed cuts go on
    past their end by this, those of tabs at both ends, mm. `number`: its place among the contours that were read, from
    0; `turn`: in the order of cutting, from 1. `room`: from the start hole to what is nearest, mm.
    """

    contour: Contour
    start: XY
    part: float
    passes: tuple[float, ...]
    depth: int
    tabs: Tabs = Tabs()
    overlap: float = 0.0
    number: int = 0
    turn: int = 0
    room: float = inf
    rung: Rung = Rung()
    remarks: Remarks = Remarks()

    def changed(self, **values: Any) -> PlannedContour:  # noqa: ANN401
        """The same with other values of some fields: as `replace` makes it, in a tenth of the time."""
        made = object.__new__(PlannedContour)
        known = vars(self)
        vars(made).update({name: known[name] for name in _FIELDS} | values)
        return made

    def on_rung(self, **changes: Any) -> PlannedContour:  # noqa: ANN401
        """The same on another rung: `changes` are fields of `Rung`."""
        return replace(self, rung=replace(self.rung, **changes))

    @property
    def offset(self) -> float:
        """R of the last pass, mm."""
        return self.passes[-1]

    def has_spike(self, most: float = SPIKE) -> bool:
        """Tell whether the wire beside it would run on past a tip by more than so many R (skg.geometry.offset)."""
        return has_spike(self.contour, self.offset, most)

    @property
    def is_arc(self) -> bool:
        """Tell whether its leads are arcs."""
        return self.rung.lead is LeadShape.ARC

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
        return (*self.passes, *self.tabs.passes) if self.tabs.each else self.passes

    @property
    def proud(self) -> float:
        """Height that is left where the tabs were, mm."""
        return abs(self.tabs.passes[-1]) - abs(self.passes[-1]) if self.tabs.each else 0.0

    @property
    def holes(self) -> tuple[XY, ...]:
        """The start holes to be drilled."""
        return (self.start, *(tab.behind for tab in self.tabs.each[:-1]))

    @property
    def is_square(self) -> bool:
        """Tell whether the start hole stands square to the entry: a lead that is an arc touches the contour only
        then."""
        edge = self.chain[0]
        return stands_square(self.start, edge.start, edge.direction())

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
        for number, tab in reversed(list(enumerate(self.tabs.each))):
            if tab.end < inf:
                rest = split_at(rest, tab.end)[0]
            before, bridge = split_at_end(rest, self.tabs.length)
            begin = self.tabs.each[number - 1].end if number else 0.0
            spans.append((split_at(before, begin)[1] if number else before, bridge))
        return tuple(reversed(spans))

    @property
    def parts(self) -> tuple[tuple[Edge, ...], ...]:
        """The edges in order: those up to a tab, those of the tab, and so on."""
        return tuple(part for span in self.spans for part in span) if self.tabs.each else (self.chain,)

    def runs(self) -> Iterator[Run]:
        """Every run of the wire, in order."""
        if not self.contour.is_closed:
            yield Run(self.chain, self.offset)
        elif self.tabs.each:
            yield from self._up_to_tabs()
            yield from self._along_tabs()
        else:
            for index, r in enumerate(self.passes):
                falls = "IS" if index == 1 and len(self.passes) > 1 else ""
                stop = falls and ("TAKE THE SLUG OUT" if self.frees == "slug" else "THE PART IS FREE")
                run = self._around(Run(self.chain, r, index, stop=stop))
                yield backwards(run) if index % 2 else run

    def _around(self, run: Run) -> Run:
        """A run all around, with its leads, and past its end by the overlap."""
        if self.is_arc or self.overlap:
            lead = self._lead(self.start, run.edges[0])
            run = replace(run, into=lead, out=lead)
        run = self._along(run)
        if not self.overlap:
            return run
        more = beginning(run.edges, self.overlap)
        assert run.out is not None, "past its end it has leads"
        out = run.out.moved(more[-1].end, more[-1].direction(1.0))
        return replace(run, edges=(*run.edges, *more), out=out)

    def _lead(self, hole: XY, edge: Edge, at_end: bool = False) -> Lead:
        direction = edge.direction(1.0 if at_end else 0.0)
        entry = edge.end if at_end else edge.start
        is_arc = self.is_arc and stands_square(hole, entry, direction)
        if is_arc and self.tabs.each and (radius := arc_beside(self.tabs.length, self.widest)) < distance(hole, entry):
            # (the arcs on its two sides come over the tab)
            return Lead(polar(entry, radius, angle(minus(hole, entry))), entry, direction, True, hole)
        return Lead(hole, entry, direction, is_arc)

    def _up_to_tabs(self) -> Iterator[Run]:
        """The passes up to each tab, forth and back."""
        for (edges, _), hole, tab in zip(self.spans, self.holes, self.tabs.each, strict=True):
            into, out = self._lead(hole, edges[0]), self._lead(tab.before, edges[-1], True)
            for index, r in enumerate(self.passes):
                stop = "GO TO THE NEXT START HOLE" if not index and hole != self.start else ""
                run = self._along(Run(edges, r, index, into, out))
                yield replace(backwards(run) if index % 2 else run, stop=stop)

    @property
    def tab_order(self) -> list[int]:
        """The tabs, by their numbers, in the order in which they are cut: from the one that the wire has come to on."""
        count = len(self.tabs.each)
        return [(turn - 1 if len(self.passes) % 2 else -2 - turn) % count for turn in range(count)]

    def _along_tabs(self) -> Iterator[Run]:
        """The cuts of the tabs."""
        count, is_before = len(self.tabs.each), len(self.passes) % 2 == 1
        for cut, number in enumerate(self.tab_order, 1):
            (before, edges), (behind, _) = self.spans[number], self.spans[(number + 1) % count]
            into = self._lead(self.tabs.each[number].before, before[-1], True)
            out = self._lead(self.holes[(number + 1) % count], behind[0])
            if self.overlap:
                early = reverse(beginning(reverse(before), self.overlap))
                late = beginning(behind, self.overlap)
                edges = (*early, *edges, *late)
                into = into.moved(early[0].start, early[0].direction())
                out = out.moved(late[-1].end, late[-1].direction(1.0))
            for index, r in enumerate(self.tabs.passes):
                stop = ""
                if not index:
                    hold = f"HOLD THE {self.frees.upper()}, THE NEXT CUT FREES IT"
                    stop = hold if cut == count else "GO TO THE NEXT TAB"
                elif index == 1 and cut == count and self.frees == "slug":
                    stop = "TAKE THE SLUG OUT"
                run = self._along(Run(edges, r, len(self.passes) + index, into, out))
                yield replace(run if is_before == (index % 2 == 0) else backwards(run), stop=stop)

    def along_wire(self, reason: Reason = Reason.EDGES) -> PlannedContour:
        """The same, cut along the paths of the wire itself; `NoRoom` where there are none (skg.geometry.offset)."""
        paths = self._wire_paths
        result = self.on_rung(wire=WirePaths(paths, reason))
        if self.tabs.each:
            list(result.runs())  # (`NoRoom` where the wire does not come to a tab)
            return result
        if self.is_outside or self.room == inf:
            return result
        # (a start hole that was chosen, square to the contour, may be where the wire does not come to)
        place = roomy_place(paths[self.passes.index(self.widest)], self.start)
        if place == self.start:
            return result
        return replace(result, start=place).on_rung(wire=WirePaths(paths, reason, place))

    @cached_property
    def _wire_paths(self) -> tuple[tuple[Edge, ...], ...]:
        return tuple(wire_path(self.contour, r) for r in self.offsets)

    def in_chords(self) -> PlannedContour:
        """The same without an offset, cut along chords of its arcs and curves: a controller may end an arc too early or
        too late by more than may be, a line never."""
        edges = tuple(chord for edge in self.contour.edges for chord in _chords(edge))
        return self.on_rung(wire=WirePaths((edges,) * len(self.offsets), Reason.CHORDS))

    def _along(self, run: Run) -> Run:
        """A run of a pass along the wire's own path, if there is one."""
        wire = self.rung.wire
        if not wire:
            return run
        first, last = (
            beside(place, direction, run.offset)
            for place, direction in (
                (run.edges[0].start, run.edges[0].direction()),
                (run.edges[-1].end, run.edges[-1].direction(1.0)),
            )
        )
        edges = part_between(wire.paths[run.number], wire.entered or first, None if run.is_closed else last)
        if not edges:
            raise NoRoom(run.edges[0].start, "room-over-tab", is_crossing=True)
        into, out = run.into, run.out
        if into and out:
            into = replace(into, entry=edges[0].start, is_arc=into.is_arc and distance(edges[0].start, first) < SQUARE)
            out = replace(out, entry=edges[-1].end, is_arc=out.is_arc and distance(edges[-1].end, last) < SQUARE)
        return replace(run, edges=edges, offset=0.0, into=into, out=out)


#: The fields that `changed` takes over, without those that are derived from them.
_FIELDS = tuple(each.name for each in fields(PlannedContour))


def _chords(edge: Edge) -> list[Edge]:
    """An arc or a curve as chords."""
    if edge.is_line:
        return [edge]
    if edge.nodes:
        line = shapely.LineString(edge.samples).simplify(CUT)
        return [Edge(start, end, entity=edge.entity) for start, end in pairwise(line.coords)]
    places = edge.parted(chords_of(edge.radius, edge.sweep, CUT))
    return [Edge(start, end, entity=edge.entity) for start, end in pairwise(places)]
