"""Entities that few programs write, and what lines are drawn with: what is cut, left and said."""

from __future__ import annotations

from itertools import pairwise
from math import pi

import ezdxf
import pytest
from ezdxf.document import Drawing
from ezdxf.math import Matrix44, Vec3
from facthelp import each_says, pattern, says
from test_reading import checked, dxf_bytes, left, line, raw, square
from toolhelp import in_time

from skg.errors import UserError
from skg.geometry.plane import distance
from skg.messages.finding import Finding, Phrase
from skg.messages.render import text
from skg.reading.dxf_placing import LEAVES
from skg.reading.read import Reading, read

LAYERS = "0\nLAYER\n2\nAXES\n70\n0\n62\n1\n6\nCENTER\n0\nLAYER\n2\nPART\n70\n0\n62\n7\n6\nCONTINUOUS\n"
TYPES = "0\nLTYPE\n2\nCENTER\n73\n4\n0\nLTYPE\n2\nCONTINUOUS\n73\n0\n"
DASHED = "dashes", "closed outline", "--open all"


def notes(reading: Reading, code: str) -> list[Finding]:
    return [finding for finding in reading.report.report() if finding.code == code]


def mm() -> Drawing:
    return ezdxf.new("R2010", units=ezdxf.units.MM)


def test_multilines() -> None:
    """Two lines with caps are one closed contour each; without caps they are two open ones; closed ones two rings."""
    drawing = mm()
    for name, flags in (("SQUARE", 16 | 256), ("ROUND", 64 | 1024), ("OPEN", 0)):
        style = drawing.mline_styles.new(name)
        style.elements.append(1.5)
        style.elements.append(-1.5)
        style.dxf.flags = flags
    space = drawing.modelspace()
    space.add_mline([(0, 0), (50, 0), (50, 30)], dxfattribs={"style_name": "SQUARE", "justification": 1})
    space.add_mline([(0, 60), (50, 60)], dxfattribs={"style_name": "ROUND", "justification": 1})
    space.add_mline([(0, 80), (50, 80)], dxfattribs={"style_name": "OPEN", "justification": 1})
    space.add_mline([(100, 0), (150, 0), (150, 30)], close=True, dxfattribs={"style_name": "OPEN", "justification": 1})
    contours = checked(dxf_bytes(drawing)).contours
    lengths = [(one.is_closed, sum(edge.length for edge in one.edges)) for one in contours]
    # A band 3 wide is as long as its two sides and its two ends; at a corner the outer side is 3 longer than the inner.
    assert [one.is_closed for one in contours] == [True, True, False, False, True, True]
    assert lengths[0][1] == pytest.approx(2 * 80 + 2 * 3, abs=1e-6)
    assert lengths[1][1] == pytest.approx(100 + 3 * pi, abs=1e-6)
    assert [length for _, length in lengths[2:4]] == pytest.approx([50, 50])
    middle = 50 + 30 + (50**2 + 30**2) ** 0.5
    assert sum(length for _, length in lengths[4:]) == pytest.approx(2 * middle, abs=1e-6)


def test_multiline_without_its_style() -> None:
    drawing = mm()
    drawing.modelspace().add_mline([(0, 0), (50, 0)])
    drawing.modelspace().add_circle((90, 0), 5)
    data = dxf_bytes(drawing).replace(b"MLINESTYLE", b"NOLINESTYL")
    reading = checked(data)
    assert len(reading.contours) == 1
    assert says(notes(reading, "layer-sum")[0], Phrase("reason-no-style", name="Standard"))


def test_old_line_in_space() -> None:
    """3DLINE, a line in space by AutoCAD before release 11, is read."""
    sides = [line(*p, *q).replace("LINE", "3DLINE", 1) for p, q in pairwise([(0, 0), (9, 0), (0, 9), (0, 0)])]
    assert checked(raw(*sides)).contours[0].is_closed


def test_thickness_is_said() -> None:
    reading = checked(raw("CIRCLE 8 PART 10 5 20 5 40 4 39 12.5", "CIRCLE 8 PART 10 50 20 5 40 4 39 0.0"))
    assert len(reading.contours) == 2
    assert each_says(notes(reading, "seen-thick"), (Phrase("seen-thick", count=1, layer="PART", place=(9, 5))))


def test_faces_are_named() -> None:
    face = "3DFACE 10 0 20 0 30 0 11 9 21 0 31 0 12 9 22 9 32 0 13 0 23 9 33 0"
    assert left(checked(raw(face, *square(20, 0, 9)))) == {"reason-face": 1}


AXIS = line(2, 5, 8, 5, "AXES")


def types(*entities: str) -> bytes:
    return raw(*entities, layers=TYPES + LAYERS)


def test_solids_are_named() -> None:
    """Solids are listed with advice to the user, a region with the advice to explode it."""
    solids = [f"{kind} 8 0 100 AcDbModelerGeometry 70 1" for kind in ("3DSOLID", "EXTRUDEDSURFACE", "REGION")]
    reasons = [(one.kind, one.reason.code) for one in checked(raw(*square(0, 0, 9), *solids)).report.not_understood]
    assert reasons == [("3DSOLID", "reason-solid"), ("EXTRUDEDSURFACE", "reason-solid"), ("REGION", "reason-acis")]


def test_a_polyline_that_is_not_read_is_placed_at_its_first_corner() -> None:
    """The place of the polyline itself is always (0, 0)."""
    corners = "".join(f"\n0\nVERTEX\n8\n0\n10\n{x}\n20\n7\n30\n{z}\n70\n32" for x, z in ((40, 0), (60, 5), (60, 9)))
    tilted = "POLYLINE 8 0 66 1 70 9 10 0 20 0" + corners + "\n0\nSEQEND"
    (left,) = checked(raw(*square(0, 0, 9), tilted)).report.not_understood
    assert left.place == (40, 7) and left.reason.code == "reason-leaves-plane"


@pytest.mark.parametrize(("plane", "upwards"), [("xz", "y"), ("yz", "x")])
def test_a_drawing_that_stands_upright(plane: str, upwards: str) -> None:
    """As a sketch on another plane is exported: read as it is seen from the front or from the right, its blocks too."""
    axes = {"x": Vec3(1, 0, 0), "y": Vec3(0, 1, 0), "z": Vec3(0, 0, 1)}
    right, up = (axes[axis] for axis in plane)

    def drawn(*, turned: bool) -> Drawing:
        drawing = mm()
        block = drawing.blocks.new("PIN")
        block.add_lwpolyline([(0, 0, 0), (8, 0, 1), (8, 4, 0), (0, 4, 0)], format="xyb", close=True)
        space = drawing.modelspace()
        space.add_lwpolyline([(0, 0), (60, 0), (60, 40), (0, 30)], close=True)
        space.add_circle((15, 15), 5)
        space.add_arc((40, 15), 6, 20, 270)
        space.add_spline([(5, 45), (20, 60), (30, 42), (40, 50)])
        space.add_blockref("PIN", (20, 20), {"rotation": 30})
        matrix = Matrix44.ucs(right, up, right.cross(up))
        for one in space if turned else ():
            one.transform(matrix)
        return drawing

    flat, standing = (checked(dxf_bytes(drawn(turned=turned))) for turned in (False, True))
    note = Phrase("standing", first=plane[0], second=plane[1])
    assert any(says(told, note) for told in standing.report.findings)
    assert len(standing.contours) == len(flat.contours) == 5
    for one, other in zip(standing.contours, flat.contours, strict=True):
        assert one.area == pytest.approx(other.area, abs=1e-6)
        for edge, same in zip(one.edges, other.edges, strict=True):
            assert max(distance(edge.at(t), same.at(t)) for t in (0, 0.3, 1)) < 1e-6
    both = drawn(turned=True)
    both.modelspace().add_lwpolyline([(0, 0), (60, 0), (60, 40), (0, 30)], close=True)
    assert {one.reason for one in checked(dxf_bytes(both)).report.not_understood} == {LEAVES}


def test_axes_within_an_outline_are_left() -> None:
    """By the layer's line type, or the entity's own; --open all and --layer cut them."""
    own = line(3, 3, 7, 3) + " 6 Center"
    data = types(*square(0, 0, 10, "PART"), AXIS, own)
    reading = checked(data)
    assert [one.is_closed for one in reading.contours] == [True]
    assert left(reading) == {"reason-dashed": 2}
    assert len(checked(data, open="refuse").contours) == 1
    assert len(checked(data, open="all").contours) == 3
    assert len(checked(data, layers=("PART", "AXES")).contours) == 2


def test_a_circle_of_dashes_that_holes_lie_on_is_left() -> None:
    """It crosses them; a part in it is none that it crosses, and where all is in dashes it is cut."""
    holes = [f"CIRCLE 8 {{}} 10 {x} 20 {y} 40 1" for x, y in ((15, 10), (5, 10), (10, 15), (10, 5))]
    pitch = "CIRCLE 8 AXES 10 10 20 10 40 5"
    reading = checked(types(*square(0, 0, 20, "PART"), pitch, *(hole.format("PART") for hole in holes)))
    assert len(reading.contours) == 5 and not any(says(note, "1 entity", "dashes") for note in reading.report.findings)
    assert left(reading) == {"reason-axis": 1}
    assert not reading.report.overlaps
    data = types(pitch, *(hole.format("PART") for hole in holes))
    assert [len(checked(data, **options).contours) for options in ({}, {"open": "all"}, {"layers": ("AXES",)})] == [
        4,
        5,
        1,
    ]
    assert len(checked(types(*square(0, 0, 20, "PART"), pitch, *(hole.format("AXES") for hole in holes))).contours) == 6


def test_lines_that_are_drawn_through_are_cut() -> None:
    """An engraved line, by the types of its layer and itself; one that says CONTINUOUS on the layer of the axes."""
    data = types(*square(0, 0, 10, "PART"), line(2, 5, 8, 5, "PART"), line(2, 7, 8, 7, "AXES") + " 6 CONTINUOUS")
    reading = checked(data)
    assert len(reading.contours) == 3
    assert not notes(reading, "seen-dashed")


def test_an_outline_that_dashes_start_from() -> None:
    """Lines that lie behind the part begin at its corners: they are no part of the outline, on whatever layer."""
    behind = [f"{one} 6 CENTER" for one in (line(0, 0, 0, -5), line(0, -5, 10, -5), line(10, -5, 10, 0))]
    reading = checked(raw(*square(0, 0, 10), *behind, layers=TYPES))
    assert max(y for edge in reading.contours[0].edges for _, y in edge.extremes()) == 10
    assert min(y for edge in reading.contours[0].edges for _, y in edge.extremes()) == 0
    assert len(reading.contours) == 1
    assert len(reading.report.rest) == 3


def test_a_drawing_in_dashes_is_cut() -> None:
    """Dashed lines are cut if no outline is solid; they are reported, as is a dashed opening."""
    reading = checked(types(*square(0, 0, 10, "AXES"), AXIS))
    assert len(reading.contours) == 2
    assert each_says(
        notes(reading, "seen-dashed"), (Phrase("seen-dashed", count=5, layer="AXES", dashes="CENTER", place=(0, 0)))
    )
    reading = checked(types(*square(0, 0, 10, "PART"), "CIRCLE 8 AXES 10 5 20 5 40 2"))
    assert len(reading.contours) == 2
    assert each_says(
        notes(reading, "seen-dashed"), (Phrase("seen-dashed", count=1, layer="AXES", dashes="CENTER", place=(7, 5)))
    )


def test_dashes_of_a_block() -> None:
    """An entity drawn BYBLOCK has the line type of its reference."""
    drawing = mm()
    drawing.linetypes.add("DASHED", [1.0, 0.6, -0.4])
    block = drawing.blocks.new("MARK")
    block.add_line((0, 0), (3, 0), {"linetype": "BYBLOCK"})
    space = drawing.modelspace()
    space.add_circle((0, 0), 20)
    space.add_blockref("MARK", (1, 1), {"linetype": "DASHED"})
    space.add_blockref("MARK", (1, 5))
    reading = checked(dxf_bytes(drawing))
    assert left(reading) == {"reason-dashed": 1}
    assert len(reading.contours) == 2


def test_decimal_commas() -> None:
    """As programs write them where they are the custom; a word or a list with a comma is none."""
    data = raw("CIRCLE 8 a,5 10 50,25 20 -7,5 40 4,5e0", "CIRCLE 8 a,5 10 1,2,3 20 0 40 4")
    reading = checked(data)
    (contour,) = reading.contours
    assert contour.edges[0].centre == (50.25, -7.5)
    assert contour.layers == ("a,5",)
    assert each_says(notes(reading, "decimal-commas"), (Phrase("decimal-commas")))
    assert not notes(checked(raw("CIRCLE 8 a,5 10 50.25 20 -7.5 40 4.5")), "commas")


def test_a_binary_file_that_went_as_text() -> None:
    data = dxf_bytes(mm(), binary=True).replace(b"\r\n", b"\n")
    with pytest.raises(UserError, match=pattern(Phrase("binary-changed"))):
        read(data, "part.dxf")


@pytest.mark.parametrize("measurement", [0, 1])
def test_inches_are_hinted_at(measurement: int) -> None:
    """A drawing without units says at least by which country's custom its hatches are drawn."""
    header = f"9\n$INSUNITS\n70\n0\n9\n$MEASUREMENT\n70\n{measurement}\n"
    said = read(raw(*square(0, 0, 9), header=header), "part.dxf").report.report()[0]
    assert says(said, Phrase("size-guessed", width=9, height=9, units="mm"), Phrase("units-not-told")) and says(
        said, Phrase("size-guessed"), Phrase("units-inches")
    ) == (not measurement)


def test_a_circle_that_is_longer_than_a_tape() -> None:
    """No more work is begun than for one that fits."""

    def circle(radius: float) -> None:
        checked(raw(f"CIRCLE 10 0 20 0 40 {radius}"))

    def too_long() -> None:
        with pytest.raises(UserError, match=pattern(Phrase("size-too-far", most=50))):
            circle(86000)

    in_time(10, too_long, lambda: circle(8))


def test_areas_without_lines() -> None:
    with pytest.raises(
        UserError,
        match=pattern(
            Phrase("nothing-to-cut"), Phrase("kind-and-reason", count=1, kind="SOLID"), Phrase("draw-outlines")
        ),
    ):
        checked(raw("SOLID 10 0 20 0 11 9 21 0 12 0 22 9 13 9 23 9"))


def test_spline_through_points_alone() -> None:
    """Some of its points come twice; the curve runs through all of them, and what is guessed is said."""
    places = [(0, 0), (10, 8), (10, 8), (20, 0), (30, 8), (30, 8), (30, 8), (40, 0)]
    fit = " ".join(f"11 {x} 21 {y} 31 0" for x, y in places)
    reading = checked(raw(f"SPLINE 8 0 70 0 71 3 72 0 73 0 74 {len(places)} {fit}"))
    (edge,) = reading.contours[0].edges
    for place in places:
        assert min(distance(place, sample) for sample in edge.samples) < 0.05
    assert each_says(
        notes(reading, "seen-through-points"), (Phrase("seen-through-points", count=1, layer="0", place=(0, 0)))
    )


#: Entities with a {} where their extrusion stands; a block of an arc for the reference.
MIRRORED = {
    "ARC": "ARC 8 0 10 5 20 0 40 10 50 0 51 90 {}",
    "ARC, first": "ARC 8 0 {} 10 5 20 0 30 0 40 10 50 0 51 90",
    "CIRCLE": "CIRCLE 8 0 100 AcDbEntity 100 AcDbCircle 10 5 20 0 30 0 40 10 {}",
    "ELLIPSE": "ELLIPSE 8 0 10 5 20 0 30 0 11 10 21 0 31 0 {} 40 0.5 41 0 42 1.5",
    "LWPOLYLINE": "LWPOLYLINE 8 0 90 3 70 1 {} 10 5 20 0 42 0.3 10 20 20 0 10 5 20 10",
    "POLYLINE": "POLYLINE 8 0 66 1 70 1 {} 0 VERTEX 8 0 10 5 20 0 42 0.3 0 VERTEX 8 0 10 20 20 0 0 VERTEX 8 0 10 5 20 9"
    " 0 SEQEND",
    "INSERT": "INSERT 8 0 2 CORNER 10 5 20 0 {}",
}  # fmt: skip
CORNER = "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n8\n0\n2\nCORNER\n10\n0\n20\n0\n"
CORNER += "0\nARC\n8\n0\n10\n1\n20\n0\n40\n10\n50\n0\n51\n90\n0\nENDBLK\n0\nENDSEC\n"


def edges_of(*entities: str) -> list[tuple]:
    """The edges of a drawing's contours, with their samples' middle."""
    data = raw(*entities).replace(b"0\nSECTION\n2\nENTITIES\n", CORNER.encode() + b"0\nSECTION\n2\nENTITIES\n")
    found = [edge for contour in checked(data).contours for edge in contour.edges]
    assert found
    return [(edge.start, edge.at(0.3), edge.end) for edge in found]


@pytest.mark.parametrize("written", ["230 -1", "230 -1 210 0 220 0", "220 0 230 -1", "210 0 230 -1", "230 -1 220 0"])
@pytest.mark.parametrize("kind", MIRRORED)
def test_an_extrusion_in_any_order(kind: str, written: str) -> None:
    """z of an extrusion alone, or in front of x and y: the entity is mirrored as with x, y and z."""
    whole = edges_of(MIRRORED[kind].format("210 0 220 0 230 -1"))
    assert whole != edges_of(MIRRORED[kind].format(""))
    assert edges_of(MIRRORED[kind].format(written)) == whole


@pytest.mark.parametrize("written", ["210 0 220 0 230 1", "230 1", "230 0", "210 0", "230 0.0 220 0"])
@pytest.mark.parametrize("kind", MIRRORED)
def test_an_extrusion_that_says_nothing(kind: str, written: str) -> None:
    assert edges_of(MIRRORED[kind].format(written)) == pytest.approx(edges_of(MIRRORED[kind].format("")))


@pytest.mark.parametrize(
    ("usual", "written"),
    [
        ("CIRCLE 8 0 10 5 20 3 40 2", "CIRCLE 8 0 20 3 10 5 40 2"),
        ("CIRCLE 8 0 10 5 20 3 40 2", "CIRCLE 8 0 10 5 40 2 20 3"),
        ("LINE 8 0 10 5 20 3 11 2 21 9", "LINE 8 0 21 9 20 3 10 5 11 2"),
        ("ELLIPSE 8 0 10 0 20 0 11 1 21 5 40 0.5 41 0 42 2", "ELLIPSE 8 0 10 0 20 0 21 5 11 1 40 0.5 41 0 42 2"),
        ("INSERT 8 0 2 CORNER 10 5 20 3", "INSERT 8 0 20 3 2 CORNER 10 5"),
    ],
)
def test_a_place_in_any_order(usual: str, written: str) -> None:
    """y in front of x, or apart from it."""
    assert edges_of(written) == edges_of(usual)


@pytest.mark.parametrize("half", ["CIRCLE 8 0 20 3 40 2", "CIRCLE 8 0 10 3 40 2", "INSERT 8 0 2 CORNER 20 3"])
def test_half_a_place(half: str) -> None:
    """An entity without x, or y, is listed and left: nobody knows where it was."""
    reading = checked(
        raw(line(0, 0, 9, 0), half).replace(b"0\nSECTION\n2\nENT", CORNER.encode() + b"0\nSECTION\n2\nENT")
    )
    assert [entity.kind for entity in reading.report.not_understood] == [half.split()[0]]
    assert "missing" in text(reading.report.not_understood[0].reason)
