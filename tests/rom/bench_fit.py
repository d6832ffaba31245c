"""The cost of FIT: 8080 cycles a node over the fit examples, with the two blocks that a node makes and their punching.

`bench.py` calls `main`; alone: `PYTHONPATH=tests python tests/rom/bench_fit.py`. The limit is 900,000 cycles a node,
and what the corners at a curve's ends cost where a part has few nodes. SYM, REP and RECUT are taken out of the
programs: their copies are not nodes. Two things have columns of their own and are not FIT's: what the program takes to
compute its nodes, measured by a run that keeps them in P99 and A99 instead, and the CUT and BACK statements that begin
while no curve is open. Statements that end a curve count whole: the corner with what follows is FIT's, and so is the
block before a curve, which goes out when its first arc has come.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from measured import Measured, judge
from romhelp import EXAMPLES, ROM, RUN_LIMIT, Board, fault

from skg.board import symbols

LIMIT = 900_000
FIT_EXAMPLES = [path for path in EXAMPLES if path.stem.startswith("fit-")]
HEADING = "part                  nodes       cycles  per node  computing it  CUT beside    FIT alone"
#: The statements that cut copies of what has been cut.
COPIES = re.compile(r"^\d+ (?:SYM|REP|RECUT)\b.*\n", re.M)
FIT = re.compile(r"^(\d+) FIT (.*)$", re.M)
#: Other statements that cut; in the run without FIT they would find no route.
CUTTING = re.compile(r"^\d+ (?:CUT|BACK)\b.*\n", re.M)


@dataclass(frozen=True)
class Cost:
    """Nodes of a part; cycles of its RUN, of one that only computes the nodes, and of CUT and BACK beside FIT."""

    nodes: int
    cycles: int
    computing: int
    beside: int

    @property
    def fit(self) -> float:
        """Cycles a node that FIT takes."""
        return (self.cycles - self.computing - self.beside) / self.nodes


def operands(text: str) -> list[str]:
    """The operands of FIT: the node and, behind the outermost comma, its tangent."""
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


def beside(board: Board, source: str) -> int:
    """Cycles of those CUT and BACK statements of a RUN that begin while no curve is open."""
    board.load(source)
    machine, labels = board.machine, symbols(ROM.with_suffix(".sym").read_text())
    statements = {labels["SCUT"], labels["SBACK"]}
    for address in statements:
        machine.set_break(address)
    machine.type("RUN\r")
    cycles = 0
    while machine.run(RUN_LIMIT) == "break":
        at, start, back = machine.registers["pc"], machine.cycles, machine.peek16(machine.registers["sp"])
        curve = machine.peek(labels["FITN"], 1) != b"\0"
        machine.set_break(at, False)
        machine.set_break(back)
        machine.run(RUN_LIMIT)
        machine.set_break(back, False)
        machine.set_break(at)
        cycles += 0 if curve else machine.cycles - start
    return cycles


def cost(path: Path) -> Cost | None:
    """The cost of a part; None if the ROM has no FIT. Without its copies a route may end in ERR, with all cut."""
    source = COPIES.sub("", path.read_text())
    board = Board()
    if fault(board.load(source)):
        return None
    computed = CUTTING.sub("", source)
    nodes = Board().outcome(FIT.sub(r'\1 PRINT "NODE"', computed)).paper.count("NODE")
    return Cost(nodes, run(Board(), source), run(Board(), FIT.sub(kept, computed)), beside(Board(), source))


def main() -> Measured:
    """Print the table; the most of a part."""
    print(HEADING)
    worst = 0.0
    for path in FIT_EXAMPLES:
        found = cost(path)
        if found is None:
            raise SystemExit(f"{path.stem}: this ROM has no FIT")
        worst = max(worst, found.fit)
        each, computing, cut = (n / found.nodes for n in (found.cycles, found.computing, found.beside))
        print(
            f"{path.stem:20} {found.nodes:6} {found.cycles:12,} {each:9,.0f} {computing:13,.0f} {cut:11,.0f}"
            f" {found.fit:12,.0f}"
        )
    return Measured("a node of FIT, in the part where it is most", worst, LIMIT)


if __name__ == "__main__":
    raise SystemExit(judge([main()]))
