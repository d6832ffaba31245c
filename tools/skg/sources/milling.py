"""Milling programs (docs/spec/milling.md): how one is told from a program for wire."""

from __future__ import annotations

import re

#: The key of `skg.board.roms.ROMS` that milling programs are run on.
MILL_ROM = "mill"
#: A line that begins as a statement of milling does; FROM, FIT, FREE, GOTO and GOSUB are the wire's, too.
_ADDED = re.compile(r"\d*(?:F(?!ROM|IT|REE)|G(?!OTO|OSUB)|Z|M|HOLE)")
#: Characters without a meaning on a line; the number of a syntax error (language.md, section 6).
_NOTHING = re.compile(r"[\0- \x7f]")
_SYNTAX = 1


def is_milling(text: str) -> bool:
    """Tell whether a program has a statement that only the milling language knows."""
    return any(
        _ADDED.match(_NOTHING.sub("", line).upper()) and _is_understood(line)
        for line in re.split(r"[\r\n]", text.partition("\x1a")[0])
    )


def _is_understood(line: str) -> bool:
    """Tell whether the milling language has such a line."""
    from skg.ref import mill  # which loads lark, and is not needed for most programs

    if not line.isascii():
        return False
    error = mill.run(line).error
    return not error or error[0] != _SYNTAX
