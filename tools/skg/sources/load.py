"""Sources of tapes: a .3b file, G-code (.nc, .ngc …), or a program (.skg, or a rival's) that is run first.

A milling program's tape is G-code.
"""

from __future__ import annotations

import re
import subprocess
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from skg.board.board import BoardStopped, ErrorLine, find_error, meaning
from skg.board.feeding import MEMORY_FULL, MOST_CYCLES, MOST_RAM, as_run, feed, given_up, least_ram, too_large
from skg.board.roms import rom_path
from skg.errors import UserError
from skg.file_type import GCODE, PROGRAM, refuse_others
from skg.files import board_text, in_ascii, read_bytes, without_filling, without_mark
from skg.geometry.piece import Piece
from skg.geometry.plane import XY
from skg.messages.finding import Finding, Phrase
from skg.rivals.languages import is_program, is_rival, translated
from skg.sources.milling import MILL_ROM, is_milling
from skg.tape import text as tapes
from skg.tape.block import Tape, micrometres
from skg.tape.dialect import GcodeDialect
from skg.tape.gcode import is_gcode
from skg.tape.gcode_program import GcodeProgram
from skg.tape.gcode_reader import read as read_gcode
from skg.terminal import remark

if TYPE_CHECKING:
    from skg.ref import Result
    from skg.ref.drawn import Routes
    from skg.ref.route import Segment
    from skg.tape.layout import PlacedRoute


def load(name: str, skg80: str | None = None, dialect: GcodeDialect | None = None) -> Tape:
    """Return what is in a file: a program when its name ends in .skg or as a rival's does, else a tape.

    `skg80` runs it: None the board with the standard ROM, "reference", or the path of another emulator. One that ends
    in ERR is a `UserError`. `dialect`: the file is G-code of a machine, whatever its name.
    """
    if program := iso_program(name, skg80, dialect):
        return replace(program.tape(), notes=program.left_out())
    if not is_program(name):
        return tapes.read(name)
    text = program_text(name)
    _say_given_up(name, text)
    # (it is needed in any case: only the reference knows where on the drawing the wire is)
    result = _reference(name, text)
    tape = tapes.parse(result.tape if skg80 == "reference" else _tape_of(name, text, skg80), name)
    if skg80 in (None, "reference"):
        # The standard ROM or the reference as it is.
        tape = replace(tape, drift=True)
    return replace(tape, start=start_of(result))


def start_of(result: Result) -> XY:
    """The place on the drawing where a program's wire starts, mm."""
    return (float(result.path[0].start.x), float(result.path[0].start.y)) if result.path else (0.0, 0.0)


def iso_program(name: str, skg80: str | None = None, dialect: GcodeDialect | None = None) -> GcodeProgram | None:
    """The G-code in a file, told by its name's end, or that of a milling program; else None.

    Odd things that can be read are ignored, guesses are reported. `skg80` and `dialect` as in `load`.
    """
    text = iso_text(name, skg80, dialect)
    return None if text is None else iso_of(text, name, dialect)


def iso_of(text: str, name: str, dialect: GcodeDialect | None = None) -> GcodeProgram:
    """Read G-code; what it does not tell and is guessed, and what of it is no cut, is said on standard error."""
    program = read_gcode(text, name, dialect)
    for note in (*program.guesses, *program.notes):
        remark(note.within(name))
    return program


def _is_gcode(name: str, dialect: GcodeDialect | None) -> bool:
    """Tell whether a file is G-code: by its name, or since it is that of a machine."""
    return is_gcode(name) or dialect is not None and not is_program(name) and not name.lower().endswith(".3b")


def is_iso(name: str, dialect: GcodeDialect | None = None) -> bool:
    """Tell whether a file is G-code or a milling program: their stops are pauses, and turn no wire off or on."""
    return _is_gcode(name, dialect) or _milling_text(name) is not None


def _milling_text(name: str) -> str | None:
    """The text of a file that is a milling program; else None."""
    if not is_program(name) or is_rival(name):
        return None
    text = program_text(name)
    return text if is_milling(text) else None


def iso_text(name: str, skg80: str | None = None, dialect: GcodeDialect | None = None) -> str | None:
    """The text of `iso_program`."""
    if _is_gcode(name, dialect):
        return gcode_text(name)
    text = _milling_text(name)
    if text is None:
        return None
    if skg80 is None:
        note = Finding("milling-by-rom")
    else:
        note = Finding("milling-by-reference") if skg80 == "reference" else Finding("milling-by", emulator=skg80)
    remark(note.within(name))
    _say_given_up(name, text)
    return _tape_of(name, text, skg80, mills=True).decode("ascii")


def gcode_text(name: str) -> str:
    """Return the text of a file that should be G-code; another kind of file is a `UserError`."""
    data = read_bytes(name)
    refuse_others(data, name, GCODE)
    return in_ascii(without_mark(without_filling(data)))


def tape_bytes(name: str) -> bytes:
    """Return a tape's bytes: those of a file (`-`: the standard input), or what its program punches."""
    if not is_program(name):
        return read_bytes(name)
    text = program_text(name)
    _say_given_up(name, text)
    return _tape_of(name, text, None)


def contour_of(name: str) -> tuple[Piece, ...]:
    """The nominal contour of a program, mm; a tape has none, which is a `UserError`."""
    if not is_program(name):
        raise UserError(Finding("no-nominal-contour").within(name))
    text = program_text(name)
    drawn = drawn_routes(name, *as_run(text), is_milling(text))
    return tuple(_piece(segment) for route in drawn for segment in route if segment.nominal is not None)


def drawn_routes(name: str, program: str, runs: bool, mills: bool) -> Routes:
    """The routes of a program as it draws them, with R 0; one that ends in ERR then is a `UserError`."""
    # (slow to import, and not needed for tapes)
    from skg.ref.drawn import routes_of

    drawn, result = routes_of(program, runs, mills, is_drawn=True)
    if result.error:
        number, line = result.error
        where = None if line is None else Phrase("of-line", line=line)
        raise UserError(Finding("draws-no-contour", number=number, where=where).within(name))
    return drawn


def _piece(segment: Segment) -> Piece:
    """A segment of the reference as a line or arc."""
    start, end = ((float(point.x), float(point.y)) for point in (segment.start, segment.end))
    if segment.centre is None or segment.radius is None or segment.sweep is None:
        return Piece(start, end)
    sweep = float(segment.sweep) * (1 if segment.radius > 0 else -1)
    return Piece(start, end, (float(segment.centre.x), float(segment.centre.y)), sweep)


def program_text(name: str) -> str:
    """Return the SKG program that is in a file, or that a rival's is translated to; another kind of file, and an empty
    one, is a `UserError`."""
    if is_rival(name):
        return translated(name)
    data = read_bytes(name)
    refuse_others(data, name, PROGRAM)
    text = board_text(data, name)
    if not text.strip("\0\x1a \t\r\n"):
        raise UserError(Finding("empty-program", expected=PROGRAM).within(name))
    return text


def _say_given_up(name: str, text: str) -> None:
    if lost := given_up(text):
        remark(lost.within(name))


def _tape_of(name: str, text: str, skg80: str | None, mills: bool = False) -> bytes:
    """The tape of a program, by the ROM or by what `skg80` names."""
    if skg80 is None:
        return _run_rom(name, text, MILL_ROM if mills else "standard")
    if skg80 == "reference":
        return _reference(name, text, mills).tape
    return _run_emulator(name, text, skg80, mills)


def _run_rom(name: str, text: str, rom: str) -> bytes:
    """Run a program on the board; one that needs more memory gets it, with a word."""
    try:
        fed = feed(text, rom)
        if fed.error and fed.error.number == MEMORY_FULL:
            fed = feed(text, rom, MOST_RAM)
            if fed.error and fed.error.number == MEMORY_FULL:
                raise too_large(name, text, MOST_RAM, rom)
            if not fed.error:
                least = least_ram(text, rom)
                remark(Finding("takes-more-ram", least=least).within(name))
    except BoardStopped as stopped:
        raise UserError(stopped.finding.within(name)) from None
    if fed.error:
        if fed.error.line is None:
            # The board shows the line that it does not understand, the reference says its number.
            _reference(name, text, rom == MILL_ROM)
        raise _failure(name, text, *fed.error)
    return fed.tape


def _run_emulator(name: str, text: str, skg80: str, mills: bool) -> bytes:
    """Run a program on an emulator of one's own."""
    if not Path(skg80).exists():
        raise UserError(Finding("no-such-file").within(skg80))
    rom: list[str | Path] = ["--rom", rom_path(MILL_ROM)] if mills else []
    try:
        with tempfile.TemporaryDirectory() as folder:
            part = Path(folder) / "part.skg"
            part.write_text(text)
            words: list[str | Path] = [skg80, *rom, "--max-cycles", str(MOST_CYCLES), part]
            done = subprocess.run(words, capture_output=True, check=False)
    except PermissionError:
        raise UserError(Finding("not-runnable").within(skg80)) from None
    if done.returncode:
        lines = done.stderr.decode("ascii", "replace").strip().splitlines()
        error, last = find_error(lines), lines[-1:]
        if error and error.number == MEMORY_FULL:
            raise too_large(name, text, 8, MILL_ROM if mills else "standard")
        if error:
            raise _failure(name, text, *error)
        ended = Finding("emulator-ended", emulator=skg80, code=done.returncode)
        said = Finding("emulator-says", emulator=skg80, code=done.returncode, detail=last[0]) if last else ended
        raise UserError(said.within(name))
    return done.stdout


def _failure(name: str, text: str, number: int, line: int | None) -> UserError:
    contour = _contour_at(text, line) if line is not None else ""
    where = Phrase("in-contour", contour=contour) if contour else None
    error = ErrorLine(number, line).words
    return UserError(Finding("program-refused", error=error, meaning=meaning(number), where=where).within(name))


def _contour_at(text: str, line: int) -> str:
    """The contour that a line cuts, as the REM over it has it in a program that was made of a drawing; else nothing."""
    result = ""
    for number, statement in re.findall(r"^\s*(\d+)\s*(.*?)\s*$", text, re.M):
        if len(number) > 4 or int(number) > line:
            break
        title = re.match(r"REM (\d+\. .*)", statement)
        result = title[1] if title else "" if statement == "END" else result
    return result


def _reference(name: str, text: str, mills: bool = False) -> Result:
    """Run a program by the reference; one that ends in ERR is a `UserError`."""
    # (slow to import, and not needed for tapes)
    from skg.ref import mill, run

    program, runs = as_run(text)
    result = (mill.run if mills else run)(program, runs=runs)
    if result.error:
        raise _failure(name, text, *result.error)
    return result


def lay_out(tape: Tape, start: XY, positions: str) -> tuple[list[PlacedRoute], list[XY]]:
    """Return a tape's routes and stops in µm, its wire starting at `start` (mm); `positions` is one of
    `skg.tape.positions.POSITIONS`."""
    from skg.tape.layout import place, stop_places  # which loads numpy

    home = micrometres(start[0]), micrometres(start[1])
    routes = place(tape, home, positions)
    return routes, stop_places(tape, routes, home)
