"""The small core on a microcontroller: the ROM on a Cortex-M0 with 16 KiB of RAM, qemu's micro:bit."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from emuhelp import ROOT, without_sign_on

GCC, SIZE, QEMU = "arm-none-eabi-gcc", "arm-none-eabi-size", "qemu-system-arm"
FLASH, RAM = 24 * 1024, 9 * 1024
#: SysTick counts at 16 MHz, and with -icount an instruction of the host takes a nanosecond.
INSTRUCTIONS_A_TICK = 62.5


@pytest.fixture(scope="module")
def firmware(build: Callable[..., None]) -> Path:
    """The program for the micro:bit."""
    for program, package in ((GCC, "gcc-arm-none-eabi"), (QEMU, "qemu-system-arm")):
        if not shutil.which(program):
            pytest.skip(f"no {program} here: apt-get install {package}")
    found = subprocess.run([GCC, "-print-file-name=nano.specs"], capture_output=True, text=True).stdout.strip()
    if not Path(found).is_absolute():  # else it is the name again
        pytest.skip("no newlib for ARM here: apt-get install libnewlib-arm-none-eabi")
    build("build/emu/micro.elf")
    return ROOT / "build" / "emu" / "micro.elf"


def test_it_fits(firmware: Path) -> None:
    """Flash with the ROM, RAM with the board's 8 KiB; a stack of 2 KiB is the linker's to find."""
    told = subprocess.run([SIZE, firmware], capture_output=True, text=True).stdout.splitlines()
    text, data, bss = map(int, told[1].split()[:3])
    assert text + data <= FLASH and data + bss <= RAM, told


@pytest.mark.parametrize("name", ["xy-star", "skg06-belts", "fit-ellipse"])
def test_an_example_typed_at_the_prompt(firmware: Path, tmp_path: Path, name: str) -> None:
    """The tape is the example's, byte for byte; 8080 cycles and the host's instructions are counted."""
    program = (ROOT / "examples" / f"{name}.skg").read_bytes().rstrip(b"\n")
    typed = b"".join(line + b"\r" for line in [*program.split(b"\n"), b"RUN"])
    debugger = ["-semihosting-config", "enable=on,target=native", "-icount", "shift=0"]
    machine = [QEMU, "-M", "microbit", "-display", "none", "-monitor", "none", "-serial", "none", "-kernel", firmware]
    done = subprocess.run([*machine, *debugger], cwd=tmp_path, input=typed, capture_output=True)
    assert done.returncode == 0, done.stderr
    assert b"ERR" not in without_sign_on(done.stdout)
    assert (tmp_path / "tape.3b").read_bytes() == (ROOT / "examples" / f"{name}.3b").read_bytes()
    cycles, instructions, ticks = map(int, done.stderr.split())
    assert 6 < cycles / instructions < 10
    print(f"{cycles} cycles, {ticks * INSTRUCTIONS_A_TICK / cycles:.1f} instructions of the host for each")
    assert ticks * INSTRUCTIONS_A_TICK / cycles < 8
