"""Shared by the tests of `skg cut`: drawings, and a tape's places as the controller goes; shapely judges."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from itertools import pairwise
from math import cos, pi, sin
from pathlib import Path
from typing import Any

import ezdxf
import pytest
import shapely
from ezdxf.document import Drawing
from facthelp import says
from oneblock import run_block
from shapely.geometry import LineString, Polygon
from toolhelp import Run

from skg import tape as tapes
from skg.errors import UserError
from skg.geometry.contour import Contour, Edge
from skg.geometry.plane import XY
from skg.job.job import Chosen
from skg.job.wanted import Overrides
from skg.messages.finding import Phrase
from skg.pipeline.steps import OpenedDrawing
from skg.tape.block import Block

#: A tape may be this far from the drawing, mm; arcs are handed to shapely as chords this near.
LIMIT, CHORDS = 0.003, 0.0005


def drawing() -> Drawing:
    found = ezdxf.new()
    found.units = ezdxf.units.MM
    return found


def polygon(corners: list[XY], page: Drawing, **attributes: object) -> Polygon:
    page.modelspace().add_lwpolyline(corners, close=True, dxfattribs=attributes)
    return Polygon(corners)


def closed(corners: list[XY], *layers: str) -> Contour:
    """A closed contour of lines."""
    return Contour(tuple(map(Edge, corners, corners[1:] + corners[:1])), True, layers)


def circle(x: float, y: float, radius: float) -> Contour:
    """A circle, counter-clockwise from its +X side."""
    return Contour((Edge((x + radius, y), (x + radius, y), (x, y), 2 * pi),), True)


def choose(opened: OpenedDrawing, number: int, **settings: object) -> Chosen:
    """Settings for a contour of a drawing, by its number."""
    return opened.known.choose(number, Overrides(**settings))


def saved(page: Drawing, folder: Path) -> Path:
    path = folder / "part.dxf"
    page.saveas(path)
    return path


def along(block: Block, at: XY) -> tuple[list[XY], XY]:
    """The controller's places in a block, thinned out, from a place in mm."""
    (dx, dy), start = run_block(block).move, block.start
    end = at[0] + dx / 1000, at[1] + dy / 1000
    if block.is_line:
        return [at, end], end
    centre = at[0] - start[0] / 1000, at[1] - start[1] / 1000
    radius = ((block.x**2 + block.y**2) ** 0.5) / 1000
    begin = complex(start[0], start[1])
    steps = max(4, int(abs(block.sweep) * (radius / CHORDS / 8) ** 0.5) + 2)
    places = []
    for k in range(steps + 1):
        turned = begin * complex(cos(block.sweep * k / steps), sin(block.sweep * k / steps)) / 1000
        places.append((centre[0] + turned.real, centre[1] + turned.imag))
    return [*places[:-1], end], end


def stretches(data: bytes, start: XY) -> Iterator[list[XY]]:
    """The places of the wire between stops; moves between start holes are ignored."""
    at = start
    for number, blocks in enumerate(tapes.parse(data, "tape").stretches()):
        places = [at]
        for block in blocks:
            more, at = along(block, at)
            places += more[1:]
        if number % 2 == 0:
            yield places


def apart(one: shapely.Geometry, other: shapely.Geometry) -> float:
    """Hausdorff distance, both ways, of two curves (mm)."""
    return max(farthest(one, other), farthest(other, one))


def farthest(one: shapely.Geometry, other: shapely.Geometry) -> float:
    """Largest distance of a curve, looked at each 0.02 mm, from another (mm)."""
    chords = [LineString(pair) for part in shapely.get_parts(other) for pair in pairwise(part.coords)]
    points = shapely.points(shapely.get_coordinates(one.segmentize(0.02)))
    _, distances = shapely.STRtree(chords).query_nearest(points, return_distance=True, all_matches=False)
    assert len(distances) == len(points) > 0
    return float(distances.max())


def start_holes(report: str) -> list[tuple[str, str]]:
    """The places of the start holes in the text of a report, as it has them."""
    (line,) = (line for line in report.splitlines() if says(line, Phrase("order-of-cutting")))
    return re.findall(r"\((-?[\d.]+), (-?[\d.]+)\)", line)


def values_of(code: str, run: Run, *words: object) -> list[dict[str, Any]]:
    """The values of the findings of a code, as `skg cut --json` gives them, with their places."""
    report = json.loads(run("cut", *words, "--json").stderr)
    return [one["values"] | {"place": one.get("place")} for one in report["findings"] if one["code"] == code]


def run_failing(run: Run, *words: object) -> str:
    with pytest.raises(UserError) as failed:
        run(*words)
    return str(failed.value)
