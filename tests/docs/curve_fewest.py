"""TOL against the optimum: the blocks that it makes of a curve, and the fewest that there can be."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from curve_fitted import pieces
from curve_measure import denser, true_curve

from skg.ref.fit import Node, circle_tangent, mirrored
from skg.ref.real import Real

#: Directions that differ by no more than this (radians) are one.
SMOOTH = 1e-6
#: TOL is tried on the program's nodes and on so many times these, up to a limit.
DENSER, MOST_NODES = 4, 300


def with_tangents(nodes: list[Node]) -> list[Node]:
    """The nodes with the tangents that language.md, section 5, gives them."""
    inner = [
        b if b.tangent else replace(b, tangent=circle_tangent(a.point, b.point, c.point))
        for a, b, c in zip(nodes, nodes[1:], nodes[2:], strict=False)
    ]
    first, last = nodes[0], nodes[-1]
    if not first.tangent:
        first = replace(first, tangent=mirrored(inner[0].tangent, inner[0].point - first.point))
    if not last.tangent:
        last = replace(last, tangent=mirrored(inner[-1].tangent, last.point - inner[-1].point))
    return [first, *inner, last]


def fewest_blocks(nodes: list[Node], tolerance: float) -> int:
    """The fewest blocks by dynamic programming, of all curves of the kind that TOL makes.

    These keep the first node, the last and any others, go from one to the next by a biarc with the nodes' own
    tangents, and have every passed node within the tolerance, however many there are. A span is two blocks, or one
    where one arc (or one line) does it: its two arcs are one circle. In double precision, with the arcs' centres:
    not the formulas of `skg.ref.fit`.
    """
    known = with_tangents(nodes)
    z = np.array([complex(n.point.x, n.point.y) for n in known])
    t = np.array([complex(n.tangent.x, n.tangent.y) for n in known])
    best = [0.0] + [np.inf] * (len(z) - 1)
    for i in range(len(z)):
        for j in range(i + 1, len(z)):
            cost = span_blocks(z[i : j + 1], t[i], t[j], tolerance) if best[i] + 1 < best[j] else None
            if cost:
                best[j] = min(best[j], best[i] + cost)
    return int(best[-1])


def span_blocks(z: np.ndarray, t: complex, u: complex, tolerance: float) -> int | None:
    """Blocks of the biarc from the first node to the last with tangents t and u; None when it leaves a node out."""
    v = z[-1] - z[0]
    along = (v * np.conj(t + u)).real
    square = abs(v) ** 2
    below = along + np.sqrt(along**2 + 2 * max(1 - (t * np.conj(u)).real, 0) * square)
    if below <= 1e-7 * abs(v):
        return None
    d = square / below
    middle = (z[0] + d * t + z[-1] - d * u) / 2
    across = z[-1] - d * u - z[0] - d * t
    passed = z[1:-1]
    before = ((passed - middle) * np.conj(across)).real <= 0
    near_first = arc_distance(z[0], t, middle, passed[before])
    near_last = arc_distance(z[-1], -u, middle, passed[~before])
    if max(near_first, near_last) > tolerance:
        return None
    one = abs(2 * v * (v * np.conj(t)).real / square - t - u) <= SMOOTH
    return 1 if one else 2


def arc_distance(p: complex, t: complex, q: complex, places: np.ndarray) -> float:
    """The largest distance of places from the arc (less than half round) from p in the direction t to q.

    Infinite for a place that lies behind p.
    """
    if not len(places):
        return 0.0
    if np.min(((places - p) * np.conj(t)).real) < 0:
        return np.inf
    w = q - p
    bulge = (np.conj(t) * w).imag
    if abs(bulge) <= 1e-9 * abs(w):
        return float(np.max(np.abs((np.conj(t) * (places - p)).imag)))
    r = abs(w) ** 2 / (2 * bulge)
    return float(np.max(np.abs(np.abs(places - (p + 1j * t * r)) - abs(r))))


@dataclass(frozen=True)
class Saving:
    """The effect of TOL on one curve: nodes, blocks without it, blocks with it, and the fewest possible."""

    part: str
    nodes: int
    blocks: int
    joined: int
    fewest: int

    @property
    def ratio(self) -> float:
        """Blocks with TOL over the fewest."""
        return self.joined / self.fewest


def saving(part: Path, nodes: list[Node], tolerance: str) -> Saving:
    """TOL on the nodes of one curve; `tolerance` in mm."""
    joined = pieces(nodes, Real(tolerance))
    return Saving(part.stem, len(nodes), len(pieces(nodes)), len(joined), fewest_blocks(nodes, float(tolerance)))


def savings(part: Path, nodes: list[Node], tolerance: str) -> list[Saving]:
    """The same for the program's nodes and, where the true curve is known, for denser ones if they are not too many."""
    true = true_curve(part, nodes)
    found = [saving(part, nodes, tolerance)]
    if true and DENSER * len(nodes) <= MOST_NODES:
        found.append(saving(part, denser(true, nodes, DENSER)[1], tolerance))
    return found
