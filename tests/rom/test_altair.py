"""The standard ROM, unchanged, in somebody else's machine: SIMH's Altair with its 2SIO (Debian's package `simh`).

The program is typed at SIMH's console, the punch is port 2 of its 2SIO, `ptp`, the reader `ptr`. `set sio nosleep`
keeps SIMH from sleeping whenever the ROM looks for a key and finds none.
"""

from __future__ import annotations

import contextlib
import os
import pty
import select
import shutil
import signal
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from romhelp import ROM, ROOT, SOME_EXAMPLES, Board, saved_tape
from test_examples import EXAMPLES, stem

sys.path.insert(0, str(ROOT / "tests" / "emu"))
from asm8080 import assemble  # noqa: E402

ALTAIR = shutil.which("altairz80")
pytestmark = pytest.mark.skipif(ALTAIR is None, reason="no SIMH: apt-get install simh")

CTRL_E = b"\x05"
#: How the paper ends when the board waits for a line; behind SAVE it is the end of its tape.
PROMPT = (b"\r\n>", b"\r\n\0\0\0\0\x1a>")
#: What keys that edit print: RUBOUT, ctrl-U.
ECHO = {0x7F: b"\b \b", 0x15: b"\r\n"}
#: Seconds for anything that SIMH is asked to do.
PATIENCE = 600.0
#: The whole 64 KiB are RAM but for the ROM.
RAM_KIB = 56
SCRIPT = """set cpu 8080
set cpu noaltairrom
set sio nosleep,nomap
load {rom} {start}
{attach}
go {start}
"""


#: A monitor that loads Intel hex, at F000: from the reader, up to a record of another type than 00. When every sum is
#: right it goes to 0, else it prints `!`.
LOADER = """
        ORG     0F000H
        LXI     SP,0F400H
RECORD: CALL    CHAR
        CPI     ':'
        JNZ     RECORD
        MVI     C,0             ; sum
        CALL    BYTE
        MOV     B,A             ; count
        CALL    BYTE
        MOV     H,A
        CALL    BYTE
        MOV     L,A
        CALL    BYTE
        ORA     A
        JNZ     LAST
STORE:  CALL    BYTE
        MOV     M,A
        INX     H
        DCR     B
        JNZ     STORE
        CALL    BYTE
        MOV     A,C
        ORA     A
        JZ      RECORD
WRONG:  MVI     A,'!'
        OUT     11H
        HLT
LAST:   CALL    BYTE
        MOV     A,C
        ORA     A
        JNZ     WRONG
        JMP     0
BYTE:   CALL    DIGIT
        RLC
        RLC
        RLC
        RLC
        MOV     D,A
        CALL    DIGIT
        ORA     D
        MOV     D,A
        ADD     C
        MOV     C,A
        MOV     A,D
        RET
DIGIT:  CALL    CHAR
        SUI     '0'
        CPI     10
        RC
        SUI     7
        RET
CHAR:   IN      12H
        ANI     1
        JZ      CHAR
        IN      13H
        ANI     7FH
        RET
"""


class Altair:
    """SIMH in a pseudo-terminal, with the ROM at its prompt, or with a hex file that a monitor loads."""

    def __init__(self, directory: Path, reader: Path | None = None, hex_file: Path | None = None) -> None:
        self.tape = directory / "punched.3b"
        image, start = directory / "image.bin", "f000" if hex_file else "0"
        image.write_bytes(assemble(LOADER)[0] if hex_file else ROM.read_bytes())
        attached = [f"attach ptp {self.tape.name}"]
        if tape := hex_file or reader:
            # (SIMH takes no path with a blank)
            (directory / "reader").write_bytes(tape.read_bytes())
            attached.append("attach ptr reader")
        (directory / "altair.ini").write_text(SCRIPT.format(rom=image.name, start=start, attach="\n".join(attached)))
        assert ALTAIR
        self.pid, self.line = pty.fork()
        if self.pid == 0:
            os.chdir(directory)
            os.execv(ALTAIR, [ALTAIR, "altair.ini"])
        self.paper = b""
        self.until(b"\r\n>")
        self.paper = self.paper[self.paper.index(b"\r\nSKG") :]

    def until(self, end: bytes | tuple[bytes, ...], start: int = 0) -> None:
        """Wait until the paper, from a place on, ends like this (or like one of these)."""
        deadline = time.monotonic() + PATIENCE
        while not self.paper[start:].endswith(end):
            assert time.monotonic() < deadline, f"no {end!r} after {self.paper[-300:]!r}"
            if select.select([self.line], [], [], 0.1)[0]:
                self.paper += os.read(self.line, 4096)

    def press(self, keys: str) -> None:
        """Type keys, and wait for their echo: SIMH keeps them until the board takes them."""
        start, echo = len(self.paper), b"".join(ECHO.get(key, bytes([key])) for key in keys.encode())
        os.write(self.line, keys.encode())
        self.until(echo, start)

    def type(self, line: str) -> str:
        """Types a line and returns the output."""
        self.press(line)
        start = len(self.paper)
        os.write(self.line, b"\r")
        self.until(PROMPT, start)
        return self.paper[start:].decode()

    def punched(self) -> bytes:
        """Leave SIMH, which closes the punch's file."""
        os.write(self.line, CTRL_E)
        self.until(b"sim> ")
        os.write(self.line, b"quit\r")
        with contextlib.suppress(OSError):  # it has gone
            self.until(b"Goodbye\r\n")
        self.close()
        return self.tape.read_bytes()

    def close(self) -> None:
        """End it, whatever it does."""
        if self.pid:
            with contextlib.suppress(ProcessLookupError):
                os.kill(self.pid, signal.SIGKILL)
            os.waitpid(self.pid, 0)
            os.close(self.line)
        self.pid = 0


@contextlib.contextmanager
def altair(directory: Path, reader: Path | None = None, hex_file: Path | None = None) -> Iterator[Altair]:
    """An Altair that is switched off at the end."""
    machine = Altair(directory, reader, hex_file)
    try:
        yield machine
    finally:
        machine.close()


@pytest.mark.parametrize("part", SOME_EXAMPLES, ids=stem)
def test_typed_and_punched(part: Path, tmp_path: Path) -> None:
    """The committed tape, byte for byte, and the same paper as in our emulator."""
    ours = Board(RAM_KIB)
    with altair(tmp_path) as theirs:
        for line in [*part.read_text().splitlines(), "RUN", "LIST", "FREE"]:
            printed = theirs.type(line)
            assert printed == "\r\n" + "".join(f"{text}\r\n" for text in ours.type(line)) + ">", line
        assert theirs.punched() == part.with_suffix(".3b").read_bytes()


@pytest.mark.parametrize("name", ["xy-star", "plate-fillets"])
def test_loaded_from_the_reader(name: str, tmp_path: Path) -> None:
    part = next(part for part in EXAMPLES if part.stem == name)
    with altair(tmp_path, reader=part) as theirs:
        theirs.type("LOAD")
        theirs.type("RUN")
        assert theirs.punched() == part.with_suffix(".3b").read_bytes()


def test_saved(tmp_path: Path) -> None:
    part = EXAMPLES[0]
    with altair(tmp_path) as theirs:
        for line in part.read_text().splitlines():
            theirs.type(line)
        listed = theirs.type("LIST").removesuffix(">").split("\r\n")[1:-1]
        theirs.type("SAVE")
        assert theirs.punched() == saved_tape(listed, "skg")


def test_editing_and_errors(tmp_path: Path) -> None:
    """RUBOUT, ctrl-U, a mark, errors, ctrl-C in a loop, functions to their last digit."""
    ours = Board(RAM_KIB)
    lines = ["10 PRINT )", "PRINT 1/0", "10 GOTO 10", "GOTO 20", "A=P", "PRINT A", "CUT X;Y,X", "BACK", "LIST"]
    lines += [f"PRINT SIN {a},COS {a},TG {a},ATG {a},SQR {a}" for a in (0.001, 1, 29.99, 45, 60.123, 89)]
    with altair(tmp_path) as theirs:
        for line in lines:
            assert theirs.type(line) == "\r\n" + "".join(f"{text}\r\n" for text in ours.type(line)) + ">", line
        assert theirs.type("PRIMX\x7f\x7fNT 3\x15PRIMX\x7f\x7fNT 4") == "\r\n4\r\n>"
        theirs.press("RUN")
        start = len(theirs.paper)
        os.write(theirs.line, b"\r")
        theirs.until(b"\r\n", start)
        os.write(theirs.line, b"\x03")
        theirs.until(b"\r\nERR 10 LINE 10\r\n>", start)


def test_in_ram(tmp_path: Path) -> None:
    """RAM everywhere, nothing at 0: a monitor loads skg-ram.hex and starts it."""
    part = next(part for part in EXAMPLES if part.stem == "xy-star")
    with altair(tmp_path, hex_file=ROM.with_name("skg-ram.hex")) as theirs:
        assert theirs.paper.split()[:2] == [b"SKG", str(int(theirs.type("FREE").split()[0])).encode()]
        for line in [*part.read_text().splitlines(), "RUN"]:
            theirs.type(line)
        assert theirs.punched() == part.with_suffix(".3b").read_bytes()
