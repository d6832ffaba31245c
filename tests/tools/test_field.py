"""Searches among many contours at once. The judges are shapely, and a search through all of them one by one."""

from __future__ import annotations

import random
from collections import Counter
from functools import partial
from itertools import pairwise
from math import cos, inf, pi, sin

import numpy as np
import pytest
import shapely
from cuthelp import circle, closed
from shapely.geometry import LineString, Point, Polygon
from toolhelp import in_time

from skg.geometry.areas import lines_of
from skg.geometry.arrays import headings
from skg.geometry.contour import Contour, Edge
from skg.geometry.edge_arrays import boxes_of
from skg.geometry.field import Field
from skg.geometry.holding import Holding
from skg.geometry.piece import Piece
from skg.geometry.pieces import Pieces
from skg.geometry.plane import polar
from skg.planning.order import nearest_order
from skg.reading.meetings import _near_others


def field_of(contours: list[Contour]) -> Field:
    holding = Holding(contours)
    return Field(holding.points, holding.first)


def thrown(seed: int, count: int) -> list[Contour]:
    """Rectangles and triangles on small whole numbers, which touch and repeat, circles, and a line of 90 edges."""
    rng = random.Random(seed)
    found = []
    for _ in range(count):
        x, y, width, height = rng.randint(0, 40), rng.randint(0, 40), rng.randint(1, 9), rng.randint(1, 9)
        if rng.random() < 0.3:
            found.append(circle(x - width, y, width))
        else:
            corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
            found.append(closed([(float(u), float(v)) for u, v in corners[: rng.choice((3, 4))]]))
    zigzag = [(0.5 * k, 20.0 + k % 2) for k in range(91)]
    return [*found, Contour(tuple(Edge(p, q) for p, q in zip(zigzag, zigzag[1:], strict=False)), False)]


def test_boxes() -> None:
    """Of arcs from whole eighths of a circle to others, either way round, and of what is made of several."""
    arcs = [
        Edge(polar((3, -1), 2, first * pi / 4), polar((3, -1), 2, (first + turn) * pi / 4), (3, -1), turn * pi / 4)
        for first in range(-3, 5)
        for turn in (*range(-8, 0), *range(1, 9))
    ]
    contours = [*(Contour((arc,), False) for arc in arcs), *thrown(1, 20)]
    around, boxes = boxes_of(contours)
    edges = [edge for one in contours for edge in one.edges]
    for box, some in (
        *zip(boxes, ([edge] for edge in edges), strict=True),
        *zip(around, (one.edges for one in contours), strict=True),
    ):
        x, y = zip(*(place for edge in some for place in edge.extremes()), strict=True)
        assert box.tolist() == pytest.approx((min(x), min(y), max(x), max(y)), abs=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_contours_that_come_near(seed: int) -> None:
    """None is ignored that lies within reach of another one, to the last bit; what lies by itself in a frame or a
    circle is."""
    frame = closed([(-30, -30), (90, -30), (90, 90), (-30, 90)])
    alone, one_of_two, other = (closed([(x, 60), (x + 1, 60), (x + 1, 61)]) for x in (60, 70, 71.4))
    circles = [circle(200, 0, 9), circle(201, 1, 7), circle(250, 0, 9), circle(250, 2.6, 6)]
    contours, reach = [frame, alone, one_of_two, other, *circles, *thrown(seed, 25)], 0.5
    lines = lines_of(contours)
    one, other = shapely.STRtree(lines).query(lines, predicate="dwithin", distance=reach)
    near = set(one[one != other].tolist())
    found = set(_near_others(contours, reach).tolist())
    assert len(near) > 10 and {2, 3, 6, 7} <= near <= found and not found & {0, 1, 4, 5}


@pytest.mark.parametrize("seed", range(3))
def test_looks(seed: int) -> None:
    """All at once, some of them far outside: the nearest chord, and the next one ahead."""
    contours, rng = thrown(seed, 60), random.Random(seed)
    chords = [LineString([p, q]) for one in contours for p, q in zip(one.points(), one.points()[1:], strict=False)]
    everything = shapely.union_all(chords)
    places = [(rng.uniform(-20, 60), rng.uniform(-20, 60)) for _ in range(300)]
    reach, angles = [rng.choice((0.3, 2.0, 30.0)) for _ in places], [rng.uniform(-4, 4) for _ in places]
    least = [0.01] * len(places)
    field = field_of(contours)
    near = field.near(np.array(places), np.array(reach))
    ahead = field.ahead(np.array(places), headings(np.array(angles)), np.array(reach), np.array(least))
    hits = 0
    for (x, y), far, angle, is_near, is_ahead in zip(places, reach, angles, near, ahead, strict=True):
        way = LineString([(x + part * cos(angle), y + part * sin(angle)) for part in (0.01, far)])
        for got, what in ((is_near, everything), (is_ahead, everything.intersection(way))):
            true = shapely.distance(Point(x, y), what)
            if not true <= far:
                assert got == inf or got == pytest.approx(far, abs=1e-9)
            else:
                hits += 1
                assert got == pytest.approx(true, abs=1e-9)
    assert hits > 100


@pytest.mark.parametrize("seed", range(3))
def test_how_far_a_disc_gets(seed: int) -> None:
    """Up to there nothing is nearer than its radius, and there something is; also on whole numbers, along chords."""
    contours, rng = thrown(seed, 40), random.Random(seed)
    everything = shapely.union_all([LineString(one.points()) for one in contours])
    looks = []
    for _ in range(300):
        place, angle, least = (rng.uniform(-5, 50), rng.uniform(-5, 50)), rng.uniform(-4, 4), rng.uniform(0, 2)
        if rng.random() < 0.5:
            place, angle, least = (rng.randint(0, 40) / 2, rng.randint(0, 40) / 2), rng.randint(0, 3) * pi / 2, 0.5
        looks.append((place, angle, least + rng.choice((0.0, 2.0, 30.0)), least, rng.choice((0.1, 0.25, 1.0))))
    places, angles, *others = map(np.array, zip(*looks, strict=True))
    kinds = Counter()
    found = field_of(contours).before(places, headings(angles), *others).tolist()
    for (place, angle, reach, least, wide), far in zip(looks, found, strict=True):
        first, last = (polar(place, along, angle) for along in (least, min(far, reach)))
        if far == least:
            assert everything.distance(Point(first)) <= wide + 1e-9
        else:
            assert everything.distance(LineString([first, last])) >= wide - 1e-9
        if least < far < inf:
            assert everything.distance(Point(last)) == pytest.approx(wide, abs=1e-9)
        kinds[far == least, far == inf] += 1
    assert len(kinds) == 3 and min(kinds.values()) > 20


@pytest.mark.parametrize("seed", range(3))
def test_what_lies_around(seed: int) -> None:
    contours = thrown(seed, 60)
    holding = Holding(contours)
    areas = [Polygon(one.points()) if one.is_closed else None for one in contours]
    rng = random.Random(seed)
    places = [(rng.uniform(-1, 50), rng.uniform(-1, 50)) for _ in range(200)]
    for place, around in zip(places, holding.around(places), strict=True):
        assert around == [at for at, area in enumerate(areas) if area is not None and area.contains(Point(place))]
        free = [at for at in range(len(contours)) if at not in around]
        far = [min(edge.far(place) for edge in contours[at].edges) for at in free]
        # (chords of arcs are near enough for a start hole)
        assert far[free.index(holding.nearest(place, set(around)))] <= min(far) + 0.01


def test_depths_of_many() -> None:
    """Rings within rings, each begun at another corner, and one of 3,000 chords around them all."""
    rings = [closed([(k, k), (60 - k, k), (60 - k, 60 - k), (k, 60 - k)]) for k in range(20)]
    round_about = closed([(30 + 50 * cos(k * pi / 1500), 30 + 50 * sin(k * pi / 1500)) for k in range(3000)])
    aside = closed([(200, 0), (210, 0), (205, 5)])
    assert Holding([*rings, round_about, aside]).depths() == [*range(1, 21), 0, 0]
    assert Holding([]).depths() == []


@pytest.mark.parametrize("seed", range(5))
def test_nearest_order(seed: int) -> None:
    """Places anywhere, on whole numbers, on one line, in two heaps: of equally near ones the first is next."""
    rng = random.Random(seed)
    count = rng.choice((1, 2, 30, 400))
    kinds = [
        [(rng.uniform(0, 99), rng.uniform(0, 99)) for _ in range(count)],
        [(float(rng.randint(0, 9)), float(rng.randint(0, 9))) for _ in range(count)],
        [(float(rng.randint(0, 50)), 7.0) for _ in range(count)],
        [(rng.choice((0.0, 1e5)) + rng.random(), rng.random()) for _ in range(count)],
    ]
    for places in kinds:
        begin = at = rng.uniform(-500, 500), rng.uniform(-5, 5)
        left, wanted = list(range(count)), []
        while left:
            following = min(left, key=lambda k: ((places[k][0] - at[0]) ** 2 + (places[k][1] - at[1]) ** 2, k))
            left.remove(following)
            wanted.append(following)
            at = places[following]
        assert nearest_order(np.array(places), begin) == wanted


@pytest.mark.parametrize("reach", [0.006, 0.5, 4.0])
def test_nearest_pieces(reach: float) -> None:
    """Lines and arcs of three owners: the nearest of the place's own, and of another's."""
    rng = random.Random(1)
    pieces, shapes = [], []
    for at in range(400):
        x, y, owner = rng.uniform(0, 100), rng.uniform(0, 100), at % 3
        if at % 2:
            piece = Piece((x, y), (x + rng.uniform(-9, 9), y + rng.uniform(-40, 40)))
            shapes.append(LineString([piece.start, piece.end]))
        else:
            radius, first, sweep = rng.uniform(0.5, 5), rng.uniform(-3, 3), rng.uniform(-6, 6)
            ends = [(x + radius * cos(a), y + radius * sin(a)) for a in (first, first + sweep)]
            piece = Piece(*ends, (x, y), sweep)
            turns = np.linspace(first, first + sweep, 300)
            shapes.append(LineString(np.column_stack((x + radius * np.cos(turns), y + radius * np.sin(turns)))))
        pieces.append((piece, owner))
    path = Pieces(pieces)
    which, part = map(np.concatenate, zip(*path.batches(1.0, 2), strict=True))
    aside = np.array([[rng.uniform(-reach, reach) for _ in "xy"] for _ in which])
    places, owners = (
        np.vstack((path.at(which, part) + aside, [(1e4, 0), (-1e4, 50), (50, -1e4)])),
        [*which % 3, 0, 1, 2],
    )
    found = path.nearest(places, np.array(owners), reach)
    seen = 0
    for at in range(0, len(places), 29):
        far = shapely.distance(Point(places[at]), shapes)
        is_own = np.array([owner == owners[at] for _, owner in pieces])
        for mask, got, number in (
            (is_own, found.own[at], found.own_at[at]),
            (~is_own, found.other[at], found.other_at[at]),
        ):
            if far[mask].min() <= reach - 1e-3:
                seen += 1
                assert got == pytest.approx(far[mask].min(), abs=1e-3)
                assert far[number] == pytest.approx(got, abs=1e-3)
                assert mask[number]
    assert seen > 100


def test_nearest_of_its_own_among_many_others() -> None:
    """With a wide reach: 400 rings of 50 lines close together, places around one of them and one of its neighbours."""
    rings = [(0.8 * (at % 20), 0.8 * (at // 20)) for at in range(400)]
    corners = [[polar(middle, 0.3, 2 * pi * k / 50) for k in range(51)] for middle in rings]
    path = Pieces((Piece(p, q), at) for at, ring in enumerate(corners) for p, q in pairwise(ring))
    places = np.random.default_rng(1).uniform(-1, 1, (400, 2)) + rings[210]
    owners = np.where(np.arange(400) % 3, 210, 211)
    ways = path.nearest_own, lambda *given: path.nearest(*given).own_at
    own, at = in_time(0.5, *(partial(way, places, owners, 2.2) for way in ways))
    assert (own >= 0).all() and (path.owner[own] == owners).all()
    assert path.from_place(places, own) == pytest.approx(path.from_place(places, at), abs=1e-12)
    # (where they are those of half of the path and more, all of it is looked at; far away there are none)
    most = np.arange(400) % 400
    near = path.nearest(places, most, 0.3)
    assert (path.nearest_own(places, most, 0.3) == np.where(near.own <= 0.3, near.own_at, -1)).all()
    assert (path.nearest_own(places + 90, owners, 2.2) == -1).all()


def test_depths_of_neighbours() -> None:
    """Tiles that share edges and corners, alone, in a plate whose edge some of them touch, with holes of their own."""
    rng = random.Random(7)
    looked_at = 0
    for _ in range(40):
        contours = []
        for _ in range(rng.randint(4, 14)):
            x, y, width, height = rng.randint(0, 6), rng.randint(0, 6), rng.randint(1, 5), rng.randint(1, 5)
            corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
            first = rng.randrange(4)
            contours.append(closed([(float(u), float(v)) for u, v in corners[first:] + corners[:first]]))
        shapes = [Polygon(one.points()) for one in contours]
        for at, (shape, depth) in enumerate(zip(shapes, Holding(contours).depths(), strict=True)):
            others = shapes[:at] + shapes[at + 1 :]
            if all(not shape.overlaps(other) and not shape.equals(other) for other in others):
                assert depth == sum(other.covers(shape) for other in others)
                looked_at += 1
    assert looked_at > 50


def test_depths_of_what_crosses() -> None:
    """Round reliefs in the corners of a plate's notch and of its window are openings, each like the other."""
    plate = [(0, 0), (40, 0), (40, 20), (25, 20), (25, 14), (15, 14), (15, 20), (0, 20)]
    window = [(10, 4), (30, 4), (30, 10), (10, 10)]
    reliefs = [circle(x, y, 1) for x, y in [(15, 14), (25, 14), *window]]
    shapes = [closed([(float(x), float(y)) for x, y in corners]) for corners in (plate, window)]
    assert Holding([*reliefs, *shapes]).depths() == [1] * 6 + [0, 1]


def test_depths_of_what_is_as_large() -> None:
    """Two squares that cross, each as large as the other: neither is an opening of the other."""
    squares = [closed([(x, y), (x + 9, y), (x + 9, y + 9), (x, y + 9)]) for x, y in ((0.0, 0.0), (2.1, 3.3))]
    assert Holding(squares).depths() == [0, 0]


@pytest.mark.parametrize("is_turned", [False, True])
def test_depths_of_crossed_slots(is_turned: bool) -> None:
    """Slots that cross in a plate are openings, also where one lies in the other by half, and two as large ones, and
    one that two others cover; what lies in a window by itself, or crosses another such, is none."""

    def box(x: int, y: int, width: int, height: int) -> Contour:
        corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
        return closed([(float(v), float(u)) if is_turned else (float(u), float(v)) for u, v in corners])

    plate, window = box(0, 0, 60, 40), box(2, 20, 30, 18)
    slots = [
        box(5, 8, 16, 4),
        box(12, 6, 4, 7),
        box(40, 10, 8, 6),
        box(41, 9, 6, 8),
        box(35, 20, 4, 10),
        box(33, 22, 8, 5),
        box(40, 28, 12, 6),
        box(34, 24, 12, 14),
        box(45, 23, 12, 14),
    ]
    inner = [box(4, 22, 20, 8), box(8, 26, 5, 10)]
    depths = Holding([plate, window, *slots, *inner]).depths()
    assert depths[:2] == [0, 1]
    assert all(depth % 2 for depth in depths[2:11]), depths
    assert depths[11] == 2
