"""The 8080 core: against the plain core, and what only a host sees (interrupts, runs, watching)."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest
from asm8080 import assemble
from facthelp import pattern

from skg.board import Machine, symbols

ROOT = Path(__file__).resolve().parents[2]


def run(*command: str) -> str:
    """Standard output of a test program that must succeed."""
    done = subprocess.run([ROOT / "build" / command[0], *command[1:]], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def machine(source: str) -> Machine:
    """A board whose ROM is this program."""
    return Machine(assemble(source)[0])


def test_every_opcode_agrees_with_the_plain_core() -> None:
    """All A x operand for arithmetic and all A x flags for the rest, cycles included, in both loops."""
    assert run("emu/compare", "each") == "142606336 instructions compared\n"


@pytest.mark.parametrize("seed", [1, 1_000_000])
def test_random_programs_agree_with_the_plain_core(seed: int) -> None:
    """Noise that modifies itself, in slices of random length, with interrupts, ROM and open bus."""
    assert run("emu/compare", "streams", str(seed), "1000").startswith("1000 streams, ")


def test_random_programs_are_sound() -> None:
    """The same under the address and undefined behaviour sanitizers."""
    assert run("asan/compare", "streams", "7", "200").startswith("200 streams, ")


def test_the_small_core_agrees_with_the_plain_core() -> None:
    """The same of emu/i8080_small.c, with fewer states: its words are the large core's."""
    assert run("emu/compare", "small", "each") == "6291456 instructions compared\n"
    assert run("emu/compare", "small", "streams", "1", "400").startswith("400 streams, ")
    assert run("asan/compare", "small", "streams", "7", "200").startswith("200 streams, ")


def test_board_and_files_are_sound(tmp_path: Path) -> None:
    """Random firmware, operators, calls and ROM images under the sanitizers."""
    assert run("asan/fuzz", "7", "120", str(tmp_path / "image")).startswith("120 rounds, ")


def test_speed_is_far_above_the_plain_cores() -> None:
    """Both run the same program, by turns, and must print and count the same. (other work beside costs some of it)"""
    lines = run("emu/bench", str(ROOT / "build/emu/mix.com"), "1").splitlines()
    assert lines[-1].split()[0] == "ratio"
    assert float(lines[-1].split()[1]) >= 3.5


@pytest.mark.parametrize("image", ["skg", "skg-nodrift"])
def test_a_translation_does_what_the_fast_loop_does(image: str) -> None:
    """Registers, cycles and outputs after each slice of the examples; breakpoints and changes come and go."""
    parts = sorted(map(str, (ROOT / "examples").glob("*.skg")))
    told = run("emu/translated", str(ROOT / "roms" / f"{image}.bin"), "1", *parts)
    slices, share, ended = re.fullmatch(r"(\d+) slices, ([\d.]+) % of .* times, ended (\d+) times\n", told).groups()
    assert int(slices) > 10_000 and float(share) > 90 and int(ended) > 100, told


def test_a_translation_comes_back_to_a_breakpoint() -> None:
    """A subroutine of the ROM returns to one: what `call` waits for."""
    names, ends = symbols((ROOT / "roms" / "skg.sym").read_text()), []
    for is_translated in (True, False):
        m = Machine(ROOT / "roms" / "skg.bin")
        m.run()
        if not is_translated:
            m.poke(0, m.peek(0))
        cycles = m.cycles
        ends.append((m.call(names["CALINI"]), m.cycles - cycles, m.registers))
        assert m.is_translated == is_translated
    assert ends[0] == ends[1]
    assert ends[0][0] == "returned"


def test_the_library_has_translations() -> None:
    """Of the ROMs that `skg` runs most often; a byte changed in the ROM ends one."""
    for image in ("skg", "skg-nodrift"):
        m = Machine(ROOT / "roms" / f"{image}.bin")
        assert m.is_translated
        m.poke(0x1FFF, bytes([m.peek(0x1FFF, 1)[0] ^ 1]))
        m.run()
        assert m.tty.endswith(">")
        m.poke(0, m.peek(0, 1))
        assert not m.is_translated
    assert not Machine(ROOT / "roms" / "skg-tty.bin").is_translated


def test_interrupt_is_taken_after_the_instruction_that_follows_ei() -> None:
    """EI RET: the interrupt comes after RET, not between."""
    m = machine(
        """
        LXI SP,2800H
        CALL SUB
        HLT
        ORG 10H
        INR B
        RET
        ORG 20H
SUB:    EI
        RET
        """
    )
    m.set_registers(bc=0)
    m.interrupt(0xD7)  # RST 2
    assert m.run(27) == "cycles"  # LXI, CALL: interrupts are off
    assert m.registers["pc"] == 0x20
    m.run(4)
    assert m.registers["pc"] == 0x21
    m.run(10)
    assert m.registers["pc"] == 0x06, "not between EI and RET"
    m.run(11)
    assert m.registers["pc"] == 0x10
    assert m.peek16(m.registers["sp"]) == 0x06
    assert m.run(22) == "cycles"  # INR, RET
    assert m.run() == "halt", "taken once only"
    assert m.registers["bc"] == 0x0100
    assert m.cycles == 10 + 17 + 4 + 10 + 11 + 5 + 10 + 7


def test_interrupt_ends_hlt() -> None:
    """PC on the stack is the instruction after HLT; time stands still while halted."""
    m = machine("LXI SP,2800H\nEI\nHLT\nINR B\nHLT\nORG 38H\nRET")
    m.set_registers(bc=0)
    assert m.run() == "halt"
    assert (m.registers["pc"], m.cycles) == (5, 21)
    assert m.run() == "halt"
    assert m.cycles == 21
    m.interrupt(0xFF)
    assert m.run() == "halt"
    assert (m.registers["pc"], m.registers["bc"]) == (7, 0x0100)
    assert m.cycles == 21 + 11 + 10 + 5 + 7


def test_interrupt_waits_while_they_are_off() -> None:
    """Raised after DI: never taken; a halted board then stays halted."""
    m = machine("LXI SP,2800H\nEI\nDI\nNOP\nHLT")
    m.interrupt(0xFF)
    assert m.run() == "halt"
    assert m.registers["pc"] == 7
    assert m.registers["sp"] == 0x2800


def test_device_may_put_a_call_on_the_bus() -> None:
    """A three-byte instruction, as an 8259 gives it: PC is not counted up while it is fetched."""
    m = machine("LXI SP,2800H\nEI\nNOP\nNOP\nHLT\nORG 40H\nHLT")
    m.run(14)
    m.interrupt(0xCD, 0x40, 0x00)
    assert m.run() == "halt"
    assert m.registers["pc"] == 0x41
    assert m.peek16(0x27FE) == 5


def test_reset_keeps_registers_and_memory() -> None:
    """And starts at 0 with interrupts off."""
    m = machine("LXI SP,2800H\nMVI A,5\nSTA 2000H\nEI\nHLT")
    m.run()
    m.reset()
    assert m.registers["a"] == 5
    assert m.registers["pc"] == 0
    assert m.peek(0x2000) == b"\5"
    m.interrupt(0xFF)
    m.run(10)
    assert m.registers["pc"] == 3, "the interrupt is not taken"


def test_run_ends_at_the_first_instruction_that_uses_the_cycles_up() -> None:
    """Exactly, for every length of run."""
    m = machine("LOOP: INR A\nJMP LOOP")
    for cycles in range(1, 200):
        before = m.cycles
        assert m.run(cycles) == "cycles"
        assert cycles <= m.cycles - before < cycles + 10


def test_breakpoint_stops_before_its_instruction() -> None:
    """Every time, and no more once it is taken away."""
    m = machine("LOOP: INR A\nNOP\nJMP LOOP")
    m.set_registers(a=0)
    m.set_break(1)
    assert m.run() == "break"
    assert m.registers["pc"] == 1
    assert m.registers["a"] == 1
    m.set_break(1, False)
    assert m.run(100) == "cycles"


def test_program_in_ram_may_change_itself() -> None:
    """A decoded instruction is decoded again after it was written to, by the program or the host."""
    m = machine("LXI H,2010H\nLXI SP,2800H\nCALL 2000H\nHLT")
    m.poke(0x2000, assemble("CALL 2010H\nMVI M,04H\nCALL 2010H\nRET")[0])  # 04: INR B
    m.poke(0x2010, assemble("INR C\nRET")[0])
    m.set_registers(bc=0)
    assert m.run() == "halt"
    assert m.registers["bc"] == 0x0101
    m.poke(0x2000, assemble("MVI C,77H\nRET")[0])
    m.reset()
    assert m.run() == "halt"
    assert m.registers["bc"] == 0x0177


def test_watching_counts_marks_and_strays() -> None:
    """Lowest SP of pushes, instructions outside the ROM."""
    m = machine("LXI SP,2800H\nPUSH B\nPUSH B\nPOP B\nCALL 2000H\nHLT")
    m.poke(0x2000, b"\0\xc9")
    m.watch()
    assert m.run() == "halt"
    assert m.lowest_sp == 0x27FC
    assert m.fetches_outside == 2
    assert m.first_outside == 0x2000
    m.watch(False)
    m.reset()
    m.run()
    assert m.fetches_outside == 2


def test_batch_runs_a_subroutine_for_every_record() -> None:
    """Input bytes, registers, output bytes, cycles and registers of each call."""
    source = "LDAX B\nADD M\nSTAX D\nRET"
    m = machine(source)
    data = bytes(range(256)) * 4
    batch = m.batch(0, 512, data, 0x2000, 0x2100, 1, bc=0x2000, hl=0x2001, de=0x2100, max_cycles=100)
    assert batch.outputs == bytes((data[2 * i] + data[2 * i + 1]) & 255 for i in range(512))
    assert not batch.failures
    assert set(batch.cycles) == {7 + 7 + 7 + 10}
    assert list(batch.registers["a"]) == list(batch.outputs)
    assert set(batch.registers["sp"]) == {0x4000}


def test_batch_says_how_each_call_ended() -> None:
    """By the first byte of its record: return, for ever, a stop address, HLT, waiting for a key."""
    source = """
        LDA 2000H
        DCR A
        RM
LOOP:   JZ LOOP
        DCR A
        JZ ERROR
        DCR A
        JZ STOP
WAIT:   IN 10H
        ANI 1
        JZ WAIT
        RET
STOP:   HLT
ERROR:  INR B
        RET
"""
    image, symbols = assemble(source)
    setup, _ = assemble("MVI A,3\nOUT 10H\nMVI A,15H\nOUT 10H\nRET")
    m = Machine(image + bytes(0x100 - len(image)) + setup)
    assert m.call(0x100) == "returned"
    batch = m.batch(0, 6, bytes([0, 1, 2, 3, 4, 0]), 0x2000, 0, 0, max_cycles=5000, stops=[symbols["ERROR"]])
    assert list(batch.ends) == [0, 1, 2, 3, 4, 0]
    assert batch.failures == [1, 2, 3, 4]
    assert batch.registers["pc"][2] == symbols["ERROR"]
    assert m.call(0, 5000, stops=[symbols["ERROR"]]) == "returned"
    m.poke(0x2000, b"\2")
    assert m.call(0, 5000) == "returned", "the stop address is gone"


def test_machine_refuses_what_cannot_be() -> None:
    """A ROM too long, RAM out of range, records that do not divide."""
    with pytest.raises(ValueError, match="8193 bytes"):
        Machine(bytes(8193))
    with pytest.raises(ValueError, match="RAM of 57"):
        Machine(b"", 57)
    with pytest.raises(ValueError, match=pattern("3 input bytes", "2 calls")):
        Machine(b"\xc9").batch(0, 2, b"abc", 0x2000, 0, 0)
