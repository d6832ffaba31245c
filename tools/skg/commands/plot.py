"""`skg plot`: pictures of tapes, to scale."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from skg.commands.options import (
    COORDINATES,
    FORMATS,
    FiniteRange,
    Millimetres,
    decided,
    output_option,
    picture_format,
    positions_option,
    read_machine_option,
    skg80_option,
)
from skg.errors import UserError
from skg.geometry.plane import XY
from skg.messages.finding import Finding, Phrase
from skg.terminal import remark

if TYPE_CHECKING:
    from collections.abc import Sequence

    from skg.pictures.plot import Sheet
    from skg.tape.dialect import GcodeDialect


@click.command(name="plot")
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=click.Path(allow_dash=True))
@output_option("Picture to write, .svg, .png or .pdf; - for the standard output.", required=True)
@click.option("--format", "form", type=click.Choice(FORMATS), help="Format, where the name of the file has none.")
@click.option("--blocks", is_flag=True, help="Write every block's number beside it.")
@click.option(
    "--wire",
    default=0.0,
    show_default=False,
    type=Millimetres(0),
    help="Draw the cut of a wire of this diameter, to scale.",
)
@click.option("--no-arrows", is_flag=True, help="No arrows in the direction of travel.")
@click.option("--show-offset", is_flag=True, help="Also draw the nominal contour (of programs).")
@click.option(
    "--start",
    multiple=True,
    type=COORDINATES,
    help="Place of the start hole, mm; once for each FILE. Default: FROM of a program, else 0,0.",
)
@click.option(
    "--scale", metavar="N", type=FiniteRange(0, min_open=True), help="Drawing scale, 2 for 2:1. Default: fit the page."
)
@click.option("--title", default="", show_default=False, metavar="TEXT", help="A title above the drawing.")
@positions_option
@read_machine_option
@skg80_option
def command(
    files: tuple[str, ...],
    output: str,
    form: str | None,
    blocks: bool,
    wire: float,
    no_arrows: bool,
    show_offset: bool,
    start: tuple[XY, ...],
    scale: float | None,
    title: str,
    positions: str,
    dialect: GcodeDialect | None,
    skg80: str | None,
) -> None:
    """Draw tapes and programs to scale, several in one picture.

    FILE is a tape (3B, or G-code as .nc, .ngc, .gcode, .tap, .iso) or a program (.skg, .xy, .tkh), which is run first,
    by the ROM (a milling program by the mill ROM) or by the emulator of --skg80; `-`: a tape on the standard input.

    Start holes are circles, drilled holes crosses in them, stops squares, moves that do not cut dashed.
    """
    form = picture_format(output, form, Phrase("or-format"))
    from skg.pictures.plot import COLOURS, Picture

    laid = [
        _laid(name, start[index] if index < len(start) else None, positions, skg80, dialect, show_offset)
        for index, name in enumerate(files)
    ]
    sheets, stops = [sheet for sheet, _ in laid], [places for _, places in laid]
    if not any(sheet.routes for sheet in sheets):
        raise UserError(Finding("nothing-to-draw").within(files[0]))
    picture = Picture(sheets, scale, title)
    for index, sheet in enumerate(sheets):
        picture.draw(sheet, COLOURS[index % len(COLOURS)], f"tape-{index + 1}", wire, not no_arrows, blocks)
        picture.stops(stops[index], f"tape-{index + 1}")
    if picture.left_out:
        remark(Finding("numbers-left-out", count=picture.left_out).within(output))
    if len(sheets) > 1:
        picture.legend([sheet.name for sheet in sheets])
    picture.save(output, form)


def _laid(
    name: str, start: XY | None, positions: str, skg80: str | None, dialect: GcodeDialect | None, show_offset: bool
) -> tuple[Sheet, Sequence[XY]]:
    """The routes of a file and its stops, µm. (No more is kept of a tape: it may be long.)"""
    from skg.pictures.plot import Sheet
    from skg.sources.load import contour_of, iso_program, lay_out, load

    contour = contour_of(name) if show_offset else ()
    if program := iso_program(name, skg80, dialect):
        if heights := program.heights():
            remark(Finding("heights", heights=heights).within(name))
        return Sheet(Path(name).name, program.routes(), contour, tuple(program.holes)), program.stop_places
    tape = load(name, skg80)
    routes, stops = lay_out(tape, start or tape.start, decided(tape, positions))
    return Sheet(Path(name).name, routes, contour), stops
