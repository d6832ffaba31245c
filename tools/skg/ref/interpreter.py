"""Programs: loading lines, running statements, errors (language.md, sections 3 and 6)."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from operator import itemgetter
from typing import Literal, overload

from skg.errors import UserError
from skg.messages.finding import Finding, Phrase
from skg.ref import real
from skg.ref.cutter import Cutter
from skg.ref.drift import DriftlessPunch
from skg.ref.fault import Code, Fault
from skg.ref.geometry import negate
from skg.ref.near import Near, Watch, watching
from skg.ref.operations import operate
from skg.ref.parser import LAST_SUBSCRIPT, LETTERS, LONGEST, WIRE, LineFault, parse_answer, parse_line, whole
from skg.ref.real import ZERO, Real
from skg.ref.route import Segment
from skg.ref.statements import (
    Assign,
    Binary,
    Cut,
    Data,
    Expression,
    Fit,
    From,
    Function,
    Gosub,
    Goto,
    If,
    Input,
    Minus,
    Name,
    Number,
    Print,
    Read,
    Rep,
    Restore,
    Scale,
    Simple,
    Statement,
    Sym,
    Tol,
)
from skg.ref.tape import Punch
from skg.ref.values import ORIGIN, X_AXIS, Y_AXIS, Circle, Line, Point, Rotation, Value, canonical, kind

#: Levels of GOSUB.
LEVELS = 8
#: The greatest n of REP.
MOST_COUNTED = 65535

_PREDEFINED: dict[tuple[str, int], Value] = {("O", 0): ORIGIN, ("X", 0): X_AXIS, ("Y", 0): Y_AXIS}

_FUNCTIONS: dict[str, Callable[[Real], Real]] = {
    "SQR": real.sqrt,
    "SIN": real.sin,
    "COS": real.cos,
    "TG": real.tan,
    "ATG": real.atan,
    "ABS": abs,
    "INT": real.floor,
}


@dataclass(frozen=True)
class Result:
    """The result of a program.

    `tape` holds the bytes of the punch; `paper` what PRINT and INPUT wrote, and a last line `ERR …`, lines
    ended by LF; `error` the error's number and line (None: no line). `near` lists decisions that were close
    calls (see `skg.ref.near`); `path` the wire's moves in true coordinates.
    """

    tape: bytes
    paper: str
    error: tuple[int, int | None] | None = None
    near: list[Near] = field(default_factory=list)
    path: list[Segment] = field(default_factory=list)


class _End(Exception):
    """The run is over."""


class Endless(Exception):
    """More lines were carried out than the caller has patience for."""


class Interpreter:
    """One machine: a program, variables, a tape; `Endless` after `patience` lines (None: never)."""

    dialect = WIRE

    def __init__(self, inputs: Iterable[str], watch: Watch, tape: Punch, patience: int | None = None) -> None:
        self.answers = iter(inputs)
        self.patience = patience
        self.watch = watch
        self.program: dict[int, Statement] = {}
        self.tape = tape
        self.path: list[Segment] = []
        self.paper: list[str] = []
        self._clear()

    def _clear(self) -> None:
        """Set the state that RUN starts with."""
        self.variables: dict[tuple[str, int], Value] = {}
        self.data_at = 0
        self.returns: list[int | None] = []
        self.cutter = self._new_cutter()
        self.tape.place(ORIGIN)
        self.next: int | None = None

    def _new_cutter(self) -> Cutter:
        return Cutter(self.tape, self.path)

    # Lines ----------------------------------------------------------------------------------------------

    def load(self, source: str) -> tuple[int, int | None] | None:
        """Take in lines as if typed; the error that stopped it, if any."""
        for text in _lines(source):
            try:
                line = parse_line(text, self.dialect)
            except LineFault as fault:
                number = re.match(r"\s*(\d+)", text)
                self.paper.append(f"{text[: LONGEST + 1]}\n{' ' * fault.column}^\n")
                return self._report(fault.code, whole(number.group(1)) if number else None)
            if line.number is None:
                error = self._run_from(line.statement)
                if error is not None:
                    return error
                continue
            self._edit(line.number, line.statement)
        return None

    def _edit(self, number: int, statement: Statement | None) -> None:
        """Store a line, or take it out (None); a number that is no line's does nothing."""
        if statement is None and number not in self.program:
            return
        if statement is None:
            del self.program[number]
        else:
            self.program[number] = statement
        self._forget_places()

    def _forget_places(self) -> None:
        """Forget what belongs to the last program: the open route, the places of DATA and GOSUB."""
        self.cutter.forget()
        self.data_at = 0
        self.returns.clear()

    def run(self) -> tuple[int, int | None] | None:
        """RUN; the error that ended it, if any."""
        self._clear()
        return self._run_from(None)

    def _run_from(self, direct: Statement | None) -> tuple[int, int | None] | None:
        """Run the program from its start, or one direct statement and what it jumps to."""
        numbers = sorted(self.program)
        self.next = 0 if direct is None else None
        try:
            if direct is not None:
                self._at(None)
                self._execute(direct)
            while self.next is not None:
                if self.next >= len(numbers):
                    self._at(numbers[-1] if numbers else None)
                    self.cutter.end()
                    break
                number = numbers[self.next]
                self._at(number)
                self.next += 1
                self._execute(self.program[number])
        except _End:
            pass
        except Fault as fault:
            return self._fail(fault.code)
        except RecursionError:
            return self._fail(Code.MEMORY)
        except KeyboardInterrupt:
            return self._fail(Code.TAPE)
        return None

    def _fail(self, code: Code) -> tuple[int, int | None]:
        self.cutter.abort()
        return self._report(code, self.watch.line)

    def _at(self, number: int | None) -> None:
        self.watch.line = self.cutter.line = number
        if self.patience is not None:
            self.patience -= 1
            if self.patience < 0:
                raise Endless

    def _report(self, code: Code, number: int | None) -> tuple[int, int | None]:
        where = "" if number is None else f" LINE {number}"
        self.paper.append(f"ERR {code:02d}{where}\n")
        return int(code), number

    def _gosub(self, number: int) -> None:
        if len(self.returns) == LEVELS:
            raise Fault(Code.LINE)
        back = self.next
        self._jump(number)
        self.returns.append(back)

    def _jump(self, number: int) -> None:
        if number not in self.program:
            raise Fault(Code.LINE)
        self.next = sorted(self.program).index(number)

    # Expressions ----------------------------------------------------------------------------------------

    def evaluate(self, e: Expression) -> Value:
        """The value of an expression."""
        match e:
            case Number(value):
                return value
            case Name():
                return self._read_name(e)
            case Minus(operand):
                return negate(self.evaluate(operand))
            case Function(name, argument):
                return _call(name, self.evaluate(argument))
            case Binary(operator, left, right):
                return operate(self.evaluate(left), operator, self.evaluate(right))

    def _key(self, name: Name) -> tuple[str, int]:
        subscript = name.subscript
        if not isinstance(subscript, int):
            subscript = real.whole(self.number(subscript))
        if not 0 <= subscript <= LAST_SUBSCRIPT:
            raise Fault(Code.RANGE)
        return name.letter, subscript

    def _read_name(self, name: Name) -> Value:
        key = self._key(name)
        value = _PREDEFINED.get(key, self.variables.get(key))
        if value is None:
            raise Fault(Code.NO_VALUE)
        return value

    def _target(self, name: Name) -> tuple[str, int]:
        key = self._key(name)
        if key in _PREDEFINED:
            raise Fault(Code.NO_VALUE)
        return key

    def _store(self, key: tuple[str, int], value: Value) -> None:
        if LETTERS[key[0]] != kind(value):
            raise Fault(Code.KINDS)
        self.variables[key] = value

    @overload
    def _expect(self, e: Expression, wanted: Literal["D"]) -> Real: ...
    @overload
    def _expect(self, e: Expression, wanted: Literal["P"]) -> Point: ...
    @overload
    def _expect(self, e: Expression, wanted: Literal["S"]) -> Line: ...
    def _expect(self, e: Expression, wanted: str) -> Value:
        value = self.evaluate(e)
        if kind(value) != wanted:
            raise Fault(Code.KINDS)
        return value

    def number(self, e: Expression) -> Real:
        """The value of an expression that must be a number."""
        return self._expect(e, "D")

    @property
    def offset(self) -> Real:
        """R; 0 when it has no value."""
        value = self.variables.get(("R", 0), ZERO)
        assert not isinstance(value, Point | Circle | Line | Rotation), "`_store` takes numbers alone"
        return value

    # Statements -----------------------------------------------------------------------------------------

    def _execute(self, s: Statement) -> None:
        match s:
            case Assign(name, expression):
                key = self._target(name)
                self._store(key, self.evaluate(expression))
            case From(point):
                self.cutter.position(self._expect(point, "P"))
            case Cut(items):
                self.cutter.end_curve()
                for right, item in items:
                    self._cut(right, self.evaluate(item))
            case Sym(right, mirror):
                self.cutter.end_curve()
                self.cutter.mirror(self._expect(mirror, "S"), right, self.offset)
            case Rep():
                self.cutter.end_curve()
                self._rep(s)
            case Fit(node, angle):
                self._fit(self._expect(node, "P"), None if angle is None else self.number(angle))
            case Tol(tolerance):
                self.cutter.end_curve()
                self.cutter.tolerate(self.number(tolerance))
            case Scale(factor):
                self.cutter.enlarge(self.number(factor))
            case Read(names):
                for name in names:
                    self._read(name)
            case Data():
                pass
            case Restore(number):
                self.data_at = sum(line < (number or 0) for line, _ in self._data())
            case Print(items):
                self.paper.append(" ".join(i if isinstance(i, str) else self._shown(i) for i in items) + "\n")
            case Input(names):
                for name in names:
                    self._input(name)
            case Goto(number):
                self._jump(number)
            case If(left, relation, right, number):
                if _holds(self.number(left), relation, self.number(right)):
                    self._jump(number)
            case Gosub(number):
                self._gosub(number)
            case Simple(word):
                self._simple(word)

    def _simple(self, word: str) -> None:
        match word:
            case "BACK":
                self.cutter.back()
            case "RECUT":
                self.cutter.recut(self.offset)
            case "RETURN":
                if not self.returns:
                    raise Fault(Code.LINE)
                self.next = self.returns.pop()
            case "END":
                self.cutter.end()
                raise _End

    def _cut(self, right: bool, value: Value) -> None:
        if isinstance(value, Rotation):
            raise Fault(Code.KINDS)
        if isinstance(value, Point | Circle | Line):
            self.cutter.element(value, right, self.offset)
        else:
            self.cutter.fillet(value, right)

    def _rep(self, s: Rep) -> None:
        copies = real.whole(self.number(s.count))
        if not 0 <= copies <= MOST_COUNTED:
            raise Fault(Code.RANGE)
        rotation = self.evaluate(s.rotation)
        if copies == 0:
            raise Fault(Code.RANGE)
        if isinstance(rotation, Point | Circle | Line):
            raise Fault(Code.KINDS)
        if not isinstance(rotation, Rotation):
            rotation = Rotation(rotation, ORIGIN)
        self.cutter.repeat(copies, rotation.angle, rotation.centre, s.right, self.offset)

    def _fit(self, node: Point, angle: Real | None) -> None:
        tangent = None if angle is None else Point(real.cos(angle), real.sin(angle))
        self.cutter.node(node, tangent, self.offset)

    def _data(self) -> list[tuple[int, Expression]]:
        statements = sorted(self.program.items(), key=itemgetter(0))
        return [
            (number, item)
            for number, statement in statements
            if isinstance(statement, Data)
            for item in statement.items
        ]

    def _read(self, name: Name) -> None:
        key = self._target(name)
        data = self._data()
        if self.data_at >= len(data):
            raise Fault(Code.DATA)
        self._store(key, self.evaluate(data[self.data_at][1]))
        self.data_at += 1

    def _input(self, name: Name) -> None:
        key = self._target(name)
        while True:
            answer = next(self.answers, None)
            if answer is None:
                self.paper.append("? \n")
                raise Fault(Code.TAPE)
            answer = _typed(answer)
            self.paper.append(f"? {answer}\n")
            try:
                self._store(key, self.evaluate(parse_answer(answer)))
            except Fault:
                continue
            return

    def _shown(self, e: Expression) -> str:
        value = self.evaluate(e)
        if isinstance(value, Point | Circle | Line | Rotation):
            return f"({','.join(real.show(v) for v in canonical(value))})"
        return real.show(value)


def _call(name: str, value: Value) -> Value:
    """A function; K1, K2, K3 take any kind but a number, the others numbers alone."""
    if name.startswith("K"):
        numbers = canonical(value)
        index = int(name[1]) - 1
        if index >= len(numbers):
            raise Fault(Code.KINDS)
        return numbers[index]
    if isinstance(value, Point | Circle | Line | Rotation):
        raise Fault(Code.KINDS)
    return real.in_range(_FUNCTIONS[name](value))


def _holds(a: Real, relation: str, b: Real) -> bool:
    equal = real.nearly_equal(a, b)
    match relation:
        case "=":
            return equal
        case "<>":
            return not equal
        case "<":
            return a < b and not equal
        case ">":
            return a > b and not equal
        case "<=":
            return a < b or equal
        case _:
            return a > b or equal


def _lines(source: str) -> list[str]:
    """The lines of a source tape: CR or LF ends one, empty ones do not count, ctrl-Z ends the tape."""
    text = source.split("\x1a")[0]
    for number, line in enumerate(re.split(r"\r\n|[\r\n]", text), start=1):
        if not line.isascii():
            odd = Finding("line-not-ascii", text=repr(line.strip()))
            raise UserError(odd.within(Phrase("line-number", line=number)))
    return [line for line in map(_typed, re.split(r"[\r\n]", text)) if line.strip()]


def _typed(line: str) -> str:
    """The part of a line that the machine takes: ctrl-U drops all before it, other control characters are ignored."""
    return re.sub(r"[\x00-\x1f\x7f]", "", line.split("\x15")[-1])


def run(
    source: str,
    inputs: Iterable[str] = (),
    bits: int | None = None,
    drift: bool = True,
    patience: int | None = None,
    runs: bool = True,
) -> Result:
    """Load a program and RUN it; `inputs` are the operator's answers to INPUT.

    Without `runs` it is loaded alone: its lines without numbers have been carried out then.

    Without `drift` each block starts where the controller really stands after the one before (docs/drift.md).
    With `patience` a program that carries out more lines than that raises `Endless`.

    With `bits`, everything is computed with a mantissa of that many bits instead of 50 digits. A program
    whose tape comes out differently at 33 bits is ill-conditioned for the machine's own floats.
    """
    return carry_out(
        lambda watch: Interpreter(inputs, watch, Punch() if drift else DriftlessPunch(), patience), source, bits, runs
    )


def carry_out(machine: Callable[[Watch], Interpreter], source: str, bits: int | None, runs: bool = True) -> Result:
    """Load and RUN a program on a machine; `bits` and `runs` as in `run`."""
    with watching() as watch, real.mp.workprec(bits or real.mp.prec):
        board = machine(watch)
        error = board.load(source)
        if error is None and runs:
            error = board.run()
    return Result(board.tape.bytes(), "".join(board.paper), error, watch.calls, board.path)
