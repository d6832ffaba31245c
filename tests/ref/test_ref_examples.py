"""The parts in examples/: committed tapes, and what they must have in common."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest
from refhelp import move

from skg.ref import Result, run
from skg.ref.parser import parse_line
from skg.ref.statements import Assign, Cut, From, Goto, If, Print, Simple
from skg.ref.tape import grid

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.skg"))
#: Not closed, or closed without a way back.
OPEN = {"cad-tape", "skg04-polar"}
CORE = (Assign, From, Cut, Goto, If, Print, Simple)

#: An example's tests stay in one process, which runs it once.
examples, closed = (
    pytest.mark.parametrize(
        "path",
        [pytest.param(part, id=part.stem, marks=pytest.mark.xdist_group(f"ref {part.stem}")) for part in parts],
    )
    for parts in (EXAMPLES, [part for part in EXAMPLES if part.stem not in OPEN])
)


@cache
def result_of(path: Path) -> Result:
    """What the reference makes of an example."""
    return run(path.read_text())


def is_core(path: Path) -> bool:
    return "(core)" in path.read_text().splitlines()[0]


@examples
def test_tape_is_the_committed_one(path: Path) -> None:
    result = result_of(path)
    assert result.error is None, result.paper
    assert result.tape == path.with_suffix(".3b").read_bytes()


@examples
def test_is_well_conditioned(path: Path) -> None:
    """No example hangs on less than a nanometre nor on another close call: the firmware's floats will do."""
    assert [call for call in result_of(path).near if call.margin < 1e-3] == []
    assert run(path.read_text(), bits=33).tape == path.with_suffix(".3b").read_bytes()


@examples
def test_says_what_it_is(path: Path) -> None:
    lines = path.read_text().splitlines()
    assert lines[0].startswith("10 REM ")
    assert len(lines) <= 40
    statements = [parse_line(line).statement for line in lines]
    words = {s.word for s in statements if isinstance(s, Simple)}
    core = all(isinstance(s, CORE) for s in statements) and words <= {
        "BACK",
        "END",
        "REM",
    }
    assert is_core(path) == core


@closed
def test_closed_part_sums_to_zero(path: Path) -> None:
    """Between the stops the wire comes back to where it was, by the blocks alone and in true coordinates."""
    parts = path.with_suffix(".3b").read_bytes().decode().split("D\r\n")[::2]
    for part in parts:
        moves = [move(block) for block in part.split() if block != "DD"]
        # The end's second coordinate is only known to a micrometre or so for arcs.
        slack = 2 * part.count("R")
        assert abs(sum(x for x, _ in moves)) <= slack
        assert abs(sum(y for _, y in moves)) <= slack
    place = None
    for s in result_of(path).path:
        if s.role == "entry":
            place = grid(s.start)
        if s.role == "return":
            assert grid(s.end) == place


def test_there_are_enough() -> None:
    assert len(EXAMPLES) >= 24
    assert sum(is_core(path) for path in EXAMPLES) >= 20


def test_loop_and_rep_make_the_same_wheel() -> None:
    folder = EXAMPLES[0].parent
    assert (folder / "xy-fig1-loop.3b").read_bytes() == (folder / "xy-fig1-rep.3b").read_bytes()
