"""3B tapes: blocks, their text, where they lie, and what the controller makes of them."""

from skg.tape.block import (
    Block,
    Finding,
    Stop,
    Tape,
    arc_block,
    line_block,
    micrometres,
    parse,
    parse_block,
    read,
    round_sqrt,
    scan,
    start_quadrant,
    to_bytes,
)

__all__ = [
    "Block",
    "Finding",
    "Stop",
    "Tape",
    "arc_block",
    "line_block",
    "micrometres",
    "parse",
    "parse_block",
    "read",
    "round_sqrt",
    "scan",
    "start_quadrant",
    "to_bytes",
]
