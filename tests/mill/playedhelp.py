"""The board whose blocks wait, and a machine at its punch that a test plays: in one process, block by block.

played = Played(program)
paper = played.driven("RUN", lambda block, number: b"ok\\r\\n")
assert played.blocks == [...]
"""

from __future__ import annotations

from collections.abc import Callable

from romhelp import Board

from skg.board import BoardStopped

IMAGE = "skg-grbl"
OK = b"ok\r\n"
#: What a machine says to a block (without its line end) and its number from 1; nothing: it is silent.
Answer = Callable[[str, int], bytes]
#: 8080 cycles between two looks at the board: a fraction of what a block takes.
SLICE = 20_000
#: A board that has asked its reader in vain for so long waits for the machine.
SILENCE = 50_000


def always(_block: str, _number: int) -> bytes:
    return OK


class Waiting(Board):
    """A board with a machine at its punch; `answer` is what that says to each block."""

    answer: Answer = staticmethod(always)
    _heard = 0

    @property
    def blocks(self) -> list[str]:
        """The lines that the machine has received, without their ends."""
        return self.tape.decode("ascii").split("\n")[:-1]

    def clear(self) -> None:
        super().clear()
        self._heard = 0

    def _until_asked(self) -> str:
        """No block may come before the one in front of it has been answered, but for the `M0` of an error."""
        end = self.machine.cycles + (self.max_cycles or 0)
        while self.machine.cycles < end:
            reason = self.machine.run(SLICE)
            new = self.blocks[self._heard :] if self.tape.endswith(b"\n") else []
            if new:
                assert len(new) == 1 or (len(new) == 2 and new[1].endswith("M0")), new
                self._heard += len(new)
                self.machine.tape(self.answer(new[0], self._heard))
            elif reason not in ("cycles", "wait"):
                return reason
            elif self.machine.reader_silence > SILENCE:
                return "wait"
        return "cycles"


class Played(Waiting):
    """A board with a program, and a machine that says something else now and then."""

    def __init__(self, program: str = "") -> None:
        super().__init__(48, IMAGE)
        assert not program or self.load(program) == []
        self.clear()

    def driven(self, line: str, answer: Answer = always) -> list[str] | None:
        """Type a line. Returns what is printed up to the next prompt; None when the board waits for the machine."""
        self.answer = answer
        try:
            return self.type(line)
        except BoardStopped as stopped:
            assert stopped.reason == "wait"
            return None

    def wait(self, answer: Answer = always) -> list[str] | None:
        """Go on, as `driven`; all the paper."""
        self.answer = answer
        return self._lines(0) if self._until_asked() == "prompt" else None
