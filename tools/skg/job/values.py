"""The values that a job may have; each check returns the value, or raises a `Wrong` that says what is expected."""

from __future__ import annotations

from collections.abc import Callable, Collection
from itertools import pairwise
from math import inf
from pathlib import Path
from typing import Any

from skg.job.placing import ORIGINS
from skg.messages.finding import Phrase

Check = Callable[[object], Any]

#: No wire with its spark gap is wider than twice this, mm.
MOST_OFFSET = 5.0
#: No machine cuts more slowly, mm/min.
LEAST_FEED = 0.001
#: FIT comes no nearer to a curve, mm.
LEAST_FIT = 1e-5
#: No contour has more tabs.
MOST_TABS = 50
#: No part is cut more times larger or smaller than it is drawn.
MOST_SCALE = 1000.0
#: The board's RAM, KiB.
RAM = 2, 56
#: No place is farther from the origin, no length longer, mm: a tape ends there.
FARTHEST = 100_000.0
#: No price is higher, no rate faster.
MOST_MONEY = 99_999_999.0
#: No place in a file is farther from its origin, mm: maps are drawn in a country's coordinates.
_IN_FILE = 1e9
#: No text is longer.
_LONGEST = 200


class Wrong(ValueError):
    """A value that no job has; `why`: what is expected."""

    def __init__(self, why: Phrase) -> None:
        super().__init__(why.code)
        self.why = why


def flag(value: object) -> bool:
    """Check a yes or no."""
    if not isinstance(value, bool):
        raise Wrong(Phrase("value-flag"))
    return value


def text(value: object) -> str:
    """Check a text of one line."""
    if not isinstance(value, str) or not value.strip() or len(value) > _LONGEST or not value.isprintable():
        raise Wrong(Phrase("value-text", most=_LONGEST))
    return value


def name(value: object) -> str:
    """Check the name of a layer: a drawing may have any."""
    if not isinstance(value, str):
        raise Wrong(Phrase("value-name"))
    return value


def file_name(value: object) -> str:
    """Check the name of a file, without a folder."""
    if not isinstance(value, str) or value in ("", "..") or "\0" in value or Path(value).name != value:
        raise Wrong(Phrase("value-file-name"))
    return value


def checksum(value: object) -> str:
    """Check a SHA-256 in hexadecimal digits."""
    if not isinstance(value, str) or len(value) != 64 or set(value.lower()) - set("0123456789abcdef"):
        raise Wrong(Phrase("value-checksum"))
    return value.lower()


def names(value: object) -> tuple[str, ...]:
    """Check a list of names."""
    if not isinstance(value, list | tuple):
        raise Wrong(Phrase("value-names"))
    return tuple(map(name, value))


def choice(among: Collection[str]) -> Check:
    """Make the check of one of some words."""

    def check(value: object) -> str:
        if not isinstance(value, str) or value not in among:
            raise Wrong(Phrase("value-among", words=tuple(among)))
        return value

    return check


def number(low: float = -FARTHEST, high: float = FARTHEST, is_open: bool = False) -> Check:
    """Make the check of a number in a range; `is_open`: without its lower end."""

    def check(value: object) -> float:
        # (bool is an int)
        if (
            not isinstance(value, int | float)
            or isinstance(value, bool)
            or not low <= value <= high
            or is_open
            and value == low
        ):
            code = ("value-above" if is_open else "value-from") + "-to" * (high < inf)
            raise Wrong(Phrase(code, low=low, high=high))
        return float(value)

    return check


def whole(low: int, high: int) -> Check:
    """Make the check of a whole number in a range."""

    def check(value: object) -> int:
        if not isinstance(value, int) or isinstance(value, bool) or not low <= value <= high:
            raise Wrong(Phrase("value-whole", low=low, high=high))
        return value

    return check


def place(value: object) -> tuple[float, float]:
    """Check a place, [x, y]."""
    x, y = _numbers(value, 2, number(), "value-place")
    return x, y


def origin(value: object) -> str | tuple[float, float]:
    """Check what becomes 0, 0: a place, or a word for one of the part's box."""
    if isinstance(value, str) and value in ORIGINS:
        return value
    try:
        return place(value)
    except Wrong:
        raise Wrong(Phrase("value-origin", words=tuple(ORIGINS))) from None


def size(value: object) -> tuple[float, float]:
    """Check a size, [width, height]."""
    width, height = _numbers(value, 2, number(0.0), "value-size")
    return width, height


def box(value: object) -> tuple[float, float, float, float]:
    """Check a box, [left, low, right, high]."""
    left, low, right, high = _numbers(value, 4, number(), "value-box")
    return left, low, right, high


def _numbers(value: object, count: int, check: Check, expected: str) -> list[float]:
    if not isinstance(value, list | tuple) or len(value) != count:
        raise Wrong(Phrase(expected))
    try:
        return list(map(check, value))
    except Wrong:
        raise Wrong(Phrase(expected)) from None


def places(value: object) -> tuple[tuple[float, float], ...]:
    """Check a list of places."""
    if not isinstance(value, list | tuple):
        raise Wrong(Phrase("value-places"))
    return tuple(map(place, value))


def pairs(value: object) -> tuple[tuple[float, float, float, float], ...]:
    """Check a list of pairs of places, [x, y, x, y]."""
    if not isinstance(value, list | tuple):
        raise Wrong(Phrase("value-pairs"))
    lines: dict[tuple[float, float, float, float], None] = {}
    for line in value:
        x, y, u, v = _numbers(line, 4, number(-_IN_FILE, _IN_FILE), "value-pairs")
        lines[x, y, u, v] = None
    return tuple(lines)


def places_in_file(value: object) -> tuple[tuple[float, float], ...]:
    """Check a list of places in a drawing's file."""
    if not isinstance(value, list | tuple):
        raise Wrong(Phrase("value-places"))
    pairs_of = (_numbers(each, 2, number(-_IN_FILE, _IN_FILE), "value-place") for each in value)
    return tuple((x, y) for x, y in pairs_of)


def passes(value: object, least: int = 1) -> tuple[float, ...]:
    """Check what the passes leave, none of them more than the one before it; `least`: how many there are."""
    count = len(value) if isinstance(value, list | tuple) else 0
    allowances = tuple(_numbers(value, min(max(least, count), _LONGEST), number(0.0, MOST_OFFSET), "value-lengths"))
    if any(after > before for before, after in pairwise(allowances)):
        raise Wrong(Phrase("value-rising"))
    return allowances


def by_pass(is_open: bool = False) -> Check:
    """Make the check of a number for all passes, or of a list with one for each; `is_open`: above 0."""
    of_one = number(0.0, MOST_MONEY, is_open)

    def check(value: object) -> tuple[float, ...]:
        if not isinstance(value, list | tuple):
            return (of_one(value),)
        if not 0 < len(value) <= _LONGEST:
            raise Wrong(Phrase("value-by-pass"))
        return tuple(map(of_one, value))

    return check


def more_passes(value: object) -> tuple[float, ...]:
    """Check what further passes leave: there may be none."""
    return passes(value, 0)


def tabs(value: object) -> int | tuple[tuple[float, float], ...]:
    """Check how many tabs a contour has, or their places."""
    if isinstance(value, list | tuple):
        if not 0 < len(value) <= MOST_TABS:
            raise Wrong(Phrase("value-tabs", most=MOST_TABS))
        return places(value)
    return whole(1, MOST_TABS)(value)
