"""An entity of a DXF file as it stands there: groups of a code and a text."""

from __future__ import annotations

import re

from skg.geometry.plane import XY

#: A group: its code and its value as text.
Group = tuple[int, str]


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
