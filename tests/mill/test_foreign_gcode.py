"""G-code as others write it (drilling cycles, inches, relative places) is read as LinuxCNC reads it."""

from __future__ import annotations

import os
from pathlib import Path
from random import Random

from rs274help import calls, needs_rs274

from skg.tape import gcode_reader
from skg.tape.gcode_program import GcodeRun

SEED = os.environ.get("SKG_SEED", "1983")
PROGRAMS = int(os.environ.get("SKG_PROGRAMS", "60")) // 2

pytestmark = needs_rs274

#: A move in the plane: whether it cuts, and where it ends, µm.
Went = tuple[bool, float, float]


def theirs(text: str, folder: Path) -> list[Went]:
    """The interpreter's moves for a program, in the plane."""
    at, unit, found = (0.0, 0.0), 1.0, []
    for name, words in calls(text.encode(), folder):
        if name == "USE_LENGTH_UNITS":
            unit = 25.4 if "INCH" in words[0] else 1.0
        elif name in ("STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "ARC_FEED"):
            values = [float(word) * unit for word in words[:6]]
            end = values[0], values[1]
            if end != at or name == "ARC_FEED":
                found.append((name != "STRAIGHT_TRAVERSE", 1000 * end[0], 1000 * end[1]))
            at = end
    return found


def ours(text: str) -> list[Went]:
    """The same by our reader; a fault that stops it fails the test."""
    program, findings = gcode_reader.scan(text)
    assert not [finding for finding in findings if finding.is_fatal], (findings, text)
    found = []
    for part in program.path.parts():
        if isinstance(part, GcodeRun):
            found += [(not part.is_move, *map(float, program.path.end(n))) for n in range(part.first, part.last)]
    return found


def program(rng: Random) -> str:
    """A program of small whole numbers, with half inches and quarter turns."""
    # (a rapid as deep as anything: else what cuts no deeper than the rapids is no cut to us)
    lines = [
        "O0007 (foreign; of no use)",
        rng.choice(["G21", "G20"]) + " G90 G17 G61 F50",
        "G1 X0 Y0 Z-99",
        "X1",
        "G0 X2",
    ]
    lines.append("Z3")
    at = {"X": 2, "Y": 0, "Z": 3}
    for _ in range(rng.randint(4, 14)):
        match rng.randrange(4):
            case 0:
                letters = rng.choice(["X", "Y", "Z", "XY", "XYZ"])
                goal = {letter: rng.randint(-4, 4) for letter in letters}
                is_relative = rng.random() < 0.3
                words = "".join(f" {k}{v - at[k] if is_relative else v}" for k, v in goal.items())
                lines.append(f"G{rng.randint(0, 1)}{words}" if not is_relative else f"G91 G1{words}\nG90")
                at |= goal
            case 1 | 2:
                one, other = "X", "Y"
                r, quarter, count = rng.randint(1, 3), rng.randrange(4), rng.choice([1, 2, 3, 4])
                sense = rng.choice([1, -1])
                corner = [(r, 0), (0, r), (-r, 0), (0, -r)]
                start, end = corner[quarter], corner[(quarter + sense * count) % 4]
                centre = {one: -start[0], other: -start[1]}
                goal = {one: at[one] + centre[one] + end[0], other: at[other] + centre[other] + end[1]}
                names = {"X": "I", "Y": "J"}
                words = "".join(f" {k}{v}" for k, v in goal.items())
                if count in (1, 3) and rng.random() < 0.4:
                    words += f" R{r if count == 1 else -r}"
                else:
                    words += "".join(f" {names[k]}{v}" for k, v in centre.items())
                lines.append(f"G{3 if sense > 0 else 2}{words}")
                at |= goal
            case 3:
                up = rng.choice(["G98", "G99"])
                height, depth = rng.randint(1, 3), rng.randint(-3, 0)
                places = [(rng.randint(-4, 4), rng.randint(-4, 4)) for _ in range(rng.randint(1, 3))]
                cycle = rng.choice(["G81", "G82 P.1", "G83 Q1", "G73 Q1"])
                lines.append(f"G17 {up} {cycle} X{places[0][0]} Y{places[0][1]} Z{depth} R{height}")
                lines += [f"X{x} Y{y}" for x, y in places[1:]]
                lines.append("G80")
                at |= {"X": places[-1][0], "Y": places[-1][1], "Z": max(height, at["Z"]) if up == "G98" else height}
    return "\n".join([*lines, "G17 G1 X9 Y9", "M2"]) + "\n"


def test_what_others_write_is_read_as_linuxcnc_reads_it(tmp_path: Path) -> None:
    rng = Random(f"{SEED} foreign")
    total = 0
    for _ in range(PROGRAMS):
        text = program(rng)
        mine, other = ours(text), theirs(text, tmp_path)
        assert len(mine) == len(other), text
        for n, (a, b) in enumerate(zip(mine, other, strict=True)):
            assert a[0] == b[0] and max(abs(a[1] - b[1]), abs(a[2] - b[2])) <= 1, (n, a, b, text)
        total += len(mine)
    assert total > 8 * PROGRAMS
