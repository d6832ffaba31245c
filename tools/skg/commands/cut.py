"""`skg cut`: a drawing as a tape, checked before it is written."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import click

from skg.commands.options import (
    MOST_OFFSET,
    FiniteRange,
    RomName,
    drawing_options,
    feed_option,
    numbers_in,
    offset_option,
    output_option,
    picture_format,
    unmarked,
)
from skg.errors import UserError
from skg.files import read_bytes, write_bytes
from skg.geometry.plane import XY
from skg.job.wanted import LEAD_SHAPES, Wanted
from skg.planning.plan import plan
from skg.reading.read import Wishes, layer_lines, read
from skg.reading.selection import SMALL, WITHIN
from skg.wording import short


class Passes(click.ParamType):
    """Numbers with commas between them, none below 0, such as 0.06,0.02,0."""

    name = "MM,MM,..."

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> tuple[float, ...]:
        """Return the numbers."""
        if isinstance(value, tuple):
            return value
        result = numbers_in(value)
        if not result or not all(0 <= more <= MOST_OFFSET for more in result):
            self.fail(f"{value!r}: expected lengths in mm with commas between them, such as 0.06,0.02,0", param, ctx)
        if any(after > before for before, after in pairwise(result)):
            self.fail(f"{value!r}: a pass that leaves more than the one before it cuts nothing", param, ctx)
        return result


@click.command(name="cut")
@click.argument("file", type=click.Path(allow_dash=True))
@output_option("Tape to write, - for the standard output.")
@click.option("--list-layers", is_flag=True, help="Show the layers and what is on them, and cut nothing.")
@click.option("--program", metavar="FILE", type=click.Path(allow_dash=True), help="Also write the SKG program.")
@click.option("--sheet", metavar="FILE", type=click.Path(), help="Also write the setup sheet: .pdf, .svg or .png.")
@click.option("--wire", metavar="MM", type=FiniteRange(0, 2 * MOST_OFFSET, min_open=True), help="Diameter of the wire.")
@click.option(
    "--gap",
    metavar="MM",
    default=0.0,
    type=FiniteRange(0, MOST_OFFSET),
    help="Spark gap on each side of the wire.",
)
@offset_option(
    "The wire's distance from the contour, R, instead of --wire and --gap: half the wire plus the gap. Default: 0."
)
@drawing_options
@click.option(
    "--fit-tolerance",
    default=0.0002,
    show_default=True,
    metavar="MM",
    type=FiniteRange(1e-5),
    help="Largest distance of FIT from splines and ellipses.",
)
@click.option(
    "--lead-shape",
    default="perpendicular",
    show_default=True,
    type=click.Choice(LEAD_SHAPES),
    help="arc: a quarter of a circle about the start hole touches the contour.",
)
@click.option(
    "--passes",
    metavar="MM,MM,...",
    type=Passes(),
    help="Cut each contour so often, every second time backwards; what each pass leaves to the last offset, "
    "such as 0.06,0.02,0.",
)
@click.option(
    "--tab",
    default=0.0,
    metavar="MM",
    type=FiniteRange(0),
    help="Length of the bridge that keeps a part cut from outside; the machine stops, the last cut takes it off.",
)
@click.option(
    "--small",
    default="refuse",
    show_default=True,
    type=click.Choice(("refuse", "leave")),
    help="Refuse or leave closed contours that are too small or narrow for the wire beside them, or too short for "
    "the tab.",
)
@click.option(
    "--into",
    default="refuse",
    show_default=True,
    type=click.Choice(("refuse", "cut")),
    help="Refuse or cut closed contours whose wire would gouge another one, since they cross or lie too near to "
    "each other.",
)
@click.option(
    "--rom",
    default="no-drift",
    show_default=True,
    type=RomName(("no-drift", "standard")),
    help="The ROM that makes the tape. On a standard tape the misses of the arcs add up.",
)
@click.option(
    "--ram", default=8, show_default=True, metavar="KIB", type=click.IntRange(2, 56), help="The board's RAM, KiB."
)
@feed_option
@click.option("--quiet", is_flag=True, help="Print warnings alone.")
def command(
    file: str,
    output: str,
    list_layers: bool,
    program: str | None,
    sheet: str | None,
    wire: float | None,
    gap: float,
    offset: float | None,
    side: str,
    reverse: bool,
    layers: tuple[str, ...],
    units: str | None,
    opened: str | None,
    encoding: str | None,
    starts: tuple[XY, ...],
    start_layer: str,
    lead: float,
    lead_shape: str,
    passes: tuple[float, ...] | None,
    tab: float,
    small: str,
    into: str,
    tolerance: float,
    fit_tolerance: float,
    rom: str,
    ram: int,
    feed: float,
    quiet: bool,
) -> None:
    """Cut a drawing: FILE (.dxf or .svg) becomes a 3B tape.

    Lines, arcs, circles, polylines, ellipses and splines are chained into contours. Openings are cut before the outline
    around them, each from a start hole of its own. The program runs on the board in this process, and the tape is
    followed with the controller's simulation and compared with the drawing before it is written. The report goes to
    standard error. FILE - is the standard input.
    """
    from skg.cutting.job import make
    from skg.cutting.report import report
    from skg.cutting.settings import Settings

    if list_layers:
        for line in layer_lines(read_bytes(file), file, Wishes(encoding=encoding)):
            click.echo(line)
        return
    distance = _offset(wire, gap, offset)
    form = picture_format(sheet, None) if sheet else ""
    wishes = Wishes(
        layers, start_layer, units, tolerance, fit_tolerance, opened or ("refuse" if distance else "cut"), encoding
    )
    data = read_bytes(file)
    reading = read(data, file, wishes)
    factor = reading.report.factor
    settings = Settings(rom, ram, feed, small, into)
    try:
        routes = plan(
            reading.contours,
            list(starts) or reading.starts,
            Wanted(True, distance, side, reverse, passes or (0.0,), tab, lead, lead_shape),
            reading.others,
        )
        job = make(routes, "standard input" if file == "-" else Path(file).name, factor, settings)
    except UserError as error:
        raise UserError(f"{file}: {error}") from None
    if job.left:
        reading = read(data, file, wishes, {one.number: WITHIN if one.is_within else SMALL for one in job.left})
    if program:
        write_bytes(program, job.program.encode("ascii"))
    if sheet:
        from skg.pictures.sheet import Facts, write_sheet

        names = (Path(path).name if path != "-" else "-" for path in (file, output))
        write_sheet(job, Facts(*names, wire, gap, reading.report.units), sheet, form)
    write_bytes(output, job.data)  # last: no tape where something else could not be written
    lines = [*reading.report.lines(), *report(job, factor, distance)]
    if passes and passes[-1]:
        lines.append(f"take care: the last pass leaves {short(passes[-1])} mm more than the offset, as --passes says")
    if tab and not any(route.tab for route in job.routes):
        lines.append("take care: no contour has a tab: none is a part that is cut from outside")
    if any(overlap.what != "drawn twice" for overlap in reading.report.overlaps):
        from skg.checking.split_parts import said

        lines += said(job.routes, factor)
    if quiet:
        lines = [line for line in lines if line.startswith(("take care", "not cut"))]
    else:
        lines += unmarked(output, job.tape, rom)
    for line in lines:
        click.echo(line, err=True)


def _offset(wire: float | None, gap: float, offset: float | None) -> float:
    """The wire's distance from the contour, mm."""
    if offset is not None and (wire is not None or gap):
        raise UserError("--offset and --wire with --gap say the same thing: give one of them")
    if gap and wire is None:
        raise UserError("--gap goes with --wire")
    if wire is None:
        return offset or 0.0
    if wire / 2 + gap > MOST_OFFSET:
        raise UserError(
            f"--wire and --gap put the wire {wire / 2 + gap:g} mm beside the contour, at most {MOST_OFFSET:g}"
        )
    return wire / 2 + gap
