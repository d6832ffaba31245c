"""Files of start holes for who drills them: a list, and a drilling program."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest
from cuthelp import drawing, polygon, saved
from toolhelp import Run

from skg.tape.gcode_reader import read


def part(folder: Path) -> Path:
    page = drawing()
    polygon([(0, 0), (30, 0), (30, 20), (0, 20)], page, layer="PART")
    polygon([(10, 5), (20, 5), (20, 15), (10, 15)], page, layer="PART")
    return saved(page, folder)


def cut(run: Run, path: Path, *options: object) -> dict:
    done = run("cut", path, "-o", path.parent / "a.3b", *options, "--json")
    return json.loads(done.stderr)


def test_both_have_the_holes_of_the_tape(run: Run, tmp_path: Path) -> None:
    """In the order of cutting, those between several tabs too, where the part lies on the machine."""
    table, program, path = tmp_path / "holes.csv", tmp_path / "holes.NC", part(tmp_path)
    options = ("--offset", 0.1, "--tab", 2, "--tabs", 2, "--turn", 90, "--thickness", 12.5)
    told = cut(run, path, *options, "--holes", table)
    starts = [tuple(place) for place in told["starts"]]
    rows = list(csv.DictReader(table.read_text().splitlines()))
    assert [(float(row["x_mm"]), float(row["y_mm"])) for row in rows] == starts and len(starts) == 3
    assert [(row["hole"], row["contour"], row["kind"]) for row in rows] == [
        ("1", "1", "opening"),
        ("2", "2", "outline"),
        ("3", "2", "outline"),
    ]
    assert "drilled" not in {finding["code"] for finding in told["findings"]}
    told = cut(run, path, *options, "--holes", program)
    (said,) = (finding for finding in told["findings"] if finding["code"] == "drilled")
    assert said["values"] == {"count": 3, "depth": 14.5, "over": 2, "clear": 2, "feed": 100}
    assert str(program) in run("cut", path, "-o", tmp_path / "a.3b", *options, "--holes", program, "--quiet").stderr
    drilled = read(program.read_bytes().decode(), "a").path.marks
    assert [(hole.place[0] / 1000, hole.place[1] / 1000) for hole in drilled] == starts
    assert {hole.depth for hole in drilled} == {-14500}
    assert run("check", program).exit_code == 0


@pytest.mark.parametrize(
    ("name", "options", "code"),
    [
        ("holes.nc", (), "drill-without-thickness"),
        ("holes.txt", ("--thickness", 3), "holes-name"),
        ("holes", ("--thickness", 3), "holes-name"),
    ],
)
def test_nothing_is_written_by_half(run: Run, tmp_path: Path, name: str, options: tuple, code: str) -> None:
    path = part(tmp_path)
    before = path.read_bytes()
    done = run("cut", path, "-o", tmp_path / "a.3b", *options, "--holes", tmp_path / name, "--json")
    assert done.exit_code != 0 and code in done.stderr
    assert [one.name for one in tmp_path.iterdir()] == ["part.dxf"] and path.read_bytes() == before
