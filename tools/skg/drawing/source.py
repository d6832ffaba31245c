"""Where a tape comes from: a .3b file, G-code (.nc, .ngc …), or a program (.skg, or a rival's) that is run first."""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

from skg.errors import UserError
from skg.files import read_ascii, read_bytes
from skg.kinds import GCODE, PROGRAM, refuse_others
from skg.machine.board import BoardStopped, find_error
from skg.machine.feeding import MEMORY_FULL, MOST_CYCLES, MOST_RAM, feed, least_ram, too_large
from skg.piece import Piece
from skg.plane import XY
from skg.rivals.languages import is_program, is_rival, translated
from skg.tape import text as tapes
from skg.tape.block import Tape, micrometres
from skg.tape.gcode import GcodeProgram, is_gcode
from skg.tape.gcode import read as read_gcode
from skg.tape.placed import PlacedRoute, place, stop_places
from skg.tape.positions import decide

#: What is not understood (language.md, section 6).
SYNTAX = 1


@dataclass(frozen=True)
class Made:
    """A tape, where its wire starts on the drawing (mm), and its nominal contour, if it was asked for."""

    tape: Tape
    start: XY = (0.0, 0.0)
    contour: tuple[Piece, ...] = ()


def load(name: str, skg80: str | None = None, with_contour: bool = False) -> Made:
    """Return what is in a file: a program when its name ends in .skg or as a rival's does, else a tape.

    `skg80` runs it: None the board with the standard ROM, "reference", or the path of another emulator.
    `with_contour` on a tape, and a program that ends in ERR, are a `UserError`.
    """
    if not is_program(name):
        if with_contour:
            raise UserError(f"{name}: a tape has no nominal contour, expected a .skg program")
        if is_gcode(name):
            program = gcode(name)
            return Made(program.tape(), (program.home[0] / 1000, program.home[1] / 1000))
        tape = tapes.read(name)
        return Made(tape, tape.start or (0.0, 0.0))
    # The reference is needed in any case: only it knows where on the drawing the wire is.
    data, start, contour = _run(name, skg80, with_contour)
    tape = tapes.parse(data, name)
    if skg80 in (None, "reference"):
        # The standard ROM or the reference as it is.
        tape = replace(tape, drift=True)
    return Made(tape, start, contour)


def gcode(name: str) -> GcodeProgram:
    """Return the G-code in a file, told by its name's end; what is odd about it but can be read is no matter here."""
    return read_gcode(gcode_text(name), name)


def gcode_text(name: str) -> str:
    """Return the text of a file that should be G-code; another kind of file is a `UserError`."""
    text = read_ascii(name)
    refuse_others(text.encode(), name, GCODE)
    return text


def tape_bytes(name: str, skg80: str | None = None) -> bytes:
    """Return a tape's bytes: those of a file (`-`: the standard input), or what its program punches."""
    return _run(name, skg80, False)[0] if is_program(name) else read_bytes(name)


def program_text(name: str) -> str:
    """Return the SKG program that is in a file, or that a rival's is translated to."""
    return translated(name) if is_rival(name) else checked_program(read_ascii(name), name)


def checked_program(text: str, name: str) -> str:
    """Return what is in a file if it may be a program; another kind of file, and an empty one, is a `UserError`."""
    refuse_others(text.encode("latin-1", "replace"), name, PROGRAM)
    if not text.strip("\0\x1a \t\r\n"):
        raise UserError(f"{name}: empty, expected {PROGRAM}")
    return text


def _run(name: str, skg80: str | None, with_contour: bool) -> tuple[bytes, XY, tuple[Piece, ...]]:
    """Run a program: the tape's bytes, where the wire starts (mm), the nominal contour."""
    text = program_text(name)
    data, start, contour = _run_reference(name, text, with_contour)
    if skg80 is None:
        data = _run_rom(name, text)
    elif skg80 != "reference":
        data = _run_emulator(name, text, skg80)
    return data, start, contour


def _run_rom(name: str, text: str) -> bytes:
    """Run a program on the board, by the standard ROM; one that needs more memory gets it, with a word."""
    try:
        fed = feed(text)
        if fed.error and fed.error.number == MEMORY_FULL:
            fed = feed(text, ram_kib=MOST_RAM)
            if fed.error and fed.error.number == MEMORY_FULL:
                raise too_large(name, text, MOST_RAM)
            if not fed.error:
                print(f"skg: {name}: takes {least_ram(text)} KiB of RAM, more than the board's 8", file=sys.stderr)
    except BoardStopped as stopped:
        raise UserError(f"{name}: {stopped}") from None
    if fed.error:
        raise _failure(name, text, *fed.error)
    return fed.tape


def _run_emulator(name: str, text: str, skg80: str) -> bytes:
    """Run a program on an emulator of one's own."""
    if not Path(skg80).exists():
        raise UserError(f"{skg80}: no such file")
    try:
        with tempfile.TemporaryDirectory() as folder:
            part = Path(folder) / "part.skg"
            part.write_text(text)
            done = subprocess.run([skg80, "--max-cycles", str(MOST_CYCLES), part], capture_output=True, check=False)
    except PermissionError:
        raise UserError(f"{skg80}: not a program that can be run") from None
    if done.returncode:
        lines = done.stderr.decode("ascii", "replace").strip().splitlines()
        error, last = find_error(lines), lines[-1:]
        if error and error.number == MEMORY_FULL:
            raise too_large(name, text, 8)
        if error:
            raise _failure(name, text, *error)
        raise UserError(f"{name}: {last[0] if last else f'{skg80} ended with {done.returncode}'}")
    return done.stdout


#: A line that begins with a statement of milling (milling.md), which the ROM for wire does not know.
_MILLING = re.compile(r"^\s*(\d+)\s*(?:F(?!ROM|IT|REE)|G(?!OTO|OSUB)|Z|M|HOLE)", re.I | re.M)


def _is_milling(text: str) -> bool:
    """Whether a program is understood as one of milling."""
    from skg.ref import mill
    from skg.ref.interpreter import Endless

    try:
        found = mill.run(text, patience=1).error
    except Endless:
        return True
    return not found or found[0] != SYNTAX


def _failure(name: str, text: str, number: int, line: int | None) -> UserError:
    if number == SYNTAX and str(line) in _MILLING.findall(text) and _is_milling(text):
        return UserError(
            f"{name}: line {line} is of a milling program: `skg run --rom mill {name} -o part.nc` makes its tape, and "
            "plot, check and gcode read that"
        )
    where = f" LINE {line}" if line is not None else ""
    contour = _contour_at(text, line) if line is not None else ""
    return UserError(f"{name}: ERR {number:02d}{where}" + (f", in contour {contour}" if contour else ""))


def _contour_at(text: str, line: int) -> str:
    """The contour that a line cuts, as the REM over it has it in a program that was made of a drawing; else nothing."""
    found = ""
    for number, statement in re.findall(r"^\s*(\d+)\s*(.*?)\s*$", text, re.M):
        if len(number) > 4 or int(number) > line:
            break
        title = re.match(r"REM (\d+\. .*)", statement)
        found = title[1] if title else "" if statement == "END" else found
    return found


def _run_reference(name: str, text: str, with_contour: bool) -> tuple[bytes, XY, tuple[Piece, ...]]:
    """Run a program through the reference: the tape's bytes, where the wire starts (mm), the nominal contour."""
    # (slow to import, and not needed for tapes)
    from skg.drawing.nominal import nominal
    from skg.ref import run

    result = run(text)
    if result.error:
        raise _failure(name, text, *result.error)
    start = (float(result.path[0].start.x), float(result.path[0].start.y)) if result.path else (0.0, 0.0)
    return result.tape, start, nominal(result.path) if with_contour else ()


def lay_out(made: Made, start: XY, positions: str, joints: str) -> tuple[list[PlacedRoute], list[XY]]:
    """Return a tape's routes and stops in µm, its wire starting at `start` (mm).

    `positions` is one of `skg.tape.positions.POSITIONS`. `joints` "drawn": where the corners most likely were before
    the tape's rounding; "tape": at the whole µm that the blocks or the controller end at.
    """
    from skg.tape.joints import estimate  # which loads numpy

    home = micrometres(start[0]), micrometres(start[1])
    if joints == "tape":
        routes = place(made.tape, home, positions)
    else:
        routes = estimate(made.tape, home, decide(made.tape, positions).positions == "machine")
    return routes, stop_places(made.tape, routes, home)
