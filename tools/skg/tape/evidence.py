"""Whether a tape is one without drift, by what its blocks tell."""

from __future__ import annotations

from collections import Counter
from math import log, pi

from skg.plane import dot
from skg.tape.block import Block, Tape
from skg.tape.roundings import closes, end_on_machine, gap_of, goes, likelihood, whole_ends

#: Log likelihood for a tape without drift where a route closes on the machine alone; against it, as programmed alone.
_SURE = 10


def drift_evidence(tape: Tape) -> float:
    """Log likelihood that a tape's blocks start where the controller stands, against a tape with drift.

    Where they do, a route that closes does so on the machine, and the circle of an arc whose centre was moved
    (docs/drift.md) passes close to a whole micrometre at the block's end, the closer the shorter the arc. On another
    tape it passes anywhere, and routes that close as programmed seldom do so on the machine. Where the tape does not
    tell, because the drawing lies on whole micrometres or is symmetrical, that is near 0.
    """
    return sum(map(_evidence_of_route, tape.stretches()))


def _evidence_of_route(blocks: list[Block]) -> float:
    """Log likelihood that the blocks between two stops are without drift, against a tape with drift."""
    arcs = [block for block in blocks if block.is_arc]
    evidence = sum(map(_evidence, arcs)) + sum(map(_evidence_of_circle, blocks))
    if not arcs:
        return evidence
    gap, spread = gap_of(blocks)
    is_closed = [sum(ordinates) for ordinates in zip(*map(goes, blocks), strict=True)] == [0, 0]
    if not closes(gap, spread):
        return evidence + _SURE * is_closed
    if not is_closed:
        return evidence - _SURE
    # Chance closes a route of many arcs the less; the misses of arcs that are congruent in pairs take each other away.
    alike = Counter((*sorted((block.x, block.y)), block.j) for block in arcs)
    return evidence + log(1 + sum(count % 2 for count in alike.values()))


def _evidence_of_circle(block: Block) -> float:
    """Log likelihood of a full circle: whether J counts the radius, or where the controller turns (docs/drift.md)."""
    if not block.is_full_circle or block.radius == block.turn:
        return 0.0
    return _SURE if block.j == 4 * block.turn else -_SURE


def _evidence(block: Block) -> float:
    """Log likelihood of an arc on a tape without drift, against any other tape."""
    if dot(block.start, end_on_machine(block)) >= 0 and abs(block.sweep) > pi:
        # The centre was not moved.
        return 0.0
    density = 0.0
    for place in whole_ends(block):
        if dot(place, place) == block.x**2 + block.y**2:
            # A drawing on whole micrometres: its arcs fit on any tape.
            return 0.0
        density += likelihood(block, place)
    return log(max(density, 1e-3))
