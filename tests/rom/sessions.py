"""Random typed sessions: the operator's lines at the board, and at a model of what a session keeps.

The model is the reference's interpreter (docs/spec/language.md, sections 3 and 6), kept from line to line: the wire,
the start hole, whether anything was moved, the open or closed route, variables, the places of DATA and GOSUB, the
program. Errors end a line and not the session. Sessions are compared line by line: what is punched, what is printed.
The other images have theirs: those that mill with statements of milling.md thrown in, the driving one without TOL.

Behind a TAB a line has what the operator does while it works: `? 3`, an answer to INPUT (when none is left he breaks
in); `^C 2`, ctrl-C while the second block is punched, which is finished first.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from random import Random

from compare import same_line
from romhelp import BLOCK, Board

from skg.ref import real
from skg.ref.cutter import Cutter
from skg.ref.drift import DriftlessPunch
from skg.ref.fault import Code, Fault
from skg.ref.interpreter import Endless, Interpreter
from skg.ref.mill.interpreter import MillInterpreter
from skg.ref.mill.iso import IsoPunch
from skg.ref.near import Watch, watching
from skg.ref.parser import LineFault, parse_line
from skg.ref.route import Segment
from skg.ref.statements import Goto
from skg.ref.tape import Punch

#: Lines that a program may carry out before it counts as endless.
PATIENCE = 200
#: Cycles that a line may take on the board.
LIMIT = 200_000_000
#: Cycles between two looks at the punch: less than a block's numbers take.
SLICE = 4000
CTRL_C = 3
#: What switches a teletype's punch; a line that lists a block.
DEVICE = re.compile(r"[\x11-\x14]")
LISTED = re.compile(rf"{BLOCK.pattern}|N\d+[A-Z].*")
#: Memory enough for what SYM and REP make of a route.
RAM_KIB = 48
#: A program's lines.
NUMBERS = (10, 20, 30, 40, 50)


@dataclass
class Typed:
    """A line of a session, answers to its INPUTs, and the block (from 1) at which the operator breaks in; 0: none."""

    text: str
    answers: Iterator[str] = field(default_factory=lambda: iter(()))
    block: int = 0

    @classmethod
    def of(cls, line: str) -> Typed:
        """A session's line."""
        text, *more = line.split("\t")
        block = next((int(what[3:]) for what in more if what[0] == "^"), 0)
        return cls(text, iter([what[2:] for what in more if what[0] == "?"]), block)


def blocks(lines: Sequence[str]) -> int:
    """Blocks among the lines of a tape, stops left out."""
    return sum(line.startswith("B") for line in lines)


@dataclass
class Tape(Punch):
    """A tape, and how many blocks are on it when the operator breaks in; 0: he does not."""

    last: int = 0


class Breakable(Cutter):
    """The wire: a break ends the statement behind the block."""

    tape: Tape

    def _emit(self, segment: Segment) -> None:
        before = len(self.tape.lines)
        super()._emit(segment)
        if before < len(self.tape.lines) and blocks(self.tape.lines) == self.tape.last:
            raise Fault(Code.TAPE)


@dataclass
class DriftlessTape(DriftlessPunch):
    """The same whose blocks start where the controller stands."""

    last: int = 0


@dataclass
class MillTape(IsoPunch):
    """A milling tape; nobody breaks in."""

    last: int = 0


class Prompt(Interpreter):
    """A machine at its prompt."""

    tape: Tape | DriftlessTape | MillTape

    def typed(self, line: str) -> tuple[bytes, list[str]]:
        """Carry out a line: what is punched and printed, a refused line's own text and mark left out."""
        typed = Typed.of(line)
        tape, paper = len(self.tape.bytes()), len(self.paper)
        self.answers = typed.answers
        self.tape.last = blocks(self.tape.lines) + typed.block if typed.block else 0
        self._carry_out(typed.text)
        printed = [row for text in self.paper[paper:] for row in text.split("\n") if row not in ("", "? ")]
        return self.tape.bytes()[tape:], printed

    def _carry_out(self, line: str) -> None:
        if line == "NEW":
            self.program.clear()
            self._clear()
        elif command := re.fullmatch(r"RUN(?: (\d+))?", line):
            self._command(int(command[1]) if command[1] else None)
        else:
            self._line(line)

    def _command(self, first: int | None) -> None:
        """RUN, from a line: one that is not there clears nothing."""
        if first is not None and first not in self.program:
            self.watch.line = None
            self._fail(Code.LINE)
            return
        self._clear()
        self._run_from(None if first is None else Goto(first))

    def _line(self, line: str) -> None:
        """A line of the program, or a direct statement."""
        try:
            parsed = parse_line(line, self.dialect)
        except LineFault as fault:
            # (a line that is not understood does nothing: an open route stays open)
            self._report(fault.code, None)
            return
        if parsed.number is None:
            self._run_from(parsed.statement)
        else:
            self._edit(parsed.number, parsed.statement)


class Model(Prompt):
    """One that cuts by wire."""

    def _new_cutter(self) -> Cutter:
        return Breakable(self.tape, self.path)


class MillModel(Prompt, MillInterpreter):
    """One that mills."""


#: The image whose blocks wait for the machine's answer, and those that mill.
WAITS = "skg-grbl"
MILLS = ("skg-mill", WAITS)
#: The model of each image, by the image's name.
MODELS: Mapping[str, Callable[[Watch], Prompt]] = {
    **dict.fromkeys(("skg", "skg-8251", "skg-tty", "skg-drive"), lambda watch: Model((), watch, Tape())),
    "skg-nodrift": lambda watch: Model((), watch, DriftlessTape()),
    "skg-mill": lambda watch: MillModel((), watch, MillTape()),
    WAITS: lambda watch: MillModel((), watch, MillTape(line_end="\n")),
}


_PLACES = ["O", "(0,0)", "(10,0)", "(10,10)", "(0,10)", "(5,-5)", "(-5,5)", "P", "P1", "(20,0)"]
_FAR = ["(25,200000)", "(200000,0)", "(-99999,99999)", "(99999,-99999)"]
_CURVES = ["X", "Y:10", "-X:10", "-Y", "O:5", "C", "S", "(20,0):5", "-(O:5)"]
_NUMBERS = ["0", "1", "2", "-1", "0.5", "A", "I", "3"]


def statement(random: Random) -> str:
    """A statement, right or wrong; most of them cut."""
    pick = random.choice
    place = lambda: pick(_FAR) if random.random() < 0.06 else pick(_PLACES)  # noqa: E731
    items = lambda: [place() if random.random() < 0.6 else pick(_CURVES) for _ in range(pick((1, 1, 2, 3, 4)))]  # noqa: E731
    makers: list[tuple[int, Callable[[], str]]] = [
        (6, lambda: f"FROM {place()}"),
        (8, lambda: f"CUT {''.join(pick(',;') + item for item in items())[1:]}"),
        (3, lambda: f"CUT {place()},{place()},{pick(_NUMBERS)},{place()}"),
        (1, lambda: f"CUT {place()},O,(40000,0):40000,({pick(('80000,0', '40000,40000', '40000,-40000'))})"),
        (4, lambda: "BACK"),
        (2, lambda: "RECUT"),
        (2, lambda: "END"),
        (1, lambda: f"SYM {pick(_CURVES[:4])}"),
        (1, lambda: f"REP {pick(('2', '3', '1', '0', 'A'))},{pick(('90', '180'))}"),
        (3, lambda: f"FIT {place()}{pick(('', '', ',90'))}"),
        (2, lambda: f"R={pick(('0', '1', '-1', '0.5', '6'))}"),
        (1, lambda: f"SCALE {pick(('1', '2', '0'))}"),
        (1, lambda: f"TOL {pick(('0', '0.1', '-1'))}"),
        (3, lambda: pick(("A=1", "A=A+1", "I=2", "P=(1,2)", "P1=(3,4)", "C=O:5", "S=X:2", "O=P", "A=P"))),
        (4, lambda: f"PRINT {pick(('A', 'I', 'P', 'C', 'S', 'R', 'P1', '(A,I)', '1/0', 'K1 P', '7'))}"),
        (2, lambda: pick(("READ A", "READ P,A", "RESTORE", "RESTORE 30", "DATA 1,(2,3)", "DATA A,7"))),
        (3, lambda: f"{pick(('GOTO', 'GOSUB'))} {pick((*NUMBERS, 55))}"),
        (2, lambda: "RETURN"),
        (1, lambda: f"IF {pick(_NUMBERS)}{pick(('=', '<', '>'))}{pick(_NUMBERS)} GOTO {pick(NUMBERS)}"),
        (4, lambda: pick(("INPUT A", "INPUT P,A", "INPUT P"))),
        (2, lambda: pick(("CUT ,", "FROM", "PRINT )", "CUT O,1,2,X", "P1000=O", "K", "CUT (1,2"))),
        (1, lambda: "REM"),
    ]
    ((_, make),) = random.choices(makers, [weight for weight, _ in makers])
    return make()


#: What is thrown in where a machine mills.
_MILLED = ["F 100", "F 100,50", "F 0", "F A", "Z -1", "Z -1,4", "Z 9", "M 3,100", "M 5", "M 2", "G 4,1", "G 1",
           "HOLE (1,2)", "HOLE O,(3,3)", "HOLE P"]  # fmt: skip


def session(seed: str, number: int, kind: str = "skg") -> list[str]:
    """The lines of a session, by its number and the image."""
    random = Random(f"{seed} {number}")
    lines = []
    for _ in range(random.choice((3, 6, 10, 16))):
        chance = random.random()
        if chance < 0.45:
            lines.append(statement(random))
        elif chance < 0.80:
            number = random.choice(NUMBERS)
            lines.append(f"{number} {statement(random)}")
        elif chance < 0.84:
            lines.append(str(random.choice(NUMBERS)))
        elif chance < 0.95:
            lines.append(random.choice(("RUN", "RUN", "RUN", f"RUN {random.choice((*NUMBERS, 55))}")))
        elif chance < 0.96:
            lines.append("NEW")
        else:
            lines.append(f"GOTO {random.choice(NUMBERS)}")
    if kind in MILLS:
        thrown = [f"5 {random.choice(_MILLED)}", *random.choices(_MILLED, k=3)]
        for line in (*thrown, *(f"{random.choice(('30', '40'))} {line}" for line in random.choices(_MILLED, k=2))):
            lines.insert(random.randrange(len(lines) + 1), line)
    if kind == "skg-drive":
        lines = [line for line in lines if "TOL" not in line]
    return [line + operator(random, line) for line in lines if not line.startswith("INPUT")]


def operator(random: Random, line: str) -> str:
    """What the operator does while a line works."""
    answers, breaks = [], ""
    if line.startswith(("RUN", "GO")) and random.random() < 0.7:
        answers = random.choices(["3", "(1,2)", "1/0", "X", "A", "-1", "P"], k=random.choice((1, 2, 4)))
    if line.startswith(("RUN", "GO", "CUT", "BACK", "RECUT", "REP", "SYM", "END", "FROM")) and random.random() < 0.3:
        breaks = f"\t^C {random.choice((1, 1, 2, 3))}"
    return "".join(f"\t? {answer}" for answer in answers) + breaks


#: A line's part of the tape, and of the paper.
Answer = tuple[bytes, list[str]]


def by_model(lines: Sequence[str], kind: str = "skg", bits: int | None = None) -> list[Answer]:
    """The model's answers, up to a line that is endless."""
    answers = []
    with watching() as watch, real.mp.workprec(bits or real.mp.prec):
        model = MODELS[kind](watch)
        for line in lines:
            model.patience = PATIENCE
            try:
                answers.append(model.typed(line))
            except Endless:
                break
    return answers


def worked(board: Board, typed: Typed, waits: bool) -> list[str]:
    """Type a line, do what the operator does and the machine that each block waits for: the lines that are printed."""
    machine = board.machine
    start, before, end = machine.printed, len(board.tape), machine.cycles + LIMIT
    heard = before
    machine.type(f"{typed.text}\r")
    while (reason := machine.run(SLICE if typed.block or waits else LIMIT)) != "prompt":
        assert machine.cycles < end, f"{typed.text}: {reason}"
        if waits and len(board.tape) > heard and board.tape.endswith(b"\n"):
            heard = len(board.tape)
            machine.tape("ok\r\n")
        elif reason == "input":
            answer = next(typed.answers, None)
            machine.press(CTRL_C) if answer is None else machine.type(f"{answer}\r")
        elif typed.block and blocks(board.tape[before:].decode().split("\r\n")) == typed.block:
            machine.press(CTRL_C)
            typed.block = 0
    return machine.paper_from(start).removesuffix(">").split("\r\n")[1:-1]


def by_board(lines: Sequence[str], kind: str = "skg") -> list[Answer]:
    """The firmware's answers."""
    board = Board(RAM_KIB, kind, limit=LIMIT)
    answers = []
    for line in lines:
        before = len(board.tape)
        paper = [DEVICE.sub("", row) for row in worked(board, Typed.of(line), kind == WAITS)]
        printed = [row for row in paper if row not in ("", ">", "? ") and not LISTED.fullmatch(row)]
        if len(printed) > 1 and printed[-2].strip() == "^" or printed[:1] and printed[0].strip() == "^":
            printed = printed[-1:]
        answers.append((board.tape[before:], printed))
    return answers


def same(ours: Sequence[Answer], theirs: Sequence[Answer]) -> bool:
    """Tell whether two are equal, but for the last digits of numbers, and what a PRINT writes before its ERR."""
    return all(
        tape == wanted
        and len(rows := [row for row in paper if not row.endswith(" ")]) == len(others := [r for r in there if r])
        and all(map(same_line, rows, others))
        for (tape, paper), (wanted, there) in zip(ours, theirs, strict=True)
    )


def difference(lines: Sequence[str], kind: str = "skg") -> str:
    """The first line at which board and model differ, and how; empty for none, or a close call."""
    wanted = by_model(lines, kind)
    lines = lines[: len(wanted)]
    answers = by_board(lines, kind)
    for number, line in enumerate(lines):
        if not same(answers[number : number + 1], wanted[number : number + 1]):
            if not same(by_model(lines, kind, 33), wanted):
                return ""
            return f"{line}: {answers[number]}, wanted {wanted[number]}"
    return ""


def shrunk(lines: Sequence[str], kind: str = "skg") -> list[str]:
    """The session without the lines that its difference does not need."""
    small = list(lines)
    number = 0
    while number < len(small):
        fewer = small[:number] + small[number + 1 :]
        if difference(fewer, kind):
            small, number = fewer, 0
        else:
            number += 1
    return small
