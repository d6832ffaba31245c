"""Short ways to ask the reference."""

from __future__ import annotations

import re
from math import isqrt

from skg.ref import Result, run


def program(*lines: str) -> str:
    """A program of the given statements, numbered 10, 20, …"""
    return "\n".join(f"{10 * n} {line}" for n, line in enumerate(lines, start=1))


def cut(*lines: str) -> Result:
    """The result of a program of the given statements."""
    return run(program(*lines))


def blocks(*lines: str) -> list[str]:
    """The tape of a program of the given statements, which must not fail."""
    result = cut(*lines)
    assert result.error is None, result.paper
    return result.tape.decode().split()


def value(expression: str, *before: str) -> str:
    """The text that PRINT writes for an expression."""
    result = cut(*before, f"PRINT {expression}")
    assert result.error is None, result.paper
    return result.paper.rstrip("\n")


BLOCK = re.compile(r"B(\d+)B(\d+)B(\d+)G([XY])(L|NR|SR)([1-4])")
#: Signs of (x, y) in each quadrant.
SIGNS = {1: (1, 1), 2: (-1, 1), 3: (-1, -1), 4: (1, -1)}


def arc_end(x: int, y: int, j: int, axis: str, z: str, quadrant: int) -> tuple[int, int]:
    """End minus start of an arc block, as a controller finds it: by walking J along the count axis.

    The other coordinate follows from the radius, so it may be out by a micrometre or so.
    """
    sx, sy = SIGNS[quadrant]
    start = [sx * x, sy * y]
    radius = (isqrt(4 * (x * x + y * y)) + 1) // 2
    g = "XY".index(axis)
    at, left, q = start[g], j, quadrant
    while True:
        # Within a quadrant each coordinate runs between 0 and the radius; outwards or inwards by the sense.
        outwards = (g == 0) == ((q in (2, 4)) == (z == "NR"))
        target = SIGNS[q][g] * radius if outwards else 0
        if left <= abs(target - at):
            break
        left -= abs(target - at)
        at = target
        q = q % 4 + 1 if z == "NR" else (q - 2) % 4 + 1
    at += left if target > at else -left
    other = isqrt(max(0, x * x + y * y - at * at))
    end = [0, 0]
    end[g], end[1 - g] = at, SIGNS[q][1 - g] * other
    return end[0] - start[0], end[1] - start[1]


def move(block: str) -> tuple[int, int]:
    """End minus start of a block in µm (0, 0 for D and DD)."""
    if block in ("D", "DD"):
        return 0, 0
    match = BLOCK.fullmatch(block)
    assert match, block
    x, y, j = (int(match[n]) for n in (1, 2, 3))
    quadrant = int(match[6])
    if match[5] == "L":
        sx, sy = SIGNS[quadrant]
        return sx * x, sy * y
    return arc_end(x, y, j, match[4], match[5], quadrant)
