"""The commands that take the rivals' programs, and those that translate them."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner
from facthelp import each_says, says
from rivalhelp import ROOT

from skg.cli import cli
from skg.errors import UserError
from skg.rivals.languages import translated

COMMANDS = [
    ["run"],
    ["ref"],
    ["sim"],
    ["check"],
    ["gcode"],
    ["dxf"],
    ["plot", "-o", "x.svg"],
    ["plot", "-o", "x.svg", "--skg80", "reference"],
    ["plot", "-o", "x.svg", "--skg80", f"{ROOT}/build/skg80"],
]


@pytest.mark.parametrize("name", ["xy-book-star.xy", "xy-book-star.XY", "tkh-fork.tkh"])
@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_commands_take_programs(command: list[str], name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By their ending; and the same of the SKG program that is made of one."""
    monkeypatch.chdir(tmp_path)
    stem, ending = name.split(".")
    shutil.copy(ROOT / "examples" / f"{stem}.{ending.lower()}", f"part.{ending}")
    Path("part.skg").write_text(translated(f"part.{ending}"))
    runner = CliRunner(mix_stderr=False)
    done = runner.invoke(cli, [*command, f"part.{ending}"], catch_exceptions=False)
    assert done.exit_code == 0, done.stderr
    if command[0] == "plot":
        assert Path("x.svg").stat().st_size > 1000
        return
    assert len(done.stdout) > 30
    if command[0] in ("run", "ref"):
        assert done.stdout_bytes == (ROOT / "examples" / f"{stem}.3b").read_bytes()
    if command[0] != "dxf":  # drawings have a date
        same = runner.invoke(cli, [*command, "part.skg"], catch_exceptions=False)
        assert same.stdout.replace("part.skg", f"part.{ending}") == done.stdout


@pytest.mark.parametrize(
    ("ending", "text", "place", "name"),
    [
        ("xy", "⊕D(1,2)⇒D1;\n⊕D(1,X5)⇒D1;", "2:6", "X5"),
        ("tkh", "ТЧ1 = 1, 2\nТЧ2 = ТЧ1, ПР5", "2:12", "ПР5"),
    ],
)
@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_commands_say_where(
    command: list[str],
    ending: str,
    text: str,
    place: str,
    name: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path(f"bad.{ending}").write_text(text)
    done = CliRunner(mix_stderr=False).invoke(cli, [*command, f"bad.{ending}"])
    assert isinstance(done.exception, UserError) and each_says(str(done.exception), (f"bad.{ending}:{place}: ", name))
    assert (done.stdout, done.stderr) == ("", "")


@pytest.mark.parametrize(("command", "name"), [("xy", "xy-book-star.xy"), ("tekhtran", "tkh-fork.tkh")])
def test_translators(command: str, name: str, tmp_path: Path) -> None:
    """`skg xy` and `skg tekhtran`: to the standard output, to a file, from the standard input."""
    part, program = ROOT / "examples" / name, tmp_path / "part.skg"
    wanted = translated(str(part))
    runner = CliRunner(mix_stderr=False)
    assert runner.invoke(cli, [command, str(part)]).stdout == wanted
    assert runner.invoke(cli, [command, str(part), "-o", str(program)]).stdout == ""
    assert program.read_text() == wanted
    done = runner.invoke(cli, [command, "-"], input=part.read_bytes())
    assert done.stdout.splitlines()[1:] == wanted.splitlines()[1:]


@pytest.mark.parametrize(
    ("command", "data", "where"),
    [
        ("xy", "⊕D(0,0)⇒D0;\n  @".encode(), "2:3: "),
        ("xy", b"ab\n\xff", "2:1: "),
        ("xy", b"\\oplus D(0,0)\\Rightarrow D_0;\n\\phi D1", "2:6: "),
        ("xy", b"(" * 3000 + b"1", "1:"),
        ("tekhtran", "ТЧ1 = 1, 2\n  @".encode(), "2:3: "),
        ("tekhtran", "ТЧ1 = 1, 2\nТЧ2 = 3".encode("koi8-r"), "1:1: "),
        ("tekhtran", ("Х1 = " + "(" * 3000 + "1" + ")" * 3000).encode(), "1:1: "),
    ],
)
def test_bad_input(command: str, data: bytes, where: str, tmp_path: Path) -> None:
    part = tmp_path / "part"
    part.write_bytes(data)
    result = CliRunner(mix_stderr=False).invoke(cli, [command, str(part)])
    assert (result.exit_code, result.stdout) == (1, "")
    assert result.stderr.startswith(f"{part}:{where}")
    assert result.stderr.count("\n") == 1
    assert says(result.stderr, "UTF-8") == (data.decode(errors="ignore").encode() != data)
