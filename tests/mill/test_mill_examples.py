"""The parts in examples/mill/: their tapes are the reference's, their pictures those of `skg plot`; run as a program,
this writes both anew.
"""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parent))

from isohelp import moves
from rs274help import moves as their_moves
from rs274help import needs_rs274, same

from skg.cli import cli
from skg.errors import UserError
from skg.ref import mill

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
    assert done.output == f"{tape}: {len(tape.read_text().splitlines())} lines, nothing wrong\n"
    plotted(tape, picture)
    assert picture.read_text() == path.with_suffix(".svg").read_text()


@pytest.mark.parametrize("command", ["plot", "check", "gcode", "dxf", "sim"])
def test_commands_for_wire_say_what_a_milling_program_is(command: str, tmp_path: Path) -> None:
    path = FOLDER / "panel.skg"
    done = CliRunner().invoke(
        cli, [command, str(path), *(["-o", str(tmp_path / "p.svg")] if command == "plot" else [])]
    )
    assert isinstance(done.exception, UserError)
    assert str(done.exception) == (
        f"{path}: line 20 is of a milling program: `skg run --rom mill {path} -o part.nc` makes its tape, "
        "and plot, check and gcode read that"
    )


@pytest.mark.parametrize("line", ["20 f 5", "20Z-1", "20 M3", "20 G 4", "20 HOLE O", "20 FORM O", "20 CUT )"])
def test_only_what_begins_as_one_is_taken_for_a_milling_program(line: str, tmp_path: Path) -> None:
    part = tmp_path / "part.skg"
    part.write_text(f"10 FROM O\n{line}\n")
    done = CliRunner().invoke(cli, ["check", str(part)])
    assert isinstance(done.exception, UserError)
    assert ("line 20 is of a milling program" in str(done.exception)) == (line not in ("20 FORM O", "20 CUT )"))


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
