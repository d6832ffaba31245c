"""Processor seconds of `skg cut`, and of viaConstructor on the same drawings where `make bench-peer` has installed it.

    PYTHONPATH=tests python tests/tools/bench.py

Seconds of the processor, the less of two runs of the whole command: what else the host does is not in them, its
speed is. The peer reads the drawing, puts an offset beside its contours and writes G-code; `skg cut` lets the board
write the tape, walks it with the controller and compares it with the drawing, too. viaConstructor is in an environment
of its own, build/peer, and no part of what is installed.
"""

from __future__ import annotations

import os
import random
import resource
import subprocess
import sys
from collections.abc import Callable
from functools import partial
from math import cos, pi, sin
from pathlib import Path
from tempfile import TemporaryDirectory

import ezdxf
from ezdxf.document import Drawing
from ezdxf.layouts import Modelspace
from measured import Measured, judge

ROOT = Path(__file__).resolve().parents[2]
SKG, PEER = Path(sys.executable).with_name("skg"), ROOT / "build" / "peer" / "bin" / "python"
PITCH, IN_A_ROW = 10.0, 25


def places(count: int) -> list[tuple[float, float]]:
    """The lower left corners of squares of a grid, mm."""
    return [(PITCH * (number % IN_A_ROW), PITCH * (number // IN_A_ROW)) for number in range(count)]


def squares(space: Modelspace, count: int = 250) -> None:
    """Squares of four lines each."""
    for x, y in places(count):
        corners = [(x, y), (x + 6, y), (x + 6, y + 6), (x, y + 6)]
        for start, end in zip(corners, corners[1:] + corners[:1], strict=True):
            space.add_line(start, end)


def circles(space: Modelspace) -> None:
    """Circles."""
    for x, y in places(500):
        space.add_circle((x + 5, y + 5), 3)


def ellipses(space: Modelspace) -> None:
    """Ellipses, no two of one shape."""
    for number, (x, y) in enumerate(places(500)):
        space.add_ellipse((x + 5, y + 5), (4, 0), 0.3 + number / 1000)


def splines(space: Modelspace) -> None:
    """Splines of 41 controls that end where they begin."""
    rng = random.Random(1)
    for x, y in places(200):
        radii = [rng.uniform(2.5, 3.5) for _ in range(40)]
        turns = [2 * pi * number / 40 for number in range(40)]
        points = [(x + 5 + r * cos(a), y + 5 + r * sin(a)) for r, a in zip(radii, turns, strict=True)]
        space.add_open_spline([*points, points[0]])


def drawn(draw: Callable[[Modelspace], None]) -> Drawing:
    """A drawing in mm."""
    drawing = ezdxf.new("R2010", units=ezdxf.units.MM)
    draw(drawing.modelspace())
    return drawing


def engraving() -> str:
    """An SVG file of 1,000 closed paths of Bézier curves."""
    rng = random.Random(2)
    paths = []
    for x, y in places(1000):
        ends = [(x + 5 + 3 * cos(pi * k / 3), y + 5 + 3 * sin(pi * k / 3)) for k in range(6)]
        beside = [tuple(c + rng.uniform(-1, 1) for c in end) for end in ends for _ in range(2)]
        curves = "".join(
            "C{:.3f},{:.3f} {:.3f},{:.3f} {:.3f},{:.3f}".format(*beside[2 * k], *beside[2 * k + 1], *ends[(k + 1) % 6])
            for k in range(6)
        )
        paths.append(f'<path d="M{ends[0][0]:.3f},{ends[0][1]:.3f}{curves}z"/>')
    head = '<svg xmlns="http://www.w3.org/2000/svg" width="250mm" height="400mm" viewBox="0 0 250 400">'
    return f"{head}{''.join(paths)}</svg>"


def processor(command: list[str | Path], result: Path) -> float:
    """Processor seconds of a command, the less of two runs, each of which must have written its result."""
    least = float("inf")
    for _ in range(2):
        result.unlink(missing_ok=True)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        environment = os.environ | {"QT_QPA_PLATFORM": "offscreen"}
        subprocess.run(command, check=True, capture_output=True, env=environment)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        assert result.stat().st_size > 1000, command
        least = min(least, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return least


def main() -> list[Measured]:
    """Seconds, and how many times as long the peer takes of the DXF drawings: no fewer than once."""
    rows: list[Measured] = []
    with TemporaryDirectory() as folder:
        drawings = {
            "250 squares as lines": (squares, ()),
            "1,000 squares, offset 0.1": (partial(squares, count=1000), ("--offset", "0.1")),
            "500 circles": (circles, ()),
            "500 ellipses": (ellipses, ()),
            "200 long splines": (splines, ()),
            "an engraving of 1,000 paths": (None, ("--open", "all")),
        }
        for name, (draw, options) in drawings.items():
            part = Path(folder) / ("part.dxf" if draw else "part.svg")
            drawn(draw).saveas(part) if draw else part.write_text(engraving())
            tape, gcode = Path(folder) / "part.3b", Path(folder) / "part.ngc"
            ours = processor([SKG, "cut", part, "-o", tape, "--quiet", *options], tape)
            rows.append(Measured(f"skg cut, s: {name}", ours, None))
            if PEER.exists() and draw in (squares, circles, ellipses):
                nothing = Path(folder) / "none.json"
                theirs = processor([PEER, "-m", "viaconstructor", "-s", nothing, "-o", gcode, part], gcode)
                rows.append(Measured("  viaConstructor takes times as long", theirs / ours, 1, at_least=True))
    if not PEER.exists():
        print("No build/peer: `make bench-peer` installs viaConstructor there, and measures it, too.")
    return rows


if __name__ == "__main__":
    raise SystemExit(judge(main()))
