"""Which pieces of a path lie nearest to places: many of both at once (numpy)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

from skg.piece import Piece

Floats = NDArray[np.float64]
Whole = NDArray[np.int64]

#: Pairs of a place and a piece that are looked at together.
_BATCH = 2_000_000
#: A path is laid out on no more cells than this.
_MOST_CELLS = 100_000


@dataclass(frozen=True)
class Nearest:
    """For m places: the distance to the nearest piece of the same owner, its number (-1: none within reach), and the
    distance to the nearest piece of another owner and its number."""

    own: Floats
    own_at: Whole
    other: Floats
    other_at: Whole


class Pieces:
    """n lines and arcs, each with an owner."""

    def __init__(self, pieces: Iterable[tuple[Piece, int]]) -> None:
        rows = [_row(piece, owner) for piece, owner in pieces]
        table = np.array(rows, float).reshape(-1, 10)
        self.start, self.end, self.centre = table[:, 0:2], table[:, 2:4], table[:, 4:6]
        self.radius, self.first, self.sweep = table[:, 6], table[:, 7], table[:, 8]
        self.owner = table[:, 9].astype(np.int64)
        self.is_arc = self.radius > 0
        way = self.end - self.start
        self.length = np.where(self.is_arc, self.radius * np.abs(self.sweep), np.hypot(way[:, 0], way[:, 1]))

    def at(self, which: Whole, part: Floats) -> Floats:
        """The places at parts of the lengths of pieces."""
        start, end = self.start[which], self.end[which]
        line = start + part[:, None] * (end - start)
        angle = self.first[which] + part * self.sweep[which]
        arc = self.centre[which] + self.radius[which, None] * np.stack((np.cos(angle), np.sin(angle)), 1)
        return np.where(self.is_arc[which, None], arc, line)

    def normal(self, which: Whole, part: Floats) -> Floats:
        """Unit vectors to the right of travel at parts of the lengths of pieces."""
        way = self.end[which] - self.start[which]
        length = np.maximum(np.hypot(way[:, 0], way[:, 1]), 1e-300)
        line = np.stack((way[:, 1], -way[:, 0]), 1) / length[:, None]
        angle = self.first[which] + part * self.sweep[which]
        out = np.stack((np.cos(angle), np.sin(angle)), 1) * np.sign(self.sweep[which])[:, None]
        return np.where(self.is_arc[which, None], out, line)

    def samples(self, spacing: Floats | float, least: int) -> tuple[Whole, Floats]:
        """Pieces and parts of them: both ends, and places no further apart than `spacing`, at least `least` spaces;
        on an arc one for every 15 degrees besides."""
        turns = np.ceil(np.abs(self.sweep) / (pi / 12)) * self.is_arc
        count = np.maximum(np.maximum(np.ceil(self.length / spacing), turns), least).astype(np.int64)
        which = np.repeat(np.arange(len(count)), count + 1)
        first = np.repeat(np.cumsum(count + 1) - count - 1, count + 1)
        return which, (np.arange(len(which)) - first) / count[which]

    def from_place(self, places: Floats, which: Whole) -> Floats:
        """Distance of each place from its piece."""
        to = places - self.start[which]
        way = self.end[which] - self.start[which]
        square = np.maximum((way**2).sum(1), 1e-300)
        part = np.clip((to * way).sum(1) / square, 0, 1)
        line = np.hypot(*(to - part[:, None] * way).T)
        about = places - self.centre[which]
        far = np.hypot(about[:, 0], about[:, 1])
        ahead = (np.arctan2(about[:, 1], about[:, 0]) - self.first[which]) * np.sign(self.sweep[which])
        inside = np.mod(ahead, 2 * pi) <= np.abs(self.sweep[which])
        ends = np.minimum(np.hypot(*to.T), np.hypot(*(places - self.end[which]).T))
        arc = np.where(inside, np.abs(far - self.radius[which]), ends)
        return np.where(self.is_arc[which], arc, line)

    def from_carrier(self, places: Floats, which: Whole) -> Floats:
        """Distance of each place from the whole line or circle that its piece lies on."""
        to = places - self.start[which]
        way = self.end[which] - self.start[which]
        length = np.maximum(np.hypot(way[:, 0], way[:, 1]), 1e-300)
        line = np.abs(to[:, 0] * way[:, 1] - to[:, 1] * way[:, 0]) / length
        about = places - self.centre[which]
        arc = np.abs(np.hypot(about[:, 0], about[:, 1]) - self.radius[which])
        return np.where(self.is_arc[which], arc, line)

    def nearest(self, places: Floats, owners: Whole, reach: float) -> Nearest:
        """What lies within `reach` of each of m places; `owners`: whose each place is."""
        found = Nearest(
            np.full(len(places), np.inf),
            np.full(len(places), -1),
            np.full(len(places), np.inf),
            np.full(len(places), -1),
        )
        if not len(self.length) or not len(places):
            return found
        cell = max(1.5 * reach, float(self.length.sum()) / _MOST_CELLS, 1e-6)
        which, part = self.samples(cell / 2, 1)
        laid = self.at(which, part)
        corner = np.minimum(laid.min(0), places.min(0)) - 2 * cell
        width = int((max(laid[:, 1].max(), places[:, 1].max()) - corner[1]) / cell) + 4

        def cells(of: Floats) -> Whole:
            column, row = np.floor((of - corner) / cell).astype(np.int64).T
            return column * width + row

        # Each piece once in every cell that it passes.
        keys, piece = np.divmod(np.unique(cells(laid) * len(self.length) + which), len(self.length))
        around = np.array([i * width + j for i in (-1, 0, 1) for j in (-1, 0, 1)])
        wanted = (cells(places)[:, None] + around).ravel()
        first, last = np.searchsorted(keys, wanted), np.searchsorted(keys, wanted, "right")
        counts = last - first
        ends = np.cumsum(counts.reshape(-1, 9).sum(1))
        low = 0
        while low < len(places):
            high = max(low + 1, int(np.searchsorted(ends, (ends[low - 1] if low else 0) + _BATCH, "right")))
            self._look(places, owners, piece, first[9 * low : 9 * high], counts[9 * low : 9 * high], low, found)
            low = high
        return found

    def _look(
        self, places: Floats, owners: Whole, piece: Whole, first: Whole, counts: Whole, low: int, found: Nearest
    ) -> None:
        """Measure pairs of places and pieces: those of the places from number `low` on."""
        place = np.repeat(low + np.arange(len(counts)) // 9, counts)
        offset = np.arange(len(place)) - np.repeat(np.cumsum(counts) - counts, counts)
        which = piece[np.repeat(first, counts) + offset]
        far = self.from_place(places[place], which)
        own = self.owner[which] == owners[place]
        for mask, distance, at in ((own, found.own, found.own_at), (~own, found.other, found.other_at)):
            # The last of several writes to one place stands: so the nearest is written last.
            order = np.argsort(-far[mask], kind="stable")
            chosen = place[mask][order]
            distance[chosen] = far[mask][order]
            at[chosen] = which[mask][order]


def _row(piece: Piece, owner: int) -> tuple[float, ...]:
    if piece.centre is None:
        return (*piece.start, *piece.end, 0.0, 0.0, 0.0, 0.0, 0.0, owner)
    return (*piece.start, *piece.end, *piece.centre, piece.radius, piece.angles[0], piece.sweep, owner)
