"""`skg sim`: follow a tape as the 3B controller does."""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from itertools import chain

import click

from skg.commands.options import (
    decided,
    feed_option,
    positions_option,
    read_machine_option,
    spares_what_it_reads,
)
from skg.errors import UserError
from skg.files import write_bytes
from skg.geometry.plane import XY
from skg.messages.finding import Finding, Phrase
from skg.messages.render import text
from skg.sources.load import is_iso, load
from skg.tape.block import Tape
from skg.tape.controller import drive_steps
from skg.tape.dialect import GcodeDialect
from skg.tape.simulation import Report, RouteReport, closing, duration, simulate
from skg.tape.text import odd_stops
from skg.terminal import remark, show


def _lines(report: Report, blocks: bool) -> list[str]:
    """The report on a tape, line by line."""
    lines = []
    if blocks:
        lines.append(text(Phrase("sim-head")))
        for row in report.each:
            miss = row.really[0] - row.should[0], row.really[1] - row.should[1]
            lines.append(
                f"{row.number:>5}  {row.block:<40} {_xy(row.should):>20} {_xy(row.really):>20} "
                f"{_xy(miss) if miss != (0, 0) else '-':>8} {row.off_curve:>6.3f}"
            )
    stops = Phrase("and-stops", count=report.stops) if report.stops else None
    as_programmed = Phrase("as-programmed", closing=closing(report.programmed_gap))
    phrases = [
        Finding("sim-blocks", count=report.blocks, stops=stops).within(report.name),
        Phrase(
            "sim-travel",
            travel=report.travel / 1000,
            steps=report.steps,
            time=duration(report.time),
            feed=report.feed,
        ),
        Phrase(
            "sim-path",
            closing=closing(report.gap),
            more=as_programmed if report.gap != report.programmed_gap else None,
        ),
        Phrase("sim-ends", misses=report.misses, largest=report.largest_miss, drift=report.largest_drift),
        Phrase("sim-distance", curve=report.off_curve, path=report.off_path),
    ]
    if len(report.routes) > 1:
        phrases += [
            Phrase("sim-route", first=route.first, last=route.last, what=_what(route)) for route in report.routes
        ]
    return [*lines, *map(str, phrases)]


def _what(route: RouteReport) -> Phrase:
    """A route, in the report: a move, or whether it closes."""
    return Phrase("sim-move", by=_xy(route.gap)) if route.is_move else closing(route.gap)


def _write_steps(path: str, tapes: list[Tape]) -> None:
    """The steps of all tapes, one after the other."""
    write_bytes(path, b"".join(chain.from_iterable(map(drive_steps, tapes))))
    for tape in tapes:
        # (the pauses of G-code)
        if why := odd_stops(tape):
            remark(why.within(tape.name))


def _rounded(value: object) -> object:
    """The figures with three decimals: nm and ms."""
    if isinstance(value, float):
        return round(value, 3)
    if isinstance(value, dict):
        return {key: _rounded(inner) for key, inner in value.items()}
    return [_rounded(inner) for inner in value] if isinstance(value, list | tuple) else value


def _xy(point: XY) -> str:
    return f"{point[0]}, {point[1]}"


@click.command(name="sim")
@click.argument("tapes_", metavar="TAPE...", nargs=-1, required=True, type=click.Path(allow_dash=True))
@feed_option
@positions_option
@read_machine_option
@click.option("--blocks", is_flag=True, help="Also list every block: where it should end, where it ended.")
@click.option(
    "--json", "as_json", is_flag=True, help="Write the figures as JSON (µm, seconds), one list for all tapes."
)
@click.option(
    "--steps",
    "steps_file",
    type=click.Path(allow_dash=True),
    metavar="FILE",
    help="Write each step, one byte: the value of a drive's port (docs/spec/drive.md). "
    "-: the standard output, without the report.",
)
@click.option("--strict-close", is_flag=True, help="Exit with 1 when a path does not close to 0 µm.")
@spares_what_it_reads
def command(
    tapes_: tuple[str, ...],
    feed: float,
    positions: str,
    dialect: GcodeDialect | None,
    blocks: bool,
    as_json: bool,
    steps_file: str | None,
    strict_close: bool,
) -> None:
    """Follow TAPE step by step as a 3B controller does.

    Reports blocks, travel, where the blocks ended, the largest distance from the programmed path, the time,
    and whether the path closes. A program (.skg, .xy, .tkh) is run first. TAPE - is the standard input. Exit code 1
    where an odd number of stops stands before a cut: a drive's wire would be off there.
    """
    tapes = [load(name, dialect=dialect) for name in tapes_]
    odd = {
        tape.name: why
        for name, tape in zip(tapes_, tapes, strict=True)
        if (why := odd_stops(tape)) and not is_iso(name, dialect)
    }
    if steps_file and odd:
        name, why = next(iter(odd.items()))
        raise UserError(why.within(name))
    reports = [simulate(tape, feed, decided(tape, positions)) for tape in tapes]
    if steps_file:
        _write_steps(steps_file, tapes)
    if steps_file == "-":
        pass
    elif as_json:
        kept = [replace(report, each=tuple(report.each) if blocks else ()) for report in reports]
        click.echo(json.dumps([_rounded({**asdict(report), "closed": report.closed}) for report in kept]))
    else:
        for report in reports:
            for each in _lines(report, blocks):
                show(each)
    for name, why in odd.items():
        remark(why.within(name))
    if odd or strict_close and not all(report.closed for report in reports):
        raise SystemExit(1)
