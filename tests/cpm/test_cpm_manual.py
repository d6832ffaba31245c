"""The session of the manual's chapter on CP/M is what CP/M prints."""

from __future__ import annotations

import re

import pytest
from cpmhelp import PROCESSORS, ROOT, Cpm

TYPED = re.compile(r"^(A>|>)(.*)$")


@pytest.mark.parametrize("processor", PROCESSORS)
def test_session(processor: str) -> None:
    sessions = re.findall(r"^```cpm\n(.*?)^```", (ROOT / "docs" / "manual.md").read_text(), re.M | re.S)
    assert len(sessions) == 1
    cpm = Cpm(processor)
    start = cpm.console.paper.rindex(b"A>")
    typed = [found[2] for line in sessions[0].splitlines() if (found := TYPED.match(line)) and found[2]]
    assert len(typed) > 8
    for line in typed:
        cpm.type(line)
    assert cpm.console.paper[start:].decode().replace("\r", "") == sessions[0].rstrip("\n")
