"""G-code from tapes and back, and what is read of other people's."""

from __future__ import annotations

import json
import re
import tracemalloc
from itertools import groupby
from math import hypot, pi
from pathlib import Path

import pytest
from facthelp import each_says, facts_of, pattern, says
from hypothesis import example, given
from hypothesis import strategies as st
from test_tape import blocks
from toolhelp import CAD_TAPE, Run

from skg import tape as tapes
from skg.errors import UserError
from skg.messages.finding import Finding, Phrase
from skg.messages.render import text as text_of
from skg.ref import mill
from skg.tape import Block, Stop, Tape, gcode, gcode_reader
from skg.tape.layout import PlacedRoute, place

ROOT = Path(__file__).parents[2]

#: What a CAD package gave for the path of its 3B tape.
CAD_GCODE = """\
G91 G92 X115000 Y-10000
G01 X-9900 Y0
G01 X0 Y70100
G01 X-55000 Y0
G03 X-100200 Y0 I-50100 J-100
G01 X-54900 Y0
M02
"""
OURS = """\
N1G17G21G90G94
N2G0X115Y-10
N3G1X105.1Y-10F60
N4G1X105.1Y60.1
N5G1X50.1Y60.1
N6G3X-50.1Y60.1I-50.1J-0.1
N7G1X-105Y60.1
N8M30
"""


def back(text: str) -> bytes:
    return tapes.to_bytes(gcode_reader.read(text).tape().items)


def test_cad_pair(run: Run, cad_tape: Path, tmp_path: Path) -> None:
    made = run("gcode", cad_tape, "--start", "115,-10", "--feed", "60", "--positions", "programmed")
    assert made.stdout_bytes.decode() == OURS.replace("\n", "\r\n")
    assert made.stderr == ""
    for text in (CAD_GCODE, OURS):
        tape = tmp_path / "back.3b"
        assert run("gcode", "--back", "-", "-o", tape, stdin=text).exit_code == 0
        assert tape.read_bytes() == CAD_TAPE


def test_a_feed_that_was_not_given_is_said(run: Run, cad_tape: Path) -> None:
    made = run("gcode", cad_tape, "--positions", "programmed")
    assert each_says(made.stderr, ("skg: ", Phrase("no-feed-given", feed=100)))
    assert "N3G1X-9.9Y0F100\r\n" in made.stdout_bytes.decode()


def test_program_begins_at_its_from_point(run: Run) -> None:
    made = run("gcode", ROOT / "examples" / "plate-fillets.skg", "--feed", "60").output
    milled = mill.run("1 F 60\n" + (ROOT / "examples" / "plate-fillets.skg").read_text()).tape.decode().split()
    wire = [line for line in made.split() if "M0" not in line]
    assert [line.partition("G")[2] for line in wire] == [line.partition("G")[2] for line in milled]


def test_heights(run: Run, tmp_path: Path) -> None:
    tape = tmp_path / "part.3b"
    tape.write_bytes(b"B1000B0B1000GXL1\r\nD\r\nB0B2000B2000GYL2\r\nD\r\nB1000B0B1000GXL1\r\nB0B5B5GYL2\r\nD\r\n"
                     b"B0B2000B2000GYL2\r\nB1000B0B1000GXL1\r\nDD\r\n")  # fmt: skip
    made = run("gcode", tape, "--feed", "60,20", "--z", "-1.5,3").output.split()
    assert [line.partition("G")[2] for line in made[1:]] == [
        "0Z3", "0X0Y0", "1Z-1.5F20", "1X1Y0F60", "0Z3", "0X1Y2", "1Z-1.5F20", "1X2Y2F60", "1X2Y2.005", "",
        "1X2Y4.005", "1X3Y4.005", "0Z3", "",
    ]  # fmt: skip


def is_changed(block: Block) -> bool:
    """An arc that goes out as a line, or as a circle and a line (milling.md, section "Arcs")."""
    dx, dy = block.move
    flat = block.is_arc and abs(block.sweep) <= pi and (dx * dx + dy * dy) ** 2 <= 4 * (block.x**2 + block.y**2)
    return flat or (block.is_arc and abs(block.sweep) > 2 * pi - 1e-6)


def vertices(routes: list[PlacedRoute]) -> list[list[tuple[float, float]]]:
    """The places that each route goes through, each once in a row; routes of one place are left out."""
    through = [[route.start, *(placed.end for placed in route.blocks)] for route in routes]
    return [once for route in through if len(once := [one for one, _ in groupby(route)]) > 1]


def laid(tape: Tape) -> list[PlacedRoute]:
    return place(tape, (0, 0), "programmed")


@given(st.lists(st.one_of(blocks(), st.builds(Stop, st.just(0)))), st.booleans())
@example([Block(0, 1, 2, "X", "NR2", 0), Block(0, 1, 1, "Y", "L2", 0)], False)
@example([Block(0, 2000001, 8000002, "X", "SR1", 0)], False)
def test_round_trip(items: list[Block | Stop], mills: bool) -> None:
    tape = tapes.parse(tapes.to_bytes(items))
    text = gcode.write(tape, heights=(-1000, 5000) if mills else None, positions="programmed")
    program, findings = gcode_reader.scan(text)
    assert findings == []
    again = program.tape()
    if mills:
        # (a re-positioning of no length is none there: what lies before and behind it is one route)
        cuts = [vertices([route for route in routes if not route.is_move]) for routes in (program.routes(), laid(tape))]
        in_a_row = [[one for one, _ in groupby(place for route in routes for place in route)] for routes in cuts]
        assert in_a_row[0] == in_a_row[1]
        return
    # (an arc of 1 µm whose end gave one, so that the route closes, may end at its centre: a line)
    ends_inside = any(
        not placed.is_line and placed.centre in (placed.start, placed.end)
        for route in laid(tape)
        for placed in route.blocks
    )
    if not ends_inside and not any(map(is_changed, tape.blocks)):
        assert tapes.to_bytes(again.items) == tapes.to_bytes(items)
    assert len(again.stops) == len(tape.stops)
    assert vertices(laid(again)) == vertices(laid(tape))


@pytest.mark.parametrize("path", sorted((ROOT / "examples").glob("*.3b"))[::6], ids=lambda path: path.stem)
def test_examples_there_and_back(path: Path, run: Run, tmp_path: Path) -> None:
    tape = tapes.read(str(path))
    iso = tmp_path / "part.nc"
    assert run("gcode", path, "--feed", "60", "--positions", "programmed", "-o", iso).exit_code == 0
    assert each_says(
        run("check", iso).output,
        (f"{iso}: ", Phrase("nothing-wrong"), Phrase("count-lines", count=len(iso.read_text().splitlines()))),
    )
    assert vertices(laid(gcode_reader.read(iso.read_text()).tape())) == vertices(laid(tape))


def test_absolute_and_modal() -> None:
    text = """%
    N1 G90 G92 X10. Y0 (start hole)
    N2 G1 X12.0005 F3.5 ; half a micrometre rounds away from zero
    Y5.
    G2 X14.0005 I1. J0
    M0
    X14.0005 I-1.
    M30
    """
    assert back(text).decode().split() == [
        "B2001B0B2001GXL1", "B0B5000B5000GYL2", "B1000B0B2000GYSR2", "D", "B1000B0B4000GYSR4", "DD"]  # fmt: skip


@pytest.mark.parametrize(("text", "wanted"), [
    # Units: G21 makes whole numbers millimetres, G20 inches; without them the point decides.
    ("G21 G90\nG1 X10 F5\nM2", "B10000B0B10000GXL1 DD"),
    ("G20 G90\nG1 X1 F5\nM2", "B25400B0B25400GXL1 DD"),
    ("G90\nG1 X10 F5\nM2", "B10B0B10GXL1 DD"),
    ("G90\nG1 X10. F5\nM2", "B10000B0B10000GXL1 DD"),
    # Rapids: the first one is where it begins; the others move between two stops, one after another together.
    ("G21 G90\nG0 Z5\nX5 Y5\nG1 X6 F5\nG0 X7\nG0 X8 Y6\nG1 X9\nM2",
     "B1000B0B1000GXL1 D B2000B1000B2000GXL1 D B1000B0B1000GXL1 DD"),
    ("G21 G90\nG1 X6 F5\nM0\nG0 X7\nM0\nG1 X9\nM2", "B6000B0B6000GXL1 D B1000B0B1000GXL1 D B2000B0B2000GXL1 DD"),
    ("G21 G90\nG1 X6 F5\nG0 X7\nG0 X6\nG1 X9\nM2", "B6000B0B6000GXL1 D D B3000B0B3000GXL1 DD"),
    # Holes have no blocks; heights no path.
    ("G21 G90\nG0 X1 Y1 Z5\nG1 Z-1 F5\nG0 Z5\nX2\nG1 Z-1\nX3\nG0 Z5\nM2", "D B1000B0B1000GXL1 D B1000B0B1000GXL1 DD"),
    # Arcs by their radius: the short way; below 0 the long one; half a turn, a micrometre short.
    ("G21 G90\nG3 X5 Y5 R5 F5\nG2 X10 Y0 R-5\nM2", "B0B5000B5000GYNR4 B5000B0B15000GXSR2 DD"),
    ("G21 G90\nG2 X10 Y0 R4.999 F5\nM2", "B5000B0B10000GYSR2 DD"),
    # G80 leaves the line's other word alone.
    ("G21 G90 G1 G80\nX10 F5\nG80 G0\nX5\nG1 X0\nM2", "B10000B0B10000GXL1 D B5000B0B5000GXL3 D B5000B0B5000GXL3 DD"),
    # Some with a point, some without: millimetres, whatever comes first; a 0 is neither.
    ("G90\nG1 X10 F5\nY.5\nM2", "B10000B0B10000GXL1 B0B500B500GYL2 DD"),
    ("G90\nG1 X10 Y0.0 F5\nX10.5 Y0\nM2", "B10000B0B10000GXL1 B500B0B500GXL1 DD"),
    ("G90\nG1 X1000 F5\nG21\nX1.5\nM2", "B1000B0B1000GXL1 B500B0B500GXL1 DD"),
    # Drilling cycles have no blocks, as holes have none; what comes behind goes on from there.
    ("G21 G90\nG0 X1 Y1 Z5\nG99 G81 X2 Y1 Z-1 R2 F5\nX3\nG98 Y2\nG80\nG1 X4\nM2",
     "D B1000B1000B1000GYL1 D B1000B0B1000GXL1 DD"),
    ("G21\nG83 X1 Z-3 R1 Q.5 F5\nG0 X2\nG1 X3\nM2", "D B1000B0B1000GXL1 D B1000B0B1000GXL1 DD"),
    # The words behind an M word of a printer's board are its own; the rest of a line to be shown is no word at all.
    ("G21 G90\nM205 X8 Y8 E5\nM92 X80\nM204 P500 R1000 T5\nM117 Hello X5\nG1 X1 F5\nM201 X9 G1 X2\nX3 M220\nM2",
     "B1000B0B1000GXL1 B1000B0B1000GXL1 B1000B0B1000GXL1 DD"),
    # What says nothing of the path.
    ("%\nO0001 (PLATE)\n:17\nN1 G21 G90 G61\nG64 P.01 Q.02\n$X\n$H\n$$ (settings)\n?\nG0 X1 Y0 A0 B0.\nG1 X2 F5\n"
     "G1 G53 Z5\nM2\n%", "B1000B0B1000GXL1 DD"),
    ("(part 7; lower side)\nO1000\nG21 G90 G54 G64 P0.01\nT2 M6\nS1200 M3\nG43 H2\nG4 P1\nG1 X10 F5\nM9\nM2",
     "B10000B0B10000GXL1 DD"),
])  # fmt: skip
def test_what_is_read(text: str, wanted: str) -> None:
    assert back(text).decode().split() == wanted.split()


@pytest.mark.parametrize(("text", "tape", "said"), [
    ("G21\nG1 X10 F5\nX10 Y5\nM2", "B10000B0B10000GXL1 B0B5000B5000GYL2 DD",
     [Finding("gcode-absolute").within(Phrase("at-column", line=2, column=4))]),
    ("G90\nG1 X10 F5\nM2", "B10B0B10GXL1 DD",
     [Finding("gcode-units-by-point").within(Phrase("at-column", line=2, column=4))]),
    ("G90 (für 5 µm – oder 6)\nG1 X10 Y1.5 F5\nM2", "B10000B1500B10000GXL1 DD",
     [Finding("gcode-units-mm").within(Phrase("at-column", line=2, column=4))]),
    ("G21 G90\nG0 X10\nX20\nM2", "DD", [Finding("gcode-rapids-only")]),
    ("G21 G90\nG1 X10 F5", "B10000B0B10000GXL1 DD",
     [Finding("gcode-no-end", more=None, nothing=None).within(Phrase("at-column", line=3, column=1))]),
    ("G21 G90\nG1 X10 F5\nM2", "B10000B0B10000GXL1 DD", []),
])  # fmt: skip
def test_what_is_guessed_is_said(run_program: Run, text: str, tape: str, said: list[Finding]) -> None:
    result = run_program("gcode", "--back", stdin=text)
    assert (result.returncode, result.stdout.split()) == (0, tape.split())
    assert result.stderr.splitlines() == [f"skg: -: {finding}" for finding in said]


OFF = Phrase("one-or-other", first="M5", other="S0")
#: What of G1 to G3 is no cut: the tape, and what is said.
IDLE = {
    # Lasers: S0 and M5 between cuts; S counts in its line, and stays; a dwell's and a fan's S is not the beam's.
    "M4 S0\nG0 X1\nG1 X2 S500 F100\nX3 S0\nX4 S300\nM5\nG1 X0\nM2":
        ("B1000B0B1000GXL1 D B1000B0B1000GXL1 D B1000B0B1000GXL1 D B4000B0B4000GXL3 DD", "2 of 4", OFF),
    "S9 M3\nG1 X1 F100\nG4 S0\nM106 S0\nX2\nM5 X3\nM4 X4\nM2":
        ("B1000B0B1000GXL1 B1000B0B1000GXL1 D B1000B0B1000GXL1 D B1000B0B1000GXL1 DD", "1 of 4", OFF),
    "G1 X1 F100\nM3\nX2\nG2 X4 I1 S0\nG1 X5 S1\nM2":
        ("B1000B0B1000GXL1 D B2000B0B2000GXL1 D B1000B0B1000GXL1 DD", "2 of 4", OFF),
    "M106 S255\nG1 X1 F100\nM107\nX2\nM106\nX3\nM106 S0\nX4\nM2":
        ("B1000B0B1000GXL1 D B1000B0B1000GXL1 D B1000B0B1000GXL1 D B1000B0B1000GXL1 DD", "2 of 4",
         Phrase("one-or-other", first="M107", other="S0")),
    "M3\nM42 P6 S0\nG1 X1 F100\nM42 P6 S9\nX2\nM2": ("B1000B0B1000GXL1 B1000B0B1000GXL1 DD", "", ""),
    "M42 P6 S0\nG1 X1 F100\nM42 P6 S9\nX2\nM2": ("B1000B0B1000GXL1 DD", "1 of 2", "M42 S0"),
    # A fan beside a spindle is a fan; a spindle that nothing turns on, or that nobody has cut without, is none.
    "M3\nM107\nG1 X1 F100\nM106\nX2\nM2": ("B1000B0B1000GXL1 B1000B0B1000GXL1 DD", "", ""),
    "M5\nG1 X1 F100\nM107\nX2\nM2": ("B1000B0B1000GXL1 B1000B0B1000GXL1 DD", "", ""),
    "M62 P0\nG1 X1 F100\nM63 P0\nX2\nM64 P0\nX3\nM65 P0\nM2":
        ("B1000B0B1000GXL1 D B1000B0B1000GXL1 D B1000B0B1000GXL1 DD", "1 of 3",
         Phrase("one-or-other", first="M63", other="M65")),
    "M61 S9\nG1 X1 F100\nM62\nX2\nM2": ("B1000B0B1000GXL1 B1000B0B1000GXL1 DD", "", ""),
    # Pens and cutters: G1 where the rapids are; a way up cuts; up and down without any rapid.
    "G0 X1 Z5\nG1 Z0 F100\nX2\nX3 Z5\nX4\nZ0\nX5\nM2":
        ("B1000B0B1000GXL1 B1000B0B1000GXL1 D B1000B0B1000GXL1 D B1000B0B1000GXL1 DD", "1 of 4", "up, Z5"),
    "G1 Z5 F100\nX1\nZ0\nX2\nZ5\nX3\nZ0\nX4\nM2":
        ("B1000B0B1000GXL1 D B1000B0B1000GXL1 D B1000B0B1000GXL1 DD", "2 of 4", "up, Z5"),
    # Not so: passes, deeper and deeper; a laser's, whose rapids are where it cuts; a pocket with rapids in it.
    "G1 Z3 F100\nX1\nZ0\nX0\nM2": ("B1000B0B1000GXL1 B1000B0B1000GXL3 DD", "", ""),
    "G1 Z-1 F100\nX1\nZ-2\nX0\nZ-1\nX1\nM2": ("B1000B0B1000GXL1 B1000B0B1000GXL3 B1000B0B1000GXL1 DD", "", ""),
    "G0 Z0\nX1\nG1 X2 F100\nG0 Z-1\nX1\nG1 X2\nM2":
        ("B1000B0B1000GXL1 D B1000B0B1000GXL3 D B1000B0B1000GXL1 DD", "", ""),
    "G0 Z5\nX1\nG1 Z-1 F100\nX2\nZ-2\nX1\nG0 Z-1\nX3\nG1 Z-3\nX4\nG0 Z5\nG1 X5\nM2":
        ("B1000B0B1000GXL1 B1000B0B1000GXL3 D B2000B0B2000GXL1 D B1000B0B1000GXL1 B1000B0B1000GXL1 DD", "", ""),
}  # fmt: skip


@pytest.mark.parametrize("text", IDLE)
def test_what_does_not_cut(text: str) -> None:
    tape, counted, why = IDLE[text]
    program = gcode_reader.read(f"G21 G90\n{text}")
    assert tapes.to_bytes(program.tape().items).decode().split() == tape.split()
    assert len(program.notes) == bool(counted)
    for note in program.notes:
        assert note.code == "moves-idle" and f"{note['idle']} of {note['moves']}" == counted
        (value,) = dict(note["why"].values).values()
        assert text_of(Phrase("plain", text=value)) == str(why).removeprefix("up, ")


def test_a_beam_that_is_never_on_is_none() -> None:
    """Spindles that are turned on by hand, and posts that write S0 for them: cuts all the same, and said."""
    program = gcode_reader.read("G21 G90\nS0 M3\nG1 X1 F5\nX2\nM2")
    assert tapes.to_bytes(program.tape().items).decode().split() == ["B1000B0B1000GXL1"] * 2 + ["DD"]
    (guess,) = program.guesses
    assert guess.code == "gcode-beam-always-off" and guess.source == (Phrase("at-column", line=2, column=1),)


def test_what_does_not_cut_in_pictures(run: Run, tmp_path: Path) -> None:
    """Dashed in a picture, on the layer MOVES of a drawing, arcs too; check says it, and finds nothing wrong."""
    tape, picture, drawing = (tmp_path / name for name in ("part.nc", "part.svg", "part.dxf"))
    tape.write_text("G21 G90\nM4 S0\nG0 X1\nG1 X9 S5 F60\nG3 X9 Y4 J2 S0\nG1 X1 S5\nM5\nG1 X0 Y0\nM2\n")
    off = Phrase("beam-is-off", beam=OFF)
    note = f"skg: {tape}: {Finding('moves-idle', idle=2, moves=4, why=off)}\n"
    made = run("plot", tape, "-o", picture)
    assert (made.exit_code, made.stderr) == (0, note)
    assert picture.read_text().count("stroke-dasharray") >= 1
    assert run("dxf", tape, "-o", drawing).stderr == note
    entities = re.findall(r"^  0\n(LINE|ARC)\n(?:.*\n)*?  8\n(\w+)\n", drawing.read_text(), re.M)
    assert sorted(entities) == [("ARC", "MOVES"), ("LINE", "MOVES"), ("LINE", "WIRE"), ("LINE", "WIRE")]
    checked = run("check", tape)
    assert checked.exit_code == 0 and each_says(
        checked.stdout, (f"{tape}: ", Phrase("nothing-wrong"), Phrase("count-lines", count=9))
    )
    assert checked.stderr == note


@pytest.mark.parametrize(("text", "wanted"), [
    # As CAM packages begin and end: Z home in the beginning, all of it in the end.
    ("G28 G91 Z0\nG90\nG0 X1 Y1\nG0 Z5\nG1 Z-1 F5\nX2\nG0 Z5\nG28 G91 Z0\nG28\nM30", "B1000B0B1000GXL1 DD"),
    ("G53 G0 Z0\nG0 X1 Y1 Z5\nG1 Z-1 F5\nX2\nG53 G0 Z0\nG53 G0 X0 Y0\nM30", "B1000B0B1000GXL1 DD"),
    # From a place of the machine's own a rapid goes on; or it is named, before anything is cut.
    ("G28\nG92 X1 Y1\nG1 X2 F5\nM2", "B1000B0B1000GXL1 DD"),
    ("G1 X1 F5\nG28 X0 Y0\nG0 X3 Y0\nG1 X4\nM2", "B1000B0B1000GXL1 D B2000B0B2000GXL1 D B1000B0B1000GXL1 DD"),
])  # fmt: skip
def test_home(text: str, wanted: str) -> None:
    assert back(f"G21 G90\n{text}").decode().split() == wanted.split()


def test_a_place_is_named_anew() -> None:
    """G92 in mid-program moves no tool: what is drawn goes on from where it was; a word left out keeps its place."""
    program = gcode_reader.read("G21 G90 F5\nG1 X10\nY10\nG92 X0 Y0\nX5\nG92 X0\nX-1 Y1\nG91\nX1\nG90\nX0 Y0\nM2")
    wanted = [(10, 0), (10, 10), (15, 10), (14, 11), (15, 11), (15, 10)]
    assert [placed.end for placed in program.path.laid()] == [(1000 * x, 1000 * y) for x, y in wanted]


def test_holes_and_stops() -> None:
    program = gcode_reader.read(
        "G21 G90 G0 Z5\nX1 Y1\nG1 Z-1 F5\nG0 Z5\nX2\nG1 Z-1\nG1 X3\nG0 Z5\nX4\nG1 Z-1\nG0 Z5\nM0\nM2"
    )
    assert program.holes == [(1000, 1000), (4000, 1000)]
    assert program.stop_places == [(4000, 1000)]
    assert program.home == (1000, 1000)
    assert [(route.is_move, len(route.blocks)) for route in program.routes()] == [(True, 1), (False, 1), (True, 1)]


@pytest.mark.parametrize(("text", "facts"), [
    ("G91\nG01 X5 Y?\nM02", ["gcode-no-word", 2, 8, "'Y'"]),
    ("G05\nM02", ["gcode-word", 1, 1, "G5"]),
    ("G21 G90\nG3 X1 I.5 K0 F5\nM2", ["gcode-k", 2, 11]),
    ("G21 G90 G18\nG3 X1 Z1 I1 K0 F5\nM2", ["gcode-upright", 2, 4, "G18"]),
    ("G21 G90 G0 Z0\nG19 G2 Y1 R1 F5\nM2", ["gcode-upright", 2, 8, "G19"]),
    ("G17 G18\nM2", ["gcode-both", 1, 5, "G17", "G18"]),
    ("G21 G91\nG81 X1 Z-1 R1 L3\nM2", ["cycle-relative", 2, 5]),
    ("G21 G90\nG81 X1 Z2 R1 F5\nM2", ["cycle-upside-down", 2, 5]),
    ("G21 G90\nG1 G81 X1 Z-1 R1\nM2", ["gcode-both", 2, 4, "G1", "G81"]),
    ("G21 G90\nG81 X1 Z-1\nM2", ["cycle-incomplete", 2, 5]),
    ("G21 G90\nG81 X1 Z-1 R1 F5\nG80\nX2\nM2", ["gcode-no-motion", 4, 1]),
    ("G21 G90\nG81 X1 Z-1 R1 K2\nM2", ["cycle-letter", 2, 15, "K"]),
    ("G21 G90\nG81 X1 Z-1 R1 K2 J1 I1\nM2", ["cycle-letter", 2, 15, "K"]),
    ("G21 G90\nG0 A5\nM2", ["gcode-letter", 2, 4, "A"]),
    ("$J=X5\nM2", ["gcode-no-word", 1, 1, "'$'"]),
    ("G21 G90\nG0 X1\nG0 X2", ["gcode-no-end", 4, 1, None, "rapids-only-too"]),
    ("G54\nG55\nM02", ["gcode-offset", 2, 1, "G55", "G54"]),
    ("G1 X1 X2\nM02", ["gcode-twice", 1, 7, "X"]),
    ("G1 X1 A2\nM02", ["gcode-letter", 1, 7, "A"]),
    ("M98 P5", ["gcode-call", 1, 1, "M98"]),
    ("M02\nG1", ["gcode-after-end", 2, 1]),
    ("G91\nG3 X5 Y5\nM02", ["gcode-no-centre", 2, 4]),
    ("G91\nG3 X5 Y60 I100\nM02", ["gcode-off-circle", 2, 4, 12.361]),
    ("G21 G91\nG3 X5 R2.4\nM02", ["gcode-radius-short", 2, 4, 5.0]),
    ("G21 G91\nG3 R2.4\nM02", ["gcode-radius-of-circle", 2, 4]),
    ("G21 G91\nG3 X1 I2 R2\nM02", ["gcode-centre-and-radius", 2, 4]),
    ("G21 G91\nG1 X1 R2\nM02", ["gcode-centre-of-line", 2, 4]),
    ("G21 G91\nG3 X.005 Y.005 I.1\nM02", ["arc-off-circle", 1, 4.869]),
    ("G91\nG1 X5 Y5 I100\nM02", ["gcode-centre-of-line", 2, 4]),
    ("G21 G91 G1 X123456.789\nM02", ["number-too-long", 1, "B123456789B0B123456789GXL1", 8]),
    ("G21 G90\nG1 X99999999999999999999999999999999 F5\nM02", ["gcode-digits", 2, 4, "X", 8]),
    ("G1 Xµ", ["gcode-no-word", 1, 4, "'X'"]),
    ("G21 G90\nG1 X1 F5\nG4 X2\nM2", ["gcode-dwell", 3, 4, "X"]),
    ("G21 G90\nG28 X0 Y0\nG1 X1 Y1 F5\nM2", ["gcode-away", 3, 4]),
    ("G21 G90\nG30\nG0 X1\nM2", ["gcode-away", 3, 4]),
    ("G21 G90 G1 X1 F5\nG28\nG92 X0 Y0\nM2", ["gcode-origin-away", 3, 5]),
    ("G21 G90 G1 F5\nG53 X1\nM2", ["gcode-machine-cuts", 2, 5]),
    ("M3 M5\nM2", ["gcode-both", 1, 4, "M3", "M5"]),
    ("G21 G90\nG0 G1 X1\nM2", ["gcode-both", 2, 4, "G0", "G1"]),
    ("G21 G90 G91\nM2", ["gcode-both", 1, 9, "G90", "G91"]),
    ("G21 G90\nG0 X1\nG80\nX2\nM2", ["gcode-no-motion", 4, 1]),
])  # fmt: skip
def test_bad_programs(text: str, facts: list[object]) -> None:
    with pytest.raises(UserError) as error:
        tapes.to_bytes(gcode_reader.read(text).tape().items)
    assert facts_of(error.value.finding) == facts


def test_a_bad_program_is_one_line(run_program: Run) -> None:
    result = run_program("gcode", "--back", stdin="G05\nM02")
    assert result.returncode == 2 and each_says(
        result.stderr, ("skg: -: ", Phrase("at-column", line=1, column=1), Phrase("gcode-word", word="G5"))
    )


@pytest.mark.parametrize(("options", "facts"), [
    (["--feed", "0"], (Phrase("feed-too-small", feed=0),)),
    (["--feed", "x"], ("--feed", "'x'")),
    (["--feed", "1", "--z", "1,0"], (Phrase("z-too-low", high=0, low=1),)),
    (["--z", "1,2,3"], ("--z", "'1,2,3'")),
])  # fmt: skip
def test_bad_options(run_program: Run, cad_tape: Path, options: list[str], facts: tuple[str, ...]) -> None:
    result = run_program("gcode", cad_tape, "--positions", "programmed", *options)
    assert (result.returncode, result.stdout) == (2, "")
    assert result.stderr.startswith("skg: ") and says(result.stderr, *facts)


def _more(values: dict) -> str:
    """The code of what an end that is missing leaves on."""
    return f" {values['more']['code']}" if values.get("more") else ""


@pytest.mark.parametrize(("text", "findings"), [
    (OURS, []),
    (OURS.replace("F60", ""), ["3:5 gcode-feed-missing"]),
    (OURS.replace("F60", "F0"), ["3:15 gcode-no-feed", "3:5 gcode-feed-missing"]),
    (OURS.replace("G21", ""), ["2:5 gcode-units-mm"]),
    (f"%\n{OURS}%\n", ["1:1 gcode-not-grbl", "10:1 gcode-not-grbl"]),
    (OURS.replace("N8", f"(x{'x' * 70})"), ["8:71 gcode-long-line"]),
    (OURS.replace("N8M30\n", ""), ["8:1 gcode-no-end"]),
    (OURS.replace("N8M30\n", "").replace("N2", "M3"), ["8:1 gcode-no-end still-on"]),
    (f"$32 = 1\n{OURS}M5\n", ["1:1 gcode-grbl-only"]),
    ("G21G90\nG1X9000Y0F5\nG3X9000Y0.001I-9000J0\nM2",
     ["3:3 gcode-flat"]),
    ("G21G90\nG1X?F5\nG7\nM2", ["2:3 gcode-no-word", "3:1 gcode-word"]),
])  # fmt: skip
def test_check(run: Run, tmp_path: Path, text: str, findings: list[str]) -> None:
    tape = tmp_path / "part.ngc"
    tape.write_text(text)
    result = run("check", tape)
    assert result.exit_code == (1 if findings else 0)
    assert len(result.output.splitlines()) == max(1, len(findings))
    assert all(line.startswith(f"{tape}: ") for line in result.output.splitlines())
    as_json = json.loads(run("check", "--json", tape).output)
    found = [f"{one['line']}:{one['column']} {one['code']}" + _more(one["values"]) for one in as_json]
    assert found == findings
    assert [one["message"] in line for one, line in zip(as_json, result.output.splitlines(), strict=False)] == [
        True
    ] * len(findings)


def test_plot_sim_and_dxf(run: Run, tmp_path: Path) -> None:
    """A milling tape in the other tools: the picture has its holes, the simulator and the drawing its path."""
    tape, picture, drawing = (tmp_path / name for name in ("part.nc", "part.svg", "part.dxf"))
    program = "10 F 60\n20 Z -1\n30 HOLE (1,1),(9,9)\n40 FROM (20,5)\n50 CUT (5,5):8\n60 BACK\n70 M 0\n"
    tape.write_bytes(mill.run(program).tape)
    assert run("plot", tape, "-o", picture).exit_code == 0
    svg = picture.read_text()
    assert [svg.count(f'id="tape-1-{name}-{n}"') for name in ("hole", "stop") for n in (1, 2)] == [1, 1, 1, 0]
    assert svg.count('-start"') == 1
    report = json.loads(run("sim", "--json", "--blocks", tape).output)[0]
    assert (report["blocks"], report["stops"]) == (4, 3)
    assert run("dxf", tape, "-o", drawing).exit_code == 0
    circles = [line for line in drawing.read_text().splitlines() if line == "CIRCLE"]
    assert len(circles) == 1
    with pytest.raises(UserError, match=pattern(Phrase("no-nominal-contour"))):
        run("plot", tape, "-o", picture, "--show-offset")


@pytest.mark.parametrize("cycle", ["G81 R2 Z-1 X5", "G81 Z-1 R2 X5"])
def test_the_first_number_without_a_unit_is_named(cycle: str) -> None:
    """Of R and Z of a drilling cycle it is the one that stands first, in every run."""
    _, findings = gcode_reader.scan(f"G90\n{cycle}\nM2")
    assert (findings[0].line, findings[0].column) == (2, 5) and says(
        findings[0].finding, Phrase("gcode-units-by-point")
    )


@pytest.mark.parametrize(("up", "down", "said"), [
    ("M300 S50", "M300 S30", "S50 and S30 of M300"),
    ("M280 P0 S0", "M280 P0 S90", "S0 and S90 of M280"),
    ("M3 S90", "M3 S20", "S90 and S20 of M3"),
    ("G0 Z5", "G1 Z-1", ""),
    ("M3 S90", "M3 S90", ""),
])  # fmt: skip
def test_a_pen_of_which_nobody_knows_when_it_is_up(up: str, down: str, said: str) -> None:
    text = "G21 G90 F5\n" + "".join(f"{up}\nG1 X{n}\n{down}\nG1 Y{n}\n" for n in range(1, 5)) + "M5\nM2"
    notes = gcode_reader.read(text).notes
    told = [f"{note['first']} and {note['second']} of {note['word']}" for note in notes if note.code == "pen-unknown"]
    assert told == [said] * bool(said)


@pytest.mark.parametrize("text", [
    "M3 S9\nM62 P0\nG1 X1 F100\nM63 P0\nX2\nM5",
    "M64 P1\nM62 P0\nG1 X1 F100\nM63 P0\nM65 P1\nX2",
])  # fmt: skip
def test_an_output_of_which_nobody_knows_what_it_is(text: str) -> None:
    """Beside a spindle, or beside other outputs, it may be a coolant as well."""
    program = gcode_reader.read(f"G21 G90\n{text}\nM2")
    assert tapes.to_bytes(program.tape().items).decode().split() == ["B1000B0B1000GXL1"] * 2 + ["DD"]
    assert program.notes == (Finding("outputs-unknown", lit=1, moves=2),)


def test_a_line_takes_little_room() -> None:
    """A million lines, each a `Placed` with its `Block`, took more than a gigabyte."""
    text = "G21 G90 F5\n" + "G1 X1\nG3 X0 I-.5\nG0 X0 Y0\n" * 4000 + "M2"
    tracemalloc.start()
    program = gcode_reader.read(text)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert len(program.path.moves) == 8000 and peak < 150 * 8000 + 4 * len(text)
    assert len(program.tape().blocks) == 8000 and not program.tape().stops


@given(st.text(alphabet="GXYZIJMNF0123 .-\n()%", max_size=60))
def test_any_text(text: str) -> None:
    program, findings = gcode_reader.scan(text + "\nM02")
    assert all(hypot(*placed.end) < float("inf") for placed in program.path.laid())
    try:
        assert back(text + "\nM02").endswith(b"DD\r\n")
    except UserError:
        return
    assert all(not finding.is_fatal for finding in findings)


@pytest.mark.parametrize(("arc", "length"), [
    ("G3X16.522Y28.3337I0.4391J0.7856", 0),
    ("G2X16.522Y28.3337I0.4391J0.7856", 3600),
    ("G2X16.5217Y28.3339I-0.4391J-0.7856", 0),
    ("G3X16.5215Y28.334I0.4391J0.7856", 3600),
    ("G3X16.522Y28.3337R0.9", 0),
])  # fmt: skip
def test_an_arc_shorter_than_a_micrometre_is_no_circle(arc: str, length: int) -> None:
    """Its ends are one place when rounded; a control goes the short way, or almost all round."""
    tape = gcode_reader.read(f"G21G90F100\nG0X15.8Y28.8\nG1X16.5215Y28.334\n{arc}\nG1X20Y27\nM2\n").tape()
    assert [block.j for block in tape.blocks if not block.is_line] == ([length] if length else [])
    assert sum(block.is_line for block in tape.blocks) == 2
