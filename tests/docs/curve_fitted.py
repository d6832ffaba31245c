"""Fitted curves: what the FIT statements of a program make, by the reference, in 50 digits.

A curve is what one run of FIT statements makes, without R: arcs and lines (skg.ref.fit). Lengths are in mm on the tape.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from skg.ref import real
from skg.ref.cutter import MOST_ITEMS, Cutter
from skg.ref.fit import FittedCurve, Node
from skg.ref.geometry import enlarged, same_point
from skg.ref.interpreter import Interpreter
from skg.ref.mill.interpreter import MillInterpreter
from skg.ref.mill.iso import IsoPunch
from skg.ref.near import Watch
from skg.ref.real import ZERO, Real
from skg.ref.route import Route
from skg.ref.tape import Punch
from skg.ref.values import Circle, Point

#: Radius (mm) from which double precision, and so these modules, take a circle for a line.
LARGEST = Real("1e8")


@dataclass(frozen=True)
class FittedPiece:
    """An arc of a fitted curve, or a line (no circle)."""

    start: Point
    end: Point
    circle: Circle | None

    def heading(self, p: Point) -> Point:
        """Unit direction of travel at an end."""
        circle = self.circle
        v = self.end - self.start if circle is None else (p - circle.centre).left() * circle.r
        return v * (1 / v.length())

    def places(self, count: int) -> np.ndarray:
        """So many places on the piece, evenly spaced, both ends included, as complex numbers."""
        part = np.linspace(0, 1, count)
        start, end = complex(self.start.x, self.start.y), complex(self.end.x, self.end.y)
        if self.circle is None:
            return start + part * (end - start)
        centre = complex(self.circle.x, self.circle.y)
        sweep = np.angle((end - centre) / (start - centre))  # an arc of a biarc turns less than half round
        return centre + (start - centre) * np.exp(1j * part * sweep)


def any_arc(p: Point, t: Point, q: Point) -> Circle | None:
    """The arc from p to q that starts in the unit direction t, however flat it is."""
    w = q - p
    bulge = t.cross(w)
    r = w.dot(w) / (2 * bulge) if bulge else LARGEST
    if abs(r) >= LARGEST:
        return None
    centre = p + t.left() * r
    return Circle(centre.x, centre.y, r)


class Biarcs(FittedCurve):
    """The curve before flat arcs become their chords."""

    def _circle(self, p: Point, t: Point, q: Point) -> Circle | None:
        return any_arc(p, t, q)


class SeenCurve(FittedCurve):
    """The curve as it is cut. Counted while it is made: blocks, those of them that are chords of flat arcs, and the
    largest jump of the tangent before these became chords."""

    def __init__(self, feed: Callable[[Point | Circle, Real], None], tolerance: Real = ZERO) -> None:
        super().__init__(feed, tolerance)
        self.blocks = self.flat = 0
        self.sine = ZERO
        self.before: Point | None = None
        self.finished = False

    def finish(self) -> None:
        """No more nodes."""
        super().finish()
        self.finished = True

    def _circle(self, p: Point, t: Point, q: Point) -> Circle | None:
        circle = super()._circle(p, t, q)
        self.blocks += 1
        self.flat += circle is None
        piece = FittedPiece(p, q, circle or any_arc(p, t, q))
        if self.before is not None:
            self.sine = max(self.sine, abs(self.before.cross(piece.heading(p))))
        self.before = piece.heading(q)
        return circle

    @property
    def jump(self) -> float:
        """The largest angle (radians) between two arcs where they meet."""
        return float(real.mp.asin(self.sine))


@dataclass(frozen=True)
class Run:
    """One run of FIT statements: its nodes, the TOL (mm) that holds for it, and its curve as far as it was cut."""

    nodes: list[Node]
    tolerance: Real = ZERO
    cut: SeenCurve | None = None

    def seen(self) -> SeenCurve:
        """The curve, finished."""
        if self.cut is not None and self.cut.finished:
            return self.cut
        curve = SeenCurve(lambda _, __: None, self.tolerance)
        for node in self.nodes:
            curve.add(node)
        curve.finish()
        return curve


class _Dropped(list):
    """A list of what nobody asks for: it stays empty."""

    def append(self, value: object) -> None:
        """Keep nothing."""


class _Few(list):
    """The items of a route, as many as SYM, REP and RECUT take, and one: of all behind them only the last one."""

    def append(self, value: object) -> None:
        """Add an item behind all others, or in place of the last one."""
        if len(self) > MOST_ITEMS:
            self[-1] = value
        else:
            super().append(value)


class Recorder(Interpreter):
    """An interpreter that keeps every run of FIT statements, and nothing else: there may be a million blocks."""

    def __init__(self, punch: Punch | None = None) -> None:
        self.runs: list[Run] = []
        super().__init__((), Watch(), punch or Punch())
        self.tape.lines = _Dropped()

    def _new_cutter(self) -> Cutter:
        cutter = super()._new_cutter()
        cutter.path, new_route, cutter.new_curve = _Dropped(), cutter._new_route, SeenCurve

        def few_items() -> Route:
            route = new_route()
            route.items = _Few()
            return route

        cutter._new_route = few_items
        return cutter

    def _fit(self, node: Point, angle: Real | None) -> None:
        begins = self.cutter.curve is None
        super()._fit(node, angle)
        if begins:
            self.runs.append(Run([], self.cutter.tolerance, self.cutter.curve))
        tangent = None if angle is None else Point(real.cos(angle), real.sin(angle))
        nodes, place = self.runs[-1].nodes, enlarged(node, self.cutter.scale)
        # A node on the one before it is none (language.md, section 5).
        if not (nodes and same_point(nodes[-1].point, place)):
            nodes.append(Node(place, tangent, self.offset))


class MillRecorder(Recorder, MillInterpreter):
    """The same for milling programs."""

    def __init__(self) -> None:
        super().__init__(IsoPunch())


def fitted_runs(source: str, mills: bool = False) -> list[Run]:
    """The runs of FIT statements that a program makes; a program that ends in ERR is a UserError."""
    machine = MillRecorder() if mills else Recorder()
    error = machine.load(source) or machine.run()
    if error:
        number, line = error
        raise ValueError(f"the program ends in ERR {number:02d}" + (f" LINE {line}" if line is not None else ""))
    return machine.runs


def pieces(nodes: Iterable[Node], tolerance: Real = ZERO, kind: type[FittedCurve] = FittedCurve) -> list[FittedPiece]:
    """The blocks of a curve: the arcs and lines between the points that it is fed as."""
    fed: list[Point | Circle] = []
    curve = kind(lambda value, _: fed.append(value), tolerance)
    for node in nodes:
        curve.add(node)
    curve.finish()
    found: list[FittedPiece] = []
    start, circle = None, None
    for value in fed:
        if isinstance(value, Circle):
            circle = value
            continue
        if start is not None:
            found.append(FittedPiece(start, value, circle))
        start, circle = value, None
    return found
