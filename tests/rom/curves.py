"""Random fitted curves: programs with FIT of every kind, most of which can be cut.

Each family makes the statements of one route; `curve_part` puts some together. The nodes lie as far apart as
people put them, with arcs of some 10 to 60 degrees; `flat` makes what a 40-bit float finds hard.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from random import Random

from parts import AGAIN, Statements, numbered, offset, point, signed, somewhere, spoilt

Place = tuple[float, float]


def fit(rng: Random, place: Place, angle: float | None = None) -> str:
    """One node; `angle` in degrees goes with it, written with few digits."""
    given = "" if angle is None else f",{angle:.{rng.randint(1, 4)}f}"
    return f"FIT {point(*place)}{given}"


def ring(rng: Random, count: int, middle: Place, size: float, wobble: float) -> list[tuple[Place, float]]:
    """Nodes of a smooth closed curve, counter-clockwise, with the direction of its tangent in degrees.

    r = size·(1 + wobble·cos(k·a + f)), k from 2 to 4; the nodes are not evenly spaced.
    """
    k, phase = rng.randint(2, 4), rng.uniform(0, 6)
    turn = rng.uniform(0, 6)
    nodes = []
    for n in range(count):
        a = turn + (n + rng.uniform(-0.2, 0.2)) * 2 * math.pi / count
        r = size * (1 + wobble * math.cos(k * a + phase))
        slope = -size * wobble * k * math.sin(k * a + phase)
        way = math.degrees(a + math.atan2(r, slope))
        nodes.append(((middle[0] + r * math.cos(a), middle[1] + r * math.sin(a)), way))
    return nodes


def wave(rng: Random, count: int, start: Place, step: float, height: float) -> list[tuple[Place, float]]:
    """Nodes of a wavy line to the right, with tangents: inflections, and arcs of either sense."""
    length, phase = rng.uniform(5, 12) * step, rng.uniform(0, 6)
    nodes = []
    for n in range(count):
        x = n * step + (rng.uniform(-0.2, 0.2) * step if 0 < n < count - 1 else 0)
        a = 2 * math.pi * x / length + phase
        slope = height * 2 * math.pi / length * math.cos(a)
        nodes.append(((start[0] + x, start[1] + height * math.sin(a)), math.degrees(math.atan(slope))))
    return nodes


def fitted(rng: Random, nodes: list[tuple[Place, float]], ends: float = 0.5) -> Statements:
    """The nodes as FITs: no tangents, all of them, some, or (as often as `ends` says) at the two ends."""
    kind = rng.random()
    if kind < 0.4:
        given = [False] * len(nodes)
    elif kind < 0.6:
        given = [True] * len(nodes)
    else:
        given = [rng.random() < 0.3 for _ in nodes]
    given[0], given[-1] = given[0] or rng.random() < ends, given[-1] or rng.random() < ends
    return [fit(rng, place, way if told else None) for (place, way), told in zip(nodes, given, strict=True)]


def closed(rng: Random) -> Statements:
    """A closed curve, smooth at its seam, of either sense; now and then entered from a point before it."""
    middle = somewhere(rng)
    nodes = ring(rng, rng.randint(5, 14), middle, rng.uniform(5, 30), rng.uniform(0, 0.25))
    if rng.random() < 0.4:
        nodes = [(place, way + 180) for place, way in reversed(nodes)]
    nodes.append(nodes[0])
    return offset(rng) + fitted(rng, nodes, ends=0.9) + rng.choice(AGAIN)


def wide(rng: Random) -> Statements:
    """A closed curve with a large offset: a concave arc may be too tight for it (error 7)."""
    nodes = ring(rng, rng.randint(6, 12), somewhere(rng), rng.uniform(10, 30), rng.uniform(0.1, 0.35))
    nodes.append(nodes[0])
    sign = rng.choice(["", "-"])
    return [f"R={sign}{rng.uniform(0.5, 12):.2f}", *(fit(rng, *node) for node in nodes), "BACK"]


def open_curve(rng: Random) -> Statements:
    """A wavy line from one end to the other; the next FROM or END ends it."""
    nodes = wave(rng, rng.randint(2, 12), somewhere(rng), rng.uniform(1, 6), rng.uniform(0.5, 8))
    return offset(rng) + fitted(rng, nodes)


def two_nodes(rng: Random) -> Statements:
    """Curves of two nodes: bare, with one tangent, with two (bows and S curves); some are impossible."""
    place = somewhere(rng)
    lines = offset(rng)
    for _ in range(rng.randint(1, 4)):
        way = rng.uniform(-180, 180)
        size = rng.uniform(2, 25)
        end = place[0] + size * math.cos(math.radians(way)), place[1] + size * math.sin(math.radians(way))
        told = [way + rng.uniform(-110, 110) if rng.random() < 0.7 else None for _ in range(2)]
        lines += [fit(rng, place, told[0]), fit(rng, end, told[1])]
        if rng.random() < 0.7:
            lines.append(f"CUT {point(*end)}")  # a corner: the next curve is one of its own
        place = end
    return lines


def straight(rng: Random) -> Statements:
    """Nodes on a line, then on an arc, then on a line again."""
    x, y = somewhere(rng)
    step, radius = rng.uniform(1, 5), rng.uniform(2, 9)
    turns = rng.randint(2, 6)
    nodes = [(x + n * step, y) for n in range(rng.randint(1, 4))]
    right = nodes[-1][0]
    bend = [(n + 1) * math.pi / turns for n in range(turns)]
    nodes += [(right + radius * math.sin(a), y + radius - radius * math.cos(a)) for a in bend]
    nodes += [(right - (n + 1) * step, y + 2 * radius) for n in range(rng.randint(1, 4))]
    if rng.random() < 0.3:
        nodes = [(px, 2 * y - py) for px, py in nodes]
    lines = offset(rng) + [fit(rng, node) for node in nodes]
    return lines + rng.choice([[], ["BACK"], [f"CUT {point(x - 5, nodes[-1][1])}"]])


def plate(rng: Random) -> Statements:
    """A plate of points with a curve for its upper edge; the corners beside the curve rounded or not."""
    nodes = wave(rng, rng.randint(3, 8), somewhere(rng), rng.uniform(2, 6), rng.uniform(0.3, 3))
    (left, first), (right, last) = nodes[0][0], nodes[-1][0]
    low = min(y for (_, y), _ in nodes) - rng.uniform(5, 20)
    lines = offset(rng)
    corners = [point(right, low), point(left, low)]
    middle = point((left + right) / 2, low)
    before, after = (rng.choice(["", "", f",{rng.uniform(0.2, 1.5):.2f}"]) for _ in range(2))
    upper = fitted(rng, nodes, ends=0.3)
    if rng.random() < 0.5:  # counter-clockwise: the curve runs back to the left
        backwards = [(place, way + 180) for place, way in reversed(nodes)]
        upper = fitted(rng, backwards, ends=0.3)
        corners.reverse()
        (left, first), (right, last) = (right, last), (left, first)
    start = point(left, first)
    lines.append(f"CUT {middle},{corners[1]}{rng.choice(['', ',0.5'])},{start}{before}")
    end = f"{point(right, last)}{after}," if after else ""
    return [*lines, *upper, f"CUT {end}{corners[0]},{middle}", *rng.choice(AGAIN)]


def between_circles(rng: Random) -> Statements:
    """A curve from one circle's point to another's, smooth there or with a corner."""
    x, y = somewhere(rng)
    r1, r2 = rng.uniform(4, 12), rng.uniform(4, 12)
    apart = r1 + r2 + rng.uniform(5, 20)
    a1, a2 = rng.uniform(30, 100), rng.uniform(80, 150)
    lines = [
        f"P1={point(x, y)}",
        f"P2={point(x - apart, y)}",
        f"C1=P1:{r1:.3f}",
        f"C2=P2:{r2:.3f}",
        f"P3=P1+({r1:.3f}#{a1:.2f})",
        f"P4=P2+({r2:.3f}#{a2:.2f})",
        *offset(rng),
        f"FROM P1+({r1 + rng.uniform(3, 9):.2f}#{-rng.uniform(20, 80):.1f})",
        "CUT C1",
    ]
    smooth = rng.random() < 0.6
    lines.append(f"FIT P3,{a1 + 90:.2f}" if smooth else "FIT P3")
    for n in range(rng.randint(0, 2)):
        lines.append(f"FIT (P3*{2 - n}+P4*{1 + n})/3+({signed(rng, 0, 1)},{signed(rng, 0, 1)})")
    lines.append(f"FIT P4,{a2 + 90:.2f}" if smooth else f"FIT P4{rng.choice(['', ',' + signed(rng, 150, 190)])}")
    return [*lines, rng.choice(["CUT C2,C2:C1", "CUT C2,C2:C1,C1"]), "BACK"]


def computed(rng: Random) -> Statements:
    """An ellipse or a cam by a loop, with tangents or without."""
    count = rng.choice([8, 9, 10, 12, 15, 16, 18])
    step = 360 / count
    big = rng.uniform(15, 40)
    small = big * rng.uniform(0.5, 0.95)
    lines = [*offset(rng), f"FROM ({big + 5:.1f},{rng.choice(['0', '-2'])})", "A=0", "*LOOP"]
    match rng.randrange(3):
        case 0:
            node = f"({big:.2f}*COS A,{small:.2f}*SIN A)"
            slope = f"P1=(-{big:.2f}*SIN A,{small:.2f}*COS A)"
            body = rng.choice([[f"FIT {node}"], [slope, f"FIT {node},(X,O:P1)"]])
        case 1:
            rise = rng.uniform(0.5, 0.12 * big)
            body = [f"D={small:.2f}+{rise:.2f}*COS (2*A)", f"D1=-2*{rise:.2f}*SIN (2*A)"]
            body.append("FIT D#A,A+90-ATG (D1/D)")
        case _:
            body = [f"D={small:.2f}+A/{rng.uniform(60, 200):.1f}", "FIT D#A"]
    return [*lines, *body, f"A=A+{step:.9g}", "IF A<=360 GOTO LOOP", "BACK"]


def copied(rng: Random) -> Statements:
    """A wheel of fitted arches by REP, from the top of one to the top of the next, a corner between them."""
    count = rng.choice([3, 4, 5, 6, 8])
    top = rng.uniform(15, 40)
    depth = top * rng.uniform(-0.15, 0.2)
    pitch, nodes = 360 / count, rng.randint(1, 3)
    radii = [top - depth * (n / nodes) ** 2 for n in range(nodes + 1)]
    angles = [pitch / 2 * n / nodes for n in range(nodes + 1)]
    lines = [*offset(rng), f"FROM {top + 6:.1f}#{signed(rng, 0, 3)}"]
    lines += [f"FIT {r:.3f}#{a:.9g}" for r, a in zip(radii, angles, strict=True)]
    lines[-nodes - 1] += ",90"
    if rng.random() < 0.7:
        corner = f"{radii[-1]:.3f}#{angles[-1]:.9g}"
        lines += [f"CUT {corner}{rng.choice(['', ',0.3', ';0.4'])}", f"FIT {corner}"]
    lines += [f"FIT {r:.3f}#{pitch - a:.9g}" for r, a in zip(radii[-2::-1], angles[-2::-1], strict=True)]
    lines[-1] += f",{90 + pitch:.9g}"
    if rng.random() < 0.2:
        lines.append(f"CUT {rng.uniform(0.2, 0.7):.2f}")  # waits for the join, which is smooth
    return [*lines, f"REP {count},{pitch:.9g}", *rng.choice(AGAIN)]


def mirrored(rng: Random) -> Statements:
    """Half an outline with a curve in it, and its image by SYM."""
    x, y = somewhere(rng)
    width = rng.uniform(8, 25)
    count = rng.randint(2, 5)
    nodes = [(x + width * (1 + 0.3 * math.sin(2.5 * n / count + 0.2)), y + 30 * n / count) for n in range(count + 1)]
    lines = [*offset(rng), f"CUT {point(x, y)}", f"CUT {point(*nodes[0])}{rng.choice(['', '', ',0.6'])}"]
    lines += [fit(rng, node) for node in nodes]
    if rng.random() < 0.6:  # the curve's own end may lie on the mirror
        lines.append(f"CUT {point(x, nodes[-1][1])}")
    else:
        lines.append(fit(rng, (x, nodes[-1][1] + rng.uniform(2, 5)), 180))
    return [*lines, f"SYM Y:{x:.3f}", *rng.choice(AGAIN)]


def changing(rng: Random) -> Statements:
    """R changes in the middle of a curve; a node is said twice; the curve is split at a node."""
    nodes = wave(rng, rng.randint(4, 9), somewhere(rng), rng.uniform(2, 6), rng.uniform(0.5, 5))
    lines = fitted(rng, nodes)
    at = rng.randrange(1, len(lines))
    match rng.randrange(3):
        case 0:
            lines.insert(at, f"R={rng.choice(['0', '0.0004', '0.1'])}")
        case 1:
            lines.insert(at, lines[at - 1])
        case _:
            lines.insert(at, f"CUT {point(*nodes[at - 1][0])}")
            lines.insert(at + 1, fit(rng, nodes[at - 1][0]))
    return offset(rng) + lines


def scaled(rng: Random) -> Statements:
    """Another route, enlarged or made smaller, then the scale set back."""
    route = rng.choice([closed, plate, computed, two_nodes])(rng)
    body = route if route[-1] in ("BACK", "RECUT") else [*route, "FROM O"]
    return [f"SCALE {rng.choice(['2', '0.5', '1.02', '0.8'])}", *body, "SCALE 1"]


def degenerate(rng: Random) -> Statements:
    """Nodes within a micrometre, there and back, tangents that go backwards, tiny spans."""
    x, y = somewhere(rng)
    near = (x + rng.choice([0.0, 0.0003, 0.0007, 0.0016, 0.003]), y)
    far = (x + rng.uniform(5, 20), y + rng.uniform(-5, 5))
    way = math.degrees(math.atan2(far[1] - y, far[0] - x))
    kinds = [
        [fit(rng, (x, y)), fit(rng, near), fit(rng, far)],
        [fit(rng, (x, y), 10), fit(rng, near, 60), fit(rng, far)],
        [fit(rng, (x, y)), fit(rng, far), fit(rng, near), fit(rng, far)],
        [fit(rng, (x, y), way + 180), fit(rng, far, way + rng.choice([0, 90, 180, 200]))],
        [fit(rng, (x, y), way + rng.choice([90, 120, 150])), fit(rng, far, way + rng.choice([-90, 90, 100]))],
        [fit(rng, (x, y)), f"CUT {point(*far)}", fit(rng, far)],
        [fit(rng, (x, y)), "BACK"],
        [fit(rng, (x, y)), fit(rng, far), "BACK"],
        [fit(rng, (x, y)), fit(rng, far), fit(rng, (x + 3, y + 9)), fit(rng, (x, y)), "BACK"],
    ]
    return offset(rng) + rng.choice(kinds)


def flat(rng: Random) -> Statements:
    """Nodes nearly in line: arcs of metres, some so flat that they go as lines."""
    nodes = wave(rng, rng.randint(3, 8), somewhere(rng), rng.uniform(1, 8), 10 ** rng.uniform(-3.5, -0.5))
    return offset(rng) + fitted(rng, nodes)


Family = Callable[[Random], Statements]


def behind_a_corner(rng: Random) -> Statements:
    """Nodes close together behind a sharp corner, inner or outer, nearer to it than the wire is thick, or a closed run
    that is sharp at both its ends; some copied, mirrored or cut again.
    """
    x, y = somewhere(rng)
    lead, wide = rng.uniform(-180, 180), rng.choice([0.1, 0.1, 0.3, 1, rng.uniform(0.05, 4)])
    away = lead + rng.choice([-1, 1]) * rng.uniform(60, 178)
    bend, step = rng.uniform(-25, 25) * rng.choice([0.2, 1]), wide * rng.uniform(0.05, 1.5)
    nodes, way = [((x, y), away)], away
    for n in range(rng.randint(1, 6)):
        step *= rng.uniform(0.8, 1.6) if n < 3 else rng.uniform(1, 4)
        (px, py), way = nodes[-1][0], way + bend / 2
        nodes.append(
            ((px + step * math.cos(math.radians(way)), py + step * math.sin(math.radians(way))), way + bend / 2)
        )
        way += bend / 2
    lines = [f"R={rng.choice(['', '-'])}{wide:.3g}"]
    (ex, ey), _ = nodes[-1]
    if rng.random() < 0.3:  # round to where it began: a corner at the seam, which BACK closes
        cx, cy = (x + ex) / 2 + (ey - y) * rng.uniform(0.3, 1), (y + ey) / 2 - (ex - x) * rng.uniform(0.3, 1)
        return [
            *lines,
            *fitted(rng, [*nodes, ((cx, cy), way + 120), ((x, y), way - 120)], ends=0.9),
            *rng.choice(AGAIN),
        ]
    start = x - 20 * math.cos(math.radians(lead)), y - 20 * math.sin(math.radians(lead))
    lines += [f"CUT {point(*start)}{rng.choice(['', f',{point(x, y)}', f',{point(x, y)},0.05'])}"]
    lines += fitted(rng, nodes, ends=0.5)
    far = rng.choice([-1, 1]) * rng.uniform(15, 40)  # to one side of the way from the start to the last node
    chord = math.hypot(ex - start[0], ey - start[1]) or 1
    side = point(
        (start[0] + ex + far * (ey - start[1]) / chord) / 2, (start[1] + ey - far * (ex - start[0]) / chord) / 2
    )
    match rng.randrange(6):
        case 0:
            return [*lines, f"SYM {point(ex, ey)}:{side}", "BACK"]
        case 1:
            return [*lines, f"REP {rng.randint(2, 4)},{rng.choice([90, 120, 30])}:{side}", "BACK"]
        case _:
            return [*lines, f"CUT {side}", *rng.choice(AGAIN)]


#: The families, the more telling ones twice.
FAMILIES: list[Family] = [closed, plate, computed, between_circles] * 2 + [wide, open_curve, two_nodes, straight]
FAMILIES += [copied, mirrored, changing, scaled, degenerate, behind_a_corner]


def curve_part(rng: Random, families: list[Family] = FAMILIES) -> str:
    """A program of one or two routes."""
    statements: Statements = []
    if rng.random() < 0.7:
        statements.append(f"FROM {point(*somewhere(rng))}")
    for _ in range(rng.choice([1, 1, 2])):
        statements += rng.choice(families)(rng)
        if statements[-1] not in ("BACK", "RECUT", "SCALE 1"):
            statements.append(f"FROM {point(*somewhere(rng))}")
    if rng.random() < 0.7:
        statements.append("END")
    program = numbered(statements)
    # A loop that is spoilt may never end.
    return spoilt(rng, program) if rng.random() < 0.08 and " GOTO " not in program else program


# Curves that leave out nodes (TOL). Their nodes lie close together, or the tolerance is large.


def tol(rng: Random, least: float = 0.001, most: float = 0.5) -> str:
    """The statement; four digits, so that no distance between written places is likely to be the tolerance."""
    return f"TOL {math.exp(rng.uniform(math.log(least), math.log(most))):.4g}"


def dense(rng: Random) -> Statements:
    """A closed curve or a wavy line of many written nodes."""
    if rng.random() < 0.5:
        nodes = ring(rng, rng.randint(16, 40), somewhere(rng), rng.uniform(5, 40), rng.uniform(0, 0.2))
        if rng.random() < 0.4:
            nodes = [(place, way + 180) for place, way in reversed(nodes)]
        nodes.append(nodes[0])
        return [tol(rng, 0.003, 1), *offset(rng), *fitted(rng, nodes, ends=0.9), *rng.choice(AGAIN)]
    nodes = wave(rng, rng.randint(12, 40), somewhere(rng), rng.uniform(0.4, 2), rng.uniform(0.3, 5))
    return [tol(rng), *offset(rng), *fitted(rng, nodes)]


def dense_loop(rng: Random) -> Statements:
    """An ellipse, a cam or a spiral of up to 150 nodes by a loop; tangents at the seam alone, at all nodes, at none."""
    count = rng.randint(40, 150)
    big = rng.uniform(10, 45)
    small, lobes = big * rng.uniform(0.4, 0.95), rng.randint(2, 4)
    lines = [tol(rng), *offset(rng), f"FROM ({big + 5:.1f},-1)"]
    node = [
        f"({big:.2f}*COS A,{small:.2f}*SIN A)",
        f"({small:.2f}+{rng.uniform(0.02, 0.1) * small:.2f}*COS ({lobes}*A))#A",
        f"({small:.2f}+A/{rng.uniform(40, 200):.1f})#A",
    ][(kind := rng.randrange(3))]
    seam = ["I=0", "*LOOP", f"A=I*360/{count}", f"FIT {node}", "I=I+1", f"IF I<={count} GOTO LOOP"]
    if kind == 0 and rng.random() < 0.6:
        seam[3] += f",(X,O:(-{big:.2f}*SIN A,{small:.2f}*COS A))"
    return [*lines, *seam, rng.choice(["BACK", f"CUT ({big / 9:.2f},0)"])]


def on_a_circle(rng: Random) -> Statements:
    """Nodes of one circle, to the last bit of the arithmetic: part of a turn, one turn, or more; either sense."""
    x, y = somewhere(rng)
    count, way = rng.randint(3, 60), rng.choice(["", "-"])
    step = rng.choice([f"{rng.uniform(1, 20):.4f}", f"360/{count}", f"{rng.uniform(20, 80):.4f}"])
    fit = f"FIT P+({rng.uniform(3, 40):.3f}#{way}A)"
    if rng.random() < 0.3:
        fit += f",{way}(A+90)"
    body = [f"A={rng.uniform(-90, 90):.1f}+I*{step}", fit, "I=I+1", f"IF I<={count} GOTO LOOP"]
    return [tol(rng, most=3), *offset(rng), f"P={point(x, y)}", "I=0", "*LOOP", *body]


def on_a_line(rng: Random) -> Statements:
    """Nodes on a line, then on an arc that goes on from it, then on a line again."""
    x, y = somewhere(rng)
    step, radius, turns = rng.uniform(0.3, 3), rng.uniform(2, 15), rng.randint(6, 30)
    right, bend = x + 9 * step, rng.uniform(90, 180)
    way = f"({step:.3f}#{bend:.2f})"
    lines = [f"P={point(x, y)}", f"V={point(right, y + radius)}", "I=0"]
    lines += ["*LOOP", f"FIT P+({step:.3f}*I,0)", "I=I+1", "IF I<9 GOTO LOOP", "I=0"]
    lines += ["*LOOP", f"A={bend / turns:.5g}*I", f"FIT V+({radius:.3f}#A-90)", "I=I+1", f"IF I<={turns} GOTO LOOP"]
    lines += ["I=1", "*LOOP", f"FIT V+({radius:.3f}#A-90)+{way}*I", "I=I+1", "IF I<12 GOTO LOOP"]
    return [tol(rng), *offset(rng), *lines]


def rounds(rng: Random) -> Statements:
    """A spiral of several turns, its nodes far apart: a longer biarc's circles pass near nodes, its arcs do not."""
    step, count = rng.choice([rng.uniform(25, 75), rng.uniform(150, 215)]), rng.randint(6, 30)
    grow = rng.choice([0, rng.uniform(0.1, 2)])
    body = [f"FIT P+(({rng.uniform(5, 20):.2f}+{grow:.3f}*I)#I*{step:.3f})", "I=I+1", f"IF I<={count} GOTO LOOP"]
    return [tol(rng, 0.05, 6), f"P={point(*somewhere(rng))}", "I=0", "*LOOP", *body]


def coarse(rng: Random) -> Statements:
    """Any other family with a large tolerance."""
    family = rng.choice([closed, plate, computed, between_circles, wide, straight, copied, mirrored, scaled, two_nodes])
    return [tol(rng, 0.02, 3), *family(rng)]


def two_tols(rng: Random) -> Statements:
    """The tolerance changes in mid-curve, which ends it there; the node may be said again, for a corner."""
    nodes = wave(rng, rng.randint(12, 30), somewhere(rng), rng.uniform(0.4, 2), rng.uniform(0.3, 5))
    at = rng.randrange(3, len(nodes) - 3)
    second = rng.choice([tol(rng), tol(rng), "TOL 0", "TOL A1"])
    parts = [fitted(rng, nodes[:at]), fitted(rng, nodes[at - rng.randint(0, 1) :])]
    return ["A1=0.0371", rng.choice([tol(rng), "TOL 0"]), *offset(rng), *parts[0], second, *parts[1]]


def odd_nodes(rng: Random) -> Statements:
    """Among many nodes: another R, a node twice, one off the curve, one with a tangent that does not fit."""
    nodes = wave(rng, rng.randint(12, 30), somewhere(rng), rng.uniform(0.5, 2), rng.uniform(0.3, 4))
    lines = fitted(rng, nodes)
    for _ in range(rng.randint(1, 3)):
        at = rng.randrange(2, len(nodes) - 2)
        (x, y), way = nodes[at]
        match rng.randrange(4):
            case 0:
                lines[at] = fit(rng, (x, y + rng.uniform(-0.05, 0.05)))
            case 1:
                lines[at] = fit(rng, (x, y), way + rng.choice([1, -3, 20]))
            case 2:
                lines.insert(at, lines[at])
            case _:  # more than the route bears, where this node is kept
                lines[at] = f"R={rng.choice(['0.1', '0.1', '5'])}\n{lines[at]}\nR=0.1004"
    return [tol(rng), "R=0.1004", *"\n".join(lines).split("\n")]


def shaken(rng: Random) -> Statements:
    """Nodes beside a line, not in the order in which they are written; all tangents given."""
    x, y = somewhere(rng)
    step, lead = rng.uniform(0.5, 3), rng.uniform(-180, 180)
    lines = [tol(rng, 0.2, 3)]
    for n in range(rng.randint(6, 25)):
        along, across = step * (n + rng.uniform(-0.9, 0.9)), rng.uniform(-0.3, 0.3)
        node = f"({along:.3f}#{lead:.2f})+({across:.3f}#{lead + 90:.2f})"
        lines.append(f"FIT {point(x, y)}+{node},{lead + rng.uniform(-9, 9):.2f}")
    return lines


def beside_a_circle(rng: Random) -> Statements:
    """Nodes inside and outside of a small circle; all tangents given."""
    x, y = somewhere(rng)
    step, radius, lead = rng.uniform(8, 40), rng.uniform(2, 6), rng.uniform(-180, 180)
    lines = [tol(rng, 0.2, 2)]
    for n in range(rng.randint(6, 25)):
        angle = lead + n * step
        node = f"({radius + rng.uniform(-0.4, 0.4):.3f}#{angle:.2f})"
        lines.append(f"FIT {point(x, y)}+{node},{angle + 90 + rng.uniform(-9, 9):.2f}")
    return lines


def within_the_circle(rng: Random) -> Statements:
    """TOL above the arcs' radii: few nodes, close together, some with tangents; small whole numbers too."""
    x, y = somewhere(rng)
    digits = rng.choice([0, 1, 4])
    lines = [tol(rng, 1, 9)]
    for n in range(rng.randint(3, 9)):
        at = (round(x + 3 * n + rng.uniform(-4, 4), digits), round(y + rng.uniform(-5, 5), digits))
        way = f",{rng.randint(-180, 180)}" if rng.random() < 0.4 else ""
        lines.append(f"FIT {point(*at)}{way}")
    return lines


#: The families of TOL.
TOL_FAMILIES: list[Family] = [dense, dense_loop, on_a_circle, on_a_line, rounds, coarse, two_tols, odd_nodes]
TOL_FAMILIES += [shaken, beside_a_circle, within_the_circle]
