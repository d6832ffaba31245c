"""The emulator and its test programs, built once."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parent))

from asm8080 import assemble  # noqa: E402
from emuhelp import ROM_SIZE, Skg80  # noqa: E402

TARGETS = ["emu", "build/emu/compare", "build/emu/bench", "build/emu/translated", "build/emu/mix.com",
           "build/asan/compare", "build/asan/fuzz", "build/asan/skg80"]  # fmt: skip


@pytest.fixture(scope="session", autouse=True)
def built(build: Callable[..., None]) -> None:
    """Everything that these tests run."""
    build("-j2", *TARGETS)


@pytest.fixture
def skg80() -> Skg80:
    """build/skg80."""
    return Skg80()


@pytest.fixture
def part(tmp_path: Path) -> Callable[[str], Path]:
    """Writes a part to a file; without ctrl-Z at its end LOAD waits two seconds of the board's time for more."""

    def write(text: str) -> Path:
        path = tmp_path / "part.skg"
        path.write_bytes(text.encode())
        return path

    return write


@pytest.fixture
def rom_of(tmp_path: Path) -> Callable[[str], Path]:
    """Writes the ROM image of a few instructions to a file."""

    def write(source: str) -> Path:
        path = tmp_path / "rom.bin"
        path.write_bytes(assemble(source)[0].ljust(ROM_SIZE, b"\xff"))
        return path

    return write
