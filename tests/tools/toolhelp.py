"""Shared by the host tools' tests, besides the fixtures of conftest.py."""

from __future__ import annotations

import gc
from collections.abc import Callable
from pathlib import Path
from time import process_time
from typing import TypeVar

from click.testing import Result

ROOT = Path(__file__).parents[2]
#: Seconds; only what hangs takes so long, on a busy machine too.
PATIENCE = 600

T = TypeVar("T")

#: The fixture `run`: call it with the command line's arguments.
Run = Callable[..., Result]

#: The CAD package's tape of tape-3b.md, and the ISO code that it gave for the same path.
CAD_TAPE = (
    b"B9900B0B9900GXL3\r\nB0B70100B70100GYL2\r\nB55000B0B55000GXL3\r\n"
    b"B50100B100B100000GYNR1\r\nB54900B0B54900GXL3\r\nDD\r\n"
)


def least_time(work: Callable[[], T], times: int = 3) -> tuple[T, float]:
    """The result of some work, and its time in processor seconds: the least of some runs, without the garbage
    collector, which would go through the objects of earlier tests."""
    least = float("inf")
    for _ in range(times):
        gc.collect()
        gc.disable()
        try:
            began = process_time()
            result = work()
            least = min(least, process_time() - began)
        finally:
            gc.enable()
    return result, least
