"""build/skg80: parts, options, exit codes, ROM images, CP/M programs."""

from __future__ import annotations

import os
import random
import re
import shlex
import signal
import subprocess
import sys
import time
import tomllib
import zlib
from collections.abc import Callable
from pathlib import Path

import pytest
from asm8080 import assemble
from emuhelp import ROM_SIZE, ROMS, ROOT, SKG80, Skg80, complaint, without_sign_on
from facthelp import says

from skg.board import Machine, symbols
from skg.board.emulator import read_rom
from skg.errors import UserError
from skg.messages.render import Speech, line

Part = Callable[[str], Path]


# Parts

TWO_LINES = "10 FROM (0,1)\n20 CUT (0,0),(1,0)\n"
BLOCKS = (b"B0B1000B1000GYL4\r\n", b"B1000B0B1000GXL1\r\n")
STOPS = b"DD\r\n"
END = "\x1a"


def test_part_is_loaded_and_run(skg80: Skg80, part: Part) -> None:
    """Punch on standard output, paper on standard error, exit 0; a last line may lack its end."""
    done = skg80(part(TWO_LINES + '30 PRINT "hello"\n40 END'))
    assert done.stdout == b"".join(BLOCKS) + STOPS
    paper = b">LOAD\r\n>RUN\r\n0001 B0B1000B1000GYL4\r\nhello\r\n0002 B1000B0B1000GXL1\r\nDD\r\n>"
    assert without_sign_on(done.stderr) == paper
    assert done.returncode == 0


def test_run_that_ends_in_an_error(skg80: Skg80, part: Part) -> None:
    """Exit 1; what was punched before it is there; ERR inside a line is none."""
    done = skg80(part(TWO_LINES + "30 PRINT A\n"))
    assert (done.returncode, done.stdout) == (1, BLOCKS[0] + b"D\r\n")
    assert done.stderr.endswith(b"ERR 03 LINE 30\r\n>")
    assert skg80(part('10 PRINT "no ERR 05"\n')).returncode == 0


def test_part_that_is_not_understood(skg80: Skg80, part: Part) -> None:
    """LOAD ends in ERR: exit 1, and there is no RUN."""
    done = skg80(part("10 CUT X,,Y\n"))
    assert (done.returncode, done.stdout) == (1, b"")
    assert b"RUN" not in done.stderr


def test_input_is_answered_line_by_line(skg80: Skg80, part: Part, tmp_path: Path) -> None:
    """In their order, with any line ends; an empty line is an answer, if a wrong one."""
    answers = tmp_path / "answers"
    answers.write_bytes(b"1\r\n\n(2,3)")
    done = skg80(part("10 INPUT A\n20 INPUT P\n30 PRINT A,P\n"), "--input", answers)
    assert done.returncode == 0
    assert b"? 1\r\n? \r\n? (2,3)\r\n1 (2,3)\r\n" in done.stderr


@pytest.mark.parametrize("answers", [None, b"", b"1\n"])
def test_input_without_an_answer(skg80: Skg80, part: Part, tmp_path: Path, answers: bytes | None) -> None:
    """Exit 1 and one line."""
    options: list[str | Path] = []
    if answers is not None:
        (tmp_path / "answers").write_bytes(answers)
        options = ["--input", tmp_path / "answers"]
    assert says(complaint(skg80(part("10 INPUT A,P\n"), *options), 1), "INPUT", "--input")


def test_punch_and_paper_go_to_files(skg80: Skg80, part: Part, tmp_path: Path) -> None:
    """Then standard output and error are empty."""
    done = skg80(part(TWO_LINES + "40 END\n"), "--punch", tmp_path / "p", "--tty", tmp_path / "t")
    assert (done.returncode, done.stdout, done.stderr) == (0, b"", b"")
    assert (tmp_path / "p").read_bytes() == b"".join(BLOCKS) + STOPS
    assert without_sign_on((tmp_path / "t").read_bytes()).startswith(b">LOAD\r\n>RUN\r\n0001 B0B1000")


def test_max_cycles(skg80: Skg80, part: Part) -> None:
    """Exit 3, in a loop of the program's or when they just do not suffice."""
    for cycles in ("1", "300000", "20000000"):
        assert says(complaint(skg80(part("10 GOTO 10\n"), "--max-cycles", cycles), 3), f"{cycles} cycles")


def test_machine_that_halts(skg80: Skg80, part: Part, rom_of: Part) -> None:
    """Exit 1 and where."""
    assert says(complaint(skg80("--rom", rom_of("NOP\nNOP\nHLT"), part("10 END\n")), 1), "machine", "halted", "0002")


def test_load_without_a_tape(skg80: Skg80, part: Part) -> None:
    """A part may say LOAD itself, and an operator may forget --tape; nobody waits for ever."""
    assert says(complaint(skg80(part("LOAD\n")), 1), "LOAD", "reader")
    assert says(complaint(skg80(stdin=b"LOAD\n"), 1), "LOAD", "reader")


def test_stats(skg80: Skg80, part: Part) -> None:
    """Counts that agree with each other; what is untouched lies between program and variables."""
    text = '10 A=1\n20 B=O:2\n30 PRINT "hello"\n' + END
    done = skg80(part(text), "--stats", "--ram", "4")
    report = done.stderr.decode().split(">")[-1].lstrip("\r\n")
    values = re.fullmatch(
        r"cycles +(\d+)\ninstructions +(\d+)\nseconds +([\d.]+) at 2 MHz\n"
        r"RAM +2000 to 2FFF, untouched ([0-9A-F]{4}) to ([0-9A-F]{4}): (\d+) bytes\n"
        r"stack +down to ([0-9A-F]{4})\n",
        report,
    )
    assert values, report
    cycles, instructions = int(values[1]), int(values[2])
    assert 4 < cycles / instructions < 18
    assert float(values[3]) == pytest.approx(cycles / 2e6, abs=1e-6)
    first, last, size = int(values[4], 16), int(values[5], 16), int(values[6])
    assert last - first + 1 == size
    m = Machine(ROMS / "skg.bin", 4)
    m.tape(text.replace("\n", "\r\n"))
    m.type("LOAD\rRUN\r")
    assert m.run() == "prompt"
    names = symbols((ROMS / "skg.sym").read_text())
    end_of_program, lowest_variable = m.peek16(names["PEND"]), m.peek16(names["VBOT"])
    assert end_of_program < first < end_of_program + 64, "the route buffer's first bytes"
    assert last == lowest_variable - 1 == 0x2FFF - (2 + 5) - (2 + 15) - 1
    assert names["STKLOW"] <= int(values[7], 16) < names["STKTOP"]


def test_ram_size(skg80: Skg80, part: Part) -> None:
    """The board has what was asked for."""
    free = []
    for kib in ("2", "8", "40"):
        done = skg80(part("10 END\n" + END), "--ram", kib)
        assert done.returncode == 0
        free.append(int(done.stderr.split()[1]))
    assert [free[1] - free[0], free[2] - free[1]] == [6 << 10, 32 << 10]


@pytest.mark.parametrize("mhz", ["20", "2", "1", "0.5"])
def test_real_time(skg80: Skg80, part: Part, mhz: str) -> None:
    """A part ends, and not before its cycles are over: the board asks often enough even in the shortest slice."""
    start = time.monotonic()
    done = skg80(part("10 PRINT 1\n" + END), "--stats", "--mhz", mhz)
    elapsed = time.monotonic() - start
    assert done.returncode == 0
    cycles = int(re.search(rb"cycles +(\d+)", done.stderr)[1])
    assert elapsed >= cycles / (float(mhz) * 1e6) * 0.99


@pytest.mark.parametrize(("rom", "options"), [("skg-8251", ["--board", "8251"]), ("skg-tty", ["--punch-tty"])])
def test_real_time_of_the_other_boards(skg80: Skg80, part: Part, rom: str, options: list[str]) -> None:
    """They wait for the operator in loops of their own."""
    done = skg80(part("10 PRINT 7\n" + END), "--rom", ROMS / f"{rom}.bin", *options, "--mhz", "0.5")
    assert done.returncode == 0
    assert b"\r\n7\r\n" in done.stderr


def test_slow_line_costs_a_part_cycles(skg80: Skg80, part: Part) -> None:
    """Without --mhz no time is kept, but the board waits for its line."""
    done = skg80(part("10 PRINT 1\n" + END), "--stats", "--baud", "110")
    cycles = int(re.search(rb"cycles +(\d+)", done.stderr)[1])
    printed = len(done.stderr.split(b"cycles")[0])
    assert cycles > (printed - 3) * 2_000_000 * 11 / 110


# A ROM for another board

NOT_THIS_BOARD = [
    (["--board", "8251"], ["port 10", "8251", "--board 6850"]),
    (["--rom", ROMS / "skg-8251.bin"], ["port 11", "6850", "--board 8251"]),
    (["--rom", ROMS / "skg-8251.bin", "--punch-tty"], ["port 11", "6850", "--board 8251"]),
    (["--punch-tty"], ["port 12", "--punch-tty", "ROM", "reader"]),
]


@pytest.mark.parametrize(("options", "facts"), NOT_THIS_BOARD)
def test_rom_of_another_board(skg80: Skg80, part: Part, options: list[str | Path], facts: list[str]) -> None:
    """Exit 2 and one line, at once; with a part and at the terminal, where only LOAD asks for the reader."""
    assert says(complaint(skg80(*options, part("10 END\n")), 2), *facts)
    assert says(complaint(skg80(*options, stdin=b"LOAD\n"), 2), *facts)


def test_rom_for_a_teletype_alone_without_one(skg80: Skg80, part: Part) -> None:
    """It waits for the tape at the keyboard."""
    assert says(complaint(skg80("--rom", ROMS / "skg-tty.bin", part("10 END\n")), 1), "key", "tape", "--punch-tty")


def test_port_that_nobody_has(skg80: Skg80, part: Part, rom_of: Part) -> None:
    """Reading one ends it; writing does not."""
    rom = rom_of("OUT 20H\nIN 21H\nHLT")
    message = complaint(skg80("--rom", rom, part("")), 2)
    assert says(message, "port 21") and not says(message, "--board")


def test_half_a_rom(skg80: Skg80, part: Part, tmp_path: Path) -> None:
    """One of two EPROMs: the size is wrong, or the board runs into what is not there."""
    half = tmp_path / "half.bin"
    half.write_bytes((ROMS / "skg.bin").read_bytes()[:4096])
    assert says(complaint(skg80("--rom", half, part("10 END\n")), 2), half, "4096 bytes", 8192)
    lines = (ROMS / "skg.hex").read_text().splitlines(keepends=True)
    half = tmp_path / "half.hex"
    half.write_text("".join([*lines[:256], lines[-1]]))
    message = complaint(skg80("--rom", half, part("10 END\n")), 2)
    assert says(message, re.compile(r"\b1[0-9A-F]{3}\b"), "ROM")


# Wrong usage

BAUD = (110, 150, 300, 600, 1200, 2400, 4800, 9600)
USAGE = [
    (["--nonsense"], ["--nonsense: ", "--help"]),
    (["-x"], ["-x: ", "--help"]),
    (["-xyz"], ["-x: ", "--help"]),
    (["--stats=1"], ["--stats=1: ", "no value"]),
    (["--rom"], ["--rom", "value"]),
    (["--ram", "1"], ["--ram 1: ", 2, 56]),
    (["--ram", "8x"], ["--ram 8x: ", 2, 56]),
    (["--ram", "-8"], ["--ram -8: ", 2, 56]),
    (["--mhz", "0"], ["--mhz 0: ", 0.001, 1000]),
    (["--mhz", "nan"], ["--mhz nan: ", 0.001, 1000]),
    (["--mhz", "2x"], ["--mhz 2x: ", 0.001, 1000]),
    (["--baud", "111"], ["--baud 111: ", *BAUD]),
    (["--baud", "no"], ["--baud no: ", *BAUD]),
    (["--board", "Z80"], ["--board Z80: ", 6850, 8251, "rc2014", "rc2014-sio", "minimax8085", "rcbus8085"]),
    *(
        (["--ports", ports], [f"--ports {ports}: ", "even", "hexadecimal", "drive", "20,22"])
        for ports in ("20", "20,20", "21,24", "14,20", "20,22,24", "")
    ),
    (["--baud", "300", "--baud", "x"], ["--baud x: ", *BAUD]),
    (["--max-cycles", "0"], ["--max-cycles 0: "]),
    (["--max-cycles", "99999999999999999999"], ["--max-cycles 99999999999999999999: "]),
    (["a.skg", "b.skg"], ["b.skg: ", "part"]),
    (["--pty", "a.skg"], ["--pty", "part"]),
    (["--tape", "t", "a.skg"], ["--tape", "part"]),
    (["--input", "a"], ["--input", "part"]),
    (["--com", "c", "a.skg"], ["--com", "--stats", "--max-cycles"]),
]


@pytest.mark.parametrize(("arguments", "facts"), USAGE)
def test_wrong_usage(skg80: Skg80, arguments: list[str], facts: list[object]) -> None:
    """Exit 2 and one line."""
    done = skg80(*arguments)
    assert says(complaint(done, 2), *facts)
    assert done.stdout == b""


@pytest.mark.parametrize("option", ["", "--rom", "--input", "--com", "--tape"])
@pytest.mark.parametrize(("name", "reason"), [("absent", "No such file or directory"), (".", "Is a directory")])
def test_unreadable_file(skg80: Skg80, part: Part, tmp_path: Path, option: str, name: str, reason: str) -> None:
    """Exit 2, its name and why."""
    path = tmp_path / name
    arguments: list[str | Path] = [option, path] if option else [path]
    if option in ("--input", "--rom"):
        arguments.append(part("10 END\n"))
    assert complaint(skg80(*arguments), 2) == f"{path}: {reason}"


@pytest.mark.parametrize("option", ["--punch", "--tty"])
def test_unwritable_file(skg80: Skg80, part: Part, tmp_path: Path, option: str) -> None:
    """Exit 2, before anything runs, or when the disk is full."""
    path = tmp_path / "no" / "file"
    assert complaint(skg80(part("10 END\n"), option, path), 2) == f"{path}: No such file or directory"
    assert says(complaint(skg80(part("10 END\n"), option, "/dev/full"), 2), FULL)
    if option == "--tty":
        assert says(complaint(skg80(option, "/dev/full", stdin=b"PRINT 1\n"), 2), FULL)


FULL = "No space left on device"


@pytest.mark.parametrize("arguments", [["--help"], ["--pty"], [], ["PART"], ["--com", "COM"]])
def test_standard_output_is_full(part: Part, tmp_path: Path, arguments: list[str]) -> None:
    """Exit 2, whatever was to be written there."""
    files = {"PART": part("10 END\n"), "COM": com(tmp_path, HELLO.format(end="RET"))}
    command = [SKG80, *(files.get(argument, argument) for argument in arguments)]
    with Path("/dev/full").open("wb") as full:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=full, stderr=subprocess.PIPE)
    assert says(complaint(done, 2), FULL)


@pytest.mark.parametrize("options", [[], ["--stats", "--tty", "/dev/null"]])
def test_standard_error_is_full(part: Part, options: list[str]) -> None:
    """The paper or the statistics are lost: exit 2, though nobody can be told why."""
    command = [SKG80, *options, part("10 END\n")]
    with Path("/dev/full").open("wb") as full:
        done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=full)
    assert done.returncode == 2


def test_closed_standard_streams(part: Part, tmp_path: Path) -> None:
    """A file that is opened never becomes a standard stream; without standard error the tape is whole."""
    tape, paper = tmp_path / "tape", tmp_path / "paper"
    line = shlex.join(map(str, (SKG80, "--tty", paper, part(TWO_LINES + "30 END"))))
    done = subprocess.run(["sh", "-c", f"{line} >&-"], stderr=subprocess.PIPE)
    assert says(complaint(done, 2), "Bad file descriptor")
    assert b"\nB0B1000B1000GYL4" not in paper.read_bytes()
    for closed in ("2>&-", "<&-", "2>&- <&-"):
        done = subprocess.run(["sh", "-c", f"{line} {closed} > {shlex.quote(str(tape))}"])
        assert (done.returncode, tape.read_bytes()) == (0, b"".join(BLOCKS) + STOPS), closed


@pytest.mark.parametrize("option", ["--punch", "--tty", "--tape", "--rom", "--steps", ""])
def test_a_dash_is_no_file(option: str, tmp_path: Path) -> None:
    """`--punch -` made a file of that name."""
    done = subprocess.run([SKG80, *filter(None, [option]), "-"], cwd=tmp_path, capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (2, "")
    assert says(done.stderr, "skg80: -: ", "/dev/stdin", "/dev/stdout")
    assert not list(tmp_path.iterdir())


def test_no_file_is_overwritten_that_is_in_use(skg80: Skg80, part: Part, tmp_path: Path) -> None:
    """The punch or the paper over the part, the answers, the ROM or the tape; both into one file."""
    text = "10 END\n"
    path, other = part(text), tmp_path / "other"
    other.write_text(text)
    link = tmp_path / "link"
    link.symlink_to(path)
    for options in (["--punch", path], ["--tty", path], ["--punch", link], ["--input", other, "--tty", other]):
        name = options[-1]
        assert says(complaint(skg80(path, *options), 2), f"{name}: ", "two")
    both = tmp_path / "both"
    assert says(complaint(skg80(path, "--punch", both, "--tty", both), 2), f"{both}: ", "two")
    assert says(complaint(skg80("--tape", path, "--punch", path), 2), f"{path}: ", "two")
    assert path.read_text() == other.read_text() == text
    assert not both.exists()
    assert skg80(path, "--punch", "/dev/null", "--tty", "/dev/null").returncode == 0


@pytest.mark.parametrize("name", ["empty", "noise", "nothing but NUL", "one long line", "full of LF"])
def test_files_that_are_no_program(skg80: Skg80, tmp_path: Path, name: str) -> None:
    """As a part, a tape and as answers: it ends, and the exit code says how."""
    content = {
        "empty": b"",
        "noise": random.Random(7).randbytes(20000),
        "nothing but NUL": bytes(100000),
        "one long line": b"1" * 100000,
        "full of LF": b"\n" * 2000,
    }[name]
    path = tmp_path / "file"
    path.write_bytes(content)
    expected = {"noise": 2, "one long line": 1}.get(name, 0)
    assert skg80(path).returncode == expected
    assert skg80("--tape", path, stdin=b"LOAD\n").returncode == expected
    asks = tmp_path / "asks.skg"
    asks.write_text("10 INPUT A\n")
    assert skg80("--input", path, asks).returncode == (expected or 1)


def test_help_names_every_option(skg80: Skg80) -> None:
    """And nothing but."""
    done = skg80("--help")
    source = (ROOT / "emu" / "options.c").read_text()
    options = set(re.findall(r'\{ "([a-z-]+)", +(?:FLAG|TEXT|VALUE|HELP|VERSION)', source))
    assert done.returncode == 0
    assert set(re.findall(r"--([a-z-]+)", done.stdout.decode())) == options
    assert b"ctrl-] leaves" in done.stdout
    assert {"rom", "ram", "input", "punch", "tty", "pty", "mhz", "baud", "stats", "max-cycles", "com"} < options


def test_version(skg80: Skg80) -> None:
    """The package's, and which ROM is built in."""
    version = tomllib.loads((ROOT / "tools" / "pyproject.toml").read_text())["project"]["version"]
    rom = f"ROM skg.bin, CRC-32 {zlib.crc32((ROOT / 'roms' / 'skg.bin').read_bytes()):08X}\n"
    assert skg80("--version").stdout.decode() == f"skg80 {version}, {rom}"
    done = subprocess.run([Path(sys.executable).with_name("skg"), "--version"], capture_output=True, text=True)
    assert done.stdout == f"skg {version}, {rom}"


# ROM images


def record(address: int, data: bytes, kind: int = 0) -> str:
    """One Intel hex record."""
    body = bytes([len(data), address >> 8, address & 255, kind]) + data
    return f":{body.hex().upper()}{-sum(body) & 255:02X}\n"


LAST = ":00000001FF\n"


def hex_file(image: bytes) -> str:
    """An image as Intel hex."""
    return "".join(record(i, image[i : i + 16]) for i in range(0, len(image), 16)) + LAST


def test_hex_image(skg80: Skg80, part: Part, tmp_path: Path) -> None:
    """The same as the binary; CR LF, blank lines, records that say nothing and an empty end of the ROM are fine."""
    image = (ROMS / "skg.bin").read_bytes().rstrip(b"\xff")
    rom = tmp_path / "skg.HEX"
    text = record(0, b"\0\0", 4) + record(0, b"\0\0\0\0", 5) + hex_file(image).lower() + "\n"
    rom.write_bytes(text.replace("\n", "\r\n").encode())
    done = skg80("--rom", rom, part(TWO_LINES + "30 END\n"))
    assert (done.returncode, done.stdout) == (0, b"".join(BLOCKS) + STOPS)


BAD_HEX = [
    ("hello\n", [":1:", "Intel hex"]),
    (":00000001F\n", [":1:", "Intel hex"]),
    (":000000\n", [":1:", "Intel hex"]),
    (":" + "00" * 300 + "\n", [":1:", "Intel hex"]),
    (record(0, b"abc") + ":0200000061623A\n" + LAST, [":2:", "checksum"]),
    (":0300000061623A\n" + LAST, [":1:", "length"]),
    (record(0x1FFF, b"ab") + LAST, [":1:", "ROM"]),
    (record(0, b"\0\1", 4) + LAST, [":1:", "address", "FFFF"]),
    (record(0, b"", 9) + LAST, [":1:", "kind"]),
    (record(0, b"abc"), [": ", "no end"]),
    ("", [": ", "no end"]),
    (LAST + record(0, b"abc"), [":2:", "end record"]),
    (":00\0" + LAST, [":1:", "text"]),
]


@pytest.mark.parametrize(("text", "facts"), BAD_HEX)
def test_bad_hex_image(skg80: Skg80, tmp_path: Path, text: str, facts: list[str]) -> None:
    """Exit 2, the line and what is wrong with it; the finding of `skg` is the same."""
    path = tmp_path / "rom.hex"
    path.write_text(text)
    where, *what = facts
    wrong = complaint(skg80("--rom", path), 2)
    assert says(wrong, f"{path}{where}", *what)
    with pytest.raises(UserError) as caught:
        read_rom(str(path))
    assert wrong.removeprefix("skg80: ").strip() == line(caught.value.finding, Speech("en"))


@pytest.mark.parametrize("size", [0, 1, ROM_SIZE - 1, ROM_SIZE + 1])
def test_bad_binary_image(skg80: Skg80, tmp_path: Path, size: int) -> None:
    """Too long, too short or empty."""
    path = tmp_path / "rom.bin"
    path.write_bytes(bytes(size))
    assert says(complaint(skg80("--rom", path), 2), f"{path}: ", f"{size} bytes", ROM_SIZE)


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
    done = skg80("--com", com(tmp_path, HELLO.format(end=end)), "--stats")
    assert (done.returncode, done.stdout) == (0, b"hello!")
    cycles, instructions = (int(n) for n in re.findall(rb"(?:cycles|instructions) +(\d+)", done.stderr))
    before = 16 + 5 + 10 + 7 + 17 + 20 + 7 + 7 + 17 + 20  # to the end; 20: OUT and RET of the BDOS
    last = {"JMP 0": (10 + 10, 2), "RST 0": (11 + 10, 2), "MVI C,0\nCALL 5": (7 + 17 + 10, 3)}[end]
    assert (cycles, instructions) == (before + last[0], 12 + last[1])


def test_com_program_may_return(skg80: Skg80, tmp_path: Path) -> None:
    """Its stack begins with 0000."""
    assert skg80("--com", com(tmp_path, "RET")).returncode == 0


def test_com_program_that_fails(skg80: Skg80, tmp_path: Path) -> None:
    """HLT and unknown functions: exit 1; endless: exit 3; too long: exit 2."""
    assert says(complaint(skg80("--com", com(tmp_path, "NOP\nHLT")), 1), "program", "halted", "0101")
    done = skg80("--com", com(tmp_path, "MVI C,15\nCALL 5"))
    assert says(complaint(done, 1), "BDOS", 15)
    done = skg80("--com", com(tmp_path, "JMP 100H"), "--max-cycles", "12345")
    assert says(complaint(done, 3), "12345 cycles")
    big = tmp_path / "big.com"
    big.write_bytes(bytes(0xC701))
    assert says(complaint(skg80("--com", big), 2), big, "50944 bytes")


def test_a_tape_has_its_name_when_it_has_its_end(skg80: Skg80, part: Part, tmp_path: Path) -> None:
    """Until then the one before is there, and what was punched is a part; a link is followed; one that drives, or says
    nothing, punches none."""
    tape, link, kept = tmp_path / "tape", tmp_path / "link", tmp_path / "tape.part"
    tape.write_bytes(b"old")
    link.symlink_to(tape)
    done = skg80(part(TWO_LINES + "40 A=1/0\n"), "--punch", link)
    assert done.returncode == 1 and says(done.stderr.decode(), kept)
    assert tape.read_bytes() == b"old" and kept.read_bytes() == BLOCKS[0] + b"D\r\n"
    assert skg80(part(TWO_LINES + "40 END\n"), "--punch", link).returncode == 0
    assert tape.read_bytes() == b"".join(BLOCKS) + STOPS and link.is_symlink() and not kept.exists()
    assert skg80("--punch", tape, stdin=b"PRINT 1\n").returncode == 0
    assert tape.read_bytes() == b"".join(BLOCKS) + STOPS and not kept.exists()
    lines = "".join(line.partition(" ")[2] for line in TWO_LINES.splitlines(keepends=True)) + "END\n"
    assert skg80("--punch", tape, stdin=(2 * lines).encode()).returncode == 0
    punched = tape.read_bytes()
    assert punched.startswith(b"".join(BLOCKS) + STOPS) and punched.count(STOPS) == 2 and punched.endswith(STOPS)
    assert skg80("--punch", tape, stdin=b"10 END\nSAVE\n").returncode == 0
    assert tape.read_bytes().startswith(b"10 END\r\n") and not kept.exists()


@pytest.mark.parametrize("how", ["SIGTERM", "SIGHUP", "SIGKILL"])
def test_ended_in_the_middle_of_a_tape(part: Part, tmp_path: Path, how: str) -> None:
    """The old tape is there still, and whole lines of the new one as a part."""
    tape, kept = tmp_path / "tape", tmp_path / "tape.part"
    tape.write_bytes(b"old")
    command = [SKG80, part(TWO_LINES + "40 GOTO 40\n"), "--punch", tape, "--tty", os.devnull]
    with subprocess.Popen(command, stdin=subprocess.DEVNULL) as process:
        while not (kept.exists() and kept.read_bytes() == BLOCKS[0]):
            assert process.poll() is None
            time.sleep(0.01)
        process.send_signal(getattr(signal, how))
    assert process.returncode == -getattr(signal, how)
    assert tape.read_bytes() == b"old" and kept.read_bytes() == BLOCKS[0]


WRITTEN = ["--punch", "--tty", "--steps", "--drive", "--trace"]


@pytest.mark.parametrize("option", WRITTEN)
def test_old_file_stays_until_there_is_another(skg80: Skg80, part: Part, tmp_path: Path, option: str) -> None:
    """A run that never begins takes nothing away; one that ends leaves no part."""
    path, kept, other = tmp_path / "x.svg", tmp_path / "x.svg.part", tmp_path / "other"
    program = part(TWO_LINES + "40 END\n")
    other.write_bytes(b"other")
    path.write_bytes(b"old")
    words = ["--rom", ROMS / "skg-drive.bin", option, path]
    for wrong in (
        [tmp_path / "absent"],
        ["--input", tmp_path / "absent", program],
        ["--baud", "9600", "--pty", program],
    ):
        assert skg80(*words, *wrong).returncode == 2
        assert path.read_bytes() == b"old" and not kept.exists()
    # (an older part may be a link to something else)
    kept.hardlink_to(other)
    assert skg80(*words, program).returncode == 0
    assert path.read_bytes() != b"old" and not kept.exists() and other.read_bytes() == b"other"


@pytest.mark.parametrize("option", WRITTEN)
def test_not_onto_a_file_by_its_part(skg80: Skg80, part: Part, tmp_path: Path, option: str) -> None:
    """Neither one that is read, nor another that is written."""
    program = part(TWO_LINES + "40 END\n").rename(tmp_path / "x.svg.part")
    other = "--tty" if option != "--tty" else "--punch"
    for words in ([option, tmp_path / "x.svg", program], [option, "y.svg", other, "y.svg.part", program]):
        assert says(complaint(skg80(*words), 2), "two")
    assert program.read_text().startswith(TWO_LINES)


def test_two_write_one_file(skg80: Skg80, part: Part, tmp_path: Path) -> None:
    """The second would get the first one's name for its own part."""
    tape, kept = tmp_path / "tape", tmp_path / "tape.part"
    command = [SKG80, part(TWO_LINES + "40 GOTO 40\n"), "--punch", tape, "--tty", os.devnull]
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL)
    try:
        while not (kept.exists() and kept.read_bytes() == BLOCKS[0]):
            assert process.poll() is None
            time.sleep(0.01)
        assert says(complaint(skg80("--punch", tape, part("10 END\n")), 2), f"{tape}: ", "busy")
        assert kept.read_bytes() == BLOCKS[0]
    finally:
        process.kill()
        process.wait()


def test_ended_in_the_middle_of_steps(part: Part, tmp_path: Path) -> None:
    """Half of the steps do not pass for all of them."""
    steps, picture, kept = tmp_path / "s", tmp_path / "s.svg", tmp_path / "s.part"
    for path in (steps, picture):
        path.write_bytes(b"old")
    command = [SKG80, "--rom", ROMS / "skg-drive.bin", "--steps", steps, "--drive", picture]
    with subprocess.Popen(
        [*command, part(TWO_LINES + "40 GOTO 40\n")],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    ) as process:
        while not (kept.exists() and kept.stat().st_size):
            assert process.poll() is None
            time.sleep(0.01)
        process.terminate()
    assert steps.read_bytes() == picture.read_bytes() == b"old"
