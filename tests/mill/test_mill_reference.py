"""The milling reference against tapes written out by hand from milling.md."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
from isohelp import blocks

from skg.ref import Result, mill

ROOT = Path(__file__).parents[2]
SPEC = (ROOT / "docs" / "spec" / "milling.md").read_text()
SKG = Path(sys.executable).with_name("skg")

HEAD = "N1G17G21G90G94"
#: A square of 10 mm from its corner, three sides.
SIDES = ["CUT O,(10,0),(10,10),(0,10)"]
#: Numbers of words that are punched as they stand: neither the tape's own, nor END's, nor moves.
USERS_G = [*range(4, 17), *range(22, 33), *range(34, 38), 39, *range(43, 73), 92, 94, *range(96, 100)]
USERS_M = [n for n in range(100) if n not in (2, 30)]


def program(*statements: str) -> str:
    """Statements, numbered 10, 20, …"""
    return "\n".join(f"{10 * n} {statement}" for n, statement in enumerate(statements, start=1))


def tape(*statements: str, error: tuple[int, int | None] | None = None) -> list[str]:
    """The blocks of a program, without N words and the first block; it ends in `error`."""
    result = mill.run(program(*statements))
    assert result.error == error, result.paper
    return blocks(result.tape)[1:] if result.tape else []


def test_the_tape_of_the_specification() -> None:
    """The tape that milling.md shows is one that a program gives."""
    shown = re.search(r"^ {4}N1G17.*?M30$", SPEC, re.M | re.S)[0]
    wanted = [line.split()[0] for line in shown.splitlines()]
    arc = ["M 3,1200", "Z -2", "F 200,60", "FROM (-10,0)", "C=(-50.1,0.025):50.1", "CUT (0,0.125),C,(-100.2,0)"]
    assert mill.run(program(*arc)).tape.decode().split("\r\n") == [*wanted, ""]


@pytest.mark.parametrize(("statements", "wanted"), [
    # Without Z no height; without FROM the route begins at O; F once.
    (["F 300", *SIDES], ["G0X0Y0", "G1X10Y0F300", "G1X10Y10", "G1X0Y10", "M30"]),
    # FROM is never silent; down with the second feed; up behind BACK.
    (["F 300,40", "Z -1.5", "FROM (-5,0)", "CUT O,(10,0),(0,7)", "BACK"],
     ["G0Z5", "G0X-5Y0", "G1Z-1.5F40", "G1X0Y0F300", "G1X10Y0", "G1X0Y7", "G1X0Y0", "G1X-5Y0", "G0Z5", "M30"]),
    # One feed for both is punched once.
    (["F 300", "Z -1.5", "CUT O,(10,0)"], ["G0Z5", "G0X0Y0", "G1Z-1.5F300", "G1X10Y0", "G0Z5", "M30"]),
    # Deeper and deeper, smaller and smaller R; nothing is punched for Z, R, F themselves.
    (["F 300", "R=-1", "Z -1,3", "FROM (5,5)", "CUT (5,0),(10,0),(10,10),(0,10),(0,0)", "BACK", "Z -2",
      "RECUT", "R=0", "F 99", "Z -2.5", "RECUT"],
     ["G0Z3", "G0X5Y5", "G1Z-1F300", "G1X5Y1", "G1X9Y1", "G1X9Y9", "G1X1Y9", "G1X1Y1", "G1X5Y1", "G1X5Y5", "G0Z3",
      "G1Z-2", "G1X5Y1", "G1X9Y1", "G1X9Y9", "G1X1Y9", "G1X1Y1", "G1X5Y1", "G1X5Y5", "G0Z3",
      "G1Z-2.5F99", "G1X5Y0", "G1X10Y0", "G1X10Y10", "G1X0Y10", "G1X0Y0", "G1X5Y0", "G1X5Y5", "G0Z3", "M30"]),
    # Holes; the next route begins at the last one.
    (["F 300,50", "Z -4,2", "HOLE (1,2),(1,2)*2", "CUT (3,3),(4,4)"],
     ["G0Z2", "G0X1Y2", "G1Z-4F50", "G0Z2", "G0X2Y4", "G1Z-4", "G0Z2",
      "G1Z-4", "G1X3Y3F300", "G1X4Y4", "G0Z2", "M30"]),
    # HOLE between BACK and RECUT, enlarged; Z, F and R are not.
    (["F 300", "Z -1", "SCALE 2", "FROM O", "CUT (1,1):1", "BACK", "HOLE (3,3)", "RECUT"],
     ["G0Z5", "G0X0Y0", "G1Z-1F300", "G1X0.586Y0.586", "G3X0.586Y0.586I1.414J1.414", "G1X0Y0", "G0Z5",
      "G0X6Y6", "G1Z-1", "G0Z5", "G1Z-1", "G1X3.414Y3.414", "G3X3.414Y3.414I-1.414J-1.414", "G1X6Y6", "G0Z5", "M30"]),
    # M and G words; no place is known before the first move, none is forgotten by them.
    (["M 3,1200", "G 4,.5", "M 6,2", "M 6", "M 8", "G 54", "F 20", "CUT O,(1,0)", "M 5"], [(6, 90)]),
    (["M 3,1200", "G 4,.5", "M 6,2", "M 6", "M 8", "G 54", "M 4,0.001", "M 0", "M 99,99999999"],
     ["S1200M3", "G4P0.5", "T2M6", "M6", "M8", "G54", "S0.001M4", "M0", "S99999999M99", "M30"]),
    # All that are nobody's but the user's.
    ([f"G {n}" for n in USERS_G], [*(f"G{n}" for n in USERS_G), "M30"]),
    ([f"M {n}" for n in USERS_M], [*(f"M{n}" for n in USERS_M), "M30"]),
    # F in mid-route: the element that is still open goes out with it, then the next ones.
    (["F 300", "CUT O,(10,0),(10,10)", "F 50", "CUT (0,10)"],
     ["G0X0Y0", "G1X10Y0F300", "G1X10Y10F50", "G1X0Y10", "M30"]),
    # The same feed by another sum is the same.
    (["F 0.3", "CUT O,(10,0),(10,10)", "F 0.1+0.2", "CUT (0,10)"],
     ["G0X0Y0", "G1X10Y0F0.3", "G1X10Y10", "G1X0Y10", "M30"]),
    # Numbers: 8 digits, half away from zero.
    (["F 100/3", "CUT O,(0.1005,-0.0005),(0.1,-0.0102)"],
     ["G0X0Y0", "G1X0.101Y-0.001F33.333333", "G1X0.1Y-0.01", "M30"]),
    # Z comes behind FROM: up first, then down at the feed.
    (["F 9", "FROM (1,1)", "Z -1,4", "CUT (2,2),(3,3)"],
     ["G0X1Y1", "G0Z4", "G1Z-1F9", "G1X2Y2", "G1X3Y3", "G0Z4", "M30"]),
    # Z 0 and a travel height of 0; -0.0004 is 0.
    (["F 9", "Z -0.0004,0", "CUT (2,2),(3,3)"], ["G0Z0", "G0X0Y0", "G1X2Y2F9", "G1X3Y3", "M30"]),
    # An end that is the first element again; the tool stays there.
    (["F 9", "Z -1", "CUT O,(4,0),(0,4),O", "FROM O", "CUT O,(1,0)"],
     ["G0Z5", "G0X0Y0", "G1Z-1F9", "G1X4Y0", "G1X0Y4", "G1X0Y0", "G0Z5", "G1Z-1", "G1X1Y0", "G0Z5", "M30"]),
    # END lifts the tool wherever it is: a Z behind the last route, or nothing but a Z.
    (["F 9", "CUT O,(1,0),(0,1)", "BACK", "Z -1", "END"],
     ["G0X0Y0", "G1X1Y0F9", "G1X0Y1", "G1X0Y0", "G0Z5", "M30"]),
    (["Z -1"], ["G0Z5", "M30"]),
    # Nothing at all.
    ([], ["M30"]),
])  # fmt: skip
def test_blocks(statements: list[str], wanted: list) -> None:
    if isinstance(wanted[0], tuple):
        assert mill.run(program(*statements)).error == wanted[0]
    else:
        assert tape(*statements) == wanted


@pytest.mark.parametrize(("statements", "error", "wanted"), [
    # F
    (["F 0"], 5, []),
    (["F -1"], 5, []),
    (["F 10,0"], 5, []),
    (["F 0.000999"], 5, []),
    (["F 99999999.6"], 5, []),
    (["F O"], 4, []),
    (["F 1,O"], 4, []),
    (["F A"], 3, []),
    (["F 10", "CUT O,(1,0)", "F 0"], 5, ["G0X0Y0", "M0"]),
    (["FROM (1,1)", "CUT O,(1,0),(2,0)"], 3, ["G0X1Y1", "M0"]),
    # (no F: the tool does not move)
    (["Z -1", "FROM (5,5)", "CUT O,(1,0),(2,0)"], 3, ["G0Z5", "G0X5Y5", "M0"]),
    (["Z -1", "CUT O,(1,0),(2,0)"], 3, ["M0"]),
    (["CUT O,(1,0)"], 3, ["M0"]),
    (["R=-2", "CUT O:1"], 7, ["M0"]),
    (["FIT O", "FIT (1,0)", "FIT (2,0)"], 3, ["M0"]),
    (["CUT O", "Z -1"], 6, ["M0"]),
    # Z
    (["Z 5.001"], 5, []),
    (["Z 1,0.999"], 5, []),
    (["Z 100000"], 10, []),
    (["Z 1,100000"], 10, []),
    (["Z O"], 4, []),
    (["FIT O", "Z 1"], 6, ["M0"]),
    (["CUT O", "Z 1,0"], 5, ["M0"]),
    # M, G
    (["M 2"], 5, []),
    (["M 30"], 5, []),
    (["M 29.9999999999"], 5, []),
    (["M -1"], 5, []),
    (["M 100"], 5, []),
    (["M 3.5"], 5, []),
    (["M 3,0"], 5, []),
    (["M 3,-5"], 5, []),
    (["M 3,1E8"], 5, []),
    (["M 6,1.5"], 5, []),
    (["M 6,100"], 5, []),
    (["M O"], 4, []),
    (["M 3,O"], 4, []),
    (["CUT O", "M 2"], 5, ["M0"]),
    (["CUT O", "M 5"], 6, ["M0"]),
    (["G 92.5"], 5, []),
    (["G 4,0"], 5, []),
    (["CUT O", "G 4"], 6, ["M0"]),
    *[([f"G {n}"], 5, []) for n in (0, 1, 2, 3, 17, 18, 19, 20, 21, 40, 41, 42, 90, 91, 93, 95, 100)],
    # Moves that need places: threads, probing, canned cycles.
    *[([f"G {n}"], 5, []) for n in (33, 38, *range(73, 90))],
    (["G 83,1"], 5, []),
    (["CUT O", "G 81"], 5, ["M0"]),
    # HOLE
    (["HOLE O"], 3, []),
    (["Z 0", "HOLE O,O"], 3, []),
    (["F 1", "HOLE O,O"], 3, []),
    (["F 1", "Z 0", "HOLE O,5"], 4, ["G0Z5", "G0X0Y0", "G1Z0F1", "G0Z5"]),
    (["CUT O", "HOLE (1,1)"], 6, ["M0"]),
    (["HOLE 5"], 4, []),
    (["F 1", "Z 0", "HOLE (100000,0)"], 10, []),
    # The tool beyond 100 m, and an error of the wire's in mid-route.
    (["F 1", "FROM (99999.9995,0)"], 10, []),
    (["F 1", "CUT O,(1,0),(1,100000)", "CUT O"], 10, ["G0X0Y0", "G1X1Y0F1", "M0"]),
    (["F 1", "Z 0", "CUT O,(1,0),X:5"], 6, ["G0Z5", "G0X0Y0", "G1Z0F1", "M0"]),
])  # fmt: skip
def test_errors(statements: list[str], error: int, wanted: list[str]) -> None:
    """The error, its line (the last one), and what is on the tape by then."""
    assert tape(*statements, error=(error, 10 * len(statements))) == wanted


@pytest.mark.parametrize(("line", "column"), [
    ("10 F", 4), ("10 F 1,", 7), ("10 F 1,2,3", 8), ("10 Z", 4), ("10 M", 4), ("10 M 3;4", 6), ("10 HOLE", 7),
    ("10 HOLE O;O", 9), ("10 F=5", 4), ("10 PRINT Z", 9), ("10 HOLEO,", 9), ("10 A=F", 5), ("10 GOT 5", 5),
])  # fmt: skip
def test_lines_that_are_not_understood(line: str, column: int) -> None:
    result = mill.run(line)
    assert result.error == (1, 10)
    assert result.paper.split("\n")[1].index("^") == column, result.paper


def test_blanks_and_case_mean_nothing() -> None:
    spaced = mill.run("10 f 2 00 , 60\n20 z-2\n30 h o l e(1,2),O\n40 g4\n50 m 3 , 1")
    assert spaced.tape == mill.run("10 F200,60\n20 Z-2\n30 HOLE (1,2),O\n40 G4\n50 M3,1").tape
    assert blocks(spaced.tape)[-3:] == ["G4", "S1M3", "M30"]


def test_a_line_has_room_for_words_of_one_byte() -> None:
    """HOLE is one byte as CUT is; LIST sets blanks around the new words."""
    for numbers, error in ((35, 4), (36, 9)):
        assert mill.run(f"10 HOLE {','.join(['1'] * numbers)}").error == (error, 10)
    # 10 Z A+A is listed with a blank on both sides of Z: a line that is full as typed is too long as listed.
    for names, error in ((61, 3), (62, 9)):
        line = f"10Z{'+'.join(['A'] * names)}"
        assert len(line) <= 126
        assert mill.run(line).error == (error, 10)


def test_what_wire_cutting_has_is_not_milled_by_it() -> None:
    """The wire's language has none of the words."""
    from skg.ref import run

    for line in ("10 F 1", "10 Z 1", "10 M 3", "10 G 4", "10 HOLE O"):
        assert run(line).error == (1, 10)


def test_direct_statements() -> None:
    """They share the run's tape; RUN begins a new one without F and Z; M30 ends one."""
    result = mill.run("M 3,100\nF 5\nZ -1\nHOLE (1,1)\n10 HOLE (2,2)\n")
    assert result.error == (3, 10)
    assert blocks(result.tape)[1:] == ["S100M3", "G0Z5", "G0X1Y1", "G1Z-1F5", "G0Z5"]
    after = mill.run("F 5\nZ -1\nHOLE (1,1)\nEND\nHOLE (1,1)\nCUT (1,1),(2,2)\nEND")
    again = ["G0Z5", "G0X1Y1", "G1Z-1F5", "G0Z5"]
    head = "G17G21G90G94"
    assert blocks(after.tape) == [
        *[head, *again, "M30"],
        *[head, *again, "G1Z-1", "G1X2Y2", "G0Z5", "M30"],
        *[head, "M30"],
    ]


def test_an_error_leaves_the_tool_where_it_is() -> None:
    """A route begun by direct statements after an error goes up and to the FROM point first."""
    lines = ["F 5", "Z -1", "FROM (1,1)", "CUT (2,1),(3,1),(4,1)", "GOTO 9"]
    result = mill.run("\n".join(lines))
    assert result.error == (2, None)
    cut = ["G0Z5", "G0X1Y1", "G1Z-1F5", "G1X2Y1", "G1X3Y1", "M0"]
    assert blocks(result.tape)[1:] == cut

    # The reference stops at the first error as LOAD does; so its machine is asked itself.
    from skg.ref.mill.interpreter import MillInterpreter
    from skg.ref.mill.iso import IsoPunch
    from skg.ref.near import Watch

    machine = MillInterpreter((), Watch(), IsoPunch())
    assert machine.load("\n".join(lines)) == (2, None)
    assert machine.load("CUT (2,1),(2,9)\nBACK") is None
    assert blocks(machine.tape.bytes())[1:] == [
        *cut, "G0Z5", "G0X1Y1", "G1Z-1", "G1X2Y1", "G1X2Y9", "G1X2Y1", "G1X1Y1", "G0Z5",
    ]  # fmt: skip


def test_numbers_of_blocks() -> None:
    """9999 is followed by 1, without the first block."""
    result = mill.run("10 I=0\n20 M 8\n30 I=I+1\n40 IF I<10005 GOTO 20")
    lines = result.tape.decode().split()
    assert lines[9997:10001] == ["N9998M8", "N9999M8", "N1M8", "N2M8"]
    assert lines[-1] == "N8M30"


def test_two_forms_of_line_ends() -> None:
    source = program("F 300", *SIDES)
    crlf, lf = mill.run(source).tape, mill.run(source, line_end="\n").tape
    assert crlf.count(b"\r\n") == crlf.count(b"\n") == 6
    assert lf == crlf.replace(b"\r", b"")


def arc_tape(*statements: str) -> list[str]:
    return tape("F 60", *statements)[1:-1]


@pytest.mark.parametrize(("statements", "wanted"), [
    # A quarter, both ways; three quarters.
    (["CUT (5,0),O:5,(0,5)"], ["G1X5Y0F60", "G3X0Y5I-5J0"]),
    (["CUT (0,5),O:-5,(5,0)"], ["G1X0Y5F60", "G2X5Y0I0J-5"]),
    (["CUT (0,5),O:5,(5,0)"], ["G1X0Y5F60", "G3X5Y0I0J-5"]),
    # Ends that coincide: a full circle when it is more than half a turn, else nothing.
    (["CUT O:5", "BACK"], ["G1X5Y0F60", "G3X5Y0I-5J0", "G1X0Y0"]),
    (["CUT O:-5", "BACK"], ["G1X5Y0F60", "G2X5Y0I-5J0", "G1X0Y0"]),
    # Flat on a circle of 1 m: d² = 1414² is less than 2,000,000, 1 + 1416² is more.
    (["CUT (1000,0),O:1000,(1000,0.002)"], ["G1X1000Y0F60", "G1X1000Y0.002"]),
    (["CUT (1000,0),O:1000,(1000,1.414)"], ["G1X1000Y0F60", "G1X1000Y1.414"]),
    (["CUT (1000,0),O:1000,(SQR(1000000-1.416*1.416),1.416)"], ["G1X1000Y0F60", "G3X999.999Y1.416I-1000J0"]),
    # The long way round it is not flat.
    (["CUT (1000,0),O:-1000,(1000,1.414)"], ["G1X1000Y0F60", "G2X1000Y1.414I-1000J0"]),
    # A circle so small that its centre is its start is left out; one of a micrometre is not.
    (["FROM (5,5)", "CUT (5,5):.0004", "BACK"], []),
    (["FROM (5,5)", "CUT (5,5):.001", "BACK"], ["G1X5.001Y5F60", "G3X5.001Y5I-0.001J0", "G1X5Y5"]),
    # The long way round, a micrometre or two short of a full circle.
    (["CUT (1000,0.002),O:1000,(1000,0)"], ["G1X1000Y0.002F60", "G3X1000Y0I-1000J-0.002"]),
])  # fmt: skip
def test_arcs(statements: list[str], wanted: list[str]) -> None:
    assert arc_tape(*statements) == wanted


def skg(*arguments: str | Path) -> subprocess.CompletedProcess:
    return subprocess.run([SKG, "ref", *arguments], capture_output=True)


def test_command(tmp_path: Path) -> None:
    part = tmp_path / "part.skg"
    source = program("F 300", *SIDES)
    part.write_text(source)
    assert skg("--mill", part).stdout == mill.run(source).tape
    assert skg("--grbl", part).stdout == mill.run(source, line_end="\n").tape
    assert skg("--mill", "--grbl", part).stdout == mill.run(source, line_end="\n").tape
    assert skg(part).returncode == 1
    wrong = skg("--mill", "--no-drift", part)
    assert (wrong.returncode, wrong.stdout) == (2, b"")
    assert wrong.stderr.startswith(b"skg: --no-drift ") and wrong.stderr.count(b"\n") == 1


def test_results_keep_their_path() -> None:
    """The moves in true coordinates lie end to end, rapids too."""
    result: Result = mill.run(program("F 1", "Z -1", "FROM (1,1)", "CUT (2,2):1", "BACK", "HOLE (9,9)", "RECUT"))
    roles = [segment.role for segment in result.path]
    assert roles == ["reposition", "entry", "cut", "return", "reposition", "entry", "cut", "return"]
    for before, after in zip(result.path, result.path[1:], strict=False):
        assert before.end == after.start
