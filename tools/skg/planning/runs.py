"""Runs of the wire along a contour, the leads between its start hole and it; edges that follow each other, split."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import cos, pi, sin

import numpy as np

from skg.geometry.contour import Contour, Edge, part_of
from skg.geometry.plane import XY, distance, minus, polar, turn

#: A tab that goes around corners ends no nearer to one than this part of the edge there.
_INSIDE = 0.2
#: Directions (radians) that differ by less go the same way; how far a start hole may stand beside the square to its
#: entry for a lead that is an arc.
SQUARE = 1e-6
#: What is shorter is no edge, mm.
_NOTHING = 1e-6


@dataclass(frozen=True)
class Lead:
    """The path between a start hole and the contour: straight, or from the hole to an arc about it, and along that.

    `hole`: where the wire is threaded; `entry`: the place on the contour. `heading`: the direction of travel along
    the contour there, radians. `is_arc`: a quarter of a circle about the hole touches the contour at the entry. `home`:
    the wire is threaded there instead, and goes straight to the hole, None: in the hole.
    """

    hole: XY
    entry: XY
    heading: float
    is_arc: bool
    home: XY | None = None

    @property
    def threaded(self) -> XY:
        """The place where the wire is threaded."""
        return self.home or self.hole

    def arc(self, is_in: bool) -> Edge:
        """The arc that comes to the entry, or that leaves it."""
        aside = turn(self.heading, angle(minus(self.entry, self.hole)))
        sweep = pi / 2 if aside < 0 else -pi / 2
        reach = distance(self.hole, self.entry)
        if is_in:
            return Edge(polar(self.hole, reach, self.heading + pi), self.entry, self.hole, sweep)
        return Edge(self.entry, polar(self.hole, reach, self.heading), self.hole, sweep)

    def reversed(self) -> Lead:
        """The same lead, for the contour run through backwards."""
        return replace(self, heading=self.heading + pi)

    def moved(self, entry: XY, heading: float) -> Lead:
        """The lead to another entry, passed in a direction (radians), from a hole that lies beside it likewise."""
        aside = angle(minus(self.hole, self.entry)) - self.heading
        hole = polar(entry, distance(self.hole, self.entry), heading + aside)
        return Lead(hole, entry, heading, self.is_arc, self.threaded)


@dataclass(frozen=True)
class Run:
    """One run of the wire along a contour, or a part of it: edges that follow each other, at one offset.

    `offset` is R for this direction; `number`: of the pass, among the contour's `offsets`. `into`, `out`: how the wire
    comes from its start hole and goes to one; without them a closed run begins and ends at its contour's start hole
    (BACK), an open one at its own ends. `stop`: what the operator is to do before it, the machine stops for it; empty:
    nothing.
    """

    edges: tuple[Edge, ...]
    offset: float
    number: int = 0
    into: Lead | None = None
    out: Lead | None = None
    stop: str = ""

    @property
    def is_closed(self) -> bool:
        """Tell whether it ends where it began."""
        return distance(self.edges[0].start, self.edges[-1].end) < 1e-9


def backwards(run: Run) -> Run:
    edges = reverse(run.edges)
    into, out = (lead and lead.reversed() for lead in (run.out, run.into))
    return Run(edges, -run.offset, run.number, into, out, run.stop)


def reverse(edges: tuple[Edge, ...]) -> tuple[Edge, ...]:
    return tuple(edge.reversed() for edge in reversed(edges))


def beside(place: XY, direction: float, r: float) -> XY:
    """The place R to the right of one that is passed in a direction (radians)."""
    return place[0] + r * sin(direction), place[1] - r * cos(direction)


def stands_square(hole: XY, entry: XY, direction: float) -> bool:
    """Tell whether a hole stands square to a place that is passed in a direction (radians)."""
    return abs(cos(angle(minus(hole, entry)) - direction)) < SQUARE


def angle(vector: XY) -> float:
    return float(np.arctan2(vector[1], vector[0]))


def arc_beside(tab: float, r: float) -> float:
    """The radius of the arcs that lead to the contour at the two ends of a tab, mm: between the arcs is left half of
    what straight leads leave, with a wire R beside."""
    return (tab - 2 * abs(r)) / 4


def chain_from(contour: Contour, part: float) -> tuple[Edge, ...]:
    """A contour's edges from `part` of the first one on; a closed one's come back there."""
    first, *others = contour.edges
    if part == 0:
        return contour.edges
    if first.is_circle:
        place = first.at(part)
        return (replace(first, start=place, end=place),)
    return (part_of(first, part, 1), *others, part_of(first, 0, part))


def split_at(edges: tuple[Edge, ...], length: float) -> tuple[tuple[Edge, ...], tuple[Edge, ...]]:
    """The edges up to a length along them, mm, and those from there on; a curve is split at the inner node next to it,
    or behind it where there is none."""
    for index, edge in enumerate(edges):
        if length > edge.length and index + 1 < len(edges):
            length -= edge.length
            continue
        if edge.nodes:
            lengths = np.cumsum([0.0, *edge.steps()])
            off = [abs(lengths[node_sample(edge, node)] - length) for node in range(len(edge.nodes))]
            node = int(np.argmin(off[1:-1])) + 1 if len(off) > 2 else 1
            if node == len(edge.nodes) - 1:
                return edges[: index + 1], edges[index + 1 :]
            one, other = split_curve(edge, node)
            return (*edges[:index], one), (other, *edges[index + 1 :])
        if length < _NOTHING or edge.length - length < _NOTHING:
            behind = index + (length >= _NOTHING)
            return edges[:behind], edges[behind:]
        part = length / edge.length
        return (*edges[:index], part_of(edge, 0, part)), (part_of(edge, part, 1), *edges[index + 1 :])
    return edges, ()


def beginning(edges: tuple[Edge, ...], length: float) -> tuple[Edge, ...]:
    """The edges up to a length along them, mm."""
    return split_at(edges, length)[0]


def split_at_end(edges: tuple[Edge, ...], length: float) -> tuple[tuple[Edge, ...], tuple[Edge, ...]]:
    """The edges up to `length` before their end, and those from there on: no less than that, and cut within an edge.

    A curve is split at the node there, or at the one before it.
    """
    before, left = list(edges), length
    tail: tuple[Edge, ...] = ()
    while len(before) > 1 and (1 - left / before[-1].length < _INSIDE if tail else left > before[-1].length):
        tail = (before.pop(), *tail)
        left = max(0.0, left - tail[0].length)
    last = before.pop()
    if not last.nodes:
        part = 1 - left / last.length
        part = min(1 - _INSIDE, max(_INSIDE, part)) if tail else part
        return (*before, part_of(last, 0, part)), (part_of(last, part, 1), *tail)
    lengths = np.cumsum([0.0, *last.steps()])
    near = [node_sample(last, index) for index in range(len(last.nodes))]
    index = max((index for index in range(1, len(near) - 1) if lengths[-1] - lengths[near[index]] >= left), default=0)
    if not index:
        return tuple(before), (last, *tail)
    head, rest = split_curve(last, index)
    return (*before, head), (rest, *tail)


def node_sample(edge: Edge, index: int) -> int:
    """The number of the sample at a curve's node."""
    return int(np.argmin(((edge.samples - edge.nodes[index].point) ** 2).sum(1)))


def split_curve(edge: Edge, index: int) -> tuple[Edge, Edge]:
    """A curve as two, the first up to its node number `index`."""
    point, cut = edge.nodes[index].point, node_sample(edge, index)
    head = replace(edge, end=point, nodes=edge.nodes[: index + 1], samples=edge.samples[: cut + 1])
    return head, replace(edge, start=point, nodes=edge.nodes[index:], samples=edge.samples[cut:])
