"""The libraries in C: the 3B simulator (skgsim.c) and the 8080 board (emu/ of the project).

An installed package has them beside this file. In a checkout they are in build/, where make keeps them up to date.
"""

from __future__ import annotations

import ctypes
from pathlib import Path

from skg.errors import UserError
from skg.messages.finding import Finding

HERE = Path(__file__).resolve().parent
CHECKOUT = HERE.parents[2]


def load(name: str) -> ctypes.CDLL:
    """The library `lib<name>.so`, so called on every system; one that is missing or unfit is a `UserError`."""
    path = HERE / f"lib{name}.so"
    if not path.exists():
        path = CHECKOUT / "build" / path.name
    try:
        return ctypes.CDLL(str(path))
    except OSError as error:
        why = Finding("library-unfit", detail=str(error)) if path.exists() else Finding("library-missing")
        raise UserError(why.within(str(path))) from None
