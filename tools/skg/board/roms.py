"""The ROM images by name, and the board that each is for.

An installed package has them beside this file; in a checkout they are those of roms/, which `make rom` builds.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from skg.board.emulator import read_rom
from skg.native import CHECKOUT


@dataclass(frozen=True)
class Rom:
    """An image's file, and what `Machine` must know of its board."""

    file: str
    board: str = "6850"
    punch_tty: bool = False


ROMS = {
    "standard": Rom("skg.bin"),
    "no-drift": Rom("skg-nodrift.bin"),
    "mill": Rom("skg-mill.bin"),
    "drive": Rom("skg-drive.bin"),
    "8251": Rom("skg-8251.bin", board="8251"),
    "tty": Rom("skg-tty.bin", punch_tty=True),
    "rc2014": Rom("skg-rc2014.bin", board="rc2014", punch_tty=True),
    "rc2014-sio": Rom("skg-rc2014-sio.bin", board="rc2014-sio"),
    "minimax8085": Rom("skg-minimax8085.bin", board="minimax8085", punch_tty=True),
    "rcbus8085": Rom("skg-rcbus8085.bin", board="rcbus8085", punch_tty=True),
}


def known_rom(name: str) -> str | None:
    """The key of `ROMS` that a name means: `nodrift` and an image's own name, `skg-nodrift`, will do for "no-drift"."""

    def bare(word: str) -> str:
        return word.lower().removeprefix("skg-").replace("-", "")

    return next((key for key in ROMS if bare(key) == bare(name)), None)


def rom_path(key: str) -> Path:
    """The path of the image of a key of `ROMS`."""
    installed = Path(__file__).resolve().with_name("roms")
    return (installed if installed.is_dir() else CHECKOUT / "roms") / ROMS[key].file


def find_rom(name: str) -> tuple[bytes, list[int], Rom]:
    """The image of one of `ROMS`, or of a file (.bin or .hex) for the standard board; the addresses left out.

    One that is missing or cannot be read is a `UserError`.
    """
    key = known_rom(name)
    if key is None:
        return *read_rom(name), Rom(name)
    return *read_rom(str(rom_path(key))), ROMS[key]
