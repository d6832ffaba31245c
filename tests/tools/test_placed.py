"""Purposes of a tape's blocks: cut, way in and back, positioning. Found from the tape, compared with the reference."""

from __future__ import annotations

import re
from pathlib import Path
from random import Random

import ezdxf
import pytest
from toolhelp import Run

from skg import tape as tapes
from skg.ref import run as reference
from skg.tape.layout import CUT, WAY_BACK, WAY_IN, place
from skg.tape.simulation import simulate

#: What the reference calls a segment, by what the tools take its block for.
ROLES = {
    "entry": WAY_IN,
    "cut": CUT,
    "fillet": CUT,
    "return": WAY_BACK,
    "reposition": "positioning",
}


def purposes(tape: tapes.Tape, positions: str = "programmed") -> list[str]:
    """The purpose of each block by the tools, in order."""
    found = []
    for route in place(tape, positions=positions):
        found += ["positioning"] if route.is_move else [part for part, blocks in route.parts() for _ in blocks]
    return found


def intended(program: str) -> tuple[tapes.Tape, list[str]] | None:
    """The reference's tape of a program, and what each of its blocks is for; None of a program that is refused.

    The way into a cut that stays open is no other than the cut itself.
    """
    result = reference(program)
    if result.error:
        return None
    found: list[str] = []
    routes: list[list[str]] = [[]]
    for segment in result.path:
        if (segment.start.x, segment.start.y) == (
            segment.end.x,
            segment.end.y,
        ) and not segment.is_arc:
            continue
        role = ROLES[segment.role]
        if role in ("positioning", WAY_IN):
            routes.append([])
        routes[-1].append(role)
    for route in routes:
        is_open = WAY_BACK not in route
        found += [CUT if role == WAY_IN and is_open else role for role in route]
    return tapes.parse(result.tape), found


def program_of(statements: list[str]) -> str:
    return "".join(f"{10 * at} {statement}\n" for at, statement in enumerate([*statements, "END"], 1))


def check(statements: list[str]) -> list[str] | None:
    """Compare what the tape tells with what was meant; None of a program that is refused."""
    program = program_of(statements)
    made = intended(program)
    if made is None:
        return None
    tape, meant = made
    for positions in ("programmed", "machine"):
        assert purposes(tape, positions) == meant, program
    assert [one.is_move for one in simulate(tape).routes] == [one.is_move for one in place(tape)], program
    return meant


@pytest.mark.parametrize(
    "statements",
    [
        [
            "FROM O",
            "CUT O,(0,5)",
            "FROM (3,0)",
            "CUT (3,0),(3,5)",
            "FROM (6,0)",
            "CUT (6,0),(6,5)",
        ],
        ["FROM (0,5)", "CUT (0,5),O,(3,0),(3,5)"],
        ["FROM (0,5)", "CUT (0,5),O,(2,0):2,(4,0),(4,5)"],
        [
            "FROM (1,1)",
            "CUT O,(9,0),(9,9)",
            "BACK",
            "FROM (2,1)",
            "CUT (2,1),(4,1)",
            "FROM (4,2)",
            "CUT (4,2),(6,2)",
        ],
        [
            "FROM O",
            "CUT O,(0,5)",
            "FROM (0,5)",
            "CUT (0,5),(5,5)",
            "FROM (5,5)",
            "FROM (1,1)",
        ],
        ["FROM (1,1)", "CUT O,(9,0),(9,9)", "BACK", "RECUT"],
    ],
    ids=[
        "single lines",
        "open U",
        "U with a round bottom",
        "single lines after a contour",
        "moves of nothing",
        "twice",
    ],
)
def test_known_shapes(statements: list[str]) -> None:
    assert check(statements)


def route_of(rng: Random) -> list[str]:
    """A route of small whole numbers: a line, an open cut, a closed contour, a circle, a contour cut twice."""
    places = rng.sample([(x, y) for x in range(7) for y in range(7)], rng.randint(4, 6))
    hole, *points = (f"({x},{y})" for x, y in places)
    start, count = rng.choice([hole, points[0]]), rng.choice([2, 2, 3, 4])
    cut = f"CUT {','.join(points[:count])}"
    close = rng.choice([[], ["BACK"], ["BACK", "RECUT"]]) if count > 2 else []
    if rng.random() < 0.15:
        cut, close = f"CUT {hole}:{rng.randint(1, 3)}", ["BACK"]
    return [f"FROM {start}", cut, *close]


def test_any_routes() -> None:
    """Single lines, open cuts and contours thrown together."""
    rng, found, programs = Random("routes"), [], 0
    while programs < 150:
        meant = check([statement for _ in range(rng.randint(1, 5)) for statement in route_of(rng)])
        programs += meant is not None
        found += meant or []
    assert all(found.count(role) > 100 for role in (WAY_IN, CUT, WAY_BACK, "positioning"))


def test_drawn_as_what_they_are(run: Run, tmp_path: Path) -> None:
    """A single line between two stops and the legs of a U are cut: on the layer WIRE, and solid in the picture."""
    part = tmp_path / "part.skg"
    part.write_text(
        program_of(
            [
                "CUT O,(0,5)",
                "FROM (2,0)",
                "CUT (2,0),(2,5)",
                "FROM (4,5)",
                "CUT (4,5),(4,0),(7,0),(7,5)",
            ]
        )
    )
    drawing, picture = tmp_path / "part.dxf", tmp_path / "part.svg"
    assert run("dxf", part, "-o", drawing).exit_code == 0
    layers = [line.dxf.layer for line in ezdxf.readfile(drawing).modelspace().query("LINE")]
    assert layers == ["WIRE", "MOVES", "WIRE", "MOVES", "WIRE", "WIRE", "WIRE"]
    assert run("plot", part, "-o", picture).exit_code == 0
    dashed = re.findall(r'<g id="tape-1-route-(\d)">\s*<path[^>]*stroke-dasharray', picture.read_text())
    assert dashed == ["2", "4"]
