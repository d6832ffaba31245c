"""`skg cam`: the program that cuts a disc cam."""

from __future__ import annotations

import click

from skg.commands.options import FiniteRange
from skg.commands.shape import shape_options, write_shape

_LAWS = ("harmonic", "cycloidal", "polynomial")

#: No tape has room for a larger cam, mm.
MOST = 50_000.0


@click.command(name="cam")
@click.option("--base", required=True, metavar="MM", type=FiniteRange(0, MOST, min_open=True), help="Smallest radius.")
@click.option(
    "--lift",
    required=True,
    metavar="MM",
    type=FiniteRange(0, MOST, min_open=True),
    help="Lift of the follower.",
)
@click.option(
    "--rise", default=120.0, show_default=True, metavar="DEGREES", type=FiniteRange(1, 359), help="Angle of the rise."
)
@click.option(
    "--dwell",
    default=30.0,
    show_default=True,
    metavar="DEGREES",
    type=FiniteRange(0, 358),
    help="Angle of the dwell at the top.",
)
@click.option(
    "--fall", default=120.0, show_default=True, metavar="DEGREES", type=FiniteRange(1, 359), help="Angle of the return."
)
@click.option(
    "--law",
    default="cycloidal",
    show_default=True,
    type=click.Choice(_LAWS),
    help="Motion of rise and return; polynomial: 3-4-5.",
)
@click.option(
    "--roller", default=0.0, metavar="MM", type=FiniteRange(0, MOST), help="Diameter of the follower's roller."
)
@shape_options
def command(
    base: float,
    lift: float,
    rise: float,
    dwell: float,
    fall: float,
    law: str,
    roller: float,
    output: str,
    offset: float | None,
    tab: float,
    tape: str | None,
) -> None:
    """Write the SKG program that cuts a disc cam about the origin.

    Rise and return are nodes for FIT with their tangents. The program is run, and its tape compared with the exact
    curve, before it is written; how far it is off goes to standard error.
    """
    from skg.cutting.cam import Cam

    cam = Cam(base, lift, rise, dwell, fall, law, roller)
    write_shape(f"cam, {law}, lift {lift:g}", cam, output, offset, tab, tape)
