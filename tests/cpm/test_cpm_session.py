"""SKG.COM at its prompt: as the board does, keys, files, what is left alone."""

from __future__ import annotations

import sys

import cpm80
import pytest
from cpmhelp import EXAMPLES, PROCESSORS, PROGRAM, ROOT, SMALL, Cpm, text

import skg

STAR = ROOT / "examples" / "xy-star.skg"
sys.path.insert(0, str(ROOT / "asm"))
import build  # noqa: E402

LOOP = "10 PRINT 1\n20 GOTO 10\n"


@pytest.fixture
def cpm() -> Cpm:
    """A machine with xy-star as STAR.SKG, SKG at its prompt."""
    machine = Cpm(files={"STAR.SKG": text(STAR.read_text())})
    machine.skg()
    return machine


@pytest.mark.parametrize("processor", PROCESSORS)
def test_paper(processor: str) -> None:
    """Statements, numbers, errors and their marks: what the board prints."""
    cpm, board = Cpm(processor), skg.Board((ROOT / "roms" / "skg.bin").read_bytes())
    cpm.skg()
    board.clear()
    lines = [*(f"PRINT SQR {n},1/{n},{n}*{n},SIN {n},ATG {n}" for n in (2, 3, 7, 0.001, 12345.678, 1e12))]
    lines += ["10 P1=(1.5,-2E-7)#90", "20 C1=(3,4):5;1", "20 C[I+1]=(3,4):5", "LIST", "PRINT 1+", "FOO", "PRINT 1/0"]
    lines += ["GOTO 7", "5 I=1", "30 CUT C[2]", "40 BACK", "50 SIN", "60 RUN", "RUN", "LIST 20,30", "20", "RUN", "BACK"]
    for line in lines:
        assert cpm.said(line) == board.type(line), line
    assert cpm.said("1 REM " + "x" * 121)[-1:] == board.type("1 REM " + "x" * 121)[-1:]


def nested(depth: int) -> str:
    """An expression with a left operand waiting at each depth."""
    return f"PRINT {'1+(' * depth}2{')' * depth}"


def test_others_may_use_the_stack() -> None:
    """Expressions nest as deeply as on the board, where something takes 200 bytes of the stack at any time."""
    cpm, board = Cpm(), skg.Board((ROOT / "roms" / "skg.bin").read_bytes())
    cpm.skg()
    board.clear()
    depth = max(n for n in range(1, 29) if cpm.said(nested(n)) == [str(n + 2)])
    assert depth < 28
    for n in (depth, depth + 1):
        assert cpm.said(nested(n)) == board.type(nested(n))
    labels = build.build("skg.com")["skg.com"].symbols
    cpm.machine.interrupted_at(labels["OPFLT"], 200)
    assert cpm.said(f"{nested(depth)},3") == [f"{depth + 2} 3"]
    assert cpm.machine.interrupts > depth


def test_free_bytes() -> None:
    """Up to the BDOS's page, D800 here; a line and a variable take of it what they take on the board."""
    cpm = Cpm()
    free = int(cpm.type("SKG").split("SKG ")[1].split()[0])
    assert 40_000 < free < 0xD800 - 0x100 - PROGRAM.stat().st_size
    cpm.said("10 END")
    cpm.said("A=1")
    assert cpm.said("FREE") == [str(free - 6 - 7)]


def test_too_little_memory() -> None:
    """Something resident ends the memory at 2D06: SKG says so, and CP/M goes on."""
    cpm = Cpm()
    memory = cpm.machine.memory
    memory[0x2D06:0x2D09] = memory[5:8]
    memory[6:8] = bytes([0x06, 0x2D])
    assert "SKG: too little memory" in cpm.type("SKG")
    assert cpm.at_cpm


def test_page_zero_is_given_back() -> None:
    """No restart is taken, and BYE leaves CP/M as it was."""
    cpm = Cpm()
    memory = cpm.machine.memory
    before = bytes(memory[:8])
    memory[8:0x40] = bytes(range(8, 0x40))
    cpm.skg()
    assert bytes(memory[3:0x40]) == before[3:] + bytes(range(8, 0x40))
    assert bytes(memory[:3]) != before[:3]
    cpm.said("PRINT SQR 2")
    cpm.type("BYE")
    assert cpm.at_cpm
    assert bytes(memory[:0x40]) == before + bytes(range(8, 0x40))


def test_answers(cpm: Cpm) -> None:
    """INPUT asks, and asks again."""
    for line in ("10 INPUT A,P", "20 PRINT A,P"):
        cpm.said(line)
    assert cpm.type("RUN") == "\r\n? "
    assert cpm.type("1+1") == "\r\n? "
    assert cpm.type("(2,") == "\r\n? "
    assert cpm.said("(2,3)") == ["2 (2,3)", "DD"]


# Keys


def test_editing(cpm: Cpm) -> None:
    """RUBOUT, backspace, ctrl-U; keys that mean nothing."""
    assert cpm.type("PRIMX\x7f\x08NT 3\x15PRIMX\x7f\x7fNT\t 4").endswith("\r\n4\r\n>")


def test_keys_wait_while_a_program_runs(cpm: Cpm) -> None:
    """Keys typed ahead, RUN's own line end included, come to the prompt in their order; none is lost."""
    cpm.said("10 PRINT 1")
    assert cpm.type("RUN\rPRINT 2\rPRINT 3").split("\r\n")[-5:] == [">PRINT 2", "2", ">PRINT 3", "3", ">"]


def test_keys_wait_while_a_file_is_loaded(cpm: Cpm) -> None:
    cpm.write("TALKS.SKG", text("PRINT 5\n10 REM\nPRINT 6\n"))
    assert cpm.type('LOAD "TALKS"\rLIST').split("\r\n")[1:] == ["5", "6", ">LIST", "10 REM", ">"]


def test_keys_behind_bye_are_cpms(cpm: Cpm) -> None:
    assert "A: SKG" in cpm.type("BYE\rDIR")


def test_ctrl_c_comes_first(cpm: Cpm) -> None:
    """Whatever was typed ahead of it."""
    for line in LOOP.splitlines():
        cpm.said(line)
    cpm.console.after = [(b"1\r\n1\r\n", b"LIST\r\x03")]
    printed = cpm.type("RUN")
    assert printed.endswith("ERR 10 LINE 10\r\n>") or printed.endswith("ERR 10 LINE 20\r\n>")
    assert cpm.said("LIST") == LOOP.splitlines()


def test_ctrl_s_holds(cpm: Cpm) -> None:
    cpm.said("10 PRINT 1")
    cpm.console.after = [(b"RUN\r\n", b"\x13")]
    held = cpm.type("RUN")
    assert held == "\r\n"  # (a key is awaited: CONIN)
    assert cpm.type("\x11", end="").startswith("1\r\n")


# Files


def test_a_program_comes_back_a_hundred_times() -> None:
    """Saved and loaded, no byte changes; the last file is the first."""
    source = "".join(path.read_text() for path in EXAMPLES[:1]) + '9000 A=1.23456789E-5\n9010 PRINT "a?*.: "\n'
    cpm = Cpm("Z80", {"P.SKG": text(source)})
    cpm.skg()
    cpm.said('LOAD "P"')
    listed = cpm.said("LIST")
    assert len(listed) > 10
    for n in range(100):
        assert cpm.said(f'SAVE "B:Q{n % 3}"') == []
        assert cpm.said("NEW") == []
        assert cpm.said(f'LOAD "B:Q{n % 3}.SKG"') == []
    assert cpm.said("LIST") == listed
    assert cpm.names(1) == ["Q0.SKG", "Q1.SKG", "Q2.SKG"]
    assert {cpm.read(name, 1) for name in cpm.names(1)} == {"".join(f"{line}\r\n" for line in listed).encode()}


def test_load_adds_lines_and_does_what_has_no_number(cpm: Cpm) -> None:
    cpm.write("MORE.SKG", text("15 D=30\nA=7\n"))
    cpm.said('LOAD "STAR"')
    cpm.said('load "more"')
    assert cpm.said("LIST 10,20") == [STAR.read_text().splitlines()[0], "15 D=30", "20 D=20"]
    assert cpm.said("PRINT A") == ["7"]


def test_a_file_goes_on_with_another(cpm: Cpm) -> None:
    """LOAD in a file: what stands behind it there is not read."""
    for name, source in (("A", '10 REM A\nLOAD "B"\n20 REM A\n'), ("B", "30 REM B\nPRINT 7\n")):
        cpm.write(f"{name}.SKG", text(source))
    assert cpm.said('LOAD "A"') == ["7"]
    assert cpm.said("LIST") == ["10 REM A", "30 REM B"]


@pytest.mark.parametrize("ends", ["\n", "", "\r", "\r\n\x1a", "\x1arubbish"])
def test_how_a_text_may_end(ends: str) -> None:
    """With or without a last line end and a ctrl-Z, in the middle of a record and at its end."""
    first = "10 REM " + "x" * 60
    for fill in (1, 128 - len(f"{first}\r\n20 REM {ends}")):
        cpm = Cpm(files={"T.SKG": f"{first}\r\n20 REM {'y' * fill}{ends}".encode()})
        cpm.skg("T")
        assert cpm.said("LIST") == [first, "20 REM " + "y" * fill]


def test_a_long_program() -> None:
    """Over several extents: 60 KB do not fit, what has room is there; 30 KB come and go."""
    lines = [f"{n} REM {'x' * 60}" for n in range(1, 500)]
    cpm = Cpm(files={"LONG.SKG": text("\n".join([*lines, ""]))})
    cpm.skg()
    assert cpm.said('LOAD "LONG"') == []
    assert cpm.said('SAVE "B:LONG"') == []
    assert cpm.read("LONG.SKG", 1) == text("\n".join([*lines, ""]))[:-1]


def test_dir(cpm: Cpm) -> None:
    """All names, some, another drive's; the system's are not shown; a disk that has been changed is seen."""
    assert cpm.said("DIR") == ["SKG      COM : STAR     SKG"]
    assert cpm.said('DIR "*.COM"') == ["SKG      COM"]
    assert cpm.said('DIR "s?ar"') == ["STAR     SKG"]
    assert cpm.said('DIR "B:"') == ["NO FILE"]
    for n in range(5):
        cpm.write(f"F{n}.X", b"x", drive=1)
    assert cpm.said('DIR "B:"') == ["F0       X   : F1       X   : F2       X   : F3       X  ", "F4       X  "]
    assert cpm.said('SAVE "B:G"') == []
    image = cpm.drives[0].image
    image.data[image.data.index(b"STAR    SKG") + 9] |= 0x80
    assert cpm.said("DIR") == ["SKG      COM"]


# Tapes


def test_a_tape_for_each_punch(cpm: Cpm) -> None:
    """PUNCH is for the next run's tape; direct statements and later runs are on the paper alone."""
    cpm.said('LOAD "STAR"')
    tape = STAR.with_suffix(".3b").read_bytes()
    cpm.said('PUNCH "T"')
    assert cpm.said("CUT (0,0),(1,0),(2,0)") == ["0001 B1000B0B1000GXL1"]
    assert [line.split()[-1] for line in cpm.said("RUN")] == tape.decode().split()
    assert cpm.read("T.3B") == tape
    cpm.said("20 D=10")
    cpm.said("RUN")
    assert cpm.read("T.3B") == tape
    cpm.said('PUNCH "B:T.NEW"')
    cpm.said("PUNCH")
    cpm.said("RUN")
    assert cpm.names(1) == []
    cpm.said('PUNCH "B:T.NEW"')
    cpm.said("GOTO 10")
    assert cpm.names(1) == ["T.NEW"]
    assert cpm.read("T.NEW", 1) != tape
    assert cpm.names() == ["SKG.COM", "STAR.SKG", "T.3B"]


@pytest.mark.parametrize(("key", "said"), [(b"\x03", "ERR 10 LINE 30"), (b"", "ERR 05 LINE 50")])
def test_a_tape_that_ends_early_is_closed(key: bytes, said: str) -> None:
    """After ctrl-C and after an error it holds what was punched, with a stop; the next run writes it anew."""
    cpm = Cpm()
    cpm.skg()
    for line in ("5 I=0", "10 CUT (0,0)", "20 I=I+1", "30 CUT (I,I)", "40 IF I<100 GOTO 20", "50 A=1/0"):
        cpm.said(line)
    cpm.said('PUNCH "T"')
    if key:
        cpm.console.after = [(b"0050", key)]
    printed = cpm.said("RUN")
    assert printed[-2:] == ["D", said]
    blocks = [line.split()[-1] for line in printed[:-1]]
    assert len(blocks) == (51 if key else 100)
    assert cpm.read("T.3B").decode() == "".join(f"{block}\r\n" for block in blocks)
    cpm.said("50 END")
    cpm.said("RUN")
    assert cpm.read("T.3B").endswith(b"L1\r\nDD\r\n")
    assert cpm.names() == ["SKG.COM", "T.3B"]


# The command line


def test_part_alone_stays_at_the_prompt() -> None:
    cpm = Cpm(files={"STAR.SKG": text(STAR.read_text())})
    cpm.type("B:")
    printed = cpm.type("A:SKG A:STAR")
    assert printed.endswith("\r\nDD\r\n>")
    assert cpm.said("LIST") == STAR.read_text().splitlines()
    assert cpm.names(1) == []


def submit(*commands: str) -> bytes:
    """$$$.SUB as SUBMIT leaves it: a record each, the last one first."""
    return b"".join(bytes([len(line)]) + line.encode().ljust(127, b"\0") for line in reversed(commands))


def test_submit() -> None:
    """Two parts one after another, then CP/M's own command."""
    wrench = ROOT / "examples" / "wrench.skg"
    cpm = Cpm(files={"STAR.SKG": text(STAR.read_text()), "WRENCH.SKG": text(wrench.read_text())})
    cpm.write("$$$.SUB", submit("SKG STAR B:T1.TAP", "SKG WRENCH B:T2", "DIR B:"))
    printed = cpm.type("\x03", end="")
    assert cpm.read("T1.TAP", 1) == STAR.with_suffix(".3b").read_bytes()
    assert cpm.read("T2.3B", 1) == wrench.with_suffix(".3b").read_bytes()
    assert "B: T1       TAP : T2       3B" in printed
    assert cpm.at_cpm


@pytest.mark.parametrize("wrong", ["20 CUT (0,0),(1,0)\n30 A=1/0\n", "20 CUT (0,0,\n", None])
def test_submit_ends_with_an_error(wrong: str | None) -> None:
    """A part that goes wrong, is not understood, or is not there: what stands behind it is not done."""
    cpm = Cpm(files={"BAD.SKG": text(wrong)} if wrong else {})
    cpm.write("$$$.SUB", submit("SKG BAD T", "DIR"))
    printed = cpm.type("\x03", end="")
    assert "ERR" in printed and "A: " not in printed.split("ERR")[1]
    assert cpm.at_cpm
    assert cpm.names() == ["BAD.SKG", "SKG.COM", "T.3B"][not wrong : 3 if wrong and "30" in wrong else 2]


def test_ctrl_c_ends_a_run_from_the_command_line() -> None:
    cpm = Cpm(files={"LOOP.SKG": text(LOOP)})
    cpm.console.after = [(b"1\r\n1\r\n", b"\x03")]
    assert "ERR 10" in cpm.type("SKG LOOP T")
    assert cpm.at_cpm


# What cannot be done

NAMES = [
    *("", "B:", ".SKG", "TOOLONGNAME", "A.LONG", "A.B.C", "A B", "A*", "?", "Q:X", "P:X", "AB:X", "1:X", "A:B:C"),
    *("A=B", "A_B", "A,B", "A;B", "<X>", "[X]"),
]


@pytest.mark.parametrize("command", ["LOAD", "SAVE", "PUNCH"])
def test_what_is_no_name(cpm: Cpm, command: str) -> None:
    """Error 10, one after the other; nothing is written, the program is there."""
    cpm.said("10 END")
    for name in NAMES:
        assert cpm.said(f'{command} "{name}"') == ["ERR 10"], name
        assert cpm.said("LIST") == ["10 END"], name
        assert cpm.names() == ["SKG.COM", "STAR.SKG"], name


@pytest.mark.parametrize(
    "line", ["LOAD", "SAVE", 'LOAD "X', "LOAD X", 'SAVE "X" 1', "BYE 1", "10 BYE", "10 DIR", '10 PUNCH "X"', "DIR X"]
)
def test_what_is_no_command(cpm: Cpm, line: str) -> None:
    assert cpm.said(line)[-1] == "ERR 01"


def test_a_type_that_is_not_for_writing(cpm: Cpm) -> None:
    """It would be its own $$$: PUNCH says so at once, not at the first block."""
    assert cpm.said('PUNCH "X.$$$"') == ["ERR 10"]
    assert cpm.said('SAVE "X.$A"') == ["ERR 10"]


def test_a_file_that_is_not_there(cpm: Cpm) -> None:
    cpm.said("10 END")
    assert cpm.said('LOAD "NONE"') == ["ERR 10"]
    assert cpm.said('LOAD "B:STAR"') == ["ERR 10"]
    assert cpm.said("LIST") == ["10 END"]


def keeps(cpm: Cpm, names: list[str]) -> None:
    """The program, a variable and the files are as they were."""
    assert cpm.said("LIST") == ["10 CUT (0,0),(1,0)"]
    assert cpm.said("PRINT A") == ["3"]
    assert cpm.names() == names


def written(cpm: Cpm, line: str) -> list[str]:
    """The messages of SAVE, or of RUN behind PUNCH."""
    return [said for said in cpm.said(line) if said.startswith(("ERR", "Bdos"))]


WRITES = [['SAVE "OLD"'], ['PUNCH "OLD.SKG"', "GOTO 10"]]


def prepared(form: cpm80.DiskFormat | None = None, **more: bytes) -> Cpm:
    """SKG with a program, a variable and a file that is to be written over."""
    cpm = Cpm(files={"OLD.SKG": text("1 REM OLD\n")} | more, form=form)
    cpm.skg()
    cpm.said("10 CUT (0,0),(1,0)")
    cpm.said("A=3")
    return cpm


@pytest.mark.parametrize("lines", WRITES, ids=["save", "punch"])
def test_a_write_protected_file(lines: list[str]) -> None:
    cpm = prepared()
    image = cpm.drives[0].image
    image.data[image.data.index(b"OLD     SKG") + 8] |= 0x80
    cpm.said("DIR")  # (else all of the disk is, since it has been changed)
    assert sum((written(cpm, line) for line in lines), []) in (["ERR 10"], ["ERR 10 LINE 10"])
    keeps(cpm, ["OLD.SKG", "SKG.COM"])
    assert cpm.read("OLD.SKG") == b"1 REM OLD\r\n"


@pytest.mark.parametrize("drive", ["", "B:"])
def test_a_write_protected_drive(drive: str) -> None:
    """As STAT d:=R/O leaves it; DIR looks at it anew, as ctrl-C does at CP/M's prompt."""
    cpm = Cpm(files={"PROTECT.COM": bytes([0x0E, 28, 0xCD, 5, 0, 0xC9])})  # MVI C,28  CALL 5  RET
    cpm.type(f"{drive or 'A:'}")
    cpm.type("A:PROTECT")
    cpm.type("A:")
    cpm.skg()
    cpm.said("10 END")
    assert cpm.said(f'SAVE "{drive}X"') == ["ERR 10"]
    assert cpm.said(f'SAVE "{"" if drive else "B:"}X"') == []
    cpm.said("DIR")
    assert cpm.said(f'SAVE "{drive}Y"') == []


@pytest.mark.parametrize("lines", WRITES, ids=["save", "punch"])
def test_a_disk_that_fails(lines: list[str]) -> None:
    """The BDOS asks; the operator gives up with ctrl-C: SKG is still there, and so is the file."""
    cpm = prepared()
    cpm.drives[0].broken = True
    cpm.console.after = [(b"Bad Sector", b"\x03")] * 9
    said = sum((written(cpm, line) for line in lines), [])
    assert (said[0], said[-1][:6]) == ("Bdos Err On A: Bad Sector", "ERR 10")
    cpm.drives[0].broken = False
    keeps(cpm, ["OLD.SKG", "SKG.COM"])
    assert cpm.said('SAVE "OLD"') == []
    assert cpm.read("OLD.SKG") == b"10 CUT (0,0),(1,0)\r\n"


@pytest.mark.parametrize("lines", [['LOAD "{}X"'], ['SAVE "{}X"'], ['DIR "{}"'], ['PUNCH "{}X"', "GOTO 10"]], ids=str)
@pytest.mark.parametrize("drive", ["A:", "B:"])
def test_a_drive_without_a_disk(drive: str, lines: list[str]) -> None:
    """The BDOS tells it once each time; one ctrl-C, and all is as it was, on the present drive, A:."""
    cpm = prepared()
    cpm.drives[drive == "B:"].is_empty = True
    cpm.console.after = [(b"Bad Sector", b"\x03")] * 9
    for _ in range(2):
        said = sum((written(cpm, line.format(drive)) for line in lines), [])
        assert said in ([f"Bdos Err On {drive} Bad Sector", error] for error in ("ERR 10", "ERR 10 LINE 10"))
    keeps(cpm, ["OLD.SKG", "SKG.COM"])
    cpm.drives[0].is_empty = False
    assert cpm.said("PUNCH") == []
    assert cpm.said('LOAD "OLD"') == []
    assert cpm.said("DIR") != []
    assert len(cpm.console.after) == 7


def test_the_disk_of_a_job_is_taken_out() -> None:
    """The tape has failed, and so does what deletes the rest of a SUBMIT: SKG's prompt then, with the program."""
    cpm = Cpm(files={"PART.SKG": text("10 INPUT A\n20 CUT (0,0),(1,0)\n")})
    cpm.type("SKG PART T")
    cpm.drives[0].is_empty = True
    cpm.console.after = [(b"Bad Sector", b"\x03")] * 9
    assert cpm.type("1").endswith("\r\nERR 10 LINE 20\r\n>")
    assert len(cpm.console.after) == 7
    assert cpm.said("LIST") == ["10 INPUT A", "20 CUT (0,0),(1,0)"]
    cpm.drives[0].is_empty = False
    assert cpm.said('SAVE "PART"') == []


def test_a_disk_that_cannot_be_read(cpm: Cpm) -> None:
    """CP/M 3 says so with FF where the end of a file is 1: no part of a program goes for the whole."""
    memory = cpm.machine.memory
    bdos = int.from_bytes(memory[6:8], "little")
    at = 0xCF06
    stub = bytes([0x79, 0xFE, 20, 0xC2, *bdos.to_bytes(2, "little"), 0x3E, 0xFF, 0xC9])
    memory[at : at + len(stub)] = stub  # MOV A,C  CPI 20  JNZ BDOS  MVI A,0FFH  RET
    memory[6:8] = at.to_bytes(2, "little")
    assert cpm.said('LOAD "STAR"')[-1] == "ERR 10"
    assert cpm.said("LIST") == []


@pytest.mark.parametrize("free", [0, 1])
@pytest.mark.parametrize("what", ["save", "punch"])
def test_a_full_disk(what: str, free: int) -> None:
    """No room at all, or for a part: what is there stays, and what could not be written is gone."""
    cpm = prepared(SMALL, FULL=bytes(1024 * (24 - 1 - 1 - 10 - free)))
    for n in range(2, 60):
        cpm.said(f"{n * 10} REM {'x' * 50}")
    listed = cpm.said("LIST")
    if what == "save":
        assert cpm.said('SAVE "OLD"') == ["ERR 10"]
    else:
        cpm.said("20 I=0")
        cpm.said("30 I=I+1")
        cpm.said("40 CUT (I,I)")
        cpm.said("50 IF I<200 GOTO 30")
        cpm.said('PUNCH "OLD.SKG"')
        listed = cpm.said("LIST")
        assert cpm.said("RUN")[-1] == "ERR 10 LINE 40"
    assert cpm.said("LIST") == listed
    assert cpm.names() == ["FULL", "OLD.SKG", "SKG.COM"]
    assert cpm.read("OLD.SKG") == b"1 REM OLD\r\n"
    cpm.said("NEW")
    cpm.said("10 END")
    assert cpm.said('SAVE "B:ROOM"') == []
    if free:
        assert cpm.said('SAVE "ROOM"') == []


def test_a_full_directory() -> None:
    cpm = prepared(SMALL, **{f"F{n}": b"" for n in range(32 - 3)})
    assert cpm.said('SAVE "NEW"') == []
    assert cpm.said('SAVE "NEWER"') == ["ERR 10"]
    assert cpm.said('SAVE "OLD"') == ["ERR 10"]
    assert len(cpm.names()) == 32
    assert cpm.read("OLD.SKG") == b"1 REM OLD\r\n"
