"""Programs for an offset in the control: the contour itself once a pass, beside it the words that put the wire aside.

The lead-in switches the offset on: the wire comes to R beside the contour, square to its first block; the way out
switches it off likewise.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from skg.errors import UserError
from skg.geometry.contour import Edge
from skg.geometry.offset import as_arcs
from skg.geometry.piece import Piece
from skg.geometry.plane import XY
from skg.messages.finding import Finding, Phrase
from skg.planning.planned import PlannedContour, Reason
from skg.planning.runs import Lead, Run
from skg.tape.block import micrometres
from skg.tape.dialect import GcodeDialect
from skg.tape.gcode import GcodeWriter, Spot, decimal, spot


def compensated(contours: Sequence[PlannedContour], dialect: GcodeDialect, feed: float) -> tuple[str, list[Piece]]:
    """Return the G-code that cuts planned contours with the dialect's words for an offset, and its path, mm, as it is
    without an offset; `feed` is mm/min.

    A contour of which the wire leaves edges out is a `UserError`: a control would stop there.
    """
    contours = [_as_drawn(planned) for planned in contours]
    offsets = _offsets(contours)
    words, writer = dialect.compensation, GcodeWriter(dialect)
    assert words  # (its caller asks for them)
    path: list[Piece] = []
    numbers = {offset: str(number) for number, offset in enumerate(offsets, 1)}

    def filled(template: str, offset: int) -> str:
        return template.replace("{number}", numbers[offset]).replace("{offset}", dialect.length(offset))

    writer.all_of(dialect.head)
    if words.define:
        writer.all_of(filled(words.define, offset) for offset in offsets)
    for planned in contours:
        for run in planned.runs():
            hole = spot(run.into.threaded if run.into else planned.start)
            if writer.spot is None:
                writer.begin(hole)
            elif hole != writer.spot:
                writer.all_of(dialect.unthread)
                writer.rapid(hole)
                writer.all_of(dialect.thread)
            elif run.stop or run.number == 0:
                writer.all_of(dialect.stop)
            _Cut(writer, path, decimal(feed)).run(run, hole, filled)
    writer.all_of(dialect.foot)
    return writer.text, path


def _offsets(contours: Sequence[PlannedContour]) -> list[int]:
    """The offsets of planned contours along the drawing, by their numbers from 1, um."""
    return list(dict.fromkeys(_beside(run) for planned in contours for run in planned.runs() if run.offset))


def to_be_set(contours: Sequence[PlannedContour], dialect: GcodeDialect) -> list[Finding]:
    """Tell which offsets the control must have for the program of some contours, where that does not define them."""
    if not dialect.compensation or dialect.compensation.define:
        return []
    offsets = _offsets([_as_drawn(planned) for planned in contours])
    numbered = (Phrase("offset-of-number", number=at, offset=offset / 1000) for at, offset in enumerate(offsets, 1))
    return [Finding("offsets-to-be-set", offsets=tuple(numbered))] if offsets else []


class _Cut:
    """A cut in the order of writing."""

    def __init__(self, writer: GcodeWriter, path: list[Piece], feed: str) -> None:
        self.writer, self.path, self.feed = writer, path, feed

    def run(self, run: Run, hole: Spot, filled: Callable[[str, int], str]) -> None:
        """From a start hole along the contour, and to a start hole."""
        writer, words = self.writer, self.writer.dialect.compensation
        assert words
        writer.all_of(writer.dialect.begin)
        way_in, way_out = _ways(run)
        if run.into and run.into.home:
            self.straight(run.into.hole)
        if run.offset:
            writer.block(filled(words.right if run.offset > 0 else words.left, _beside(run)))
        self.straight((way_in or run.edges)[0].start)
        for piece in (piece for edge in (*way_in, *run.edges, *way_out) for piece in as_arcs(edge)):
            if piece.centre is None:
                self.straight(piece.end)
            else:
                self.path.append(piece)
                writer.arc(spot(piece.end), spot(piece.centre), 1 if piece.sweep > 0 else -1, self.feed)
        if run.offset:
            writer.block(words.off)
        if run.out:
            self.straight(run.out.hole)
            self.straight(run.out.threaded)
        elif run.is_closed:
            self.straight((hole[0] / 1000, hole[1] / 1000))
        writer.all_of(writer.dialect.end)

    def straight(self, place: XY) -> None:
        """A line to a place, mm."""
        x, y = self.writer.here  # (begun at a hole)
        self.path.append(Piece((x / 1000, y / 1000), place))
        self.writer.line(spot(place), self.feed)


def _ways(run: Run) -> tuple[tuple[Edge, ...], tuple[Edge, ...]]:
    """The arcs that lead to the contour and from it."""

    def arc(lead: Lead | None, is_in: bool) -> tuple[Edge, ...]:
        return (lead.arc(is_in),) if lead and lead.is_arc else ()

    return arc(run.into, True), arc(run.out, False)


def _as_drawn(planned: PlannedContour) -> PlannedContour:
    """The same along its contour."""
    wire = planned.rung.wire
    if not wire:
        return planned
    if wire.reason is Reason.EDGES:
        raise UserError(
            Finding("edges-left-out", name=planned.name, contour=planned.number, place=planned.entry),
        )
    return planned.on_rung(wire=None)


def _beside(run: Run) -> int:
    return micrometres(abs(run.offset))
