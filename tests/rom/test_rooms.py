"""The headers of the firmware's sources say what is so: what a file offers and uses, and how many bytes it may have."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import pytest
from romhelp import ROOT

sys.path.insert(0, str(ROOT / "asm"))
import rooms

import build

#: Bytes of the ROM that are kept for what is to come.
KEPT = 450
FILES = rooms.read(build.FILES)


def bytes_of(options: dict[str, int]) -> dict[str, int]:
    """Bytes of each source file in an image."""
    with tempfile.TemporaryDirectory() as work:
        _, symbols, _ = build.assemble(build.FILES, options, Path(work))
    marks = [symbols[f"ZB{name.upper()}"] for name in build.FILES] + [symbols["ZBEND"]]
    return {name: end - begin for name, begin, end in zip(build.FILES, marks, marks[1:], strict=False)}


def given() -> dict[str, dict[str, int]]:
    """Bytes that each header gives its file."""
    return {name: rooms.room_of("\n".join(room.lines)) for name, room in FILES.items() if name != rooms.COMMON}


def test_offers_and_uses() -> None:
    assert len(FILES) == len(build.FILES) > 10
    assert sum(len(room.uses) for room in FILES.values()) > len(FILES)
    assert rooms.wrong_headers(FILES) == [], "asm/rooms.py --headers writes these lines anew"


@pytest.mark.parametrize("option", ["", *build.OPTIONS])
def test_room(option: str) -> None:
    """No file is longer than its header allows, with any one option."""
    sizes = bytes_of(build.OPTIONS | ({option: 1} if option else {}))
    allowed = {name: room.get(option, room[""]) for name, room in given().items()}
    assert {name: f"{sizes[name]} of {n} bytes" for name, n in allowed.items() if sizes[name] > n} == {}


def test_rooms_leave_what_is_kept() -> None:
    """All rooms together leave the bytes that are kept."""
    assert sum(room[""] for room in given().values()) <= build.ROM_SIZE - KEPT


# The reader of headers itself, on small sources -----------------------------------------------------------------------

TABLES = "OPTAB: DW OADD,XMIN\nQADD EQU 01H\nQMIN EQU 02H\n"
TWO = {
    "equ": "; Offers: names for all\nCELL EQU 2000H\n",
    "one": "; Offers: STATE PLAY XMIN\n; Uses:   two\n; Room:   9 bytes\n"
           "STATE EQU CELL+1\nPLAY: CALL WORK ; not OTHER\nXMIN: RET\nHERE: DB \"OTHER\"\n",
    "two": "; Offers: WORK\n; Uses:   one\n; Room:   9 bytes, 12 with LONG\n"
           "WORK: LDA STATE\n DB QMIN\n CALL PLAY\nOTHER: RET\n" + TABLES + "OADD: RET\n",
}


def small(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, **changes: str) -> dict[str, rooms.Room]:
    """The two small sources, with some text instead of other."""
    for name, text in TWO.items():
        (tmp_path / f"{name}.asm").write_text(text.replace(*changes[name].split("|")) if name in changes else text)
    monkeypatch.setattr(rooms, "ASM", tmp_path)
    return rooms.read(TWO)


def test_small_sources_are_right(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Routines, cells, equates and the routines of operations count; names in comments and texts do not."""
    assert rooms.wrong_headers(small(tmp_path, monkeypatch)) == []
    assert rooms.room_of(TWO["two"]) == {"": 9, "LONG": 12}


@pytest.mark.parametrize(("file", "change", "said"), [
    ("one", "STATE PLAY|PLAY", "one.asm: Offers: lacks [STATE], has too much []"),
    ("one", "STATE PLAY|PLAY STATE", "one.asm: Offers: is written in another way"),
    ("one", "XMIN\n|XMIN GONE\n", "one.asm: Offers: lacks [], has too much [GONE]"),
    ("one", "; Uses:   two|; Uses:   three", "one.asm: Uses: lacks [two], has too much [three]"),
    ("one", "CALL WORK|CALL CELL", "one.asm: Uses: lacks [nothing], has too much [two]"),
    ("one", "; Uses:   two\n|", "one.asm: 0 lines Uses:"),
    ("two", "; Room:   9 bytes|; Room:   some", "two.asm: no line Room: N bytes"),
])
def test_what_is_wrong_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, file: str, change: str,
                               said: str) -> None:
    found = small(tmp_path, monkeypatch, **{file: change})
    assert said in rooms.wrong_headers(found)
