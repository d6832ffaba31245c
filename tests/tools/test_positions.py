"""With or without drift: the name of a tape says it, or the option; else it is with drift, and that is said."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from facthelp import each_says, says
from toolhelp import ROOT, Run

from skg import tape as tapes
from skg.board.feeding import feed
from skg.messages.finding import Phrase
from skg.messages.severity import Severity
from skg.ref import run as reference
from skg.tape.layout import place
from skg.tape.positions import decide

EXAMPLES = sorted((ROOT / "examples").glob("*.skg"))


def both_tapes(part: Path) -> tuple[bytes, bytes]:
    """The standard tape of an example, and the one without drift."""
    return part.with_suffix(".3b").read_bytes(), reference(part.read_text(), drift=False).tape


def test_taken_as_with_drift() -> None:
    """A tape that does not tell is taken as with drift; that is said where it is not the same without."""
    said = 0
    for part in EXAMPLES:
        tape = tapes.parse(both_tapes(part)[0])
        layouts = [
            [(one.start, one.end) for route in place(tape, (0, 0), name) for one in route.blocks]
            for name in ("programmed", "machine")
        ]
        decision = decide(tape)
        assert decision.positions == "programmed"
        assert bool(decision.why) == (layouts[0] != layouts[1]), part.stem
        said += bool(decision.why)
    assert 20 < said < len(EXAMPLES)


@pytest.fixture
def belts(tmp_path: Path) -> tuple[Path, Path]:
    """A part's two tapes as files whose names do not tell which is which."""
    paths = tmp_path / "one.3b", tmp_path / "other.3b"
    for path, tape in zip(paths, both_tapes(ROOT / "examples" / "skg06-belts.skg"), strict=True):
        path.write_bytes(tape)
    return paths


@pytest.mark.parametrize(("command", "more"), [("sim", []), ("plot", ["-o"]), ("dxf", ["-o"])])
def test_what_is_taken_is_said(run: Run, belts: tuple[Path, Path], command: str, more: list[str]) -> None:
    """In one line on standard error, with the option that says otherwise, and nothing where that is given."""
    output = [*more, belts[0].with_suffix(".svg" if command == "plot" else ".out")] if more else []
    for path in belts:
        result = run(command, path, *output)
        assert result.exit_code == 0
        assert each_says(result.stderr, (f"skg: {path}: ", Phrase("taken-with-drift", ending=".nodrift.3b")))
        for positions in ("programmed", "machine"):
            assert run(command, path, *output, "--positions", positions).stderr == ""


def test_check_goes_by_it(run: Run) -> None:
    """A full circle counts four radii, or four times where the controller turns; unless told, either is right."""
    for tape, right, expected in (("B100B15B404GXNR1", "programmed", 404), ("B100B15B408GXNR1", "machine", 408)):
        for positions in ("auto", "programmed", "machine"):
            result = run("check", "-", "--positions", positions, stdin=f"{tape}\r\nDD\r\n")
            assert (result.exit_code == 0) == (positions in ("auto", right)), result.stdout
            if result.exit_code:
                assert says(result.stdout, Phrase("arc-j-other-count", j=expected))


def test_name_says_it(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "ratchet.nodrift.3b"
    path.write_bytes((ROOT / "examples" / "ratchet.3b").read_bytes())
    result = run("sim", "--json", path)
    assert json.loads(result.stdout)[0]["positions"] == "machine"
    assert each_says(result.stderr, (f"skg: {path}: ", Phrase("without-drift", by=Phrase("its-name"))))


def test_program_needs_no_word(run: Run) -> None:
    result = run("sim", "--json", ROOT / "examples" / "skg06-belts.skg")
    assert json.loads(result.stdout)[0]["positions"] == "programmed"
    assert result.stderr == ""


def test_a_name_that_gets_lost(run: Run, tmp_path: Path) -> None:
    path, other = tmp_path / "a.nodrift.3b", tmp_path / "b.3b"
    path.write_bytes((ROOT / "examples" / "ratchet.3b").read_bytes())
    assert says(run("tape", path, "-o", other).stderr, Phrase("drift-in-name"), other.name)
    for output in (tmp_path / "b.nodrift.3b", "-"):
        assert run("tape", path, "-o", output).stderr == ""


def test_cut_says_when_the_name_does_not_tell() -> None:
    from skg.commands.options import unmarked

    for name in ("skg06-tangent-slot", "skg06-belts"):
        tape = tapes.parse(feed((ROOT / "examples" / f"{name}.skg").read_text(), "no-drift").tape)
        assert unmarked("slot.3b", tape, "no-drift")[0]["ending"] == ".nodrift.3b"
        assert unmarked("slot.NoDrift.3b", tape, "no-drift") == unmarked("slot.3b", tape, "standard") == []
        assert unmarked("slot.nodrift.3b", tape, "standard")[0].severity is Severity.CARE
    lines = tapes.parse(feed((ROOT / "examples" / "xy-star.skg").read_text(), "no-drift").tape)
    assert unmarked("star.3b", lines, "no-drift") == []
