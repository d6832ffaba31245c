"""The wire: everything that the cutting statements do, from drawing to tape."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from skg.ref import near
from skg.ref.fault import Code, Fault
from skg.ref.fit import FittedCurve, Node
from skg.ref.geometry import enlarged
from skg.ref.real import NEARLY, ONE, ZERO, Real
from skg.ref.route import Item, Route, Segment
from skg.ref.tape import Punch, grid
from skg.ref.values import ORIGIN, Circle, Line, Point

#: More items than the route buffer of any board has room for (56 KiB, 16 bytes an item).
MOST_ITEMS = 3584
#: So many copies REP makes here, so that a slip does not keep it busy for hours (language.md, section 4.7).
MOST_COPIES = 10000


def _in_memory(items: Sequence[Item]) -> None:
    """Error 9 when SYM, REP or RECUT need a route that no board has in memory."""
    if len(items) > MOST_ITEMS:
        raise Fault(Code.MEMORY)


@dataclass(frozen=True)
class Closed:
    """A route that BACK has closed, for RECUT: its elements, the fillet that waited for BACK's corner and its turn."""

    items: tuple[Item, ...]
    fillet: Real | None
    right: bool


class Cutter:
    """The state between cutting statements. Places are in mm on the tape, arguments in the drawing's mm."""

    #: The curve of a run of FIT statements; tests look at it while it is made.
    new_curve = FittedCurve

    def __init__(self, tape: Punch, path: list[Segment]) -> None:
        self.tape = tape
        self.path = path
        self.line: int | None = None
        self.wire = ORIGIN
        self.from_point = ORIGIN
        self.scale = ONE
        self.tolerance = ZERO
        self.moved = False
        self.route: Route | None = None
        self.curve: FittedCurve | None = None
        self.closed: Closed | None = None

    # Moves ----------------------------------------------------------------------------------------------

    def _emit(self, segment: Segment) -> None:
        if segment.centre is None or segment.radius is None or segment.sweep is None:
            self.tape.line(segment.end)
        else:
            self.tape.arc(segment.end, segment.centre, segment.radius < 0, segment.sweep)
        if segment.is_arc or (segment.end - segment.start).length() > NEARLY:
            self.path.append(replace(segment, line=self.line))
        self.wire = segment.end

    def _straight(self, end: Point, role: str) -> None:
        self._emit(Segment(self.wire, end, role))

    def position(self, p: Point) -> None:
        """FROM: silent before anything else, then a re-positioning between two stops."""
        p = enlarged(p, self.scale)
        grid(p)  # (error 10 before anything is done)
        if self.moved:
            self._end_route()
            self.tape.check_move(p)
            self.from_point = p
            self.tape.stop()
            self._straight(p, "reposition")
            self.tape.stop()
        else:
            self.tape.place(p)
            self.wire = p
        self.from_point = p
        self.moved = True

    # The route ------------------------------------------------------------------------------------------

    def element(self, value: Point | Circle | Line, right: bool, offset: Real) -> None:
        """An element of CUT."""
        self._feed(enlarged(value, self.scale), offset, right)

    def _feed(self, value: Point | Circle | Line, offset: Real, right: bool = False) -> None:
        self.moved = True
        self.closed = None
        if self.route is None:
            self.route = self._new_route()
        self.route.feed(value, offset, right)

    def _new_route(self) -> Route:
        return Route(self.wire, self.from_point, self._emit)

    def fillet(self, radius: Real, right: bool) -> None:
        """A number of CUT."""
        if radius == 0:
            raise Fault(Code.RANGE)
        self._open_route().wait_fillet(radius * self.scale, right)

    def node(self, p: Point, tangent: Point | None, offset: Real) -> None:
        """FIT, `tangent` a unit vector where it is given."""
        if self.curve is None:
            self.curve = self.new_curve(self._feed, self.tolerance)
        self.curve.add(Node(enlarged(p, self.scale), tangent, offset))

    def tolerate(self, tolerance: Real) -> None:
        """TOL, in mm on the tape."""
        if tolerance:
            near.note("tolerance", tolerance, NEARLY)
        if tolerance < 0:
            raise Fault(Code.RANGE)
        self.tolerance = tolerance

    def mirror(self, mirror: Line, right: bool, offset: Real) -> None:
        """SYM."""
        _in_memory(self._open_route().items)
        self._open_route().mirror(enlarged(mirror, self.scale), offset, right)

    def repeat(self, count: int, angle: Real, about: Point, right: bool, offset: Real) -> None:
        """REP."""
        _in_memory(self._open_route().items)
        if count > MOST_COPIES:
            raise Fault(Code.MEMORY)
        self._open_route().repeat(count, angle, enlarged(about, self.scale), offset, right)

    def back(self) -> None:
        """BACK."""
        self.end_curve()
        route = self._open_route()
        closed = Closed(tuple(route.items), route.fillet, route.right)
        route.close()
        self.route = None
        self._straight(self.from_point, "return")
        self.closed = closed

    def recut(self, offset: Real) -> None:
        """RECUT."""
        closed = self.closed
        if closed is None or self.route is not None:
            raise Fault(Code.GEOMETRY)
        _in_memory(closed.items)
        self.route = self._new_route()
        for item in closed.items:
            self.route.feed_item(item, offset)
        if closed.fillet is not None:
            self.route.wait_fillet(closed.fillet, closed.right)
        self.back()
        self.closed = closed

    def enlarge(self, factor: Real) -> None:
        """SCALE."""
        near.note("scale", factor, 1e-6)
        if factor <= 0:
            raise Fault(Code.RANGE)
        self.refuse_in_route()
        self.scale = factor

    def refuse_in_route(self) -> None:
        """Error 6 with a route open."""
        if self.route is not None:
            raise Fault(Code.GEOMETRY)

    def _open_route(self) -> Route:
        if self.route is None:
            raise Fault(Code.GEOMETRY)
        return self.route

    def end_curve(self) -> None:
        """A statement that cuts otherwise ends the run of FIT."""
        if self.curve is not None:
            curve, self.curve = self.curve, None
            curve.finish()

    def _end_route(self) -> None:
        self.end_curve()
        if self.route is not None:
            self.route.finish()
            self.route = None

    def end(self) -> None:
        """END: the open route and the tape."""
        self._end_route()
        self.tape.end()

    def abort(self) -> None:
        """After an error: a stop if the wire is in the middle of a route."""
        if self.route is not None:
            self.tape.stop()
        self.forget()

    def forget(self) -> None:
        """The open route is given up, and there is none that RECUT could cut again."""
        self.route = self.curve = self.closed = None
