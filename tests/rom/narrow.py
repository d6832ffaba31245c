"""Narrow parts: contours with necks, bulbs, slots, combs and short arcs, and offsets up to past what fits.

The judge is shapely, which knows nothing of SKG. A tape without an error goes R beside each edge wherever the wire has
room there, and turns no arc over; its wire may come into a wall that is no neighbour of the element that it travels,
which no corner shows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import atan2, ceil, hypot, pi
from random import Random

import numpy as np
import shapely
from shapely.geometry import LineString, Polygon

from skg.tape import text
from skg.tape.layout import place

Place = tuple[float, float]
#: Arcs are handed to shapely as chords this near, mm.
FLAT = 1e-4
#: A tape is so near to the offset contour, mm: whole micrometres, the drift of a few arcs, chords.
NEAR = 0.008
#: So many places beside an edge are looked at.
SAMPLES = 60


@dataclass(frozen=True)
class Edge:
    """A line, or an arc about `centre` with a signed sweep (radians); mm."""

    start: Place
    end: Place
    centre: Place | None = None
    sweep: float = 0.0

    def points(self) -> np.ndarray:
        """Places along it, both ends included (n, 2)."""
        if self.centre is None:
            return np.array([self.start, self.end])
        (x, y), radius = self.centre, hypot(self.start[0] - self.centre[0], self.start[1] - self.centre[1])
        first = atan2(self.start[1] - y, self.start[0] - x)
        count = max(4, ceil(abs(self.sweep) / (2 * (2 * FLAT / radius) ** 0.5)))
        angles = first + self.sweep / count * np.arange(count + 1)
        places = np.column_stack([x + radius * np.cos(angles), y + radius * np.sin(angles)])
        places[0], places[-1] = self.start, self.end
        return places

    def direction(self, at_end: bool) -> Place:
        """The direction of travel at an end."""
        if self.centre is None:
            return self.end[0] - self.start[0], self.end[1] - self.start[1]
        x, y = self.end if at_end else self.start
        dx, dy = x - self.centre[0], y - self.centre[1]
        return (-dy, dx) if self.sweep > 0 else (dy, -dx)


Contour = list[Edge]


def arc(start: Place, end: Place, centre: Place, is_ccw: bool) -> Edge:
    """The arc from start to end about a centre."""
    first, last = (atan2(y - centre[1], x - centre[0]) for x, y in (start, end))
    sweep = (last - first) % (2 * pi)
    return Edge(start, end, centre, sweep if is_ccw else sweep - 2 * pi)


def chain(*corners: Place) -> Contour:
    """Lines from corner to corner."""
    return [Edge(start, end) for start, end in pairwise(corners)]


def grid(rng: Random, low: float, high: float) -> float:
    """A length: whole tenths more often than not, where curves touch and coincide."""
    value = rng.uniform(low, high)
    return round(value, 1) or 0.1 if rng.random() < 0.6 else round(value, 3)


# Families: each makes a contour whose first edge is the longest one along y = 0, to be entered in its middle.


def bulb(rng: Random) -> Contour:
    """A plate with a neck to a round relief: a keyhole in its right side."""
    wide, high = grid(rng, 3, 9), grid(rng, 2, 6)
    half, radius = grid(rng, 0.02, 0.8), grid(rng, 0.1, 1.5)
    reach = grid(rng, 0.1, wide - 0.5)
    if half >= radius:
        half, radius = radius * 0.7, half + 0.01
    centre = wide - reach, high / 2
    leg = (radius**2 - half**2) ** 0.5
    low, top = (centre[0] + leg, centre[1] - half), (centre[0] + leg, centre[1] + half)
    return [
        *chain((0, 0), (wide, 0), (wide, centre[1] - half), low),
        arc(low, top, centre, False),
        *chain(top, (wide, centre[1] + half), (wide, high), (0, high), (0, 0)),
    ]


def slots(rng: Random) -> Contour:
    """A comb: slots from above with flat or round ends."""
    count, depth, high = rng.randint(1, 4), grid(rng, 0.3, 3), grid(rng, 3.5, 6)
    found = chain((0, 0), (12, 0), (12, high))
    x = 12.0
    for _ in range(count):
        x -= grid(rng, 0.2, 1.2)
        gap = grid(rng, 0.05, 1.0)
        low = high - depth
        found.append(Edge(found[-1].end, (x, high)))
        found.append(Edge((x, high), (x, low)))
        if rng.random() < 0.5:
            middle = (x - gap / 2, low)
            found.append(Edge((x, low), (x - gap, low), middle, -pi))
        else:
            found.append(Edge((x, low), (x - gap, low)))
        found.append(Edge((x - gap, low), (x - gap, high)))
        x -= gap
    return [*found, *chain(found[-1].end, (0, high), (0, 0))]


def bites(rng: Random) -> Contour:
    """A plate with arcs between its corners: bites out of its edges, or bumps on them."""
    corners = [(0.0, 0.0), (8.0, 0.0), (8.0, grid(rng, 2, 6)), (grid(rng, -1, 2), grid(rng, 3, 7))]
    found = chain(*corners[:2])
    for start, end in pairwise([*corners[1:], corners[0]]):
        dx, dy = end[0] - start[0], end[1] - start[1]
        first, second = sorted((rng.uniform(0.1, 0.9), rng.uniform(0.1, 0.9)))
        if second - first < 0.02:
            found.append(Edge(start, end))
            continue
        p, q = ((start[0] + k * dx, start[1] + k * dy) for k in (first, second))
        aside = rng.choice([-1, 1]) * rng.uniform(0.1, 2.0)
        middle = (p[0] + q[0]) / 2 - aside * (q[1] - p[1]) / 2, (p[1] + q[1]) / 2 + aside * (q[0] - p[0]) / 2
        found += [Edge(start, p), arc(p, q, middle, rng.random() < 0.5), Edge(q, end)]
    return found


def lens(rng: Random) -> Contour:
    """A line and short arcs from corner to corner, as a milled pocket's end has them."""
    x, found = 10.0, chain((0, 0), (10, 0))
    for _ in range(rng.randint(2, 5)):
        wide = grid(rng, 0.2, 2.4)
        start = found[-1].end
        end = max(0.2, x - wide), grid(rng, 1.5, 4)
        x = end[0]
        dx, dy = end[0] - start[0], end[1] - start[1]
        aside = rng.choice([-1, 1]) * rng.uniform(0.05, 2.0)
        middle = (start[0] + end[0]) / 2 - aside * dy, (start[1] + end[1]) / 2 + aside * dx
        found.append(arc(start, end, middle, rng.random() < 0.5) if rng.random() < 0.7 else Edge(start, end))
    return [*found, Edge(found[-1].end, (0, 0))]


FAMILIES: tuple[Callable[[Random], Contour], ...] = (bulb, slots, bites, lens)


@dataclass(frozen=True)
class Part:
    """A program, the contour that it draws, and R: positive, the wire runs to its right."""

    program: str
    contour: Contour
    r: float
    area: Polygon


def outline(contour: Contour) -> Polygon:
    """The area in a contour."""
    return Polygon(np.concatenate([edge.points()[:-1] for edge in contour]))


def parts(rng: Random) -> Iterator[Part]:
    """Narrow parts without end."""
    while True:
        contour = rng.choice(FAMILIES)(rng)
        area = outline(contour)
        if not area.is_valid or area.area < 0.1 or area.exterior.is_ccw is False:
            continue
        wide = rng.choice([0.01, 0.03, 0.1, 0.2, 0.3, 0.5, 1.0, rng.uniform(0.005, 2.0)])
        r = rng.choice([-1, 1]) * round(wide, 3)
        if rng.random() < 0.05:
            r = 0.0
        yield Part(written(contour, r, by_points=rng.random() < 0.5), contour, r, area)


def number(value: float) -> str:
    """A constant with the digits that a float of the board has."""
    return f"{value:.7f}".rstrip("0").rstrip(".") if abs(value) > 5e-8 else "0"


def point(where: Place) -> str:
    """A point as a program has it."""
    return f"({number(where[0])},{number(where[1])})"


def written(contour: Contour, r: float, by_points: bool) -> str:
    """The program: entered in the middle of the first edge, its corners named by points, or as crossings."""
    (x, y), hole = entry(contour), start_hole(contour, r)
    items: list[str] = []
    if by_points:
        items = [point((x, y))]
        for edge in contour:
            if edge.centre is not None:
                items.append(curve(edge))
            items.append(point(edge.end))
        cuts = [f"CUT {item}" for item in items]
    else:
        cuts = [f"CUT {curve(contour[0])}"]
        for before, edge in pairwise([*contour, contour[0]]):
            u, v = before.direction(True), edge.direction(False)
            separator = "" if u[0] * v[1] - u[1] * v[0] > 0 else ";"
            cuts.append(f"CUT {separator}{curve(edge)}")
    lines = [f"R={number(r)}", f"FROM {point(hole)}", *cuts, "BACK"]
    return "".join(f"{10 * n} {line}\n" for n, line in enumerate(lines, 1))


def entry(contour: Contour) -> Place:
    """The middle of the first edge."""
    first = contour[0]
    return (first.start[0] + first.end[0]) / 2, (first.start[1] + first.end[1]) / 2


def start_hole(contour: Contour, r: float) -> Place:
    """A place square to the entry, on the wire's side, on the micrometre."""
    x, y = entry(contour)
    return round(x, 3), y - 3.0 if r >= 0 else y + 3.0


def curve(edge: Edge) -> str:
    """A line or a circle as an item."""
    if edge.centre is None:
        return f"{point(edge.start)}:{point(edge.end)}"
    radius = hypot(edge.start[0] - edge.centre[0], edge.start[1] - edge.centre[1])
    return f"{point(edge.centre)}:{number(radius if edge.sweep > 0 else -radius)}"


def path_of(tape: bytes, hole: Place) -> list[Edge]:
    """The wire's cuts, mm: without the way in and out; `hole`: where the tape begins."""
    start = round(1000 * hole[0]), round(1000 * hole[1])
    (route,) = [route for route in place(text.parse(tape, "tape"), start, "programmed") if not route.is_move]

    def scaled(where: Place | None) -> Place | None:
        return where and (where[0] / 1000, where[1] / 1000)

    return [
        Edge(scaled(block.start), scaled(block.end), scaled(block.centre), block.sweep) for block in route.blocks[1:-1]
    ]


def beside(edge: Edge, r: float) -> np.ndarray:
    """Places R to the right of an edge, without its very ends (n, 2); none beside one without length."""
    parts = np.linspace(0.01, 0.99, SAMPLES)
    if edge.centre is None and edge.start == edge.end:
        return np.empty((0, 2))
    if edge.centre is None:
        start, way = np.array(edge.start), np.subtract(edge.end, edge.start)
        normal = np.array([way[1], -way[0]]) / np.hypot(*way)
        return start + parts[:, None] * way + r * normal
    way = np.subtract(edge.start, edge.centre)
    angles = atan2(way[1], way[0]) + parts * edge.sweep
    radius = np.hypot(*way) + (r if edge.sweep > 0 else -r)
    return np.array(edge.centre) + radius * np.column_stack([np.cos(angles), np.sin(angles)])


def apart(joined: np.ndarray, lists: list[np.ndarray]) -> list[np.ndarray]:
    """What was worked out of some lists in one, list by list."""
    return np.split(joined, np.cumsum([len(some) for some in lists])[:-1])


def free(part: Part) -> list[np.ndarray]:
    """For each edge the places beside it where the wire has room."""
    area = part.area
    shapely.prepare([area, wall := area.exterior])
    places = [beside(edge, part.r) for edge in part.contour]
    points = shapely.points(np.concatenate(places))
    is_free = ~shapely.dwithin(wall, points, abs(part.r) - 2 * FLAT)
    if part.r:
        is_free &= shapely.contains(area, points) == (part.r < 0)
    return [some[where] for some, where in zip(places, apart(is_free, places), strict=True)]


def judged(part: Part, tape: bytes) -> str:
    """The verdict on a tape without an error: "right", "walls" (the wire comes into a wall that is no neighbour of what
    it travels), else what is wrong."""
    cuts = path_of(tape, start_hole(part.contour, part.r))
    if wrong := fault(part, cuts):
        return wrong
    places = shapely.points(np.concatenate([edge.points() for edge in cuts]))
    # (whether something is near takes less than how near it is)
    shapely.prepare(wall := part.area.exterior)
    is_near = abs(part.r) > NEAR and shapely.dwithin(wall, places, abs(part.r) - NEAR).any()
    return "walls" if is_near else "right"


def fault(part: Part, cuts: Contour) -> str:
    """The part of the contour that the wire leaves out, or follows the other way; empty: none."""
    path = LineString(np.concatenate([edge.points() for edge in cuts]))
    shapely.prepare(path)
    for edge in part.contour:
        if edge.centre is not None and not any(same_centre(edge, other) for other in part.contour if other is not edge):
            sweep = sum(cut.sweep for cut in cuts if cut.centre is not None and same_centre(edge, cut))
            if abs(sweep - edge.sweep) > pi + 0.01:
                return f"{edge} is travelled by {sweep} rad"
    places = free(part)
    is_off = ~shapely.dwithin(path, shapely.points(np.concatenate(places)), NEAR)
    for edge, some, off in zip(part.contour, places, apart(is_off, places), strict=True):
        # (round a corner there is room that a mitre leaves out)
        if off.sum() > max(len(some) / 3, SAMPLES / 12) and LineString(edge.points()).length >= NEAR:
            far = shapely.distance(path, shapely.points(some)).max()
            return f"the wire stays {far:.3f} mm off its place beside {edge}"
    return ""


def same_centre(one: Edge, other: Edge) -> bool:
    """Tells whether two arcs have one centre."""
    return other.centre is not None and np.hypot(*np.subtract(one.centre, other.centre)) < NEAR
