"""Repairs that somebody asks for: bridges, corners, lines left, kept in the job; and walls that two cuts leave thin."""

from __future__ import annotations

from pathlib import Path

import ezdxf
import pytest
from ezdxf import units

from skg.errors import UserError
from skg.job import file as job_files
from skg.job.job import Job
from skg.job.machine import Setup
from skg.job.read_options import ReadOptions
from skg.pipeline.steps import cut_drawing, open_drawing

#: An outline that is open by 0.4 mm at its lower left corner.
GAP = (0.0, 0.0, 0.0, 0.4)


def drawing(folder: Path, by: float = 0.0, *circles: tuple[float, float, float]) -> bytes:
    """The outline, moved by so much to the right, with circles in it."""
    page = ezdxf.new()
    page.units = units.MM
    corners = [(0, 0), (60, 0), (60, 40), (0, 40), (0, 0.4)]
    for (x, y), (u, v) in zip(corners, corners[1:], strict=False):
        page.modelspace().add_line((x + by, y), (u + by, v))
    for x, y, r in circles:
        page.modelspace().add_circle((x + by, y), r)
    path = folder / "part.dxf"
    page.saveas(path)
    return path.read_bytes()


def job(**read: object) -> Job:
    return Job("part.dxf", read=ReadOptions(**{"open": None, **read}), setup=Setup(wire=0.2))


def test_a_bridge_closes_an_outline_and_is_kept(tmp_path: Path) -> None:
    data = drawing(tmp_path)
    with pytest.raises(UserError) as refused:
        open_drawing(job(), data)
    assert (refused.value.finding.code, refused.value.place) == ("open-refused", (0.0, 0.0))
    asked = job_files.decoded(job_files.encoded(job(bridges=(GAP,))), "part.job.toml")
    assert asked.read.bridges == (GAP,)
    opened = open_drawing(asked, data)
    (contour,) = opened.contours
    assert contour.is_closed and len(contour.edges) == 4, "the bridge and the edge that it goes on are one"
    cut = cut_drawing(asked, opened)
    assert cut.result.checked.off < 0.003
    (joined,) = [finding for finding in cut.findings if finding.code == "ends-joined"]
    assert joined["gap"] == pytest.approx(0.4)
    # the drawing is saved anew, its ends a little further on, or somewhere else
    assert open_drawing(asked, drawing(tmp_path, 0.3)).contours[0].is_closed
    assert open_drawing(asked, drawing(tmp_path, 7)).contours[0].is_closed
    lost = open_drawing(job(open="cut", bridges=((0, 0, 0, 0.7),)), drawing(tmp_path, 7))
    assert "repair-lost" in {finding.code for finding in lost.reading.report.report()}
    assert not lost.contours[0].is_closed


def crossed(folder: Path, by: float = 0.0) -> bytes:
    """A drawing of one outline: two ends run 1 and 2 mm past their corner, two end 0.6 and 0.8 mm before theirs, an arc
    runs past a line; a stray line beside it, a line within it."""
    page = ezdxf.new()
    page.units = units.MM
    space = page.modelspace()
    for (x, y), (u, v) in (
        ((-2, 0), (59.4, 0)), ((60, 0.8), (60, 30)), ((60, 30), (40, 40)), ((40, 40), (9, 40)), ((0, 30), (0, -1)),
        ((80, 5), (90, 8)), ((90, 8), (95, 8)),
    ):  # fmt: skip
        space.add_line((x + by, y), (u + by, v))
    # (from the left end to beyond the upper line)
    space.add_arc((10 + by, 30), 10, 80, 180)
    path = folder / "part.dxf"
    page.saveas(path)
    return path.read_bytes()


def test_corners_are_made_and_strays_are_left(tmp_path: Path) -> None:
    """All that is offered, asked for: one closed outline, each place named with its size, the tape on the lines."""
    data = crossed(tmp_path)
    offered = open_drawing(job(open="cut"), data).reading.report.repairs
    corners = [repair for repair in offered if repair.kind == "corner"]
    assert [round(repair.size, 2) for repair in corners] == [0.8, 1.75, 2.0]
    # (no line is put in between ends that run past their crossing)
    assert [round(repair.size, 2) for repair in offered if repair.kind == "bridge"] == [1.0, 15.3]
    stray = max((repair for repair in offered if repair.kind == "stray"), key=lambda each: each.places[0])
    asked = job(corners=tuple(repair.asked for repair in corners), strays=(stray.asked,))
    asked = job_files.decoded(job_files.encoded(asked), "part.job.toml")
    opened = open_drawing(asked, data)
    (contour,) = opened.contours
    assert contour.is_closed and len(contour.edges) == 6
    cut = cut_drawing(asked, opened)
    assert cut.result.checked.off < 0.004
    made = [finding for finding in cut.findings if finding.code == "corner-made"]
    sizes = {tuple(round(ordinate, 3) + 0.0 for ordinate in finding.place): finding for finding in made}
    assert sizes.keys() == {(0, 0), (60, 0), (10, 40)}
    assert (sizes[0, 0]["longer"], sizes[0, 0]["shorter"]) == pytest.approx((0, 2))
    assert (sizes[60, 0]["longer"], sizes[60, 0]["shorter"]) == pytest.approx((0.8, 0))
    (left,) = [finding for finding in cut.findings if finding.code == "stray-left"]
    assert left["length"] == pytest.approx(15.44, abs=0.01)
    assert sum(layer.skipped for layer in cut.account.layers) == 2
    # saved anew, elsewhere: all are found again
    again = open_drawing(asked, crossed(tmp_path, 25))
    assert len(again.contours) == 1 and again.contours[0].is_closed
    # in a country's coordinates: moved to where a tape has room, and so is what the report says of it
    far = cut_drawing(asked, open_drawing(asked, crossed(tmp_path, 437_000)))
    places = [finding.place for finding in far.findings if finding.code == "corner-made"]
    assert sorted(map(tuple, places)) == [pytest.approx(place, abs=1e-3) for place in ((0, 0), (10, 40), (60, 0))]


def test_overlapping_lines_beyond_a_corner(tmp_path: Path) -> None:
    """They are one by themselves; what of them lies behind the corner is offered to be cut off, and is then."""
    page = ezdxf.new()
    page.units = units.MM
    for (x, y), (u, v) in (
        ((60, 0), (60, 40)), ((60, 40), (0, 40)), ((0, 40), (0, 0)), ((0, 0), (40, 0)), ((30, 0), (63, 0)),
    ):  # fmt: skip
        page.modelspace().add_line((x, y), (u, v))
    path = tmp_path / "part.dxf"
    page.saveas(path)
    data = path.read_bytes()
    offered = open_drawing(job(open="cut"), data).reading.report.repairs
    (corner,) = [repair for repair in offered if repair.kind == "corner"]
    assert corner.size == pytest.approx(3) and not [repair for repair in offered if repair.kind == "bridge"]
    asked = job(corners=(corner.asked,))
    opened = open_drawing(asked, data)
    (contour,) = opened.contours
    assert contour.is_closed and len(contour.edges) == 4
    codes = [finding.code for finding in cut_drawing(asked, opened).findings]
    assert "lines-twice" in codes and "corner-made" in codes


def test_a_repair_that_is_not_named_is_refused(tmp_path: Path) -> None:
    """The check sees that a corner is not as it is drawn."""
    data = crossed(tmp_path)
    offered = open_drawing(job(open="cut"), data).reading.report.repairs
    asked = job(open="leave", corners=tuple(repair.asked for repair in offered if repair.kind == "corner"))
    opened = open_drawing(asked, data)
    opened.reading.begun.mends.clear()
    with pytest.raises(UserError) as refused:
        cut_drawing(asked, opened)
    assert refused.value.finding.code == "off-the-file"


@pytest.mark.parametrize("bad", ["[[1, 2, 3]]", "[1, 2, 3, 4]", '"x"', "[[1, 2, 3, inf]]"])
def test_bad_bridges(bad: str) -> None:
    text = f'schema = 1\ndrawing = "part.dxf"\n[read]\nbridges = {bad}\n'
    with pytest.raises(UserError) as refused:
        job_files.load(text, "part.job.toml")
    assert refused.value.finding.code == "wrong-value"


def test_thin_walls(tmp_path: Path) -> None:
    """0.3 mm between two openings, and 0.35 mm to the outline, are thinner than two cuts of 0.2 mm; 0.5 mm are not."""
    circles = ((10, 20, 5), (20.3, 20, 5), (54.65, 20, 5), (30.8, 20, 5))
    asked = job(bridges=(GAP,))
    cut = cut_drawing(asked, open_drawing(asked, drawing(tmp_path, 0.0, *circles)))
    walls = [finding for finding in cut.findings if finding.code == "thin-wall"]
    assert [round(wall["wide"], 3) for wall in walls] == [0.3, 0.35]
    assert walls[0]["kerf"] == pytest.approx(0.4) and walls[0].place == pytest.approx((15.15, 20), abs=0.01)
    assert {walls[0].contour, walls[1].contour} <= set(range(5))
