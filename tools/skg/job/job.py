"""The job: a drawing, how it is read, the machine, and what is wanted of its layers and contours."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from skg.errors import UserError
from skg.geometry.plane import XY
from skg.job.machine import USUAL_BOARD, USUAL_POLICY, USUAL_SETUP, BoardOptions, Policy, Setup
from skg.job.placing import Copies, Place
from skg.job.read_options import ReadOptions
from skg.job.wanted import CutSettings, Overrides
from skg.messages.finding import Finding, Phrase
from skg.tape.styles import STYLES

#: A box: its smallest x and y, its largest x and y, mm.
Box = tuple[float, float, float, float]
#: Kinds of contours: cut from outside, from inside, or along.
KINDS = ("outline", "opening", "open")


@dataclass(frozen=True)
class TapeForm:
    """The form in which the control takes a 3B tape. `style`: one of `STYLES`; `short_name`: its name has at most eight
    letters, digits, - or _, and ends in .3b."""

    style: str = next(iter(STYLES))
    short_name: bool = False

    def refuse_name(self, name: str) -> None:
        """Raise a `UserError` where the control does not take a tape of that name."""
        if self.short_name and not re.fullmatch(r"[A-Za-z0-9_-]{1,8}\.3b", name, re.IGNORECASE):
            raise UserError(Finding("name-not-short").within(name))


@dataclass(frozen=True)
class Price:
    """Prices; `currency`: a text. `per_area`: of a mm² in each pass, further passes as the last; `per_hole`: of a start
    hole; `per_pass`: of each pass along a contour."""

    per_area: tuple[float, ...] = ()
    per_hole: float = 0.0
    per_pass: float = 0.0
    currency: str = ""


@dataclass(frozen=True)
class Chosen:
    """One contour, and what is said of it. `layer`: one that it is on; `kind`: one of `KINDS`. It is found again by a
    `place` on it and by its `size`, mm."""

    layer: str
    kind: str
    place: XY
    size: XY
    overrides: Overrides = Overrides()

    @property
    def name(self) -> Phrase:
        """Its name in a message."""
        (x, y), (width, height) = self.place, self.size
        kind = Phrase(f"kind-{self.kind}")
        return Phrase("chosen-name", kind=kind, width=width, height=height, x=x, y=y, layer=self.layer)


@dataclass(frozen=True)
class Job:
    """Settings for a drawing; all lengths in mm.

    `drawing`: a file's name, `sha256` of its bytes, `box` around its contours; these are empty, or None, where nobody
    has read it. `place`, `copies`: where the part lies on the machine, how often; all places of a job
    are the drawing's. `starts`: start holes instead of those that are drawn. A contour beats its layer, a layer beats
    `default`; of a contour's layers the one that comes first in `layers`.
    """

    drawing: str
    sha256: str = ""
    box: Box | None = None
    read: ReadOptions = ReadOptions(open=None)
    setup: Setup = USUAL_SETUP
    board: BoardOptions = USUAL_BOARD
    policy: Policy = USUAL_POLICY
    tape: TapeForm = TapeForm()
    place: Place = Place()
    copies: Copies = Copies()
    price: Price = Price()
    starts: tuple[XY, ...] = ()
    default: Overrides = Overrides()
    layers: Mapping[str, Overrides] = field(default_factory=dict)
    contours: tuple[Chosen, ...] = ()

    def of(self, layers: Iterable[str], chosen: Chosen | None = None) -> CutSettings:
        """Settings for a contour on some layers."""
        wanted = self.default.over(CutSettings(offset=self.setup.distance))
        on = {layer.lower() for layer in layers}
        for name, overrides in reversed(list(self.layers.items())):
            if name.lower() in on:
                wanted = overrides.over(wanted)
        if not chosen:
            return wanted
        overrides = chosen.overrides
        # (a contour by itself is what it is)
        return overrides.over(wanted if overrides.tab is None else replace(wanted, slug_tab=overrides.tab))

    @property
    def is_beside(self) -> bool:
        """Tell whether the wire runs beside contours somewhere."""
        every = (self.default, *self.layers.values(), *(chosen.overrides for chosen in self.contours))
        return bool(self.setup.distance) or any(overrides.offset for overrides in every)
