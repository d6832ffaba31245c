"""Options that several commands have."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import wraps
from importlib.util import find_spec
from pathlib import Path

import click

from skg.errors import UserError
from skg.files import is_same_file, part_of, write_bytes
from skg.job.setups import Setups
from skg.job.values import LEAST_FEED, MOST_OFFSET
from skg.messages.finding import Finding, Phrase
from skg.tape.block import MAX_DIGITS, Tape
from skg.tape.dialect import GcodeDialect
from skg.tape.positions import POSITIONS, WITHOUT_DRIFT, decide, depends
from skg.terminal import remark

#: The key of a command's context under which are the files that it reads beside its arguments.
_READ = "skg.read"
#: Formats of pictures, by the ending of a file's name.
FORMATS = ("svg", "png", "pdf")

positions_option = click.option(
    "--positions",
    type=click.Choice(POSITIONS),
    default="auto",
    help="Start each block where the block before should have ended (programmed), or where the controller "
    "really stands then (machine: tapes without drift); auto: as a program or the tape's name says, else programmed.",
)


def picture_format(output: str, form: str | None, also: Phrase | None = None) -> str:
    """The format of a picture: as said, else by the file's name; the standard output is SVG.

    `also`: what else may tell it.
    """
    result = form or ("svg" if output == "-" else Path(output).suffix.lstrip(".").lower())
    if result not in FORMATS:
        raise UserError(Finding("picture-name", also=also).within(output))
    if find_spec("matplotlib") is None:
        raise UserError(Finding("needs-matplotlib").within(output))
    return result


def decided(tape: Tape, positions: str) -> str:
    """Decide where a tape's blocks start, "programmed" or "machine"; `positions` is what --positions says.

    What it was taken for, where nothing said it, goes to standard error in one line, and so does what was noted when it
    was read.
    """
    decision = decide(tape, positions)
    say(tape, decision.why)
    return decision.positions


def say(tape: Tape, more: Finding | None = None) -> None:
    """Write to standard error what was noted when a tape was read, and what else there is to say."""
    nothing = None if tape.blocks else Finding("no-blocks")
    for note in (*tape.notes, *filter(None, [more, nothing])):
        remark(note.within(tape.name))


def unmarked(output: str, tape: Tape, rom: str) -> list[Finding]:
    """Report a tape's name that does not tell the other commands that it is without drift, or wrongly does."""
    named = output.lower().endswith(WITHOUT_DRIFT)
    if rom != "no-drift":
        return [Finding("named-without-drift")] if named else []
    if named or not depends(tape):
        return []
    return [Finding("name-it-without-drift", ending=WITHOUT_DRIFT)]


def output_option(text: str, required: bool = False, in_place: bool = False) -> Callable[[Callable], Callable]:
    """The option -o, FILE or - for the standard output; `text` is its help.

    A command that has it writes onto none of the files that it reads, unless `in_place`.
    """
    default = {"required": True} if required else {"default": "-", "show_default": True}
    option = click.option("-o", "--output", metavar="FILE", type=click.Path(allow_dash=True), help=text, **default)

    return lambda function: option(function if in_place else spares_what_it_reads(function))


def spares_what_it_reads(function: Callable) -> Callable:
    """Make a command refuse to write onto the files that it reads."""

    @wraps(function)
    def careful(*arguments: object, **named: object) -> object:
        _refuse_onto(click.get_current_context())
        return function(*arguments, **named)

    return careful


def _name(parameter: click.Parameter) -> str:
    """A parameter as the user writes it."""
    return parameter.opts[-1] if isinstance(parameter, click.Option) else parameter.human_readable_name


def _refuse_onto(context: click.Context) -> None:
    """Raise a `UserError` when a command would write a file that it reads, or one file twice, or one without a name."""
    read: list[str] = []
    written: list[str] = []
    for parameter in context.command.params:
        if isinstance(parameter.type, click.Path) and (value := context.params[parameter.name or ""]) is not None:
            if value == "":
                raise UserError(Finding("empty-file-name").within(_name(parameter)))
            is_read = isinstance(parameter, click.Argument) or parameter.name in ("answers", "file")
            (read if is_read else written).extend(map(str, value if isinstance(value, tuple) else [value]))
    read.extend(context.meta.get(_READ, []))
    if written.count("-") > 1:
        raise UserError(Finding("two-on-stdout").within("-"))
    refuse_onto(written, read)


def refuse_onto(written: Sequence[str], read: Sequence[str]) -> None:
    """Raise a `UserError` when one of the files to be written is also read, or written twice."""
    real = [name for name in written if not Path(name).exists() or Path(name).is_file()]
    for index, name in enumerate(real):
        if any(is_same_file(name, other) for other in [*read, *real[:index]]):
            raise UserError(Finding("written-twice").within(name))


def write_tape(output: str, data: bytes, is_whole: bool) -> None:
    """Write what a run has punched. One that ended early leaves the tape before as it is, and its own as a part."""
    target = Path(output)
    if is_whole or output == "-" or target.exists() and not target.is_file():
        write_bytes(output, data)
    elif data:
        part = part_of(output)
        write_bytes(part, data)
        remark(Finding("tape-broken-off").within(part))


class MachineName(click.ParamType):
    """The name of a machine that reads G-code, or of a file that describes one."""

    name = "NAME|FILE"

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> object:
        """Return its dialect."""
        from skg.dialects.file import dialect_of

        if ctx and Path(str(value)).is_file():
            ctx.meta.setdefault(_READ, []).append(str(value))
        return value if isinstance(value, GcodeDialect) else dialect_of(str(value))


def machine_option(text: str) -> Callable[[Callable], Callable]:
    """The option --machine, a `GcodeDialect`; `text` is its help."""
    return click.option("--machine", "dialect", type=MachineName(), help=text)


#: The option of commands that read G-code.
read_machine_option = machine_option(
    "Read the file as G-code of this machine: one that comes with skg (docs/machines.md), or a file .toml."
)


def answers_option(function: Callable) -> Callable:
    """The option --input, as `answers`; None when it is not given."""
    return click.option(
        "--input", "answers", metavar="FILE", type=click.Path(allow_dash=True), help="Answers to INPUT, one line each."
    )(function)


def offset_option(text: str) -> Callable[[Callable], Callable]:
    """The option --offset, None when it is not given; `text` is its help."""
    return click.option("--offset", type=Millimetres(0, MOST_OFFSET), help=text)


def feed_option(function: Callable) -> Callable:
    """Give a command the option --feed, of a wire."""
    return click.option(
        "--feed", default=5.0, metavar="MM/MIN", type=FiniteRange(LEAST_FEED), help="Feed, to compute the time."
    )(function)


def skg80_option(function: Callable) -> Callable:
    """Give a command the option --skg80."""
    return click.option(
        "--skg80",
        metavar="FILE",
        help="Emulator that runs programs, such as build/skg80, or `reference` for the reference "
        "interpreter. Default: the board with the standard ROM, as in `skg run`.",
    )(function)


def kept_setups() -> Setups:
    """The setups in the folder where this system keeps a user's configuration."""
    return Setups(Path(click.get_app_dir("skg")) / "setups")


class RomName(click.Choice):
    """The name of a ROM, however it is spelt."""

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the name as `ROMS` has it."""
        from skg.board.roms import known_rom

        return super().convert(known_rom(str(value)) or value, param, ctx)


class FiniteRange(click.FloatRange):
    """A number in a range: neither infinite nor NaN, which is in every range, and of no more digits than a tape has."""

    name = "number"
    #: The number in the help of an option, where that does not say another.
    unit: str | None = None

    def get_metavar(self, *_param: object) -> str | None:
        """Return the unit, as the help has it."""
        return self.unit

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Return the number."""
        number = super().convert(value, param, ctx)
        if not abs(number) < 10**MAX_DIGITS:
            self.fail(str(Phrase("not-number", value=repr(value), most=MAX_DIGITS)), param, ctx)
        return number


class Millimetres(FiniteRange):
    """A length."""

    unit = "MM"


class Degrees(FiniteRange):
    """An angle."""

    unit = "DEGREES"


class Seconds(FiniteRange):
    """A time."""

    unit = "SECONDS"


def numbers_in(value: object) -> tuple[float, ...]:
    """The numbers of a text with commas between them; none where something else stands there."""
    try:
        return tuple(float(part) for part in str(value).split(","))
    except ValueError:
        return ()


class Numbers(click.ParamType):
    """Numbers with commas between them, as many as one of `counts`, such as 115,-10."""

    def __init__(self, name: str, expected: str, *counts: int) -> None:
        self.name, self.expected, self.counts = name, expected, counts

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> tuple[float, ...]:
        """Return the numbers."""
        if isinstance(value, tuple):
            return value
        result = numbers_in(value)
        if len(result) not in self.counts:
            self.fail(str(Phrase("not-numbers", value=repr(value), expected=Phrase(self.expected))), param, ctx)
        if not all(abs(number) < 10**MAX_DIGITS for number in result):
            self.fail(str(Phrase("long-numbers", value=repr(value), most=MAX_DIGITS)), param, ctx)
        return result


#: A place.
COORDINATES = Numbers("X,Y", "two-numbers", 2)
start_option = click.option(
    "--start", type=COORDINATES, help="Place of the start hole, mm. Default: FROM of a program, else 0,0."
)
