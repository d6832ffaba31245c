"""File types by first bytes, for messages about unexpected files."""

from __future__ import annotations

import re

from skg.errors import UserError
from skg.messages.finding import Finding, Phrase

TAPE, PROGRAM, GCODE, DRAWING = map(Phrase, ("file-tape", "file-program", "file-gcode", "file-dxf"))
#: Beginnings of files, in the order in which they are tried. (possessive: a file of comments alone takes no time)
_BEGINNINGS = [
    (rb"\x89PNG\r\n", Phrase("file-png")),
    (rb"\xff\xd8\xff", Phrase("file-jpeg")),
    (rb"%PDF-", Phrase("file-pdf")),
    (rb"PK\x03\x04", Phrase("file-zip")),
    (rb"AC10\d\d", Phrase("file-dwg")),
    (rb"AutoCAD Binary DXF", DRAWING),
    (rb"\xff\xfe|\xfe\xff", Phrase("file-utf-16")),
    (rb"(?:\s*999\r?\n[^\n]*\n)*\s*0\r?\n\s*SECTION\s", DRAWING),
    (rb"\s*(?:<!--.*?-->\s*|<[?!](?!--)[^>]*>\s*)*+<svg\b", Phrase("file-svg")),
    (rb"\s*(?:<![^>]*>\s*)?<html\b", Phrase("file-web-page")),
    (rb"\s*(?:B\s*\d+\s*){3}G", TAPE),
    (rb"\s*+%?\s*+(?:N\s*\d+\s*)?G\s*0*\d{1,2}(?![\d.])", GCODE),
    (rb"\s*\d{1,4}\s*(?:REM|FROM|CUT|R\s*=|[A-Z]\d*\s*=)", PROGRAM),
]


def kind_of(data: bytes) -> Phrase | None:
    """Return a file's type, such as `TAPE`; None where it is unknown."""
    head = data[:4096].removeprefix(b"\xef\xbb\xbf").lstrip(b"\0")
    return next((kind for begins, kind in _BEGINNINGS if re.match(begins, head, re.IGNORECASE | re.DOTALL)), None)


def named(data: bytes) -> Phrase | None:
    """Return the type of a file that is not text, for the beginning of a message; None for text."""
    kind = kind_of(data)
    return Phrase("file-is", kind=kind) if kind not in (None, TAPE, PROGRAM, GCODE) else None


def refuse_others(data: bytes, name: str, expected: Phrase) -> None:
    """Raise a `UserError` when a file shows that it is not what is expected, such as `TAPE`, but of another kind."""
    kind = kind_of(data)
    if kind not in (None, expected):
        raise UserError(Finding("other-kind", kind=kind, expected=expected).within(name))
