"""roms/skg-drive.bin where it is close: small circles, stops in a run, refused numbers, a clock that stands."""

from __future__ import annotations

import functools
import re
from pathlib import Path

import pytest
from follower import CUTTING, follow

from skg.machine import Machine
from skg.tape.drive import drive_steps
from skg.tape.text import read

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.skg"))
PLENTY = 10**12


@functools.cache
def rom() -> bytes:
    return (ROOT / "roms" / "skg-drive.bin").read_bytes()


def at_prompt() -> Machine:
    """The board, switched on."""
    machine = Machine(rom())
    assert machine.run() == "prompt"
    machine.clear()
    return machine


def pressed(machine: Machine) -> int:
    """Run up to the prompt, a key at each wait: how many keys. Bit 7 is off while the board waits."""
    keys = 0
    while machine.run(PLENTY) == "wait":
        assert machine.drive == 0
        machine.type(" ")
        keys += 1
    assert machine.drive == 0
    return keys


def driven(tape: str) -> Machine:
    """The board after a tape that it could follow to its end."""
    machine = at_prompt()
    machine.tape(tape)
    machine.type("DRIVE\r")
    pressed(machine)
    assert machine.tty.endswith("DD\r\n>") and "ERR" not in machine.tty
    return machine


def test_small_circles() -> None:
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
    assert driven(tape).steps == follow(tape)


@pytest.mark.parametrize("path", [path for path in EXAMPLES if "fit-tol" not in path.name], ids=lambda path: path.stem)
def test_run_drives(path: Path) -> None:
    """DRIVE 1, then RUN: the steps of the example's tape, as `skg sim --steps` has them."""
    source = path.read_text()
    if "INPUT" in source:
        pytest.skip("asks for numbers")
    machine = at_prompt()
    machine.tape(source.replace("\n", "\r\n") + "\x1a")
    machine.type("LOAD\r")
    machine.run(PLENTY)
    machine.type("DRIVE 1\r")
    machine.run()
    machine.clear()
    machine.type("RUN\r")
    pressed(machine)
    assert "ERR" not in machine.tty
    assert machine.steps == b"".join(drive_steps(read(str(path.with_suffix(".3b")))))


def test_run_without_drive() -> None:
    """Neither before DRIVE 1 nor after DRIVE 0 or a reset; and a run begins as one that cuts."""
    machine = at_prompt()
    machine.tape("10 FROM (0,0)\r\n20 CUT (.1,0),(.1,.1),(0,0)\r\n30 FROM (1,1)\r\n40 END\r\n\x1a")
    machine.type("LOAD\r")
    machine.run()
    for before, drives in (("", False), ("DRIVE 1\r", True), ("", True), ("DRIVE 0\r", False), ("DRIVE 1\r", True)):
        machine.type(before)
        machine.run()
        machine.clear()
        machine.type("RUN\r")
        pressed(machine)
        assert bool(machine.steps) is drives
        assert not drives or machine.steps[0] & CUTTING
    machine.reset()
    machine.run()
    machine.clear()
    machine.type("RUN\r")
    pressed(machine)
    assert machine.steps == b""
    assert "B100B0B100GXL1" in machine.tty


def test_a_stop_in_a_run() -> None:
    """DRIVE does the rest of the block that a run was stopped in, cutting as it did."""
    machine = at_prompt()
    machine.type("10 FROM (0,0)\r20 CUT (9,0),(9,9)\r30 END\rDRIVE 1\r")
    machine.run()
    machine.stop_at(5000)
    machine.type("RUN\r")
    pressed(machine)
    assert "-4000\r\nD\r\nERR 10 LINE 20\r\n" in machine.tty
    machine.type("DRIVE\r")
    assert machine.run() == "wait"
    machine.type(" ")
    assert machine.run(10_000_000, patience=8_000_000) != "prompt"  # it reads the reader now
    assert machine.steps == bytes((0x81,)) * 9000
    machine.press(3)
    assert machine.run() == "prompt"


def test_stops_and_cutting() -> None:
    """Bit 7 turns over at each D; a break at a D goes on there; a new tape cuts from its start."""
    machine = at_prompt()
    machine.tape("B3B0B3GXL1\r\nD\r\nB2B0B2GXL1\r\nD\r\nB1B0B1GXL1\r\nD\r\nDD\r\nB1B0B1GXL3\r\nDD\r\n")
    machine.type("DRIVE\r")
    assert machine.run() == "wait"
    assert machine.steps == b"\x81\x81\x81"
    machine.press(3)
    assert machine.run() == "prompt"
    machine.type("DRIVE\r")
    assert pressed(machine) == 3
    assert machine.steps == b"\x81\x81\x81\x01\x01\x81"
    machine.type("DRIVE\r")
    assert pressed(machine) == 0
    assert machine.steps[-1] == 0x8A & ~8 | 1 | 8


def test_numbers_too_long() -> None:
    """Nine digits are refused, eight not."""
    for line, error in (("B99999999B0B3GXL1", ""), ("B100000000B0B3GXL1", "ERR 06"), ("B1B0B1" + "0" * 20, "ERR 06")):
        machine = at_prompt()
        machine.tape(line + "\r\nDD\r\n")
        machine.type("DRIVE\r")
        pressed(machine)
        assert error in machine.tty
        assert len(machine.steps) == (0 if error else 3)


def test_a_circle_around_nothing() -> None:
    """A radius of 1 um from an axis leads through the centre, where no quadrant comes next: error 10, not a way out."""
    machine = at_prompt()
    machine.tape("B0B1B3GYSR3\r\n")
    machine.type("DRIVE\r")
    assert machine.run() == "prompt"
    assert machine.tty.endswith("ERR 10\r\n>")
    assert (len(machine.steps), machine.drive) == (1, 0)


def test_empty_reader() -> None:
    """DRIVE waits for a tape until ctrl-C."""
    machine = at_prompt()
    machine.type("DRIVE\r")
    assert machine.run(50_000_000) == "cycles"
    machine.press(3)
    assert machine.run() == "prompt"
    assert machine.tty.endswith("ERR 10\r\n>")


def test_feed_clock() -> None:
    """One step for each rising edge; a clock that stays where it is lets ctrl-C and bit 1 through."""
    machine = at_prompt()
    machine.feed(500)
    machine.tape("B1000B300B1000GXL1\r\nDD\r\n")
    machine.type("DRIVE\r")
    pressed(machine)
    times = machine.step_cycles
    gaps = [b - a for a, b in zip(times, times[1:], strict=False)]
    assert len(gaps) == 1299
    assert all(abs(gap - 4000) < 400 for gap in gaps)
    for high in (False, True):
        machine = at_prompt()
        machine.feed(0.1)  # low for 5 s, then high
        machine.tape("B100B0B100GXL1\r\nDD\r\n")
        machine.type("DRIVE\r")
        machine.run(12_000_000 if high else 2_000_000)
        assert len(machine.steps) == high
        machine.press(3)
        assert machine.run(1_000_000) == "prompt"
        assert len(machine.steps) == high


def test_only_a_command() -> None:
    """DRIVE goes into no program, and takes 0, 1 or nothing; this image has no TOL."""
    machine = at_prompt()
    machine.type("DRIVE 2\r10 DRIVE\rDRIVE X\rTOL .1\r")
    machine.run()
    assert re.findall(r"ERR \d\d", machine.tty) == ["ERR 05", "ERR 01", "ERR 01", "ERR 01"]


def test_the_manuals_session() -> None:
    """What the manual shows of this image is what happens: the lines with a prompt are typed."""
    sessions = re.findall(r"^```drive\n(.*?)^```$", (ROOT / "docs" / "manual.md").read_text(), re.M | re.S)
    assert len(sessions) == 1
    machine = at_prompt()
    for line in re.findall(r"^>(.*)\n", sessions[0], re.M):
        machine.type(line + "\r")
        pressed(machine)
    assert ">" + machine.tty.replace("\r\n", "\n") == sessions[0] + ">"
    assert len(machine.steps) == 800 + 400 + 800 + 400
