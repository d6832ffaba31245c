"""Reading, checking and writing of tapes."""

from __future__ import annotations

import json
from math import cos, pi, sin
from pathlib import Path
from random import Random

import pytest
from facthelp import each_says, pattern, says
from hypothesis import given, settings
from hypothesis import strategies as st
from toolhelp import CAD_TAPE, ROOT, Run

from skg import tape as tapes
from skg.errors import UserError
from skg.messages.finding import Phrase
from skg.ref import drift
from skg.ref import tape as ref_tape
from skg.ref.real import Real
from skg.tape import Block, Stop, arc_block, line_block


@st.composite
def blocks(draw: st.DrawFn) -> Block:
    """A sound block of any kind, a few µm to tens of metres long."""
    size = draw(st.sampled_from((10, 300, 50_000, 10_000_000)))
    ordinate = st.integers(-size, size)
    x, y = draw(ordinate), draw(ordinate)
    if (x, y) == (0, 0):
        x = size
    if draw(st.booleans()):
        return line_block(x, y)
    angle = draw(st.floats(0, 2 * pi))
    end = round(x * cos(angle) - y * sin(angle)), round(x * sin(angle) + y * cos(angle))
    return arc_block((x, y), end, draw(st.sampled_from((1, -1))))


@given(st.lists(st.one_of(blocks(), st.builds(Stop, st.just(0)))))
def test_round_trip(items: list[Block | Stop]) -> None:
    data = tapes.to_bytes(items)
    tape, findings = tapes.scan(data)
    stretches: list[list[Block]] = [[]]
    for item in items:
        if isinstance(item, Stop):
            stretches.append([])
        else:
            stretches[-1].append(item)
    cut_off = [blocks for blocks in stretches[1::2] if len(blocks) > 1 or any(not block.is_line for block in blocks)]
    assert len(findings) == bool(cut_off)
    assert [str(item) for item in tape.blocks] == [str(item) for item in items if isinstance(item, Block)]
    assert tapes.to_bytes(tape.items) == data


@given(blocks())
@settings(max_examples=160)
def test_geometry_gives_the_block_again(block: Block) -> None:
    """The end that a block tells makes the same block again."""
    again = line_block(*block.move) if block.is_line else arc_block(block.start, block.end, block.sense)
    assert again == block


def test_too_large_to_write() -> None:
    with pytest.raises(UserError, match=pattern(Phrase("line-number", line=1), Phrase("number-too-long", most=8))):
        tapes.to_bytes([arc_block((30_000_000, 0), (30_000_000, 0), 1)])


def test_cad_tape() -> None:
    tape = tapes.parse(CAD_TAPE)
    moves = [block.move for block in tape.blocks]
    assert moves == [(-9900, 0), (0, 70100), (-55000, 0), (-100200, 0), (-54900, 0)]
    assert tape.blocks[3].start == (50100, 100)


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        (
            "B1B1B1GYL1\r\n",
            [
                Phrase("at-block", block=2, column=1),
                Phrase("expected-found", expected="DD", found=Phrase("end-of-tape")),
            ],
        ),
        (
            "B1B1B1GYL1\r\nDD",
            [
                Phrase("at-block", block=2, column=3),
                Phrase("expected-found", expected="CR LF", found=Phrase("end-of-tape")),
            ],
        ),
        (
            "B1B1B1GYL1\r\nDD\r\nB1",
            [Phrase("at-block", block=1, column=1), Phrase("nothing-after", end="DD", found="'B'")],
        ),
        ("B1B1B1GYL1\nDD\n", [Phrase("at-block", block=1, column=1), Phrase("bare-lf")]),
        (
            "b1B1B1GYL1\r\nDD\r\n",
            [Phrase("at-block", block=1, column=1), Phrase("expected-found", expected="B", found="'b'")],
        ),
        (
            "BB1B1GYL1\r\nDD\r\n",
            [
                Phrase("at-block", block=1, column=2),
                Phrase("expected-found", expected=Phrase("digits-of", name="x"), found="'B'"),
            ],
        ),
        (
            "B1B123456789B1GYL1\r\nDD\r\n",
            [Phrase("at-block", block=1, column=4), Phrase("too-many-digits", name="y", digits=9, most=8)],
        ),
        ("B1B1B01GYL1\r\nDD\r\n", [Phrase("at-block", block=1, column=6), Phrase("leading-zeros", name="J")]),
        (
            "B1B1B1GZL1\r\nDD\r\n",
            [Phrase("at-block", block=1, column=8), Phrase("expected-found", expected=Phrase("x-or-y"), found="'Z'")],
        ),
        (
            "B1B1B1GYL5\r\nDD\r\n",
            [
                Phrase("at-block", block=1, column=9),
                Phrase("expected-found", expected=Phrase("codes-of-blocks"), found="'L'"),
            ],
        ),
        (
            "B1B1B1GYL1 \r\nDD\r\n",
            [
                Phrase("at-block", block=1, column=11),
                Phrase("expected-found", expected=Phrase("end-of-block"), found="' '"),
            ],
        ),
        (
            "B1B1B1GYL1\x07\r\nDD\r\n",
            [
                Phrase("at-block", block=1, column=11),
                Phrase("expected-found", expected=Phrase("end-of-block"), found=Phrase("byte", byte=7)),
            ],
        ),
        (
            "\r\nDD\r\n",
            [
                Phrase("at-block", block=1, column=1),
                Phrase("expected-found", expected="B", found=Phrase("end-of-line")),
            ],
        ),
        ("B0B0B1GYL1\r\nDD\r\n", [Phrase("at-block", block=1, column=1), Phrase("block-nowhere")]),
        (
            "B0B5B5GYL1\r\nDD\r\n",
            [Phrase("at-block", block=1, column=1), Phrase("block-quadrant", word="L1", side="x")],
        ),
        (
            "B5B0B5GXL2\r\nDD\r\n",
            [Phrase("at-block", block=1, column=1), Phrase("block-quadrant", word="L2", side="y")],
        ),
        ("B7B5B6GXL1\r\nDD\r\n", [Phrase("at-block", block=1, column=1), Phrase("line-j-less", j=6, longer=7)]),
        ("B7B5B9GXL1\r\nDD\r\n", [Phrase("at-block", block=1, column=1), Phrase("line-j-more", j=9, longer=7)]),
        ("B7B5B7GYL1\r\nDD\r\n", [Phrase("at-block", block=1, column=1), Phrase("line-axis", axis="Y", expected="X")]),
        ("B5B5B5GXL1\r\nDD\r\n", [Phrase("at-block", block=1, column=1), Phrase("line-axis", axis="X", expected="Y")]),
        ("B5B5B5GYL2\r\nDD\r\n", [Phrase("at-block", block=1, column=1), Phrase("line-axis", axis="Y", expected="X")]),
        (
            "B0B500B9GYNR1\r\nDD\r\n",
            [Phrase("at-block", block=1, column=1), Phrase("block-quadrant", word="NR1", side="x")],
        ),
        (
            "B500B0B9GYSR1\r\nDD\r\n",
            [Phrase("at-block", block=1, column=1), Phrase("block-quadrant", word="SR1", side="y")],
        ),
        ("B500B0B0GYNR1\r\nDD\r\n", [Phrase("at-block", block=1, column=1), Phrase("arc-j-zero")]),
        (
            "B500B0B2005GYNR1\r\nDD\r\n",
            [Phrase("at-block", block=1, column=1), Phrase("arc-j-beyond", j=2005, full=2000)],
        ),
        (
            "B500B0B490GYNR1\r\nDD\r\n",
            [Phrase("at-block", block=1, column=1), Phrase("arc-axis", j=490, end=490, side="y", expected="X")],
        ),
    ],
)
def test_findings(run: Run, text: str, facts: list[str]) -> None:
    result = run("check", "-", stdin=text.encode("latin-1"))
    assert result.exit_code == 1
    assert says(result.output, f"-: {facts[0]}: ", *facts)
    found = json.loads(run("check", "--json", "-", stdin=text.encode("latin-1")).output)
    place = Phrase("at-block", block=found[0]["block"], column=found[0]["column"])
    assert f"{place}: {found[0]['message']}" in result.output


def test_all_findings_at_once(run: Run) -> None:
    result = run("check", "-", stdin=b"B1B2B9GXL1\r\nB0B5B5GYL1\r\nhello\r\nB5B0B5GXL1\r\n")
    assert len(result.output.splitlines()) == 5


def test_sound_tapes_pass(run: Run, cad_tape: Path) -> None:
    result = run("check", cad_tape, cad_tape)
    assert result.exit_code == 0
    assert each_says(
        result.output, *[(f"{cad_tape}: ", Phrase("nothing-wrong", size=Phrase("count-blocks", count=5)))] * 2
    )
    assert run("check", "-", stdin=b"\0\0\0" + CAD_TAPE + b"\0\0").exit_code == 0


def filled(data: bytes) -> bytes:
    """A file as CP/M has it: ctrl-Zs up to the end of the last record, one at least."""
    return data.ljust((len(data) // 128 + 1) * 128, b"\x1a")


def test_ctrl_zs_of_cpm_are_no_finding(run: Run) -> None:
    """They are the file's end, and said as a note; what stands behind them is not."""
    result = run("check", "-", stdin=filled(CAD_TAPE))
    assert result.exit_code == 0 and each_says(
        result.stdout, ("-: ", Phrase("nothing-wrong"), Phrase("count-blocks", count=5))
    )
    assert each_says(result.stderr, ("skg: -: ", Phrase("ctrl-zs")))
    assert run("check", "-", stdin=CAD_TAPE[:-4] + b"\x1a" * 30).exit_code == 1
    result = run("check", "-", stdin=CAD_TAPE + b"\x1a\x1aB1")
    assert says(result.stdout, Phrase("nothing-after", end="DD", found=Phrase("byte", byte=0x1A)))


@pytest.mark.parametrize("words", [
    "sim cad-tape.3b", "tape cad-tape.3b", "gcode cad-tape.3b", "plot -o - cad-tape.3b",
    "check mill/plate.nc", "sim mill/plate.nc", "gcode --back mill/rosette.nc", "run xy-star.skg", "ref xy-star.skg",
    "sim xy-star.skg", "xy xy-gear.xy", "tekhtran tkh-maltese.tkh",
    "run tkh-maltese.tkh", "check xy-gear.xy",
])  # fmt: skip
def test_every_reader_takes_files_of_cpm(run: Run, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    command = words.split()
    own, other = (tmp_path / name / Path(command[-1]).name for name in ("own", "other"))
    results = []
    for path in (own, other):
        path.parent.mkdir()
        data = (ROOT / "examples" / command[-1]).read_bytes()
        path.write_bytes(data if path == own else filled(data))
        monkeypatch.chdir(path.parent)
        results.append(run(*command[:-1], path.name))
    assert results[0].exit_code == results[1].exit_code == 0
    assert results[0].stdout == results[1].stdout != ""


@given(st.binary(max_size=60))
def test_any_bytes(data: bytes) -> None:
    for text in (data, CAD_TAPE[:20] + data):
        try:
            tapes.parse(text)
        except UserError as error:
            assert "\n" not in str(error)


def any_arc(rng: Random) -> tuple[tuple[int, int], tuple[int, int], bool, float]:
    """Start and end about a rounded centre, clockwise or not, the true sweep: arcs of 1 um to 30 mm radius."""
    radius, angle, sweep = 10 ** rng.uniform(0, 4.5), rng.uniform(0, 2 * pi), rng.choice([1, 2 * pi]) * rng.random()
    x, y, clockwise = rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5), rng.random() < 0.5
    ends = [angle, angle - sweep if clockwise else angle + sweep]
    start, end = ((round(x + radius * cos(a)), round(y + radius * sin(a))) for a in ends)
    return start, end, clockwise, sweep


def test_any_arc_of_the_reference_is_sound() -> None:
    """On the standard tape from rounded places, on one without drift from up to a micrometre beside them."""
    rng, count = Random("sound"), 0
    for _ in range(6_000):
        (x, y), end, clockwise, sweep = any_arc(rng)
        start = x + rng.choice([-1, 0, 0, 1]), y + rng.choice([-1, 0, 0, 1])
        made = [ref_tape.arc_block((x, y), end, clockwise, Real(sweep)) if (x, y) != end else None]
        without_drift = drift.arc(start, end, clockwise, sweep > pi) if start != end else None
        made += [without_drift[0]] if without_drift else []
        for text in filter(None, made):
            (block,) = tapes.scan(f"{text}\r\nDD\r\n".encode())[0].blocks
            assert not block.problems(), (text, start, end, sweep)
            # It goes round once at most, but for what rounding adds.
            assert abs(block.sweep) <= 2 * pi + 4 / max(1, block.radius)
            count += 1
    assert count > 6_000


def test_an_arc_of_a_little_more_than_a_full_circle() -> None:
    """Its rounded end lies just behind its start: once round, and a micrometre."""
    (block,) = tapes.parse(b"B1000B7B4001GYNR1\r\nDD\r\n").blocks
    assert block.move == (0, 1)
    assert block.sweep == pytest.approx(2 * pi + 0.001, abs=1e-4)
