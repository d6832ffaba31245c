"""Programs through a real board: typed at its teletype line by line, with an eye on the paper.

A line is ended when its echo is what was typed, and the next one begins when the board is back at its prompt; the
first ERR ends it all. What `skg.board.feeding` does with the board in this process is done here with the one at the
other end of a line.
"""

from __future__ import annotations

import re
import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

from tqdm import tqdm

from skg.board.board import ErrorLine, is_printed, meaning
from skg.board.feeding import MEMORY_FULL, given_up, is_end, is_numbered, least_ram, without_numbers
from skg.board.teletype import Port, Teletype
from skg.errors import UserError
from skg.files import board_text
from skg.messages.finding import Finding, Phrase

#: Characters that the board takes in a line (language.md, section 3).
LONGEST = 126
_CTRL_C, _CTRL_U, _CR = b"\x03", b"\x15", b"\r"
#: Seconds of silence after which an echo does not come any more; how often a line is typed that comes back wrong.
_ECHO, _TRIES = 1.5, 3
#: The same of what tells whether the board is there at all: an emulator may have to wait for its computer.
_ANSWER = 6.0
#: Most attempts to store a program again after the port went away.
_LOSSES = 5


class TypedLine(NamedTuple):
    """A line of a file, without the characters that mean nothing to the board, and its number in the file."""

    number: int
    text: str


class Stopped(Exception):
    """Nothing more is sent, and why."""

    def __init__(self, why: Finding) -> None:
        super().__init__(why)
        self.why = why


class _Refused(Exception):
    """The board answered a line with ERR."""

    def __init__(self, line: TypedLine, error: ErrorLine) -> None:
        super().__init__()
        self.line, self.error = line, error


def lines_to_type(data: bytes, name: str) -> list[TypedLine]:
    """The lines of a file up to ctrl-Z; one that the board could not take is a `UserError`."""
    lines = []
    for number, raw in enumerate(re.split(r"\r\n|[\r\n]", board_text(data, name)), 1):
        # ctrl-U forgets what stands before it, other control characters mean nothing.
        text = re.sub(r"[\x00-\x1f\x7f]", "", raw.rpartition(_CTRL_U.decode())[2])
        if len(text) > LONGEST:
            why = Finding("line-too-long", length=len(text), most=LONGEST)
            raise UserError(why.within(name, Phrase("line-number", line=number)))
        if text.strip():
            lines.append(TypedLine(number, text))
    return lines


@dataclass
class Typist:
    """Types lines as a careful operator does. `silence`: seconds without a character after which the board will not
    come back to its prompt. With `paced` false nothing but XOFF is waited for. `delay`: seconds after each line.
    `one_by_one`: characters get lost, so the echo of each is waited for."""

    port: Port
    teletype: Teletype
    silence: float
    paced: bool = True
    delay: float = 0.0
    one_by_one: bool = False

    def begin(self) -> None:
        """Forget what somebody has begun to type; a board that does not answer is `Stopped`."""
        if self.paced:
            self._forget_line()

    def start(self, text: str) -> None:
        """Type a line and end it. `Stopped`: there is no echo."""
        data = text.encode("ascii")
        if self.paced:
            self._type_safely(data)
            self.teletype.error = None
        else:
            self._put(data)
        self.teletype.line.clear()
        self._put(_CR)

    def type(self, text: str) -> ErrorLine | None:
        """The same, and wait for the prompt; the ERR that the line is answered with, or None. `Stopped`: no prompt."""
        teletype = self.teletype
        losses = teletype.losses
        self.start(text)
        if self.paced and not teletype.wait(lambda: teletype.is_waiting or teletype.losses > losses, self.silence):
            raise Stopped(Finding("board-silent", seconds=self.silence))
        if self.paced and teletype.losses > losses:
            self._type_again(text)
        if self.delay:
            time.sleep(self.delay)
        if teletype.error and is_printed(teletype.error, text):
            teletype.error = None
        return teletype.error

    def _type_again(self, text: str) -> None:
        """The port went away when a line was ended: a stored line does not mind to be typed twice."""
        if not is_numbered(text):
            raise Stopped(Finding("port-lost-in-line"))
        self.begin()
        self.type(text)

    def _type_safely(self, data: bytes) -> None:
        """Type a line's characters until the board has them all, as its echo says."""
        teletype, tries = self.teletype, 0
        while tries < _TRIES:
            losses = teletype.losses
            if self._is_echoed(data):
                return
            came = bytes(teletype.line)
            if teletype.losses == losses:
                tries += 1
                self._slow_down()
            self._forget_line()
        raise Stopped(Finding("echo-wrong", came=repr(came.decode("ascii", "replace"))))

    def _is_echoed(self, data: bytes) -> bool:
        """Type characters, and see whether the paper has them then."""
        teletype, losses = self.teletype, self.teletype.losses
        step = 1 if self.one_by_one else len(data)
        for first in range(0, len(data), step):
            expected = bytes(teletype.line) + data[first : first + step]
            self._put(data[first : first + step])
            teletype.wait(partial(self._has_line, expected, losses), _ECHO)
            if bytes(teletype.line) != expected:
                return False
        return True

    def _has_line(self, expected: bytes, losses: int) -> bool:
        """Tell whether the paper has a line, or the port was lost since."""
        return bytes(self.teletype.line) == expected or self.teletype.losses > losses

    def _slow_down(self) -> None:
        """A board that cannot take a line at once is given it character by character."""
        if not self.one_by_one:
            self.one_by_one = True
            self.teletype.say(Finding("characters-lost"))

    def _forget_line(self) -> None:
        """ctrl-U, and the new line that it is answered with."""
        teletype = self.teletype
        before = teletype.received
        self._put(_CTRL_U)
        if not teletype.wait(lambda: teletype.received > before and not teletype.line, _ANSWER):
            raise Stopped(Finding("board-no-answer"))

    def _put(self, data: bytes) -> None:
        """Send characters, unless XOFF holds them."""
        for index in range(len(data)):
            self.teletype.check()
            while not self.teletype.splitter.may_send.wait(0.1):
                self.teletype.check()
            self.port.write(data[index : index + 1])


def send(typist: Typist, lines: Sequence[TypedLine], name: str) -> None:
    """Type the lines of a file; the first that is answered with ERR is `Stopped`."""
    _say_given_up(typist, lines, name, is_run=False)
    try:
        typist.begin()
        _type_all(typist, lines, name)
    except _Refused as refused:
        is_full = refused.error.number == MEMORY_FULL and is_numbered(refused.line.text)
        more = Phrase("run-sends-without-numbers") if is_full else None
        raise Stopped(_refusal(refused, name, typist.paced, more)) from None


def make_tape(typist: Typist, lines: list[TypedLine], name: str, unnumbered: bool, is_attended: bool) -> None:
    """Make the tape of a file: NEW, its lines, and RUN, or END, if there is anything left to do then.

    `is_attended`: somebody has the keyboard and waits for RUN himself.

    `unnumbered`: without its line numbers, each line carried out as it comes. So is one that does not fit in the
    board's memory, if it can be, with a word. Anything that keeps the tape from being made is `Stopped`.
    """
    program = "\n".join(line.text for line in lines)
    stored = any(is_numbered(line.text) for line in lines)
    _say_given_up(typist, lines, name, is_run=True)
    if stored and unnumbered:
        lines, stored = _plain(program, name), False
    if stored and typist.paced and not _store(typist, lines, name, program):
        typist.teletype.say(Finding("sent-without-numbers").within(name))
        lines, stored = _plain(program, name), False
    try:
        if not stored or not typist.paced:
            _clear(typist)
            _type_all(typist, lines, name)
        if stored and is_attended:
            typist.start("RUN")
        elif stored:
            _type_all(typist, [TypedLine(0, "RUN")], name)
        elif not any(is_end(line.text) for line in lines[-1:]):
            _type_all(typist, [TypedLine(0, "END")], name)
    except _Refused as refused:
        more = _too_large(program) if refused.error.number == MEMORY_FULL else None
        raise Stopped(_refusal(refused, name, typist.paced, more)) from None


def _say_given_up(typist: Typist, lines: Sequence[TypedLine], name: str, is_run: bool) -> None:
    texts = {line.number: line.text for line in lines}
    if lost := given_up("\n".join(texts.get(number, "") for number in range(1, max(texts, default=0) + 1)), is_run):
        typist.teletype.say(lost.within(name))


def finish(typist: Typist, ports: Sequence[Port], quiet: float, needs_tape: bool, is_followed: bool) -> None:
    """Wait for what still comes, `quiet` seconds at most after the last character; `Stopped` if that is not all.

    `ports`: all that are listened to; `is_followed`: the answer to each line was waited for, again where the port had
    gone away.
    """
    teletype = typist.teletype
    if teletype.asks:
        typist.port.write(_CTRL_C)
        raise Stopped(Finding("input-broken-off"))
    teletype.wait(lambda: teletype.ended, quiet)
    for port in ports:
        if port.is_away:
            raise Stopped(Finding("port-not-back", port=port.name))
    if teletype.error:
        raise Stopped(Finding("err", error=teletype.error.words, meaning=meaning(teletype.error.number)))
    if needs_tape and not teletype.punched:
        raise Stopped(Finding("nothing-punched"))
    if needs_tape and not teletype.ended:
        raise Stopped(Finding("no-dd-came"))
    if teletype.gaps or teletype.losses and not is_followed:
        raise Stopped(Finding("port-was-away"))


def _store(typist: Typist, lines: list[TypedLine], name: str, program: str) -> bool:
    """Store a program in the board; False when it does not fit and can be sent without its numbers."""
    for _ in range(_LOSSES):
        losses = typist.teletype.losses
        try:
            _clear(typist)
            _type_all(typist, lines, name)
        except _Refused as refused:
            if refused.error.number != MEMORY_FULL:
                raise Stopped(_refusal(refused, name)) from None
            if without_numbers(program) is None:
                raise Stopped(_refusal(refused, name, more=_too_large(program))) from None
            return False
        if typist.teletype.losses == losses:
            return True
        typist.teletype.say(Finding("sent-again"))
    raise Stopped(Finding("port-unsteady"))


def _clear(typist: Typist) -> None:
    """NEW: what is on the board shall not be in the tape."""
    typist.begin()
    typist.type("NEW")
    if typist.teletype.asks:
        typist.port.write(_CTRL_C)
        raise Stopped(Finding("board-asked"))


def _type_all(typist: Typist, lines: Sequence[TypedLine], name: str) -> None:
    teletype = typist.teletype
    with tqdm(
        total=sum(len(line.text) for line in lines),
        unit="B",
        unit_scale=True,
        desc="sending",
        leave=False,
        disable=not teletype.show_bars or len(lines) < 2,
    ) as bar:
        for line in lines:
            losses = teletype.losses
            try:
                error = typist.type(line.text)
            except Stopped as stopped:
                raise Stopped(stopped.why.within(*_place(line, name))) from None
            if error:
                raise _Refused(line, error)
            if teletype.losses > losses and not is_numbered(line.text):
                raise Stopped(Finding("port-lost-at-line").within(*_place(line, name)))
            bar.update(len(line.text))


def _plain(program: str, name: str) -> list[TypedLine]:
    plain = without_numbers(program)
    if plain is None:
        raise Stopped(Finding("needs-numbers").within(name))
    # Their numbers in the file are not needed: each line is named by its text.
    return [TypedLine(0, text) for text in plain]


def _place(line: TypedLine, name: str) -> tuple[str | Phrase, ...]:
    return name, Phrase("line-number", line=line.number) if line.number else Phrase("at-line", text=line.text[:40])


def _refusal(refused: _Refused, name: str, paced: bool = True, more: Phrase | None = None) -> Finding:
    """The board's error, its place, and its meaning."""
    before = name, Phrase("before-line", line=refused.line.number)
    error = refused.error
    why = Finding("err-and", error=error.words, meaning=meaning(error.number), more=more)
    return why.within(*(_place(refused.line, name) if paced else before))


def _too_large(program: str) -> Phrase:
    least = least_ram(program)
    return Phrase("takes-ram", least=least) if least else Phrase("no-ram-enough")
