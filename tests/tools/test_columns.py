"""Many blocks at once: the same as one by one, with little work for each."""

from __future__ import annotations

import sys
import tracemalloc
from dataclasses import replace
from itertools import accumulate
from math import atan2, pi, sqrt

import numpy as np
import pytest
from facthelp import pattern
from hypothesis import example, given
from hypothesis import strategies as st
from oneblock import run_block
from test_tape import blocks
from toolhelp import CAD_TAPE

from skg import tape as tapes
from skg.errors import UserError
from skg.geometry.plane import XY, minus
from skg.messages.finding import Phrase
from skg.tape import Block, Stop, Tape, arc_block, line_block
from skg.tape.block import CODES
from skg.tape.block_list import Blocks
from skg.tape.columns import Columns, columns_of
from skg.tape.layout import Laid, Placed, place, stop_places
from skg.tape.moves import machine_moves, walk
from skg.tape.simulation import simulate

#: Lines, arcs about an axis and a circle that come back to where they begin.
TURN = "B343B706B706GYL1\r\nB0B343B343GYSR1\r\nB343B706B706GYL3\r\nB343B0B343GXL3\r\nB200B0B800GYNR1\r\n"


def on_circle(block: Block) -> tuple[float, float]:
    """A block's end, moved across its count axis onto the circle about the origin."""
    along, beside = block.end[1 - block.across], block.end[block.across]
    moved = sqrt(max(0, block.x**2 + block.y**2 - along**2)) * (1 if beside >= 0 else -1)
    return (moved, along) if block.across == 0 else (along, moved)


def placed_between(block: Block, start: XY, end: XY) -> Placed:
    """A block from a start to an end, its sweep corrected by what these lie away from its own."""
    if block.is_line:
        return Placed(start, end, block=block)
    centre = minus(start, block.start)
    sweep = block.sweep
    if not block.is_full_circle:
        first, last = (atan2(y - centre[1], x - centre[0]) for x, y in (start, end))
        sweep += (last - first - sweep + pi) % (2 * pi) - pi
    return Placed(start, end, centre, sweep, block=block)


@given(st.lists(blocks(), min_size=1, max_size=8))
@example([arc_block((2 * 10**9, 3), (-7, 2 * 10**9), 1), line_block(10**11, -5)])
@example(
    [
        arc_block((5, 0), (5, 0), -1),
        arc_block((1, 1), (-1, 1), 1),
        Block(30, 0, 121, "Y", "NR1"),
    ]
)
def test_columns_say_what_blocks_say(several: list[Block]) -> None:
    columns = Columns.of(several)
    assert columns.starts.tolist() == [list(block.start) for block in several]
    assert columns.ends.tolist() == [list(block.end) for block in several]
    assert columns.moves.tolist() == [list(block.move) for block in several]
    assert columns.sweeps.tolist() == [block.sweep for block in several]
    assert columns.lengths.tolist() == [block.length for block in several]
    assert columns.radii.tolist() == [block.radius for block in several]
    assert columns.turns.tolist() == [block.turn for block in several]
    assert columns.is_full_circle.tolist() == [block.is_full_circle for block in several]
    assert columns.on_circles(columns.ends).tolist() == [list(on_circle(block)) for block in several]
    assert columns[1:].ends.tolist() == columns.ends[1:].tolist()


@given(st.lists(blocks(), max_size=8), st.slices(8), st.slices(4))
def test_packed_blocks_are_the_blocks(several: list[Block], part: slice, of_it: slice) -> None:
    """Whole, in part and joined; their columns too, and their numbers."""
    several = [replace(block, number=at) for at, block in enumerate(several, 5)]
    packed, numbers = Blocks.of(several), [block.number for block in several]
    joined = Blocks.joined([packed[part], packed])
    for one, wanted in (
        (packed, several), (packed[part], several[part]), (packed[part][of_it], several[part][of_it]),
        (joined, several[part] + several),
    ):  # fmt: skip
        assert list(one) == wanted == [one[at] for at in range(len(one))]
        assert Columns.of(one).moves.tolist() == Columns.of(wanted).moves.tolist()
        assert Columns.of(one).turns.tolist() == Columns.of(wanted).turns.tolist()
    assert [block.number for block in packed] == numbers and [block.number for block in packed[part]] == numbers[part]


def test_a_block_of_a_tape_takes_little_room() -> None:
    """A million blocks, each a `Block`, took 300 megabytes."""
    data = f"{TURN * 2000}DD\r\n".encode()
    tracemalloc.start()
    tape = tapes.parse(data)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert len(tape.blocks) == 10_000 and peak < 40 * 10_000 + len(data)


def turns(count: int) -> Tape:
    return tapes.parse(f"{TURN * count}DD\r\n".encode())


@pytest.mark.parametrize("together", [10_000, 2])
def test_followed_together_as_one_by_one(together: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each block has the drift that those before it have left, or none: some at once, or all."""
    monkeypatch.setattr("skg.tape.moves._CHUNK", together)
    tape, drift = tapes.parse(CAD_TAPE), (0, 0)
    should = columns_of(tape).moves
    found = walk(tape, range(len(should)), should)
    assert machine_moves(tape).tolist() == [list(run_block(block).move) for block in tape.blocks]
    for at, block in enumerate(tape.blocks):
        outcome = run_block(block, drift)
        assert tuple(found.moves[at]) == outcome.move and found.steps[at] == outcome.steps
        assert (found.off_curve[at], found.off_path[at]) == pytest.approx(
            (outcome.off_curve, outcome.off_path), abs=1e-9
        )
        drift = (
            drift[0] + outcome.move[0] - block.move[0],
            drift[1] + outcome.move[1] - block.move[1],
        )
    assert drift != (0, 0)


def test_blocks_that_are_alike_are_followed_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Equal blocks are followed once, if none waits for the one before it; outcome and progress stay the same."""
    asked = []
    monkeypatch.setattr("skg.tape.moves._parts", lambda steps: asked.append(len(steps)) or iter([slice(0, len(steps))]))
    mixed = [tapes.parse(CAD_TAPE).blocks[at] for at in (3, 0, 3, 1, 2, 0)] + list(turns(2).blocks)
    rows, steps = np.array([7, 0, 2, 5, 1, 3, 4, 6, 10, 12]), []
    found = walk(Tape.of("-", mixed), rows, None, steps.append)
    outcomes = [run_block(mixed[at]) for at in rows.tolist()]
    assert found.moves.tolist() == [list(one.move) for one in outcomes]
    assert found.steps.tolist() == [one.steps for one in outcomes] and sum(steps) == sum(found.steps)
    assert found.off_curve.tolist() == pytest.approx([one.off_curve for one in outcomes], abs=1e-9)
    assert asked == [len({(block.x, block.y, block.j, block.axis, block.code) for block in (mixed[at] for at in rows)})]
    assert asked[0] < len(rows)


def test_a_block_that_never_ends_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    items = [line_block(5, 5), Stop(1), Block(1, 0, 4, "Y", "NR1", 2)]
    with pytest.raises(UserError, match=pattern(Phrase("never-ends", number=2, block="B1B0B4GYNR1"))):
        simulate(Tape.of("-", items, drift=False))
    monkeypatch.setattr("skg.tape.moves._CHUNK", 1)
    with pytest.raises(UserError, match=pattern(Phrase("never-ends", number=2, block="B1B0B4GYNR1"))):
        walk(Tape.of("-", items), np.array([0, 1]))


def test_laid_as_placed() -> None:
    """A tape laid out gives the same places as its blocks one after the other, from both sides."""
    tape = turns(3)
    (route,) = place(tape, (7, -3), "programmed")
    moves = [(one.end[0] - one.start[0], one.end[1] - one.start[1]) for one in route.blocks]
    ends = list(accumulate(moves, lambda at, move: (at[0] + move[0], at[1] + move[1]), initial=(7, -3)))
    placed = [placed_between(*one) for one in zip(tape.blocks, ends, ends[1:], strict=False)]
    assert list(route.blocks) == placed and route.blocks[-2] == placed[-2] and list(route.blocks[4:6]) == placed[4:6]
    extremes = [place for one in placed for place in one.extremes()]
    (left, low), (right, high) = Laid.of(placed).extents()
    assert (left, right) == pytest.approx((min(x for x, _ in extremes), max(x for x, _ in extremes)))
    assert (low, high) == pytest.approx((min(y for _, y in extremes), max(y for _, y in extremes)))


def test_stops_where_nothing_is_between() -> None:
    tape = tapes.parse(b"D\r\nB5B0B5GXL1\r\nD\r\nD\r\nB0B5B5GYL2\r\nD\r\nDD\r\n")
    assert stop_places(tape, place(tape, (1, 1)), (1, 1)) == [(1, 1), (6, 1), (6, 6)]


def calls_for(tape: Tape) -> int:
    """Counts the function calls to find a tape's block starts, to lay it out and to follow it."""
    calls = 0

    def count(frame: object, event: str, argument: object) -> None:
        nonlocal calls
        calls += event in ("call", "c_call")

    sys.setprofile(count)
    try:
        place(tape)
        simulate(tape)
    finally:
        sys.setprofile(None)
    return calls


def test_work_for_each_block() -> None:
    """A million blocks: block by block it was 214 calls for each of these, and minutes."""
    few, many = calls_for(turns(20)), calls_for(turns(2020))
    assert (many - few) / 10_000 < 4


@given(st.lists(st.builds(Block, *[st.integers(0, 30)] * 2, st.integers(0, 150), st.sampled_from("XY"),
                          st.sampled_from(CODES)), min_size=1), st.lists(blocks(), max_size=5))  # fmt: skip
def test_what_is_plainly_sound_is_sound(any_: list[Block], sound: list[Block]) -> None:
    """On any block: nothing that is wrong is ignored; and of sound ones it is most."""
    plainly = Columns.of([*any_, *sound]).is_plainly_sound.tolist()
    for block, is_sound in zip([*any_, *sound], plainly, strict=True):
        assert not (is_sound and (block.problems() or block.problems("programmed"))), block
        assert is_sound or block.problems() or not block.is_line, block
    assert all(Columns.of([one for one in sound if not one.is_full_circle]).is_plainly_sound)


def test_a_long_tape_has_the_findings_of_a_short_one() -> None:
    wrong = "B343B706B707GYL1\r\nB1B1GXL1\r\nB100B0B401GYNR1\r\nB5B5B5GXL1\n"
    short, long = (tapes.scan(f"{TURN * count}{wrong}DDx\r\n".encode())[1] for count in (1, 5000))
    moved = [(one.block + 5 * 4999, one.column, one.why) for one in short]
    assert len(short) > 5 and moved == [(one.block, one.column, one.why) for one in long]
