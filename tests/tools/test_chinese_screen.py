"""A Chinese screen: the catalogues and the help, what commands say, and a console of Windows in cp936."""

from __future__ import annotations

import os
import re
import subprocess
from inspect import cleandoc
from pathlib import Path

import click
import polib
import prose
import pytest
from prose import ENGLISH
from toolhelp import SKG

from skg.cli import COMMANDS, cli
from skg.messages.finding import Finding, Phrase

pytestmark = pytest.mark.wording

ROOT = Path(__file__).parents[2]
MESSAGES = ROOT / "tools" / "skg" / "messages"
HAN = re.compile(r"[\u4e00-\u9fff]")
#: Fields, code, and options with their values are names.
NAMES = re.compile(r"\{[^}]*\}|`[^`]*`|（pipx [^）]*）|--[a-z-]+( [a-z]+)?|skg [a-z]+")


def chinese(*words: object, code: int, stdin: str = "", **environment: str) -> str:
    """Run a command in Chinese, in a terminal of this encoding; what it says."""
    settings = {**os.environ, "PYTHONIOENCODING": "utf-8", "TQDM_DISABLE": "1", **environment}
    command = [SKG, "--lang", "zh", *map(str, words)]
    done = subprocess.run(command, cwd=ROOT, env=settings, input=stdin.encode(), capture_output=True)
    assert done.returncode == code, done.stderr
    # (strictly: each byte is a character of that encoding)
    return (done.stdout + done.stderr).decode(settings["PYTHONIOENCODING"])


@pytest.mark.parametrize("name", ["zh", "help"])
def test_catalogues_have_no_english(name: str) -> None:
    entries = polib.pofile(str(MESSAGES / f"{name}.po"))
    assert len(entries) > 100
    for entry in entries:
        for sentence in entry.msgstr_plural.values() or [entry.msgstr]:
            assert not ENGLISH.search(NAMES.sub("", sentence)), entry.msgid


def test_help_is_complete() -> None:
    """Every command, and every option of it; what is left in the catalogue is click's."""
    known = {entry.msgid: entry for entry in polib.pofile(str(MESSAGES / "help.po"))}
    commands = [cli, *(cli.get_command(None, name) for name in COMMANDS)]
    texts = {*COMMANDS.values(), *(cleandoc(command.help) for command in commands)}
    texts |= {text for command in commands for one in command.params if (text := getattr(one, "help", None))}
    missing = [text for text in sorted(texts) if text not in known or not HAN.search(known[text].msgstr)]
    assert missing == [], "without Chinese in help.po"
    sources = "".join(path.read_text() for path in Path(click.__file__).parent.glob("*.py")).replace("\\n\\t", "\n\t")
    unused = [text for text in known.keys() - texts if text not in sources]
    assert unused == [], "no help of a command or an option, and none of click's"


#: Commands that say something, their exit codes, and what they read.
SAYING = {
    "wrong option": (["cut", "--whre", "1"], 2, ""),
    "wrong value": (["cut", "part.dxf", "--wire", "x"], 2, ""),
    "no command": (["cuts"], 2, ""),
    "no file": (["check", "no.3b"], 2, ""),
    "a cut": (["cut", "docs/pictures/bracket.dxf", "-o", os.devnull, "--tab", "2", "--wire", "0.2"], 0, ""),
    "no room": (["cut", "docs/pictures/bracket.dxf", "-o", os.devnull, "--offset", "4"], 2, ""),
    "bad tape": (["check", "-"], 1, "B1B2B3GXL1\r\nB0B0B0GZ\r\n"),
    "odd tape": (["tape", "-", "-o", os.devnull], 0, "N1 B 1000 B 0 B 1000 GX L1\r\nE\r\n"),
    "bad G-code": (["check", "--machine", "grbl-wire", "-"], 1, "G90\nG1 X1 Y2\nG77 X2\n"),
    "the controller": (["sim", "examples/wrench.3b"], 0, ""),
    "an error of the ROM": (["run", "-", "-o", os.devnull], 1, "10 CUT O,(1,0)\n20 A=1/0\n"),
    "no port": (["term", "/dev/no-port", "--batch"], 2, ""),
}  # fmt: skip


def test_english_among_values_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """What each test looks for: a sentence, also among others; not a name, and not a library's words."""
    monkeypatch.setattr(prose, "found", [])
    Phrase("plain", text=("LAYER1", "part.dxf", "the length is missing"))
    Finding("library-error", error="ValueError", detail="could not convert string")
    assert prose.found == ["plain, text: the length is missing"]


@pytest.mark.parametrize("what", SAYING)
def test_commands_say_it_in_chinese(what: str) -> None:
    words, code, stdin = SAYING[what]
    said = chinese(*words, code=code, stdin=stdin)
    assert HAN.search(said) and not ENGLISH.search(NAMES.sub("", said)), said


@pytest.mark.parametrize("words", [["--help"], ["cut", "--help"], SAYING["a cut"][0], SAYING["bad tape"][0]])
def test_console_of_windows(words: list[str]) -> None:
    """What cp936 has no character for is written another way: µ is one."""
    code, stdin = (1, SAYING["bad tape"][2]) if words[0] == "check" else (0, "")
    said = chinese(*words, code=code, stdin=stdin, PYTHONIOENCODING="cp936")
    assert HAN.search(said)
