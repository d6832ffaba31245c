"""JSON, in which parts may be JSON already: what is long is written once, by the process that made it."""

from __future__ import annotations

import json
from typing import Any

from skg.errors import UserError
from skg.messages.catalogue import LANGUAGES
from skg.messages.finding import Finding, Phrase
from skg.messages.render import Medium, Speech, advice, line, text
from skg.wording import visible

#: The drawing in an answer, where it was told of before.
EARLY = "early"
#: The separator of two values.
_BETWEEN = "\0"
_ENCODER = json.JSONEncoder(ensure_ascii=False, separators=(",", ":"), allow_nan=False)


def encoded(data: dict[str, Any]) -> bytes:
    """An object of JSON; those of its values that are bytes are JSON already."""
    parts = (f"{json.dumps(name)}:".encode() + in_json(value) for name, value in data.items())
    return b"{" + b",".join(parts) + b"}"


def in_json(value: object) -> bytes:
    """A value as JSON."""
    if isinstance(value, bytes):
        return value
    if isinstance(value, dict) and any(isinstance(item, bytes | dict) for item in value.values()):
        return encoded(value)
    return _ENCODER.encode(value).encode("utf-8", "replace")


def each_in_json(values: list[Any]) -> list[str]:
    """Each of many values as JSON: for each call an encoder is made, which takes as long as a small value does."""
    # (texts have no control characters)
    parted = [item for value in values for item in (_BETWEEN, value)]
    return _ENCODER.encode(parted[1:])[1:-1].split(f",{_ENCODER.encode(_BETWEEN)},") if values else []


def told(error: UserError) -> dict[str, Any]:
    """An error, with the contour and the place that it is about, and the settings that it advises."""
    return {"message": said(error.finding)} | facts(error.finding)


def said(phrase: Phrase) -> list[str]:
    """A sentence in each of `LANGUAGES`: the page shows that of its own; a finding's has its source and its mark."""
    audiences = (Speech(language, Medium.PAGE) for language in LANGUAGES)
    return [
        visible(line(phrase, audience) if isinstance(phrase, Finding) else text(phrase, audience))
        for audience in audiences
    ]


def facts(finding: Finding) -> dict[str, Any]:
    """The facts of a finding that the page goes by: its code, the contour and the place that it is about, where these
    are known, and the settings that it advises, each with its value or None."""
    about = {name: value for name in ("contour", "place") if (value := getattr(finding, name)) is not None}
    settings = list(dict.fromkeys(advice(finding)))
    return {"code": finding.code} | about | ({"advice": settings} if settings else {})
