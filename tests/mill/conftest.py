"""Shared by the milling tests: helpers of other folders; emulator and libraries, built once."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "rom"))


@pytest.fixture(scope="session", autouse=True)
def built(build: Callable[..., None]) -> None:
    """The board, and the simulator's library."""
    build("emu", "tools")
