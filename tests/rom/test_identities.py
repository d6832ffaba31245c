"""The identities of the SKG book (its sections 5 to 8) at the prompt, for values of every size; the table of pairs."""

from __future__ import annotations

import re
from functools import cache

from hypothesis import assume, given, settings
from hypothesis import strategies as st
from romhelp import ROM, Board, fault

from skg.board import symbols

#: 7 digits, or as much of the drawing's size.
CLOSE = 1e-6

thousandths = st.integers(-60_000, 60_000).map(lambda n: f"{n / 1000:.3f}".replace("-0.000", "0"))
angles = st.integers(-36_000, 36_000).map(lambda n: f"{n / 100:.2f}".replace("-0.00", "0"))
radii = st.builds(lambda sign, n: f"{sign}{n / 1000:.3f}", st.sampled_from(["", "-"]), st.integers(1, 50_000))
points = st.builds("({},{})".format, thousandths, thousandths)
circles = st.builds("({}:{})".format, points, radii)
#: `:` binds tighter: the X axis moved, then turned.
lines = st.builds("(X:{}#{})".format, thousandths, angles)
elements = st.one_of(thousandths.map("({})".format), points, circles, lines)

quick = settings(max_examples=60)


@cache
def board() -> Board:
    """One board for all examples."""
    return Board()


def value(expression: str) -> tuple[float, ...] | int:
    """The canonical numbers of an expression, or its error's number."""
    paper = board().type(f"PRINT {expression}")
    if error := fault(paper):
        return error[0]
    return tuple(float(number) for number in re.findall(r"[-\d.E]+", paper[0]))


def same(left: str, right: str, exact: bool = False) -> None:
    """Both expressions have the same value, to the last printed digit or to 7 digits, or the same error."""
    a, b = value(left), value(right)
    if exact or isinstance(a, int) or isinstance(b, int):
        assert a == b, (left, a, right, b)
        return
    size = max(1.0, *map(abs, a))
    assert len(a) == len(b)
    assert all(abs(x - y) <= CLOSE * size for x, y in zip(a, b, strict=True)), (left, a, right, b)


def number(expression: str) -> float:
    """The value of an expression that must be a number."""
    numbers = value(expression)
    assert isinstance(numbers, tuple), (expression, numbers)
    return numbers[0]


def sizes(c: str, d: str) -> tuple[float, float, float]:
    """Of two circles, kept as C1 and C2, the distance of the centres and the radii: to leave out those that touch,
    where a micrometre decides."""
    board().type(f"C1={c}")
    board().type(f"C2={d}")
    return number("((K1 C1,K2 C1),(K1 C2,K2 C2))"), number("K3 C1"), number("K3 C2")


@quick
@given(elements)
def test_minus_twice(e: str) -> None:
    same(f"-(-{e})", e, exact=True)


@quick
@given(thousandths, angles)
def test_parallel_then_turned(d: str, a: str) -> None:
    same(f"(X:({d}))#({a})", f"(X#({a})):({d})")
    same(f"X:({d})#({a})", f"(X:({d}))#({a})", exact=True)


@quick
@given(points, points)
def test_line_reversed(p: str, q: str) -> None:
    same(f"{p}:{q}", f"-({q}:{p})")


@quick
@given(circles, circles)
def test_belt_reversed(c: str, d: str) -> None:
    """The line back is the same line the other way between the circles run backwards."""
    apart, r, q = sizes(c, d)
    assume(min(abs(apart - abs(r - q)), apart) > 0.01)
    same(f"{c}:{d}", f"-(-{d}:-{c})")


@quick
@given(lines, lines)
def test_crossing_of_lines(s: str, t: str) -> None:
    angle = value(f"({s},{t})")
    assume(isinstance(angle, tuple) and 0.5 < abs(angle[0]) < 179.5)
    same(f"{s}*{t}", f"{t}*{s}")
    same(f"{s}*{t}", f"{s}*-{t}")


@quick
@given(lines, circles)
def test_left_turn_of_line_and_circle(s: str, c: str) -> None:
    """S*C = -S*-C = -C*S = C*-S."""
    board().type(f"S1={s}")
    board().type(f"C1={c}")
    miss = abs(number("((K1 C1,K2 C1),S1)")) - abs(number("K3 C1"))
    assume(abs(miss) > 0.01)  # not where a micrometre decides
    for other in ("-S1*-C1", "-C1*S1", "C1*-S1"):
        same("S1*C1", other)


@quick
@given(circles, circles)
def test_left_turn_of_two_circles(c: str, d: str) -> None:
    """C*D = -C*-D = -D*C = D*-C."""
    apart, r, q = sizes(c, d)
    assume(min(abs(apart - abs(r) - abs(q)), abs(apart - abs(abs(r) - abs(q))), apart) > 0.01)
    for other in ("-C1*-C2", "-C2*C1", "C2*-C1"):
        same("C1*C2", other)


@quick
@given(points, lines)
def test_foot_and_mirror(p: str, s: str) -> None:
    """The foot is half way to the mirror image, and lies on the line; mirrored twice is where it was."""
    same(f"{p}#{s}", f"({p}+{p}/{s})/2")
    same(f"({p}#{s},{s})", "0")
    same(f"{p}/{s}/{s}", p)


@quick
@given(st.one_of(circles, lines), lines)
def test_quasi_mirror_twice(e: str, s: str) -> None:
    same(f"{e}/{s}/{s}", e)


@quick
@given(points, points)
def test_bisector(p: str, q: str) -> None:
    """The first point on the left; both as far; the mirror in it takes one to the other."""
    assume(p != q)
    distance = value(f"({p},{p}#{q})")
    assert distance[0] < 0
    same(f"({p},{p}#{q})", f"-({q},{p}#{q})")
    same(f"{p}/({p}#{q})", q)


@quick
@given(st.one_of(points, circles, lines), angles, points)
def test_turned_there_and_back(e: str, a: str, p: str) -> None:
    same(f"({e}#(({a}):{p}))#(-({a}):{p})", e)
    same(f"{e}#({a}):{p}", f"{e}#(({a}):{p})", exact=True)
    same(f"{e}#(({a}):O)", f"{e}#({a})")


@quick
@given(thousandths, thousandths, thousandths)
def test_priorities(a: str, b: str, c: str) -> None:
    """/ over *, * over -, - over +."""
    same(f"({a})*({b})/({c})", f"({a})*(({b})/({c}))", exact=True)
    same(f"({a})+({b})-({c})", f"({a})+(({b})-({c}))", exact=True)
    same(f"({a})-({b})*({c})", f"({a})-(({b})*({c}))", exact=True)


#: language.md, section 2.1: operators in the order of their ranks, with the pairs of kinds that each combines.
KINDS = "DPCST"
PAIRS = {
    ",": "DD PP PS SP SS",
    "#": "DD PD CD SD PT CT ST PP PS",
    ":": "PD CD SD SP SC PP CC CP PC DP",
    "+": "DD PP",
    "-": "DD PP",
    "*": "DD SS SC CS CC PD DP PP",
    "/": "DD PD PS CS SS PP",
}
#: A value of each kind; none is special for any other.
SOME = {"D": "3", "P": "(25,32)", "C": "((40,30):28)", "S": "(X:20#50)", "T": "(30:(4,5))"}


def test_table_of_pairs_holds_together() -> None:
    """GEOTAB: its distances lead to labels of byte-code, its keys are the pairs of language.md, section 2.1."""
    image = ROM.read_bytes()
    names = symbols(ROM.with_suffix(".sym").read_text())
    at, keys, labels = names["GADD"], [], {address for name, address in names.items() if name[0] == "G"}
    for byte in image[names["GEOTAB"] : names["GADD"]]:
        if byte < names["KEY1"]:
            at += byte
        elif byte < names["KINDS"]:
            assert at in labels, f"{at:04X}"
            keys.append(byte)
    assert byte == names["KINDS"] + names["KTURN"] + 1
    wanted = [
        25 * rank + 5 * KINDS.index(pair[0]) + KINDS.index(pair[1])
        for rank, pairs in enumerate(PAIRS.values(), 1)
        for pair in pairs.split()
    ]
    assert sorted(keys) == sorted(wanted)


def test_pairs_that_combine() -> None:
    """Every other pair is error 4. (A turn, D:P, is a right operand only, and cannot be printed.)"""
    for operator, pairs in PAIRS.items():
        for left in KINDS:
            for right in KINDS:
                expression = f"({SOME[left]}{operator}{SOME[right]})"
                combine = left + right in pairs.split() and (operator, left, right) != (":", "D", "P")
                assert (value(expression) != 4) == combine, expression
