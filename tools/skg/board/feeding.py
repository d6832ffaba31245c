"""Programs through a board: stored and RUN where they fit, else line by line as they are loaded."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import tee

from skg.board.board import Board, BoardStopped, ErrorLine, find_error
from skg.errors import UserError
from skg.messages.finding import Finding, Phrase

#: Cycles after which a program hangs: 140 hours of the 2 MHz board.
MOST_CYCLES = 10**12
#: RAM that a board may have, KiB.
LEAST_RAM, MOST_RAM = 2, 56
MEMORY_FULL = 9
#: Of a program that several boards share each takes about so many characters at a time, and two of them take a route
#: of so many.
_SHARE, _TWICE = 50_000, 5_000
#: Routes that one board takes at a time where each refused one is looked for.
_ROUTES = 16
#: Ctrl-Z: nothing follows on a tape of program lines.
TAPE_END = "\x1a"
#: A line's number: blanks mean nothing, inside it too.
_NUMBERED = re.compile(r"[\0- ]*(\d[\0- \d]*)")
_MEANS_NOTHING = re.compile(r"[\0- ]")
#: Statements that need a stored program; and those that only one can read.
_STORED = ("GOTO", "GOSUB", "IF", "RETURN", "READ", "DATA", "RESTORE", "INPUT")


@dataclass(frozen=True)
class Fed:
    """The outcome of a program: the tape, the error that ended it (none: it went through), cycles of the board."""

    tape: bytes
    error: ErrorLine | None
    cycles: int


def lines_of(program: str) -> list[str]:
    """The lines of a program as LOAD takes them: CR or LF ends one, up to ctrl-Z; empty ones do not count."""
    return [line for line in re.split(r"[\r\n]", program.partition(TAPE_END)[0]) if line.strip("\0 ")]


def is_numbered(line: str) -> bool:
    """Tell whether a line begins with a number: the board stores it."""
    return bool(_NUMBERED.match(line))


def is_end(line: str) -> bool:
    """Tell whether a line without a number is an END."""
    return _bare(line) == "END"


def rest_of(program: str) -> str:
    """The command to type when a program is loaded: RUN; of one without line numbers, which has been carried out then,
    END where it lacks one, so that an open route gets its last block, else nothing."""
    lines = lines_of(program)
    if any(map(is_numbered, lines)):
        return "RUN"
    return "" if any(map(is_end, lines[-1:])) else "END"


def as_run(program: str) -> tuple[str, bool]:
    """A program as the reference is to have it, with an END that `rest_of` says, and whether it is to be RUN."""
    rest = rest_of(program)
    return (f"{program.partition(TAPE_END)[0]}\nEND\n" if rest == "END" else program), rest == "RUN"


def given_up(program: str, is_run: bool = True) -> Finding | None:
    """A warning of a program whose lines without numbers begin a route that a numbered one, or RUN, gives up without
    a block (language.md, section 3); None where there is none. `is_run`: RUN comes behind its last line."""
    opened, mixed = 0, any(map(is_numbered, lines_of(program)))
    lines = re.split(r"\r\n|[\r\n]", program.partition(TAPE_END)[0]) if mixed else []
    for number, line in enumerate([*lines, "RUN"] if is_run else lines, 1):
        bare = _bare(line)
        if opened and (is_numbered(line) or bare == "RUN"):
            by = Phrase("line-number", line=number) if number <= len(lines) else "RUN"
            return Finding("route-given-up", line=opened, by=by)
        if bare.startswith(("CUT", "FIT")):
            opened = opened or number
        elif bare.startswith(("BACK", "FROM", "END", "NEW")):
            opened = 0
    return None


def without_numbers(program: str) -> list[str] | None:
    """A numbered program as lines that are carried out as they come; None where it jumps, asks or has DATA."""
    stored: dict[int, str] = {}
    for line in lines_of(program):
        number = _NUMBERED.match(line)
        if not number:
            return None
        # A later line with the same number takes the first one's place, one without a statement deletes it.
        stored[int(_MEANS_NOTHING.sub("", number[1]))] = line[number.end() :]
    statements = [stored[number] for number in sorted(stored) if _bare(stored[number])]
    if any(_bare(statement).startswith(_STORED) for statement in statements):
        return None
    # A run ends with the first END, or past the last line.
    ends = [index for index, statement in enumerate(statements) if is_end(statement)]
    return [*statements[: min(ends, default=len(statements))], "END"]


def _bare(line: str) -> str:
    """A line as the board reads it: without blanks and control characters, in capitals."""
    return _MEANS_NOTHING.sub("", line).upper()


def feed(program: str, rom: str | bytes = "standard", ram_kib: int = 8) -> Fed:
    """LOAD a program, then type what `rest_of` says. A board that does not come back is a `BoardStopped`."""
    board = Board(rom, ram_kib, max_cycles=MOST_CYCLES)
    board.load(program)
    if not board.error and (rest := rest_of(program)):
        board.run(command=rest)
    return Fed(board.tape, board.error, board.machine.cycles)


def feed_lines(parts: Iterable[str], rom: str | bytes, ram_kib: int) -> tuple[Fed, int]:
    """LOAD parts of a program without line numbers, one after the other, until one ends in ERR.

    Returns what became of them, and how many went through.
    """
    board = _with_late_reader(rom, ram_kib)
    done, error = 0, None
    for part in parts:
        error = _load(board, part)
        if error:
            break
        done += 1
    return Fed(board.tape, error, board.machine.cycles), done


def feed_routes(
    parts: Iterable[str], rom: str | bytes, ram_kib: int, on_done: Callable[[int], None] = lambda done: None
) -> Fed:
    """Feed a program without line numbers to as many boards at once as there are processors.

    `parts`: the title, the routes, each from its FROM on, the END. A route leaves nothing behind for the next one but
    the place where the wire is. So each board begins with the last route of the one before it; where these two tapes
    differ, one board takes all. `on_done`: is called with the number of routes that are done.
    """
    from concurrent.futures import ThreadPoolExecutor  # (slow to import, and needed here alone)

    with ThreadPoolExecutor(os.cpu_count()) as boards:
        # (the first boards run while the rest of the program is still being written)
        parts, written = tee(parts)
        shares, done = [], 0
        for taken, fed in boards.map(lambda share: (len(share), _feed_share(share, rom, ram_kib)), _shares(parts)):
            shares.append(fed)
            done += taken - 1
            on_done(done)
    tape, cycles = b"", sum(fed.cycles for _, fed in shares)
    for begun, share in shares:
        if share.error:
            return Fed(tape, share.error, cycles)
        if not tape.endswith(begun):
            return feed("".join(written), rom, ram_kib)
        tape += share.tape[len(begun) :]
    return Fed(tape, None, cycles)


def refused_routes(routes: Sequence[str], rom: str | bytes, ram_kib: int) -> dict[int, ErrorLine]:
    """The errors of routes, each from its FROM on, by their numbers: behind one that is refused a new board goes on."""
    from concurrent.futures import ThreadPoolExecutor  # (slow to import, and needed here alone)

    def refused_from(first: int) -> dict[int, ErrorLine]:
        some, errors, number = routes[first : first + _ROUTES], {}, 0
        while number < len(some):
            fed, done = feed_lines(some[number:], rom, ram_kib)
            number += done
            if fed.error:
                errors[first + number] = fed.error
            number += 1
        return errors

    with ThreadPoolExecutor(os.cpu_count()) as boards:
        shares = boards.map(refused_from, range(0, len(routes), _ROUTES))
        return {number: error for errors in shares for number, error in errors.items()}


def _shares(parts: Iterable[str]) -> Iterator[Sequence[str]]:
    """Parts of a program that follow each other, with the last one of those before."""
    share: list[str] = []
    length = 0
    for part in parts:
        if length > _SHARE and len(share[-1]) <= _TWICE:
            yield share
            share, length = share[-1:], len(share[-1])
        share.append(part)
        length += len(part)
    yield share


def _feed_share(parts: Sequence[str], rom: str | bytes, ram_kib: int) -> tuple[bytes, Fed]:
    """LOAD the first of some parts, then the others: what is punched up to there, and what becomes of all."""
    board = _with_late_reader(rom, ram_kib)
    error = _load(board, parts[0])
    begun = board.tape
    error = error or _load(board, "".join(parts[1:]))
    return begun, Fed(board.tape, error, board.machine.cycles)


def _with_late_reader(rom: str | bytes, ram_kib: int) -> Board:
    """A board whose reader sends a character late, behind each line's end: the ROM waits 1,200 turns for one that does
    not come, a third of all cycles."""
    board = Board(rom, ram_kib, max_cycles=MOST_CYCLES)
    board.machine.reader_cps(0, cts=1)
    return board


def _load(board: Board, part: str) -> ErrorLine | None:
    """LOAD a part of a program; the error that it ends in."""
    try:
        # (LOAD would wait for what follows a tape without this end)
        return find_error(board.load(part + TAPE_END)[-1:])
    except BoardStopped:
        # (the late character stands at the prompt behind an error, and is no line yet)
        if board.error:
            return board.error
        raise


def least_ram(program: str, rom: str | bytes = "standard") -> int | None:
    """The RAM that a program takes, KiB; None when the largest board is too small, or another error ends it."""
    low, high = LEAST_RAM, MOST_RAM
    try:
        if feed(program, rom, high).error:
            return None
    except BoardStopped:
        return None
    while low < high:
        middle = (low + high) // 2
        low, high = (middle + 1, high) if feed(program, rom, middle).error else (low, middle)
    return low


def too_large(name: str, program: str, ram_kib: int, rom: str | bytes = "standard") -> UserError:
    """The error of a program that does not fit in the memory of a board."""
    least = least_ram(program, rom)
    always = Finding("memory-full-always", ram=ram_kib, most=MOST_RAM)
    return UserError((Finding("memory-full", ram=ram_kib, least=least) if least else always).within(name))
