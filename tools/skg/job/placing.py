"""Where the part lies on the machine: what becomes its zero, turned, mirrored, scaled."""

from __future__ import annotations

from dataclasses import dataclass

from skg.geometry.plane import XY

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
