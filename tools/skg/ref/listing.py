"""Lines as LIST writes them, each a line that LOAD takes (language.md, section 3)."""

from __future__ import annotations

import re
from functools import cache

from skg.ref import real

#: The words that statements begin with, and those inside of them.
STATEMENTS = (
    *("FROM", "CUT", "BACK", "SYM", "REP", "RECUT", "FIT", "TOL", "SCALE", "READ", "DATA", "RESTORE"),
    *("PRINT", "INPUT", "GOTO", "IF", "GOSUB", "RETURN", "END", "REM"),
)


@cache
def _words(statements: tuple[str, ...]) -> re.Pattern[str]:
    return re.compile(
        rf"""(?P<text>"[^"]*")
        |(?P<number>([0-9]+(\.[0-9]*)?|\.[0-9]+)(E[+-]?[0-9]+)?)
        |(?P<function>SQR|SIN|COS|TG|ATG|ABS|INT|K[123])(␣|(?=\())
        |(?P<statement>{"|".join(statements)})
        |(?P<name>[ADRIJPOVCBTSXY])(?P<subscript>[0-9]*)
        |(?P<sign>[^␣])""",
        re.VERBOSE,
    )


#: Significant digits of a number.
DIGITS = 9


@real.kept
def _number(text: str) -> str:
    """A constant as LIST writes it."""
    return real.show(real.literal(text), DIGITS)


def listed(squeezed: str, remark: str | None, statements: tuple[str, ...] = STATEMENTS) -> str:
    """A program line, squeezed (`skg.ref.parser.squeeze`), as LIST writes it; `remark`: the text behind REM."""
    out = ""
    for word in _words(statements).finditer(squeezed):
        if word["number"]:
            out += _number(word["number"])
        elif word["function"]:
            out += word["function"] + " "
        elif word["statement"]:
            out += ("" if out.endswith(" ") else " ") + word["statement"] + " "
        elif word["name"]:
            out += word["name"] + word["subscript"].lstrip("0")
        else:
            out += word[0]
        if word.start() == 0:
            out += " "
    return out + remark if remark else out.rstrip()
