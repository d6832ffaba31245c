"""`skg cut`: drawings to checked tapes. The judge is shapely, which knows nothing of SKG."""

from __future__ import annotations

import re
import subprocess
import sys
import warnings
from dataclasses import replace
from itertools import pairwise
from math import asin, cos, degrees, hypot, pi, sin, tan
from pathlib import Path
from xml.etree import ElementTree

import ezdxf
import numpy as np
import pytest
import shapely
from click.testing import Result
from cuthelp import (
    LIMIT,
    apart,
    circle,
    closed,
    drawing,
    polygon,
    run_failing,
    saved,
    start_holes,
    stretches,
    values_of,
)
from ezdxf.document import Drawing
from facthelp import CARE, each_says, pattern, says
from matplotlib.backends.backend_agg import FigureCanvasAgg
from oneblock import run_block
from shapely.geometry import LineString, Point, Polygon
from toolhelp import Run, in_time

from skg import tape as tapes
from skg.board import feeding
from skg.board.feeding import feed, feed_routes, rest_of, without_numbers
from skg.errors import UserError
from skg.geometry.plane import XY
from skg.job.job import Job
from skg.job.machine import Setup
from skg.job.wanted import CutSettings
from skg.messages.finding import Phrase

#: A drawing.
BRACKET = Path(__file__).parents[2] / "docs/pictures/bracket.dxf"


def plate(page: Drawing) -> tuple[Polygon, list[Polygon]]:
    """A plate with slanted and concave corners, a round hole and a window; as shapely has them."""
    outline = polygon([(0, 0), (40, 0), (40, 12), (25, 15), (25, 30), (4, 33)], page)
    page.modelspace().add_circle((12, 10), 5)
    window = polygon([(10, 20), (20, 20), (20, 27), (14, 24), (10, 27)], page)
    return outline, [Point(12, 10).buffer(5, quad_segs=400), window]


def test_plate(run: Run, tmp_path: Path) -> None:
    """Every contour is shapely's offset of it, sharp corners included, and ends where it began."""
    page = drawing()
    outline, holes = plate(page)
    tape, program = tmp_path / "part.3b", tmp_path / "part.skg"
    result = run(
        "cut",
        saved(page, tmp_path),
        "-o",
        tape,
        "--wire",
        0.18,
        "--gap",
        0.01,
        "--program",
        program,
    )
    assert result.exit_code == 0
    assert says(result.stderr, Phrase("size-read", width=40, height=33, units="mm"))
    assert says(result.stderr, Phrase("count-holes", count=3)) and says(result.stderr, "no-drift")
    assert feed(program.read_text(), "no-drift").tape == tape.read_bytes()
    first = program.read_text().split("FROM (")[1].split(")")[0].split(",")
    wanted = [hole.buffer(-0.1, join_style="mitre") for hole in holes]
    wanted.append(outline.buffer(0.1, join_style="mitre", mitre_limit=50))
    cuts = list(stretches(tape.read_bytes(), (float(first[0]), float(first[1]))))
    assert len(cuts) == len(wanted)
    for places, shape in zip(cuts, sorted(wanted, key=lambda shape: _order(shape, cuts)), strict=True):
        assert places[0] == pytest.approx(places[-1], abs=1e-9)
        contour = LineString(places[1:-1])
        assert apart(contour, shape.exterior) < LIMIT + 0.0005


def _order(shape: Polygon, cuts: list[list[XY]]) -> int:
    return min(
        range(len(cuts)),
        key=lambda at: LineString(cuts[at]).hausdorff_distance(shape.exterior),
    )


@pytest.mark.parametrize(
    ("words", "option"),
    [
        (["cut", "--offset", 100], "--offset"),
        (["cut", "--wire", 100], "--wire"),
        (["cut", "--wire", 0.18, "--gap", 100], "--gap"),
        (["cut", "--offset", 0.1, "--passes", "100,0"], "--passes"),
        (["gear", "--module", 2, "--teeth", 20, "--offset", 100], "--offset"),
        (["cam", "--base", 20, "--lift", 8, "--offset", 100], "--offset"),
    ],
)
def test_offsets_that_no_wire_has(run: Run, words: list[object], option: str) -> None:
    drawing = [BRACKET] if words[0] == "cut" else []
    done = run(*words, *drawing)
    assert (done.exit_code, f"'{option}'" in done.stderr) == (2, True)


def test_a_wire_and_a_gap_that_together_are_too_much(run: Run) -> None:
    with pytest.raises(UserError, match=pattern(Phrase("offset-too-large", distance=5.5, most=5))):
        run("cut", "--wire", 9, "--gap", 1, BRACKET)


@pytest.mark.parametrize(
    ("words", "facts"),
    [
        (["--offset", 0.1, "--passes", "0.02,0.06,0"], ["--passes", Phrase("value-wrong", why=Phrase("value-rising"))]),
        (["--wire", "thick"], ["--wire", "'thick'"]),
        (["--feed", "1e-300"], ["--feed", "x>=0.001"]),
    ],
)
def test_odd_options_are_refused(run: Run, tmp_path: Path, words: list[object], facts: list[str]) -> None:
    done = run("cut", BRACKET, "-o", tmp_path / "part.3b", *words)
    assert (done.exit_code, says(done.stderr, *facts), [*tmp_path.iterdir()]) == (2, True, [])


@pytest.mark.parametrize(
    ("words", "facts"),
    [
        (["-o", ""], ["output: ", Phrase("empty-file-name")]),
        (["-o", "part.3b", "--sheet", ""], ["sheet: ", Phrase("empty-file-name")]),
        (
            ["-o", "part.3b", "--layer", "PRT"],
            [Phrase("layer-unknown-near", layer="PRT", near="PART", layers=("0", "Defpoints", "NOTES", "PART"))],
        ),
        (["--sheet", "-"], ["-: ", Phrase("two-on-stdout")]),
        (["-o", "-", "--program", "-"], ["-: ", Phrase("two-on-stdout")]),
    ],
)
def test_odd_names_are_refused(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: list[str], facts: list[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert says(run_failing(run, "cut", BRACKET.resolve(), *words), *facts)
    assert not [*tmp_path.iterdir()]


@pytest.mark.parametrize(
    ("words", "facts"),
    [
        (["--offset", 0.1, "--passes", "0.06,0.02"], [Phrase("last-pass-leaves", stock=0.02), "--passes"]),
        (["--offset", 0.1, "--tab", 1, "--side", "inside"], [Phrase("no-part-has-tab"), "tab"]),
        (["--start-layer", "HOLES"], [Phrase("no-start-points", layer="HOLES")]),
    ],
)
def test_options_that_do_not_do_what_they_are_for(
    run: Run, tmp_path: Path, words: list[object], facts: list[str]
) -> None:
    assert says(run("cut", BRACKET, "-o", tmp_path / "part.3b", "--quiet", *words).stderr, CARE, *facts)
    assert not says(run("cut", BRACKET, "-o", tmp_path / "part.3b", "--offset", 0.1, "--tab", 1).stderr, CARE)


def test_passes_on_the_contour(run: Run, tmp_path: Path) -> None:
    """Without an offset each contour is cut as often as is asked: the report and the sheet say so."""
    sheet = tmp_path / "sheet.svg"
    told = run("cut", BRACKET, "-o", tmp_path / "part.3b", "--passes", "0,0", "--sheet", sheet).stderr
    assert says(
        told,
        Phrase("contour-numbers", numbers=(4,)),
        Phrase("kind-outline"),
        Phrase("in-passes", count=2),
    )
    assert says(told, CARE, "--wire", "--offset", Phrase("on-the-line"))
    assert says(sheet.read_text(), Phrase("in-passes", count=2))


@pytest.mark.parametrize(
    ("shape", "words", "is_said"),
    [("round", [], True), ("round", ["--offset", 0.1], False), ("round", ["--wire", 0.2], False), ("open", [], False)],
)
def test_closed_contours_without_a_wire_are_said(
    run: Run, tmp_path: Path, shape: str, words: list[object], is_said: bool
) -> None:
    """The part comes out smaller by half the kerf: with --quiet, too. One start hole of a sheet is one."""
    page = drawing()
    if shape == "round":
        page.modelspace().add_circle((0, 0), 20)
    else:
        page.modelspace().add_line((0, 0), (20, 0))
    path, sheet = saved(page, tmp_path), tmp_path / "sheet.svg"
    told = run("cut", path, "-o", tmp_path / "part.3b", *words, "--sheet", sheet, "--quiet").stderr
    lines = [line for line in told.splitlines() if "--wire" in line and "--offset" in line]
    assert len(lines) == is_said and all(line.startswith(CARE) for line in lines)
    assert says(sheet.read_text(), Phrase("sheet-contours-and-holes", contours=1), Phrase("count-holes", count=1))


def _cost(words: list[object]) -> tuple[float, int]:
    """The seconds of CPU that a command takes, and its memory, kB.

    A small process starts it: memory is counted from the fork on, so this one's own would be taken for the command's.
    """
    text = (
        "import os, subprocess, sys; _, status, used = os.wait4(subprocess.Popen(sys.argv[1:]).pid, 0); "
        "print(used.ru_utime + used.ru_stime, used.ru_maxrss); sys.exit(status != 0)"
    )
    done = subprocess.run([sys.executable, "-c", text, *words], capture_output=True, text=True, check=True)
    seconds, kilobytes = done.stdout.split()
    return float(seconds), int(kilobytes)


def _cost_of_squares(count: int, tmp_path: Path) -> tuple[float, int]:
    """The cost (`_cost`) of the whole command for some squares, each of four lines, in rows of 100, and their frame."""
    part, tape = tmp_path / "part.dxf", tmp_path / "part.3b"
    squares = [(3 * (k % 100), 3 * (k // 100), 2) for k in range(count)]
    with part.open("w") as stream:
        stream.write("0\nSECTION\n2\nENTITIES\n")
        for x, y, side in [*squares, (-5, -5, 320)]:
            corners = [(x, y), (x + side, y), (x + side, y + side), (x, y + side)]
            for (u, v), (w, z) in zip(corners, [*corners[1:], corners[0]], strict=True):
                stream.write(f"0\nLINE\n8\nA\n10\n{u}\n20\n{v}\n11\n{w}\n21\n{z}\n")
        stream.write("0\nENDSEC\n0\nEOF\n")
    cost = _cost([Path(sys.executable).with_name("skg"), "cut", "--quiet", "--offset", "0.1", part, "-o", tape])
    assert tape.read_bytes().count(b"B") // 3 == (count + 1) * 7 + count
    return cost


def test_ten_thousand_elements(tmp_path: Path) -> None:
    """2,500 squares take no more time, each, than 625, and less than 200 MB."""
    few, _ = _cost_of_squares(625, tmp_path)
    many, kilobytes = _cost_of_squares(2500, tmp_path)
    # (contours that all looked at all others took 16 times as long, and 660 MB)
    assert many < 8 * few
    assert kilobytes < 200_000


@pytest.mark.parametrize(
    ("offset", "facts"),
    [
        (
            0.6,
            (Phrase("no-room", r=0.6, why=Phrase("room-neck", place=(15, 8.5)), fit=Phrase("fits-at-most", fit=0.5)),),
        ),
        (
            2.5,
            (
                Phrase(
                    "no-room", r=2.5, why=Phrase("room-none", place=(10, 10)), fit=Phrase("fits-at-most", fit=2.397)
                ),
                Phrase("contour-name", turn=1, kind=Phrase("kind-opening", count=1)),
            ),
        ),
    ],
)
def test_no_room_for_the_offset(run: Run, tmp_path: Path, offset: float, facts: tuple[Phrase, ...]) -> None:
    """A slot and a hole that the wire does not fit into: refused, nothing is written."""
    page = drawing()
    polygon([(0, 0), (30, 0), (30, 20), (0, 20)], page)
    if offset < 1:
        neck = [
            (10, 8),
            (20, 8),
            (20, 5),
            (25, 5),
            (25, 12),
            (20, 12),
            (20, 9),
            (10, 9),
        ]
        polygon([(5, 5), (10, 5), *neck, (10, 12), (5, 12)], page)
    else:
        page.modelspace().add_circle((10, 10), 2.4)
    result = run_failing(
        run,
        "cut",
        saved(page, tmp_path),
        "-o",
        tmp_path / "part.3b",
        "--offset",
        offset,
    )
    assert says(result, *facts, "--small leave")
    assert not (tmp_path / "part.3b").exists()


def test_wrong_tapes_are_found() -> None:
    """The check is no yes-man: a tape for another offset, one block bent, one contour left out."""
    from skg.checking.check import check
    from skg.cutting.ladder import make
    from skg.cutting.refusal import refuse
    from skg.planning.plan import plan

    corners = [(0.0, 0.0), (20.0, 0.0), (20.0, 10.0), (8.0, 14.0)]
    outline = closed(corners)
    round_hole = circle(10.0, 5.0, 3.0)
    contours = plan([outline, round_hole], [], CutSettings(offset=0.1))
    result = make(contours, Job("part"))
    assert not result.checked.faults and result.checked.off < LIMIT
    wider = plan([outline, round_hole], [], CutSettings(offset=0.105))
    assert {fault.contour for fault in check(result.tape, wider, True).faults} == {0, 1}
    # The slanted edge goes 9 µm too far up, the one after it comes back.
    slanted = re.search(rb"B(\d+)B(\d+)B\1GXL2", result.data)
    bent = result.data.replace(slanted[0], b"B%bB%dB%bGXL2" % (slanted[1], int(slanted[2]) + 9, slanted[1]))
    faults = check(tapes.parse(bent, "bent"), contours, True).faults
    assert faults and faults[0].contour == 1
    with pytest.raises(UserError, match=pattern(Phrase("wrong-stops"))):
        check(tapes.parse(result.data.replace(b"D\r\n", b"", 2), "one"), contours, True)
    # It goes 1 um too far up: nowhere off by much, but the wire does not come back to its start hole.
    open_one = result.data.replace(slanted[0], b"B%bB%dB%bGXL2" % (slanted[1], int(slanted[2]) + 1, slanted[1]))
    checked = check(tapes.parse(open_one, "open"), contours, True)
    assert not checked.faults
    with pytest.raises(
        UserError,
        match=pattern(
            Phrase("not-closed", dx=0, dy=1), Phrase("contour-name", turn=2), Phrase("kind-outline", count=1)
        ),
    ):
        refuse(checked, contours, Job("part"))


def test_what_adds_up_on_a_standard_tape_is_said(run: Run, tmp_path: Path) -> None:
    """Lenses one after the other: the controller's own places wander from the tape's; without drift none do."""
    page, tape = drawing(), tmp_path / "part.3b"
    for column in range(6):
        ends = [(10.3 * column, 0.7 * column, 0.51), (10.3 * column + 6.37, 0.7 * column + 3.11, 0.43)]
        page.modelspace().add_lwpolyline(ends, format="xyb", close=True)
    words = ["cut", saved(page, tmp_path), "-o", tape, "--offset", 0.1]
    standard = run(*words, "--rom", "standard")
    assert standard.exit_code == 0 and says(standard.stderr, CARE, Phrase("drift"), "--rom no-drift"), standard.stderr
    (said,) = values_of("drift", run, *words[1:], "--rom", "standard")
    contours = tapes.read(str(tape)).stretches()[::2]
    assert len(contours) == 6
    gone = [sum(run_block(block).move[axis] for contour in contours for block in contour) for axis in (0, 1)]
    assert 1 <= hypot(*gone) <= said["drift"] + 0.005
    assert not says(standard.stderr, Phrase("closing", count=6))
    without = run(*words).stderr
    assert not says(without, CARE) and says(without, Phrase("checked"), Phrase("closing", count=6))


def test_the_controllers_steps_count() -> None:
    """The controller's own path is compared with 3 µm and reported: on a slant it steps aside."""
    from skg.checking.check import check
    from skg.cutting.ladder import make
    from skg.planning.plan import plan

    for height, is_far in ((0.0, False), (3.7, True)):
        corners = [(0.0, 0.0), (20.0, height), (20.0, 10.0), (0.0, 10.0)]
        contour = closed(corners)
        result = make(plan([contour], [(5.0, -3.0)], CutSettings(offset=0.1)), Job("part"))
        checked = check(result.tape, plan([contour], [(5.0, -3.0)], CutSettings(offset=0.102)), True)
        assert bool(checked.faults) == is_far and (checked.off > LIMIT) == is_far
        if is_far:
            assert LIMIT < checked.faults[0].off < 0.0036


@pytest.mark.parametrize(
    ("corner", "cut_short"),
    [
        # R 0.6, and at R 0.1 around the corner; the same of the second pass, R 0.4, which the third one follows
        (
            b"B11200B0B11200GXL3 B0B11200B11200GYL4",
            b"B10700B0B10700GXL3 B0B500B500GYL4 B500B0B500GXL3 B0B10700B10700GYL4",
        ),
        (
            b"B0B10800B10800GYL2 B10800B0B10800GXL1",
            b"B0B10500B10500GYL2 B300B0B300GXL1 B0B300B300GYL2 B10500B0B10500GXL1",
        ),
    ],
)
def test_each_pass_keeps_its_own_distance(corner: bytes, cut_short: bytes) -> None:
    """A pass that goes around a corner where the last one should is found, though no part is spoiled by it."""
    from skg.checking.check import check
    from skg.cutting.ladder import make
    from skg.planning.plan import plan

    corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]
    square = closed(corners)
    contours = plan([square], [(5.0, -3.0)], CutSettings(offset=0.1, passes=(0.5, 0.3, 0.0)))
    result = make(contours, Job("part"))
    assert not result.checked.faults and len(result.checked.cuts) == 2
    corner, cut_short = (blocks.replace(b" ", b"\r\n") for blocks in (corner, cut_short))
    assert result.data.count(corner) == 1
    faults = check(tapes.parse(result.data.replace(corner, cut_short), "short"), contours, True).faults
    assert [(fault.is_into, fault.off > 0.1) for fault in faults] == [(False, True)], faults


def test_a_circle_too_many_is_found() -> None:
    """At a corner the wire goes on along the line or circle there, but not all around that."""
    from skg.checking.check import check
    from skg.cutting.ladder import make
    from skg.geometry.contour import Contour, Edge
    from skg.planning.plan import plan

    half = Contour((Edge((-5.0, 0.0), (5.0, 0.0)), Edge((5.0, 0.0), (-5.0, 0.0), (0.0, 0.0), pi)), True)
    contours = plan([half], [], CutSettings(offset=0.1))
    result = make(contours, Job("part"))
    assert not result.checked.faults
    (arc,) = re.findall(rb"B\d+B\d+B\d+G[XY]NR4\r\n", result.data)
    around = result.data.replace(arc, b"B5099B100B20400GYNR4\r\n" + arc)
    assert check(tapes.parse(around, "around"), contours, True).faults


@pytest.mark.parametrize(
    ("inner", "radius", "is_from_centre"),
    [((0.0, 0.0), 4.0, False), ((-2.0, 0.0), 2.0, False), ((5.0, 2.05), 2.0, False), ((5.0, 2.15), 2.0, True)],
)
def test_a_part_in_a_round_opening_is_left_whole(inner: XY, radius: float, is_from_centre: bool) -> None:
    """The wire begins in an opening's centre where it meets no part from there on, else aside."""
    from skg.planning.plan import plan

    contours = plan([circle(0, 0, 10), circle(0, 0, 20), circle(*inner, radius)], [], CutSettings(offset=0.1))
    (opening,) = (way for way in contours if way.is_opening and not way.number)
    lead = LineString([opening.start, opening.entry])
    assert (opening.start == (0.0, 0.0)) == is_from_centre
    assert Point(0, 0).buffer(10.001, quad_segs=400).covers(lead)
    assert lead.distance(Point(inner)) > radius + 0.1 - 1e-9


def test_a_part_that_falls_into_pieces_is_said(run: Run, tmp_path: Path) -> None:
    """A window from edge to edge, two that are one there, a square whose corners reach the edges; none does so else.

    The first part lies in the window of another one.
    """
    windows = [
        ([[(5, 0), (10, 0), (10, 10), (5, 10)]], 2),
        ([[(5, 0), (10, 0), (10, 5), (5, 5)], [(4, 5), (11, 5), (11, 10), (4, 10)]], 2),
        ([[(5, 0), (10, 5), (5, 10), (0, 5)]], 3),
        ([[(5, 0), (10, 0), (10, 9.98), (5, 9.98)]], 0),
        ([[(5, 0), (10, 5), (5, 9), (1, 5)], [(15, 1), (18, 1), (18, 10), (15, 10)]], 0),
    ]
    for corners, pieces in windows:
        page = drawing()
        polygon([(0, 0), (20, 0), (20, 10), (0, 10)], page)
        for some in corners:
            polygon(some, page)
        if corners == windows[0][0]:
            polygon([(-2, -2), (22, -2), (22, 12), (-2, 12)], page)
            polygon([(-4, -4), (24, -4), (24, 14), (-4, 14)], page)
        told = run("cut", saved(page, tmp_path), "-o", tmp_path / "part.3b", "--offset", 0.05).stderr
        found = Phrase("part-in-pieces", turn=len(corners) + 1, count=pieces)
        assert says(told, CARE, found) if pieces else not says(told, Phrase("part-in-pieces")), told


def test_a_lead_passes_no_thorn(run: Run, tmp_path: Path) -> None:
    """One pokes to 0.05 mm from where the wire would come: a look here and there does not see it."""
    page = drawing()
    polygon([(0, 0), (20, 0), (20, 15), (0, 15)], page)
    for x, y in ((10, -0.975), (6, -0.975), (14, -0.975)):
        polygon([(x + 0.05, y), (x + 1, y + 0.6), (x + 1, y - 0.6)], page)
    told = run("cut", saved(page, tmp_path), "-o", tmp_path / "part.3b", "--offset", 0.1, "--layer", "0").stderr
    assert CARE not in told and says(
        told, Phrase("order-of-cutting"), Phrase("count-outline", count=4), Phrase("count-holes", count=4)
    ), told


def test_everyone_who_is_cut_into_is_named(run: Run, tmp_path: Path) -> None:
    """Four strips nearer to each other than the wire is wide, and a pin that pokes 4 um into its way."""
    page = drawing()
    for at in range(4):
        polygon([(4.15 * at, 0), (4.15 * at + 4, 0), (4.15 * at + 4, 9), (4.15 * at, 9)], page)
    polygon([(2.013, 9.196), (3, 12), (1, 12)], page)
    words = ["cut", saved(page, tmp_path), "-o", tmp_path / "part.3b", "--offset", 0.1, "--lead", 0.5]
    refused = run_failing(run, *words)
    outline = Phrase("contour-name", kind=Phrase("kind-outline"), layers=Phrase("on-layers", layers=("0",)))
    depth, more = Phrase("depth-or-more", depth=0.1), Phrase("more-would-gouge", count=7)
    gouge = Phrase("would-gouge", name=outline, depth=depth, other=outline, more=more)
    assert says(refused, gouge, "--into cut"), refused
    told = run(*words, "--into", "cut").stderr
    gouges = values_of("gouge", run, *words[1:], "--into", "cut")
    (others,) = values_of("more-gouges", run, *words[1:], "--into", "cut")
    pairs = [(one["turn"], one["other"]) for one in [*gouges, *(pair["values"] for pair in others["pairs"])]]
    numbers = {place: at for at, place in enumerate(_bottoms(told), 1)}
    strips = [numbers[at] for at in range(4)]
    neighbours = {frozenset(two) for two in pairwise(strips)} | {frozenset((strips[0], numbers[4]))}
    assert {frozenset(two) for two in pairs} == neighbours and len(pairs) == 8, told
    depths = [round(one["depth"]["values"]["depth"], 4) for one in gouges]
    assert (depths.count(0.004), depths.count(0.05)) == (1, 3)
    assert sum(says(line, CARE, Phrase("gouge")) for line in told.splitlines()) == len(gouges)


@pytest.mark.parametrize("window", [[(15, 5), (25, 5), (25, 8), (15, 8)], [(15, 5), (20, 5), (20, 8), (15, 8)]])
def test_edges_that_are_cut_away_are_not_spoiled(run: Run, tmp_path: Path, window: list[XY]) -> None:
    """A window that reaches to the edge of the part, or past it, and into another one; then a part stands before it."""
    page = drawing()
    part = polygon([(0, 0), (20, 0), (20, 15), (0, 15)], page)
    part -= polygon(window, page) | polygon([(12, 4), (16, 4), (16, 6), (12, 6)], page)
    words = ["cut", saved(page, tmp_path), "-o", tmp_path / "part.3b", "--program", tmp_path / "part.skg"]
    told = run(*words, "--offset", 0.2).stderr
    assert says(
        told, Phrase("order-of-cutting"), Phrase("count-opening", count=2), Phrase("count-outline", count=1)
    ) and not says(told, CARE), told
    start = re.search(r"FROM \((\S+),(\S+)\)", (tmp_path / "part.skg").read_text())
    ways = list(stretches((tmp_path / "part.3b").read_bytes(), (float(start[1]), float(start[2]))))
    assert len(ways) == 3
    for way in ways:
        assert LineString(way).distance(part) == pytest.approx(0.2, abs=LIMIT)
    polygon([(20.1, 7), (23, 7), (23, 10), (20.1, 10)], page)
    saved(page, tmp_path)
    gouge = Phrase("would-gouge", depth=Phrase("depth-or-more", depth=0.2))
    assert says(run_failing(run, *words, "--offset", 0.2), gouge, "--into cut")


@pytest.mark.parametrize(
    "others",
    [
        # An island that reaches over the edge of its opening; a part as large as the first one that crosses it; an
        # island that is nearer to its window than the wire is wide, where that reaches into a second part.
        [[(2, 2), (18, 2), (18, 13), (2, 13)], [(8, 4), (18.7, 7), (8, 10)]],
        [[(5, 4), (25, 4), (25, 19), (5, 19)]],
        [
            [(21, 0), (41, 0), (41, 15), (21, 15)],
            [(15, 5), (26, 5), (26, 8), (15, 8)],
            [(23, 5.1), (25, 5.1), (25, 7), (23, 7)],
        ],
    ],
)
def test_what_crosses_and_is_no_window_is_refused(run: Run, tmp_path: Path, others: list[list[XY]]) -> None:
    """There is no side of these edges that is cut away: each would be spoiled by the other's wire."""
    page = drawing()
    for corners in ([(0, 0), (20, 0), (20, 15), (0, 15)], *others):
        polygon(corners, page)
    told = run_failing(run, "cut", saved(page, tmp_path), "-o", tmp_path / "part.3b", "--offset", 0.2)
    gouge = Phrase("would-gouge", depth=Phrase("depth-or-more", depth=0.2), more=Phrase("more-would-gouge", count=1))
    assert says(told, gouge, "--into cut"), told


def test_an_opening_that_crosses_itself_and_the_edge(run: Run, tmp_path: Path) -> None:
    """The ROM goes along it; the check must tell, whatever area such a contour has."""
    page = drawing()
    bulge = tan(pi / 8)
    corners = [
        (1, 0, 0),
        (11, 0, bulge),
        (12, 1, 0),
        (12, 13, bulge),
        (11, 14, 0),
        (1, 14, bulge),
        (0, 13, 0),
        (0, 1, bulge),
    ]
    page.modelspace().add_lwpolyline(corners, "xyb", close=True)
    corners = [(3, 1, -1), (3, 0, 0), (6, 2, 0.41421356237), (4, 2, 0), (4, 3, 1), (3, 3, 0), (3, 2, 1)]
    page.modelspace().add_lwpolyline(corners, "xyb", close=True)
    told = run_failing(run, "cut", saved(page, tmp_path), "-o", tmp_path / "part.3b", "--offset", 0.1)
    assert says(
        told,
        Phrase("no-room-crossing"),
        Phrase("contour-name", turn=1, start=(4, 2)),
        Phrase("kind-opening", count=1),
        Phrase("on-layers", layers=("0",)),
        Phrase("crosses-itself", place=(3.4615, 0.3077)),
    ), told


def _bottoms(told: str) -> list[int]:
    """The strip (4: the pin) of each start hole."""
    holes = start_holes(told)
    return [4 if float(y) > 9.5 else min(3, int(float(x) / 4.15)) for x, y in holes]


def test_what_is_cut_on_its_line_is_said(run: Run, tmp_path: Path) -> None:
    """Of an open contour no side is the part: where its wire comes into a part, that is said, quietly too."""
    page = drawing()
    polygon([(0, 0), (20, 0), (20, 15), (0, 15)], page)
    page.modelspace().add_line((-5, 15.15), (30, 15.15))
    page.modelspace().add_line((30.1, 20), (30.1, 10))
    words = ["cut", saved(page, tmp_path), "-o", tmp_path / "part.3b", "--offset", 0.2, "--open", "cut"]
    told = run(*words).stderr
    assert says(told, CARE, Phrase("open-on-line", count=2)), told
    gouges = [
        (one["turn"], round(one["depth"]["values"]["depth"], 4), one["other"])
        for one in values_of("gouge", run, *words[1:])
    ]
    assert gouges == [(1, 0.2, 2), (2, 0.05, 1)]
    quiet = run(*words, "--quiet").stderr.splitlines()
    assert quiet and set(quiet) == {line for line in told.splitlines() if line.startswith(CARE)}
    page.modelspace().delete_entity(page.modelspace()[0])
    told = run("cut", saved(page, tmp_path), *words[2:]).stderr
    assert says(
        told,
        Phrase("contour-numbers", count=2, numbers=(1, 2)),
        Phrase("kind-open-contour", count=2),
        Phrase("side-on"),
    ), told
    assert not says(told, Phrase("gouge")), told


def test_the_wire_ends_where_a_slot_narrows(run: Run, tmp_path: Path) -> None:
    """Its sides are all but parallel: 0.03 mm further there is no more than 0.3 um too little room."""
    page = drawing()
    polygon([(-5, -5), (15, -5), (15, 5), (-5, 5)], page)
    polygon([(0, 0), (3, 0.03), (3, -2), (6, -2), (6, 2), (3, 2), (3, 0.253), (0, 0.19)], page)
    told = run("cut", saved(page, tmp_path), "-o", tmp_path / "part.3b", "--offset", 0.1).stderr
    assert says(told, CARE, Phrase("narrow-corners"), re.compile(r"\(0, [\d.]+\)")), told


def test_what_is_left_out_of_a_drawing_that_says_metres(run: Run, tmp_path: Path) -> None:
    """In metres its gaps would be wider, and its contours fewer: those left out are counted as it is read in mm."""
    page = drawing()
    page.units = ezdxf.units.M
    polygon([(0, 0), (60, 0), (60, 40), (0, 40)], page)
    corners = [(20, 20), (20.1, 20), (20.1, 20.1), (20.003, 20.1), (20, 20.003)]
    for one, other in pairwise(corners):
        page.modelspace().add_line(one, other)
    told = run("cut", saved(page, tmp_path), "-o", tmp_path / "part.3b", "--offset", 0.1, "--small", "leave").stderr
    assert says(
        told, CARE, Phrase("contour-name", turn=1, kind=Phrase("kind-opening", count=1)), re.compile(r"\(20[\d.]*, ")
    ), told
    assert says(told, Phrase("order-of-cutting"), Phrase("count-outline", count=1), Phrase("count-holes", count=1)), (
        told
    )


@pytest.mark.parametrize(
    ("side", "lines"),
    [
        ("auto", []),
        ("outside", [(Phrase("side-of-openings", count=1, wide=0.4), Phrase("contours-in-brackets", numbers=(1,)))]),
        ("inside", [(Phrase("side-of-outlines", count=1, wide=0.4), Phrase("contours-in-brackets", numbers=(2,)))]),
        ("on", []),
    ],
)
def test_the_other_side_of_a_part_is_said(run: Run, tmp_path: Path, side: str, lines: list[tuple[str, ...]]) -> None:
    page = drawing()
    polygon([(0, 0), (20, 0), (20, 10), (0, 10)], page)
    page.modelspace().add_circle((10, 5), 3)
    path = saved(page, tmp_path)
    words = ["--offset", 0.2, "--side", side, "--quiet"]
    report = run("cut", path, "-o", tmp_path / "a.3b", *words).stderr
    assert each_says(report, *((CARE, *facts) for facts in lines))
    # (where the last pass runs on the line nothing is wider or smaller)
    report = run("cut", path, "-o", tmp_path / "a.3b", "--passes", "0.06,0", "--tab", 1, "--side", side).stderr
    assert not says(report, "--side")


@pytest.mark.parametrize(("offset", "step"), [(0.1, 0.02), (0.1, 0.05), (0.2, 0.05), (2, 1)])
def test_nothing_is_left_beside_a_step(run: Run, tmp_path: Path, offset: float, step: float) -> None:
    """Beside a step lower than R the wire comes nearer to the corner than where the edges' parallels meet."""
    page, tape = drawing(), tmp_path / "part.3b"
    shape = polygon([(0, 0), (20, 0), (20, 5), (8, 5), (8, 5 + step), (0, 5 + step)], page)
    run("cut", saved(page, tmp_path), "-o", tape, "--offset", offset, "--start", "-5,2")
    (path,) = map(LineString, stretches(tape.read_bytes(), (-5, 2)))
    wanted = shape.buffer(offset, quad_segs=400).exterior
    places = shapely.points(shapely.get_coordinates(shape.exterior.segmentize(0.003)))
    assert (shapely.distance(places, path) <= shapely.distance(places, wanted) + LIMIT).all()


@pytest.mark.parametrize("start", ["159,268", "300,130", "20,130"])
def test_two_arcs_that_are_a_circle(run: Run, tmp_path: Path, start: str) -> None:
    """Their middles are 4 nm apart: as two arcs the controller ended 1 µm beside where it began."""
    page = drawing()
    for y, first, last in ((130.261418, 90, 180), (130.261414, 180, 90)):
        page.modelspace().add_arc((159.074093, y), 134.483399, first, last)
    result = run("cut", saved(page, tmp_path), "-o", tmp_path / "part.3b", "--start", start)
    assert says(result.stderr, Phrase("checked"), Phrase("closing", count=1))


@pytest.mark.parametrize(
    ("x", "y", "edge", "radius"),
    [
        (41.63624339, 26.44706912, 359.03209497, 119.05943787),
        (-19.78584690, 94.71882837, 375.48853062, 134.483399),
        (87.25925410, 6.52023028, 348.49178148, 88.39665467),
    ],
)
def test_large_rounded_corners_close(run: Run, tmp_path: Path, x: float, y: float, edge: float, radius: float) -> None:
    """Quarter arcs between axes: above 65 mm the ROM once took their end to be 1 µm beside where it is."""
    page = drawing()
    for i, (right, up) in enumerate([(1, 1), (0, 1), (0, 0), (1, 0)]):
        page.modelspace().add_arc((x + right * edge, y + up * edge), radius, 90 * i, 90 * i + 90)
    for low, high in ((x, x + edge), (y, y + edge)):
        for side in (-radius, edge + radius):
            ends = [(low, y + side), (high, y + side)] if low == x else [(x + side, low), (x + side, high)]
            page.modelspace().add_line(*ends)
    result = run("cut", saved(page, tmp_path), "-o", tmp_path / "part.3b")
    assert says(result.stderr, Phrase("checked"), Phrase("closing", count=1))


@pytest.mark.parametrize(
    ("starts", "words", "why"),
    [
        (["3,3"], [], [Phrase("hole-outside", x=3, y=3, u=5, v=5)]),
        (["6,6", "3,3"], [], [Phrase("hole-inside", x=3, y=3, u=0, v=0)]),
        (["6,6", "-0.05,3"], [], [Phrase("hole-near-outside", x=-0.05, y=3, least=0.1, u=0, v=0)]),
        (["6,6", "3,3"], ["--side", "inside"], []),
        (["5,5", "3,0"], ["--side", "on"], []),
        (["6,6", "-0.1,3"], ["--passes", "0.05,0"], []),
    ],
)
def test_a_start_hole_in_the_part_is_refused(
    run: Run, tmp_path: Path, starts: list[str], words: list[str], why: list[str]
) -> None:
    page = drawing()
    for low, high in ((0, 20), (5, 12)):
        polygon([(low, low), (high, low), (high, high), (low, high)], page)
    holes = [word for start in starts for word in ("--start", start)]
    words = ["cut", str(saved(page, tmp_path)), "-o", str(tmp_path / "part.3b"), "--offset", "0.1", *holes, *words]
    if why:
        assert says(run_failing(run, *words), "part.dxf: ", *why)
    else:
        assert says(run(*words).stderr, Phrase("checked"), Phrase("closing", count=2))


def allow(limit: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Have the check refuse what is off by more than this, mm."""
    from skg.checking import check_coverage, check_distance, wire_path

    for module in (wire_path, check_distance, check_coverage):
        monkeypatch.setattr(module, "LIMIT", limit)


@pytest.mark.parametrize(
    ("words", "advice"),
    [
        (["--rom", "standard"], [Phrase("off-drawing"), "--rom no-drift"]),
        (
            ["--offset", 0.2],
            [
                "--offset",
                "--start",
                "--side",
                Phrase("off-drawing", limit=3),
                Phrase("advice-redraw-or", start=(0, 0), end=(20, 3)),
                Phrase("edge-line"),
                Phrase("contour-name", start=(0, 0)),
            ],
        ),
        (
            [],
            [
                Phrase("off-drawing", limit=3),
                Phrase("advice-redraw", start=(0, 0), end=(20, 3), length=20.2237),
                Phrase("edge-line"),
                Phrase("contour-name", start=(0, 0)),
            ],
        ),
    ],
)
def test_what_to_do_where_the_wire_is_off_is_said(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: list[object], advice: list[object]
) -> None:
    allow(0.0008, monkeypatch)
    page = drawing()
    polygon([(0, 0), (20, 3), (20, 15), (0, 15)], page)
    told = run_failing(run, "cut", saved(page, tmp_path), "-o", tmp_path / "part.3b", *words)
    assert says(told, re.compile(r"\(\S+, \S+\)"), *advice), told
    assert says(told, "--offset") == ("--offset" in advice)


@pytest.mark.parametrize(("x", "y"), [(10.8125, 46.1875), (18.5, 38.75)])
def test_an_arc_that_a_controller_leaves_is_cut_along_chords(run: Run, tmp_path: Path, x: float, y: float) -> None:
    """Two half circles whose centres are 2 µm apart, on places of half a micrometre: a block of an arc would end 3.5 µm
    off; the circle beside them is cut as arcs."""
    page = drawing()
    radius, aside = 0.9375, 0.001
    lean = degrees(asin(aside / radius))
    page.modelspace().add_arc((x, y + aside), radius, -lean, 180 + lean)
    page.modelspace().add_arc((x, y - aside), radius, 180 - lean, lean)
    page.modelspace().add_circle((x + 20, y), 3)
    told = run("cut", saved(page, tmp_path), "-o", tmp_path / "part.3b", "--program", tmp_path / "part.skg").stderr
    assert says(told, Phrase("in-chords", turn=1)) and not says(told, Phrase("in-chords", turn=2))
    start = re.search(r"FROM \(([\d.]+),([\d.]+)\)", (tmp_path / "part.skg").read_text())
    assert start
    way, _ = stretches((tmp_path / "part.3b").read_bytes(), (float(start[1]), float(start[2])))
    ring = shapely.Point(x, y).buffer(radius, quad_segs=400).exterior
    assert max(ring.distance(shapely.Point(place)) for place in way[1:-1]) < LIMIT
    assert way[1] == pytest.approx(way[-2], abs=1e-9)


def test_a_curve_that_a_controller_leaves_is_cut_along_chords(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Less than what it needs for the arcs of FIT is enough for chords."""
    page = drawing()
    page.modelspace().add_ellipse((3.3, 4.4), (7.7, 2.2), 0.4)
    part, tape = saved(page, tmp_path), tmp_path / "part.3b"
    (checked,) = values_of("checked", run, part, "-o", tape)
    allow(checked["off"] / 1000 - 1e-4, monkeypatch)
    told = run("cut", part, "-o", tape).stderr
    assert says(told, Phrase("in-chords", turn=1))
    assert {block.is_line for block in tapes.parse(tape.read_bytes(), "tape").blocks} == {True}


@pytest.mark.parametrize("turn", [0.0, 0.25, 0.5, 0.75])
@pytest.mark.parametrize("offset", [0.0, 0.02])
def test_a_small_round_opening_that_another_crosses(turn: float, offset: float) -> None:
    """The start hole of an opening with less room than the lead is long is not its centre, from where the ROM would go
    to the +X side, when something lies on that way."""
    from skg.cutting.ladder import make
    from skg.geometry.contour import Contour, Edge
    from skg.planning.plan import plan

    def circle(x: float, y: float, r: float) -> Contour:
        start = x + r * cos(2 * pi * turn), y + r * sin(2 * pi * turn)
        return Contour((Edge(start, start, (x, y), 2 * pi),), True)

    contours = plan([circle(0, 0, 10), circle(0, 0, 0.5), circle(0.5, 0, 0.2)], [], CutSettings(offset=offset))
    (opening,) = (planned for planned in contours if planned.number == 1)
    assert opening.start != (0.0, 0.0)
    assert not make(contours, Job("part")).checked.faults


def test_any_size_in_8_kib(run: Run, tmp_path: Path) -> None:
    """A drawing that no memory holds goes line by line; 1,000 elements take no more time, each, than 248."""
    tape, program = tmp_path / "part.3b", tmp_path / "part.skg"

    def rectangles(count: int) -> Result:
        page = drawing()
        for at in range(count):
            x, y = at % 20 * 7.0, at // 20 * 6.0
            polygon([(x, y), (x + 4, y), (x + 4, y + 3), (x, y + 3)], page)
        path = saved(page, tmp_path)
        return run("cut", path, "-o", tape, "--offset", 0.1, "--program", program)

    # (each with each would be 16)
    result, _ = in_time(10, lambda: rectangles(250), lambda: rectangles(62))
    assert says(result.stderr, Phrase("made-loading")) and says(
        result.stderr, Phrase("checked"), Phrase("closing", count=250)
    )
    text = program.read_text()
    assert rest_of(text) == "" and text.count("BACK") == 250
    assert feed(text, "no-drift", 2).tape == tape.read_bytes()


#: Routes as a program without line numbers has them, each from its start hole at (x, 0) on: closed ones,
#: open ones, whose last block comes with what follows them, and one with a stop.
ROUTES = [
    "R=.1\nFROM ({x},0)\nCUT ({x},1),({y},1),({y},2.013),({x},2)\nBACK\nR=0\n",
    "FROM ({x},0)\nCUT ({x},0),({y},.5)\n",
    "R=.1\nFROM ({x},0)\nCUT ({x},0):.7777\nBACK\nR=0\n",
    "FROM ({x},0)\nCUT ({x},0),({y},0):1.0007\n",
    "FROM ({x},0)\nCUT ({x},1),({y},1),({x},2)\nBACK\nREM STOP\nFROM ({x},.5)\nCUT ({x},3),({y},3),({y},4)\nBACK\n",
]


@pytest.mark.parametrize("rom", ["no-drift", "standard"])
def test_boards_that_share_a_program(rom: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A long program, taken by twenty boards, gives the tape of one; of an error it tells the same."""
    monkeypatch.setattr(feeding, "_SHARE", 200)
    routes = [ROUTES[at * at % 7 % 5].format(x=at * 1.3337, y=at * 1.3337 + 1) for at in range(60)]
    parts = ["REM PART\n", *routes, "END\n"]
    assert len([*feeding._shares(parts)]) > 15
    alone = feed("".join(parts), rom)
    assert alone.error is None and alone.tape.count(b"D\r\n") > 100
    monkeypatch.setattr(feeding, "feed", None)
    assert feed_routes(parts, rom, 8).tape == alone.tape
    parts[31] = "FROM (0,0)\nCUT (0,0),(5,5):1\nBACK\n"
    assert feed_routes(parts, rom, 8).error == feed("".join(parts), rom).error == (6, None)


def test_routes_that_lean_on_those_before(monkeypatch: pytest.MonkeyPatch) -> None:
    """If boards that share a program disagree, one board makes all of it."""
    monkeypatch.setattr(feeding, "_SHARE", 100)
    routes = [f"FROM ({at},0)\nCUT ({at},1),({at}.5,1),({at},2)\nBACK\n" for at in range(9)]
    parts = ["R=.05\n", *routes, "END\n"]
    assert len([*feeding._shares(parts)]) > 2
    assert feed_routes(parts, "no-drift", 8).tape == feed("".join(parts), "no-drift").tape


@pytest.mark.parametrize("option", ["--sheet", "--program"])
def test_no_tape_where_what_goes_with_it_cannot_be_written(run: Run, tmp_path: Path, option: str) -> None:
    """A sheet or a program in a directory that is not there: no tape either."""
    tape, other = tmp_path / "part.3b", tmp_path / "none" / "part.svg"
    with pytest.raises(FileNotFoundError):
        run("cut", BRACKET, "-o", tape, option, other)
    assert not tape.exists()


def test_numbers_taken_off() -> None:
    """A stored program's lines as lines that are carried out; one that jumps cannot be taken so."""
    program = "20 CUT (0,0),(5,0),(5,5)\n10 FROM (0,-3)\n30 BACK\n40 END\n"
    plain = without_numbers(program)
    assert plain == ["FROM (0,-3)", "CUT (0,0),(5,0),(5,5)", "BACK", "END"]
    assert feed("\n".join(plain)).tape == feed(program).tape
    assert without_numbers(program + "35 IF 1>2 GOTO 10\n") is None
    assert without_numbers(program + "3 5 go to 10\n") is None
    assert without_numbers(program + "PRINT 1\n") is None


def test_numbers_taken_off_as_a_run_has_it() -> None:
    """Lines that replace and delete others, blanks in numbers, an END in the middle, none at all, ctrl-Z."""
    program = "10 PRINT 1\r20FROM(0,-3)\r\n2 0 FROM (1,-3)\n10\n3 0CUT O,(5,0),O\n35 END\n40 CUT (0,9)\n\x1a50 IF"
    plain = without_numbers(program)
    assert plain == ["FROM (1,-3)", "CUT O,(5,0),O", "END"]
    assert feed("\n".join(plain)).tape == feed(program).tape != b""
    assert without_numbers("10 PRINT 1\n") == ["PRINT 1", "END"]


def start_of(program: Path, number: int = 0) -> XY:
    """The place of a FROM of a program."""
    x, y = program.read_text().split("FROM (")[number + 1].split(")")[0].split(",")
    return float(x), float(y)


def rings(places: list[XY], hole: XY) -> list[LineString]:
    """The wire's paths between two visits to its start hole, without the leads."""
    found: list[list[XY]] = [[]]
    for place in places:
        if Point(place).distance(Point(hole)) < 1e-3:
            found.append([])
        else:
            found[-1].append(place)
    return [LineString(ring) for ring in found if len(ring) > 2]


PASSES, OFFSETS = "0.06,0.02,0", (0.16, 0.12, 0.1)


def test_an_open_contour_is_cut_once_beside_what_has_passes(run: Run, tmp_path: Path) -> None:
    page = drawing()
    polygon([(0, 0), (10, 0), (10, 10), (0, 10)], page)
    page.modelspace().add_line((20, 0), (20, 10))
    tape = tmp_path / "part.3b"
    words = ["--offset", 0.1, "--passes", PASSES, "--open", "cut"]
    assert run("cut", saved(page, tmp_path), "-o", tape, *words).exit_code == 0
    assert tape.read_bytes().count(b"B0B10000B10000GYL") == 1


@pytest.mark.parametrize("side", ["left", "right"])
def test_an_open_contour_beside_which_the_wire_runs_has_one_pass(run: Run, tmp_path: Path, side: str) -> None:
    page = drawing()
    page.modelspace().add_line((20, 0), (20, 10))
    tape = tmp_path / "part.3b"
    words = ["--offset", 0.1, "--passes", PASSES, "--open", "cut", "--side", side]
    assert run("cut", saved(page, tmp_path), "-o", tape, *words).exit_code == 0
    assert tape.read_bytes() == b"B100B0B100GX%b\r\nB0B10000B10000GYL2\r\nDD\r\n" % (b"L3" if side == "left" else b"L1")


@pytest.mark.parametrize("tab", [0.0, 2.0])
@pytest.mark.parametrize("other", [(0.06, 0.02, 0.0), (0.05, 0.0), (0.0,)])
@pytest.mark.parametrize("one", [(0.06, 0.02, 0.0), (0.05, 0.0), (0.0,)])
def test_contours_with_passes_of_their_own(one: tuple[float, ...], other: tuple[float, ...], tab: float) -> None:
    """Two squares, each with its own number of passes: all of these are checked, and none that is not there."""
    from skg.checking.check import check
    from skg.cutting.ladder import make
    from skg.geometry.contour import Contour
    from skg.planning.plan import plan

    def square(x: float, side: float) -> Contour:
        return closed([(x, 0.0), (x + side, 0.0), (x + side, side), (x, side)])

    wanted = [CutSettings(offset=0.1, passes=one, tab=tab), CutSettings(offset=0.1, passes=other)]
    contours = plan([square(0, 20), square(40, 10)], [], wanted)
    made = make(contours, Job("squares"))
    assert not made.checked.faults and made.checked.off < LIMIT
    for at in (0, 1):
        # (a stop fewer or more would be found before: here a pass is wanted elsewhere)
        elsewhere = list(contours)
        elsewhere[at] = replace(contours[at], passes=(*contours[at].passes[:-1], contours[at].passes[-1] + 0.01))
        faults = check(tapes.parse(made.data, "squares"), elsewhere, True).faults
        assert {fault.contour for fault in faults} == {at}, faults


def test_the_middles_of_straight_pieces_hide_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """The check finds the same where it looks at their ends alone: the wire right, bent, crossing its line, beside a
    hole that it cuts into, wanted elsewhere."""
    from skg.checking import check_coverage, check_distance
    from skg.checking.check import check
    from skg.cutting.ladder import make
    from skg.geometry.pieces import Pieces
    from skg.planning.plan import plan

    outline = closed([(0.0, 0.0), (40.0, 0.0), (40.0, 10.0), (20.0, 10.4), (0.0, 10.0)])
    contours = plan([outline, circle(20.0, 5.0, 0.5)], [], CutSettings(offset=0.1))
    made = make(contours, Job("part"))
    bottom = re.search(rb"B(\d+)B0+B\1GXL1", made.data) or re.search(rb"B(\d+)B0+B\1GXL3", made.data)
    long = int(bottom[1])
    digit = bottom[0][-1:]

    def straight(x: int, y: int, way: bytes) -> bytes:
        return b"B%dB%dB%dGXL%b" % (x, y, x, way)

    up, down = (b"1", b"4") if digit == b"1" else (b"3", b"2")
    bump = straight(long // 2, 20, up) + b"\r\n" + straight(long - long // 2, 20, down)
    over = straight(long // 2, 400, up) + b"\r\n" + straight(long - long // 2, 400, down)
    tapes_of = [made.data, *(made.data.replace(bottom[0], other) for other in (bump, over))]
    near = plan([outline, circle(20.0, 0.55, 0.5)], [], CutSettings(offset=0.1))
    tilted = plan(
        [closed([(0.0, 0.0), (40.0, 0.004), (40.0, 10.0), (20.0, 10.4), (0.0, 10.0)]), circle(20.0, 5.0, 0.5)],
        [],
        CutSettings(offset=0.1),
    )
    looked_at = []
    places = Pieces.nearest
    monkeypatch.setattr(Pieces, "nearest", lambda self, at, *rest: looked_at.append(len(at)) or places(self, at, *rest))

    def found(data: bytes, wanted: list) -> tuple:
        looked_at.clear()
        checked = check(tapes.parse(data, "part"), wanted, True)
        faults = [(fault.contour, fault.is_into, fault.is_missed) for fault in checked.faults]
        return (faults, len(checked.crossings), round(checked.off, 9)), sum(looked_at)

    cases = [*((data, contours) for data in tapes_of), (made.data, near), (made.data, tilted)]
    quick = [found(*case) for case in cases]
    for module in (check_distance, check_coverage):
        monkeypatch.setattr(module, "_bare", lambda *_: None)
    slow = [found(*case) for case in cases]
    assert [one for one, _ in quick] == [one for one, _ in slow]
    assert not quick[0][0][0] and quick[1][0][0] and quick[2][0][0] and quick[3][0][0]
    assert quick[0][1] < slow[0][1] / 2


def test_passes(run: Run, tmp_path: Path) -> None:
    """A die: each pass is shapely's offset by what is left to do, every second one the other way round."""
    page = drawing()
    polygon([(-30, -30), (60, -30), (60, 60), (-30, 60)], page)
    window = polygon([(0, 0), (30, 0), (30, 10), (18, 14), (30, 20), (5, 26)], page)
    tape, program = tmp_path / "part.3b", tmp_path / "part.skg"
    words = ["--wire", 0.18, "--gap", 0.01, "--passes", PASSES, "--program", program]
    assert run("cut", saved(page, tmp_path), "-o", tape, *words).exit_code == 0
    assert "STOP: TAKE THE SLUG OUT" in program.read_text()
    hole = start_of(program)
    first, rest, *_ = stretches(tape.read_bytes(), hole)
    cut = rings(first, hole) + rings(rest, hole)
    assert len(cut) == len(OFFSETS)
    for ring, offset in zip(cut, OFFSETS, strict=True):
        assert (
            apart(
                ring,
                window.buffer(-offset, join_style="mitre", mitre_limit=50).exterior,
            )
            < LIMIT
        )
    ways = [shapely.LinearRing(ring.coords).is_ccw for ring in cut]
    assert ways[0] != ways[1] != ways[2]


def test_arc_leads(run: Run, tmp_path: Path) -> None:
    """The wire comes along a quarter of a circle that touches the contour: there is no corner at the entry."""
    page = drawing()
    part = polygon([(0, 0), (30, 0), (30, 12), (14, 10), (0, 25)], page)
    tape, program = tmp_path / "part.3b", tmp_path / "part.skg"
    words = ["--offset", 0.1, "--lead-shape", "arc", "--lead", 2, "--program", program]
    assert run("cut", saved(page, tmp_path), "-o", tape, *words).exit_code == 0
    blocks = tapes.read(str(tape)).blocks
    assert [block.is_line for block in blocks[:3]] == [True, False, True]
    assert [block.is_line for block in blocks[-3:]] == [True, False, True]
    assert abs(blocks[1].sweep) == pytest.approx(pi / 2, abs=0.002) and blocks[1].radius == 2000
    (places,) = stretches(tape.read_bytes(), start_of(program))
    path = LineString(places)
    assert path.distance(part) > 0.1 - LIMIT
    assert places[0] == pytest.approx(places[-1], abs=1e-9)
    corner = blocks[1].end
    tangent = (-corner[1] * blocks[1].sense, corner[0] * blocks[1].sense)
    along_edge = blocks[2].move
    turned = abs(tangent[0] * along_edge[1] - tangent[1] * along_edge[0]) / (
        blocks[1].radius * (along_edge[0] ** 2 + along_edge[1] ** 2) ** 0.5
    )
    assert turned < 0.002


def test_a_straight_lead_has_its_own_reason(run: Run, tmp_path: Path) -> None:
    """An arc was asked for: one hole is not square to any edge, the other one has too little room."""
    page = drawing()
    polygon([(0, 0), (20, 0), (20, 15), (0, 15)], page)
    polygon([(4, 4), (6, 4), (6, 4.3), (4, 4.3)], page)
    words = ["-o", tmp_path / "part.3b", "--offset", 0.1, "--lead-shape", "arc", "--start=-0.5,-3"]
    told = run("cut", saved(page, tmp_path), *words).stderr
    assert says(told, Phrase("straight-lead", turn=1)), told
    assert says(told, Phrase("straight-lead-aslant", turn=2)), told


def test_a_tab_goes_around_corners(run: Run, tmp_path: Path) -> None:
    """A tab longer than every edge has several; one that is too long for the contour is refused, with its length."""
    page = drawing()
    polygon([(3 * cos(at * pi / 12), 3 * sin(at * pi / 12)) for at in range(24)], page)
    tape = tmp_path / "part.3b"
    run("cut", saved(page, tmp_path), "-o", tape, "--offset", 0.1, "--tab", 1.5)
    _, tab = tapes.parse(tape.read_bytes(), "tape").stretches()[::2]
    cut = sum(hypot(*run_block(block).move) for block in tab) / 1000
    assert 1.5 + 2 * 3 < cut < 2.4 + 2 * 3.1
    message = run_failing(run, "cut", saved(page, tmp_path), "--tab", 7)
    assert says(message, Phrase("tab-too-long"), Phrase("too-short-for-tab", fit=6.265), "--tab")


@pytest.mark.wording
@pytest.mark.parametrize(("size", "columns", "kinds"), [
    (1.0, 1, ["outline", "opening"]), (500.0, 8, ["outline", "opening"]), (100.0, 12, ["outline"]),
])  # fmt: skip
def test_sheet(tmp_path: Path, size: float, columns: int, kinds: list[str]) -> None:
    """Numbers do not touch each other, other texts, the part or another hole's mark; marks are smaller than what they
    mark."""
    from skg.cutting.ladder import make
    from skg.pictures.sheet import Facts, SetupSheet
    from skg.planning.plan import plan

    corners = [(0.0, 0.0), (size, 0.0), (size, size), (0.0, size)]
    contours = [closed(corners)] * (len(kinds) - 1)
    for at in range(columns**2):
        x, y = (size * (0.5 + k) / columns for k in divmod(at, columns))
        radius = size / columns / 4
        contours.append(circle(x, y, radius))
    result = make(
        plan(contours, [], CutSettings(offset=size / 1e4, lead=size / 20)),
        Job("part", setup=Setup(wire=0.18, gap=0.01)),
    )
    sheet = SetupSheet(result, Facts("part.dxf", "part.3b", "mm"))
    sheet.draw()
    sheet.save(str(tmp_path / "sheet.svg"), "svg")
    renderer = FigureCanvasAgg(sheet.figure).get_renderer()
    to_page = sheet.axes.transData.inverted()
    boxes, others = [], []
    for text in sheet.axes.texts:
        box = shapely.box(*to_page.transform_bbox(text.get_window_extent(renderer)).extents)
        (boxes if text.get_gid() == "number" else others).append(box)
    numbers = [int(text.get_text()) for text in sheet.axes.texts if text.get_gid() == "number"]
    assert numbers == sorted(set(numbers)) and set(numbers) <= set(range(1, len(contours) + 1))
    told = (re.search(r"(\d+) without room", text.get_text()) for text in sheet.axes.texts)
    left_out = next((int(found[1]) for found in told if found), 0)
    assert len(numbers) + left_out == len(contours) and len(numbers) >= min(len(contours), 100)
    assert len(others) > 5 * len(sheet.result.contours[:300])
    assert not len(shapely.STRtree(others).query(boxes, "intersects")[0])
    assert min(text.get_fontsize() for text in sheet.axes.texts) >= 5
    marks = [Point(patch.center).buffer(patch.radius) for patch in sheet.axes.patches if patch.get_gid() == "hole"]
    for many in (one for one in sheet.axes.collections if one.get_gid() == "holes"):
        marks += [shapely.Polygon(path.to_polygons()[0]) for path in many.get_paths()]
    part = [LineString([sheet.on_paper(point) for point in planned.contour.points()]) for planned in result.contours]
    assert len(marks) == len(part) == len(contours)
    for here in (boxes, marks):
        tree = shapely.STRtree(here)
        assert not [1 for k, box in enumerate(here) for other in tree.query(box, "intersects") if other != k]
    tree = shapely.STRtree(part)
    assert not len(tree.query(boxes, "intersects")[0]) and not len(tree.query(marks, "intersects")[0])
    # The table and the block of facts: on the page, and no word on another one.
    tree = shapely.STRtree(others)
    assert not [k for k, box in enumerate(others) if list(tree.query(box, "intersects")) != [k]]
    assert all(shapely.box(0, 0, *sheet.page).contains(box) for box in others)
    text = (tmp_path / "sheet.svg").read_text()
    for word in (
        "part.dxf",
        "part.3b",
        f"{result.cut_length:.1f} mm",
        "0.18 mm, gap 0.01 mm",
        *kinds,
    ):
        assert word in text


@pytest.mark.parametrize("size", [(3, 3), (10, 8), (70, 30), (30, 70), (200, 9), (4, 120), (420, 300)])
def test_a_part_fills_its_sheet(size: tuple[float, float]) -> None:
    """Whatever its form, it takes more than half of the page's free width or height; the stock stands on the page."""
    from skg.cutting.ladder import make
    from skg.pictures.sheet import Facts, SetupSheet
    from skg.planning.plan import plan

    width, height = size
    corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
    contour = closed(corners)
    stock = Setup(offset=0.1, material="1.2379", thickness=20.0)
    result = make(plan([contour], [], CutSettings(offset=0.1, lead=0.5)), Job("part", setup=stock))
    sheet = SetupSheet(result, Facts("part.dxf", "part.3b", "mm"))
    sheet.draw()
    texts = {text.get_text() for text in sheet.axes.texts}
    assert {"1.2379", "20 mm"} <= texts and any(
        says(text, Phrase("manner"), Phrase("side-outside"), Phrase("beside", offsets=(0.1,))) for text in texts
    )
    (left, low), (right, high) = sheet.on_paper((0, 0)), sheet.on_paper(size)
    assert 0 < left < right < sheet.page[0] and sheet.foot < low < high < sheet.page[1]
    assert max((right - left) / sheet.page[0], (high - low) / (sheet.page[1] - sheet.foot)) > 0.5


@pytest.mark.parametrize("width", [9.0, 200.0])
def test_each_number_belongs_to_one_hole(width: float) -> None:
    """Pairs of holes near each other, on paper or in the part: a number is nearest to its own hole, or has a line to
    it; none lies on the wire's path, and no letters are smaller than 5 points."""
    from skg.cutting.ladder import make
    from skg.geometry.contour import Contour, Edge
    from skg.pictures.sheet import Facts, SetupSheet
    from skg.planning.plan import plan

    places = [(x + dx, y) for x in (1.0, 4.0, 7.0) for y in (1.0, 3.0) for dx in (0.0, 0.45)]
    contours = [circle(x, y, 0.2) for x, y in places]
    rest = [(0.0, 4.0), (width, 4.0), (width, 9.0), (0.0, 9.0)]
    contours.append(Contour(tuple(Edge(p, q) for p, q in zip(rest, rest[1:] + rest[:1], strict=True)), True))
    result = make(plan(contours, [], CutSettings(offset=0.1, side="inside")), Job("part"))
    long = "a" * 40 + "b" * 40 + ".3b"
    sheet = SetupSheet(result, Facts("part.dxf", long, "mm"))
    sheet.draw()
    renderer = FigureCanvasAgg(sheet.figure).get_renderer()
    to_page = sheet.axes.transData.inverted()
    holes = [Point(sheet.on_paper(planned.start)) for planned in result.contours]
    lines = [one.get_path().vertices for one in sheet.axes.get_children() if one.get_gid() == "number-line"]
    assert lines or width < 100
    tied = {min(range(len(holes)), key=lambda at: holes[at].distance(Point(line[0]))) for line in lines}
    (patch,) = (one for one in sheet.axes.get_children() if one.get_gid() == "wire")
    path = (patch.get_transform() - sheet.axes.transData).transform_path(patch.get_path())
    wire = [LineString(places) for places in path.to_polygons(closed_only=False)]
    numbers = [text for text in sheet.axes.texts if text.get_gid() == "number"]
    assert len(numbers) > 8
    for text in numbers:
        box = shapely.box(*to_page.transform_bbox(text.get_window_extent(renderer)).extents)
        at = int(text.get_text()) - 1
        assert at in tied or holes[at].distance(box) < min(
            other.distance(box) for other in holes if other is not holes[at]
        )
        assert not any(box.intersects(path) for path in wire)
    assert min(text.get_fontsize() for text in sheet.axes.texts) >= 5
    shown = next(text.get_text() for text in sheet.axes.texts if "…" in text.get_text())
    assert shown.startswith("aaaa") and shown.endswith("bb.3b")


def test_sheet_of_what_is_large_or_close(run: Run, tmp_path: Path) -> None:
    """Lengths of six digits stand beside what the contour is; arrows of rings in each other do not reach the next."""
    large, rings = drawing(), drawing()
    polygon([(0, 0), (40000, 0), (40000, 30000), (0, 30000)], large)
    for at in range(20):
        rings.modelspace().add_circle((0, 0), 1 + at / 20)
    sheets = []
    for page in (large, rings):
        sheet = tmp_path / "sheet.svg"
        assert run("cut", saved(page, tmp_path), "-o", tmp_path / "part.3b", "--sheet", sheet).exit_code == 0
        sheets.append(sheet.read_text())
    assert ">140006<" in sheets[0]
    (curve,) = re.findall(r'<g id="arrows">\s*<path d="([^"]*)"', sheets[1])
    arrows = np.array(re.findall(r"[ML] (\S+) (\S+)", curve), float).reshape(-1, 3, 2)
    (scale,) = re.findall(r">(\d+):1<", sheets[1])
    apart = 0.05 * int(scale) / 25.4 * 72
    # (within the innermost and around the outermost there is room)
    assert np.ptp(arrows[1:-1], axis=1).max() < apart


@pytest.mark.parametrize("form", ["svg", "pdf"])
def test_a_sheet_is_the_same_each_time(run: Run, tmp_path: Path, form: str) -> None:
    """No moment stands in it: `make docs` writes the picture anew where it has changed alone."""
    sheets = set()
    for _ in range(2):
        assert run("cut", BRACKET, "-o", tmp_path / "part.3b", "--sheet", tmp_path / f"sheet.{form}").exit_code == 0
        sheets.add((tmp_path / f"sheet.{form}").read_bytes())
    assert len(sheets) == 1


@pytest.mark.parametrize("name", ["bad\udcff.dxf", "a$\\b$_c.dxf", "line\nbreak\x01.dxf", "零件" * 15 + ".dxf"])
def test_sheet_of_a_file_with_an_odd_name(run: Run, tmp_path: Path, name: str) -> None:
    """Bytes that are no UTF-8, what matplotlib takes for a formula, what no font has: a sheet, without a word."""
    page = drawing()
    page.modelspace().add_circle((0.00001, -0.00001), 5)
    Path(saved(page, tmp_path)).rename(tmp_path / name)
    passes = "0.12,0.09,0.06,0.03,0.02,0.01,0"
    for form in ("svg", "pdf", "png"):
        sheet = tmp_path / f"sheet.{form}"
        words = ("--offset", 0.1, "--passes", passes, "--sheet", sheet, "--quiet")
        with warnings.catch_warnings():
            warnings.filterwarnings("error", "Glyph")
            result = run("cut", tmp_path / name, "-o", tmp_path / "part.3b", *words)
        assert result.exit_code == 0 and all(line.startswith(CARE) for line in result.stderr.splitlines())
    root = ElementTree.parse(tmp_path / "sheet.svg").getroot()
    texts = ["".join(one.itertext()).strip() for one in root.iter("{http://www.w3.org/2000/svg}text")]
    assert any("0.22, 0.19, 0.16, 0.13, 0.12, 0.11, 0.1" in text for text in texts)
    assert "-0.000" not in texts
    shown = name.replace("\udcff", "\\xff").replace("\n", "\\n").replace("\x01", "\\x01")
    ends = [one.partition("…")[::2] for one in texts if len(one) > 6]
    assert any(shown.startswith(first) and shown.endswith(last) for first, last in ends)


def test_a_contour_keeps_its_fillets_whatever_its_neighbour_needs(run: Run, tmp_path: Path) -> None:
    """Plates with rounded corners beside a part whose inner fillet the wire cannot follow: this one has the wire's own
    way, the plates are written as if they were alone."""
    page, alone = drawing(), drawing()
    quarter = tan(pi / 8)
    for one in (page, alone):
        for x in (0, 40, 80):
            corners = [(3, 0, 0), (27, 0, quarter), (30, 3, 0), (30, 17, quarter), (27, 20, 0), (3, 20, quarter)]
            corners += [(0, 17, 0), (0, 3, quarter)]
            one.modelspace().add_lwpolyline([(x + at, y, bulge) for at, y, bulge in corners], "xyb", close=True)
    inner = [(0, 0, 0), (30, 0, 0), (30, 10, 0), (10.09, 10, -quarter), (10, 10.09, 0), (10, 20, 0), (0, 20, 0)]
    page.modelspace().add_lwpolyline([(x + 120, y, bulge) for x, y, bulge in inner], "xyb", close=True)
    found = []
    for name, one in (("both", page), ("alone", alone)):
        (tmp_path / name).mkdir()
        program = tmp_path / name / "part.skg"
        words = ["-o", tmp_path / name / "part.3b", "--offset", 0.1, "--program", program]
        assert run("cut", saved(one, tmp_path / name), *words).exit_code == 0
        routes = program.read_text().split("OUTLINE")[1:4]
        found.append([re.sub(r"(?m)^\d+ |\d+\. ?$|REM.*", "", route) for route in routes])
    assert all(line.count(",3") == 4 for route in found[0] for line in route.splitlines() if line.startswith("CUT"))
    assert found[0] == [route.replace("END\n", "") for route in found[1]]
