"""The tables of docs/rivals.md: what SKG writes for a definition is the element that the translator makes of it."""

from __future__ import annotations

import re

import pytest
import rivalhelp
import tkhhelp
from rivalhelp import ROOT

from skg.ref import real
from skg.ref.interpreter import Interpreter
from skg.ref.near import watching
from skg.ref.tape import Punch
from skg.ref.values import Circle, Line, Point, Value
from skg.rivals import making, tekhtran, tekhtran_making

PAGE = (ROOT / "docs" / "rivals.md").read_text().partition("## Every definition\n")[2].partition("\n## ")[0]
ROW = re.compile(r"^\| (?P<rival>`.+`) \| `(?P<skg>[^`]+)` \| [^|]+ \|$", re.M)
TABLES = [[(re.findall("`([^`]+)`", row["rival"]), row["skg"]) for row in ROW.finditer(part)]
          for part in re.split(r"^\| TEKHTRAN", PAGE, flags=re.M)]  # fmt: skip
XY_ROWS, TKH_ROWS = TABLES
ROUTINE = (ROOT / "examples" / "circles" / "touch-circles.skg").read_text().partition("\n800 ")
XY_SCENE = (
    "⊕D(3,4)⇒D1;⊕D(20,-6)⇒D2;⊕D(11,9)⇒D3;⊕D(8,18)⇒D4;⊕X(0,0,30)⇒X1;⊕X(10,0,120)⇒X2;⊕X(40,0,170)⇒X3;"
    "⊕X(0,30,180)⇒X4;⊕Y(10,8,5)⇒Y1;⊕Y(16,10,7)⇒Y2;⊕Y(30,-3,4)⇒Y3;"
)
TKH_SCENE = (
    "ТЧ1 = 3, 4\nТЧ2 = 20, -6\nТЧ3 = 8, 18\nТЧ4 = 0, 0\nТЧ5 = 15, 8\nПР1 = ТЧ4, 30\nПР2 = ТЧ2, 120\n"
    "КР1 = 10, 8, 5\nКР2 = 16, 10, 7\nКР3 = 30, -3, 4\nВЕ1 = 2, 1\nМК1 = 2, 3, 0, 4, 5, 6, 0, 7, 0, 0, 1, 0\n"
)
LETTERS = {Point: "P", Line: "S", Circle: "C"}
#: mm; the programs' own numbers have 12 decimals.
NEAR = 1e-8


def numbers(value: Value) -> list[real.Real]:
    """The canonical numbers."""
    match value:
        case Point():
            return [value.x, value.y]
        case Circle():
            return [value.x, value.y, value.r]
        case Line():
            return [value.a, value.b, value.g]
    return [value]


def same(one: Value, other: Value, signed: bool = True) -> bool:
    """Equal, or, unsigned, equal but for the direction of a line."""
    a, b = numbers(one), numbers(other)
    ways = [b] if signed or not isinstance(other, Line) else [b, [-n for n in b]]
    return any(max(abs(m - n) for m, n in zip(a, way, strict=True)) < NEAR for way in ways)


def with_skg(program: str, lines: list[str], tail: str = "") -> dict[str, Value]:
    """The variables of a translated program that goes on with these lines."""
    text = re.sub(r"^\d+ END\n?", "", program, flags=re.M)
    text += "".join(f"{n} {line}\n" for n, line in enumerate(lines, 700)) + tail
    with watching() as watch, real.mp.workprec(real.mp.prec):
        machine = Interpreter([], watch, Punch())
        assert machine.load(text) is None, (text, machine.paper)
        assert machine.run() is None, (text, machine.paper)
    return {f"{letter}{number}": value for (letter, number), value in machine.variables.items()}


def kind_of(definition: str) -> str:
    """D, X or Y: what a definition of XY makes."""
    word, first = re.match(r"([A-Z]+)\(([A-Z]?)", definition).groups()
    return first if word in ("PY", "ZD", "FS") else word


@pytest.mark.parametrize(("definitions", "skg"), XY_ROWS, ids=lambda value: str(value))
def test_xy(definitions: list[str], skg: str) -> None:
    frame = "".join(f"⊕{each};" for each in definitions if each.startswith("ZB"))
    for definition in definitions:
        if definition.startswith("ZB"):
            continue
        kind = kind_of(definition)
        letter = {"D": "P", "X": "S", "Y": "C"}[kind]
        program = rivalhelp.xy.translate(f"{XY_SCENE}{frame}⊕{definition}⇒{kind}90;")
        if skg == "SUB":
            found = with_skg(program, subroutine(definition), "800 " + ROUTINE[2])
            assert same(found["C90"], found["T1"]) or same(found["C90"], found["T2"]), definition
        else:
            found = with_skg(program, [f"{letter}91={skg}"])
            assert same(found[f"{letter}90"], found[f"{letter}91"]), definition


def subroutine(definition: str) -> list[str]:
    """The calls that name the elements of `Y(e,f,g)`, and both circles."""
    lines = ["I=900"]
    for sign, kind, number in re.findall(r"(-?)([DXY])(\d)", definition[1:]):
        letter, entry = {"D": ("P", 810), "X": ("S", 830), "Y": ("C", 820)}[kind]
        lines += [f"{letter}={sign}{letter}{number}", f"GOSUB {entry}"]
    return [*lines, "GOSUB 860", "T1=T", "GOSUB 970", "T2=T", "END"]


@pytest.mark.parametrize(("definitions", "skg"), TKH_ROWS, ids=lambda value: str(value))
def test_tekhtran(definitions: list[str], skg: str) -> None:
    (definition,) = definitions
    name = definition.partition(" ")[0]
    letter, number = {
        "ТЧ": ("P", 9),
        "ПР": ("S", 9),
        "КР": ("C", 9),
        "ВЕ": ("V", 9),
        "ЧЧ": ("D", 1),
    }[name[:2]]
    program = tkhhelp.translate(f"{TKH_SCENE}{definition}\n")
    found = with_skg(program, [f"{letter}91={skg}"])
    assert same(found[f"{letter}{number}"], found[f"{letter}91"], signed=False)


def test_every_definition_of_xy_has_a_row() -> None:
    shown = set()
    for definitions, _ in XY_ROWS:
        for definition in definitions:
            word, arguments = re.fullmatch(r"([A-Z]+)\((.*)\)", definition).groups()
            kinds = [re.sub("-", "", each)[0] for each in arguments.split(",")]
            shown.add((word, "".join(sorted(k if k in "DXY" else "N" for k in kinds))))
    forms = {(letter, "".join(sorted(kinds))) for letter, kinds in making.FORMS}
    assert len(forms) > 20
    assert forms <= shown
    assert {"PY", "ZD", "FS", "ZB"} <= {word for word, _ in shown}


def test_every_definition_of_tekhtran_has_a_row(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    used: set[str] = set()

    class Watched(dict):
        def __getitem__(self, name: str) -> object:
            used.add(name)
            return super().__getitem__(name)

    monkeypatch.setattr(tekhtran, "FORMS", Watched(tekhtran_making.FORMS))
    for definitions, _ in TKH_ROWS:
        tkhhelp.translate(f"{TKH_SCENE}{definitions[0]}\n")
    assert len(used) > 20
    # A plane is numbers; no element of SKG's. A tangent with its circle in front has its test in test_tekhtran.
    assert set(tekhtran_making.FORMS) - {"plane_at", "plane_of_numbers", "line_touching_first"} <= used
