"""Areas within open lines whose ends nearly meet: outlines with gaps (shapely)."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

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
    places = [place for line in lines for place in line.ends]
    count, points = Counter(places), shapely.points(places)
    lengths = np.repeat([sum(edge.length for edge in line.edges) for line in lines], 2)
    ends, others = shapely.STRtree(points).query_nearest(points, exclusive=True, all_matches=False)
    near = {
        tuple(sorted((places[end], places[other])))
        for end, other in zip(ends.tolist(), others.tolist(), strict=True)
        if count[places[end]] == 1 and distance(places[end], places[other]) <= _PART * lengths[end]
    }
    if not near:
        return
    joined = sorted(near)
    drawn, joints = lines_of(list(lines)), shapely.linestrings(joined)
    # (rings that cross themselves, where lines run past corners, come by themselves)
    cells, _, _, crossed = map(shapely.get_parts, shapely.polygonize_full([*drawn, *joints]))
    borders = np.concatenate((shapely.get_exterior_ring(cells), crossed))
    gaps, around = _covered(borders, joints), _covered(borders, drawn)
    for border in gaps:
        place, other = max((joined[number] for number in gaps[border]), key=lambda gap: distance(*gap))
        layers = dict.fromkeys(layer for number in around[border] for layer in lines[number].layers)
        area = shapely.make_valid(shapely.Polygon(borders[border]))
        yield NearlyClosed(area, tuple(layers), Gap(place, distance(place, other)))


def _covered(borders: NDArray[Any], lines: NDArray[Any]) -> dict[int, list[int]]:
    """The lines that each border runs along, all by their numbers."""
    covered: dict[int, list[int]] = defaultdict(list)
    pairs = shapely.STRtree(lines).query(borders, predicate="covers")
    for border, number in sorted(zip(*pairs.tolist(), strict=True)):
        covered[border].append(number)
    return covered
