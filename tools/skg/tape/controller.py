"""The 3B controller: point-by-point comparison, stepped in C.

Why C and not numba: the loop is thirty lines of integer additions, the project has a C compiler at hand
anyway (the emulator needs one), and a shared library loads in a millisecond where numba brings LLVM, 150 MB,
and a second of compiling at every start.

How the controller moves (`docs/tools.md` has the same in pictures):

- A line starts with F = 0. F ≥ 0 (on the line or left of it) steps +X in L1, +Y in L2, −X in L3, −Y in L4,
  and F < 0 steps the axis that comes next counter-clockwise: +Y, −X, −Y, +X.
- An arc starts with F = 0; F = x² + y² − xs² − ys² about its centre. F ≥ 0 steps towards the inside, F < 0
  onwards and outwards. It goes over to the next quadrant when the coordinate that shrinks has reached 0.
- The block ends with the step that brings the count of steps on the count axis to J.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from math import hypot, sqrt

from skg.errors import UserError
from skg.native import load
from skg.tape.block import Block

#: Steps between two reports of progress.
CHUNK = 20_000_000
#: Steps in one piece of `port_steps`.
_PIECE = 1_000_000
_STALLED = 2


class State(ctypes.Structure):
    """`skgsim_block` of native/skgsim.h, member for member."""

    _fields_ = [(name, ctypes.c_int64) for name in (
        "sense", "quadrant", "x", "y", "j", "axis", "drift_x", "drift_y", "started", "px", "py", "f",
        "counted", "steps", "f_max", "f_min", "d_max", "d_min")]  # fmt: skip


@cache
def library() -> ctypes.CDLL:
    """The library, its functions declared."""
    result = load("skgsim")
    result.skgsim_run.argtypes = [ctypes.POINTER(State), ctypes.c_int64,
                                    ctypes.POINTER(ctypes.c_int64), ctypes.c_char_p]  # fmt: skip
    result.skgsim_run.restype = ctypes.c_int
    result.skgsim_walk.argtypes = [ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p]
    result.skgsim_walk.restype = ctypes.c_int64
    return result


@dataclass(frozen=True)
class Outcome:
    """The controller's outcome of one block; lengths in µm.

    `move` is where it went (dx, dy), `steps` in how many steps; `off_curve` the largest distance from the
    line or arc as it starts where the controller stands, `off_path` from where that line or arc should lie.
    Both are distances from the whole line and the whole circle: `Block.move` − `move` tells the end's miss.
    """

    move: tuple[int, int]
    steps: int
    off_curve: float
    off_path: float


def _state(block: Block, drift: tuple[int, int]) -> State:
    return State(sense=block.sense, quadrant=block.quadrant, x=block.x, y=block.y, j=block.j,
                  axis=int(block.axis == "Y"), drift_x=drift[0], drift_y=drift[1])  # fmt: skip


def stalled(block: Block) -> UserError:
    return UserError(f"block {block.number}: {block} never ends, the controller does not reach J = {block.j}")


def _distance(block: Block, highest: int, lowest: int) -> float:
    """Turn extremes of F into the largest distance from the curve, µm."""
    radius = hypot(block.x, block.y)
    if block.is_line:
        return max(highest, -lowest) / radius
    square = block.x**2 + block.y**2
    return max(sqrt(square + highest) - radius, radius - sqrt(max(0, square + lowest)))


def run_block(
    block: Block, drift: tuple[int, int] = (0, 0), progress: Callable[[int], object] = lambda steps: None
) -> Outcome:
    """Follow one block; `drift` is where the controller stands minus where the block should start, µm.

    `progress` is called with the number of steps taken since its last call. A block whose J is never reached
    (possible on circles of a few µm) is a `UserError`.
    """
    run, state, before = library().skgsim_run, _state(block, drift), 0
    while (result := run(ctypes.byref(state), CHUNK, None, None)) == 1:
        progress(state.steps - before)
        before = state.steps
    if result == _STALLED:
        raise stalled(block)
    progress(state.steps - before)
    start = block.start
    return Outcome(
        (state.px - start[0], state.py - start[1]),
        state.steps,
        _distance(block, state.f_max, state.f_min),
        _distance(block, state.d_max, state.d_min),
    )


def trace_array(block: Block) -> ctypes.Array:
    """Return the controller's places as one array x, y, x, y, … of 64-bit numbers.

    A place for each step, µm, relative to `block.start`'s origin.
    """
    count = run_block(block).steps
    buffer = (ctypes.c_int64 * (2 * count))()
    library().skgsim_run(ctypes.byref(_state(block, (0, 0))), count, buffer, None)
    return buffer


def trace_block(block: Block) -> list[tuple[int, int]]:
    """Return the controller's position after each step, µm, relative to `block.start`'s origin."""
    places = trace_array(block)
    return list(zip(places[::2], places[1::2], strict=True))


def port_steps(block: Block) -> Iterator[bytes]:
    """The steps of one block as a drive's port shows them (docs/spec/drive.md), a byte each, bit 7 off; in pieces.

    A block whose J is never reached is a `UserError`.
    """
    state, result = _state(block, (0, 0)), 1
    # (few blocks take more than two steps for each that counts)
    size = min(2 * block.j + 16, _PIECE)
    buffer = ctypes.create_string_buffer(size)
    while result == 1:
        before = state.steps
        result = library().skgsim_run(ctypes.byref(state), size, None, buffer)
        yield ctypes.string_at(buffer, state.steps - before)
    if result == _STALLED:
        raise stalled(block)
