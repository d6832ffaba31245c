"""SVG drawings: what is shown of them, where, and that the rest is said."""

from __future__ import annotations

import pytest
from facthelp import each_says, pattern, says
from test_reading import checked, left

from skg.errors import UserError
from skg.geometry.plane import XY
from skg.messages.finding import Phrase
from skg.reading.read import Reading, ReadOptions, read

PART = '<rect x="10" y="10" width="20" height="10"/>'
WHERE = (10, 80, 30, 90)
Box = tuple[float, float, float, float]


def page(content: str, size: str = 'width="100mm" height="100mm" viewBox="0 0 100 100"') -> bytes:
    spaces = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    return f"<svg {spaces} {size}>{content}</svg>".encode()


def reading_of(data: bytes) -> Reading:
    return checked(data, units=None)


def boxes(reading: Reading) -> list[Box]:
    """The box of each contour, sorted: smallest x and y, largest x and y."""
    found = []
    for contour in reading.contours:
        places: list[XY] = [place for edge in contour.edges for place in edge.extremes()]
        xs, ys = zip(*places, strict=True)
        found.append(tuple(round(ordinate, 6) for ordinate in (min(xs), min(ys), max(xs), max(ys))))
    return sorted(found)


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        # Nested drawings: their frame, their view box, in the middle of it.
        ('<svg x="50" y="30" width="40" height="40" viewBox="0 0 20 20"><rect width="5" height="10"/></svg>',
         [(50, 50, 60, 70)]),
        ('<svg x="50" y="30" width="60" height="40" viewBox="0 0 20 20"><rect width="5" height="10"/></svg>',
         [(60, 50, 70, 70)]),
        ('<svg x="50%" y="0"><rect width="50%" height="10%"/></svg>', [(50, 90, 100, 100)]),
        # What is used: moved, turned, once each time; a symbol fills the frame of its use, and is not shown itself.
        ('<defs><rect id="r" width="5" height="5"/></defs><use xlink:href="#r" x="20" y="20"/>'
         '<use href="#r" transform="translate(40 40) rotate(90)"/>', [(20, 75, 25, 80), (35, 55, 40, 60)]),
        ('<symbol id="s" viewBox="0 0 10 10"><rect width="10" height="5"/></symbol>'
         '<use xlink:href="#s" x="20" y="20" width="20" height="20"/>', [(20, 70, 40, 80)]),
        ('<defs><rect id="r" width="5" height="5"/><g id="g"><use href="#r" x="3"/></g></defs>'
         '<use href="#g" x="20"/>', [(23, 95, 28, 100)]),
        # Style sheets move things, too; the element's own style comes last.
        ("<style>.q{transform:translate(20px,0)}</style><rect class='q' width='5' height='5'/>", [(20, 95, 25, 100)]),
        ("<style>g .q{transform:translate(9px)} #a{transform:translate(7px)}</style>"
         "<g><rect id='a' class='q' width='5' height='5' style='transform:translate(30px,0)'/></g>",
         [(30, 95, 35, 100)]),
        # What stands in another, and what stands right in it, which is to be found from the inside out.
        ("<style>g > .q{transform:translate(9px)} svg > g .q{transform:translate(20px)}</style>"
         "<a><g><a><rect class='q' width='5' height='5'/></a></g></a>", [(0, 95, 5, 100)]),
        ("<style>svg > g a > .q{transform:translate(9px)}</style>"
         "<g><a><g><a><rect class='q' width='5' height='5'/></a></g></a></g>", [(9, 95, 14, 100)]),
        # What is important goes before the element's own style, and that before what is not.
        ("<style>.q{transform:translate(9px) ! important} #a{transform:translate(3px)}</style>"
         "<rect id='a' class='q' width='5' height='5' style='transform:translate(30px,0)'/>", [(9, 95, 14, 100)]),
        ("<style>.q{transform:translate(9px)!important}</style>"
         "<rect class='q' width='5' height='5' style='transform:translate(30px,0)!IMPORTANT'/>", [(30, 95, 35, 100)]),
        # Attributes, what has no mark, what stands behind another, the third of its kind; name spaces, remarks.
        ("<style>*[layer='1']{transform:translate(9px)} g[layer] rect:not([layer]){transform:translate(20px)}</style>"
         "<rect layer='1' width='5' height='5'/><g layer='2'><rect width='5' height='5'/></g>",
         [(9, 95, 14, 100), (20, 95, 25, 100)]),
        ("<style>circle + rect, rect:nth-of-type(3){transform:translate(9px)} a + rect{transform:none}</style>"
         "<rect width='5' height='5'/><circle cx='50' cy='50' r='2'/><rect width='5' height='5'/>"
         "<rect y='9' width='5' height='5'/>",
         [(0, 95, 5, 100), (9, 86, 14, 91), (9, 95, 14, 100), (48, 48, 52, 52)]),
        ("<style>@namespace s url(http://www.w3.org/2000/svg); @namespace 'http://www.w3.org/1999/xhtml';"
         "@media all{s|rect{/* 9; */transform:/**/translate(9px)/**/}} rect{transform:none}</style>"
         "<style media='print'>*{display:none}</style><rect width='5' height='5'/>", [(9, 95, 14, 100)]),
        # What is used knows of nothing around it, neither where it stands nor where it is shown.
        ("<style>.in > rect, use rect, .out rect, rect:root{transform:translate(9px)} rect{x:3px}</style>"
         "<defs><g class='in'><rect id='r' width='5' height='5'/></g></defs><g class='out'><use href='#r'/></g>",
         [(3, 95, 8, 100)]),
        ("<style>.in > rect{transform:translate(9px)}</style>"
         "<defs><g class='in' id='g'><rect width='5' height='5'/></g></defs><use href='#g'/>", [(9, 95, 14, 100)]),
        # A transform turns about its origin: lengths, parts of the view box, sides.
        ('<rect width="5" height="10" transform="rotate(90)" transform-origin="20 30"/>', [(40, 85, 50, 90)]),
        ('<rect width="5" height="10" style="transform:rotate(90deg);transform-origin:20% 30px"/>', [(40, 85, 50, 90)]),
        ('<rect width="5" height="10" style="transform:scale(2);transform-origin:bottom left"/>',
         [(0, 180, 10, 200)]),
        ("<style>@media screen{.q{transform:translate(20px,0)}} @media print{.q{display:none}}</style>"
         "<rect class='q' width='5' height='5'/>", [(20, 95, 25, 100)]),
        ('<circle cx="50" cy="50" r="10%"/>', [(40, 40, 60, 60)]),
        ('<ellipse cx="50" cy="50" rx="10"/>', [(40, 40, 60, 60)]),
        ('<rect x="1cm" y="10" width="10" height="5pt"/>', [(37.795276, 83.333333, 47.795276, 90)]),
        # One word alone is that side, the other one is the middle.
        ('<rect width="5" height="10" style="transform:scale(2);transform-origin:bottom"/>', [(-50, 180, -40, 200)]),
        ('<rect width="5" height="10" style="transform:scale(2);transform-origin:right"/>', [(-100, 130, -90, 150)]),
        # A radius below 0 is not told: the corner is as round as the other one says.
        ('<rect x="10" y="10" width="20" height="10" rx="5" ry="-9"/><circle cx="20" cy="15" r="1"/>',
         [(10, 80, 30, 90), (19, 84, 21, 86)]),
        ('<ellipse cx="50" cy="50" rx="-7" ry="10"/>', [(40, 40, 60, 60)]),
        # A drawing that is used keeps its own place; a symbol may be turned.
        ('<defs><svg id="s" x="40" y="40" width="80" height="80"><rect width="5" height="5"/></svg></defs>'
         '<use href="#s" x="3" height="100"/>', [(43, 55, 48, 60)]),
        ('<symbol id="s" transform="scale(2)"><rect width="5" height="5"/></symbol><use href="#s" x="20"/>',
         [(20, 90, 30, 100)]),
        # The form may be told as properties: a style sheet goes before attributes.
        ('<style>rect{width:20px} #a{height:9px}</style><rect id="a" width="5" style="x:3px;y:1px"/>',
         [(3, 90, 23, 99)]),
        ("""<path style="d:path('M 5 5 h 10 v 10 z')"/>""", [(5, 85, 15, 95)]),
    ],
)  # fmt: skip
def test_places(content: str, expected: list[Box]) -> None:
    assert boxes(reading_of(page(content))) == pytest.approx(expected, abs=1e-5)


@pytest.mark.parametrize(
    ("smooth", "same"),
    [
        ("C 10 0 20 0 20 10 S 30 20 30 10", "C 10 0 20 0 20 10 C 20 20 30 20 30 10"),
        ("Q 20 0 30 10 T 50 10", "Q 20 0 30 10 Q 40 20 50 10"),
        # Behind a curve of another kind they begin as behind a line.
        ("C 10 0 20 0 20 10 T 30 12 T 40 10", "C 10 0 20 0 20 10 Q 20 10 30 12 Q 40 14 40 10"),
        ("Q 20 0 30 10 S 40 20 50 10", "Q 20 0 30 10 C 30 10 40 20 50 10"),
        ("H 20 S 40 20 50 10", "H 20 C 20 10 40 20 50 10"),
    ],
)
def test_smooth_curves(smooth: str, same: str) -> None:
    one, other = (reading_of(page(f'<path d="M 10 10 {data} V 60 z"/>')).contours for data in (smooth, same))
    assert [edge.nodes for edge in one[0].edges] == [edge.nodes for edge in other[0].edges]
    assert any(edge.nodes for edge in one[0].edges)


@pytest.mark.parametrize(
    ("size", "expected"),
    [
        ('width="100mm" height="50mm" viewBox="0 0 100 100"', (25, 0, 75, 50)),
        ('width="100mm" height="50mm" viewBox="0 0 100 100" preserveAspectRatio="none"', (0, 0, 100, 50)),
        ('width="100mm" height="50mm" viewBox="0 0 100 100" preserveAspectRatio="xMaxYMin meet"', (50, 0, 100, 50)),
        ('width="100mm" height="50mm" viewBox="0 0 100 100" preserveAspectRatio="xMidYMax slice"', (0, 0, 100, 100)),
        ('width="100mm" viewBox="0 0 100 100"', (0, 0, 100, 100)),
        ('height="100mm" viewBox="0 0 50 100"', (0, 0, 100, 100)),
        ('width="2in" height="2in" viewBox="0 0 100 100"', (0, 0, 50.8, 50.8)),
        # A page that is as large as its window has the pixels of its view box.
        ('width="100%" height="100%" viewBox="0 0 960 960"', (0, 227.541667, 26.458333, 254)),
        ('viewBox="0 0 960 960"', (0, 227.541667, 26.458333, 254)),
        ('width="100mm" height="100mm"', (0, 73.541667, 26.458333, 100)),
    ],
)
def test_pages(size: str, expected: Box) -> None:
    (box,) = boxes(reading_of(page('<rect width="100" height="100"/>', size)))
    assert box == pytest.approx(expected, abs=1e-5)


@pytest.mark.parametrize(
    ("content", "why"),
    [
        ("<style>.h{display:none}</style><rect class='x h' width='5' height='5'/>", "reason-not-displayed"),
        (
            "<style>#k, .b {display : none !important}</style><g id='k'><rect width='5' height='5'/></g>",
            "reason-not-displayed",
        ),
        ("<style>g>rect.h{visibility:hidden}</style><g><rect class='h' width='5' height='5'/></g>", "reason-invisible"),
        ("<g display='none'><rect display='inline' width='5' height='5'/></g>", "reason-not-displayed"),
        ("<g opacity='0.0'><rect width='5' height='5'/></g>", "reason-invisible"),
        ("<rect width='5' height='5' fill='none'/>", "reason-unpainted"),
        ("<switch><g><path d='M0 0'/></g><rect width='5' height='5'/></switch>", "reason-not-displayed"),
        ("<switch><rect systemLanguage='de' width='5' height='5'/><g/></switch>", "reason-not-displayed"),
        ("<g xmlns=''><rect width='5' height='5'/></g>", "reason-name-space"),
        ("<x:rect xmlns:x='urn:x' width='5' height='5'/>", "reason-name-space"),
        ("<use href='#nothing'/>", Phrase("reason-link-lost", link="#nothing")),
        ("<g id='g'><use href='#g'/></g>", Phrase("reason-link-itself", link="#g")),
        ("<path d='M0 0 L 5 5 Q 3 X 4'/>", Phrase("reason-unread", what=Phrase("unread-path-at", found="X 4"))),
        ("<path d='M0 0 L 5 5 Q 3 4'/>", Phrase("reason-unread", what=Phrase("unread-path"))),
        (
            "<path d='M0 0 H 5 V 5 z # M1 1 H 2 V 2 z'/>",
            Phrase("reason-unread", what=Phrase("unread-path-at", found="# M1 1 H 2")),
        ),
        ("<path d='L 5 5 H 9 z'/>", Phrase("reason-unread", what=Phrase("unread-path-at", found="L 5 5 H 9 "))),
        ("<polygon points='0,0 5,0 5;5'/>", Phrase("reason-unread", what=Phrase("unread-points"))),
        ("<polyline points='0 0 5 0 5'/>", Phrase("reason-unread", what=Phrase("unread-points"))),
        ("<rect width='2em' height='5'/>", Phrase("reason-unread", what=Phrase("unread-length", text="2em"))),
        (
            "<rect width='calc(9px + 1mm)' height='5'/>",
            Phrase("reason-unread", what=Phrase("unread-length", text="calc(9px + 1mm)")),
        ),
        ("<rect width='5' height='5' fill-opacity='0'/>", "reason-unpainted"),
        ("<g fill='#fff0'><rect width='5' height='5' stroke='red' stroke-width='0'/></g>",
         "reason-unpainted"),
        ("<g fill='none' stroke-opacity='0%'><rect width='5' height='5' stroke='red'/></g>",
         "reason-unpainted"),
        ("<rect width='5' height='5' fill='rgba(9,9,9,0.0)'/>", "reason-unpainted"),
        ("<rect width='5' height='5' fill='rgb(9 9 9 / 0%)'/>", "reason-unpainted"),
        ("<rect width='5' height='5' fill='hsla(9, 9%, 9%, .0)'/>", "reason-unpainted"),
        (
            "<rect width='5' height='5' transform='matrix(1 2)'/>",
            Phrase("reason-unread", what=Phrase("unread-transform", text="matrix(1 2)")),
        ),
        (
            "<rect width='5' height='5' transform='scale(2)' style='transform-origin:1px 1px;transform-box:fill-box'/>",
            Phrase("reason-unread", what=Phrase("unread-origin", text="1px 1px, fill-box")),
        ),
        ("<text>a</text>", "reason-text-to-paths"),
        ("<g transform='scale(1,0)'><rect width='5' height='5'/></g>",
         "reason-no-area"),
    ],
)  # fmt: skip
def test_what_is_not_shown_is_left(content: str, why: str | Phrase) -> None:
    reading = reading_of(page(PART + content))
    assert boxes(reading) == [WHERE]
    assert why in left(reading)


@pytest.mark.parametrize("where", ["clipPath", "mask", "marker", "pattern", "defs", "symbol"])
def test_what_is_kept_for_use_is_not_drawn(where: str) -> None:
    reading = reading_of(page(f'<{where} id="c"><rect width="5" height="5"/></{where}>' + PART))
    assert boxes(reading) == [WHERE]
    assert left(reading) == {}


@pytest.mark.parametrize(
    ("content", "note"),
    [
        ('<g clip-path="url(#c)">%s</g>', [Phrase("seen-clipped", count=1, layer="0", place=(10, 90))]),
        # What a browser does not show since it lies outside a frame or the page.
        ('<svg x="5" width="9" height="9">%s</svg>', [Phrase("seen-clipped", count=1, layer="0", place=(15, 90))]),
        ('<svg width="90" height="19">%s</svg>', [Phrase("seen-clipped", count=1, layer="0", place=(10, 90))]),
        ('<svg width="90" height="20.01">%s</svg>', []),
        ('<svg width="9" height="9" style="overflow:visible">%s</svg>', []),
        ('<g transform="rotate(90)"><svg y="-90" width="90" height="90">%s</svg></g>', []),
        ('<g transform="translate(-15)">%s</g>',
         [Phrase("seen-outside", count=1, layer="0", place=(-5, 90))]),
        ('<g transform="translate(0 300)">%s</g>',
         [Phrase("seen-outside", count=1, layer="0", place=(10, -210))]),
        ('<g style="mask:url(#c)">%s</g>', [Phrase("seen-clipped", count=1, layer="0", place=(10, 90))]),
        ('<g stroke="red" stroke-width=".6" transform="scale(2) translate(-5,-5)">%s</g>',
         [Phrase("seen-wide", count=1, wide=1, layer="0", place=(10, 90))]),
        ('<g stroke="red" stroke-dasharray="2,1">%s</g>',
         [Phrase("seen-dashed", count=1, layer="0", dashes="stroke-dasharray", place=(10, 90))]),
        ('<g fill="none">%s</g>',
         [Phrase("seen-unpainted", count=1, layer="0", place=(10, 90))]),
        ("<style>rect ~ rect{stroke:red} a:hover{color:red}</style>%s",
         [Phrase("rules-missed", count=1, first="rect ~ rect")]),
        ("<style>rect:odd(x), rect{stroke:red}</style>%s",
         [Phrase("rules-missed", count=1, first="rect:odd(x), rect")]),
        ("<style>svg{fill:red; rect{fill:none}} a{cursor:text}</style>%s",
         [Phrase("rules-missed", count=1, first="svg")]),
        ("<style>@media (min-width:9px){rect{fill:red}}</style>%s",
         [Phrase("rules-missed", count=1, first="@media (min-width:9px)")]),
    ],
)  # fmt: skip
def test_what_is_guessed_is_said(content: str, note: list[Phrase]) -> None:
    reading = reading_of(page(content % PART))
    assert len(reading.contours) == 1
    assert any(says(told, *note) for told in reading.report.findings) if note else not reading.report.findings
    content = '<g stroke="red" stroke-width="0.9" stroke-dasharray="none">%s</g>'
    assert reading_of(page(content % PART)).report.findings == []


@pytest.mark.parametrize("selector", ["a " * 3000 + "a", "a+" * 300 + "a", "|", "a:is()|"])
def test_a_selector_that_breaks_its_reader_is_said(selector: str) -> None:
    (note,) = reading_of(page(f"<style>{selector}{{fill:red}}</style>{PART}")).report.findings
    assert says(note, Phrase("rules-missed", count=1, first=selector))


@pytest.mark.parametrize("sheet", ["a{" * 3000, "@media screen{" * 3000, ":not(" * 3000 + "a" + ")" * 3000 + "{r:1}"])
def test_style_sheets_that_are_too_deep(sheet: str) -> None:
    with pytest.raises(UserError, match=pattern(Phrase("sheet-too-deep"))):
        reading_of(page(f"<style>{sheet}</style>{PART}"))


@pytest.mark.parametrize(
    ("before", "content"),
    [('<?xml-stylesheet type="text/css" href="more.css"?>', ""), ("", '<style>@import url("more.css");</style>')],
)
def test_style_sheets_in_other_files_are_said(before: str, content: str) -> None:
    reading = reading_of(before.encode() + page(content + PART))
    assert each_says(reading.report.findings, (Phrase("sheet-elsewhere", name="more.css")))
    assert boxes(reading) == [WHERE]


def test_a_page_that_is_transformed_itself_is_said() -> None:
    reading = reading_of(page(PART, 'width="100mm" height="100mm" viewBox="0 0 100 100" transform="scale(4)"'))
    assert each_says(reading.report.findings, (Phrase("page-transformed", transform="scale(4)")))


@pytest.mark.parametrize(
    "colour",
    ["rgb(0,0,0)", "rgb(0%, 0%, 0%)", "rgb(255,0,0)", "rgb(9 9 0)", "hsl(9, 9%, 0%)", "rgba(0,0,0,1)", "rgb(0 0 0 / 1)",
     "rgba(0, 0, 0, 0.5)", "#f00", "#ff0000", "#f0f8"],
)  # fmt: skip
def test_a_colour_whose_last_number_is_nothing_is_seen(colour: str) -> None:
    """Only a fourth one makes it clear."""
    assert boxes(reading_of(page(f"<g fill='none' stroke='{colour}'>{PART}</g><circle r='9'/>")))[1:] == [WHERE]


@pytest.mark.parametrize(
    ("style", "is_seen"),
    [
        ("stroke:var(--ink)", True),
        ("stroke:var(--none)", False),
        ("stroke:var( --more , #0000)", False),
        ("stroke:var(--more, rgb(0,0,0))", True),
        ("stroke:var(--more)", False),
        ("stroke:var(--self)", False),
        ("stroke:var(--other)", True),
        ("stroke:red;display:var(--none)", False),
        ("stroke:currentColor", True),
        ("stroke:currentColor;color:var(--none, red)", False),
        ("stroke:currentColor;color:transparent", False),
    ],
)
def test_variables_and_the_present_colour(style: str, is_seen: bool) -> None:
    """Values that a style sheet tells once, or that hold where it tells none; `color` is what currentColor means."""
    sheet = "<style>:root{--ink:#123;--none:none;--other:var(--ink);--self:var(--self)} g{fill:none}</style>"
    content = f"{sheet}<circle cx='60' cy='60' r='9'/><g><g style='{style}'>{PART}</g></g>"
    assert (WHERE in boxes(reading_of(page(content)))) == is_seen


@pytest.mark.parametrize(
    ("fill", "is_seen"),
    [
        ("url(#No)", False),
        ("url('#no') none", False),
        ("url(#no) red", True),
        ("url(#Ink)", True),
        ("url( #g )", False),
    ],
)
def test_an_area_of_a_gradient_that_is_not_there_is_left(fill: str, is_seen: bool) -> None:
    defs = '<defs><linearGradient id="Ink"><stop stop-color="red"/></linearGradient><g id="g"/></defs>'
    reading = reading_of(page(f'{defs}{PART}<circle cx="70" cy="50" r="20" fill="{fill}"/>'))
    assert len(reading.contours) == 1 + is_seen
    assert left(reading) == ({} if is_seen else {"reason-unpainted": 1})


def test_animations_are_said() -> None:
    moving = '<g><animateTransform attributeName="transform" type="scale" to="2"/>%s</g><set href="#a" to="1"/>'
    reading = reading_of(page(moving % PART))
    assert boxes(reading) == [WHERE]
    assert each_says(reading.report.findings, Phrase("animations", count=2))


def test_parts_of_a_page_without_a_size_are_left() -> None:
    content = '<rect width="50%" height="9"/><svg viewBox="0 0 1 1"><rect width="1" height="1"/></svg>' + PART
    reading = checked(page(content, ""), units="mm")
    assert len(reading.contours) == 1
    assert left(reading) == {
        Phrase("reason-unread", what=Phrase("unread-part", text="50%")): 1,
        Phrase("reason-unread", what=Phrase("unread-no-frame")): 1,
    }


@pytest.mark.parametrize(
    ("style", "is_said"),
    [
        ('style="marker-end:url(#a)"', True),
        ('marker-start="url(#a)"', True),
        ('style="marker:url(#a)"', True),
        ('style="marker:none"', False),
        ('marker-mid="none"', False),
    ],
)
def test_markers_are_said(style: str, is_said: bool) -> None:
    """The head of an arrow, told by the line or by the group that it stands in; a rectangle has none."""
    line = '<line x1="5" y1="5" x2="60" y2="5" stroke="red" %s/>'
    head = '<marker id="a"><path d="M0 0 L4 2 L0 4 z"/></marker>'
    for content in (line % style, f"<g {style}>{line % ''}</g>"):
        reading = reading_of(page(head + PART + content))
        assert len(reading.contours) == 2
        markers = [finding for finding in reading.report.findings if finding.code == "seen-markers"]
        assert [(one["count"], one["layer"], one.place) for one in markers] == [(1, "0", (5, 95))] * is_said
    assert reading_of(page(f"{head}<g {style}>{PART}</g>")).report.findings == []
    unmarked = line % 'style="marker:none"'
    assert reading_of(page(f"{head}<g {style}>{unmarked}</g>")).report.findings == []


def test_a_line_of_dashes_within_an_outline_is_left() -> None:
    fold = '<line x1="12" y1="15" x2="28" y2="15" stroke="blue" style="stroke-dasharray:1"/>'
    reading = reading_of(page(PART + fold))
    assert boxes(reading) == [WHERE]
    assert left(reading) == {"reason-dashed": 1}
    assert len(read(page(PART + fold), "a.svg", ReadOptions(open="all")).contours) == 2


def test_a_curve_that_is_drawn_both_ways_is_drawn_twice() -> None:
    one, other = "M70 60c-33 0-60 24-60 60h60z", "M70 120h-60c0-36 27-60 60-60z"
    reading = reading_of(page(f'<path d="{one} M40 100h9v9z"/><path d="M0 0h150v150h-150z {other}"/>'))
    assert boxes(reading) == [(0, -50, 150, 100), (10, -20, 70, 40), (40, -9, 49, 0)]
    assert {one.kind for one in reading.report.overlaps} == {"drawn twice"}
    assert left(reading) == {}


def test_groups_without_end() -> None:
    with pytest.raises(UserError, match=pattern(Phrase("svg-too-deep", most=300))):
        read(page("<g>" * 2000 + PART + "</g>" * 2000), "a.svg")
