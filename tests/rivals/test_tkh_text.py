"""TEKHTRAN's letters, names and moves, and the SKG program they make (docs/spec/tekhtran.md, sections 1, 2, 5 to 7)."""

from __future__ import annotations

import re

import pytest
from rivalhelp import ROOT
from tkhhelp import cut, fault

from skg.ref import run
from skg.rivals.tekhtran import translate

PART = (ROOT / "examples" / "tkh-fork.tkh").read_text()
WORDS = {"ТЧ0": "ТОЧКА", "ТЧ3": "точка", "КР1": "ОКРУЖН", "КР2": "ОКРУЖИ", "ПР1": "ПРЯМАЯ", "МК1": "МАТР"}
SPELLINGS = {
    "lower": str.lower,
    "latin": lambda text: text.translate(str.maketrans("АВСЕНКМОРТХУ", "ABCEHKMOPTXY")),
    "latin, lower": lambda text: text.translate(str.maketrans("АВСЕНКМОРТХУ", "abcehkmoptxy")),
    "minus": lambda text: text.replace("-", "−"),
    "dash": lambda text: text.replace("-", "–"),
    "one line": lambda text: text.split("\n", 1)[0] + "\n" + text.split("\n", 1)[1].replace("\n", "; "),
    "blanks": lambda text: text.replace(",", " \t,  ").replace("=", " = ").replace("\n", "\r\n\n"),
    "tight": lambda text: text.replace(", ", ",").replace(" = ", "="),
    "words": lambda text: re.sub(r"\b(ТЧ0|ТЧ3|КР1|КР2|ПР1|МК1) =", lambda name: f"{WORDS[name[1]]} {name[0]}", text),
    "end": lambda text: text + "\n\x00 is not read @",
}  # fmt: skip


@pytest.mark.parametrize("spelling", SPELLINGS)
def test_spelling(spelling: str) -> None:
    text = SPELLINGS[spelling](PART)
    assert text != PART
    assert translate(text).splitlines()[2:] == translate(PART).splitlines()[2:]


def test_program() -> None:
    """Names, their numbers, the REMs, every statement that is no contour."""
    program = translate(
        """ДЕТАЛЬ Щит №5; «проба»
        ТОЧКА Т3, Т4
        Т3 = 24, -8, 2
        ТЧ899 = 1, 2; ТЧ900 = 3, 4; ТЧ07 = 5, 6
        ТЧА = 2*(3+4), -Х1 ; КОНЕЦ""".replace("-Х1", "-1/4"),
        "вилка.tkh",
    )
    assert program.splitlines() == [
        "10 REM VILKA.TKH",
        "20 REM SHCHIT ?5; ?PROBA?",
        "30 REM T3 IS P900, TCH900 IS P901, TCH07 IS P902, TCHA IS P903",
        "40 P900=(24,-8)",
        "50 P899=(1,2)",
        "60 P901=(3,4)",
        "70 P902=(5,6)",
        "80 P903=(2*(3+4),-1/4)",
        "90 END",
    ]


def test_all_letters() -> None:
    """Latin for every Cyrillic letter, as it stands in the specification's table."""
    program = translate("АБВГДЕЖЗИЙКЛМНОПРСТУФ = 1; ХЦЧШЩЪЫЬЭЮЯЁ = 2")
    assert "REM ABVGDEZHZIJKLMNOPRSTUF IS D1, KHCCHSHSHCHYEHYUYAE IS D2\n" in program


def test_names_by_their_beginning() -> None:
    program = translate(
        "ТЧА = 1, 2; ВЕКТ1 = 3, 4; ПРА = 0, 0, 1, 1; КРЗ = 0, 0, 5; ПЛ14 = 7; МК1 = 1,0,0,0,0,1,0,0,0,0,1,0; Х1 = 5"
    )
    for name, skg in (("TCHA", "P900"), ("VEKT1", "V900"), ("PRA", "S900"), ("KRZ", "C900"), ("KH1", "D1")):
        assert f"{name} IS {skg}" in program
    assert "PL14" not in program


@pytest.mark.parametrize(
    "text",
    [
        "ТОЧКА ПР1 = 1, 2",
        "ПЛОСК П1; П1 = 1, 2",
        "А = 5; ТОЧКА А",
        "ТОЧКА А; ПРЯМАЯ А",
        "ТОЧКА А; Б = А",
    ],
)
def test_a_name_keeps_its_kind(text: str) -> None:
    assert fault(text).startswith("1:")


def printed(text: str) -> list[str]:
    return run(translate(text)).paper.splitlines()


def test_print_and_trace() -> None:
    lines = printed(
        """ТЧ1 = 1, 2, 3; ПР1 = 0, 5, 1, 5; ПР2 = 5, 0, 5, 1; КР1 = 1, 2, 4; ВЕ1 = 1, 2, 3
        МК1 = 1,2,3,4,5,6,7,8,9,10,11,12.5; ПЛ1 = -30; Х1 = 5/2
        ПЧТ1 ТЧ1, ПР1, ПР2, КР1, ВЕ1, МК1, ПЛ1, Х1
        СЛЕД ВКЛ; ТЧ2 = 7, 8; Х2 = 1; ПЛ1 = 3; СЛЕД ВЫКЛ
        ТЧ3 = 1, 1; СЛЕД ВСЕ
        ПР3 = ТЧ1, 0; СЛЕД ВЫКЛ; МК2 = 0,0,0,0,0,0,0,0,0,0,0,0"""
    )
    assert lines == [
        "TCH1 1 2 3", "PR1 0 1 5", "PR2 1 0 5", "KR1 1 2 4", "VE1 1 2 3", "MK1 1 2 3 4 5 6 7 8 9 10 11 12.5",
        "PL1 0 0 1 -30", "KH1 2.5", "TCH2 7 8 0", "PL1 0 0 1 3", "PR3 0 1 2",
    ]  # fmt: skip


def test_long_prints_and_titles_are_short_lines() -> None:
    number = "1.23456789012345678901"
    text = f"ДЕТАЛЬ {'Щука ' * 30}\nМК1 = {', '.join([number] * 12)}\nПЧТ1 МК1\n{'Щ' * 80} = 5\nПЧТ1 {'Щ' * 80}\n"
    text += f"ТЧ1 = {'+'.join([number] * 9)}, 1\nИЗ {'+'.join([number] * 9)}, 1\nВТОЧКУ 1, {'+'.join([number] * 9)}\n"
    program = translate(text + f"КР1 = 0, 0, 5; ИЗ 0, 0; КОНТУР СПРАВА, {'+'.join(['0.01'] * 30)}, КР1, ПРЧС")
    assert max(map(len, program.splitlines())) <= 72
    result = run(program)
    assert result.error is None
    assert result.paper.split().count("1.2345679") == 12


# Moves ---------------------------------------------------------------------------------------------------------------


def blocks(text: str) -> list[str]:
    return cut(text).tape.decode().split()


def test_moves() -> None:
    """Each form of a move; to where the wire is: none; along the tool's axis: none."""
    tape = blocks(
        """ИЗ 1, 2; ПРИРАЩ 3, 4; ПРИРАЩ 20; ПРИРАЩ 1, 0, 5; ВТОЧКУ 5, 6, 7; ВТОЧКУ 9, 6
        ТЧ1 = 9, 9; ВТОЧКУ ТЧ1; ВТОЧКУ ТЧ1; ПРЯМАЯ Л = 0, 0, 0, 5; ИДИ НА Л; КР1 = 0, 20, 3; ИДИ НА КР1"""
    )
    assert tape == [
        "B3000B4000B4000GYL1", "B1000B0B1000GXL1", "B4000B0B4000GXL1", "B0B3000B3000GYL2",
        "B9000B0B9000GXL3", "B0B8000B8000GYL2", "DD",
    ]  # fmt: skip


def test_start_again() -> None:
    """Two stops, and the way between them."""
    tape = blocks("ИЗ 1, 2; ВТОЧКУ 5, 2; ИЗ 5, 8; ВТОЧКУ 5, 9; КР1 = 5, 9, 2; ИЗ 5, 9; КОНТУР КР1, ПОЧС; ПРИРАЩ 1, 0")
    assert tape == [
        "B4000B0B4000GXL1", "D", "B0B6000B6000GYL2", "D", "B0B1000B1000GYL2", "D", "D", "B2000B0B2000GXL1",
        "B2000B0B8000GYSR4", "B2000B0B2000GXL3", "B1000B0B1000GXL1", "DD",
    ]  # fmt: skip


def test_the_wire_stays_when_its_point_is_defined_again() -> None:
    assert blocks("ТЧ1 = 1, 1; ИЗ ТЧ1; ТЧ1 = 50, 50; ВТОЧКУ 2, 1") == ["B1000B0B1000GXL1", "DD"]
    assert blocks("А = 1; ИЗ А, 1; А = 50; ВТОЧКУ 2, 1") == ["B1000B0B1000GXL1", "DD"]


def test_there_and_back_is_cut() -> None:
    tape = blocks("ИЗ 0, 0; ВТОЧКУ 5, 0; ВТОЧКУ 0, 0; ВТОЧКУ 5, 0; ВТОЧКУ 0, 0")
    assert tape == ["B5000B0B5000GXL1", "B5000B0B5000GXL3"] * 2 + ["DD"]


def test_many_corners() -> None:
    """More corners than there are names for: numbers stand in the CUT; and each contour takes the same names."""
    text = "".join(f"ПР{i} = {i}, 0, {i}, 1; ПР{100 + i} = 0, {5 + i % 2}, 1, {5 + i % 2}\n" for i in range(1, 61))
    text += "ПР0 = 0, 0, 1, 0; ИЗ 8.5, -1\n"
    parts = ["ПР0"] + [f"ПР{i}, ПР{100 + i}" for i in range(60, 1, -1)] + ["ПР1"]
    program = translate(text + f"КОНТУР {', '.join(parts)}\n" + "КОНТУР ПР0, ПР9, ПР101, ПР8\n")
    assert "P999=" in program
    assert program.count("P900=") == 2
    result = run(program)
    assert result.error is None
    assert sum(s.role == "cut" for s in result.path) == 120 + 1 + 5
