"""Every part in examples/ through the firmware: the committed tape, byte for byte."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest
from romhelp import EXAMPLES, ROM, ROOT, run


def stem(part: Path) -> str:
    """A part's name, for pytest."""
    return part.stem


def test_there_are_enough_parts() -> None:
    assert len(EXAMPLES) >= 20


@pytest.mark.parametrize("part", EXAMPLES, ids=stem)
def test_tape(part: Path) -> None:
    outcome = run(part.read_text())
    assert outcome.error is None, outcome.paper
    assert outcome.tape == part.with_suffix(".3b").read_bytes()


@pytest.mark.parametrize("name", ["xy-fig1-loop", "cad-tape", "plate-fillets", "skg09-link"])
def test_skg80_punches_the_tape(name: str) -> None:
    part = ROOT / "examples" / f"{name}.skg"
    done = subprocess.run([ROOT / "build" / "skg80", "--rom", ROM, part], capture_output=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout == part.with_suffix(".3b").read_bytes()


def test_skg80_lists_the_blocks_on_the_paper() -> None:
    part = ROOT / "examples" / "xy-fig1-loop.skg"
    done = subprocess.run([ROOT / "build" / "skg80", "--rom", ROM, part], capture_output=True)
    listed = re.findall(r"^(\d{4} B\S+|DD?)\r$", done.stderr.decode(), re.M)
    *blocks, end = part.with_suffix(".3b").read_text().split()
    assert listed == [*(f"{n:04d} {block}" for n, block in enumerate(blocks, start=1)), end]


def test_skg80_says_that_a_run_ended_in_err(tmp_path: Path) -> None:
    part = tmp_path / "wrong.skg"
    part.write_text("10 A=1/0\n")
    done = subprocess.run([ROOT / "build" / "skg80", "--rom", ROM, part], capture_output=True)
    assert (done.returncode, done.stdout) == (1, b"")
    assert "ERR 05 LINE 10" in done.stderr.decode()


def test_skg80_takes_an_empty_file_for_an_empty_program(tmp_path: Path) -> None:
    part = tmp_path / "empty.skg"
    part.write_text("")
    done = subprocess.run([ROOT / "build" / "skg80", "--rom", ROM, part], capture_output=True)
    assert (done.returncode, done.stdout) == (0, b"DD\r\n")
