"""`skg gear`: the program that cuts an involute gear."""

from __future__ import annotations

import click

from skg.commands.options import FiniteRange
from skg.commands.shape import shape_options, write_shape
from skg.errors import UserError

_MM = FiniteRange(0)


@click.command(name="gear")
@click.option("--module", required=True, metavar="MM", type=FiniteRange(0, 1000, min_open=True), help="Module.")
@click.option("--teeth", required=True, metavar="N", type=click.IntRange(4, 1000), help="Number of teeth.")
@click.option(
    "--pressure-angle",
    default=20.0,
    show_default=True,
    metavar="DEGREES",
    type=FiniteRange(5, 40),
    help="Pressure angle.",
)
@click.option(
    "--shift", default=0.0, show_default=True, metavar="X", type=FiniteRange(-1, 1), help="Profile shift, in modules."
)
@click.option(
    "--clearance",
    default=0.25,
    show_default=True,
    metavar="C",
    type=FiniteRange(0, 1),
    help="Between the root and the mate's tips, in modules.",
)
@click.option(
    "--fillet",
    default=0.2,
    show_default=True,
    metavar="F",
    type=FiniteRange(0, 1),
    help="Radius of the fillet at the root, in modules; 0: none.",
)
@click.option("--bore", default=0.0, metavar="MM", type=_MM, help="Diameter of the bore. Default: none.")
@click.option(
    "--keyway",
    nargs=2,
    default=(0.0, 0.0),
    metavar="WIDTH DEPTH",
    type=_MM,
    help="Keyway in the bore: its width, and its bottom from the bore's far side, mm.",
)
@shape_options
def command(
    module: float,
    teeth: int,
    pressure_angle: float,
    shift: float,
    clearance: float,
    fillet: float,
    bore: float,
    keyway: tuple[float, float],
    output: str,
    offset: float | None,
    tab: float,
    tape: str | None,
) -> None:
    """Write the SKG program that cuts an involute spur gear.

    The flanks are nodes for FIT with their tangents. The program is run, and its tape compared with the exact involute,
    before it is written; how far it is off goes to standard error.
    """
    from skg.cutting.gear import Gear

    if any(keyway) and not bore:
        raise UserError("--keyway goes with --bore")
    gear = Gear(module, teeth, pressure_angle, shift, clearance, fillet, bore, *keyway)
    name = f"gear, module {module:g}, {teeth} teeth, {pressure_angle:g} degrees"
    write_shape(name, gear, output, offset, tab, tape)
