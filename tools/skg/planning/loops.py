"""Loops of a contour that are smaller than the wire: a laser's program rounds inner corners on their outside with
them."""

from __future__ import annotations

from dataclasses import replace
from math import pi

from skg.geometry.contour import Contour, Edge
from skg.geometry.plane import XY, distance

#: What is no further apart is one place, mm.
_SAME = 1e-6


def without_loops(contour: Contour, r: float) -> tuple[Contour, tuple[XY, ...]]:
    """Return a closed contour without what leaves a place of it and comes back there within the circumference of a
    wire, R (mm) beside it; and these places."""
    kept: list[Edge] = []
    places: list[XY] = []
    for edge in contour.edges:
        kept.append(edge)
        if (first := _loop(kept, 2 * pi * abs(r))) is not None:
            places.append(edge.end)
            del kept[first:]
    return (replace(contour, edges=tuple(kept)), tuple(places)) if places and kept else (contour, ())


def _loop(edges: list[Edge], most: float) -> int | None:
    """The first of the last edges that come back to where they leave within a length, mm."""
    length = 0.0
    for first in range(len(edges) - 1, -1, -1):
        length += edges[first].length
        if length > most:
            return None
        if distance(edges[first].start, edges[-1].end) < _SAME:
            return first
    return None
