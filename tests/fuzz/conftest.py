"""The fuzzer, built once in both ways; how much was typed."""

from __future__ import annotations

from collections.abc import Callable

import pytest

TARGETS = ["build/skg.lst", "build/fuzz", "build/asan/fuzz-rom"]


@pytest.fixture(scope="session", autouse=True)
def built(build: Callable[..., None]) -> None:
    """Both builds."""
    build(*TARGETS)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Bytes typed at the ROM, over all test processes."""
    typed = [value for report in terminalreporter.getreports("passed")
             for name, value in report.user_properties if name == "typed"]  # fmt: skip
    if typed:
        terminalreporter.write_line(f"random typing: {sum(typed)} bytes")
