"""A controller as docs/spec/tape-3b.md and drive.md have it, slow and plain: F anew from the coordinates at each
step, no tables, nothing of the tools'. And tapes thrown together, for it and whoever else follows them."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from math import isqrt

X_STEP, X_MINUS, Y_STEP, Y_MINUS, CUTTING = 1, 2, 4, 8, 0x80

_BLOCK = re.compile(r"B(\d+)B(\d+)B(\d+)G([XY])(L|NR|SR)([1-4])")


def follow(tape: str) -> bytes:
    """The drive's steps for a tape's text, a byte each."""
    port, cuts = bytearray(), True
    for line in tape.split():
        if line == "DD":
            break
        if line == "D":
            cuts = not cuts
        else:
            port += bytes(value | CUTTING * cuts for value in steps(line))
    return bytes(port)


def steps(block: str) -> Iterator[int]:
    """The steps of one block, bit 7 off."""
    x, y, j, axis, kind, quadrant = _BLOCK.fullmatch(block).groups()
    sense, quadrant, left = {"L": 0, "NR": 1, "SR": -1}[kind], int(quadrant), int(j)
    sx, sy = signs(quadrant)
    x, y = xs, ys = sx * int(x), sy * int(y)
    if not sense:
        x = y = 0
    while left:
        if not sense:
            dx, dy = sx, sy
            # On the line or left of it: the step that leads to its right.
            along_x = (dx * dy > 0) == (y * xs - x * ys >= 0)
        else:
            dx, dy = -sense * sy, sense * sx
            # On the circle or outside: the step against its coordinate's sign.
            along_x = (dx == -sx) == (x * x + y * y >= xs * xs + ys * ys)
        x, y = (x + dx, y) if along_x else (x, y + dy)
        left -= along_x == (axis == "X")
        yield (X_STEP if along_x else Y_STEP) | (X_MINUS if dx < 0 else 0) | (Y_MINUS if dy < 0 else 0)
        # The coordinate that shrinks has come to 0: the next quadrant.
        if sense and ((dx == -sx and x == 0 and along_x) or (dy == -sy and y == 0 and not along_x)):
            quadrant = (quadrant - 1 + sense) % 4 + 1
            sx, sy = signs(quadrant)


def signs(quadrant: int) -> tuple[int, int]:
    """Of x and y in a quadrant."""
    return 1 if quadrant in (1, 4) else -1, 1 if quadrant in (1, 2) else -1


def random_tape(seed: int, blocks: int = 12, largest: int = 700) -> str:
    """Blocks of all kinds, quadrants and axes, large, small and along the axes, with pairs of stops among them.

    An arc's J is any up to four radii, so that it ends anywhere; small whole numbers come often.
    """
    dice, lines = random.Random(seed), []

    def length() -> int:
        return dice.choice((0, 1, 2, 3, 5, dice.randint(0, 12), dice.randint(0, largest), dice.randint(0, largest)))

    while len(lines) < blocks:
        x, y, quadrant, kind = length(), length(), dice.randint(1, 4), dice.choice(("L", "NR", "SR"))
        if x == y == 0:
            continue
        if kind == "L":
            axis = "X" if x > y else "Y" if y > x else dice.choice("XY")
            lines.append(f"B{x}B{y}B{max(x, y)}G{axis}L{quadrant}")
        elif (radius := isqrt(x * x + y * y)) > 4 and (x if (quadrant % 2 == 1) == (kind == "NR") else y):
            # (on smaller circles the controller may never come to J, and what shrinks at 0 is the next quadrant's)
            lines.append(f"B{x}B{y}B{dice.randint(1, 4 * radius)}G{dice.choice('XY')}{kind}{quadrant}")
    # A move between two stops, two stops with nothing between, a stop at the end.
    for at in sorted(dice.sample(range(blocks), dice.randint(0, 2)), reverse=True):
        lines[at:at] = ["D", *(["B300B40B300GXL3"] * dice.randint(0, 1)), "D"]
    return "\r\n".join([*lines, *["D"] * dice.randint(0, 1), "DD", ""])
