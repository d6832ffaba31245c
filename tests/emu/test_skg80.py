"""build/skg80: parts, options, exit codes, ROM images, CP/M programs."""

from __future__ import annotations

import re
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from asm8080 import assemble
from conftest import ROOT, Skg80, monitor

Part = Callable[[str], Path]


def complaint(done: subprocess.CompletedProcess[bytes], code: int) -> str:
    """The one line on standard error that goes with an exit code."""
    text = done.stderr.decode()
    assert done.returncode == code, text
    lines = [line for line in text.split("\n") if line.startswith("skg80: ")]
    assert len(lines) == 1, text
    return lines[0].removeprefix("skg80: ")


# Parts


def test_part_is_loaded_and_run(skg80: Skg80, part: Part) -> None:
    """Punch on standard output, paper on standard error, exit 0; a last line may lack its end."""
    done = skg80(part("PB1B0B1GXL1\nThello\nPDD"))
    assert done.stdout == b"B1B0B1GXL1\nDD\n"
    assert done.stderr == b">L\r\n>R\r\nhello\n>".replace(b">L", b">LOAD").replace(b">R", b">RUN")
    assert done.returncode == 0


def test_run_that_ends_in_an_error(skg80: Skg80, part: Part) -> None:
    """Exit 1; what was punched before it is there; ERR inside a line is none."""
    done = skg80(part("PB1\nEPB2\n"))
    assert (done.returncode, done.stdout) == (1, b"B1\n")
    assert done.stderr.endswith(b"ERR 05\r\n>")
    assert skg80(part("Tno ERR 05\n")).returncode == 0


def test_input_is_answered_line_by_line(skg80: Skg80, part: Part, tmp_path: Path) -> None:
    """In their order, with any line ends; an empty line is an answer."""
    answers = tmp_path / "answers"
    answers.write_bytes(b"one\r\n\nthree")
    done = skg80(part("IIIPDD\n"), "--input", answers)
    assert (done.returncode, done.stdout) == (0, b"one\r\n\r\nthree\r\nDD\n")


@pytest.mark.parametrize("answers", [None, b"", b"one\n"])
def test_input_without_an_answer(skg80: Skg80, part: Part, tmp_path: Path, answers: bytes | None) -> None:
    """Exit 1 and one line."""
    options: list[str | Path] = []
    if answers is not None:
        (tmp_path / "answers").write_bytes(answers)
        options = ["--input", tmp_path / "answers"]
    assert complaint(skg80(part("II"), *options), 1) == "INPUT asks, and --input has no line left"


def test_punch_and_paper_go_to_files(skg80: Skg80, part: Part, tmp_path: Path) -> None:
    """Then standard output and error are empty."""
    done = skg80(part("PB1\n"), "--punch", tmp_path / "p", "--tty", tmp_path / "t")
    assert (done.returncode, done.stdout, done.stderr) == (0, b"", b"")
    assert (tmp_path / "p").read_bytes() == b"B1\n"
    assert (tmp_path / "t").read_bytes() == b">LOAD\r\n>RUN\r\n>"


def test_boards(part: Part, tmp_path: Path) -> None:
    """8251s, and a teletype alone, give the same tape."""
    text = part("PB1\nThello\nPDD\n")
    for board in ("6850", "8251"):
        for alone in (False, True):
            rom = tmp_path / "rom.bin"
            rom.write_bytes(monitor(board, alone))
            done = Skg80(rom)(text, "--board", board, *(["--punch-tty"] if alone else []))
            assert (done.returncode, done.stdout) == (0, b"B1\nDD\n"), (board, alone)


def test_max_cycles(skg80: Skg80, part: Part) -> None:
    """Exit 3, in a loop of the program's or when they just do not suffice."""
    for cycles in ("1", "300000", "20000000"):
        assert complaint(skg80(part("J"), "--max-cycles", cycles), 3) == f"not done after {cycles} cycles"


def test_machine_that_halts_or_waits_for_ever(skg80: Skg80, part: Part) -> None:
    """Exit 1 and where."""
    assert re.fullmatch("the machine halted at 0[0-9A-F]{3}", complaint(skg80(part("H")), 1))
    assert complaint(skg80(part("Tab \nW")), 1) == "the machine waits for a key at ``"


def test_stats(skg80: Skg80, part: Part) -> None:
    """Counts that agree with each other and with the memory map."""
    done = skg80(part("PB1\nB"), "--stats", "--ram", "4")
    report = done.stderr.decode().split(">")[-1].lstrip("\r\n")
    values = re.fullmatch(
        r"cycles +(\d+)\ninstructions +(\d+)\nseconds +([\d.]+) at 2 MHz\n"
        r"RAM +2000 to 2FFF, written up to ([0-9A-F]{4})\nstack +down to ([0-9A-F]{4})\n",
        report,
    )
    assert values, report
    cycles, instructions = int(values[1]), int(values[2])
    assert 4 < cycles / instructions < 18
    assert float(values[3]) == pytest.approx(cycles / 2e6, abs=1e-6)
    assert int(values[4], 16) == 0x2100 + len("PB1\nB\n")  # the tape and its end
    assert 0x27E0 < int(values[5], 16) < 0x2800
    assert b"\nFFFF\r\n" in done.stderr.replace(b"\r\nFFFF", b"\nFFFF")


def test_ram_size(skg80: Skg80, part: Part) -> None:
    """The machine has what was asked for."""
    for kib in ("2", "56"):
        assert skg80(part("PB1\n"), "--ram", kib).returncode == 0


def test_real_time(skg80: Skg80, part: Part) -> None:
    """A machine at 2 MHz cannot be faster than its cycles; a slow line makes it print so many cycles longer."""
    start = time.monotonic()
    fast = skg80(part("PB1\n\x1a"), "--stats", "--mhz", "0.5", "--baud", "9600")
    elapsed = time.monotonic() - start
    cycles = int(re.search(rb"cycles +(\d+)", fast.stderr)[1])
    assert elapsed >= cycles / 0.5e6 * 0.99
    slow = skg80(part("PB1\n\x1a"), "--stats", "--baud", "110")
    slow_cycles = int(re.search(rb"cycles +(\d+)", slow.stderr)[1])
    assert slow_cycles > 13 * 2_000_000 * 11 / 110, "13 characters of paper"


# Wrong usage

USAGE = [
    (["--nonsense"], "--nonsense: no such option; --help lists them"),
    (["-x"], "-x: no such option; --help lists them"),
    (["--rom"], "--rom needs a value"),
    (["--ram", "1"], "--ram 1: not 2 to 56"),
    (["--ram", "8x"], "--ram 8x: not 2 to 56"),
    (["--ram", "-8"], "--ram -8: not 2 to 56"),
    (["--mhz", "0"], "--mhz 0: not 0.001 to 1000"),
    (["--mhz", "nan"], "--mhz nan: not 0.001 to 1000"),
    (["--mhz", "2x"], "--mhz 2x: not 0.001 to 1000"),
    (["--baud", "111"], "--baud 111: not 110, 150, 300, 600, 1200, 2400, 4800 or 9600"),
    (["--baud", "no"], "--baud no: not 110, 150, 300, 600, 1200, 2400, 4800 or 9600"),
    (["--board", "Z80"], "--board Z80: not 6850 or 8251"),
    (["--max-cycles", "0"], "--max-cycles 0: not a number of cycles"),
    (["--max-cycles", "99999999999999999999"], "--max-cycles 99999999999999999999: not a number of cycles"),
    (["a.skg", "b.skg"], "b.skg: one part at a time"),
    (["--pty", "a.skg"], "--pty needs an operator: no part with it"),
    (["--tape", "t", "a.skg"], "the part is the tape: no --tape with it"),
    (["--input", "a"], "--input needs a part"),
    (["--com", "c", "a.skg"], "--com goes with --stats and --max-cycles alone"),
]


@pytest.mark.parametrize(("arguments", "message"), USAGE)
def test_wrong_usage(skg80: Skg80, arguments: list[str], message: str) -> None:
    """Exit 2 and one line."""
    done = skg80(*arguments, rom="--com" not in arguments)
    assert complaint(done, 2) == message
    assert done.stdout == b""


@pytest.mark.parametrize("option", ["", "--rom", "--input", "--com", "--tape"])
@pytest.mark.parametrize(("name", "reason"), [("absent", "No such file or directory"), (".", "Is a directory")])
def test_unreadable_file(skg80: Skg80, part: Part, tmp_path: Path, option: str, name: str, reason: str) -> None:
    """Exit 2, its name and why."""
    path = tmp_path / name
    arguments: list[str | Path] = [option, path] if option else [path]
    if option in ("--input", "--rom"):
        arguments.append(part("PB1\n"))
    done = skg80(*arguments, rom=option in ("", "--input", "--tape"))
    assert complaint(done, 2) == f"{path}: {reason}"


@pytest.mark.parametrize("option", ["--punch", "--tty"])
def test_unwritable_file(skg80: Skg80, part: Part, tmp_path: Path, option: str) -> None:
    """Exit 2, before anything runs, or when the disk is full."""
    path = tmp_path / "no" / "file"
    assert complaint(skg80(part("PB1\n"), option, path), 2) == f"{path}: No such file or directory"
    done = skg80(part("PB1\n"), option, "/dev/full")
    assert complaint(done, 2) == "cannot write: No space left on device"


def test_help_names_every_option(skg80: Skg80) -> None:
    """And nothing but."""
    done = skg80("--help", rom=False)
    source = (ROOT / "emu" / "main.c").read_text()
    options = set(re.findall(r'\{ "([a-z-]+)", (?:no|required)_argument', source))
    assert done.returncode == 0
    assert set(re.findall(r"--([a-z-]+)", done.stdout.decode())) == options
    assert {"rom", "ram", "input", "punch", "tty", "pty", "mhz", "baud", "stats", "max-cycles", "com"} < options


# ROM images


def record(address: int, data: bytes, kind: int = 0) -> str:
    """One Intel hex record."""
    body = bytes([len(data), address >> 8, address & 255, kind]) + data
    return f":{body.hex().upper()}{-sum(body) & 255:02X}\n"


END = ":00000001FF\n"


def hex_file(image: bytes) -> str:
    """An image as Intel hex."""
    return "".join(record(i, image[i : i + 16]) for i in range(0, len(image), 16)) + END


def test_hex_image(part: Part, tmp_path: Path) -> None:
    """The same as the binary; CR LF, blank lines and records that say nothing are fine."""
    rom = tmp_path / "monitor.HEX"
    text = record(0, b"\0\0", 4) + record(0, b"\0\0\0\0", 5) + hex_file(monitor()).lower() + "\n"
    rom.write_bytes(text.replace("\n", "\r\n").encode())
    done = Skg80(rom)(part("PB1\n"))
    assert (done.returncode, done.stdout) == (0, b"B1\n")


BAD_HEX = [
    ("hello\n", ":1: not an Intel hex record"),
    (":00000001F\n", ":1: not an Intel hex record"),
    (":000000\n", ":1: not an Intel hex record"),
    (":" + "00" * 300 + "\n", ":1: not an Intel hex record"),
    (record(0, b"abc") + ":0200000061623A\n" + END, ":2: the checksum is wrong"),
    (":0300000061623A\n" + END, ":1: the record's length is wrong"),
    (record(0x1FFF, b"ab") + END, ":1: data past the end of the ROM"),
    (record(0, b"\0\1", 4) + END, ":1: an address past FFFF"),
    (record(0, b"", 9) + END, ":1: unknown kind of record"),
    (record(0, b"abc"), ": no end record"),
    ("", ": no end record"),
    (END + record(0, b"abc"), ":2: more after the end record"),
    (":00\0" + END, ":1: not a text file"),
]


@pytest.mark.parametrize(("text", "message"), BAD_HEX)
def test_bad_hex_image(tmp_path: Path, text: str, message: str) -> None:
    """Exit 2, the line and what is wrong with it."""
    path = tmp_path / "rom.hex"
    path.write_text(text)
    assert complaint(Skg80(path)(), 2) == f"{path}{message}"


@pytest.mark.parametrize(("size", "message"), [(8193, "more than 8192 bytes"), (0, "empty")])
def test_bad_binary_image(tmp_path: Path, size: int, message: str) -> None:
    """Too long or empty."""
    path = tmp_path / "rom.bin"
    path.write_bytes(bytes(size))
    assert complaint(Skg80(path)(), 2) == f"{path}: {message}"


# CP/M programs


def com(tmp_path: Path, source: str) -> Path:
    """A CP/M program as a file."""
    path = tmp_path / "test.com"
    path.write_bytes(assemble("ORG 100H\n" + source)[0])
    return path


HELLO = """
        LHLD    6               ; the exercisers take their stack from here
        SPHL
        LXI     D,TEXT
        MVI     C,9
        CALL    5
        MVI     E,'!'
        MVI     C,2
        CALL    5
        {end}
TEXT:   DB      "hello$ not this"
"""


@pytest.mark.parametrize("end", ["JMP 0", "RST 0", "MVI C,0\nCALL 5"])
def test_com_program(skg80: Skg80, tmp_path: Path, end: str) -> None:
    """BDOS 2 and 9; ends at 0 or by BDOS 0; the counts are those of the public exercisers' known totals."""
    done = skg80("--com", com(tmp_path, HELLO.format(end=end)), "--stats", rom=False)
    assert (done.returncode, done.stdout) == (0, b"hello!")
    cycles, instructions = (int(n) for n in re.findall(rb"(?:cycles|instructions) +(\d+)", done.stderr))
    before = 16 + 5 + 10 + 7 + 17 + 20 + 7 + 7 + 17 + 20  # to the end; 20: OUT and RET of the BDOS
    last = {"JMP 0": (10 + 10, 2), "RST 0": (11 + 10, 2), "MVI C,0\nCALL 5": (7 + 17 + 10, 3)}[end]
    assert (cycles, instructions) == (before + last[0], 12 + last[1])


def test_com_program_may_return(skg80: Skg80, tmp_path: Path) -> None:
    """Its stack begins with 0000."""
    assert skg80("--com", com(tmp_path, "RET"), rom=False).returncode == 0


def test_com_program_that_fails(skg80: Skg80, tmp_path: Path) -> None:
    """HLT and unknown functions: exit 1; endless: exit 3; too long: exit 2."""
    assert complaint(skg80("--com", com(tmp_path, "NOP\nHLT"), rom=False), 1) == "the program halted at 0101"
    done = skg80("--com", com(tmp_path, "MVI C,15\nCALL 5"), rom=False)
    assert complaint(done, 1) == "BDOS function 15 is not there"
    done = skg80("--com", com(tmp_path, "JMP 100H"), "--max-cycles", "12345", rom=False)
    assert complaint(done, 3) == "not done after 12345 cycles"
    big = tmp_path / "big.com"
    big.write_bytes(bytes(0xC701))
    assert complaint(skg80("--com", big, rom=False), 2) == f"{big}: more than 50944 bytes"
