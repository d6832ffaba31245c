"""Where the blocks of a tape start: found out once for a whole tape, with the reason."""

from __future__ import annotations

from dataclasses import dataclass

from skg.errors import UserError
from skg.tape.block import Tape

#: Where a block starts: where the block before should have ended (programmed), or where the controller really stands
#: then (machine: tapes without drift); auto: as the tape says, else found out.
POSITIONS = ("auto", "programmed", "machine")

#: What the two are called when something is said of a tape.
_MEANING = {"programmed": "with drift (programmed)", "machine": "without drift (machine)"}
OTHER = {"programmed": "machine", "machine": "programmed"}
#: More evidence than this (log likelihood) for a tape without drift, and it is one. Tapes with drift are more.
_DOUBT = 1
#: Less evidence than this is not certain.
_SURE = 5


@dataclass(frozen=True)
class Decision:
    """Where a tape's blocks start, "programmed" or "machine", and why (empty: it was asked for, or is all the same to
    the micrometre). `finely`: why, where it is the same to the micrometre and matters in what is less alone."""

    positions: str
    why: str = ""
    is_sure: bool = True
    finely: str = ""


def decide(tape: Tape, positions: str = "auto") -> Decision:
    """Tell where the blocks of a tape start; `positions` is one of `POSITIONS`, as asked for."""
    if positions != "auto":
        return Decision(positions)
    if tape.drift is not None:
        told = "programmed" if tape.drift else "machine"
        return Decision(told, tape.drift_by and f"{_MEANING[told]}, {tape.drift_by} says so")
    if all(block.is_line for block in tape.blocks):
        return Decision("programmed")
    # (these load numpy)
    from skg.tape.evidence import drift_evidence
    from skg.tape.moves import closed_moves, machine_moves

    try:
        is_same = bool((machine_moves(tape) == closed_moves(tape)).all())
        found = drift_evidence(tape)
    except UserError:
        # A block that never ends on the controller (a circle of a few µm): it cannot tell where it stands.
        return Decision("programmed", f"taken as {_MEANING['programmed']}: it has blocks that never end")
    decided = "machine" if found > _DOUBT else "programmed"
    is_sure = abs(found) >= _SURE
    why = f"taken as {_MEANING[decided]}" + (
        ": its arcs and the routes that close say so"
        if is_sure
        else f", which is likely, not certain: --positions {OTHER[decided]} if not"
    )
    return Decision(decided, "" if is_same else why, is_sure, why if is_same else "")
