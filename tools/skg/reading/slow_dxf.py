"""Entities of a DXF drawing as ezdxf understands them: those that are not written as nearly all are.

ezdxf takes longer to load than 20,000 plain circles to read: who needs this module imports it there.
"""

from __future__ import annotations

import logging
import struct
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import cache
from itertools import pairwise
from math import pi, radians
from typing import Any

import ezdxf
from ezdxf.document import Drawing
from ezdxf.entities import factory
from ezdxf.lldxf.const import DXFError
from ezdxf.lldxf.extendedtags import ExtendedTags
from ezdxf.lldxf.tagger import binary_tags_loader, tag_compiler
from ezdxf.lldxf.tags import Tags
from ezdxf.lldxf.types import DXFTag
from ezdxf.math import OCS, BSpline, Matrix44, Vec3
from ezdxf.tools.codepage import toencoding

from skg.errors import of_library
from skg.geometry.contour import Edge
from skg.messages.finding import Phrase
from skg.reading.budget import check_entities, check_vertices
from skg.reading.curves import spline_edges
from skg.reading.dxf_placing import LEVEL, NotFlat, Placing, swept
from skg.reading.dxf_record import Group, Record
from skg.reading.unread import Unread

__all__ = ["binary_groups", "edges", "encoding", "entity", "is_through_places", "placed", "start", "view"]

# ezdxf's own messages are dropped: this module reports in one line.
logging.getLogger("ezdxf").addHandler(logging.NullHandler())
logging.getLogger("ezdxf").propagate = False

#: A vertex of a polyline that is not on it, but pulls at it.
_FRAME = 16
#: The subclasses by whose place ezdxf reads a kind: files have none of them, one or another.
_SUBCLASSES = {
    "LWPOLYLINE": ("AcDbEntity", "AcDbPolyline"),
    "SPLINE": ("AcDbEntity", "AcDbSpline"),
    "HELIX": ("AcDbEntity", "AcDbSpline"),
    "MLINE": ("AcDbEntity", "AcDbMline"),
    "MLINESTYLE": ("AcDbMlineStyle",),
}
#: The codes of x, y and z of an entity's extrusion, and of the places (an ELLIPSE's axis) that a kind has once.
_EXTRUSION = (210, 220, 230)
_PLACES = {
    **dict.fromkeys(("CIRCLE", "ARC", "INSERT", "POINT", "VERTEX"), ((10, 20, 30),)),
    **dict.fromkeys(("LINE", "ELLIPSE"), ((10, 20, 30), (11, 21, 31))),
}
#: The third, of a helix: its codes mean other things than those of the second.
_THIRD = "AcDbHelix"


@contextmanager
def _as_unread() -> Iterator[None]:
    """ezdxf's own errors as an `Unread`: who asks knows of no ezdxf."""
    try:
        yield
    except DXFError as error:
        raise Unread(of_library(error)) from None


def binary_groups(data: bytes) -> Iterator[Group]:
    """The groups of a binary file, as text; `ValueError` and `IndexError`."""
    try:
        with _as_unread():
            for tag in binary_tags_loader(data):
                value = tag.value
                yield tag.code, value.hex() if isinstance(value, bytes) else str(value)
    except struct.error:
        raise Unread(Phrase("unread-cut-off")) from None


def encoding(page: str) -> str:
    """Return Python's name of a DXF code page."""
    return toencoding(page)


def entity(record: Record) -> Any:  # noqa: ANN401 (ezdxf has a class for each kind)
    """Return ezdxf's entity of a record, without a document; `ValueError` and whatever else ezdxf raises."""
    with _as_unread():
        return _entity(record)


def _entity(record: Record) -> Any:  # noqa: ANN401
    graphic: Any = factory.load(ExtendedTags(Tags(_tags(record.groups))))
    for part in record.parts:
        if part.kind != "SEQEND":
            graphic.link_entity(_entity(part))
    # (only now does ezdxf see whether a polyline is a mesh)
    return graphic.cast() if record.parts and hasattr(graphic, "cast") else graphic


def around(record: Record, off: float) -> Iterator[list[Vec3]]:
    """The closed lines around what a hatch fills, as places whose chords leave them by no more; raises as `entity`
    does."""
    from ezdxf.path import from_hatch  # (slow to import)

    with _as_unread():
        for path in from_hatch(_entity(record)):
            check_vertices(len(path), record.kind)
            yield list(path.flattening(off, segments=4))


def placed(record: Record, base: tuple[float, float, float], outer: Matrix44 | None) -> list[Matrix44]:
    """From a block's content to the drawing, for each place of a reference's array. `base`: of the block; `outer`: from
    where the reference stands; raises as `entity` does."""
    with _as_unread():
        return [_matrix(single, base, outer) for single in _singles(_entity(record))]


def _singles(insert: Any) -> Iterable[Any]:  # noqa: ANN401
    """The references that one with rows and columns stands for."""
    check_entities(insert.mcount)
    return insert.multi_insert() if insert.mcount > 1 else (insert,)


def _matrix(insert: Any, base: tuple[float, float, float], outer: Matrix44 | None) -> Matrix44:  # noqa: ANN401
    if Vec3(insert.dxf.extrusion).is_null:
        insert.dxf.extrusion = Vec3(0, 0, 1)
    matrix = Matrix44.translate(*(-ordinate for ordinate in base)) @ insert.matrix44()
    return matrix if outer is None else matrix @ outer


def view(plane: str) -> Matrix44:
    """From places to where they are seen: two axes such as "xz", which become x and y."""
    axes = {"x": Vec3(1, 0, 0), "y": Vec3(0, 1, 0), "z": Vec3(0, 0, 1)}
    right, up = (axes[axis] for axis in plane)
    matrix = Matrix44.ucs(right, up, right.cross(up))
    matrix.transpose()
    return matrix


def start(entity: Any) -> Vec3:  # noqa: ANN401
    """The place of a start hole: a POINT, or a CIRCLE around it; raises as `entity` does."""
    with _as_unread():
        return entity.dxf.location if entity.dxftype() == "POINT" else entity.ocs().to_wcs(entity.dxf.center)


def is_through_places(entity: Any) -> bool:  # noqa: ANN401
    """Tell whether it is a spline that tells the places alone that it runs through."""
    return entity.dxftype() in ("SPLINE", "HELIX") and not len(entity.control_points)


def edges(entity: Any, placing: Placing, styles: dict[str, Record]) -> Iterator[Edge]:  # noqa: ANN401
    """One entity's edges, placed on the drawing; `styles`: of multilines. Raises as `entity` does, and `NotFlat`."""
    with _as_unread():
        yield from _edges(entity, placing, styles)


def _edges(entity: Any, placing: Placing, styles: dict[str, Record]) -> Iterable[Edge]:  # noqa: ANN401
    dxf = entity.dxf
    match entity.dxftype():
        case "LINE":
            start, end = placing.points([dxf.start, dxf.end])
            return [Edge(start, end)]
        case "CIRCLE":
            return placing.arc(dxf.center, dxf.radius, 0.0, 2 * pi, _ocs(entity))
        case "ARC":
            first, last = (radians(angle) for angle in (dxf.start_angle, dxf.end_angle))
            return placing.arc(dxf.center, dxf.radius, first, swept(first, last), _ocs(entity))
        case "ELLIPSE":
            first, last = dxf.start_param, dxf.end_param
            axes = Vec3(dxf.major_axis), Vec3(entity.minor_axis)
            return placing.conic(Vec3(dxf.center), *axes, first, swept(first, last))
        case "LWPOLYLINE":
            points = [Vec3(x, y, dxf.elevation) for x, y in entity.vertices()]
            bulges = [bulge for (bulge,) in entity.get_points("b")]
            return placing.polyline(points, bulges, bool(entity.closed), _ocs(entity))
        case "POLYLINE" if entity.is_2d_polyline or entity.is_3d_polyline:
            vertices = [vertex for vertex in entity.vertices if not vertex.dxf.flags & _FRAME]
            points = [Vec3(vertex.dxf.location) for vertex in vertices]
            bulges = [vertex.dxf.bulge if entity.is_2d_polyline else 0.0 for vertex in vertices]
            if entity.is_2d_polyline:
                height = Vec3(dxf.elevation).z if dxf.hasattr("elevation") else 0.0
                points = [Vec3(point.x, point.y, height) for point in points]
            return placing.polyline(points, bulges, entity.is_closed, _ocs(entity) if entity.is_2d_polyline else None)
        case "SPLINE" | "HELIX":
            return _spline(entity, placing)
        case "MLINE":
            return _multiline(entity, placing, styles)
        case "POLYLINE":
            raise NotFlat(Phrase("reason-mesh"))
        case _:
            raise NotFlat(Phrase("reason-not-understood"))


def _spline(entity: Any, placing: Placing) -> Iterator[Edge]:  # noqa: ANN401
    """A spline; one through places alone is ezdxf's."""
    if is_through_places(entity):
        places = [Vec3(place) for place in entity.fit_points]
        nearest = LEVEL / placing.factor
        entity.fit_points = [q for p, q in pairwise([None, *places]) if p is None or p.distance(q) > nearest]
    tool = entity.construction_tool()
    controls = [Vec3(x, y) for x, y in placing.points(tool.control_points)]
    flat = BSpline(controls, tool.order, tool.knots(), tool.weights() or None)
    return spline_edges(flat, placing.tolerance)


def _multiline(entity: Any, placing: Placing, styles: dict[str, Record]) -> Iterator[Edge]:  # noqa: ANN401
    """The lines beside each other, and the caps that the style gives them at the ends."""
    name = entity.dxf.style_name
    style = styles.get(name.upper())
    if style is None:
        raise NotFlat(Phrase("reason-no-style", name=name))
    # (ezdxf draws one that is in a document)
    entity.doc = _document()
    entity.dxf.style_handle = None
    known = entity.doc.mline_styles.get(name) or entity.doc.mline_styles.new(name)
    given = _entity(style)
    known.dxf.flags, known.elements = given.dxf.flags, given.elements
    for part in entity.virtual_entities():
        if part.dxftype() in ("LINE", "ARC"):
            yield from _edges(part, placing, styles)


@cache
def _document() -> Drawing:
    """A document for entities that ezdxf takes from no other place."""
    return ezdxf.new()


def _ocs(entity: Any) -> OCS | None:  # noqa: ANN401
    """The coordinate system that an entity stands in, if it has one of its own."""
    return None if Vec3(entity.dxf.extrusion).is_null else entity.ocs()


def _tags(groups: list[Group]) -> list[DXFTag]:
    """An entity's groups as ezdxf's tags, without handles, application data and extended data."""
    kept: list[DXFTag] = []
    is_application, has_subclass = False, False
    for code, value in groups:
        if code == 102:
            is_application = value.strip().startswith("{")
        elif code >= 1000:
            break
        elif code == 100:
            has_subclass = True
            kept.append(DXFTag(100, value.strip()))
        elif not is_application and (code != 5 and code != 330 or has_subclass):
            kept.append(DXFTag(code, value))
    kind = kept[0].value.strip().upper()
    # (of before release 11, when a LINE had no height)
    kind = "LINE" if kind == "3DLINE" else kind
    kept[0] = DXFTag(0, kind)
    if kind in _SUBCLASSES:
        rest = [tag for tag in kept[1:] if tag.code != 100 or tag.value == _THIRD]
        kept = [kept[0], *(DXFTag(100, name) for name in _SUBCLASSES[kind]), *rest]
    for codes in (*_PLACES.get(kind, ()), _EXTRUSION):
        kept = _together(kept, codes)
    # (the tag behind the last one makes ezdxf let go of the place or the entity before it)
    tags = iter([*kept, DXFTag(0, "EOF")])
    *result, _ = tag_compiler(tags)
    return result


def _together(tags: list[DXFTag], codes: tuple[int, int, int]) -> list[DXFTag]:
    """The tags with x, y and z of a place or a way one after the other, as ezdxf takes them: else it reads 0 for what
    stands alone or in front. Half a place is a `ValueError`; a way of no length is left out."""
    given = {tag.code: tag.value for tag in reversed(tags) if tag.code in codes}
    if not given:
        return tags
    if codes == _EXTRUSION:
        whole = [DXFTag(code, given.get(code, "0.0")) for code in codes]
        if not any(tag.value.strip(" 0.+-eE") for tag in whole):
            whole = []
    elif codes[0] in given and codes[1] in given:
        whole = [DXFTag(code, given[code]) for code in codes if code in given]
    else:
        raise Unread(Phrase("unread-code", number=codes[1] if codes[0] in given else codes[0]))
    index = next(index for index, tag in enumerate(tags) if tag.code in codes)
    return tags[:index] + whole + [tag for tag in tags[index:] if tag.code not in codes]
