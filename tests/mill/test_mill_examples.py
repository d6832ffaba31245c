"""The parts in examples/mill/: their tapes are the reference's, their pictures those of `skg plot`; run as a program,
this writes both anew.
"""

from __future__ import annotations

import sys
from pathlib import Path

import ezdxf
import pytest
from click.testing import CliRunner
from facthelp import each_says, says

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parent))

from isohelp import moves
from rs274help import moves as their_moves
from rs274help import needs_rs274, same

from skg.cli import cli
from skg.errors import UserError
from skg.ref import mill
from skg.sources.milling import is_milling

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "examples" / "mill"
EXAMPLES = sorted(FOLDER.glob("*.skg"))

examples = pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)


def plotted(tape: Path, picture: Path) -> None:
    """Draw a tape; its name is the title."""
    done = CliRunner().invoke(cli, ["plot", str(tape), "-o", str(picture), "--title", tape.name, "--no-arrows"])
    assert done.exit_code == 0, done.output


def test_there_are_enough() -> None:
    assert len(EXAMPLES) >= 8
    text = "".join(path.read_text() for path in EXAMPLES)
    for word in ("F ", "Z ", "M 3", "M 5", "G 4", "HOLE", "RECUT", "REP", "FIT", "SYM", "GOSUB"):
        assert f" {word}" in text, word


@examples
def test_tape_is_the_committed_one(path: Path) -> None:
    source = path.read_text()
    assert source.startswith("10 REM ")
    assert len(source.splitlines()) <= 40
    result = mill.run(source)
    assert (result.error, result.paper) == (None, "")
    assert result.tape == path.with_suffix(".nc").read_bytes()
    moves(result.tape)


@examples
def test_is_well_conditioned(path: Path) -> None:
    """No example hangs on less than a nanometre nor on another close call: the firmware's floats will do."""
    source = path.read_text()
    assert [call for call in mill.run(source).near if call.margin < 1e-3] == []
    assert mill.run(source, bits=33).tape == path.with_suffix(".nc").read_bytes()


@examples
def test_check_and_plot(path: Path, tmp_path: Path) -> None:
    tape, picture = path.with_suffix(".nc"), tmp_path / "picture.svg"
    done = CliRunner().invoke(cli, ["check", str(tape)])
    assert done.exit_code == 0 and each_says(done.output, (tape, f"{len(tape.read_text().splitlines())} lines"))
    plotted(tape, picture)
    assert picture.read_text() == path.with_suffix(".svg").read_text()


def invoked(*words: object) -> tuple[str, str]:
    """A command that ends well: its output, and what it says."""
    done = CliRunner(mix_stderr=False).invoke(cli, list(map(str, words)))
    assert done.exit_code == 0, done.stderr or done.exception
    return done.stdout, done.stderr


@pytest.mark.parametrize("name", ["panel", "rosette"])
def test_a_program_is_run_by_the_mill_rom_and_its_tape_taken(name: str, tmp_path: Path) -> None:
    """plot, check, dxf, gcode, sim and run of a program do what they do with its tape, and say who made that."""
    program, tape, ours = FOLDER / f"{name}.skg", FOLDER / f"{name}.nc", tmp_path / "ours"
    said = (f"skg: {program}: ", "milling", "ROM")
    for command, form in (("plot", "svg"), ("dxf", "dxf"), ("gcode", "nc"), ("run", "ngc")):
        output = ours.with_suffix(f".{form}")
        _, first = invoked(command, program, "-o", output)
        how, _, rest = first.partition("\n")
        assert says(how, *said), (command, first)
        wanted = tape.read_bytes()
        if command in ("plot", "dxf"):
            _, again = invoked(command, tape, "-o", tmp_path / f"theirs.{form}")
            assert again.replace(str(tape), str(program)) == rest
            wanted = (tmp_path / f"theirs.{form}").read_bytes()
        assert strip(output.read_bytes()) == strip(wanted), command
    for command in ("check", "sim"):
        of_program, of_tape = (invoked(command, given)[0] for given in (program, tape))
        # (`check` lays the cutter beside what a program draws; a tape does not tell that)
        laid = (command, name) == ("check", "panel")
        of_tape = of_tape.replace(str(tape), str(program))
        assert of_program.startswith(of_tape)
        assert each_says(of_program.removeprefix(of_tape), *[(f"{program}: ", "4 contours")] * laid)


def strip(data: bytes) -> bytes:
    """A file, of a drawing what is drawn: the rest says when it was made."""
    return data.partition(b"ENTITIES")[2].partition(b"ENDSEC")[0] or data


def test_what_is_said_of_heights_and_holes(tmp_path: Path) -> None:
    program = FOLDER / "plate.skg"
    name = f"skg: {program}: "
    heights = (name, "Z-2", "Z-4", "Z-6.2", "4 holes", "Z-6.5", "Z5")
    made = (name, "milling", "reference")
    drawing = tmp_path / "plate.dxf"
    words = ("plot", program, "-o", tmp_path / "plate.svg", "--skg80", "reference", "--show-offset")
    assert each_says(invoked(*words)[1], made, heights)
    assert 'id="tape-1-contour"' in (tmp_path / "plate.svg").read_text()
    assert says(invoked("dxf", program, "-o", drawing)[1].splitlines()[-1], "plane", *heights)
    space = ezdxf.readfile(drawing).modelspace()
    holes = [tuple(point.dxf.location)[:2] for point in space.query('POINT[layer=="HOLES"]')]
    assert sorted(holes) == [(10, 10), (10, 40), (70, 10), (70, 40)]
    moved = [(tuple(line.dxf.start)[:2], tuple(line.dxf.end)[:2]) for line in space.query('LINE[layer=="MOVES"]')]
    assert moved[:3] == [((10, 10), (70, 10)), ((70, 10), (70, 40)), ((70, 40), (10, 40))]
    left = invoked("tape", program, "-o", tmp_path / "plate.3b")[1].splitlines()[-1]
    assert says(left, name, "3B", "4 holes", "Z-2", "Z-4", "Z-6.2")
    # A pen plotter's program has no heights; heights that begin with a relative one are from nowhere.
    assert invoked("plot", FOLDER / "gasket.nc", "-o", tmp_path / "gasket.svg")[1] == ""
    part = tmp_path / "part.nc"
    part.write_text("G21\nG91\nG0Z5\nG1Z-6F60\nG1X5\nG0Z6\nM30\n")
    assert invoked("plot", part, "-o", tmp_path / "part.svg")[1] == ""


@pytest.mark.parametrize(
    ("words", "facts"),
    [(["gcode", "--feed", "60"], ["milling", "feed"]), (["dxf", "--start", "1,2"], ["ISO", "--start", "3B"])],
)
def test_what_a_milling_program_has_no_use_for(words: list[str], facts: list[str]) -> None:
    done = CliRunner().invoke(cli, [*words, str(FOLDER / "panel.skg")])
    assert isinstance(done.exception, UserError)
    assert says(done.exception, *facts)


#: A line, and whether it makes the program one for the mill.
BEGINNINGS = {
    "20 f 5": True, "F 5": True, "20Z-1": True, "20 M3": True, "20 G 4": True, "20 H OLE O": True, "20 FORM O": False,
    "20 CUT )": False, "20 GOTO 5": False, "20 REM M3": False, "20 FIT (1,2)": False, "Zürich": False,
}  # fmt: skip


@pytest.mark.parametrize("line", BEGINNINGS)
def test_what_is_a_milling_program(line: str) -> None:
    assert is_milling(f"10 FROM O\n{line}\n30 CUT )\n") == BEGINNINGS[line]


def test_mistakes_in_a_milling_program(tmp_path: Path) -> None:
    """The line is said, as of a program for wire; `skg ref` tells how to run one."""
    part = tmp_path / "part.skg"
    for line, error in (("30 CUT )", "ERR 01 LINE 30"), ("30 A=1/0", "ERR 05 LINE 30")):
        part.write_text(f"10 F 60\n{line}\n")
        done = CliRunner(mix_stderr=False).invoke(cli, ["check", str(part)])
        assert str(done.exception).startswith(f"{part}: {error}")
    done = CliRunner(mix_stderr=False).invoke(cli, ["ref", str(part)])
    assert done.exit_code == 1
    assert says(done.stderr.splitlines()[-1], f"skg: {part}: ", "milling", "--mill")


@needs_rs274
@examples
def test_linuxcnc_takes_it(path: Path, tmp_path: Path) -> None:
    tape = path.with_suffix(".nc").read_bytes()
    same(moves(tape), their_moves(tape, tmp_path))


def main() -> None:
    """Write tapes and pictures anew."""
    for path in EXAMPLES:
        path.with_suffix(".nc").write_bytes(mill.run(path.read_text()).tape)
        plotted(path.with_suffix(".nc"), path.with_suffix(".svg"))


if __name__ == "__main__":
    main()
