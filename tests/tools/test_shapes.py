"""`skg gear` and `skg cam`: the wire's path against the exact curves, which are worked out here in another way."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import acos, atan2, cos, degrees, hypot, pi, radians, sin, sqrt, tan
from pathlib import Path

import pytest
from facthelp import pattern, says
from oneblock import run_block
from toolhelp import Run

from skg import tape as tapes
from skg.board.board import ErrorLine
from skg.board.feeding import MEMORY_FULL, Fed, feed
from skg.cutting import ladder
from skg.errors import UserError
from skg.geometry.plane import XY
from skg.messages.finding import Phrase
from skg.ref import run as reference
from skg.tape.block import Block

#: What a fitted curve's tape may be off the exact one, mm: its blocks' ends, their centres, and FIT.
LIMIT = 0.002


def wire(tape: Path, program: str) -> Iterator[XY]:
    """Places along the blocks of a tape without drift, mm; not of the ways from and to the start holes."""
    x, y = program.split("FROM (")[1].split(")")[0].split(",")
    at = float(x) * 1000, float(y) * 1000
    for blocks in tapes.read(str(tape)).stretches():
        for number, block in enumerate(blocks):
            if 0 < number < len(blocks) - 1:
                yield from places_of(block, at)
            dx, dy = run_block(block).move
            at = at[0] + dx, at[1] + dy


def places_of(block: Block, at: XY) -> Iterator[XY]:
    """Places along a block that starts at a place (µm), mm."""
    (dx, dy), start, count = run_block(block).move, block.start, 8 + int(block.length / 200)
    for k in range(count + 1):
        if block.is_line:
            yield (at[0] + dx * k / count) / 1000, (at[1] + dy * k / count) / 1000
        else:
            turn = block.sweep * k / count
            u = start[0] * cos(turn) - start[1] * sin(turn) + at[0] - start[0]
            v = start[0] * sin(turn) + start[1] * cos(turn) + at[1] - start[1]
            yield u / 1000, v / 1000


@pytest.mark.parametrize(
    ("module", "teeth", "angle", "shift"),
    [(2, 20, 20, 0), (1, 45, 20, 0), (3, 9, 20, 0.5), (0.5, 30, 14.5, -0.1), (0.3, 120, 20, 0), (5, 60, 25, 0)],
)
def test_gear(run: Run, tmp_path: Path, module: float, teeth: int, angle: float, shift: float) -> None:
    """Every place of the wire on the flanks of all teeth is on the involute that the tooth's thickness at the pitch
    circle gives."""
    words = ["--module", module, "--teeth", teeth, "--pressure-angle", angle, "--shift", shift]
    result = run("gear", *words, "--tape", tmp_path / "gear.3b")
    assert result.exit_code == 0
    r, alpha = module * teeth / 2, radians(angle)
    base, tip, root = r * cos(alpha), r + module * (1 + shift), r - module * (1.25 - shift)
    # Half of a tooth at the base circle, from its thickness at the pitch circle: pi m / 2 + 2 x m tan a.
    half = (pi * module / 2 + 2 * shift * module * tan(alpha)) / (2 * r) + tan(alpha) - alpha
    flanks, seen, worst = 0, set(), 0.0
    for x, y in list(wire(tmp_path / "gear.3b", result.stdout)):
        radius, turned = hypot(x, y), atan2(y, x) % (2 * pi / teeth)
        assert root - LIMIT < radius < tip + LIMIT
        beside = min(turned, 2 * pi / teeth - turned)
        if max(base, root + 0.25 * module) < radius < tip - 0.01 * module:
            roll = sqrt((radius / base) ** 2 - 1)
            exact = half - (roll - acos(base / radius))
            worst = max(worst, base * abs(beside - exact))
            flanks += 1
            seen.add(int(atan2(y, x) % (2 * pi) / (2 * pi / teeth)))
    assert flanks > 8 * teeth and len(seen) == teeth
    assert 0 < worst < LIMIT


@pytest.mark.parametrize(
    ("words", "offset"),
    [
        (["--module", 2, "--teeth", 9], 0.1),
        (["--module", 2, "--teeth", 20, "--bore", 12, "--keyway", 4, 13.8], 0.1),
        (["--module", 0.3, "--teeth", 120], 0),
        (["--module", 0.5, "--teeth", 30, "--pressure-angle", 14.5, "--shift", -0.1], 0),
        (["--module", 1, "--teeth", 17, "--fillet", 0], 0.1),
    ],
)
def test_a_gear_is_one_tooth(run: Run, tmp_path: Path, words: list[object], offset: float) -> None:
    """The program has one tooth and REP: a board of 4 KiB stores it. The tape is the reference's, and it closes."""
    teeth = words[3]
    result = run("gear", *words, "--offset", offset, "--tape", tmp_path / "gear.3b")
    assert says(result.stderr, Phrase("made-stored", ram=8))
    program = result.stdout
    assert program.count(f"REP {teeth},360/{teeth}\n") == 1
    assert sum(line.split()[1:2] == ["GOSUB"] for line in program.splitlines()) == 2  # (the flanks of one tooth)
    assert reference(program, drift=False).tape == (tmp_path / "gear.3b").read_bytes()
    assert feed(program, "no-drift", 4).tape == (tmp_path / "gear.3b").read_bytes()
    outline = tapes.read(str(tmp_path / "gear.3b")).stretches()[-1]
    assert [sum(way) for way in zip(*(run_block(block).move for block in outline), strict=True)] == [0, 0]


def test_a_gear_tooth_by_tooth(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """With a tab, and where the board has no room for REP, every tooth is in the program, and the tape is right."""
    words = ["--module", 1, "--teeth", 12, "--offset", 0.1]
    by_tooth = run("gear", *words, "--tab", 1)
    assert "REP" not in by_tooth.stdout and "HOLD THE PART" in by_tooth.stdout

    def small(text: str, rom: str, ram_kib: int) -> Fed:
        """A board that has no room for a route: as the ROM says it."""
        fed = feed(text, rom, ram_kib)
        return replace(fed, error=ErrorLine(MEMORY_FULL, None)) if "REP" in text else fed

    def small_one_by_one(routes: list[str], rom: str, ram_kib: int, _told: object) -> Fed:
        return small("".join(routes), rom, ram_kib)

    monkeypatch.setattr(ladder, "feed", small)
    monkeypatch.setattr(ladder, "feed_routes", small_one_by_one)
    again = run("gear", *words)
    assert "REP" not in again.stdout and again.stdout.count("CUT") > 12
    assert says(again.stderr, Phrase("checked"), Phrase("closing", count=1))


def test_gear_with_a_keyway(run: Run, tmp_path: Path) -> None:
    """The bore and its keyway are cut first, inside by R; the outline outside."""
    words = ["--module", 2, "--teeth", 20, "--bore", 12, "--keyway", 4, 13.8, "--offset", 0.1]
    result = run("gear", *words, "--tape", tmp_path / "gear.3b", "-o", tmp_path / "gear.skg")
    kinds = (Phrase("count-opening", count=1), Phrase("count-outline", count=1))
    assert says(result.stderr, Phrase("order-of-cutting", kinds=kinds))
    bore, outline = result_places(tmp_path)
    assert max(y for _, y in bore) == pytest.approx(13.8 - 6 - 0.1, abs=LIMIT)
    assert max(x for x, _ in bore) == pytest.approx(5.9, abs=LIMIT)
    assert max(hypot(x, y) for x, y in outline) == pytest.approx(22.1, abs=LIMIT)


def result_places(folder: Path) -> tuple[list[XY], list[XY]]:
    """The places of the wire in the bore, and around the teeth."""
    places = list(wire(folder / "gear.3b", (folder / "gear.skg").read_text()))
    return [p for p in places if hypot(*p) < 10], [p for p in places if hypot(*p) > 16]


@pytest.mark.parametrize("law", ["harmonic", "cycloidal", "polynomial"])
@pytest.mark.parametrize("roller", [0, 10])
def test_cam(run: Run, tmp_path: Path, law: str, roller: float) -> None:
    """A roller on every place of the profile never dips below the law's lift, and everywhere comes down to it."""
    base, lift, rise, dwell, fall = 25.0, 6.0, 110.0, 40.0, 90.0
    words = ["--base", base, "--lift", lift, "--rise", rise, "--dwell", dwell, "--fall", fall, "--law", law]
    result = run("cam", *words, "--roller", roller, "--tape", tmp_path / "cam.3b")
    places = list(wire(tmp_path / "cam.3b", result.stdout))
    shapes = {
        "harmonic": lambda t: (1 - cos(pi * t)) / 2,
        "cycloidal": lambda t: t - sin(2 * pi * t) / (2 * pi),
        "polynomial": lambda t: 10 * t**3 - 15 * t**4 + 6 * t**5,
    }

    def lifted(turn: float) -> float:
        if turn <= rise:
            return lift * shapes[law](turn / rise)
        if turn <= rise + dwell:
            return lift
        back = (rise + dwell + fall - turn) / fall
        return lift * shapes[law](back) if back > 0 else 0.0

    if not roller:
        off = [abs(hypot(x, y) - base - lifted(degrees(atan2(y, x)) % 360)) for x, y in places]
        assert max(off) < LIMIT
        return
    for turn in range(3, 360, 12):
        # The roller comes down along its line until it touches a place of the profile.
        way, most = radians(turn), 0.0
        for x, y in places:
            along, aside = x * cos(way) + y * sin(way), y * cos(way) - x * sin(way)
            if abs(aside) < roller / 2 and along > 0:
                most = max(most, along + sqrt(roller**2 / 4 - aside**2))
        assert most == pytest.approx(base + roller / 2 + lifted(turn), abs=0.006)


@pytest.mark.parametrize(
    ("words", "fact"),
    [
        (["gear", "--module", 2, "--teeth", 8, "--shift", 1], Phrase("gear-pointed")),
        (["gear", "--module", 1000, "--teeth", 1000], Phrase("gear-too-large", radius=501)),
        (["gear", "--module", 2, "--teeth", 20, "--bore", 40], Phrase("gear-bore", reach=20)),
        (["gear", "--module", 2, "--teeth", 20, "--fillet", 1], Phrase("gear-fillet")),
        (["gear", "--module", 1, "--teeth", 20, "--offset", 1.2], Phrase("shape-too-narrow", offset=1.2)),
        (["cam", "--base", 4, "--lift", 12, "--rise", 40, "--roller", 20, "--law", "harmonic"], Phrase("cam-undercut")),
        (
            ["cam", "--base", 5, "--lift", 2, "--rise", 300, "--dwell", 10, "--fall", 60],
            Phrase("cam-over-a-turn", degrees=370),
        ),
    ],
)
def test_what_cannot_be_cut(run: Run, words: list[object], fact: Phrase) -> None:
    with pytest.raises(UserError, match=pattern(fact)):
        run(*words)
