"""Contours on the machine, copies too, brought back to where the file has them: by complex numbers, and not as they
were placed."""

from __future__ import annotations

from cmath import rect
from collections.abc import Callable
from dataclasses import replace
from math import radians

import numpy as np

from skg.geometry.contour import Contour, CurveNode, Edge
from skg.geometry.plane import XY
from skg.job.placing import Copies, Place


def as_drawn(contours: list[Contour], place: Place, origin: XY, copies: Copies, number: int) -> list[Contour]:
    """The contours of a copy, by its number, in the file's place and size. `origin`: the place of the drawing that is
    0, 0 on the machine, mm."""
    if place == Place() and not number:
        return contours
    turned = rect(place.scale, radians(place.turn))
    zero = complex(*origin)

    def mirrored(z: complex) -> complex:
        return {None: z, "x": complex(-z.real, z.imag), "y": complex(z.real, -z.imag)}[place.mirror]

    row, column = divmod(number, copies.columns)
    x, y = copies.step or (0.0, 0.0)
    moved, turn, centre = complex(column * x, row * y), 1 + 0j, 0j
    if copies.around > 1:
        moved, turn = 0j, rect(1.0, radians(number * copies.angle))
        centre = mirrored(complex(*(copies.about or origin)) - zero) * turned

    def back(z: complex) -> complex:
        return zero + mirrored((centre + (z - moved - centre) / turn) / turned)

    return [replace(contour, edges=tuple(_edge(edge, back, place) for edge in contour.edges)) for contour in contours]


def _edge(edge: Edge, back: Callable[[complex], complex], place: Place) -> Edge:
    def at(p: XY) -> XY:
        z = back(complex(*p))
        return z.real, z.imag

    samples = edge.samples
    if len(samples):
        samples = np.array([at(p) for p in samples.tolist()])
    return replace(
        edge,
        start=at(edge.start),
        end=at(edge.end),
        centre=edge.centre and at(edge.centre),
        sweep=-edge.sweep if place.mirror else edge.sweep,
        # (a curve is compared by its samples)
        nodes=tuple(CurveNode(at(node.point), 0.0) for node in edge.nodes),
        samples=samples,
    )
