"""Contours with edges that the wire cannot follow: `skg cut` goes past them. The judge is shapely's buffer."""

from __future__ import annotations

import random
import re
from collections.abc import Callable
from itertools import pairwise
from math import atan, atan2, cos, dist, pi, radians, sin, sqrt, tan
from pathlib import Path

import pytest
from cuthelp import LIMIT, apart, closed, drawing, polygon, run_failing, saved, stretches, values_of
from ezdxf.layouts import Modelspace
from facthelp import CARE, each_says, says
from shapely import hausdorff_distance, union_all
from shapely.geometry import LinearRing, LineString, Point, Polygon
from toolhelp import Run, in_time

from skg.geometry.contour import Contour, Edge
from skg.geometry.fitting import curve_edge
from skg.geometry.offset import NoRoom, part_between, wire_path
from skg.geometry.plane import XY
from skg.messages.finding import Phrase


def steps(space: Modelspace) -> Polygon:
    """A window whose corners have a step, a chamfer and a fillet that are smaller than R, and a round end."""
    corners = [
        (0, 0, 0),
        (9.96, 0, 0),
        (9.96, 0.03, 0),
        (10, 0.03, 0),
        (10, 5.97, 0),
        (9.97, 6, 0),
        (1.5, 6, 1),
    ]
    corners += [(0, 4.5, 0.4142135623730951), (-0.05, 4.45, 0)]
    space.add_lwpolyline(corners, "xyb", close=True)
    return rough(corners)


def rough(corners: list[tuple[float, float, float]]) -> Polygon:
    """A polyline with bulges as a polygon of short chords."""
    places: list[XY] = []
    for (x, y, bulge), (u, v, _) in zip(corners, [*corners[1:], corners[0]], strict=True):
        one, other = complex(x, y), complex(u, v)
        if not bulge:
            places.append((x, y))
            continue
        centre = (one + other) / 2 + (other - one) / 2 * 1j * (1 - bulge * bulge) / (2 * bulge)
        sweep = 4 * atan(bulge)
        for k in range(400):
            at = centre + (one - centre) * complex(cos(sweep * k / 400), sin(sweep * k / 400))
            places.append((at.real, at.imag))
    return Polygon(places)


def petals(space: Modelspace) -> Polygon:
    """A closed spline with narrow bends inwards."""
    controls = [
        (
            (12 if k % 2 else 7) * cos(k * pi / 7),
            (12 if k % 2 else 7) * sin(k * pi / 7),
            0,
        )
        for k in range(14)
    ]
    spline = space.add_spline(dxfattribs={"degree": 2})
    spline.set_closed(controls, degree=2)
    return Polygon([(point.x, point.y) for point in spline.construction_tool().approximate(6000)])


def arch(space: Modelspace) -> Polygon:
    """A plate with half an ellipse cut out of it: in its corners the wire does not come to the curve's first span."""
    space.add_ellipse((0, 0), (0.9, 0), 0.55, 0, pi)
    corners = [(-0.9, 0), (-2, 0), (-2, 3), (2, 3), (2, 0), (0.9, 0)]
    for p, q in zip(corners, corners[1:], strict=False):
        space.add_line(p, q)
    curve = [(0.9 * cos(pi * k / 150), 0.9 * 0.55 * sin(pi * k / 150)) for k in range(1, 150)]
    return Polygon([*curve, *corners])


def keyhole(space: Modelspace) -> Polygon:
    """A circle of 330 degrees, and a slot with a chamfer that is smaller than R."""
    x, y = 5 * cos(radians(15)), 5 * sin(radians(15))
    corners = [(x, y, tan(radians(330 / 4))), (x, -y, 0), (8.97, -y, 0), (9, 0.03 - y, 0), (9, y, 0)]
    space.add_lwpolyline(corners, "xyb", close=True)
    return rough(corners)


def parallel(shape: Polygon, offset: float, side: str, style: str = "round") -> LinearRing:
    """The wire's way as shapely has it, around sharp corners or up to where their lines meet."""
    if side == "inside":
        # (GEOS is wrong by 0.02 mm and more where many short chords come to a corner: few chords, a few at a time)
        places = shape.exterior.coords
        pieces = [LineString(places[k : k + 6]).buffer(offset, quad_segs=200) for k in range(0, len(places) - 1, 5)]
        return shape.difference(union_all(pieces)).exterior
    return shape.buffer(offset, quad_segs=200, join_style=style, mitre_limit=50).exterior


#: NoRoom of a slot.
NOT_THERE = "room-slot"


def cut(run: Run, page: object, folder: Path, *words: object) -> tuple[list[list[XY]], str]:
    tape, program = folder / "part.3b", folder / "part.skg"
    result = run("cut", saved(page, folder), "-o", tape, "--program", program, *words)
    start = program.read_text().split("FROM (")[1].split(")")[0].split(",")
    return list(stretches(tape.read_bytes(), (float(start[0]), float(start[1])))), result.stderr


@pytest.mark.parametrize("side", ["inside", "outside"])
@pytest.mark.parametrize(("shape", "offset"), [(steps, 0.1), (petals, 0.9), (arch, 0.15), (keyhole, 0.1)])
def test_past_what_is_too_small(
    run: Run,
    tmp_path: Path,
    shape: Callable[[Modelspace], Polygon],
    offset: float,
    side: str,
) -> None:
    """The wire stays R beside the contour, everywhere that it can come to."""
    page = drawing()
    wanted = shape(page.modelspace())
    (places,), words = cut(run, page, tmp_path, "--offset", offset, "--side", side)
    way = LineString(places[1:-1])
    assert min(apart(way, parallel(wanted, offset, side, style)) for style in ("round", "mitre")) < LIMIT
    assert places[0] == pytest.approx(places[-1], abs=1e-9)
    assert says(words, CARE, Phrase("narrow-corners", turn=1)) == (side == "inside" or shape is steps)


def test_a_curve_with_a_cusp_is_soon_told_from_a_way_beside_it(run: Run, tmp_path: Path) -> None:
    """The parallels of a cusp meet nowhere near: following the wire there and comparing its places took 2 GB."""
    page = drawing()
    polygon([(-2, -2), (8, -2), (8, 8), (-2, 8)], page)
    spline = page.modelspace().add_spline(degree=3)
    spline.set_closed([(0, 0, 0), (2, 3, 0), (6, 0, 0), (0, 0, 0), (1, 6, 0)])
    path = saved(page, tmp_path)
    told, _ = in_time(
        20,
        lambda: run_failing(run, "cut", path, "--offset", 0.1),
        lambda: run("cut", path, "-o", tmp_path / "part.3b"),
    )
    assert says(told, Phrase("no-room-crossing"), Phrase("crosses-itself"), re.compile(r"\(0\.8945, 1\.44\d*\)"))


@pytest.mark.parametrize(("height", "style"), [(0.05, "round"), (1, "round"), (3.9, "round"), (4.2, "mitre")])
def test_around_a_tip(run: Run, tmp_path: Path, height: float, style: str) -> None:
    """If the parallels meet more than 10 R away the wire goes around the tip: it does not reach the other part."""
    page = drawing()
    wanted = polygon([(0, 0), (20, 0), (0, height)], page)
    polygon([(21.5, -5), (30, -5), (30, 5), (21.5, 5)], page)
    (places, *_), words = cut(run, page, tmp_path, "--offset", 0.1)
    assert apart(LineString(places[1:-1]), parallel(wanted, 0.1, "outside", style)) < LIMIT
    assert says(words, Phrase("around-tips")) == (style == "round")
    assert not says(words, Phrase("narrow-corners")) and not says(words, Phrase("gouge"))


def test_a_start_hole_that_is_chosen_is_where_the_wire_comes_to(run: Run, tmp_path: Path) -> None:
    """A window with a crooked tail that is too narrow, and has its longest edges: the wire is threaded in its head."""
    page = drawing()
    tail = [(0.3 + 0.15 * k, 0.1 * (k % 2)) for k in range(10)]
    head = [(0.5 * cos(angle / 20) - 0.2, 0.5 * sin(angle / 20) + 0.1) for angle in range(4, 122)]
    wanted = polygon([*tail, *((x, y + 0.15) for x, y in reversed(tail)), *head], page)
    (places,), words = cut(run, page, tmp_path, "--offset", 0.1, "--side", "inside")
    assert apart(LineString(places[1:-1]), parallel(wanted, 0.1, "inside")) < LIMIT
    assert says(words, CARE, Phrase("narrow-corners", turn=1))


def test_a_start_hole_between_two_circles_moves_to_the_inner_side(run: Run, tmp_path: Path) -> None:
    """A disc in a round window with less than R between them is left out: then the window has its start hole inside."""
    page = drawing()
    page.modelspace().add_lwpolyline([(-10, -10), (10, -10), (10, 10), (-10, 10)], close=True)
    for x, radius in ((0.1, 5.08), (0.12, 5)):
        page.modelspace().add_circle((x, 0.2), radius)
    (places, _), words = cut(run, page, tmp_path, "--offset", 0.1, "--small", "leave")
    assert says(words, Phrase("contour-not-cut"), Phrase("would-cut-into"), Phrase("kind-outline"))
    assert apart(LineString(places[1:-1]), Point(0.1, 0.2).buffer(4.98, quad_segs=400).exterior) < LIMIT


@pytest.mark.parametrize(("side", "tip"), [("outside", 20), ("inside", 60)])
def test_a_slot_that_is_too_narrow_is_no_corner(run: Run, tmp_path: Path, side: str, tip: int) -> None:
    """A blind slot of 1 mm, in an outline or from a window: a wider wire would leave it out; half of that cuts it."""
    page = drawing()
    slot = [(40, 15), (tip, 15), (tip, 16), (40, 16)]
    polygon([(0, 0), (40, 0), *slot, (40, 30), (0, 30)], page)
    words = run_failing(run, "cut", saved(page, tmp_path), "--offset", 0.51, "--side", side)
    assert says(
        words,
        re.compile(rf"\({(40 + tip) // 2}, 1[\d.]*\)"),
        Phrase("no-room", r=0.51),
        Phrase("fits-at-most", fit=0.5),
    )
    (places,), words = cut(run, page, tmp_path, "--offset", 0.45, "--side", side)
    assert LineString(places).distance(Point(tip + (0.45 if side == "outside" else -0.45), 15.5)) < 0.05 + LIMIT


@pytest.mark.parametrize(("width", "fits"), [(0.05, 0.025), (0.15, 0.075)])
def test_a_slot_with_walls_of_chords_is_no_corner(run: Run, tmp_path: Path, width: float, fits: float) -> None:
    """Walls of lines that are shorter than the wire is wide, all but straight on: it does not come to them."""
    page = drawing()
    wall = [(5 + 0.002 * (at % 2), at * 0.18) for at in range(12)]
    polygon([(0, 0), *wall, *((x + width, y) for x, y in reversed(wall)), (10, 0), (10, 10), (0, 10)], page)
    words = run_failing(run, "cut", saved(page, tmp_path), "-o", tmp_path / "part.3b", "--offset", 0.1)
    fit = Phrase("fits-at-most", fit=fits)
    assert says(words, Phrase("no-room", r=0.1, fit=fit), re.compile(r"\(5[\d.]*, [\d.]+\)"))
    cut(run, page, tmp_path, "--offset", fits - 0.001)


@pytest.mark.parametrize(("depth", "is_round"), [(2.0, False), (2.0, True), (0.9, False), (0.86, False)])
def test_how_far_the_wire_stays_off_a_wedge_is_said(run: Run, tmp_path: Path, depth: float, is_round: bool) -> None:
    """It comes in until its walls are 2 R apart; a corner of more than 60 degrees, or an outer one, is not named."""
    page = drawing()
    tip = [(5.0, depth)] if not is_round else [(4.99, depth), (5.01, depth)]
    polygon([(0, 0), (4.5, 0), *tip, (5.5, 0), (10, 0), (10, 10), (5, 20), (0, 10)], page)
    (places,), words = cut(run, page, tmp_path, "--offset", 0.1)
    far = LineString(places).distance(Point(tip[0])) - 0.1
    path, tape = tmp_path / "part.dxf", tmp_path / "part.3b"
    said = values_of("narrow-corners", run, path, "-o", tape, "--offset", 0.1)
    assert bool(said) == says(words, CARE, Phrase("narrow-corners")) == (depth > 0.5 * sqrt(3)), words
    if said:
        assert tuple(said[0]["place"]) == pytest.approx(tip[0]) and said[0]["far"] == pytest.approx(far, abs=LIMIT)
        assert far > 0.1


def test_the_wire_ends_where_a_slot_of_curves_narrows(run: Run, tmp_path: Path) -> None:
    """Two splines that come nearer by some um in a mm: where they are less than 2 R apart is not looked at."""
    page = drawing()
    space = page.modelspace()
    side = [(3, -0.506), (2, -0.504), (1, -0.501), (0, -0.498)]
    for sign in (1, -1):
        space.add_open_spline([(x, sign * y, 0) for x, y in side])
    for places in [[(0, -0.498), (0, 0.498)], [(3, 0.506), (3, 4), (-4, 4), (-4, -4), (3, -4), (3, -0.506)]]:
        for p, q in zip(places, places[1:], strict=False):
            space.add_line(p, q)
    _, words = cut(run, page, tmp_path, "--offset", 0.5)
    assert says(words, CARE, Phrase("narrow-corners"), re.compile(r"\(0, [\d.-]+\)"))


def test_passes_and_tab(run: Run, tmp_path: Path) -> None:
    """Each pass has its own way; the tab is cut off on the way of the first, which is through metal too."""
    page = drawing()
    wanted = steps(page.modelspace())
    cuts, words = cut(run, page, tmp_path, "--offset", 0.1, "--passes", "0.05,0", "--tab", 2)
    assert len(cuts) == 2 and says(words, CARE, Phrase("narrow-corners", turn=1))
    outer, inner = (parallel(wanted, away, "outside", "mitre") for away in (0.15, 0.1))
    for ring in (outer, inner):
        part = LineString(cuts[0]).intersection(ring.buffer(LIMIT))
        assert ring.length - 3 < part.length < ring.length - 1.8
    tab = LineString(cuts[1]).intersection(outer.buffer(LIMIT))
    assert 2 - LIMIT < tab.length < 2.5


def test_what_the_wire_does_not_come_to(run: Run, tmp_path: Path) -> None:
    """A window of two rooms with a door that is too narrow: said with the place, nothing is written."""
    page = drawing()
    page.modelspace().add_lwpolyline([(-20, -20), (40, -20), (40, 20), (-20, 20)], close=True)
    rooms = [
        (0, 0),
        (8, 0),
        (8, 3.9),
        (12, 3.9),
        (12, 0),
        (20, 0),
        (20, 8),
        (12, 8),
        (12, 4.1),
        (8, 4.1),
        (8, 8),
        (0, 8),
    ]
    page.modelspace().add_lwpolyline(rooms, close=True)
    message = run_failing(run, "cut", saved(page, tmp_path), "-o", tmp_path / "part.3b", "--offset", 0.15)
    assert says(
        message,
        Phrase("no-room", r=0.15),
        Phrase("contour-name", turn=1),
        Phrase("kind-opening", count=1),
        Phrase("room-neck", place=(10, 4)),
    )
    assert not (tmp_path / "part.3b").exists()


def test_what_is_too_small_may_be_left(run: Run, tmp_path: Path) -> None:
    """Asked for it, contours without room are left out and accounted for; what lies around them is cut as ever."""
    page = drawing()
    space = page.modelspace()
    space.add_lwpolyline([(0, 0), (30, 0), (30, 20), (0, 20)], close=True)
    space.add_circle((5, 5), 0.08)
    space.add_circle((10, 5), 2, dxfattribs={"layer": "HOLES"})
    space.add_lwpolyline([(20, 5), (25, 5), (22, 5)], close=True, dxfattribs={"layer": "HOLES"})
    # Around a hole, and crossing itself: the hole stays an opening.
    space.add_lwpolyline([(40, 0), (60, 0), (60, 20), (50, 20), (56, 24), (50, 24), (56, 20), (40, 20)], close=True)
    space.add_circle((50, 10), 3)
    path = saved(page, tmp_path)
    words = run_failing(run, "cut", path, "-o", tmp_path / "part.3b", "--offset", 0.1)
    assert says(
        words,
        Phrase("no-room-crossing"),
        Phrase("crosses-itself"),
        Phrase("more-without-room", count=2),
        re.compile(r"\(2[\d.]*, "),
        "--small leave",
    )
    assert not (tmp_path / "part.3b").exists()
    cuts, words = cut(run, page, tmp_path, "--offset", 0.1, "--small", "leave")
    wanted = [(10, 5, 1.9), (50, 10, 2.9)]
    for places in cuts:
        ring = LineString(places[1:-1])
        if ring.length > 30:
            assert apart(ring, parallel(Polygon([(0, 0), (30, 0), (30, 20), (0, 20)]), 0.1, "outside", "mitre")) < LIMIT
        else:
            x, y, radius = wanted.pop(0)
            assert apart(ring, Point(x, y).buffer(radius, quad_segs=400).exterior) < LIMIT
    assert not wanted and len(cuts) == 3
    assert says(
        words,
        Phrase("layer-sum", layer="0"),
        Phrase("count-entities", count=4),
        Phrase("layer-cut", count=2),
        Phrase("layer-left", count=2),
        Phrase("count-kind", count=1, kind="CIRCLE"),
        Phrase("count-kind", count=1, kind="LWPOLYLINE"),
        Phrase("reason-no-room"),
    )
    assert says(
        words,
        Phrase("contour-not-cut"),
        Phrase("contour-name", start=(5.08, 5)),
        Phrase("on-layers", layers=("0",)),
        Phrase("room-none", place=(5, 5)),
    )
    assert says(words, Phrase("contours-read", count=3), Phrase("count-closed", count=3))


def test_what_lies_in_an_opening_that_is_left_out(run: Run, tmp_path: Path) -> None:
    """Islands, each with a hole, in the two rooms of a window: they would be cut out of the part. What lies in the
    window beside it is cut, as is the hole of a part that is left out itself."""
    page = drawing()
    polygon([(0, 0), (60, 0), (60, 30), (0, 30)], page)
    lower, upper = [(2, 2), (14, 2), (14, 9.9), (14.1, 9.9), (14.1, 2), (28, 2)], [(28, 20), (14.1, 20), (14.1, 10)]
    polygon([*lower, *upper, (14, 10), (14, 20), (2, 20)], page)
    polygon([(32, 2), (58, 2), (58, 20), (32, 20)], page)
    for x in (8, 21, 45):
        polygon([(x - 3, 6), (x + 3, 6), (x + 3, 16), (x - 3, 16)], page)
        page.modelspace().add_circle((x, 12), 1)
    page.modelspace().add_line((19, 8), (23, 8))
    polygon([(70, 0), (90, 0), (90, 20), (80, 20), (86, 24), (80, 24), (86, 20), (70, 20)], page)
    page.modelspace().add_circle((80, 10), 3)
    cuts, words = cut(run, page, tmp_path, "--offset", 0.1, "--small", "leave", "--open", "cut")
    reaches = sorted(tuple(round(reach, 1) for reach in LineString(places[1:-1]).bounds) for places in cuts)
    wanted = [(-0.1, -0.1, 60.1, 30.1), (32.1, 2.1, 57.9, 19.9), (41.9, 5.9, 48.1, 16.1), (44.1, 11.1, 45.9, 12.9)]
    assert reaches == [*wanted, (77.1, 7.1, 82.9, 12.9)]
    assert says(
        words,
        Phrase("layer-sum"),
        Phrase("count-kind", count=2, kind="LWPOLYLINE"),
        Phrase("count-kind", count=2, kind="CIRCLE"),
        Phrase("count-kind", count=1, kind="LINE"),
        Phrase("reason-within"),
    )
    assert says(
        words,
        Phrase("contour-not-cut"),
        Phrase("contour-name", turn=8, start=(28, 20)),
        Phrase("on-layers", layers=("0",)),
        Phrase("contour-name", start=(5, 6)),
    )
    assert says(words, Phrase("more-not-cut", count=2))


def test_a_cusp(run: Run, tmp_path: Path) -> None:
    """Both ends of a slot are half circles that bulge into it: the wire goes past the corners, and that is said."""
    page = drawing()
    polygon([(-5, -5), (30, -5), (30, 10), (-5, 10)], page)
    page.modelspace().add_lwpolyline([(0, 0), (20, 0, -1), (20, 4), (0, 4, -1)], format="xyb", close=True)
    cuts, words = cut(run, page, tmp_path, "--offset", 0.1, "--passes", "0.06,0")
    assert says(words, CARE, Phrase("narrow-corners"))
    for places, r in zip(cuts, (0.16, 0.1), strict=False):
        room = Polygon([(0, r), (20, r), (20, 4 - r), (0, 4 - r)])
        for x in (0, 20):
            room = room.difference(Point(x, 2).buffer(2 + r, quad_segs=4000))
        assert apart(LineString(places[1:-1]), room.exterior) < LIMIT


def test_an_outline_that_is_too_short_for_the_tab(run: Run, tmp_path: Path) -> None:
    """Refused by name with the longest tab that fits, which does fit; asked for it, left out, and the others cut."""
    page = drawing()
    for x, side in ((0, 10), (20, 1), (30, 0.8)):
        polygon([(x, 0), (x + side, 0), (x + side, side), (x, side)], page)
    path, tape = saved(page, tmp_path), tmp_path / "part.3b"
    options = ["--offset", 0.1, "--passes", "0.06,0"]
    words = run_failing(run, "cut", path, "-o", tape, *options, "--tab", 1.5)
    assert says(
        words,
        Phrase("tab-too-long"),
        Phrase("contour-name", start=(30, 0)),
        Phrase("on-layers", layers=("0",)),
        Phrase("kind-outline", count=1),
        Phrase("too-short-for-tab", fit=1.066),
        Phrase("more-without-tab", count=1),
        "--tab",
    )
    run("cut", path, "-o", tape, *options, "--tab", 1.066)
    run_failing(run, "cut", path, "-o", tape, *options, "--tab", 1.067)
    cuts, words = cut(run, page, tmp_path, *options, "--tab", 1.5, "--small", "leave")
    assert len(cuts) == 2 and says(
        words,
        Phrase("contour-not-cut"),
        Phrase("contour-name", start=(20, 0)),
        Phrase("on-layers", layers=("0",)),
        Phrase("too-short-for-tab"),
    )
    assert says(
        words,
        Phrase("layer-sum"),
        Phrase("count-entities", count=3),
        Phrase("layer-cut", count=1),
        Phrase("layer-left", count=2),
        Phrase("count-kind", count=2),
    )


def test_the_largest_offset_with_passes(run: Run, tmp_path: Path) -> None:
    """The largest offset is reported for the last pass too; with it the part is cut, with 4 µm more it is not."""
    page = drawing()
    polygon([(0, 0), (30, 0), (30, 20), (0, 20)], page)
    page.modelspace().add_circle((10, 10), 0.2)
    path, tape = saved(page, tmp_path), tmp_path / "part.3b"
    words = run_failing(run, "cut", path, "-o", tape, "--offset", 0.18, "--passes", "0.06,0")
    last = next(at for at in (k / 1000 for k in range(100, 220)) if says(words, Phrase("fits-in-passes", last=at)))
    run("cut", path, "-o", tape, "--offset", last, "--passes", "0.06,0")
    run_failing(run, "cut", path, "-o", tape, "--offset", last + 0.004, "--passes", "0.06,0")
    words = run_failing(run, "cut", path, "-o", tape, "--offset", 0.01, "--passes", "0.3,0")
    assert says(words, Phrase("no-room"), Phrase("fits-no-pass")) and not says(words, Phrase("fits-in-passes"))


def test_a_slot_as_wide_as_the_wire(run: Run, tmp_path: Path) -> None:
    """There and back on one line; a micrometre less is a micrometre's step, three are none."""
    for width, is_cut in ((0.2, True), (0.1999, True), (0.19, False)):
        page = drawing()
        shape = [(0, 0), (8, 0), (8, 4 - width), (12, 4 - width), (12, 0), (20, 0), (20, 8)]
        shape += [(12, 8), (12, 4), (8, 4), (8, 8), (0, 8)]
        polygon(shape, page)
        page.modelspace().add_lwpolyline([(-9, -9), (29, -9), (29, 17), (-9, 17)], close=True)
        if is_cut:
            cuts, _ = cut(run, page, tmp_path, "--offset", 0.1)
            assert LineString(cuts[0]).distance(Point(10, 4 - width / 2)) < LIMIT
        else:
            words = run_failing(run, "cut", saved(page, tmp_path), "-o", tmp_path / "part.3b", "--offset", 0.1)
            assert says(
                words,
                Phrase("no-room", r=0.1),
                Phrase("room-neck", place=(10, 3.905)),
                Phrase("fits-at-most", fit=0.095),
            )


def test_wire_way_by_itself() -> None:
    """On whole numbers, where edges touch, and beside what is smaller than R all around."""
    square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]

    inner = wire_path(closed(square[::-1]), 1.0)
    assert sorted(edge.start for edge in inner) == pytest.approx([(1, 1), (1, 3), (3, 1), (3, 3)])
    outer = wire_path(closed(square), 1.0)
    assert sum(edge.length for edge in outer) == pytest.approx(16 + 2 * pi)
    notch = [*square[:2], (4.0, 1.0), (2.0, 1.0), (2.0, 3.0), (4.0, 3.0), *square[2:]]
    way = wire_path(closed(notch), 0.5)
    assert sum(edge.length for edge in way) == pytest.approx(12 + 2 + 2 * 1.5 + 1 + 6 * pi / 4, abs=1e-6)
    with pytest.raises(NoRoom):
        wire_path(closed(square[::-1]), 2.5)


def test_ways_without_any_length(run: Run, tmp_path: Path) -> None:
    """Half a disc that R fills: the wire stays where it is; a way that begins at a corner; a room that is a point."""
    page = drawing()
    page.modelspace().add_lwpolyline([(0, 0, 1), (0, 2, 0)], "xyb", close=True)
    path = saved(page, tmp_path)
    words = run_failing(run, "cut", path, "-o", tmp_path / "part.3b", "--offset", 0.5, "--side", "inside")
    assert says(words, Phrase("no-room", r=0.5), Phrase("room-none"), re.compile(r"\b0\.49\d*"))
    halves = tuple(Edge((x, 0.0), (-x, 0.0), (0.0, 0.0), pi) for x in (2.0, -2.0))
    part = part_between(halves, (2.0, 0.0), (0.0, 2.0))
    assert sum(edge.length for edge in part) == pytest.approx(pi)
    page = drawing()
    rooms = [(7, 3), (12, 3), (12, 5), (10, 5), (10, 4), (9.6, 4), (9.6, 5), (7, 5)]
    page.modelspace().add_lwpolyline(rooms, close=True)
    path = saved(page, tmp_path)
    words = run_failing(run, "cut", path, "-o", tmp_path / "part.3b", "--offset", 1, "--side", "inside")
    assert says(
        words,
        Phrase("into-itself", r=1),
        Phrase("room-slot", place=(11, 4)),
        Phrase("contour-name", turn=1),
        Phrase("kind-outline", count=1),
        "--small leave",
    )
    words = run_failing(
        run, "cut", path, "-o", tmp_path / "part.3b", "--offset", 1, "--side", "inside", "--small", "leave"
    )
    assert says(words, Phrase("nothing-left"))


def test_a_way_that_is_entered_at_a_narrow_end(run: Run, tmp_path: Path) -> None:
    """Within a flat ellipse the wire turns in arcs of some micrometres where it is entered: it closes all the same."""
    page = drawing()
    page.modelspace().add_ellipse((6, 5), (4, 0), 0.25)
    places = [(6 + 4 * cos(pi * k / 2000), 5 + sin(pi * k / 2000)) for k in range(4000)]
    (found,), _ = cut(run, page, tmp_path, "--offset", 0.2, "--side", "inside", "--start", "6.8,5")
    assert apart(LineString(found[1:-1]), parallel(Polygon(places), 0.2, "inside")) < LIMIT
    assert found[0] == pytest.approx(found[-1], abs=1e-9)


def wavy(seed: int) -> Contour:
    """A closed curve about 0, 0 with waves of all lengths, some of them narrower than R."""
    rng = random.Random(seed)
    waves = [(k, rng.uniform(0, 0.35) / k**1.05, rng.uniform(0, 2 * pi)) for k in rng.sample(range(3, 40), 9)]
    size = rng.choice([0.5, 0.8, 1.5, 3])

    def radius(t: float) -> float:
        return size * (1 + sum(a * cos(k * t + f) for k, a, f in waves))

    def heading(t: float) -> float:
        far, grows = radius(t), size * sum(-a * k * sin(k * t + f) for k, a, f in waves)
        return atan2(grows * sin(t) + far * cos(t), grows * cos(t) - far * sin(t))

    def at(turns: list[float]) -> list[XY]:
        return [(radius(t) * cos(t), radius(t) * sin(t)) for t in turns]

    return Contour((curve_edge(at, heading, [2 * pi * k / 32 for k in range(33)], 0.0005),), True)


@pytest.mark.parametrize("seed", range(66, 100, 3))
def test_beside_waves(seed: int) -> None:
    """The wire is where shapely's buffer ends, as near as the check asks for; its arcs have both ends on their circles,
    as the ROM asks for."""
    contour = wavy(seed)
    area = Polygon(contour.points())
    for r in (0.11, -0.11):
        way = wire_path(contour, r)
        path = LineString([place for edge in way for place in edge.points()])
        assert (
            max(abs(dist(edge.start, edge.centre) - dist(edge.end, edge.centre)) for edge in way if edge.centre) < 5e-4
        )
        assert hausdorff_distance(path, area.buffer(r, quad_segs=512).exterior) < 0.003


def test_the_wire_passes_short_bows_in_a_row() -> None:
    """Bows of some 15 µm round a corner off: where the wire's corners swap places it does not go around one of them."""
    micrometres = [(0, 0), (10000, 0), (9994, 9976), (9993, 9980), (9980, 9991), (9963, 9998), (9962, 9999), (0, 10000)]
    bows = [0, 0, 30, 0, 60, 30, 0, 0]
    places = [(x / 1000, y / 1000) for x, y in micrometres]
    edges = []
    for (x, y), (u, v), bow in zip(places, [*places[1:], places[0]], bows, strict=True):
        if not bow:
            edges.append(Edge((x, y), (u, v)))
            continue
        up = 1 / (2 * tan(radians(bow) / 2))
        centre = (x + u) / 2 - up * (v - y), (y + v) / 2 + up * (u - x)
        edges.append(Edge((x, y), (u, v), centre, radians(bow)))
    way = wire_path(Contour(tuple(edges), True), 0.1)
    cut = LineString([edge.at(k / 20) for edge in way for k in range(21)])
    wanted = Polygon([edge.at(k / 20) for edge in edges for k in range(20)]).buffer(0.1, quad_segs=200).exterior
    assert cut.hausdorff_distance(wanted) < LIMIT
    assert cut.length == pytest.approx(wanted.length, abs=0.01)


def test_what_the_wire_stays_off_is_said_beside_other_lines(run: Run, tmp_path: Path) -> None:
    """Six windows with no room for a lead along an arc, one with a narrow corner: that is not one of "more such"."""
    page = drawing()
    polygon([(-2, -2), (40, -2), (40, 10), (-2, 10)], page)
    for x in range(0, 12, 2):
        polygon([(x, 0), (x + 0.24, 0), (x + 0.24, 5), (x, 5)], page)
    polygon([(20, 0), (27.95, 0), (27.95, 0.05), (28, 0.05), (28, 5), (20, 5)], page)
    _, words = cut(run, page, tmp_path, "--offset", 0.1, "--lead-shape", "arc", "--lead", 1)
    lines = words.splitlines()
    first = next(at for at, line in enumerate(lines) if says(line, Phrase("straight-lead")))
    leads = [Phrase("straight-lead")] * 5
    assert each_says(
        lines[first : first + 7], *leads, Phrase("more-such-contours", count=2), (CARE, Phrase("narrow-corners"))
    )


@pytest.mark.parametrize(
    ("wide", "deep", "is_refused"),
    [(1.9, 1.9, False), (1.9, 2.1, True), (1.9, 3.0, True), (1.9, 3.9, True), (1.9, 9.0, True), (2.1, 3.0, False)],
)
@pytest.mark.parametrize("r", [0.1, -0.1, 2.0])
def test_a_slot_is_no_corner(wide: float, deep: float, is_refused: bool, r: float) -> None:
    """A slot too narrow for the wire is passed over while its sides are no longer than two R: then it is a notch."""
    half, deep, size = wide * abs(r) / 2, deep * abs(r), 40 * abs(r)
    # The slot goes into the part from above; with R negative the wire runs on the left, so the way is turned round.
    corners = [
        (-size, 0),
        (-size, -size),
        (size, -size),
        (size, 0),
        (half, 0),
        (half, -deep),
        (-half, -deep),
        (-half, 0),
    ]
    corners = corners if r > 0 else corners[::-1]
    contour = closed(corners)
    if is_refused:
        with pytest.raises(NoRoom, match=NOT_THERE):
            wire_path(contour, r)
    else:
        assert wire_path(contour, r)


@pytest.mark.parametrize(("turned", "is_refused"), [(1.0, False), (1.5, True)])
def test_the_round_bottom_of_a_notch_is_a_corner(turned: float, is_refused: bool) -> None:
    """Half a turn that the wire does not come into is no longer than four R; a bulb of three quarters is."""
    radius, size = 0.95, 40.0
    # (the arc about the origin, its ends on a line above or below that)
    high = -radius * cos(turned * pi / 2)
    half = radius * sin(turned * pi / 2)
    top = high + 0.5
    corners = [(-half, top), (-size, top), (-size, -size), (size, -size), (size, top), (half, top), (half, high)]
    edges = [Edge(p, q) for p, q in pairwise(corners)]
    edges += [Edge((half, high), (-half, high), (0.0, 0.0), -turned * pi), Edge((-half, high), corners[0])]
    contour = Contour(tuple(edges), True)
    if is_refused:
        with pytest.raises(NoRoom, match=NOT_THERE):
            wire_path(contour, 1.0)
    else:
        assert wire_path(contour, 1.0)


#: A plate with a window, SVG; what its corners are drawn with, each from the corner back to it: {0} to {3}.
CORNERED = """<svg xmlns="http://www.w3.org/2000/svg" width="30mm" height="20mm" viewBox="0 0 30 20">
<path d="M0 0h30v20h-30z M9 10 H5 {0} V5 {1} H25 {2} V10 {3} Z"/></svg>"""
#: As boxes.py of laser cutters writes corners, outside of the window; and as lines.
ROUND = ("C4.9 10 5 10.1 5 10", "C5 4.9 4.9 5 5 5", "C25.1 5 25 4.9 25 5", "C25 10.1 25.1 10 25 10")
CHAINED = (
    "l-.1 .05 .05 .05 .05 -.1",
    "l-.05 -.1 -.05 .05 .1 .05",
    "l.1 -.05 -.05 -.05 -.05 .1",
    "l.05 .1 .05 -.05 -.1 -.05",
)


@pytest.mark.parametrize("corners", [ROUND, CHAINED], ids=["curves", "lines"])
def test_loops_smaller_than_the_wire(run: Run, tmp_path: Path, corners: tuple[str, ...]) -> None:
    """Are left out of the corners, and that is said; the tape is that of the drawing without them."""
    path, tapes = tmp_path / "window.svg", []
    for drawn in (corners, [""] * 4):
        path.write_text(CORNERED.format(*drawn))
        result = run("cut", path, "-o", tmp_path / "part.3b", "--offset", 0.1, "--quiet")
        assert says(result.stderr, CARE) == (drawn is corners)
        tapes.append((tmp_path / "part.3b").read_bytes())
        if drawn is corners:
            assert says(result.stderr, CARE, Phrase("loops", turn=1, count=4, place=(5, 10)))
            # Without an offset they are cut.
            result = run("cut", path, "-o", tmp_path / "on.3b")
            assert not says(result.stderr, Phrase("loops"))
    assert tapes[0] == tapes[1]
    # A larger one is for the owner to mend.
    path.write_text(CORNERED.format("l-1 0 0 1 1 -1", "", "", ""))
    assert says(
        run_failing(run, "cut", path, "-o", tmp_path / "part.3b", "--offset", 0.1),
        Phrase("no-room-crossing"),
        Phrase("contour-name", turn=1),
        Phrase("kind-opening", count=1),
        "(5",
        "--small",
    )


@pytest.mark.parametrize(
    ("drawn", "clean", "tips"),
    [
        ("M0 0h31h-1v20h-30z", "M0 0h30v20h-30z", 1),
        ("M-2 0h32v21v-1h-30v-20z", "M0 0h30v20h-30z", 2),
        ("M0 0h10v-3h-1h1v3h20v20h-30z", "M0 0h10v-3h0v3h20v20h-30z", 2),
        ("M0 0h30v20h-30z M5 5h20v10h-19h2h-3z", "M0 0h30v20h-30z M5 5h20v10h-20z", 1),
    ],
)
def test_lines_that_run_along_and_back(run: Run, tmp_path: Path, drawn: str, clean: str, tips: int) -> None:
    """Are not cut where they lie on the wire's side, and that is said; the tape is that of the drawing without them."""
    path, tapes = tmp_path / "part.svg", []
    for way in (drawn, clean.replace("v-3h0v3", "")):
        path.write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" width="50mm" viewBox="-9 -9 50 40"><path d="{way}"/></svg>'
        )
        result = run("cut", path, "-o", tmp_path / "part.3b", "--offset", 0.1, "--quiet", "--start", "-5,-5")
        assert says(result.stderr, Phrase("whiskers", count=tips)) == (way is drawn) == says(result.stderr, CARE)
        tapes.append((tmp_path / "part.3b").read_bytes())
    assert tapes[0] == tapes[1]


@pytest.mark.parametrize("drawn", ["M0 0H30.1C30.2 0 30-.1 30-.1V20H0z", "M30.1 0C30.2 0 30-.1 30-.1V20H0V0z"])
def test_corners_that_are_overshot(run: Run, tmp_path: Path, drawn: str) -> None:
    """Lines that cross near their ends: what lies behind the crossing is a loop, in the middle or where it begins."""
    path, tapes = tmp_path / "part.svg", []
    for way in (drawn, "M0 0H30V20H0z"):
        path.write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" width="50mm" viewBox="-9 -9 50 40"><path d="{way}"/></svg>'
        )
        result = run("cut", path, "-o", tmp_path / "part.3b", "--offset", 0.1, "--quiet", "--start", "-5,-5")
        assert says(result.stderr, CARE, Phrase("loops", count=1, turn=1, place=(39, 31))) == (way is drawn)
        tapes.append((tmp_path / "part.3b").read_bytes())
    assert tapes[0] == tapes[1]
    # Beside a thinner wire it is no loop.
    path.write_text(path.read_text().replace("M0 0H30V20H0z", drawn))
    assert "part.svg" in run_failing(run, "cut", path, "-o", tmp_path / "part.3b", "--offset", 0.04)


def test_a_slit_is_not_lost(run: Run, tmp_path: Path) -> None:
    """A line that runs into the part and back is one; beside it the wire has no room."""
    path = tmp_path / "part.svg"
    path.write_text(CORNERED.format("", "", "", "").replace("h30v20h-30z", "h15v4v-4h15v20h-30z"))
    assert says(
        run_failing(run, "cut", path, "-o", tmp_path / "part.3b", "--offset", 0.1),
        Phrase("no-room-crossing"),
        Phrase("kind-outline"),
        "(15, ",
        "--small",
    )
    assert not (tmp_path / "part.3b").exists()
