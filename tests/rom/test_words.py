"""The words of the language: an image and its reference take the same ones, and LIST writes them alike."""

from __future__ import annotations

import sys
from collections.abc import Collection
from itertools import product
from pathlib import Path
from string import ascii_uppercase

import pytest
from romhelp import Board, fault

from skg.ref.listing import listed
from skg.ref.mill.statements import MILL
from skg.ref.parser import WIRE, Dialect, LineFault, parse_line, remark, squeeze

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "asm"))

import images  # noqa: E402  (from asm/)
import words  # noqa: E402

#: Each dialect of the reference, and an image that has its words.
DIALECTS = [pytest.param("skg", WIRE, id="wire"), pytest.param("skg-mill", MILL, id="mill")]
#: What may stand behind a word.
BEHIND = [
    "", " 5", " O", " X", "(5)", "=5", " A", " A,B", " 5,6", " O,5", " O,O", " 5=5 GOTO 5", '"A"', " 5,6:O", " A,5;X",
]  # fmt: skip
EVERY_SET = {name for image in images.IMAGES.values() for name in image.words}


def words_of(sets: Collection[str]) -> list[words.Word]:
    """The words of an image with these sets."""
    return words.read(sets)


def candidates() -> list[str]:
    """The words of all images, and each letter: it may be a word or begin a name."""
    every = {word.text for sets in (*({name} for name in EVERY_SET), set()) for word in words_of(sets)}
    assert {"CUT", "HOLE", "DRIVE", "BYE", "TOL"} <= every
    return sorted(every | set(ascii_uppercase))


def reference_fault(line: str, dialect: Dialect) -> int | None:
    """The error of a line as the reference reads it."""
    try:
        parse_line(line, dialect)
    except LineFault as found:
        return int(found.code)
    return None


@pytest.mark.parametrize(("kind", "dialect"), DIALECTS)
def test_an_image_and_its_reference_take_the_same_words(kind: str, dialect: Dialect) -> None:
    board = Board(kind=kind)
    taken = 0
    for word, behind in product(candidates(), BEHIND):
        line = f"10 {word}{behind}"
        board.type("NEW")
        error = fault(board.type(line))
        assert (error.number if error else None) == reference_fault(line, dialect), line
        if not error:
            taken += 1
            assert board.listing() == [listed(squeeze(line)[0], remark(line), dialect.words)], line
    assert taken > 60


@pytest.mark.parametrize(("kind", "dialect"), DIALECTS)
def test_a_dialect_has_the_statements_of_its_image(kind: str, dialect: Dialect) -> None:
    """FREE is a statement to the mill's tables alone, so that F is not read in front of it."""
    have = [word.text for word in words_of(images.IMAGES[kind].words) if word.kind == "statement"]
    assert sorted(dialect.words) == sorted(set(have) - {"FREE"})
