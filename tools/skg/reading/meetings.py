"""Pairs of contours that touch, cross, overlap or repeat each other (found by shapely)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from skg.geometry.areas import lines_of
from skg.geometry.arrays import Flags, Floats, Whole
from skg.geometry.chords import SEEN
from skg.geometry.contour import Contour
from skg.geometry.edge_arrays import boxes_of
from skg.geometry.plane import XY
from skg.reading.budget import check_pairs

#: Contours that run along each other for more than this part of the shorter one overlap, else they touch.
_ALONG = 0.03
#: So many pairs of contours that meet are looked at.
_MOST = 300
#: Rounding of a reach: a line within it may seem to lie this much farther away, mm.
_HAIR = 1e-9
#: So many boxes are looked for together.
_TOGETHER = 1000
#: So many contours become lines together.
_LINES = 100


@dataclass
class Relations:
    """Contours by their numbers. `repeated`: those that are the same as an earlier one, and which; `touched`: open ones
    that touch or cross another one; `meetings`: what two closed ones (or one with itself) do at a place; `unseen`: how
    many more pairs of closed ones meet."""

    repeated: dict[int, int] = field(default_factory=dict)
    touched: set[int] = field(default_factory=set)
    meetings: list[tuple[str, int, int, XY]] = field(default_factory=list)
    unseen: int = 0


def relations(contours: list[Contour], tolerance: float) -> Relations:
    """Find the contours that meet: somewhere no further apart than `tolerance`, mm."""
    relations = Relations()
    relations.repeated = _copies(contours)
    is_closed = np.array([contour.is_closed for contour in contours], bool)
    # (the chords of 20,000 circles would take 100 MB: most drawings have few contours that come near to others)
    single = np.array([number for number in range(len(contours)) if number not in relations.repeated], np.int64)
    near = single[_near_others([contours[number] for number in single.tolist()], tolerance + 2 * SEEN)]
    lines = np.full(len(contours), None)
    lines[near] = lines_of([contours[number] for number in near.tolist()])
    firsts, seconds = near[
        shapely.STRtree(lines[near]).query(lines[near], predicate="dwithin", distance=tolerance + 2 * SEEN)
    ]
    firsts, seconds = firsts[firsts < seconds], seconds[firsts < seconds]
    repeats = _repeats(lines[firsts], lines[seconds], tolerance) & (is_closed[firsts] == is_closed[seconds])
    for second, first in sorted(zip(seconds[repeats].tolist(), firsts[repeats].tolist(), strict=True)):
        relations.repeated.setdefault(second, relations.repeated.get(first, first))
    relations.repeated = dict(sorted(relations.repeated.items()))
    gone = set(relations.repeated)
    for first, second in sorted(zip(firsts.tolist(), seconds.tolist(), strict=True)):
        if first in gone or second in gone:
            continue
        relations.touched |= {number for number in (first, second) if not is_closed[number]}
        if is_closed[first] and is_closed[second] and len(relations.meetings) >= _MOST:
            relations.unseen += 1
        elif is_closed[first] and is_closed[second]:
            kind, place = _meeting(lines[first], lines[second], tolerance)
            relations.meetings.append((kind, first, second, place))
    for number, place in _crossing_themselves(contours):
        if number not in gone:
            relations.meetings.append(("cross", number, number, place))
    return relations


def _copies(contours: list[Contour]) -> dict[int, int]:
    """The contours that are exactly an earlier one, and which."""
    first: dict[tuple, int] = {}
    return {
        number: known
        for number, contour in enumerate(contours)
        if (known := first.setdefault(_form(contour), number)) != number
    }


def _form(contour: Contour) -> tuple:
    """All that a contour is, but for the entities that it was made of."""
    return contour.is_closed, *((edge.start, edge.end, edge.centre, edge.sweep, edge.nodes) for edge in contour.edges)


def _near_others(contours: list[Contour], reach: float) -> Whole:
    """The contours that come near to others: an edge's box lies within reach of that of another contour's edge."""
    around, boxes = boxes_of(contours)
    counts = np.array([len(contour.edges) for contour in contours], np.int64)
    owners = np.repeat(np.arange(len(contours)), counts)
    is_circle = np.array([edge.is_circle for contour in contours for edge in contour.edges], bool)
    is_one = is_circle[np.cumsum(counts) - counts] & (counts == 1)
    # (the box around a frame is near to all that is in it, those around its edges are not)
    edges = np.flatnonzero(np.isin(owners, _near_boxes(around, np.arange(len(contours)), is_one, reach)))
    return _near_boxes(boxes[edges], owners[edges], is_circle[edges], reach)


def _near_boxes(boxes: Floats, owners: Whole, is_circle: Flags, reach: float) -> Whole:
    """The owners of boxes that lie within reach of another owner's; of two around circles: where these do."""
    grown = boxes + (reach + _HAIR) * np.array((-1, -1, 1, 1))
    firsts, seconds = _pairs(boxes, grown)
    is_other = owners[firsts] != owners[seconds]
    firsts, seconds = firsts[is_other], seconds[is_other]
    middle, radius = (boxes[:, 0:2] + boxes[:, 2:4]) / 2, (boxes[:, 2] - boxes[:, 0]) / 2
    apart = np.hypot(*(middle[firsts] - middle[seconds]).T)
    gap = np.maximum(apart - radius[firsts] - radius[seconds], np.abs(radius[firsts] - radius[seconds]) - apart)
    # (chords of circles may be nearer to each other than the circles)
    is_near = ~(is_circle[firsts] & is_circle[seconds]) | (gap <= reach + 2 * SEEN)
    return np.unique(owners[firsts[is_near]])


def _pairs(boxes: Floats, grown: Floats) -> tuple[Whole, Whole]:
    """The grown boxes and the boxes that these meet; a `UserError` where they are too many."""
    tree = shapely.STRtree(shapely.box(*boxes.T))
    pairs, count = [np.empty((2, 0), np.int64)], 0
    for begin in range(0, len(grown), _TOGETHER):
        firsts, seconds = tree.query(shapely.box(*grown[begin : begin + _TOGETHER].T))
        pairs.append(np.stack((firsts + begin, seconds)))
        count += len(firsts)
        check_pairs(count)
    firsts, seconds = np.concatenate(pairs, 1)
    return firsts, seconds


def _crossing_themselves(contours: list[Contour]) -> Iterator[tuple[int, XY]]:
    """The closed contours that cross themselves, and where; one that is a circle does not."""
    is_circle = [len(contour.edges) == 1 and contour.edges[0].is_circle for contour in contours]
    closed = [number for number, contour in enumerate(contours) if contour.is_closed and not is_circle[number]]
    for first in range(0, len(closed), _LINES):
        numbers = closed[first : first + _LINES]
        lines = lines_of([contours[number] for number in numbers])
        for index in np.flatnonzero(~shapely.is_simple(lines)).tolist():
            number = numbers[index]
            reason = shapely.is_valid_reason(shapely.Polygon(lines[index].coords))
            place = reason.partition("[")[2].rstrip("]").split()
            yield number, (float(place[0]), float(place[1])) if len(place) == 2 else contours[number].edges[0].start


def _repeats(ones: NDArray[Any], others: NDArray[Any], tolerance: float) -> NDArray[np.bool_]:
    """Mark the pairs of lines that are the same."""
    repeats = np.abs(shapely.bounds(ones) - shapely.bounds(others)).max(1, initial=0) <= tolerance + 2 * SEEN
    repeats &= np.abs(shapely.length(ones) - shapely.length(others)) <= 1e-3 * shapely.length(ones) + tolerance
    repeats[repeats] = shapely.hausdorff_distance(ones[repeats], others[repeats], 0.5) <= tolerance + 2 * SEEN
    return repeats


def _meeting(first: shapely.LineString, second: shapely.LineString, tolerance: float) -> tuple[str, XY]:
    """Return how two closed lines meet, and where."""
    near = shapely.intersection(first, second.buffer(tolerance + 2 * SEEN, quad_segs=2))
    place = shapely.get_coordinates(shapely.shortest_line(first, second) if near.is_empty else near)[0]
    areas = shapely.make_valid(np.array([shapely.Polygon(line.coords) for line in (first, second)]))
    common = shapely.intersection(*areas).area
    smaller = min(shapely.area(areas))
    # (a strip as wide as the tolerance along the shorter line is no more than touching)
    strip = 2 * tolerance * min(first.length, second.length)
    if strip < common < smaller - strip:
        return "cross", (float(place[0]), float(place[1]))
    longest = max(part.length for part in getattr(near, "geoms", [near]))
    kind = "overlap" if longest > _ALONG * min(first.length, second.length) else "touch"
    return kind, (float(place[0]), float(place[1]))


def lying_on(runs: list[Contour], contours: list[Contour], tolerance: float) -> tuple[dict[int, int], set[int]]:
    """The runs that lie on a contour, all along: their numbers, and those of the contours; and those between contours:
    runs that end on one, or where others end, at both ends."""
    if not runs or not contours:
        return {}, set()
    reach = tolerance + 2 * SEEN
    starts, ends = [run.edges[0].start for run in runs], [run.edges[-1].end for run in runs]
    places = [shapely.points(group) for group in (starts, ends, [run.edges[0].at(0.5) for run in runs])]
    around = shapely.STRtree(shapely.box(*boxes_of(contours)[0].T))
    numbers = np.unique(around.query(np.concatenate(places), predicate="dwithin", distance=reach)[1])
    lines = lines_of([contours[number] for number in numbers.tolist()])
    tree = shapely.STRtree(lines)
    near = [set(zip(*tree.query(place, predicate="dwithin", distance=reach).tolist(), strict=True)) for place in places]
    covered = {run: int(numbers[index]) for run, index in _covered(runs, lines, set.intersection(*near), reach).items()}
    count = Counter(starts + ends)
    held = [
        {run for run, _ in on} | {run for run, end in enumerate(side) if count[end] > 1}
        for on, side in zip(near[:2], (starts, ends), strict=True)
    ]
    return covered, held[0] & held[1] - covered.keys()


def _covered(runs: list[Contour], lines: NDArray[Any], pairs: set[tuple[int, int]], reach: float) -> dict[int, int]:
    """Of pairs of a run and a line near its ends and middle: the runs that lie within reach of one all along, and the
    first such line."""
    result: dict[int, int] = {}
    for run, index in sorted(pairs):
        (line,) = lines_of([runs[run]])
        if run not in result and lines[index].buffer(reach, quad_segs=2).covers(line):
            result[run] = index
    return result


def nearest(places: list[XY]) -> list[XY | None]:
    """For each place the nearest of the others that is not the same place."""
    if not places:
        return []
    points = shapely.points(places)
    numbers, neighbours = shapely.STRtree(points).query_nearest(points, exclusive=True, all_matches=False)
    result: list[XY | None] = [None] * len(places)
    for number, neighbour in zip(numbers.tolist(), neighbours.tolist(), strict=True):
        result[number] = places[neighbour]
    return result
