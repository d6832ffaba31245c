"""Pieces by place: boxes around stretches of pieces, which shapely's tree finds (numpy)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from skg.geometry.arrays import Floats, Whole, numbers_up_to

#: Stretches in a run, whose box stands in the tree.
_RUN = 16
#: So many places are asked for together, and so many pairs of a place and a piece returned.
_PLACES, _PAIRS = 1000, 50_000


class Boxes(NamedTuple):
    """Boxes around pieces, or around parts of them: smallest and largest x and y (n, 2); the pieces' numbers, which
    rise; the owner of each. No stretch has boxes of two owners."""

    low: Floats
    high: Floats
    piece: Whole
    owner: Whole


class Index:
    """The pieces whose boxes are given, some after the other. `stretch`: so many boxes are found or not as a whole."""

    def __init__(self, parts: Iterable[Boxes], stretch: int = 4) -> None:
        stretches = [_joined(boxes, stretch) for boxes in parts if len(boxes.piece)]
        self._low, self._high, self._begin, self._end, owner = _columns(stretches)
        low, high, self._first, self._last, _ = _joined(
            Boxes(self._low, self._high, np.arange(len(owner)), owner), _RUN
        )
        self._tree = shapely.STRtree(_diagonals(low, high))

    def within(self, low: Floats, high: Floats) -> Iterator[tuple[Whole, Whole]]:
        """Pairs of one of n boxes (its smallest and largest x and y: two arrays (n, 2)) and a piece that may come into
        it, some after the other: by the numbers of the boxes, then of the pieces. Each comes once."""
        for begin in range(0, len(low), _PLACES):
            some = slice(begin, begin + _PLACES)
            of, runs = self._tree.query(_diagonals(low[some], high[some]))
            of, runs = np.divmod(np.sort(of * len(self._first) + runs), len(self._first))
            of, stretches = _between(begin + of, self._first[runs], self._last[runs])
            comes_in = np.ones(len(of), bool)
            for axis in (0, 1):
                comes_in &= self._low[:, axis][stretches] <= high[:, axis][of]
                comes_in &= self._high[:, axis][stretches] >= low[:, axis][of]
            of, stretches = of[comes_in], stretches[comes_in]
            first, behind = self._begin[stretches], self._end[stretches]
            # (a long piece stands in several stretches)
            first[1:] = np.where(of[1:] == of[:-1], np.maximum(first[1:], behind[:-1]), first[1:])
            for part in batches(behind - first, _PAIRS):
                yield _between(of[part], first[part], behind[part])


def _diagonals(low: Floats, high: Floats) -> NDArray[np.object_]:
    """Lines across boxes, for shapely's tree: it looks at the boxes around what it holds, and a line takes less."""
    return shapely.linestrings(np.stack((low, high), axis=1))


def _joined(boxes: Boxes, count: int) -> tuple[Floats, Floats, Whole, Whole, Whole]:
    """The boxes around every so many boxes of one owner; of each the first piece, that behind the last, the owner."""
    begins = np.flatnonzero(np.diff(boxes.owner, prepend=boxes.owner[:1] - 1))
    many = np.diff(begins, append=len(boxes.owner))
    groups = -(-many // count)
    first = np.repeat(begins, groups) + count * numbers_up_to(groups)
    if not len(first):
        return boxes.low, boxes.high, boxes.piece, boxes.piece, boxes.owner
    last = np.append(first[1:], len(boxes.owner)) - 1
    return (
        np.minimum.reduceat(boxes.low, first),
        np.maximum.reduceat(boxes.high, first),
        boxes.piece[first],
        boxes.piece[last] + 1,
        boxes.owner[first],
    )


def _columns(parts: list[tuple[Floats, Floats, Whole, Whole, Whole]]) -> Iterator[NDArray]:
    """The columns of parts, which are given away: no more than one column is there twice."""
    none = np.empty(0, np.int64)
    columns = list(zip(*parts or [(np.empty((0, 2)), np.empty((0, 2)), none, none, none)], strict=True))
    parts.clear()
    while columns:
        yield np.concatenate(columns.pop(0))


def _between(of: Whole, begin: Whole, end: Whole) -> tuple[Whole, Whole]:
    """Numbers from some up to others, each with what it is `of`."""
    counts = end - begin
    return np.repeat(of, counts), np.repeat(begin, counts) + numbers_up_to(counts)


def batches(counts: Whole, most: int) -> Iterator[slice]:
    """Yield slices of items with these counts, so many that they sum up to `most` or less, but one at least."""
    total = np.concatenate(([0], np.cumsum(counts)))
    begin = 0
    while begin < len(counts):
        end = max(begin + 1, int(np.searchsorted(total, total[begin] + most, "right")) - 1)
        yield slice(begin, end)
        begin = end
