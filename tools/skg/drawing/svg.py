"""SVG drawings: their shapes as edges, lengths in millimetres; each is accounted for.

svgelements works out transforms, view boxes, units and `<use>`. The file's own tree is gone through first: what is
drawn there and not found again in svgelements' shapes is named.
"""

from __future__ import annotations

import gzip
import io
import re
from collections.abc import Iterator
from dataclasses import replace
from math import atan2, pi
from xml.etree import ElementTree

import svgelements
from ezdxf.math import BSpline, Vec3

from skg.drawing.account import Content, Entity
from skg.drawing.contour import Edge
from skg.drawing.shapes import conic, is_number, spline_edges
from skg.drawing.wishes import Wishes
from skg.errors import UserError
from skg.plane import XY, cross, distance, minus

#: mm in one of the units that a page's width is given in.
UNITS = {"mm": 1.0, "cm": 10.0, "in": 25.4, "pt": 25.4 / 72, "pc": 25.4 / 6, "q": 0.25}
#: svgelements' own unit, mm.
PX = 25.4 / 96
#: What is drawn, and what is drawn but is nothing to cut.
_SHAPES = ("path", "rect", "circle", "ellipse", "line", "polyline", "polygon")
_NOTES = {"text": "text, convert it to paths", "image": "a picture", "foreignObject": "not SVG", "flowRoot": "text"}
#: What stands in these is drawn where it is used, or not at all.
_HIDDEN = ("defs", "symbol", "clipPath", "mask", "marker", "pattern", "metadata", "namedview")
_LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"
_MODE = "{http://www.inkscape.org/namespaces/inkscape}groupmode"
#: Attributes that the shapes are found again by; `values` of svgelements hands them down.
_NUMBER, _LAYER = "skg-number", "skg-layer"
_NONE = re.compile(r"\bdisplay\s*:\s*none")
#: What a shape that cannot be read may raise.
_UNREADABLE = (ValueError, TypeError, ArithmeticError, IndexError, KeyError, AttributeError)


def is_svg(data: bytes, name: str) -> bool:
    """Whether a file is SVG: by its ending, else by its first lines."""
    return name.lower().endswith((".svg", ".svgz")) or b"<svg" in data[:4096]


class SvgFile:
    """What an SVG file holds. `units`: the name of the page's units and mm in one, None when it does not tell; then
    `guess` is mm in a pixel, and `guessed` says where that comes from."""

    def __init__(self, data: bytes) -> None:
        try:
            data = gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data
            self.root = ElementTree.fromstring(data)
        except (ElementTree.ParseError, OSError, EOFError, ValueError, LookupError) as error:
            raise UserError(f"not an SVG drawing that can be read ({error})") from None
        if _name(self.root) != "svg":
            raise UserError(f"not an SVG drawing, its root is {_name(self.root)}")
        self.units = self._units()
        self.guess, self.guessed = PX, "96 px are an inch"
        if b"Adobe Illustrator" in data[:2000]:
            self.guess, self.guessed = 25.4 / 72, "Illustrator has 72 px in an inch"
        elif re.search(rb'inkscape:version="0\.([0-8]|91)', data[:20000]):
            self.guess, self.guessed = 25.4 / 90, "old Inkscape has 90 px in an inch"
        for element in self.root.iter():
            if _name(element) == "path" and element.get("d") is None:
                element.set("d", "")
        self.drawn: list[tuple[str, str, bool]] = []
        self._number(self.root, "0", True)

    def _units(self) -> tuple[str, float] | None:
        for side in ("width", "height"):
            unit = re.fullmatch(r"\s*[\d.eE+-]+\s*([a-zA-Z]+)\s*", self.root.get(side, ""))
            if unit and unit[1].lower() in UNITS:
                return unit[1].lower().replace("in", "inch"), UNITS[unit[1].lower()]
        return None

    def _number(self, element: ElementTree.Element, layer: str, is_seen: bool) -> None:
        """Number what is drawn (its name, its layer, whether it is displayed), and write that and the layer on it."""
        for child in element:
            name = _name(child)
            if name in _HIDDEN or not name:
                continue
            inner = layer
            if name == "g" and (child.get(_MODE) == "layer" or element is self.root):
                inner = child.get(_LABEL) or child.get("id") or layer
            child.set(_LAYER, inner)
            shown = is_seen and not _NONE.search(f"display:{child.get('display', '')};{child.get('style', '')}")
            if name in _SHAPES or name in _NOTES:
                child.set(_NUMBER, str(len(self.drawn)))
                self.drawn.append((name, inner, shown))
            if name not in _NOTES:
                self._number(child, inner, shown)

    def shapes(self) -> Iterator[tuple[svgelements.Shape, int, str]]:
        """svgelements' shapes, each with its number and layer."""
        text = io.BytesIO(ElementTree.tostring(self.root))
        try:
            tree = svgelements.SVG.parse(text, reify=True, width="1000px", height="1000px")
        except _UNREADABLE as error:
            raise UserError(f"not an SVG drawing that can be read ({error or type(error).__name__})") from None
        self.height = float(tree.height or 0.0)
        for shape in tree.elements():
            if isinstance(shape, svgelements.Shape):
                yield shape, int(shape.values.get(_NUMBER, -1)), shape.values.get(_LAYER, "0")


def _name(element: ElementTree.Element) -> str:
    """An element's name without its name space; nothing for a comment."""
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""


def collect(file: SvgFile, px: float, factor: float, wishes: Wishes) -> Content:
    """Return the shapes of a drawing, and the edges of those that are wanted, in mm, y upwards from the page's lower
    edge. `px`: mm in one pixel of svgelements; `factor`: mm in the units of the page."""
    content = Content()
    wishes.check_layers(layer for _, layer, _ in file.drawn)
    found: set[int] = set()
    for shape, number, layer in file.shapes():
        found.add(number)
        kind = type(shape).__name__.lower().replace("simpleline", "line")
        account = Entity(kind, layer, (0.0, 0.0))
        content.entities.append(account)
        reader = _Shapes(file.height, px, wishes.fit_tolerance)
        try:
            edges = [replace(edge, entity=len(content.entities) - 1) for edge in reader.edges(shape)]
        except _UNREADABLE as error:
            account.left, account.is_odd = f"cannot be read ({error or type(error).__name__})", True
            continue
        if edges:
            x, y = edges[0].start
            account.place = x / factor, y / factor
        hidden = shape.values.get("visibility", "") in ("hidden", "collapse")
        account.left = wishes.unwanted(layer) or ("invisible" if hidden else "")
        if account.left:
            continue
        if wishes.is_start(layer):
            account.left = "a start hole" if kind == "circle" else "nothing to cut"
            if kind == "circle":
                content.starts.append(reader.point(shape.implicit_center))
            continue
        account.left = "" if edges else "it has no length"
        content.edges += edges
    for number, (name, layer, is_seen) in enumerate(file.drawn):
        if number not in found or name in _NOTES:
            why = _NOTES.get(name, "cannot be read") if is_seen else "not displayed"
            is_odd = is_seen and name in _SHAPES
            content.entities.append(Entity(name, layer, (0.0, 0.0), wishes.unwanted(layer) or why, is_odd))
    return content


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

    def edges(self, shape: svgelements.Shape) -> Iterator[Edge]:
        """One shape's edges."""
        path = svgelements.Path(shape)
        is_round = isinstance(shape, svgelements.Circle | svgelements.Ellipse)
        for segment in path:
            if isinstance(segment, svgelements.Arc):
                yield from self.arc(segment, is_round)
                if is_round:
                    return
            elif isinstance(segment, svgelements.CubicBezier | svgelements.QuadraticBezier):
                controls = [Vec3(*self.point(point)) for point in segment]
                if any(control != controls[0] for control in controls):
                    yield from spline_edges(BSpline(controls, order=len(controls)), self.tolerance)
            elif isinstance(segment, svgelements.Line | svgelements.Close) and segment.start is not None:
                edge = Edge(self.point(segment.start), self.point(segment.end or segment.start))
                if edge.length > 0:
                    yield edge

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
