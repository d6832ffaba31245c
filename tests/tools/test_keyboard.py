"""The keyboard of `skg term` at a console of Windows, which tests have not: what msvcrt tells is put in its place.

At a terminal test_term.py tries it.
"""

from __future__ import annotations

import os
import signal
from types import SimpleNamespace

import pytest

from skg.board import keyboard


def test_console(monkeypatch: pytest.MonkeyPatch) -> None:
    """Keys in their order, in UTF-8; arrows and function keys are nothing; ctrl-C is a key."""
    waiting = list("AB\r\xe0H\x00;é件C\x1d")
    console = SimpleNamespace(kbhit=lambda: bool(waiting), getwch=lambda: waiting.pop(0))
    monkeypatch.setattr(keyboard, "msvcrt", console)
    monkeypatch.setattr(keyboard.sys, "stdin", SimpleNamespace(isatty=lambda: True))
    before = signal.getsignal(signal.SIGINT)
    with keyboard.raw_keyboard() as typed:
        assert typed() == "AB\ré件C\x1d".encode()
        assert typed() == b""
        os.kill(os.getpid(), signal.SIGINT)
        waiting[:] = "D"
        assert typed() == b"\x03D"
        assert typed() == b""
    assert signal.getsignal(signal.SIGINT) is before
