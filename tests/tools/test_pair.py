"""A punch and its die from one contour: shapely measures what is between them; both files or none."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import shapely
from cuthelp import drawing, polygon, saved, stretches
from shapely.geometry import Polygon
from toolhelp import Run

from skg.errors import UserError
from skg.geometry.offset import wire_path
from skg.job.file import decoded, encoded
from skg.job.job import Job
from skg.job.wanted import Overrides
from skg.pipeline import pairing

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


@pytest.mark.parametrize("clearance", [0.02, 0.12, 0.5])
@pytest.mark.parametrize("taker", ["punch", "die"])
def test_what_is_between_them(run: Run, tmp_path: Path, taker: str, clearance: float) -> None:
    """The punch, as the wire leaves it, is so much smaller than what the die has left out, all around; who takes it is
    smaller or larger, the other one is to size. The hole is the punch's. So it is with more than the wire's 0.12 mm."""
    sizes = (-clearance, 0.0) if taker == "punch" else (0.0, clearance)
    made = both(run, profile(tmp_path), "--offset", "0.12", "--clearance", str(clearance), "--clearance-on", taker)
    (hole, around), report = made["punch"]
    (within,), other = made["die"]
    assert hole.area == pytest.approx(3.14159 * 3.88**2, rel=0.01) and hole.within(around)
    parts = []
    # (the wire leaves the punch by 0.12 mm, and takes as much of the die)
    for way, size, sign in ((around, sizes[0], -1), (within, sizes[1], 1)):
        # (what is made larger or smaller by more than the wire's distance has arcs around corners)
        join: Any = {"join_style": "round" if abs(size) >= 0.12 else "mitre", "quad_segs": 64}
        part, wanted = way.buffer(sign * 0.12, **join), Polygon(PROFILE).buffer(size, **join)
        assert part.exterior.hausdorff_distance(wanted.exterior) < 0.003
        parts.append(part)
    assert parts[0].exterior.distance(parts[1].exterior) == pytest.approx(clearance, abs=0.003)
    codes = [[finding["code"] for finding in each["findings"]] for each in (report, other)]
    assert codes[0][0] == "pair-punch" and codes[1][0] == "pair-die"
    assert not {"side-of-openings", "side-of-outlines", "no-part-has-tab"} & {*codes[0], *codes[1]}


def test_a_plate_is_the_dies(run: Run, tmp_path: Path) -> None:
    """A clearance of a layer: plate and its hole are cut with the die, the hole in the profile with the punch. Start
    holes go to whom they are for; a job says the same."""
    profile(tmp_path, plate=True)
    job = Job("part.dxf", layers={"profile": Overrides(clearance=0.03, clearance_on="die")}, starts=((20, 5), (-5, 10)))
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
    with pytest.raises(UserError) as failed:
        starts = ["--start", "-5,5", "--start", "30,11.95"]
        run("cut", path, "-o", tmp_path / "tool.3b", *words, *starts, "--program", tmp_path / "tool.skg")
    finding = failed.value.finding
    assert finding.code == "hole-near-inside" and finding.source[0].code == "member-die"
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


@pytest.mark.parametrize("clearance", ["0.02", "0.3"])
def test_one_contour_of_many(run: Run, tmp_path: Path, clearance: str) -> None:
    """Copies, mirrored and turned: each punch is beside its die's size."""
    words = ["--offset", "0.1", "--clearance", clearance, "--mirror", "x", "--turn", "90"]
    made = both(run, profile(tmp_path), *words, "--columns", "2", "--step", "45,0")
    for member, count in (("punch", 4), ("die", 2)):
        assert len(made[member][0]) == count
    areas = sorted(shapely.area(way) for way in made["die"][0])
    assert areas[0] == pytest.approx(areas[1], rel=1e-4)


@pytest.mark.parametrize("member", ["punch", "die"])
def test_a_size_that_is_not_whole_is_refused(run: Run, tmp_path: Path, member: str) -> None:
    """A slot that is narrower at its bottom: a die that is larger would close it there; and a punch that is smaller
    would lose the narrow end."""
    page, sign = drawing(), 1 if member == "die" else -1
    polygon(
        [(0, 0), (40, 0), (40, 20), (20.5, 20), (20.2, 20 - sign * 10), (19.8, 20 - sign * 10), (19.5, 20), (0, 20)],
        page,
    )
    words = ["--offset", "0.1", "--clearance", "0.35", "--clearance-on", member]
    with pytest.raises(UserError) as failed:
        run("cut", saved(page, tmp_path), "-o", tmp_path / "tool.3b", *words)
    finding = failed.value.finding
    assert finding.code == "clearance-too-large" and finding.source[0].code == f"member-{member}"
    assert finding.place == pytest.approx((20, 20 - sign * 10)) and not list(tmp_path.glob("*.3b"))


def test_another_size_is_refused(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A punch that is 5 µm off what it is to be: shapely has the size out of the drawing."""
    monkeypatch.setattr(pairing, "wire_path", lambda contour, r: wire_path(contour, r + 0.005))
    with pytest.raises(UserError) as failed:
        run("cut", profile(tmp_path), "-o", tmp_path / "tool.3b", "--offset", "0.1", "--clearance", "0.3")
    assert failed.value.finding.code == "off-the-file" and not list(tmp_path.glob("*.3b"))


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
