"""Reading DXF drawings: their entities as edges, lengths in millimetres."""

from __future__ import annotations

import io
import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from itertools import pairwise
from math import atan2, cos, pi, sin

import ezdxf
from ezdxf import recover
from ezdxf.document import Drawing
from ezdxf.entities import DXFGraphic
from ezdxf.lldxf.const import DXFError
from ezdxf.math import Vec3

from skg.drawing.contour import Edge
from skg.drawing.curve import curve_edge
from skg.errors import UserError
from skg.plane import XY, cross, minus, turn


@dataclass
class Content:
    """What a drawing holds: edges, start points, and how many entities of other kinds were passed by."""

    edges: list[Edge] = field(default_factory=list)
    starts: list[XY] = field(default_factory=list)
    ignored: Counter[str] = field(default_factory=Counter)


class _Collector:
    """Turns entities into edges."""

    def __init__(self, factor: float, tolerance: float, layers: tuple[str, ...], start_layer: str) -> None:
        self.factor = factor
        self.tolerance = tolerance
        self.layers = tuple(layer.lower() for layer in layers)
        self.start_layer = start_layer.lower()
        self.content = Content()

    def point(self, vector: Vec3) -> XY:
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

        def curve(t: float) -> tuple[XY, float]:
            point = tuple(centre[k] + cos(t) * major[k] + sin(t) * minor[k] for k in (0, 1))
            way = tuple(-sin(t) * major[k] + cos(t) * minor[k] for k in (0, 1))
            return point, atan2(way[1], way[0])

        if abs(entity.dxf.ratio - 1) < 1e-9:
            sense = 1 if cross(major, minor) > 0 else -1
            end = first if last - first == 2 * pi else last
            self.add(Edge(curve(first)[0], curve(end)[0], centre, sense * (last - first)))
            return
        quarters = [k * pi / 2 for k in range(-16, 17) if first + 1e-3 < k * pi / 2 < last - 1e-3]
        edge = curve_edge(curve, [first, *quarters, last], self.tolerance)
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

            def curve(t: float, inner: dict[float, float] = inner) -> tuple[XY, float]:
                is_knee = low < t < high and t in inner
                return self.point(tool.point(t)), direction(inner[t] if is_knee else t)

            edge = curve_edge(curve, stations, self.tolerance)
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
