"""The words of G-code that are known: those that say nothing of the path, and those of which a line has one at most."""

from __future__ import annotations

from decimal import Decimal

#: Letters that say nothing of the path.
SILENT = "FSTPHDL"
#: Other axes, which may stand at 0.
OTHERS = "ABCUVW"
#: G words that say nothing of it: a dwell, lengths of tools, path modes.
MODES = {Decimal(n) for n in ("4", "8", "9", "40", "43", "49", "50", "61", "64", "69", "80", "91.1", "94", "97")}
#: Work offsets: a program may have one of them.
OFFSETS = {Decimal(n) for n in range(54, 60)}
#: M words of sub-programs, which are no part of a path.
CALLS = {96, 97, 98, 99}
#: Cycles that drill, or bore: at each place down and up again. Their Q is the depth of a peck.
CYCLES = {73, 81, 82, 83, 85, 89}
#: G words that say what a place does; the first ones are the motions.
MOTIONS = set(map(Decimal, range(4)))
WAYS = {*MOTIONS, *map(Decimal, CYCLES)}
#: Of the G words of one of these groups a line has one at most: which of two would count differs among controls.
GROUPS = [
    WAYS,
    *(set(map(Decimal, group.split())) for group in ("17 18 19", "20 21", "90 91", "43 49", "61 64", "98 99")),
    OFFSETS,
]
#: Words that are places, and what G4 has besides P on some controls.
PLACES = "XYZIJKR"
VALUES = PLACES + "F"
DWELL, NO_MOTION = Decimal(4), Decimal(80)
#: Path blending of G64: P, the tolerance at corners, and Q, that for lines that are nearly one.
BLEND = Decimal(64)
#: G words that go to a place of the machine's own: home, or what the line says in its coordinates.
HOMES, MACHINE = {Decimal(28), Decimal(30)}, Decimal(53)
AWAY = {*HOMES, MACHINE}
#: M words of boards for printers: from the first on, and these.
_BOARDS, _BOARD = 100, {17, 18, 84, 92}
#: G words that a message names as expected.
EXPECTED = "G00…G03, G17…G21, G40, G90, G91, G92 or one that does not move"


def is_of_board(number: Decimal) -> bool:
    """Tell whether an M word is one of boards for printers: the words behind it are its own (`M92 X80`: steps)."""
    return number >= _BOARDS or number in _BOARD
