"""What a release has for CP/M: disks that CP/M reads, Intel hex for its LOAD, names of eight letters."""

from __future__ import annotations

import importlib.util
import shutil
import subprocess
from pathlib import Path

import pytest
from cpmhelp import EXAMPLES, PROGRAM, ROOT, Cpm

_spec = importlib.util.spec_from_file_location("release_cpm", ROOT / "release" / "cpm.py")
assert _spec and _spec.loader
release = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(release)


@pytest.mark.parametrize("form", release.DISKS)
def test_a_disk_of_the_release_cuts_an_example(form: str) -> None:
    disk = release.disk(release.DISKS[form])
    assert len(disk) == 8 << 20, "as long as the machine has them"
    cpm = Cpm("Z80", form=release.DISKS[form], disk=disk)
    assert len(cpm.names()) == len(EXAMPLES) + 2
    assert "ERR" not in cpm.type("SKG XYHEXAG2 B:TAPE") and cpm.at_cpm
    assert cpm.read("TAPE.3B", drive=1) == (ROOT / "examples" / "xy-hexagon.3b").read_bytes()


@pytest.mark.skipif(not shutil.which("cpmls"), reason="Debian's cpmtools are not installed")
@pytest.mark.parametrize("form", release.DISKS)
def test_cpmtools_read_it_by_the_formats_beside_it(form: str, tmp_path: Path) -> None:
    """Debian's cpmtools know neither of the two."""
    (tmp_path / "disk").write_bytes(release.disk(release.DISKS[form]))
    (tmp_path / "diskdefs").write_text(release.diskdefs())
    listed = subprocess.run(["cpmls", "-f", form, "disk"], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert set(listed.stdout.lower().split()) - {"0:"} == {name.lower() for name in release.files()}
    subprocess.run(["cpmcp", "-f", form, "disk", "0:skg.com", "back"], cwd=tmp_path, check=True)
    assert (tmp_path / "back").read_bytes() == release.files()["SKG.COM"]


def test_names_are_whole_and_each_its_own() -> None:
    named = release.names(EXAMPLES)
    assert len(set(named.values())) == len(EXAMPLES)
    assert all(len(name) <= 8 and name.isalnum() and name.isupper() for name in named.values())


def test_the_hex_is_the_program_from_0100_up() -> None:
    memory: dict[int, int] = {}
    *rows, last = release.intel_hex(PROGRAM).split()
    for row in rows:
        assert row[0] == ":"
        record = bytes.fromhex(row[1:])
        assert sum(record) & 0xFF == 0 and record[3] == 0 and len(record) == record[0] + 5
        start = int.from_bytes(record[1:3], "big")
        memory.update(enumerate(record[4:-1], start))
    assert last.startswith(":00"), "LOAD ends there"
    assert bytes(memory[at] for at in sorted(memory)) == PROGRAM.read_bytes()
    assert sorted(memory) == list(range(0x100, 0x100 + len(memory)))
