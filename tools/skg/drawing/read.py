"""Reading a drawing file: its contours in millimetres, and a report in which every entity is accounted for.

    reading = read(data, "part.dxf", Wishes(units="inch"))
    for contour in reading.contours: ...        # Contour: edges (lines, arcs, curves), is_closed, layers
    print("\\n".join(reading.report.lines()))

`read` is the one door for the commands; what it raises is a `UserError` that says what a person can do.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass, replace
from math import floor, inf
from typing import TYPE_CHECKING

from skg.drawing.account import Account, Content, LayerSum, OpenEnd, Overlap, above, counted, listed, said, short, shown
from skg.drawing.chain import chain, merged
from skg.drawing.contour import Contour, Edge
from skg.drawing.wishes import OPEN, UNITS, Wishes
from skg.errors import UserError
from skg.plane import XY, distance, shifted

if TYPE_CHECKING:
    from skg.drawing.overrun import Overrun
    from skg.drawing.touching import Relations

__all__ = ["OPEN", "UNITS", "Reading", "Wishes", "layer_lines", "read"]

#: A drawing that does not tell its units is in mm when its larger side has this many, mm.
USUAL = 3.0, 10_000.0
#: A larger part hardly lies on a wire machine, mm.
LARGE = 1000.0
#: No drawing that is cut has a larger side, mm.
FARTHEST = 50_000.0
#: Who says what units a drawing is in.
TOLD, ASKED, NOT_TOLD = "as the file says", "as asked for", "the file does not say"
#: Ends of what is left that are no further apart may be meant to meet, mm.
_GAP = 0.1
#: What fills an area, without lines around it.
AREAS = ("HATCH", "MPOLYGON", "SOLID", "TRACE", "3DFACE", "MESH")
#: Why an edge is not cut.
SHORT, DOUBLE, JUNCTION = "shorter than the tolerance", "drawn twice", "at a junction, of no closed outline"
DASHED = "drawn with dashes, of no closed outline: --open all cuts it"
AXIS = "drawn with dashes, across outlines: --open all cuts it"
SMALL = "no room for the wire or the tab"
PAST = "runs past a corner"


@dataclass(frozen=True)
class Reading:
    """A drawing that was read: contours in the order of the file (mm), start holes (mm), and the report."""

    contours: list[Contour]
    starts: list[XY]
    report: Account


def read(data: bytes, name: str, wishes: Wishes | None = None, small: Collection[int] = ()) -> Reading:
    """Read a drawing file's bytes; `name` is the file's name, for messages and for its ending.

    `small`: numbers of contours, as they are read without it, that turned out to have no room for the wire: the report
    has them among what is left, and the contours are without them. A drawing without anything to cut, or one that is
    refused, is a `UserError` that begins with the name.
    """
    wishes = wishes or Wishes()
    try:
        return _read(data, name, wishes, small)
    except UserError as error:
        raise UserError(f"{name}: {error}") from None


def _read(data: bytes, name: str, wishes: Wishes, small: Collection[int]) -> Reading:
    from skg.drawing.overrun import without_overruns
    from skg.drawing.touching import relations

    content, report = _content(data, name, wishes)
    if not content.edges:
        raise UserError(_nothing(content, wishes))
    styles = [(entity.layer, entity.dashes) for entity in content.entities]
    chains = chain(content.edges, wishes.tolerance, styles)
    fates = _Fates(content, report.factor)
    if wishes.open != "all":
        chains, cuts = without_overruns(chains, wishes.tolerance, styles)
        fates.of_pieces([one.piece for one in cuts], PAST)
        report.notes += _past(cuts, content, report.factor)
    fates.of_edges(chains.short, SHORT)
    fates.of_edges(chains.doubles, DOUBLE)
    report.overlaps += [fates.overlap(DOUBLE, edge, edge.start) for edge in chains.doubles]
    contours, rest = chains.contours, chains.rest
    found = relations(contours + rest, wishes.tolerance)
    for at in found.repeated:
        repeated = (contours + rest)[at].edges
        fates.of_edges(repeated, DOUBLE)
        report.overlaps.append(fates.overlap(DOUBLE, repeated[0], repeated[0].start))
    axes = _axes(contours, found, fates) if wishes.open != "all" and not wishes.layers else set()
    for what, one, at, place in found.meetings:
        if at < len(contours) and not {one, at} & axes:
            report.overlaps.append(fates.overlap(what, contours[at].edges[0], place))
    if found.unseen:
        report.notes.append(f"{counted(found.unseen, 'more pair')} of contours meet")
    for at in sorted(axes):
        fates.of_edges(contours[at].edges, AXIS)
    gone = set(found.repeated) | axes
    hanging = {at for at in found.touched if at < len(contours)} - gone
    rest = [one for at, one in enumerate(rest, len(contours)) if at not in gone]
    rest += [contours[at] for at in sorted(hanging)]
    kept = [one for at, one in enumerate(contours) if at not in gone | hanging]
    if wishes.open == "cut" and rest and not kept:
        report.notes.append("no closed outline: what meets at junctions or crosses is cut as it is drawn")
        kept, rest = rest, []
    if wishes.open == "all":
        kept, rest = kept + rest, []
    elif not wishes.layers and any(one.is_closed and not fates.is_dashed(one) for one in kept):
        dashed = [one for one in kept if not one.is_closed and fates.is_dashed(one)]
        kept = [one for one in kept if one.is_closed or not fates.is_dashed(one)]
        for one in dashed:
            fates.of_edges(one.edges, DASHED)
    for run in rest:
        fates.of_edges(run.edges, JUNCTION)
    report.notes += _around(rest, kept, report.factor)
    report.notes += _gaps(rest, content.edges, wishes.tolerance, report.factor)
    if kept and report.units == "m" and report.units_from == TOLD:
        # (what a program writes that was not told any units; in mm more ends meet, and the small ones are counted so)
        _measure(kept, report)
        if max(report.size) > USUAL[1]:
            width, height = (short(side / UNITS["m"]) for side in report.size)
            found = _read(data, name, replace(wishes, units="mm"), small)
            found.report.units_from = f"the file says m, but {width} x {height} m is no part; --units says otherwise"
            return found
    opened = [one for one in kept if not one.is_closed]
    report.open_ends = _open_ends(opened, content.edges, wishes.tolerance, report.factor)
    if opened and wishes.open == "refuse":
        raise UserError(_refusal(report))
    if wishes.open == "leave":
        kept = [one for one in kept if one.is_closed]
        for one in opened:
            fates.of_edges(one.edges, "of an open contour")
    for at in small:
        fates.of_edges(kept[at].edges, SMALL)
    cut = [one for at, one in enumerate(kept) if at not in small]
    fates.account(cut, report)
    if not kept:
        raise UserError(_no_outline(report))
    # (the size, and with it where the drawing lies, is the same without the small ones)
    _measure(kept, report)
    contours = [replace(merged(one), layers=fates.layers(one)) for one in cut]
    _count(contours, report)
    _check_size(report)
    if max(map(abs, (*report.low, *report.high))) < FARTHEST:
        return Reading(contours, content.starts, report)
    # A map's coordinates: the ROM has no places that far.
    by = -floor(report.low[0]), -floor(report.low[1])
    report.notes.append(f"moved by {shown(by)} mm: the drawing lies too far from its origin for a tape")
    report.low, report.high = shifted(report.low, by), shifted(report.high, by)
    return Reading([one.shifted(by) for one in contours], [shifted(at, by) for at in content.starts], report)


def layer_lines(data: bytes, name: str) -> list[str]:
    """What is on each layer of a drawing file, a line each."""
    kinds: dict[str, Counter[str]] = defaultdict(Counter)
    for entity in _content(data, name, Wishes())[0].entities:
        kinds[entity.layer][entity.kind] += 1
    return [f"{layer}: {listed(kinds[layer])}" for layer in sorted(kinds)]


def _content(data: bytes, name: str, wishes: Wishes) -> tuple[Content, Account]:
    """What a file holds, and an account that has its units."""
    from skg.drawing import dxf_file, entities, svg

    if svg.is_svg(data, name):
        page = svg.SvgFile(data)
        told, px = page.units, svg.PX
        units = (told[0], told[1], TOLD) if told else ("px", page.guess, f"{NOT_TOLD}; {page.guessed}")
        if wishes.units:
            # Without a page in mm or inches a pixel is one of the units asked for.
            units = wishes.units, UNITS[wishes.units], ASKED
            px = UNITS[wishes.units] * (svg.PX / told[1] if told else 1.0)
        elif not told:
            px = page.guess
        report = Account(name, units[0], units[2], units[1])
        content = svg.collect(page, px, units[1], wishes)
        report.notes += content.notes
        return content, report
    file = dxf_file.load(data)
    unknown = f"{NOT_TOLD}; its $MEASUREMENT is that of inches" if file.is_imperial else NOT_TOLD
    units = (*file.units, TOLD) if file.units else ("mm", 1.0, unknown)
    if wishes.units:
        units = wishes.units, UNITS[wishes.units], ASKED
    report = Account(name, units[0], units[2], units[1], notes=file.notes)
    return entities.collect(file, wishes, units[1]), report


class _Fates:
    """What becomes of each entity's edges."""

    def __init__(self, content: Content, factor: float) -> None:
        self.entities = content.entities
        self.factor = factor
        self.parts = Counter(edge.entity for edge in content.edges)
        self.gone: dict[int, Counter[str]] = defaultdict(Counter)

    def of_edges(self, edges: Iterable[Edge], why: str) -> None:
        """Say why edges are not cut."""
        for edge in edges:
            self.gone[edge.entity][why] += 1

    def of_pieces(self, pieces: list[Edge], why: str) -> None:
        """Say why pieces are not cut that edges were divided into."""
        self.parts.update(piece.entity for piece in pieces)
        self.of_edges(pieces, why)

    def overlap(self, what: str, edge: Edge, place: XY) -> Overlap:
        """A line of the report."""
        return Overlap(what, self.entities[edge.entity].layer, in_file(place, self.factor))

    def layers(self, contour: Contour) -> tuple[str, ...]:
        """The layers of a contour's edges."""
        return tuple(dict.fromkeys(self.entities[edge.entity].layer for edge in contour.edges))

    def is_dashed(self, contour: Contour) -> bool:
        """Whether a contour is drawn with dashes, all of it: an axis, or what lies behind."""
        return all(self.entities[edge.entity].dashes for edge in contour.edges)

    def account(self, contours: list[Contour], report: Account) -> None:
        """Put the sums of the layers into the report; one that does not agree is a `UserError`."""
        cut = Counter(edge.entity for contour in contours for edge in contour.edges)
        sums: dict[str, LayerSum] = {}
        for at, entity in enumerate(self.entities):
            layer = sums.setdefault(entity.layer, LayerSum(entity.layer))
            layer.read += 1
            gone = self.gone[at]
            if cut[at] + gone.total() != self.parts[at] or not (self.parts[at] or entity.left):
                raise UserError(
                    f"{entity.kind} on layer {entity.layer} at {shown(entity.place)}: of its {self.parts[at]} parts "
                    f"{cut[at] + gone.total()} are accounted for; a mistake in skg, please report it"
                )
            # (what is short or drawn twice is cut with its neighbour, what runs past a corner is said by itself)
            lost = [why for why in gone if not cut[at] or why not in (SHORT, DOUBLE, PAST)]
            if not lost and not entity.left:
                layer.cut += 1
                continue
            entity.left = entity.left or " and ".join(lost)
            if cut[at]:
                layer.part += 1
            else:
                layer.left += 1
            layer.why[entity.left][entity.kind] += 1
            if JUNCTION in gone:
                report.rest.append(entity)
            elif entity.is_odd:
                report.not_understood.append(entity)
        report.layers = sorted(sums.values(), key=lambda layer: layer.layer)
        dashed = defaultdict(list)
        for at, entity in enumerate(self.entities):
            if cut[at] and entity.dashes:
                dashed[entity.dashes].append(entity)
        for name, some in dashed.items():
            report.notes += said(some, ("entity", "entities"), f"drawn with dashes ({name})", "cut as it is")


def _past(cuts: list[Overrun], content: Content, factor: float) -> Iterator[str]:
    """What is said of ends that run past corners, a line for each layer."""
    layers: dict[str, list[Overrun]] = defaultdict(list)
    for one in cuts:
        layers[content.entities[one.piece.entity].layer].append(one)
    for layer, some in sorted(layers.items()):
        longest = max(one.piece.length for one in some)
        yield (
            f"{counted(len(some), 'end')} on layer {layer} past a corner by up to {short(longest)} mm, as at "
            f"{shown(in_file(some[0].corner, factor))}: cut to the corner; --open all cuts all that is drawn"
        )


def _around(rest: list[Contour], kept: list[Contour], factor: float) -> Iterator[str]:
    """What is said when something that is left reaches around all contours that are cut, and is larger than each."""
    boxes = [_box(contour) for contour in kept]
    for run in rest if len(kept) > 1 else ():
        left, low, right, high = _box(run)
        if all(
            left <= (x + far_x) / 2 <= right and low <= (y + far_y) / 2 <= high
            and far_x - x < right - left and far_y - y < high - low
            for x, y, far_x, far_y in boxes
        ):  # fmt: skip
            ends = (shown(in_file(end, factor)) for end in (run.edges[0].start, run.edges[-1].end))
            yield (
                f"take care: what is left from {' to '.join(ends)} reaches around all that is cut: "
                "is it the outline, which should close there?"
            )
            return


def _gaps(rest: list[Contour], edges: list[Edge], tolerance: float, factor: float) -> Iterator[str]:
    """What is said of free ends in what is left that lie so near to a corner there that an outline may be open."""
    from skg.drawing.touching import nearest

    count = Counter(end for one in rest for edge in one.edges for end in (edge.start, edge.end))
    corners = list(count)
    near = [
        (distance(place, other), place)
        for place, other in zip(corners, nearest(corners), strict=True)
        if count[place] == 1 and other is not None
    ]
    shortest = _shortest(edges, tolerance)
    gaps = sorted((gap, place) for gap, place in near if gap <= _GAP and float(above(gap)) < shortest)
    if gaps:
        widest, place = gaps[-1]
        yield (
            f"{counted(len(gaps), 'end')} of what is left up to {short(widest)} mm from the next one, as at "
            f"{shown(in_file(place, factor))}: --tolerance {above(widest)} joins them"
        )


def _axes(contours: list[Contour], found: Relations, fates: _Fates) -> set[int]:
    """The closed contours drawn with dashes that cross others, which are not: circles that holes lie on."""
    pairs = [(one, at) for what, one, at, _ in found.meetings if what == "cross" and at < len(contours)]
    return {
        one
        for one, other in (*pairs, *((at, one) for one, at in pairs))
        if fates.is_dashed(contours[one]) and not fates.is_dashed(contours[other])
    }


def in_file(place: XY, factor: float) -> XY:
    """A place (mm) in the file's own units."""
    return place[0] / factor, place[1] / factor


def _nothing(content: Content, wishes: Wishes) -> str:
    """Why there is nothing to cut."""
    where = f" on {', '.join(wishes.layers)}" if wishes.layers else ""
    reasons = Counter(f"{entity.kind}: {entity.left}" for entity in content.entities)
    found = "; ".join(f"{count} {reason}" for reason, count in reasons.most_common(5))
    unseen = sorted({entity.layer for entity in content.entities if entity.left.startswith("the layer is")})
    help_ = f": --layer {unseen[0]} takes what is on that layer" if unseen and not wishes.layers else ""
    if not help_ and any(entity.kind in AREAS for entity in content.entities):
        help_ = ": draw outlines around the areas in the CAD program"
    return f"no lines, arcs or curves to cut{where}" + (f" ({found})" if found else "") + help_


def _no_outline(report: Account) -> str:
    """Why no contour is left."""
    if not report.rest:
        return f"no closed outline, {_first_gap(report)}"
    places = ", ".join(shown(entity.place) for entity in report.rest[:3])
    return (
        f"no closed outline: {counted(len(report.rest), 'entity', 'entities')} meet at junctions or cross, "
        f"as at {places}: --open all cuts them as they are"
    )


def _refusal(report: Account) -> str:
    count = counted(len(report.open_ends) // 2, "open contour")
    return f"{count}, {_first_gap(report)}, or --open cut or leave tells what becomes of it"


def _first_gap(report: Account) -> str:
    """The narrowest gap."""
    nearest = min(report.open_ends, key=lambda end: end.gap)
    message = f"the first end at {shown(nearest.place)}"
    if nearest.other is None:
        return message
    return f"{message}, {short(nearest.gap)} mm from that at {shown(nearest.other)}; {nearest.advice}"


def _open_ends(contours: list[Contour], edges: list[Edge], tolerance: float, factor: float) -> list[OpenEnd]:
    """Ends of open contours, each with the nearest other one; `edges`: all of the drawing."""
    from skg.drawing.touching import nearest

    ends = [place for one in contours for place in (one.edges[0].start, one.edges[-1].end)]
    if not ends:
        return []
    shortest = _shortest(edges, tolerance)
    found = []
    for place, other in zip(ends, nearest(ends), strict=True):
        if other is None:
            found.append(OpenEnd(in_file(place, factor), None, inf))
            continue
        gap = distance(place, other)
        can_join = float(above(gap)) < shortest
        found.append(OpenEnd(in_file(place, factor), in_file(other, factor), gap, can_join))
    return found


def _shortest(edges: list[Edge], tolerance: float) -> float:
    """How wide a tolerance may be that makes one point of no edge; those shorter than `tolerance` are lost already."""
    wide = (distance(edge.start, edge.end) for edge in edges)
    return min((chord for chord in wide if chord > tolerance), default=inf)


def _box(contour: Contour) -> tuple[float, float, float, float]:
    """Smallest x and y, largest x and y of a contour."""
    xs, ys = zip(*(place for edge in contour.edges for place in edge.extremes()), strict=True)
    return min(xs), min(ys), max(xs), max(ys)


def _measure(contours: list[Contour], report: Account) -> None:
    """The box around the contours."""
    boxes = [_box(contour) for contour in contours]
    report.low = min(box[0] for box in boxes), min(box[1] for box in boxes)
    report.high = max(box[2] for box in boxes), max(box[3] for box in boxes)


def _count(contours: list[Contour], report: Account) -> None:
    """Number and length of the contours."""
    report.closed = sum(contour.is_closed for contour in contours)
    report.open = len(contours) - report.closed
    report.length = sum(edge.length for contour in contours for edge in contour.edges)


def _check_size(report: Account) -> None:
    """Refuse an odd size that nobody vouches for, and what is too large for a tape."""
    width, height = map(short, report.size)
    if report.units_from.startswith(NOT_TOLD) and not USUAL[0] <= max(report.size) <= USUAL[1]:
        raise UserError(
            f"the file does not say its units, and {width} x {height} mm is an odd size: "
            f"give --units ({', '.join(UNITS)}){_in_other_units(report)}"
        )
    if max(report.size) >= FARTHEST:
        raise UserError(
            f"{width} x {height} mm, read in {report.units}: a tape has room for 100 m; "
            f"give --units{_in_other_units(report)}"
        )
    other = _in_other_units(report, LARGE)
    if report.units_from == TOLD and other and not USUAL[0] <= max(report.size) <= LARGE:
        # (programs write the units that they were last set to)
        report.notes.append(f"take care: {width} x {height} mm is an odd size{other}: --units says so")


def _in_other_units(report: Account, most: float = USUAL[1]) -> str:
    """The size that a drawing has in units that make it a usual one, of `most` mm."""
    found = []
    for name in ("mm", "inch", "cm"):
        width, height = (side / report.factor * UNITS[name] for side in report.size)
        if name != report.units and USUAL[0] <= max(width, height) <= most:
            found.append(f"{short(width)} x {short(height)} mm in {name}")
    return f"; it would be {', '.join(found)}" if found else ""
