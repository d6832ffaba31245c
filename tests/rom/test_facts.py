"""The facts that the sources state and rely on: the build reads them, and refuses one that does not hold."""

from __future__ import annotations

import sys

import pytest
from facthelp import each_says
from romhelp import ROM, ROOT

from skg.board import symbols

sys.path.insert(0, str(ROOT / "asm"))
import build
import facts

NAMES = {"CELL": 0x20B0, "NEXT": 0x20B1, "PAGE": 0x2300}


def checked(text: str) -> tuple[int, list[str]]:
    """The checker's findings in a source."""
    return facts.check({"some": text}, NAMES)


def test_the_sources_state_facts_and_they_hold() -> None:
    count, wrong = facts.check(build.sources(build.IMAGES["skg"]), symbols(ROM.with_suffix(".sym").read_text()))
    assert count >= 25
    assert wrong == []


@pytest.mark.parametrize(
    "fact", ["NEXT == CELL+1", "PAGE & 0FFH == 0 and CELL/100H == 20H", "PAGE-CELL < 1000", "2*3 == 6", "-1 < 0"]
)
def test_holds(fact: str) -> None:
    assert checked(f"CELL EQU 20B0H\n;! {fact} -- somebody\n") == (1, [])


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("CELL == NEXT -- READY takes both", ["CELL == NEXT", "READY takes both"]),
        ("CELL & 0FH == 1 -- X", ["CELL & 0FH == 1", "X"]),
        ("OTHER == 1 -- X", ["no OTHER"]),
        ("CELL == -- X", ["CELL ==", "expression"]),
        ("CELL.x == 1 -- X", ["CELL.x == 1", "expression"]),
        ("CELL == NEXT-1", ["CELL == NEXT-1", "no fact"]),
    ],
)
def test_refused(line: str, told: list[str]) -> None:
    count, wrong = checked(f"\n;! {line}\n")
    assert count == 1
    assert each_says(wrong, ("some.asm: ", *told))
