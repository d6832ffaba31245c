"""`skg gear`: the program that cuts an involute gear."""

from __future__ import annotations

from typing import Any

import click

from skg.commands.options import Degrees, FiniteRange, Millimetres
from skg.commands.shape import shape_options, write_shape
from skg.errors import UserError
from skg.messages.finding import Finding, Phrase


@click.command(name="gear")
@click.option("--module", required=True, type=Millimetres(0, 1000, min_open=True), help="Module.")
@click.option("--teeth", required=True, metavar="N", type=click.IntRange(4, 1000), help="Number of teeth.")
@click.option("--pressure-angle", default=20.0, type=Degrees(5, 40), help="Pressure angle.")
@click.option("--shift", default=0.0, metavar="X", type=FiniteRange(-1, 1), help="Profile shift, in modules.")
@click.option(
    "--clearance",
    default=0.25,
    metavar="C",
    type=FiniteRange(0, 1),
    help="Between the root and the mate's tips, in modules.",
)
@click.option(
    "--fillet",
    default=0.2,
    metavar="F",
    type=FiniteRange(0, 1),
    help="Radius of the fillet at the root, in modules; 0: none.",
)
@click.option(
    "--bore", default=0.0, show_default=False, type=Millimetres(0), help="Diameter of the bore. Default: none."
)
@click.option(
    "--keyway",
    nargs=2,
    default=(0.0, 0.0),
    show_default=False,
    metavar="WIDTH DEPTH",
    type=Millimetres(0),
    help="Keyway in the bore: its width, and its bottom from the bore's far side, mm.",
)
@shape_options
def command(
    output: str,
    offset: float | None,
    tab: float,
    tape: str | None,
    keyway: tuple[float, float],
    **dimensions: Any,  # noqa: ANN401 (teeth are whole)
) -> None:
    """Write the SKG program that cuts an involute spur gear.

    The flanks are nodes for FIT with their tangents. The program is run, and its tape compared with the exact involute,
    before it is written; how far it is off goes to standard error.
    """
    from skg.cutting.gear import Gear

    gear = Gear(**dimensions, key_width=keyway[0], key_depth=keyway[1])
    if any(keyway) and not gear.bore:
        raise UserError(Finding("keyway-without-bore"))
    name = Phrase("gear", module=gear.module, teeth=gear.teeth, angle=gear.pressure_angle)
    write_shape(name, gear, output, offset, tab, tape)
