"""Where the part lies on the machine: origin, turn, mirror, scale; ezdxf moves the drawing, shapely judges the tape."""

from __future__ import annotations

import json
from dataclasses import replace
from math import radians
from pathlib import Path

import pytest
import shapely
from cuthelp import choose, drawing, polygon, saved, stretches
from ezdxf import transform
from ezdxf.document import Drawing
from ezdxf.math import Matrix44
from facthelp import says
from toolhelp import Run

from skg.errors import UserError
from skg.geometry.placement import Placement
from skg.job.file import decoded, encoded
from skg.job.job import Job
from skg.job.machine import Setup
from skg.job.placing import Place
from skg.messages.finding import Phrase
from skg.pipeline.steps import cut_drawing, open_drawing, plan_drawing, written


def part() -> Drawing:
    """An outline of lines and an arc, of which no two are alike; in it a circle and an ellipse."""
    page = drawing()
    page.modelspace().add_lwpolyline(
        [(3, 2, 0), (43, 2, 0), (43, 21, 0.3), (31, 27, 0), (3, 20, 0)], format="xyb", close=True
    )
    page.modelspace().add_circle((14, 10), 4)
    page.modelspace().add_ellipse((31, 12), (6, 1), 0.5)
    return page


def moved(page: Drawing, place: Place) -> Drawing:
    """The drawing as ezdxf mirrors, turns and scales it about the origin of the place."""
    x, y = place.origin
    matrix = Matrix44.translate(-x, -y, 0)
    matrix @= Matrix44.scale(-1 if place.mirror == "x" else 1, -1 if place.mirror == "y" else 1, 1)
    matrix @= Matrix44.z_rotate(radians(place.turn)) @ Matrix44.scale(place.scale)
    assert not len(transform.inplace(page.modelspace(), matrix))
    return page


def options(place: Place) -> list[str]:
    """The place as options of `skg cut`."""
    origin = place.origin if isinstance(place.origin, str) else ",".join(map(str, place.origin))
    mirror = ["--mirror", place.mirror] if place.mirror else []
    return ["--origin", origin, "--turn", str(place.turn), "--scale", str(place.scale), *mirror]


def cut(run: Run, path: Path, *words: str) -> tuple[shapely.MultiLineString, dict]:
    """The wire's way, and the report."""
    tape = path.with_suffix(".nodrift.3b")
    done = run("cut", path, "-o", tape, "--json", *words)
    assert done.exit_code == 0, done.stderr
    report = json.loads(done.stderr)
    runs = stretches(tape.read_bytes(), tuple(report["starts"][0]))
    return shapely.MultiLineString([places for places in runs if len(set(places)) > 1]), report


@pytest.mark.parametrize(
    "place",
    [
        Place((3, 2), 90.0, "x"),
        Place((40, -5), 180.0),
        Place((0, 0), -90.0, "y"),
        Place((7, 11), 33.0, "x", 0.5),
        Place((-20, 4), 127.5, None, 3.0),
    ],
)
def test_as_a_drawing_that_was_moved(run: Run, tmp_path: Path, place: Place) -> None:
    """The tape is that of the drawing which another program has mirrored, turned and scaled: by a quarter byte by
    byte."""
    path = saved(part(), tmp_path)
    ours, report = cut(run, path, "--offset", "0.1", *options(place))
    tape = path.with_suffix(".nodrift.3b").read_bytes()
    path = saved(moved(part(), place), tmp_path)
    theirs, other = cut(run, path, "--offset", "0.1")
    if place.scale == 1 and place.turn % 90 == 0:
        assert tape == path.with_suffix(".nodrift.3b").read_bytes()
    assert ours.hausdorff_distance(theirs) < 0.0015
    # (as many contours in the same order, the same holes)
    assert report["starts"] == [pytest.approx(hole, abs=1e-4) for hole in other["starts"]]
    codes = [finding["code"] for finding in report["findings"]]
    assert codes.count("placed") == 1 and ("scaled" in codes) == (place.scale != 1)


@pytest.mark.parametrize("word, corner", [("lower-left", (0, 0)), ("upper-right", (2, 3)), ("lower-right", (2, 0))])
def test_words_for_the_zero(run: Run, tmp_path: Path, word: str, corner: tuple[int, int]) -> None:
    """A corner of the box around the part as it lies then is 0, 0: the wire on the line comes to it, not past it."""
    path = saved(part(), tmp_path)
    wire, _ = cut(run, path, "--side", "on", "--lead", "0.001", "--origin", word, "--turn", "20", "--mirror", "y")
    bounds = wire.bounds
    assert bounds[corner[0]] == pytest.approx(0, abs=0.002) and bounds[corner[1] or 1] == pytest.approx(0, abs=0.002)
    wire, _ = cut(run, path, "--side", "on", "--lead", "0.001", "--origin", "centre")
    assert (wire.bounds[0] + wire.bounds[2], wire.bounds[1] + wire.bounds[3]) == pytest.approx((0, 0), abs=0.004)


def test_the_check_places_the_drawing_by_itself(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is placed wrongly by 20 um is no tape: the check lays it beside the file."""
    path = saved(part(), tmp_path)
    right = Placement.of
    wrongs = [
        lambda turn, mirror, scale: right(turn + 0.03, mirror, scale),
        lambda turn, mirror, scale: right(turn, mirror, scale * 1.0006),
        lambda turn, mirror, scale: right(turn, "y", scale),
    ]
    for wrong in wrongs:
        monkeypatch.setattr(Placement, "of", wrong)
        with pytest.raises(UserError) as failed:
            run("cut", path, "-o", tmp_path / "a.3b", "--offset", "0.1", "--turn", "30", "--mirror", "x")
        assert failed.value.finding.code == "off-the-file"
    assert not (tmp_path / "a.3b").exists()


def test_places_of_a_job_are_the_drawings(tmp_path: Path) -> None:
    """A start hole, an entry and tabs stand where the drawing has them, and go with it; so do the places of a refusal.
    The job comes back from its file."""
    data = saved(part(), tmp_path).read_bytes()
    place = Place((3.0, 2.0), 90.0, "x", 2.0)
    job = Job("part.dxf", setup=Setup(offset=0.1), place=place)
    opened = open_drawing(job, data)
    circle = next(
        number
        for number in range(3)
        if len(opened.contours[number].edges[0].nodes) == 0 and opened.nesting.depths[number]
    )
    outline = opened.nesting.depths.index(0)
    chosen = (
        choose(opened, circle, start=(13.0, 10.0), entry=(10.0, 10.0)),
        choose(opened, outline, tab=2.0, tabs=((23.0, 2.0), (3.0, 11.0))),
    )
    job = replace(job, contours=chosen)
    opened = open_drawing(job, data)
    assert decoded(encoded(written(job, opened)), "job").place == place
    contours = {planned.number: planned for planned in plan_drawing(job, opened)}
    # (mirrored and turned by a quarter, x and y change places, with their signs: 2 · (2 − y), 2 · (3 − x))
    assert contours[circle].start == pytest.approx((2 * (2 - 10), 2 * (3 - 13)))
    assert contours[circle].entry == pytest.approx((2 * (2 - 10), 2 * (3 - 10)))
    middles = [tab[0].at(0.5) for _, tab in contours[outline].spans]
    assert sorted(middles) == [pytest.approx((-18, 0), abs=0.01), pytest.approx((0, -40), abs=0.01)]
    assert cut_drawing(job, opened).result.checked.off < 0.003
    wide = replace(job, contours=(choose(opened, circle, start=(13.0, 20.0)),))
    with pytest.raises(UserError) as failed:
        plan_drawing(wide, open_drawing(wide, data))
    assert failed.value.finding.code == "hole-inside" or failed.value.finding.code == "hole-outside"
    assert failed.value.place == pytest.approx((13.0, 20.0))


def test_an_open_line_in_a_mirror(run: Run, tmp_path: Path) -> None:
    """The wire runs on the mirrored side; within a closed contour it stays within."""
    page = drawing()
    page.modelspace().add_line((0, 0), (20, 5))
    path = saved(page, tmp_path)
    words = ["--open", "cut", "--offset", "0.5", "--side", "left"]
    before, _ = cut(run, path, *words)
    after, _ = cut(run, path, *words, "--mirror", "x")
    assert after.hausdorff_distance(shapely.affinity.scale(before, -1, 1, origin=(0, 0))) < 0.002
    page = drawing()
    square = polygon([(0, 0), (20, 0), (20, 12), (0, 12)], page)
    path = saved(page, tmp_path)
    wire, _ = cut(run, path, "--offset", "0.5", "--side", "left", "--mirror", "x")
    assert wire.within(shapely.affinity.scale(square, -1, 1, origin=(0, 0)))


def test_what_is_refused(run: Run, tmp_path: Path) -> None:
    path = saved(part(), tmp_path)
    for words in (["--scale", "0"], ["--turn", "400"], ["--origin", "middle"], ["--mirror", "z"], ["--scale", "2000"]):
        done = run("cut", path, "-o", tmp_path / "a.3b", *words)
        assert done.exit_code == 2 and words[0] in done.stderr
    for words in (["--origin", "60000,0"], ["--scale", "999", "--origin", "-50,-50"]):
        with pytest.raises(UserError) as failed:
            run("cut", path, "-o", tmp_path / "a.3b", *words)
        assert failed.value.finding.code == "placed-too-far"
    assert not (tmp_path / "a.3b").exists()
    quiet = run("cut", path, "-o", tmp_path / "b.3b", "--scale", "1.5", "--side", "on", "--quiet").stderr
    assert says(quiet, Phrase("scaled", scale=1.5, width=60, height=37.6299))


@pytest.mark.parametrize("place", [Place(), Place(origin="centre", turn=30.0)])
def test_a_refusal_says_that_a_drawing_was_moved_near(tmp_path: Path, place: Place) -> None:
    """Its places are where the report and the page have the drawing, wherever this lies on the machine."""
    page = drawing()
    page.modelspace().add_lwpolyline([(x + 1e6, y - 2e6) for x, y in [(0, 0), (40, 40), (40, 0), (0, 40)]], close=True)
    job = Job("part.dxf", setup=Setup(offset=0.1), place=place)
    with pytest.raises(UserError) as failed:
        cut_drawing(job, open_drawing(job, saved(page, tmp_path).read_bytes()))
    finding = failed.value.finding
    assert finding.source == ("part.dxf", Phrase("moved-by", by=(-1_000_000, 2_000_000)))
    assert finding["why"]["place"] == pytest.approx((20, 20)), finding


def test_what_is_drawn_twice_is_moved_near_with_the_drawing(tmp_path: Path) -> None:
    page = drawing()
    polygon([(1e6, 0), (1e6 + 40, 0), (1e6 + 40, 30), (1e6, 30)], page)
    page.modelspace().add_line((1e6, 30), (1e6 + 40, 30))
    report = open_drawing(Job("part.dxf"), saved(page, tmp_path).read_bytes()).reading.report
    assert [overlap.kind for overlap in report.overlaps] == ["drawn twice"]
    assert report.overlaps[0].place in {(0, 30), (40, 30)}
