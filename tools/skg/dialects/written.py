"""The program of `skg cut` for a machine that reads G-code, read back before it is written."""

from __future__ import annotations

from collections.abc import Sequence

from skg.dialects.compensated import compensated
from skg.dialects.verify import refuse_other_path
from skg.geometry.piece import Piece
from skg.planning.planned import PlannedContour
from skg.tape import gcode
from skg.tape.block import Tape, micrometres
from skg.tape.dialect import GcodeDialect
from skg.tape.layout import place


def machine_program(
    contours: Sequence[PlannedContour], tape: Tape, positions: str, feed: float, dialect: GcodeDialect, name: str
) -> str:
    """The program of a tape that cuts planned contours: with an offset in the control, where the machine has one and
    the wire runs beside contours. `feed`: mm/min; `name`: the file's, for messages."""
    if dialect.compensation and any(run.offset for planned in contours for run in planned.runs()):
        text, path = compensated(contours, dialect, feed)
    else:
        home = micrometres(contours[0].start[0]), micrometres(contours[0].start[1])
        text = gcode.write(tape, home, (feed, feed), None, positions, dialect)
        path = [
            _in_mm(placed) for route in place(tape, home, positions) if not route.is_move for placed in route.blocks
        ]
    refuse_other_path(text, name, dialect, path)
    return text


def _in_mm(piece: Piece) -> Piece:
    (x, y), (u, v) = piece.start, piece.end
    centre = piece.centre and (piece.centre[0] / 1000, piece.centre[1] / 1000)
    return Piece((x / 1000, y / 1000), (u / 1000, v / 1000), centre, piece.sweep)
