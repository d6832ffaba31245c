"""The controller's way along one block: what the tools tell of all blocks of a tape at once, of each by itself."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from math import hypot, sqrt

from skg.tape.block import Block
from skg.tape.controller import CHUNK, State, library, stalled, trace_array


@dataclass(frozen=True)
class Outcome:
    """The controller's outcome of one block; lengths in µm.

    What each of them is stands at `skg.tape.moves.Walk`.
    """

    move: tuple[int, int]
    steps: int
    off_curve: float
    off_path: float


def _distance(block: Block, highest: int, lowest: int) -> float:
    """Turn extremes of F into the largest distance from the curve, µm."""
    radius = hypot(block.x, block.y)
    if block.is_line:
        return max(highest, -lowest) / radius
    square = block.x**2 + block.y**2
    return max(sqrt(square + highest) - radius, radius - sqrt(max(0, square + lowest)))


def run_block(block: Block, drift: tuple[int, int] = (0, 0)) -> Outcome:
    """Follow one block; `drift` is where the controller stands minus where the block should start, µm.

    A block whose J is never reached (possible on circles of a few µm) is a `UserError`.
    """
    state = State(
        sense=block.sense,
        quadrant=block.quadrant,
        x=block.x,
        y=block.y,
        j=block.j,
        axis=int(block.axis == "Y"),
        drift_x=drift[0],
        drift_y=drift[1],
    )
    while (result := library().skgsim_run(ctypes.byref(state), CHUNK, None, None)) == 1:
        pass
    if result == 2:
        raise stalled(block)
    start = block.start
    return Outcome(
        (state.px - start[0], state.py - start[1]),
        state.steps,
        _distance(block, state.f_max, state.f_min),
        _distance(block, state.d_max, state.d_min),
    )


def trace_block(block: Block) -> list[tuple[int, int]]:
    """Return the controller's position after each step, µm, relative to `block.start`'s origin."""
    places = trace_array(block)
    return list(zip(places[::2], places[1::2], strict=True))
