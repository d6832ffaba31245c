"""Marks of the SKG book in language.md: what is left of it ends in its section 9, so a later one is a title alone, and
what a rule says of it is our reconstruction."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
#: The last section of the book that is left, in part.
LAST = 9


def marks() -> list[str]:
    """The marks in brackets, and those in the last column of a table."""
    text = (ROOT / "docs/spec/language.md").read_text()
    return re.findall(r"\[([^\[\]\n]*\bS \d[^\[\]\n]*)\]", text) + re.findall(
        r"\| ([^|\n]*\bS \d[^|\n]*) \|$", text, re.M
    )


def test_a_mark_of_a_title_alone_stands_with_r() -> None:
    sections = {
        mark: [int(number) for number in re.findall(r"\b(\d+)(?![\d-])", mark.split("formula")[0])] for mark in marks()
    }
    assert any(max(numbers, default=0) > LAST for numbers in sections.values())
    alone = [
        mark for mark, numbers in sections.items() if max(numbers, default=0) > LAST and not re.search(r"\bR\b", mark)
    ]
    assert not alone, alone
