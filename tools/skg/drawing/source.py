"""Where a tape comes from: a .3b file, or a .skg program that is run first."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from math import atan2, hypot, sqrt
from pathlib import Path

import click

from skg.errors import UserError
from skg.tape import block as tapes
from skg.tape.block import Tape

_EMULATOR = Path(__file__).parents[3] / "build" / "skg80"


@dataclass(frozen=True)
class Piece:
    """A line or an arc of the nominal contour, mm; an arc has a centre and a signed sweep in radians."""

    start: tuple[float, float]
    end: tuple[float, float]
    centre: tuple[float, float] | None = None
    sweep: float = 0.0

    @property
    def angles(self) -> tuple[float, float]:
        """Start and end angle of an arc, radians; the end is the start plus the signed sweep."""
        first = atan2(self.start[1] - self.centre[1], self.start[0] - self.centre[0])
        return first, first + self.sweep


@dataclass(frozen=True)
class Made:
    """A tape, where its wire starts on the drawing (mm), and its nominal contour, if it was asked for."""

    tape: Tape
    start: tuple[float, float] = (0.0, 0.0)
    contour: tuple[Piece, ...] = ()


def skg80_option(function: Callable) -> Callable:
    """Give a command the option --skg80."""
    return click.option(
        "--skg80", metavar="FILE",
        help="The emulator that runs .skg programs, or `reference` for the reference interpreter. Default: "
             "build/skg80, else the reference.")(function)


def load(name: str, skg80: str | None = None, with_contour: bool = False) -> Made:
    """Return what is in a file: a program when its name ends in .skg, else a tape.

    `with_contour` on a tape, and a program that ends in ERR, are a `UserError`.
    """
    if not name.lower().endswith(".skg"):
        if with_contour:
            raise UserError(f"{name}: a tape has no nominal contour, expected a .skg program")
        return Made(tapes.read(name))
    # The reference is needed in any case: only it knows where on the drawing the wire is.
    data, path = _run_reference(name)
    if skg80 != "reference":
        data = _run_emulator(name, skg80) or data
    start = (float(path[0].start.x), float(path[0].start.y)) if path else (0.0, 0.0)
    return Made(tapes.parse(data, name), start, nominal(path) if with_contour else ())


def _run_emulator(name: str, skg80: str | None) -> bytes | None:
    """Run a program on the emulator. None when no emulator was named and the built one is not ready."""
    program = Path(skg80) if skg80 else _EMULATOR
    if not program.exists():
        if skg80:
            raise UserError(f"{program}: no such file")
        return None
    try:
        done = subprocess.run([program, "--max-cycles", str(10**12), name], capture_output=True, check=False)
    except PermissionError:
        raise UserError(f"{program}: not a program that can be run") from None
    if done.returncode == 2 and not skg80:
        return None
    if done.returncode:
        last = done.stderr.decode("ascii", "replace").strip().splitlines()[-1:]
        raise UserError(f"{name}: {last[0] if last else f'{program} ended with {done.returncode}'}")
    return done.stdout


def _run_reference(name: str) -> tuple[bytes, list]:
    """Run a program through the reference: the tape's bytes and the path's segments."""
    from skg.ref import run

    try:
        text = Path(name).read_bytes().decode("ascii")
    except UnicodeDecodeError as error:
        raise UserError(f"{name}: byte {error.start + 1} is not ASCII") from None
    if not text.strip():
        raise UserError(f"{name}: expected a program, the file is empty")
    result = run(text)
    if result.error:
        number, line = result.error
        where = f" LINE {line}" if line is not None else ""
        raise UserError(f"{name}: ERR {number:02d}{where}")
    return result.tape, result.path


def nominal(path: list) -> tuple[Piece, ...]:
    """Return the contour as drawn, from the reference's segments (`skg.ref.route.Segment`).

    Where two elements meet the contour has its corner at their crossing nearest to the wire's corner; where
    they have none (they touch, or FIT's chords replace them), at the wire's corner moved back by R.
    """
    pieces: list[Piece] = []
    run: list = []
    for segment in [*path, None]:
        if segment is not None and segment.nominal is not None:
            run.append(segment)
        elif run:
            pieces += _contour(run)
            run = []
    return tuple(pieces)


def _contour(run: list) -> list[Piece]:
    corners = [_foot(run[0], run[0].start)]
    corners += [_corner(one, other) for one, other in pairwise(run)]
    corners.append(_foot(run[-1], run[-1].end))
    found = []
    for segment, (start, end) in zip(run, pairwise(corners), strict=True):
        if not segment.is_arc:
            found.append(Piece(start, end))
            continue
        centre = float(segment.centre.x), float(segment.centre.y)
        sense = 1 if segment.radius > 0 else -1
        # The sweep of the wire's arc, set right for corners that lie elsewhere on the nominal one.
        sweep = sense * float(segment.sweep)
        for at, wire, side in ((end, segment.end, 1), (start, segment.start, -1)):
            sweep += side * _turn(centre, _pair(wire), at)
        found.append(Piece(start, end, centre, sweep))
    return found


def _pair(point: object) -> tuple[float, float]:
    return float(point.x), float(point.y)


def _turn(centre: tuple[float, float], one: tuple[float, float], other: tuple[float, float]) -> float:
    """Angle from one point to another as seen from the centre, −π…π."""
    (x, y), (u, v) = ((p[0] - centre[0], p[1] - centre[1]) for p in (one, other))
    return atan2(x * v - y * u, x * u + y * v)


def _foot(segment: object, wire: object) -> tuple[float, float]:
    """The nominal curve's point nearest to a place of the wire, mm."""
    x, y = _pair(wire)
    curve = segment.nominal
    if not hasattr(curve, "r"):
        off = float(curve.a) * x + float(curve.b) * y - float(curve.g)
        return x - off * float(curve.a), y - off * float(curve.b)
    xc, yc, radius = float(curve.x), float(curve.y), abs(float(curve.r))
    distance = hypot(x - xc, y - yc) or 1.0
    return xc + radius * (x - xc) / distance, yc + radius * (y - yc) / distance


def _corner(one: object, other: object) -> tuple[float, float]:
    """Where two neighbours' nominal curves meet."""
    wire = _pair(one.end)
    # A crossing much further away than the offsets explain belongs to another place of the same curves.
    reach = 50 * max(abs(float(one.offset)), abs(float(other.offset))) + 0.01
    crossings = [point for point in _crossings(one.nominal, other.nominal)
                 if hypot(point[0] - wire[0], point[1] - wire[1]) <= reach]
    if not crossings:
        return _foot(one, one.end)
    return min(crossings, key=lambda point: hypot(point[0] - wire[0], point[1] - wire[1]))


def _crossings(one: object, other: object) -> list[tuple[float, float]]:
    """Crossings of two of the reference's curves in floats; none where they only touch or run parallel."""
    if hasattr(one, "r") and not hasattr(other, "r"):
        return _crossings(other, one)
    if not hasattr(other, "r"):
        (a, b, g), (c, d, h) = ((float(s.a), float(s.b), float(s.g)) for s in (one, other))
        area = a * d - b * c
        return [((g * d - b * h) / area, (a * h - g * c) / area)] if abs(area) > 1e-3 else []
    xc, yc, radius = float(other.x), float(other.y), abs(float(other.r))
    if hasattr(one, "r"):
        # The common chord of two circles is a line.
        dx, dy = float(one.x) - xc, float(one.y) - yc
        distance = hypot(dx, dy)
        if distance < 1e-9:
            return []
        along = (distance**2 + radius**2 - float(one.r) ** 2) / (2 * distance)
        a, b = dx / distance, dy / distance
    else:
        a, b = float(one.a), float(one.b)
        along = float(one.g) - a * xc - b * yc
    if abs(along) > radius * (1 - 1e-6):
        return []
    half = sqrt(radius**2 - along**2)
    return [(xc + a * along - b * side, yc + b * along + a * side) for side in (half, -half)]
