"""The emulator, built once; how much was compared, printed at the end."""

from __future__ import annotations

import fcntl
import subprocess

import pytest
from floathelp import ROM, ROOT, Firmware


@pytest.fixture(scope="session")
def firmware() -> Firmware:
    """A board at its prompt; one of several test processes builds the emulator, the others wait."""
    (ROOT / "build").mkdir(exist_ok=True)
    with (ROOT / "build" / "emu.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        done = subprocess.run(["make", "-s", "emu"], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert ROM.exists(), f"{ROM}: make rom"
    return Firmware()


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Operands compared, worst error, mismatches: one line a routine."""
    for report in terminalreporter.getreports("passed"):
        for name, value in report.user_properties:
            if name == "floats":
                terminalreporter.write_line(f"floats: {value}")
