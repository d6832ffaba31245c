"""`skg check`: errors on a tape."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import click

from skg.commands.options import positions_option, read_machine_option
from skg.errors import UserError
from skg.file_type import TAPE, kind_of
from skg.files import without_filling
from skg.messages.finding import Finding, Phrase
from skg.messages.render import line
from skg.rivals.languages import is_program, is_rival
from skg.sources.load import drawn_routes, iso_text, program_text, tape_bytes
from skg.sources.milling import is_milling
from skg.tape import gcode_reader
from skg.tape.block import Tape
from skg.tape.dialect import GcodeDialect
from skg.tape.styles import read_any
from skg.tape.text import TapeFault, scan
from skg.terminal import remark, show

if TYPE_CHECKING:
    from skg.checking.wire_fit import RefusedProgram, Spoilt
    from skg.geometry.plane import XY
    from skg.tape.layout import PlacedRoute

    Found = TapeFault | gcode_reader.GcodeFinding | RefusedProgram | Spoilt

#: So many findings of a tape are listed; one wrong in its style alone has some in every line.
MOST = 20


@click.command(name="check")
@click.argument("tapes_", metavar="TAPE...", nargs=-1, required=True, type=click.Path(allow_dash=True))
@click.option("--json", "as_json", is_flag=True, help="Write the findings as JSON, all of them.")
@click.option("--all", "list_all", is_flag=True, help=f"List all findings, not the first {MOST} of a tape.")
@positions_option
@read_machine_option
def command(
    tapes_: tuple[str, ...], as_json: bool, list_all: bool, positions: str, dialect: GcodeDialect | None
) -> None:
    """Check TAPE for errors: 3B, or G-code (.nc, .ngc, .gcode, .tap, .iso).

    One line for each finding: file, block (of G-code: line), column, what was expected. Exit code 1 when there is any.
    A program (.skg, .xy, .tkh) is run first, a milling program by the mill ROM. Then its wire, or tool, is laid beside
    the contours that it draws with R 0: one line for each gouge, and for each place not reached.
    TAPE - is the standard input.
    """
    all_findings: list[tuple[str, Found]] = []
    for name in tapes_:
        text = iso_text(name, dialect=dialect)
        data = tape_bytes(name) if text is None else text.encode()
        if text is not None:
            program, wrong = gcode_reader.scan(text, dialect=dialect)
            if not as_json:
                _list(name, wrong, Phrase("count-lines", count=len(text.splitlines())), list_all)
            for note in program.notes:
                remark(note.within(name))
            all_findings += [(name, finding) for finding in wrong]
        else:
            tape, faults = scan(data, name, positions)
            if not as_json:
                _list_3b(name, data, tape, faults, list_all)
            all_findings += [(name, fault) for fault in faults]
        if is_program(name):
            misfits, count = _misfits(name, data)
            if (count or misfits) and not as_json:
                _list(name, misfits, Phrase("path-beside", count=count), list_all)
            all_findings += [(name, misfit) for misfit in misfits]
    if as_json:
        click.echo(json.dumps([{"tape": name, **finding.plain()} for name, finding in all_findings]))
    if all_findings:
        raise SystemExit(1)


def _misfits(name: str, tape: bytes) -> tuple[list[Spoilt | RefusedProgram], int]:
    """Lay the wire of a program that runs beside what it draws: what it spoils, and how many contours it has.

    `tape`: what it punches.
    """
    # (slow to import, and not needed for tapes)
    from skg.board.feeding import as_run
    from skg.checking.wire_fit import RefusedProgram, look
    from skg.ref.drawn import routes_of
    from skg.sources.load import start_of

    text = program_text(name)
    program, runs = as_run(text)
    mills = is_milling(text)
    wires, result = routes_of(program, runs, mills)
    refused: list[Spoilt | RefusedProgram] = [RefusedProgram(*result.error)] if result.error else []
    if not any(segment.offset for wire in wires for segment in wire):
        return refused, 0
    drawn = drawn_routes(name, program, runs, mills)
    # (nearly always they are equal)
    tapes = () if tape == result.tape else (tape, result.tape)
    cut = [_placed(tape, start_of(result), mills) for tape in tapes]
    found, wanted = cut or ((), ())
    misfits, count = look(wires, drawn, "cutter" if mills else "wire", found, wanted, is_whole=not refused)
    # (lines of a program that was translated are nobody's)
    return [*refused, *(replace(misfit, line=None) if is_rival(name) else misfit for misfit in misfits)], count


def _placed(tape: bytes, start: XY, mills: bool) -> list[PlacedRoute]:
    """The routes on a tape, or in a milling program, that may break off."""
    from skg.sources.load import lay_out

    if mills:
        return gcode_reader.scan(tape.decode("ascii"))[0].routes()
    return lay_out(replace(scan(tape)[0], drift=True), start, "programmed")[0]


def _list(
    name: str,
    findings: Sequence[TapeFault | gcode_reader.GcodeFinding | RefusedProgram | Spoilt],
    size: Phrase,
    list_all: bool,
) -> None:
    """Write the findings of a tape, or that there is none."""
    if not findings:
        show(line(Finding("nothing-wrong", size=size).within(name)))
    listed = findings if list_all else findings[:MOST]
    for finding in listed:
        show(line(finding.finding.within(name)))
    if len(findings) > len(listed):
        show(line(Finding("more-findings", number=len(findings) - len(listed)).within(name)))


def _list_3b(name: str, data: bytes, tape: Tape, findings: list[TapeFault], list_all: bool) -> None:
    """The same of a 3B tape, and how it is read when it is written in another style."""
    notes: Sequence[Finding] = ()
    if findings:
        try:
            notes = read_any(data, name).notes
        except UserError as error:
            if kind_of(data) not in (None, TAPE) or not tape.blocks and len(findings) > MOST and not list_all:
                # No tape at all: every line is a finding.
                show(str(error))
                return
    _list(name, findings, Phrase("count-blocks", count=len(tape.blocks)), list_all)
    if b"\x1a" in data[len(without_filling(data)) :]:
        remark(Finding("ctrl-zs").within(name))
    for note in notes:
        remark(Finding("other-style-read", note=note).within(name))
