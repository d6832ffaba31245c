"""`skg gcode`: 3B tapes to ISO G-code and back."""

from __future__ import annotations

import click

from skg.commands.options import Numbers, decided, machine_option, output_option, positions_option, start_option
from skg.errors import UserError
from skg.files import write_bytes
from skg.geometry.plane import XY
from skg.messages.finding import Finding
from skg.sources.load import gcode_text, iso_of, iso_text, load
from skg.tape import gcode
from skg.tape.block import micrometres
from skg.tape.dialect import MILL, GcodeDialect
from skg.tape.text import to_bytes
from skg.terminal import remark

#: mm/min, where nothing else is said.
FEED = 100.0
_ONE_OR_TWO = Numbers("D[,D1]", "one-or-two-numbers", 1, 2)


def _feeds(feed: tuple[float, ...] | None) -> tuple[float, float]:
    if feed is None:
        remark(Finding("no-feed-given", feed=FEED))
        return FEED, FEED
    if min(feed) < 0.001:
        raise UserError(Finding("feed-too-small", feed=min(feed)))
    return feed[0], feed[-1]


def _heights(heights: tuple[float, ...] | None) -> tuple[int, int] | None:
    if heights is None:
        return None
    low, high = micrometres(heights[0]), micrometres(heights[1] if len(heights) == 2 else 5.0)
    if high < low:
        raise UserError(Finding("z-too-low", high=high / 1000, low=low / 1000))
    return low, high


@click.command(name="gcode")
@click.argument("source", metavar="[FILE]", default="-", type=click.Path(allow_dash=True))
@output_option("File to write, - for the standard output.")
@click.option("--back", is_flag=True, help="FILE is G-code, whatever its name: write a 3B tape.")
@start_option
@click.option(
    "--feed", type=_ONE_OR_TWO, help="Feed in mm/min, and downwards if that is another one.  [default: 100, reported]"
)
@click.option(
    "--z",
    "heights",
    type=_ONE_OR_TWO,
    help="Cutting height, and travel height (default: 5), mm: between contours the tool lifts instead of stopping.",
)
@positions_option
@machine_option(
    "Write for this machine, or with --back read its G-code: one that comes with skg (docs/machines.md), or a file "
    ".toml. Default: LinuxCNC and GRBL, for a mill."
)
def command(
    source: str,
    output: str,
    back: bool,
    start: XY | None,
    feed: tuple[float, ...] | None,
    heights: tuple[float, ...] | None,
    positions: str,
    dialect: GcodeDialect | None,
) -> None:
    """Turn a 3B tape into G-code that LinuxCNC and GRBL take as it is, or with --back G-code into a 3B tape.

    It writes the dialect of the milling ROM, which `skg plot` and `skg check` read: G17 G21 G90 G94, G0 to G3 with I
    and J, M0 for a stop, M30. It also reads G20, G91, G92 and more, comments, and words of other controls that do not
    move; without G20 and G21 a number with a decimal point is millimetres, one without micrometres.
    A program (.skg, .xy, .tkh) is run first; a milling program's tape is written as it is. FILE - (or none) is the
    standard input.
    """
    if back:
        write_bytes(output, to_bytes(iso_of(gcode_text(source), source, dialect).tape().items))
        return
    if not gcode.is_gcode(source) and (iso := iso_text(source)) is not None:
        if start or feed or heights or dialect:
            raise UserError(Finding("mill-has-all").within(source))
        write_bytes(output, iso.encode())
        return
    tape = load(source)
    x, y = start or tape.start
    home = micrometres(x), micrometres(y)
    if heights and dialect:
        raise UserError(Finding("z-with-machine"))
    dialect = dialect or MILL
    feeds = _feeds(feed) if dialect.feed else (FEED, FEED)
    write_bytes(output, gcode.write(tape, home, feeds, _heights(heights), decided(tape, positions), dialect).encode())
