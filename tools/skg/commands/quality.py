"""`skg quality`: how near fitted curves come to the true ones, and how many blocks they take."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import click

from skg.commands.options import FiniteRange
from skg.errors import UserError

if TYPE_CHECKING:
    from skg.quality.fewest import Saving
    from skg.quality.measure import Quality


def table(heading: list[str], rows: list[list[str]], words: int) -> str:
    """A Markdown table that reads well as it is; the first columns are words, the others numbers."""
    widths = [max(len(row[n]) for row in [heading, *rows]) for n in range(len(heading))]

    def line(cells: Iterable[str]) -> str:
        padded = [c.ljust(w) if n < words else c.rjust(w) for n, (c, w) in enumerate(zip(cells, widths, strict=True))]
        return f"| {' | '.join(padded)} |"

    rule = ["-" * w if n < words else "-" * (w - 1) + ":" for n, w in enumerate(widths)]
    return "\n".join(map(line, [heading, rule, *rows])) + "\n"


def micrometres(length: float | None) -> str:
    """A length in µm, three digits."""
    return "-" if length is None else f"{1000 * length:.3g}"


def quality_table(found: list[Quality]) -> str:
    """One row for each curve; distances in µm."""
    from skg.quality.measure import DOUBLINGS

    heading = ["part", "true curve", "nodes", "blocks", "chords", "jump", "off", "biarcs", "×2", "×4", "factors"]
    rows = [
        [
            *(q.part, q.curve, str(q.nodes), str(q.blocks), str(q.flat), f"{q.jump:.0e}", micrometres(q.distance)),
            *map(micrometres, q.biarcs or [None] * (DOUBLINGS + 1)),
            ", ".join(f"{f:.1f}" for f in q.factors) or "-",
        ]
        for q in found
    ]
    return table(heading, rows, words=2)


def saving_table(found: list[Saving]) -> str:
    """One row for each set of nodes."""
    heading = ["part", "nodes", "blocks", "with TOL", "fewest", "ratio"]
    rows = [[s.part, *map(str, (s.nodes, s.blocks, s.joined, s.fewest)), f"{s.ratio:.2f}"] for s in found]
    return table(heading, rows, words=1)


@click.command(name="quality")
@click.argument(
    "parts", metavar="PART...", nargs=-1, required=True, type=click.Path(exists=True, dir_okay=False, path_type=Path)
)
@click.option(
    "--tol",
    metavar="MM",
    type=FiniteRange(min=0, min_open=True),
    help="Instead, join nodes within so many mm and compare the blocks with the fewest possible.",
)
def command(parts: tuple[Path, ...], tol: float | None) -> None:
    """Measure the curves that the FIT statements of PART (SKG programs) make, by the reference.

    One row for each run of FIT statements. All rows have the nodes, the blocks, how many blocks are chords of flat
    arcs, and the largest jump of the tangent (radians) before these became chords. Where the true curve is known, as
    for examples/, the largest distance from it follows, in µm: of the blocks; of the biarcs with the nodes of the
    program, with twice as many and with four times as many; and by what each doubling divides it. A TOL in the program
    counts for the blocks; the biarcs keep every node.

    --tol shows what TOL (docs/curves.md) does to the number of blocks, with the nodes of the program and with four
    times as many, if these are no more than 300. A TOL in the program does not count then.
    """
    from skg.quality.fewest import savings
    from skg.quality.fitted import fitted_runs
    from skg.quality.measure import measure
    from skg.sources.load import program_text
    from skg.sources.milling import is_milling

    curves, without = [], []
    for part in parts:
        text = program_text(str(part))
        try:
            found = [(part, run) for run in fitted_runs(text, is_milling(text)) if len(run.nodes) > 2]
        except UserError as error:
            raise UserError(f"{part}: {error}") from None
        if not found:
            without.append(f"{part}: no curve of FIT with three nodes")
        curves += found
    if not curves:
        raise UserError("; ".join(without))
    for line in without:
        click.echo(f"skg: {line}", err=True)
    if tol is None:
        click.echo(quality_table([measure(part, run) for part, run in curves]), nl=False)
    else:
        click.echo(saving_table([s for part, run in curves for s in savings(part, run.nodes, str(tol))]), nl=False)
