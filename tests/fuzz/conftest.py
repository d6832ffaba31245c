"""The fuzzer, built once in both ways; how much was typed."""

from __future__ import annotations

import fcntl
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
TARGETS = ["build/fuzz", "build/asan/fuzz-rom"]


@pytest.fixture(scope="session", autouse=True)
def built() -> None:
    """Both builds; one of several test processes builds, the others wait."""
    (ROOT / "build").mkdir(exist_ok=True)
    with (ROOT / "build" / "emu.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        done = subprocess.run(["make", "-s", *TARGETS], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Bytes typed at the ROM, over all test processes."""
    typed = [value for report in terminalreporter.getreports("passed")
             for name, value in report.user_properties if name == "typed"]  # fmt: skip
    if typed:
        terminalreporter.write_line(f"random typing: {sum(typed)} bytes")
