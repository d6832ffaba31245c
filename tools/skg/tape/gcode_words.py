"""Words of G-code: a line taken apart, and what can be wrong with it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from decimal import Decimal
from typing import NamedTuple

#: What stands between words, or behind a line: comments in parentheses and after `;` are nothing.
SPACE = re.compile(r"(?:\s|\([^()]*\)|;.*)*")
_WORD = re.compile(r"([A-Z])\s*([+-]?(?:\d+\.?\d*|\.\d+))" + SPACE.pattern)
#: M words behind which the rest of the line is a text, on boards for printers.
_TEXTS = {117, 118}


class Misread(Exception):
    """What cannot be read, at a column, from 1."""

    def __init__(self, column: int, message: str) -> None:
        super().__init__(message)
        self.column = column


class Word(NamedTuple):
    """A letter and its number; `is_decimal`: it has a point; `column`, from 1."""

    letter: str
    number: Decimal
    is_decimal: bool
    column: int


def words(text: str) -> Iterator[Word]:
    """Split a line into words; comments in parentheses and after `;` are nothing, and N words say nothing."""
    text = text.upper()
    at, end = SPACE.match(text).end(), len(text)
    while at < end:
        match = _WORD.match(text, at)
        if not match:
            raise Misread(at + 1, f"expected a word such as G01 or X-9900, found {text[at]!r}")
        letter, number = match.groups()
        if letter != "N":
            word = Word(letter, Decimal(number), "." in number, at + 1)
            yield word
            if letter == "M" and word.number in _TEXTS:
                return
        at = match.end()
