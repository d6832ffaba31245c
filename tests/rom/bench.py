"""Costs of the examples: 8080 cycles a block, RAM and stack used, cycles of LOAD a line. `make bench-rom` prints them.

With BLOCK_LIMIT in the mean a punch of 50 characters a second never waits for the board. Parts that compute their own
points are shown, but are not in the mean: what they compute is no block's. Fitted curves have a table of their own
(bench_fit.py), cycles a node.
"""

from __future__ import annotations

import bench_fit
from measured import Measured, judge
from romhelp import EXAMPLES, Board, fault

from skg.board.feeding import TAPE_END

COMPUTED = {"set-cam", "set-gear"}
#: Cycles, at most: of a block and of a line of LOAD, in the mean of the parts.
BLOCK_LIMIT, LOAD_LIMIT = 360_000, 400_000
HEADING = "part                 blocks       cycles  per block  seconds    RAM stack to"


def main() -> list[Measured]:
    """The standard image; the one that mills; fitted curves."""
    blocks = table("skg", b"B", 3)
    print("\nskg-mill, with F and Z in front:")
    milled = table("skg-mill", b"N", 1, "1 F 250,80\n2 Z -2.5,4\n")
    print()
    return [
        Measured("a block, mean of the examples", blocks, BLOCK_LIMIT),
        Measured("a block of skg-mill", milled, BLOCK_LIMIT),
        bench_fit.main(),
        Measured("a line that LOAD takes", load_of_a_line(), LOAD_LIMIT),
    ]


def load_of_a_line() -> float:
    """Cycles, from a reader that waits; the tape ends with ctrl-Z."""
    lines = cycles = 0
    for part in EXAMPLES:
        machine, text = Board().machine, part.read_text()
        machine.tape(text + TAPE_END)
        start = machine.cycles
        machine.type("LOAD\r")
        machine.run(10**10)
        lines, cycles = lines + text.count("\n"), cycles + machine.cycles - start
    return cycles / lines


def table(kind: str, mark: bytes, marks: int, head: str = "") -> float:
    """Every example on a board of its own: RUN's cycles, not LOAD's; RAM: bytes of program and variables.

    A block of the tape has so many marks. Returns the mean.
    """
    print(HEADING)
    blocks_run = cycles_run = 0
    worst, stack = (0.0, ""), 0xFFFF
    for part in (part for part in EXAMPLES if part not in bench_fit.FIT_EXAMPLES):
        board = Board(kind=kind)
        machine = board.machine
        free = int(board.type("FREE")[0])
        if loaded := fault(board.load(head + part.read_text())):
            print(f"{part.stem:20} ERR {loaded[0]:02d} LINE {loaded[1]}")
            continue
        machine.watch()
        start = machine.cycles
        paper = board.type("RUN")
        cycles = machine.cycles - start
        if error := fault(paper):
            print(f"{part.stem:20} ERR {error[0]:02d} LINE {error[1]}")
            continue
        blocks = machine.punch.count(mark) // marks
        low = machine.lowest_sp or machine.ram_end
        print(
            f"{part.stem:20} {blocks:6} {cycles:12,} {cycles / blocks:10,.0f} {cycles / 2e6:8.1f}"
            f" {free - int(board.type('FREE')[0]):6} {low:8X}"
        )
        if part.stem in COMPUTED:
            continue
        blocks_run, cycles_run = blocks_run + blocks, cycles_run + cycles
        worst, stack = max(worst, (cycles / blocks, part.stem)), min(stack, low)
    print(
        f"mean without {' and '.join(sorted(COMPUTED))} {cycles_run / blocks_run:,.0f} cycles a block of {blocks_run}, "
        f"most {worst[0]:,.0f} ({worst[1]}), stack down to {stack:X}"
    )
    return cycles_run / blocks_run


if __name__ == "__main__":
    raise SystemExit(judge(main()))
