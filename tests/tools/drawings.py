"""Drawings as they come from a drawing office, made with ezdxf: each function returns one."""

from __future__ import annotations

from math import asin, atan2, cos, degrees, hypot, pi, radians, sin, sqrt, tan

import ezdxf
from ezdxf.document import Drawing
from ezdxf.layouts import Modelspace

QUARTER = tan(pi / 8)


def new() -> tuple[Drawing, Modelspace]:
    drawing = ezdxf.new("R2010", units=ezdxf.units.MM)
    return drawing, drawing.modelspace()


def die_plate() -> Drawing:
    """A rounded plate with four holes, a slot of lines and arcs, and a title."""
    drawing, space = new()
    width, height, r = 80, 50, 6
    space.add_lwpolyline([(r, 0, 0), (width - r, 0, QUARTER), (width, r, 0), (width, height - r, QUARTER),
                          (width - r, height, 0), (r, height, QUARTER), (0, height - r, 0), (0, r, QUARTER)],
                         format="xyb", close=True)
    for x, y in ((10, 10), (70, 10), (70, 40), (10, 40)):
        space.add_circle((x, y), 3.25)
    space.add_line((30, 20), (50, 20))
    space.add_arc((30, 25), 5, 90, 270)
    space.add_line((50, 30), (30, 30))
    space.add_arc((50, 25), 5, -90, 90)
    space.add_text("PLATE")
    return drawing


def connecting_rod() -> Drawing:
    """Two eyes and the belt lines between them: every corner tangent, no coordinate round."""
    drawing, space = new()
    length, big, small = 73.5, 21.25, 9.8
    lean = asin((big - small) / length)
    angle = pi / 2 - lean
    tops = [(x + r * cos(angle), r * sin(angle)) for x, r in ((0, big), (length, small))]
    space.add_line(*tops)
    space.add_line(*[(x, -y) for x, y in reversed(tops)])
    space.add_arc((0, 0), big, degrees(angle), -degrees(angle))
    space.add_arc((length, 0), small, -degrees(angle), degrees(angle))
    space.add_circle((0, 0), 13.7)
    space.add_circle((length, 0), 5.015)
    return drawing


def ratchet() -> Drawing:
    """Twelve sharp teeth with round backs, and a bore with a keyway; drawn tooth by tooth."""
    drawing, space = new()
    outer, inner, back = 30.0, 25.0, 11.0
    for tooth in range(12):
        a, b = radians(30 * tooth), radians(30 * (tooth + 1))
        tip, root = (outer * cos(a), outer * sin(a)), (inner * cos(a), inner * sin(a))
        following = outer * cos(b), outer * sin(b)
        space.add_line(tip, root)
        # The back is an arc of radius `back` from the root to the next tip, bulging outwards.
        chord = hypot(following[0] - root[0], following[1] - root[1])
        away = sqrt(back**2 - chord**2 / 4) / chord
        centre = ((root[0] + following[0]) / 2 - away * (following[1] - root[1]),
                  (root[1] + following[1]) / 2 + away * (following[0] - root[0]))
        first, last = (degrees(atan2(y - centre[1], x - centre[0])) for x, y in (root, following))
        space.add_arc(centre, back, first, last)
    half, bore, key = 2.5, 8.0, 10.3
    side = sqrt(bore**2 - half**2)
    space.add_lwpolyline([(half, side), (half, key), (-half, key), (-half, side)])
    angle = degrees(atan2(side, half))
    space.add_arc((0, 0), bore, 180 - angle, 360 + angle)
    return drawing


def cam() -> Drawing:
    """A closed spline through the points of a disc cam, with an elliptic opening."""
    drawing, space = new()
    points = []
    for k in range(24):
        angle = 2 * pi * k / 24
        radius = 22 + 5 * (1 - cos(angle)) / 2
        points.append((radius * cos(angle), radius * sin(angle)))
    space.add_lwpolyline([(60, 60), (61, 60)], dxfattribs={"layer": "NOTES"})
    spline = ezdxf.math.global_bspline_interpolation([*points, points[0]], degree=3)
    space.add_spline(dxfattribs={"layer": "CAM"}).apply_construction_tool(spline)
    space.add_ellipse((1, 2), (7, 3), 0.6, dxfattribs={"layer": "CAM"})
    return drawing


def punch_with_spline() -> Drawing:
    """Lines, a cubic spline in their midst, half an ellipse and an arc, with start points on their layer."""
    drawing, space = new()
    space.add_line((0, 0), (60, 0))
    space.add_line((60, 0), (60, 20))
    space.add_spline().apply_construction_tool(
        ezdxf.math.BSpline([(60, 20), (52, 38), (44, 8), (36, 40), (24, 30)], order=4))
    space.add_line((24, 30), (20, 30))
    space.add_ellipse((10, 30), (10, 0), 0.55, 0, pi)
    space.add_line((0, 30), (0, 10))
    space.add_arc((0, 5), 5, 90, 270)
    space.add_lwpolyline([(30, 8, 0), (40, 8, 1), (40, 16, 0), (30, 16, 1)], format="xyb", close=True)
    space.add_point((35, 12), {"layer": "START"})
    space.add_point((30, -4.5), {"layer": "START"})
    return drawing


def mirrored_blocks() -> Drawing:
    """A bracket inserted plainly and mirrored and turned; an arc of a mirrored plane; a line drawn twice."""
    drawing, space = new()
    bracket = drawing.blocks.new("BRACKET")
    bracket.add_lwpolyline([(0, 0, 0), (20, 0, 0), (20, 6, -0.3), (12, 14, 0), (12, 25, 1), (0, 25, 0)],
                           format="xyb", close=True)
    bracket.add_circle((6, 25), 2.5)
    space.add_blockref("BRACKET", (0, 0))
    space.add_blockref("BRACKET", (60, 10), {"xscale": -1, "rotation": 17})
    space.add_line((80, 0), (100, 0))
    space.add_line((100, 0), (80, 0))
    # In a plane seen from below x counts the other way: this half circle stands over 80…100.
    space.add_arc((-90, 0), 10, 0, 180, dxfattribs={"extrusion": (0, 0, -1)})
    return drawing


def in_inches() -> Drawing:
    """A triangle with rounded corners and a hole, in inches."""
    drawing, space = new()
    drawing.units = ezdxf.units.IN
    corners = [(0.0, 0.0), (2.0, 0.0), (0.8, 1.5)]
    r = 0.125
    points = []
    for at, corner in enumerate(corners):
        before, after = corners[at - 1], corners[(at + 1) % 3]
        ways = [((x - corner[0]), (y - corner[1])) for x, y in (before, after)]
        units = [(x / hypot(x, y), y / hypot(x, y)) for x, y in ways]
        opening = atan2(units[0][1], units[0][0]) - atan2(units[1][1], units[1][0])
        opening = abs((opening + pi) % (2 * pi) - pi)
        reach = r / tan(opening / 2)
        touching = [(corner[0] + reach * x, corner[1] + reach * y) for x, y in units]
        points += [(*touching[0], tan((pi - opening) / 4)), (*touching[1], 0)]
    space.add_lwpolyline(points, format="xyb", close=True)
    space.add_circle((0.9, 0.5), 0.2)
    return drawing


def bracket() -> Drawing:
    """The drawing of docs/tools.md: a bracket with rounded corners, a bore, a slot and an ellipse."""
    drawing, space = new()
    outline = [(4, 0, 0), (66, 0, QUARTER), (70, 4, 0), (70, 20, 0), (40, 30, 0), (4, 30, QUARTER),
               (0, 26, 0), (0, 4, QUARTER)]
    space.add_lwpolyline(outline, format="xyb", close=True, dxfattribs={"layer": "PART"})
    space.add_circle((12, 15), 6, {"layer": "PART"})
    space.add_lwpolyline([(26, 11, 0), (36, 11, 1), (36, 19, 0), (26, 19, 1)], format="xyb", close=True,
                         dxfattribs={"layer": "PART"})
    space.add_ellipse((55, 11), (6, 0), 0.5, dxfattribs={"layer": "PART"})
    space.add_text("BRACKET", dxfattribs={"layer": "NOTES"})
    return drawing


ALL = (die_plate, connecting_rod, ratchet, cam, punch_with_spline, mirrored_blocks, in_inches, bracket)
