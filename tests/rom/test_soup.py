"""Small-integer soup (soup.py), firmware against reference: tape, paper, the mark under a line, error and its LINE.

800 programs; another seed: SKG_SEED=text, more of them: SKG_PROGRAMS=number. `make hunt` goes on where this stops
(hunt.py says what to do with what it finds). A failure prints each class of difference with a shrunk program.
"""

from __future__ import annotations

import os
from collections.abc import Callable

import pytest
from hunt import RAM_KIB, Catch, catch, judge
from romhelp import ROM, Board, Outcome
from soup import Bowl, soup

from skg.board import symbols
from skg.ref import run as reference
from skg.ref.interpreter import Endless

SEED = os.environ.get("SKG_SEED", "soup")

#: pytest's record_property.
Record = Callable[[str, object], None]

#: The work is cut into shares, so that several test processes can take them.
SHARES = range(4)
PROGRAMS_A_SHARE = int(os.environ.get("SKG_PROGRAMS", "800")) // len(SHARES)
#: Of all programs, so many may be close calls, and so many endless.
MOST_ASIDE = 0.002
MOST_ENDLESS = 0.002
#: Programs of which a planted mistake must differ in one.
PATIENCE = 4000


def told(caught: Catch) -> str:
    """Everything that was found."""
    return "\n".join(f"{name} ({count} times, first {number})\n{small}"
                     for name, (count, number, small) in caught.found.items())  # fmt: skip


@pytest.mark.parametrize("share", SHARES)
def test_soup(share: int, record_property: Record) -> None:
    caught = catch(SEED, range(share * PROGRAMS_A_SHARE, (share + 1) * PROGRAMS_A_SHARE))
    assert not caught.found, told(caught)
    endless = caught.aside.pop("endless", 0)
    aside = sum(caught.aside.values())
    record_property("compared", ("blocks of soup", caught.blocks, caught.programs - endless, aside))
    assert caught.blocks > caught.programs / 2, "hardly anything was cut"
    assert aside <= max(2, MOST_ASIDE * caught.programs), caught.aside
    assert endless <= max(2, MOST_ENDLESS * caught.programs)


def test_every_statement_and_every_error_is_in_the_soup() -> None:
    errors, words = set(), ""
    for number in range(500):
        bowl = soup(SEED, number)
        words += bowl.program
        try:
            error = reference(bowl.program, bowl.answers, patience=100).error
        except Endless:
            continue
        errors.add(error[0] if error else 0)
    missing = [word for word in STATEMENTS if word not in words]
    assert not missing
    assert errors >= {0, 1, 2, 3, 4, 5, 6, 7, 8, 10}


STATEMENTS = [
    "FROM", "CUT", "BACK", "SYM", "REP", "RECUT", "FIT", "TOL", "SCALE", "READ", "DATA", "RESTORE", "PRINT",
    "INPUT", "GOTO", "IF", "GOSUB", "RETURN", "END", "REM", "R=", "SQR", "SIN", "COS", "TG", "ATG", "ABS",
    "INT", "K1", "K2", "K3",
]  # fmt: skip


# The net must have no holes: each of these mistakes in the ROM has to be found.
# (Behind a fault: where the first program was that found it; those in front of it are tried last.)
NOTHING, NEVER = "C9", "3E 01 B7 C9"  # RET; MVI A,1, ORA A, RET: not zero
ROM_FAULTS = {
    "fillets left out": ("FILLET", NOTHING),
    "a corner past the entry": ("PASSED", NOTHING, 3104),
    "an offset larger than the radius": ("OFFCHK", NOTHING),
    "equal elements do not merge": ("SAMEC", NEVER),
    "the last element is never the first": ("SAMEL", NEVER),
    "a fillet that waits is forgotten at the end": ("NOFIL", NOTHING),
    "ERR leaves the route open": ("ROUTER", NOTHING),
}  # fmt: skip


def planted(where: str, code: str) -> bytes:
    """The ROM with some of its bytes at a label changed."""
    names = symbols(ROM.with_suffix(".sym").read_text())
    image = bytearray(ROM.read_bytes())
    new = b"".join(names[word].to_bytes(2, "little") if len(word) > 2 else bytes.fromhex(word) for word in code.split())
    image[names[where] : names[where] + len(new)] = new
    return bytes(image)


def found(image: bytes, first: int = 0) -> bool:
    """Tell whether a program of the soup tells this ROM from the reference."""

    def firmware(bowl: Bowl) -> Outcome:
        return Board(RAM_KIB, rom=image, limit=50_000_000).outcome(bowl.program, bowl.answers)

    return any(judge(soup(SEED, number), firmware)[1].difference for number in [*range(first, PATIENCE), *range(first)])


@pytest.mark.parametrize("fault", ROM_FAULTS)
def test_a_mistake_in_the_rom_is_found(fault: str) -> None:
    where, code, *first = ROM_FAULTS[fault]
    assert found(planted(where, code), *first)


@pytest.mark.parametrize("exponent", ["78", "76"], ids=["2 um", "half a um"])
def test_a_wrong_micrometre_is_found(exponent: str) -> None:
    micrometre = "77 03 12 6E 98"
    image = ROM.read_bytes()
    assert image.count(bytes.fromhex(micrometre)) == 1
    assert found(image.replace(bytes.fromhex(micrometre), bytes.fromhex(exponent + micrometre[2:])))
