"""The process that reads, plans and cuts: one call at a time, bounded in time and memory, ended at any moment."""

from __future__ import annotations

import multiprocessing
import os
import signal
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection
from pathlib import Path
from traceback import extract_tb
from typing import Any

from skg.cutting.progress import Progress
from skg.errors import UserError, of_library, of_system
from skg.garbage import collect_rarely
from skg.messages.finding import Finding, Phrase
from skg.messages.render import Medium, speech
from skg.terminal import remark
from skg.ui.json_text import EARLY

#: No call takes longer but a cut, s.
SECONDS = 120.0
#: The process has no more memory than this, where the system lets a process say so.
MEMORY = 4 << 30
#: Part of an answer, told before the rest.
Early = Callable[[dict], None]
#: Progress is told no more often than this, s.
_PAUSE = 0.1


class Ended(UserError):
    """The process ended before it answered. `is_wanted`: `Worker.end` did it."""

    def __init__(self, why: Finding, is_wanted: bool) -> None:
        super().__init__(why)
        self.is_wanted = is_wanted


class Worker:
    """The process as its calls, one at a time: methods of `skg.ui.desk.Desk`. One that has ended is begun anew.

    `first`: the call that gives a new process what the one before it had.
    """

    def __init__(self) -> None:
        self.first: tuple[str, tuple] | None = None
        self._process: multiprocessing.process.BaseProcess | None = None
        self._connection: Connection | None = None
        self._is_ended = False

    def call(
        self, method: str, *arguments: object, progress: Progress | None = None, early: Early | None = None
    ) -> Any:  # noqa: ANN401 (each method returns its own)
        """Return what the call returns; what it refuses is a `UserError`, a process that is gone `Ended`.

        One that tells its progress takes as long as it takes. `early`: takes what is known before the rest.
        """
        self.begin()
        return self._ask(method, arguments, progress, early)

    def end(self) -> None:
        """End the process, whatever it does: a call that waits for it, in another thread, raises `Ended`."""
        if process := self._process:
            self._is_ended = True
            process.kill()

    def begin(self) -> None:
        """Begin the process, where there is none; `UserError` when the system begins no more."""
        if self._process and (self._is_ended or not self._process.is_alive()):
            self._process.join()
            self._process = None
        if self._process:
            return
        # (fork would take the server's threads and sockets along)
        context = multiprocessing.get_context("spawn")
        try:
            self._connection, far = context.Pipe()
            process = context.Process(target=work, args=(far, speech.language), name="skg ui worker", daemon=True)
            with _interrupts_blocked():
                process.start()
        except OSError as error:
            raise UserError(Finding("no-process", why=of_system(error))) from None
        # (another thread may end it from here on)
        self._process, self._is_ended = process, False
        far.close()
        if self.first:
            method, arguments = self.first
            try:
                self._ask(method, arguments)
            except UserError:
                self.end()
                raise

    def _ask(
        self, method: str, arguments: tuple, progress: Progress | None = None, early: Early | None = None
    ) -> object:
        last, connection, process = time.monotonic() + SECONDS, self._connection, self._process
        assert connection and process, "it has begun"
        try:
            connection.send((method, arguments))
            while True:
                if not connection.poll(None if progress else max(0.0, last - time.monotonic())):
                    self.end()
                    raise UserError(Finding("page-too-long", seconds=SECONDS))
                kind, *values = connection.recv()
                if kind == "done":
                    return values[0]
                if kind == "failed":
                    raise UserError(values[0])
                if kind == EARLY and early:
                    early(*values)
                elif kind == "progress" and progress:
                    progress(*values)
        except (EOFError, OSError):
            process.join()
            if self._is_ended:
                raise Ended(Finding("cancelled"), True) from None
            raise Ended(Finding("process-ended", by=_ended_by(process.exitcode)), False) from None


@contextmanager
def _interrupts_blocked() -> Iterator[None]:
    """Let a process that begins here never hear of ctrl-C, which goes to all of a terminal: while it imports, too."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _ended_by(code: int | None) -> str | Phrase:
    if code is not None and code < 0:
        with suppress(ValueError):
            return signal.Signals(-code).name
    return Phrase("exit-code", code=code)


def work(connection: Connection, language: str) -> None:
    """Answer calls until nobody asks any more: the process's whole life."""
    # (ctrl-C goes to all processes of a terminal, and the server ends this one)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # (bars would stand in the terminal, where nobody looks)
    os.environ["TQDM_DISABLE"] = "1"
    _bound_memory()
    collect_rarely()
    from skg.ui.desk import Desk

    speech.language, speech.medium = language, Medium.PAGE
    desk = Desk(_teller(connection), lambda answer: connection.send((EARLY, answer)))
    with suppress(EOFError, OSError):
        while True:
            method, arguments = connection.recv()
            connection.send(_answer(getattr(desk, method), arguments))


def _answer(function: Callable, arguments: tuple) -> tuple:
    """The result or refusal of a call, as it goes through the connection."""
    try:
        return "done", function(*arguments)
    except UserError as error:
        return "failed", error.finding
    except MemoryError:
        return "failed", Finding("no-memory", most=MEMORY >> 30)
    except RecursionError:
        return "failed", Finding("too-deep")
    except Exception as error:
        finding = mistake(error)
        remark(finding, "skg ui")
        return "failed", finding


def mistake(error: Exception) -> Finding:
    """A mistake of this program, and where it was."""
    last = extract_tb(error.__traceback__)[-1]
    return Finding("mistake", file=Path(last.filename).name, line=last.lineno, what=of_library(error))


def _teller(connection: Connection) -> Progress:
    """Progress as messages, not too many of them."""
    before, at = "", 0.0

    def tell(stage: str, done: int, total: int) -> None:
        nonlocal before, at
        now = time.monotonic()
        if stage != before or done == total or now - at > _PAUSE:
            before, at = stage, now
            connection.send(("progress", stage, done, total))

    return tell


def _bound_memory() -> None:
    try:
        import resource
    except ImportError:
        return
    _, most = resource.getrlimit(resource.RLIMIT_AS)
    # (some systems know the limit and refuse to set it)
    with suppress(ValueError, OSError):
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY if most < 0 else min(MEMORY, most), most))
