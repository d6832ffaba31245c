"""The drawing that is written of a tape, as ezdxf reads it."""

from __future__ import annotations

from collections.abc import Sequence
from io import StringIO

import ezdxf
from ezdxf.document import Drawing

from skg.geometry.plane import XY
from skg.pictures.dxf import write
from skg.tape.layout import PlacedRoute


def drawn(routes: list[PlacedRoute], stops: Sequence[XY], polylines: bool = False) -> Drawing:
    """The drawing of a tape that was laid out; `stops` are places in µm."""
    text = StringIO()
    write(text, routes, stops, polylines)
    return ezdxf.read(StringIO(text.getvalue()))
