"""The path of the wire beside a closed contour where that has edges that the wire cannot follow.

An inner arc with a smaller radius than R, a step shorter than R in a corner: the wire goes past them, from one edge
that it can follow to the next. `wire_path` finds which these are from all that lies within R of the edges, and
then works out their parallels and where these meet.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from math import acos, atan2, cos, floor, hypot, pi, sin, sqrt

import numpy as np
import shapely

from skg.geometry.chords import MEASURED, chords_of
from skg.geometry.contour import Contour, Edge, part_of
from skg.geometry.fitting import biarc_joint
from skg.geometry.plane import XY, cross, distance, dot, minus, polar, turn
from skg.messages.finding import Phrase

#: The wire follows nothing that is shorter, mm: the ROM would take its ends for one place.
_LEAST = 2e-3
#: A slot that is narrower than two R by less than twice this is wide enough, mm: the machine's own step is twice that.
_HAIR = 5e-4
#: What is not as wide as this is no room, mm.
_SLIT = 1e-5
#: An arc that is this near to its chord is cut as the chord, mm.
_FLAT = 1e-4
#: The ends of an arc may be so much further from its centre than each other, mm: half of what the ROM lets pass.
_UNEVEN = 5e-4
#: Directions (radians) that differ by less run on without a corner.
_SMOOTH = 1e-3
#: A tip is a spike where its parallels meet farther than this from it, in R.
SPIKE = 10.0
#: A closed path begins within an edge, this part of it from its ends where it is short.
_INSIDE = 0.2


#: The largest offset that a contour has room for is looked for in so many halvings, and said in steps of so much, mm.
_HALVINGS, _STEP = 12, 0.001


class NoRoom(Exception):
    """The wire does not get around a contour; `why` is the reason, `place` (mm) where.

    `is_crossing`: it would not with any offset.
    """

    def __init__(self, place: XY, code: str, is_crossing: bool = False) -> None:
        super().__init__(code)
        self.why = Phrase(code, place=place)
        self.place = place
        self.is_crossing = is_crossing


#: A line is no corner when it is longer than so many R, an arc or curve (a fillet of half a turn has pi) than so many;
#: the wire is beside an edge when a place of it is no further from the wire than R and this, mm.
_SLOT, _BEND, _OFF = 2.0, 4.0, 0.003
#: Lines that turn by no more are a wall: from one to the next, and all together (radians).
_STRAIGHT, _WALL = 0.3, pi / 4
#: Where the wire turns by more in an inner corner it stays off by more than R (radians).
_SHARP = 2 * pi / 3 + _SMOOTH
#: Reasons of `NoRoom`.
_NONE, _NECK, _SLOTTED, _CROSSES = "room-none", "room-neck", "room-slot", "crosses-itself"


@dataclass(frozen=True)
class _Beside:
    """A guide of the wire: an edge, or a corner of the contour (`centre`, with the edge before it).

    On a circle about `centre` it is `radius` away from it, and turns by `sense`; on a line `centre` is None.
    """

    edge: Edge
    at: int
    centre: XY | None
    radius: float = 0.0
    sense: int = 0

    def off(self, place: XY, r: float) -> tuple[float, XY]:
        """Distance of a place to the right of the wire's line or circle, and the direction in which it grows."""
        if self.centre is None:
            way = minus(self.edge.end, self.edge.start)
            length = hypot(*way)
            square = way[1] / length, -way[0] / length
            return dot(minus(place, self.edge.start), square) - r, square
        way = minus(place, self.centre)
        length = hypot(*way) or 1e-12
        return length - self.radius, (way[0] / length, way[1] / length)

    def piece(self, start: XY, end: XY) -> Edge:
        """The wire's path along it."""
        if self.centre is None:
            return Edge(start, end, entity=self.edge.entity)
        first, last = (atan2(*reversed(minus(place, self.centre))) for place in (start, end))
        sweep = self.sense * (self.sense * (last - first) % (2 * pi))
        most = abs(self.edge.sweep) if self.centre == self.edge.centre else pi
        if abs(sweep) > pi + most / 2:
            # (a corner that rounding, or a very short edge, put before the one before it)
            sweep -= self.sense * 2 * pi
        if self.radius * (1 - cos(min(pi, abs(sweep)) / 2)) < _FLAT:
            return Edge(start, end, entity=self.edge.entity)
        centre = self.centre
        if abs(distance(start, centre) - distance(end, centre)) > _UNEVEN:
            # (the circle that is nearest to it through both ends: the ROM refuses an end that lies beside its circle)
            centre = _on_bisector(centre, start, end)
        return Edge(start, end, centre, sweep, entity=self.edge.entity)


def as_arcs(edge: Edge) -> Iterator[Edge]:
    """An edge as lines and arcs; of a curve the biarcs that FIT makes of its nodes."""
    if not edge.nodes:
        yield edge
        return
    for one, other in pairwise(edge.nodes):
        joint = biarc_joint(one, other)
        if joint is None:
            yield Edge(one.point, other.point, entity=edge.entity)
            continue
        yield _tangent(one.point, one.angle, joint, edge.entity)
        yield _tangent(other.point, other.angle + pi, joint, edge.entity).reversed()


def _tangent(start: XY, angle: float, end: XY, entity: int) -> Edge:
    """The arc that leaves a place in a direction for another place."""
    normal = -sin(angle), cos(angle)
    way = minus(end, start)
    height = dot(normal, way)
    if abs(height) < _FLAT:
        return Edge(start, end, entity=entity)
    radius = dot(way, way) / (2 * height)
    centre = start[0] + radius * normal[0], start[1] + radius * normal[1]
    sweep = 2 * turn(angle, atan2(way[1], way[0]))
    return Edge(start, end, centre, sweep, entity=entity)


def wire_path(contour: Contour, r: float) -> tuple[Edge, ...]:
    """Return the path of the wire along a closed contour, in its direction, R (mm) to the right of it.

    Where it does not get everywhere but to corners, or nowhere at all, it raises `NoRoom`.
    """
    edges = _lines_and_arcs(contour)
    if len(edges) == 1:
        (edge,) = edges
        assert edge.centre is not None, "a closed contour of one edge is a circle"
        radius = edge.radius + (r if edge.sweep > 0 else -r)
        if radius < _LEAST:
            raise NoRoom(edge.centre, _NONE)
        start = polar(edge.centre, radius, edge.angles[0])
        return (replace(edge, start=start, end=start),)
    ring = _ring(edges, r)
    runs = _runs(edges, ring, r)
    corners = [_corner(one, other, near, r) for (one, _), (other, near) in pairwise([*runs[-1:], *runs])]
    path = [beside.piece(*ends) for (beside, _), ends in zip(runs, pairwise([*corners, *corners[:1]]), strict=True)]
    while len(runs) > 1:
        short = min(range(len(path)), key=lambda k: path[k].length)
        if path[short].length >= _LEAST:
            _refuse_slots(contour, path, r)
            return tuple(path)
        # (its neighbours meet instead)
        del runs[short], corners[short], path[short]
        behind = short % len(runs)
        corners[behind] = _corner(runs[behind - 1][0], *runs[behind], r)
        for k in (behind - 1, behind):
            path[k] = runs[k][0].piece(corners[k], corners[(k + 1) % len(runs)])
    raise NoRoom(contour.edges[0].start, _NONE)


def has_spike(contour: Contour, r: float, far: float) -> bool:
    """Tell whether the wire, R (mm) to the right of a closed contour, would run past a tip of it by more than `far`
    R."""
    most, sense = 2 * acos(1 / far), 1 if r > 0 else -1
    ways = [(edge.direction(), edge.direction(1.0)) for edge in contour.edges]
    return any(sense * turn(end, start) > most for (_, end), (start, _) in pairwise([ways[-1], *ways]))


def widest(contour: Contour, r: float) -> float:
    """The largest offset (mm, no more than that of R) with which the wire gets around a closed contour; 0: none."""
    fits, fails = 0.0, abs(r)
    for _ in range(_HALVINGS):
        tried = (fits + fails) / 2
        try:
            wire_path(contour, tried if r > 0 else -tried)
            fits = tried
        except NoRoom:
            fails = tried
    return floor(fits / _STEP) * _STEP


def _lines_and_arcs(contour: Contour) -> list[Edge]:
    return [piece for edge in contour.edges for piece in as_arcs(edge) if piece.length > 1e-9]


def _ring(edges: list[Edge], r: float) -> np.ndarray:
    """The wire's path roughly: places along it, the last one the first."""
    area = _area(edges)
    is_ccw = area.exterior.is_ccw
    near = [ring for edge in edges for ring in _near(edge, max(abs(r) - _HAIR, abs(r) / 2))]
    numbers = np.repeat(np.arange(len(near)), [len(ring) for ring in near])
    strip = shapely.union_all(shapely.polygons(shapely.linearrings(np.concatenate(near), indices=numbers)))
    beside = shapely.union(area, strip) if is_ccw == (r > 0) else shapely.difference(area, strip)
    parts = [part for part in getattr(beside, "geoms", [beside]) if not part.is_empty]
    rings = [ring for part in parts for ring in (part.exterior, *part.interiors)]
    if not rings:
        raise NoRoom(edges[0].start, _NONE)
    rings.sort(key=lambda ring: -ring.length)
    for other in rings[1:]:
        # (where two arcs run on into each other there may be a slit between what is near to one and the other)
        if other.length > 10 * _LEAST and shapely.Polygon(other).area > _SLIT * other.length:
            neck = shapely.get_coordinates(shapely.shortest_line(rings[0], other)).mean(0)
            raise NoRoom((float(neck[0]), float(neck[1])), _NECK)
    places = shapely.get_coordinates(rings[0])
    return places if rings[0].is_ccw == is_ccw else places[::-1]


def _area(edges: list[Edge]) -> shapely.Polygon:
    """Signed area of edges."""
    points = [point for edge in edges for point in _chords(edge)]
    area = shapely.Polygon(points if len(points) > 2 else [])
    if not area.is_empty and area.is_valid:
        return area
    # (such as: Self-intersection[3.5 2])
    named = re.search(r"\[(\S+) (\S+)]", shapely.is_valid_reason(area))
    raise NoRoom((float(named[1]), float(named[2])) if named else edges[0].start, _CROSSES, True)


def _near(edge: Edge, r: float) -> Iterator[np.ndarray]:
    """The places within R (mm) of an edge: the corners of what lies beside it, and those of a circle about its end."""
    # (GEOS's own buffers will not do: it takes corners away that are up to 1 % of R, where many short chords meet more)
    yield edge.end + _circle(r)
    if edge.centre is None:
        aside = np.array(polar((0.0, 0.0), r, edge.direction() + pi / 2))
        yield np.array([edge.start - aside, edge.end - aside, edge.end + aside, edge.start + aside])
        return
    about = (np.array([*_chords(edge), edge.end]) - edge.centre) / edge.radius
    inner = max(0.0, edge.radius - r)
    # (in two: of a whole circle it would touch itself)
    for half in (about[: len(about) // 2 + 1], about[len(about) // 2 :]):
        yield edge.centre + np.concatenate(((edge.radius + r) * half, inner * (half[::-1] if inner else half[:1])))


@lru_cache(maxsize=1)
def _circle(r: float) -> np.ndarray:
    """Places along a circle about 0, 0, the last one left out."""
    return np.array(_chords(Edge((r, 0.0), (r, 0.0), (0.0, 0.0), 2 * pi)))


def _chords(edge: Edge) -> list[XY]:
    """Places along an edge, the last one left out."""
    if edge.centre is None:
        return [edge.start]
    return edge.parted(chords_of(edge.radius, edge.sweep, MEASURED))[:-1]


def _runs(edges: list[Edge], ring: np.ndarray, r: float) -> list[tuple[_Beside, XY]]:
    """Yield the wire's guides in order, each with about where it begins."""
    middles = (ring[:-1] + ring[1:]) / 2
    lengths = np.hypot(*(ring[1:] - ring[:-1]).T)
    kept = lengths > 1e-7
    tree = shapely.STRtree([shapely.LineString([*_chords(edge), edge.end]) for edge in edges])
    nearest = tree.query_nearest(shapely.points(middles[kept]), all_matches=False)[1]
    runs: list[tuple[_Beside, XY]] = []
    travel: list[float] = []
    for number, begin, middle, length in zip(nearest, ring[:-1][kept], middles[kept], lengths[kept], strict=True):
        beside = _beside(edges, int(number), (float(middle[0]), float(middle[1])), r)
        if beside.radius < 0:
            # (of an inner arc smaller than R: a place between its neighbours' parallels that rounding gave to it)
            continue
        if runs and runs[-1][0] == beside:
            travel[-1] += float(length)
        else:
            runs.append((beside, (float(begin[0]), float(begin[1]))))
            travel.append(float(length))
    if len(runs) > 1 and runs[0][0] == runs[-1][0]:
        runs[0] = runs.pop()
        travel[0] += travel.pop()
    result: list[tuple[_Beside, XY]] = []
    for run, length in zip(runs, travel, strict=True):
        if length >= _LEAST / 2 and not (result and result[-1][0] == run[0]):
            result.append(run)
    if len(result) > 1 and result[0][0] == result[-1][0]:
        result[0] = result.pop()
    return result


def _beside(edges: list[Edge], number: int, place: XY, r: float) -> _Beside:
    """Return the wire's guide at a place: the edge with a number, or one of its ends."""
    edge = edges[number]
    part = edge.nearest(place)
    for end, before in ((0.0, number - 1), (1.0, number)):
        if part == end:
            one, other = edges[before], edges[(before + 1) % len(edges)]
            if abs(turn(one.direction(1.0), other.direction())) > _SMOOTH:
                return _Beside(one, before % len(edges), other.start, abs(r), 1 if r > 0 else -1)
    if edge.centre is None:
        return _Beside(edge, number, None)
    sense = 1 if edge.sweep > 0 else -1
    return _Beside(edge, number, edge.centre, edge.radius + sense * r, sense)


def _corner(one: _Beside, other: _Beside, near: XY, r: float) -> XY:
    """Return the place near another where the wire changes guides: where they meet, else in the middle between them."""
    place = near
    for _ in range(30):
        (off, square), (too, athwart) = one.off(place, r), other.off(place, r)
        area = cross(square, athwart)
        if abs(area) < _SMOOTH:
            break
        step = (too * square[1] - off * athwart[1]) / area, (off * athwart[0] - too * square[0]) / area
        place = place[0] + step[0], place[1] + step[1]
        if distance(place, near) > abs(r):
            place = near
            break
        if hypot(*step) < 1e-11:
            return place
    else:
        # (they miss each other: the step goes to and fro)
        place = near
    for _ in range(30):
        (off, square), (too, athwart) = one.off(place, r), other.off(place, r)
        step = (off * square[0] + too * athwart[0]) / 2, (off * square[1] + too * athwart[1]) / 2
        place = minus(place, step)
        if hypot(*step) < 1e-11:
            break
    return place


def _on_bisector(centre: XY, start: XY, end: XY) -> XY:
    """The place nearest to a centre that is as far from one place as from another."""
    way = minus(end, start)
    ahead = (dot(minus(end, centre), minus(end, centre)) - dot(minus(start, centre), minus(start, centre))) / 2
    part = ahead / dot(way, way)
    return centre[0] + part * way[0], centre[1] + part * way[1]


def uncut(contour: Contour, path: Sequence[Edge], r: float) -> tuple[float, XY]:
    """Largest distance (mm) of the wire, R beside a contour, from it in corners that it cannot follow, and the
    place."""
    places = contour.points()
    off = shapely.distance(shapely.points(places), _as_line(path)) - abs(r)
    worst = int(np.argmax(off))
    return float(off[worst]), places[worst]


def _as_line(path: Sequence[Edge]) -> shapely.LineString:
    """A path as chords."""
    return shapely.LineString([place for edge in path for place in (*_chords(edge), edge.end)])


def sharpest(contour: Contour, r: float) -> tuple[float, XY] | None:
    """Distance (mm) of the wire, R to the right of a closed contour, from its sharpest inner corner, between lines,
    and where that is; None where no corner is sharper than 60 degrees, so that it is no more than R."""
    ways = [(edge.direction(), edge.direction(1.0)) for edge in contour.edges]
    turns = [turn(start, end) if r > 0 else turn(end, start) for (_, end), (start, _) in pairwise([ways[-1], *ways])]
    corner = max(range(len(turns)), key=turns.__getitem__)
    if turns[corner] < _SHARP:
        return None
    # (in a cusp that closes for good it never ends)
    return abs(r) * (1 / max(cos(turns[corner] / 2), _SMOOTH) - 1), contour.edges[corner].start


def _refuse_slots(contour: Contour, path: Sequence[Edge], r: float) -> None:
    """Raise `NoRoom` where the wire passes over more than a corner: it is nowhere beside an edge that is too long, or
    beside chords that are too long together."""
    line = _as_line(path)
    shapely.prepare(line)
    # (around an edge's end it is R away from that, and so much further in by all that it may be off)
    ends = sqrt(3 * abs(r) * _OFF)
    for edges in _walls(contour.edges):
        length, edge = sum(edge.length for edge in edges), edges[len(edges) // 2]
        if length <= (_SLOT if edge.is_line else _BEND) * abs(r):
            continue
        places = [edge.samples if edge.nodes else np.array([*_chords(edge), edge.end]) for edge in edges]
        if not shapely.dwithin(line, _without_ends(np.concatenate(places), ends), abs(r) + _OFF):
            raise NoRoom(edge.at(0.5), _SLOTTED)


def _without_ends(places: np.ndarray, ends: float) -> shapely.LineString:
    """Places joined by chords, but for so much (mm) at both ends."""
    along = np.concatenate(((0.0,), np.cumsum(np.hypot(*np.diff(places, axis=0).T))))
    first = min(ends, 0.49 * along[-1])
    last = along[-1] - first
    between = places[(along > first) & (along < last)]
    one, other = (np.array([np.interp(station, along, column) for column in places.T]) for station in (first, last))
    return shapely.LineString([one, *between, other])


def _walls(edges: Sequence[Edge]) -> Iterator[list[Edge]]:
    """The edges, from a corner on; lines that follow each other all but straight on, as the chords of a curve do,
    together."""
    turns = [
        turn(one.direction(), other.direction()) if one.is_line and other.is_line else pi
        for one, other in pairwise([edges[-1], *edges])
    ]
    first = max(range(len(turns)), key=lambda corner: abs(turns[corner]))
    wall: list[Edge] = []
    turned = 0.0
    for edge, by in zip((*edges[first:], *edges[:first]), (*turns[first:], *turns[:first]), strict=True):
        if wall and (abs(by) > _STRAIGHT or abs(turned + by) > _WALL):
            yield wall
            wall, turned = [], 0.0
        turned += by if wall else 0.0
        wall.append(edge)
    yield wall


def roomy_place(path: tuple[Edge, ...], place: XY) -> XY:
    """A place that a closed path goes around: the given one, else the one that is farthest from the path; in a circle
    beside that, since from a centre the ROM goes to the +X side (language.md, section 4.2)."""
    if path[0].is_circle and path[0].centre is not None:
        (x, y), radius = path[0].centre, path[0].radius
        far = distance((x, y), place)
        return place if far < radius else (x + (place[0] - x) * radius / far / 2, y + (place[1] - y) * radius / far / 2)
    corners = [corner for edge in path for corner in _chords(edge)]
    area = shapely.Polygon(corners if len(corners) > 2 else [])
    if area.is_empty or area.contains(shapely.Point(place)):
        return place
    x, y = shapely.get_coordinates(shapely.maximum_inscribed_circle(area))[0].tolist()
    return x, y


def part_between(path: tuple[Edge, ...], first: XY, last: XY | None) -> tuple[Edge, ...]:
    """A closed path from the place on it nearest to `first` on: to the one nearest to `last`, or back to where it began
    (then it begins within an edge)."""
    at, part = _nearest(path, first, last is None)
    edge = path[at]
    if edge.is_circle:
        opened: tuple[Edge, ...] = (replace(edge, start=edge.at(part), end=edge.at(part)),)
    else:
        head, tail = part_of(edge, part, 1.0), part_of(edge, 0.0, part)
        opened = (head, *path[at + 1 :], *path[:at], replace(tail, end=head.start))
    if last is not None:
        # (where it begins on a corner one of the two has no length)
        opened = tuple(edge for edge in opened if edge.length > 1e-9)
        at, part = _nearest(opened, last, False)
        opened = (*opened[:at], part_of(opened[at], 0.0, part))
    # (ends that fall on a corner leave a bit of an edge, shorter than what the ROM tells apart)
    return tuple(edge for edge in opened if edge.length > _LEAST / 2)


def _nearest(path: tuple[Edge, ...], place: XY, is_within: bool) -> tuple[int, float]:
    nearest = []
    # (of a very short edge what is left behind the entry would be lost)
    short = min(10 * _LEAST, max(edge.length for edge in path)) if is_within else 0.0
    for index, edge in enumerate(path):
        if edge.length < short:
            continue
        part = edge.nearest(place)
        if is_within and not edge.is_circle:
            margin = min(_INSIDE, 10 * _LEAST / edge.length)
            part = min(1 - margin, max(margin, part))
        nearest.append((distance(edge.at(part), place), index, part))
    return min(nearest)[1:]
