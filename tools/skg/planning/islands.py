"""Islands: contours in openings that are not cut would be cut in the middle of the part (shapely)."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import shapely

from skg.geometry.areas import areas_of
from skg.planning.nesting import places_in
from skg.planning.planned import PlannedContour


def islands(contours: Mapping[int, PlannedContour], openings: Collection[int]) -> dict[int, int]:
    """Contours, by their numbers, that lie in some openings, others of them, and the innermost of these for each."""
    around = sorted(
        (number for number in openings if contours[number].is_opening), key=lambda number: contours[number].depth
    )
    if not around:
        return {}
    least = contours[around[0]].depth
    others = [number for number, planned in contours.items() if number not in openings and planned.depth > least]
    if not others:
        return {}
    places = places_in([contours[number].contour for number in others])
    areas = areas_of([contours[number].contour for number in around])
    holders, held = shapely.STRtree(places).query(areas, predicate="contains")
    islands: dict[int, int] = {}
    for opening, inner in zip(holders.tolist(), held.tolist(), strict=True):
        # (the openings come in the order of their depths)
        if contours[others[inner]].depth > contours[around[opening]].depth:
            islands[others[inner]] = around[opening]
    return islands
