"""G-code for other machines (`skg gcode --machine`) in LinuxCNC's interpreter: the same moves as without."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner
from rs274help import Move, moves, needs_rs274

from skg.cli import cli

pytestmark = needs_rs274

EXAMPLES = Path(__file__).parents[2] / "examples"


def moves_of(part: str, folder: Path, *options: str) -> list[Move]:
    """The interpreter's moves of a part's G-code."""
    words = ["gcode", str(EXAMPLES / f"{part}.3b"), *options]
    result = CliRunner(mix_stderr=False).invoke(cli, words, catch_exceptions=False)
    assert result.exit_code == 0, result.stderr
    return moves(result.stdout.encode(), folder)


@pytest.mark.parametrize("machine", ["linuxcnc-wire", "plasma"])
@pytest.mark.parametrize("part", ["wrench", "fit-gear", "plate-fillets"])
def test_same_moves(machine: str, part: str, tmp_path: Path) -> None:
    expected = moves_of(part, tmp_path)
    assert len(expected) > 20
    assert moves_of(part, tmp_path, "--machine", machine) == expected
