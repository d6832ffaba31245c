"""SKG.COM under CP/M: all examples, from a file to a file, on one processor and the other in turn."""

from __future__ import annotations

from itertools import cycle
from pathlib import Path

import pytest
from cpmhelp import EXAMPLES, PROCESSORS, Cpm, text


@pytest.mark.parametrize(
    ("part", "processor"),
    list(zip(EXAMPLES, cycle(PROCESSORS), strict=False)),
    ids=lambda word: getattr(word, "stem", word),
)
def test_from_file_to_file(part: Path, processor: str) -> None:
    """`SKG PART TAPE` writes the committed tape, byte for byte, and goes back to CP/M."""
    cpm = Cpm(processor, {"PART.SKG": text(part.read_text())})
    printed = cpm.type("SKG PART TAPE")
    assert "ERR" not in printed
    assert cpm.at_cpm
    assert cpm.names() == ["PART.SKG", "SKG.COM", "TAPE.3B"]
    assert cpm.read("TAPE.3B") == part.with_suffix(".3b").read_bytes()
