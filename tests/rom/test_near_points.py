"""Points up to 3 um apart, wherever a route comes to a place twice: firmware against reference.

Which of two points stays that are one, and what becomes of the lines and arcs beside them, with an offset and without,
closed and open, behind SYM, REP, RECUT and FIT. Another seed: SKG_SEED=text, more programs: SKG_NEAR=number.
"""

from __future__ import annotations

import os
from random import Random

from hunt import Bowl, judge, shrink

SEED = os.environ.get("SKG_SEED", "near points")
PROGRAMS = int(os.environ.get("SKG_NEAR", "120"))
#: mm: on both sides of the micrometre within which points are one.
GAPS = (0, 0.0002, 0.0004, 0.0005, 0.0006, 0.0008, 0.00099, 0.001, 0.0011, 0.0013, 0.002, 0.003)
#: mm along each axis; steps from corner to corner.
WAYS = ((1, 0), (0, 1), (-1, 0), (0, -1), (0.6, 0.8), (-0.8, 0.6))
STEPS = ((5, 0), (0, 5), (-10, 0), (0, -10), (3, 4), (-4, 3), (6, -8), (7, 9), (-15, -35), (12, 5), (-12, 9))
AGAIN = ("SYM X", "SYM Y:5", "REP 2,90", "REP 3,120", "REP 2,180:(5,5)")
ENDS = (["BACK"], ["BACK"], ["END"], ["FROM (9,9)", "CUT O,(1,0)"], ["BACK", "R=0.2", "RECUT"], ["BACK", "RECUT"])


def program(random: Random) -> str:
    """Corners, half circles through some; a corner, the first one at last, comes again a little off now and then."""
    pick = random.choice

    def near(x: float, y: float) -> str:
        gap, (dx, dy) = pick(GAPS), pick(WAYS)
        return f"({x + gap * dx:.9g},{y + gap * dy:.9g})"

    x, y = first = pick((0, 3, 15, -4)), pick((0, 5, 15, -3))
    items = [f"({x},{y})"]
    for _ in range(random.randint(1, 4)):
        dx, dy = pick(STEPS)
        if random.random() < 0.25:
            items.append(f"{pick(('', '-'))}(({x + dx / 2},{y + dy / 2})/({x},{y}))")
        elif len(items) > 2 and items[-1].count(",") == 1 and random.random() < 0.12:
            items.append("0.5")
        x, y = x + dx, y + dy
        items.append(near(x, y) if random.random() < 0.4 else f"({x},{y})")
        items += [near(x, y)] * (random.random() < 0.2)
    if random.random() < 0.6:
        items += [near(*first) for _ in range(pick((1, 1, 2)))]
    lines = [f"R={pick(('0.5', '-0.5', '0.1', '-0.1', '2', '0.001'))}"] * (random.random() < 0.7)
    lines += [f"FROM {near(*first)}"] * (random.random() < 0.3)
    if random.random() < 0.15:
        lines += [f"FIT {item}" for item in items if item.count("(") == 1]
    else:
        lines.append(f"CUT {pick(',;').join(items)}")
    lines += [pick(AGAIN)] * (random.random() < 0.25)
    return "".join(f"{10 * n} {line}\n" for n, line in enumerate([*lines, *pick(ENDS)], start=1))


def test_points_that_are_nearly_one() -> None:
    blocks = 0
    for number in range(PROGRAMS):
        bowl = Bowl(program(Random(f"{SEED} {number}")), ())
        kind, verdict = judge(bowl)
        if verdict.difference:
            small = shrink(bowl, kind)
            raise AssertionError(f"program {number} of {SEED}: {judge(small)[1].difference}\n{small}")
        blocks += verdict.blocks
    assert blocks > 4 * PROGRAMS
