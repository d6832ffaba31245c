"""The contours that a program draws, and the wire's path beside them: the same program run without R and with it."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

from skg.ref.cutter import Cutter
from skg.ref.interpreter import Interpreter, Result, carry_out
from skg.ref.mill.cutter import MillCutter
from skg.ref.mill.interpreter import MillInterpreter
from skg.ref.mill.iso import IsoPunch
from skg.ref.near import Watch
from skg.ref.real import ZERO, Real
from skg.ref.route import Route, Segment
from skg.ref.tape import Punch
from skg.ref.values import Circle, Line, Point

#: The segments of each route, from its entry to its return.
Routes = list[list[Segment]]


class _Recorded(Cutter):
    """A cutter that keeps the segments of each route in `routes`. `is_drawn`: R is 0, whatever the program says."""

    routes: Routes
    is_drawn: bool

    def _new_route(self) -> Route:
        self.routes.append([])
        return super()._new_route()

    def _emit(self, segment: Segment) -> None:
        super()._emit(segment)
        if self.route is not None:
            self.routes[-1].append(replace(segment, line=self.line))

    def _r(self, offset: Real) -> Real:
        return ZERO if self.is_drawn else offset

    def _feed(self, value: Point | Circle | Line, offset: Real, right: bool = False) -> None:
        super()._feed(value, self._r(offset), right)

    def mirror(self, mirror: Line, right: bool, offset: Real) -> None:
        """SYM."""
        super().mirror(mirror, right, self._r(offset))

    def repeat(self, count: int, angle: Real, about: Point, right: bool, offset: Real) -> None:
        """REP."""
        super().repeat(count, angle, about, right, self._r(offset))

    def recut(self, offset: Real) -> None:
        """RECUT."""
        super().recut(self._r(offset))


class _RecordedMill(_Recorded, MillCutter):
    """The same of a milling machine's tool."""


_Made = TypeVar("_Made", bound=_Recorded)


def routes_of(program: str, runs: bool, mills: bool = False, is_drawn: bool = False) -> tuple[Routes, Result]:
    """Return the routes of a program, without R when they are to be as drawn, and its result.

    `runs`: the program is RUN once it is loaded. `mills`: it is one of the milling language.
    """
    routes: Routes = []

    def told(made: _Made) -> _Made:
        made.routes, made.is_drawn = routes, is_drawn
        return made

    class Recording(Interpreter):
        def _new_cutter(self) -> Cutter:
            return told(_Recorded(self.tape, self.path))

    class RecordingMill(MillInterpreter):
        def _new_cutter(self) -> MillCutter:
            return told(_RecordedMill(self.tape, self.path))

    def machine(watch: Watch) -> Interpreter:
        return RecordingMill((), watch, IsoPunch()) if mills else Recording((), watch, Punch())

    result = carry_out(machine, program, None, runs)
    return routes, result
