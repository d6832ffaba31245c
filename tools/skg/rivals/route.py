"""XY's belt: from the items of a φ to its contour, lines and arcs with where they begin and end (xy.md, section 4)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from lark import Token

from skg.rivals.formula import SkgText, join, literal, minus
from skg.rivals.plane import (
    NEAR,
    SAME_WAY,
    TINY,
    ZERO,
    ExactCircle,
    ExactCurve,
    ExactLine,
    ExactPoint,
    PlaneError,
    Real,
    belt_line,
    crossing_that_turns,
    crossings,
    mp,
    on,
    parallel,
    same_circle,
    same_point,
    sweep,
    touching_point,
    turn,
    way_at,
)
from skg.rivals.statement import TextFault


@dataclass(frozen=True)
class Arc:
    """A number in a route: the radius of a fillet or of a connecting arc (signed), and where it stands."""

    radius: Real
    text: SkgText
    token: Token


@dataclass(frozen=True)
class Hung:
    """A pin or a pulley of the belt, the number behind it, and where it stands."""

    value: ExactPoint | ExactCircle
    text: SkgText
    token: Token
    arc: Arc | None = None

    @property
    def is_pin(self) -> bool:
        """A point."""
        return isinstance(self.value, ExactPoint)

    @property
    def point(self) -> ExactPoint:
        """The point of a pin."""
        assert isinstance(self.value, ExactPoint)
        return self.value

    @property
    def circle(self) -> ExactCircle:
        """The circle of a pulley."""
        assert isinstance(self.value, ExactCircle)
        return self.value


@dataclass
class Leg:
    """A line or an arc of the contour; no text: a line between points, which SKG brings in by itself."""

    curve: ExactCurve
    start: ExactPoint
    end: ExactPoint
    text: SkgText | None = None
    whole: bool = False

    @property
    def is_travelled(self) -> bool:
        """Longer than near."""
        return self.whole or not same_point(self.start, self.end)

    @property
    def circle(self) -> ExactCircle:
        """The circle of an arc."""
        assert isinstance(self.curve, ExactCircle)
        return self.curve

    def angle(self) -> Real:
        """The angle that an arc sweeps, radians."""
        if self.whole:
            return 2 * mp.pi
        return sweep(self.circle, self.start, self.end) if self.is_travelled else ZERO

    def has(self, p: ExactPoint) -> bool:
        """True if a point of the curve lies between start and end (near)."""
        if same_point(p, self.start) or same_point(p, self.end):
            return True
        if isinstance(self.curve, ExactLine):
            return self.curve.way.dot(p - self.start) > 0 and self.curve.way.dot(self.end - p) > 0
        return self.is_travelled and sweep(self.curve, self.start, p) <= self.angle()


@dataclass
class Pin:
    """A corner that a point names; its fillet, and the arc of that."""

    point: ExactPoint
    text: SkgText
    fillet: Arc | None = None
    arc: Leg | None = None


Part = Leg | Pin


# The items -----------------------------------------------------------------------------------------------------


def is_same(a: Hung, b: Hung) -> bool:
    """One item, hung twice."""
    if a.is_pin != b.is_pin:
        return False
    return same_point(a.point, b.point) if a.is_pin else same_circle(a.circle, b.circle)


def _merged(a: Hung, b: Hung) -> Hung:
    """Two neighbours that are one item."""
    if not a.is_pin and a.arc:
        raise TextFault(a.arc.token.start_pos, "rival-arc-one-circle")
    return Hung(a.value, a.text, a.token, (a.arc if a.is_pin else None) or b.arc)


def without_doubles(items: list[Hung]) -> list[Hung]:
    """The items of a closed belt, neighbours that are the same made one."""
    merged: list[Hung] = []
    for item in items:
        if merged and is_same(merged[-1], item):
            merged[-1] = _merged(merged[-1], item)
        else:
            merged.append(item)
    while len(merged) > 1 and is_same(merged[-1], merged[0]):
        last = merged.pop()
        if last.is_pin:
            merged[0] = _merged(merged[0], last)
        elif last.arc:
            raise TextFault(last.arc.token.start_pos, "rival-arc-one-circle")
    return merged


def mirror_items(items: list[Hung], image: Callable[[Hung], Hung]) -> list[Hung]:
    """The images of items, last to first: a fillet stays with its point, a connecting arc between its circles."""
    pins: list[Hung] = []
    for index in reversed(range(len(items))):
        item = items[index]
        made = image(item)
        arc = item.arc if item.is_pin else None
        if not item.is_pin and index and not items[index - 1].is_pin:
            arc = items[index - 1].arc
        pins.append(Hung(made.value, made.text, made.token, arc))
    return pins


def mirrored_items(items: list[Hung], image: Callable[[Hung], Hung]) -> list[Hung]:
    """Items and then their images; the one on the mirror once."""
    images = mirror_items(items, image)
    last = items[-1]
    if is_same(last, images[0]):
        if not last.is_pin and last.arc:
            raise TextFault(last.arc.token.start_pos, "rival-arc-one-circle")
        items = [*items[:-1], Hung(last.value, last.text, last.token, images[0].arc)]
        images = images[1:]
    return [*items, *images]


# The pieces between two of them --------------------------------------------------------------------------------


def between(a: Hung, b: Hung, index: int | None) -> tuple[ExactPoint, ExactPoint, list[Part]]:
    """The points at which the belt leaves a and reaches b, and the pieces between; `index`: the place to blame.

    The table of xy.md, section 4.
    """
    if a.arc and not a.is_pin:
        if b.is_pin:
            raise TextFault(a.arc.token.start_pos, "rival-arc-two-circles")
        arc = _connecting(a, b, a.arc)
        return arc.start, arc.end, [arc]
    if a.is_pin and b.is_pin:
        line = ExactLine(a.point, (b.point - a.point).unit())
        return a.point, b.point, [Leg(line, a.point, b.point)]
    for pin, circle in ((a, b), (b, a)):
        if pin.is_pin:
            if on(circle.circle, pin.point):
                return pin.point, pin.point, []
            if (pin.point - circle.circle.centre).size() < abs(circle.circle.r):
                raise TextFault(index, "rival-point-inside")
    try:
        belt = belt_line(a.value, b.value)
    except PlaneError:
        raise TextFault(index, "rival-no-belt") from None
    if belt is None:
        touch = touching_point(a.circle, b.circle)
        return touch, touch, [Pin(touch, join(a.text, "*", b.text))]
    leaves, joins = (h.point if h.is_pin else touching_point(h.circle, belt) for h in (a, b))
    return leaves, joins, [Leg(belt, leaves, joins, join(a.text, ":", b.text))]


def _connecting(a: Hung, b: Hung, arc: Arc) -> Leg:
    """The arc of the given radius from one circle to the other (SKG book, B 9-5)."""
    size = abs(arc.radius)
    text = arc.text if arc.radius > 0 else minus(arc.text)
    clockwise = arc.radius > 0
    try:
        if size <= TINY:
            raise PlaneError("rival-radius-zero")
        step = size if clockwise else -size
        around_a, around_b = (parallel(h.circle, step) for h in (a, b))
        if any(abs(circle.r) <= TINY for circle in (around_a, around_b)):
            raise PlaneError("rival-circle-itself")
        circles = [ExactCircle(centre, -step) for centre in crossings(around_a, around_b)]
    except PlaneError as error:
        raise TextFault(arc.token.start_pos, "rival-arc-short", why=error.why) from None

    def stretch(circle: ExactCircle) -> Leg:
        return Leg(circle, touching_point(a.circle, circle), touching_point(b.circle, circle))

    best = min(map(stretch, circles), key=Leg.angle)
    first, second = (join(h.text, ":", text if clockwise else minus(text)) for h in (a, b))
    right = SkgText(f"-({second})", 0o55) if clockwise else second
    best.text = join(join(first, "*", right), ":", minus(text) if clockwise else text)
    if len(circles) > 1:
        turning = crossing_that_turns(around_a, around_b, left=not clockwise)
        if not same_point(turning, best.circle.centre):
            best.text = literal(best.curve)
    return best


# The contour ---------------------------------------------------------------------------------------------------


def contour(items: list[Hung], closes: int | None) -> tuple[list[Part], list[int]]:
    """The parts of the closed belt, from where the first item is reached, and which of them begins each item.

    `closes` is the place of the ←.
    """
    if len(items) == 1:
        if items[0].is_pin:
            raise TextFault(closes, "rival-one-point")
        if items[0].arc:
            raise TextFault(items[0].arc.token.start_pos, "rival-arc-two-circles")
        circle = items[0].circle
        return [Leg(circle, circle.centre, circle.centre, items[0].text, whole=True)], [0]
    follows = [
        between(
            item,
            items[(index + 1) % len(items)],
            items[index + 1].token.start_pos if index + 1 < len(items) else closes,
        )
        for index, item in enumerate(items)
    ]
    parts: list[Part] = []
    begins = []
    for index, item in enumerate(items):
        begins.append(len(parts))
        leaves, _, after = follows[index]
        if item.is_pin:
            parts.append(Pin(item.point, item.text, item.arc))
        else:
            parts.append(Leg(item.circle, follows[index - 1][1], leaves, item.text))
        parts += after
    curves = [part for part in parts if isinstance(part, Leg)]
    if len(curves) == 1:
        # One circle and a point on it.
        curves[0].whole = True
    if not any(stretch.is_travelled for stretch in curves):
        raise TextFault(closes, "rival-no-travel")
    _round(parts)
    return parts, begins


def _round(parts: list[Part]) -> None:
    """Find the arcs of all fillets, and shorten what they stand between."""
    for index, pin in enumerate(parts):
        if not isinstance(pin, Pin) or pin.fillet is None:
            continue
        start = pin.fillet.token.start_pos
        if pin.fillet.radius <= TINY:
            raise TextFault(start, "rival-fillet-radius")
        around = [part for part in parts[index + 1 :] + parts[:index] if isinstance(part, Leg)]
        if not around or around[0].whole:
            pin.fillet = None
            continue
        before, after = around[-1], around[0]
        angle = turn(way_at(before.curve, pin.point), way_at(after.curve, pin.point))
        if abs(angle) < SAME_WAY:
            pin.fillet = None
            continue
        try:
            pin.arc = _fillet(before.curve, after.curve, pin.fillet.radius, angle)
        except PlaneError as error:
            raise TextFault(start, "rival-no-fillet", why=error.why) from None
        if not before.has(pin.arc.start) or not after.has(pin.arc.end):
            raise TextFault(start, "rival-fillet-past")
        before.end, after.start = pin.arc.start, pin.arc.end


def _fillet(e: ExactCurve, f: ExactCurve, radius: Real, angle: Real) -> Leg:
    """The arc that touches both on the inner side of a corner that turns by `angle`."""
    if mp.pi - abs(angle) <= SAME_WAY:
        raise PlaneError("rival-straight-back")
    signed = radius if angle > 0 else -radius
    for curve in (e, f):
        if isinstance(curve, ExactCircle):
            inner = parallel(curve, -signed).r
            if (inner if curve.r > 0 else -inner) <= NEAR:
                raise PlaneError("rival-smaller-circle")
    arc = ExactCircle(crossing_that_turns(parallel(e, -signed), parallel(f, -signed), left=angle > 0), signed)
    start, end = (
        touching_point(arc, curve) if isinstance(curve, ExactLine) else touching_point(curve, arc) for curve in (e, f)
    )
    return Leg(arc, start, end)


def stretches(parts: list[Part]) -> list[Leg]:
    """All that is travelled, the arcs of fillets too, in order."""
    pieces = (part.arc if isinstance(part, Pin) else part for part in parts)
    return [stretch for stretch in pieces if stretch is not None and stretch.is_travelled]


def area(parts: list[Part]) -> Real:
    """Signed area within the contour, mm²: positive when it runs counter-clockwise."""
    total = ZERO
    for stretch in stretches(parts):
        total += stretch.start.cross(stretch.end) / 2
        if isinstance(stretch.curve, ExactCircle):
            angle = stretch.angle()
            bulge = stretch.curve.r**2 * (angle - mp.sin(angle)) / 2
            total += bulge if stretch.curve.r > 0 else -bulge
    return total
