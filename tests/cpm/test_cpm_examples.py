"""SKG.COM under CP/M: all examples, from a file to a file, on both processors."""

from __future__ import annotations

from pathlib import Path

import pytest
from cpmhelp import EXAMPLES, PROCESSORS, Cpm, text


@pytest.mark.parametrize("processor", PROCESSORS)
@pytest.mark.parametrize("part", EXAMPLES, ids=lambda part: part.stem)
def test_from_file_to_file(part: Path, processor: str) -> None:
    """`SKG PART TAPE` writes the committed tape, byte for byte, and goes back to CP/M."""
    cpm = Cpm(processor, {"PART.SKG": text(part.read_text())})
    printed = cpm.type("SKG PART TAPE")
    assert "ERR" not in printed
    assert cpm.at_cpm
    assert cpm.names() == ["PART.SKG", "SKG.COM", "TAPE.3B"]
    assert cpm.read("TAPE.3B") == part.with_suffix(".3b").read_bytes()
