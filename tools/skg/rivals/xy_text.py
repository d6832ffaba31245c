"""XY's text: the three spellings of its symbols made tokens, and these statements, each with its line and column.

docs/spec/xy.md, sections 1 and 2. Statements come one by one, so that what is wrong first is said first.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from lark import Token, Tree

from skg.messages.finding import Phrase
from skg.rivals.statement import TextFault, begin, feed

#: TeX words, as the scan has them, and code points, each as the one character that stands for its symbol.
WORDS = {r"\oplus": "⊕", r"\Rightarrow": "⇒", r"\phi": "φ", r"\times": "×", r"\leftarrow": "←",
         r"\rightarrow": "-", r"\quad": " "}  # fmt: skip
FOLDED = str.maketrans("ϕ−–－→，；（）", "φ----,;()")
#: Not there at all.
DROPPED = "$_"
SYMBOLS = {"⊕": "MAKE", "(+)": "MAKE", "⇒": "NAME_IT", "=>": "NAME_IT", "φ": "ROUTE", "(/)": "ROUTE", "×": "TIMES",
           "*": "TIMES", "←": "CLOSE", "<-": "CLOSE", "-": "MINUS", "+": "PLUS", "/": "SLASH", "(": "LPAR", ")": "RPAR",
           ",": "COMMA", ";": "SEMICOLON"}  # fmt: skip
_NUMBER, _POINT, _LINE, _CIRCLE = (Phrase(f"rival-{kind}") for kind in ("number", "point", "line", "circle"))
SHOWN: dict[str, str | Phrase] = {
    "MAKE": "⊕", "NAME_IT": "⇒", "ROUTE": "φ", "TIMES": "×", "CLOSE": "←", "MINUS": "-", "PLUS": "+", "SLASH": "/",
    "LPAR": "(", "RPAR": ")", "COMMA": ",", "SEMICOLON": ";", "WHOLE": _NUMBER, "DECIMAL": _NUMBER,
    "VARIABLE": Phrase("rival-variable"), "BARE_D": _POINT, "OTHER_D": _POINT, "BARE_X": _LINE, "OTHER_X": _LINE,
    "BARE_Y": _CIRCLE, "OTHER_Y": _CIRCLE,
}  # fmt: skip

_TOKEN = re.compile(
    r"(?P<symbol>\(\+\)|\(/\)|<-|=>|[⊕⇒φ×*←\-+/(),;])|(?P<number>[0-9]+(?:\.[0-9]+)?)"
    r"|(?P<word>[A-Za-z]+[0-9]*)|(?P<blank>\s+)|(?P<other>.)"
)
_TEX = re.compile(r"\\[A-Za-z]+")
_NAME = re.compile(r"([A-Z])([0-9]*)")
_SUBSCRIPT = re.compile(r"|0|[1-9][0-9]?")


def _folded(text: str) -> tuple[str, list[int], TextFault | None]:
    """One character for each symbol, the index in `text` of each, and what breaks the text off, if anything does."""
    out: list[str] = []
    indices: list[int] = []
    index = 0
    while index < len(text):
        char = text[index]
        length = 1
        if char == "\\":
            word = _TEX.match(text, index)
            if not word or word[0] not in WORDS:
                fault = TextFault(index, "rival-word", word=word[0] if word else char)
                return "".join(out), [*indices, index], fault
            char, length = WORDS[word[0]], len(word[0])
        if char not in DROPPED:
            out.append(char.translate(FOLDED))
            indices.append(index)
        index += length
    return "".join(out), [*indices, len(text)], None


def tokens(text: str) -> Iterator[Token]:
    """The tokens of a text; `TextFault` at the first that is none. A last one, $END, stands behind the others."""
    folded, indices, fault = _folded(text)
    index = end = 0
    while index < len(folded):
        token = _TOKEN.match(folded, index)
        assert token, "it takes any character"
        start, index = index, token.end()
        word = token[0]
        match token.lastgroup:
            case "blank":
                continue
            case "other":
                if word == ".":
                    raise TextFault(indices[start], "rival-digit-first")
                raise TextFault(indices[start], "rival-character", word=word)
            case "symbol":
                kind = SYMBOLS[word]
            case "number":
                if folded[index : index + 1] == "." and "." not in word:
                    raise TextFault(indices[index] + 1, "rival-digit")
                kind = "DECIMAL" if "." in word else "WHOLE"
            case _:
                word = word.upper()
                kind = _kind(word, indices[start])
        end = indices[index - 1] + 1
        yield Token(kind, word, start_pos=indices[start], end_pos=end)
    if fault:
        raise fault
    yield Token("$END", "", start_pos=end, end_pos=end)


def _kind(word: str, index: int) -> str:
    if word in ("FS", "PY", "ZD", "ZB"):
        return word
    name = _NAME.fullmatch(word)
    if not name:
        raise TextFault(index, "rival-word", word=word)
    letter, subscript = name.groups()
    if not _SUBSCRIPT.fullmatch(subscript):
        raise TextFault(index, "rival-name", word=word, letter=letter)
    if letter not in "DXY":
        return "VARIABLE"
    return f"{'OTHER' if subscript else 'BARE'}_{letter}"


def statements(text: str, is_made: Callable[[str], bool]) -> Iterator[Tree]:
    """The statements of a text, each asked for when the one before has been carried out.

    `is_made` tells whether a name has been made. `TextFault` at what the grammar does not take and at a name that is
    used before it was made, whichever comes first.
    """
    stream = tokens(text)
    token = next(stream)
    while token.type != "$END":
        parser = begin("xy.lark")
        before = ""
        while True:
            feed(parser, token, SHOWN)
            is_name = token.type == "VARIABLE" or token.type[:-1] in ("BARE_", "OTHER_")
            if is_name and before not in ("MAKE", "NAME_IT") and not is_made(token):
                raise TextFault(token.start_pos, "rival-unmade", name=str(token))
            if token.type == "SEMICOLON":
                break
            before = token.type
            token = next(stream)
        yield parser.feed_eof(token)
        token = next(stream)
