"""The C sources with other compilers than gcc, without a warning; skipped with a word where a compiler is missing.

clang: everything, and an example is run. mingw (Windows): what has no terminal, as the libraries of the Python package.
"""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
#: What `make` needs of the tree to build the emulator and the libraries.
TREE = [
    "Makefile",
    "emu",
    "roms",
    "tools/skg/native",
    "tests/emu/plain8080.h",
    "examples/xy-star.skg",
    *(str(path.relative_to(ROOT)) for part in ("asm", "tools", "web", "tests/*") for path in ROOT.glob(f"{part}/*.mk")),
]
MINGW = "x86_64-w64-mingw32-gcc"
#: What the package builds -> its list in emu/emu.mk, beside the processor; None: the controller's steps.
PARTS = {"skg80": "EMU_LIBRARY", "translate": "EMU_TRANSLATE", "skgsim": None}


def need(compiler: str, package: str) -> None:
    if not shutil.which(compiler):
        pytest.skip(f"no {compiler} here: apt-get install {package}")


def test_clang(tmp_path: Path) -> None:
    need("clang", "clang")
    for name in TREE:
        target = tmp_path / name
        target.parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if (ROOT / name).is_dir() else shutil.copy)(ROOT / name, target)
    options = ["CC=clang", "CFLAGS=-Werror", "TOOLS_CFLAGS=-O3 -std=c11 -Wall -Wextra -Wpedantic -Werror"]
    done = subprocess.run(["make", *options, "emu", "tools"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "clang" in done.stdout and "gcc" not in done.stdout
    done = subprocess.run(["build/skg80", "examples/xy-star.skg"], cwd=tmp_path, capture_output=True)
    assert (done.returncode, done.stdout) == (0, (ROOT / "examples" / "xy-star.3b").read_bytes())


def sources(name: str | None) -> list[str]:
    """The C files of a list, as make has them."""
    if name is None:
        return ["tools/skg/native/skgsim.c"]
    rule = f"--eval=listed: ; @echo $({name})"
    files = subprocess.run(["make", "-s", rule, "listed"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    return ["emu/i8080.c", *files.split()]


@pytest.mark.parametrize("name", PARTS)
def test_mingw(tmp_path: Path, name: str) -> None:
    need(MINGW, "gcc-mingw-w64-x86-64")
    library = tmp_path / f"{name}.dll"
    command = [MINGW, "-O0", "-std=c11", "-D_DEFAULT_SOURCE", "-Wall", "-Wextra", "-Werror", "-shared", "-o", library]
    done = subprocess.run([*command, *sources(PARTS[name])], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert library.read_bytes().startswith(b"MZ")
