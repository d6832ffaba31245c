"""`skg tape`: a tape of any style, written in one."""

from __future__ import annotations

import click

from skg.commands.options import output_option, say
from skg.files import write_bytes
from skg.messages.finding import Finding
from skg.sources.load import load
from skg.tape.positions import WITHOUT_DRIFT
from skg.tape.styles import STYLES, to_style


@click.command(name="tape")
@click.argument("file", default="-", type=click.Path(allow_dash=True))
@output_option("Tape to write, - for the standard output.", in_place=True)
@click.option(
    "--style",
    type=click.Choice(list(STYLES)),
    default="punch",
    help="Style of blocks. punch: as the board does; spaced: with blanks; numbered: N 1: and blanks; "
    "padded: with zeros to six digits; joined: all in one line.",
)
def command(file: str, output: str, style: str) -> None:
    """Read a 3B tape in any style, and write it in one.

    Differences from the punch's own style are listed on standard error. A program (.skg, .xy, .tkh) is run first.
    FILE - (or none) is the standard input.
    """
    tape = load(file)
    lost = tape.drift is False and output != "-" and not output.lower().endswith(WITHOUT_DRIFT)
    say(tape, Finding("drift-in-name", output=output, ending=WITHOUT_DRIFT) if lost else None)
    write_bytes(output, to_style(tape.items, style))
