"""A machine that answers anything at all (hunt_grbl.py), a few programs; and mistakes that it must find."""

from __future__ import annotations

from pathlib import Path

import pytest
from hunt_grbl import Caught, judge

IMAGE = (Path(__file__).resolve().parents[2] / "roms" / "skg-grbl.bin").read_bytes()
PROGRAMS = 40


def test_nothing_is_lost_whatever_the_machine_says() -> None:
    caught = Caught()
    for number in range(PROGRAMS):
        judge(number, "tests", caught)
    assert not caught.wrong, "\n".join(caught.wrong)
    assert caught.blocks > 10 * PROGRAMS and caught.complaints > PROGRAMS / 2
    assert sum(caught.aside.values()) < PROGRAMS / 10


#: What the ROM looks for in the machine's answers, and what it would find instead.
FAULTS = {
    "ok is not taken": (b"o\xeb", b"o\xea"),
    "anything with o is ok": (b"o\xeb", b"\xef\xeb"),
    "an error means nothing": (b"erro\xf2", b"errx\xf2"),
    "an alarm means nothing": (b"ALAR\xcd", b"ALAX\xcd"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_mistake_is_found(fault: str) -> None:
    right, wrong = FAULTS[fault]
    assert IMAGE.count(right) == 1
    caught = Caught(IMAGE.replace(right, wrong))
    number = 0
    while not caught.wrong and number < PROGRAMS:
        judge(number, "tests", caught)
        number += 1
    assert caught.wrong
