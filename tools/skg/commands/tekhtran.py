"""`skg tekhtran`: a TEKHTRAN program made an SKG program."""

from __future__ import annotations

import click

from skg.commands.options import output_option
from skg.commands.rival import write_program


@click.command(name="tekhtran")
@click.argument("part", type=click.Path(allow_dash=True))
@output_option("Program to write, - for the standard output.")
def command(part: str, output: str) -> None:
    """Write the SKG program that cuts what PART describes in TEKHTRAN, a Soviet language for NC machines.

    What is wrong with PART is said as FILE:LINE:COLUMN: TEXT, with exit code 1 and no program. PART - is the standard
    input.
    """
    write_program(part, ".tkh", output)
