"""Following a tape as the 3B controller does: where the wire really goes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from tqdm import tqdm

from skg.plane import XY
from skg.tape.block import Block, Tape
from skg.tape.controller import Outcome, run_block
from skg.tape.moves import closed_moves
from skg.tape.positions import decide

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
    each: tuple[BlockReport, ...]

    @property
    def closed(self) -> bool:
        """True when every route that is cut ends where it began."""
        return self.gap == (0, 0)


def expected_steps(block: Block) -> int:
    """About how many steps a block takes: those on both axes, from its shape alone."""
    return block.x + block.y if block.is_line else 2 * block.j


def _follow(
    blocks: list[Block], moves: list[XY] | None, drift: XY, progress: Callable[[int], object] = lambda steps: None
) -> Iterator[tuple[Block, XY, Outcome]]:
    """Run blocks that should make these moves, or (None) are right where they end; `drift` is how far the controller
    is off before them, µm. Gives each block's move as it should be, and what came of it."""
    for at, block in enumerate(blocks):
        outcome = run_block(block, drift, progress)
        should = moves[at] if moves else outcome.move
        yield block, should, outcome
        drift = drift[0] + outcome.move[0] - should[0], drift[1] + outcome.move[1] - should[1]


def simulate(tape: Tape, feed: float = 5.0, progress: bool = False, positions: str = "auto") -> Report:
    """Follow every block of `tape`.

    `feed` is in mm/min; `progress` shows a bar on stderr when that is a terminal and the tape long. `positions`
    (see `skg.tape.positions`): "programmed" takes a block to start where the moves (`closed_moves`) that the
    blocks before it should have made add up to, "machine" where the controller stands, as a tape without drift
    means it.
    """
    positions = decide(tape, positions).positions
    each: list[BlockReport] = []
    routes: list[RouteReport] = []
    real, programmed = (0, 0), (0, 0)
    at_stop = real, programmed, 1
    total = sum(expected_steps(block) for block in tape.blocks)
    off_curve = off_path = 0.0
    largest_drift = 0
    bar = tqdm(total=total, unit="step", unit_scale=True, delay=0.5, leave=False,
               disable=None if progress and total > _LONG else True)  # fmt: skip

    def close_route(last: int, is_move: bool) -> None:
        nonlocal at_stop
        (x, y), (xp, yp), first = at_stop
        if last >= first:
            routes.append(
                RouteReport(first, last, (real[0] - x, real[1] - y), (programmed[0] - xp, programmed[1] - yp), is_move)
            )
        at_stop = real, programmed, last + 1

    with bar:
        for blocks, is_move in zip(tape.stretches(), tape.positioning(), strict=True):
            moves = closed_moves(blocks) if positions == "programmed" else None
            drift = real[0] - programmed[0], real[1] - programmed[1]
            for block, should, outcome in _follow(blocks, moves, drift, bar.update):
                each.append(
                    BlockReport(block.number, str(block), should, outcome.move, outcome.steps, outcome.off_curve)
                )
                real = real[0] + outcome.move[0], real[1] + outcome.move[1]
                programmed = programmed[0] + should[0], programmed[1] + should[1]
                off_curve = max(off_curve, outcome.off_curve)
                off_path = max(off_path, outcome.off_path)
                largest_drift = max(largest_drift, _size((real[0] - programmed[0], real[1] - programmed[1])))
            close_route(len(each), is_move)
    cut = [route for route in routes if not route.is_move] or [RouteReport(0, 0, (0, 0), (0, 0), False)]
    travel = sum(block.length for block in tape.blocks)
    missed = [max(abs(one.really[0] - one.should[0]), abs(one.really[1] - one.should[1])) for one in each]
    return Report(
        name=tape.name, positions=positions, blocks=len(each), stops=len(tape.stops),
        travel=travel, steps=sum(one.steps for one in each), feed=feed, time=travel / 1000 / feed * 60,
        gap=max((route.gap for route in cut), key=_size),
        programmed_gap=max((route.programmed_gap for route in cut), key=_size), end=real,
        off_curve=off_curve, off_path=off_path,
        misses=sum(miss > 0 for miss in missed), largest_miss=max(missed, default=0),
        largest_drift=largest_drift, routes=tuple(routes), each=tuple(each))  # fmt: skip


def _size(gap: tuple[int, int]) -> int:
    return max(abs(gap[0]), abs(gap[1]))


def closing(gap: tuple[int, int]) -> str:
    """Say whether a path closes."""
    return "closes to 0 µm" if gap == (0, 0) else f"open by {gap[0]}, {gap[1]} µm"


def duration(seconds: float) -> str:
    """Write a time as hours, minutes and seconds."""
    whole = round(seconds)
    hours, minutes = whole // 3600, whole // 60 % 60
    return f"{hours} h {minutes:02d} min" if hours else f"{minutes} min {whole % 60:02d} s"
