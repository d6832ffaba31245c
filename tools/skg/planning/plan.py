"""Planning: in which order and direction contours are cut, from which start holes, in which passes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import inf, pi
from typing import NamedTuple

import numpy as np

from skg.errors import UserError
from skg.geometry.arrays import Flags, Floats, Whole, directions, headings, hypots
from skg.geometry.contour import Contour, Edge
from skg.geometry.edge_arrays import rows_of
from skg.geometry.field import Field
from skg.geometry.plane import XY, distance
from skg.planning.entries import EntryAt, entries_of, entry_near, is_long, longest_tab
from skg.planning.order import nearest_order
from skg.planning.route import PlannedContour, chain_from, split_at_end

#: Where the wire may run, see `plan`.
SIDES = ("auto", "inside", "outside", "left", "right", "on")
#: A start hole is this far from the contour where there is room, mm.
LEAD = 3.0
#: A start hole has room enough when nothing is nearer than this part of the lead.
_ENOUGH = 0.5
#: A lead that is an arc has a radius of so often R.
_ROOMY = 1.5
#: A start hole that is not a circle's centre is further from that than this part of the radius.
_BESIDE = 0.1
#: A start hole that is given may be nearer to a contour than R by this, mm.
_NEAR = 1e-3
#: A lead that is an arc is no smaller, mm; chords of a contour lie inside of it by the rest of this, of the radius.
_LEAST_ARC, _ROUND = 0.05, 0.998


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

    def __init__(self, made: PlannedContour, is_outside: bool, reach: float, entries: Iterator[EntryAt]) -> None:
        self.made = made
        self.is_outside = is_outside
        self.is_right = is_outside == (made.contour.area > 0)
        self.reach = reach
        self.entries = entries
        self.entry = next(entries, None)
        self.room = -inf
        self.found: tuple[EntryAt, float, XY, XY] | None = None

    def keep(self, part: float, start: XY, tab_hole: XY, room: float) -> None:
        """Keep what was found for the entry, the best one so far."""
        self.room, self.found = room, (self.entry, part, start, tab_hole)

    def go_on(self) -> bool:
        """Go on to the next entry; whether there is one."""
        self.entry = next(self.entries, None)
        return self.entry is not None

    def planned(self) -> PlannedContour:
        """The contour as it is entered best."""
        entry, part, start, tab_hole = self.found
        contour = entry.begun(self.made.contour)
        return replace(self.made, contour=contour, start=start, part=part, tab_hole=tab_hole, room=self.room)


class _Columns(NamedTuple):
    """What is told by choices, a row for each."""

    reach: Floats
    is_right: Flags
    is_inside: Flags
    is_arc: Flags
    has_tab: Flags

    @classmethod
    def of(cls, choices: Sequence[_Choice]) -> _Columns:
        """The columns of some choices."""
        flags = [(one.is_right, not one.is_outside, one.made.is_arc, one.made.tab > 0) for one in choices]
        return cls(np.array([one.reach for one in choices], float), *np.array(flags, bool).reshape(-1, 4).T)

    def rows(self, some: Whole) -> _Columns:
        """Some of the rows."""
        return _Columns(*(column[some] for column in self))


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
                if any(passes):
                    self._refuse_misplaced(made, is_outside)
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
        reach = self.method.lead + abs(made.widest)
        return _Choice(made, is_outside, reach, entries_of(made.contour, made.tab, self.widest))

    def _refuse_misplaced(self, made: PlannedContour, is_outside: bool) -> None:
        """Refuse a start hole that is given in the part, or so near to it that the wire would come into it there."""
        (x, y), contour = made.start, made.contour
        is_in = made.number in self.field.around([made.start])[0]
        least = min(map(abs, made.passes))
        if is_in == is_outside:
            what = f"lies {'inside' if is_in else 'outside'}"
        elif min(edge.far(made.start) for edge in contour.edges) < least - _NEAR:
            what = f"is less than {least:g} mm beside"
        else:
            return
        u, v = contour.edges[0].start
        raise UserError(
            f"the start hole ({x:g}, {y:g}) {what} the contour from ({u:.3f}, {v:.3f}), which is cut from "
            f"{'outside' if is_outside else 'inside'} (mm): give another one, or another --side"
        )

    def _entered(self, made: PlannedContour, is_right: bool) -> PlannedContour:
        """A contour with its start hole, and where it is entered from there."""
        contour, part = entry_near(made.contour, made.start, made.widest)
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
        edges = [edge for some in edges for edge in some]
        rows, is_curve = rows_of(edges), np.array([bool(edge.nodes) for edge in edges], bool)
        columns = _Columns.of(choices)
        best = np.full(len(choices), -inf)
        left = [at for at, choice in enumerate(choices) if choice.entry is not None]
        while left:
            some, tried = np.array(left), [choices[at] for at in left]
            at = first[some] + np.array([choice.entry.at for choice in tried])
            parts = np.array([choice.entry.part for choice in tried])
            curves = np.flatnonzero(is_curve[at]).tolist()
            *found, room, is_enough = self._try(tried, rows[at], parts, curves, columns.rows(some))
            better = np.flatnonzero(room > best[some])
            best[some[better]] = room[better]
            found = (column[better].tolist() for column in (*found, room))
            for at, part, start, tab_hole, space in zip(better.tolist(), *found, strict=True):
                tried[at].keep(part, tuple(start), tuple(tab_hole), space)
            left = [at for at in some[~is_enough].tolist() if choices[at].go_on()]

    def _try(
        self, choices: Sequence[_Choice], rows: Floats, parts: Floats, curves: Sequence[int], told: _Columns
    ) -> tuple[Floats, Floats, Floats, Floats, Flags]:
        """Try the entries of contours, at parts of the edges in some rows, some of them `curves`.

        Returns the parts, the start holes and those of the tabs, how far the nearest contour is from these, and
        whether that is enough.
        """
        places, ways = _places(rows, parts)
        for at in curves:
            edge = choices[at].entry.begun(choices[at].made.contour).edges[0]
            places[at], ways[at] = edge.at(0.0), edge.direction()
        reach, is_right, is_inside, is_arc, has_tab = told
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
        tabs = np.flatnonzero(has_tab)
        if len(tabs):
            begun = [(choices[at].made, choices[at].entry, float(parts[at])) for at in tabs.tolist()]
            ends = [_before_tab(entry.begun(made.contour), part, made.tab) for made, entry, part in begun]
            # The start hole at the other side of the tab is as far from the contour as the first one.
            tab_holes[tabs] = self._tab_holes(ends, is_right[tabs], far[tabs], is_arc[tabs])
            room[tabs] = np.minimum(room[tabs], self.field.near(tab_holes[tabs], around[tabs]))
        is_centre = (rows[:, 8] != 0) & (starts == rows[:, 4:6]).all(1)
        return parts, starts, tab_holes, room, (room >= _ENOUGH * reach) | is_centre

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
        if aside > 0.8 and is_long(contour, self.method.tab):
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
