"""A teletype in the terminal, for the board or the emulator's `--pty`.

Three things happen at once: the keyboard goes to the port, the port's paper to the screen and its punch to a
file, and a program that is being sent goes out line by line (`skg.board.sending`). One thread reads the port (and
one a second port, for the punch); the main thread does everything else. XON and XOFF are taken from the stream of the
port itself and obeyed here, whatever the driver underneath does about them.
"""

from __future__ import annotations

import contextlib
import errno
import os
import sys
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field

import serial
from tqdm import tqdm

from skg.board.board import ErrorLine, find_error
from skg.board.keyboard import ESCAPE, TERMINAL_TROUBLE
from skg.board.recorder import Listing, Recorder
from skg.errors import UserError, of_library, of_system
from skg.messages.finding import Finding, Phrase
from skg.messages.render import line as line_of
from skg.signs import Keys

if os.name == "posix":
    import fcntl
    import termios

XON, XOFF, DC2, DC4 = 0x11, 0x13, 0x12, 0x14
LF, PROMPT = 0x0A, 0x3E
#: Seconds between two tries to open a port that went away.
_RETRY = 0.5
#: Exceptions of pyserial if a port cannot be opened, or is closed or gone in the middle of a call.
_TROUBLE: tuple[type[Exception], ...] = (OSError, ValueError, TypeError, AttributeError, *TERMINAL_TROUBLE)


class Splitter:
    """Takes a port's bytes apart: flow control, punch (between DC2 and DC4) and paper.

    A board without a punch of its own stops the teletype's reader by XOFF after an error, and sends no XON: its
    prompt says that it takes lines again.
    """

    def __init__(self) -> None:
        self.punching = False
        self.line_begins = True
        self.may_send = threading.Event()
        self.may_send.set()

    def feed(self, data: bytes) -> tuple[bytes, bytes]:
        """Return (paper, punch) of some bytes. What is punched is on the paper too, as on a teletype."""
        paper, punch = bytearray(), bytearray()
        for byte in data:
            if byte == XOFF:
                self.may_send.clear()
            elif byte == XON:
                self.may_send.set()
            elif byte in (DC2, DC4):
                self.punching = byte == DC2
            else:
                if self.punching:
                    punch.append(byte)
                if byte:
                    paper.append(byte)
                if byte == PROMPT and self.line_begins:
                    self.may_send.set()
                self.line_begins = byte == LF
        return bytes(paper), bytes(punch)


class Port:
    """A serial port that is opened again when it went away.

    `say` tells the operator, `on_back` is called when the port is there again; `is_away` until then. A port that stays
    away longer than `patience` seconds (0: for ever) is a `UserError`.
    """

    def __init__(
        self, name: str, baud: int, say: Callable[[Finding], None], on_back: Callable[[], None], patience: float
    ) -> None:
        self.name = name
        self.say = say
        self.on_back = on_back
        self.patience = patience
        # (another program on the port would take bytes of the tape)
        self.settings = {"baudrate": baud, "timeout": 0.1, "write_timeout": 1, "exclusive": True}
        self.closing = False
        self.is_away = False
        self.lock = threading.Lock()
        if name.startswith("loop:"):
            raise UserError(Finding("loop-port").within(name))
        try:
            self.serial = self._open()
        except _TROUBLE as error:
            if _is_in_use(error):
                raise UserError(Finding("port-in-use").within(name)) from None
            raise UserError(_reason(error).within(name)) from None

    def _open(self) -> serial.SerialBase:
        opened = serial.serial_for_url(self.name, **self.settings)
        _claim(opened, True)
        return opened

    def _lost(self, broken: serial.SerialBase, error: Exception) -> None:
        """The port went away: say so, and try to open it until it is back."""
        with self.lock:
            if self.closing or self.serial is not broken:
                return
            self.is_away = True
            self.say(Finding("port-went-away", port=self.name, why=_reason(error)))
            with contextlib.suppress(*_TROUBLE):
                broken.close()
            since = time.monotonic()
            while not self.closing:
                try:
                    self.serial = self._open()
                except _TROUBLE as again:
                    if self.patience and time.monotonic() - since > self.patience:
                        raise UserError(Finding("port-given-up", why=_reason(again)).within(self.name)) from None
                    time.sleep(_RETRY)
                else:
                    self.say(Finding("port-is-back", port=self.name))
                    self.on_back()
                    self.is_away = False
                    return

    def read(self) -> bytes:
        """The bytes that came in, 7 bits each; empty after a tenth of a second without anything."""
        current = self.serial
        try:
            return bytes(byte & 0x7F for byte in current.read(max(1, current.in_waiting)))
        except _TROUBLE as error:
            self._lost(current, error)
            return b""

    def write(self, data: bytes) -> None:
        """Send bytes; after a loss of the port it goes on with the byte that failed."""
        for index in range(len(data)):
            while not self.closing:
                current = self.serial
                try:
                    current.write(data[index : index + 1])
                    current.flush()
                    break
                except serial.SerialTimeoutException:
                    continue
                except _TROUBLE as error:
                    self._lost(current, error)

    def close(self) -> None:
        """Close the port for good."""
        self.closing = True
        _claim(self.serial, False)
        with contextlib.suppress(*_TROUBLE):
            self.serial.close()


def _claim(port: serial.SerialBase, is_ours: bool) -> None:
    """Have the system refuse a port to whoever opens it from now on, or no longer: pyserial's lock holds only those
    who look for one. (A pseudo-terminal keeps the claim when its user has gone.)"""
    if os.name == "posix":
        with contextlib.suppress(*_TROUBLE):
            fcntl.ioctl(port.fileno(), termios.TIOCEXCL if is_ours else termios.TIOCNXCL)


def _is_in_use(error: Exception) -> bool:
    """Tell whether another program has a port: as it is locked on POSIX systems, as Windows has it."""
    causes = (error, error.__context__)
    if sys.platform == "win32":
        return any(isinstance(cause, PermissionError) for cause in causes)
    return any(isinstance(cause, OSError) and cause.errno in (errno.EAGAIN, errno.EBUSY) for cause in causes)


def _reason(error: Exception) -> Finding:
    """The error of the system that is in one of pyserial's, or pyserial's own."""
    cause = error.__context__
    number = cause.args[0] if isinstance(cause, TERMINAL_TROUBLE) else getattr(error, "errno", None)
    if number == errno.ENOTTY and isinstance(cause, TERMINAL_TROUBLE):
        return Finding("no-serial-port")
    if number:
        return of_system(OSError(number, os.strerror(number)))
    return of_library(error)


class BrokenOff(Exception):
    """The operator typed ctrl-] or ctrl-C."""


@dataclass
class Teletype:
    """The paper on the screen, the punch in a file, and what is known about the port's state.

    `line` is the paper's last line, `shown` an ERR on the one above, `received` how many characters are on the paper,
    `error` the last ERR with a prompt behind it, `losses` how often the port went away, `gaps` how often that of the
    punch did.
    """

    record: Recorder | None = None
    keys: Callable[[], bytes] = bytes
    splitter: Splitter = field(default_factory=Splitter)
    last: float = field(default_factory=time.monotonic)
    line: bytearray = field(default_factory=bytearray)
    received: int = 0
    shown: ErrorLine | None = None
    error: ErrorLine | None = None
    losses: int = 0
    gaps: int = 0
    news: threading.Event = field(default_factory=threading.Event)
    punched: int = 0
    ended: bool = False
    failure: UserError | None = None
    punching: tqdm | None = None
    show_bars: bool = False
    tail: bytes = b""
    #: What the paper lists of the tape; whether a port went away in the middle of it.
    listing: Listing = field(default_factory=Listing)
    torn: bool = False

    def say(self, finding: Finding) -> None:
        """A line from `skg term` itself, on stderr."""
        tqdm.write(f"skg term: {line_of(finding)}\r", file=sys.stderr)

    def paper(self, data: bytes) -> None:
        """Print what the port typed."""
        if not data:
            return
        self.last = time.monotonic()
        for byte in data:
            if byte not in b"\r\n":
                # (PRINT may write the words of an error: the prompt does not follow them)
                if byte == PROMPT and not self.line and self.shown:
                    self.error, self.shown = self.shown, None
                self.line.append(byte)
            elif self.line:
                self.shown = find_error([self.line.decode()])
                self.listing.take(bytes(self.line))
                self.line.clear()
        self.received += len(data)
        self.news.set()
        if sys.stdout is None:
            return
        try:
            with tqdm.external_write_mode(file=sys.stdout) if self.show_bars else contextlib.nullcontext():
                sys.stdout.buffer.write(data)
                sys.stdout.buffer.flush()
        except BrokenPipeError:
            # Nobody reads the paper any more: the tape is made all the same.
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        except OSError as error:
            raise UserError(of_system(error).within(Phrase("stdout"))) from None

    def punch(self, data: bytes) -> None:
        """Record what the port punched."""
        if not data:
            return
        self.last = time.monotonic()
        self.punched += len(data)
        if self.record:
            self.record.write(data)
        if self.show_bars:
            if self.punching is None:
                self.punching = tqdm(unit="block", desc="punching", leave=False)
            self.punching.update(data.count(b"\n"))
        self.news.set()
        self.tail = (self.tail + data)[-8:].replace(b"\r", b"")
        if b"DD\n" in self.tail or b"M30\n" in self.tail:
            self.ended = True
            if self.punching is not None:
                self.punching.close()
                self.punching = None

    @property
    def asks(self) -> bool:
        """Tell whether INPUT waits for an answer."""
        return bytes(self.line) == b"? "

    @property
    def is_waiting(self) -> bool:
        """Tell whether the board waits for a line: the paper's last line is the prompt, or INPUT's, alone."""
        return self.asks or bytes(self.line) == b">"

    def is_back(self) -> None:
        """The port went away and is there again."""
        self.losses += 1
        self.torn |= self.punched > 0 and not self.ended
        self.splitter.may_send.set()
        self.news.set()

    def punch_is_back(self) -> None:
        """The same of a port of the punch's own."""
        self.gaps += 1
        self.torn = True

    def check(self) -> None:
        """Raise what went wrong in a reading thread, or `BrokenOff` when the operator wants to stop."""
        if self.failure:
            raise self.failure
        typed = self.keys()
        if ESCAPE in typed or 0x03 in typed:
            raise BrokenOff

    def wait(self, until: Callable[[], bool], quiet: float) -> bool:
        """Wait until something is so, or until nothing has come in for `quiet` seconds; tells whether it is so."""
        since = time.monotonic()
        while not (is_so := until()) and time.monotonic() - max(since, self.last) <= quiet:
            self.check()
            self.news.wait(0.1)
            self.news.clear()
        return is_so

    def listen(self, port: Port, is_punch: bool) -> None:
        """Read a port until it is closed (a thread's body)."""
        try:
            while not port.closing:
                data = port.read()
                if is_punch:
                    self.punch(data)
                else:
                    paper, punch = self.splitter.feed(data)
                    self.paper(paper)
                    self.punch(punch)
        except UserError as error:
            self.failure = error


def converse(port: Port, teletype: Teletype) -> None:
    """Carry the keyboard to the port until ctrl-]."""
    keys = Keys()
    while True:
        if teletype.failure:
            raise teletype.failure
        typed, escape, _ = teletype.keys().partition(bytes([ESCAPE]))
        sent, refused = keys.feed(typed)
        for finding in refused:
            teletype.say(finding)
        port.write(sent)
        if escape:
            return
        if not typed:
            time.sleep(0.01)
