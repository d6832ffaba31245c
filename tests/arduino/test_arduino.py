"""The Arduino library as the release packs it, compiled for this computer: streams are queues, pins are counted."""

from __future__ import annotations

import importlib.util
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).parent
WARNINGS = ["-O1", "-Wall", "-Wextra", "-Werror"]
#: Boards' processors of which Debian has a compiler with C++'s library.
PROCESSORS = {"RP2040": "cortex-m0plus", "Teensy 4": "cortex-m7"}

_spec = importlib.util.spec_from_file_location("release_arduino", ROOT / "release" / "arduino.py")
assert _spec and _spec.loader
release = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(release)

#: In one process, which compiles the library once.
pytestmark = [
    pytest.mark.skipif(not shutil.which("g++"), reason="no g++: apt-get install g++"),
    pytest.mark.xdist_group("arduino"),
]


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The library's folder."""
    folder = tmp_path_factory.mktemp("arduino") / "SKG"
    release.write(folder)
    return folder


def run(*command: object) -> str:
    """Run a command that must end well."""
    done = subprocess.run([*map(str, command)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def objects(library: Path) -> list[Path]:
    """The library's C and C++ and what runs a sketch, compiled."""
    made = []
    for source in (library / "src" / "SKG.cpp", HERE / "run.cpp"):
        made.append(library.parent / f"{source.stem}.cpp.o")
        run("g++", *plus_plus(library), "-c", "-o", made[-1], source)
    for source in sorted((library / "src").glob("*.c")):
        made.append(library.parent / f"{source.stem}.o")
        run("gcc", "-std=c11", *WARNINGS, "-c", "-o", made[-1], source)
    return made


def plus_plus(library: Path) -> list[str]:
    """Options of the C++ compiler."""
    return ["-std=c++17", *WARNINGS, f"-I{HERE}", f"-I{library / 'src'}"]


def sketch(library: Path, objects: list[Path], name: str) -> Path:
    """A program that runs an example's sketch."""
    made = library.parent / name
    if not made.exists():
        ino = library / "examples" / name / f"{name}.ino"
        run("g++", *plus_plus(library), "-x", "c++", ino, "-x", "none", *objects, "-o", made)
    return made


def ran(program: Path, typed: str, tape: str = "") -> tuple[str, str, str]:
    """Paper, tape and pins of a sketch to which a text is pasted."""
    files = [program.with_suffix(suffix) for suffix in (".typed", ".tape")]
    for file, text in zip(files, (typed, tape), strict=True):
        file.write_text(text.replace("\n", "\r"), newline="")
    paper, punched, pins = run(program, *files, 5).split("\n====\n")
    return paper, punched, pins


def test_a_part_is_pasted_and_its_tape_comes_out(library: Path, objects: list[Path]) -> None:
    part = ROOT / "examples" / "wrench.skg"
    program = sketch(library, objects, "Teletype")
    paper, punched, pins = ran(program, part.read_text() + "RUN\n")
    assert punched.split() == part.with_suffix(".3b").read_text().split()
    assert "ERR" not in paper and not pins.strip()
    paper, punched, _ = ran(program, "LOAD\nRUN\n", part.read_text() + "\x1a")
    assert punched.split() == part.with_suffix(".3b").read_text().split(), "by LOAD from the second stream"


def test_ctrl_c_passes_what_was_typed_ahead(library: Path, objects: list[Path]) -> None:
    paper, _, _ = ran(sketch(library, objects, "Teletype"), "10 GOTO 10\nRUN\nPRINT 1\n\x03PRINT 2\n")
    assert "\n2" in paper and "PRINT 1" not in paper, paper


def test_motors_get_the_steps_of_the_emulator(library: Path, objects: list[Path], tmp_path: Path) -> None:
    part = tmp_path / "part.skg"
    part.write_text("20 FROM (-.3,0)\n30 CUT (0,0),(.2,.05),(.1,.2),O\n40 END\n")
    run(ROOT / "build" / "skg80", "--rom", ROOT / "roms" / "skg-drive.bin", "--drive", tmp_path / "x.svg",
        "--steps", tmp_path / "steps", part)  # fmt: skip
    _, _, pins = ran(sketch(library, objects, "Plotter"), f"DRIVE 1\n{part.read_text()}RUN\n\n\n\n")
    levels, stepped = dict.fromkeys("23456", False), []
    for pin, sign in re.findall(r"([2-6])([+-])", pins):
        levels[pin] = sign == "+"
        if sign == "+" and pin in "24":
            stepped.append((pin, levels["3" if pin == "2" else "5"]))
    expected = [("2", bool(b & 2)) if b & 1 else ("4", bool(b & 8)) for b in (tmp_path / "steps").read_bytes()]
    assert len(expected) > 500 and stepped == expected


@pytest.mark.skipif(not shutil.which("arm-none-eabi-g++"), reason="no arm-none-eabi-g++: make pico-tools")
@pytest.mark.parametrize("board", PROCESSORS)
def test_it_compiles_for_a_board(library: Path, board: str) -> None:
    target, options = "arm-none-eabi", [f"-mcpu={PROCESSORS[board]}", "-mthumb", *WARNINGS]
    for source in sorted((library / "src").glob("*.c")):
        run(f"{target}-gcc", "-std=gnu11", *options, "-c", "-o", "/dev/null", source)
    for source in [library / "src" / "SKG.cpp", *sorted(library.glob("examples/*/*.ino"))]:
        includes = [f"-I{HERE}", f"-I{library / 'src'}"]
        command = [f"{target}-g++", "-std=gnu++17", *options, *includes]
        run(*command, "-x", "c++", "-c", "-o", "/dev/null", source)


def test_the_archive_is_what_a_library_manager_reads(library: Path) -> None:
    properties = dict(line.split("=", 1) for line in (library / "library.properties").read_text().splitlines())
    assert re.fullmatch(r"\d+\.\d+\.\d+", properties["version"])
    assert {"name", "author", "maintainer", "sentence", "paragraph", "category", "url", "architectures"} <= {
        *properties
    }
    assert (library / "src" / properties["includes"]).exists()


def test_the_library_names_the_projects_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As the package does, where $SKG_HOME says what it is."""
    monkeypatch.setenv("SKG_HOME", "https://example.org/skg/")
    release.write(tmp_path / "SKG")
    rows = dict(row.split("=", 1) for row in (tmp_path / "SKG" / "library.properties").read_text().splitlines())
    assert rows["url"] == "https://example.org/skg" and not [row for row in rows.values() if not row or "@" in row]
