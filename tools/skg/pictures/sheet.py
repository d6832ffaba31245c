"""The setup sheet: what the shop needs beside the machine, on one page."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import date
from math import ceil, cos, pi, sin
from typing import Any, overload
from unicodedata import east_asian_width

import numpy as np
import shapely
from matplotlib import path as paths
from matplotlib.collections import PathCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle, PathPatch, Polygon
from matplotlib.transforms import Affine2D

from skg.checking.check import nominal
from skg.cutting.holes import holes_of
from skg.cutting.ladder import CutResult
from skg.cutting.manner import manners, stops
from skg.cutting.report import pace
from skg.geometry.arrays import numbers_up_to
from skg.geometry.contour import Places
from skg.geometry.plane import XY, distance
from skg.messages.finding import Finding, Phrase
from skg.messages.render import speech, text
from skg.pictures.page import as_it_stands, installed, save
from skg.pictures.plot import FEW, outlines
from skg.planning.planned import PlannedContour, kind_of
from skg.tape.layout import Laid
from skg.tape.simulation import duration
from skg.wording import short, shown, visible

#: The page lies on its side: A4, and A3 where A4 has no room for the table; mm.
_A4, _A3 = (297.0, 210.0), (420.0, 297.0)
_INCH = 25.4
_MARGIN, _HEAD = 10.0, 26.0
#: A row of the table, a column of it; a line of the notes under it; all mm.
_ROW, _COLUMN, _NOTE = 2.9, 54.0, 3.4
#: Room for dimensions left of the part and under it, for numbers right of it and above.
_AROUND, _BESIDE = 15.0, 7.0
#: Right edges of a column's cells, the left one of the fourth, mm.
_CELLS = (5.5, 16.9, 28.3, 29.5, 45.0, 53.5)
#: A table of no more rows than this has letters that are so much larger.
_ROWS, _LARGER = 30, 1.3
#: The table takes no more of the page's width than this part, where it stands beside the drawing.
_WIDEST = 0.52
#: Manners of cutting that are told in words, two in a line.
_MANNERS = 8
#: The largest mark of a start hole (its radius), the largest arrow; all mm on the paper.
_HOLE, _ARROW = 1.1, 1.8
#: Of these scales the largest at which the part fits is taken.
_SCALES = (
    *(float(m * p) for p in (100, 10, 1) for m in (5, 4, 3, 2.5, 2, 1.5, 1)),
    *(1 / (m * p) for p in (1, 10, 100, 1000) for m in (1.5, 2, 2.5, 3, 4, 5, 7.5, 10)),
)
#: So many numbers are looked for room on the drawing, all stand in the table.
_MOST_NUMBERS = 1000
#: Numbers are looked for room on a grid of this, mm, no further from their holes than the second.
_GRID, _FAR = 0.4, 14.0
#: A number this much further from its hole than the nearest place stands alone beside it, or has a line to it.
_ALONE = 1.7
#: The letters of numbers, points of a font; no letters on the page are smaller than the second.
_FONT, _LEAST = 6.0, 5.0
#: Ways from a hole to its number, in the order in which they are tried.
_AROUND_A_HOLE = np.array([(cos(pi / 4 + turn * pi / 6), sin(pi / 4 + turn * pi / 6)) for turn in range(12)])
#: So many straight lines are laid on the grid at once.
_LINES = 100_000
#: Letters of a fact at the foot of the page.
_FACT = 6.5
#: A point of a font in mm; how wide a character is, in font sizes.
_POINT, _WIDE = _INCH / 72, 0.62
#: The starts of steps along places, and their ends.
_STEPS = (slice(None, -1), slice(1, None))
_INK, _WIRE, _MARK, _GREY = "#000000", "#0072b2", "#d55e00", "#777777"


@dataclass(frozen=True)
class Facts:
    """Facts for the sheet's foot: the drawing's name, the tape's, the units, how many times as large it is cut; area
    and price."""

    drawing: str
    tape: str
    units: str
    scale: float = 1.0
    cost: tuple[Finding, ...] = ()


@dataclass(frozen=True)
class _TableForm:
    """The form of the table of start holes: columns, rows in each, whether it stands beside the drawing or under it."""

    columns: int
    rows: int
    is_beside: bool


class _Taken:
    """The places of the page that are taken, on a grid."""

    def __init__(self, size: XY) -> None:
        self.cells = np.zeros((int(size[0] / _GRID) + 2, int(size[1] / _GRID) + 2), bool)

    def along(self, places: np.ndarray) -> None:
        """Take what a line passes; places no further apart than the grid."""
        self.cells[self._passed(places)] = True

    def _passed(self, places: np.ndarray) -> tuple[np.ndarray, ...]:
        """The cells in which places are."""
        return tuple(np.clip((places / _GRID).astype(int), 0, np.array(self.cells.shape) - 1).T)

    def _corners(self, places: np.ndarray, behind: int) -> np.ndarray:
        """The cells of places, or those `behind` them, as ends of slices."""
        return np.clip((places / _GRID).astype(int) + behind, 0, self.cells.shape)

    def is_free_along(self, places: np.ndarray) -> bool:
        """Tell whether nothing is where a line passes; places no further apart than the grid."""
        return not self.cells[self._passed(places)].any()

    def are_free(self, low: np.ndarray, high: np.ndarray) -> np.ndarray:
        """In which of some boxes, near to each other, nothing is; their lower and upper corners (n × 2)."""
        low, high = self._corners(low, 0), self._corners(high, 1)
        first, last = low.min(axis=0), high.max(axis=0)
        window = self.cells[first[0] : last[0], first[1] : last[1]]
        # Counts of taken cells below and left of each: four of these sums give the count in a box.
        sums = np.zeros((window.shape[0] + 1, window.shape[1] + 1), int)
        sums[1:, 1:] = window.cumsum(axis=0, dtype=int).cumsum(axis=1)
        (left, bottom), (right, top) = (low - first).T, (high - first).T
        return sums[right, top] - sums[left, top] - sums[right, bottom] + sums[left, bottom] == 0

    def take(self, low: np.ndarray, high: np.ndarray) -> None:
        """Take a box."""
        (left, bottom), (right, top) = self._corners(low, 0), self._corners(high, 1)
        self.cells[left:right, bottom:top] = True


class _Marks:
    """The marks of the start holes: their places on the page (n × 2) and radii, mm."""

    def __init__(self, places: np.ndarray, radii: np.ndarray) -> None:
        self.places, self.radii = places, radii
        self._tree = shapely.STRtree(shapely.points(places))

    def are_alone(self, number: int, middles: np.ndarray, half: np.ndarray) -> np.ndarray:
        """Mark the boxes (middles, n × 2; half their sides) that are clearly nearer to a mark than to others."""
        if not len(middles):
            return np.zeros(0, bool)
        reach = half + self.radii[number] + 2 * _ALONE + 2.2
        near = self._tree.query(shapely.box(*(middles.min(0) - reach), *(middles.max(0) + reach)))
        near = near[np.any(self.places[near] != self.places[number], axis=1)]
        apart = [self._distance(other, middles, half) for other in near]
        return self._distance(number, middles, half) + 0.3 < np.min(apart, axis=0, initial=np.inf)

    def _distance(self, number: int, middles: np.ndarray, half: np.ndarray) -> np.ndarray:
        """Distance of boxes from a mark."""
        beside = np.maximum(np.abs(self.places[number] - middles) - half, 0)
        return np.hypot(*beside.T) - self.radii[number]


class SetupSheet:
    """A page with a cut on it."""

    def __init__(self, result: CutResult, facts: Facts) -> None:
        self.result, self.facts = result, facts
        self.manners = manners(result.contours)
        self.notes = self._notes()
        #: The start holes, each with its contour.
        self.holes = [(hole, planned) for planned in result.contours for hole in planned.holes]
        rows = len(self.holes)
        self.foot = _MARGIN + _HEAD + len(self.notes) * _NOTE
        per_column = [self._rows_in(page[1] - _MARGIN - self.foot) for page in (_A4, _A3)]
        self.page = _A4 if rows <= 2 * per_column[0] else _A3
        self.larger = _LARGER if rows <= _ROWS else 1.0
        most = int(_WIDEST * self.page[0] / _COLUMN)
        in_column = per_column[self.page == _A3]
        beside = _TableForm(max(1, min(most, ceil(rows / in_column))), in_column, is_beside=True)
        wide = int((self.page[0] - 2 * _MARGIN) / (self.larger * _COLUMN))
        under = _TableForm(min(wide, rows), ceil(rows / wide), is_beside=False)
        self._measure()
        # (a long part has more room above the table)
        self.table = max(beside, under, key=self._scale_beside)
        self.figure = Figure(figsize=(self.page[0] / _INCH, self.page[1] / _INCH))
        self.axes = self.figure.add_axes((0, 0, 1, 1))
        self.axes.set_xlim(0, self.page[0])
        self.axes.set_ylim(0, self.page[1])
        self.axes.axis("off")
        # Cells that texts stay off; cells that lines from numbers to holes stay off: other numbers, holes, such lines.
        self.taken, self.marked = _Taken(self.page), _Taken(self.page)
        self._place()

    def draw(self) -> None:
        """Draw everything."""
        self._part()
        self._wire()
        self._dimensions()
        left_out = self._mark_holes()
        self._draw_table()
        self._title(left_out)

    @staticmethod
    def _rows_in(height: float) -> int:
        """Number of rows that fit below the head of the table."""
        return int((height - 2) / _ROW) - 1

    def _notes(self) -> list[list[str]]:
        """Text under the drawing: stops of the machine, and the manners in words, two in a line."""
        texts = [f"{_letters(index)}: {text(manner.phrase)}" for index, manner in enumerate(self.manners)]
        if len(texts) > _MANNERS:
            texts[_MANNERS:] = [text(Phrase("sheet-more-manners", count=len(texts) - _MANNERS))]
        lines = [texts[index : index + 2] for index in range(0, len(texts), 2)]
        if reasons := tuple(stops(self.result.contours)):
            lines.insert(0, [text(Phrase("two-stops", reasons=reasons))])
        if self.facts.cost:
            lines.insert(0, [text(finding) for finding in self.facts.cost])
        return lines

    def _measure(self) -> None:
        """Measure the part, and the part with its start holes."""
        pieces = [piece for planned in self.result.contours for piece in nominal(planned)]
        self.curve = outlines(pieces)
        points = np.array([point for piece in pieces for point in piece.extremes()])
        # (a bound of -1e-17 is 0)
        self.low, self.high = (tuple(np.round(bound, 6) + 0.0) for bound in (points.min(0), points.max(0)))
        holes = np.array([hole for hole, _ in self.holes] + [self.low, self.high])
        self.least, self.most = holes.min(0), holes.max(0)

    def _room(self, table: _TableForm) -> tuple[float, float]:
        """Width and height that a table leaves to the drawing, mm."""
        wide, high = self.page[0] - 2 * _MARGIN, self.page[1] - _MARGIN - self.foot
        if table.is_beside:
            wide -= table.columns * _COLUMN * self.larger
        else:
            high -= self._height(table)
        return wide - _AROUND - _BESIDE, high - _AROUND - _BESIDE

    def _height(self, table: _TableForm) -> float:
        return (table.rows + 2) * _ROW * self.larger

    def _scale_beside(self, table: _TableForm) -> float:
        """The scale of the drawing beside a table."""
        size = [max(b - a, 1e-3) for a, b in zip(self.least, self.most, strict=True)]
        fits = min(max(space, 1.0) / side for space, side in zip(self._room(table), size, strict=True))
        return next((scale for scale in _SCALES if scale <= fits), fits)

    def _place(self) -> None:
        """Place the part on the page, with its scale."""
        self.scale = self._scale_beside(self.table)
        corner = _MARGIN + _AROUND, self.foot + _AROUND + (0 if self.table.is_beside else self._height(self.table))
        self.shift = tuple(
            start + space / 2 - self.scale * (a + b) / 2
            for start, space, a, b in zip(corner, self._room(self.table), self.least, self.most, strict=True)
        )

    @overload
    def on_paper(self, place: XY) -> XY: ...
    @overload
    def on_paper(self, place: tuple[np.ndarray, np.ndarray]) -> tuple[np.ndarray, np.ndarray]: ...
    def on_paper(self, place: Any) -> Any:  # noqa: ANN401 (numbers, or columns of them)
        """A place of the part on the page, mm; numbers, or columns of them."""
        return place[0] * self.scale + self.shift[0], place[1] * self.scale + self.shift[1]

    def _all_on_paper(self, places: Iterable[XY]) -> np.ndarray:
        """Places of the part on the page (n × 2), mm."""
        x, y = np.array(list(places), float).reshape(-1, 2).T
        return np.column_stack(self.on_paper((x, y)))

    def _patch(self, curve: paths.Path, unit: float, **look: object) -> None:
        to_page = Affine2D().scale(unit * self.scale).translate(*self.shift)
        # (add_patch would look for the bounds of every curve)
        self.axes.add_artist(PathPatch(curve, fill=False, transform=to_page + self.axes.transData, **look))

    def _lines(self, places: np.ndarray, **look: object) -> None:
        """Draw lines through as many places of the page each (n × places × 2), all as one curve."""
        codes = [paths.Path.MOVETO, *[paths.Path.LINETO] * (places.shape[1] - 1)]
        curve = paths.Path(places.reshape(-1, 2), np.tile(codes, len(places)))
        self.axes.add_artist(PathPatch(curve, fill=False, joinstyle="round", **look))

    def _part(self) -> None:
        self._patch(self.curve, 1.0, edgecolor=_INK, linewidth=0.7, zorder=3, gid="part")
        lines = [edge.points() for planned in self.result.contours for edge in planned.contour.edges]
        starts = self._all_on_paper(place for points in lines for place in points[:-1])
        self._take_lines(starts, self._all_on_paper(place for points in lines for place in points[1:]))

    def _take_lines(self, starts: np.ndarray, ends: np.ndarray) -> None:
        """Take what straight lines between places of the page (n × 2) pass."""
        for first in range(0, len(starts), _LINES):
            begin, vectors = (part[first : first + _LINES] for part in (starts, ends - starts))
            count = (np.hypot(*vectors.T) / _GRID * 1.5).astype(int) + 2
            owners = np.repeat(np.arange(len(vectors)), count)
            part = numbers_up_to(count) / (count[owners] - 1)
            self.taken.along(begin[owners] + part[:, None] * vectors[owners])

    def _wire(self) -> None:
        """The wire's path, the moves between start holes, an arrow on each contour."""
        laid = self.result.checked.followed.laid
        cuts = [part for cut in self.result.checked.cuts if len(part := laid[cut.blocks])]
        if cuts:
            curve = outlines(Laid.joined(cuts))
            self._patch(curve, 0.001, edgecolor=_WIRE, linewidth=0.3, zorder=2, gid="wire")
            # (the leads lie beside the contours)
            starts, ends = (
                self._all_on_paper(np.concatenate([places[[0, -1]] for places in side]) / 1000)
                for side in ([cut.starts for cut in cuts], [cut.ends for cut in cuts])
            )
            self._take_lines(starts, ends)
            if any(abs(planned.widest) * self.scale > _GRID for planned in self.result.contours):
                # (elsewhere the wire's path is where the part's lines are)
                tenths = Affine2D().scale(0.001 * self.scale).translate(*self.shift).scale(10)
                path = [np.asarray(places, float) / 10 for places in curve.to_polygons(tenths, closed_only=False)]
                self._take_lines(*(np.concatenate([places[rows] for places in path]) for rows in _STEPS))
        holes = self._all_on_paper(hole for hole, _ in self.holes)
        moves = np.stack([holes[:-1], holes[1:]], axis=1)
        self._lines(moves, edgecolor=_GREY, linewidth=0.3, linestyle=(0, (6, 4)), zorder=1, gid="moves")
        arrows = [arrow for planned in self.result.contours if (arrow := self._arrow(planned))]
        if arrows:
            places = np.array(arrows)
            self._lines(places, edgecolor=_WIRE, linewidth=0.7, capstyle="projecting", zorder=4, gid="arrows")
            self._take_lines(*(places[:, rows].reshape(-1, 2) for rows in _STEPS))

    def _arrow(self, planned: PlannedContour) -> list[XY]:
        """An arrow on the longest edge of a contour shows the way and covers nothing: it is open and thin. None where
        it would be too small."""
        edge = max(planned.chain, key=lambda edge: edge.length)
        size = min(_ARROW, self.scale * min(edge.length / (10 if edge.is_circle else 4), planned.room))
        if size <= 0.3:
            return []
        x, y = self.on_paper(edge.at(0.5))
        direction = edge.direction(0.5) if not edge.nodes else _way(edge.samples)
        ends = [(x - size * cos(direction + turn), y - size * sin(direction + turn)) for turn in (0.4, -0.4)]
        return [ends[0], (x, y), ends[1]]

    def _dimensions(self) -> None:
        """Width and height of the part, and where its lower left corner lies on the drawing."""
        (left, bottom), (right, top) = self.on_paper(self.low), self.on_paper(self.high)
        holes = [self.on_paper(hole) for hole, _ in self.holes]
        under = min(bottom, *(y for _, y in holes)) - 6
        beside = min(left, *(x for x, _ in holes)) - 6
        width, height = self.high[0] - self.low[0], self.high[1] - self.low[1]
        self._dimension((left, under), (right, under), (left, bottom), (right, bottom), f"{short(width)}")
        self._dimension((beside, bottom), (beside, top), (left, bottom), (left, top), f"{short(height)}")
        corner, size = text(Phrase("sheet-corner", place=self.low)), 5
        half = self._half_a_box(corner, size)
        self._text((left, under - 5.2), corner, size, _GREY)
        low, high = (left, under - 5.2 - half[1]), (left + 2 * half[0], under - 5.2 + 2 * half[1])
        self.taken.take(np.array(low), np.array(high))

    def _dimension(self, first: XY, second: XY, from_first: XY, from_second: XY, text: str) -> None:
        for p, q in ((first, second), (first, from_first), (second, from_second)):
            self.axes.plot(*zip(p, q, strict=True), color=_GREY, linewidth=0.35, zorder=1)
            self._take_lines(np.array([p]), np.array([q]))
        length, is_flat = distance(first, second), first[1] == second[1]
        size = min(1.6, length / 3)
        for tip, direction in ((first, 0.0), (second, pi)):
            direction += 0 if is_flat else pi / 2
            sides = [
                (tip[0] + size * cos(direction + turn), tip[1] + size * sin(direction + turn)) for turn in (0.25, -0.25)
            ]
            self.axes.add_patch(Polygon([tip, *sides], facecolor=_GREY, edgecolor="none"))
        middle = (first[0] + second[0]) / 2, (first[1] + second[1]) / 2
        place = (middle[0], middle[1] - 2.4) if is_flat else (middle[0] - 2, middle[1])
        self._text(place, text, 7, _INK, ha="center", va="center", rotation=0 if is_flat else 90)
        half = self._half_a_box(text, 7)[:: 1 if is_flat else -1]
        self.taken.take(np.array(place) - half, np.array(place) + half)

    @staticmethod
    def _half_a_box(text: str, size: float) -> np.ndarray:
        """Half the width and half the height of a text, mm."""
        return np.array([(len(text) * _WIDE * 1.1 + 0.2) * size * _POINT / 2, 0.65 * size * _POINT])

    def _text(self, place: XY, text: str, size: float, colour: str, **how: Any) -> None:  # noqa: ANN401
        x, y = place
        self.axes.text(x, y, **as_it_stands(text), fontsize=size, color=colour, **how)

    def _mark_holes(self) -> int:
        """Mark and number the start holes; returns how many numbers found no room."""
        places = self._all_on_paper(hole for hole, _ in self.holes)
        radii = self._radii(places).tolist()
        widths = [min(0.7, radius) for radius in radii]
        for place, radius in zip(places, radii, strict=True):
            self.taken.take(place - radius, place + radius)
            self.marked.take(place - radius, place + radius)
        if len(places) > FEW:
            curves = [paths.Path.circle(place, radius) for place, radius in zip(places, radii, strict=True)]
            look: dict[str, Any] = {"facecolor": "none", "edgecolor": _MARK, "zorder": 5, "gid": "holes"}
            self.axes.add_artist(PathCollection(curves, linewidths=widths, **look))
        else:
            for place, radius, width in zip(places, radii, widths, strict=True):
                mark = Circle(place, radius, fill=False, edgecolor=_MARK, linewidth=width, zorder=5, gid="hole")
                # (add_patch would look for its bounds)
                self.axes.add_artist(mark)
        marks = _Marks(places, np.array(radii))
        return len(places) - sum(self._number(index, marks) for index in range(min(len(places), _MOST_NUMBERS)))

    def _radii(self, places: np.ndarray) -> np.ndarray:
        """The radii of the marks at these places: a mark covers neither its contour nor the next mark."""
        contours = [planned for _, planned in self.holes]
        rooms = np.array([planned.room for planned in contours]) * self.scale
        leads = np.array([distance(planned.start, planned.entry) for planned in contours]) * self.scale
        points, apart = shapely.points(places), np.full(len(places), np.inf)
        (indices, _), distances = shapely.STRtree(points).query_nearest(
            points, exclusive=True, return_distance=True, all_matches=False
        )
        apart[indices] = distances
        limits = [0.5 * rooms, np.where(leads > 0, 0.5 * leads, _HOLE), 0.4 * apart]
        return np.clip(np.min(limits, axis=0), 0.1, _HOLE)

    def _number(self, index: int, marks: _Marks) -> bool:
        """Write a number where there is room near its hole, with a line to it where it does not stand beside it alone;
        whether there was room."""
        number = str(self.holes[index][1].turn)
        for size in (_FONT, _LEAST):
            half = self._half_a_box(number, size)
            if room := self._room_beside(index, marks, half):
                middle, line = room
                if len(line):
                    look = {"linewidth": 0.25, "capstyle": "projecting", "zorder": 4, "gid": "number-line"}
                    self._lines(line[None, [0, -1]], edgecolor=_MARK, **look)
                for taken in (self.taken, self.marked):
                    taken.along(line)
                    taken.take(middle - half, middle + half)
                self._text(
                    tuple(middle.tolist()), number, size, _MARK, ha="center", va="center", gid="number", zorder=6
                )
                return True
        return False

    def _room_beside(self, index: int, marks: _Marks, half: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
        """The middle of a free box near a hole, and places along the line to it, none where it needs no line; `half`:
        half the box's sides."""
        hole, radius = marks.places[index], marks.radii[index]
        rings = np.arange(radius + 0.5, _FAR, 0.8)
        middles = (hole + (rings[:, None, None] + half) * _AROUND_A_HOLE).reshape(-1, 2)
        free = np.flatnonzero(self.taken.are_free(middles - half, middles + half))
        far = rings[free // len(_AROUND_A_HOLE)]
        near = middles[free[far <= np.minimum(radius + 2.2, far[:1] + _ALONE)]]
        alone = near[marks.are_alone(index, near, half)]
        if len(alone):
            return alone[0], np.zeros((0, 2))
        for number, length in zip(free, far, strict=True):
            along = np.linspace(radius, length, int(length / _GRID) + 2)
            line = hole + along[:, None] * _AROUND_A_HOLE[number % len(_AROUND_A_HOLE)]
            if self.marked.is_free_along(line[along > radius + 2 * _GRID]):
                return middles[number], line
        return None

    def _draw_table(self) -> None:
        """Number, place, kind and length of each start hole."""
        table = self.table
        lengths = dict.fromkeys((planned.turn for _, planned in self.holes), 0.0)
        for cut in self.result.checked.cuts:
            lengths[self.result.contours[cut.contour].turn] += cut.length
        letters = {number: _letters(index) for index, numbers in enumerate(self.manners.values()) for number in numbers}
        count = min(len(self.holes), table.columns * table.rows)
        row_height, column_width = _ROW * self.larger, _COLUMN * self.larger
        top = self.page[1] - _MARGIN - 2 if table.is_beside else self.foot + self._height(table) - row_height / 2
        right = self.page[0] - _MARGIN
        left = right - table.columns * column_width if table.is_beside else _MARGIN
        for index in range(count):
            column, row = divmod(index, table.rows)
            x = left + column * column_width
            if row == 0:
                contour, manner, share = (text(Phrase(f"sheet-{name}")) for name in ("contour", "as", "mm-cut"))
                self._row(x, top, (text(Phrase("sheet-no")), "x, mm", "y, mm", contour, manner, share), _GREY)
            hole, planned = self.holes[index]
            # (-0.0001 is 0.000)
            x_, y_ = (f"{round(part, 3) + 0.0:.3f}" for part in hole)
            cells = (str(planned.turn), x_, y_, _called(planned), letters[planned.turn])
            # (that of a contour with several is told once)
            length = lengths[planned.turn] if hole == planned.start else 0.0
            told = f"{length:.{length < 1e5:d}f}" if length else ""
            self._row(x, top - (row + 1) * row_height, (*cells, told), _INK)
        if count < len(self.holes):
            more = text(Phrase("sheet-more-rows", count=len(self.holes) - count))
            self._text((right, self.foot + 1), more, _LEAST, _INK, ha="right")

    def _row(self, x: float, y: float, cells: Iterable[str], colour: str) -> None:
        for cell, end in zip(cells, _CELLS, strict=True):
            side = "left" if end == _CELLS[3] else "right"
            place = x + end * self.larger, y
            self._text(place, cell, _LEAST * self.larger, colour, ha=side, va="center")

    def _title(self, left_out: int) -> None:
        """The notes, and the block of facts at the foot of the page."""
        result, facts, page = self.result, self.facts, self.page
        for row, texts in enumerate(self.notes):
            wide = (page[0] - 2 * _MARGIN) / len(texts)
            for column, note in enumerate(texts):
                place = _MARGIN + column * wide + 1, self.foot - (row + 0.5) * _NOTE
                self._text(place, *_fitted(note, wide - 4), _INK, va="center")
        for y in (_MARGIN, _MARGIN + _HEAD - 2):
            self.axes.plot((_MARGIN, page[0] - _MARGIN), (y, y), color=_INK, linewidth=0.5)
        setup = result.setup
        untold = text(Phrase("sheet-not-told"))
        wire = untold
        if setup.wire is not None:
            wire = text(Phrase("sheet-wire-and-gap", wire=setup.wire, gap=setup.gap or 0.0))
        holes = Phrase("count-holes", count=len(holes_of(result.contours)))
        blocks = Phrase("count-blocks", count=len(result.tape.blocks))
        without = Phrase("sheet-without-room", count=left_out) if left_out else None
        ratio = f"{self.scale:.4g}:1" if self.scale >= 1 else f"1:{1 / self.scale:.4g}"
        drawing = facts.drawing if facts.scale == 1 else f"{short(facts.scale)} × {facts.drawing}"
        columns = (
            (("drawing", drawing), ("tape", facts.tape), ("date", date.today().isoformat()), ("scale", ratio)),
            (
                ("size", f"{short(self.high[0] - self.low[0])} x {short(self.high[1] - self.low[1])} mm"),
                ("units", facts.units),
                ("contours", text(Phrase("sheet-contours-and-holes", contours=len(result.contours), holes=holes))),
                ("numbers", text(Phrase("sheet-in-order", without=without))),
            ),
            (
                ("material", setup.material or untold),
                ("thickness", f"{short(setup.thickness)} mm" if setup.thickness else untold),
                ("wire", wire),
                ("rom", result.board.rom),
            ),
            (
                ("start", f"{shown(result.contours[0].start)} mm"),
                ("stops", text(Phrase("sheet-stops-and-blocks", stops=len(result.tape.stops), blocks=blocks))),
                ("length", f"{result.cut_length:.1f} mm"),
                ("time", text(Phrase("sheet-time-at", time=duration(result.seconds), pace=pace(setup)))),
            ),
        )
        wide = (page[0] - 2 * _MARGIN) / len(columns)
        for column, facts_ in enumerate(columns):
            for row, (name, value) in enumerate(facts_):
                x, y = _MARGIN + column * wide + 1, _MARGIN + _HEAD - 6 - row * 5
                self._text((x, y), text(Phrase(f"sheet-{name}")), 5.5, _GREY, va="center")
                self._text((x + 14, y), *_fitted(visible(value), wide - 16), _INK, va="center")

    def save(self, output: str, form: str) -> None:
        """Write the page as "pdf", "svg" or "png"."""
        save(self.figure, output, form, 200)


def _way(samples: Places) -> float:
    """The direction in the middle of a curve."""
    index = min(len(samples) - 2, int(0.5 * (len(samples) - 1)))
    (x, y), (u, v) = samples[index], samples[index + 1]
    return float(np.arctan2(v - y, u - x))


def _called(planned: PlannedContour) -> str:
    """Return a contour's kind and direction."""
    if not planned.contour.is_closed:
        return text(Phrase("kind-open"))
    return text(Phrase("sheet-ccw" if planned.contour.area > 0 else "sheet-cw", kind=kind_of(planned.kind)))


def _letters(number: int) -> str:
    """The name of a manner: A to Z, AA to AZ…"""
    return (_letters(number // 26 - 1) if number >= 26 else "") + chr(ord("A") + number % 26)


def _fitted(text: str, width: float) -> tuple[str, float]:
    """A text that is no wider than `width` mm, and the size of its letters: small ones before some in the middle are
    left out."""
    letters = [_WIDE * 0.95 * _POINT * (1.7 if east_asian_width(character) in "WF" else 1) for character in text]
    size = max(_LEAST, min(_FACT, width / max(sum(letters), 1e-9)))
    room = width / size
    if sum(letters) <= room:
        return text, size
    first = last = len(letters) // 2
    while sum(letters[:first] + letters[last:]) > room - _WIDE * _POINT:
        first, last = (first - 1, last) if first > len(letters) - last else (first, last + 1)
    return f"{text[:first]}…{text[last:]}", size


def write_sheet(result: CutResult, facts: Facts, output: str, form: str) -> None:
    """Write the setup sheet of a cut; `form` is "pdf", "svg" or "png". It is in English where no installed font has
    Chinese letters (what shows an SVG has its own)."""
    language = speech.language
    if form != "svg" and not installed():
        speech.language = "en"
    try:
        sheet = SetupSheet(result, facts)
        sheet.draw()
        sheet.save(output, form)
    finally:
        speech.language = language
