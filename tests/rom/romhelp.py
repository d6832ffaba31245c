"""Short ways to ask the firmware, and to tell its answer from the reference's.

The image is `roms/skg.bin`, or the one that the environment variable SKG_ROM names; other boards' images are beside it.
"""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from skg.machine import Machine, symbols

ROOT = Path(__file__).resolve().parents[2]
ROM = Path(os.environ.get("SKG_ROM", ROOT / "roms" / "skg.bin"))
#: The boards that there is a ROM for, by its image's name, and what `Machine` must know of each.
BOARDS: dict[str, dict[str, Any]] = {"skg": {}, "skg-8251": {"board": "8251"}, "skg-tty": {"punch_tty": True}}
EXAMPLES = sorted((ROOT / "examples").glob("*.skg"))

#: A program that is still at work after so many cycles (16 minutes of the 2 MHz board) hangs.
RUN_LIMIT = 2_000_000_000

ERROR = re.compile(r"ERR (\d\d)(?: LINE (\d+))?")
BLOCK = re.compile(r"\d{4} B\d+B\d+B\d+G[XY](L|NR|SR)[1-4]|DD?")

CTRL_C = 3

#: An error's number and line (None: no line).
Fault = tuple[int, int | None]


def labels() -> dict[str, int]:
    """Addresses by label, of the image."""
    return symbols(ROM.with_suffix(".sym").read_text())


def image(kind: str) -> Path:
    """The ROM of one of the `BOARDS`."""
    return ROM if kind == "skg" else ROM.with_name(f"{kind}.bin")


@dataclass(frozen=True)
class Outcome:
    """What the firmware did: the punch's bytes, the paper without prompts and blocks, the last ERR."""

    tape: bytes
    paper: list[str]
    error: Fault | None


class Board:
    """A board of one of the `BOARDS` at its first prompt, with an operator who reads what is printed."""

    def __init__(self, ram_kib: int = 8, kind: str = "skg", rom: bytes | None = None, limit: int = RUN_LIMIT) -> None:
        self.limit = limit
        self.machine = Machine(rom or image(kind), ram_kib, **BOARDS[kind])
        assert self.machine.run() == "prompt", self.machine.tty
        self.machine.clear()

    def type(self, line: str) -> list[str]:
        """What is printed after a line has been typed, up to the next prompt, its echo left out."""
        start = len(self.machine.tty)
        self.machine.type(f"{line}\r")
        reason = self.machine.run(self.limit)
        paper = self.machine.tty[start:]
        assert reason == "prompt", f"{line!r} ends in {reason}: {paper[-300:]!r}"
        return paper.removesuffix(">").split("\r\n")[1:-1]

    def listing(self) -> list[str]:
        """The program in memory as LIST prints it."""
        return self.type("LIST")

    def load(self, source: str) -> list[str]:
        """What is printed while a tape is loaded."""
        self.machine.tape(source.replace("\n", "\r\n") + "\x1a")
        return self.type("LOAD")

    def outcome(self, source: str, answers: tuple[str, ...] = ()) -> Outcome:
        """LOAD and, when nothing was wrong, RUN; INPUT that finds no answer left is broken off."""
        self.machine.clear()
        printed = self.load(source)
        if fault(printed) is None:
            start = len(self.machine.tty)
            self.machine.type("RUN\r")
            waiting = iter(answers)
            while (reason := self.machine.run(self.limit)) == "input":
                answer = next(waiting, None)
                if answer is None:
                    self.machine.press(CTRL_C)
                else:
                    self.machine.type(f"{answer}\r")
            assert reason == "prompt", f"RUN ends in {reason}: {self.machine.tty[-300:]!r}"
            printed += self.machine.tty[start:].removesuffix(">").split("\r\n")[1:-1]
        words = [line for line in printed if line not in ("", ">") and not BLOCK.fullmatch(line)]
        return Outcome(self.machine.punch, words, fault(printed))


def fault(paper: list[str]) -> Fault | None:
    """The last ERR of some lines of paper."""
    found = [match for line in paper if (match := ERROR.fullmatch(line))]
    if not found:
        return None
    number, line = found[-1].groups()
    return int(number), int(line) if line else None


def run(source: str, answers: tuple[str, ...] = ()) -> Outcome:
    """LOAD and RUN on a new board."""
    return Board().outcome(source, answers)
