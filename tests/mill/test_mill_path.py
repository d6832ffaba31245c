"""The path of every part in examples/ is the same on wire and mill: vertex by vertex the same whole micrometres."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import pytest
from isohelp import blocks, moves

from skg.ref import Result, mill
from skg.ref.interpreter import Interpreter, carry_out
from skg.ref.tape import Grid, Punch
from skg.ref.values import Point

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.skg"))
CUTTING, TRAVEL = -2500, 4000


@dataclass
class Recording(Punch):
    """The wire's punch, which notes in a list where it is after each line of the tape."""

    places: list[Grid] = field(default_factory=list)
    begins: list[Grid] = field(default_factory=list)

    def place(self, p: Point) -> None:
        """Taken to be there without a block."""
        super().place(p)
        if not self.lines:
            self.begins.append(self.position)

    def _note(self) -> None:
        self.places += [self.position] * (len(self.lines) - len(self.places))

    def line(self, end: Point) -> None:
        """A straight move."""
        super().line(end)
        self._note()

    def arc(self, *arguments: object) -> None:
        """An arc."""
        super().arc(*arguments)
        self._note()

    def stop(self) -> None:
        """A `D`."""
        super().stop()
        self._note()


def wire(source: str) -> tuple[Result, list[list[Grid]]]:
    """The result, and the vertices of each route with the place where it begins: between two `D` the wire moves."""
    punch = Recording()
    result = carry_out(lambda watch: Interpreter((), watch, punch), source, None)
    routes, is_move, at = [[punch.begins[-1]]], False, punch.begins[-1]
    for line, place in zip(punch.lines, punch.places, strict=False):
        if line == "D":
            is_move = not is_move
            if not is_move:
                routes.append([at])
        elif is_move:
            at = place
        else:
            routes[-1].append(place)
            at = place
    return result, [route for route in routes if len(route) > 1]


def milled(result: Result) -> list[list[Grid]]:
    """The same of an ISO tape: what is cut between two rapids in the plane, at the cutting height alone."""
    routes, at = [], None
    for move in moves(result.tape):
        if move.g == 0 and move.place == at:  # up or down
            continue
        if move.g == 0:
            routes.append([move.place])
        elif move.place != at or move.centre:
            assert move.end[2] == CUTTING
            routes[-1].append(move.place)
        at = move.place
    return [route for route in routes if len(route) > 1]


def with_mill(source: str) -> str:
    """The program with F and Z in front."""
    return f"1 F 250,80\n2 Z {CUTTING / 1000},{TRAVEL / 1000}\n{source}"


def check_heights(result: Result) -> None:
    """Cuts at the cutting height, rapids at the travel height; down and up as often."""
    heights = []
    for move in moves(result.tape):
        z = move.end[2]
        assert z == (CUTTING if move.g else TRAVEL)
        if not heights or heights[-1] != z:
            heights.append(z)
    assert heights == [TRAVEL, CUTTING] * (len(heights) // 2) + [TRAVEL]


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_same_vertices(path: Path) -> None:
    source, tape = path.read_text(), path.with_suffix(".3b").read_bytes()
    wired, routes = wire(source)
    assert (wired.error, wired.tape) == (None, tape)
    result = mill.run(with_mill(source))
    assert result.error is None
    assert result.paper == wired.paper
    assert milled(result) == routes
    assert routes
    assert blocks(result.tape)[-1] == "M30"
    check_heights(result)


#: The parts that are soon cut.
SMALL = [path for path in EXAMPLES if path.with_suffix(".3b").read_bytes().count(b"B") < 100]


@pytest.mark.parametrize("offset", ["0.04", "-0.04"])
@pytest.mark.parametrize("path", SMALL, ids=lambda path: path.stem)
def test_same_vertices_beside_the_contour(path: Path, offset: str) -> None:
    """With another R in front, which some programs set again and some contours have no room for."""
    source = f"3 R={offset}\n{path.read_text()}"
    wired, routes = wire(source)
    result = mill.run(with_mill(source))
    assert (result.error, result.paper) == (wired.error, wired.paper)
    assert milled(result) == routes
    assert blocks(result.tape)[-1] == ("M30" if wired.error is None else "M0")


def test_offsets_are_tried_where_there_is_room() -> None:
    whole = [path for path in SMALL if wire(f"3 R=0.04\n{path.read_text()}")[0].error is None]
    assert len(whole) >= 20
