"""Files in TOML: their tables, or what is wrong with them and where."""

from __future__ import annotations

import re
import tomllib
from typing import Any

from skg.errors import UserError
from skg.messages.finding import Finding, Phrase

#: Names of a drawing's layers may have bytes that are no text: they stay what they are.
ODD = "surrogateescape"
#: The place that the library puts behind its reasons.
_PLACE = re.compile(r" \(at (?:line (?P<line>\d+), column (?P<column>\d+)|end of document)\)$")


def decoded(data: bytes, name: str) -> str:
    """The text of a file's bytes; what is not UTF-8 is a `UserError`."""
    try:
        return data.decode("utf-8-sig", ODD)
    except UnicodeDecodeError as error:
        raise UserError(Finding("not-utf-8", number=error.start + 1).within(name)) from None


def parsed(text: str, name: str) -> dict[str, Any]:
    """The tables of a file's text; what is no TOML is a `UserError` with its place."""
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        what = _placed(str(error))
    except RecursionError:
        what = Phrase("too-deep")
    except ValueError:
        # (an int of more than 4,300 digits)
        what = Phrase("reason-too-large")
    raise UserError(Finding("not-toml", what=what).within(name))


def _placed(reason: str) -> Phrase:
    """A reason of the library with its place."""
    place, detail = _PLACE.search(reason), _PLACE.sub("", reason)
    if place and place["line"]:
        return Phrase("toml-at", line=int(place["line"]), column=int(place["column"]), detail=detail)
    return Phrase("toml-at-end", detail=detail)
