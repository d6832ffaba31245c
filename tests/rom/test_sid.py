"""roms/skg-8085.bin on an 8085's own lines: SID and SOD are followed bit by bit, with the 8085's cycles.

The emulator is an 8080, for which RIM and SIM do nothing. Where these stand each instruction is carried out by itself:
its cycles are Intel's for the 8085, RIM gets the level of SID, SIM's level is written down. Elsewhere time does not
matter.
"""

from __future__ import annotations

import pytest
from romhelp import ROOT
from test_build import labels

from skg.board.emulator import Machine

#: In one process with test_build.py, which assembles the image.
pytestmark = pytest.mark.xdist_group("images")

CLOCK, BAUD = 3_072_000, 2400
BIT = CLOCK / BAUD
RIM, SIM, CTRL_C = 0x20, 0x30, "\x03"
#: Cycles of the 8085's instructions that stand there: taken, not taken.
CYCLES = {
    0x01: 10, 0x11: 10, 0x21: 10, 0xC5: 12, 0xD5: 12, 0xC1: 10, 0xD1: 10, 0xE5: 12, 0xE1: 10, 0x1B: 6, 0xF3: 4, 0x17: 4,
    0x1F: 4, 0x37: 4, 0xFE: 7, 0xE6: 7, 0x36: 10, 0x7E: 7, 0x77: 7, 0xC3: 10, 0xC9: 10, 0xCD: 18, RIM: 4, SIM: 4,
}  # fmt: skip
JUMPS, RETURNS, CALLS = (
    {base | code << 3 for code in range(8)} for base in (0xC2, 0xC0, 0xC4)
)  # (taken: 10, 12, 18; not: 7, 6, 9)


def cycles(opcode: int, taken: bool) -> int:
    """Cycles of an instruction."""
    if opcode in JUMPS:
        return 10 if taken else 7
    if opcode in RETURNS:
        return 12 if taken else 6
    if opcode in CALLS:
        return 18 if taken else 9
    if opcode in CYCLES:
        return CYCLES[opcode]
    if opcode & 0xC7 == 0x06:  # MVI r
        return 7
    assert opcode & 0xC6 == 0x04 or 0x40 <= opcode < 0xC0, f"{opcode:02X}"  # INR, DCR; MOV and arithmetic of registers
    return 7 if opcode < 0xC0 and opcode >= 0x40 and opcode & 7 == 6 else 4


class Line:
    """An 8085 with a teletype at SID and SOD."""

    def __init__(self) -> None:
        self.rom = (ROOT / "roms" / "skg-8085.bin").read_bytes()
        self.machine = Machine(self.rom, 8, board="rc2014")
        self.registers = self.machine.registers  # as they are now
        names = labels("skg-8085")
        self.room = {*range(names["BDINIT"], names["SIDBRK"] + 5), *range(names["LISTEN"], names["LEXTOK"])}
        self.entries = {names[name] for name in ("BDINIT", "PAPER", "POLL", "LISTEN")}
        for entry in self.entries:
            self.machine.set_break(entry)
        self.now = 0.0
        self.sent: list[tuple[float, bool]] = []  # SOD's changes
        self.typed: list[tuple[float, float, str]] = []  # begin, length of a bit, character ("" is a break of 0.3 s)
        self.waits = names["LISTEN"]
        self.asked = 0

    def sid(self) -> bool:
        """The level of SID now."""
        for begin, bit, character in self.typed:
            at = int((self.now - begin) // bit)
            if not character and 0 <= self.now - begin < 0.3 * CLOCK:
                return False
            if character and 0 <= at < 9:
                return at > 0 and bool(ord(character) >> at - 1 & 1)
        return True

    def step(self) -> None:
        """One instruction in the room."""
        before = self.registers
        pc = before["pc"]
        opcode = self.rom[pc]
        if pc == self.waits:
            self.asked += 1
        if opcode == RIM:
            self.machine.set_registers(a=self.sid() << 7)
        elif opcode == SIM and before["a"] & 0x40:
            self.sent.append((self.now, bool(before["a"] & 0x80)))
            self.asked = 0
        if pc in self.entries:
            self.machine.set_break(pc, False)
        self.machine.run(1)
        if pc in self.entries:
            self.machine.set_break(pc)
        self.registers = self.machine.registers
        length = {0xC3: 3, 0xCD: 3}.get(opcode, 3 if opcode in JUMPS | CALLS else 1 if opcode in RETURNS else 0)
        self.now += cycles(opcode, taken=self.registers["pc"] != pc + length)

    def run(self, asked: int = 40, limit: float = 60.0) -> None:
        """Until the board has asked for a key so often in vain, with nothing on its way."""
        end = self.now + limit * CLOCK
        self.asked = 0
        while self.asked < asked or any(begin > self.now - 12 * BIT for begin, *_ in self.typed):
            assert self.now < end, self.paper()
            if self.registers["pc"] in self.room:
                self.step()
            else:
                since = self.machine.cycles
                assert self.machine.run(100_000_000) == "break"
                self.now += self.machine.cycles - since
                self.registers = self.machine.registers

    def type(self, text: str, pause: float = 30.0, drift: float = 1.0) -> None:
        """Type characters, each `pause` bits behind the beginning of the last; the rate is wrong by a factor."""
        for count, character in enumerate(text):
            self.typed.append((self.now + (count * pause + 3.3) * BIT, BIT * drift, character))

    def paper(self) -> str:
        """What a teletype of exactly the rate has printed: each bit is looked at in its middle."""

        def level(moment: float) -> bool:
            return next((is_high for at, is_high in reversed(self.sent) if at <= moment), True)

        text, free = "", 0.0
        for at, is_high in self.sent:
            if not is_high and at >= free:
                bits = [level(at + (count + 1.5) * BIT) for count in range(9)]
                assert bits[8], "a stop bit"
                text += chr(sum(bit << count for count, bit in enumerate(bits[:7])))
                free = at + 9.6 * BIT
        return text


@pytest.fixture
def line() -> Line:
    """A board at its first prompt."""
    line = Line()
    line.run()
    assert line.paper().strip().startswith("SKG ") and line.paper().endswith(">")
    line.sent.clear()
    return line


@pytest.mark.parametrize("drift", [1.0, 0.98, 1.02])
def test_a_line_is_typed_and_answered(line: Line, drift: float) -> None:
    """At the rate and 2 % beside it."""
    line.type("PRINT 2+3\r", drift=drift)
    line.run()
    assert line.paper() == "PRINT 2+3\r\n5\r\n>"


def test_what_comes_while_it_echoes_is_told(line: Line) -> None:
    """Pasted, each character is lost in the echo of the one before: error 10, and nothing of the line is taken."""
    line.type("10 END\r", pause=10.5)
    line.run()
    line.type("\r")
    line.run()
    assert "ERR 10" in line.paper(), line.paper()
    line.sent.clear()
    line.type("LIST\r")
    line.run()
    assert line.paper() == "LIST\r\n>"


def test_a_break_ends_a_program(line: Line) -> None:
    line.type("10 GOTO 10\r")
    line.run()
    line.type("RUN\r")
    line.typed.append((line.now + 500 * BIT, BIT, ""))
    line.run(limit=120)
    assert "ERR 10 LINE 10" in line.paper()
    line.sent.clear()
    line.type(CTRL_C)
    line.run()
    assert "ERR 10" in line.paper(), "ctrl-C at the prompt"


def test_bits_are_as_long_as_they_should_be(line: Line) -> None:
    """SOD is set for each bit anew."""
    line.type("PRINT 1\r")
    line.run()
    # (what is low is in a character; it is high between them, too)
    lengths = [
        (then - at) / BIT for (at, is_high), (then, _) in zip(line.sent, line.sent[1:], strict=False) if not is_high
    ]
    assert len(lengths) > 50
    assert all(abs(length - 1) < 0.01 for length in lengths)
