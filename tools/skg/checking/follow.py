"""Following a tape that cuts planned contours with the controller: its blocks in their places, cut by cut."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from skg.errors import UserError
from skg.geometry.arrays import Floats, hypots
from skg.messages.finding import Finding
from skg.planning.planned import PlannedContour
from skg.tape.block import Tape, micrometres
from skg.tape.columns import columns_of
from skg.tape.layout import Laid
from skg.tape.moves import closed_moves, walk


@dataclass(frozen=True)
class Stretch:
    """One stretch of cutting, from where the wire is threaded: whose it is, which passes it has, which blocks of the
    tape, what the wire travels (mm), and how far from its beginning it ends (µm)."""

    contour: int
    passes: tuple[int, ...]
    blocks: slice
    length: float
    gap: tuple[int, int]


@dataclass(frozen=True)
class Followed:
    """The controller's path: a tape's blocks in their places (µm), how far its steps go aside of each (µm), the
    cuts among them, how far the misses of blocks have put it beside where the tape has them begin (mm, 0 without
    drift)."""

    laid: Laid
    off_curve: Floats
    cuts: list[Stretch]
    drift: float


def follow(tape: Tape, contours: list[PlannedContour], is_without_drift: bool) -> Followed:
    """Follow a tape from the first start hole with the controller.

    `is_without_drift`: blocks start where the controller stands; else its misses add up beside what is compared. A tape
    whose stops are not those of the contours is a `UserError`.
    """
    owners = [(number, passes) for number, planned in enumerate(contours) for passes in _between_stops(planned)]
    if len(tape.bounds) != 2 * len(owners) - 1:
        raise UserError(Finding("wrong-stops", stops=len(tape.bounds) - 1, expected=2 * len(owners) - 2))
    columns = columns_of(tape)
    walked = walk(tape, np.arange(len(columns)))
    home = [micrometres(ordinate) for ordinate in contours[0].start]
    moves = walked.moves if is_without_drift else closed_moves(tape)
    places = np.cumsum([home, *moves], axis=0)
    drift = 0.0
    if not is_without_drift:
        drift = float(hypots(*np.cumsum(walked.moves - moves, axis=0).T).max(initial=0.0)) / 1000
    laid = Laid.between(tape.blocks, columns, places)
    firsts, lasts = np.array(tape.bounds[::2]).T
    gaps = (places[lasts] - places[firsts]).tolist()
    lengths = laid.lengths()
    cuts = [
        Stretch(*owner, slice(first, last), float(lengths[first:last].sum()) / 1000, tuple(gap))
        for owner, (first, last), gap in zip(owners, tape.bounds[::2], gaps, strict=True)
    ]
    return Followed(laid, walked.off_curve, cuts, drift)


def _between_stops(planned: PlannedContour) -> list[tuple[int, ...]]:
    """The numbers of the passes that follow each other without a stop; -1: all of them in one cut."""
    if not planned.contour.is_closed:
        return [(-1,)]
    if len(planned.passes) == 1 and not planned.tabs.each:
        return [(0,)]
    groups: list[tuple[int, ...]] = []
    for run in planned.runs():
        if not groups or run.stop:
            groups.append(())
        groups[-1] += (run.number,)
    return groups
