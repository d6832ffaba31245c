"""The blocks of a tape as columns: what `Block` says of one, of all at once.

A tape may have a million blocks. The arithmetic is that of `skg.tape.block`, in whole numbers of any size: a tape gives
the same places block by block and by columns.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import cached_property
from math import isqrt, pi
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from skg.geometry.arrays import Flags, Floats, Whole, directions, hypots
from skg.tape.block import CODES, Block, Tape
from skg.tape.block_list import Blocks

_Found = TypeVar("_Found")
#: Squares of larger numbers are not sure to fit in 64 bits: they are reckoned with Python's own.
_FITS = 10**9
#: So many rows are looked at together.
_SHARE = 50_000
_SIGNS_X, _SIGNS_Y = np.array([0, 1, -1, -1, 1]), np.array([0, 1, 1, -1, -1])
#: Senses and quadrants of `CODES`.
_SENSES, _QUADRANTS = np.array(
    [(block.sense, block.quadrant) for block in (Block(0, 0, 0, "X", code) for code in CODES)], np.int8
).T


#: The columns that tell a block's way; the others follow from these.
FIELDS = ("sense", "quadrant", "x", "y", "j", "counts_y")


def _roots(squares: Whole) -> Whole:
    """Square roots of whole numbers, rounded down."""
    if squares.dtype == object:
        return np.array([isqrt(square) for square in squares.flat], object).reshape(squares.shape)
    roots = np.sqrt(squares.astype(float)).astype(np.int64)
    roots -= roots * roots > squares
    return roots + ((roots + 1) ** 2 <= squares)


def round_roots(squares: Whole) -> Whole:
    """Square roots of whole numbers, rounded to the nearest whole number."""
    return (_roots(4 * squares) + 1) // 2


class Columns:
    """Blocks, a row for each; lengths in µm. What is worked out is kept, and cut with the rows.

    `x`, `y`, `j` as they stand on the tape; `counts_y`: the count direction is Y; `sense` and `quadrant` as of `Block`.
    """

    def __init__(self, x: Whole, y: Whole, j: Whole, counts_y: Flags, sense: Whole, quadrant: Whole) -> None:
        self.x, self.y, self.j, self.counts_y, self.sense, self.quadrant = x, y, j, counts_y, sense, quadrant

    @classmethod
    def of(cls, blocks: Iterable[Block]) -> Columns:
        """The columns of blocks."""
        if isinstance(blocks, Blocks):
            columns = (np.frombuffer(column, column.typecode)[blocks.cut] for column in blocks.columns)
            *lengths, axes, codes, _ = columns
        else:
            blocks = list(blocks)
            each = [(block.x, block.y, block.j, block.axis == "Y", CODES.index(block.code)) for block in blocks]
            *lengths, axes, codes = np.array(each, object).reshape(-1, 5).T
        kind = np.int64 if all(length.max(initial=0) < _FITS for length in lengths) else object
        x, y, j = (length.astype(kind, copy=False) for length in lengths)
        codes = codes.astype(np.uint8, copy=False)
        return cls(x, y, j, axes.astype(bool), _SENSES[codes], _QUADRANTS[codes])

    def __len__(self) -> int:
        return len(self.x)

    def __getitem__(self, rows: slice | Flags | Whole) -> Columns:
        """Some of the rows, with what has been worked out of them."""
        result = Columns.__new__(Columns)
        result.__dict__.update({name: column[rows] for name, column in self.__dict__.items()})
        return result

    def shares(self) -> Iterator[tuple[slice, Columns]]:
        """Some rows after the other: what is worked out of all of them would take more memory than these."""
        for first in range(0, len(self), _SHARE):
            rows = slice(first, first + _SHARE)
            yield rows, self[rows]

    def alike(self) -> tuple[Whole, Whole]:
        """Rows of which no two have the same fields, in their order, and for each row which of these it is like."""
        fields = [getattr(self, name).astype(np.int64, copy=False) for name in FIELDS]
        order = np.lexsort(fields)
        is_new = np.ones(len(order), bool)
        is_new[1:] = np.any([field[order[1:]] != field[order[:-1]] for field in fields], axis=0)
        # (of equal ones the first row comes first)
        first = order[is_new]
        places = np.empty(len(first), np.int64)
        places[np.argsort(first)] = np.arange(len(first))
        like = np.empty(len(order), np.int64)
        like[order] = places[np.cumsum(is_new) - 1]
        return np.sort(first), like

    @cached_property
    def is_line(self) -> Flags:
        """As `Block.is_line`."""
        return self.sense == 0

    @cached_property
    def squares(self) -> Whole:
        """x² + y²."""
        return self.x * self.x + self.y * self.y

    @cached_property
    def radii(self) -> Whole:
        """As `Block.radius`."""
        return round_roots(self.squares)

    @cached_property
    def turns(self) -> Whole:
        """As `Block.turn`."""
        return np.where(self.squares > 1, _roots(np.maximum(self.squares - 2, 0)) + 1, 0)

    @cached_property
    def is_full_circle(self) -> Flags:
        """As `Block.is_full_circle`."""
        radii = self.j // 4
        is_count = (radii == self.radii) | (radii == self.turns)
        near = abs(radii * radii - self.squares) <= 2 * radii + 1
        return np.array(~self.is_line & (self.j % 4 == 0) & near & is_count, bool)

    @cached_property
    def is_arc(self) -> Flags:
        """As `Block.is_arc`."""
        return ~self.is_line & ~self.is_full_circle

    @cached_property
    def across(self) -> Whole:
        """As `Block.across`."""
        return np.where(self.counts_y, 0, 1)

    @cached_property
    def starts(self) -> Whole:
        """As `Block.start` (n × 2)."""
        quadrants = np.where(self.is_line, 0, self.quadrant)
        return np.column_stack([_SIGNS_X[quadrants] * self.x, _SIGNS_Y[quadrants] * self.y])

    @cached_property
    def _counted(self) -> Whole:
        """As `Block.count_end` of arcs (n × 2); the start of all others."""
        along = np.where(self.counts_y, self.y, self.x)
        result = np.column_stack([along, self.quadrant])
        rows = np.flatnonzero(self.is_arc)
        along, left, quadrants, radii = along[rows], self.j[rows], self.quadrant[rows], self.radii[rows]
        while len(rows):
            sense, counts_y = self.sense[rows], self.counts_y[rows]
            shrinks = ((quadrants % 2 == 1) == (sense > 0)) != counts_y
            room = np.where(shrinks, along, radii - along)
            on = left > room
            ends = np.where(shrinks, along - left, along + left)
            result[rows[~on]] = np.column_stack([ends, quadrants])[~on]
            left, along = (left - room)[on], np.where(shrinks, 0, radii)[on]
            quadrants, radii, rows = ((quadrants - 1 + sense) % 4 + 1)[on], radii[on], rows[on]
        return result

    @cached_property
    def is_plainly_sound(self) -> Flags:
        """Tell whether `Block.problems` finds nothing on a tape with drift. Arcs that are sound on one without drift
        alone are left out."""
        is_odd, longer = self.quadrant % 2 == 1, np.maximum(self.x, self.y)
        counts_y = np.where(self.x == self.y, is_odd, self.y > self.x)
        is_line = (
            self.is_line & (np.where(is_odd, self.x, self.y) > 0) & (self.j == longer) & (self.counts_y == counts_y)
        )
        shrinks = np.where(is_odd == (self.sense > 0), self.x, self.y)
        is_circle = self.is_full_circle & (shrinks > 0) & (self.j == 4 * self.radii)
        is_arc = self.is_arc & (shrinks > 0) & (self.j > 0) & (self.j <= 4 * self.radii)
        rows = np.flatnonzero(is_arc)
        arcs = self[rows]
        along = arcs._counted[:, 0]
        is_arc[rows] = along <= round_roots(np.maximum(0, arcs.squares - along * along)) + 3
        return np.array(is_line | is_arc | is_circle, bool)

    @cached_property
    def ends(self) -> Whole:
        """As `Block.end` (n × 2)."""
        along, quadrants = self._counted.T
        beside = round_roots(np.maximum(0, self.squares - along * along))
        least = along + self.counts_y
        beside = np.where((least - 2 <= beside) & (beside < least), least, beside)
        is_arc = self.is_arc
        x = np.where(is_arc, np.where(self.counts_y, beside, along), self.x)
        y = np.where(is_arc, np.where(self.counts_y, along, beside), self.y)
        return np.column_stack([_SIGNS_X[quadrants.astype(int)] * x, _SIGNS_Y[quadrants.astype(int)] * y])

    @cached_property
    def moves(self) -> Whole:
        """As `Block.move` (n × 2)."""
        return self.ends - self.starts

    @cached_property
    def sweeps(self) -> Floats:
        """As `Block.sweep`."""
        sweeps: Floats = 2 * pi * self.sense.astype(float)
        rows = np.flatnonzero(self.is_arc)
        arcs = self[rows]
        turn = arcs.sense * (directions(arcs.ends) - directions(arcs.starts)) % (2 * pi)
        is_first = (arcs._counted[:, 1] - arcs.quadrant) * arcs.sense % 4 == 0
        turn = np.where(is_first & (turn > 3 * pi / 2) & (arcs.j < 2 * arcs.radii), 0.0, turn)
        turn = np.where(is_first & (turn < pi / 2) & (arcs.j > 2 * arcs.radii), turn + 2 * pi, turn)
        sweeps[rows] = arcs.sense * turn
        return sweeps

    @cached_property
    def lengths(self) -> Floats:
        """As `Block.length`."""
        return hypots(self.x, self.y) * np.where(self.is_line, 1.0, abs(self.sweeps))

    def on_circles(self, places: NDArray) -> Floats:
        """Places about the arcs' centres, one for each (n × 2), moved across the count axis onto the circles.

        Each stays on its own side of the centre.
        """
        rows, across = np.arange(len(self)), self.across
        along, beside = places[rows, 1 - across], places[rows, across]
        moved = np.sqrt(np.maximum(0, self.squares - along * along).astype(float)) * np.where(beside >= 0, 1, -1)
        on_circles = np.empty((len(self), 2))
        on_circles[rows, across], on_circles[rows, 1 - across] = moved, along
        return on_circles


def columns_of(tape: Tape) -> Columns:
    """All blocks of a tape."""
    return kept(tape, "columns", lambda: Columns.of(tape.blocks))


def kept(tape: Tape, name: str, find: Callable[[], _Found]) -> _Found:
    """Return a value computed from a tape's blocks, and cache it with the tape."""
    if name not in tape.kept:
        tape.kept[name] = find()
    return tape.kept[name]
