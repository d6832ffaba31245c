"""Common work of `skg xy` and `skg tekhtran`."""

from __future__ import annotations

import click

from skg.errors import UserError
from skg.files import write_bytes
from skg.rivals.languages import translated


def write_program(part: str, ending: str, output: str) -> None:
    """Write the SKG program for a rival's; what is wrong is said, with exit code 1."""
    try:
        program = translated(part, ending)
    except UserError as error:
        click.echo(str(error), err=True)
        raise SystemExit(1) from None
    write_bytes(output, program.encode("ascii"))
