"""The board with its operator: loads programs, runs them, takes paper and tape."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import NamedTuple

from skg.board.emulator import Machine
from skg.board.roms import find_rom
from skg.errors import UserError
from skg.messages.finding import Finding, Phrase
from skg.signs import shown, strange, with_signs

#: Cycles after which the operator looks at the paper again; those that a silent machine may wait for a key, and for a
#: character from the empty reader: LOAD gives up sooner, unless nothing has come yet.
SLICE, PATIENCE, READER_PATIENCE = 10_000_000, 20_000_000, 6_000_000
_CTRL_C = 3
_ERROR = re.compile(r"ERR (\d\d)(?: LINE (\d+))?")
_PROMPT = ">"


#: Numbers of the errors (language.md, section 6).
ERRORS = range(1, 11)


def meaning(error: int) -> Phrase:
    """The meaning of an error."""
    return Phrase(f"meaning-{error}") if error in ERRORS else Phrase("meaning-unknown")


class ErrorLine(NamedTuple):
    """An `ERR` of the machine: its number (language.md, section 6) and its line, None outside a program."""

    number: int
    line: int | None

    @property
    def words(self) -> str:
        """As the board prints it."""
        return f"ERR {self.number:02d}" + (f" LINE {self.line}" if self.line is not None else "")


class BoardStopped(UserError):
    """The machine does not come back to its prompt.

    `reason`: "cycles" (max_cycles are used up), "input" (INPUT asks where no answer was to be given), "wait" (for a
    key anywhere else, or for a tape), "halt", "nobody" (it reads a port without a chip, or prints nothing),
    "break" (it runs into a part of the ROM that the image leaves out, or comes to a breakpoint of `machine`).
    """

    def __init__(self, reason: str, why: Finding) -> None:
        super().__init__(why)
        self.reason = reason


class Board:
    """An SKG board at its prompt, with an operator.

    `rom`: "standard", "no-drift", "mill", "drive", "8251", "tty", "rc2014", "rc2014-sio", "minimax8085", "rcbus8085",
    the path of an image (.bin or .hex), or its bytes.
    `ram_kib`: 2 to 56. `board` one of `skg.board.emulator.BOARDS`, `ports` (the lower one of the teletype's and
    of the punch's) and `punch_tty` (a teletype alone, its own punch and reader) tell what an image of one's own is made
    for. `max_cycles`: how long one line or one program may take, in cycles of the 2 MHz board (None: for ever).
    `on_paper` is called with all that is printed, as it is printed.

    A board that stops anywhere but at its prompt raises `BoardStopped`. `machine` is the emulator underneath: memory,
    registers, cycles.
    """

    def __init__(
        self,
        rom: str | bytes = "standard",
        ram_kib: int = 8,
        *,
        board: str = "6850",
        ports: tuple[int, int] | None = None,
        punch_tty: bool = False,
        max_cycles: int | None = None,
        on_paper: Callable[[str], object] | None = None,
    ) -> None:
        if isinstance(rom, str):
            image, missing, known = find_rom(rom)
            board = known.board if known.board != "6850" else board
            punch_tty = punch_tty or known.punch_tty
        else:
            image, missing = rom, []
        self.machine = Machine(image, ram_kib, board=board, ports=ports, punch_tty=punch_tty)
        for address in missing:
            self.machine.set_break(address)
        self.max_cycles = max_cycles
        self.on_paper = on_paper
        self._reported = 0
        self._at_prompt()

    def type(self, line: str) -> list[str]:
        """Type a line and CR. Returns the lines printed up to the next prompt, without the echo."""
        start = len(self.paper)
        self._type(line)
        self._at_prompt()
        return self._lines(start)

    def load(self, program: str | bytes) -> list[str]:
        """Put a program into the reader as a tape, in an old one's place, and LOAD it. Returns the lines printed."""
        tape = _ascii(program) if isinstance(program, str) else program
        # The last line is ended if the program does not; ctrl-Z ends a tape by itself.
        # LOAD stops at a line that it refuses: the rest of that tape is not a part of this program.
        self.machine.take_tape()
        self.machine.tape(tape if tape.endswith((b"\n", b"\r", b"\x1a")) else tape + b"\n")
        start = len(self.paper)
        self._type("LOAD")
        self.machine.reader(True)
        self._at_prompt()
        return self._lines(start)

    def run(self, answers: Iterable[str] = (), command: str = "RUN") -> list[str]:
        """RUN the program, or give another command that may ask. `answers` are typed when INPUT asks; INPUT that finds
        none left is broken off with ctrl-C (ERR 10). Returns the lines printed."""
        start, waiting = len(self.paper), iter(answers)
        self._type(command)
        while (reason := self._until_asked()) == "input":
            answer = next(waiting, None)
            if answer is None:
                self.machine.press(_CTRL_C)
            else:
                self._type(answer)
        self._check(reason)
        return self._lines(start)

    def clear(self) -> None:
        """Tear off paper and tape, and forget the drive's steps."""
        self.machine.clear()
        self._reported = 0

    @property
    def paper(self) -> str:
        """All that was printed since the start or `clear`."""
        return self.machine.tty

    @property
    def tape(self) -> bytes:
        """All that was punched since the start or `clear`."""
        return self.machine.punch

    @property
    def steps(self) -> bytes:
        """The drive's steps since the start or `clear`, a byte each: the value of its port (docs/spec/drive.md)."""
        return self.machine.steps

    @property
    def error(self) -> ErrorLine | None:
        """The last `ERR` of the board on the paper, None where there is none.

        PRINT may write the same words. A prompt follows them only where the PRINT was typed without a line number, and
        then its text stands above; but where LOAD has read it as the last line of a tape, it is taken for an error.
        """
        lines = ["", *self.paper.split("\r\n")]
        for before, line, after in zip(lines[-3::-1], lines[-2::-1], lines[::-1], strict=False):
            if after.startswith(_PROMPT) and (error := find_error([line])) and not is_printed(error, before):
                return error
        return None

    def _type(self, line: str) -> None:
        self.machine.type(_ascii(line) + b"\r")

    def _lines(self, start: int) -> list[str]:
        """The lines from a place of the paper up to the prompt, without the first one, the echo."""
        return self.machine.paper_from(start).removesuffix(">").split("\r\n")[1:-1]

    def _at_prompt(self) -> None:
        self._check(self._until_asked())

    def _until_asked(self) -> str:
        """Let the machine run until it asks the operator something, or until something else; see `Machine.run`."""
        machine = self.machine
        end = None if self.max_cycles is None else machine.cycles + self.max_cycles
        since = machine.cycles
        while end is None or machine.cycles < end:
            printed = machine.printed
            reason = machine.run(SLICE if end is None else min(SLICE, end - machine.cycles))
            self._report()
            if not machine.printed and machine.cycles > PATIENCE:
                raise BoardStopped("nobody", Finding("board-mute", cycles=machine.cycles))
            if machine.reader_silence > READER_PATIENCE:
                return "wait"
            if reason == "cycles" or machine.printed != printed:
                since = machine.cycles
            if reason != "cycles" and (reason != "wait" or machine.cycles - since > PATIENCE):
                return reason
        return "cycles"

    def _report(self) -> None:
        if self.on_paper and self.machine.printed != self._reported:
            self.on_paper(self.machine.paper_from(self._reported))
            self._reported = self.machine.printed

    def _check(self, reason: str) -> None:
        if reason == "prompt":
            return
        raise BoardStopped(reason, self._why(reason))

    def _why(self, reason: str) -> Finding:
        """The finding of a `BoardStopped`."""
        last = self.paper.rpartition("\n")[2]
        address = self.machine.registers["pc"]
        match reason:
            case "cycles":
                return Finding("cycles-used-up", cycles=self.max_cycles)
            case "input":
                return Finding("no-answer")
            case "wait" if self.machine.reader_silence > READER_PATIENCE:
                return Finding("reader-empty")
            case "wait":
                return Finding("board-waits", last=last)
            case "halt":
                return Finding("board-halted", address=(address - 1) & 0xFFFF)
            case "nobody":
                port, chip = self.machine.nobody
                return Finding("port-not-set-up" if chip else "port-without-chip", port=port)
            case _:
                return Finding("no-code", address=address)


def find_error(lines: Iterable[str]) -> ErrorLine | None:
    """The `ERR` with which lines of paper end, prompts and empty lines behind it left out."""
    last = next((line for line in reversed([*lines]) if line.strip(f"{_PROMPT}\r\n ")), "")
    match = _ERROR.fullmatch(last)
    return ErrorLine(int(match[1]), int(match[2]) if match[2] else None) if match else None


def is_printed(error: ErrorLine, typed: str) -> bool:
    """Tell whether a line that was typed writes the words of an error by itself."""
    return f'"{error.words}"' in typed


def _ascii(text: str) -> bytes:
    text = with_signs(text)
    if odd := strange(text):
        raise UserError(Finding("not-ascii-typed", column=odd.start() + 1, character=shown(odd[0])))
    return text.encode("ascii")
