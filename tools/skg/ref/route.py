"""The route: from written elements to segments (language.md, section 4).

Everything here is in millimetres on the tape: SCALE has been applied to the elements already.

What goes out when
------------------
A route is fed one written item at a time, in the order of the program, and each item is worked off before
the next one is evaluated. An item is evaluated, its kind checked (a number is a fillet radius and waits), and
then:

1. A point after a point, 1 µm or more away, brings in the line between them, which goes through step 3 as if
   it had been written; then the point waits. A point after a curve is checked to lie on that curve and
   waits. A point at the route's beginning waits. Nothing goes out for a point itself: its corner needs the
   element that follows.
2. A curve directly after a curve that is the same (in centre and radius; or in direction, and within 1 µm of
   the place where the first was entered) is dropped with the turn and the fillet before it.
3. Any other curve F is checked to pass a waiting point, and is offset (error 7). Then:
   - F is the route's first curve: the place of entry is known, and the move from the wire to it goes out.
   - else the corner between the curve E before and F is computed at once, with the waiting point and the
     waiting fillet. When all of it is found to be possible, E goes out from where it was entered to its end,
     and after it the fillet's arc. F has now been entered; its end is not known.

So the one curve whose end is still open, the point and the fillet that wait and the route's beginning are all
that must be remembered. SYM and REP feed their elements one by one in the same way. FIT feeds its first node
at once, and each span (first arc, joint, second arc, node) as soon as the tangents at both of its nodes are
known: with no tangents given, the span between two nodes when the node after them comes, or when the run of
FIT statements ends.

BACK feeds the line to the first point, where there is one to bring in, then computes the closing corner, and
then puts out what is left in one go: the last curve, a fillet, the rest of the first curve, the move to the
FROM point. FROM and END do the same without that move, or put out the last curve up to the last point.

An error at any of these steps leaves on the tape what went out before that step. A route is open, so that an
error puts a `D` on the tape, from its first item on until BACK, FROM or END have ended it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from skg.ref import near, real
from skg.ref.fault import Code, Fault
from skg.ref.geometry import (
    Crossings,
    check_on,
    crossings,
    mirrored,
    nearest,
    parallel,
    place,
    right,
    same_circle,
    same_point,
    sweep,
    through,
    turn_angle,
    turned,
)
from skg.ref.real import MICRON, NEARLY, ZERO, Real
from skg.ref.values import Circle, Curve, Line, Point

#: Directions closer than this (radians) are one direction.
SAME_WAY = Real("0.001")
#: Curves that cross by no more than this (mm) touch at a corner that no point names. So much is noise in
#: the firmware's floats; more is a crossing.
TOUCH = Real("1e-5")
#: Lines whose directions differ by no more than this (radians) may merge.
SAME_LINE = Real("1e-5")


@dataclass(frozen=True)
class Item:
    """An element as written: what turn and what fillet lead to it."""

    value: Point | Curve
    right: bool = False
    fillet: Real | None = None


@dataclass(frozen=True)
class Segment:
    """A move of the wire in true coordinates (mm).

    `nominal` is the element as drawn (None for moves outside the contour) and `offset` its R. An arc has
    `centre`, `radius` (of the wire's path, signed like a circle's) and `sweep` (radians, positive along the
    travel, 2π for a full circle). `role` is "entry", "cut", "fillet", "return" or "reposition".
    """

    start: Point
    end: Point
    role: str
    nominal: Curve | None = None
    offset: Real = ZERO
    centre: Point | None = None
    radius: Real | None = None
    sweep: Real | None = None
    line: int | None = None

    @property
    def is_arc(self) -> bool:
        """True if the segment is an arc."""
        return self.centre is not None


@dataclass(frozen=True)
class Element:
    """A curve of the route that has been entered, at `start` as offset; `drawn`: the corner there as drawn, without
    its fillet; `between`: a line that two points have brought in."""

    nominal: Curve
    offset: Real
    curve: Curve
    start: Point
    drawn: Point
    between: bool = False

    def place(self, p: Point) -> Point:
        """A point of the nominal curve as offset."""
        return place(self.nominal, p, self.offset)

    def passing(self, p: Point) -> Line:
        """A line's path, when the line is moved to pass a point."""
        assert isinstance(self.nominal, Line)
        return replace(self.nominal, g=self.nominal.normal.dot(p) + self.offset)


def offset_curve(nominal: Curve, offset: Real) -> Curve:
    """The wire's path beside a curve; error 7 when a circle's radius becomes zero or changes its sign."""
    if isinstance(nominal, Line):
        return parallel(nominal, offset)
    circle = parallel(nominal, offset)
    left = circle.r if nominal.r > 0 else -circle.r
    near.note("offset", left, 1e-6)
    if left <= NEARLY:
        raise Fault(Code.OFFSET)
    return circle


def _chosen(meeting: Crossings, to_right: bool) -> Point:
    return meeting.right if to_right else meeting.left


def _nearest_crossing(meeting: Crossings, p: Point) -> Point:
    left, right = (meeting.left - p).length(), (meeting.right - p).length()
    if meeting.left is not meeting.right:
        near.note("nearest crossing", left - right, 1e-6)
    return meeting.left if left <= right else meeting.right


def _same_offset(r1: Real, r2: Real) -> bool:
    return near.at_most(abs(r1 - r2), MICRON, "change of R")


class Route:
    """An open route. `emit` takes its segments, in order; before it the wire is at `wire`, `hole` is the FROM point."""

    def __init__(self, wire: Point, hole: Point, emit: Callable[[Segment], None]) -> None:
        self.wire = wire
        self.hole = hole
        self.emit = emit
        self.items: list[Item] = []
        self.first_point: Point | None = None
        self.first_point_offset = ZERO
        self.first: Element | None = None
        self.first_end: Point | None = None
        self.curves = 0
        # State that waits for the next item:
        self.element: Element | None = None
        self.point: Point | None = None
        self.fillet: Real | None = None
        self.right = False

    # Taking items ---------------------------------------------------------------------------------------

    def wait_fillet(self, radius: Real, right: bool = False) -> None:
        """A fillet radius for the next corner, negative: which turns right; `right`: a `;` stands before it."""
        entered_here = self.point is not None and self.element is None
        if not self.items or self.fillet is not None or entered_here:
            raise Fault(Code.GEOMETRY)
        self.fillet, self.right = radius, right

    def feed(self, value: Point | Curve, offset: Real, right: bool = False) -> None:
        """The next element, with the R of its statement and the turn that leads to it."""
        if isinstance(value, Point) and self.point is not None and same_point(self.point, value):
            self.items.append(Item(value))  # (of images, which come last to first, it may be the first of the two)
            return
        right = right or self.right
        self.items.append(Item(value, right, self.fillet))
        if isinstance(value, Point):
            self._feed_point(value, offset)
        else:
            self._feed_curve(value, offset, right)
        self.right = False

    def feed_item(self, item: Item, offset: Real) -> None:
        """An element written before, with the fillet that leads to it."""
        if item.fillet is not None:
            self.wait_fillet(item.fillet)
        self.feed(item.value, offset, item.right)

    def mirror(self, mirror: Line, offset: Real, right: bool) -> None:
        """SYM: the images of all elements, last to first; `right`: the corner at the mirror turns right."""
        written, waiting = list(self.items), self.fillet
        for k in reversed(range(len(written))):
            item, after = written[k], written[k + 1] if k + 1 < len(written) else None
            image = mirrored(item.value, mirror)
            fillet = None
            if after is None:
                turn = right
            else:
                turn = after.right
                if isinstance(after.value, Point):  # its own fillet stays with it
                    fillet = written[k + 2].fillet if k + 2 < len(written) else waiting
                elif not isinstance(item.value, Point):
                    fillet = after.fillet
            if self.fillet is not None:  # waiting since before SYM
                fillet = None
            self.feed_item(Item(image, turn, fillet), offset)

    def repeat(self, count: int, angle: Real, about: Point, offset: Real, right: bool) -> None:
        """REP: all elements count - 1 times more, turned; `right`: the corners between copies turn right."""
        written, fillet, fillet_right = list(self.items), self.fillet, self.right
        for i in range(1, count):
            for k, item in enumerate(written):
                value = turned(item.value, angle * i, about)
                self.feed_item(replace(item, value=value, right=item.right if k else right), offset)
            if fillet is not None and self.fillet is None:
                self.wait_fillet(fillet, fillet_right)

    def _feed_point(self, p: Point, offset: Real) -> None:
        if self.point is not None:
            near.note("short chord", (p - self.point).length(), near.SHORT)
            self._feed_curve(through(self.point, p), offset, right=False, between=True)
        elif self.element is not None:
            if self.fillet is not None:
                raise Fault(Code.GEOMETRY)
            check_on(self.element.nominal, p)
        else:
            self.first_point, self.first_point_offset = p, offset
        self.point = p

    def _feed_curve(self, nominal: Curve, offset: Real, right: bool, between: bool = False) -> None:
        if self.point is not None:
            check_on(nominal, self.point)
        elif self.element is not None and self._is_same(self.element, nominal):
            self.fillet = None
            return
        curve = offset_curve(nominal, offset)
        if self.element is None:
            self._enter(nominal, offset, curve, between)
        else:
            before = self.element
            self.element = self._go_over(
                before, Element(nominal, offset, curve, before.start, before.drawn, between), right
            )
        self.curves += 1
        self.point = None

    def _enter(self, nominal: Curve, offset: Real, curve: Curve, between: bool) -> None:
        p = self.point
        start = nearest(curve, self.hole) if p is None else place(nominal, p, offset)
        self.emit(Segment(self.wire, start, "entry"))
        self.first = self.element = Element(nominal, offset, curve, start, start, between)

    def _is_same(self, entered: Element, nominal: Curve) -> bool:
        """True if a curve goes on along the one that was entered."""
        if isinstance(entered.nominal, Circle):
            return isinstance(nominal, Circle) and same_circle(entered.nominal, nominal)
        if not isinstance(nominal, Line):
            return False
        d, t = entered.nominal.direction, nominal.direction
        if d.dot(t) <= 0 or not near.at_most(abs(d.cross(t)), SAME_LINE, "same line"):
            return False
        miss = nominal.distance(entered.start) - entered.offset
        return near.at_most(abs(miss), MICRON, "same line")

    # Corners --------------------------------------------------------------------------------------------

    def _go_over(self, e: Element, f: Element, right: bool) -> Element:
        """From the open element e over the next corner to f; returns f as it is entered there."""
        p, fillet = self.point, self.fillet
        self.fillet = None
        drawn = p if p is not None else _chosen(crossings(e.nominal, f.nominal, TOUCH), right)
        arc = None if fillet is None else self._fillet(e, f, drawn, fillet)
        if arc is None:
            end = self._travel(e, self._corner(e, f, p, right), "cut", drawn, p is not None)
            return replace(f, start=end, drawn=drawn)
        circle, touch_e, touch_f = arc
        if not _same_offset(e.offset, f.offset):
            raise Fault(Code.GEOMETRY)
        rounding = Element(circle, f.offset, offset_curve(circle, f.offset), e.start, drawn)
        touch = (e if isinstance(e.nominal, Circle) else rounding).place(touch_e)
        end = self._travel(e, touch, "cut", touch_e)
        start = self._travel(replace(rounding, start=end), rounding.place(touch_f), "fillet")
        return replace(f, start=start, drawn=drawn)

    def _corner(self, e: Element, f: Element, p: Point | None, right: bool) -> Point:
        """The corner between two elements as offset, p the point that names it."""
        if p is None:
            return _chosen(crossings(e.curve, f.curve, TOUCH), right)
        if e.offset == 0 and f.offset == 0:
            return p
        angle = abs(turn_angle(e.nominal, f.nominal, p))
        if near.at_most(angle, SAME_WAY, "same direction"):
            if not _same_offset(e.offset, f.offset):
                raise Fault(Code.GEOMETRY)
            return e.place(p)
        if near.at_most(real.mp.pi - angle, SAME_WAY, "opposite direction"):
            raise Fault(Code.GEOMETRY)
        if e.between and f.between:  # both end in p, also where the last point is within 1 µm of the first
            return crossings(e.passing(p), f.passing(p), ZERO).left
        return _nearest_crossing(crossings(e.curve, f.curve, ZERO), p)

    def _fillet(self, e: Element, f: Element, corner: Point, radius: Real) -> tuple[Circle, Point, Point] | None:
        """The arc that rounds the corner between the elements as drawn, and its points on both.

        None where the corner turns too little; error 6 when it goes back, when the arc does not fit, or when the radius
        is negative and the corner turns left. The centre is the crossing of both curves moved inwards by the radius
        (formula 9-7 of the SKG book).
        """
        turn = turn_angle(e.nominal, f.nominal, corner)
        near.note("fillet left out", (abs(turn) - SAME_WAY) / SAME_WAY, near.RELATIVE)
        if abs(turn) < SAME_WAY:
            return None
        if near.at_most(real.mp.pi - abs(turn), SAME_WAY, "opposite direction"):
            raise Fault(Code.GEOMETRY)
        if radius < 0 < turn:
            raise Fault(Code.GEOMETRY)
        signed = abs(radius) if turn > 0 else -abs(radius)
        inner_e, inner_f = _moved_inwards(e.nominal, signed), _moved_inwards(f.nominal, signed)
        middle = _chosen(crossings(inner_e, inner_f, ZERO), signed < 0)
        arc = Circle(middle.x, middle.y, signed)
        # If they touch within 1 µm only, the place is on the circle, of two circles on the first.
        touch_e = _touching(e.nominal if isinstance(e.nominal, Circle) else arc, e.nominal, arc)
        touch_f = _touching(arc, f.nominal, arc)
        if isinstance(e.curve, Circle):
            _check_order(e.curve, e.start, e.place(touch_e), e.place(corner), "fillet fits")
        return arc, touch_e, touch_f

    # Travel ---------------------------------------------------------------------------------------------

    def _circle_travel(self, e: Element, end: Point) -> Real:
        """Angle travelled on a circle from where it was entered; 0 for an end within 1 µm of that place."""
        return ZERO if same_point(e.start, end) else sweep(_circle(e.curve), e.start, end)

    def _travel(self, e: Element, end: Point, role: str, drawn: Point | None = None, is_named: bool = False) -> Point:
        """Put out e from where it was entered to its end; returns where the wire then is.

        `drawn`: its end as drawn; None: a circle's travel is not compared with that as drawn. `is_named`: by a point;
        two such places in one are a whole turn.
        """
        if isinstance(e.curve, Line):
            back = -(end - e.start).dot(e.curve.direction)
            if not near.at_most(back, MICRON, "travel"):
                raise Fault(Code.GEOMETRY)
            self.emit(Segment(e.start, end, role, e.nominal, e.offset))
            return end
        angle = self._circle_travel(e, end)
        if drawn is not None:
            _check_half_turn(angle - _drawn_travel(e, drawn, is_named))
            _check_half_turn(abs(_move(e, e.drawn, e.start)) + abs(_move(e, drawn, end)))
        if self.curves == 1 and role == "cut" and self.first_end is None:
            self.first_end = end
        if angle == 0:
            return e.start
        self._emit_arc(e, end, angle, role)
        return end

    def _emit_arc(self, e: Element, end: Point, angle: Real, role: str) -> None:
        circle = _circle(e.curve)
        self.emit(Segment(e.start, end, role, e.nominal, e.offset, circle.centre, circle.r, angle))

    # Ends -----------------------------------------------------------------------------------------------

    def close(self) -> None:
        """Through the closing corner and along the first element to where the route was entered."""
        first = self.first
        if first is None or self.element is None:
            raise Fault(Code.GEOMETRY)
        if self.first_point is not None:
            if self.point is not None and not same_point(self.point, self.first_point):
                self._feed_curve(through(self.point, self.first_point), self.first_point_offset, False, between=True)
            elif self.point is None:
                check_on(self.element.nominal, self.first_point)
            if self.fillet is not None:
                raise Fault(Code.GEOMETRY)
            self.point = self.first_point
        elif self.point is not None:
            check_on(first.nominal, self.point)
        if self.curves == 1:
            self._close_single(first)
        elif self.point is None and self._ends_as_it_begins(first):
            if self.fillet is not None:
                raise Fault(Code.GEOMETRY)
            self._close_along(first, self.element)
        else:
            self._close_along(first, self._go_over(self.element, first, self.right))

    def _ends_as_it_begins(self, entered: Element) -> bool:
        """True if the last element written is the first again."""
        first, last = self.items[0].value, self.items[-1].value
        if isinstance(first, Point) or isinstance(last, Point):
            if not (isinstance(first, Point) and isinstance(last, Point)) or self.point is None:
                return False
            return same_point(first, self.point)
        return self._is_same(entered, last)

    def _close_single(self, first: Element) -> None:
        """A route of one circle, from the entry once round, by way of a last point if there is one."""
        if isinstance(first.curve, Line):
            raise Fault(Code.GEOMETRY)
        halfway = first.start if self.point is None else first.place(self.point)
        angle = self._circle_travel(first, halfway)
        if angle > 0:
            self._emit_arc(first, halfway, angle, "cut")
        if self.fillet is not None:
            raise Fault(Code.GEOMETRY)
        if angle == 0:
            self._emit_arc(first, first.start, 2 * real.mp.pi, "cut")
            return
        self._travel(replace(first, start=halfway), first.start, "cut")

    def _close_along(self, first: Element, e: Element) -> None:
        """Along the last piece of the first element to the entry; error 6 when it lies behind."""
        entry = first.start
        if not _same_offset(e.offset, first.offset):
            raise Fault(Code.GEOMETRY)
        if isinstance(e.curve, Circle):
            assert self.first_end is not None, "the first curve has been left"
            cut = _path_travel(e.curve, entry, self.first_end)
            overlap = _path_travel(e.curve, e.start, entry) + cut - 2 * real.mp.pi
            if not near.at_most(overlap * abs(e.curve.r), MICRON, "closing corner"):
                raise Fault(Code.GEOMETRY)
        self._travel(e, entry, "cut", entry)

    def finish(self) -> Point:
        """End without BACK: close onto the first element if it was written last, else stop at the last point.

        Returns where the wire stays.
        """
        if self.fillet is not None or self.first is None or self.element is None:
            raise Fault(Code.GEOMETRY)
        if len(self.items) >= 2 and self._ends_as_it_begins(self.first):
            self.close()
            return self.first.start
        if self.point is None:
            raise Fault(Code.GEOMETRY)
        return self._travel(self.element, self.element.place(self.point), "cut", self.point)


def _moved_inwards(curve: Curve, radius: Real) -> Curve:
    """A curve moved to the fillet's side by its radius; error 6 where that leaves a circle 1 µm or less."""
    if isinstance(curve, Line):
        return parallel(curve, -radius)
    moved = parallel(curve, -radius)
    if near.at_most(moved.r if curve.r > 0 else -moved.r, MICRON, "fillet fits"):
        raise Fault(Code.GEOMETRY)
    return moved


def _circle(curve: Curve) -> Circle:
    """The curve of an element that is travelled by its angle."""
    assert isinstance(curve, Circle)
    return curve


def _drawn_travel(e: Element, end: Point, is_named: bool) -> Real:
    """Angle travelled on a circle as drawn, radians: for an end that lies within 1 µm of its entry 0, but where a
    point names it 2π."""
    circle = _circle(e.nominal)
    angle = sweep(circle, e.drawn, end)
    full = 2 * real.mp.pi
    if near.at_most((full - angle) * abs(circle.r), MICRON, "half a turn"):
        return full if is_named else ZERO
    if is_named and near.at_most(angle * abs(circle.r), MICRON, "half a turn"):
        return full
    return angle


def _move(e: Element, drawn: Point, offset: Point) -> Real:
    """Angle by which the offset moves a corner about a circle's centre, radians from -π to π along the travel."""
    angle = sweep(_circle(e.nominal), drawn, offset)
    return angle if angle <= real.mp.pi else angle - 2 * real.mp.pi


def _check_half_turn(angle: Real) -> None:
    """Error 6 when an angle on a circle (radians) is more than half a turn: by how much its travel differs from that as
    drawn, or what the offset moves both its ends by. Then the wire might leave the arc out, or run round the rest of
    its circle."""
    if not near.at_most(abs(angle), real.mp.pi, "half a turn"):
        raise Fault(Code.GEOMETRY)


def _path_travel(path: Circle, start: Point, end: Point) -> Real:
    """Angle travelled between the places on a wire's path that are nearest to two points; 0 within 1 µm."""
    u, v = nearest(path, start), nearest(path, end)
    return ZERO if same_point(u, v) else sweep(path, u, v)


def _check_order(path: Circle, start: Point, middle: Point, end: Point, kind: str) -> None:
    """Error 6 when, from start, a middle place on a circle comes after the end by more than 1 µm."""
    excess = _path_travel(path, start, middle) - _path_travel(path, start, end)
    if not near.at_most(excess * abs(path.r), MICRON, kind):
        raise Fault(Code.GEOMETRY)


def _touching(on: Circle, curve: Curve, arc: Circle) -> Point:
    """Touching point of a curve and an arc of the same sense, on one of two circles: the curve itself or the arc."""
    return on.centre + right(curve, arc.centre) * on.r
