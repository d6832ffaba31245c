"""Errors of the operations of language.md, section 2.1: the worst ones measured, and the bounds of docs/firmware.md.

`python tests/floats/bounds.py` writes that table anew. Constants are multiples of 1/64 up to 64 in size, which floats
hold exactly, so that nothing but the operation itself is measured. The unit U is 2⁻³² of 64 mm, the last place of a
coordinate from 32 to 64 mm: 1.5·10⁻⁵ µm; of a line's direction it is 2⁻³² rad. Where an operation divides by
something small, the error is measured times that (a crossing's: times the sine of its angle).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from math import cos, sin, sqrt, tau
from pathlib import Path
from random import Random

import numpy as np
from floathelp import ROM, value

from skg.board import Machine, symbols
from skg.ref import real
from skg.ref.interpreter import Interpreter
from skg.ref.near import Watch
from skg.ref.tape import Punch
from skg.ref.values import Line, Point, canonical

PAGE = Path(__file__).resolve().parents[2] / "docs" / "firmware.md"
#: mm: no coordinate and no radius is larger; and the unit in mm.
SIZE = 64
U = SIZE * 2.0**-32
#: Expressions of each kind that are measured.
N = 150

#: What an operation divides by, from its operands as the reference has them: 1 where it divides by nothing.
Flatness = Callable[[list], float]


@dataclass(frozen=True)
class Row:
    """One operation: expressions of named operands, the bound in U, what it divides by, why the bound holds."""

    name: str
    text: str
    bound: float
    why: str
    flatness: Flatness | None = None


def separation(v: list) -> float:
    """Distance of two points, in sizes of the drawing."""
    return float((v[1] - v[0]).length()) / SIZE


def sine(v: list) -> float:
    """Of the angle between two lines through pairs of points."""
    return float(abs(v[0].normal.cross(v[1].normal)))


def line_circle(v: list) -> float:
    """Sine of the angle at which a line crosses a circle."""
    miss = float(v[0].distance(v[1].centre) / v[1].r)
    return sqrt(1 - miss * miss) if abs(miss) < 1 else 0


def circles(v: list) -> float:
    """Sine of the angle at which two circles cross, times the distance of the centres, in sizes of the drawing."""
    d, r, q = float((v[0].centre - v[1].centre).length()), abs(float(v[0].r)), abs(float(v[1].r))
    cosine = (r * r + q * q - d * d) / (2 * r * q) if r * q else 1
    return sqrt(1 - cosine * cosine) * min(1, d / SIZE) if abs(cosine) < 1 else 0


def belt(v: list) -> float:
    """Cosine of the angle between belt and centres, times their distance in sizes of the drawing."""
    d, e = float((v[0].centre - v[1].centre).length()), float(v[0].r - v[1].r)
    return sqrt(1 - (e / d) ** 2) * min(1, d / SIZE) if abs(e) < d else 0


ROWS = [
    Row("`P+P` `P-P`", "P{a}+P{b}", 1.0, "one rounding; the sum may be twice the size"),
    Row("`P,P`", "(P{a},P{b})", 2.0, "two squares, a sum, a root"),
    Row("`P,S`", "(P{a},S{b})", 3.0, "two products and two sums of half a unit each, γ"),
    Row("`D#A`", "D{a}#A{b}", 2.0, "sine and cosine to 2⁻³¹, a product"),
    Row("`P#A`", "P{a}#A{b}", 3.0, "two of these and their sum"),
    Row("`P#(A:P)`", "P{a}#(A{b}:P{c})", 5.0, "the same from twice as far, back again"),
    Row("`S#(A:P)`", "S{a}#(A{b}:P{c})", 6.0, "the normal turned; γ from two scalar products"),
    Row("`P:P`", "P{a}:P{b}", 3.0, "root and quotients; γ a scalar product", separation),
    Row("`P#P`", "P{a}#P{b}", 3.0, "the same", separation),
    Row("`C:C`", "C{a}:C{b}", 4.0, "two unit vectors, one into the other", belt),
    Row("`S:P`", "S{a}:P{b}", 2.0, "a scalar product"),
    Row("`P#S`", "P{a}#S{b}", 3.0, "a distance, moved along the normal"),
    Row("`P/S`", "P{a}/S{b}", 6.0, "the same twice as far"),
    Row("`S/S`", "S{a}/S{b}", 5.0, "the same for the normal, and γ"),
    Row("`S*S`", "S{a}*S{b}", 3.0, "Cramer's rule: three differences of products", sine),
    Row("`S*C`", "S{a}*C{b}", 5.0, "foot, and the other leg of a right triangle", line_circle),
    Row("`C*C`", "C{a}*C{b}", 7.0, "the line through both crossings first", circles),
]


@cache
def board() -> tuple[Machine, Interpreter, dict[str, int]]:
    """Firmware and reference with the same operands in memory: P C S A D with subscripts below COUNT."""
    machine, exact = Machine(ROM, 16), Interpreter((), Watch(), Punch())
    assert machine.run() == "prompt"
    random = Random(5)

    def number(low: float, high: float) -> str:
        return f"{dyadic(random.uniform(low, high)):.6f}"

    def place() -> str:
        return f"({number(-SIZE / 1.5, SIZE / 1.5)},{number(-SIZE / 1.5, SIZE / 1.5)})"

    for n in range(COUNT):
        for line in (f"P{n}={place()}", f"C{n}={place()}:{number(1, 48)}", f"A{n}={number(-180, 180)}",
                     f"D{n}={number(1, SIZE)}", f"S{n}=P{n}:{place()}"):  # fmt: skip
            machine.type(line + "\r")
            assert machine.run() == "prompt"
            assert exact.load(line) is None
    names = symbols(ROM.with_suffix(".sym").read_text())
    for n in range(COUNT):  # a line is made of points: take the firmware's own as the true one
        machine.type(f"S{n}=S{n}\r")
        machine.run()
        a, b, g = numbers(machine, names, 3)
        exact.variables["S", n] = Line(*(exact_number(v) for v in (a, b, g)))
    return machine, exact, names


#: Operands of each kind.
COUNT = 24


def dyadic(value: float) -> float:
    """The nearest multiple of 1/64."""
    return round(value * 64) / 64


def corner(random: Random) -> tuple[list[str], int, Callable[[], tuple[Point, float]]]:
    """A corner between points, as offset: statements, where the firmware has it, the true place and the factor 1."""
    _, exact, names = board()
    x, y, way = random.uniform(-40, 40), random.uniform(-40, 40), random.uniform(0, tau)
    places = [(x, y)]
    for turn in (0, random.choice([-1, 1]) * 10 ** random.uniform(-2, 0)):
        x, y, way = x + 9 * cos(way + turn), y + 9 * sin(way + turn), way + turn
        places.append((x, y))
    text = ",".join(f"({dyadic(x):.6f},{dyadic(y):.6f})" for x, y in places)
    return ["R=0.125", f"CUT {text}"], names["MREG"] + 135, lambda: (exact.cutter.route.element.start, 1.0)


def centre(random: Random) -> tuple[list[str], int, Callable[[], tuple[Point, float]]]:
    """The second arc of a fitted span: statements, where the firmware has it, the true centre and w²/2r²."""
    _, exact, names = board()
    x, y, way = random.uniform(-40, 40), random.uniform(-40, 40), random.uniform(0, 360)
    length, bend = 10 ** random.uniform(0, 1.3), random.uniform(4, 40)
    u, v = x + length * cos(way * tau / 360), y + length * sin(way * tau / 360)
    ends = (x, y, dyadic(way - bend)), (u, v, dyadic(way + bend * random.uniform(0.7, 1.3)))

    def found() -> tuple[Point, float]:
        route = exact.cutter.route
        arc, w = route.element.nominal, route.point - route.element.start
        return arc.centre, float(w.dot(w) / (2 * arc.r**2))

    return [f"FIT ({dyadic(x):.6f},{dyadic(y):.6f}),{a:.6f}" for x, y, a in ends], names["MCUR"] + 1, found


def measure_route(name: str, make: Callable) -> float:
    """Worst error of a place that the route finds, in U, times its factor."""
    machine, exact, _ = board()
    random, worst = Random(name), 0.0
    for _ in range(N):
        lines, address, found = make(random)
        for line in ["FROM O", *lines]:
            machine.type(line + "\r")
            assert machine.run() == "prompt"
            assert exact.load(line) is None, line
        true, scale = found()
        raw = np.frombuffer(machine.peek(address, 10), np.uint8).reshape(2, 5)
        got = [exact_number(value(row)) for row in raw]
        worst = max(worst, *(scale * abs(float(g - w)) / U for g, w in zip(got, (true.x, true.y), strict=True)))
    return worst


def exact_number(v: Fraction) -> real.Real:
    """A fraction as the reference's number."""
    return real.mp.mpf(v.numerator) / v.denominator


def numbers(machine: Machine, names: dict[str, int], count: int) -> list[Fraction]:
    """The value of the moment, a0 a1 a2, as fractions."""
    raw = np.frombuffer(machine.peek(names["MA"], 15), np.uint8).reshape(3, 5)
    return [value(row) for row in raw[:count]]


def measure(row: Row) -> float:
    """Worst error of an operation, in U (directions: in 2⁻³²), times what it divides by."""
    machine, exact, names = board()
    random, worst, done = Random(row.name), 0.0, 0
    letters = [part[-1] for part in row.text.split("{")[:-1]]
    while done < N:
        a, b, c = random.sample(range(COUNT), 3)
        text = row.text.format(a=a, b=b, c=c)
        operands = [exact.variables[letter, n] for letter, n in zip(letters, (a, b, c), strict=False)]
        scale = row.flatness(operands) if row.flatness else 1.0
        if scale < 0.01:
            continue
        kind = "D" if text[0] == "(" else None
        for letter in [kind] if kind else "PCS":
            if exact.load(f"{letter}99={text}") is None:
                break
        else:
            continue  # no such crossing
        true = exact.variables[letter, 99]
        if isinstance(true, Point) and max(abs(true.x), abs(true.y)) > 2 * SIZE:
            continue
        machine.type(f"{letter}99={text}\r")
        assert machine.run() == "prompt"
        want = [true] if letter == "D" else list(canonical(true))
        got = [exact_number(v) for v in numbers(machine, names, len(want))]
        unit = [2.0**-32, 2.0**-32, U] if letter == "S" else [U, U]
        errors = [abs(float(g - w)) / u for g, w, u in zip(got, want, unit, strict=False)]
        worst, done = max(worst, scale * max(errors)), done + 1
    return worst


def table() -> list[str]:
    """The rows of docs/firmware.md: measured worst and bound; AssertionError where the bound does not hold."""
    lines = ["| operation | worst, measured | bound | why |", "|---|---|---|---|"]
    for row in ROWS:
        worst = measure(row)
        assert worst <= row.bound, (row, worst)
        factor = FACTORS.get(row.flatness, "")
        lines.append(f"| {row.name} | {worst:.1f} | {row.bound:g}{factor} | {row.why} |")
    for name, make, bound, factor, why in ROUTES:
        worst = measure_route(name, make)
        assert worst <= bound, (name, worst)
        lines.append(f"| {name} | {worst:.1f} | {bound:g}{factor} | {why} |")
    return lines


#: Places of a route: what, how it is made, the bound in U, what it is multiplied by, why.
ROUTES = [
    ("corner at a point between points, R of 0.1 mm", corner, 1.0, "", "seen from the point, so however flat it is"),
    (
        "centre of a fitted arc of radius r and chord w",
        centre,
        1.0,
        " · 2r²/w²",
        "w is seen from the node; nodes that are no floats add up to ½ each",
    ),
]


#: How the table says what an operation divides by.
FACTORS: dict[Flatness | None, str] = {
    separation: " · 64 mm / distance",
    sine: " / sine",
    line_circle: " / sine",
    circles: " / sine · 64 mm / distance",
    belt: " / cosine · 64 mm / distance",
}

START, END = "<!-- bounds -->\n\n", "\n\n<!-- end of bounds -->"


def main() -> None:
    """Write the table into the page."""
    text = PAGE.read_text()
    before, rest = text.split(START)
    PAGE.write_text(before + START + "\n".join(table()) + END + rest.split(END)[1])


if __name__ == "__main__":
    main()
