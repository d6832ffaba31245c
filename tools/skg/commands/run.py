"""`skg run`: a program on the board, by the ROM itself."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import suppress

import click

from skg.board.board import Board, BoardStopped, meaning
from skg.board.feeding import MEMORY_FULL, given_up, rest_of, too_large
from skg.board.roms import ROMS, known_rom
from skg.commands.options import answers_option, output_option, unmarked, write_tape
from skg.errors import UserError
from skg.files import board_text, read_bytes
from skg.messages.finding import Finding
from skg.sources.load import program_text
from skg.sources.milling import MILL_ROM, is_milling
from skg.tape.text import parse
from skg.terminal import remark as say

#: Exit codes, those of build/skg80; by the reason for which the board stopped, else ERR.
ERR, STOPPED = 1, {"cycles": 3, "nobody": 2, "break": 2}


def _answers(name: str | None) -> Iterator[str]:
    yield from board_text(read_bytes(name), name).splitlines() if name else ()
    raise BoardStopped("input", Finding("answers-used-up"))


@click.command(name="run")
@click.argument("part", type=click.Path(allow_dash=True))
@output_option("Tape to write, - for the standard output.")
@click.option(
    "--rom",
    metavar="NAME|FILE",
    help=f"The ROM: {', '.join(ROMS)}, or an image of your own, .bin or Intel .hex.  [default: "
    "standard; mill, reported, for a milling program]",
)
@click.option("--ram", default=8, metavar="KIB", type=click.IntRange(2, 56), help="The board's RAM, KiB.")
@answers_option
@click.option(
    "--max-cycles",
    metavar="N",
    type=click.IntRange(1),
    help="Most cycles of LOAD or RUN; more end it with exit code 3.",
)
def command(part: str, output: str, rom: str | None, ram: int, answers: str | None, max_cycles: int | None) -> None:
    """LOAD and RUN PART on the board, by the ROM itself.

    PART is an SKG program, or a rival's (.xy, .tkh), which is translated; `-`: an SKG program on the standard input.

    The teletype's paper goes to standard error, the tape to --output. Exit code 1 when the run ended in ERR, when INPUT
    found no answer or the machine halted, 2 for wrong usage, files and ROMs, 3 when --max-cycles were not enough.
    """
    if part == answers == "-":
        raise UserError(Finding("program-and-answers"))
    text, line_begins = program_text(part), True

    if rom is None:
        rom = MILL_ROM if is_milling(text) else "standard"
        if rom == MILL_ROM:
            say(Finding("milling-by-rom").within(part))

    def show(paper: str) -> None:
        nonlocal line_begins
        click.echo(paper, err=True, nl=False)
        line_begins = paper.endswith("\n")

    def remark(finding: Finding) -> None:
        if not line_begins:
            show("\r\n")
        say(finding)

    tape, code = b"", 0
    try:
        board = Board(rom, ram, max_cycles=max_cycles, on_paper=show)
        try:
            board.load(text)
            if not board.error and (rest := rest_of(text)):
                board.run(_answers(answers), rest)
        finally:
            tape = board.tape
        code = ERR if board.error else 0
        if board.error and not (board.error.number == MEMORY_FULL and not answers):
            remark(Finding("err", error=board.error.words, meaning=meaning(board.error.number)).within(part))
        if board.error and board.error.number == MEMORY_FULL and not answers:
            remark(too_large(part, text, ram, rom).finding)
    except BoardStopped as stopped:
        remark(stopped.finding.within(part))
        code = STOPPED.get(stopped.reason, ERR)
    write_tape(output, tape, is_whole=not code)
    if lost := given_up(text):
        remark(lost.within(part))
    known = known_rom(rom)
    if output != "-" and code == 0 and known not in (None, MILL_ROM):
        # (a tape of several runs is none to the other commands)
        with suppress(UserError):
            for finding in unmarked(output, parse(tape, part), known):
                remark(finding.within(output))
    sys.exit(code)
