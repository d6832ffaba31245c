"""The account of a drawing: every entity, cut or left and why, and the report in text."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from skg.geometry.contour import Edge
from skg.geometry.plane import XY
from skg.job.read_options import MEET
from skg.messages.finding import Finding
from skg.messages.render import line
from skg.wording import counted, report_line, short, shown

#: Why what only writes on a drawing, or fills what is drawn, is left.
NOTE = "nothing to cut"
#: Sources of a drawing's units.
TOLD, ASKED, NOT_TOLD = "as the file says", "as asked for", "the file does not say"
#: No gap that is wider than the wires are was meant to be closed, mm.
WIRE = 0.3
#: Joins with a line each.
_JOINS = 20
#: Places that a line of the report names before it says how many more there are.
_PLACES = 5


@dataclass(slots=True)
class Entity:
    """One entity of a file (those of a block as often as the block is inserted).

    `kind`: its name in the file, such as LWPOLYLINE or path; `place`: a place on it, mm.
    `left`: why it is not cut, or not all of it; empty while it is. `is_odd`: it is left because it was not understood,
    not because it is nothing to cut. `dashes`: the name of its line type where that is not drawn through.
    """

    kind: str
    layer: str
    place: XY
    left: str = ""
    is_odd: bool = False
    dashes: str = ""


@dataclass
class Content:
    """The content of a file: its entities, their edges in mm (each with the number of its entity), start points in mm,
    and what is to be said of them. `others`: the edges of what is left because of its layer."""

    entities: list[Entity] = field(default_factory=list)
    edges: list[Edge] = field(default_factory=list)
    others: list[Edge] = field(default_factory=list)
    starts: list[XY] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)


@dataclass
class LayerSum:
    """A layer's entities: how many were read, cut, cut in part and left; `why`: reason -> kinds of those left."""

    layer: str
    read: int = 0
    cut: int = 0
    part: int = 0
    left: int = 0
    why: dict[str, Counter[str]] = field(default_factory=lambda: defaultdict(Counter))


@dataclass(frozen=True)
class OpenEnd:
    """An end of an open contour: its place, that of the nearest other end, and the gap between them, mm; without
    another end None and infinity. A tolerance of the gap's width closes it, `can_join`: without making one point of any
    edge."""

    place: XY
    other: XY | None
    gap: float
    can_join: bool = False

    @property
    def advice(self) -> str:
        """Advice for closing the gap."""
        if self.can_join and self.gap <= WIRE:
            return f"--tolerance {above(self.gap)} joins them"
        why = "a wire" if self.gap > WIRE else "the shortest edge"
        return f"wider than {why}, so --tolerance is no help: close it in the drawing"


@dataclass(frozen=True)
class Mend:
    """A place where what is cut is not what is drawn, mm: within `size` of `place`. `kind`: "joined" (ends that do not
    meet), "short" (an edge too short for two corners), "past" (an end that runs past a corner), "twice" (an edge that
    lies beside the one that is cut)."""

    kind: str
    place: XY
    size: float


@dataclass(frozen=True)
class Overlap:
    """Two edges on each other. `kind`: "drawn twice", "overlap", "touch" or "cross"; `place` in mm."""

    kind: str
    layer: str
    place: XY


@dataclass
class Account:
    """The account of a drawing that was read.

    `units`: those it was read in; `units_from`: who said so. `factor`: mm in one unit of the file. `page`: the sides of
    an SVG's page in dots, if it does not tell its units. `low`, `high`: the box around the contours, mm. `layers`: the
    sums of all layers. `rest`: entities at junctions, of which (some of) the edges belong to no closed outline.
    `notes`, `findings`: what else there is to say. `mends`: where what is cut is not what is drawn; `whole`: numbers
    of the entities that are cut, all of each, and whether by what they are drawn on.
    """

    name: str
    units: str
    units_from: str
    factor: float
    low: XY = (0.0, 0.0)
    high: XY = (0.0, 0.0)
    closed: int = 0
    open: int = 0
    length: float = 0.0
    layers: list[LayerSum] = field(default_factory=list)
    open_ends: list[OpenEnd] = field(default_factory=list)
    not_understood: list[Entity] = field(default_factory=list)
    rest: list[Entity] = field(default_factory=list)
    overlaps: list[Overlap] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)
    page: XY | None = None
    mends: list[Mend] = field(default_factory=list)
    whole: dict[int, bool] = field(default_factory=dict)

    @property
    def size(self) -> XY:
        """Width and height of all contours, mm."""
        return self.high[0] - self.low[0], self.high[1] - self.low[1]

    def first_gap(self) -> str:
        """The narrowest gap between open ends."""
        nearest = min(self.open_ends, key=lambda end: end.gap)
        message = f"the first end at {shown(nearest.place)}"
        if nearest.other is None:
            return message
        return f"{message}, {short(nearest.gap)} mm from that at {shown(nearest.other)}; {nearest.advice}"

    def lines(self) -> list[str]:
        """The report as lines of text, without the file's name."""
        return [line(finding) for finding in self.told()]

    def told(self) -> list[Finding]:
        """The report, line by line, without the file's name."""
        width, height = self.size
        told_in = "" if self.factor == 1 else f"; places are told in mm, {self.factor:.6g} to one of these"
        size = f"{short(width)} x {short(height)} mm, read in {self.units} ({self.units_from}){told_in}"
        lines = [report_line(size, is_guess=self.units_from not in (TOLD, ASKED))]
        lines += [report_line(_of_layer(layer)) for layer in self.layers]
        kinds = [f"{self.closed} closed"] * bool(self.closed) + [f"{self.open} open"] * bool(self.open)
        count = counted(self.closed + self.open, "contour")
        lines.append(report_line(f"{count}: {', '.join(kinds)}; {short(self.length)} mm"))
        for end in self.open_ends[:_PLACES]:
            line = f"open end at {shown(end.place)}"
            if end.other is not None:
                line += f", {short(end.gap)} mm from {shown(end.other)}; {end.advice}"
            lines.append(report_line(line, place=end.place))
        lines += _more(self.open_ends, "open end")
        for entity in self.not_understood[:_PLACES]:
            line = f"not cut: {entity.kind} on layer {entity.layer} at {shown(entity.place)}: {entity.left}"
            lines.append(report_line(line, place=entity.place))
        lines += _more(self.not_understood, "entity not understood", "entities not understood")
        lines += _places("not cut, it belongs to no closed outline (--open all cuts it):", self.rest)
        for kind in ("drawn twice", "overlap", "cross", "touch"):
            lines += _overlaps(kind, [overlap for overlap in self.overlaps if overlap.kind == kind])
        return [*lines, *_mended(self.mends), *map(report_line, self.notes), *self.findings]


def said(entities: Iterable[Entity], nouns: tuple[str, str], description: str, then: str) -> Iterator[str]:
    """Describe odd entities and how they are cut, a line for each layer; `nouns`: singular and plural."""
    layers: dict[str, list[Entity]] = defaultdict(list)
    for entity in entities:
        layers[entity.layer].append(entity)
    for layer, group in sorted(layers.items()):
        yield f"{counted(len(group), *nouns)} on layer {layer} {description}, as at {shown(group[0].place)}: {then}"


def listed(kinds: dict[str, int]) -> str:
    """Kinds of entities with their numbers."""
    return ", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items()))


def above(gap: float) -> str:
    """A tolerance that a gap is surely within."""
    return f"{gap * 1.01 + 1e-4:.4g}"


def _mended(mends: Iterable[Mend]) -> list[Finding]:
    """Ends that were joined, a line each, and edges that are lost; what else is mended is told by notes."""
    joins = [mend for mend in mends if mend.kind == "joined"]
    lines = [Finding("ends-joined", place=join.place, gap=join.size) for join in joins[:_JOINS]]
    if more := joins[_JOINS:]:
        lines.append(Finding("more-joined", count=len(more), gap=max(join.size for join in more)))
    lost = (mend for mend in mends if mend.kind == "short" and mend.size > MEET)
    return lines + [Finding("edge-too-short", place=mend.place, length=mend.size) for mend in lost]


def _more(all_of_them: list, noun: str, nouns: str = "") -> list[Finding]:
    more = len(all_of_them) - _PLACES
    return [report_line(f"and {counted(more, f'more {noun}', f'more {nouns}' * bool(nouns))}")] * (more > 0)


def _of_layer(layer: LayerSum) -> str:
    parts = [f"{layer.cut} cut"] * bool(layer.cut) + [f"{layer.part} cut in part"] * bool(layer.part)
    parts += [f"{layer.left} left"] * bool(layer.left)
    line = f"layer {layer.layer}: {counted(layer.read, 'entity', 'entities')}, {', '.join(parts) or 'none cut'}"
    reasons = [f"{listed(kinds)} ({reason})" for reason, kinds in layer.why.items()]
    return line + (f": {', '.join(reasons)}" if reasons else "")


def _places(head: str, entities: Iterable[Entity]) -> list[Finding]:
    """Entities by layer and kind, with their places."""
    groups: dict[tuple[str, str], list[XY]] = defaultdict(list)
    for entity in entities:
        groups[entity.layer, entity.kind].append(entity.place)
    lines = []
    for (layer, kind), places in groups.items():
        more = f" and {len(places) - _PLACES} more" if len(places) > _PLACES else ""
        line = f"{head} {len(places)} {kind} on layer {layer} at {', '.join(map(shown, places[:_PLACES]))}{more}"
        lines.append(report_line(line, place=places[0]))
    return lines


def _overlaps(kind: str, overlaps: list[Overlap]) -> list[Finding]:
    groups: dict[str, list[XY]] = defaultdict(list)
    for overlap in overlaps:
        groups[overlap.layer].append(overlap.place)
    lines = []
    for layer, places in groups.items():
        more = f" and {len(places) - _PLACES} more" if len(places) > _PLACES else ""
        line = (
            f"{counted(len(places), 'place')} on layer {layer} where lines {kind}: "
            if kind != "drawn twice"
            else f"{counted(len(places), 'edge')} on layer {layer} drawn twice, cut once: "
        )
        lines.append(report_line(f"{line}{', '.join(map(shown, places[:_PLACES]))}{more}", place=places[0]))
    return lines
