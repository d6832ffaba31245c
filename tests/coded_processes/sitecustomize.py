"""Takes the words out of the catalogues of a process that a test starts, where its Python has skg: `pytest --codes`
puts this folder into PYTHONPATH."""

from __future__ import annotations

import sys
from contextlib import suppress
from pathlib import Path

sys.path.append(str(Path(__file__).parents[1]))
with suppress(ImportError):
    from coded import replace

    replace()
sys.path.pop()
