"""The statements that milling adds, and the dialect that has them."""

from __future__ import annotations

from dataclasses import dataclass

from skg.ref.listing import STATEMENTS
from skg.ref.parser import Dialect, Tree
from skg.ref.statements import Expression


@dataclass(frozen=True)
class Feed:
    """F in the plane[, downwards]."""

    plane: Expression
    down: Expression | None


@dataclass(frozen=True)
class Heights:
    """Z cutting[, travel]."""

    cutting: Expression
    travel: Expression | None


@dataclass(frozen=True)
class Miscellaneous:
    """M number[, S or T]."""

    number: Expression
    value: Expression | None


@dataclass(frozen=True)
class Preparatory:
    """G number[, P]."""

    number: Expression
    value: Expression | None


@dataclass(frozen=True)
class Hole:
    """HOLE points."""

    points: tuple[Expression, ...]


class MillTree(Tree):
    """lark's tree to ours, with what milling adds."""

    def feed(self, children: list) -> Feed:
        return Feed(children[0], children[2])

    def heights(self, children: list) -> Heights:
        return Heights(children[0], children[2])

    def miscellaneous(self, children: list) -> Miscellaneous:
        return Miscellaneous(children[0], children[2])

    def preparatory(self, children: list) -> Preparatory:
        return Preparatory(children[0], children[2])

    def hole(self, children: list) -> Hole:
        return Hole(tuple(children[::2]))


#: The language of milling.md. FROM and FIT are tried before F, GOTO and GOSUB before G.
MILL = Dialect(("skg.lark", "mill/mill.lark"), MillTree, (*STATEMENTS, "HOLE", "F", "Z", "M", "G"))
