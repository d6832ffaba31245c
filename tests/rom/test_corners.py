"""Corners, fillets and closing where little decides: the tape or the ERR that was worked out by hand.

Firmware and reference must both give it, so that they cannot be wrong together; the image without drift, whose short
arcs are others, must end in the same ERR.
"""

from __future__ import annotations

from dataclasses import dataclass

import pytest
from romhelp import run
from test_nodrift import Driftless

from skg.ref import run as reference


@dataclass(frozen=True)
class Case:
    """Statements, one a line, and what they punch: blocks and stops, the ERR that ends the run."""

    statements: str
    tape: str
    error: int | None = None

    @property
    def program(self) -> str:
        """The statements with line numbers."""
        lines = self.statements.split("|")
        return "".join(f"{10 * n} {line.strip()}\n" for n, line in enumerate(lines, start=1))


CASES = {
    # A fillet takes away the end of the element before it: where that has just been entered there is none.
    "fillet at the entry of a circle": Case("FROM (10,0) | CUT O:5;1;X,(20,0) | END", "B5000B0B5000GXL3 D", 6),
    "fillet at a point at the entry": Case("FROM (8,6) | CUT O:5,(4,3),1,(16,12)", "B4000B3000B4000GXL3 D", 6),
    "fillet at the first point, named again": Case("CUT (-5,0),O:5,(-5,0),0.5,(-20,0)", "B5000B0B5000GXL3 D", 6),
    # It takes away the beginning of the element behind it: here as far as that goes, and further.
    "closing fillet at the entry of a circle": Case(
        "FROM (10,2) | CUT O:5;X,Y:20,(20,10),(5,0),1 | BACK",
        "B5097B1019B5097GXL3 B4903B981B19019GYNR1 B15000B0B15000GXL1 B0B10000B10000GYL2 B13692B9128B13692GXL3 "
        "B555B832B884GYSR4 D",
        6,
    ),
    "fillet longer than the arc behind it": Case(
        "CUT (20,-4),(3,-4),1,O:5,(4,-3),(20,-3)", "B20000B4000B20000GXL4 B14804B0B14804GXL3 B0B1000B1500GYSR3 D", 6
    ),
    # The micrometre behind the entry is one of the wire's path.
    "passed the entry by 1.2 um, wire outside": Case(
        "R=.5 | C=O:1 | FROM (20,0) | CUT C;Y,X:-20,-Y:-30,-X:.0012-R;C | BACK",
        "B18500B0B18500GXL3 B1500B0B1000GXNR1 B0B18086B18086GYL2 B29000B0B29000GXL1"
        " B0B19499B19499GYL4 B28000B0B28000GXL3 D",
        6,
    ),
    "fillet behind the entry, wire outside": Case(
        "R=.5 | C=O:1 | FROM (9,0) | CUT (1,0),C,(0.8660254038,0.5),2.7432,(3.3660254038,4.830127019)",
        "B7500B0B7500GXL3 D",
        6,
    ),
    # Curves that nearly touch at a point.
    "fillet of a right turn of 0.008 rad": Case(
        "C=O:-10 | FROM (-20,5) | CUT (-10,0),C,(0,10),1,(10,9.92)",
        "B10000B5000B10000GXL4 B10000B0B9996GXSR2 B0B1000B8GXSR1 B9996B80B9996GXL4 DD",
    ),
    "fillet of a left turn of 0.008 rad": Case(
        "C=O:-10 | FROM (-20,5) | CUT (-10,0),C,(0,10),1,(10,10.08)",
        "B10000B5000B10000GXL4 B10000B0B9996GXSR2 B0B1000B8GXNR4 B9996B80B9996GXL1 DD",
    ),
    "circles half a um from concentric": Case(
        "R=.02 | P=(.5,0) | C1=O:.5 | FROM (1,-1) | CUT (0,-.5),C1,P,C1#(.06:P),(0,.5)#(.06:P)",
        "B1000B480B1000GXL2 B0B520B520GYNR4 B520B1B521GXNR1 DD",
    ),
    # The line cuts 0.3 um off the circle: half its chord is the root of 10^2 - 9.9997^2, 0.0775 mm.
    "crossing by 0.3 um": Case(
        "FROM (9.9997,-5) | CUT Y:9.9997,O:10,(0,10)", "B0B5077B5077GYL2 B10000B77B10000GXNR1 DD"
    ),
    # ... and not quite 0.01 um here: that is a tangent, whose point is on the circle.
    "crossing by 0.009 um": Case(
        "FROM (9.999991,-5) | CUT Y:9.999991,O:10,(0,10)", "B0B5000B5000GYL2 B10000B0B10000GXNR1 DD"
    ),
    "SYM of one point": Case(
        "CUT (3,4) | SYM X | BACK", "B3000B4000B4000GYL1 B0B8000B8000GYL4 B0B8000B8000GYL2 B3000B4000B4000GYL3 DD"
    ),
    # The `;` before a fillet that waits makes BACK's corner a right turn: at (0,-10), not at (0,10).
    "right turn of BACK": Case(
        "FROM (20,0) | CUT Y,X:-12,-Y:-8;O:-10;1 | BACK",
        "B20000B0B20000GXL3 B0B12000B12000GYL2 B8000B0B8000GXL1 B0B18000B18000GYL4 B8000B6000B6889GXSR4"
        " B111B994B1006GYSR4 B0B8944B8944GYL2 B20000B0B20000GXL1 DD",
    ),
    "SCALE 0 with a route open": Case("CUT X | SCALE 0", "D", 5),
    "SCALE 2 with a route open": Case("CUT X | SCALE 2", "D", 6),
    "fillet between a line and a point written out": Case("CUT X,5,(20,0),Y:20", "", 1),
}


@pytest.mark.parametrize("name", CASES)
def test_case(name: str) -> None:
    case = CASES[name]
    for outcome in (run(case.program), reference(case.program)):
        assert outcome.tape.decode().split() == case.tape.split()
        assert (outcome.error or (None,))[0] == case.error
    driftless, result = Driftless().outcome(case.program), reference(case.program, drift=False)
    assert (driftless.error or (None,))[0] == case.error
    assert driftless.tape == result.tape
