"""G-code from tapes and back."""

from __future__ import annotations

from pathlib import Path

import pytest
from conftest import CAD_TAPE, Run
from hypothesis import given, settings
from hypothesis import strategies as st
from test_tape import blocks

from skg import tape as tapes
from skg.tape import Block, Stop, Tape, gcode

CAD_GCODE = """\
G91 G92 X115000 Y-10000
G01 X-9900 Y0
G01 X0 Y70100
G01 X-55000 Y0
G03 X-100200 Y0 I-50100 J-100
G01 X-54900 Y0
M02
"""


def test_cad_pair(run: Run, cad_tape: Path, tmp_path: Path) -> None:
    assert run("gcode", cad_tape, "--start", "115000,-10000").output == CAD_GCODE
    back = tmp_path / "back.3b"
    assert run("gcode", "--back", "-", "-o", back, stdin=CAD_GCODE).exit_code == 0
    assert back.read_bytes() == CAD_TAPE


@given(st.lists(st.one_of(blocks(), st.builds(Stop, st.just(0)))), st.booleans(),
       st.tuples(*[st.integers(-10**6, 10**6)] * 2))
@settings(deadline=None)
def test_round_trip(items: list[Block | Stop], millimetres: bool, start: tuple[int, int]) -> None:
    tape = tapes.parse(tapes.to_bytes(items))
    text = gcode.write(tape, start, millimetres)
    assert tapes.to_bytes(gcode.read(text).items) == tapes.to_bytes(items)


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
    assert tapes.to_bytes(gcode.read(text).items).decode().split() == [
        "B2001B0B2001GXL1", "B0B5000B5000GYL2", "B1000B0B2000GYSR2", "D", "B1000B0B4000GYSR4", "DD"]


@pytest.mark.parametrize(("text", "message"), [
    ("G91\nG01 X5 Y?\nM02", "-: line 2, column 8: expected a word such as G01 or X-9900, found 'Y'"),
    ("G05\nM02", "-: line 1, column 1: G5 is not known"),
    ("G1 X1 X2\nM02", "-: line 1, column 7: X stands here twice"),
    ("G1 X1 Z2\nM02", "-: line 1, column 7: Z is not known here"),
    ("M6", "-: line 1, column 1: M6 is not known"),
    ("G1 X5", "-: line 2, column 1: expected M02"),
    ("M02\nG1", "-: line 2, column 1: expected nothing after M02"),
    ("G91\nG3 X5 Y5\nM02", "-: line 2, column 4: an arc needs its centre"),
    ("G91\nG3 X5 Y5 I100\nM02", "-: line 2, column 4: the arc's end is 5 µm off the circle"),
    ("G91\nG1 X5 Y5 I100\nM02", "-: line 2, column 4: I and J belong to G02 and G03"),
    ("G91 G1 X123456789\nM02", "line 1: B123456789B0B123456789GXL1 has a number of more than 8 digits"),
    ("G1 Xµ", "-: byte 5 is not ASCII"),
])
def test_bad_programs(run_program: Run, text: str, message: str) -> None:
    result = run_program("gcode", "--back", stdin=text)
    assert result.returncode == 2
    assert result.stderr.startswith(f"skg: {message}")
    assert result.stderr.count("\n") == 1


@given(st.text(alphabet="GXYIJMN0123 .-\n()%", max_size=60))
def test_any_text(text: str) -> None:
    try:
        items = gcode.read(text + "\nM02").items
    except gcode.UserError:
        return
    assert isinstance(Tape("-", items).blocks, list)
