"""`skg check`: everything on a tape that a controller would choke on."""

from __future__ import annotations

import json
from dataclasses import asdict

import click

from skg.drawing.source import tape_bytes
from skg.tape.text import Finding, scan


@click.command(name="check")
@click.argument("tapes_", metavar="TAPE...", nargs=-1, required=True, type=click.Path(allow_dash=True))
@click.option("--json", "as_json", is_flag=True, help="Write the findings as JSON.")
def command(tapes_: tuple[str, ...], as_json: bool) -> None:
    """Find everything on TAPE that a 3B controller would choke on.

    One line for each finding: file, block, column, what was expected. Exit code 1 when there is any.
    A program (.skg, .xy) is run first.
    TAPE - is the standard input.
    """
    found: list[tuple[str, Finding]] = []
    for name in tapes_:
        tape, findings = scan(tape_bytes(name), name)
        found += [(name, finding) for finding in findings]
        if not as_json and not findings:
            click.echo(f"{name}: {len(tape.blocks)} blocks, nothing wrong")
    if as_json:
        click.echo(json.dumps([{"tape": name, **asdict(finding)} for name, finding in found]))
    else:
        for name, finding in found:
            click.echo(f"{name}: {finding}")
    if found:
        raise SystemExit(1)
