"""Planning: in which order and direction contours are cut, from which start holes, in which passes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from math import inf, pi
from typing import Any, NamedTuple

import numpy as np
import shapely

from skg.errors import UserError
from skg.geometry.arrays import Flags, Floats, Whole, directions, headings, hypots
from skg.geometry.chords import CUT
from skg.geometry.contour import Contour, Edge, part_of
from skg.geometry.edge_arrays import rows_of
from skg.geometry.holding import Holding
from skg.geometry.plane import XY, distance
from skg.job.wanted import CutSettings
from skg.messages.finding import Finding
from skg.planning.entries import (
    EntryAt,
    ends_of_tabs,
    entries_of,
    entry_behind,
    is_long,
    longest_tab,
    nearest_entry,
)
from skg.planning.loops import Trim, tidied
from skg.planning.nesting import Around, Nesting
from skg.planning.order import nearest_order
from skg.planning.planned import LeadShape, PlannedContour, Remarks, Rung, Tab, Tabs
from skg.planning.runs import arc_beside, chain_from, split_at_end

#: A start hole has room enough when nothing is nearer than this part of the lead.
_ENOUGH = 0.5
#: A lead that is an arc has a radius of so often R.
_ROOMY = 1.5
#: A start hole that is not a circle's centre is further from that than this part of the radius.
_BESIDE = 0.1
#: A start hole that is given may be nearer to a contour than R by this, mm.
_NEAR = 1e-3
#: A crossing so near to an entry is that with the entered contour, mm.
_AT_ENTRY = 0.01
#: A lead that is an arc is no smaller, mm; chords of a contour lie inside of it by the rest of this, of the radius.
_LEAST_ARC, _ROUND = 0.05, 0.998


#: The rung, the remarks and the tabs of most contours.
_TOP, _NO_REMARKS, _NO_TABS = Rung(), Remarks(), Tabs()

#: The settings of a contour, and its given start hole.
Asked = tuple[CutSettings, XY | None]


class _Choice:
    """A closed contour whose entry is chosen. `entry`: the one that is tried next, None when all were; `room`: that of
    the best one so far, which `made` has; `reach`: how far the start hole is to be from the contour."""

    def __init__(self, made: PlannedContour, wanted: CutSettings, is_outside: bool) -> None:
        self.made = made
        self.wanted = wanted
        self.is_outside = is_outside
        self.is_right = is_outside == (made.contour.area > 0)
        if place := _entry_of(made, wanted):
            entries = iter([place])
        else:
            entries = entries_of(made.contour, made.tabs.length, wanted.widest)
        self.reach = wanted.lead + abs(made.widest)
        self.entries = entries
        self.entry = next(entries, None)
        self.room = -inf
        self.best: tuple[EntryAt, float, XY, XY] | None = None

    @property
    def tried(self) -> EntryAt:
        """The entry that is tried; there is one until all were."""
        assert self.entry is not None, "all entries were tried"
        return self.entry

    def keep(self, part: float, start: XY, tab_hole: XY, room: float) -> None:
        """Keep what was found for the entry, the best one so far."""
        self.room, self.best = room, (self.tried, part, start, tab_hole)

    def go_on(self) -> bool:
        """Go on to the next entry; whether there is one."""
        self.entry = next(self.entries, None)
        return self.entry is not None

    def planned(self) -> PlannedContour:
        """The contour as it is entered best."""
        assert self.best is not None, "no entry was tried"
        entry, part, start, tab_hole = self.best
        contour = entry.begun(self.made.contour)
        made = self.made.changed(contour=contour, start=start, part=part, room=self.room)
        return _with_tabs(made, Tab(inf, tab_hole, start)) if made.tabs.length else made


class _Columns(NamedTuple):
    """Columns of choices, a row for each."""

    reach: Floats
    widest: Floats
    is_right: Flags
    is_arc: Flags
    has_tab: Flags
    #: (a circle may be entered from its centre)
    is_central: Flags

    @classmethod
    def of(cls, choices: Sequence[_Choice]) -> _Columns:
        """The columns of some choices."""
        lengths = [(choice.reach, choice.wanted.widest) for choice in choices]
        flags = [
            (
                choice.is_right,
                choice.made.is_arc and not choice.made.tabs.length,
                choice.made.tabs.length > 0,
                not (choice.is_outside or choice.made.is_arc or choice.made.tabs.length or choice.wanted.entry),
            )
            for choice in choices
        ]
        return cls(*np.array(lengths, float).reshape(-1, 2).T, *np.array(flags, bool).reshape(-1, 4).T)

    def rows(self, numbers: Whole) -> _Columns:
        """Some of the rows."""
        return _Columns._make(column[numbers] for column in self)


class _Planner:
    """Plans contours, each by itself; knows what lies around them. All contours look around together."""

    def __init__(self, nesting: Nesting) -> None:
        self.nesting = nesting
        self.field = nesting.field

    def plan(self, asked: dict[int, Asked]) -> list[PlannedContour]:
        """Plan some contours, by their numbers."""
        done: dict[int, PlannedContour] = {}
        choices: list[_Choice] = []
        for number, (want, start) in asked.items():
            depth = self.nesting.depths[number]
            contour, sign = _oriented(self.nesting.contours[number], want, depth)
            passes = tuple(sign * (want.offset + more) for more in want.passes)
            if not contour.is_closed:
                start = start or contour.edges[0].start
                done[number] = PlannedContour(contour, start, 0.0, passes[-1:], depth, number=number)
                continue
            is_ccw = contour.area > 0
            is_outside = is_ccw == (sign > 0) if sign else depth % 2 == 0
            loops: tuple[Trim, ...] = ()
            whiskers: tuple[Trim, ...] = ()
            if any(passes):
                contour, loops, whiskers = tidied(contour, max(map(abs, passes)), is_outside)
            tab = want.tab if is_outside else want.slug_tab
            fits = longest_tab(contour, _count(want.tabs))
            is_short = tab >= fits
            tab = 0.0 if is_short else tab
            arc = arc_beside(tab, want.widest)
            is_cramped = want.is_arc and tab > 0 and arc < max(_LEAST_ARC, _ROOMY * want.widest)
            tab_passes = tuple(sign * (want.offset + more) for more in (want.passes[0], *want.tab_passes))
            arc_or_line = LeadShape.ARC if want.is_arc else LeadShape.STRAIGHT
            is_odd = bool(loops or whiskers or is_short)
            made = PlannedContour(
                contour,
                start or (0.0, 0.0),
                0.0,
                passes,
                depth,
                Tabs(tab, tab_passes) if tab else _NO_TABS,
                want.overlap,
                number,
                rung=Rung(LeadShape.CRAMPED if is_cramped else arc_or_line) if want.is_arc else _TOP,
                remarks=Remarks(loops, whiskers, longest_tab=fits if is_short else None) if is_odd else _NO_REMARKS,
            )
            if tab:
                _refuse_tabs(made, want)
            if start is not None:
                if any(passes):
                    self._refuse_misplaced(made, is_outside)
                done[number] = self._bridged(
                    self._entered(made, want, is_outside == is_ccw), want, is_outside == is_ccw
                )
                continue
            choices.append(_Choice(made, want, is_outside))
        self._choose(choices)
        # (an arc takes more room than a line)
        cramped = [
            index
            for index, choice in enumerate(choices)
            if choice.made.is_arc and choice.room < _ROOMY * choice.wanted.widest
        ]
        for index in cramped:
            made = choices[index].made.on_rung(lead=LeadShape.CRAMPED)
            choices[index] = _Choice(made, choices[index].wanted, choices[index].is_outside)
        self._choose([choices[index] for index in cramped])
        for choice in choices:
            done[choice.made.number] = self._bridged(choice.planned(), choice.wanted, choice.is_right)
        return [done[number] for number in asked]

    def _bridged(self, made: PlannedContour, wanted: CutSettings, is_right: bool) -> PlannedContour:
        """The contour with all of its tabs: so far it has the one before its entry."""
        if made.tabs.each and _count(wanted.tabs) > 1:
            tabs = wanted.tabs if isinstance(wanted.tabs, int) else _first_at(wanted.tabs, made.entry)
            ends = ends_of_tabs(made.chain, made.tabs.length, tabs)
            made = _with_tabs(made, *(Tab(end, made.start, made.start) for end in ends), *made.tabs.each)
            _refuse_crowded(made, ends)
            before, behind = ([span[side][-1] for span in made.spans[:-1]] for side in (0, 1))
            right, widest = np.full(len(ends), is_right), np.full(len(ends), abs(made.widest))
            deep = np.minimum(distance(made.start, made.entry), _deepest(before, *_at_ends(behind), right, widest))
            holes = (self._tab_holes(edges, right, deep, widest).tolist() for edges in (before, behind))
            others = (Tab(end, tuple(x), tuple(y)) for end, x, y in zip(ends, *holes, strict=True))
            made = _with_tabs(made, *others, made.tabs.each[-1])
        if made.overlap:
            _refuse_overlap(made)
        return made

    def _refuse_misplaced(self, made: PlannedContour, is_outside: bool) -> None:
        """Refuse a start hole that is given in the part, or so near to it that the wire would come into it there."""
        (x, y), contour = made.start, made.contour
        is_in = made.number in self.nesting.holding.around([made.start])[0]
        least = min(map(abs, made.passes))
        if is_in == is_outside:
            code = "hole-inside" if is_in else "hole-outside"
        elif min(edge.far(made.start) for edge in contour.edges) < least - _NEAR:
            code = "hole-near-outside" if is_outside else "hole-near-inside"
        else:
            return
        u, v = contour.edges[0].start
        raise UserError(Finding(code, x=x, y=y, u=u, v=v, least=least, contour=made.number, place=made.start))

    def _entered(self, made: PlannedContour, wanted: CutSettings, is_right: bool) -> PlannedContour:
        """Enter a contour from its start hole at the place that is asked for, or where it is nearest to the hole."""
        asked = _entry_of(made, wanted)
        entry = asked or nearest_entry(made.contour, made.start, made.widest)
        contour, part = entry.begun(made.contour), entry.part
        if asked and wanted.entry:
            contour, part = _entered_aside(contour, part, made.start)
            _refuse_crossing(made, contour.edges[0].at(part))
        if not made.tabs.length:
            return replace(made, contour=contour, part=part)
        contour, part = self._tab_before(contour, part, made)
        made = replace(made, contour=contour, part=part)
        end, right, widest = (
            _before_tab(contour, part, made.tabs.length),
            np.array([is_right]),
            np.array([abs(made.widest)]),
        )
        deep = _deepest([end], *_at_ends(made.chain[-1:]), right, widest)
        ((x, y),) = self._tab_holes([end], right, np.minimum(deep, distance(made.start, made.entry)), widest).tolist()
        return _with_tabs(made, Tab(inf, (x, y), made.start))

    def _choose(self, choices: Sequence[_Choice]) -> None:
        """Choose the entry with the most room: the first one with enough, else the best one."""
        groups = [choice.made.contour.edges for choice in choices]
        first = np.cumsum([0, *map(len, groups)])
        edges = [edge for group in groups for edge in group]
        rows, is_curve = rows_of(edges), np.array([bool(edge.nodes) for edge in edges], bool)
        columns = _Columns.of(choices)
        best = np.full(len(choices), -inf)
        left = [index for index, choice in enumerate(choices) if choice.entry is not None]
        while left:
            numbers, tried = np.array(left), [choices[index] for index in left]
            edge_rows = first[numbers] + np.array([choice.tried.edge for choice in tried])
            parts = np.array([choice.tried.part for choice in tried])
            curves = np.flatnonzero(is_curve[edge_rows]).tolist()
            *results, room, is_enough = self._try(tried, rows[edge_rows], parts, curves, columns.rows(numbers))
            better = np.flatnonzero(room > best[numbers])
            best[numbers[better]] = room[better]
            found = (column[better].tolist() for column in (*results, room))
            for index, part, start, tab_hole, space in zip(better.tolist(), *found, strict=True):
                tried[index].keep(part, tuple(start), tuple(tab_hole), space)
            left = [index for index in numbers[~is_enough].tolist() if choices[index].go_on()]

    def _try(
        self, choices: Sequence[_Choice], rows: Floats, parts: Floats, curves: Sequence[int], columns: _Columns
    ) -> tuple[Floats, Floats, Floats, Floats, Flags]:
        """Try the entries of contours, at parts of the edges in some rows, some of them `curves`.

        Returns the parts, the start holes and those of the tabs, how far the nearest contour is from these, and
        whether that is enough.
        """
        places, bearings = _places(rows, parts)
        for index in curves:
            edge = choices[index].tried.begun(choices[index].made.contour).edges[0]
            places[index], bearings[index] = edge.at(0.0), edge.direction()
        reach, widest, is_right, is_arc, has_tab, is_central = columns
        # An opening that is one circle is entered from its centre, on its +X side (language.md, section 4.2).
        circles = np.flatnonzero(_are_circles(rows) & is_central)
        central = circles[self._is_clear_from_centre(rows[circles], widest[circles])]
        for index in central.tolist():
            edge = choices[index].made.contour.edges[choices[index].tried.edge]
            parts[index] = _part_at(edge, (edge.centre[0] + edge.radius, edge.centre[1]))
            places[index] = edge.at(float(parts[index]))
        starts = rows[:, 4:6].copy()
        others = np.delete(np.arange(len(choices)), central)
        starts[others] = self._holes(
            places[others],
            bearings[others],
            rows[others],
            is_right[others],
            reach[others],
            widest[others],
            is_arc[others],
        )
        far = hypots(*(starts - places).T)
        tabs = np.flatnonzero(has_tab)
        if len(tabs):
            begun = [(choices[index].made, choices[index].tried, float(parts[index])) for index in tabs.tolist()]
            ends = [_before_tab(entry.begun(made.contour), part, made.tabs.length) for made, entry, part in begun]
            deep = _deepest(ends, places[tabs], bearings[tabs], is_right[tabs], widest[tabs])
            part = np.minimum(1.0, deep / far[tabs])
            starts[tabs] = places[tabs] + part[:, None] * (starts[tabs] - places[tabs])
            far[tabs] *= part
        # Distances of the start holes from the nearest contour.
        around = 2 * far + 1e-3
        room = self.field.near(starts, around)
        tab_holes = np.zeros((len(choices), 2))
        if len(tabs):
            # The start hole at the other side of the tab is as far from the contour as the first one.
            tab_holes[tabs] = self._tab_holes(ends, is_right[tabs], far[tabs], widest[tabs])
            room[tabs] = np.minimum(room[tabs], self.field.near(tab_holes[tabs], around[tabs]))
        is_centre = (rows[:, 8] != 0) & (starts == rows[:, 4:6]).all(1)
        return parts, starts, tab_holes, room, (room >= _ENOUGH * reach) | is_centre

    def _tab_holes(self, edges: Sequence[Edge], is_right: Flags, reach: Floats, widest: Floats) -> Floats:
        """The start holes beside the ends of some edges, which are those of tabs."""
        places, bearings = _at_ends(edges)
        no_arcs = np.zeros(len(edges), bool)
        return self._holes(places, bearings, rows_of(edges), is_right, reach, widest, no_arcs)

    def _tab_before(self, contour: Contour, part: float, made: PlannedContour) -> tuple[Contour, float]:
        edge, tab = contour.edges[0], made.tabs.length
        aside = tab / edge.length
        if edge.is_circle:
            return contour, part
        if aside > 0.8 and is_long(contour, tab):
            return contour, part
        if aside > 0.8:
            x, y = edge.start
            raise UserError(Finding("no-room-for-tab", x=x, y=y, tab=tab, contour=made.number, place=made.start))
        return contour, min(0.95, max(part, aside + 0.05))

    def _holes(
        self,
        places: Floats,
        bearings: Floats,
        rows: Floats,
        is_right: Flags,
        reach: Floats,
        widest: Floats,
        is_arc: Flags,
    ) -> Floats:
        """Start holes square to the bearings at places on edges (in rows), on the wire's side: `reach` away, or in the
        middle of the room there is."""
        square = headings(np.where(is_right, bearings - pi / 2, bearings + pi / 2))
        # An arc's own chords lie up to 0.1 % of its radius inside of it.
        least = np.where(rows[:, 8] != 0, 1e-3 * (1 + rows[:, 6]), 1e-3)
        reach = np.minimum(reach, self.field.ahead(places, square, 2 * reach + least, least) / 2)
        reach = self._clear(places, square, reach, widest, np.where(rows[:, 8] != 0, 1e-3 * rows[:, 6], 0.0))
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

    def _is_clear_from_centre(self, circles: Floats, widest: Floats) -> Flags:
        """Tell whether the wire gets from circles' centres to their +X sides and cuts nothing that lies in the
        circle."""
        vectors, wide = np.tile((1.0, 0.0), (len(circles), 1)), np.maximum(_ROUND * widest, 1e-3)
        # (not as far as the circle itself)
        reach = np.maximum(0.0, _ROUND * circles[:, 6] - widest)
        return self.field.before(circles[:, 4:6], vectors, reach, np.zeros(len(circles)), wide) == inf

    def _clear(self, places: Floats, square: Floats, reach: Floats, widest: Floats, chords: Floats) -> Floats:
        """Return the distance that the wire gets away from entries: all the way it stays R off other contours.
        `chords` of their own edges lie so much nearer, mm."""
        indices = np.flatnonzero((widest > 0) & (reach > widest))
        r = widest[indices]
        far = self.field.before(places[indices], square[indices], reach[indices], r + chords[indices], _ROUND * r)
        # (halfway to where it is no longer free)
        distances = reach.copy()
        distances[indices] = np.where(far == inf, reach[indices], (r + far) / 2)
        return distances


def _are_circles(rows: Floats) -> Flags:
    """Mark the rows that are whole circles, as `Piece.is_circle`."""
    return np.abs(rows[:, 8]) > 2 * pi - 1e-9


def _places(rows: Floats, parts: Floats) -> tuple[Floats, Floats]:
    """The places at parts of the lengths of lines and arcs (n, 2), and the direction angles there: as `Piece.at` and
    `Piece.direction` have them."""
    sides = rows[:, 2:4] - rows[:, 0:2]
    places, bearings = rows[:, 0:2] + parts[:, None] * sides, directions(sides)
    arcs = np.flatnonzero(rows[:, 8])
    radius, first, sweep = rows[arcs, 6:].T
    angles = first + parts[arcs] * sweep
    places[arcs] = rows[arcs, 4:6] + radius[:, None] * headings(angles)
    bearings[arcs] = angles + np.copysign(pi / 2, sweep)
    return places, bearings


def _at_ends(edges: Sequence[Edge]) -> tuple[Floats, Floats]:
    """The places at the ends of edges (n, 2), and the direction angles there."""
    return np.array([edge.at(1.0) for edge in edges]), np.array([edge.direction(1.0) for edge in edges])


def _deepest(before: Sequence[Edge], places: Floats, bearings: Floats, is_right: Flags, widest: Floats) -> Floats:
    """The length of leads square to the contour on both sides of tabs that leaves half of these between them, mm: where
    some edges end, and at places that are passed in some directions."""
    froms, bearings_before = _at_ends(before)
    aside = np.where(is_right, -pi / 2, pi / 2)
    tabs = places - froms
    lengths = np.maximum(hypots(*tabs.T), 1e-9)
    closing = -((headings(bearings + aside) - headings(bearings_before + aside)) * tabs).sum(1) / lengths
    room = np.maximum(lengths / 2 - widest, 1e-3)
    return np.where(closing > 1e-9, room / np.maximum(closing, 1e-9), inf)


def _with_tabs(made: PlannedContour, *tabs: Tab) -> PlannedContour:
    return replace(made, tabs=replace(made.tabs, each=tabs))


def _lying_in(made: PlannedContour, around: Around) -> PlannedContour:
    return replace(made, remarks=replace(made.remarks, around=around))


def _count(tabs: int | Sequence[XY]) -> int:
    """The number of tabs that are asked for."""
    return tabs if isinstance(tabs, int) else len(tabs)


def _first_at(places: Sequence[XY], entry: XY) -> list[XY]:
    """Places of tabs, that of the one at the entry first."""
    first = min(places, key=lambda place: distance(place, entry))
    return [first, *(place for place in places if place is not first)]


def _entry_of(made: PlannedContour, wanted: CutSettings) -> EntryAt | None:
    """The entry that is asked for: by its place, or by those of tabs."""
    if wanted.entry:
        return nearest_entry(made.contour, wanted.entry, wanted.widest, with_curves=True)
    if made.tabs.length and not isinstance(wanted.tabs, int):
        first = (
            wanted.tabs[0] if wanted.start is None else min(wanted.tabs, key=lambda place: distance(place, made.start))
        )
        return entry_behind(made.contour, first, made.tabs.length, wanted.widest)
    return None


def _entered_aside(contour: Contour, part: float, start: XY) -> tuple[Contour, float]:
    """A circle that is entered elsewhere than on its start hole's radius as two arcs, the entry in the middle of one:
    the ROM comes to a whole circle on that radius alone, from the centre on the +X side (language.md, section 4.2)."""
    circle = contour.edges[0]
    if not circle.is_circle or circle.centre is None:
        return contour, part
    is_centre = distance(start, circle.centre) < _NEAR
    x, y = circle.centre
    radial = circle.nearest((x + circle.radius, y) if is_centre else start)
    if distance(circle.at(radial), circle.at(part)) < _NEAR:
        return contour, radial
    turned = chain_from(contour, (part + 0.75) % 1)[0]
    return replace(contour, edges=(part_of(turned, 0, 0.5), part_of(turned, 0.5, 1))), 0.5


def _refuse_crossing(made: PlannedContour, entry: XY) -> None:
    """Refuse an entry that the wire comes to from the given start hole through the contour itself."""
    if distance(made.start, entry) < _NEAR:
        return
    edges = made.contour.edges
    chords = [edge.points() if edge.is_line or edge.nodes else edge.parted(edge.chords(CUT)) for edge in edges]
    way = shapely.LineString([made.start, entry])
    met = shapely.intersection(way, shapely.LineString([place for places in chords for place in places]))
    # (the chords beside the entry are crossed where the contour is met there)
    if not met.is_empty and met.distance(shapely.Point(made.start)) < way.length - abs(made.widest) - _AT_ENTRY:
        raise _refusal("entry-behind", made, start=made.start, place=entry)


def _refusal(code: str, made: PlannedContour, **values: Any) -> UserError:  # noqa: ANN401
    """A refusal of a contour that has no turn yet: it is named by its beginning."""
    u, v = made.contour.edges[0].start
    return UserError(Finding(code, u=u, v=v, contour=made.number, **values))


def _refuse_tabs(made: PlannedContour, wanted: CutSettings) -> None:
    """Refuse cuts of a tab that leave more than the first pass or less than the last, and an entry beside places."""
    least, most = abs(made.passes[-1]), abs(made.passes[0])
    if abs(made.tabs.passes[-1]) < least - _NEAR or any(abs(r) > most + _NEAR for r in made.tabs.passes):
        raise _refusal("tab-passes-beyond", made, first=wanted.passes[0], last=wanted.passes[-1])
    if wanted.entry and not isinstance(wanted.tabs, int):
        raise _refusal("entry-and-tabs", made)


def _refuse_crowded(made: PlannedContour, ends: Sequence[float]) -> None:
    """Refuse tabs between which there is less than the length of one."""
    total = sum(edge.length for edge in made.chain)
    if any(after - before < 2 * made.tabs.length - _NEAR for before, after in pairwise([0.0, *ends, total])):
        raise _refusal("tabs-crowded", made, tab=made.tabs.length)


def _refuse_overlap(made: PlannedContour) -> None:
    """Refuse an overlap that goes over half of a cut."""
    spans = [before for before, _ in made.spans] if made.tabs.each else [made.chain]
    shortest = min(sum(edge.length for edge in edges) for edges in spans)
    if made.overlap > shortest / 2:
        raise _refusal("overlap-too-long", made, overlap=made.overlap, cut=shortest)


def _before_tab(contour: Contour, part: float, tab: float) -> Edge:
    """The edge that ends where the tab begins, of a contour that is entered at `part` of its first edge."""
    return split_at_end(chain_from(contour, part), tab)[0][-1]


def _part_at(edge: Edge, place: XY) -> float:
    part = edge.nearest(place)
    return 0.0 if distance(place, edge.start) < 1e-9 else part


def plan(
    contours: Sequence[Contour], starts: Sequence[XY], wanted: CutSettings | Sequence[CutSettings]
) -> list[PlannedContour]:
    """Plan contours that nobody has looked at; see `plan_nested`."""
    each = [wanted] * len(contours) if isinstance(wanted, CutSettings) else wanted
    return plan_nested(Nesting.of(contours), starts, each)


def plan_nested(
    nesting: Nesting,
    starts: Sequence[XY],
    wanted: Sequence[CutSettings],
    before: dict[int, tuple[Asked, PlannedContour]] | None = None,
) -> list[PlannedContour]:
    """Return the contours in the order in which they are cut: inner ones first, and then the nearest.

    `wanted`: how each is cut. Each of the `starts` (mm) goes to the innermost contour around it that is cut from inside
    and has no start hole yet, else to the nearest one. What lies in an uncut contour is an opening of it, or a part in
    a frame. Raises `UserError` for a start hole in the part, and for an order that cuts a contour before what lies in
    it. `before`: contours that were planned before, each with what was asked for; those are not planned anew, and what
    is goes there.
    """
    before = {} if before is None else before
    given = _given_starts(nesting, wanted, list(starts))
    asked = {number: (want, given.get(number)) for number, want in enumerate(wanted) if want.cut}
    new = {number: request for number, request in asked.items() if number not in before or before[number][0] != request}
    for planned in _Planner(nesting).plan(new):
        is_auto = wanted[planned.number].side == "auto"
        around = nesting.around.get(planned.number) if is_auto else None
        before[planned.number] = new[planned.number], _lying_in(planned, around) if around else planned
    ordered = _as_wanted(_ordered([before[number][1] for number in asked]), wanted)
    for turn, planned in enumerate(ordered, 1):
        if planned.turn != turn:
            before[planned.number] = asked[planned.number], planned.changed(turn=turn)
    ordered = [before[planned.number][1] for planned in ordered]
    if any(want.order is not None for want in wanted):
        _refuse_outer_first(ordered, nesting.holding)
    return ordered


def _oriented(contour: Contour, wanted: CutSettings, depth: int) -> tuple[Contour, float]:
    """Return the contour in the direction in which it is cut, and the sign of R."""
    side = wanted.side
    if not contour.is_closed:
        sign = {"left": -1.0, "right": 1.0}.get(side, 0.0)
        return (contour.reversed(), -sign) if wanted.reverse else (contour, sign)
    # With the wire on the right of travel an outline is cut counter-clockwise and an opening clockwise.
    is_opening = depth % 2 == 1
    if side in ("inside", "outside"):
        is_opening = side == "inside"
    sign = {"on": 0.0, "left": -1.0}.get(side, 1.0)
    if (contour.area < 0) != is_opening:
        contour = contour.reversed()
    if wanted.reverse:
        contour, sign = contour.reversed(), -sign
    return contour, sign


def _ordered(contours: list[PlannedContour]) -> list[PlannedContour]:
    """Inner contours before those around them, then the nearest next."""
    places = np.array([planned.start for planned in contours], float).reshape(-1, 2)
    depths = np.array([planned.depth for planned in contours], int)
    ordered: list[PlannedContour] = []
    at_now = 0.0, 0.0
    for depth in sorted(set(depths.tolist()), reverse=True):
        indices = np.flatnonzero(depths == depth)
        ordered += [contours[index] for index in indices[nearest_order(places[indices], at_now)].tolist()]
        at_now = ordered[-1].start
    return ordered


def _as_wanted(contours: list[PlannedContour], wanted: Sequence[CutSettings]) -> list[PlannedContour]:
    """Put the contours that have a wanted order to their places; the others keep theirs among themselves."""
    placed = {planned.number: order for planned in contours if (order := wanted[planned.number].order) is not None}
    if not placed:
        return contours
    free = iter([planned for planned in contours if planned.number not in placed])
    ranked = sorted(
        (planned for planned in contours if planned.number in placed), key=lambda planned: placed[planned.number]
    )
    merged: list[PlannedContour] = []
    while len(merged) < len(contours):
        if ranked and placed[ranked[0].number] <= len(merged) + 1:
            merged.append(ranked.pop(0))
        else:
            merged.append(next(free, None) or ranked.pop(0))
    return merged


def _refuse_outer_first(contours: list[PlannedContour], holding: Holding) -> None:
    """Refuse an order that cuts a contour before what lies in it: that would fall with the part or the slug."""
    numbered = {planned.number: planned for planned in contours}
    around = holding.around([planned.contour.edges[0].at(0.5) for planned in contours])
    for planned, holders in zip(contours, around, strict=True):
        for outer in (numbered[number] for number in holders if number in numbered):
            if outer.depth < planned.depth and outer.turn < planned.turn:
                names = {"outer": outer.name, "inner": planned.name}
                raise UserError(Finding("outer-first", contour=outer.number, place=outer.entry, **names))


def _given_starts(nesting: Nesting, wanted: Sequence[CutSettings], starts: list[XY]) -> dict[int, XY]:
    """Assign each given start hole to a contour (by its number)."""
    holding, depths = nesting.holding, nesting.depths
    given = {number: want.start for number, want in enumerate(wanted) if want.cut and want.start is not None}
    taken = {number for number, want in enumerate(wanted) if not want.cut} | set(given)
    if len(starts) > len(depths) - len(taken):
        raise UserError(Finding("too-many-holes", count=len(starts), contours=len(depths) - len(taken)))
    for start, holders in zip(starts, holding.around(starts), strict=True):
        around = [number for number in holders if number not in taken and depths[number] % 2]
        chosen = max(around, key=depths.__getitem__) if around else holding.nearest(start, taken)
        given[chosen] = start
        taken.add(chosen)
    return given
