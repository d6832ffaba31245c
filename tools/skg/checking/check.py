"""Checking a tape against the drawing that it was made from: where the controller goes, beside where it should.

Nothing here is computed as the ROM does it, there are no corners and no crossings. A tape is right when

- every place of the wire lies R beside its contour (at a sharp corner, outside: beside the line or circle there), and
  never nearer, also where another part of the contour comes by;
- beside every place of the contour that the wire can reach it has been R away;
- before a tab is cut, it holds part and stock together.

R is that of the pass which goes there.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

import numpy as np

from skg.checking.bridges import Fallen, fallen
from skg.checking.check_coverage import not_reached
from skg.checking.check_distance import into_others, off_contours
from skg.checking.follow import Followed, Stretch, follow
from skg.checking.gouges import Crossing
from skg.checking.wire_path import Beside, Misfit, Share, WirePath
from skg.geometry.arrays import Flags, Floats, Whole
from skg.geometry.contour import Edge
from skg.geometry.edge_arrays import boxes_of
from skg.geometry.index import batches
from skg.geometry.piece import Piece
from skg.geometry.pieces import Pieces
from skg.planning.planned import PlannedContour
from skg.tape.block import Tape

#: So many pieces of contours are looked at together.
_TOGETHER = 50_000


@dataclass(frozen=True)
class Checked:
    """A tape as it was followed: the largest distance from the drawing (mm), what is wrong; `fallen`: tabs that hold
    nothing; `lengths`: of all cuts of a first pass, a second one and so on, mm; a tab's cuts are such, too."""

    followed: Followed
    off: float
    faults: list[Misfit]
    crossings: list[Crossing]
    fallen: list[Fallen]
    lengths: tuple[float, ...]

    @property
    def cuts(self) -> list[Stretch]:
        """Its cuts."""
        return self.followed.cuts

    @property
    def drift(self) -> float:
        """Its drift, mm."""
        return self.followed.drift


def check(tape: Tape, contours: list[PlannedContour], is_without_drift: bool) -> Checked:
    """Follow a tape and compare it with the contours that it should cut."""
    followed = follow(tape, contours, is_without_drift)
    path = WirePath(followed, contours)
    beside = Beside(path, contours)
    faults: list[Misfit] = []
    missed: dict[tuple[int, int], Misfit] = {}
    near_others: list[tuple[Whole, Whole]] = []
    worst = along = 0.0
    with ThreadPoolExecutor(1) as other:
        for share in _shares(path, contours, beside.reach):
            # (numpy lets both halves run at the same time)
            half = other.submit(off_contours, path, share, beside)
            unreached, far, along = not_reached(path, share, beside, _in_tabs(share, contours), along)
            misfits, near, off = half.result()
            faults += misfits
            near_others += near
            missed |= unreached
            worst = max(worst, off, far)
    crossings = into_others(path, beside, near_others, partial(_pieces, contours))
    misfits = [*faults, *(missed[key] for key in sorted(missed))]
    fell = [] if misfits else list(fallen(path, followed.cuts, contours))
    return Checked(followed, worst, misfits, crossings, fell, path.lengths(contours))


def _shares(path: WirePath, contours: list[PlannedContour], reach: float) -> Iterator[Share]:
    """The contours in shares: the curves of all would take as much memory as all the rest. `reach`: how far from the
    wire others matter, mm."""
    counts = np.array([sum(len(edge.samples) or 1 for edge in planned.contour.edges) for planned in contours])
    shares = list(batches(counts, _TOGETHER))
    near = np.empty((2, 0), np.int64)
    if len(shares) > 1:
        boxes, _ = boxes_of([planned.contour for planned in contours])
        near = path.near(boxes[:, :2] - reach, boxes[:, 2:] + reach)
    for some in shares:
        others = near[1, (some.start <= near[0]) & (near[0] < some.stop)]
        nominal = _pieces(contours, np.union1d(np.arange(some.start, some.stop), others))
        ends = (np.searchsorted(pieces.owner, (some.start, some.stop)) for pieces in (nominal, path.pieces))
        yield Share(some, nominal, *(np.arange(*pair) for pair in ends))


def _pieces(contours: list[PlannedContour], numbers: Whole) -> Pieces:
    """The pieces of some contours, by their numbers."""
    parts = ((part, number) for number in numbers.tolist() for part in contours[number].parts)
    return Pieces((path, number) for part, number in parts for path in _paths(part))


def nominal(planned: PlannedContour) -> Iterator[Piece]:
    """A contour as lines and arcs, in its direction."""
    for edge in (edge for part in planned.parts for edge in part):
        if edge.nodes:
            yield from (Piece(p, q) for p, q in pairwise(edge.points()) if p != q)
        else:
            yield edge


def _paths(edges: Iterable[Edge]) -> Iterator[Edge | Floats]:
    """Lines and arcs, and the samples of curves."""
    return (edge.samples if edge.nodes else edge for edge in edges)


def _in_tabs(share: Share, contours: list[PlannedContour]) -> Flags:
    """Mark the pieces of the share's own contours that are tabs until the last cuts."""
    is_in_tab = np.zeros(len(share.nominal.owner), bool)
    ends = np.searchsorted(share.nominal.owner, np.arange(share.numbers.start, share.numbers.stop), "right")
    for end, planned in zip(ends.tolist(), contours[share.numbers], strict=True):
        for edges, tab in reversed(planned.spans):
            counts = [len(Pieces((path, 0) for path in _paths(part)).owner) for part in (tab, edges)]
            is_in_tab[end - counts[0] : end] = True
            end -= sum(counts)
    return is_in_tab
