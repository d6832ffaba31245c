"""8080 cycles to drive the machine: for a step, and between two blocks. `make bench-rom` prints them.

Each tape of the examples by DRIVE, then each example by DRIVE 1 and RUN, at full speed and on a teletype that takes no
time. A gap is from a block's last step to the next one's first, where no key is waited for.
"""

from __future__ import annotations

from itertools import pairwise

from measured import Measured, judge
from oneblock import run_block
from test_rom import EXAMPLES, STEP_LIMIT, Driver

from skg.tape.block import Block, Tape
from skg.tape.text import read

#: Asked for in docs/spec/drive.md, cycles.
GAP_LIMIT = 1500


def spans(tape: Tape) -> list[tuple[int, int]]:
    """The first and the last step of each block; (0, -1) for a stop."""
    found, first = [], 0
    for item in tape.items:
        if isinstance(item, Block):
            steps = run_block(item).steps
            found.append((first, first + steps - 1))
            first += steps
        else:
            found.append((0, -1))
    return found


class Costs:
    """Steps, the cycles that they took, and the gaps."""

    def __init__(self) -> None:
        self.steps, self.cycles = 0, 0
        self.gaps: list[int] = []

    def add(self, board: Driver, tape: Tape) -> None:
        """Count what a board did with a tape."""
        times = board.machine.step_cycles
        blocks = spans(tape)
        assert blocks and sum(last - first + 1 for first, last in blocks) == len(times), tape.name
        for first, last in blocks:
            self.steps += max(last - first, 0)
            self.cycles += times[last] - times[first] if last > first else 0
        self.gaps += [times[b] - times[a] for (_, a), (b, last) in pairwise(blocks) if a >= 0 and last >= 0]

    def __str__(self) -> str:
        return (
            f"{self.cycles / self.steps:.1f} cycles a step of {self.steps:,} (limit {STEP_LIMIT}); between two blocks "
            f"{sum(self.gaps) / len(self.gaps):,.0f} on the mean of {len(self.gaps)}, {min(self.gaps):,} to "
            f"{max(self.gaps):,} (asked {GAP_LIMIT:,})"
        )


def main() -> list[Measured]:
    """Both ways over the examples."""
    by_tape, by_run = Costs(), Costs()
    for path in EXAMPLES:
        tape = read(str(path))
        board = Driver()
        board.go("DRIVE", path.read_text(encoding="ascii"))
        by_tape.add(board, tape)
        part = path.with_suffix(".skg")
        if not part.exists() or "TOL" in part.read_text():
            continue
        board = Driver()
        board.load(part.read_text())
        board.go("DRIVE 1")
        board.go("RUN")
        by_run.add(board, tape)
    print(f"skg-drive, DRIVE: {by_tape}")
    print(f"skg-drive, RUN:   {by_run}")
    return [
        Measured(f"a step of skg-drive, {way}", costs.cycles / costs.steps, STEP_LIMIT)
        for way, costs in (("DRIVE", by_tape), ("RUN", by_run))
    ]


if __name__ == "__main__":
    raise SystemExit(judge(main()))
