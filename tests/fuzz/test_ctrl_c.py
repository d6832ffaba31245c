"""ctrl-C at every moment of every statement: the prompt comes back, the program is as it was, the tape has whole lines.

A moment is each so many cycles from the end of the line on: SKG_STRIDE=number (`make hunt` takes more of them).
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

from skg.board import Board
from skg.board.emulator import Machine

ROOT = Path(__file__).resolve().parents[2]
ROM = Path(os.environ.get("SKG_ROM", ROOT / "roms" / "skg.bin"))
#: Images that make blocks, or read keys, in another way. (A teletype's own punch is on or off: no memory tells it.)
OTHERS = {"skg-nodrift": {}, "skg-8251": {"board": "8251"}}

STRIDE = int(os.environ.get("SKG_STRIDE", "4999"))
CTRL_C = 3
#: Cycles from ctrl-C to the prompt: one statement, at most.
PATIENCE = 40_000_000
#: So many moments of a line are tried at most, so far apart that they reach its end.
MOST = int(os.environ.get("SKG_MOMENTS", "120"))

PROGRAM = """10 R=1
20 FROM (-5,5)
30 CUT X,(10,0),2,(10,10)
40 CUT (0,10)
50 FIT (0,10)
60 FIT (-1,5),-90
70 FIT (0,0)
80 BACK
90 RECUT
100 READ A,P
110 DATA SIN 30,(1,2)#45
120 PRINT A,P,"END"
130 GOSUB 150
140 GOTO 160
150 RETURN
160 IF A=1 GOTO 10
170 RESTORE 110
180 TOL .1
190 SCALE 2
200 CUT O,(3,0)
210 SYM Y
220 REP 3,90:(5,5)
"""
#: Lines, and those typed before each: with a program in memory or none, in the middle of a route or not.
LINES = {
    "RUN without a program": (["NEW"], "RUN"),
    "RUN": ([], "RUN"),
    "RUN 100": ([], "RUN 100"),
    "RUN of no line": ([], "RUN 55"),
    "GOTO": ([], "GOTO 100"),
    "GOSUB": ([], "GOSUB 140"),
    "endless": (["230 GOTO 230"], "GOTO 230"),
    "LIST": ([], "LIST"),
    "LIST without a program": (["NEW"], "LIST"),
    "SAVE": ([], "SAVE"),
    "FREE": ([], "FREE"),
    "a line stored": ([], "100 READ A,P,S"),
    "a line taken out": ([], "100"),
    "a line refused": ([], "CUT (1,"),
    "FROM": (["CUT O,(5,0)"], "FROM (7,-7)"),
    "CUT": (["CUT O"], "CUT (5,0),1,(5,5),(0,5),O"),
    "BACK": (["R=1", "CUT O:5"], "BACK"),
    "RECUT": (["CUT O:5", "BACK"], "RECUT"),
    "SYM": (["CUT O,(5,1)"], "SYM X"),
    "REP": (["CUT (5,0)"], "REP 4,90"),
    "FIT": (["FIT O", "FIT (5,1)"], "FIT (9,0)"),
    "END": (["CUT O,(5,0)"], "END"),
    "END without a program": (["NEW"], "END"),
    "PRINT": ([], "PRINT (O:5)*(X:1),SIN 30"),
    "NEW": ([], "NEW"),
    "INPUT": (["230 INPUT A"], "GOTO 230"),
}
_BLOCK = re.compile(rb"(B\d+B\d+B\d+G[XY](L|NR|SR)[1-4]|DD?)?")


class State(NamedTuple):
    """The RAM and the registers."""

    ram: bytes
    registers: dict[str, int]

    @classmethod
    def of(cls, machine: Machine) -> State:
        return cls(machine.peek(0x2000, machine.ram_end - 0x2000), machine.registers)

    def again(self, machine: Machine) -> None:
        machine.poke(0x2000, self.ram)
        machine.set_registers(**self.registers)


def prompt(machine: Machine, limit: int = PATIENCE) -> bool:
    """Run to the prompt."""
    end = machine.cycles + limit
    while machine.cycles < end:
        reason = machine.run(end - machine.cycles)
        if reason != "wait":
            return reason == "prompt"
    return False


def moments(machine: Machine, line: str) -> Iterator[tuple[int, bytes]]:
    """Type a line and stop at moments, with the cycles since its end and what is punched up to there; whoever takes one
    may run on from it."""
    machine.type(line)
    while machine.run() != "wait":
        pass
    start = State.of(machine)
    machine.press("\r")
    length = until_asked(machine)
    start.again(machine)
    machine.clear()
    machine.press("\r")
    now, punched = State.of(machine), b""
    stride, passed = max(STRIDE, length // MOST), 0
    # (the line's end is taken first)
    step = 400
    while passed < length:
        now.again(machine)
        machine.run(step)
        passed, step = passed + step, stride
        now, punched = State.of(machine), punched + machine.punch
        machine.clear()
        yield passed, punched
        machine.clear()


def until_asked(machine: Machine) -> int:
    """The cycles until the machine asks for something again, or half a second."""
    begin = machine.cycles
    machine.run(3_000_000)
    return machine.cycles - begin


@pytest.mark.parametrize("name", LINES)
def test_ctrl_c(name: str) -> None:
    tried, broken = at_each_moment(Board(ROM.read_bytes(), max_cycles=PATIENCE), *LINES[name])
    assert tried > 2
    if name in ("RUN", "endless", "LIST", "GOTO"):
        assert broken > tried / 2


@pytest.mark.parametrize("name", ["RUN without a program", "RUN", "END", "LIST"])
@pytest.mark.parametrize("image", OTHERS)
def test_ctrl_c_at_other_boards(image: str, name: str) -> None:
    rom = ROM.with_name(f"{image}.bin").read_bytes()
    assert at_each_moment(Board(rom, max_cycles=PATIENCE, **OTHERS[image]), *LINES[name])[0] > 2


def at_each_moment(board: Board, before: list[str], line: str) -> tuple[int, int]:
    """Press ctrl-C at moments of a line; return their number, and of how many an error came."""
    board.load(PROGRAM)
    for typed in before:
        board.type(typed)
    broken = tried = 0
    kept = board.type("LIST")
    for cycles, punched in moments(board.machine, line):
        machine, here = board.machine, board.machine.printed
        machine.press(CTRL_C)
        assert prompt(machine), f"{cycles} cycles behind {line}: {machine.paper_from(here)[-200:]!r}"
        broken += "ERR 10" in machine.paper_from(here)
        tried += 1
        if not line[0].isdigit() and line not in ("NEW", "SAVE"):
            rows = (punched + machine.punch).split(b"\r\n")
            assert not rows[-1] and all(map(_BLOCK.fullmatch, rows)), (cycles, rows)
            assert board.type("LIST") == kept, cycles
        assert board.type("PRINT 6*7") == ["42"], cycles
    return tried, broken
