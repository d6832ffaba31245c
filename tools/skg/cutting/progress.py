"""Progress of a cut, as who asked for it is told."""

from __future__ import annotations

from collections.abc import Callable

#: Told how far a step is: its name ("plan", "board", "check"), how many contours of how many are done.
Progress = Callable[[str, int, int], None]


def in_silence(step: str, done: int, total: int) -> None:
    """Tell nobody."""
