"""`skg from-dxf`: an SKG program from a drawing, written the way a person would write it."""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from math import cos, inf, pi, sin, tan
from pathlib import Path

import click

from skg.drawing.read import (
    Contour,
    Edge,
    Point,
    chain,
    collect,
    cross,
    distance,
    in_degrees,
    load,
    minus,
    polar,
    turn,
    without_doubles,
)
from skg.errors import UserError
from skg.tape import block as tape
from skg.tape.gcode import Pair

#: No line of the program is longer, its number included.
_WIDTH = 72
_LAST_LINE = 9999
#: Subscripts go up to here.
_LAST_NAME = 999
#: Neighbours whose directions differ by less (radians) are tangent to each other.
_TANGENT = 1e-5
#: An arc that a fillet would put elsewhere by more than this (mm) is written as a circle.
_FILLET_MISS = 1e-5
#: A start hole is this far from the contour where there is room, mm.
_LEAD = 3.0


@dataclass(frozen=True)
class Route:
    """A contour with where it is entered: from `start` to the point at `part` of its first edge.

    `offset` is R: positive, the wire runs on the right of travel. `depth`: how many contours lie around it.
    """

    contour: Contour
    start: Point
    part: float
    offset: float
    depth: int

    @property
    def entry(self) -> Point:
        """Where the contour is entered (on its first edge, without the offset)."""
        return _at(self.contour.edges[0], self.part)


def number(value: float) -> str:
    """Write a number as a program has it: at most six decimals, no needless zeros."""
    text = f"{value:.6f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def literal(point: Point) -> str:
    """Write a point as a program has it."""
    return f"({number(point[0])},{number(point[1])})"


# Planning -------------------------------------------------------------------------------------------------

def _at(edge: Edge, part: float) -> Point:
    return edge.start if edge.nodes else edge.at(part)


def _oriented(contour: Contour, side: str, depth: int, offset: float, reverse: bool) -> tuple[Contour, float]:
    """Return the contour in the direction in which it is cut, and R."""
    if not contour.is_closed:
        sign = {"left": -1.0, "right": 1.0}.get(side, 0.0)
        return (contour.reversed(), -sign * offset) if reverse else (contour, sign * offset)
    # With the wire on the right of travel an outline is cut counter-clockwise and an opening clockwise.
    is_opening = depth % 2 == 1
    if side in ("inside", "outside"):
        is_opening = side == "inside"
    sign = {"on": 0.0, "left": -1.0}.get(side, 1.0)
    if (contour.area < 0) != is_opening:
        contour = contour.reversed()
    if reverse:
        contour, sign = contour.reversed(), -sign
    return contour, sign * offset


def _turned_to(contour: Contour, at: int) -> Contour:
    """The closed contour, beginning with another of its edges."""
    return Contour(contour.edges[at:] + contour.edges[:at], True)


def _entry_near(contour: Contour, start: Point, offset: float) -> tuple[Contour, float]:
    """Begin a closed contour where it is nearest to the start hole, but well inside an edge."""
    best = (inf, 0, 0.0)
    for at, edge in enumerate(contour.edges):
        if edge.nodes:
            continue
        margin = min(0.4, (2 * abs(offset) + 0.05) / edge.length)
        part = edge.nearest(start)
        if not edge.is_circle:
            part = min(1 - margin, max(margin, part))
        # A full circle is entered by a straight radial move; elsewhere any place of the edge will do.
        best = min(best, (distance(_at(edge, part), start), at, part))
    if best[0] == inf:
        return _entry_on_curve(contour)
    return _turned_to(contour, best[1]), best[2]


def _entry_on_curve(contour: Contour) -> tuple[Contour, float]:
    """Begin a contour of curves alone at a node inside its longest curve (a closed one at its seam)."""
    at = max(range(len(contour.edges)), key=lambda k: contour.edges[k].length)
    edge = contour.edges[at]
    is_smooth = len(contour.edges) == 1 and abs(turn(edge.nodes[0].angle, edge.nodes[-1].angle)) < 1e-3
    middle = len(edge.nodes) // 2
    if is_smooth or len(edge.nodes) < 3:
        return _turned_to(contour, at), 0.0
    point = edge.nodes[middle].point
    cut = min(range(len(edge.samples)), key=lambda k: distance(edge.samples[k], point))
    before = Edge(edge.start, point, nodes=edge.nodes[:middle + 1], samples=edge.samples[:cut + 1])
    after = Edge(point, edge.end, nodes=edge.nodes[middle:], samples=edge.samples[cut:])
    turned = _turned_to(contour, at).edges
    return Contour((after, *turned[1:], before), True), 0.0


def _entry(contour: Contour) -> tuple[Contour, float]:
    """Begin a closed contour in the middle of its longest line, else of its longest arc, else on a curve."""
    def rank(at: int) -> tuple[bool, float]:
        return contour.edges[at].is_line, contour.edges[at].length

    candidates = [at for at, edge in enumerate(contour.edges) if not edge.nodes]
    if not candidates:
        return _entry_on_curve(contour)
    at = max(candidates, key=rank)
    return _turned_to(contour, at), 0.0 if contour.edges[at].is_circle else 0.5


def _room(point: Point, angle: float, contours: list[Contour], least: float) -> float:
    """How far it is from a point in a direction to the next contour, mm; what is nearer than `least` is none."""
    way = cos(angle), sin(angle)
    nearest = inf
    for contour in contours:
        for p, q in pairwise(contour.points()):
            side = minus(q, p)
            area = cross(way, side)
            if abs(area) < 1e-12:
                continue
            to = minus(p, point)
            along, part = cross(to, side) / area, cross(to, way) / area
            if along > least and 0 <= part <= 1:
                nearest = min(nearest, along)
    return nearest


def _start_hole(contour: Contour, part: float, offset: float, is_opening: bool, lead: float,
                contours: list[Contour]) -> Point:
    """Choose a start hole square to the entry, on the wire's side: `lead` away, or in the middle of what room
    there is. An opening that is one circle is entered from its centre."""
    edge = contour.edges[0]
    entry = _at(edge, part)
    is_ccw = contour.area > 0
    is_outside = is_ccw == (offset > 0) if offset else not is_opening
    if edge.is_circle and not is_outside:
        return edge.centre
    way = edge.direction() if edge.nodes else edge.direction(part=part)
    square = way - pi / 2 if is_outside == is_ccw else way + pi / 2
    # An arc's own chords lie up to 0.1 % of its radius inside of it.
    least = 1e-3 * (1 + edge.radius) if edge.centre is not None else 1e-3
    room = _room(entry, square, contours, least)
    return polar(entry, min(lead + abs(offset), room / 2), square)


def plan(contours: list[Contour], starts: list[Point], offset: float, side: str, reverse: bool = False,
         lead: float = _LEAD) -> list[Route]:
    """Return the contours in the order in which they are cut: inner ones first, and then the nearest.

    Each start hole goes to the innermost contour around it that is cut from inside, else to the nearest one.
    """
    closed = [contour for contour in contours if contour.is_closed]
    depths = [sum(other is not one and other.holds(one.edges[0].start) for other in closed)
              for one in contours]
    ready = [_oriented(one, side, depth, offset, reverse)
             for one, depth in zip(contours, depths, strict=True)]
    given = _given_starts([contour for contour, _ in ready], depths, starts)
    routes = []
    for at, (contour, shift) in enumerate(ready):
        start = given.get(at)
        part = 0.0
        if not contour.is_closed:
            start = start or contour.edges[0].start
        elif start is None:
            contour, part = _entry(contour)
            start = _start_hole(contour, part, shift, depths[at] % 2 == 1, lead, contours)
        else:
            contour, part = _entry_near(contour, start, shift)
        routes.append(Route(contour, start, part, shift, depths[at]))
    ordered: list[Route] = []
    at_now = 0.0, 0.0
    while routes:
        nearest = min(routes, key=lambda route: (-route.depth, distance(route.start, at_now)))
        routes.remove(nearest)
        ordered.append(nearest)
        at_now = nearest.start
    return ordered


def _given_starts(contours: list[Contour], depths: list[int], starts: list[Point]) -> dict[int, Point]:
    """Which contour (by its number) each given start hole belongs to."""
    found: dict[int, Point] = {}
    for start in starts:
        around = [at for at, contour in enumerate(contours)
                  if at not in found and depths[at] % 2 and contour.is_closed and contour.holds(start)]
        free = [at for at in range(len(contours)) if at not in found]
        if not free:
            raise UserError(f"{len(starts)} start holes for {len(contours)} contours")
        if around:
            found[max(around, key=depths.__getitem__)] = start
        else:
            found[min(free, key=lambda at: min(distance(start, p) for p in contours[at].points()))] = start
    return found


# Writing --------------------------------------------------------------------------------------------------

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

    def point(self, point: Point) -> str:
        """Name a point."""
        return self.name("P", literal(point))

    def circle(self, edge: Edge) -> str:
        """Name an arc's circle, clockwise with a negative radius."""
        radius = edge.radius if edge.sweep > 0 else -edge.radius
        return self.name("C", f"{literal(edge.centre)}:{number(radius)}")

    def route(self, route: Route, title: str) -> None:
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

    def items(self, route: Route) -> Iterator[str | Edge]:
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

    def fillet(self, route: Route, at: int) -> tuple[Point, float] | None:
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
        angles = [in_degrees(node.angle) for node in edge.nodes]
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


def _listed(kinds: dict[str, int]) -> str:
    return ", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items()))


def _count(count: int, noun: str) -> str:
    return f"{count} {noun}{'S' if count > 1 else ''}"


def describe(route: Route) -> str:
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


def write(routes: list[Route], title: str, fillets: bool = True) -> str:
    """Return the program that cuts the routes; `title` goes into its first line."""
    writer = Writer(fillets)
    plain = re.sub(r"[^ -~]", "?", title.upper())[:_WIDTH - 30]
    writer.say(f"REM {plain}: {_count(len(routes), 'CONTOUR')}")
    for at, route in enumerate(routes, 1):
        writer.route(route, f"{at}. {describe(route)}")
    return writer.program()


@click.command(name="from-dxf")
@click.argument("file", type=click.Path(allow_dash=True))
@click.option("-o", "--output", default="-", show_default=True, type=click.Path(allow_dash=True),
              help="Program to write, - for the standard output.")
@click.option("--layer", "layers", multiple=True, help="Take only this layer; may be given again.")
@click.option("--list-layers", is_flag=True, help="Show the layers and what is on them, and write nothing.")
@click.option("--offset", default=0.0, metavar="MM", type=click.FloatRange(0),
              help="R: half the wire and its spark gap. Default: 0, the wire's middle runs on the contour.")
@click.option("--side", default="auto", show_default=True,
              type=click.Choice(("auto", "inside", "outside", "left", "right", "on")),
              help="Where the wire runs. auto: around outlines, within the openings in them.")
@click.option("--reverse", is_flag=True, help="Cut in the other direction (R changes its sign).")
@click.option("--start", "starts", multiple=True, type=Pair(),
              help="Start hole, mm; may be given again. Default: points on the layer START, else chosen.")
@click.option("--start-layer", default="START", show_default=True,
              help="Layer of the points for start holes.")
@click.option("--lead", default=_LEAD, show_default=True, metavar="MM",
              type=click.FloatRange(0, min_open=True),
              help="Distance of a chosen start hole from the contour, where there is room.")
@click.option("--tolerance", default=0.005, show_default=True, metavar="MM",
              type=click.FloatRange(0, min_open=True), help="Ends no further apart than this are one corner.")
@click.option("--fit-tolerance", default=0.0002, show_default=True, metavar="MM",
              type=click.FloatRange(1e-5), help="How near FIT shall come to splines and ellipses.")
@click.option("--units", type=click.Choice(("mm", "cm", "m", "inch")),
              help="Units of the drawing. Default: as the drawing says, else mm.")
@click.option("--no-fillets", is_flag=True, help="Write rounded corners as circles, not as fillet radii.")
def command(file: str, output: str, layers: tuple[str, ...], list_layers: bool, offset: float, side: str,
            reverse: bool, starts: tuple[Point, ...], start_layer: str, lead: float, tolerance: float,
            fit_tolerance: float, units: str | None, no_fillets: bool) -> None:
    """Write the SKG program that cuts a DXF drawing.

    Lines, arcs, circles, polylines with bulges, ellipses and splines are chained into contours; openings are
    cut before the outline around them, each from a start hole of its own and entered in the middle of an
    edge. FILE - is the standard input.
    """
    drawing = load(tape.read_bytes(file), file)
    if list_layers:
        kinds: dict[str, Counter[str]] = defaultdict(Counter)
        for entity in drawing.modelspace():
            kinds[entity.dxf.layer][entity.dxftype()] += 1
        for layer in sorted(kinds):
            click.echo(f"{layer}: {_listed(kinds[layer])}")
        return
    factor = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "inch": 25.4}.get(units)
    content = collect(drawing, layers, start_layer, fit_tolerance, factor)
    edges = without_doubles(content.edges, tolerance)
    if len(edges) < len(content.edges):
        click.echo(f"skg: {file}: {len(content.edges) - len(edges)} edges are drawn twice", err=True)
    if content.ignored:
        click.echo(f"skg: {file}: passed by {_listed(content.ignored)}", err=True)
    if not edges:
        where = f" on {', '.join(layers)}" if layers else ""
        raise UserError(f"{file}: no lines, arcs or curves to cut{where}")
    try:
        contours = chain(edges, tolerance)
        routes = plan(contours, list(starts) or content.starts, offset, side, reverse, lead)
    except UserError as error:
        raise UserError(f"{file}: {error}") from None
    title = "standard input" if file == "-" else Path(file).name
    tape.write_bytes(output, write(routes, title, not no_fillets).encode("ascii"))
