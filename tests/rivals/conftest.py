"""The emulator, built once; `skg` as a program."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "rom"))


@pytest.fixture(scope="session", autouse=True)
def built(build: Callable[..., None]) -> None:
    """The board, and the simulator's library."""
    build("emu", "tools")


@pytest.fixture(scope="session")
def run_skg() -> Callable[..., subprocess.CompletedProcess[str]]:
    """Run `skg` as a shell does."""

    def call(*arguments: str) -> subprocess.CompletedProcess[str]:
        program = Path(sys.executable).with_name("skg")
        return subprocess.run([program, *arguments], capture_output=True, text=True)

    return call
