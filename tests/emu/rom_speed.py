"""The board's speed with the ROM, with its translation and without, by turns in one run: `make bench-emu`."""

from __future__ import annotations

from pathlib import Path
from time import process_time

from skg.board import Machine
from skg.board.feeding import TAPE_END

ROOT = Path(__file__).resolve().parents[2]
PART = ROOT / "examples" / "fit-gear.skg"
TIMES = 5


def seconds(is_translated: bool) -> tuple[float, int]:
    """The processor's time for LOAD and RUN of the part, and the instructions carried out."""
    m = Machine(ROOT / "roms" / "skg.bin")
    if not is_translated:
        m.poke(0, m.peek(0))
    assert m.is_translated == is_translated
    m.tape(PART.read_text() + TAPE_END)
    began = process_time()
    for line in ("", "LOAD\r", "RUN\r"):
        m.type(line)
        m.run(10**12)
    return process_time() - began, m.instructions


def main() -> None:
    """Print million instructions a second of both, of their best times, and the ratio."""
    runs = [(seconds(is_translated=True), seconds(is_translated=False)) for _ in range(TIMES)]
    (translated, done), (plain, done_plain) = (min(way) for way in zip(*runs, strict=True))
    assert done == done_plain
    print(f"{PART.name} on the board:  {done} instructions")
    print(f"the ROM translated         {done / translated / 1e6:6.1f} million instructions/s")
    print(f"the fast loop alone        {done / plain / 1e6:6.1f} million instructions/s")
    print(f"ratio                      {plain / translated:6.1f}")


main()
