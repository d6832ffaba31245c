"""Errors are reported with line and column, and nothing is written (docs/spec/xy.md, section 9)."""

from __future__ import annotations

import pytest
from rivalhelp import fault

MADE = "⊕D(0,0)⇒D0;⊕D(9,0)⇒D1;⊕D(9,9)⇒D2;⊕X(0,0,0)⇒X1;⊕X(0,5,0)⇒X2;⊕Y(0,0,3)⇒Y1;⊕Y(20,0,2)⇒Y2;⊕Y(2,0,4)⇒Y3;\n"

#: Text; ^ stands before the place, in the line.
TABLE = [
    # unknown characters and words; numbers and names badly written
    "⊕D(1,2)⇒^@;",
    "⊕D(1,^.1)⇒D1;",
    "⊕D(1,5.^)⇒D1;",
    "⊕D(^D100,1)⇒D1;",
    "⊕D(1,2)⇒^D100;",
    "⊕D(1,2)⇒^D01;",
    "⊕^QQ(1,2)⇒D1;",
    "^\\foo D1;",
    "⊕D(1,^\\Oplus)⇒D1;",
    "^A100;",
    "⊕D(1,2.5^.1)⇒D1;",
    "⊕D(1^=2)⇒D1;",
    "1^%2⇒A;",
    "⊕D(1^e5,2)⇒D1;",
    "φD1,^ZZ,←0(D0,D0);",
    # what the grammar does not take
    "⊕D(^+2,1)⇒D1;",
    "⊕D(1,2)⇒D1 ^⊕D(1,2)⇒D3;",
    "⊕D(1 ^2)⇒D1;",
    "⊕D(1,2^⇒D1;",
    "⊕^D1(1,2)⇒D1;",
    "⊕D(1,2)^D1;",
    "φ^←0(D0,D0);",
    "φD0,^,←0(D0,D0);",
    "φD0,D1 ^;",
    "φD0,D1,←0(D0^);",
    "φD0,D1,×^2.5(D0,3),←0(D0,D0);",
    "φD0,^X1,←0(D0,D0);",
    "⊕ZB(D0,1)^⇒D1;",
    "⊕D(-^D0,X1)⇒D1;",
    "^;",
    "⊕PY(D0,1^)⇒D1;",
    "φ-^D0,D1,←0(D0,D0);",
    "⊕D(1,2)⇒D1^",
    # names not made, of another kind, signs
    "⊕D(^X5,X1)⇒D1;",
    "φD0,^D7,←0(D0,D0);",
    "^A⇒B;",
    "⊕D(1,^B)⇒D1;",
    "φD0,D1,←0(D0,^D9);",
    "⊕D(1,2)⇒^X1;",
    "⊕Y(1,2,3)⇒^D1;",
    "⊕FS(D0,X1)⇒^Y1;",
    "1⇒^D1;",
    "⊕D(X1,^-Y1)⇒D1;",
    "⊕D(Y1,^-Y3)⇒D1;",
    "⊕D(^-Y1,30)⇒D1;",
    "⊕PY(^-Y1,1,2)⇒Y1;",
    # kinds that make nothing
    "⊕^Y(X1,3)⇒Y1;",
    "⊕^D(D0,D1)⇒D5;",
    "⊕^X(1,2)⇒X1;",
    "⊕^D(1,2,3)⇒D1;",
    "⊕^FS(D0,D1)⇒D5;",
    "⊕^X(D0,X1)⇒X5;",
    # geometry
    "^⊕D(X1,X2)⇒D5;",
    "^⊕D(X2,Y1)⇒D5;",
    "^⊕D(Y1,Y2)⇒D5;",
    "^⊕X(Y1,D0)⇒X5;",
    "^⊕X(D0,D0)⇒X5;",
    "^⊕X(X1,X2)⇒X5;",
    "^⊕Y(0,0,0)⇒Y5;",
    "^⊕Y(0,0,-1)⇒Y5;",
    "^⊕Y(D0,D0)⇒Y5;",
    "^⊕Y(D0,X1)⇒Y5;",
    "^⊕Y(D0,-Y1)⇒Y5;",
    "^⊕Y(D0,D1,1)⇒Y5;",
    "^⊕Y(D0,D1,-9)⇒Y5;",
    "^⊕Y(X1,X2,X1)⇒Y5;",
    "⊕D(1^/0,2)⇒D5;",
    "1^/(2-2)⇒A;",
    "⊕D(1,2)⇒D1; ^⊕D(X1,X2)⇒D5;",
    # the belt
    "φD1,D2,Y2,Y1,^-Y3,←0(D0,D0);",
    "φD0,^Y1,D1,←0(D0,D0);",
    "φY1,^-Y3,←0(D0,D0);",
    "φY1,D1,-Y3,^←0(D0,D0);",
    "φD1,D2,Y1,^D0,←0(D0,D0);",
    "φY1,^2,Y2,←0(D0,D0);",
    "φY1,15,Y2,^1,←0(D0,D0);",
    "φD1,Y1,^5,D2,←0(D0,D0);",
    "φY1,^0,Y2,←0(D0,D0);",
    # fillets
    "φD0,D1,^19,D2,3,←0(D0,D0);",
    "φD0,D1,^0,D2,←0(D0,D0);",
    "φD0,D1,^-1,D2,←0(D0,D0);",
    "φD0,D1,1,^2,D2,←0(D0,D0);",
    "φD0,D1,2,^2,←0(D0,D0);",
    "φD0,D1,5,D2,^5,←0(D0,D0);",
    "φ^3,D1,D2,←0(D0,D0);",
    "φ^×3(D0,60),←0(D0,D0);",
    "φ^FS(X1),←0(D0,D0);",
    "φD1,^×1(D0,60),←0(D0,D0);",
    "φY1,^3,Y1,←0(D0,D0);",
    # routes
    "φD1,^←0(D0,D0);",
    "φY1,^3,←0(D0,D0);",
    "⊕D(-3,0)⇒D5;φD5,^1,Y1,D5,D2,←0(D0,D0);",
    "⊕Y(5,0,2)⇒Y5;φ-Y1,Y5,^←0(D0,D0);",
    "φD1,D1,^←0(D0,D0);",
    "φD0,D1,^←0.1(D0,D0);",
    "φD0,FS(X1),^←0(D0,D0);",
    "φD0,D1,←1^/0(D0,D0);",
]


@pytest.mark.parametrize("marked", TABLE)
def test_place(marked: str) -> None:
    text = MADE + " " + marked.replace("^", "")
    assert marked.count("^") == 1
    if marked == "⊕D(1,2)⇒D1^":
        text += "\n\n"
    message = fault(text)
    assert message.startswith(f"2:{marked.index('^') + 2}: "), (marked, message)
    assert len(message.split(": ", 1)[1]) > 3
    assert "\n" not in message


def test_first_of_two() -> None:
    """In the order of the text, whatever kind of error it is."""
    assert fault("⊕D(1,2)⇒D1;\n⊕D(X1,X1)⇒D1;\n@").startswith("2:4: ")
    assert fault("⊕D(1,2)⇒D1;\n@\n⊕D(X1,X1)⇒D1;").startswith("2:1: ")
    assert fault("⊕X(0,0,0)⇒X1;\n⊕D(X1,X1)⇒D1;\n@").startswith("2:1: ")
    assert fault("⊕D(X1,+)⇒D1;").startswith("1:4: ")
