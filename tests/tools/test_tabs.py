"""Tabs of `skg cut`: the metal that a wire of its kerf leaves, pass by pass (shapely)."""

from __future__ import annotations

import random
import re
from itertools import pairwise, product
from math import cos, pi, sin
from pathlib import Path

import pytest
import shapely
from cuthelp import LIMIT, drawing, polygon, run_failing, saved, stretches
from ezdxf.document import Drawing
from facthelp import says
from shapely.geometry import LineString, Point, Polygon
from test_cut import start_of
from toolhelp import Run

from skg.errors import UserError
from skg.messages.finding import Phrase

#: The offset of the last pass, the kerf on each side of the wire's path.
R = 0.1
#: A sharp corner in which the wire leaves its radius is no fault of a tab.
ROUND = 2 * R
#: No larger piece of metal falls, mm²; the contours are larger.
CRUMB = 1.2


class Metal:
    """A contour in stock, cut by a tape."""

    def __init__(self, area: Polygon, tape: Path, program: Path, is_slug: bool) -> None:
        self.area, self.is_slug = area, is_slug
        self.paths = [LineString(places) for places in stretches(tape.read_bytes(), start_of(program))]
        self.stock = shapely.box(*shapely.union_all([area, *self.paths]).bounds).buffer(5)

    def left(self, count: int, kerf: float = R) -> list[Polygon]:
        """The pieces that the first stretches leave, the smallest crumbs left out."""
        band = shapely.union_all([path.buffer(kerf, quad_segs=32) for path in self.paths[:count]])
        return [piece for piece in shapely.get_parts(self.stock.difference(band)).tolist() if piece.area > 1e-3]

    def holds(self, count: int, kerf: float) -> bool:
        """All that is in the contour hangs on the stock behind some stretches, but for crumbs."""
        edge = Point(*self.stock.exterior.coords[0]).buffer(0.5)
        loose = [piece for piece in self.left(count, kerf) if not piece.intersects(edge)]
        return max((piece.intersection(self.area).area for piece in loose), default=0) < CRUMB

    @property
    def faces(self) -> tuple[Polygon, Polygon]:
        """The finished part as metal, and as it should be where the wire gets into every corner."""
        pieces = self.left(len(self.paths))
        if self.is_slug:
            edge = Point(*self.stock.exterior.coords[0]).buffer(0.5)
            (around,) = (piece for piece in pieces if piece.intersects(edge))
            return around, self.stock.difference(self.area)
        inside = self.area.representative_point()
        (part,) = (piece for piece in pieces if piece.contains(inside))
        return part, self.area

    def proud(self) -> shapely.Geometry:
        """Metal on the part that the drawing has not, and that no round corner is; none of the part is missing."""
        part, wanted = self.faces
        assert wanted.difference(part.buffer(2 * LIMIT)).area < 1e-5
        reachable = wanted.buffer(ROUND, quad_segs=32).buffer(-ROUND, quad_segs=32)
        return part.difference(reachable.buffer(LIMIT, join_style="mitre"))


def cut_metal(
    run: Run,
    folder: Path,
    page: Drawing,
    area: Polygon,
    *words: object,
    is_slug: bool = False,
) -> Metal:
    tape, program = folder / "part.3b", folder / "part.skg"
    side = ["--side", "inside"] if is_slug else []
    run(
        "cut",
        saved(page, folder),
        "-o",
        tape,
        "--offset",
        R,
        "--program",
        program,
        *side,
        *words,
    )
    return Metal(area, tape, program, is_slug)


def shape(name: str, page: Drawing) -> Polygon:
    if name == "disc":
        page.modelspace().add_circle((3, 4), 8)
        return Point(3, 4).buffer(8, quad_segs=800)
    if name == "spline":
        places = [(10 * cos(at * pi / 5) * (1 + 0.2 * (at % 2)), 8 * sin(at * pi / 5), 0) for at in range(10)]
        curve = page.modelspace().add_spline(fit_points=[*places, places[0]])
        tool = curve.construction_tool()
        return Polygon([(place.x, place.y) for place in tool.approximate(4000)])
    corners = {
        "five": [(0, 0), (30, 0), (30, 12), (14, 10), (0, 25)],
        "ring": [(9 * cos(at * pi / 20), 9 * sin(at * pi / 20)) for at in range(20)],
    }[name]
    return polygon(corners, page)


PASSES = (((0,), "", 0), ((0.06, 0.02, 0), "", 0.06), ((0.06, 0), "0.02", 0.02), ((0.06, 0.02, 0), "0.02,0", 0))
CASES = [
    (name, *passes, lead, is_slug)
    for number, (name, passes) in enumerate(product(("five", "disc", "ring", "spline"), PASSES))
    for lead, is_slug in (("perpendicular", bool(number % 2)), ("arc", not number % 2))
]


@pytest.mark.parametrize(("name", "passes", "more", "proud", "lead", "is_slug"), CASES)
def test_metal(
    run: Run,
    tmp_path: Path,
    name: str,
    passes: tuple[float, ...],
    more: str,
    proud: float,
    lead: str,
    is_slug: bool,
) -> None:
    """The tabs stand until they are cut, by the widest kerf too; then the part is as drawn, but for what is proud."""
    page, tab = drawing(), 3
    area = shape(name, page)
    words: list[object] = [
        "--passes",
        ",".join(map(str, passes)),
        "--lead-shape",
        lead,
        "--lead",
        2,
    ]
    words += [
        "--slug-tab" if is_slug else "--tab",
        tab,
        *(["--tab-passes", more] if more else []),
    ]
    count = 3 if name in ("disc", "ring") else 1
    metal = cut_metal(run, tmp_path, page, area, *words, "--tabs", count, is_slug=is_slug)
    takes_slug = bool(is_slug and more)
    assert len(metal.paths) == 2 * count + takes_slug
    before = len(metal.paths) - 1 - takes_slug
    for kerf in (R, R + passes[0]):
        assert all(metal.holds(done, kerf) for done in range(before + 1))
    assert not metal.holds(len(metal.paths), R)
    bumps = metal.proud()
    if not proud:
        assert bumps.area < 1e-4
        return
    pieces = [piece for piece in shapely.get_parts(bumps).tolist() if piece.area > 1e-3]
    assert len(pieces) == count
    ring = metal.area.exterior
    for piece in pieces:
        high = max(ring.distance(Point(place)) for place in piece.exterior.coords)
        assert high == pytest.approx(proud, abs=2 * LIMIT)
        longest = shapely.minimum_rotated_rectangle(piece)
        # (a tab on a curve goes on to its next node)
        assert longest.length / 2 < tab + (8 if name == "spline" else 0.8)


def test_the_report_says_how_proud(run: Run, tmp_path: Path) -> None:
    page = drawing()
    shape("five", page)
    words = [
        "cut",
        saved(page, tmp_path),
        "-o",
        tmp_path / "a.3b",
        "--offset",
        R,
        "--passes",
        "0.06,0.02,0",
        "--tab",
        2,
    ]
    assert says(run(*words, "--quiet").stderr, Phrase("tabs-proud", height=0.06), "--tab-passes")
    assert says(run(*words, "--tab-passes", "0.02", "--quiet").stderr, Phrase("tabs-proud", height=0.02))
    assert "proud" not in run(*words, "--tab-passes", "0.02,0").stderr


def test_random_tabs(run: Run, tmp_path: Path) -> None:
    """Small whole numbers: the tape holds each part to the end and leaves what is drawn, or it is refused by name."""
    dice, made = random.Random(43), 0
    for _ in range(36):
        page = drawing()
        angles = sorted(dice.sample(range(0, 360, 15), dice.randint(3, 8)))
        corners = [tuple(round(dice.randint(2, 12) * way(at * pi / 180)) for way in (cos, sin)) for at in angles]
        area = polygon(corners, page)
        if not area.is_valid or area.area < 12:
            continue
        is_slug = dice.random() < 0.5
        options = {
            "--slug-tab" if is_slug else "--tab": dice.choice([0.3, 0.5, 1, 1.5, 2, 3]),
            "--passes": dice.choice(["0", "0.05,0", "0.06,0.02,0"]),
            "--tabs": dice.choice([1, 1, 2, 3]),
            "--overlap": dice.choice([0, 0, 0.2, 0.5]),
            "--lead-shape": dice.choice(["perpendicular", "arc"]),
            "--lead": dice.choice([1, 3]),
        }
        words = [word for option in options.items() for word in option] + ["--reverse"] * dice.choice([0, 1])
        try:
            metal = cut_metal(run, tmp_path, page, area, *words, is_slug=is_slug)
        except UserError as refused:
            assert re.search("tab|room|overlap|wire", str(refused)), refused
            continue
        made += 1
        before = [metal.holds(done, R) for done in range(len(metal.paths))]
        assert all(before) and not metal.holds(len(metal.paths), R), (
            corners,
            words,
            before,
        )
        part, wanted = metal.faces
        assert wanted.difference(part.buffer(2 * LIMIT)).area < 1e-5, (corners, words)
    assert made > 8


def test_places_of_tabs(run: Run, tmp_path: Path) -> None:
    """A contour's own tabs, by their places; an opening keeps its slug where contour, layer or default ask for it."""
    page = drawing()
    polygon([(0, 0), (40, 0), (40, 30), (0, 30)], page)
    polygon([(10, 10), (30, 10), (30, 20), (10, 20)], page, layer="die")
    path = saved(page, tmp_path)
    job, tape = tmp_path / "part.job.toml", tmp_path / "a.3b"
    head = 'schema = 1\ndrawing = "part.dxf"\n[machine]\noffset = 0.1\n'
    outer = '[[contour]]\nlayer = "0"\nkind = "outline"\nat = [0, 0]\nsize = [40, 30]\n'
    inner = '[[contour]]\nlayer = "die"\nkind = "opening"\nat = [10, 10]\nsize = [20, 10]\n'
    program = tmp_path / "a.skg"
    for text, told in (
        (
            outer + "tab = 2\ntabs = [[5, 0], [40, 10], [20, 30]]\n",
            [Phrase("contour-numbers", numbers=(2,)), Phrase("with-tab", tab=2, count=3)],
        ),
        (
            inner + "tab = 3\n",
            [
                Phrase("contour-numbers", count=1, numbers=(1,)),
                Phrase("kind-opening", count=1),
                Phrase("with-tab", count=1, tab=3),
            ],
        ),
        (
            '[[layer]]\nname = "die"\nslug_tab = 3\n',
            [
                Phrase("contour-numbers", count=1, numbers=(1,)),
                Phrase("kind-opening", count=1),
                Phrase("with-tab", count=1, tab=3),
            ],
        ),
        (
            "[default]\nslug_tab = 3\n",
            [
                Phrase("contour-numbers", count=1, numbers=(1,)),
                Phrase("kind-opening", count=1),
                Phrase("with-tab", count=1, tab=3),
            ],
        ),
    ):
        job.write_text(head + text)
        assert says(run("cut", job, "-o", tape, "--program", program).stderr, *told)
        assert len(list(stretches(tape.read_bytes(), (0, 0)))) == 2 + (5 if "tabs" in text else 1)
    job.write_text(head + outer + "tab = 2\ntabs = [[5, 0], [40, 10], [20, 30]]\n")
    run("cut", job, "-o", tape, "--program", program)
    first = start_of(program)
    _, *paths = stretches(tape.read_bytes(), first)
    wire, middles = Polygon([(0, 0), (40, 0), (40, 30), (0, 30)]).buffer(R).exterior, []
    for place in paths[-3:]:
        on = LineString(place).intersection(wire.buffer(LIMIT))
        middles.append(on.interpolate(0.5, normalized=True))
    for place in ((5, 0), (40, 10), (20, 30)):
        assert min(middle.distance(Point(place)) for middle in middles) < R + 2 * LIMIT
    for bad, fact in (
        ("tab = 2\ntabs = [[5, 0], [6, 0]]\n", Phrase("tabs-crowded", tab=2)),
        ("tab = 2\ntabs = [[5, 0], [40, 10]]\nentry = [1, 0]\n", Phrase("entry-and-tabs")),
        ("tab = 2\npasses = [0.05, 0.01]\ntab_passes = [0]\n", Phrase("tab-passes-beyond", first=0.05, last=0.01)),
        ("tab = 2\noverlap = 90\n", Phrase("overlap-too-long", overlap=90, cut=138)),
        ("tab = 0.2\n", Phrase("tab-holds-no-part", tab=0.2)),
        ("tab = 2\ntabs = []\n", Phrase("wrong-value", key="tabs")),
        ("slug_tab = 2\n", Phrase("unknown-key-near", key="slug_tab")),
    ):
        job.write_text(head + outer + bad)
        assert says(run_failing(run, "cut", job, "-o", tape), fact)
    with_tab = run("cut", path, "-o", tape, "--offset", R, "--slug-tab", 1, "--side", "outside").stderr
    assert says(with_tab, Phrase("no-slug-has-tab"), "tab")


@pytest.mark.parametrize("lead", ["perpendicular", "arc"])
def test_overlap(run: Run, tmp_path: Path, lead: str) -> None:
    """Each pass goes on past its start by the overlap, and comes back to its start hole; nothing else changes."""
    page, over = drawing(), 1.5
    area = polygon([(0, 0), (30, 0), (30, 20), (0, 20)], page)
    words = ["--overlap", over, "--lead-shape", lead, "--passes", "0.05,0"]
    metal = cut_metal(run, tmp_path, page, area, *words)
    assert len(metal.paths) == 2
    # (an arc that touches the contour is within the limit of it for a little way)
    near = 0.02 if lead == "perpendicular" else 0.3
    for path, aside in zip(metal.paths, (R + 0.05, R), strict=True):
        ring = area.buffer(aside, join_style="mitre", mitre_limit=50).exterior
        pieces = map(LineString, pairwise(path.coords))
        along = sum(piece.length for piece in pieces if ring.buffer(LIMIT).contains(piece))
        assert along == pytest.approx(ring.length + over, abs=near)
        assert path.coords[0] == pytest.approx(path.coords[-1], abs=0.0015)
    assert metal.proud().area < 1e-4
    assert says(
        run("cut", saved(page, tmp_path), "-o", tmp_path / "a.3b", "--overlap", over).stderr,
        Phrase("with-overlap", overlap=1.5),
    )
