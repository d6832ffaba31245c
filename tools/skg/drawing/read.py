"""A DXF drawing as closed and open contours of lines, arcs and curves; lengths in millimetres."""

from __future__ import annotations

import io
import re
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from itertools import pairwise
from math import atan2, ceil, cos, degrees, hypot, pi, sin, sqrt, tan

import ezdxf
from ezdxf import recover
from ezdxf.document import Drawing
from ezdxf.entities import DXFGraphic
from ezdxf.lldxf.const import DXFError
from ezdxf.math import Vec3

from skg.errors import UserError

Point = tuple[float, float]
#: A curve's point and the direction angle of its tangent (radians) at a parameter.
Parametric = Callable[[float], tuple[Point, float]]


def minus(p: Point, q: Point) -> Point:
    """The vector from q to p."""
    return p[0] - q[0], p[1] - q[1]


def dot(p: Point, q: Point) -> float:
    """Scalar product."""
    return p[0] * q[0] + p[1] * q[1]


def cross(p: Point, q: Point) -> float:
    """z of the vector product: positive when q points to the left of p."""
    return p[0] * q[1] - p[1] * q[0]


def distance(p: Point, q: Point) -> float:
    """Distance of two points."""
    return hypot(p[0] - q[0], p[1] - q[1])


def polar(centre: Point, radius: float, angle: float) -> Point:
    """The point of a circle at an angle in radians."""
    return centre[0] + radius * cos(angle), centre[1] + radius * sin(angle)


def turn(one: float, other: float) -> float:
    """Angle from one direction to another, in (−π, π]."""
    angle = (other - one) % (2 * pi)
    return angle - 2 * pi if angle > pi else angle


@dataclass(frozen=True)
class Node:
    """A point of a curve and the direction angle of the tangent there, radians."""

    point: Point
    angle: float


@dataclass(frozen=True)
class Edge:
    """A line, an arc (with `centre` and a signed `sweep` in radians, ±2π for a circle) or a curve (`nodes`
    from start to end, `samples` close to each other on the true curve)."""

    start: Point
    end: Point
    centre: Point | None = None
    sweep: float = 0.0
    nodes: tuple[Node, ...] = ()
    samples: tuple[Point, ...] = field(default=(), repr=False)

    @property
    def is_line(self) -> bool:
        """Neither an arc nor a curve."""
        return self.centre is None and not self.nodes

    @property
    def is_circle(self) -> bool:
        """A full circle."""
        return self.centre is not None and abs(self.sweep) > 2 * pi - 1e-9

    @property
    def radius(self) -> float:
        """Radius of an arc, as its start has it."""
        return distance(self.start, self.centre)

    @property
    def length(self) -> float:
        """Length."""
        if self.centre is not None:
            return self.radius * abs(self.sweep)
        return sum(distance(p, q) for p, q in pairwise(self.points()))

    def reversed(self) -> Edge:
        """The same edge, run through backwards."""
        nodes = tuple(Node(node.point, node.angle + pi) for node in reversed(self.nodes))
        return Edge(self.end, self.start, self.centre, -self.sweep, nodes, self.samples[::-1])

    def at(self, part: float) -> Point:
        """The point at `part` (0…1) of a line's or an arc's length."""
        if self.centre is None:
            return (self.start[0] + part * (self.end[0] - self.start[0]),
                    self.start[1] + part * (self.end[1] - self.start[1]))
        first = atan2(*reversed(minus(self.start, self.centre)))
        return polar(self.centre, self.radius, first + part * self.sweep)

    def direction(self, at_end: bool = False, part: float | None = None) -> float:
        """Direction angle of travel at the start, the end, or at `part` of a line or arc, radians."""
        if self.nodes:
            return self.nodes[-1 if at_end else 0].angle
        if self.centre is None:
            return atan2(*reversed(minus(self.end, self.start)))
        where = part if part is not None else float(at_end)
        radial = minus(self.at(where), self.centre)
        return atan2(radial[1], radial[0]) + (pi / 2 if self.sweep > 0 else -pi / 2)

    def points(self) -> list[Point]:
        """Points along the edge, both ends included: a chord is never further than 0.1 % of a radius away."""
        if self.nodes:
            return list(self.samples)
        if self.centre is None:
            return [self.start, self.end]
        pieces = max(2, int(abs(self.sweep) / 0.08) + 1)
        return [self.start, *(self.at(k / pieces) for k in range(1, pieces)), self.end]

    def nearest(self, point: Point) -> float:
        """The part (0…1) of a line or an arc that lies nearest to a point."""
        if self.centre is None:
            way = minus(self.end, self.start)
            return min(1.0, max(0.0, dot(minus(point, self.start), way) / dot(way, way)))
        first = atan2(*reversed(minus(self.start, self.centre)))
        angle = atan2(*reversed(minus(point, self.centre)))
        ahead = (angle - first) % (2 * pi) if self.sweep > 0 else (first - angle) % (2 * pi)
        part = ahead / abs(self.sweep)
        if part <= 1:
            return part
        return 0.0 if distance(point, self.start) < distance(point, self.end) else 1.0


@dataclass(frozen=True)
class Contour:
    """Edges that follow each other; the last one's end is the first one's start when it is closed."""

    edges: tuple[Edge, ...]
    is_closed: bool

    def points(self) -> list[Point]:
        """Points along the contour, see `Edge.points`."""
        return [point for edge in self.edges for point in edge.points()[:-1]] + [self.edges[-1].end]

    @property
    def area(self) -> float:
        """Signed area: positive when a closed contour runs counter-clockwise."""
        return sum(cross(p, q) for p, q in pairwise(self.points())) / 2

    def reversed(self) -> Contour:
        """The same contour, run through backwards."""
        return Contour(tuple(edge.reversed() for edge in reversed(self.edges)), self.is_closed)

    def holds(self, point: Point) -> bool:
        """Whether a point lies inside the closed contour (counts crossings of a ray to the right)."""
        x, y = point
        inside = False
        for (x1, y1), (x2, y2) in pairwise(self.points()):
            if (y1 > y) != (y2 > y) and x < x1 + (y - y1) / (y2 - y1) * (x2 - x1):
                inside = not inside
        return inside


@dataclass
class Content:
    """What a drawing holds: edges, start points, and how many entities of other kinds were passed by."""

    edges: list[Edge] = field(default_factory=list)
    starts: list[Point] = field(default_factory=list)
    ignored: Counter[str] = field(default_factory=Counter)


#: FIT cuts an arc as a line that leaves its tangent by no more than this, or with this radius or more, mm.
_FLAT, _LARGE = 0.002, 50.0

# Curves ---------------------------------------------------------------------------------------------------

def biarc_joint(one: Node, other: Node) -> Point | None:
    """Where the biarc between two nodes changes arcs (language.md, section 5); None if there is none."""
    v = minus(other.point, one.point)
    t, u = ((cos(node.angle), sin(node.angle)) for node in (one, other))
    both = t[0] + u[0], t[1] + u[1]
    square = dot(v, v)
    below = dot(v, both) + sqrt(dot(v, both) ** 2 + 2 * (1 - dot(t, u)) * square)
    if below <= 1e-12 * sqrt(square):
        return None
    d = square / below
    return tuple((p + d * a + q - d * b) / 2
                 for p, a, q, b in zip(one.point, t, other.point, u, strict=True))


def _off_arc(point: Point, start: Point, angle: float, end: Point) -> float:
    """Distance of a point from the arc that leaves `start` in direction `angle` for `end`, as FIT cuts it: a flat
    or a very large one as the line of its chord (language.md, section 5)."""
    normal = -sin(angle), cos(angle)
    w = minus(end, start)
    height = dot(normal, w)
    square = dot(w, w)
    if abs(height) <= _FLAT or square >= 2 * _LARGE * abs(height):
        return abs(cross(w, minus(point, start))) / sqrt(square)
    radius = square / (2 * height)
    centre = start[0] + radius * normal[0], start[1] + radius * normal[1]
    return abs(distance(point, centre) - abs(radius))


def _fits(curve: Parametric, low: float, high: float, tolerance: float) -> bool:
    """Whether the biarc between two parameters stays within the tolerance of the curve."""
    one, other = (Node(*curve(t)) for t in (low, high))
    if distance(one.point, other.point) < 1e-6 or abs(turn(one.angle, other.angle)) > 1.2:
        return False
    joint = biarc_joint(one, other)
    if joint is None:
        return False
    chord = minus(other.point, one.point)
    middle = dot(minus(joint, one.point), chord)
    for k in range(1, 12):
        point = curve(low + k / 12 * (high - low))[0]
        if dot(minus(point, one.point), chord) < middle:
            off = _off_arc(point, one.point, one.angle, joint)
        else:
            # Seen from its end the second arc leaves along the reversed tangent.
            off = _off_arc(point, other.point, other.angle + pi, joint)
        if off > tolerance:
            return False
    return True


def curve_edges(curve: Parametric, breaks: list[float], tolerance: float) -> Edge:
    """Return a smooth curve as an edge whose nodes FIT takes to within `tolerance`, mm.

    `breaks` are parameters, the first and the last one included, between which halving begins.
    """
    found = [breaks[0]]

    def halve(low: float, high: float, depth: int) -> None:
        if depth < 14 and not _fits(curve, low, high, tolerance):
            middle = (low + high) / 2
            halve(low, middle, depth + 1)
            halve(middle, high, depth + 1)
        else:
            found.append(high)

    for low, high in pairwise(breaks):
        halve(low, high, 0)
    nodes = tuple(Node(*curve(t)) for t in found)
    samples: list[Point] = []
    for low, high in pairwise(found):
        # n chords of a span of length l that bends by θ are lθ/8n² away from it: 0.05 µm here.
        one, other = (Node(*curve(t)) for t in (low, high))
        bend = abs(turn(one.angle, other.angle)) + 0.01
        pieces = ceil(sqrt(distance(one.point, other.point) * bend / 8 / 5e-5)) + 3
        samples += [curve(low + k / pieces * (high - low))[0] for k in range(pieces)]
    return Edge(nodes[0].point, nodes[-1].point, nodes=nodes, samples=(*samples, nodes[-1].point))


# Reading --------------------------------------------------------------------------------------------------

class _Collector:
    """Turns entities into edges."""

    def __init__(self, factor: float, tolerance: float, layers: tuple[str, ...], start_layer: str) -> None:
        self.factor = factor
        self.tolerance = tolerance
        self.layers = tuple(layer.lower() for layer in layers)
        self.start_layer = start_layer.lower()
        self.content = Content()

    def point(self, vector: Vec3) -> Point:
        """A place of the drawing in mm."""
        return vector.x * self.factor, vector.y * self.factor

    def collect(self, entities: Iterable[DXFGraphic], inherited: str = "") -> None:
        """Add all entities on the wanted layers; those of a block on layer 0 lie on its reference's layer."""
        for entity in entities:
            layer = entity.dxf.layer.lower()
            if layer == "0" and inherited:
                layer = inherited
            if entity.dxftype() == "INSERT":
                self.collect(entity.virtual_entities(), layer)
            elif layer == self.start_layer:
                self.start(entity)
            elif not self.layers or layer in self.layers:
                self.entity(entity)

    def start(self, entity: DXFGraphic) -> None:
        """A start hole: a POINT, or a CIRCLE around it."""
        if entity.dxftype() == "POINT":
            self.content.starts.append(self.point(entity.dxf.location))
        elif entity.dxftype() == "CIRCLE":
            self.content.starts.append(self.point(entity.ocs().to_wcs(entity.dxf.center)))
        else:
            self.content.ignored[entity.dxftype()] += 1

    def entity(self, entity: DXFGraphic) -> None:
        """Add one entity."""
        kind = entity.dxftype()
        if entity.dxf.hasattr("extrusion"):
            direction = Vec3(entity.dxf.extrusion).normalize()
            if abs(direction.z) < 1 - 1e-9:
                raise UserError(f"{kind} lies in a tilted plane, expected a flat drawing")
        match kind:
            case "LINE":
                self.add(Edge(self.point(entity.dxf.start), self.point(entity.dxf.end)))
            case "CIRCLE" | "ARC":
                self.arc(entity)
            case "LWPOLYLINE" | "POLYLINE":
                for part in entity.virtual_entities():
                    self.entity(part)
            case "ELLIPSE":
                self.ellipse(entity)
            case "SPLINE":
                self.spline(entity)
            case _:
                self.content.ignored[kind] += 1

    def add(self, edge: Edge) -> None:
        """Keep an edge unless it has no length."""
        if edge.length > 1e-6:
            self.content.edges.append(edge)

    def arc(self, entity: DXFGraphic) -> None:
        ocs = entity.ocs()
        centre = self.point(ocs.to_wcs(entity.dxf.center))
        sense = 1 if Vec3(entity.dxf.extrusion).z > 0 else -1
        if entity.dxftype() == "CIRCLE":
            start = centre[0] + entity.dxf.radius * self.factor, centre[1]
            self.add(Edge(start, start, centre, 2 * pi))
            return
        sweep = (entity.dxf.end_angle - entity.dxf.start_angle) % 360 or 360
        start, end = self.point(entity.start_point), self.point(entity.end_point)
        self.add(Edge(start, start if sweep == 360 else end, centre, sense * sweep * pi / 180))

    def ellipse(self, entity: DXFGraphic) -> None:
        centre, major, minor = (self.point(Vec3(v)) for v in (
            entity.dxf.center, entity.dxf.major_axis, entity.minor_axis))
        first = entity.dxf.start_param
        last = first + ((entity.dxf.end_param - first) % (2 * pi) or 2 * pi)
        if last - first > 2 * pi - 1e-9:
            last = first + 2 * pi

        def curve(t: float) -> tuple[Point, float]:
            point = tuple(centre[k] + cos(t) * major[k] + sin(t) * minor[k] for k in (0, 1))
            way = tuple(-sin(t) * major[k] + cos(t) * minor[k] for k in (0, 1))
            return point, atan2(way[1], way[0])

        if abs(entity.dxf.ratio - 1) < 1e-9:
            sense = 1 if cross(major, minor) > 0 else -1
            end = first if last - first == 2 * pi else last
            self.add(Edge(curve(first)[0], curve(end)[0], centre, sense * (last - first)))
            return
        quarters = [k * pi / 2 for k in range(-16, 17) if first + 1e-3 < k * pi / 2 < last - 1e-3]
        edge = curve_edges(curve, [first, *quarters, last], self.tolerance)
        self.add(replace(edge, end=edge.start) if last - first == 2 * pi else edge)

    def spline(self, entity: DXFGraphic) -> None:
        tool = entity.construction_tool()
        knots = list(tool.knots())
        low, high = knots[tool.degree], knots[len(tool.control_points)]
        aside = 1e-9 * (high - low)

        def direction(t: float) -> float:
            way = tool.derivative(t, 1)[1]
            if way.magnitude < 1e-12:
                before, after = max(low, t - 1e3 * aside), min(high, t + 1e3 * aside)
                way = tool.point(after) - tool.point(before)
            return atan2(way.y, way.x)

        # Between knots a spline is smooth; at a knot it may have a corner, where it is cut in two.
        pieces = [[low]]
        for knot in sorted({knot for knot in knots if low < knot < high}):
            pieces[-1].append(knot)
            if abs(turn(direction(knot - aside), direction(knot + aside))) > 1e-4:
                pieces.append([knot])
        pieces[-1].append(high)
        for stations in pieces:
            # At a corner the tangent is that of this piece, not of its neighbour.
            inner = {stations[0]: stations[0] + aside, stations[-1]: stations[-1] - aside}

            def curve(t: float, inner: dict[float, float] = inner) -> tuple[Point, float]:
                is_knee = low < t < high and t in inner
                return self.point(tool.point(t)), direction(inner[t] if is_knee else t)

            edge = curve_edges(curve, stations, self.tolerance)
            chords = (atan2(*reversed(minus(q, p))) for p, q in pairwise(edge.samples))
            is_straight = all(abs(turn(edge.nodes[0].angle, chord)) < 1e-9 for chord in chords)
            self.add(Edge(edge.start, edge.end) if is_straight else edge)


def load(data: bytes, name: str) -> Drawing:
    """Read a DXF file's bytes; a damaged one is mended as far as ezdxf can, else `UserError`."""
    if b"SECTION" not in data:
        raise UserError(f"{name}: not a DXF drawing, it has no SECTION")
    try:
        return recover.read(io.BytesIO(data))[0]
    except (DXFError, OSError, ValueError, KeyError, IndexError, AttributeError) as error:
        reason = re.sub(r"\s+", " ", str(error)) or type(error).__name__
        raise UserError(f"{name}: not a DXF drawing that can be read ({reason})") from None


def collect(drawing: Drawing, layers: tuple[str, ...] = (), start_layer: str = "START",
            fit_tolerance: float = 0.0002, factor: float | None = None) -> Content:
    """Return the edges of a drawing's model space on the given layers (all, when none are given), in mm.

    `factor` is mm per drawing unit; without it $INSUNITS tells it, and a drawing without units is in mm.
    A layer that the drawing does not have is a `UserError`.
    """
    known = {layer.dxf.name.lower() for layer in drawing.layers}
    known |= {entity.dxf.layer.lower() for entity in drawing.modelspace()}
    for layer in layers:
        if layer.lower() not in known:
            raise UserError(f"no layer {layer}, the drawing has {', '.join(sorted(known))}")
    if factor is None:
        units = drawing.units
        factor = ezdxf.units.conversion_factor(units, ezdxf.units.MM) if units else 1.0
    collector = _Collector(factor, fit_tolerance, layers, start_layer)
    collector.collect(drawing.modelspace())
    return collector.content


# Chaining -------------------------------------------------------------------------------------------------

class _Corners:
    """Ends of edges, those within a tolerance of each other taken as one corner."""

    def __init__(self, tolerance: float) -> None:
        self.tolerance = tolerance
        self.cells: dict[tuple[int, int], list[int]] = defaultdict(list)
        self.points: list[Point] = []

    def index(self, point: Point) -> int:
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


def _moved(edge: Edge, start: Point, end: Point) -> Edge:
    """The edge with its ends moved to given points; an arc keeps its sweep, a curve its shape."""
    if edge.nodes:
        nodes = (Node(start, edge.nodes[0].angle), *edge.nodes[1:-1], Node(end, edge.nodes[-1].angle))
        return replace(edge, start=start, end=end, nodes=nodes)
    if edge.centre is None or edge.is_circle:
        return replace(edge, start=start, end=end)
    off = max(abs(distance(point, edge.centre) - edge.radius) for point in (start, end))
    if off < 1e-4:
        return replace(edge, start=start, end=end)
    half = minus(end, start)[0] / 2, minus(end, start)[1] / 2
    height = 1 / tan(edge.sweep / 2)
    centre = start[0] + half[0] - half[1] * height, start[1] + half[1] + half[0] * height
    return Edge(start, end, centre, edge.sweep)


def _same(one: Edge, other: Edge, tolerance: float) -> bool:
    """Whether an edge was drawn twice."""
    if len({edge.centre is None for edge in (one, other)} | {bool(edge.nodes) for edge in (one, other)}) > 2:
        return False
    ways = [other, other.reversed()]
    return any(all(distance(p, q) <= tolerance for p, q in (
        (one.start, way.start), (one.end, way.end), (_middle(one), _middle(way)))) for way in ways)


def _middle(edge: Edge) -> Point:
    return edge.samples[len(edge.samples) // 2] if edge.nodes else edge.at(0.5)


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
            return Edge(one.start, other.end)
    elif one.centre is not None and other.centre is not None:
        sweep = one.sweep + other.sweep
        if (distance(one.centre, other.centre) < 1e-6 and abs(one.radius - other.radius) < 1e-6
                and one.sweep * other.sweep > 0 and abs(sweep) <= 2 * pi + 1e-6):
            is_full = distance(one.start, other.end) < 1e-6 and abs(sweep) > pi
            if is_full:
                return Edge(one.start, one.start, one.centre, 2 * pi if sweep > 0 else -2 * pi)
            return Edge(one.start, other.end, one.centre, sweep)
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
    return Contour(tuple(edges), contour.is_closed)


def tangent_length(one: float, other: float, radius: float) -> float:
    """How far from the corner of two directions (radians) a fillet of this radius touches them."""
    angle = abs(turn(one, other))
    return radius * tan(angle / 2)


def in_degrees(angle: float) -> float:
    """Radians as degrees in (−180, 180]."""
    return degrees(turn(0, angle))
