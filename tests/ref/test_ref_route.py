"""Routes: rule by rule from language.md, sections 3, 4 and 6, with tapes made by hand."""

from __future__ import annotations

import pytest
from refhelp import blocks, cut, program

from skg.ref import run

# Blocks of straight moves in mm.


def right(mm: float) -> str:
    um = round(1000 * mm)
    return f"B{um}B0B{um}GXL1"


def left(mm: float) -> str:
    return right(mm)[:-1] + "3"


def up(mm: float) -> str:
    um = round(1000 * mm)
    return f"B0B{um}B{um}GYL2"


def down(mm: float) -> str:
    return up(mm)[:-1] + "4"


SQUARE = "CUT X,Y:10,-X:10,-Y"


def test_square_of_lines() -> None:
    """Entry at the foot of FROM, forward travel, closing at the entry, return."""
    assert blocks("FROM (5,-3)", SQUARE, "BACK") == [
        up(3), right(5), up(10), left(10), down(10), right(5), down(3), "DD",
    ]  # fmt: skip


def test_offset_outside_and_inside() -> None:
    assert blocks("R=1", "FROM (5,-3)", SQUARE, "BACK") == [
        up(2), right(6), up(12), left(12), down(12), right(6), down(2), "DD",
    ]  # fmt: skip
    assert blocks("R=-1", "FROM (5,5)", SQUARE, "BACK") == [
        down(4), right(4), up(8), left(8), down(8), right(4), up(4), "DD",
    ]  # fmt: skip


def test_square_of_points() -> None:
    assert blocks("CUT O,(10,0),(10,10),(0,10)", "BACK") == [
        right(10), up(10), left(10), down(10), "DD",
    ]  # fmt: skip
    # Outside, entered at the outer corner: past it on the first edge, and back to that place.
    assert blocks("R=1", "FROM (-2,-1)", "CUT O,(10,0),(10,10),(0,10)", "BACK") == [
        right(2), right(11), up(12), left(12), down(12), right(1), left(2), "DD",
    ]  # fmt: skip


def test_inner_corner_cannot_be_the_entry() -> None:
    assert cut("R=-1", "FROM (5,5)", "CUT O,(10,0),(10,10),(0,10)", "BACK").error == (
        6,
        40,
    )


def test_inner_corner_with_a_first_arc() -> None:
    """The closing corner lies past the entry: on a circle, too, that is an error and not another turn."""
    half = ["P1=(10,0)", "P2=(-10,0)", "CUT P1,O:10,P2", "BACK"]
    assert cut("R=1", "FROM (20,0)", *half).error is None
    assert cut("R=-1", "FROM (5,5)", *half).error == (6, 60)


@pytest.mark.parametrize(
    ("over", "travel", "arc"),
    [
        # X cuts the circle at (-3, 0) and (3, 0), that is (∓3, -4) from its centre; the arc ends at its top.
        (",C", 12, "B3000B4000B7000GXNR4"),
        (";C", 6, "B3000B4000B13000GXNR3"),
        (",-C", 6, "B3000B4000B7000GXSR3"),
        (";-C", 12, "B3000B4000B13000GXSR4"),
    ],
)
def test_turns_between_line_and_circle(over: str, travel: int, arc: str) -> None:
    assert blocks("FROM (-9,0)", "C=(0,4):5", f"CUT X{over},(0,9)") == [
        right(travel),
        arc,
        "DD",
    ]


def test_whole_circle() -> None:
    turned_to_x = ["B5000B0B20000GYNR1", left(5), "DD"]
    assert blocks("CUT (10,0):5", "BACK") == [
        right(5),
        "B5000B0B20000GYNR3",
        left(5),
        "DD",
    ]
    assert blocks("FROM (10,0)", "CUT (10,0):5", "BACK") == [right(5), *turned_to_x]
    assert blocks("FROM (10,0)", "CUT (15,0),(10,0):5", "BACK") == [
        right(5),
        *turned_to_x,
    ]
    assert blocks("FROM (10,0)", "CUT (15,0),(10,0):5,(15,0)", "BACK") == [
        right(5),
        *turned_to_x,
    ]
    assert blocks("FROM (10,0)", "CUT (10,0):5,(10,0):5") == [
        right(5),
        turned_to_x[0],
        "DD",
    ]


def test_circle_by_way_of_a_point_is_two_arcs() -> None:
    assert blocks("FROM (9,0)", "CUT O:5,(0,5)", "BACK") == [
        left(4), "B5000B0B5000GXNR1", "B0B5000B15000GYNR2", right(4), "DD",
    ]  # fmt: skip


def test_entry_radially_and_from_the_centre() -> None:
    assert blocks("FROM (3,4)", "CUT O:10", "BACK")[0] == "B3000B4000B4000GYL1"
    assert blocks("FROM (0.0009,0)", "CUT O:10", "BACK")[0] == "B9999B0B9999GXL1"


def test_fillet_of_a_left_and_a_right_corner() -> None:
    # Left turn at (10, 0), radius 2: (8, 0) to (10, 2).
    assert blocks("FROM (5,0)", "CUT X,2,Y:10,(10,5)") == [
        right(3),
        "B0B2000B2000GYNR4",
        up(3),
        "DD",
    ]
    # Right turn: (8, 0) to (10, -2).
    assert blocks("FROM (5,0)", "CUT X,2,-Y:-10,(10,-5)") == [
        right(3),
        "B0B2000B2000GYSR1",
        down(3),
        "DD",
    ]
    # After a point, and with the wire on the right of it: the arc's radius is 2 + 1.
    assert blocks("R=1", "FROM (5,-1)", "CUT O:(1,0),(10,0),2,(10,5)") == [
        right(3), "B0B3000B3000GYNR4", up(3), "DD",
    ]  # fmt: skip


def test_fillet_between_line_and_circle() -> None:
    """Formula 9-7: tangent to X and inside the circle of radius 10 about O, radius 2, left turn.

    Centre at (√(8² - 2²), 2); on the circle it touches at 10/8 of the centre.
    """
    result = cut("FROM (-5,0)", "CUT X,2,O:10,(0,10)")
    arc = result.path[1]
    assert arc.role == "fillet"
    assert abs(arc.centre.x**2 - 60) < 1e-40
    assert abs(arc.centre.y - 2) < 1e-40
    assert abs(arc.end.x * 8 - arc.centre.x * 10) < 1e-40
    assert abs(arc.end.y - 2.5) < 1e-40
    assert arc.radius == 2


def test_fillet_takes_its_turn_from_either_separator() -> None:
    start = ["R=0.1", "FROM (-15,0)", "CUT X"]
    tapes = [blocks(*start, join, "CUT (0,10)") for join in ("CUT 2;O:-10", "CUT ;2,O:-10", "CUT ;2;O:-10")]
    assert tapes[0] == tapes[1] == tapes[2]
    assert "SR" in tapes[0][2]


def test_fillet_waits_for_the_corner_of_back() -> None:
    assert blocks("FROM (5,0)", "CUT X,Y:10,-X:10,-Y,2", "BACK") == [
        right(5), up(10), left(10), down(8), "B2000B0B2000GXNR3", right(3), "DD",
    ]  # fmt: skip


def test_a_corner_that_hardly_turns_leaves_its_fillet_out() -> None:
    assert blocks("CUT O,(10,0),2,(20,0.001)") == [
        right(10),
        "B10000B1B10000GXL1",
        "DD",
    ]


@pytest.mark.parametrize(
    ("statements", "code"),
    [
        (["CUT X,0,Y:10"], 5),
        (["CUT X,-2,Y:10"], 6),
        (["CUT 2"], 6),
        (["CUT O,2"], 6),
        (["CUT X,2", "CUT (5,0)"], 6),
        (["CUT X,2", "CUT 2"], 6),
        (["CUT X,(5,0),2"], 6),
        # Touching points at (8, 0) and (9, 0) behind the entry at (9.5, 0).
        (["FROM (9.5,0)", "CUT X,1,Y:10"], 6),
        # The circle has radius 1, the fillet 2.
        (["CUT O:1,2,Y"], 6),
    ],
)
def test_fillets_that_cannot_be(statements: list[str], code: int) -> None:
    result = cut(*statements)
    assert result.error is not None
    assert result.error[0] == code


def test_a_point_beside_a_cusp() -> None:
    """At the cusp there is no corner; 0.2 µm beside it the offset curves' crossing is the corner, 0.25 mm away."""
    route = ["R=-0.1", "FROM (0,-20)", "CUT (0,-5),O:5,{},(4.85,0):-0.15,(4.7,0),(0,0)"]
    for place, error in (("(5,0)", 6), ("(5,0.0001)", 6), ("(5,0.0002)", None)):
        result = cut(*[line.format(place) for line in route])
        assert (result.error and result.error[0]) == error, place
    assert b"B0B4900B5146GYNR4" in result.tape


def test_fillet_after_the_entry_on_a_circle() -> None:
    """The touching point lies 10° before, the corner 10° after (10, 0)."""
    corner = ["CUT O:10,3,-X:1.74,(0,1.74)"]
    assert cut("FROM (0,-20)", *corner).error is None
    assert cut("FROM (20,0)", *corner).error == (6, 20)


def test_point_chooses_the_nearest_crossing() -> None:
    circles = "CUT (0,0):5,{},(6,0):5"
    # From (5, 0): x runs 5 → 3, or 5 → -5 → 3.
    assert blocks(circles.format("(3,4)"), "BACK")[1] == "B5000B0B2000GXNR1"
    assert blocks(circles.format("(3,-4)"), "BACK")[1] == "B5000B0B18000GXNR1"


def test_point_on_a_straight_run_is_moved_aside() -> None:
    assert blocks("R=1", "FROM (0,-1)", "CUT O,(10,0),(20,0),(20,10)") == [
        right(10), right(11), up(11), "DD",
    ]  # fmt: skip


def test_slit() -> None:
    assert blocks("CUT O,(10,0),(5,0)") == [right(10), left(5), "DD"]
    assert cut("R=1", "CUT O,(10,0),(5,0)").error == (6, 20)


def test_a_point_twice_is_one() -> None:
    assert blocks("CUT O,(10,0),(10.0005,0),(10,5)") == [right(10), up(5), "DD"]


def test_points_must_lie_on_their_elements() -> None:
    assert cut("CUT X,(5,0.0011)").error == (6, 10)
    assert cut("CUT X,(5,0.0009),Y:5,(5,5)").error is None
    assert cut("CUT (5,0.002),X").error == (6, 10)


def test_travel_is_forward() -> None:
    assert cut("FROM (10,0)", "CUT X,Y:9.9985,(9.9985,5)").error == (6, 20)
    # By a micrometre or less it may go back.
    assert blocks("FROM (10,0)", "CUT X,Y:9.999,(9.999,5)") == [
        left(0.001),
        up(5),
        "DD",
    ]


def test_no_travel_on_a_circle_within_a_micrometre() -> None:
    assert blocks("FROM (7,0)", "CUT O:5,(5,0.0005)") == [left(2), "DD"]
    assert blocks("FROM (7,0)", "CUT O:5,(5,0.0011),(7,0.0011)")[1] == "B5000B0B1GYNR1"


@pytest.mark.parametrize(
    "items",
    [
        "(20,0),(5,0),O:5,(5,0),(20,0)",
        "(20,0),(5,0),O:5,(5,0.0009),(20,0)",
        "(5,0),O:5,(5,0),(20,0),(20,5)",
        "(5,0),(20,0),(20,5),(5,0),O:5",
    ],
)
def test_a_circle_between_two_points_at_one_place(items: str) -> None:
    """Not dropped: error 6, unless R leaves most of the turn."""
    for r in ("R=0", "R=-1"):
        error = cut(r, f"CUT {items}", "BACK").error
        assert error and error[0] == 6, r
    assert "B5916B1000B22000GYNR1" in blocks("R=1", "CUT (20,0),(5,0),O:5,(5,0),(19,0)")


def test_open_end() -> None:
    assert blocks("CUT O,(10,0)") == [right(10), "DD"]
    assert cut("CUT O,(10,0),Y:10").error == (6, 10)
    assert cut("CUT O").error == (6, 10)


def test_merging() -> None:
    plain = blocks("FROM (5,-3)", SQUARE, "BACK")
    assert blocks("FROM (5,-3)", "CUT X;X:0.0005,3,X,Y:10,-X:10,-Y", "BACK") == plain
    assert cut("FROM (5,-3)", "CUT X,X:0.0011,Y:10,-X:10,-Y", "BACK").error == (6, 20)
    assert blocks("CUT O:5,O:5,O:5.0005", "BACK") == blocks("CUT O:5", "BACK")


def test_last_element_equal_to_the_first() -> None:
    closed = blocks("FROM (5,-3)", "CUT X,Y:10,-X:10,-Y,X")
    assert closed == [up(3), right(5), up(10), left(10), down(10), right(5), "DD"]
    assert blocks("FROM (5,-3)", "CUT X,Y:10,-X:10,-Y,X", "BACK") == [
        *closed[:-1],
        down(3),
        "DD",
    ]
    assert cut("FROM (5,-3)", "CUT X").error == (6, 20)
    # With another R it does not lead to the place of entry.
    assert cut("R=1", "FROM (5,-3)", "CUT X,Y:10,-X:10,-Y", "R=2", "CUT X", "BACK").error == (6, 60)


def test_back_to_a_point_and_from_a_point() -> None:
    assert blocks("FROM (5,0)", "CUT X,(10,0),(10,5),(0,5),O", "BACK") == [
        right(5), up(5), left(10), down(5), right(5), "DD",
    ]  # fmt: skip
    assert cut("FROM (5,0)", "CUT X,(10,0),(10,5)", "BACK").error == (6, 30)


def test_long_routes_in_pieces() -> None:
    assert blocks("FROM (5,-3)", "CUT X", "CUT Y:10,-X:10", "A=1", "CUT -Y", "BACK") == blocks(
        "FROM (5,-3)", SQUARE, "BACK"
    )


def test_from_and_its_stops() -> None:
    assert blocks("FROM (1,1)", "FROM (1,1)") == ["D", "D", "DD"]
    assert blocks("CUT O,(1,0)", "FROM (1,5)", "CUT (1,5),(2,5)") == [
        right(1), "D", up(5), "D", right(1), "DD",
    ]  # fmt: skip
    assert blocks("FROM (5,5)", "CUT (6,5):1", "BACK", "CUT (3,5):1", "BACK").count("D") == 0


def test_changed_r() -> None:
    """Every element keeps the R of the statement that brought it."""
    assert blocks("R=1", "FROM (5,-3)", "CUT X", "R=2", "CUT Y:10,(10,5)") == [
        up(2),
        right(7),
        up(6),
        "DD",
    ]
    # Along one line there is no crossing where R changes.
    assert cut("FROM O", "CUT O,(5,0)", "R=1", "CUT (9,0)").error == (6, 40)


def test_offset_larger_than_an_inner_radius() -> None:
    assert cut("R=-5", "CUT O:5").error == (7, 20)
    assert cut("R=-6", "CUT O:5").error == (7, 20)
    assert cut("R=-4.9", "CUT O:5", "BACK").error is None
    assert cut("R=3", "FROM (5,-5)", "CUT X,2,-Y:-10").error == (7, 30)


def test_recut() -> None:
    once = blocks("R=0.2", "FROM (5,-3)", SQUARE, "BACK")
    again = blocks("R=0.1", "FROM (5,-3)", SQUARE, "BACK")
    both = ["R=0.2", "FROM (5,-3)", SQUARE, "BACK", "R=0.1", "A=5", "RECUT"]
    assert blocks(*both) == once[:-1] + again
    assert blocks(*both, "RECUT") == once[:-1] + again[:-1] + again
    for bad in (
        ["RECUT"],
        ["CUT X", "RECUT"],
        [*both, "CUT O,(1,0)", "FROM O", "RECUT"],
    ):
        assert cut(*bad).error == (6, 10 * len(bad))


def test_recut_keeps_the_fillet_of_backs_corner() -> None:
    square = ["FROM (5,-3)", SQUARE + ",2", "BACK"]
    tape = blocks(*square, "RECUT")
    assert tape[: len(tape) // 2] == tape[len(tape) // 2 : -1]


def test_scale() -> None:
    """Twice the size is the drawing of twice the numbers, with the same R."""
    drawing = [
        "FROM ({0}*5,-{0}*3)",
        "CUT X,{0},Y:{0}*10,-X:{0}*10,-Y",
        "BACK",
        "FROM ({0}*20,0)",
        "CUT ({0}*22,0),({0}*26,{0})",
        "REP 6,60:({0}*19,0)",
        "FROM ({0}*50,0)",
        "CUT X:{0}*-10,Y:{0}*60",
        "SYM X:{0}*-20",
        "CUT -Y:{0}*-40",
        "BACK",
        "FIT ({0}*9,0)",
        "FIT ({0}*12,{0}*2)",
        "FIT ({0}*15,{0}*9)",
    ]
    small, big = ([line.format(n) for line in drawing] for n in (1, 2))
    assert blocks("R=0.3", "SCALE 2", *small) == blocks("R=0.3", *big)
    assert cut("CUT O,(1,0)", "SCALE 2", "FROM O").error == (6, 20)
    assert cut("SCALE 0").error == (5, 10)


def test_scale_keeps_the_place_of_the_wire() -> None:
    assert blocks("FROM (1,0)", "SCALE 3", "CUT (2,0),(2,1)") == [right(5), up(3), "DD"]


HALF = ["R=0.1", "FROM (1,-5)", "S=X:2", "C=(0,8):7", "P1=(8,8)", "S1=X:12#150"]


@pytest.mark.parametrize(
    ("half", "whole"),
    [
        # An element square to the mirror or centred on it is its own image; turns are kept.
        ("S,Y:6;C", "S,Y:6;C;(Y:6)/Y,S"),
        # A fillet between elements, and one after a point.
        (
            "S,1,Y:8,P1,0.5,P1:(0,12)",
            "S,1,Y:8,P1,0.5,P1:(0,12),(P1:(0,12))/Y,P1/Y,0.5,(Y:8)/Y,1,S",
        ),
        # A point on the mirror.
        ("S,Y:8,P1,(0,12)", "S,Y:8,P1,(0,12),P1/Y,(Y:8)/Y,S"),
        # A fillet that waits: after an element, after a point on the mirror, after another point.
        ("S,Y:8,S1,1", "S,Y:8,S1,1,S1/Y,(Y:8)/Y,S"),
        ("S,Y:8,P1,(0,12),2", "S,Y:8,P1,(0,12),2,P1/Y,(Y:8)/Y,S"),
        ("S,Y:8,P1,2", "S,Y:8,P1,2,P1/Y,2,(Y:8)/Y,S"),
    ],
)
def test_sym(half: str, whole: str) -> None:
    assert blocks(*HALF, f"CUT {half}", "SYM Y", "BACK") == blocks(*HALF, f"CUT {whole}", "BACK")


def test_rep() -> None:
    start = ["R=0.1", "FROM (0,-15)"]
    sides = [f"CUT X:10#{90 * n}" for n in range(4)]
    assert blocks(*start, "CUT X:10", "REP 4,90", "BACK") == blocks(*start, *sides, "BACK")
    rounded = [f"CUT X:10#{90 * n},2" for n in range(4)]
    assert blocks(*start, "CUT X:10,2", "REP 4,90", "BACK") == blocks(*start, *rounded, "BACK")
    assert blocks(*start, "CUT X:10", "REP 1,90", "REP 2,90", "REP 2,180", "BACK") == blocks(*start, *sides, "BACK")
    for count, code in (("0", 5), ("-1", 5), ("1.5", 5), ("X", 4)):
        assert cut("CUT X", f"REP {count},90").error == (code, 20)
    assert cut("REP 2,90").error == (6, 10)


def test_rep_about_a_point_and_with_right_turns() -> None:
    start = ["FROM (30,-20)", "P=(5,0)"]
    tooth = "C1;S,C2,S/X"
    copies = ["C1=P:20", "C2=P:26", "S=X:3"]
    by_rep = blocks(*start, *copies, f"CUT {tooth}", "REP ;3,90:P", "CUT ;C1", "BACK")
    by_hand = blocks(
        *start,
        *copies,
        f"CUT {tooth}",
        "CUT ;C1;S#(90:P),C2,(S/X)#(90:P)",
        "CUT ;C1;S#(180:P),C2,(S/X)#(180:P)",
        "CUT ;C1",
        "BACK",
    )
    assert by_rep == by_hand


def test_rep_of_one_point() -> None:
    hexagon = blocks("CUT (12,0)", "REP 6,60", "BACK")
    corners = ",".join(f"12#{60 * n}" for n in range(6))
    assert hexagon == blocks(f"CUT {corners}", "BACK")


def test_routes_that_are_not_open() -> None:
    for statement in ("BACK", "SYM X", "REP 2,90"):
        assert cut(statement).error == (6, 10)
    assert cut("CUT O", "BACK").error == (6, 20)


# What an error leaves on the tape -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("items", "tape"),
    [
        # Nothing of a route yet.
        ("1/0", []),
        # A point says nothing of where the wire goes.
        ("O,1/0", ["D"]),
        # A first curve: the move to it.
        ("X,1/0", [up(3), "D"]),
        # The second curve makes the end of the first known.
        ("X,Y:10,1/0", [up(3), right(5), "D"]),
        # A point on it does not.
        ("X,Y:10,(10,5),1/0", [up(3), right(5), "D"]),
        ("X,Y:10,(10,5),(12,6),1/0", [up(3), right(5), up(5), "D"]),
        # A fillet that waits holds nothing back but its own corner.
        ("X,Y:10,2,1/0", [up(3), right(5), "D"]),
        ("X,2,Y:10,1/0", [up(3), right(3), "B0B2000B2000GYNR4", "D"]),
        # An element that merges says nothing new.
        ("X,Y:10,Y:10,1/0", [up(3), right(5), "D"]),
        # A corner that is impossible: what is before it stays.
        ("X,Y:10,Y:11", [up(3), right(5), "D"]),
        # A fillet that does not fit keeps its first element back, too.
        ("X,9,Y:10", [up(3), "D"]),
    ],
)
def test_blocks_before_an_error(items: str, tape: list[str]) -> None:
    result = cut("FROM (5,-3)", f"CUT {items}")
    assert result.error is not None
    assert result.error[1] == 20
    assert result.tape.decode().split() == tape


def test_errors_after_a_route_put_no_stop() -> None:
    result = cut("FROM (5,-3)", SQUARE, "BACK", "A=1/0")
    assert result.error == (5, 40)
    assert result.tape.decode().split()[-1] == down(3)


# Statements that do not cut -------------------------------------------------------------------------------


def test_lines_in_any_order_replaced_and_deleted() -> None:
    source = "30 PRINT 3\n10 PRINT 1\r\n20 PRINT 2\r20\n\n30 PRINT 33\nPRINT 5\n"
    assert run(source).paper == "5\n1\n33\n"


def test_read_data_restore() -> None:
    lines = [
        "READ A,P",
        "PRINT A,P",
        "RESTORE",
        "READ A",
        "PRINT A",
        "RESTORE 105",
        "READ A",
        "PRINT A",
    ]
    data = ["DATA 1+1,(D,4)", "DATA 7", "READ A"]
    result = run("D=1\n" + program("D=3", *lines, *data))
    assert result.paper == "2 (3,4)\n2\n7\nERR 08 LINE 120\n"


def test_gosub_goes_eight_deep() -> None:
    nested = "10 I=0\n20 GOSUB 50\n30 PRINT I\n40 END\n50 I=I+1\n60 IF I<{} GOTO 70\n65 RETURN\n70 GOSUB 50\n80 RETURN"
    assert run(nested.format(8)).paper == "8\n"
    assert run(nested.format(9)).paper == "ERR 02 LINE 70\n"


def test_nearly_equal_numbers() -> None:
    result = cut(
        "A=0",
        "I=0",
        "A=A+0.1",
        "I=I+1",
        "IF I<10 GOTO 30",
        "IF A=1 GOTO 80",
        "PRINT 0",
        "PRINT INT A",
    )
    assert result.paper == "1\n"
    for relation, holds in (
        ("=", 1),
        ("<>", 0),
        ("<", 0),
        (">", 0),
        ("<=", 1),
        (">=", 1),
    ):
        paper = cut(f"IF 1{relation}1.00000009 GOTO 40", "PRINT 0", "END", "PRINT 1").paper
        assert paper == f"{holds}\n"


def test_input_asks_again() -> None:
    result = run(program("INPUT A,P", "PRINT A,P"), ["X", "1/0", ")", "2*3", "5", "(1,A)"])
    assert result.paper == "? X\n? 1/0\n? )\n? 2*3\n? 5\n? (1,A)\n6 (1,6)\n"
    assert run(program("INPUT A")).error == (10, 10)


def test_run_starts_clean() -> None:
    assert run("A=5\nR=1\n10 CUT O,(1,0)\n20 PRINT A").paper == "ERR 03 LINE 20\n"


def test_direct_error_has_no_line() -> None:
    assert run("A=1/0\n10 END").error == (5, None)


def test_close_calls_are_reported() -> None:
    assert [n.kind for n in cut("CUT O,(1.000498,0)").near] == ["rounding"]
    assert not cut("CUT O,(1.0005,0)").near
    assert "touching" in {n.kind for n in cut("P=X*((0,5):4.99900000001)").near}
    assert "nearly equal" in {n.kind for n in cut("IF 1=1.0000001 GOTO 20", "END").near}
