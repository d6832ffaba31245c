"""Settings for a contour: cut or not, the wire's side and offset, passes, tab, lead, start hole, entry, order."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

#: The side of a contour that the wire runs on.
SIDES = ("auto", "inside", "outside", "left", "right", "on")
#: The way from a start hole to the contour.
LEAD_SHAPES = ("perpendicular", "arc")
#: Which of both takes the clearance between a punch and its die.
CLEARANCE_ON = ("punch", "die")
#: A start hole is this far from the contour where there is room, mm.
LEAD = 3.0


@dataclass(frozen=True)
class CutSettings:
    """The way a contour is cut.

    `cut`: False leaves it, and it stays in the nesting. `offset`: the wire's distance from the contour, mm. `side`: one
    of `SIDES`; auto: around outlines, within the openings in them. `passes`: what each pass leaves to the offset, mm.
    `tab`: the bridge that keeps a part cut from outside, `slug_tab`: the one for the slug of an opening, mm; `tabs`:
    their number on a contour, or a place of each, mm. `tab_passes`: what further cuts of a tab leave to the offset,
    behind one that leaves as much as the first pass, mm. `overlap`: the cut goes on past its start by this, mm.
    `lead`: from a chosen start hole to the contour, mm; `lead_shape`: one of `LEAD_SHAPES`. `start`: the start hole,
    mm, None: chosen. `entry`: the contour is entered there, mm, None: chosen. `order`: its place in the order of
    cutting, from 1, None: chosen. `clearance`: between a punch and its die, on each side, mm, None: it is no such
    contour; `clearance_on`: which of both takes it.
    """

    cut: bool = True
    offset: float = 0.0
    side: str = "auto"
    reverse: bool = False
    passes: tuple[float, ...] = (0.0,)
    tab: float = 0.0
    slug_tab: float = 0.0
    tabs: int | tuple[tuple[float, float], ...] = 1
    tab_passes: tuple[float, ...] = ()
    overlap: float = 0.0
    lead: float = LEAD
    lead_shape: str = "perpendicular"
    start: tuple[float, float] | None = None
    entry: tuple[float, float] | None = None
    order: int | None = None
    clearance: float | None = None
    clearance_on: str = "punch"

    @property
    def is_arc(self) -> bool:
        """Tell whether the wire comes to the contour along an arc."""
        return self.lead_shape == "arc"

    @property
    def widest(self) -> float:
        """The distance between wire and contour in the pass that is furthest aside, mm."""
        return self.offset + max(self.passes) if self.side != "on" else 0.0


@dataclass(frozen=True)
class Overrides:
    """Some of the `CutSettings`, set for all contours, those of a layer, or one; None: not set."""

    cut: bool | None = None
    offset: float | None = None
    side: str | None = None
    reverse: bool | None = None
    passes: tuple[float, ...] | None = None
    tab: float | None = None
    slug_tab: float | None = None
    tabs: int | tuple[tuple[float, float], ...] | None = None
    tab_passes: tuple[float, ...] | None = None
    overlap: float | None = None
    lead: float | None = None
    lead_shape: str | None = None
    start: tuple[float, float] | None = None
    entry: tuple[float, float] | None = None
    order: int | None = None
    clearance: float | None = None
    clearance_on: str | None = None

    def set_fields(self) -> dict[str, Any]:
        """The fields that are set, by name."""
        return {name: value for name, value in vars(self).items() if value is not None}

    def over(self, wanted: CutSettings) -> CutSettings:
        """Settings with the fields that are set here replaced."""
        return replace(wanted, **self.set_fields())
