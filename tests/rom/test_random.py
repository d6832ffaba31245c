"""Random programs, firmware against reference: tape byte for byte, paper to 7 digits, errors and their lines.

Another seed: SKG_SEED=number, more of it: SKG_BLOCKS=number. A failure prints the program; put into
tests/rom/regressions/NAME.skg it is run for ever; lines there that begin with `? ` are the operator's answers.
What is set aside, and why it may be: compare.py.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest
from compare import Verdict, compare, difference
from parts import arithmetic, givens, numbered, part, session
from romhelp import Board

from skg.ref import run as reference

SEED = os.environ.get("SKG_SEED", "1983")
REGRESSIONS = sorted((Path(__file__).parent / "regressions").glob("*.skg"))

#: pytest's record_property.
Record = Callable[[str, object], None]

#: The work is cut into shares, so that several test processes can take them.
SHARES = range(4)
BLOCKS_A_SHARE = int(os.environ.get("SKG_BLOCKS", "2600")) // len(SHARES)
PRINTS_A_SHARE = 75
#: Of all programs, so many may be close calls.
MOST_ASIDE = 0.02


def check(verdict: Verdict, program: str) -> None:
    """Fail with the program when firmware and reference differ."""
    assert not verdict.difference, f"{verdict.difference}\n\n{program}"


def tally(record: Record, what: str, count: int, programs: int, aside: list[str]) -> None:
    """Hand the counts to the summary (conftest.py); too many close calls fail."""
    record("compared", (what, count, programs, len(aside)))
    assert len(aside) <= max(2, MOST_ASIDE * programs), aside


@pytest.mark.parametrize("share", SHARES)
def test_parts(share: int, record_property: Record) -> None:
    rng = Random(f"{SEED} parts {share}")
    blocks = programs = 0
    aside = []
    while blocks < BLOCKS_A_SHARE:
        program, answers = session(rng)
        verdict = compare(program, answers)
        check(verdict, program + "".join(f"? {answer}\n" for answer in answers))
        programs += 1
        blocks += verdict.blocks
        if verdict.aside:
            aside.append(verdict.aside)
    tally(record_property, "blocks", blocks, programs, aside)


@pytest.mark.parametrize("share", SHARES)
def test_expressions(share: int, record_property: Record) -> None:
    rng = Random(f"{SEED} expressions {share}")
    aside = []
    for _ in range(PRINTS_A_SHARE):
        program = numbered(givens(rng) + arithmetic(rng))
        verdict = compare(program)
        check(verdict, program)
        if verdict.aside:
            aside.append(verdict.aside)
    tally(record_property, "expressions", PRINTS_A_SHARE - len(aside), PRINTS_A_SHARE, aside)


def test_one_board_after_another_program() -> None:
    """A program's state, errors too, does not affect the next program."""
    rng = Random(f"{SEED} same board")
    board = Board()
    for _ in range(40):
        program = part(rng)
        if compare(program).aside:
            continue
        board.type("NEW")
        assert not difference(board.outcome(program), reference(program)), program


@pytest.mark.parametrize("path", REGRESSIONS, ids=lambda path: path.stem)
def test_regression(path: Path) -> None:
    lines = path.read_text().splitlines()
    program = "\n".join([line for line in lines if not line.startswith("?")] + [""])
    verdict = compare(program, tuple(line[2:] for line in lines if line.startswith("?")))
    check(verdict, program)
    assert not verdict.aside, verdict.aside
