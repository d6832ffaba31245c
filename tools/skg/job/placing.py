"""The place of the part on the machine: its zero, turn, mirror and scale; and copies of it."""

from __future__ import annotations

from dataclasses import dataclass

from skg.errors import UserError
from skg.geometry.plane import XY
from skg.messages.finding import Finding

#: Places of the part's box, as it lies then, that may be the zero: parts of its width and height.
ORIGINS: dict[str, XY] = {
    "centre": (0.5, 0.5),
    "lower-left": (0.0, 0.0),
    "lower-right": (1.0, 0.0),
    "upper-left": (0.0, 1.0),
    "upper-right": (1.0, 1.0),
}
#: "x": left and right change sides, "y": above and below do.
MIRRORS = ("x", "y")
#: No part is cut more often on one tape.
MOST_COPIES = 2000


@dataclass(frozen=True)
class Place:
    """The part on the machine: mirrored first, then turned, then scaled.

    `origin`: what is 0, 0 then: a place of the drawing, mm, or one of `ORIGINS`, of the box around what is cut; None:
    the drawing's own. `turn`: degrees, counter-clockwise. `mirror`: one of `MIRRORS`, None: not.
    """

    origin: XY | str | None = None
    turn: float = 0.0
    mirror: str | None = None
    scale: float = 1.0


@dataclass(frozen=True)
class Copies:
    """The part, cut several times: in `columns` and `rows`, `step` from one to the next, mm, x and y of the machine; or
    `around` times around the place `about` of the drawing, mm, every so many degrees, counter-clockwise on the
    machine; None: evenly. The first one is where the part lies."""

    columns: int = 1
    rows: int = 1
    step: XY | None = None
    around: int = 1
    about: XY | None = None
    every: float | None = None

    def __post_init__(self) -> None:
        if self.around > 1 and self.columns * self.rows > 1:
            raise UserError(Finding("copies-both"))
        if self.count > MOST_COPIES:
            raise UserError(Finding("copies-too-many", count=self.count, most=MOST_COPIES))
        x, y = self.step or (0.0, 0.0)
        if self.columns > 1 and not x or self.rows > 1 and not y:
            raise UserError(Finding("copies-no-step"))
        if self.around > 1 and self.about is None:
            raise UserError(Finding("copies-no-centre"))

    @property
    def count(self) -> int:
        """The number of them, the first one too."""
        return self.columns * self.rows * self.around

    @property
    def angle(self) -> float:
        """Degrees from one to the next, of those around a place."""
        return 360 / self.around if self.every is None else self.every
