"""Facts that the firmware's sources rely on, checked by the build.

A line `;! EXPRESSION -- who relies on it, and how` in a source is such a fact: the expression, over labels and
equates in the assembler's notation, must be true in every image that has the file.

    ;! LOADF == KEYB+1 -- INCH1 steps from the one to the other

`/` is whole division; numbers are decimal, or hexadecimal with an H behind them. Where a name is not defined in an
image (a variant leaves it out), that is an error too.
"""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable, Mapping

FACT = re.compile(r"^\s*;!(.*)$", re.M)
PARTS = re.compile(r"\s*(.+?)\s+--\s+(\S.*)")
HEXADECIMAL = re.compile(r"\b(\d[0-9A-F]*)H\b")

OPERATORS: dict[type, Callable[[int, int], int]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.floordiv,
    ast.Mod: operator.mod,
    ast.BitAnd: operator.and_,
    ast.BitOr: operator.or_,
    ast.BitXor: operator.xor,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
}


def value(node: ast.expr, names: Mapping[str, int]) -> int:
    """The value of an expression; KeyError for an unknown name, ValueError for what is no expression of these."""
    match node:
        case ast.Constant(value=int(number)):
            return number
        case ast.Name(id=name):
            return names[name]
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -value(operand, names)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATORS:
            return OPERATORS[type(op)](value(left, names), value(right, names))
        case ast.Compare(left=left, ops=[op], comparators=[right]) if type(op) in OPERATORS:
            return OPERATORS[type(op)](value(left, names), value(right, names))
        case ast.BoolOp(op=ast.And(), values=parts):
            return all(value(part, names) for part in parts)
    raise ValueError(ast.unparse(node))


def check(sources: Mapping[str, str], names: Mapping[str, int]) -> tuple[int, list[str]]:
    """Number of facts in the sources (texts by name), and a line for each that does not hold or cannot be read."""
    count, wrong = 0, []
    for file, source in sources.items():
        for fact in FACT.findall(source):
            count += 1
            parts = PARTS.fullmatch(fact)
            if not parts:
                wrong.append(f"{file}.asm: no fact: {fact.strip()}")
                continue
            text = HEXADECIMAL.sub(lambda digits: str(int(digits[1], 16)), parts[1])
            try:
                if not value(ast.parse(text, mode="eval").body, names):
                    wrong.append(f"{file}.asm: {parts[1]} does not hold: {parts[2]}")
            except KeyError as error:
                wrong.append(f"{file}.asm: {parts[1]}: there is no {error.args[0]}")
            except (SyntaxError, ValueError):
                wrong.append(f"{file}.asm: no expression: {parts[1]}")
    return count, wrong
