"""The entities of a DXF drawing as edges, lengths in millimetres; each is accounted for."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import cache, partial
from itertools import pairwise
from math import cos, pi, radians, sin, sqrt
from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np
import shapely

from skg.geometry.contour import Edge
from skg.geometry.plane import XY
from skg.job.read_options import ReadOptions
from skg.messages.finding import Finding, Phrase
from skg.reading import fast_dxf
from skg.reading.account import NOTE, Content, Entity, Written, by_layer
from skg.reading.budget import check_entities, check_vertices
from skg.reading.curves import is_number
from skg.reading.dxf_file import Definition, DxfFile
from skg.reading.dxf_placing import LEAVES, NotFlat, Placing, is_full, swept
from skg.reading.dxf_record import Record, unescaped
from skg.reading.unread import reason_of

if TYPE_CHECKING:
    from ezdxf.entities import DXFGraphic
    from ezdxf.math import Matrix44

#: Kinds that write on a drawing, or that fill what is drawn: nothing to cut.
NOTES = frozenset(
    """TEXT MTEXT ATTRIB ATTDEF DIMENSION ARC_DIMENSION LARGE_RADIAL_DIMENSION LEADER MULTILEADER MLEADER TOLERANCE
    HATCH MPOLYGON SOLID TRACE VIEWPORT IMAGE PDFUNDERLAY DWFUNDERLAY DGNUNDERLAY WIPEOUT OLEFRAME OLE2FRAME
    ACAD_TABLE RTEXT ARCALIGNEDTEXT POINT LIGHT CAMERA SECTION SUN GEODATA SHAPE RAY XLINE""".split()  # noqa: SIM905
)
#: Those of them that are a text at a place.
_TEXTS = frozenset(("TEXT", "MTEXT", "ATTRIB"))
#: Kinds that have no lines to cut, or none that are understood, and what a person can do.
_NO_LINES = {
    **dict.fromkeys(("3DFACE", "MESH"), Phrase("reason-face")),
    **dict.fromkeys(
        ("3DSOLID", "BODY", "SURFACE", "EXTRUDEDSURFACE", "LOFTEDSURFACE", "REVOLVEDSURFACE", "SWEPTSURFACE"),
        Phrase("reason-solid"),
    ),
    "REGION": Phrase("reason-acis"),
    **dict.fromkeys(("ACAD_PROXY_ENTITY", "PROXY"), Phrase("reason-proxy")),
}
#: Those of them that fill what is drawn, and that measure it: a block shows these.
_FILLS = frozenset(("HATCH", "MPOLYGON"))
_DIMENSIONS = frozenset(("DIMENSION", "ARC_DIMENSION", "LARGE_RADIAL_DIMENSION"))
#: Chords around what is filled leave it by no more, mm.
_COARSE = 0.05
#: Blocks within blocks within blocks.
_DEPTH = 32
#: The planes beside x and y that a whole drawing may stand in, with what is seen there to the right and upwards.
_STANDING = ("xz", "yz")
#: The codes of the angles that an arc begins and ends at, and a full turn.
_ANGLES = {"ARC": (50, 51, 360.0), "ELLIPSE": (41, 42, 2 * pi)}
#: Exceptions of an entity that cannot be read.
UNREADABLE = (ArithmeticError, ValueError, TypeError, IndexError, KeyError, AttributeError, AssertionError)


class _Collector:
    """Turns records into edges. `placing` knows where the present block's records stand on the drawing; `view`: from
    the file's places to the drawing's, None where these are the same."""

    def __init__(self, file: DxfFile, options: ReadOptions, factor: float, view: Matrix44 | None = None) -> None:
        self.file = file
        self.options = options
        self.placing = Placing(factor, options.fit_tolerance)
        self.placing.matrix = view
        self.content = Content()
        self.known: dict[int, DXFGraphic] = {}
        self.wide: list[Entity] = []
        self.whole: list[int] = []
        self.thick: list[Entity] = []
        self.through: list[Entity] = []
        self.dashes_around = ""

    def collect(
        self, records: Iterable[Record], inherited: str, hidden: Phrase | None, blocks: tuple[str, ...]
    ) -> None:
        """Add records; those of a block on layer 0 lie on its reference's layer.

        `hidden`: why nothing of them is seen; `blocks`: the names of those around.
        """
        for record in records:
            layer = inherited if record.layer == "0" and inherited else record.layer
            if record.kind == "INSERT":
                self.insert(record, layer, hidden, blocks)
            else:
                self.one(record, layer, hidden)

    def unwanted(self, layer: str) -> Phrase | None:
        """Return the reason why a layer's content is not cut."""
        return self.options.unwanted(layer, self.file.states.get(layer.lower(), ""))

    def leaves(self) -> bool:
        """Tell whether an entity leaves the drawing's plane."""
        return any(entity.reason == LEAVES for entity in self.content.entities)

    def place(self, record: Record) -> XY:
        """A place on a record's entity, mm."""
        place = record.place
        if not all(map(is_number, place)):
            return 0.0, 0.0
        if record.value(230).strip().startswith("-1"):
            place = -place[0], place[1]
        if self.placing.matrix is not None:
            place = self.placing.matrix.transform(place).xyz[:2]
        return place[0] * self.placing.factor, place[1] * self.placing.factor

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
        result = Entity(record.kind, layer, self.place(record))
        self.placing.entity = len(self.content.entities)
        self.content.entities.append(result)
        return result

    def one(self, record: Record, layer: str, hidden: Phrase | None) -> None:
        """Add what is no block reference."""
        account = self.account(record, layer)
        is_start = self.options.is_start(layer)
        account.reason = hidden or self.unwanted(layer) or (Phrase("reason-invisible") if record.whole(60) else None)
        if not account.reason and _is_note(record.kind, is_start):
            account.reason = NOTE
            self.note(record)
        if self.options.is_by_layer(account.reason) and not is_start and not _is_note(record.kind, is_start):
            self.see(record, account)
        if account.reason:
            return
        known = len(self.content.edges)
        try:
            if is_start:
                self.content.starts.append(self.start(record))
                account.reason = Phrase("reason-start-hole")
                return
            for edge in self.edges_of(record):
                self.add(edge)
            if len(self.content.edges) > known:
                self.describe(record, account, self.content.edges[known].start)
            else:
                account.reason = Phrase("reason-no-length")
            return
        except NotFlat as error:
            account.reason = error.reason
        except UNREADABLE as error:
            account.reason = reason_of(error)
        account.is_odd = True
        del self.content.edges[known:]

    def note(self, record: Record) -> None:
        """Keep the texts and lines of what is nothing to cut."""
        if record.kind in _TEXTS:
            self.write(record)
        elif record.kind in _FILLS:
            self.content.noted.fills.append(partial(self.around, record, self.placing.matrix))
        elif record.kind in _DIMENSIONS and (block := self.file.blocks.get(record.value(2).strip().lower())):
            # (a block of its own shows it)
            for part in block.records:
                if part.kind in _TEXTS:
                    self.write(part)
                elif part.kind in fast_dxf.KINDS or part.kind in fast_dxf.POLYLINES:
                    with suppress(NotFlat, *UNREADABLE):
                        self.content.noted.edges += (edge for edge in self.edges_of(part) if edge.length > 0)

    def around(self, record: Record, matrix: Matrix44 | None) -> list[Edge]:
        """The edges around what a record fills; `matrix`: of the block that it stands in."""
        self.placing.matrix = matrix
        with suppress(NotFlat, *UNREADABLE):
            places = _slow_dxf().around(record, _COARSE / self.placing.factor)
            return [self.placing.line(start, end) for path in places for start, end in pairwise(path) if start != end]
        return []

    def write(self, record: Record) -> None:
        """Keep a text, for who looks at the drawing."""
        x, y, height, angle = record.real(10), record.real(20), record.real(40), record.real(50)
        text = "".join(value for code, value in record.groups if code in (1, 3))
        if not text or not all(map(is_number, (x, y, height))) or height <= 0:
            return
        angle = radians(angle) if is_number(angle) else 0.0
        foot, head = (x, y), (x - height * sin(angle), y + height * cos(angle))
        if self.placing.matrix is not None:
            foot, head = (self.placing.matrix.transform(place).xyz[:2] for place in (foot, head))
        factor = self.placing.factor
        up = (head[0] - foot[0]) * factor, (head[1] - foot[1]) * factor
        self.content.written.append(Written(unescaped(text), (foot[0] * factor, foot[1] * factor), up))

    def see(self, record: Record, account: Entity) -> None:
        """Keep the edges of a record whose layer is not cut: what is cut may lie in them."""
        known, through = len(self.content.others), len(self.through)
        try:
            self.content.others += map(self.numbered, (edge for edge in self.edges_of(record) if edge.length > 0))
            account.dashes = self.dashes(record, account.layer)
        except (NotFlat, *UNREADABLE):
            del self.content.others[known:]
        del self.through[through:]

    def describe(self, record: Record, account: Entity, start: XY) -> None:
        """Note what there is to say of a record that is cut from `start` on, mm."""
        account.place = start
        account.dashes = self.dashes(record, account.layer)
        if record.value(39).strip(" 0.+-eE"):
            self.thick.append(account)
        if _is_wide(record):
            self.wide.append(account)
        if _is_whole(record):
            self.whole.append(self.placing.entity)

    def entity(self, record: Record) -> DXFGraphic:
        """ezdxf's entity of a record, made once."""
        slow_dxf = _slow_dxf()
        if self.placing.matrix is None:
            return slow_dxf.entity(record)
        if id(record) not in self.known:
            self.known[id(record)] = slow_dxf.entity(record)
        return self.known[id(record)]

    def insert(self, record: Record, layer: str, hidden: Phrase | None, blocks: tuple[str, ...]) -> None:
        """Add what a block reference shows, once for each place of its array."""
        name = record.value(2).strip()
        block = self.file.blocks.get(name.lower())
        reason: Phrase | None = None
        if block is None:
            reason = Phrase("reason-no-block", name=name)
        elif block.is_external:
            reason = Phrase("reason-block-elsewhere", name=name)
        elif name.lower() in blocks:
            reason = Phrase("reason-block-itself", name=name)
        elif len(blocks) > _DEPTH:
            reason = Phrase("reason-block-deep", name=name, most=_DEPTH)
        elif lack := record.lack():
            reason = lack
        elif block.base is None:
            reason = Phrase("reason-no-base", name=name)
        hidden = hidden or (Phrase("reason-invisible") if record.whole(60) else None)
        if self.file.states.get(layer.lower()) == "frozen":
            hidden = hidden or self.unwanted(layer)
        outer = self.placing.matrix, self.dashes_around
        try:
            matrices = [] if reason or block is None else self.matrices(record, block)
        except UNREADABLE as error:
            reason = reason_of(error)
        if reason or block is None:
            account = self.account(record, layer)
            account.reason = hidden or self.unwanted(layer) or reason
            account.is_odd = account.reason == reason
            return
        self.dashes_around = self.dashes(record, layer)
        for matrix in matrices:
            self.placing.matrix = matrix
            self.collect(block.records, layer, hidden, (*blocks, name.lower()))
        self.placing.matrix, self.dashes_around = outer
        self.collect((part for part in record.parts if part.kind == "ATTRIB"), layer, hidden, blocks)

    def matrices(self, record: Record, block: Definition) -> list[Matrix44]:
        """From a block's content to the drawing, for each place of a reference's array."""
        return _slow_dxf().placed(record, block.base, self.placing.matrix)

    def start(self, record: Record) -> XY:
        """A start hole: a POINT, or a CIRCLE around it."""
        if lack := record.lack():
            raise NotFlat(lack)
        (place,) = self.placing.points([_slow_dxf().start(self.entity(record))])
        return place

    def edges_of(self, record: Record) -> Iterable[Edge]:
        """One record's edges."""
        placing = self.placing
        check_vertices(record.vertices, record.kind)
        if lack := record.lack():
            raise NotFlat(lack)
        if record.kind in fast_dxf.POLYLINES and (line := fast_dxf.polyline(record)):
            points: list[Sequence[float]] = [(x, y, line.height) for x, y, _ in line.vertices]
            return placing.polyline(points, [bulge for _, _, bulge in line.vertices], line.is_closed)
        if record.kind in fast_dxf.KINDS and (given := fast_dxf.numbers(record)):
            if record.kind == "LINE":
                return [placing.line(given[:3], given[3:])]
            if record.kind == "ELLIPSE":
                return _ellipse(placing, given)
            first, last = map(radians, given[4:] or (0.0, 360.0))
            sweep = swept(first, last) if record.kind == "ARC" else 2 * pi
            return placing.arc(given[:3], given[3], first, sweep)
        if record.kind in _NO_LINES:
            raise NotFlat(_NO_LINES[record.kind])
        slow_dxf, entity = _slow_dxf(), self.entity(record)
        if slow_dxf.is_through_places(entity):
            self.through.append(self.content.entities[-1])
        return slow_dxf.edges(entity, placing, self.file.multiline_styles)

    def add(self, edge: Edge) -> None:
        """Keep an edge unless it has no length."""
        if edge.length > 0:
            self.content.edges.append(self.numbered(edge))

    def numbered(self, edge: Edge) -> Edge:
        """An edge with the number of the present entity."""
        number = self.placing.entity
        return edge if edge.entity == number else replace(edge, entity=number)


@cache
def _slow_dxf() -> ModuleType:
    """`skg.reading.slow_dxf`: slow to import, and many drawings do not need it."""
    from skg.reading import slow_dxf

    return slow_dxf


def _ellipse(placing: Placing, given: list[float]) -> list[Edge]:
    """An ellipse of its centre, axis, ratio and parameters."""
    x, y, _ = given[3:6]
    length = sqrt(x * x + y * y)
    # (the other axis as ezdxf has it, to the last digit)
    stretch = length * given[6] / length
    return placing.conic(given[:3], given[3:6], (-y * stretch, x * stretch, 0.0), given[7], swept(*given[7:]))


def _is_note(kind: str, is_start: bool) -> bool:
    """Tell whether there is nothing to cut in entities of a kind; on the layer of start holes: nothing that is one."""
    return kind not in ("POINT", "CIRCLE") if is_start else kind in NOTES


def _shown(file: DxfFile) -> int:
    """Count the entities that a drawing shows, those of blocks as often as they are, and the references themselves."""
    known: dict[str, int] = {}

    def of(records: list[Record], around: tuple[str, ...]) -> int:
        return len(records) + sum(of_block(record, around) for record in records if record.kind == "INSERT")

    def of_block(record: Record, around: tuple[str, ...]) -> int:
        name = record.value(2).strip().lower()
        if name not in file.blocks or name in around or len(around) > _DEPTH:
            return 0
        if name not in known:
            known[name] = of(file.blocks[name].records, (*around, name))
        return max(1, record.whole(70)) * max(1, record.whole(71)) * known[name]

    return of(file.model, ()) + len(file.paper)


def _is_whole(record: Record) -> bool:
    """Tell whether an arc that is read as a full turn ends at the angle that it begins at, not a turn further on."""
    if record.kind not in _ANGLES:
        return False
    *codes, turn = _ANGLES[record.kind]
    first, last = (float(record.value(code, "nan")) for code in codes)
    return last - first < turn / 2 and is_full((last - first) / turn)


def _circles(content: Content, whole: list[int], tolerance: float) -> list[int]:
    """Arcs that are circles, by their numbers: each ends at the angle that it begins at. One that lies between the
    ends of two other lines is the rest of a fillet, and has no length."""
    if not whole:
        return []
    numbers = set(whole)
    begins = {edge.entity: edge.start for edge in content.edges if edge.entity in numbers}
    places = np.array([end for edge in content.edges if edge.start != edge.end for end in (edge.start, edge.end)])
    tree = shapely.STRtree(shapely.points(places.reshape(-1, 2)))
    arcs = np.array(list(begins))
    starts = shapely.points(np.array(list(begins.values())).reshape(-1, 2))
    near = tree.query(starts, predicate="dwithin", distance=tolerance)[0]
    gone = set(arcs[np.bincount(near, minlength=len(arcs)) >= 2].tolist())
    for number in gone:
        content.entities[number].reason = Phrase("reason-between-lines")
    content.edges = [edge for edge in content.edges if edge.entity not in gone]
    return [number for number in whole if number not in gone]


def _is_wide(record: Record) -> bool:
    """Tell whether a polyline is drawn with a width."""
    if record.kind not in ("POLYLINE", "LWPOLYLINE"):
        return False
    widths = (value for part in (record, *record.parts) for code, value in part.groups if code in (40, 41, 43))
    return any(width.strip(" 0.+-eE") for width in widths)


def _standing(flat: _Collector) -> _Collector | None:
    """The same drawing seen from the front or from the right, where all of it that is wanted stands upright."""
    if not flat.leaves():
        return None
    for plane in _STANDING:
        seen = _Collector(flat.file, flat.options, flat.placing.factor, _slow_dxf().view(plane))
        seen.collect(flat.file.model, "", None, ())
        if seen.content.edges and not seen.leaves():
            flat.file.notes.append(Finding("standing", first=plane[0], second=plane[1]))
            return seen
    return None


def collect(file: DxfFile, options: ReadOptions, factor: float) -> Content:
    """Return the entities of a drawing, and the edges of those of its model space that are wanted, in mm.

    `factor`: mm per drawing unit. A layer that the drawing does not have is a `UserError`.
    """
    options.check_layers([*file.layers.values(), *(record.layer for record in file.model)])
    check_entities(_shown(file))
    collector = _Collector(file, options, factor)
    collector.collect(file.model, "", None, ())
    collector = _standing(collector) or collector
    collector.placing.matrix = None
    if not collector.content.edges and file.paper:
        # (some programs write all that they have there)
        collector.collect(file.paper, "", None, ())
        if collector.content.edges:
            file.notes.append(Finding("paper-space"))
    else:
        for record in file.paper:
            collector.account(record, record.layer).reason = Phrase("reason-paper-space")
    file.notes += by_layer("seen-with-width", collector.wide)
    whole = [
        collector.content.entities[number] for number in _circles(collector.content, collector.whole, options.tolerance)
    ]
    file.notes += by_layer("seen-full-turn", whole)
    file.notes += by_layer("seen-through-points", collector.through)
    file.notes += by_layer("seen-thick", collector.thick)
    return collector.content
