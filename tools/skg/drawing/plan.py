"""Planning: in which order and direction contours are cut, and from which start holes."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import cos, inf, pi, sin

from skg.drawing.contour import Contour, Edge
from skg.errors import UserError
from skg.plane import XY, cross, distance, minus, polar, turn

#: A start hole is this far from the contour where there is room, mm.
LEAD = 3.0


@dataclass(frozen=True)
class PlannedContour:
    """A contour with where it is entered: from `start` to the point at `part` of its first edge.

    `offset` is R: positive, the wire runs on the right of travel. `depth`: how many contours lie around it.
    """

    contour: Contour
    start: XY
    part: float
    offset: float
    depth: int

    @property
    def entry(self) -> XY:
        """Where the contour is entered (on its first edge, without the offset)."""
        return self.contour.edges[0].at(self.part)


def _oriented(contour: Contour, side: str, depth: int, offset: float, reverse: bool) -> tuple[Contour, float]:
    """Return the contour in the direction in which it is cut, and R."""
    if not contour.is_closed:
        sign = {"left": -1.0, "right": 1.0}.get(side, 0.0)
        return (contour.reversed(), -sign * offset) if reverse else (contour, sign * offset)
    # With the wire on the right of travel an outline is cut counter-clockwise and an opening clockwise.
    is_opening = depth % 2 == 1
    if side in ("inside", "outside"):
        is_opening = side == "inside"
    sign = {"on": 0.0, "left": -1.0}.get(side, 1.0)
    if (contour.area < 0) != is_opening:
        contour = contour.reversed()
    if reverse:
        contour, sign = contour.reversed(), -sign
    return contour, sign * offset


def _turned_to(contour: Contour, at: int) -> Contour:
    """The closed contour, beginning with another of its edges."""
    return Contour(contour.edges[at:] + contour.edges[:at], True)


def _entry_near(contour: Contour, start: XY, offset: float) -> tuple[Contour, float]:
    """Begin a closed contour where it is nearest to the start hole, but well inside an edge."""
    best = (inf, 0, 0.0)
    for at, edge in enumerate(contour.edges):
        if edge.nodes:
            continue
        margin = min(0.4, (2 * abs(offset) + 0.05) / edge.length)
        part = edge.nearest(start)
        if not edge.is_circle:
            part = min(1 - margin, max(margin, part))
        # A full circle is entered by a straight radial move; elsewhere any place of the edge will do.
        best = min(best, (distance(edge.at(part), start), at, part))
    if best[0] == inf:
        return _entry_on_curve(contour)
    return _turned_to(contour, best[1]), best[2]


def _entry_on_curve(contour: Contour) -> tuple[Contour, float]:
    """Begin a contour of curves alone at a node inside its longest curve (a closed one at its seam)."""
    at = max(range(len(contour.edges)), key=lambda k: contour.edges[k].length)
    edge = contour.edges[at]
    is_smooth = len(contour.edges) == 1 and abs(turn(edge.nodes[0].angle, edge.nodes[-1].angle)) < 1e-3
    middle = len(edge.nodes) // 2
    if is_smooth or len(edge.nodes) < 3:
        return _turned_to(contour, at), 0.0
    point = edge.nodes[middle].point
    cut = min(range(len(edge.samples)), key=lambda k: distance(edge.samples[k], point))
    before = Edge(edge.start, point, nodes=edge.nodes[:middle + 1], samples=edge.samples[:cut + 1])
    after = Edge(point, edge.end, nodes=edge.nodes[middle:], samples=edge.samples[cut:])
    turned = _turned_to(contour, at).edges
    return Contour((after, *turned[1:], before), True), 0.0


def _entry(contour: Contour) -> tuple[Contour, float]:
    """Begin a closed contour in the middle of its longest line, else of its longest arc, else on a curve."""
    def rank(at: int) -> tuple[bool, float]:
        return contour.edges[at].is_line, contour.edges[at].length

    candidates = [at for at, edge in enumerate(contour.edges) if not edge.nodes]
    if not candidates:
        return _entry_on_curve(contour)
    at = max(candidates, key=rank)
    return _turned_to(contour, at), 0.0 if contour.edges[at].is_circle else 0.5


def _room(point: XY, angle: float, contours: list[Contour], least: float) -> float:
    """How far it is from a point in a direction to the next contour, mm; what is nearer than `least` is none."""
    way = cos(angle), sin(angle)
    nearest = inf
    for contour in contours:
        for p, q in pairwise(contour.points()):
            side = minus(q, p)
            area = cross(way, side)
            if abs(area) < 1e-12:
                continue
            to = minus(p, point)
            along, part = cross(to, side) / area, cross(to, way) / area
            if along > least and 0 <= part <= 1:
                nearest = min(nearest, along)
    return nearest


def _start_hole(contour: Contour, part: float, offset: float, is_opening: bool, lead: float,
                contours: list[Contour]) -> XY:
    """Choose a start hole square to the entry, on the wire's side: `lead` away, or in the middle of what room
    there is. An opening that is one circle is entered from its centre."""
    edge = contour.edges[0]
    entry = edge.at(part)
    is_ccw = contour.area > 0
    is_outside = is_ccw == (offset > 0) if offset else not is_opening
    if edge.is_circle and not is_outside:
        return edge.centre
    way = edge.direction(part)
    square = way - pi / 2 if is_outside == is_ccw else way + pi / 2
    # An arc's own chords lie up to 0.1 % of its radius inside of it.
    least = 1e-3 * (1 + edge.radius) if edge.centre is not None else 1e-3
    room = _room(entry, square, contours, least)
    return polar(entry, min(lead + abs(offset), room / 2), square)


def plan(contours: list[Contour], starts: list[XY], offset: float, side: str, reverse: bool = False,
         lead: float = LEAD) -> list[PlannedContour]:
    """Return the contours in the order in which they are cut: inner ones first, and then the nearest.

    Each start hole goes to the innermost contour around it that is cut from inside, else to the nearest one.
    """
    closed = [contour for contour in contours if contour.is_closed]
    depths = [sum(other is not one and other.holds(one.edges[0].start) for other in closed)
              for one in contours]
    ready = [_oriented(one, side, depth, offset, reverse)
             for one, depth in zip(contours, depths, strict=True)]
    given = _given_starts([contour for contour, _ in ready], depths, starts)
    routes = []
    for at, (contour, shift) in enumerate(ready):
        start = given.get(at)
        part = 0.0
        if not contour.is_closed:
            start = start or contour.edges[0].start
        elif start is None:
            contour, part = _entry(contour)
            start = _start_hole(contour, part, shift, depths[at] % 2 == 1, lead, contours)
        else:
            contour, part = _entry_near(contour, start, shift)
        routes.append(PlannedContour(contour, start, part, shift, depths[at]))
    ordered: list[PlannedContour] = []
    at_now = 0.0, 0.0
    while routes:
        nearest = min(routes, key=lambda route: (-route.depth, distance(route.start, at_now)))
        routes.remove(nearest)
        ordered.append(nearest)
        at_now = nearest.start
    return ordered


def _given_starts(contours: list[Contour], depths: list[int], starts: list[XY]) -> dict[int, XY]:
    """Which contour (by its number) each given start hole belongs to."""
    found: dict[int, XY] = {}
    for start in starts:
        around = [at for at, contour in enumerate(contours)
                  if at not in found and depths[at] % 2 and contour.is_closed and contour.holds(start)]
        free = [at for at in range(len(contours)) if at not in found]
        if not free:
            raise UserError(f"{len(starts)} start holes for {len(contours)} contours")
        if around:
            found[max(around, key=depths.__getitem__)] = start
        else:
            found[min(free, key=lambda at: min(distance(start, p) for p in contours[at].points()))] = start
    return found
