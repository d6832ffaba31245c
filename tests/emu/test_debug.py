"""skg80 --debug, --break, --trace, --sym as programs: options, bad input, terminal and signals; the disassembler."""

from __future__ import annotations

import random
import re
import resource
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from asm8080 import assemble
from emuhelp import ROM_SIZE, ROMS, ROOT, SKG80, TIMEOUT, Skg80, complaint
from facthelp import each_says, says
from test_terminal import Screen

Part = Callable[[str], Path]
#: The undocumented duplicates and what they do.
DUPLICATES = dict.fromkeys(range(0x08, 0x40, 8), 0x00)
DUPLICATES |= {0xCB: 0xC3, 0xD9: 0xC9, 0xDD: 0xCD, 0xED: 0xCD, 0xFD: 0xCD}
END = "10 END\n\x1a"


def said(done: subprocess.CompletedProcess[bytes], *commands: str) -> list[str]:
    """The answer to each command."""
    text = done.stderr.decode().replace("\r\n", "\n")
    answers = []
    for command in commands:
        before, echo, text = text.partition(f"debug> {command}\n")
        assert echo, text
        answers.append(before)
    return [*answers[1:], text.partition("debug> ")[0]]


def test_disassembly_assembles_again(skg80: Skg80, part: Part, tmp_path: Path) -> None:
    """Every opcode with operands behind it: the tests' own assembler makes the same bytes of the text."""
    codes = [bytes([opcode, 0x34, 0x92]) for opcode in range(256)]
    rom = tmp_path / "rom.bin"
    rom.write_bytes(b"".join(codes).ljust(ROM_SIZE, b"\0"))
    commands = [f"list {3 * opcode:X} 1" for opcode in range(256)]
    done = skg80("--rom", rom, "--debug", part(END), stdin="\n".join([*commands, ""]).encode())
    assert done.returncode == 0
    for code, answer in zip(codes, said(done, *commands), strict=True):
        opcode = DUPLICATES.get(code[0], code[0])
        at, place, text = answer.strip().split(None, 2)
        assert at == place == f"{3 * code[0]:04X}", "no names are known of this ROM"
        source = re.sub(r"(?<=[ ,])([0-9A-F]{2}|[0-9A-F]{4})$", r"0\1H", text)
        made = assemble(source)[0]
        assert made == bytes([opcode, *code[1:]])[: len(made)], text
        assert len(made) == (3 if "9234" in text else 2 if "34" in text else 1)


def test_without_names(skg80: Skg80, part: Part) -> None:
    """A ROM that has no .sym file beside it: addresses are numbers, the calculator is not known, and that is said."""
    commands = ["operation", "code", "floats", "m", "break 3", "break", "list", "stack"]
    done = skg80("--rom", ROMS / "skg-tty.bin", "--punch-tty", "--debug", part(END), stdin="\n".join(commands).encode())
    assert says(complaint(done, 0), ".sym", "ROM", "--sym")
    answers = said(done, *commands)
    assert each_says(answers[:4], *[("symbol", "calculator")] * 4)
    assert answers[5] == "0003 0003\n"
    named = ["--rom", ROMS / "skg-tty.bin", "--punch-tty", "--sym", ROMS / "skg.sym", "--break", "PEEK0", part(END)]
    assert skg80(*named).returncode == 0


BAD = [
    (["--break", "NOWHERE"], ["--break NOWHERE", "place"]),
    (["--break", "10000"], ["--break 10000", "place"]),
    (["--break", "PEEK0+"], ["--break PEEK0+:", "place"]),
    (["--break", "PEEK0+x"], ["--break PEEK0+x:", "place"]),
    (["--break", ""], ["--break :", "place"]),
    (["--break", "ERANGE"], ["--break ERANGE", "place"]),  # an equate is none
    (["--debug", "--sym", "ABSENT"], ["ABSENT: No such file or directory"]),
    (["--debug", "--sym", "EMPTY"], ["EMPTY", "symbol"]),
    (["--debug", "--sym", "WRONG"], ["WRONG:2", "symbol"]),
    (["--sym", "EMPTY"], ["--sym", "--debug", "--break", "--trace"]),
    (["--trace", "ABSENT/x"], ["ABSENT/x: No such file or directory"]),
    (["--trace", "/dev/full"], ["No space left on device"]),
    (["--trace", "PART"], ["PART", "two"]),
    (["--break", "1"] * 17, ["--break 1", 16]),
    (["--rom", ROMS / "skg-tty.bin", "--break", "PEEK0"], ["--break PEEK0", "place", ".sym", "ROM", "--sym"]),
]  # fmt: skip


@pytest.mark.parametrize(("options", "facts"), BAD)
def test_bad_input(skg80: Skg80, part: Part, tmp_path: Path, options: list[str | Path], facts: list[object]) -> None:
    """Exit 2 and one line."""
    path = part(END)
    (tmp_path / "EMPTY").write_text("")
    (tmp_path / "WRONG").write_text("0000 ONE\nhello\n")
    files = {"PART": path, **{name: tmp_path / name for name in ("ABSENT", "EMPTY", "WRONG", "ABSENT/x")}}
    done = skg80(*(files.get(str(option), option) for option in options), path)
    found = complaint(done, 2)
    for name, file in files.items():
        found = found.replace(str(file), name)
    assert says(found, *facts)
    assert path.read_text() == END


def test_needs_somebody_to_talk_to(skg80: Skg80) -> None:
    """From a pipe come keys or commands, not both."""
    for options in (["--debug"], ["--break", "PEEK0"]):
        assert says(complaint(skg80(*options, stdin=b"PRINT 1\n"), 2), "--debug", "--break", "--pty", "terminal")


def test_symbol_file_that_lacks_the_calculator(skg80: Skg80, part: Part, tmp_path: Path) -> None:
    """One line says what is missing; the rest works."""
    names = tmp_path / "names.sym"
    names.write_text("0000 START start\n0030 PEEK start\n2000 CELL\n")
    done = skg80("--debug", "--sym", names, part(END), stdin=b"m\nbreak peek\nlist cell 1\n")
    assert says(complaint(done, 0), "CALC1", "calculator")
    assert each_says(said(done, "m")[0], ("symbol", "calculator"))


WRONG_COMMANDS = {
    "nonsense": ("nonsense: ", "command", "help"),
    "step 0": ("0: ", 1),
    "step -1": ("-1: ", 1),
    "step 1x": ("1x: ", 1),
    "break NOWHERE": ("NOWHERE: ", "place"),
    "delete PEEK0": ("PEEK0: ", "breakpoint"),
    "delete NOWHERE": ("NOWHERE: ", "place"),
    "list NOWHERE": ("NOWHERE: ", "place"),
    "list 0 x": ("x: ", 1),
    "memory G000": ("G000: ", "place"),
    "m NOTHING": ("NOTHING: ", "register"),
    "m M64": ("M64: ", "register"),
    "code": ("calculator", "operation"),
    "trace /nowhere/x": ("/nowhere/x: No such file or directory",),
    "x" * 1000: ("x" * 255 + ": ", "command", "help"),
}


def test_wrong_commands(skg80: Skg80, part: Part) -> None:
    """One line each, and the next command is asked for."""
    done = skg80("--debug", part(END), stdin="\n".join([*WRONG_COMMANDS, "quit", ""]).encode())
    assert done.returncode == 0
    text = done.stderr.decode().replace("\r\n", "\n")
    for command, facts in WRONG_COMMANDS.items():
        answer = text.partition(f"debug> {command[:255]}\n")[2].partition("debug> ")[0]
        assert each_says(answer, facts)


def test_help_lists_every_command(skg80: Skg80, part: Part) -> None:
    """As the source has them; each can be cut short to what help shows first."""
    source = (ROOT / "emu" / "commands.c").read_text()
    names = re.findall(r'^    \{ "(\w+)", ', source, re.M)
    done = skg80("--debug", part(END), stdin=b"help\n")
    listed = re.findall(r"^(\w+) {2,}", said(done, "help")[0], re.M)
    assert listed == names and len(names) > 12


def test_empty_line_repeats(skg80: Skg80, part: Part) -> None:
    """The last command, with its words."""
    done = skg80("--debug", part(END), stdin=b"step 2\n\n\n  \n")
    cycles = [int(n) for n in re.findall(r"^(\d+) [0-9A-F]{4} ", done.stderr.decode(), re.M)]
    assert len(cycles) == 5 and cycles == sorted(set(cycles))


def test_quit_and_end_of_input_leave(skg80: Skg80, part: Part) -> None:
    """Exit 0, nothing more is done, and what was punched is there."""
    text = part("10 CUT O,(1,0),(1,1)\n20 PRINT 1\n30 PRINT 2\n" + "\x1a")
    for end in (b"quit\n", b""):
        done = skg80("--break", "SPRINT", text, stdin=b"continue\ncontinue\n" + end)
        assert (done.returncode, done.stdout) == (0, b"B1000B0B1000GXL1\r\n")
        assert b"\r\n2\r\n" not in done.stderr


def test_trace_from_the_debugger(skg80: Skg80, part: Part, tmp_path: Path) -> None:
    """From one stop to the next."""
    path = tmp_path / "trace"
    skg80("--debug", part(END), stdin=f"step 10\ntrace {path}\nstep 7\ntrace\nstep 5\n".encode())
    assert len(path.read_text().splitlines()) == 7


def test_trace_changes_nothing(skg80: Skg80, part: Part, tmp_path: Path) -> None:
    """Cycles, tape and paper are the same; the last line is the last instruction."""
    text = part("10 CUT O,(1,0),(1,1)\n20 BACK\n\x1a")
    plain, traced = skg80(text, "--stats"), skg80(text, "--stats", "--trace", tmp_path / "trace")
    assert (traced.stdout, traced.stderr, traced.returncode) == (plain.stdout, plain.stderr, plain.returncode)
    cycles = int(re.search(rb"cycles +(\d+)", plain.stderr)[1])
    assert 0 < cycles - int((tmp_path / "trace").read_text().splitlines()[-1].split()[0]) < 20


def test_terminal() -> None:
    """ctrl-^ stops the board; commands are typed as lines; it goes on with its keys; quit leaves."""
    s = Screen("--break", "SPRINT")
    try:
        s.expect(b"asks what to do\r\n")
        s.expect(b">")
        assert s.is_raw()
        s.keys(b"\x1e")
        s.expect(b"debug> ")
        assert not s.is_raw()
        s.keys(b"break\n")
        s.expect(b" SPRINT\r\n")
        s.expect(b"debug> ")
        s.keys(b"continue\n")
        s.wait_for("is_raw")
        s.keys(b"PRINT 1+1\r")
        for _ in range(2):  # it is checked, then carried out
            s.expect(b"debug> ")
            s.keys(b"continue\n")
        s.expect(b"\n2\r\n>")
        s.keys(b"\x1e")
        s.expect(b"debug> ")
        s.keys(b"quit\n")
        assert s.process.wait(TIMEOUT) == 0
        assert s.is_restored()
    finally:
        s.close()


def test_interrupt_asks(part: Part) -> None:
    """ctrl-C while a part runs: the next command."""
    command = [SKG80, "--break", "SGOTO", part("10 GOTO 10\n\x1a")]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL)
    assert process.stdin and process.stderr
    process.stdin.write(b"continue\ndelete\ncontinue\n")  # checked while it is loaded, then carried out
    process.stdin.flush()
    seen = b""
    while seen.count(b"debug> continue") < 2:
        seen += process.stderr.read(1)
    time.sleep(0.2)
    process.send_signal(signal.SIGINT)
    process.stdin.write(b"break\nquit\n")
    process.stdin.close()
    rest = process.stderr.read()
    process.stderr.close()
    assert process.wait(TIMEOUT) == 0
    assert b"debug> break\ndebug> quit\n" in rest


AT_THE_EDGES = [
    "list FFFF 20", "list FFFD", "memory FFF8 100000", "code FFFE 9", "code 0 1000", "stack", "step 3", "stack",
    "floats", "m", "next", "next", "up", "break FFFF", "operation 3", "code", "floats", "registers", "help",
]  # fmt: skip


def test_sanitizers_find_nothing(part: Part, tmp_path: Path) -> None:
    """The debugger where addresses end, and the trace, built with the address and undefined behaviour sanitizers."""
    for extra in ([], ["--trace", tmp_path / "trace"], ["--rom", ROMS / "skg-nodrift.hex"]):
        command = [ROOT / "build" / "asan" / "skg80", "--debug", *extra, part("10 CUT O,(1,0),(1,1)\n\x1a")]
        done = subprocess.run(command, input="\n".join(AT_THE_EDGES).encode(), capture_output=True)
        assert done.returncode == 0, done.stderr
        assert b"Sanitizer" not in done.stderr and b"runtime error" not in done.stderr


def processor_time(*arguments: str | Path) -> float:
    """Seconds of this host's processor that a run takes, the least of some."""
    least = float("inf")
    for _ in range(5):
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        subprocess.run([SKG80, *arguments], capture_output=True)
        least = min(least, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before)
    return least


def test_a_breakpoint_leaves_the_board_its_speed(part: Part) -> None:
    """One that is never reached: the board still runs free, but for a look at each operation of the calculator."""
    options = ["--max-cycles", "500000000", part("10 A=1\n20 GOTO 10\n\x1a")]
    assert processor_time("--break", "1FFF", *options) < 4 * processor_time(*options)


def test_core_and_board_know_nothing_of_it() -> None:
    """So there is nothing that could slow them down when nobody looks."""
    for name, own in (
        ("i8080", {"i8080.h", *(f"i8080_{part}.h" for part in ("fast", "host", "ops", "small", "words"))}),
        ("board", {"board.h", "drive.h", "i8080.h"}),
    ):
        for path in (ROOT / "emu").glob(f"{name}*.[ch]"):
            assert set(re.findall(r'#include "(.*)"', path.read_text())) <= own, path


def test_sanitizers_find_nothing_in_names(part: Part, tmp_path: Path) -> None:
    """Damaged files of names, and the debugger's own commands, under the sanitizers: read or refused."""
    chance, names = random.Random(7), (ROMS / "skg.sym").read_bytes()
    commands = b"list\noperation\ncode\nfloats\nbreak PEEK0\nstack\nm\nstep\nlist FFFF\nbreak\n"
    sym = tmp_path / "odd.sym"
    for _ in range(40):
        made = bytearray(names)
        for _ in range(chance.randint(1, 30)):
            at = chance.randrange(len(made))
            kind = chance.randrange(4)
            if kind == 0:
                made[at] = chance.randrange(256)
            elif kind == 1:
                del made[at : at + chance.randint(1, 200)]
            elif kind == 2:
                made[at:at] = chance.choice([b"X" * 5000, b"\n" * 50, b" \0", b"= $FFFFFFFFF", b"-1"])
            else:
                made[at:at] = made[at : at + chance.randint(1, 3000)]
        sym.write_bytes(made)
        command = ["build/asan/skg80", "--debug", "--sym", sym, "--max-cycles", "200000", part(END)]
        done = subprocess.run(command, input=commands, capture_output=True)
        assert done.returncode in (0, 1, 2, 3), done.stderr[-2000:]
