"""An SVG file: what is shown of it, where, and how it is drawn (view boxes, transforms, `use`, style sheets).

Its tree is gone through here; svgelements multiplies transforms.
"""

from __future__ import annotations

import gzip
import re
import zlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from io import BytesIO
from typing import Any
from xml.etree import ElementTree
from xml.parsers.expat import ErrorString

import svgelements

from skg.errors import UserError, of_library
from skg.geometry.plane import XY
from skg.messages.finding import Finding, Phrase
from skg.reading import budget
from skg.reading.curves import is_number
from skg.reading.svg_style import Style, StyleSheet
from skg.reading.unread import Unread, reason_of

#: mm in one of the units that a page's width is given in.
UNITS = {"mm": 1.0, "cm": 10.0, "in": 25.4, "pt": 25.4 / 72, "pc": 25.4 / 6, "q": 0.25}
#: A pixel, mm.
PX = 25.4 / 96
#: Elements that are cut; elements that are drawn, but are nothing to cut.
SHAPES = ("path", "rect", "circle", "ellipse", "line", "polyline", "polygon")
NOTES = {
    "text": Phrase("reason-text-to-paths"),
    "image": Phrase("reason-picture"),
    "foreignObject": Phrase("reason-not-svg"),
    "flowRoot": Phrase("reason-text"),
}
#: Elements that hold others; the children of any other are drawn where they are used, or not at all.
_GROUPS = ("g", "a", "svg", "switch")
#: Elements that are gone through.
_COUNTED = (*_GROUPS, *SHAPES, *NOTES, "use", "symbol")
#: Paint servers, and elements that move or change others.
_PAINTS = ("linearGradient", "radialGradient", "meshgradient", "pattern", "hatch", "solidcolor")
_ANIMATIONS = ("animate", "animateTransform", "animateMotion", "animateColor", "set")
_LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"
_MODE = "{http://www.inkscape.org/namespaces/inkscape}groupmode"
_SVG = "http://www.w3.org/2000/svg"
_LINK = "{http://www.w3.org/1999/xlink}href"
#: Sides that a transform may turn about.
_SIDES = {"left": "0", "top": "0", "center": "50%", "right": "100%", "bottom": "100%"}
#: Groups within groups within groups are no deeper than this.
_DEPTH = 300
#: No page is larger, pixels.
_MOST_PAGE = 1e12
#: A number.
NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
#: A number in a transform, and transforms of one number.
_VALUE, _AXES = rf"{NUMBER}[a-z%]*", "translate[xy]|scale[xy]|skew[xy]"
#: Transforms one after the other, each with as many numbers as it takes. (svgelements leaves out what it does not know)
_TRANSFORMS = re.compile(
    "|".join(
        rf"(?:{names})\s*\(\s*{_VALUE}(?:(?:\s*,\s*|\s+|(?=[+-])){_VALUE}){{{count}}}\s*\)"
        for names, count in (("matrix", 5), ("translate|scale|skew", "0,1"), ("rotate", 0), ("rotate", 2), (_AXES, 0))
    ).join((r"(?i:\s*(?:", r")\s*,?)*\s*"))
)
#: A point outside a frame by no more than this part of its larger side is within.
_NEAR_FRAME = 1e-3
#: Exceptions of a shape that cannot be read.
UNREADABLE = (ValueError, TypeError, ArithmeticError, IndexError, KeyError, AttributeError)


@dataclass(frozen=True)
class _Frame:
    """The page, or what a nested drawing is seen through: corner and size, `matrix` from where it stands to pixels."""

    matrix: svgelements.Matrix
    corner: XY
    size: XY

    def holds(self, places: list[XY]) -> bool:
        """Tell whether all of some places, in pixels, lie in it, or hardly outside."""
        if not self.matrix.determinant:
            return True
        (left, top), (width, height), near = self.corner, self.size, _NEAR_FRAME * max(self.size)
        return all(
            -near <= place.x - left <= width + near and -near <= place.y - top <= height + near
            for place in map(self._back.point_in_matrix_space, places)
        )

    @cached_property
    def _back(self) -> svgelements.Matrix:
        return ~self.matrix


@dataclass(frozen=True)
class View:
    """The surroundings of an element. `matrix`: from its coordinates to pixels; `size`: that of the view box, for
    percentages; `px`: mm in a pixel; `hidden`: why nothing of it is seen; `is_clipped`: whether only a part of it may
    be seen; `frames`: of the nested drawings around it."""

    matrix: svgelements.Matrix
    size: XY
    px: float
    layer: str = "0"
    style: Style = Style()
    hidden: Phrase | None = None
    is_clipped: bool = False
    frames: tuple[_Frame, ...] = ()


@dataclass(frozen=True)
class Shown:
    """An element that is shown, or skipped for a reason."""

    element: ElementTree.Element
    view: View
    reason: Phrase | None = None


class SvgFile:
    """The content of an SVG file. `units`: the name of the page's units and mm in one, None when it does not tell;
    `px`: mm in a pixel; `guessed`: how many of its program's are an inch. `animations`: how many there are."""

    def __init__(self, data: bytes) -> None:
        try:
            data = _unpacked(data) if data[:2] == b"\x1f\x8b" else data
            self.root = ElementTree.fromstring(data)
        except ElementTree.ParseError as error:
            row, column = error.position
            wrong = Phrase("xml-at", line=row, column=column + 1, detail=ErrorString(error.code))
            raise UserError(Finding("not-svg", what=wrong)) from None
        except (OSError, EOFError, zlib.error):
            raise UserError(Finding("not-svg", what=Phrase("packed-broken"))) from None
        except (ValueError, LookupError) as error:
            raise UserError(Finding("not-svg", what=of_library(error))) from None
        if tag_of(self.root) != "svg":
            raise UserError(Finding("svg-root", root=tag_of(self.root)))
        self.px, self.guessed = PX, "px-96"
        if b"Adobe Illustrator" in data[:2000]:
            self.px, self.guessed = 25.4 / 72, "px-illustrator"
        elif re.search(rb'inkscape:version="0\.([0-8]|91)', data[:20000]):
            self.px, self.guessed = 25.4 / 90, "px-inkscape"
        self.ids = {element.get("id", ""): element for element in self.root.iter() if element.get("id")}
        self.sheet = StyleSheet(
            self.root,
            (element for element in self.root.iter() if tag_of(element) == "style"),
            (name for name, element in self.ids.items() if tag_of(element) in _PAINTS),
        )
        # (a file may do without any name space)
        self._name_spaces = (_SVG, _name_space(self.root))
        self.animations = sum(tag_of(element) in _ANIMATIONS for element in self.root.iter())
        self.elsewhere = _elsewhere(data, self.sheet)
        try:
            box = _view_box(self.root)
        except Unread as error:
            raise UserError(Finding("svg-page", what=error.what)) from None
        self.style = self.sheet.style(self.root, self.root, Style())
        self.units = self._units()
        if box and self.units:
            # (the view box tells how large its shapes are)
            self.px = PX
        width, height = (_page_side(self._side(side), self.px) for side in ("width", "height"))
        if any(side is not None and not 0 < side < _MOST_PAGE for side in (width, height)):
            sides: dict[str, Any] = {name: self._side(name) or "?" for name in ("width", "height")}
            raise UserError(Finding("svg-page-size", **sides))
        # (a page that tells one side or none has that of its view box)
        if box and width is None:
            width = box[2] * (height / box[3] if height else 1.0)
        if box and height is None:
            height = box[3] * (width or 0.0) / box[2]
        self.page = _Frame(svgelements.Matrix(), (0.0, 0.0), (width, height)) if width and height else None
        self.height = height or 0.0
        size = width or 0.0, self.height
        self.view = View(_fitted(self.root, (0.0, 0.0), size), (box[2], box[3]) if box else size, self.px)

    def _side(self, name: str) -> str:
        """The page's width or height, as it is written."""
        return self.style.geometry.get(name, self.root.get(name, ""))

    def _units(self) -> tuple[str, float] | None:
        for side in ("width", "height"):
            unit = re.fullmatch(r"\s*[\d.eE+-]+\s*([a-zA-Z]+)\s*", self._side(side))
            if unit and unit[1].lower() in UNITS:
                return unit[1].lower().replace("in", "inch"), UNITS[unit[1].lower()]
        return None

    def shown(self) -> Iterator[Shown]:
        """All that is drawn, and what is left of it, in the order of the file; all that is in the file, if nothing is
        drawn."""
        budget.check_entities(self._count(self.root, {}))
        hidden = Phrase("reason-not-displayed") if self.style.display == "none" else None
        view = replace(self.view, style=self.style, hidden=hidden)
        is_empty = True
        for shape in self._children(self.root, view, (self.root,), ()):
            is_empty = False
            yield shape
        if is_empty:
            unshown = (element for element in self.root.iter() if tag_of(element) in (*SHAPES, "glyph"))
            yield from (Shown(element, view, Phrase("reason-shown-nowhere")) for element in unshown)

    def _count(self, element: ElementTree.Element, known: dict[ElementTree.Element, int], depth: int = 0) -> int:
        """Count the elements that one shows, those that are used as often as they are; an element in itself once."""
        if element not in known:
            known[element] = 1
            inner = [child for child in element if tag_of(child) in _COUNTED] if depth < _DEPTH else []
            target = self._target(element) if tag_of(element) == "use" and depth < _DEPTH else None
            inner += [target] if target is not None else []
            known[element] = 1 + sum(self._count(child, known, depth + 1) for child in inner)
        return known[element]

    def _target(self, use: ElementTree.Element) -> ElementTree.Element | None:
        """The element that a `use` shows; None if it is not in the file."""
        link = _link(use)
        return self.ids.get(link[1:]) if link.startswith("#") else None

    def _children(
        self,
        group: ElementTree.Element,
        view: View,
        around: tuple[ElementTree.Element, ...],
        used: tuple[ElementTree.Element, ...],
    ) -> Iterator[Shown]:
        if len(around) > _DEPTH:
            raise UserError(Finding("svg-too-deep", most=_DEPTH))
        shown = _switched(group) if tag_of(group) == "switch" else None
        for child in group:
            name = tag_of(child)
            if name in (*_GROUPS, *SHAPES, *NOTES, "use"):
                why = None if shown in (None, child) else Phrase("reason-not-displayed")
                if _name_space(child) not in self._name_spaces:
                    why = Phrase("reason-name-space")
                inner = replace(view, hidden=view.hidden or why) if why else view
                yield from self._one(child, name, inner, around, used)

    def _one(
        self,
        element: ElementTree.Element,
        name: str,
        view: View,
        around: tuple[ElementTree.Element, ...],
        used: tuple[ElementTree.Element, ...],
    ) -> Iterator[Shown]:
        """Yield the shapes that an element shows; `around`: those that it stands in, `used`: what is being used, the
        last innermost."""
        style = self.sheet.style(element, (self.root, *used)[-1], view.style)
        layer = view.layer
        if name == "g" and (element.get(_MODE) == "layer" or len(around) == 1):
            layer = element.get(_LABEL) or element.get("id") or layer
        hidden = view.hidden or (Phrase("reason-not-displayed") if style.display == "none" else None)
        hidden = hidden or (Phrase("reason-invisible") if style.is_clear else None)
        view = replace(view, layer=layer, style=style, hidden=hidden, is_clipped=view.is_clipped or style.is_clipped)
        try:
            if style.transform:
                view = replace(view, matrix=_transform(style, view) * view.matrix)
            if name == "use":
                shown = self._shown(element, view, around, used)
            elif name == "svg":
                inner = _framed(element, element, view, _corner(element, view))
                shown = self._children(element, inner, (*around, element), used)
            else:
                shown = self._children(element, view, (*around, element), used)
        except UNREADABLE as error:
            yield Shown(element, view, reason_of(error))
            return
        if name in NOTES:
            yield Shown(element, view, hidden or NOTES[name])
        elif name in SHAPES:
            yield Shown(element, view, hidden)
        else:
            yield from shown

    def _shown(
        self,
        element: ElementTree.Element,
        view: View,
        around: tuple[ElementTree.Element, ...],
        used: tuple[ElementTree.Element, ...],
    ) -> Iterable[Shown]:
        """Yield the shapes that a `use` shows."""
        target = self._target(element)
        if target is None or target in used:
            link = _link(element) or "#"
            why = Phrase("reason-link-lost" if target is None else "reason-link-itself", link=link)
            return [Shown(element, view, view.hidden or why)]
        name = tag_of(target)
        moved = replace(view, matrix=svgelements.Matrix.translate(*_corner(element, view)) * view.matrix)
        around, used = (*around, element), (*used, target)
        if name in ("symbol", "svg"):
            style = self.sheet.style(target, target, view.style)
            matrix = _transform(style, view) * moved.matrix if style.transform else moved.matrix
            inner = replace(moved, style=style, matrix=matrix)
            place = _corner(target, inner) if name == "svg" else (0.0, 0.0)
            return self._children(target, _framed(target, element, inner, place), (*around, target), used)
        if name in (*_GROUPS, *SHAPES, *NOTES, "use"):
            return self._one(target, name, moved, around, used)
        return []


def _unpacked(data: bytes) -> bytes:
    """The bytes of a packed file; one that is cut off is an `EOFError`, one that unpacks to too much a `UserError`."""
    with gzip.open(BytesIO(data)) as stream:
        unpacked = stream.read(budget.MOST_BYTES + 1)
    budget.check_bytes(len(unpacked))
    return unpacked


def tag_of(element: ElementTree.Element) -> str:
    """An element's name without its name space; nothing for a comment."""
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""


def _link(use: ElementTree.Element) -> str:
    """The address of what a `use` shows."""
    return (use.get("href") or use.get(_LINK) or "").strip()


def _name_space(element: ElementTree.Element) -> str:
    """Return the name space of an element; empty for a comment."""
    return element.tag.rpartition("}")[0].removeprefix("{") if isinstance(element.tag, str) else ""


def _elsewhere(data: bytes, sheet: StyleSheet) -> list[str]:
    """The names of style sheets that are not in the file."""
    links = re.findall(rb"""<\?xml-stylesheet\b[^>]*?\bhref\s*=\s*["']([^"']*)""", data[:20000])
    return [*(link.decode("utf-8", "replace") for link in links if not link.startswith(b"#")), *sheet.imported]


def _switched(group: ElementTree.Element) -> ElementTree.Element | None:
    """Return the child that a `switch` shows: the first whose conditions hold."""
    for child in group:
        languages = child.get("systemLanguage", "en").replace(" ", "").split(",")
        is_english = any(language.partition("-")[0] == "en" for language in languages)
        if tag_of(child) in (*_GROUPS, *SHAPES, "use") and is_english and not child.get("requiredExtensions"):
            return child
    return group


def length_of(text: str, whole: float | None, px: float) -> float | None:
    """A length in pixels of `px` mm; `whole` is that of 100 %. None where there is none, or nothing that it is a part
    of; one in units of a font or of a window, or a sum, is a `ValueError`."""
    text = text.strip()
    if text in ("", "auto"):
        return None
    match = re.fullmatch(rf"({NUMBER})\s*([a-zA-Z]*|%)", text)
    unit = match[2].lower() if match else None
    if match is None or unit not in ("", "px", "%", *UNITS):
        raise Unread(Phrase("unread-length", text=text))
    if unit == "%":
        if whole == 0:
            raise Unread(Phrase("unread-part", text=text))
        return None if whole is None else float(match[1]) / 100 * whole
    return float(match[1]) * (UNITS[unit] / px if unit in UNITS else 1.0)


def _page_side(text: str, px: float) -> float | None:
    """The page's width or height, pixels; None where it is that of a window."""
    try:
        return length_of(text, None, px)
    except ValueError:
        return None


def property_of(element: ElementTree.Element, view: View, name: str) -> str:
    """A length of an element's form as it is written: in a style sheet, else as an attribute."""
    return view.style.geometry.get(name, element.get(name, ""))


def _corner(element: ElementTree.Element, view: View) -> XY:
    """x and y of an element, in pixels."""
    x, y = (
        length_of(property_of(element, view, side), whole, view.px) for side, whole in zip("xy", view.size, strict=True)
    )
    return x or 0.0, y or 0.0


def _transform(style: Style, view: View) -> svgelements.Matrix:
    """An element's transform, which turns about its origin."""
    words = style.origin.split()[:2] or ["0", "0"]
    words = [*words, "center"][:2]
    if words[0] in ("top", "bottom") or words[1] in ("left", "right"):
        words.reverse()
    whole = [length_of(_SIDES.get(word, word), side, view.px) for word, side in zip(words, view.size, strict=True)]
    x, y = whole
    if x is None or y is None or style.box not in ("", "view-box"):
        raise Unread(Phrase("unread-origin", text=f"{style.origin}, {style.box}".strip(", ")))
    translate = svgelements.Matrix.translate
    if not _TRANSFORMS.fullmatch(style.transform):
        raise Unread(Phrase("unread-transform", text=style.transform))
    try:
        matrix = svgelements.Matrix(style.transform)
    except (LookupError, ValueError):
        raise Unread(Phrase("unread-transform", text=style.transform)) from None
    return translate(-x, -y) * matrix * translate(x, y)


def _view_box(element: ElementTree.Element) -> tuple[float, float, float, float] | None:
    """The view box of an element that has one: its corner, its width and height; one that is not four numbers is a
    `ValueError`."""
    text = element.get("viewBox", "").replace(",", " ").strip()
    if not text:
        return None
    numbers = [float(number) for number in text.split()] if re.fullmatch(rf"{NUMBER}(?:\s+{NUMBER}){{3}}", text) else ()
    if not numbers or not all(map(is_number, numbers)):
        raise Unread(Phrase("unread-view-box", text=text))
    x, y, width, height = numbers
    return (x, y, width, height) if width > 0 and height > 0 else None


def _fitted(element: ElementTree.Element, place: XY, size: XY) -> svgelements.Matrix:
    """From the view box of an element to the frame at a place that it fills."""
    box = _view_box(element)
    if box is None or not all(size):
        return svgelements.Matrix.translate(*place)
    scales = [side / part for side, part in zip(size, box[2:], strict=True)]
    words = (element.get("preserveAspectRatio") or "xMidYMid").split()
    if words[0] == "none":
        sx, sy = scales
    else:
        sx = sy = max(scales) if "slice" in words else min(scales)
    aligned = {"min": 0.0, "mid": 0.5, "max": 1.0}
    parts = [aligned.get(words[0][first : first + 3].lower(), 0.5) for first in (1, 5)]
    free = size[0] - sx * box[2], size[1] - sy * box[3]
    x, y = (corner + part * rest for corner, part, rest in zip(place, parts, free, strict=True))
    return svgelements.Matrix(sx, 0, 0, sy, x - sx * box[0], y - sy * box[1])


def _framed(inner: ElementTree.Element, outer: ElementTree.Element, view: View, place: XY) -> View:
    """The view within a nested drawing or a symbol; `outer`, which may be what uses it, tells the frame's size."""
    sides = []
    for side, whole in zip(("width", "height"), view.size, strict=True):
        # (attributes of a `use` go before the drawing's own; a style sheet before both)
        length = length_of(
            view.style.geometry.get(side) or outer.get(side) or inner.get(side, "") or "", whole, view.px
        )
        sides.append(whole if length is None else length)
    box = _view_box(inner)
    if box and not all(sides):
        raise Unread(Phrase("unread-no-frame"))
    matrix = _fitted(inner, place, (sides[0], sides[1])) * view.matrix
    frames = view.frames
    if all(sides) and not view.style.is_overflowing:
        frames = (*frames, _Frame(view.matrix, place, (sides[0], sides[1])))
    return replace(view, matrix=matrix, frames=frames, size=(box[2], box[3]) if box else (sides[0], sides[1]))
