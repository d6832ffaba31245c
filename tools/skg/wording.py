"""Numbers and places as a message has them."""

from __future__ import annotations


def short(value: float) -> str:
    """A length as a person writes it: at most four decimals."""
    text = f"{value:.4f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def shown(place: tuple[float, float]) -> str:
    """A place as a person writes it."""
    return f"({short(place[0])}, {short(place[1])})"


def counted(count: int, noun: str, nouns: str = "") -> str:
    """A number with its noun."""
    return f"{count} {noun if count == 1 else nouns or noun + 's'}"
