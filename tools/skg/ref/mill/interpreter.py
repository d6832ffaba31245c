"""Programs of a milling machine: what the added statements do."""

from __future__ import annotations

from collections.abc import Iterable

from skg.ref import interpreter, real
from skg.ref.fault import Code, Fault
from skg.ref.mill.cutter import MillCutter
from skg.ref.mill.iso import IsoPunch, decimal
from skg.ref.mill.statements import MILL, Feed, Heights, Hole, Miscellaneous, Preparatory
from skg.ref.statements import Expression, Statement
from skg.ref.tape import micrometres

#: The largest number of an M, a G and a T word.
LARGEST = 99
#: M words of END; G words of the tape's own blocks; those with a move of their own (threads, probing, canned cycles).
ENDS = {2, 30}
OWN = {0, 1, 2, 3, 17, 18, 19, 20, 21, 40, 41, 42, 90, 91, 93, 95}
CYCLES = {33, 38, *range(73, 90)}
#: The M word for a tool change.
TOOL_CHANGE = 6


class MillInterpreter(interpreter.Interpreter):
    """One machine with a mill behind its punch."""

    dialect = MILL
    tape: IsoPunch
    cutter: MillCutter

    def _clear(self) -> None:
        super()._clear()
        self.tape.reset()

    def _new_cutter(self) -> MillCutter:
        return MillCutter(self.tape, self.path)

    def _execute(self, s: Statement | Feed | Heights | Miscellaneous | Preparatory | Hole) -> None:
        match s:
            case Feed(plane, down):
                feed = self._positive(plane)
                self.tape.feed, self.tape.down = feed, feed if down is None else self._positive(down)
            case Heights(cutting, travel):
                low = micrometres(self.number(cutting))
                high = self.tape.travel if travel is None else micrometres(self.number(travel))
                if high < low:
                    raise Fault(Code.RANGE)
                self.cutter.refuse_in_route()
                self.tape.cutting, self.tape.travel = low, high
            case Miscellaneous(number, value):
                self._miscellaneous(number, value)
            case Preparatory(number, value):
                n = self._word_number(number, OWN | CYCLES)
                words = f"G{n}" + ("" if value is None else f"P{decimal(self.number(value))}")
                self.cutter.refuse_in_route()
                self.tape.block(words)
            case Hole(points):
                for point in points:
                    self.cutter.drill(self._expect(point, "P"))
            case _:
                super()._execute(s)

    def _positive(self, e: Expression) -> real.Real:
        """A feed: error 5 unless the word F can have it."""
        feed = self.number(e)
        decimal(feed)
        return feed

    def _word_number(self, e: Expression, others: frozenset[int] | set[int] = frozenset()) -> int:
        """The number of an M, G or T word, written out; error 5 where it is none, or one that is not the user's."""
        n = real.whole(self.number(e))
        if not 0 <= n <= LARGEST or n in others:
            raise Fault(Code.RANGE)
        return n

    def _miscellaneous(self, number: Expression, value: Expression | None) -> None:
        n = self._word_number(number, ENDS)
        words = ""
        if value is not None:
            words = f"T{self._word_number(value)}" if n == TOOL_CHANGE else f"S{decimal(self.number(value))}"
        self.cutter.refuse_in_route()
        self.tape.block(f"{words}M{n}")


def run(
    source: str,
    inputs: Iterable[str] = (),
    bits: int | None = None,
    line_end: str = "\r\n",
    patience: int | None = None,
    runs: bool = True,
) -> interpreter.Result:
    """Load a program and RUN it as the milling machine's ROM does; as `skg.ref.run` but for the tape.

    `line_end`: what ends a block, LF alone where the machine answers each (milling.md, section "Handshake").
    """
    return interpreter.carry_out(
        lambda watch: MillInterpreter(inputs, watch, IsoPunch(line_end=line_end), patience), source, bits, runs
    )
