"""Distances of the controller's steps from the exact contour: the reference's segments, its blocks, every step."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from math import atan2, hypot, pi
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from toolhelp import ROOT

from skg.ref import run
from skg.ref.cutter import Cutter
from skg.ref.route import Segment
from skg.ref.tape import Grid, Punch
from skg.tape import parse
from skg.tape.controller import trace_array

EXAMPLES = sorted((ROOT / "examples").glob("*.skg"))
#: The path is not meant to come back to where it began.
OPEN = {"cad-tape", "skg04-polar"}

Points = NDArray[np.float64]


@dataclass(frozen=True)
class Curve:
    """A segment of the wire's exact path, µm; an arc has a centre, a sense (±1) and a sweep in radians."""

    start: tuple[float, float]
    end: tuple[float, float]
    centre: tuple[float, float] | None = None
    sense: int = 0
    sweep: float = 0.0

    def off(self, points: Points) -> Points:
        """Distance of each point (n × 2) from the segment, µm."""
        if self.centre is None:
            way = np.subtract(self.end, self.start)
            to = points - self.start
            part = np.clip(to @ way / max(way @ way, 1e-12), 0, 1)
            return np.hypot(*(to - part[:, None] * way).T)
        to, first = points - self.centre, np.subtract(self.start, self.centre)
        turned = self.sense * (np.arctan2(to[:, 1], to[:, 0]) - atan2(first[1], first[0])) % (2 * pi)
        ends = np.minimum(*(np.hypot(*(points - end).T) for end in (self.start, self.end)))
        return np.where(turned <= self.sweep, abs(np.hypot(*to.T) - hypot(*first)), ends)


@dataclass(frozen=True)
class Step:
    """A segment, its block (empty: none) and where the tape takes the wire to be before and after it."""

    curve: Curve
    block: str
    before: Grid
    after: Grid


def micrometres(segment: Segment) -> Curve:
    """A segment of the reference in floats."""
    start, end = ((1000 * float(p.x), 1000 * float(p.y)) for p in (segment.start, segment.end))
    if not segment.is_arc:
        return Curve(start, end)
    centre = 1000 * float(segment.centre.x), 1000 * float(segment.centre.y)
    return Curve(start, end, centre, 1 if segment.radius > 0 else -1, float(segment.sweep))


@cache
def followed(part: Path, drift: bool) -> tuple[tuple[Step, ...], bytes]:
    """The reference's steps for a part, segment by segment, and its tape."""
    found: list[Step] = []
    emit = Cutter._emit

    def watched(self: Cutter, segment: Segment) -> None:
        tape: Punch = self.tape
        lines, before = len(tape.lines), tape.position
        emit(self, segment)
        found.append(Step(micrometres(segment), "".join(tape.lines[lines:]), before, tape.position))

    Cutter._emit = watched
    try:
        result = run(part.read_text(), drift=drift)
    finally:
        Cutter._emit = emit
    assert result.error is None
    return tuple(found), result.tape


def steps(part: Path, drift: bool) -> tuple[Step, ...]:
    """The reference's steps for a part."""
    return followed(part, drift)[0]


def stepped(block: str, at: Grid) -> NDArray[np.int64]:
    """Every place of the controller (n × 2, µm) that follows one block from `at`, the first one included."""
    parsed = parse(f"{block}\r\nDD\r\n".encode()).blocks[0]
    places = np.frombuffer(trace_array(parsed), np.int64).reshape(-1, 2)
    return np.vstack([[parsed.start], places]) - parsed.start + at


@cache
def farthest(part: Path, drift: bool) -> tuple[float, Grid]:
    """Largest distance of the controller's places from the exact path, µm, and where it ends less where it began.

    It starts where the tape begins and goes on from where it stands. A place belongs to the segment of its
    block or, around corners, to a neighbour.
    """
    path = steps(part, drift)
    at, worst = path[0].before, 0.0
    for k, step in enumerate(path):
        if not step.block:
            continue
        places = stepped(step.block, at)
        at = int(places[-1, 0]), int(places[-1, 1])
        off = step.curve.off(places.astype(float))
        far = places[off > worst].astype(float)
        if len(far):
            near = [path[n].curve.off(far) for n in (k - 1, k, k + 1) if 0 <= n < len(path)]
            worst = max(worst, float(np.min(near, axis=0).max()))
    return worst, (at[0] - path[0].before[0], at[1] - path[0].before[1])
