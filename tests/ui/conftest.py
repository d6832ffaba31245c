"""Fixtures of the tests of `skg ui`."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Iterator
from pathlib import Path
from threading import Thread
from types import SimpleNamespace

import pytest
from uihelp import Page

from skg.job.setups import Setups
from skg.ui import worker
from skg.ui.server import Server
from skg.ui.session import Session

#: What reading and cutting import.
PRELOADED = ["skg.ui.desk", "skg.cutting.ladder", "skg.reading.slow_dxf", "skg.reading.svg_file"]


@pytest.fixture(scope="session", autouse=True)
def libraries(build: Callable[..., None]) -> None:
    """The libraries in C: the board and the simulator."""
    build("emu", "tools")


@pytest.fixture(scope="session", autouse=True)
def forked() -> Iterator[None]:
    """The processes that read and cut come out of one that has imported all: that takes each half a second. (The tests
    of the command begin them as it does.)"""
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(PRELOADED)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(worker, "multiprocessing", SimpleNamespace(get_context=lambda _: context))
        yield


@pytest.fixture
def serve(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[[Path | None], Server]]:
    """Begin a server, with a file or without."""
    servers = []
    setups = Setups(tmp_path_factory.mktemp("config") / "setups")

    def begin(path: Path | None = None) -> Server:
        session = Session(setups)
        session.begin(path)
        server = Server(0, session)
        servers.append(server)
        Thread(target=server.serve_forever, args=(0.05,), daemon=True).start()
        return server

    yield begin
    for server in servers:
        server.shutdown()
        server.server_close()
        server.session.close()


@pytest.fixture
def page(serve: Callable[[], Server]) -> Page:
    """A page of a server that has nothing open."""
    return Page(serve())
