"""Parts that what is cut out of them parts into pieces: a window that reaches from edge to edge (shapely)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import shapely

from skg.geometry.areas import areas_of
from skg.geometry.plane import XY
from skg.messages.finding import Finding
from skg.planning.planned import PlannedContour

#: What is narrower than twice this holds nothing together, mm; a piece of less than this square is none.
_HAIR = 0.005
#: Lines of the report about them.
_PLACES = 5


def fallen(contours: Sequence[PlannedContour]) -> Iterator[tuple[int, int, XY]]:
    """The outlines (by their numbers) of which the openings leave more than one piece: how many, a place in the
    smallest of them, mm."""
    closed = np.array([number for number, planned in enumerate(contours) if planned.contour.is_closed], int)
    depth = np.array([contours[number].depth for number in closed.tolist()], int)
    if not len(closed) or not depth.any():
        return
    areas = areas_of([contours[number].contour for number in closed.tolist()])
    outline, opening = shapely.STRtree(areas).query(areas)
    is_in = (depth[outline] % 2 == 0) & (depth[opening] == depth[outline] + 1)
    outline, opening = outline[is_in], opening[is_in]
    for number in np.unique(outline).tolist():
        left = areas[number].difference(shapely.union_all(areas[opening[outline == number]]))
        left = left.buffer(-_HAIR, join_style="mitre")
        pieces = [piece for piece in getattr(left, "geoms", [left]) if piece.area > _HAIR**2]
        if len(pieces) > 1 and len(pieces) > _pieces(areas[number]):
            inside = min(pieces, key=lambda piece: piece.area).representative_point()
            yield int(closed[number]), len(pieces), (inside.x, inside.y)


def findings(contours: Sequence[PlannedContour]) -> list[Finding]:
    """Report split parts."""
    split = [
        Finding("part-in-pieces", turn=contours[number].turn, count=count, contour=contours[number].number, place=place)
        for number, count, place in fallen(contours)
    ]
    more = len(split) - _PLACES
    return split[:_PLACES] + [Finding("more-such-parts", count=more)] * (more > 0)


def _pieces(area: shapely.Geometry) -> int:
    """Count the pieces of an outline by itself: one that crosses itself has more than one."""
    return len(getattr(area.buffer(-_HAIR, join_style="mitre"), "geoms", [area]))
