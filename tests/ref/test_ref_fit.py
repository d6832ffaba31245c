"""Smooth curves (language.md, section 5)."""

from __future__ import annotations

import pytest
from refhelp import blocks, cut

from skg.ref import real
from skg.ref.real import Real, mp
from skg.ref.route import Segment
from skg.ref.values import Point


def test_half_circle_by_hand() -> None:
    """d = 100/20 = 5, joint ((0,5) + (10,5))/2: two quarters of a circle of radius 5."""
    assert blocks("FIT O,90", "FIT (10,0),-90") == [
        "B5000B0B5000GXSR2",
        "B0B5000B5000GYSR1",
        "DD",
    ]


def test_two_nodes() -> None:
    assert blocks("FIT O", "FIT (10,5)") == [
        "B5000B2500B5000GXL1",
        "B5000B2500B5000GXL1",
        "DD",
    ]
    # One tangent given: the other is its mirror image about the chord, one circle.
    one = blocks("FIT O,90", "FIT (10,0)")
    assert one == blocks("FIT O", "FIT (10,0),-90") == blocks("FIT O,90", "FIT (10,0),-90")


def test_nodes_on_a_circle_give_the_circle() -> None:
    nodes = [f"FIT (3,4)+(20#{a})" for a in (0, 40, 75, 130, 170)]
    arcs = [s for s in cut(*nodes).path if s.role == "cut"]
    assert len(arcs) == 8
    for s in arcs:
        assert abs(s.radius - 20) < 1e-40
        assert (s.centre - Point(Real(3), Real(4))).length() < 1e-40


def test_s_curve_changes_its_sense() -> None:
    tape = blocks("FIT O,60", "FIT (10,0),60")
    assert [b[-3:-1] for b in tape[:2]] == ["SR", "NR"]


def heading(s: Segment, p: Point) -> Point:
    """Unit direction of travel of a segment at its start or end."""
    if not s.is_arc:
        v = s.end - s.start
        return v * (1 / v.length())
    v = (p - s.centre).left() * (1 / s.radius)
    return v * (1 / v.length())


def ellipse(n: int, *before: str) -> list[Segment]:
    """The cut segments of an ellipse 60 x 36 through n nodes."""
    step = Real(360) / n
    result = cut(
        *before,
        "FROM (40,0)",
        "FIT (30,0),90",
        "A=0",
        f"A=A+{mp.nstr(step, 20)}",
        "IF A>=360 GOTO 500",
        "FIT (30*COS A,18*SIN A)",
        f"GOTO {10 * (4 + len(before))}",
    )
    assert result.error == (2, 10 * (5 + len(before)))
    return [s for s in result.path if s.role == "cut"]


def deviation(segments: list[Segment]) -> Real:
    """Largest distance of the segments from the ellipse, to first order."""
    worst = real.ZERO
    for s in segments:
        for i in range(9):
            t = Real(i) / 8
            if s.is_arc:
                angle = s.sweep * t * (1 if s.radius > 0 else -1)
                c, d = mp.cos(angle), mp.sin(angle)
                v = s.start - s.centre
                p = s.centre + Point(v.x * c - v.y * d, v.x * d + v.y * c)
            else:
                p = s.start + (s.end - s.start) * t
            f = (p.x / 30) ** 2 + (p.y / 18) ** 2 - 1
            slope = mp.hypot(2 * p.x / 900, 2 * p.y / 324)
            worst = max(worst, abs(f / slope))
    return worst


def test_third_order_convergence() -> None:
    """Half the spacing of the nodes, an eighth of the error."""
    errors = [deviation(ellipse(n)) for n in (12, 24, 48)]
    assert errors[0] < 0.25
    for coarse, fine in zip(errors, errors[1:], strict=False):
        assert 6 < coarse / fine < 11


def test_the_curve_is_smooth_with_and_without_offset() -> None:
    for before in ((), ("R=0.1",), ("R=-2",)):
        segments = ellipse(12, *before)
        assert len(segments) > 12
        for s, t in zip(segments, segments[1:], strict=False):
            assert (s.end - t.start).length() < 1e-40
            assert abs(heading(s, s.end).cross(heading(t, t.start))) < 1e-30


def test_flat_arcs_go_as_lines() -> None:
    # |t × w| of each half: 5 sin(half sweep) with half sweep about 5/(2 r).
    bent = blocks("FIT O,0.05", "FIT (10,0)")
    assert len(bent) == 3
    assert "R" in bent[0]
    # A rise of about 0.002 mm for the joint at (5, 0.002): 5·sin 0.0115° = 0.001.
    assert blocks("FIT O,0.02", "FIT (10,0)") == [
        "B5000B1B5000GXL1",
        "B5000B1B5000GXL4",
        "DD",
    ]


def test_arcs_of_fifty_metres_go_as_lines() -> None:
    # The chord 80 of a circle of 40 m, and of 60 m: its rise is 0.020, 0.013 mm.
    assert "SR" in blocks("FIT O,0.0573", "FIT (80,0)")[0]
    assert blocks("FIT O,0.0382", "FIT (80,0)") == [
        "B40000B13B40000GXL1",
        "B40000B13B40000GXL4",
        "DD",
    ]


def test_first_and_last_node_join_as_points() -> None:
    assert blocks("CUT O,(1,0)", "FIT (1,5),90", "FIT (11,5),-90", "CUT (11,0)") == [
        "B1000B0B1000GXL1",
        "B0B5000B5000GYL2",
        "B5000B0B5000GXSR2",
        "B0B5000B5000GYSR1",
        "B0B5000B5000GYL4",
        "DD",
    ]


def test_one_node_is_a_point_and_a_repeated_node_is_one() -> None:
    assert blocks("CUT O", "FIT (5,0)", "CUT (5,5)") == blocks("CUT O,(5,0),(5,5)")
    assert blocks("FIT O", "FIT (5,1)", "FIT (5.0005,1)", "FIT (9,0)") == blocks("FIT O", "FIT (5,1)", "FIT (9,0)")


@pytest.mark.parametrize(
    ("nodes", "line"),
    [
        (["O", "(5,0)", "O"], 30),
        # Both tangents straight back.
        (["O,180", "(5,0),180"], 20),
        # Both square to the chord: no circles of finite size.
        (["O,90", "(5,0),90"], 20),
    ],
)
def test_impossible_curves(nodes: list[str], line: int) -> None:
    assert cut(*(f"FIT {n}" for n in nodes)).error == (6, line)


def test_other_cutting_statements_end_a_curve() -> None:
    """A corner in the middle: the tangents on its two sides are found apart from each other."""
    split = cut(
        "FIT O",
        "FIT (5,2)",
        "FIT (10,0)",
        "CUT (10,0)",
        "FIT (10,0)",
        "FIT (15,2)",
        "FIT (20,0)",
    )
    arcs = [s for s in split.path if s.role == "cut"]
    corner = heading(arcs[3], arcs[3].end).cross(heading(arcs[4], arcs[4].start))
    assert corner > 0.5


def test_blocks_leave_when_the_next_node_is_there() -> None:
    """The span between two nodes needs the tangent at the second, so the node after it, or its own."""
    nodes = ["FIT O", "FIT (5,2)", "FIT (10,0)"]
    first_span = cut(*nodes).tape.decode().split()[:1]
    assert cut(*nodes[:2], "A=1/0").tape == b"D\r\n"
    # With the third node the first span is known; of its two arcs the second still lacks its corner.
    assert cut(*nodes, "A=1/0").tape.decode().split() == [*first_span, "D"]
    # A tangent at every node: each span at once.
    assert cut("FIT O,90", "FIT (10,0),-90", "A=1/0").tape.decode().split() == [
        "B5000B0B5000GXSR2",
        "D",
    ]


def test_each_span_has_the_r_of_its_second_node() -> None:
    result = cut("FROM (-5,0)", "R=1", "FIT O,90", "R=2", "FIT (10,0),-90")
    assert {s.offset for s in result.path if s.role == "cut"} == {2}
