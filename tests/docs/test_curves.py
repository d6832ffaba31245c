"""docs/curves.md shows what `skg quality` prints and the pictures of the examples; run as a program, this writes it.

A table stands below a comment that holds the command it comes from.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from skg.cli import cli

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "curves.md"
PICTURES = ROOT / "docs" / "pictures"
PARTS = sorted((ROOT / "examples").glob("fit-*.skg"))
TABLE = re.compile(r"<!-- skg (?P<command>quality .*) -->\n\n(?P<table>(?:\|.*\n)*)")


def tables() -> list[re.Match[str]]:
    return list(TABLE.finditer(PAGE.read_text()))


def output(*words: object) -> str:
    """What `skg` prints."""
    done = CliRunner().invoke(cli, [str(word) for word in words])
    assert done.exit_code == 0, done.output
    return done.output


def table(match: re.Match[str]) -> str:
    """What the command of a table prints, files named by a pattern as in a shell."""
    words = []
    for word in match["command"].split():
        words += sorted(ROOT.glob(word)) if "*" in word else [word]
    return output(*words)


def draw(part: Path, folder: Path) -> bytes:
    """The picture of an example."""
    picture = folder / f"{part.stem}.svg"
    output("plot", part, "--skg80", "reference", "-o", picture)
    return picture.read_bytes()


def test_both_tables_are_there() -> None:
    assert [match["command"] for match in tables()] == [
        "quality examples/fit-*.skg",
        "quality --tol 0.005 examples/fit-*.skg",
    ]


@pytest.mark.parametrize("match", tables(), ids=lambda match: match["command"])
def test_table(match: re.Match[str]) -> None:
    # The jump is what 50 digits leave over of nothing: only its size is to be expected.
    def fixed(text: str) -> str:
        return re.sub(r" \de-\d\d ", " e- ", text)

    assert fixed(match["table"]) == fixed(table(match))


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part.stem)
def test_picture(part: Path, tmp_path: Path) -> None:
    assert f"](pictures/{part.stem}.svg)" in PAGE.read_text()
    assert draw(part, tmp_path) == (PICTURES / f"{part.stem}.svg").read_bytes()


def test_every_picture_is_used() -> None:
    assert {part.stem for part in PARTS} == {path.stem for path in PICTURES.glob("fit-*.svg")}


if __name__ == "__main__":
    PAGE.write_text(TABLE.sub(lambda match: f"<!-- skg {match['command']} -->\n\n{table(match)}", PAGE.read_text()))
    for each in PARTS:
        draw(each, PICTURES)
