"""An entity of a DXF file as it stands there: groups of a code and a text."""

from __future__ import annotations

import re
from itertools import takewhile
from math import nan

from skg.geometry.plane import XY
from skg.messages.finding import Phrase

#: A group: its code and its value as text.
Group = tuple[int, str]


_CENTRE = {10: Phrase("of-centre", side="x"), 20: Phrase("of-centre", side="y")}
_PLACE = {10: Phrase("of-place", side="x"), 20: Phrase("of-place", side="y")}
#: The codes that an entity of a kind must have, and what each tells: nothing of it is invented. (The DXF reference has
#: defaults for what is not here.)
NEEDED: dict[str, dict[int, Phrase]] = {
    "LINE": {
        10: Phrase("of-start", side="x"), 20: Phrase("of-start", side="y"),
        11: Phrase("of-end", side="x"), 21: Phrase("of-end", side="y"),
    },
    "CIRCLE": {**_CENTRE, 40: Phrase("its-radius")},
    "ARC": {**_CENTRE, 40: Phrase("its-radius"), 50: Phrase("its-first-angle"), 51: Phrase("its-last-angle")},
    "ELLIPSE": {
        **_CENTRE, 11: Phrase("of-axis", side="x"), 21: Phrase("of-axis", side="y"),
        40: Phrase("its-ratio"), 41: Phrase("its-first-parameter"), 42: Phrase("its-last-parameter"),
    },
    "SPLINE": {71: Phrase("its-degree")},
    "HELIX": {71: Phrase("its-degree")},
    "LWPOLYLINE": {10: Phrase("a-vertex"), 20: Phrase("of-vertex", side="y")},
    "VERTEX": {10: Phrase("of-vertex", side="x"), 20: Phrase("of-vertex", side="y")},
    "MLINE": {11: Phrase("a-vertex"), 21: Phrase("of-vertex", side="y")},
    "POINT": _PLACE,
    "INSERT": {2: Phrase("its-block-name"), **_PLACE},
}  # fmt: skip
NEEDED["3DLINE"] = NEEDED["LINE"]
#: Codes of counts, of the values that they count, and what these are. (A count may be left out)
_COUNTED = {
    "LWPOLYLINE": ((90, 10, Phrase("vertices")),),
    "MLINE": ((72, 11, Phrase("vertices")),),
    **dict.fromkeys(
        ("SPLINE", "HELIX"),
        ((72, 40, Phrase("knots")), (73, 10, Phrase("control-points")), (74, 11, Phrase("fit-points"))),
    ),
}
#: Codes of angles; one larger than this has no direction left in a float.
_ANGLES, _MOST_ANGLE = {"ARC": (50, 51), "ELLIPSE": (41, 42), "INSERT": (50,)}, 1e6
#: An entity of fewer groups has few vertices.
_LONG = 1000
#: The third subclass of a helix: its codes mean other things than those of the second.
_THIRD = "AcDbHelix"

#: A character by its number, as files write it whose code page does not have it. (Half of a pair of UTF-16 is none)
_NUMBERED = re.compile(r"\\U\+((?![Dd][89A-Fa-f])[0-9A-Fa-f]{4})")


def unescaped(name: str) -> str:
    """A name with the characters that a file tells by their numbers."""
    return _NUMBERED.sub(lambda match: chr(int(match[1], 16)), name) if "\\U+" in name else name


class Record:
    """An entity as it stands in the file, with those that follow it as its parts. `kind`: its name, such as LINE."""

    __slots__ = ("groups", "parts", "kind", "first")

    def __init__(self, groups: list[Group]) -> None:
        self.groups = groups
        self.parts: list[Record] = []
        self.kind = groups[0][1].strip().upper()
        self.first = dict(reversed(groups))

    def value(self, code: int, default: str = "") -> str:
        """The first value with a code."""
        return self.first.get(code, default)

    def whole(self, code: int) -> int:
        """The first value with a code as a whole number, 0 when there is none."""
        try:
            return int(float(self.value(code, "0")))
        except (ValueError, OverflowError):
            return 0

    def count(self, code: int) -> int:
        """Number of its values with a code; of a helix those of its spline."""
        own = takewhile(lambda group: group[0] != 100 or group[1].strip() != _THIRD, self.groups)
        return sum(known == code for known, _ in own)

    @property
    def vertices(self) -> int:
        """Number of its places, those of its parts included."""
        return len(self.parts) + (self.count(10) if len(self.groups) > _LONG else 1)

    def lack(self) -> Phrase | None:
        """Return what its kind must have and it has not; None when it is whole."""
        for code, noun in NEEDED.get(self.kind, {}).items():
            if code not in self.first:
                return Phrase("lack-missing", what=noun, number=code)
        for code, counted, nouns in _COUNTED.get(self.kind, ()):
            if code in self.first and self.whole(code) != (has := self.count(counted)):
                return Phrase("lack-counted", has=has, told=self.whole(code), what=nouns)
        if self.kind == "LWPOLYLINE" and self.count(10) != self.count(20):
            return Phrase("lack-sides", x=self.count(10), y=self.count(20))
        if self.kind in ("SPLINE", "HELIX"):
            return self._lack_of_spline()
        if self.kind in ("CIRCLE", "ARC") and self.value(40).strip().startswith("-") and self.real(40) < 0:
            return Phrase("lack-radius", radius=self.real(40))
        for code in _ANGLES.get(self.kind, ()):
            if abs(self.real(code)) > _MOST_ANGLE:
                return Phrase("lack-angle", angle=self.value(code).strip())
        if self.kind == "POLYLINE":
            if not self.parts or self.parts[-1].kind != "SEQEND":
                return Phrase("lack-end")
            return next(filter(None, (part.lack() for part in self.parts)), None)
        return None

    def _lack_of_spline(self) -> Phrase | None:
        """The same of a spline's knots: they are not made up."""
        controls, knots, degree = self.count(10), self.count(40), self.whole(71)
        if not controls and not self.count(11):
            return Phrase("lack-points")
        if degree < 1:
            return Phrase("lack-degree", degree=degree)
        if controls and knots != (needed := controls + degree + 1):
            return Phrase("lack-knots", knots=knots, controls=controls, degree=degree, needed=needed)
        if self.count(41) not in (0, controls):
            return Phrase("lack-weights", weights=self.count(41), controls=controls)
        return None

    def real(self, code: int) -> float:
        """The first value with a code as a number, NaN when it is none."""
        try:
            return float(self.value(code, "nan"))
        except ValueError:
            return nan

    @property
    def layer(self) -> str:
        """The name of its layer."""
        return unescaped(self.value(8).strip()) or "0"

    @property
    def place(self) -> XY:
        """The first place that it tells, as it stands there."""
        if self.kind == "POLYLINE" and self.parts:
            # (its own place is no more than a height)
            return self.parts[0].place
        try:
            return float(self.value(10, "0")), float(self.value(20, "0"))
        except ValueError:
            return 0.0, 0.0
