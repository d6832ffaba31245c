"""Contours around contours and places (numpy; shapely finds boxes)."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from math import inf

import numpy as np
import shapely

from skg.geometry.arrays import Flags, Floats, Whole, columns_at, numbers_up_to
from skg.geometry.contour import Contour
from skg.geometry.edge_arrays import points_of
from skg.geometry.index import batches
from skg.geometry.plane import XY

#: Contours whose distances from a place differ by no more are as near as each other, mm.
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


class Holding:
    """All contours of a drawing, mm. `points`: theirs, one contour after the other; `first`: where those of each begin,
    and the number of all."""

    def __init__(self, contours: Sequence[Contour]) -> None:
        self.contours = contours
        self.points, counts = points_of(contours)
        self.first = np.concatenate(([0], np.cumsum(counts)))

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
        counts = np.diff(self.first)
        for some in batches(counts, _PAIRS):
            first, last = self.first[some.start], self.first[some.stop]
            yield some, self.points[first:last], self.first[some] - first, counts[some]

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
        starts = self.points[self.first[without]]
        return np.concatenate((whose, without)), np.concatenate((*places, starts))

    def around(self, places: Sequence[XY]) -> list[list[int]]:
        """The closed contours around each of some places, by their numbers."""
        result: list[list[int]] = [[] for _ in places]
        of, holding = self._holding(np.array(places, float).reshape(-1, 2), np.full(len(places), -1))
        for place, holder in sorted(zip(of.tolist(), holding.tolist(), strict=True)):
            result[place].append(holder)
        return result

    def _holding(self, places: Floats, on: Whole) -> tuple[Whole, Whole]:
        """The pairs of one of n places (n, 2) and a closed contour around it; `on`: the contour that each lies on."""
        closed = np.flatnonzero([contour.is_closed for contour in self.contours])
        if not len(closed) or not len(places):
            return np.empty(0, np.int64), np.empty(0, np.int64)
        low, high = (of.reduceat(self.points, self.first[:-1])[closed] for of in (np.minimum, np.maximum))
        boxes, tree = shapely.box(*low.T, *high.T), shapely.STRtree(shapely.points(places))
        pairs = []
        for first in range(0, len(closed), _BOXES):
            box, of = tree.query(boxes[first : first + _BOXES])
            holding = closed[first + box]
            of, holding = (some[on[of] != holding] for some in (of, holding))
            is_in = self._hold(holding, places, of)
            pairs.append((of[is_in], holding[is_in]))
        return tuple(np.concatenate(some) for some in zip(*pairs, strict=True))

    def _hold(self, contours: Whole, places: Floats, of: Whole) -> Flags:
        """Mark the pairs of a closed contour and a place inside it (`_holds`)."""
        result = np.zeros(len(of), bool)
        points = self.first[contours + 1] - self.first[contours]
        few = np.flatnonzero(points <= _FEW)
        chords = points[few] - 1
        for part in batches(chords, _PAIRS):
            some, counts = few[part], chords[part]
            at = np.repeat(self.first[contours[some]], counts) + numbers_up_to(counts)
            pair = np.repeat(np.arange(len(some)), counts)
            (x, y), ys = places[of[some]].T, self.points[:, 1]
            is_over = (ys[at] > y[pair]) != (ys[at + 1] > y[pair])
            at, pair = at[is_over], pair[is_over]
            (x1, y1), (x2, y2) = columns_at(self.points, at), columns_at(self.points, at + 1)
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
        ways = np.diff(self.points, axis=0, append=self.points[-1:])
        # (no chord goes from one contour to the next)
        ways[self.first[1:] - 1] = 0.0
        squares = np.maximum((ways**2).sum(1), 1e-30)
        parts = np.clip(((place - self.points) * ways).sum(1) / squares, 0.0, 1.0)
        off = self.points + parts[:, None] * ways - place
        far = np.minimum.reduceat(np.hypot(*off.T), self.first[:-1])
        far[list(without)] = inf
        near = np.flatnonzero(far <= far.min() + _HAIR).tolist()
        return min(near, key=lambda number: min(edge.far(place) for edge in self.contours[number].edges))

    def _holds(self, number: int, places: Floats) -> Flags:
        """Mark the places inside a closed contour (counts crossings of rays to the right)."""
        points = self.points[self.first[number] : self.first[number + 1]]
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
