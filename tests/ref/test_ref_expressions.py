"""Values of expressions, by hand (language.md, sections 1 and 2)."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refhelp import cut, value

from skg.ref import real, run
from skg.ref.fault import Fault
from skg.ref.geometry import negate
from skg.ref.operations import operate
from skg.ref.values import X_AXIS, Circle, Line, Point, Value, canonical

TABLE = [
    ("(3,4)", "(3,4)"),
    ("((0,0),(3,4))", "5"),
    ("((0,-2),X)", "2"),
    ("(X,(0,3))", "-3"),
    ("(X,Y)", "90"),
    ("(Y,X)", "-90"),
    ("(X,-X)", "180"),
    ("(-X,X)", "180"),
    ("(1,2):5", "(1,2,5)"),
    ("(1,2):-5", "(1,2,-5)"),
    ("(O:30):10", "(0,0,40)"),
    ("(O:-30):10", "(0,0,-20)"),
    ("X:10", "(0,-1,10)"),
    ("X:(5,7)", "(0,-1,-7)"),
    ("X:(O:5)", "(0,-1,5)"),
    ("X:(O:-5)", "(0,-1,-5)"),
    ("O:(1,0)", "(0,-1,0)"),
    ("(3,0):(3,5)", "(1,0,3)"),
    ("(O:10):((30,0):10)", "(0,-1,10)"),
    ("(O:-10):((30,0):-10)", "(0,-1,-10)"),
    ("(O:10):((40,0):-10)", "(0.5,-0.8660254,10)"),
    ("(O:5):(10,0)", "(0.5,-0.8660254,5)"),
    ("O:((10,0):5)", "(-0.5,-0.8660254,0)"),
    ("2#60", "(1,1.7320508)"),
    ("-2#60", "(-1,-1.7320508)"),
    ("(1,0)#90", "(0,1)"),
    ("((3,0):-2)#90", "(0,3,-2)"),
    ("X#90", "(1,0,0)"),
    ("X:5#90", "(1,0,5)"),
    ("(2,0)#(90:(1,0))", "(1,1)"),
    ("(2,0)#90:(1,0)", "(1,1)"),
    ("((2,0):3)#90:(1,0)", "(1,1,3)"),
    ("X#(90:(1,0))", "(1,0,1)"),
    ("O#(2,0)", "(1,0,1)"),
    ("(3,4)#X", "(3,0)"),
    ("2*3", "6"),
    ("(Y:2)*(X:-3)", "(2,3)"),
    ("X*(O:5)", "(5,0)"),
    ("(O:5)*X", "(-5,0)"),
    ("X*-(O:5)", "(-5,0)"),
    ("X*(O:-5)", "(-5,0)"),
    ("(O:5)*((6,0):5)", "(3,4)"),
    ("(O:5)*-((6,0):5)", "(3,-4)"),
    ("(O:-5)*((6,0):5)", "(3,-4)"),
    ("(1,2)*3", "(3,6)"),
    ("3*(1,2)", "(3,6)"),
    ("(3,6)/3", "(1,2)"),
    ("(1,2)*(3,4)", "11"),
    ("7/2", "3.5"),
    ("(3,4)/X", "(3,-4)"),
    ("((3,4):-2)/X", "(3,-4,-2)"),
    ("(O:(1,1))/(Y:2)", "(-0.70710678,-0.70710678,-2.8284271)"),
    ("X/Y", "(0,-1,0)"),
    ("(Y:5)/(Y:2)", "(-1,0,1)"),
    ("(1,1)/(4,5)", "(1,1,5)"),
    ("(1,2)+(3,4)", "(4,6)"),
    ("(1,2)-(3,5)", "(-2,-3)"),
    ("-(1,2)", "(-1,-2)"),
    ("-(O:5)", "(0,0,-5)"),
    # A + in front changes nothing, of whatever kind.
    ("+5", "5"),
    ("(+3,+4)", "(3,4)"),
    ("2*+3", "6"),
    ("2++3", "5"),
    ("2-+-+-3", "-1"),
    ("+-+2", "-2"),
    ("-+2", "-2"),
    ("SQR +16", "4"),
    ("+SQR(16)", "4"),
    ("+(O:5)", "(0,0,5)"),
    ("+X", "(0,-1,0)"),
    ("(2,0)#+90:+(1,0)", "(1,1)"),
    ("(2,0)#+(90:(1,0))", "(1,1)"),
    ("8/+2*3", "12"),
    ("-X", "(0,1,0)"),
    ("K1 (7,8)", "7"),
    ("K3 ((7,8):9)", "9"),
    ("K2 X", "-1"),
    ("ABS -3.5", "3.5"),
    ("INT -3.5", "-4"),
    ("INT 2.99999999", "3"),
    ("INT 2.9999", "2"),
    ("SQR 2", "1.4142136"),
    ("SIN 30", "0.5"),
    ("COS 180", "-1"),
    ("COS 90", "0"),
    ("TG 45", "1"),
    ("ATG -1", "-45"),
]


@pytest.mark.parametrize(("expression", "printed"), TABLE)
def test_operation(expression: str, printed: str) -> None:
    assert value(expression) == printed


@pytest.mark.parametrize(
    ("expression", "printed"),
    [
        ("8/2*3", "12"),
        ("12*8/2", "48"),
        ("2*3/4*2", "3"),
        ("10-4+3-1", "8"),
        ("1-2-3", "-4"),
        ("8/4/2", "1"),
        ("2+3*4", "14"),
        ("5-2*3", "-1"),
        ("SIN 30/2", "0.25"),
        ("SIN -30", "-0.5"),
        ("-SIN 30", "-0.5"),
        ("SIN(30)+1", "1.5"),
        ("6/-2", "-3"),
        ("2#30+60", "(0,2)"),
        ("1.5E-3*2", "0.003"),
        ("si n 3 0", "0.5"),
        ("P[1+1]", "(1,2)"),
        ("P 2", "(1,2)"),
    ],
)
def test_priorities_and_spelling(expression: str, printed: str) -> None:
    assert value(expression, "P2=(1,2)") == printed


def test_touching_curves_give_the_point_of_tangency() -> None:
    """The place of the circle, of two circles that of the first."""
    assert value("X*((0,5):5.0009)") == "(0,-0.0009)"
    assert value("X*((0,5):4.9991)") == "(0,0.0009)"
    assert value("(O:5)*((12,0):7.0005)") == "(5,0)"
    assert value("(O:10)*((5,0):5.0005)") == "(10,0)"
    assert value("((5,0):5.0005)*(O:10)") == "(10.0005,0)"
    assert value("(O:10):((4,0):6.0006)") == "(1,0,10)"


@pytest.mark.parametrize(
    ("number", "printed"),
    [
        ("123456789", "1.2345679E8"),
        ("99999999", "99999999"),
        ("99999999.6", "1E8"),
        ("0.00001", "0.00001"),
        ("0.0000012345", "1.2345E-6"),
        ("-0.000012345678", "-0.000012345678"),
        ("1/3", "0.33333333"),
        ("2/3", "0.66666667"),
        ("100", "100"),
        ("1E10", "1E10"),
        ("-5", "-5"),
        ("1000000/8", "125000"),
    ],
)
def test_print_format(number: str, printed: str) -> None:
    assert value(number) == printed


def test_print_separates_items_by_a_blank() -> None:
    assert cut('PRINT 1,"Two  and a half",(1,2)', "PRINT").paper == "1 Two  and a half (1,2)\n\n"


@pytest.mark.parametrize(
    ("statement", "code"),
    [
        ("A=", 1),
        ("A=(1", 1),
        ("A=1)", 1),
        ("A=SINA", 1),
        ("P3=25,32", 1),
        ("CUT S1,,S2", 1),
        ("CUT S1,5,5,S2", 1),
        ("CUT S1,5,P1", 1),
        ("CUT S1,", 1),
        ("RUN", 1),
        ('PRINT "abc', 1),
        ("A=P1000", 5),
        ("A=1E40", 5),
        ("A=D", 3),
        ("O=(1,2)", 3),
        ("X0=Y", 3),
        ("A=(1,2)", 4),
        ("P=X", 4),
        ("A=X+X", 4),
        ("A=K3 O", 4),
        ("S=90:O", 4),
        ("P=2#(90:O)", 4),
        ("C=O:0", 5),
        ("C=O/O", 5),
        ("A=1/0", 5),
        ("A=SQR -1", 5),
        ("A=TG 270", 5),
        ("A=1E30*1E30", 5),
        ("P[0.5]=O", 5),
        ("P[1000]=O", 5),
        ("P=X*(X:5)", 6),
        ("P=X*((0,5):4.998)", 6),
        ("P=(O:5)*(O:6)", 6),
        ("P=(O:5)*((1,0):2)", 6),
        ("S=(O:5):((1,0):2)", 6),
        ("S=O:O", 6),
        ("GOTO 5", 2),
        ("RETURN", 2),
        ("READ A", 8),
    ],
)
def test_errors(statement: str, code: int) -> None:
    assert cut(statement).error == (code, 10)


def test_hostile_lines() -> None:
    nines = "9" * 100
    for statement, code in (
        (f"A=1E{nines}", 5),
        (f"A=0E{nines}", None),
        (f"A=1E-{nines}", None),
        (f"A={nines}", 5),
        (f"A=P{nines}", 5),
        (f"A=A{'0' * 100}1", 3),
        (f"GOTO {nines}", 5),
        (f"A={'(' * 58}1{')' * 58}", None),
        (f"A={'(' * 100}1", 1),
        (f"A={'-' * 120}1", None),
        (f"A=1{' ' * 120}", None),
        (f"A=1{' ' * 121}", 9),
        (f"CUT O\n20 REP {nines[:9]},1", 5),
        ("A=\x01", 1),
        ("A=\x01\t2", None),
        ("A=\x15" + "20 A=2", None),
        ("A=1_2", 1),
    ):
        error = cut(statement).error
        assert (None if error is None else error[0]) == code, statement[:20]
    assert run(f"{nines} END").error[0] == 5


@pytest.mark.parametrize(
    ("statement", "code"), [("GOTO 65535", 2), ("GOTO 65536", 1), ("GOSUB 1.5", 1), ("IF 1=1 GOTO 65536", 1),
                            ("RESTORE 65535", None), ("RESTORE 65536", 1), ("GOTO 1E9", 1)]
)  # fmt: skip
def test_the_number_of_a_line(statement: str, code: int | None) -> None:
    assert cut(statement).error == (None if code is None else (code, 10))


def test_a_line_that_is_too_long_is_shown() -> None:
    long = f"20 REM {'x' * 200}"
    result = run(f"10 PRINT 1\n{long}\n30 PRINT 2\n")
    assert result.error == (9, 20)
    assert result.paper == f"{long[:127]}\n{' ' * 127}^\nERR 09 LINE 20\n"
    assert run(f"{long[:126]}\n").error is None


@pytest.mark.parametrize(
    ("line", "mark"), [("CUT X,3;5)", 8), ("CUT X,3,5,Y+", 8), ("CUT X,3,5+", 10), ("CUT X,3,(", 9),
                       (" 400.5TOL", 1), ("0 TOL", 0), ("10000 TOL", 0), ("70000 TOL", 0)]
)  # fmt: skip
def test_the_first_place_that_is_wrong_is_marked(line: str, mark: int) -> None:
    paper = run(line).paper
    assert paper.startswith(f"{line}\n{' ' * mark}^\nERR 01")


@pytest.mark.parametrize(
    ("statement", "fits"), [("PRINT " + "1," * 34 + "1", True), ("PRINT " + "1," * 35 + "1", False),
                            ("PRINT " + "A," * 40 + 'AA[1],"A"', True), ("PRINT " + "1," * 32 + "A,1.5E1,SIN 1", True),
                            ("PRINT " + "1," * 32 + "A,1.5E1,SIN 1,A,A,A", False), ("REM " + "1," * 58, True),
                            (f'PRINT "{"1," * 55}"', True)]
)  # fmt: skip
def test_a_line_has_room_for_so_many_numbers(statement: str, fits: bool) -> None:
    assert (cut(statement).error == (9, 10)) != fits


def test_input_is_for_programs() -> None:
    assert run("INPUT A\n10 A=1\n").error == (1, None)


def test_a_route_longer_than_any_buffer() -> None:
    """It is cut, but SYM, REP and RECUT find no room for it."""
    for last in ("REP 2,1", "SYM X"):
        result = cut("CUT (5,0),(6,0)", "REP 2000,1", last)
        assert result.error == (9, 30)
        assert result.tape.count(b"B") > 3 * 3900 and result.tape.endswith(b"D\r\n")


def test_error_1_stops_loading_and_marks_the_place() -> None:
    result = cut("PRINT 1", "A = (2 + * 3)", "PRINT 2")
    assert result.paper == "20 A = (2 + * 3)\n            ^\nERR 01 LINE 20\n"
    assert result.tape == b""


# Identities of the SKG book, its sections 5 to 8 --------------------------------------------------------------

coordinate = st.decimals(-200, 200, places=3).map(lambda d: real.Real(str(d)))
angle = st.decimals(-360, 360, places=2).map(lambda d: real.Real(str(d)))
points = st.builds(Point, coordinate, coordinate)
radii = st.decimals(1, 100, places=3).flatmap(lambda d: st.sampled_from([real.Real(str(d)), -real.Real(str(d))]))
circles = st.builds(lambda p, r: Circle(p.x, p.y, r), points, radii)
lines = st.builds(lambda d, a: operate(operate(X_AXIS, ":", d), "#", a), coordinate, angle)


def same(a: Value, b: Value) -> bool:
    return all(abs(p - q) < real.Real("1e-40") for p, q in zip(canonical(a), canonical(b), strict=True))


def crossing(e: Value, f: Value) -> Point | None:
    try:
        return operate(e, "*", f)
    except Fault:
        return None


@given(st.one_of(points, circles, lines))
def test_negated_twice(v: Value) -> None:
    assert negate(negate(v)) == v


@given(coordinate, angle)
def test_shift_and_turn_of_the_axis(d: real.Real, a: real.Real) -> None:
    assert same(
        operate(operate(X_AXIS, ":", d), "#", a),
        operate(operate(X_AXIS, "#", a), ":", d),
    )


@given(lines, circles)
def test_identities_6_4(s: Line, c: Circle) -> None:
    assert same(negate(operate(s, ":", c)), operate(negate(s), ":", negate(c)))
    assert same(negate(operate(s, ":", negate(c))), operate(negate(s), ":", c))


@settings(max_examples=80)
@given(st.one_of(lines, circles), circles)
def test_identities_7_4_and_7_5(s: Line | Circle, c: Circle) -> None:
    left = crossing(s, c)
    if left is None:
        assert crossing(c, s) is None
        return
    for e, f in ((negate(s), negate(c)), (negate(c), s), (c, negate(s))):
        assert same(left, crossing(e, f))
    right = crossing(s, negate(c))
    assert same(right, crossing(c, s))


@given(points, lines)
def test_foot_and_image(p: Point, s: Line) -> None:
    foot, image = operate(p, "#", s), operate(p, "/", s)
    assert abs(s.distance(foot)) < real.Real("1e-40")
    assert same(operate(foot, "+", foot), operate(p, "+", image))


@given(lines, lines)
def test_quasi_mirror_twice(s: Line, mirror: Line) -> None:
    assert same(s, operate(operate(s, "/", mirror), "/", mirror))
