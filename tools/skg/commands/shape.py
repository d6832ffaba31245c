"""`skg gear` and `skg cam`: what both do with the contours that they make."""

from __future__ import annotations

from collections.abc import Callable

import click

from skg.commands.options import FiniteRange, offset_option, output_option
from skg.errors import UserError
from skg.files import write_bytes
from skg.geometry.contour import Contour


def shape_options(function: Callable) -> Callable:
    """Give a command the options of `write_shape`."""
    for option in (
        click.option("--tape", metavar="FILE", type=click.Path(), help="Also write the tape, by the no-drift ROM."),
        click.option(
            "--tab", default=0.0, metavar="MM", type=FiniteRange(0), help="Length of the bridge, as in `skg cut`."
        ),
        offset_option("The wire's distance from the contour, R: half the wire plus the gap. Default: 0."),
        output_option("Program to write, - for the standard output."),
    ):
        function = option(function)
    return function


def write_shape(
    name: str, contours: Callable[[], list[Contour]], output: str, offset: float | None, tab: float, tape: str | None
) -> None:
    """Write the program that cuts contours; it is run and its tape compared with the exact curves before."""
    from skg.cutting.job import make
    from skg.cutting.report import report
    from skg.cutting.settings import Settings
    from skg.job.wanted import Wanted
    from skg.planning.plan import plan

    try:
        job = make(plan(contours(), [], Wanted(offset=offset or 0.0, tab=tab)), name, 1.0, Settings())
    except UserError as error:
        raise UserError(f"{name}: {error}") from None
    if any(route.traced and any(route.passes) for route in job.routes):
        raise UserError(f"{name}: it has bends that are too narrow for an offset of {offset:g} mm: a smaller --offset")
    write_bytes(output, job.program.encode("ascii"))
    if tape:
        write_bytes(tape, job.data)
    for line in report(job, 1.0):
        click.echo(line, err=True)
