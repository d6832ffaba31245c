"""Python's memory, while a command makes very many objects."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

#: So many new objects there are before Python looks for those that hold each other alone; by itself it does at 700.
_OBJECTS = 100_000


@contextmanager
def with_rare_collector() -> Iterator[None]:
    """Let Python look seldom for objects that hold each other alone; what nothing holds goes at once all the same.

    It looks at all objects again and again, and a drawing of 20,000 elements is a million of them: a third of the time.
    (Never to look takes 140 MB more for 80,000 lines.)
    """
    before = gc.get_threshold()
    gc.set_threshold(_OBJECTS, *before[1:])
    try:
        yield
    finally:
        gc.set_threshold(*before)
