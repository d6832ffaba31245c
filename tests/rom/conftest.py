"""The emulator, built once; the counts of what the random tests compared."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

import pytest
from romhelp import ROM


@pytest.fixture(scope="session", autouse=True)
def built(build: Callable[..., None]) -> None:
    """The board as a library and as a program."""
    build("emu")
    assert ROM.exists(), f"{ROM}: make rom"


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Prints how much was compared with the reference, over all test processes."""
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
