"""Drawings that are mended before they are cut: where the tape is further than 5 um from the file, the report says so.

The judge has nothing of skg's reading: the entities as ezdxf draws them, the tape as the controller goes, shapely.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from math import cos, hypot, pi, sin
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
import shapely
from cuthelp import drawing, run_failing, saved, stretches
from ezdxf.document import Drawing
from facthelp import says
from toolhelp import Run

from skg.checking import check_drawn
from skg.checking.check_drawn import NEAR, Named, off_drawn
from skg.geometry.contour import Contour, Edge
from skg.geometry.pieces import Pieces
from skg.geometry.plane import XY
from skg.messages.finding import Phrase
from skg.reading.chain import chain
from skg.reading.curves import conic

Report = dict[str, Any]
#: The tape may be so far from the file where nothing is said, mm; what is measured here is so exact.
LIMIT, EXACT = 0.005, 0.0006
#: Findings of what was mended: where the tape may be further from the file, by their sizes.
_MENDS = {"ends-joined", "edge-too-short", "overruns", "loops", "whiskers", "lines-twice", "lines-overlap"}
_SIZES = ("gap", "length", "longest")


def nominal(page: Drawing) -> shapely.MultiLineString:
    """All that is drawn, by ezdxf. (its paths are Bézier curves, a few micrometres beside an arc)"""
    entities = [
        part
        for entity in page.modelspace()
        for part in (entity.virtual_entities() if entity.dxftype() == "LWPOLYLINE" else [entity])
    ]
    return shapely.MultiLineString(
        [
            [(point[0], point[1]) for point in places]
            for places in (
                (part.dxf.start, part.dxf.end) if part.dxftype() == "LINE" else part.flattening(EXACT / 3)
                for part in entities
            )
        ]
    )


def wire(tape: bytes, report: Report) -> shapely.MultiLineString:
    """The tape's path between the ways from and to its start holes."""
    start = tuple(report["starts"][0])
    return shapely.MultiLineString([places[1:-1] for places in stretches(tape, start) if len(places) > 3])


def named(report: Report) -> list[tuple[XY, float]]:
    """The places that a report names where a drawing was mended, each with its size, mm."""
    result = []
    for finding in report["findings"]:
        if finding["code"] in _MENDS:
            values = finding["values"]
            size = max((values[name] for name in _SIZES if name in values), default=LIMIT)
            result += [(place, size) for place in values.get("places", [finding["place"]])]
    return result


def unsaid(page: Drawing, tape: bytes, report: Report) -> float:
    """The largest distance of tape and file, both ways, where the report names no mend, mm."""
    drawn, cut = nominal(page), wire(tape, report)
    excused = shapely.union_all([shapely.Point(place).buffer(size + 2 * LIMIT) for place, size in named(report)])
    worst = 0.0
    for one, other in ((drawn, cut), (cut, drawn)):
        places = shapely.points(shapely.get_coordinates(one.segmentize(0.05)))
        far = shapely.distance(places, other)
        worst = max(worst, float(far[~shapely.contains(excused, places)].max(initial=0.0)))
    return worst


def plate(rng: Random, corners: list[XY], gap: Callable[[], float], page: Drawing) -> None:
    """An outline of lines and arcs; at each corner the two ends are moved, along and aside."""
    space = page.modelspace()
    for (x, y), (u, v) in pairwise([*corners, corners[0]]):
        length = hypot(u - x, v - y)
        along, across = ((u - x) / length, (v - y) / length), (-(v - y) / length, (u - x) / length)
        ends = [
            (p + ahead * along[0] + aside * across[0], q + ahead * along[1] + aside * across[1])
            for p, q in ((x, y), (u, v))
            for ahead, aside in ((gap(), gap()),)
        ]
        if rng.random() < 0.3:
            # (an arc that bulges a little)
            bulge = rng.uniform(0.1, 0.4)
            space.add_lwpolyline([(*ends[0], bulge), (*ends[1], 0)], format="xyb")
        else:
            space.add_line(*ends)


def polygon_of(rng: Random) -> list[XY]:
    count = rng.randrange(3, 7)
    return [
        (30 * cos(2 * pi * k / count) * rng.uniform(0.7, 1), 30 * sin(2 * pi * k / count) * rng.uniform(0.7, 1))
        for k in range(count)
    ]


def gaps(rng: Random, page: Drawing) -> list[str]:
    plate(rng, polygon_of(rng), lambda: rng.choice((0, rng.uniform(-0.1, 0.1))), page)
    return ["--tolerance", "0.3"]


def small_gaps(rng: Random, page: Drawing) -> list[str]:
    plate(rng, polygon_of(rng), lambda: rng.uniform(-0.002, 0.002), page)
    return []


def whole_gaps(rng: Random, page: Drawing) -> list[str]:
    """Small whole numbers, where gaps lie on lines and corners coincide."""
    corners = [(0, 0), (20, 0), (20, 10), (10, 10), (10, 20), (0, 20)]
    plate(rng, corners, lambda: rng.choice((0, 0, 0.1, -0.1)), page)
    return ["--tolerance", "0.3"]


def overruns(rng: Random, page: Drawing) -> list[str]:
    space, corners = page.modelspace(), polygon_of(rng)
    for (x, y), (u, v) in pairwise([*corners, corners[0]]):
        length = hypot(u - x, v - y)
        before, behind = (rng.choice((0, rng.uniform(0.01, 0.15))) / length for _ in range(2))
        space.add_line((x - before * (u - x), y - before * (v - y)), (u + behind * (u - x), v + behind * (v - y)))
    return []


def doubles(rng: Random, page: Drawing) -> list[str]:
    """Lines drawn a second time, a little beside."""
    space, corners = page.modelspace(), polygon_of(rng)
    for (x, y), (u, v) in pairwise([*corners, corners[0]]):
        space.add_line((x, y), (u, v))
        if rng.random() < 0.6:
            by = rng.uniform(-0.0025, 0.0025)
            space.add_line((u, v + by), (x, y + by))
    space.add_circle((0, 0), 5)
    space.add_circle((rng.uniform(-0.0025, 0.0025), 0), 5)
    return []


def short_edges(rng: Random, page: Drawing) -> list[str]:
    """Polylines with edges from 0.1 um to 0.1 mm long, several of them after each other."""
    places, x = [(0.0, 0.0)], 0.0
    for _ in range(rng.randrange(50, 200)):
        x += rng.choice((1e-4, 5e-4, 9e-4, 2e-3, 0.1))
        places.append((x, 5 * x * rng.uniform(0, 0.02)))
    page.modelspace().add_lwpolyline([*places, (x + 10, 10), (-5, 10)], close=True)
    return ["--tolerance", rng.choice(("0.005", "0.1"))]


def overlaps(rng: Random, page: Drawing) -> list[str]:
    """A side of lines that share stretches, and a circle of arcs that do; whole numbers."""
    space, corners = page.modelspace(), [(0, 0), (40, 0), (40, 30), (0, 30)]
    for (x, y), (u, v) in pairwise([*corners, corners[0]]):
        length = round(hypot(u - x, v - y))
        ends = sorted(rng.sample(range(2, length - 8), rng.randrange(3)))
        for begin, end in zip([0, *ends], [*(end + rng.randrange(1, 6) for end in ends), length], strict=True):
            places = [(x + way * (u - x) / length, y + way * (v - y) / length) for way in (begin, end)]
            space.add_line(*rng.sample(places, 2))
    turn = rng.randrange(360)
    space.add_arc((20, 15), 8, turn, turn + 190 + rng.randrange(9))
    space.add_arc((20, 15), 8, turn + 170, turn + rng.randrange(361, 375))
    return []


MENDS = [gaps, small_gaps, whole_gaps, overruns, doubles, short_edges, overlaps]


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("mend", MENDS)
def test_each_mend_is_said(mend: Callable[[Random, Drawing], list[str]], seed: int, run: Run, tmp_path: Path) -> None:
    """Whatever is further than 5 um from the file is named with its place and size, or refused."""
    page = drawing()
    options = mend(Random(f"{mend.__name__} {seed}"), page)
    part, tape = saved(page, tmp_path), tmp_path / "part.3b"
    report = json.loads(run("cut", part, "-o", tape, *options, "--json").stderr)
    assert unsaid(page, tape.read_bytes(), report) < LIMIT + EXACT, report


def test_the_judge_sees_what_is_not_said(run: Run, tmp_path: Path) -> None:
    """A join whose line is taken out of the report, and a tape of another drawing."""
    page = drawing()
    options = whole_gaps(Random(1), page)
    part, tape = saved(page, tmp_path), tmp_path / "part.3b"
    report = json.loads(run("cut", part, "-o", tape, *options, "--json").stderr)
    assert any(finding["code"] == "ends-joined" for finding in report["findings"])
    kept = report | {"findings": [finding for finding in report["findings"] if finding["code"] != "ends-joined"]}
    assert unsaid(page, tape.read_bytes(), report) < LIMIT + EXACT < unsaid(page, tape.read_bytes(), kept)


@pytest.mark.parametrize("seed", range(20))
def test_what_overlaps_is_cut_once(seed: int, run: Run, tmp_path: Path) -> None:
    """An outline of 140 mm and a circle, closed, with an offset, however the lines and arcs share stretches."""
    page = drawing()
    overlaps(Random(seed), page)
    report = run("cut", saved(page, tmp_path), "-o", tmp_path / "a.3b", "--offset", "0.1").stderr
    read = Phrase("contours-read", count=2), Phrase("count-closed", count=2), re.compile(r"\b190\.26(54|55)\b")
    assert says(report, *read) and says(report, Phrase("lines-twice"))


def lines(*ends: tuple[float, float, float, float]) -> Drawing:
    page = drawing()
    for x, y, u, v in ends:
        page.modelspace().add_line((x, y), (u, v))
    return page


def test_parts_that_share_an_edge_are_no_overlap(run: Run, tmp_path: Path) -> None:
    """A small square on the middle of a side of a large one, whose edge there is drawn with both."""
    large = [(0, 0, 40, 0), (40, 0, 40, 20), (40, 20, 0, 20), (0, 20, 0, 0)]
    small = [(10, 0, 20, 0), (20, 0, 20, -9), (20, -9, 10, -9), (10, -9, 10, 0)]
    report = run("cut", saved(lines(*large, *small), tmp_path), "-o", tmp_path / "a.3b").stderr
    assert says(report, Phrase("contours-read", count=2, length=158), Phrase("count-closed", count=2))


def test_a_line_on_another(run: Run, tmp_path: Path) -> None:
    """An open line within an open line is cut with it."""
    part = saved(lines((0, 0, 40, 0), (30, 0, 10, 0), (40, 0, 40, 9)), tmp_path)
    report = run("cut", part, "-o", tmp_path / "a.3b").stderr
    assert says(report, Phrase("contours-read", count=1, length=49), Phrase("count-open", count=1)) and says(
        report, Phrase("lines-twice", count=1)
    )


#: An outline that has a spur and is open at a corner, around two holes; around one.
LOST = [(0, 0, 40, 0), (40, 0, 40, 20), (40, 20, 0, 20), (0, 20, 0, 3), (40, 20, 45, 25)]


@pytest.mark.parametrize("holes", [1, 2])
def test_an_outline_that_is_lost_is_refused(holes: int, run: Run, tmp_path: Path) -> None:
    """With an offset, unless it was said what becomes of open lines: its holes would be cut as outlines."""
    page = lines(*LOST)
    for hole in range(holes):
        page.modelspace().add_circle((10 + 15 * hole, 10), 3)
    words = ("cut", saved(page, tmp_path), "-o", tmp_path / "a.3b")
    assert says(run_failing(run, *words, "--offset", "0.1"), Phrase("outline-lost"), "--open cut")
    assert not (tmp_path / "a.3b").exists()
    for more in (["--offset", "0.1", "--open", "cut"], ["--offset", "0.1", "--open", "leave"], []):
        assert says(run(*words, *more).stderr, Phrase("contours-read"), Phrase("count-closed", count=holes))


#: The plate of the fault: its left edge ends 0.2 mm above the corner.
OPEN = [((0, 0), (30, 0)), ((30, 0), (30, 20)), ((30, 20), (0, 20)), ((0, 20), (0, 0.2))]


def test_a_joined_gap_tilts_nothing(run: Run, tmp_path: Path) -> None:
    """The bottom edge stays where it is, the left one goes on to it; --quiet says it, too."""
    page = drawing()
    for ends in OPEN:
        page.modelspace().add_line(*ends)
    part, tape, program = saved(page, tmp_path), tmp_path / "part.3b", tmp_path / "part.skg"
    words = ("cut", part, "-o", tape, "--program", program, "--offset", "0.1")
    assert says(run_failing(run, *words), Phrase("open-refused"), Phrase("first-gap", gap=0.2), "--tolerance")
    for quiet in ([], ["--quiet"]):
        report = run(*words, "--tolerance", "0.21", *quiet).stderr
        assert says(report, Phrase("ends-joined", gap=0.2, place=(0, 0.1)))
    assert "(0,0)" in program.read_text() and "(30,0)" in program.read_text()


@pytest.mark.parametrize(
    ("one", "other", "corners"),
    [
        # Lines that go on, one that runs past, lines on one line, lines beside each other.
        (((0, 0), (9.9, 0)), ((10, 0.1), (10, 5)), [(10, 0)]),
        (((0, 0), (10.1, 0)), ((10, 0.1), (10, 5)), [(10, 0)]),
        (((0, 0), (9, 0)), ((9.2, 0), (20, 0)), [(9, 0), (9.2, 0)]),
        (((0, 0), (9, 0)), ((9, 0.2), (20, 0.2)), [(9, 0), (9, 0.2)]),
    ],
)
def test_joins(one: tuple[XY, XY], other: tuple[XY, XY], corners: list[XY]) -> None:
    """Two lines become a run with these corners."""
    chains = chain([Edge(*one, entity=0), Edge(*other, entity=1)], 0.25)
    (contour,) = chains.contours
    inner = [edge.end for edge in contour.edges[:-1]]
    assert [pytest.approx(corner) for corner in corners] == inner
    assert len(chains.joins) == 1 and chains.joins[0].width == pytest.approx(hypot(*np.subtract(one[1], other[0])))


def contour(*places: XY) -> Contour:
    return Contour(tuple(Edge(p, q, entity=0) for p, q in pairwise([*places, places[0]])), True)


def test_what_is_compared_with_the_file() -> None:
    """A contour that is off its entities, one that lacks a part of them; both are excused where that is named."""
    square = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]
    drawn = list(contour(*square).edges)
    for places, off, place, size in (
        (square, 0.0, (5, 5), 1),
        ([(0.0, 0.02), *square[1:]], 0.02, (0, 0), 10),
        ([(0.0, 0.02), *square[1:]], 0.02, (0, 0), 0.02),
        ([(0.0, 0.5), *square[1:]], np.inf, (0, 0), 10),
        ([*square[:2], (5.0, 10.0), (0.0, 10.0)], np.inf, (10, 10), 15),
    ):
        cut = [contour(*places)]
        assert off_drawn(cut, drawn, {0: False}, []).off == pytest.approx(off, rel=1e-3)
        excused = off_drawn(cut, drawn, {0: False}, [Named(place, size)]).off
        assert excused <= NEAR if size != 0.02 else excused > NEAR


def test_only_what_is_off_is_held_against_what_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """A large drawing has many places and many repairs: each pair of them would be asked for."""
    asked: list[int] = []

    def are_named(places: np.ndarray, named: list[Named]) -> np.ndarray:
        asked.append(len(places))
        return np.ones(len(places), bool)

    monkeypatch.setattr(check_drawn, "_are_named", are_named)
    square = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]
    drawn = list(contour(*square).edges)
    assert off_drawn([contour((0.0, NEAR / 2), *square[1:])], drawn, {0: False}, []).off == pytest.approx(NEAR / 2)
    assert sum(asked) == 0
    assert off_drawn([contour((0.0, 4 * NEAR), *square[1:])], drawn, {0: False}, []).off <= NEAR
    # (two edges of four lead to the corner, each off along three quarters of its length, 0.05 mm from place to place)
    assert 250 < sum(asked) < 700


def test_a_curve_that_is_entered_is_compared_where_it_is_another_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """A contour has it in two; only chords that the drawing has not are measured."""
    drawn = conic((0.0, 0.0), (10.0, 0.0), (0.0, 4.0), 0.0, 2 * pi, 0.002, 0)
    k = len(drawn.nodes) // 2
    middle = drawn.nodes[k].point
    (at,) = np.flatnonzero((drawn.samples == middle).all(1)).tolist()
    begin = replace(drawn, end=middle, nodes=drawn.nodes[: k + 1], samples=drawn.samples[: at + 1])
    rest = replace(drawn, start=middle, nodes=drawn.nodes[k:], samples=drawn.samples[at:])
    moved = rest.samples.copy()
    moved[20] += 0.02
    measured: list[int] = []
    nearest = Pieces.nearest
    monkeypatch.setattr(
        Pieces, "nearest", lambda self, places, *more: measured.append(len(places)) or nearest(self, places, *more)
    )
    for edges, off, least, most in (
        ((rest, begin), 0.0, 0, 0),
        ((rest.reversed(), begin.reversed()), 0.0, 0, 0),
        ((replace(rest, samples=moved), begin), 0.02, 4, 50),
        ((begin, Edge(middle, drawn.start, entity=0)), np.inf, 200, 2000),
    ):
        measured.clear()
        found = off_drawn([Contour(edges, True)], [drawn], {0: False}, []).off
        assert found == pytest.approx(off, rel=0.5), edges
        assert least <= sum(measured) <= most
