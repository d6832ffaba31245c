"""Checking a tape against the drawing that it was made from: where the controller goes, beside where it should.

Nothing here is computed as the ROM does it, there are no corners and no crossings. A tape is right when

- every place of the wire lies R beside its contour (at a sharp corner, outside: beside the line or circle there), and
  never nearer, also where another part of the contour comes by;
- beside every place of the contour that the wire can reach it has been R away.

R is that of the pass which goes there.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from skg.checking.check_coverage import not_reached
from skg.checking.check_distance import off_contours
from skg.checking.follow import Followed, Threading, follow
from skg.checking.gouges import Crossing
from skg.checking.wire_path import Misfit, WirePath
from skg.geometry.arrays import Floats
from skg.geometry.contour import Edge
from skg.geometry.piece import Piece
from skg.geometry.pieces import Pieces
from skg.planning.route import PlannedContour, split_at_end
from skg.tape.block import Tape


@dataclass(frozen=True)
class Checked:
    """A tape as it was followed: the largest distance from the drawing (mm), what is wrong."""

    followed: Followed
    off: float
    faults: list[Misfit]
    crossings: list[Crossing]

    @property
    def cuts(self) -> list[Threading]:
        """Its cuts."""
        return self.followed.cuts

    @property
    def drift(self) -> float:
        """Its drift, mm."""
        return self.followed.drift


def check(tape: Tape, routes: list[PlannedContour], is_without_drift: bool) -> Checked:
    """Follow a tape and compare it with the routes that it should cut."""
    followed = follow(tape, routes, is_without_drift)
    contours = Pieces(
        (path, number) for number, route in enumerate(routes) for part in _parts(route) for path in _paths(part)
    )
    path = WirePath(followed, routes)
    offsets = _offsets(routes)
    passes = np.array([len(route.passes) for route in routes])
    widest = float(np.abs(offsets).max(initial=0.0))
    with ThreadPoolExecutor(1) as other:
        # (numpy lets both halves run at the same time)
        beside = other.submit(off_contours, path, contours, routes, offsets, widest)
        more, far = not_reached(path, contours, _in_tabs(contours, routes), offsets, passes, widest)
        faults, crossings, worst = beside.result()
    return Checked(followed, max(worst, far), faults + more, crossings)


def _offsets(routes: list[PlannedContour]) -> Floats:
    """R of the passes of each route, in its own direction; one that has fewer has its last one again."""
    most = max(len(route.passes) for route in routes)
    return np.array([(*route.passes, *(most - len(route.passes)) * route.passes[-1:]) for route in routes], float)


def drawn(route: PlannedContour) -> Iterator[Piece]:
    """A contour as lines and arcs, in its direction."""
    for edge in (edge for part in _parts(route) for edge in part):
        if edge.nodes:
            yield from (Piece(p, q) for p, q in pairwise(edge.points()) if p != q)
        else:
            yield edge


def _parts(route: PlannedContour) -> tuple[tuple[Edge, ...], ...]:
    """A contour's edges up to its tab, and those of the tab."""
    return split_at_end(route.chain, route.tab) if route.tab else (route.chain,)


def _paths(edges: Iterable[Edge]) -> Iterator[Edge | Floats]:
    """Lines and arcs, and the samples of curves."""
    return (edge.samples if edge.nodes else edge for edge in edges)


def _in_tabs(contours: Pieces, routes: list[PlannedContour]) -> np.ndarray:
    """Mark the pieces of contours that are cut in the last pass alone."""
    is_in_tab = np.zeros(len(contours.owner), bool)
    ends = np.searchsorted(contours.owner, np.arange(len(routes)), "right")
    for end, route in zip(ends.tolist(), routes, strict=True):
        if route.tab:
            tab = Pieces((path, 0) for path in _paths(_parts(route)[1]))
            is_in_tab[end - len(tab.owner) : end] = True
    return is_in_tab
