"""`skg ui`: the drawing on the screen, in a browser on this machine."""

from __future__ import annotations

import os
import sys
import time
import webbrowser
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from html import escape
from pathlib import Path
from tempfile import gettempdir, mkstemp
from threading import Event, Thread
from typing import TYPE_CHECKING, cast

import click

from skg.commands.options import kept_setups
from skg.errors import UserError, of_system
from skg.messages.finding import Finding
from skg.messages.render import text
from skg.terminal import tell

if TYPE_CHECKING:
    from io import BufferedReader

    from skg.ui.server import Server


@click.command(name="ui")
@click.argument("file", required=False, type=click.Path(path_type=Path))
@click.option(
    "--port",
    default=0,
    show_default=False,
    metavar="NUMBER",
    type=click.IntRange(0, 65535),
    help="Port of the page. Default: a free one.",
)
@click.option("--no-browser", is_flag=True, help="Print the page's address and open no browser.")
@click.option("--until-eof", is_flag=True, help="End when standard input does: for a program that starts this one.")
def command(file: Path | None, port: int, no_browser: bool, until_eof: bool) -> None:
    """Show a drawing in the browser, choose how its contours are cut, and cut it.

    FILE is a drawing (.dxf or .svg) or a job file (.job.toml); without one the page asks for it. Results are saved
    beside it. The page is served to this machine alone, and to those who have the address as it is printed. Ctrl-C ends
    it; it ends by itself when its page has been closed for ten minutes. Unsaved settings are then in a job
    file beside the drawing.
    """
    from skg.ui.server import Server
    from skg.ui.session import Session

    session = Session(kept_setups())
    try:
        # (a session that has begun has a process, which would end in a traceback where this one ends at once)
        try:
            server = Server(port, session)
        except OSError as error:
            raise UserError(Finding("port-failed", port=port, why=of_system(error))) from None
        with server, _way_to(server.url, server.is_seen, no_browser) as address:
            session.begin(file)
            click.echo(server.url)
            if not no_browser:
                # (a browser in this terminal keeps whoever calls it)
                Thread(target=webbrowser.open, args=(address,), daemon=True).start()
            if until_eof:
                Thread(target=_end_with_input, args=(server,), daemon=True).start()
            try:
                server.serve_forever()
            except KeyboardInterrupt:
                click.echo()
        if name := session.keep():
            tell(text(Finding("page-kept", file=name)))
    except KeyboardInterrupt:
        click.echo()
    finally:
        session.close()


def _end_with_input(server: Server) -> None:
    """End the server when nobody can write to standard input any more."""
    # (a buffer of the interpreter's own has read1)
    while sys.stdin is not None and cast("BufferedReader", sys.stdin.buffer).read1(1 << 12):
        pass
    server.end()


@contextmanager
def _way_to(url: str, is_seen: Event, no_browser: bool) -> Iterator[str]:
    """The address for the browser, which every user of this machine may read in its command line: that of a file, for
    this user's eyes alone, that leads to the page. The file is there until the page has been opened.

    Windows shows command lines to their users alone, and macOS gives an address to a browser that is on.
    """
    if no_browser or sys.platform == "win32" or (sys.platform == "darwin" and "BROWSER" not in os.environ):
        yield url
        return
    path = _private_file()
    place = escape(url)
    refresh = f'<meta http-equiv="refresh" content="0; url={place}">'
    path.write_text(f'<!doctype html><meta charset="utf-8">{refresh}<title>skg ui</title><a href="{place}">skg ui</a>')
    Thread(target=_remove_when, args=(is_seen, path), daemon=True).start()
    try:
        yield path.as_uri()
    finally:
        path.unlink(missing_ok=True)


def _private_file() -> Path:
    """An empty file that no other user can read; those of sessions that were killed are removed.

    It is in the home folder: Ubuntu's browsers, which are snaps, see no other of this user's files, and none hidden.
    """
    for folder in (Path.home(), Path(gettempdir())):
        with suppress(OSError):
            descriptor, name = mkstemp(prefix="skg-ui-", suffix=".html", dir=folder)
            os.close(descriptor)
            for left in folder.glob("skg-ui-????????.html"):
                if left.stat().st_mtime < time.time() - 600:
                    left.unlink()
            return Path(name)
    raise UserError(Finding("no-private-file"))


def _remove_when(is_seen: Event, path: Path) -> None:
    is_seen.wait()
    path.unlink(missing_ok=True)
