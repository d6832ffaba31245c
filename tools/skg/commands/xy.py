"""`skg xy`: an XY program made an SKG program."""

from __future__ import annotations

import click

from skg.errors import UserError
from skg.files import write_bytes


@click.command(name="xy")
@click.argument("part", type=click.Path(allow_dash=True))
@click.option(
    "-o",
    "--output",
    default="-",
    show_default=True,
    type=click.Path(allow_dash=True),
    help="Program to write, - for the standard output.",
)
def command(part: str, output: str) -> None:
    """Write the SKG program that cuts what PART describes in XY, the language of Beijing, 1979.

    What is wrong with PART is said as FILE:LINE:COLUMN: TEXT, with exit code 1 and no program. PART - is the standard
    input.
    """
    from skg.rivals.languages import translated

    try:
        program = translated(part, ".xy")
    except UserError as error:
        click.echo(str(error), err=True)
        raise SystemExit(1) from None
    write_bytes(output, program.encode("ascii"))
