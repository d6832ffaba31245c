"""The board: serial ports, operator, tape, punch, memory."""

from __future__ import annotations

import pytest
from asm8080 import assemble
from emuhelp import ROMS

import skg
from skg.board import Machine

CTRL_C, CTRL_Q, CTRL_S = 3, 0x11, 0x13


ROM = {"6850": ROMS / "skg.bin", "8251": ROMS / "skg-8251.bin", "alone": ROMS / "skg-tty.bin"}


@pytest.fixture(params=["6850", "8251"])
def board(request: pytest.FixtureRequest) -> str:
    """Both kinds of board."""
    return request.param


def started(board: str = "6850", **options: int) -> Machine:
    """A board at its first prompt."""
    kind = {"punch_tty": True} if board == "alone" else {"board": board}
    m = Machine(ROM[board], **kind, **options)
    assert m.run() == "prompt"
    m.clear()
    return m


def loaded(board: str, program: str) -> Machine:
    """A board with that program, at the prompt."""
    m = started(board)
    m.tape(program + "\n\x1a")
    m.type("LOAD\r")
    assert m.run() == "prompt"
    m.clear()
    return m


def test_operator_types_when_asked(board: str) -> None:
    """Every character of a long line arrives, and the next line waits until the first has been carried out."""
    m = started(board)
    m.type(f'PRINT "{"x" * 115}"\rPRINT A\r')
    assert m.run() == "prompt"
    assert m.tty == f'PRINT "{"x" * 115}"\r\n{"x" * 115}\r\n>PRINT A\r\nERR 03\r\n>'
    assert m.error_lines == 1


@pytest.mark.parametrize("kind", ROM)
@pytest.mark.parametrize("slice_cycles", [1, 300, 5000])
def test_short_slices_change_nothing(kind: str, slice_cycles: int) -> None:
    """A run is the same in short slices of cycles as in long ones."""
    m = started(kind)
    m.type("PRINT 1\r")
    end = m.cycles + 2_000_000
    while (reason := m.run(slice_cycles)) == "cycles" and m.cycles < end:
        pass
    assert (reason, m.tty) == ("prompt", "PRINT 1\r\n1\r\n>")
    whole = started(kind)
    whole.type("PRINT 1\r")
    whole.run()
    assert abs(whole.cycles - m.cycles) < slice_cycles + 2000


def test_run_tells_prompt_input_and_other_waits(board: str) -> None:
    """By the paper's last line."""
    m = loaded(board, "10 INPUT A\n20 I=0\n30 I=I+1\n40 IF I<500 GOTO 30\n50 PRINT A")
    m.type("RU")
    assert m.run() == "wait"
    m.type("N\r")
    assert m.run() == "input"
    m.type("5\r")
    assert m.run(300_000) == "cycles"
    m.press(CTRL_S)
    assert m.run() == "wait"
    m.press(CTRL_Q)
    assert m.run() == "prompt"
    assert m.tty.endswith("? 5\r\n5\r\nDD\r\n>")


def test_pressed_key_arrives_at_once(board: str) -> None:
    """While a program runs that asks for keys now and then; typed ones wait for the prompt."""
    m = loaded(board, "10 GOTO 10")
    m.type("RUN\rZ")
    assert m.run(3_000_000) == "cycles"
    m.press(CTRL_C)
    assert m.run() == "wait"
    assert m.tty == "RUN\r\nERR 10 LINE 10\r\n>Z"


def test_tape_and_punch(board: str) -> None:
    """The bytes of tape and punch pass unchanged; silence ends the tape."""
    m = started(board)
    m.tape("10 CUT O,(1,0)\r\n20 BACK\r\n")
    m.type("LOAD\r")
    assert m.run() == "prompt"
    m.type("RUN\r")
    assert m.run() == "prompt"
    assert m.punch == b"B1000B0B1000GXL1\r\nB1000B0B1000GXL3\r\nDD\r\n"
    m.clear()
    assert (m.tty, m.punch) == ("", b"")


def test_teletype_alone_reads_and_punches() -> None:
    """Between DC2 and DC4 the punch hears everything; its reader's characters come in like typed ones."""
    m = started("alone")
    m.tape("PRINT 7\rCUT O,(1,0)\rBACK\r")
    assert m.run() == "prompt"
    assert m.tty == "", "the reader is off"
    m.reader(True)
    assert m.run() == "prompt"
    assert m.tty.startswith("PRINT 7\r\n7\r\n>CUT O,(1,0)\r\n>BACK\r\n")
    assert m.punch == b"B1000B0B1000GXL1\r\nB1000B0B1000GXL3\r\n"
    assert m.tty.count("\x12") == m.tty.count("\x14") > 0


@pytest.mark.parametrize(
    ("kind", "other", "options"),
    [("6850", "8251", {"board": "8251"}), ("8251", "6850", {}), ("6850", "alone", {"punch_tty": True})],
)
def test_rom_for_another_board_is_noticed(kind: str, other: str, options: dict) -> None:
    """It asks ports that nobody serves; the one that is made for the board never does."""
    m = Machine(ROM[kind], **options)
    m.type("LOAD\r")
    assert m.run(10_000_000) == "nobody"
    m = Machine(ROM[other], **options)
    m.tape("10 END\r\x1a")
    m.type("LOAD\rRUN\r")
    assert m.run() == "prompt"


def test_6850_is_dead_until_it_is_reset() -> None:
    """No status bit, nothing printed, before a master reset and a control word."""
    send = "MVI A,41H\nOUT 11H\nIN 10H\nMOV B,A\n"
    before = "MVI A,15H\nOUT 10H\n"
    reset = "MVI A,3\nOUT 10H\n"
    m = Machine(assemble(before + send + reset + "IN 10H\nMOV C,A\n" + before + "IN 10H\nMOV D,A\n" + send + "HLT")[0])
    assert m.run() == "halt"
    assert m.tty == "A"
    r = m.registers
    assert (r["bc"], r["de"] >> 8) == (0x0200, 2)


@pytest.mark.parametrize(
    ("words", "status"),
    [
        ("4E 37", 0x85),  # asynchronous mode; both ways
        ("4E 04", 0x80),  # no sending
        ("0C 16 16 37", 0x80),  # synchronous, two characters: no line of a teletype
        ("8C 16 37", 0x80),  # synchronous, one character
        ("0C 16 16 37 40 4E 37", 0x85),  # a reset ends that
        ("8C 16 40 4E 37", 0x85),
        ("0C 16 40 4E 37", 0x80),  # 40 is the second character: it resets nothing
        ("4E 37 40", 0x80),  # reset: a mode is expected
        ("4E 37 40 4E 37", 0x85),
    ],
)
def test_8251_takes_mode_then_commands(words: str, status: int) -> None:
    """The control words of one port in their order, and the status after them."""
    out = "".join(f"MVI A,0{word}H\nOUT 11H\n" for word in words.split())
    m = Machine(assemble(out + "IN 11H\nHLT")[0], board="8251")
    assert m.run() == "halt"
    assert m.registers["a"] == status


def test_parity_bit_is_not_printed() -> None:
    """The teletype prints 7 bits; the punch punches 8."""
    setup = "MVI A,3\nOUT 10H\nOUT 12H\nMVI A,15H\nOUT 10H\nOUT 12H\n"
    m = Machine(assemble(setup + "MVI A,0C1H\nOUT 11H\nOUT 13H\nHLT")[0])
    m.run()
    assert (m.tty, m.punch) == ("A", b"\xc1")


def test_unused_ports_read_ff() -> None:
    """And take writes."""
    m = Machine(assemble("OUT 20H\nIN 0FH\nMOV B,A\nIN 15H\nMOV C,A\nHLT")[0])
    assert [m.run() for _ in range(3)] == ["nobody", "nobody", "halt"]
    assert m.registers["bc"] == 0xFFFF


@pytest.mark.parametrize(("kib", "end"), [(2, 0x2800), (8, 0x4000), (48, 0xE000), (56, 0x10000)])
def test_memory_map(kib: int, end: int) -> None:
    """ROM cannot be written, RAM ends where it should, and past it the bus reads FF."""
    sta = "MVI A,55H\nSTA 1FFFH\nSTA 2000H\n"
    m = Machine(assemble(f"{sta}STA {end - 1}\nSTA {end & 0xFFFF}\nHLT")[0], kib)
    before = m.peek(0x1FFF)
    m.run()
    assert m.ram_end == end
    assert m.peek(0x1FFF) == before == b"\xff"
    assert m.peek(0x2000) == m.peek(end - 1) == b"\x55"
    if end < 0x10000:
        assert m.peek(end) == b"\xff"
        m.poke(end, b"\0")
        assert m.peek(end) == b"\xff"
    assert m.peek(0) == b"\x3e", "address 0 is ROM"


@pytest.mark.parametrize(("baud", "bits"), [(110, 11), (300, 10), (9600, 10)])
def test_line_takes_its_time(baud: int, bits: int) -> None:
    """A character each bits/baud seconds of the 2 MHz board's time, both ways."""
    m = started(baud=baud)
    start = m.cycles
    m.type(f'PRINT "{"x" * 100}"\r')
    assert m.run() == "prompt"
    per_character = 2_000_000 * bits / baud
    needed = m.cycles - start
    working = 800_000
    assert (len(m.tty) - 2) * per_character < needed < len(m.tty) * per_character * 1.1 + working


@pytest.mark.parametrize("kind", ROM)
def test_reset_keeps_ram_and_starts_the_ports_anew(kind: str) -> None:
    """The board signs on again, and its program and variables are still there."""
    m = loaded(kind, "10 PRINT 5\nA=7")
    m.reset()
    assert m.run() == "prompt"
    m.type("LIST\rPRINT A\r")
    assert m.run() == "prompt"
    assert m.tty.startswith("\r\nSKG ")
    assert m.tty.endswith(">LIST\r\n10 PRINT 5\r\n>PRINT A\r\n7\r\n>")


@pytest.mark.parametrize("rom", ["standard", "8251"])
def test_a_new_tape_takes_the_place_of_one_that_was_refused(rom: str) -> None:
    """The unread rest of a refused tape does not get into the program of the next one."""
    board = skg.Board(rom)
    assert board.load("10 PRINT (\n20 PRINT 2\n30 PRINT 3\n")[-1] == "ERR 01"
    assert board.load("10 PRINT 1\n") == []
    assert board.type("LIST") == ["10 PRINT 1"]
    assert board.load("20 PRINT 4\n") == []
    assert board.type("LIST") == ["10 PRINT 1", "20 PRINT 4"]
