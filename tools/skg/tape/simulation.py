"""Following a tape as the 3B controller does: where the wire really goes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, overload

from tqdm import tqdm

from skg.messages.finding import Phrase
from skg.tape.block import Block, Tape
from skg.tape.positions import decide

if TYPE_CHECKING:
    from skg.geometry.arrays import Whole
    from skg.tape.moves import Walk

#: A progress bar appears on tapes of more steps than this (about a second's worth).
_LONG = 50_000_000


@dataclass(frozen=True)
class BlockReport:
    """One block: where it should end and where it ended, relative to its start; lengths in µm."""

    number: int
    block: str
    should: tuple[int, int]
    really: tuple[int, int]
    steps: int
    off_curve: float


@dataclass(frozen=True)
class RouteReport:
    """The blocks between two stops.

    `gap` is where the controller ended minus where it started, µm; `programmed_gap` the same summed over the
    ends that the blocks should have had. `is_move`: positioning, nothing is cut (see `Tape.positioning`).
    """

    first: int
    last: int
    gap: tuple[int, int]
    programmed_gap: tuple[int, int]
    is_move: bool


@dataclass(frozen=True)
class Report:
    """A whole tape; lengths in µm, times in seconds. `gap` is the larger of all cut routes' gaps; `positions` is where
    the blocks were taken to start, "programmed" or "machine"."""

    name: str
    positions: str
    blocks: int
    stops: int
    travel: float
    steps: int
    feed: float
    time: float
    gap: tuple[int, int]
    programmed_gap: tuple[int, int]
    end: tuple[int, int]
    off_curve: float
    off_path: float
    misses: int
    largest_miss: int
    largest_drift: int
    routes: tuple[RouteReport, ...]
    each: Sequence[BlockReport]

    @property
    def closed(self) -> bool:
        """True when every route that is cut ends where it began."""
        return self.gap == (0, 0)


class _Each(Sequence[BlockReport]):
    """The reports of all blocks of a tape, each made when it is asked for."""

    def __init__(self, blocks: Sequence[Block], should: Whole, walk: Walk) -> None:
        self.blocks, self.columns = blocks, (should, walk.moves, walk.steps, walk.off_curve)

    def __len__(self) -> int:
        return len(self.blocks)

    @overload
    def __getitem__(self, index: int) -> BlockReport: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[BlockReport]: ...
    def __getitem__(self, index: int | slice) -> BlockReport | Sequence[BlockReport]:
        if isinstance(index, slice):
            return [self[place] for place in range(len(self))[index]]
        should, really, steps, off_curve = (column[index].tolist() for column in self.columns)
        block = self.blocks[index]
        return BlockReport(block.number, str(block), tuple(should), tuple(really), steps, off_curve)


def simulate(tape: Tape, feed: float = 5.0, positions: str = "auto") -> Report:
    """Follow every block of `tape`.

    `feed` is in mm/min. A bar is shown on stderr when that is a terminal and the tape long. `positions`
    (see `skg.tape.positions`): "programmed" takes a block to start where the moves (`closed_moves`) that the
    blocks before it should have made add up to, "machine" where the controller stands, as a tape without drift
    means it.
    """
    # (these load numpy)
    import numpy as np

    from skg.tape.columns import columns_of
    from skg.tape.moves import closed_moves, expected_steps, walk

    positions = decide(tape, positions).positions
    columns = columns_of(tape)
    total = int(expected_steps(columns).sum())
    bar = tqdm(total=total, unit="step", unit_scale=True, delay=0.5, leave=False,
               disable=None if total > _LONG else True)  # fmt: skip
    should = closed_moves(tape) if positions == "programmed" else None
    with bar:
        walked = walk(tape, np.arange(len(columns)), should, bar.update)
    should = walked.moves if should is None else should
    # The controller's position, and the sum of the programmed moves, before each block and at the end.
    real, programmed = (np.concatenate([[[0, 0]], moves]).cumsum(axis=0) for moves in (walked.moves, should))

    def gap(places: Whole, first: int, last: int) -> tuple[int, int]:
        x, y = (places[last] - places[first]).tolist()
        return x, y

    routes = [
        RouteReport(first + 1, last, gap(real, first, last), gap(programmed, first, last), is_move)
        for (first, last), is_move in zip(tape.bounds, tape.positioning(), strict=True)
        if first < last
    ]
    cut = [route for route in routes if not route.is_move] or [RouteReport(0, 0, (0, 0), (0, 0), False)]
    travel = sum(columns.lengths.tolist())
    missed = abs(walked.moves - should).max(axis=1, initial=0)
    return Report(
        name=tape.name, positions=positions, blocks=len(columns), stops=len(tape.stops),
        travel=travel, steps=int(walked.steps.sum()), feed=feed, time=travel / 1000 / feed * 60,
        gap=max((route.gap for route in cut), key=_size),
        programmed_gap=max((route.programmed_gap for route in cut), key=_size), end=tuple(real[-1].tolist()),
        off_curve=float(walked.off_curve.max(initial=0)), off_path=float(walked.off_path.max(initial=0)),
        misses=int((missed > 0).sum()), largest_miss=int(missed.max(initial=0)),
        largest_drift=int(abs(real - programmed).max()), routes=tuple(routes),
        each=_Each(tape.blocks, should, walked))  # fmt: skip


def _size(gap: tuple[int, int]) -> int:
    return max(abs(gap[0]), abs(gap[1]))


def closing(gap: tuple[int, int]) -> Phrase:
    """Tell whether a path closes; `gap`: from its start to its end, µm."""
    return Phrase("path-closes") if gap == (0, 0) else Phrase("path-open", dx=gap[0], dy=gap[1])


def duration(seconds: float) -> Phrase:
    """A time as hours and minutes, or minutes and seconds."""
    whole = round(seconds)
    hours, minutes = whole // 3600, whole // 60 % 60
    if hours:
        return Phrase("hours", hours=hours, minutes=minutes)
    return Phrase("minutes", minutes=minutes, seconds=whole % 60)
