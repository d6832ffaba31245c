"""`skg dxf`: a tape as a DXF drawing."""

from __future__ import annotations

import click

from skg.commands.options import (
    decided,
    output_option,
    positions_option,
    read_machine_option,
    skg80_option,
    start_option,
)
from skg.errors import UserError
from skg.files import text_output
from skg.geometry.plane import XY
from skg.messages.finding import Finding
from skg.tape.dialect import GcodeDialect
from skg.terminal import remark


@click.command(name="dxf")
@click.argument("file", type=click.Path(allow_dash=True))
@output_option("Drawing to write, - for the standard output.")
@start_option
@click.option("--polylines", is_flag=True, help="One LWPOLYLINE with bulges for each contour.")
@positions_option
@read_machine_option
@skg80_option
def command(
    file: str,
    output: str,
    start: XY | None,
    polylines: bool,
    positions: str,
    dialect: GcodeDialect | None,
    skg80: str | None,
) -> None:
    """Turn a tape or a program into a DXF drawing of the wire's path.

    FILE is a tape (3B, or G-code as .nc, .ngc, .gcode, .tap, .iso) or a program (.skg, .xy, .tkh), which is run first;
    `-`: a tape on the standard input.

    Layers: WIRE has the cuts, LEAD the ways from start holes to contours, MOVES the moves without a cut; START, STOPS
    and, of a milling tape, HOLES have points.
    """
    from skg.pictures.dxf import write
    from skg.sources.load import iso_program, lay_out, load

    if program := iso_program(file, skg80, dialect):
        if start:
            raise UserError(Finding("iso-has-places").within(file))
        if heights := program.heights():
            remark(Finding("heights-in-plane", heights=heights).within(file))
        with text_output(output) as stream:
            write(stream, program.routes(), program.stop_places, polylines, program.holes)
        return
    tape = load(file, skg80)
    routes, stops = lay_out(tape, start or tape.start, decided(tape, positions))
    with text_output(output) as stream:
        write(stream, routes, stops, polylines)
