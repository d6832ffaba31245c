"""The spellings of XY's symbols, and the files of programs (docs/spec/xy.md, section 1)."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner
from rivalhelp import ROOT

from skg.cli import cli
from skg.rivals.xy import translate

BOOK = "⊕D(0,0)⇒D0;⊕Y(25,0,5)⇒Y1;⊕X(D0,0)⇒X0;⊕D(50,0)⇒D1;⊕D(50,2×3−1)⇒D2;φD1,-Y1,D2,×8(-D0,45),←0.06(D1,D1);"
SPELLINGS = {
    "ascii": {"⊕": "(+)", "⇒": "=>", "φ": "(/)", "×": "*", "←": "<-", "−": "-"},
    "tex": {
        "⊕": r"\oplus ",
        "⇒": r" \Rightarrow ",
        "φ": r"\phi ",
        "×": r"\times ",
        "←": r" \leftarrow ",
        "−": r"\rightarrow ",
        ";": ";$\n$",
        "D0": "D_0",
    },
    "wide": {"⊕": "⊕", ",": "，", ";": "；", "(": "（", ")": "）", "φ": "ϕ", "−": "→"},
    "minus": {"-": "–", "−": "－", "D": "d", "Y": "y", "X": "x"},
    "blanks": {",": " , ", ";": "\r\n;", "(": "(\n"},
    "quad": {";": r"; \quad $ "},
}


@pytest.mark.parametrize("spelling", SPELLINGS)
def test_spelling(spelling: str) -> None:
    text = BOOK
    for one, other in SPELLINGS[spelling].items():
        text = text.replace(one, other)
    assert text != BOOK
    assert translate(text) == translate(BOOK)


def test_longest_match() -> None:
    route = "⊕D(0,0)⇒D0;⊕D(9,0)⇒D1;⊕D(9,9)⇒D2;φD0,D1,D2,{}0.1(D0,D1);"
    assert "R=0.1\n" in translate(route.format("<-"))
    assert "R=-0.1\n" in translate(route.format("<--"))


def test_names() -> None:
    program = translate("⊕D(1,2)⇒D;⊕D(3,4)⇒D0;⊕X(D,5)⇒X99;⊕Y(D0,6)⇒Y;7⇒B;8⇒A2;9⇒B;⊕D(B,A2)⇒D0;", "my päart.xy")
    assert program.splitlines() == [
        "10 REM MY P?ART.XY",
        "20 REM D IS P100, Y IS C100, B IS A1, A2 IS A2",
        "30 P100=(1,2)",
        "40 P0=(3,4)",
        "50 S99=(X#5):P100",
        "60 C100=P0:-6",
        "70 A1=7",
        "80 A2=8",
        "90 A1=9",
        "100 P0=(A1,A2)",
        "110 END",
    ]


def test_lines_are_short_ascii() -> None:
    for part in (ROOT / "examples").glob("*.xy"):
        for line in translate(part.read_text(), part.name * 9).splitlines():
            assert len(line) <= 72
            assert line.isascii()
    long = "1.2345678901234567890+" * 9 + "1"
    program = translate(
        f"⊕D({long},{long})⇒D1;⊕Y({long},{long},{long})⇒Y1;⊕X({long},{long},{long})⇒X1;{long}⇒A;"
        "⊕D(0,0)⇒D0;⊕D(9,0)⇒D2;⊕X(D0,45)⇒X0;⊕Y(7,1,1)⇒Y2;"
        "φD2,-Y2,×2(-D0,8.12345678901),FS(X0),×3(-D0,120),←0(D1,D2);"
    )
    assert max(map(len, program.splitlines())) <= 72


COMMANDS = [
    ["xy"],
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


@pytest.mark.parametrize("ending", ["xy", "XY"])
@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_commands_take_programs(
    command: list[str], ending: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By their ending; and the same of the SKG program that is made of one."""
    monkeypatch.chdir(tmp_path)
    text = (ROOT / "examples" / "xy-book-star.xy").read_text()
    Path(f"part.{ending}").write_text(text)
    Path("part.skg").write_text(translate(text, "part.xy"))
    runner = CliRunner(mix_stderr=False)
    done = runner.invoke(cli, [*command, f"part.{ending}"], catch_exceptions=False)
    assert done.exit_code == 0, done.stderr
    if command[0] == "plot":
        assert Path("x.svg").stat().st_size > 1000
        return
    assert len(done.stdout) > 30
    if command[0] in ("run", "ref"):
        assert done.stdout_bytes == (ROOT / "examples" / "xy-book-star.3b").read_bytes()
    if command[0] != "xy":
        if command[0] == "dxf":
            return  # drawings have a date
        same = runner.invoke(cli, [*command, "part.skg"], catch_exceptions=False)
        assert same.stdout.replace("part.skg", f"part.{ending}") == done.stdout


@pytest.mark.parametrize("command", COMMANDS[1:], ids=" ".join)
def test_commands_say_where(
    command: list[str], run_skg: Callable, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("bad.xy").write_text("⊕D(1,2)⇒D1;\n⊕D(1,X5)⇒D1;")
    done = run_skg(*command, "bad.xy")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "skg: bad.xy:2:6: X5 has not been made\n"
