"""Start positions of a tape's blocks: as its name or an option says, else as on a tape with drift."""

from __future__ import annotations

from dataclasses import dataclass

from skg.errors import UserError
from skg.tape.block import Tape

#: Starts of blocks: the programmed end of the block before (programmed), or the controller's real position then
#: (machine: tapes without drift); auto: as the tape says, else programmed.
POSITIONS = ("auto", "programmed", "machine")
#: The end of the name of a tape without drift.
WITHOUT_DRIFT = ".nodrift.3b"

#: Names of the two in messages on a tape.
_MEANING = {"programmed": "with drift (programmed)", "machine": "without drift (machine)"}


@dataclass(frozen=True)
class Decision:
    """Start positions of a tape's blocks, "programmed" or "machine", and why (empty: the option said it, or both are
    the same to the micrometre)."""

    positions: str
    why: str = ""


def decide(tape: Tape, positions: str = "auto") -> Decision:
    """Tell where the blocks of a tape start; `positions` is one of `POSITIONS`, as asked for."""
    if positions != "auto":
        return Decision(positions)
    if tape.drift is not None:
        decided = "programmed" if tape.drift else "machine"
        return Decision(decided, tape.drift_by and f"{_MEANING[decided]}, {tape.drift_by} says so")
    why = f"taken as {_MEANING['programmed']}; without: --positions machine, or a name that ends in {WITHOUT_DRIFT}"
    return Decision("programmed", why if depends(tape) else "")


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
