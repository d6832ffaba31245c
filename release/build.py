"""Builds what a release gives to people, for all systems from one: dist/.

The compiler is zig's (PyPI's ziglang), which brings the C library of every target along. Each wheel is built from the
source distribution, in a folder of its own: what is in dist/ can be built again from what is in dist/.

    release/build.py [--only PART]...       all, or files whose names have these parts
"""

from __future__ import annotations

import argparse
import gzip
import hashlib
import importlib.util
import io
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import textwrap
import time
import tomllib
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import notices
import windows

ROOT = Path(__file__).resolve().parents[1]
DIST = ROOT / "dist"
README = ROOT / "README.md"
PICO = ROOT / "build" / "pico" / "skg-pico.uf2"
VERSION = tomllib.loads((ROOT / "tools" / "pyproject.toml").read_text())["project"]["version"]
_OF_ALL_ROMS = (
    "A .bin has 8,192 bytes, at 0000; RAM is from 2000H up (RC2014, boards with an 8085: 8000H). The .hex of the same "
    "name is the same in Intel hex. Every image but skg-8085 runs on an 8080, an 8085 and a Z80. Wiring: "
    "docs/boards.md of the project. For CP/M's LOAD take skg-cpm.hex of the zip for CP/M, not skg.hex."
)


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
    made = DIST / run(sys.executable, "-c", hook, cwd=ROOT / "tools").split()[-1]
    made.write_bytes(_settled(made.read_bytes(), int(os.environ["SOURCE_DATE_EPOCH"])))
    return made


def _settled(packed: bytes, seconds: int) -> bytes:
    """A tar.gz with its files in order, of one time (s since 1970) and of nobody: the bytes follow from the files."""
    text = io.BytesIO()
    with tarfile.open(fileobj=io.BytesIO(packed)) as old, tarfile.open(fileobj=text, mode="w") as new:
        for entry in sorted(old.getmembers(), key=lambda entry: entry.name):
            entry.mtime, entry.uid, entry.gid, entry.uname, entry.gname, entry.pax_headers = seconds, 0, 0, "", "", {}
            entry.mode = 0o755 if entry.isdir() else 0o644
            new.addfile(entry, old.extractfile(entry) if entry.isfile() else None)
    return gzip.compress(text.getvalue(), mtime=seconds)


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


def skg80_notices() -> Path:
    """The licences of what zig puts into skg80. (What is for macOS takes the system's library.)"""
    made = DIST / f"skg80-{VERSION}-NOTICES.txt"
    library = Path(importlib.util.find_spec("ziglang").origin).parent / "lib" / "libc"
    parts = [
        notices.of_file("musl", "", "MIT, in skg80 for Linux", library / "musl" / "COPYRIGHT"),
        notices.of_file("mingw-w64", "", "in skg80 for Windows", library / "mingw" / "COPYING"),
    ]
    text = notices.written("skg80 holds these works of others, under their licences:", parts)
    # (Notepad wants a mark and its own line ends)
    made.write_text(text, encoding="utf-8-sig", newline="\r\n")
    return made


def _zip(name: str, files: Iterable[tuple[Path, str]]) -> Path:
    """A zip of files in a folder of its own name."""
    made = DIST / name
    return windows.pack(made, [(file, f"{made.stem}/{inside}") for file, inside in files])


def roms() -> Path:
    """The ROM images. (A zip's listing has the CRC-32 of each.)"""
    images = sorted((ROOT / "roms").iterdir())
    with tempfile.TemporaryDirectory() as folder:
        about = Path(folder) / "README.txt"
        about.write_text(rom_list([image.name for image in images]), encoding="utf-8")
        files = [*images, PICO, about]
        return _zip(
            f"skg-roms-{VERSION}.zip", [*((file, file.name) for file in files), (ROOT / "LICENSE", "LICENSE.txt")]
        )


def rom_list(images: list[str]) -> str:
    """Which image is for which machine, as README.md has it; an image that is not there is an error."""
    rows: dict[str, str] = {}
    for machine, files in re.findall(r"^\| (.+?) \| (`roms/.*) \|$", README.read_text(encoding="utf-8"), re.M):
        # (links are of no use in a text; the row of some machines has as many files)
        plain = re.sub(r" ?\((?:\[[^]]*\]\([^)]*\)(?:, )?)+\)", "", machine).replace("`", "").replace("roms/", "")
        each = plain.split("; ")
        names = re.findall(r"`roms/([\w.-]+)`", files)
        if len(names) > 1 and len(names) != len(each):
            raise SystemExit(f"README.md: {len(each)} machines, but {len(names)} files: {machine}")
        for file, one in zip(names, each if len(names) > 1 else [plain], strict=True):
            rows[file] = f"{rows[file]}; {one}" if file in rows else one
    rows["skg.sym"] = "names of the standard ROM, for skg80 --debug"
    rows[PICO.name] = "a Raspberry Pi Pico: drop the file on it"
    twins = {f"{Path(file).stem}.hex" for file in rows if file.endswith(".bin")}
    if missing := set(images) - rows.keys() - twins:
        raise SystemExit(f"README.md does not say what these are for: {', '.join(sorted(missing))}")
    lines = [f"SKG {VERSION}: which file is for which machine", ""]
    for file, machine in rows.items():
        lines += textwrap.wrap(f"  {file:22} {machine}", 100, subsequent_indent=" " * 25, break_on_hyphens=False)
    lines += ["", *textwrap.wrap(_OF_ALL_ROMS, 100)]
    return "\r\n".join([*lines, ""])


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
    if not any(file.name == "NOTICES.txt" for file in files):
        raise SystemExit("web/dist has no NOTICES.txt")
    inside = [(file, str(file.relative_to(ROOT / "web" / "dist"))) for file in files]
    return _zip(f"skg-page-{VERSION}.zip", [*inside, (ROOT / "LICENSE", "LICENSE.txt")])


def windows_folder() -> Path:
    """SKG for Windows without Python: a folder to unpack, with skg.exe."""
    name = f"skg-windows-{VERSION}"
    with tempfile.TemporaryDirectory(prefix="skg-windows-") as scratch:
        folder = Path(scratch)
        windows.build(next(DIST.glob("skg_nc-*-win_amd64.whl")), VERSION, folder)
        # (Notepad wants a mark and its own line ends)
        for file, text in {
            "README.txt": (windows.HERE / "README.txt").read_text(encoding="utf-8"),
            "LICENSE.txt": (ROOT / "LICENSE").read_text(encoding="utf-8"),
            "NOTICES.txt": windows.licences(folder / "python" / "packages"),
        }.items():
            (folder / file).write_text(text, encoding="utf-8-sig", newline="\r\n")
        files = sorted(file for file in folder.rglob("*") if file.is_file())
        return _zip(f"{name}.zip", [(file, file.relative_to(folder).as_posix()) for file in files])


def sums() -> Path:
    """The SHA-256 of every other file, as `sha256sum -c` takes them."""
    made = DIST / "SHA256SUMS"
    # (a wheel's build that was broken off leaves a folder)
    files = sorted(file for file in DIST.iterdir() if file.is_file() and file != made)
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
        ("skg80-NOTICES", skg80_notices),
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
    # (it holds the wheel for Windows)
    if not only or any(part in "skg-windows.zip" for part in only):
        told(windows_folder)
    told(sums)


if __name__ == "__main__":
    main()
