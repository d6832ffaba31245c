"""The contours that were cut beside the lines of the file: all that was mended on the way between is told, or refused.

The tape is compared with the contours; these are compared here, both ways, with what the file has. What lies further
from the other than `NEAR` lies within a place that the report names.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from skg.geometry.arrays import Flags, Floats
from skg.geometry.contour import Contour, Edge
from skg.geometry.pieces import Pieces
from skg.geometry.plane import XY

#: Ends that meet are moved by no more, mm: a contour is no further from what is drawn.
NEAR = 0.0026
#: What is no nearer than this is far off, mm.
_FAR = 0.05
#: Places that are looked at are so far apart, mm, or as far as they are if they are so many.
_SPACING, _MOST = 0.05, 200_000


class Named(NamedTuple):
    """A place that the report names, and how far around it what is cut may differ from what is drawn, mm."""

    place: XY
    size: float


class OffDrawn(NamedTuple):
    """The largest distance between contours and what is drawn where nothing is named, mm, and where."""

    off: float
    place: XY


def off_drawn(contours: Sequence[Contour], drawn: Iterable[Edge], whole: set[int], named: Sequence[Named]) -> OffDrawn:
    """Compare contours with the edges of the file. `drawn`: all of these; `whole`: the numbers of the entities that are
    cut, all of each; `named`: where the two may differ."""
    edges = list(drawn)
    cut = [edge for contour in contours for edge in contour.edges]
    known, kept = {_form(edge) for edge in edges}, {_form(edge) for edge in cut}
    parts = [
        *_far_off([edge for edge in cut if _form(edge) not in known], edges),
        *_far_off([edge for edge in edges if edge.entity in whole and _form(edge) not in kept], cut),
    ]
    off, place = 0.0, (0.0, 0.0)
    for places, far in parts:
        far = np.where((far > NEAR) & _are_named(places, named), 0.0, far)
        worst = int(far.argmax())
        if far[worst] > off:
            off, place = float(far[worst]), (float(places[worst, 0]), float(places[worst, 1]))
    return OffDrawn(off, place)


def _form(edge: Edge) -> tuple:
    """An edge's form, the same for one that is run through backwards."""
    if edge.nodes:
        return frozenset(node.point for node in edge.nodes), len(edge.samples)
    if edge.is_circle:
        return edge.centre, edge.radius
    ahead = edge.start <= edge.end
    return (*sorted((edge.start, edge.end)), edge.centre, edge.sweep if ahead else -edge.sweep)


def _far_off(some: list[Edge], others: list[Edge]) -> Iterator[tuple[Floats, Floats]]:
    """Places on some edges, and how far they are from the nearest of others, mm."""
    if not some:
        return
    pieces, beside = _pieces(some), _pieces(others)
    spacing = max(_SPACING, float(pieces.length.sum()) / _MOST)
    for which, part in pieces.batches(spacing, 2):
        places = pieces.at(which, part)
        far = beside.nearest(places, np.zeros(len(places), np.int64), _FAR).own
        yield places, far


def _pieces(edges: list[Edge]) -> Pieces:
    return Pieces((edge.samples if edge.nodes else edge, 0) for edge in edges)


def _are_named(places: Floats, named: Sequence[Named]) -> Flags:
    """Mark places where what is cut may differ from what is drawn."""
    result = np.zeros(len(places), bool)
    for (x, y), size in named:
        result |= np.hypot(places[:, 0] - x, places[:, 1] - y) <= size + NEAR
    return result
