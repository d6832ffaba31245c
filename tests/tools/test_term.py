"""`skg term` against a board of the test's own at the other end of a pseudo-terminal."""

from __future__ import annotations

import contextlib
import os
import pty
import select
import subprocess
import termios
import threading
import time
import tty
from collections.abc import Iterator
from pathlib import Path

import pytest
from facthelp import each_says, says
from toolhelp import CAD_TAPE, PATIENCE, SKG, term

from skg.board.teletype import DC2, DC4, XOFF, XON, Splitter
from skg.messages.finding import Phrase

PROGRAM = "10 REM A PART\n20 CUT P1,P2\n30 END\n"


class Machine:
    """A board of sorts: echoes, gives a prompt after each line, and punches the CAD tape at RUN.

    Its port is `link`, a symbolic link to the pseudo-terminal, so that the port can go away and come back.
    """

    def __init__(self, link: Path, between_codes: bool = True) -> None:
        self.link = link
        self.between_codes = between_codes
        self.received = bytearray()
        self.lines: list[str] = []
        self.hold_after = 0
        self.held: list[int] = []
        #: How many lines it takes before its port goes away.
        self.unplug_after = 0
        #: A character that gets lost on the line, so often.
        self.loses, self.losses = b"", 0
        #: Seconds that it, or the computer that plays it, takes to answer ctrl-U.
        self.thinks = 0.0
        #: Whether it takes one character at a time, and what comes meanwhile is lost.
        self.is_slow = False
        #: A line that is answered with this error.
        self.refuses, self.answer_is = "", b"ERR 06\r\n"
        self.master = -1
        self.stopping = False
        self.plug()
        self.thread = threading.Thread(target=self.work, daemon=True)
        self.thread.start()

    def plug(self) -> None:
        """Offer a new pseudo-terminal."""
        master, slave = pty.openpty()
        tty.setraw(slave)
        # The slave stays open here too: a master without any slave reports an error.
        self.slave = slave
        self.link.unlink(missing_ok=True)
        self.link.symlink_to(os.ttyname(slave))
        self.master = master

    def unplug(self) -> None:
        """Take the port away."""
        self.link.unlink()
        master, self.master = self.master, -1
        self.unplug_after = 0
        os.close(self.slave)
        os.close(master)

    def work(self) -> None:
        line = bytearray()
        while not self.stopping:
            master = self.master
            if master < 0 or not select.select([master], [], [], 0.05)[0]:
                time.sleep(0.01)
                continue
            with contextlib.suppress(OSError):
                for byte in os.read(master, 1):
                    self.received.append(byte)
                    # (Before the echo: who waits for that has typed nothing ahead.)
                    if self.is_slow and select.select([master], [], [], 0.005)[0]:
                        os.read(master, 64)
                    self.answer(line, byte, master)

    def answer(self, line: bytearray, byte: int, master: int) -> None:
        if byte == 0x15:
            line.clear()
            time.sleep(self.thinks)
            os.write(master, b"\r\n")
            return
        if self.losses and bytes([byte]) == self.loses:
            self.losses -= 1
            return
        if byte != 0x0D:
            line.append(byte)
            os.write(master, bytes([byte]))
            if len(self.received) == self.hold_after:
                for late in self.hold(master):
                    self.answer(line, late, master)
            return
        os.write(master, b"\r\n")
        self.lines.append(line.decode())
        if len(self.lines) == self.unplug_after:
            line.clear()
            self.unplug()
            return
        if self.lines[-1] == self.refuses:
            os.write(master, self.answer_is)
        if line == b"RUN":
            codes = (bytes([DC2]), bytes([DC4])) if self.between_codes else (b"", b"")
            if self.between_codes:
                os.write(master, codes[0] + CAD_TAPE + codes[1])
        line.clear()
        os.write(master, b">")

    def hold(self, master: int) -> list[int]:
        """Send XOFF, see what still comes, and send XON."""
        os.write(master, bytes([XOFF]))
        time.sleep(1.5)  # (time for a busy machine to read it)
        while select.select([master], [], [], 0)[0]:
            data = os.read(master, 64)
            self.held += data
            self.received += data
        time.sleep(0.3)
        assert not select.select([master], [], [], 0)[0], "nothing is sent while held"
        os.write(master, bytes([XON]))
        return list(self.held)

    def greet(self, process: subprocess.Popen[bytes]) -> None:
        """Wait until a `skg term` reads this port: what came before it opened it, it has thrown away."""
        assert process.stdout
        last = time.monotonic() + PATIENCE
        while not select.select([process.stdout], [], [], 0.05)[0]:
            assert time.monotonic() < last and process.poll() is None
            os.write(self.master, b".")

    def stop(self) -> None:
        self.stopping = True
        self.thread.join()


@pytest.fixture
def machine(tmp_path: Path) -> Iterator[Machine]:
    one = Machine(tmp_path / "port")
    yield one
    one.stop()


def test_sends_and_records(machine: Machine, tmp_path: Path) -> None:
    part, tape = tmp_path / "part.skg", tmp_path / "part.3b"
    part.write_text(PROGRAM)
    result = term(machine.link, "--send", part, "--run", "--record", tape, "--batch")
    assert result.returncode == 0, result.stderr
    assert machine.lines == ["NEW", *PROGRAM.splitlines(), "RUN"]
    assert tape.read_bytes() == CAD_TAPE
    assert b"B9900B0B9900GXL3" in result.stdout, "what is punched is on the paper too"
    assert result.stdout.count(b">") == 5
    assert says(result.stderr.decode().splitlines()[-1], Phrase("bytes-punched", number=len(CAD_TAPE)), tape)


def test_keyboard_from_a_pipe(machine: Machine) -> None:
    result = term(machine.link, "--quiet", "0.3", stdin="PRINT 1\nRUN\n")
    assert result.returncode == 0
    assert machine.lines == ["PRINT 1", "RUN"]


def test_file_from_a_pipe(machine: Machine) -> None:
    assert term(machine.link, "--send", "-", "--quiet", "0.3", stdin=PROGRAM).returncode == 0
    assert machine.lines == PROGRAM.splitlines()


def test_flow_control(machine: Machine, tmp_path: Path) -> None:
    part = tmp_path / "part.skg"
    text = ("10 REM " + "X" * 60 + "\n") * 150
    part.write_text(text)
    machine.hold_after = 20
    assert term(machine.link, "--send", part, "--batch", "--pace", "none", "--quiet", "1").returncode == 0
    # A pseudo-terminal has no line speed: what is written before XOFF is read is on its way already: 4 KB at most.
    assert len(machine.held) < 5000 < len(text) / 2
    assert bytes(machine.received).decode() == text.replace("\n", "\r")


def test_xoff_between_prompts(machine: Machine, tmp_path: Path) -> None:
    """XOFF in the middle of a line holds it; its echo is waited for all the same."""
    part = tmp_path / "part.skg"
    part.write_text(PROGRAM)
    machine.hold_after = 20
    assert term(machine.link, "--send", part, "--batch").returncode == 0
    assert machine.lines == PROGRAM.splitlines()
    assert 20 + len(machine.held) < len(PROGRAM)


def test_a_character_that_got_lost(machine: Machine, tmp_path: Path) -> None:
    """A line is not ended before its echo is what was typed: 10.5 shall never be cut as 105."""
    part = tmp_path / "part.skg"
    part.write_text("10 REM A\n20 CUT (10.5,0)\n30 END\n")
    machine.loses, machine.losses = b".", 1
    assert term(machine.link, "--send", part, "--batch").returncode == 0
    assert machine.lines == part.read_text().splitlines()
    machine.lines.clear()
    machine.losses = 9
    result = term(machine.link, "--send", part, "--batch")
    assert (result.returncode, machine.lines) == (1, ["10 REM A"])
    assert says(result.stderr.decode(), "part.skg: ", Phrase("line-number", line=2), Phrase("echo-wrong"), "20 CUT (10")


def test_a_board_that_takes_one_character_at_a_time(machine: Machine, tmp_path: Path) -> None:
    """With a board that loses characters typed ahead, as SIMH's Altair does, each echo is awaited, and reported."""
    part = tmp_path / "part.skg"
    part.write_text(PROGRAM)
    machine.is_slow = True
    result = term(machine.link, "--send", part, "--batch")
    assert (result.returncode, machine.lines) == (0, PROGRAM.splitlines()), result.stderr
    assert each_says(result.stderr.decode(), Phrase("characters-lost"))


@pytest.mark.parametrize("pace", ["prompt", "none"])
def test_an_error_ends_what_is_sent(machine: Machine, pace: str, tmp_path: Path) -> None:
    part = tmp_path / "part.skg"
    part.write_text(PROGRAM * 100)
    machine.refuses = "20 CUT P1,P2"
    result = term(machine.link, "--send", part, "--batch", "--pace", pace, "--quiet", "0.5")
    assert result.returncode == 1
    assert says(result.stderr.decode(), "ERR 06", Phrase("meaning-6"))
    if pace == "prompt":
        assert machine.lines == ["10 REM A PART", "20 CUT P1,P2"]
        assert says(result.stderr.decode(), "part.skg: ", Phrase("line-number", line=2), "ERR 06")


def test_an_error_gives_the_keyboard(machine: Machine, tmp_path: Path) -> None:
    """In a terminal the operator goes on from there."""
    part = tmp_path / "part.skg"
    part.write_text(PROGRAM)
    machine.refuses = "20 CUT P1,P2"
    outer, inner = pty.openpty()
    process = subprocess.Popen(
        [SKG, "term", machine.link, "--send", part, "--run"], stdin=inner, stdout=inner, stderr=inner
    )
    read_until(outer, f"{Phrase('line-number', line=2)}: ".encode())
    os.write(outer, b"PRINT 2\r")
    read_until(outer, b"PRINT 2\r\n>")
    os.write(outer, b"\x1d")
    assert process.wait() == 0
    assert machine.lines == ["NEW", *PROGRAM.splitlines()[:2], "PRINT 2"]
    for descriptor in (inner, outer):
        os.close(descriptor)


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ("10 REM A\n20 REM \u00c4\n", (Phrase("not-ascii", line=2, column=8, character="'\u00c4'"),)),
        ("10 REM\n20 " + "X" * 124, (Phrase("line-number", line=2), Phrase("line-too-long", length=127, most=126))),
    ],
)
def test_what_the_board_cannot_take(machine: Machine, text: str, facts: tuple[Phrase, ...], tmp_path: Path) -> None:
    """Nothing at all is sent of a file that has such a line."""
    part = tmp_path / "part.skg"
    part.write_text(text)
    result = term(machine.link, "--send", part, "--batch")
    assert (result.returncode, machine.lines) == (2, [])
    assert says(result.stderr.decode(), "part.skg: ", *facts)


def test_a_board_that_is_slow_to_answer(machine: Machine, tmp_path: Path) -> None:
    """An emulator on a busy computer, say, is silent for some seconds now and then."""
    part = tmp_path / "part.skg"
    part.write_text(PROGRAM)
    machine.thinks = 3
    result = term(machine.link, "--send", part, "--batch")
    assert (result.returncode, machine.lines) == (0, PROGRAM.splitlines()), result.stderr


def test_nobody_there(tmp_path: Path) -> None:
    """A port without a board behind it."""
    part = tmp_path / "part.skg"
    part.write_text(PROGRAM)
    master, slave = pty.openpty()
    tty.setraw(slave)
    result = term(os.ttyname(slave), "--send", part, "--batch")
    assert result.returncode == 1
    assert says(result.stderr.decode(), Phrase("board-no-answer"))
    assert os.read(master, 100) == b"\x15"
    for descriptor in (master, slave):
        os.close(descriptor)


def test_punch_on_a_port_of_its_own(machine: Machine, tmp_path: Path) -> None:
    machine.between_codes = False
    punch = Machine(tmp_path / "punch")
    tape = tmp_path / "part.3b"
    process = subprocess.Popen(
        [SKG, "term", machine.link, "--punch-port", punch.link, "--record", tape, "--batch", "--quiet", "30"],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
    )
    machine.greet(process)
    os.write(punch.master, CAD_TAPE)
    process.communicate()
    punch.stop()
    assert process.returncode == 0
    assert tape.read_bytes() == CAD_TAPE


def test_survives_the_port_going_away(machine: Machine, tmp_path: Path) -> None:
    part = tmp_path / "part.skg"
    part.write_text("".join(f"{number} REM LINE\n" for number in range(10, 100)))
    machine.unplug_after = 20
    process = subprocess.Popen(
        [SKG, "term", machine.link, "--send", part, "--batch", "--quiet", "1"],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    last = time.monotonic() + PATIENCE
    while machine.master >= 0:
        assert time.monotonic() < last
        time.sleep(0.005)
    time.sleep(0.7)
    assert process.poll() is None
    machine.plug()
    errors = process.communicate()[1].decode()
    assert process.returncode == 0, errors
    assert sum(says(line, machine.link) for line in errors.splitlines()) >= 2
    # The line in hand when the port went may have lost its beginning; all others arrive whole.
    whole = [line for line in machine.lines if line.endswith("REM LINE")]
    assert len(whole) >= 88
    assert machine.lines[-1] == "99 REM LINE"


def test_gives_up(machine: Machine) -> None:
    process = subprocess.Popen(
        [SKG, "term", machine.link, "--patience", "0.6", "--batch", "--quiet", "20"],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    machine.greet(process)
    machine.unplug()
    errors = process.communicate()[1].decode()
    assert process.returncode == 2
    assert says(errors.splitlines()[-1], "skg: ", f"{machine.link}: ", Phrase("port-given-up"))


@pytest.mark.parametrize("is_punch", [False, True], ids=["teletype", "punch"])
@pytest.mark.parametrize("comes_back", [False, True], ids=["away", "back"])
def test_listening_to_a_port_that_goes_away(machine: Machine, tmp_path: Path, is_punch: bool, comes_back: bool) -> None:
    """Nothing was sent that could be sent again: what came meanwhile is lost, and that is no success."""
    punch = Machine(tmp_path / "punch")
    lost = punch if is_punch else machine
    process = subprocess.Popen(
        [SKG, "term", machine.link, "--punch-port", punch.link, "--batch", "--quiet", "2"],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    machine.greet(process)
    lost.unplug()
    if comes_back:
        time.sleep(0.3)
        lost.plug()
    errors = process.communicate()[1].decode()
    punch.stop()
    assert process.returncode == 1, errors
    assert says(errors, Phrase("port-went-away", port=lost.link)), errors
    last = errors.splitlines()[-1]
    assert says(last, Phrase("port-was-away")) or says(last, Phrase("port-not-back", port=lost.link)), errors
    assert says(errors, Phrase("port-not-back", port=lost.link)) != comes_back


def read_until(descriptor: int, wanted: bytes) -> bytes:
    """Reads a terminal's output up to `wanted`."""
    seen = b""
    while wanted not in seen:
        assert select.select([descriptor], [], [], PATIENCE)[0], seen
        seen += os.read(descriptor, 1000)
    return seen


def until_raw(terminal: int) -> None:
    """Wait until each key of a terminal goes to `skg term` as it is typed."""
    last = time.monotonic() + PATIENCE
    while termios.tcgetattr(terminal)[3] & termios.ICANON:
        assert time.monotonic() < last
        time.sleep(0.01)


def test_in_a_terminal(machine: Machine) -> None:
    """Keys go out one by one, in the board's signs; ctrl-] leaves, and the terminal is as it was."""
    outer, inner = pty.openpty()
    process = subprocess.Popen([SKG, "term", machine.link], stdin=inner, stdout=inner, stderr=inner)
    until_raw(inner)
    os.write(outer, b"PRINT 2\r")
    read_until(outer, b"PRINT 2\r\n>")
    os.write(outer, "PRINT 5−é3\rPRINT 5−3\r".encode())
    seen = read_until(outer, b"PRINT 5-3\r\n>").decode()
    assert says(seen, Phrase("line-dropped", column=9, character="'é'"))
    os.write(outer, b"\x1d")
    assert process.wait() == 0
    assert machine.lines == ["PRINT 2", "PRINT 5-3"]
    for descriptor in (inner, outer):
        os.close(descriptor)


def test_the_terminal_goes_away(machine: Machine) -> None:
    """Its window is closed: nobody is left to type ctrl-]."""
    outer, inner = pty.openpty()
    process = subprocess.Popen([SKG, "term", machine.link], stdin=inner, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    until_raw(inner)
    for descriptor in (inner, outer):
        os.close(descriptor)
    try:
        assert process.communicate()[1] == b""
    finally:
        process.kill()
    assert process.returncode == 0


def test_broken_off(machine: Machine, tmp_path: Path) -> None:
    part = tmp_path / "part.skg"
    part.write_text(PROGRAM * 400)
    outer, inner = pty.openpty()
    process = subprocess.Popen(
        [SKG, "term", machine.link, "--send", part], stdin=inner, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE
    )
    while not machine.lines:
        time.sleep(0.01)
    os.write(outer, b"\x03")
    assert process.communicate()[1].decode().splitlines()[-1].strip().startswith("skg term: ")
    assert process.returncode == 1
    for descriptor in (inner, outer):
        os.close(descriptor)


@pytest.mark.parametrize(
    ("arguments", "facts"),
    [
        (["/nowhere"], ["skg: /nowhere: ", Phrase("system-no-file")]),
        (["nonsense://x"], ["skg: nonsense://x: ", "URL"]),
        (["loop://"], ["skg: loop://: "]),
        (["/dev/null"], ["skg: /dev/null: ", Phrase("no-serial-port")]),
        (
            ["/dev/null", "--punch-port", "/dev/../dev/null"],
            ["skg: /dev/../dev/null: ", Phrase("punch-on-port")],
        ),
        (["/dev/null", "--send", "/nowhere.skg"], ["skg: /nowhere.skg: ", Phrase("system-no-file")]),
    ],
)
def test_bad_ports(arguments: list[str], facts: list[str]) -> None:
    result = term(*arguments)
    assert result.returncode == 2
    assert says(result.stderr.decode(), *facts)
    assert result.stderr.count(b"\n") == 1


def test_splitter() -> None:
    splitter = Splitter()
    assert splitter.feed(b"A\0") == (b"A", b"")
    assert splitter.feed(bytes([DC2]) + b"B1") == (b"B1", b"B1")
    assert splitter.feed(bytes([XOFF]) + b"B2" + bytes([DC4]) + b"C") == (b"B2C", b"B2")
    assert not splitter.may_send.is_set()
    splitter.feed(bytes([XON]))
    assert splitter.may_send.is_set()
