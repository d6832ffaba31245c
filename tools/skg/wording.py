"""Numbers and places as a message has them."""

from __future__ import annotations

from skg.messages.finding import Finding


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


def report_line(
    text: str, contour: int | None = None, place: tuple[float, float] | None = None, is_guess: bool = False
) -> Finding:
    """Make a finding of an English sentence that has no code yet."""
    plain = text.removeprefix("take care: ")
    code = "plain-guess" if is_guess else "plain-lost" if text.startswith("not cut") else "plain"
    return Finding("plain-care" if plain != text else code, contour=contour, place=place, text=plain)
