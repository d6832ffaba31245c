"""The emulator, built once; how much was compared, printed at the end."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from floathelp import ROM, Firmware


@pytest.fixture(scope="session")
def firmware(build: Callable[..., None]) -> Firmware:
    """A board at its prompt."""
    build("emu")
    assert ROM.exists(), f"{ROM}: make rom"
    return Firmware()


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Operands compared, worst error, mismatches: one line a routine."""
    for report in terminalreporter.getreports("passed"):
        for name, value in report.user_properties:
            if name == "floats":
                terminalreporter.write_line(f"floats: {value}")
