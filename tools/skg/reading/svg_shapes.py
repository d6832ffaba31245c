"""Shapes of an SVG drawing as edges, lengths in millimetres; each is accounted for.

svgelements reads what stands in an attribute: path data and transforms.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import pairwise
from math import atan2, hypot, pi, sqrt
from xml.etree import ElementTree

import svgelements

from skg.geometry.contour import Edge
from skg.geometry.plane import XY, cross, distance, minus
from skg.job.read_options import ReadOptions
from skg.messages.finding import Finding, Phrase
from skg.reading.account import NOTE, Content, Entity, Written, by_layer
from skg.reading.budget import check_vertices
from skg.reading.curves import conic, is_number, spline_edges
from skg.reading.svg_file import NOTES, NUMBER, SHAPES, UNREADABLE, Shown, SvgFile, View, length_of, property_of, tag_of
from skg.reading.unread import Unread, reason_of

#: Shapes that may have markers at their ends and corners.
_MARKED = ("path", "line", "polyline", "polygon")
#: Characters that path data cannot have, and all behind them.
_NO_PATH = re.compile(r"(?:[^\s,\d.eE+MmZzLlHhVvCcSsQqTtAa-]|[eE](?![+-]?\d)).*")
#: A line that is wider than this is said, mm.
_WIDE = 1.0
#: Of the size of letters: how high a capital is, how wide one; that which is not told, pixels; the part of a line
#: before its place, by its anchor.
_CAPITAL, _WIDTH = 0.7, 0.55
_SIZE = 16.0
_ANCHORS = {"middle": 0.5, "end": 1.0}
#: Why a shape is left that has neither a stroke nor a fill.
_UNPAINTED = Phrase("reason-unpainted")


def _outline(element: ElementTree.Element, view: View) -> Sequence[svgelements.PathSegment]:
    """A shape as the segments of a path, in its own pixels."""
    width, height = view.size
    wholes = {**dict.fromkeys(("x", "cx", "rx", "x1", "x2", "width"), width), "r": hypot(*view.size) / sqrt(2)}

    def given(name: str) -> float | None:
        return length_of(property_of(element, view, name), wholes.get(name, height), view.px)

    def radii() -> tuple[float | None, float | None]:
        """rx and ry; one that is not told, or below 0, is the other."""
        rx, ry = (None if length is None or length < 0 else length for length in map(given, ("rx", "ry")))
        return ry if rx is None else rx, rx if ry is None else ry

    def length(name: str) -> float:
        return given(name) or 0.0

    match tag_of(element):
        case "rect":
            rx, ry = radii()
            wide, high = length("width"), length("height")
            if wide <= 0 or high <= 0:
                return []
            x, y = length("x"), length("y")
            if rx and ry:
                return svgelements.Rect(x, y, wide, high, min(rx, wide / 2), min(ry, high / 2)).segments(False)
            return _lines([(x, y), (x + wide, y), (x + wide, y + high), (x, y + high), (x, y)])
        case "circle":
            return _around((length("cx"), length("cy")), length("r"), length("r"))
        case "ellipse":
            rx, ry = radii()
            return _around((length("cx"), length("cy")), rx or 0.0, ry or 0.0)
        case "line":
            return _lines([(length("x1"), length("y1")), (length("x2"), length("y2"))])
        case "polyline":
            return _lines(_points(element))
        case "polygon":
            points = _points(element)
            return _lines([*points, *points[:1]])
        case _:
            path = re.fullmatch(r"""path\(\s*["'](.*)["']\s*\)""", data := property_of(element, view, "d"), re.DOTALL)
            return _path(path[1] if path else data)


class _PathData(svgelements.Path):
    """A path whose smooth curves go on from one of their own kind alone; behind another they begin as a line would."""

    def smooth_quad(self, *points: svgelements.Point, **options: bool) -> svgelements.Path:
        """T of the path data."""
        if isinstance(self[-1], svgelements.QuadraticBezier):
            return super().smooth_quad(*points, **options)
        return self.quad(self.current_point, *points, **options)

    def smooth_cubic(self, *points: svgelements.Point, **options: bool) -> svgelements.Path:
        """S of the path data."""
        if isinstance(self[-1], svgelements.CubicBezier):
            return super().smooth_cubic(*points, **options)
        return self.cubic(self.current_point, *points, **options)


def _path(data: str) -> svgelements.Path:
    """Path data; what does not begin with a move, or does not end as it should, is a `ValueError`."""
    wrong = _NO_PATH.search(data)
    if wrong or data.strip() and data.strip()[0] not in "Mm":
        raise Unread(Phrase("unread-path-at", found=(wrong[0] if wrong else data.strip())[:10]))
    try:
        return _PathData(data)
    except UNREADABLE:
        raise Unread(Phrase("unread-path")) from None


def _points(element: ElementTree.Element) -> list[XY]:
    """The points of a polyline or polygon."""
    numbers = element.get("points", "").replace(",", " ")
    points = [float(number) for number in re.findall(NUMBER, numbers)]
    if re.sub(NUMBER, "", numbers).strip() or len(points) % 2:
        raise Unread(Phrase("unread-points"))
    return list(zip(points[::2], points[1::2], strict=True))


def _lines(points: list[XY]) -> list[svgelements.Line]:
    """The lines from each point to the next."""
    return [svgelements.Line(start, end) for start, end in pairwise(points)]


def _around(centre: XY, rx: float, ry: float) -> list[svgelements.Arc]:
    """A circle or an ellipse: one arc."""
    start = centre[0] + rx, centre[1]
    whole = {"rx": rx, "ry": ry, "rotation": 0.0, "sweep": 2 * pi}
    return [svgelements.Arc(start, start, centre, **whole)] if rx > 0 and ry > 0 else []


def _corner_of(element: ElementTree.Element, view: View, before: XY) -> XY:
    """The first place of a text or of a part of it, in its own pixels; what is not told is as it was before."""

    def first(name: str, whole: float | None) -> float | None:
        return length_of((element.get(name) or "").replace(",", " ").partition(" ")[0], whole, view.px)

    x, y = (
        (was if (place := first(side, whole)) is None else place) + (first(f"d{side}", whole) or 0.0)
        for side, whole, was in zip("xy", view.size, before, strict=True)
    )
    return x, y


def _size_of(view: View) -> float:
    """The size of letters, pixels; one that is no length is that of browsers."""
    with suppress(ValueError):
        return length_of(view.style.font_size, None, view.px) or _SIZE
    return _SIZE


def collect(file: SvgFile, px: float, options: ReadOptions) -> Content:
    """Return the shapes of a drawing, and the edges of those that are wanted, in mm, y upwards from the page's lower
    edge. `px`: mm in one pixel."""
    shown = list(file.shown())
    options.check_layers(item.view.layer for item in shown)
    collector = _SvgCollector(file, px, options)
    for item in shown:
        collector.take(item)
    return collector.content()


class _SvgCollector:
    """Accounts for what is drawn, one by one, and keeps the edges of what is to be cut."""

    def __init__(self, file: SvgFile, px: float, options: ReadOptions) -> None:
        self.file = file
        self.px = px
        self.options = options
        self.shapes = _Shapes(file.height, px, options.fit_tolerance)
        self.result = Content()
        # Shapes that the notes mention, and shapes without a line or an area, cut if there is nothing else.
        self.clipped: list[Entity] = []
        self.outside: list[Entity] = []
        self.wide: list[Entity] = []
        self.marked: list[Entity] = []
        self.unpainted: list[tuple[Entity, list[Edge]]] = []

    def take(self, item: Shown) -> None:
        """Account for one element that is drawn."""
        kind, layer = tag_of(item.element), item.view.layer
        account = Entity(kind, layer, (0.0, 0.0), self.options.unwanted(layer) or item.reason)
        self.result.entities.append(account)
        if kind == "text" and not (item.view.hidden or self.options.unwanted(layer)):
            with suppress(*UNREADABLE):
                self._write(item)
        if kind not in SHAPES or item.reason and item.reason.code == "reason-unread":
            account.is_odd = not item.view.hidden and kind not in NOTES
            return
        try:
            outline = _outline(item.element, item.view)
            self.shapes.matrix, self.shapes.entity = item.view.matrix, len(self.result.entities) - 1
            check_vertices(len(outline), kind)
            edges = list(self.shapes.edges(outline))
        except UNREADABLE as error:
            account.reason = account.reason or reason_of(error)
            account.is_odd = not item.view.hidden
            return
        if edges:
            account.place = edges[0].start
        is_seen = not item.reason and item.view.style.is_painted and not item.view.style.is_hidden
        if self.options.is_by_layer(account.reason) and is_seen and not self.options.is_start(layer):
            self.result.others += edges
            account.dashes = "stroke-dasharray" if item.view.style.is_dashed else ""
        account.reason = account.reason or (Phrase("reason-invisible") if item.view.style.is_hidden else None)
        if account.reason:
            return
        if self.options.is_start(layer):
            self._start(account, outline if edges else [])
        elif not item.view.matrix.determinant:
            account.reason = Phrase("reason-no-area")
        elif not edges:
            account.reason = Phrase("reason-no-length")
        elif not item.view.style.is_painted:
            account.reason = _UNPAINTED
            self.unpainted.append((account, edges))
        else:
            self._cut(account, item.view, edges)

    def _write(self, item: Shown) -> None:
        """Keep a text, for who looks at the drawing: each part of it that has a place of its own."""
        view = item.view
        lines: list[tuple[XY, list[str]]] = []
        for element in item.element.iter():
            if element is item.element or element.get("x") or element.get("y") or element.get("dy"):
                before = lines[-1][0] if lines else (0.0, 0.0)
                lines.append((_corner_of(element, view, before), []))
            lines[-1][1].append(element.text or "")
            lines[-1][1].append((element.tail or "") if element is not item.element else "")
        size = _size_of(view)
        self.shapes.matrix = view.matrix
        for (x, y), parts in lines:
            if text := " ".join("".join(parts).split()):
                x -= _ANCHORS.get(view.style.anchor, 0.0) * _WIDTH * size * len(text)
                foot, head = (self.shapes.point(svgelements.Point(x, up)) for up in (y, y - _CAPITAL * size))
                self.result.written.append(Written(text, foot, minus(head, foot)))

    def _start(self, account: Entity, outline: Sequence[svgelements.PathSegment]) -> None:
        """A shape on the layer of start holes: a circle is one, about its middle."""
        account.reason = Phrase("reason-start-hole") if account.kind == "circle" else NOTE
        if account.kind == "circle" and outline:
            self.result.starts.append(self.shapes.point(outline[0].center))

    def _cut(self, account: Entity, view: View, edges: list[Edge]) -> None:
        """A shape that is cut; how it is drawn may have to be said."""
        self.result.edges += edges
        style = view.style
        account.dashes = "stroke-dasharray" if style.is_dashed else ""
        places = [(x / self.px, self.file.height - y / self.px) for edge in edges for x, y in edge.extremes()]
        if view.is_clipped or not all(frame.holds(places) for frame in view.frames):
            self.clipped.append(account)
        if self.file.page and not self.file.page.holds(places):
            self.outside.append(account)
        if style.has_markers and account.kind in _MARKED:
            self.marked.append(account)
        if style.width * sqrt(abs(view.matrix.determinant)) * self.px > _WIDE:
            self.wide.append(account)

    def content(self) -> Content:
        """All that was found, with what is to be said of it."""
        result = self.result
        result.notes += self._of_page()
        if not result.edges:
            for account, edges in self.unpainted:
                account.reason = None
                result.edges += edges
            result.notes += by_layer("seen-unpainted", (account for account, _ in self.unpainted))
        result.notes += by_layer("seen-clipped", self.clipped)
        result.notes += by_layer("seen-outside", self.outside)
        result.notes += by_layer("seen-wide", self.wide, wide=_WIDE)
        result.notes += by_layer("seen-markers", self.marked)
        return result

    def _of_page(self) -> Iterator[Finding]:
        """Report parts of the page that are not read."""
        if self.file.style.transform:
            yield Finding("page-transformed", transform=self.file.style.transform)
        if self.file.animations:
            yield Finding("animations", count=self.file.animations)
        for name in self.file.elsewhere:
            yield Finding("sheet-elsewhere", name=name)
        if missed := self.file.sheet.missed:
            yield Finding("rules-missed", count=len(missed), first=missed[0])


class _Shapes:
    """Turns shapes into edges. `matrix`: from the present shape's pixels to those of the page; `entity`: its number."""

    def __init__(self, height: float, factor: float, tolerance: float) -> None:
        self.height = height
        self.factor = factor
        self.tolerance = tolerance
        self.matrix = svgelements.Matrix()
        self.entity = -1

    def point(self, point: svgelements.Point) -> XY:
        """A place in mm, y upwards."""
        point = self.matrix.point_in_matrix_space(point)
        x, y = point.x * self.factor, (self.height - point.y) * self.factor
        if not (is_number(x) and is_number(y)):
            raise Unread(Phrase("reason-no-number"))
        return x, y

    def edges(self, path: Iterable[svgelements.PathSegment]) -> Iterator[Edge]:
        """A path's edges."""
        for segment in path:
            if isinstance(segment, svgelements.Arc):
                yield from self.arc(segment)
            elif isinstance(segment, svgelements.CubicBezier | svgelements.QuadraticBezier):
                yield from self.bezier([self.point(point) for point in segment])
            elif isinstance(segment, svgelements.Line | svgelements.Close) and segment.start is not None:
                yield from self.line(self.point(segment.start), self.point(segment.end or segment.start))

    def line(self, start: XY, end: XY) -> Iterator[Edge]:
        """A line, if it has a length."""
        if distance(start, end) > 0:
            yield Edge(start, end, entity=self.entity)

    def bezier(self, controls: list[XY]) -> Iterator[Edge]:
        """A Bézier curve."""
        from ezdxf.math import BSpline, Vec3  # (slow to import, and many drawings do not need it)

        controls = [Vec3(*control) for control in controls]
        if any(control != controls[0] for control in controls):
            for edge in spline_edges(BSpline(controls, order=len(controls)), self.tolerance):
                yield replace(edge, entity=self.entity)

    def arc(self, arc: svgelements.Arc) -> Iterator[Edge]:
        """An arc of an ellipse, or all of it."""
        start, end, centre, vertex, covertex = (
            self.point(point) for point in (arc.start, arc.end, arc.center, arc.prx, arc.pry)
        )
        u, v = minus(vertex, centre), minus(covertex, centre)
        area = cross(u, v)
        if abs(area) < 1e-12:
            # (an arc without a radius is a line)
            yield from self.line(start, end)
            return
        turned = -arc.sweep if self.matrix.determinant < 0 else arc.sweep
        if (turned > 0) == (area > 0):
            # With y upwards a turn that SVG calls positive is clockwise.
            v, area = (-v[0], -v[1]), -area
        rays = (minus(place, centre) for place in (start, end))
        first, last = (atan2(cross(u, ray) / area, cross(ray, v) / area) for ray in rays)
        sweep = (last - first) % (2 * pi)
        if distance(start, end) < 1e-9 and abs(turned) > 1:
            sweep = 2 * pi
        edge = conic(centre, u, v, first, sweep, self.tolerance, self.entity)
        if edge.nodes or sweep == 2 * pi:
            yield edge
        elif edge.length > 0:
            yield replace(edge, start=start, end=end)
