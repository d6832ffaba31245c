"""The image whose blocks start where the controller stands (arc_nodrift.asm), and `drift=False` of the reference.

Examples and random programs, byte for byte; what is set aside as a close call is the rule of compare.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from random import Random

import pytest
from compare import close_call, difference
from parts import part
from romhelp import EXAMPLES, Board
from test_random import MOST_ASIDE, SEED, Record

from skg.ref import run as reference
from skg.tape.simulation import simulate
from skg.tape.text import parse, scan

SHARES = range(4)
BLOCKS_A_SHARE = 400


class Driftless(Board):
    """The standard board with the other image."""

    def __init__(self) -> None:
        super().__init__(kind="skg-nodrift")


def unsound(tape: bytes) -> list[str]:
    """The findings of `skg check` in a tape's blocks (without the missing DD of a tape that an error ended)."""
    return [str(fault.finding) for fault in scan(tape)[1] if dict(fault.why.values).get("expected") != "DD"]


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: example.stem)
def test_tape(example: Path) -> None:
    text = example.read_text()
    outcome = Driftless().outcome(text)
    assert outcome.error is None, outcome.paper
    assert outcome.tape == reference(text, drift=False).tape
    assert not unsound(outcome.tape)


#: Places on a circle of 0.6 um about the origin: the first two lie, rounded, in its middle.
TINY = ["(0.000424,0.000424)", "(0.000424,-0.000424)", "(0,0.0006)", "(-0.0006,0)", "(0,-0.0006)"]


@pytest.mark.parametrize("first", TINY)
@pytest.mark.parametrize("last", TINY)
@pytest.mark.parametrize("board", [Board, Driftless])
def test_an_arc_that_starts_in_its_centre_is_none(board: type[Board], first: str, last: str) -> None:
    """It would have x and y of 0 both, which no controller understands. (Where its *end* is the centre, the standard
    ROM makes an arc of it, the reference a line: tape-3b.md says so of such circles.)
    """
    program = f"10 C1=(0,0):0.0006\n20 FROM (1,0)\n30 CUT {first},C1,{last}\n40 END\n"
    outcome = board().outcome(program)
    assert not unsound(outcome.tape), outcome.tape
    assert board is Board or outcome.tape == reference(program, drift=False).tape


#: Arcs of metres, each with its end: what is under the root is rounded, where the controller stops is not.
LARGE = [
    ("(4.634,1999.995):2000.000368", "(7.753268,-0.002936)"),
    ("(-3.2,-2999.998):2999.999707", "(-7.989169,-0.002116)"),
    ("(-3.933,3999.998):-3999.999934", "(-4.181807,-0.001926)"),
    ("(2999.997,4.234):-2999.999988", "(-0.002988,4.219574)"),
    ("(999.989,4.783):-1000.000439", "(-0.008879,7.045713)"),
]


@pytest.mark.parametrize(("circle", "end"), LARGE)
def test_a_large_radius(circle: str, end: str) -> None:
    """The line back to where the arc began starts where the controller stands, whatever the radius."""
    program = f"FROM (0,0)\nCUT (0,0),{circle},{end},(0,0)\nEND\n"
    outcome = Driftless().outcome(program)
    assert outcome.tape == reference(program, drift=False).tape


def place(xy: Sequence[float]) -> str:
    """A point as SKG has it, mm."""
    x, y = xy
    return f"({x:f},{y:f})"


#: Rounded squares: the first corner's centre, the straight edges' length, the corners' radius.
ROUNDED = [
    (187.110182, -15.501277, 10579.535265, 3576.615529),
    (387.265105, -364.654023, 652.972404, 384.464535),
    (470.264037, 409.222728, 179.686856, 188.614272),
    (321.550145, -180.215997, 161.872937, 394.864596),
]


@pytest.mark.parametrize(("x", "y", "edge", "radius"), ROUNDED)
@pytest.mark.parametrize("clockwise", [False, True])
def test_large_quarter_turns(clockwise: bool, x: float, y: float, edge: float, radius: float) -> None:
    """Arcs from axis to axis are taken exactly at any radius: the route closes, and no close call is set aside."""
    corners = [(x, y), (x + edge, y), (x + edge, y + edge), (x, y + edge)]
    outwards = [(0, -1), (1, 0), (0, 1), (-1, 0)]
    turns = [(corner, outwards[i], outwards[(i + 1) % 4]) for i, corner in enumerate(corners)]
    if clockwise:
        turns = [(corner, after, before) for corner, before, after in reversed(turns)]
    cuts = []
    for centre, *ends in turns:
        before, after = ([c + radius * d for c, d in zip(centre, end, strict=True)] for end in ends)
        cuts += [place(before), f"{place(centre)}:{-radius if clockwise else radius:f}", place(after)]
    cuts.append(cuts[0])
    lines = [f"FROM {cuts[0]}", *(f"CUT {cut}" for cut in cuts), "END"]
    program = "".join(f"{number} {line}\n" for number, line in enumerate(lines, 1))
    result = reference(program, drift=False)
    assert Driftless().outcome(program).tape == result.tape
    assert not close_call(result)
    assert simulate(parse(result.tape, "part")).closed


@pytest.mark.parametrize("share", SHARES)
def test_parts(share: int, record_property: Record) -> None:
    rng = Random(f"{SEED} no drift {share}")
    blocks = programs = arcs = 0
    aside = []
    while blocks < BLOCKS_A_SHARE:
        program = part(rng)
        result = reference(program, drift=False)
        found = difference(Driftless().outcome(program), result)
        reason = close_call(result) if found else ""
        assert not found or reason, f"{found}\n\n{program}"
        assert not unsound(result.tape), f"{unsound(result.tape)}\n\n{program}"
        programs += 1
        blocks += result.tape.count(b"G")
        arcs += result.tape.count(b"R")
        aside += [reason] if reason else []
    assert arcs > blocks / 10
    assert len(aside) <= max(2, MOST_ASIDE * programs), aside
    record_property("compared", ("blocks without drift", blocks, programs, len(aside)))
