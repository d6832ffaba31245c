"""The placement of a drawing on the machine: mirrored, turned, scaled and moved; and the way back."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import atan2, cos, radians, sin

import numpy as np

from skg.geometry.arrays import Floats
from skg.geometry.contour import Contour, CurveNode, Edge
from skg.geometry.plane import XY

#: The cosines and sines of quarters of a turn, exactly.
_QUARTERS = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))


@dataclass(frozen=True)
class Placement:
    """A similarity: a place p goes to M·(p − `origin`) + `at`, mm. `matrix`: the rows of M, one after the other."""

    matrix: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 1.0)
    origin: XY = (0.0, 0.0)
    at: XY = (0.0, 0.0)

    @classmethod
    def of(cls, turn: float = 0.0, mirror: str | None = None, scale: float = 1.0) -> Placement:
        """About the drawing's zero: mirrored ("x": left and right change sides, "y": above and below), then turned by
        some degrees (exactly by quarters of a turn), then scaled."""
        quarters, rest = divmod(turn % 360.0, 90.0)
        angle = radians(turn % 360.0)
        c, s = _QUARTERS[int(quarters) % 4] if not rest else (cos(angle), sin(angle))
        x, y = -1.0 if mirror == "x" else 1.0, -1.0 if mirror == "y" else 1.0
        # (+ 0.0: no zero with a sign)
        return cls((scale * c * x + 0.0, -scale * s * y + 0.0, scale * s * x + 0.0, scale * c * y + 0.0))

    @cached_property
    def _determinant(self) -> float:
        a, b, c, d = self.matrix
        return a * d - b * c

    @property
    def is_mirror(self) -> bool:
        """Tell whether what runs counter-clockwise runs clockwise then."""
        return self._determinant < 0

    @cached_property
    def is_nothing(self) -> bool:
        """Tell whether every place stays where it is."""
        return self.matrix == (1.0, 0.0, 0.0, 1.0) and self.origin == self.at

    @cached_property
    def scale(self) -> float:
        """The factor of lengths."""
        a, _, c, _ = self.matrix
        return abs(a or c) if not (a and c) else abs(self._determinant) ** 0.5

    @cached_property
    def back(self) -> Placement:
        """The way back."""
        a, b, c, d = self.matrix
        if self.scale == 1:
            # (a turn's inverse is its transpose, to the last bit)
            return Placement((a, c, b, d), self.at, self.origin)
        size = self._determinant
        inverse = (d / size + 0.0, -b / size + 0.0, -c / size + 0.0, a / size + 0.0)
        return Placement(inverse, self.at, self.origin)

    def place(self, place: XY) -> XY:
        """A place."""
        a, b, c, d = self.matrix
        x, y = place[0] - self.origin[0], place[1] - self.origin[1]
        return a * x + b * y + self.at[0], c * x + d * y + self.at[1]

    def places(self, places: Floats) -> Floats:
        """Places, a row of x and y for each."""
        return (places - self.origin) @ np.reshape(self.matrix, (2, 2)).T + self.at

    def direction(self, angle: float) -> float:
        """A direction angle, radians."""
        a, b, c, d = self.matrix
        x, y = cos(angle), sin(angle)
        return atan2(c * x + d * y, a * x + b * y)

    def edge(self, edge: Edge) -> Edge:
        """An edge, run through in its direction."""
        if self.is_nothing:
            return edge
        start = self.place(edge.start)
        samples = edge.samples
        if len(samples):
            samples = self.places(samples)
        return replace(
            edge,
            start=start,
            end=start if edge.end == edge.start else self.place(edge.end),
            centre=edge.centre and self.place(edge.centre),
            sweep=-edge.sweep if self.is_mirror else edge.sweep,
            nodes=tuple(CurveNode(self.place(node.point), self.direction(node.angle)) for node in edge.nodes),
            samples=samples,
        )

    def contour(self, contour: Contour) -> Contour:
        """A contour, run through in its direction."""
        if self.is_nothing:
            return contour
        return replace(contour, edges=tuple(map(self.edge, contour.edges)))
