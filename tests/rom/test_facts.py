"""The facts that the sources state and rely on: the build reads them, and refuses one that does not hold."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from romhelp import ROM, ROOT

from skg.machine import symbols

sys.path.insert(0, str(ROOT / "asm"))
import facts

SOURCES = sorted((ROOT / "asm").glob("*.asm"))
NAMES = {"CELL": 0x20B0, "NEXT": 0x20B1, "PAGE": 0x2300}


def checked(tmp_path: Path, text: str) -> tuple[int, list[str]]:
    """What the checker says of a source of its own."""
    source = tmp_path / "some.asm"
    source.write_text(text)
    return facts.check([source], NAMES)


def test_the_sources_state_facts_and_they_hold() -> None:
    count, wrong = facts.check(SOURCES, symbols(ROM.with_suffix(".sym").read_text()))
    assert count >= 25
    assert wrong == []


@pytest.mark.parametrize(
    "fact", ["NEXT == CELL+1", "PAGE & 0FFH == 0 and CELL/100H == 20H", "PAGE-CELL < 1000", "2*3 == 6", "-1 < 0"]
)
def test_holds(tmp_path: Path, fact: str) -> None:
    assert checked(tmp_path, f"CELL EQU 20B0H\n;! {fact} -- somebody\n") == (1, [])


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("CELL == NEXT -- READY takes both", "some.asm: CELL == NEXT does not hold: READY takes both"),
        ("CELL & 0FH == 1 -- X", "does not hold: X"),
        ("OTHER == 1 -- X", "there is no OTHER"),
        ("CELL == -- X", "no expression"),
        ("CELL.x == 1 -- X", "no expression"),
        ("CELL == NEXT-1", "no fact"),
    ],
)
def test_refused(tmp_path: Path, line: str, said: str) -> None:
    count, wrong = checked(tmp_path, f"\n;! {line}\n")
    assert count == 1
    assert len(wrong) == 1 and said in wrong[0]
