"""Files that a command reads and writes; `-` is the standard input or output."""

from __future__ import annotations

import os
import re
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from io import TextIOWrapper
from pathlib import Path
from stat import S_IMODE, S_ISREG
from typing import BinaryIO, TextIO

from skg.errors import UserError
from skg.file_type import named
from skg.messages.finding import Finding
from skg.signs import decoded, shown

#: Control characters that stop the board.
_STOPS = {"\x03": "ctrl-c", "\x13": "ctrl-s"}
#: These, and characters that the board has no sign for.
_ODD = re.compile(r"[\x03\x13]|[^\x00-\x7f]")


def read_bytes(path: str) -> bytes:
    """Return a file's bytes."""
    if path != "-":
        try:
            return Path(path).read_bytes()
        except OSError as error:
            # (a read that fails names no file)
            raise OSError(error.errno, error.strerror, path) from None
    if sys.stdin is None:
        raise UserError(Finding("stdin-closed"))
    return sys.stdin.buffer.read()


def without_filling(data: bytes) -> bytes:
    """A file without the ctrl-Zs with which CP/M fills its last record up, and without blank tape at its end."""
    return data.rstrip(b"\x1a\0")


def without_mark(data: bytes) -> bytes:
    """A text file without the mark that some editors begin UTF-8 with."""
    return data.removeprefix(b"\xef\xbb\xbf")


def board_text(data: bytes, name: str) -> str:
    """The text of a file for the board's reader or keyboard: up to ctrl-Z, without the mark of UTF-8, in ASCII signs.

    A character that has none, and a ctrl-C or ctrl-S, which would stop the board, are a `UserError` with line and
    column; other control characters mean nothing (language.md, section 1).
    """
    text = decoded(without_mark(data).partition(b"\x1a")[0])
    if odd := _ODD.search(text):
        *before, begun = re.split(r"\r\n|[\r\n]", text[: odd.start()])
        about = {"kind": named(data), "line": len(before) + 1, "column": len(begun) + 1}
        code = _STOPS.get(odd[0])
        finding = Finding(code, **about) if code else Finding("not-ascii", character=shown(odd[0]), **about)
        raise UserError(finding.within(name))
    return text


def in_ascii(data: bytes) -> str:
    """Return a text with a `?` in place of each character that is not ASCII."""
    text = data.decode("ascii" if data.isascii() else "utf-8", "replace")
    return text if text.isascii() else text.encode("ascii", "replace").decode("ascii")


@contextmanager
def _new_file(path: str) -> Iterator[BinaryIO]:
    """A file to write: it takes the place of an older one when all of it is written, and not before.

    What is no plain file, has several names or lies in a folder that takes no new one is written where it is.
    """
    target = Path(os.path.realpath(path))
    try:
        with suppress(FileNotFoundError):
            old = target.stat()
            if not S_ISREG(old.st_mode) or old.st_nlink > 1 or not os.access(target, os.W_OK):
                raise PermissionError
        descriptor, name = tempfile.mkstemp(dir=target.parent, prefix=".skg-")
    except OSError:
        with _named(path), Path(path).open("wb") as stream:
            yield stream
        return
    try:
        with _named(path), os.fdopen(descriptor, "wb") as stream:
            yield stream
            stream.flush()
            # (of the open file there is none on Windows)
            Path(name).chmod(S_IMODE(target.stat().st_mode) if target.exists() else 0o666 & ~_umask())
        Path(name).replace(target)
    except BaseException:
        Path(name).unlink()
        raise


@contextmanager
def _named(path: str) -> Iterator[None]:
    """An error in writing names the file."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror, path) from None


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


@contextmanager
def binary_output(path: str) -> Iterator[BinaryIO]:
    """A file to write, piece by piece."""
    if path != "-":
        with _new_file(path) as stream:
            yield stream
        return
    if sys.stdout is None:
        raise UserError(Finding("stdout-closed"))
    yield sys.stdout.buffer
    sys.stdout.buffer.flush()


@contextmanager
def text_output(path: str) -> Iterator[TextIO]:
    """A file to write ASCII text to, piece by piece."""
    if path != "-":
        with _new_file(path) as binary:
            stream = TextIOWrapper(binary, encoding="ascii", newline="")
            try:
                yield stream
            finally:
                stream.detach()
        return
    if sys.stdout is None:
        raise UserError(Finding("stdout-closed"))
    yield sys.stdout
    sys.stdout.flush()


def write_bytes(path: str, data: bytes) -> None:
    """Write a file."""
    with binary_output(path) as stream:
        stream.write(data)
