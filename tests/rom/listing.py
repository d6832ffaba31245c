"""How LIST writes a line, found from its text: what LIST writes must be a line that LOAD takes (language.md,
section 3).
"""

from __future__ import annotations

import re
from decimal import ROUND_HALF_UP, Context

_WORD = re.compile(
    r"""(?P<text>"[^"]*")
    |(?P<number>([0-9]+(\.[0-9]*)?|\.[0-9]+)(E[+-]?[0-9]+)?)
    |(?P<function>SQR|SIN|COS|TG|ATG|ABS|INT|K[123])(␣|(?=\())
    |(?P<statement>FROM|CUT|BACK|END|REM|PRINT|GOTO|IF|GOSUB|RETURN|READ|DATA|RESTORE|INPUT|SCALE|SYM|REP|RECUT|FIT|TOL)
    |(?P<name>[ADRIJPOVCBTSXY])(?P<subscript>[0-9]*)
    |(?P<sign>[^␣])""",
    re.VERBOSE,
)
_REMARK = re.compile(r"[ 0-9]*R *E *M ?", re.IGNORECASE)
#: LIST writes 9 significant digits of a number.
NINE = Context(prec=9, rounding=ROUND_HALF_UP)
#: What is below it is zero.
SMALLEST = 2.0**-127


def shown(text: str) -> str:
    """A constant as LIST writes it."""
    value = NINE.create_decimal(text)
    if value < SMALLEST:
        return "0"
    value = value.normalize()
    if -5 <= value.adjusted() <= 7:
        return f"{value:f}"
    digits = "".join(map(str, value.as_tuple().digits))
    return f"{digits[0]}{'.' + digits[1:] if digits[1:] else ''}E{value.adjusted()}"


def listed(squeezed: str, line: str) -> str:
    """A program line as LIST writes it; `squeezed`: without its blanks (`skg.ref.parser.squeeze`)."""
    remark = _REMARK.match(line)
    out = ""
    for word in _WORD.finditer(squeezed):
        if word["number"]:
            out += shown(word["number"])
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
    return out + line[remark.end() :] if remark and line[remark.end() :] else out.rstrip()
