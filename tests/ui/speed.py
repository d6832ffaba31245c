"""Times of the server of `skg ui`: opening a drawing, dragging a start hole. `python tests/ui/speed.py [circles]`.

Over HTTP, as a page does it; the process that reads is warm. Medians of some runs, on a machine that does nothing else.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory, gettempdir
from threading import Thread

from uihelp import Page, circles

from skg.garbage import collect_rarely
from skg.job.setups import Setups
from skg.ui.server import Server
from skg.ui.session import Session


def dragged(page: Page, state: dict, at: int) -> float:
    """Seconds of a drag's answer: the first contour has its start hole somewhere else."""
    contour = state["contours"][0]
    chosen = {name: contour[name] for name in ("layer", "kind", "at", "size")} | {"start": [4 + at / 100, 5.0]}
    begun = time.perf_counter()
    state |= page.put(state, contour=[chosen])
    return time.perf_counter() - begun


def main(counts: list[int]) -> None:
    """Print a line for each number of circles."""
    collect_rarely()
    session = Session(Setups(Path(gettempdir()) / "skg-no-setups"))
    session.begin(None)
    server = Server(0, session)
    Thread(target=server.serve_forever, args=(0.05,), daemon=True).start()
    page = Page(server)
    with TemporaryDirectory() as folder:
        for count in counts:
            path, opened = circles(Path(folder), count), []
            for _ in range(3):
                begun = time.perf_counter()
                state = page.open(path)
                opened.append(time.perf_counter() - begun)
            drags = [dragged(page, state, at) for at in range(15)]
            print(
                f"{count:6} circles: opened in {median(opened):.2f} s, a drag answered in {1000 * median(drags):.0f} ms"
            )
    server.shutdown()
    session.close()


if __name__ == "__main__":
    main([int(one) for one in sys.argv[1:]] or [2000, 20_000])
