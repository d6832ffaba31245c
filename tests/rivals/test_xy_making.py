"""Every form of ⊕: SKG's text, worked out by the reference, is the element meant (docs/spec/xy.md, section 3)."""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest
from rivalhelp import EXACT, fault, gap, made, number

from skg.ref.geometry import direction, mirrored
from skg.ref.real import cos, mp, sin
from skg.ref.values import Circle, Line, Point, Value
from skg.rivals.making import FORMS

#: So many of a form are made, of so many tried.
GOOD, TRIES = 6, 400
Elements = dict[str, Value]
Check = Callable[[Elements, Value, list], None]


def near(a: object, b: object, limit: float = EXACT) -> None:
    assert abs(float(a) - float(b)) < limit, (a, b)


def same(p: Point, q: Point) -> None:
    near((p - q).length(), 0)


def on(p: Point, e: Circle | Line) -> None:
    near(e.distance(p) if isinstance(e, Line) else (p - e.centre).length() - abs(e.r), 0)


def enters(p: Point, runs: Circle | Line, circle: Circle) -> None:
    on(p, runs)
    on(p, circle)
    assert direction(runs, p).dot(p - circle.centre) <= EXACT


def angle(line: Line) -> float:
    return float(mp.degrees(mp.atan2(line.direction.y, line.direction.x)))


def same_angle(one: float, other: float) -> None:
    near((one - other + 180) % 360 - 180, 0)


def turns_in_order(circle: Circle, places: list[Point]) -> bool:
    """Tells whether a clockwise circle passes places in this order."""
    at = [float(mp.atan2(p.y - circle.y, p.x - circle.x)) for p in places]
    ahead = [(at[0] - a) % (2 * mp.pi) for a in at]
    return ahead == sorted(ahead)


def touch(circle: Circle, e: Value) -> Point:
    """The point where a circle touches an element: the element's point nearest to it."""
    if isinstance(e, Point):
        return e
    if isinstance(e, Line):
        return circle.centre - e.normal * e.distance(circle.centre)
    away = e.centre - circle.centre
    inner = circle.r * e.r > 0 and abs(circle.r) < abs(e.r)
    return circle.centre + away * ((-1 if inner else 1) * abs(circle.r) / away.length())


def negative(value: Value) -> Value:
    return Circle(value.x, value.y, -value.r) if isinstance(value, Circle) else Line(-value.a, -value.b, -value.g)


# A template: {d} {x} {y} an element, ± a sign or none, {n} a number, {a} an angle, {r} a positive number. A check gets
# all elements, the new one, and the arguments: elements with their sign, numbers.
def point(_: Elements, new: Point, arguments: list) -> None:
    near(new.x, arguments[0])
    near(new.y, arguments[1])


def of_circle(_: Elements, new: Point, arguments: list) -> None:
    circle, at = arguments
    same(new, circle.centre + Point(cos(at), sin(at)) * abs(circle.r))


def crossing(_: Elements, new: Point, arguments: list) -> None:
    on(new, arguments[0])
    on(new, arguments[1])


def entering(_: Elements, new: Point, arguments: list) -> None:
    enters(new, *arguments)


def entering_backwards(_: Elements, new: Point, arguments: list) -> None:
    enters(new, arguments[1], arguments[0])


def line(_: Elements, new: Line, arguments: list) -> None:
    on(Point(arguments[0], arguments[1]), new)
    same_angle(angle(new), float(arguments[2]))


def line_at(_: Elements, new: Line, arguments: list) -> None:
    near(gap(arguments[0], new), 0)
    same_angle(angle(new), float(arguments[1]))


def line_from_line(_: Elements, new: Line, arguments: list) -> None:
    near(gap(arguments[0], new), 0)
    same_angle(angle(new) - angle(arguments[1]), float(arguments[2]))


def belt(_: Elements, new: Line, arguments: list) -> None:
    assert all(gap(e, new) < 0.002 for e in arguments)
    ends = [e if isinstance(e, Point) else e.centre for e in arguments]
    assert new.direction.dot(ends[1] - ends[0]) > -EXACT


def parallel(_: Elements, new: Line, arguments: list) -> None:
    old, left = arguments
    same_angle(angle(new), angle(old))
    foot = old.normal * old.g
    near(new.distance(foot - old.normal * left), 0)


def bisector(_: Elements, new: Line, arguments: list) -> None:
    one, other = arguments
    # Of a step along each, the sum points half way.
    half = one.direction + other.direction
    near(new.direction.cross(half) / half.length(), 0)
    assert new.direction.dot(half) > 0
    sine = one.normal.cross(other.normal)
    on(Point((one.g * other.b - other.g * one.b) / sine, (one.a * other.g - other.a * one.g) / sine), new)


def circle(_: Elements, new: Circle, arguments: list) -> None:
    same(new.centre, Point(arguments[0], arguments[1]))
    near(new.r, -arguments[2])


def about(_: Elements, new: Circle, arguments: list) -> None:
    same(new.centre, arguments[0])
    near(new.r, -arguments[1])


def about_touching(_: Elements, new: Circle, arguments: list) -> None:
    centre, e = arguments
    same(new.centre, centre)
    assert new.r < 0
    if isinstance(e, Line):
        near(abs(e.distance(centre)), -new.r)
        return
    assert gap(e, new) < EXACT
    if isinstance(e, Circle):
        # No smaller one does.
        apart = (e.centre - centre).length()
        assert e.r > 0 or apart > abs(e.r) or abs(new.r) <= abs(e.r)


def two(_: Elements, new: Circle, arguments: list) -> None:
    e, f, r = arguments
    near(new.r, -r)
    assert gap(e, new) < 0.002
    assert gap(f, new) < 0.002
    if isinstance(e, Line) and isinstance(f, Line):
        return  # there is one only
    u, v = touch(new, e) - new.centre, touch(new, f) - new.centre
    assert u.cross(v) < 1e-2, "clockwise, less than half a turn"


def three(_: Elements, new: Circle, arguments: list) -> None:
    assert new.r < 0
    for e in arguments:
        near(gap(e, new), 0, 1e-7)
    ahead = [float(mp.atan2(*reversed([getattr(touch(new, e) - new.centre, c) for c in "xy"]))) for e in arguments]
    ways = [(ahead[0] - a) % (2 * float(mp.pi)) for a in ahead]
    assert ways[1] <= ways[2] + 1e-9 or _others(new, arguments) == 1


def _others(new: Circle, arguments: list) -> int:
    """The number of circles: with the order of the arguments reversed, another one is made or the same."""
    from skg.rivals.plane import ExactCircle, ExactLine, ExactPoint, touching_three

    def exact(e: Value) -> object:
        if isinstance(e, Point):
            return ExactPoint(e.x, e.y)
        if isinstance(e, Line):
            return ExactLine(ExactPoint(e.a * e.g, e.b * e.g), ExactPoint(-e.b, e.a))
        return ExactCircle(ExactPoint(e.x, e.y), e.r)

    other = touching_three(*(exact(e) for e in reversed(arguments)))
    return 1 if abs(other.centre.x - new.x) + abs(other.centre.y - new.y) < EXACT else 2


CHECKS: dict[tuple[str, str], tuple[str, Check]] = {
    ("D", "NN"): ("{n},{n}", point),
    ("D", "YN"): ("{y},{a}", of_circle),
    ("D", "XX"): ("±{x},±{x}", crossing),
    ("D", "XY"): ("±{x},{y}", entering),
    ("D", "YX"): ("{y},±{x}", entering_backwards),
    ("D", "YY"): ("±{y},{y}", entering),
    ("X", "NNN"): ("{n},{n},{a}", line),
    ("X", "DN"): ("{d},{a}", line_at),
    ("X", "YN"): ("±{y},{a}", line_at),
    ("X", "DXN"): ("{d},±{x},{a}", line_from_line),
    ("X", "YXN"): ("±{y},±{x},{a}", line_from_line),
    ("X", "XN"): ("±{x},{n}", parallel),
    ("X", "XX"): ("±{x},±{x}", bisector),
    ("Y", "NNN"): ("{n},{n},{r}", circle),
    ("Y", "DN"): ("{d},{r}", about),
    ("Y", "DD"): ("{d},{d}", about_touching),
    ("Y", "DX"): ("{d},±{x}", about_touching),
    ("Y", "DY"): ("{d},±{y}", about_touching),
}
TEMPLATES = {"D": "{d}", "X": "±{x}", "Y": "±{y}"}
CHECKS |= {("X", e + f): (f"{TEMPLATES[e]},{TEMPLATES[f]}", belt) for e in "DY" for f in "DY"}
CHECKS |= {("Y", e + f + "N"): (f"{TEMPLATES[e]},{TEMPLATES[f]},{{r}}", two) for e in "DXY" for f in "DXY"}
CHECKS |= {
    ("Y", e + f + g): (f"{TEMPLATES[e]},{TEMPLATES[f]},{TEMPLATES[g]}", three)
    for e in "DXY"
    for f in "DXY"
    for g in "DXY"
}


def start(rng: random.Random) -> str:
    """Four elements of each kind, of small numbers."""
    points = [f"⊕D({number(rng, -9, 9)},{number(rng, -9, 9)})⇒D{i};" for i in range(4)]
    lines = [
        f"⊕X({number(rng, -9, 9)},{number(rng, -9, 9)},{rng.choice([0, 90, 45, 180, 37.5, 261])})⇒X{i};"
        for i in range(4)
    ]
    circles = [f"⊕Y({number(rng, -9, 9)},{number(rng, -9, 9)},{number(rng, 1, 8)})⇒Y{i};" for i in range(4)]
    return "\n".join(points + lines + circles) + "\n"


def filled(rng: random.Random, template: str) -> tuple[str, list[str]]:
    """A template's text, and what stands in it."""
    numbers = {
        "n": lambda: number(rng, -9, 9),
        "a": lambda: str(rng.choice([0, 30, -90, 71.3, 180, 200])),
        "r": lambda: number(rng, 1, 9),
    }
    taken: dict[str, list[int]] = {c: rng.sample(range(4), 4) for c in "dxy"}
    words = []
    for word in template.split(","):
        sign = rng.choice(["", "-"]) if word.startswith("±") else ""
        kind = word.strip("±{}")
        words.append(sign + (numbers[kind]() if kind in numbers else f"{kind.upper()}{taken[kind].pop()}"))
    return ",".join(words), words


def value(elements: Elements, word: str) -> object:
    if word[-1:].isdigit() and word.lstrip("-")[0].isdigit():
        return mp.mpf(word)
    element = elements["PSC"["DXY".index(word.lstrip("-")[0])] + word.lstrip("-")[1:]]
    return negative(element) if word[0] == "-" else element


def test_every_form_is_checked() -> None:
    assert set(CHECKS) == set(FORMS)


@pytest.mark.parametrize("form", CHECKS, ids="".join)
def test_form(form: tuple[str, str]) -> None:
    letter, kinds = form
    template, check = CHECKS[form]
    rng = random.Random(f"{letter}{kinds}")
    good = 0
    for _ in range(TRIES):
        begin = start(rng)
        text, words = filled(rng, template)
        text = f"{begin}⊕{letter}({text})⇒{letter}50;"
        if fault(text):
            continue
        elements = made(text)
        check(elements, elements["PSC"["DXY".index(letter)] + "50"], [value(elements, word) for word in words])
        good += 1
        if good == GOOD:
            return
    assert good >= 5, f"only {good} could be made"


@pytest.mark.parametrize("seed", range(20))
def test_moves(seed: int) -> None:
    """PY, ZD and FS of each kind; turned and moved back, it is the first again."""
    rng = random.Random(seed)
    u, v, a = number(rng, -9, 9), number(rng, -9, 9), rng.choice(["30", "90", "71.3"])
    text = start(rng)
    for k in "DXY":
        text += (
            f"⊕PY({k}1,{u},{v})⇒{k}5; ⊕ZD({k}1,-D2,{a})⇒{k}6; ⊕ZD({k}1,D2,{a})⇒{k}7; ⊕FS({k}1,-X2)⇒{k}8;"
            f"⊕ZD({k}6,D2,{a})⇒{k}9;"
        )
    e = made(text)
    for p, moved_by in ((Point(mp.mpf(u), mp.mpf(v)), 5),):
        same(e[f"P{moved_by}"] - e["P1"], p)
        same(e[f"C{moved_by}"].centre - e["C1"].centre, p)
        on(p + e["S1"].normal * e["S1"].g, e[f"S{moved_by}"])
        same(e[f"S{moved_by}"].direction, e["S1"].direction)
    for number_, sense in ((6, 1), (7, -1)):
        for one, other in ((e["P1"], e[f"P{number_}"]), (e["C1"].centre, e[f"C{number_}"].centre)):
            was, now = one - e["P2"], other - e["P2"]
            near(was.length(), now.length())
            if was.length() > 1:
                same_angle(float(mp.degrees(mp.atan2(was.cross(now), was.dot(now)))), sense * float(a))
        same_angle(angle(e[f"S{number_}"]) - angle(e["S1"]), sense * float(a))
        near(e[f"S{number_}"].distance(e["P2"]), e["S1"].distance(e["P2"]))
    same(e["P9"], e["P1"])
    same(e["P8"], mirrored(e["P1"], e["S2"]))
    same(e["C8"].centre, mirrored(e["C1"].centre, e["S2"]))
    assert float(e["C8"].r) == float(e["C1"].r)
    foot = e["S1"].normal * e["S1"].g
    for p in (foot, foot + e["S1"].direction * 3):
        on(mirrored(p, e["S2"]), e["S8"])
    image = mirrored(foot + e["S1"].direction, e["S2"]) - mirrored(foot, e["S2"])
    same(image, e["S8"].direction)


@pytest.mark.parametrize("frame", ["ZB(D1,30)", "ZB(3,-4,30)", "ZB(D1,0)", "ZB(0,0,90)", "ZB(D1,A)"])
def test_frame(frame: str) -> None:
    """Numbers in a frame make the same elements as outside, moved with the frame; earlier elements stay."""
    inner = "⊕D(2,1)⇒D2;⊕X(2,1,15)⇒X2;⊕Y(2,1,3)⇒Y2;⊕X(D2,15)⇒X3;⊕X(Y2,15)⇒X4;⊕D(Y2,15)⇒D4;⊕PY(D2,1,2)⇒D5;"
    where = "D1" if "D1" in frame else "D9"
    turned_by = frame.split(",")[-1].rstrip(")")
    before = "30⇒A;⊕D(5,7)⇒D1;⊕D(3,-4)⇒D9;" if "(0,0" not in frame else "30⇒A;⊕D(0,0)⇒D9;"
    e = made(f"{before}⊕{frame};5⇒A;⊕D(0,0)⇒D1;{inner}")
    origin = "5,7" if where == "D1" else "3,-4" if "3,-4" in before else "0,0"
    plain = made(inner.replace("⇒D5", f"⇒D5;⊕D({origin})⇒D1"))
    by = mp.mpf(turned_by if turned_by != "A" else 30)
    at = plain["P1"]

    def moved(p: Point) -> Point:
        return at + Point(p.x * cos(by) - p.y * sin(by), p.x * sin(by) + p.y * cos(by))

    for name in ("P2", "P4", "P5"):
        same(e[name], moved(plain[name]))
    same(e["C2"].centre, moved(plain["C2"].centre))
    for name in ("S2", "S3", "S4"):
        same_angle(angle(e[name]), angle(plain[name]) + float(by))
        foot = plain[name].normal * plain[name].g
        on(moved(foot), e[name])


def test_numbers() -> None:
    e = made("2×(3+4)/7-1⇒A; -A+2⇒B1; 1-(2-3)⇒C; 12/(2×3)⇒E; ⊕D(A×B1,-A-C-E)⇒D1; A×2⇒A; ⊕D(A,A/4)⇒D2;")
    same(e["P1"], Point(mp.mpf(1), mp.mpf(-5)))
    same(e["P2"], Point(mp.mpf(2), mp.mpf("0.5")))
