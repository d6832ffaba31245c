"""The ROM under random typing (fuzz.c): 400,000 bytes, 100,000 more under the sanitizers (`make fuzz`: more)."""

from __future__ import annotations

import os
import re
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from skg.board import symbols

ROOT = Path(__file__).resolve().parents[2]
ROM = Path(os.environ.get("SKG_ROM", ROOT / "roms" / "skg.bin"))
LISTING = ROOT / "build" / "skg.lst"
EXAMPLES = sorted((ROOT / "examples").glob("*.skg"))
FAST, SANITIZED = "build/fuzz", "build/asan/fuzz-rom"

#: pytest's record_property.
Record = Callable[[str, object], None]

#: The work is cut into shares, so that several test processes can take them.
SHARES = range(4)
BYTES_A_SHARE = 100_000
SANITIZED_A_SHARE = 25_000
BYTES_A_BOARD = 50_000
BOARDS = {"skg-8251": ["--board", "8251"], "skg-tty": ["--punch-tty"], "skg-nodrift": [], "skg-mill": []}


def fuzz(program: str, seed: int, count: int, *options: str | Path) -> subprocess.CompletedProcess[str]:
    """Type `count` bytes at the ROM, or at the one that `options` name."""
    labels = ROM.with_suffix(".sym")
    command = [ROOT / program, "--rom", ROM, "--sym", labels, "--seed", str(seed), "--bytes", str(count)]
    return subprocess.run([*command, *options, *EXAMPLES], capture_output=True, text=True)


def listed(*options: str | Path) -> list[str | Path]:
    """The option for the standard ROM's listing, behind others."""
    return [*options, "--lst", LISTING]


def check(record: Record, done: subprocess.CompletedProcess[str], count: int) -> None:
    """The run ended well, and did what it was asked for; what that was goes to the summary (conftest.py)."""
    assert done.returncode == 0, done.stdout[-6000:] + done.stderr[-3000:]
    typed = re.match(r"(\d+) bytes typed", done.stdout)
    assert typed and int(typed[1]) >= count, done.stdout
    record("typed", int(typed[1]))


@pytest.mark.parametrize("share", SHARES)
def test_typing(share: int, record_property: Record) -> None:
    check(record_property, fuzz(FAST, 1983 + share, BYTES_A_SHARE, *listed()), BYTES_A_SHARE)


@pytest.mark.parametrize("share", SHARES)
def test_typing_under_the_sanitizers(share: int, record_property: Record) -> None:
    check(record_property, fuzz(SANITIZED, 1978 + 1000 * share, SANITIZED_A_SHARE, *listed()), SANITIZED_A_SHARE)


@pytest.mark.parametrize("name", BOARDS)
def test_typing_at_other_boards(name: str, record_property: Record) -> None:
    options = [*BOARDS[name], "--rom", ROM.with_name(f"{name}.bin")]
    check(record_property, fuzz(FAST, 1, BYTES_A_BOARD, *options), BYTES_A_BOARD)


#: Leaves a statement that is only parsed.
PARSED = "3A CHKF B7 C2 CHKED"
#: Faults to plant: where, what machine code, and what the fuzzer says of it.
FAULTS = {
    "jump into the program": ("SLIST", "C3 PROG", "(fetched .*|no prompt)"),
    "jump into data": ("SREST", "C3 STTAB", "fetched where no instruction is"),
    "wild jump to 0000": ("SFROM", "C3 00 00", "came to 0000"),
    "halt": ("SGOSUB", "76", "HLT"),
    "write to the ROM": ("SREP", f"{PARSED} 32 34 12 C9", "wrote to the ROM"),
    "stack that grows": ("SBACK", "E5 C3 SBACK", "(SP out of its room|wrote to the ROM|fetched .*)"),
    "stack that leaves its room for a moment": (
        "SBACK", "FF 21 00 00 39 31 A0 23 E5 E1 F9 C9", "the stack left its room"),
    "no prompt after ctrl-C": ("SRETN", "C3 SRETN", "no prompt"),
    "PRINT that changes the program": ("SPRINT", f"{PARSED} 21 A4 26 34 C9", "the program (has changed|is not sound)"),
    "RUN that forgets the program": ("SRUN", "C3 SNEW", "the program has changed"),
    "control character on the paper": ("SIF", f"{PARSED} 3E 02 D7 C9", "on the paper"),
}  # fmt: skip


@pytest.mark.parametrize("fault", FAULTS)
def test_a_planted_fault_is_found(fault: str, tmp_path: Path) -> None:
    where, code, said = FAULTS[fault]
    names = symbols(ROM.with_suffix(".sym").read_text())
    planted = b"".join(
        names[word].to_bytes(2, "little") if word in names and len(word) > 2 else bytes.fromhex(word)
        for word in code.split()
    )
    image = bytearray(ROM.read_bytes())
    image[names[where] : names[where] + len(planted)] = planted
    rom = tmp_path / "faulty.bin"
    rom.write_bytes(image)
    # (With the listing it is seen at once that there is something else than before.)
    done = fuzz(FAST, 1, 3_000_000, *(listed("--rom", rom) if "no instruction" in said else ["--rom", rom]))
    assert done.returncode == 1, done.stdout
    assert re.search(rf"^seed \d+ session \d+ round \d+: {said} ", done.stdout, re.M), done.stdout
