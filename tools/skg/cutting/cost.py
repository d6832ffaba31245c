"""The area that a cut takes, and its price: whole mm², money with two decimals, the sum that of its parts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from decimal import ROUND_HALF_UP, Decimal

from skg.cutting.holes import holes_of
from skg.cutting.ladder import CutResult
from skg.job.job import Price
from skg.messages.finding import Finding, Phrase

_CENT = Decimal("0.01")


@dataclass(frozen=True)
class Cost:
    """Area, start holes and passes of a cut, and their price.

    `areas`: mm² in each pass, none without the stock's thickness; `holes`: start holes, each once; `passes`: along
    contours. `parts`: what the areas, the holes and the passes come to, None: without prices, or without a thickness
    that they want. `is_without`: so do the prices, or the rates.
    """

    thickness: float | None
    areas: tuple[int, ...]
    holes: int
    passes: int
    parts: tuple[Decimal, Decimal, Decimal] | None
    currency: str
    is_without: bool

    @classmethod
    def of(cls, result: CutResult, price: Price) -> Cost:
        """The cost of a tape at some prices. The area is the wire's path, leads included, times the thickness."""
        setup = result.setup
        thick = setup.thickness
        areas = tuple(round(length * thick) for length in result.checked.lengths) if thick else ()
        holes = len(holes_of(result.contours))
        passes = sum(len(planned.passes) for planned in result.contours)
        is_wanted = any((*price.per_area, price.per_hole, price.per_pass))
        is_without = not thick and any((*price.per_area, *setup.rates))
        parts: tuple[Decimal, Decimal, Decimal] | None = None
        if is_wanted and (thick or not any(price.per_area)):
            of_passes = [
                price.per_area[min(turn, len(price.per_area) - 1)] for turn in range(len(areas)) if price.per_area
            ]
            of_areas = sum((area * _exact(each) for area, each in zip(areas, of_passes, strict=False)), Decimal(0))
            sums = of_areas, holes * _exact(price.per_hole), passes * _exact(price.per_pass)
            by_area, by_hole, by_pass = (each.quantize(_CENT, ROUND_HALF_UP) for each in sums)
            parts = by_area, by_hole, by_pass
        return cls(thick, areas, holes, passes, parts, price.currency, is_without)

    @property
    def area(self) -> int:
        """The area of all passes, mm²."""
        return sum(self.areas)

    @property
    def price(self) -> str:
        """The price with its currency, nothing where there is none."""
        return f"{sum(self.parts)} {self.currency}".strip() if self.parts else ""

    def findings(self) -> Iterator[Finding]:
        """The lines of a report."""
        yield from self.figures()
        if self.is_without:
            yield Finding("no-thickness")

    def figures(self) -> Iterator[Finding]:
        """Area and price, where they are known."""
        if self.thickness:
            by = Phrase("area-by-pass", areas=self.areas) if len(self.areas) > 1 else None
            yield Finding("area", area=self.area, thickness=self.thickness, by=by)
        if self.parts:
            about = (
                Phrase("price-of-area", area=self.area),
                Phrase("count-holes", count=self.holes),
                Phrase("price-of-passes", count=self.passes),
            )
            parts = zip(self.parts, about, strict=True)
            told = tuple(Phrase("price-part", amount=str(amount), what=what) for amount, what in parts if amount)
            yield Finding("price", price=self.price, parts=told)

    def data(self) -> dict[str, object]:
        """The same as plain data."""
        price = None
        if self.parts:
            names = ("area", "holes", "passes", "total")
            amounts = (float(amount) for amount in (*self.parts, sum(self.parts)))
            price = dict(zip(names, amounts, strict=True)) | {"currency": self.currency}
        area = self.area if self.thickness else None
        return {"area": area, "areas": list(self.areas), "holes": self.holes, "passes": self.passes, "price": price}


def _exact(price: float) -> Decimal:
    """A price as it was typed."""
    return Decimal(repr(price))
