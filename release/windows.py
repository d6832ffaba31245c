"""SKG for Windows as a folder that is only unpacked: Python, the packages, and skg.exe, which starts them.

CPython comes from Maven, the packages from PyPI, each by its hash (windows.lock). What no tape needs is left out.
The modules are compiled here, by the same version of CPython, and their sources left out: the first start is as quick
as the next, on a disk that takes no files, too, and there is half as much to unpack.

    release/windows.py      writes windows.lock anew: the versions of tools/constraints.txt
"""

from __future__ import annotations

import hashlib
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import zipfile
from collections.abc import Iterable, Iterator
from email.parser import Parser
from fnmatch import fnmatch
from pathlib import Path

import maven
import notices
from packaging.requirements import Requirement

ROOT = Path(__file__).resolve().parents[1]
HERE = ROOT / "release" / "windows"
LOCK = ROOT / "release" / "windows.lock"
PYTHON = "3.14"
#: What pip asks a package index for.
ASKED = ["--platform=win_amd64", f"--python-version={PYTHON}", "--implementation=cp", "--only-binary=:all:"]
#: Of CPython: what is left out. (OpenSSL: nothing is fetched; _wmi is a slow way to Windows' version.)
NOT_OF_PYTHON = (
    "bin/*", "include/*", "libs/*", "share/*", "ready", "ucrtbase.dll", "api-ms-*", "concrt140.dll", "libomp140*",
    "msvcp140_[12].dll", "vcomp140.dll", "vcruntime140_threads.dll", "lib/vcruntime140*", "lib/test/*", "lib/pip*",
    "lib/ensurepip/*", "lib/venv/*", "lib/idlelib/*", "lib/tkinter/*", "lib/turtle*", "lib/pydoc_data/*",
    "lib/sqlite3/*", "lib/curses/*", "lib/_pyrepl/*", "lib/_test*", "lib/_ctypes_test.pyd", "lib/xxlimited*",
    "lib/_tkinter.pyd", "lib/t[ck]l86t.dll", "lib/tk86t.dll", "lib/_sqlite3.pyd", "lib/sqlite3.dll", "lib/_ssl.pyd",
    "lib/_hashlib.pyd",
    "lib/libssl-3.dll", "lib/libcrypto-3.dll", "lib/pyshellext.dll", "lib/_wmi.pyd", "*/__pycache__/*", "lib/zlib1.dll",
    "lib/site-packages/*", "lib/__phello__/*", "msvcp140.dll",
)  # fmt: skip
#: Of packages: their tests, what compilers want, a codec for pictures that nobody writes here, scripts.
NOT_OF_PACKAGES = (
    "*/tests/*", "*/test/*", "test/*", "*.pyi", "*.h", "*.lib", "*.a", "*.c", "*.cpp", "*.pxd", "*.pyx", "PIL/_avif.*",
    "*.data/*", "*/RECORD", "matplotlib/mpl-data/sample_data/*",
)  # fmt: skip
#: Packages with their sources: their licence wants these.
WITH_SOURCES = ("tqdm",)
#: Files in zips are of this time: the same tree gives the same bytes.
ZIP_TIME = (1980, 1, 1, 0, 0, 0)
#: The environment that a package's conditions are read in.
MARKERS = {
    "python_version": PYTHON, "python_full_version": f"{PYTHON}.3", "sys_platform": "win32", "os_name": "nt",
    "platform_system": "Windows", "platform_machine": "AMD64", "implementation_name": "cpython",
    "platform_python_implementation": "CPython", "implementation_version": f"{PYTHON}.3", "platform_release": "",
    "platform_version": "", "extra": "",
}  # fmt: skip


def wanted() -> list[str]:
    """What the package needs on Windows, with its pictures, as pyproject.toml says it."""
    project = tomllib.loads((ROOT / "tools" / "pyproject.toml").read_text())["project"]
    return [*project["dependencies"], *project["optional-dependencies"]["sheet"]]


def locked() -> dict[str, tuple[str, set[str]]]:
    """The packages of windows.lock: name -> version, SHA-256 of its wheels."""
    rows = re.findall(r"^([\w.-]+)==(\S+)((?: --hash=sha256:[0-9a-f]{64})+)$", LOCK.read_text(), re.M)
    return {name: (version, set(re.findall("sha256:(.{64})", sums))) for name, version, sums in rows}


def applies(requirement: Requirement) -> bool:
    """Whether a requirement is one on Windows."""
    return requirement.marker is None or requirement.marker.evaluate(MARKERS)


def write_lock() -> None:
    """Ask for the packages in the versions of the tests, and note their hashes."""
    with tempfile.TemporaryDirectory() as folder:
        asked = Path(folder) / "wanted.txt"
        # (pip reads conditions for its own system: what these two ask for on Windows alone)
        asked.write_text("\n".join([*wanted(), "colorama"]))
        _run(sys.executable, "-m", "pip", "download", "-q", "-d", folder, *ASKED, "-r", asked,
             "-c", ROOT / "tools" / "constraints.txt")  # fmt: skip
        rows = []
        for wheel in Path(folder).glob("*.whl"):
            name, version = wheel.name.split("-")[:2]
            sha = hashlib.sha256(wheel.read_bytes()).hexdigest()
            rows.append(f"{re.sub('[-_.]+', '-', name).lower()}=={version} --hash=sha256:{sha}\n")
    head = "# The packages of the zip for Windows, for CPython 3.14. `release/windows.py` writes this anew.\n"
    LOCK.write_text(head + "".join(sorted(rows)))


def build(wheel: Path, version: str, folder: Path) -> Path:
    """Make the folder `python` and skg.exe in a folder; `wheel`: the package for Windows."""
    python, packages = folder / "python", folder / "python" / "packages"
    for name, file in _kept(maven.python(PYTHON, "windows-x86_64"), NOT_OF_PYTHON):
        (python / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, python / name)
    # (with this file Python looks at no variable and no folder of the system)
    library = python / f"python{PYTHON.replace('.', '')}.zip"
    library.with_suffix("._pth").write_text(f"{library.name}\nlib\npackages\n")
    with tempfile.TemporaryDirectory() as store:
        _run(
            sys.executable,
            "-m",
            "pip",
            "download",
            "-q",
            "-d",
            store,
            *ASKED,
            "--no-deps",
            "--require-hashes",
            "-r",
            LOCK,
        )
        for one in [*sorted(Path(store).glob("*.whl")), wheel]:
            with zipfile.ZipFile(one) as packed:
                for name in packed.namelist():
                    if not name.endswith("/") and not any(fnmatch(name, pattern) for pattern in NOT_OF_PACKAGES):
                        packed.extract(name, packages)
    compiler = maven.python(PYTHON, "linux-x86_64") / "bin" / f"python{PYTHON}"
    words = [
        "-m",
        "compileall",
        "-b",
        "-q",
        "--invalidation-mode",
        "unchecked-hash",
        "-s",
        python,
        "-p",
        "python",
        python,
    ]
    # (a constant's bytes depend on whether a module of the compiler's own came from a file .pyc: none does)
    with tempfile.TemporaryDirectory() as empty:
        _run(compiler, *words, PYTHONHASHSEED="0", PYTHONDONTWRITEBYTECODE="1", PYTHONPYCACHEPREFIX=empty)
    for source in python.rglob("*.py"):
        if not source.is_relative_to(packages) or source.relative_to(packages).parts[0] not in WITH_SOURCES:
            source.unlink()
    modules = sorted((python / "lib").rglob("*.pyc"))
    pack(library, [(file, file.relative_to(python / "lib").as_posix()) for file in modules])
    for file in modules:
        file.unlink()
    program(version, folder)
    return folder


def pack(made: Path, files: Iterable[tuple[Path, str]]) -> Path:
    """Make a zip of files, each with its name there, in the order of these names."""
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as packed:
        for file, inside in sorted(files, key=lambda each: each[1]):
            entry = zipfile.ZipInfo(inside, ZIP_TIME)
            entry.external_attr, entry.compress_type = 0o644 << 16, zipfile.ZIP_DEFLATED
            packed.writestr(entry, file.read_bytes())
    return made


def licences(packages: Path) -> str:
    """The licences of all that the folder holds but SKG."""
    zig = Path(importlib.util.find_spec("ziglang").origin).parent
    own = Parser().parsestr((next(packages.glob("skg_nc-*.dist-info")) / "METADATA").read_text(encoding="utf-8"))
    every = [
        notices.of_file("CPython", maven.PYTHONS[PYTHON].partition("-")[0], "PSF-2.0", notices.TEXTS / "cpython.txt"),
        notices.of_file("CPython's libraries", "", "see below", notices.TEXTS / "cpython-libraries.txt"),
        *(one for one in notices.of_packages(packages) if one.name != own["Name"]),
        notices.of_file("mingw-w64", "", "in skg.exe and SKG's libraries", zig / "lib" / "libc" / "mingw" / "COPYING"),
    ]
    return notices.written("SKG for Windows holds these works of others, under their licences:", every)


def _kept(folder: Path, but: tuple[str, ...]) -> Iterator[tuple[str, Path]]:
    for file in sorted(folder.rglob("*")):
        name = file.relative_to(folder).as_posix()
        if file.is_file() and not any(fnmatch(name, pattern) for pattern in but):
            yield name, file


def program(version: str, folder: Path) -> Path:
    """Compile skg.exe into a folder."""
    zig = [sys.executable, "-m", "ziglang"]
    numbers = ",".join([*version.split("."), "0"])
    with tempfile.TemporaryDirectory() as scratch:
        resources = Path(scratch) / "skg.res"
        words = ["-D", f"SKG_NUMBERS={numbers}", "-D", f'SKG_VERSION="{version}"', "/fo", resources, "skg.rc"]
        _run(*zig, "rc", "/:auto-includes", "gnu", *words, cwd=HERE)
        options = ["-target", "x86_64-windows-gnu", "-s", "-O2", "-std=c11", "-Wall", "-Wextra", "-Werror"]
        made = Path(scratch) / "skg.exe"
        _run(*zig, "cc", *options, "-o", made, "skg.c", resources, "-lshell32", cwd=HERE)
        shutil.copyfile(made, folder / "skg.exe")
    return folder / "skg.exe"


def _run(*command: object, cwd: Path = ROOT, **variables: str) -> None:
    words = [str(word) for word in command]
    done = subprocess.run(words, cwd=cwd, env={**os.environ, **variables}, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{' '.join(words)}\n{done.stdout}{done.stderr}")


if __name__ == "__main__":
    write_lock()
