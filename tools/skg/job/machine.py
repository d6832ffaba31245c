"""The table [machine] of a job, in three: what is set up on the cutting machine, the board, and the policy."""

from __future__ import annotations

from dataclasses import dataclass

from skg.errors import UserError
from skg.job.values import MOST_OFFSET
from skg.messages.finding import Finding

#: The ROMs that make a tape from a drawing.
ROMS = ("no-drift", "standard")
#: Settings for contours that are too small for the wire, and for those whose wire comes into others.
SMALL, INTO = ("refuse", "leave"), ("refuse", "cut")


@dataclass(frozen=True)
class Setup:
    """The wire, the stock, and how fast one goes through the other.

    `wire`: its diameter, `gap`: the spark gap on each side, `offset`: the wire's distance from the contours instead of
    these, all mm, None: not told. `feed`: mm/min. `material`: a text for the setup sheet; `thickness`: of the stock,
    mm; `rates`: mm² a minute in each pass, further passes as the last: with both the time goes by these.
    """

    wire: float | None = None
    gap: float | None = None
    offset: float | None = None
    feed: float = 5.0
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
class BoardOptions:
    """The board that makes the tape. `rom`: one of `ROMS`; `ram`: KiB."""

    rom: str = ROMS[0]
    ram: int = 8

    @property
    def is_without_drift(self) -> bool:
        """Tell whether a tape's blocks start where the controller stands."""
        return self.rom == "no-drift"


@dataclass(frozen=True)
class Policy:
    """The policy on contours without room (`small`, one of `SMALL`), and on those whose wire comes into others
    (`into`, one of `INTO`); empty where nobody is asked."""

    small: str = SMALL[0]
    into: str = INTO[0]


#: Their usual values.
USUAL_SETUP, USUAL_BOARD, USUAL_POLICY = Setup(), BoardOptions(), Policy()
#: The policy of tapes that are made without a drawing: what has no room is refused, and no setting helps.
UNASKED = Policy("", "")
