"""The tool: what the cutting statements do on a milling machine."""

from __future__ import annotations

from skg.ref.cutter import Cutter
from skg.ref.fault import Code, Fault
from skg.ref.geometry import enlarged
from skg.ref.mill.iso import IsoPunch
from skg.ref.real import NEARLY
from skg.ref.route import Route, Segment
from skg.ref.tape import grid
from skg.ref.values import Point


class MillCutter(Cutter):
    """The state between cutting statements. Where the tool is in the plane is what a wire's place is elsewhere."""

    tape: IsoPunch

    def _rapid(self, p: Point) -> None:
        """At the travel height to a place in mm on the tape."""
        self.tape.rapid(p)
        if (p - self.wire).length() > NEARLY:
            self.path.append(Segment(self.wire, p, "reposition", line=self.line))
        self.wire = p

    def position(self, p: Point) -> None:
        """FROM."""
        p = enlarged(p, self.scale)
        grid(p)
        self._end_route()
        self._rapid(p)
        self.from_point = p

    def _new_route(self) -> Route:
        """A route is entered from the FROM point, wherever the tool is."""
        return Route(self.from_point, self.from_point, self._emit)

    def _emit(self, segment: Segment) -> None:
        if segment.role == "entry":
            if self.tape.feed is None:
                raise Fault(Code.NO_VALUE)
            self._rapid(self.from_point)
            self.tape.lower()
        super()._emit(segment)

    def back(self) -> None:
        """BACK."""
        super().back()
        self.tape.up()

    def end(self) -> None:
        """END."""
        self._end_route()
        self.tape.up()
        self.tape.end()

    def drill(self, p: Point) -> None:
        """A point of HOLE."""
        self.refuse_in_route()
        if self.tape.cutting is None or self.tape.feed is None:
            raise Fault(Code.NO_VALUE)
        self.position(p)
        self.tape.lower()
        self.tape.up()
