"""The command line as a whole: output that nobody takes, and what is loaded when."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from facthelp import says
from toolhelp import SKG

from skg.messages.finding import Finding, Phrase

ROOT = Path(__file__).parents[2]
TAPE, PART = "examples/fit-gear.3b", "examples/fit-gear.skg"
#: A run of every command that writes to its standard output.
COMMANDS = {
    "help": ["--help"],
    "cam": ["cam", "--base", "20", "--lift", "8"],
    "check": ["check", *[TAPE] * 50],
    "cut": ["cut", "docs/pictures/bracket.dxf"],
    "dxf": ["dxf", TAPE],
    "gcode": ["gcode", TAPE],
    "gear": ["gear", "--module", "2", "--teeth", "9"],
    "plot": ["plot", TAPE, "-o", "-"],
    "ref": ["ref", PART],
    "run": ["run", PART],
    "sim": ["sim", "--blocks", *[TAPE] * 50],
    "tape": ["tape", TAPE],
    "tekhtran": ["tekhtran", "examples/tkh-maltese.tkh"],
    "xy": ["xy", "examples/xy-gear.xy"],
}
each = pytest.mark.parametrize("words", COMMANDS.values(), ids=COMMANDS)
#: One of each way to write: click's text, a report, bytes, lines while it runs.
WRITERS = ("help", "cut", "plot", "sim")
some = pytest.mark.parametrize("words", [COMMANDS[name] for name in WRITERS], ids=WRITERS)


def test_every_command_is_tried() -> None:
    from skg.cli import COMMANDS as there

    assert set(there) - set(COMMANDS) == {"term", "ui"}  # what they show: test_term.py, tests/ui


@pytest.mark.parametrize(
    ("word", "answer"),
    [
        ("tekthran", Phrase("no-command-near", name="tekthran", near="tekhtran")),
        ("qqq", Phrase("wrong-usage", what=Phrase("no-command", name="qqq"), command="skg")),
    ],
)
def test_mistyped_command(word: str, answer: Phrase) -> None:
    done = subprocess.run([SKG, word, "part.dxf"], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert says(done.stderr, answer)


@pytest.mark.parametrize(
    ("words", "code"),
    [
        (["cut"], "wrong-usage"),
        (["cut", "part.dxf", "--wier", "1"], "wrong-usage"),
        (["cut", "part.dxf", "--wire", "x"], "wrong-usage"),
        (["cut", "no.dxf"], "system-no-file"),
        (["cut", "docs/pictures/bracket.dxf", "-o", ""], "empty-file-name"),
        (["cut", "docs/pictures/bracket.dxf", "-o", os.devnull, "--offset", "4"], "no-room"),
        (["check", "no.3b"], "system-no-file"),
        (["sim", TAPE, "--feed", "0"], "wrong-usage"),
    ],
)
def test_refusal_as_json(
    words: list[str],
    code: str,
    run_program: Callable[..., subprocess.CompletedProcess[str]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """One object, whoever refuses: click, the system, the command."""
    monkeypatch.chdir(ROOT)
    done = run_program(*words, "--json")
    assert (done.returncode, done.stdout) == (2, "")
    assert json.loads(done.stderr)["error"].items() >= {"code": code, "severity": "error"}.items()


def test_option_without_its_value(run_program: Callable[..., subprocess.CompletedProcess[str]]) -> None:
    """The help of the command is named."""
    done = run_program("cut", "part.dxf", "-o")
    assert done.returncode == 2 and says(done.stderr, "skg cut", "-o")


def test_layers_as_json(run_program: Callable[..., subprocess.CompletedProcess[str]]) -> None:
    done = run_program("cut", ROOT / "docs" / "pictures" / "bracket.dxf", "--list-layers", "--json")
    assert done.returncode == 0
    assert [layer["values"]["layer"] for layer in json.loads(done.stdout)["layers"]] == ["NOTES", "PART"]


def test_as_a_module() -> None:
    done = [
        subprocess.run(words, capture_output=True)
        for words in ([SKG, "--version"], [sys.executable, "-m", "skg", "--version"])
    ]
    assert done[0].stdout == done[1].stdout != b"" and done[1].returncode == 0


def start(words: list[str], closed: int) -> subprocess.Popen[bytes]:
    """Start a command one of whose streams (1, 2) is a pipe that nobody reads; the other one is kept."""
    reading, writing = os.pipe()
    streams = {1: ("stdout", "stderr"), 2: ("stderr", "stdout")}[closed]
    process = subprocess.Popen(
        [SKG, *words], cwd=ROOT, stdin=subprocess.DEVNULL, **{streams[0]: writing, streams[1]: subprocess.PIPE}
    )
    os.close(writing)
    os.close(reading)
    return process


def ended_quietly(process: subprocess.Popen[bytes]) -> int:
    """A command's exit code; a traceback, or a message of the interpreter's, fails."""
    kept = b"".join(stream for stream in process.communicate() if stream)
    assert b"Traceback" not in kept and b"Exception" not in kept, kept
    return process.returncode


@each
def test_nobody_takes_the_output(words: list[str]) -> None:
    assert ended_quietly(start(words, closed=1)) == 1


@some
def test_nobody_takes_the_messages(words: list[str]) -> None:
    assert ended_quietly(start(words, closed=2)) in (0, 1)


@some
def test_closed_output(words: list[str]) -> None:
    """`>&-`: there is no standard output at all."""
    done = subprocess.run(["bash", "-c", '"$@" >&-', "bash", SKG, *words], cwd=ROOT, capture_output=True)
    assert b"Traceback" not in done.stderr, done.stderr


@some
def test_full_disk(words: list[str]) -> None:
    done = subprocess.run(["bash", "-c", '"$@" >/dev/full', "bash", SKG, *words], cwd=ROOT, capture_output=True)
    assert done.returncode == 2
    assert done.stderr.decode().endswith(f"skg: {Finding('system-full').within(Phrase('stdout'))}\n")


def test_help_loads_no_command() -> None:
    """`skg --help` needs click alone: neither the commands nor what they are made of."""
    text = (
        "import sys; from click.testing import CliRunner; from skg.cli import cli; "
        "assert 'tekhtran' in CliRunner().invoke(cli, ['--help']).stdout; "
        "slow = ('skg.', 'numpy', 'matplotlib', 'ezdxf', 'lark'); "
        "messages = ('skg.messages', 'skg.wording', 'skg.commands.help'); "
        "print([name for name in sys.modules if name.startswith(slow) and not name.startswith(messages)])"
    )
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    assert done.stdout == "['skg.interrupts', 'skg.commands', 'skg.errors', 'skg.garbage', 'skg.terminal', 'skg.cli']\n"


def test_cut_starts_without_the_reference() -> None:
    """`skg cut` of a drawing loads neither the interpreter nor what draws sheets, nor ezdxf before an entity needs it:
    more than half a second."""
    text = (
        "import sys; import skg.commands.cut, skg.cutting.ladder, skg.reading.dxf_entities, skg.reading.svg_shapes; "
        "print([name for name in ('matplotlib', 'lark', 'mpmath', 'skg.ref', 'ezdxf') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def test_a_plain_dxf_drawing_needs_no_other_reader() -> None:
    """One of lines, arcs, ellipses and polylines is read without ezdxf, and without what reads SVG: 75 ms."""
    text = (
        "import sys; from skg.reading.read import read; "
        "ellipse = '0 ELLIPSE 8 0 10 40 20 0 11 9 21 0 40 0.5 41 0 42 6.283185307179586'; "
        "text = f'0 SECTION 2 ENTITIES 0 CIRCLE 8 0 10 0 20 0 40 9 {ellipse} 0 ENDSEC 0 EOF '; "
        "data = text.replace(' ', chr(10)).encode(); "
        "assert len(read(data, 'a.dxf').contours) == 2; "
        "print([name for name in ('ezdxf', 'svgelements', 'tinycss2', 'cssselect2') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def test_small_commands_start_fast() -> None:
    """They load no library that takes a tenth of a second and more."""
    text = (
        "import sys, skg.commands.run, skg.commands.sim, skg.commands.check, skg.commands.gcode, skg.commands.tape; "
        "print([name for name in ('numpy', 'matplotlib', 'ezdxf', 'lark', 'mpmath') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


@pytest.mark.wording
@pytest.mark.parametrize(
    ("words", "encodings"),
    [
        (("sim", TAPE), ["cp932", "cp936", "cp936:surrogateescape", "cp949", "cp866"]),
        (("cut", "docs/pictures/bracket.dxf", "-o", "{}"), ["cp936"]),
    ],
    ids=["sim", "cut"],
)
def test_pipes_without_micro(words: tuple[str, ...], encodings: list[str], tmp_path: Path) -> None:
    """The code pages of China, Japan, Korea and Russia have no µ: on a pipe it is a u."""

    def run(encoding: str) -> str:
        environment = {**os.environ, "PYTHONIOENCODING": encoding}
        words_ = [word.format(tmp_path / "part.3b") for word in words]
        done = subprocess.run([SKG, *words_], capture_output=True, env=environment, cwd=ROOT)
        assert done.returncode == 0
        return (done.stdout + done.stderr).decode(encoding.partition(":")[0])

    expected = run("utf-8")
    assert "µm" in expected
    for encoding in encodings:
        assert run(encoding) == expected.replace("µ", "u"), encoding


def test_name_that_an_encoding_has_not(tmp_path: Path) -> None:
    """It is spelled in the message, and nothing is lost."""
    environment = {**os.environ, "PYTHONIOENCODING": "ascii"}
    done = subprocess.run([SKG, "sim", tmp_path / "件.3b"], capture_output=True, env=environment)
    assert done.returncode == 2
    assert b"\\u4ef6.3b: " in done.stderr


#: What Python for Windows has not, before 3.13: of `os` (less uname, which numpy asks here), and modules.
NOT_ON_WINDOWS = [
    "chown", "fchmod", "fchown", "fork", "getgid", "geteuid", "getloadavg", "getpgid", "getuid", "killpg", "lchown",
    "mkfifo", "nice", "openpty", "pread", "pwrite", "sched_getaffinity", "setsid", "statvfs", "sysconf", "ttyname",
]  # fmt: skip
MODULES_NOT_ON_WINDOWS = ["fcntl", "grp", "pty", "pwd", "resource", "syslog", "termios", "tty"]


def test_needs_nothing_that_windows_has_not(tmp_path: Path) -> None:
    """Every command writes its file where Python has no more than on Windows; msvcrt is the keyboard there. (One
    after the other, in a process of their own.)"""
    calls = {}
    for name in (*COMMANDS, "term"):
        words = [word for word in COMMANDS.get(name, ["term", "--help"]) if word not in ("-o", "-")]
        is_writing = name not in ("help", "check", "sim", "term")
        calls[name] = [*words, *["-o", str(tmp_path / f"{name}.svg")] * is_writing]
    text = (
        "import os, subprocess, sys\n"
        f"for name in {NOT_ON_WINDOWS!r}: delattr(os, name)\n"
        f"sys.modules.update(dict.fromkeys({MODULES_NOT_ON_WINDOWS!r}))\n"
        "sys.modules['msvcrt'] = object()\n"
        "from skg import cli\n"
        "cli._leave = sys.exit\n"
        f"for name, words in {calls!r}.items():\n"
        "    sys.argv[1:] = words\n"
        "    try: cli.main()\n"
        "    except SystemExit as end: assert not end.code, name\n"
        "    else: raise AssertionError(name)\n"
    )
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 0, done.stderr
    assert {path.stem for path in tmp_path.iterdir()} == {name for name, words in calls.items() if "-o" in words}


@pytest.mark.parametrize(
    "words",
    [("plot", "examples/xy-star.skg", "-o", "{}.svg"), ("cut", "{}.dxf", "-o", "{}.3b", "--sheet", "{}.pdf")],
)
def test_pictures_without_matplotlib(words: tuple[str, ...], tmp_path: Path) -> None:
    """It is installed for pictures alone: who asks for one without it is told, before any work."""
    words = tuple(word.format(tmp_path / "part") for word in words)
    text = "import sys; sys.modules['matplotlib'] = None; from skg.cli import main; main()"
    done = subprocess.run([sys.executable, "-c", text, *words], capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert "matplotlib" in done.stderr and words[-1] in done.stderr
    assert not any(tmp_path.iterdir())


@pytest.mark.parametrize("part", ["xy-star", "fit-gear"])
def test_reference_without_gmpy2(part: str) -> None:
    """It makes mpmath faster, and nothing else."""
    environment = {**os.environ, "MPMATH_NOGMPY": "1"}
    backend = "import mpmath.libmp as m; print(m.BACKEND)"
    done = subprocess.run([sys.executable, "-c", backend], capture_output=True, text=True, env=environment)
    assert done.stdout == "python\n"
    done = subprocess.run([SKG, "ref", f"examples/{part}.skg"], capture_output=True, env=environment, cwd=ROOT)
    assert done.stdout == (ROOT / "examples" / f"{part}.3b").read_bytes()


@pytest.mark.parametrize("name", [*COMMANDS, "term"][1:])
def test_no_option_takes_what_is_no_number(name: str) -> None:
    """NaN lies in every range, as Python compares."""
    from importlib import import_module

    import click

    command = import_module(f"skg.commands.{name.replace('-', '_')}").command
    options = [one for one in command.params if isinstance(one.type, click.FloatRange)]
    assert options or name not in ("cut", "gear", "cam", "plot", "term")
    for option in options:
        for word in ("nan", "inf", "-inf", "1e8"):
            with pytest.raises(click.BadParameter):
                option.type.convert(word, option, None)
        assert option.type.convert(str(option.type.max or 5.0), option, None) == (option.type.max or 5.0)
