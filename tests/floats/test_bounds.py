"""docs/firmware.md, section "How exact": every bound holds, and the figures there are those of this ROM."""

from __future__ import annotations

from bounds import END, PAGE, START, table


def test_page() -> None:
    """`python tests/floats/bounds.py` writes the table anew."""
    assert PAGE.read_text().split(START)[1].split(END)[0] == "\n".join(table())
