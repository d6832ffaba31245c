"""The wire beside the contours that a program draws: where it cuts into them, where it does not come to.

The reference draws each contour with R 0 and says where the wire goes with the program's R; the tape has the way that
the wire goes in fact. Neither corners nor crossings are looked at: the wire is too near to a contour, or beside a place
of it that has room for the wire it never was.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from math import copysign, pi

import numpy as np

from skg.checking.check_coverage import has_room
from skg.checking.gouges import crossings
from skg.checking.wire_path import LIMIT, place_of
from skg.geometry.arrays import Floats, Whole
from skg.geometry.piece import Piece
from skg.geometry.pieces import Pieces
from skg.geometry.plane import XY, distance
from skg.messages.finding import Finding, Phrase
from skg.messages.render import text
from skg.ref.route import Segment
from skg.ref.values import Curve, Point
from skg.tape.layout import Laid, PlacedRoute

#: Ends that are no further apart are one corner, mm.
_CORNER = 1e-3
#: Places on a path are looked at no more than this part of R from each other.
_SPACING = 0.25
#: The parts of a circle that the wire and the contour have may differ by so much, radians.
_TURN = pi


@dataclass(frozen=True)
class Spoilt:
    """A place (mm) of a contour that the wire spoils: `depth`, how far it cuts into it, mm, 0 where it does not come
    to it. `line`: of the program, near it; None for one without a number. `is_other`: another contour's
    wire does. `tool`: "wire" or "cutter"."""

    place: XY
    depth: float
    line: int | None
    is_other: bool = False
    tool: str = "wire"

    @property
    def finding(self) -> Finding:
        """The finding with its place."""
        tool = Phrase(f"tool-{self.tool}")
        code = "path-cuts-in" if not self.is_other else "path-of-other-cuts-in"
        why = Finding(code, tool=tool, depth=self.depth) if self.depth else Finding("path-not-there", tool=tool)
        if self.line is None:
            return why.within(Phrase("at-place", place=self.place))
        return why.within(Phrase("at-place-near-line", place=self.place, line=self.line))

    def plain(self) -> dict[str, object]:
        """The place for other programs."""
        return asdict(self) | {"code": self.finding.code, "message": text(self.finding)}


@dataclass(frozen=True)
class RefusedProgram:
    """The reference refuses a program that the firmware has cut: its error and line. Behind that line the wire is not
    laid beside what it draws, but for its way on the tape."""

    error: int
    line: int | None

    @property
    def finding(self) -> Finding:
        """The finding."""
        where = None if self.line is None else Phrase("of-line", line=self.line)
        return Finding("reference-refuses", number=self.error, where=where)

    def plain(self) -> dict[str, object]:
        """The refusal for other programs."""
        return asdict(self) | {"code": self.finding.code, "message": text(self.finding)}


@dataclass
class _Run:
    """A contour that the wire runs beside at a stretch: what is drawn, where the wire goes, its R of each element.

    `leads`: the way from and to the start hole of its route.
    """

    drawn: list[Segment]
    wire: list[Segment]
    leads: list[Segment]
    offsets: dict[Curve | None, float]
    is_closed: bool = False

    def r(self, segment: Segment) -> float:
        """R beside a segment, mm, positive to the right."""
        known = self.offsets.get(segment.nominal)
        return next(iter(self.offsets.values())) if known is None else known


def look(
    wires: Sequence[Sequence[Segment]],
    drawn: Sequence[Sequence[Segment]],
    tool: str = "wire",
    cut: Sequence[PlacedRoute] = (),
    wanted: Sequence[PlacedRoute] = (),
    is_whole: bool = True,
) -> tuple[list[Spoilt], int]:
    """Lay the wire of each route beside what it draws; return what it spoils, and the number of contours.

    `wires`: the segments of the routes with the program's R; `drawn`: with R 0. `tool`: "wire" or "cutter".
    `cut` and `wanted`: the routes on the tape, and on the reference's where that is another one. Not `is_whole`: the
    last of the wires breaks off in its route.
    """
    pairs = list(zip(wires, drawn, strict=is_whole))
    runs = [run for number, pair in enumerate(pairs, 1) for run in _runs(*pair, is_whole or number < len(pairs))]
    if not runs:
        return [], 0
    contours = Pieces((_piece(one), number) for number, run in enumerate(runs) for one in run.drawn)
    offsets = np.array([run.r(one) for run in runs for one in run.drawn])
    lines = [one.line for run in runs for one in run.drawn]
    found = [*_turned(runs)]
    found += _cut_into(runs, contours, offsets, lines)
    found += _into_others(runs, contours, lines)
    if cut:
        found += _astray(_cut_pieces(cut), _cut_pieces(wanted), contours, offsets, lines)
    found.sort(key=lambda one: -one.depth)
    if is_whole:
        found += _not_reached(runs, contours, offsets, lines)
    return [replace(one, tool=tool) for one in found], len(runs)


def _runs(wire: Sequence[Segment], drawn: Sequence[Segment], is_whole: bool) -> Iterator[_Run]:
    """The contours of a route with R, in order; all of it is one where its wire is not whole."""
    groups = [list(group) for group in _beside(wire, lambda segment: segment.offset != 0)]
    offsets = {segment.nominal: float(segment.offset) for group in groups for segment in group}
    contours = [list(group) for group in _beside(drawn, lambda segment: not is_whole or segment.nominal in offsets)]
    if len(groups) != len(contours):
        # (an element so short that the wire passes it over has divided one of the two)
        groups, contours = ([[segment for group in some for segment in group]] for some in (groups, contours))
    leads = [segment for segment in wire if not segment.offset]
    for group, contour in zip(groups, contours, strict=True):
        if not group or not contour:
            continue
        run = _Run(contour, group, leads, {segment.nominal: float(segment.offset) for segment in group})
        if loop := _loop(contour):
            run.is_closed = True
        else:
            loop = _without_leads(contour, drawn)
        if len(contour[loop]) < len(contour):
            run.drawn = contour[loop]
            known = {segment.nominal for segment in run.drawn}
            run.leads = leads + [segment for segment in group if segment.nominal not in known]
            run.wire = [segment for segment in group if segment.nominal in known]
        yield run


def _beside(segments: Iterable[Segment], is_beside: Callable[[Segment], bool]) -> Iterator[list[Segment]]:
    """Stretches of segments that are elements of the contour with R."""
    stretch: list[Segment] = []
    for segment in segments:
        if segment.nominal is not None and is_beside(segment):
            stretch.append(segment)
        elif stretch:
            yield stretch
            stretch = []
    if stretch:
        yield stretch


def _loop(contour: Sequence[Segment]) -> slice | None:
    """The longest stretch of a contour that ends where it begins: without the leads that are drawn with R."""
    best = None
    begins: dict[tuple[int, int], int] = {}
    for number, segment in enumerate(contour):
        begins.setdefault(_cell(segment.start), number)
        x, y = _cell(segment.end)
        near = [
            begin
            for i in (-1, 0, 1)
            for j in (-1, 0, 1)
            if (begin := begins.get((x + i, y + j))) is not None
            and distance(_xy(contour[begin].start), _xy(segment.end)) <= _CORNER
        ]
        if near and (best is None or number + 1 - min(near) > best.stop - best.start):
            best = slice(min(near), number + 1)
    return best


def _without_leads(contour: Sequence[Segment], drawn: Sequence[Segment]) -> slice:
    """An open contour without the arcs that come to it from a line with R 0, or go to one (a part up to its tab)."""
    places = {id(segment): number for number, segment in enumerate(drawn)}
    first, last = places[id(contour[0])], places[id(contour[-1])]
    begins = contour[0].is_arc and first > 0 and drawn[first - 1].role == "cut"
    ends = contour[-1].is_arc and last + 1 < len(drawn) and drawn[last + 1].role == "cut"
    return slice(int(begins), len(contour) - int(ends)) if len(contour) > begins + ends else slice(len(contour))


def _cell(point: Point) -> tuple[int, int]:
    return round(float(point.x) / _CORNER), round(float(point.y) / _CORNER)


def _xy(point: Point) -> XY:
    return float(point.x), float(point.y)


def _cut_pieces(routes: Sequence[PlacedRoute]) -> Pieces:
    """The cuts of routes on a tape, mm; all have one owner, 0."""
    laid = Laid.joined([Laid.of(route.blocks) for route in routes if not route.is_move] or [Laid.of(())])
    sweeps = np.where(laid.is_line, 0.0, laid.sweeps)
    start, end, centre = (side / 1000 for side in (laid.starts, laid.ends, laid.centres))
    return Pieces.of_columns(start, end, centre, sweeps, np.zeros(len(laid), np.int64))


def _piece(segment: Segment) -> Piece:
    if segment.centre is None:
        return Piece(_xy(segment.start), _xy(segment.end))
    assert segment.sweep is not None and segment.radius is not None, "an arc has both"
    sweep = copysign(float(segment.sweep), float(segment.radius))
    return Piece(_xy(segment.start), _xy(segment.end), _xy(segment.centre), sweep)


def _turned(runs: Sequence[_Run]) -> Iterator[Spoilt]:
    """Circles that the wire goes around on the other side than they are drawn."""
    for run in runs:
        sweeps: dict[Curve | None, float] = {}
        for sign, segments in ((1, run.wire), (-1, run.drawn)):
            for segment in segments:
                if segment.sweep is not None:
                    sweeps[segment.nominal] = sweeps.get(segment.nominal, 0.0) + sign * float(segment.sweep)
        for segment in run.drawn:
            if segment.is_arc and abs(sweeps.pop(segment.nominal, 0.0)) > _TURN:
                yield Spoilt(_xy(segment.start), abs(run.r(segment)), segment.line)


class _Deepest:
    """The deepest place of each piece of the contours that the wire comes into."""

    def __init__(self, contours: Pieces, lines: Sequence[int | None]) -> None:
        self.contours, self.lines = contours, lines
        self.depths: dict[int, tuple[float, XY]] = {}

    def take(self, piece: Whole, depth: Floats, places: Floats) -> None:
        """The wire at places, so deep in the pieces nearest to them, mm."""
        for number in np.flatnonzero(depth > LIMIT).tolist():
            own = int(piece[number])
            if depth[number] > self.depths.get(own, (0.0,))[0]:
                self.depths[own] = float(depth[number]), place_of(places[number])

    def found(self) -> Iterator[Spoilt]:
        for own, (depth, wire) in sorted(self.depths.items()):
            place = self.contours.at(np.array([own]), self.contours.part(np.array([wire]), np.array([own])))[0]
            yield Spoilt(place_of(place), depth, self.lines[own])


def _cut_into(runs: Sequence[_Run], contours: Pieces, offsets: Floats, lines: Sequence[int | None]) -> Iterator[Spoilt]:
    """The deepest place of each piece of a contour that its own wire comes into."""
    least = [min(map(abs, run.offsets.values())) for run in runs]
    parts = [
        (_piece(segment), number, abs(float(segment.offset)) or least[number])
        for number, run in enumerate(runs)
        for segment in (*run.wire, *(run.leads if run.is_closed else ()))
    ]
    wire, wanted = Pieces((piece, number) for piece, number, _ in parts), np.array([r for _, _, r in parts])
    widest = float(np.abs(offsets).max())
    deepest = _Deepest(contours, lines)
    for which, part in wire.batches(_SPACING * float(np.abs(offsets).min()), 2):
        places = wire.at(which, part)
        near = contours.nearest(places, wire.owner[which], widest)
        some = np.flatnonzero(near.own_at >= 0)
        piece = near.own_at[some]
        depth = np.minimum(wanted[which[some]], np.abs(offsets[piece])) - near.own[some]
        deepest.take(piece, depth, places[some])
    yield from deepest.found()


def _astray(
    tape: Pieces, wanted: Pieces, contours: Pieces, offsets: Floats, lines: Sequence[int | None]
) -> Iterator[Spoilt]:
    """The deepest place of each piece of a contour that the tape's wire comes into off the way on which it is
    `wanted`."""
    aside = np.abs(offsets)
    deepest = _Deepest(contours, lines)
    for which, part in tape.batches(_SPACING * float(aside.min()), 2):
        places = tape.at(which, part)
        places = places[wanted.nearest(places, np.zeros(len(places), int), 2 * LIMIT).own > LIMIT]
        piece = contours.nearest(places, np.full(len(places), -1), float(aside.max())).other_at
        places, piece = places[piece >= 0], piece[piece >= 0]
        deepest.take(piece, aside[piece] - contours.from_place(places, piece), places)
    yield from deepest.found()


def _not_reached(
    runs: Sequence[_Run], contours: Pieces, offsets: Floats, lines: Sequence[int | None]
) -> Iterator[Spoilt]:
    """The middle one of the places of each piece of a contour that have room for the wire, which was never there."""
    wire = Pieces((_piece(segment), number) for number, run in enumerate(runs) for segment in run.wire)
    missed: dict[int, list[XY]] = defaultdict(list)
    for which, part in contours.batches(_SPACING * float(np.abs(offsets).min()), 2):
        aside = offsets[which]
        is_free = has_room(contours, which, part, aside)
        which, part, aside = which[is_free], part[is_free], aside[is_free]
        on = contours.at(which, part)
        places = on + aside[:, None] * contours.normal(which, part)
        far = wire.nearest(places, contours.owner[which], 2 * LIMIT).own
        for number in np.flatnonzero(far > LIMIT).tolist():
            missed[int(which[number])].append(place_of(on[number]))
    for piece, places in sorted(missed.items()):
        yield Spoilt(places[len(places) // 2], 0.0, lines[piece])


def _into_others(runs: Sequence[_Run], contours: Pieces, lines: Sequence[int | None]) -> Iterator[Spoilt]:
    """The deepest place of each closed contour that another one's wire comes into."""
    closed = [number for number, run in enumerate(runs) if run.is_closed]
    if len(closed) < 2:
        return
    wire = Pieces((_piece(one), number) for number in closed for one in (*runs[number].wire, *runs[number].leads))
    least = np.array([min(map(abs, run.offsets.values())) for run in runs])
    others = np.array(closed)
    is_right = np.zeros(len(runs))
    for number in closed:
        places = contours.start[contours.owner == number]
        (x, y), (u, v) = places.T, np.roll(places, -1, 0).T
        is_right[number] = (x * v - y * u).sum() * runs[number].r(runs[number].drawn[0])
    every = np.arange(len(wire.owner))

    def drawn(owners: Whole) -> Pieces:
        return contours.some(np.flatnonzero(np.isin(contours.owner, owners)))

    for cut in crossings(wire, every, drawn, others, least, is_right < 0, is_right > 0):
        nearest = contours.nearest(np.array([cut.place]), np.array([cut.other]), 2 * LIMIT).own_at[0]
        yield Spoilt(cut.place, cut.depth, lines[nearest] if nearest >= 0 else None, is_other=True)
