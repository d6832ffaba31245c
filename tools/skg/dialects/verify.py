"""A program read back: its cuts lie on the path that it was written for (shapely)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np
import shapely

from skg.errors import UserError
from skg.geometry.chords import MEASURED, chords_of
from skg.geometry.piece import Piece
from skg.messages.finding import Finding
from skg.tape.dialect import GcodeDialect
from skg.tape.gcode_reader import read

#: Beside its rounding a cut lies no further from the path, mm: flat arcs become lines, circles get whole µm.
_NEAR = 0.0025


def refuse_other_path(text: str, name: str, dialect: GcodeDialect, path: Sequence[Piece]) -> None:
    """Read a program as its machine does; a `UserError` where its cuts are not the path (mm), or no program."""
    cuts = [piece for route in read(text, name, dialect).routes() if not route.is_move for piece in route.blocks]
    ours, theirs = _chords(path, 1.0), _chords(cuts, 0.001)
    limit = _NEAR + dialect.step / 1000
    for some, others in ((ours, theirs), (theirs, ours)):
        if not len(some):
            continue
        if not len(others):
            raise UserError(Finding("read-back-empty").within(name))
        points = shapely.points(shapely.get_coordinates(some))
        (index, _), far = shapely.STRtree(others).query_nearest(points, return_distance=True, all_matches=False)
        worst = int(np.argmax(far))
        if far[worst] > limit:
            (x, y) = shapely.get_coordinates(points[index[worst]])[0].tolist()
            raise UserError(Finding("read-back-off", off=float(far[worst]), place=(x, y)).within(name))


def _chords(pieces: Iterable[Piece], unit: float) -> np.ndarray:
    """Pieces as chords; `unit`: their millimetres."""
    lines = []
    for piece in pieces:
        count = 1 if piece.centre is None else chords_of(piece.radius * unit, piece.sweep, MEASURED)
        places = [piece.start, *(piece.at(part / count) for part in range(1, count)), piece.end]
        lines += [(start, end) for start, end in pairwise(places) if start != end]
    return shapely.linestrings(np.array(lines, float).reshape(-1, 2, 2) * unit)
