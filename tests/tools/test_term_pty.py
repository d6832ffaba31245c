"""`skg term` at the emulator's `--pty`: programs go in, tapes come out, and the port may go away in between."""

from __future__ import annotations

import contextlib
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from facthelp import CARE, says
from toolhelp import SKG, term

from skg.board.feeding import feed
from skg.messages.finding import Finding, Phrase

ROOT = Path(__file__).resolve().parents[2]
SKG80 = ROOT / "build" / "skg80"
ROMS = ROOT / "roms"
PARTS = ["xy-star", "plate-fillets", "wrench"]


@pytest.fixture(scope="session", autouse=True)
def built(build: Callable[..., None]) -> None:
    """The emulator."""
    build("emu")


class Emulator:
    """build/skg80 --pty, its port behind `link`, so that one can come in another's place."""

    def __init__(self, directory: Path, rom: str = "skg", *options: str) -> None:
        self.link = directory / "port"
        self.punch, self.paper = directory / "punch", directory / "paper"
        files = ["--rom", ROMS / f"{rom}.bin", "--punch", self.punch, "--tty", self.paper]
        self.command = [SKG80, "--pty", *files, *options]
        self.plug()

    def plug(self) -> None:
        """Switch it on."""
        self.process = subprocess.Popen(self.command, stdout=subprocess.PIPE, text=True)
        assert self.process.stdout
        name = self.process.stdout.readline().strip()
        assert Path(name).exists()
        self.link.unlink(missing_ok=True)
        self.link.symlink_to(name)

    def unplug(self) -> None:
        """Switch it off; its pseudo-terminal goes with it."""
        self.link.unlink()
        self.process.terminate()
        self.process.wait()
        assert self.process.stdout
        self.process.stdout.close()


@contextlib.contextmanager
def emulator(directory: Path, rom: str = "skg", *options: str) -> Iterator[Emulator]:
    """A board at a port, switched off at the end."""
    machine = Emulator(directory, rom, *options)
    try:
        yield machine
    finally:
        if machine.process.poll() is None:
            machine.unplug()


@pytest.mark.parametrize("name", PARTS)
def test_recorded_between_dc2_and_dc4(name: str, tmp_path: Path) -> None:
    """A teletype alone: the tape is taken out of what comes from the one port there is."""
    part, tape = ROOT / "examples" / f"{name}.skg", tmp_path / "part.3b"
    with emulator(tmp_path, "skg-tty", "--punch-tty") as machine:
        done = term(machine.link, "--send", part, "--run", "--record", tape, "--batch")
    assert done.returncode == 0, done.stderr
    assert tape.read_bytes() == part.with_suffix(".3b").read_bytes()
    assert says(done.stderr.decode().splitlines()[-1], Phrase("bytes-punched", number=tape.stat().st_size), tape)
    assert b"ERR" not in done.stdout


@pytest.mark.parametrize("name", PARTS)
def test_punched_by_the_machine(name: str, tmp_path: Path) -> None:
    """The standard board has a punch of its own; on the terminal the blocks are only listed."""
    part = ROOT / "examples" / f"{name}.skg"
    with emulator(tmp_path) as machine:
        done = term(machine.link, "--send", part, "--run", "--batch", "--quiet", "1")
        assert done.returncode == 0, done.stderr
        again = term(machine.link, "--quiet", "0.5", stdin="LIST\n")
    assert machine.punch.read_bytes() == part.with_suffix(".3b").read_bytes()
    listed = [line for line in again.stdout.decode().split("\r\n") if line[:1].isdigit()]
    assert len(listed) == len(part.read_text().splitlines())


@pytest.mark.parametrize("options", [[], ["--unnumbered"]], ids=["stored", "unnumbered"])
def test_at_a_real_lines_pace(options: list[str], tmp_path: Path) -> None:
    """9600 baud, 8 MHz: what is typed is held back by the prompt, nothing is lost."""
    part, tape = ROOT / "examples" / "plate-fillets.skg", tmp_path / "part.3b"
    with emulator(tmp_path, "skg-tty", "--punch-tty", "--baud", "9600", "--mhz", "8") as machine:
        done = term(machine.link, "--send", part, "--run", "--record", tape, "--batch", *options)
    assert done.returncode == 0, done.stderr
    assert tape.read_bytes() == part.with_suffix(".3b").read_bytes()


def test_the_machine_goes_away_and_comes_back(tmp_path: Path) -> None:
    """The sender waits, and goes on where it was; then the part is sent again, whole, and cut."""
    part, tape = ROOT / "examples" / "xy-star.skg", tmp_path / "part.3b"
    long = tmp_path / "long.skg"
    long.write_text("".join(f"{number} REM LINE\n" for number in range(1, 400)))
    with emulator(tmp_path, "skg-tty", "--punch-tty") as machine:
        command = [SKG, "term", machine.link, "--send", long, "--batch", "--quiet", "2"]
        sender = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        assert sender.stdout
        seen = b""
        while b">50 REM" not in seen:
            more = sender.stdout.read1(4096)
            assert more, seen
            seen += more
        machine.unplug()
        time.sleep(0.7)
        assert sender.poll() is None
        machine.plug()
        paper, errors = sender.communicate()
        assert sender.returncode == 0, errors
        told = errors.decode()
        assert says(told, Phrase("port-went-away")) and says(told, Phrase("port-is-back"))
        assert paper.rstrip(b">").endswith(b"399 REM LINE\r\n")
        kept = term(machine.link, "--quiet", "0.5", stdin="LIST 390,9999\nNEW\n").stdout.decode()
        assert kept.count("REM LINE") == 10
        done = term(machine.link, "--send", part, "--run", "--record", tape, "--batch")
    assert done.returncode == 0, done.stderr
    assert tape.read_bytes() == part.with_suffix(".3b").read_bytes()


def run_to_tape(machine: Emulator, part: Path, *options: object) -> tuple[subprocess.CompletedProcess[bytes], bytes]:
    """`--send --run` in a batch: what it says, and the tape, from the terminal or from the machine's own punch."""
    tape = machine.punch.with_name("part.3b")
    own = "--punch-tty" not in machine.command
    done = term(machine.link, "--send", part, "--run", "--batch", *([] if own else ["--record", tape]), *options)
    return done, (machine.punch if own else tape).read_bytes()


def zigzag(count: int, numbered: bool) -> str:
    """A program of many CUTs, a line each."""
    lines = ["FROM (0,-5)", *(f"CUT ({k}.25,{k * k % 17 - 0.5}),({k}.75,{k * k % 13})" for k in range(count)), "END"]
    return "".join(f"{10 * at} {line}\n" if numbered else f"{line}\n" for at, line in enumerate(lines, 1))


BOARDS = {"skg": [], "skg-8251": ["--board", "8251"], "skg-tty": ["--punch-tty"]}


@pytest.mark.parametrize("rom", BOARDS)
def test_any_size_goes_through_any_board(rom: str, tmp_path: Path) -> None:
    """A program that memory does not hold is sent again without its numbers, each line carried out as it comes."""
    part = tmp_path / "part.skg"
    part.write_text(zigzag(60, numbered=True))
    with emulator(tmp_path, rom, *BOARDS[rom], "--ram", "2") as machine:
        done, tape = run_to_tape(machine, part)
    assert done.returncode == 0, done.stderr
    assert says(done.stderr.decode(), Phrase("sent-without-numbers"))
    assert tape == feed(part.read_text(), ram_kib=56).tape
    assert tape.count(b"\n") > 100


def test_as_many_lines_as_one_likes(tmp_path: Path) -> None:
    """300 lines without numbers, blocks punched between them, on a teletype alone."""
    part = tmp_path / "part.skg"
    part.write_text(zigzag(300, numbered=False))
    with emulator(tmp_path, "skg-tty", "--punch-tty") as machine:
        done, tape = run_to_tape(machine, part)
    assert (done.returncode, done.stderr.count(b"skg term: ")) == (0, 1), done.stderr
    assert tape == feed(part.read_text()).tape
    assert b"RUN" not in done.stdout


def test_what_was_on_the_board_is_not_in_the_tape(tmp_path: Path) -> None:
    """Neither an old program's lines nor R, SCALE and a route that lines without numbers have left."""
    first, second = tmp_path / "first.skg", ROOT / "examples" / "plate-fillets.skg"
    first.write_text("5 FROM (99,99)\n15 PRINT 1/0\nR=0.3\nSCALE 2\nCUT (1,1),(2,2),(5,0)\n")
    with emulator(tmp_path, "skg-tty", "--punch-tty") as machine:
        assert term(machine.link, "--send", first, "--batch").returncode == 0
        for options in ([], ["--unnumbered"], []):
            done, tape = run_to_tape(machine, second, *options)
            assert (done.returncode, tape) == (0, second.with_suffix(".3b").read_bytes()), done.stderr


def test_a_route_left_open_is_ended(tmp_path: Path) -> None:
    """Lines without numbers and without an END: RUN would drop the route and its last block."""
    part = tmp_path / "part.skg"
    part.write_text("CUT O,(5,0),(5,5)\n")
    with emulator(tmp_path, "skg-tty", "--punch-tty") as machine:
        done, tape = run_to_tape(machine, part)
    assert (done.returncode, tape) == (0, b"B5000B0B5000GXL1\r\nB0B5000B5000GYL2\r\nDD\r\n")


def test_a_route_that_is_given_up_is_said(tmp_path: Path) -> None:
    """A line with a number drops it: with its place in the file, empty lines counted."""
    part = tmp_path / "part.skg"
    part.write_text("\nCUT O,(5,0),(5,5)\n\n10 A=1\n")
    with emulator(tmp_path, "skg-tty", "--punch-tty") as machine:
        done, tape = run_to_tape(machine, part)
    assert (done.returncode, tape) == (0, b"B5000B0B5000GXL1\r\nDD\r\n")
    given_up = Phrase("route-given-up", line=2, by=Phrase("line-number", line=4))
    assert says(done.stderr.decode(), "part.skg: ", CARE, given_up)


@pytest.mark.parametrize(("more", "is_said"), [("10 A=1\n", True), ("10 A=1\nFROM O\nCUT O,(5,0)\n", True),
                                               ("BACK\n10 A=1\nFROM O\nCUT O,(5,0)\n", False)])  # fmt: skip
def test_so_is_one_that_is_given_up_by_what_is_only_sent(tmp_path: Path, more: str, is_said: bool) -> None:
    """Without --run, too; and then a route that is open at the end may go on: it is no tape yet."""
    part = tmp_path / "part.skg"
    part.write_text(f"CUT O,(5,0),(5,5)\n{more}")
    with emulator(tmp_path, "skg-tty", "--punch-tty") as machine:
        done = term(machine.link, "--send", part, "--batch", "--record", tmp_path / "part.3b")
    assert done.returncode == 1 and (tmp_path / "part.3b.part").exists() and not (tmp_path / "part.3b").exists()
    said = [line for line in done.stderr.decode().splitlines() if says(line, Phrase("route-given-up"))]
    given_up = Phrase("route-given-up", line=1, by=Phrase("line-number", line=2))
    assert [says(line, "part.skg: ", CARE, given_up) for line in said] == [True] * is_said


def test_the_words_of_an_error_are_none(tmp_path: Path) -> None:
    """PRINT writes them, in a program, in a line without a number and between the questions of INPUT: all is sent."""
    part, words = tmp_path / "part.skg", 'PRINT "ERR 05 LINE 20"'
    stored = ["INPUT A", words, "INPUT D", "CUT O,(A,D)", 'PRINT "ERR 06"']
    lines = [words, *(f"{10 * at} {line}" for at, line in enumerate(stored, 1)), "RUN", "3", "ERR 05", "4"]
    part.write_text("\n".join([*lines, ""]))
    with emulator(tmp_path, "skg-tty", "--punch-tty") as machine:
        done = term(machine.link, "--send", part, "--record", tmp_path / "part.3b", "--batch")
    assert (done.returncode, done.stderr.count(b"skg term: ")) == (0, 1), done.stderr
    assert (tmp_path / "part.3b").read_bytes() == b"B3000B4000B4000GYL1\r\nDD\r\n"
    assert done.stdout.count(b"\nERR 05 LINE 20\r\n") == 2


#: What goes wrong: a program, options, what is said, what is not sent any more.
WRONG = {
    "unnumbered": (
        "FROM O\nCUT (1,0),(2,0)\n\nCUT (5,5):-A\nCUT (9,9)\nEND\n",
        ["--run"],
        ("part.skg: ", Phrase("line-number", line=4), "ERR 03"),
        b"(9,9)",
    ),
    "run": (
        "10 CUT O,(5,0)\n20 A=1/0\n",
        ["--run"],
        ("part.skg: ", Phrase("at-line", text="RUN"), "ERR 05 LINE 20"),
        b"END",
    ),
    "stored": (
        "10 REM A\n20 XYZ=\n30 REM B\n",
        [],
        ("part.skg: ", Phrase("line-number", line=2), "ERR 01"),
        b"30 REM B",
    ),
    "full": (zigzag(60, numbered=True), [], Phrase("run-sends-without-numbers"), b">600"),
    "full and jumps": (
        zigzag(60, numbered=True) + "9999 IF 1>2 GOTO 10\n",
        ["--run"],
        Phrase("takes-ram", least=4),
        b">600",
    ),
    "jumps": ("10 IF 1>2 GOTO 10\n", ["--run", "--unnumbered"], Phrase("needs-numbers"), b"GOTO"),
    "asks": ("10 INPUT A\n", ["--run"], Phrase("input-broken-off"), b"20"),
}


@pytest.mark.parametrize(("what", "rom"), [
    (what, rom) for what in WRONG for rom in BOARDS if what in ("unnumbered", "run") or rom == "skg-tty"
])  # fmt: skip
def test_nothing_is_sent_behind_an_error(what: str, rom: str, tmp_path: Path) -> None:
    text, options, message, unsent = WRONG[what]
    facts = message if isinstance(message, tuple) else (message,)
    part, tape = tmp_path / "part.skg", tmp_path / "part.3b"
    part.write_text(text)
    with emulator(tmp_path, rom, *BOARDS[rom], "--ram", "2") as machine:
        done = term(machine.link, "--send", part, "--batch", "--record", tape, *options)
    assert done.returncode == 1
    said = [line for line in done.stderr.decode().splitlines() if says(line, *facts)]
    assert len(said) == 1, done.stderr
    assert unsent not in done.stdout
    kept = tape.with_name("part.3b.part")
    assert not tape.exists() and (not kept.exists() or kept.stat().st_size and str(kept).encode() in done.stderr)


@pytest.mark.parametrize(("output", "code"), [(">&-", 0), ("| head -c 10", 0), (">/dev/full", 2)])
def test_paper_that_nobody_takes(output: str, code: int, tmp_path: Path) -> None:
    """The tape is made all the same; a disk that is full is said."""
    part, tape = ROOT / "examples" / "plate-fillets.skg", tmp_path / "part.3b"
    with emulator(tmp_path, "skg-tty", "--punch-tty") as machine:
        words = f'"$@" {output}'
        command = [SKG, "term", machine.link, "--send", part, "--run", "--batch", "--record", tape]
        done = subprocess.run(["bash", "-o", "pipefail", "-c", words, "bash", *command], capture_output=True, text=True)
    assert done.returncode == code, done.stderr
    assert "Traceback" not in done.stderr
    if code:
        assert done.stderr.splitlines()[-1] == f"skg: {Finding('system-full').within(Phrase('stdout'))}"
    else:
        assert tape.read_bytes() == part.with_suffix(".3b").read_bytes()


def test_a_tape_that_cannot_be_kept(tmp_path: Path) -> None:
    part = ROOT / "examples" / "plate-fillets.skg"
    with emulator(tmp_path, "skg-tty", "--punch-tty") as machine:
        done = term(machine.link, "--send", part, "--run", "--batch", "--record", "/dev/full")
    assert done.returncode == 2
    assert done.stderr.decode().splitlines()[-1] == f"skg: {Finding('system-full').within('/dev/full')}"


def test_answers_from_a_pipe(tmp_path: Path) -> None:
    """Standard input is typed behind RUN: INPUT's answers, as they are asked for."""
    part = tmp_path / "part.skg"
    part.write_text("10 INPUT A,D\n20 CUT O,(A,D)\n")
    with emulator(tmp_path, "skg-tty", "--punch-tty") as machine:
        done = term(machine.link, "--send", part, "--run", "--record", tmp_path / "part.3b", stdin="3\n4\n")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "part.3b").read_bytes() == b"B3000B4000B4000GYL1\r\nDD\r\n"


def test_the_port_goes_away_while_a_tape_is_made(tmp_path: Path) -> None:
    """A stored program is sent anew, whole, when the board may have lost it; lines that were carried out are not."""
    part = tmp_path / "part.skg"
    for numbered in (True, False):
        part.write_text(zigzag(100, numbered))
        with emulator(tmp_path, "skg-tty", "--punch-tty") as machine:
            command = [SKG, "term", machine.link, "--send", part, "--run", "--batch", "--record", tmp_path / "part.3b"]
            sender = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            assert sender.stdout
            seen = b""
            while b"CUT (20.25" not in seen:
                seen += sender.stdout.read1(4096)
            machine.unplug()
            machine.plug()
            errors = sender.communicate()[1]
        assert sender.returncode == (0 if numbered else 1), errors
        if numbered:
            assert says(errors.decode(), Phrase("sent-again"))
            assert (tmp_path / "part.3b").read_bytes() == feed(part.read_text()).tape
        else:
            told = errors.decode()
            assert says(told, Phrase("port-lost-in-line")) or says(told, Phrase("port-lost-at-line"))
            assert says(told, Phrase("tape-incomplete"))
