"""Contours of a drawing that was saved anew, found again by a place on them and by their size."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import hypot, inf

import numpy as np
import shapely

from skg.geometry.arrays import Floats
from skg.geometry.contour import Contour, Edge
from skg.geometry.edge_arrays import boxes_of
from skg.geometry.plane import XY, shifted
from skg.job.job import Box, Chosen
from skg.job.wanted import Overrides

#: A contour is no farther from where it was than this, mm, or than this part of its width and height; it is so many
#: times as near as the next one.
_LEAST, _PART, _CLEARLY = 0.5, 0.1, 2.0
#: A contour that was found farther away than this, mm, or than this part of its width and height, is to be confirmed.
_DOUBTED, _DOUBTED_PART = 0.5, 0.02
#: A drawing whose box has moved by less has not moved; one whose corners moved by the same, to this, has moved as a
#: whole, mm.
_STILL = 0.01
#: A place in a job has so many decimals; so many edges of a contour are tried for one that tells it from others.
_DECIMALS, _TRIED = 6, 8


@dataclass(frozen=True)
class Match:
    """A chosen contour in the drawing. `number`: its own there, None where it is lost; `moved`: how far it has moved
    and grown, mm; `shift`: how far a part of the drawing has moved that it is in, mm; `is_doubtful`: somebody should
    look at it."""

    number: int | None = None
    moved: float = 0.0
    shift: XY = (0.0, 0.0)
    is_doubtful: bool = False


@dataclass(frozen=True)
class Matches:
    """The match of every chosen contour; `shift`: the movement of the whole drawing, mm."""

    found: tuple[Match, ...] = ()
    shift: XY = (0.0, 0.0)

    @property
    def lost(self) -> list[int]:
        """The chosen contours that are not there, by their places in the job."""
        return [index for index, match in enumerate(self.found) if match.number is None]


class Known:
    """The contours of a drawing, as they are looked for. `kinds`: what each is, one of `KINDS`."""

    def __init__(self, contours: Sequence[Contour], kinds: Sequence[str]) -> None:
        self.contours, self.kinds = contours, np.array(kinds)
        self.boxes, _ = boxes_of(contours)
        self.sizes = self.boxes[:, 2:] - self.boxes[:, :2]
        self._rounded = np.round(self.sizes, _DECIMALS).tolist()
        self.layers = [{layer.lower() for layer in contour.layers} for contour in contours]
        self._tree = shapely.STRtree(shapely.box(*self.boxes.T))

    @property
    def box(self) -> Box:
        """The box around all contours."""
        (left, low), (right, high) = self.boxes[:, :2].min(0).tolist(), self.boxes[:, 2:].max(0).tolist()
        return left, low, right, high

    def find(self, chosen: Sequence[Chosen], box: Box | None) -> Matches:
        """Find contours of a drawing that had a box: where they were, or where they are when all of it has moved.

        Where one corner of the box has moved, those that are lost may have moved with it: these are doubtful.
        """
        matches = self._matches(chosen, box)
        judged = (replace(match, is_doubtful=self._is_doubtful(match)) for match in matches.found)
        return replace(matches, found=tuple(judged))

    def _matches(self, chosen: Sequence[Chosen], box: Box | None) -> Matches:
        still = self._all_found(chosen, (0.0, 0.0))
        if box is None:
            return Matches(still)
        left, low, right, high = (now - then for now, then in zip(self.box, box, strict=True))
        moves = [move for move in ((left, low), (right, high)) if hypot(*move) > _STILL]
        if len(moves) == 2 and hypot(left - right, low - high) <= _STILL:
            whole = Matches(self._all_found(chosen, moves[0]), moves[0])
            return min(whole, Matches(still), key=lambda matches: len(matches.lost))
        matches = list(still)
        for move in moves:
            taken = {match.number for match in matches}
            for index, match in enumerate(self._all_found(chosen, move)):
                if matches[index].number is None and match.number not in taken:
                    matches[index] = replace(match, moved=match.moved + hypot(*move))
        return Matches(tuple(matches))

    def _all_found(self, chosen: Sequence[Chosen], shift: XY) -> tuple[Match, ...]:
        """Find each by itself; of two that are the same contour the nearer one is, where it clearly is."""
        matches = [_clear(costs, shift) for costs in self._costs(chosen, shift)]
        claims: dict[int, list[tuple[float, int]]] = {}
        for index, match in enumerate(matches):
            if match.number is not None:
                claims.setdefault(match.number, []).append((match.moved, index))
        for claim in claims.values():
            winner = _clear(sorted(claim), shift).number
            for _, index in claim:
                if index != winner:
                    matches[index] = Match()
        return tuple(matches)

    def _costs(self, chosen: Sequence[Chosen], shift: XY) -> list[list[tuple[float, int]]]:
        """Distances of contours from the places and differences of their sizes: the sum, mm, and the number of each
        that may be meant or taken for it, the nearest first."""
        costs: list[list[tuple[float, int]]] = [[] for _ in chosen]
        for (index, number), more in self._near(chosen, shift).items():
            if chosen[index].layer.lower() in self.layers[number]:
                far = min(edge.far(shifted(chosen[index].place, shift)) for edge in self.contours[number].edges)
                costs[index].append((far + more, number))
        limits = _limits(np.array([choice.size for choice in chosen], float).reshape(-1, 2)).tolist()
        # (the nearest is too far: none is meant)
        return [
            sorted(pairs) if pairs and min(pairs)[0] <= most else [] for pairs, most in zip(costs, limits, strict=True)
        ]

    def _near(self, chosen: Sequence[Chosen], shift: XY) -> dict[tuple[int, int], float]:
        """Those that are chosen, by their numbers, with each contour of that kind that is near and about as large: the
        difference of their sizes, mm."""
        if not chosen:
            return {}
        places = np.array([choice.place for choice in chosen], float) + shift
        sizes = np.array([choice.size for choice in chosen], float)
        reach = _CLEARLY * _limits(sizes)
        indices, numbers = self._tree.query(
            shapely.box(*(places - reach[:, None]).T, *(places + reach[:, None]).T), predicate="intersects"
        )
        grown = np.abs(self.sizes[numbers] - sizes[indices]).sum(1)
        kinds = np.array([choice.kind for choice in chosen])
        close = np.flatnonzero((grown <= reach[indices]) & (self.kinds[numbers] == kinds[indices]))
        pairs = zip(indices[close].tolist(), numbers[close].tolist(), strict=True)
        return dict(zip(pairs, grown[close].tolist(), strict=True))

    def _is_doubtful(self, match: Match) -> bool:
        if match.number is None:
            return False
        return match.moved > max(_STILL, min(_DOUBTED, _DOUBTED_PART * float(self.sizes[match.number].sum())))

    def choose(self, number: int, overrides: Overrides) -> Chosen:
        """Describe a contour by the middle of its longest edge, or of another one that tells it from its neighbours."""
        best: tuple[float, Chosen] | None = None
        for edge in sorted(self.contours[number].edges, key=lambda edge: -edge.length)[:_TRIED]:
            candidate = self._by(number, edge, overrides)
            clear = _clear_of(self._costs([candidate], (0.0, 0.0))[0], number)
            if best is None or clear > best[0]:
                best = clear, candidate
            if clear >= _LEAST:
                break
        assert best  # (a contour has edges)
        return best[1]

    def choose_all(self) -> list[Chosen]:
        """Describe all contours, as `choose` does, with no settings."""
        none = Overrides()
        chosen = [
            self._by(number, max(contour.edges, key=lambda edge: edge.length), none)
            for number, contour in enumerate(self.contours)
        ]
        # (most have nothing beside them that they could be taken for)
        near = sorted({index for index, number in self._near(chosen, (0.0, 0.0)) if index != number})
        costs = self._costs([chosen[number] for number in near], (0.0, 0.0))
        for number, cost in zip(near, costs, strict=True):
            if _clear_of(cost, number) < _LEAST:
                chosen[number] = self.choose(number, none)
        return chosen

    def _by(self, number: int, edge: Edge, overrides: Overrides) -> Chosen:
        """A contour by the middle of one of its edges."""
        x, y = (round(ordinate, _DECIMALS) + 0.0 for ordinate in edge.at(0.5))
        width, height = self._rounded[number]
        return Chosen(self.contours[number].layers[0], str(self.kinds[number]), (x, y), (width, height), overrides)


def _clear_of(costs: Sequence[tuple[float, int]], number: int) -> float:
    """Distance of the nearest of some, without one."""
    return min((cost for cost, other in costs if other != number), default=inf)


def _limits(sizes: Floats) -> Floats:
    """Largest distance, mm, at which contours of some sizes are still matched."""
    return np.maximum(_LEAST, _PART * sizes.sum(1))


def _clear(costs: Sequence[tuple[float, int]], shift: XY) -> Match:
    """The nearest of some, if it is clearly nearer than the next one."""
    if not costs or len(costs) > 1 and (_CLEARLY * costs[0][0] > costs[1][0] or costs[0][0] == costs[1][0]):
        return Match()
    moved, number = costs[0]
    return Match(number, moved, shift)
