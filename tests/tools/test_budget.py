"""Small drawings that grow when they are read: refused, by the limit that they pass; numbers without a meaning."""

from __future__ import annotations

import gzip
from collections.abc import Callable
from math import cos, pi, sin
from pathlib import Path

import pytest
from facthelp import says
from test_reading import checked, raw, square
from toolhelp import Run

from skg.errors import UserError
from skg.messages.finding import Phrase
from skg.reading import budget
from skg.reading.read import Reading, ReadOptions, read

RECTANGLE = '<rect width="9" height="9"/>'


def page(inner: str, attributes: str = 'width="100mm" height="100mm" viewBox="0 0 100 100"') -> bytes:
    return f'<svg xmlns="http://www.w3.org/2000/svg" {attributes}>{inner}</svg>'.encode()


def blocks(levels: int, copies: int, leaf: str = "") -> bytes:
    """Blocks in blocks, each with so many of the next one."""

    def insert(level: int, x: int) -> str:
        return f"0\nINSERT\n8\n0\n2\nB{level}\n10\n{x}\n20\n0\n"

    text = "0\nSECTION\n2\nBLOCKS\n"
    for level in range(levels):
        inner = "".join(insert(level + 1, x) for x in range(copies))
        text += f"0\nBLOCK\n2\nB{level}\n10\n0\n20\n0\n{inner}0\nENDBLK\n"
    text += f"0\nBLOCK\n2\nB{levels}\n10\n0\n20\n0\n{leaf}0\nENDBLK\n0\nENDSEC\n"
    return text.encode() + raw("INSERT 8 0 2 B0 10 0 20 0")


def uses(levels: int, copies: int, leaf: str = "") -> bytes:
    """The same of SVG."""
    groups = "".join(
        f'<g id="g{level}">' + f'<use href="#g{level + 1}" x="1"/>' * copies + "</g>" for level in range(levels)
    )
    return page(f'<defs>{groups}<g id="g{levels}">{leaf}</g></defs><use href="#g0"/>')


def vertices(count: int) -> list[tuple[str, str]]:
    return [(f"{50 + 40 * cos(t):.5f}", f"{50 + 40 * sin(t):.5f}") for t in (2 * pi * k / count for k in range(count))]


def polyline(count: int) -> bytes:
    return raw(f"LWPOLYLINE 8 0 90 {count} 70 1 " + " ".join(f"10 {x} 20 {y}" for x, y in vertices(count)))


def path(count: int) -> bytes:
    return page('<path d="M' + " ".join(f"{x},{y}" for x, y in vertices(count)) + 'Z"/>')


MANY = f"{budget.MOST_ENTITIES:,}"
#: Drawings of some kilobytes, in which millions of entities are shown.
GROWING = {
    "blocks.dxf": blocks(8, 10, "0\nLINE\n8\n0\n10\n0\n20\n0\n11\n1\n21\n0\n"),
    "empty.dxf": blocks(9, 9),
    "array.dxf": blocks(1, 1).replace(b"2\nB0\n", b"2\nB0\n70\n30000\n71\n30000\n"),
    "use.svg": uses(8, 10, '<rect width="1" height="1"/>'),
    "nothing.svg": uses(9, 9),
}


@pytest.mark.parametrize("name", GROWING)
def test_what_grows_is_refused(name: str) -> None:
    with pytest.raises(UserError) as refused:
        read(GROWING[name], name)
    assert says(refused.value, name, Phrase("over-budget", most=budget.MOST_ENTITIES))


@pytest.mark.parametrize(
    ("limit", "name", "make"),
    [
        ("MOST_VERTICES", "polyline.dxf", polyline),
        ("MOST_VERTICES", "path.svg", path),
        ("MOST_BYTES", "packed.svgz", lambda count: gzip.compress(page('<g id="' + "a" * count + '"/>' + RECTANGLE))),
        ("MOST_TRIES", "rules.svg", lambda count: page("<style>" + "*{fill:red}" * count + "</style>" + RECTANGLE)),
        (
            "MOST_PAIRS",
            "near.svg",
            lambda count: page("".join(f'<circle cx="{k / 1e3}" r="9"/>' for k in range(count))),
        ),
    ],
)
def test_limits(limit: str, name: str, make: Callable[[int], bytes], monkeypatch: pytest.MonkeyPatch) -> None:
    """With the limits made small: half as much is read, twice as much is refused."""
    most = 1000
    monkeypatch.setattr(budget, limit, most)
    much = {"MOST_PAIRS": (10, 60)}.get(limit, (most // 4, 2 * most))
    assert read(make(much[0]), name).contours
    with pytest.raises(UserError) as refused:
        read(make(much[1]), name)
    assert says(refused.value, name, Phrase("over-budget", most=most))


def test_the_command_says_it_too(run: Run, tmp_path: Path) -> None:
    drawing = tmp_path / "blocks.dxf"
    drawing.write_bytes(GROWING["blocks.dxf"])
    for options in (["--quiet", "-o", tmp_path / "a.3b"], ["--list-layers"]):
        with pytest.raises(UserError, match=MANY) as refused:
            run("cut", drawing, *options)
        assert says(refused.value, "blocks.dxf")


def test_what_is_less_is_read() -> None:
    """Blocks and groups that hold copies, packed drawings, rules, copies of one shape."""
    assert len(checked(blocks(3, 9, "0\nCIRCLE\n8\n0\n10\n0\n20\n0\n40\n3\n")).contours) == 25
    for data, name in (
        (uses(3, 10, RECTANGLE), "a.svg"),
        (gzip.compress(page(RECTANGLE)), "a.svgz"),
        (page("<style>g g rect{fill:red}</style><g><g>" + RECTANGLE * 5000 + "</g></g>"), "a.svg"),
    ):
        assert read(data, name).contours
    assert len(checked(polyline(3000)).contours[0].edges) == 3000


def test_a_rule_that_asks_in_too_many_ways_is_not_understood() -> None:
    """945 bytes would take half a minute."""
    data = page(
        "<style>x g g g g rect{display:none}</style>" + "<g>" * 100 + '<rect width="9" height="9"/>' + "</g>" * 100
    )
    assert any(says(note, Phrase("rules-missed", count=1)) for note in read(data, "a.svg").report.findings)


def svg_of(inner: str) -> Reading:
    return read(page('<rect x="1" y="1" width="20" height="20"/>' + inner), "a.svg", ReadOptions())


@pytest.mark.parametrize(
    "transform",
    [
        "scale(nan)",
        "scale(2",
        "scale()",
        "scale(2,3,4)",
        "foo(2)",
        "matrix(1 0 0 1 5)",
        "rotate(1e400)",
        "rotate(5 6)",
        "2",
    ],
)
def test_a_transform_that_is_none(transform: str) -> None:
    """Its element is listed, not shown at the place that it would have without."""
    reading = svg_of(f'<g transform="{transform}"><rect width="9" height="9"/></g>')
    assert len(reading.contours) == 1 and [entity.kind for entity in reading.report.not_understood] == ["g"]


@pytest.mark.parametrize(
    "transform",
    [
        "translate(5)",
        "translate(5-6) scale(.5,2),rotate(45)",
        "rotate(30 5 5)",
        "matrix(1 0 0 1 5,6)",
        "skewX(10)",
        "none",
        " ",
    ],
)
def test_transforms(transform: str) -> None:
    reading = svg_of(f'<rect width="9" height="9" transform="{transform}"/>')
    assert len(reading.contours) == 2


@pytest.mark.parametrize(
    "attributes",
    [
        'width="100mm" height="100mm" viewBox="0 0 nan 5"',
        'width="100mm" height="100mm" viewBox="0 0 5"',
        'width="100mm" height="100mm" viewBox="0 0 1e400 5"',
        'width="1e400mm" height="100mm" viewBox="0 0 5 5"',
        'width="0mm" height="100mm" viewBox="0 0 5 5"',
    ],
)
def test_a_page_that_is_none(attributes: str) -> None:
    with pytest.raises(UserError, match="page"):
        read(page('<rect width="9" height="9"/>', attributes), "a.svg")


def test_numbers_that_are_too_large() -> None:
    """An angle that has no direction, a count without end: no Python in the reason."""
    odd = ["ARC 8 0 10 5 20 5 40 3 50 0 51 1e300", "ELLIPSE 8 0 10 5 20 5 11 1 21 1 40 .5 41 0 42 1e400",
           "LWPOLYLINE 8 0 90 2 70 1e400 10 0 20 0 10 9 20 0", "LINE 8 0 62 1e400 10 0 20 0 11 9 21 1"]  # fmt: skip
    reading = checked(raw(*square(0, 0, 9), *odd))
    reasons = [entity.reason for entity in reading.report.not_understood]
    assert len(reasons) == len(odd)
    assert all(why.code in ("reason-too-large", "lack-angle") for why in reasons)
