"""The syntax tree of a line: expressions and statements of language.md."""

from __future__ import annotations

from dataclasses import dataclass, field

from skg.ref.real import Real

# Expressions


@dataclass(frozen=True)
class Number:
    """A decimal constant."""

    value: Real
    column: int = field(compare=False)


@dataclass(frozen=True)
class Name:
    """A variable; its subscript is a constant or an expression in brackets."""

    letter: str
    subscript: int | Expression
    column: int = field(compare=False)


@dataclass(frozen=True)
class Minus:
    """Unary minus."""

    operand: Expression


@dataclass(frozen=True)
class Function:
    """SQR, SIN, COS, TG, ATG, ABS, INT, K1, K2, K3."""

    name: str
    argument: Expression


@dataclass(frozen=True)
class Binary:
    """Two operands and one of `, # : + - * /`."""

    operator: str
    left: Expression
    right: Expression


Expression = Number | Name | Minus | Function | Binary

# Statements


@dataclass(frozen=True)
class Assign:
    """name = expression."""

    name: Name
    value: Expression


@dataclass(frozen=True)
class From:
    """FROM point."""

    point: Expression


@dataclass(frozen=True)
class Cut:
    """CUT: each item with whether a `;` stands before it."""

    items: tuple[tuple[bool, Expression], ...]


@dataclass(frozen=True)
class Sym:
    """SYM line; `right`: the corner it makes turns right."""

    right: bool
    mirror: Expression


@dataclass(frozen=True)
class Rep:
    """REP count, rotation."""

    right: bool
    count: Expression
    rotation: Expression


@dataclass(frozen=True)
class Fit:
    """FIT node[, tangent angle]."""

    node: Expression
    angle: Expression | None


@dataclass(frozen=True)
class Tol:
    """TOL tolerance."""

    tolerance: Expression


@dataclass(frozen=True)
class Scale:
    """SCALE factor."""

    factor: Expression


@dataclass(frozen=True)
class Read:
    """READ names."""

    names: tuple[Name, ...]


@dataclass(frozen=True)
class Data:
    """DATA expressions, evaluated when they are read."""

    items: tuple[Expression, ...]


@dataclass(frozen=True)
class Restore:
    """RESTORE to the first DATA, or to the first at or after a line."""

    line: int | None


@dataclass(frozen=True)
class Print:
    """PRINT expressions and texts."""

    items: tuple[Expression | str, ...]


@dataclass(frozen=True)
class Input:
    """INPUT names."""

    names: tuple[Name, ...]


@dataclass(frozen=True)
class Goto:
    """GOTO line."""

    line: int


@dataclass(frozen=True)
class If:
    """IF left relation right GOTO line."""

    left: Expression
    relation: str
    right: Expression
    line: int


@dataclass(frozen=True)
class Gosub:
    """GOSUB line."""

    line: int


@dataclass(frozen=True)
class Simple:
    """A statement that is one word: BACK, RECUT, RETURN, END, REM."""

    word: str


Statement = (
    Assign
    | From
    | Cut
    | Sym
    | Rep
    | Fit
    | Tol
    | Scale
    | Read
    | Data
    | Restore
    | Print
    | Input
    | Goto
    | If
    | Gosub
    | Simple
)


@dataclass(frozen=True)
class ProgramLine:
    """A line of text: a number alone deletes, a statement without a number is carried out at once."""

    number: int | None
    statement: Statement | None
