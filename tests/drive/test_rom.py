"""The ROM that drives the machine itself, against `skg sim --steps` and a plain controller."""

from __future__ import annotations

import os
import random
import re
from itertools import pairwise
from pathlib import Path

import pytest
from follower import CUTTING, follow, random_tape

import skg
from skg.tape.controller import run_block
from skg.tape.drive import drive_steps
from skg.tape.text import read

ROOT = Path(__file__).resolve().parents[2]
ROM = Path(os.environ.get("SKG_DRIVE_ROM", ROOT / "roms" / "skg-drive.bin"))
EXAMPLES = sorted((ROOT / "examples").glob("*.3b"))
CTRL_C = 3
#: Limits of drive.md, in cycles.
STEP_LIMIT = 300
#: An example's longest route takes a minute of the board's time; what needs more hangs.
PATIENCE = 2_000_000_000


class Driver(skg.Board):
    """A board with the driving ROM, and an operator who presses a key at each D."""

    def __init__(self) -> None:
        super().__init__(ROM.read_bytes())
        self.clear()

    def go(self, line: str, tape: str | None = None, keys: str = "") -> str:
        """Type a line, with that tape in the reader; a key of `keys` at each D, then CR. Returns what was printed."""
        if tape is not None:
            self.machine.take_tape()
            self.machine.tape(tape)
        start, keys = self.machine.printed, list(keys)
        self.machine.type(line + "\r")
        pressed = 0
        while (reason := self.machine.run(PATIENCE)) == "wait":
            assert not self.machine.drive & CUTTING, "nobody cuts while the wire is threaded"
            self.machine.type(keys.pop(0) if keys else "\r")
            pressed += 1
            assert pressed < 100, self.machine.paper_from(start)[-200:]
        assert reason == "prompt", (reason, self.machine.paper_from(start)[-200:])
        assert self.machine.drive == 0, "nothing cuts, no pulse is up"
        return self.machine.paper_from(start)


@pytest.fixture
def board() -> Driver:
    """At its first prompt."""
    return Driver()


def test_examples() -> None:
    """Each tape of the examples, to its end: the steps of `skg sim --steps`, byte for byte, each direction before its
    pulse; the cycles of a step."""
    board, cycles, steps = Driver(), 0, 0
    assert len(EXAMPLES) > 60
    for path in EXAMPLES:
        tape = read(str(path))
        board.clear()
        paper = board.go("DRIVE", path.read_text(encoding="ascii"))
        assert board.steps == b"".join(drive_steps(tape)), path.stem
        assert "ERR" not in paper
        at, first = board.machine.step_cycles, 0
        for block in tape.blocks:
            last = first + run_block(block).steps - 1
            cycles, steps, first = cycles + at[last] - at[first], steps + last - first, last + 1
    assert board.machine.hasty_steps == 0
    assert cycles / steps <= STEP_LIMIT


def test_random_tapes(board: Driver) -> None:
    """Every kind, quadrant and axis, sound or not, small numbers and large, stops among them."""
    for seed in range(150):
        tape = random_tape(seed)
        board.clear()
        board.go("DRIVE", tape)
        assert board.steps == follow(tape), tape


def test_blocks_are_typed_as_they_begin(board: Driver) -> None:
    """The paper has the tape's lines, in their order."""
    tape = random_tape(7)
    assert board.go("DRIVE", tape) == "DRIVE\r\n" + tape + ">"


def test_large_numbers(board: Driver) -> None:
    """Eight digits: the first and the last steps of what 32 bits just hold."""
    for block in ("B99999999B99999998B9GXL3", "B70000000B70000000B9GYNR2", "B99999999B1B9GXSR4", "B1B99999999B9GXNR4"):
        board.clear()
        board.go("DRIVE", block + "\r\nDD\r\n")
        assert board.steps == follow(block), block


def test_run_follows_what_it_punches(board: Driver) -> None:
    """After DRIVE 1, and after DRIVE 0 or a reset no more; the tape is the same."""
    program = "10 FROM (2,2)\n20 CUT (0,0),(1,0),(1,1)\n30 FROM (3,3)\n40 CUT (0,0):1\n50 BACK\n"
    board.load(program)
    board.go("RUN")
    silent = board.tape
    assert silent and not board.steps
    board.clear()
    board.go("DRIVE 1")
    board.go("RUN")
    assert board.tape == silent
    assert board.steps == follow(silent.decode())
    for off in ("DRIVE 0", "reset"):
        board.go("DRIVE 1")
        if off == "reset":
            board.machine.reset()
        board.go("DRIVE 0" if off == "DRIVE 0" else "")
        board.clear()
        board.go("RUN")
        assert (board.tape, board.steps) == (silent, b""), off


def test_a_thousand_stops(board: Driver) -> None:
    """At any step: not one more is made, ERR 10, the place; DRIVE goes on from there: no step is lost or made twice."""
    dice, made = random.Random(1), 0
    machine = board.machine
    for number in range(1000):
        tape = random_tape(number % 40, 4, 60)
        way = follow(tape)
        at = dice.randint(1, len(way))
        board.clear()
        machine.stop_at(made + at)
        paper = board.go("DRIVE", tape)
        if board.steps != way:
            assert board.steps == way[:at], (tape, at)
            assert paper.endswith("ERR 10\r\n>"), paper
            assert re.search(r"\d+\r\nERR 10", paper), paper
            board.go("DRIVE")
        else:
            # With the last step before a D, which waits for a key anyway, or of the tape.
            assert at in {len(follow(tape[: end.start()])) for end in re.finditer("D\r", tape)}, (tape, at)
        made += len(board.steps)
        assert board.steps == way, (tape, at)


def test_a_limit_switch_that_stays(board: Driver) -> None:
    """Each DRIVE says so again, and makes no step; freed, it goes on."""
    tape = "B500B100B500GXL1\r\nDD\r\n"
    board.machine.stop_at(100, stays=True)
    assert "ERR 10" in board.go("DRIVE", tape)
    for _ in range(3):
        assert "ERR 10" in board.go("DRIVE")
        assert len(board.steps) == 100
    board.machine.stop_at(0)
    board.go("DRIVE")
    assert board.steps == follow(tape)


def test_ctrl_c_stops_between_two_steps(board: Driver) -> None:
    """As the stop line does, wherever it comes, while a block is read too: nothing of it is lost."""
    tape = random_tape(3)
    way = follow(tape)
    stopped = 0
    for wait in range(50_000, 1_000_000, 23_000):
        board.clear()
        board.machine.take_tape()
        board.machine.tape(tape)
        board.machine.type("DRIVE\r")
        reason = board.machine.run(wait)
        if reason == "cycles":
            board.machine.press(CTRL_C)
            paper = board.go("")
            assert "ERR 10" in paper, paper
            assert board.steps == way[: len(board.steps)]
            stopped += len(board.steps) > 0
        board.go("DRIVE" if reason == "cycles" else "")
        assert board.steps == way, wait
    assert stopped > 10


@pytest.mark.parametrize(
    "line",
    ["HELLO", "B1B2", "B1B2B3", "B1B2B2GZL1", "B1B2B2GXQ1", "B1B2B2GXL", "B1B2B2GXL5", "B1B2B2GXL0", "B1B2B2GXN1",
     "B1B2B2GXL12", "X1Y2", "B1C2B2GXL1", "1 B1B2B2GYL1", "DX", "G0X1Y1", "B" + "0" * 130, "BB1B1GXL1", "B1B1GXL1",
     "B1B1B1B1GXL1", "B1.5B1B1GXL1", "B1 B1B1GXL1", "B-1B1B1GXL1", "B1B1B1GXNL1", "B1B1B1GXOR1", "B1B1B1GXL1X",
     "B1E2B1B1GXL1", "b1b1b1gxl1", "B1B1B1L1", "B0B5B5GYNR1"],
)  # fmt: skip
def test_what_is_no_block_is_an_error(board: Driver, line: str) -> None:
    """ERR 10; what stands before it is done, what stands behind it is not; the machine stands."""
    good = "B5B3B5GXL1\r\n"
    paper = board.go("DRIVE", good + line + "\r\n" + good + "DD\r\n")
    assert "ERR 10" in paper, paper
    assert board.steps == follow(good)
    board.clear()
    assert "ERR" not in board.go("DRIVE", good + "DD\r\n")
    assert board.steps == follow(good), "the next tape is cut from its start"


def test_feed_clock_paces_the_steps(board: Driver) -> None:
    """One step for each edge, none left out within a block."""
    board.machine.feed(500)
    tape = "B40B30B40GXL1\r\nB30B40B85GXNR1\r\nDD\r\n"
    board.go("DRIVE", tape)
    assert board.steps == follow(tape)
    edges = [cycles // 4000 for cycles in board.machine.step_cycles]
    assert [after - before for before, after in pairwise(edges[:70])] == [1] * 69
    assert [after - before for before, after in pairwise(edges[70:])] == [1] * (len(edges) - 71)
    assert edges[70] > edges[69]
