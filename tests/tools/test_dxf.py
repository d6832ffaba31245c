"""Drawings to programs, programs to tapes, tapes to drawings."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import pairwise
from math import cos, hypot, pi, sin
from pathlib import Path

import drawings
import ezdxf
import numpy as np
import pytest
from conftest import ROOT, Run
from ezdxf.document import Drawing
from hypothesis import given, settings
from hypothesis import strategies as st
from test_tape import blocks

from skg import source
from skg import tape as tapes
from skg.drawing import Edge, Point, chain, collect, without_doubles
from skg.dxf import draw
from skg.errors import UserError
from skg.from_dxf import plan, write
from skg.placed import place
from skg.ref import run as run_reference
from skg.tape import Block

PARTS = Path(__file__).parent / "parts"
LAYERS = {drawings.cam: ("CAM",)}
#: Largest distance, µm, of a drawing made from the tape. A tape tells the end of an arc across its count axis
#: only to a µm, since the start's rounding is in the radius: where dozens of arcs follow each other without a
#: line the places found again wander off by some µm, and nothing on the tape could tell better.
LOST_ON_TAPE = {drawings.ratchet: 1.8, drawings.cam: 2.8, drawings.punch_with_spline: 3.4,
                drawings.bracket: 2.0}
#: The same for a tape whose blocks start where the controller stands (docs/drift.md), laid out as it goes. What
#: is more than 1 µm is an end rounded across its arc on top of FIT's half a micrometre.
LOST_WITHOUT_DRIFT = {drawings.ratchet: 1.25, drawings.cam: 1.15, drawings.in_inches: 1.1}

#: A program may miss the drawing by this, µm: half a micrometre of FIT's nodes, and half a micrometre where
#: a flat arc goes out as its chord (language.md, section 5).
EXACT = 1.05


def edges_of(make: Callable[[], Drawing]) -> list[Edge]:
    return without_doubles(collect(make(), LAYERS.get(make, ())).edges, 0.005)


def program_of(make: Callable[[], Drawing], offset: float = 0.0, **wishes: object) -> str:
    content = collect(make(), LAYERS.get(make, ()))
    contours = chain(without_doubles(content.edges, 0.005), 0.005)
    return write(plan(contours, content.starts, offset, str(wishes.get("side", "auto")),
                      bool(wishes.get("reverse"))), make.__name__, bool(wishes.get("fillets", True)))


def points_along(edges: list[Edge]) -> Iterator[Point]:
    for edge in edges:
        if edge.nodes:
            yield from edge.samples
        else:
            yield from (edge.at(k / 16) for k in range(17))


def off(points: Iterable[Point], edges: list[Edge]) -> np.ndarray:
    """Distance of each point from the nearest edge, µm."""
    found = np.full(len(points := np.array(list(points))), np.inf)
    chords = [(p, q) for edge in edges if edge.centre is None
              for p, q in pairwise(edge.samples or (edge.start, edge.end)) if p != q]
    for p, q in np.array(chords).reshape(-1, 2, 2):
        way, to = q - p, points - p
        part = np.clip(to @ way / (way @ way), 0, 1)
        found = np.minimum(found, np.hypot(*(to - part[:, None] * way).T))
    for edge in edges:
        if edge.centre is None:
            continue
        to = points - edge.centre
        start = np.subtract(edge.start, edge.centre)
        turned = np.sign(edge.sweep) * (np.arctan2(*to.T[::-1]) - np.arctan2(*start[::-1])) % (2 * pi)
        beside = np.abs(np.hypot(*to.T) - edge.radius)
        ends = np.minimum(*(np.hypot(*(points - end).T) for end in (edge.start, edge.end)))
        found = np.minimum(found, np.where(turned <= abs(edge.sweep), beside, ends))
    return 1000 * found


def apart(ones: list[Edge], others: list[Edge]) -> float:
    """Largest distance between two sets of edges, both ways, µm."""
    return max(off(points_along(ones), others).max(), off(points_along(others), ones).max())


def path_edges(program: str) -> list[Edge]:
    """The contours that the reference cuts, exact, as edges."""
    result = run_reference(program)
    assert result.error is None, (result.error, program)
    found = []
    for segment in result.path:
        if segment.role not in ("cut", "fillet"):
            continue
        start, end = ((float(p.x), float(p.y)) for p in (segment.start, segment.end))
        if segment.is_arc:
            centre = float(segment.centre.x), float(segment.centre.y)
            found.append(Edge(start, end, centre, float(segment.sweep) * (1 if segment.radius > 0 else -1)))
        else:
            found.append(Edge(start, end))
    return found


def tape_edges(made: source.Made, positions: str = "auto", polylines: bool = False) -> list[Edge]:
    x, y = made.start
    routes = place(made.tape, (round(1000 * x), round(1000 * y)), positions)
    return collect(draw(routes, [], polylines), ("WIRE",)).edges


@pytest.mark.parametrize("make", drawings.ALL)
def test_program_cuts_the_drawing(make: Callable[[], Drawing]) -> None:
    assert apart(path_edges(program_of(make)), edges_of(make)) < EXACT


@pytest.mark.parametrize("make", drawings.ALL)
def test_written_without_fillets(make: Callable[[], Drawing]) -> None:
    assert apart(path_edges(program_of(make, fillets=False)), edges_of(make)) < EXACT


@pytest.mark.parametrize("runner", ["reference", "rom"])
@pytest.mark.parametrize("make", drawings.ALL)
def test_round_trip(make: Callable[[], Drawing], runner: str, tmp_path: Path) -> None:
    emulator = ROOT / "build" / "skg80"
    part = tmp_path / "part.skg"
    part.write_text(program_of(make))
    made = source.load(str(part), "reference" if runner == "reference" else str(emulator))
    drawn = edges_of(make)
    limit = LOST_ON_TAPE.get(make, 1.0)
    assert apart(tape_edges(made), drawn) < limit
    assert apart(tape_edges(made, polylines=True), drawn) < limit


@pytest.mark.parametrize("make", drawings.ALL)
def test_round_trip_without_drift(make: Callable[[], Drawing]) -> None:
    result = run_reference(program_of(make), drift=False)
    start = result.path[0].start
    made = source.Made(tapes.parse(result.tape), (float(start.x), float(start.y)))
    drawn = edges_of(make)
    assert apart(tape_edges(made, "machine"), drawn) < LOST_WITHOUT_DRIFT.get(make, 1.001)
    assert apart(tape_edges(made, "machine", polylines=True), drawn) < LOST_WITHOUT_DRIFT.get(make, 1.001)


@pytest.mark.parametrize("wishes", [{}, {"reverse": True}])
@pytest.mark.parametrize("make", drawings.ALL)
def test_offset(make: Callable[[], Drawing], wishes: dict) -> None:
    """The wire never comes nearer to the contour than R, and away from corners it is R away."""
    r = 0.13
    drawn = edges_of(make)
    distances = off(points_along(path_edges(program_of(make, r, **wishes))), drawn)
    assert distances.min() > 1000 * r - EXACT
    assert (abs(distances - 1000 * r) < EXACT).mean() > 0.75


@pytest.mark.parametrize("side", ["inside", "outside", "left", "right"])
def test_sides(side: str) -> None:
    """A single square: cut from inside it shrinks, from outside it grows."""
    def square() -> Drawing:
        drawing, space = drawings.new()
        space.add_lwpolyline([(0, 0), (10, 0), (10, 10), (0, 10)], close=True)
        return drawing

    reach = max(x for x, _ in points_along(path_edges(program_of(square, 0.5, side=side))))
    assert reach == pytest.approx(9.5 if side in ("inside", "left") else 10.5)


@given(st.lists(blocks(), min_size=1, max_size=8))
@settings(max_examples=60, deadline=None)
def test_any_tape_draws(items: list[Block]) -> None:
    """Every block's ends and middle lie on the drawing that is made of it."""
    tape = tapes.parse(tapes.to_bytes(items))
    for polylines in (False, True):
        routes = place(tape, positions="programmed")
        found = collect(draw(routes, [], polylines)).edges
        for route in routes:
            for placed in route.blocks:
                points = [(x / 1000, y / 1000) for x, y in (placed.start, placed.at(0.5), placed.end)]
                assert off(points, found).max() < 2 + 1e-6 * placed.block.length


def test_program_is_as_a_person_writes_it() -> None:
    """`parts/die_plate.skg` was read and found good."""
    program = program_of(drawings.die_plate, 0.1)
    assert program == (PARTS / "die_plate.skg").read_text()
    lines = program.splitlines()
    assert max(map(len, lines)) <= 72
    numbers = [int(line.split()[0]) for line in lines]
    assert numbers == sorted(set(numbers))


def test_command_line(run: Run, tmp_path: Path) -> None:
    drawing = tmp_path / "plate.dxf"
    drawings.die_plate().saveas(drawing)
    program, tape, back = (tmp_path / f"plate.{kind}" for kind in ("skg", "3b", "out.dxf"))
    result = run("from-dxf", drawing, "--offset", "0.1", "-o", program)
    assert result.exit_code == 0
    assert result.stderr == f"skg: {drawing}: passed by 1 TEXT\n"
    tape.write_bytes(source.tapes.to_bytes(source.load(str(program), "reference").tape.items))
    assert run("dxf", tape, "--start", "10,10", "-o", back).exit_code == 0
    layers = {entity.dxf.layer for entity in ezdxf.readfile(back).modelspace()}
    assert layers == {"WIRE", "LEAD", "MOVES", "START", "STOPS"}
    assert run("from-dxf", back, "--list-layers").stdout.startswith(
        "LEAD: 6 LINE\nMOVES: 5 LINE\nSTART: 6 POINT\nSTOPS: 6 POINT\nWIRE: ")
    again = run("from-dxf", back, "--layer", "WIRE", "-o", "-", "--layer", "wire")
    assert again.exit_code == 0
    assert again.stdout.count("FROM") == 6
    assert "FROM (40,-3.1)" in again.stdout, "the start holes come back from their layer"
    assert run("from-dxf", "-", stdin=drawing.read_bytes()).stdout.startswith("10 REM STANDARD INPUT: 6 CONT")


def test_given_start_holes(run: Run, tmp_path: Path) -> None:
    drawing = tmp_path / "rod.dxf"
    drawings.connecting_rod().saveas(drawing)
    program = run("from-dxf", drawing, "--start", "1,2", "--start", "30,40", "--start", "74,1").stdout
    starts = [line.split()[2] for line in program.splitlines() if " FROM" in line]
    assert starts == ["(1,2)", "(74,1)", "(30,40)"]
    assert apart(path_edges(program), edges_of(drawings.connecting_rod)) < EXACT
    result = run_reference(program)
    entry = next(segment for segment in result.path if segment.role == "entry")
    assert hypot(float(entry.end.x), float(entry.end.y)) == pytest.approx(13.7)


def test_open_contour() -> None:
    def hook() -> Drawing:
        drawing, space = drawings.new()
        space.add_line((0, 0), (10, 0))
        space.add_arc((10, 5), 5, -90, 90)
        space.add_line((10, 10), (4, 10.0004))
        return drawing

    assert apart(path_edges(program_of(hook)), edges_of(hook)) < EXACT
    right = path_edges(program_of(hook, 0.5, side="right"))
    assert off(points_along(right), edges_of(hook)) == pytest.approx(500, abs=0.05)


def test_nodes_follow_the_tolerance() -> None:
    """A biarc's error is of third order: eight times the tolerance, half the nodes."""
    counts = []
    for tolerance in (0.004, 0.0005):
        edges = collect(drawings.cam(), ("CAM",), fit_tolerance=tolerance).edges
        counts.append(sum(len(edge.nodes) for edge in edges))
    assert 1.4 < counts[1] / counts[0] < 2.6


def star(count: int) -> list[Point]:
    turns = [2 * pi * k / count for k in range(count)]
    return [(20 * cos(turn), (20 + 6 * (k % 2)) * sin(turn)) for k, turn in enumerate(turns)]


def closed_b_spline(count: int) -> Drawing:
    """A closed B-spline without clamped ends, as CAD programs write them."""
    drawing, space = drawings.new()
    spline = space.add_spline(degree=3)
    spline.set_closed([(x, y, 0) for x, y in star(count)])
    return drawing


def test_unclamped_spline() -> None:
    """A uniform cubic B-spline passes (P₋₁ + 4P₀ + P₁)/6 at each knot."""
    edges = collect(closed_b_spline(12)).edges
    assert len(edges) == 1
    points = star(12)
    rings = [(points[k - 1], points[k], points[(k + 1) % 12]) for k in range(12)]
    knots = [tuple((a + 4 * b + c) / 6 for a, b, c in zip(*ring, strict=True)) for ring in rings]
    assert off(knots, edges).max() < EXACT
    assert apart(path_edges(program_of(lambda: closed_b_spline(12))), edges) < EXACT


def branching() -> Drawing:
    drawing, space = drawings.new()
    for end in ((1, 0), (0, 1), (-1, -1)):
        space.add_line((0, 0), end)
    return drawing


def empty() -> Drawing:
    return drawings.new()[0]


def tilted() -> Drawing:
    drawing, space = drawings.new()
    space.add_circle((0, 0), 5, {"extrusion": (0, 1, 1)})
    return drawing


@pytest.mark.parametrize(("make", "arguments", "message"), [
    (branching, [], "3 edges meet at (0.000, 0.000), expected two at a corner"),
    (empty, [], "no lines, arcs or curves to cut"),
    (tilted, [], "CIRCLE lies in a tilted plane"),
    (drawings.die_plate, ["--layer", "CUT"], "no layer CUT, the drawing has 0"),
    (drawings.connecting_rod, ["--start", "0,0"] * 4, "4 start holes for 3 contours"),
])
def test_bad_drawings(run_program: Run, tmp_path: Path, make: Callable[[], Drawing], arguments: list[str],
                      message: str) -> None:
    drawing = tmp_path / "bad.dxf"
    make().saveas(drawing)
    result = run_program("from-dxf", drawing, *arguments)
    assert result.returncode == 2
    assert message in result.stderr.splitlines()[-1]
    assert "Traceback" not in result.stderr
    assert result.stdout == ""


@pytest.mark.parametrize("data", ["", "hello\n", "0\nSECTION\n2\nENTITIES\n0\nLINE\n", "\0\1\2"])
def test_not_a_drawing(run_program: Run, data: str) -> None:
    result = run_program("from-dxf", "-", stdin=data)
    assert result.returncode == 2
    assert len(result.stderr.splitlines()) == 1
    assert result.stderr.startswith("skg: -: n")


def test_too_many_lines(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("skg.from_dxf._LAST_LINE", 20)
    with pytest.raises(UserError, match="the program would have .* lines, at most 20 fit"):
        program_of(drawings.ratchet)
