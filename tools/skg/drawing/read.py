"""Reading a drawing file: its contours in millimetres, and a report in which every entity is accounted for.

    reading = read(data, "part.dxf", Wishes(units="inch"))
    for contour in reading.contours: ...        # Contour: edges (lines, arcs, curves), is_closed, layers
    print("\\n".join(reading.report.lines()))

`read` is the one door for the commands; what it raises is a `UserError` that says what a person can do.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from dataclasses import dataclass, replace
from math import inf

from skg.drawing.account import Account, Content, Entity, LayerSum, OpenEnd, Overlap, counted, listed, short, shown
from skg.drawing.chain import chain, without_doubles
from skg.drawing.contour import Contour, Edge
from skg.errors import UserError
from skg.plane import XY, distance

#: mm in one unit of a file.
UNITS = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "inch": 25.4, "foot": 304.8, "mil": 0.0254, "um": 0.001}
#: A drawing that does not tell its units is in mm when its larger side has this many, mm.
USUAL = 1.0, 1500.0
#: `Account.units_from` of such a drawing.
NOT_TOLD = "the file does not say"
#: What becomes of open contours.
OPEN = ("cut", "leave", "refuse")


@dataclass(frozen=True)
class Wishes:
    """How a drawing is to be read.

    `layers`: only these (none: all that are neither off nor frozen). `start_layer`: that of the start holes. `units`:
    one of `UNITS`, None: what the file says. `tolerance`: ends no further apart are one corner, mm. `fit_tolerance`:
    how near FIT shall come to splines and ellipses, mm. `open`: one of `OPEN`, what becomes of open contours.
    """

    layers: tuple[str, ...] = ()
    start_layer: str = "START"
    units: str | None = None
    tolerance: float = 0.005
    fit_tolerance: float = 0.0002
    open: str = "cut"


@dataclass(frozen=True)
class Reading:
    """A drawing that was read: contours in the order of the file (mm), start holes (mm), and the report."""

    contours: list[Contour]
    starts: list[XY]
    report: Account


def read(data: bytes, name: str, wishes: Wishes | None = None) -> Reading:
    """Read a drawing file's bytes; `name` is the file's name, for messages and for its ending.

    A drawing without anything to cut, or one that is refused, is a `UserError` that begins with the name.
    """
    wishes = wishes or Wishes()
    try:
        return _read(data, name, wishes)
    except UserError as error:
        raise UserError(f"{name}: {str(error).removeprefix(f'{name}: ')}") from None


def _read(data: bytes, name: str, wishes: Wishes) -> Reading:
    content, report = _dxf(data, name, wishes)
    kept = without_doubles(content.edges, wishes.tolerance)
    _note_doubles(content, kept, report)
    if not kept:
        raise UserError(_nothing(content, wishes))
    contours = [_with_layers(contour, content) for contour in chain(kept, wishes.tolerance)]
    report.open_ends = _open_ends(contours, report.factor)
    if report.open_ends and wishes.open != "cut":
        contours = _without_open(contours, content, report, wishes)
    _measure(contours, report)
    _account(content.entities, report)
    if report.units_from == NOT_TOLD and not USUAL[0] <= max(report.size) <= USUAL[1]:
        width, height = map(short, report.size)
        raise UserError(
            f"the file does not say its units, and {width} x {height} mm is an odd size: "
            f"give --units ({', '.join(UNITS)})"
        )
    return Reading(contours, content.starts, report)


def layer_lines(data: bytes, name: str) -> list[str]:
    """What is on each layer of a drawing file, a line each."""
    from skg.drawing.dxf_file import load

    kinds: dict[str, Counter[str]] = defaultdict(Counter)
    for record in load(data).model:
        kinds[record.layer][record.kind] += 1
    return [f"{layer}: {listed(kinds[layer])}" for layer in sorted(kinds)]


def _dxf(data: bytes, name: str, wishes: Wishes) -> tuple[Content, Account]:
    """A DXF drawing's content, and an account that has its units."""
    from skg.drawing.dxf_file import load
    from skg.drawing.entities import collect

    file = load(data)
    units = (*file.units, "as the file says") if file.units else ("mm", 1.0, NOT_TOLD)
    if wishes.units:
        units = wishes.units, UNITS[wishes.units], "as asked for"
    report = Account(name, units[0], units[2], units[1], notes=file.notes)
    return collect(file, wishes.layers, wishes.start_layer, wishes.fit_tolerance, report.factor), report


def _in_file(place: XY, factor: float) -> XY:
    """A place in the file's own units."""
    return place[0] / factor, place[1] / factor


def _note_doubles(content: Content, kept: list[Edge], report: Account) -> None:
    """Account edges that were drawn twice; the entities that have no other edges are left."""
    still = {edge.entity for edge in kept}
    there = set(map(id, kept))
    for edge in content.edges:
        if id(edge) not in there:
            entity = content.entities[edge.entity]
            report.overlaps.append(Overlap("drawn twice", entity.layer, _in_file(edge.start, report.factor)))
            if edge.entity not in still:
                entity.left = "drawn twice"


def _nothing(content: Content, wishes: Wishes) -> str:
    """Why there is nothing to cut."""
    where = f" on {', '.join(wishes.layers)}" if wishes.layers else ""
    reasons = Counter(f"{entity.kind}: {entity.left}" for entity in content.entities)
    found = "; ".join(f"{count} {reason}" for reason, count in reasons.most_common(5))
    return f"no lines, arcs or curves to cut{where}" + (f" ({found})" if found else "")


def _with_layers(contour: Contour, content: Content) -> Contour:
    layers = dict.fromkeys(content.entities[edge.entity].layer for edge in contour.edges)
    return replace(contour, layers=tuple(layers))


def _open_ends(contours: list[Contour], factor: float) -> list[OpenEnd]:
    """Ends of open contours, each with the nearest other one."""
    ends = [place for one in contours if not one.is_closed for place in (one.edges[0].start, one.edges[-1].end)]
    found = []
    for at, place in enumerate(ends):
        gap, other = min(
            ((distance(place, other), other) for number, other in enumerate(ends) if number != at),
            default=(inf, None),
        )
        found.append(OpenEnd(_in_file(place, factor), other and _in_file(other, factor), gap))
    return found


def _without_open(contours: list[Contour], content: Content, report: Account, wishes: Wishes) -> list[Contour]:
    """The closed contours; with the wish "refuse" the open ones are a `UserError`."""
    if wishes.open == "refuse":
        nearest = min(report.open_ends, key=lambda end: end.gap)
        message = f"{counted(len(report.open_ends) // 2, 'contour')} open, the first end at {shown(nearest.place)}"
        if nearest.other is not None:
            message += f", {short(nearest.gap)} mm from that at {shown(nearest.other)}"
        raise UserError(f"{message}: a larger --tolerance joins ends, --open cut or leave tells what becomes of them")
    for contour in contours:
        if not contour.is_closed:
            for edge in contour.edges:
                content.entities[edge.entity].left = "of an open contour"
    return [contour for contour in contours if contour.is_closed]


def _measure(contours: list[Contour], report: Account) -> None:
    """Size, length and number of the contours."""
    points = [point for contour in contours for point in contour.points()]
    if points:
        report.low = min(x for x, _ in points), min(y for _, y in points)
        report.high = max(x for x, _ in points), max(y for _, y in points)
    report.closed = sum(contour.is_closed for contour in contours)
    report.open = len(contours) - report.closed
    report.length = sum(edge.length for contour in contours for edge in contour.edges)


def _account(entities: list[Entity], report: Account) -> None:
    """The sums of the layers; one that does not agree is a `UserError`."""
    sums: dict[str, LayerSum] = {}
    for entity in entities:
        layer = sums.setdefault(entity.layer, LayerSum(entity.layer))
        layer.read += 1
        if entity.left:
            layer.left += 1
            layer.why[entity.left][entity.kind] += 1
            if entity.is_odd:
                report.not_understood.append(entity)
        else:
            layer.cut += 1
    report.layers = sorted(sums.values(), key=lambda layer: layer.layer)
