"""Files that a command reads and writes; `-` is the standard input or output."""

from __future__ import annotations

import errno
import os
import re
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from io import BytesIO, TextIOWrapper
from pathlib import Path
from stat import S_IMODE, S_ISREG
from typing import BinaryIO, TextIO

from skg.errors import UserError
from skg.file_type import named
from skg.messages.finding import Finding
from skg.signs import decoded, shown

try:
    import fcntl

    _HAS_LOCKS = True
except ImportError:
    _HAS_LOCKS = False

#: The end of the name of a file that is being written; seconds after which it may be what a killed run has left.
_LEFT, _REST = ".part", 60.0
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
        kind, line, column = named(data), len(before) + 1, len(begun) + 1
        code = _STOPS.get(odd[0])
        finding = (
            Finding(code, kind=kind, line=line, column=column)
            if code
            else Finding("not-ascii", character=shown(odd[0]), kind=kind, line=line, column=column)
        )
        raise UserError(finding.within(name))
    return text


def in_ascii(data: bytes) -> str:
    """Return a text with a `?` in place of each character that is not ASCII."""
    text = data.decode("ascii" if data.isascii() else "utf-8", "replace")
    return text if text.isascii() else text.encode("ascii", "replace").decode("ascii")


def is_same_file(one: str, other: str) -> bool:
    """Tell whether two names are of one file, there or to be written: by links of either kind, and in other letters
    where the system takes no heed of case."""
    if "-" in (one, other):
        return False
    with suppress(OSError):
        return Path(one).samefile(other)
    first, second = (Path(os.path.realpath(name)) for name in (one, other))
    if sys.platform in ("win32", "darwin"):
        return str(first).casefold() == str(second).casefold()
    return first == second


def part_of(name: str) -> str:
    """The name of a file with a tape that is not whole, beside the one that it was to be."""
    return f"{os.path.realpath(name)}.part"


@contextmanager
def _new_file(path: str) -> Iterator[BinaryIO]:
    """A file to write: it takes the place of an older one when all of it is written and on the disk, and not before.

    What is no plain file is written as it goes; a file that has several names, or lies in a folder that takes no new
    one, where it is, all at once.
    """
    target = Path(os.path.realpath(path))
    with _named(path):
        try:
            old = target.stat()
        except FileNotFoundError:
            old = None
        if old and not S_ISREG(old.st_mode):
            with target.open("wb") as stream:
                yield stream
            return
        made = None if old and (old.st_nlink > 1 or not os.access(target, os.W_OK)) else _beside(target.parent)
    if made is None:
        text = BytesIO()
        yield text
        with _named(path):
            _write_in_place(target, text.getvalue())
        return
    descriptor, name = made
    try:
        with _named(path):
            with os.fdopen(descriptor, "wb") as stream:
                yield stream
                stream.flush()
                os.fsync(descriptor)
                # (of the open file there is none on Windows)
                Path(name).chmod(S_IMODE(old.st_mode) if old else 0o666 & ~_umask())
            Path(name).replace(target)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


def _beside(folder: Path) -> tuple[int, str] | None:
    """A file to write, with its name; None in a folder that takes no new one. Those that killed runs have left go."""
    try:
        descriptor, name = tempfile.mkstemp(_LEFT, ".skg-", folder)
    except PermissionError:
        return None
    except OSError as error:
        if error.errno == errno.EROFS:
            return None
        raise
    hold(descriptor)
    for left in folder.glob(f".skg-????????{_LEFT}"):
        # (on Windows a file that is open stays)
        with suppress(OSError):
            if left.name != Path(name).name and time.time() - left.stat().st_mtime > _REST and not is_held(left):
                left.unlink()
    return descriptor, name


def hold(descriptor: int) -> bool:
    """Tell whether a file is this process's alone, and keep it so until it is closed."""
    if _HAS_LOCKS:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            # (a file system without locks tells nothing)
            return False
    return True


def is_held(path: Path) -> bool:
    """Tell whether another process holds a file."""
    with path.open("rb") as stream:
        return not hold(stream.fileno())


def _write_in_place(target: Path, data: bytes) -> None:
    """Write a file that no other may take the place of; where the disk is full it is as it was."""
    if not target.exists():
        target.write_bytes(data)
        return
    with target.open("r+b") as stream:
        old = stream.read()
        try:
            _put(stream, data)
        except OSError:
            # (there is room for it: nothing of it was given back)
            with suppress(OSError):
                _put(stream, old)
            raise


def _put(stream: BinaryIO, data: bytes) -> None:
    stream.seek(0)
    stream.write(data)
    stream.flush()
    stream.truncate(len(data))
    os.fsync(stream.fileno())


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
