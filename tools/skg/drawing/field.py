"""What lies around a place of a drawing: contours by their boxes, then by their chords (numpy)."""

from __future__ import annotations

from functools import cache
from math import cos, inf, sin

import numpy as np
from numpy.typing import NDArray

from skg.drawing.contour import Contour
from skg.plane import XY


class Field:
    """All contours of a drawing, mm."""

    def __init__(self, contours: list[Contour]) -> None:
        self.contours = contours
        self._chords = cache(self._make_chords)
        boxes = [(*chords.min(0), *chords.max(0)) for chords in map(self._ends, range(len(contours)))]
        self.low_x, self.low_y, self.high_x, self.high_y = np.array(boxes, float).reshape(-1, 4).T

    def _make_chords(self, at: int) -> NDArray[np.float64]:
        points = np.array(self.contours[at].points(), float)
        return np.hstack((points[:-1], points[1:]))

    def _ends(self, at: int) -> NDArray[np.float64]:
        return self._chords(at).reshape(-1, 2)

    def near(self, low: XY, high: XY) -> NDArray[np.intp]:
        """The numbers of the contours whose boxes meet a box."""
        meets = (self.low_x <= high[0]) & (self.high_x >= low[0]) & (self.low_y <= high[1]) & (self.high_y >= low[1])
        return np.flatnonzero(meets)

    def chords(self, low: XY, high: XY) -> NDArray[np.float64]:
        """The chords (x, y, x, y) of the contours whose boxes meet a box."""
        found = [self._chords(int(at)) for at in self.near(low, high)]
        return np.vstack(found) if found else np.empty((0, 4))

    def depths(self) -> list[int]:
        """How many closed contours lie around each."""
        closed = np.array([contour.is_closed for contour in self.contours], bool)
        found = []
        for at, contour in enumerate(self.contours):
            x, y = contour.edges[0].start
            around = closed & (self.low_x <= x) & (self.high_x >= x) & (self.low_y <= y) & (self.high_y >= y)
            around[at] = False
            found.append(sum(self._holds(int(other), x, y) for other in np.flatnonzero(around)))
        return found

    def _holds(self, at: int, x: float, y: float) -> bool:
        """Whether a place lies inside a closed contour (counts crossings of a ray to the right)."""
        x1, y1, x2, y2 = self._chords(at).T
        crosses = (y1 > y) != (y2 > y)
        x1, y1, x2, y2 = x1[crosses], y1[crosses], x2[crosses], y2[crosses]
        return bool(np.count_nonzero(x < x1 + (y - y1) / (y2 - y1) * (x2 - x1)) % 2)

    def distance(self, place: XY, reach: float) -> float:
        """From a place to the nearest contour, mm; infinite when that is more than `reach`."""
        x, y = place
        chords = self.chords((x - reach, y - reach), (x + reach, y + reach))
        if not len(chords):
            return inf
        start, way = chords[:, :2], chords[:, 2:] - chords[:, :2]
        to = np.array(place) - start
        square = np.maximum((way**2).sum(1), 1e-300)
        part = np.clip((to * way).sum(1) / square, 0, 1)
        nearest = float(np.sqrt(((to - part[:, None] * way) ** 2).sum(1).min()))
        return nearest if nearest <= reach else inf

    def way(self, place: XY, angle: float, reach: float, least: float) -> float:
        """How far it is from a place in a direction (radians) to the next contour, mm.

        What is nearer than `least` is none; infinite when nothing stands in the way up to `reach`.
        """
        x, y = place
        along = np.array((cos(angle), sin(angle)))
        u, v = x + reach * along[0], y + reach * along[1]
        chords = self.chords((min(x, u), min(y, v)), (max(x, u), max(y, v)))
        if not len(chords):
            return inf
        side = chords[:, 2:] - chords[:, :2]
        area = along[0] * side[:, 1] - along[1] * side[:, 0]
        to = chords[:, :2] - np.array(place)
        with np.errstate(divide="ignore", invalid="ignore"):
            far = (to[:, 0] * side[:, 1] - to[:, 1] * side[:, 0]) / area
            part = (to[:, 0] * along[1] - to[:, 1] * along[0]) / area
        hits = far[(np.abs(area) > 1e-12) & (far > least) & (far <= reach) & (part >= 0) & (part <= 1)]
        return float(hits.min()) if len(hits) else inf
