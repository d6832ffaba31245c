"""The blocks of a tape in little room: a tape may have a million of them."""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Iterator, Sequence
from typing import overload

from skg.tape.block import CODES, Block

_AXES = "XY"
_AXIS_NUMBERS = {axis: number for number, axis in enumerate(_AXES)}
_CODE_NUMBERS = {code: number for number, code in enumerate(CODES)}


class Blocks(Sequence[Block]):
    """Blocks in the order of the tape, packed: each becomes a `Block` when it is asked for.

    `columns` are those of x, y, J (µm, 64 bits), the count direction (1: Y), the place of the code among `CODES`, and
    the block's number; a part of the blocks has the same columns as all, and other `rows`.
    """

    def __init__(self) -> None:
        self.columns = tuple(array(kind) for kind in "qqqBBi")
        self._part: range | None = None

    @classmethod
    def of(cls, blocks: Iterable[Block]) -> Blocks:
        """Pack blocks."""
        result = cls()
        for block in blocks:
            result.add(block.x, block.y, block.j, block.axis, block.code, block.number)
        return result

    def add(self, x: int, y: int, j: int, axis: str, code: str, number: int) -> None:
        """Add a block behind all others, as `Block` has it; a number of more than 64 bits is an `OverflowError`."""
        xs, ys, js, axes, codes, numbers = self.columns
        xs.append(x)
        ys.append(y)
        js.append(j)
        axes.append(_AXIS_NUMBERS[axis])
        codes.append(_CODE_NUMBERS[code])
        numbers.append(number)

    @classmethod
    def joined(cls, parts: Iterable[Blocks]) -> Blocks:
        """The blocks of several, one after the other."""
        result = cls()
        for part in parts:
            result.extend(part)
        return result

    def extend(self, more: Blocks) -> None:
        """Add other blocks behind all of these."""
        for column, theirs in zip(self.columns, more.columns, strict=True):
            column.extend(theirs[more.cut])

    def numbered(self) -> Blocks:
        """The same blocks, with the numbers that they have on a tape."""
        result = Blocks.joined([self])
        result.columns[-1][:] = array(result.columns[-1].typecode, range(1, len(result) + 1))
        return result

    @property
    def rows(self) -> range:
        """Rows of the columns that these blocks are."""
        return range(len(self.columns[0])) if self._part is None else self._part

    @property
    def cut(self) -> slice:
        """The same, to cut a column with."""
        rows = self.rows
        # (a range that runs down to row 0 stops at -1, which a slice would take for the last row)
        return slice(rows.start, rows.stop if rows.stop >= 0 else None, rows.step) if rows else slice(0)

    def __len__(self) -> int:
        return len(self.rows)

    @overload
    def __getitem__(self, index: int) -> Block: ...
    @overload
    def __getitem__(self, index: slice) -> Blocks: ...
    def __getitem__(self, index: int | slice) -> Block | Blocks:
        if isinstance(index, slice):
            part = Blocks.__new__(Blocks)
            part.columns = self.columns
            part._part = self.rows[index]
            return part
        row = self.rows[index]
        return _block(*(column[row] for column in self.columns))

    def __iter__(self) -> Iterator[Block]:
        return map(_block, *(memoryview(column)[self.cut] for column in self.columns))


def _block(x: int, y: int, j: int, axis: int, code: int, number: int) -> Block:
    return Block(x, y, j, _AXES[axis], CODES[code], number)
