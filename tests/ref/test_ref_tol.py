"""TOL: curves that pass over nodes (docs/curves.md)."""

from __future__ import annotations

from math import cos, radians, sin
from pathlib import Path

import pytest
from refhelp import blocks, cut, program

from skg.ref import run
from skg.ref.fit import MOST_PASSED, Node, corners, excess, within
from skg.ref.real import ZERO, Real
from skg.ref.values import Point

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("fit-*.skg"))


def circle(count: int, step: float, radius: float = 20) -> list[str]:
    """So many nodes on a circle about O, `step` degrees apart; the wire starts at the first."""
    return [f"FROM ({radius},0)", *(f"FIT {radius}#{n * step}" for n in range(count))]


def bow(step: float, rise: float, count: int = 9) -> list[str]:
    """Nodes of a parabola, `step` apart."""
    return [f"FIT ({n * step},{rise * n * n})" for n in range(count)]


def waves(height: float = 3, count: int = 25) -> list[str]:
    """Nodes of a sine wave, 5 degrees of it for each millimetre."""
    return [f"FIT ({n},{height * sin(radians(15 * n)):.6f})" for n in range(count)]


def arcs(*lines: str) -> list[str]:
    """The blocks of a program but for its DD."""
    return blocks(*lines)[:-1]


# The statement -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("line", ["tol .01", "T O L.01", "TOL(1)/100", "TOL 1/A", "TOL SQR 1E-4", "TOL1E-2"])
def test_forms(line: str) -> None:
    assert blocks("A=100", line, *waves()) == blocks("A=100", "TOL 0.01", *waves())


@pytest.mark.parametrize("line", ["TOL", "TOL ,1", "TOL 1,2", "TOL ;1", "TOL=1", "TOL 1 2 A"])
def test_forms_that_are_none(line: str) -> None:
    assert cut(line).error == (1, 10)


def test_names_that_begin_with_t_are_still_names() -> None:
    assert cut("T=(1,2):3", "T1=T", "PRINT T1").paper == "(1,2,3)\n"


@pytest.mark.parametrize(
    ("tolerance", "error"),
    [("(1,2)", 4), ("X", 4), ("90:O", 4), ("-1", 5), ("-1E-9", 5), ("1/0", 5), ("D7", 3)],
)
def test_errors(tolerance: str, error: int) -> None:
    assert cut(f"TOL {tolerance}").error == (error, 10)


def test_the_last_tol_counts() -> None:
    assert blocks("TOL 0.02", "TOL 0.01", *waves()) == blocks("TOL 0.01", *waves())


def test_run_starts_with_no_tolerance() -> None:
    assert run("TOL 0.01\n" + program(*waves())).tape == cut(*waves()).tape != cut("TOL 0.01", *waves()).tape


@pytest.mark.parametrize("part", EXAMPLES, ids=lambda part: part.stem)
def test_tol_0_is_no_tol(part: Path) -> None:
    """Byte for byte, also after another tolerance; and one that no node can keep."""
    lines = [line for line in part.read_text().splitlines() if " TOL " not in line]
    plain = run("\n".join(lines)).tape
    assert run("\n".join(["1 TOL 0.02", "2 TOL 0", *lines])).tape == plain
    assert run("\n".join(["1 TOL 0.02", *lines])).tape != plain


def test_tolerance_is_on_the_tape_whatever_the_scale() -> None:
    small = ["A=0", "FIT (A/6,3*SIN A)", "A=A+10", "IF A<=400 GOTO 40"]
    big = [small[0], "FIT (A/3,6*SIN A)", *small[2:]]
    enlarged = blocks("TOL 0.01", "SCALE 2", *small)
    assert enlarged == blocks("SCALE 2", "TOL 0.01", *small)
    assert enlarged == blocks("TOL 0.01", "SCALE 1", *big)
    assert enlarged != blocks("TOL 0.02", "SCALE 1", *big)


# Ends of runs --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("before", [(), ("TOL 0.01",)])
def test_tol_ends_a_curve_as_cut_does(before: tuple[str, ...]) -> None:
    nodes = waves()
    said_again = f"CUT {nodes[11].removeprefix('FIT ')}"
    tolerance = before[0] if before else "TOL 0"
    split = blocks(*before, *nodes[:12], tolerance, *nodes[11:])
    assert split == blocks(*before, *nodes[:12], said_again, *nodes[11:])
    assert split != blocks(*before, *nodes)


def test_a_curve_ends_before_the_tolerance_is_worked_out() -> None:
    nodes = waves(count=6)
    for tolerance in ("1/0", "-1", "X"):
        wrong = cut(*nodes, f"TOL {tolerance}").tape
        assert wrong == cut(*nodes, "CUT 1/0").tape
    assert len(wrong.split()) == 10  # the last of five spans has its end still open, and the D


def test_two_curves_with_their_own_tolerances() -> None:
    """A corner between them, at a node that both have."""
    first = ["FIT O,90", "FIT (2,8.1)", "FIT (5,13)", "FIT (9,17)", "FIT (14,19),0"]
    second = ["FIT (14,19),30", "FIT (19,20.5)", "FIT (23,20)", "FIT (26,18)", "FIT (28,14),-90"]
    counts = {(a, b): len(arcs(f"TOL {a}", *first, f"TOL {b}", *second)) for a in ("0", "1") for b in ("0", "1")}
    assert counts == {("0", "0"): 16, ("0", "1"): 10, ("1", "0"): 12, ("1", "1"): 6}
    assert arcs("TOL 1", *first, "TOL 0", *second) == [*arcs("TOL 1", *first), *arcs("FROM (14,19)", *second)]


def test_tol_stands_where_nothing_is_fitted() -> None:
    """Between BACK and RECUT; in an open route, where a fillet waits."""
    part = ("FROM (5,-5)", "CUT X,Y:20,-X:20,-Y", "BACK")
    assert blocks(*part, "TOL 1", "RECUT") == blocks(*part, "RECUT")
    assert blocks("CUT O,(5,0),1", "TOL 1", "CUT (5,5)") == blocks("CUT O,(5,0),1", "CUT (5,5)")


def test_scale_does_not_end_a_curve_but_tol_does() -> None:
    assert cut(*waves(count=3), "SCALE 2").error == (6, 40)
    assert cut(*waves(count=3), "TOL 2").error is None


# What is passed ------------------------------------------------------------------------------------------


def test_nodes_of_one_circle_go_under_one_arc() -> None:
    """A quarter about (10,0), from O; the joint falls on the middle one of five nodes."""
    nodes = ["FIT O,90", *(f"FIT (10-10*COS {a},10*SIN {a})" for a in (20, 45, 70)), "FIT (10,10),0"]
    assert (
        blocks("TOL 0.001", *nodes)
        == blocks(nodes[0], nodes[-1])
        == [
            "B10000B0B2929GXSR2",
            "B7071B7071B7071GXSR2",
            "DD",
        ]
    )


def test_half_round_is_too_much_for_one_span() -> None:
    """The tangents at the ends are opposite, v·(t+u) = 0, though FIT alone would make the two quarters."""
    nodes = ["FIT O,90", "FIT (5,5),0", "FIT (10,0),-90"]
    assert arcs("TOL 0.001", *nodes) == arcs(*nodes)
    assert len(arcs(nodes[0], nodes[-1])) == 2


@pytest.mark.parametrize(("count", "spans"), [(3, 1), (17, 1), (18, 2), (33, 2), (34, 3)])
def test_no_more_than_fifteen_are_passed(count: int, spans: int) -> None:
    assert MOST_PASSED == 15
    assert len(arcs("TOL 0.001", *circle(count, 2))) == 2 * spans
    assert len(arcs(*circle(count, 2))) == 2 * (count - 1)


def test_line_of_nodes() -> None:
    nodes = [f"FIT ({n},{n / 2})" for n in range(40)]
    assert arcs("TOL 0.001", *nodes) == [*["B8000B4000B8000GXL1"] * 4, *["B3500B1750B3500GXL1"] * 2]


def test_a_larger_tolerance_makes_fewer_blocks() -> None:
    counts = [len(arcs(f"TOL {d}", *waves(count=60))) for d in ("0", "0.0001", "0.001", "0.01", "0.1", "2")]
    assert counts == sorted(counts, reverse=True)
    assert counts[0] == 118
    assert counts[-1] <= 10


def test_one_biarc_with_an_inflection() -> None:
    """Nodes on two arcs that turn against each other: a single S goes near all of them."""
    up = [(10 * sin(radians(a)), 10 - 10 * cos(radians(a))) for a in range(0, 41, 10)]
    nodes = up + [(2 * up[-1][0] - x, 2 * up[-1][1] - y) for x, y in up[-2::-1]]
    lines = [f"FIT ({x:.9f},{y:.9f})" for x, y in nodes]
    lines[0], lines[-1] = lines[0] + ",0", lines[-1] + ",0"
    one = arcs("TOL 0.5", *lines)
    assert one == arcs(lines[0], lines[-1])
    assert [block[-3:-1] for block in one] == ["NR", "SR"]
    assert len(arcs("TOL 0.001", *lines)) > 2  # the arcs change at a node, the joint is not there on the way


def test_r_of_a_passed_node_has_no_effect() -> None:
    """Nor has its tangent, once it has been passed."""
    nodes = [*bow(3, 0.02)[:-1], "FIT (24,1.28),10"]
    plain = cut("TOL 1", "R=0.1", *nodes)
    assert len(plain.path) == 3
    for passed in (1, 3, 7):
        changed = cut("TOL 1", "R=0.1", *nodes[:passed], "R=5", f"{nodes[passed]},4", "R=0.1", *nodes[passed + 1 :])
        assert changed.tape == plain.tape or passed == 1
        assert {s.offset for s in changed.path if s.role == "cut"} == {Real("0.1")}
    last = cut("TOL 1", "R=0.1", *nodes[:-1], "R=0.3", nodes[-1])
    assert {s.offset for s in last.path if s.role == "cut"} == {Real("0.3")}


def test_a_tangent_that_does_not_fit_keeps_its_node_from_being_the_end() -> None:
    """A node whose tangent points elsewhere cannot end a long biarc; passed, it does no harm."""
    nodes = bow(3, 0.02)
    odd = [*nodes[:4], nodes[4] + ",-60", *nodes[5:]]
    assert len(arcs("TOL 0.05", *nodes)) == 2
    assert len(arcs("TOL 0.05", *odd)) > 2


def test_closed_curve() -> None:
    """It ends where it began; its ends of spans are nodes, or joints near the ellipse."""
    ring = ["FROM (26,0)", "FIT (24,0),90", "A=5", "FIT (24*COS A,15*SIN A)", "A=A+5", "IF A<360 GOTO 50",
            "FIT (24,0),90", "BACK"]  # fmt: skip
    result, full = cut("TOL 0.01", *ring), cut("TOL 0", *ring)
    assert result.error is None
    cuts, all_cuts = ([s for s in r.path if s.role == "cut"] for r in (result, full))
    assert len(all_cuts) == 144
    assert len(cuts) < 60
    assert (cuts[0].start - cuts[-1].end).length() < 1e-40
    nodes = {(s.end.x, s.end.y) for s in all_cuts[1::2]}
    assert {(s.end.x, s.end.y) for s in cuts[1::2]} < nodes
    for s in cuts[::2]:
        assert abs((s.end.x / 24) ** 2 + (s.end.y / 15) ** 2 - 1) < Real("0.002")


def test_no_way_back() -> None:
    """There and back within the tolerance: the chord from the first node to one that lies behind is not tried."""
    nodes = ["FIT O,0", "FIT (10,0.5),90", "FIT (0.001,1),180"]
    assert len(arcs("TOL 50", *nodes)) == len(arcs(*nodes)) == 4


def test_twice_round_stays_twice_round() -> None:
    """Every node is near the circle of a longer biarc, but not near its arcs."""
    turns = [s.sweep for s in cut("TOL 1", *circle(17, 50)).path if s.is_arc]
    assert abs(sum(turns) - Real(radians(800))) < 1e-9
    assert len(turns) < 32


def test_ring_that_comes_back_to_its_first_node() -> None:
    """The chord from the first node to the last is zero: that span is not tried, and nothing is divided by it."""
    for last in ("12*COS 360", "12.0000000001"):
        ring = ["FROM (12,0)", *(f"FIT 12#{a},{a + 90}" for a in range(0, 360, 60)), f"FIT ({last},0),90", "BACK"]
        result = cut("TOL 5", *ring)
        assert result.error is None
        assert abs(sum(s.sweep for s in result.path if s.is_arc) - Real(radians(360))) < 1e-8


def test_trial_makes_no_error() -> None:
    """The tangents at the ends are square to the chord: no biarc from the first to the third, but two between."""
    nodes = ["FIT O,90", "FIT (5,0.1),0", "FIT (10,0),90"]
    assert blocks("TOL 9", *nodes) == blocks(*nodes)


def test_blocks_leave_when_their_end_is_kept() -> None:
    """Sixteen spans of a circle are held back; the next node, its tangent known, makes them go."""
    for spans, gone in ((16, 0), (17, 1)):  # the second block has its end still open
        nodes = circle(spans + 1, 2)
        result = cut("TOL 0.001", *nodes[:-1], f"{nodes[-1]},{90 + 2 * spans}", "A=1/0")
        assert len(result.tape.split()) == gone + 1


def test_sym_rep_and_recut_copy_the_joined_curve() -> None:
    """A lobe of 45 degrees, its nodes joined to one biarc: 2 blocks, with SYM 4, eight times these by REP."""
    lobe = ["FIT (20,0),90", "FIT 20.2#5.625", "FIT 20.8#11.25", "FIT 21.4#16.875", "FIT 21.6#22.5,112.5"]
    for tolerance, spans in (("0", 4), ("1", 1)):
        copies = ["SYM O:(1#22.5)", "REP 8,45", "BACK", "RECUT"]
        wheel = cut(f"TOL {tolerance}", "FROM (26,1)", *lobe, *copies)
        assert wheel.error is None
        assert len([s for s in wheel.path if s.role == "cut"]) == 2 * 2 * 2 * 8 * spans


# The measure ---------------------------------------------------------------------------------------------


def test_excess_by_hand() -> None:
    """A quarter of a circle of radius 10 about O, from (10,0) upwards; a line."""
    p, t, w = Point(Real(10), ZERO), Point(ZERO, Real(1)), Point(Real(-10), Real(10))
    half = Real(1) / 2
    for radius, tolerance in ((11, 1), (9, 1), (Real("10.5"), half)):
        place = Point(Real(radius) * Real(3) / 5, Real(radius) * Real(4) / 5)
        assert abs(excess(p, t, w, place, Real(tolerance))) < 1e-40
        assert excess(p, t, w, place, Real(tolerance) * Real("0.999")) > 0
    assert excess(p, t, w, Point(Real(10), Real(-1)), Real(1)) == 1
    assert excess(Point(ZERO, ZERO), Point(Real(1), ZERO), Point(Real(5), ZERO), Point(Real(3), Real(2)), Real(1)) == 1


def test_on_the_line_between_the_arcs_both_agree() -> None:
    """A node on the normal at the joint: a distance from one circle is the distance from the other."""
    a = Node(Point(ZERO, ZERO), Point(Real("0.6"), Real("0.8")), ZERO)
    b = Node(Point(Real(10), Real(1)), Point(Real("0.8"), Real("-0.6")), ZERO)
    for along, expected in ((Real("0.3"), False), (Real("0.2"), True), (Real("-0.2"), True), (Real("-0.3"), False)):
        c, d = corners(a.point, a.tangent, b.point, b.tangent)
        across = d - c
        normal = across.left() * (1 / across.length())
        place = (c + d) * (Real(1) / 2) + normal * along
        passed = Node(place, None, ZERO)
        ends = [(n.point, t, (c + d) * (Real(1) / 2) - n.point) for n, t in ((a, a.tangent), (b, -b.tangent))]
        assert {excess(*end, place, Real("0.25")) <= 0 for end in ends} == {expected}
        assert within(a, b, [passed], Real("0.25")) == expected
