"""Nesting in drawings that are cut in part: openings of a part that is left, parts in a frame."""

from __future__ import annotations

import re
from itertools import product
from pathlib import Path

import pytest
import shapely
from cuthelp import closed, drawing, polygon, saved, stretches
from ezdxf.document import Drawing
from facthelp import CARE, pattern, says
from shapely.geometry import Point
from test_cut import start_of
from toolhelp import Run

from skg.messages.finding import Phrase
from skg.planning.islands import islands
from skg.planning.planned import PlannedContour

OFFSET = 0.1
PLATE = [(0.0, 0.0), (60.0, 0.0), (60.0, 40.0), (0.0, 40.0)]
FRAME = [(-30.0, -30.0), (100.0, -30.0), (100.0, 100.0), (-30.0, 100.0)]
HOLES = tuple(product((10.0, 50.0), (10.0, 30.0)))


def plate(frame: bool = False, **more: object) -> Drawing:
    """A plate on OUT, holes on HOLES, maybe a frame around them; `more`: attributes of what is not on HOLES."""
    page = drawing()
    polygon(PLATE, page, layer="OUT", **more)
    if frame:
        polygon(FRAME, page, layer="FRAME", **more)
    for centre in HOLES:
        page.modelspace().add_circle(centre, 4, {"layer": "HOLES"})
    return page


def ways(run: Run, path: Path, *words: object) -> tuple[list[shapely.LinearRing], str]:
    """The wire's way around each contour, without its leads, and the report."""
    tape, program = path.with_suffix(".3b"), path.with_suffix(".skg")
    done = run("cut", path, "-o", tape, "--program", program, "--offset", OFFSET, *words)
    assert done.exit_code == 0, done.stderr
    found = [shapely.LinearRing(places[1:-1]) for places in stretches(tape.read_bytes(), start_of(program))]
    assert found
    return found, done.stderr


def test_the_holes_alone(run: Run, tmp_path: Path) -> None:
    """Holes whose plate is on another layer are openings: the wire runs inside of them, and that is said."""
    path = saved(plate(), tmp_path)
    for words in (["--layer", "HOLES"], ["--layer", "HOLES", "--quiet"]):
        found, told = ways(run, path, *words)
        assert len(found) == len(HOLES)
        for ring in found:
            radii = [min(Point(at).distance(Point(hole)) for hole in HOLES) for at in ring.coords]
            assert max(radii) < 4 - OFFSET + 0.003, radii
        assert says(told, CARE, Phrase("openings-in-part", count=4, layers=("OUT",)), "--side outside")
    found, told = ways(run, path, "--layer", "HOLES", "--side", "outside")
    assert all(shapely.Polygon(ring).area > 16 * 3.1416 for ring in found)
    assert not says(told, CARE, "layer OUT")


@pytest.mark.parametrize("state", ["off", "freeze"])
def test_the_holes_of_a_plate_that_is_not_seen(run: Run, tmp_path: Path, state: str) -> None:
    page = plate()
    getattr(page.layers.add("OUT"), state)()
    found, told = ways(run, saved(page, tmp_path))
    assert len(found) == len(HOLES) and says(told, CARE, Phrase("openings-in-part", count=4))
    assert all(shapely.Polygon(ring).area < 16 * 3.1416 for ring in found)


@pytest.mark.parametrize(
    ("layers", "openings", "outlines"),
    [(("OUT", "HOLES"), 4, 1), (("OUT",), 0, 1), (("HOLES",), 4, 0), (("OUT", "HOLES", "FRAME"), 1, 5)],
)
def test_a_frame(run: Run, tmp_path: Path, layers: tuple[str, ...], openings: int, outlines: int) -> None:
    """A contour with openings is a part, also in a frame that is left; cut with its frame it is an opening of it."""
    path = saved(plate(frame=True), tmp_path)
    words = [word for layer in layers for word in ("--layer", layer)]
    found, told = ways(run, path, *words)
    assert len(found) == openings + outlines
    kinds = [Phrase("count-opening", count=openings)] * (openings > 0) + [Phrase("count-outline", count=outlines)]
    kinds = kinds[: (openings > 0) + (outlines > 0)]
    orders = (tuple(kinds), tuple(reversed(kinds)))
    assert any(says(told, Phrase("order-of-cutting", kinds=order)) for order in orders)
    assert says(told, CARE, Phrase("outlines-in-frame", layers=("FRAME",)), "--side inside") == (
        "OUT" in layers and "FRAME" not in layers
    )
    assert says(told, CARE, Phrase("openings-in-part", layers=("OUT",)), "--side outside") == ("OUT" not in layers)


@pytest.mark.parametrize("around", ["thread", "copy", "dashed", "beside", "text"])
def test_what_makes_no_opening(run: Run, tmp_path: Path, around: str) -> None:
    """A circle about a hole of a part that is cut, the same contour on another layer, a circle that holes lie on, what
    lies beside, and text: the contours are cut as without them."""
    page = drawing()
    polygon(PLATE, page, layer="CUT")
    for centre in HOLES:
        page.modelspace().add_circle(centre, 4, {"layer": "CUT"})
        if around == "thread":
            page.modelspace().add_circle(centre, 5, {"layer": "MARKS"})
    if around == "copy":
        polygon(PLATE, page, layer="MARKS")
    if around == "dashed":
        page.linetypes.add("CENTER", [2.0, 1.25, -0.25, 0.25, -0.25])
        page.modelspace().add_circle((30, 20), 90, {"layer": "MARKS", "linetype": "CENTER"})
    if around == "beside":
        polygon([(-20, -20), (-1, -20), (-1, 90), (-20, 90)], page, layer="MARKS")
    page.modelspace().add_text("60 x 40", dxfattribs={"layer": "MARKS"})
    found, told = ways(run, saved(page, tmp_path), "--layer", "CUT")
    assert says(
        told, Phrase("order-of-cutting"), Phrase("count-opening", count=4), Phrase("count-outline", count=1)
    ) and not says(told, CARE)
    assert len(found) == 5


GAPS = {
    "one line": [[(1, 0), *PLATE[1:], (0, 0)]],
    "four lines": [[(1, 0), (59, 0)], [(60, 1), (60, 39)], [(59, 40), (1, 40)], [(0, 39), (0, 1)]],
    "past corners": [[(-1, 0), (61, 0)], [(60, -1), (60, 41)], [(61, 40), (-1, 40)], [(0, 41), (0, -1)]],
    "with a stub": [[(1, 0), *PLATE[1:3]], [(60, 40), (70, 50)], [(60, 40), (0, 40), (0, 0)]],
}


@pytest.mark.parametrize("gaps", GAPS)
def test_the_holes_of_a_plate_that_is_open(run: Run, tmp_path: Path, gaps: str) -> None:
    """Holes within lines whose ends nearly meet are cut as outlines, and where the gap is, is said, whether the lines
    are on another layer, left or cut."""
    page = drawing()
    for line in GAPS[gaps]:
        page.modelspace().add_lwpolyline(line, dxfattribs={"layer": "OUT"})
    for centre in HOLES:
        page.modelspace().add_circle(centre, 4, {"layer": "HOLES"})
    path = saved(page, tmp_path)
    width = re.compile(r"\b1(\.414\d)?\b")
    for words in (["--layer", "HOLES"], ["--open", "leave"], ["--open", "cut"]):
        done = run("cut", path, "-o", tmp_path / "a.3b", "--offset", OFFSET, "--quiet", *words)
        assert done.exit_code == 0 and says(
            done.stderr, CARE, Phrase("outlines-in-open-line", count=4, layers=("OUT",)), width, "--side inside"
        ), words
    done = run("cut", path, "-o", tmp_path / "a.3b", "--offset", OFFSET, "--layer", "HOLES", "--side", "inside")
    assert done.exit_code == 0 and not says(done.stderr, CARE, "layer OUT")


@pytest.mark.parametrize("beside", ["U", "thread", "parts"])
def test_open_lines_that_are_no_outline(run: Run, tmp_path: Path, beside: str) -> None:
    """A wide gap, three quarters of a circle, and a frame with a gap around parts with openings: nothing is said."""
    page = drawing()
    for x, y in HOLES:
        page.modelspace().add_circle((x, y), 4, {"layer": "CUT"})
        if beside == "thread":
            page.modelspace().add_arc((x, y), 5, 10, 280, {"layer": "MARKS"})
        if beside == "parts":
            page.modelspace().add_circle((x, y), 2, {"layer": "CUT"})
    if beside != "thread":
        gap = {"U": (0, 0), "parts": (0, 39)}[beside]
        page.modelspace().add_lwpolyline([*PLATE, gap][beside == "U" :], dxfattribs={"layer": "MARKS"})
    found, told = ways(run, saved(page, tmp_path), "--layer", "CUT")
    assert len(found) in (4, 8) and not says(told, CARE)


def test_an_open_line_in_an_opening_goes_before_it(run: Run, tmp_path: Path) -> None:
    """A line within a contour that is an opening of what is left is cut before that falls out."""
    page = drawing()
    polygon(FRAME, page, layer="OUT")
    polygon(PLATE, page, layer="WINDOW")
    page.modelspace().add_line((20, 20), (40, 20), {"layer": "WINDOW"})
    path = saved(page, tmp_path)
    done = run("cut", path, "-o", tmp_path / "a.3b", "--layer", "WINDOW", "--offset", OFFSET, "--open", "cut")
    assert done.exit_code == 0 and re.search(
        pattern(
            Phrase("order-of-cutting"),
            Phrase("count-open-contour", count=1),
            Phrase("count-opening", count=1),
            Phrase("count-holes"),
        ),
        done.stderr,
    )


def test_a_part_far_from_the_origin(run: Run, tmp_path: Path) -> None:
    """Contours left uncut are moved with those that are cut."""
    page = drawing()
    by = 3.5e6, 5.4e6
    polygon([(x + by[0], y + by[1]) for x, y in PLATE], page, layer="OUT")
    for x, y in HOLES:
        page.modelspace().add_circle((x + by[0], y + by[1]), 4, {"layer": "HOLES"})
    _, told = ways(run, saved(page, tmp_path), "--layer", "HOLES")
    assert says(told, re.compile(r"\(-?3[\d.]{6,}, -?5[\d.]{6,}\)")) and says(
        told, CARE, Phrase("openings-in-part", count=4)
    )


def test_layers_of_svg(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "plate.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
        'width="60mm" height="40mm" viewBox="0 0 60 40"><g inkscape:groupmode="layer" inkscape:label="OUT">'
        '<rect width="60" height="40"/></g><g inkscape:groupmode="layer" inkscape:label="HOLES">'
        '<circle cx="10" cy="10" r="4"/></g></svg>'
    )
    (ring,), told = ways(run, path, "--layer", "HOLES")
    assert shapely.Polygon(ring).area < 16 * 3.1416 and says(
        told, CARE, Phrase("openings-in-part", count=1), Phrase("contours-in-brackets", numbers=(1,))
    )


def test_what_goes_with_an_opening_that_is_left_out() -> None:
    """Contours inside an opening are left out with it: not one that crosses it, nor the part around it."""

    def rectangle(left: float, low: float, right: float, high: float, depth: int) -> PlannedContour:
        corners = [(left, low), (right, low), (right, high), (left, high)]
        return PlannedContour(closed(corners), corners[0], 0.5, (0.1,), depth)

    elsewhere, part = rectangle(100, 0, 110, 10, 1), rectangle(-50, -50, 60, 60, 2)
    opening, inner, crossing = rectangle(0, 0, 10, 10, 3), rectangle(1, 1, 2, 2, 4), rectangle(2, 4, 12, 8, 3)
    contours = dict(enumerate([part, elsewhere, opening, inner, crossing]))
    assert islands(contours, [1, 2]) == {3: 2}
    assert islands(contours, [1, 4]) == {} == islands(contours, [])
