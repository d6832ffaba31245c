"""The headers of the firmware's sources say what is so: what a file offers and uses, and how many bytes it may have."""

from __future__ import annotations

import functools
import re
import sys

import pytest
from facthelp import each_says, pattern, says
from romhelp import ROOT

sys.path.insert(0, str(ROOT / "asm"))
import build
import rooms

#: In the process that has read the sources, which takes a second.
pytestmark = pytest.mark.xdist_group("rooms")

every = functools.cache(rooms.every)


@functools.cache
def merged() -> dict[str, rooms.Room]:
    """The rooms of all images in one."""
    return rooms.merged(every())


def test_offers_and_uses() -> None:
    assert len(merged()) > 20
    assert sum(len(room.uses) for room in merged().values()) > len(merged())
    assert rooms.wrong_headers(merged()) == [], "asm/rooms.py --headers writes these lines anew"


@pytest.mark.parametrize("image", build.IMAGES)
def test_no_knot(image: str) -> None:
    """Each file uses only files below it."""
    assert rooms.tangled(every()[image]) == []


def test_no_idle_hook() -> None:
    """A label called a hook is a hook in some image."""
    assert rooms.idle_hooks(merged()) == []


def test_no_silent_entry() -> None:
    """A comment at an entry in the middle of a routine names its callers."""
    assert rooms.silent_entries(merged()) == []


#: Routines with a number that counts: bytes that are copied, bits of a number.
COUNTED = {"COPY5", "COPY15", "FTOI16"}


def test_no_place_within_a_routine_is_offered() -> None:
    """A digit behind a name is a place within a routine; what another file enters has a name that says what it does."""
    labels = {found[1] for room in merged().values() for line in room.lines if (found := rooms.LABEL.match(line))}
    offered = {
        name for room in merged().values() for names in rooms.offered(merged(), room).values() for name in names
    } & labels
    restarts = set(build.RESTARTS.values()) | {"CALC0"}
    assert offered > COUNTED
    assert {name for name in offered if name[-1].isdigit()} <= COUNTED | restarts


#: A routine's header, from its first line on, and the line behind it.
HEADER = re.compile(r"^; (?P<name>[A-Z][A-Z0-9]*) - .*\n(?:;(?!!).*\n)*(?P<next>.*)", re.M)
#: What says which registers change, or that nobody sees them. (STMT says it for all statements and commands.)
CHANGED = re.compile(r"Clobbers|- (statement|command):|goes (back )?to (READY|ERR|RESET|BDREST)\b|for ever")


def silent_headers(lines: list[str]) -> list[str]:
    """Routines whose header does not say what they clobber."""
    headers = [found for found in HEADER.finditer("\n".join(lines)) if rooms.LABEL.match(found["next"])]
    return [found["name"] for found in headers if not CHANGED.search(found[0])]


def test_routines_say_what_they_clobber() -> None:
    assert sum(len(HEADER.findall("\n".join(room.lines))) for room in merged().values()) > 300
    assert {name: silent for name, room in merged().items() if (silent := silent_headers(room.lines))} == {}


def test_a_silent_header_is_said() -> None:
    said = ["; PLAY - plays", "; In:  A   Clobbers HL", "PLAY: RET", "; SCUT - statement: CUT", "SCUT: RET"]
    assert silent_headers(said) == []
    assert silent_headers([*said, "; WORK - works", "; In:  A", "WORK: RET", "; TAB - numbers", "N EQU 5"]) == ["WORK"]


def test_rooms_leave_what_is_kept() -> None:
    """The standard image's rooms together leave the bytes that are kept."""
    assert sum(rooms.room_of(room) or 0 for room in every()["skg"].values()) <= build.ROM_SIZE - build.KEPT


def test_no_file_asks_which_image_it_is_in() -> None:
    """Differences between images are files of their own, not conditions in a file."""
    lines = [f"{room.name}.asm: {line}" for room in merged().values() for line in map(rooms.code, room.lines)]
    assert len(lines) > 5000
    assert [line for line in lines if re.search(r"(?<!\w)(IF|ELSE|ENDIF|IFDEF|IFNDEF)\b", line, re.I)] == []


def test_a_board_of_ones_own_changes_no_header(monkeypatch: pytest.MonkeyPatch) -> None:
    """Files of its own fill the seam of the ports: the headers of those that call them stay as they are."""
    own = {"ports_2sio": "ports_tried", "io_6850": "io_tried", "io_held": "paper_tried", "io_tape": "tape_tried"}
    images = {**build.IMAGES, "skg-tried": build.Image(ports=tuple(own.values()))}
    monkeypatch.setattr(rooms, "SEAMS", rooms.seams(images))
    texts = {own.get(name, name): text for name, text in build.sources(build.IMAGES["skg"]).items()}
    tried = rooms.read(texts)
    assert set(own.values()) < set(tried)
    assert "io_tried" in tried["start"].uses
    wrong = rooms.wrong_headers(rooms.merged({**every(), "skg-tried": tried}), rooms.SEAMS)
    assert [line for line in wrong if line.split(".")[0] not in own.values()] == []


# The reader of headers itself, on small sources -----------------------------------------------------------------------

TABLES = "OPTAB: DW OADD,XMIN\nQADD EQU 01H\nQMIN EQU 02H\n"
TWO = {
    "equ": "; Offers: names for all\nCELL EQU 2000H\n",
    "one": "; Offers: RSTATE PLAY XMIN\n; Uses:   two\n; Room:   9 bytes\n"
    'RSTATE EQU CELL+1\nPLAY: CALL WORK ; not OTHER\nXMIN: RET\nHERE: DB "OTHER"\n',
    "two": "; Offers: WORK\n; Uses:   one\n; Room:   12 bytes\n"
    "WORK: LDA RSTATE\n DB QMIN\n CALL PLAY\nOTHER: RET\n" + TABLES + "OADD: RET\n",
}


def small(**changes: str) -> dict[str, rooms.Room]:
    """The two small sources, with some text instead of other."""
    return rooms.read(
        {name: text.replace(*changes[name].split("|")) if name in changes else text for name, text in TWO.items()}
    )


def test_small_sources_are_right() -> None:
    """Routines, cells, equates and the routines of operations count; names in comments and texts do not."""
    assert rooms.wrong_headers(small()) == []
    assert rooms.room_of(rooms.read(TWO)["two"]) == 12


@pytest.mark.parametrize(
    ("file", "change", "facts"),
    [
        ("one", "RSTATE PLAY|PLAY", ["one.asm: Offers:", "[RSTATE]", "[]"]),
        ("one", "RSTATE PLAY|PLAY RSTATE", ["one.asm: Offers:"]),
        ("one", "XMIN\n|XMIN GONE\n", ["one.asm: Offers:", "[]", "[GONE]"]),
        ("one", "; Uses:   two|; Uses:   three", ["one.asm: Uses:", "[two]", "[three]"]),
        ("one", "CALL WORK|CALL CELL", ["one.asm: Uses:", "[nothing]", "[two]"]),
        ("one", "; Uses:   two\n|", ["one.asm: ", 0, "Uses:"]),
        ("two", "; Room:   12 bytes|; Room:   some", ["two.asm: ", "Room: N bytes"]),
    ],
)
def test_what_is_wrong_is_said(file: str, change: str, facts: list[object]) -> None:
    wrong = rooms.wrong_headers(small(**{file: change}))
    assert any(re.search(pattern(*facts), one) for one in wrong)
    # (what is there is in another order: nothing is missing)
    assert ("[" in "".join(wrong)) == ("[" in "".join(map(str, facts)))


def test_a_knot_is_said() -> None:
    """`one` calls WORK of `two`, which calls PLAY of `one`; the hooks' names are not among these."""
    assert says(rooms.tangled(small())[0], "one two")
    hooks = ["PLAY", "RSTATE", "XMIN", "QMIN"]
    assert rooms.knots(rooms.leans(small(), hooks)) == [["equ"], ["two"], ["one"]]
    said = [line for line in rooms.idle_hooks(small()) if "READY" in line]
    assert each_says(said, ("READY", "hook"))


@pytest.mark.parametrize(
    ("middle", "told"),
    [
        ("PLAY2: RET\n", [("one.asm: ", "PLAY2", "OTHER", "comment")]),
        ("PLAY2: RET ; (OTHER comes in here)\n", []),
        ("; (OTHER comes in here)\nPLAY2: RET\n", []),
        ("PLAY2: DB ERROR,EWORD\n", []),
        ("JMP PLAY3\nPLAY3: RET\nPLAY2: RET ; (for OTHER)\n", []),
    ],
)
def test_an_entry_in_the_middle_is_said(middle: str, told: list[tuple[str, ...]]) -> None:
    sources = {
        "equ": "",
        "one": f"; PLAY - plays\nPLAY: NOP\n{middle}",
        "two": "; OTHER - another routine\nOTHER: JNZ PLAY2\n",
    }
    assert each_says(rooms.silent_entries(rooms.read(sources)), *told)
