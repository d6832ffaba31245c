"""Words of G-code: a line taken apart, and what can be wrong with it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from decimal import Decimal
from typing import NamedTuple

#: Text between words, or behind a line: blanks, comments in parentheses and after `;`.
SPACE = re.compile(r"(?:\s|\([^()]*\)|;.*)*")
_WORD = re.compile(r"([A-Z])\s*([+-]?(?:\d+\.?\d*|\.\d+))" + SPACE.pattern)
#: M words behind which the rest of the line is a text, on boards for printers.
_TEXTS = {117, 118}


class Misread(Exception):
    """A text that cannot be read, at a column, from 1."""

    def __init__(self, column: int, message: str) -> None:
        super().__init__(message)
        self.column = column


@dataclass(frozen=True)
class GcodeFinding:
    """Something wrong in G-code: line and column, from 1, and what.

    `is_fatal`: it cannot be read further. `is_guess`: it is read as the message says, and might mean something else.
    """

    line: int
    column: int
    message: str
    is_fatal: bool = field(default=True, repr=False)
    is_guess: bool = field(default=False, repr=False)

    def __str__(self) -> str:
        return f"line {self.line}, column {self.column}: {self.message}"


class Findings:
    """Findings in a program that is being read; `line`, from 1, is the current one."""

    def __init__(self) -> None:
        self.line = 0
        self.all: list[GcodeFinding] = []

    def misread(self, error: Misread) -> None:
        """Add an error: a text that cannot be read."""
        self.all.append(GcodeFinding(self.line, error.column, str(error)))

    def warn(self, column: int, message: str, is_guess: bool = False) -> None:
        """Add a warning: a text that stops some controls, or might be meant otherwise."""
        self.all.append(GcodeFinding(self.line, column, message, is_fatal=False, is_guess=is_guess))


class Word(NamedTuple):
    """A letter and its number; `is_decimal`: it has a point; `column`, from 1."""

    letter: str
    number: Decimal
    is_decimal: bool
    column: int


def words(text: str) -> Iterator[Word]:
    """Split a line into words; comments in parentheses and after `;` are nothing, and N words say nothing."""
    text = text.upper()
    index, end = SPACE.match(text).end(), len(text)
    while index < end:
        match = _WORD.match(text, index)
        if not match:
            raise Misread(index + 1, f"expected a word such as G01 or X-9900, found {text[index]!r}")
        letter, number = match.groups()
        if letter != "N":
            word = Word(letter, Decimal(number), "." in number, index + 1)
            yield word
            if letter == "M" and word.number in _TEXTS:
                return
        index = match.end()
