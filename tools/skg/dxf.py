"""`skg dxf`: a tape as a DXF drawing, in millimetres."""

from __future__ import annotations

import io
from math import degrees, hypot, tan

import click
import ezdxf
from ezdxf.document import Drawing
from ezdxf.layouts import Modelspace

from skg import source, tape
from skg.gcode import Pair
from skg.placed import Placed, PlacedRoute, place, positions_option, stop_places

#: Layer -> AutoCAD colour index. LEAD: from the start hole to the contour and back; MOVES: positioning.
LAYERS = {"WIRE": 5, "LEAD": 3, "MOVES": 8, "START": 1, "STOPS": 6}


def _millimetres(point: tuple[float, float]) -> tuple[float, float]:
    return point[0] / 1000, point[1] / 1000


def _add(space: Modelspace, placed: Placed, layer: str) -> None:
    """Add one block as a LINE, an ARC or a CIRCLE."""
    attributes = {"layer": layer}
    if placed.block.is_line:
        space.add_line(_millimetres(placed.start), _millimetres(placed.end), attributes)
        return
    centre, radius = _millimetres(placed.centre), hypot(placed.block.x, placed.block.y) / 1000
    if placed.block.is_full_circle:
        space.add_circle(centre, radius, attributes)
        return
    # A DXF arc always runs counter-clockwise.
    low, high = sorted(placed.angles)
    space.add_arc(centre, radius, degrees(low), degrees(high), dxfattribs=attributes)


def _add_polyline(space: Modelspace, blocks: tuple[Placed, ...]) -> None:
    """Add blocks as one LWPOLYLINE, arcs as bulges; a full circle is two halves."""
    points: list[tuple[float, float, float]] = []
    for placed in blocks:
        parts = (0.0, 0.5) if placed.block.is_full_circle else (0.0,)
        first, last = (0.0, 0.0) if placed.block.is_line else placed.angles
        for part in parts:
            points.append((*_millimetres(placed.at(part) if part else placed.start),
                           tan((last - first) / 4 / len(parts))))
    end = blocks[-1].end
    closed = end == blocks[0].start
    if not closed:
        points.append((*_millimetres(end), 0.0))
    space.add_lwpolyline(points, format="xyb", close=closed, dxfattribs={"layer": "WIRE"})


def draw(routes: list[PlacedRoute], stops: list[tuple[int, int]], polylines: bool = False) -> Drawing:
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
        cut = route.blocks
        if route.leads:
            cut = route.blocks[1:-1]
            _add(space, route.blocks[0], "LEAD")
        if polylines:
            _add_polyline(space, cut)
        else:
            for placed in cut:
                _add(space, placed, "WIRE")
    for stop in stops:
        space.add_point(_millimetres(stop), {"layer": "STOPS"})
    return drawing


@click.command(name="dxf")
@click.argument("file", type=click.Path(allow_dash=True))
@click.option("-o", "--output", default="-", show_default=True, type=click.Path(allow_dash=True),
              help="Drawing to write, - for the standard output.")
@click.option("--start", type=Pair(), help="Place of the start hole, mm. Default: FROM, else 0,0.")
@click.option("--polylines", is_flag=True, help="One LWPOLYLINE with bulges for each contour.")
@positions_option
@source.skg80_option
def command(file: str, output: str, start: tuple[float, float] | None, polylines: bool, positions: str,
            skg80: str | None) -> None:
    """Turn a tape (.3b) or a program (.skg) into a DXF drawing of the wire's path.

    Layers: WIRE what is cut, LEAD the way from the start hole to the contour, MOVES positioning, START and
    STOPS points. FILE - is a tape on the standard input.
    """
    made = source.load(file, skg80)
    x, y = start or made.start
    home = round(x * 1000), round(y * 1000)
    routes = place(made.tape, home, positions)
    text = io.StringIO()
    draw(routes, stop_places(made.tape, routes, home), polylines).write(text)
    tape.write_bytes(output, text.getvalue().encode())
