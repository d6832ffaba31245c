"""Builds what a release gives to people, for all systems from one: dist/.

The compiler is zig's (PyPI's ziglang), which brings the C library of every target along. Each wheel is built from the
source distribution, in a folder of its own: what is in dist/ can be built again from what is in dist/.

    release/build.py [--only PART]...       all, or files whose names have these parts
"""

from __future__ import annotations

import argparse
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
import zipfile
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
DIST = ROOT / "dist"
PICO = ROOT / "build" / "pico" / "skg-pico.uf2"
VERSION = tomllib.loads((ROOT / "tools" / "pyproject.toml").read_text())["project"]["version"]
#: Zips hold no earlier time than this, and no file's own: the same tree gives the same bytes.
_ZIP_TIME = (1980, 1, 1, 0, 0, 0)


@dataclass(frozen=True)
class Target:
    """A system: as zig calls it, and as the names of a wheel and of `skg80` do; None: none is made of it."""

    zig: str
    wheel: str | None
    skg80: str | None

    @property
    def compiler(self) -> list[str]:
        """The C compiler for it; without names of debugging."""
        return [sys.executable, "-m", "ziglang", "cc", "-target", self.zig, "-s"]


TARGETS = (
    Target("x86_64-windows-gnu", "win_amd64", "windows-x86_64.exe"),
    Target("aarch64-macos.11.0", "macosx_11_0_arm64", "macos-arm64"),
    Target("x86_64-macos.11.0", "macosx_11_0_x86_64", "macos-x86_64"),
    Target("x86_64-linux-gnu.2.17", "manylinux_2_17_x86_64", None),
    Target("aarch64-linux-gnu.2.17", "manylinux_2_17_aarch64", None),
    Target("x86_64-linux-musl", "musllinux_1_2_x86_64", "linux-x86_64"),
    Target("aarch64-linux-musl", None, "linux-aarch64"),
)


def run(*command: object, cwd: Path = ROOT, **variables: str) -> str:
    """Run a command that must end well; returns what it prints."""
    words = [str(word) for word in command]
    done = subprocess.run(words, cwd=cwd, env={**os.environ, **variables}, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{' '.join(words)}\n{done.stdout}{done.stderr}")
    if done.stderr and " cc " in " ".join(words):
        print(done.stderr, file=sys.stderr)
    return done.stdout


def source_distribution() -> Path:
    """The package's sources, from which every wheel is built."""
    hook = f"import setuptools.build_meta as b; print(b.build_sdist({str(DIST)!r}))"
    return DIST / run(sys.executable, "-c", hook, cwd=ROOT / "tools").split()[-1]


def wheel(target: Target) -> Path:
    """The package for a system."""
    sources = next(DIST.glob("skg_nc-*.tar.gz"))
    with tempfile.TemporaryDirectory(prefix="skg-wheel-") as folder:
        shutil.unpack_archive(sources, folder)
        settings = {"--build-option": ["--plat-name", target.wheel]}
        hook = f"import setuptools.build_meta as b; print(b.build_wheel({str(DIST)!r}, {settings!r}))"
        variables = {"CC": " ".join(target.compiler), "CC_FOR_BUILD": os.environ.get("CC", "cc")}
        made = run(sys.executable, "-c", hook, cwd=next(Path(folder).iterdir()), **variables).split()[-1]
    return DIST / made


def _listed(name: str) -> list[str]:
    """The words of a list in emu/emu.mk, as make has it."""
    text = f"include emu/emu.mk\nlisted: ; @echo $({name})\n"
    done = subprocess.run(["make", "-s", "-f", "-", "listed"], cwd=ROOT, input=text, capture_output=True, text=True)
    return done.stdout.split()


def skg80(target: Target) -> Path:
    """The emulator for a system, its ROM built in."""
    made = DIST / f"skg80-{VERSION}-{target.skg80}"
    sources = [f"emu/{name}" for name in _listed("EMU_PROGRAM")]
    if "windows" in target.zig:
        sources = [source.replace("terminal_posix", "terminal_windows") for source in sources]
    rom = ["-DSKG80_BUILT_IN_ROM", '-DSKG80_ROM="roms/skg.bin"', '-DSKG80_SYM="roms/skg.sym"', "emu/rom.S"]
    # (zig's cache does not see what .incbin takes in: another ROM is another command)
    taken_in = b"".join((ROOT / "roms" / name).read_bytes() for name in ("skg.bin", "skg.sym"))
    rom.append(f"-DTAKEN_IN={hashlib.sha256(taken_in).hexdigest()}")
    version = f'-DSKG80_VERSION="{VERSION}"'
    options = [*_listed("EMU_CFLAGS"), "-Werror", version]
    with tempfile.TemporaryDirectory(prefix="skg-skg80-") as folder:
        # (a compiler for Windows leaves more beside it)
        run(*target.compiler, *options, "-o", Path(folder) / made.name, *sources, *rom, "-lm")
        shutil.copy(Path(folder) / made.name, made)
    return made


def _zip(name: str, files: Iterable[tuple[Path, str]]) -> Path:
    """A zip of files in a folder of its own name."""
    made = DIST / name
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as packed:
        for file, inside in files:
            entry = zipfile.ZipInfo(f"{made.stem}/{inside}", _ZIP_TIME)
            entry.external_attr, entry.compress_type = 0o644 << 16, zipfile.ZIP_DEFLATED
            packed.writestr(entry, file.read_bytes())
    return made


def roms() -> Path:
    """The ROM images. (A zip's listing has the CRC-32 of each.)"""
    images = sorted((ROOT / "roms").iterdir())
    return _zip(f"skg-roms-{VERSION}.zip", [(file, file.name) for file in (*images, PICO, ROOT / "LICENSE")])


def cpm() -> Path:
    """What a CP/M machine takes (cpm.py, which wants the tests' CP/M)."""
    with tempfile.TemporaryDirectory(prefix="skg-cpm-") as folder:
        run(ROOT / ".venv" / "bin" / "python", "release/cpm.py", folder)
        files = sorted(file for file in Path(folder).rglob("*") if file.is_file())
        inside = [(file, file.relative_to(folder).as_posix()) for file in files]
        return _zip(f"skg-cpm-{VERSION}.zip", [*inside, (ROOT / "LICENSE", "LICENSE.TXT")])


def arduino() -> Path:
    """The Arduino library (arduino.py)."""
    with tempfile.TemporaryDirectory(prefix="skg-arduino-") as folder:
        run(sys.executable, "release/arduino.py", folder)
        files = sorted(file for file in Path(folder).rglob("*") if file.is_file())
        return _zip(f"skg-arduino-{VERSION}.zip", [(file, file.relative_to(folder).as_posix()) for file in files])


def pico() -> Path:
    """The machine for a Raspberry Pi Pico; `make release` has built it."""
    made = DIST / f"skg-pico-{VERSION}.uf2"
    shutil.copy(PICO, made)
    return made


def page() -> Path:
    """The web page: files for any web server."""
    run("make", "web")
    files = sorted(file for file in (ROOT / "web" / "dist").rglob("*") if file.is_file())
    inside = [(file, str(file.relative_to(ROOT / "web" / "dist"))) for file in files]
    return _zip(f"skg-page-{VERSION}.zip", [*inside, (ROOT / "LICENSE", "LICENSE.txt")])


def sums() -> Path:
    """The SHA-256 of every other file, as `sha256sum -c` takes them."""
    made = DIST / "SHA256SUMS"
    files = sorted(file for file in DIST.iterdir() if file != made)
    made.write_text("".join(f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.name}\n" for file in files))
    return made


def told(make: Callable[[], Path]) -> None:
    """Make a file, and print its name, size and the seconds that it took."""
    began = time.monotonic()
    made = make()
    print(f"{made.name:50} {made.stat().st_size:9,} bytes {time.monotonic() - began:6.0f} s", flush=True)


def main() -> None:
    """Build everything, two files at a time."""
    options = argparse.ArgumentParser(description="Build what a release gives to people, in dist/.")
    options.add_argument("--only", action="append", metavar="PART", help="what is built: names that have this part")
    only = options.parse_args().only
    changelog = re.search(r"^## ([\d.]+)", (ROOT / "CHANGELOG.md").read_text(), re.M)
    if not changelog or changelog[1] != VERSION:
        raise SystemExit(f"CHANGELOG.md does not begin with {VERSION}, the version of tools/pyproject.toml")
    os.environ.setdefault("SOURCE_DATE_EPOCH", run("git", "log", "-1", "--format=%ct").strip())
    os.environ.setdefault("ZIG_GLOBAL_CACHE_DIR", str(ROOT / "build" / "release" / "zig"))
    if not only:
        shutil.rmtree(DIST, ignore_errors=True)
    DIST.mkdir(exist_ok=True)
    works: list[tuple[str, Callable[[], Path]]] = [
        ("page.zip", page),
        ("roms.zip", roms),
        ("cpm.zip", cpm),
        ("arduino.zip", arduino),
        ("pico.uf2", pico),
    ]
    for target in TARGETS:
        if target.wheel:
            works.append((f"{target.wheel}.whl", lambda target=target: wheel(target)))
        if target.skg80:
            works.append((f"skg80-{target.skg80}", lambda target=target: skg80(target)))
    told(source_distribution)
    wanted = [work for name, work in works if not only or any(part in name for part in only)]
    with ThreadPoolExecutor(2) as pool:
        list(pool.map(told, wanted))
    told(sums)


if __name__ == "__main__":
    main()
