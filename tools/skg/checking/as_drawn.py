"""Contours on the machine, brought back to where the file has them: by complex numbers, and not as they were placed."""

from __future__ import annotations

from cmath import rect
from collections.abc import Callable
from dataclasses import replace
from math import radians

import numpy as np

from skg.geometry.contour import Contour, CurveNode, Edge
from skg.geometry.plane import XY
from skg.job.placing import Place


def as_drawn(contours: list[Contour], place: Place, origin: XY) -> list[Contour]:
    """The contours in the file's place and size. `origin`: the place of the drawing that is 0, 0 on the machine, mm."""
    if place == Place():
        return contours
    turned = rect(1.0, -radians(place.turn)) / place.scale
    zero = complex(*origin)

    def back(z: complex) -> complex:
        z *= turned
        return zero + {None: z, "x": complex(-z.real, z.imag), "y": complex(z.real, -z.imag)}[place.mirror]

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
