"""The images that mill (asm/variants: iso.asm, mill.asm, io_ok.asm) and the milling reference: ISO tape, paper, error
and its line. Whatever one image does, the one that waits for the machine does, too.

Parts of the random tests and small-integer soup with the statements of milling.md thrown in, right ones and wrong ones;
what is set aside as a close call is the rule of compare.py. Another seed: SKG_SEED=text, more of it: SKG_BLOCKS=number.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest
from compare import as_if, close_call, differs
from parts import part
from romhelp import SOME_EXAMPLES, Board, Outcome
from soup import soup

from skg.ref import Result, mill
from skg.ref.interpreter import Endless

sys.path.append(str(Path(__file__).resolve().parents[1] / "mill"))

import test_mill_reference as cases  # noqa: E402  (its tables: every statement, every error)
from playedhelp import IMAGE as WAITING  # noqa: E402
from playedhelp import Waiting  # noqa: E402

SEED = os.environ.get("SKG_SEED", "milling")
SHARES = range(4)
BLOCKS_A_SHARE = int(os.environ.get("SKG_BLOCKS", "1500")) // len(SHARES)
#: Of all programs, so many may be close calls.
MOST_ASIDE = 0.02
PATIENCE = 300
RAM_KIB = 48
LISTED = re.compile(r"N\d+[A-Z].*")

#: pytest's record_property.
Record = Callable[[str, object], None]


class Mill(Board):
    """The standard board with an image that mills; the blocks are no part of the paper that is compared."""

    def __init__(self, kind: str = "skg-mill") -> None:
        super().__init__(RAM_KIB, kind)

    def outcome(self, source: str, answers: tuple[str, ...] = ()) -> Outcome:
        """LOAD and RUN."""
        found = super().outcome(source, answers)
        return replace(found, paper=[line for line in found.paper if not LISTED.fullmatch(line)])


class Waits(Waiting, Mill):
    """The same with the image whose blocks wait for a machine, which takes them all."""

    def __init__(self) -> None:
        super().__init__(WAITING)


def numbered(program: str) -> bool:
    """Tells whether a program can be loaded with a machine at the reader's port: it has no direct statements."""
    return all(line[:1].isdigit() for line in program.splitlines())


def waits_for_the_same(program: str, answers: tuple[str, ...], without: Outcome) -> bool:
    """Tells whether the image that waits has the other one's outcome, except for the CR of its blocks."""
    return Waits().outcome(program, answers) == replace(without, tape=without.tape.replace(b"\r\n", b"\n"))


def judge(program: str, answers: tuple[str, ...] = (), patience: int | None = None) -> tuple[Result | None, str, str]:
    """The reference's result, how the firmware differs from it, and why that is set aside (empty: it is not)."""
    try:
        result = mill.run(program, answers, patience=patience)
    except Endless:
        return None, "", "endless"
    outcome = Mill().outcome(program, answers)
    found = differs(outcome, result)[1]
    aside = close_call(result) if found else ""
    if found and not aside:
        rough = mill.run(program, answers, bits=33)
        aside = "another one at 33 bits" if differs(as_if(rough), result)[0] else ""
    if numbered(program) and not waits_for_the_same(program, answers, outcome):
        return result, "the image that waits for the machine does something else", ""
    return result, found, aside


def check(program: str, answers: tuple[str, ...] = ()) -> Result:
    """Firmware and reference agree, without an excuse."""
    result, found, aside = judge(program, answers)
    assert result and not found and not aside, f"{found}\n{aside}\n\n{program}"
    return result


def listings(*tests: Callable[..., None]) -> Iterable[tuple[str, ...]]:
    """The statements of the reference's own tables."""
    for test in tests:
        for mark in test.pytestmark:
            for case in mark.args[1]:
                yield tuple(case[0])


@pytest.mark.parametrize("statements", [
    *listings(cases.test_blocks, cases.test_errors),
    *[("F 60", *statements) for statements in listings(cases.test_arcs)],
], ids=" ".join)  # fmt: skip
def test_every_statement_and_error(statements: tuple[str, ...]) -> None:
    """After an error the machine is told to stop, and nothing is lost: the program is there, and runs again."""
    program = cases.program(*statements) + "\n"
    check(program)
    board = Mill()
    board.load(program)
    listing = board.listing()
    board.run()
    first = board.tape
    assert board.listing() == listing
    board.clear()
    board.run()
    assert board.tape == first
    assert len(listing) == len(statements)


@pytest.mark.parametrize("case", listings(cases.test_lines_that_are_not_understood), ids="".join)
def test_lines_that_are_not_understood(case: tuple[str, ...]) -> None:
    line = "".join(case)
    board = Mill()
    assert board.type(line)[-1] == "ERR 01"
    assert board.listing() == []
    assert mill.run(line).error == (1, 10)


@pytest.mark.parametrize("example", SOME_EXAMPLES, ids=lambda example: example.stem)
def test_examples(example: Path) -> None:
    """As a mill would cut them."""
    check(f"1 F 250,80\n2 Z -2.5,4\n{example.read_text()}")


def test_lists_and_saves_what_was_typed() -> None:
    board = Mill()
    for line in ("10F200,60", "20Z-2", "30HOLE(1,2),P3", "40M3,1200", "50 G4,.5", "60FROMO", "70FITO", "80GOTO10"):
        assert board.type(line) == []
    listed = ["10 F 200,60", "20 Z -2", "30 HOLE (1,2),P3", "40 M 3,1200", "50 G 4,0.5", "60 FROM O", "70 FIT O",
              "80 GOTO 10"]  # fmt: skip
    assert board.listing() == listed
    board.type("SAVE")
    again = Mill()
    assert again.load(board.tape.decode()) == []
    assert again.listing() == listed


def test_the_language_has_its_other_words_still() -> None:
    """FREE, FROM, FIT begin like F, GOTO and GOSUB like G; a command goes into no program."""
    board = Mill()
    assert int(board.type("FREE")[0]) > 1000
    assert board.type("10 FREE")[-1] == board.type("FREE 1")[-1] == "ERR 01"
    assert board.type("GOTO 7") == board.type("GOSUB 7") == ["ERR 02"]
    assert board.listing() == []


def test_direct_statements_go_on_from_each_other() -> None:
    """A tape of direct statements, an error in it, END, and a new one: all against the reference's own machine."""
    from skg.ref.mill.interpreter import MillInterpreter
    from skg.ref.mill.iso import IsoPunch
    from skg.ref.near import Watch

    board, machine = Mill(), MillInterpreter((), Watch(), IsoPunch())
    lines = ["M 3,100", "CUT (1,1),(2,2),(3,3)", "F 5", "Z -1", "CUT (1,1),(2,2),(3,3)", "BACK", "Z -2", "RECUT",
             "HOLE (9,9)", "CUT (0,0),(1,0),(2,0)", "GOTO 9", "FROM (2,0)", "Z 1,0", "CUT (5,5):1,(5,5):1", "END",
             "HOLE (2,0)", "END"]  # fmt: skip
    for line in lines:
        board.type(line)
        machine.load(line)
        assert board.tape == machine.tape.bytes(), line
    assert board.tape.count(b"G17") == board.tape.count(b"M30") == 2
    assert board.tape.count(b"M0\r") == 2


def test_block_numbers_begin_again_behind_9999() -> None:
    tape = Mill().outcome("10 I=0\n20 M 8\n30 I=I+1\n40 IF I<10005 GOTO 20\n").tape.decode().split("\r\n")
    assert tape[1:] == [*(f"N{n}M8" for n in range(2, 10000)), *(f"N{n}M8" for n in range(1, 8)), "N8M30", ""]


#: What is thrown in: statements that do, and that do not; `#` becomes a random number.
THROWN = ["F #", "F #,#", "Z -#", "Z -#,#", "Z #", "Z -#/1000,#/7", "M 3,#", "M #", "M 6,#", "M 5", "G #", "G 4,#/10",
          "HOLE (#,-#)", "HOLE (#,#),P1,O", "HOLE P", "FROM (#,#)", "RECUT", "R=#/1000", "F #/0", "Z O", "M -1",
          "F 0"]  # fmt: skip
LIKELY = 10


def thrown(rng: Random, program: str) -> str:
    """A program with some statements of milling.md in it, most with a feed in front."""
    rows = program.splitlines()
    for _ in range(rng.choice([1, 2, 3, 5])):
        at = rng.randrange(len(rows))
        if number := re.match(r"\d+", rows[at]):
            text = rng.choice(THROWN[:LIKELY] if rng.random() < 0.8 else THROWN)
            text = re.sub("#", lambda _: str(rng.choice([0, 1, 2, 3, 5, 6, 8, 28, 54, 80.5, 150, 99.9996])), text)
            rows.insert(at + 1, f"{int(number[0]) + 1} {text}")
    head = ["1 F 250,80", "2 Z -2.5"] if rng.random() < 0.6 else ["1 F 99.5"] if rng.random() < 0.8 else []
    return "\n".join([*head, *rows, ""])


@pytest.mark.parametrize("share", SHARES)
def test_random_programs(share: int, record_property: Record) -> None:
    rng = Random(f"{SEED} {share}")
    blocks = programs = arcs = errors = waited = number = 0
    aside: list[str] = []
    while blocks < BLOCKS_A_SHARE:
        if rng.random() < 0.4:
            program, answers = part(rng), ()
        else:
            number += 1
            bowl = soup(f"{SEED} {share}", number)
            program, answers = bowl.program, bowl.answers
        program = thrown(rng, program)
        result, found, why = judge(program, answers, PATIENCE)
        assert not found or why, f"{found}\n\n{program}" + "".join(f"? {answer}\n" for answer in answers)
        programs += 1
        aside += [why] if why else []
        if result and not why:
            blocks += result.tape.count(b"N")
            arcs += result.tape.count(b"I")
            errors += result.error is not None
            waited += result.tape.count(b"N") * numbered(program)
    assert arcs > blocks / 20
    assert errors > programs / 20
    assert waited > blocks / 2
    assert len(aside) <= max(3, MOST_ASIDE * programs), aside
    record_property("compared", ("blocks for mills", blocks, programs, len(aside)))
