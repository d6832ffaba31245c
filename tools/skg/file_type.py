"""File types by first bytes, for messages about unexpected files."""

from __future__ import annotations

import re

from skg.errors import UserError
from skg.messages.finding import Finding

TAPE, PROGRAM, GCODE, DRAWING = "a 3B tape", "an SKG program", "G-code", "a DXF drawing"
#: Beginnings of files, in the order in which they are tried. (possessive: a file of comments alone takes no time)
_BEGINNINGS = [
    (rb"\x89PNG\r\n", "a PNG picture"),
    (rb"\xff\xd8\xff", "a JPEG picture"),
    (rb"%PDF-", "a PDF file"),
    (rb"PK\x03\x04", "a zip archive"),
    (rb"AC10\d\d", "a DWG drawing"),
    (rb"AutoCAD Binary DXF", DRAWING),
    (rb"\xff\xfe|\xfe\xff", "text in UTF-16"),
    (rb"(?:\s*999\r?\n[^\n]*\n)*\s*0\r?\n\s*SECTION\s", DRAWING),
    (rb"\s*(?:<!--.*?-->\s*|<[?!](?!--)[^>]*>\s*)*+<svg\b", "an SVG drawing"),
    (rb"\s*(?:<![^>]*>\s*)?<html\b", "a web page"),
    (rb"\s*(?:B\s*\d+\s*){3}G", TAPE),
    (rb"\s*+%?\s*+(?:N\s*\d+\s*)?G\s*0*\d{1,2}(?![\d.])", GCODE),
    (rb"\s*\d{1,4}\s*(?:REM|FROM|CUT|R\s*=|[A-Z]\d*\s*=)", PROGRAM),
]


def kind_of(data: bytes) -> str:
    """Return a file's type, such as "a 3B tape"; empty where it is unknown."""
    head = data[:4096].removeprefix(b"\xef\xbb\xbf").lstrip(b"\0")
    return next((kind for begins, kind in _BEGINNINGS if re.match(begins, head, re.IGNORECASE | re.DOTALL)), "")


def named(data: bytes) -> str:
    """Return the type of a file that is not text, for the beginning of a message; empty for text."""
    kind = kind_of(data)
    return f"{kind}, " if kind not in ("", TAPE, PROGRAM, GCODE) else ""


def refuse_others(data: bytes, name: str, expected: str) -> None:
    """Raise a `UserError` when a file shows that it is not what is expected, such as `TAPE`, but of another kind."""
    kind = kind_of(data)
    if kind not in ("", expected):
        raise UserError(Finding("other-kind", kind=kind, expected=expected).within(name))
