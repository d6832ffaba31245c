"""`skg run` does what build/skg80 does with a part: the same tape, paper and exit code; and `skg.Board`."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable
from pathlib import Path

import click
import pytest
from facthelp import CARE, each_says, pattern, says

import skg
from skg.messages.finding import Finding, Phrase

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.skg"))
SKG80 = ROOT / "build" / "skg80"
ROMS = ROOT / "roms"
Program = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture(scope="module", autouse=True)
def built(build: Callable[..., None]) -> None:
    """The emulator as a program, to compare with."""
    build("emu")


def by_skg80(*words: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run([SKG80, *map(str, words)], cwd=ROOT, capture_output=True, text=True)


def same(ours: subprocess.CompletedProcess[str], theirs: subprocess.CompletedProcess[str], part: object) -> None:
    """Tape, exit code, and messages but for the name before them, and the sentence of an ERR, which ours adds."""
    assert (ours.returncode, ours.stdout) == (theirs.returncode, theirs.stdout)
    said = ours.stderr.replace(f"skg: {part}: ", "skg80: ")
    assert re.sub(r"\nskg80: ERR \d\d[^\n]*, [^\n]+\n$", "", said) == theirs.stderr


@pytest.mark.parametrize("part", EXAMPLES[::3], ids=lambda part: part.stem)
def test_examples(run_program: Program, part: Path) -> None:
    theirs = by_skg80(part)
    assert theirs.stdout.encode() == part.with_suffix(".3b").read_bytes().replace(b"\r\n", b"\n")
    same(run_program("run", part), theirs, part)


#: Name: the program, the options of both, the exit code.
ENDS = {
    "an error": ("10 CUT O,(1,0)\n20 A=1/0\n", [], 1),
    "a syntax error": ("10 CUT O,,\n", [], 1),
    "nothing that is cut": ("10 REM\n", [], 0),
    "no line end": ("10 CUT O,(1,0)", [], 0),
    "CR LF": ("10 CUT O,(1,0)\r\n20 END\r\n", [], 0),
    "ctrl-Z": ("10 CUT O,(1,0)\n\x1a20 CUT (5,5)\n", [], 0),
    "no answer": ("10 CUT O,(1,0)\n20 INPUT A\n", [], 1),
    "for ever": ("10 GOTO 10\n", ["--max-cycles", "9000000"], 3),
    "little memory": ("10 CUT O,(1,0)\n", ["--ram", "2"], 0),
    "as typed": ("CUT O,(1,0)\nPRINT 2*3\n", [], 0),
    "as typed, with END": ("CUT O,(1,0),(2,0)\n e n\td\r\n\n\x1aCUT", [], 0),
    "numbers behind what is typed": ("R=1\n10 CUT O,(1,0)\n", [], 0),
    "the words of an error": ('10 PRINT "ERR 05"\n20 PRINT "ERR 05 LINE 10"\n30 CUT O,(1,1)\n', [], 0),
    "a line that begins as an error": ('10 PRINT "ERR 055"\n20 PRINT "ERR 05 LINE "\n', [], 0),
    "an error behind its words": ('10 PRINT "ERR 05 LINE 10",1/0\n', [], 1),
}


#: What the host says itself at these ends, in skg80's words.
OF_THE_HOST = ("no answer", "for ever")


@pytest.mark.parametrize(
    ("text", "options", "code"),
    [pytest.param(*end, id=name, marks=[pytest.mark.wording] * (name in OF_THE_HOST)) for name, end in ENDS.items()],
)
def test_ends(run_program: Program, tmp_path: Path, text: str, options: list[str], code: int) -> None:
    part = tmp_path / "part.skg"
    part.write_bytes(text.encode())
    ours, theirs = run_program("run", part, *options), by_skg80(*options, part)
    assert ours.returncode == code
    same(ours, theirs, part)


@pytest.mark.parametrize(("end", "command"), [("", "END"), ("END\n", "")])
def test_an_open_route_without_numbers_is_whole(run_program: Program, tmp_path: Path, end: str, command: str) -> None:
    """Its last block goes out at END: typed behind a program that has none; with one nothing is typed. `skg ref` and
    the other commands make the same tape of it."""
    part = tmp_path / "part.skg"
    part.write_text(f"CUT O,(1,0)\nCUT (1,2)\n{end}")
    tape = "B1000B0B1000GXL1\nB0B2000B2000GYL2\nDD\n"
    for done in (by_skg80(part), run_program("run", part)):
        assert (done.returncode, done.stdout) == (0, tape)
        typed = [line for line in done.stderr.split("\n") if line.startswith(">")]
        assert typed == [">LOAD", *([f">{command}"] if command else []), ">"]
    assert run_program("ref", part).stdout == tape
    assert each_says(
        run_program("check", part).stdout, (f"{part}: ", Phrase("nothing-wrong"), Phrase("count-blocks", count=2))
    )


def test_a_tape_whose_name_does_not_say_what_it_is(run_program: Program, tmp_path: Path) -> None:
    """As `skg cut` says it: a symmetrical part's tape without drift, and one with under the other's name."""
    part = ROOT / "examples" / "skg06-tangent-slot.skg"
    for rom, name, said in (
        ("no-drift", "a.3b", Finding("name-it-without-drift", ending=".nodrift.3b")),
        ("no-drift", "a.nodrift.3b", ""),
        ("standard", "a.3b", ""),
        ("standard", "a.nodrift.3b", Finding("named-without-drift")),
    ):
        done = run_program("run", part, "--rom", rom, "-o", tmp_path / name)
        assert done.returncode == 0, done.stderr
        assert str(said) in done.stderr and (bool(said) or ".nodrift.3b" not in done.stderr), (rom, name, done.stderr)


def test_answers_and_output(run_program: Program, tmp_path: Path) -> None:
    part, answers, tape = (tmp_path / name for name in ("part.skg", "answers", "part.3b"))
    part.write_text("10 INPUT A,D\n20 CUT O,(A,D)\n")
    answers.write_text("what\n3\n4\n")
    theirs = by_skg80("--input", answers, part)
    same(run_program("run", part, "--input", answers), theirs, part)
    done = run_program("run", part, "--input", answers, "-o", tape)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", theirs.stderr)
    assert tape.read_text() == theirs.stdout
    done = run_program("run", "-", "--input", answers, stdin=part.read_text())
    assert (done.returncode, done.stdout) == (0, theirs.stdout)


@pytest.mark.parametrize(
    ("rom", "options"),
    [
        ("no-drift", ["--rom", ROMS / "skg-nodrift.bin"]),
        ("nodrift", ["--rom", ROMS / "skg-nodrift.bin"]),
        ("skg-nodrift", ["--rom", ROMS / "skg-nodrift.bin"]),
        (ROMS / "skg.hex", ["--rom", ROMS / "skg.hex"]),
        ("drive", ["--rom", ROMS / "skg-drive.bin"]),
        ("8251", ["--rom", ROMS / "skg-8251.bin", "--board", "8251"]),
        ("tty", ["--rom", ROMS / "skg-tty.bin", "--punch-tty"]),
    ],
    ids=["no-drift", "nodrift", "skg-nodrift", "hex", "drive", "8251", "tty"],
)
def test_roms(run_program: Program, rom: str, options: list[str]) -> None:
    part = ROOT / "examples" / "skg06-belts.skg"
    theirs = by_skg80(*options, part)
    assert theirs.stdout
    same(run_program("run", part, "--rom", rom), theirs, part)


@pytest.mark.parametrize(
    ("words", "facts"),
    [
        (["none.skg"], ("none.skg: ", Phrase("system-no-file"))),
        (["examples/wrench.skg", "--rom", "none.bin"], ("none.bin: ", Phrase("system-no-file"))),
        (["examples/wrench.skg", "--rom", "roms/skg.hex/"], ("roms/skg.hex/: ", Phrase("system-no-folder"))),
        (
            ["examples/wrench.skg", "--ram", "57"],
            ("--ram", 57, "2<=", "<=56", Phrase("wrong-usage", command="skg run")),
        ),
        (["-", "--input", "-"], (Phrase("program-and-answers"),)),
    ],
)
def test_wrong_usage(
    run_program: Program, words: list[str], facts: tuple[object, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    done = run_program("run", *words)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("skg: ") and each_says(done.stderr, facts)


def test_a_machine_that_halts(run_program: Program, tmp_path: Path) -> None:
    rom = tmp_path / "halt.bin"
    rom.write_bytes(b"\x76" * 8192)
    done = run_program("run", ROOT / "examples" / "wrench.skg", "--rom", rom)
    assert done.returncode == 1 and each_says(
        done.stderr, (f"skg: {ROOT}/examples/wrench.skg: ", Phrase("board-halted", address=0))
    )


def test_half_a_rom(run_program: Program, tmp_path: Path) -> None:
    rom = tmp_path / "half.bin"
    rom.write_bytes((ROMS / "skg.bin").read_bytes()[:4096])
    done = run_program("run", ROOT / "examples" / "wrench.skg", "--rom", rom)
    assert done.returncode == 2 and each_says(
        done.stderr, (f"skg: {rom}: ", Phrase("image-length", length=4096, expected=8192))
    )


def test_a_rom_for_another_board(run_program: Program) -> None:
    done = run_program("run", ROOT / "examples" / "wrench.skg", "--rom", ROMS / "skg-8251.bin")
    assert done.returncode == by_skg80("--rom", ROMS / "skg-8251.bin", "examples/wrench.skg").returncode == 2
    assert says(done.stderr.splitlines()[-1], Phrase("port-not-set-up", port=17))
    done = run_program("run", ROOT / "examples" / "wrench.skg", "--rom", ROMS / "skg-rc2014.bin")
    assert done.returncode == by_skg80("--rom", ROMS / "skg-rc2014.bin", "examples/wrench.skg").returncode == 2
    assert says(done.stderr, "skg: ", Phrase("board-mute"))


def test_a_rom_with_a_hole(run_program: Program, tmp_path: Path) -> None:
    rom = tmp_path / "hole.hex"
    rom.write_text(":0300000000000000FD\n:00000001FF\n".replace("0000000000FD", "00000000FD"))
    done = run_program("run", ROOT / "examples" / "wrench.skg", "--rom", rom)
    assert done.returncode == 2 and each_says(
        done.stderr, (f"skg: {ROOT}/examples/wrench.skg: ", Phrase("no-code", address=3))
    )


# The board ------------------------------------------------------------------------------------------------


def test_board_goes_on_after_an_error() -> None:
    board = skg.Board()
    assert board.load("10 PRINT 1/0\n") == []
    assert board.run() == ["ERR 05 LINE 10"]
    assert board.error == (5, 10)
    board.clear()
    assert (board.paper, board.tape, board.error) == ("", b"", None)
    assert board.type("LIST") == ["10 PRINT 1/0"]


def test_board_tells_an_error_from_its_words() -> None:
    """PRINT may write them: the prompt does not follow, or the line that was typed has them."""
    board = skg.Board()
    board.load('10 PRINT "ERR 05"\n20 PRINT "ERR 06 LINE 20"\n')
    board.run()
    assert board.type('PRINT "ERR 05"') == ["ERR 05"]
    assert board.error is None
    assert board.type('PRINT "ERR 06",1/0')[-1] == "ERR 05"
    assert board.error == (5, None)
    board.type("PRINT 1")
    assert board.error == (5, None)


def test_board_breaks_off_input_without_answers() -> None:
    board = skg.Board()
    board.load("10 INPUT A\n20 CUT O,(A,0)\n")
    assert board.run()[-1] == "ERR 10 LINE 10"
    assert board.run(["7"])[-1] == "DD"


def test_board_says_why_it_stopped() -> None:
    board = skg.Board(max_cycles=10_000_000)
    board.load("10 GOTO 10\n")
    with pytest.raises(skg.BoardStopped, match=pattern(Phrase("cycles-used-up", cycles=10000000))) as stopped:
        board.run()
    assert stopped.value.reason == "cycles"
    board.machine.press("\x03")
    assert board.machine.run() == "prompt"
    board.type("10 INPUT A")
    with pytest.raises(skg.BoardStopped, match=pattern(Phrase("no-answer"))) as stopped:
        board.type("RUN")
    assert stopped.value.reason == "input"


def test_board_shows_the_paper_as_it_is_printed() -> None:
    seen: list[str] = []
    board = skg.Board(on_paper=seen.append)
    board.load("10 FOR\n")
    board.type('PRINT "HELLO"')
    assert "".join(seen) == board.paper
    board.clear()
    board.type("PRINT 1")
    assert "".join(seen).endswith(board.paper)
    assert len(seen) > 3


def test_board_takes_ascii_alone() -> None:
    with pytest.raises(skg.errors.UserError, match=pattern(Phrase("not-ascii-typed", character="'é'"))):
        skg.Board().type("REM é")


@pytest.mark.parametrize("spelling", ["no-drift", "nodrift", "NoDrift", "skg-nodrift"])
def test_one_name_of_a_rom(spelling: str) -> None:
    """`skg cut` has the same names; there it is one of two."""
    from skg.commands.options import RomName

    assert RomName(("no-drift", "standard")).convert(spelling, None, None) == "no-drift"
    with pytest.raises(click.BadParameter):
        RomName(("no-drift", "standard")).convert("tty", None, None)


@pytest.mark.wording
def test_meaning_of_errors() -> None:
    """The tools' meaning of an error is the beginning of its row in the table of language.md, section 6."""
    from skg.board.board import ERRORS, meaning

    table = (ROOT / "docs" / "spec" / "language.md").read_text().partition("## 6. Errors")[2]
    rows = dict(re.findall(r"^\| (\d\d) \| (.*) \|$", table, re.M))
    assert len(rows) == len(ERRORS) == 10
    for number in ERRORS:
        assert number == 10 or rows[f"{number:02d}"].startswith(str(meaning(number)))


@pytest.mark.wording
def test_one_wording_of_error_7() -> None:
    """The manual, the page and `skg cut` say it as the specification does: of any arc, and of a cutter too."""
    from skg.board.board import meaning
    from skg.cutting import refusal

    sentence = str(meaning(7))
    assert sentence in str(refusal.meaning(7))
    for page in ("docs/manual.md", "web/src/language.ts"):
        assert sentence in (ROOT / page).read_text()


#: Lines without numbers in front of one with a number; whether their last leg is cut.
MIXED = {
    "CUT (0,0),(5,0),(5,5)\n\n10 A=1\n": (Phrase("route-given-up", line=1, by=Phrase("line-number", line=3)),),
    "10 A=1\nFROM (1,1)\ncut (0,0),(5,0)\nCUT (5,5)": (Phrase("route-given-up", line=3, by="RUN"),),
    "FIT (0,0),0\nFIT (5,0)\nFIT (5,5)\r\n10 A=1\n": (
        Phrase("route-given-up", line=1, by=Phrase("line-number", line=4)),
    ),
    "CUT (0,0),(5,0),(5,5)\nFROM (0,0)\n10 A=1\n": (),
    "CUT (0,0),(5,0),(5,5)\nEND\n10 A=1\n": (),
    "CUT (0,0),(5,0),(5,5),(0,0)\nBACK\n10 A=1\n": (),
    "10 CUT (0,0),(5,0),(5,5)\n": (),
    "CUT (0,0),(5,0),(5,5)\n": (),
}


@pytest.mark.parametrize("program", MIXED)
def test_a_route_that_is_given_up_is_said(program: str) -> None:
    """The report is true: the board's tape does, or does not, come to the last point."""
    from skg.board.feeding import feed, given_up

    fed = feed(program)
    assert fed.error is None
    assert (b"B0B5000B5000GYL2" in fed.tape) == (not MIXED[program])
    assert says(given_up(program), CARE, *MIXED[program]) if MIXED[program] else not given_up(program)


def test_every_command_says_what_is_given_up(run_program: Program, tmp_path: Path) -> None:
    part = tmp_path / "part.skg"
    part.write_text(next(iter(MIXED)))
    for words in (["run"], ["ref"], ["sim"], ["gcode"], ["plot", "-o", tmp_path / "part.svg"]):
        done = run_program(*words, part)
        assert done.returncode == 0
        given_up = Phrase("route-given-up", line=1, by=Phrase("line-number", line=3))
        assert sum(says(line, given_up) for line in done.stderr.splitlines()) == 1, words


@pytest.mark.parametrize("command", ["run", "ref"])
def test_a_broken_run_leaves_the_tape_before(run_program: Program, tmp_path: Path, command: str) -> None:
    """And keeps its own beside it, without an end; one that has punched nothing keeps none."""
    part, tape, kept = tmp_path / "part.skg", tmp_path / "part.3b", tmp_path / "part.3b.part"
    tape.write_bytes(b"old")
    part.write_text("10 FROM O\n20 CUT (10,0\n")
    assert run_program(command, part, "-o", tape).returncode == 1
    assert tape.read_bytes() == b"old" and not kept.exists()
    part.write_text("10 FROM O\n20 CUT (10,0);(10,10)\n30 CUT (20,10);(20,20)\n40 CUT X,(5,5):1\n50 BACK\n60 END\n")
    done = run_program(command, part, "-o", tape)
    assert done.returncode == 1 and says(done.stderr, "part.3b.part")
    assert tape.read_bytes() == b"old"
    lines = kept.read_bytes().split()
    assert len(lines) > 2 and lines[-1] == b"D" and b"DD" not in lines


#: Commands that take a program file; skg term is in test_term.py.
TAKE_PROGRAMS = (["run"], ["check"], ["ref"], ["sim"], ["dxf"], ["gcode"])


@pytest.mark.parametrize(
    ("bad", "facts"),
    [
        ("10 REM\r\n20 CUT O,\x03(1,0)\r\n", (Phrase("ctrl-c", line=2, column=10),)),
        ("10 REM\r20 CUT O,\x13(1,0)\r", (Phrase("ctrl-s", line=2, column=10),)),
        ("10 REM\n20 REM é\n30 CUT O,(1,0)\n", (Phrase("not-ascii", character="'é'", line=2, column=8),)),
    ],
    ids=["ctrl-C", "ctrl-S", "letter"],
)
def test_characters_that_no_program_has(run_program: Program, tmp_path: Path, bad: str, facts: tuple[str, ...]) -> None:
    """The same one line everywhere; behind ctrl-Z nobody looks."""
    part = tmp_path / "part.skg"
    part.write_bytes(bad.encode())
    lines = set()
    for words in TAKE_PROGRAMS:
        done = run_program(*words, part)
        assert done.returncode == 2 and each_says(done.stderr, (part.name, *facts)), (words, done.stderr)
        lines.add(done.stderr)
    assert len(lines) == 1
    theirs = by_skg80(part)
    assert theirs.returncode == 2 and len(theirs.stderr.splitlines()) == 1
    part.write_bytes(b"10 CUT O,(1,0)\n\x1a" + bad.encode())
    assert all(run_program(*words, part).returncode == 0 for words in TAKE_PROGRAMS)
    assert by_skg80(part).returncode == 0


@pytest.mark.wording
@pytest.mark.parametrize("bad", [b"20 CUT O,\x03(1,0)\n", b"20 CUT O,\x13(1,0)\n", "20 REM é\n".encode()])
def test_skg80_has_the_same_words(run_program: Program, tmp_path: Path, bad: bytes) -> None:
    part = tmp_path / "part.skg"
    part.write_bytes(bad)
    assert by_skg80(part).stderr == run_program("run", part).stderr.replace("skg: ", "skg80: ", 1)


def test_what_means_nothing_in_a_program(run_program: Program, tmp_path: Path) -> None:
    """The mark of UTF-8, tabs, NULs and all other control characters."""
    part = tmp_path / "part.skg"
    nothing = bytes(byte for byte in range(32) if byte not in b"\n\r\x03\x13\x15\x1a") + b"\x7f"
    part.write_bytes(b"\xef\xbb\xbf10 CUT O," + nothing + b"(1,0)\r\n20 END\r\n\0\0")
    for words in TAKE_PROGRAMS:
        assert run_program(*words, part).returncode == 0, words
    for tape in (run_program("run", part).stdout, run_program("ref", part).stdout, by_skg80(part).stdout):
        assert tape == "B1000B0B1000GXL1\nDD\n"
    theirs = subprocess.run([SKG80, "--tape", part], input="LOAD\nRUN\n", capture_output=True, text=True)
    assert theirs.returncode == 0
