"""`skg cam`: the program that cuts a disc cam."""

from __future__ import annotations

from typing import Any

import click

from skg.commands.options import Degrees, Millimetres
from skg.commands.shape import shape_options, write_shape
from skg.messages.finding import Phrase

_LAWS = ("harmonic", "cycloidal", "polynomial")

#: No tape has room for a larger cam, mm.
MOST = 50_000.0


@click.command(name="cam")
@click.option("--base", required=True, type=Millimetres(0, MOST, min_open=True), help="Smallest radius.")
@click.option("--lift", required=True, type=Millimetres(0, MOST, min_open=True), help="Lift of the follower.")
@click.option("--rise", default=120.0, type=Degrees(1, 359), help="Angle of the rise.")
@click.option("--dwell", default=30.0, type=Degrees(0, 358), help="Angle of the dwell at the top.")
@click.option("--fall", default=120.0, type=Degrees(1, 359), help="Angle of the return.")
@click.option(
    "--law", default="cycloidal", type=click.Choice(_LAWS), help="Motion of rise and return; polynomial: 3-4-5."
)
@click.option(
    "--roller", default=0.0, show_default=False, type=Millimetres(0, MOST), help="Diameter of the follower's roller."
)
@shape_options
def command(output: str, offset: float | None, tab: float, tape: str | None, **dimensions: Any) -> None:  # noqa: ANN401 (numbers and the law)
    """Write the SKG program that cuts a disc cam about the origin.

    Rise and return are nodes for FIT with their tangents. The program is run, and its tape compared with the exact
    curve, before it is written; how far it is off goes to standard error.
    """
    from skg.cutting.cam import Cam

    cam = Cam(**dimensions)
    write_shape(Phrase("cam", law=cam.law, lift=cam.lift), cam, output, offset, tab, tape)
