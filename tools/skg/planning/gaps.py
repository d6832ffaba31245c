"""Areas within open lines whose ends nearly meet: outlines with gaps (shapely)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
import shapely

from skg.geometry.areas import lines_of
from skg.geometry.contour import Contour
from skg.geometry.plane import XY, distance

#: A gap is no wider than this part of the line that ends there.
_PART = 0.05


class Gap(NamedTuple):
    """A gap between the ends of lines: a place at it, and its width, mm."""

    place: XY
    width: float


class NearlyClosed(NamedTuple):
    """An area (shapely's) within open lines: their layers, and the widest gap of its outline."""

    area: Any
    layers: tuple[str, ...]
    gap: Gap


def nearly_closed(lines: Sequence[Contour]) -> Iterator[NearlyClosed]:
    """Find what some open lines enclose when each free end is joined to the nearest other end, if that is near."""
    if not lines:
        return
    places = [place for line in lines for place in (line.edges[0].start, line.edges[-1].end)]
    count, points = Counter(places), shapely.points(places)
    lengths = np.repeat([sum(edge.length for edge in line.edges) for line in lines], 2)
    ends, others = shapely.STRtree(points).query_nearest(points, exclusive=True, all_matches=False)
    joined = {
        tuple(sorted((places[end], places[other])))
        for end, other in zip(ends.tolist(), others.tolist(), strict=True)
        if count[places[end]] == 1 and distance(places[end], places[other]) <= _PART * lengths[end]
    }
    if not joined:
        return
    joined = sorted(joined)
    drawn, joints = lines_of(list(lines)), shapely.linestrings(joined)
    # (rings that cross themselves, where lines run past corners, come by themselves)
    cells, _, _, crossed = map(shapely.get_parts, shapely.polygonize_full([*drawn, *joints]))
    for border in (*shapely.get_exterior_ring(cells), *crossed):
        gaps = [joined[number] for number in np.flatnonzero(shapely.covered_by(joints, border)).tolist()]
        if gaps:
            place, other = max(gaps, key=lambda gap: distance(*gap))
            around = np.flatnonzero(shapely.covered_by(drawn, border)).tolist()
            layers = dict.fromkeys(layer for number in around for layer in lines[number].layers)
            area = shapely.make_valid(shapely.Polygon(border))
            yield NearlyClosed(area, tuple(layers), Gap(place, distance(place, other)))
