"""Narrow parts (narrow.py): what the wire does not fit is error 6 or 7, never a wrong tape; what fits is cut.

1,600 programs; another seed: SKG_SEED=text, more of them: SKG_NARROW=number (`make hunt`: 100,000).
Of the parts that the ROM refuses, so many are tried again without its rule: SKG_LOOSE=1 tries all. One that is right
then must be refused by the reference, too.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator
from itertools import islice
from random import Random

import pytest
from compare import compare
from narrow import Part, judged, parts
from romhelp import ROM, Board, Outcome

from skg.board import symbols
from skg.ref import run as reference

SEED = os.environ.get("SKG_SEED", "narrow")
SHARES = range(4)
PARTS_A_SHARE = int(os.environ.get("SKG_NARROW", "1600")) // len(SHARES)
#: Of the parts that are refused, each so-many-th runs on the ROM without the rule, too (no translation of it is there).
LOOSE = int(os.environ.get("SKG_LOOSE", "4"))
#: Verdicts on tapes that no corner shows to be wrong.
KNOWN = ("right", "walls")
#: What refuses a part that the wire does not fit.
NO_ROOM = (6, 7)


def share(number: int) -> Iterator[Part]:
    """Some of the parts."""
    return islice(parts(Random(f"{SEED} {number}")), PARTS_A_SHARE)


def without_the_rule() -> bytes:
    """The ROM, which no longer compares the wire's travel with that as drawn."""
    image = bytearray(ROM.read_bytes())
    image[symbols(ROM.with_suffix(".sym").read_text())["WRAP"]] = 0xC9
    return bytes(image)


def outcome_of(part: Part, rom: bytes | None) -> Outcome:
    """What a board makes of a part. Its reader is a character late, as a sender may be: the ROM, which looks a long
    time for one behind each line, has it at once."""
    board = Board(rom=rom)
    board.machine.reader_cps(0, cts=1)
    return board.outcome(part.program)


def verdicts(some: Iterator[Part], rom: bytes | None = None) -> tuple[Counter[str], list[str]]:
    """Numbers of parts by verdict; wrong programs, each with its fault."""
    counts: Counter[str] = Counter()
    wrong: list[str] = []
    loose = without_the_rule()
    for part in some:
        outcome = outcome_of(part, rom)
        if outcome.error:
            assert outcome.error.number in NO_ROOM, f"{outcome.error}\n{part.program}"
            counts["refused"] += 1
            if counts["refused"] % LOOSE:
                continue
            other = outcome_of(part, loose)
            counts["refused by the rule"] += other.error is None
            if other.error is None and judged(part, other.tape) == "right" and not reference(part.program).error:
                wrong.append(f"refused ({outcome.error}), and right without the rule\n{part.program}")
            continue
        verdict = judged(part, outcome.tape)
        counts[verdict if verdict in KNOWN else "wrong"] += 1
        if verdict not in KNOWN:
            wrong.append(f"{verdict}\n{part.program}")
    return counts, wrong


@pytest.mark.parametrize("number", SHARES)
def test_no_narrow_part_is_cut_wrong(number: int) -> None:
    counts, wrong = verdicts(share(number))
    print(counts)
    assert not wrong, f"{counts}, {len(wrong)} wrong, such as\n" + "\n".join(wrong[:3])
    assert min(counts["right"], counts["refused"]) > PARTS_A_SHARE / 8 and counts["refused by the rule"], counts


def test_the_judge_sees_arcs_that_turn_over() -> None:
    """A ROM without the rule cuts some of the parts wrong. (4 of these)"""
    _, wrong = verdicts(islice(parts(Random("narrow 0")), 200), without_the_rule())
    assert len(wrong) > 3


@pytest.mark.parametrize("kind", ["skg-nodrift", "skg-8251", "skg-drive"])
def test_every_image_refuses_the_same(kind: str) -> None:
    refused = 0
    for part in islice(share(1), 60):
        error = Board().outcome(part.program).error
        assert Board(kind=kind).outcome(part.program).error == error, part.program
        refused += error is not None
    assert refused > 8


def test_the_reference_refuses_the_same() -> None:
    """But for close calls; and its tape is the same."""
    compared = 0
    for part in islice(share(2), 100):
        verdict = compare(part.program)
        assert not verdict.difference, f"{verdict.difference}\n{part.program}"
        compared += not verdict.aside
    assert compared > 80
