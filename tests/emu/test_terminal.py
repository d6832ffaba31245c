"""build/skg80 as a teletype: in a terminal, at the end of a pipe, as a pseudo-terminal."""

from __future__ import annotations

import os
import select
import signal
import subprocess
import termios
import time
import tty
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import serial
from emuhelp import ROMS, ROOT, SKG80, TIMEOUT, Skg80, complaint, without_sign_on
from facthelp import says

FATAL = ["HUP", "INT", "QUIT", "ILL", "TRAP", "ABRT", "BUS", "FPE", "SEGV", "USR2", "PIPE", "ALRM", "TERM",
         "XCPU", "XFSZ", "VTALRM", "PROF", "SYS"]  # fmt: skip


def default_signals() -> None:
    """In a new process: the signals that these tests send are not ignored, though they may be here (nohup)."""
    for name in (*FATAL, "TSTP", "CONT"):
        signal.signal(signal.Signals[f"SIG{name}"], signal.SIG_DFL)


class Screen:
    """skg80 in a terminal of its own: the test has the other end."""

    def __init__(self, *arguments: str | Path, program: str = "build/skg80") -> None:
        self.master, self.line = os.openpty()
        self.before = termios.tcgetattr(self.line)
        self.process = subprocess.Popen(
            [ROOT / program, *arguments],
            stdin=self.line,
            stdout=self.line,
            stderr=self.line,
            start_new_session=True,
            preexec_fn=default_signals,
        )
        self.seen = b""

    def close(self) -> None:
        """End what is left of it."""
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        os.close(self.master)
        os.close(self.line)

    def expect(self, text: bytes) -> None:
        """Wait until the screen shows this after what was expected before."""
        end = time.monotonic() + TIMEOUT
        while text not in self.seen:
            ready, _, _ = select.select([self.master], [], [], max(0.0, end - time.monotonic()))
            assert ready, f"{text!r} never came after {self.seen!r}"
            self.seen += os.read(self.master, 4096)
        self.seen = self.seen.partition(text)[2]

    def keys(self, text: bytes) -> None:
        """Type."""
        os.write(self.master, text)

    def enter(self, *lines: bytes) -> None:
        """Type lines, each when the prompt has come."""
        for line in lines:
            self.keys(line + b"\r")
            self.expect(b">")

    def is_raw(self) -> bool:
        """Neither echo nor line editing nor signals from keys."""
        return not termios.tcgetattr(self.line)[3] & (termios.ECHO | termios.ICANON | termios.ISIG)

    def is_restored(self) -> bool:
        """All settings as before."""
        return termios.tcgetattr(self.line) == self.before

    def wait_for(self, condition: str) -> None:
        """Wait until `is_raw` or `is_restored` holds."""
        end = time.monotonic() + TIMEOUT
        while not getattr(self, condition)():
            assert time.monotonic() < end, f"never {condition}"
            time.sleep(0.01)


@contextmanager
def started(*arguments: str | Path, program: str = "build/skg80") -> Iterator[Screen]:
    """skg80 at its first prompt; the sign-on and the keys that matter are on the screen."""
    s = Screen(*arguments, program=program)
    try:
        s.expect(b"skg80: ctrl-] leaves, ctrl-\\ resets\r\n")
        s.expect(b"\r\nSKG ")
        s.expect(b">")
        yield s
    finally:
        s.close()


@pytest.fixture
def screen() -> Iterator[Screen]:
    """skg80 at its first prompt."""
    with started() as s:
        yield s


def test_terminal_is_the_teletype(screen: Screen) -> None:
    """Characters are echoed by the firmware alone; ctrl-] leaves, and the terminal is as before."""
    assert screen.is_raw()
    screen.keys(b"PRINT 1+1\r")
    screen.expect(b"PRINT 1+1\r\n2\r\n>")
    assert screen.seen == b""
    screen.keys(b"\x1d")
    screen.expect(b"\r\n")
    assert screen.process.wait(TIMEOUT) == 0
    assert screen.seen == b"", "the shell's prompt gets a line of its own"
    assert screen.is_restored()


@pytest.mark.parametrize("name", FATAL)
def test_terminal_is_restored_after_a_signal(screen: Screen, name: str) -> None:
    """And the signal is what ends the program."""
    number = signal.Signals[f"SIG{name}"]
    screen.process.send_signal(number)
    assert screen.process.wait(TIMEOUT) == -number
    assert screen.is_restored()


def test_terminal_is_restored_while_stopped(screen: Screen) -> None:
    """Cooked while stopped, raw again when continued, and the board is still there."""
    screen.process.send_signal(signal.SIGTSTP)
    screen.wait_for("is_restored")
    os.waitpid(screen.process.pid, os.WUNTRACED)
    screen.process.send_signal(signal.SIGCONT)
    screen.wait_for("is_raw")
    screen.keys(b"PRINT 3\r")
    screen.expect(b"\n3\r\n>")


LOOP = b"10 CUT O,(1,0)\r\n20 BACK\r\n30 GOTO 30\r\n\x1a"


def test_ctrl_c_breaks_in_and_drops_what_was_typed_ahead(tmp_path: Path) -> None:
    """While a program loops; the tape is in the reader, the punch goes to its file."""
    tape, punch = tmp_path / "tape", tmp_path / "punch"
    tape.write_bytes(LOOP)
    with started("--tape", tape, "--punch", punch) as s:
        s.keys(b"LOAD\rRUN\r")
        s.expect(b"0002 ")
        s.keys(b"LOST")
        s.keys(b"\x03")
        s.expect(b"ERR 10 LINE 30\r\n>")
        s.keys(b"PRINT 4\r")
        s.expect(b"PRINT 4\r\n4\r\n>")
        s.keys(b"\x1d")
        assert s.process.wait(TIMEOUT) == 1
    # (the tape has no end)
    kept = punch.with_name("punch.part")
    assert kept.read_bytes().startswith(b"B1000B0B1000GXL1\r\nB1000B0B1000GXL3\r\n") and not punch.exists()


def push_reset(screen: Screen, how: str) -> None:
    """The key or the signal."""
    if how == "key":
        screen.keys(b"\x1c")
    else:
        screen.process.send_signal(signal.SIGUSR1)
    screen.expect(b"\r\nSKG ")
    screen.expect(b">")


@pytest.mark.parametrize("how", ["key", "signal"])
def test_reset_at_the_prompt_keeps_program_and_variables(screen: Screen, how: str) -> None:
    """The board signs on anew; half a line is forgotten."""
    screen.enter(b"10 PRINT A", b"A=7", b"P5=(1,2)")
    screen.keys(b"20 PRI")
    screen.expect(b"20 PRI")
    push_reset(screen, how)
    screen.keys(b"PRINT A,P5\r")
    screen.expect(b"\n7 (1,2)\r\n>")
    screen.keys(b"LIST\r")
    screen.expect(b"LIST\r\n10 PRINT A\r\n>")


@pytest.mark.parametrize("how", ["key", "signal"])
def test_reset_in_a_run_keeps_the_program(screen: Screen, how: str) -> None:
    """The run's variables are lost; what was typed ahead is dropped; held output is let go."""
    # (A1 stays 6: of values that change one in 256 has the sum that was taken at the prompt, and would be kept)
    screen.enter(b"10 A1=A0+1", b"20 PRINT 8", b"30 GOTO 10", b"1 A0=5")
    screen.keys(b"RUN\rLOST\r")
    screen.expect(b"\n8\r\n")
    if how == "key":
        screen.keys(b"\x13")
    push_reset(screen, how)
    screen.keys(b"PRINT A0\r")
    screen.expect(b"PRINT A0\r\nERR 03\r\n>")
    screen.keys(b"LIST 30\r")
    screen.expect(b"LIST 30\r\n30 GOTO 10\r\n>")


def test_reset_signal_at_a_pipe() -> None:
    """The board signs on anew, at the prompt and while it waits with the pipe open; what is typed later counts."""
    process = subprocess.Popen([SKG80], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert process.stdin and process.stdout
    seen = b""
    for _ in range(3):
        while not seen.endswith(b">"):
            seen += process.stdout.read(1)
        process.send_signal(signal.SIGUSR1)
        seen = process.stdout.read(1)
    process.stdin.write(b"PRINT 6\n")
    process.stdin.close()
    seen += process.stdout.read()
    assert process.wait(TIMEOUT) == 0
    assert seen.endswith(b">PRINT 6\r\n6\r\n>")
    assert b"\nSKG " in seen
    process.stdout.close()


def test_load_says_that_the_reader_is_empty(screen: Screen) -> None:
    """It waits as long as it takes, as the board does; ctrl-C breaks it off."""
    screen.keys(b"LOAD\r")
    screen.expect(b"skg80: the reader is empty (--tape FILE puts a tape in); ctrl-C breaks off\r\n")
    screen.keys(b"\x03")
    screen.expect(b"ERR 10\r\n>")


def test_terminal_that_hangs_up(screen: Screen) -> None:
    """Nobody is there any more, and HUP is ignored (nohup): it ends, and does not go on for ever."""
    with subprocess.Popen(
        ["sh", "-c", 'trap "" HUP; exec "$0"', SKG80], stdin=screen.line, stdout=screen.line, stderr=subprocess.DEVNULL
    ) as process:
        screen.expect(b">")
        screen.process.kill()
        screen.process.wait()
        os.close(screen.line)
        os.close(screen.master)
        try:
            assert process.wait(TIMEOUT) in (0, 2)
        finally:
            process.kill()
            screen.master, screen.line = os.openpty()


def test_sanitizers_find_nothing(tmp_path: Path) -> None:
    """The whole program in a terminal, built with the address and undefined behaviour sanitizers."""
    with started("--tty", tmp_path / "paper", program="build/asan/skg80") as s:
        s.keys(b"PRINT 1\r")
        s.expect(b"\n1\r\n>")
        push_reset(s, "key")
        s.keys(b"\x1d")
        assert s.process.wait(TIMEOUT) == 0
    paper = (tmp_path / "paper").read_bytes()
    assert without_sign_on(paper).startswith(b">PRINT 1\r\n1\r\n>\r\nSKG ")


@pytest.mark.parametrize("end", [b"\n", b"\r\n", b"\r"])
def test_piped_text_is_typed(skg80: Skg80, end: bytes) -> None:
    """With any line ends; at its end the board's prompt ends the program."""
    done = skg80(stdin=b"PRINT 1" + end + b"PRINT 2" + end)
    assert without_sign_on(done.stdout) == b">PRINT 1\r\n1\r\n>PRINT 2\r\n2\r\n>"
    assert (done.returncode, done.stderr) == (0, b"\r\n")


@pytest.mark.parametrize(
    ("lines", "code"),
    [
        ("PRINT A\nPRINT 1\n", 1),
        ("10 PRINT A\nRUN\nNEW\n", 1),
        ('10 PRINT "ERR 05"\nRUN\n', 0),
        ('10 PRINT "ERR 05"\n20 INPUT A\nRUN\n1\n', 0),
    ],
)
def test_piped_text_that_is_answered_with_err(skg80: Skg80, lines: str, code: int) -> None:
    """All lines are typed; the exit code says that one was refused. What a program prints is no answer."""
    done = skg80(stdin=lines.encode())
    last = lines.splitlines()[-1].encode()
    assert done.returncode == code and last in done.stdout, done.stdout


def test_piped_text_waits_for_the_machine(skg80: Skg80, tmp_path: Path) -> None:
    """Text piped in behind RUN answers INPUT; none is lost while the program runs."""
    tape = tmp_path / "tape"
    tape.write_bytes(b"10 INPUT A\r\n20 INPUT B\r\n30 CUT O,(A,0)\r\n\x1a")
    done = skg80("--tape", tape, "--punch", tmp_path / "punch", stdin=b"LOAD\nRUN\n5\nO:1\nPRINT A\n")
    assert done.returncode == 0
    assert (tmp_path / "punch").read_bytes() == b"B5000B0B5000GXL1\r\nDD\r\n"
    assert done.stdout.endswith(b">PRINT A\r\n5\r\n>")


def test_piped_text_that_ends_too_soon(skg80: Skg80, tmp_path: Path) -> None:
    """In the middle of a line, or where INPUT asks: exit 1 and one line."""
    done = skg80(stdin=b"HALF")
    assert done.stderr.startswith(b"\r\n") and says(complaint(done, 1), "input", "`>HALF`")
    tape = tmp_path / "tape"
    tape.write_bytes(b"10 INPUT A\r\n\x1a")
    done = skg80("--tape", tape, stdin=b"LOAD\nRUN\n")
    assert done.stderr.startswith(b"\r\n") and says(complaint(done, 1), "INPUT", "input")


@pytest.mark.parametrize("options", [["--baud", "300"], ["--baud", "9600"], ["--mhz", "0.5"]])
def test_real_time_at_a_pipe(skg80: Skg80, options: list[str]) -> None:
    """It ends, and a character takes ten bits' time on the line."""
    start = time.monotonic()
    done = skg80(*options, stdin=b"PRINT 1\n")
    assert done.stdout.endswith(b">PRINT 1\r\n1\r\n>")
    if options[0] == "--baud":
        assert time.monotonic() - start > (len(done.stdout) - 1) * 10 / int(options[1])


@pytest.mark.parametrize("options", [["--mhz", "2"], ["--baud", "9600"]])
def test_real_time_in_a_terminal(options: list[str]) -> None:
    """The board hears its keys."""
    with started(*options) as s:
        s.keys(b"PRINT 5\r")
        s.expect(b"\n5\r\n>")


def test_nobody_reads_the_pipe() -> None:
    """The reader of the paper goes away: the program ends too."""
    process = subprocess.Popen([SKG80], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    assert process.stdin and process.stdout
    process.stdout.close()
    process.stdin.write(b"PRINT 1\n" * 100)
    process.stdin.close()
    assert process.wait(TIMEOUT) in (2, -signal.SIGPIPE)


@pytest.fixture
def port() -> Iterator[tuple[str, subprocess.Popen[bytes]]]:
    """The name of a pseudo-terminal with skg80 behind it, and the process."""
    process = subprocess.Popen([SKG80, "--pty"], stdout=subprocess.PIPE)
    assert process.stdout
    yield process.stdout.readline().decode().strip(), process
    process.terminate()
    process.wait(TIMEOUT)
    process.stdout.close()


def talk(line: serial.Serial, text: bytes, answer: bytes) -> None:
    """Send, and expect exactly this."""
    line.write(text)
    assert line.read(len(answer)) == answer


def test_pseudo_terminal(port: tuple[str, subprocess.Popen[bytes]]) -> None:
    """For pyserial, at any speed; nothing is echoed by the line, its user may come back, and the signal resets."""
    name, process = port
    with serial.Serial(name, 9600, timeout=TIMEOUT) as line:
        line.write(b"PRINT 1\r")  # pyserial has thrown away what was printed before it opened the line
        assert line.read_until(b"\n1\r\n>").endswith(b"PRINT 1\r\n1\r\n>")
        long = b"REM " + b"X" * 100
        talk(line, (long + b"\r") * 10, (long + b"\r\n>") * 10)
    with serial.Serial(name, 110, timeout=TIMEOUT) as line:
        talk(line, b"A=7\r", b"A=7\r\n>")
        process.send_signal(signal.SIGUSR1)
        assert line.read_until(b">").startswith(b"\r\nSKG ")
        talk(line, b"PRINT A\r", b"PRINT A\r\n7\r\n>")
        line.timeout = 0.05
        assert line.read(1) == b""
    assert process.poll() is None


def test_pseudo_terminal_without_a_reader(port: tuple[str, subprocess.Popen[bytes]]) -> None:
    """The board does not wait for ever for somebody who never reads."""
    name, process = port
    with serial.Serial(name, timeout=TIMEOUT) as line:
        for _ in range(200):
            line.write(b"REM " + b"Y" * 95 + b"\r")
        end = time.monotonic() + TIMEOUT
        while line.out_waiting and time.monotonic() < end:
            time.sleep(0.05)
        time.sleep(1.5)
        line.reset_input_buffer()
        line.write(b"PRINT 9\r")
        assert line.read_until(b"\n9\r\n>").endswith(b"\n9\r\n>")
    assert process.poll() is None


def test_raw_mode_needs_no_output_terminal() -> None:
    """Keyboard from a terminal, paper into a pipe; the keys that matter stand on standard error."""
    master, line = os.openpty()
    tty.setcbreak(master)
    process = subprocess.Popen([SKG80], stdin=line, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert process.stdout and process.stderr
    while process.stdout.read(1) != b">":
        pass
    os.write(master, b"PRINT 1\r\x1d")
    assert process.wait(TIMEOUT) == 0
    assert b"ctrl-] leaves" in process.stderr.read()
    process.stdout.close()
    process.stderr.close()
    os.close(master)
    os.close(line)


def test_8251_in_a_terminal(skg80: Skg80) -> None:
    """The other board's firmware, the other board."""
    done = skg80("--rom", ROMS / "skg-8251.bin", "--board", "8251", stdin=b"PRINT 2\n")
    assert done.returncode == 0
    assert without_sign_on(done.stdout) == b">PRINT 2\r\n2\r\n>"
