"""Drawings as they come from a drawing office, made with ezdxf: each function returns one."""

from __future__ import annotations

from math import acos, asin, atan2, cos, degrees, hypot, pi, radians, sin, sqrt, tan

import ezdxf
from ezdxf.document import Drawing
from ezdxf.layouts import Modelspace

QUARTER = tan(pi / 8)


def new() -> tuple[Drawing, Modelspace]:
    drawing = ezdxf.new("R2010", units=ezdxf.units.MM)
    return drawing, drawing.modelspace()


def rounded(space: Modelspace, corners: list[tuple[float, float, float]]) -> None:
    """A closed polyline through corners (x, y, r), each rounded with its radius; 0 leaves it sharp."""
    points: list[tuple[float, float, float]] = []
    for at, (x, y, r) in enumerate(corners):
        before, after = corners[at - 1], corners[(at + 1) % len(corners)]
        one, other = (atan2(q - y, p - x) for p, q, _ in (before, after))
        bend = (other - one) % (2 * pi) - pi
        reach = r * tan(abs(bend) / 2)
        points += [
            (x + reach * cos(one), y + reach * sin(one), tan(bend / 4)),
            (x + reach * cos(other), y + reach * sin(other), 0),
        ][not r :]
    space.add_lwpolyline(points, format="xyb", close=True)


def bent_slot(
    space: Modelspace, centre: tuple[float, float], radius: float, width: float, first: float, last: float
) -> None:
    """A slot around a centre: two arcs, from angle to angle (degrees), and two round ends."""
    half = width / 2
    ends = [
        (centre[0] + radius * cos(radians(angle)), centre[1] + radius * sin(radians(angle))) for angle in (first, last)
    ]
    space.add_arc(centre, radius + half, first, last)
    space.add_arc(centre, radius - half, first, last)
    space.add_arc(ends[0], half, first + 180, first)
    space.add_arc(ends[1], half, last, last + 180)


def die_plate() -> Drawing:
    """A rounded plate with four holes, a slot of lines and arcs, and a title."""
    drawing, space = new()
    width, height, r = 80, 50, 6
    space.add_lwpolyline([(r, 0, 0), (width - r, 0, QUARTER), (width, r, 0), (width, height - r, QUARTER),
                          (width - r, height, 0), (r, height, QUARTER), (0, height - r, 0), (0, r, QUARTER)],
                         format="xyb", close=True)  # fmt: skip
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
        centre = (
            (root[0] + following[0]) / 2 - away * (following[1] - root[1]),
            (root[1] + following[1]) / 2 + away * (following[0] - root[0]),
        )
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
        ezdxf.math.BSpline([(60, 20), (52, 38), (44, 8), (36, 40), (24, 30)], order=4)
    )
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
    bracket.add_lwpolyline(
        [(0, 0, 0), (20, 0, 0), (20, 6, -0.3), (12, 14, 0), (12, 25, 1), (0, 25, 0)], format="xyb", close=True
    )
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
    rounded(space, [(0.0, 0.0, 0.125), (2.0, 0.0, 0.125), (0.8, 1.5, 0.125)])
    space.add_circle((0.9, 0.5), 0.2)
    return drawing


def bracket() -> Drawing:
    """The drawing of docs/tools.md: a bracket with rounded corners, a bore, a slot and an ellipse."""
    drawing, space = new()
    outline = [(4, 0, 0), (66, 0, QUARTER), (70, 4, 0), (70, 20, 0), (40, 30, 0), (4, 30, QUARTER),
               (0, 26, 0), (0, 4, QUARTER)]  # fmt: skip
    space.add_lwpolyline(outline, format="xyb", close=True, dxfattribs={"layer": "PART"})
    space.add_circle((12, 15), 6, {"layer": "PART"})
    space.add_lwpolyline(
        [(26, 11, 0), (36, 11, 1), (36, 19, 0), (26, 19, 1)], format="xyb", close=True, dxfattribs={"layer": "PART"}
    )
    space.add_ellipse((55, 11), (6, 0), 0.5, dxfattribs={"layer": "PART"})
    space.add_text("BRACKET", dxfattribs={"layer": "NOTES"})
    return drawing


def gear_wheel() -> Drawing:
    """A wheel of 18 teeth with rounded tips and roots, five bent windows and a bore with two keyways."""
    drawing, space = new()
    corners = []
    for tooth in range(18):
        for angle, radius, r in ((-6.2, 34.4, 1.1), (-2.3, 40.0, 0.45), (2.3, 40.0, 0.45), (6.2, 34.4, 1.1)):
            turn = radians(20 * tooth + angle)
            corners.append((radius * cos(turn), radius * sin(turn), r))
    rounded(space, corners)
    for window in range(5):
        bent_slot(space, (0, 0), 22.5, 7.2, 72 * window + 3, 72 * window + 47)
    half, bore, key = 3.0, 9.0, 11.3
    side = sqrt(bore**2 - half**2)
    angle = degrees(atan2(side, half))
    space.add_lwpolyline([(half, side), (half, key), (-half, key), (-half, side)])
    space.add_lwpolyline([(-half, -side), (-half, -key), (half, -key), (half, -side)])
    space.add_arc((0, 0), bore, -angle, angle)
    space.add_arc((0, 0), bore, 180 - angle, 180 + angle)
    return drawing


def gasket() -> Drawing:
    """A D-shaped gasket: a frame round at one side, with bolt holes all around it at no round places."""
    drawing, space = new()
    for radius, flat, r in ((46.0, 31.5, 9.5), (32.3, 17.8, 4.25)):
        # The flat side is a line x = -flat, its corners are rounded into the circle.
        height = sqrt((radius - r) ** 2 - (flat - r) ** 2)
        angle = degrees(atan2(height, r - flat))
        space.add_line((-flat, height), (-flat, -height))
        space.add_arc((0, 0), radius, -angle, angle)
        space.add_arc((r - flat, height), r, angle, 180)
        space.add_arc((r - flat, -height), r, 180, -angle)
    for hole in range(-4, 5):
        turn = radians(27.3 * hole)
        space.add_circle((39.15 * cos(turn), 39.15 * sin(turn)), 2.75)
    for y in (-9.4, 9.4):
        space.add_circle((-24.65, y), 2.75)
    return drawing


def cam_plate() -> Drawing:
    """Three eyes in a plate, arcs that touch them from one to the next, and two bent slots around the pivot."""
    drawing, space = new()
    eyes = [(0.0, 0.0, 12.5), (58.3, 14.6, 8.2), (21.7, 49.9, 9.75)]
    touching: list[tuple[float, float]] = []
    # The arc of 44 mm goes around its two eyes, the others are hollow and lie between theirs.
    for at, blend in enumerate((-70.0, 44.0, -61.5)):
        (x, y, r), (p, q, s) = eyes[at], eyes[(at + 1) % 3]
        apart, way = hypot(p - x, q - y), atan2(q - y, p - x)
        one, other = abs(blend - r), abs(blend - s)
        lean = acos((apart**2 + one**2 - other**2) / (2 * apart * one)) * (1 if blend > 0 else -1)
        centre = x + one * cos(way + lean), y + one * sin(way + lean)
        angles = [degrees(atan2(v - centre[1], u - centre[0])) for u, v in ((x, y), (p, q))]
        if blend < 0:
            angles.reverse()
        space.add_arc(centre, abs(blend), *angles)
        outwards = 180 if blend > 0 else 0
        touching.append(tuple(degrees(atan2(centre[1] - v, centre[0] - u)) + outwards for u, v in ((x, y), (p, q))))
    for at, (x, y, r) in enumerate(eyes):
        space.add_arc((x, y), r, touching[at - 1][1], touching[at][0])
        space.add_circle((x, y), r - 4.6)
    bent_slot(space, (0, 0), 26.5, 6.35, 22, 58)
    bent_slot(space, (0, 0), 40.3, 5.1, 24.5, 55)
    return drawing


def turbine_blade() -> Drawing:
    """A blade's section: a spline on each side, tangent to the small arcs at its edges, and a cooling slot."""
    drawing, space = new()
    nose, tail = ((1.2, 0.3), 1.2), ((50.0, 2.0), 0.4)
    sides = (
        (110, 65, -1, [(7.5, 8.6), (17, 13.1), (29, 12.9), (41, 8.2)]),
        (-60, -118, 1, [(9, 3.3), (18, 5.6), (29, 5.9), (40, 4.2)]),
    )
    for first, last, sense, through in sides:
        ends, tangents = [], []
        for ((x, y), r), angle in ((nose, radians(first)), (tail, radians(last))):
            ends.append((x + r * cos(angle), y + r * sin(angle)))
            tangents.append((-sense * sin(angle), sense * cos(angle)))
        space.add_spline().apply_construction_tool(
            ezdxf.math.fit_points_to_cad_cv([ends[0], *through, ends[1]], tangents)
        )
    space.add_arc(*nose, 110, -60)
    space.add_arc(*tail, -118, 65)
    space.add_lwpolyline(
        [(17.3, 8.15, 0), (27.9, 8.4, 0.83), (27.9, 10.35, 0), (17.3, 9.95, 1.11)], format="xyb", close=True
    )
    return drawing


ALL = (die_plate, connecting_rod, ratchet, cam, punch_with_spline, mirrored_blocks, in_inches, bracket,
       gear_wheel, gasket, cam_plate, turbine_blade)  # fmt: skip
