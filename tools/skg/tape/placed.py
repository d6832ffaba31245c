"""A tape laid out on the drawing: absolute lines and arcs, in micrometres."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from math import atan2, pi

from skg.piece import Piece
from skg.plane import XY, minus
from skg.tape.block import Block, Tape
from skg.tape.controller import run_block
from skg.tape.moves import closed_moves
from skg.tape.positions import decide

#: The parts of a route that is cut: from the start hole to the contour, the contour, and back to the hole.
WAY_IN, CUT, WAY_BACK = "way in", "cut", "way back"


@dataclass(frozen=True, slots=True)
class Placed(Piece):
    """A block in its place: the line or arc that it is, absolute, in µm."""

    block: Block = field(kw_only=True)

    @classmethod
    def between(cls, block: Block, start: XY, end: XY, centre: XY | None = None) -> Placed:
        """A block from `start` to `end`; `centre` is that of an arc when it is not the block's own.

        The sweep is the block's, corrected by what the ends lie away from where the block alone has them.
        """
        if block.is_line:
            return cls(start, end, block=block)
        if centre is None:
            centre = minus(start, block.start)
        sweep = block.sweep
        if not block.is_full_circle:
            first, last = (atan2(y - centre[1], x - centre[0]) for x, y in (start, end))
            sweep += (last - first - sweep + pi) % (2 * pi) - pi
        return cls(start, end, centre, sweep, block=block)


@dataclass(frozen=True)
class PlacedRoute:
    """The blocks between two stops; `is_move`: positioning (see `Tape.positioning`), else they are cut."""

    blocks: tuple[Placed, ...]
    is_move: bool

    @property
    def start(self) -> XY:
        """Where the route begins, µm."""
        return self.blocks[0].start

    @property
    def gap(self) -> float:
        """Larger coordinate of end minus start, µm."""
        return _apart(self.blocks[-1].end, self.blocks[0].start)

    def parts(self) -> Iterator[tuple[str, tuple[Placed, ...]]]:
        """Split the route into `WAY_IN` and `WAY_BACK`, one block each, and what is `CUT`.

        A way in is a line, the way back the line that goes back along it later on: the path between them is closed.
        There may be several, one after the other, when a contour is cut more than once.
        """
        blocks, at = self.blocks, 0
        while at < len(blocks) and (back := self._way_back(at)):
            yield WAY_IN, blocks[at : at + 1]
            yield CUT, blocks[at + 1 : back]
            yield WAY_BACK, blocks[back : back + 1]
            at = back + 1
        if at < len(blocks):
            yield CUT, blocks[at:]

    def _way_back(self, first: int) -> int | None:
        """The line that goes back along the line `first`."""
        lead = self.blocks[first]
        if not lead.is_line:
            return None
        (dx, dy), arcs = lead.block.move, 0
        for at, placed in enumerate(self.blocks[first + 1 :], first + 1):
            arcs += not placed.is_line
            ex, ey = placed.block.move
            # Each arc between them may have ended beside its place; two lines alone enclose nothing.
            if (
                placed.is_line
                and at > first + 1
                and max(abs(dx + ex), abs(dy + ey)) <= 1
                and _apart(placed.start, lead.end) <= 2 * (arcs + 1)
            ):
                return at
        return None


def _apart(one: XY, other: XY) -> float:
    """The larger coordinate of the way from one place to another."""
    return max(abs(one[0] - other[0]), abs(one[1] - other[1]))


def place(tape: Tape, start: tuple[int, int] = (0, 0), positions: str = "auto") -> list[PlacedRoute]:
    """Lay a tape out from `start` (µm); `positions` is one of `skg.tape.positions.POSITIONS`."""
    machine = decide(tape, positions).positions == "machine"

    def end_to_end(blocks: list[Block], at: XY) -> tuple[list[Placed], XY]:
        moves = [run_block(block).move for block in blocks] if machine else closed_moves(blocks)
        placed = []
        for block, (dx, dy) in zip(blocks, moves, strict=True):
            placed.append(Placed.between(block, at, (at[0] + dx, at[1] + dy)))
            at = placed[-1].end
        return placed, at

    return lay(tape, start, end_to_end)


def lay(tape: Tape, start: XY, place_blocks: Callable[[list[Block], XY], tuple[list[Placed], XY]]) -> list[PlacedRoute]:
    """Lay a tape's routes out one after the other, from `start` (µm).

    `place_blocks` is given the blocks between two stops, at least one, and where the first of them starts; it returns
    them in their places, and where the block after them starts.
    """
    routes: list[PlacedRoute] = []
    for blocks, is_move in zip(tape.stretches(), tape.positioning(), strict=True):
        if blocks:
            placed, start = place_blocks(blocks, start)
            routes.append(PlacedRoute(tuple(placed), is_move))
    return routes


def extents(routes: list[PlacedRoute]) -> tuple[float, float, float, float]:
    """Smallest and largest x and y (xmin, ymin, xmax, ymax) of the routes in µm, bulges of arcs included."""
    xs: list[float] = []
    ys: list[float] = []
    for route in routes:
        for placed in route.blocks:
            places = (placed.start, placed.end) if placed.is_line else placed.extremes()
            for side, ordinates in zip((xs, ys), zip(*places, strict=True), strict=True):
                side += ordinates
        # (one route may have a million blocks, or a million routes one)
        xs[:], ys[:] = [min(xs), max(xs)], [min(ys), max(ys)]
    return (xs[0], ys[0], xs[1], ys[1]) if xs else (0.0, 0.0, 0.0, 0.0)


def stop_places(tape: Tape, routes: list[PlacedRoute], home: XY) -> list[XY]:
    """Where the controller stops, µm, each place once; `home` is where the tape begins."""
    after = {stop.after for stop in tape.stops}
    ends = {one.block.number: one.end for route in routes for one in route.blocks if one.block.number in after}
    return list(dict.fromkeys(ends.get(stop.after, home) for stop in tape.stops))
