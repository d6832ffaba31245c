"""`skg ref`: run a program through the reference."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from skg.errors import UserError
from skg.ref.interpreter import run


def _text(path: Path) -> str:
    try:
        return path.read_bytes().decode("ascii")
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        raise UserError(f"{path}: line {line}: not plain ASCII") from None


@click.command("ref")
@click.argument("part", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option(
    "-o",
    "--output",
    type=click.Path(dir_okay=False, path_type=Path),
    help="Where the tape goes; standard output without it.",
)
@click.option(
    "--input",
    "answers",
    type=click.Path(exists=True, dir_okay=False, path_type=Path),
    help="What the operator answers to INPUT, one line each.",
)
@click.option(
    "--drift/--no-drift",
    default=True,
    show_default=True,
    help="Let the controller's misses at the ends of arcs add up, or start each block where it really stands.",
)
def command(part: Path, output: Path | None, answers: Path | None, drift: bool) -> None:
    """Run PART (an SKG program) in 50-digit arithmetic: the exact 3B tape that it must give.

    The tape goes to standard output, the teletype's paper to standard error. Exit code 1 when the run
    ended in ERR, 2 for wrong usage.
    """
    result = run(_text(part), _text(answers).splitlines() if answers else [], drift=drift)
    sys.stderr.write(result.paper)
    if output is None:
        sys.stdout.buffer.write(result.tape)
        sys.stdout.flush()
    else:
        output.write_bytes(result.tape)
    sys.exit(0 if result.error is None else 1)
