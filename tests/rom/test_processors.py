"""The images on processors that somebody else wrote: the 8080 and the Z80 of the package `z80`.

A Z80 runs 8080 code but for parity, which is overflow there after arithmetic, DAA after a subtraction, and opcodes
that the 8080 has no use for. Each example gives the committed tape on either processor. The serial ports are the
test's own, and so is what it takes for a prompt.
"""

from __future__ import annotations

from pathlib import Path

import pytest
import z80
from romhelp import ROM, ROOT, SOME_EXAMPLES, fault
from romhelp import Board as OwnBoard
from test_examples import stem

from skg.ref import run as reference
from skg.tape.controller import drive_steps
from skg.tape.text import read as read_tape

RAM, RAM_END = 0x2000, 0x4000
PROMPT = b"\r\n>"
DC1, DC2, DC3, DC4, CTRL_Z = 0x11, 0x12, 0x13, 0x14, 0x1A
#: So often the board looks at the teletype in vain before the next character is there.
POLLS = 20
#: The most ticks for one command: 4 minutes at 2 MHz.
PATIENCE = 2_000_000_000

PROCESSORS = {"8080": z80.I8080Machine, "Z80": z80.Z80Machine}
#: Image, and the numbers of its ports: the teletype's status and data, the punch's and reader's; then the bits of
#: the status that say received and may send. The teletype alone has one data port for both (port 2 is readied though).
BOARDS = {
    "skg": (0x10, 0x11, 0x12, 0x13, 1, 2),
    "skg-nodrift": (0x10, 0x11, 0x12, 0x13, 1, 2),
    "skg-8251": (0x11, 0x10, 0x13, 0x12, 2, 1),
    "skg-tty": (0x10, 0x11, 0x12, 0x11, 1, 2),
    "skg-mill": (0x10, 0x11, 0x12, 0x13, 1, 2),
    "skg-grbl": (0x10, 0x11, 0x12, 0x13, 1, 2),
    "skg-drive": (0x10, 0x11, 0x12, 0x13, 1, 2),
}
#: The port of the motors, and its bits: the pulses out, the feed clock in.
DRIVE, PULSES, CLOCK = 0x14, 0x05, 0x01
#: What a machine says to the image that waits for it.
OK = b"[MSG:x]\r\nok\r\n"
MILLED = sorted((ROOT / "examples" / "mill").glob("*.skg"))


class Board:
    """A processor with an image, 8 KiB of RAM and two serial ports (one: `skg-tty`), at its first prompt."""

    def __init__(self, processor: str, name: str = "skg") -> None:
        self.cpu = PROCESSORS[processor]()
        self.status, self.data, self.punch_status, self.punch_data, self.received, self.ready = BOARDS[name]
        self.alone, self.answers = self.data == self.punch_data, name == "skg-grbl"
        self.sent, self.paper, self.punched = bytearray(), bytearray(), bytearray()
        self.keys, self.reader = bytearray(), bytearray()
        self.stray: list[int] = []
        self.polls, self.moves = 0, False  # (the teletype's reader moves between DC1 and DC3)
        self.cpu.set_memory_block(0, b"\xff" * 0x10000)
        self.cpu.set_memory_block(0, ROM.with_name(f"{name}.bin").read_bytes())
        self.cpu.set_memory_block(RAM, b"\xa5" * (RAM_END - RAM))
        self.cpu.set_write_callback(self._write)
        self.cpu.mark_addrs(0, RAM, self.cpu.WRITE_MARK)
        self.cpu.mark_addrs(RAM_END, 0x10000 - RAM_END, self.cpu.WRITE_MARK)
        self.cpu.set_input_callback(self._input)
        self.cpu.set_output_callback(self._output)
        self.cpu.pc = 0
        self.run()

    def _write(self, address: int, value: int) -> None:
        """Nothing is there to write to; only the search for the end of RAM tries, at its first byte."""
        if address != RAM_END:
            self.stray.append(address)

    def _asks(self) -> bool:
        return self.paper.endswith(PROMPT)

    def _input(self, port: int) -> int:
        port &= 0xFF  # (a Z80 has A on the upper half)
        waiting = self.keys or (self.reader if self.moves else b"")
        if port == self.status:
            self.polls += 1
            return self.ready | (self.received if waiting and self.polls > POLLS else 0)
        if port == self.data:
            self.polls = 0
            return waiting.pop(0)
        if port == self.punch_status:
            return self.ready | (self.received if self.reader else 0)
        assert port == self.punch_data, f"{port:02X} is no port"
        return self.reader.pop(0)

    def _output(self, port: int, value: int) -> None:
        port &= 0xFF
        if port == self.data:
            self.sent.append(value)
            if not DC1 <= value <= DC4:
                self.paper.append(value)
            self.polls = 0
            if self.alone and value in (DC1, DC3):
                self.moves = value == DC1
        elif port == self.punch_data:
            self.punched.append(value)
            if self.answers and value == ord("\n"):
                self.reader += OK
        else:
            assert port in (self.status, self.punch_status), f"{port:02X} is no port"

    def run(self) -> None:
        """On to a prompt with nothing left to type."""
        self.cpu.ticks_to_stop = PATIENCE
        while not self._asks() or self.keys:
            self.cpu.run()  # (comes back after every frame of some 100,000 ticks)
            assert self.cpu.ticks_to_stop, bytes(self.paper[-300:])
        assert not self.stray, f"written where no RAM is: {self.stray[0]:04X}"

    def type(self, line: str) -> list[str]:
        """Types a line and returns the output up to the next prompt, without the echo."""
        start = len(self.paper)
        self.keys += line.encode() + b"\r"
        self.run()
        return self.paper[start:].decode().removesuffix(">").split("\r\n")[1:-1]

    def tape(self, source: str) -> bytes:
        """Loads and runs a program and returns the tape punched."""
        self.reader += source.replace("\n", "\r\n").encode() + bytes([CTRL_Z])
        for command in "LOAD", "RUN":
            start = len(self.sent)
            printed = self.type(command)
            assert fault(printed) is None, printed
        return self.between(self.sent[start:]) if self.alone else bytes(self.punched)

    @staticmethod
    def between(paper: bytes) -> bytes:
        """The tape of the teletype's own punch: all characters between DC2 and DC4."""
        return b"".join(part.partition(bytes([DC4]))[0] for part in paper.split(bytes([DC2]))[1:])


class DrivingBoard(Board):
    """The image that steps two motors; the clock is the pulses' inverse."""

    def __init__(self, processor: str) -> None:
        self.drive, self.steps = 0, bytearray()
        super().__init__(processor, "skg-drive")

    def _input(self, port: int) -> int:
        if port & 0xFF == DRIVE:
            return 0 if self.drive & PULSES else CLOCK
        return super()._input(port)

    def _output(self, port: int, value: int) -> None:
        if port & 0xFF == DRIVE:
            if value & ~self.drive & PULSES:
                self.steps.append(value)
            self.drive = value
        else:
            super()._output(port, value)


@pytest.mark.parametrize("processor", PROCESSORS)
@pytest.mark.parametrize("part", SOME_EXAMPLES, ids=stem)
def test_tape(part: Path, processor: str) -> None:
    assert Board(processor).tape(part.read_text()) == part.with_suffix(".3b").read_bytes()


@pytest.mark.parametrize("processor", PROCESSORS)
@pytest.mark.parametrize("name", ["skg-8251", "skg-tty", "skg-nodrift"])
@pytest.mark.parametrize("stem", ["wrench", "skg09-link", "plate-fillets", "sym-keyhole", "fit-spiral"])
def test_other_images(stem: str, name: str, processor: str) -> None:
    part = ROOT / "examples" / f"{stem}.skg"
    drift = name != "skg-nodrift"
    tape = part.with_suffix(".3b").read_bytes() if drift else reference(part.read_text(), drift=False).tape
    assert Board(processor, name).tape(part.read_text()) == tape


@pytest.mark.parametrize(("name", "processor"), [("skg-mill", "8080"), ("skg-grbl", "Z80")])
@pytest.mark.parametrize("part", MILLED, ids=stem)
def test_mills(part: Path, name: str, processor: str) -> None:
    tape = part.with_suffix(".nc").read_bytes()
    wanted = tape if name == "skg-mill" else tape.replace(b"\r\n", b"\n")
    assert Board(processor, name).tape(part.read_text()) == wanted


@pytest.mark.parametrize("processor", PROCESSORS)
@pytest.mark.parametrize("stem", ["sym-keyhole", "xy-notched-disc"])
def test_drive(stem: str, processor: str) -> None:
    """Each step of a tape that is followed, and of a run's blocks: the controller's."""
    part = ROOT / "examples" / f"{stem}.skg"
    wanted = b"".join(drive_steps(read_tape(str(part.with_suffix(".3b")))))
    board = DrivingBoard(processor)
    board.reader += part.with_suffix(".3b").read_bytes()
    assert fault(board.type("DRIVE")) is None
    assert bytes(board.steps) == wanted
    board.steps.clear()
    board.type("DRIVE 1")
    assert board.tape(part.read_text()) == part.with_suffix(".3b").read_bytes()
    assert bytes(board.steps) == wanted
    assert board.drive == 0


@pytest.mark.parametrize("processor", PROCESSORS)
def test_paper(processor: str) -> None:
    """Numbers of all sizes, functions, a program listed: as on the project's own board."""
    lines = [*(f"PRINT SQR {n},1/{n},{n}*{n},SIN {n},ATG {n}" for n in (2, 3, 7, 0.001, 12345.678, 1e12))]
    lines += ["10 P1=(1.5,-2E-7)#90", "20 C1=(3,4):5;1", "LIST", "PRINT 1+", "FOO", "PRINT 1/0", "GOTO 7", "FREE"]
    theirs, ours = Board(processor), OwnBoard()
    for line in lines:
        assert theirs.type(line) == ours.type(line), line
