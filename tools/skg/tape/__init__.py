"""3B tapes: blocks, their text, where they lie, and what the controller makes of them."""

from skg.tape.block import Block, Stop, Tape, arc_block, line_block, micrometres, round_sqrt, start_quadrant
from skg.tape.text import TapeFault, parse, read, scan, to_bytes

__all__ = [
    "Block",
    "TapeFault",
    "Stop",
    "Tape",
    "arc_block",
    "line_block",
    "micrometres",
    "parse",
    "read",
    "round_sqrt",
    "scan",
    "start_quadrant",
    "to_bytes",
]
