"""Shared by the host tools' tests, besides the fixtures of conftest.py."""

from __future__ import annotations

import gc
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from time import process_time
from typing import TypeVar

from click.testing import Result

ROOT = Path(__file__).parents[2]
SKG = Path(sys.executable).with_name("skg")
#: Seconds; only what hangs takes so long, on a busy machine too.
PATIENCE = 600

T, U = TypeVar("T"), TypeVar("U")

#: The fixture `run`: call it with the command line's arguments.
Run = Callable[..., Result]

#: The CAD package's tape of tape-3b.md, and the ISO code that it gave for the same path.
CAD_TAPE = (
    b"B9900B0B9900GXL3\r\nB0B70100B70100GYL2\r\nB55000B0B55000GXL3\r\n"
    b"B50100B100B100000GYNR1\r\nB54900B0B54900GXL3\r\nDD\r\n"
)


def term(*arguments: object, stdin: str = "") -> subprocess.CompletedProcess[bytes]:
    """`skg term` as a program."""
    return subprocess.run([SKG, "term", *map(str, arguments)], input=stdin.encode(), capture_output=True)


def timed(work: Callable[[], T]) -> tuple[T, float]:
    """The result of some work, and its time in processor seconds, without the garbage collector, which would go through
    the objects of earlier tests."""
    gc.disable()
    try:
        began = process_time()
        result = work()
        return result, process_time() - began
    finally:
        gc.enable()


def in_time(times: float, long: Callable[[], T], short: Callable[[], U]) -> tuple[T, U]:
    """The results of two works, of which the first must take less than so many times the other's time. What else the
    machine does may disturb one of them: then both are done again, twice at most, and the least of each counts."""
    least = [float("inf")] * 2
    for _ in range(3):
        # (the short one first: what is loaded at first use counts for it)
        (two, second), (one, first) = timed(short), timed(long)
        least = [min(least[0], first), min(least[1], second)]
        if least[0] < times * least[1]:
            return one, two
    raise AssertionError(f"{least[0]:.3f} s is not less than {times} times {least[1]:.3f} s")
