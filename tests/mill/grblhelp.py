"""A machine at the end of the board's punch line, as a test plays it, and the board that drives it.

with driven("skg-grbl", part, answers=lambda block, number: b"ok\\r\\n") as (board, machine):
    ...
assert machine.blocks == [...]
"""

from __future__ import annotations

import contextlib
import os
import select
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SKG80 = ROOT / "build" / "skg80"
ROMS = ROOT / "roms"
#: Seconds; only what hangs takes so long, on a busy machine too.
PATIENCE = 600

#: What GRBL says when its line is opened.
GREETING = b"\r\nGrbl 1.1h ['$' for help]\r\n"
OK = b"ok\r\n"
#: What a machine says to a block (without its line end) and its number from 1: bytes, or None for silence.
Answer = Callable[[str, int], bytes | None]


@dataclass
class Machine:
    """Reads the line as GRBL does: CR or LF ends a line, each is answered, an empty one with `ok`.

    `blocks` are the lines that were not empty, `raw` all that came, `early` the blocks that came before the one before
    had been answered. It works in a thread of its own until `stop`.
    """

    name: str
    answer: Answer
    greeting: bytes = GREETING
    slow: float = 0.0
    blocks: list[str] = field(default_factory=list)
    raw: bytes = b""
    early: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._line = os.open(self.name, os.O_RDWR | os.O_NOCTTY)
        self._done = threading.Event()
        self._thread = threading.Thread(target=self._work, daemon=True)
        self.say(self.greeting)
        self._thread.start()

    def say(self, words: bytes) -> None:
        """Say something without having been asked."""
        os.write(self._line, words)

    def heard(self, blocks: int) -> None:
        """Come back when so many blocks have come."""
        last = time.monotonic() + PATIENCE
        while len(self.blocks) < blocks:
            assert time.monotonic() < last, self.blocks
            time.sleep(0.01)

    def _work(self) -> None:
        line = b""
        while not self._done.is_set():
            if not select.select([self._line], [], [], 0.02)[0]:
                continue
            try:
                came = os.read(self._line, 4096)
            except OSError:
                return
            self.raw += came
            for byte in (came[n : n + 1] for n in range(len(came))):
                if byte not in b"\r\n":
                    line += byte
                    continue
                said = self._take(line.decode("ascii"))
                line = b""
                if said:
                    self.say(said)

    def _take(self, block: str) -> bytes | None:
        if not block:
            return OK
        self.blocks.append(block)
        if self.slow:
            time.sleep(self.slow)
        if select.select([self._line], [], [], 0)[0]:
            self.early.append(block)
        return self.answer(block, len(self.blocks))

    def stop(self) -> None:
        """Switch it off."""
        self._done.set()
        self._thread.join()
        os.close(self._line)


@dataclass
class Driven:
    """The board: its process, its paper."""

    process: subprocess.Popen[bytes]
    paper: Path

    def wait(self) -> int:
        """The exit code, when it has ended by itself."""
        return self.process.wait()

    def printed(self) -> list[str]:
        """The lines of the paper."""
        return self.paper.read_text().replace("\r", "").split("\n")


@contextlib.contextmanager
def driven(
    rom: str | Path, part: Path, answers: Answer, *options: object, greeting: bytes = GREETING, slow: float = 0.0
) -> Iterator[tuple[Driven, Machine]]:
    """A board that runs a part, `rom` one of roms/ or a file, with a machine at its punch."""
    image = rom if isinstance(rom, Path) else ROMS / f"{rom}.bin"
    paper = part.with_suffix(".paper")
    words = [SKG80, "--rom", image, "--punch-pty", "--tty", paper, *options, part]
    process = subprocess.Popen(list(map(str, words)), stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    name = process.stdout.readline().decode().strip()
    machine = Machine(name, answers, greeting, slow)
    try:
        yield Driven(process, paper), machine
    finally:
        if process.poll() is None:
            process.kill()
        process.wait()
        machine.stop()
        process.stdout.close()
        process.stderr.close()
