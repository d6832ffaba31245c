"""Fixtures of the host tools' tests."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from toolhelp import CAD_TAPE, Run

from skg.cli import cli
from skg.job.file import dump, load
from skg.job.job import Job
from skg.pipeline import steps
from skg.planning.route import PlannedContour


@pytest.fixture(scope="session", autouse=True)
def libraries(build: Callable[..., None]) -> None:
    """The libraries in C: the board and the simulator."""
    build("emu", "tools")


@pytest.fixture
def run() -> Run:
    """Run `skg` with arguments in this process; an exception that is no `UserError` fails the test."""

    def call(*arguments: object, stdin: bytes | str | None = None) -> Result:
        words = [str(argument) for argument in arguments]
        result = CliRunner(mix_stderr=False).invoke(cli, words, input=stdin)
        if result.exception is not None and not isinstance(result.exception, SystemExit):
            raise result.exception
        return result

    return call


@pytest.fixture(autouse=True)
def jobs_as_files(monkeypatch: pytest.MonkeyPatch) -> None:
    """The job of every drawing that `skg cut` cuts in a test, as a file: the same contours are planned, so that the
    tape is the same."""
    plain = steps.plan_drawing

    def planned(job: Job, drawn: steps.DrawnJob) -> list[PlannedContour]:
        routes = plain(job, drawn)
        if len(routes) <= 200:
            again = load(dump(steps.written(job, drawn)), "again")
            assert plain(again, steps.open_drawing(again, drawn.data, drawn.name)) == routes
        return routes

    monkeypatch.setattr(steps, "plan_drawing", planned)


@pytest.fixture(scope="session")
def run_program() -> Callable[..., subprocess.CompletedProcess[str]]:
    """Run `skg` as a program of its own, as a shell does: for what stands on stderr and the exit code."""

    def call(*arguments: object, stdin: str = "") -> subprocess.CompletedProcess[str]:
        program = Path(sys.executable).with_name("skg")
        return subprocess.run([program, *map(str, arguments)], input=stdin, capture_output=True, text=True)

    return call


@pytest.fixture
def cad_tape(tmp_path: Path) -> Path:
    """The CAD package's tape as a file."""
    path = tmp_path / "cad.3b"
    path.write_bytes(CAD_TAPE)
    return path
