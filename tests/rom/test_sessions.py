"""Typed sessions (sessions.py), firmware against model: what a session keeps behind errors, edits, GOTO and RUN.

400 sessions, and 30 at each of the other images; another seed: SKG_SEED=text, more of them: SKG_SESSIONS=number.
"""

from __future__ import annotations

import os
from collections import Counter

import pytest
from sessions import MODELS, by_model, difference, session, shrunk

SEED = os.environ.get("SKG_SEED", "sessions")

#: The work is cut into shares, so that several test processes can take them.
SHARES = range(2)
SESSIONS_A_SHARE = int(os.environ.get("SKG_SESSIONS", "400")) // len(SHARES)


def check(number: int, kind: str = "skg") -> None:
    """Board and model agree in a session."""
    lines = session(SEED, number, kind)
    if difference(lines, kind):
        small = shrunk(lines, kind)
        pytest.fail(f"session {number} of {SEED}: {small}\n{difference(small, kind)}")


@pytest.mark.parametrize("share", SHARES)
def test_sessions(share: int) -> None:
    for number in range(share * SESSIONS_A_SHARE, (share + 1) * SESSIONS_A_SHARE):
        check(number)


@pytest.mark.parametrize("kind", [kind for kind in MODELS if kind != "skg"])
def test_sessions_at_other_images(kind: str) -> None:
    for number in range(SESSIONS_A_SHARE * 3 // 20):
        check(number, kind)


def test_sessions_hold_what_is_looked_for() -> None:
    """Errors of all kinds with a route open, cuts behind errors, re-positionings, runs."""
    seen: Counter[str] = Counter()
    for number in range(300):
        lines = session(SEED, number)
        failed = False
        for line, (tape, paper) in zip(lines, by_model(lines), strict=False):
            seen["blocks behind an error"] += failed and b"B" in tape
            seen["stop at an error"] += bool(paper) and paper[-1].startswith("ERR") and tape.endswith(b"D\r\n")
            seen["re-positioning"] += line.startswith("FROM") and tape.startswith(b"D\r\n")
            seen["run"] += line.startswith("RUN") and b"DD" in tape
            seen["a break at a block"] += "^C" in line and paper[-1:] == ["ERR 10"] and b"B" in tape
            seen["an answer"] += any(row.startswith("? ") and row != "? " for row in paper)
            if paper and paper[-1].startswith("ERR"):
                seen[paper[-1][:6]] += 1
                failed = True
    assert all(count >= 5 for count in seen.values()), seen
    assert len(seen) >= 11, seen


@pytest.mark.parametrize(
    "lines",
    [
        # FROM that does not fit leaves the wire where it is, and the next one is the first.
        ["FROM (25,200000)", "FROM (25,200)", "FROM (1,1)"],
        ["CUT O,(10,0)", "FROM (25,200000)", "FROM (25,200000)", "FROM (1,1)"],
        # A block that does not fit leaves it, too.
        ["C=(40000,0):40000", "CUT (0,0),C,(40000,40000)", "FROM (1,1)", "FROM (2,2)"],
        # RUN of no line clears nothing; a line that is taken out gives up the route.
        ["A=1", "FROM (10,10)", "RUN 55", "PRINT A", "FROM (20,0)"],
        ["CUT O,(10,0)", "RUN 55", "CUT O,(0,10)", "END"],
        ["10 A=1", "CUT O,(10,0)", "10", "CUT (10,10)", "BACK"],
        ["CUT O,(10,0)", "10", "CUT (10,10)", "BACK"],
        # FROM whose move does not fit, from a start hole and from a route's end.
        ["FROM (-60000,0)", "FROM (60000,0)", "FROM (30000,5)", "CUT (0,5),(1,1)", "END"],
        ["CUT O,(-50000,0)", "FROM (50000,0)", "FROM (49999.999,0)", "CUT X,Y", "BACK"],
        # A break behind a block: the wire is at its end, the route is over, BACK's as well.
        [
            "CUT O,(10,0),(10,10)\t^C 1",
            "BACK",
            "FROM (1,1)",
            "CUT O,(9,0),(9,9)",
            "BACK\t^C 3",
            "RECUT",
            "FROM O\t^C 1",
        ],
        ["FROM O", "FROM (5,5)\t^C 1", "CUT (6,6),(7,6)", "BACK"],
        ["10 INPUT P,A", "20 CUT O,P,(A,A),(A,0)", "RUN\t? 1/0\t? (3,0)\t? 4\t^C 2", "PRINT P,A", "GOTO 20"],
        # An item of DATA that is refused is not used up.
        ["10 DATA (1,2),3", "READ A", "READ P,A", "PRINT P,A"],
        # A program gone on with behind an error.
        ["10 FROM O", "20 CUT O,(10,0),(10,10)", "30 CUT Q", "40 BACK", "RUN", "30 REM", "GOTO 40", "GOTO 20"],
        ["RUN", "CUT O,(1,0)", "RUN", "CUT O,(1,0)", "END"],
    ],
)
def test_a_session(lines: list[str]) -> None:
    assert not difference(lines)
