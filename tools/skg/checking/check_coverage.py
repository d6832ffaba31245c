"""The second half of the check: the wire was beside every place of the contours that it can reach."""

from __future__ import annotations

from itertools import chain

import numpy as np

from skg.checking.wire_path import LIMIT, Beside, Misfit, Share, WirePath, first_of_each, place_of
from skg.geometry.arrays import Flags, Floats, Whole
from skg.geometry.pieces import Bare, Pieces

#: A place at the end of a piece is looked at so far within it; what is less apart is the same place, mm.
_INSIDE, _NOISE = 1e-3, 1e-9
#: A slot of lines and arcs that is narrower than two R by less than twice this is wide enough, mm.
_TIGHT = 1e-5
#: Where the sine of the wire's turn is less, it leaves nothing in an inner corner.
_TURN = 0.1
#: Places on a curve that are looked at are about so far apart at most, mm.
_ALONG = 0.1


def not_reached(
    path: WirePath, share: Share, beside: Beside, in_tabs: Flags, along: float
) -> tuple[dict[tuple[int, int], Misfit], float, float]:
    """The first place beside its contour where the wire could be and was not, by pass and contour, and how far it was
    from such places at most, mm. `along`: the length of the curves before those of the share, and in the result of
    these too, mm."""
    nominal, widest, passes = share.nominal, beside.widest, beside.passes
    faults: dict[tuple[int, int], Misfit] = {}
    worst = 0.0
    looked_at, along = _looked_at(share, min(beside.spacing, _ALONG), along)
    places = nominal.batches(beside.spacing, 2, some=looked_at, bare=_bare(share, beside, looked_at))
    for which, part in chain(places, [_by_inner_corners(path.pieces, share, widest)] if widest else []):
        # (a chord of a curve is square to it in its middle alone)
        true = ~nominal.is_chord[which] | (part > 0) & (part < 1)
        which, part = which[true], part[true]
        owners = nominal.owner[which]
        on, square = nominal.at(which, part), nominal.normal(which, part)
        for number, r in enumerate(beside.offsets.T):
            aside = r[owners]
            places = on + aside[:, None] * square
            free = has_room(nominal, which, part, aside) if widest else np.ones(len(places), bool)
            # (what is a tab until the last cuts is cut in these alone)
            is_cut = number < beside.cuts[owners]
            free &= is_cut & ((number >= passes[owners]) == in_tabs[which])
            places = places[free]
            near = beside.wires[number].nearest(places, owners[free], 2 * LIMIT)
            off = near.own.copy()
            is_near = near.own_at >= 0
            off[is_near] += path.aside[near.own_at[is_near]]
            for row in path.doubtful(near.own, off).tolist():
                off[row] = np.hypot(*(path.steps(int(near.own_at[row])) - places[row]).T).min()
            for owner, row in first_of_each(owners[free], off > LIMIT):
                fault = Misfit(owner, place_of(places[row]), float(off[row]), is_missed=off[row] == np.inf)
                faults.setdefault((number, owner), fault)
            worst = max(worst, float(off[np.isfinite(off)].max(initial=0.0)))
    return faults, worst, along


def _bare(share: Share, beside: Beside, some: Whole) -> Bare | None:
    """The lines beside which, but at their ends, the wire has room and one straight piece in reach in each pass."""
    if not beside.widest:
        return None
    nominal, end = share.nominal, 3 * beside.reach
    some, front, back = nominal.middles(some, beside.spacing, end)
    reach = 2 * beside.widest + LIMIT
    is_bare = (
        nominal.alone(np.minimum(front, back) - reach, np.maximum(front, back) + reach, nominal.owner[some]) == some
    )
    square = nominal.normal(some, np.zeros(len(some)))
    for number, r in enumerate(beside.offsets.T):
        aside = r[nominal.owner[some], None] * square
        ends = front + aside, back + aside
        low, high = np.minimum(*ends) - 2 * LIMIT, np.maximum(*ends) + 2 * LIMIT
        is_bare &= beside.wires[number].alone(low, high, nominal.owner[some]) >= 0
    pieces = np.zeros(len(nominal.length), bool)
    pieces[some[is_bare]] = True
    return Bare(pieces, end)


def _looked_at(share: Share, spacing: float, along: float) -> tuple[Whole, float]:
    """The pieces of a share's contours that are looked at, of the chords of curves the first of each contour, and those
    after every `spacing`, mm; and how long the curves are up to their end."""
    nominal, some = share.nominal, share.own
    is_chord, owner = nominal.is_chord[some], nominal.owner[some]
    ways = np.cumsum(np.append(along, np.where(is_chord, nominal.length[some], 0.0)))
    is_there = ~is_chord | (np.diff(np.floor(ways / spacing)) > 0) | (np.diff(owner, prepend=-1) != 0)
    return some[is_there], float(ways[-1])


def has_room(nominal: Pieces, which: Whole, part: Floats, aside: Floats) -> np.ndarray:
    """Tell whether the wire can be aside of places of contours: nothing of their own is nearer, and it would not be
    past another piece (in a cusp, where one goes back along the other)."""
    # (of an end a hair within the piece: there it is told which of two is nearer)
    margin = _INSIDE / np.maximum(nominal.length[which], 2 * _INSIDE)
    part = np.clip(part, margin, 1 - margin)
    places = nominal.at(which, part) + aside[:, None] * nominal.normal(which, part)
    near = nominal.nearest(places, nominal.owner[which], float(np.abs(aside).max(initial=0.0)))
    # (chords lie a little inside of their curve; of lines it would be 30 um where two all but parallel ones meet)
    free = near.own > np.abs(aside) - np.where(nominal.is_chord[which], LIMIT / 10, _TIGHT)
    others = np.flatnonzero(free & (near.own_at >= 0) & (near.own_at != which))
    piece = near.own_at[others]
    # (nor may what is across a slot be any nearer, which becomes too narrow all but unnoticed)
    is_across = (
        nominal.normal(piece, nominal.part(places[others], piece)) * nominal.normal(which[others], part[others])
    ).sum(1) < 0
    free[others[is_across & (near.own[others] < np.abs(aside[others]) - _TIGHT)]] = False
    # (what is nearest to a place beyond a piece's end tells nothing)
    is_beside = np.abs(nominal.from_carrier(places[others], piece) - near.own[others]) < _NOISE
    is_past = nominal.right_of(places[others], piece) * aside[others] < -_NOISE
    free[others[is_beside & is_past]] = False
    return free


def _cross(ways: Floats, others: Floats) -> Floats:
    """z of the vector products of ways (n, 2) and others."""
    (x, y), (u, v) = ways.T, others.T
    return x * v - y * u


def _by_inner_corners(wire: Pieces, share: Share, widest: float) -> tuple[Whole, Floats]:
    """Places of contours, by pieces and parts, a little to both sides of where the wire is beside them in its inner
    corners: it may turn off too early there, before a step that is lower than R."""
    nominal, owner = share.nominal, wire.owner[share.wire]
    before = share.wire[:-1][owner[1:] == owner[:-1]]
    # (a wire that turns by less leaves nothing)
    arriving = wire.normal(before, np.ones(len(before)))
    leaving = wire.normal(before + 1, np.zeros(len(before)))
    turns = np.abs(_cross(arriving, leaving)) > _TURN
    before, arriving, leaving = before[turns], arriving[turns], leaving[turns]
    near = nominal.nearest(wire.end[before], wire.owner[before], widest + 2 * LIMIT)
    is_there = (near.own_at >= 0) & ~nominal.is_chord[near.own_at]
    before, arriving, leaving, which = before[is_there], arriving[is_there], leaving[is_there], near.own_at[is_there]
    part = nominal.part(wire.end[before], which)
    away = wire.end[before] - nominal.at(which, part)
    # (the wire's way is square to its normal)
    is_inner = _cross(leaving - arriving, away) > 0
    which, part, aside = which[is_inner], part[is_inner], 2 * LIMIT / nominal.length[which[is_inner]]
    part = np.concatenate((part - aside, part + aside))
    is_on = (part > 0) & (part < 1)
    return np.tile(which, 2)[is_on], part[is_on]
