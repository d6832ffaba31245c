"""КОНТУР: random contours against an independent construction, and through the ROM (docs/spec/tekhtran.md, section 6).

The independent construction knows the corners that a contour was made from. A corner of the wire's path is found from
there by Newton's method on two distances in plain floats: the place that lies as far to the right of both curves as the
wire shall run.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from math import atan2, cos, hypot, pi, sin

import pytest
from compare import compare
from facthelp import says
from rivalhelp import XY, apart, cut_small_numbers
from tkhhelp import cut, fault

from skg.messages.finding import Phrase
from skg.rivals.tekhtran import translate

# The independent construction --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Edge:
    """From a corner to the next: a straight one, or an arc by way of a point between; SPAN of a circle."""

    start: XY
    end: XY
    #: Straight between points; a named line; a named circle.
    kind: str
    centre: XY = (0, 0)
    #: Positive: counter-clockwise.
    radius: float = 0.0

    def right(self, p: XY) -> float:
        """The distance of a place to the right."""
        if self.radius:
            d = apart(p, self.centre)
            return d - self.radius if self.radius > 0 else -self.radius - d
        (x, y), (u, v) = self.start, self.end
        return ((p[0] - x) * (v - y) - (p[1] - y) * (u - x)) / apart(self.start, self.end)

    def square(self, p: XY) -> XY:
        """Unit vector to the right at a place."""
        if self.radius:
            d = apart(p, self.centre) * (1 if self.radius > 0 else -1)
            return (p[0] - self.centre[0]) / d, (p[1] - self.centre[1]) / d
        (x, y), (u, v) = self.start, self.end
        d = apart(self.start, self.end)
        return (v - y) / d, (x - u) / d

    def middle(self) -> XY:
        """A place half way."""
        if not self.radius:
            return (self.start[0] + self.end[0]) / 2, (self.start[1] + self.end[1]) / 2
        a, b = (atan2(p[1] - self.centre[1], p[0] - self.centre[0]) for p in (self.start, self.end))
        half = (b - a) % (2 * pi) / 2 if self.radius > 0 else -((a - b) % (2 * pi)) / 2
        r = abs(self.radius)
        return self.centre[0] + r * cos(a + half), self.centre[1] + r * sin(a + half)


def arc(start: XY, end: XY, rise: float) -> Edge:
    """The arc that rises so far to the left of its chord (below 0: to the right)."""
    half = apart(start, end) / 2
    x, y = (end[0] - start[0]) / (2 * half), (end[1] - start[1]) / (2 * half)
    r = (half * half + rise * rise) / (2 * abs(rise))
    up = rise - r if rise > 0 else rise + r
    centre = ((start[0] + end[0]) / 2 - y * up, (start[1] + end[1]) / 2 + x * up)
    return Edge(start, end, "circle", centre, -r if rise > 0 else r)


def wire_corner(e: Edge, f: Edge, right: float) -> XY:
    """The crossing of both paths, searched from the corner of the edges."""
    x, y = f.start
    for _ in range(60):
        (a, b), (c, d) = e.square((x, y)), f.square((x, y))
        m, n = right - e.right((x, y)), right - f.right((x, y))
        det = a * d - b * c
        x, y = x + (m * d - b * n) / det, y + (a * n - m * c) / det
    return x, y


def turn(e: Edge, f: Edge) -> float:
    """Sine of the turn from one edge to the next: positive to the left."""
    (a, b), (c, d) = e.square(f.start), f.square(f.start)
    return a * d - b * c


# Random contours ---------------------------------------------------------------------------------------------------


def ring(rng: random.Random) -> list[Edge]:
    """Edges around a centre, none of them short, no corner nearly straight or sharp."""
    while True:
        count = rng.randint(3, 12)
        sense, begin = rng.choice([1, -1]), rng.uniform(0, 2 * pi)
        corners = []
        for index in range(count):
            angle = sense * (begin + 2 * pi * (index + rng.uniform(-0.2, 0.2)) / count)
            away = rng.uniform(25, 40)
            corners.append((round(away * cos(angle), 2), round(away * sin(angle), 2)))
        edges = []
        for start, end in zip(corners, corners[1:] + corners[:1], strict=True):
            kind = rng.choice(["straight", "line", "circle", "circle"])
            if kind == "circle":
                edges.append(arc(start, end, rng.choice([1, -1]) * rng.uniform(0.08, 0.3) * apart(start, end)))
            else:
                edges.append(Edge(start, end, kind))
        if all(abs(turn(e, f)) > 0.2 for e, f in zip([edges[-1], *edges], edges, strict=False)):
            return edges


def other_crossing(e: Edge, f: Edge) -> XY | None:
    """The other crossing of the two whole curves: the mirror image of their corner; None: they are lines."""
    x, y = f.start
    if e.radius and f.radius:
        axis = Edge(e.centre, f.centre, "line")
    elif e.radius or f.radius:
        round_one, line = (e, f) if e.radius else (f, e)
        a, b = line.square((x, y))
        axis = Edge(round_one.centre, (round_one.centre[0] + a, round_one.centre[1] + b), "line")
    else:
        return None
    d = axis.right((x, y))
    a, b = axis.square((x, y))
    return x - 2 * d * a, y - 2 * d * b


@dataclass
class Written:
    """A TEKHTRAN program, and what the wire shall do."""

    text: str
    expected: list[XY]
    senses: list[float]
    is_refused: bool


def choices(at: XY, other: XY) -> list[str]:
    found = []
    for axis, words in enumerate((("ХБ", "ХМ"), ("УБ", "УМ"))):
        if abs(at[axis] - other[axis]) > 0.05:
            found.append(words[at[axis] < other[axis]])
    return found


def written(rng: random.Random, edges: list[Edge]) -> Written:
    """A contour of these edges, begun anywhere; its corners named by points, or by which of two crossings they are."""
    d = rng.choice([0, 0.06, 0.13, 0.5])
    side = rng.choice(["СПРАВА", "СЛЕВА"]) if d else ""
    right = -d if side == "СЛЕВА" else d
    begin = rng.randrange(len(edges))
    edges = edges[begin:] + edges[:begin]
    text, items = "", []
    for index, edge in enumerate(edges):
        before = edges[index - 1]
        text += f"ТЧ{index} = {edge.start[0]}, {edge.start[1]}\n"
        other = other_crossing(before, edge)
        choice = choices(edge.start, other) if other else [""]
        free = before.kind != "straight" and edge.kind != "straight" and choice and rng.random() < 0.7
        items.append([[] if free else [f"ТЧ{index}"], edge, rng.choice(choice) if free else ""])
    for index, (_, edge, _) in enumerate(items):
        after = f"ТЧ{(index + 1) % len(edges)}"
        if edge.kind == "line":
            one, two = (f"ТЧ{index}", after) if rng.random() < 0.5 else (after, f"ТЧ{index}")
            text += f"ПР{index} = {one}, {two}\n"
        elif edge.kind == "circle":
            x, y = edge.middle()
            text += f"ТЧ{100 + index} = {x:.17f}, {y:.17f}\nКР{index} = ТЧ{index}, ТЧ{100 + index}, {after}\n"
    parts = []
    for index, (corner, edge, choice) in enumerate(items):
        parts += corner
        chosen = [choice] if choice else []
        if edge.kind == "line":
            parts.append(", ".join([f"ПР{index}", *chosen]))
        elif edge.kind == "circle":
            parts.append(", ".join([f"КР{index}", "ПРЧС" if edge.radius > 0 else "ПОЧС", *chosen]))
    first = edges[0]
    x, y = first.middle()
    a, b = first.square((x, y))
    out = rng.uniform(-3, 3)
    hole = round(x + out * a, 3), round(y + out * b, 3)
    text += f"ИЗ {hole[0]}, {hole[1]}\nКОНТУР {side}{f', {d}, ' if side else ''}{', '.join(parts)}\n"
    corners = [wire_corner(edges[index - 1], edge, right) for index, edge in enumerate(edges)]
    begins_with_point = bool(items[0][0])
    if begins_with_point:
        a, b = first.square(first.start)
        entry = first.start[0] + right * a, first.start[1] + right * b
    else:
        entry = nearest(first, hole, right)
    is_refused = begins_with_point and turn(edges[-1], first) * right < 0
    expected = [entry, *corners[1:]]
    senses = [edge.radius and edge.radius + right for edge in edges]
    if apart(entry, corners[0]) > 1e-6:
        expected.append(corners[0])
        senses.append(senses[0])
    return Written(text, expected, senses, is_refused)


def nearest(edge: Edge, p: XY, right: float) -> XY:
    """The nearest place of the wire's path along an edge."""
    a, b = edge.square(p)
    step = right - edge.right(p)
    return p[0] + step * a, p[1] + step * b


#: Blocks that the test of random contours compares at least, in all.
BLOCKS = 1000
PARTS = 8


@pytest.mark.parametrize("part", range(PARTS))
def test_random_contours(part: int, record_property: pytest.RecordProperty) -> None:
    rng = random.Random(f"contours {part}")
    blocks = programs = aside = refused = 0
    while blocks < BLOCKS / PARTS:
        made = written(rng, ring(rng))
        if made.is_refused:
            assert says(fault(made.text), Phrase("rival-inner-corner")), made.text
            refused += 1
            continue
        segments = [s for s in cut(made.text).path if s.role == "cut"]
        found = [(float(s.start.x), float(s.start.y)) for s in segments]
        assert len(found) == len(made.expected), (made.text, found, made.expected)
        for segment, p, q, radius in zip(segments, found, made.expected, made.senses, strict=True):
            assert apart(p, q) < 1e-6, (made.text, found, made.expected)
            assert abs(float(segment.radius or 0) - radius) < 1e-6, made.text
        assert apart((float(segments[-1].end.x), float(segments[-1].end.y)), found[0]) < 1e-6
        verdict = compare(translate(made.text))
        assert not verdict.difference, (made.text, verdict)
        blocks += verdict.blocks
        programs += 1
        aside += bool(verdict.aside)
    assert refused
    assert aside <= programs / 4
    record_property("compared", ("blocks", blocks, programs, aside))


def test_the_independent_construction_tells() -> None:
    """An arc that bulges the other way, and the other side, are another path."""
    rng = random.Random(1)
    edges = [arc((0, 0), (30, 0), -4.0), Edge((30, 0), (15, 25), "line"), Edge((15, 25), (0, 0), "line")]
    made = written(rng, edges)
    while "СПРАВА" not in made.text or made.is_refused:
        made = written(rng, edges)
    for other in (made.text.replace("СПРАВА", "СЛЕВА"), made.text.replace("ПРЧС", "ПОЧС")):
        assert other != made.text
        if fault(other):
            continue
        found = [(float(s.start.x), float(s.start.y)) for s in cut(other).path if s.role == "cut"]
        assert any(min(apart(p, q) for q in made.expected) > 1e-3 for p in found)


# Tangents: curves that go over into each other -----------------------------------------------------------------------


@pytest.mark.parametrize("part", range(2))
def test_belts_of_tangents(part: int) -> None:
    """Wheels and the common tangents around them: the wire's corners lie square beside the drawn ones."""
    rng = random.Random(f"tangents {part}")
    for _ in range(8):
        count, sense, d = rng.randint(3, 6), rng.choice([1, -1]), rng.choice([0, 0.1, -0.1])
        wheels = []
        for index in range(count):
            angle, away = sense * 2 * pi * (index + rng.uniform(-0.1, 0.1)) / count, rng.uniform(25, 35)
            wheels.append((round(away * cos(angle), 1), round(away * sin(angle), 1), rng.randint(2, 6)))
        text = "".join(f"КР{i} = {x}, {y}, {r}\n" for i, (x, y, r) in enumerate(wheels))
        # A belt around wheels that run counter-clockwise has all of them on its left.
        hand, way = ("СПРАВА", "ПРЧС") if sense > 0 else ("СЛЕВА", "ПОЧС")
        parts, wanted = [], []
        for i in range(count):
            j = (i + 1) % count
            text += f"ПР{i} = {hand}, КР{i}, {hand}, КР{j}\n"
            parts += [f"ПР{i}", f"КР{j}, {way}"]
            (x, y, r), (u, v, q) = wheels[i], wheels[j]
            dist = hypot(u - x, v - y)
            # The tangent's normal, to the outside: the centres lie r and q inside of it.
            c, s = (r - q) / dist, (1 - ((r - q) / dist) ** 2) ** 0.5 * -sense
            n = (((u - x) * c - (v - y) * s) / dist, ((u - x) * s + (v - y) * c) / dist)
            wanted += [(a + n[0] * (b + d * sense), z + n[1] * (b + d * sense)) for a, z, b in (wheels[i], wheels[j])]
        mid = tuple((p + q) / 2 for p, q in zip(*wanted[:2], strict=True))
        text += f"ИЗ {mid[0]:.3f}, {mid[1]:.3f}\nКОНТУР "
        text += ("СПРАВА, 0.1, " if d > 0 else "СЛЕВА, 0.1, " if d < 0 else "") + ", ".join(parts)
        found = [(float(s.start.x), float(s.start.y)) for s in cut(text).path if s.role == "cut"][1:]
        wanted = wanted[1:] + wanted[:1]
        assert len(found) == len(wanted), text
        for p, q in zip(found, wanted, strict=True):
            assert apart(p, q) < 1e-6, (text, found, wanted)
        verdict = compare(translate(text))
        assert not verdict.difference, (text, verdict)


# Single rules --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("items", "begin", "blocks"),
    [
        ("КР1, ПРЧС", (5, 0), 1),
        ("КР1, ПОЧС", (5, 0), 1),
        ("ТЧ1, КР1, ПРЧС", (0, 5), 1),
        ("ТЧ1, КР1, ПОЧС, ТЧ1", (0, 5), 1),
        ("КР1, ПРЧС, ТЧ1", (5, 0), 2),
    ],
)
@pytest.mark.parametrize("side", ["", "СПРАВА", "СЛЕВА"])
def test_whole_circle(items: str, begin: XY, blocks: int, side: str) -> None:
    """Once round, by its sense; entered at the named point, else where it is nearest."""
    text = f"КР1 = 0, 0, 5; ТЧ1 = 0, 5; ИЗ 9, 0; КОНТУР {side}{', 0.5, ' if side else ''}{items}"
    arcs = [s for s in cut(text).path if s.role == "cut"]
    sense = 1 if "ПРЧС" in items else -1
    beside = {"": 0, "СПРАВА": 0.5, "СЛЕВА": -0.5}[side] * sense
    assert len(arcs) == blocks
    assert abs(sum(float(s.sweep) for s in arcs) - 2 * pi) < 1e-9
    for s in arcs:
        assert abs(float(s.radius) - sense * (5 + beside)) < 1e-9
    scale = (5 + beside) / 5
    assert apart((float(arcs[0].start.x), float(arcs[0].start.y)), (begin[0] * scale, begin[1] * scale)) < 1e-9


@pytest.mark.parametrize(
    ("items", "wire", "wanted"),
    [
        # Of the disc the part over the line, both ways round.
        ("ПР1, ХМ, КР1, ПРЧС, ХБ", "0, 9", [(0, 3), (4, 3), (-4, 3)]),
        ("ПР1, ХБ, КР1, ПОЧС, ХМ", "0, 9", [(0, 3), (-4, 3), (4, 3)]),
        # What is in either of two circles, what is in both.
        ("КР1, ПРЧС, УБ, КР2, ПРЧС, УМ", "0, 9", [(0, 5), (3, -4), (3, 4)]),
        ("КР2, ПРЧС, УМ, КР1, ПРЧС, УБ", "20, 0", [(11, 0), (3, 4), (3, -4)]),
        ("КР2, ПРЧС, УБ, КР1, ПРЧС, УМ", "0, 0", [(1, 0), (3, -4), (3, 4)]),
        # Entered where the item is not run; a point off the circle beside it.
        ("КР2, ПРЧС, УБ, КР1, ПРЧС, УМ", "20, 0", None),
        ("ТЧ2, ПР1, ХБ, КР1, ПОЧС", "0, 9", None),
        ("ПР1, КР1, ПОЧС, ХМ, ТЧ2", "0, 9", None),
    ],
)
def test_two_crossings(items: str, wire: str, wanted: list[XY] | None) -> None:
    """The corner that m chooses, and where each contour begins."""
    text = f"КР1 = 0, 0, 5; КР2 = 6, 0, 5; ПР1 = 0, 3, 1, 3; ТЧ2 = 4, 4\nИЗ {wire}\nКОНТУР {items}"
    if wanted is None:
        assert fault(text).startswith("3:")
        return
    found = [(float(s.start.x), float(s.start.y)) for s in cut(text).path if s.role == "cut"]
    assert len(found) == len(wanted)
    assert all(apart(p, q) < 1e-9 for p, q in zip(found, wanted, strict=True)), found


# Small whole numbers: touching, coinciding, one in the other ---------------------------------------------------------


def soup(rng: random.Random) -> str:
    text = "".join(f"ТЧ{i} = {rng.randint(0, 4)}, {rng.randint(0, 4)}\n" for i in range(4))
    text += "".join(f"КР{i} = {rng.randint(0, 4)}, {rng.randint(0, 4)}, {rng.randint(1, 2)}\n" for i in range(3))
    lines = ["0, 0, 1, 0", "0, 2, 1, 2", "2, 0, 2, 1", "4, 0, 4, 4", "0, 0, 1, 1", "0, 4, 4, 0"]
    text += "".join(f"ПР{i} = {line}\n" for i, line in enumerate(rng.sample(lines, 3)))
    items = []
    for _ in range(rng.randint(1, 6)):
        choice = rng.choice(["", "", ", ХБ", ", ХМ", ", УБ", ", УМ"])
        items.append(
            rng.choice(
                [f"ТЧ{rng.randint(0, 3)}", f"ПР{rng.randint(0, 2)}{choice}"]
                + [f"КР{rng.randint(0, 2)}, {rng.choice(['ПОЧС', 'ПРЧС'])}{choice}"]
            )
        )
    side = rng.choice(["", "", "СПРАВА, 0.1, ", "СЛЕВА, 0.1, "])
    return f"{text}ИЗ {rng.randint(0, 4)}, {rng.randint(0, 4)}\nКОНТУР {side}{', '.join(items)}\n"


@pytest.mark.parametrize("part", range(4))
def test_small_whole_numbers(part: int) -> None:
    """Refused with a place, or without an offset cut as it is; with one the ROM may refuse it."""
    rng = random.Random(f"soup {part}")
    assert cut_small_numbers(lambda: soup(rng), lambda text: "0.1" in text, 18, translate) >= 9
