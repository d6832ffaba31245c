"""A job's drawing on the machine: its contours, start holes and settings as they lie there, and messages back."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np

from skg.errors import UserError
from skg.geometry.arrays import Floats
from skg.geometry.contour import Contour
from skg.geometry.edge_arrays import boxes_of
from skg.geometry.placement import Placement
from skg.geometry.plane import XY
from skg.job.placing import ORIGINS, Copies, Place
from skg.job.wanted import CutSettings
from skg.messages.finding import Finding, Phrase
from skg.planning.copies import Pattern
from skg.planning.nesting import Nesting
from skg.reading.read import FARTHEST


def placement_of(place: Place, cut: Sequence[Contour], shift: XY) -> Placement:
    """The placement of a drawing of which some contours are cut. `shift`: how far all of it has moved since the job was
    written, mm. A part that would lie too far away is a `UserError`."""
    if place == Place():
        return Placement()
    turned = Placement.of(place.turn, place.mirror, place.scale)
    boxes = boxes_of([turned.contour(contour) for contour in cut])[0] if cut else np.empty((0, 4))
    if isinstance(place.origin, str) and cut:
        wide, high = ORIGINS[place.origin]
        (left, low), (right, top) = _around(boxes)
        origin = turned.back.place((left + wide * (right - left), low + high * (top - low)))
    else:
        x, y = place.origin if isinstance(place.origin, tuple) else (-shift[0], -shift[1])
        origin = x + shift[0] + 0.0, y + shift[1] + 0.0
    x, y = (round(ordinate, 9) + 0.0 for ordinate in origin)
    made = replace(turned, origin=(x, y))
    if cut:
        x, y = turned.place(made.origin)
        if (far := max(abs(boxes - [x, y, x, y]).max(0).tolist())) >= FARTHEST:
            raise UserError(Finding("placed-too-far", far=far / 1000, most=FARTHEST / 1000))
    return made


def _around(boxes: Floats) -> tuple[XY, XY]:
    """The lower left and the upper right corner of the box around boxes (n × 4)."""
    low, high = boxes[:, :2].min(0).tolist(), boxes[:, 2:].max(0).tolist()
    return tuple(low), tuple(high)


def pattern_of(copies: Copies, placement: Placement, cut: Sequence[Contour]) -> Pattern:
    """The copies on the machine. `cut`: the contours that are cut, as they are drawn; copies that would lie too far
    away are a `UserError`."""
    pattern = Pattern(copies, placement.place(copies.about or (0.0, 0.0)))
    boxes, _ = boxes_of([placement.contour(contour) for contour in cut])
    (left, low), (right, top) = _around(boxes)
    corners = [(left, low), (left, top), (right, low), (right, top)]
    places = (to.place(corner) for to in pattern.placements for corner in corners)
    if (far := max(max(map(abs, place)) for place in places)) >= FARTHEST:
        raise UserError(Finding("copies-too-far", far=far / 1000, most=FARTHEST / 1000))
    return pattern


def placed_nesting(nesting: Nesting, placement: Placement, pattern: Pattern | None, reach: float) -> Nesting:
    """Contours on the machine: what lies in what is as it is drawn. `reach`: copies within it are beside, mm."""
    around = {
        number: outer._replace(gap=outer.gap and outer.gap._replace(place=placement.place(outer.gap.place)))
        for number, outer in nesting.around.items()
    }
    contours = [placement.contour(contour) for contour in nesting.contours]
    beside = pattern.beside(contours, reach) if pattern else []
    return Nesting(contours, nesting.depths, around, beside)


def placed_wanted(wanted: CutSettings, is_closed: bool, placement: Placement) -> CutSettings:
    """Settings of a contour on the machine. In a mirror the wire is on the other side of an open line's direction."""
    if placement.is_nothing:
        return wanted
    tabs = wanted.tabs if isinstance(wanted.tabs, int) else tuple(map(placement.place, wanted.tabs))
    side = wanted.side
    if placement.is_mirror and not is_closed:
        side = {"left": "right", "right": "left"}.get(side, side)
    start, entry = (place and placement.place(place) for place in (wanted.start, wanted.entry))
    return replace(wanted, tabs=tabs, side=side, start=start, entry=entry)


def as_drawn(finding: Finding, placement: Placement) -> Finding:
    """A message on what is on the machine, with the places of the drawing."""
    return finding if placement.is_nothing else finding.moved(placement.back.place)


@contextmanager
def told_as_drawn(placement: Placement, *source: str | Phrase) -> Iterator[None]:
    """Give what is refused within the places of the drawing, and where it comes from."""
    try:
        yield
    except UserError as error:
        error.finding = as_drawn(error.finding, placement)
        raise error.within(*source) from None


def placed_findings(place: Place, placement: Placement, pattern: Pattern | None, size: XY) -> list[Finding]:
    """Report where the part lies, and its copies. `size`: its width and height as it is drawn, mm."""
    report = []
    if place != Place():
        mirror = Phrase("placed-mirror-x" if place.mirror == "x" else "placed-mirror-y") if place.mirror else None
        turn = Phrase("placed-turned", turn=place.turn) if place.turn else None
        report.append(Finding("placed", origin=placement.origin, mirror=mirror, turn=turn))
    if place.scale != 1:
        width, height = (side * place.scale for side in size)
        report.append(Finding("scaled", scale=place.scale, width=width, height=height))
    if pattern:
        copies = pattern.copies
        if copies.around > 1:
            report.append(Finding("copies-around", count=copies.around, angle=copies.angle, about=copies.about))
        else:
            about: dict[str, Any] = {"columns": copies.columns, "rows": copies.rows, "step": copies.step}
            report.append(Finding("copies-in-rows", count=copies.count, **about))
    return report
