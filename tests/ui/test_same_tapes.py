"""A tape of the page's is the command line's, byte by byte: drawings of the tests, and those of the pages' examples."""

from __future__ import annotations

import json
import shlex
import sys
import tomllib
from collections.abc import Iterator
from inspect import getmembers, isfunction
from pathlib import Path
from threading import Thread

import pytest
from click.testing import CliRunner
from uihelp import Page

from skg.cli import cli
from skg.job.setups import Setups
from skg.ui.server import Server
from skg.ui.session import Session

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests" / "tools"))
import drawings  # noqa: E402 (it lies in another folder of tests)

PICTURES = ROOT / "docs" / "pictures"
#: Drawings of the tests, all but those with parameters and the means to make them.
MADE = {
    name: make
    for name, make in getmembers(drawings, isfunction)
    if make.__module__ == "drawings" and not make.__code__.co_argcount and name != "new"
}
#: The options of the examples of docs/shop.md and docs/tools.md.
SHOWN = [
    ("bracket.dxf", "--wire 0.18 --gap 0.01"),
    ("bracket.dxf", "--wire 0.18 --gap 0.01 --passes 0.06,0.02,0 --tab 1.5"),
    ("bracket.dxf", "--rom standard"),
    ("bracket.dxf", "--offset 0.1 --lead-shape arc --reverse --lead 2"),
    ("bracket.dxf", "--offset 1.5"),
    ("punch.svg", "--offset 0.1"),
    ("punch.svg", "--offset 0.08 --side inside --start 20,10"),
]


@pytest.fixture(scope="module")
def one_page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    """A page for all of them."""
    session = Session(Setups(tmp_path_factory.mktemp("config")))
    session.begin(None)
    server = Server(0, session)
    Thread(target=server.serve_forever, daemon=True).start()
    yield Page(server)
    server.shutdown()
    server.server_close()
    session.close()


def compare(page: Page, path: Path, options: str, folder: Path) -> None:
    """Cut a drawing here and there, with the same job."""
    job, tape, program = folder / f"{path.stem}.job.toml", folder / "one.nodrift.3b", folder / "one.skg"
    here = folder / path.name
    here.write_bytes(path.read_bytes())
    words = [
        "cut",
        str(here),
        *shlex.split(options),
        "--save-job",
        str(job),
        "-o",
        str(tape),
        "--program",
        str(program),
        "--json",
    ]
    done = CliRunner(mix_stderr=False).invoke(cli, words, catch_exceptions=False)
    assert done.exit_code == 0, done.stderr
    state = page.open(here)
    changed = tomllib.loads(job.read_text())
    answer = page.done("PUT", "/api/job", {"rev": state["rev"], "job": changed})
    number, run = page.cut(answer["rev"])
    assert run["state"] == "done", run
    assert page.get(f"/api/run/{number}/tape").body == tape.read_bytes()
    assert page.get(f"/api/run/{number}/program").body == program.read_bytes()
    assert page.get(f"/api/run/{number}/job").body == job.read_bytes()
    report = json.loads(done.stderr)
    codes = [finding["code"] for finding in report["findings"]]
    assert [line["code"] for line in run["result"]["lines"]] == codes[: len(run["result"]["lines"])]


def test_there_are_some() -> None:
    assert len(MADE) >= 10


@pytest.mark.parametrize("name", MADE)
def test_drawings_of_the_tests(one_page: Page, tmp_path: Path, name: str) -> None:
    path = tmp_path / "office" / f"{name}.dxf"
    path.parent.mkdir()
    MADE[name]().saveas(path)
    compare(one_page, path, "--offset 0.1 --open leave --small leave --passes 0.05,0 --tab 0.5", tmp_path)


@pytest.mark.parametrize(("name", "options"), SHOWN)
def test_examples_of_the_pages(one_page: Page, tmp_path: Path, name: str, options: str) -> None:
    compare(one_page, PICTURES / name, options, tmp_path)
