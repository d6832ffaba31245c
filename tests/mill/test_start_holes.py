"""The drilling program of `skg cut --holes` in LinuxCNC's interpreter: down to its depth at each hole, and up again."""

from __future__ import annotations

from pathlib import Path

from click.testing import CliRunner
from rs274help import moves, needs_rs274

from skg.cli import cli

pytestmark = needs_rs274

BRACKET = Path(__file__).parents[2] / "docs" / "pictures" / "bracket.dxf"


def test_each_hole_is_drilled(tmp_path: Path) -> None:
    tape, holes = tmp_path / "a.nodrift.3b", tmp_path / "holes.nc"
    words = ["cut", str(BRACKET), "-o", str(tape), "--thickness", "40", "--holes", str(holes)]
    result = CliRunner(mix_stderr=False).invoke(cli, words, catch_exceptions=False)
    assert result.exit_code == 0, result.stderr
    path = moves(holes.read_bytes(), tmp_path)
    down = [move.end for move in path if move.g == 1]
    places = [(12000, 15000), (31000, 16000), (58000, 11000), (35000, -3000)]
    assert down == [(x, y, -42000) for x, y in places]
    # (between them it is above the stock)
    assert all(move.end[2] == 2000 for move in path if move.g == 0)
