"""The image whose blocks start where the controller stands (option NODRIFT), against the reference's `drift=False`.

Examples and random programs, byte for byte; what is set aside as a close call is the rule of compare.py.
"""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest
from compare import close_call, difference
from parts import part
from romhelp import EXAMPLES, Board, image
from test_random import MOST_ASIDE, SEED, Record

from skg.machine import Machine
from skg.ref import run as reference

SHARES = range(4)
BLOCKS_A_SHARE = 400


class Driftless(Board):
    """The standard board with the other image."""

    def __init__(self) -> None:
        self.machine = Machine(image("skg-nodrift"), 8)
        assert self.machine.run() == "prompt", self.machine.tty
        self.machine.clear()


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: example.stem)
def test_tape(example: Path) -> None:
    text = example.read_text()
    outcome = Driftless().outcome(text)
    assert outcome.error is None, outcome.paper
    assert outcome.tape == reference(text, drift=False).tape


@pytest.mark.parametrize("share", SHARES)
def test_parts(share: int, record_property: Record) -> None:
    rng = Random(f"{SEED} no drift {share}")
    blocks = programs = arcs = 0
    aside = []
    while blocks < BLOCKS_A_SHARE:
        program = part(rng)
        result = reference(program, drift=False)
        found = difference(Driftless().outcome(program), result)
        reason = close_call(result) if found else ""
        assert not found or reason, f"{found}\n\n{program}"
        programs += 1
        blocks += result.tape.count(b"G")
        arcs += result.tape.count(b"R")
        aside += [reason] if reason else []
    assert arcs > blocks / 10
    assert len(aside) <= max(2, MOST_ASIDE * programs), aside
    record_property("compared", ("blocks without drift", blocks, programs, len(aside)))
