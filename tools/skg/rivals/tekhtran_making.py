"""TEKHTRAN's definitions: what each form makes, and the SKG expression that makes the same (docs/spec/tekhtran.md,
sections 3 to 5). Lines run as SKG's of the same expression do; circles run counter-clockwise.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from lark import Token

from skg.rivals.formula import SkgText, call, centre_text, decimal, join, minus, pair, sloping
from skg.rivals.plane import (
    NEAR,
    TINY,
    ZERO,
    ExactCircle,
    ExactCurve,
    ExactElement,
    ExactLine,
    ExactPoint,
    PlaneError,
    Real,
    belt_line,
    crossings,
    direction,
    joining_line,
    mp,
    on,
    rotated,
    same_point,
    touching_point,
    way_at,
)
from skg.rivals.statement import TextFault

ORIGIN = ExactPoint(ZERO, ZERO)
Matrix = tuple[Real, ...]
T = TypeVar("T")


Value = TypeVar("Value", covariant=True)


@dataclass(frozen=True)
class Operand(Generic[Value]):
    """An operand of a definition: a number, or the meaning of a name; its SKG text, its z, its place."""

    value: Value
    text: SkgText
    token: Token
    z: Real = ZERO


#: Operands of each kind.
_Number = Operand[Real]
_Point = Operand[ExactPoint]
_Line = Operand[ExactLine]
_Circle = Operand[ExactCircle]
_Curve = Operand[ExactCurve]
_Matrix = Operand[Matrix]


@dataclass(frozen=True)
class Defined:
    """The result of a definition; no text: computed numbers; no z: that of ПЛЗ."""

    value: ExactElement | Real | Matrix
    text: SkgText | None = None
    z: Real | None = None


#: The length of a plane's normal, as its cosines are written, may differ from 1 by so much.
UNIT = Real("1e-3")
#: A form's name in the grammar -> what makes it. It gets the operands and words in order, without commas.
FORMS: dict[str, Callable[..., Defined]] = {}


def _form(function: Callable[..., Defined]) -> Callable[..., Defined]:
    FORMS[function.__name__] = function
    return function


def chosen(points: Sequence[ExactPoint], choice: str) -> ExactPoint:
    """Of one or two points the one with the greater (Б) or smaller (М) coordinate."""
    return chosen_by(points, choice, lambda point: point)


def chosen_by(choices: Sequence[T], choice: str, place: Callable[[T], ExactPoint]) -> T:
    """Of one or two things the one whose place has the greater (Б) or smaller (М) coordinate."""
    if len(choices) == 1:
        return choices[0]
    first, second = ((place(e).x if choice[0] == "Х" else place(e).y) for e in choices)
    if abs(first - second) <= NEAR:
        raise PlaneError("rival-undecided", choice=choice)
    return choices[(first < second) == (choice[1] == "Б")]


def crossing_text(e: ExactCurve, f: ExactCurve, place: ExactPoint, texts: tuple[SkgText, SkgText]) -> SkgText:
    """SKG's expression for one of the places where two curves cross or touch."""
    turns_right = len(crossings(e, f)) > 1 and way_at(e, place).cross(way_at(f, place)) < 0
    return join(texts[0], "*", minus(texts[1]) if turns_right else texts[1])


def normal(line: ExactLine) -> tuple[tuple[Real, Real, Real], bool]:
    """cos α, sin α and p of a line's canonical form; whether SKG's numbers of the line have this sign."""
    values = (line.way.y, -line.way.x, line.way.y * line.point.x - line.way.x * line.point.y)
    runs_so = next(value for value in reversed(values) if abs(value) > TINY) > 0
    return (values if runs_so else (-values[0], -values[1], -values[2])), runs_so


def _distance(d: _Number) -> Real:
    if d.value < 0:
        raise PlaneError("rival-negative-distance")
    return d.value


def _on(curve: _Curve, point: _Point) -> None:
    if not on(curve.value, point.value):
        raise TextFault(point.token.start_pos, "rival-not-on", point=str(point.token), curve=str(curve.token))


def _clockwise(turn: Token, value: Real, text: SkgText) -> tuple[Real, SkgText]:
    """An angle, counter-clockwise positive."""
    return (-value, minus(text)) if turn == "ПОЧС" else (value, text)


# Points ------------------------------------------------------------------------------------------------------------


@_form
def point_at(x: _Number, y: _Number, z: _Number | None = None) -> Defined:
    return Defined(ExactPoint(x.value, y.value), pair(x.text, y.text), z.value if z else None)


@_form
def point_of_lines(first: _Line, second: _Line) -> Defined:
    return Defined(crossings(first.value, second.value)[0], join(first.text, "*", second.text))


@_form
def point_of_curves(e: _Curve, f: _Curve, choice: Token) -> Defined:
    place = chosen(crossings(e.value, f.value), choice)
    return Defined(place, crossing_text(e.value, f.value, place, (e.text, f.text)))


@_form
def point_at_angle(circle: _Circle, turn: Token, angle: _Number) -> Defined:
    value, text = _clockwise(turn, angle.value, angle.text)
    place = circle.value.centre + direction(value) * circle.value.r
    return Defined(place, join(centre_text(circle.text), "+", join(call("K3", circle.text), "#", text)))


@_form
def point_centre(circle: _Circle) -> Defined:
    return Defined(circle.value.centre, centre_text(circle.text))


@_form
def point_along_circle(circle: _Circle, point: _Point, turn: Token, d: _Number) -> Defined:
    _on(circle, point)
    angle, _ = _clockwise(turn, 180 * _distance(d) / (mp.pi * circle.value.r), d.text)
    about = join(decimal(angle), ":", centre_text(circle.text))
    return Defined(rotated(point.value, angle, circle.value.centre), join(point.text, "#", about))


@_form
def point_with_coordinate(line: _Line, axis: Token, n: _Number) -> Defined:
    if axis == "ХКООРД":
        square, text = ExactLine(ExactPoint(n.value, ZERO), direction(Real(90))), join(SkgText("Y"), ":", n.text)
    else:
        square, text = ExactLine(ExactPoint(ZERO, n.value), direction(ZERO)), join(SkgText("X"), ":", minus(n.text))
    return Defined(crossings(line.value, square)[0], join(line.text, "*", text))


@_form
def point_along_line(line: _Line, point: _Point, d: _Number, choice: Token) -> Defined:
    _on(line, point)
    if _distance(d) <= TINY:
        return Defined(point.value, point.text)
    circle, text = ExactCircle(point.value, d.value), join(point.text, ":", d.text)
    place = chosen(crossings(line.value, circle), choice)
    return Defined(place, crossing_text(line.value, circle, place, (line.text, text)))


@_form
def point_moved(point: _Point, _: Token, dx: _Number, dy: _Number) -> Defined:
    return Defined(point.value + ExactPoint(dx.value, dy.value), join(point.text, "+", pair(dx.text, dy.text)))


@_form
def point_away(point: _Point, turn: Token, angle: _Number, d: _Number) -> Defined:
    value, text = _clockwise(turn, angle.value, angle.text)
    return Defined(point.value + direction(value) * _distance(d), join(point.text, "+", join(d.text, "#", text)))


@_form
def point_transformed(point: _Point, matrix: _Matrix) -> Defined:
    rows = (matrix.value[0:4], matrix.value[4:8], matrix.value[8:12])
    x, y, z = (a * point.value.x + b * point.value.y + c * point.z + d for a, b, c, d in rows)
    return Defined(ExactPoint(x, y), None, z)


@_form
def point_same(point: _Point) -> Defined:
    return Defined(point.value, point.text)


@_form
def point_of_vector(vector: _Point) -> Defined:
    return Defined(vector.value, vector.text, vector.z)


# Lines -------------------------------------------------------------------------------------------------------------


@_form
def line_of_numbers(x1: _Number, y1: _Number, x2: _Number, y2: _Number) -> Defined:
    first, second = ExactPoint(x1.value, y1.value), ExactPoint(x2.value, y2.value)
    return _line_through(first, second, (pair(x1.text, y1.text), pair(x2.text, y2.text)))


def _line_through(first: ExactPoint, second: ExactPoint, texts: tuple[SkgText, SkgText]) -> Defined:
    if same_point(first, second):
        raise PlaneError("rival-no-line")
    return Defined(joining_line(first, second), join(texts[0], ":", texts[1]))


@_form
def line_through(first: _Point, second: _Point) -> Defined:
    return _line_through(first.value, second.value, (first.text, second.text))


def _sided(side: Token, circle: _Circle) -> tuple[ExactCircle, SkgText]:
    """A circle that runs so that a line along it touches it on a side."""
    return (circle.value, circle.text) if side == "СПРАВА" else (-circle.value, minus(circle.text))


@_form
def line_touching(point: _Point, side: Token, circle: _Circle) -> Defined:
    value, text = _sided(side, circle)
    return Defined(joining_line(point.value, value), join(point.text, ":", text))


@_form
def line_touching_first(side: Token, circle: _Circle, point: _Point) -> Defined:
    value, text = _sided(side, circle)
    return Defined(joining_line(value, point.value), join(text, ":", point.text))


@_form
def line_touching_chosen(point: _Point, circle: _Circle, choice: Token) -> Defined:
    directed = [(circle.value, circle.text), (-circle.value, minus(circle.text))]
    if belt_line(point.value, circle.value) is None:
        directed = directed[:1]
    lines = [(joining_line(point.value, value), value, text) for value, text in directed]
    line, _, text = chosen_by(lines, choice, lambda entry: touching_point(entry[1], entry[0]))
    return Defined(line, join(point.text, ":", text))


@_form
def line_touching_both(side: Token, circle: _Circle, other_side: Token, other: _Circle) -> Defined:
    (e, e_text), (f, f_text) = _sided(side, circle), _sided(other_side, other)
    return Defined(joining_line(e, f), join(e_text, ":", f_text))


@_form
def line_at_angle(point: _Point, angle: _Number) -> Defined:
    return Defined(ExactLine(point.value, direction(angle.value)), join(sloping(angle.text), ":", point.text))


@_form
def line_turned(line: _Line, point: _Point, angle: _Number) -> Defined:
    return _line_at(point, line, angle.value, angle.text)


@_form
def line_square(point: _Point, _: Token, line: _Line) -> Defined:
    return _line_at(point, line, Real(90), SkgText("90"))


def _line_at(point: _Point, line: _Line, angle: Real, text: SkgText) -> Defined:
    direction = rotated(line.value.way, angle, ORIGIN)
    return Defined(ExactLine(point.value, direction), join(join(line.text, "#", text), ":", point.text))


@_form
def line_parallel(point: _Point, _: Token, line: _Line) -> Defined:
    return Defined(ExactLine(point.value, line.value.way), join(line.text, ":", point.text))


# Circles -----------------------------------------------------------------------------------------------------------


def _circle(centre: ExactPoint, r: Real, text: SkgText) -> Defined:
    if r <= TINY:
        raise PlaneError("rival-radius")
    return Defined(ExactCircle(centre, r), text)


@_form
def circle_of_numbers(x: _Number, y: _Number, r: _Number) -> Defined:
    return _circle(ExactPoint(x.value, y.value), r.value, join(pair(x.text, y.text), ":", r.text))


@_form
def circle_about(centre: _Point, r: _Number) -> Defined:
    return _circle(centre.value, r.value, join(centre.text, ":", r.text))


@_form
def circle_through(first: _Point, second: _Point, third: _Point) -> Defined:
    before, after = (
        ExactLine((p.value + q.value) * Real("0.5"), (q.value - p.value).unit().left())
        for p, q in ((first, second), (second, third))
    )
    centre = crossings(before, after)[0]
    halves = join(join(first.text, "#", second.text), "*", join(second.text, "#", third.text))
    return _circle(centre, (second.value - centre).size(), join(halves, "/", second.text))


# Vectors, matrices, planes, numbers --------------------------------------------------------------------------------


@_form
def vector_of_numbers(dx: _Number, dy: _Number, dz: _Number | None = None) -> Defined:
    return Defined(ExactPoint(dx.value, dy.value), pair(dx.text, dy.text), dz.value if dz else ZERO)


@_form
def vector_times(n: _Number, vector: _Point) -> Defined:
    return Defined(vector.value * n.value, join(vector.text, "*", n.text), vector.z * n.value)


@_form
def vector_to_point(point: _Point) -> Defined:
    return Defined(point.value, point.text, point.z)


@_form
def vector_between(x1: _Number, y1: _Number, x2: _Number, y2: _Number) -> Defined:
    value = ExactPoint(x2.value - x1.value, y2.value - y1.value)
    return Defined(value, pair(join(x2.text, "-", x1.text), join(y2.text, "-", y1.text)), ZERO)


@_form
def vector_of_line(line: _Line, choice: Token) -> Defined:
    return Defined(chosen((line.value.way, -line.value.way), choice), None, ZERO)


@_form
def matrix_of_numbers(*numbers: _Number) -> Defined:
    return Defined(tuple(number.value for number in numbers))


@_form
def plane_at(n: _Number) -> Defined:
    return Defined((ZERO, ZERO, Real(1), n.value))


@_form
def plane_of_numbers(*numbers: _Number) -> Defined:
    values = tuple(number.value for number in numbers)
    length = mp.sqrt(sum(value**2 for value in values[:3]))
    if abs(length - 1) > UNIT:
        raise PlaneError("rival-plane")
    return Defined(tuple(value / length for value in values))


@_form
def number_of(n: _Number) -> Defined:
    return Defined(n.value, n.text)
