"""What lies around a place of a drawing: contours by their boxes, then by their chords (numpy; shapely finds boxes)."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Collection, Generator, Sequence
from itertools import islice
from math import cos, inf, sin
from typing import NamedTuple, TypeVar

import numpy as np
import shapely
from numpy.typing import NDArray

from skg.drawing.contour import Contour, Edge
from skg.errors import UserError
from skg.plane import XY, distance

#: So many chords that follow each other are looked for together.
_RUN = 32
#: What is within a reach may seem to lie this much farther away, mm.
_HAIR = 1e-9
#: So many pairs of a place and a chord are looked at together.
_PAIRS = 100_000
#: Where a contour is looked across for places in it, parts of its height: no corners lie there but by chance.
_ACROSS = 0.2873, 0.7127
#: So many arcs become chords together.
_ARCS = 1000
#: So many boxes are asked for the places in them together.
_BOXES = 1000

Floats = NDArray[np.float64]
Measure = Callable[[Floats, Floats, Floats, Floats, Floats, Floats], Floats]
T = TypeVar("T")


class Look(NamedTuple):
    """A look from a place for the nearest contour within a reach, mm; with an `angle` (radians) for the next one that
    way, where what is nearer than `least` is none. `wide`: how far from `least` on something that is so wide on each
    side gets that way before it touches one."""

    place: XY
    reach: float
    angle: float | None = None
    least: float = 0.0
    wide: float = 0.0


class Field:
    """All contours of a drawing, mm."""

    def __init__(self, contours: list[Contour]) -> None:
        self.contours = contours
        self._points, counts = points_of(contours)
        self._first = np.concatenate(([0], np.cumsum(counts)))
        # Runs of chords: from which point to which.
        runs = np.maximum(1, -(-(counts - 1) // _RUN))
        of, begins = np.repeat(np.arange(len(counts)), runs), np.cumsum(runs) - runs
        self._low = self._first[of] + _RUN * (np.arange(len(of)) - begins[of])
        self._high = np.minimum(self._low + _RUN, self._first[of + 1] - 1)
        self._runs = shapely.STRtree(self._boxes())

    def _boxes(self) -> NDArray[np.object_]:
        """The boxes around the runs."""
        ends = self._points[self._high]
        low = np.minimum(np.minimum.reduceat(self._points, self._low), ends) if len(ends) else ends
        high = np.maximum(np.maximum.reduceat(self._points, self._low), ends) if len(ends) else ends
        return shapely.box(*low.T, *high.T)

    def look(self, looks: Sequence[Look]) -> list[float]:
        """What each of some looks finds, mm; infinite when there is nothing within its reach."""
        found = np.full(len(looks), inf)
        for kind, measure in enumerate((_beside, _ahead, _before)):
            some = [at for at, one in enumerate(looks) if (one.angle is not None) * (1 + (one.wide > 0)) == kind]
            for first in range(0, len(some), _BOXES):
                self._look(looks, some[first : first + _BOXES], measure, found)
        return found.tolist()

    def _look(self, looks: Sequence[Look], which: list[int], measure: Measure, found: Floats) -> None:
        """Look for chords in the boxes that some looks pass, and measure how far these are."""
        places = np.array([looks[at].place for at in which], float)
        reach = np.array([looks[at].reach for at in which], float)
        ways = np.array([_direction(looks[at].angle) for at in which], float)
        least = np.array([looks[at].least for at in which], float)
        wide = np.array([looks[at].wide for at in which], float)
        is_round = ~ways.any(1)
        ends = places + reach[:, None] * ways
        aside = np.where(is_round, reach, wide)[:, None] + _HAIR
        boxes = shapely.box(*(np.minimum(places, ends) - aside).T, *(np.maximum(places, ends) + aside).T)
        of, runs = self._runs.query(boxes)
        order = np.argsort(of, kind="stable")
        of, runs = of[order], runs[order]
        chords = self._high[runs] - self._low[runs]
        total = np.concatenate(([0], np.cumsum(chords)))
        low = 0
        while low < len(of):
            high = max(low + 1, int(np.searchsorted(total, total[low] + _PAIRS, "right")) - 1)
            counts = chords[low:high]
            at = np.arange(counts.sum()) + np.repeat(self._low[runs[low:high]] - np.cumsum(counts) + counts, counts)
            one = np.repeat(of[low:high], counts)
            starts = self._points[at]
            sides = self._points[at + 1] - starts
            far = measure(places[one] - starts, sides, ways[one], reach[one], least[one], wide[one])
            begins = np.flatnonzero(np.diff(one, prepend=-1))
            some = np.array(which)[one[begins]]
            found[some] = np.minimum(found[some], np.minimum.reduceat(far, begins))
            low = high

    def depths(self) -> list[int]:
        """How many closed contours lie around each: hold a place in it, and are larger.

        (Its corners may lie on its neighbours, and a smaller one that lies in it may hold the place.) One that crosses
        others takes something away where it does: it is looked at where an odd number of them lies around it.
        """
        sizes, (owners, places) = self._sizes(), self._inner()
        found = [0] * len(self.contours)
        for at, others in zip(owners, self.around(places, owners), strict=True):
            depth = sum(sizes[other] >= sizes[at] for other in others)
            found[at] = max(found[at], depth, key=lambda one: (one % 2, one))
        return found

    def _sizes(self) -> Floats:
        """The areas of all contours, mm²."""
        x, y = (self._points - self._points[np.repeat(self._first[:-1], np.diff(self._first))]).T
        turned = np.zeros(len(x))
        turned[1:] = x[:-1] * y[1:] - x[1:] * y[:-1]
        # (each begins at 0, 0: what comes to it from the one before is nothing)
        return np.abs(np.add.reduceat(turned, self._first[:-1])) / 2 if len(x) else x

    def _inner(self) -> tuple[list[int], list[XY]]:
        """Four places inside each closed contour: in the quarters of the widest stretches across it, at some heights.
        An open one's start. Whose the places are comes first."""
        counts = np.diff(self._first)
        closed = np.array([contour.is_closed for contour in self.contours], bool)
        owner = np.repeat(np.arange(len(counts)), counts)[:-1]
        (x1, y1), (x2, y2) = self._points[:-1].T, self._points[1:].T
        # (no chord leads from one contour to the next)
        is_chord = closed[owner]
        is_chord[self._first[1:-1] - 1] = False
        low, high = (of.reduceat(self._points[:, 1], self._first[:-1]) for of in (np.minimum, np.maximum))
        owners, places = [], []
        for part in _ACROSS:
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
            for aside in (0.25, 0.75):
                owners.append(numbers)
                places.append(np.column_stack((x[2 * widest] + aside * wide[widest], y[numbers])))
        whose = np.concatenate(owners)
        without = np.setdiff1d(np.arange(len(counts)), whose)
        starts = [self.contours[at].edges[0].start for at in without.tolist()]
        return [*whose.tolist(), *without.tolist()], [*map(tuple, np.concatenate(places).tolist()), *starts]

    def around(self, places: Sequence[XY], on: Sequence[int] = ()) -> list[list[int]]:
        """The closed contours around each of some places, by their numbers; `on`: those that the places lie on."""
        found: list[list[int]] = [[] for _ in places]
        closed = np.flatnonzero([contour.is_closed for contour in self.contours])
        if not len(closed) or not len(places):
            return found
        low = np.minimum.reduceat(self._points, self._first[:-1])[closed]
        high = np.maximum.reduceat(self._points, self._first[:-1])[closed]
        boxes, tree = shapely.box(*low.T, *high.T), shapely.STRtree(shapely.points(places))
        given, own = np.array(places, float), np.array(on or np.full(len(places), -1))
        for first in range(0, len(closed), _BOXES):
            box, within = tree.query(boxes[first : first + _BOXES])
            others = closed[first + box]
            others, within = (some[own[within] != others] for some in (others, within))
            order = np.lexsort((within, others))
            others, within = others[order], within[order]
            numbers, begins = np.unique(others, return_index=True)
            for at, some in zip(numbers.tolist(), np.split(within, begins[1:]), strict=len(numbers) > 0):
                for number in some[self._holds(at, given[some])].tolist():
                    found[number].append(at)
        return found

    def nearest(self, place: XY, without: Collection[int]) -> int:
        """The contour that has a point nearest to a place, of all but some."""
        far = np.minimum.reduceat(np.hypot(*(self._points - place).T), self._first[:-1])
        far[list(without)] = inf
        near = np.flatnonzero(far <= far.min() + _HAIR).tolist()
        return min(near, key=lambda at: min(distance(place, point) for point in self.contours[at].points()))

    def _holds(self, at: int, places: Floats) -> NDArray[np.bool_]:
        """Which places lie inside a closed contour (counts crossings of rays to the right)."""
        points = self._points[self._first[at] : self._first[at + 1]]
        found = np.zeros(len(places), bool)
        order = np.argsort(places[:, 1])
        size = max(1, min(_PAIRS // len(points), 64 if len(points) > 64 else len(places)))
        bottom, top = np.minimum(points[:-1, 1], points[1:, 1]), np.maximum(points[:-1, 1], points[1:, 1])
        for some in (order[first : first + size] for first in range(0, len(order), size)):
            x, y = places[some].T
            beside = np.flatnonzero((bottom <= y[-1]) & (top >= y[0]))
            (x1, y1), (x2, y2) = points[beside].T[:, :, None], points[beside + 1].T[:, :, None]
            with np.errstate(divide="ignore", invalid="ignore"):
                is_right = x < x1 + (y - y1) / (y2 - y1) * (x2 - x1)
            found[some] = np.count_nonzero(((y1 > y) != (y2 > y)) & is_right, axis=0) % 2
        return found


def points_of(contours: Sequence[Contour]) -> tuple[Floats, NDArray[np.int64]]:
    """The points of contours one after the other, to the last bit those of `Contour.points`, and how many each has."""
    edges = [edge for contour in contours for edge in contour.edges]
    # A contour has its edges' points but the last of each, and its end.
    counts = np.array([edge.chords for edge in edges], np.int64)
    first = np.cumsum([0, *(len(contour.edges) for contour in contours)])
    per_contour = np.add.reduceat(counts, first[:-1]) + 1 if edges else counts
    at = np.cumsum(counts) - counts + np.repeat(np.arange(len(contours)), np.diff(first))
    found = np.empty((int(per_contour.sum()), 2))
    found[at] = np.array([edge.start for edge in edges], float).reshape(-1, 2)
    found[np.cumsum(per_contour) - 1] = np.array([contour.edges[-1].end for contour in contours]).reshape(-1, 2)
    arcs = [number for number, edge in enumerate(edges) if not edge.is_line and not edge.nodes]
    for begin in range(0, len(arcs), _ARCS):
        some = arcs[begin : begin + _ARCS]
        _inner_points([edges[number] for number in some], at[some], counts[some], found)
    for number, edge in enumerate(edges):
        if edge.nodes:
            found[at[number] : at[number] + counts[number]] = edge.samples[:-1]
    return found, per_contour


def _inner_points(arcs: list[Edge], at: NDArray[np.int64], pieces: NDArray[np.int64], found: Floats) -> None:
    """Put the points of arcs behind their first ones, which are at some places."""
    shapes = np.array([(*arc.centre, arc.radius, arc.angles[0], arc.sweep) for arc in arcs])
    inner = pieces - 1
    x, y, radius, first, sweep = np.repeat(shapes, inner, axis=0).T
    number = np.arange(inner.sum()) - np.repeat(np.cumsum(inner) - inner, inner) + 1
    angles = (first + number / np.repeat(pieces, inner) * sweep).tolist()
    # (numpy's own cosine is another one on another processor)
    across, up = (np.fromiter(map(of, angles), float, len(angles)) for of in (cos, sin))
    places = np.repeat(at, inner) + number
    found[places, 0], found[places, 1] = x + radius * across, y + radius * up


def _direction(angle: float | None) -> XY:
    return (0.0, 0.0) if angle is None else (cos(angle), sin(angle))


def _beside(to: Floats, sides: Floats, ways: Floats, reach: Floats, least: Floats, wide: Floats) -> Floats:
    """How far places, which lie `to` from where chords begin, are from these."""
    square = np.maximum((sides**2).sum(1), 1e-300)
    part = np.clip((to * sides).sum(1) / square, 0, 1)
    far = np.sqrt(((to - part[:, None] * sides) ** 2).sum(1))
    return np.where(far <= reach, far, inf)


def _ahead(to: Floats, sides: Floats, ways: Floats, reach: Floats, least: Floats, wide: Floats) -> Floats:
    """How far it is from places along their ways to chords."""
    area = ways[:, 0] * sides[:, 1] - ways[:, 1] * sides[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        far = (to[:, 1] * sides[:, 0] - to[:, 0] * sides[:, 1]) / area
        part = (to[:, 1] * ways[:, 0] - to[:, 0] * ways[:, 1]) / area
    hits = (np.abs(area) > 1e-12) & (far > least) & (far <= reach) & (part >= 0) & (part <= 1)
    return np.where(hits, far, inf)


def _before(to: Floats, sides: Floats, ways: Floats, reach: Floats, least: Floats, wide: Floats) -> Floats:
    """How far a disc gets from places along their ways before it touches chords: from `least` on.

    It is on a chord while its centre is between the two ends of one of three stretches of the way: beside the chord,
    and within its radius of each end.
    """
    first, last = np.full(len(to), inf), np.full(len(to), -inf)
    with np.errstate(divide="ignore", invalid="ignore"):
        for end in (to, to - sides):
            middle = -(end * ways).sum(1)
            half = np.sqrt(wide**2 - (end[:, 0] * ways[:, 1] - end[:, 1] * ways[:, 0]) ** 2)
            first, last = np.fmin(first, middle - half), np.fmax(last, middle + half)
        # Along the chord it is between its ends, across it no further than the radius.
        length = np.hypot(*sides.T)
        along, across = sides / length[:, None], np.stack((-sides[:, 1], sides[:, 0]), 1) / length[:, None]
        low, high = np.full(len(to), -inf), np.full(len(to), inf)
        for square, bottom, top in ((along, np.zeros(len(to)), length), (across, -wide, wide)):
            place, speed = (to * square).sum(1), (ways * square).sum(1)
            ends = np.stack(((bottom - place) / speed, (top - place) / speed))
            is_still = np.abs(speed) < 1e-12
            is_in = (place >= bottom) & (place <= top)
            low = np.maximum(low, np.where(is_still, np.where(is_in, -inf, inf), ends.min(0)))
            high = np.minimum(high, np.where(is_still, inf, ends.max(0)))
    is_beside = low <= high
    first = np.where(is_beside, np.fmin(first, low), first)
    last = np.where(is_beside, np.fmax(last, high), last)
    return np.where((last >= least) & (first <= reach), np.maximum(first, least), inf)


def in_step(tasks: Sequence[Generator[Sequence[Look], list[float], T]], field: Field) -> list[T]:
    """Carry on tasks that wait for what they look for: all that are waiting look together.

    Where tasks fail with a `UserError` that of the first one in order is raised.
    """
    done: dict[int, T] = {}
    failed: dict[int, UserError] = {}
    answers: dict[int, list[float] | None] = dict.fromkeys(range(len(tasks)))
    while answers:
        asked: dict[int, Sequence[Look]] = {}
        for at, answer in answers.items():
            try:
                asked[at] = tasks[at].send(answer)
            except StopIteration as stop:
                done[at] = stop.value
            except UserError as error:
                failed[at] = error
        found = iter(field.look([look for looks in asked.values() for look in looks]))
        answers = {at: list(islice(found, len(looks))) for at, looks in asked.items()}
    if failed:
        raise failed[min(failed)]
    return [done[at] for at in range(len(tasks))]


def nearest_order(places: Floats, begin: XY) -> list[int]:
    """The order of places when from `begin` on the nearest one is always next; of equally near ones the first."""
    left = set(range(len(places)))
    x, y = places.T.copy()
    xs, ys = x.tolist(), y.tolist()
    low, size = places.min(0).tolist(), (places.max(0) - places.min(0)).tolist()
    cell = max((size[0] * size[1] / len(xs)) ** 0.5 * 1.5, max(size) / len(xs), 1e-9)
    cells: dict[tuple[int, int], list[int]] = defaultdict(list)
    columns, rows = int(size[0] / cell), int(size[1] / cell)
    home = [(int((p - low[0]) / cell), int((q - low[1]) / cell)) for p, q in zip(xs, ys, strict=True)]
    for at, key in enumerate(home):
        cells[key].append(at)
    order: list[int] = []
    p, q = begin
    while left:
        column = min(max(int((p - low[0]) // cell), 0), columns)
        row = min(max(int((q - low[1]) // cell), 0), rows)
        best = inf, -1
        for ring in range(4):
            for key in _ring(column, row, ring):
                for at in cells.get(key, ()):
                    u, v = xs[at] - p, ys[at] - q
                    best = min(best, (u * u + v * v, at))
            # All that is in no ring yet is at least so many cells away.
            if best[0] < (ring * cell) ** 2 * (1 - 1e-9):
                break
        else:
            best = 0.0, int(np.argmin((x - p) ** 2 + (y - q) ** 2))
        at = best[1]
        order.append(at)
        left.discard(at)
        cells[home[at]].remove(at)
        p, q = xs[at], ys[at]
        x[at] = inf
    return order


def _ring(column: int, row: int, ring: int) -> list[tuple[int, int]]:
    """The cells so many cells around one."""
    if not ring:
        return [(column, row)]
    found = [(column + i, row + j) for i in range(-ring, ring + 1) for j in (-ring, ring)]
    return found + [(column + i, row + j) for i in (-ring, ring) for j in range(1 - ring, ring)]
