"""`skg check`: everything on a tape that a controller would choke on."""

from __future__ import annotations

import json
from dataclasses import asdict

import click

from skg.commands.options import positions_option
from skg.drawing.source import tape_bytes
from skg.errors import UserError
from skg.tape.styles import read_any
from skg.tape.text import Finding, scan

#: So many findings of a tape are listed; one wrong in its style alone has some in every line.
MOST = 20


@click.command(name="check")
@click.argument("tapes_", metavar="TAPE...", nargs=-1, required=True, type=click.Path(allow_dash=True))
@click.option("--json", "as_json", is_flag=True, help="Write the findings as JSON, all of them.")
@click.option("--all", "list_all", is_flag=True, help=f"List all findings, not the first {MOST} of a tape.")
@positions_option
def command(tapes_: tuple[str, ...], as_json: bool, list_all: bool, positions: str) -> None:
    """Find everything on TAPE that a 3B controller would choke on.

    One line for each finding: file, block, column, what was expected. Exit code 1 when there is any.
    A program (.skg, .xy, .tkh) is run first.
    TAPE - is the standard input.
    """
    found: list[tuple[str, Finding]] = []
    for name in tapes_:
        data = tape_bytes(name)
        tape, findings = scan(data, name, positions)
        found += [(name, finding) for finding in findings]
        if as_json:
            continue
        if not findings:
            click.echo(f"{name}: {len(tape.blocks)} blocks, nothing wrong")
            continue
        try:
            notes = read_any(data, name).notes
        except UserError as error:
            if not tape.blocks and len(findings) > MOST and not list_all:
                # No tape at all: every line is a finding.
                click.echo(str(error))
                continue
            notes = ()
        listed = findings if list_all else findings[:MOST]
        for finding in listed:
            click.echo(f"{name}: {finding}")
        if len(findings) > len(listed):
            click.echo(f"{name}: {len(findings) - len(listed)} more (--all lists them)")
        for note in notes:
            click.echo(
                f"skg: {name}: {note}; the other commands read it so, and `skg tape` writes it as the punch", err=True
            )
    if as_json:
        click.echo(json.dumps([{"tape": name, **asdict(finding)} for name, finding in found]))
    if found:
        raise SystemExit(1)
