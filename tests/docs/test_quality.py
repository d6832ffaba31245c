"""FIT: the curves of the examples against the true ones, TOL against the fewest blocks, the measuring."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations, pairwise
from pathlib import Path
from random import Random

import curve_measure as measuring
import numpy as np
import pytest
from curve_fewest import arc_distance, fewest_blocks, savings, span_blocks, with_tangents
from curve_fitted import Biarcs, FittedPiece, Run, _Few, fitted_runs, pieces
from curve_measure import denser, distance, measure, node
from curve_tables import measured, runs, saved
from facthelp import pattern
from true_curves import TRUE_CURVES

from skg.ref import fit, real
from skg.ref import run as reference
from skg.ref.cutter import MOST_ITEMS
from skg.ref.fit import MOST_PASSED, Node, within
from skg.ref.real import ZERO, Real
from skg.ref.values import Circle, Point

PARTS = sorted((Path(__file__).parents[2] / "examples").glob("fit-*.skg"))
#: mm; radians; the limits that were set.
TOLERANCE, SMOOTH, RATIO = "0.005", 1e-6, 1.3

#: In one process with the tables of curves.md, which show the same.
pytestmark = pytest.mark.xdist_group("curves")
parts = pytest.mark.parametrize("part", PARTS, ids=lambda part: part.stem)


def tangent_jump(curve: list[FittedPiece]) -> float:
    """The largest angle (radians) between two arcs where they meet."""
    jumps = (abs(real.mp.asin(a.heading(a.end).cross(b.heading(b.start)))) for a, b in pairwise(curve))
    return float(max(jumps, default=ZERO))


def curves(part: Path) -> list[list[Node]]:
    return [run.nodes for run in runs(part)]


def test_all_curves_are_there() -> None:
    """The promised curves are there by name, each with its true curve except the airfoil, which is a table."""
    promised = {"ellipse", "parabola", "spiral", "cycloid", "epicycloid", "hypocycloid", "gear", "cam", "roller"}
    promised |= {"cam-constant", "cam-cycloidal", "envelope", "airfoil", "tol-cam", "tol-ellipse"}
    assert {part.stem.removeprefix("fit-") for part in PARTS} == promised
    assert {part.stem for part in PARTS} == {*TRUE_CURVES, "fit-airfoil"}
    assert all(part.with_suffix(".3b").exists() for part in PARTS)


@parts
def test_curves_are_smooth(part: Path) -> None:
    assert all(q.jump <= SMOOTH for q in measured(part))


@parts
def test_curves_are_near_the_true_ones(part: Path) -> None:
    for q in measured(part):
        if part.stem != "fit-airfoil":
            assert q.distance < 0.01
            assert min(q.biarcs) > 0  # something was measured


@parts
def test_error_is_of_third_order(part: Path) -> None:
    """Twice as many nodes: an eighth of the distance, the nearer the denser they are."""
    for first, second in (q.factors for q in measured(part) if q.biarcs):
        assert 6.5 < first < 10
        assert 7.5 < second < 9


def test_estimated_tangents_where_the_curvature_jumps() -> None:
    """Second order: why the harmonic cam gives its tangents."""
    part = next(p for p in PARTS if p.stem == "fit-cam")
    bare = [replace(n, tangent=None) if 0 < i < 30 else n for i, n in enumerate(curves(part)[0])]
    for factor in measure(part, Run(bare)).factors:
        assert 3.5 < factor < 4.5


@parts
def test_tol_against_the_optimum(part: Path) -> None:
    for s in saved(part, TOLERANCE):
        assert s.fewest <= s.joined <= RATIO * s.fewest
        assert s.joined <= s.blocks


@parts
def test_pieces_are_what_is_cut(part: Path) -> None:
    """The arcs measured here are arcs of the reference's route."""
    cut = {(c.x, c.y, c.r) for s in reference(part.read_text()).path if isinstance(c := s.nominal, Circle)}
    made = [piece.circle for run in runs(part) for piece in pieces(run.nodes, run.tolerance) if piece.circle]
    assert made
    assert {(c.x, c.y, c.r) for c in made} <= cut


def test_a_curve_is_counted_while_it_is_cut(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each arc is worked out once; given up or made of nodes alone, the curve counts the same."""
    arcs = []
    monkeypatch.setattr(fit, "arc", lambda *places, arc=fit.arc: arcs.append(arc(*places)) or arcs[-1])
    text = "10 TOL 0.001\n20 FIT (I,SIN(I*I))\n30 I=I+1\n40 IF I<60 GOTO 20\n"
    (run,) = fitted_runs("5 I=0\n" + text)
    found = measure(Path("part"), run)
    assert (found.nodes, found.blocks, found.flat) == (60, len(arcs), arcs.count(None))
    assert 0 < found.flat < found.blocks < 2 * 59
    assert found.jump == tangent_jump(pieces(run.nodes, run.tolerance, Biarcs)) <= SMOOTH
    assert measure(Path("part"), Run(run.nodes, run.tolerance)) == found
    typed = "TOL 0.001\n" + "".join(f"FIT ({i},SIN({i * i}))\n" for i in range(60))
    assert measure(Path("part"), fitted_runs(typed)[0]) == found


# The measuring -------------------------------------------------------------------------------------------


def circle_nodes(count: int, step: float) -> list[Node]:
    return [node(complex(10 * np.exp(1j * n * step)), None) for n in range(count)]


@pytest.mark.parametrize(("step", "tolerance", "blocks"), [(9, "0", 8), (3, "1", 12)])
def test_distance_is_a_distance(step: int, tolerance: str, blocks: int) -> None:
    """Some nodes of a 64 x 36 ellipse, all kept or not; the farthest place by brute force."""
    true = TRUE_CURVES["fit-ellipse"]
    nodes = curves(next(p for p in PARTS if p.stem == "fit-ellipse"))[0]
    few = nodes[::step]
    parameters = true.nodes[::step]
    made = pieces(few, Real(tolerance))
    assert len(made) == blocks
    everywhere = true.at(np.linspace(0, 360, 200001))
    by_hand = max(np.min(np.abs(everywhere - z)) for piece in made for z in piece.places(measuring.SAMPLES))
    assert distance(made, true, parameters) == pytest.approx(by_hand, rel=1e-6)
    assert by_hand > 0.1


def test_jump_is_seen() -> None:
    quarter = FittedPiece(Point(Real(10), ZERO), Point(ZERO, Real(10)), Circle(ZERO, ZERO, Real(10)))
    line = FittedPiece(quarter.end, Point(Real(-10), Real(10)), None)
    bent = FittedPiece(quarter.end, Point(Real(-10), Real("10.001")), None)
    assert tangent_jump([quarter, line]) < 1e-40
    assert tangent_jump([quarter, bent]) == pytest.approx(1e-4, rel=1e-6)


def test_nodes_beside_the_true_curve_are_refused(tmp_path: Path) -> None:
    part = tmp_path / "fit-parabola.skg"
    part.write_text(next(p for p in PARTS if p.stem == part.stem).read_text().replace("D*D/60", "D*D/61"))
    with pytest.raises(ValueError, match=pattern("parabola")):
        measure(part, fitted_runs(part.read_text())[0])


def test_program_that_fails_is_refused() -> None:
    with pytest.raises(ValueError, match="ERR 05 LINE 10"):
        fitted_runs("10 A=1/0")


def test_denser_nodes_keep_the_programs_own() -> None:
    part = next(p for p in PARTS if p.stem == "fit-cam")
    parameters, more = denser(TRUE_CURVES[part.stem], curves(part)[0], 4)
    assert len(more) == len(parameters) == 4 * (len(curves(part)[0]) - 1) + 1
    assert all(n.tangent for n in more)
    for own, again in zip(curves(part)[0], more[::4], strict=True):
        assert (own.point - again.point).length() < 1e-12
        assert (own.tangent - again.tangent).length() < 1e-12


# TOL ------------------------------------------------------------------------------------------------------


@parts
def test_passed_nodes_stay_within_tol(part: Path) -> None:
    """Measured on the arcs themselves, by many places on them: not by the formula that chose them."""
    for nodes in curves(part):
        made = pieces(nodes, Real(TOLERANCE), Biarcs)
        path = np.concatenate([piece.places(2000) for piece in made])
        for n in nodes:
            z = complex(n.point.x, n.point.y)
            near = int(np.argmin(np.abs(path - z)))
            a, b = path[max(near - 1, 0)], path[min(near + 1, len(path) - 1)]
            foot = a + (b - a) * np.clip(((z - a) * np.conj(b - a)).real / abs(b - a) ** 2, 0, 1)
            assert abs(z - foot) <= float(TOLERANCE) + 1e-5
        assert tangent_jump(made) <= SMOOTH


def test_tol_keeps_ends_and_bounds_its_memory() -> None:
    """Nodes of one circle would all go under one biarc: no more than MOST_PASSED are passed at a time."""
    nodes = circle_nodes(60, 0.05)
    made = pieces(nodes, Real(TOLERANCE))
    assert made[0].start == nodes[0].point
    assert made[-1].end == nodes[-1].point
    spans = -(-59 // (MOST_PASSED + 1))
    assert len(made) == 2 * spans
    assert fewest_blocks(nodes, float(TOLERANCE)) == 1


def test_tol_with_more_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    """The page's figure for 100 nodes holds, on the curve that is farthest from the optimum with 15."""
    monkeypatch.setattr(fit, "MOST_PASSED", 100)
    part = next(p for p in PARTS if p.stem == "fit-cam")
    assert max(s.ratio for s in savings(part, curves(part)[0], TOLERANCE)) < 1.145


def test_tol_does_not_go_round_twice() -> None:
    """Two rounds of a circle: every passed node lies on every long biarc's circle, but not on its arcs."""
    nodes = circle_nodes(17, 0.9)
    ends = [(complex(p.start.x, p.start.y), complex(p.end.x, p.end.y)) for p in pieces(nodes, Real("1"))]
    turned = sum(np.angle(end / start) for start, end in ends)
    assert turned == pytest.approx(16 * 0.9)


def test_without_tol_nothing_changes() -> None:
    nodes = curves(PARTS[0])[0]
    assert pieces(nodes, ZERO) == pieces(nodes)
    assert len(pieces(nodes, Real("1e-9"))) == len(pieces(nodes))


def test_the_two_ways_to_ask_agree() -> None:
    """`within` (the formula of TOL, 50 digits) and `span_blocks` (centres, double precision) on random nodes."""
    rng = Random(1983)
    answers = []
    for _ in range(400):
        count = rng.randint(3, 7)
        places = [complex(3 * n, 0.004 * n * n + rng.choice([0.004, 0.03]) * rng.random()) for n in range(count)]
        nodes = with_tangents([node(z, None) for z in places])
        ours = within(nodes[0], nodes[-1], nodes[1:-1], Real(TOLERANCE))
        t, u = (complex(n.tangent.x, n.tangent.y) for n in (nodes[0], nodes[-1]))
        assert ours == (span_blocks(np.array(places), t, u, float(TOLERANCE)) is not None)
        answers.append(ours)
    assert 50 < sum(answers) < 350


def test_fewest_blocks_by_trying_everything() -> None:
    rng = Random(83)
    for _ in range(10):
        places = np.array([complex(3 * n, 0.02 * rng.random()) for n in range(8)])
        nodes = with_tangents([node(complex(z), None) for z in places])
        t = [complex(n.tangent.x, n.tangent.y) for n in nodes]
        best = 99
        for count in range(7):
            for inner in combinations(range(1, 7), count):
                kept = [0, *inner, 7]
                costs = [
                    span_blocks(places[i : j + 1], t[i], t[j], float(TOLERANCE))
                    for i, j in zip(kept, kept[1:], strict=False)
                ]
                if all(costs):
                    best = min(best, sum(costs))
        assert fewest_blocks(nodes, float(TOLERANCE)) == best


def test_arc_distance() -> None:
    """A quarter of a circle of radius 10 from (10, 0); beside it, and behind its beginning."""
    quarter = complex(10), 1j, 10j
    places = 10.25 * np.exp(1j * np.array([0.1, 0.7, 1.5]))
    assert arc_distance(*quarter, places) == pytest.approx(0.25)
    assert arc_distance(*quarter, np.array([10 - 0.1j])) == np.inf
    assert arc_distance(0j, 1 + 0j, 5 + 0j, np.array([2 + 0.5j, 3 - 0.75j])) == pytest.approx(0.75)
    assert arc_distance(*quarter, np.array([])) == 0


def test_of_an_open_route_the_last_items_are_kept() -> None:
    """As many as REP may ask for."""
    few, items = _Few(), MOST_ITEMS + 3
    for n in range(items):
        few.append(n)
    assert (few[0], few[-1], len(few)) == (0, items - 1, MOST_ITEMS + 1)
