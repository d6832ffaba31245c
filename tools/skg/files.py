"""Files that a command reads and writes; `-` is the standard input or output."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TextIO

from skg.errors import UserError
from skg.kinds import named


def read_bytes(path: str) -> bytes:
    """Return a file's bytes."""
    if path != "-":
        try:
            return Path(path).read_bytes()
        except OSError as error:
            # (a read that fails names no file)
            raise OSError(error.errno, error.strerror, path) from None
    if sys.stdin is None:
        raise UserError("standard input: closed")
    return sys.stdin.buffer.read()


def without_filling(data: bytes) -> bytes:
    """A file without the ctrl-Zs with which CP/M fills its last record up, and without blank tape at its end."""
    return data.rstrip(b"\x1a\0")


def without_mark(data: bytes) -> bytes:
    """A text file without the mark that some editors begin UTF-8 with."""
    return data.removeprefix(b"\xef\xbb\xbf")


def read_ascii(path: str) -> str:
    """Return a file's text; anything but ASCII is a `UserError`."""
    data = without_mark(without_filling(read_bytes(path)))
    try:
        return data.decode("ascii")
    except UnicodeDecodeError as error:
        raise UserError(f"{path}: {named(data)}byte {error.start + 1} is not ASCII") from None


@contextmanager
def text_output(path: str) -> Iterator[TextIO]:
    """A file to write ASCII text to, piece by piece."""
    if path != "-":
        with Path(path).open("w", encoding="ascii", newline="") as stream:
            yield stream
        return
    if sys.stdout is None:
        raise UserError("standard output: closed")
    yield sys.stdout
    sys.stdout.flush()


def write_bytes(path: str, data: bytes) -> None:
    """Write a file."""
    if path != "-":
        Path(path).write_bytes(data)
        return
    if sys.stdout is None:
        raise UserError("standard output: closed")
    sys.stdout.buffer.write(data)
    sys.stdout.buffer.flush()
