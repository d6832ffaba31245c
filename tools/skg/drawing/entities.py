"""The entities of a DXF drawing as edges, lengths in millimetres; each is accounted for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cache
from itertools import pairwise
from math import pi, radians

import ezdxf
import numpy as np
import shapely
from ezdxf.document import Drawing
from ezdxf.entities import DXFGraphic
from ezdxf.lldxf.const import DXFError
from ezdxf.math import OCS, BSpline, Matrix44, Vec3, bulge_to_arc

from skg.drawing import plain
from skg.drawing.account import Content, Entity, said
from skg.drawing.contour import Edge
from skg.drawing.dxf_file import DxfFile, Record
from skg.drawing.shapes import conic, is_number, spline_edges
from skg.drawing.wishes import Wishes
from skg.errors import UserError
from skg.plane import XY

#: Kinds that write on a drawing, or that fill what is drawn: nothing to cut.
NOTES = frozenset(
    """TEXT MTEXT ATTRIB ATTDEF DIMENSION ARC_DIMENSION LARGE_RADIAL_DIMENSION LEADER MULTILEADER MLEADER TOLERANCE
    HATCH MPOLYGON SOLID TRACE VIEWPORT IMAGE PDFUNDERLAY DWFUNDERLAY DGNUNDERLAY WIPEOUT OLEFRAME OLE2FRAME
    ACAD_TABLE RTEXT ARCALIGNEDTEXT POINT LIGHT CAMERA SECTION SUN GEODATA SHAPE RAY XLINE""".split()  # noqa: SIM905
)
#: Kinds that have no lines to cut, or none that are understood, and what a person can do.
_NO_LINES = {
    **dict.fromkeys(("3DFACE", "MESH"), "a face, not lines: draw its outline in the CAD program"),
    **dict.fromkeys(
        ("3DSOLID", "BODY", "SURFACE", "EXTRUDEDSURFACE", "LOFTEDSURFACE", "REVOLVEDSURFACE", "SWEPTSURFACE"),
        "a solid, not lines: draw its outline in the CAD program",
    ),
    "REGION": "an ACIS body, which is not read: explode it into lines in the CAD program",
    **dict.fromkeys(("ACAD_PROXY_ENTITY", "PROXY"), "not understood, explode it in the CAD program"),
}
#: Ends whose heights differ by more than this (mm) do not lie in one flat drawing.
_LEVEL = 1e-3
#: Angles are whole turns apart when they miss it by no more than this part of one; those that are the same angle but
#: for a float's rounding by no more than that: what is longer than nothing is drawn so (where two fillets meet).
_WHOLE, _NONE = 1e-8, 1e-13
#: Blocks within blocks within blocks.
_DEPTH = 32
#: More entities than this in all are no drawing, but blocks that hold copies of copies.
_MOST = 1_000_000
#: A vertex of a polyline that is not on it, but pulls at it.
_FRAME = 16
#: The codes of the angles that an arc begins and ends at, and a full turn.
_ANGLES = {"ARC": (50, 51, 360.0), "ELLIPSE": (41, 42, 2 * pi)}
#: What an entity that cannot be read may raise.
UNREADABLE = (DXFError, ArithmeticError, ValueError, TypeError, IndexError, KeyError, AttributeError, AssertionError)


class NotFlat(Exception):
    """An entity that is not understood, or leaves the drawing's plane; the message is the reason."""


class _Collector:
    """Turns records into edges. `matrix`: from where the present block's records stand to the drawing."""

    def __init__(self, file: DxfFile, wishes: Wishes, factor: float) -> None:
        self.file = file
        self.wishes = wishes
        self.factor = factor
        self.content = Content()
        self.matrix: Matrix44 | None = None
        self.known: dict[int, DXFGraphic] = {}
        self.wide: list[Entity] = []
        self.whole: list[int] = []
        self.thick: list[Entity] = []
        self.through: list[Entity] = []
        self.dashes_around = ""

    def collect(self, records: Iterable[Record], inherited: str, hidden: str, blocks: tuple[str, ...]) -> None:
        """Add records; those of a block on layer 0 lie on its reference's layer.

        `hidden`: why nothing of them is seen; `blocks`: the names of those around.
        """
        for record in records:
            layer = inherited if record.layer == "0" and inherited else record.layer
            if record.kind == "INSERT":
                self.insert(record, layer, hidden, blocks)
            else:
                self.one(record, layer, hidden)

    def unwanted(self, layer: str) -> str:
        """Why what is on a layer is left."""
        return self.wishes.unwanted(layer, self.file.states.get(layer.lower(), ""))

    def place(self, record: Record) -> XY:
        """A place on a record's entity, in the drawing's units."""
        at = record.place
        if not all(map(is_number, at)):
            return 0.0, 0.0
        if record.value(230).strip().startswith("-1"):
            at = -at[0], at[1]
        if self.matrix is not None:
            at = self.matrix.transform(Vec3(at)).xyz[:2]
        return at

    def dashes(self, record: Record, layer: str) -> str:
        """The line type of a record that is not drawn through, else nothing."""
        name = record.value(6).strip().upper()
        if name == "BYBLOCK":
            return self.dashes_around
        if name in ("", "BYLAYER"):
            return self.file.dashed_layers.get(layer.lower(), "")
        return name if name in self.file.dashed else ""

    def account(self, record: Record, layer: str) -> Entity:
        """Add an account of a record."""
        found = Entity(record.kind, layer, self.place(record))
        self.content.entities.append(found)
        if len(self.content.entities) > _MOST:
            raise UserError(f"more than {_MOST:,} entities, expected a drawing")
        return found

    def one(self, record: Record, layer: str, hidden: str) -> None:
        """Add what is no block reference."""
        account = self.account(record, layer)
        is_start = self.wishes.is_start(layer)
        account.left = hidden or self.unwanted(layer) or ("invisible" if record.whole(60) else "")
        if not account.left and _is_note(record.kind, is_start):
            account.left = "nothing to cut"
        if account.left:
            return
        known = len(self.content.edges)
        try:
            if is_start:
                self.content.starts.append(self.start(self.entity(record)))
                account.left = "a start hole"
                return
            for edge in self.edges_of(record):
                self.add(edge)
            if len(self.content.edges) > known:
                self.describe(record, account, self.content.edges[known].start)
            else:
                account.left = "it has no length"
            return
        except NotFlat as error:
            account.left = str(error)
        except UNREADABLE as error:
            account.left = _unread(error)
        account.is_odd = True
        del self.content.edges[known:]

    def describe(self, record: Record, account: Entity, start: XY) -> None:
        """Note what there is to say of a record that is cut from `start` on, mm."""
        account.place = start[0] / self.factor, start[1] / self.factor
        account.dashes = self.dashes(record, account.layer)
        if record.value(39).strip(" 0.+-eE"):
            self.thick.append(account)
        if _is_wide(record):
            self.wide.append(account)
        if _is_whole(record):
            self.whole.append(self.number)

    def entity(self, record: Record) -> DXFGraphic:
        """ezdxf's entity of a record, made once."""
        if self.matrix is None:
            return record.entity()
        if id(record) not in self.known:
            self.known[id(record)] = record.entity()
        return self.known[id(record)]

    def insert(self, record: Record, layer: str, hidden: str, blocks: tuple[str, ...]) -> None:
        """Add what a block reference shows, once for each place of its array."""
        name = record.value(2).strip()
        block = self.file.blocks.get(name.lower())
        reason = ""
        if block is None:
            reason = f"its block {name} is not in the file"
        elif block.is_external:
            reason = f"its block {name} is in another file"
        elif name.lower() in blocks or len(blocks) > _DEPTH:
            reason = f"its block {name} is part of itself"
        hidden = hidden or ("invisible" if record.whole(60) else "")
        if self.file.states.get(layer.lower()) == "frozen":
            hidden = hidden or self.unwanted(layer)
        outer = self.matrix, self.dashes_around
        try:
            matrices = [] if reason else [self.placed(single, block.base) for single in _singles(record.entity())]
        except UNREADABLE as error:
            reason = _unread(error)
        if reason:
            account = self.account(record, layer)
            account.left = hidden or self.unwanted(layer) or reason
            account.is_odd = account.left == reason
            return
        self.dashes_around = self.dashes(record, layer)
        for matrix in matrices:
            self.matrix = matrix
            self.collect(block.records, layer, hidden, (*blocks, name.lower()))
        self.matrix, self.dashes_around = outer
        self.collect((part for part in record.parts if part.kind == "ATTRIB"), layer, hidden, blocks)

    def placed(self, insert: DXFGraphic, base: tuple[float, float, float]) -> Matrix44:
        """From a block's content to the drawing, for one reference."""
        if Vec3(insert.dxf.extrusion).is_null:
            insert.dxf.extrusion = Vec3(0, 0, 1)
        matrix = Matrix44.translate(*(-ordinate for ordinate in base)) @ insert.matrix44()
        return matrix if self.matrix is None else matrix @ self.matrix

    def start(self, entity: DXFGraphic) -> XY:
        """A start hole: a POINT, or a CIRCLE around it."""
        if entity.dxftype() == "POINT":
            return self.point(entity.dxf.location)
        return self.point(entity.ocs().to_wcs(entity.dxf.center))

    def edges_of(self, record: Record) -> Iterable[Edge]:
        """One record's edges."""
        if record.kind in plain.POLYLINES and (line := plain.polyline(record)):
            points = [Vec3(x, y, line.height) for x, y, _ in line.vertices]
            return self.polyline(points, [bulge for _, _, bulge in line.vertices], line.is_closed)
        if record.kind in plain.KINDS and (given := plain.numbers(record)):
            if record.kind == "LINE":
                return [Edge(*self.points([Vec3(given[:3]), Vec3(given[3:])]), entity=self.number)]
            first, last = map(radians, given[4:] or (0.0, 360.0))
            sweep = _sweep(first, last) if record.kind == "ARC" else 2 * pi
            return self.arc(Vec3(given[:3]), given[3], first, sweep)
        if record.kind in _NO_LINES:
            raise NotFlat(_NO_LINES[record.kind])
        return self.edges(self.entity(record))

    def edges(self, entity: DXFGraphic) -> Iterable[Edge]:
        """One entity's edges."""
        match entity.dxftype():
            case "LINE":
                return [Edge(*self.points([entity.dxf.start, entity.dxf.end]))]
            case "CIRCLE":
                return self.arc(entity.dxf.center, entity.dxf.radius, 0.0, 2 * pi, _ocs(entity))
            case "ARC":
                first, last = (radians(angle) for angle in (entity.dxf.start_angle, entity.dxf.end_angle))
                return self.arc(entity.dxf.center, entity.dxf.radius, first, _sweep(first, last), _ocs(entity))
            case "ELLIPSE":
                first, last = entity.dxf.start_param, entity.dxf.end_param
                axes = entity.dxf.major_axis, entity.minor_axis
                return self.conic(entity.dxf.center, *axes, first, _sweep(first, last))
            case "LWPOLYLINE":
                points = [Vec3(x, y, entity.dxf.elevation) for x, y in entity.vertices()]
                bulges = [bulge for (bulge,) in entity.get_points("b")]
                return self.polyline(points, bulges, bool(entity.closed), _ocs(entity))
            case "POLYLINE" if entity.is_2d_polyline or entity.is_3d_polyline:
                vertices = [vertex for vertex in entity.vertices if not vertex.dxf.flags & _FRAME]
                points = [Vec3(vertex.dxf.location) for vertex in vertices]
                bulges = [vertex.dxf.bulge if entity.is_2d_polyline else 0.0 for vertex in vertices]
                if entity.is_2d_polyline:
                    height = Vec3(entity.dxf.elevation).z if entity.dxf.hasattr("elevation") else 0.0
                    points = [Vec3(point.x, point.y, height) for point in points]
                return self.polyline(points, bulges, entity.is_closed, _ocs(entity) if entity.is_2d_polyline else None)
            case "SPLINE" | "HELIX":
                return self.spline(entity)
            case "MLINE":
                return self.multiline(entity)
            case "POLYLINE":
                raise NotFlat("a mesh, expected a flat drawing")
            case _:
                raise NotFlat("not understood")

    def add(self, edge: Edge) -> None:
        """Keep an edge unless it has no length."""
        if edge.length > 0:
            self.content.edges.append(edge if edge.entity == self.number else replace(edge, entity=self.number))

    @property
    def number(self) -> int:
        """The number of the present entity."""
        return len(self.content.entities) - 1

    def in_drawing(self, points: Sequence[Vec3]) -> list[Vec3]:
        """Places of the present block on the drawing; those of different heights are refused."""
        found = [Vec3(point) for point in points]
        if self.matrix is not None:
            found = list(self.matrix.transform_vertices(found))
        heights = [point.z for point in found]
        if heights and (max(heights) - min(heights)) * self.factor > _LEVEL:
            raise NotFlat("leaves the drawing's plane, expected a flat drawing")
        return found

    def points(self, points: Sequence[Vec3]) -> list[XY]:
        """Places of the present block in mm."""
        found = [(point.x * self.factor, point.y * self.factor) for point in self.in_drawing(points)]
        if not all(is_number(ordinate) for place in found for ordinate in place):
            raise NotFlat("a place of it is no number")
        return found

    def point(self, point: Vec3) -> XY:
        """One place in mm."""
        return self.points([point])[0]

    def arc(self, centre: Vec3, radius: float, first: float, sweep: float, ocs: OCS | None = None) -> list[Edge]:
        """An arc or circle, which may stand in a coordinate system of its own."""
        radius = abs(radius)
        frame = [Vec3(centre), Vec3(radius, 0, 0), Vec3(0, radius, 0)]
        return self.conic(*(frame if ocs is None else ocs.points_to_wcs(frame)), first, sweep)

    def conic(self, centre: Vec3, u: Vec3, v: Vec3, first: float, sweep: float) -> list[Edge]:
        """centre + u cos t + v sin t from `first` on."""
        middle, one, other = self.points([Vec3(centre), Vec3(centre) + Vec3(u), Vec3(centre) + Vec3(v)])
        axes = [(end[0] - middle[0], end[1] - middle[1]) for end in (one, other)]
        return [conic(middle, *axes, first, sweep, self.wishes.fit_tolerance, self.number)]

    def polyline(
        self, points: list[Vec3], bulges: list[float], is_closed: bool, ocs: OCS | None = None
    ) -> Iterator[Edge]:
        """Lines and arcs through points; those of a flat polyline may stand in a coordinate system of its own."""
        if is_closed and points:
            points, bulges = [*points, points[0]], [*bulges, 0.0]
        in_drawing = self.points(list(ocs.points_to_wcs(points)) if ocs else points)
        for (p, q), (start, end), bulge in zip(pairwise(points), pairwise(in_drawing), bulges, strict=False):
            if not bulge or start == end:
                yield Edge(start, end, entity=self.number)
                continue
            centre, first, last, radius = bulge_to_arc(p, q, bulge)
            frame = [Vec3(centre.x, centre.y, p.z), Vec3(radius, 0, 0), Vec3(0, radius, 0)]
            sweep = (last - first) % (2 * pi)
            frame = list(ocs.points_to_wcs(frame)) if ocs else frame
            for edge in self.conic(*frame, first, sweep):
                turned = edge if bulge > 0 else edge.reversed()
                yield turned if turned.nodes else replace(turned, start=start, end=end)

    def spline(self, entity: DXFGraphic) -> Iterator[Edge]:
        """A spline; one that tells the places alone that it runs through is ezdxf's."""
        if not len(entity.control_points):
            places = [Vec3(place) for place in entity.fit_points]
            nearest = _LEVEL / self.factor
            entity.fit_points = [q for p, q in pairwise([None, *places]) if p is None or p.distance(q) > nearest]
            self.through.append(self.content.entities[-1])
        tool = entity.construction_tool()
        controls = [Vec3(x, y) for x, y in self.points(tool.control_points)]
        flat = BSpline(controls, tool.order, tool.knots(), tool.weights() or None)
        return spline_edges(flat, self.wishes.fit_tolerance)

    def multiline(self, entity: DXFGraphic) -> Iterator[Edge]:
        """The lines beside each other, and the caps that the style gives them at the ends."""
        name = entity.dxf.style_name
        style = self.file.multiline_styles.get(name.upper())
        if style is None:
            raise NotFlat(f"its style {name} is not in the file")
        # (ezdxf draws one that is in a document)
        entity.doc = _document()
        entity.dxf.style_handle = None
        known = entity.doc.mline_styles.get(name) or entity.doc.mline_styles.new(name)
        given = style.entity()
        known.dxf.flags, known.elements = given.dxf.flags, given.elements
        for part in entity.virtual_entities():
            if part.dxftype() in ("LINE", "ARC"):
                yield from self.edges(part)


@cache
def _document() -> Drawing:
    """A document for entities that ezdxf takes from no other place."""
    return ezdxf.new()


def _is_note(kind: str, is_start: bool) -> bool:
    """Whether there is nothing to cut in entities of a kind; on the layer of start holes: nothing that is one."""
    return kind not in ("POINT", "CIRCLE") if is_start else kind in NOTES


def _unread(error: Exception) -> str:
    """Why an entity is left that cannot be read."""
    return f"cannot be read ({' '.join(str(error).split()) or type(error).__name__})"


def _ocs(entity: DXFGraphic) -> OCS | None:
    """The coordinate system that an entity stands in, if it has one of its own."""
    return None if Vec3(entity.dxf.extrusion).is_null else entity.ocs()


def _is_whole(record: Record) -> bool:
    """Whether an arc that is read as a full turn ends at the angle that it begins at, not a turn further on."""
    if record.kind not in _ANGLES:
        return False
    *codes, turn = _ANGLES[record.kind]
    first, last = (float(record.value(code, "nan")) for code in codes)
    return last - first < turn / 2 and _is_full((last - first) / turn)


def _circles(content: Content, whole: list[int], tolerance: float) -> list[int]:
    """Those of some arcs, by their numbers, that are circles: each ends at the angle that it begins at. One that lies
    between the ends of two other lines is what is left of a fillet, and has no length."""
    if not whole:
        return []
    some = set(whole)
    begins = {edge.entity: edge.start for edge in content.edges if edge.entity in some}
    places = np.array([end for edge in content.edges if edge.start != edge.end for end in (edge.start, edge.end)])
    tree = shapely.STRtree(shapely.points(places.reshape(-1, 2)))
    arcs = np.array(list(begins))
    at = shapely.points(np.array(list(begins.values())).reshape(-1, 2))
    near = tree.query(at, predicate="dwithin", distance=tolerance)[0]
    gone = set(arcs[np.bincount(near, minlength=len(arcs)) >= 2].tolist())
    for at in gone:
        content.entities[at].left = "it ends where it begins, between two other lines"
    content.edges = [edge for edge in content.edges if edge.entity not in gone]
    return [at for at in whole if at not in gone]


def _is_wide(record: Record) -> bool:
    """Whether a polyline is drawn with a width."""
    widths = [value for one in (record, *record.parts) for code, value in one.groups if code in (40, 41, 43)]
    return record.kind in ("POLYLINE", "LWPOLYLINE") and any(width.strip(" 0.+-eE") for width in widths)


def _sweep(first: float, last: float) -> float:
    """From one angle on to the other, radians; whole turns, as files round them, are one."""
    return 2 * pi if _is_full((last - first) / (2 * pi)) else (last - first) % (2 * pi)


def _is_full(turns: float) -> bool:
    """Whether so many turns are whole ones that were rounded."""
    return abs(turns - round(turns)) < _WHOLE and not _NONE < turns < _WHOLE


def _singles(insert: DXFGraphic) -> Iterable[DXFGraphic]:
    """The references that one with rows and columns stands for."""
    if insert.mcount > _MOST:
        raise ValueError(f"{insert.mcount:,} times the block")
    return insert.multi_insert() if insert.mcount > 1 else (insert,)


def collect(file: DxfFile, wishes: Wishes, factor: float) -> Content:
    """Return the entities of a drawing, and the edges of those of its model space that are wanted, in mm.

    `factor`: mm per drawing unit. A layer that the drawing does not have is a `UserError`.
    """
    wishes.check_layers([*file.layers.values(), *(record.layer for record in file.model)])
    collector = _Collector(file, wishes, factor)
    collector.collect(file.model, "", "", ())
    collector.matrix = None
    if not collector.content.edges and file.paper:
        # (some programs write all that they have there)
        collector.collect(file.paper, "", "", ())
        if collector.content.edges:
            file.notes.append("there is nothing to cut in the model space: the paper space was read")
    else:
        for record in file.paper:
            collector.account(record, record.layer).left = "in paper space"
    file.notes += said(collector.wide, ("polyline", "polylines"), "drawn with a width", "the middle is cut")
    whole = [collector.content.entities[at] for at in _circles(collector.content, collector.whole, wishes.tolerance)]
    file.notes += said(whole, ("arc", "arcs"), "from an angle to the same angle", "a full turn is cut")
    file.notes += said(
        collector.through, ("spline", "splines"), "through points alone", "between them the curve is guessed"
    )
    file.notes += said(collector.thick, ("entity", "entities"), "with a thickness", "what it stands on is cut")
    return collector.content
