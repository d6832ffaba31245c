"""`skg check` of a program: the wire beside the contour that it draws. Where it cuts into that shapely says so, too."""

from __future__ import annotations

import json
import re
from pathlib import Path
from random import Random

import pytest
import shapely
from cuthelp import drawing, polygon, saved, stretches
from facthelp import says
from toolhelp import ROOT, Run

from skg.board import symbols
from skg.board.feeding import feed
from skg.errors import UserError
from skg.geometry.plane import XY
from skg.messages.finding import Phrase
from skg.sources import load

NECK = "20 FROM O\n30 C=(3.6,0):.5\n40 CUT X:1,Y:2;X:.1;C;-X:.1;Y:2,-X:1,-Y:2\n70 BACK\n80 END\n"
#: Examples whose wire spoils something, and why: one outline in two sizes at one place; both halves of a disc.
TOLD = {"scale.skg", "skg07-line-circle.skg"}


def checked(run: Run, folder: Path, program: str, *words: object, name: str = "part.skg") -> tuple[int, str]:
    path = folder / name
    path.write_text(program)
    done = run("check", path, *words)
    return done.exit_code, done.stdout


def contour(corners: list[XY], r: float, hole: XY) -> str:
    """A program that cuts a polygon, entered in the middle of its first side."""
    middle = tuple((one + other) / 2 for one, other in zip(*corners[:2], strict=True))
    cuts = "".join(f"CUT ({x:.4f},{y:.4f})\n" for x, y in [middle, *corners[1:], corners[0], middle])
    return f"R={r}\nFROM ({hole[0]},{hole[1]})\n{cuts}BACK\nEND\n"


WALLS = {
    "slot": [(0, 0), (10, 0), (10, 10), (5, 10), (5, 2), (4, 2), (4, 10), (0, 10)],
    "mouth": [(0, 0), (10, 0), (10, 10), (5, 10), (5, 8), (8, 8), (8, 2), (2, 2), (2, 8), (4, 8), (4, 10), (0, 10)],
}


def wide(shape: str, width: float, scale: float = 1.0) -> list[XY]:
    """The corners of a shape whose opening is so wide."""
    return [((4 + (x - 4) * width if 4 <= x <= 5 else x) * scale, y * scale) for x, y in WALLS[shape]]


def mouth(width: float, r: float = 0.1) -> str:
    """A program for the mouth, as large as R asks for."""
    scale = 10 * r if r > 1 else 1.0
    return contour(wide("mouth", width / scale, scale), r, (5 * scale, -2 * scale))


def numbered(program: str) -> str:
    return "".join(f"{10 * at} {line}\n" for at, line in enumerate(program.splitlines(), 1))


def test_a_neck_that_is_narrower_than_the_wire(run: Run, tmp_path: Path) -> None:
    """The ROM refuses it: the arc between its corners vanishes."""
    with pytest.raises(UserError, match="ERR 06 LINE"):
        checked(run, tmp_path, f"10 R=-.11\n{NECK}")
    code, told = checked(run, tmp_path, f"10 R=-.09\n{NECK}")
    assert code == 0 and says(told, Phrase("nothing-wrong"), Phrase("path-beside", count=1))


def test_as_json(run: Run, tmp_path: Path) -> None:
    code, told = checked(run, tmp_path, numbered(mouth(0.15)), "--json")
    found = json.loads(told)
    assert code == 1 and {one["tool"] for one in found} == {"wire"}
    assert all(isinstance(one["line"], int) for one in found)
    assert max(one["depth"] for one in found) == pytest.approx(0.05, abs=1e-3)
    # (both sides of the mouth)
    assert all(4 <= one["place"][0] <= 4.15 and 8 <= one["place"][1] <= 10 for one in found if one["depth"])


def test_a_cutter(run: Run, tmp_path: Path) -> None:
    """A milling program: the mouth is 5 mm wide."""
    part = mouth(5.0, 3.0).replace("END\n", "")
    code, told = checked(run, tmp_path, f"Z -2,5\nF 300,60\n{part}END\n")
    assert code == 1 and says(told, Phrase("path-cuts-in", depth=1), Phrase("tool-cutter"))
    code, told = checked(run, tmp_path, f"Z -2,5\nF 300,60\n{mouth(5.0, 2.0)}")
    assert code == 0 and says(told, Phrase("path-beside", count=1))


def test_nothing_is_said_of_a_wire_on_its_contour(run: Run, tmp_path: Path) -> None:
    code, told = checked(run, tmp_path, f"10 R=0\n{NECK}")
    assert code == 0 and "contour" not in told


@pytest.mark.parametrize(("hole", "is_in"), [((5, -3), False), ((5, 5), True), ((-3, 12), True), ((-3, -1), False)])
def test_the_way_from_the_start_hole(run: Run, tmp_path: Path, hole: XY, is_in: bool) -> None:
    """A start hole in the part: the wire comes through its edge."""
    code, told = checked(run, tmp_path, contour([(0, 0), (10, 0), (10, 10), (0, 10)], 0.1, hole))
    assert code == is_in and says(told, Phrase("path-cuts-in")) == is_in


def test_two_windows_with_a_wall_thinner_than_the_wire(run: Run, tmp_path: Path) -> None:
    """The wire of one window comes into no other, be the wall as thin as it may; that of a part comes into the next."""
    for r, gap, is_into in ((-0.1, 0.05, False), (0.1, 0.15, True), (0.1, 0.25, False)):
        squares = [[(x, 0.0), (x + 10, 0.0), (x + 10, 10.0), (x, 10.0)] for x in (0.0, 10 + gap)]
        first, second = (contour(one, r, (one[0][0] + 5, 5.0 if r < 0 else -3.0)) for one in squares)
        code, told = checked(run, tmp_path, first.replace("END\n", "") + second)
        assert code == is_into, (r, gap, told)
        assert (
            sum(
                says(line, Phrase("path-of-other-cuts-in", depth=0.05), Phrase("tool-wire"))
                for line in told.splitlines()
            )
            == 2 * is_into
        )


@pytest.mark.parametrize("width", [0.15, 0.19, 0.21, 0.3])
@pytest.mark.parametrize("shape", WALLS)
def test_walls_that_are_no_neighbours(run: Run, tmp_path: Path, shape: str, width: float) -> None:
    program, fits = contour(wide(shape, width), 0.1, (5, -2)), width > 0.2
    if feed(program, "standard", 8).error:
        assert not fits
        return
    code, told = checked(run, tmp_path, program)
    assert code == (not fits)
    if not fits:
        assert says(told, Phrase("path-cuts-in", depth=round(2 * 0.1 - width, 4)))


def test_what_the_check_says_shapely_says(run: Run, tmp_path: Path) -> None:
    """T slots of random whole numbers: the wire is told to cut into them where the tape's way is nearer than R."""
    random, seen = Random(3), {True: 0, False: 0}
    for _ in range(80):
        slots, r = random.randint(1, 3), random.randint(1, 8) / 10
        corners: list[XY] = [(0.0, 0.0), (10.0 * slots + 10, 0.0), (10.0 * slots + 10, 10.0)]
        for slot in range(slots, 0, -1):
            middle, mouth, wide = (
                10.0 * slot + random.randint(0, 3),
                random.randint(1, 20) / 20,
                random.randint(3, 8) / 2,
            )
            top, low, lean = random.randint(6, 9), random.randint(1, 4), random.choice((0.0, 0.0, 0.3, -0.3))
            right, left = [(mouth, 10), (mouth, top), (wide + lean, top), (wide, low)], []
            left = [(-x, y) for x, y in reversed(right)]
            corners += [(middle + x, float(y)) for x, y in right + left]
        corners.append((0.0, 10.0))
        program = contour(corners, r, (5.0, -3.0))
        fed = feed(program, "standard", 8)
        if fed.error:
            continue
        (places,) = stretches(fed.tape, (5.0, -3.0))
        depth = r - shapely.LineString(places).distance(shapely.LinearRing(corners))
        if 0.002 < depth < 0.005:
            continue
        code, told = checked(run, tmp_path, program)
        assert code == (depth > 0.003), (depth, program, told)
        seen[depth > 0.003] += 1
    assert min(seen.values()) >= 10, seen


@pytest.mark.parametrize(
    "words",
    [
        ["--passes", "0.06,0.02,0", "--tab", 3],
        ["--lead-shape", "arc"],
        ["--lead-shape", "arc", "--passes", "0.06,0.02,0", "--tab", 3],
        ["--reverse", "--passes", "0.05,0"],
        ["--side", "outside"],
    ],
)
def test_programs_of_skg_cut(run: Run, tmp_path: Path, words: list[object]) -> None:
    """Leads, passes and a tab are no fault."""
    page = drawing()
    polygon([(0, 0), (60, 0), (60, 40), (30, 44), (0, 40)], page)
    page.modelspace().add_circle((12, 15), 6)
    page.modelspace().add_lwpolyline([(26, 11, 0), (36, 11, 1), (36, 19, 0), (26, 19, 1)], "xyb", close=True)
    program = tmp_path / "part.skg"
    run("cut", saved(page, tmp_path), "-o", tmp_path / "a.3b", "--offset", 0.1, *words, "--program", program)
    done = run("check", program)
    assert done.exit_code == 0 and says(done.stdout, Phrase("path-beside")), done.stdout


def test_examples(run: Run) -> None:
    """They fit, but those that are known to spoil something; most have a wire beside a contour. (Of the others a third:
    the reference takes seconds for a gear.)"""
    paths = [path for kind in ("*.skg", "mill/*.skg", "*.xy", "*.tkh") for path in (ROOT / "examples").glob(kind)]
    paths = [path for n, path in enumerate(sorted(paths)) if n % 3 == 1 or path.name in TOLD]
    beside = 0
    for path in paths:
        done = run("check", path)
        assert (done.exit_code == 1) == (path.name in TOLD), (path, done.stdout)
        beside += says(done.stdout, Phrase("path-beside"))
    assert beside > len(paths) / 2


def test_a_program_that_is_translated_has_no_lines(run: Run, tmp_path: Path) -> None:
    """The way from the start hole to the first element crosses the part's corner."""
    text = (ROOT / "examples/xy-die-set.xy").read_text()
    part = tmp_path / "part.xy"
    part.write_text(text.replace("D(0,25)=>D7", "D(-4,9)=>D7"))
    done = run("check", part)
    assert done.exit_code == 1 and says(done.stdout, Phrase("path-cuts-in", depth=0.1263))
    assert not says(done.stdout, re.compile(r"near .*line \d"))
    done = run("check", ROOT / "examples/xy-die-set.xy")
    assert done.exit_code == 0, done.stdout


#: FIT behind a sharp inner corner: an arc of 2° that a ROM without the rule "The wire may not turn over" (language.md,
#: section 4.2) runs round the other way, through a wall far from it and through its own first side.
NOSES = {
    "corner": "R=-2\nCUT (0,0)\nFIT (10,0),88\nFIT (10,1),92\nFIT (9,10)\n",
    "nose": "R=-.1\nFROM (.5,1)\nCUT -Y\nA=-90\nFIT 1.5#A\nA=A+6\nIF A<1 GOTO 50\nCUT (1.5,3),(0,3)\nBACK\n",
}


@pytest.mark.parametrize("name", NOSES)
def test_a_wire_that_goes_through_a_wall(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    """The ROM, with the look at half a turn taken out, cuts what the reference refuses."""
    image = bytearray((ROOT / "roms/skg.bin").read_bytes())
    image[symbols((ROOT / "roms/skg.sym").read_text())["WRAP"]] = 0xC9
    monkeypatch.setattr(load, "feed", lambda text, rom: feed(text, bytes(image)))
    code, told = checked(run, tmp_path, numbered(NOSES[name]))
    assert code == 1 and says(told, Phrase("reference-refuses", number=6), Phrase("of-line")), told
    assert says(told, Phrase("path-cuts-in", depth=1.9995 if name == "corner" else 0.0991))
