"""Firmware against reference: run both, tell a difference from a close call.

A 40-bit float has a mantissa of 32 bits: at 100 mm one rounding is up to 2⁻³³·128 mm = 1.5·10⁻⁵ µm. A place
that took some dozen roundings to find may therefore be out by about 2·10⁻⁴ µm (`ROUNDING`), and a crossing at
a shallow angle by that divided by the angle's sine. Where the true place lies nearer than this to the tie
between two micrometres, no 32-bit arithmetic can be asked to choose the right one. A program that came out
differently is then set aside and counted. So is one with any other decision that hangs on the last bits
(`skg.ref.near` keeps the list), and one whose tape, paper or error the reference itself changes when it
computes with 33 bits.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from romhelp import Outcome, run

from skg.ref import Result
from skg.ref import run as reference

#: µm; see above.
ROUNDING = 2e-4
#: µm: up to here the reference notes how near a rounding was. A crossing so shallow that it would take more
#: (a sine of 0.02 or less) is a close call by itself.
NOTED = 1e-3
#: Sine of the crossing angle up to which `ROUNDING` has room enough.
SHALLOW = 0.1
#: Printed numbers are equal to 7 digits, or to 10⁻⁷ of the drawing's size (100 mm) where digits cancelled.
DIGITS = 1e-7
SIZE = 100

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:E-?\d+)?")

#: One word of a line: a number, a name, a word, a sign, a text; blanks may stand in it.
WHOLE_WORD = re.compile(
    r'[0-9.][0-9.E \t+-]*|R *E *M.*|[A-Z][ \t]*(?:[A-Z0-9][ \t]*)*\[?|[<>] *=|< *>|"[^"]*"?|.', re.I
)
#: What is marked where a fillet cannot stand.
FILLET = re.compile(r"[\w.+\[\]]+ *\)*(?: *[,;].*)?")


@dataclass(frozen=True)
class Verdict:
    """Blocks compared; why the program was set aside, or how the two differ (empty: neither)."""

    blocks: int = 0
    aside: str = ""
    difference: str = ""


def close_call(result: Result) -> str:
    """The decision that 32 bits cannot be asked to take, if there is one."""
    shallowest = min((n.margin for n in result.near if n.kind == "shallow crossing"), default=SHALLOW)
    needed = ROUNDING * max(1.0, SHALLOW / max(shallowest, 1e-12))
    if needed > NOTED:
        return f"crossing at a sine of {shallowest:.1e}"
    for n in result.near:
        if n.kind == "shallow crossing":
            continue
        if n.kind != "rounding" or n.margin < needed:
            return f"{n.kind} {n.margin:.1e} in line {n.line}"
    return ""


def lines(paper: str) -> list[str]:
    """The reference's paper as lines, empty ones left out as `Outcome` has it."""
    return [line for line in paper.split("\n") if line]


def same_line(a: str, b: str) -> bool:
    """Tells whether two lines of paper are equal except in the last digits of their numbers."""
    if NUMBER.sub("#", a) != NUMBER.sub("#", b):
        return False
    pairs = zip(map(float, NUMBER.findall(a)), map(float, NUMBER.findall(b)), strict=True)
    return all(abs(x - y) <= DIGITS * max(SIZE, abs(x), abs(y)) for x, y in pairs)


def same_paper(a: list[str], b: list[str]) -> bool:
    """Tells whether two papers are the same, except for the text that a PRINT wrote before its ERR."""
    a, b = ([line for line in paper if not line.endswith(" ")] for paper in (a, b))
    return len(a) == len(b) and all(map(same_line, a, b))


def refused(result: Result) -> bool:
    """Tells whether the reference refused a line while loading: its paper ends in the line, a mark, the error."""
    return bool(re.search(r"^ *\^\nERR \d\d(?: LINE \d+)?\n\Z", result.paper, re.M))


def as_if(result: Result) -> Outcome:
    """The reference's result in the shape of the firmware's, LINE of a refused line left out."""
    paper, error = lines(result.paper), result.error
    if refused(result):
        error = (error[0], None)
        paper[-1] = f"ERR {error[0]:02d}"
    return Outcome(result.tape, paper, error)


def same_mark(a: list[str], b: list[str]) -> bool:
    """Tells whether two papers that end in a refused line, its mark and the error mark the same word of it.

    The firmware marks where the word ends, the reference where it begins. Of a fillet that cannot stand the reference
    marks the radius, the firmware the end of the item that shows it.
    """
    if not same_paper(a[:-2], b[:-2]) or a[-1] != b[-1] or a[-2].strip() != "^":
        return False
    word = a[-3][b[-2].index("^") : a[-2].index("^") + 1]
    fillet = "CUT" in a[-3].upper() and FILLET.fullmatch(word)
    return bool(fillet or WHOLE_WORD.fullmatch(word))


def differs(outcome: Outcome, result: Result) -> tuple[str, str]:
    """The difference of the two: in a few words, and in full; both empty when there is none."""
    wanted = as_if(result)
    if outcome.error != wanted.error:
        ours, theirs = (f"ERR {e[0]:02d}" if e else "no error" for e in (outcome.error, wanted.error))
        kind = f"{ours}, reference {theirs}" if ours != theirs else f"{ours} elsewhere"
        return kind, f"error {outcome.error}, reference {wanted.error}"
    if outcome.tape != wanted.tape:
        ours, theirs = outcome.tape.decode().split(), wanted.tape.decode().split()
        at = next(
            (n for n, (a, b) in enumerate(zip(ours, theirs, strict=False)) if a != b), min(len(ours), len(theirs))
        )
        return "tape", f"block {at + 1}: {ours[at : at + 3]}, reference {theirs[at : at + 3]}"
    if not same_paper(outcome.paper, wanted.paper) and not (refused(result) and same_mark(outcome.paper, wanted.paper)):
        return "paper", f"paper {outcome.paper}, reference {wanted.paper}"
    return "", ""


def difference(outcome: Outcome, result: Result) -> str:
    """The difference of the firmware's outcome from the reference's result; empty when there is none."""
    return differs(outcome, result)[1]


def compare(program: str, answers: tuple[str, ...] = ()) -> Verdict:
    """Run a program on a new board and through the reference."""
    result = reference(program, answers)
    blocks = sum(line.startswith("B") for line in result.tape.decode().split())
    found = difference(run(program, answers), result)
    if not found:
        return Verdict(blocks)
    # Only a program that came out differently needs an excuse.
    aside = close_call(result)
    if not aside:
        rough = reference(program, answers, bits=33)
        if (rough.tape, rough.error) != (result.tape, result.error):
            aside = "the reference's tape is another one at 33 bits"
        elif not same_paper(lines(rough.paper), lines(result.paper)):
            aside = "the reference prints other numbers at 33 bits"
    return Verdict(aside=aside) if aside else Verdict(difference=found)
