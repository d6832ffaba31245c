"""Writing: the SKG program that cuts planned contours, written the way a person would write it.

A program has two forms. With line numbers it is stored and RUN; points that are used again have names, curves are nodes
in DATA lines. Without, each line is carried out as it is loaded: any length goes through any memory.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from math import degrees, pi, tan
from typing import NamedTuple

from skg.errors import UserError
from skg.geometry.contour import Edge
from skg.geometry.plane import XY, distance, polar, turn
from skg.messages.finding import Finding
from skg.planning.copies import Pattern
from skg.planning.planned import PlannedContour
from skg.planning.runs import Lead, Run

#: No line of the program is longer, its number included.
_WIDTH = 72
_LAST_LINE = 9999
#: Subscripts go up to here.
_LAST_NAME = 999
#: Neighbours whose directions differ by less (radians) are tangent to each other.
_TANGENT = 1e-5
#: An arc that a fillet would put elsewhere by more than this (mm) is written as a circle.
_FILLET_MISS = 1e-5


#: Kinds of edges, in the order in which a title has them.
_KINDS = ("LINE", "ARC", "CIRCLE", "CURVE")


def number(value: float) -> str:
    """Write a number as a program has it: at most six decimals, no needless zeros."""
    text = f"{value:.6f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def literal(point: XY) -> str:
    """Write a point as a program has it."""
    return f"({number(point[0])},{number(point[1])})"


class Step(NamedTuple):
    """A statement: its text, and at which place of the drawing (mm) it is, if at any."""

    text: str
    place: XY | None = None


class _Item(NamedTuple):
    """An item between two separators of a CUT: its text, the letter that its name may have, its place."""

    text: str
    letter: str
    place: XY


def _point(point: XY) -> _Item:
    return _Item(literal(point), "P", point)


def _circle(edge: Edge) -> _Item:
    """An arc's circle, clockwise with a negative radius."""
    assert edge.centre is not None, "a line has no circle"
    radius = edge.radius if edge.sweep > 0 else -edge.radius
    return _Item(f"{literal(edge.centre)}:{number(radius)}", "C", edge.at(0.5))


def _fillet(edges: tuple[Edge, ...], index: int) -> tuple[XY, float] | None:
    """The corner and radius of the arc after edge number `index`, where a fillet makes it, else None."""
    if index + 2 >= len(edges):
        return None
    before, arc, after = edges[index : index + 3]
    if not before.is_line or arc.centre is None or not after.is_line:
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


def _items(run: Run, fillets: bool) -> Iterator[_Item | Edge]:
    """Yield the items in the CUT statements of a run, from its first point on, and its curves."""
    edges = run.edges
    goes_back = run.is_closed and not run.out
    if goes_back and edges[0].is_circle:
        yield _circle(edges[0])
        return
    if not edges[0].nodes or run.into:
        yield _point(edges[0].start)
    # A contour that was entered in the middle of an edge ends with the rest of it: BACK goes along that to the entry.
    is_split = goes_back and not edges[0].nodes
    index = 0
    while index < len(edges):
        edge = edges[index]
        if edge.nodes:
            if index and edges[index - 1].nodes:
                # Two curves that follow each other are two runs of FIT with a statement between them.
                yield _point(edge.start)
            yield edge
            index += 1
            continue
        if edge.centre is not None:
            yield _circle(edge)
        if edge.is_circle:
            # (not the only thing in its route: the point on its far side makes it a whole one)
            yield _point(edge.at(0.5))
            yield _circle(edge)
        fillet = _fillet(edges, index) if fillets else None
        if fillet:
            corner, radius = fillet
            yield _point(corner)
            yield _Item(number(radius), "", corner)
            index += 2
            continue
        # A curve's first node is the corner before it, but a line between two curves must be written.
        is_between = edge.is_line and index and edges[index - 1].nodes
        is_last = index + 1 == len(edges)
        if (is_last and not is_split) or (not is_last and not edges[index + 1].nodes) or is_between:
            yield _point(edge.end)
        index += 1


def _into(lead: Lead, r: float) -> Iterator[float | _Item]:
    """From the start hole to the contour: straight pieces are the wire's own path, without an offset."""
    yield 0.0
    if lead.home:
        yield _point(lead.home)
    yield _point(lead.hole)
    if lead.is_arc:
        arc = lead.arc(True)
        yield _point(arc.start)
        yield r
        yield _circle(arc)
    yield _point(lead.entry)
    yield r


def _out(lead: Lead) -> Iterator[float | _Item]:
    if lead.is_arc:
        arc = lead.arc(False)
        yield _circle(arc)
        yield _point(arc.end)
    yield 0.0
    yield _point(lead.hole)
    if lead.home:
        yield _point(lead.home)


#: A part of a route: a statement (text), an offset from here on (a number), an item of a CUT, a curve.
RoutePart = str | float | _Item | Edge


def parts_of(planned: PlannedContour) -> Iterator[RoutePart]:
    """The route of a planned contour in parts."""
    here: XY | None = None
    for index, run in enumerate(planned.runs()):
        hole = run.into.threaded if run.into else planned.start
        if run.stop:
            yield f"REM STOP: {run.stop}"
        if not run.into:
            yield run.offset
        if index == 0 or run.stop:
            yield f"FROM {literal(hole)}"
            here = None
        parts = [
            *(_into(run.into, run.offset) if run.into else ()),
            *_items(run, planned.rung.has_fillets),
            *(_out(run.out) if run.out else ()),
        ]
        for part in parts:
            if isinstance(part, _Item) and part.letter == "P":
                if part.place == here:
                    continue
                here = part.place
            elif isinstance(part, Edge):
                # (the same point again ends this curve where another one follows)
                here = None
            yield part
        if run.is_closed and not run.out:
            yield "BACK"
            here = None


class _Elsewhere(NamedTuple):
    """The suffixes of a point, a circle and an angle in a part that is copied."""

    point: str = ""
    circle: str = ""
    angle: str = ""


#: In rows V is the way to the copy; around a place V is this, and D the turn.
_IN_ROWS, _AROUND = _Elsewhere("+V", "+V"), _Elsewhere("#(D:V)", "#(D:V)", "+D")


@dataclass
class _Writer:
    """The statements of a program, and the names in use. `names`: the items that are used again, none: no names."""

    is_stored: bool
    elsewhere: _Elsewhere = _Elsewhere()
    uses: Counter[tuple[str, str]] = field(default_factory=Counter)
    statements: list[Step] = field(default_factory=list)
    data: list[str] = field(default_factory=list)
    names: dict[tuple[str, str], str] = field(default_factory=dict)
    used: Counter[str] = field(default_factory=Counter)
    r: float | None = None

    def say(self, text: str, place: XY | None = None) -> None:
        """Add a statement."""
        self.statements.append(Step(text, place))

    def taken(self) -> list[Step]:
        """The statements there are, for the caller alone."""
        statements, self.statements = self.statements, []
        return statements

    def named(self, item: _Item) -> str:
        """The item's text in a CUT: the name of one that is used again, given on a line before where it is new."""
        key = item.letter, item.text
        if not item.letter:
            return item.text
        if self.uses[key] < 2:
            return self._placed(item)
        if key not in self.names:
            if self.used[item.letter] == _LAST_NAME:
                return self._placed(item)
            self.used[item.letter] += 1
            self.names[key] = f"{item.letter}{self.used[item.letter]}"
            self.say(f"{self.names[key]}={self._placed(item)}", item.place)
        return self.names[key]

    def _placed(self, item: _Item) -> str:
        """A point or a circle where the copy has it."""
        if item.letter == "P":
            return item.text + self.elsewhere.point
        if self.elsewhere.circle != "+V":
            return item.text + self.elsewhere.circle
        # (a circle is moved by its centre)
        centre, radius = item.text.rsplit(":", 1)
        return f"({centre}+V):{radius}"

    def write(self, title: str, pieces: Iterable[RoutePart]) -> None:
        """Write a route."""
        self.say(f"REM {title}")
        if not self.is_stored and self.r == 0:
            self.r = None
        is_first = True
        cut: list[tuple[str, XY]] = []
        for piece in pieces:
            if isinstance(piece, _Item):
                cut.append((self.named(piece), piece.place))
                continue
            if isinstance(piece, float):
                is_new = piece != self.r if self.r is not None else piece != 0
                if is_new or (is_first and not self.is_stored and piece):
                    self.cut(cut)
                    self.say(f"R={number(piece)}")
                    self.r = piece
                is_first = False
                continue
            self.cut(cut)
            if isinstance(piece, Edge):
                self.fit(piece)
            else:
                self.say(piece + self.elsewhere.point * piece.startswith("FROM"))
        self.cut(cut)

    def cut(self, items: list[tuple[str, XY]]) -> None:
        """Write elements as CUT statements, as many as they need."""
        line, place = "", (0.0, 0.0)
        for item, where in items:
            if line and len(line) + len(item) + len("9999 CUT ,") > _WIDTH:
                self.say(f"CUT {line}", place)
                line = ""
            place = place if line else where
            line += f",{item}" if line else item
        if line:
            self.say(f"CUT {line}", place)
        items.clear()

    def fit(self, edge: Edge) -> None:
        """Write a curve: a FIT for each node, or nodes in DATA lines at the program's end, fitted by a subroutine."""
        nodes = [f"{literal(node.point)},{number(degrees(turn(0, node.angle)))}" for node in edge.nodes]
        if not self.is_stored:
            for node, text in zip(edge.nodes, nodes, strict=True):
                self.say(f"FIT {text}", node.point)
            return
        for text in (f"REM CURVE OF {len(nodes)} NODES", f"I={len(nodes)}", "GOSUB *FIT"):
            self.say(text, edge.start)
        self.data += nodes


@dataclass
class Program:
    """A program that cuts contours; `title` goes into its first line, `parts_of` tells how each is written.
    `pattern`: the copies that they are, in order."""

    contours: list[PlannedContour]
    title: str
    parts_of: Callable[[PlannedContour], Iterable[RoutePart]] = parts_of
    pattern: Pattern | None = None

    def __post_init__(self) -> None:
        plain = re.sub(r"[^ -~]", "?", self.title.upper())[: _WIDTH - 30]
        self.head = Step(f"REM {plain}: {_count(len(self.contours), 'CONTOUR')}")

    def unnumbered(self) -> Iterator[list[Step]]:
        """The statements without line numbers: the title, a list for each contour, the end."""
        yield [self.head]
        writer = _Writer(False)
        for planned in self.contours:
            writer.write(_title(planned), self.parts_of(planned))
            yield writer.taken()
        yield [Step("END")]

    def numbered(self) -> str:
        """The program with line numbers; too many lines are a `UserError`. A part of which copies are cut is written
        once."""
        pattern = self.pattern if self.pattern and self.pattern.has(self.contours) else None
        contours = self.contours[: len(self.contours) // pattern.copies.count] if pattern else self.contours
        pieces = [list(self.parts_of(planned)) for planned in contours]
        elsewhere = _Elsewhere() if not pattern else _AROUND if pattern.copies.around > 1 else _IN_ROWS
        writer = _Writer(True, elsewhere)
        writer.uses.update(
            (piece.letter, piece.text) for items in pieces for piece in items if isinstance(piece, _Item)
        )
        for planned, items in zip(contours, pieces, strict=True):
            writer.write(_title(planned), items)
        body = [statement.text for statement in writer.statements]
        if pattern:
            restored = ["RESTORE"] * bool(writer.data)
            body = [*_copying(pattern), "END", "REM THE PART", "*PART", *restored, *body, "RETURN"]
        else:
            body.append("END")
        lines = [self.head.text, *body]
        if writer.data:
            lines += [
                "REM SUBROUTINE: I NODES WITH THE DIRECTION OF THEIR TANGENTS",
                "*FIT",
                "READ P,A",
                f"FIT P{elsewhere.point},A{elsewhere.angle}",
                "I=I-1",
                "IF I>0 GOTO *FIT",
                "RETURN",
                "REM NODES: PLACE, DIRECTION",
            ]
            lines += _data(writer.data)
        return _with_numbers(lines)


def _copying(pattern: Pattern) -> Iterator[str]:
    """The statements that have the part cut at each of its places."""
    copies = pattern.copies
    if copies.around > 1:
        yield f"REM {copies.around} COPIES AROUND V"
        yield f"V={literal(pattern.centre)}"
        yield from ("I1=0", "*COPY", f"D=I1*{_factor(copies.angle)}", "GOSUB *PART", "I1=I1+1")
        yield f"IF I1<{copies.around} GOTO *COPY"
        return
    x, y = copies.step or (0.0, 0.0)
    yield f"REM COPIES: {copies.columns} BESIDE EACH OTHER, {copies.rows} ABOVE"
    yield from ("J1=0", "*ROW", "I1=0", "*COPY", f"V=(I1*{_factor(x)},J1*{_factor(y)})", "GOSUB *PART", "I1=I1+1")
    yield f"IF I1<{copies.columns} GOTO *COPY"
    yield "J1=J1+1"
    yield f"IF J1<{copies.rows} GOTO *ROW"


def _factor(value: float) -> str:
    """A number behind a sign of multiplication."""
    return number(value) if value >= 0 else f"({number(value)})"


def _with_numbers(lines: list[str]) -> str:
    """The text of a program. A line that is a mark, such as *FIT, names the next one for the lines that end with it."""
    count = sum(not line.startswith("*") for line in lines)
    step = 10 if count * 10 <= _LAST_LINE else 1
    if count * step > _LAST_LINE:
        raise UserError(Finding("too-many-lines", lines=count, most=_LAST_LINE))
    marks: dict[str, int] = {}
    kept: list[str] = []
    for line in lines:
        if line.startswith("*"):
            marks[line] = (len(kept) + 1) * step
        else:
            kept.append(line)
    numbered = []
    for at, line in enumerate(kept, 1):
        begin, star, mark = line.rpartition(" *")
        target = marks.get(f"*{mark}") if star and (begin + " ").startswith(("GOSUB ", "IF ")) else None
        numbered.append(f"{at * step} {line if target is None else f'{begin} {target}'}\n")
    return "".join(numbered)


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


def _title(planned: PlannedContour) -> str:
    return f"{planned.turn}. {describe(planned)}"


def _kind(edge: Edge) -> str:
    """Return an edge's kind."""
    if edge.nodes:
        return "CURVE"
    if edge.centre is None:
        return "LINE"
    return "CIRCLE" if edge.is_circle else "ARC"


def describe(planned: PlannedContour) -> str:
    """Say what a contour is made of."""
    contour = planned.contour
    kinds = Counter(map(_kind, contour.edges))
    parts = ", ".join(_count(kinds[noun], noun) for noun in _KINDS if noun in kinds)
    if not contour.is_closed:
        return f"OPEN: {parts}"
    sense = "COUNTER-CLOCKWISE" if contour.area > 0 else "CLOCKWISE"
    return f"{'OPENING' if planned.is_opening else 'OUTLINE'}, {sense}: {parts}"


def writes_fillets(planned: PlannedContour) -> bool:
    """Tell whether an arc between lines of a contour is written as a fillet's radius."""
    runs = (run.edges for run in planned.runs())
    return planned.rung.has_fillets and any(
        _fillet(edges, index) is not None for edges in runs for index in range(len(edges))
    )
