"""The XY programs in examples/: what they share with those that were written by hand, and where they begin."""

from __future__ import annotations

import pytest
from rivalhelp import ROOT

from skg.ref import run as reference
from skg.rivals.xy import translate


def blocks(name: str) -> list[str]:
    return (ROOT / "examples" / f"{name}.3b").read_text().split()


def test_figure_1_is_the_tape_written_by_hand() -> None:
    assert blocks("xy-book-fig1") == blocks("xy-fig1-rep")


def test_star_is_cut_from_another_hole() -> None:
    """The one written by hand is entered at its hole; the book's comes from the middle and goes back there."""
    assert blocks("xy-book-star")[1:-2] == blocks("xy-star")[:-1]


#: Where the wire enters, µm (docs/spec/xy.md, section 10), and whether it runs counter-clockwise.
ENTRIES = {
    "xy-book-1-pointer": (83, 1498, False),
    "xy-book-2-hexagon": (12000, 0, False),
    "xy-book-star": (20000, 0, True),
    "xy-book-3-disc": (-2000, -9798, False),
    "xy-book-3-reversed": (-2000, -9798, True),
}


@pytest.mark.parametrize("name", ENTRIES)
def test_book_entry(name: str) -> None:
    result = reference(translate((ROOT / "examples" / f"{name}.xy").read_text()))
    x, y, left = ENTRIES[name]
    end = result.path[0].end
    assert (round(float(end.x) * 1000), round(float(end.y) * 1000)) == (x, y)
    # Twice the area of the corners alone tells the way round.
    area = sum(float(s.start.x * s.end.y - s.start.y * s.end.x) for s in result.path if s.role == "cut")
    assert (area > 0) == left


def test_reversed_disc_is_the_same_contour() -> None:
    ends = []
    for name in ("xy-book-3-disc", "xy-book-3-reversed"):
        result = reference(translate((ROOT / "examples" / f"{name}.xy").read_text()))
        ends.append([(round(float(s.start.x), 9), round(float(s.start.y), 9)) for s in result.path if s.role == "cut"])
    assert ends[0][1:] == ends[1][:0:-1]
    assert ends[0][0] == ends[1][0]
