"""`skg gear` and `skg cam`: their common options, and the files that they write."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import click

from skg.commands.options import Millimetres, offset_option, output_option
from skg.errors import UserError
from skg.files import write_bytes
from skg.terminal import tell

if TYPE_CHECKING:
    from skg.cutting.cam import Cam
    from skg.cutting.gear import Gear
    from skg.messages.finding import Phrase


def shape_options(function: Callable) -> Callable:
    """Give a command the options of `write_shape`."""
    for option in (
        click.option("--tape", metavar="FILE", type=click.Path(), help="Also write the tape, by the no-drift ROM."),
        click.option(
            "--tab", default=0.0, show_default=False, type=Millimetres(0), help="Length of the tab, as in `skg cut`."
        ),
        offset_option("The wire's distance from the contour, R: half the wire plus the gap. Default: 0."),
        output_option("Program to write, - for the standard output."),
    ):
        function = option(function)
    return function


def write_shape(
    name: Phrase, shape: Gear | Cam, output: str, offset: float | None, tab: float, tape: str | None
) -> None:
    """Write the program that cuts a shape; it is run and its tape compared with the exact curves before.

    `name`: what errors call it in the user's language; the program has it as a remark, in English.
    """
    from skg.cutting.report import findings
    from skg.job.wanted import CutSettings
    from skg.messages.finding import Finding
    from skg.messages.render import Speech, line, text

    try:
        result = shape.cut(text(name, Speech("en")), CutSettings(offset=offset or 0.0, tab=tab))
    except UserError as error:
        raise error.within(name) from None
    if any(planned.rung.wire and any(planned.passes) for planned in result.contours):
        raise UserError(Finding("shape-too-narrow", offset=offset).within(name))
    write_bytes(output, result.program.encode("ascii"))
    if tape:
        write_bytes(tape, result.data)
    for finding in findings(result):
        tell(line(finding))
