"""The start holes for who drills them: a list as CSV, and a drilling program, read back before it is given."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from decimal import Decimal
from io import StringIO

from skg.errors import UserError
from skg.geometry.plane import XY
from skg.messages.finding import Finding
from skg.planning.planned import PlannedContour
from skg.tape.block import micrometres
from skg.tape.gcode import ENDINGS, Spot, drilling, is_gcode, spot
from skg.tape.gcode_program import Drilled
from skg.tape.gcode_reader import read

CSV = ".csv"
#: The drill goes on so far below the stock, and begins so far above it, mm; its feed, mm/min.
OVER, CLEAR, FEED = 2.0, 2.0, 100.0
_NOTE = "START HOLES. Z0: TOP OF THE STOCK. SET F AND THE SPINDLE"


def refuse_name(name: str) -> None:
    """Raise a `UserError` where a file's name says neither CSV nor G-code."""
    if not (name.lower().endswith(CSV) or is_gcode(name)):
        raise UserError(Finding("holes-name", endings=(CSV, *ENDINGS)).within(name))


def holes_file(contours: Sequence[PlannedContour], thickness: float | None, name: str) -> bytes:
    """The file of the start holes that a name asks for; a drilling program wants the stock's thickness, mm."""
    return table(contours) if name.lower().endswith(CSV) else drilled(contours, thickness, name)


def findings(contours: Sequence[PlannedContour], thickness: float | None, name: str) -> list[Finding]:
    """Report the depth and the feed that the drilling program assumes."""
    if name.lower().endswith(CSV) or thickness is None:
        return []
    depth = thickness + OVER
    return [
        Finding("drilled", count=len(holes_of(contours)), depth=depth, over=OVER, clear=CLEAR, feed=FEED).within(name)
    ]


def table(contours: Sequence[PlannedContour]) -> bytes:
    """The holes as CSV in the order of cutting: number, x and y (mm), the contour's number and kind."""
    text = StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow(("hole", "x_mm", "y_mm", "contour", "kind"))
    for number, ((x, y), planned) in enumerate(holes_of(contours), 1):
        # (-0.0001 is 0.000)
        writer.writerow((number, *(f"{round(part, 3) + 0.0:.3f}" for part in (x, y)), planned.turn, planned.kind))
    return text.getvalue().encode("ascii")


def drilled(contours: Sequence[PlannedContour], thickness: float | None, name: str) -> bytes:
    """The program that drills the holes through the stock, by G81."""
    if thickness is None:
        raise UserError(Finding("drill-without-thickness").within(name))
    holes, depth = [spot(hole) for hole, _ in holes_of(contours)], -micrometres(thickness + OVER)
    text = drilling(holes, depth, micrometres(CLEAR), FEED, _NOTE)
    if read(text, name).path.marks != [Drilled(hole, Decimal(depth)) for hole in holes]:
        raise UserError(Finding("read-back-empty").within(name))
    return text.encode("ascii")


def holes_of(contours: Iterable[PlannedContour]) -> list[tuple[XY, PlannedContour]]:
    """The places of the holes, mm, each once, with the first contour that is cut from there."""
    holes: dict[Spot, tuple[XY, PlannedContour]] = {}
    for planned in contours:
        for hole in planned.holes:
            holes.setdefault(spot(hole), (hole, planned))
    return list(holes.values())
