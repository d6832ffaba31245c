"""Contours as the lines and areas of shapely."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from skg.geometry.contour import Contour
from skg.geometry.edge_arrays import rows_of
from skg.geometry.piece import chords_of

#: The chords that stand for an arc here leave it by no more than this, mm.
CHORD = 5e-4
#: The part of it that is left to curves.
_SPARE = 0.8


def lines_of(contours: list[Contour]) -> NDArray[Any]:
    """Contours as shapely's lines: the points along each of their edges, both ends included."""
    edges = [edge for contour in contours for edge in contour.edges]
    rows = rows_of(edges)
    arcs = np.flatnonzero(rows[:, 8])
    chords = np.array([chords_of(radius, sweep, CHORD) for *_, radius, _, sweep in rows[arcs].tolist()], np.int64)
    counts = np.array([len(edge.samples) or 2 for edge in edges], np.int64)
    counts[arcs] = chords + 1
    first = np.cumsum(counts) - counts
    found = np.empty((int(counts.sum()), 2))
    for many in np.unique(chords).tolist():
        some = arcs[chords == many]
        x, y, radius, begin, sweep = rows[some, 4:].T[:, :, None]
        angles = np.linspace(begin[:, 0], (begin + sweep)[:, 0], many + 1, axis=1)
        places = first[some, None] + np.arange(many + 1)
        found[places, 0], found[places, 1] = x + radius * np.cos(angles), y + radius * np.sin(angles)
    found[first], found[first + counts - 1] = rows[:, 0:2], rows[:, 2:4]
    for at, edge in enumerate(edges):
        if edge.nodes:
            found[first[at] : first[at] + counts[at]] = edge.samples
    owners = np.repeat(np.arange(len(contours)), [len(contour.edges) for contour in contours])
    lines = shapely.linestrings(found, indices=np.repeat(owners, counts))
    curved = [at for at, contour in enumerate(contours) if any(edge.nodes for edge in contour.edges)]
    # (a curve's samples lie ten times as near to it)
    lines[curved] = shapely.simplify(lines[curved], _SPARE * CHORD, preserve_topology=False)
    return lines


def areas_of(contours: list[Contour]) -> NDArray[Any]:
    """The areas of closed contours, by shapely."""
    return shapely.make_valid(np.array([shapely.Polygon(line.coords) for line in lines_of(contours)]))
