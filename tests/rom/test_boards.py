"""The ROM of every board: two 6850s, two 8251s, a teletype with its own punch and reader, RC2014s with ACIA and SIO."""

from __future__ import annotations

import re
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
from romhelp import BLOCK, BOARDS, ROOT, RUN_LIMIT, SOME_EXAMPLES, Board, image, saved_tape
from test_build import build, built
from test_examples import EXAMPLES, stem

from skg.board.emulator import Machine

PAGE = (ROOT / "docs" / "boards.md").read_text()
CTRL_C, XON, DC2, XOFF, DC4, CTRL_Z = 3, 0x11, 0x12, 0x13, 0x14, 26
SECOND = 2_000_000
OPTIONS = {
    "skg": [],
    "skg-8251": ["--board", "8251"],
    "skg-tty": ["--punch-tty"],
    "skg-rc2014": ["--board", "rc2014"],
    "skg-rc2014-sio": ["--board", "rc2014-sio"],
    "skg-minimax8085": ["--board", "minimax8085"],
    "skg-rcbus8085": ["--board", "rcbus8085"],
}
#: A route that goes on until somebody breaks in.
ENDLESS = ["10 CUT (0,0)", "20 I=I+1", "30 CUT (I,I/3),(0,I)", "40 GOTO 20", "5 I=0"]

every_board = pytest.mark.parametrize("kind", BOARDS)


def typed(board: Board, part: Path) -> None:
    """Type a program's lines, at which nothing is printed."""
    for line in part.read_text().splitlines():
        assert board.type(line) == [], line


def test_the_boards_are_all_that_there_are_images_for() -> None:
    """Those that differ from the standard one by the board alone: others write another tape, or have other words."""
    standard = build.IMAGES["skg"]
    board = {seam: getattr(standard, seam) for seam in ("map", "restarts", "ports", "punch", "start")}
    alone = {
        name for name, other in build.IMAGES.items() if ".bin" in other.forms and replace(other, **board) == standard
    }
    alone.remove("skg-8085")  # an 8085's lines are followed in test_sid.py
    assert alone == set(BOARDS), "a row in BOARDS of romhelp.py"
    assert alone == set(OPTIONS), "a row in OPTIONS"


#: What is not the board's is the same in all of them: a third of the examples there, all on the first.
TYPED = [(kind, part) for kind in BOARDS for part in (EXAMPLES if kind == "skg" else SOME_EXAMPLES)]


@pytest.mark.parametrize(("kind", "part"), TYPED, ids=lambda value: value if isinstance(value, str) else value.stem)
def test_typed_and_punched(kind: str, part: Path) -> None:
    board = Board(kind=kind)
    typed(board, part)
    board.machine.clear()
    paper = board.type("RUN")
    tape = part.with_suffix(".3b").read_bytes()
    assert board.machine.punch == tape
    # On the paper every block has its number; what switches the punch is not printed.
    listed = [line for each in paper if BLOCK.fullmatch(line := each.translate({DC2: None, DC4: None}))]
    assert [line.split()[-1] for line in listed] == tape.decode().split()


@every_board
@pytest.mark.parametrize(
    "part", [part for part in EXAMPLES if part.stem in ("ratchet", "wrench", "xy-star")], ids=lambda part: part.stem
)
def test_saved_and_loaded(kind: str, part: Path) -> None:
    """SAVE, NEW and LOAD of the punched tape give the same program, and it cuts the same."""
    board = Board(kind=kind)
    typed(board, part)
    listed = board.listing()
    board.machine.clear()
    board.type("SAVE")
    saved = board.machine.punch
    assert saved == saved_tape(listed, kind)
    assert board.type("NEW") == board.listing() == []
    board.machine.tape(saved)
    board.type("LOAD")
    assert board.listing() == listed
    board.machine.clear()
    board.type("RUN")
    assert board.machine.punch == part.with_suffix(".3b").read_bytes()


@every_board
def test_broken_off(kind: str) -> None:
    """Ctrl-C: whole blocks, a stop, and the teletype's punch is off."""
    board = Board(kind=kind)
    for line in ENDLESS:
        assert board.type(line) == []
    board.machine.clear()
    board.machine.type("RUN\r")
    assert board.machine.run(5 * SECOND) == "cycles"
    board.machine.press(CTRL_C)
    assert board.machine.run(SECOND) == "prompt"
    *blocks, stop = board.machine.punch.decode().removesuffix("\r\n").split("\r\n")
    assert len(blocks) > 3
    assert stop == "D"
    assert all(re.fullmatch(r"B\d+B\d+B\d+G[XY]L[1-4]", block) for block in blocks)
    board.machine.clear()
    board.type("PRINT 1")
    assert board.machine.punch == b""


def test_broken_off_where_no_block_goes_out() -> None:
    """Copies of a circle about its own centre are the circle: a thousand of them, and no block."""
    board = Board()
    for line in ["10 CUT O:1.5", "20 REP 1000,10", "30 END"]:
        assert board.type(line) == []
    board.machine.type("RUN\r")
    assert board.machine.run(2 * SECOND) == "cycles"
    board.machine.press(CTRL_C)
    assert board.machine.run(2 * SECOND) == "prompt"


@every_board
def test_a_torn_tape(kind: str) -> None:
    """The reader runs out in a line: ERR 10, the prompt, and typed lines come from the keyboard again."""
    board = Board(kind=kind)
    board.machine.tape("10 END\r\n20 PRI")
    board.machine.type("LOAD\r")
    assert board.machine.run(RUN_LIMIT, patience=5 * SECOND) == "prompt"
    assert board.machine.tty.endswith("ERR 10\r\n>")
    assert board.listing() == ["10 END"]


def test_a_teletype_alone_is_told_what_to_do() -> None:
    """DC2 and DC4 around each block and each stop, DC1 and DC3 around what is loaded, and an error ends both."""
    board = Board(kind="skg-tty")
    lines = "".join(f"{line}\r\n" for line in ("10 FROM (0,1)", "20 CUT (0,0),(1,0)", "30 END", "40 PRINT"))
    board.machine.tape(lines + chr(CTRL_Z))
    start = len(board.machine.tty)
    board.type("LOAD")
    assert board.machine.tty[start:] == f"LOAD\r\n{chr(XON)}{chr(DC4)}{chr(XOFF)}>", "both off at its end"
    board.machine.clear()
    board.type("RUN")
    on, off = chr(DC2), chr(DC4)
    blocks = re.findall(f"{on}(.*?){off}", board.machine.tty, re.S)
    assert [block.strip() for block in blocks] == ["B0B1000B1000GYL4", "B1000B0B1000GXL1", "DD"]
    assert "".join(blocks).encode() == board.machine.punch
    board.machine.clear()
    assert board.type("PRINT A")[-1].endswith("ERR 03")
    assert off in board.machine.tty and chr(XOFF) in board.machine.tty


def loaded_at_9000() -> Machine:
    """An RC2014 whose ROM goes to 9000, where a monitor has loaded the firmware, at its first prompt."""
    machine = Machine(b"\xc3\x00\x90", 32, board="rc2014", punch_tty=True)  # JMP 9000H
    for row in image("skg").with_name("skg-rc2014-ram.hex").read_text().split():
        record = bytes.fromhex(row[1:])
        if record[3] == 0:
            machine.poke(int.from_bytes(record[1:3], "big"), record[4:-1])
    assert machine.run() == "prompt"
    return machine


@pytest.mark.parametrize("part", EXAMPLES, ids=stem)
def test_loaded_by_a_monitor(part: Path) -> None:
    machine = loaded_at_9000()
    machine.tape(part.read_bytes() + bytes([CTRL_Z]))
    for line in ("LOAD", "RUN"):
        machine.type(f"{line}\r")
        machine.clear()
        assert machine.run(RUN_LIMIT) == "prompt"
    assert machine.punch == part.with_suffix(".3b").read_bytes()


@every_board
@pytest.mark.parametrize("name", ["xy-fig1-loop", "plate-fillets"])
def test_skg80(kind: str, name: str) -> None:
    """The emulator's program with this board's ROM LOADs and RUNs an example."""
    part = ROOT / "examples" / f"{name}.skg"
    command = [ROOT / "build" / "skg80", *OPTIONS[kind], "--rom", image(kind), part]
    done = subprocess.run(command, capture_output=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout == part.with_suffix(".3b").read_bytes()


OTHERS = [
    ("skg", "8251"),
    ("skg-8251", "6850"),
    ("skg", "rc2014"),
    ("skg-8251", "rc2014"),
    ("skg-rc2014", "6850"),
    ("skg-rc2014", "8251"),
]


@pytest.mark.parametrize(("kind", "other"), OTHERS)
def test_the_wrong_rom_is_noticed(kind: str, other: str) -> None:
    """The boards are really others; where there is no RAM, nothing is ever printed."""
    command = [ROOT / "build" / "skg80", "--board", other, "--rom", image(kind), EXAMPLES[0]]
    done = subprocess.run(command, capture_output=True)
    assert (done.returncode, done.stdout) == (2, b""), done.stderr
    assert b"--board" in done.stderr
    done = subprocess.run(command[:-1], capture_output=True, input=b"LOAD\n")
    assert done.returncode == 2 and b"--board" in done.stderr


@pytest.mark.xdist_group("images")  # (in one process with test_build.py, which assembles the other image, too)
@pytest.mark.parametrize("kind", ["skg-searle", "skg-imsai"])
def test_board_of_ones_own(kind: str, tmp_path: Path) -> None:
    """The examples of boards.md differ from the image that they are made after in the numbers of ports alone."""
    files = {found[1]: found[0] for found in re.findall(r"```asm\n(; (\w+)\.asm(?s:.*?))```", PAGE)}
    image = eval(re.search(rf'"{kind}": (Image\(.*\)),', PAGE)[1], {"Image": build.Image})  # noqa: S307 (of the page)
    (ports,) = [name for name in image.ports if name in files]
    other = {"skg-searle": "skg-rc2014-sio", "skg-imsai": "skg-8251"}[kind]
    texts = build.sources(replace(image, ports=tuple(name for name in image.ports if name != ports)))
    texts = {name: texts.get(name, files.get(name)) for name in image.files()}
    code, symbols, *_ = build.assemble({kind: texts}, tmp_path)[kind]
    made, theirs, *_ = built(other)
    names = ("TTYST", "TTYDT", "PUNST", "PUNDT")
    port_of = {theirs[name]: symbols[name] for name in names}
    differing = [(a, b) for a, b in zip(made, code, strict=False) if a != b]
    assert len(code) <= len(made)
    assert len(differing) > 10
    assert all(port_of.get(a) == b for a, b in differing)
