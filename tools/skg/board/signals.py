"""Signals that end this process: what is open is closed in order first."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager

#: Those that a user, a shell or the system sends, as far as this system has them. (ctrl-C is Python's own.)
_NAMES = ("SIGTERM", "SIGHUP", "SIGQUIT")


class _Ended(BaseException):
    """A signal has come."""


@contextmanager
def closing_on_signals() -> Iterator[None]:
    """Let a signal leave the block in order, as an error does, and have its effect then: the caller learns of it.

    A second one has its effect at once; those that are ignored, as by nohup, stay so.
    """
    came = []

    def heed(number: int, _frame: object) -> None:
        came.append(number)
        signal.signal(number, signal.SIG_DFL)
        raise _Ended

    known = [getattr(signal, name) for name in _NAMES if hasattr(signal, name)]
    before = {number: signal.signal(number, heed) for number in known if signal.getsignal(number) != signal.SIG_IGN}
    try:
        yield
    except _Ended:
        pass
    finally:
        for number, was in before.items():
            signal.signal(number, signal.SIG_DFL if number in came else was)
    if came:
        os.kill(os.getpid(), came[0])
