"""XY's ⊕: which form it is, what it makes, and the SKG expression that makes the same (docs/spec/xy.md, section 3).

Circles are negative, as SKG has those that run clockwise.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from typing import Generic, TypeVar

from lark import Token

from skg.rivals.formula import SkgText, call, centre_text, decimal, join, literal, minus, pair, sloping
from skg.rivals.plane import (
    TINY,
    ZERO,
    ExactCircle,
    ExactCurve,
    ExactElement,
    ExactLine,
    ExactPoint,
    PlaneError,
    Real,
    crossings,
    direction,
    entering,
    joining_line,
    mp,
    rotated,
    touching_line,
    touching_three,
    touching_two,
    turn,
)

#: XY's letters of elements, and SKG's for the same.
LETTERS = {"D": "P", "X": "S", "Y": "C"}


Value = TypeVar("Value", covariant=True)
Other = TypeVar("Other")


@dataclass(frozen=True)
class Argument(Generic[Value]):
    """An argument: its kind (N, D, X, Y), value and text with its sign, the sign if one is written, its place."""

    kind: str
    value: Value
    text: SkgText
    token: Token
    sign: Token | None = None

    def of(self, what: type[Other]) -> Argument[Other]:
        """The same, where it is an element of one class."""
        assert isinstance(self.value, what)
        return Argument(self.kind, self.value, self.text, self.token, self.sign)


#: Arguments of each kind, and those of two.
_Number = Argument[Real]
_Point = Argument[ExactPoint]
_Line = Argument[ExactLine]
_Circle = Argument[ExactCircle]
_Round = Argument[ExactPoint | ExactCircle]
_Curve = Argument[ExactCurve]
_Element = Argument[ExactElement]


@dataclass(frozen=True)
class NewElement(Generic[Value]):
    """An element, and SKG's expression for it."""

    value: Value
    text: SkgText


@dataclass(frozen=True)
class XYFrame:
    """The axes in which numbers are read (ZB): the place of the origin and the angle of x; None: the drawing's own."""

    origin: ExactPoint = ExactPoint(ZERO, ZERO)
    angle: Real = ZERO
    origin_text: SkgText | None = None
    angle_text: SkgText | None = None

    def vector(self, x: _Number, y: _Number) -> NewElement[ExactPoint]:
        """A vector of the frame."""
        text = pair(x.text, y.text)
        if self.angle_text:
            text = join(text, "#", self.angle_text)
        return NewElement(rotated(ExactPoint(x.value, y.value), self.angle, ExactPoint(ZERO, ZERO)), text)

    def point(self, x: _Number, y: _Number) -> NewElement[ExactPoint]:
        """A point of the frame."""
        made = self.vector(x, y)
        text = join(made.text, "+", self.origin_text) if self.origin_text else made.text
        return NewElement(made.value + self.origin, text)

    def turned(self, angle: _Number) -> tuple[Real, SkgText]:
        """A direction angle of the frame, as one of the drawing."""
        if self.angle_text is None:
            return angle.value, angle.text
        return angle.value + self.angle, join(angle.text, "+", self.angle_text)


Form = Callable[..., NewElement]
#: Letter and kinds of the arguments -> where signs may stand, and what makes it (frame first).
FORMS: dict[tuple[str, str], tuple[tuple[bool, ...], Form]] = {}


def _form(letter: str, *patterns: str) -> Callable[[Form], Form]:
    """Enter a form for each of its patterns: kinds in a row, with ± before those that may have a sign."""

    def enter(function: Form) -> Form:
        for pattern in patterns:
            allowed = tuple(pattern[index - 1 : index] == "±" for index, char in enumerate(pattern) if char != "±")
            FORMS[letter, pattern.replace("±", "")] = allowed, function
        return function

    return enter


def _all(kinds: tuple[str, ...], count: int, end: str = "") -> list[str]:
    return ["".join(row) + end for row in product(kinds, repeat=count)]


def _circle(centre: ExactPoint, r: Real) -> ExactCircle:
    if r <= TINY:
        raise PlaneError("rival-radius")
    return ExactCircle(centre, -r)


@_form("D", "NN")
def _point(frame: XYFrame, x: _Number, y: _Number) -> NewElement:
    return frame.point(x, y)


@_form("D", "YN")
def _point_of_circle(frame: XYFrame, circle: _Circle, angle: _Number) -> NewElement:
    value, text = frame.turned(angle)
    place = join(centre_text(circle.text), "-", join(call("K3", circle.text), "#", text))
    return NewElement(circle.value.centre + direction(value) * abs(circle.value.r), place)


@_form("D", "±X±X")
def _crossing(_: XYFrame, first: _Line, second: _Line) -> NewElement:
    return NewElement(crossings(first.value, second.value)[0], join(_unsigned(first), "*", _unsigned(second)))


def _unsigned(argument: _Element) -> SkgText:
    return minus(argument.text) if argument.sign else argument.text


@_form("D", "±XY", "±YY")
def _entering(_: XYFrame, runs: _Curve, circle: _Circle) -> NewElement:
    return NewElement(entering(runs.value, circle.value), join(runs.text, "*", circle.text))


@_form("D", "Y±X")
def _entering_by_line(frame: XYFrame, circle: _Circle, line: _Line) -> NewElement:
    return _entering(frame, line, circle)


@_form("X", "NNN")
def _line(frame: XYFrame, x: _Number, y: _Number, angle: _Number) -> NewElement:
    made = frame.point(x, y)
    value, text = frame.turned(angle)
    return NewElement(ExactLine(made.value, direction(value)), join(sloping(text), ":", made.text))


@_form("X", "DN", "±YN")
def _line_at(frame: XYFrame, point: _Round, angle: _Number) -> NewElement:
    value, text = frame.turned(angle)
    return NewElement(touching_line(point.value, direction(value)), join(sloping(text), ":", point.text))


@_form("X", "D±XN", "±Y±XN")
def _line_from_line(_: XYFrame, point: _Round, line: _Line, angle: _Number) -> NewElement:
    direction = rotated(line.value.way, angle.value, ExactPoint(ZERO, ZERO))
    return NewElement(touching_line(point.value, direction), join(join(line.text, "#", angle.text), ":", point.text))


@_form("X", *_all(("D", "±Y"), 2))
def _belt(_: XYFrame, e: _Round, f: _Round) -> NewElement:
    return NewElement(joining_line(e.value, f.value), join(e.text, ":", f.text))


@_form("X", "±XN")
def _parallel(_: XYFrame, line: _Line, left: _Number) -> NewElement:
    value = ExactLine(line.value.point + line.value.way.left() * left.value, line.value.way)
    return NewElement(value, join(line.text, ":", minus(left.text)))


@_form("X", "±X±X")
def _bisector(_: XYFrame, first: _Line, second: _Line) -> NewElement:
    crossing = crossings(first.value, second.value)[0]
    half = mp.degrees(turn(first.value.way, second.value.way)) / 2
    angle = join(pair(first.text, second.text), "/", SkgText("2"))
    text = join(join(first.text, "#", angle), ":", join(first.text, "*", second.text))
    return NewElement(ExactLine(crossing, rotated(first.value.way, half, ExactPoint(ZERO, ZERO))), text)


@_form("Y", "NNN")
def _circle_of_numbers(frame: XYFrame, x: _Number, y: _Number, r: _Number) -> NewElement:
    made = frame.point(x, y)
    return NewElement(_circle(made.value, r.value), join(made.text, ":", minus(r.text)))


@_form("Y", "DN")
def _circle_about(_: XYFrame, centre: _Point, r: _Number) -> NewElement:
    return NewElement(_circle(centre.value, r.value), join(centre.text, ":", minus(r.text)))


@_form("Y", "DD")
def _circle_through(_: XYFrame, centre: _Point, on: _Point) -> NewElement:
    return NewElement(_circle(centre.value, (on.value - centre.value).size()), minus(join(centre.text, "/", on.text)))


@_form("Y", "D±X")
def _circle_at_line(_: XYFrame, centre: _Point, line: _Line) -> NewElement:
    radius = call("ABS", pair(centre.text, _unsigned(line)))
    value = _circle(centre.value, abs(line.value.beside(centre.value)))
    return NewElement(value, join(centre.text, ":", SkgText(f"-{radius}", 0o55)))


@_form("Y", "D±Y")
def _circle_at_circle(_: XYFrame, centre: _Point, other: _Circle) -> NewElement:
    apart = (centre.value - other.value.centre).size()
    size = abs(other.value.r)
    if not other.sign:
        r = size - apart if apart < size - TINY else size + apart
        return NewElement(_circle(centre.value, r), join(centre.text, ":", minus(decimal(r))))
    own = _unsigned(other)
    text = join(pair(centre.text, centre_text(own)), "+", call("K3", own))
    return NewElement(_circle(centre.value, apart - size), join(centre.text, ":", minus(text)))


@_form("Y", *_all(("D", "±X", "±Y"), 2, "N"))
def _circle_at_two(_: XYFrame, e: _Element, f: _Element, r: _Number) -> NewElement:
    _circle(ExactPoint(ZERO, ZERO), r.value)
    centre = join(join(e.text, ":", r.text), "*", SkgText(f"-({join(f.text, ':', r.text)})", 0o55))
    return NewElement(touching_two(e.value, f.value, r.value), join(centre, ":", minus(r.text)))


@_form("Y", *_all(("D", "±X", "±Y"), 3))
def _circle_at_three(_: XYFrame, e: _Element, f: _Element, g: _Element) -> NewElement:
    value = touching_three(e.value, f.value, g.value)
    if e.kind == f.kind == g.kind == "D":
        halves = join(join(e.text, "#", f.text), "*", join(f.text, "#", g.text))
        return NewElement(value, minus(join(halves, "/", f.text)))
    return NewElement(value, literal(value))


def shift(e: _Element, by: NewElement) -> SkgText:
    """PY: an element moved by a vector."""
    if e.kind == "D":
        return join(e.text, "+", by.text)
    if e.kind == "X":
        return join(e.text, ":", join(join(SkgText("O"), "#", e.text), "+", by.text))
    return join(join(centre_text(e.text), "+", by.text), ":", call("K3", e.text))


def spin(e: SkgText, about: SkgText, angle: SkgText) -> SkgText:
    """An element turned about a point, counter-clockwise."""
    return join(e, "#", join(angle, ":", about))


def image(e: ExactElement, text: SkgText, mirror: SkgText) -> SkgText:
    """FS: a mirror image; SKG's own turns a line round."""
    made = join(text, "/", mirror)
    return minus(made) if isinstance(e, ExactLine) else made
