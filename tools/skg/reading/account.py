"""The account of a drawing: every entity, cut or left and why, and the report in text."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any

from skg.geometry.contour import Edge
from skg.geometry.plane import XY
from skg.job.read_options import MEET
from skg.messages.finding import Finding, Phrase, beyond

#: Why what only writes on a drawing, or fills what is drawn, is left.
NOTE = Phrase("reason-nothing-to-cut")
#: Sources of a drawing's units.
TOLD, ASKED, NOT_TOLD, ODD_METRES = "units-told", "units-asked", "units-not-told", "units-odd-metres"
#: No gap that is wider than the wires are was meant to be closed, mm.
WIRE = 0.3
#: Joins with a line each.
_JOINS = 20
#: Kinds of overlaps -> their findings, in the order of the report.
TWICE = "drawn twice"
_OVERLAPS = {TWICE: "lines-twice", "overlap": "lines-overlap", "cross": "lines-cross", "touch": "lines-touch"}
#: Places that a line of the report names before it says how many more there are.
_PLACES = 5


@dataclass(slots=True)
class Entity:
    """One entity of a file (those of a block as often as the block is inserted).

    `kind`: its name in the file, such as LWPOLYLINE or path; `place`: a place on it, mm.
    `reason`: why it is not cut, or not all of it; None while it is. `is_odd`: it is left because it was not understood,
    not because it is nothing to cut. `dashes`: the name of its line type where that is not drawn through.
    """

    kind: str
    layer: str
    place: XY
    reason: Phrase | None = None
    is_odd: bool = False
    dashes: str = ""


@dataclass(frozen=True)
class Written:
    """A text on a drawing: where it begins, and the way up as far as a capital is high, mm."""

    text: str
    place: XY
    up: XY


@dataclass
class Noted:
    """Lines of what is nothing to cut, for who looks at the drawing: of dimensions, and around what is filled. `edges`,
    mm; `fills`: give more of them, which takes its time; `by`: how far all of it is moved."""

    edges: list[Edge] = field(default_factory=list)
    fills: list[Callable[[], Iterable[Edge]]] = field(default_factory=list)
    by: XY = (0.0, 0.0)

    def every(self) -> Iterator[Edge]:
        """All of them."""
        for edge in (*self.edges, *(edge for fill in self.fills for edge in fill())):
            yield edge if self.by == (0.0, 0.0) else edge.shifted(self.by)


@dataclass
class Content:
    """The content of a file: its entities, their edges in mm (each with the number of its entity), start points in mm,
    and what is to be said of them. `others`: the edges of what is left because of its layer; `written`: texts; `noted`:
    lines of what is nothing to cut."""

    entities: list[Entity] = field(default_factory=list)
    edges: list[Edge] = field(default_factory=list)
    others: list[Edge] = field(default_factory=list)
    starts: list[XY] = field(default_factory=list)
    written: list[Written] = field(default_factory=list)
    noted: Noted = field(default_factory=Noted)
    notes: list[Finding] = field(default_factory=list)


@dataclass
class LayerSum:
    """A layer's entities: how many were read, cut, cut in part and left; `why`: reason -> kinds of those left."""

    layer: str
    read: int = 0
    cut: int = 0
    part: int = 0
    skipped: int = 0
    why: dict[Phrase, Counter[str]] = field(default_factory=lambda: defaultdict(Counter))


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
    def advice(self) -> Phrase:
        """Advice for closing the gap."""
        if self.can_join and self.gap <= WIRE:
            return Phrase("tolerance-joins", gap=above(self.gap))
        return Phrase("gap-wider-than-wire" if self.gap > WIRE else "gap-wider-than-edge")


@dataclass(frozen=True)
class Mend:
    """A place where what is cut is not what is drawn, mm: within `size` of `place`. `kind`: "joined" (ends that do not
    meet), "short" (an edge too short for two corners), "past" (an end that runs past a corner), "twice" (an edge that
    lies beside the one that is cut)."""

    kind: str
    place: XY
    size: float


@dataclass(frozen=True)
class Repair:
    """Something that may be asked for to close outlines, see `skg.reading.repairs`. `places`: the ends that it is
    about, mm; `asked`: what the options have of it, places in the file; `size`: the line that is put in, how much
    longer or shorter an edge becomes at most, the length of what is left, mm."""

    kind: str
    places: tuple[XY, XY]
    asked: tuple[float, ...]
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

    `units`: those it was read in; `units_from`: the code of who said so, with `units_values`; `units_more`: what was
    guessed beside that. `factor`: mm in one unit of the file. `page`: the sides of an SVG's page in dots, if it does
    not tell its units. `low`, `high`: the box around the contours, mm. `layers`: the sums of all layers. `rest`:
    entities at junctions, of which (some of) the edges belong to no closed outline. `findings`: what else there is to
    say. `mends`: where what is cut is not what is drawn; `repairs`: what could be asked for; `whole`: numbers
    of the entities that are cut, all of each, and whether by what they are drawn on.
    """

    name: str
    units: str
    units_from: str
    factor: float
    units_more: Phrase | None = None
    units_values: dict[str, float] = field(default_factory=dict)
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
    findings: list[Finding] = field(default_factory=list)
    page: XY | None = None
    mends: list[Mend] = field(default_factory=list)
    repairs: list[Repair] = field(default_factory=list)
    whole: dict[int, bool] = field(default_factory=dict)

    @property
    def size(self) -> XY:
        """Width and height of all contours, mm."""
        return self.high[0] - self.low[0], self.high[1] - self.low[1]

    @property
    def told(self) -> Phrase:
        """Who said what units these are."""
        return Phrase(self.units_from, more=self.units_more, **self.units_values)

    def first_gap(self) -> Phrase:
        """The narrowest gap between open ends."""
        nearest = min(self.open_ends, key=lambda end: end.gap)
        if nearest.other is None:
            return Phrase("first-gap-alone", place=nearest.place)
        about = {"place": nearest.place, "other": nearest.other}
        return Phrase("first-gap", gap=nearest.gap, advice=nearest.advice, **about)

    def report(self) -> list[Finding]:
        """The report, without the file's name."""
        report = [_size(self), *map(_of_layer, self.layers)]
        kinds = [Phrase("count-closed", count=self.closed)] * bool(self.closed)
        kinds += [Phrase("count-open", count=self.open)] * bool(self.open)
        report.append(Finding("contours-read", count=self.closed + self.open, kinds=tuple(kinds), length=self.length))
        for end in self.open_ends[:_PLACES]:
            if end.other is None:
                report.append(Finding("open-end-alone", place=end.place))
            else:
                about: dict[str, Any] = {"gap": end.gap, "other": end.other, "advice": end.advice}
                report.append(Finding("open-end", place=end.place, **about))
        report += beyond(_PLACES, self.open_ends, "more-open-ends")
        for entity in self.not_understood[:_PLACES]:
            about = {"kind": entity.kind, "layer": entity.layer, "why": entity.reason}
            report.append(Finding("entity-not-cut", place=entity.place, **about))
        report += beyond(_PLACES, self.not_understood, "more-not-understood")
        report += _of_no_outline(self.rest)
        for kind in _OVERLAPS:
            report += _overlaps(kind, [overlap for overlap in self.overlaps if overlap.kind == kind])
        return [*report, *_mended(self.mends), *self.findings]


def by_layer(code: str, entities: Iterable[Entity], **values: Any) -> Iterator[Finding]:  # noqa: ANN401
    """Report odd entities and how they are cut, those of each layer together."""
    layers: dict[str, list[Entity]] = defaultdict(list)
    for entity in entities:
        layers[entity.layer].append(entity)
    for layer, group in sorted(layers.items()):
        yield Finding(code, count=len(group), layer=layer, place=group[0].place, **values)


def listed(kinds: dict[str, int]) -> tuple[Phrase, ...]:
    """Kinds of entities with their numbers."""
    return tuple(Phrase("count-kind", count=count, kind=kind) for kind, count in sorted(kinds.items()))


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


def _size(account: Account) -> Finding:
    """Size and units."""
    width, height = account.size
    scale = None if account.factor == 1 else Phrase("places-in-mm", factor=account.factor)
    is_told = account.units_from in (TOLD, ASKED) and not account.units_more
    return Finding(
        "size-read" if is_told else "size-guessed",
        width=width,
        height=height,
        units=account.units,
        told=account.told,
        scale=scale,
    )


def _of_layer(layer: LayerSum) -> Finding:
    counts = (("layer-cut", layer.cut), ("layer-part", layer.part), ("layer-left", layer.skipped))
    parts = tuple(Phrase(code, count=count) for code, count in counts if count)
    reasons = tuple(Phrase("kinds-for-reason", kinds=listed(kinds), reason=why) for why, kinds in layer.why.items())
    return Finding(
        "layer-sum",
        layer=layer.layer,
        entities=Phrase("count-entities", count=layer.read),
        parts=parts or Phrase("layer-none"),
        reasons=Phrase("layer-reasons", reasons=reasons) if reasons else None,
    )


def _of_no_outline(entities: Iterable[Entity]) -> list[Finding]:
    """Entities of no outline by layer and kind, with their places."""
    groups: dict[tuple[str, str], list[XY]] = defaultdict(list)
    for entity in entities:
        groups[entity.layer, entity.kind].append(entity.place)
    return [
        Finding("of-no-outline", layer=layer, kind=kind, count=len(places), **first_places(places))
        for (layer, kind), places in groups.items()
    ]


def first_places(places: list[XY], most: int = _PLACES) -> dict[str, Any]:
    """The values of a finding for some places: the first ones, and how many more there are."""
    more = Phrase("and-more", count=len(places) - most) if len(places) > most else None
    return {"places": tuple(places[:most]), "more": more, "place": places[0]}


def _overlaps(kind: str, overlaps: list[Overlap]) -> list[Finding]:
    groups: dict[str, list[XY]] = defaultdict(list)
    for overlap in overlaps:
        groups[overlap.layer].append(overlap.place)
    return [
        Finding(_OVERLAPS[kind], layer=layer, count=len(places), **first_places(places))
        for layer, places in groups.items()
    ]
