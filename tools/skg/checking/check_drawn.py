"""The contours that were cut beside the lines of the file: all that was mended on the way between is told, or refused.

The tape is compared with the contours; these are compared here, both ways, with what the file has. What lies further
from the other than `NEAR` lies within a place that the report names.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import pi
from typing import NamedTuple

import numpy as np
import shapely

from skg.geometry.arrays import Flags, Floats
from skg.geometry.chords import MEASURED, chords_of
from skg.geometry.contour import Contour, Edge
from skg.geometry.pieces import Pieces
from skg.geometry.plane import XY

#: Ends that meet are moved by no more, mm: a contour is no further from what is drawn.
NEAR = 0.0026
#: What is drawn twice is no further from what is cut instead, mm.
_TWICE = 0.0062
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


def off_drawn(
    contours: Sequence[Contour], drawn: Iterable[Edge], whole: Mapping[int, bool], named: Sequence[Named]
) -> OffDrawn:
    """Compare contours with the edges of the file. `drawn`: all of these; `whole`: the numbers of the entities that are
    cut, all of each, and whether something of them is drawn twice; `named`: where the two may differ."""
    edges = list(drawn)
    cut = [edge for contour in contours for edge in contour.edges]
    known, kept = {_form(edge) for edge in edges}, {_form(edge) for edge in cut}
    there = [edge for edge in edges if edge.entity in whole and _form(edge) not in kept]
    parts = [
        *_far_off(_apart([edge for edge in cut if _form(edge) not in known], edges), edges, NEAR),
        *_far_off(_apart([edge for edge in there if not whole[edge.entity]], cut), cut, NEAR),
        *_far_off(_apart([edge for edge in there if whole[edge.entity]], cut), cut, _TWICE),
    ]
    off, place = 0.0, (0.0, 0.0)
    for places, far, near in parts:
        far = np.where((near == _TWICE) & (far <= near), 0.0, far)
        # (few places are off, and many may be named)
        doubted = np.flatnonzero(far > near)
        far[doubted[_are_named(places[doubted], named)]] = 0.0
        worst = int(far.argmax())
        if far[worst] > off:
            off, place = float(far[worst]), (float(places[worst, 0]), float(places[worst, 1]))
    return OffDrawn(off, place)


def off_size(contour: Contour, drawn: Contour, size: float) -> OffDrawn:
    """Compare a closed contour with the drawn one that shapely makes larger by a size on each side, mm; smaller:
    negative."""
    quarter = chords_of(abs(size), pi / 2, MEASURED)
    ring = shapely.buffer(shapely.Polygon(_ring(drawn)), size, quad_segs=quarter)
    cut = shapely.Polygon(_ring(contour))
    off, place = 0.0, contour.edges[0].start
    for one, other in ((cut, ring), (ring, cut)):
        places = shapely.points(shapely.get_coordinates(one))
        far = shapely.distance(places, other.boundary)
        if len(far) and far.max() > off:
            off, place = float(far.max()), tuple(shapely.get_coordinates(places[far.argmax()])[0].tolist())
    return OffDrawn(off, place)


def _ring(contour: Contour) -> list[XY]:
    """Places along a contour, the last one the first; chords between them leave it by no more than is measured."""
    chords = (
        edge.points() if edge.is_line or edge.nodes else edge.parted(edge.chords(MEASURED)) for edge in contour.edges
    )
    return [place for places in chords for place in places]


def _form(edge: Edge) -> tuple:
    """An edge's form, the same for one that is run through backwards."""
    if edge.nodes:
        return frozenset(node.point for node in edge.nodes), len(edge.samples)
    if edge.is_circle:
        return edge.centre, edge.radius
    ahead = edge.start <= edge.end
    return (*sorted((edge.start, edge.end)), edge.centre, edge.sweep if ahead else -edge.sweep)


def _apart(some: list[Edge], others: list[Edge]) -> list[Edge | Floats]:
    """Some edges without what others have of them: of a curve the rows of places whose chords are not theirs. (where a
    contour is entered it has a curve in two)"""
    theirs = {chord for edge in others if edge.nodes for chord in _chords(edge)} if some else set()
    result: list[Edge | Floats] = []
    for edge in some:
        if not edge.nodes:
            result.append(edge)
            continue
        own = np.array([chord not in theirs for chord in _chords(edge)])
        ends = np.flatnonzero(np.diff(own, prepend=False, append=False)).tolist()
        result += [edge.samples[begin : end + 1] for begin, end in zip(ends[::2], ends[1::2], strict=True)]
    return result


def _chords(edge: Edge) -> list[bytes]:
    """The chords of a curve, each the same for a curve that is run through backwards."""
    one, other = edge.samples[:-1], edge.samples[1:]
    ahead = (one[:, 0] < other[:, 0]) | (one[:, 0] == other[:, 0]) & (one[:, 1] < other[:, 1])
    rows = np.where(ahead[:, None], np.hstack((one, other)), np.hstack((other, one)))
    return rows.view(f"V{rows.itemsize * 4}").ravel().tolist()


def _far_off(some: list[Edge | Floats], others: list[Edge], near: float) -> Iterator[tuple[Floats, Floats, float]]:
    """Places on some edges, how far they are from the nearest of others, mm, and what of that is near."""
    if not some:
        return
    pieces, beside = _pieces(some), _pieces(others)
    spacing = max(_SPACING, float(pieces.length.sum()) / _MOST)
    for which, part in pieces.batches(spacing, 2):
        places = pieces.at(which, part)
        far = beside.nearest(places, np.zeros(len(places), np.int64), _FAR).own
        yield places, far, near


def _pieces(edges: Sequence[Edge | Floats]) -> Pieces:
    return Pieces((edge.samples if isinstance(edge, Edge) and edge.nodes else edge, 0) for edge in edges)


def _are_named(places: Floats, named: Sequence[Named]) -> Flags:
    """Mark places where what is cut may differ from what is drawn."""
    result = np.zeros(len(places), bool)
    for (x, y), size in named:
        result |= np.hypot(places[:, 0] - x, places[:, 1] - y) <= size + NEAR
    return result
