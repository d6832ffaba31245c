"""Readers and keyboards that do not wait: a lost character is error 10 with its line; /RTS held, none is lost."""

from __future__ import annotations

import random
import subprocess
from pathlib import Path

import pytest
from romhelp import BOARDS, EVERY, EXAMPLES, PAPER_TAPES, ROOT, RUN_LIMIT, Board, image

#: 9600 to 110 baud.
SPEEDS = [960, 480, 240, 120, 60, 30, 15, 10]
CTRL_C, CTRL_Z = 3, 26
SECOND = 2_000_000
#: Cycles that LOAD takes for a line, on the mean of a part.
LOAD_LIMIT = 400_000

every_board = pytest.mark.parametrize("kind", BOARDS)


def tape_of(part: Path, end: str = "\r\n", nuls: int = 0) -> bytes:
    """A program as a tape, `nuls` NULs behind each line."""
    return b"".join(f"{line}{end}".encode() + bytes(nuls) for line in part.read_text().splitlines())


def listed(part: Path, lines: dict[Path, list[str]] = {}) -> list[str]:  # noqa: B006 (kept from test to test)
    """The output of LIST for a program loaded without haste."""
    if part not in lines:
        board = Board()
        board.load(part.read_text())
        lines[part] = board.listing()
    return lines[part]


def loaded(board: Board, tape: bytes, cps: float, cts: int | None) -> str:
    """LOAD a tape from a reader that does not wait; what is printed."""
    machine = board.machine
    machine.reader_cps(cps, cts)
    machine.tape(tape)
    start = len(machine.tty)
    machine.type("LOAD\r")
    assert machine.run(RUN_LIMIT, patience=10 * SECOND) in ("prompt", "wait")
    machine.take_tape()
    machine.reader_cps(0)
    paper = machine.tty[start:]
    machine.type("\x15\r")  # what came behind an error stands at the teletype's own prompt
    machine.run(RUN_LIMIT)
    return paper


def pasted(board: Board, text: bytes, cps: float, cts: int | None) -> str:
    """Type a text at a speed of its own; what is printed."""
    machine = board.machine
    machine.keyboard_cps(cps, cts)
    start = len(machine.tty)
    machine.type(text.decode())
    assert machine.run(RUN_LIMIT, patience=10 * SECOND) in ("prompt", "wait")
    machine.keyboard_cps(0)
    machine.type("\r")  # the last line's own may be lost
    machine.run(RUN_LIMIT)
    return machine.tty[start:]


@pytest.mark.parametrize("kind", ["skg", "skg-8251"])
def test_a_reader_that_waits_may_be_late_too(kind: str) -> None:
    """By one character. What comes behind an error stands at the prompt; no line takes LOAD_LIMIT, late or not."""
    for part in EXAMPLES[::7]:
        board, patient = Board(kind=kind), Board(kind=kind)
        tape = tape_of(part, "\n") + bytes([CTRL_Z])
        assert loaded(board, tape, 0, 1) == loaded(patient, tape, 0, None)
        assert board.listing() == listed(part)
        assert board.machine.lost == 0
        for machine in (board.machine, patient.machine):
            assert machine.cycles < LOAD_LIMIT * (tape.count(b"\n") + 2), part.stem  # two lines: reset and LOAD itself
    assert loaded(Board(kind=kind), b"PRINT .\n22\n", 0, 1).endswith("\r\n>2")


#: Each example on the first board; each other board takes a third of them, by turns. (all of them: make hunt)
LINED = [
    (kind, part)
    for turn, kind in enumerate(BOARDS)
    for part in (EXAMPLES if turn == 0 else EXAMPLES[turn % EVERY :: EVERY])
]


@pytest.mark.parametrize(("kind", "part"), LINED, ids=lambda value: value if isinstance(value, str) else value.stem)
def test_whoever_obeys_rts_loses_nothing(kind: str, part: Path) -> None:
    """Within 2 characters, at a speed and with line ends drawn for each part: reader and paste."""
    dice = random.Random(f"{kind}{part.stem}")
    for cps in (960, dice.choice(SPEEDS)):
        for way in (loaded, pasted):
            cts, end = dice.randint(0, 2), dice.choice(["\r\n", "\n", "\r"])
            board = Board(kind=kind)
            paper = way(
                board,
                tape_of(part, end) + (bytes([CTRL_Z]) if way is loaded else b""),
                cps,
                cts,
            )
            assert "ERR" not in paper, (cps, cts, end, paper)
            assert board.machine.lost == 0, (cps, cts, end)
            assert board.listing() == listed(part), (cps, cts, end)


@every_board
@pytest.mark.parametrize("cps", SPEEDS)
def test_no_loss_is_silent(kind: str, cps: int) -> None:
    """Without /RTS a program is right, or error 10 has said that it is not; so with an error in mid-tape."""
    dice, lost = random.Random(cps), 0
    turn = SPEEDS.index(cps) + sorted(BOARDS).index(kind)
    for part in EXAMPLES[turn % (3 * EVERY) :: 3 * EVERY]:
        for way in (loaded, pasted):
            board = Board(kind=kind)
            paper = way(
                board,
                tape_of(part, nuls=dice.choice([0, 0, 3, 12])) + bytes([CTRL_Z]),
                cps,
                None,
            )
            lost += board.machine.lost
            assert board.listing() == listed(part) or "ERR 10" in paper, (
                part.stem,
                way.__name__,
                paper,
            )
            assert not board.machine.lost or "ERR 10" in paper or way is pasted, (
                part.stem,
                way.__name__,
                paper,
            )
            wrong = set(board.listing()) - set(listed(part))
            assert way is pasted or not wrong, (part.stem, wrong)
    assert lost or cps <= 15


@every_board
@pytest.mark.parametrize(("cps", "nuls"), [(10, 4), (20, 12)])
def test_a_reader_without_handshake_needs_nuls(kind: str, cps: int, nuls: int) -> None:
    """As many as board.md says. (each board loads some of the examples, all together load all)"""
    for part in EXAMPLES[sorted(BOARDS).index(kind) :: len(BOARDS)]:
        board = Board(kind=kind)
        paper = loaded(board, tape_of(part, nuls=nuls) + bytes([CTRL_Z]), cps, None)
        assert "ERR" not in paper and board.listing() == listed(part), (
            part.stem,
            paper,
        )


@pytest.mark.parametrize("kind", PAPER_TAPES)
def test_a_saved_tape_needs_no_handshake(kind: str) -> None:
    """At a teletype's 10 characters a second. (each board a third of the examples, all together all)"""
    for part in EXAMPLES[PAPER_TAPES.index(kind) :: 3]:
        board = Board(kind=kind)
        board.load(part.read_text())
        board.machine.clear()
        board.type("SAVE")
        saved = board.machine.punch
        board.type("NEW")
        paper = loaded(board, saved, 10, None)
        assert "ERR" not in paper and board.machine.lost == 0 and board.listing() == listed(part), (part.stem, paper)


def test_the_command_that_puts_nuls_behind_lines(tmp_path: Path) -> None:
    """That of boards.md, by whichever awk there is: mawk ends a printf at the first NUL."""
    (command,) = [line for line in (ROOT / "docs" / "boards.md").read_text().splitlines() if "> part.tape" in line]
    (tmp_path / "part.skg").write_bytes(EXAMPLES[0].read_bytes())
    subprocess.run(["sh", "-c", command], cwd=tmp_path, check=True)
    assert (tmp_path / "part.tape").read_bytes() == tape_of(EXAMPLES[0], nuls=4)


#: The processor's clock of boards whose sender is quick, Hz, and the fastest line that boards.md has for it, baud.
QUICK = {
    "skg-rc2014": (7_372_800, 115_200),
    "skg-rc2014-sio": (7_372_800, 115_200),
    "skg-minimax8085": (3_072_000, 19_200),
}


every_quick = pytest.mark.parametrize("kind", QUICK)


@every_quick
@pytest.mark.parametrize("cts", [0, 1, 2])
def test_a_quick_sender_that_obeys_rts_may_paste(kind: str, cts: int) -> None:
    """At the line's speed, slower, and some hundredths beside it."""
    hz, fastest = QUICK[kind]
    dice = random.Random(f"{kind}{cts}")
    for part in EXAMPLES[cts::3]:
        baud = dice.choice([1, 0.972, 1.024, 0.5, 0.25, 0.125]) * fastest
        end = dice.choice(["\r\n", "\n", "\r"])
        board = Board(kind=kind)
        paper = pasted(board, tape_of(part, end), baud / 10 * 2_000_000 / hz, cts)
        assert "ERR" not in paper and board.machine.lost == 0, (part.stem, baud, end)
        assert board.listing() == listed(part), (part.stem, baud, end)


@every_quick
def test_a_quick_sender_needs_delays_without_rts(kind: str) -> None:
    """As boards.md says: 1 ms behind each character and 0.2 s behind each line; twice that at 3 MHz."""
    hz, fastest = QUICK[kind]
    character, line_end = (1e-3, 0.2) if hz > 5_000_000 else (2e-3, 0.5)
    character += 10 / fastest
    for part in EXAMPLES[::4]:
        board = Board(kind=kind)
        machine = board.machine
        machine.keyboard_cps(1 / character * 2_000_000 / hz, None)
        for line in part.read_text().splitlines():
            machine.type(f"{line}\r")
            machine.run(int(hz * (line_end + (len(line) + 1) * character)), patience=RUN_LIMIT)
        machine.keyboard_cps(0)
        machine.run(RUN_LIMIT)
        assert machine.lost == 0
        assert board.listing() == listed(part)


@every_board
def test_the_line_is_shown_up_to_the_loss(kind: str) -> None:
    board = Board(kind=kind)
    paper = loaded(
        board,
        b"10 A=1\r\n" + b"20 REM LONG, LONG, LONG, LONG, LONG\r\n" * 50,
        960,
        None,
    )
    assert "?\r\n" in paper and "ERR 10" in paper
    assert board.listing() in ([], ["10 A=1"])


@pytest.mark.parametrize(
    "kind", ["skg", "skg-8251", "skg-rc2014", "skg-rc2014-sio", "skg-mill", "skg-grbl", "skg-drive", "skg-nodrift"]
)
def test_images_without_handshake_say_it_too(kind: str) -> None:
    for part in EXAMPLES[::7]:
        board = Board(kind=kind)
        paper = loaded(board, tape_of(part), 960, None)
        assert board.machine.lost and "ERR 10" in paper
        assert set(board.listing()) <= set(listed(part))


@pytest.mark.parametrize("cps", [960, 240, 60])
def test_drive_refuses_a_block_that_lost_a_character(cps: int) -> None:
    board = Board(kind="skg-drive")
    board.machine.reader_cps(cps)
    board.machine.tape(b"B4000B3000B4000GXL1\r\n" * 20 + b"DD\r\n")
    board.machine.type("DRIVE\r")
    board.machine.run(RUN_LIMIT, patience=10 * SECOND)
    assert board.machine.lost and board.machine.tty.endswith("ERR 10\r\n>")


def test_one_key_waits_while_a_statement_works() -> None:
    """A second one is a loss; ctrl-C always gets through."""
    board = Board()
    for line in ("10 A=A+1", "20 IF A<300 GOTO 10"):
        assert board.type(line) == []
    for keys, error in (("X", False), ("XY", True)):
        board.machine.type("5 A=0\rRUN\r")
        board.machine.run(SECOND // 2)
        for key in keys:
            board.machine.press(key)
            board.machine.run(SECOND // 10)
        board.machine.run(RUN_LIMIT)
        board.machine.type("=1\r")
        board.machine.run(RUN_LIMIT)
        assert board.machine.tty.endswith("ERR 10\r\n>") == error, board.machine.tty[-80:]
    board.machine.type("RUN\r")
    board.machine.run(SECOND // 2)
    board.machine.press("X")
    board.machine.run(SECOND // 10)
    board.machine.press(CTRL_C)
    assert board.machine.run(SECOND) == "prompt"
    assert "ERR 10" in board.machine.tty[-30:]


@every_board
@pytest.mark.parametrize("options", [[], ["--cts", "2"]])
def test_skg80(kind: str, options: list[str]) -> None:
    part = ROOT / "examples" / "wrench.skg"
    facts = BOARDS[kind]
    command = [
        ROOT / "build" / "skg80",
        "--rom",
        image(kind),
        *(["--board", facts["board"]] if "board" in facts else []),
        *(["--punch-tty"] if facts.get("punch_tty") else []),
        "--reader-cps",
        "960",
        *options,
        part,
    ]
    done = subprocess.run(command, capture_output=True)
    if options:
        assert (done.returncode, done.stdout) == (
            0,
            part.with_suffix(".3b").read_bytes(),
        ), done.stderr
    else:
        assert (done.returncode, done.stdout) == (1, b"") and b"ERR 10" in done.stderr
