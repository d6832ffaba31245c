"""Drawings that are saved anew: what a CAD program, and who draws, may do to contours; how many are found again.

python tests/tools/matchhelp.py FOLDER...       the table, for the drawings of some folders
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path
from random import Random

import numpy as np

from skg.errors import UserError
from skg.geometry.contour import Contour, CurveNode, Edge
from skg.geometry.edge_arrays import boxes_of
from skg.geometry.plane import XY
from skg.job.matching import Known
from skg.job.read_options import ReadOptions
from skg.job.wanted import Overrides
from skg.planning.nesting import Nesting
from skg.reading.read import read

Place = Callable[[XY], XY]
#: Contours, and the number that each had before, None for a new one.
Edited = tuple[list[Contour], list[int | None]]


def mapped(contour: Contour, place: Place) -> Contour:
    """The contour with all its places elsewhere; an arc that is an arc no more goes in chords."""
    return replace(contour, edges=tuple(new for edge in contour.edges for new in _mapped(edge, place)))


def _mapped(edge: Edge, place: Place) -> Iterator[Edge]:
    start, end = place(edge.start), place(edge.end)
    if edge.nodes:
        nodes = tuple(CurveNode(place(node.point), node.angle) for node in edge.nodes)
        samples = np.array([place(tuple(sample)) for sample in edge.samples.tolist()])
        yield replace(edge, start=start, end=end, nodes=nodes, samples=samples)
    elif edge.centre is None:
        yield replace(edge, start=start, end=end)
    else:
        moves = [
            (now[0] - then[0], now[1] - then[1])
            for then, now in ((edge.start, start), (edge.end, end), (edge.centre, place(edge.centre)))
        ]
        if max(abs(one[axis] - other[axis]) for one, other in pairwise(moves) for axis in (0, 1)) < 0.01:
            yield replace(edge, start=start, end=end, centre=place(edge.centre))
        else:
            yield from (
                replace(edge, start=p, end=q, centre=None, sweep=0.0) for p, q in pairwise(map(place, edge.points()))
            )


def shuffled(contours: Sequence[Contour], random: Random) -> Edited:
    """The contours in another order, each begun elsewhere, half of them backwards."""
    numbers = random.sample(range(len(contours)), len(contours))
    found = []
    for number in numbers:
        one, first = contours[number], 0
        if one.is_closed:
            first = random.randrange(len(one.edges))
        one = replace(one, edges=one.edges[first:] + one.edges[:first])
        found.append(one.reversed() if random.random() < 0.5 else one)
    return found, list(numbers)


def noisy(contours: Sequence[Contour], random: Random) -> Edited:
    """All places off by up to a micrometre."""
    off: dict[XY, XY] = {}

    def place(at: XY) -> XY:
        return off.setdefault(at, (at[0] + random.uniform(-1e-3, 1e-3), at[1] + random.uniform(-1e-3, 1e-3)))

    return [mapped(one, place) for one in contours], list(range(len(contours)))


def moved(contours: Sequence[Contour], _random: Random) -> Edited:
    """The whole drawing elsewhere."""
    return [one.shifted((37.5, -12.25)) for one in contours], list(range(len(contours)))


def stretched(by: float) -> Callable[[Sequence[Contour], Random], Edited]:
    """Make the edit that moves the right half of a drawing."""

    def edit(contours: Sequence[Contour], _random: Random) -> Edited:
        boxes, _ = boxes_of(contours)
        middle = (boxes[:, 0].min() + boxes[:, 2].max()) / 2
        return [mapped(one, lambda at: (at[0] + by * (at[0] > middle), at[1])) for one in contours], list(
            range(len(contours))
        )

    return edit


def replaced(contours: Sequence[Contour], random: Random) -> Edited:
    """A fifth of the contours are gone, as many others are there: other sizes, at other places, on the same layers."""
    boxes, _ = boxes_of(contours)
    (left, low), (right, high) = boxes[:, :2].min(0).tolist(), boxes[:, 2:].max(0).tolist()
    gone = set(random.sample(range(len(contours)), max(1, len(contours) // 5)))
    found: list[Contour] = []
    numbers: list[int | None] = []
    for number, one in enumerate(contours):
        if number not in gone:
            found.append(one)
            numbers.append(number)
            continue
        x, y = one.edges[0].start
        factor = random.choice((random.uniform(0.3, 0.8), random.uniform(1.25, 2.5)))
        u, v = random.uniform(left, right), random.uniform(low, high)
        edges = []
        for edge in one.edges:
            places = [(u + factor * (p - x), v + factor * (q - y)) for p, q in edge.points()]
            edges += [Edge(*ends, entity=edge.entity) for ends in pairwise(places)]
        found.append(replace(one, edges=tuple(edges)))
        numbers.append(None)
    return found, numbers


EDITS: dict[str, Callable[[Sequence[Contour], Random], Edited]] = {
    "as it was": lambda contours, _random: (list(contours), list(range(len(contours)))),
    "shuffled": shuffled,
    "1 µm of noise": noisy,
    "all moved": moved,
    "half of it stretched by 0.4 mm": stretched(0.4),
    "half of it stretched by 5 mm": stretched(5.0),
    "a fifth replaced": replaced,
}


@dataclass
class Count:
    """Numbers of contours: found right; lost, and reported; found wrong, but shown to be confirmed; found wrong in
    silence; `gone`: not in the drawing, so rightly lost."""

    right: int = 0
    lost: int = 0
    shown: int = 0
    wrong: int = 0
    gone: int = 0

    def __add__(self, other: Count) -> Count:
        return Count(*(one + more for one, more in zip(vars(self).values(), vars(other).values(), strict=True)))


def known(contours: Sequence[Contour]) -> Known:
    """Contours as they are looked for."""
    nesting = Nesting.of(contours)
    return Known(contours, [nesting.kind(at) for at in range(len(contours))])


def counted(drawn: Sequence[Contour], edit: str, are_together: bool = True, seed: int = 1) -> Count:
    """Look for all contours of a drawing after an edit, all at once or one by one."""
    before = known(drawn)
    contours, numbers = EDITS[edit](drawn, Random(seed))
    after = known(contours)
    chosen = [before.choose(at, Overrides()) for at in range(len(before.contours))]
    if are_together:
        found = after.find(chosen, before.box).found
    else:
        found = [after.find([one], before.box).found[0] for one in chosen]
    count = Count()
    there = set(numbers)
    for at, match in enumerate(found):
        if match.number is None:
            count += Count(lost=1) if at in there else Count(gone=1)
        elif numbers[match.number] == at:
            count += Count(right=1)
        else:
            count += Count(shown=1) if match.is_doubtful else Count(wrong=1)
    return count


def drawn_in(paths: Sequence[Path]) -> Iterator[list[Contour]]:
    """The contours of some drawings; those that do not tell their units are read in mm, what is no drawing is not."""
    for path in paths:
        try:
            yield read(path.read_bytes(), path.name).contours
        except UserError:
            with suppress(UserError):
                yield read(path.read_bytes(), path.name, ReadOptions(units="mm")).contours


if __name__ == "__main__":
    files = [
        path
        for folder in sys.argv[1:]
        for path in sorted(Path(folder).rglob("*"))
        if path.suffix.lower() in (".dxf", ".svg")
    ]
    drawings = list(drawn_in(files))
    print(f"{len(drawings)} drawings, {sum(map(len, drawings))} contours: right lost shown wrong gone")
    for edit in EDITS:
        for are_together in (True, False):
            total = sum((counted(one, edit, are_together) for one in drawings), Count())
            print(f"{edit}, {'together' if are_together else 'one by one'}:", *vars(total).values())
