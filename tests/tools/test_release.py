"""The lists of what a release is made of: packages for Windows, licences, ROM images. `make release-test` tries what is
built of them.
"""

from __future__ import annotations

import importlib
import re
import sys
import sysconfig
from importlib.metadata import requires
from pathlib import Path

import pytest
from packaging.requirements import Requirement

ROOT = Path(__file__).parents[2]


@pytest.fixture(autouse=True)
def modules(monkeypatch: pytest.MonkeyPatch) -> None:
    """The modules of release/."""
    monkeypatch.syspath_prepend(str(ROOT / "release"))


def plain(name: str) -> str:
    """A package's name as indexes have it."""
    return re.sub(r"[-_.]+", "-", name).lower()


def test_windows_has_every_package_that_is_needed() -> None:
    """No more and no less, in the versions of the tests."""
    import windows

    needed, asked = {}, [Requirement(text) for text in windows.wanted()]
    while asked:
        requirement = asked.pop()
        name = plain(requirement.name)
        if windows.applies(requirement) and name not in needed:
            needed[name] = requirement
            # (colorama is for Windows alone, and asks for nothing)
            asked += [] if name == "colorama" else [Requirement(text) for text in requires(name) or ()]
    locked = windows.locked()
    assert set(locked) == set(needed)
    rows = (ROOT / "tools" / "constraints.txt").read_text().split("\n")
    tested = {plain(name): version for name, _, version in (row.partition("==") for row in rows if "==" in row)}
    assert {name: version for name, (version, _) in locked.items() if name in tested} == {
        name: version for name, version in tested.items() if name in locked
    }
    assert len(locked) > 20 and all(sums for _, sums in locked.values())
    assert not [row for row in windows.LOCK.read_text().splitlines()[1:] if not re.match(r"[\w.-]+==\S+ --hash=", row)]


def test_every_package_has_its_licence() -> None:
    import notices
    import windows

    site = Path(sysconfig.get_path("purelib"))
    every = list(notices.of_packages(site, windows.locked()))
    assert {plain(one.name) for one in every} >= set(windows.locked()) - {"colorama"}
    assert all(re.search("licen[cs]e|permission", one.text, re.I) and len(one.text) > 500 for one in every)
    text = notices.written("these", every)
    assert "GNU LESSER GENERAL PUBLIC LICENSE" in text and "libgeos.org" in text and "MPL" in text


def test_package_without_a_licence_is_refused(tmp_path: Path) -> None:
    import notices

    (tmp_path / "some_thing-1.dist-info").mkdir()
    (tmp_path / "some_thing-1.dist-info" / "METADATA").write_text("Name: some.thing\nVersion: 1\n")
    with pytest.raises(notices.NoLicence, match="some.thing"):
        list(notices.of_packages(tmp_path))


def test_every_rom_image_is_said_to_be_for_something(monkeypatch: pytest.MonkeyPatch) -> None:
    """In the list that goes with them, out of the table of "README.md"."""
    # (asm/ has a module of this name, too)
    monkeypatch.delitem(sys.modules, "build", raising=False)
    build = importlib.import_module("build")
    monkeypatch.delitem(sys.modules, "build")

    images = [file.name for file in (ROOT / "roms").iterdir()]
    text = build.rom_list(images)
    about = dict(re.findall(r"^  (\S+) +((?:.|\r\n {25})+)", text, re.M))
    assert {file for file in images if not file.endswith(".hex")} <= about.keys()
    assert len(set(about.values())) == len(about), "one machine, two files"
    assert not any(one in other for one in about.values() for other in about.values() if one != other)
    with pytest.raises(SystemExit, match="skg-new.bin"):
        build.rom_list([*images, "skg-new.bin"])


def test_same_files_give_the_same_bytes(tmp_path: Path) -> None:
    """A zip knows no times, owners and order of its files."""
    import windows

    made = []
    for folder, names in ((tmp_path / "one", "ab"), (tmp_path / "two", "ba")):
        folder.mkdir()
        for number, name in enumerate(names):
            (folder / name).write_text(name)
            (folder / name).chmod(0o600 + 0o100 * number)
        made.append(windows.pack(tmp_path / f"{folder.name}.zip", [(folder / name, f"x/{name}") for name in names]))
    assert made[0].read_bytes() == made[1].read_bytes()
