"""Short ways to ask a translator, and what its SKG program makes by the reference."""

from __future__ import annotations

import random
import re
from collections.abc import Callable
from math import hypot
from pathlib import Path

from compare import compare

from skg.ref import Result, real, run
from skg.ref.interpreter import Interpreter
from skg.ref.near import watching
from skg.ref.tape import Punch
from skg.ref.values import Circle, Line, Point, Value
from skg.rivals import xy
from skg.rivals.languages import RivalFault

ROOT = Path(__file__).parents[2]
Translate = Callable[[str], str]
XY = tuple[float, float]
#: mm: the program's own numbers have 14 decimals.
EXACT = 1e-10


def made(text: str, translate: Translate = xy.translate) -> dict[str, Value]:
    """The elements that a translated program makes, by SKG's names."""
    program = translate(text)
    with watching() as watch, real.mp.workprec(real.mp.prec):
        machine = Interpreter([], watch, Punch())
        assert machine.load(program) is None, (text, program, machine.paper)
        assert machine.run() is None, (text, program, machine.paper)
    return {f"{letter}{number}": value for (letter, number), value in machine.variables.items()}


def cut(text: str, translate: Translate = xy.translate) -> Result:
    """The result of a translated program, which must not fail."""
    program = translate(text)
    result = run(program)
    assert result.error is None, (text, program, result.paper)
    return result


def fault(text: str, translate: Translate = xy.translate) -> str:
    """The error in a text; empty: none."""
    try:
        translate(text)
    except RivalFault as wrong:
        return str(wrong)
    return ""


def gap(e: Point | Circle | Line, new: Circle | Line) -> float:
    """The distance (mm) of a circle or line from touching an element in its direction (a point: from passing it)."""
    if isinstance(e, Point):
        e = Circle(e.x, e.y, real.ZERO)
    if isinstance(new, Line):
        assert isinstance(e, Circle)
        # The centre lies left of the line by the signed radius.
        return abs(float(new.distance(e.centre) + e.r))
    if isinstance(e, Line):
        return abs(float(e.distance(new.centre) + new.r))
    return abs(float((e.centre - new.centre).length() - abs(e.r - new.r)))


def apart(p: XY, q: XY) -> float:
    """The distance of two places."""
    return hypot(p[0] - q[0], p[1] - q[1])


def number(rng: random.Random, low: int, high: int) -> str:
    """A small whole number, now and then with decimals."""
    value = rng.randint(low, high)
    return str(value) if rng.random() < 0.6 else f"{value + rng.randint(1, 99) / 100:.2f}"


def is_circle_of_one_point(program: str, result: Result) -> bool:
    """Tell whether SKG refuses a circle that one point begins and ends: in a CUT, or with BACK at the route's start."""
    if result.error is None or result.error[0] != 6:
        return False
    places = dict(re.findall(r"^\d+ (P\d+)=(.*)$", program, re.M))
    between = re.findall(r"(P\d+),-?C\d+(?=,(P\d+))", program)
    back = f"{result.error[1]} BACK" in program.splitlines()
    return back or any(places[one] == places[other] for one, other in between)


def cut_small_numbers(
    make: Callable[[], str], is_beside: Callable[[str], bool], count: int, translate: Translate
) -> int:
    """Texts of small whole numbers until `count` have not been refused; how many of these were cut.

    A text is refused with a place, or cut as it is: by the ROM as by the reference. With the wire beside the contour
    (`is_beside`) both may refuse it.
    """
    good = ran = 0
    while good < count:
        text = make()
        message = fault(text, translate)
        if message:
            line, column = map(int, message.split(":")[:2])
            assert 0 < column <= len((text + "\n").split("\n")[line - 1]) + 1, (text, message)
            continue
        good += 1
        program = translate(text)
        result = run(program)
        allowed = (6, 7) if is_beside(text) or is_circle_of_one_point(program, result) else ()
        assert result.error is None or result.error[0] in allowed, (text, program, result.paper)
        verdict = compare(program)
        assert not verdict.difference, (text, program, verdict)
        ran += result.error is None and not verdict.aside
    return ran
