"""Start positions of a tape's blocks: as its name or an option says, else as on a tape with drift."""

from __future__ import annotations

from dataclasses import dataclass

from skg.errors import UserError
from skg.messages.finding import Finding
from skg.tape.block import Tape

#: Starts of blocks: the programmed end of the block before (programmed), or the controller's real position then
#: (machine: tapes without drift); auto: as the tape says, else programmed.
POSITIONS = ("auto", "programmed", "machine")
#: The end of the name of a tape without drift.
WITHOUT_DRIFT = ".nodrift.3b"


@dataclass(frozen=True)
class Decision:
    """Start positions of a tape's blocks, "programmed" or "machine", and why (None: the option said it, or both are
    the same to the micrometre)."""

    positions: str
    why: Finding | None = None


def decide(tape: Tape, positions: str = "auto") -> Decision:
    """Tell where the blocks of a tape start; `positions` is one of `POSITIONS`, as asked for."""
    if positions != "auto":
        return Decision(positions)
    if tape.drift is not None:
        told = Finding("with-drift" if tape.drift else "without-drift", by=tape.drift_by)
        return Decision("programmed" if tape.drift else "machine", told if tape.drift_by else None)
    return Decision("programmed", Finding("taken-with-drift", ending=WITHOUT_DRIFT) if depends(tape) else None)


def depends(tape: Tape) -> bool:
    """Tell whether blocks end elsewhere with drift than without."""
    if all(block.is_line for block in tape.blocks):
        return False
    # (this loads numpy)
    from skg.tape.moves import closed_moves, machine_moves

    try:
        return bool((machine_moves(tape) != closed_moves(tape)).any())
    except UserError:
        # A block that never ends on the controller (a circle of a few µm).
        return True
