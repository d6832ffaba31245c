"""The package as people install it: source distribution, wheel out of that, a new environment, another directory.

The C libraries are built anew, unoptimized, which is sooner done. What the package depends on is lent by this
environment, so that nothing is fetched; that all of it is named and fits is what `pip check` tells.
"""

from __future__ import annotations

import fcntl
import os
import shutil
import subprocess
import sys
import sysconfig
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
#: Two examples: one short, one of many blocks. (The image itself is compared in tests/rom.)
PARTS = ("xy-star", "fit-gear")

#: In the process that has made the package; the others would wait for it.
pytestmark = pytest.mark.xdist_group("package")

Shell = Callable[..., subprocess.CompletedProcess[str]]


def succeed(*command: object, cwd: Path) -> str:
    """Run a command that must end well; what it prints."""
    environment = {**os.environ, "CFLAGS": "-O0"}
    done = subprocess.run([str(word) for word in command], cwd=cwd, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def build(kind: str, folder: Path, cwd: Path) -> Path:
    """Build the `sdist` or the `wheel` of the project in `cwd`, as pip does, into a folder."""
    hook = f"import setuptools.build_meta as b; print(b.build_{kind}({str(folder)!r}))"
    return folder / succeed(sys.executable, "-c", hook, cwd=cwd).split()[-1]


def install(folder: Path) -> None:
    """Build the wheel from the source distribution, far from the project's tree; install it into a new environment."""
    # (setuptools writes into the tree: one process after the other)
    with (ROOT / "build" / "sdist.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        packed = build("sdist", folder, ROOT / "tools")
    shutil.unpack_archive(packed, folder)
    wheel = build("wheel", folder, folder / packed.name.removesuffix(".tar.gz"))
    succeed(sys.executable, "-m", "venv", "--without-pip", "env", cwd=folder)
    pip = [sys.executable, "-m", "pip", "--python", folder / "env" / "bin" / "python"]
    succeed(*pip, "install", "-q", "--no-deps", "--no-index", wheel, cwd=folder)
    inside = next((folder / "env" / "lib").glob("python3*")) / "site-packages"
    # What the package depends on, but not this environment's own skg: that one is found through a .pth file.
    (inside / "lent.pth").write_text(sysconfig.get_path("purelib"))
    (folder / "elsewhere").mkdir()


@pytest.fixture(scope="module")
def user(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the wheel, the environment and an empty directory."""
    folder = tmp_path_factory.mktemp("package")
    install(folder)
    return folder


@pytest.fixture
def wheel(user: Path) -> Path:
    """The wheel."""
    return next(user.glob("*.whl"))


@pytest.fixture
def skg(user: Path) -> Shell:
    """`skg` of the new environment, called in the empty directory; `program` names another one."""
    variables = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "SKG"))}

    cwd = user / "elsewhere"

    def call(*words: object, program: str = "skg") -> subprocess.CompletedProcess[str]:
        command = [str(user / "env" / "bin" / program), *map(str, words)]
        return subprocess.run(command, cwd=cwd, env=variables, capture_output=True, text=True)

    return call


def test_is_what_was_installed(skg: Shell, user: Path) -> None:
    where = skg("-c", "import skg; print(skg.__file__)", program="python").stdout
    assert where.startswith(str(user))


def test_wheel_is_complete(wheel: Path) -> None:
    """Every module and image of the tree, the libraries, grammars, messages, machines, the page, and no leftovers."""
    names = set(zipfile.ZipFile(wheel).namelist())
    modules = {str(path.relative_to(ROOT / "tools")) for path in (ROOT / "tools" / "skg").rglob("*.py")}
    images = {f"skg/board/roms/{path.name}" for path in (ROOT / "roms").glob("*.bin")}
    grammars = {str(path.relative_to(ROOT / "tools")) for path in (ROOT / "tools" / "skg").rglob("*.lark")}
    rest = {"skg/native/libskgsim.so", "skg/native/libskg80.so", "skg/LICENSE"} | grammars
    rest |= {str(path.relative_to(ROOT / "tools")) for path in (ROOT / "tools" / "skg" / "dialects").glob("*.toml")}
    rest |= {f"skg/messages/{path.stem}.mo" for path in (ROOT / "tools" / "skg" / "messages").glob("*.po")}
    page = {f"skg/ui/assets/{name}" for name in ("index.html", "ui.js", "ui.css")}
    assert len(grammars) >= 2
    assert len(images) >= 4
    assert {name for name in names if ".dist-info/" not in name} == modules | images | page | rest
    assert wheel.name.startswith("skg_nc-") and "-py3-none-linux_" in wheel.name


def test_dependencies_are_named(skg: Shell) -> None:
    done = skg("-m", "pip", "check", program="python")
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize("part", PARTS)
def test_run_and_simulate(skg: Shell, part: str, tmp_path: Path) -> None:
    program, tape = tmp_path / "part.skg", tmp_path / "part.3b"
    shutil.copy(ROOT / "examples" / f"{part}.skg", program)
    done = skg("run", program, "-o", tape)
    assert done.returncode == 0, done.stderr
    assert tape.read_bytes() == (ROOT / "examples" / f"{part}.3b").read_bytes()
    done = skg("sim", tape)
    assert done.returncode == 0, done.stderr
    assert f"{tape}: {tape.read_bytes().count(b'G')} blocks" in done.stdout


def test_every_command_starts(skg: Shell) -> None:
    from skg.cli import COMMANDS as here

    for name in here:
        done = skg(name, "--help")
        assert (done.returncode, done.stderr) == (0, ""), name


def test_board_in_python(skg: Shell) -> None:
    done = skg("-c", "import skg; print(skg.Board('no-drift').type('PRINT 2*3'))", program="python")
    assert (done.stdout, done.stderr) == ("['6']\n", "")
