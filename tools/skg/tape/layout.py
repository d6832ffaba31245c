"""A tape laid out on the drawing: its blocks in their places, absolute lines and arcs, in micrometres."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import chain
from math import pi
from typing import overload

import numpy as np
from numpy.typing import NDArray

from skg.geometry.arrays import Flags, Floats, directions, hypots
from skg.geometry.piece import Piece
from skg.geometry.plane import XY
from skg.tape.block import Block, Tape
from skg.tape.block_list import Blocks
from skg.tape.columns import Columns, columns_of
from skg.tape.moves import closed_moves, machine_moves
from skg.tape.positions import decide

#: So many blocks at once leave the columns.
AT_ONCE = 4096
#: Directions of the four half-axes.
_QUARTERS = np.array([[1, 0], [0, 1], [-1, 0], [0, -1]])
#: The parts of a route that is cut: from the start hole to the contour, the contour, and back to the hole.
WAY_IN, CUT, WAY_BACK = "way in", "cut", "way back"


@dataclass(frozen=True, slots=True)
class Placed(Piece):
    """A block in its place: the line or arc that it is, absolute, in µm."""

    block: Block = field(kw_only=True)


@dataclass(frozen=True)
class PlacedRoute:
    """The blocks between two stops; `is_move`: positioning (see `Tape.positioning`), else they are cut."""

    blocks: Sequence[Placed]
    is_move: bool

    @property
    def start(self) -> XY:
        """Start of the route, µm."""
        return self.blocks[0].start

    @property
    def gap(self) -> float:
        """Larger coordinate of end minus start, µm."""
        return _apart(self.blocks[-1].end, self.blocks[0].start)

    def parts(self) -> Iterator[tuple[str, Sequence[Placed]]]:
        """Split the route into `WAY_IN` and `WAY_BACK`, one block each, and what is `CUT`.

        A way in is a line, the way back the line that goes back along it later on: the path between them is closed.
        There may be several, one after the other, when a contour is cut more than once.
        """
        blocks, index = self.blocks, 0
        while index < len(blocks) and (back := self._way_back(index)):
            yield WAY_IN, blocks[index : index + 1]
            yield CUT, blocks[index + 1 : back]
            yield WAY_BACK, blocks[back : back + 1]
            index = back + 1
        if index < len(blocks):
            yield CUT, blocks[index:]

    def _way_back(self, first: int) -> int | None:
        """The line that goes back along the line `first`."""
        lead = self.blocks[first]
        if not lead.is_line:
            return None
        (dx, dy), arcs = lead.block.move, 0
        for index, placed in enumerate(self.blocks[first + 1 :], first + 1):
            if not placed.is_line:
                arcs += 1
                continue
            ex, ey = placed.block.move
            # Each arc between them may have ended beside its place; two lines alone enclose nothing.
            if (
                index > first + 1
                and max(abs(dx + ex), abs(dy + ey)) <= 1
                and _apart(placed.start, lead.end) <= 2 * (arcs + 1)
            ):
                return index
        return None


class Laid(Sequence[Placed]):
    """Blocks in their places, as columns: each becomes a `Placed` when it is asked for.

    `starts`, `ends`, `centres` (n × 2, µm; a line's centre is nothing), `sweeps` (n, radians), `is_line` (n).
    """

    def __init__(
        self, blocks: Sequence[Block], starts: NDArray, ends: NDArray, centres: NDArray, sweeps: Floats, is_line: Flags
    ) -> None:
        self.blocks = blocks
        self.starts, self.ends, self.centres, self.sweeps, self.is_line = starts, ends, centres, sweeps, is_line

    @classmethod
    def between(cls, blocks: Sequence[Block], columns: Columns, places: NDArray) -> Laid:
        """Blocks that end where the next one begins, at n + 1 places; as `apart` has them."""
        return cls.apart(blocks, columns, places[:-1], places[1:])

    @classmethod
    def apart(cls, blocks: Sequence[Block], columns: Columns, starts: NDArray, ends: NDArray) -> Laid:
        """Blocks between starts and ends (n × 2 each).

        A sweep is the block's, corrected by what the ends lie away from where the block alone has them.
        """
        centres = np.empty(starts.shape, np.result_type(starts, columns.x))
        sweeps = np.empty(len(columns))
        for part, some in columns.shares():
            centres[part], sweeps[part] = starts[part] - some.starts, some.sweeps
            rows = part.start + np.flatnonzero(some.is_arc)
            first, last = (directions(side[rows] - centres[rows]) for side in (starts, ends))
            sweeps[rows] += (last - first - sweeps[rows] + pi) % (2 * pi) - pi
        return cls(blocks, starts, ends, centres, sweeps, columns.is_line)

    @classmethod
    def of(cls, placed: Sequence[Placed]) -> Laid:
        """The columns of blocks in their places."""
        if isinstance(placed, Laid):
            return placed
        rows = [(*item.start, *item.end, *(item.centre or (0, 0)), item.sweep, item.is_line) for item in placed]
        columns = np.array(rows, float).reshape(-1, 8)
        starts, ends, centres = (columns[:, first : first + 2] for first in (0, 2, 4))
        return cls([item.block for item in placed], starts, ends, centres, columns[:, 6], columns[:, 7] > 0)

    def __len__(self) -> int:
        return len(self.blocks)

    @overload
    def __getitem__(self, index: int) -> Placed: ...
    @overload
    def __getitem__(self, index: slice) -> Laid: ...
    def __getitem__(self, index: int | slice) -> Placed | Laid:
        if isinstance(index, slice):
            return Laid(
                self.blocks[index],
                self.starts[index],
                self.ends[index],
                self.centres[index],
                self.sweeps[index],
                self.is_line[index],
            )
        index = range(len(self))[index]
        return next(iter(self[index : index + 1]))

    def __iter__(self) -> Iterator[Placed]:
        for first in range(0, len(self), AT_ONCE):
            part = slice(first, first + AT_ONCE)
            columns = (self.starts, self.ends, self.centres, self.sweeps, self.is_line)
            rows = zip(self.blocks[part], *(column[part].tolist() for column in columns), strict=True)
            for block, start, end, centre, sweep, is_line in rows:
                yield Placed(tuple(start), tuple(end), None if is_line else tuple(centre), sweep, block=block)

    @classmethod
    def joined(cls, parts: Sequence[Laid]) -> Laid:
        """The blocks of several, at least one, one after the other."""
        packed = [part.blocks for part in parts if isinstance(part.blocks, Blocks)]
        blocks: Sequence[Block] = (
            Blocks.joined(packed)
            if len(packed) == len(parts)
            else list(chain.from_iterable(part.blocks for part in parts))
        )
        columns = zip(
            *((part.starts, part.ends, part.centres, part.sweeps, part.is_line) for part in parts), strict=True
        )
        return cls(blocks, *map(np.concatenate, columns))

    def lengths(self) -> Floats:
        """Lengths of the lines and arcs, µm."""
        vectors = np.where(self.is_line[:, None], self.ends, self.centres) - self.starts
        return hypots(*vectors.T) * np.where(self.is_line, 1.0, abs(self.sweeps))

    def extents(self) -> tuple[XY, XY]:
        """The smallest and the largest x and y, bulges of arcs included; of at least one block."""
        arcs = np.flatnonzero(~self.is_line)
        centres, arms = self.centres[arcs], (self.starts - self.centres)[arcs]
        first, radii = directions(arms), hypots(*arms.T)
        last = first + self.sweeps[arcs]
        quarter, latest = np.ceil(np.minimum(first, last) / (pi / 2)), np.maximum(first, last) // (pi / 2)
        corners = [self.starts, self.ends]
        while (is_on := quarter <= latest).any():
            # (as `Piece.extremes`)
            corners.append((centres + radii[:, None] * _QUARTERS[quarter.astype(int) % 4])[is_on])
            quarter = quarter + 1
        low, high = (find([find(part, axis=0) for part in corners], axis=0).tolist() for find in (np.min, np.max))
        return tuple(low), tuple(high)


def place(tape: Tape, start: tuple[int, int] = (0, 0), positions: str = "auto") -> list[PlacedRoute]:
    """Lay a tape out from `start` (µm); `positions` is one of `skg.tape.positions.POSITIONS`."""
    is_machine = decide(tape, positions).positions == "machine"
    moves = machine_moves(tape) if is_machine else closed_moves(tape)
    places = np.concatenate([[start], moves]).cumsum(axis=0)
    laid = Laid.between(tape.blocks, columns_of(tape), places)
    bounds = zip(tape.bounds, tape.positioning(), strict=True)
    return [PlacedRoute(laid[first:last], is_move) for (first, last), is_move in bounds if first < last]


def _apart(first: XY, second: XY) -> float:
    """The larger coordinate of the way from one place to another."""
    return max(abs(first[0] - second[0]), abs(first[1] - second[1]))


def stop_places(tape: Tape, routes: list[PlacedRoute], home: XY) -> list[XY]:
    """Places of stops, µm, each once; `home` is the start of the tape."""
    stop_places, laid = [home], iter(routes)
    for first, last in tape.bounds[:-1]:
        stop_places.append(next(laid).blocks[-1].end if first < last else stop_places[-1])
    return list(dict.fromkeys(stop_places[1:]))
