"""Drawings as other people's programs write them, and worse: what is cut, what is left, and that it is said."""

from __future__ import annotations

import io
import os
import re
from collections import Counter
from dataclasses import replace
from itertools import pairwise
from math import cos, hypot, pi, radians, sin
from pathlib import Path
from random import Random

import ezdxf
import pytest
from ezdxf import path as dxf_path
from ezdxf.document import Drawing
from facthelp import CARE, advised, each_says, pattern, says
from hypothesis import given, settings
from hypothesis import strategies as st
from toolhelp import Run, in_time

from skg.errors import UserError
from skg.geometry.contour import Contour
from skg.geometry.plane import XY, distance
from skg.messages.finding import Finding, Phrase
from skg.messages.render import text
from skg.messages.severity import Severity
from skg.reading import dxf_file
from skg.reading.read import Reading, ReadOptions, read

FORMATS = ("R2000", "R2010", "R2018")
#: Those that a drawing without units may be in, as messages offer them.
UNITS = ("mm", "cm", "m", "inch", "foot", "mil", "um")


def raw(*entities: str, header: str = "", layers: str = "") -> bytes:
    """A DXF file of entities that are written as `KIND code value code value …`."""
    text = "0\nSECTION\n2\nHEADER\n" + header + "0\nENDSEC\n"
    text += "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n" + layers + "0\nENDTAB\n0\nENDSEC\n"
    text += "0\nSECTION\n2\nENTITIES\n"
    text += "".join("0\n" + "\n".join(entity.split()) + "\n" for entity in entities)
    return (text + "0\nENDSEC\n0\nEOF\n").encode()


def line(x1: float, y1: float, x2: float, y2: float, layer: str = "0") -> str:
    return f"LINE 8 {layer} 10 {x1} 20 {y1} 11 {x2} 21 {y2}"


def square(x: float, y: float, side: float, layer: str = "0") -> list[str]:
    corners = [(x, y), (x + side, y), (x + side, y + side), (x, y + side), (x, y)]
    return [line(*p, *q, layer) for p, q in pairwise(corners)]


def polygon(*corners: XY, handle: str = "") -> str:
    """A closed R12 polyline."""
    vertices = "".join(f"\n0\nVERTEX\n8\n0\n10\n{x}\n20\n{y}" for x, y in corners)
    return f"POLYLINE {'5 ' + handle if handle else ''} 8 0 66 1 70 1" + vertices + "\n0\nSEQEND"


def dxf_bytes(drawing: Drawing, binary: bool = False) -> bytes:
    if binary:
        stream = io.BytesIO()
        drawing.write(stream, fmt="bin")
        return stream.getvalue()
    text = io.StringIO()
    drawing.write(text)
    return text.getvalue().encode()


def length_by_ezdxf(drawing: Drawing) -> float:
    """The length of all that is drawn, by ezdxf's own exploding and flattening."""
    from ezdxf.disassemble import recursive_decompose

    total = 0.0
    for entity in recursive_decompose(drawing.modelspace()):
        if entity.dxftype() in ("LINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE", "LWPOLYLINE", "POLYLINE"):
            points = list(dxf_path.make_path(entity).flattening(1e-5))
            total += sum(p.distance(q) for p, q in pairwise(points))
    return total


def length(contours: list[Contour]) -> float:
    return sum(edge.length for contour in contours for edge in contour.edges)


def checked(data: bytes, **options: object) -> Reading:
    """A drawing that is read: every contour hangs together, a closed one closes to 0, and the sums agree."""
    reading = read(data, "part.dxf", ReadOptions(units=options.pop("units", "mm"), **options))
    for contour in reading.contours:
        edges = contour.edges
        assert all(one.end == other.start for one, other in pairwise(edges))
        assert (edges[-1].end == edges[0].start) == contour.is_closed
    report = reading.report
    assert report.layers
    assert all(layer.read == layer.cut + layer.part + layer.skipped for layer in report.layers)
    for layer in report.layers:
        assert sum(kinds.total() for kinds in layer.why.values()) == layer.part + layer.skipped
    return reading


def left(reading: Reading) -> dict[str | Phrase, int]:
    """Numbers of entities left, by the reason: its code, or with its values where it has any."""
    found: Counter[str | Phrase] = Counter()
    for layer in reading.report.layers:
        for why, kinds in layer.why.items():
            found[why if why.values else why.code] += kinds.total()
    return dict(found)


def test_handles_that_repeat() -> None:
    """A program that gives each polyline the handle of the first."""
    data = raw(*(polygon((x, 0), (x + 9, 0), (x + 4, 7), handle="90") for x in range(0, 50, 10)))
    assert len(checked(data).contours) == 5


def test_no_subclasses() -> None:
    """A file of AutoCAD 2000 by its header, whose entities have no subclasses."""
    header = "9\n$ACADVER\n1\nAC1015\n"
    data = raw(
        "LWPOLYLINE 8 0 90 3 70 1 10 0 20 0 42 0.5 10 9 20 0 10 4 20 7",
        "CIRCLE 8 0 10 30 20 0 40 3",
        "ELLIPSE 8 0 10 50 20 0 11 5 21 0 40 0.5 41 0 42 6.28318530718",
        "SPLINE 8 0 70 8 71 3 72 8 73 4 40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1"
        " 10 70 20 0 10 75 20 9 10 80 20 9 10 85 20 0",
        line(85, 0, 70, 0),
        header=header,
    )
    found = checked(data).contours
    assert [len(contour.edges) for contour in found] == [3, 1, 1, 2]
    assert all(contour.is_closed for contour in found)


@pytest.mark.parametrize("left_out", ["AcDbEntity", "AcDb(?!Entity|Helix)", "AcDb(?!Helix)"])
@pytest.mark.parametrize("kind", ["LWPOLYLINE", "MLINE", "SPLINE", "HELIX"])
def test_some_subclasses(kind: str, left_out: str) -> None:
    """Entities that have only one of their subclass marks, as from a converter of Inkscape's, or none: nothing is lost,
    and the layer stays."""
    drawing = ezdxf.new("R2010", units=ezdxf.units.MM)
    space, on_layer = drawing.modelspace(), {"layer": "SHEET"}
    match kind:
        case "LWPOLYLINE":
            space.add_lwpolyline([(0, 0), (9, 0), (9, 7, 0, 0, 0.5)], dxfattribs=on_layer, close=True)
        case "MLINE":
            space.add_mline([(0, 0), (30, 0), (30, 20)], dxfattribs=on_layer)
        case "SPLINE":
            space.add_spline(dxfattribs=on_layer).set_open_uniform([(0, 0), (10, 15), (20, -5), (30, 0)])
        case "HELIX":
            space.add_helix(10, 0, 1, dxfattribs=on_layer)
    whole = dxf_bytes(drawing)
    head, entities = whole.split(b"ENTITIES\n", 1)
    partly = head + b"ENTITIES\n" + re.sub(rb" *100\n%b[A-Za-z0-9]*\n" % left_out.encode(), b"", entities)
    assert partly != whole
    expected, found = checked(whole), checked(partly)
    assert found.contours == expected.contours
    assert [layer.layer for layer in found.report.layers if layer.cut] == ["SHEET"]


def a_bit_of_everything() -> Drawing:
    drawing = ezdxf.new("R2010", units=ezdxf.units.MM)
    space = drawing.modelspace()
    inner = drawing.blocks.new("INNER", base_point=(1, 2))
    inner.add_circle((3, 3), 2)
    inner.add_lwpolyline([(0, 0, 0.4), (6, 0, 0), (6, 6, -1), (0, 6, 0)], format="xyb", close=True)
    outer = drawing.blocks.new("OUTER")
    outer.add_blockref("INNER", (20, 0), {"xscale": -1, "rotation": 30})
    outer.add_blockref("INNER", (0, 20), {"xscale": 1.5, "yscale": 0.5})
    outer.add_ellipse((0, 0), (4, 1), 0.4)
    space.add_blockref("OUTER", (100, 50), {"yscale": -2, "xscale": 2, "rotation": 77})
    space.add_blockref(
        "OUTER", (0, 200), {"row_count": 2, "column_count": 3, "row_spacing": 60, "column_spacing": 70, "rotation": 20}
    )
    space.add_circle((-300, 0), 7, {"extrusion": (0, 0, -1)})
    space.add_polyline2d([(400, 0, 0, 0, 1), (410, 0, 0, 0, 0.2), (405, 8, 0, 0, 0)], format="xyseb", close=True)
    return drawing


@pytest.mark.parametrize("binary", [False, True])
@pytest.mark.parametrize("release", FORMATS)
def test_blocks_as_ezdxf_explodes_them(release: str, binary: bool) -> None:
    """Nested, mirrored, turned, squeezed and in arrays: the length of all lines is that of ezdxf's own exploding."""
    drawing = a_bit_of_everything()
    drawing.dxfversion = release
    reading = checked(dxf_bytes(drawing, binary))
    # OUTER stands seven times, with two INNER of two entities and an ellipse.
    assert sum(layer.cut for layer in reading.report.layers) == 7 * 5 + 2
    # (ezdxf flattens an arc by way of Bézier curves, which are longer by up to 0.02 %)
    assert length(reading.contours) == pytest.approx(length_by_ezdxf(drawing), rel=2e-4)
    assert all(contour.is_closed for contour in reading.contours)


def test_layers_that_are_not_seen() -> None:
    drawing = ezdxf.new("R2000", units=ezdxf.units.MM)
    space = drawing.modelspace()
    for name in ("SEEN", "OFF", "FROZEN"):
        drawing.layers.add(name)
        space.add_circle((0, 0), {"SEEN": 10, "OFF": 20, "FROZEN": 30}[name], {"layer": name})
    drawing.layers.get("OFF").off()
    drawing.layers.get("FROZEN").freeze()
    block = drawing.blocks.new("PIN")
    block.add_circle((0, 0), 1)
    block.add_circle((0, 0), 2, {"layer": "SEEN"})
    space.add_blockref("PIN", (50, 0), {"layer": "OFF"})
    space.add_blockref("PIN", (60, 0), {"layer": "FROZEN"})
    space.add_circle((90, 0), 3, {"invisible": 1})
    drawing.paperspace().add_circle((0, 0), 100)
    reading = checked(dxf_bytes(drawing))
    # What is on another layer is seen in a block on a layer that is off, not in one on a frozen layer.
    assert sorted(contour.edges[0].radius for contour in reading.contours) == pytest.approx([2, 10])
    assert left(reading) == {
        "reason-invisible": 1,
        "reason-paper-space": 1,
        "reason-layer-frozen": 3,
        "reason-layer-off": 2,
    }
    assert len(checked(dxf_bytes(drawing), layers=("off",)).contours) == 2


def test_what_is_not_flat_or_not_known() -> None:
    data = raw(
        *square(0, 0, 10),
        "CIRCLE 8 TILT 10 5 20 5 40 2 210 0 220 1 230 1",
        "LINE 8 STEEP 10 1 20 1 30 0 11 3 21 1 31 8",
        "3DFACE 8 FACE 10 1 20 2 11 3 21 2 12 3 22 4 13 1 23 4",
        "CIRCLE 8 BAD 10 abc 20 5 40 2",
        "INSERT 8 LOST 2 NOWHERE 10 7 20 8",
        "SPLINE 8 NAN 70 8 71 1 72 4 73 2 40 0 40 0 40 1 40 1 10 nan 20 0 10 5 20 5",
        "TEXT 8 NOTE 10 1 20 1 1 HELLO",
    )
    report = checked(data).report
    kinds = [(entity.kind, entity.layer, entity.place) for entity in report.not_understood]
    assert kinds == [
        ("CIRCLE", "TILT", (5, 5)),
        ("LINE", "STEEP", (1, 1)),
        ("3DFACE", "FACE", (1, 2)),
        ("CIRCLE", "BAD", (0, 0)),
        ("INSERT", "LOST", (7, 8)),
        ("SPLINE", "NAN", (0, 0)),
    ]
    text = report.report()
    assert says(
        text,
        Phrase("entity-not-cut", kind="INSERT", layer="LOST", place=(7, 8)),
        Phrase("reason-no-block", name="NOWHERE"),
    )
    assert says(
        text,
        Phrase("layer-sum", layer="NOTE"),
        Phrase("count-entities", count=1),
        Phrase("layer-left", count=1),
        Phrase("count-kind", count=1, kind="TEXT"),
    )


@pytest.mark.parametrize("gap", [1, 2, 5, 6, 10, 20, 50])
def test_gaps(gap: int) -> None:
    """A gap wider than the tolerance stays open, and its width is told; else both ends go to its middle."""
    data = raw(line(0, 0, 10, 0), line(10, 0, 10, 10), "ARC 8 0 10 5 20 10 40 5 50 0 51 180", line(0, 10, 0, gap / 1e3))
    reading = checked(data)
    (contour,) = reading.contours
    assert contour.is_closed == (gap <= 5)
    if not contour.is_closed:
        assert [end.gap for end in reading.report.open_ends] == pytest.approx([gap / 1e3] * 2)
        wider = float(advised(reading.report.report(), "tolerance")[0])
        assert checked(data, tolerance=wider).contours[0].is_closed
        with pytest.raises(UserError, match=pattern(Phrase("open-refused", count=1), re.compile(r"\(0, 0"))):
            checked(data, open="refuse")
    else:
        assert max(abs(y) for edge in contour.edges for _, y in (edge.start,) if y < 1) <= gap / 2e3 + 1e-9


#: A plate of 40 x 20 whose four corners the lines run past, or end at; two of them end on their neighbour.
PAST = [line(-0.1, 0, 40, 0), line(40, -0.05, 40, 20.12), line(40.2, 20, 0, 20), line(0, 20.01, 0, -0.07)]


def test_ends_past_corners() -> None:
    """Short ends past a corner are not cut, and reported; the outline closes at the crossings themselves."""
    reading = checked(raw(*PAST))
    (contour,) = reading.contours
    assert contour.is_closed
    found = sorted((round(x, 6), round(y, 6)) for x, y in (edge.start for edge in contour.edges))
    assert found == [(0, 0), (0, 20), (40, 0), (40, 20)]
    assert left(reading) == {}
    text = reading.report.report()
    assert says(text, Phrase("overruns", count=6, layer="0", longest=0.2))
    assert length(checked(raw(*PAST), open="all").contours) == pytest.approx(length(reading.contours) + 0.55)


@pytest.mark.parametrize(("stub", "is_corner"), [(0.05, True), (0.19, True), (0.3, False)])
def test_lines_of_their_own_past_corners(stub: float, is_corner: bool) -> None:
    """One corner is met by a short line that ends free; the outline closes where others run past theirs."""
    lines = [line(0, 0, 40, 0), line(40, 0, 40, 20.1), line(40.1, 20, 0, 20), line(0, 20, 0, 0)]
    reading = checked(raw(*lines, line(40, 0, 40 + stub, 0)))
    assert [one.is_closed for one in reading.contours] == ([True] if is_corner else [False] * len(reading.contours))
    if is_corner:
        assert length(reading.contours) == pytest.approx(120)
        assert left(reading) == {"reason-past": 1}
        assert says(reading.report.report(), Phrase("overruns", count=3, layer="0", longest=max(stub, 0.1)))
    # A part whose lines meet at another junction, too, is left as it was.
    reading = checked(raw(*lines, line(40, 0, 40 + stub, 0), line(0, 20, -9, 20)))
    assert not any(one.is_closed for one in reading.contours)


def test_ends_past_corners_of_arcs() -> None:
    """A slot whose arcs go on behind their lines by up to 0.2 mm, and lines that go on behind an arc."""
    over = 1.8  # degrees, 0.157 mm
    data = raw(
        line(0, 5, 30, 5),
        line(30, -5, 0, -5),
        f"ARC 8 0 10 30 20 0 40 5 50 {-90 - over} 51 {90 + over}",
        f"ARC 8 0 10 0 20 0 40 5 50 {90 - over} 51 {270 + over}",
        *(line(x, y, 50, 30) for x, y in ((50, 10), (50.1, 29.9))),
        "ARC 8 0 10 60 20 30 40 10 50 170 51 180.5",
    )
    reading = checked(data)
    slots = [contour for contour in reading.contours if contour.is_closed]
    assert len(slots) == 1
    for edge in slots[0].edges:
        for x, y in edge.points():
            off = abs(hypot(x - min(max(x, 0), 30), y) - 5)
            assert off < 0.002
    assert length(slots) == pytest.approx(60 + 10 * pi, abs=0.01)


@pytest.mark.parametrize(
    "lines",
    [
        # one runs past by more than that
        [line(-0.3, 0, 40, 0), *PAST[1:3], line(0, 20, 0, -0.3)],
        # three ends at a corner: nobody knows which
        [*PAST, line(-0.05, -0.05, 10, 10)],
        # a cross of lines as small as that, without an outline
        [line(0, 0, 0.5, 0.5), line(0, 0.5, 0.5, 0)],
        # two that cross near their ends, and close nothing
        [line(-0.1, 0, 10, 0), line(0, -0.1, 0, 10)],
    ],
)
def test_ends_that_are_no_corners(lines: list[str]) -> None:
    reading = checked(raw(*lines))
    assert not any(contour.is_closed for contour in reading.contours)
    assert length(reading.contours) == pytest.approx(length(checked(raw(*lines), open="all").contours))
    assert not says(reading.report.report(), Phrase("overruns"))


@pytest.mark.parametrize("seed", range(40))
def test_outlines_of_lines_and_arcs_that_are_too_long(seed: int) -> None:
    """Outlines from tangent to tangent, every edge of which goes on by up to 0.15 mm at its ends: they close where
    the edges meet, and what is cut is what was drawn."""
    random = Random(seed)
    corners = [(30 * cos(2 * pi * k / 7) * (0.7 + 0.3 * (k % 2)), 30 * sin(2 * pi * k / 7)) for k in range(7)]
    lines = []
    for p, q in pairwise([*corners, corners[0]]):
        way = distance(p, q)
        before, behind = (random.choice([0, 0.02, 0.15]) / way for _ in range(2))
        ends = [(1 + before) * a - before * b for a, b in zip(p, q, strict=True)]
        ends += [(1 + behind) * b - behind * a for a, b in zip(p, q, strict=True)]
        lines.append(line(*ends))
    random.shuffle(lines)
    reading = checked(raw(*lines))
    (contour,) = reading.contours
    assert contour.is_closed
    found = [edge.start for edge in contour.edges]
    assert len(found) == 7
    assert all(min(distance(corner, place) for place in found) < 1e-6 for corner in corners)


def test_ends_of_arcs_that_miss() -> None:
    """A keyway: the arc of almost a full turn stays within the tolerance where its ends are moved."""
    half, r = 0.4, 20.0
    angle = 1.1459919983885
    x = r * cos(radians(angle))
    data = raw(
        f"ARC 8 0 10 0 20 0 40 {r} 50 {angle} 51 {360 - angle}",
        line(x, half + 0.004, x + 3, half),
        line(x + 3, half, x + 3, -half),
        line(x + 3, -half, x, -half - 0.001),
    )
    (contour,) = checked(data).contours
    assert contour.is_closed
    points = [point for edge in contour.edges if not edge.is_line for point in edge.points()]
    assert max(abs(hypot(*point) - r) for point in points) < 0.003


def test_touching_and_repeated() -> None:
    """Closed polylines are contours, whatever touches them: two with a common edge, two at a corner, one twice."""
    data = raw(
        polygon((0, 0), (10, 0), (10, 10), (0, 10)),
        polygon((10, 0), (20, 0), (20, 10), (10, 10)),
        polygon((20, 10), (30, 10), (30, 20), (20, 20)),
        polygon((30, 20), (20, 20), (20, 10), (30, 10)),
        polygon((5, 5), (15, 5), (15, 8), (5, 8)),
        "CIRCLE 8 0 10 40 20 40 40 5",
        "CIRCLE 8 0 10 48 20 40 40 3",
        "CIRCLE 8 0 10 40 20 40 40 5",
    )
    reading = checked(data)
    assert len(reading.contours) == 6
    assert left(reading) == {"reason-twice": 2}
    what = [(overlap.kind, overlap.place) for overlap in reading.report.overlaps]
    assert what == [
        ("drawn twice", (30, 20)),
        ("drawn twice", (45, 40)),
        ("overlap", pytest.approx((10, 0), abs=0.01)),
        ("cross", pytest.approx((10, 5), abs=0.01)),
        ("touch", pytest.approx((20, 10), abs=0.01)),
        ("cross", pytest.approx((10, 8), abs=0.01)),
        ("touch", pytest.approx((45, 40), abs=0.2)),
    ]


def test_what_is_drawn_on_lines_that_are_left_is_left_with_them() -> None:
    """A line that divides a plate is drawn twice, and so is an edge: neither of the dividing lines is cut."""
    split = [line(0, 0, 8, 0), line(8, 0, 20, 0), line(20, 0, 20, 20), line(20, 20, 8, 20), line(8, 20, 0, 20)]
    data = raw(*split, line(0, 20, 0, 0), line(8, 0, 8, 20), line(8, 20, 8, 0), line(0, 20, 0, 0))
    reading = checked(data)
    assert left(reading) == {"reason-junction": 2, "reason-twice": 1}
    assert [(one.kind, one.place) for one in reading.report.overlaps] == [("drawn twice", (0, 20))]
    # A polyline on the divider and on an edge.
    bent = "LWPOLYLINE 8 0 90 3 70 0 10 8 20 20 10 8 20 0 10 0 20 0"
    reading = checked(raw(*split, line(0, 20, 0, 0), line(8, 0, 8, 20), bent))
    assert left(reading) == {
        "reason-junction": 1,
        Phrase("reason-and", first=Phrase("reason-junction"), other=Phrase("reason-twice")): 1,
    }
    # Contours: open ones that hang on an outline.
    hung = "LWPOLYLINE 8 0 90 3 70 0 10 20 20 5 10 30 20 5 10 30 20 9"
    reading = checked(raw(*square(0, 0, 20), hung, hung))
    assert left(reading) == {"reason-junction": 2} and reading.report.overlaps == []


def test_edges_that_parts_share_are_said() -> None:
    """A frame in four parts, by two lines that are cut in two where they meet; an axis ends free."""
    frame = [((0, 0), (20, 0)), ((20, 0), (40, 0)), ((40, 0), (40, 9)), ((40, 9), (40, 20)), ((40, 20), (20, 20))]
    frame += [((20, 20), (0, 20)), ((0, 20), (0, 9)), ((0, 9), (0, 0))]
    within = [((20, 0), (20, 9)), ((20, 9), (20, 20)), ((0, 9), (20, 9)), ((20, 9), (40, 9)), ((0, 0), (-9, -9))]
    data = raw(*(line(*p, *q) for p, q in frame + within))
    reading = checked(data)
    assert left(reading) == {"reason-junction": 5}
    assert each_says(
        reading.report.findings,
        (CARE, Phrase("lines-between", count=4, place=(20, 0)), "--open all"),
        (CARE, Phrase("much-left", cut=120)),
    )
    assert checked(data, open="all").report.findings == []


def test_lines_on_a_contour_are_drawn_twice() -> None:
    """On an edge of a closed polyline, over a corner, on a part of a circle; not a line that leaves it midway."""
    plate = polygon((0, 0), (20, 0), (20, 10), (0, 10))
    over = "LWPOLYLINE 8 0 90 3 70 0 10 15 20 0 10 20 20 0 10 20 20 8"
    circle, arc = "CIRCLE 8 0 10 40 20 5 40 5", "ARC 8 0 10 40 20 5 40 5 50 20 51 130"
    reading = checked(raw(plate, circle, line(0, 0, 12, 0), over, arc))
    assert left(reading) == {"reason-twice": 3}
    assert [one.kind for one in reading.report.overlaps] == ["drawn twice"] * 3
    bay = "LWPOLYLINE 8 0 90 4 70 0 10 3 20 0 10 5 20 0 10 9 20 4 10 14 20 0"
    reading = checked(raw(plate, circle, line(0, 0, 20, 10), bay, "ARC 8 0 10 40 20 5.1 40 5 50 -20 51 130"))
    assert left(reading) == {"reason-junction": 3}


def test_hatching_centre_lines_and_frames() -> None:
    """Lines that end on an outline, cross it or hang on its corners are left, with their places."""
    data = raw(
        *square(0, 0, 40, "PART"),
        "CIRCLE 8 PART 10 20 20 20 40 8",
        line(-5, 20, 45, 20, "AXES"),
        line(20, -5, 20, 45, "AXES"),
        *(line(x, 0, x, 10, "HATCH") for x in (3, 6, 9)),
        line(40, 40, 60, 60, "LEADER"),
    )
    reading = checked(data)
    assert [contour.layers for contour in reading.contours] == [("PART",), ("PART",)]
    assert left(reading) == {"reason-junction": 6}
    text = reading.report.report()
    assert says(
        text,
        "--open all",
        Phrase("of-no-outline", kind="LINE", count=3, layer="HATCH", places=((3, 0), (6, 0), (9, 0))),
    )
    assert says(text, Phrase("of-no-outline", kind="LINE", count=1, layer="LEADER", places=((40, 40),)))
    assert len(checked(data, open="all").contours) == 8


def test_an_outline_that_is_left_is_said() -> None:
    """Its ends lie on a circle that was drawn for half of one: the openings alone are no part."""
    outline = [line(0, 0, 40, 0), line(40, 0, 40, 9), line(40, 11, 40, 20), line(40, 20, 0, 20), line(0, 20, 0, 0)]
    circles = [f"CIRCLE 8 0 10 {x} 20 10 40 1" for x in (10, 30, 40)]
    said = [
        note for note in checked(raw(*outline, *circles)).report.findings if says(note, CARE, Phrase("line-around"))
    ]
    assert each_says(said, (Phrase("line-around", start=(40, 9), end=(40, 11))))
    for closed in (line(40, 9, 40, 11), line(20, 0, 20, 9)):
        found = checked(raw(*square(0, 0, 40), *circles, closed)).report.findings
        assert not any(finding.code in ("line-around", "lines-around") for finding in found)


def test_a_gap_in_what_is_left_is_said() -> None:
    """An outline that is open by a few micrometres, with a line that hangs on it: a wider tolerance closes it."""
    outline = [
        line(0, 0, 40, 0),
        line(40, 0, 40, 20),
        line(40, 20, 20, 20),
        line(20, 20.0125, 0, 20),
        line(0, 20, 0, 0),
    ]
    drawing = raw(*outline, line(40, 20, 50, 30), "CIRCLE 8 0 10 10 20 10 40 5")
    reading = checked(drawing)
    assert left(reading) == {"reason-junction": 6}
    notes = reading.report.findings
    assert says(notes, Phrase("ends-near", count=2, widest=0.0125), re.compile(r"\(20, 20[\d.]*\)"), "--tolerance")
    (wider,) = advised(notes, "tolerance")
    again = checked(drawing, tolerance=float(wider))
    assert left(again) == {"reason-junction": 1}
    assert not advised(again.report.findings, "tolerance")


def test_an_outline_with_gaps_that_is_left_is_said() -> None:
    """Every side of it is a run of its own, for lines hang on its corners."""
    corners = [(0, 0), (40, 0), (40, 20), (0, 20), (0, 0)]
    sides = [line(*p, *q) for p, q in pairwise(corners[:4])] + [line(0, 20, 0, 0.0125)]
    hanging = [line(x, y, x * 1.2 - 4, y * 1.2 - 2) for x, y in corners[:4]]
    circles = [f"CIRCLE 8 0 10 {x} 20 10 40 1" for x in (10, 30)]
    said = CARE, Phrase("lines-around")
    assert any(says(note, *said) for note in checked(raw(*sides, *hanging, *circles)).report.findings)
    for some in ([*sides, *hanging, circles[0]], [*sides[:2], *hanging, *circles], [*square(0, 0, 40), *circles]):
        assert not any(says(note, *said) for note in checked(raw(*some)).report.findings)


def test_outlines_of_one_layer() -> None:
    """A contour closed on its own layer is the outline, without lines of another layer."""
    rounded = [
        line(1, 0, 9, 0),
        line(9, 0, 9, 9),
        line(9, 9, 0, 9),
        line(0, 9, 0, 1),
        "ARC 8 0 10 1 20 1 40 1 50 180 51 270",
    ]
    corner = [line(1, 0, 0, 0, "REF"), line(0, 0, 0, 1, "REF"), line(9, 9, 4, 4, "BEND")]
    reading = checked(raw(*corner, *rounded))
    assert length(reading.contours) == pytest.approx(4 * 9 - 2 + pi / 2)
    assert {layer.layer: (layer.cut, layer.skipped) for layer in reading.report.layers} == {
        "0": (5, 0), "REF": (0, 2), "BEND": (0, 1)
    }  # fmt: skip
    # Two rings of two layers that share a corner or two, and what makes a ring of both.
    reading = checked(raw(*square(0, 0, 10, "A"), *square(10, 10, 10, "B"), line(10, 0, 20, 10, "C")))
    assert [contour.layers for contour in reading.contours] == [("A",), ("B",)]
    assert left(reading) == {"reason-junction": 1}
    # An outline that is drawn on two layers is one.
    half, other = square(0, 0, 10)[:2], square(0, 0, 10, "B")[2:]
    assert length(checked(raw(*half, *other, line(0, 0, 10, 10, "C"))).contours) == pytest.approx(40)


@pytest.mark.parametrize(
    ("lines", "closed", "rest"),
    [
        # a plate that a line divides, drawn from corner to corner: its boundary
        ([*square(0, 0, 10), line(0, 0, 10, 10)], 1, 1),
        # the same, the sides drawn in two halves
        (
            [
                line(0, 0, 5, 0),
                line(5, 0, 10, 0),
                line(10, 0, 10, 9),
                line(10, 9, 5, 9),
                line(5, 9, 0, 9),
                line(0, 9, 0, 0),
                line(5, 0, 5, 9),
            ],
            1,
            1,
        ),
        # a plate and a square hole, hatched from corner to corner
        ([*square(0, 0, 30), *square(10, 10, 10), line(0, 0, 10, 10), line(30, 30, 20, 20), line(0, 30, 10, 20)], 2, 3),
        # two squares that share a corner
        ([*square(0, 0, 10), *square(10, 10, 10)], 2, 0),
        # two squares, and a line from one to the other
        ([*square(0, 0, 10), *square(20, 20, 10), line(10, 10, 20, 20)], 2, 1),
        # crossing lines: their cell is no outline
        (
            [
                *square(50, 50, 5),
                *(line(x, y, x + 10, y) for x in (0, 10, 20) for y in (10, 20)),
                *(line(x, y, x, y + 10) for x in (10, 20) for y in (0, 10, 20)),
            ],
            1,
            12,
        ),
        # an outline whose corners other lines go straight on from
        ([*square(0, 0, 10), line(10, 0, 20, 0), line(10, 10, 10, 20)], 1, 2),
    ],
)
def test_junctions(lines: list[str], closed: int, rest: int) -> None:
    reading = checked(raw(*lines))
    assert [contour.is_closed for contour in reading.contours] == [True] * closed
    assert len(reading.report.rest) == rest
    if rest == 3:
        assert length(reading.contours) == pytest.approx(160)


@pytest.mark.parametrize("radius", [40_000, 60_000, 5e7])
def test_arcs_of_a_large_radius(radius: float) -> None:
    """Larger ones than FIT's are cut in chords that stay near them; their centre would lie off the tape."""
    half = 50 / radius
    height = radius - radius * cos(half)
    low, high = (270 + 180 / pi * side * half for side in (-1, 1))
    data = raw(
        f"ARC 8 0 10 0 20 {radius} 40 {radius} 50 {low} 51 {high}", line(50, height, 0, 30), line(0, 30, -50, height)
    )
    (contour,) = checked(data, tolerance=0.001).contours
    assert contour.is_closed
    curve = next(edge for edge in contour.edges if not edge.is_line)
    assert bool(curve.nodes) == (radius > 50_000)
    assert max(abs(hypot(x, y - radius) - radius) for x, y in curve.points()) < 1e-3


def test_no_outline_is_refused() -> None:
    star = raw(*(line(0, 0, *end) for end in ((5, 0), (0, 5), (-5, -5))))
    with pytest.raises(UserError, match=pattern(Phrase("no-outline-junctions", count=3), "(0, 0)", "--open all")):
        checked(star, open="leave")
    # Where nothing else is asked for it is cut as it is drawn, with a word.
    reading = checked(star)
    assert len(reading.contours) == 3 and not left(reading)
    assert any(says(note, Phrase("no-closed-as-drawn")) for note in reading.report.findings)


@given(st.integers(0, 10**9))
@settings(max_examples=40)
def test_small_whole_numbers_thrown_together(seed: int) -> None:
    """Lines, arcs and circles between places of a small grid: touching, crossing, coincident, double, without length.
    Whatever is cut, no length is lost: what is cut is drawn, what is closed is closed, and what is left is told."""
    random = Random(seed)
    entities = []
    for _ in range(random.randint(1, 40)):
        x, y, u, v = (random.randint(0, 4) for _ in range(4))
        match random.randint(0, 4):
            case 0:
                entities.append(f"CIRCLE 8 0 10 {x} 20 {y} 40 {random.randint(0, 2)}")
            case 1:
                first = random.choice((0, 90, 180, 270))
                entities.append(f"ARC 8 0 10 {x} 20 {y} 40 {random.randint(0, 2)} 50 {first} 51 {first + 90}")
            case _:
                entities.append(line(x, y, u, v))
    try:
        reading = checked(raw(*entities), open=random.choice(("cut", "all", "leave")))
    except UserError as error:
        assert error.finding.code in ("no-outline-junctions", "no-outline-gap", "nothing-to-cut"), error.finding
        return
    assert sum(layer.read for layer in reading.report.layers) == len(entities)
    cut = sum(layer.cut + layer.part for layer in reading.report.layers)
    assert len({edge.entity for contour in reading.contours for edge in contour.edges}) <= cut
    assert all(map(str, reading.report.report()))


@pytest.mark.parametrize("place", [0, 1e3, 5e5, -4e6])
def test_far_away(place: float) -> None:
    """A map's coordinates: the drawing is moved to where a tape has room, and that is said."""
    data = raw(*square(place, place, 10), line(place, place, place, place), f"POINT 8 START 10 {place + 3} 20 {place}")
    reading = checked(data)
    (contour,) = reading.contours
    assert contour.is_closed
    assert contour.area == pytest.approx(100, rel=1e-6)
    at = place if place < 50_000 and place >= 0 else 0
    assert (reading.report.low, reading.starts) == (pytest.approx((at, at)), [pytest.approx((at + 3, at))])
    assert any(finding.code == "moved-near" for finding in reading.report.findings) == (at != place)


def test_many_that_touch() -> None:
    """2,500 squares side by side: not each pair is told, and they take no more time, each, than 625."""

    def squares(count: int) -> Reading:
        corners = [(x, y) for x in range(count) for y in range(count)]
        data = raw(*(polygon((x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)) for x, y in corners))
        return checked(data)

    # (each with each would be 16)
    reading, _ = in_time(10, lambda: squares(50), lambda: squares(25))
    assert len(reading.contours) == 2500
    assert len(reading.report.overlaps) == 300
    # each of 50 by 50 squares meets its neighbours at 2·50·49 sides and 2·49·49 corners
    more = Phrase("more-meetings", count=2 * 50 * 49 + 2 * 49 * 49 - 300)
    assert any(says(note, more) for note in reading.report.findings)


def would_be(*sizes: tuple[float, str]) -> Phrase:
    """The sizes of a square in other units: these alone."""
    return Phrase(
        "would-be", sizes=tuple(Phrase("size-in-units", width=w, height=w, units=units) for w, units in sizes)
    )


def test_units() -> None:
    """Those of the file, those asked for; a file without any is asked about when its size is odd."""
    inches = raw(*square(0, 0, 2), header="9\n$INSUNITS\n70\n1\n")
    assert read(inches, "a.dxf").report.size == (50.8, 50.8)
    assert says(
        read(inches, "a.dxf").report.report()[0],
        Phrase("size-read", width=50.8, height=50.8, units="inch"),
        Phrase("units-told"),
    )
    assert says(text(read(raw(*square(0, 0, 20)), "a.dxf").report.told), Phrase("units-not-told"))
    assert read(raw(*square(0, 0, 2)), "a.dxf", ReadOptions(units="foot")).report.size == pytest.approx((609.6, 609.6))
    with pytest.raises(
        UserError,
        match=pattern(Phrase("size-implausible", other=would_be((50.8, "inch"), (20, "cm"))), "--units"),
    ):
        read(raw(*square(0, 0, 2)), "a.dxf")
    mile = raw(*square(0, 0, 1e-5), header="9\n$INSUNITS\n70\n3\n")
    assert says(
        read(mile, "a.dxf").report.report()[0],
        Phrase("size-read", width=16.0934, height=16.0934, units="mile"),
        Phrase("units-told"),
    )
    with pytest.raises(
        UserError,
        match=pattern(
            "a.dxf: ", Phrase("nothing-in-units", units="mm"), Phrase("reason-short"), "--units", "--tolerance"
        ),
    ):
        read(raw(*square(0, 0, 2e-5), "TEXT 8 0 10 0 20 0 1 A"), "a.dxf")
    # ezdxf writes m where it is told nothing.
    metres = read(raw(*square(0, 0, 60), header="9\n$INSUNITS\n70\n6\n"), "a.dxf").report
    assert metres.size == (60, 60)
    assert says(
        metres.report()[0],
        Phrase("size-guessed", width=60, height=60, units="mm"),
        Phrase("units-odd-metres", width=60, height=60),
    )
    for side in (0.5, 2.0, 15000.0):
        with pytest.raises(UserError, match=pattern("a.dxf: ", Phrase("size-implausible", units=UNITS), "--units")):
            read(raw(*square(0, 0, side)), "a.dxf")
    with pytest.raises(UserError, match=pattern(Phrase("size-too-far", units="m", most=50))):
        read(raw(*square(0, 0, 9e4)), "a.dxf", ReadOptions(units="m"))
    # Where no units make it a usual part, those are offered that a tape has room for.
    house = raw(*square(0, 0, 2e4), header="9\n$INSUNITS\n70\n1\n")
    with pytest.raises(
        UserError,
        match=pattern(Phrase("size-too-far", width=508000, height=508000, units="inch", other=would_be((20000, "mm")))),
    ):
        read(house, "a.dxf")


def test_parts_of_unknown_units_are_doubted() -> None:
    """Up to an inch, and above 1 m, with a word."""

    def notes(side: float, options: ReadOptions | None = None) -> list[Finding]:
        return read(raw(*square(0, 0, side)), "a.dxf", options).report.findings

    small = Phrase("size-small", width=8, height=8, other=would_be((203.2, "inch"), (80, "cm")))
    assert each_says(notes(8), (CARE, small, "--units"))
    assert len(notes(3)) == 1 and notes(8, ReadOptions(units="mm")) == [] and notes(26) == []
    large = Phrase("size-large", width=3500, height=3500, other=would_be((88.9, "mil")))
    assert each_says(notes(3500), (CARE, large, "--units"))
    assert notes(3500, ReadOptions(units="mm")) == [] and notes(1000) == []
    with pytest.raises(
        UserError,
        match=pattern(Phrase("size-implausible", width=15000, height=15000, other=would_be((381, "mil"))), "--units"),
    ):
        notes(15000)


def test_told_units_of_an_odd_size_are_doubted() -> None:
    """A file that says inch and is in mm, or the other way round: read as it says, with a word."""

    def notes(units: int, side: float, options: ReadOptions | None = None) -> list[Finding]:
        data = raw(*square(0, 0, side), header=f"9\n$INSUNITS\n70\n{units}\n")
        return read(data, "a.dxf", options).report.findings

    for units, drawn, size, others in (
        (1, 94, 2387.6, would_be((94, "mm"), (940, "cm"))),
        (4, 2.5, 2.5, would_be((63.5, "inch"), (25, "cm"))),
        (1, 1500, 38100, would_be((1500, "mm"))),
    ):
        doubt = Phrase("size-odd", width=size, height=size, other=others)
        assert each_says(notes(units, drawn), (CARE, doubt, "--units"))
    for units, side in ((1, 30), (4, 40), (4, 2000), (5, 60)):
        assert notes(units, side) == []
    assert notes(1, 94, ReadOptions(units="inch")) == []


def test_paper_space_alone() -> None:
    """Paper space is cut, with a note, if the model space has nothing to cut; else it is left."""
    paper = [f"{one} 67 1" for one in square(0, 0, 20)]
    reading = checked(raw(*paper, "TEXT 8 0 10 1 20 1 1 A"))
    assert len(reading.contours) == 1 and left(reading) == {"reason-nothing-to-cut": 1}
    assert any(says(note, Phrase("paper-space")) for note in reading.report.findings)
    both = checked(raw(*paper, *square(50, 0, 10)))
    assert left(both) == {"reason-paper-space": 4} and both.report.size == (10, 10)


def test_widths_are_said() -> None:
    """A polyline with a width is cut along its middle: said with layer and place, however the width is written."""
    corners = "10 0 20 0 10 30 20 0 10 30 20 20"
    wide = checked(raw(f"LWPOLYLINE 8 WIDE 90 3 70 1 43 0.5 {corners}"))
    assert says(wide.report.findings[0], Phrase("seen-with-width", count=1, layer="WIDE", place=(0, 0)))
    tapering = checked(raw(f"LWPOLYLINE 8 0 90 3 70 1 40 0.0 41 1.5 {corners}"))
    assert says(tapering.report.findings[0], Phrase("seen-with-width", count=1, layer="0"))
    plain = checked(raw(f"LWPOLYLINE 8 0 90 3 70 1 43 0.0 40 0 41 0.00 {corners}"))
    assert not any(finding.code == "seen-with-width" for finding in plain.report.findings)


def test_arcs_from_an_angle_to_the_same() -> None:
    """One program's full circle or ellipse is another one's nothing: it is said what was taken."""
    reading = checked(raw("ARC 8 A 10 0 20 0 40 5 50 270.0 51 270.0", "ARC 8 A 10 20 20 0 40 5 50 0 51 360"))
    assert [contour.is_closed for contour in reading.contours] == [True, True]
    assert each_says(reading.report.findings, Phrase("seen-full-turn", count=1, layer="A", place=(0, -5)))
    reading = checked(raw("ELLIPSE 8 A 10 0 20 0 30 0 11 5 21 0 31 0 40 0.5 41 0.0 42 0.0"))
    assert [contour.is_closed for contour in reading.contours] == [True]
    assert each_says(reading.report.findings, Phrase("seen-full-turn", count=1, layer="A", place=(5, 0)))


def test_arcs_of_nothing_between_lines() -> None:
    """An arc from an angle to the same angle is left where two lines meet; elsewhere it is a full circle."""
    corner = [
        "ARC 8 0 10 10 20 2 40 2 50 270 51 270",
        line(0, 0, 10, 0),
        line(10, 0, 20, 0),
        line(20, 0, 0, 9),
        line(0, 9, 0, 0),
    ]
    reading = checked(raw(*corner, "ARC 8 0 10 50 20 2 40 2 50 90 51 90", line(50, 4, 60, 4)), open="all")
    assert left(reading) == {"reason-between-lines": 1}
    assert sum(contour.edges[0].is_circle for contour in reading.contours) == 1
    assert any(
        says(note, Phrase("seen-full-turn", count=1, layer="0", place=(50, 4))) for note in reading.report.findings
    )
    twice = checked(raw(*["ARC 8 0 10 50 20 2 40 2 50 90 51 90"] * 2))
    assert left(twice) == {"reason-twice": 1}


def test_arcs_of_next_to_nothing() -> None:
    """An arc of almost no sweep is no circle; a whole turn with rounded angles is."""
    ends = "ARC 8 A 10 0 20 0 40 {} 50 {} 51 {}".format
    reading = checked(raw(*square(9, 9, 5), ends(1, 174.9999996, "175.0000024"), ends(3, 0, "0.000000001")))
    assert [contour.edges[0].is_circle for contour in reading.contours] == [False]
    assert left(reading) == {"reason-short": 2}
    for last in ("360", "359.9999999", "360.0000001", "0.00000000000001"):
        reading = checked(raw(ends(5, 0, last)))
        assert reading.contours[0].edges[0].is_circle
        assert len(reading.report.findings) == (last[:2] == "0.")
    # From just below a whole turn on: a circle or next to nothing, so that it is said.
    reading = checked(raw(ends(5, "359.9999999999", 0)))
    assert reading.contours[0].edges[0].is_circle and says(reading.report.findings[0], Phrase("seen-full-turn"))


def test_only_unseen_layers() -> None:
    frozen = "0\nLAYER\n2\nPART\n70\n1\n62\n7\n"
    with pytest.raises(
        UserError,
        match=pattern(
            Phrase("nothing-to-cut"),
            Phrase("kind-and-reason", count=4, kind="LINE"),
            Phrase("reason-layer-frozen"),
            "--layer PART",
        ),
    ):
        checked(raw(*square(0, 0, 20, "PART"), layers=frozen))


def test_repeated_vertices_and_no_length() -> None:
    data = raw(
        polygon((0, 0), (0, 0), (9, 0), (9, 0.0004), (9, 7), (0, 7), (0, 0)),
        line(50, 50, 50, 50),
        "LINE 8 0 10 60 20 60 11 60.002 21 60",
    )
    reading = checked(data)
    assert [len(contour.edges) for contour in reading.contours] == [4]
    assert left(reading) == {"reason-no-length": 1, "reason-short": 1}


def spline(controls: list[XY], knots: list[float], degree: int = 3) -> str:
    text = f"SPLINE 8 0 70 8 71 {degree} 72 {len(knots)} 73 {len(controls)} "
    return text + " ".join([f"40 {knot}" for knot in knots] + [f"10 {x} 20 {y}" for x, y in controls])


def test_splines_with_odd_knots() -> None:
    """Knots that repeat up to a corner, spans of no length, and one of nearly none."""
    controls = [(0, 0), (5, 0), (10, 5), (10, 10), (10, 15), (5, 20), (0, 20), (-5, 15), (-5, 5), (0, 0)]
    knots = [0, 0, 0, 0, 1, 1, 1, 1 + 1e-13, 2, 2, 3, 3, 3, 3]
    (contour,) = checked(raw(spline(controls, knots))).contours
    assert contour.is_closed
    assert sum(len(edge.nodes) for edge in contour.edges) < 200
    # Two knots next to each other, as a file rounds them, with much of the curve between them.
    controls = [(0, 0), (10, 0), (20, 5), (30, 20), (30, 40), (10, 60)]
    narrow = [0, 0, 0, 0, 0.5, 0.5 + 1e-9, 1, 1, 1, 1]
    (curve,) = checked(raw(spline(controls, narrow))).contours[0].edges
    assert max(distance(p, q) for p, q in pairwise(curve.samples)) < 3
    assert len(curve.nodes) < 40
    # Controls that coincide: the direction there is that of the places beside it.
    controls = [(0, 0), (0, 0), (10, 0), (10, 0), (20, 10)]
    knots = [0, 0, 0, 0, 0.5, 1, 1, 1, 1]
    (contour,) = checked(raw(spline(controls, knots))).contours
    assert contour.edges[0].start == (0, 0) and contour.edges[-1].end == (20, 10)


def test_splines_that_are_lines_and_circles() -> None:
    """A straight spline is a line, one of weights that make it a circle an arc."""
    straight = spline([(0, 0), (3, 0), (6, 0), (9, 0)], [0, 0, 0, 0, 1, 1, 1, 1])
    root = 0.5**0.5
    quarter = "SPLINE 8 0 70 12 71 2 72 6 73 3 40 0 40 0 40 0 40 1 40 1 40 1 41 1 41 " + f"{root} 41 1"
    quarter += " 10 9 20 0 10 9 20 9 10 0 20 9"
    (contour,) = checked(raw(straight, quarter, line(0, 9, 0, 0))).contours
    kinds = [(edge.is_line, edge.centre is not None) for edge in contour.edges]
    assert kinds == [(True, False), (False, True), (True, False)]
    assert contour.edges[1].centre == pytest.approx((0, 0), abs=1e-6)


@pytest.mark.parametrize("last", [6.28318530718, 2 * pi, 6.283185, 0.0])
def test_ellipses_that_are_whole(last: float) -> None:
    (contour,) = checked(raw(f"ELLIPSE 8 0 10 0 20 0 11 5 21 0 40 0.5 41 0 42 {last}")).contours
    assert contour.is_closed
    assert length([contour]) == pytest.approx(24.22112, abs=1e-4)


def test_a_digitised_curve_is_quick() -> None:
    """1,500 control points: no more nodes than the curve needs, and no more time for a point than with 375."""

    def digitised(count: int) -> Contour:
        controls = [(100 * cos(t / 300), 70 * sin(t / 300) + 5 * sin(t / 60)) for t in range(count)]
        knots = [0] * 4 + list(range(1, len(controls) - 3)) + [len(controls) - 3] * 4
        data = raw(spline(controls, knots))
        (contour,) = checked(data).contours
        return contour

    # (all of them anew for each would be 16)
    contour, _ = in_time(10, lambda: digitised(1500), lambda: digitised(375))
    assert sum(len(edge.nodes) for edge in contour.edges) < 400


@pytest.mark.parametrize(
    ("encoding", "page"),
    [("cp1252", "ANSI_1252"), ("gbk", "ANSI_936"), ("utf-8", ""), ("utf-16", ""), ("utf-8-sig", "")],
)
def test_encodings(encoding: str, page: str) -> None:
    name = "形状" if encoding != "cp1252" else "Maße"
    header = f"9\n$DWGCODEPAGE\n3\n{page}\n" if page else ""
    data = raw(*square(0, 0, 10, name), header=header).decode().encode(encoding)
    assert checked(data).contours[0].layers == (name,)
    for end in (b"\r\n", b"\r", b"\r\r\n"):
        if encoding == "utf-8":
            assert checked(data.replace(b"\n", end)).contours[0].layers == (name,)


@pytest.mark.parametrize(
    ("encoding", "names", "guess"),
    [
        ("gbk", ["轮廓线"], "GBK"),
        ("gbk", ["孔", "外形-1", "标注 2", "0"], "GBK"),
        ("cp1252", ["Größe", "Maße", "Außenkontur"], "Windows-1252"),
        ("cp1252", ["Größe"], "Windows-1252"),
        ("cp1252", ["é", "Pièce à découper"], "Windows-1252"),
        ("cp1252", ["Ø8 ±0.1"], "Windows-1252"),
    ],
)
def test_a_text_without_a_code_page(encoding: str, names: list[str], guess: str) -> None:
    """Chinese and western names are told apart by their bytes; what is guessed is said, and --encoding sets another."""
    names = [name.replace(" ", "_") for name in names]
    lines = [line(0, 20 * at, 10, 20 * at, name) for at, name in enumerate(names)]
    data = raw(*lines).decode().encode(encoding)
    reading = checked(data)
    assert [layer.layer for layer in reading.report.layers] == sorted(names)
    (said,) = (note for note in reading.report.findings if advised([note], "encoding"))
    assert guess in str(said)
    told = checked(data, encoding=encoding)
    assert [layer.layer for layer in told.report.layers] == sorted(names)
    assert not advised(told.report.findings, "encoding")


def test_a_list_of_layers_says_what_was_guessed(run: Run, tmp_path: Path) -> None:
    """The names of a file without a code page, and a file that may be cut off."""
    part = tmp_path / "part.dxf"
    data = raw(*square(0, 0, 30, "КОНТУР")).decode()
    part.write_bytes(data.encode("cp1251"))
    for words in ([], ["--quiet"]):
        done = run("cut", part, "--list-layers", *words)
        assert done.exit_code == 0 and each_says(
            done.stderr, ("part.dxf", Phrase("encoding-guessed", name="GBK"), "--encoding")
        )
    done = run("cut", part, "--list-layers", "--encoding", "cp1251")
    lines = (Phrase("count-kind", count=4, kind="LINE"),)
    assert (done.stdout, done.stderr) == (f"{Phrase('layer-list', layer='КОНТУР', kinds=lines)}\n", "")
    part.write_text(data.replace("0\nEOF\n", ""), encoding="utf-8")
    assert each_says(run("cut", part, "--list-layers").stderr, ("part.dxf", Phrase("no-eof")))


@pytest.mark.parametrize("told", [True, False])
@pytest.mark.parametrize("name", ["part.svg", "part.dxf"])
def test_guessed_units_are_said_quietly_too(run: Run, tmp_path: Path, name: str, told: bool) -> None:
    part = tmp_path / name
    page = svg(
        '<rect width="90" height="60"/>', 'width="200mm" viewBox="0 0 200 100"' if told else 'width="200" height="100"'
    )
    sheet = raw(*square(0, 0, 90), header="9\n$INSUNITS\n70\n4\n" if told else "")
    part.write_bytes(page if name == "part.svg" else sheet)
    words = ("cut", part, "-o", tmp_path / "part.3b", "--offset", 0.1, "--quiet")
    lines = run(*words).stderr.splitlines()
    assert lines == [] if told else says(lines[0], Phrase("size-guessed", units="px" if name == "part.svg" else "mm"))
    assert run(*words, "--units", "mm").stderr == ""


def test_encoding_is_an_option(run: Run, tmp_path: Path) -> None:
    part = tmp_path / "part.dxf"
    for encoding, name in (("gbk", "轮廓线"), ("big5", "外框"), ("shift_jis", "外形線"), ("cp1251", "КОНТУР")):
        part.write_bytes(raw(*square(0, 0, 30, name), *square(9, 9, 9, "1")).decode().encode(encoding))
        words = ["cut", part, "-o", os.devnull, "--program", "-", "--layer", name]
        assert run(*words, "--encoding", encoding.upper()).stdout.count("FROM") == 1
        assert name in run("cut", part, "--list-layers", "--encoding", encoding).stdout
    with pytest.raises(
        UserError, match=pattern(Phrase("line-number", line=26), Phrase("not-in-encoding", encoding="utf-8"))
    ):
        run("cut", part, "--encoding", "utf-8")
    assert run("cut", part, "--encoding", "klingon").exit_code == 2
    picture = tmp_path / "part.svg"
    picture.write_text('<svg xmlns="http://www.w3.org/2000/svg"><circle r="40"/></svg>')
    with pytest.raises(UserError, match=pattern(Phrase("encoding-for-dxf"))):
        run("cut", picture, "--encoding", "gbk")


@pytest.mark.parametrize(
    ("gap", "is_joined"), [(0.0125, True), (0.29, True), (0.31, False), (31.95, False)], ids=lambda value: str(value)
)
def test_a_gap_that_is_wider_than_a_wire_is_not_welded(gap: float, is_joined: bool) -> None:
    """Of such a gap the report says where it is, not which tolerance closes it."""
    reading = checked(raw(line(0, 0, 80, 0), line(80, 0, 80, 80), line(80, 80, 0, 80), line(0, 80, 0, gap)))
    assert [end.gap for end in reading.report.open_ends] == pytest.approx([gap, gap])
    text = reading.report.report()
    assert says(text, Phrase("open-end", gap=gap, place=(0, 0)))
    assert says(text, re.compile(r"--tolerance [\d.]+")) == says(text, Phrase("tolerance-joins")) == is_joined


CROSS = [line(0, 0, 40, 40), line(0, 40, 40, 0)]


@pytest.mark.parametrize("free", [[], [line(60, 0, 60, 87.5)], ["ARC 8 0 10 90 20 0 40 9 50 0 51 90"]])
def test_without_any_closed_outline_all_is_cut(free: list[str]) -> None:
    """Lines that cross are cut as they are drawn, whatever lies free beside them; with an outline they are left."""
    reading = checked(raw(*CROSS, *free))
    assert len(reading.contours) == 2 + len(free) and left(reading) == {}
    assert any(says(note, Phrase("no-closed-as-drawn")) for note in reading.report.findings)
    outlined = checked(raw(*CROSS, *free, *square(100, 100, 50)))
    assert left(outlined) == {"reason-junction": 2}
    assert len(outlined.contours) == 1 + len(free)


@pytest.mark.parametrize("word", ["leave", "refuse"])
def test_without_any_closed_outline_what_is_asked_for_holds(word: str) -> None:
    with pytest.raises(UserError, match=f"{pattern(Phrase('no-outline-junctions'))}|{pattern(Phrase('open-refused'))}"):
        checked(raw(*CROSS, line(60, 0, 60, 87.5)), open=word)


@pytest.mark.parametrize(
    ("rest", "is_said"),
    [
        (CROSS, True),
        ([line(40, 0, 60, 0), line(60, -1, 60, 1)], True),
        ([line(100, 30, 100, 35)], False),
        ([one.replace("8 0", "8 NOTES") for one in CROSS], False),
        ([], False),
    ],
    ids=["cross", "tail", "short", "another layer", "none"],
)
def test_much_that_is_left_is_said(rest: list[str], is_said: bool) -> None:
    """With both lengths, when it is more than a tenth of what is cut and on its layers, and nobody asked for that."""
    reading = checked(raw(*square(100, 0, 30), *rest))
    said = [note for note in reading.report.findings if says(note, CARE, "--open all", Phrase("much-left"))]
    assert bool(said) == is_said
    if is_said:
        words = [[float(word) for word in entity.split()[4::2]] for entity in rest]
        total = sum(hypot(x2 - x1, y2 - y1) for x1, y1, x2, y2 in words)
        assert says(said[0], Phrase("much-left", left=total, cut=120))
    of_all = checked(raw(*square(100, 0, 30), *rest), open="all").report.findings
    assert not any(finding.severity is Severity.CARE for finding in of_all)


def test_dashes_that_are_left_count_and_what_is_open_by_choice_does_not() -> None:
    layers = "0\nLAYER\n2\nPART\n70\n0\n62\n7\n6\nCONTINUOUS\n"
    types = "0\nLTYPE\n2\nCENTER\n73\n4\n"
    axis = line(-50, 15, 50, 15).replace("8 0", "8 0 6 CENTER")
    data = raw(*square(0, 100, 30), axis, line(200, 0, 200, 99), layers=types + layers)
    for options, cut in (({}, 219), ({"open": "leave"}, 120)):
        said = [note for note in checked(data, **options).report.findings if says(note, CARE, "--open all")]
        assert each_says(said, Phrase("much-left", left=100, cut=cut))


@pytest.mark.parametrize(("side", "is_said"), [(999.0, False), (2001.0, True), (15000.0, True)])
@pytest.mark.parametrize("told", [4, 1])
def test_a_size_above_two_metres_is_said(side: float, is_said: bool, told: int) -> None:
    """Once, and not when the units are asked for."""
    side /= 25.4 if told == 1 else 1
    data = raw(*square(0, 0, side), header=f"9\n$INSUNITS\n70\n{told}\n")
    reading = read(data, "part.dxf", ReadOptions())
    said = [finding for finding in reading.report.findings if finding.severity is Severity.CARE]
    assert len(said) == is_said and all(advised([finding], "units") for finding in said)
    asked = read(data, "part.dxf", ReadOptions(units="mm" if told == 4 else "inch"))
    assert not asked.report.findings


@pytest.mark.parametrize("code", range(1, 25))
def test_every_unit_that_a_file_tells(code: int) -> None:
    """$INSUNITS as ezdxf converts it, or NIST's handbook 44; astronomers' units are none."""
    if code in (18, 19, 20):
        assert dxf_file.UNITS.get(code) is None
        return
    handbook = {8: 2.54e-5, 9: 0.0254, 21: 304.8006096, 22: 25.40005080, 23: 914.4018288, 24: 1609347.219}
    unit = ezdxf.units.InsertUnits(code)
    side = 100 / (handbook.get(code) or 1 / ezdxf.units.conversion_factor(ezdxf.units.MM, unit))
    assert dxf_file.UNITS[code][1] * side == pytest.approx(100, rel=1e-6)
    if dxf_file.UNITS[code][1] > 1e-5:
        corners = [(0, 0), (side, 0), (side, side), (0, side), (0, 0)]
        square = (line(*(f"{value:.17g}" for value in (*p, *q))) for p, q in pairwise(corners))
        report = read(raw(*square, header=f"9\n$INSUNITS\n70\n{code}\n"), "part.dxf").report
        assert report.size == pytest.approx((100, 100), rel=1e-6) and says(text(report.told), Phrase("units-told"))


def test_characters_that_are_told_by_numbers() -> None:
    """As files write them whose code page does not have them; half of a UTF-16 pair is none."""
    layer = "0\nLAYER\n2\nT\\U+00fcr\\U+0020\\U+D83D\n70\n0\n62\n1\n"
    data = raw(*square(0, 0, 20, "T\\U+00FCr\\U+0020\\U+D83D"), line(0, 30, 9, 30, "\\U+039B"), layers=layer)
    assert [one.layer for one in checked(data).report.layers] == ["T\u00fcr \\U+D83D", "\u039b"]
    assert len(checked(data, layers=("\u039b",)).contours) == 1


def test_old_files() -> None:
    """No HEADER and no TABLES, blank lines before it, coordinates in the order x, x, y, y, no EOF."""
    data = b"\n\n0\nSECTION\n2\nENTITIES\n" + b"".join(
        b"0\nLINE\n8\nA\n10\n%d\n11\n%d\n20\n%d\n21\n%d\n" % (p[0], q[0], p[1], q[1])
        for p, q in pairwise([(0, 0), (9, 0), (5, 7), (0, 0)])
    )
    data += b"0\nENDSEC\n"
    reading = checked(data)
    assert reading.contours[0].is_closed
    assert any(says(line, Phrase("no-eof")) for line in reading.report.report())
    # Empty lines where a group should begin are none; an empty value is one.
    blank = raw(*square(0, 0, 9), "TEXT 8 0 10 1 20 1 1 A").replace(b"\n1\nA\n", b"\n1\n\n \n\n\n")
    reading = checked(blank)
    assert len(reading.contours) == 1 and left(reading) == {"reason-nothing-to-cut": 1}
    assert each_says(reading.report.findings, Phrase("empty-lines"))


@given(st.data())
@settings(max_examples=50)
def test_damaged_files(data: st.DataObject) -> None:
    """Lines lost, doubled or garbled: a drawing, or one line that says what is wrong; never anything else."""
    drawing = DAMAGED.splitlines(keepends=True)
    for _ in range(data.draw(st.integers(1, 6))):
        at = data.draw(st.integers(0, max(0, len(drawing) - 11)))
        if len(drawing) < 20:
            break
        match data.draw(st.integers(0, 3)):
            case 0:
                del drawing[at : at + data.draw(st.sampled_from((1, 2, 10)))]
            case 1:
                drawing.insert(at, drawing[at])
            case 2:
                drawing[at] = data.draw(st.sampled_from((b"", b"-1", b"1e999", b"nan", b"\xff", b"x", b"0"))) + b"\n"
            case 3:
                drawing = drawing[: max(at, 1)]
    try:
        reading = read(b"".join(drawing), "part.dxf", ReadOptions(units="mm"))
    except UserError as error:
        assert str(error).startswith("part.dxf: ") and "\n" not in str(error)
    else:
        assert all(map(str, reading.report.report()))


def _damaged() -> bytes:
    drawing = ezdxf.new("R2000", setup=False)
    space = drawing.modelspace()
    block = drawing.blocks.new("B")
    block.add_circle((0, 0), 2)
    block.add_spline([(0, 0), (5, 2), (9, 0)])
    space.add_blockref("B", (3, 4), {"row_count": 2, "row_spacing": 30})
    space.add_lwpolyline([(0, 0, 0.4), (60, 0, 0), (60, 60, -1), (0, 60, 0)], format="xyb", close=True)
    space.add_ellipse((5, 5), (4, 1), 0.4)
    space.add_polyline2d([(100, 0), (110, 0), (105, 8)], close=True)
    text = dxf_bytes(drawing)
    # (what is read of it: units, layers, blocks, entities)
    keep = [part for part in text.split(b"  0\nSECTION\n") if part.lstrip().startswith((b"2\nBLOCKS", b"2\nENTITIES"))]
    return b"".join(b"  0\nSECTION\n" + part for part in keep) + b"  0\nEOF\n"


DAMAGED = _damaged()


SVG = """<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"
 xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" {size}>{content}</svg>"""


def svg(content: str, size: str = 'width="200mm" height="100mm" viewBox="0 0 200 100"') -> bytes:
    return SVG.format(content=content, size=size).encode()


def read_svg(content: str, **options: object) -> Reading:
    return read(svg(content), "part.svg", ReadOptions(**options))


def test_svg_shapes() -> None:
    """Every shape, where it stands with y upwards from the page's lower edge."""
    reading = read_svg(
        '<rect x="10" y="20" width="30" height="40"/><rect x="50" y="20" width="30" height="40" rx="5"/>'
        '<circle cx="100" cy="50" r="8"/><ellipse cx="130" cy="50" rx="10" ry="5"/>'
        '<polygon points="150,10 160,10 155,20"/><path d="M170 10 h10 v10 h-10 z M172 12 h2 v2 h-2 z"/>'
        '<path d="M170 50 a5 5 0 0 1 10 0 z"/><path d="M150 80 c0 -10 10 -10 10 0 q-5 5 -10 0"/>'
        '<line x1="5" y1="95" x2="9" y2="95"/><text x="1" y="1">A</text><path d="M0 0"/>'
    )
    report = reading.report
    assert report.units == "mm" and says(text(report.told), Phrase("units-told"))
    assert [contour.is_closed for contour in reading.contours] == [True] * 9 + [False]
    assert sorted(reading.contours[0].points())[0] == pytest.approx((10, 40))
    assert len(reading.contours[1].edges) == 8
    circle = reading.contours[2].edges[0]
    assert circle.is_circle and circle.centre == pytest.approx((100, 50)) and circle.radius == pytest.approx(8)
    assert length([reading.contours[3]]) == pytest.approx(48.4422, abs=1e-3)
    (half,) = [
        contour
        for contour in reading.contours
        if any(edge.centre for edge in contour.edges) and len(contour.edges) == 2
    ]
    assert max(y for _, y in half.points()) == pytest.approx(55)
    assert left(reading) == {"reason-text-to-paths": 1, "reason-no-length": 1}


@pytest.mark.parametrize(
    ("program", "pixels"), [('inkscape:version="0.48.3.1"', 90), ('inkscape:version="0.91"', 90), ("", 96)]
)
def test_svg_page_in_mm_without_a_view_box(program: str, pixels: int) -> None:
    """Its shapes are in pixels, which are those of the program that wrote it (an old Inkscape's page is so)."""
    side = 20 * pixels / 25.4
    content = f'<rect x="{side}" y="0" width="20mm" height="{side / 2}"/><rect x="50%" width="{side}" height="9"/>'
    reading = read(svg(content, f'width="200mm" height="100mm" {program}'), "part.svg", ReadOptions())
    report = reading.report
    assert report.size == pytest.approx((100, 10)) and report.low == pytest.approx((20, 90))
    assert report.units == "mm" and says(text(report.told), Phrase("units-told"))
    assert says(text(report.told), Phrase("px-inkscape")) == bool(program)
    inches = read(svg(content, f'width="200mm" height="100mm" {program}'), "part.svg", ReadOptions(units="inch"))
    assert inches.report.size == pytest.approx((2540, 254))


def test_parts_of_a_path_that_touch_themselves_and_each_other() -> None:
    """Each is the contour that it is drawn as, in one path or in many."""
    parts = "M0 0h30v20h-30z", "M5 5h20v10l-1 1 1 1v-2h-20z", "M5 5l-5 -5h2z"
    apart, together = (
        read_svg("".join(f'<path d="{part}"/>' for part in parts)),
        read_svg(f'<path d="{" ".join(parts)}"/>'),
    )
    assert [contour.edges for contour in together.contours] == [
        tuple(replace(edge, entity=0) for edge in contour.edges) for contour in apart.contours
    ]
    assert [len(contour.edges) for contour in together.contours] == [4, 7, 3]


def test_svg_path_without_any_data() -> None:
    """As matplotlib writes the glyph of a space."""
    content = '<defs><path id="a"/></defs><use href="#a"/><path/><rect x="1" y="1" width="20" height="10"/>'
    assert len(read_svg(content).contours) == 1


def test_svg_transforms() -> None:
    """Groups within groups, mirrored, turned, skewed, used twice: by the matrix of each, worked out by hand."""
    reading = read_svg(
        '<defs><path id="p" d="M0 0 h10 a5 3 0 0 1 0 6 h-10 z"/></defs>'
        '<g transform="translate(50 50)"><g transform="rotate(90) scale(1 -1)"><use xlink:href="#p"/></g></g>'
        '<g transform="matrix(1 0 0.5 1 120 20)"><use xlink:href="#p" x="5"/></g>'
    )
    one, other = reading.contours
    # (x, y) -> (50 + y, 50 + x) on the page, then upwards; half an ellipse of 3 by 5 at the end
    assert max(y for _, y in one.points()) == pytest.approx(100 - 50)
    assert min(y for _, y in one.points()) == pytest.approx(100 - 50 - 10 - 5 * 3 / 3, abs=0.01)
    assert max(x for x, _ in one.points()) == pytest.approx(56)
    # a skew keeps areas: 60 and half an ellipse of 5 and 3
    for contour in (one, other):
        assert abs(contour.area) == pytest.approx(60 + pi * 5 * 3 / 2, abs=0.01)


def test_svg_layers_and_units(run: Run, tmp_path: Path) -> None:
    content = (
        '<g inkscape:groupmode="layer" inkscape:label="Cut"><circle cx="20" cy="20" r="9"/></g>'
        '<g inkscape:groupmode="layer" inkscape:label="START"><circle cx="20" cy="20" r="1"/></g>'
        '<g inkscape:groupmode="layer" inkscape:label="Old" style="display:none"><circle cx="50" cy="20" r="9"/></g>'
    )
    reading = read_svg(content)
    assert reading.starts == [pytest.approx((20, 80))]
    assert left(reading) == {"reason-not-displayed": 1, "reason-start-hole": 1}
    part = tmp_path / "part.svg"
    part.write_bytes(svg(content, 'width="400" height="200" viewBox="0 0 200 100"'))
    assert says(run("cut", part).stderr, Phrase("size-guessed", units="px"), Phrase("px-96"))
    assert (
        "CUT (40,160):18"
        in run("cut", part, "--units", "mm", "--layer", "cut", "-o", os.devnull, "--program", "-").stdout
    )
    circle = (Phrase("count-kind", count=1, kind="circle"),)
    listed = [str(Phrase("layer-list", layer=layer, kinds=circle)) for layer in ("Cut", "Old", "START")]
    assert run("cut", part, "--list-layers").stdout.splitlines() == listed


@pytest.mark.parametrize(
    ("data", "facts"),
    [
        (b"<svg", [Phrase("not-svg")]),
        (b"<html></html>", [Phrase("svg-root", root="html")]),
        (svg("<path d='M0 0 L10 x'/><text>a</text>"), [Phrase("nothing-to-cut")]),
        (svg("<image/>"), [Phrase("nothing-to-cut"), Phrase("reason-picture")]),
        (
            svg("<defs><path d='M0 0h9'/><font><glyph d='M0 0h9'/></font></defs>"),
            [
                Phrase("nothing-to-cut"),
                Phrase("kind-and-reason", count=1, kind="path"),
                Phrase("kind-and-reason", count=1, kind="glyph"),
            ],
        ),
    ],
)
def test_svg_that_is_none(data: bytes, facts: list[str]) -> None:
    with pytest.raises(UserError, match=pattern(*facts)):
        read(data, "part.svg")


@pytest.mark.parametrize("before", ["", "999\nA remark\n999\nand another\n"])
def test_dxf_whose_name_says_svg(before: str) -> None:
    assert read(before.encode() + raw(*square(0, 0, 30)), "part.svg").report.closed == 1


@pytest.mark.parametrize(
    ("data", "facts"),
    [
        (b"AC1015\0\0\0", [Phrase("dwg")]),
        (b"AutoCAD Binary DXF\r\n\x1a\0\0\0SEC", [Phrase("not-binary-dxf")]),
        (b"0\nSECTION\n2\nENTITIES\nLINE\n", [Phrase("line-number", line=5), Phrase("no-group-code", text="LINE")]),
    ],
)
def test_files_that_are_none(data: bytes, facts: list[str]) -> None:
    with pytest.raises(UserError, match=pattern("part.dxf: ", *facts)):
        read(data, "part.dxf")


def test_command(run: Run, tmp_path: Path) -> None:
    """An open contour is not cut with an offset unless that is asked for."""
    part = tmp_path / "part.dxf"
    part.write_bytes(raw(line(0, 0, 10, 0), line(10, 0, 10, 10), *square(20, 20, 10)))
    with pytest.raises(UserError) as refused:
        run("cut", part, "--offset", "0.1")
    told = str(refused.value)
    assert re.match(
        pattern(
            f"{part}: ", Phrase("open-refused", count=1), Phrase("first-gap", place=(0, 0), gap=14.1421, other=(10, 10))
        ),
        told,
    )
    assert says(told, "--tolerance", "--open cut", "--open leave")
    counts = [
        run("cut", part, "--offset", "0.1", "--open", word, "-o", os.devnull, "--program", "-").stdout.count("FROM")
        for word in ("cut", "leave", "all")
    ]
    assert counts == [2, 1, 2]


def test_told_tolerance_closes_the_gap() -> None:
    """The tolerance that a report or a refusal tells closes the contour, and loses no edge; else none is told."""
    drawn = [line(0, 0.3, 0, 10), line(0, 10, 20, 10), line(20, 10, 20, 0), line(20, 0, 0, 0)]
    told = {}
    for shortest in (0.2, 1):
        data = raw(*drawn, *square(5, 5, shortest))
        with pytest.raises(UserError) as refused:
            read(data, "part.dxf", ReadOptions(open="refuse"))
        report = read(data, "part.dxf").report.report()
        told[shortest] = {*advised([*report, refused.value.finding], "tolerance")} - {None}
    assert not told[0.2] and len(told[1]) == 1
    closed = read(data, "part.dxf", ReadOptions(tolerance=float(*told[1]), open="refuse")).report
    assert (closed.closed, closed.open, closed.layers[0].cut) == (2, 0, 8)


def test_near_is_distance() -> None:
    """The nearest other end is told, not the other end of the contour."""
    reading = checked(raw(line(0, 0, 10, 0), line(10.3, 0, 20, 0)))
    gaps = {end.place: (end.other, end.gap) for end in reading.report.open_ends}
    assert gaps[10, 0] == ((10.3, 0), pytest.approx(0.3))
    assert distance((0, 0), gaps[0, 0][0]) == pytest.approx(10)
