"""Numbers and places as a message has them."""

from __future__ import annotations

from dataclasses import dataclass


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


@dataclass(frozen=True)
class ReportLine:
    """A line of a report. `contour`: the number (from 0) of the contour, among those that were read, that it is about;
    `place`: where, mm. `is_guess`: it says what nobody told."""

    text: str
    contour: int | None = None
    place: tuple[float, float] | None = None
    is_guess: bool = False

    @property
    def is_care(self) -> bool:
        """Tell whether somebody should take care."""
        return self.text.startswith("take care")

    @property
    def is_kept(self) -> bool:
        """Tell whether --quiet keeps it."""
        return self.is_care or self.is_guess or self.text.startswith("not cut")
