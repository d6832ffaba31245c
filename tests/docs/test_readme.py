"""The first screen of the README: its command gives the report and the tape that it shows."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize(("name", "language"), [("README.md", "en"), ("README.zh.md", "zh")])
def test_first_screen(name: str, language: str, tmp_path: Path) -> None:
    screen = (ROOT / name).read_text().partition("\n## ")[0]
    (words,) = re.findall(r"^    skg (cut .*)$", screen, re.M)
    tape = tmp_path / "bracket.nodrift.3b"
    command = [
        Path(sys.executable).with_name("skg"),
        "--lang",
        language,
        *words.replace("bracket.nodrift.3b", str(tape)).split(),
    ]
    report = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stderr.splitlines()
    shown = re.findall(r"^    (?!skg|python)(.*)$", screen, re.M)
    assert len(shown) == 3 and set(shown) <= set(report)
    first, last = re.search(r"\| ((?:`[BD]\w*`<br>)+)…<br>`(\w+)` \|", screen).groups()
    blocks = re.findall(r"`(\w+)`", first)
    punched = tape.read_text().split()
    assert len(blocks) > 5 and punched[: len(blocks)] == blocks and punched[-1] == last
