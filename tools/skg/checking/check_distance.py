"""The first half of the check: every place of the wire lies at its distance beside the contour.

At a sharp corner, outside, it lies so beside the line or circle there, and elsewhere on a way between start hole and
contour. What comes near to other contours is gathered, too.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from math import cos, sin

import numpy as np
import shapely

from skg.checking.gouges import Crossing, crossings
from skg.checking.wire_path import LIMIT, Beside, Misfit, Share, WirePath, first_of_each, place_of
from skg.geometry.arrays import Floats, Whole, numbers_up_to
from skg.geometry.piece import Piece
from skg.geometry.pieces import Bare, Nearest, Pieces
from skg.geometry.plane import XY
from skg.planning.planned import PlannedContour
from skg.planning.runs import Lead

#: Rounding takes a block's end up to this far, mm: where it is further off there may be a reason.
_USUAL = 0.0008
#: At a sharp corner, outside, the wire is no further from it than so often what it is where two lines meet.
_TIP = 2.0
#: No corner is so sharp that the wire is looked for further from it than about so often R.
_FAR = 1000


def off_contours(path: WirePath, share: Share, beside: Beside) -> tuple[list[Misfit], list[tuple[Whole, Whole]], float]:
    """The first place of each contour where its wire is not as far beside it as it should be; which pieces of
    the wire come near to other contours, and to which; how far it is off at most, mm, but where it runs into its own
    contour."""
    wire, nominal = path.pieces, share.nominal
    wanted = _Wanted(share, beside)
    faults: dict[int, Misfit] = {}
    near_others: list[tuple[Whole, Whole]] = []
    worst = 0.0
    bare = _bare(path, share, beside)
    for which, part in wire.batches(beside.wire_spacing, 2, some=share.wire, bare=bare):
        places, owners = wire.at(which, part), wire.owner[which]
        near = nominal.nearest(places, owners, beside.reach)
        passes = path.passes[which]
        off, into = wanted.off_by(places, owners, passes, near)
        total = off + path.aside[which]
        for at in np.unique(which[path.doubtful(off, total)]).tolist():
            total[which == at] = wanted.off_steps(path.steps(at), wire.owner[at], path.passes[at])
        for owner, at in first_of_each(owners, (total > LIMIT) | into):
            misses = abs(beside.aside[owner].min() - near.own[at]) if into[at] else total[at]
            faults.setdefault(owner, Misfit(owner, place_of(places[at]), float(misses), bool(into[at])))
        close = np.flatnonzero(near.other < beside.least[owners] + beside.slack)
        near_others.append((which[close], np.unique(nominal.owner[near.other_at[close]])))
        worst = max(worst, float(total[~into & np.isfinite(total)].max(initial=0.0)))
    return list(faults.values()), near_others, worst


def _bare(path: WirePath, share: Share, beside: Beside) -> Bare | None:
    """The straight pieces of the wire that have one line of their own contour beside them, and nothing else in reach,
    but at their ends: between these the distance from it changes evenly."""
    if not beside.widest:
        return None
    wire, nominal, end = path.pieces, share.nominal, 3 * beside.reach
    some, front, back = wire.middles(share.wire, beside.wire_spacing, end)
    reach = beside.reach
    line = nominal.alone(np.minimum(front, back) - reach, np.maximum(front, back) + reach, wire.owner[some])
    is_there = line >= 0
    some, front, back, line = some[is_there], front[is_there], back[is_there], line[is_there]
    sides, aside = [], beside.beside(wire.owner[some], path.passes[some])
    is_bare = np.ones(len(some), bool)
    off = np.zeros(aside.shape)
    for places in (front, back):
        part = nominal.part(places, line)
        is_bare &= (part > 0) & (part < 1)
        sides.append(nominal.right_of(places, line))
        off = np.maximum(off, np.abs(np.abs(sides[-1])[:, None] - aside))
    # (by the same R at both ends, and on the same side)
    is_bare &= (off <= _USUAL).any(1) & (sides[0] * sides[1] > 0)
    pieces = np.zeros(len(wire.length), bool)
    pieces[some[is_bare]] = True
    return Bare(pieces, end)


def into_others(
    path: WirePath,
    beside: Beside,
    near_others: Sequence[tuple[Whole, Whole]],
    contours: Callable[[Whole], Pieces],
) -> list[Crossing]:
    """Cuts into other contours, of what `off_contours` has found to be near; `contours`: see `crossings`."""
    wire, is_on, is_open = path.pieces, beside.is_on, beside.is_open
    empty = np.empty(0, np.int64)
    some, others = (np.concatenate(found) for found in zip((empty, empty), *near_others, strict=True))
    if is_on[wire.owner[some]].any():
        # (the nearest one may be an open one, too: there is no side that it could be spoiled on)
        others = np.concatenate((others, np.flatnonzero(~is_open)))
    is_right = np.array([planned.widest * planned.contour.area for planned in beside.contours])
    inner, outer = ~is_open & (is_right < 0), ~is_open & (is_right > 0)
    cuts = crossings(wire, np.unique(some), contours, others, beside.least, inner, outer)
    return [cut for cut in cuts if not (is_on[cut.contour] and is_on[cut.other])]


class _Wanted:
    """The wire's intended path: beside its contour by one of its R, or on a way from or to a hole."""

    def __init__(self, share: Share, beside: Beside) -> None:
        self.share = share
        self.nominal = share.nominal
        self.beside = beside
        self.contours, self.aside, self.is_open = beside.contours, beside.aside, beside.is_open
        self.reach = beside.widest + 2 * LIMIT

    @cached_property
    def leads(self) -> Pieces:
        """The ways between start holes and contours."""
        some = self.share.numbers
        return Pieces(
            (piece, number)
            for number, planned in enumerate(self.contours[some], some.start)
            for piece in _lead_pieces(planned)
        )

    def off_leads(self, places: Floats, owners: Whole) -> Floats:
        """Distance of places from the leads to their contours."""
        return self.leads.nearest(places, owners, 2 * LIMIT).own if len(places) else np.empty(0)

    def off_by(self, places: Floats, owners: Whole, passes: Whole, near: Nearest) -> tuple[Floats, np.ndarray]:
        """Distance of places from the intended path, and which of them run into their own contour."""
        aside = self.beside.beside(owners, passes)
        off = np.abs(near.own[:, None] - aside).min(1)
        # (a start hole may be nearer than the first pass)
        into = near.own < self.aside[owners].min(1) - LIMIT
        # The wire of an open contour begins on it and goes aside.
        begins = np.flatnonzero(into & self.is_open[owners])
        into[begins] = self.off_leads(places[begins], owners[begins]) > LIMIT
        doubtful = np.flatnonzero((off > _USUAL) & ~into)
        off[doubtful] = np.minimum(off[doubtful], self.off_leads(places[doubtful], owners[doubtful]))
        doubtful = doubtful[off[doubtful] > _USUAL]
        # (of what is beyond the reach the nearest may not have been seen)
        own_at = np.where(near.own[doubtful] <= self.reach, near.own_at[doubtful], -1)
        corners = _off_corners(places[doubtful], owners[doubtful], self.nominal, aside[doubtful], own_at)
        off[doubtful] = np.minimum(off[doubtful], corners)
        return off, into

    def off_steps(self, steps: Floats, owner: int, number: int) -> float:
        """Distance of the controller's steps on a piece of a contour's wire from the intended path in a pass, at
        most."""
        owners, passes = np.full(len(steps), owner), np.full(len(steps), number)
        near = self.nominal.nearest(steps, owners, self.reach)
        return float(self.off_by(steps, owners, passes, near)[0].max())


def _lead_pieces(planned: PlannedContour) -> Iterator[Piece]:
    """The ways between start holes and a contour that its wire may take."""
    for run in planned.runs():
        if not (run.into and run.out):
            begin = run.edges[0]
            yield _straight(planned.start, begin.start, begin.direction(), run.offset)
            continue
        for lead in (run.into, run.out):
            # (a straight one is the same way in and out)
            for is_in in (True, False)[: 1 + lead.is_arc]:
                yield from _one_lead(lead, run.offset, is_in)


def _straight(hole: XY, entry: XY, heading: float, r: float) -> Piece:
    """The way from a hole to beside an entry that is passed in a direction (radians)."""
    # The contour's right is where R is positive.
    return Piece(hole, (entry[0] + r * sin(heading), entry[1] - r * cos(heading)))


def _one_lead(lead: Lead, r: float, is_in: bool) -> Iterator[Piece]:
    if lead.home:
        yield Piece(lead.home, lead.hole)
    if not lead.is_arc:
        yield _straight(lead.hole, lead.entry, lead.heading, r)
        return
    arc = lead.arc(is_in)
    part = 1 - abs(r) / arc.radius

    def inner(place: XY) -> XY:
        (x, y), (u, v) = lead.hole, place
        return x + part * (u - x), y + part * (v - y)

    yield Piece(inner(arc.start), inner(arc.end), arc.centre, arc.sweep)
    yield Piece(lead.hole, inner(arc.start if is_in else arc.end))


def _off_corners(places: Floats, owners: Whole, nominal: Pieces, wanted: Floats, own_at: Whole) -> Floats:
    """Distance of places outside of sharp corners from the intended path beside a line or circle there. `own_at`:
    the piece that is nearest to each, -1 where it is not within R."""
    off = np.full(len(places), np.inf)
    reach = max(float(wanted.max(initial=0.0)), LIMIT)
    left = np.arange(len(places))
    while True:
        is_known = own_at >= 0
        known, place = left[is_known], places[left][is_known]
        first = np.searchsorted(nominal.owner, owners[known])
        count = np.searchsorted(nominal.owner, owners[known], "right") - first
        nearest = own_at[is_known]
        # The corner of two pieces that a place is nearest to.
        is_behind = _far(place, nominal.end[nearest]) < _far(place, nominal.start[nearest])
        other = first + (nearest - first + np.where(is_behind, 1, -1)) % count
        before, after = np.where(is_behind, nearest, other), np.where(is_behind, other, nearest)
        corner = np.where(is_behind[:, None], nominal.end[nearest], nominal.start[nearest])
        ways = [nominal.normal(piece, np.full(len(piece), end)) for piece, end in ((before, 1.0), (after, 0.0))]
        bend = _bend(*ways)
        # Where two lines meet the wire is R / cos(bend / 2) from the corner; arcs may take it a little further.
        is_there = _far(place, corner) * bend <= _TIP * wanted[known].max(1, initial=0.0) + LIMIT
        for piece in (before, after):
            carrier = np.abs(nominal.from_carrier(place, piece)[:, None] - wanted[known]).min(1)
            off[known] = np.minimum(off[known], np.where(is_there, carrier, np.inf))
        left = left[~is_known]
        if not len(left) or reach > _FAR * wanted.max():
            return off
        left = left[_by_tips(places[left], owners[left], nominal, wanted, reach)]
        if not len(left):
            return off
        reach *= 6
        own_at = nominal.nearest_own(places[left], owners[left], reach)


def _by_tips(places: Floats, owners: Whole, nominal: Pieces, wanted: Floats, reach: float) -> Whole:
    """Mark places as near to a sharp corner of their contour as a wire that goes around it; those
    of corners where that is not beyond a reach are left out."""
    # (a path may have a million corners: only those of the contours that the places are beside)
    whose = np.unique(owners)
    first = np.searchsorted(nominal.owner, whose)
    count = np.searchsorted(nominal.owner, whose, "right") - first
    number = numbers_up_to(count)
    before = np.repeat(first, count) + number
    after = np.repeat(first, count) + (number + 1) % np.repeat(count, count)
    bend = _bend(nominal.normal(before, np.ones(len(before))), nominal.normal(after, np.zeros(len(after))))
    tip = (_TIP * wanted.max() + LIMIT) / np.maximum(bend, 1 / _FAR)
    is_sharp = tip > reach
    sharp, tip = before[is_sharp], tip[is_sharp]
    if not len(sharp):
        return sharp
    tree = shapely.STRtree(shapely.points(nominal.end[sharp]))
    place, corner = tree.query(shapely.points(places), predicate="dwithin", distance=float(tip.max()))
    is_near = _far(places[place], nominal.end[sharp[corner]]) <= tip[corner]
    return np.unique(place[is_near & (owners[place] == nominal.owner[sharp[corner]])])


def _far(places: Floats, others: Floats) -> Floats:
    return np.hypot(*(places - others).T)


def _bend(vectors: Floats, others: Floats) -> Floats:
    """The cosine of half the angle between unit vectors."""
    return np.sqrt(np.maximum(0, (1 + (vectors * others).sum(1)) / 2))
