"""Settings of a job: the board, the feed, and what to do with contours that cannot be cut."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

#: Told how far a step is: its name ("plan", "board", "check"), how many contours of how many are done.
Progress = Callable[[str, int, int], None]


def in_silence(step: str, done: int, total: int) -> None:
    """Tell nobody."""


@dataclass(frozen=True)
class Settings:
    """The board: its ROM ("no-drift", "standard") and RAM (KiB); the feed, mm/min; `small`: whether to "refuse" or to
    "leave" contours that the wire has no room beside; `into`: whether to "refuse" or to "cut" those whose wire comes
    into another closed contour. Both are empty where nobody is asked."""

    rom: str = "no-drift"
    ram_kib: int = 8
    feed: float = 5.0
    small: str = ""
    into: str = ""

    @property
    def is_without_drift(self) -> bool:
        """Tell whether blocks start where the controller stands."""
        return self.rom == "no-drift"
