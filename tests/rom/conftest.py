"""The emulator, built once; the counts of what the random tests compared."""

from __future__ import annotations

import fcntl
import subprocess
from collections import Counter

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


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """How much was compared with the reference, over all test processes."""
    total, programs, aside = Counter(), Counter(), Counter()
    for report in terminalreporter.getreports("passed"):
        for name, value in report.user_properties:
            if name == "compared":
                what, count, of, left_out = value
                total[what] += count
                programs[what] += of
                aside[what] += left_out
    for what, count in total.items():
        terminalreporter.write_line(
            f"firmware = reference: {count} {what} in {programs[what]} programs ({aside[what]} set aside)"
        )
