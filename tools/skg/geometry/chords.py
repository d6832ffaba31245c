"""Chords for arcs: one rule for their number, and how far they may leave an arc where it is seen, cut or measured."""

from __future__ import annotations

from math import acos, ceil

#: Distances between an arc or a curve and its chords, mm: where contours are looked for, cut along chords, and compared
#: with a tape.
SEEN, CUT, MEASURED = 5e-4, 3e-4, 5e-5
#: No chord has a half angle with a smaller cosine.
_COARSEST = 0.9


def chords_of(radius: float, sweep: float, off: float) -> int:
    """Number of chords, two at least, that leave an arc (its sweep in radians) by no more than `off`, mm."""
    return max(2, ceil(abs(sweep) / (2 * acos(max(_COARSEST, 1 - off / radius)))))
