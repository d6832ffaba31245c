"""Where the blocks of a route should end."""

from __future__ import annotations

from skg.tape.block import Block


def closed_moves(blocks: list[Block]) -> list[tuple[int, int]]:
    """Return the moves of the blocks of one route, so that a route that is meant to close does close.

    A block tells an arc's end exactly along the count axis, but across it only as well as its start gives the
    radius: the tape's own rounded end may be a µm away from `Block.end`. Where those µm leave a gap that they
    can explain, the arcs whose end was the closest call give a µm each until the gap is gone.
    """
    moves = [block.move for block in blocks]
    for axis in (0, 1):
        gap = sum(move[axis] for move in moves)
        # How far the unrounded end lies from the rounded one, for the arcs that can give on this axis.
        doubts = {at: _doubt(block) for at, block in enumerate(blocks) if block.is_arc and block.across == axis}
        if abs(gap) > len(doubts):
            continue
        way = -1 if gap > 0 else 1
        ranked = sorted(doubts, key=lambda at: -way * doubts[at])
        for at in [at for at in ranked if _may_give(blocks[at], axis, way)][: abs(gap)]:
            move = list(moves[at])
            move[axis] += way
            moves[at] = tuple(move)
    return moves


def _doubt(block: Block) -> float:
    """An arc's unrounded end minus its rounded one, across the count axis, µm."""
    return block.on_circle(block.end)[block.across] - block.end[block.across]


def _may_give(block: Block, axis: int, way: int) -> bool:
    """Whether the count direction is still right when an arc's end moves by a µm across it."""
    other = abs(block.end[axis] + way)
    along = abs(block.end[1 - axis])
    return along <= other if block.axis == "X" else along < other
