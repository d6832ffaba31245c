"""TEKHTRAN's КОНТУР: its corners, the senses of its lines, its entry, and the items of the CUT (docs/spec/tekhtran.md,
section 6).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from lark import Token

from skg.rivals.formula import SkgText, minus
from skg.rivals.plane import (
    ExactCircle,
    ExactCurve,
    ExactElement,
    ExactLine,
    ExactPoint,
    PlaneError,
    Real,
    crossings,
    nearest,
    on,
    parallel,
    same_point,
)
from skg.rivals.route import Leg
from skg.rivals.start import inner_corner, wire_corner
from skg.rivals.statement import TextFault
from skg.rivals.tekhtran_making import chosen, crossing_text


@dataclass(frozen=True)
class ContourItem:
    """A point, a line or a circle with its sense; which of two corners with the item before.

    `name` is SKG's for the element as it was defined, which may be run backwards.
    """

    value: ExactElement
    name: str
    token: Token
    choice: Token | None = None
    is_backwards: bool = False

    @property
    def is_point(self) -> bool:
        """No curve."""
        return isinstance(self.value, ExactPoint)

    @property
    def point(self) -> ExactPoint:
        """The point that it is."""
        assert isinstance(self.value, ExactPoint)
        return self.value

    @property
    def curve(self) -> ExactCurve:
        """The line or circle that it is."""
        assert not isinstance(self.value, ExactPoint)
        return self.value

    @property
    def text(self) -> SkgText:
        """As it stands in CUT."""
        return minus(SkgText(self.name)) if self.is_backwards else SkgText(self.name)

    def backwards(self) -> ContourItem:
        """A curve, run the other way."""
        return replace(self, value=-self.value, is_backwards=True)


#: Gives a corner a name: SKG's expression for it, and where it is.
CornerNamer = Callable[[SkgText, ExactPoint], SkgText]


@dataclass(frozen=True)
class _Corner:
    """Meeting point of two neighbours; a text if neither is a point."""

    place: ExactPoint
    text: SkgText | None = None


def cut_items(items: list[ContourItem], token: Token, wire: ExactPoint, offset: Real, name: CornerNamer) -> list[str]:
    """The items of the CUT that BACK makes a contour, from where the wire is; `token`: the statement's word."""
    items = _without_doubles(items)
    if len(items) == 1 and not isinstance(items[0].value, ExactCircle):
        raise TextFault(token.start_pos, "rival-one-item")
    if len(items) == 1:
        return [str(items[0].text)]
    corners = [_corner(items[index - 1], item) for index, item in enumerate(items[1:], 1)]
    corners.insert(0, _corner(items[-1], items[0]))
    if not _is_whole_circle(items):
        ends = [*corners[1:], corners[0]]
        items = [_run(*between) for between in zip(items, corners, ends, strict=True)]
        stretches = _stretches(items, corners, ends)
        if not any(stretch.is_travelled for stretch in stretches):
            raise TextFault(token.start_pos, "rival-no-travel")
        _check_entry(items[0], stretches, wire, offset)
    return _texts(items, corners, name)


def _without_doubles(items: list[ContourItem]) -> list[ContourItem]:
    """The items of a closed contour, points that follow themselves once."""
    single: list[ContourItem] = []
    for item in items:
        if not (single and _is_double(single[-1], item)):
            single.append(item)
    while len(single) > 1 and _is_double(single[-1], single[0]):
        single.pop()
    return single


def _is_double(a: ContourItem, b: ContourItem) -> bool:
    return a.is_point and b.is_point and same_point(a.point, b.point)


def _is_whole_circle(items: list[ContourItem]) -> bool:
    """A circle and one point of it."""
    circles = [item for item in items if isinstance(item.value, ExactCircle)]
    return len(items) == 2 and len(circles) == 1 and any(item.is_point for item in items)


def _corner(before: ContourItem, item: ContourItem) -> _Corner:
    """The place where an item begins; of two points: the second."""
    for named, other in ((item, before), (before, item)):
        if named.is_point:
            if not other.is_point and not on(other.curve, named.point):
                raise TextFault(named.token.start_pos, "rival-not-on", point=str(named.token), curve=str(other.token))
            return _Corner(named.point)
    try:
        points = crossings(before.curve, item.curve)
        if len(points) > 1 and item.choice is None:
            raise PlaneError("rival-two")
        place = points[0] if item.choice is None else chosen(points, item.choice)
    except PlaneError as error:
        raise TextFault(
            item.token.start_pos, "rival-corner", before=str(before.token), item=str(item.token), why=error.why
        ) from None
    e, f = (-each.curve if each.is_backwards else each.curve for each in (before, item))
    return _Corner(place, crossing_text(e, f, place, (SkgText(before.name), SkgText(item.name))))


def _run(item: ContourItem, start: _Corner, end: _Corner) -> ContourItem:
    """A line as it runs from one corner to the other; all else as it is."""
    if not isinstance(item.value, ExactLine):
        return item
    if same_point(start.place, end.place):
        raise TextFault(item.token.start_pos, "rival-no-length", item=str(item.token))
    return item if item.value.way.dot(end.place - start.place) > 0 else item.backwards()


def _stretches(items: list[ContourItem], starts: list[_Corner], ends: list[_Corner]) -> list[Leg]:
    """The pieces that are travelled: curves, and the lines between points."""
    pieces = []
    following = [*items[1:], items[0]]
    for item, start, end, after in zip(items, starts, ends, following, strict=True):
        if not item.is_point:
            pieces.append(Leg(item.curve, start.place, end.place))
        elif after.is_point:
            direction = (after.point - item.point).unit()
            pieces.append(Leg(ExactLine(item.point, direction), item.point, after.point))
    return pieces


def _check_entry(item: ContourItem, stretches: list[Leg], wire: ExactPoint, offset: Real) -> None:
    """True if BACK will find the place where the wire entered the first item."""
    last, first, second = stretches[-1], stretches[0], stretches[1]
    if item.is_point:
        if inner_corner(last.curve, first.curve, item.point, offset):
            raise TextFault(item.token.start_pos, "rival-inner-corner")
        return
    if not (first.is_travelled and first.has(nearest(wire, first.curve))):
        raise TextFault(item.token.start_pos, "rival-enters-past", item=str(item.token))
    path = parallel(first.curve, offset)
    start = wire_corner(last.curve, first.curve, first.start, offset)
    end = wire_corner(first.curve, second.curve, first.end, offset)
    # (without a corner SKG itself reports an error)
    if start and end and not Leg(path, start, end).has(nearest(wire, path)):
        raise TextFault(item.token.start_pos, "rival-enters-outside", item=str(item.token))


def _texts(items: list[ContourItem], corners: list[_Corner], name: CornerNamer) -> list[str]:
    names = [str(name(corner.text, corner.place)) if corner.text else "" for corner in corners]
    texts: list[str] = []
    for item, corner in zip(items, names, strict=True):
        texts += [corner, str(item.text)] if corner else [str(item.text)]
    if items[0].is_point:
        return [*texts, texts[0]]
    return [*texts[1:], texts[0]] if names[0] else texts
