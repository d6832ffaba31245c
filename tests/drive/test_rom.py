"""The ROM that drives the machine itself, against `skg sim --steps` and a plain controller."""

from __future__ import annotations

import os
import random
import re
from itertools import pairwise
from pathlib import Path

import pytest
from follower import CUTTING, follow, random_tape
from oneblock import run_block

import skg
from skg.tape.controller import drive_steps
from skg.tape.text import read

ROOT = Path(__file__).resolve().parents[2]
ROM = Path(os.environ.get("SKG_DRIVE_ROM", ROOT / "roms" / "skg-drive.bin"))
EXAMPLES = sorted((ROOT / "examples").glob("*.3b"))
PARTS = [part for part in sorted((ROOT / "examples").glob("*.skg")) if "fit-tol" not in part.name]
CTRL_C = 3
#: Limits of drive.md, in cycles.
STEP_LIMIT = 302
#: What a gap takes whose block has been read ahead; 650 of it where an arc ends on an axis.
GAP_LIMIT = 2100
#: An example's longest route takes a minute of the board's time; what needs more hangs.
PATIENCE = 2_000_000_000


class Driver(skg.Board):
    """A board with the driving ROM, and an operator who presses a key at each D: how often, `pressed` counts."""

    def __init__(self) -> None:
        super().__init__(ROM.read_bytes())
        self.pressed = 0
        self.clear()

    def begin(self, tape: str, cycles: int) -> None:
        """DRIVE with that tape in the reader, for so many cycles or until its end."""
        self.machine.take_tape()
        self.machine.tape(tape)
        self.machine.type("DRIVE\r")
        self.machine.run(cycles)

    def stop(self) -> str:
        """ctrl-C, and up to the prompt. Returns what was printed."""
        start = self.machine.printed
        self.machine.press(CTRL_C)
        assert self.machine.run(PATIENCE) == "prompt"
        return self.machine.paper_from(start)

    def go(self, line: str, tape: str | None = None, keys: str = "") -> str:
        """Type a line, with that tape in the reader; a key of `keys` at each D, then CR. Returns what was printed."""
        if tape is not None:
            self.machine.take_tape()
            self.machine.tape(tape)
        start, keys = self.machine.printed, list(keys)
        self.machine.type(line + "\r")
        self.pressed = 0
        while (reason := self.machine.run(PATIENCE)) == "wait":
            assert not self.machine.drive & CUTTING, "nobody cuts while the wire is threaded"
            self.machine.type(keys.pop(0) if keys else "\r")
            self.pressed += 1
            assert self.pressed < 200, self.machine.paper_from(start)[-200:]
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
            cycles, steps, first = (
                cycles + at[last] - at[first],
                steps + last - first,
                last + 1,
            )
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
    for block in (
        "B99999999B99999998B9GXL3",
        "B70000000B70000000B9GYNR2",
        "B99999999B1B9GXSR4",
        "B1B99999999B9GXNR4",
    ):
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
    for off in ("DRIVE 0", "reset", "NEW"):
        board.go("DRIVE 1")
        board.go("RUN")
        if off == "reset":
            board.machine.reset()
        board.go("" if off == "reset" else off)
        if off != "DRIVE 0":  # (the image keeps no program through a reset)
            board.load(program)
        board.clear()
        board.go("RUN")
        assert (board.tape, board.steps) == (silent, b""), off


@pytest.mark.parametrize("path", PARTS, ids=lambda path: path.stem)
def test_run_drives(path: Path) -> None:
    """DRIVE 1, then RUN: the steps of the example's tape, as `skg sim --steps` has them."""
    source = path.read_text()
    if "INPUT" in source:
        pytest.skip("asks for numbers")
    board = Driver()
    board.load(source)
    board.go("DRIVE 1")
    board.clear()
    assert "ERR" not in board.go("RUN")
    assert board.steps == b"".join(drive_steps(read(str(path.with_suffix(".3b")))))


def test_a_run_forgets_what_was_left(board: Driver) -> None:
    """A block that was stopped, half a line that was read, the wire off at a D: a new RUN begins anew."""
    program = "10 FROM (0,0)\n20 CUT (1,0),(1,1)\n"
    board.load(program)
    board.go("RUN")
    wanted = follow(board.tape.decode())
    board.go("DRIVE 1")
    for left in ("B900B0B900GXL1\r\nB1B2", "B9B0B9GXL1\r\nB1B2", "B9B0B9GXL1\r\nD\r\n"):
        board.begin(left, 300_000)
        board.stop()
        board.clear()
        board.go("RUN")
        assert board.steps == wanted, left


def test_what_runs_behind_a_break_cuts(board: Driver) -> None:
    """ctrl-C at the D before a move: a direct GOTO begins with bit 7 on, cuts so, and moves with it off."""
    machine = board.machine
    board.load("10 FROM (0,0)\n20 CUT (0,0),(1,0)\n30 FROM (3,3)\n40 CUT (3,3),(4,3)\n50 FROM (3,3)\n60 END\n")
    board.go("DRIVE 1")
    machine.type("RUN\r")
    assert machine.run(20_000_000, patience=8_000_000) == "wait"
    assert "ERR 10 LINE 30" in board.stop()
    board.clear()
    board.go("GOTO 40", keys="  ")
    assert board.steps and board.steps == follow(board.tape.decode())


def test_a_stop_in_a_run(board: Driver) -> None:
    """DRIVE does the rest of the block that a run was stopped in, cutting as it did, then reads the reader."""
    machine = board.machine
    board.load("10 FROM (0,0)\n20 CUT (9,0),(9,9)\n30 END\n")
    board.go("DRIVE 1")
    machine.stop_at(5000)
    board.clear()
    assert "D\r\nERR 10 LINE 20\r\n" in board.go("RUN")
    machine.type("DRIVE\r")
    assert machine.run() == "wait"
    machine.type(" ")
    assert machine.run(10_000_000, patience=8_000_000) != "prompt"
    assert board.steps == bytes((0x81,)) * 9000
    board.stop()


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
            assert "ERR 10" in board.stop()
            assert board.steps == way[: len(board.steps)]
            stopped += len(board.steps) > 0
        board.go("DRIVE" if reason == "cycles" else "")
        assert board.steps == way, wait
    assert stopped > 10


@pytest.mark.parametrize("end", ["\r\n", "\n", "\r"])
@pytest.mark.parametrize("ahead", ["B0B30B30GYL2 D B20B0B20GXL3 B5B0B5GXL1", "D B20B0B20GXL3 D B5B0B5GXL1", ""])
def test_a_stop_with_a_line_read_ahead(board: Driver, ahead: str, end: str) -> None:
    """A block, D or DD read ahead is carried out after the stop, with every line end; after a second stop too."""
    tape = end.join(["B9000B4000B9000GXL1", *ahead.split(), "DD", ""])
    way = follow(tape)
    stopped = []
    for wait in range(2_000_000, 3_600_000, 500_000):
        board.clear()
        board.begin(tape, wait)
        for _ in range(2):
            assert board.stop().endswith("ERR 10\r\n>")
            assert board.steps == way[: len(board.steps)]
            stopped.append(len(board.steps))
            board.machine.type("DRIVE\r")
            board.machine.run(50_000)
        board.stop()
        board.go("DRIVE")
        assert board.steps == way, (wait, end)
        if stopped[-1] < 13_000:
            assert board.pressed == 1 + ahead.split().count("D"), "the key after the stop, and one at each D"
        assert board.go("DRIVE", "X" + end).endswith("ERR 10\r\n>"), "a new tape begins"
        assert "ERR" not in board.go("DRIVE", "DD" + end), "behind an error too"
    assert min(stopped) < 8000
    assert sum(7000 < steps < 13_000 for steps in stopped) > 5, "while the block goes on behind which it was read"


def test_half_a_line(board: Driver) -> None:
    """The reader has stopped within a line, with a block in hand or none: ctrl-C, and DRIVE goes on within it."""
    for tape in ("B9B5B9GXL1\r\nB7B3B7GXL2\r\nDD\r\n", "B30B40B90GXNR1\r\nDD\r\n"):
        for at in range(1, len(tape) - 4):
            board.clear()
            board.begin(tape[:at], 500_000)
            assert "ERR 10" in board.stop()
            board.machine.tape(tape[at:])
            board.go("DRIVE")
            assert board.steps == follow(tape), tape[:at]


@pytest.mark.parametrize(
    "line",
    ["HELLO", "B1B2", "B1B2B3", "B1B2B2GZL1", "B1B2B2GXQ1", "B1B2B2GXL", "B1B2B2GXL5", "B1B2B2GXL0", "B1B2B2GXN1",
     "B1B2B2GXL12", "X1Y2", "B1C2B2GXL1", "1 B1B2B2GYL1", "DX", "G0X1Y1", "B" + "0" * 130, "BB1B1GXL1", "B1B1GXL1",
     "B1B1B1B1GXL1", "B1.5B1B1GXL1", "B1 B1B1GXL1", "B-1B1B1GXL1", "B1B1B1GXNL1", "B1B1B1GXOR1", "B1B1B1GXL1X",
     "B1E2B1B1GXL1", "b1b1b1gxl1", "B1B1B1L1", "B0B5B5GYNR1", "D1", "DB1B2B2GYL1", "B1B2B2GXS1", "B1B2B2GXPR1",
     "BBB2GXL1", "B1B2BGXL1", "B100663296B0B3GXL1", "B0B100663296B3GYL1", "B3B0B201326592GXL1",
     "B1B0B1" + "0" * 20, "B1B1B4294967297GXL1"],
)  # fmt: skip
def test_what_is_no_block_is_an_error(board: Driver, line: str) -> None:
    """ERR 10; what stands before it is done, what stands behind it is not; the machine stands."""
    good = "B500B300B500GXL1\r\n"
    paper = board.go("DRIVE", good + line + "\r\n" + good + "DD\r\n")
    assert "ERR 10" in paper, paper
    assert board.steps == follow(good), "what was read ahead counts when the block in hand is done"
    board.clear()
    assert "ERR" not in board.go("DRIVE", good + "DD\r\n")
    assert board.steps == follow(good), "the next tape is cut from its start"


def test_large_lines() -> None:
    """Eight digits, zeros in front, blanks, no line feed: all one tape."""
    for tape in (
        "B99999999B0B3GXL1\nDD\n",
        "  B000000000099999999B0B003GXL1 \r\rDD",
        "\0\0B99999999B0\0B3GXL1\r\nDD\r",
    ):
        board = Driver()
        assert "ERR" not in board.go("DRIVE", tape)
        assert board.steps == b"\x81" * 3, tape


def test_small_circles(board: Driver) -> None:
    """From 2 to 5 um, from each end of each axis, around and beyond."""
    lines = [
        f"B{x}B{y}B{j}G{axis}{kind}{quadrant}"
        for radius in range(2, 6)
        for j in (1, radius, 2 * radius, 4 * radius)
        for axis in "XY"
        for kind, firsts in (("NR", "1234"), ("SR", "4123"))
        for (x, y), quadrant in zip(((radius, 0), (0, radius), (radius, 0), (0, radius)), firsts, strict=True)
    ]
    tape = "\r\n".join([*lines, "DD", ""])
    assert len(lines) == 256
    assert "ERR" not in board.go("DRIVE", tape)
    assert board.steps == follow(tape)


def test_a_circle_around_nothing(board: Driver) -> None:
    """A radius of 1 um from an axis leads through the centre, where no quadrant comes next: error 10, not a way out."""
    assert board.go("DRIVE", "B0B1B3GYSR3\r\n").endswith("ERR 10\r\n>")
    assert len(board.steps) == 1


def test_stops_and_cutting(board: Driver) -> None:
    """Bit 7 turns over at each D; a break at a D goes on there; a new tape cuts from its start."""
    machine = board.machine
    board.begin(
        "B3B0B3GXL1\r\nD\r\nB2B0B2GXL1\r\nD\r\nB1B0B1GXL1\r\nD\r\nDD\r\nB1B0B1GXL3\r\nDD\r\n",
        PATIENCE,
    )
    assert (board.steps, machine.drive) == (b"\x81\x81\x81", 0)
    board.stop()
    board.go("DRIVE")
    assert board.pressed == 2
    assert board.steps == b"\x81\x81\x81\x01\x01\x81"
    board.go("DRIVE")
    assert board.pressed == 0
    assert board.steps[6:] == b"\x8b"


@pytest.mark.parametrize("stops", [1, 2, 99, 150])
def test_many_stops(board: Driver, stops: int) -> None:
    """However many there are, each turns bit 7 over."""
    tape = "B1B0B1GXL1\r\n" + "D\r\n" * stops + "B0B1B1GYL2\r\nDD\r\n"
    board.go("DRIVE", tape)
    assert board.pressed == stops
    assert board.steps == follow(tape)


def test_empty_reader(board: Driver) -> None:
    """DRIVE waits for a tape until ctrl-C."""
    board.machine.type("DRIVE\r")
    assert board.machine.run(50_000_000) == "cycles"
    assert board.stop().endswith("ERR 10\r\n>")


def test_no_clock_edge_is_missed(board: Driver) -> None:
    """At 10 mm/min each edge of the feed clock makes a step, between blocks too, be they of two steps only."""
    hz = 10_000 / 60
    lines = random_tape(5, 40, 90).split()[:-1]
    tape = "\r\n".join(
        [
            *(line for line in lines if line[0] == "B" and len(follow(line)) > 1),
            "DD",
            "",
        ]
    )
    assert tape.count("G") > 20
    board.machine.feed(hz)
    board.go("DRIVE", tape)
    assert board.steps == follow(tape)
    edges = [round(cycles * hz / 2_000_000 - 0.5) for cycles in board.machine.step_cycles]
    assert [after - before for before, after in pairwise(edges)] == [1] * (len(edges) - 1)


def test_between_two_blocks(board: Driver) -> None:
    """The block read ahead is ready when the present one ends."""
    tape = "B9000B4000B9000GXL1\r\nB3000B4000B9000GXNR1\r\n" * 4 + "DD\r\n"
    board.go("DRIVE", tape)
    at, first, ends = board.machine.step_cycles, 0, []
    for line in tape.split()[:-1]:
        first += len(follow(line))
        ends.append(first)
    assert max(at[end] - at[end - 1] for end in ends[:-1]) <= GAP_LIMIT


def test_a_clock_that_stands(board: Driver) -> None:
    """It lets ctrl-C and bit 1 through, low or high."""
    for high in (False, True):
        board = Driver()
        board.machine.feed(0.1)  # low for 5 s, then high
        board.begin("B100B0B100GXL1\r\nDD\r\n", 12_000_000 if high else 2_000_000)
        assert len(board.steps) == high
        assert "ERR 10" in board.stop()
        assert len(board.steps) == high


def test_feed_clock_paces_the_steps(board: Driver) -> None:
    """One step for each edge, none left out within a block, however fast the blocks come."""
    board.machine.feed(500)
    tape = "B40B30B40GXL1\r\nB30B40B85GXNR1\r\nDD\r\n"
    board.go("DRIVE", tape)
    assert board.steps == follow(tape)
    # The clock rises in the middle of each 4000 cycles; the board looks a little later.
    edges = [(cycles - 1000) // 4000 for cycles in board.machine.step_cycles]
    assert [after - before for before, after in pairwise(edges)] == [1] * (len(edges) - 1)


def test_only_a_command(board: Driver) -> None:
    """DRIVE goes into no program, and takes 0, 1 or nothing; this image has no TOL."""
    paper = "".join(board.go(line) for line in ("DRIVE 2", "10 DRIVE", "DRIVE X", "TOL .1"))
    assert re.findall(r"ERR \d\d", paper) == ["ERR 05", "ERR 01", "ERR 01", "ERR 01"]


def test_the_manuals_session(board: Driver) -> None:
    """The manual's session with this image is true: the lines with a prompt are typed."""
    sessions = re.findall(r"^```drive\n(.*?)^```$", (ROOT / "docs" / "manual.md").read_text(), re.M | re.S)
    assert len(sessions) == 1
    paper = "".join(board.go(line) for line in re.findall(r"^>(.*)\n", sessions[0], re.M))
    assert ">" + paper.replace("\r\n", "\n") == sessions[0] + ">"
    assert len(board.steps) == 800 + 400 + 800 + 400
