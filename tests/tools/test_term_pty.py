"""`skg term` at the emulator's `--pty`: programs go in, tapes come out, and the port may go away in between."""

from __future__ import annotations

import contextlib
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SKG = Path(sys.executable).with_name("skg")
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
        self.process.wait(timeout=10)
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


def term(*arguments: object, stdin: str = "") -> subprocess.CompletedProcess[bytes]:
    return subprocess.run([SKG, "term", *map(str, arguments)], input=stdin.encode(), capture_output=True, timeout=60)


@pytest.mark.parametrize("name", PARTS)
def test_recorded_between_dc2_and_dc4(name: str, tmp_path: Path) -> None:
    """A teletype alone: the tape is taken out of what comes from the one port there is."""
    part, tape = ROOT / "examples" / f"{name}.skg", tmp_path / "part.3b"
    with emulator(tmp_path, "skg-tty", "--punch-tty") as machine:
        done = term(machine.link, "--send", part, "--run", "--record", tape, "--batch")
    assert done.returncode == 0, done.stderr
    assert tape.read_bytes() == part.with_suffix(".3b").read_bytes()
    assert done.stderr.decode().endswith(f"{tape.stat().st_size} bytes punched to {tape}\n")
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


def test_at_a_real_lines_pace(tmp_path: Path) -> None:
    """9600 baud, 2 MHz: what is typed is held back by the prompt, nothing is lost."""
    part, tape = ROOT / "examples" / "xy-star.skg", tmp_path / "part.3b"
    with emulator(tmp_path, "skg-tty", "--punch-tty", "--baud", "9600", "--mhz", "8") as machine:
        done = term(machine.link, "--send", part, "--run", "--record", tape, "--batch", "--quiet", "10")
    assert done.returncode == 0, done.stderr
    assert tape.read_bytes() == part.with_suffix(".3b").read_bytes()


def test_an_error_does_not_stop_the_sender(tmp_path: Path) -> None:
    """A teletype alone has its reader stopped by DC3 after an error; the lines behind it go on from the prompt."""
    part = tmp_path / "part.skg"
    part.write_text("10 REM A\n20 XYZ=\n30 REM B\n")
    with emulator(tmp_path, "skg-tty", "--punch-tty") as machine:
        paper = term(machine.link, "--send", part, "--batch", "--quiet", "1").stdout
    assert b"ERR 01\r\n>30 REM B\r\n" in paper


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
        paper, errors = sender.communicate(timeout=60)
        assert sender.returncode == 0, errors
        assert b"went away" in errors and b"is back" in errors
        assert paper.rstrip(b">").endswith(b"399 REM LINE\r\n")
        kept = term(machine.link, "--quiet", "0.5", stdin="LIST 390,9999\nNEW\n").stdout.decode()
        assert kept.count("REM LINE") == 10
        done = term(machine.link, "--send", part, "--run", "--record", tape, "--batch")
    assert done.returncode == 0, done.stderr
    assert tape.read_bytes() == part.with_suffix(".3b").read_bytes()
