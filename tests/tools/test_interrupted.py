"""ctrl-C at any moment of a command: no traceback."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
#: The process gets ctrl-C when it begins to import a module.
PRESSED = """
import os, signal, sys

class Press:
    def find_spec(self, name, *_):
        if name == {module!r}:
            os.kill(os.getpid(), signal.SIGINT)

sys.meta_path.insert(0, Press())
sys.argv = ["skg", *{words!r}]
from skg.cli import main
main()
"""


def heed() -> None:
    """Heed ctrl-C, which a shell in the background does not."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.mark.parametrize("module", ["click", "skg.terminal", "skg.commands.cut", "skg.pipeline.steps", "numpy"])
def test_while_it_imports(module: str, tmp_path: Path) -> None:
    words = ["cut", str(ROOT / "docs/pictures/bracket.dxf"), "--wire", "0.2", "-o", str(tmp_path / "out.3b")]
    code = PRESSED.format(module=module, words=words)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, preexec_fn=heed)
    assert done.returncode in (130, -signal.SIGINT) and "Traceback" not in done.stderr, done.stderr
    assert not list(tmp_path.iterdir())
