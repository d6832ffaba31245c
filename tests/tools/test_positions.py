"""With or without drift: a tape says it, or it is found out and said; one decision for the whole tape."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from toolhelp import ROOT, Run

from skg import tape as tapes
from skg.machine.feeding import feed
from skg.ref import run as reference
from skg.tape.layout import place
from skg.tape.positions import decide

EXAMPLES = sorted((ROOT / "examples").glob("*.skg"))


def both_tapes(part: Path) -> tuple[bytes, bytes]:
    """The standard tape of an example, and the one without drift."""
    return part.with_suffix(".3b").read_bytes(), reference(part.read_text(), drift=False).tape


@pytest.mark.parametrize("positions", ["programmed", "machine"])
def test_found_out(positions: str) -> None:
    """Of all examples whose two tapes differ: a tape with drift is always taken for one, one without drift is not where
    a symmetrical part closes either way, and then it is said that this is not certain.
    """
    right = doubtful = 0
    for part in EXAMPLES:
        made = both_tapes(part)
        tape = tapes.parse(made[positions == "machine"])
        layouts = [
            [(one.start, one.end) for route in place(tape, (0, 0), name) for one in route.blocks]
            for name in ("programmed", "machine")
        ]
        decision = decide(tape)
        if made[0] == made[1] or layouts[0] == layouts[1]:
            assert not decision.why, part.stem
        elif decision.positions == positions:
            right += 1
        else:
            assert positions == "machine" and "not certain" in decision.why, part.stem
            doubtful += 1
    assert right > 2 * doubtful and right + doubtful > 20


@pytest.fixture
def belts(tmp_path: Path) -> tuple[Path, Path]:
    """A part's two tapes as files whose names do not tell which is which."""
    paths = tmp_path / "one.3b", tmp_path / "other.3b"
    for path, tape in zip(paths, both_tapes(ROOT / "examples" / "skg06-belts.skg"), strict=True):
        path.write_bytes(tape)
    return paths


@pytest.mark.parametrize(("command", "more"), [("sim", []), ("plot", ["-o"]), ("dxf", ["-o"])])
def test_what_is_found_out_is_said(run: Run, belts: tuple[Path, Path], command: str, more: list[str]) -> None:
    """In one line on standard error, with the reason, and nothing where the option says it."""
    output = [*more, belts[0].with_suffix(".svg" if command == "plot" else ".out")] if more else []
    for path, word in zip(belts, ("with drift (programmed)", "without drift (machine)"), strict=True):
        result = run(command, path, *output)
        assert result.exit_code == 0
        assert re.fullmatch(rf"skg: {path}: taken as {re.escape(word)}[:,] .*\n", result.stderr)
        for positions in ("programmed", "machine"):
            assert run(command, path, *output, "--positions", positions).stderr == ""


def test_check_goes_by_it(run: Run) -> None:
    """A full circle counts four radii, or four times where the controller turns; unless told, either is right."""
    for tape, right, expected in (("B100B15B404GXNR1", "programmed", 404), ("B100B15B408GXNR1", "machine", 408)):
        for positions in ("auto", "programmed", "machine"):
            result = run("check", "-", "--positions", positions, stdin=f"{tape}\r\nDD\r\n")
            assert (result.exit_code == 0) == (positions in ("auto", right)), result.stdout
            if result.exit_code:
                assert f"J = {expected} is a full circle by the other count, expected" in result.stdout


def test_name_says_it(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "ratchet.nodrift.3b"
    path.write_bytes((ROOT / "examples" / "ratchet.3b").read_bytes())
    result = run("sim", "--json", path)
    assert json.loads(result.stdout)[0]["positions"] == "machine"
    assert result.stderr == f"skg: {path}: without drift (machine), its name says so\n"


def test_program_needs_no_word(run: Run) -> None:
    result = run("sim", "--json", ROOT / "examples" / "skg06-belts.skg")
    assert json.loads(result.stdout)[0]["positions"] == "programmed"
    assert result.stderr == ""


def test_one_decision_for_all_routes(run: Run, tmp_path: Path) -> None:
    """A contour that closes on any tape stands between two that tell; what drifts is the whole tape or none of it."""
    statements = []
    for x in (0, 90, 180):
        statements += [f"FROM ({x},-5)", f"CUT ({x},0.3),({x}+20.07,7.01),4,({x}+20,31.7),3,({x}-20.2,31.1),2", "BACK"]
        statements += [f"FROM ({x}+40,0)", f"CUT ({x}+40,0):3", "BACK"]
    text = "".join(f"{line} {statement}\n" for line, statement in enumerate(statements, 10))
    for drift, positions in ((True, "programmed"), (False, "machine")):
        made = reference(text, drift=drift)
        assert made.error is None
        path = tmp_path / "part.3b"
        path.write_bytes(made.tape)
        report = json.loads(run("sim", "--json", path).stdout)[0]
        assert report["positions"] == positions
        assert (report["largest_drift"] == 0) == (not drift)


#: Its arc ends where it should, to the micrometre, on either tape: what was drawn, to less than that, is not the same.
FINE = """R=-0.1
FROM (0,0)
CUT (2,-20),(20,-20),3.76362,(25,17.696767),(-15,10),(-15,-20)
BACK
END
"""


def test_what_matters_to_less_than_a_micrometre(run: Run, tmp_path: Path) -> None:
    """`skg dxf` says what it has taken a tape for where corners would be drawn elsewhere; the others need no word."""
    path = tmp_path / "part.3b"
    path.write_bytes(feed(FINE, "no-drift").tape)
    assert path.read_bytes() != feed(FINE).tape
    assert run("sim", path).stderr == ""
    assert f"skg: {path}: taken as " in run("dxf", path).stderr
    for options in (["--positions", "machine"], ["--joints", "tape"]):
        assert run("dxf", path, *options).stderr == ""


def test_a_name_that_gets_lost(run: Run, tmp_path: Path) -> None:
    path, other = tmp_path / "a.nodrift.3b", tmp_path / "b.3b"
    path.write_bytes((ROOT / "examples" / "ratchet.3b").read_bytes())
    assert "its name says that it is without drift; end that of " in run("tape", path, "-o", other).stderr
    for output in (tmp_path / "b.nodrift.3b", "-"):
        assert run("tape", path, "-o", output).stderr == ""


def test_cut_says_when_its_tape_does_not_show_it() -> None:
    """A symmetrical part closes on any tape: only a name or an option tells that it is without drift."""
    from skg.commands.options import unmarked

    program = (ROOT / "examples" / "skg06-tangent-slot.skg").read_text()
    tape = tapes.parse(feed(program, "no-drift").tape)
    assert decide(tape).positions == "programmed" and not decide(tape).is_sure
    assert "end its name in .nodrift.3b" in unmarked("slot.3b", tape, "no-drift")[0]
    assert unmarked("slot.NoDrift.3b", tape, "no-drift") == unmarked("slot.3b", tape, "standard") == []
    sure = tapes.parse(feed((ROOT / "examples" / "skg06-belts.skg").read_text(), "no-drift").tape)
    assert unmarked("belts.3b", sure, "no-drift") == []
    assert "it is with" in unmarked("slot.nodrift.3b", tape, "standard")[0]
