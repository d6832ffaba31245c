"""Styles of SVG elements: attributes, style sheets, inheritance.

tinycss2 takes style sheets apart, cssselect2 says which elements a rule means.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import NamedTuple
from xml.etree.ElementTree import Element

import cssselect2
import tinycss2
from tinycss2 import ast

from skg.errors import UserError
from skg.messages.finding import Finding
from skg.reading.budget import check_tries

#: Properties of markers at the ends and corners of lines, such as heads of arrows.
_MARKERS = ("marker", "marker-start", "marker-mid", "marker-end")
#: Attributes that mean what the property of that name means.
_PROPERTIES = (
    "display", "visibility", "opacity", "fill", "fill-opacity", "stroke", "stroke-opacity", "stroke-width",
    "stroke-dasharray", "clip-path", "mask", "overflow", "transform", "transform-origin", "transform-box", *_MARKERS,
)  # fmt: skip
_PRESENTED = frozenset((*_PROPERTIES, "color", "font-size", "text-anchor"))
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
#: A reference to a variable, with its fallback.
_VARIABLE = re.compile(r"var\(\s*(--[\w-]+)\s*(?:,((?:[^()]|\([^()]*\))*))?\)")
#: Variables told by variables.
_DEPTH = 32
#: A rule that asks an element's ancestors in more ways than this is not understood: `g g g g path` at 100 levels takes
#: half a minute an element.
_MOST_WAYS = 100_000
#: Rules that hold under a condition.
_CONDITIONAL = ("media", "supports", "container", "layer", "scope")
#: A remark.
_REMARK = re.compile(r"/\*.*?\*/", re.DOTALL)


@dataclass(frozen=True)
class Style:
    """The style of an element, inheritance included: fill, stroke, its width and dashes, visibility.
    `variables`: values that are told once, by their names (--ink) in lower case. `origin` and `box`: what its transform
    turns about, and whose sides percentages there are of. `font_size`, `anchor`: of its texts. `geometry`: lengths of
    its form that are told as properties, not as attributes."""

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
    font_size: str = ""
    anchor: str = ""
    geometry: dict[str, str] = field(default_factory=dict)
    variables: dict[str, str] = field(default_factory=dict)

    @property
    def is_painted(self) -> bool:
        """Tell whether it has a line or an area."""
        return self._has_area or self.width > 0

    @property
    def has_markers(self) -> bool:
        """Tell whether something is drawn at its ends or corners."""
        return any(marker != "none" for marker in self.markers)

    @property
    def width(self) -> float:
        """Width of its line, in its own pixels; 0 without one."""
        return 0.0 if self.is_stroke_clear or self._is_clear(self.stroke) else self.stroke_width

    @property
    def _has_area(self) -> bool:
        return not self.is_fill_clear and not self._is_clear(self.fill)

    def _is_clear(self, colour: str) -> bool:
        """Tell whether nothing is seen of a line or an area of this colour."""
        return _CLEAR.fullmatch(self.color if colour == "currentcolor" else colour) is not None


class StyleSheet:
    """The rules of a drawing's style sheets. `page`: all of it, `styles`: its `style` elements, `paints`: the ids of
    its gradients and patterns."""

    def __init__(self, page: Element, styles: Iterable[Element], paints: Iterable[str]) -> None:
        self.paints = {name.lower() for name in paints}
        #: Selectors and conditions of rules that would show something otherwise, but are not understood.
        self.missed: list[str] = []
        #: Style sheets in other files.
        self.imported: list[str] = []
        self._page = page
        self._depth = _depth(page)
        #: Tries of rules at elements.
        self._tries = 0
        self._rules = cssselect2.Matcher()
        #: The rules' declarations for a tree's elements, those with precedence last.
        self._trees: dict[Element, dict[Element, list[_Declared]]] = {}
        for style in styles:
            if self._is_seen("media", style.get("media", "").strip()):
                try:
                    self._read(tinycss2.parse_stylesheet(style.text or "", True, True), {})
                except RecursionError:
                    raise UserError(Finding("sheet-too-deep")) from None

    def _in(self, tree: Element) -> dict[Element, list[_Declared]]:
        """Apply the rules to a tree's elements."""
        if not self._rules.order:
            return {}
        if tree not in self._trees:
            self._tries += self._rules.order * sum(1 for _ in tree.iter())
            check_tries(self._tries)
            outermost = tree
            if tree is not self._page:
                # (:root is the page, not a used tree: that stands in an element without a name)
                outermost = Element("")
                outermost.append(tree)
            self._trees[tree] = {
                wrapped.etree_element: [declared for *_, pseudo, declared in matches if pseudo is None]
                for wrapped in cssselect2.ElementWrapper.from_xml_root(outermost).iter_subtree()
                if (matches := self._rules.match(wrapped))
            }
        return self._trees[tree]

    def _is_seen(self, kind: str, condition: str) -> bool:
        """Tell whether rules under a condition hold on a screen; one that is not understood is kept in mind."""
        if kind == "media" and condition.lower() in ("", "screen", "all", "print"):
            return condition.lower() != "print"
        self.missed.append(f"@{kind} {condition}".strip())
        return False

    def _read(self, rules: list[ast.Node], namespaces: dict[str | None, str]) -> None:
        """Take the rules of a style sheet, or of a part of one; it may add to `namespaces`, what prefixes stand for."""
        for rule in rules:
            match rule.type, getattr(rule, "lower_at_keyword", ""):
                case "qualified-rule", _:
                    self._rule(rule, namespaces)
                case "at-rule", "import":
                    self.imported += _strings(rule.prelude)[:1]
                case "at-rule", "namespace":
                    prefix = next((token.value for token in rule.prelude if token.type == "ident"), None)
                    namespaces[prefix] = "".join(_strings(rule.prelude)[:1])
                case "at-rule", kind if kind in _CONDITIONAL and rule.content is not None:
                    if self._is_seen(kind, tinycss2.serialize(rule.prelude).strip()):
                        self._read(tinycss2.parse_rule_list(rule.content, True, True), namespaces)

    def _rule(self, rule: ast.QualifiedRule, namespaces: dict[str | None, str]) -> None:
        """Take one rule, if it changes how something is drawn."""
        declared = _declared(tinycss2.serialize(rule.content))
        names = declared.usual.keys() | declared.important.keys()
        has_rules = any(token.type == "{} block" for token in rule.content)
        if not (has_rules or names & (_PRESENTED | _GEOMETRY) or any(name.startswith("--") for name in names)):
            return
        is_slow = self._depth ** _descents(tinycss2.serialize(rule.prelude)) > _MOST_WAYS
        selectors = None if has_rules or is_slow else _selectors(rule.prelude, namespaces)
        if selectors is None:
            self.missed.append(tinycss2.serialize(rule.prelude).strip())
        for selector in selectors or ():
            self._rules.add_selector(selector, declared)

    def _colour(self, colour: str) -> str:
        """A colour in small letters; of a gradient that is not in the drawing the one in its place, or none."""
        paint = _PAINT.fullmatch(colour.lower())
        return (paint[2] or "none") if paint and paint[1] not in self.paints else colour.lower()

    def style(self, element: Element, tree: Element, outer: Style) -> Style:
        """Return the style of an element. `tree`: what rules know of around it, the whole page or all that is used
        with it; `outer`: how that is drawn in which it is shown."""
        declarations = [*self._in(tree).get(element, ()), _declared(element.get("style", ""))]
        declared: dict[str, str] = {}
        for declaration in declarations:
            declared |= declaration.usual
        for declaration in declarations:
            declared |= declaration.important
        variables = outer.variables | {name: value for name, value in declared.items() if name.startswith("--")}
        properties = {name: value.strip() for name, value in element.items() if name in _PRESENTED} | declared
        properties = {name: _resolved(value, variables) for name, value in properties.items()}
        properties = {name: value for name, value in properties.items() if value and value != "inherit"}
        visibility = properties.get("visibility")
        dashes = properties.get("stroke-dasharray")
        width = re.match(r"[\d.]+(?:e-?\d+)?", properties.get("stroke-width", ""))
        return replace(
            outer,
            fill=self._colour(properties.get("fill", outer.fill)),
            stroke=self._colour(properties.get("stroke", outer.stroke)),
            color=properties.get("color", outer.color).lower(),
            stroke_width=float(width[0]) if width else outer.stroke_width,
            is_fill_clear=_is_nothing(properties.get("fill-opacity"), outer.is_fill_clear),
            is_stroke_clear=_is_nothing(properties.get("stroke-opacity"), outer.is_stroke_clear),
            is_dashed=bool(re.search("[1-9]", dashes)) if dashes else outer.is_dashed,
            is_hidden=visibility in ("hidden", "collapse") if visibility else outer.is_hidden,
            display=properties.get("display", ""),
            transform=properties.get("transform", "").replace("none", ""),
            origin=properties.get("transform-origin", ""),
            box=properties.get("transform-box", ""),
            is_clear=_is_nothing(properties.get("opacity"), False),
            markers=_markers(properties, outer.markers),
            font_size=properties.get("font-size", outer.font_size),
            anchor=properties.get("text-anchor", outer.anchor),
            geometry={name: properties[name] for name in declared if name in _GEOMETRY and name in properties},
            variables=variables,
            is_overflowing=properties.get("overflow", "").startswith("visible"),
            is_clipped=any(properties.get(name, "none") != "none" for name in ("clip-path", "mask")),
        )


def _resolved(value: str, variables: dict[str, str]) -> str:
    """A value with what its variables stand for; nothing where one of them is told nowhere, or by itself."""
    for _ in range(_DEPTH):
        reference = _VARIABLE.search(value)
        if reference is None:
            return value
        known = variables.get(reference[1].lower(), reference[2])
        if known is None:
            return ""
        value = f"{value[: reference.start()]}{known.strip()}{value[reference.end() :]}"
    return ""


def _is_nothing(opacity: str | None, outer: bool) -> bool:
    """Tell whether an opacity is that of nothing; `outer`: where it is not told."""
    return outer if opacity is None else _NOTHING.fullmatch(opacity) is not None


def _markers(properties: dict[str, str], outer: tuple[str, ...]) -> tuple[str, ...]:
    """Return the markers at start, corners and end; `marker` sets all of them."""
    return tuple(properties.get(name, properties.get("marker", old)) for name, old in zip(_MARKERS, outer, strict=True))


def _selectors(
    tokens: list[ast.Node], namespaces: dict[str | None, str]
) -> list[cssselect2.compiler.CompiledSelector] | None:
    """Parse a rule; None if it is not understood."""
    # (`~` would search all of 20,000 siblings, for each of 20,000)
    if "~" in tokens:
        return None
    try:
        return cssselect2.compile_selector_list(tokens, namespaces)
    except Exception:
        # (not its own error alone: it makes a Python expression, which fails for hundreds of parts and for some slips)
        return None


def _depth(page: Element) -> int:
    """Levels of elements in elements."""
    level, depth = [page], 0
    while level:
        level, depth = [child for element in level for child in element], depth + 1
    return depth


def _descents(selectors: str) -> int:
    """Number of steps from an element to any in it, in the selector of some that has most."""
    return max(len(re.sub(r"\s*[>+]\s*", ">", selector).split()) - 1 for selector in selectors.split(","))


def _strings(tokens: list[ast.Node]) -> list[str]:
    """The strings among some tokens, and the addresses, quoted or not."""
    strings = []
    for token in tokens:
        if token.type in ("string", "url"):
            strings.append(token.value)
        elif token.type == "function" and token.lower_name == "url":
            strings += _strings(token.arguments)
    return strings


class _Declared(NamedTuple):
    """Declarations by the names of their properties; what is `important` goes before all that is not."""

    usual: dict[str, str]
    important: dict[str, str]


def _declared(text: str) -> _Declared:
    """The declarations in a text."""
    result = _Declared({}, {})
    for declaration in _REMARK.sub("", text).split(";"):
        name, colon, value = declaration.partition(":")
        value, mark, important = value.partition("!")
        if colon:
            declarations = result.important if mark and important.strip().lower() == "important" else result.usual
            declarations[name.strip().lower()] = value.strip()
    return result
