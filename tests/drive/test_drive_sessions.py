"""Random typed sessions, of the statements of tests/rom/sessions.py, at the driving ROM.

What runs steps as its own tape says, with bit 7 on from its first step, whatever broke off before it. Behind a stop in
a block the rest of that block comes first, but RUN and NEW forget it.

40 sessions; another seed: SKG_SEED=text, more of them: SKG_SESSIONS=number.
"""

from __future__ import annotations

import os
import re
from random import Random

from follower import CUTTING, follow
from sessions import NUMBERS, statement
from test_rom import CTRL_C, PATIENCE, Driver

SEED = os.environ.get("SKG_SEED", "drive")
SESSIONS = int(os.environ.get("SKG_SESSIONS", "40"))
#: Lines that run a program: these alone are followed.
RUNS = re.compile(r"RUN|GOTO|GOSUB|RETURN|IF")
#: A whole line of a tape: what is wrong breaks off in a block.
WHOLE = re.compile(r"^(?:DD?|B\d+B\d+B\d+G[XY](?:L|[NS]R)[1-4])(?=\r)", re.M)
#: What takes minutes to step, the statement that this image has not, what waits for an answer.
LEFT_OUT = re.compile(r"\d{5}|TOL|INPUT")
#: Cycles after which the operator breaks in: in a block, at a D, between two; and when nothing ends by itself.
MOMENTS = (300_000, 3_000_000, 20_000_000, 60_000_000)


def lines_of(random: Random) -> list[str]:
    """A program, then what is typed: it is run, edited, gone on with, with statements in between."""

    def short() -> str:
        while LEFT_OUT.search(line := statement(random)):
            pass
        return line

    starts = [
        "RUN",
        "RUN",
        "RUN 30",
        "RETURN",
        *(f"GO{how} {number}" for number in NUMBERS for how in ("TO", "TO", "SUB")),
    ]
    typed = [
        random.choice(
            (
                random.choice(starts),
                random.choice(starts),
                short(),
                f"{random.choice(NUMBERS)} {short()}",
            )
        )
        for _ in range(8)
    ]
    sound = ["FROM (2,2)", random.choice(["CUT O,(3,0),(3,1)", "CUT O:2,(2,0)", "CUT O:3"]), "BACK"]
    sound += [f"FROM ({random.randint(-3, 3)},4)", random.choice(["CUT (4,4):1", "CUT (1,0),(2,2)", "END"])]
    program = [line if random.random() < 0.8 else short() for line in sound]
    return [*(f"{number} {line}" for number, line in zip(NUMBERS, program, strict=True)), *typed]


def work(board: Driver, line: str, random: Random) -> tuple[bool, str]:
    """Type a line, press a key at each D, or break in at some moment: whether the line came to its end; the paper."""
    start = board.machine.printed
    whole, left = (
        True,
        random.choice(MOMENTS) if random.random() < 0.4 else PATIENCE // 10,
    )
    board.machine.type(f"{line}\r")
    while (reason := board.machine.run(left)) != "prompt":
        if reason == "wait":
            assert not board.machine.drive & CUTTING, "nobody cuts while the wire is threaded"
            whole = whole and random.random() < 0.9
            board.machine.press(ord(" ") if whole else CTRL_C)
        else:
            whole = False
            board.machine.press(CTRL_C)
    assert board.machine.drive == 0, "nothing cuts, no pulse is up"
    paper = board.machine.paper_from(start)
    return whole and "ERR 10" not in paper, paper


def test_what_runs_is_followed_from_its_start() -> None:
    followed = broken = behind = 0
    for number in range(SESSIONS):
        random, board, rest, was_broken = Random(f"{SEED} {number}"), Driver(), b"", False
        board.go("DRIVE 1")
        for at, line in enumerate(lines := lines_of(random)):
            board.clear()
            before = len(board.tape)
            whole, paper = work(board, line, random)
            tape = "\n".join(WHOLE.findall(board.tape[before:].decode()))
            # (RUN of a line that is not there clears nothing)
            rest = b"" if re.match("RUN|NEW", line) and "ERR 02\r" not in paper else rest
            if not RUNS.match(line) or "B" not in tape and not board.steps:
                assert not board.steps, lines[: at + 1]
                continue
            wanted = rest + follow(tape)
            where = f"session {number} of {SEED}: {lines[: at + 1]}"
            assert board.steps == wanted[: len(board.steps)], where
            assert not whole or board.steps == wanted, where
            rest = wanted[len(board.steps) :]
            followed += 1
            broken += not whole
            behind += was_broken
            was_broken = was_broken or not whole
    assert followed > SESSIONS and broken > SESSIONS / 4 and behind > SESSIONS / 4, (followed, broken, behind)


def stopped_in_a_run(program: str) -> Driver:
    """A board that was stopped while it carried out a program."""
    board = Driver()
    board.load(program)
    board.go("DRIVE 1")
    board.machine.type("RUN\r")
    board.machine.run(3_000_000)
    board.stop()
    return board


def test_a_stop_while_a_d_waits_for_the_rest_of_a_block() -> None:
    """The D of the run that was broken off counts no more: the next run moves with bit 7 off, and cuts with it on."""
    board = stopped_in_a_run("10 FROM O\n20 CUT O,(30,0),(30,1)\n30 FROM (3,3)\n40 CUT (3,3),(4,3)\n50 END\n")
    assert 0 < len(board.steps) < 30000
    board.machine.type("GOTO 30\r")
    board.machine.run(1_500_000)
    assert board.stop().endswith("ERR 10 LINE 30\r\n>")
    begun, before = len(board.steps), len(board.tape)
    assert begun < 30000
    board.go("GOTO 30")
    assert board.steps[begun:] == board.steps[begun:30000] + follow(board.tape[before:].decode())


def test_stopped_again_in_the_rest_of_a_block() -> None:
    """GOTO behind a stop: nothing of its line is done before the rest of that block, however often it is stopped."""
    board = stopped_in_a_run("10 FROM O\n20 CUT O,(30,0),(30,1)\n30 FROM (3,3)\n40 CUT (3,3),(4,3),(4,6)\n50 BACK\n")
    for _ in range(3):
        begun, before = len(board.steps), len(board.tape)
        board.machine.type("GOTO 40\r")
        board.machine.run(1_000_000)
        assert board.stop().endswith("ERR 10 LINE 40\r\n>")
        assert begun < len(board.steps) < 30000 and len(board.tape) == before
    assert "ERR" not in board.go("GOTO 40")
    tape = board.tape[before:].decode()
    assert tape.count("G") == 5
    assert board.steps == b"\x81" * 30000 + follow(tape)


def test_a_subroutine_that_ends_in_the_middle_of_a_tape() -> None:
    """At the prompt behind a direct GOSUB the machine is off; the next one goes on as the tape says."""
    board = Driver()
    board.load("10 CUT O,(2,0),(2,1)\n20 RETURN\n30 FROM (3,3)\n40 RETURN\n50 END\n")
    board.go("DRIVE 1")
    for call in ("GOSUB 10", "GOSUB 30", "GOSUB 10", "GOTO 50"):
        board.go(call)  # (which looks at the port)
    assert board.steps == follow(board.tape.decode()) and board.steps
