"""Every form of a definition: SKG's text, worked out by the reference, is the element meant (docs/spec/tekhtran.md,
sections 3 to 5). What is meant is told by distances and angles, and of two by where the other one lies.
"""

from __future__ import annotations

import random
import re
from collections.abc import Callable
from importlib.resources import files

import pytest
from rivalhelp import EXACT, number
from test_xy_making import near, on, same
from tkhhelp import fault, made

from skg.ref.geometry import mirrored
from skg.ref.real import ZERO, cos, mp, sin
from skg.ref.values import Circle, Line, Point, Value
from skg.rivals.tekhtran_making import FORMS

#: So many of a form are made, of so many tried.
GOOD, TRIES = 6, 200
Elements = dict[str, Value]
#: The elements by SKG's names, the new one, and what {…} stood for.
Check = Callable[[Elements, Value, list], None]


def bearing(v: Point) -> float:
    """Direction of a vector, degrees."""
    return float(mp.degrees(mp.atan2(v.y, v.x)))


def same_bearing(one: float, other: float, period: int = 180) -> None:
    half = period / 2
    near((one - other + half) % period - half, 0, 1e-8)


def through(a: Point, b: Point) -> Line:
    """The line from one point to another."""
    d = (b - a) * (1 / (b - a).length())
    return Line(d.y, -d.x, d.y * a.x - d.x * a.y)


def decides(new: Point, other: Point, choice: str) -> None:
    """Of two points that differ, the new one is the one chosen."""
    key = "x" if choice[0] == "Х" else "y"
    step = float(getattr(new, key) - getattr(other, key))
    assert abs(step) > 1e-3
    assert (step > 0) == (choice[1] == "Б")


def chosen(new: Point, other: Point, choice: str) -> None:
    """The same, where the two may be one (near)."""
    if float((new - other).length()) > 0.2:
        decides(new, other, choice)


# Points


def at(_: Elements, new: Point, n: list) -> None:
    same(new, Point(n[0], n[1]))


def of_lines(e: Elements, new: Point, _: list) -> None:
    on(new, e["S0"])
    on(new, e["S1"])


def of_line_and_circle(e: Elements, new: Point, n: list) -> None:
    line, circle = e["S0"], e["C0"]
    near(line.distance(new), 0, 0.0011)
    on(new, circle)
    foot = circle.centre - line.normal * line.distance(circle.centre)
    chosen(new, foot * 2 - new, n[0])


def of_circles(e: Elements, new: Point, n: list) -> None:
    on(new, e["C0"])
    near((new - e["C1"].centre).length(), e["C1"].r, 0.0011)
    chosen(new, mirrored(new, through(e["C0"].centre, e["C1"].centre)), n[0])


def at_angle(e: Elements, new: Point, n: list) -> None:
    by = n[1] if n[0] == "ПРЧС" else -n[1]
    same(new, e["C0"].centre + Point(cos(by), sin(by)) * e["C0"].r)


def centre(e: Elements, new: Point, _: list) -> None:
    same(new, e["C0"].centre)


def along_circle(e: Elements, new: Point, n: list) -> None:
    circle, begin = e["C0"], e["P20"]
    on(new, circle)
    travel = bearing(new - circle.centre) - bearing(begin - circle.centre)
    turned = float(mp.degrees(n[1] / circle.r))
    same_bearing(travel, turned if n[0] == "ПРЧС" else -turned, 360)


def with_x(e: Elements, new: Point, n: list) -> None:
    on(new, e["S0"])
    near(new.x, n[0])


def with_y(e: Elements, new: Point, n: list) -> None:
    on(new, e["S0"])
    near(new.y, n[0])


def along_line(e: Elements, new: Point, n: list) -> None:
    on(new, e["S0"])
    near((new - e["P20"]).length(), n[0])
    chosen(new, e["P20"] * 2 - new, n[1])


def moved(e: Elements, new: Point, n: list) -> None:
    same(new - e["P0"], Point(n[0], n[1]))


def away(e: Elements, new: Point, n: list) -> None:
    by = n[1] if n[0] == "ПРЧС" else -n[1]
    same(new - e["P0"], Point(cos(by), sin(by)) * n[2])


def transformed(e: Elements, new: Point, n: list) -> None:
    p = e["P0"]
    z = n[12]
    rows = [n[i] * p.x + n[i + 1] * p.y + n[i + 2] * z + n[i + 3] for i in (0, 4, 8)]
    same(new, Point(rows[0], rows[1]))
    near(e["D1"], rows[2])


def same_as_point(e: Elements, new: Point, _: list) -> None:
    same(new, e["P0"])


def same_as_vector(e: Elements, new: Point, _: list) -> None:
    same(new, e["V0"])


# Lines


def of_numbers(_: Elements, new: Line, n: list) -> None:
    on(Point(n[0], n[1]), new)
    on(Point(n[2], n[3]), new)


def through_both(e: Elements, new: Line, _: list) -> None:
    on(e["P0"], new)
    on(e["P1"], new)


def touching_point(circle: Circle, new: Line) -> Point:
    near(abs(new.distance(circle.centre)), circle.r, 0.0011)
    return circle.centre - new.normal * new.distance(circle.centre)


def is_on_side(circle: Circle, new: Line, looking: Point, side: str) -> None:
    touch = touching_point(circle, new)
    assert (looking.cross(touch - circle.centre) > 0) == (side == "СЛЕВА")


def touching(e: Elements, new: Line, n: list) -> None:
    near(new.distance(e["P0"]), 0, 0.0011)
    looking = e["C0"].centre - e["P0"]
    is_on_side(e["C0"], new, looking, n[0])


def touching_first(e: Elements, new: Line, n: list) -> None:
    near(new.distance(e["P0"]), 0, 0.0011)
    is_on_side(e["C0"], new, e["P0"] - e["C0"].centre, n[0])
    assert new.direction.dot(e["P0"] - e["C0"].centre) > 0


def touching_chosen(e: Elements, new: Line, n: list) -> None:
    near(new.distance(e["P0"]), 0, 0.0011)
    touch = touching_point(e["C0"], new)
    chosen(touch, mirrored(touch, through(e["P0"], e["C0"].centre)), n[0])


def touching_both(e: Elements, new: Line, n: list) -> None:
    looking = e["C1"].centre - e["C0"].centre
    is_on_side(e["C0"], new, looking, n[0])
    is_on_side(e["C1"], new, looking, n[1])


def at_bearing(e: Elements, new: Line, n: list) -> None:
    on(e["P0"], new)
    same_bearing(bearing(new.direction), float(n[0]))


def turned(e: Elements, new: Line, n: list) -> None:
    on(e["P0"], new)
    same_bearing(bearing(new.direction), bearing(e["S0"].direction) + float(n[0]))


def square(e: Elements, new: Line, _: list) -> None:
    on(e["P0"], new)
    near(new.direction.dot(e["S0"].direction), 0)


def parallel(e: Elements, new: Line, _: list) -> None:
    on(e["P0"], new)
    near(new.direction.cross(e["S0"].direction), 0)


# Circles, vectors, numbers


def circle(_: Elements, new: Circle, n: list) -> None:
    same(new.centre, Point(n[0], n[1]))
    near(new.r, n[2])


def about(e: Elements, new: Circle, n: list) -> None:
    same(new.centre, e["P0"])
    near(new.r, n[0])


def through_three(e: Elements, new: Circle, _: list) -> None:
    assert new.r > 0
    for name in ("P0", "P1", "P2"):
        near((e[name] - new.centre).length(), new.r, 1e-8)


def times(e: Elements, new: Point, n: list) -> None:
    same(new, Point(e["V0"].x * n[0], e["V0"].y * n[0]))


def between(_: Elements, new: Point, n: list) -> None:
    same(new, Point(n[2] - n[0], n[3] - n[1]))


def of_line(e: Elements, new: Point, n: list) -> None:
    near(new.length(), 1)
    near(new.cross(e["S0"].direction), 0)
    decides(new, -new, n[0])


def value(_: Elements, new: mp.mpf, n: list) -> None:
    near(new, n[0])


def sums(_: Elements, new: mp.mpf, n: list) -> None:
    near(new, 2 * (n[0] - n[1]) / n[2] + -n[1] * n[0] - n[2])


#: Form, what stands before it, its right side, what it makes. {n} a number, {r} a positive one, {a} an angle, {m} a
#: choice, {t} a sense, {s} a side.
ON_CIRCLE, ON_LINE = "ТЧ20 = КР0, ПРЧС, 33", "ТЧ20 = ТЧ1, ПЕРЕНОС, 1, 2; ПР0 = ТЧ20, 61"
TWELVE = ", ".join(["{n}"] * 12)
CHECKS: list[tuple[str, str, str, str, Check]] = [
    ("point_at", "", "ТЧ", "{n}, {n}", at),
    ("point_at", "", "ТЧ", "{n}, {n}, {n}", at),
    ("point_of_lines", "", "ТЧ", "ПР0, ПР1", of_lines),
    ("point_of_lines", "", "ТЧ", "ПЕРЕСЕЧ, ПР0, ПР1", of_lines),
    ("point_of_curves", "", "ТЧ", "ПР0, КР0, {m}", of_line_and_circle),
    ("point_of_curves", "", "ТЧ", "ПЕРЕСЕЧ, ПР0, КР0, {m}", of_line_and_circle),
    ("point_of_curves", "", "ТЧ", "КР0, КР1, {m}", of_circles),
    ("point_of_curves", "", "ТЧ", "ПЕРЕСЕЧ, КР0, КР1, {m}", of_circles),
    ("point_at_angle", "", "ТЧ", "КР0, {t}, {a}", at_angle),
    ("point_centre", "", "ТЧ", "КР0", centre),
    ("point_centre", "", "ТЧ", "ЦЕНТР, КР0", centre),
    ("point_along_circle", ON_CIRCLE, "ТЧ", "КР0, ТЧ20, {t}, {r}", along_circle),
    ("point_with_coordinate", "", "ТЧ", "ПР0, ХКООРД, {n}", with_x),
    ("point_with_coordinate", "", "ТЧ", "ПР0, УКООРД, {n}", with_y),
    ("point_along_line", ON_LINE, "ТЧ", "ПР0, ТЧ20, {r}, {m}", along_line),
    ("point_moved", "", "ТЧ", "ТЧ0, ПЕРЕНОС, {n}, {n}", moved),
    ("point_away", "", "ТЧ", "ТЧ0, {t}, {a}, {r}", away),
    ("point_transformed", f"МК1 = {TWELVE}; ПЛЗ {{n}}; ТЧ0 = ТЧ0", "ТЧ", "ТЧ0, МК1", transformed),
    ("point_same", "", "ТЧ", "ТЧ0", same_as_point),
    ("point_of_vector", "", "ТЧ", "ВЕ0", same_as_vector),
    ("line_of_numbers", "", "ПР", "{n}, {n}, {n}, {n}", of_numbers),
    ("line_through", "", "ПР", "ТЧ0, ТЧ1", through_both),
    ("line_touching", "", "ПР", "ТЧ0, {s}, КР0", touching),
    ("line_touching_first", "", "ПР", "{s}, КР0, ТЧ0", touching_first),
    ("line_touching_chosen", "", "ПР", "ТЧ0, КР0, {m}", touching_chosen),
    ("line_touching_both", "", "ПР", "{s}, КР0, {s}, КР1", touching_both),
    ("line_at_angle", "", "ПР", "ТЧ0, {a}", at_bearing),
    ("line_turned", "", "ПР", "ПР0, ТЧ0, {a}", turned),
    ("line_square", "", "ПР", "ТЧ0, ПЕРП, ПР0", square),
    ("line_parallel", "", "ПР", "ТЧ0, ПАРЛЕЛ, ПР0", parallel),
    ("circle_of_numbers", "", "КР", "{n}, {n}, {r}", circle),
    ("circle_about", "", "КР", "ТЧ0, {r}", about),
    ("circle_through", "", "КР", "ТЧ0, ТЧ1, ТЧ2", through_three),
    ("vector_of_numbers", "", "ВЕ", "{n}, {n}", at),
    ("vector_of_numbers", "", "ВЕ", "{n}, {n}, {n}", at),
    ("vector_times", "", "ВЕ", "{n}, ВЕ0", times),
    ("vector_to_point", "", "ВЕ", "ТЧ0", same_as_point),
    ("vector_between", "", "ВЕ", "{n}, {n}, {n}, {n}", between),
    ("vector_of_line", "", "ВЕ", "ПР0, {m}", of_line),
    ("number_of", "", "Ч", "{n}", value),
    ("number_of", "", "Ч", "2*({n} - {n})/{r} + -", sums),
]
#: These make nothing that SKG has; `transformed` and `test_height` look at what they do.
NOT_HERE = {"matrix_of_numbers", "plane_at", "plane_of_numbers"}


def start(rng: random.Random) -> str:
    """Three elements of each kind, of small numbers."""
    text = ""
    for i in range(3):
        text += f"ТЧ{i} = {number(rng, -9, 9)}, {number(rng, -9, 9)}\n"
        text += f"ПР{i} = {number(rng, -9, 9)}, {number(rng, -9, 9)}, {number(rng, -9, 9)}, {number(rng, -9, 9)}\n"
        text += f"КР{i} = {number(rng, -9, 9)}, {number(rng, -9, 9)}, {number(rng, 1, 8)}\n"
        text += f"ВЕ{i} = {number(rng, -9, 9)}, {number(rng, -9, 9)}\n"
    return text


def filled(rng: random.Random, template: str) -> tuple[str, list]:
    """A template's text, and what stands in it: numbers, words."""
    makers = {
        "n": lambda: number(rng, -9, 9),
        "r": lambda: number(rng, 1, 9),
        "a": lambda: str(rng.choice([0, 30, -90, 71.3, 180, 200])),
        "m": lambda: rng.choice(["ХБ", "ХМ", "УБ", "УМ"]),
        "t": lambda: rng.choice(["ПРЧС", "ПОЧС"]),
        "s": lambda: rng.choice(["СПРАВА", "СЛЕВА"]),
    }
    words: list = []

    def word(match: re.Match[str]) -> str:
        text = makers[match[1]]()
        words.append(mp.mpf(text) if match[1] in "nra" else text)
        return text

    return re.sub(r"\{(\w)\}", word, template), words


def test_every_form_is_checked() -> None:
    grammar = files("skg.rivals").joinpath("tekhtran.lark").read_text("utf-8")
    names = set(re.findall(r"-> ((?:point|line|circle|vector|matrix|plane|number)_\w+)", grammar))
    assert names == set(FORMS)
    assert {name for name, *_ in CHECKS} | NOT_HERE == set(FORMS)


@pytest.mark.parametrize("form", CHECKS, ids=lambda form: form[3])
def test_form(form: tuple[str, str, str, str, Check]) -> None:
    name, before, letters, right, check = form
    rng = random.Random(f"{name} {right}")
    good = 0
    for _ in range(TRIES):
        text, words = filled(rng, f"{start(rng)}{before}\n{letters}50 = {right}")
        if right.endswith("-"):
            # The same numbers once more.
            x, y, z = (f"({mp.nstr(n, 12)})" for n in words)
            text += f"{y}*{x} - {z}"
        if "ТЧ50" in text:
            text += "\nЧ1 = КООРД(3, ТЧ50)"
        if fault(text):
            continue
        elements = made(text)
        key = {"ТЧ": "P50", "ПР": "S50", "КР": "C50", "ВЕ": "V50", "Ч": "D1"}[letters]
        check(elements, elements[key], words)
        good += 1
        if good == GOOD:
            return
    assert good >= 4, f"only {good} could be made"


@pytest.mark.parametrize("seed", range(12))
def test_coordinates(seed: int) -> None:
    """КООРД: the canonical forms, a line's with the sign that the specification says."""
    rng = random.Random(seed)
    text = start(rng) + f"ПР1 = ТЧ1, {rng.choice([0, 90, 180, 270, 45, 225])}\nТЧ8 = 0, 0\nПР2 = ТЧ8, ПАРЛЕЛ, ПР1\n"
    for kind in ("ПР0", "ПР1", "ПР2", "ТЧ0", "КР0", "ВЕ0"):
        text += "".join(f"Н{kind}{i} = КООРД({i}, {kind})\n" for i in (1, 2, 3))
    e = made(text)
    found = [[e[f"D{3 * k + i}"] for i in (1, 2, 3)] for k in range(6)]
    for (c, s, p), name in zip(found, ("S0", "S1", "S2"), strict=False):
        near(c * c + s * s, 1)
        assert p > -EXACT
        if p < EXACT:
            assert -EXACT < float(mp.degrees(mp.atan2(s, c))) < 180 - EXACT
        for t in (-3, 0, 5):
            point = e[name].normal * e[name].g + e[name].direction * t
            near(c * point.x + s * point.y - p, 0)
    for row, name in zip(found[3:], ("P0", "C0", "V0"), strict=True):
        for one, other in zip(row, (e[name].x, e[name].y, getattr(e[name], "r", ZERO)), strict=True):
            near(one, other)


def test_every_sign_of_a_line_is_met() -> None:
    """Lines whose numbers SKG has with the other sign, p = 0 included."""
    text = "ТЧ0 = 0, 0; ТЧ1 = 3, 4\n"
    ways = [(p, a) for p in ("ТЧ0", "ТЧ1") for a in (0, 60, 90, 135, 180, 240, 270, 315)]
    for i, (p, a) in enumerate(ways):
        text += f"ПР{i} = {p}, {a}; А{i} = КООРД(1, ПР{i}); Б{i} = КООРД(2, ПР{i}); В{i} = КООРД(3, ПР{i})\n"
    e = made(text)
    for i, (p, a) in enumerate(ways):
        c, s, d = (float(e[f"D{3 * i + k}"]) for k in (1, 2, 3))
        x, y = (0, 0) if p == "ТЧ0" else (3, 4)
        # The normal that points to the line's right, or the other one.
        u, v = float(sin(mp.mpf(a))), -float(cos(mp.mpf(a)))
        wanted = u * x + v * y
        if wanted < -1e-9 or abs(wanted) < 1e-9 and (v < -1e-9 or abs(v) < 1e-9 and u < 0):
            u, v, wanted = -u, -v, -wanted
        assert max(abs(c - u), abs(s - v), abs(d - wanted)) < 1e-9, (p, a)


def test_height() -> None:
    """ПЛЗ: the text's own example, and what gives a z of its own."""
    names = "ТЧ1 ТЧ2 ТЧ8 ТЧ9 ТЧ10 ТЧ11 ТЧ12 ВЕ2 ВЕ3 ТЧ13 ТЧ100"
    text = """
        ТЧ1 = 1, 2
        ПЛОСК П1, ПЛ14
        ПЛ14 = 150; П1 = -30
        ПЛЗ ПЛ14; ТЧ2 = 1, 2
        ПЛЗ П1; ТЧ8 = 1, 2; ТЧ9 = 1, 2, 7
        ВЕ1 = 1, 2, 9; ТЧ10 = ВЕ1; ТЧ11 = ТЧ9
        МК1 = 1,0,0,0, 0,1,0,0, 2,0,1,5; ТЧ12 = ТЧ9, МК1
        ВЕ2 = ТЧ9; ВЕ3 = -2, ВЕ2
        ПЛЗ 2*3; ТЧ13 = 0, 0
        ПЛЗ ОТМЕН; ТЧ100 = 1, 2
    """
    e = made(text + "".join(f"Ы{i} = КООРД(3, {name})\n" for i, name in enumerate(names.split())))
    assert [float(e[f"D{i}"]) for i in range(1, 12)] == [0, 150, -30, 7, 9, -30, 14, 7, -14, 6, 0]


def test_planes_by_their_numbers() -> None:
    """A tilted plane gives each point its own z; an upright one none; cosines make 1."""
    text = """
        ПЛ9 = 0, 0, 1, 10; ПЛЗ ПЛ9; ТЧ1 = 5, 1
        ПЛ8 = 0.6, 0, 0.8, 10; ПЛЗ ПЛ8; ТЧ2 = 5, 1; ТЧ3 = -5, 7
    """
    e = made(text + "".join(f"Ы{i} = КООРД(3, ТЧ{i})\n" for i in (1, 2, 3)))
    assert [float(e[f"D{i}"]) for i in (1, 2, 3)] == [10, 8.75, 16.25]
    assert fault("ПЛ9 = 1, 0, 0, 10\nПЛЗ ПЛ9\n")
    assert fault("ПЛ9 = 1, 1, 0, 10\n")


def test_defined_again() -> None:
    """A name may be defined again, by itself too; what was made of it stays."""
    e = made("ТЧ1 = 1, 2; ТЧ2 = ТЧ1, ПЕРЕНОС, 1, 1; ТЧ1 = ТЧ1, ПЕРЕНОС, 5, 0; А = 1; А = А + 1; Б = А*3")
    same(e["P1"], Point(mp.mpf(6), mp.mpf(2)))
    same(e["P2"], Point(mp.mpf(2), mp.mpf(3)))
    near(e["D1"], 2)
    near(e["D2"], 6)
