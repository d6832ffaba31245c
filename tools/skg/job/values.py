"""The values that a job may have; each check returns the value, or raises a `Wrong` that says what is expected."""

from __future__ import annotations

from collections.abc import Callable, Collection
from itertools import pairwise
from math import inf
from pathlib import Path

Check = Callable[[object], object]

#: No wire with its spark gap is wider than twice this, mm.
MOST_OFFSET = 5.0
#: No machine cuts more slowly, mm/min.
LEAST_FEED = 0.001
#: FIT comes no nearer to a curve, mm.
LEAST_FIT = 1e-5
#: The board's RAM, KiB.
RAM = 2, 56
#: No place is farther from the origin, no length longer, mm: a tape ends there.
FARTHEST = 100_000.0
#: No text is longer.
_LONGEST = 200


class Wrong(ValueError):
    """A value that no job has: what is expected, in words."""


def flag(value: object) -> bool:
    """Check a yes or no."""
    if not isinstance(value, bool):
        raise Wrong("expected true or false")
    return value


def text(value: object) -> str:
    """Check a text of one line."""
    if not isinstance(value, str) or not value.strip() or len(value) > _LONGEST or not value.isprintable():
        raise Wrong(f"expected a text of one line, at most {_LONGEST} characters")
    return value


def name(value: object) -> str:
    """Check the name of a layer: a drawing may have any."""
    if not isinstance(value, str):
        raise Wrong("expected a name")
    return value


def file_name(value: object) -> str:
    """Check the name of a file, without a folder."""
    if not isinstance(value, str) or value in ("", "..") or "\0" in value or Path(value).name != value:
        raise Wrong("expected the name of a file in the same folder")
    return value


def checksum(value: object) -> str:
    """Check a SHA-256 in hexadecimal digits."""
    if not isinstance(value, str) or len(value) != 64 or set(value.lower()) - set("0123456789abcdef"):
        raise Wrong("expected a SHA-256, 64 hexadecimal digits")
    return value.lower()


def names(value: object) -> tuple[str, ...]:
    """Check a list of names."""
    if not isinstance(value, list | tuple):
        raise Wrong("expected a list of names")
    return tuple(map(name, value))


def choice(among: Collection[str]) -> Check:
    """Make the check of one of some words."""

    def check(value: object) -> str:
        if not isinstance(value, str) or value not in among:
            raise Wrong(f"expected {', '.join(among)}")
        return value

    return check


def number(low: float = -FARTHEST, high: float = FARTHEST, is_open: bool = False) -> Check:
    """Make the check of a number in a range; `is_open`: without its lower end."""

    def check(value: object) -> float:
        is_number = isinstance(value, int | float) and not isinstance(value, bool)
        if not is_number or not low <= value <= high or is_open and value == low:
            more = "above" if is_open else "from"
            raise Wrong(f"expected a number {more} {low:g}" + f" to {high:g}" * (high < inf))
        return float(value)

    return check


def whole(low: int, high: int) -> Check:
    """Make the check of a whole number in a range."""

    def check(value: object) -> int:
        if not isinstance(value, int) or isinstance(value, bool) or not low <= value <= high:
            raise Wrong(f"expected a whole number from {low} to {high}")
        return value

    return check


def place(value: object) -> tuple[float, float]:
    """Check a place, [x, y]."""
    x, y = _numbers(value, 2, number(), "a place [x, y], mm")
    return x, y


def size(value: object) -> tuple[float, float]:
    """Check a size, [width, height]."""
    width, height = _numbers(value, 2, number(0.0), "a size [width, height], mm")
    return width, height


def box(value: object) -> tuple[float, float, float, float]:
    """Check a box, [left, low, right, high]."""
    left, low, right, high = _numbers(value, 4, number(), "a box [left, low, right, high], mm")
    return left, low, right, high


def _numbers(value: object, count: int, check: Check, expected: str) -> list[float]:
    if not isinstance(value, list | tuple) or len(value) != count:
        raise Wrong(f"expected {expected}")
    try:
        return list(map(check, value))
    except Wrong:
        raise Wrong(f"expected {expected}") from None


def places(value: object) -> tuple[tuple[float, float], ...]:
    """Check a list of places."""
    if not isinstance(value, list | tuple):
        raise Wrong("expected a list of places [x, y], mm")
    return tuple(map(place, value))


def passes(value: object) -> tuple[float, ...]:
    """Check what the passes leave, none of them more than the one before it."""
    count = len(value) if isinstance(value, list | tuple) else 0
    allowances = tuple(
        _numbers(value, min(max(1, count), _LONGEST), number(0.0, MOST_OFFSET), "lengths in mm, such as 0.06, 0.02, 0")
    )
    if any(after > before for before, after in pairwise(allowances)):
        raise Wrong("a pass that leaves more than the one before it cuts nothing")
    return allowances
