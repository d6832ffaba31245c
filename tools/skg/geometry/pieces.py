"""The pieces of a path nearest to places: many of both at once (numpy)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import pi
from threading import Lock

import numpy as np

from skg.geometry.arrays import Flags, Floats, Whole, columns_at, directions, hypots, numbers_up_to
from skg.geometry.edge_arrays import rows_of
from skg.geometry.index import Boxes, Index
from skg.geometry.piece import Piece

#: So many places on pieces are worked out together, and so many pieces turned into rows.
_PLACES, _ROWS = 50_000, 20_000
#: Long pieces stand in several boxes: for all together so many and so many a piece, but no more than the last.
_LEAST_BOXES, _BOXES, _MOST_BOXES = 1000, 16, 200_000


@dataclass(frozen=True)
class Nearest:
    """For m places: the distance to the nearest piece of the same owner, its number (-1: none within reach), and the
    distance to the nearest piece of another owner and its number."""

    own: Floats
    own_at: Whole
    other: Floats
    other_at: Whole


@dataclass(frozen=True)
class Bare:
    """Lines (marked among the pieces) between whose ends, each `end` long (mm), nothing has to be looked at."""

    pieces: Flags
    end: float


class Pieces:
    """n lines and arcs, each with an owner.

    They are given one by one, or as places (m, 2) with chords between them: those are `is_chord`, and left out where
    they have no length.
    """

    def __init__(self, pieces: Iterable[tuple[Piece | Floats, int]]) -> None:
        parts = list(_parts(pieces))
        self._room(sum(len(start) for start, *_ in parts))
        first = 0
        for start, end, owner, rounds in parts:
            some = slice(first, first + len(start))
            self.start[some], self.end[some], self.owner[some] = start, end, owner
            if rounds is None:
                self.is_chord[some] = True
            elif rounds.any():
                self.centre[some], self.radius[some] = rounds[:, 0:2], rounds[:, 2]
                self.first[some], self.sweep[some] = rounds[:, 3], rounds[:, 4]
            first = some.stop
        self._measure()

    @classmethod
    def of_columns(cls, start: Floats, end: Floats, centre: Floats, sweep: Floats, owner: Whole) -> Pieces:
        """Pieces as columns; where nothing is swept, a line."""
        result, is_arc = cls.__new__(cls), sweep != 0
        result.start, result.end, result.sweep, result.owner = start, end, sweep, owner
        result.centre = np.where(is_arc[:, None], centre, 0.0)
        result.radius, result.first = np.zeros((2, len(start)))
        result.is_chord = np.zeros(len(start), bool)
        out = start[is_arc] - centre[is_arc]
        result.radius[is_arc], result.first[is_arc] = hypots(*out.T), directions(out)
        result._measure()
        return result

    def _room(self, count: int) -> None:
        """Arrays of zeros for so many pieces (zeros that nobody writes to take no memory)."""
        self.start, self.end, self.centre = np.zeros((3, count, 2))
        self.radius, self.first, self.sweep = np.zeros((3, count))
        self.owner, self.is_chord = np.zeros(count, np.int64), np.zeros(count, bool)

    def _measure(self) -> None:
        self.is_arc = self.radius > 0
        way = self.end - self.start
        self.length = np.hypot(way[:, 0], way[:, 1])
        arcs = np.flatnonzero(self.is_arc)
        self.length[arcs] = self.radius[arcs] * np.abs(self.sweep[arcs])
        self._made: Index | None = None
        self._making = Lock()

    def at(self, which: Whole, part: Floats) -> Floats:
        """The places at parts of the lengths of pieces."""
        start = self.start[which]
        result = start + part[:, None] * (self.end[which] - start)
        arcs = np.flatnonzero(self.is_arc[which])
        arc = which[arcs]
        result[arcs] = self.centre[arc] + self.radius[arc, None] * self._out(arc, part[arcs])
        return result

    def normal(self, which: Whole, part: Floats) -> Floats:
        """Unit vectors to the right of travel at parts of the lengths of pieces."""
        way, length = self._chords(which)
        result = np.stack((way[:, 1], -way[:, 0]), 1) / length[:, None]
        arcs = np.flatnonzero(self.is_arc[which])
        arc = which[arcs]
        result[arcs] = self._out(arc, part[arcs]) * np.sign(self.sweep[arc])[:, None]
        return result

    def _chords(self, which: Whole) -> tuple[Floats, Floats]:
        """Vectors from the starts of pieces to their ends, and their lengths, none of them 0."""
        way = self.end[which] - self.start[which]
        return way, np.maximum(np.hypot(way[:, 0], way[:, 1]), 1e-300)

    def _out(self, arcs: Whole, part: Floats) -> Floats:
        """Unit vectors from the centres of arcs to parts of their lengths."""
        angle = self.first[arcs] + part * self.sweep[arcs]
        return np.stack((np.cos(angle), np.sin(angle)), 1)

    def part(self, places: Floats, which: Whole) -> Floats:
        """The part of the length of each place's piece where that is nearest (of an arc: the circle)."""
        to, way = places - self.start[which], self.end[which] - self.start[which]
        line = np.clip((to * way).sum(1) / np.maximum((way**2).sum(1), 1e-300), 0, 1)
        about = places - self.centre[which]
        ahead = (np.arctan2(about[:, 1], about[:, 0]) - self.first[which]) * np.sign(self.sweep[which])
        arc = np.mod(ahead, 2 * pi) / np.maximum(np.abs(self.sweep[which]), 1e-300)
        return np.where(self.is_arc[which], arc, line)

    def batches(
        self,
        spacing: float,
        least: int,
        turn: float = pi / 12,
        some: Whole | None = None,
        bare: Bare | None = None,
    ) -> Iterator[tuple[Whole, Floats]]:
        """Pieces, all or those with `some` numbers, and parts of them: both ends, and places no further apart than
        `spacing`, at least `least` spaces; on an arc no further than it takes to `turn` (radians). Some pieces after
        the other. In the middles of `bare` pieces are no places but their ends."""
        numbers = np.arange(len(self.length)) if some is None else some
        for low in range(0, len(numbers), _PLACES):
            few = numbers[low : low + _PLACES]
            spaces = self._spaces(few, spacing, least, turn)
            # (of a bare piece the last place of the first end, and how many come between it and the other end's)
            last, left_out = np.zeros((2, len(few)), np.int64)
            if bare is not None:
                at = np.flatnonzero(bare.pieces[few])
                last[at] = self._last_of_end(few[at], spaces[at], bare.end)
                left_out[at] = spaces[at] - 2 * last[at] - 1
            ends = np.cumsum(spaces + 1 - left_out)
            cuts = np.unique(np.searchsorted(ends, np.arange(0, ends[-1] + _PLACES, _PLACES), "right"))
            for begin, end in pairwise(cuts.tolist()):
                count = spaces[begin:end] + 1 - left_out[begin:end]
                which, number = np.repeat(np.arange(begin, end), count), numbers_up_to(count)
                number += left_out[which] * (number > last[which])
                yield few[which], number / spaces[which]

    def middles(self, some: Whole, spacing: float, end: float) -> tuple[Whole, Floats, Floats]:
        """Those of some pieces that are lines and much longer than two ends so long (mm), and the places between which
        their middles are: of those that `batches` has with such a spacing and two spaces."""
        long = some[~self.is_arc[some] & ~self.is_chord[some] & (self.length[some] > 4 * (end + spacing))]
        spaces = self._spaces(long, spacing, 2, pi / 12)
        part = self._last_of_end(long, spaces, end) / spaces
        return long, self.at(long, part), self.at(long, 1 - part)

    def _last_of_end(self, some: Whole, spaces: Whole, end: float) -> Whole:
        """The number of the place where a first end so long is over, of pieces that are divided by so many spaces."""
        return np.ceil(end * spaces / self.length[some]).astype(np.int64)

    def alone(self, low: Floats, high: Floats, owners: Whole) -> Whole:
        """The piece that comes into each of n boxes, when it is a line of that box's owner and no other piece does;
        else -1. (a piece may be told to come into a box that it passes by)"""
        first, is_one = np.full(len(low), -1), np.ones(len(low), bool)
        for box, piece in self.index().within(low, high):
            # (a stretch of the index takes in what is around a corner)
            ends = self.start[piece], self.end[piece]
            is_in = ((np.minimum(*ends) <= high[box]) & (np.maximum(*ends) >= low[box])).all(1) | self.is_arc[piece]
            box, piece = box[is_in], piece[is_in]
            unknown = first[box] < 0
            # (of several new ones of a box the last stays, which the others are not)
            first[box[unknown]] = piece[unknown]
            is_one[box[first[box] != piece]] = False
        known = np.flatnonzero(is_one & (first >= 0))
        is_fit = ~self.is_arc[first[known]] & (self.owner[first[known]] == owners[known])
        result = np.full(len(low), -1)
        result[known[is_fit]] = first[known[is_fit]]
        return result

    def _spaces(self, some: Whole, spacing: float, least: int, turn: float) -> Whole:
        """In how many spaces places divide each of some pieces."""
        turns = np.ceil(np.abs(self.sweep[some]) / turn) * self.is_arc[some]
        return np.maximum(np.maximum(np.ceil(self.length[some] / spacing), turns), least).astype(np.int64)

    def from_place(self, places: Floats, which: Whole) -> Floats:
        """Distance of each place from its piece."""
        result = np.empty(len(places))
        is_arc = self.is_arc[which]
        for mask, measure in ((~is_arc, self._from_line), (is_arc, self._from_arc)):
            result[mask] = measure(places[mask], which[mask])
        return result

    def _from_line(self, places: Floats, which: Whole) -> Floats:
        (x, y), (u, v) = columns_at(self.start, which), columns_at(self.end, which)
        to_x, to_y = places[:, 0] - x, places[:, 1] - y
        u, v = u - x, v - y
        part = np.clip((to_x * u + to_y * v) / np.maximum(u * u + v * v, 1e-300), 0, 1)
        return np.hypot(to_x - part * u, to_y - part * v)

    def _from_arc(self, places: Floats, which: Whole) -> Floats:
        x, y = (column - middle for column, middle in zip(places.T, columns_at(self.centre, which), strict=True))
        ahead = (np.arctan2(y, x) - self.first[which]) * np.sign(self.sweep[which])
        result = np.abs(np.hypot(x, y) - self.radius[which])
        beyond = np.flatnonzero(np.mod(ahead, 2 * pi) > np.abs(self.sweep[which]))
        which, places = which[beyond], places[beyond]
        ends = (columns_at(side, which) for side in (self.start, self.end))
        result[beyond] = np.minimum(*(np.hypot(places[:, 0] - x, places[:, 1] - y) for x, y in ends))
        return result

    def from_carrier(self, places: Floats, which: Whole) -> Floats:
        """Distance of each place from the whole line or circle that its piece lies on."""
        return np.abs(self.right_of(places, which))

    def right_of(self, places: Floats, which: Whole) -> Floats:
        """Distance of each place to the right of the whole line or circle of its piece, negative to the left."""
        to = places - self.start[which]
        way, length = self._chords(which)
        line = (to[:, 1] * -way[:, 0] + to[:, 0] * way[:, 1]) / length
        about = places - self.centre[which]
        arc = (np.hypot(about[:, 0], about[:, 1]) - self.radius[which]) * np.sign(self.sweep[which])
        return np.where(self.is_arc[which], arc, line)

    def nearest(self, places: Floats, owners: Whole, reach: float) -> Nearest:
        """Find the nearest pieces within `reach` of each of m places, and maybe a little beyond; `owners`: of the
        places."""
        result = Nearest(*(np.full(len(places), nothing) for nothing in (np.inf, -1, np.inf, -1)))
        if not len(self.length) or not len(places):
            return result
        for of, which in self.index().within(places - reach, places + reach):
            far = self.from_place(places[of], which)
            own = self.owner[which] == owners[of]
            _keep_nearest(far[own], of[own], which[own], result.own, result.own_at)
            _keep_nearest(far[~own], of[~own], which[~own], result.other, result.other_at)
        return result

    def nearest_own(self, places: Floats, owners: Whole, reach: float) -> Whole:
        """The `own_at` of `nearest`, but nothing beyond the reach, of pieces that stand in the order of their owners:
        what others own is not looked at, which takes long where a wide reach has much of it."""
        whose = np.unique(owners)
        first = np.searchsorted(self.owner, whose)
        count = np.searchsorted(self.owner, whose, "right") - first
        numbers = np.repeat(first, count) + numbers_up_to(count)
        if 2 * len(numbers) > len(self.length):
            near = self.nearest(places, owners, reach)
            return np.where(near.own <= reach, near.own_at, -1)
        near = self.some(numbers).nearest(places, owners, reach)
        return np.where(near.own <= reach, np.append(numbers, -1)[near.own_at], -1)

    def some(self, numbers: Whole) -> Pieces:
        """Some of the pieces."""
        result = Pieces.__new__(Pieces)
        for name in ("start", "end", "centre", "radius", "first", "sweep", "owner", "is_chord"):
            setattr(result, name, getattr(self, name)[numbers])
        result._measure()
        return result

    def index(self) -> Index:
        """The pieces by place."""
        # (who comes while another thread is making it waits for it)
        with self._making:
            if self._made is None:
                self._made = Index(self._boxes())
            return self._made

    def _boxes(self) -> Iterator[Boxes]:
        """The boxes around parts of the pieces, so short that little else comes into these."""
        count = min(_MOST_BOXES, _LEAST_BOXES + _BOXES * len(self.length))
        for which, part in self.batches(float(self.length.sum()) / count or 1.0, 1, pi / 4):
            is_part = which[1:] == which[:-1]
            piece = which[1:][is_part]
            places = self.at(which, part)
            # (an arc leaves the chord of a part that it turns in by a little)
            bulge = self.radius[piece] * (1 - np.cos(np.diff(part)[is_part] * self.sweep[piece] / 2))
            ends = places[:-1][is_part], places[1:][is_part]
            low, high = np.minimum(*ends) - bulge[:, None], np.maximum(*ends) + bulge[:, None]
            yield Boxes(low, high, piece, self.owner[piece])


#: Pieces that follow each other: starts, ends, whose they are; centre, radius, first angle and sweep, None of chords.
_Part = tuple[Floats, Floats, Whole | int, Floats | None]


def _parts(pieces: Iterable[tuple[Piece | Floats, int]]) -> Iterator[_Part]:
    some: list[tuple[Piece, int]] = []
    for piece, owner in pieces:
        if isinstance(piece, Piece):
            some.append((piece, owner))
        if some and (len(some) == _ROWS or not isinstance(piece, Piece)):
            yield _lines_and_arcs(some)
            some.clear()
        if not isinstance(piece, Piece):
            is_there = (piece[:-1] != piece[1:]).any(1)
            # (where all are, nothing is copied)
            starts, ends = (piece[:-1], piece[1:]) if is_there.all() else (piece[:-1][is_there], piece[1:][is_there])
            yield starts, ends, owner, None
    if some:
        yield _lines_and_arcs(some)


def _lines_and_arcs(some: list[tuple[Piece, int]]) -> _Part:
    rows = rows_of([piece for piece, _ in some])
    return rows[:, 0:2], rows[:, 2:4], np.array([owner for _, owner in some], np.int64), rows[:, 4:]


def _keep_nearest(far: Floats, place: Whole, which: Whole, distance: Floats, nearest: Whole) -> None:
    """Keep the nearest of the pieces that were looked at for each place, where it is nearer than the one known."""
    if not len(far):
        return
    begins = np.flatnonzero(np.diff(place, prepend=-1))
    least = np.minimum.reduceat(far, begins)
    is_least = far == np.repeat(np.minimum(least, distance[place[begins]]), np.diff(begins, append=len(place)))
    distance[place[is_least]] = far[is_least]
    nearest[place[is_least]] = which[is_least]


def spread(spaces: Whole, begin: int, end: int) -> tuple[Whole, Floats]:
    """The pieces from one number up to another, each as often as it has places, and the parts where these are."""
    count = spaces[begin:end]
    which = np.repeat(np.arange(begin, end), count + 1)
    return which, numbers_up_to(count + 1) / spaces[which]
