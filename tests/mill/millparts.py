"""Random programs for the milling machine: those of tests/rom/parts.py with F, Z, M, G and HOLE in between.

The added statements stand mostly where they may, now and then in an open route or with something wrong in them, so
that a good part of the programs runs to its end and some of them fail at every place where they can.
"""

from __future__ import annotations

import re
from random import Random

from curves import behind_a_corner, curve_part
from parts import decimal, point, session, signed, somewhere


def feed(rng: Random) -> str:
    """F, at times without a second feed, by a sum, or wrong."""
    one = rng.choice(
        [
            "200",
            "60",
            decimal(rng, 0.5, 3000),
            "100/3",
            "0.1+0.2",
            "0.3",
            "1E3",
            "12345.678901",
            ".001",
        ]
    )
    two = rng.choice(["", "", f",{decimal(rng, 5, 300)}", ",200", ",60"])
    if rng.random() < 0.03:
        one = rng.choice(["0", "-5", "1E8", "99999999", "99999999.7", ".0009999", "P1", "1/0"])
    return f"F {one}{two}"


def heights(rng: Random) -> str:
    """Z, at times above the travel height, or out of reach."""
    low = rng.choice(["0", "-1", "-2.5", signed(rng, 0, 8), "-0.0004", "-1/3", "SQR 2-3"])
    high = rng.choice(["", "", ",5", ",3", f",{decimal(rng, 8, 20)}", f",{low}"])
    if rng.random() < 0.03:
        high = rng.choice([",-9", ",100000", ",O"])
    return f"Z {low}{high}"


def word(rng: Random) -> str:
    """M or G."""
    if rng.random() < 0.06:
        return rng.choice(
            [
                "M 2",
                "M 30",
                "M 3,0",
                "M 3,-1",
                "M 100",
                "M 3.5",
                "G 1",
                "G 17",
                "G 4,0",
                "G 90",
                "M P",
                "M 6,1.2",
            ]
        )
    return rng.choice([
        f"M 3,{decimal(rng, 1, 24000)}", "M 3,1200", "M 4,.5", "M 5", "M 7", "M 8", "M 9", "M 0", "M 6,2",
        "M 6,7+5", "M 3,1E4/3", "G 4,.5", "G 4,1/3", "G 64,0.01", "G 61", "G 54",
    ])  # fmt: skip


def holes(rng: Random) -> str:
    """HOLE with some points."""
    return f"HOLE {','.join(point(*somewhere(rng)) for _ in range(rng.choice([1, 1, 2, 4])))}"


#: Where a statement may come: behind one of these the route is closed, or a new one has not begun.
BETWEEN = re.compile(r"\d+ (BACK|RECUT|FROM\b|SCALE\b|[A-Z]\d*=|REM)")


def mill_session(rng: Random) -> tuple[str, tuple[str, ...]]:
    """A program for the mill, and the operator's answers to its INPUTs."""
    program, answers = (curve_part(rng, [behind_a_corner]), ()) if rng.random() < 0.1 else session(rng)
    lines = []
    if rng.random() < 0.97:
        lines.append(f"1 {feed(rng)}")
    if rng.random() < 0.7:
        lines.append(f"2 {heights(rng)}")
    if rng.random() < 0.3:
        lines.append(f"3 {word(rng)}")
    for line in program.splitlines():
        lines.append(line)
        if BETWEEN.match(line) and rng.random() < 0.12 or rng.random() < 0.01:
            number = int(line.split()[0])
            kind = rng.choice([feed, heights, heights, word, holes])
            lines.append(f"{number + rng.randint(1, 4)} {kind(rng)}")
            if kind is heights and " BACK" in line and rng.random() < 0.6:
                lines.append(f"{number + 4} RECUT")
        elif "CUT" in line and rng.random() < 0.03:
            lines.append(f"{int(line.split()[0]) + 2} {feed(rng)}")
    return "\n".join([*lines, ""]), answers
