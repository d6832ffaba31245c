"""Other people's controls judge the ISO tapes: LinuxCNC's interpreter takes them, and its moves are ours."""

from __future__ import annotations

import os
from pathlib import Path
from random import Random

import pytest
from isohelp import moves
from millparts import mill_session
from rs274help import Refused, calls, needs_rs274, same
from rs274help import moves as their_moves

from skg.ref import mill

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.skg"))
SEED = os.environ.get("SKG_SEED", "1983")
PROGRAMS = int(os.environ.get("SKG_PROGRAMS", "60"))

pytestmark = needs_rs274


def judged(tape: bytes, folder: Path) -> int:
    """Compare what they make of a tape with what it says; how many moves that are."""
    ours = moves(tape)
    same(ours, their_moves(tape, folder))
    return len(ours)


@pytest.mark.parametrize("path", EXAMPLES[::5], ids=lambda path: path.stem)
def test_wire_examples(path: Path, tmp_path: Path) -> None:
    result = mill.run(f"1 F 250,80\n2 Z -2.5,4\n{path.read_text()}")
    assert result.error is None
    assert judged(result.tape, tmp_path) > 2


def test_random_programs(tmp_path: Path) -> None:
    """A tape that an error broke off gets the end that it has not."""
    rng = Random(f"{SEED} controls")
    whole = total = 0
    for _ in range(PROGRAMS):
        program, answers = mill_session(rng)
        result = mill.run(program, answers)
        if not result.tape:
            continue
        tape = result.tape
        if result.error is None:
            whole += 1
        else:
            tape += b"N%dM30\r\n" % (tape.count(b"N") + 1)
        try:
            total += judged(tape, tmp_path)
        except (Refused, AssertionError) as wrong:
            pytest.fail(f"{wrong}\n\n{program}\n{result.tape.decode()}")
    assert whole > PROGRAMS / 3
    assert total > 8 * PROGRAMS


def test_flat_arcs_are_no_circles(tmp_path: Path) -> None:
    """The trap: as an arc, two micrometres of a circle of several metres are the whole circle to them. (Up to one, the
    board refuses it: it is a circle between two equal points.)"""
    parts = [f"CUT ({r},0),O:{r},(0,{r})" for r in (1, 1000, 9000, 40000)]
    parts += [
        f"CUT ({r},0),O:{r},({r}*COS {a},{r}*SIN {a}),(0,0)"
        for r, a in ((1000, "1E-4"), (4000, "2E-5"), (9000, "1E-5"), (60000, "2E-6"), (60000, "3E-3"))
    ]
    for part in parts:
        result = mill.run(f"10 F 60\n20 {part}")
        assert result.error is None, part
        judged(result.tape, tmp_path)
        for name, words in calls(result.tape, tmp_path):
            if name == "ARC_FEED":
                assert words[4] == "1"


def test_a_fault_is_seen(tmp_path: Path) -> None:
    """Faults that the tapes avoid are refused, or change the result."""
    tape = b"N1G17G21G90G94\nN2G0X0Y0\nN3G1X10Y0F60\nN4G3X0Y10I-10J0\nN5M30\n"
    assert judged(tape.replace(b"\n", b"\r\n"), tmp_path) == 3
    for good, bad in ((b"F60", b""), (b"X0Y10", b"X0Y10.2"), (b"N5M30\n", b""), (b"N2G0", b"N2G123")):
        with pytest.raises(Refused):
            their_moves(tape.replace(good, bad), tmp_path)
    with pytest.raises(AssertionError):
        same(moves(tape.replace(b"\n", b"\r\n")), their_moves(tape.replace(b"I-10J0", b"I-10.001J0"), tmp_path))
