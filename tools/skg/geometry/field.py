"""Distances to the contours around places: from them, along ways, before a disc (numpy)."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from math import inf

import numpy as np

from skg.geometry.arrays import Floats, Whole, columns_at
from skg.geometry.index import Boxes, Index

#: Rounding of a reach: a chord within it may seem to lie this much farther away, mm.
_HAIR = 1e-9
#: So many places are looked at by one thread after the other, and so many chords get boxes together.
_PLACES, _CHORDS = 1000, 50_000
#: Chords whose boxes are found or not as a whole.
_STRETCH = 16

Measure = Callable[[Whole, Whole], Floats]


class Field:
    """The chords of contours, mm: `points` (m, 2), from where each contour's begin (`first`) to where the next one's
    do."""

    def __init__(self, points: Floats, first: Whole) -> None:
        self._points = points
        # (few places are looked at, beside as many chords as there may be)
        self._index = Index(_boxes(points, np.repeat(np.arange(len(first) - 1), np.diff(first))), _STRETCH)

    def near(self, places: Floats, reach: Floats) -> Floats:
        """Distance of the nearest contour from each of n places (n, 2), mm: infinite where none is within its reach."""

        def measure(chords: Whole, asked: Whole) -> Floats:
            return _beside(*self._chords(chords, places, asked), reach[asked])

        return self._look(places, places, reach + _HAIR, measure)

    def ahead(self, places: Floats, ways: Floats, reach: Floats, least: Floats) -> Floats:
        """Distance from each of n places along its way (n, 2; unit vectors) to the next contour, mm: infinite
        where none is within its reach. What is nearer than `least` is none."""

        def measure(chords: Whole, asked: Whole) -> Floats:
            return _ahead(*self._chords(chords, places, asked), *columns_at(ways, asked), reach[asked], least[asked])

        return self._look(places, places + reach[:, None] * ways, np.full(len(places), _HAIR), measure)

    def before(self, places: Floats, ways: Floats, reach: Floats, least: Floats, wide: Floats) -> Floats:
        """Distance that a disc so wide on each side gets from each of n places along its way (n, 2; unit vectors)
        before it touches a contour, mm: from `least` on, infinite where it touches none within its reach."""

        def measure(chords: Whole, asked: Whole) -> Floats:
            return _before(
                *self._chords(chords, places, asked), *columns_at(ways, asked), reach[asked], least[asked], wide[asked]
            )

        return self._look(places, places + reach[:, None] * ways, wide + _HAIR, measure)

    def _chords(self, chords: Whole, places: Floats, asked: Whole) -> tuple[Floats, Floats, Floats, Floats]:
        """The ways from where some chords begin to some places, and to where they end: x and y of each."""
        (x, y), (x1, y1), (x2, y2) = (
            columns_at(places, asked),
            columns_at(self._points, chords),
            columns_at(self._points, chords + 1),
        )
        return x - x1, y - y1, x2 - x1, y2 - y1

    def _look(self, places: Floats, ends: Floats, aside: Floats, measure: Measure) -> Floats:
        """The least that is measured from each of n places to the chords in a box: around it and its end, and so far
        aside. `measure` is given which chords and which places."""
        result = np.full(len(places), inf)
        low, high = np.minimum(places, ends) - aside[:, None], np.maximum(places, ends) + aside[:, None]

        def look(first: int) -> None:
            """Look from some of the places."""
            some = slice(first, first + _PLACES)
            for of, chords in self._index.within(low[some], high[some]):
                asked = first + of
                starts = np.flatnonzero(np.diff(asked, prepend=-1))
                least = np.minimum.reduceat(measure(chords, asked), starts)
                result[asked[starts]] = np.minimum(result[asked[starts]], least)

        firsts = range(0, len(places), _PLACES)
        if len(firsts) > 1:
            with ThreadPoolExecutor(os.cpu_count()) as threads:
                # (numpy lets them run at the same time)
                list(threads.map(look, firsts))
        else:
            list(map(look, firsts))
        return result


def _boxes(points: Floats, owner: Whole) -> Iterator[Boxes]:
    """The boxes around chords between points, of which each has an owner."""
    for begin in range(0, len(points), _CHORDS):
        some = slice(begin, begin + _CHORDS + 1)
        # (no chord leads from one contour to the next)
        chords = begin + np.flatnonzero(owner[some][1:] == owner[some][:-1])
        ends = points[chords], points[chords + 1]
        yield Boxes(np.minimum(*ends), np.maximum(*ends), chords, owner[chords])


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
