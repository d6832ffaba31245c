"""Units that cannot be: a size that is round in others, a page that is a sheet of paper at another number of dots."""

from __future__ import annotations

from random import Random

import pytest
from test_budget import page
from test_reading import line, raw

from skg.messages.finding import Finding
from skg.reading.read import ReadOptions, read

INCH, MM = "9\n$INSUNITS\n70\n1\n", "9\n$INSUNITS\n70\n4\n"


def of_units(data: bytes, name: str = "a.dxf", **wishes: object) -> list[Finding]:
    """The findings about likely units."""
    codes = ("size-in-other-units", "size-in-dots", "page-in-dots")
    return [finding for finding in read(data, name, ReadOptions(**wishes)).report.report() if finding.code in codes]


def panel(width: float, height: float, header: str) -> bytes:
    corners = [(0, 0), (width, 0), (width, height), (0, height), (0, 0)]
    return raw(*(line(*p, *q) for p, q in zip(corners, corners[1:], strict=False)), header=header)


@pytest.mark.parametrize(("width", "height"), [(110, 90), (120, 80), (457, 302)])
def test_inches_that_are_marked_as_mm(width: float, height: float) -> None:
    """Written with four decimals; the likely unit and size are told, and what asks for it."""
    (finding,) = of_units(panel(round(width / 25.4, 4), round(height / 25.4, 4), MM))
    assert finding.severity.name == "CARE" and finding["units"] == "inch"
    assert (finding["wide"], finding["high"]) == pytest.approx((width, height), abs=0.003)
    assert not of_units(panel(round(width / 25.4, 4), round(height / 25.4, 4), MM), units="inch")


def test_mm_that_are_marked_as_inches() -> None:
    (finding,) = of_units(panel(21, 14, INCH))
    assert finding["units"] == "mm" and (finding["wide"], finding["high"]) == pytest.approx((21, 14))


@pytest.mark.parametrize("header", [MM, INCH])
def test_usual_sizes_raise_no_doubt(header: str) -> None:
    """Whole millimetres, tenths, eighths of an inch; of any numbers there are, hardly one in a thousand."""
    for width, height in ((110, 90), (110.5, 90.25), (25.4, 50.8), (12.125, 3.375)):
        assert not of_units(panel(width, height, MM))
    for width, height in ((4.5, 3.25), (2.125, 6.375)):
        assert not of_units(panel(width, height, INCH))
    rng = Random(1)
    doubts = sum(bool(of_units(panel(rng.uniform(5, 30), rng.uniform(5, 30), header))) for _ in range(300))
    assert doubts <= 1


RECTANGLE = '<rect x="10" y="10" width="{}" height="{}"/>'


@pytest.mark.parametrize("dots", [72, 150, 300])
@pytest.mark.parametrize(("paper", "sides"), [("A4", (210, 297)), ("A3", (420, 297))])
def test_a_page_in_dots(dots: int, paper: str, sides: tuple[float, float]) -> None:
    """A sheet that is drawn at another number of dots: which, and what size its part then has."""
    box = " ".join(str(round(side * dots / 25.4)) for side in sides)
    part = RECTANGLE.format(100.5 * dots / 25.4, 60.25 * dots / 25.4)
    for size in ('width="100%" height="100%" ', ""):
        (finding,) = of_units(page(part, f'{size}viewBox="0 0 {box}"'), "a.svg")
        assert (finding.code, finding["paper"], finding["dots"]) == ("page-in-dots", paper, dots)
        assert (finding["wide"], finding["high"]) == pytest.approx((100.5, 60.25))
    # A page that tells its width is no page in dots.
    assert not of_units(page(part, f'width="{sides[0]}mm" height="{sides[1]}mm" viewBox="0 0 {box}"'), "a.svg")


def test_a_size_in_dots() -> None:
    """A page of no paper's size, and a part that is round at 300 dots; none where the page is A4 at 96."""
    part = RECTANGLE.format(1181.1024, 708.6614)
    (finding,) = of_units(page(part, 'viewBox="0 0 2000 2000"'), "a.svg")
    assert finding.code == "size-in-dots" and finding["units"] == "300"
    assert (finding["wide"], finding["high"]) == pytest.approx((100, 60))
    assert not of_units(page(part, 'viewBox="0 0 794 1123"'), "a.svg")
    assert not of_units(page(RECTANGLE.format(96 / 25.4 * 100, 96 / 25.4 * 60), 'viewBox="0 0 2000 2000"'), "a.svg")
