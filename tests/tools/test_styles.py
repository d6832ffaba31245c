"""3B as other people write it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from facthelp import facts_of, says
from hypothesis import given, settings
from hypothesis import strategies as st
from test_tape import blocks
from toolhelp import CAD_TAPE, Run

from skg import tape as tapes
from skg.errors import UserError
from skg.messages.finding import Phrase
from skg.tape import Block, Stop, Tape
from skg.tape.styles import STYLES, read_any, to_style

ROOT = Path(__file__).parents[2]
BLOCKS = [
    "B9900B0B9900GXL3",
    "B0B70100B70100GYL2",
    "B55000B0B55000GXL3",
    "B50100B100B100000GYNR1",
    "B54900B0B54900GXL3",
]

#: The CAD package's tape of tape-3b.md in other styles, and what is noted.
SAME = {
    "published": (
        "B 9900B 0B 9900 GX L3 B 0B 70100B 70100 GY L2 B 55000B 0B 55000 GX L3 B 50100B 100B 100000 GY NR1"
        "B 54900B 0B 54900 GX L3",
        "style-blanks, style-several, style-no-end",
    ),
    "numbered": (
        "N 1: B 9900 B 0 B 9900 GX L3\nN 2: B 0 B 70100 B 70100 GY L2\nN 3: B 55000 B 0 B 55000 GX L3\n"
        "N 4: B 50100 B 100 B 100000 GY NR1\nN 5: B 54900 B 0 B 54900 GX L3\nN 6: DD\n",
        "style-numbers, style-blanks",
    ),
    "with header and places": (
        "****\nCAM -Version 2.0 , Name : part\nConner R= 0.00000 , Offset F= 0.10000 ,Length= 290.000 mm\n****\n"
        "Start Point =  115.00000 ,  -10.00000        ;     X ,   Y\n"
        "N   1: B   9900 B      0 B   9900 GX   L3 ;  105.100 , -10.000\n"
        "N   2: B      0 B  70100 B  70100 GY   L2 ;  105.100 ,  60.100\n"
        "N   3: B  55000 B      0 B  55000 GX   L3 ;   50.100 ,  60.100\n"
        "N   4: B  50100 B    100 B 100000 GY  NR1 ;  -50.100 ,  60.100\n"
        "N   5: B  54900 B      0 B  54900 GX   L3 ; -105.000 ,  60.100\nN   6: DD\n",
        "style-comments, style-header 5, style-numbers, style-blanks",
    ),
    "teletype's listing": (
        "0001 B9900B0B9900GXL3\n0002 B0B70100B70100GYL2\n0003 B55000B0B55000GXL3\n0004 B50100B100B100000GYNR1\n"
        "0005 B54900B0B54900GXL3\nDD\n",
        "style-numbers",
    ),
    "keyed in": (
        "b009900b000000b009900gxl3\nb0b070100b070100gyl2\nb055000b0b055000gxl3\nb050100b000100b100000gynr1\n"
        "b054900b0b054900gxl3\nE\n",
        "style-zeros, style-small, style-end E",
    ),
    "as little as there is": (
        "BBB9900GxL3\r\nBBB70100GyL2\r\nBBB55000GxL3\r\nB50100B100B100000GyNR1\r\nBBB54900GxL3\r\nFF\r\n",
        "style-no-zeros, style-small, style-j-alone, style-end FF",
    ),
    "by slope": (
        "B1B0B9900GXL3\r\nB0B1B70100GYL2\r\nB1B0B55000GXL3\r\nB50100B100B100000GYNR1\r\nB9B0B54900GXL3\r\nDD\r\n",
        "style-slope",
    ),
    "the axis of the quadrant before": (
        "B9900B0B9900GXL2\r\nB0B70100B70100GYL1\r\nB55000B0B55000GXL2\r\nB50100B100B100000GYNR1\r\nB54900B0B54900GXL3\r\nDD\r\n",
        "style-line-quadrant",
    ),
    "commas and comments": (
        "# a part\nB9900,B0,B9900,GX,L3 (in)\nB0,B70100,B70100,GY,L2 // up\nB55000,B0,B55000,GX,L3\n"
        "B50100,B100,B100000,GY,NR1\nB54900,B0,B54900,GX,L3\nDD\n\x1a",
        "style-comments, style-blanks",
    ),
}

#: The same with a header in Chinese, counted as Chinese editors do, with full-width letters and blanks.
SAME |= {
    "a header in Chinese": (
        "零件程序 图号：冲模01\n偏移量=0.1\n" + "\n".join(BLOCKS) + "\nDD\n",
        "style-header 2",
    ),
    "counted in Chinese": ("".join(f"{k}、{block}\n" for k, block in enumerate(BLOCKS, 1)) + "DD\n", "style-numbers"),
    "counted with a bracket": ("".join(f"{k}) {b}\n" for k, b in enumerate(BLOCKS, 1)) + "DD\n", "style-numbers"),
    "an old Macintosh's": ("".join(f"{block}\r" for block in BLOCKS) + "DD\r", "style-bare-cr"),
    "full-width": (
        "".join("".join(chr(ord(c) + 0xFEE0) for c in block) + "\u3000\n" for block in BLOCKS) + "ＤＤ\n",
        "style-full-width",
    ),
}


def told(tape: Tape) -> str:
    """The notes on a tape's style: the codes, with their values."""
    (note,) = tape.notes
    return ", ".join(" ".join([each.code, *(str(value) for _, value in each.values)]) for each in note["notes"])


@pytest.mark.parametrize("encoding", ["utf-8", "gb18030"])
@pytest.mark.parametrize(("text", "noted"), SAME.values(), ids=SAME)
def test_the_same_tape(text: str, noted: str, encoding: str) -> None:
    tape = tapes.parse(text.encode(encoding))
    assert [str(block) for block in tape.blocks] == BLOCKS
    assert tape.stops == ()
    assert told(tape) == noted


def test_own_style_is_not_noted() -> None:
    assert tapes.parse(CAD_TAPE).notes == read_any(CAD_TAPE).notes == ()
    assert list(read_any(CAD_TAPE).items) == list(tapes.parse(CAD_TAPE).items)


@pytest.mark.parametrize(("text", "blocks_", "stops"), [
    ("B5B0B5GXL1 D B0B5B5GYL2 A B5B0B5GXL3 DD", 3, [1, 2]),
    ("D\nB 5 B0 B5 GX L1\nD\nB0B5B5GYL2\nDD", 2, [0, 1]),
    ("N1 B5B0B5GXL1\nN2 D\nN3 B0B5B5GYL2\nN4 D\n", 2, [1, 2]),
    ("B5B0B5GXL1DB0B5B5GYL2DB 5B0B5GXL3DD", 3, [1, 2]),
    ("B5B0B5GXL1\nSTOP\nB0B5B5GYL2\nPause\nB5B0B5GXL3\nM00\nM 1\nDD", 3, [1, 2, 3, 3]),
    ("B5B0B5GXL1M0B0B5B5GYL2\nSTOP", 2, [1, 2]),
])  # fmt: skip
def test_stops(text: str, blocks_: int, stops: list[int]) -> None:
    tape = tapes.parse(text.encode())
    assert len(tape.blocks) == blocks_
    assert [stop.after for stop in tape.stops] == stops


def test_a_stop_in_a_blocks_line_is_noted() -> None:
    """4B has a D there that is no stop."""
    tape = tapes.parse(b"B9900B0B9900GXL3D\r\nB9900B0B9900GXL1\r\nDD\r\n")
    assert [stop.after for stop in tape.stops] == [1]
    assert told(tape) == "style-stop-beside"


@pytest.mark.parametrize("lost", ["N7 B5B0B5GX", "B 5 B0 B5 GX L9", "hm\nB5"])
def test_half_a_block_behind_the_end_is_not_lost(lost: str) -> None:
    with pytest.raises(UserError) as error:
        tapes.parse(f"N1 B5B0B5GXL1 DD\n{lost}\n".encode())
    assert facts_of(error.value.finding)[:4] == ["nothing-after", 2, 1, "DD"]


@pytest.mark.parametrize("word", ["END", "end", "M02", "M2", "N3 M30", "M 02", "FF", "E", "MJ"])
@pytest.mark.parametrize("between", ["\n", " ", ""])
def test_words_that_end_a_tape(word: str, between: str) -> None:
    """The word is noted, and what other programs put around it; a block behind it is not lost without a word."""
    text = f"B5B0B5GXL1{between}B0B5B5GYL2{between}{word}"
    tape = tapes.parse(f"{text}\n%\n".encode())
    name = word.upper().removeprefix("N3 ").replace(" ", "")
    assert len(tape.blocks) == 2 and tape.stops == ()
    assert {f"style-end {name}", "style-trailer 1"} <= set(told(tape).split(", "))
    with pytest.raises(UserError) as error:
        tapes.parse(f"{text} B5B0B5GXL3 DD".encode())
    code, *_, end, found = facts_of(error.value.finding)
    assert (code, end, found) == ("nothing-after", name, "a-block")


@pytest.mark.parametrize("word", ["M22", "M021", "ENDE", "M3", "HALT"])
def test_other_words_are_refused(word: str) -> None:
    with pytest.raises(UserError) as error:
        tapes.parse(f"B5B0B5GXL1\n{word}\nB0B5B5GYL2\nDD\n".encode())
    assert facts_of(error.value.finding) == ["no-block-no-word", 2, 1, repr(word)]


def test_blank_tape_and_rubouts_between_blocks() -> None:
    tape = tapes.parse(b"\0\0B5B0B5GXL1\r\n\0\0\x7f\x7fB0B5B5GYL2\r\n\0DD\r\n\0\x7f")
    assert len(tape.blocks) == 2
    assert told(tape) == "style-blank-tape"


def test_diagonals_and_arcs_on_an_axis() -> None:
    """G of a line at 45 degrees may be either; an arc that starts on an axis may go by either quadrant."""
    tape = tapes.parse(b"B5B5B5GXL1\r\nB1B1B700GYL2\r\nB500B0B500GXSR1\r\nDD\r\n")
    assert [str(block) for block in tape.blocks] == ["B5B5B5GYL1", "B700B700B700GXL2", "B500B0B500GXSR4"]
    assert tape.blocks[0].move == (5, 5) and tape.blocks[1].move == (-700, 700)


@pytest.mark.parametrize(("text", "facts"), [
    ("B 5B0B5GXL1\nB0B5B5GYL2\nB5B0B5GXL\nDD", ["no-block-no-word", 3, 1, "'B5B0B5GXL'"]),
    ("B 5B0B5GXL1\nhello\nDD", ["no-block-no-word", 2, 1, "'hello'"]),
    ("B1B1GYL1\r\nB5B0B5GXL1\r\nDD\r\n", ["no-block", 1, 1]),
    ("B5B0B5GXL1\r\nB0B5B5GYL2\r\n", ["expected-found", 3, 1, "DD", "end-of-tape"]),
    ("B5B0B5GXL1\r\nDD\r\nB0B5B5GYL2\r\nDD\r\n", ["nothing-after", 3, 1, "DD", "a-block"]),
    ("B5B0B5GXL1\r\nDD\r\nB1", ["nothing-after", 3, 1, "DD", "'B1'"]),
    ("B 7B5B6GXL1 DD", ["line-j-less", 1, 1, 1, 6, 7]),
    ("B 7B9B9GXL1 DD", ["line-axis", 1, 1, 1, "X", "Y"]),
    ("B 5000B0B5001GXL1 DD", ["line-j-more", 1, 1, 1, 5001, 5000]),
    ("B 123456789B0B123456789GXL1 DD", ["too-many-digits", 1, 1, "x", 9, 8]),
    ("B 0B0B5GYL1 DD", ["block-nowhere", 1, 1, 1]),
    ("hello\nworld\n", ["no-block-at-all", 1, 1]),
    ("  0\nSECTION\n  2\nENTITIES\n", ["other-kind", "file-dxf", "file-tape"]),
    ("10 FROM O\n20 CUT (1,0)\n", ["other-kind", "file-program", "file-tape"]),
    ("B0B0B2900GXL1\nB2900B0B2900B2900GYDNR1\nDD", ["tape-4b", 2, 1]),
    ("B5B0B5GXL1\nD1\nB0B5B5GYL2\nDD", ["no-block-no-word", 2, 2, "'1'"]),
    ("B5B0B5GXL1\n结束了\n", ["no-block-no-word", 2, 1, "'结束了'"]),
    ("B5B0B5FXL1\nDD", ["no-block", 1, 1]),
    ("B3000B0B3000GXDL1\nDD", ["tape-4b", 1, 13]),
])  # fmt: skip
def test_refused(text: str, facts: list[object]) -> None:
    with pytest.raises(UserError) as error:
        tapes.parse(text.encode(), "x.3b")
    assert error.value.finding.source[0] == "x.3b" and facts_of(error.value.finding) == facts


def test_a_line_that_is_missing() -> None:
    tape = tapes.parse(b"N1 B5B0B5GXL1\nN2 B0B5B5GYL2\nN4 B5B0B5GXL3\nDD\n")
    assert told(tape).split(", ")[-1] == "style-uneven"


@given(st.lists(st.one_of(blocks(), st.builds(Stop, st.just(0))), min_size=1).filter(
    lambda items: any(isinstance(item, Block) for item in items)))  # fmt: skip
@settings(max_examples=60)
def test_every_style_is_read_again(items: list[Block | Stop]) -> None:
    own = to_style(items, "punch")
    for style in STYLES:
        tape = tapes.parse(to_style(items, style))
        assert to_style(tape.items, "punch") == own, style


def test_every_style_stands_on_the_pages() -> None:
    """In docs/tools.md, and where the page of `skg ui` has them chosen."""
    sources = ROOT / "web" / "src" / "ui"
    section = (ROOT / "docs" / "tools.md").read_text().partition("\nStyles to write:")[2].partition("\n\n")[0]
    types = re.search(r"^export type Style = (.*);", (sources / "types.ts").read_text(), re.M)[1]
    options = re.search(r'<select id="save-style">(.*)</select>', (sources / "index.html").read_text(), re.S)[1]
    assert [style for style in STYLES if f"`{style}`" not in section] == [], "docs/tools.md"
    assert re.findall(r'"(\w+)"', types) == list(STYLES), "types.ts"
    assert re.findall(r'value="(\w+)"', options) == list(STYLES), "index.html"


def test_start_point(run: Run, tmp_path: Path) -> None:
    """A tape is drawn at the wire's start that its header gives."""
    path = tmp_path / "other.3b"
    path.write_text(SAME["with header and places"][0])
    drawing = run("dxf", path).stdout
    assert " 10\n115.0\n 20\n-10.0\n" in drawing


@pytest.mark.parametrize("words", [["sim"], ["plot", "-o", "-"], ["dxf"], ["tape"]], ids=lambda words: words[0])
def test_every_tool_reads_it_and_says_so(run: Run, tmp_path: Path, words: list[str]) -> None:
    own, other = tmp_path / "part.3b", tmp_path / "other" / "part.3b"
    other.parent.mkdir()
    own.write_bytes(CAD_TAPE)
    other.write_text(SAME["published"][0])
    ones, others = (run(words[0], path, *words[1:]) for path in (own, other))
    assert others.exit_code == 0
    assert says(
        others.stderr,
        f"skg: {other}: ",
        Phrase("other-style"),
        *map(Phrase, ("style-blanks", "style-several", "style-no-end")),
    )
    texts = [result.stdout.replace(str(other), str(own)) for result in (ones, others)]
    if words == ["dxf"]:
        texts = [text.rpartition("\nENTITIES\n")[2].partition("\nOBJECTS\n")[0] for text in texts]
    assert texts[0] == texts[1]


def test_check_says_what_is_different(run: Run, tmp_path: Path) -> None:
    """It goes by the punch's own style, names the first findings, and does not print a drawing's every line."""
    path = tmp_path / "other.3b"
    path.write_text("\n".join(f"N{k} B 5B0B5 GX L1" for k in range(1, 99)) + "\nDD\n")
    result = run("check", path)
    assert result.exit_code == 1
    assert len(result.stdout.splitlines()) == 21
    assert says(result.stdout.splitlines()[-1], Phrase("more-findings"))
    assert says(result.stderr, Phrase("other-style-read"), Phrase("style-numbers"), Phrase("style-blanks"))
    assert len(run("check", "--all", path).stdout.splitlines()) > 98
    path.write_text("  0\nSECTION\n  2\nENTITIES\n" * 1000)
    result = run("check", path)
    assert (result.exit_code, len(result.stdout.splitlines())) == (1, 1)
    assert says(result.stdout, f"{path}: ", Phrase("other-kind", kind=Phrase("file-dxf"), expected=Phrase("file-tape")))


def test_written_in_a_style(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "part.3b"
    path.write_bytes(CAD_TAPE)
    assert run("tape", path).stdout.encode() == CAD_TAPE.replace(b"\r\n", b"\n")
    assert run("tape", path, "--style", "joined").stdout == SAME["published"][0].replace("NR1B", "NR1 B") + " DD "
    assert run("tape", path, "--style", "numbered").stdout.splitlines()[3] == "N   4: B 50100 B 100 B 100000 GY NR1"
    assert run("tape", path, "--style", "padded").stdout.splitlines()[0] == "B009900B000000B009900GXL3"


@pytest.mark.parametrize(("text", "noted"), [("{}{}DD", True), ("{}\n{}DD", False), ("{}\r\n{}\r\nDD\r\n", False)])
def test_blocks_without_line_ends_are_noted(text: str, noted: bool) -> None:
    tape = tapes.parse(text.format("B9900B0B9900GXL3", "B0B70100B70100GYL2").encode(), "part.3b")
    assert (len(tape.blocks), bool(tape.notes) and "style-several" in told(tape)) == (2, noted)
