"""How SVG elements are drawn: attributes, style sheets, and what is handed down."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import NamedTuple
from xml.etree.ElementTree import Element

#: What is drawn at the ends and corners of lines, such as heads of arrows.
_MARKERS = ("marker", "marker-start", "marker-mid", "marker-end")
#: Attributes that mean what the property of that name means.
_PROPERTIES = (
    "display", "visibility", "opacity", "fill", "fill-opacity", "stroke", "stroke-opacity", "stroke-width",
    "stroke-dasharray", "clip-path", "mask", "overflow", "transform", "transform-origin", "transform-box", *_MARKERS,
)  # fmt: skip
_PRESENTED = frozenset((*_PROPERTIES, "color"))
#: Lengths of an element's form, which may be told as properties, too; they are not handed down.
_GEOMETRY = frozenset(("x", "y", "width", "height", "r", "rx", "ry", "cx", "cy", "d"))
#: Colours that are not seen (the fourth of a colour's numbers is 0), a gradient or a pattern by its id with the colour
#: where it is not there, and parts of a colour that are nothing.
_CLEAR = re.compile(
    r"none|transparent|#[0-9a-f]{3}0|#[0-9a-f]{6}00"
    r"|(?:rgba?|hsla?)\((?:(?:[^,]*,){3}|[^/]*/)\s*(?:0+\.?0*|\.0+)(?:e[+-]?\d+)?%?\s*\)"
)
_PAINT = re.compile(r"url\(\s*[\"']?#([^\"')]*)[\"']?\s*\)\s*(.*)")
_NOTHING = re.compile(r"-.*|\+?0*\.?0*%?")
#: What stands for a value that is told elsewhere, with that where it is told nowhere.
_VARIABLE = re.compile(r"var\(\s*(--[\w-]+)\s*(?:,((?:[^()]|\([^()]*\))*))?\)")
#: Variables told by variables.
_DEPTH = 32
#: Rules that hold under a condition: what stands before their braces, and in them.
_CONDITIONAL = re.compile(r"@(media|supports|container|layer)\b([^{};]*)\{((?:[^{}]*\{[^{}]*\})*[^{}]*)\}")
#: A selector's parts: a name, classes and ids.
_COMPOUND = re.compile(r"(\*|[\w-]+)?((?:[.#][\w-]+)*)")
#: A selector: such parts, one in another.
_SELECTOR = re.compile(r"PART(?: (?:> )?PART)*".replace("PART", r"(?:(?:\*|[\w-]+)(?:[.#][\w-]+)*|(?:[.#][\w-]+)+)"))


@dataclass(frozen=True)
class Style:
    """How an element is drawn, with what it has from those around it: fill, stroke, its width and dashes, visibility.
    `variables`: values that are told once, by their names (--ink) in lower case. `origin` and `box`: what its transform
    turns about, and whose sides percentages there are of. `geometry`: lengths of its form that are told as properties,
    not as attributes."""

    fill: str = "black"
    stroke: str = "none"
    color: str = "black"
    stroke_width: float = 1.0
    is_fill_clear: bool = False
    is_stroke_clear: bool = False
    is_dashed: bool = False
    is_hidden: bool = False
    display: str = ""
    transform: str = ""
    origin: str = ""
    box: str = ""
    is_clear: bool = False
    is_clipped: bool = False
    is_overflowing: bool = False
    markers: tuple[str, ...] = ("none",) * len(_MARKERS)
    geometry: dict[str, str] = field(default_factory=dict)
    variables: dict[str, str] = field(default_factory=dict)

    @property
    def is_painted(self) -> bool:
        """Whether it has a line or an area."""
        return self._has_area or self.width > 0

    @property
    def has_markers(self) -> bool:
        """Whether something is drawn at its ends or corners."""
        return any(marker != "none" for marker in self.markers)

    @property
    def width(self) -> float:
        """How wide its line is, in its own pixels; 0 without one."""
        return 0.0 if self.is_stroke_clear or self._is_clear(self.stroke) else self.stroke_width

    @property
    def _has_area(self) -> bool:
        return not self.is_fill_clear and not self._is_clear(self.fill)

    def _is_clear(self, colour: str) -> bool:
        """Whether nothing is seen of a line or an area of this colour."""
        return _CLEAR.fullmatch(self.color if colour == "currentcolor" else colour) is not None


class StyleSheet:
    """The rules of a drawing's style sheets: those whose selectors are names, classes, ids and what these stand in.

    `paints`: the ids of the drawing's gradients and patterns.
    """

    def __init__(self, text: str, paints: Iterable[str] = ()) -> None:
        self.paints = {name.lower() for name in paints}
        #: Weight, selector (parts from the outside in, ">" where one stands right in the one before), declarations.
        self.rules: list[tuple[tuple[int, int, int, int], list[str], _Declared]] = []
        #: Selectors and conditions of rules that would show something otherwise, but are not understood.
        self.missed: list[str] = []
        text = re.sub(r"/\*.*?\*/|<!--|-->", "", text, flags=re.DOTALL)
        #: Style sheets in other files.
        self.imported: list[str] = re.findall(r"""@import\s+(?:url\()?\s*["']?([^"')\s;]+)""", text)
        text = re.sub(r"@[\w-]+[^{};]*;", "", text, flags=re.DOTALL)
        text = _CONDITIONAL.sub(self._under_condition, text)
        for selectors, declarations in re.findall(r"([^{}]+)\{([^{}]*)\}", text):
            for selector in selectors.split(","):
                parts = selector.replace(">", " > ").replace(":root", "svg").split()
                declared = _declared(declarations)
                if _SELECTOR.fullmatch(" ".join(parts)):
                    marks = "".join(parts)
                    names = sum(part[0] not in "*.#>" for part in parts)
                    weight = marks.count("#"), marks.count("."), names, len(self.rules)
                    self.rules.append((weight, parts, declared))
                elif parts and (declared.usual.keys() | declared.important.keys()) & {*_PROPERTIES, *_GEOMETRY}:
                    self.missed.append(" ".join(parts))
        self.rules.sort(key=lambda rule: rule[0])

    def _under_condition(self, rule: re.Match[str]) -> str:
        """What of such rules holds on a screen."""
        if rule[1] == "media" and rule[2].strip() in ("screen", "all"):
            return rule[3]
        if (rule[1], rule[2].strip()) != ("media", "print"):
            self.missed.append(f"@{rule[1]} {rule[2].strip()}")
        return ""

    def _colour(self, told: str) -> str:
        """A colour in small letters; of a gradient that is not in the drawing the one in its place, or none."""
        paint = _PAINT.fullmatch(told.lower())
        return (paint[2] or "none") if paint and paint[1] not in self.paints else told.lower()

    def style(self, element: Element, around: tuple[Element, ...], outer: Style) -> Style:
        """How an element is drawn; `around`: those that it stands in, `outer`: how the last of these is drawn."""
        elements = (*around, element)
        found = [declarations for _, parts, declarations in self.rules if _fits(parts, elements)]
        found.append(_declared(element.get("style", "")))
        declared: dict[str, str] = {}
        for one in found:
            declared |= one.usual
        for one in found:
            declared |= one.important
        variables = outer.variables | {name: value for name, value in declared.items() if name.startswith("--")}
        told = {name: value.strip() for name, value in element.items() if name in _PRESENTED} | declared
        told = {name: _told(value, variables) for name, value in told.items()}
        told = {name: value for name, value in told.items() if value and value != "inherit"}
        visibility = told.get("visibility")
        dashes = told.get("stroke-dasharray")
        width = re.match(r"[\d.]+(?:e-?\d+)?", told.get("stroke-width", ""))
        return replace(
            outer,
            fill=self._colour(told.get("fill", outer.fill)),
            stroke=self._colour(told.get("stroke", outer.stroke)),
            color=told.get("color", outer.color).lower(),
            stroke_width=float(width[0]) if width else outer.stroke_width,
            is_fill_clear=_is_nothing(told.get("fill-opacity"), outer.is_fill_clear),
            is_stroke_clear=_is_nothing(told.get("stroke-opacity"), outer.is_stroke_clear),
            is_dashed=bool(re.search("[1-9]", dashes)) if dashes else outer.is_dashed,
            is_hidden=visibility in ("hidden", "collapse") if visibility else outer.is_hidden,
            display=told.get("display", ""),
            transform=told.get("transform", "").replace("none", ""),
            origin=told.get("transform-origin", ""),
            box=told.get("transform-box", ""),
            is_clear=_is_nothing(told.get("opacity"), False),
            markers=_markers(told, outer.markers),
            geometry={name: told[name] for name in declared if name in _GEOMETRY and name in told},
            variables=variables,
            is_overflowing=told.get("overflow", "").startswith("visible"),
            is_clipped=any(told.get(name, "none") != "none" for name in ("clip-path", "mask")),
        )


def _told(value: str, variables: dict[str, str]) -> str:
    """A value with what its variables stand for; nothing where one of them is told nowhere, or by itself."""
    for _ in range(_DEPTH):
        found = _VARIABLE.search(value)
        if found is None:
            return value
        known = variables.get(found[1].lower(), found[2])
        if known is None:
            return ""
        value = f"{value[: found.start()]}{known.strip()}{value[found.end() :]}"
    return ""


def _is_nothing(opacity: str | None, outer: bool) -> bool:
    """Whether an opacity is that of nothing; `outer`: where it is not told."""
    return outer if opacity is None else _NOTHING.fullmatch(opacity) is not None


def _markers(told: dict[str, str], outer: tuple[str, ...]) -> tuple[str, ...]:
    """What is drawn at the start, at corners and at the end; `marker` tells all of them."""
    return tuple(told.get(name, told.get("marker", old)) for name, old in zip(_MARKERS, outer, strict=True))


class _Declared(NamedTuple):
    """Declarations by the names of their properties; what is `important` goes before all that is not."""

    usual: dict[str, str]
    important: dict[str, str]


def _declared(text: str) -> _Declared:
    """The declarations in a text."""
    found = _Declared({}, {})
    for declaration in text.split(";"):
        name, colon, value = declaration.partition(":")
        value, mark, important = value.partition("!")
        if colon:
            some = found.important if mark and important.strip().lower() == "important" else found.usual
            some[name.strip().lower()] = value.strip()
    return found


def _fits(parts: list[str], elements: tuple[Element, ...]) -> bool:
    """Whether a selector means the last of some elements, each of which stands in the one before."""
    *outer, last = parts
    if not elements or not _is(last, elements[-1]):
        return False
    if not outer:
        return True
    if outer[-1] == ">":
        return _fits(outer[:-1], elements[:-1])
    return any(_fits(outer, elements[:at]) for at in range(len(elements) - 1, 0, -1))


def _is(part: str, element: Element) -> bool:
    """Whether a part of a selector means an element."""
    name, marks = _COMPOUND.fullmatch(part).groups()  # type: ignore[union-attr]
    if name not in (None, "*") and element.tag.rpartition("}")[2] != name:
        return False
    classes = element.get("class", "").split()
    return all(
        mark[1:] in classes if mark[0] == "." else element.get("id") == mark[1:]
        for mark in re.findall(r"[.#][\w-]+", marks)
    )
