"""Entries of closed contours: within the longest edges, with room for a tab before the entry."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import accumulate
from math import inf
from typing import NamedTuple

from skg.geometry.contour import Contour, Edge
from skg.geometry.plane import XY, distance, turn
from skg.planning.runs import split_curve

#: Most edges of a contour that are tried for a start hole with room around it.
_TRIED = 8
#: Edges of so often R are surely there beside the contour.
_SURE = 4.0
#: A contour with a tab is so many times as long as that, or has an edge that is so many times as long.
_LONG, _ROOM = 3, 1.2


def _turned_to(contour: Contour, index: int) -> Contour:
    """The closed contour, beginning with another of its edges."""
    return contour if not index else replace(contour, edges=contour.edges[index:] + contour.edges[:index])


class EntryAt(NamedTuple):
    """A possible start of a closed contour: at `part` of edge number `edge`, or at a `node` of that edge, a curve."""

    edge: int
    part: float = 0.0
    node: int = 0

    def begun(self, contour: Contour) -> Contour:
        """The contour, beginning with the edge of the entry: at its part, at the node."""
        turned = _turned_to(contour, self.edge)
        if not self.node:
            return turned
        before, after = split_curve(turned.edges[0], self.node)
        return replace(contour, edges=(after, *turned.edges[1:], before))


def nearest_entry(contour: Contour, place: XY, offset: float, with_curves: bool = False) -> EntryAt:
    """Enter a closed contour where it is nearest to a place, but well inside an edge; on a curve, at a node.

    `with_curves`: False prefers lines and arcs to a nearer curve. `offset`: R, mm.
    """
    best = (inf, EntryAt(0))
    for index, edge in enumerate(contour.edges):
        if edge.nodes:
            if with_curves:
                nodes = range(1, len(edge.nodes) - 1) if len(edge.nodes) > 2 else [0]
                best = min(best, *((distance(edge.nodes[k].point, place), EntryAt(index, node=k)) for k in nodes))
            continue
        margin = min(0.4, (2 * abs(offset) + 0.05) / edge.length)
        part = edge.nearest(place)
        if not edge.is_circle:
            part = min(1 - margin, max(margin, part))
        # A full circle is entered by a straight radial move; elsewhere any place of the edge will do.
        best = min(best, (distance(edge.at(part), place), EntryAt(index, part)))
    return best[1] if best[0] < inf else next(_entries_on_curve(contour))


def _entries_on_curve(contour: Contour) -> Iterator[EntryAt]:
    """Begin a contour at nodes inside its longest curve (first, a closed one at its seam)."""
    index = max(range(len(contour.edges)), key=lambda k: contour.edges[k].length)
    edge = contour.edges[index]
    is_smooth = len(contour.edges) == 1 and abs(turn(edge.nodes[0].angle, edge.nodes[-1].angle)) < 1e-3
    inner = {len(edge.nodes) * k // 4 for k in (1, 2, 3)} - {0, len(edge.nodes) - 1}
    if is_smooth or not inner:
        yield EntryAt(index)
    for node in sorted(inner, key=lambda k: abs(2 * k - len(edge.nodes))):
        yield EntryAt(index, node=node)


def is_long(contour: Contour, tab: float) -> bool:
    """Tell whether there is room for a tab that goes around corners."""
    return sum(edge.length for edge in contour.edges) > _LONG * tab


def longest_tab(contour: Contour, count: int = 1) -> float:
    """A closed contour has room for some tabs shorter than this (mm): one in an edge, or all around corners."""
    lengths = [edge.length for edge in contour.edges]
    return max(max(lengths) / _ROOM if count == 1 else 0.0, sum(lengths) / _LONG / count)


def entry_behind(contour: Contour, place: XY, tab: float, offset: float) -> EntryAt:
    """Enter a closed contour so that the middle of the tab before the entry is nearest to a place; a curve at the node
    that is nearest. `offset`: R, mm."""
    entry = nearest_entry(contour, place, offset, with_curves=True)
    edge = contour.edges[entry.edge]
    if edge.nodes:
        return entry
    part = edge.nearest(place) + tab / 2 / edge.length
    if edge.is_circle:
        return EntryAt(entry.edge, part % 1)
    return EntryAt(entry.edge, _on_one_edge(part * edge.length, tab, edge.length) / edge.length)


def _on_one_edge(end: float, tab: float, length: float) -> float:
    """The end of a tab along an edge (mm), so that all of it lies on the edge where that has room."""
    margin = min((_ROOM - 1) * tab / 2, length / 4)
    return min(length - margin, max(end, min(tab, length / 2) + margin))


def ends_of_tabs(chain: Sequence[Edge], tab: float, tabs: int | Sequence[XY]) -> list[float]:
    """The ends of all tabs but the one at the end of a chain, mm along this: at even distances, or with their middles
    where it is nearest to all places but the first; on lines and arcs that have room for one where there are some
    near."""
    begins = [0.0, *accumulate(edge.length for edge in chain)]
    if isinstance(tabs, int):
        wanted, near = [begins[-1] * number / tabs for number in range(1, tabs)], begins[-1] / 4 / tabs
    else:
        wanted, near = sorted(_along(chain, begins, place) + tab / 2 for place in tabs[1:]), tab
    ends, last = [], 0.0
    for end in wanted:
        fitting = [
            begin + _on_one_edge(end - begin, tab, edge.length)
            for begin, edge in zip(begins, chain, strict=False)
            if not edge.nodes and edge.length > _ROOM * tab
        ]
        best = min(
            (place for place in fitting if last + 2 * tab <= place <= begins[-1] - 2 * tab),
            key=lambda place: abs(place - end),
            default=inf,
        )
        last = best if abs(best - end) < near else end
        ends.append(last)
    return ends


def _along(chain: Sequence[Edge], begins: Sequence[float], place: XY) -> float:
    """The nearest point of a chain to a place, mm along it."""
    nearest = []
    for begin, edge in zip(begins, chain, strict=False):
        if edge.nodes:
            lengths = [0.0, *accumulate(edge.steps())]
            nearest += [
                (distance(sample, place), begin + ahead) for sample, ahead in zip(edge.points(), lengths, strict=True)
            ]
        else:
            part = edge.nearest(place)
            nearest.append((distance(edge.at(part), place), begin + part * edge.length))
    return min(nearest)[1]


def entries_of(contour: Contour, tab: float, widest: float) -> Iterator[EntryAt]:
    """Yield possible starts of a closed contour: in its longest lines, else in its longest arcs, else on a curve.

    The tab lies before the entry, on the same edge where there is one that is long enough. `widest`: the largest R.
    """
    if not tab and len(contour.edges) == 1 and contour.edges[0].is_circle:
        # (there is nothing to choose from)
        yield from _on_edges(contour, [(0, contour.edges[0].length)], tab)
        return
    lengths = [edge.length for edge in contour.edges]
    ranked = sorted(
        (index for index, edge in enumerate(contour.edges) if not edge.nodes),
        key=lambda index: (not contour.edges[index].is_line, -lengths[index]),
    )
    fitting = [index for index in ranked if lengths[index] > _ROOM * tab]
    # (a short edge may not be there any more beside the contour)
    sure = [index for index in fitting if lengths[index] > _SURE * widest]
    unsure = [index for index in fitting if lengths[index] <= _SURE * widest]
    yield from _on_edges(contour, [(index, lengths[index]) for index in sure[:_TRIED]], tab)
    if any(edge.nodes and length > _ROOM * tab for edge, length in zip(contour.edges, lengths, strict=True)):
        yield from _entries_on_curve(contour)
    yield from _on_edges(contour, [(index, lengths[index]) for index in unsure[:_TRIED]], tab)
    if not fitting and is_long(contour, tab):
        for index in ranked[:_TRIED]:
            yield EntryAt(index, 0.5)
        if not ranked:
            yield from _entries_on_curve(contour)


def _on_edges(contour: Contour, edges: Iterable[tuple[int, float]], tab: float) -> Iterator[EntryAt]:
    """Entries in the middle of edges, given by their numbers and lengths, and aside from it, behind a tab."""
    for index, length in edges:
        is_circle = contour.edges[index].is_circle
        aside = tab / 2 / length if tab else 0.0
        for part in (0.0, 0.25, 0.5, 0.75) if is_circle else (0.5, 0.3, 0.7):
            part += aside
            if is_circle or part - 2 * aside > 0.05 and part < 0.95:
                yield EntryAt(index, part % 1)
