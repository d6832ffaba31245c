"""`skg from-dxf`: an SKG program from a drawing."""

from __future__ import annotations

from pathlib import Path

import click

from skg.commands.options import FiniteRange, drawing_options, offset_option, output_option
from skg.errors import UserError
from skg.files import read_bytes, write_bytes
from skg.geometry.plane import XY
from skg.job.wanted import Wanted
from skg.planning.plan import plan
from skg.reading.read import Wishes, layer_lines, read


@click.command(name="from-dxf")
@click.argument("file", type=click.Path(allow_dash=True))
@output_option("Program to write, - for the standard output.")
@click.option("--list-layers", is_flag=True, help="Show the layers and what is on them, and write nothing.")
@offset_option("The wire's distance from the contour, R: half the wire plus the gap. Default: 0.")
@drawing_options
@click.option(
    "--fit-tolerance",
    default=0.0002,
    show_default=True,
    metavar="MM",
    type=FiniteRange(1e-5),
    help="How near FIT shall come to splines and ellipses.",
)
@click.option("--no-fillets", is_flag=True, help="Write rounded corners as circles, not as fillet radii.")
def command(
    file: str,
    output: str,
    layers: tuple[str, ...],
    list_layers: bool,
    offset: float | None,
    side: str,
    reverse: bool,
    starts: tuple[XY, ...],
    start_layer: str,
    lead: float,
    tolerance: float,
    fit_tolerance: float,
    units: str | None,
    opened: str | None,
    no_fillets: bool,
) -> None:
    """Write the SKG program that cuts a drawing, DXF or SVG.

    Lines, arcs, circles, polylines with bulges, ellipses and splines are chained into contours; openings are
    cut before the outline around them, each from a start hole of its own and entered in the middle of an
    edge. FILE - is the standard input.
    """
    from skg.cutting.program import write
    from skg.planning.nesting import said

    wishes = Wishes(layers, start_layer, units, tolerance, fit_tolerance, opened or ("refuse" if offset else "cut"))
    if list_layers:
        for line in layer_lines(read_bytes(file), file):
            click.echo(line)
        return
    reading = read(read_bytes(file), file, wishes)
    for line in reading.report.lines():
        click.echo(f"skg: {file}: {line}", err=True)
    try:
        routes = plan(
            reading.contours,
            list(starts) or reading.starts,
            Wanted(offset=offset or 0.0, side=side, reverse=reverse, lead=lead),
            reading.others,
        )
    except UserError as error:
        raise UserError(f"{file}: {error}") from None
    for line in said(route.around for route in routes):
        click.echo(f"skg: {file}: {line}", err=True)
    title = "standard input" if file == "-" else Path(file).name
    write_bytes(output, write(routes, title, not no_fillets).encode("ascii"))
