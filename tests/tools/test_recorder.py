"""The recorder of `skg term`: a tape has its name when all of it is there, and the one before is there until then."""

from __future__ import annotations

import fcntl
import os
import pty
import select
import signal
import subprocess
import sys
import termios
import time
import tty
from collections.abc import Callable
from pathlib import Path

import pytest
from facthelp import says
from toolhelp import CAD_TAPE, PATIENCE, SKG

from skg.board.recorder import Listing, Recorder, wrong_with
from skg.errors import UserError

ROOT = Path(__file__).parents[2]
#: What the board types and punches: the paper's numbers stand before DC2, behind DC4 comes the line's end.
BLOCKS = [text.encode() for text in CAD_TAPE.decode().split()[:-1]]


def listed(*numbers: int, blocks: list[bytes] = BLOCKS) -> Listing:
    listing = Listing()
    for number, block in zip(numbers, blocks, strict=False):
        listing.take(b"%04d " % number + block)
    return listing


@pytest.mark.parametrize(
    ("data", "listing", "code"),
    [
        (CAD_TAPE, Listing(), None),
        (b"\0\0" + CAD_TAPE + b"\0", Listing(), None),
        (CAD_TAPE, listed(1, 2, 3, 4, 5), None),
        (CAD_TAPE.removesuffix(b"DD\r\n"), Listing(), "tape-not-whole"),
        (CAD_TAPE + CAD_TAPE, Listing(), "tape-not-whole"),
        (CAD_TAPE.replace(b"B70100B", b"B7010B"), Listing(), "tape-not-whole"),
        (CAD_TAPE.replace(b"GXL3\r\nB0", b"GXL3\r\n0", 1), Listing(), "tape-not-whole"),
        # (a block that got lost on its way to the punch, or to the paper)
        (
            CAD_TAPE.replace(BLOCKS[1] + b"\r\n", b""),
            listed(1, 2, 3, 4, 5),
            "tape-not-listed",
        ),
        (CAD_TAPE, listed(1, 2, 4, 5), "tape-not-listed"),
        (CAD_TAPE, listed(1, 2, 3, 4), "tape-not-listed"),
        (b"N1G17G21\r\nN2G0X0Y0\r\nN3M30\r\n", Listing(), None),
        (b"10 FROM O\r\n\0\0\x0020 END\r\n\0\0\x1a", Listing(), None),
        (CAD_TAPE[:30] + b"\x1a", Listing(), "tape-not-whole"),
        (b"N1G17G21\r\nN3G0X0Y0\r\nN4M30\r\n", Listing(), "tape-not-in-order"),
        (b"N1G17G21\r\nN2G0XY0\r\nN3M30\r\n", Listing(), "tape-not-in-order"),
        (b"N1G17G21\r\nN2G0X0Y0\r\n", Listing(), "tape-no-end"),
        (b"N1G17G21\r\nN2M30", Listing(), "tape-no-end"),
    ],
)
def test_what_is_a_whole_tape(data: bytes, listing: Listing, code: str | None) -> None:
    why = wrong_with(data, listing)
    assert (why and why.code) == code


@pytest.mark.parametrize(
    "path",
    sorted((ROOT / "examples" / "mill").glob("*.nc")),
    ids=lambda path: path.stem,
)
def test_milling_programs_are_whole(path: Path) -> None:
    assert wrong_with(path.read_bytes(), Listing()) is None


class Port:
    """A port at which a board of the test's own types what it is told to."""

    def __init__(self, folder: Path) -> None:
        self.master, self.slave = pty.openpty()
        tty.setraw(self.slave)
        self.link = folder / "port"
        self.link.symlink_to(os.ttyname(self.slave))

    def type(self, *parts: bytes) -> None:
        for part in parts:
            os.write(self.master, part)

    def close(self) -> None:
        os.close(self.slave)
        os.close(self.master)


@pytest.fixture
def port(tmp_path: Path) -> Port:
    one = Port(tmp_path)
    yield one
    one.close()


@pytest.fixture
def attended(port: Port, tmp_path: Path) -> Callable[..., tuple[subprocess.Popen, int]]:
    """Begin a `skg term` that records to tape.3b, in a terminal: the process, and the terminal's keyboard."""
    begun = []

    def begin() -> tuple[subprocess.Popen, int]:
        outer, inner = pty.openpty()
        process = subprocess.Popen(
            [SKG, "term", port.link, "--record", tmp_path / "tape.3b"],
            stdin=inner, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True,
            # (a shell's background job ignores it)
            preexec_fn=lambda: signal.signal(signal.SIGQUIT, signal.SIG_DFL),
        )  # fmt: skip
        begun.append((process, outer, inner))
        until_raw(outer)
        until_heard(port, process)
        return process, outer

    yield begin
    for process, outer, inner in begun:
        process.kill()
        process.communicate()
        os.close(outer)
        os.close(inner)


def until(happens: Callable[[], object]) -> None:
    last = time.monotonic() + PATIENCE
    while not happens():
        assert time.monotonic() < last
        time.sleep(0.02)


def until_raw(terminal: int) -> None:
    until(lambda: not termios.tcgetattr(terminal)[3] & termios.ICANON)


def until_heard(port: Port, process: subprocess.Popen) -> None:
    """Wait until a process reads the port: what came before it opened it, it has thrown away."""
    last = time.monotonic() + PATIENCE
    while not select.select([process.stdout], [], [], 0.05)[0]:
        assert time.monotonic() < last and process.poll() is None
        port.type(b".")


def part_of(folder: Path) -> bytes:
    try:
        return (folder / "tape.3b.part").read_bytes()
    except OSError:
        return b""


def test_its_name_when_it_is_whole(attended: Callable, port: Port, tmp_path: Path) -> None:
    (tmp_path / "tape.3b").write_bytes(b"old")
    process, keys = attended()
    port.type(b"\x12", CAD_TAPE[:30])
    until(lambda: part_of(tmp_path) == CAD_TAPE[:30])
    assert (tmp_path / "tape.3b").read_bytes() == b"old"
    port.type(CAD_TAPE[30:], b"\x14>")
    until(lambda: part_of(tmp_path) == CAD_TAPE)
    os.write(keys, b"\x1d")
    assert process.wait(PATIENCE) == 0, process.stderr.read()
    assert (tmp_path / "tape.3b").read_bytes() == CAD_TAPE and not (tmp_path / "tape.3b.part").exists()


def test_no_tape_no_file(attended: Callable, port: Port, tmp_path: Path) -> None:
    """A board that drives punches nothing; and an old tape stays."""
    (tmp_path / "tape.3b").write_bytes(b"old")
    process, keys = attended()
    port.type(b">")
    os.write(keys, b"\x1d")
    assert process.wait(PATIENCE) == 0
    assert (tmp_path / "tape.3b").read_bytes() == b"old" and not (tmp_path / "tape.3b.part").exists()


@pytest.mark.parametrize("how", ["leave", "SIGTERM", "SIGHUP", "SIGQUIT", "SIGKILL"])
def test_ended_in_the_middle(attended: Callable, port: Port, tmp_path: Path, how: str) -> None:
    """What was punched is kept as a part, the old tape is there, the exit code is none of success; and the terminal is
    as it was, whatever ends the process and can be heeded."""
    (tmp_path / "tape.3b").write_bytes(b"old")
    process, keys = attended()
    port.type(b"\x12", CAD_TAPE[:30])
    until(lambda: part_of(tmp_path) == CAD_TAPE[:30])
    if how == "leave":
        os.write(keys, b"\x1d")
    else:
        process.send_signal(getattr(signal, how))
    assert process.wait(PATIENCE) == (1 if how == "leave" else -getattr(signal, how))
    assert (tmp_path / "tape.3b").read_bytes() == b"old" and part_of(tmp_path) == CAD_TAPE[:30]
    if how != "SIGKILL":
        assert termios.tcgetattr(keys)[3] & termios.ICANON
        assert says(process.stderr.read().decode(), "tape.3b.part")


def test_a_port_in_use(attended: Callable, port: Port) -> None:
    """A second program would take bytes of the tape."""
    attended()
    done = subprocess.run(
        [SKG, "term", port.link, "--batch"],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 2 and done.stderr.count("\n") == 1 and str(port.link) in done.stderr


@pytest.mark.skipif(sys.platform != "linux", reason="asks Linux")
def test_a_port_in_use_is_refused_to_who_looks_for_no_lock(attended: Callable, port: Port) -> None:
    """By the system, to all but root: `cat` of the port would take bytes of the tape. It is free again behind us."""
    question = 0x80045440  # TIOCGEXCL
    process, keys = attended()
    assert int.from_bytes(fcntl.ioctl(port.slave, question, b"\0" * 4), sys.byteorder) == 1
    os.write(keys, b"\x1d")
    assert process.wait(PATIENCE) == 0
    assert int.from_bytes(fcntl.ioctl(port.slave, question, b"\0" * 4), sys.byteorder) == 0


def test_not_onto_the_program(tmp_path: Path) -> None:
    """By any name; and no part is begun."""
    program, link, other = (tmp_path / name for name in ("p.skg", "hard.skg", "soft.skg"))
    program.write_text("10 END\n")
    link.hardlink_to(program)
    other.symlink_to(program)
    for name in (program, link, other):
        done = subprocess.run(
            [SKG, "term", "/dev/null", "--send", program, "--record", name],
            capture_output=True,
            text=True,
        )
        assert done.returncode == 2 and done.stderr.count("\n") == 1 and name.name in done.stderr
        assert program.read_text() == "10 END\n" and not list(tmp_path.glob("*.part"))


def test_two_record_to_one_file(tmp_path: Path) -> None:
    """The second would get the first one's name for its own part; it is refused, and the first goes on."""
    tape = tmp_path / "tape.3b"
    with Recorder(str(tape)) as first:
        first.write(CAD_TAPE[:30])
        with pytest.raises(UserError) as refused:
            Recorder(str(tape))
        assert refused.value.finding.code == "being-recorded" and says(refused.value, "tape.3b.part")
        first.write(CAD_TAPE[30:])
        assert first.finish(Listing(), is_doubtful=False)
    assert tape.read_bytes() == CAD_TAPE


def test_not_by_way_of_its_part(attended: Callable, port: Port, tmp_path: Path) -> None:
    """The program is no part of the tape's; and an older part that is a link leads to nothing that is written."""
    program, other = tmp_path / "p.3b.part", tmp_path / "other"
    program.write_text("10 END\n")
    words = [SKG, "term", port.link, "--send", program, "--record", tmp_path / "p.3b"]
    done = subprocess.run(words, capture_output=True, text=True)
    assert done.returncode == 2 and done.stderr.count("\n") == 1 and "p.3b.part" in done.stderr
    assert program.read_text() == "10 END\n"
    other.write_text("other")
    (tmp_path / "tape.3b.part").symlink_to(other)
    attended()
    port.type(b"\x12", CAD_TAPE[:30])
    until(lambda: part_of(tmp_path) == CAD_TAPE[:30])
    assert other.read_text() == "other"
