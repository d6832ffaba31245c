"""A tape as a DXF drawing, in millimetres."""

from __future__ import annotations

from math import degrees, pi, tan

import ezdxf
from ezdxf.document import Drawing
from ezdxf.layouts import Modelspace

from skg.plane import XY
from skg.tape.placed import CUT, WAY_IN, Placed, PlacedRoute

#: Layer -> AutoCAD colour index. LEAD: from the start hole to the contour and back; MOVES: positioning.
LAYERS = {"WIRE": 5, "LEAD": 3, "MOVES": 8, "START": 1, "STOPS": 6}

#: Lengths (µm) and angles (radians) below this are nothing but rounding of floats.
_NONE = 1e-6


def _millimetres(point: XY) -> XY:
    return point[0] / 1000, point[1] / 1000


def _shape(placed: Placed) -> str:
    """What a block is on the drawing: LINE, ARC or CIRCLE.

    An arc of a few µm whose joints turned its sweep round is a line; one that they took past a full turn, a circle.
    """
    if placed.is_line:
        return "LINE"
    sweep = placed.sweep * placed.block.sense
    if placed.block.is_full_circle or sweep >= 2 * pi - _NONE:
        return "CIRCLE"
    return "ARC" if sweep > _NONE else "LINE"


def _add(space: Modelspace, placed: Placed, layer: str) -> None:
    """Add one block."""
    attributes = {"layer": layer}
    shape = _shape(placed)
    if shape == "LINE":
        space.add_line(_millimetres(placed.start), _millimetres(placed.end), attributes)
        return
    centre, radius = _millimetres(placed.centre), placed.radius / 1000
    if shape == "CIRCLE":
        space.add_circle(centre, radius, attributes)
    else:
        # A DXF arc always runs counter-clockwise.
        low, high = sorted(placed.angles)
        space.add_arc(centre, radius, degrees(low), degrees(high), dxfattribs=attributes)


def _add_polyline(space: Modelspace, blocks: tuple[Placed, ...]) -> None:
    """Add blocks as one LWPOLYLINE, arcs as bulges; a full circle is two halves."""
    points: list[tuple[float, float, float]] = []
    for placed in blocks:
        shape = _shape(placed)
        parts = (0.0, 0.5) if shape == "CIRCLE" else (0.0,)
        sweep = 0.0 if shape == "LINE" else placed.sweep
        for part in parts:
            points.append((*_millimetres(placed.at(part) if part else placed.start),
                           tan(sweep / 4 / len(parts))))
    end = blocks[-1].end
    closed = max(abs(p - q) for p, q in zip(end, blocks[0].start, strict=True)) < _NONE
    if not closed:
        points.append((*_millimetres(end), 0.0))
    space.add_lwpolyline(points, format="xyb", close=closed, dxfattribs={"layer": "WIRE"})


def draw(routes: list[PlacedRoute], stops: list[XY], polylines: bool = False) -> Drawing:
    """Return the drawing of a tape that was laid out; `stops` are places in µm."""
    drawing = ezdxf.new("R2010", units=ezdxf.units.MM)
    for name, colour in LAYERS.items():
        drawing.layers.add(name, color=colour)
    drawing.header["$PDMODE"], drawing.header["$PDSIZE"] = 34, 1.0
    space = drawing.modelspace()
    for route in routes:
        if route.is_move:
            _add(space, route.blocks[0], "MOVES")
            continue
        space.add_point(_millimetres(route.start), {"layer": "START"})
        for part, blocks in route.parts():
            if part == WAY_IN:
                # (the way back lies on it)
                _add(space, blocks[0], "LEAD")
            elif part == CUT and polylines:
                _add_polyline(space, blocks)
            elif part == CUT:
                for placed in blocks:
                    _add(space, placed, "WIRE")
    for stop in stops:
        space.add_point(_millimetres(stop), {"layer": "STOPS"})
    return drawing
