"""`skg from-dxf`: an SKG program from a drawing."""

from __future__ import annotations

from pathlib import Path

import click

from skg.commands.options import MOST_OFFSET, Coordinates
from skg.drawing.plan import LEAD, plan
from skg.drawing.read import OPEN, UNITS, Wishes, layer_lines, read
from skg.errors import UserError
from skg.files import read_bytes, write_bytes
from skg.plane import XY


@click.command(name="from-dxf")
@click.argument("file", type=click.Path(allow_dash=True))
@click.option(
    "-o",
    "--output",
    default="-",
    show_default=True,
    type=click.Path(allow_dash=True),
    help="Program to write, - for the standard output.",
)
@click.option("--layer", "layers", multiple=True, help="Take only this layer; may be given again.")
@click.option("--list-layers", is_flag=True, help="Show the layers and what is on them, and write nothing.")
@click.option(
    "--offset",
    default=0.0,
    metavar="MM",
    type=click.FloatRange(0, MOST_OFFSET),
    help="R: half the wire and its spark gap. Default: 0, the wire's middle runs on the contour.",
)
@click.option(
    "--side",
    default="auto",
    show_default=True,
    type=click.Choice(("auto", "inside", "outside", "left", "right", "on")),
    help="Where the wire runs. auto: around outlines, within the openings in them.",
)
@click.option("--reverse", is_flag=True, help="Cut in the other direction (R changes its sign).")
@click.option(
    "--start",
    "starts",
    multiple=True,
    type=Coordinates(),
    help="Start hole, mm; may be given again. Default: points on the layer START, else chosen.",
)
@click.option("--start-layer", default="START", show_default=True, help="Layer of the points for start holes.")
@click.option(
    "--lead",
    default=LEAD,
    show_default=True,
    metavar="MM",
    type=click.FloatRange(0, min_open=True),
    help="Distance of a chosen start hole from the contour, where there is room.",
)
@click.option(
    "--tolerance",
    default=0.005,
    show_default=True,
    metavar="MM",
    type=click.FloatRange(0, min_open=True),
    help="Ends no further apart than this are one corner.",
)
@click.option(
    "--fit-tolerance",
    default=0.0002,
    show_default=True,
    metavar="MM",
    type=click.FloatRange(1e-5),
    help="How near FIT shall come to splines and ellipses.",
)
@click.option("--units", type=click.Choice(UNITS), help="Units of the drawing. Default: as the file says, else mm.")
@click.option(
    "--open",
    "opened",
    type=click.Choice(OPEN),
    help="What becomes of open contours. Default: cut without --offset, refuse with it.",
)
@click.option("--no-fillets", is_flag=True, help="Write rounded corners as circles, not as fillet radii.")
def command(
    file: str,
    output: str,
    layers: tuple[str, ...],
    list_layers: bool,
    offset: float,
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
    from skg.drawing.write import write

    wishes = Wishes(layers, start_layer, units, tolerance, fit_tolerance, opened or ("refuse" if offset else "cut"))
    if list_layers:
        for line in layer_lines(read_bytes(file), file):
            click.echo(line)
        return
    reading = read(read_bytes(file), file, wishes)
    for line in reading.report.lines():
        click.echo(f"skg: {file}: {line}", err=True)
    try:
        routes = plan(reading.contours, list(starts) or reading.starts, offset, side, reverse, lead)
    except UserError as error:
        raise UserError(f"{file}: {error}") from None
    title = "standard input" if file == "-" else Path(file).name
    write_bytes(output, write(routes, title, not no_fillets).encode("ascii"))
