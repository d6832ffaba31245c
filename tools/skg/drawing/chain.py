"""Chaining: the contours that edges make, whose ends lie within a tolerance of each other."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import replace
from math import pi, tan

from skg.drawing.contour import Contour, CurveNode, Edge
from skg.errors import UserError
from skg.plane import XY, distance, minus, turn


class _Corners:
    """Ends of edges, those within a tolerance of each other taken as one corner."""

    def __init__(self, tolerance: float) -> None:
        self.tolerance = tolerance
        self.cells: dict[tuple[int, int], list[int]] = defaultdict(list)
        self.points: list[XY] = []

    def index(self, point: XY) -> int:
        """The number of the corner at a point."""
        column, row = (int(ordinate // self.tolerance) for ordinate in point)
        for i in (column - 1, column, column + 1):
            for j in (row - 1, row, row + 1):
                for known in self.cells.get((i, j), ()):
                    if distance(self.points[known], point) <= self.tolerance:
                        return known
        self.points.append(point)
        self.cells[column, row].append(len(self.points) - 1)
        return len(self.points) - 1


def _moved(edge: Edge, start: XY, end: XY) -> Edge:
    """The edge with its ends moved to given points; an arc keeps its sweep, a curve its shape."""
    if edge.nodes:
        nodes = (CurveNode(start, edge.nodes[0].angle), *edge.nodes[1:-1], CurveNode(end, edge.nodes[-1].angle))
        return replace(edge, start=start, end=end, nodes=nodes)
    if edge.centre is None or edge.is_circle:
        return replace(edge, start=start, end=end)
    off = max(abs(distance(point, edge.centre) - edge.radius) for point in (start, end))
    if off < 1e-4:
        return replace(edge, start=start, end=end)
    half = minus(end, start)[0] / 2, minus(end, start)[1] / 2
    height = 1 / tan(edge.sweep / 2)
    centre = start[0] + half[0] - half[1] * height, start[1] + half[1] + half[0] * height
    return replace(edge, start=start, end=end, centre=centre)


def _same(one: Edge, other: Edge, tolerance: float) -> bool:
    """Whether an edge was drawn twice."""
    if len({edge.centre is None for edge in (one, other)} | {bool(edge.nodes) for edge in (one, other)}) > 2:
        return False
    ways = [other, other.reversed()]
    return any(all(distance(p, q) <= tolerance for p, q in (
        (one.start, way.start), (one.end, way.end), (one.at(0.5), way.at(0.5)))) for way in ways)


def without_doubles(edges: list[Edge], tolerance: float) -> list[Edge]:
    """Return the edges with those left out that were drawn twice."""
    kept: list[Edge] = []
    corners = _Corners(tolerance)
    seen: dict[frozenset[int], list[Edge]] = defaultdict(list)
    for edge in edges:
        ends = frozenset((corners.index(edge.start), corners.index(edge.end)))
        if not any(_same(edge, known, tolerance) for known in seen[ends]):
            seen[ends].append(edge)
            kept.append(edge)
    return kept


def chain(edges: list[Edge], tolerance: float) -> list[Contour]:
    """Return the contours that edges make; ends within `tolerance` (mm) of each other join.

    Where more than two edges meet: `UserError`. Neighbours on one line or circle are merged.
    """
    corners = _Corners(tolerance)
    joined: list[tuple[int, int, Edge]] = []
    at_corner: dict[int, list[int]] = defaultdict(list)
    contours: list[Contour] = []
    for edge in edges:
        first, last = corners.index(edge.start), corners.index(edge.end)
        if first == last and (edge.is_circle or edge.length > 3 * tolerance):
            contours.append(Contour((_moved(edge, edge.start, edge.start),), True))
        elif first != last:
            at_corner[first].append(len(joined))
            at_corner[last].append(len(joined))
            joined.append((first, last, _moved(edge, corners.points[first], corners.points[last])))
    for corner, meeting in at_corner.items():
        if len(meeting) > 2:
            x, y = corners.points[corner]
            raise UserError(f"{len(meeting)} edges meet at ({x:.3f}, {y:.3f}), expected two at a corner")
    used: set[int] = set()
    ends = [corner for corner, meeting in at_corner.items() if len(meeting) == 1]
    for corner in [*ends, *at_corner]:
        free = [at for at in at_corner[corner] if at not in used]
        if free:
            run = list(_follow(corner, free[0], joined, at_corner, used))
            contours.append(_merged(Contour(tuple(run), corner not in ends)))
    return contours


def _follow(corner: int, at: int, joined: list[tuple[int, int, Edge]], at_corner: dict[int, list[int]],
            used: set[int]) -> Iterator[Edge]:
    """Walk from a corner along an edge and on, until there is no unused edge."""
    while True:
        used.add(at)
        first, last, edge = joined[at]
        yield edge if first == corner else edge.reversed()
        corner = last if first == corner else first
        following = [other for other in at_corner[corner] if other not in used]
        if not following:
            return
        at = following[0]


def _merge(one: Edge, other: Edge) -> Edge | None:
    """Two neighbours as one edge, where they lie on one line or circle and run the same way, else None."""
    if one.is_line and other.is_line:
        if abs(turn(one.direction(), other.direction())) < 1e-7:
            return replace(one, end=other.end)
    elif one.centre is not None and other.centre is not None:
        sweep = one.sweep + other.sweep
        if (distance(one.centre, other.centre) < 1e-6 and abs(one.radius - other.radius) < 1e-6
                and one.sweep * other.sweep > 0 and abs(sweep) <= 2 * pi + 1e-6):
            is_full = distance(one.start, other.end) < 1e-6 and abs(sweep) > pi
            if is_full:
                return replace(one, end=one.start, sweep=2 * pi if sweep > 0 else -2 * pi)
            return replace(one, end=other.end, sweep=sweep)
    return None


def _merged(contour: Contour) -> Contour:
    """The contour with neighbours merged where they are the same line or circle."""
    edges = list(contour.edges)
    at = 0
    while at < len(edges) and len(edges) > 1:
        following = (at + 1) % len(edges)
        if following == 0 and not contour.is_closed:
            break
        both = _merge(edges[at], edges[following])
        if both is None:
            at += 1
            continue
        edges[at] = both
        del edges[following]
        at = min(at, len(edges) - 1)
    return replace(contour, edges=tuple(edges))
