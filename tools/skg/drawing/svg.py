"""SVG drawings: their shapes as edges, lengths in millimetres; each is accounted for.

The tree is gone through here: what is shown of it, where, and how it is drawn (view boxes, transforms, `use`, style
sheets). svgelements reads what stands in an attribute: path data and transforms.
"""

from __future__ import annotations

import gzip
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from math import atan2, hypot, pi, sqrt
from xml.etree import ElementTree

import svgelements
from ezdxf.math import BSpline, Vec3

from skg.drawing.account import Content, Entity, counted, said
from skg.drawing.contour import Edge
from skg.drawing.shapes import conic, is_number, spline_edges
from skg.drawing.stylesheet import Style, StyleSheet
from skg.drawing.wishes import Wishes
from skg.errors import UserError
from skg.plane import XY, cross, distance, minus

#: mm in one of the units that a page's width is given in.
UNITS = {"mm": 1.0, "cm": 10.0, "in": 25.4, "pt": 25.4 / 72, "pc": 25.4 / 6, "q": 0.25}
#: A pixel, mm.
PX = 25.4 / 96
#: What is drawn, and what is drawn but is nothing to cut.
_SHAPES = ("path", "rect", "circle", "ellipse", "line", "polyline", "polygon")
_NOTES = {"text": "text, convert it to paths", "image": "a picture", "foreignObject": "not SVG", "flowRoot": "text"}
#: Shapes that may have markers at their ends and corners.
_MARKED = ("path", "line", "polyline", "polygon")
#: What holds others; what stands in anything else is drawn where it is used, or not at all.
_GROUPS = ("g", "a", "svg", "switch")
_LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"
_MODE = "{http://www.inkscape.org/namespaces/inkscape}groupmode"
_LINK = "{http://www.w3.org/1999/xlink}href"
#: Sides that a transform may turn about.
_SIDES = {"left": "0", "top": "0", "center": "50%", "right": "100%", "bottom": "100%"}
#: Groups within groups within groups; more shapes than this in all are no drawing.
_DEPTH, _MOST = 300, 1_000_000
#: A number, and what stands in no path data.
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_NO_PATH = re.compile(r"(?:[^\s,\d.eE+MmZzLlHhVvCcSsQqTtAa-]|[eE](?![+-]?\d)).*")
#: A line that is wider than this is said, mm.
_WIDE = 1.0
#: What is outside a frame by no more than this part of its larger side is within.
_NEAR_FRAME = 1e-3
#: Why a shape is left that has neither a stroke nor a fill.
_UNPAINTED = "drawn with neither line nor area"
#: What a shape that cannot be read may raise.
_UNREADABLE = (ValueError, TypeError, ArithmeticError, IndexError, KeyError, AttributeError)


def is_svg(data: bytes, name: str) -> bool:
    """Whether a file is SVG: by its ending, else by its first lines."""
    return name.lower().endswith((".svg", ".svgz")) or b"<svg" in data[:4096]


@dataclass(frozen=True)
class _Frame:
    """The page, or what a nested drawing is seen through: corner and size, `matrix` from where it stands to pixels."""

    matrix: svgelements.Matrix
    at: XY
    size: XY

    def holds(self, places: list[XY]) -> bool:
        """Whether all of some places, in pixels, lie in it, or hardly outside."""
        if not self.matrix.determinant:
            return True
        back, near = ~self.matrix, _NEAR_FRAME * max(self.size)
        return all(
            -near <= ordinate - low <= side + near
            for place in places
            for ordinate, low, side in zip(back.point_in_matrix_space(place), self.at, self.size, strict=True)
        )


@dataclass(frozen=True)
class _View:
    """Where an element stands. `matrix`: from its coordinates to pixels; `size`: that of the view box, for
    percentages; `hidden`: why nothing of it is seen; `is_clipped`: whether only a part of it may be seen; `frames`: of
    the nested drawings around it."""

    matrix: svgelements.Matrix
    size: XY
    layer: str = "0"
    style: Style = Style()
    hidden: str = ""
    is_clipped: bool = False
    frames: tuple[_Frame, ...] = ()


@dataclass(frozen=True)
class _Drawn:
    """An element that is drawn, or left for a reason."""

    element: ElementTree.Element
    view: _View
    left: str = ""


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
        self.guess, self.guessed = PX, "96 px are an inch"
        if b"Adobe Illustrator" in data[:2000]:
            self.guess, self.guessed = 25.4 / 72, "Illustrator has 72 px in an inch"
        elif re.search(rb'inkscape:version="0\.([0-8]|91)', data[:20000]):
            self.guess, self.guessed = 25.4 / 90, "old Inkscape has 90 px in an inch"
        self.ids = {element.get("id", ""): element for element in self.root.iter() if element.get("id")}
        self.sheet = StyleSheet(
            "".join(element.text or "" for element in self.root.iter() if _name(element) == "style")
        )
        self.elsewhere = _elsewhere(data, self.sheet)
        box = _view_box(self.root)
        self.style = self.sheet.style(self.root, (), Style())
        self.units = self._units()
        width, height = (_page_side(self._side(side)) for side in ("width", "height"))
        # (a page that tells one side or none has that of its view box)
        if box and width is None:
            width = box[2] * (height / box[3] if height else 1.0)
        if box and height is None:
            height = box[3] * (width or 0.0) / box[2]
        self.page = _Frame(svgelements.Matrix(), (0.0, 0.0), (width, height)) if width and height else None
        self.height = height or 0.0
        size = width or 0.0, self.height
        self.view = _View(_fitted(self.root, (0.0, 0.0), size), (box[2], box[3]) if box else size)

    def _side(self, name: str) -> str:
        """The page's width or height, as it is written."""
        return self.style.geometry.get(name, self.root.get(name, ""))

    def _units(self) -> tuple[str, float] | None:
        for side in ("width", "height"):
            unit = re.fullmatch(r"\s*[\d.eE+-]+\s*([a-zA-Z]+)\s*", self._side(side))
            if unit and unit[1].lower() in UNITS:
                return unit[1].lower().replace("in", "inch"), UNITS[unit[1].lower()]
        return None

    def drawn(self) -> Iterator[_Drawn]:
        """All that is drawn, and what is left of it, in the order of the file."""
        hidden = "not displayed" if self.style.display == "none" else ""
        view = replace(self.view, style=self.style, hidden=hidden)
        yield from self._children(self.root, view, (self.root,), ())

    def _children(
        self, group: ElementTree.Element, view: _View, around: tuple[ElementTree.Element, ...], used: tuple[str, ...]
    ) -> Iterator[_Drawn]:
        if len(around) > _DEPTH:
            raise UserError(f"groups within groups, more than {_DEPTH} deep")
        shown = _switched(group) if _name(group) == "switch" else None
        for child in group:
            name = _name(child)
            if name in (*_GROUPS, *_SHAPES, *_NOTES, "use"):
                inner = view if shown in (None, child) else replace(view, hidden=view.hidden or "not displayed")
                yield from self._one(child, name, inner, around, used)

    def _one(
        self,
        element: ElementTree.Element,
        name: str,
        view: _View,
        around: tuple[ElementTree.Element, ...],
        used: tuple[str, ...],
    ) -> Iterator[_Drawn]:
        """What one element shows; `around`: those that it stands in, `used`: what is being used."""
        style = self.sheet.style(element, around, view.style)
        layer = view.layer
        if name == "g" and (element.get(_MODE) == "layer" or len(around) == 1):
            layer = element.get(_LABEL) or element.get("id") or layer
        hidden = view.hidden or ("not displayed" if style.display == "none" else "invisible" * style.is_clear)
        view = replace(view, layer=layer, style=style, hidden=hidden, is_clipped=view.is_clipped or style.is_clipped)
        try:
            if style.transform:
                view = replace(view, matrix=_transform(style, view.size) * view.matrix)
            if name == "use":
                shown = self._shown(element, view, around, used)
            elif name == "svg":
                inner = _framed(element, element, view, _corner(element, view))
                shown = self._children(element, inner, (*around, element), used)
            else:
                shown = self._children(element, view, (*around, element), used)
        except _UNREADABLE as error:
            yield _Drawn(element, view, f"cannot be read ({str(error) or type(error).__name__})")
            return
        if name in _NOTES:
            yield _Drawn(element, view, hidden or _NOTES[name])
        elif name in _SHAPES:
            yield _Drawn(element, view, hidden)
        else:
            yield from shown

    def _shown(
        self,
        element: ElementTree.Element,
        view: _View,
        around: tuple[ElementTree.Element, ...],
        used: tuple[str, ...],
    ) -> Iterable[_Drawn]:
        """What a `use` shows."""
        link = (element.get("href") or element.get(_LINK) or "").strip()
        target = self.ids.get(link.removeprefix("#")) if link.startswith("#") else None
        if target is None or link in used:
            why = "is part of itself" if target is not None else "is not in the file"
            return [_Drawn(element, view, view.hidden or f"what it shows, {link or 'nothing'}, {why}")]
        name = _name(target)
        moved = replace(view, matrix=svgelements.Matrix.translate(*_corner(element, view)) * view.matrix)
        around, used = (*around, element), (*used, link)
        if name in ("symbol", "svg"):
            style = self.sheet.style(target, around, view.style)
            matrix = _transform(style, view.size) * moved.matrix if style.transform else moved.matrix
            inner = replace(moved, style=style, matrix=matrix)
            at = _corner(target, inner) if name == "svg" else (0.0, 0.0)
            return self._children(target, _framed(target, element, inner, at), (*around, target), used)
        if name in (*_GROUPS, *_SHAPES, *_NOTES, "use"):
            return self._one(target, name, moved, around, used)
        return []


def _name(element: ElementTree.Element) -> str:
    """An element's name without its name space; nothing for a comment."""
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""


def _elsewhere(data: bytes, sheet: StyleSheet) -> list[str]:
    """The names of style sheets that are not in the file."""
    links = re.findall(rb"""<\?xml-stylesheet\b[^>]*?\bhref\s*=\s*["']([^"']*)""", data[:20000])
    return [*(link.decode("utf-8", "replace") for link in links if not link.startswith(b"#")), *sheet.imported]


def _switched(group: ElementTree.Element) -> ElementTree.Element | None:
    """What a `switch` shows: the first that asks for nothing that is not there."""
    for child in group:
        languages = child.get("systemLanguage", "en").replace(" ", "").split(",")
        is_english = any(language.partition("-")[0] == "en" for language in languages)
        if _name(child) in (*_GROUPS, *_SHAPES, "use") and is_english and not child.get("requiredExtensions"):
            return child
    return group


def _length(text: str, whole: float | None) -> float | None:
    """A length in pixels; `whole` is that of 100 %. None where there is none, or nothing that it is a part of; one in
    units of a font or of a window, or a sum, is a `ValueError`."""
    text = text.strip()
    if text in ("", "auto"):
        return None
    found = re.fullmatch(rf"({_NUMBER})\s*([a-zA-Z]*|%)", text)
    unit = found[2].lower() if found else None
    if found is None or unit not in ("", "px", "%", *UNITS):
        raise ValueError(f"its length {text}")
    if unit == "%":
        if whole == 0:
            raise ValueError(f"its length {text}, of a frame without a size")
        return None if whole is None else float(found[1]) / 100 * whole
    return float(found[1]) * (UNITS[unit] / PX if unit in UNITS else 1.0)


def _page_side(text: str) -> float | None:
    """The page's width or height, pixels; None where it is that of a window."""
    try:
        return _length(text, None)
    except ValueError:
        return None


def _told(element: ElementTree.Element, view: _View, name: str) -> str:
    """A length of an element's form as it is written: in a style sheet, else as an attribute."""
    return view.style.geometry.get(name, element.get(name, ""))


def _corner(element: ElementTree.Element, view: _View) -> XY:
    """x and y of an element, in pixels."""
    x, y = (_length(_told(element, view, side), whole) for side, whole in zip("xy", view.size, strict=True))
    return x or 0.0, y or 0.0


def _transform(style: Style, size: XY) -> svgelements.Matrix:
    """An element's transform, which turns about its origin; `size`: that of the view box."""
    words = style.origin.split()[:2] or ["0", "0"]
    words = [*words, "center"][:2]
    if words[0] in ("top", "bottom") or words[1] in ("left", "right"):
        words.reverse()
    whole = [_length(_SIDES.get(word, word), side) for word, side in zip(words, size, strict=True)]
    if None in whole or style.box not in ("", "view-box"):
        raise ValueError(f"its transform-origin, {style.origin}, {style.box}".strip(", "))
    x, y = whole
    translate = svgelements.Matrix.translate
    return translate(-x, -y) * svgelements.Matrix(style.transform) * translate(x, y)


def _view_box(element: ElementTree.Element) -> tuple[float, float, float, float] | None:
    """The view box of an element that has one: its corner, its width and height."""
    try:
        x, y, width, height = (float(number) for number in element.get("viewBox", "").replace(",", " ").split())
    except ValueError:
        return None
    return (x, y, width, height) if width > 0 and height > 0 else None


def _fitted(element: ElementTree.Element, at: XY, size: XY) -> svgelements.Matrix:
    """From the view box of an element to the frame at a place that it fills."""
    box = _view_box(element)
    if box is None or not all(size):
        return svgelements.Matrix.translate(*at)
    scales = [side / part for side, part in zip(size, box[2:], strict=True)]
    words = (element.get("preserveAspectRatio") or "xMidYMid").split()
    if words[0] == "none":
        sx, sy = scales
    else:
        sx = sy = max(scales) if "slice" in words else min(scales)
    aligned = {"min": 0.0, "mid": 0.5, "max": 1.0}
    parts = [aligned.get(words[0][first : first + 3].lower(), 0.5) for first in (1, 5)]
    free = size[0] - sx * box[2], size[1] - sy * box[3]
    x, y = (corner + part * rest for corner, part, rest in zip(at, parts, free, strict=True))
    return svgelements.Matrix(sx, 0, 0, sy, x - sx * box[0], y - sy * box[1])


def _framed(inner: ElementTree.Element, outer: ElementTree.Element, view: _View, at: XY) -> _View:
    """The view within a nested drawing or a symbol; `outer`, which may be what uses it, tells the frame's size."""
    sides = []
    for side, whole in zip(("width", "height"), view.size, strict=True):
        # (what a `use` tells as attributes goes before the drawing's own; a style sheet before both)
        length = _length(view.style.geometry.get(side) or outer.get(side) or inner.get(side, ""), whole)
        sides.append(whole if length is None else length)
    box = _view_box(inner)
    if box and not all(sides):
        raise ValueError("a view box in a frame without a size")
    matrix = _fitted(inner, at, (sides[0], sides[1])) * view.matrix
    frames = view.frames
    if all(sides) and not view.style.is_overflowing:
        frames = (*frames, _Frame(view.matrix, at, (sides[0], sides[1])))
    return replace(view, matrix=matrix, frames=frames, size=(box[2], box[3]) if box else (sides[0], sides[1]))


def _outline(element: ElementTree.Element, view: _View) -> svgelements.Path:
    """A shape as a path, in pixels."""
    width, height = view.size
    wholes = {**dict.fromkeys(("x", "cx", "rx", "x1", "x2", "width"), width), "r": hypot(*view.size) / sqrt(2)}

    def given(name: str) -> float | None:
        return _length(_told(element, view, name), wholes.get(name, height))

    def radii() -> tuple[float | None, float | None]:
        """rx and ry; one that is not told, or below 0, is the other."""
        rx, ry = (None if length is None or length < 0 else length for length in map(given, ("rx", "ry")))
        return ry if rx is None else rx, rx if ry is None else ry

    def of(name: str) -> float:
        return given(name) or 0.0

    match _name(element):
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
            path = re.fullmatch(r"""path\(\s*["'](.*)["']\s*\)""", told := _told(element, view, "d"), re.DOTALL)
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
    except _UNREADABLE:
        raise ValueError("its path data") from None


def _points(element: ElementTree.Element) -> list[float]:
    """The points of a polyline or polygon."""
    numbers = element.get("points", "").replace(",", " ")
    found = [float(number) for number in re.findall(_NUMBER, numbers)]
    if re.sub(_NUMBER, "", numbers).strip() or len(found) % 2:
        raise ValueError("its points")
    return found


def _around(centre: XY, rx: float, ry: float) -> svgelements.Path:
    """A circle or an ellipse."""
    return svgelements.Path(svgelements.Ellipse(*centre, rx, ry)) if rx > 0 and ry > 0 else svgelements.Path()


def collect(file: SvgFile, px: float, factor: float, wishes: Wishes) -> Content:
    """Return the shapes of a drawing, and the edges of those that are wanted, in mm, y upwards from the page's lower
    edge. `px`: mm in one pixel; `factor`: mm in the units of the page."""
    drawn: list[_Drawn] = []
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

    def take(self, one: _Drawn) -> None:
        """Account for one element that is drawn."""
        kind, layer = _name(one.element), one.view.layer
        account = Entity(kind, layer, (0.0, 0.0), self.wishes.unwanted(layer) or one.left)
        self.found.entities.append(account)
        if kind not in _SHAPES or one.left.startswith("cannot"):
            account.is_odd = not one.view.hidden and kind not in _NOTES
            return
        try:
            outline = _outline(one.element, one.view)
            edges = self._edges(outline, kind)
        except _UNREADABLE as error:
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

    def _cut(self, account: Entity, view: _View, edges: list[Edge]) -> None:
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
