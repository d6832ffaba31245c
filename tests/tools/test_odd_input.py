"""Every command with files that are none, or of another kind: one line that says so, exit code not 0, no traceback."""

from __future__ import annotations

import random
import shlex
import subprocess
from pathlib import Path

import click
import pytest
from click.testing import CliRunner
from facthelp import each_says, says
from toolhelp import CAD_TAPE, ROOT, SKG

from skg.cli import COMMANDS, cli
from skg.errors import UserError
from skg.messages.finding import Phrase

#: How each command takes a file, `-o out` where it writes one; what it can read among `FILES`.
READERS = {
    "check": (["check"], {"tape", "d"}),
    "cut": (["cut", "-o", "out"], {"dxf"}),
    "dxf": (["dxf", "-o", "out"], {"tape"}),
    "gcode": (["gcode", "-o", "out"], {"tape"}),
    "gcode --back": (["gcode", "--back", "-o", "out"], {"nc"}),
    "plot": (["plot", "-o", "out.svg"], {"tape"}),
    "ref": (["ref", "-o", "out"], {"skg", "fit"}),
    "run": (["run", "-o", "out"], {"skg", "fit"}),
    "sim": (["sim"], {"tape"}),
    "tape": (["tape", "-o", "out"], {"tape"}),
    "tekhtran": (["tekhtran", "-o", "out"], {"tkh"}),
    "xy": (["xy", "-o", "out"], {"xy"}),
}
#: Commands that read no file.
MAKERS = {"cam": ["--base", "20", "--lift", "8"], "gear": ["--module", "2", "--teeth", "9"]}
#: What files hold, and the code of what a message must name.
FILES = {
    "empty": (b"", ""),
    "blank": (b" \r\n\n", ""),
    "blank tape": (bytes(300), ""),
    "junk": (random.Random(1).randbytes(500), ""),
    "sevens": (b"7" * 5000, ""),
    "comments": (b"<!-- -->\n" * 400, ""),
    "remarks": (b"999\nabc\n" * 400, ""),
    "text": (b"Dear Sir,\nplease find enclosed\n", ""),
    "html": (b"<!DOCTYPE html>\n<html><body>404</body></html>\n", "file-web-page"),
    "png": ((ROOT / "docs/pictures/page.png").read_bytes()[:2000], "file-png"),
    "zip": (b"PK\3\4" + bytes(60), "file-zip"),
    "utf-16": ("10 CUT O,(5,0)\n".encode("utf-16"), "file-utf-16"),
    "dxf": ((ROOT / "docs/pictures/bracket.dxf").read_bytes(), "file-dxf"),
    "tape": (CAD_TAPE, "file-tape"),
    "d": (b"D\r\nDD\r\n", ""),
    "skg": (b"\xef\xbb\xbf10 CUT O,(5,0),(5,5)\r\n20 END\r\n", "file-program"),
    "fit": ((ROOT / "examples/fit-gear.skg").read_bytes(), "file-program"),
    "nc": ((ROOT / "examples/mill/plate.nc").read_bytes(), "file-gcode"),
    "xy": ((ROOT / "examples/xy-gear.xy").read_bytes(), ""),
    "tkh": ((ROOT / "examples/tkh-maltese.tkh").read_bytes(), ""),
}


def invoke(*words: str) -> tuple[int, str, str]:
    """Run a command as `skg` does: exit code, what it writes, and what it says."""
    result = CliRunner(mix_stderr=False).invoke(cli, words, standalone_mode=False)
    error = result.exception
    if isinstance(error, UserError | OSError):
        return 2, result.stdout, result.stderr + str(error)
    if isinstance(error, click.ClickException):
        return 2, result.stdout, result.stderr + error.format_message()
    if error is not None and not isinstance(error, SystemExit):
        raise error
    return error.code if error else 0, result.stdout, result.stderr


def test_every_command_is_tried() -> None:
    assert {words[0] for words, _ in READERS.values()} | set(MAKERS) | {"term", "ui"} == set(COMMANDS)


@pytest.mark.parametrize("reader", READERS)
def test_files_of_other_kinds(reader: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    words, reads = READERS[reader]
    tried = 0
    # All kinds under the name that the command expects, and one whose file could be all of them under every name.
    own = {"gcode --back": ".nc", "ref": ".skg", "run": ".skg", "cut": ".dxf"}
    ending = own.get(reader, f".{words[0]}" if words[0] == "xy" else ".tkh" if words[0] == "tekhtran" else ".3b")
    for kind, (data, name) in FILES.items():
        Path(f"in{ending}").write_bytes(data)
        code, out, said = invoke(*words, f"in{ending}")
        lines = [line for line in (out + said).splitlines() if line]
        assert (code == 0) == (kind in reads or kind == "d" and code == 0), (kind, code, said)
        if code == 0 and kind == "d":
            assert says(said, Phrase("no-blocks")) or says(out, Phrase("count-blocks", count=0)), kind
        if code == 2 and kind != "d":
            assert len(lines) == 1 and len(lines[0]) < 300, (kind, lines)
        if code and name:
            assert says(out + said, Phrase(name)), (kind, out + said)
        tried += 1
    assert tried == len(FILES)


@pytest.mark.parametrize("ending", ["", ".3b", ".skg", ".nc", ".xy", ".tkh", ".dxf", ".svg"])
def test_files_of_other_names(ending: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path(f"in{ending}").write_bytes(b"1 0 (\n")
    for reader in ("check", "sim", "cut", "ref"):
        assert invoke(*READERS[reader][0], f"in{ending}")[0] != 0, reader


@pytest.mark.parametrize("reader", READERS)
def test_no_file(reader: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Missing, a folder, a file whose reading fails, and no argument at all."""
    monkeypatch.chdir(tmp_path)
    words, _ = READERS[reader]
    Path("folder.skg").mkdir()
    for name in ("none.skg", "folder.skg", "none/part.skg", "/proc/self/mem"):
        code, out, said = invoke(*words, name)
        assert (code, out) == (2, "") and "\n" not in said, (name, said)
        assert name in said, said


OUTPUTS = {
    **{reader: (words[:-1], next(iter(reads))) for reader, (words, reads) in READERS.items() if "-o" in words},
    **{name: ([name, *options, "-o"], None) for name, options in MAKERS.items()},
}


@pytest.mark.parametrize("command", OUTPUTS)
def test_outputs_that_cannot_be(command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Into a folder that there is not, onto a folder, and behind a file: said, and exit code 2."""
    monkeypatch.chdir(tmp_path)
    words, kind = OUTPUTS[command]
    part = []
    if kind:
        part = [f"in.{ {'tape': '3b', 'fit': 'skg'}.get(kind, kind) }"]
        Path(part[0]).write_bytes(FILES[kind][0])
    Path("folder.svg").mkdir()
    Path("file.svg").touch()
    Path("loop.svg").symlink_to("loop.svg")
    for name in ("none/out.svg", "folder.svg", "file.svg/out.svg", "loop.svg"):
        code, _, said = invoke(*words, name, *part)
        assert code == 2, (name, said)
        assert name in said


def test_wrong_usage_is_one_line() -> None:
    """An option that there is not, with what was meant; more arguments than there are; exit code 2."""
    for command in COMMANDS:
        for words in (["--hlp"], ["one", "two", "three", "--nonsense"]):
            code, out, said = invoke(command, *words)
            assert (code, out) == (2, "") and "\n" not in said, (command, said)
        assert "--help" in invoke(command, "--hlp")[2], command


def shell(words: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """`skg` as bash starts it, `words` with what is redirected or limited."""
    words = words.replace("skg ", f"exec {shlex.quote(str(SKG))} ", 1)
    return subprocess.run(["bash", "-c", words], cwd=folder, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("words", ["dxf in.3b -o good", "plot in.3b -o good --format svg"])
def test_a_full_disk_spares_the_old_file(words: str, tmp_path: Path) -> None:
    """The new file is whole before it takes the old one's place; and its mode and a link to it stay."""
    (tmp_path / "in.3b").write_bytes((ROOT / "examples" / "wrench.3b").read_bytes())
    good = tmp_path / "kept"
    good.write_text("as it was")
    good.chmod(0o640)
    (tmp_path / "good").symlink_to("kept")
    done = shell(f"trap '' XFSZ; ulimit -f 1; skg {words} --positions machine", tmp_path)
    assert done.returncode == 2 and done.stderr.count("\n") == 1 and says(done.stderr, "good")
    assert says(done.stderr, Phrase("system-too-large"))
    assert good.read_text() == "as it was"
    assert shell(f"skg {words}", tmp_path).returncode == 0
    assert len(good.read_text()) > 2000 and good.stat().st_mode & 0o777 == 0o640
    assert sorted(path.name for path in tmp_path.iterdir()) == ["good", "in.3b", "kept"]


@pytest.mark.parametrize("words", ["check in.3b", "ref in.skg"])
def test_a_closed_output_is_no_success(words: str, tmp_path: Path) -> None:
    (tmp_path / "in.3b").write_bytes(FILES["tape"][0])
    (tmp_path / "in.skg").write_bytes(FILES["skg"][0])
    done = shell(f"skg {words} >&-", tmp_path)
    assert done.returncode == 2 and each_says(done.stderr, ("skg: ", Phrase("stdout-closed")))


def test_output_onto_input(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A drawing is not written over the tape that it was made of; `skg tape` may write a tape over itself."""
    monkeypatch.chdir(tmp_path)
    for command, (words, kind) in OUTPUTS.items():
        if not kind:
            continue
        ending = {"tape": "3b", "fit": "skg"}.get(kind, kind)
        name = f"in.{'svg' if command == 'plot' else ending}"
        Path(name).write_bytes(FILES[kind][0])
        code, _, said = invoke(*words, f"./{name}", name)
        assert (code, Path(name).read_bytes() == FILES[kind][0]) == (0 if command == "tape" else 2, True), command
        assert command == "tape" or each_says(said, (f"./{name}: ", Phrase("written-twice")))
    Path("in.dxf").write_bytes(FILES["dxf"][0])
    assert says(invoke("cut", "in.dxf", "-o", "out", "--program", "out")[2], "out: ", Phrase("written-twice"))
