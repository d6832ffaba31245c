"""Times of the server of `skg ui`: opening a drawing, typing the wire, dragging a start hole. `python tests/ui/speed.py
[circles]`.

Over HTTP, as a page does it; the process that reads is warm. Medians of some runs: seconds, and of these those of the
processor, which are the same on a machine that does other things, too.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory, gettempdir
from threading import Thread

from uihelp import Json, Page, circles

from skg.garbage import collect_rarely
from skg.job.setups import Setups
from skg.ui.server import Server
from skg.ui.session import Session


def processor(session: Session) -> float:
    """Seconds of the processor so far: of the server, and of the process that reads."""
    fields = Path(f"/proc/{session._worker._process.pid}/stat").read_text().rpartition(")")[2].split()
    return time.process_time() + sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")


def timed(session: Session, call: Callable[[], Json], times: int) -> str:
    """Medians of some calls, in words."""
    took = []
    for _ in range(times):
        begun, before = time.perf_counter(), processor(session)
        call()
        took.append((time.perf_counter() - begun, processor(session) - before))
    whole, worked = (median(column) for column in zip(*took, strict=True))
    return f"{1000 * whole:.0f} ms ({1000 * worked:.0f})"


def main(counts: list[int]) -> None:
    """Print a line for each number of circles."""
    collect_rarely()
    session = Session(Setups(Path(gettempdir()) / "skg-no-setups"))
    session.begin(None)
    server = Server(0, session)
    Thread(target=server.serve_forever, args=(0.05,), daemon=True).start()
    page = Page(server)
    page.done("GET", "/api/state")
    with TemporaryDirectory() as folder:
        page.open(circles(Path(folder), 10))
        for count in counts:
            path, state, places = circles(Path(folder), count), {}, iter(range(100))

            def put(**job: object) -> Json:
                state.update(page.put(state, **job))  # noqa: B023
                return state  # noqa: B023

            def drag() -> Json:
                contour = state["contours"][0]  # noqa: B023
                where = {name: contour[name] for name in ("layer", "kind", "at", "size")}
                return put(contour=[where | {"start": [4 + next(places) / 100, 5.0]}])  # noqa: B023

            opened = timed(session, lambda: state.update(page.open(path)), 3)  # noqa: B023
            wired = timed(session, lambda: put(machine={"wire": 0.1 + next(places) / 100}), 3)  # noqa: B023
            print(
                f"{count:6} circles: opened in {opened}, wire typed {wired}, a drag answered {timed(session, drag, 15)}"
            )
    server.shutdown()
    session.close()


if __name__ == "__main__":
    main([int(one) for one in sys.argv[1:]] or [2000, 20_000])
