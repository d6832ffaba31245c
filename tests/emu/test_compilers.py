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
    "release/release.mk",
    "tools/pyproject.toml",
    "examples/xy-star.skg",
    *(str(path.relative_to(ROOT)) for part in ("asm", "tools", "web", "tests/*") for path in ROOT.glob(f"{part}/*.mk")),
]
MINGW = "x86_64-w64-mingw32-gcc"
LIBRARY = [f"emu/{name}" for name in (ROOT / "emu" / "library.txt").read_text().split()]
#: What the package builds -> its C files.
PARTS = {
    "skg80": LIBRARY,
    "translate": ["emu/translate.c", *LIBRARY],
    "skgsim": ["tools/skg/native/skgsim.c"],
}


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


@pytest.mark.parametrize("name", PARTS)
def test_mingw(tmp_path: Path, name: str) -> None:
    need(MINGW, "gcc-mingw-w64-x86-64")
    library = tmp_path / f"{name}.dll"
    command = [MINGW, "-O0", "-std=c11", "-D_DEFAULT_SOURCE", "-Wall", "-Wextra", "-Werror", "-shared", "-o", library]
    done = subprocess.run([*command, *PARTS[name]], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert library.read_bytes().startswith(b"MZ")
