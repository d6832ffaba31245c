"""What a CP/M machine takes of SKG: programs, Intel hex for a console, disks with the examples, a folder for RunCPM.

    release/cpm.py FOLDER               writes them there, with a README.TXT

The disks are written by Digital Research's own BDOS (PyPI's cpm80), so CP/M finds them as it would leave them.
"""

from __future__ import annotations

import argparse
import importlib.util
import textwrap
from pathlib import Path

import cpm80

ROOT = Path(__file__).resolve().parents[1]
PROGRAMS = {"SKG": ROOT / "roms" / "skg.com", "SKGMILL": ROOT / "roms" / "skgmill.com"}
RECORD, CTRL_Z = 128, b"\x1a"
#: Where CP/M loads a program.
TPA = 0x100
#: Disks of 8 MiB, as cpmtools calls their formats: one of a Z80-MBC2 but its first, a slice of RomWBW's hard disks.
DISKS = {
    "z80mbc2-d1": cpm80.DiskFormat(
        sectors_per_track=128, num_reserved_tracks=0, block_size=4096, num_blocks=2048, num_dir_entries=512
    ),
    "wbw_hd1k": cpm80.DiskFormat(
        sectors_per_track=64, num_reserved_tracks=2, block_size=4096, num_blocks=2044, num_dir_entries=1024
    ),
}


def names(parts: list[Path]) -> dict[Path, str]:
    """A name of CP/M for each part, eight letters and digits; the last is a digit where the same one was taken."""
    named: dict[Path, str] = {}
    for part in parts:
        whole = part.stem.replace("-", "").upper()
        others = (f"{whole[:7]}{digit}" for digit in range(2, 10))
        named[part] = next(name for name in (whole[:8], *others) if name not in named.values())
    return named


def files() -> dict[str, bytes]:
    """All files of a disk by their names: whole records, texts with CR LF and ctrl-Z."""
    held = {f"{name}.COM": program.read_bytes() for name, program in PROGRAMS.items()}
    for part, name in names(_examples()).items():
        held[f"{name}.SKG"] = part.read_text().replace("\n", "\r\n").encode() + CTRL_Z
    return {name: data.ljust(-(-len(data) // RECORD) * RECORD, CTRL_Z) for name, data in held.items()}


def disk(form: cpm80.DiskFormat) -> bytes:
    """The image of a disk with these files."""
    image = cpm80.DiskImage(form, store_format=False)
    system = cpm80.FileSystem(image)
    for name, data in files().items():
        system.write(name, data)
    return bytes(image.data)


def diskdefs() -> str:
    """The disks' formats as cpmtools reads them, in a file of this name in the folder where it is called."""
    text = ""
    for name, form in DISKS.items():
        track = form.sectors_per_track * RECORD
        tracks = form.num_blocks * form.block_size // track + form.num_reserved_tracks
        text += f"diskdef {name}\n  seclen {RECORD}\n  tracks {tracks}\n  sectrk {form.sectors_per_track}\n"
        text += f"  blocksize {form.block_size}\n  maxdir {form.num_dir_entries}\n  skew 0\n"
        text += f"  boottrk {form.num_reserved_tracks}\n  os 2.2\nend\n"
    return text


def intel_hex(program: Path) -> str:
    """A program as CP/M's LOAD takes it."""
    spec = importlib.util.spec_from_file_location("asm_build", ROOT / "asm" / "build.py")
    assert spec and spec.loader
    build = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(build)
    return build.intel_hex(program.read_bytes(), TPA)


def readme() -> str:
    """The text for who unpacks them."""
    parts = "\n".join(f"    {name + '.SKG':14}{part.name}" for part, name in names(_examples()).items())
    text = """\
        SKG for CP/M: docs/manual.md, section 13, says how it is used, docs/boards.md how it gets in.

        SKG.COM, SKGMILL.COM     the programs: for a wire machine, for a mill
        skg-cpm.hex, skgmill-cpm.hex   the same for PIP and LOAD, where there is a console and nothing else
        A/0/                     a folder for RunCPM: the programs and the examples
        wbw_hd1k.img             the same on a disk: a slice of RomWBW's hard disks
        z80mbc2-d1.dsk           a disk of a Z80-MBC2: rename it to DS0N05.DSK, say, on its SD card
        diskdefs                 these two formats for cpmtools, called in this folder:
                                 cpmls -f wbw_hd1k wbw_hd1k.img

        The examples' names:
        """
    return (textwrap.dedent(text) + parts + "\n").replace("\n", "\r\n")


def _examples() -> list[Path]:
    return sorted((ROOT / "examples").glob("*.skg"))


def main() -> None:
    """Write all of it."""
    options = argparse.ArgumentParser(description="Write what a CP/M machine takes of SKG.")
    options.add_argument("folder", type=Path, metavar="FOLDER")
    folder = options.parse_args().folder
    drive = folder / "A" / "0"
    drive.mkdir(parents=True, exist_ok=True)
    for name, data in files().items():
        (drive / name).write_bytes(data)
    for name, program in PROGRAMS.items():
        (folder / f"{name}.COM").write_bytes(program.read_bytes())
        (folder / f"{name.lower()}-cpm.hex").write_text(intel_hex(program), newline="\r\n")
    for name, form in DISKS.items():
        (folder / f"{name}.{'dsk' if 'mbc2' in name else 'img'}").write_bytes(disk(form))
    (folder / "diskdefs").write_text(diskdefs(), newline="\n")
    (folder / "README.TXT").write_text(readme(), newline="")


if __name__ == "__main__":
    main()
