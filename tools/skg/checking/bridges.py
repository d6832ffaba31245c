"""The third part of the check: tabs hold part and stock, or slug and part, together until they are cut (shapely).

What the wire takes away before is a band, R wide on each side of its path. What is left must hang together, with each
of the tabs by itself.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import shapely

from skg.checking.follow import Stretch
from skg.checking.gouges import lines_of
from skg.checking.wire_path import LIMIT, WirePath
from skg.geometry.areas import areas_of
from skg.geometry.plane import XY
from skg.planning.planned import PlannedContour

#: A piece of metal need not be held that is smaller than a square with a side of so many R, or this part of a tab: such
#: as what is between leads that are arcs.
_CRUMB, _SCRAP = 4.0, 0.35
#: Stock around a contour and its leads that is looked at, mm.
_AROUND = 1.0


class Fallen(NamedTuple):
    """A tab that holds nothing: of which contour, its place."""

    contour: int
    place: XY


def fallen(path: WirePath, cuts: Sequence[Stretch], contours: Sequence[PlannedContour]) -> Iterator[Fallen]:
    """The tabs that the wire has cut, or cut off, before it comes to them."""
    firsts = np.cumsum([0, *(cut.blocks.stop - cut.blocks.start for cut in cuts)])
    stretches: dict[int, list[tuple[Stretch, slice]]] = {}
    for cut, first, last in zip(cuts, firsts, firsts[1:], strict=False):
        if contours[cut.contour].tabs.each:
            stretches.setdefault(cut.contour, []).append((cut, slice(int(first), int(last))))
    for number, some in stretches.items():
        planned = contours[number]
        aside = max(abs(r) for r in planned.offsets) + LIMIT
        before: list[shapely.Geometry] = []
        by_tab: list[list[shapely.Geometry]] = []
        for cut, pieces in some:
            wire = shapely.union_all(lines_of(path.pieces.some(np.arange(pieces.start, pieces.stop))))
            if cut.passes[0] == len(planned.passes):
                by_tab.append([])
            (by_tab[-1] if by_tab else before).append(wire.buffer(aside, quad_segs=16))
        up_to_tabs = shapely.union_all(before)
        for turn, tab in enumerate(planned.tab_order):
            others = [band for other, bands in enumerate(by_tab) if other != turn for band in bands]
            if not _hangs_together(planned, shapely.union_all([up_to_tabs, *others]), aside):
                yield Fallen(number, planned.spans[tab][1][0].start)


def _hangs_together(planned: PlannedContour, band: shapely.Geometry, aside: float) -> bool:
    """Tell whether what is within a contour and what is around it is one piece of metal without a band, which lies so
    much aside of its middle (mm), but for crumbs."""
    (area,) = areas_of([planned.contour])
    box = shapely.box(*shapely.union(area, band).bounds).buffer(_AROUND, join_style="mitre")
    metal, edge = shapely.get_parts(box.difference(band)), shapely.Point(*box.bounds[:2])
    within = shapely.area(shapely.intersection(metal, area))
    loose = within[~shapely.intersects(metal, edge)]
    crumb = max(_CRUMB * aside, _SCRAP * planned.tabs.length) ** 2
    return not (loose > crumb).any() and within.sum() > loose.sum()
