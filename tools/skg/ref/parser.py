"""From the text of a line to its syntax tree. The grammar is `skg.lark`; lark makes the parser from it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from itertools import pairwise

from lark import Lark, Token, Transformer, UnexpectedInput, v_args

from skg.ref import real
from skg.ref.fault import Code, Fault
from skg.ref.listing import STATEMENTS, listed
from skg.ref.statements import (
    Assign,
    Binary,
    Cut,
    Data,
    Expression,
    Fit,
    From,
    Function,
    Gosub,
    Goto,
    If,
    Input,
    Minus,
    Name,
    Number,
    Print,
    ProgramLine,
    Read,
    Rep,
    Restore,
    Scale,
    Simple,
    Sym,
    Tol,
)

LAST_LINE = 9999
#: Characters of a line.
LONGEST = 126
#: Bytes that the machine has for the words of a line (language.md, section 3).
ROOM = 254
#: The largest operand of GOTO, GOSUB, IF, RESTORE.
LARGEST_NUMBER = 65535
LAST_SUBSCRIPT = 999
#: Kinds by the first letter of a name (as in `values.kind`).
LETTERS = {letter: kind for kind, letters in {"D": "ADRIJ", "P": "POV", "C": "CBT", "S": "SXY"}.items()
           for letter in letters}  # fmt: skip


def whole(digits: str) -> int:
    """The number of a row of digits (none: 0); with more than six that count it is merely too large."""
    return int((digits.lstrip("0") or "0")[:7])


class LineFault(Fault):
    """A line that cannot be stored: the error, and the column (from 0) where the line stops making sense."""

    def __init__(self, code: Code, column: int) -> None:
        super().__init__(code)
        self.column = column


def _line_number(token: Token) -> int:
    """The number of a line, however it is written; error 1 when it is not whole or more than 65535."""
    value = real.literal(token)
    if value != real.mp.floor(value) or value > LARGEST_NUMBER:
        raise LineFault(Code.SYNTAX, _column(token))
    return int(value)


def _column(token: Token) -> int:
    """The column of a word, from 0."""
    assert token.start_pos is not None, "lark's lexer and `_check_head` tell it"
    return token.start_pos


class Tree(Transformer):
    """lark's tree to ours, built while parsing."""

    def line(self, children: list) -> ProgramLine:
        if not isinstance(children[0], Token):
            return ProgramLine(None, children[0])
        return ProgramLine(_line_number(children[0]), children[1])

    @v_args(inline=True)
    def number(self, token: Token) -> Number:
        return Number(real.literal(token), _column(token))

    @v_args(inline=True)
    def name(self, token: Token, subscript: Expression | None = None) -> Name:
        number = whole(token[1:]) if subscript is None else subscript
        return Name(str(token[0]), number, _column(token))

    @v_args(inline=True)
    def minus(self, _: Token, operand: Expression) -> Minus:
        return Minus(operand)

    @v_args(inline=True)
    def plus(self, _: Token, operand: Expression) -> Expression:
        return operand

    @v_args(inline=True)
    def function(self, token: Token, argument: Expression) -> Function:
        return Function(token.rstrip("␣"), argument)

    @v_args(inline=True)
    def binary(self, left: Expression, operator: Token, right: Expression) -> Binary:
        return Binary(str(operator), left, right)

    @v_args(inline=True)
    def assign(self, name: Name, _: Token, value: Expression) -> Assign:
        return Assign(name, value)

    def cut(self, children: list) -> Cut:
        items = tuple(
            (separator is not None and separator.type == "SEMICOLON", item)
            for separator, item in zip(children[::2], children[1::2], strict=True)
        )
        _check_fillets(items)
        return Cut(items)

    def sym(self, children: list) -> Sym:
        return Sym(children[0] is not None, children[1])

    def rep(self, children: list) -> Rep:
        return Rep(children[0] is not None, children[1], children[3])

    def fit(self, children: list) -> Fit:
        return Fit(children[0], children[2])

    def read(self, children: list) -> Read:
        return Read(tuple(children[::2]))

    def input(self, children: list) -> Input:
        return Input(tuple(children[::2]))

    def data(self, children: list) -> Data:
        return Data(tuple(children[::2]))

    def print(self, children: list) -> Print:
        items = children[::2] if children[0] is not None else []
        return Print(tuple(str(i[1:-1]) if isinstance(i, Token) else i for i in items))

    def restore(self, children: list) -> Restore:
        return Restore(None if children[0] is None else _line_number(children[0]))

    def goto(self, children: list) -> Goto:
        return Goto(_line_number(children[0]))

    def gosub(self, children: list) -> Gosub:
        return Gosub(_line_number(children[0]))

    @v_args(inline=True)
    def if_(self, left: Expression, relation: Token, right: Expression, line: Token) -> If:
        return If(left, str(relation), right, _line_number(line))

    from_ = v_args(inline=True)(From)
    scale = v_args(inline=True)(Scale)
    tol = v_args(inline=True)(Tol)

    def back(self, _: list) -> Simple:
        return Simple("BACK")

    def recut(self, _: list) -> Simple:
        return Simple("RECUT")

    def return_(self, _: list) -> Simple:
        return Simple("RETURN")

    def end(self, _: list) -> Simple:
        return Simple("END")

    def rem(self, _: list) -> Simple:
        return Simple("REM")


def plain_kind(item: Expression) -> str | None:
    """The kind of an item that is a single constant or name, or two expressions in parentheses with a comma
    between them (which counts as a point, though it may be a number: no curve it is); None for anything else.
    """
    match item:
        case Number():
            return "D"
        case Name(letter):
            return LETTERS[letter]
        case Binary(","):
            return "P"
    return None


def _check_fillets(items: tuple[tuple[bool, Expression], ...]) -> None:
    """Error 1 for a fillet radius where the line itself shows that none can stand."""
    kinds = [plain_kind(item) for _, item in items]
    columns = [getattr(item, "column", 0) for _, item in items]
    for i, (kind, following) in enumerate(pairwise(kinds)):
        if kind != "D":
            continue
        if following == "D":
            raise LineFault(Code.SYNTAX, columns[i + 1])
        if following == "P" and i > 0 and kinds[i - 1] in ("C", "S"):
            raise LineFault(Code.SYNTAX, columns[i])


def _literal_check(token: Token) -> Token:
    try:
        real.literal(token)
    except Fault as fault:
        raise LineFault(fault.code, _column(token)) from None
    return token


def _check_head(squeezed: str) -> None:
    """Error for a number in front of the statement that is no program line's; nothing behind it is looked at then."""
    head = re.match(r"([0-9]+\.?[0-9]*|\.[0-9]+)(E[+-]?[0-9]+)?", squeezed)
    if head and not 1 <= _line_number(_literal_check(Token("NUMBER", head[0], 0))) <= LAST_LINE:
        raise LineFault(Code.SYNTAX, 0)


def _subscript_check(token: Token) -> Token:
    if whole(token[1:]) > LAST_SUBSCRIPT:
        raise LineFault(Code.RANGE, _column(token))
    return token


@dataclass(frozen=True)
class Dialect:
    """A variant of the language.

    `grammar` are files of the package skg.ref, read one behind the other; `tree` makes the statements of what they
    find; `words` are the words of all statements.
    """

    grammar: tuple[str, ...]
    tree: type[Tree]
    words: tuple[str, ...]


#: The language of language.md.
WIRE = Dialect(("skg.lark",), Tree, STATEMENTS)


@cache
def _parser(dialect: Dialect) -> Lark:
    return Lark(
        "\n".join(files("skg.ref").joinpath(name).read_text("utf-8") for name in dialect.grammar),
        start=["line", "expression"],
        parser="lalr",
        transformer=dialect.tree(),
        maybe_placeholders=True,
        lexer_callbacks={"NUMBER": _literal_check, "NAME": _subscript_check},
    )


_BLANK = " "
_FUNCTION_END = re.compile(r"(SQR|SIN|COS|TG|ABS|INT|K[123])$")
_REMARK = re.compile(r" *([0-9.][0-9. ]*(E[ +-]*[0-9][0-9 ]*)?)?R *E *M", re.IGNORECASE)


def squeeze(text: str) -> tuple[str, list[int]]:
    """The line in upper case without its blanks, and the column of each character that is left.

    Blanks stay in texts between quotes; one that follows a function's name becomes `␣`. What follows REM
    is dropped.
    """
    remark = _REMARK.match(text)
    if remark:
        text = remark.group()
    out: list[str] = []
    columns: list[int] = []
    quoted = False
    for column, char in enumerate(text):
        if char == '"':
            quoted = not quoted
        if quoted or char not in _BLANK:
            out.append(char if quoted else char.upper())
        elif _FUNCTION_END.search("".join(out[-3:])):
            out.append("␣")
        else:
            continue
        columns.append(column)
    return "".join(out), columns


@cache
def _words(statements: tuple[str, ...]) -> re.Pattern[str]:
    return re.compile(
        rf"""(?P<text>"[^"]*"?)|(?P<number>([0-9]+\.?[0-9]*|\.[0-9]+)(E[+-]?[0-9]+)?)
        |{"|".join(statements)}
        |SQR|SIN|COS|TG|ATG|ABS|INT|K[123]|[ADRIJPOVCBTSXY]\[|(?P<name>[ADRIJPOVCBTSXY][0-9]*)|(?P<blank>␣)|.""",
        re.VERBOSE,
    )


def room(squeezed: str, statements: tuple[str, ...] = STATEMENTS) -> int:
    """Bytes that the words of a line take: a number 6, a name 2, a text its characters and quotes, all else 1."""
    sizes = {"number": 6, "name": 2, "blank": 0, None: 1}
    return sum(
        len(word[0]) if word.lastgroup == "text" else sizes[word.lastgroup]
        for word in _words(statements).finditer(squeezed)
    )


def _earlier_fault(good: str, start: str, columns: list[int], dialect: Dialect) -> None:
    """Raise what is wrong with the items that stand before the place where a line stops making sense."""
    for end in (len(good), *(at for at in reversed(range(len(good))) if good[at] in ",;")):
        try:
            _parser(dialect).parse(good[:end], start=start)
            return
        except UnexpectedInput:  # (that separator stands in an item)
            continue
        except LineFault as fault:
            raise LineFault(fault.code, columns[fault.column]) from None


def _parse(text: str, start: str, dialect: Dialect) -> object:
    if len(text) > LONGEST:
        raise LineFault(Code.MEMORY, LONGEST + 1)
    squeezed, columns = squeeze(text)
    if room(squeezed, dialect.words) > ROOM:
        raise LineFault(Code.MEMORY, len(text))
    columns.append(len(text))
    try:
        if start == "line":
            _check_head(squeezed)
        return _parser(dialect).parse(squeezed, start=start)
    except UnexpectedInput as unexpected:
        place = unexpected.pos_in_stream
        if getattr(getattr(unexpected, "token", None), "type", "") == "$END":
            place = None
        _earlier_fault(squeezed[:place], start, columns, dialect)
        raise LineFault(Code.SYNTAX, columns[-1 if place is None else place]) from None
    except LineFault as fault:
        raise LineFault(fault.code, columns[fault.column]) from None
    except RecursionError:
        raise LineFault(Code.MEMORY, 0) from None


@real.kept
def parse_line(text: str, dialect: Dialect = WIRE) -> ProgramLine:
    """A line as typed; `LineFault` when it is not understood."""
    line = _parse(text, "line", dialect)
    assert isinstance(line, ProgramLine)
    if line.number is None and isinstance(line.statement, Input):
        raise LineFault(Code.SYNTAX, len(text))
    if line.number is not None and len(listed(squeeze(text)[0], remark(text), dialect.words)) > LONGEST:
        raise LineFault(Code.MEMORY, len(text))
    return line


def remark(text: str) -> str | None:
    """The text behind REM, without the one blank that LIST puts there; None in other lines."""
    word = _REMARK.match(text)
    return text[word.end() :].removeprefix(" ") if word else None


def parse_answer(text: str) -> Expression:
    """An answer to INPUT: one expression, which is the same in all dialects."""
    expression = _parse(text, "expression", WIRE)
    assert isinstance(expression, Expression)
    return expression
