"""A punch and its die from one contour: shapely measures what is between them; both files or none."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import shapely
from cuthelp import drawing, polygon, saved, stretches
from shapely.geometry import Polygon
from toolhelp import Run

from skg.errors import UserError
from skg.job.file import decoded, encoded
from skg.job.job import Job
from skg.job.wanted import Partial

#: A profile with a corner of each kind.
PROFILE = [(0, 0), (40, 0), (40, 12), (25, 12), (25, 20), (0, 20)]


def profile(folder: Path, plate: bool = False) -> Path:
    """The profile with a hole; within a plate that has one, too."""
    page = drawing()
    polygon(PROFILE, page, layer="PROFILE")
    page.modelspace().add_circle((10, 10), 4, dxfattribs={"layer": "PROFILE"})
    if plate:
        polygon([(-20, -20), (60, -20), (60, 40), (-20, 40)], page, layer="PLATE")
        page.modelspace().add_circle((-10, -10), 3, dxfattribs={"layer": "PLATE"})
    return saved(page, folder)


def both(run: Run, path: Path, *words: str) -> dict[str, tuple[list[Polygon], dict]]:
    """The wire's ways around (polygons) and the report, of the punch and of the die."""
    done = run("cut", path, "-o", path.with_name("tool.nodrift.3b"), "--json", *words)
    assert done.exit_code == 0, done.stderr
    reports = json.loads(done.stderr)
    assert list(reports) == ["punch", "die"]
    result = {}
    for member, report in reports.items():
        tape = path.with_name(f"tool-{member}.nodrift.3b")
        ways = [Polygon(way[1:-1]) for way in stretches(tape.read_bytes(), tuple(report["starts"][0]))]
        result[member] = [way for way in ways if way.area > 1], report
    return result


@pytest.mark.parametrize("taker, sizes", [("punch", (-0.02, 0.0)), ("die", (0.0, 0.02))])
def test_what_is_between_them(run: Run, tmp_path: Path, taker: str, sizes: tuple[float, float]) -> None:
    """The punch, as the wire leaves it, is so much smaller than what the die has left out, all around; who takes it is
    smaller or larger, the other one is to size. The hole is the punch's."""
    made = both(run, profile(tmp_path), "--offset", "0.12", "--clearance", "0.02", "--clearance-on", taker)
    (hole, around), report = made["punch"]
    (within,), other = made["die"]
    assert hole.area == pytest.approx(3.14159 * 3.88**2, rel=0.01) and hole.within(around)
    # (the wire leaves the punch by 0.12 mm, and takes as much of the die)
    punch = around.buffer(-0.12, join_style="mitre")
    die = within.buffer(0.12, join_style="mitre")
    for part, size in ((punch, sizes[0]), (die, sizes[1])):
        wanted = Polygon(PROFILE).buffer(size, join_style="mitre")
        assert part.exterior.hausdorff_distance(wanted.exterior) < 0.003
    assert punch.exterior.distance(die.exterior) == pytest.approx(0.02, abs=0.003)
    codes = [[finding["code"] for finding in each["findings"]] for each in (report, other)]
    assert codes[0][0] == "pair-punch" and codes[1][0] == "pair-die"
    assert not {"side-of-openings", "side-of-outlines", "no-part-has-tab"} & {*codes[0], *codes[1]}


def test_a_plate_is_the_dies(run: Run, tmp_path: Path) -> None:
    """A clearance of a layer: plate and its hole are cut with the die, the hole in the profile with the punch. Start
    holes go to whom they are for; a job says the same."""
    profile(tmp_path, plate=True)
    job = Job("part.dxf", layers={"profile": Partial(clearance=0.03, clearance_on="die")}, starts=((20, 5), (-5, 10)))
    assert decoded(encoded(job), "job") == job
    file = tmp_path / "part.job.toml"
    file.write_bytes(encoded(job) + b"[machine]\noffset = 0.1\n")
    made = both(run, file, "--sheet", str(tmp_path / "tool.svg"))
    assert [len(made[member][0]) for member in ("punch", "die")] == [2, 3]
    assert [-5, 10] in made["punch"][1]["starts"] and [20, 5] in made["die"][1]["starts"]
    assert {each.name for each in tmp_path.glob("tool*.svg")} == {"tool-punch.svg", "tool-die.svg"}
    assert max(made["die"][0], key=lambda way: way.area).bounds == pytest.approx((-20.1, -20.1, 60.1, 40.1), abs=0.002)


def test_both_or_none(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is refused of one writes nothing of the other, and says which; so does a disk that fails."""
    path, words = profile(tmp_path), ["--offset", "0.1", "--clearance", "0.02"]
    tapes = [tmp_path / f"tool-{member}.3b" for member in ("punch", "die")]
    before = {each.name for each in tmp_path.iterdir()}
    for more, code, source in (
        (["--clearance-on", "punch", "--clearance", "0.1"], "clearance-too-large", "member-punch"),
        (["--start", "-5,5", "--start", "30,11.95"], "hole-near-inside", "member-die"),
    ):
        with pytest.raises(UserError) as failed:
            run("cut", path, "-o", tmp_path / "tool.3b", *words, *more, "--program", tmp_path / "tool.skg")
        finding = failed.value.finding
        assert finding.code == code and finding.source[0].code == source
    with pytest.raises(UserError) as failed:
        run("cut", path, *words)
    assert failed.value.finding.code == "pair-on-stdout"
    assert {each.name for each in tmp_path.iterdir()} == before
    tapes[1].mkdir()
    with pytest.raises((UserError, OSError)):
        run("cut", path, "-o", tmp_path / "tool.3b", *words)
    assert not tapes[0].exists()
    tapes[1].rmdir()
    short = run("cut", path, "-o", tmp_path / "TOOL.3b", *words, "--short-name", "--quiet")
    assert short.exit_code == 0 and (tmp_path / "TOOL-P.3b").exists() and (tmp_path / "TOOL-D.3b").exists()


def test_one_contour_of_many(run: Run, tmp_path: Path) -> None:
    """Copies, mirrored and turned: each punch is beside its die's size."""
    words = ["--offset", "0.1", "--clearance", "0.02", "--mirror", "x", "--turn", "90"]
    made = both(run, profile(tmp_path), *words, "--columns", "2", "--step", "45,0")
    for member, count in (("punch", 4), ("die", 2)):
        assert len(made[member][0]) == count
    areas = sorted(shapely.area(way) for way in made["die"][0])
    assert areas[0] == pytest.approx(areas[1], rel=1e-4)


def test_what_falls_and_what_the_control_must_know(run: Run, tmp_path: Path) -> None:
    """In passes the punch comes free, of the die the slug; each file says which offsets the control needs."""
    words = ["--offset", "0.1", "--clearance", "0.02", "--passes", "0.05,0", "--machine", "wire-fanuc"]
    done = run("cut", profile(tmp_path), "-o", tmp_path / "tool.nc", "--json", *words)
    reports = json.loads(done.stderr)
    values = {
        member: {finding["code"]: finding["values"] for finding in report["findings"]}
        for member, report in reports.items()
    }
    assert "parts-free" in values["punch"] and "parts-free" not in values["die"]
    offsets = {
        member: [each["values"]["offset"] for each in told["offsets-to-be-set"]["offsets"]]
        for member, told in values.items()
    }
    assert offsets == {"punch": [0.15, 0.1, 0.13, 0.08], "die": [0.15, 0.1]}
    texts = {member: (tmp_path / f"tool-{member}.nc").read_text() for member in values}
    assert "D4" in texts["punch"] and "D2" in texts["die"] and "D3" not in texts["die"]
