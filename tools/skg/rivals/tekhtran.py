"""`skg tekhtran`: a TEKHTRAN program made an SKG program (docs/spec/tekhtran.md)."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace

from lark import Token, Tree

from skg.rivals.formula import SkgText, call, decimal, literal, minus
from skg.rivals.plane import (
    TINY,
    ZERO,
    ExactCircle,
    ExactCurve,
    ExactLine,
    ExactPoint,
    PlaneError,
    Real,
    nearest,
    same_point,
)
from skg.rivals.program import LAST_SUBSCRIPT, STATEMENT, SkgProgram, packed, too_long
from skg.rivals.statement import Figure, TextFault, figure, first_token, placing, token_of, tree_of
from skg.rivals.tekhtran_contour import ContourItem, cut_items
from skg.rivals.tekhtran_making import FORMS, Matrix, Operand, normal
from skg.rivals.tekhtran_text import latin, statements

#: Kind -> SKG's letter.
LETTERS = {"POINT": "P", "LINE": "S", "CIRCLE": "C", "VECTOR": "V", "NUMBER": "D"}
#: Names that keep their number, up to 899; the first of those that do not.
_NUMBERED = re.compile(r"(?:ТЧ|ПР|КР|ВЕ)(0|[1-9][0-9]?|[1-8][0-9][0-9])")
OWN = 900
#: Prefix of the tokens of names that may be defined; the tokens of defined names.
NEW, KIND_WORDS = "NEW_", {*LETTERS, "MATRIX", "PLANE"}
#: Words that only hold others apart.
FILLERS = {"COMMA", "PERESECH", "CENTR"}
#: The canonical numbers of the plane of points without ПЛЗ.
HORIZONTAL = (ZERO, ZERO, Real(1), ZERO)
#: A name's letters that REM and PRINT show.
SHOWN_LETTERS = 30


def translate(text: str, title: str = "") -> str:
    """The SKG program that cuts what a TEKHTRAN program describes; `title`: its file's name.

    `RivalFault` for bad input.
    """
    machine = _TekhtranMachine(SkgProgram(headings=[latin(title)]))
    with placing(text):
        for statement in statements(text, machine.kind):
            machine.carry_out(statement)
        return machine.program.text()


@dataclass(frozen=True)
class _Named:
    """The meaning of a name: its kind, its value, its z, its name in SKG (matrices and planes: none)."""

    kind: str
    value: ExactPoint | ExactLine | ExactCircle | Real | Matrix
    z: Real
    skg: str = ""


@dataclass
class _Wire:
    """The wire's place, its point in SKG, and whether it is moving from its start hole."""

    place: ExactPoint
    name: str = ""
    is_moving: bool = False

    @property
    def text(self) -> str:
        """The place in SKG."""
        return self.name or str(literal(self.place))


@dataclass
class _TekhtranMachine:
    """The definitions so far, and the SKG program for them."""

    program: SkgProgram
    named: dict[str, _Named] = field(default_factory=dict)
    kinds: dict[str, str] = field(default_factory=dict)
    last: dict[str, int] = field(default_factory=dict)
    plane: tuple[Real, ...] = HORIZONTAL
    is_traced: bool = False
    wire: _Wire | None = None
    contours: int = 0

    def kind(self, name: str, is_new: bool) -> str | None:
        """The kind of what a name means, or, of a new name, the kind that it was declared as."""
        if is_new:
            return self.kinds.get(name)
        return self.named[name].kind if name in self.named else None

    def carry_out(self, tree: Tree) -> None:
        """One statement."""
        children = [child for child in tree.children if child is not None]
        try:
            getattr(self, f"_{tree.data}")(children)
        except PlaneError as error:
            raise TextFault.of(first_token(tree).start_pos, error) from None

    # Operands ---------------------------------------------------------------------------------------------------

    def number(self, tree: Tree) -> Figure:
        """The value of a number, and its text."""
        return figure(tree, self._name_of_number)

    def _name_of_number(self, tree: Tree) -> Figure:
        if tree.data == "coordinate":
            return self._coordinate(tree_of(tree.children[2]), token_of(tree.children[4]))
        named = self.named[token_of(tree.children[0])]
        assert isinstance(named.value, Real)
        return named.value, SkgText(named.skg)

    def _coordinate(self, index: Tree, name: Token) -> Figure:
        """КООРД."""
        axis, _ = self.number(index)
        if axis not in (1, 2, 3):
            raise TextFault(first_token(index).start_pos, "rival-one-to-three")
        return self.canonical(name)[int(axis) - 1]

    def canonical(self, name: Token) -> list[Figure]:
        """The numbers of a name's canonical form, and SKG's expressions for them."""
        named = self.named[name]
        parts = [call(f"K{index}", SkgText(named.skg)) for index in (1, 2, 3)]
        match named.value:
            case ExactPoint(x, y):
                return [(x, parts[0]), (y, parts[1]), (named.z, decimal(named.z))]
            case ExactCircle(centre, r):
                return list(zip((centre.x, centre.y, r), parts, strict=True))
            case ExactLine():
                values, runs_so = normal(named.value)
                return list(zip(values, parts if runs_so else map(minus, parts), strict=True))
            case tuple(numbers):
                return [(number, decimal(number)) for number in numbers]
        return [(named.value, SkgText(named.skg))]

    def operand(self, child: Tree | Token) -> Operand | Token:
        """An operand of a statement: a number, or the meaning of a name; words as they are."""
        if isinstance(child, Tree):
            return Operand(*self.number(child), first_token(child))
        if child.type not in KIND_WORDS:
            return child
        named = self.named[child]
        return Operand(named.value, SkgText(named.skg), child, named.z)

    # Definitions ------------------------------------------------------------------------------------------------

    def _title(self, children: list) -> None:
        self.program.headings.append(latin(children[0]))

    def _declare(self, children: list) -> None:
        for child in children:
            if child.type.startswith(NEW):
                self.kinds[str(child)] = child.type.removeprefix(NEW)

    def _define(self, children: list) -> None:
        form = next(child for child in children if isinstance(child, Tree))
        arguments = [self.operand(child) for child in form.children if child is not None and not _is_filler(child)]
        made = FORMS[form.data](*arguments)
        target = next(child for child in children if isinstance(child, Token) and child.type.startswith(NEW))
        kind = target.type.removeprefix(NEW)
        skg = self._skg_name(target, kind) if kind in LETTERS else ""
        if skg:
            assert not isinstance(made.value, tuple)
            self.program.assign(skg, made.text, made.value)
        self.kinds[str(target)] = kind
        self.named[str(target)] = _Named(kind, made.value, self._z(made.value) if made.z is None else made.z, skg)
        if self.wire and self.wire.name == skg:
            # The wire stays where that point was.
            self.wire.name = ""
        if self.is_traced and kind != "NUMBER":
            self._say_canonical(target)

    def _skg_name(self, name: Token, kind: str) -> str:
        if name in self.named:
            return self.named[name].skg
        numbered = _NUMBERED.fullmatch(name)
        if numbered:
            return LETTERS[kind] + numbered[1]
        letter = LETTERS[kind]
        number = self.last[letter] = self.last.get(letter, 0 if kind == "NUMBER" else OWN - 1) + 1
        if number > LAST_SUBSCRIPT:
            raise too_long()
        self.program.rename(_shown(name), f"{letter}{number}")
        return f"{letter}{number}"

    def _height(self, children: list) -> None:
        """ПЛЗ: a height, a plane, or none."""
        if isinstance(children[1], Tree):
            self.plane = (*HORIZONTAL[:3], self.number(children[1])[0])
        elif children[1].type == "OTMEN":
            self.plane = HORIZONTAL
        else:
            plane = self.named[children[1]].value
            assert isinstance(plane, tuple)
            if abs(plane[2]) <= TINY:
                raise PlaneError("rival-upright-plane")
            self.plane = plane

    def _z(self, value: object) -> Real:
        """The z of a point whose definition gives none; that of other kinds means nothing."""
        a, b, c, p = self.plane
        return (p - a * value.x - b * value.y) / c if isinstance(value, ExactPoint) else ZERO

    # Printing ---------------------------------------------------------------------------------------------------

    def _print(self, children: list) -> None:
        for child in children:
            if child.type in KIND_WORDS:
                self._say_canonical(child)

    def _say_canonical(self, name: Token) -> None:
        texts = (str(text) for _, text in self.canonical(name))
        self.program.body += packed("PRINT", [f'"{_shown(name)}"', *texts])

    def _trace(self, children: list) -> None:
        self.is_traced = children[1].type != "VYKL"

    # Moves ------------------------------------------------------------------------------------------------------

    def _start(self, children: list) -> None:
        place = self._place(children)
        self.program.body.append(f"FROM {place.text}")
        self.wire = place

    def _place(self, children: list) -> _Wire:
        """A place in a statement."""
        for child in children:
            if isinstance(child, Token) and child.type == "POINT":
                return _Wire(self._point(child), self.named[child].skg)
        x, y, *_ = (self.number(child)[0] for child in children if isinstance(child, Tree))
        return _Wire(ExactPoint(x, y))

    def _point(self, name: Token) -> ExactPoint:
        value = self.named[name].value
        assert isinstance(value, ExactPoint)
        return value

    def _curve(self, name: Token) -> ExactCurve:
        value = self.named[name].value
        assert isinstance(value, ExactCurve)
        return value

    def _started(self, token: Token) -> _Wire:
        if self.wire is None:
            raise TextFault(token.start_pos, "rival-not-started")
        return self.wire

    def _go(self, children: list) -> None:
        self._move(children[0], self._place(children))

    def _step(self, children: list) -> None:
        wire = self._started(children[0])
        steps = [self.number(child)[0] for child in children if isinstance(child, Tree)]
        if len(steps) > 1:
            self._move(children[0], _Wire(wire.place + ExactPoint(*steps[:2])))

    def _approach(self, children: list) -> None:
        wire = self._started(children[0])
        self._move(children[0], _Wire(nearest(wire.place, self._curve(children[2]))))

    def _move(self, token: Token, to: _Wire) -> None:
        """Straight to a place, on the wire's centre: a point more in an open CUT."""
        wire = self._started(token)
        if same_point(wire.place, to.place):
            return
        body = self.program.body
        if not wire.is_moving:
            body += ["R=0", f"CUT {wire.text},{to.text}"]
        elif body[-1].startswith("CUT") and len(body[-1]) + 1 + len(to.text) <= STATEMENT:
            body[-1] += f",{to.text}"
        else:
            body.append(f"CUT {to.text}")
        to.is_moving = True
        self.wire = to

    # Contours ---------------------------------------------------------------------------------------------------

    def _contour(self, children: list) -> None:
        word, *rest = children
        wire = self._started(word)
        if wire.is_moving:
            raise TextFault(word.start_pos, "rival-start-again")
        offset, text = ZERO, SkgText("0")
        if rest[0].type in ("SPRAVA", "SLEVA"):
            offset, text = self.number(rest[2])
            if offset <= 0:
                raise TextFault(first_token(rest[2]).start_pos, "rival-distance")
            if rest[0].type == "SLEVA":
                offset, text = -offset, minus(text)
            rest = rest[4:]
        self.contours += 1
        self.program.body.append(f"REM CONTOUR {self.contours}")
        own = self.last.get("P", OWN - 1)

        def name(expression: SkgText, place: ExactPoint) -> SkgText:
            """A point of this contour's own; the next contour takes the same names."""
            nonlocal own
            own += 1
            if own > LAST_SUBSCRIPT:
                return literal(place)
            self.program.assign(f"P{own}", expression, place)
            return SkgText(f"P{own}")

        cuts = cut_items(self._items(rest), word, wire.place, offset, name)
        self.program.assign("R", text, offset)
        self.program.body += [*packed("CUT", cuts), "BACK"]

    def _items(self, tokens: list[Token]) -> list[ContourItem]:
        items: list[ContourItem] = []
        for token in tokens:
            match token.type:
                case "POINT" | "LINE" | "CIRCLE":
                    value = self._point(token) if token.type == "POINT" else self._curve(token)
                    items.append(ContourItem(value, self.named[token].skg, token))
                case "POCHS":
                    items[-1] = items[-1].backwards()
                case "KHB" | "KHM" | "UB" | "UM":
                    items[-1] = replace(items[-1], choice=token)
        return items


def _is_filler(child: Tree | Token) -> bool:
    return isinstance(child, Token) and child.type in FILLERS


def _shown(name: str) -> str:
    """A name as REM and PRINT show it."""
    return latin(name)[:SHOWN_LETTERS]
