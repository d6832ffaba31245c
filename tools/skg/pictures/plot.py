"""Pictures of tapes, to scale."""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from math import cos, floor, inf, pi, sin, sqrt
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle, PathPatch, Polygon
from matplotlib.path import Path as Outline
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from skg.errors import UserError
from skg.geometry.arrays import numbers_up_to
from skg.geometry.piece import Piece
from skg.geometry.plane import XY, minus
from skg.messages.finding import Finding
from skg.pictures.page import as_it_stands, save
from skg.tape.layout import Laid, PlacedRoute

#: One colour for each tape (Okabe and Ito's palette, which colour-blind readers tell apart).
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
#: Drawing scales to choose from: the largest at which the part fits the paper is taken.
SCALES = (100, 50, 20, 10, 5, 4, 3, 2, 1, 1 / 2, 1 / 5, 1 / 10, 1 / 20, 1 / 50, 1 / 100, 1 / 500, 1 / 1000)
#: Largest size of the drawing on the paper, and the margin around it, mm.
PAPER, MARGIN = 170.0, 14.0
_INCH = 25.4
#: Of so many routes, stops and arrows each is a part of the picture by itself, with an id in an SVG; of more than that
#: all of a kind are one.
FEW = 500
#: The blocks of a route that are one curve of the picture, at most.
LONGEST = 50_000
#: Side of the squares of a page in which boxes are looked for, mm.
_SQUARE = 4.0
#: Of many marks of a kind each is no larger than this part of the room that there is for each.
_MARK = 0.08
#: Size of block numbers, points; width of a digit and its height in that size.
_FONT, _WIDE, _HIGH = 6, 0.636, 0.729


@dataclass(frozen=True)
class Sheet:
    """One tape to draw: its name, its routes, its contour (mm), if known, and its drilled holes (µm)."""

    name: str
    routes: list[PlacedRoute]
    contour: tuple[Piece, ...] = ()
    holes: tuple[XY, ...] = ()


def _extents(routes: Sequence[PlacedRoute]) -> tuple[float, float, float, float]:
    """Smallest and largest x and y (xmin, ymin, xmax, ymax) of routes in µm, bulges of arcs included."""
    low, high = _joined(routes).extents() if routes else ((0.0, 0.0), (0.0, 0.0))
    return *low, *high


def _joined(routes: Sequence[PlacedRoute]) -> Laid:
    return Laid.joined([Laid.of(route.blocks) for route in routes])


def _path(pieces: Sequence[Piece], scale: float = 1.0, begins: Sequence[int] = ()) -> Outline:
    """One curve of lines and arcs that follow each other: the pen stays down between them, but before the pieces that
    `begins` counts. `scale` is a millimetre over the pieces' unit. Arcs are Bézier curves of at most 22.5°: true to one
    part in 10⁸.
    """
    if isinstance(pieces, Laid):
        starts, ends, arcs = pieces.starts, pieces.ends, ~pieces.is_line
        centres, sweeps = pieces.centres[arcs], pieces.sweeps[arcs]
    else:
        starts = np.array([piece.start for piece in pieces])
        ends = np.array([piece.end for piece in pieces])
        arcs = np.array([not piece.is_line for piece in pieces])
        drawn = [piece for piece in pieces if not piece.is_line]
        centres, sweeps = np.array([piece.centre for piece in drawn]), np.array([piece.sweep for piece in drawn])
    counts = np.ones(len(pieces), int)
    if arcs.any():
        curves = np.maximum(1, np.ceil(abs(sweeps) / (pi / 8) - 1e-9).astype(int))
        counts[arcs] = 3 * curves
    # Index of each piece's first vertex, its start.
    first = np.concatenate([[0], np.cumsum(counts + 1)])
    vertices = np.empty((first[-1], 2))
    vertices[first[:-1]] = starts
    vertices[first[1:] - 1] = ends
    codes = np.full(first[-1], Outline.LINETO)
    if arcs.any():
        owner = np.repeat(np.arange(len(sweeps)), curves)
        number = numbers_up_to(curves)
        arms = starts[arcs] - centres
        radii, angles, steps = np.hypot(*arms.T), np.arctan2(arms[:, 1], arms[:, 0]), sweeps / curves
        # The control points of an arc as L. Maisonobe has them, "Drawing an elliptical arc".
        reach = np.sin(steps) * (np.sqrt(4 + 3 * np.tan(steps / 2) ** 2) - 1) / 3
        for ahead in (0, 1):
            angle = angles[owner] + (number + ahead) * steps[owner]
            radial = np.column_stack([np.cos(angle), np.sin(angle)])
            across = np.column_stack([-radial[:, 1], radial[:, 0]]) * (reach[owner] * (1 - 2 * ahead))[:, None]
            place = first[:-1][arcs][owner] + 3 * number + 1
            vertices[place + ahead] = centres[owner] + radii[owner, None] * (radial + across)
            if ahead:
                vertices[place + 2] = centres[owner] + radii[owner, None] * radial
        codes[np.concatenate([place, place + 1, place + 2])] = Outline.CURVE4
    vertices *= scale
    apart = np.hypot(*(vertices[first[1:-1]] - vertices[first[1:-1] - 1]).T) >= 0.01
    codes[0] = Outline.MOVETO
    codes[first[1:-1][apart]] = Outline.MOVETO
    codes[first[np.array(begins, int)]] = Outline.MOVETO
    return Outline(vertices, codes)


def outlines(pieces: Sequence[Piece]) -> Outline:
    """Lines and arcs, at least one, each by itself, in their own unit."""
    return _path(pieces, begins=range(len(pieces)))


class _TakenBoxes:
    """Boxes that are taken on a page, mm."""

    def __init__(self) -> None:
        #: Boxes that reach into each square of `_SQUARE`.
        self.squares: dict[tuple[int, int], list[tuple[float, float, float, float]]] = defaultdict(list)

    def take(self, left: float, bottom: float, right: float, top: float) -> bool:
        """Take a box, if nothing is in it."""
        columns = range(floor(left / _SQUARE), floor(right / _SQUARE) + 1)
        rows = range(floor(bottom / _SQUARE), floor(top / _SQUARE) + 1)
        squares = [self.squares[cell] for cell in product(columns, rows)]
        for square in squares:
            for west, south, east, north in square:
                if west < right and left < east and south < top and bottom < north:
                    return False
        for square in squares:
            square.append((left, bottom, right, top))
        return True


class Picture:
    """A drawing to scale: 1 mm of the part is `scale` mm on the paper."""

    def __init__(self, sheets: list[Sheet], scale: float | None, title: str) -> None:
        boxes = [_extents(sheet.routes) for sheet in sheets]
        pieces = [piece.start for sheet in sheets for piece in sheet.contour]
        xs = [x / 1000 for box in boxes for x in box[::2]] + [x for x, _ in pieces]
        ys = [y / 1000 for box in boxes for y in box[1::2]] + [y for _, y in pieces]
        self.low, self.high = (min(xs), min(ys)), (max(xs), max(ys))
        width, height = (max(high - low, 0.01) for low, high in zip(self.low, self.high, strict=True))
        largest = max(width, height)
        self.scale = scale or next((scale for scale in SCALES if scale * largest <= PAPER), PAPER / largest)
        self.head = MARGIN if title or len(sheets) > 1 else MARGIN / 2
        paper = width * self.scale + 2 * MARGIN, height * self.scale + MARGIN + self.head
        if max(paper) > 5000:
            raise UserError(Finding("picture-too-large", size=max(paper)))
        paper = max(paper[0], 70), max(paper[1], 40)
        self.figure = Figure(figsize=(paper[0] / _INCH, paper[1] / _INCH))
        self.axes: Axes = self.figure.add_axes((0, 0, 1, 1))
        left = self.low[0] - (paper[0] / self.scale - width) / 2
        bottom = self.low[1] - MARGIN / self.scale
        self.axes.set_xlim(left, left + paper[0] / self.scale)
        self.axes.set_ylim(bottom, bottom + paper[1] / self.scale)
        self.description = {
            "mm_to_points": self.scale * 72 / _INCH,
            "left": left,
            "bottom": bottom,
            "height_points": paper[1] * 72 / _INCH,
        }
        self.axes.axis("off")
        # The page's lower left corner on the part, mm; what block numbers cover; how many of them found no room.
        self.corner, self.taken, self.left_out = (left, bottom), _TakenBoxes(), 0
        self._rulers(title)

    def on_paper(self, millimetres: float) -> float:
        """A length of the picture in mm of the part."""
        return millimetres / self.scale

    def _rulers(self, title: str) -> None:
        """Ticks in mm of the part, at the drawing's lower and left edge, and the title."""
        grey: dict[str, Any] = {"color": "#666666", "fontsize": 6}
        (left, bottom), (right, top) = self.low, self.high
        x, y = left - self.on_paper(4), bottom - self.on_paper(4)
        for low, high, is_x in ((left, right, True), (bottom, top, False)):
            ticks = [
                tick
                for tick in MaxNLocator(6, steps=[1, 2, 5, 10]).tick_values(low, high)
                if low - 1e-9 <= tick <= high + 1e-9
            ]
            for tick in ticks:
                dash = self.on_paper(1.5)
                ends = ([tick, tick], [y, y - dash]) if is_x else ([x, x - dash], [tick, tick])
                self.axes.plot(*ends, color="#666666", linewidth=0.5)
                place_at = (tick, y - 2 * dash) if is_x else (x - 2 * dash, tick)
                self.axes.text(
                    *place_at, f"{tick:g}", ha="center" if is_x else "right", va="top" if is_x else "center", **grey
                )
            axis = ([low, high], [y, y]) if is_x else ([x, x], [low, high])
            self.axes.plot(*axis, color="#666666", linewidth=0.5)
        ratio = f"{self.scale:g}:1" if self.scale >= 1 else f"1:{1 / self.scale:g}"
        self.axes.text(right, y - self.on_paper(6), f"mm, scale {ratio}", ha="right", va="top", **grey)
        if title:
            place = (left + right) / 2, top + self.on_paper(self.head - 4)
            self.axes.text(*place, **as_it_stands(title), ha="center", va="top", fontsize=9)

    def draw(self, sheet: Sheet, colour: str, name: str, wire: float, arrows: bool, numbers: bool) -> None:
        """Draw one tape; `name` begins the ids of its parts in an SVG."""
        cuts = [route for route in sheet.routes if not route.is_move]
        if len(sheet.routes) > FEW:
            self._many_routes(cuts, [route for route in sheet.routes if route.is_move], colour, name, wire)
        else:
            for index, route in enumerate(sheet.routes, 1):
                self._route(route, colour, f"{name}-route-{index}", wire)
        if arrows:
            self._heads([head for route in cuts for head in self._arrows(route)], colour)
        if numbers:
            for route in sheet.routes:
                self._numbers(route, colour)
        for index, place in enumerate(sheet.holes, 1):
            self._hole(place, colour, f"{name}-hole-{index}")
        if sheet.contour:
            look = {"edgecolor": "#555555", "linewidth": 0.5, "zorder": 1.5}
            self._curve(_path(sheet.contour), f"{name}-contour", **look)

    def _curve(self, curve: Outline, gid: str, **look: object) -> None:
        # (add_patch would look for the bounds of every curve)
        self.axes.add_artist(PathPatch(curve, fill=False, gid=gid, **look))

    def _route(self, route: PlacedRoute, colour: str, gid: str, wire: float) -> None:
        look: dict[str, Any] = {"edgecolor": colour, "joinstyle": "round"}
        if wire and not route.is_move:
            width = wire * self.description["mm_to_points"]
            kerf: dict[str, Any] = {"alpha": 0.25, "capstyle": "round", "linewidth": width, "zorder": 1}
            self._curve(_path(route.blocks, 0.001), f"{gid}-kerf", **look, **kerf)
        look |= {"linewidth": 0.8, "zorder": 2, "linestyle": (0, (4, 2)) if route.is_move else "solid"}
        # (matplotlib writes a curve as one string, and has several copies of it meanwhile)
        for first in range(0, len(route.blocks), LONGEST):
            part = f"-from-{first + 1}" if len(route.blocks) > LONGEST else ""
            self._curve(_path(route.blocks[first : first + LONGEST], 0.001), gid + part, **look)
        x, y = (ordinate / 1000 for ordinate in route.start)
        if not route.is_move:
            look = {"edgecolor": colour, "linewidth": 0.8, "zorder": 4, "gid": f"{gid}-start"}
            self.axes.add_artist(Circle((x, y), self.on_paper(1), fill=False, **look))

    def _many_routes(
        self, cuts: list[PlacedRoute], moves: list[PlacedRoute], colour: str, name: str, wire: float
    ) -> None:
        """Draw all routes as `_route` does, each kind as one collection."""
        look: dict[str, Any] = {"edgecolor": colour, "joinstyle": "round"}
        if wire and cuts:
            # (overlaps of cuts show: each is drawn by itself)
            width = wire * self.description["mm_to_points"]
            curves = [_path(route.blocks, 0.001) for route in cuts]
            kerf: dict[str, Any] = {
                "alpha": 0.25,
                "capstyle": "round",
                "linewidths": width,
                "zorder": 1,
                "gid": f"{name}-kerfs",
            }
            self.axes.add_artist(PathCollection(curves, facecolor="none", **look, **kerf))
        for routes, gid, dashes in ((cuts, "cuts", "solid"), (moves, "moves", (0, (4, 2)))):
            if routes:
                begins = np.cumsum([0, *(len(route.blocks) for route in routes[:-1])]).tolist()
                curve = _path(_joined(routes), 0.001, begins)
                self._curve(curve, f"{name}-{gid}", linewidth=0.8, zorder=2, linestyle=dashes, **look)
        starts = np.array([route.start for route in cuts]).reshape(-1, 2) / 1000
        self._marks(Outline.circle((0, 0), self.on_paper(1)), starts, f"{name}-starts", colour, 0.8)

    def _marks(self, shape: Outline, places: NDArray, gid: str, colour: str, width: float) -> None:
        """The same mark at many places (n × 2, mm), as one; it is so small that they do not cover the part."""
        if len(places):
            room = sqrt((self.high[0] - self.low[0]) * (self.high[1] - self.low[1]) / len(places))
            corners, codes = np.asarray(shape.vertices, float), np.asarray(shape.codes)
            part = min(1.0, _MARK * room / corners.max())
            vertices = (places[:, None] + part * corners).reshape(-1, 2)
            curve = Outline(vertices, np.tile(codes, len(places)))
            self._curve(curve, gid, zorder=4, edgecolor=colour, linewidth=part * width)

    def _hole(self, point: XY, colour: str, gid: str) -> None:
        """A drilled hole: a circle, and a cross in it."""
        x, y = point[0] / 1000, point[1] / 1000
        size, circle = self.on_paper(1.8), Outline.circle((x, y), self.on_paper(1.2))
        ends = [(x - size, y), (x + size, y), (x, y - size), (x, y + size)]
        cross = Outline(ends, [Outline.MOVETO, Outline.LINETO] * 2)
        self._curve(Outline.make_compound_path(circle, cross), gid, edgecolor=colour, linewidth=0.8, zorder=4)

    def stops(self, points: Sequence[XY], name: str) -> None:
        """Mark the places (µm) where the controller stops."""
        size = self.on_paper(1.6)
        corners = np.array([(-size, -size), (size, -size), (size, size), (-size, size)])
        places, colour, width = np.array(points).reshape(-1, 2) / 1000, "#333333", 0.7
        if len(places) > FEW:
            self._marks(Outline([*corners, corners[0]], closed=True), places, f"{name}-stops", colour, width)
            return
        for index, place in enumerate(places, 1):
            look: dict[str, Any] = {"edgecolor": colour, "linewidth": width, "zorder": 4, "gid": f"{name}-stop-{index}"}
            self.axes.add_artist(Polygon(place + corners, fill=False, **look))

    def _arrows(self, route: PlacedRoute) -> Iterator[list[XY]]:
        """Arrow heads along the route, no nearer to each other than 25 mm on the paper."""
        laid, spacing = Laid.of(route.blocks), 25_000 / self.scale
        lengths = laid.lengths()
        behind, last = np.cumsum(lengths), -inf
        for index in np.flatnonzero(lengths * self.scale >= 4000):
            if behind[index] - last < spacing:
                continue
            last, placed = behind[index], laid[int(index)]
            x, y = (ordinate / 1000 for ordinate in placed.at(0.5))
            direction, size = placed.direction(0.5), self.on_paper(1.3)
            yield [
                (x + size * 1.4 * cos(direction + turn), y + size * 1.4 * sin(direction + turn))
                for turn in (0, 2.5, -2.5)
            ]

    def _heads(self, heads: list[list[XY]], colour: str) -> None:
        if len(heads) > FEW:
            self.axes.add_artist(PolyCollection(heads, facecolors=colour, edgecolors="none", zorder=5))
            return
        for head in heads:
            self.axes.add_artist(Polygon(head, facecolor=colour, edgecolor="none", zorder=5))

    def _numbers(self, route: PlacedRoute, colour: str) -> None:
        """Block numbers, on the left of travel, or on the right where others stand on the left; those for which there
        is no room beside others are left out."""
        for placed in route.blocks:
            (x, y), number = placed.at(0.5), str(placed.block.number)
            wide, high = (part * _FONT / 72 * _INCH / 2 for part in (_WIDE * len(number), _HIGH))
            for side in (pi / 2, -pi / 2):
                direction, away = placed.direction(0.5) + side, self.on_paper(2.2)
                place = x / 1000 + away * cos(direction), y / 1000 + away * sin(direction)
                left, bottom = (ordinate * self.scale for ordinate in minus(place, self.corner))
                if self.taken.take(left - wide, bottom - high, left + wide, bottom + high):
                    self.axes.text(*place, number, fontsize=_FONT, ha="center", va="center", color=colour)
                    break
            else:
                self.left_out += 1

    def legend(self, names: list[str]) -> None:
        """Name the tapes at the top left, each in its colour."""
        top = self.high[1] + self.on_paper(self.head - 3)
        for index, name in enumerate(names):
            place, colour = (self.low[0], top - self.on_paper(3) * index), COLOURS[index % len(COLOURS)]
            self.axes.text(*place, **as_it_stands(name), va="top", fontsize=6, color=colour)

    def save(self, output: str, form: str) -> None:
        """Write the picture."""
        metadata: dict[str, str] = {}
        if form == "svg":
            metadata = {"Creator": "skg plot", "Description": json.dumps(self.description)}
        elif form == "pdf":
            metadata = {"Creator": "skg plot"}
        save(self.figure, output, form, 150, metadata)
