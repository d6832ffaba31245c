"""`skg term`: a teletype in the terminal."""

from __future__ import annotations

import contextlib
import sys
import threading
from pathlib import Path

import click

from skg.files import read_bytes


@click.command(name="term")
@click.argument("port")
@click.option(
    "--send",
    "file",
    metavar="FILE",
    type=click.Path(allow_dash=True),
    help="Type this file first, line by line; - for the standard input.",
)
@click.option("--run", is_flag=True, help="Type RUN after the file.")
@click.option("--record", metavar="FILE", type=click.Path(), help="Write what is punched to this file.")
@click.option("--punch-port", metavar="PORT", help="Where the punch is connected, if not to PORT itself.")
@click.option("--baud", default=9600, show_default=True, type=click.IntRange(50), help="Speed of both ports.")
@click.option(
    "--pace",
    type=click.Choice(("prompt", "none")),
    default="prompt",
    show_default=True,
    help="After each line that is sent wait for the prompt, or for nothing but XOFF.",
)
@click.option(
    "--delay", default=0.0, metavar="SECONDS", type=click.FloatRange(0), help="Also wait this long after each line."
)
@click.option(
    "--batch",
    is_flag=True,
    help="Leave when the file was sent and the tape's DD was punched, or when nothing has come for --quiet seconds.",
)
@click.option("--quiet", default=3.0, show_default=True, metavar="SECONDS",
              type=click.FloatRange(0, min_open=True), help="How long --batch waits for more.")  # fmt: skip
@click.option(
    "--patience",
    default=0.0,
    metavar="SECONDS",
    type=click.FloatRange(0),
    help="Give up a port that stays away this long. Default: never.",
)
def command(
    port: str,
    file: str | None,
    run: bool,
    record: str | None,
    punch_port: str | None,
    baud: int,
    pace: str,
    delay: float,
    batch: bool,
    quiet: float,
    patience: float,
) -> None:
    """Be the teletype of the board on PORT (a device, or any address that pyserial knows).

    Keys go to the board as they are typed; ctrl-] leaves. What it punches, between DC2 and DC4 or on a port
    of its own, goes to the file of --record. XOFF holds what is sent until XON. A port that goes away is
    opened again when it comes back. Without a terminal the standard input is typed instead, and the command
    leaves as with --batch.
    """
    from skg.machine.teletype import BrokenOff, Port, Teletype, converse, raw_keyboard, send

    data = read_bytes(file) if file else b""
    with contextlib.ExitStack() as stack:
        punched = stack.enter_context(Path(record).open("wb")) if record else None
        teletype = Teletype(punched, show_bars=sys.stderr.isatty())
        machine = Port(port, baud, teletype.say, teletype.splitter.may_send.set, patience)
        stack.callback(machine.close)
        readers = [(machine, False)]
        if punch_port:
            readers.append((Port(punch_port, baud, teletype.say, bool, patience), True))
            stack.callback(readers[1][0].close)
        for reader in readers:
            threading.Thread(target=teletype.listen, args=reader, daemon=True).start()
        teletype.keys = stack.enter_context(raw_keyboard())
        try:
            send(machine, teletype, data, pace, delay)
            if run:
                send(machine, teletype, b"RUN\n", "none", 0.0)
            if batch or not sys.stdin.isatty():
                if not batch and file != "-":
                    send(machine, teletype, read_bytes("-"), pace, delay)
                teletype.wait(lambda: teletype.ended, quiet)
                # Whatever stands on the paper after DD.
                teletype.wait(bool, 0.2)
            else:
                converse(machine, teletype)
        except BrokenOff:
            teletype.say("broken off")
            stack.close()
            raise SystemExit(1) from None
    if teletype.punched:
        where = f" to {record}" if record else ""
        click.echo(f"skg term: {teletype.punched} bytes punched{where}", err=True)
