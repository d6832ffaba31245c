"""LinuxCNC's interpreter, where `make rs274` has got it: what it makes of a tape."""

from __future__ import annotations

import os
import re
import subprocess
from decimal import Decimal
from pathlib import Path

import pytest
from isohelp import Move

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "build" / "linuxcnc"
RS274 = FOLDER / "usr" / "bin" / "rs274"
LIBRARIES = os.pathsep.join(str(FOLDER / "usr" / "lib" / name) for name in ("", "x86_64-linux-gnu"))

needs_rs274 = pytest.mark.skipif(not RS274.exists(), reason="no LinuxCNC: make rs274")

CALL = re.compile(r"(?m)^ *\d+ N\S* +([A-Z_0-9]+)\(([^)]*)\)")


#: Said of every file, on standard error.
NOISE = "executing\n"


class Refused(AssertionError):
    """The interpreter did not take the tape."""


def calls(tape: bytes, folder: Path) -> list[tuple[str, list[str]]]:
    """The canonical calls that the interpreter makes of a tape, with their arguments."""
    part, tools, variables = folder / "tape.ngc", folder / "tools.tbl", folder / "variables"
    part.write_bytes(tape)
    tools.write_text("".join(f"T{n} P{n} D1\n" for n in range(1, 100)))
    variables.write_text("")
    # It keeps its tool table in $HOME/.tool.mmap and cuts the file short at its start: two that run at a time
    # under one home end each other by SIGBUS.
    done = subprocess.run(
        [RS274, "-g", "-t", tools, "-v", variables, part],
        env={**os.environ, "LD_LIBRARY_PATH": LIBRARIES, "HOME": str(folder.absolute())},
        capture_output=True,
        text=True,
    )
    if done.returncode not in (0, 1) or "PROGRAM_END" not in done.stdout or done.stderr.replace(NOISE, "").strip():
        raise Refused(f"exit {done.returncode}: {done.stderr}{done.stdout[-300:]}")
    return [(name, [word.strip() for word in arguments.split(",")]) for name, arguments in CALL.findall(done.stdout)]


def um(number: str) -> int:
    """Millimetres as whole µm; the interpreter writes four decimals, of which the last is 0 on our tapes."""
    value = Decimal(number) * 1000
    assert abs(value - round(value)) < Decimal("0.2"), number
    return round(value)


def moves(tape: bytes, folder: Path) -> list[Move]:
    """The moves that the interpreter makes of a tape, in the shape of `isohelp.moves`."""
    found: list[Move] = []
    feed = 0.0
    for name, words in calls(tape, folder):
        match name:
            case "SET_FEED_RATE":
                feed = float(words[0])
            case "STRAIGHT_TRAVERSE":
                found.append(Move(0, tuple(map(um, words[:3]))))
            case "STRAIGHT_FEED":
                found.append(Move(1, tuple(map(um, words[:3])), feed=feed))
            case "ARC_FEED":
                x, y, cx, cy = map(um, words[:4])
                turns = int(words[4])
                assert turns in (1, -1)
                found.append(Move(3 if turns > 0 else 2, (x, y, um(words[5])), (cx, cy), feed))
    return found


def same(ours: list[Move], theirs: list[Move]) -> None:
    """Fail where a move differs; a height or place that is not known is 0 there, where their machine stands."""
    assert len(ours) == len(theirs)
    for n, (a, b) in enumerate(zip(ours, theirs, strict=True), start=1):
        end = tuple(value or 0 for value in a.end)
        assert (a.g, end, a.centre) == (b.g, b.end, b.centre), n
        assert (a.feed is None) == (b.feed is None) and abs((a.feed or 0) - (b.feed or 0)) < 1e-4, n
