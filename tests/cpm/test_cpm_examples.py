"""SKG.COM under CP/M: each third example (make hunt: all) from file to file, on both processors by turns."""

from __future__ import annotations

from itertools import cycle
from pathlib import Path

import pytest
from cpmhelp import PROCESSORS, SOME_EXAMPLES, Cpm, text


@pytest.mark.parametrize(
    ("part", "processor"),
    list(zip(SOME_EXAMPLES, cycle(PROCESSORS), strict=False)),
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
