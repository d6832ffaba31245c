"""Machines that read G-code: `--machine`, and an interpreter of an offset in the control; docs/machines.md is true."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise
from math import atan2, cos, pi, sin
from pathlib import Path

import pytest
import shapely
from cuthelp import LIMIT, apart, drawing, polygon, run_failing, saved, stretches
from ezdxf.document import Drawing
from facthelp import says
from hypothesis import given, settings
from hypothesis import strategies as st
from test_cut import start_of
from test_docs import EXAMPLE, ROOT, indented, printed
from test_gcode import CAD_GCODE, laid, vertices
from test_tape import blocks
from toolhelp import Run

from skg import tape as tapes
from skg.dialects.file import decoded, dialect_of, names
from skg.messages.finding import Phrase
from skg.tape import Block, Stop, gcode, gcode_reader
from skg.tape.layout import PlacedRoute

PAGE = ROOT / "docs" / "machines.md"
CAD_TAPE_FILE = ROOT / "examples" / "cad-tape.3b"


def test_chinese_wire_iso(run: Run) -> None:
    """CAXA's print of the part whose 3B tape it printed, too (docs/spec/tape-3b.md)."""
    words = ["--start", "115,-10", "--positions", "programmed", "--machine", "wire-iso"]
    made = run("gcode", CAD_TAPE_FILE, *words)
    assert made.stdout_bytes.decode() == CAD_GCODE.replace("\n", "\r\n")


@settings(max_examples=40)
@given(st.sampled_from(names()), st.lists(st.one_of(blocks(), st.builds(Stop, st.just(0))), min_size=1))
def test_all_read_back(name: str, items: list[Block | Stop]) -> None:
    """The cuts, and the number of pieces between stops."""
    dialect, tape = dialect_of(name), tapes.parse(tapes.to_bytes(items))
    text = gcode.write(tape, (2000, -3000), positions="programmed", dialect=dialect)
    program, findings = gcode_reader.scan(text, dialect=dialect)
    assert [finding for finding in findings if finding.is_fatal] == []
    cuts = [[route for route in routes if not route.is_move] for routes in (program.routes(), laid(tape))]
    through = [[place for route in vertices(routes) for place in route] for routes in cuts]
    shifted = [(x + 2000, y - 3000) for x, y in through[1]]
    if dialect.unthread:
        assert [place for place, _ in _once(through[0])] == [place for place, _ in _once(shifted)]


def _once(places: list[tuple[float, float]]) -> Iterator[tuple[tuple[float, float], int]]:
    last = None
    for place in places:
        if place != last:
            yield place, 0
        last = place


def test_wire_on_for_cuts_alone(run: Run, tmp_path: Path) -> None:
    """GRBL: each G1 to G3 finds the output on, each G0 and M0 finds it off."""
    page = drawing()
    polygon([(0, 0), (30, 0), (30, 20), (0, 20)], page)
    page.modelspace().add_circle((10, 10), 4)
    part = tmp_path / "part.nc"
    run("cut", saved(page, tmp_path), "-o", part, "--offset", 0.1, "--tab", 2, "--machine", "grbl-wire")
    is_on, cuts, rests = False, 0, 0
    for line in part.read_text().splitlines():
        word = re.match(r"[GM]\d+", line)[0]
        if word in ("M3", "M5"):
            assert is_on == (word == "M5") or not cuts
            is_on = word == "M3"
        elif word in ("G1", "G2", "G3"):
            cuts += 1
            assert is_on
        elif word in ("G0", "M0", "M30"):
            rests += 1
            assert not is_on
    assert cuts > 8 and rests > 6 and says(run("check", part, "--machine", "grbl-wire").output, Phrase("nothing-wrong"))
    assert says(run("sim", part, "--machine", "grbl-wire").output, Phrase("sim-blocks"))
    run("plot", part, "--machine", "grbl-wire", "-o", tmp_path / "part.svg")
    run("dxf", part, "--machine", "grbl-wire", "-o", tmp_path / "part2.dxf")
    assert run("gcode", "--back", part, "--machine", "grbl-wire").output.count("D\n") >= 5


def test_what_is_written_checks_right(run: Run, tmp_path: Path) -> None:
    """A drawing with two contours, for each machine that ships."""
    page = drawing()
    polygon([(0, 0), (30, 0), (30, 20), (0, 20)], page)
    page.modelspace().add_circle((10, 10), 4)
    path, part = saved(page, tmp_path), tmp_path / "part.nc"
    for name in names():
        run("cut", path, "-o", part, "--offset", 0.1, "--machine", name)
        said = run("check", part, "--machine", name)
        assert said.exit_code == 0 and says(said.output, Phrase("nothing-wrong")), (name, said.output)


def test_numbers_and_arcs(run: Run, tmp_path: Path) -> None:
    """Radii, centres from the origin, two decimals, relative: all come back where they were."""
    machine = tmp_path / "my.toml"
    tape = tapes.parse((ROOT / "examples" / "plate-fillets.3b").read_bytes())
    for arcs in ("ij", "ij-absolute", "r"):
        for places in ("absolute", "relative"):
            for decimals in (2, 3):
                machine.write_text(
                    f'[numbers]\narcs = "{arcs}"\nplaces = "{places}"\ndecimals = {decimals}\npoint = true\n'
                    '[lines]\nhead = ["(head)"]\nfoot = ["(foot)"]\n'
                )
                dialect = dialect_of(str(machine))
                text = gcode.write(tape, positions="programmed", dialect=dialect)
                program = gcode_reader.read(text, dialect=dialect)
                lines = [dense(routes) for routes in (program.routes(), laid(tape))]
                assert lines[0].hausdorff_distance(lines[1]) <= (3.5 if decimals == 3 else 20)


def dense(routes: list[PlacedRoute]) -> shapely.MultiPoint:
    """Places along all cuts, µm, close enough together to compare them."""
    pieces = [placed for route in routes if not route.is_move for placed in route.blocks]
    return shapely.union_all([shapely.LineString([piece.at(part / 64) for part in range(65)]) for piece in pieces])


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ("[lines]\nhead = []\n", (Phrase("key-missing", key="foot"),)),
        (
            "[lines]\nhead = []\nfoot = []\nfeet = []\n",
            ("[lines]", Phrase("unknown-key-near", key="feet", near="foot")),
        ),
        (
            '[numbers]\nunit = "inch"\n',
            ("[numbers]", Phrase("wrong-value", key="unit"), Phrase("value-among", words=("mm", "um"))),
        ),
        (
            '[words]\nfeed = "F{speed}"\n',
            ("[words]", Phrase("wrong-value", key="feed"), Phrase("value-fields", fields=("{feed}",))),
        ),
        ('[lines]\nstart = ["G92 X{x"]\n', ("[lines]", Phrase("wrong-value", key="start"))),
        ('[offset]\nleft = "G41"\n[lines]\nhead=[]\nfoot=[]\n', ("[offset]", Phrase("key-missing", key="right"))),
        ("[words\n", (Phrase("not-toml"),)),
        ("words = 3\n", ("[words]", Phrase("expected-table"))),
    ],
)
def test_bad_machines(run: Run, tmp_path: Path, text: str, facts: tuple[str, ...]) -> None:
    machine = tmp_path / "my.toml"
    machine.write_text(text)
    assert says(run_failing(run, "gcode", CAD_TAPE_FILE, "--machine", machine), str(machine), *facts)


def test_errors(run: Run, tmp_path: Path) -> None:
    assert says(
        run_failing(run, "gcode", CAD_TAPE_FILE, "--machine", "wire-fanuk"),
        Phrase("no-machine-near", name="wire-fanuk", near="wire-fanuc"),
    )
    page = drawing()
    polygon([(0, 0), (30, 0), (30, 20), (0, 20)], page)
    path = saved(page, tmp_path)
    assert says(run_failing(run, "cut", path, "-o", tmp_path / "part.nc"), "part.nc", Phrase("tape-named-gcode"))
    assert says(
        run_failing(run, "gcode", CAD_TAPE_FILE, "--machine", "grbl-wire", "--z", "-1"), Phrase("z-with-machine")
    )
    # what a dialect has and the reader has not is an error with its line
    odd = tmp_path / "odd.nc"
    odd.write_text("G21\nG90\nG0 X0 Y0\nSET_PIN PIN=wire VALUE=1\nG1 X10 F60\nSET_PIN PIN=fan VALUE=1\nM2\n")
    assert says(
        run_failing(run, "gcode", "--back", odd, "--machine", "klipper"),
        "odd.nc",
        Phrase("at-column", line=6),
        Phrase("gcode-no-word"),
    )


# An offset in the control, by an interpreter of its own: lines and arcs of a program, moved aside, until they meet.

WORD = re.compile(r"([A-Z])(-?[\d.]+)")


class Element:
    """A line or an arc of a program, in mm, moved aside to the right of its way by r."""

    def __init__(self, start: complex, end: complex, centre: complex | None, sense: int, r: float) -> None:
        self.centre, self.sense = centre, sense
        if centre is None:
            self.way = (end - start) / abs(end - start)
            self.start, self.end = start - 1j * r * self.way, end - 1j * r * self.way
            return
        radius = abs(start - centre)
        # (to the right of a counter-clockwise arc is outside)
        self.radius = radius + sense * r
        self.start, self.end = (centre + (place - centre) / radius * self.radius for place in (start, end))

    def meets(self, other: Element) -> complex:
        """The place near to where this one ends and the other begins, where the two meet."""
        near = (self.end + other.start) / 2
        if abs(self.end - other.start) < 1e-6:
            return near
        places = list(self._crossings(other))
        assert places, "the control finds no crossing"
        return min(places, key=lambda place: abs(place - near))

    def _crossings(self, other: Element) -> Iterator[complex]:
        if self.centre is None and other.centre is None:
            across = (self.way.conjugate() * other.way).imag
            if abs(across) > 1e-9:
                way = ((other.start - self.start).conjugate() * other.way).imag / across
                yield self.start + self.way * way
            return
        if self.centre is None or other.centre is None:
            line, arc = (self, other) if self.centre is None else (other, self)
            along = ((arc.centre - line.start) * line.way.conjugate()).real
            foot = line.start + along * line.way
            high = arc.radius**2 - abs(foot - arc.centre) ** 2
            for side in (1, -1):
                yield foot + side * line.way * max(high, 0) ** 0.5
            return
        gap = other.centre - self.centre
        along = (abs(gap) ** 2 + self.radius**2 - other.radius**2) / (2 * abs(gap))
        high = max(self.radius**2 - along**2, 0) ** 0.5
        for side in (1, -1):
            yield self.centre + gap / abs(gap) * (along + side * 1j * high)

    def places(self, start: complex, end: complex) -> list[complex]:
        """Places along it, from a start to an end on it."""
        if self.centre is None:
            return [start, end]
        first, last = (atan2((p - self.centre).imag, (p - self.centre).real) for p in (start, end))
        sweep = self.sense * (self.sense * (last - first) % (2 * pi) or 2 * pi)
        count = max(8, int(abs(sweep) * (self.radius / 0.0005) ** 0.5))
        angles = [first + sweep * number / count for number in range(count + 1)]
        return [self.centre + self.radius * complex(cos(angle), sin(angle)) for angle in angles]


def offset_paths(text: str, offsets: dict[str, float]) -> tuple[list[shapely.LineString], list[shapely.LineString]]:
    """The wire's paths with an offset, and its ways without: a FANUC-like control of start-up type A, which puts the
    wire square to the block that follows."""
    spot, here, side, paths, free, run = 0j, 0j, 0.0, [], [], []

    def close() -> None:
        nonlocal run, here
        if not run:
            return
        elements = [element for element, _ in run if element is not None]
        places = [run[0][1]]
        corners = [one.meets(other) for one, other in pairwise(elements)]
        ends = [elements[0].start, *corners, elements[-1].end]
        for element, (start, end) in zip(elements, pairwise(ends), strict=True):
            places += element.places(start, end)
        paths.append(places)
        here = places[-1]
        run = []

    pending: list[complex] = []
    for line in text.splitlines():
        found = dict(WORD.findall(line))
        if "G41" in line or "G42" in line:
            r = offsets[found["D"]]
            side, pending = (r if "G42" in line else -r), [spot]
            continue
        if line.strip() == "G40":
            close()
            side = 0.0
            continue
        if not found.keys() & {"X", "Y"}:
            continue
        goal = complex(float(found.get("X", spot.real)), float(found.get("Y", spot.imag)))
        motion = int(found["G"])
        if motion == 1 and not side:
            free.append(shapely.LineString([(here.real, here.imag), (goal.real, goal.imag)]))
        if motion in (0, 92) or not side:
            spot = here = goal
            continue
        if pending:
            pending, hole, spot = [], pending[0], goal
            run = [(None, hole)]
            continue
        centre = spot + complex(float(found["I"]), float(found["J"])) if motion > 1 else None
        run.append((Element(spot, goal, centre, 1 if motion == 3 else -1, side), spot))
        spot = goal
    lines = [shapely.LineString([(place.real, place.imag) for place in places]) for places in paths]
    return lines, free


PARTS = {
    "five": [(0, 0), (30, 0), (30, 12), (14, 10), (0, 25)],
    "step": [(0, 0), (20, 0), (20, 8), (12, 8), (12, 14), (0, 14)],
}


def bracket(page: Drawing) -> None:
    page.modelspace().add_lwpolyline(
        [(0, 0, 0), (40, 0, 0.4142135623730951), (50, 10, 0), (50, 30, 0), (20, 30, -0.2), (0, 20, 0)],
        "xyb",
        close=True,
    )
    page.modelspace().add_circle((15, 10), 4)


@pytest.mark.parametrize("name", [*PARTS, "bracket"])
@pytest.mark.parametrize("lead", ["perpendicular", "arc"])
def test_offset_in_the_control(run: Run, tmp_path: Path, name: str, lead: str) -> None:
    """The control's path lies within 3 µm of the tape's, pass by pass."""
    page = drawing()
    bracket(page) if name == "bracket" else polygon(PARTS[name], page)
    part, tape, program = (tmp_path / file for file in ("part.nc", "part.3b", "part.skg"))
    words = [saved(page, tmp_path), "--offset", 0.1, "--passes", "0.06,0", "--tab", 2, "--lead-shape", lead]
    run("cut", *words, "-o", part, "--machine", "wire-fanuc")
    run("cut", *words, "-o", tape, "--program", program)
    text = part.read_text()
    theirs, free = offset_paths(text, {"1": 0.16, "2": 0.1})
    ours = shapely.union_all([shapely.LineString(places) for places in stretches(tape.read_bytes(), start_of(program))])
    assert len(theirs) == text.count("G41") + text.count("G42") >= 3
    both = shapely.union_all([*theirs, *free])
    assert apart(both, ours) < LIMIT + 0.0005
    read = run("gcode", "--back", part, "--machine", "wire-fanuc")
    assert says(read.stderr, Phrase("offsets-in-control"))


@pytest.mark.wording
def test_a_program_of_another_hand(run: Run, tmp_path: Path) -> None:
    """Its number and head are its own: what GRBL knows is no matter; the first M60 of a head is no stop."""
    lines = ["%", "O0001", "G90 G21", "G92 X0. Y0.", "M60", "G01 X1. Y0. F5", "M50", "M30", "%"]
    part, plain = tmp_path / "part.nc", run("gcode", "--back", "-", "--machine", "wire-fanuc", stdin="\n".join(lines))
    own = ["%", "O4711", *lines[2:5], "G01 X1. Y0. F5 (" + 70 * "x" + ")", *lines[6:]]
    part.write_text("\n".join(own))
    assert run("check", part, "--machine", "wire-fanuc").exit_code == 0
    assert run("gcode", "--back", part, "--machine", "wire-fanuc").stdout == plain.stdout
    part.write_text("\n".join(["%", "O4711", "G90", *own[3:]]))
    assert run("check", part, "--machine", "wire-fanuc").exit_code == 0
    done = run("check", part, "--machine", "grbl-wire")
    assert done.exit_code == 1 and says(done.stdout, "%") and says(done.stdout, "O")


@pytest.mark.wording
def test_page(tmp_path: Path) -> None:
    for name in ("docs", "examples"):
        (tmp_path / name).symlink_to(ROOT / name)
    examples = list(EXAMPLE.finditer(PAGE.read_text()))
    assert len(examples) >= 3
    for example in examples:
        assert indented(printed(example["command"], tmp_path)) == example["output"], example["command"]
    # the table has all that ship, and the page shows a whole file
    assert set(re.findall(r"^\| `(\w[\w-]*)` \|", PAGE.read_text(), re.M)) == set(names())
    (shown,) = re.findall(r"^```toml\n(.*?)^```", PAGE.read_text(), re.M | re.S)
    assert decoded(shown.encode(), "page").compensation


if __name__ == "__main__":
    PAGE.write_text(
        EXAMPLE.sub(lambda match: f"    $ {match['command']}\n{indented(printed(match['command']))}", PAGE.read_text())
    )
