"""Path to the helpers of the drive's tests; builds the programs that they need."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "rom")]


@pytest.fixture(scope="session", autouse=True)
def libraries(build: Callable[..., None]) -> None:
    """The board, skg80 and the simulator."""
    build("emu", "tools")
