"""The hunt for the image whose blocks wait: random programs, and a machine that answers anything at all.

    make hunt                                       the hunts of tests/rom, then this one with a tenth of the programs
    .venv/bin/python tests/mill/hunt_grbl.py --seed 7 --programs 5000

Each program runs twice on roms/skg-grbl.bin. First the machine takes every block, says what means nothing in between
and is slow: the tape must be that of `skg ref --grbl`. Then it complains about one block: what went out before must be
the same, nothing may follow but the `M0` of an open route, the complaint is typed, and the program is still there.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from random import Random

import click
from tqdm import tqdm

sys.path.append(str(Path(__file__).resolve().parents[1] / "rom"))

from compare import close_call  # noqa: E402  (a neighbour's)
from millparts import mill_session  # noqa: E402
from playedhelp import IMAGE, OK, Waiting  # noqa: E402
from romhelp import Board, fault  # noqa: E402

from skg.board import BoardStopped  # noqa: E402
from skg.ref import Result, mill  # noqa: E402
from skg.ref.interpreter import Endless  # noqa: E402

#: Lines that a program may carry out; memory for what the programs repeat.
PATIENCE, RAM_KIB = 300, 48
#: What means nothing; what ends the run.
NOTHING = [
    b"\r\n", b"[MSG:Pgm End]\r\n", b"<Run|MPos:1.000,0.000,0.000|FS:60,0>\r\n", b"echo:busy: processing\n", b"o\r\n",
    b"\0\0", b"k\n", b"ook\r", b"not an error:1\r\n", b"?" * 300 + b"\n", bytes(range(128, 160)) + b"\r\n",
]  # fmt: skip
COMPLAINTS = ["error:33", "error:2", "error:", "ALARM:1", "ALARM:9", "error: bad number format", "error:" + "x" * 200]
#: Of a complaint so many characters are typed (milling.md, section "Handshake").
TYPED = 127
LISTED = re.compile(r"N\d+[A-Z].*")


class Hunted(Waiting):
    """A board at whose punch the machine may be silent for a while: `later` is what it says then."""

    later: list[bytes]

    def __init__(self, rom: bytes | None = None) -> None:
        super().__init__(RAM_KIB, IMAGE, rom)
        self.later = []

    def _until_asked(self) -> str:
        while (reason := super()._until_asked()) == "wait" and self.later:
            self.machine.tape(self.later.pop(0))
        return reason


@dataclass
class Machine:
    """Random answers of the machine; it complains about block number `at` (0: about none) with `said`."""

    rng: Random
    board: Hunted
    at: int = 0
    said: str = ""

    def answer(self, _block: str, number: int) -> bytes:
        """Words that mean nothing, now and then in pieces with silence between them, and an answer."""
        rng = self.rng
        answer = f"{self.said}\r\n".encode() if number == self.at else rng.choice([OK, OK, b"ok\n", b"ok T:21\r\n"])
        words = b"".join(rng.choices(NOTHING, k=rng.choice([0, 0, 0, 1, 3]))) + answer
        if rng.random() < 0.2:
            cut = rng.randrange(len(words))
            self.board.later = [words[:cut], words[cut:]]
            return b""
        return words


@dataclass
class Caught:
    """Counts for some programs on an image (None: that of roms/): blocks compared, complaints tried, programs set
    aside, what is wrong."""

    rom: bytes | None = None
    programs: int = 0
    blocks: int = 0
    complaints: int = 0
    aside: Counter[str] = field(default_factory=Counter)
    wrong: list[str] = field(default_factory=list)


def run(
    program: str, answers: tuple[str, ...], rng: Random, rom: bytes | None, at: int = 0, said: str = ""
) -> tuple[Hunted, list[str]]:
    """Load and run a program; the board, and its paper."""
    board = Hunted(rom)
    if board.load(program):
        return board, []
    board.clear()
    board.answer = Machine(rng, board, at, said).answer
    return board, board.run(answers)


def undisturbed(result: Result, board: Board, paper: list[str]) -> str:
    """The fault in a run whose blocks the machine took all; empty: none."""
    if board.tape != result.tape:
        return f"tape {board.tape!r}, reference {result.tape!r}"
    error = fault(paper)
    return "" if (error and tuple(error)) == result.error else f"error {error}, reference {result.error}"


def complained(wanted: list[str], at: int, said: str, board: Hunted, paper: list[str], listing: list[str]) -> str:
    """The fault in a run in which the machine complained about block number `at` of `wanted`; empty: none."""
    blocks, error = board.blocks, fault(paper)
    if blocks[:at] != wanted[:at] or blocks[at:] not in ([], [f"N{at % 9999 + 1}M0"]):
        return f"blocks {blocks[-3:]} behind a complaint about {wanted[at - 1]}"
    typed = [line for line in paper if line == said[:TYPED]]
    if not error or error.number != 10 or len(typed) != 1:
        return f"{paper[-3:]} behind {said!r}"
    board.machine.take_tape()
    return "" if board.listing() == listing else "the program is another one"


def judge(number: int, seed: str, caught: Caught) -> None:
    """One program, twice; a board that waits for an answer that it was given is wrong, too."""
    try:
        _judge(number, seed, caught)
    except (BoardStopped, AssertionError) as stopped:
        caught.wrong.append(f"program {number} of seed {seed}: {stopped}")


def _judge(number: int, seed: str, caught: Caught) -> None:
    rng = Random(f"grbl {seed} {number}")
    program, answers = mill_session(rng)
    caught.programs += 1
    try:
        result = mill.run(program, answers, line_end="\n", patience=PATIENCE)
    except Endless:
        caught.aside["endless"] += 1
        return
    board, paper = run(program, answers, rng, caught.rom)
    if not paper:
        caught.aside["a line that is not understood"] += 1
        return
    found = undisturbed(result, board, paper)
    if found:
        aside = close_call(result)
        if not aside:
            rough = mill.run(program, answers, line_end="\n", bits=33)
            aside = "another one at 33 bits" if (rough.tape, rough.error) != (result.tape, result.error) else ""
        if aside:
            caught.aside[re.sub(r" \d.*", "", aside)] += 1
        else:
            caught.wrong.append(f"program {number} of seed {seed}: {found}\n{program}")
        return
    wanted = board.blocks
    caught.blocks += len(wanted)
    # (the M0 of an error is not waited for, nor the first block when it goes out for that M0)
    last = len(wanted) - bool(result.error and wanted and wanted[-1].endswith("M0"))
    if last < 1 or (last == 1 and last < len(wanted)):
        return
    at, said = rng.randint(1, last), rng.choice(COMPLAINTS)
    listing = board.listing()
    again, paper = run(program, answers, rng, caught.rom, at, said)
    caught.complaints += 1
    if found := complained(wanted, at, said, again, paper, listing):
        caught.wrong.append(f"program {number} of seed {seed}, `{said[:20]}` at block {at}: {found}\n{program}")


@click.command()
@click.option("--seed", default="1", help="Another seed, other programs.")
@click.option("--programs", default=5000, help="How many.")
@click.option("--first", default=0, help="Number of the first one.")
def main(seed: str, programs: int, first: int) -> None:
    """Hunt; exit code 1 when something is wrong."""
    caught = Caught()
    for number in tqdm(range(first, first + programs), unit=" programs"):
        seen = len(caught.wrong)
        judge(number, seed, caught)
        for wrong in caught.wrong[seen:]:
            tqdm.write(wrong)
    print(
        f"{caught.programs} programs, {caught.blocks} blocks compared, {caught.complaints} complaints, "
        f"{sum(caught.aside.values())} set aside: {dict(caught.aside)}; {len(caught.wrong)} wrong"
    )
    if caught.wrong:
        raise SystemExit(1)


if __name__ == "__main__":
    main()
