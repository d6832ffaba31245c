"""A drive's steps for a tape: docs/spec/drive.md."""

from __future__ import annotations

from collections.abc import Iterator

from skg.tape.block import Stop, Tape
from skg.tape.controller import port_steps

_CUTTING = 0x80
_CUT = bytes(value | _CUTTING for value in range(256))


def drive_steps(tape: Tape) -> Iterator[bytes]:
    """The port's value at each step of a tape, a byte each, in pieces.

    Bit 7 is on from the start, and each stop turns it over. A block whose J is never reached is a `UserError`.
    """
    cuts = True
    for item in tape.items:
        if isinstance(item, Stop):
            cuts = not cuts
        else:
            for piece in port_steps(item):
                yield piece.translate(_CUT) if cuts else piece


def stops_in_pairs(tape: Tape) -> bool:
    """Tell whether what lies between the 1st stop and the 2nd, the 3rd and the 4th, … is positioning, and nothing else
    is.

    Bit 7 is then on where the tape cuts, and nowhere else. A single stop at the tape's end is none.
    """
    stretches, moves = tape.stretches(), tape.positioning()
    return all(is_move == (index % 2 == 1) for index, is_move in enumerate(moves) if stretches[index])
