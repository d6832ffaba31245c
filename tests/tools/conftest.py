"""Fixtures of the host tools' tests."""

from __future__ import annotations

import gc
import io
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from zlib import crc32

import pytest
from click.testing import CliRunner, Result
from toolhelp import CAD_TAPE, Run

from skg.cli import cli, main, refusal
from skg.commands.help import speak
from skg.errors import UserError
from skg.job.file import dump, load
from skg.job.job import Job
from skg.messages.render import speech
from skg.pipeline import steps
from skg.planning.planned import PlannedContour

EVERY = int(os.environ.get("SKG_EVERY", "6"))


@pytest.fixture(scope="session", autouse=True)
def libraries(build: Callable[..., None]) -> None:
    """The libraries in C: the board and the simulator."""
    build("emu", "tools")


@pytest.fixture
def run() -> Run:
    """Run `skg` with arguments in this process. An exception fails the test, but a refusal with --json."""

    def call(*arguments: object, stdin: bytes | str | None = None) -> Result:
        words = [str(argument) for argument in arguments]
        result = CliRunner(mix_stderr=False).invoke(cli, words, input=stdin)
        if isinstance(result.exception, UserError) and "--json" in words:
            result.stderr_bytes = refusal(result.exception.finding, result.exception.audience, words).encode()
            result.exit_code = 2
            return result
        if result.exception is not None and not isinstance(result.exception, SystemExit):
            raise result.exception
        return result

    return call


@pytest.fixture(autouse=True)
def jobs_as_files(monkeypatch: pytest.MonkeyPatch) -> None:
    """The job of each sixth drawing that `skg cut` cuts in a test (SKG_EVERY=1: of each), as a file: the same contours
    are planned, so that the tape is the same."""
    plain = steps.plan_drawing

    def planned(job: Job, drawn: steps.OpenedDrawing) -> list[PlannedContour]:
        contours = plain(job, drawn)
        if len(contours) <= 200 and crc32(repr(contours).encode()) % EVERY == 0:
            again = load(dump(steps.written(job, drawn)), "again")
            whole = steps.open_drawing(again, drawn.data, drawn.name)
            (opened,) = (each for each in steps.members_of(again, whole) if each.member == drawn.member)
            assert plain(again, opened) == contours
        return contours

    monkeypatch.setattr(steps, "plan_drawing", planned)


@pytest.fixture
def run_program(monkeypatch: pytest.MonkeyPatch) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Run `skg` from its entry point to its exit, for what stands on stderr and the exit code: in this process, since
    another one takes half a second to start. (test_cli.py and test_docs.py start one for every command)"""

    def call(*arguments: object, stdin: str = "") -> subprocess.CompletedProcess[str]:
        words = ["skg", *map(str, arguments)]
        output, errors = (io.TextIOWrapper(io.BytesIO(), "utf-8", write_through=True) for _ in range(2))
        with monkeypatch.context() as patch, pytest.raises(SystemExit) as ended:
            patch.setattr(sys, "argv", words)
            patch.setattr(sys.modules["__main__"], "__package__", None)  # (where click looks for the program's name)
            patch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(stdin.encode()), "utf-8"))
            patch.setattr(sys, "stdout", output)
            patch.setattr(sys, "stderr", errors)
            # (what a process does with its memory and its buffers, since it ends soon)
            patch.setattr(gc, "freeze", lambda: None)
            patch.setattr("skg.cli.collect_rarely", lambda: None)
            patch.setattr("skg.cli._leave", sys.exit)
            try:
                main()
            finally:  # (the tests' own process speaks English)
                speech.language = "en"
                speak("en")
        texts = [stream.buffer.getvalue().decode().replace("\r\n", "\n") for stream in (output, errors)]
        return subprocess.CompletedProcess(words, ended.value.code or 0, *texts)

    return call


@pytest.fixture
def cad_tape(tmp_path: Path) -> Path:
    """The CAD package's tape as a file."""
    path = tmp_path / "cad.3b"
    path.write_bytes(CAD_TAPE)
    return path
