"""The job: a drawing, how it is read, the machine, and what is wanted of its layers and contours."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from skg.errors import UserError
from skg.geometry.plane import XY
from skg.job.placing import Copies, Place
from skg.job.read_options import Wishes
from skg.job.values import MOST_OFFSET
from skg.job.wanted import Partial, Wanted
from skg.messages.finding import Finding, Phrase
from skg.tape.styles import STYLES

#: A box: its smallest x and y, its largest x and y, mm.
Box = tuple[float, float, float, float]
#: The ROMs that make a tape from a drawing.
ROMS = ("no-drift", "standard")
#: Settings for contours that are too small for the wire, and for those whose wire comes into others.
SMALL, INTO = ("refuse", "leave"), ("refuse", "cut")
#: Kinds of contours: cut from outside, from inside, or along.
KINDS = ("outline", "opening", "open")


@dataclass(frozen=True)
class MachineSetup:
    """The wire, the board that makes the tape, the stock.

    `wire`: its diameter, `gap`: the spark gap on each side, `offset`: the wire's distance from the contours instead of
    these, all mm, None: not told. `rom`: one of `ROMS`; `ram`: KiB; `feed`: mm/min. `small`, `into`: what becomes of
    contours without room, empty where nobody is asked. `material`: a text for the setup sheet; `thickness`: of the
    stock, mm; `rates`: mm² a minute in each pass, further passes as the last: with both the time goes by these.
    """

    wire: float | None = None
    gap: float | None = None
    offset: float | None = None
    rom: str = ROMS[0]
    ram: int = 8
    feed: float = 5.0
    small: str = SMALL[0]
    into: str = INTO[0]
    material: str = ""
    thickness: float | None = None
    rates: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        if self.offset is not None and (self.wire is not None or self.gap):
            raise UserError(Finding("offset-and-wire"))
        if self.gap and self.wire is None:
            raise UserError(Finding("gap-without-wire"))
        if self.distance > MOST_OFFSET:
            raise UserError(Finding("offset-too-large", distance=self.distance, most=MOST_OFFSET))

    @property
    def is_without_drift(self) -> bool:
        """Tell whether a tape's blocks start where the controller stands."""
        return self.rom == "no-drift"

    def pace(self, turn: int) -> float:
        """The feed in a pass (from 0), mm/min."""
        if not self.has_rates or self.thickness is None:
            return self.feed
        return self.rates[min(turn, len(self.rates) - 1)] / self.thickness

    @property
    def has_rates(self) -> bool:
        """Tell whether the time goes by rates, and not by the feed."""
        return bool(self.rates and self.thickness)

    @property
    def distance(self) -> float:
        """The wire's distance from the contours, mm."""
        return self.wire / 2 + (self.gap or 0.0) if self.wire is not None else self.offset or 0.0


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
    partial: Partial = Partial()

    @property
    def name(self) -> Phrase:
        """Its name in a message."""
        (x, y), (width, height) = self.place, self.size
        kind = Phrase(f"kind-{self.kind}")
        return Phrase("chosen-name", kind=kind, width=width, height=height, x=x, y=y, layer=self.layer)


@dataclass(frozen=True)
class Job:
    """Wishes for a drawing; all lengths in mm.

    `drawing`: a file's name, `sha256` of its bytes, `box` around its contours; these are empty, or None, where nobody
    has read it. `place`, `copies`: where the part lies on the machine, how often; all places of a job
    are the drawing's. `starts`: start holes instead of those that are drawn. A contour beats its layer, a layer beats
    `default`; of a contour's layers the one that comes first in `layers`.
    """

    drawing: str
    sha256: str = ""
    box: Box | None = None
    read: Wishes = Wishes(open=None)
    machine: MachineSetup = MachineSetup()
    tape: TapeForm = TapeForm()
    place: Place = Place()
    copies: Copies = Copies()
    price: Price = Price()
    starts: tuple[XY, ...] = ()
    default: Partial = Partial()
    layers: Mapping[str, Partial] = field(default_factory=dict)
    contours: tuple[Chosen, ...] = ()

    def of(self, layers: Iterable[str], chosen: Chosen | None = None) -> Wanted:
        """Wishes for a contour on some layers."""
        wanted = self.default.over(Wanted(offset=self.machine.distance))
        on = {layer.lower() for layer in layers}
        for name, partial in reversed(list(self.layers.items())):
            if name.lower() in on:
                wanted = partial.over(wanted)
        if not chosen:
            return wanted
        partial = chosen.partial
        # (a contour by itself is what it is)
        return partial.over(wanted if partial.tab is None else replace(wanted, slug_tab=partial.tab))

    @property
    def is_beside(self) -> bool:
        """Tell whether the wire runs beside contours somewhere."""
        every = (self.default, *self.layers.values(), *(chosen.partial for chosen in self.contours))
        return bool(self.machine.distance) or any(partial.offset for partial in every)
