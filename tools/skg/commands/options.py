"""Options that several commands have."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import click

from skg.errors import UserError
from skg.tape.block import MAX_DIGITS, Tape
from skg.tape.positions import POSITIONS, decide

#: Formats of pictures, by the ending of a file's name.
FORMATS = ("svg", "png", "pdf")

positions_option = click.option(
    "--positions",
    type=click.Choice(POSITIONS),
    default="auto",
    show_default=True,
    help="Start each block where the block before should have ended (programmed), or where the controller "
    "really stands then (machine: tapes without drift); auto: as the tape says, else found out, and said.",
)


def picture_format(output: str, form: str | None, also: str = "") -> str:
    """The format of a picture: as said, else by the file's name; the standard output is SVG.

    `also`: what else may tell it.
    """
    found = form or ("svg" if output == "-" else Path(output).suffix.lstrip(".").lower())
    if found not in FORMATS:
        raise UserError(f"{output}: expected a name that ends in .svg, .png or .pdf{also}")
    return found


def decided(tape: Tape, positions: str) -> str:
    """Where a tape's blocks start, "programmed" or "machine"; `positions` is what --positions says.

    What had to be found out, and how, goes to standard error in one line, and so does what was noted when it was read.
    """
    decision = decide(tape, positions)
    say(tape, decision.why)
    return decision.positions


def say(tape: Tape, more: str = "") -> None:
    """Write to standard error what was noted when a tape was read, and what else there is to say."""
    for note in (*tape.notes, *filter(None, [more])):
        click.echo(f"skg: {tape.name}: {note}", err=True)


def output_option(text: str) -> Callable[[Callable], Callable]:
    """The option -o, FILE or - for the standard output; `text` is its help."""
    return click.option("-o", "--output", default="-", show_default=True, type=click.Path(allow_dash=True), help=text)


#: No wire with its spark gap is wider than twice this, mm.
MOST_OFFSET = 5.0


def skg80_option(function: Callable) -> Callable:
    """Give a command the option --skg80."""
    return click.option(
        "--skg80",
        metavar="FILE",
        help="What runs programs: an emulator such as build/skg80, or `reference` for the reference "
        "interpreter. Default: the board with the standard ROM, as in `skg run`.",
    )(function)


class Coordinates(click.ParamType):
    """Two numbers with a comma between them, such as 115000,-10000."""

    name = "X,Y"

    def __init__(self, number: type = float) -> None:
        self.number = number

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> tuple:
        """Return the two numbers."""
        if isinstance(value, tuple):
            return value
        try:
            first, second = (self.number(part) for part in str(value).split(","))
        except ValueError:
            self.fail(f"{value!r}: expected two numbers with a comma between them", param, ctx)
        if not max(abs(first), abs(second)) < 10**MAX_DIGITS:
            self.fail(f"{value!r}: expected numbers of at most {MAX_DIGITS} digits", param, ctx)
        return first, second
