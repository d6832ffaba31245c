"""`skg`: one command, its subcommands loaded only when called (matplotlib and ezdxf are slow to import)."""

from __future__ import annotations

import sys
from importlib import import_module

import click

from skg.errors import UserError

#: Subcommand -> "module:attribute" of its click command.
COMMANDS = {
    "check": "skg.check:command",
    "dxf": "skg.dxf:command",
    "from-dxf": "skg.from_dxf:command",
    "gcode": "skg.gcode:command",
    "plot": "skg.plot:command",
    "quality": "skg.quality:command",
    "ref": "skg.ref.command:command",
    "sim": "skg.sim:command",
    "term": "skg.term:command",
}


class LazyGroup(click.Group):
    """A click group that imports a subcommand's module when it is asked for."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Names of all subcommands, sorted."""
        return sorted(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The subcommand's click command, or None for an unknown name."""
        if cmd_name not in COMMANDS:
            return None
        module, attribute = COMMANDS[cmd_name].split(":")
        return getattr(import_module(module), attribute)


@click.command(cls=LazyGroup)
@click.version_option(package_name="skg")
def cli() -> None:
    """SKG host tools: reference interpreter, 3B simulator, plots, converters."""


def main() -> None:
    """Entry point: a `UserError` or an unreadable file becomes one line and exit code 2."""
    try:
        cli.main(standalone_mode=True)
    except UserError as error:
        print(f"skg: {error}", file=sys.stderr)
        sys.exit(2)
    except OSError as error:
        print(f"skg: {error.filename or 'file'}: {error.strerror}", file=sys.stderr)
        sys.exit(2)
