"""A tape as a DXF drawing, in millimetres."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from io import StringIO
from itertools import count
from math import degrees, pi, tan
from typing import TextIO

import ezdxf
from ezdxf.entities import LWPolyline, factory
from ezdxf.lldxf.tagwriter import TagWriter

from skg.geometry.plane import XY
from skg.tape.layout import CUT, WAY_IN, Placed, PlacedRoute

#: Layer -> AutoCAD colour index. LEAD: from the start hole to the contour and back; MOVES: positioning. Drilled holes
#: are on a layer of their own, which drawings without any do not have.
LAYERS = {"WIRE": 5, "LEAD": 3, "MOVES": 8, "START": 1, "STOPS": 6}
HOLES, HOLES_COLOUR = "HOLES", 4

#: Lengths (µm) and angles (radians) below this are nothing but rounding of floats.
_NONE = 1e-6


def _millimetres(point: XY) -> XY:
    return point[0] / 1000, point[1] / 1000


def _shape(placed: Placed) -> str:
    """Return a block's entity: LINE, ARC or CIRCLE.

    An arc of a few µm whose joints turned its sweep round is a line; one that they took past a full turn, a circle.
    """
    if placed.is_line:
        return "LINE"
    sweep = placed.sweep * placed.block.sense
    if placed.block.is_full_circle or sweep >= 2 * pi - _NONE:
        return "CIRCLE"
    return "ARC" if sweep > _NONE else "LINE"


@dataclass(frozen=True)
class _Entity:
    """An entity of the drawing, mm: its kind, its layer, its attributes as ezdxf names them; of an LWPOLYLINE the
    vertices x, y, bulge and whether it is closed."""

    kind: str
    layer: str
    attributes: dict[str, XY | float] = field(default_factory=dict)
    vertices: tuple[tuple[float, float, float], ...] = ()
    is_closed: bool = False


def _block(placed: Placed, layer: str) -> _Entity:
    """One block."""
    shape = _shape(placed)
    if shape == "LINE":
        return _Entity(shape, layer, {"start": _millimetres(placed.start), "end": _millimetres(placed.end)})
    assert placed.centre is not None
    round_about: dict[str, XY | float] = {"center": _millimetres(placed.centre), "radius": placed.radius / 1000}
    if shape == "CIRCLE":
        return _Entity(shape, layer, round_about)
    # A DXF arc always runs counter-clockwise.
    low, high = sorted(placed.angles)
    return _Entity(shape, layer, round_about | {"start_angle": degrees(low), "end_angle": degrees(high)})


def _polyline(blocks: Sequence[Placed]) -> _Entity:
    """Blocks as one LWPOLYLINE, arcs as bulges; a full circle is two halves."""
    points: list[tuple[float, float, float]] = []
    for placed in blocks:
        shape = _shape(placed)
        parts = (0.0, 0.5) if shape == "CIRCLE" else (0.0,)
        sweep = 0.0 if shape == "LINE" else placed.sweep
        for part in parts:
            points.append((*_millimetres(placed.at(part) if part else placed.start), tan(sweep / 4 / len(parts))))
    end = blocks[-1].end
    closed = max(abs(p - q) for p, q in zip(end, blocks[0].start, strict=True)) < _NONE
    if not closed:
        points.append((*_millimetres(end), 0.0))
    return _Entity("LWPOLYLINE", "WIRE", {}, tuple(points), closed)


def _entities(
    routes: list[PlacedRoute], stops: Sequence[XY], polylines: bool, holes: Sequence[XY]
) -> Iterator[_Entity]:
    """All entities of a tape that was laid out; `stops` and `holes` are places in µm."""
    for route in routes:
        if route.is_move:
            for placed in route.blocks:
                yield _block(placed, "MOVES")
            continue
        yield _Entity("POINT", "START", {"location": _millimetres(route.start)})
        for part, blocks in route.parts():
            if part == WAY_IN:
                # (the way back lies on it)
                yield _block(blocks[0], "LEAD")
            elif part == CUT and polylines:
                yield _polyline(blocks)
            elif part == CUT:
                for placed in blocks:
                    yield _block(placed, "WIRE")
    for layer, places in (("STOPS", stops), (HOLES, holes)):
        for place in places:
            yield _Entity("POINT", layer, {"location": _millimetres(place)})


def write(
    stream: TextIO,
    routes: list[PlacedRoute],
    stops: Sequence[XY],
    polylines: bool = False,
    holes: Sequence[XY] = (),
) -> None:
    """Write the drawing of a tape of any length that was laid out; `stops` and `holes`, drilled ones, are places in µm.

    ezdxf takes a kilobyte and a tenth of a millisecond for each entity. So it writes the drawing without its entities,
    and one of every kind and layer as the pattern of all others.
    """
    # (the same drawing is the same file: without the present time, and marks made up anew each time)
    ezdxf.options.write_fixed_meta_data_for_testing = True
    drawing, text = ezdxf.new("R2010", units=ezdxf.units.MM), StringIO()
    # (else ezdxf adds them in any order)
    for name in ("ACDBPLACEHOLDER", "LAYOUT"):
        drawing.classes.add_class(name)
    for name, colour in (LAYERS | {HOLES: HOLES_COLOUR} if holes else LAYERS).items():
        drawing.layers.add(name, color=colour)
    drawing.header["$PDMODE"], drawing.header["$PDSIZE"] = 34, 1.0
    owner, first = drawing.modelspace().layout_key, int(drawing.entitydb.next_handle(), 16)
    # Each block makes at most one entity besides the point where its route begins and the one where it stops.
    most = 2 * sum(len(route.blocks) for route in routes) + len(stops) + len(holes)
    drawing.entitydb.handles.reset(f"{first + most + 1:X}")
    drawing.write(text)
    before, head, after = text.getvalue().partition("  2\nENTITIES\n")
    stream.write(before + head)
    patterns: dict[tuple[str, str], str] = {}
    for handle, entity in enumerate(_entities(routes, stops, polylines, holes), first):
        if entity.kind == "LWPOLYLINE":
            polyline = LWPolyline.new(f"{handle:X}", owner, {"layer": entity.layer})
            polyline.set_points(entity.vertices, format="xyb")
            polyline.closed = entity.is_closed
            polyline.export_dxf(TagWriter(stream, dxfversion=drawing.dxfversion))
            continue
        key = entity.kind, entity.layer
        if key not in patterns:
            patterns[key] = _pattern(entity, owner, drawing.dxfversion)
        values: list[float] = []
        for value in entity.attributes.values():
            values += value if isinstance(value, tuple) else [value]
        stream.write(patterns[key] % (handle, *values))
    stream.write(after)


def _pattern(entity: _Entity, owner: str, version: str) -> str:
    """The text of an entity like this one, with places for its handle and its numbers."""
    numbers = count(1_000_001)
    marked = {
        name: (next(numbers), next(numbers)) if isinstance(value, tuple) else next(numbers)
        for name, value in entity.attributes.items()
    }
    text = StringIO()
    sample = factory.new(entity.kind, {"layer": entity.layer, "handle": "HANDLE", "owner": owner, **marked})
    sample.export_dxf(TagWriter(text, dxfversion=version))
    pattern = text.getvalue().replace("%", "%%").replace("HANDLE", "%X")
    for number in range(1_000_001, next(numbers)):
        pattern = re.sub(rf"{number}(\.0)?\n", "%r\n", pattern)
    return pattern
