"""The drive's port: steps, feed clock, stop line; what skg80 writes and draws of them."""

from __future__ import annotations

import random
import re
from collections.abc import Callable
from itertools import groupby
from pathlib import Path
from xml.etree import ElementTree

import pytest
from asm8080 import assemble
from emuhelp import ROM_SIZE, Skg80, complaint
from facthelp import says

from skg.board import Machine
from skg.tape.controller import drive_steps
from skg.tape.text import parse

ROMS = Path(__file__).parents[2] / "roms"
Rom = Callable[[str], Path]

X_STEP, X_MINUS, Y_STEP, Y_MINUS, CUTTING = 1, 2, 4, 8, 0x80
#: Walks along the bytes behind it: OUT with the directions, with the pulse, without it; FF ends.
WALK = """
        LXI  H,WAY
NEXT:   MOV  A,M
        CPI  0FFH
        JZ   DONE
        MOV  B,A
        ANI  8AH
        OUT  14H
        MOV  C,A
        MOV  A,B
        OUT  14H
        MOV  A,C
        OUT  14H
        INX  H
        JMP  NEXT
DONE:   HLT
WAY:"""


def machine(source: str) -> Machine:
    """A board with these instructions for a ROM."""
    return Machine(assemble(source)[0])


def walker(way: bytes) -> bytes:
    """The ROM that makes these steps and halts."""
    return (assemble(WALK)[0] + way + b"\xff").ljust(ROM_SIZE, b"\xff")


def some_way(seed: int, longest: int, shortest: int = 1) -> bytes:
    """Up to 7,000 steps of random lines and turns, cut or not, each axis by itself."""
    dice, way = random.Random(seed), bytearray()
    while len(way) < 7000:
        directions = dice.choice((0, X_MINUS, Y_MINUS, X_MINUS | Y_MINUS)) | dice.choice((0, CUTTING))
        slope = dice.random()
        for _ in range(dice.randint(shortest, longest)):
            way.append(directions | (X_STEP if dice.random() < slope else Y_STEP))
    return bytes(way[:7000])


def places(way: bytes) -> list[tuple[int, int]]:
    """The position after each step, from (0, 0)."""
    x = y = 0
    found = []
    for value in way:
        x += (value & X_STEP != 0) * (-1 if value & X_MINUS else 1)
        y += (value & Y_STEP != 0) * (-1 if value & Y_MINUS else 1)
        found.append((x, y))
    return found


def test_each_rising_step_bit_is_one_step() -> None:
    """And nothing else is: directions, a pulse that stays, bit 7; both axes in one write are one byte."""
    values = (0x00, 0x81, 0x81, 0x80, 0x82, 0x83, 0x02, 0x0A, 0x0E, 0x0F, 0x0A, 0x00, 0x05, 0x04, 0x05, 0x00, 0x70)
    m = machine("".join(f"MVI A,0{value:02X}H\nOUT 14H\n" for value in values) + "HLT")
    assert m.run() == "halt"
    assert m.steps == bytes((0x81, 0x83, 0x0E, 0x0F, 0x05, 0x05))
    assert m.hasty_steps == 0
    m.clear()
    assert (m.steps, list(m.step_cycles)) == (b"", [])


@pytest.mark.parametrize("values", [(0x03,), (0x0C,), (0x01, 0x03), (0x02, 0x01), (0x04, 0x0C)])
def test_a_direction_must_stand_before_its_pulse(values: tuple[int, ...]) -> None:
    """A step that comes with its direction, or turns under way, is counted: a motor may take it the wrong way."""
    m = machine("".join(f"MVI A,{value}\nOUT 14H\n" for value in values) + "HLT")
    m.run()
    assert m.hasty_steps == 1


def test_steps_have_their_cycles() -> None:
    """Those of the OUT that raised the pulse."""
    m = machine("MVI A,1\nOUT 14H\nXRA A\nOUT 14H\nMVI A,4\nOUT 14H\nHLT")
    m.run()
    first, second = m.step_cycles
    assert (first, second - first) == (7, 10 + 4 + 10 + 7)


def test_full_speed_clock_is_the_pulse_turned_over() -> None:
    """Low while a pulse is up, high else: each pulse makes its own rising edge. The other lines are low."""
    m = machine(
        "".join(f"MVI A,{v}\nOUT 14H\nIN 14H\nSTA {0x2000 + i}\n" for i, v in enumerate((0, 1, 4, 5, 0x8A))) + "HLT"
    )
    m.run()
    assert m.peek(0x2000, 5) == bytes((1, 0, 0, 0, 1))


# One step for each rising edge of the clock.
PACED = """
AGAIN:  IN   14H
        RRC
        JC   AGAIN
LOW:    IN   14H
        RRC
        JNC  LOW
        MVI  A,1
        OUT  14H
        XRA  A
        OUT  14H
        JMP  AGAIN
"""


@pytest.mark.parametrize("hz", [50, 1000, 7777.5])
@pytest.mark.parametrize("slice_cycles", [10**9, 12345])
def test_feed_clock(hz: float, slice_cycles: int) -> None:
    """A square wave of the processor's time: so many steps a second at 2 MHz, evenly, in whatever slices it runs."""
    m = machine(PACED)
    m.feed(hz)
    while m.cycles < 1_000_000:
        m.run(min(slice_cycles, 1_000_000 - m.cycles))
    at = list(m.step_cycles)
    assert len(at) == pytest.approx(hz / 2, abs=1)
    period, loop = 2_000_000 / hz, 60
    for number, cycles in enumerate(at):
        assert 0 <= cycles - (number + 0.5) * period <= loop


# Steps until the stop line rises; then waits for a key, and goes on.
STOPPING = """
        MVI  A,3
        OUT  10H
        MVI  A,15H
        OUT  10H
STEP:   MVI  A,1
        OUT  14H
        XRA  A
        OUT  14H
        IN   14H
        ANI  2
        JZ   STEP
KEY:    IN   10H
        RRC
        JNC  KEY
        IN   11H
        JMP  STEP
"""


def test_stop_line_rises_at_a_step_and_falls_with_the_next_key() -> None:
    """Not one step more is made; the key frees it; the count goes on."""
    m = machine(STOPPING)
    m.stop_at(1000)
    assert m.run(1_000_000) == "wait"
    assert len(m.steps) == 1000
    m.type("x")
    m.run(100_000)
    gone_on = len(m.steps)
    assert gone_on > 1500
    m.stop_at(5000)
    assert m.run(1_000_000) == "wait"
    assert len(m.steps) == 5000


def test_stop_line_that_stays() -> None:
    """A limit switch: one step for each key, until it is freed."""
    m = machine(STOPPING)
    m.stop_at(10, stays=True)
    m.type("abc")
    assert m.run(1_000_000) == "wait"
    assert len(m.steps) == 13
    m.stop_at(0)
    m.type("d")
    assert m.run(100_000) == "cycles"
    assert len(m.steps) > 1000


def test_reset_clears_the_latch() -> None:
    """Cutting is off; the next write of the same value is a step of its own."""
    m = machine("IN 14H\nMOV B,A\nMVI A,81H\nOUT 14H\nHLT")
    m.run()
    assert m.drive == 0x81
    m.reset()
    assert m.drive == 0
    m.run()
    assert m.registers["bc"] >> 8 == 1, "no pulse is up after a reset"
    assert m.steps == b"\x81\x81"


# skg80


def run_walk(skg80: Skg80, folder: Path, way: bytes, *options: str) -> None:
    """Let a board make these steps."""
    (folder / "rom.bin").write_bytes(walker(way))
    done = skg80("--rom", folder / "rom.bin", *options)
    assert says(complaint(done, 1), "halted"), done.stderr


@pytest.mark.parametrize(("seed", "longest", "shortest"), [(1, 3, 1), (2, 40, 1), (3, 2000, 1), (4, 4000, 2000)])
def test_steps_and_drawing(skg80: Skg80, tmp_path: Path, seed: int, longest: int, shortest: int) -> None:
    """--steps has every step; the drawing's lines pass near every place, with the pen as it was, and nowhere else."""
    way = some_way(seed, longest, shortest)
    run_walk(skg80, tmp_path, way, "--steps", tmp_path / "s", "--drive", tmp_path / "d.svg")
    assert (tmp_path / "s").read_bytes() == way
    lines = drawn_lines(tmp_path / "d.svg", way)
    here, low, high = (0, 0), (0, 0), (0, 0)
    following = iter(lines)
    line = next(following)
    assert line[1] == here
    for value, there in zip(way, places(way), strict=True):
        pen = pen_of(value)
        # The line it lies on: this one, or one that follows where the pen or the way changes.
        while line[0] != pen or beside(line, here) > 2.001 or beside(line, there) > 2.001:
            before, line = line, next(following)
            assert line[1] == before[2], "the path has no gaps"
        here = there
        low, high = tuple(map(min, low, here)), tuple(map(max, high, here))
    assert lines[-1][2] == here
    picture = ElementTree.parse(tmp_path / "d.svg").getroot()
    x, y, width, height = map(float, picture.get("viewBox").split())
    assert (x + width / 2, y + height / 2) == pytest.approx(
        ((low[0] + high[0]) / 2000, -(low[1] + high[1]) / 2000), abs=2e-3
    )
    assert width >= (high[0] - low[0]) / 1000
    assert picture.get("width") == f"{width:.3f}mm"


Line = tuple[str, tuple[int, int], tuple[int, int]]


def pen_of(value: int) -> str:
    """The kind of line that a step is drawn as."""
    return "cut" if value & CUTTING else "move"


def drawn_lines(path: Path, way: bytes) -> list[Line]:
    """(pen, from, to) of every line, µm, in the order of the way, whose cuts and moves take turns."""
    space = "{http://www.w3.org/2000/svg}"
    runs: dict[str, list[list[Line]]] = {"move": [], "cut": []}
    for element in ElementTree.parse(path).iter(f"{space}path"):
        pen = element.get("class")
        for start, rest in re.findall(r"M(-?\d+ -?\d+)((?:l-?\d+ -?\d+)*)", element.get("d")):
            at = tuple(map(int, start.split()))
            runs[pen].append([])
            for dx, dy in re.findall(r"l(-?\d+) (-?\d+)", rest):
                to = at[0] + int(dx), at[1] + int(dy)
                runs[pen][-1].append((pen, at, to))
                at = to
    lines = [line for pen, _ in groupby(map(pen_of, way)) for line in runs[pen].pop(0)]
    assert runs == {"move": [], "cut": []}, "nothing is drawn that was not stepped"
    return lines


def beside(line: Line, place: tuple[int, int]) -> float:
    """The distance of a place from a line between two others."""
    _, (xa, ya), (xb, yb) = line
    dx, dy, x, y = xb - xa, yb - ya, place[0] - xa, place[1] - ya
    along = max(0.0, min(1.0, (x * dx + y * dy) / (dx * dx + dy * dy))) if dx or dy else 0.0
    return ((x - along * dx) ** 2 + (y - along * dy) ** 2) ** 0.5


def test_a_long_line_is_one_line(skg80: Skg80, tmp_path: Path) -> None:
    """A drawing grows with the corners of the way, not with its steps."""
    way = bytes(CUTTING | (X_STEP if k % 3 else Y_STEP) for k in range(7000))
    run_walk(skg80, tmp_path, way, "--drive", tmp_path / "d.svg")
    assert len(drawn_lines(tmp_path / "d.svg", way)) == 1
    assert (tmp_path / "d.svg").stat().st_size < 600


def test_way_out_and_back_is_drawn_to_its_end(skg80: Skg80, tmp_path: Path) -> None:
    """A line over itself has a corner where it turns."""
    way = bytes((X_STEP,)) * 3000 + bytes((X_STEP | X_MINUS,)) * 3500
    run_walk(skg80, tmp_path, way, "--drive", tmp_path / "d.svg")
    ends = [to[0] for _, _, to in drawn_lines(tmp_path / "d.svg", way)]
    assert ends == [3000, -500]


def test_stop_and_feed_options(skg80: Skg80, tmp_path: Path, rom_of: Rom) -> None:
    """--stop-at ends the steps until a key, with ,stay for ever; --feed paces them; --stats has the mean."""
    steps = tmp_path / "s"
    for option, count in (("700", 700), ("700,stay", 701)):
        keys = b"" if option == "700" else b"x"
        done = skg80("--rom", rom_of(STOPPING), "--stop-at", option, "--steps", steps, "--stats", stdin=keys)
        assert says(complaint(done, 1), "input"), done.stderr
        assert len(steps.read_bytes()) == count
        assert re.search(
            rb"\ndrive         %d steps, from one to the next 58\.0 cycles, at most 58\n" % count, done.stderr
        )
    done = skg80("--rom", rom_of(PACED), "--feed", "100", "--steps", steps, "--max-cycles", "2000000")
    assert says(complaint(done, 3), "2000000 cycles")
    assert len(steps.read_bytes()) == 100


@pytest.mark.parametrize(
    ("options", "facts"),
    [
        (["--stop-at", "0"], ["--stop-at 0: ", 1, ",stay"]),
        (["--stop-at", "5,"], ["--stop-at 5,: ", 1, "`,stay"]),
        (["--stop-at", "5,stays"], ["--stop-at 5,stays: ", 1, "`,stay`"]),
        (["--stop-at", "9" * 30], [f"--stop-at {'9' * 30}: ", 1, ",stay"]),
        (["--feed", "0"], ["--feed 0: ", 0.01, 1000000]),
        (["--feed", "50Hz"], ["--feed 50Hz: ", 0.01, 1000000]),
        (["--feed", "nan"], ["--feed nan: ", 0.01, 1000000]),
        (["--drive"], ["--drive", "value"]),
        (["--drive", "a.svg/x.png"], ["--drive a.svg/x.png: ", "SVG", " .svg"]),
        (["--drive", "x", "--steps", "x"], ["x: ", "two"]),
        (["--drive", "/nowhere/x.svg"], ["/nowhere/x.svg: No such file or directory"]),
        (["--com", "x", "--steps", "y"], ["--com", "--stats", "--max-cycles"]),
    ],
)
def test_bad_options(skg80: Skg80, tmp_path: Path, options: list[str], facts: list[object]) -> None:
    """One line, exit 2."""
    assert says(complaint(skg80(*options), 2), *facts)


@pytest.mark.parametrize("option", ["--drive", "--steps"])
def test_a_full_disk_is_said(skg80: Skg80, tmp_path: Path, option: str) -> None:
    """Exit 2: a file that is not whole is no file."""
    (tmp_path / "rom.bin").write_bytes(walker(some_way(1, 9)))
    done = skg80("--rom", tmp_path / "rom.bin", option, "/dev/full")
    assert done.returncode == 2
    assert says(done.stderr.decode(), "skg80: ", "No space left on device")


def test_a_rom_without_a_drive_is_noticed(skg80: Skg80, tmp_path: Path, part: Callable[[str], Path]) -> None:
    """The standard ROM does not know DRIVE: exit 1, and the drawing is an empty sheet."""
    done = skg80(part("10 CUT (0,0),(1,0)\n\x1a"), "--drive", tmp_path / "d.svg")
    assert done.returncode == 1
    assert b">DRIVE 1\r\n" in done.stderr
    assert says(done.stderr.decode(), "skg80: ", "drive", "no step")
    assert not list(ElementTree.parse(tmp_path / "d.svg").iter("{http://www.w3.org/2000/svg}path"))


def test_a_part_is_followed_past_its_stops(skg80: Skg80, tmp_path: Path, part: Callable[[str], Path]) -> None:
    """The operator types DRIVE 1 before RUN, and presses a key at each D: the steps of the whole tape are made."""
    path = part("10 FROM (0,0)\n20 CUT (0,0),(1,0)\n30 FROM (2,1)\n40 CUT (2,1),(2,0)\n\x1a")
    done = skg80("--rom", ROMS / "skg-drive.bin", "--steps", tmp_path / "steps", path)
    assert done.returncode == 0, done.stderr
    tape = parse(done.stdout, "tape")
    assert len(tape.stops) == 2
    assert (tmp_path / "steps").read_bytes() == b"".join(drive_steps(tape))


def test_hasty_steps_are_said(skg80: Skg80, rom_of: Rom) -> None:
    """Whatever else is asked for."""
    done = skg80("--rom", rom_of("MVI A,3\nOUT 14H\nHLT"))
    assert says(done.stderr.decode(), "skg80: 1", "drive", "direction")
