"""Firmware against reference: run both, tell a difference from a close call.

A 40-bit float has a mantissa of 32 bits: at 100 mm one rounding is up to 2⁻³³·128 mm = 1.5·10⁻⁵ µm. A place
that took some dozen roundings to find may therefore be out by about 2·10⁻⁴ µm (`ROUNDING`), and a crossing at
a shallow angle by that divided by the angle's sine. Where the true place lies nearer than this to the tie
between two micrometres, no 32-bit arithmetic can be asked to choose the right one. A program that came out
differently is then set aside and counted. So is one with any other decision that hangs on the last bits
(`skg.ref.near` keeps the list), and one whose tape, paper or error the reference itself changes when it
computes with 33 bits.

The centre of a flat arc of FIT is in doubt, too. It lies at r = w²/(2·t×w) (t the start direction, w the chord), where
|t×w| = |w|·sin φ, φ half the sweep, is a difference of two products of the size of |w|: what 32 bits lose there is
divided by sin²φ. For coordinates of 100 mm the 33-bit reference misses the 50-digit one's centre by 3·10⁻⁶/sin²φ µm in
the mean and 1.5·10⁻⁵/sin²φ µm at most (over the 1,300 arcs of the examples); `CENTRE` leaves room for the firmware's
other order of operations. Where the true centre lies nearer than this to the tie between two micrometres, the block's
x, y and J may be a micrometre off (more only where the centre is known no better).
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import ceil, pi, sin

from romhelp import Outcome, run

from skg.ref import Result
from skg.ref import run as reference
from skg.ref.route import Segment

#: µm; see above.
ROUNDING = 2e-4
#: µm: up to here the reference notes how near a rounding was. A crossing so shallow that it would take more
#: (a sine of 0.02 or less) is a close call by itself.
NOTED = 1e-3
#: Sine of the crossing angle up to which `ROUNDING` has room enough.
SHALLOW = 0.1
#: µm by which 32 bits may miss the centre of an arc at 100 mm, times sin² of half its sweep.
CENTRE = 8e-5
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


def doubt_of_centre(s: Segment) -> float:
    """µm by which an arc's centre is in doubt when a tie lies within that, else 0."""
    size = max(abs(v) for p in (s.start, s.end) for v in (p.x, p.y))
    doubt = CENTRE * max(float(size), 1) / 100 / sin(min(float(s.sweep), pi) / 2) ** 2
    to_tie = min(abs((1000 * abs(float(v)) + 0.502 + 0.5) % 1 - 0.5) for v in (s.centre.x, s.centre.y))
    return doubt if to_tie < doubt else 0


def blocks_of(tape: bytes) -> list[tuple[str, list[int]]]:
    """The blocks of a tape: what is not a number, and the numbers x, y, J."""
    words = tape.decode().split()
    return [(re.sub(r"(?<=B)\d+", "", word), [int(n) for n in re.findall(r"B(\d+)", word)]) for word in words]


def doubtful_blocks(ours: bytes, theirs: bytes, doubts: list[float]) -> int | None:
    """The number of blocks that differ by no more than a doubtful centre may change; None: another difference.

    A centre that is off by n µm in x and y changes x and y by n and J, the travel, by 4·√2·n at most.
    """
    a, b = blocks_of(ours), blocks_of(theirs)
    if len(a) != len(b):
        return None
    different = [(x, y) for x, y in zip(a, b, strict=True) if x != y]
    if len(different) > len(doubts):
        return None
    off_by = 6 * ceil(max(doubts, default=0))
    for (frame, values), (other_frame, others) in different:
        if frame != other_frame or frame[-3:-1] not in ("SR", "NR"):
            return None
        if any(abs(m - n) > off_by for m, n in zip(values, others, strict=True)):
            return None
    return len(different)


def doubtful_centres(tape: bytes, result: Result) -> int | None:
    """The number of blocks in which a tape differs from the reference's by a doubtful centre alone; None: otherwise."""
    doubts = [doubt for s in result.path if s.is_arc and (doubt := doubt_of_centre(s))]
    return doubtful_blocks(tape, result.tape, doubts)


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
