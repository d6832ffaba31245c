"""`skg`: one command, its subcommands loaded only when called (matplotlib and ezdxf are slow to import)."""

from __future__ import annotations

import codecs
import gc
import io
import os
import sys
from collections.abc import Sequence
from contextlib import suppress
from difflib import get_close_matches
from importlib import import_module
from typing import NoReturn, TextIO

from skg.interrupts import interrupts_end

with interrupts_end():
    import click

    from skg.commands.help import speak, translated, translations
    from skg.errors import UserError, of_system
    from skg.garbage import collect_rarely
    from skg.messages.finding import Finding, Phrase
    from skg.messages.render import Speech, data, language_of_system, line, speech
    from skg.terminal import tell

# numpy's linear algebra, which skg does without, would start a thread for each processor: a quarter of a short run.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

#: Subcommand -> what it does, as `skg --help` lists it. Its click command is `command` in the module of its name.
COMMANDS = {
    "cam": "Write the program that cuts a disc cam.",
    "check": "Check tapes for errors.",
    "cut": "Turn a drawing, DXF or SVG, into a checked tape.",
    "dxf": "Turn a tape or a program into a DXF drawing.",
    "gcode": "Turn a 3B tape into G-code, or back.",
    "gear": "Write the program that cuts an involute gear.",
    "plot": "Draw tapes and programs to scale: SVG, PNG or PDF.",
    "ref": "Run a program in 50-digit arithmetic: the exact tape.",
    "run": "Run a program on the board, by the ROM itself.",
    "sim": "Follow tapes step by step as a controller does.",
    "tape": "Write a 3B tape of any style in another one.",
    "tekhtran": "Write the program that cuts a part in TEKHTRAN.",
    "term": "Act as the teletype of a board on a serial port.",
    "ui": "Show a drawing in the browser, and cut it.",
    "xy": "Write the program that cuts a part in XY.",
}


class _Closed(io.TextIOBase):
    """A standard output that was closed before the program began: what is written there is not lost in silence."""

    def write(self, _text: str) -> NoReturn:
        raise UserError(Finding("stdout-closed"))

    @property
    def buffer(self) -> NoReturn:
        """The same for bytes."""
        raise UserError(Finding("stdout-closed"))


class LazyGroup(click.Group):
    """A click group that imports a subcommand's module when it is asked for."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Names of all subcommands, sorted."""
        return sorted(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The subcommand's click command, or None for an unknown name."""
        if cmd_name not in COMMANDS:
            return None
        return translated(import_module(f"skg.commands.{cmd_name.replace('-', '_')}").command, speech.language)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find a subcommand; for a mistyped one the message has the nearest."""
        if args and args[0] not in COMMANDS and not args[0].startswith("-"):
            near = get_close_matches(args[0], COMMANDS, 1, 0.5)
            why = Phrase("no-command-near", name=args[0], near=near[0]) if near else Phrase("no-command", name=args[0])
            ctx.fail(str(why))
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the subcommands without importing them."""
        words = translations(speech.language)
        with formatter.section(words.gettext("Commands")):
            formatter.write_dl([(name, words.gettext(summary)) for name, summary in COMMANDS.items()])

    def format_help(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the help in the language that is spoken."""
        click.Group.format_help(translated(self, speech.language), ctx, formatter)


def _print_version(ctx: click.Context, _option: click.Parameter, is_asked: bool) -> None:
    """The version, and the standard ROM's CRC-32: which ROM this is."""
    if not is_asked or ctx.resilient_parsing:
        return
    from importlib.metadata import version
    from zlib import crc32

    from skg.board.roms import rom_path

    rom = rom_path("standard")
    click.echo(f"skg {version('skg-nc')}, ROM {rom.name}, CRC-32 {crc32(rom.read_bytes()):08X}")
    ctx.exit()


def _speak(_ctx: click.Context | None, _option: click.Parameter | None, language: str | None) -> None:
    """Choose the language: as asked for, else the system's where the terminal has its characters."""
    speech.language = language or language_of_system()
    if not language and speech.language == "zh" and sys.stderr is not None:
        try:
            "中文".encode(sys.stderr.encoding or "utf-8")
        except UnicodeError:
            speech.language = "en"
    speak(speech.language)


# (a default of nothing says show_default=False)
@click.command(cls=LazyGroup, context_settings={"show_default": True})
@click.option("--lang", type=click.Choice(["en", "zh"]), expose_value=False, is_eager=True, callback=_speak,
              show_default=False, help="Language of messages. Default: as the system's ($LANG).")  # fmt: skip
@click.option("--version", is_flag=True, is_eager=True, expose_value=False, callback=_print_version,
              help="Print the version, and the ROM's CRC-32.")  # fmt: skip
def cli() -> None:
    """SKG host tools: the board and its ROM, reference interpreter, 3B simulator, plots, converters."""


def _spell(error: UnicodeError) -> tuple[str | bytes, int]:
    """Characters that an encoding has not: u for µ, a file name's own bytes, and else what tells them."""
    if isinstance(error, UnicodeEncodeError) and error.object[error.start] == "µ":
        return "u", error.start + 1
    try:
        return codecs.lookup_error("surrogateescape")(error)
    except UnicodeError:
        return codecs.backslashreplace_errors(error)


def _prepare(stream: TextIO | None) -> None:
    """Let a standard stream take every text, with the same line ends on every system."""
    if isinstance(stream, io.TextIOWrapper):
        stream.reconfigure(newline="\n", errors="skg-spell")


def main() -> None:
    """Entry point: wrong usage, a `UserError` or an unreadable file becomes one line and exit code 2.

    Who reads the output may stop reading (`| head -1`): exit code 1, and not a word.
    """
    if sys.stdout is None and sys.argv[1:2] not in (["term"], ["ui"]):
        # (a board can be typed at without its paper, and the page is in the browser: pythonw has no console)
        sys.stdout = _Closed()
    codecs.register_error("skg-spell", _spell)
    _prepare(sys.stdout)
    _prepare(sys.stderr)
    collect_rarely()
    # (for an error before --lang)
    _speak(None, None, None)
    try:
        try:
            # (click alone would take four lines for wrong usage)
            code = cli.main(standalone_mode=False)
        except SystemExit as end:
            code = end.code
        _flush()
    except click.UsageError as error:
        # (click's parser of options does not say of which command)
        command = next((word for word in sys.argv[1:] if word in COMMANDS), "")
        name = error.ctx.command_path if error.ctx else f"skg {command}".rstrip()
        _fail(Finding("wrong-usage", what=error.format_message().rstrip(".。"), command=name))
    except click.ClickException as error:
        _fail(Finding("plain", text=error.format_message()))
    except UserError as error:
        _fail(error.finding, error.audience)
    except (click.Abort, KeyboardInterrupt):
        sys.exit(130)
    except BrokenPipeError:
        _leave(1)
    except OSError as error:
        if error.filename == "":
            _fail(Finding("empty-file-name"))
        _fail(of_system(error).within(Phrase("stdout") if error.filename is None else error.filename))
    # (else the interpreter looks through all that is left, and through all modules, once more before it ends)
    gc.freeze()
    sys.exit(code)


def _flush() -> None:
    for stream in (sys.stdout, sys.stderr):
        if stream:
            stream.flush()


def refusal(finding: Finding, audience: Speech | None, words: Sequence[str]) -> str:
    """An error as a line, or as JSON where the words of the command line ask for it, though click refuse them."""
    if "--json" not in words:
        return f"skg: {line(finding, audience)}"
    import json

    return json.dumps({"error": data(finding, audience) | {"severity": "error"}})


def _fail(finding: Finding, audience: Speech | None = None) -> NoReturn:
    with suppress(OSError):
        tell(refusal(finding, audience, sys.argv[1:]))
    _leave(2)


def _leave(code: int) -> NoReturn:
    """Exit without writing what is left in the buffers: nobody takes it."""
    os._exit(code)
