"""A tape as the steps of two motors: what the drive's port is told at each of them (docs/spec/drive.md).

Where the controller steps, `skg.tape.controller` tells. This module adds what a motor's driver must know besides: the
directions of both axes, which are those of the quadrant that the block moves in, and whether the wire cuts.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from skg.tape.block import Block, Stop, Tape
from skg.tape.controller import trace_array

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

STEP_X, MINUS_X, STEP_Y, MINUS_Y, CUTS = 0x01, 0x02, 0x04, 0x08, 0x80

#: The axes that run backwards, by the quadrant into which one moves along a line.
_BACKWARDS = {1: 0, 2: MINUS_X, 3: MINUS_X | MINUS_Y, 4: MINUS_Y}


def _directions(block: Block) -> int:
    """The directions with which a block begins: an arc moves along its tangent, which is a quarter turn ahead."""
    return _BACKWARDS[(block.quadrant - 1 + block.sense) % 4 + 1]


def block_steps(block: Block, cuts: bool = True) -> NDArray[np.uint8]:
    """The port's value at each step of a block: shape (steps,).

    An arc goes over to the next quadrant where a coordinate has reached 0; from there on the other axis runs the other
    way.
    """
    import numpy as np  # (slow to import, and needed here alone)

    places = np.frombuffer(trace_array(block), np.int64).reshape(-1, 2)
    along_x = np.diff(places[:, 0], prepend=block.start[0]) != 0
    ports = np.where(along_x, STEP_X, STEP_Y).astype(np.uint8)
    ports |= _directions(block) | (CUTS if cuts else 0)
    if not block.is_line:
        x_is_0 = np.cumsum(along_x & (places[:, 0] == 0))[:-1] % 2
        y_is_0 = np.cumsum(~along_x & (places[:, 1] == 0))[:-1] % 2
        ports[1:] ^= (MINUS_Y * x_is_0 + MINUS_X * y_is_0).astype(np.uint8)
    return ports


def tape_steps(tape: Tape) -> Iterator[bytes]:
    """The port's values at each step of a tape, block by block: cutting from its beginning, every stop turns that over."""
    cuts = True
    for item in tape.items:
        if isinstance(item, Stop):
            cuts = not cuts
        else:
            yield block_steps(item, cuts).tobytes()
