"""words.asm, made from words.txt for an image: the words' tokens, KEYTAB (their letters) and STTAB (their routines).

The tokens of the words, then of the letters that names begin with, come to the end of a byte: what an image adds pushes
those in front of it down.
"""

from __future__ import annotations

import sys
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

TABLE = Path(__file__).resolve().parent / "words.txt"
#: In the order of the tokens.
KINDS = ("function", "statement", "command")
#: The letters of the names, in the order of the letter indices (equ.asm).
LETTERS = "ADRIJPOVCBTSXY"
#: Tokens below are names and computed names (equ.asm).
FIRST = 0xC6
HEADER = """; words.asm - the words of this image, made of words.txt by the build: tokens, letters, routines
; Offers: KEYTAB KEYEND STTAB STTEND and the tokens
; Uses:   the routines of the statements, which are called through STTAB alone
; Room:   {room} bytes
"""


@dataclass(frozen=True)
class Word:
    """A word of the language: its kind (one of KINDS), the name of its token, its routine ("" of a function)."""

    kind: str
    text: str
    token: str
    routine: str


def read(sets: Collection[str]) -> list[Word]:
    """The words of an image that has these sets besides the words of all. ValueError with the line that is wrong."""
    words: list[Word] = []
    for count, line in enumerate(TABLE.read_text().splitlines(), start=1):
        fields = line.split("#")[0].split()
        if not fields:
            continue
        needs = 3 if fields[0] == KINDS[0] else 4
        if fields[0] not in KINDS or not needs <= len(fields) <= needs + 1:
            raise ValueError(f"{TABLE.name}:{count}: not a kind, a word, its token and its routine")
        if len(fields) > needs and (fields[needs].removeprefix("-") in sets) == fields[needs].startswith("-"):
            continue
        words.append(Word(fields[0], fields[1], fields[2], fields[3] if needs == 4 else ""))
        if words[-2:] != sorted(words[-2:], key=lambda word: KINDS.index(word.kind)):
            raise ValueError(f"{TABLE.name}:{count}: a {fields[0]} stands in front of it all")
    if 0x100 - len(LETTERS) - len(words) < FIRST:
        raise ValueError(f"{TABLE.name}: {len(words)} words are more than the tokens allow")
    return words


def letters(text: str) -> str:
    """The operands of DB for a word: its last letter has bit 7 set."""
    last = f"0{ord(text[-1]) + 0x80:02X}H"
    return f'"{text[:-1]}",{last}' if len(text) > 1 else last


def source(sets: Collection[str]) -> str:
    """The text of words.asm for an image that has these sets of words."""
    words = read(sets)
    first = 0x100 - len(LETTERS) - len(words)
    statements = [word for word in words if word.routine]
    room = sum(len(word.text) for word in words) + len(LETTERS) + 1 + 2 * len(statements)
    return "\n".join(
        [
            HEADER.format(room=room),
            *(f"{word.token:7} EQU 0{first + n:02X}H" for n, word in enumerate(words)),
            f"{'TLETR':7} EQU 0{0x100 - len(LETTERS):02X}H        ; ... 0FFH: the names' letters, in KEYTAB alone",
            "",
            "; The words in the order of their tokens, then the letters of the names; bit 7 set in the",
            "; last character",
            "        DB      80H             ; PRWORD, on its way back from the end, stops here for SQR",
            "KEYTAB:",
            *(f"        DB      {letters(word.text)}" for word in words),
            *(f"        DB      {letters(letter)}" for letter in LETTERS),
            "KEYEND:",
            "",
            "; The statements and commands in the order of their tokens",
            "STTAB:",
            *(f"        DW      {word.routine}" for word in statements),
            "STTEND:",
            "",
        ]
    )


if __name__ == "__main__":
    print(source(sys.argv[1:]), end="")
