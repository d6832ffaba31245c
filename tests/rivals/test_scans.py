"""Lines as they stand in the scans of both sources, pasted: they are the statements of the examples (docs/rivals.md
says what was mended there, and why).
"""

from __future__ import annotations

import pytest
from rivalhelp import ROOT, fault

from skg.ref import run
from skg.rivals.xy import translate

WHEEL = r"""
$$\oplus D(0, 0) \Rightarrow D_0;$$
$$\oplus Y(25, 0, 5) \Rightarrow Y_1;$$
$$\oplus Y(D_0, 50) \Rightarrow Y_2;$$
$$\oplus X(D_0, 0) \Rightarrow X_0;$$
$\oplus X(25, 5, 180) \Rightarrow X1$ ;
 $\oplus D(X1, Y2) \Rightarrow D2$ ;
 $\oplus FS(D2, X0) \Rightarrow D1$ ;
 $\oplus D(50, 0) \Rightarrow D10$ ;
$\phi D1, Y1, D2, \times 8(-D0, 45), \leftarrow 0.06(D10, D1)$ ;
"""
POINTER = r"""
$$\oplus Y(0, 0, 1.5) \Rightarrow Y1;$$
$$\oplus Y(18, 0, 0.5) \Rightarrow Y2;$$
$$\oplus D(0, 3) \Rightarrow D0;$$
$$\phi Y1, Y2, \leftarrow 0(D0, D0);$$
"""
HEXAGON = r"""
$$\oplus D(0, 0) \Rightarrow D0;$$
$\oplus D(12, 0) \Rightarrow D;$
$\phi D, \times 6(D0, 60), \leftarrow 0(D0, D0);$
"""
STAR = r"""
$\oplus D(0, 0) \Rightarrow D0; \oplus Y(0, 0, 20) \Rightarrow Y;$
$\oplus D(Y, 0) \Rightarrow D1; \oplus D(Y, 72) \Rightarrow D2;$
$\oplus D(Y, 144) \Rightarrow D3; \oplus D(Y, 216) \Rightarrow D4;$
$\oplus D(Y, 288) \Rightarrow D5;$
$\phi D1, D3, D5, D2, D4, \leftarrow 0(D0, D1);$
"""
DISC = r"""
$$\oplus D(0, 0) \Rightarrow D_0; \quad \oplus D(-2, 0) \Rightarrow D_3;$$
$$\oplus D(0, 0, 10) \Rightarrow Y_1; \quad \oplus D(0, 10, 2) \Rightarrow Y_2;$$
$$\oplus D(Y_1, Y_2) \Rightarrow D_8; \quad \oplus D(-Y_1, Y_2) \Rightarrow D_7;$$
$$\oplus D(Y_1, -60) \Rightarrow D_1; \quad \oplus D(Y_1, -90) \Rightarrow D;$$
$$\oplus X(-2, 0, -90) \Rightarrow X; \quad \oplus D(-X, Y_1) \Rightarrow D_4;$$
"""
ROUND = r"""
$$\phi D_1, D_0, D_3, D_4, Y_1, D_8, -Y_2,$$
$$D_7, Y_1, \leftarrow 0(D, D);$$
"""
BACK = r"""
$\phi \rightarrow Y1, D7, Y2, D8, -Y1, D4, D3,$
$D0, D1, \leftarrow 0(D, D);$
"""


def tape(text: str) -> bytes:
    """The tape of a program of XY."""
    result = run(translate(text))
    assert result.error is None
    return result.tape


@pytest.mark.parametrize(
    ("name", "scan"), [("fig1", WHEEL), ("1-pointer", POINTER), ("2-hexagon", HEXAGON), ("star", STAR)]
)
def test_a_whole_program_of_xy(name: str, scan: str) -> None:
    assert tape(scan) == (ROOT / "examples" / f"xy-book-{name}.3b").read_bytes()


@pytest.mark.parametrize(("name", "route"), [("disc", ROUND), ("reversed", BACK)])
def test_example_3_without_its_slip(name: str, route: str) -> None:
    """A circle is made by the sign of a point: refused as it stands there."""
    assert fault(DISC + route).partition(":")[0] == "3"
    mended = DISC.replace(r"D(0, 0, 10)", "Y(0, 0, 10)").replace("D(0, 10, 2)", "Y(0, 10, 2)")
    assert tape(mended + route) == (ROOT / "examples" / f"xy-book-3-{name}.3b").read_bytes()


#: Statements of TEKHTRAN's text that no slip of the scan touches, and optional words in brackets left out.
STATEMENTS = """
ТЧА=-5, 15, 10.7 | ТОЧКА Т3 = 24, -8,2 | ТЧ2 = ПР1, ПР2 | ТЧ4 = КР1, КР2, УМ | ТЧ5 = КР1, ПРЧС, 40.5 | ТЧ6 = КР17
ТЧ8 = КР1, ТЧА, ПОЧС, 18.6 | ТЧ9 = ПР1, ХКООРД, 80 | ТЧ10 = ПР8, ТЧА, 23, ХМ | ТЧ11=ТЧА, ПЕРЕНОС, 100, −20
ТЧ12 = ТЧ7, ПОЧС, 30.5, 118 | ТЧ16 = ТЧА, МК6 | ТЧ17 = ТЧ13А | ТЧ18 = ВЕКТ1 | ТЧ1=ПР5, ПР4 | ПЛОСК П1, ПЛ14 | ПЛ14=150
П1 = -30 | ПЛЗ ПЛ14 | ТЧ2 = ПР5, ПР4 | ПЛЗ П1 | ТЧ8 = ПР5, ПР4 | ПЛЗ ОТМЕН | ТЧ100 = ПР5, ПР4 | ПР20=-15, 10, 35.6, 70
ПР21=ТЧА, ТЧБ | ПР23 = ТЧ5,− 15 | ПР25 = ПРА, ТЧВ, 44.5 | ПР26 = ТЧ6, ПЕРП, ПР1
"""


def test_the_statements_of_tekhtran_stand_in_the_examples() -> None:
    """Which are translated, run and compared elsewhere (test_rival_examples.py)."""
    examples = [path.read_text().splitlines() for path in (ROOT / "examples").glob("tkh-text-*.tkh")]
    lines = {line for text in examples for line in text}
    wanted = [line.strip() for row in STATEMENTS.strip().splitlines() for line in row.split("|")]
    assert [line for line in wanted if line not in lines] == []
    assert len(wanted) == 29
