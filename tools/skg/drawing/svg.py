"""Shapes of an SVG drawing as edges, lengths in millimetres; each is accounted for.

svgelements reads what stands in an attribute: path data and transforms.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from math import atan2, hypot, pi, sqrt
from xml.etree import ElementTree

import svgelements

from skg.drawing.account import Content, Entity, counted, said
from skg.drawing.contour import Edge
from skg.drawing.shapes import conic, is_number, spline_edges
from skg.drawing.svg_file import NOTES, NUMBER, SHAPES, UNREADABLE, Drawn, SvgFile, View, length_of, property_of, tag_of
from skg.drawing.wishes import Wishes
from skg.errors import UserError
from skg.plane import XY, cross, distance, minus

#: More shapes than this are no drawing.
_MOST = 1_000_000
#: Shapes that may have markers at their ends and corners.
_MARKED = ("path", "line", "polyline", "polygon")
#: What stands in no path data.
_NO_PATH = re.compile(r"(?:[^\s,\d.eE+MmZzLlHhVvCcSsQqTtAa-]|[eE](?![+-]?\d)).*")
#: A line that is wider than this is said, mm.
_WIDE = 1.0
#: Why a shape is left that has neither a stroke nor a fill.
_UNPAINTED = "drawn with neither line nor area"


def _outline(element: ElementTree.Element, view: View) -> svgelements.Path:
    """A shape as a path, in pixels."""
    width, height = view.size
    wholes = {**dict.fromkeys(("x", "cx", "rx", "x1", "x2", "width"), width), "r": hypot(*view.size) / sqrt(2)}

    def given(name: str) -> float | None:
        return length_of(property_of(element, view, name), wholes.get(name, height))

    def radii() -> tuple[float | None, float | None]:
        """rx and ry; one that is not told, or below 0, is the other."""
        rx, ry = (None if length is None or length < 0 else length for length in map(given, ("rx", "ry")))
        return ry if rx is None else rx, rx if ry is None else ry

    def of(name: str) -> float:
        return given(name) or 0.0

    match tag_of(element):
        case "rect":
            rx, ry = radii()
            found = svgelements.Path()
            if of("width") > 0 and of("height") > 0:
                corner = min(rx or 0.0, of("width") / 2), min(ry or 0.0, of("height") / 2)
                found = svgelements.Path(svgelements.Rect(of("x"), of("y"), of("width"), of("height"), *corner))
        case "circle":
            found = _around((of("cx"), of("cy")), of("r"), of("r"))
        case "ellipse":
            rx, ry = radii()
            found = _around((of("cx"), of("cy")), rx or 0.0, ry or 0.0)
        case "line":
            found = svgelements.Path(svgelements.SimpleLine(of("x1"), of("y1"), of("x2"), of("y2")))
        case "polyline":
            found = svgelements.Path(svgelements.Polyline(_points(element)))
        case "polygon":
            found = svgelements.Path(svgelements.Polygon(_points(element)))
        case _:
            path = re.fullmatch(r"""path\(\s*["'](.*)["']\s*\)""", told := property_of(element, view, "d"), re.DOTALL)
            found = _path(path[1] if path else told)
    return (found * view.matrix).reify()


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
        raise ValueError(f"its path data, at {(wrong[0] if wrong else data.strip())[:10]}")
    try:
        return _PathData(data)
    except UNREADABLE:
        raise ValueError("its path data") from None


def _points(element: ElementTree.Element) -> list[float]:
    """The points of a polyline or polygon."""
    numbers = element.get("points", "").replace(",", " ")
    found = [float(number) for number in re.findall(NUMBER, numbers)]
    if re.sub(NUMBER, "", numbers).strip() or len(found) % 2:
        raise ValueError("its points")
    return found


def _around(centre: XY, rx: float, ry: float) -> svgelements.Path:
    """A circle or an ellipse."""
    return svgelements.Path(svgelements.Ellipse(*centre, rx, ry)) if rx > 0 and ry > 0 else svgelements.Path()


def collect(file: SvgFile, px: float, factor: float, wishes: Wishes) -> Content:
    """Return the shapes of a drawing, and the edges of those that are wanted, in mm, y upwards from the page's lower
    edge. `px`: mm in one pixel; `factor`: mm in the units of the page."""
    drawn: list[Drawn] = []
    for one in file.drawn():
        drawn.append(one)
        if len(drawn) > _MOST:
            raise UserError(f"more than {_MOST:,} shapes, expected a drawing")
    wishes.check_layers(one.view.layer for one in drawn)
    collector = _SvgCollector(file, px, factor, wishes)
    for one in drawn:
        collector.take(one)
    return collector.content()


class _SvgCollector:
    """Accounts for what is drawn, one by one, and keeps the edges of what is to be cut."""

    def __init__(self, file: SvgFile, px: float, factor: float, wishes: Wishes) -> None:
        self.file = file
        self.px = px
        self.factor = factor
        self.wishes = wishes
        self.shapes = _Shapes(file.height, px, wishes.fit_tolerance)
        self.found = Content()
        # What is said of shapes, and those without a line or an area, which are cut where there is nothing else.
        self.clipped: list[Entity] = []
        self.outside: list[Entity] = []
        self.wide: list[Entity] = []
        self.marked: list[Entity] = []
        self.unpainted: list[tuple[Entity, list[Edge]]] = []

    def take(self, one: Drawn) -> None:
        """Account for one element that is drawn."""
        kind, layer = tag_of(one.element), one.view.layer
        account = Entity(kind, layer, (0.0, 0.0), self.wishes.unwanted(layer) or one.left)
        self.found.entities.append(account)
        if kind not in SHAPES or one.left.startswith("cannot"):
            account.is_odd = not one.view.hidden and kind not in NOTES
            return
        try:
            outline = _outline(one.element, one.view)
            edges = self._edges(outline, kind)
        except UNREADABLE as error:
            account.left = account.left or f"cannot be read ({str(error) or type(error).__name__})"
            account.is_odd = not one.view.hidden
            return
        if edges:
            x, y = edges[0].start
            account.place = x / self.factor, y / self.factor
        account.left = account.left or ("invisible" if one.view.style.is_hidden else "")
        if account.left:
            return
        if self.wishes.is_start(layer):
            self._start(account, outline, bool(edges))
        elif not edges:
            account.left = "it has no length"
        elif not one.view.matrix.determinant:
            account.left = "its transform leaves no area, so that nothing is shown"
        elif not one.view.style.is_painted:
            account.left = _UNPAINTED
            self.unpainted.append((account, edges))
        else:
            self._cut(account, one.view, edges)

    def _edges(self, outline: svgelements.Path, kind: str) -> list[Edge]:
        """A shape's edges, with the number of its entity."""
        entity = len(self.found.entities) - 1
        return [replace(edge, entity=entity) for edge in self.shapes.edges(outline, kind in ("circle", "ellipse"))]

    def _start(self, account: Entity, outline: svgelements.Path, has_edges: bool) -> None:
        """A shape on the layer of start holes: a circle is one, about its middle."""
        account.left = "a start hole" if account.kind == "circle" else "nothing to cut"
        if account.kind == "circle" and has_edges:
            low_x, low_y, high_x, high_y = outline.bbox()
            middle = svgelements.Point((low_x + high_x) / 2, (low_y + high_y) / 2)
            self.found.starts.append(self.shapes.point(middle))

    def _cut(self, account: Entity, view: View, edges: list[Edge]) -> None:
        """A shape that is cut; how it is drawn may have to be said."""
        self.found.edges += edges
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
        found, some = self.found, ("shape", "shapes")
        found.notes += self._of_page()
        if not found.edges:
            for account, edges in self.unpainted:
                account.left = ""
                found.edges += edges
            found.notes += said((one for one, _ in self.unpainted), some, _UNPAINTED, "cut, there is nothing else")
        found.notes += said(self.clipped, some, "clipped or masked", "cut whole")
        found.notes += said(self.outside, some, "outside the page, or partly", "cut whole")
        found.notes += said(self.wide, some, f"drawn with a line wider than {_WIDE:g} mm", "the middle is cut")
        found.notes += said(self.marked, some, "drawn with markers, such as heads of arrows", "these are not cut")
        return found

    def _of_page(self) -> Iterator[str]:
        """What of the page as a whole is passed over."""
        if self.file.style.transform:
            yield f"the page itself is transformed ({self.file.style.transform}): passed over"
        if self.file.animations:
            yield f"{counted(self.file.animations, 'animation')}: passed over, all is cut as it stands without"
        for name in self.file.elsewhere:
            yield f"the style sheet {name} is in another file: passed over"
        if missed := self.file.sheet.missed:
            count = counted(len(missed), "rule", "rules")
            yield f"{count} of the style sheet not understood, as {missed[0]}: passed over"


class _Shapes:
    """Turns shapes into edges."""

    def __init__(self, height: float, factor: float, tolerance: float) -> None:
        self.height = height
        self.factor = factor
        self.tolerance = tolerance

    def point(self, point: svgelements.Point) -> XY:
        """A place in mm, y upwards."""
        at = point.x * self.factor, (self.height - point.y) * self.factor
        if not all(map(is_number, at)):
            raise ValueError("a place of it is no number")
        return at

    def edges(self, path: svgelements.Path, is_round: bool) -> Iterator[Edge]:
        """A path's edges; `is_round`: it is all of a circle or an ellipse."""
        for segment in path:
            if isinstance(segment, svgelements.Arc):
                yield from self.arc(segment, is_round)
                if is_round:
                    return
            elif isinstance(segment, svgelements.CubicBezier | svgelements.QuadraticBezier):
                yield from self.bezier([self.point(point) for point in segment])
            elif isinstance(segment, svgelements.Line | svgelements.Close) and segment.start is not None:
                edge = Edge(self.point(segment.start), self.point(segment.end or segment.start))
                if edge.length > 0:
                    yield edge

    def bezier(self, controls: list[XY]) -> Iterator[Edge]:
        """A Bézier curve."""
        from ezdxf.math import BSpline, Vec3  # (slow to import, and many drawings do not need it)

        controls = [Vec3(*control) for control in controls]
        if any(control != controls[0] for control in controls):
            yield from spline_edges(BSpline(controls, order=len(controls)), self.tolerance)

    def arc(self, arc: svgelements.Arc, is_round: bool) -> Iterator[Edge]:
        """An arc of an ellipse; `is_round`: all of it."""
        start, end, centre, one, other = (
            self.point(point) for point in (arc.start, arc.end, arc.center, arc.prx, arc.pry)
        )
        u, v = minus(one, centre), minus(other, centre)
        area = cross(u, v)
        if abs(area) < 1e-12:
            # (an arc without a radius is a line)
            if distance(start, end) > 0:
                yield Edge(start, end)
            return
        if (arc.sweep > 0) == (area > 0):
            # With y upwards a turn that SVG calls positive is clockwise.
            v, area = (-v[0], -v[1]), -area
        ways = (minus(place, centre) for place in (start, end))
        first, last = (atan2(cross(u, way) / area, cross(way, v) / area) for way in ways)
        sweep = (last - first) % (2 * pi)
        if is_round or distance(start, end) < 1e-9 and abs(arc.sweep) > 1:
            sweep = 2 * pi
        edge = conic(centre, u, v, first, sweep, self.tolerance)
        if edge.nodes or sweep == 2 * pi:
            yield edge
        elif edge.length > 0:
            yield replace(edge, start=start, end=end)
