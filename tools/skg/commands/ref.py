"""`skg ref`: run a program through the reference."""

from __future__ import annotations

import sys

import click

from skg.commands.options import answers_option, output_option, write_tape
from skg.errors import UserError
from skg.files import board_text, read_bytes
from skg.messages.finding import Finding
from skg.terminal import remark


@click.command("ref")
@click.argument("part", type=click.Path(allow_dash=True))
@output_option("Tape to write, - for the standard output.")
@answers_option
@click.option(
    "--drift/--no-drift",
    default=True,
    help="Let the controller's misses at the ends of arcs add up, or start each block where it really stands.",
)
@click.option("--mill", is_flag=True, help="The milling machine's language and its ISO tape, as roms/skg-mill.bin.")
@click.option("--grbl", is_flag=True, help="The same with LF alone after each block, as roms/skg-grbl.bin.")
def command(part: str, output: str, answers: str | None, drift: bool, mill: bool, grbl: bool) -> None:
    """Run PART in 50-digit arithmetic: the exact tape that it must give, 3B or, with --mill, ISO.

    PART is an SKG program, or a rival's (.xy, .tkh), which is translated; `-`: an SKG program on the standard input.

    The teletype's paper goes to standard error. Exit code 1 when the run
    ended in ERR, 2 for wrong usage.
    """
    from skg.board.feeding import as_run, given_up
    from skg.ref import mill as milling
    from skg.ref import run
    from skg.sources.load import program_text
    from skg.sources.milling import is_milling

    program = program_text(part)
    inputs = board_text(read_bytes(answers), answers).splitlines() if answers else []
    text, runs = as_run(program)
    if not (mill or grbl):
        result = run(text, inputs, drift=drift, runs=runs)
    elif drift:
        result = milling.run(text, inputs, line_end="\n" if grbl else "\r\n", runs=runs)
    else:
        raise UserError(Finding("no-drift-in-iso"))
    click.echo(result.paper, err=True, nl=False)
    if result.error and not (mill or grbl) and is_milling(program):
        remark(Finding("milling-with-mill").within(part))
    if lost := given_up(program):
        remark(lost.within(part))
    write_tape(output, result.tape, is_whole=result.error is None)
    sys.exit(0 if result.error is None else 1)
