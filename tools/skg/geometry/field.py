"""Distances to the contours around a place: by their boxes, then by their chords (numpy; shapely finds boxes)."""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from math import inf

import numpy as np
import shapely

from skg.geometry.arrays import Flags, Floats, Whole, columns_at, numbers_up_to
from skg.geometry.contour import Contour
from skg.geometry.edge_arrays import points_of
from skg.geometry.plane import XY

#: So many chords that follow each other are looked for together; of these so many are looked at, or none of them.
_RUN, _PIECE = 32, 8
#: What is within a reach may seem to lie this much farther away, mm.
_HAIR = 1e-9
#: Areas that differ by less than this part of them are the same.
_ALIKE = 1e-9
#: So many pairs of a place and a chord are looked at together; those of contours of no more than so many points too.
_PAIRS, _FEW = 100_000, 200
#: Where a contour is looked across for places in it, parts of its height and of the width there: no corners lie there
#: but by chance.
_ACROSS, _NEAR_ENDS = (0.2873, 0.25), (0.0731, 0.05)
#: So many boxes are asked for the places in them together.
_BOXES = 1000

Measure = Callable[[Whole, Whole], Floats]


class Field:
    """All contours of a drawing, mm."""

    def __init__(self, contours: list[Contour]) -> None:
        self.contours = contours
        self._points, counts = points_of(contours)
        self._first = np.concatenate(([0], np.cumsum(counts)))
        # Runs of chords, and the pieces of these: from which point to which.
        runs, _ = _stretches(self._first[:-1], self._first[1:] - 1, _RUN)
        low, high = self._boxes(*runs)
        self._runs = shapely.STRtree(shapely.box(*low.T, *high.T))
        (self._low, self._high), self._pieces = _stretches(*runs, _PIECE)
        self._piece_boxes = self._boxes(self._low, self._high)

    def _boxes(self, first: Whole, last: Whole) -> tuple[Floats, Floats]:
        """The boxes around stretches of points: the smallest x and y of each, and the largest (n, 2)."""
        ends = self._points[last]
        if not len(ends):
            return ends, ends
        return tuple(of(of.reduceat(self._points, first), ends) for of in (np.minimum, np.maximum))

    def near(self, places: Floats, reach: Floats) -> Floats:
        """Distance of the nearest contour from each of n places (n, 2), mm: infinite where none is within its reach."""

        def measure(at: Whole, one: Whole) -> Floats:
            return _beside(*self._chords(at, places, one), reach[one])

        return self._look(places, places, reach + _HAIR, measure)

    def ahead(self, places: Floats, ways: Floats, reach: Floats, least: Floats) -> Floats:
        """Distance from each of n places along its way (n, 2; unit vectors) to the next contour, mm: infinite
        where none is within its reach. What is nearer than `least` is none."""

        def measure(at: Whole, one: Whole) -> Floats:
            return _ahead(*self._chords(at, places, one), *columns_at(ways, one), reach[one], least[one])

        return self._look(places, places + reach[:, None] * ways, np.full(len(places), _HAIR), measure)

    def before(self, places: Floats, ways: Floats, reach: Floats, least: Floats, wide: Floats) -> Floats:
        """Distance that a disc so wide on each side gets from each of n places along its way (n, 2; unit vectors)
        before it touches a contour, mm: from `least` on, infinite where it touches none within its reach."""

        def measure(at: Whole, one: Whole) -> Floats:
            return _before(*self._chords(at, places, one), *columns_at(ways, one), reach[one], least[one], wide[one])

        return self._look(places, places + reach[:, None] * ways, wide + _HAIR, measure)

    def _chords(self, at: Whole, places: Floats, one: Whole) -> tuple[Floats, Floats, Floats, Floats]:
        """The ways from where some chords begin to some places, and to where they end: x and y of each."""
        (x, y), (x1, y1), (x2, y2) = (
            columns_at(places, one),
            columns_at(self._points, at),
            columns_at(self._points, at + 1),
        )
        return x - x1, y - y1, x2 - x1, y2 - y1

    def _look(self, places: Floats, ends: Floats, aside: Floats, measure: Measure) -> Floats:
        """The least that is measured from each of n places to the chords in a box: around it and its end, and so far
        aside. `measure` is given which chords and which places."""
        result = np.full(len(places), inf)
        low, high = np.minimum(places, ends) - aside[:, None], np.maximum(places, ends) + aside[:, None]

        def look(first: int) -> None:
            """Look from some of the places."""
            some = slice(first, first + _BOXES)
            of, runs = self._runs.query(shapely.box(*low[some].T, *high[some].T))
            order = np.argsort(of, kind="stable")
            of, pieces = self._near_pieces(first + of[order], runs[order], low, high)
            chords = self._high[pieces] - self._low[pieces]
            for part in _batches(chords):
                counts = chords[part]
                at = np.repeat(self._low[pieces[part]], counts) + numbers_up_to(counts)
                one = np.repeat(of[part], counts)
                starts = np.flatnonzero(np.diff(one, prepend=-1))
                least = np.minimum.reduceat(measure(at, one), starts)
                result[one[starts]] = np.minimum(result[one[starts]], least)

        firsts = range(0, len(places), _BOXES)
        if len(firsts) > 1:
            with ThreadPoolExecutor(os.cpu_count()) as threads:
                # (numpy lets them run at the same time)
                list(threads.map(look, firsts))
        else:
            list(map(look, firsts))
        return result

    def _near_pieces(self, of: Whole, runs: Whole, low: Floats, high: Floats) -> tuple[Whole, Whole]:
        """Of places whose boxes, from `low` to `high`, some runs come into: the pieces of these runs that do."""
        counts = self._pieces[runs + 1] - self._pieces[runs]
        of, pieces = np.repeat(of, counts), np.repeat(self._pieces[runs], counts) + numbers_up_to(counts)
        is_in = np.ones(len(of), bool)
        for axis in (0, 1):
            least, most = (box[:, axis][pieces] for box in self._piece_boxes)
            is_in &= (least <= high[:, axis][of]) & (most >= low[:, axis][of])
        return of[is_in], pieces[is_in]

    def depths(self) -> list[int]:
        """Number of closed contours around each: they hold a place in it, and are larger.

        (Its corners may lie on its neighbours, and a smaller one that lies in it may hold the place.) One that crosses
        others takes something away where it does: it is looked at where an odd number of them lies around it.
        """
        number = len(self.contours)
        whose, of, holding = self._around_in(_ACROSS, np.ones(number, bool))
        depths = np.zeros(number, np.int64)
        counts = np.bincount(of, minlength=len(whose))
        # (an odd number goes before a larger even one)
        np.maximum.at(depths, whose, counts + counts % 2 * number)
        depths %= number
        # (a slot that another one crosses in its middle shows at its ends what it is)
        within = (depths > 0) & (depths % 2 == 0)
        if not within.any():
            return depths.tolist()
        whose, of, holding = self._around_in(_NEAR_ENDS, within)
        counts = np.bincount(of, minlength=len(whose))
        fewer = np.flatnonzero((counts % 2 == 1) & (counts < depths[whose]))
        depths[whose[fewer]] = counts[fewer]
        # (one that several others cover would be no part if it were one: these are cut across it)
        pairs, times = np.unique(whose[of] * number + holding, return_counts=True)
        covered = pairs[times == np.bincount(whose, minlength=number)[pairs // number]] // number
        covers = np.bincount(covered, minlength=number)
        covered = (covers % 2 == 1) & (depths % 2 == 0)
        depths[covered] = covers[covered]
        return depths.tolist()

    def _around_in(self, where: tuple[float, float], some: Flags) -> tuple[Whole, Whole, Whole]:
        """The contours that each of some places lies in, which are in some of the contours: whose these places are;
        of each pair of a place and a contour around it, larger than its own, both numbers."""
        whose, places = self._inner(*where)
        asked = some[whose]
        whose, places = whose[asked], places[asked]
        sizes = self._sizes()
        of, holding = self._holding(places, whose)
        # (of two that are as large as each other neither lies in the other: both would be openings, and none the part)
        large = sizes[holding] > sizes[whose[of]] * (1 + _ALIKE)
        return whose, of[large], holding[large]

    def _parts(self) -> Iterator[tuple[slice, Floats, Whole, Whole]]:
        """Some contours after the other, since there may be millions of points: which, their points, where each begins
        among these and how many it has."""
        counts = np.diff(self._first)
        for some in _batches(counts):
            first, last = self._first[some.start], self._first[some.stop]
            yield some, self._points[first:last], self._first[some] - first, counts[some]

    def _sizes(self) -> Floats:
        """The areas of all contours, mm²."""
        sizes = np.empty(len(self.contours))
        for some, points, begins, counts in self._parts():
            x, y = (column - np.repeat(column[begins], counts) for column in points.T)
            turned = np.zeros(len(x))
            turned[1:] = x[:-1] * y[1:] - x[1:] * y[:-1]
            # (each begins at 0, 0: what comes to it from the one before is nothing)
            sizes[some] = np.abs(np.add.reduceat(turned, begins)) / 2
        return sizes

    def _inner(self, height: float, aside: float) -> tuple[Whole, Floats]:
        """Four places inside each closed contour: a part of its height from its ends, and in the widest stretch across
        it there a part of that from its ends. An open one's start. Whose the places are comes first."""
        closed = np.array([contour.is_closed for contour in self.contours], bool)
        owners, places = [np.empty(0, np.int64)], [np.empty((0, 2))]
        for some, points, begins, counts in self._parts():
            owner = np.repeat(np.arange(len(counts)), counts)[:-1]
            (x1, y1), (x2, y2) = points[:-1].T, points[1:].T
            # (no chord leads from one contour to the next)
            is_chord = closed[some][owner]
            is_chord[begins[1:] - 1] = False
            low, high = (of.reduceat(points[:, 1], begins) for of in (np.minimum, np.maximum))
            for part in (height, 1 - height):
                y = low + part * (high - low)
                across = np.flatnonzero(is_chord & ((y1 > y[owner]) != (y2 > y[owner])))
                of, up = owner[across], y[owner[across]]
                x = x1[across] + (up - y1[across]) / (y2[across] - y1[across]) * (x2[across] - x1[across])
                x, of = x[np.lexsort((x, of))], of[::2]
                wide = x[1::2] - x[::2]
                # The first of the widest stretches of each.
                order = np.lexsort((-wide, of))
                numbers, first = np.unique(of[order], return_index=True)
                widest = order[first]
                for along in (aside, 1 - aside):
                    owners.append(some.start + numbers)
                    places.append(np.column_stack((x[2 * widest] + along * wide[widest], y[numbers])))
        whose = np.concatenate(owners)
        without = np.setdiff1d(np.arange(len(closed)), whose)
        starts = self._points[self._first[without]]
        return np.concatenate((whose, without)), np.concatenate((*places, starts))

    def around(self, places: Sequence[XY]) -> list[list[int]]:
        """The closed contours around each of some places, by their numbers."""
        result: list[list[int]] = [[] for _ in places]
        of, holding = self._holding(np.array(places, float).reshape(-1, 2), np.full(len(places), -1))
        for at, one in sorted(zip(of.tolist(), holding.tolist(), strict=True)):
            result[at].append(one)
        return result

    def _holding(self, places: Floats, on: Whole) -> tuple[Whole, Whole]:
        """The pairs of one of n places (n, 2) and a closed contour around it; `on`: the contour that each lies on."""
        closed = np.flatnonzero([contour.is_closed for contour in self.contours])
        if not len(closed) or not len(places):
            return np.empty(0, np.int64), np.empty(0, np.int64)
        low, high = (of.reduceat(self._points, self._first[:-1])[closed] for of in (np.minimum, np.maximum))
        boxes, tree = shapely.box(*low.T, *high.T), shapely.STRtree(shapely.points(places))
        found = []
        for first in range(0, len(closed), _BOXES):
            box, of = tree.query(boxes[first : first + _BOXES])
            holding = closed[first + box]
            of, holding = (some[on[of] != holding] for some in (of, holding))
            is_in = self._hold(holding, places, of)
            found.append((of[is_in], holding[is_in]))
        return tuple(np.concatenate(some) for some in zip(*found, strict=True))

    def _hold(self, contours: Whole, places: Floats, of: Whole) -> Flags:
        """Mark the pairs of a closed contour and a place inside it (`_holds`)."""
        result = np.zeros(len(of), bool)
        points = self._first[contours + 1] - self._first[contours]
        few = np.flatnonzero(points <= _FEW)
        chords = points[few] - 1
        for part in _batches(chords):
            some, counts = few[part], chords[part]
            at = np.repeat(self._first[contours[some]], counts) + numbers_up_to(counts)
            pair = np.repeat(np.arange(len(some)), counts)
            (x, y), ys = places[of[some]].T, self._points[:, 1]
            is_over = (ys[at] > y[pair]) != (ys[at + 1] > y[pair])
            at, pair = at[is_over], pair[is_over]
            (x1, y1), (x2, y2) = columns_at(self._points, at), columns_at(self._points, at + 1)
            is_right = x[pair] < x1 + (y[pair] - y1) / (y2 - y1) * (x2 - x1)
            result[some] = np.bincount(pair[is_right], minlength=len(some)) % 2 == 1
        many = np.flatnonzero(points > _FEW)
        many = many[np.argsort(contours[many], kind="stable")]
        numbers, begins = np.unique(contours[many], return_index=True)
        for at, some in zip(numbers.tolist(), np.split(many, begins[1:]), strict=len(numbers) > 0):
            result[some] = self._holds(at, places[of[some]])
        return result

    def nearest(self, place: XY, without: Collection[int]) -> int:
        """The contour that comes nearest to a place, of all but some."""
        ways = np.diff(self._points, axis=0, append=self._points[-1:])
        # (no chord goes from one contour to the next)
        ways[self._first[1:] - 1] = 0.0
        squares = np.maximum((ways**2).sum(1), 1e-30)
        parts = np.clip(((place - self._points) * ways).sum(1) / squares, 0.0, 1.0)
        off = self._points + parts[:, None] * ways - place
        far = np.minimum.reduceat(np.hypot(*off.T), self._first[:-1])
        far[list(without)] = inf
        near = np.flatnonzero(far <= far.min() + _HAIR).tolist()
        return min(near, key=lambda at: min(edge.far(place) for edge in self.contours[at].edges))

    def _holds(self, at: int, places: Floats) -> Flags:
        """Mark the places inside a closed contour (counts crossings of rays to the right)."""
        points = self._points[self._first[at] : self._first[at + 1]]
        is_inside = np.zeros(len(places), bool)
        order = np.argsort(places[:, 1])
        size = max(1, min(_PAIRS // len(points), 64 if len(points) > 64 else len(places)))
        bottom, top = np.minimum(points[:-1, 1], points[1:, 1]), np.maximum(points[:-1, 1], points[1:, 1])
        for some in (order[first : first + size] for first in range(0, len(order), size)):
            x, y = places[some].T
            beside = np.flatnonzero((bottom <= y[-1]) & (top >= y[0]))
            (x1, y1), (x2, y2) = points[beside].T[:, :, None], points[beside + 1].T[:, :, None]
            with np.errstate(divide="ignore", invalid="ignore"):
                is_right = x < x1 + (y - y1) / (y2 - y1) * (x2 - x1)
            is_inside[some] = np.count_nonzero(((y1 > y) != (y2 > y)) & is_right, axis=0) % 2
        return is_inside


def _stretches(first: Whole, last: Whole, size: int) -> tuple[tuple[Whole, Whole], Whole]:
    """Chords from some points to others in stretches of so many chords: from which point to which; and the number of
    the first one of each, with that behind the last."""
    counts = np.maximum(1, -(-(last - first) // size))
    begins = np.repeat(first, counts) + size * numbers_up_to(counts)
    return (begins, np.minimum(begins + size, np.repeat(last, counts))), np.concatenate(([0], np.cumsum(counts)))


def _batches(counts: Whole) -> Iterator[slice]:
    """Yield slices of items with these numbers of pairs, to be looked at together."""
    total = np.concatenate(([0], np.cumsum(counts)))
    begin = 0
    while begin < len(counts):
        end = max(begin + 1, int(np.searchsorted(total, total[begin] + _PAIRS, "right")) - 1)
        yield slice(begin, end)
        begin = end


def _beside(x: Floats, y: Floats, along: Floats, up: Floats, reach: Floats) -> Floats:
    """Distance of places, x, y from where chords begin, from these chords."""
    square = np.maximum(along**2 + up**2, 1e-300)
    part = np.clip((x * along + y * up) / square, 0, 1)
    far = np.sqrt((x - part * along) ** 2 + (y - part * up) ** 2)
    return np.where(far <= reach, far, inf)


def _ahead(
    x: Floats, y: Floats, along: Floats, up: Floats, u: Floats, v: Floats, reach: Floats, least: Floats
) -> Floats:
    """Distance from places along their ways u, v to chords."""
    area = u * up - v * along
    with np.errstate(divide="ignore", invalid="ignore"):
        far = (y * along - x * up) / area
        part = (y * u - x * v) / area
    hits = (np.abs(area) > 1e-12) & (far > least) & (far <= reach) & (part >= 0) & (part <= 1)
    return np.where(hits, far, inf)


def _before(
    x: Floats, y: Floats, along: Floats, up: Floats, u: Floats, v: Floats, reach: Floats, least: Floats, wide: Floats
) -> Floats:
    """Distance that a disc gets from places along their ways u, v before it touches chords: from `least` on.

    It is on a chord while its centre is between the two ends of one of three stretches of the way: beside the chord,
    and within its radius of each end.
    """
    first, last = np.full(len(x), inf), np.full(len(x), -inf)
    with np.errstate(divide="ignore", invalid="ignore"):
        for p, q in ((x, y), (x - along, y - up)):
            middle = -(p * u + q * v)
            half = np.sqrt(wide**2 - (p * v - q * u) ** 2)
            first, last = np.fmin(first, middle - half), np.fmax(last, middle + half)
        # Along the chord it is between its ends, across it no further than the radius.
        length = np.hypot(along, up)
        p, q = along / length, up / length
        low, high = np.full(len(x), -inf), np.full(len(x), inf)
        for place, speed, bottom, top in (
            (x * p + y * q, u * p + v * q, np.zeros(len(x)), length),
            (y * p - x * q, v * p - u * q, -wide, wide),
        ):
            ends = (bottom - place) / speed, (top - place) / speed
            is_still = np.abs(speed) < 1e-12
            is_in = (place >= bottom) & (place <= top)
            low = np.maximum(low, np.where(is_still, np.where(is_in, -inf, inf), np.minimum(*ends)))
            high = np.minimum(high, np.where(is_still, inf, np.maximum(*ends)))
    is_beside = low <= high
    first = np.where(is_beside, np.fmin(first, low), first)
    last = np.where(is_beside, np.fmax(last, high), last)
    return np.where((last >= least) & (first <= reach), np.maximum(first, least), inf)
