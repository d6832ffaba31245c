"""Arcs from where the controller really stands, to where it really ends (docs/drift.md).

Integers alone decide where a 3B controller ends an arc. So it can be told beforehand, and the next block can
start from there. Everything here is exact; all lengths are whole micrometres.
"""

from __future__ import annotations

from math import isqrt

from skg.ref import near, real
from skg.ref.real import Real
from skg.ref.tape import Grid, Punch, block, grid, quadrant_into
from skg.ref.values import Point

#: A float of the firmware has 32 bits: whole numbers above this are no longer exact.
EXACT = 2**32
#: Part of a shift of the centre by which a half counts as more than a half: as in the rounding of places.
HALF = 502


def sign(value: int) -> int:
    """1 for 0 and more, else -1."""
    return 1 if value >= 0 else -1


def least_root(start: Grid, w: int) -> int:
    """Least whole number whose square reaches n - w², n = x² + y² of the start.

    It is where the controller leaves the row or column w of an arc. (Circles of some µm may make n - w²
    negative: then of its absolute value, as the firmware does it.) The firmware takes differences of squares, from
    w to the nearer coordinate of the start: exact while they are whole numbers of 32 bits.
    """
    n = start[0] ** 2 + start[1] ** 2
    square = abs(n - w * w)
    if square == 0:
        return 0
    root = isqrt(square - 1) + 1
    apart = min(abs(w * w - c * c) for c in start)
    if apart >= EXACT:
        near.note("end of an arc", min(square - (root - 1) ** 2, root**2 - square + 1) / apart, 4 / EXACT)
    return root


def towards_bisector(start: Grid, end: Grid) -> tuple[Grid, Grid]:
    """Start and end about another whole centre: the nearest to that point of their bisector that lies along
    the chord. Both are then equally far from it, but for the rounding.
    """
    (xs, ys), (xe, ye) = start, end
    dx, dy = xe - xs, ye - ys
    chord = dx * dx + dy * dy
    # The centre moves by f/2|d|² times the chord d.
    f = xe * xe + ye * ye - xs * xs - ys * ys
    kx, ky = ((1000 * f * d + 2 * HALF * chord) // (2000 * chord) for d in (dx, dy))
    for d in (dx, dy):
        rest = (1000 * f * d + 2 * HALF * chord) % (2000 * chord) / (2000 * chord)
        near.note("centre", min(rest, 1 - rest), 1e-4)
    return (xs - kx, ys - ky), (xe - kx, ye - ky)


def arc(start: Grid, end: Grid, clockwise: bool, is_long: bool) -> tuple[str, Grid] | None:
    """The block of an arc and where the controller ends it, relative to its start.

    `start` is where it stands, `end` where it should go, relative to the rounded centre; `is_long`: the arc is
    more than half a turn. None where the arc is so flat that it goes out as a line. Clockwise arcs are looked
    at in their counter-clockwise image about the X axis.
    """
    (xs, ys), (xe, ye) = start, end
    if clockwise:
        ys, ye = -ys, -ye
    is_near = xs * xe + ys * ye >= 0
    if is_near and not is_long:
        chord, square = (xe - xs) ** 2 + (ye - ys) ** 2, xs * xs + ys * ys
        near.note("flat arc", chord * chord / (4 * square or 1) - 1, 1e-9)
        if chord * chord <= 4 * square:
            return None
    if not (is_near and is_long):
        (xs, ys), (xe, ye) = towards_bisector((xs, ys), (xe, ye))
    if (xs, ys) == (0, 0):
        return None
    axis = "Y" if abs(xe) > abs(ye) else "X"
    # Turned by a quarter for the count along Y: the count is along u, falling while v > 0.
    (us, vs), (ue, ve) = ((xs, ys), (xe, ye)) if axis == "X" else ((ys, -xs), (ye, -xe))
    extreme = least_root((xs, ys), 1)
    travel = (us + extreme) * sign(vs) - (ue + extreme) * sign(ve)
    if travel + (-extreme if is_long else extreme) < 0:
        travel += 4 * extreme
    if travel == 0:
        return None
    # The step that ends the block goes from w + 1 to w.
    w = ue * sign(ve)
    minor = (least_root((xs, ys), w + 1) - (w < 0)) * sign(ve)
    dx, dy = (ue - us, minor - vs) if axis == "X" else (vs - minor, ue - us)
    quadrant = quadrant_into(xs, ys)
    code = f"SR{5 - quadrant}" if clockwise else f"NR{quadrant}"
    return block(abs(xs), abs(ys), abs(travel), axis, code), (dx, -dy if clockwise else dy)


class DriftlessPunch(Punch):
    """A tape whose every block starts where the controller stands: `position` is that place."""

    def arc(self, end: Point, centre: Point, clockwise: bool, sweep: Real) -> None:
        """An arc of a true sweep in radians; a straight move where it is too flat or counts nothing."""
        (x, y), (xe, ye), (xc, yc) = self.position, grid(end), grid(centre)
        near.note("sweep", sweep - real.mp.pi, 1e-6)
        made = arc((x - xc, y - yc), (xe - xc, ye - yc), clockwise, sweep > real.mp.pi)
        if made is None:
            self.line(end)
        else:
            text, (dx, dy) = made
            self.lines.append(text)
            self.position = x + dx, y + dy
