"""TEKHTRAN's text: Cyrillic words, names and numbers as tokens, and statements of these.

docs/spec/tekhtran.md, sections 1 and 2. Statements come one by one, so that what is wrong first is said first, and a
name's kind is known.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from lark import Token, Tree

from skg.messages.finding import Phrase
from skg.rivals.statement import TextFault, begin, feed

#: Latin letters that are read as the Cyrillic ones of that shape.
FOLDED = str.maketrans("ABCEHKMOPTXY", "АВСЕНКМОРТХУ")
_CYRILLIC = "А Б В Г Д Е Ж З И Й К Л М Н О П Р С Т У Ф Х Ц Ч Ш Щ Ы Э Ю Я Ё"
_SPELLING = "A B V G D E ZH Z I J K L M N O P R S T U F KH C CH SH SHCH Y EH YU YA E"
LATIN = dict(zip(_CYRILLIC.split(), _SPELLING.split(), strict=True)) | {"Ъ": "", "Ь": ""}


def latin(text: str) -> str:
    """A text in the letters that SKG has; `?` for what is neither Cyrillic nor ASCII."""
    return "".join(
        LATIN[char] if char in LATIN else char if char.isascii() and char.isprintable() else "?"
        for char in text.upper()
    )


#: Words of kinds -> the kind.
KINDS = {"ТОЧКА": "POINT", "ПРЯМАЯ": "LINE", "ОКРУЖИ": "CIRCLE", "ОКРУЖН": "CIRCLE", "ВЕКТОР": "VECTOR",
         "МАТР": "MATRIX", "ПЛОСК": "PLANE"}  # fmt: skip
#: Prefixes of names that need no word.
BEGINNINGS = {"ТЧ": "POINT", "ПР": "LINE", "КР": "CIRCLE", "ВЕ": "VECTOR", "МК": "MATRIX", "ПЛ": "PLANE"}
_OTHER_WORDS = """ДЕТАЛЬ КОНЕЦ ПЛЗ ПЧТ1 СЛЕД ИЗ ВТОЧКУ ПРИРАЩ ИДИ НА КОНТУР ПЕРЕСЕЧ ЦЕНТР ПРЧС ПОЧС ХБ ХМ УБ УМ ХКООРД
УКООРД ПЕРЕНОС СПРАВА СЛЕВА ПЕРП ПАРЛЕЛ КООРД ОТМЕН ВКЛ ВСЕ ВЫКЛ"""
#: Word -> its token.
WORDS = {word: latin(word) for word in [*KINDS, *_OTHER_WORDS.split()]} | {"ОКРУЖИ": latin("ОКРУЖН")}
SYMBOLS = {"+": "PLUS", "-": "MINUS", "−": "MINUS", "–": "MINUS", "*": "TIMES", "/": "SLASH", "(": "LPAR", ")": "RPAR",
           ",": "COMMA", "=": "EQUALS"}  # fmt: skip
NAMES = {"POINT": Phrase("rival-point"), "LINE": Phrase("rival-line"), "CIRCLE": Phrase("rival-circle"),
         "VECTOR": Phrase("rival-vector"), "MATRIX": Phrase("rival-matrix"), "PLANE": Phrase("rival-a-plane"),
         "NUMBER": Phrase("rival-number")}  # fmt: skip
SHOWN = (
    {kind: word for word, kind in WORDS.items()}
    | {kind: symbol for symbol, kind in reversed(SYMBOLS.items())}
    | NAMES
    | {f"NEW_{kind}": Phrase("rival-name-of", kind=noun) for kind, noun in NAMES.items()}
    | {
        "WHOLE": NAMES["NUMBER"],
        "DECIMAL": NAMES["NUMBER"],
        "KOORD": NAMES["NUMBER"],
        "END": Phrase("rival-end-of-statement"),
        "COMMA": Phrase("rival-comma"),
    }
)
_LETTER = "А-Яа-яЁёABCEHKMOPTXYabcehkmoptxy"
_TOKEN = re.compile(
    rf"(?P<symbol>[-+−–*/(),=])|(?P<number>[0-9]+(?:\.[0-9]+)?)|(?P<word>[{_LETTER}][{_LETTER}0-9]*)"
    r"|(?P<end>[;\n])|(?P<blank>\s+?)|(?P<other>.)",
    re.S,
)


def tokens(text: str) -> Iterator[Token]:
    """The tokens of a text, names as NAME, END behind each line and each `;`; `TextFault` at the first that is none."""
    index = end = 0
    while index < len(text):
        token = _TOKEN.match(text, index)
        assert token, "it takes any character"
        start, index = index, token.end()
        word = token[0]
        match token.lastgroup:
            case "blank":
                continue
            case "other":
                raise TextFault(start, "rival-character", word=word)
            case "end":
                yield Token("END", word.strip(), start_pos=start if word == ";" else end)
                continue
            case "symbol":
                kind = SYMBOLS[word]
            case "number":
                kind = "DECIMAL" if "." in word else "WHOLE"
            case _:
                word = word.upper().translate(FOLDED)
                kind = WORDS.get(word, "NAME")
        if word == "ДЕТАЛЬ":
            index = (text + "\n").index("\n", start)
            word = text[token.end() : index].strip()
        end = index
        yield Token(kind, word, start_pos=start)
    yield Token("END", "", start_pos=end)


#: Tells the kind of what a name means, or, of a new name, the kind that it was declared as.
KindOf = Callable[[str, bool], str | None]


def statements(text: str, kind_of: KindOf) -> Iterator[Tree]:
    """The statements of a text up to КОНЕЦ, each asked for when the one before has been carried out.

    `TextFault` at what the grammar does not take and at a name that is used before it was defined.
    """
    stream = tokens(text)
    for token in stream:
        if token.type == "END":
            continue
        if token.type == "KONEC":
            return
        parser = begin("tekhtran.lark")
        # The word of a kind, and whether names that come are new.
        word, is_new = KINDS.get(token), True
        first = _as_kind(token, kind_of, word, is_new)
        if first.type not in parser.choices():
            raise TextFault(
                token.start_pos, "expected-found", expected=Phrase("rival-statement"), found=str(token[:40])
            )
        feed(parser, first, SHOWN)
        while token.type != "END":
            is_new = is_new and token.type != "EQUALS" and first.type in _MAKING
            token = next(stream)
            feed(parser, _as_kind(token, kind_of, word, is_new), SHOWN)
        yield parser.feed_eof(token)


#: Tokens that begin a definition.
_MAKING = {f"NEW_{kind}" for kind in NAMES} | {WORDS[word] for word in KINDS}


def _as_kind(token: Token, kind_of: KindOf, word: str | None, is_new: bool) -> Token:
    """A name as its kind; other tokens as they are."""
    if token.type != "NAME":
        return token
    kind = kind_of(token, is_new)
    if is_new:
        kind = f"NEW_{kind or BEGINNINGS.get(token[:2]) or word or 'NUMBER'}"
    elif kind is None:
        raise TextFault(token.start_pos, "rival-undefined", name=str(token))
    return Token(kind, token.value, start_pos=token.start_pos)
