"""Lines on the terminal, whatever foreign names are in them."""

from __future__ import annotations

import sys

from skg.wording import visible


def tell(message: str) -> None:
    """Write a line to standard error, if there is one."""
    if sys.stderr is not None:
        print(visible(message), file=sys.stderr, flush=True)


def show(line: str) -> None:
    """Write a line to standard output."""
    print(visible(line))
