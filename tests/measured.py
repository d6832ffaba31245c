"""What the benches measure and may not pass: a row of one table, and the exit code."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Measured:
    """A cost: 8080 cycles unless `what` says otherwise. It may be `limit` at most; with `at_least`, no less."""

    what: str
    value: float
    limit: float | None
    at_least: bool = False

    @property
    def is_kept(self) -> bool:
        """Whether the limit is kept."""
        return self.limit is None or (self.value >= self.limit if self.at_least else self.value <= self.limit)

    def __str__(self) -> str:
        digits = 0 if self.value >= 100 else 1 if self.value >= 10 else 2
        bound = "" if self.limit is None else f"{'>=' if self.at_least else '<='} {self.limit:,g}"
        return f"{self.what:46} {self.value:12,.{digits}f}   {bound:>11}{'' if self.is_kept else '   PASSED'}"


def judge(rows: Sequence[Measured]) -> int:
    """Print the table; 1 when a limit is passed, else 0."""
    print()
    for row in rows:
        print(row)
    return int(not all(row.is_kept for row in rows))
