"""The emulator and its test programs, built once; images of the tests' own firmware."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE))

from asm8080 import assemble  # noqa: E402

TARGETS = ["emu", "build/emu/compare", "build/emu/bench", "build/asan/compare", "build/asan/fuzz",
           "build/asan/skg80", "build/emu/mix.com"]  # fmt: skip


@pytest.fixture(scope="session", autouse=True)
def built(build: Callable[..., None]) -> None:
    """Everything that these tests run."""
    build("-j2", *TARGETS)


SETUP = {
    "6850": "SETUP: DB 3,15H,0FFH",
    # A synchronous mode with two characters at worst, reset, then 8 bits, no parity, 1 stop bit, x16; all enabled.
    "8251": "SETUP: DB 0,0,0,40H,4EH,37H,0FFH",
}
PORTS = {
    "6850": "TST: EQU 10H\nTDT: EQU 11H\nAST: EQU 12H\nADT: EQU 13H\nRXB: EQU 1\nTXB: EQU 2\n",
    "8251": "TST: EQU 11H\nTDT: EQU 10H\nAST: EQU 13H\nADT: EQU 12H\nRXB: EQU 2\nTXB: EQU 1\n",
}


def monitor(board: str = "6850", teletype_only: bool = False) -> bytes:
    """The tests' own firmware (monitor.asm) for a board."""
    text = f"{PORTS[board]}TTYP: EQU {int(teletype_only)}\n{(HERE / 'monitor.asm').read_text()}\n{SETUP[board]}\n"
    return assemble(text)[0]


@dataclass(frozen=True)
class Skg80:
    """Runs build/skg80 with the tests' own firmware."""

    rom: Path

    def __call__(
        self, *arguments: str | Path, stdin: bytes = b"", rom: bool = True
    ) -> subprocess.CompletedProcess[bytes]:
        command = [ROOT / "build" / "skg80", *(("--rom", self.rom) if rom else ()), *arguments]
        return subprocess.run(command, input=stdin, capture_output=True, timeout=30)


@pytest.fixture
def rom(tmp_path: Path) -> Path:
    """The tests' own firmware as a file."""
    path = tmp_path / "monitor.bin"
    path.write_bytes(monitor())
    return path


@pytest.fixture
def skg80(rom: Path) -> Skg80:
    """build/skg80 with the tests' own firmware."""
    return Skg80(rom)


@pytest.fixture
def part(tmp_path: Path) -> Callable[[str], Path]:
    """A part for the tests' own firmware, as a file."""

    def write(text: str) -> Path:
        path = tmp_path / "part.skg"
        path.write_bytes(text.encode())
        return path

    return write
