"""The controller against two independent models: circle geometry in floats, and one obvious step by step."""

from __future__ import annotations

import json
import os
import pty
import re
import subprocess
import sys
from math import atan2, cos, degrees, hypot, pi, sin
from pathlib import Path

import pytest
from facthelp import pattern, says
from hypothesis import given, settings
from hypothesis import strategies as st
from oneblock import run_block, trace_block
from toolhelp import ROOT, Run, timed

from skg import tape as tapes
from skg.errors import UserError
from skg.messages.finding import Phrase
from skg.tape import Block, arc_block, line_block, start_quadrant
from skg.tape.simulation import simulate

# Step towards the inside (F >= 0) and onwards (F < 0), written out for each sense and quadrant.
INSIDE = {(1, 1): (-1, 0), (1, 2): (0, -1), (1, 3): (1, 0), (1, 4): (0, 1),
          (-1, 1): (0, -1), (-1, 2): (1, 0), (-1, 3): (0, 1), (-1, 4): (-1, 0)}  # fmt: skip
ONWARDS = {(1, 1): (0, 1), (1, 2): (-1, 0), (1, 3): (0, -1), (1, 4): (1, 0),
           (-1, 1): (1, 0), (-1, 2): (0, 1), (-1, 3): (-1, 0), (-1, 4): (0, -1)}  # fmt: skip
LINE = {1: ((1, 0), (0, 1)), 2: ((0, 1), (-1, 0)), 3: ((-1, 0), (0, -1)), 4: ((0, -1), (1, 0))}


def slow_trace(block: Block) -> list[tuple[int, int]]:
    """Every position of the controller, F computed anew from the coordinates at each step."""
    x, y = block.start
    xe, ye = block.end
    square, quadrant, counted, path = x * x + y * y, block.quadrant, 0, []
    while counted < block.j:
        if block.is_line:
            dx, dy = LINE[quadrant][0 if xe * y - ye * x >= 0 else 1]
        else:
            dx, dy = (INSIDE if x * x + y * y >= square else ONWARDS)[block.sense, quadrant]
        x, y = x + dx, y + dy
        counted += abs(dx if block.axis == "X" else dy)
        path.append((x, y))
        if not block.is_line:
            odd = quadrant % 2 == 1
            shrinking = (x if odd else y) if block.sense > 0 else (y if odd else x)
            if shrinking == 0:
                quadrant = (quadrant - 1 + block.sense) % 4 + 1
    return path


def most_missed(axis: str, first: float, sweep: float) -> float:
    """The greatest error along the arc at the controller's end point, µm.

    Where the count axis passes an extreme J counts the rounded radius, but the controller may pass there 1 µm
    further out or in: that is 2 µm of J. On the count axis a step is at least √½ of the way along the arc.
    """
    odd = 0 if axis == "X" else 1
    low, high = sorted((first, first + sweep))
    passes = sum(low - 0.1 < (2 * k + odd) * pi / 2 < high + 0.1 for k in range(-8, 8))
    return (2 * passes + 1) * 2**0.5 + 3


def travel_along(axis: str, radius: float, first: float, sweep: float) -> float:
    """The travel of a coordinate on an arc: the sum over the pieces between its extremes."""
    wave = cos if axis == "X" else sin
    turns = [k * pi / 2 for k in range(-16, 17)]
    low, high = sorted((first, first + sweep))
    stations = [low, *[turn for turn in turns if low < turn < high], high]
    return radius * sum(abs(wave(b) - wave(a)) for a, b in zip(stations, stations[1:], strict=False))


@st.composite
def arcs(draw: st.DrawFn, smallest: int = 60, largest: int = 3000) -> tuple[tuple[int, int], float, int]:
    """(start about the centre, sweep in radians > 0, sense): every pair of start and end quadrants."""
    radius = draw(st.integers(smallest, largest))
    angle = (draw(st.integers(0, 3)) + draw(st.floats(0, 1))) * pi / 2
    start = round(radius * cos(angle)), round(radius * sin(angle))
    end = (draw(st.integers(0, 3)) + draw(st.floats(0, 1))) * pi / 2
    sense = draw(st.sampled_from((1, -1)))
    sweep = sense * (end - atan2(start[1], start[0])) % (2 * pi)
    if sweep * radius < 4:
        sweep = pi / 3
    return start, sweep, sense


@given(arcs())
@settings(max_examples=240)
def test_arc_against_geometry(arc: tuple[tuple[int, int], float, int]) -> None:
    start, sweep, sense = arc
    radius, first = hypot(*start), atan2(start[1], start[0])
    last = first + sense * sweep
    end = round(radius * cos(last)), round(radius * sin(last))
    if end == start:
        return
    block = arc_block(start, end, sense)
    if block.is_line:
        assert sweep * radius < 4 or (2 * pi - sweep) * radius < 4
        return
    assert block.problems() == []
    assert block.start == start
    # Geometry of the block: the end it tells, the way it counts, its sweep.
    assert max(abs(block.end[0] - end[0]), abs(block.end[1] - end[1])) <= 1
    assert block.end["XY".index(block.axis)] == end["XY".index(block.axis)]
    rounded_sweep = sense * (atan2(end[1], end[0]) - first) % (2 * pi)
    assert block.j == pytest.approx(travel_along(block.axis, radius, first, sense * rounded_sweep), abs=6)
    assert degrees(abs(block.sweep)) == pytest.approx(degrees(sweep), abs=degrees(2.5 / radius))
    # The controller: unit steps, on the circle, always onwards, J counted, and near the end.
    path = [start, *trace_block(block)]
    axis = "XY".index(block.axis)
    turned = counted = 0.0
    for (x, y), (xn, yn) in zip(path, path[1:], strict=False):
        assert abs(xn - x) + abs(yn - y) == 1
        assert abs(hypot(xn, yn) - radius) <= 1
        counted += abs((xn - x, yn - y)[axis])
        turned += atan2(x * yn - y * xn, x * xn + y * yn)
    assert counted == block.j
    assert abs(turned - sense * sweep) * radius <= most_missed(block.axis, first, sense * sweep)
    outcome = run_block(block)
    really = path[-1]
    assert outcome.move == (really[0] - start[0], really[1] - start[1])
    assert outcome.steps == len(path) - 1
    assert outcome.off_curve == pytest.approx(max(abs(hypot(*p) - radius) for p in path), abs=1e-6)


def test_every_pair_of_quadrants() -> None:
    seen = set()
    for sense in (1, -1):
        for first in range(4):
            for turn in range(1, 64):
                a, b = first * pi / 2 + 0.3, first * pi / 2 + 0.3 + sense * turn * 2 * pi / 64
                start, end = ((round(5000 * cos(t)), round(5000 * sin(t))) for t in (a, b))
                block = arc_block(start, end, sense)
                x, y = block.start
                dx, dy = run_block(block).move
                allowed = most_missed(block.axis, a, b - a)
                assert hypot(x + dx - end[0], y + dy - end[1]) <= allowed
                seen.add((sense, start_quadrant(*start, sense), start_quadrant(*end, sense)))
    assert len(seen) == 32


@given(arcs(20, 300), st.booleans())
@settings(max_examples=120)
def test_arc_against_slow_controller(arc: tuple[tuple[int, int], float, int], full: bool) -> None:
    start, sweep, sense = arc
    last = atan2(start[1], start[0]) + sense * sweep
    radius = hypot(*start)
    block = arc_block(start, start if full else (round(radius * cos(last)), round(radius * sin(last))), sense)
    assert trace_block(block) == slow_trace(block)


@given(st.integers(-400, 400), st.integers(-400, 400))
@settings(max_examples=120)
def test_line(dx: int, dy: int) -> None:
    if dx == dy == 0:
        return
    block = line_block(dx, dy)
    assert block.problems() == []
    assert block.move == (dx, dy)
    path = trace_block(block)
    assert path == slow_trace(block)
    assert path[-1] == (dx, dy), "a line always ends where it should"
    assert len(path) == abs(dx) + abs(dy)
    off = max(abs(x * dy - y * dx) / hypot(dx, dy) for x, y in path)
    assert run_block(block).off_curve == pytest.approx(off, abs=1e-9)
    assert off < 1


@given(arcs(20, 200), st.integers(-5, 5), st.integers(-5, 5))
@settings(max_examples=100)
def test_distance_from_the_path_with_drift(arc: tuple, dx: int, dy: int) -> None:
    start, _, sense = arc
    for block in (arc_block(start, (-start[0], -start[1]), sense), line_block(*start)):
        x, y = block.start
        points = [(x + dx, y + dy), *[(px + dx, py + dy) for px, py in trace_block(block)]]
        if block.is_line:
            xe, ye = block.end
            off = max(abs(px * ye - py * xe) / hypot(xe, ye) for px, py in points)
        else:
            off = max(abs(hypot(px, py) - hypot(*start)) for px, py in points)
        assert run_block(block, (dx, dy)).off_path == pytest.approx(off, abs=1e-6)


def test_circle_too_small_to_count() -> None:
    block = arc_block((1, 0), (1, 0), 1)
    assert block.j == 4
    with pytest.raises(UserError, match=pattern(Phrase("never-ends"), re.compile(r"B\d+B\d+B\d+G"))):
        run_block(block)


@pytest.mark.filterwarnings("error")
def test_far_off_a_short_line() -> None:
    """A line that is shorter than the drift in front of it."""
    tape = tapes.parse(b"B3850B4602B17082GXSR2\r\nB0B1B1GYL2\r\nDD\r\n")
    report = simulate(tape, positions="programmed")
    assert (report.largest_drift, report.off_path) == (2, pytest.approx(2, abs=1))


def test_cad_tape(run: Run, cad_tape: Path) -> None:
    report = simulate(tapes.read(str(cad_tape)), feed=10)
    assert report.programmed_gap == (-220000, 70100)
    # √(50100² + 100²) is 50100.1: the controller passes the top at 50101, J counts it as 50100.
    assert report.gap == (-220000, 70102)
    assert (report.misses, report.largest_miss) == (1, 2)
    assert report.travel == pytest.approx(189900 + 2 * 50100.0998 * (pi / 2 - 0.001996), abs=0.1)
    assert report.time == pytest.approx(report.travel / 1000 / 10 * 60)
    result = run("sim", cad_tape, "--json")
    figures = json.loads(result.output)[0]
    assert figures["gap"] == [-220000, 70102]
    assert figures["closed"] is False
    assert run("sim", cad_tape, "--strict-close").exit_code == 1
    closing = Phrase("path-open", dx=-220000, dy=70102)
    programmed = Phrase("as-programmed", closing=Phrase("path-open", dx=-220000, dy=70100))
    assert says(run("sim", cad_tape).output, Phrase("sim-path", closing=closing, more=programmed))


def test_closing_and_routes(run: Run) -> None:
    square = [line_block(*move) for move in ((1000, 0), (0, 1000), (-1000, 0), (0, -1000))]
    stop = tapes.Stop(0)
    data = tapes.to_bytes([*square, stop, line_block(5000, 100), stop, *square])
    result = run("sim", "-", stdin=data)
    assert result.exit_code == 0
    assert says(result.output, Phrase("sim-blocks", count=9, stops=Phrase("and-stops", count=2)))
    assert says(result.output, Phrase("sim-path"))
    assert says(result.output, Phrase("sim-route", first=5, last=5), Phrase("sim-move", by="5000, 100"))
    assert says(result.output, Phrase("sim-route", first=1, last=4, what=Phrase("path-closes")))
    assert says(result.output, Phrase("sim-route", first=6, last=9, what=Phrase("path-closes")))
    assert run("sim", "-", "--strict-close", stdin=tapes.to_bytes(square)).exit_code == 0


@pytest.mark.parametrize("tape", sorted((ROOT / "examples").glob("*.3b")), ids=lambda path: path.stem)
def test_examples(run: Run, tape: Path) -> None:
    """The examples' tapes are sound, each that is meant to close does, and lines never miss."""
    assert run("check", tape).exit_code == 0
    report = simulate(tapes.read(str(tape)))
    if max(map(abs, report.gap)) < 20:
        assert (0, 0) in (report.gap, report.programmed_gap)
    assert report.off_curve <= 1
    for one in report.each:
        if "GXL" in one.block or "GYL" in one.block:
            assert one.really == one.should


def test_progress_on_a_terminal_only(run_program: Run, tmp_path: Path) -> None:
    tape = tmp_path / "long.3b"
    tape.write_bytes(tapes.to_bytes([line_block(99_999_999, 99_999_998)] * 3))
    assert run_program("sim", tape).stderr == ""
    outer, inner = pty.openpty()
    process = subprocess.Popen(
        [Path(sys.executable).with_name("skg"), "sim", tape], stderr=inner, stdout=subprocess.DEVNULL
    )
    assert process.wait() == 0
    assert b"step/s" in os.read(outer, 10_000)
    for descriptor in (inner, outer):
        os.close(descriptor)


def test_speed() -> None:
    block = Block(30_000_000, 40_000_000, 80_000_000, "X", "NR1")
    ended, seconds = timed(lambda: run_block(block))
    rate = ended.steps / seconds
    assert rate > 20e6, f"{rate / 1e6:.0f} million steps a second"
