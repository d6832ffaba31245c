"""Contours, their edges and directions as numpy's rows, lengths in millimetres, angles in radians."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from math import pi

import numpy as np

from skg.geometry.arrays import Floats, Whole, columns_at, directions, headings, hypots, numbers_up_to
from skg.geometry.contour import Contour, Edge
from skg.geometry.piece import Piece
from skg.geometry.plane import XY

#: So many arcs become chords together.
_ARCS = 1000


def points_of(contours: Sequence[Contour], off: float | None = None) -> tuple[Floats, Whole]:
    """The points of contours one after the other, to the last bit those of `Contour.points`, and how many each has."""
    edges = [edge for contour in contours for edge in contour.edges]
    # A contour has its edges' points but the last of each, and its end.
    counts = np.array([edge.chords(off) for edge in edges], np.int64)
    first = np.cumsum([0, *(len(contour.edges) for contour in contours)])
    per_contour = np.add.reduceat(counts, first[:-1]) + 1 if edges else counts
    begins = np.cumsum(counts) - counts + np.repeat(np.arange(len(contours)), np.diff(first))
    points = np.empty((int(per_contour.sum()), 2))
    points[begins] = _places([edge.start for edge in edges])
    points[np.cumsum(per_contour) - 1] = _places([contour.edges[-1].end for contour in contours])
    arcs = [number for number, edge in enumerate(edges) if not edge.is_line and not edge.nodes]
    for begin in range(0, len(arcs), _ARCS):
        some = arcs[begin : begin + _ARCS]
        _inner_points([edges[number] for number in some], begins[some], counts[some], points)
    for number, edge in enumerate(edges):
        if edge.nodes:
            points[begins[number] : begins[number] + counts[number]] = edge.samples[:-1]
    return points, per_contour


def _inner_points(arcs: list[Edge], begins: Whole, pieces: Whole, points: Floats) -> None:
    """Put the points of arcs behind their first ones, which are at some places."""
    inner = pieces - 1
    rows = rows_of(arcs)
    # (arcs that differ in place and size alone, as most holes do, have the same directions from their centres)
    kinds, kind = np.unique(np.column_stack((rows[:, 7:9], pieces)), axis=0, return_inverse=True)
    many = kinds[:, 2].astype(int) - 1
    first, sweep, chords = np.repeat(kinds, many, axis=0).T
    ways = headings(first + (numbers_up_to(many) + 1) / chords * sweep)
    number = numbers_up_to(inner)
    across, up = columns_at(ways, np.repeat((np.cumsum(many) - many)[kind], inner) + number)
    x, y, radius = (np.repeat(column, inner) for column in rows[:, 4:7].T)
    places = np.repeat(begins, inner) + number + 1
    points[places, 0], points[places, 1] = x + radius * across, y + radius * up


def rows_of(pieces: Sequence[Piece]) -> Floats:
    """Lines and arcs as rows (n, 9): start, end, centre, radius, angle at the start, sweep; a line has zeros there."""
    rows = np.zeros((len(pieces), 9))
    rows[:, 0:2] = _places([piece.start for piece in pieces])
    rows[:, 2:4] = _places([piece.end for piece in pieces])
    arcs = [number for number, piece in enumerate(pieces) if piece.centre is not None]
    rows[arcs, 4:6] = _places([centre for piece in pieces if (centre := piece.centre) is not None])
    rows[arcs, 8] = [pieces[number].sweep for number in arcs]
    out = rows[arcs, 0:2] - rows[arcs, 4:6]
    rows[arcs, 6], rows[arcs, 7] = hypots(*out.T), directions(out)
    return rows


def _places(places: Sequence[XY]) -> Floats:
    """Places as rows, in half of the time that an array takes from tuples."""
    return np.fromiter(chain.from_iterable(places), float, 2 * len(places)).reshape(-1, 2)


def boxes_of(contours: Sequence[Contour]) -> tuple[Floats, Floats]:
    """The boxes around contours, and around all their edges, as rows (n, 4): smallest x and y, largest x and y."""
    boxes = _boxes_of_edges([edge for contour in contours for edge in contour.edges])
    counts = np.array([len(contour.edges) for contour in contours], np.int64)
    first = np.cumsum(counts) - counts
    around = np.minimum.reduceat(boxes[:, :2], first), np.maximum.reduceat(boxes[:, 2:], first)
    return np.column_stack(around), boxes


def _boxes_of_edges(edges: Sequence[Edge]) -> Floats:
    rows = rows_of(edges)
    low, high = np.minimum(rows[:, 0:2], rows[:, 2:4]), np.maximum(rows[:, 0:2], rows[:, 2:4])
    centres, (radius, first, sweep) = rows[:, 4:6], rows[:, 6:].T
    begin = np.minimum(first, first + sweep)
    for angle, axis, ends, way in ((0, 0, high, 1), (pi / 2, 1, high, 1), (pi, 0, low, -1), (-pi / 2, 1, low, -1)):
        is_there = (sweep != 0) & (np.mod(angle - begin, 2 * pi) <= np.abs(sweep))
        ends[is_there, axis] = (centres[:, axis] + way * radius)[is_there]
    for index, edge in enumerate(edges):
        if edge.nodes:
            low[index], high[index] = (
                np.minimum(low[index], edge.samples.min(0)),
                np.maximum(high[index], edge.samples.max(0)),
            )
    return np.column_stack((low, high))
