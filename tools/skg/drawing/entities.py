"""The entities of a DXF drawing as edges, lengths in millimetres; each is accounted for."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import replace
from itertools import pairwise
from math import atan2, cos, isfinite, pi, sin

from ezdxf import units as dxf_units
from ezdxf.document import Drawing
from ezdxf.entities import DXFGraphic
from ezdxf.lldxf.const import DXFError
from ezdxf.math import Vec3

from skg.drawing.account import Content, Entity
from skg.drawing.contour import Edge
from skg.drawing.curve import curve_edge
from skg.errors import UserError
from skg.plane import XY, cross, minus, turn

#: Kinds that write on a drawing, or that fill what is drawn: nothing to cut.
NOTES = frozenset(
    """TEXT MTEXT ATTRIB ATTDEF DIMENSION ARC_DIMENSION LARGE_RADIAL_DIMENSION LEADER MULTILEADER MLEADER TOLERANCE
    HATCH MPOLYGON VIEWPORT IMAGE PDFUNDERLAY DWFUNDERLAY DGNUNDERLAY WIPEOUT OLEFRAME OLE2FRAME ACAD_TABLE RTEXT
    ARCALIGNEDTEXT POINT LIGHT CAMERA SECTION SUN GEODATA SHAPE""".split()  # noqa: SIM905 (one a line is no table)
)
#: A direction this near to the z axis is that axis; edges shorter than this (mm) have no length.
_FLAT, _NONE = 1e-9, 1e-6
#: Ends whose heights differ by more than this (mm) do not lie in one flat drawing.
_LEVEL = 1e-3
#: Blocks within blocks within blocks.
_DEPTH = 32


class NotFlat(Exception):
    """An entity that leaves the drawing's plane."""


class _Collector:
    """Turns entities into edges."""

    def __init__(
        self,
        factor: float,
        tolerance: float,
        is_wanted: Callable[[str], str],
        start_layer: str,
    ) -> None:
        self.factor = factor
        self.tolerance = tolerance
        self.is_wanted = is_wanted
        self.start_layer = start_layer.lower()
        self.content = Content()

    def point(self, vector: Vec3) -> XY:
        """A place of the drawing in mm."""
        return vector.x * self.factor, vector.y * self.factor

    def collect(self, entities: Iterable[DXFGraphic], inherited: str = "", hidden: str = "", depth: int = 0) -> None:
        """Add all entities; those of a block on layer 0 lie on its reference's layer.

        `hidden`: why nothing of them is cut, for those of a block whose reference is not seen.
        """
        for entity in entities:
            layer = entity.dxf.layer
            if layer == "0" and inherited:
                layer = inherited
            if entity.dxftype() == "INSERT":
                self.insert(entity, layer, hidden, depth)
            else:
                self.one(entity, layer, hidden)

    def one(self, entity: DXFGraphic, layer: str, hidden: str) -> None:
        """Add an entity that is no block reference, and account for it."""
        kind = entity.dxftype()
        account = Entity(kind, layer, _place(entity))
        self.content.entities.append(account)
        account.left = hidden or self.is_wanted(layer) or ("invisible" if entity.dxf.get("invisible", 0) else "")
        if account.left:
            return
        if layer.lower() == self.start_layer and kind in ("POINT", "CIRCLE"):
            at = entity.dxf.location if kind == "POINT" else entity.ocs().to_wcs(entity.dxf.center)
            self.content.starts.append(self.point(at))
            account.left = "a start hole"
            return
        if layer.lower() == self.start_layer or kind in NOTES:
            account.left = "nothing to cut"
            return
        known = len(self.content.edges)
        try:
            self.entity(entity)
        except NotFlat as error:
            account.left = str(error)
        except (DXFError, ArithmeticError, ValueError, TypeError, IndexError, KeyError, AttributeError) as error:
            account.left = f"not understood ({str(error) or type(error).__name__})"
        if account.left:
            account.is_odd = True
            del self.content.edges[known:]
        elif len(self.content.edges) == known:
            account.left = "it has no length"

    def insert(self, entity: DXFGraphic, layer: str, hidden: str, depth: int) -> None:
        """Add what a block reference shows."""
        block = entity.block()
        if block is None or block.block.is_xref or depth > _DEPTH:
            account = Entity("INSERT", layer, _place(entity), is_odd=True)
            account.left = hidden or f"its block {entity.dxf.name} is " + (
                "not in the file" if depth <= _DEPTH else "part of itself"
            )
            self.content.entities.append(account)
            return
        if not hidden and entity.dxf.get("invisible", 0):
            hidden = "invisible"
        for single in entity.multi_insert() if entity.mcount > 1 else (entity,):
            self.collect(single.attribs, layer, hidden, depth + 1)
            self.collect(single.virtual_entities(), layer, hidden, depth + 1)

    def entity(self, entity: DXFGraphic) -> None:
        """Add one entity's edges."""
        kind = entity.dxftype()
        if entity.dxf.hasattr("extrusion"):
            direction = Vec3(entity.dxf.extrusion).normalize()
            if abs(direction.z) < 1 - _FLAT:
                raise NotFlat("lies in a tilted plane, expected a flat drawing")
        match kind:
            case "LINE":
                start, end = entity.dxf.start, entity.dxf.end
                self.level(start, end)
                self.add(Edge(self.point(start), self.point(end)))
            case "CIRCLE" | "ARC":
                self.arc(entity)
            case "LWPOLYLINE" | "POLYLINE":
                self.polyline(entity)
            case "ELLIPSE":
                self.ellipse(entity)
            case "SPLINE" | "HELIX":
                self.spline(entity)
            case _:
                raise NotFlat("not understood")

    def level(self, *points: Vec3) -> None:
        """Refuse places at different heights."""
        heights = [point.z for point in points]
        if (max(heights) - min(heights)) * self.factor > _LEVEL:
            raise NotFlat("leaves the drawing's plane, expected a flat drawing")

    def add(self, edge: Edge) -> None:
        """Keep an edge unless it has no length."""
        if not all(map(isfinite, (*edge.start, *edge.end, *(edge.centre or (0.0,)), edge.sweep))):
            raise ValueError("a number that is none")
        if edge.length > _NONE:
            self.content.edges.append(replace(edge, entity=len(self.content.entities) - 1))

    def polyline(self, entity: DXFGraphic) -> None:
        if entity.dxftype() == "POLYLINE" and not (entity.is_2d_polyline or entity.is_3d_polyline):
            raise NotFlat("a mesh, not understood")
        for part in entity.virtual_entities():
            self.entity(part)

    def arc(self, entity: DXFGraphic) -> None:
        ocs = entity.ocs()
        centre = self.point(ocs.to_wcs(entity.dxf.center))
        sense = 1 if Vec3(entity.dxf.extrusion).z > 0 else -1
        radius = abs(entity.dxf.radius)
        if entity.dxftype() == "CIRCLE":
            start = centre[0] + radius * self.factor, centre[1]
            self.add(Edge(start, start, centre, 2 * pi))
            return
        sweep = (entity.dxf.end_angle - entity.dxf.start_angle) % 360 or 360
        start, end = self.point(entity.start_point), self.point(entity.end_point)
        self.add(Edge(start, start if sweep == 360 else end, centre, sense * sweep * pi / 180))

    def ellipse(self, entity: DXFGraphic) -> None:
        self.level(Vec3(0, 0, 0), entity.dxf.major_axis)
        centre, major, minor = (
            self.point(Vec3(v)) for v in (entity.dxf.center, entity.dxf.major_axis, entity.minor_axis)
        )
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
        self.level(*tool.control_points)
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


def _place(entity: DXFGraphic) -> XY:
    """A place on an entity, in the drawing's units."""
    for name in ("start", "center", "insert", "location", "defpoint", "vtx0"):
        if entity.dxf.is_supported(name) and entity.dxf.hasattr(name):
            at = Vec3(entity.dxf.get(name))
            if name in ("center", "insert") and entity.dxf.hasattr("extrusion"):
                with suppress(DXFError, ArithmeticError):
                    at = entity.ocs().to_wcs(at)
            return at.x, at.y
    with suppress(DXFError, ArithmeticError, AttributeError, ValueError, TypeError, IndexError):
        match entity.dxftype():
            case "LWPOLYLINE":
                at = next(iter(entity.vertices_in_wcs()))
            case "POLYLINE":
                at = next(iter(entity.points_in_wcs()))
            case "SPLINE" | "HELIX":
                at = Vec3([*entity.control_points, *entity.fit_points][0])
            case _:
                return 0.0, 0.0
        return at.x, at.y
    return 0.0, 0.0


def unit_of(drawing: Drawing) -> tuple[str, float]:
    """The name of a drawing's units and mm in one; without units "" and 1."""
    if not drawing.units:
        return "", 1.0
    return dxf_units.unit_name(drawing.units).lower(), dxf_units.conversion_factor(drawing.units, dxf_units.MM)


def collect(
    drawing: Drawing,
    layers: tuple[str, ...] = (),
    start_layer: str = "START",
    fit_tolerance: float = 0.0002,
    factor: float | None = None,
) -> Content:
    """Return the entities of a drawing's model space, and the edges of those on the given layers, in mm.

    Without layers those of all layers but the frozen ones and those that are off. `factor`: mm per drawing unit,
    None: as `unit_of` has it. A layer that the drawing does not have is a `UserError`.
    """
    known = {layer.dxf.name.lower(): layer.dxf.name for layer in drawing.layers}
    for entity in drawing.modelspace():
        known.setdefault(entity.dxf.layer.lower(), entity.dxf.layer)
    for layer in layers:
        if layer.lower() not in known:
            raise UserError(f"no layer {layer}, the drawing has {', '.join(sorted(known.values()))}")
    asked_for = {layer.lower() for layer in layers}
    hidden = {layer.dxf.name.lower(): "off" for layer in drawing.layers if layer.is_off()}
    hidden |= {layer.dxf.name.lower(): "frozen" for layer in drawing.layers if layer.is_frozen()}

    def is_wanted(layer: str) -> str:
        if asked_for:
            is_asked = layer.lower() in asked_for or layer.lower() == start_layer.lower()
            return "" if is_asked else "not asked for"
        state = hidden.get(layer.lower())
        return f"the layer is {state}" if state else ""

    collector = _Collector(unit_of(drawing)[1] if factor is None else factor, fit_tolerance, is_wanted, start_layer)
    collector.collect(drawing.modelspace())
    return collector.content
