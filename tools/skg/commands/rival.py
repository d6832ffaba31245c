"""A command for each rival's language: `skg xy`, `skg tekhtran`."""

from __future__ import annotations

import click

from skg.commands.options import output_option
from skg.errors import UserError
from skg.files import write_bytes
from skg.rivals.languages import translated
from skg.terminal import tell


def translator(name: str, ending: str, language: str) -> click.Command:
    """The command that translates programs whose files' names have this ending."""

    @click.command(
        name=name,
        help=f"""Translate PART from {language}, to SKG.

        An error in PART is one line, FILE:LINE:COLUMN: TEXT, with exit code 1 and no program. PART - is the standard
        input.""",
    )
    @click.argument("part", type=click.Path(allow_dash=True))
    @output_option("Program to write, - for the standard output.")
    def command(part: str, output: str) -> None:
        try:
            program = translated(part, ending)
        except UserError as error:
            tell(str(error))
            raise SystemExit(1) from None
        write_bytes(output, program.encode("ascii"))

    return command
