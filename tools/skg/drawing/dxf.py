"""`skg dxf`: a tape as a DXF drawing, in millimetres."""

from __future__ import annotations

import io
from math import degrees, pi, tan

import click
import ezdxf
from ezdxf.document import Drawing
from ezdxf.layouts import Modelspace

from skg.drawing import source
from skg.tape import block as tape
from skg.tape.gcode import Pair
from skg.tape.joints import estimate, is_without_drift
from skg.tape.placed import Placed, PlacedRoute, place, positions_option, stop_places

#: Layer -> AutoCAD colour index. LEAD: from the start hole to the contour and back; MOVES: positioning.
LAYERS = {"WIRE": 5, "LEAD": 3, "MOVES": 8, "START": 1, "STOPS": 6}

#: Lengths (µm) and angles (radians) below this are nothing but rounding of floats.
_NONE = 1e-6


def _millimetres(point: tuple[float, float]) -> tuple[float, float]:
    return point[0] / 1000, point[1] / 1000


def _shape(placed: Placed) -> str:
    """What a block is on the drawing: LINE, ARC or CIRCLE.

    An arc of a few µm whose joints turned its sweep round is a line; one that they took past a full turn, a circle.
    """
    if placed.block.is_line:
        return "LINE"
    first, last = placed.angles
    sweep = (last - first) * placed.block.sense
    if placed.block.is_full_circle or sweep >= 2 * pi - _NONE:
        return "CIRCLE"
    return "ARC" if sweep > _NONE else "LINE"


def _add(space: Modelspace, placed: Placed, layer: str) -> None:
    """Add one block."""
    attributes = {"layer": layer}
    centre, radius = _millimetres(placed.centre), placed.radius / 1000
    match _shape(placed):
        case "LINE":
            space.add_line(_millimetres(placed.start), _millimetres(placed.end), attributes)
        case "CIRCLE":
            space.add_circle(centre, radius, attributes)
        case "ARC":
            # A DXF arc always runs counter-clockwise.
            low, high = sorted(placed.angles)
            space.add_arc(centre, radius, degrees(low), degrees(high), dxfattribs=attributes)


def _add_polyline(space: Modelspace, blocks: tuple[Placed, ...]) -> None:
    """Add blocks as one LWPOLYLINE, arcs as bulges; a full circle is two halves."""
    points: list[tuple[float, float, float]] = []
    for placed in blocks:
        shape = _shape(placed)
        parts = (0.0, 0.5) if shape == "CIRCLE" else (0.0,)
        first, last = (0.0, 0.0) if shape == "LINE" else placed.angles
        for part in parts:
            points.append((*_millimetres(placed.at(part) if part else placed.start),
                           tan((last - first) / 4 / len(parts))))
    end = blocks[-1].end
    closed = max(abs(p - q) for p, q in zip(end, blocks[0].start, strict=True)) < _NONE
    if not closed:
        points.append((*_millimetres(end), 0.0))
    space.add_lwpolyline(points, format="xyb", close=closed, dxfattribs={"layer": "WIRE"})


def draw(routes: list[PlacedRoute], stops: list[tuple[float, float]], polylines: bool = False) -> Drawing:
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


def lay_out(made: source.Made, start: tuple[float, float], positions: str, joints: str, is_program: bool,
            ) -> tuple[list[PlacedRoute], list[tuple[float, float]]]:
    """Return a tape's routes and stops in µm, its wire starting at `start` (mm); see `command` for the rest."""
    home = tape.micrometres(start[0]), tape.micrometres(start[1])
    if joints == "tape":
        routes = place(made.tape, home, positions)
    else:
        if positions == "auto":
            # A program was just run by the standard ROM or the reference as it is.
            positions = "machine" if not is_program and is_without_drift(made.tape) else "programmed"
        routes = estimate(made.tape, home, positions == "machine")
    return routes, stop_places(made.tape, routes, home)


@click.command(name="dxf")
@click.argument("file", type=click.Path(allow_dash=True))
@click.option("-o", "--output", default="-", show_default=True, type=click.Path(allow_dash=True),
              help="Drawing to write, - for the standard output.")
@click.option("--start", type=Pair(), help="Place of the start hole, mm. Default: FROM, else 0,0.")
@click.option("--polylines", is_flag=True, help="One LWPOLYLINE with bulges for each contour.")
@positions_option
@click.option("--joints", type=click.Choice(("drawn", "tape")), default="drawn", show_default=True,
              help="Where blocks meet. drawn: where the corners most likely were before the tape's rounding, to a "
                   "fraction of a µm; tape: at the whole µm that the blocks or the controller end at.")
@source.skg80_option
def command(file: str, output: str, start: tuple[float, float] | None, polylines: bool, positions: str,
            joints: str, skg80: str | None) -> None:
    """Turn a tape (.3b) or a program (.skg) into a DXF drawing of the wire's path.

    Layers: WIRE what is cut, LEAD the way from the start hole to the contour, MOVES positioning, START and
    STOPS points. FILE - is a tape on the standard input.
    """
    made = source.load(file, skg80)
    routes, stops = lay_out(made, start or made.start, positions, joints, file.lower().endswith(".skg"))
    text = io.StringIO()
    draw(routes, stops, polylines).write(text)
    tape.write_bytes(output, text.getvalue().encode())
