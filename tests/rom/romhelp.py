"""Short ways to ask the firmware, and to tell its answer from the reference's.

The image is `roms/skg.bin`, or the one that the environment variable SKG_ROM names; other boards' images are beside it.
"""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import skg
from skg.board import ErrorLine, symbols
from skg.board.board import find_error as fault

ROOT = Path(__file__).resolve().parents[2]
ROM = Path(os.environ.get("SKG_ROM", ROOT / "roms" / "skg.bin"))
#: The boards that there is a ROM for, by its image's name, and what `skg.Board` must know of each.
BOARDS: dict[str, dict[str, Any]] = {
    "skg": {},
    "skg-8251": {"board": "8251"},
    "skg-tty": {"punch_tty": True},
    "skg-rc2014": {"board": "rc2014"},
    "skg-rc2014-sio": {"board": "rc2014-sio"},
    "skg-minimax8085": {"board": "minimax8085"},
    "skg-rcbus8085": {"board": "rcbus8085"},
}
#: Those with a paper tape: SAVE punches NULs behind each line, as board.md says.
PAPER_TAPES = ("skg", "skg-8251", "skg-tty")
EXAMPLES = sorted((ROOT / "examples").glob("*.skg"))
#: Foreign processors and machines, and other boards, run each so-many-th; all in `make hunt`.
EVERY = int(os.environ.get("SKG_EVERY", "3"))
SOME_EXAMPLES = EXAMPLES[::EVERY]

#: A program that is still at work after so many cycles (16 minutes of the 2 MHz board) hangs.
RUN_LIMIT = 2_000_000_000

ERROR = re.compile(r"ERR (\d\d)(?: LINE (\d+))?")
BLOCK = re.compile(r"\d{4} B\d+B\d+B\d+G[XY](L|NR|SR)[1-4]|DD?")


def labels() -> dict[str, int]:
    """Addresses by label, of the image."""
    return symbols(ROM.with_suffix(".sym").read_text())


def image(kind: str) -> Path:
    """The ROM of one of the `BOARDS`, or another one for the standard board."""
    return ROM if kind == "skg" else ROM.with_name(f"{kind}.bin")


def saved_tape(lines: list[str], kind: str) -> bytes:
    """The tape that SAVE punches for a listing."""
    end = b"\r\n" + bytes(4 * (kind in PAPER_TAPES))
    return b"".join(line.encode() + end for line in lines) + b"\x1a"


@dataclass(frozen=True)
class Outcome:
    """The firmware's outcome: the punch's bytes, the paper without prompts and blocks, the last ERR."""

    tape: bytes
    paper: list[str]
    error: ErrorLine | None


class Board(skg.Board):
    """A board of one of the `BOARDS` at its first prompt; one that does not come back to it within its limit hangs."""

    def __init__(self, ram_kib: int = 8, kind: str = "skg", rom: bytes | None = None, limit: int = RUN_LIMIT) -> None:
        super().__init__(rom or image(kind).read_bytes(), ram_kib, **BOARDS.get(kind, {}), max_cycles=limit)
        self.clear()

    def listing(self) -> list[str]:
        """The program in memory as LIST prints it."""
        return self.type("LIST")

    def load(self, source: str) -> list[str]:
        """Loads a tape and returns the lines printed meanwhile."""
        return super().load(source.replace("\n", "\r\n") + "\x1a")

    def outcome(self, source: str, answers: tuple[str, ...] = ()) -> Outcome:
        """LOAD and, when nothing was wrong, RUN; INPUT that finds no answer left is broken off."""
        self.clear()
        printed = self.load(source)
        if fault(printed) is None:
            printed += self.run(answers)
        words = [line for line in printed if line not in ("", ">") and not BLOCK.fullmatch(line)]
        return Outcome(self.tape, words, fault(printed))


def run(source: str, answers: tuple[str, ...] = ()) -> Outcome:
    """LOAD and RUN on a new board."""
    return Board().outcome(source, answers)
