"""Checking a tape against the drawing that it was made from: where the controller goes, beside where it should.

Nothing here is computed as the ROM does it, there are no corners and no crossings. A tape is right when

- every place of the wire lies R beside its contour (at a sharp corner, outside: beside the line or circle there), and
  never nearer, also where another part of the contour comes by;
- beside every place of the contour that the wire can reach it has been R away.

R is that of the pass which goes there.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from copy import copy
from dataclasses import dataclass
from functools import cached_property
from itertools import chain, pairwise
from math import cos, hypot, sin

import numpy as np
import shapely

from skg.cutting.crossing import Crossing, crossings
from skg.cutting.follow import Followed, Threading, follow
from skg.cutting.near import Floats, Nearest, Pieces, Whole
from skg.drawing.contour import Edge
from skg.drawing.planned import Lead, PlannedContour, split_at_end
from skg.piece import Piece
from skg.plane import XY, cross
from skg.tape.block import Tape
from skg.tape.columns import numbers_up_to
from skg.tape.controller import trace_array

#: The controller may go this far from where the drawing has the wire, mm.
LIMIT = 0.003
#: Rounding takes a block's end up to this far, mm: where it is further off there may be a reason.
_USUAL = 0.0008
#: At a sharp corner, outside, the wire is no further from it than so often what it is where two lines meet.
_TIP = 2.0
#: A pass ends where a block ends that is no further from a start hole, mm.
_HOLE = 0.002
#: No corner is so sharp that the wire is looked for further from it than about so often R.
_FAR = 1000
#: A place at the end of a piece is looked at so far within it; what is less apart is the same place, mm.
_INSIDE, _NOISE = 1e-3, 1e-9
#: A slot of lines and arcs that is narrower than two R by less than twice this is wide enough, mm.
_TIGHT = 1e-5
#: Where the sine of the wire's turn is less, it leaves nothing in an inner corner.
_TURN = 0.1
#: The wire's path is looked at in no more places than this.
_MOST_PLACES = 400_000


@dataclass(frozen=True)
class Misfit:
    """A place (mm) where the wire is not where the drawing has it: `route` by its number in the order of cutting,
    how far it is off (infinite: far), whether it runs into its own contour there, whether it never came there."""

    route: int
    place: XY
    off: float
    is_into: bool = False
    is_missed: bool = False


@dataclass(frozen=True)
class Checked:
    """A tape as it was followed: the largest distance from the drawing (mm), what is wrong."""

    followed: Followed
    off: float
    faults: list[Misfit]
    crossings: list[Crossing]

    @property
    def cuts(self) -> list[Threading]:
        """Its cuts."""
        return self.followed.cuts

    @property
    def drift(self) -> float:
        """Its drift, mm."""
        return self.followed.drift


def check(tape: Tape, routes: list[PlannedContour], is_without_drift: bool) -> Checked:
    """Follow a tape and compare it with the routes that it should cut."""
    followed = follow(tape, routes, is_without_drift)
    contours = Pieces((path, at) for at, route in enumerate(routes) for part in _parts(route) for path in _paths(part))
    path = _WirePath(followed, routes)
    offsets = _offsets(routes)
    widest = float(np.abs(offsets).max(initial=0.0))
    with ThreadPoolExecutor(1) as other:
        # (numpy lets both halves run at the same time)
        beside = other.submit(_beside, path, contours, routes, offsets, widest)
        more, far = _reached(path, contours, _in_tabs(contours, routes), offsets, widest)
        faults, crossings, worst = beside.result()
    return Checked(followed, max(worst, far), faults + more, crossings)


def _offsets(routes: list[PlannedContour]) -> Floats:
    """R of the passes of each route, in its own direction; one that has fewer has its last one again."""
    most = max(len(route.passes) for route in routes)
    return np.array([(*route.passes, *(most - len(route.passes)) * route.passes[-1:]) for route in routes], float)


def drawn(route: PlannedContour) -> Iterator[Piece]:
    """A contour as lines and arcs, in its direction."""
    for edge in (edge for part in _parts(route) for edge in part):
        if edge.nodes:
            yield from (Piece(p, q) for p, q in pairwise(edge.points()) if p != q)
        else:
            yield edge


def _parts(route: PlannedContour) -> tuple[tuple[Edge, ...], ...]:
    """A contour's edges up to its tab, and those of the tab."""
    return split_at_end(route.chain, route.tab) if route.tab else (route.chain,)


def _paths(edges: Iterable[Edge]) -> Iterator[Edge | Floats]:
    """Lines and arcs, and the samples of curves."""
    return (edge.samples if edge.nodes else edge for edge in edges)


def _lead_pieces(route: PlannedContour) -> Iterator[Piece]:
    """The ways between start holes and the contour that a route may take."""
    for run in route.runs():
        if not run.into:
            begin = run.edges[0]
            yield _straight(route.start, begin.start, begin.direction(), run.offset)
            continue
        for lead in (run.into, run.out):
            # (a straight one is the same way in and out)
            for is_in in (True, False)[: 1 + lead.is_arc]:
                yield from _one_lead(lead, run.offset, is_in)


def _straight(hole: XY, entry: XY, way: float, r: float) -> Piece:
    """The way from a hole to beside an entry that is passed in a direction (radians)."""
    # The contour's right is where R is positive.
    return Piece(hole, (entry[0] + r * sin(way), entry[1] - r * cos(way)))


def _one_lead(lead: Lead, r: float, is_in: bool) -> Iterator[Piece]:
    if not lead.is_arc:
        yield _straight(lead.hole, lead.entry, lead.way, r)
        return
    arc = lead.arc(is_in)
    part = 1 - abs(r) / arc.radius

    def inner(place: XY) -> XY:
        return tuple(h + part * (p - h) for h, p in zip(lead.hole, place, strict=True))

    yield Piece(inner(arc.start), inner(arc.end), arc.centre, arc.sweep)
    yield Piece(lead.hole, inner(arc.start if is_in else arc.end))


def _spacing(pieces: Pieces, widest: float) -> float:
    """How near to each other places of a path are looked at: nothing is missed that is as large as the wire."""
    return max(widest / 2, float(pieces.length.sum()) / _MOST_PLACES) if widest else np.inf


class _WirePath:
    """The wire's path: the pieces of all cuts, and how far the controller's steps go aside of each.

    What is compared with the drawing is where the controller goes. A piece and the largest of its steps tell that at
    most; where this is too much, its steps are looked at one by one.
    """

    def __init__(self, followed: Followed, routes: list[PlannedContour]) -> None:
        cuts = followed.cuts
        self.laid = followed.laid
        #: Which of the blocks they are.
        self.rows = np.concatenate([np.arange(cut.blocks.start, cut.blocks.stop) for cut in cuts])
        counts = np.array([cut.blocks.stop - cut.blocks.start for cut in cuts])
        owners = np.repeat([cut.route for cut in cuts], counts)
        self.pieces = Pieces.of_tape(self.laid, self.rows, owners)
        self.aside = followed.off_curve[self.rows] / 1000
        #: Which pass each piece belongs to; -1: to any, or that cannot be told.
        self.passes = np.repeat([cut.passes[0] for cut in cuts], counts)
        for cut, end, count in zip(cuts, np.cumsum(counts).tolist(), counts.tolist(), strict=True):
            if len(cut.passes) > 1:
                some = slice(end - count, end)
                self.passes[some] = _passes(cut.passes, routes[cut.route], self.pieces.end[some])

    def of_pass(self, number: int) -> Pieces:
        """The pieces; those that surely belong to other passes are nobody's."""
        found = copy(self.pieces)
        found.owner = np.where((self.passes == number) | (self.passes < 0), self.pieces.owner, -1)
        return found

    def doubtful(self, off: Floats, total: Floats) -> Whole:
        """Which of some places, as far off as this without the steps and with them, are too far off by these alone."""
        return np.flatnonzero((off <= LIMIT) & (total > LIMIT))

    def steps(self, at: int) -> Floats:
        """The controller's places on a piece, mm (m, 2)."""
        piece = self.laid[int(self.rows[at])]
        found = np.frombuffer(trace_array(piece.block), np.int64).reshape(-1, 2)
        return (found - piece.block.start + piece.start) / 1000


class _Wanted:
    """Where the wire of each route should be: beside its contour by one of its R, or on a way from or to a hole."""

    def __init__(self, contours: Pieces, routes: list[PlannedContour], offsets: Floats) -> None:
        self.contours = contours
        self.routes = routes
        #: How far beside its contour, in each of its passes.
        self.aside = np.abs(offsets)
        self.is_open = np.array([not route.contour.is_closed for route in routes])

    @cached_property
    def leads(self) -> Pieces:
        """The ways between start holes and contours."""
        return Pieces((piece, at) for at, route in enumerate(self.routes) for piece in _lead_pieces(route))

    def off_leads(self, places: Floats, owners: Whole) -> Floats:
        """How far places are from the ways of their routes."""
        return self.leads.nearest(places, owners, 2 * LIMIT).own if len(places) else np.empty(0)

    def beside(self, owners: Whole, passes: Whole) -> Floats:
        """How far places are to be from their contours: in their pass, or in any (passes of -1)."""
        found, known = self.aside[owners], passes >= 0
        if found.shape[1] == 1:
            return found
        found[known] = found[known, passes[known]][:, None]
        return found

    def off_by(self, places: Floats, owners: Whole, passes: Whole, near: Nearest) -> tuple[Floats, np.ndarray]:
        """How far places are from where they should be, and which run into their own contour."""
        aside = self.beside(owners, passes)
        off = np.abs(near.own[:, None] - aside).min(1)
        # (a start hole may be nearer than the first pass)
        into = near.own < self.aside[owners].min(1) - LIMIT
        # The wire of an open contour begins on it and goes aside.
        begins = np.flatnonzero(into & self.is_open[owners])
        into[begins] = self.off_leads(places[begins], owners[begins]) > LIMIT
        doubtful = np.flatnonzero((off > _USUAL) & ~into)
        off[doubtful] = np.minimum(off[doubtful], self.off_leads(places[doubtful], owners[doubtful]))
        doubtful = doubtful[off[doubtful] > _USUAL]
        corners = _off_corners(
            places[doubtful], owners[doubtful], self.contours, aside[doubtful], near.own_at[doubtful]
        )
        off[doubtful] = np.minimum(off[doubtful], corners)
        return off, into

    def off_steps(self, steps: Floats, owner: int, number: int, widest: float) -> float:
        """How far the controller's steps on a piece of a route's wire are from where they should be in a pass, at
        most."""
        owners, passes = np.full(len(steps), owner), np.full(len(steps), number)
        near = self.contours.nearest(steps, owners, widest + 2 * LIMIT)
        return float(self.off_by(steps, owners, passes, near)[0].max())


def _passes(passes: tuple[int, ...], route: PlannedContour, ends: Floats) -> Whole:
    """Which of several passes pieces belong to that end at some places: a pass ends in a start hole."""
    holes = np.array([route.start, route.tab_hole] if route.tab else [route.start])
    is_last = (np.hypot(*(ends[:, None] - holes).T) < _HOLE).any(0)
    if is_last.sum() != len(passes):
        return np.full(len(ends), -1)
    return np.array(passes)[np.cumsum(is_last) - is_last]


def _beside(
    path: _WirePath, contours: Pieces, routes: list[PlannedContour], offsets: Floats, widest: float
) -> tuple[list[Misfit], list[Crossing], float]:
    """Whether every place of the wire lies as far beside its contour as it should."""
    wire = path.pieces
    wanted = _Wanted(contours, routes, offsets)
    faults: dict[int, Misfit] = {}
    near_others: list[tuple[Whole, Whole]] = []
    worst = 0.0
    is_open = wanted.is_open
    least = wanted.aside.min(1)
    # What is cut on its line takes as much away on each side as the wire beside the other contours.
    is_on = is_open & (least == 0)
    least[is_on] = least.max()
    spacing = _spacing(wire, widest)
    # Between two places the wire may be as much nearer to a corner.
    slack = hypot(widest, spacing / 2) - widest + LIMIT if widest else 0.0
    for which, part in wire.batches(spacing, 2):
        places, owners = wire.at(which, part), wire.owner[which]
        near = contours.nearest(places, owners, widest + slack + 2 * LIMIT)
        passes = path.passes[which]
        off, into = wanted.off_by(places, owners, passes, near)
        total = off + path.aside[which]
        for at in np.unique(which[path.doubtful(off, total)]).tolist():
            total[which == at] = wanted.off_steps(path.steps(at), wire.owner[at], path.passes[at], widest)
        for owner, at in _first_of_each(owners, (total > LIMIT) | into):
            misses = abs(wanted.aside[owner].min() - near.own[at]) if into[at] else total[at]
            faults.setdefault(owner, Misfit(owner, _xy(places[at]), float(misses), bool(into[at])))
        close = np.flatnonzero(near.other < least[owners] + slack)
        near_others.append((which[close], np.unique(contours.owner[near.other_at[close]])))
        worst = max(worst, float(total[~into & np.isfinite(total)].max(initial=0.0)))
    empty = np.empty(0, np.int64)
    some, others = (np.concatenate(found) for found in zip((empty, empty), *near_others, strict=True))
    if is_on[wire.owner[some]].any():
        # (the nearest one may be an open one, too: there is no side that it could be spoiled on)
        others = np.concatenate((others, np.flatnonzero(~is_open)))
    is_right = np.array([route.widest * route.contour.area for route in routes])
    inner, outer = ~is_open & (is_right < 0), ~is_open & (is_right > 0)
    found = crossings(wire, np.unique(some), contours, others, least, LIMIT, inner, outer)
    return list(faults.values()), [one for one in found if not (is_on[one.route] and is_on[one.other])], worst


def _first_of_each(owners: Whole, mask: np.ndarray) -> Iterator[tuple[int, int]]:
    """The owners of places where something is so, each with the first one."""
    at = np.flatnonzero(mask)
    found, first = np.unique(owners[at], return_index=True)
    return zip(found.tolist(), at[first].tolist(), strict=True)


def _xy(place: Floats) -> XY:
    return float(place[0]), float(place[1])


def _far(places: Floats, others: Floats) -> Floats:
    return np.hypot(*(places - others).T)


def _off_corners(places: Floats, owners: Whole, contours: Pieces, wanted: Floats, own_at: Whole) -> Floats:
    """How far places outside of sharp corners are from where they should be: beside a line or circle there. `own_at`:
    the piece that is nearest to each, -1 where it is not within R."""
    off = np.full(len(places), np.inf)
    reach = max(float(wanted.max(initial=0.0)), LIMIT)
    left = np.arange(len(places))
    while True:
        found = own_at >= 0
        at, place = left[found], places[left][found]
        first = np.searchsorted(contours.owner, owners[at])
        count = np.searchsorted(contours.owner, owners[at], "right") - first
        nearest = own_at[found]
        # The corner of two pieces that a place is nearest to.
        is_behind = _far(place, contours.end[nearest]) < _far(place, contours.start[nearest])
        other = first + (nearest - first + np.where(is_behind, 1, -1)) % count
        before, after = np.where(is_behind, nearest, other), np.where(is_behind, other, nearest)
        corner = np.where(is_behind[:, None], contours.end[nearest], contours.start[nearest])
        ways = [contours.normal(piece, np.full(len(piece), end)) for piece, end in ((before, 1.0), (after, 0.0))]
        bend = _bend(*ways)
        # Where two lines meet the wire is R / cos(bend / 2) from the corner; arcs may take it a little further.
        is_there = _far(place, corner) * bend <= _TIP * wanted[at].max(1, initial=0.0) + LIMIT
        for piece in (before, after):
            carrier = np.abs(contours.from_carrier(place, piece)[:, None] - wanted[at]).min(1)
            off[at] = np.minimum(off[at], np.where(is_there, carrier, np.inf))
        left = left[~found]
        if not len(left) or reach > _FAR * wanted.max():
            return off
        left = left[_by_tips(places[left], owners[left], contours, wanted, reach)]
        if not len(left):
            return off
        reach *= 6
        own_at = contours.nearest(places[left], owners[left], reach).own_at


def _by_tips(places: Floats, owners: Whole, contours: Pieces, wanted: Floats, reach: float) -> Whole:
    """Which places are so near to a sharp corner of their contour as the wire may be that goes around it there; those
    of corners where that is not beyond a reach are left out."""
    # (a path may have a million corners: only those of the contours that the places are beside)
    whose = np.unique(owners)
    first = np.searchsorted(contours.owner, whose)
    count = np.searchsorted(contours.owner, whose, "right") - first
    number = numbers_up_to(count)
    before = np.repeat(first, count) + number
    after = np.repeat(first, count) + (number + 1) % np.repeat(count, count)
    bend = _bend(contours.normal(before, np.ones(len(before))), contours.normal(after, np.zeros(len(after))))
    tip = (_TIP * wanted.max() + LIMIT) / np.maximum(bend, 1 / _FAR)
    is_sharp = tip > reach
    sharp, tip = before[is_sharp], tip[is_sharp]
    if not len(sharp):
        return sharp
    tree = shapely.STRtree(shapely.points(contours.end[sharp]))
    place, corner = tree.query(shapely.points(places), predicate="dwithin", distance=float(tip.max()))
    is_near = _far(places[place], contours.end[sharp[corner]]) <= tip[corner]
    return np.unique(place[is_near & (owners[place] == contours.owner[sharp[corner]])])


def _bend(one: Floats, other: Floats) -> Floats:
    """The cosine of half the angle between unit vectors."""
    return np.sqrt(np.maximum(0, (1 + (one * other).sum(1)) / 2))


def _in_tabs(contours: Pieces, routes: list[PlannedContour]) -> np.ndarray:
    """Which of the pieces of the contours are cut in the last pass alone."""
    found = np.zeros(len(contours.owner), bool)
    ends = np.searchsorted(contours.owner, np.arange(len(routes)), "right")
    for end, route in zip(ends.tolist(), routes, strict=True):
        if route.tab:
            tab = Pieces((path, 0) for path in _paths(_parts(route)[1]))
            found[end - len(tab.owner) : end] = True
    return found


def _free(contours: Pieces, which: Whole, part: Floats, aside: Floats) -> np.ndarray:
    """Whether the wire can be aside of places of contours: nothing of their own is nearer, and it would not be past
    another piece (in a cusp, where one goes back along the other)."""
    # (of an end a hair within the piece: there it is told which of two is nearer)
    margin = _INSIDE / np.maximum(contours.length[which], 2 * _INSIDE)
    part = np.clip(part, margin, 1 - margin)
    places = contours.at(which, part) + aside[:, None] * contours.normal(which, part)
    near = contours.nearest(places, contours.owner[which], float(np.abs(aside).max(initial=0.0)))
    # (chords lie a little inside of their curve; of lines it would be 30 um where two all but parallel ones meet)
    free = near.own > np.abs(aside) - np.where(contours.is_chord[which], LIMIT / 10, _TIGHT)
    others = np.flatnonzero(free & (near.own_at >= 0) & (near.own_at != which))
    piece = near.own_at[others]
    # (nor may what is across a slot be any nearer, which becomes too narrow all but unnoticed)
    is_across = (
        contours.normal(piece, contours.part(places[others], piece)) * contours.normal(which[others], part[others])
    ).sum(1) < 0
    free[others[is_across & (near.own[others] < np.abs(aside[others]) - _TIGHT)]] = False
    # (what is nearest to a place beyond a piece's end tells nothing)
    is_beside = np.abs(contours.from_carrier(places[others], piece) - near.own[others]) < _NOISE
    is_past = contours.right_of(places[others], piece) * aside[others] < -_NOISE
    free[others[is_beside & is_past]] = False
    return free


def _by_inner_corners(wire: Pieces, contours: Pieces, widest: float) -> tuple[Whole, Floats]:
    """Places of contours, by pieces and parts, a little to both sides of where the wire is beside them in its inner
    corners: it may turn off too early there, before a step that is lower than R."""
    before = np.flatnonzero(wire.owner[1:] == wire.owner[:-1])
    # (a wire that turns by less leaves nothing)
    one, other = (wire.normal(at, np.full(len(at), end)) for at, end in ((before, 1.0), (before + 1, 0.0)))
    turns = np.abs(cross(one.T, other.T)) > _TURN
    before, one, other = before[turns], one[turns], other[turns]
    near = contours.nearest(wire.end[before], wire.owner[before], widest + 2 * LIMIT)
    is_there = (near.own_at >= 0) & ~contours.is_chord[near.own_at]
    before, one, other, which = before[is_there], one[is_there], other[is_there], near.own_at[is_there]
    part = contours.part(wire.end[before], which)
    away = wire.end[before] - contours.at(which, part)
    # (the wire's way is square to its normal)
    is_inner = cross((other - one).T, away.T) > 0
    which, part, aside = which[is_inner], part[is_inner], 2 * LIMIT / contours.length[which[is_inner]]
    part = np.concatenate((part - aside, part + aside))
    is_on = (part > 0) & (part < 1)
    return np.tile(which, 2)[is_on], part[is_on]


def _reached(
    path: _WirePath, contours: Pieces, in_tabs: np.ndarray, offsets: Floats, widest: float
) -> tuple[list[Misfit], float]:
    """Whether the wire has been beside every place of the contours that it can reach."""
    faults: dict[tuple[int, int], Misfit] = {}
    worst = 0.0
    wires = [path.of_pass(number) for number in range(offsets.shape[1])]
    places = contours.batches(_spacing(contours, widest), 2)
    for which, part in chain(places, [_by_inner_corners(path.pieces, contours, widest)] if widest else []):
        # (a chord of a curve is square to it in its middle alone)
        true = ~contours.is_chord[which] | (part > 0) & (part < 1)
        which, part = which[true], part[true]
        owners = contours.owner[which]
        on, square = contours.at(which, part), contours.normal(which, part)
        for number, r in enumerate(offsets.T):
            aside = r[owners]
            places = on + aside[:, None] * square
            free = _free(contours, which, part, aside) if widest else np.ones(len(places), bool)
            if number + 1 < offsets.shape[1]:
                free &= ~in_tabs[which]
            places = places[free]
            near = wires[number].nearest(places, owners[free], 2 * LIMIT)
            off = near.own.copy()
            is_near = near.own_at >= 0
            off[is_near] += path.aside[near.own_at[is_near]]
            for at in path.doubtful(near.own, off).tolist():
                off[at] = np.hypot(*(path.steps(int(near.own_at[at])) - places[at]).T).min()
            for owner, at in _first_of_each(owners[free], off > LIMIT):
                found = Misfit(owner, _xy(places[at]), float(off[at]), is_missed=off[at] == np.inf)
                faults.setdefault((number, owner), found)
            worst = max(worst, float(off[np.isfinite(off)].max(initial=0.0)))
    return [faults[key] for key in sorted(faults)], worst
