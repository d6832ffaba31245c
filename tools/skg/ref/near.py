"""Decisions that stood within a hair's breadth of their threshold.

A 40-bit float and 50 digits can only be expected to agree where no decision hangs on the last bits. Each
threshold of the language is tested through this module, which keeps a list of the close calls, so that a
random test can tell an ill-conditioned program from a bug.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mpmath import mpf as Real

#: Relative distance to a threshold below which a decision is recorded.
RELATIVE = 1e-6
#: mm: the direction of what is shorter hangs on the last bits of its ends (to some 10⁻⁶ at 30 mm).
SHORT = 0.004


@dataclass(frozen=True)
class Near:
    """One close call.

    `margin` is the distance to the tie in µm for the kind "rounding", in mm² for "nearest crossing", in
    radians for "sweep", the sine of the angle for "shallow crossing", mm for "short chord", and the relative
    distance to the threshold for every other kind. `line` is the program line, None outside a program.
    """

    kind: str
    margin: float
    line: int | None


class Watch:
    """Collects close calls; the interpreter keeps `line` up to date."""

    def __init__(self) -> None:
        self.calls: list[Near] = []
        self.line: int | None = None


_watch: ContextVar[Watch | None] = ContextVar("watch", default=None)


@contextmanager
def watching() -> Iterator[Watch]:
    """Record close calls while the context lasts."""
    watch = Watch()
    token = _watch.set(watch)
    try:
        yield watch
    finally:
        _watch.reset(token)


def note(kind: str, margin: Real | float, limit: Real | float) -> None:
    """Record a decision whose distance to its tie is below `limit`."""
    watch = _watch.get()
    if watch is not None and -limit < margin < limit:
        watch.calls.append(Near(kind, abs(float(margin)), watch.line))


def at_most(value: Real | float, limit: Real | float, kind: str) -> bool:
    """`value <= limit`, recorded when it is a close call. `limit` is positive."""
    if _watch.get() is not None:
        note(kind, (value - limit) / limit, RELATIVE)
    return value <= limit
