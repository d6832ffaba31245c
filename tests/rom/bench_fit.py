"""What FIT costs: 8080 cycles a node over the fit examples, BASIC that computes the node and punching included.

`bench.py` calls `main`; alone: `python tests/rom/bench_fit.py`. The limit is 900,000 cycles a node. SYM, REP and
RECUT are taken out of the programs: their copies are not nodes.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from romhelp import EXAMPLES, Board, fault

LIMIT = 900_000
FIT_EXAMPLES = [path for path in EXAMPLES if path.stem.startswith("fit-")]
HEADING = "part                  nodes       cycles   per node"
#: The statements that cut copies of what has been cut.
COPIES = re.compile(r"^\d+ (?:SYM|REP|RECUT)\b.*\n", re.M)


@dataclass(frozen=True)
class Cost:
    """Nodes that a part has, and the cycles of its RUN."""

    nodes: int
    cycles: int

    @property
    def per_node(self) -> float:
        """Cycles a node."""
        return self.cycles / self.nodes


def nodes_of(source: str) -> int:
    """How many times a program carries out FIT: counted by a program that prints a mark beside each."""
    marked = re.sub(r"^(\d+) FIT .*$", r'\1 PRINT "NODE"', without_copies(source), flags=re.M)
    paper = Board().outcome(marked).paper
    return paper.count("NODE")


def without_copies(source: str) -> str:
    """A program without SYM, REP and RECUT; where its route cannot be closed then, that costs nothing."""
    return COPIES.sub("", source)


def cost(path: Path) -> Cost | None:
    """Cycles of a part's RUN without its copies; None where the ROM stops before all nodes have been cut."""
    source = path.read_text()
    board = Board()
    if fault(board.load(without_copies(source))):
        return None
    start = board.machine.cycles
    board.type("RUN")
    return Cost(nodes_of(source), board.machine.cycles - start)


def main() -> bool:
    """Print the table; whether every part keeps the limit."""
    print(HEADING)
    worst = 0.0
    for path in FIT_EXAMPLES:
        found = cost(path)
        if found is None:
            print(f"{path.stem:20} this ROM has no FIT")
            return False
        worst = max(worst, found.per_node)
        print(f"{path.stem:20} {found.nodes:6} {found.cycles:12,} {found.per_node:10,.0f}")
    print(f"most {worst:,.0f} cycles a node (limit {LIMIT:,})")
    return worst <= LIMIT


if __name__ == "__main__":
    raise SystemExit(0 if main() else 1)
