"""Pictures: their geometry is read back out of the SVG and compared, not their bytes.

`golden/*.svg` were looked at by eye; `python tests/tools/test_plot.py` draws them anew.
"""

from __future__ import annotations

import json
import re
import sys
from math import cos, hypot, sin
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from facthelp import says
from matplotlib.backends.backend_agg import FigureCanvasAgg
from toolhelp import CAD_TAPE, Run

from skg import tape as tapes
from skg.messages.finding import Phrase
from skg.pictures.page import as_it_stands
from skg.pictures.plot import FEW, Picture, Sheet
from skg.tape.layout import Placed, place, stop_places

HERE = Path(__file__).parent
PLATE = HERE / "parts" / "plate.3b"
PLATE_SKG = HERE / "parts" / "plate.skg"
#: Golden picture -> arguments that draw it.
GOLDEN = {
    "cad.svg": ["-", "--blocks", "--wire", "1"],
    "plate.svg": [str(PLATE), "--start", "30,-30", "--positions", "programmed"],
    "two.svg": [str(PLATE), str(PLATE), "--start", "30,-30", "--start", "35,-25", "--scale", "1",
                "--positions", "machine", "--title", "Two plates"],
    "offset.svg": [str(PLATE_SKG), "--show-offset", "--skg80", "reference", "--positions", "programmed"],
}  # fmt: skip
SVG = "{http://www.w3.org/2000/svg}"
_NUMBERS = re.compile(r"([MLCz])|(-?\d+\.?\d*(?:e-?\d+)?)")


def sampled(svg: bytes) -> dict[str, list[tuple[float, float]]]:
    """Points of every path that has an id of ours, in mm of the part, 9 on each piece."""
    root = ElementTree.fromstring(svg)
    note = next(element for element in root.iter() if element.tag.endswith("}description"))
    page = json.loads(note.text)
    found = {}
    for group in root.iter(f"{SVG}g"):
        if not re.match(r"tape-\d", group.get("id", "")):
            continue
        points = []
        for x, y in flattened(group.find(f"{SVG}path").get("d")):
            points.append(
                (
                    page["left"] + x / page["mm_to_points"],
                    page["bottom"] + (page["height_points"] - y) / page["mm_to_points"],
                )
            )
        found[group.get("id")] = points
    return found


def flattened(d: str) -> list[tuple[float, float]]:
    """Points along an SVG path of M, L, C and z."""
    tokens = [letter or float(number) for letter, number in _NUMBERS.findall(d)]
    points: list[tuple[float, float]] = []
    at = 0
    while at < len(tokens):
        letter, at = tokens[at], at + 1
        if letter == "z":
            continue
        pairs = []
        while at < len(tokens) and not isinstance(tokens[at], str):
            pairs.append((tokens[at], tokens[at + 1]))
            at += 2
        if letter == "M":
            points += pairs
            continue
        step = 1 if letter == "L" else 3
        for first in range(0, len(pairs), step):
            corners = [points[-1], *pairs[first : first + step]]
            points += [bezier(corners, k / 8) for k in range(1, 9)]
    return points


def bezier(corners: list[tuple[float, float]], t: float) -> tuple[float, float]:
    while len(corners) > 1:
        corners = [
            ((1 - t) * a + t * c, (1 - t) * b + t * d) for (a, b), (c, d) in zip(corners, corners[1:], strict=False)
        ]
    return corners[0]


def apart(ones: list[tuple[float, float]], others: list[tuple[float, float]]) -> float:
    """Largest distance of corresponding points, mm."""
    assert len(ones) == len(others)
    return max(hypot(a - c, b - d) for (a, b), (c, d) in zip(ones, others, strict=True))


@pytest.mark.parametrize("name", GOLDEN)
def test_golden(run: Run, tmp_path: Path, name: str) -> None:
    drawn = tmp_path / name
    result = run("plot", *GOLDEN[name], "-o", drawn, stdin=CAD_TAPE)
    assert result.exit_code == 0, result.output
    new, golden = sampled(drawn.read_bytes()), sampled((HERE / "golden" / name).read_bytes())
    assert new.keys() == golden.keys()
    for key, points in golden.items():
        assert apart(new[key], points) < 0.002, key


def test_drawn_path_is_the_tape(run: Run, tmp_path: Path) -> None:
    """Every point drawn lies on its block's line or circle, and the corners are the blocks' ends."""
    drawn = tmp_path / "plate.svg"
    run("plot", PLATE, "--start", "30,-30", "-o", drawn)
    paths = sampled(drawn.read_bytes())
    for number, route in enumerate(place(tapes.read(str(PLATE)), (30_000, -30_000)), 1):
        points = paths[f"tape-1-route-{number}"]
        for placed in route.blocks:
            for part in (0, 0.25, 0.5, 0.75, 1):
                x, y = (ordinate / 1000 for ordinate in placed.at(part))
                assert min(hypot(x - u, y - v) for u, v in points) < placed.block.length / 1000 / 8
            if not placed.block.is_line:
                continue
            for x, y in (placed.start, placed.end):
                assert min(hypot(x / 1000 - u, y / 1000 - v) for u, v in points) < 0.003
        for u, v in points:
            assert min(distance(placed, 1000 * u, 1000 * v) for placed in route.blocks) < 5


def distance(placed: Placed, x: float, y: float) -> float:
    """From a point to a block's whole line or circle, µm."""
    if placed.block.is_line:
        way = placed.direction(0)
        return abs((x - placed.start[0]) * sin(way) - (y - placed.start[1]) * cos(way))
    return abs(hypot(x - placed.centre[0], y - placed.centre[1]) - hypot(placed.block.x, placed.block.y))


@pytest.mark.parametrize(("form", "begin"), [("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml")])
def test_formats(run: Run, tmp_path: Path, cad_tape: Path, form: str, begin: bytes) -> None:
    picture = tmp_path / f"cad.{form}"
    assert run("plot", cad_tape, "-o", picture).exit_code == 0
    assert picture.read_bytes().startswith(begin)
    result = run("plot", cad_tape, "-o", "-", "--format", form)
    assert result.stdout_bytes.startswith(begin)


def test_same_bytes_every_time(run: Run, cad_tape: Path) -> None:
    first, second = (run("plot", cad_tape, "-o", "-").stdout_bytes for _ in range(2))
    assert first == second


def test_wire_to_scale(run: Run, cad_tape: Path) -> None:
    """The kerf's width on the paper is the wire's diameter times the scale."""
    svg = run("plot", cad_tape, "-o", "-", "--wire", "2", "--scale", "0.5").stdout
    width = float(re.search(r'id="tape-1-route-1-kerf".*?stroke-width: ([\d.]+)', svg, re.S)[1])
    assert width == pytest.approx(2 * 0.5 * 72 / 25.4, rel=1e-4)


def test_offset_lies_beside_the_contour(run: Run) -> None:
    """R = 0.1: the wire path on a belt and an arc is 0.1 mm from the contour."""
    svg = run("plot", PLATE_SKG, "--show-offset", "--skg80", "reference", "-o", "-").stdout_bytes
    paths = sampled(svg)
    contour = paths["tape-1-contour"]
    belt = paths["tape-1-route-1"][8:-8]
    assert len(belt) > 8
    for x, y in belt:
        assert 0.098 < hypot(*nearest_offset(contour, x, y)) < 0.1 + 0.01


def nearest_offset(points: list[tuple[float, float]], x: float, y: float) -> tuple[float, float]:
    """Vector to the nearest point of a polyline."""
    best = None
    for (a, b), (c, d) in zip(points, points[1:], strict=False):
        length = (c - a) ** 2 + (d - b) ** 2
        t = min(1, max(0, ((x - a) * (c - a) + (y - b) * (d - b)) / length)) if length else 0
        vector = a + t * (c - a) - x, b + t * (d - b) - y
        if best is None or hypot(*vector) < hypot(*best):
            best = vector
    return best


@pytest.mark.parametrize(
    ("arguments", "facts"),
    [
        (["nothing.3b", "-o", "x.svg"], [Phrase("system-no-file")]),
        ([PLATE, "-o", "x.bmp"], ["x.bmp: ", Phrase("picture-name"), Phrase("or-format")]),
        ([PLATE, "-o", "x.svg", "--show-offset"], [Phrase("no-nominal-contour")]),
        ([PLATE, "-o", "/nowhere/x.svg"], [Phrase("system-no-file")]),
        ([PLATE, "-o", "x.svg", "--scale", "1000"], [Phrase("picture-too-large")]),
        (["-", "-o", "x.svg"], ["-: ", Phrase("nothing-to-draw")]),
        ([PLATE_SKG, "-o", "x.svg", "--skg80", "/nowhere"], [Phrase("no-such-file")]),
    ],
)
def test_bad_wishes(run_program: Run, arguments: list, facts: list[str]) -> None:
    stdin = "DD\r\n" if arguments[0] == "-" else ""
    result = run_program("plot", *arguments, stdin=stdin)
    assert result.returncode == 2
    assert says(result.stderr.splitlines()[-1], *facts)
    assert "Traceback" not in result.stderr


def test_odd_names(run: Run, tmp_path: Path) -> None:
    """A name or title is written as it stands: no formula, an escape for what is no letter."""
    names = [tmp_path / name for name in ("b\udcff.3b", "a$\\b$.3b")]
    for name in names:
        name.write_bytes(PLATE.read_bytes())
    words = [*names, "--positions", "programmed", "--title", "$\\t$"]
    texts = [one.text for one in ElementTree.fromstring(run("plot", *words, "-o", "-").stdout_bytes).iter(f"{SVG}text")]
    assert {"b\\xff.3b", "a$\\b$.3b", "$\\t$"} <= set(texts)


def test_program_with_an_error(run_program: Run, tmp_path: Path) -> None:
    part = tmp_path / "bad.skg"
    part.write_text("10 A=1/0\n20 END\n")
    result = run_program("plot", part, "-o", tmp_path / "x.svg", "--skg80", "reference")
    assert (result.returncode, result.stderr) == (2, f"skg: {part}: ERR 05 LINE 10, {Phrase('meaning-5')}\n")


def squares(count: int) -> Picture:
    """A picture of so many squares in a row, their blocks numbered."""
    square = "B5000B0B5000GXL1\r\nB0B5000B5000GYL2\r\nB5000B0B5000GXL3\r\nB0B5000B5000GYL4\r\n"
    tape = tapes.parse("D\r\nB8000B0B8000GXL1\r\nD\r\n".join([square] * count).encode() + b"DD\r\n")
    routes = place(tape)
    picture = Picture([Sheet("squares", routes)], None, "")
    picture.draw(Sheet("squares", routes), "#0072b2", "tape-1", 0.2, True, True)
    picture.stops(stop_places(tape, routes, (0, 0)), "tape-1")
    return picture


def test_many_routes_are_few_artists() -> None:
    """A patch for each route, start and stop took 40 s for 12,500 of them; nothing is lost where they are one."""
    count = FEW + 1
    few, many = squares(100), squares(count)
    assert len(many.axes.patches) < 10 < 400 < len(few.axes.patches)
    parts = {patch.get_gid(): patch.get_path() for patch in many.axes.patches}
    begins = {gid: int((path.codes == path.MOVETO).sum()) for gid, path in parts.items() if gid}
    assert begins == {
        "tape-1-cuts": count,
        "tape-1-moves": count - 1,
        "tape-1-starts": count,
        "tape-1-stops": count,
    }
    (kerfs,) = (one for one in many.axes.collections if one.get_gid() == "tape-1-kerfs")
    assert len(kerfs.get_paths()) == count
    ends = [path.vertices[-1].tolist() for path in kerfs.get_paths()]
    assert ends == [[8 * at, 0] for at in range(count)]
    # Marks do not cover what they mark: squares 5 mm wide, 8 mm apart.
    assert max(np.ptp(parts["tape-1-stops"].vertices[:5], axis=0)) < 4


def test_a_long_route_is_several_curves(monkeypatch: pytest.MonkeyPatch) -> None:
    """One string of a million blocks took half a gigabyte; each curve goes on where the one before ends."""
    monkeypatch.setattr("skg.pictures.plot.LONGEST", 7)
    tape = tapes.parse(b"B500B0B500GXL1\r\nB0B500B500GYL2\r\n" * 10 + b"DD\r\n")
    sheet = Sheet("stairs", place(tape))
    picture = Picture([sheet], None, "")
    picture.draw(sheet, "#0072b2", "tape-1", 0, False, False)
    curves = [patch for patch in picture.axes.patches if "-from-" in patch.get_gid()]
    assert [patch.get_gid() for patch in curves] == [f"tape-1-route-1-from-{at}" for at in (1, 8, 15)]
    drawn = np.concatenate([patch.get_path().vertices for patch in curves])
    assert len(drawn) == 40 and drawn[0].tolist() == [0, 0] and drawn[-1].tolist() == [5, 5]
    assert (drawn[1:-1:2] == drawn[2::2]).all()


def test_block_numbers_never_pile_up() -> None:
    picture = squares(60)
    numbers = [text for text in picture.axes.texts if text.get_color() == "#0072b2"]
    assert len(numbers) + picture.left_out == 60 * 4 + 59 and picture.left_out > 20
    renderer = FigureCanvasAgg(picture.figure).get_renderer()
    boxes = [text.get_window_extent(renderer) for text in numbers]
    assert len(boxes) > 20
    # (the box of a text has room for letters that go below the line; digits are 6 pixels high, in 6 points at 100 dpi)
    digits = [box.padded(-0.6, (6 - box.height) / 2) for box in boxes]
    assert min(box.height for box in digits) > 5.9
    assert not any(one.overlaps(other) for at, one in enumerate(digits) for other in digits[:at])


def test_other_fonts_for_other_letters_alone() -> None:
    """A title in letters that matplotlib's own font has is in that font; for others the installed ones are named."""
    assert "fontfamily" not in as_it_stands("Größe 5 µm, Ø 3")
    assert as_it_stands("零件 5")["fontfamily"][0] == "DejaVu Sans"


if __name__ == "__main__":
    from click.testing import CliRunner

    from skg.cli import cli

    for golden, wishes in GOLDEN.items():
        target = str(HERE / "golden" / golden)
        drawing = CliRunner().invoke(cli, ["plot", *wishes, "-o", target], input=CAD_TAPE)
        sys.stderr.write(f"{golden}: {drawing.exit_code} {drawing.output}\n")
