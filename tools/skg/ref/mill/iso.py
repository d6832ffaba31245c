"""The ISO tape of a milling machine, made from true places in integer arithmetic (milling.md)."""

from __future__ import annotations

from dataclasses import dataclass

from skg.ref import near, real
from skg.ref.fault import Code, Fault
from skg.ref.real import Real
from skg.ref.tape import TOO_LONG, Grid, Punch, full_turns, grid
from skg.ref.values import Point

#: After this block's number comes 1.
LAST_NUMBER = 9999
#: The first block: plane XY, millimetres, absolute places, feed in mm/min.
PREAMBLE = "G17G21G90G94"
#: The travel height before a Z says another, µm.
TRAVEL = 5000
#: Smallest number of the words F, P and S; the largest has 8 digits.
SMALLEST = Real("0.001")


def millimetres(micrometres: int) -> str:
    """A coordinate as its word has it: at most 3 decimals, no trailing zeros; error 10 for 100 m or more."""
    size = abs(micrometres)
    if size >= TOO_LONG:
        raise Fault(Code.TAPE)
    decimals = f"{size % 1000:03d}".rstrip("0")
    return f"{'-' * (micrometres < 0)}{size // 1000}{'.' * bool(decimals)}{decimals}"


def decimal(value: Real) -> str:
    """The number of an F, P or S word, as PRINT writes it; error 5 outside 0.001…99999999."""
    if value > 0:
        digits = value * Real(10) ** (7 - int(real.mp.floor(real.mp.log10(value))))
        near.note("decimal", digits - real.mp.floor(digits) - Real("0.5"), 0.25)
    text = real.show(value)
    if "E" in text or Real(text) < SMALLEST:
        raise Fault(Code.RANGE)
    return text


def pair(first: str, second: str, values: Grid) -> str:
    """Two words, such as X and Y."""
    return f"{first}{millimetres(values[0])}{second}{millimetres(values[1])}"


@dataclass
class IsoPunch(Punch):
    """Blocks in the order of punching, and what the board knows of the machine.

    `tool` and `height` (whole µm) are where the tool is, None where that is not known; `cutting` and `travel` the
    heights of Z, `feed` and `down` those of F (None: no such statement yet); `punched` is the last F on the tape.
    """

    line_end: str = "\r\n"
    tool: Grid | None = None
    height: int | None = None
    cutting: int | None = None
    travel: int = TRAVEL
    feed: Real | None = None
    down: Real | None = None
    punched: Real | None = None
    number: int = 0

    def reset(self) -> None:
        """Set the state that RUN begins with: no F, no Z, a new tape."""
        self.cutting, self.travel = None, TRAVEL
        self.feed = self.down = None
        self._begin()

    def _begin(self) -> None:
        """A new tape: nothing is known of the machine, and its first block will be number 1."""
        self.tool = self.height = self.punched = None
        self.number = 0

    def block(self, words: str) -> None:
        """A block; in front of a tape's first one what every tape begins with."""
        if self.number == 0:
            self._punch(PREAMBLE)
        self._punch(words)

    def _punch(self, words: str) -> None:
        self.number = self.number % LAST_NUMBER + 1
        self.lines.append(f"N{self.number}{words}")

    # Moves ----------------------------------------------------------------------------------------------

    def up(self) -> None:
        """Rapid to the travel height, once there has been a Z."""
        if self.cutting is not None and self.height != self.travel:
            self.block(f"G0Z{millimetres(self.travel)}")
            self.height = self.travel

    def rapid(self, p: Point) -> None:
        """At the travel height to a place."""
        self.up()
        end = grid(p)
        if self.tool != end:
            self.block(f"G0{pair('X', 'Y', end)}")
            self.tool = end

    def lower(self) -> None:
        """Down to the cutting height, once there has been a Z."""
        if self.cutting is not None and self.height != self.cutting:
            self._cut(f"G1Z{millimetres(self.cutting)}", self.down)
            self.height = self.cutting

    def _cut(self, words: str, feed: Real | None) -> None:
        """A block that cuts; with an F where that differs from the last one."""
        assert feed is not None, "no route is entered and no hole drilled without an F"
        if self.punched is None or not real.nearly_equal(feed, self.punched):
            words += f"F{decimal(feed)}"
        self.block(words)
        self.punched = feed

    def _line(self, end: Grid) -> None:
        if end != self.tool:
            self._cut(f"G1{pair('X', 'Y', end)}", self.feed)
            self.tool = end

    def arc(self, end: Point, centre: Point, clockwise: bool, sweep: Real) -> None:
        """An arc of a true sweep in radians, as a control will understand it (milling.md, section "Arcs")."""
        last, middle, here = grid(end), grid(centre), self.tool
        assert here is not None, "a route is entered from its FROM point"
        to_centre = middle[0] - here[0], middle[1] - here[1]
        for length in to_centre:
            millimetres(length)
        if last == here:
            near.note("sweep", sweep - real.mp.pi, 1e-6)
            if sweep > real.mp.pi and to_centre != (0, 0):
                self._arc(last, to_centre, clockwise)
            return
        dx, dy = last[0] - here[0], last[1] - here[1]
        chord, square = dx * dx + dy * dy, to_centre[0] ** 2 + to_centre[1] ** 2
        if sweep <= real.mp.pi:
            near.note("flat arc", chord * chord / (4 * square or 1) - 1, 1e-9)
        # The arc's image about the X axis where it is clockwise: its ends relative to the centre.
        sense = -1 if clockwise else 1
        turns = full_turns(
            (-to_centre[0], -sense * to_centre[1]),
            (dx - to_centre[0], sense * (dy - to_centre[1])),
            sweep,
        )
        if turns is None or (sweep <= real.mp.pi and chord * chord <= 4 * square):
            self._line(last)
        else:
            self._arc(last, to_centre, clockwise)

    def _arc(self, end: Grid, to_centre: Grid, clockwise: bool) -> None:
        self._cut(f"G{2 if clockwise else 3}{pair('X', 'Y', end)}{pair('I', 'J', to_centre)}", self.feed)
        self.tool = end

    # Stops ----------------------------------------------------------------------------------------------

    def stop(self) -> None:
        """`M0`: the machine stops."""
        self.block("M0")

    def end(self) -> None:
        """`M30`: end of the tape."""
        self.block("M30")
        self._begin()

    def bytes(self) -> bytes:
        """The tape as it is punched."""
        return "".join(line + self.line_end for line in self.lines).encode("ascii")
