"""Long chains with coordinates of six decimals: what 32 bits of mantissa make of lines, belts and circles.

Each family makes one closed route of some dozen elements, up to 60 mm from O, with corners of every angle: edges
through points that lie near each other, flat corners, circles that cross at shallow angles, elements turned, moved and
mirrored. No coordinate is a round number of micrometres on purpose, so every rounding is as likely as any other.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import cos, pi, sin, tau
from random import Random

from parts import Statements, numbered

#: Elements of a route.
FEWEST, MOST = 5, 40


def decimal(value: float) -> str:
    """A constant of six decimals."""
    return f"{value:.6f}"


def point(x: float, y: float) -> str:
    """A point literal of six decimals."""
    return f"({decimal(x)},{decimal(y)})"


def offset(rng: Random) -> Statements:
    """The wire's offset, if any."""
    return rng.choice([[], [f"R={decimal(rng.uniform(-0.2, 0.2))}"]])


def ring(rng: Random, count: int, least: float, most: float) -> list[tuple[float, float]]:
    """Corners of a star-shaped polygon around a centre near O, counter-clockwise."""
    x, y = rng.uniform(-12, 12), rng.uniform(-12, 12)
    turn = rng.uniform(0, tau)
    corners = []
    for n in range(count):
        angle = turn + (n + rng.uniform(-0.3, 0.3)) * tau / count
        radius = rng.uniform(least, most)
        corners.append((x + radius * cos(angle), y + radius * sin(angle)))
    return corners


def cut(items: list[str]) -> Statements:
    """A route's items, each with its separator in front, a few in a CUT."""
    rows = ["".join(items[n : n + 8]) for n in range(0, len(items), 8)]
    return [f"CUT {row[1:] if row[0] == ',' else row}" for row in rows]


def edges(rng: Random) -> Statements:
    """A polygon by the lines through its corners, some of them rounded."""
    count = rng.randint(FEWEST, MOST)
    least = rng.choice([20, 35])
    corners = ring(rng, count, least, 38)
    lines = [f"P{n}={point(*corner)}" for n, corner in enumerate(corners, 1)]
    lines += [f"S{n}=P{n}:P{n % count + 1}" for n in range(1, count + 1)]
    items = [",S1"]
    for n in range(2, count + 1):
        items.append(f",{decimal(rng.uniform(0.25, 0.5))},S{n}" if rng.random() < 0.25 else f",S{n}")
    return [*lines, *offset(rng), "FROM (P1+P2)/2", *cut(items), "BACK"]


def tangents(rng: Random) -> Statements:
    """A convex chain of lines, each through two points that lie near each other."""
    count = rng.randint(FEWEST, 24)
    turn = rng.uniform(0, tau)
    first = turn + tau / count
    radius = rng.uniform(15, 40)
    lines, items = [], []
    for n in range(1, count + 1):
        angle = turn + (n + rng.uniform(-0.2, 0.2)) * tau / count
        x, y = radius * cos(angle), radius * sin(angle)
        apart = 10 ** rng.uniform(-1, 1)
        lines.append(f"S{n}={point(x, y)}:{point(x - apart * sin(angle), y + apart * cos(angle))}")
        items.append(f",S{n}")
    return [*lines, *offset(rng), f"FROM {point(radius * cos(first), radius * sin(first))}", *cut(items), "BACK"]


def corners(rng: Random) -> Statements:
    """A polygon by its corners, entered in the middle of an edge, now and then round a corner."""
    places = ring(rng, rng.randint(FEWEST, MOST), rng.choice([20, 37]), 40)
    first, last = places[0], places[-1]
    start = point((first[0] + last[0]) / 2, (first[1] + last[1]) / 2)
    items = [f",{start}"]
    for place in places:
        items.append(f",{point(*place)}")
        if rng.random() < 0.2:
            items.append(f",{decimal(rng.uniform(0.25, 0.5))}")
    if items[-1][1] != "(":
        items.pop()
    rows = ["".join(items[n : n + 4]) for n in range(0, len(items), 4)]
    return [*offset(rng), *(f"CUT {row[1:]}" for row in rows), "BACK"]


def belts(rng: Random) -> Statements:
    """Belt lines around circles of either sense."""
    count = rng.randint(4, 12)
    lines, items = [], []
    for n, place in enumerate(ring(rng, count, 30, 38), 1):
        sign = "-" if rng.random() < 0.25 else ""
        lines.append(f"C{n}={point(*place)}:{sign}{decimal(rng.uniform(0.5, 60 / count))}")
    for n in range(1, count + 1):
        lines.append(f"S{n}=C{n}:C{n % count + 1}")
        items += [f",S{n}", f",C{n % count + 1}"]
    return [*lines, *offset(rng), "FROM (K1 C1+K1 C2,K2 C1+K2 C2)*0.5", *cut(items), "BACK"]


def beads(rng: Random) -> Statements:
    """A ring of circles, each across its neighbours, at steep or shallow angles; cut around the outside."""
    count = rng.randint(FEWEST, 20)
    radius = rng.uniform(20, 38)
    half = radius * sin(pi / count)
    turn = rng.uniform(0, tau)
    most = rng.choice([1.01, 1.1, 1.6])
    lines = []
    for n in range(1, count + 1):
        x, y = radius * cos(turn + n * tau / count), radius * sin(turn + n * tau / count)
        lines.append(f"C{n}={point(x, y)}:{decimal(half * rng.uniform(1.004, most))}")
    items = [f";C{n}" for n in range(1, count + 1)] + [";C1"]
    start = point(1.4 * radius * cos(turn + tau / count), 1.4 * radius * sin(turn + tau / count))
    return [*lines, *offset(rng), f"FROM {start}", *cut([f",{items[0][1:]}", *items[1:]]), "BACK"]


def notches(rng: Random) -> Statements:
    """A polygon of lines with a circle across each of its corners, cut out or standing."""
    count = rng.randint(FEWEST, 14)
    places = ring(rng, count, 30, 38)
    lines = [f"P{n}={point(*place)}" for n, place in enumerate(places, 1)]
    lines += [f"S{n}=P{n}:P{n % count + 1}" for n in range(1, count + 1)]
    items = [",S1"]
    for n in range(2, count + 2):
        m = (n - 1) % count + 1
        ear = rng.random() < 0.5
        size = decimal(rng.uniform(0.5, 30 / count))
        lines.append(f"C{m}=(P{m}+{point(rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3))}):{'' if ear else '-'}{size}")
        items += [f"{';' if ear else ','}C{m}", f"{';' if ear else ','}S{m}"]
    return [*lines, *offset(rng), "FROM (P1+P2)/2", *cut(items), "BACK"]


def turned(rng: Random) -> Statements:
    """Lines, and circles on their corners, turned about O or a point, step by step or from the first one."""
    count = rng.randint(FEWEST, 20)
    x, y = rng.uniform(-10, 10), rng.uniform(-10, 10)
    about = rng.choice(["", ":P9"])
    if not about:
        x = y = 0
    reach, half = rng.uniform(15, 35), pi / count
    angle = rng.uniform(0, tau)
    lines = [f"P9={point(x, y)}", f"P1={point(x + reach * cos(angle), y + reach * sin(angle))}"]
    far = reach / cos(half)
    lines += [f"P2={point(x + far * cos(angle + half), y + far * sin(angle + half))}", "S1=P1:P2"]
    lines.append(f"C1=P2:{decimal(rng.uniform(0.05, 0.4) * reach * half)}")
    step = rng.choice([f"360/{count}", f"{decimal(360 / count)}"])
    chain = rng.random() < 0.5
    for n in range(2, count + 1):
        for name in "SC":
            lines.append(f"{name}{n}={name}{n - 1 if chain else 1}#({step}{'' if chain else f'*{n - 1}'}{about})")
    items = [f"{sign}{name}{n}" for n in range(1, count + 1) for sign, name in ((";", "S"), (";", "C"))]
    return [*lines, *offset(rng), "FROM P1", *cut([f",{items[0][1:]}", *items[1:], ";S1"]), "BACK"]


def parallels(rng: Random) -> Statements:
    """A convex chain of lines at a given distance and direction, made in every way that there is for lines."""
    count = rng.randint(FEWEST, 24)
    radius = rng.uniform(15, 40)
    angle = rng.uniform(0, 360)
    start = point(radius * cos(angle * pi / 180), radius * sin(angle * pi / 180))
    lines, items = [], []
    for n in range(1, count + 1):
        a = decimal(angle + (n - 1 + rng.uniform(-0.2, 0.2)) * 360 / count)
        lines.append(f"P1={decimal(radius)}#({a})")
        lines += rng.choice(
            [
                [f"S{n}=Y:{decimal(radius)}#({a})"],
                [f"S{n}=(Y#({a})):P1"],
                [f"S{n}=(P1*0.3)#(P1*1.7)"],
                [f"S{n}=P1:(P1+(P1#90)*{decimal(rng.uniform(0.01, 0.5))})"],
                [f"C1=P1/5:{decimal(radius * 0.8)}", f"S{n}=(Y#({a})):C1"],
                [f"S99=X#({decimal(rng.uniform(0, 360))})", f"S{n}=P1:(P1+(P1#90)/9)/S99/S99"],
            ]
        )
        items.append(f",S{n}")
    return [*lines, *offset(rng), f"FROM {start}", *cut(items), "BACK"]


def arcs(rng: Random) -> Statements:
    """A polygon by its corners with arcs through two of them for some edges, bulging out or in, some nearly flat."""
    places = ring(rng, rng.randint(FEWEST, 20), 25, 38)
    count = len(places)
    lines = [f"P{n}={point(*place)}" for n, place in enumerate(places, 1)]
    items = [",(P1+P2)/2"]
    for n in range(2, count + 1):
        m = n % count + 1
        items.append(f",P{n}")
        if n < count and rng.random() < 0.6:
            lift = decimal(rng.choice([-1, 1]) * 10 ** rng.uniform(-0.3, 1.3))
            lines += [f"O{n}=(P{n}+P{m})/2+((P{m}-P{n})#90)*{lift}"]
            lines.append(f"C{n}={'-' if lift[0] == '-' else ''}(O{n}/P{n})")
            items.append(f",C{n}")
    items.append(",P1")
    return [*lines, *offset(rng), *cut(items), "BACK"]


def found(rng: Random) -> Statements:
    """A polygon whose corners are crossings, feet and images of one another, cut as points."""
    places = ring(rng, rng.randint(FEWEST, 12), 25, 34)
    count = len(places)
    lines = [f"P{n}={point(*place)}" for n, place in enumerate(places, 1)]
    for n in range(1, count + 1):
        m = n % count + 1
        apart = rng.uniform(1, 5)
        beside = point(places[n - 1][0] + apart, places[n - 1][1])
        near = apart * rng.uniform(0.4, 1.3)
        far = rng.uniform(abs(apart - near) * 1.001, (apart + near) / 1.001)
        lines += rng.choice(
            [
                [f"V{n}=(O:P{n})*(P{n}:P{m})"],
                [f"V{n}=(P{n}:P{m})*({beside}:{decimal(apart + 0.3)})"],
                [f"V{n}=(P{n}:{decimal(near)})*-({beside}:{decimal(far)})"],
                [f"V{n}={beside}#(P{n}:(P{n}+(P{n}#{decimal(rng.uniform(60, 120))})/50))"],
                [f"V{n}=P{n}/(P{n}:(P{n}+{point(rng.uniform(-1, 1), rng.uniform(0.2, 1))}))"],
            ]
        )
    return [*lines, *offset(rng), *cut([f",V{n}" for n in range(1, count + 1)]), "BACK"]


FAMILIES: list[Callable[[Random], Statements]] = [
    edges, tangents, corners, belts, beads, notches, turned, parallels, arcs, found,
]  # fmt: skip


def chains(rng: Random) -> Iterator[tuple[str, str]]:
    """Families' names and programs, one after another, without end."""
    while True:
        family = rng.choice(FAMILIES)
        yield family.__name__, numbered([*family(rng), "END"])
