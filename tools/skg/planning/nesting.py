"""Contours that are cut without what lies around them: openings of a part, or parts in a frame (shapely)."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from skg.geometry.areas import areas_of
from skg.geometry.contour import Contour
from skg.geometry.edge_arrays import points_of
from skg.geometry.field import Field
from skg.geometry.holding import Holding
from skg.messages.finding import Finding, Phrase
from skg.planning.gaps import Gap, nearly_closed

#: One that is no larger than this is the same contour, drawn on another layer.
_SAME = 1.001
#: So much of a contour's area lies in what is around it.
_WITHIN = 0.1
#: Contours that a line of the report names.
_PLACES = 5


class Around(NamedTuple):
    """An uncut contour around another: its layers, and whether it is taken for a frame; `gap`: the widest one of open
    lines, which nothing is taken for."""

    layers: tuple[str, ...]
    is_frame: bool
    gap: Gap | None = None


@dataclass
class Nesting:
    """Contours, and what lies in what. `depths`: how many lie around each, an uncut outline among these; `around`: the
    uncut contours that some lie in, see `around_all`; `beside`: those of copies, which a start hole keeps off, too."""

    contours: Sequence[Contour]
    depths: list[int]
    around: dict[int, Around]
    beside: Sequence[Contour] = ()
    _holding: Holding | None = None
    _field: Field | None = None

    @classmethod
    def of(cls, contours: Sequence[Contour], others: Sequence[Contour] = (), opened: Sequence[Contour] = ()) -> Nesting:
        """Find what lies in what; `others`: closed contours on layers that are not cut; `opened`: open lines of all
        layers."""
        holding = Holding(contours)
        depths = holding.depths()
        around = around_all(contours, depths, others, opened)
        if openings := [number for number, outer in around.items() if not (outer.is_frame or outer.gap)]:
            depths = deeper(contours, depths, openings)
        return cls(contours, depths, around, (), holding)

    @property
    def holding(self) -> Holding:
        """The contours around places."""
        self._holding = self._holding or Holding(self.contours)
        return self._holding

    @property
    def field(self) -> Field:
        """Distances to the contours."""
        if self._field is None:
            points, first = self.holding.points, self.holding.first
            if self.beside:
                more, counts = points_of(self.beside)
                points, first = np.concatenate((points, more)), np.append(first, first[-1] + np.cumsum(counts))
            self._field = Field(points, first)
        return self._field

    def release(self) -> None:
        """Give back the memory of both, as much as all contours take; they are made anew when they are asked for."""
        self._holding = self._field = None

    def kind(self, number: int) -> str:
        """A contour's kind: "outline", "opening" or "open"."""
        if not self.contours[number].is_closed:
            return "open"
        return "opening" if self.depths[number] % 2 else "outline"


def around_all(
    contours: Sequence[Contour], depths: Sequence[int], others: Sequence[Contour], opened: Sequence[Contour]
) -> dict[int, Around]:
    """The outermost of the contours (by their numbers) that lie in others, which are not cut: in the smallest of these;
    and in open lines that are nearly closed, but for what these are a frame of.

    `depths`: how many of the contours lie around each. In a frame at least half of them have openings themselves.
    """
    outer = [number for number, contour in enumerate(contours) if contour.is_closed and not depths[number]]
    gaps = list(nearly_closed(opened)) if outer else []
    if not outer or not (others or gaps):
        return {}
    areas = areas_of([contours[number] for number in outer])
    inner = [
        *others,
        *(contour for contour, depth in zip(contours, depths, strict=True) if depth and contour.is_closed),
    ]
    inner_indices, outer_indices = shapely.STRtree(areas).query(places_in(inner), predicate="within")
    sizes = shapely.area(areas)
    held = set(outer_indices[shapely.area(areas_of(inner))[inner_indices] < sizes[outer_indices]].tolist())
    closed = _frames(_holders(areas, areas_of(list(others))), held)
    nearly = _frames(_holders(areas, np.array([line.area for line in gaps], object)), held)
    around = {
        outer[inner]: Around(gaps[whole].layers, False, gaps[whole].gap)
        for inner, (whole, is_frame) in nearly.items()
        if not is_frame
    }
    return around | {
        outer[inner]: Around(others[whole].layers, is_frame) for inner, (whole, is_frame) in closed.items()
    }


def _holders(areas: NDArray[Any], wholes: NDArray[Any]) -> dict[int, int]:
    """Of each area that lies in some of the wholes, which are larger, the smallest of these; all by their numbers."""
    sizes, large = shapely.area(areas), shapely.area(wholes)
    firsts, seconds = shapely.STRtree(wholes).query(areas, predicate="intersects")
    is_in = large[seconds] > _SAME * sizes[firsts]
    firsts, seconds = firsts[is_in], seconds[is_in]
    is_in = shapely.area(shapely.intersection(areas[firsts], wholes[seconds])) > _WITHIN * sizes[firsts]
    holder: dict[int, int] = {}
    for inner, whole in zip(firsts[is_in].tolist(), seconds[is_in].tolist(), strict=True):
        holder[inner] = min(whole, holder.get(inner, whole), key=large.__getitem__)
    return holder


def _frames(holder: Mapping[int, int], held: Container[int]) -> dict[int, tuple[int, bool]]:
    """The holder of each, and if it is a frame: at least half of its contours have openings, are `held`."""
    inside = Counter(holder.values())
    with_openings = Counter(whole for inner, whole in holder.items() if inner in held)
    return {inner: (whole, 2 * with_openings[whole] >= inside[whole]) for inner, whole in holder.items()}


def deeper(contours: Sequence[Contour], depths: Sequence[int], openings: Sequence[int]) -> list[int]:
    """The depths; of some outermost contours and all that lies in them one more."""
    deepened = list(depths)
    areas = areas_of([contours[number] for number in openings])
    inner = [number for number, depth in enumerate(depths) if depth]
    held, _ = shapely.STRtree(areas).query(places_in([contours[number] for number in inner]), predicate="within")
    for number in (*openings, *(inner[k] for k in np.unique(held).tolist())):
        deepened[number] += 1
    return deepened


def places_in(contours: Sequence[Contour]) -> np.ndarray:
    """A place in each closed contour, and on each open one, as shapely's points."""
    places = shapely.points(np.array([contour.edges[0].at(0.5) for contour in contours], float).reshape(-1, 2))
    if closed := [number for number, contour in enumerate(contours) if contour.is_closed]:
        places[closed] = shapely.point_on_surface(areas_of([contours[number] for number in closed]))
    return places


def findings(around: Iterable[tuple[int, Around | None]]) -> Iterator[Finding]:
    """Report contours, by their numbers in the order of cutting, that lie in an uncut contour."""
    groups: dict[Around, list[int]] = defaultdict(list)
    for number, outer in around:
        if outer:
            groups[outer].append(number)
    for outer, numbers in groups.items():
        about: dict[str, Any] = {"count": len(numbers), "contours": in_brackets(numbers), "layers": tuple(outer.layers)}
        if outer.gap:
            yield Finding("outlines-in-open-line", gap=outer.gap.width, place=outer.gap.place, **about)
        else:
            yield Finding("outlines-in-frame" if outer.is_frame else "openings-in-part", **about)


def in_brackets(numbers: Sequence[int]) -> Phrase:
    """Some contours, the first ones by their numbers."""
    rest = " …" * (len(numbers) > _PLACES)
    return Phrase("contours-in-brackets", numbers=tuple(numbers[:_PLACES]), rest=rest)
