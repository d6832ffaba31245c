"""`skg dxf`: a tape as a DXF drawing."""

from __future__ import annotations

import click

from skg.commands.options import Coordinates, decided, output_option, positions_option, skg80_option
from skg.errors import UserError
from skg.files import text_output
from skg.geometry.plane import XY, distance
from skg.tape.layout import PlacedRoute
from skg.tape.positions import OTHER, decide

#: A drawing that is otherwise by more than this is another one, µm.
_SAME = 0.5


def _differ(ones: list[PlacedRoute], others: list[PlacedRoute]) -> bool:
    """Whether blocks end elsewhere in one layout than in the other."""
    return any(
        distance(one.end, other.end) > _SAME
        for route, beside in zip(ones, others, strict=True)
        for one, other in zip(route.blocks, beside.blocks, strict=True)
    )


@click.command(name="dxf")
@click.argument("file", type=click.Path(allow_dash=True))
@output_option("Drawing to write, - for the standard output.")
@click.option("--start", type=Coordinates(), help="Place of the start hole, mm. Default: FROM of a program, else 0,0.")
@click.option("--polylines", is_flag=True, help="One LWPOLYLINE with bulges for each contour.")
@positions_option
@click.option(
    "--joints",
    type=click.Choice(("drawn", "tape")),
    default="drawn",
    show_default=True,
    help="Where blocks meet. drawn: where the corners most likely were before the tape's rounding, to a "
    "fraction of a µm; tape: at the whole µm that the blocks or the controller end at.",
)
@skg80_option
def command(
    file: str, output: str, start: XY | None, polylines: bool, positions: str, joints: str, skg80: str | None
) -> None:
    """Turn a tape or a program into a DXF drawing of the wire's path.

    FILE is a tape (3B, or G-code as .nc, .ngc, .gcode, .tap, .iso) or a program (.skg, .xy, .tkh), which is run first;
    `-`: a tape on the standard input.

    Layers: WIRE is what is cut, LEAD the way from the start hole to the contour, MOVES what is no cut; START and STOPS
    have points, and HOLES, of a milling tape. Corners of a milling tape are where it has them, whatever --joints says.
    """
    from skg.pictures.dxf import write
    from skg.sources.load import iso_program, lay_out, load

    if program := iso_program(file, skg80):
        if start:
            raise UserError(f"{file}: an ISO tape has its own places: --start is for 3B")
        if heights := program.heights():
            click.echo(f"skg: {file}: all in one plane: {heights}", err=True)
        with text_output(output) as stream:
            write(stream, program.routes(), program.stop_places, polylines, program.holes)
        return
    made = load(file, skg80)
    home = start or made.start
    taken = decided(made.tape, positions)
    routes, stops = lay_out(made, home, taken, joints)
    finely = decide(made.tape, positions).finely if joints == "drawn" else ""
    if finely and _differ(routes, lay_out(made, home, OTHER[taken], joints)[0]):
        click.echo(f"skg: {made.tape.name}: {finely}", err=True)
    with text_output(output) as stream:
        write(stream, routes, stops, polylines)
