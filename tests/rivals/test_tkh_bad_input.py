"""Errors are reported with line and column, and nothing is written (docs/spec/tekhtran.md, section 8)."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from facthelp import says
from tkhhelp import fault

from skg.errors import UserError
from skg.messages.finding import Phrase
from skg.messages.render import Speech, line
from skg.rivals.languages import translated

MADE = (
    "ТЧ1=0,0;ТЧ2=9,0;ТЧ3=9,9;ПР1=0,0,9,0;ПР2=0,5,9,5;ПР3=4,0,4,9;КР1=0,0,3;КР2=20,0,2;КР3=2,0,4;КР4=0,0,5;"
    "ВЕ1=1,2;МК1=1,0,0,0,0,1,0,0,0,0,1,0;ПЛ1=5;А=2;ТОЧКА Д;ПЛОСК П1\n"
)
MADE_AND_STARTED = MADE.replace("\n", ";ИЗ 4,-4\n")
NUMBERS = "1,2,3,4,5,6,7,8,9,10,11"

#: Text; ^ stands before the place, in the line.
TABLE = [
    # unknown characters
    "ТЧ5 = 1, ^@",
    "ТЧ5 = 1, ^.5",
    "ТЧ5 = 1, 5^.",
    "Х1 = КООРД (1^.КР1)",
    "ТЧ5 = 1^!2",
    "ТЧ5 = ^[ПЕРЕСЕЧ,] ПР1, ПР3",
    "ПР5 = ТЧ1, ^Q1",
    "^№",
    # unknown words
    "ФРЕЗА ^10",
    "ФРЕЗА^",
    "ФРЕЗА^  ",
    "ПЗЛ ^30",
    "^ХБ = 5",
    "^5 = А",
    "^= 5",
    "ПОВТОР ^ТЧ1",
    # forms that are not in the tables
    "ТЧ5 = 1^",
    "ТЧ5 = 1,^",
    "ТЧ5 =^",
    "ТЧ5^",
    "ТЧ5 = 1, 2, 3^, 4",
    "ТЧ5 = 1 ^2",
    "ТЧ5 = 1, ^+2",
    "ТЧ5 = 1, 2 ^ТЧ6 = 3, 4",
    "ТЧ5 = 1,^; ТЧ6 = 3, 4",
    "ТЧ5 = ^ЦЕНТР1, КР1",
    "ТЧ5 = ЦЕНТР ^КР1",
    "ТЧ5 = ПЕРЕСЕЧ, ^ТЧ1",
    "ТЧ5 = ПР1, КР1^",
    "ТЧ5 = ПР1, КР1,^",
    "ТЧ5 = ПР1, КР1, ^ПРЧС",
    "ТЧ5 = КР1, КР3, ^3",
    "ТЧ5 = КР1, ^ПР1, ХБ",
    "ТЧ5 = КР1, ПРЧС ^30",
    "ТЧ5 = КР1, ТЧ1, ^3",
    "ТЧ5 = ПР1, ХКООРД^",
    "ТЧ5 = ПР1, ТЧ1, 3^",
    "ТЧ5 = ТЧ1, ПЕРЕНОС, 1^",
    "ТЧ5 = ТЧ1, ПРЧС, 30^",
    "ТЧ5 = ТЧ1, МК1^, 1",
    "ТЧ5 = ВЕ1^, 2",
    "ТЧ5 = ^ПЛ1",
    "ПР5 = 1, 2, 3^",
    "ПР5 = ТЧ1, ТЧ2^, ТЧ3",
    "ПР5 = ТЧ1, СЛЕВА, ^ПР1",
    "ПР5 = СЛЕВА, КР1, ^КР2",
    "ПР5 = ТЧ1, КР2^",
    "ПР5 = ПР1, ТЧ1^",
    "ПР5 = ТЧ1, ПЕРП, ^КР1",
    "ПР5 = ^ПЕРП, ПР1",
    "КР5 = 1, 2^",
    "КР5 = ^КР1",
    "КР5 = ТЧ1, ТЧ2^",
    "ВЕ5 = 1^",
    "ВЕ5 = ПР1^",
    "ВЕ5 = ^ВЕ1, УМНОЖ, ВЕ1",
    f"МК5 = {NUMBERS}^",
    f"МК5 = {NUMBERS},12^,13",
    "ПЛ5 = 1, 2^",
    "ПЛ5 = ^ТЧ1",
    "Х5 = 1^, 2",
    "Х5 = (1^",
    "Х5 = 1^)",
    "Х5 = КООРД ^1, ТЧ1",
    "Х5 = КООРД(1, ^МК1)",
    "Х5 = КООРД(1, ТЧ1^",
    "ПЛЗ^",
    "ПЛЗ ^ТЧ1",
    "ПЧТ1^",
    "ПЧТ1 ТЧ1 ^ТЧ2",
    "СЛЕД ^ТЧ1",
    "ИЗ^",
    "ИЗ ^ПР1",
    "ИЗ 1^",
    "ИДИ ^ПР1",
    "ИДИ НА ^ТЧ1",
    "ПРИРАЩ 1, 2, 3^, 4",
    "ПРИРАЩ ^ТЧ1",
    "ТОЧКА^",
    "ТОЧКА Т5 ^Т6",
    "ТОЧКА Т5, Т6 ^= 1, 2",
    "КОНТУР^",
    "КОНТУР СЛЕВА, ^ТЧ1",
    "КОНТУР СЛЕВА, 0.1^",
    "КОНТУР КР1^",
    "КОНТУР КР1, ^УБ",
    "КОНТУР КР1, ПОЧС, ХБ, ^УБ",
    "КОНТУР ТЧ1, ^ХБ, ТЧ2",
    "КОНТУР ТЧ1,^",
    "КОНТУР ТЧ1, ^1, 2",
    "КОНТУР ^ВЕ1",
    # names not defined, of the wrong kind, of another kind
    "ТЧ5 = ^ТЧ6",
    "ТЧ5 = ^Д",
    "ТЧ5 = 1, ^Ы",
    "ТЧ5 = ^ТЧ5, ПЕРЕНОС, 1, 2",
    "ТЧ5 = ПР1, ^ВЕ1",
    "ПЧТ1 ТЧ1, ^ТЧ7",
    "ПЛЗ ^П1",
    "КОНТУР ТЧ1, ^ПР9",
    "Х5 = ^ТЧ1",
    "ТОЧКА ^ПР1 = 1, 2",
    "ТОЧКА ^ПР7 = 1, 2",
    "ТОЧКА ^А = 1, 2",
    "ПРЯМАЯ ^Д",
    "ТОЧКА Т5, ^А",
    # geometry
    "^ТЧ5 = ПР1, ПР2",
    "^ТЧ5 = ПР2, КР1, ХБ",
    "^ТЧ5 = КР1, КР2, УМ",
    "^ТЧ5 = КР1, КР4, УМ",
    "^ТЧ5 = ПР3, КР4, ХБ",
    "^ТЧ5 = КР1, КР3, ХМ",
    "^ТЧ5 = ПР1, УКООРД, 3",
    "^ТЧ5 = ПР3, ХКООРД, 3",
    "^ТЧ5 = ПР1, ТЧ1, 3, УБ",
    "^ТЧ5 = ПР1, ТЧ1, -3, ХБ",
    "^ТЧ5 = ТЧ1, ПРЧС, 30, -1",
    "ТЧ1=3,0; ^ТЧ5 = КР1, ТЧ1, ПРЧС, -1",
    "^ПР5 = ТЧ1, ТЧ1",
    "^ПР5 = 1, 2, 1, 2",
    "^ПР5 = ТЧ1, СПРАВА, КР1",
    "^ПР5 = ТЧ1, КР1, ХБ",
    "^ПР5 = ТЧ1, КР2, ХБ",
    "^ПР5 = СЛЕВА, КР1, СПРАВА, КР3",
    "^ПР5 = СЛЕВА, КР1, СЛЕВА, КР4",
    "^КР5 = 0, 0, 0",
    "^КР5 = 0, 0, -1",
    "^КР5 = ТЧ1, 2-2",
    "^КР5 = ТЧ1, ТЧ1, ТЧ3",
    "^КР5 = ТЧ1, ТЧ2, ТЧ1",
    "^ВЕ5 = ПР1, УБ",
    "ТЧ5 = 1, 2; ^ПРЯМАЯ Л = ТЧ5, ТЧ5",
    "Х5 = 1^/0",
    "ТЧ5 = 3, А ^/ (А - 2)",
    f"Х5 = ^{'9' * 40}",
    # points off their line or circle
    "ТЧ5 = КР1, ^ТЧ2, ПРЧС, 1",
    "ТЧ5 = ПР2, ^ТЧ1, 1, ХБ",
    # КООРД
    "Х5 = КООРД(^0, ТЧ1)",
    "Х5 = КООРД(^4, ТЧ1)",
    "Х5 = 1 + КООРД(^1.5, ТЧ1)",
    "Х5 = КООРД(^А+2, ТЧ1)",
    # moves
    "КОНТУР СЛЕВА, ^0, ТЧ1, ТЧ2",
    "КОНТУР СПРАВА, ^А-2, ТЧ1, ТЧ2",
    "КОНТУР СПРАВА, ^-0.1, ТЧ1, ТЧ2",
    "^КОНТУР ТЧ1",
    "^КОНТУР ТЧ1, ТЧ1",
    "^КОНТУР ПР1",
    "^КОНТУР ПР1, ХБ",
    "ВТОЧКУ ТЧ1; ^КОНТУР КР1, ПОЧС",
    "КОНТУР КР1, ПОЧС; ПРИРАЩ 1, 1; ^КОНТУР КР1, ПОЧС",
    "КОНТУР ^ТЧ2, КР1, ПРЧС",
    "КОНТУР КР1, ПРЧС, ^ТЧ2",
    "КОНТУР ТЧ1, ^ТЧ3, ПР1",
    "КОНТУР ПР1, ПР3, ^ТЧ1, ТЧ2",
    "КОНТУР ПР1, ^КР3, ПРЧС, ТЧ3",
    "КОНТУР ПР1, ^ПР2",
    "КОНТУР ТЧ1, ПР1, ^ПР1, ТЧ2",
    "КОНТУР ПР1, ^КР2, ПРЧС, УБ",
    "КОНТУР ПР1, ^КР1, ПРЧС, УБ",
    "КОНТУР ^ПР1, КР1, ПРЧС, ХБ",
    "КОНТУР ПР2, ^КР1, ПРЧС, ХБ",
    "КОНТУР КР1, ПРЧС, УБ, ^КР4, ПРЧС, УМ",
    "КОНТУР ^ПР1, ТЧ1",
    "КОНТУР ^ПР1, ПР3",
    "КОНТУР ТЧ2, ^ПР1, ТЧ2, ТЧ3",
    "ТЧ5=0,5;ТЧ6=1,5; КОНТУР ^ПР2, ТЧ6, ТЧ2, ТЧ5",
    "КОНТУР СЛЕВА, 0.1, ^ТЧ1, ТЧ2, ТЧ3",
    "КОНТУР СПРАВА, 0.1, ^ТЧ3, ТЧ2, ТЧ1",
    "ТЧ5=4.05,0; КОНТУР СЛЕВА, 0.1, ^ПР1, ТЧ5, ТЧ3, ТЧ1",
    "ТЧ5=5,0;КР5=2.5,0,2.5; КР6=7.5,0,2.5; ^КОНТУР КР5, ПРЧС, КР6, ПОЧС",
]


@pytest.mark.parametrize("marked", TABLE)
def test_place(marked: str) -> None:
    text = MADE_AND_STARTED + " " + marked.replace("^", "")
    assert marked.count("^") == 1
    message = fault(text)
    assert message.startswith(f"2:{marked.index('^') + 2}: "), (marked, message)
    assert len(message.split(": ", 1)[1]) > 3
    assert "\n" not in message


@pytest.mark.parametrize(
    "statement", ["ВТОЧКУ ТЧ1", "ПРИРАЩ 1, 2", "ПРИРАЩ 1", "ИДИ НА ПР1", "КОНТУР КР1, ПРЧС", "КОНТУР ТЧ1, ТЧ2"]
)
def test_before_the_start(statement: str) -> None:
    message = fault(f"{MADE} {statement}")
    assert message.startswith("2:2: ")
    assert "ИЗ" in message


def test_first_of_two() -> None:
    """In the order of the text, whatever kind of error it is."""
    assert fault("ТЧ1 = 1, 2\nТЧ2 = ТЧ1, ТЧ3\n@").startswith("2:12: ")
    assert fault("ТЧ1 = 1, 2\n@\nТЧ2 = ТЧ1, ТЧ3").startswith("2:1: ")
    assert fault("КР1 = 0, 0, -1 @").startswith("1:16: ")
    assert fault("КР1 = 0, 0, -1; @").startswith("1:1: ")
    assert fault("КР1 = 0, 0, 0\nКР1 = 0, 0, 0 @").startswith("1:1: ")


def test_columns_count_characters() -> None:
    """The place is the one in the file: Cyrillic letters are one column each, a title and blank lines count."""
    assert fault("ДЕТАЛЬ щит\n\n\tТЧ1 = 1, 2; ТЧ2 = ТЧ3\r\n").startswith("3:20: ")


def test_what_is_said() -> None:
    assert says(fault("ТЧ5 = 1"), "1:8: ", Phrase("rival-comma"), " - ", " +")
    assert says(fault("ТЧ5 = ХБ"), "ХБ")
    assert says(fault("ФРЕЗА 10"), "1:7: ", Phrase("expected-found", expected="=", found="10"))
    assert says(fault("+"), "1:1: ", Phrase("expected-found", expected=Phrase("rival-statement"), found="+"))
    assert says(fault("КР1 = 0, 0, 5; ТЧ1 = КР1, КР2, ХБ"), "1:27: ", Phrase("rival-undefined", name="КР2"))
    assert says(fault("КР1 = 0, 0, 5; ТЧ1 = КР1, КР1, ХБ"), "1:16: ", Phrase("rival-concentric"))


def test_on_a_chinese_screen(tmp_path: Path) -> None:
    """What `skg` prints of a program that it refuses has the words of its language, and the program's own names."""
    part = tmp_path / "part.tkh"
    part.write_text("ТЧ1 = 0, 0\nПР1 = ТЧ1, ТЧ1\n")
    with pytest.raises(UserError) as caught:
        translated(str(part))
    assert caught.value.finding.code == "rival-no-line"
    assert not re.search(r"[a-z]{2}", line(caught.value.finding, Speech("zh")).removeprefix(str(part)))
    assert re.search(r"[a-z]{2}", line(caught.value.finding, Speech("en")).removeprefix(str(part)))
