"""roms/skg-grbl.bin: each block waits for the machine's `ok` (milling.md, section "Handshake"), which a test plays.

Through the emulator's pseudo-terminal: test_mill_punch_pty.py.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from playedhelp import IMAGE, OK, Played
from romhelp import Board

from skg.ref import mill

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted((ROOT / "examples" / "mill").glob("*.skg"))

PART = "10 F 300,60\n20 Z -1,3\n30 FROM (-5,0)\n40 CUT O,(10,0),(0,7)\n50 BACK\n60 HOLE (1,1),(2,2)\n"
BLOCKS = mill.run(PART, line_end="\n").tape.decode().splitlines()
#: The blocks that go out by line 40 and before its route is open; in it.
OUTSIDE, IN_ROUTE = 3, 6


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples(path: Path) -> None:
    """The mill's tape, but for its line ends; the same on the paper as without a handshake."""
    board = Played(path.read_text())
    paper = board.driven("RUN")
    tape = path.with_suffix(".nc").read_bytes()
    assert board.tape == tape.replace(b"\r\n", b"\n")
    assert paper == tape.decode().split("\r\n")[:-1]


#: What a machine may say that means nothing.
NOTHING = [
    b"\r\n\r\n", b"\r\nGrbl 1.1h ['$' for help]\r\n", b"[MSG:Caution: Unlocked]\r\n",
    b"<Idle|MPos:0.000,0.000,0.000|FS:0,0>\r\n", b"$0=10\r\n$1=25\r\n", b">G54:ok\r\n", b"echo:busy: processing\r\n",
    b"T:21.5 /0.0 ok\r\n", b"start\r\n", b"o\r\nk\r\n", b" ok\r\n", b"OK\r\n", b"Ok\r\n", b"not ok\r\n", b"0k\r\n",
    b"Error:1\r\n", b"alarm:1\r\n", b"err\r\nALAR\r\nerro:\r\nALARm\r\n", b"eok\r\nAok\r\noALARM\r\neerror\r\n",
    b"x" * 127 + b"ok\r\n", b"x" * 128 + b"ok\r\n", b"x" * 256 + b"error\r\n", bytes(range(0x80, 0x100)) + b"\r\n",
    bytes(range(1, 0x80)) + b"\n", b"\0\0\r\0\n\0",
]  # fmt: skip


def test_what_means_nothing() -> None:
    """Whatever else comes before the `ok`, the board waits on; a line that begins with that is enough."""
    source = "".join(f"{10 * n} M 8\n" for n in range(1, len(NOTHING) + 3))
    board = Played(source)
    said = iter(NOTHING)
    assert board.driven("RUN", lambda *_: next(said, OK)) is None
    for number in range(1, len(NOTHING)):
        board.machine.tape(b"ok: and more\r\n" if number % 2 else b"ok\n")
        assert board.wait(lambda *_: next(said, OK)) is None, NOTHING[number - 1]
        assert len(board.blocks) == number + 1
    board.machine.tape(b"ok\r")
    wanted = mill.run(source, line_end="\n").tape
    assert board.wait()[-1] == wanted.decode().splitlines()[-1]
    assert board.tape == wanted


@pytest.mark.parametrize("left", [b"ok\r\n", b"ok\r\nok\r\n", b"k\r\n", b"o", b"error:1\r\n", b"ALARM:1\r\n", b"err"])
@pytest.mark.parametrize("before", ["the tape", "a block"])
def test_what_came_before_the_block_is_no_answer(left: bytes, before: str) -> None:
    """Left over from something else, in front of the first block or behind the `ok` of another."""

    def answer(_block: str, number: int) -> bytes:
        return b"" if number == 3 else OK + left

    board = Played(PART)
    board.machine.tape(left if before == "the tape" else b"")
    if before == "the tape":
        assert board.driven("RUN", lambda *_: b"") is None
        assert board.blocks == BLOCKS[:1]
        board.machine.tape(OK)
    assert (board.wait(answer) if before == "the tape" else board.driven("RUN", answer)) is None
    assert board.blocks == BLOCKS[:3]


@pytest.mark.parametrize("said", ["error:33", "error: Bad number format", "error", "ALARM:1", "ALARM: Hard limit"])
@pytest.mark.parametrize(("at", "line"), [(OUTSIDE, 30), (IN_ROUTE, 40)])
def test_error_and_alarm(said: str, at: int, line: int) -> None:
    """The line is typed, the run ends; M0 in mid-route is not waited for, and the next run begins a tape of its own."""
    board = Played(PART)
    paper = board.driven(
        "RUN", lambda _, number: f"[MSG:x]\r\n{said}\r\n".encode() if number == at else OK if number < at else b""
    )
    stop = [f"N{at + 1}M0"] if at == IN_ROUTE else []
    assert paper == [*BLOCKS[:at], said, *stop, f"ERR 10 LINE {line}"]
    assert board.blocks == BLOCKS[:at] + stop
    board.clear()
    assert board.driven("RUN") == BLOCKS
    assert board.blocks == BLOCKS


def test_a_long_complaint_is_typed_up_to_a_line() -> None:
    said = "error:" + "".join(chr(48 + n % 70) for n in range(200))
    assert Played(PART).driven("RUN", lambda *_: f"{said}\r\n".encode())[1] == said[:127]


def test_only_whole_lines_count() -> None:
    """`ok` or `error` without a line end is no answer yet."""
    board = Played(PART)
    assert board.driven("RUN", lambda *_: b"") is None
    for part in (b"o", b"k", b" and so on"):
        board.machine.tape(part)
        assert board.wait() is None
    assert board.blocks == BLOCKS[:1]
    board.machine.tape(b"\n")
    assert board.wait()[-1] == BLOCKS[-1]


@pytest.mark.parametrize(("at", "line"), [(OUTSIDE, 30), (IN_ROUTE, 40)])
def test_silence_and_ctrl_c(at: int, line: int) -> None:
    """However long it takes; ctrl-C ends the wait, and nothing is lost."""
    board = Played(PART)
    assert board.driven("RUN", lambda _, number: OK if number < at else b"") is None
    assert board.blocks == BLOCKS[:at]
    board.machine.press(3)
    paper = board.wait(lambda *_: b"")
    stop = [f"N{at + 1}M0"] if at == IN_ROUTE else []
    assert paper[-1 - len(stop) :] == [*stop, f"ERR 10 LINE {line}"]
    assert board.blocks == BLOCKS[:at] + stop
    assert board.driven("LIST 30") == ["30 FROM (-5,0)"]
    board.clear()
    assert board.driven("RUN") == BLOCKS


def test_a_machine_in_alarm_takes_nothing() -> None:
    """As GRBL does before `$H` or `$X`."""
    board = Played(PART)
    assert board.driven("RUN", lambda *_: b"error:9\r\n") == [BLOCKS[0], "error:9", "ERR 10 LINE 30"]
    assert board.blocks == BLOCKS[:1]


def test_an_error_of_the_program_is_not_waited_for() -> None:
    board = Played("10 F 100\n20 CUT O,(1,0),(2,3)\n30 A=1/0\n")
    paper = board.driven("RUN", lambda block, _: b"" if block.endswith("M0") else OK)
    assert paper[-2:] == ["N4M0", "ERR 05 LINE 30"]
    assert board.blocks[-1] == "N4M0"


def test_direct_statements_wait_too() -> None:
    """The machine's line lies where the operator's was typed: the statement goes on behind it."""
    board = Played()
    assert board.driven("F 100;1")[-1] == "ERR 01"
    assert board.driven("F 100") == board.driven("Z -1") == []
    line = "HOLE (1,1),(2,2)*1,(SQR 9,3)"
    assert board.driven(line, lambda *_: b"[MSG:" + b"x" * 200 + b"]\r\nok\r\n") == board.tape.decode().splitlines()
    assert board.blocks == mill.run(f"1 F 100\n2 Z -1\n3 {line}", line_end="\n").tape.decode().splitlines()[:-1]
    assert board.driven("M 3,1200", lambda *_: b"error:20\r\n")[-2:] == ["error:20", "ERR 10"]


def test_m0_of_the_program_waits() -> None:
    """M 0 is a block as any other: the machine says ok when somebody has pressed its button."""
    board = Played("10 M 0\n20 M 8\n")
    assert board.driven("RUN", lambda block, _: b"" if block.endswith("M0") else OK) is None
    assert board.blocks == ["N1G17G21G90G94", "N2M0"]
    board.machine.tape(OK)
    assert board.wait()[-1] == "N4M30"


def test_save_and_load_have_no_handshake() -> None:
    board = Board(kind=IMAGE)
    assert board.load(PART) == []
    board.clear()
    assert board.type("SAVE") == PART.splitlines()
    assert board.tape == PART.replace("\n", "\r\n").encode() + b"\x1a"
    again = Board(kind=IMAGE)
    assert again.load(board.tape.decode().replace("\r\n", "\n").removesuffix("\x1a")) == []
    assert again.listing() == PART.splitlines()


def test_input_between_blocks() -> None:
    """The operator's answers and the machine's do not disturb each other, whatever is said in between."""
    board = Played("10 F 100\n20 Z -1\n30 INPUT P1\n40 HOLE P1\n50 INPUT P2\n60 HOLE P2\n")
    wanted = mill.run("\n".join(board.listing()), ("(1,2)", "(3,4)"), line_end="\n").tape
    board.answer = lambda *_: b"ok\r\nok\r\n[MSG:x]\r\nerror:1\r\n"
    board.run(("(1,2)", "(3,4)"))
    assert board.tape == wanted
