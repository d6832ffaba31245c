"""`skg80 --punch-pty`: punch and reader are a line with a machine at its end, which a test plays."""

from __future__ import annotations

import contextlib
import os
import select
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from facthelp import each_says, says
from grblhelp import GREETING, OK, PATIENCE, ROMS, ROOT, SKG80, driven
from playedhelp import always

from skg.ref import mill

PART = "10 F 300,60\n20 Z -1,3\n30 FROM (-5,0)\n40 CUT O,(10,0),(0,7)\n50 BACK\n60 HOLE (1,1),(2,2)\n"


@pytest.fixture
def part(tmp_path: Path) -> Path:
    path = tmp_path / "part.skg"
    path.write_text(PART)
    return path


# The line itself, with the ROM that waits for nobody ------------------------------------------------------------------


def test_the_tape_goes_to_the_line(tmp_path: Path) -> None:
    example = ROOT / "examples" / "fit-gear.skg"
    part = tmp_path / "part.skg"
    part.write_bytes(example.read_bytes())
    copy = tmp_path / "copy.3b"
    with driven("skg", part, always, "--punch", copy) as (board, machine):
        assert board.wait() == 0
        tape = example.with_suffix(".3b").read_bytes()
        assert len(tape) > 4096  # more than a line holds
        last = time.monotonic() + PATIENCE
        while len(machine.raw) < len(tape) and time.monotonic() < last:
            time.sleep(0.02)
        assert machine.raw == tape == copy.read_bytes()
        assert board.process.stdout.read() == b""


def test_nobody_reads(part: Path) -> None:
    """Blocks that nobody takes are not lost without a word."""
    part.write_text((ROOT / "examples" / "xy-star.skg").read_text())
    done = subprocess.run([SKG80, "--punch-pty", part], capture_output=True, text=True)
    assert done.returncode == 2
    assert says(done.stderr.splitlines()[-1], f"skg80: {done.stdout.strip()}: ", "punched")


@pytest.mark.parametrize(
    ("options", "facts"),
    [
        (["--punch-pty", "--punch-tty"], ["--punch-pty", "port", "teletype"]),
        (["--punch-pty", "--com", "x.com"], ["--com", "--stats", "--max-cycles"]),
    ],
)
def test_wrong_usage(options: list[str], facts: list[str]) -> None:
    done = subprocess.run([SKG80, *options], capture_output=True, text=True)
    assert done.returncode == 2 and each_says(done.stderr, ("skg80: ", *facts))


#: 6850s readied, then what comes in at the punch's port goes out there: MVI A,3; OUT 12H; MVI A,15H; OUT 12H;
#: IN 12H; ANI 1; JZ 0008; IN 13H; OUT 13H; JMP 0008.
ECHO = bytes.fromhex("3E03D312 3E15D312 DB12 E601 CA0800 DB13 D313 C30800")


@contextlib.contextmanager
def terminal(*options: object) -> Iterator[tuple[int, int]]:
    """skg80 with two pseudo-terminals: the teletype's and the line's file descriptors."""
    words = [SKG80, "--pty", "--punch-pty", *options]
    process = subprocess.Popen(list(map(str, words)), stdout=subprocess.PIPE)
    ends = []
    try:
        for _ in range(2):
            ends.append(os.open(process.stdout.readline().decode().strip(), os.O_RDWR | os.O_NOCTTY))
        yield ends[0], ends[1]
    finally:
        process.kill()
        process.wait()
        process.stdout.close()
        for end in ends:
            os.close(end)


def until(end: int, wanted: bytes) -> bytes:
    """Reads from a line until its output ends in `wanted`."""
    came, last = b"", time.monotonic() + PATIENCE
    while not came.endswith(wanted):
        assert time.monotonic() < last, came
        if select.select([end], [], [], 0.1)[0]:
            came += os.read(end, 4096)
    return came


def test_what_the_machine_says_reaches_the_board(tmp_path: Path) -> None:
    rom = tmp_path / "echo.bin"
    rom.write_bytes(ECHO.ljust(8192, b"\xff"))
    with terminal("--rom", rom) as (_, line):
        for said in (b"ok\r\n", bytes(range(256)), b"error:33\r\n"):
            os.write(line, said)
            assert until(line, said[-4:]) == said


def test_save_and_load_through_the_line() -> None:
    """The standard ROM: a program goes out to the line, and another one comes in from there."""
    with terminal() as (teletype, line):
        until(teletype, b">")
        os.write(teletype, b"10 PRINT 6*7\rSAVE\r")
        assert b"10 PRINT 6*7\r\n" in until(line, b"\x1a").replace(b"\0", b"")
        until(teletype, b">")
        os.write(teletype, b"NEW\r")
        until(teletype, b">")
        os.write(teletype, b"LOAD\r")
        until(teletype, b"LOAD\r\n")
        os.write(line, b"10 PRINT 7*8\r\n\x1a")
        until(teletype, b">")
        os.write(teletype, b"RUN\r")
        assert b"56\r\n" in until(teletype, b">")


# The handshake, whose every case test_mill_handshake.py plays -----------------------------------------------------


def test_block_by_block(part: Path) -> None:
    wanted = mill.run(PART, line_end="\n").tape
    with driven("skg-grbl", part, always, slow=0.02) as (board, machine):
        assert board.wait() == 0
    assert machine.raw == wanted
    assert machine.blocks == wanted.decode().splitlines()
    assert machine.early == []


@pytest.mark.parametrize("said", ["error:33", "ALARM:1"])
def test_error_and_alarm(part: Path, said: str) -> None:
    """In mid-route; the board does not wait for what is said to its M0."""

    def answer(_block: str, number: int) -> bytes | None:
        return f"{said}\r\n".encode() if number == 6 else OK if number < 6 else None

    with driven("skg-grbl", part, answer) as (board, machine):
        assert board.wait() == 1
        wanted = mill.run(PART, line_end="\n").tape.decode().splitlines()[:6] + ["N7M0"]
        assert [line for line in board.printed() if line][-4:-1] == [said, "N7M0", "ERR 10 LINE 40"]
        machine.heard(len(wanted))
    assert machine.blocks == wanted


def test_silence_waits(part: Path) -> None:
    """However long: the next block does not come."""

    def answer(_block: str, number: int) -> bytes | None:
        return OK if number < 4 else None

    with driven("skg-grbl", part, answer) as (board, machine):
        machine.heard(4)
        time.sleep(0.3)
        assert board.process.poll() is None
        assert len(machine.blocks) == 4
        machine.answer = always
        machine.say(OK)
        assert board.wait() == 0
    assert machine.raw == mill.run(PART, line_end="\n").tape


@pytest.mark.parametrize(
    "before", [GREETING + OK, b"error:9\r\nALARM:1\r\n", b"error:9\r\n" * 300], ids=["ok", "error", "much"]
)
def test_ctrl_c_ends_the_wait(before: bytes) -> None:
    """Characters sent before the tape are no answer: an `ok` to a pendant's command, or to the last run's M0."""
    with terminal("--rom", ROMS / "skg-grbl.bin") as (teletype, line):
        until(teletype, b">")
        for text in PART.splitlines():
            os.write(teletype, text.encode() + b"\r")
            until(teletype, b">")
        os.write(line, before)
        os.write(teletype, b"RUN\r")
        assert until(line, b"\n") == b"N1G17G21G90G94\n"
        assert select.select([line, teletype], [], [], 0.3)[0] in ([], [teletype])
        assert not select.select([line], [], [], 0)[0]
        os.write(line, OK)
        assert until(line, b"\n") == b"N2G0Z3\n"
        os.write(teletype, b"\x03")
        assert b"ERR 10 LINE 30\r\n" in until(teletype, b">")
