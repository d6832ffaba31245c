"""A tape laid out on the drawing: absolute lines and arcs, in micrometres."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from math import atan2, pi

from skg.piece import Piece
from skg.plane import XY, minus
from skg.tape.block import Block, Tape

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

    blocks: Sequence[Placed]
    is_move: bool

    @property
    def start(self) -> XY:
        """Where the route begins, µm."""
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
            if not placed.is_line:
                arcs += 1
                continue
            ex, ey = placed.block.move
            # Each arc between them may have ended beside its place; two lines alone enclose nothing.
            if (
                at > first + 1
                and max(abs(dx + ex), abs(dy + ey)) <= 1
                and _apart(placed.start, lead.end) <= 2 * (arcs + 1)
            ):
                return at
        return None


def _apart(one: XY, other: XY) -> float:
    """The larger coordinate of the way from one place to another."""
    return max(abs(one[0] - other[0]), abs(one[1] - other[1]))


def stop_places(tape: Tape, routes: list[PlacedRoute], home: XY) -> list[XY]:
    """Where the controller stops, µm, each place once; `home` is where the tape begins."""
    found, laid = [home], iter(routes)
    for first, last in tape.bounds[:-1]:
        found.append(next(laid).blocks[-1].end if first < last else found[-1])
    return list(dict.fromkeys(found[1:]))
