"""The tables of docs/curves.md: how near fitted curves come to the true ones, and how many blocks they take."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from pathlib import Path

from curve_fewest import Saving, savings
from curve_fitted import Run, fitted_runs
from curve_measure import DOUBLINGS, Quality, measure


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


def of_curves(parts: Iterable[Path]) -> str:
    """Deviations of the curves that the FIT statements of parts (SKG programs) make, by the reference: a row for each
    run of them. Where the true curve is known the distances from it follow, µm."""
    return quality_table([quality for part in parts for quality in measured(part)])


def of_tol(parts: Iterable[Path], tol: str) -> str:
    """Blocks with nodes joined within so many mm, and the fewest possible."""
    return saving_table([saving for part in parts for saving in saved(part, tol)])


# The curves of an example, worked out with 50 digits once for all tests.


@cache
def runs(part: Path) -> list[Run]:
    """The fitted curves of a part, of which it has at least one."""
    curves = fitted_runs(part.read_text())
    assert curves, "no curve was fitted"
    return curves


@cache
def measured(part: Path) -> list[Quality]:
    """The quality of each curve."""
    return [measure(part, run) for run in runs(part)]


@cache
def saved(part: Path, tol: str) -> list[Saving]:
    """The blocks that TOL saves in each curve."""
    return [saving for run in runs(part) for saving in savings(part, run.nodes, tol)]
