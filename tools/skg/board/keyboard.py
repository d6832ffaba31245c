"""The keyboard of this terminal, key by key: on POSIX systems a terminal in raw mode, on Windows the console."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
from collections.abc import Callable, Iterator
from importlib import import_module
from typing import Protocol, cast


class Console(Protocol):
    """The keyboard of Windows, as its module `msvcrt` has it."""

    def kbhit(self) -> bool:
        """Tell whether a key waits."""

    def getwch(self) -> str:
        """The next key."""


try:
    # (by its name: on other systems a type checker knows the module as empty)
    msvcrt: Console | None = cast(Console, import_module("msvcrt"))

    #: Exceptions of a terminal beside OSError.
    TERMINAL_TROUBLE: tuple[type[Exception], ...] = ()
except ImportError:
    import select
    import termios
    import tty

    msvcrt = None
    TERMINAL_TROUBLE = (termios.error,)

#: ctrl-], by which the operator leaves.
ESCAPE = 0x1D


@contextlib.contextmanager
def raw_keyboard() -> Iterator[Callable[[], bytes]]:
    """Give the keyboard's bytes as they are typed; the terminal is put right again at the end.

    Where the standard input is no terminal there is no keyboard. A terminal that is gone types ctrl-].
    """
    if not sys.stdin.isatty():
        yield bytes
    else:
        with _console() if msvcrt else _raw_terminal(sys.stdin.fileno()) as typed:
            yield typed


@contextlib.contextmanager
def _console() -> Iterator[Callable[[], bytes]]:
    """The console of Windows, its characters in UTF-8; keys without one, as the arrows, are nothing."""
    interrupts, console = bytearray(), msvcrt
    assert console is not None, "a console of Windows"

    def typed() -> bytes:
        keys = bytes(interrupts)
        interrupts.clear()
        while console.kbhit():
            key = console.getwch()
            if key in "\0\xe0":
                # (the second half of a key without a character)
                console.getwch()
            else:
                keys += key.encode("utf-8", "surrogatepass")
        return keys

    # (ctrl-C comes as a signal)
    before = signal.signal(signal.SIGINT, lambda _number, _frame: interrupts.append(0x03))
    try:
        yield typed
    finally:
        signal.signal(signal.SIGINT, before)


@contextlib.contextmanager
def _raw_terminal(descriptor: int) -> Iterator[Callable[[], bytes]]:
    before = termios.tcgetattr(descriptor)

    def typed() -> bytes:
        if not select.select([descriptor], [], [], 0)[0]:
            return b""
        with contextlib.suppress(OSError):
            if keys := os.read(descriptor, 256):
                return keys
        return bytes([ESCAPE])

    try:
        tty.setraw(descriptor)
        yield typed
    finally:
        with contextlib.suppress(termios.error):
            termios.tcsetattr(descriptor, termios.TCSADRAIN, before)
