"""The wire's entry into an XY route, and the route written from there (docs/spec/xy.md, sections 5 and 8)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from skg.rivals.formula import SkgText, join
from skg.rivals.plane import (
    NEAR,
    SAME_WAY,
    ExactCircle,
    ExactCurve,
    ExactElement,
    ExactLine,
    ExactPoint,
    PlaneError,
    Real,
    foot,
    mp,
    nearest,
    nearest_crossing,
    parallel,
    turn,
    way_at,
)
from skg.rivals.route import Leg, Part, Pin, stretches

#: Gives a name of the translator's own to an element: its SKG text (None: computed numbers), and its value.
Namer = Callable[[SkgText | None, ExactElement], SkgText]
#: An item of a CUT longer than this gets a name of its own.
LONGEST_ITEM = 44


@dataclass(frozen=True)
class Entry:
    """The first stretch that is cut, from the start point on; `inner`: the crossing on the wire's path where it enters,
    None where it enters at the start point's own place."""

    first: Leg
    inner: ExactPoint | None


def entry(parts: list[Part], near: ExactPoint, offset: Real) -> Entry:
    """The start, nearest to a point, and the entry for SKG's offset R."""
    path = stretches(parts)
    if path[0].whole:
        pin = next((part.point for part in parts if isinstance(part, Pin)), None)
        start = nearest(near, path[0].curve) if pin is None else pin
        path[0].start = path[0].end = start
        return Entry(path[0], None)
    least = min((stretch.start - near).size() for stretch in path)
    index = next(i for i, stretch in enumerate(path) if (stretch.start - near).size() <= least + NEAR)
    first = path[index]
    return Entry(first, inner_corner(path[index - 1].curve, first.curve, first.start, offset))


def wire_corner(e: ExactCurve, f: ExactCurve, p: ExactPoint, offset: Real) -> ExactPoint | None:
    """The place at which the wire's path goes over from e to f, whose corner is p (language.md, section 4.4).

    None where SKG refuses the corner.
    """
    angle = abs(turn(way_at(e, p), way_at(f, p)))
    if offset == 0 or angle <= SAME_WAY:
        return p - way_at(e, p).left() * offset
    if mp.pi - angle <= SAME_WAY:
        return None
    if any(isinstance(curve, ExactCircle) and parallel(curve, offset).r * curve.r <= 0 for curve in (e, f)):
        return None
    try:
        return nearest_crossing(parallel(e, offset), parallel(f, offset), p)
    except PlaneError:
        return None


def inner_corner(last: ExactCurve, first: ExactCurve, p: ExactPoint, offset: Real) -> ExactPoint | None:
    """The corner of the wire's path where that lies along `first` behind the own place of the start p."""
    corner = wire_corner(last, first, p, offset)
    if corner is None:
        return None
    place = p - way_at(first, p).left() * offset
    path = parallel(first, offset)
    if isinstance(path, ExactLine):
        return corner if path.way.dot(corner - place) > NEAR else None
    ahead = turn(place - path.centre, corner - path.centre) * path.r
    return corner if ahead > NEAR else None


def written(parts: list[Part], entry: Entry, name: Namer) -> list[str]:
    """The items of the CUT that cuts the whole route from its entry, up to where BACK closes it."""
    index = next(
        i for i, part in enumerate(parts) if part is entry.first or isinstance(part, Pin) and part.arc is entry.first
    )
    first = entry.first
    if isinstance(parts[index], Pin):
        # It begins with the arc of a fillet.
        begin = name(None, first.start)
        circle = name(None, first.curve)
        body: list[Part] = [Leg(first.curve, first.start, first.end, circle), Pin(first.end, name(None, first.end))]
        return [str(begin), *_texts([*body, *parts[index + 1 :], *parts[:index]], name), str(begin)]
    before = parts[index - 1]
    rest = [*parts[index:], *parts[:index]]
    if first.whole:
        begin = before.text if isinstance(before, Pin) else name(None, first.start)
        around: list[Part] = [Pin(first.start, begin), first]
        return [*_texts(around, name), str(begin)]
    if isinstance(before, Pin) and before.arc is None:
        begin = _short(before.text, before.point, name)
        rest.pop()
        if entry.inner is None:
            return [str(begin), *_texts(rest, name), str(begin)]
        if isinstance(first.curve, ExactLine):
            return [str(name(None, foot(entry.inner, first.curve))), *_texts(rest, name), str(begin)]
        return [
            str(name(None, nearest(entry.inner, first.curve))),
            *_texts(rest, name),
            str(begin),
            *_texts([first], name),
        ]
    if isinstance(before, Pin):
        begin = name(None, first.start)
        return [str(begin), *_texts([*rest, first], name), str(begin)]
    begin = name(_joint(before, first), first.start)
    return [str(begin), *_texts(rest, name), str(begin)]


def _joint(before: Leg, first: Leg) -> SkgText | None:
    """Touching point of a belt line and a circle, in their own terms."""
    line, circle = (before, first) if isinstance(before.curve, ExactLine) else (first, before)
    if isinstance(circle.curve, ExactLine) or isinstance(line.curve, ExactCircle):
        return None
    return join(line.text, "*", circle.text) if line.text and circle.text else None


def _texts(parts: list[Part], name: Namer) -> list[str]:
    texts = []
    for part in parts:
        if isinstance(part, Pin):
            text = _short(part.text, part.point, name)
            texts.append(f"{text},{part.fillet.text}" if part.fillet else str(text))
        elif part.text is not None:
            texts.append(str(_short(part.text, part.curve, name)))
    return texts


def _short(text: SkgText, value: ExactElement, name: Namer) -> SkgText:
    return text if len(text.text) <= LONGEST_ITEM else name(text, value)


def repeated(parts: list[Part], count: int, entry: Entry, name: Namer) -> list[str] | None:
    """The items of the CUT that REP repeats: the first `count` parts, which lead to the second copy.

    None where the wire enters elsewhere than where the first item is reached.
    """
    begins = parts[0]
    first = next(part for part in parts if isinstance(part, Leg))
    if entry.inner is not None or entry.first.whole or entry.first is not first:
        return None
    if isinstance(begins, Pin):
        return None if begins.arc else _texts(parts[:count], name)
    return [str(name(None, first.start)), *_texts(parts[:count], name)]
