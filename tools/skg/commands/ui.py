"""`skg ui`: the drawing on the screen, in a browser on this machine."""

from __future__ import annotations

import webbrowser
from pathlib import Path
from threading import Thread

import click

from skg.errors import UserError
from skg.messages.finding import Finding


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
def command(file: Path | None, port: int, no_browser: bool) -> None:
    """Show a drawing in the browser, choose how its contours are cut, and cut it.

    FILE is a drawing (.dxf or .svg) or a job file (.job.toml); without one the page asks for it. What is cut is saved
    beside it. The page is served to this machine alone, and to those who have the address as it is printed. Ctrl-C ends
    it.
    """
    from skg.ui.server import Server
    from skg.ui.session import Session

    session = Session()
    try:
        # (a session that has begun has a process, which would end in a traceback where this one ends at once)
        try:
            server = Server(port, session)
        except OSError as error:
            raise UserError(Finding("port-failed", port=port, detail=error.strerror)) from None
        with server:
            session.begin(file)
            click.echo(server.url)
            if not no_browser:
                # (a browser in this terminal keeps whoever calls it)
                Thread(target=webbrowser.open, args=(server.url,), daemon=True).start()
            server.serve_forever()
    except KeyboardInterrupt:
        click.echo()
    finally:
        session.close()
