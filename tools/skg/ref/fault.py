"""Errors of a running SKG program (language.md, section 6)."""

from __future__ import annotations

from enum import IntEnum


class Code(IntEnum):
    """The error numbers that the board prints."""

    SYNTAX = 1
    LINE = 2
    NO_VALUE = 3
    KINDS = 4
    RANGE = 5
    GEOMETRY = 6
    OFFSET = 7
    DATA = 8
    MEMORY = 9
    TAPE = 10


class Fault(Exception):
    """An SKG error on its way to the prompt."""

    def __init__(self, code: Code) -> None:
        super().__init__(f"ERR {code:02d}")
        self.code = code
