"""Splines and arcs as drawing programs write them: controls that coincide, ends that do not quite meet."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, pi, sin
from pathlib import Path

import pytest
from cuthelp import LIMIT, apart, drawing, saved, stretches
from ezdxf.layouts import Modelspace
from facthelp import says
from shapely.geometry import LinearRing, LineString
from toolhelp import Run

from skg.geometry import fitting
from skg.messages.finding import Phrase
from skg.ref import fit


def standing_still(space: Modelspace) -> LinearRing:
    """Cubic Béziers, the first and the last one with all their controls in one place: where the spline begins."""
    # (ordinates that floats round: where it stands still its derivative is noise)
    corners = [(70.1 + x / 3, 181.7 + y / 7) for x, y in ((0, 0), (29, 7), (37, 53), (11, 79))]
    controls = 4 * corners[:1]
    for p, q in zip(corners, corners[1:] + corners[:1], strict=True):
        controls += [(p[0] + 2, p[1] + 1), (q[0] - 1, q[1] + 2), q]
    return bezier(space, [*controls, *3 * controls[-1:]])


def with_a_corner(space: Modelspace) -> LinearRing:
    """Three controls in one place, in the middle of evenly spaced knots: a corner that no knot tells of."""
    controls = [(0, 0), (6, -3), (12, 0), (14, 9), (14, 9), (14, 9), (5, 7), (-2, 9), (-4, 4), (0, 0)]
    return bezier(space, controls, [0, 0, 0, *range(8), 7, 7, 7])


def with_a_nook(space: Modelspace) -> LinearRing:
    """The point of an ogive is a loop of some micrometres: no arcs follow that."""
    return bezier(space, [(0, 0), (12.820059, 10), (0, 10), (12.759586, 0), (12.759586, -3), (0, -3), (0, 0)])


def bezier(space: Modelspace, controls: list[tuple[float, float]], knots: list[float] | None = None) -> LinearRing:
    knots = knots or [0, *(k for k in range((len(controls) - 1) // 3 + 1) for _ in range(3)), (len(controls) - 1) // 3]
    spline = space.add_open_spline([(*place, 0) for place in controls], degree=3, knots=knots)
    return LinearRing([(point.x, point.y) for point in spline.construction_tool().approximate(12000)])


def bent(space: Modelspace) -> LinearRing:
    """An arc of 90 degrees, one end of which misses the line there by 4.5 µm along its radius."""
    places = [(20 + 30 * cos(pi / 2 * k / 2000), 10 + 30 * sin(pi / 2 * k / 2000)) for k in range(2001)]
    space.add_arc((20, 10), 30, 0, 90)
    lines = [(20, 40), (0, 40), (0, 0), (50, 0), (50.0045, 10)]
    for p, q in zip(lines, lines[1:], strict=False):
        space.add_line(p, q)
    return LinearRing([*places, *lines])


@pytest.mark.parametrize("shape", [standing_still, with_a_corner, with_a_nook, bent])
def test_curve(run: Run, tmp_path: Path, shape: Callable[[Modelspace], LinearRing]) -> None:
    """The tape is the curve, as shapely has it."""
    page = drawing()
    wanted = shape(page.modelspace())
    tape, program = tmp_path / "part.3b", tmp_path / "part.skg"
    result = run("cut", saved(page, tmp_path), "-o", tape, "--program", program)
    assert says(result.stderr, Phrase("contours-read"), Phrase("count-closed", count=1))
    start = program.read_text().split("FROM (")[1].split(")")[0].split(",")
    (places,) = stretches(tape.read_bytes(), (float(start[0]), float(start[1])))
    assert apart(LineString(places[1:-1]), wanted) < LIMIT + 0.004 * (shape is bent)


def test_flat_arcs_are_those_of_fit() -> None:
    """The limits of a flat arc are the same in the reference's FIT and in the nodes of a drawing's curves."""
    assert (float(fit.FLAT), float(fit.STRAIGHT)) == (fitting.FLAT, fitting.STRAIGHT)
