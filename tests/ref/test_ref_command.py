"""`skg ref` from the shell: streams, files, exit codes."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from facthelp import each_says

SKG = Path(sys.executable).with_name("skg")


def skg(*arguments: str | Path, stdin: bytes = b"") -> subprocess.CompletedProcess:
    return subprocess.run([SKG, "ref", *arguments], input=stdin, capture_output=True)


@pytest.fixture
def part(tmp_path: Path) -> Path:
    path = tmp_path / "part.skg"
    path.write_text('10 INPUT D\n20 PRINT "D is",D\n30 CUT O,(D,0)\n40 CUT (2*D,0),(0,D)\n')
    return path


def test_tape_paper_and_answers(part: Path, tmp_path: Path) -> None:
    answers = tmp_path / "answers"
    answers.write_text("X\n3\n")
    done = skg(part, "--input", answers)
    assert (done.returncode, done.stderr) == (0, b"? X\n? 3\nD is 3\n")
    assert done.stdout == b"B3000B0B3000GXL1\r\n" * 2 + b"B6000B3000B6000GXL2\r\nDD\r\n"
    tape = tmp_path / "tape.3b"
    assert skg(part, "--input", answers, "-o", tape).stdout == b""
    assert tape.read_bytes() == done.stdout


def test_standard_input() -> None:
    done = skg("-", stdin=b"10 CUT O,(1,0)\n")
    assert (done.returncode, done.stdout) == (0, b"B1000B0B1000GXL1\r\nDD\r\n")
    done = skg("-", stdin=b"\xff")
    assert (done.returncode, done.stderr) == (2, b"skg: -: line 1, column 1: byte FFH is not ASCII\n")


def test_error_ends_with_1(part: Path) -> None:
    done = skg(part)
    assert (done.returncode, done.stdout, done.stderr) == (
        1,
        b"",
        b"? \nERR 10 LINE 10\n",
    )


def test_syntax_error_runs_nothing(part: Path) -> None:
    part.write_text("10 CUT O,(1,0)\n20 CUT (1,,2)\n")
    done = skg(part)
    assert (done.returncode, done.stdout) == (1, b"")
    assert done.stderr == b"20 CUT (1,,2)\n          ^\nERR 01 LINE 20\n"


@pytest.mark.parametrize(
    ("arguments", "facts"),
    [
        ([], ["argument", "'PART'"]),
        (["--wrong"], ["option", "--wrong"]),
    ],
)
def test_wrong_usage(arguments: list[str], facts: list[str]) -> None:
    done = skg(*arguments)
    assert done.returncode == 2 and each_says(done.stderr.decode(), ("skg: ", *facts, "skg ref --help"))


def test_no_such_file() -> None:
    done = skg("no-such.skg")
    assert (done.returncode, done.stderr) == (2, b"skg: no-such.skg: No such file or directory\n")


def test_foreign_characters_are_named(part: Path) -> None:
    part.write_bytes("10 REM plate\n20 REM größer\n".encode())
    done = skg(part)
    assert done.returncode == 2
    assert each_says(done.stderr.decode(), (f"skg: {part}: ", "line 2", "ASCII"))
