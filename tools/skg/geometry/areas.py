"""Contours as the lines and areas of shapely."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from skg.geometry.chords import SEEN
from skg.geometry.contour import Contour
from skg.geometry.edge_arrays import points_of

#: The part of `SEEN` that is left to curves, whose samples lie nearer to them.
_SPARE = 0.8


def lines_of(contours: list[Contour]) -> NDArray[Any]:
    """Contours as shapely's lines, which leave them by no more than `SEEN`."""
    points, counts = points_of(contours, SEEN)
    lines = shapely.linestrings(points, indices=np.repeat(np.arange(len(contours)), counts))
    curved = [number for number, contour in enumerate(contours) if any(edge.nodes for edge in contour.edges)]
    lines[curved] = shapely.simplify(lines[curved], _SPARE * SEEN, preserve_topology=False)
    return lines


def areas_of(contours: list[Contour]) -> NDArray[Any]:
    """The areas of closed contours, by shapely."""
    return shapely.make_valid(np.array([shapely.Polygon(line.coords) for line in lines_of(contours)]))
