"""docs/curves.md shows tables and pictures of the examples' curves; run as a program, this writes them.

A table stands below a comment that names it.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner
from curve_tables import of_curves, of_tol

from skg.cli import cli

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "curves.md"
PICTURES = ROOT / "docs" / "pictures"
PARTS = sorted((ROOT / "examples").glob("fit-*.skg"))
TABLE = re.compile(r"<!-- (?P<name>curves|TOL) -->\n\n(?P<table>(?:\|.*\n)*)")
MAKERS = {"curves": lambda: of_curves(PARTS), "TOL": lambda: of_tol(PARTS, "0.005")}


#: In one process with test_quality.py, which measures the same.
pytestmark = pytest.mark.xdist_group("curves")


def tables() -> list[re.Match[str]]:
    return list(TABLE.finditer(PAGE.read_text()))


def draw(part: Path, folder: Path) -> bytes:
    """The picture of an example."""
    picture = folder / f"{part.stem}.svg"
    done = CliRunner().invoke(cli, ["plot", str(part), "--skg80", "reference", "-o", str(picture)])
    assert done.exit_code == 0, done.output
    return picture.read_bytes()


def test_both_tables_are_there() -> None:
    assert [match["name"] for match in tables()] == list(MAKERS)


@pytest.mark.parametrize("match", tables(), ids=lambda match: match["name"])
def test_table(match: re.Match[str]) -> None:
    # The jump is what 50 digits leave over of nothing: only its size is to be expected.
    def fixed(text: str) -> str:
        return re.sub(r" \de-\d\d ", " e- ", text)

    assert fixed(match["table"]) == fixed(MAKERS[match["name"]]())


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part.stem)
def test_picture(part: Path, tmp_path: Path) -> None:
    assert f"](pictures/{part.stem}.svg)" in PAGE.read_text()
    assert draw(part, tmp_path) == (PICTURES / f"{part.stem}.svg").read_bytes()


def test_every_picture_is_used() -> None:
    assert {part.stem for part in PARTS} == {path.stem for path in PICTURES.glob("fit-*.svg")}


if __name__ == "__main__":
    PAGE.write_text(TABLE.sub(lambda match: f"<!-- {match['name']} -->\n\n{MAKERS[match['name']]()}", PAGE.read_text()))
    for each in PARTS:
        draw(each, PICTURES)
