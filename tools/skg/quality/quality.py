"""`skg quality`: how near fitted curves come to the true ones, and how many blocks they take.

A curve is what one run of FIT statements makes, without R: the arcs and lines of the reference (skg.ref.fit, in 50
digits). Tangents are compared in 50 digits too, distances in double precision. Lengths are in mm on the tape.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path

import click
import numpy as np

from skg.errors import UserError
from skg.quality.true_curves import TRUE_CURVES, TrueCurve
from skg.ref import real
from skg.ref.fit import MOST_PASSED, Curve, Node, circle_tangent, reflected
from skg.ref.geometry import enlarged
from skg.ref.interpreter import Interpreter
from skg.ref.near import Watch
from skg.ref.real import ZERO, Real
from skg.ref.tape import Tape
from skg.ref.values import Circle, Point

#: Points looked at on each arc, and steps of the golden section that looks for the nearest point of the true curve.
SAMPLES, SECTIONS = 64, 60
GOLDEN = (5**0.5 - 1) / 2
#: mm within which the nodes of an example are on its true curve: the programs know π to 12 digits, the machine to 9.
ON_CURVE = 1e-6
#: Directions that differ by no more than this (radians) are one.
SMOOTH = 1e-6
#: Nodes are doubled twice; TOL is tried on the program's nodes and on so many times these, up to a limit.
DOUBLINGS, DENSER, MOST_NODES = 2, 4, 300
#: Radius (mm) from which double precision, and so this module, takes a circle for a line.
LARGEST = Real("1e8")


@dataclass(frozen=True)
class Piece:
    """An arc of a fitted curve, or a line (no circle)."""

    start: Point
    end: Point
    circle: Circle | None

    def heading(self, p: Point) -> Point:
        """Unit direction of travel at an end."""
        circle = self.circle
        v = self.end - self.start if circle is None else (p - circle.centre).left() * circle.r
        return v * (1 / v.length())

    def places(self, count: int) -> np.ndarray:
        """So many places on the piece, evenly spaced, both ends included, as complex numbers."""
        part = np.linspace(0, 1, count)
        start, end = complex(self.start.x, self.start.y), complex(self.end.x, self.end.y)
        if self.circle is None:
            return start + part * (end - start)
        centre = complex(self.circle.x, self.circle.y)
        sweep = np.angle((end - centre) / (start - centre))  # an arc of a biarc turns less than half round
        return centre + (start - centre) * np.exp(1j * part * sweep)


class Biarcs(Curve):
    """The curve before flat arcs become their chords."""

    def _arc(self, p: Point, t: Point, q: Point, offset: Real) -> None:
        w = q - p
        bulge = t.cross(w)
        r = w.dot(w) / (2 * bulge) if bulge else LARGEST
        if abs(r) < LARGEST:
            centre = p + t.left() * r
            self.feed(Circle(centre.x, centre.y, r), offset)
        self.feed(q, offset)


@dataclass(frozen=True)
class Run:
    """One run of FIT statements: its nodes, and the TOL (mm) that holds for it."""

    nodes: list[Node]
    tolerance: Real = ZERO


class Recorder(Interpreter):
    """A machine that keeps every run of FIT statements."""

    def __init__(self) -> None:
        self.runs: list[Run] = []
        super().__init__((), Watch(), Tape())

    def _fit(self, node: Point, angle: Real | None) -> None:
        if self.cutter.curve is None:
            self.runs.append(Run([], self.cutter.tolerance))
        super()._fit(node, angle)
        tangent = None if angle is None else Point(real.cos(angle), real.sin(angle))
        self.runs[-1].nodes.append(Node(enlarged(node, self.cutter.scale), tangent, self.offset))


def fitted_runs(source: str) -> list[Run]:
    """The runs of FIT statements that a program makes; a program that ends in ERR is a UserError."""
    machine = Recorder()
    if machine.load(source) or machine.run():
        raise UserError(f"the program ends in {machine.paper[-1].strip()}")
    return machine.runs


def pieces(nodes: Iterable[Node], tolerance: Real = ZERO, kind: type[Curve] = Curve) -> list[Piece]:
    """The blocks of a curve: the arcs and lines between the points that it is fed as."""
    fed: list[Point | Circle] = []
    curve = kind(lambda value, _: fed.append(value), tolerance)
    for node in nodes:
        curve.add(node)
    curve.finish()
    made: list[Piece] = []
    start, circle = fed[0], None
    for value in fed[1:]:
        if isinstance(value, Circle):
            circle = value
        else:
            made.append(Piece(start, value, circle))
            start, circle = value, None
    return made


def tangent_jump(curve: list[Piece]) -> float:
    """The largest angle (radians) between two arcs where they meet."""
    jumps = [abs(real.mp.asin(a.heading(a.end).cross(b.heading(b.start)))) for a, b in pairwise(curve)]
    return float(max(jumps, default=ZERO))


def distance(curve: list[Piece], true: TrueCurve, parameters: np.ndarray) -> float:
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
        raise UserError(f"{part}: its nodes are not those of the {true.name}")
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
    made = pieces(nodes, run.tolerance)
    flat = sum(piece.circle is None for piece in made)
    jump = tangent_jump(pieces(nodes, run.tolerance, Biarcs))
    if true is None:
        return Quality(part.stem, "only its nodes are known", len(nodes), len(made), flat, jump)
    sets = [(true.nodes, nodes)] + [denser(true, nodes, 2**n) for n in range(1, DOUBLINGS + 1)]
    biarcs = tuple(distance(pieces(n, kind=Biarcs), true, parameters) for parameters, n in sets)
    off = distance(made, true, true.nodes)
    return Quality(part.stem, true.name, len(nodes), len(made), flat, jump, off, biarcs)


# TOL against the optimum ---------------------------------------------------------------------------------


def with_tangents(nodes: list[Node]) -> list[Node]:
    """The nodes with the tangents that language.md, section 5, gives them."""
    inner = [
        b if b.tangent else replace(b, tangent=circle_tangent(a.point, b.point, c.point))
        for a, b, c in zip(nodes, nodes[1:], nodes[2:], strict=False)
    ]
    first, last = nodes[0], nodes[-1]
    if not first.tangent:
        first = replace(first, tangent=reflected(inner[0].tangent, inner[0].point - first.point))
    if not last.tangent:
        last = replace(last, tangent=reflected(inner[-1].tangent, last.point - inner[-1].point))
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
    """What TOL does to one curve: nodes, blocks without it, blocks with it, and the fewest that there can be."""

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


# Tables --------------------------------------------------------------------------------------------------


def table(heading: list[str], rows: list[list[str]], words: int) -> str:
    """A Markdown table that reads well as it is; the first columns are words, the others numbers."""
    widths = [max(len(row[n]) for row in [heading, *rows]) for n in range(len(heading))]

    def line(cells: Iterable[str]) -> str:
        padded = [c.ljust(w) if n < words else c.rjust(w) for n, (c, w) in enumerate(zip(cells, widths, strict=True))]
        return f"| {' | '.join(padded)} |"

    rule = ["-" * w if n < words else "-" * (w - 1) + ":" for n, w in enumerate(widths)]
    return "\n".join(map(line, [heading, rule, *rows])) + "\n"


def micrometres(length: float | None) -> str:
    """A length in µm, three digits."""
    return "-" if length is None else f"{1000 * length:.3g}"


def quality_table(found: list[Quality]) -> str:
    """One row for each curve; distances in µm."""
    heading = ["part", "true curve", "nodes", "blocks", "chords", "jump", "off", "biarcs", "×2", "×4", "factors"]
    rows = [
        [
            *(q.part, q.curve, str(q.nodes), str(q.blocks), str(q.flat), f"{q.jump:.0e}", micrometres(q.distance)),
            *map(micrometres, q.biarcs or [None] * (DOUBLINGS + 1)),
            ", ".join(f"{f:.1f}" for f in q.factors) or "-",
        ]
        for q in found
    ]
    return table(heading, rows, words=2)


def saving_table(found: list[Saving]) -> str:
    """One row for each set of nodes."""
    heading = ["part", "nodes", "blocks", "with TOL", "fewest", "ratio"]
    rows = [
        [s.part, *map(str, (s.nodes, s.blocks, s.joined, s.fewest)), f"{s.ratio:.2f}"]
        for s in found
    ]
    return table(heading, rows, words=1)


@click.command(name="quality")
@click.argument(
    "parts", metavar="PART...", nargs=-1, required=True, type=click.Path(exists=True, dir_okay=False, path_type=Path)
)
@click.option("--tol", metavar="MM", type=click.FloatRange(min=0, min_open=True),
              help="Instead, join nodes within so many mm and compare the blocks with the fewest possible.")
def command(parts: tuple[Path, ...], tol: float | None) -> None:
    """Measure the curves that the FIT statements of PART (SKG programs) make, by the reference.

    One row for each run of FIT statements: nodes, blocks, blocks that are chords of flat arcs, and before these
    became chords the largest jump of the tangent (radians). For the examples in examples/, whose true curves are
    known, the largest distance from it (µm): of the blocks; of the biarcs, with the nodes of the program, with twice
    and four times as many; by how much each doubling divides it. A TOL in the program counts but for the biarcs, which
    keep every node.

    With --tol, what TOL (docs/curves.md) does to the number of blocks, with the program's nodes and four times as many,
    if these are no more than 300; a TOL in the program does not count.
    """
    curves = [(part, run) for part in parts for run in fitted_runs(part.read_text()) if len(run.nodes) > 2]
    if tol is None:
        click.echo(quality_table([measure(part, run) for part, run in curves]), nl=False)
    else:
        click.echo(saving_table([s for part, run in curves for s in savings(part, run.nodes, str(tol))]), nl=False)
