"""Runs build/skg80 for the emulator's tests."""

from __future__ import annotations

import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
SKG80 = ROOT / "build" / "skg80"
ROMS = ROOT / "roms"
ROM_SIZE = 8192
TIMEOUT = 600.0  # seconds after which a test that waits for an answer has failed


@dataclass(frozen=True)
class Skg80:
    """Runs build/skg80, as a rule with the ROM that it has built in."""

    def __call__(self, *arguments: str | Path, stdin: bytes = b"") -> subprocess.CompletedProcess[bytes]:
        return subprocess.run([SKG80, *arguments], input=stdin, capture_output=True)


def complaint(done: subprocess.CompletedProcess[bytes], code: int) -> str:
    """The one line on standard error that goes with an exit code."""
    text = done.stderr.decode()
    assert done.returncode == code, text
    visible = text.replace("\x11", "")  # DC1 starts a reader
    lines = [line for line in visible.split("\n") if line.startswith("skg80: ")]
    assert len(lines) == 1, text
    return lines[0].removeprefix("skg80: ")


def without_sign_on(paper: bytes) -> bytes:
    """The paper from the first prompt on; the bytes that are free are the firmware's to say."""
    found = re.match(rb"\r\nSKG \d+\r\n", paper)
    assert found, paper
    return paper[found.end() :]
