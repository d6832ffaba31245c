"""Contours found again in a drawing that was saved anew: the edits of a CAD program and of who draws."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest
from cuthelp import closed, drawing, polygon, saved
from matchhelp import EDITS, Count, counted, drawn_in, known
from toolhelp import ROOT

from skg.geometry.contour import Contour
from skg.job.job import Chosen
from skg.job.matching import Match
from skg.job.wanted import Overrides

PICTURES = ROOT / "docs" / "pictures"
#: Drawings of the project: one of CAD, plots with many small contours that look alike.
NAMES = (
    "bracket.dxf",
    "manual-bolts.svg",
    "manual-pocket.svg",
    "shop-die.svg",
    "xy-gear.svg",
    "punch.svg",
    "fit-gear.svg",
)


def box(x: float, y: float, width: float, height: float, layer: str = "0") -> Contour:
    return closed([(x, y), (x + width, y), (x + width, y + height), (x, y + height)], layer)


def plate(seed: int) -> list[Contour]:
    """A plate with holes on a grid, small whole numbers: many are alike, some touch."""
    random = Random(seed)
    contours = [box(0, 0, 60, 40)]
    for column in range(6):
        for row in range(4):
            if random.random() < 0.8:
                size = random.choice((1, 2, 2, 3)), random.choice((1, 2, 2, 3))
                contours.append(box(10 * column + random.randint(1, 5), 10 * row + random.randint(1, 5), *size))
    return contours


@pytest.fixture(scope="module")
def drawings() -> list[list[Contour]]:
    found = list(drawn_in([PICTURES / name for name in NAMES]))
    assert len(found) == len(NAMES)
    return [*found, *map(plate, range(12))]


@pytest.mark.parametrize("edit", EDITS)
@pytest.mark.parametrize("are_together", [True, False])
def test_edits(drawings: list[list[Contour]], edit: str, are_together: bool) -> None:
    """Nothing is found wrong in silence; what stays where it is, or moves as a whole, is found."""
    total = sum((counted(contours, edit, are_together) for contours in drawings), Count())
    every = sum(map(len, drawings))
    assert sum(vars(total).values()) == every > 300
    assert not total.wrong, total
    if edit in ("as it was", "shuffled", "all moved"):
        assert total.right == every, total
    elif edit != "a fifth replaced" and "5 mm" not in edit:
        # (one of the drawings has contours that lie on each other, within the noise)
        assert total.right > 0.97 * every and total.shown <= every / 100, total
    elif "5 mm" in edit:
        assert total.right > 0.7 * every and total.shown <= every / 200, total
    else:
        assert total.gone > 0.15 * every and total.right > 0.5 * every, total


def find(before: list[Contour], after: list[Contour], numbers: list[int]) -> tuple[list[int | None], list[Match]]:
    """The numbers that contours have after a change, and what is known of them."""
    old, new = known(before), known(after)
    matches = new.find([old.choose(number, Overrides()) for number in numbers], old.box)
    return [match.number for match in matches.found], list(matches.found)


def test_one_of_two_that_share_an_edge() -> None:
    """The middle of the longest edge is that of both: another place tells them apart."""
    contours = [box(0, 0, 10, 4), box(0, 4, 10, 4)]
    assert find(contours, contours, [0, 1])[0] == [0, 1]
    assert find(contours, contours[::-1], [1])[0] == [0]


def test_a_contour_between_two_is_lost() -> None:
    """It is no more than twice as near as the next one: none is meant."""
    contours = [box(0, 0, 50, 50), box(10, 10, 2, 2)]
    moved = [contours[0], box(10, 9.8, 2, 2), box(10, 10.25, 2, 2)]
    assert find(contours, moved, [1])[0] == [None]
    assert find(contours, [contours[0], box(10, 10.2, 2, 2)], [1])[0] == [1]
    assert find(contours, [contours[0], box(10, 10.6, 2, 2)], [1])[0] == [None]


def test_layer_and_kind() -> None:
    """Another layer, or an outline where an opening was, is another contour."""
    contours = [box(0, 0, 50, 50), box(10, 10, 5, 5, "A")]
    assert find(contours, [contours[0], box(10, 10, 5, 5, "B")], [1])[0] == [None]
    assert find(contours, [contours[0], box(10, 10, 5, 5, "a")], [1])[0] == [1]
    assert find(contours, [contours[1]], [1])[0] == [None]


def test_a_grid_moved_by_its_pitch() -> None:
    """Each hole lies where its neighbour was: all of the drawing has moved, and no hole is taken for its neighbour."""
    holes = [box(10 * at, 0, 2, 2) for at in range(5)]
    moved = [one.shifted((10.0, 0.0)) for one in holes]
    for numbers in ([0], [3], [0, 1, 2, 3, 4]):
        assert find(holes, moved, numbers)[0] == numbers
    assert known(moved).find([], known(holes).box).shift == (10.0, 0.0)
    # (one more on the left: the others have stayed)
    found, matches = find(holes, [box(-10, 0, 2, 2), *holes], [1, 2])
    assert found == [2, 3] and not any(match.is_doubtful for match in matches)


def test_two_that_become_one() -> None:
    """One contour is never found for two."""
    contours = [box(0, 0, 50, 50), box(10, 10, 2, 2), box(10, 12.3, 2, 2)]
    found, _ = find(contours, [contours[0], contours[1]], [1, 2])
    assert found == [1, None]


def test_a_place_that_nobody_chose() -> None:
    """By hand: any place on the contour will do, to a tenth of its size."""
    new = known([box(0, 0, 60, 40), box(10, 10, 5, 5)])
    for place in [(0.0, 20.0), (60.0, 0.0), (30.0, 40.0), (3.0, 43.0)]:
        match = new.find([Chosen("0", "outline", place, (60.0, 40.0))], None).found[0]
        assert match.number == 0 and match.is_doubtful == (place[1] > 40)


def test_a_drawing_saved_anew(tmp_path: Path) -> None:
    """A real file, its entities in another order and everything moved: through the reader."""
    found = []
    for shift in (0, 7):
        page = drawing()
        shapes = [(0, 0, 60, 40), (5, 5, 10, 10), (20, 5, 10, 10), (35, 5, 10, 10.2)]
        for x, y, width, height in shapes[:: -1 if shift else 1]:
            x += shift
            polygon([(x, y), (x + width, y), (x + width, y + height), (x, y + height)], page)
        found += map(known, drawn_in([saved(page, tmp_path)]))
    matches = found[1].find([found[0].choose(at, Overrides()) for at in range(4)], found[0].box)
    assert [match.number for match in matches.found] == [3, 2, 1, 0] and matches.shift == (7.0, 0.0)
