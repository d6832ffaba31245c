"""3B blocks against tape-3b.md, by hand."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from refhelp import arc_end, blocks, cut

from skg.ref.fault import Fault
from skg.ref.real import Real, mp
from skg.ref.tape import Punch, arc_block, line_block, micrometres
from skg.ref.values import Point

CAD_TAPE = [
    "B9900B0B9900GXL3",
    "B0B70100B70100GYL2",
    "B55000B0B55000GXL3",
    "B50100B100B100000GYNR1",
    "B54900B0B54900GXL3",
    "DD",
]


def test_the_cad_packages_tape() -> None:
    assert (
        blocks(
            "FROM (115,-10)",
            "P1=(50.1,60.1)",
            "P2=(-50.1,60.1)",
            "CUT (105.1,-10),(105.1,60.1),P1,(0,60)/P1,P2,(-105,60.1)",
        )
        == CAD_TAPE
    )


@pytest.mark.parametrize(
    ("mm", "um"),
    [
        ("0", 0),
        ("0.0005", 1),
        ("-0.0005", -1),
        ("0.000498", 1),
        ("-0.000498", -1),
        ("0.0004979", 0),
        ("12.3454979", 12345),
        ("12.3455", 12346),
        ("99999.999", 99999999),
    ],
)
def test_rounding(mm: str, um: int) -> None:
    assert micrometres(Real(mm)) == um


def test_a_hundred_metres_is_too_far() -> None:
    with pytest.raises(Fault, match="ERR 10"):
        micrometres(Real("99999.9995"))


@pytest.mark.parametrize(
    ("move", "block"),
    [
        ((10, 0), "B10B0B10GXL1"),
        ((10, 5), "B10B5B10GXL1"),
        ((5, 10), "B5B10B10GYL1"),
        ((0, 10), "B0B10B10GYL2"),
        ((-5, 10), "B5B10B10GYL2"),
        ((-10, 0), "B10B0B10GXL3"),
        ((-10, -5), "B10B5B10GXL3"),
        ((0, -10), "B0B10B10GYL4"),
        ((5, -10), "B5B10B10GYL4"),
        ((7, 7), "B7B7B7GYL1"),
        ((-7, 7), "B7B7B7GXL2"),
        ((-7, -7), "B7B7B7GYL3"),
        ((7, -7), "B7B7B7GXL4"),
    ],
)
def test_lines(move: tuple[int, int], block: str) -> None:
    assert line_block(*move) == block


def degrees(a: float) -> Real:
    return mp.radians(Real(a))


@pytest.mark.parametrize(
    ("start", "end", "clockwise", "sweep", "block"),
    [
        # From axis to axis: the end on an axis decides G, the start's quadrant is the one moved into.
        ((10, 0), (0, 10), False, 90, "B10B0B10GXNR1"),
        ((0, 10), (-10, 0), False, 90, "B0B10B10GYNR2"),
        ((-10, 0), (0, -10), False, 90, "B10B0B10GXNR3"),
        ((0, -10), (10, 0), False, 90, "B0B10B10GYNR4"),
        ((0, 10), (10, 0), True, 90, "B0B10B10GYSR1"),
        ((-10, 0), (0, 10), True, 90, "B10B0B10GXSR2"),
        ((0, -10), (-10, 0), True, 90, "B0B10B10GYSR3"),
        ((10, 0), (0, -10), True, 90, "B10B0B10GXSR4"),
        # Inside one quadrant.
        ((4, 3), (3, 4), False, 16.3, "B4B3B1GXNR1"),
        ((3, 4), (4, 3), True, 16.3, "B3B4B1GYSR1"),
        # The long way round: y runs 4 → 5 → -5 → 3.
        ((3, 4), (4, 3), False, 343.7, "B3B4B19GYNR1"),
        ((4, 3), (3, 4), True, 343.7, "B4B3B19GXSR1"),
        # Half a turn, x runs 3 → -5 → -3 and y 4 → 5 → -4.
        ((3, 4), (-3, -4), False, 180, "B3B4B10GXNR1"),
        # |xe| = |ye|: GX, x runs 0 → 5.
        ((0, -7), (5, 5), False, 135, "B0B7B9GXNR4"),
        # Full circles.
        ((10, 0), (10, 0), False, 360, "B10B0B40GYNR1"),
        ((10, 0), (10, 0), True, 360, "B10B0B40GYSR4"),
        ((3, 4), (3, 4), False, 360, "B3B4B20GXNR1"),
        ((0, 10), (0, 10), True, 360, "B0B10B40GXSR1"),
        # The radius √(1² + 1²) counts as 1.
        ((1, 1), (-1, 1), False, 90, "B1B1B2GXNR1"),
    ],
)
def test_arcs(start: tuple, end: tuple, clockwise: bool, sweep: float, block: str) -> None:
    assert arc_block(start, end, clockwise, degrees(sweep)) == block


def test_a_sweep_that_rounding_turned_round_goes_as_a_line() -> None:
    # One step back on a big circle, meant as a very short arc forward.
    assert arc_block((100000, 0), (100000, -1), False, degrees(0.0001)) is None
    # The same ends after almost a full turn are an arc.
    assert arc_block((100000, 0), (100000, -1), False, degrees(359.999)) == "B100000B0B399999GYNR1"


def test_more_than_a_full_turn_by_rounding() -> None:
    # The true sweep is just below 360°, the rounded ends are just past it.
    assert arc_block((100000, 0), (100000, 1), False, degrees(359.9999)) == "B100000B0B400001GYNR1"


def test_rounded_ends_that_coincide() -> None:
    tape = Punch()
    tape.place(Point(Real(10), Real(0)))
    near_start = Point(Real(10), Real("0.0001"))
    centre = Point(Real(0), Real(0))
    tape.arc(near_start, centre, False, degrees(0.001))
    assert tape.lines == []
    tape.arc(near_start, centre, True, degrees(359.99))
    assert tape.lines == ["B10000B0B40000GYSR4"]
    tape.line(near_start)
    assert len(tape.lines) == 1


def test_arc_without_travel_along_its_axis_goes_as_a_line() -> None:
    # Both ends have x = 0 after rounding.
    assert arc_block((0, 3), (0, 4), False, degrees(1)) is None


def test_blocks_of_more_than_eight_digits() -> None:
    # A circle of 30 m: J would be 120,000,000.
    result = cut("CUT O:30000", "BACK")
    assert result.error == (10, 20)
    assert result.tape == b"B30000000B0B30000000GXL1\r\nD\r\n"


def test_bytes() -> None:
    assert cut("CUT O,(1,0)").tape == b"B1000B0B1000GXL1\r\nDD\r\n"


@given(
    st.integers(50, 5000),
    st.floats(0, 2 * math.pi),
    st.floats(0.1, 2 * math.pi - 0.1),
    st.booleans(),
)
def test_a_controller_arrives_at_the_end(radius: int, a: float, sweep: float, clockwise: bool) -> None:
    """Counting J along the count axis leads to the end of the arc again."""
    b = a - sweep if clockwise else a + sweep
    start = (round(radius * math.cos(a)), round(radius * math.sin(a)))
    end = (round(radius * math.cos(b)), round(radius * math.sin(b)))
    block = arc_block(start, end, clockwise, Real(sweep))
    head, z = block[:-3], block[-3:]
    x, y, rest = head[1:].split("B")
    j, axis = rest.split("G")
    dx, dy = arc_end(int(x), int(y), int(j), axis, z[:2], int(z[2]))
    assert abs(dx - (end[0] - start[0])) <= 2
    assert abs(dy - (end[1] - start[1])) <= 2
    assert (dx if axis == "X" else dy) == (end[0] - start[0] if axis == "X" else end[1] - start[1])
