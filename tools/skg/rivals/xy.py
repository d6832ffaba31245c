"""`skg xy`: an XY program made an SKG program (docs/spec/xy.md)."""

from __future__ import annotations

from dataclasses import dataclass, field

from lark import Token, Tree

from skg.rivals.formula import SkgText, decimal, join, minus
from skg.rivals.making import FORMS, LETTERS, Argument, NewElement, XYFrame, image, shift, spin
from skg.rivals.plane import TINY, ExactElement, ExactLine, ExactPoint, PlaneError, Real, mirrored, moved, mp, rotated
from skg.rivals.program import LAST_LINE, LAST_SUBSCRIPT, SkgProgram, packed, plain, too_long
from skg.rivals.route import Arc, Hung, area, contour, mirrored_items, without_doubles
from skg.rivals.start import entry, repeated, written
from skg.rivals.statement import Figure, TextFault, figure, first_token, placing, sign_of, token_of, tree_of
from skg.rivals.xy_text import statements

#: SKG's name for a bare name, and the first of the translator's own.
BARE, OWN = 100, 101
#: Routes that enclose no more (mm²) have no inside.
NO_AREA = Real("1e-6")
KINDS = {"d": "D", "x": "X", "y": "Y", "num": "N"}


def translate(text: str, title: str = "") -> str:
    """The SKG program that cuts what an XY program describes; `title`: its file's name. `RivalFault` for bad input."""
    machine = _Machine(SkgProgram(headings=[plain(title)]))
    with placing(text):
        for statement in statements(text, machine.has):
            machine.carry_out(statement)
        return machine.program.text()


@dataclass(frozen=True)
class _Copies:
    """A × that ends a route: how many of the items it repeats, and SKG's REP for it."""

    items: int
    statement: str
    goes_round: bool


@dataclass
class _Machine:
    """The elements made so far, and the SKG program for them."""

    program: SkgProgram
    elements: dict[str, ExactElement] = field(default_factory=dict)
    variables: dict[str, tuple[int, Real]] = field(default_factory=dict)
    frame: XYFrame = XYFrame()
    own: dict[str, int] = field(default_factory=dict)
    routes: int = 0

    def has(self, name: str) -> bool:
        """True if a name has been made."""
        return name in self.elements or name in self.variables

    # Writing ----------------------------------------------------------------------------------------------------

    def name_own(self, text: SkgText | None, value: ExactElement | Real) -> SkgText:
        """A name of the translator's own."""
        if isinstance(value, ExactPoint):
            letter = "P"
        elif isinstance(value, Real):
            letter = "D"
        else:
            letter = "S" if isinstance(value, ExactLine) else "C"
        subscript = self.own[letter] = self.own.get(letter, OWN - 1) + 1
        if subscript > LAST_SUBSCRIPT:
            raise too_long()
        name = f"{letter}{subscript}"
        self.program.assign(name, text, value)
        return SkgText(name)

    # Numbers and names ------------------------------------------------------------------------------------------

    def number(self, tree: Tree) -> Figure:
        """The value of a number, and its text."""
        return figure(tree, self._variable)

    def _variable(self, tree: Tree) -> Figure:
        index, value = self.variables[token_of(tree.children[0])]
        return value, SkgText(f"A{index}")

    def element(self, tree: Tree, sign: Token | None = None) -> Argument[ExactElement]:
        """An element by its name, and its sign."""
        token = token_of(tree.children[0])
        letter, subscript = token[0], token[1:] or str(BARE)
        text = SkgText(LETTERS[letter] + subscript)
        value = self.elements[token]
        if sign is not None and letter != "D":
            return Argument(letter, -value, minus(text), token, sign)
        return Argument(letter, value, text, token, sign)

    def argument(self, tree: Tree) -> Argument[Real | ExactElement]:
        """An argument of ⊕."""
        *sign, last = tree.children
        inner = tree_of(last)
        if inner.data in KINDS:
            return self.element(inner, sign_of(sign))
        value, text = self.number(inner)
        return Argument("N", value, text, first_token(inner))

    # Statements -------------------------------------------------------------------------------------------------

    def carry_out(self, tree: Tree) -> None:
        """One statement."""
        if tree.data == "cut":
            self.cut(tree.children)
            return
        try:
            getattr(self, f"_{tree.data}")(tree.children)
        except PlaneError as error:
            raise TextFault.of(token_of(tree.children[0]).start_pos, error) from None

    def _make(self, children: list) -> None:
        letter, (given, target) = children[1], _trees(children)
        arguments = [self.argument(tree) for tree in _trees(given.children)]
        kinds = "".join(argument.kind for argument in arguments)
        if (str(letter), kinds) not in FORMS:
            raise TextFault(letter.start_pos, "rival-nothing-made")
        allowed, form = FORMS[str(letter), kinds]
        for argument, may in zip(arguments, allowed, strict=True):
            if argument.sign and not may:
                raise TextFault(argument.sign.start_pos, "rival-no-sign")
        self._store(target, form(self.frame, *arguments))

    def _store(self, target: Tree, made: NewElement) -> None:
        token = token_of(target.children[0])
        name = LETTERS[token[0]] + (token[1:] or str(BARE))
        self.elements[str(token)] = made.value
        if len(token) == 1:
            self.program.rename(token, name)
        self.program.assign(name, made.text, made.value)

    def _image(self, children: list) -> None:
        element, line, target = _trees(children)
        mirror = self.argument(line)
        if mirror.kind != "X":
            raise TextFault(children[1].start_pos, "rival-mirror")
        e = self.element(element)
        made = NewElement(mirrored(e.value, mirror.of(ExactLine).value), image(e.value, e.text, mirror.text))
        self._store(target, made)

    def _move(self, children: list) -> None:
        element, x, y, target = _trees(children)
        e, by = self.element(element), self.frame.vector(self._number_argument(x), self._number_argument(y))
        self._store(target, NewElement(moved(e.value, by.value), shift(e, by)))

    def _number_argument(self, tree: Tree) -> Argument[Real]:
        value, text = self.number(tree)
        return Argument("N", value, text, first_token(tree))

    def _rotate(self, children: list) -> None:
        element, centre, tree, target = _trees(children)
        e, about = self.element(element), self.element(centre).of(ExactPoint)
        angle, text = self._rotation(children[5], tree)
        self._store(target, NewElement(rotated(e.value, angle, about.value), spin(e.text, about.text, text)))

    def _rotation(self, sign: Token | None, tree: Tree) -> tuple[Real, SkgText]:
        """An angle counter-clockwise: with a sign as it is, else clockwise."""
        angle, text = self.number(tree)
        return (angle, text) if sign is not None else (-angle, minus(text))

    def _frame_at(self, children: list) -> None:
        origin, angle = _trees(children)
        element = self.element(origin).of(ExactPoint)
        self._take_frame(element.value, self.name_own(element.text, element.value), angle)

    def _frame(self, children: list) -> None:
        *place, angle = _trees(children)
        (x, _), (y, _) = map(self.number, place)
        origin = ExactPoint(x, y)
        self._take_frame(origin, None if x == y == 0 else self.name_own(None, origin), angle)

    def _take_frame(self, origin: ExactPoint, text: SkgText | None, tree: Tree) -> None:
        angle, angle_text = self.number(tree)
        if "A" in angle_text.text and angle != 0:
            # The variable may change.
            angle_text = self.name_own(angle_text, angle)
        self.frame = XYFrame(origin, angle, text, None if angle == 0 else angle_text)

    def _assign(self, children: list) -> None:
        value, text = self.number(children[0])
        token = children[2]
        index = self.variables.get(token, (len(self.variables) + 1,))[0]
        self.variables[str(token)] = index, value
        self.program.rename(token, f"A{index}")
        self.program.assign(f"A{index}", text, value)

    # Routes -----------------------------------------------------------------------------------------------------

    def cut(self, children: list) -> None:
        """φ: the heading, the wire's offset, the items of the CUT, BACK."""
        *route, gap, hole, near = _trees(children)
        closes = next(child.start_pos for child in children if isinstance(child, Token) and child.type == "CLOSE")
        items, copies = self.items(route)
        hung = without_doubles(items)
        parts, begins = contour(hung, closes)
        distance, text = self.number(gap)
        enclosed = area(parts)
        if abs(enclosed) < NO_AREA and distance != 0:
            raise TextFault(closes, "rival-no-inside")
        if enclosed < 0:
            distance, text = -distance, minus(text)
        self.routes += 1
        sense = "COUNTER-CLOCKWISE" if enclosed > 0 else "CLOCKWISE"
        self.program.body.append(f"REM ROUTE {self.routes}, {sense}")
        start = entry(parts, self.element(near).of(ExactPoint).value, distance)
        cuts, ends = None, ["BACK"]
        if copies and len(hung) == len(items):
            is_open = copies.goes_round or hung[0].is_pin and hung[copies.items - 1].is_pin
            cuts = repeated(parts, begins[copies.items], start, self.name_own) if is_open else None
            ends = [copies.statement, "BACK"] if cuts else ends
        cuts = cuts or written(parts, start, self.name_own)
        self.program.body += [
            f"FROM {self.element(hole).text}",
            f"R={'0' if distance == 0 else text}",
            *packed("CUT", cuts),
            *ends,
        ]

    def items(self, trees: list[Tree]) -> tuple[list[Hung], _Copies | None]:
        """The items on the belt, with all copies and images, and the × that ends it, if one does."""
        items: list[Hung] = []
        copies: _Copies | None = None
        for tree in trees:
            token = first_token(tree)
            if tree.data in ("number", "times", "mirrored") and not items:
                raise TextFault(token.start_pos, "rival-point-first")
            copies = None
            match tree.data:
                case "point" | "circle":
                    e = self.element(tree_of(tree.children[-1]), sign_of(tree.children[:-1]))
                    assert not isinstance(e.value, ExactLine), "the grammar has points and circles here"
                    items.append(Hung(e.value, e.text, token))
                case "number":
                    value, text = self.number(tree_of(tree.children[0]))
                    items[-1] = _with_arc(items[-1], Arc(value, text, token))
                case "mirrored":
                    mirror = self.element(tree_of(tree.children[3])).of(ExactLine)

                    def mirror_item(item: Hung, mirror: Argument[ExactLine] = mirror) -> Hung:
                        return Hung(mirrored(item.value, mirror.value), join(item.text, "/", mirror.text), item.token)

                    items = mirrored_items(items, mirror_item)
                case _:
                    items, copies = self._copied(items, tree)
        return items, copies

    def _copied(self, items: list[Hung], tree: Tree) -> tuple[list[Hung], _Copies]:
        first, count, _, sign, centre, _, turned, _ = tree.children
        word, times = token_of(first), int(token_of(count))
        if times < 2:
            raise TextFault(word.start_pos, "rival-times")
        if times * len(items) > LAST_LINE:
            raise TextFault(word.start_pos, "rival-memory")
        about = self.element(tree_of(centre)).of(ExactPoint)
        angle, text = self._rotation(sign_of([sign]), tree_of(turned))
        copies = list(items)
        for copy in range(1, times):
            whole = (
                decimal(angle * copy)
                if mp.isint(angle * copy) or "A" not in text.text
                else join(SkgText(str(copy)), "*", text)
            )
            copies += [
                Hung(
                    rotated(item.value, angle * copy, about.value),
                    spin(item.text, about.text, whole),
                    item.token,
                    item.arc,
                )
                for item in items
            ]
        rest = mp.fmod(angle * times, 360)
        goes_round = min(abs(rest), 360 - abs(rest)) <= TINY
        return copies, _Copies(len(items), f"REP {times},{join(text, ':', about.text)}", goes_round)


def _trees(children: list) -> list[Tree]:
    """What stands between the words and symbols of a statement."""
    return [child for child in children if isinstance(child, Tree)]


def _with_arc(item: Hung, arc: Arc) -> Hung:
    if item.arc is not None:
        raise TextFault(arc.token.start_pos, "rival-two-numbers")
    if item.is_pin and arc.radius <= TINY:
        raise TextFault(arc.token.start_pos, "rival-fillet-radius")
    return Hung(item.value, item.text, item.token, arc)
