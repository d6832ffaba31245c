"""Long chains of six decimals, firmware against reference: how often do 40 bits choose another micrometre?

A place within `TIE` of the tie between two micrometres is nobody's to decide; it may change the two blocks that meet
there. Of all other blocks at most `MOST` may differ. Another seed: SKG_SEED=number, more of it: SKG_CHAINS=blocks
(a million for an hour's hunt). docs/firmware.md, section "How exact", says where the last bits go.
"""

from __future__ import annotations

import os
from random import Random

import pytest
from chains import chains
from compare import close_call
from romhelp import Board
from test_random import SEED, Record

from skg.ref import run as reference

SHARES = range(4)
BLOCKS_A_SHARE = int(os.environ.get("SKG_CHAINS", "2400")) // len(SHARES)
#: µm from a tie.
TIE = 1e-4
#: Of all blocks, so many may differ; one at least in a small share.
MOST = 0.0005


@pytest.mark.parametrize("share", SHARES)
def test_chains(share: int, record_property: Record) -> None:
    programs = blocks = 0
    different: list[str] = []
    aside: list[str] = []
    for family, program in chains(Random(f"{SEED} chains {share}")):
        result, outcome = reference(program), Board(ram_kib=16).outcome(program)
        ours, theirs = outcome.tape.decode().split(), result.tape.decode().split()
        programs += 1
        if outcome.error != result.error or len(ours) != len(theirs):
            assert close_call(result), f"{outcome.error}, reference {result.error}\n\n{program}"
            aside.append(close_call(result))
            continue
        blocks += sum(block[0] == "B" for block in theirs)
        ties = sum(n.kind == "rounding" and n.margin < TIE for n in result.near)
        unlike = [f"{family}: {a}, reference {b}" for a, b in zip(ours, theirs, strict=True) if a != b]
        different += unlike[2 * ties :]
        if blocks >= BLOCKS_A_SHARE:
            break
    record_property("compared", ("blocks of long chains", blocks, programs, len(aside)))
    assert len(aside) <= max(1, 0.01 * programs), aside
    assert len(different) <= max(1, MOST * blocks), "\n".join(different)
