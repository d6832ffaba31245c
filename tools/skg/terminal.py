"""Lines on the terminal, whatever foreign names are in them."""

from __future__ import annotations

import sys

from skg.messages.finding import Finding
from skg.messages.render import line
from skg.wording import visible


def tell(message: str) -> None:
    """Write a line to standard error, if there is one."""
    if sys.stderr is not None:
        print(visible(message), file=sys.stderr, flush=True)


def remark(finding: Finding, by: str = "skg") -> None:
    """Write a finding to standard error, as a command's remark."""
    tell(f"{by}: {line(finding)}")


def show(text: str) -> None:
    """Write a line to standard output."""
    print(visible(text))
