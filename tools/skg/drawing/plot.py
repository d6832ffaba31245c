"""`skg plot`: pictures of tapes, to scale."""

from __future__ import annotations

import json
from dataclasses import dataclass
from math import ceil, cos, degrees, hypot, pi, sin
from pathlib import Path

import click
import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, PathPatch, Polygon
from matplotlib.path import Path as Curve
from matplotlib.ticker import MaxNLocator

from skg.drawing import source
from skg.errors import UserError
from skg.tape.block import micrometres
from skg.tape.gcode import Pair
from skg.tape.placed import Placed, PlacedRoute, extents, place, positions_option, stop_places

#: One colour for each tape (Okabe and Ito's palette, which colour-blind readers tell apart).
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
FORMATS = ("svg", "png", "pdf")
#: Drawing scales to choose from: the largest at which the part fits the paper is taken.
SCALES = (100, 50, 20, 10, 5, 4, 3, 2, 1, 1 / 2, 1 / 5, 1 / 10, 1 / 20, 1 / 50, 1 / 100, 1 / 500, 1 / 1000)
#: Largest size of the drawing on the paper, and the margin around it, mm.
PAPER, MARGIN = 170.0, 14.0
_INCH = 25.4


@dataclass(frozen=True)
class Sheet:
    """One tape to draw: its name, its routes, and the contour that it was made from (mm), if known."""

    name: str
    routes: list[PlacedRoute]
    contour: tuple[source.Piece, ...] = ()


def _arc_curve(centre: tuple[float, float], radius: float, first: float, last: float) -> Curve:
    """An arc from angle `first` to `last` (radians, any sense) as Bézier curves of at most 22.5°: true to
    one part in 10⁸."""
    low, high = sorted((first, last))
    unit = Curve.arc(degrees(low), degrees(high), n=max(1, ceil((high - low) / (pi / 8))))
    if high - low >= 2 * pi - 1e-12:
        unit = Curve.arc(degrees(low), degrees(low) + 360 - 1e-9, n=16)
    vertices = unit.vertices * radius + centre
    # Reversing the points of a chain of cubic curves reverses the chain; the codes are the same either way.
    return Curve(vertices if last >= first else vertices[::-1], unit.codes)


def block_curve(placed: Placed) -> Curve:
    """One block's line or arc, mm."""
    if placed.block.is_line:
        return Curve([(x / 1000, y / 1000) for x, y in (placed.start, placed.end)])
    first, last = placed.angles
    centre = placed.centre[0] / 1000, placed.centre[1] / 1000
    return _arc_curve(centre, hypot(placed.block.x, placed.block.y) / 1000, first, last)


def piece_curve(piece: source.Piece) -> Curve:
    """One piece of a nominal contour, mm."""
    if piece.centre is None:
        return Curve([piece.start, piece.end])
    (xc, yc), (xs, ys) = piece.centre, piece.start
    return _arc_curve(piece.centre, hypot(xs - xc, ys - yc), piece.angles[0], piece.angles[1])


def _join(curves: list[Curve]) -> Curve:
    """One curve of many that follow each other: the pen stays down between them."""
    joined = Curve.make_compound_path(*curves)
    codes = joined.codes.copy()
    end = None
    for at in range(len(codes)):
        if codes[at] == Curve.MOVETO and end is not None and hypot(*(joined.vertices[at] - end)) < 0.01:
            codes[at] = Curve.LINETO
        end = joined.vertices[at]
    return Curve(joined.vertices, codes)


class Picture:
    """A drawing to scale: 1 mm of the part is `scale` mm on the paper."""

    def __init__(self, sheets: list[Sheet], scale: float | None, title: str) -> None:
        boxes = [extents(sheet.routes) for sheet in sheets]
        pieces = [piece.start for sheet in sheets for piece in sheet.contour]
        xs = [x / 1000 for box in boxes for x in box[::2]] + [x for x, _ in pieces]
        ys = [y / 1000 for box in boxes for y in box[1::2]] + [y for _, y in pieces]
        self.low, self.high = (min(xs), min(ys)), (max(xs), max(ys))
        width, height = (max(high - low, 0.01) for low, high in zip(self.low, self.high, strict=True))
        largest = max(width, height)
        self.scale = scale or next((one for one in SCALES if one * largest <= PAPER), PAPER / largest)
        self.head = MARGIN if title or len(sheets) > 1 else MARGIN / 2
        paper = width * self.scale + 2 * MARGIN, height * self.scale + MARGIN + self.head
        if max(paper) > 5000:
            raise UserError(f"the picture would be {max(paper):.0f} mm large, choose a smaller --scale")
        paper = max(paper[0], 70), max(paper[1], 40)
        self.figure = Figure(figsize=(paper[0] / _INCH, paper[1] / _INCH))
        self.axes: Axes = self.figure.add_axes((0, 0, 1, 1))
        left = self.low[0] - (paper[0] / self.scale - width) / 2
        bottom = self.low[1] - MARGIN / self.scale
        self.axes.set_xlim(left, left + paper[0] / self.scale)
        self.axes.set_ylim(bottom, bottom + paper[1] / self.scale)
        self.description = {"mm_to_points": self.scale * 72 / _INCH, "left": left, "bottom": bottom,
                            "height_points": paper[1] * 72 / _INCH}
        self.axes.axis("off")
        self._rulers(title)

    def on_paper(self, millimetres: float) -> float:
        """A length of the picture in mm of the part."""
        return millimetres / self.scale

    def _rulers(self, title: str) -> None:
        """Ticks in mm of the part, at the drawing's lower and left edge, and the title."""
        grey = {"color": "#666666", "fontsize": 6}
        (left, bottom), (right, top) = self.low, self.high
        x, y = left - self.on_paper(4), bottom - self.on_paper(4)
        for low, high, is_x in ((left, right, True), (bottom, top, False)):
            ticks = [tick for tick in MaxNLocator(6, steps=[1, 2, 5, 10]).tick_values(low, high)
                     if low - 1e-9 <= tick <= high + 1e-9]
            for tick in ticks:
                dash = self.on_paper(1.5)
                ends = ([tick, tick], [y, y - dash]) if is_x else ([x, x - dash], [tick, tick])
                self.axes.plot(*ends, color="#666666", linewidth=0.5)
                place_at = (tick, y - 2 * dash) if is_x else (x - 2 * dash, tick)
                self.axes.text(*place_at, f"{tick:g}", ha="center" if is_x else "right",
                               va="top" if is_x else "center", **grey)
            axis = ([low, high], [y, y]) if is_x else ([x, x], [low, high])
            self.axes.plot(*axis, color="#666666", linewidth=0.5)
        ratio = f"{self.scale:g}:1" if self.scale >= 1 else f"1:{1 / self.scale:g}"
        self.axes.text(right, y - self.on_paper(6), f"mm, scale {ratio}", ha="right", va="top", **grey)
        if title:
            self.axes.text((left + right) / 2, top + self.on_paper(self.head - 4), title, ha="center",
                           va="top", fontsize=9)

    def draw(self, sheet: Sheet, colour: str, name: str, wire: float, arrows: bool, numbers: bool) -> None:
        """Draw one tape; `name` begins the ids of its parts in an SVG."""
        for at, route in enumerate(sheet.routes, 1):
            self._route(route, colour, f"{name}-route-{at}", wire)
            if arrows and not route.is_move:
                self._arrows(route, colour)
            if numbers:
                self._numbers(route, colour)
        if sheet.contour:
            curve = _join([piece_curve(piece) for piece in sheet.contour])
            patch = PathPatch(curve, fill=False, edgecolor="#555555", linewidth=0.5, zorder=1.5)
            patch.set_gid(f"{name}-contour")
            self.axes.add_patch(patch)

    def _route(self, route: PlacedRoute, colour: str, gid: str, wire: float) -> None:
        curve = _join([block_curve(placed) for placed in route.blocks])
        if wire and not route.is_move:
            kerf = PathPatch(curve, fill=False, edgecolor=colour, alpha=0.25, capstyle="round",
                             joinstyle="round", linewidth=wire * self.description["mm_to_points"], zorder=1)
            kerf.set_gid(f"{gid}-kerf")
            self.axes.add_patch(kerf)
        path = PathPatch(curve, fill=False, edgecolor=colour, linewidth=0.8, zorder=2,
                         linestyle=(0, (4, 2)) if route.is_move else "solid", joinstyle="round")
        path.set_gid(gid)
        self.axes.add_patch(path)
        x, y = (ordinate / 1000 for ordinate in route.start)
        if not route.is_move:
            hole = Circle((x, y), self.on_paper(1), fill=False, edgecolor=colour, linewidth=0.8, zorder=4)
            hole.set_gid(f"{gid}-start")
            self.axes.add_patch(hole)

    def stop(self, point: tuple[int, int], gid: str) -> None:
        """Mark a place where the controller stops."""
        x, y = point[0] / 1000, point[1] / 1000
        size = self.on_paper(1.6)
        corners = [(x - size, y - size), (x + size, y - size), (x + size, y + size), (x - size, y + size)]
        mark = Polygon(corners, fill=False, edgecolor="#333333", linewidth=0.7, zorder=4)
        mark.set_gid(gid)
        self.axes.add_patch(mark)

    def _arrows(self, route: PlacedRoute, colour: str) -> None:
        """Arrow heads along the route, no nearer to each other than 25 mm on the paper, at least one."""
        spacing = 25_000 / self.scale
        since = spacing
        for placed in route.blocks:
            length = placed.block.length
            since += length
            if since < spacing or length * self.scale < 4000:
                continue
            since = 0.0
            x, y = (ordinate / 1000 for ordinate in placed.at(0.5))
            way, size = placed.direction(0.5), self.on_paper(1.3)
            head = [(x + size * 1.4 * cos(way + turn), y + size * 1.4 * sin(way + turn))
                    for turn in (0, 2.5, -2.5)]
            self.axes.add_patch(Polygon(head, facecolor=colour, edgecolor="none", zorder=5))

    def _numbers(self, route: PlacedRoute, colour: str) -> None:
        """Block numbers, on the left of travel."""
        for placed in route.blocks:
            x, y = (ordinate / 1000 for ordinate in placed.at(0.5))
            way, away = placed.direction(0.5) + pi / 2, self.on_paper(2.2)
            self.axes.text(x + away * cos(way), y + away * sin(way), str(placed.block.number), fontsize=6,
                           ha="center", va="center", color=colour)

    def legend(self, names: list[str]) -> None:
        """Name the tapes at the top left, each in its colour."""
        top = self.high[1] + self.on_paper(self.head - 3)
        for at, name in enumerate(names):
            self.axes.text(self.low[0], top - self.on_paper(3) * at, name, va="top", fontsize=6,
                           color=COLOURS[at % len(COLOURS)])

    def save(self, output: str, form: str) -> None:
        """Write the picture; the same drawing always gives the same bytes of SVG."""
        settings = {"svg.hashsalt": "skg", "svg.fonttype": "none", "path.simplify": False}
        metadata: dict[str, str | None] = {}
        if form == "svg":
            metadata = {"Date": None, "Creator": "skg plot", "Description": json.dumps(self.description)}
        elif form == "pdf":
            metadata = {"CreationDate": None, "Creator": "skg plot"}
        with mpl.rc_context(settings), click.open_file(output, "wb") as file:
            self.figure.savefig(file, format=form, dpi=150, metadata=metadata, facecolor="white")


def _form(output: str, form: str | None) -> str:
    """The picture's format: as said, else by the file's name; the standard output is SVG."""
    found = form or ("svg" if output == "-" else Path(output).suffix.lstrip(".").lower())
    if found not in FORMATS:
        raise UserError(f"{output}: expected a name that ends in .svg, .png or .pdf, or --format")
    return found


@click.command(name="plot")
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=click.Path(allow_dash=True))
@click.option("-o", "--output", required=True, type=click.Path(allow_dash=True),
              help="Picture to write, .svg, .png or .pdf; - for the standard output.")
@click.option("--format", "form", type=click.Choice(FORMATS), help="Format, when the name does not tell it.")
@click.option("--blocks", is_flag=True, help="Write every block's number beside it.")
@click.option("--wire", default=0.0, metavar="MM", type=click.FloatRange(0),
              help="Draw the cut of a wire of this diameter, to scale.")
@click.option("--no-arrows", is_flag=True, help="No arrows in the direction of travel.")
@click.option("--show-offset", is_flag=True, help="Also draw the nominal contour (of .skg programs).")
@click.option("--start", multiple=True, type=Pair(),
              help="Place of the start hole, mm; once for each FILE. Default: FROM of a program, else 0,0.")
@click.option("--scale", type=click.FloatRange(0, min_open=True), help="Drawing scale; default: what fits.")
@click.option("--title", default="", help="A title above the drawing.")
@positions_option
@source.skg80_option
def command(files: tuple[str, ...], output: str, form: str | None, blocks: bool, wire: float, no_arrows: bool,
            show_offset: bool, start: tuple[tuple[float, float], ...], scale: float | None, title: str,
            positions: str, skg80: str | None) -> None:
    """Draw tapes (.3b) and programs (.skg), several in one picture.

    Start holes are circles, stops squares, positioning moves dashed. A program is run first: by build/skg80
    when it is there (or the one that --skg80 names), otherwise by the reference interpreter. FILE - is a tape
    on the standard input.
    """
    picture_format = _form(output, form)
    sheets = []
    stops: list[list[tuple[int, int]]] = []
    for at, name in enumerate(files):
        made = source.load(name, skg80, show_offset)
        x, y = start[at] if at < len(start) else made.start
        home = micrometres(x), micrometres(y)
        routes = place(made.tape, home, positions)
        sheets.append(Sheet(Path(name).name, routes, made.contour))
        stops.append(stop_places(made.tape, routes, home))
    if not any(sheet.routes for sheet in sheets):
        raise UserError(f"{files[0]}: nothing to draw, the tape has no blocks")
    picture = Picture(sheets, scale, title)
    for at, sheet in enumerate(sheets):
        picture.draw(sheet, COLOURS[at % len(COLOURS)], f"tape-{at + 1}", wire, not no_arrows, blocks)
        for number, point in enumerate(stops[at], 1):
            picture.stop(point, f"tape-{at + 1}-stop-{number}")
    if len(sheets) > 1:
        picture.legend([sheet.name for sheet in sheets])
    picture.save(output, picture_format)
