"""What FIT costs: 8080 cycles a node over the fit examples, with the two blocks that a node makes and their punching.

`bench.py` calls `main`; alone: `python tests/rom/bench_fit.py`. The limit is 900,000 cycles a node. SYM, REP and
RECUT are taken out of the programs: their copies are not nodes. What the program takes to compute its nodes is
measured by a run that keeps them in P99 and A99 instead, and stands in a column of its own.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from romhelp import EXAMPLES, Board, fault

LIMIT = 900_000
FIT_EXAMPLES = [path for path in EXAMPLES if path.stem.startswith("fit-")]
HEADING = "part                  nodes       cycles  per node  computing it    FIT alone"
#: The statements that cut copies of what has been cut.
COPIES = re.compile(r"^\d+ (?:SYM|REP|RECUT)\b.*\n", re.M)
FIT = re.compile(r"^(\d+) FIT (.*)$", re.M)
#: Other statements that cut; in the run without FIT they would find no route.
CUTTING = re.compile(r"^\d+ (?:CUT|BACK)\b.*\n", re.M)


@dataclass(frozen=True)
class Cost:
    """Nodes that a part has, the cycles of its RUN, and those of a RUN that only computes the nodes."""

    nodes: int
    cycles: int
    computing: int

    @property
    def fit(self) -> float:
        """Cycles a node that FIT takes, CUT and BACK beside it included."""
        return (self.cycles - self.computing) / self.nodes


def operands(text: str) -> list[str]:
    """What stands behind FIT: the node and, behind the outermost comma, its tangent."""
    depth = 0
    for at, letter in enumerate(text):
        depth += (letter == "(") - (letter == ")")
        if letter == "," and depth == 0:
            return [text[:at], text[at + 1 :]]
    return [text]


def kept(match: re.Match[str]) -> str:
    """A FIT as assignments of the same expressions, the second one in the next line number."""
    names = zip((0, 1), ("P99", "A99"), operands(match[2]), strict=False)
    return "\n".join(f"{int(match[1]) + n} {name}={value}" for n, name, value in names)


def run(board: Board, source: str) -> int:
    """Cycles of RUN."""
    board.load(source)
    start = board.machine.cycles
    board.type("RUN")
    return board.machine.cycles - start


def cost(path: Path) -> Cost | None:
    """What a part costs; None where the ROM has no FIT. Without its copies a route may end in ERR, with all cut."""
    source = COPIES.sub("", path.read_text())
    board = Board()
    if fault(board.load(source)):
        return None
    computed = CUTTING.sub("", source)
    nodes = Board().outcome(FIT.sub(r'\1 PRINT "NODE"', computed)).paper.count("NODE")
    return Cost(nodes, run(Board(), source), run(Board(), FIT.sub(kept, computed)))


def main() -> bool:
    """Print the table; whether every part keeps the limit."""
    print(HEADING)
    worst = 0.0
    for path in FIT_EXAMPLES:
        found = cost(path)
        if found is None:
            print(f"{path.stem:20} this ROM has no FIT")
            return False
        worst = max(worst, found.fit)
        each, computing = found.cycles / found.nodes, found.computing / found.nodes
        print(f"{path.stem:20} {found.nodes:6} {found.cycles:12,} {each:9,.0f} {computing:13,.0f} {found.fit:12,.0f}")
    print(f"most {worst:,.0f} cycles a node (limit {LIMIT:,})")
    return worst <= LIMIT


if __name__ == "__main__":
    raise SystemExit(0 if main() else 1)
