"""The spellings of XY's symbols, and the files of programs (docs/spec/xy.md, section 1)."""

from __future__ import annotations

import pytest

from skg.rivals.xy import translate

BOOK = "⊕D(0,0)⇒D0;⊕Y(25,0,5)⇒Y1;⊕X(D0,0)⇒X0;⊕D(50,0)⇒D1;⊕D(50,2×3−1)⇒D2;φD1,-Y1,D2,×8(-D0,45),←0.06(D1,D1);"
SPELLINGS = {
    "ascii": {"⊕": "(+)", "⇒": "=>", "φ": "(/)", "×": "*", "←": "<-", "−": "-"},
    "tex": {
        "⊕": r"\oplus ",
        "⇒": r" \Rightarrow ",
        "φ": r"\phi ",
        "×": r"\times ",
        "←": r" \leftarrow ",
        "−": r"\rightarrow ",
        ";": ";$\n$",
        "D0": "D_0",
    },
    "wide": {"⊕": "⊕", ",": "，", ";": "；", "(": "（", ")": "）", "φ": "ϕ", "−": "→"},
    "minus": {"-": "–", "−": "－", "D": "d", "Y": "y", "X": "x"},
    "blanks": {",": " , ", ";": "\r\n;", "(": "(\n"},
    "quad": {";": r"; \quad $ "},
}


@pytest.mark.parametrize("spelling", SPELLINGS)
def test_spelling(spelling: str) -> None:
    text = BOOK
    for one, other in SPELLINGS[spelling].items():
        text = text.replace(one, other)
    assert text != BOOK
    assert translate(text) == translate(BOOK)


def test_longest_match() -> None:
    route = "⊕D(0,0)⇒D0;⊕D(9,0)⇒D1;⊕D(9,9)⇒D2;φD0,D1,D2,{}0.1(D0,D1);"
    assert "R=0.1\n" in translate(route.format("<-"))
    assert "R=-0.1\n" in translate(route.format("<--"))


def test_names() -> None:
    program = translate("⊕D(1,2)⇒D;⊕D(3,4)⇒D0;⊕X(D,5)⇒X99;⊕Y(D0,6)⇒Y;7⇒B;8⇒A2;9⇒B;⊕D(B,A2)⇒D0;", "my päart.xy")
    assert program.splitlines() == [
        "10 REM MY P?ART.XY",
        "20 REM D IS P100, Y IS C100, B IS A1, A2 IS A2",
        "30 P100=(1,2)",
        "40 P0=(3,4)",
        "50 S99=(X#5):P100",
        "60 C100=P0:-6",
        "70 A1=7",
        "80 A2=8",
        "90 A1=9",
        "100 P0=(A1,A2)",
        "110 END",
    ]


def test_lines_are_short_ascii() -> None:
    assert max(map(len, translate(BOOK, "star.xy" * 9).splitlines())) <= 72
    long = "1.2345678901234567890+" * 9 + "1"
    program = translate(
        f"⊕D({long},{long})⇒D1;⊕Y({long},{long},{long})⇒Y1;⊕X({long},{long},{long})⇒X1;{long}⇒A;"
        "⊕D(0,0)⇒D0;⊕D(9,0)⇒D2;⊕X(D0,45)⇒X0;⊕Y(7,1,1)⇒Y2;"
        "φD2,-Y2,×2(-D0,8.12345678901),FS(X0),×3(-D0,120),←0(D1,D2);"
    )
    assert max(map(len, program.splitlines())) <= 72
