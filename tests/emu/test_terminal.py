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
from pathlib import Path

import pytest
import serial
from conftest import ROOT, Skg80, monitor

TIMEOUT = 20.0  # seconds; far more than anything here takes


class Screen:
    """skg80 in a terminal of its own: the test has the other end."""

    def __init__(self, *arguments: str | Path, program: str = "build/skg80") -> None:
        self.master, self.line = os.openpty()
        self.before = termios.tcgetattr(self.line)
        self.process = subprocess.Popen(
            [ROOT / program, *arguments], stdin=self.line, stdout=self.line, stderr=self.line, start_new_session=True
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


@pytest.fixture
def screen(rom: Path) -> Iterator[Screen]:
    """skg80 at its first prompt."""
    s = Screen("--rom", rom)
    s.expect(b">")
    yield s
    s.close()


def test_terminal_is_the_teletype(screen: Screen) -> None:
    """Characters are echoed by the firmware alone; ctrl-] leaves, and the terminal is as before."""
    assert screen.is_raw()
    screen.keys(b"HELLO\r")
    screen.expect(b"HELLO\r\nERR 01\r\n>")
    assert screen.seen == b""
    screen.keys(b"\x1d")
    assert screen.process.wait(TIMEOUT) == 0
    assert screen.is_restored()


FATAL = ["HUP", "INT", "QUIT", "ILL", "TRAP", "ABRT", "BUS", "FPE", "USR1", "SEGV", "USR2", "PIPE", "ALRM", "TERM",
         "XCPU", "XFSZ", "VTALRM", "PROF", "SYS"]  # fmt: skip


@pytest.mark.parametrize("name", FATAL)
def test_terminal_is_restored_after_a_signal(screen: Screen, name: str) -> None:
    """And the signal is what ends the program."""
    number = signal.Signals[f"SIG{name}"]
    screen.process.send_signal(number)
    assert screen.process.wait(TIMEOUT) == -number
    assert screen.is_restored()


def test_terminal_is_restored_while_stopped(screen: Screen) -> None:
    """Cooked while stopped, raw again when continued, and the machine is still there."""
    screen.process.send_signal(signal.SIGTSTP)
    screen.wait_for("is_restored")
    os.waitpid(screen.process.pid, os.WUNTRACED)
    screen.process.send_signal(signal.SIGCONT)
    screen.wait_for("is_raw")
    screen.keys(b"A\r")
    screen.expect(b"ERR 01\r\n>")


def test_ctrl_c_breaks_in_and_drops_what_was_typed_ahead(rom: Path, tmp_path: Path) -> None:
    """While a program loops; the tape is in the reader, the punch goes to its file."""
    tape, punch = tmp_path / "tape", tmp_path / "punch"
    tape.write_bytes(b"PB1\r\nJ\x1a")
    s = Screen("--rom", rom, "--tape", tape, "--punch", punch)
    s.expect(b">")
    s.keys(b"L\rR\rLOST")
    s.expect(b"R\r\n")
    time.sleep(0.2)
    s.keys(b"\x03")
    s.expect(b"\r\n>")
    s.keys(b"Z\r")
    s.expect(b"Z\r\nERR 01\r\n>")
    s.keys(b"\x1d")
    assert s.process.wait(TIMEOUT) == 0
    s.close()
    assert punch.read_bytes() == b"B1\r\n"


def test_sanitizers_find_nothing(rom: Path, tmp_path: Path) -> None:
    """The whole program in a terminal, built with the address and undefined behaviour sanitizers."""
    s = Screen("--rom", rom, "--tty", tmp_path / "paper", program="build/asan/skg80")
    s.expect(b">")
    s.keys(b"HELLO\r")
    s.expect(b"ERR 01\r\n>")
    s.keys(b"\x1d")
    assert s.process.wait(TIMEOUT) == 0
    s.close()
    assert (tmp_path / "paper").read_bytes() == b">HELLO\r\nERR 01\r\n>"


@pytest.mark.parametrize("text", [b"A\nB\n", b"A\r\nB\r\n", b"A\rB\r"])
def test_piped_text_is_typed(skg80: Skg80, text: bytes) -> None:
    """With any line ends; at its end the machine's prompt ends the program."""
    done = skg80(stdin=text)
    assert done.stdout == b">A\r\nERR 01\r\n>B\r\nERR 01\r\n>"
    assert (done.returncode, done.stderr) == (0, b"")


def test_piped_text_waits_for_the_machine(skg80: Skg80, tmp_path: Path) -> None:
    """What is typed behind RUN answers INPUT and is not lost while the program runs."""
    tape = tmp_path / "tape"
    tape.write_bytes(b"IIPDD\r\n\x1a")
    done = skg80("--tape", tape, "--punch", tmp_path / "punch", stdin=b"L\nR\none\ntwo\nZ\n")
    assert done.returncode == 0
    assert (tmp_path / "punch").read_bytes() == b"one\r\ntwo\r\nDD\r\n"
    assert done.stdout.endswith(b">Z\r\nERR 01\r\n>")


def test_piped_text_that_ends_too_soon(skg80: Skg80, tmp_path: Path) -> None:
    """In the middle of a line, or where INPUT asks: exit 1 and one line."""
    done = skg80(stdin=b"HALF")
    assert (done.returncode, done.stderr) == (1, b"\r\nskg80: the input ended in the middle of `>HALF`\n")
    tape = tmp_path / "tape"
    tape.write_bytes(b"I\x1a")
    done = skg80("--tape", tape, stdin=b"L\nR\n")
    assert (done.returncode, done.stderr) == (1, b"\r\nskg80: INPUT asks, and the input has ended\n")


def test_slow_line_is_slow(skg80: Skg80) -> None:
    """At 300 baud, without --mhz, a character takes a thirtieth of a second."""
    start = time.monotonic()
    done = skg80("--baud", "300", stdin=b"ABC\n")
    assert done.stdout == b">ABC\r\nERR 01\r\n>"
    assert time.monotonic() - start > (len(done.stdout) - 1) / 30


@pytest.fixture
def port(rom: Path) -> Iterator[tuple[str, subprocess.Popen[bytes]]]:
    """The name of a pseudo-terminal with skg80 behind it, and the process."""
    process = subprocess.Popen([ROOT / "build/skg80", "--rom", rom, "--pty"], stdout=subprocess.PIPE)
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
    """For pyserial, at any speed; nothing is echoed by the line, and its user may come back."""
    name, process = port
    with serial.Serial(name, 9600, timeout=TIMEOUT) as line:
        line.write(b"ABC\r")  # pyserial has thrown away what was printed before it opened the line
        assert line.read_until(b"01\r\n>") in (b"ABC\r\nERR 01\r\n>", b">ABC\r\nERR 01\r\n>")
        talk(line, b"X" * 1000 + b"\r", b"X" * 1000 + b"\r\nERR 01\r\n>")
    with serial.Serial(name, 110, timeout=TIMEOUT) as line:
        talk(line, b"D\r", b"D\r\nERR 01\r\n>")
        line.timeout = 0.05
        assert line.read(1) == b""
    assert process.poll() is None


def test_pseudo_terminal_without_a_reader(port: tuple[str, subprocess.Popen[bytes]]) -> None:
    """The machine does not wait for ever for somebody who never reads."""
    name, process = port
    with serial.Serial(name, timeout=TIMEOUT) as line:
        for _ in range(20):
            line.write(b"Y" * 999 + b"\r")
        end = time.monotonic() + TIMEOUT
        while line.out_waiting and time.monotonic() < end:
            time.sleep(0.05)
        time.sleep(1.5)
        line.reset_input_buffer()
        line.write(b"Z\r")
        assert line.read_until(b"Z\r\nERR 01\r\n>").endswith(b"Z\r\nERR 01\r\n>")
    assert process.poll() is None


def test_raw_mode_needs_no_output_terminal(rom: Path) -> None:
    """Keyboard from a terminal, paper into a pipe."""
    master, line = os.openpty()
    tty.setcbreak(master)
    process = subprocess.Popen([ROOT / "build/skg80", "--rom", rom], stdin=line, stdout=subprocess.PIPE)
    assert process.stdout
    assert process.stdout.read(1) == b">"
    os.write(master, b"A\r\x1d")
    assert process.wait(TIMEOUT) == 0
    process.stdout.close()
    os.close(master)
    os.close(line)


def test_8251_in_a_terminal(tmp_path: Path) -> None:
    """The other board's firmware, the other board."""
    rom = tmp_path / "rom.bin"
    rom.write_bytes(monitor("8251"))
    done = Skg80(rom)("--board", "8251", stdin=b"A\n")
    assert (done.returncode, done.stdout) == (0, b">A\r\nERR 01\r\n>")
