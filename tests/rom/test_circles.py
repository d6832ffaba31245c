"""The parts in examples/circles: their tapes and pictures, and the subroutine that they share, tried on anything.

Run as a program, this writes tapes and pictures anew.
"""

from __future__ import annotations

import random
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest
from click.testing import CliRunner

sys.path.insert(0, str(Path(__file__).parent))

from circlehelp import LINE, Circle, Element, apart, asked, miss, solutions
from mpmath import mpf
from romhelp import ROOT, Board, run

from skg.cli import cli
from skg.ref import run as reference

FOLDER = ROOT / "examples" / "circles"
PICTURES = ROOT / "docs" / "pictures"
EXAMPLES = sorted(FOLDER.glob("*.skg"))
SHARED = "800 REM "

examples = pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)

START, X = ("P", 0, 0), ("S", 0, 0, 1, 0)
A1, B, C = ("S", 0, 0, 1, 0), ("S", 30, 0, 10, 24), ("S", 10, 24, 0, 0)
ON = ("M", 0, 0, 40, 20)
#: The elements of each circle that an example prints.
TOUCHED: dict[str, list[list[Element]]] = {
    "touch-circles": [
        [("C", 0, 0, 10), ("C", 40, 6, a), ("C", 14, 32, d)] for a in (8, -8) for d in (6, -6) for _ in range(2)
    ],
    "touch-lines": [
        [A1, B, C],
        [("S", 0, 0, -1, 0), B, C],
        [A1, ("S", 10, 24, 30, 0), C],
        [A1, B, ("S", 0, 0, 10, 24)],
    ],
    "touch-points": [
        [START, ("P", 30, 0), ("P", 8, 16)],
        [("P", 0, 40), ("P", 20, 46), ("S", 0, 34, 1, 34)],
        *[[("P", 60, 0), ("P", 80, 4), ("C", 72, 24, 6)]] * 2,
    ],
    "touch-mixed": [
        *[[X, ("P", 12, 5), ("S", 0, 20, 0, 0)]] * 2,
        [X, ("C", 50, 20, -6), ("P", 62, 10)],
        [("P", 90, 14), ("C", 80, 0, -5), ("C", 102, 2, -6)],
        *[[X, ("S", 0, 18, -1, 18), ("C", 140, 6, -4)]] * 2,
        [X, ("C", 180, 12, -5), ("C", 205, 9, -7)],
    ],
    "touch-radius": [
        [("A", 5), ("S", 0, 0, s, 0), ("C", 0, 3, c)] for c in (14, -14) for s in (1, -1) for _ in range(2)
    ],
    "touch-centred": [
        *[[ON, X, ("C", 50, 10, -8)]] * 2,
        [ON, ("P", -20, 6), ("C", -30, -24, -6)],
        *[[("M", 0, -60, 40, -50), ("A", 7), ("C", 20, -48, -6)]] * 2,
    ],
    "touch-concentric": [
        [("M", 10, 0, 10, 1), ("M", 0, 5, 1, 5), other]
        for other in (("S", 0, -4, 1, -4), ("C", 34, 15, -6), ("C", 34, 15, -6))
    ],
}


def printed(paper: str) -> list[Circle]:
    """The circles on the paper."""
    rows = [line.strip("()").split(",") for line in paper.splitlines() if line.startswith("(")]
    return [(mpf(x), mpf(y), mpf(r)) for x, y, r in rows]


def routine() -> str:
    """The subroutine."""
    text = (FOLDER / "touch-circles.skg").read_text()
    return text[text.index(SHARED) :]


@examples
def test_tape(path: Path) -> None:
    source, tape = path.read_text(), path.with_suffix(".3b").read_bytes()
    assert source.startswith("10 REM ")
    outcome, exact = run(source), reference(source)
    assert (outcome.error, exact.error) == (None, None)
    assert outcome.tape == exact.tape == tape


@examples
def test_its_circles(path: Path) -> None:
    """Every printed circle is exact to the last digit printed; no two are the same."""
    circles = printed("\n".join(run(path.read_text()).paper))
    elements = TOUCHED[path.stem]
    assert len(circles) == len(elements)
    for circle, touched in zip(circles, elements, strict=True):
        assert min(apart(circle, exact) for exact in solutions(touched) or []) <= 1e-6
    for i, circle in enumerate(circles):
        assert min((apart(circle, other) for other in circles[:i]), default=1) > 0.1


def test_one_subroutine() -> None:
    """It is the same, wherever it stands."""
    users = [path for path in EXAMPLES if SHARED in path.read_text()]
    assert len(users) >= 5
    for path in users:
        assert path.read_text().partition(SHARED)[2] == routine().removeprefix(SHARED)


def program(elements: list[Element]) -> str:
    """Both circles of three elements, with whole and broken part of each number printed apart."""
    text = "10 I=900\n"
    for n, each in enumerate(map(asked, elements), 2):
        text += f"{10 * n} {each.statement}\n{10 * n + 5} GOSUB {each.entry}\n"
    text += "100 GOSUB 860\n110 GOSUB 200\n120 GOSUB 970\n130 GOSUB 200\n140 END\n"
    for n in (1, 2, 3):
        text += f"{199 + n} PRINT INT K{n} T,K{n} T-INT K{n} T\n"
    return text + "210 RETURN\n" + routine()


def firmware(board: Board, elements: list[Element]) -> tuple[int | None, list[Circle]]:
    """Number of the error, and the circles until then."""
    outcome = board.outcome(program(elements))
    pairs = [line.split() for line in outcome.paper if not line.startswith("ERR")]
    numbers = [mpf(whole) + mpf(rest) for whole, rest in pairs]
    circles = [(numbers[i], numbers[i + 1], numbers[i + 2]) for i in range(0, len(numbers) - 2, 3)]
    return (outcome.error.number if outcome.error else None), circles


def triples(seed: int, count: int, whole: bool) -> Iterator[list[Element]]:
    """Any three elements; of small whole numbers many of them touch, lie in line, are parallel, are one."""
    dice = random.Random(seed)
    size = 6 if whole else 50

    def number() -> float:
        return dice.randint(-size, size) if whole else round(dice.uniform(-size, size), 4)

    def radius() -> float:
        return next(r for r in iter(number, None) if abs(r) > 0.5)

    for _ in range(count):
        kinds = [dice.choice("PCS"), dice.choice("PCS"), dice.choice("PCSMA")]
        dice.shuffle(kinds)
        elements: list[Element] = []
        for kind in kinds:
            x, y = number(), number()
            if kind in "SM":
                ends = iter(lambda: (number(), number()), None)
                elements.append(
                    (
                        kind,
                        x,
                        y,
                        *next(p for p in ends if abs(p[0] - x) + abs(p[1] - y) > 0.5),
                    )
                )
            elif kind == "A":
                elements.append((kind, radius()))
            else:
                elements.append((kind, x, y, radius()) if kind == "C" else (kind, x, y))
        yield elements


def judge(board: Board, elements: list[Element]) -> str:
    """Judges the result for three elements; an assertion fails if it is wrong."""
    error, circles = firmware(board, elements)
    exact = solutions(elements)
    if not exact:
        assert error == 6 or min(max(map(abs, circle)) for circle in circles) > LINE / 10, (elements, circles)
        return "many" if exact is None else "none"
    if error is not None:
        # A common point of all three is a circle of radius 0, which the language has not.
        assert error in (5, 6), elements
        assert any(abs(circle[2]) < 1e-6 for circle in exact), (elements, error, exact)
        return "point"
    for circle in circles:
        size = max(map(abs, circle))
        if size < 100:
            assert min(apart(circle, each) for each in exact) < 1e-6 or miss(elements, circle) < 3e-6, elements
        if size < 500:
            assert miss(elements, circle) < 1e-4, (elements, circle)
    for each in exact:
        size = max(map(abs, each))
        assert size > LINE / 10 or min(apart(each, circle) for circle in circles) < 1e-3 * size, (elements, each)
    return "touching" if len(exact) == 1 else "two"


@pytest.mark.parametrize(("seed", "whole"), [(11, True), (23, True), (5, False)])
def test_anything(seed: int, whole: bool) -> None:
    board = Board()
    seen = Counter(judge(board, elements) for elements in triples(seed, 160, whole))
    assert seen["two"] > 60
    assert seen["none"] > 40
    assert not whole or seen["touching"] > 4


@pytest.mark.parametrize(
    "elements",
    [
        [("P", 0, 0), ("P", 10, 0), ("P", 20, 0)],
        [("P", 1, 2), ("P", 1, 2), ("S", 0, 0, 1, 0)],
        [("C", 0, 0, 5), ("C", 0, 0, 5), ("C", 9, 0, 5)],
        [("S", 0, 0, 1, 0), ("S", 0, 5, 1, 5), ("S", 0, 9, 1, 9)],
        [("S", 0, 0, 1, 0), ("S", 0, 5, 1, 5), ("P", 3, 2)],
        [("P", 3, -2), ("S", 0, 0, 1, 0), ("S", 0, 5, -1, 5)],
    ],
    ids=[
        "in line",
        "one point twice",
        "one circle twice",
        "parallel",
        "parallel and a point",
        "beside the strip",
    ],
)
def test_there_is_none(elements: list[Element]) -> None:
    assert firmware(Board(), elements) == (6, [])
    assert not solutions(elements)


def test_one_of_the_two_is_nearly_a_line() -> None:
    elements = [("P", -16.0334, 14.4253), ("C", 32.4422, -16.8645, -10.2998), ("S", -26.2451, 26.179, 20.3542, 6.789)]
    assert judge(Board(), elements) == "touching"


def test_exchanging_two_elements_gives_the_other() -> None:
    board, tried = Board(), 0
    for elements in triples(77, 60, False):
        error, circles = firmware(board, elements)
        if error is None and max(abs(n) for circle in circles for n in circle) < 1000:
            first, second, third = elements
            _, swapped = firmware(board, [second, first, third])
            assert max(apart(a, b) for a, b in zip(circles, reversed(swapped), strict=True)) < 1e-4, elements
            _, turned = firmware(board, [second, third, first])
            assert max(apart(a, b) for a, b in zip(circles, turned, strict=True)) < 1e-4, elements
            tried += 1
    assert tried > 20


def plot(path: Path, picture: Path) -> None:
    done = CliRunner().invoke(cli, ["plot", str(path), "--skg80", "reference", "-o", str(picture)])
    assert done.exit_code == 0, done.output


@examples
def test_picture(path: Path, tmp_path: Path) -> None:
    picture = tmp_path / "part.svg"
    plot(path, picture)
    assert picture.read_bytes() == (PICTURES / f"{path.stem}.svg").read_bytes()


if __name__ == "__main__":
    for part in EXAMPLES:
        part.with_suffix(".3b").write_bytes(reference(part.read_text()).tape)
        with tempfile.TemporaryDirectory() as scratch:
            drawn = Path(scratch) / "part.svg"
            plot(part, drawn)
            (PICTURES / f"{part.stem}.svg").write_bytes(drawn.read_bytes())
