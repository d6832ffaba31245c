"""Measuring: how near fitted curves come to the true ones, and how many blocks they take.

Tangents are compared in 50 digits, distances in double precision. Lengths are in mm on the tape.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from curve_fitted import Biarcs, FittedPiece, Run, pieces
from true_curves import TRUE_CURVES, TrueCurve

from skg.ref.fit import MOST_PASSED, Node
from skg.ref.real import ZERO, Real
from skg.ref.values import Point

#: Points looked at on each arc, and steps of the golden section that looks for the nearest point of the true curve.
SAMPLES, SECTIONS = 64, 60
GOLDEN = (5**0.5 - 1) / 2
#: mm within which the nodes of an example are on its true curve: the programs know π to 12 digits, the firmware to 9.
ON_CURVE = 1e-6
#: How often nodes are doubled.
DOUBLINGS = 2


def distance(curve: list[FittedPiece], true: TrueCurve, parameters: np.ndarray) -> float:
    """The largest distance (mm) of the fitted path from the true curve, kept node to kept node.

    For each place the nearest point of the true curve between the same two nodes is looked for by golden section.
    """
    ends = true.at(parameters)
    path, low, high, kept = [], [], [], 0
    for piece in curve:
        path.append(piece.places(SAMPLES))
        low.append(np.full(SAMPLES, parameters[kept]))
        reached = np.flatnonzero(abs(path[-1][-1] - ends[kept + 1 : kept + MOST_PASSED + 2]) <= ON_CURVE)
        if len(reached):  # else the piece ends at a joint
            kept += 1 + int(reached[0])
            high += [np.full(SAMPLES, parameters[kept])] * (len(path) - len(high))
    assert kept == len(parameters) - 1
    p, a, b = np.concatenate(path), np.concatenate(low), np.concatenate(high)
    for _ in range(SECTIONS):
        c, d = b - GOLDEN * (b - a), a + GOLDEN * (b - a)
        left = np.abs(true.at(c) - p) < np.abs(true.at(d) - p)
        a, b = np.where(left, a, c), np.where(left, d, b)
    return float(np.max(np.abs(true.at((a + b) / 2) - p)))


def node(place: complex, way: complex | None) -> Node:
    """A node from double precision."""
    tangent = None if way is None else Point(Real(way.real), Real(way.imag))
    return Node(Point(Real(place.real), Real(place.imag)), tangent, ZERO)


def denser(true: TrueCurve, nodes: list[Node], times: int) -> tuple[np.ndarray, list[Node]]:
    """Parameters and nodes on the true curve, so many times as dense as the program's.

    A new node has its tangent where the program's nodes on both sides have theirs.
    """
    count = len(true.nodes) - 1
    parameters = np.interp(np.arange(count * times + 1) / times, np.arange(count + 1), true.nodes)
    given = [n.tangent is not None for n in nodes]
    told = [given[i // times] and given[-(-i // times)] for i in range(len(parameters))]
    ways = true.way(parameters) if any(told) else np.zeros(len(parameters))
    return parameters, [
        node(complex(z), complex(w) if t else None) for z, w, t in zip(true.at(parameters), ways, told, strict=True)
    ]


def true_curve(part: Path, nodes: list[Node]) -> TrueCurve | None:
    """The true curve of an example, None where it is not known; a node that is not on it is a UserError."""
    true = TRUE_CURVES.get(part.stem)
    if true is None:
        return None
    places = np.array([complex(n.point.x, n.point.y) for n in nodes])
    if len(places) != len(true.nodes) or np.max(np.abs(places - true.at(true.nodes))) > ON_CURVE:
        raise ValueError(f"{part}: its nodes are not those of the {true.name}")
    return true


@dataclass(frozen=True)
class Quality:
    """Of one curve: nodes, blocks, how many of these are chords of flat arcs, the largest jump of the tangent
    (radians, before flat arcs become chords) and the largest distance from the true curve (mm; None: not known), all
    by the program's own TOL. `biarcs` are that distance before flat arcs become chords and with every node kept, with
    the program's nodes and with twice, four times as many."""

    part: str
    curve: str
    nodes: int
    blocks: int
    flat: int
    jump: float
    distance: float | None = None
    biarcs: tuple[float, ...] = ()

    @property
    def factors(self) -> list[float]:
        """By how much each doubling of the nodes divides the distance."""
        return [a / b for a, b in pairwise(self.biarcs)]


def measure(part: Path, run: Run) -> Quality:
    """The quality of one curve of a part."""
    nodes = run.nodes
    true = true_curve(part, nodes)
    seen = run.seen()
    counted = len(nodes), seen.blocks, seen.flat, seen.jump
    if true is None:
        return Quality(part.stem, "only its nodes are known", *counted)
    sets = [(true.nodes, nodes)] + [denser(true, nodes, 2**n) for n in range(1, DOUBLINGS + 1)]
    biarcs = tuple(distance(pieces(n, kind=Biarcs), true, parameters) for parameters, n in sets)
    off = distance(pieces(nodes, run.tolerance), true, true.nodes)
    return Quality(part.stem, true.name, *counted, off, biarcs)
