"""Builds the package's C libraries, compiles its messages, takes in the ROM images; all else stands in pyproject.toml.

The emulator's sources (emu/), the images (roms/) and the examples are the project's, beside this folder. The source
distribution has copies of them, so that a wheel can be built from it too. An editable install builds the libraries
where make has them, in build/, and reads the images in roms/.
"""

from __future__ import annotations

import atexit
import os
import shlex
import shutil
import subprocess
import tempfile
from pathlib import Path

from polib import pofile
from setuptools import Distribution, setup
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build import build
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

HERE = Path(__file__).resolve().parent
#: Where emu/ and roms/ lie: here in an unpacked source distribution, else in the project above.
ABOVE = HERE if (HERE / "emu").is_dir() else HERE.parent
EMU = ABOVE / "emu"


#: For the emulator's C files.
OPTIONS = ["-O2", "-std=c11", "-D_DEFAULT_SOURCE"]
#: The packager's own options, behind all others.
CFLAGS = shlex.split(os.environ.get("CFLAGS", ""))


def listed(name: str) -> list[str]:
    """The words of a list that emu/emu.mk reads, too."""
    return (EMU / name).read_text().split()


#: Library -> its sources and the compiler's options; tools.mk has the first for developers.
LIBRARIES = {
    "libskgsim.so": ([HERE / "skg/native/skgsim.c"], ["-O3", "-std=c11", *CFLAGS]),
    "libskg80.so": ([EMU / source for source in listed("library.txt")], [*OPTIONS, "-DWITH_TRANSLATIONS", *CFLAGS]),
}


def compiler() -> list[str]:
    """The C compiler: $CC, else the first that is there."""
    for name in (os.environ.get("CC"), "cc", "gcc", "clang"):
        if name and shutil.which(shlex.split(name)[0]):
            return shlex.split(name)
    raise SystemExit("skg: no C compiler; install one (Debian: apt-get install gcc) or name it in CC")


def compile_into(folder: Path) -> None:
    """Build the libraries that are older than their sources."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, (sources, options) in LIBRARIES.items():
        made = folder / name
        newest = max(path.stat().st_mtime for source in sources for path in source.parent.glob("*.[ch]"))
        if not made.exists() or made.stat().st_mtime < newest:
            with tempfile.TemporaryDirectory() as scratch:
                objects = translations(Path(scratch)) if "-DWITH_TRANSLATIONS" in options else []
                run_compiler(compiler(), "-shared", "-fPIC", *options, "-o", Path(scratch) / name, *sources, *objects)
                # (a compiler for Windows leaves more beside it)
                shutil.copy(Path(scratch) / name, made)


def run_compiler(command: list[str], *words: str | Path) -> None:
    """Compile, or raise what the compiler ended with; it says why itself."""
    subprocess.run([*command, *words], check=True)


def translations(folder: Path) -> list[Path]:
    """The ROMs that the board runs most often, translated into C and compiled.

    The translator runs here: where $CC compiles for another system, $CC_FOR_BUILD compiles for this one.
    """
    here = shlex.split(os.environ.get("CC_FOR_BUILD", "")) or compiler()
    sources = [EMU / source for source in ("translate.c", *listed("library.txt"))]
    # (sooner compiled, and as fast for these examples)
    run_compiler(here, *OPTIONS, "-O1", "-o", folder / "translate", *sources)
    parts = sorted((ABOVE / "examples").glob("*.skg"))
    objects = []
    for image in listed("translated.txt"):
        rows, made = folder / f"{image}.rows", folder / f"{image}.o"
        with rows.open("wb") as file:
            subprocess.run([folder / "translate", ABOVE / "roms" / f"{image}.bin", *parts], stdout=file, check=True)
        names = ["-fPIC", f"-DNAME=translation_{image.replace('-', '_')}", f'-DROWS="{rows}"']
        run_compiler(compiler(), *OPTIONS, "-O1", *CFLAGS, *names, "-c", "-o", made, EMU / "i8080_translated.c")
        objects.append(made)
    return objects


class Build(build):
    """Builds in a folder of its own: what an earlier build left behind must not get into a wheel."""

    def initialize_options(self) -> None:
        super().initialize_options()
        self.build_base = tempfile.mkdtemp(prefix="skg-build-")
        atexit.register(shutil.rmtree, self.build_base, ignore_errors=True)


class BuildPackage(build_py):
    """The modules, the libraries and the images."""

    def run(self) -> None:
        super().run()
        if self.editable_mode:
            compile_into(HERE.parent / "build")
            return
        package = Path(self.build_lib) / "skg"
        compile_into(package / "native")
        for messages in sorted((HERE / "skg" / "messages").glob("*.po")):
            pofile(str(messages)).save_as_mofile(str(package / "messages" / f"{messages.stem}.mo"))
        roms = package / "board" / "roms"
        roms.mkdir(parents=True, exist_ok=True)
        for image in sorted((ABOVE / "roms").glob("*.bin")):
            shutil.copy(image, roms)
        shutil.copy(ABOVE / "LICENSE", package)


class Native(Distribution):
    """Not for every platform, though there are no extension modules: the libraries are loaded with ctypes."""

    def has_ext_modules(self) -> bool:
        return True


class Wheel(bdist_wheel):
    """A wheel for one platform and any Python 3."""

    def get_tag(self) -> tuple[str, str, str]:
        return "py3", "none", super().get_tag()[2]


class SourceDistribution(sdist):
    """With the emulator's sources, the images, and the examples that show what of these is instructions."""

    def make_release_tree(self, base_dir: str, files: list[str]) -> None:
        super().make_release_tree(base_dir, files)
        for folder, pattern in (("emu", "*.[ch]"), ("emu", "*.txt"), ("roms", "*.bin"), ("examples", "*.skg")):
            target = Path(base_dir) / folder
            target.mkdir(exist_ok=True)
            for file in sorted((ABOVE / folder).glob(pattern)):
                shutil.copy(file, target)
        shutil.copy(ABOVE / "LICENSE", base_dir)


def addresses() -> dict[str, str]:
    """The project's pages, where $SKG_HOME says where they are."""
    home = os.environ.get("SKG_HOME", "").rstrip("/")
    pages = {"Documentation": "docs/shop.md", "Changelog": "CHANGELOG.md"}
    found = {"Homepage": home, "Issues": f"{home}/issues"}
    found |= {name: f"{home}/blob/main/{page}" for name, page in pages.items()}
    return found if home else {}


setup(
    project_urls=addresses(),
    distclass=Native,
    cmdclass={"build": Build, "build_py": BuildPackage, "bdist_wheel": Wheel, "sdist": SourceDistribution},
)
