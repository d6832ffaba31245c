"""Copies of a part, in rows or around a place: the tape is that of a drawing in which ezdxf has drawn them."""

from __future__ import annotations

import json
from dataclasses import replace
from math import radians
from pathlib import Path

import pytest
import shapely
from cuthelp import drawing, polygon, saved, stretches
from ezdxf import transform
from ezdxf.document import Drawing
from ezdxf.math import Matrix44
from test_place import part
from toolhelp import Run

from skg.errors import UserError
from skg.geometry.placement import Placement
from skg.job.file import decoded
from skg.planning.copies import Pattern


def drawn(moves: list[Matrix44]) -> Drawing:
    """A drawing with the part at some places."""
    page = drawing()
    for move in moves:
        one = part()
        transform.inplace(one.modelspace(), move)
        for entity in one.modelspace():
            page.modelspace().add_foreign_entity(entity)
    return page


def around(place: tuple[float, float], degrees: float) -> Matrix44:
    x, y = place
    return Matrix44.translate(-x, -y, 0) @ Matrix44.z_rotate(radians(degrees)) @ Matrix44.translate(x, y, 0)


def cut(run: Run, path: Path, *words: str) -> tuple[list[shapely.LineString], dict]:
    """The wire's ways, and the report."""
    tape = path.with_suffix(".nodrift.3b")
    done = run("cut", path, "-o", tape, "--json", "--offset", "0.1", *words)
    assert done.exit_code == 0, done.stderr
    report = json.loads(done.stderr)
    runs = stretches(tape.read_bytes(), tuple(report["starts"][0]))
    return [shapely.LineString(places) for places in runs if len(set(places)) > 1], report


def refused(run: Run, path: Path, *words: str) -> dict:
    """The refusal; no tape is there."""
    tape = path.with_suffix(".3b")
    done = run("cut", path, "-o", tape, "--json", "--offset", "0.1", *words)
    assert done.exit_code == 2 and not tape.exists(), words
    return json.loads(done.stderr)["error"]


ROWS = ["--columns", "3", "--rows", "2", "--step", "-45,30.5"]
RING = ["--around", "4", "--about", "23,-40", "--every", "72.5"]


@pytest.mark.parametrize(
    "words, moves",
    [
        (ROWS, [Matrix44.translate(-45 * column, 30.5 * row, 0) for row in range(2) for column in range(3)]),
        (RING, [around((23, -40), 72.5 * number) for number in range(4)]),
    ],
)
@pytest.mark.parametrize("form", [["--ram", "8"], ["--ram", "2"]], ids=["stored", "written out"])
def test_as_a_drawing_with_the_copies(
    run: Run, tmp_path: Path, words: list[str], moves: list[Matrix44], form: list[str]
) -> None:
    """Each copy's ways are those of the one that is drawn, copy by copy; the program has the part once, where it is
    stored, and makes the tape by itself."""
    path, program = saved(part(), tmp_path), tmp_path / "part.skg"
    ours, report = cut(run, path, *words, *form, "--program", str(program))
    codes = [finding["code"] for finding in report["findings"]]
    assert codes.count("copies-in-rows") + codes.count("copies-around") == 1
    assert ("made-stored" in codes) == ("8" in form)
    if "8" in form:
        assert program.read_text().count("BACK") == 3 and "GOSUB" in program.read_text()
        again = tmp_path / "again.3b"
        run("run", program, "-o", again, "--rom", "no-drift")
        assert again.read_bytes() == path.with_suffix(".nodrift.3b").read_bytes()
    theirs, other = cut(run, saved(drawn(moves), tmp_path), "--units", "mm")
    assert len(ours) == len(theirs) == 3 * len(moves) and report["length"] == pytest.approx(other["length"], abs=0.2)
    drawn_rings = [shapely.LinearRing(way.coords[1:-1]) for way in theirs]
    rings = [shapely.LinearRing(way.coords[1:-1]) for way in ours]
    # (a circle that was turned is entered elsewhere)
    assert all(min(ring.hausdorff_distance(other) for other in drawn_rings) < 0.003 for ring in rings)
    # each copy whole, its outline last
    for number in range(0, len(rings), 3):
        *inner, outline = rings[number : number + 3]
        assert all(ring.within(shapely.Polygon(outline)) for ring in inner)
    holes = [tuple(hole) for hole in report["starts"]]
    assert len(holes) == 3 * len(moves) and len(set(holes)) == len(holes)


def test_the_check_counts_the_copies_by_itself(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One that is 20 um elsewhere is no tape."""
    path, right = saved(part(), tmp_path), Pattern.placements.func
    off = lambda pattern: [*right(pattern)[:-1], _aside(right(pattern)[-1])]  # noqa: E731
    monkeypatch.setattr(Pattern, "placements", property(off))
    for words in (ROWS, [*RING, "--turn", "30", "--mirror", "y", "--scale", "0.9"]):
        assert refused(run, path, *words)["code"] == "off-the-file"


def _aside(placement: Placement) -> Placement:
    return replace(placement, at=(placement.at[0] + 0.02, placement.at[1]))


def test_copies_that_come_near(run: Run, tmp_path: Path) -> None:
    """Squares of 10 mm: with 0.2 mm between them the wire just fits, with less it is refused; what touches is, ever."""
    page = drawing()
    polygon([(0, 0), (10, 0), (10, 10), (0, 10)], page)
    path = saved(page, tmp_path)
    ways, _ = cut(run, path, "--columns", "2", "--step", "10.2,0")
    assert len(ways) == 2
    for step, more, code in (
        ("10.199,0", [], "copies-near"),
        ("10,0", [], "copies-touch"),
        ("10,0", ["--into", "cut"], "copies-touch"),
        ("4,0", ["--into", "cut"], "copies-touch"),
        ("0.1,0", [], "copies-touch"),
    ):
        error = refused(run, path, "--columns", "2", "--step", step, *more)
        assert error["code"] == code and error["place"]
    ways, report = cut(run, path, "--columns", "2", "--step", "10.15,0", "--into", "cut")
    assert len(ways) == 2 and "gouge" in [finding["code"] for finding in report["findings"]]
    assert refused(run, path, "--columns", "2", "--rows", "2", "--step", "10.1,10.1")["code"] == "copies-near"


def test_what_is_refused(run: Run, tmp_path: Path) -> None:
    path = saved(part(), tmp_path)
    for words, code in (
        (["--columns", "100", "--rows", "50", "--step", "50,40"], "copies-too-many"),
        (["--columns", "2"], "copies-no-step"),
        (["--rows", "2", "--step", "50,0"], "copies-no-step"),
        (["--around", "3"], "copies-no-centre"),
        (["--around", "3", "--about", "0,99", "--columns", "2", "--step", "50,0"], "copies-both"),
        (["--columns", "1500", "--step", "50,0"], "copies-too-far"),
        (["--around", "3", "--about", "23,-40", "--every", "120.5"], None),
        (["--around", "4", "--about", "23,-40", "--every", "120"], "copies-touch"),
    ):
        if code is None:
            cut(run, path, *words)
            continue
        assert refused(run, path, *words)["code"] == code, words
    job = b'schema = 1\ndrawing = "part.dxf"\n[copies]\nrows = 3\n'
    with pytest.raises(UserError) as failed:
        decoded(job, "a.job.toml")
    assert failed.value.finding.code == "copies-no-step" and "[copies]" in failed.value.finding.source


def test_what_is_left_of_the_part_is_left_of_all(run: Run, tmp_path: Path) -> None:
    """A hole that is too small for the wire is left in each copy; a tab is on each, on the turned ones too."""
    page = part()
    page.modelspace().add_circle((38, 18), 0.05)
    path = saved(page, tmp_path)
    words = ["--small", "leave", "--tab", "1.5", "--passes", "0.05,0"]
    _, report = cut(run, path, *RING, *words)
    assert len(report["starts"]) == 12
    assert [finding["code"] for finding in report["findings"]].count("contour-not-cut") == 1
