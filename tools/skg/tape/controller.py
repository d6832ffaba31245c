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
from collections.abc import Iterator
from functools import cache

from skg.errors import UserError
from skg.messages.finding import Finding
from skg.native import load
from skg.tape.block import Block, Stop, Tape

#: Steps that are taken at once.
CHUNK = 20_000_000
#: Steps in one piece of `drive_steps`.
_PIECE = 1_000_000
_STALLED = 2
#: Bit 7 of a drive's port is on while the wire cuts.
_CUT = bytes(value | 0x80 for value in range(256))


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


def _state(block: Block) -> State:
    return State(sense=block.sense, quadrant=block.quadrant, x=block.x, y=block.y, j=block.j,
                  axis=int(block.axis == "Y"))  # fmt: skip


def stalled(block: Block) -> UserError:
    return UserError(Finding("never-ends", number=block.number, block=str(block), j=block.j))


def trace_array(block: Block) -> ctypes.Array:
    """Return the controller's places as one array x, y, x, y, … of 64-bit numbers.

    A place for each step, µm, relative to `block.start`'s origin. A block whose J is never reached (possible on circles
    of a few µm) is a `UserError`.
    """
    run, state = library().skgsim_run, _state(block)
    while (result := run(ctypes.byref(state), CHUNK, None, None)) == 1:
        pass
    if result == _STALLED:
        raise stalled(block)
    buffer = (ctypes.c_int64 * (2 * state.steps))()
    run(ctypes.byref(_state(block)), state.steps, buffer, None)
    return buffer


def _port_steps(block: Block) -> Iterator[bytes]:
    """The steps of one block as a drive's port shows them (docs/spec/drive.md), a byte each, bit 7 off; in pieces."""
    state, result = _state(block), 1
    # (few blocks take more than two steps for each that counts)
    size = min(2 * block.j + 16, _PIECE)
    buffer = ctypes.create_string_buffer(size)
    while result == 1:
        before = state.steps
        result = library().skgsim_run(ctypes.byref(state), size, None, buffer)
        yield ctypes.string_at(buffer, state.steps - before)
    if result == _STALLED:
        raise stalled(block)


def drive_steps(tape: Tape) -> Iterator[bytes]:
    """The port's value at each step of a tape, a byte each, in pieces.

    Bit 7 is on from the start, and each stop turns it over. A block whose J is never reached is a `UserError`.
    """
    cuts = True
    for item in tape.items:
        if isinstance(item, Stop):
            cuts = not cuts
        else:
            for piece in _port_steps(item):
                yield piece.translate(_CUT) if cuts else piece
