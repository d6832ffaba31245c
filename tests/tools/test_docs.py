"""The examples of docs/tools.md print what the page says; run as a program, this writes the page anew."""

from __future__ import annotations

import doctest
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import drawings
import ezdxf
import pytest
from click import Option

import skg

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "tools.md"
BRACKET = ROOT / "docs" / "pictures" / "bracket.dxf"
#: A command and the indented lines after it, up to the next command or the end of the indentation.
EXAMPLE = re.compile(r"^    \$ (?P<command>.*)\n(?P<output>(?:    (?!\$ ).*\n|\n(?=    (?!\$ )))*)", re.M)


#: Systems that speak a language, though its locale be not installed.
SYSTEMS = {"en": {"LC_ALL": "C.UTF-8"}, "zh": {"LC_ALL": "", "LC_CTYPE": "C.UTF-8", "LANG": "zh_CN.UTF-8"}}
#: What an example writes for later ones to read.
WRITTEN = re.compile(r"(?:-o|--program|--save-job|>) (build/\S+?)(?=;|\s|$)")


def printed(command: str, folder: Path = ROOT, language: str = "en") -> str:
    """The output of a command of the page in a folder, both streams, on a system of a language."""
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    (folder / "build").mkdir(exist_ok=True)
    done = subprocess.run(
        ["bash", "-c", command],
        cwd=folder,
        env={**os.environ, "PATH": path, **SYSTEMS[language]},
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    # (a page would show it)
    assert "Traceback (most recent call last)" not in done.stdout, done.stdout
    return done.stdout


def indented(text: str) -> str:
    return "".join(f"    {line}\n" if line else "\n" for line in text.splitlines())


def examples() -> Iterator[re.Match[str]]:
    return EXAMPLE.finditer(PAGE.read_text())


def needed(command: str) -> str | None:
    """The example above that writes what a command reads."""
    read = set(re.findall(r"build/\S+", WRITTEN.sub("", command)))
    return next((one["command"] for one in examples() if read & set(WRITTEN.findall(one["command"]))), None)


def with_links(folder: Path) -> Path:
    """A folder that has the project's docs and examples."""
    for name in ("docs", "examples"):
        (folder / name).symlink_to(ROOT / name)
    return folder


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """The folder that a command of the page has written into, once for all that read what is there."""

    @cache
    def folder(command: str) -> Path:
        folder = with_links(tmp_path_factory.mktemp("before"))
        printed(command, folder)
        return folder / "build"

    return folder


@pytest.mark.wording
@pytest.mark.parametrize("example", examples(), ids=lambda match: match["command"])
def test_example(example: re.Match[str], tmp_path: Path, written: Callable[[str], Path]) -> None:
    """In a folder of its own, so that examples run in any order, and beside each other."""
    # Pictures are drawn elsewhere, so that a test never changes the tree.
    command = re.sub(r"(-o|--sheet) docs/pictures/", rf"\1 {tmp_path}/", example["command"])
    if before := needed(command):
        shutil.copytree(written(before), tmp_path / "build")
    assert indented(printed(command, with_links(tmp_path))) == example["output"]


def test_an_example_that_needs_another() -> None:
    assert needed("skg dxf build/bracket.3b --start 34.5,15 | skg cut - --list-layers")


def test_every_command_has_a_section() -> None:
    from skg.cli import COMMANDS

    assert set(re.findall(r"^## skg (\S+)", PAGE.read_text(), re.M)) == set(COMMANDS)


def test_every_option_is_explained() -> None:
    """No option without a help text."""
    from skg.cli import COMMANDS, cli

    for name in COMMANDS:
        command = cli.get_command(None, name)
        assert command.help, name
        for parameter in command.params:
            assert getattr(parameter, "help", "argument"), (name, parameter.name)


def test_every_option_stands_on_the_page() -> None:
    """By one of its names."""
    from skg.cli import COMMANDS, cli

    page = set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", PAGE.read_text()))
    options = [
        (name, one) for name in COMMANDS for one in cli.get_command(None, name).params if isinstance(one, Option)
    ]
    assert len(options) > 100
    assert [(name, one.name) for name, one in options if not page & {*one.opts, *one.secondary_opts}] == []


def test_every_key_of_a_job_stands_in_its_row() -> None:
    """(Of a layer and a contour those of [default] need not be named again.)"""
    from skg.job.file import _LISTS, _TOP, TABLES

    rows = dict(re.findall(r"^\| `?(\(top\)|\[+\w+\]+)`? \| (.*) \|$", PAGE.read_text(), re.M))
    tables = {"(top)": _TOP} | {f"[{name}]": keys for name, keys in TABLES.items()}
    tables |= {f"[[{name}]]": keys.keys() - TABLES["default"].keys() for name, keys in _LISTS.items()}
    rows["[[contour]]"] += rows["[[layer]]"]
    for table, keys in tables.items():
        assert [key for key in keys if f"`{key}`" not in rows[table]] == [], table


def test_python() -> None:
    """The page's Python, and the package's own docstring."""
    done = doctest.testfile(str(PAGE), module_relative=False, encoding="utf-8")
    assert done.attempted >= 7
    assert not done.failed
    assert doctest.testmod(skg) == (0, 3)


if __name__ == "__main__":
    ezdxf.options.write_fixed_meta_data_for_testing = True  # no time and no new GUID: the same drawing, the same file
    drawings.bracket().saveas(BRACKET)
    PAGE.write_text(
        EXAMPLE.sub(lambda match: f"    $ {match['command']}\n{indented(printed(match['command']))}", PAGE.read_text())
    )
