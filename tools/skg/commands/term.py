"""`skg term`: a teletype in the terminal."""

from __future__ import annotations

import contextlib
import os
import sys
import threading
from typing import TYPE_CHECKING

import click

from skg.commands.options import Seconds, refuse_onto, spares_what_it_reads
from skg.errors import UserError
from skg.files import part_of, read_bytes
from skg.messages.finding import Finding, Phrase
from skg.terminal import remark

if TYPE_CHECKING:
    from skg.board.teletype import Port, Teletype

#: Seconds that a port may stay away when nobody is at the keyboard.
UNATTENDED_PATIENCE = 60.0
#: Speed of a port, baud: an Altair's highest; that of boards whose clock sets one.
DEFAULT_BAUD = 9600
BOARD_BAUD = {"rc2014": 115200, "rc2014-sio": 115200, "minimax8085": 19200, "rcbus8085": 115200}


@click.command(name="term")
@click.argument("port")
@click.option(
    "--send",
    "file",
    metavar="FILE",
    type=click.Path(allow_dash=True),
    help="Type this file first, line by line; - for the standard input.",
)
@click.option(
    "--run",
    is_flag=True,
    help="Make the tape of the file: NEW, its lines, RUN. One that does not fit in the board's memory is sent again "
    "without its line numbers, if possible, and reported. Without a file: RUN.",
)
@click.option(
    "--unnumbered",
    is_flag=True,
    help="With --run: send a program without its line numbers at once, so that each line is carried out as it comes.",
)
@click.option("--record", metavar="FILE", type=click.Path(), help="Write the punched tape to this file.")
@click.option("--punch-port", metavar="PORT", help="Port of the punch, if not PORT itself.")
@click.option("--board", type=click.Choice(list(BOARD_BAUD)), help="Kind of board: sets its speed.")
@click.option("--baud", metavar="N", type=click.IntRange(50), help=f"Speed of both ports. Default: {DEFAULT_BAUD}.")
@click.option(
    "--pace",
    type=click.Choice(("prompt", "none")),
    default="prompt",
    help="prompt: look at the echo of each line and wait for the prompt behind it; none: wait for nothing but XOFF.",
)
@click.option("--delay", default=0.0, show_default=False, type=Seconds(0), help="Also wait this long after each line.")
@click.option(
    "--batch",
    is_flag=True,
    help="Leave when the board has answered the last line and the tape's DD was punched; nobody is at the keyboard.",
)
@click.option(
    "--quiet", default=3.0, type=Seconds(0, min_open=True), help="Seconds without a prompt after which --batch leaves."
)
@click.option(
    "--silence",
    default=120.0,
    type=Seconds(0, min_open=True),
    help="Give up a board that is silent this long and not back at its prompt.",
)
@click.option(
    "--patience",
    type=Seconds(0),
    help="Give up a port that stays away this long, 0: never. Default: 60 with --batch or without a terminal, else 0.",
)
@spares_what_it_reads
def command(
    port: str,
    file: str | None,
    run: bool,
    unnumbered: bool,
    record: str | None,
    punch_port: str | None,
    board: str | None,
    baud: int | None,
    pace: str,
    delay: float,
    batch: bool,
    quiet: float,
    silence: float,
    patience: float | None,
) -> None:
    """Be the teletype of the board on PORT (a device, or any address that pyserial knows).

    Keys go to the board as they are typed; ctrl-] leaves. The tape, between DC2 and DC4 or on a port
    of its own, goes to the file of --record: FILE.part, until it is whole. XOFF holds sending
    until XON. A port that goes away is opened again when it comes back. Without a terminal the standard input is
    typed instead, and the command leaves as with --batch.

    The first ERR ends sending: then the keyboard is yours, or the exit code is 1.
    """
    from skg.board.keyboard import raw_keyboard
    from skg.board.recorder import Recorder
    from skg.board.sending import Stopped, TypedLine, Typist, finish, lines_to_type, make_tape, send
    from skg.board.signals import closing_on_signals
    from skg.board.teletype import BrokenOff, Port, Teletype, converse

    if unnumbered and not (file and run):
        raise UserError(Finding("unnumbered-alone"))
    baud = baud or BOARD_BAUD.get(board or "", DEFAULT_BAUD)
    if punch_port and os.path.realpath(punch_port) == os.path.realpath(port):
        raise UserError(Finding("punch-on-port").within(punch_port))
    is_attended = sys.stdin is not None and sys.stdin.isatty() and not batch
    if patience is None:
        patience = 0.0 if is_attended else UNATTENDED_PATIENCE
    if file and record:
        refuse_onto([part_of(record)], [file])
    lines = lines_to_type(read_bytes(file), file) if file else []
    keyboard = str(Phrase("stdin"))
    keyed = [] if is_attended or batch or file == "-" or not sys.stdin else lines_to_type(read_bytes("-"), keyboard)
    with closing_on_signals(), Recorder(record) if record else contextlib.nullcontext() as recorder:
        with contextlib.ExitStack() as stack:
            teletype = Teletype(recorder, show_bars=sys.stderr.isatty())
            machine = Port(port, baud, teletype.say, teletype.is_back, patience)
            readers = [(machine, False)]
            if punch_port:
                readers.append((Port(punch_port, baud, teletype.say, teletype.punch_is_back, patience), True))
            for reader in readers:
                _listen(teletype, *reader, stack)
            teletype.keys = stack.enter_context(raw_keyboard())
            typist = Typist(machine, teletype, silence, pace == "prompt", delay)
            stopped = False
            try:
                try:
                    if run and file:
                        make_tape(typist, lines, file, unnumbered, is_attended)
                    elif run:
                        lines = [TypedLine(0, "RUN")]
                    if lines and not (run and file):
                        send(typist, lines, file or port)
                    if keyed:
                        send(typist, keyed, keyboard)
                    if not is_attended:
                        is_followed = typist.paced and bool(lines or keyed)
                        is_known = is_followed and not (record and (run or punch_port))
                        ports = [port for port, _ in readers]
                        finish(typist, ports, 0.0 if is_known else quiet, bool(record and run), is_followed)
                except Stopped as reason:
                    stopped = not is_attended
                    why = reason.why
                    if lines or keyed:
                        why = Finding("stopped-sending", why=why).within(*why.source)
                    teletype.say(why)
                if is_attended:
                    converse(machine, teletype)
            except BrokenOff:
                teletype.say(Finding("broken-off"))
                raise SystemExit(1) from None
        is_whole = teletype.ended or not run
        if recorder:
            is_whole = recorder.finish(teletype.listing, stopped or teletype.torn)
        _tell_punched(teletype, record if is_whole else None, run)
    if stopped or teletype.punched and not is_whole:
        raise SystemExit(1)


def _listen(teletype: Teletype, port: Port, is_punch: bool, stack: contextlib.ExitStack) -> None:
    """Take what comes at a port, until `stack` is left."""
    thread = threading.Thread(target=teletype.listen, args=(port, is_punch), daemon=True)
    stack.callback(thread.join, 2)
    stack.callback(port.close)
    thread.start()


def _tell_punched(teletype: Teletype, record: str | None, run: bool) -> None:
    """Say how many bytes were punched, if any were."""
    if teletype.punched:
        where = Phrase("to-file", file=record) if record else None
        cut_off = None if teletype.ended or not run else Phrase("tape-incomplete")
        remark(Finding("bytes-punched", number=teletype.punched, where=where, more=cut_off), "skg term")
