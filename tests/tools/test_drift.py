"""Blocks that start where the controller stands: they close, they stay near, and what no block could do better."""

from __future__ import annotations

from math import atan2, ceil, cos, floor, hypot, pi, sin
from pathlib import Path

import numpy as np
import pytest
from drifthelp import EXAMPLES, OPEN, Curve, farthest, followed, stepped, steps
from facthelp import says
from hypothesis import given, settings
from hypothesis import strategies as st
from oneblock import run_block
from toolhelp import ROOT, Run

from skg import tape as tapes
from skg.messages.finding import Phrase
from skg.ref import run as reference
from skg.ref.drift import arc
from skg.ref.tape import Grid, quadrant_into
from skg.tape import Block, parse
from skg.tape.simulation import simulate

#: µm; docs/drift.md says why it cannot be 1.
FARTHEST = 2.41
DRIFT_PAGE = ROOT / "docs" / "drift.md"
TABLE_HEAD = "| part | gap | off | without drift: off |\n|---|---|---|---|\n"

#: In one process: the same paths are measured for the page and for what it says.
pytestmark = pytest.mark.xdist_group("drift")
examples = pytest.mark.parametrize("part", EXAMPLES, ids=lambda part: part.stem)


@examples
def test_the_wire_is_where_the_tape_takes_it_to_be(part: Path) -> None:
    """Whatever the controller makes of a block, the next one starts there; so every route closes to 0 µm."""
    path = steps(part, drift=False)
    at = path[0].before
    for step in path:
        assert step.before == at
        if step.block:
            x, y = stepped(step.block, at)[-1]
            at = int(x), int(y)
        assert step.after == at
        assert max(abs(at[0] - step.curve.end[0]), abs(at[1] - step.curve.end[1])) < 2
    tape = tapes.parse(followed(part, drift=False)[1])
    assert [problem for block in tape.blocks for problem in block.problems()] == []
    if part.stem not in OPEN:
        assert simulate(tape).closed


@examples
def test_largest_distance(part: Path) -> None:
    """No place of the controller is farther from the exact path than without the correction, none than 2.41 µm."""
    with_drift, without = farthest(part, drift=True)[0], farthest(part, drift=False)[0]
    assert without <= min(FARTHEST, with_drift + 1e-9)


def test_what_drift_does() -> None:
    """The figures that docs/drift.md gives for its two worst examples."""
    found = {name: farthest(ROOT / "examples" / f"{name}.skg", drift=True) for name in ("fit-gear", "fit-epicycloid")}
    assert {name: round(far, 1) for name, (far, _) in found.items()} == {"fit-gear": 18.6, "fit-epicycloid": 10.3}
    assert found["fit-epicycloid"][1] == (5, -9)


def least_farthest(circle: Curve, reach: float, spread: int) -> tuple[float, Grid, Grid]:
    """The best that one block can do for a whole circle: the largest distance, and centre and start that give it.

    Every whole centre up to `spread` µm off on each axis and every start up to `reach` µm from the exact one,
    each followed all the way round. J only says where the controller stops: the last 3 µm are left out, so no J
    that goes round does better.
    """
    (xc, yc), (xs, ys) = circle.centre, circle.start
    radius, first = hypot(xs - xc, ys - yc), atan2(ys - yc, xs - xc)
    around = [
        (x, y)
        for x in range(floor(xc) - spread, floor(xc) + spread + 2)
        for y in range(floor(yc) - spread, floor(yc) + spread + 2)
    ]
    starts = [
        (x, y)
        for x in range(ceil(xs - reach), floor(xs + reach) + 1)
        for y in range(ceil(ys - reach), floor(ys + reach) + 1)
        if hypot(x - xs, y - ys) <= reach
    ]
    best = (np.inf, (0, 0), (0, 0))
    for centre in around:
        for start in starts:
            x, y = start[0] - centre[0], start[1] - centre[1]
            block = Block(abs(x), abs(y), 0, "X", f"NR{quadrant_into(x, y)}")
            block = Block(block.x, block.y, 4 * block.turn, "X", block.code)
            to = stepped(str(block), start) - (xc, yc)
            off = abs(np.hypot(*to.T) - radius)
            if off.max() >= best[0]:
                far = to[off >= best[0]]
                turned = (np.arctan2(far[:, 1], far[:, 0]) - first) % (2 * pi)
                if (turned < 2 * pi - 3 / radius).any():
                    continue
            turned = (np.arctan2(to[:, 1], to[:, 0]) - first) % (2 * pi)
            best = (float(off[turned < 2 * pi - 3 / radius].max()), centre, start)
    return best


def test_no_block_can_keep_within_a_micrometre() -> None:
    """A hole of examples/gosub-holes.skg: its centre lies 0.365 µm off the grid, and 1.365 µm is the best."""
    hole = next(
        step
        for step in steps(ROOT / "examples" / "gosub-holes.skg", drift=False)
        if step.curve.sweep > 6 and abs(step.curve.centre[1] % 1 - 0.635) < 0.001
    )
    best, centre, start = least_farthest(hole.curve, reach=1.5, spread=2)
    assert best == pytest.approx(1.3648, abs=1e-4)
    # It is what the tape does: the nearest centre.
    assert hypot(centre[0] - hole.curve.centre[0], centre[1] - hole.curve.centre[1]) < 0.5
    assert hole.curve.off(stepped(hole.block, hole.before).astype(float)).max() == pytest.approx(best, abs=1e-3)
    # A centre farther off than these has the circle's far side 2 µm off or more, whatever the radius.
    assert abs(start[0] - hole.curve.start[0]) <= 1.5


@st.composite
def arcs(draw: st.DrawFn) -> tuple[Grid, Grid, bool, float]:
    """Start up to 1.5 µm and end up to 0.5 µm off an arc's ends, about its centre; clockwise; sweep."""
    radius = draw(st.sampled_from((8, 20, 100, 1000, 30_000))) * draw(st.floats(1, 3))
    first = draw(st.integers(0, 7)) * pi / 4 + draw(st.sampled_from((0, 1))) * draw(st.floats(0, 0.8))
    sweep = draw(st.one_of(st.floats(0.001, 2 * pi), st.integers(1, 8).map(lambda k: k * pi / 4)))
    clockwise = draw(st.booleans())
    last = first - sweep if clockwise else first + sweep
    slack = st.floats(-1, 1)
    (xs, ys), (xe, ye) = (
        (round(radius * cos(turn) + off * draw(slack)), round(radius * sin(turn) + off * draw(slack)))
        for turn, off in ((first, 1.1), (last, 0))
    )
    return (xs, ys), (xe, ye), clockwise, sweep


@given(arcs())
@settings(max_examples=200)
def test_any_arc_ends_where_it_is_said_to(given_arc: tuple[Grid, Grid, bool, float]) -> None:
    start, end, clockwise, sweep = given_arc
    made = arc(start, end, clockwise, sweep > pi)
    if made is None:
        # Flat: the chord is within a quarter of a µm of the arc.
        assert hypot(end[0] - start[0], end[1] - start[1]) ** 2 <= 2 * hypot(*start) + 1
        return
    text, move = made
    assert run_block(parse(f"{text}\r\nDD\r\n".encode()).blocks[0]).move == move
    # Nearly round, or from the bisector: not farther from the end than start and roundings explain. 5 is reached
    # where both ends lie on a diagonal, 7 on circles of 8 µm (millions of such arcs were tried).
    off = hypot(start[0] + move[0] - end[0], start[1] + move[1] - end[1])
    assert off <= (7 if hypot(*start) < 25 else 5)
    if sweep < 1.5 * pi - 0.3 and hypot(*start) > 50:
        radial = hypot(start[0] + move[0], start[1] + move[1]) - hypot(*end)
        assert abs(radial) < 2.5


def test_command_line(run: Run, tmp_path: Path) -> None:
    part = ROOT / "examples" / "skg06-belts.skg"
    tape = tmp_path / "belts.nodrift.3b"
    assert run("ref", "--no-drift", part, "-o", tape).exit_code == 0
    assert tape.read_bytes() != part.with_suffix(".3b").read_bytes()
    assert run("check", tape).exit_code == 0
    closed = run("sim", "--strict-close", tape)
    assert closed.exit_code == 0
    assert says(closed.output, Phrase("sim-path", closing=Phrase("path-closes"))) and says(
        closed.output, Phrase("sim-ends", misses=0, largest=0, drift=0)
    )
    assert run("sim", "--strict-close", part.with_suffix(".3b")).exit_code == 1
    # As programmed, the blocks' own ends do not add up: their centres have been moved.
    assert says(run("sim", "--positions", "machine", tape).output, Phrase("sim-ends", misses=0, largest=0, drift=0))
    assert not says(run("sim", "--positions", "programmed", tape).output, "drift", "0 µm")
    assert run("ref", "--drift", part, "-o", tape).exit_code == 0
    assert tape.read_bytes() == part.with_suffix(".3b").read_bytes()


def test_cad_tape_is_for_the_standard() -> None:
    """J of the CAD package's own arc counts the rounded radius: with drift, byte for byte."""
    text = (ROOT / "examples" / "cad-tape.skg").read_text()
    assert b"B50100B100B100000GYNR1" in reference(text).tape
    assert b"B50100B100B100002GYNR1" in reference(text, drift=False).tape


def row(part: Path) -> str:
    """The line of docs/drift.md for a part."""
    gap = simulate(tapes.read(str(part.with_suffix(".3b")))).gap
    shown = "open" if part.stem in OPEN else f"{gap[0]}, {gap[1]}"
    return f"| {part.stem} | {shown} | {farthest(part, drift=True)[0]:.2f} | {farthest(part, drift=False)[0]:.2f} |"


def test_bytes_of_the_rule() -> None:
    """The page's number of bytes for the rule is right; unused bytes of an image are FF."""
    standard, without = (
        len((ROOT / f"roms/{name}.bin").read_bytes().rstrip(b"\xff")) for name in ("skg", "skg-nodrift")
    )
    assert f"| bytes of ROM | | {without - standard} more |" in DRIFT_PAGE.read_text()


def test_table_of_the_manual() -> None:
    text = DRIFT_PAGE.read_text()
    assert text[text.index(TABLE_HEAD) + len(TABLE_HEAD) :].split("\n")[:-1] == list(map(row, EXAMPLES))


def write_table() -> None:
    """Put the measured table into docs/drift.md."""
    text = DRIFT_PAGE.read_text()
    head = text[: text.index(TABLE_HEAD) + len(TABLE_HEAD)]
    DRIFT_PAGE.write_text(head + "".join(f"{row(part)}\n" for part in EXAMPLES))


if __name__ == "__main__":
    write_table()
