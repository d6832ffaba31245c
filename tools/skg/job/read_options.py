"""Options for reading a drawing."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches

from skg.errors import UserError
from skg.messages.finding import Finding, Phrase

#: mm in one unit of a file.
UNITS = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "inch": 25.4, "foot": 304.8, "mil": 0.0254, "um": 0.001}
#: Ends no further apart meet, and go to their middle, mm; no end is moved by more.
MEET = 0.005
#: Settings for open contours; "all" cuts lines at junctions as well.
OPEN = ("cut", "leave", "refuse", "all")
#: Reasons for leaving a layer: not among those asked for, or not seen.
_NOT_ASKED = Phrase("reason-not-asked")
_HIDDEN = {"off": Phrase("reason-layer-off"), "frozen": Phrase("reason-layer-frozen")}
#: The layer whose points are start holes, where no other one is asked for.
START = "START"


@dataclass(frozen=True)
class ReadOptions:
    """Options for reading a drawing.

    `layers`: only these (none: all that are neither off nor frozen). `start_layer`: that of the start holes. `units`:
    one of `UNITS`, None: what the file says. `tolerance`: ends no further apart are one corner, mm. `fit_tolerance`:
    how near FIT shall come to splines and ellipses, mm. `open`: one of `OPEN`, what becomes of open contours, None: not
    chosen. `encoding`: of a DXF file's text, None: what the file says, else guessed. `bridges`: lines that are put in
    between two ends, x and y of each, mm. `corners`: pairs of ends that go to where they cross; `strays`: places on
    open lines that are left.
    """

    layers: tuple[str, ...] = ()
    start_layer: str = START
    units: str | None = None
    tolerance: float = MEET
    fit_tolerance: float = 0.0002
    open: str | None = "cut"
    encoding: str | None = None
    bridges: tuple[tuple[float, float, float, float], ...] = ()
    corners: tuple[tuple[float, float, float, float], ...] = ()
    strays: tuple[tuple[float, float], ...] = ()

    def check_layers(self, known: Iterable[str]) -> None:
        """Refuse (`UserError`) a layer that a drawing with these does not have."""
        names = {name.lower(): name for name in known}
        for layer in self.layers:
            if layer.lower() not in names:
                known_layers = tuple(sorted(names.values())) or Phrase("layers-none")
                for name in get_close_matches(layer.lower(), names, 1):
                    raise UserError(Finding("layer-unknown-near", layer=layer, near=names[name], layers=known_layers))
                raise UserError(Finding("layer-unknown", layer=layer, layers=known_layers))

    def is_start(self, layer: str) -> bool:
        """Tell whether a layer is that of the start holes."""
        return layer.lower() == self.start_layer.lower()

    def unwanted(self, layer: str, state: str = "") -> Phrase | None:
        """Return the reason why a layer is not cut; None when it is. `state`: "off" or "frozen" for one that is not
        seen."""
        if self.layers:
            is_asked = self.is_start(layer) or layer.lower() in map(str.lower, self.layers)
            return None if is_asked else _NOT_ASKED
        if layer.lower() == "defpoints":
            return Phrase("reason-never-plotted")
        return _HIDDEN.get(state)

    @staticmethod
    def is_hidden(reason: Phrase | None) -> bool:
        """Tell whether a reason is that its layer is off or frozen."""
        return reason in _HIDDEN.values()

    @staticmethod
    def is_by_layer(reason: Phrase | None) -> bool:
        """Tell whether a reason of `unwanted` is that its layer is not asked for, or not seen: what it shows is
        there."""
        return reason == _NOT_ASKED or reason in _HIDDEN.values()
