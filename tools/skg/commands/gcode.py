"""`skg gcode`: 3B tapes to ISO G-code and back."""

from __future__ import annotations

import click

from skg.commands.options import Coordinates
from skg.drawing.source import load
from skg.files import read_ascii, write_bytes
from skg.tape import gcode
from skg.tape.text import to_bytes


@click.command(name="gcode")
@click.argument("source", metavar="FILE", default="-", type=click.Path(allow_dash=True))
@click.option("-o", "--output", default="-", show_default=True, type=click.Path(allow_dash=True),
              help="File to write, - for the standard output.")
@click.option("--back", is_flag=True, help="FILE is G-code: write a 3B tape.")
@click.option("--start", default="0,0", type=Coordinates(int), help="Position to set with G92, µm.")
@click.option("--mm", is_flag=True, help="Write millimetres with a decimal point instead of micrometres.")
def command(source: str, output: str, back: bool, start: tuple[int, int], mm: bool) -> None:
    """Turn a 3B tape into ISO G-code, or with --back G-code into a 3B tape.

    Written are G91, G92, G01, G02 and G03 with I and J, M00 for a stop and M02 at the end. Read are also G90,
    G00, G17, G21, G40, N and F words and comments; a number with a decimal point is millimetres, one without
    micrometres. A program (.skg, .xy, .tkh) is run first. FILE - (or none) is the standard input.
    """
    if back:
        write_bytes(output, to_bytes(gcode.read(read_ascii(source), source).items))
    else:
        write_bytes(output, gcode.write(load(source).tape, start, mm).encode())
