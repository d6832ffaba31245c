"""The Arduino library as its library manager has it: arduino/SKG, the core and the board of emu/, two ROMs as arrays.

release/arduino.py FOLDER           writes it there
"""

from __future__ import annotations

import argparse
import os
import shutil
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CORE = (
    "i8080_host.h", "i8080_ops.h", "i8080_small.c", "i8080_small.h", "i8080_words.h", "small_board.c", "small_board.h",
)  # fmt: skip
#: The arrays' names, and the images in roms/.
ROMS = {"skg_rom": "skg.bin", "skg_rom_drive": "skg-drive.bin"}


def array(name: str, data: bytes) -> str:
    """The definition of an array of bytes in C."""
    rows = (", ".join(f"0x{byte:02x}" for byte in data[at : at + 16]) for at in range(0, len(data), 16))
    lines = "".join(f"    {row},\n" for row in rows)
    return f"const uint8_t {name}[{len(data)}] = {{\n{lines}}};\n"


def write(folder: Path) -> None:
    """Write the library into a folder, which need not be there."""
    shutil.copytree(ROOT / "arduino" / "SKG", folder, dirs_exist_ok=True)
    project = tomllib.loads((ROOT / "tools" / "pyproject.toml").read_text())["project"]
    properties = folder / "library.properties"
    text = properties.read_text().replace("@VERSION@", project["version"])
    # (the project's page, as tools/setup.py has it)
    properties.write_text(text.replace("@URL@", os.environ.get("SKG_HOME", "").rstrip("/")))
    for name in CORE:
        shutil.copy(ROOT / "emu" / name, folder / "src")
    images = {name: (ROOT / "roms" / file).read_bytes() for name, file in ROMS.items()}
    declared = "".join(f"extern const uint8_t {name}[{len(data)}];\n" for name, data in images.items())
    (folder / "src" / "skg_rom.h").write_text(
        "/* The ROMs: the standard one, and the one that steps motors. */\n#ifndef SKG_ROM_H\n#define SKG_ROM_H\n\n"
        "#include <stdint.h>\n\n"
        f'#ifdef __cplusplus\nextern "C" {{\n#endif\n\n{declared}\n#ifdef __cplusplus\n}}\n#endif\n\n#endif\n'
    )
    defined = "\n".join(array(name, data) for name, data in images.items())
    (folder / "src" / "skg_rom.c").write_text(f'#include "skg_rom.h"\n\n{defined}')
    shutil.copy(ROOT / "LICENSE", folder / "LICENSE")


def main() -> None:
    """Write it into the folder that is named."""
    options = argparse.ArgumentParser(description="Write the Arduino library.")
    options.add_argument("folder", type=Path, metavar="FOLDER")
    write(options.parse_args().folder)


if __name__ == "__main__":
    main()
