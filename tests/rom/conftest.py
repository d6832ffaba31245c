"""The emulator, built once."""

from __future__ import annotations

import fcntl
import subprocess

import pytest
from romhelp import ROM, ROOT


@pytest.fixture(scope="session", autouse=True)
def built() -> None:
    """The board as a library and as a program; one of several test processes builds, the others wait."""
    (ROOT / "build").mkdir(exist_ok=True)
    with (ROOT / "build" / "emu.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        done = subprocess.run(["make", "-s", "emu"], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert ROM.exists(), f"{ROM}: make rom"
