"""Garbage is looked for rarely: what is made of large files lives to its end."""

from __future__ import annotations

import gc

#: So many new objects before garbage is looked for: 20,000 circles have 4 million, and none of it is garbage.
_OBJECTS = 5_000_000


def collect_rarely() -> None:
    """Keep the collector from looking through millions of blocks in vain."""
    gc.set_threshold(_OBJECTS)
