"""G-code programs as paths in the plane: read by `skg.tape.gcode_reader`; as routes, as a 3B tape, in words."""

from __future__ import annotations

from array import array
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from decimal import ROUND_HALF_UP, Decimal
from typing import TYPE_CHECKING

from skg.errors import UserError
from skg.messages.finding import Finding, Phrase
from skg.tape.block import Block, Stop, Tape, line_block
from skg.tape.block_list import Blocks
from skg.tape.gcode import Spot, millimetres, minus

if TYPE_CHECKING:
    from skg.tape.layout import Laid, PlacedRoute

#: The end of a 3B block's arc may lie so far off the circle through its start, µm: both are rounded, and so is the
#: centre.
OFF_BLOCK = 2


@dataclass(frozen=True)
class Drilled:
    """A hole: down and up again at a place, µm; its depth, if the program's heights are known."""

    place: Spot
    depth: Decimal | None = None


@dataclass(frozen=True)
class GcodeRun:
    """Blocks in the plane, one after the other: the first, and the one behind the last, from 0.

    `is_move`: they do not cut: rapids; any with the beam off or the tool up.
    """

    first: int
    last: int
    is_move: bool


class GcodePath:
    """A G-code path in the plane, in order: cuts, moves, holes, stops. Packed: it may have a million blocks."""

    def __init__(self) -> None:
        #: The blocks of cuts and moves; a cut's number counts the cuts.
        self.blocks = Blocks()
        #: Of each block whether it is a move.
        self.moves = bytearray()
        # x and y of each block's start, and of its end, µm; each mark behind so many blocks.
        self._places = array("q")
        self._marks: list[tuple[int, Drilled | Stop]] = []

    def lay(self, block: Block, number: int, start: Spot, end: Spot, is_move: bool) -> None:
        """Add a block behind all others."""
        self.blocks.add(block.x, block.y, block.j, block.axis, block.code, number)
        self._places.extend((*start, *end))
        self.moves.append(is_move)

    def mark(self, mark: Drilled | Stop) -> None:
        """Add a hole or a stop."""
        self._marks.append((len(self.moves), mark))

    @property
    def marks(self) -> list[Drilled | Stop]:
        """Holes and stops."""
        return [mark for _, mark in self._marks]

    def end(self, block: int) -> Spot:
        """End of a block."""
        x, y = self._places[4 * block + 2 : 4 * block + 4]
        return x, y

    def parts(self) -> Iterator[GcodeRun | Drilled | Stop]:
        """Cuts and moves in runs, as long as they can be, holes and stops."""
        first = 0
        for last, mark in [*self._marks, (len(self.moves), None)]:
            while first < last:
                is_move = self.moves[first]
                change = self.moves.find(1 - is_move, first, last)
                yield GcodeRun(first, last if change < 0 else change, bool(is_move))
                first = last if change < 0 else change
            if mark:
                yield mark

    def laid(self) -> Laid:
        """All blocks in their places."""
        # (these load numpy)
        import numpy as np

        from skg.tape.columns import Columns
        from skg.tape.layout import Laid

        places = np.array(self._places, np.int64).reshape(-1, 4)
        return Laid.apart(self.blocks, Columns.of(self.blocks), places[:, :2], places[:, 2:])


@dataclass(frozen=True)
class GcodeProgram:
    """A G-code program in the plane; `home` (µm) is its start.

    `depths` and `travels`: the heights (µm) at which it cuts and at which it is moved, each once, in the order in which
    they come; empty where no height is known. `guesses`: how it is read where it does not say. `notes`: what of G1 to
    G3 is no cut, and why.
    """

    name: str
    path: GcodePath
    home: Spot = (0, 0)
    depths: tuple[Decimal, ...] = ()
    travels: tuple[Decimal, ...] = ()
    guesses: tuple[Finding, ...] = ()
    notes: tuple[Finding, ...] = ()

    @property
    def holes(self) -> list[Spot]:
        """Drilled places, each once."""
        return list(dict.fromkeys(hole.place for hole in self._drilled))

    @property
    def stop_places(self) -> list[Spot]:
        """Places of stops, each once."""
        spot, stop_places = self.home, []
        for part in self.path.parts():
            if isinstance(part, Stop):
                stop_places.append(spot)
            else:
                spot = part.place if isinstance(part, Drilled) else self.path.end(part.last - 1)
        return list(dict.fromkeys(stop_places))

    @property
    def _drilled(self) -> list[Drilled]:
        return [mark for mark in self.path.marks if isinstance(mark, Drilled)]

    def routes(self) -> list[PlacedRoute]:
        """The routes, cuts and moves, as of `skg.tape.layout.place`."""
        from skg.tape.layout import PlacedRoute

        laid, parts = self.path.laid(), self.path.parts()
        return [PlacedRoute(laid[part.first : part.last], part.is_move) for part in parts if isinstance(part, GcodeRun)]

    def heights(self) -> tuple[Phrase, ...]:
        """The heights of cuts, holes and moves, as far as they are known."""
        holes = self._drilled
        deep = list(dict.fromkeys(hole.depth for hole in holes if hole.depth is not None))
        phrases = [
            Phrase("cuts-at", heights=several(self.depths)) if self.depths else None,
            Phrase("holes-down-to", holes=Phrase("count-drilled", count=len(holes)), heights=several(deep))
            if deep
            else None,
            Phrase("travels-at", heights=several(self.travels)) if self.travels else None,
        ]
        return tuple(filter(None, phrases))

    def left_out(self) -> tuple[Finding, ...]:
        """The note on what a 3B tape of the same path leaves out, if it does."""
        holes = len(self._drilled)
        drilled = Phrase("count-drilled", count=holes) if holes else None
        deep = Phrase("heights-of-cuts", heights=several(self.depths)) if self.depths else None
        what = Phrase("holes-and-heights", first=drilled, other=deep) if drilled and deep else drilled or deep
        return (Finding("not-in-3b", what=what),) if what else ()

    def tape(self) -> Tape:
        """The 3B tape of the same path: a move goes straight, between two stops; holes have no blocks.

        An arc whose end is farther off its circle than a block can be is a `UserError`.
        """
        self._look_at_ends()
        blocks = Blocks()
        stops: list[Stop] = []
        spot, moved_from = self.home, None
        for part in self.path.parts():
            if isinstance(part, Drilled):
                continue
            if isinstance(part, GcodeRun) and part.is_move:
                if moved_from is None:
                    moved_from = spot
                    if not stops or stops[-1].after < len(blocks):
                        stops.append(Stop(len(blocks)))
                spot = self.path.end(part.last - 1)
                continue
            if moved_from is not None:
                blocks.extend(_between(moved_from, spot))
                if isinstance(part, GcodeRun):
                    stops.append(Stop(len(blocks)))
                moved_from = None
            if isinstance(part, GcodeRun):
                blocks.extend(self.path.blocks[part.first : part.last])
                spot = self.path.end(part.last - 1)
            else:
                stops.append(Stop(len(blocks)))
        if moved_from is not None:
            blocks.extend(_between(moved_from, spot))
        start = self.home[0] / 1000, self.home[1] / 1000
        return Tape(self.name, blocks.numbered(), tuple(stops), drift=True, start=start)

    def _look_at_ends(self) -> None:
        """Refuse the first arc that is cut and whose end is too far off its circle."""
        import numpy as np

        from skg.geometry.arrays import hypots

        laid = self.path.laid()
        off = abs(hypots(*(laid.ends - laid.centres).T) - hypots(*(laid.starts - laid.centres).T))
        for index in np.flatnonzero(~laid.is_line & (off > OFF_BLOCK) & (np.array(self.path.moves) == 0)).tolist():
            number = self.path.blocks[index].number
            raise UserError(Finding("arc-off-circle", number=number, off=float(off[index])).within(self.name))


def several(heights: Sequence[Decimal]) -> Phrase | tuple[str, ...]:
    """Some heights, or the first and the last of many."""
    words = tuple(f"Z{millimetres(rounded_one(height))}" for height in heights)
    if len(words) <= 3:
        return words
    return Phrase("many-heights", first=words[0], last=words[-1], number=len(words))


def _between(start: Spot, end: Spot) -> Blocks:
    return Blocks.of([] if start == end else [line_block(*minus(end, start))])


def rounded_one(value: Decimal) -> int:
    """Whole µm, halves away from zero."""
    return int(value.to_integral_value(ROUND_HALF_UP))
