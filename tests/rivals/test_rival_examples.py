"""The rivals' programs in examples/: their tapes, their pictures, and that there is room for them."""

from __future__ import annotations

from pathlib import Path

import pytest
from compare import compare
from rivalhelp import ROOT
from romhelp import Board, run

from skg.ref import run as reference
from skg.rivals.languages import RIVALS, translated

PARTS = sorted(part for ending in RIVALS for part in (ROOT / "examples").glob(f"*{ending}"))
BOOK = {"fig1", "1-pointer", "2-hexagon", "star", "3-disc", "3-reversed"}
TEXT = {"centres", "points", "planes", "lines"}
OWN = {"xy-gear", "xy-die-set", "xy-pulley-plate", "tkh-fork", "tkh-cam", "tkh-bracket", "tkh-maltese"}
parts = pytest.mark.parametrize("part", PARTS, ids=lambda part: part.stem)


def test_there_are_enough() -> None:
    names = {part.stem for part in PARTS}
    assert {f"xy-book-{name}" for name in BOOK} | {f"tkh-text-{name}" for name in TEXT} | OWN <= names


@parts
def test_tape(part: Path) -> None:
    program = translated(str(part))
    tape = part.with_suffix(".3b").read_bytes()
    outcome = run(program)
    assert outcome.error is None, outcome.paper
    assert outcome.tape == tape
    assert reference(program).tape == tape
    assert reference(program, bits=33).tape == tape
    assert not compare(program).aside


@parts
def test_room(part: Path) -> None:
    """A board of 6 KiB takes it."""
    assert Board(6).outcome(translated(str(part))).error is None


@parts
def test_lines_are_short_ascii(part: Path) -> None:
    for line in translated(str(part)).splitlines():
        assert len(line) <= 72
        assert line.isascii()


@parts
def test_picture(part: Path) -> None:
    assert (ROOT / "docs" / "pictures" / f"{part.stem}.svg").read_text().startswith("<?xml")
    assert f"pictures/{part.stem}.svg" in (ROOT / "docs" / "rivals.md").read_text()


def test_pointer_is_the_same_in_both() -> None:
    """The XY book's first example: TEKHTRAN begins where XY's rule for the start does."""
    tapes = [(ROOT / "examples" / f"{name}.3b").read_bytes() for name in ("xy-book-1-pointer", "tkh-pointer")]
    assert tapes[0] == tapes[1]
