"""Dialects of G-code: the words and lines that a machine's control wants. `skg.dialects` reads them from files."""

from __future__ import annotations

from dataclasses import dataclass, field

#: Units of numbers, in µm: millimetres, or whole micrometres.
UNITS = {"mm": 1000, "um": 1}
#: Places: from the origin, or from the end of the block before.
PLACES = ("absolute", "relative")
#: Arcs: their centre from their start, from the origin; or their radius.
ARCS = ("ij", "ij-absolute", "r")
#: Line ends.
LINE_ENDS = {"crlf": "\r\n", "lf": "\n"}

Lines = tuple[str, ...]


@dataclass(frozen=True)
class Compensation:
    """The offset in the control. `left`, `right`: lines that switch it on for the wire on that side of its way; `off`:
    off; `define`: a line for each offset, at the program's begin. {number} is its number, {offset} its length."""

    left: str
    right: str
    off: str
    define: str = ""


@dataclass(frozen=True)
class GcodeDialect:
    """The way a control wants its G-code.

    `unit`, `places`, `arcs`: one of `UNITS`, `PLACES`, `ARCS`; `decimals` of millimetres; `point`: whole numbers have a
    decimal point; `space` between words; `numbers`: blocks have N words. `rapid`, `line`, `clockwise`,
    `counterclockwise`: the motions; `feed`: the word with {feed}, empty: none. Lines: `head`; `start`: at the first
    start hole, {x} and {y}; without a {x} a rapid goes there first; `begin` and `end` of a cut; `unthread` before a
    positioning, `thread` behind it; `stop` for every other stop; `foot`.
    """

    title: str = "LinuxCNC, GRBL"
    source: str = ""
    tried: str = ""
    unit: str = "mm"
    decimals: int = 3
    point: bool = False
    places: str = "absolute"
    arcs: str = "ij"
    line_end: str = "crlf"
    numbers: bool = True
    space: bool = False
    rapid: str = "G0"
    line: str = "G1"
    clockwise: str = "G2"
    counterclockwise: str = "G3"
    feed: str = "F{feed}"
    head: Lines = ("G17G21G90G94",)
    start: Lines = ()
    begin: Lines = ()
    end: Lines = ()
    unthread: Lines = ("M0",)
    thread: Lines = ("M0",)
    stop: Lines = ("M0",)
    foot: Lines = ("M30",)
    compensation: Compensation | None = field(default=None)

    @property
    def step(self) -> int:
        """The smallest difference of two numbers, µm."""
        return 1 if self.unit == "um" else 10 ** (3 - self.decimals)

    def rounded(self, micrometres: int) -> int:
        """Whole µm as near as a number comes to them."""
        rest = (abs(micrometres) + self.step // 2) // self.step * self.step
        return -rest if micrometres < 0 else rest

    def length(self, micrometres: int) -> str:
        """Whole µm as a word has them: without zeros behind."""
        value = self.rounded(micrometres)
        if self.unit == "um":
            return str(value)
        sign, (whole, part) = "-" if value < 0 else "", divmod(abs(value), 1000)
        return f"{sign}{whole}.{part:03}".rstrip("0") if part else f"{sign}{whole}{'.' * self.point}"


#: The dialect of the milling ROM (milling.md, section "The tape"), which LinuxCNC and GRBL take as it is.
MILL = GcodeDialect()
