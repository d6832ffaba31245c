"""Planning with wishes per contour: left ones stay in the nesting, entries, start holes, order; small whole numbers."""

from __future__ import annotations

from dataclasses import replace
from math import dist

import pytest
from cuthelp import closed
from facthelp import pattern

from skg.cutting.ladder import make
from skg.errors import UserError
from skg.geometry.contour import Contour
from skg.job.job import Job
from skg.job.wanted import CutSettings
from skg.messages.finding import Phrase
from skg.planning.plan import plan

OFFSET = CutSettings(offset=0.1)


def box(left: float, low: float, width: float, height: float) -> Contour:
    """A rectangle."""
    return closed([(left, low), (left + width, low), (left + width, low + height), (left, low + height)])


def plate() -> list[Contour]:
    """An outline with two openings; an island in the second."""
    return [box(0, 0, 40, 20), box(4, 4, 8, 8), box(20, 4, 12, 12), box(24, 8, 4, 4)]


def cut(contours: list[Contour], wanted: list[CutSettings]) -> list[int]:
    """The numbers of the contours in the order in which a checked tape cuts them."""
    return [planned.number for planned in make(plan(contours, [], wanted), Job("plate")).contours]


def test_what_is_left_stays_in_the_nesting() -> None:
    """An opening is cut from inside whether its outline is cut or not."""
    wanted = [replace(OFFSET, cut=False), OFFSET, OFFSET, replace(OFFSET, cut=False)]
    contours = plan(plate(), [], wanted)
    assert sorted(planned.number for planned in contours) == [1, 2]
    assert not any(planned.is_outside for planned in contours)
    assert set(cut(plate(), wanted)) == {1, 2}


def test_each_contour_has_its_own_offset_passes_and_tab() -> None:
    wanted = [
        replace(OFFSET, passes=(0.06, 0.02, 0.0), tab=2.0),
        OFFSET,
        replace(OFFSET, offset=0.15),
        replace(OFFSET, offset=0.0),
    ]
    contours = {planned.number: planned for planned in plan(plate(), [], wanted)}
    assert [round(r, 9) for r in contours[0].passes] == [0.16, 0.12, 0.1] and contours[0].tabs.length == 2.0
    assert [contours[at].passes for at in (1, 2, 3)] == [(0.1,), (0.15,), (0.0,)]


@pytest.mark.parametrize("place", [(20, 0), (0, 7), (33, 20), (40, 19.99), (0, 0)])
def test_entry_and_start_hole(place: tuple[float, float]) -> None:
    """A contour is entered at the place that is wanted, but not in a corner; the start hole is where it is wanted."""
    wanted = replace(OFFSET, entry=place)
    (chosen,) = plan([plate()[0]], [], wanted)
    assert dist(chosen.entry, place) < 0.5 and chosen.is_square
    hole = (45.0, 24.0) if place[1] > 10 else (-5.0, -4.0)  # (on the side of the entry)
    (given,) = plan([plate()[0]], [], replace(wanted, start=hole))
    assert given.start == hole and dist(given.entry, place) < 0.5
    assert len(make([chosen], Job("plate")).tape.blocks) >= 6


def test_order() -> None:
    """Wanted places in the order hold; the others keep theirs."""
    holes = [box(0, 0, 40, 20), *(box(4 + 6 * at, 4, 4, 4) for at in range(5))]
    plain = [planned.number for planned in plan(holes, [], OFFSET)]
    assert plain == [1, 2, 3, 4, 5, 0]
    wanted = [OFFSET] * 6
    wanted[5], wanted[1] = replace(OFFSET, order=1), replace(OFFSET, order=3)
    assert cut(holes, wanted) == [5, 2, 1, 3, 4, 0]
    wanted[0] = replace(OFFSET, order=2)
    with pytest.raises(
        UserError,
        match=pattern(
            Phrase(
                "outer-first",
                outer=Phrase("contour-name", start=(0, 0)),
                inner=Phrase("contour-name", kind=Phrase("kind-opening", count=1)),
            )
        ),
    ):
        plan(holes, [], wanted)


def test_start_holes_of_the_drawing_go_to_what_is_cut() -> None:
    """A start hole in an opening that is left, or that has its own, goes to none of these."""
    wanted = [replace(OFFSET, cut=False), replace(OFFSET, start=(6.0, 6.0)), OFFSET, replace(OFFSET, cut=False)]
    contours = {planned.number: planned for planned in plan(plate(), [(21.5, 10.0)], wanted)}
    assert contours[1].start == (6.0, 6.0) and contours[2].start == (21.5, 10.0)
    with pytest.raises(UserError, match=pattern(Phrase("too-many-holes", count=2, contours=1))):
        plan(plate(), [(21.5, 10.0), (1.0, 1.0)], wanted)


def test_a_start_hole_goes_to_the_contour_that_comes_nearest() -> None:
    """The middle of a long edge is nearer to it than another contour's corners are."""
    for start in [(20.0, -3.0), (20.0, 23.0), (-3.0, 10.0), (43.0, 10.0)]:
        contours = plan(plate(), [start], [OFFSET] * 4)
        assert {planned.number: planned.start for planned in contours}[0] == start
