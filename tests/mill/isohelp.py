"""An ISO tape of milling.md, read here by its own rules: what a machine would do, in whole micrometres."""

from __future__ import annotations

import re
from dataclasses import dataclass
from decimal import Decimal

WORD = re.compile(r"([NGXYZIJPFSTM])(-?\d+(?:\.\d+)?)")
ORDER = "NGXYZIJPFSTM"
#: A coordinate as it must be written.
COORDINATE = re.compile(r"-?(0|[1-9]\d*)(\.\d{0,2}[1-9])?")
LONGEST = 70


@dataclass(frozen=True)
class Move:
    """A block that moves: G0…G3, where to (x, y, z; None: not known yet), the centre of an arc, the feed of a cut."""

    g: int
    end: tuple[int | None, int | None, int | None]
    centre: tuple[int, int] | None = None
    feed: float | None = None

    @property
    def place(self) -> tuple[int | None, int | None]:
        """The end point in the plane."""
        return self.end[:2]


def words(block: str) -> list[tuple[str, str]]:
    """The words of a block, which must be nothing else, in the order of milling.md (the first block has many G)."""
    found = WORD.findall(block)
    assert "".join(map("".join, found)) == block, block
    letters = "".join(letter for letter, _ in found)
    assert [ORDER.index(letter) for letter in letters] == sorted(ORDER.index(letter) for letter in letters), block
    assert len(block) <= LONGEST, block
    for letter, number in found:
        if letter in "XYZIJ":
            assert COORDINATE.fullmatch(number) and number != "-0", block
    return found


def um(number: str) -> int:
    """A coordinate in µm."""
    value = Decimal(number) * 1000
    assert value == int(value)
    return int(value)


def blocks(tape: bytes, line_end: str = "\r\n") -> list[str]:
    """The blocks of a tape without their N words, which must count from 1 anew behind each M30."""
    lines = tape.decode("ascii").split(line_end)
    assert lines.pop() == ""
    bare, expected = [], 1
    for line in lines:
        number = re.match(r"N(\d+)", line)
        assert number and int(number[1]) == expected, (line, expected)
        bare.append(line[number.end() :])
        assert (expected == 1) == (bare[-1] == "G17G21G90G94"), line
        expected = 1 if bare[-1] == "M30" else expected % 9999 + 1
    return bare


def moves(tape: bytes, line_end: str = "\r\n") -> list[Move]:
    """The moves of a tape, each checked by the rules of its blocks."""
    x = y = z = feed = None
    found: list[Move] = []
    for block in blocks(tape, line_end):
        if block in ("G17G21G90G94", "M30"):
            x = y = z = feed = None
            continue
        values = dict(words(block))
        assert len(values) == len(words(block)), block
        g = values.get("G")
        if g not in ("0", "1", "2", "3"):
            assert not set(values) & set("XYZIJF"), block
            continue
        assert not set(values) & set("NPSTM"), block
        before = x, y, z
        if "Z" in values:
            assert g in "01" and not set(values) & set("XYIJ"), block
            z = um(values["Z"])
        else:
            assert {"X", "Y"} <= set(values), block
            x, y = um(values["X"]), um(values["Y"])
        assert ("I" in values) == ("J" in values) == (g in "23"), block
        centre = (before[0] + um(values["I"]), before[1] + um(values["J"])) if g in "23" else None
        assert (x, y, z) != before or centre, f"{block} moves nothing"
        if "F" in values:
            assert g != "0" and values["F"] != feed, block
            feed = values["F"]
        assert g == "0" or feed, f"{block} cuts without F"
        found.append(Move(int(g), (x, y, z), centre, None if g == "0" else float(feed)))
    return found
