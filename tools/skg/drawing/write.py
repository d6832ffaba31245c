"""Writing: the SKG program that cuts planned contours, written the way a person would write it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from math import degrees, pi, tan

from skg.drawing.contour import Edge
from skg.drawing.plan import PlannedContour
from skg.errors import UserError
from skg.plane import XY, distance, polar, turn

#: No line of the program is longer, its number included.
_WIDTH = 72
_LAST_LINE = 9999
#: Subscripts go up to here.
_LAST_NAME = 999
#: Neighbours whose directions differ by less (radians) are tangent to each other.
_TANGENT = 1e-5
#: An arc that a fillet would put elsewhere by more than this (mm) is written as a circle.
_FILLET_MISS = 1e-5


def number(value: float) -> str:
    """Write a number as a program has it: at most six decimals, no needless zeros."""
    text = f"{value:.6f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def literal(point: XY) -> str:
    """Write a point as a program has it."""
    return f"({number(point[0])},{number(point[1])})"


@dataclass
class Writer:
    """The statements of a program, and the names in use."""

    fillets: bool = True
    statements: list[str] = field(default_factory=list)
    data: list[str] = field(default_factory=list)
    names: dict[tuple[str, str], str] = field(default_factory=dict)
    used: dict[str, int] = field(default_factory=dict)
    r: float | None = None

    def say(self, *statements: str) -> None:
        """Add statements."""
        self.statements += statements

    def name(self, letter: str, value: str) -> str:
        """Return a name for a value, given on a line before where it is new; the value itself when all names
        of its letter are taken."""
        if (letter, value) not in self.names:
            taken = self.used.get(letter, 0) + 1
            if taken > _LAST_NAME:
                return value if letter == "P" else f"({value})"
            self.used[letter] = taken
            self.names[letter, value] = f"{letter}{taken}"
            self.say(f"{letter}{taken}={value}")
        return self.names[letter, value]

    def point(self, point: XY) -> str:
        """Name a point."""
        return self.name("P", literal(point))

    def circle(self, edge: Edge) -> str:
        """Name an arc's circle, clockwise with a negative radius."""
        radius = edge.radius if edge.sweep > 0 else -edge.radius
        return self.name("C", f"{literal(edge.centre)}:{number(radius)}")

    def route(self, route: PlannedContour, title: str) -> None:
        """Write a contour."""
        self.say(f"REM {title}")
        if self.r is None and not route.offset:
            pass
        elif route.offset != self.r:
            self.say(f"R={number(route.offset)}")
            self.r = route.offset
        first = len(self.statements)
        items = list(self.items(route))
        names = self.statements[first:]
        del self.statements[first:]
        self.say(*names, f"FROM {literal(route.start)}")
        cut: list[str] = []
        for item in [*items, None]:
            if isinstance(item, str):
                cut.append(item)
                continue
            self.cut(cut)
            cut = []
            if item is not None:
                self.fit(item)
        if route.contour.is_closed:
            self.say("BACK")

    def items(self, route: PlannedContour) -> Iterator[str | Edge]:
        """Yield what stands in the CUT statements of a route, and its curves."""
        edges = route.contour.edges
        if edges[0].is_circle:
            yield self.circle(edges[0])
            return
        if not edges[0].nodes:
            yield self.point(route.entry)
        at = 0
        while at < len(edges):
            edge = edges[at]
            if edge.nodes:
                if at and edges[at - 1].nodes:
                    # Two curves that follow each other are two runs of FIT with a statement between them.
                    yield self.point(edge.start)
                yield edge
                at += 1
                continue
            if edge.centre is not None:
                yield self.circle(edge)
            fillet = self.fillet(route, at)
            if fillet:
                corner, radius = fillet
                yield self.point(corner)
                yield number(radius)
                at += 2
                continue
            # A curve's first node is the corner before it, but a line between two curves must be written.
            is_between = edge.is_line and at and edges[at - 1].nodes
            if at + 1 == len(edges) or not edges[at + 1].nodes or is_between:
                yield self.point(edge.end)
            at += 1
        if route.contour.is_closed and edges[0].centre is not None:
            # Between a last point and a first one BACK would bring in a line: the rest of the first arc stands here.
            yield self.circle(edges[0])

    def fillet(self, route: PlannedContour, at: int) -> tuple[XY, float] | None:
        """The corner and radius of the arc after edge number `at`, where a fillet makes it, else None."""
        edges = route.contour.edges
        following = at + 2
        last = len(edges) + (1 if route.contour.is_closed else 0)
        if not self.fillets or at + 1 >= len(edges) or following >= last:
            return None
        before, arc, after = edges[at], edges[at + 1], edges[following % len(edges)]
        if not before.is_line or arc.centre is None or not after.is_line or len(edges) < 3:
            return None
        bend = turn(before.direction(), after.direction())
        if abs(bend) > 2.8 or abs(bend) < 0.01 or abs(bend - arc.sweep) > _TANGENT:
            return None
        if abs(turn(before.direction(), arc.direction())) > _TANGENT:
            return None
        reach = arc.radius * tan(abs(bend) / 2)
        corner = polar(arc.start, reach, before.direction())
        other = polar(arc.end, reach, after.direction() + pi)
        return (corner, arc.radius) if distance(corner, other) < _FILLET_MISS else None

    def cut(self, items: list[str]) -> None:
        """Write elements as CUT statements, as many as they need."""
        line = ""
        for item in items:
            if line and len(line) + len(item) + len("9999 CUT ,") > _WIDTH:
                self.say(f"CUT {line}")
                line = ""
            line += f",{item}" if line else item
        if line:
            self.say(f"CUT {line}")

    def fit(self, edge: Edge) -> None:
        """Write a curve: its nodes go to DATA lines at the program's end, a subroutine fits them."""
        self.say(f"REM CURVE OF {len(edge.nodes)} NODES", f"I={len(edge.nodes)}", "GOSUB *")
        angles = [degrees(turn(0, node.angle)) for node in edge.nodes]
        self.data += [f"{literal(node.point)},{number(angle)}"
                      for node, angle in zip(edge.nodes, angles, strict=True)]

    def program(self) -> str:
        """Return the numbered program; too many lines are a `UserError`."""
        lines = [*self.statements, "END"]
        subroutine = len(lines)
        if self.data:
            lines += ["REM SUBROUTINE: I NODES WITH THE DIRECTION OF THEIR TANGENTS", "READ P,A", "FIT P,A",
                      "I=I-1", "IF I>0 GOTO *", "RETURN", "REM NODES: PLACE, DIRECTION"]
            lines += _data(self.data)
        step = 10 if len(lines) * 10 <= _LAST_LINE else 1
        if len(lines) * step > _LAST_LINE:
            raise UserError(f"the program would have {len(lines)} lines, at most {_LAST_LINE} fit; "
                            "a larger --fit-tolerance makes fewer nodes")
        target = str((subroutine + 2) * step)
        return "".join(f"{at * step} {_pointed(line, target)}\n" for at, line in enumerate(lines, 1))


def _pointed(line: str, target: str) -> str:
    """Fill in the line number of the subroutine."""
    return line[:-1] + target if line.startswith(("GOSUB *", "IF I>0 GOTO *")) else line


def _data(items: list[str]) -> Iterator[str]:
    line = ""
    for item in items:
        if line and len(line) + len(item) + len("9999 DATA ,") > _WIDTH:
            yield f"DATA {line}"
            line = ""
        line += f",{item}" if line else item
    yield f"DATA {line}"


def _count(count: int, noun: str) -> str:
    return f"{count} {noun}{'S' if count > 1 else ''}"


def describe(route: PlannedContour) -> str:
    """Say what a contour is made of."""
    contour = route.contour
    kinds = [("LINE", sum(edge.is_line for edge in contour.edges)),
             ("ARC", sum(edge.centre is not None and not edge.is_circle for edge in contour.edges)),
             ("CIRCLE", sum(edge.is_circle for edge in contour.edges)),
             ("CURVE", sum(bool(edge.nodes) for edge in contour.edges))]
    parts = ", ".join(_count(count, noun) for noun, count in kinds if count)
    if not contour.is_closed:
        return f"OPEN: {parts}"
    way = "COUNTER-CLOCKWISE" if contour.area > 0 else "CLOCKWISE"
    return f"{'OPENING' if route.depth % 2 else 'OUTLINE'}, {way}: {parts}"


def write(routes: list[PlannedContour], title: str, fillets: bool = True) -> str:
    """Return the program that cuts the routes; `title` goes into its first line."""
    writer = Writer(fillets)
    plain = re.sub(r"[^ -~]", "?", title.upper())[:_WIDTH - 30]
    writer.say(f"REM {plain}: {_count(len(routes), 'CONTOUR')}")
    for at, route in enumerate(routes, 1):
        writer.route(route, f"{at}. {describe(route)}")
    return writer.program()
