"""Selection of the contours that are cut: each edge that is not cut has a reason."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping
from copy import copy
from dataclasses import replace
from math import inf
from typing import Any

from skg.errors import UserError
from skg.geometry.arrays import Floats
from skg.geometry.contour import Contour, Edge
from skg.geometry.edge_arrays import boxes_of
from skg.geometry.plane import XY, distance, shifted
from skg.job.read_options import MEET, ReadOptions
from skg.messages.finding import Finding, Phrase
from skg.reading.account import (
    TWICE,
    Account,
    Content,
    Entity,
    LayerSum,
    Mend,
    OpenEnd,
    Overlap,
    above,
    by_layer,
    first_places,
)
from skg.reading.chain import Chains, chain, chained_again
from skg.reading.meetings import Relations, lying_on, nearest, relations
from skg.reading.overlaps import without_overlaps
from skg.reading.overruns import Overrun, without_overruns
from skg.reading.repairs import lost, possible, repaired, without_strays

#: Why an edge is not cut.
SHORT, DOUBLE, JUNCTION = Phrase("reason-short"), Phrase("reason-twice"), Phrase("reason-junction")
DASHED, AXIS = Phrase("reason-dashed"), Phrase("reason-axis")
SMALL, TOO_SHORT = Phrase("reason-no-room"), Phrase("reason-too-short")
WITHIN = Phrase("reason-within")
UNWANTED = Phrase("reason-unwanted")
PAST, OPENED, STRAY = Phrase("reason-past"), Phrase("reason-of-open"), Phrase("reason-stray")
#: Reasons that are no loss: short or doubled edges are cut with their neighbours, overruns are reported by themselves.
_WITH_OTHERS = (SHORT, DOUBLE, PAST)
#: Reasons why edges are left unasked; reported if these are longer than this part of the cut edges.
_UNASKED, _MUCH = (JUNCTION, DASHED, AXIS), 0.1
#: Ends past a corner whose places a line of the report names.
_PLACES = 20
#: Ends of what is left that are no further apart may be meant to meet, mm.
_GAP = 0.1


class Selection:
    """Chains the edges of a drawing and chooses which contours are cut, as `options` has it; what is left, and what is
    to be said of it, goes into `report`."""

    def __init__(self, content: Content, options: ReadOptions, report: Account) -> None:
        self.content = content
        self.options = options
        self.report = report
        #: Ends and lines no further apart are one, mm; what is joined is wider apart.
        self.near = min(options.tolerance, MEET)
        self.fates = Fates(content, self.near)
        self.styles = [(entity.layer, entity.dashes) for entity in content.entities]
        self.opened: list[Contour] = []

    def contours(self) -> list[Contour]:
        """The contours that are wanted, open ones among them."""
        kept, rest = self._apart(self._chains())
        kept, rest = self._wanted(kept, rest)
        on, between = lying_on(rest, kept, self.near)
        self.report.findings += _between([rest[run] for run in sorted(between)])
        self.fates.doubles += [(rest[run].edges, kept[number].edges[0]) for run, number in on.items()]
        rest = [contour for run, contour in enumerate(rest) if run not in on]
        for run in rest:
            self.fates.of_edges(run.edges, JUNCTION)
        gaps = list(_gaps(rest, self.content.edges, self.options.tolerance))
        self._say_around(rest, kept, bool(gaps))
        self.report.findings += gaps
        self.opened = [contour for contour in kept if not contour.is_closed] + rest
        return kept

    def _say_around(self, rest: list[Contour], kept: list[Contour], has_gaps: bool) -> None:
        """Report a line that is not cut around all that is; where the wire runs beside contours, refuse it, unless it
        was said what becomes of open lines: the outline is lost, and its openings would be cut as outlines."""
        around = _around(rest, kept, has_gaps)
        if not around:
            return
        first, last = around[0].edges[0].start, around[-1].edges[-1].end
        if self.options.open == "refuse":
            raise UserError(Finding("outline-lost", place=first))
        if len(kept) > 1:
            is_single = len(around) == 1
            self.report.findings.append(
                Finding("line-around", start=first, end=last) if is_single else Finding("lines-around")
            )

    def others(self) -> tuple[list[Contour], list[Contour]]:
        """The closed contours of layers that are not cut, and the open lines of all layers, both drawn through: what is
        cut may lie in them."""
        tolerance = self.options.tolerance
        chains, _ = without_overruns(chain(self.content.others, tolerance, self.styles), tolerance, self.styles)
        lines = [
            replace(contour, layers=self.fates.layers(contour))
            for contour in chains.contours + chains.rest + self.opened
            if not self.fates.is_dashed(contour)
        ]
        return [line for line in lines if line.is_closed], [line for line in lines if not line.is_closed]

    def without_open(self, contours: list[Contour]) -> list[Contour]:
        """The contours without the open ones where these are left; a `UserError` where there are any and they are
        refused. Their ends go into the report."""
        opened = [contour for contour in contours if not contour.is_closed]
        self.report.open_ends = _open_ends(opened, self.content.edges, self.options.tolerance)
        self.report.repairs = possible(self.opened, self.report.open_ends)
        if opened and self.options.open == "refuse":
            place = min(self.report.open_ends, key=lambda end: end.gap).place
            raise UserError(Finding("open-refused", count=len(opened), gap=self.report.first_gap(), place=place))
        if self.options.open != "leave":
            return contours
        for contour in opened:
            self.fates.of_edges(contour.edges, OPENED)
        return [contour for contour in contours if contour.is_closed]

    def _chains(self) -> Chains:
        """All edges as contours; what is short, drawn twice or runs past a corner is accounted for."""
        fates, report, tolerance = self.fates, self.report, self.options.tolerance
        mended = repaired(self.content.edges, self.options)
        fates.parts.update(bridge.entity for bridge in mended.bridges)
        fates.of_pieces(mended.pieces, PAST)
        report.mends += mended.mends
        report.findings += mended.findings
        chains = chain([*mended.edges, *mended.bridges], tolerance, self.styles)
        if self.options.open != "all":
            chains, overlaps = without_overlaps(chains, tolerance, self.near, self.styles)
            fates.parts.update(piece.entity for piece, _ in overlaps.pieces)
            fates.doubles += [((edge,), on) for edge, on in (*overlaps.pieces, *overlaps.whole)]
            chains, cuts = without_overruns(chains, tolerance, self.styles)
            fates.of_pieces([cut.piece for cut in cuts if not cut.is_whole], PAST)
            fates.of_edges([cut.piece for cut in cuts if cut.is_whole], PAST)
            report.findings += _past(cuts, self.content)
            report.mends += [Mend("past", cut.corner, cut.piece.length) for cut in cuts]
        if self.options.strays:
            chains = self._without_strays(chains, mended.by)
        fates.of_edges(chains.short, SHORT)
        fates.parts.update(join.bridge.entity for join in chains.joins if join.bridge)
        report.mends += [Mend("joined", join.place, join.width) for join in chains.joins]
        report.mends += [Mend("short", edge.start, edge.length) for edge in chains.short]
        fates.doubles += [((edge,), twin) for edge, twin in chains.doubles]
        return chains

    def _without_strays(self, chains: Chains, by: XY) -> Chains:
        """The chains without the open lines that somebody wants left; one that is not there is reported. `by`: how far
        the drawing was moved since."""
        opened = [contour for contour in chains.contours if not contour.is_closed]
        runs = opened + chains.rest
        kept, found = without_strays(runs, [shifted(place, by) for place in self.options.strays])
        for place, number in found:
            if number is None:
                self.report.findings.append(lost("stray", place))
        for number in sorted({number for _, number in found if number is not None}):
            run = runs[number]
            self.fates.of_edges(run.edges, STRAY)
            length, place = sum(edge.length for edge in run.edges), run.edges[0].start
            self.report.findings.append(Finding("stray-left", place=place, length=length))
        if len(kept) == len(runs):
            return chains
        return chained_again(chains, [runs[number] for number in kept], [], self.options.tolerance, self.styles)[0]

    def _apart(self, chains: Chains) -> tuple[list[Contour], list[Contour]]:
        """The outlines, and what hangs together with others at junctions; what is repeated or is an axis is neither."""
        contours, every = chains.contours, chains.contours + chains.rest
        related = relations(every, self.near)
        axes = _axes(contours, related, self.fates) if self.options.open != "all" and not self.options.layers else set()
        for number, first in related.repeated.items():
            self.fates.doubles.append((every[number].edges, every[first].edges[0]))
        for number in sorted(axes):
            self.fates.of_edges(contours[number].edges, AXIS)
        self._say_meetings(contours, related, axes)
        gone = set(related.repeated) | axes
        hanging = {number for number in related.touched if number < len(contours)} - gone
        rest = [contour for number, contour in enumerate(chains.rest, len(contours)) if number not in gone]
        rest += [contours[number] for number in sorted(hanging)]
        return [contour for number, contour in enumerate(contours) if number not in gone | hanging], rest

    def _say_meetings(self, contours: list[Contour], related: Relations, axes: set[int]) -> None:
        """Put into the report which outlines meet others."""
        for kind, first, second, place in related.meetings:
            if second < len(contours) and not {first, second} & axes:
                self.report.overlaps.append(self.fates.overlap(kind, contours[second].edges[0], place))
        if related.unseen:
            self.report.findings.append(Finding("more-meetings", count=related.unseen))

    def _wanted(self, kept: list[Contour], rest: list[Contour]) -> tuple[list[Contour], list[Contour]]:
        """Select outlines and the rest by --open and --layer; open dashes are left."""
        if self.options.open == "all":
            return kept + rest, []
        if self.options.open == "cut" and rest and not any(contour.is_closed for contour in kept):
            self.report.findings.append(Finding("no-closed-as-drawn"))
            kept, rest = kept + rest, []
        dashed = {number for number, contour in enumerate(kept) if self.fates.is_dashed(contour)}
        if self.options.layers or not any(
            contour.is_closed and number not in dashed for number, contour in enumerate(kept)
        ):
            return kept, rest
        skipped = [number for number in sorted(dashed) if not kept[number].is_closed]
        for number in skipped:
            self.fates.of_edges(kept[number].edges, DASHED)
        return [contour for number, contour in enumerate(kept) if number not in set(skipped)], rest


class Fates:
    """The fate of each entity's edges. `doubles`: runs of those drawn twice, with an edge of what each was drawn
    on: where that one is left, they are left with it. `lost`: what is left of each layer unasked, mm. `by`: how far the
    drawing was moved since, mm; the entities with it, the doubles not."""

    def __init__(self, content: Content, tolerance: float) -> None:
        self.entities = content.entities
        self.tolerance = tolerance
        self.doubles: list[tuple[tuple[Edge, ...], Edge]] = []
        self.parts = Counter(edge.entity for edge in content.edges)
        self.gone: dict[int, Counter[Phrase]] = defaultdict(Counter)
        self.lost: dict[str, float] = defaultdict(float)
        self.by: XY = (0.0, 0.0)

    def of_edges(self, edges: Iterable[Edge], why: Phrase) -> None:
        """Say why edges are not cut."""
        for edge in edges:
            self.gone[edge.entity][why] += 1
            if why in _UNASKED:
                self.lost[self.entities[edge.entity].layer] += edge.length

    def of_pieces(self, pieces: list[Edge], why: Phrase) -> None:
        """Say why pieces are not cut that edges were divided into."""
        self.parts.update(piece.entity for piece in pieces)
        self.of_edges(pieces, why)

    def overlap(self, kind: str, edge: Edge, place: XY) -> Overlap:
        """A line of the report."""
        return Overlap(kind, self.entities[edge.entity].layer, place)

    def layers(self, contour: Contour) -> tuple[str, ...]:
        """The layers of a contour's edges."""
        return tuple(dict.fromkeys(self.entities[edge.entity].layer for edge in contour.edges))

    def is_dashed(self, contour: Contour) -> bool:
        """Tell whether a contour is drawn with dashes, all of it: an axis, or what lies behind."""
        return all(self.entities[edge.entity].dashes for edge in contour.edges)

    def account(self, contours: list[Contour], skipped: Mapping[int, Phrase], begun: Account) -> Account:
        """The report with the sums of the layers; a sum that does not agree is a `UserError`. `skipped`: numbers of
        contours that are not cut, and why; `begun`: what else it has."""
        fates, report = copy(self), replace(begun, findings=[*begun.findings], overlaps=[*begun.overlaps], whole={})
        fates.gone = defaultdict(Counter, {number: Counter(gone) for number, gone in self.gone.items()})
        fates.lost = self.lost.copy()
        for number, why in skipped.items():
            fates.of_edges(contours[number].edges, why)
        fates._sum_up([contour for number, contour in enumerate(contours) if number not in skipped], report)
        return report

    def _sum_up(self, contours: list[Contour], report: Account) -> None:
        cut = Counter(edge.entity for contour in contours for edge in contour.edges)
        self._account_doubles(contours, cut, report)
        report.findings += self._much_left(contours)
        sums: dict[str, LayerSum] = {}
        rest: list[Entity] = []
        odd: list[Entity] = []
        for number, entity in enumerate(self.entities):
            layer = sums.setdefault(entity.layer, LayerSum(entity.layer))
            layer.read += 1
            gone = self.gone.get(number) or Counter()
            if cut[number] + gone.total() != self.parts[number] or not (self.parts[number] or entity.reason):
                about: dict[str, Any] = {"kind": entity.kind, "layer": entity.layer, "place": entity.place}
                known: dict[str, Any] = {"parts": self.parts[number], "counted": cut[number] + gone.total()}
                raise UserError(Finding("miscounted", **about, **known))
            if not entity.reason and all(why in _WITH_OTHERS for why in gone):
                report.whole[number] = DOUBLE in gone
            lost = [why for why in gone if not cut[number] or why not in _WITH_OTHERS]
            if not lost and not entity.reason:
                layer.cut += 1
                continue
            reason = entity.reason or _all_of(lost)
            skipped = replace(entity, reason=reason)
            if cut[number]:
                layer.part += 1
            else:
                layer.skipped += 1
            layer.why[reason][skipped.kind] += 1
            if JUNCTION in gone:
                rest.append(skipped)
            elif skipped.is_odd:
                odd.append(skipped)
        report.rest, report.not_understood = rest, odd
        report.layers = sorted(sums.values(), key=lambda layer: layer.layer)
        dashed = defaultdict(list)
        for number, entity in enumerate(self.entities):
            if cut[number] and entity.dashes:
                dashed[entity.dashes].append(entity)
        for name, entities in dashed.items():
            report.findings += by_layer("seen-dashed", entities, dashes=name)

    def _much_left(self, contours: list[Contour]) -> Iterator[Finding]:
        """Report that much of the layers that are cut is left, which nobody asked for."""
        edges = [edge for contour in contours for edge in contour.edges]
        layers = {self.entities[edge.entity].layer for edge in edges}
        cut = sum(edge.length for edge in edges)
        lost = sum(length for layer, length in self.lost.items() if layer in layers)
        if lost > _MUCH * cut:
            yield Finding("much-left", left=lost, cut=cut)

    def _account_doubles(self, contours: list[Contour], cut: Counter[int], report: Account) -> None:
        """Say of what is drawn twice whether the other one is cut, and if not why."""
        # (of most entities all is cut or nothing; of the others each edge is looked for)
        partly = {twin.entity for _, twin in self.doubles if 0 < cut[twin.entity] < self.parts[twin.entity]}
        middles: dict[int, list[XY]] = defaultdict(list)
        for edge in (edge for contour in contours for edge in contour.edges if edge.entity in partly):
            middles[edge.entity].append(edge.at(0.5))
        overlaps = []
        for run, twin in self.doubles:
            number, middle = twin.entity, twin.at(0.5)
            near = (distance(middle, place) <= 2 * self.tolerance for place in middles[number])
            if any(near) if number in partly else cut[number]:
                self.of_edges(run, DOUBLE)
                overlaps.append(self.overlap(TWICE, run[0], shifted(run[0].start, self.by)))
            else:
                self.of_edges(run, next((why for why in self.gone[number] if why not in _WITH_OTHERS), DOUBLE))
        report.overlaps[:0] = overlaps


def _all_of(reasons: list[Phrase]) -> Phrase:
    """Some reasons as one."""
    first, *others = reasons
    for other in others:
        first = Phrase("reason-and", first=first, other=other)
    return first


def _past(cuts: list[Overrun], content: Content) -> Iterator[Finding]:
    """Report ends that run past corners, a line for each layer."""
    layers: dict[str, list[Overrun]] = defaultdict(list)
    for cut in cuts:
        layers[content.entities[cut.piece.entity].layer].append(cut)
    for layer, ends in sorted(layers.items()):
        longest = max(cut.piece.length for cut in ends)
        places = first_places([end.corner for end in ends], _PLACES)
        yield Finding("overruns", count=len(ends), layer=layer, longest=longest, **places)


def _between(runs: list[Contour]) -> Iterator[Finding]:
    """Report uncut lines that divide a cut contour."""
    if runs:
        yield Finding("lines-between", count=len(runs), place=runs[0].edges[0].start)


def _around(rest: list[Contour], kept: list[Contour], has_gaps: bool) -> list[Contour]:
    """The uncut line that encloses all cut contours and is larger than each: one run, or all of them where they have
    gaps; else nothing."""
    if not rest or not kept:
        return []
    boxes, outer = boxes_of(kept)[0], boxes_of(rest)[0]
    single = next((number for number in range(len(rest)) if _reach_around(outer[number : number + 1], boxes)), None)
    if single is not None:
        return [rest[single]]
    return rest if has_gaps and _reach_around(outer, boxes) else []


def _reach_around(outer: Floats, boxes: Floats) -> bool:
    """Tell whether the box around some boxes has the middles of all others in it, and is larger than each."""
    low, high = outer[:, :2].min(0), outer[:, 2:].max(0)
    middles = (boxes[:, :2] + boxes[:, 2:]) / 2
    sizes = boxes[:, 2:] - boxes[:, :2]
    return bool(((low <= middles) & (middles <= high) & (sizes < high - low)).all())


def _gaps(rest: list[Contour], edges: list[Edge], tolerance: float) -> Iterator[Finding]:
    """Report free ends of uncut lines so near to a corner that an outline may be open."""
    count = Counter(end for run in rest for edge in run.edges for end in (edge.start, edge.end))
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
        yield Finding("ends-near", count=len(gaps), widest=widest, gap=above(widest), place=place)


def _axes(contours: list[Contour], related: Relations, fates: Fates) -> set[int]:
    """The closed contours drawn with dashes that cross others, which are not: circles that holes lie on."""
    pairs = [
        (first, second) for kind, first, second, _ in related.meetings if kind == "cross" and second < len(contours)
    ]
    return {
        number
        for number, other in (*pairs, *((second, first) for first, second in pairs))
        if fates.is_dashed(contours[number]) and not fates.is_dashed(contours[other])
    }


def _open_ends(contours: list[Contour], edges: list[Edge], tolerance: float) -> list[OpenEnd]:
    """Ends of open contours, each with the nearest other one; `edges`: all of the drawing."""
    ends = [place for contour in contours for place in contour.ends]
    if not ends:
        return []
    shortest = _shortest(edges, tolerance)
    open_ends = []
    for place, other in zip(ends, nearest(ends), strict=True):
        if other is None:
            open_ends.append(OpenEnd(place, None, inf))
            continue
        gap = distance(place, other)
        can_join = float(above(gap)) < shortest
        open_ends.append(OpenEnd(place, other, gap, can_join))
    return open_ends


def _shortest(edges: list[Edge], tolerance: float) -> float:
    """Return the largest tolerance that keeps every edge; edges shorter than `tolerance` are lost already."""
    wide = (distance(edge.start, edge.end) for edge in edges)
    return min((chord for chord in wide if chord > tolerance), default=inf)
