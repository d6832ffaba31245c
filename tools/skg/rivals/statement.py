"""Statements for both translators: parsed token by token, their numbers, the place of an error."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cache
from importlib.resources import files
from typing import Any

from lark import Lark, Token, Tree, UnexpectedToken
from lark.lexer import Lexer, LexerState
from lark.parsers.lalr_interactive_parser import InteractiveParser

from skg.messages.finding import Finding, Phrase
from skg.rivals.formula import SkgText, join, minus
from skg.rivals.languages import RivalFault
from skg.rivals.plane import PlaneError, Real


class TextFault(Exception):
    """An error in a text, and the index of its character."""

    def __init__(self, index: int | None, code: str, **values: Any) -> None:  # noqa: ANN401
        super().__init__(code)
        assert index is not None, "the tokens of both languages have their places"
        self.index = index
        self.finding = Finding(code, **values)

    @classmethod
    def of(cls, index: int | None, error: PlaneError) -> TextFault:
        """The geometry that there is not, at the character that asks for it."""
        return cls(index, error.why.code, **dict(error.why.values))


@contextmanager
def placing(text: str) -> Iterator[None]:
    """Makes a `TextFault` in a text a `RivalFault`, with line and column, both from 1."""
    try:
        yield
    except TextFault as fault:
        before = text[: fault.index]
        column = fault.index - (before.rfind("\n") + 1) + 1
        raise RivalFault(before.count("\n") + 1, column, fault.finding) from None
    except RecursionError:
        raise RivalFault(1, 1, Finding("rival-nesting")) from None


# Parsing -----------------------------------------------------------------------------------------------------------


class _NoLexer(Lexer):
    """The tokens are fed one by one."""

    __future_interface__ = 1

    def __init__(self, _: object) -> None:
        pass

    def lex(self, lexer_state: LexerState, parser_state: object) -> Iterator[Token]:
        """None of its own."""
        return iter(())


@cache
def _parser(grammar: str) -> Lark:
    return Lark(
        files("skg.rivals").joinpath(grammar).read_text("utf-8"),
        start="statement",
        parser="lalr",
        lexer=_NoLexer,
        maybe_placeholders=True,
    )


def begin(grammar: str) -> InteractiveParser:
    """A parser for one statement of a grammar beside this module."""
    return _parser(grammar).parse_interactive("")


def feed(parser: InteractiveParser, token: Token, shown: Mapping[str, str | Phrase]) -> None:
    """One token more; `TextFault` where it is none that the grammar takes. `shown` has the tokens' words for that."""
    try:
        parser.feed_token(token)
    except UnexpectedToken as unexpected:
        kinds = unexpected.expected
        if "WHOLE" in kinds:
            # A number; what else it may begin with goes without saying.
            kinds = kinds - {"MINUS", "LPAR"}
        words = list(dict.fromkeys(shown.get(kind, kind) for kind in sorted(kinds)))
        wanted = Phrase("one-or-other", first=tuple(words[:-1]), other=words[-1]) if len(words) > 1 else words[0]
        found = str(token) or Phrase("rival-end")
        raise TextFault(token.start_pos, "expected-found", expected=wanted, found=found) from None


# Numbers -----------------------------------------------------------------------------------------------------------

#: SKG's numbers are smaller (docs/spec/language.md, section 1).
LARGEST = 2**127
#: A number's value, and SKG's text for it.
Figure = tuple[Real, SkgText]


def figure(tree: Tree, name: Callable[[Tree], Figure]) -> Figure:
    """The value of an expression, and its text; `name` knows the operands that are no literals."""
    match tree.data:
        case "literal":
            return _literal(token_of(tree.children[0]))
        case "inner":
            return figure(tree_of(tree.children[1]), name)
        case "minus":
            value, text = figure(tree_of(tree.children[1]), name)
            return -value, minus(text)
        case "sum" | "product":
            return _joined(tree, name)
    return name(tree)


def _literal(token: Token) -> Figure:
    if Real(token.value) >= LARGEST:
        raise TextFault(token.start_pos, "rival-large")
    return Real(token.value), SkgText(token.value)


def _joined(tree: Tree, name: Callable[[Tree], Figure]) -> Figure:
    left, sign, right = tree.children
    (a, a_text), (b, b_text) = figure(tree_of(left), name), figure(tree_of(right), name)
    sign = token_of(sign)
    match sign.type:
        case "PLUS":
            return a + b, join(a_text, "+", b_text)
        case "MINUS":
            return a - b, join(a_text, "-", b_text)
        case "TIMES":
            return a * b, join(a_text, "*", b_text)
    if b == 0:
        raise TextFault(sign.start_pos, "rival-division")
    return a / b, join(a_text, "/", b_text)


def first_token(tree: Tree) -> Token:
    """The first token of a tree's text."""
    tokens = map(token_of, tree.scan_values(lambda value: isinstance(value, Token)))
    return min(tokens, key=lambda token: token.start_pos or 0)


def token_of(child: Tree | Token) -> Token:
    """A child that is a token."""
    assert isinstance(child, Token)
    return child


def sign_of(children: Sequence[Tree | Token | None]) -> Token | None:
    """The sign that stands first among children, if one is written."""
    return token_of(children[0]) if children and children[0] is not None else None


def tree_of(child: Tree | Token) -> Tree:
    """A child that is a tree."""
    assert isinstance(child, Tree)
    return child
