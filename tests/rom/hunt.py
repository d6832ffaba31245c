"""The hunt: small-integer soup (soup.py) through firmware and reference, whatever differs shrunk and shown once.

    make hunt                                       1,000,000 programs, on all cores
    make hunt SEED=7 PROGRAMS=50000

A difference's class is how firmware and reference differ, and the statements that are left in the shrunk program.
What to do with one: find out by docs/spec/language.md who is right (rule there when it is silent), mend it and its
neighbours, and put the shrunk program into tests/rom/regressions/NAME.skg with a REM that says what it shows.
"""

from __future__ import annotations

import multiprocessing
import re
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import click
from compare import Verdict, as_if, close_call, differs, doubtful_centres
from romhelp import Board, Outcome
from soup import TOKEN, Bowl, soup
from tqdm import tqdm

from skg.board import BoardStopped
from skg.ref import run as reference
from skg.ref.interpreter import Endless

#: A program that carries out more lines than this is endless: the operator breaks in, nothing is compared.
PATIENCE = 300
#: No program of the soup takes the firmware so many cycles (a quarter of an hour of the 2 MHz board).
RUN_LIMIT = 2_000_000_000
#: Memory enough for SYM, REP and RECUT of what the soup makes.
RAM_KIB = 48
#: Programs that a process takes at a time.
CHUNK = 100
#: Trials that shrinking one program may take.
TRIALS = 1500

WORD = re.compile(
    r"CUT|FROM|BACK|SYM|REP|RECUT|FIT|TOL|SCALE|READ|DATA|RESTORE|PRINT|INPUT|GOTO|IF|GOSUB|RETURN|END|REM"
)


@dataclass
class Catch:
    """Results of some programs: their number, their blocks, programs set aside and why, differences."""

    programs: int = 0
    blocks: int = 0
    whole: int = 0
    aside: Counter[str] = field(default_factory=Counter)
    found: dict[str, tuple[int, str, Bowl]] = field(default_factory=dict)

    def add(self, other: Catch) -> None:
        """Take in another's; of each class the first program stays."""
        self.programs += other.programs
        self.blocks += other.blocks
        self.whole += other.whole
        self.aside += other.aside
        for name, (count, *first) in other.found.items():
            before, *kept = self.found.get(name, (0, *first))
            self.found[name] = (before + count, *kept)


def board(bowl: Bowl) -> Outcome:
    """The firmware's outcome."""
    return Board(RAM_KIB, limit=RUN_LIMIT).outcome(bowl.program, bowl.answers)


def judge(bowl: Bowl, firmware: Callable[[Bowl], Outcome] = board) -> tuple[str, Verdict]:
    """The difference of firmware and reference, in a few words, and the verdict."""
    try:
        result = reference(bowl.program, bowl.answers, patience=PATIENCE)
    except Endless:
        return "", Verdict(aside="endless")
    try:
        outcome = firmware(bowl)
        kind, difference = differs(outcome, result)
    except BoardStopped as hang:
        kind, difference = "hang", str(hang)
    if not kind:
        return "", Verdict(result.tape.count(b"G"))
    aside = close_call(result)
    if not aside and kind == "tape" and "FIT" in bowl.program.upper() and doubtful_centres(outcome.tape, result):
        aside = "the centre of a flat arc"
    if not aside:
        rough = reference(bowl.program, bowl.answers, bits=33)
        if differs(as_if(rough), result)[0]:
            aside = "the reference's own answer is another one at 33 bits"
    return (kind, Verdict(aside=aside)) if aside else (kind, Verdict(difference=difference))


def shrink(bowl: Bowl, kind: str, firmware: Callable[[Bowl], Outcome] = board) -> Bowl:
    """The shortest program found that differs in the same way: less of everything, and simpler numbers."""
    left = TRIALS

    def still(candidate: Bowl) -> bool:
        nonlocal left
        left -= 1
        if left < 0:
            return False
        found, verdict = judge(candidate, firmware)
        return found == kind and bool(verdict.difference)

    smaller = True
    while smaller and left > 0:
        smaller = False
        for candidate in smaller_ones(bowl):
            if still(candidate):
                bowl, smaller = candidate, True
                break
    return bowl


def smaller_ones(bowl: Bowl) -> Iterator[Bowl]:
    """A program with a little less in it, in every way there is."""
    rows = bowl.program.splitlines()
    for at in range(len(rows)):
        yield Bowl("".join(f"{row}\n" for row in rows[:at] + rows[at + 1 :]), bowl.answers)
    for at in range(len(bowl.answers)):
        yield Bowl(bowl.program, bowl.answers[:at] + bowl.answers[at + 1 :])
    for at, row in enumerate(rows):
        for shorter in shorter_rows(row):
            yield Bowl("".join(f"{row}\n" for row in [*rows[:at], shorter, *rows[at + 1 :]]), bowl.answers)


def shorter_rows(row: str) -> Iterator[str]:
    """A line with fewer tokens, or simpler ones."""
    head = re.match(r"\d* ?", row)[0]
    tokens = TOKEN.findall(row[len(head) :])
    if head:
        yield row[len(head) :]
    for width in (12, 8, 6, 5, 4, 3, 2, 1):
        for at in range(len(tokens) - width + 1):
            yield head + "".join(tokens[:at] + tokens[at + width :])
    for at, token in enumerate(tokens):
        simpler = ["0", "1", "5"] if re.fullmatch(r"\d{2,}|\d+\.\d*", token) else []
        for other in simpler:
            yield head + "".join([*tokens[:at], other, *tokens[at + 1 :]])


def class_of(kind: str, small: Bowl) -> str:
    """The class of a difference by the shrunk program's statements."""
    return f"{kind}: {' '.join(sorted(set(WORD.findall(small.program.upper()))))}"


def catch(seed: str, numbers: range, firmware: Callable[[Bowl], Outcome] = board) -> Catch:
    """Programs of some numbers, one after the other."""
    caught = Catch()
    for number in numbers:
        bowl = soup(seed, number)
        kind, verdict = judge(bowl, firmware)
        caught.programs += 1
        caught.blocks += verdict.blocks
        if verdict.aside:
            caught.aside[re.sub(r" \d.*", "", verdict.aside)] += 1
        if verdict.difference:
            small = shrink(bowl, kind, firmware)
            caught.found.setdefault(class_of(kind, small), (0, number, small))
            count, *first = caught.found[class_of(kind, small)]
            caught.found[class_of(kind, small)] = (count + 1, *first)
    return caught


def _share(job: tuple[str, int, int]) -> Catch:
    seed, first, last = job
    return catch(seed, range(first, last))


@click.command()
@click.option("--seed", default="1", help="Another seed, other programs.")
@click.option("--programs", default=1_000_000, help="How many.")
@click.option("--first", default=0, help="Number of the first one.")
@click.option("--processes", default=multiprocessing.cpu_count(), help="How many at a time.")
def main(seed: str, programs: int, first: int, processes: int) -> None:
    """Hunt; exit code 1 when something differs."""
    jobs = [(seed, n, min(n + CHUNK, first + programs)) for n in range(first, first + programs, CHUNK)]
    total = Catch()
    with multiprocessing.Pool(processes) as pool, tqdm(total=programs, unit=" programs", smoothing=0.05) as bar:
        for caught in pool.imap_unordered(_share, jobs):
            for name, (_, number, small) in caught.found.items():
                if name not in total.found:
                    how = judge(small)[1].difference
                    bar.write(f"\n{name}\n  program {number} of seed {seed}: {how}\n{small}")
            total.add(caught)
            bar.update(caught.programs)
    print(f"{total.programs} programs, {total.blocks} blocks compared, {sum(total.aside.values())} set aside")
    for why, count in total.aside.most_common():
        print(f"{count:8} {why}")
    for name, (count, number, _) in sorted(total.found.items(), key=lambda one: -one[1][0]):
        print(f"{count:8} differ, first {number}: {name}")
    if total.found:
        raise SystemExit(1)


if __name__ == "__main__":
    main()
