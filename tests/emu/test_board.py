"""The board: serial ports, operator, tape, punch, memory; driven by the tests' own firmware."""

from __future__ import annotations

import pytest
from asm8080 import assemble
from conftest import monitor

from skg.machine import Machine


@pytest.fixture(params=["6850", "8251"])
def board(request: pytest.FixtureRequest) -> str:
    """Both kinds of board."""
    return request.param


def started(board: str = "6850", **options: bool | int) -> Machine:
    """A machine at its first prompt."""
    m = Machine(monitor(board, bool(options.get("punch_tty", False))), board=board, **options)
    assert m.run() == "prompt"
    return m


def test_operator_types_when_asked(board: str) -> None:
    """Every character of a long line arrives, and the next line waits until the first has been carried out."""
    m = started(board)
    m.type("X" * 200 + "\rY\r")
    assert m.run() == "prompt"
    assert m.tty == ">" + "X" * 200 + "\r\nERR 01\r\n>Y\r\nERR 01\r\n>"
    assert m.error_lines == 2


def test_run_tells_prompt_input_and_other_waits(board: str) -> None:
    """By the paper's last line."""
    m = started(board)
    m.type("half a line")
    assert m.run() == "wait"
    m.type("\rL\r")
    m.tape("I\nW\n\x1a")
    assert m.run() == "prompt"
    m.type("R\r")
    assert m.run() == "input"
    m.type("answer\r")
    assert m.run() == "wait"
    assert m.punch == b"answer\r\n"
    m.type("k")
    assert m.run() == "prompt"


def test_pressed_key_arrives_at_once(board: str) -> None:
    """While a program runs that asks for keys now and then; typed ones wait for the prompt."""
    m = started(board)
    m.tape("J\n\x1a")
    m.type("L\rR\rZ")
    assert m.run(3_000_000) == "cycles"
    m.press(3)
    assert m.run() == "wait"
    assert m.tty.endswith("R\r\n\r\n>Z")


def test_tape_and_punch(board: str) -> None:
    """What is on the tape comes in as it is; what is punched comes out as it is; silence ends the tape."""
    m = started(board)
    m.tape("PB1B2B3GXL1\r\nThello\r\n")
    m.type("L\r")
    assert m.run() == "prompt"
    m.type("R\r")
    assert m.run() == "prompt"
    assert m.punch == b"B1B2B3GXL1\r\n"
    assert m.tty.endswith("R\r\nhello\r\n>")
    m.clear()
    assert (m.tty, m.punch) == ("", b"")


def test_teletype_alone_reads_and_punches(board: str) -> None:
    """Between DC2 and DC4 the punch hears everything; the reader's characters come in like typed ones."""
    m = started(board, punch_tty=True)
    m.tape("PB1\r\nThello\r\nPB2\r\n")
    m.type("L\r")
    assert m.run() == "wait"
    assert m.run(patience=4_000_000) == "prompt", "the reader is off, and silence ends the tape"
    m.type("L\r")
    m.reader(True)
    assert m.run(patience=4_000_000) == "prompt"
    m.type("R\r")
    assert m.run() == "prompt"
    assert m.punch == b"B1\r\nB2\r\n"
    assert m.tty.endswith("R\r\n\x12B1\r\n\x14hello\r\n\x12B2\r\n\x14>")


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
        ("0C 16 16 37", 0x85),  # synchronous, two characters
        ("8C 16 37", 0x85),  # synchronous, one character
        ("0C 16 37", 0x80),  # one too few: 37 is the second
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
    m = Machine(assemble("OUT 20H\nIN 0FH\nMOV B,A\nIN 14H\nMOV C,A\nHLT")[0])
    m.run()
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
    m.tape("T" + "x" * 98 + "\r\n\x1a")
    m.type("L\r")
    m.run()
    start = m.cycles
    m.type("R\r")
    assert m.run() == "prompt"
    per_character = 2_000_000 * bits / baud
    characters = 100 + 4  # the line; echo of R, CR and LF, and the prompt
    assert characters - 2 < (m.cycles - start) / per_character < characters + 4


def test_reset_keeps_ram_and_starts_the_ports_anew(board: str) -> None:
    """The monitor comes up again, and its program is still there."""
    m = started(board)
    m.tape("Tstill here\r\n\x1a")
    m.type("L\r")
    m.run()
    kept = m.peek(0x2100, 13)
    m.reset()
    assert m.run() == "prompt"
    assert kept[1:] == m.peek(0x2101, 12), "the monitor itself clears the first byte"
