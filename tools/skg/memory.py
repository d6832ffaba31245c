"""Python's memory, while a command makes very many objects."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def without_collector() -> Iterator[None]:
    """Leave Python's search for objects that hold each other alone; what nothing holds goes at once all the same.

    It looks at all objects again and again, and a drawing of 20,000 elements is a million of them: a third of the time.
    """
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()
