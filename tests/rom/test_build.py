"""The committed images: built anew they are the same, and they hold nothing but 8080 code.

The opcode table and the walk through the image are the test's own: from the restarts, along every jump and
call, over the data that stands behind RST 1, RST 4, RST 5 (the calculator's byte-code) and calls of PUTSI
and of the drive's DNEXT and DNEXZ.
"""

from __future__ import annotations

import functools
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from facthelp import pattern, says
from romhelp import ROOT

sys.path.insert(0, str(ROOT / "asm"))
import build  # noqa: E402
import rooms  # noqa: E402

ROMS = ROOT / "roms"
ROM_SIZE = 8192
#: Every image, and what of it is committed.
VARIANTS = {
    name: (*image.forms, ".sym") if name == build.STANDARD else image.forms for name, image in build.IMAGES.items()
}
#: Those that are ROMs: of the same size, filled up.
ROM_IMAGES = [name for name, forms in VARIANTS.items() if ".bin" in forms]

REGISTERS = "BCDEHLMA"
PAIRS = ["B", "D", "H", "SP"]
CONDITIONS = ["NZ", "Z", "NC", "C", "PO", "PE", "P", "M"]


def opcodes() -> dict[int, tuple[str, int]]:
    """Mnemonic with its registers, and length, of each of the 8080's 244 documented opcodes."""
    table: dict[int, tuple[str, int]] = {0x00: ("NOP", 1)}
    for n, pair in enumerate(PAIRS):
        table[0x01 + 16 * n] = (f"LXI {pair}", 3)
        table[0x03 + 16 * n] = (f"INX {pair}", 1)
        table[0x09 + 16 * n] = (f"DAD {pair}", 1)
        table[0x0B + 16 * n] = (f"DCX {pair}", 1)
        name = "PSW" if pair == "SP" else pair
        table[0xC1 + 16 * n] = (f"POP {name}", 1)
        table[0xC5 + 16 * n] = (f"PUSH {name}", 1)
    for n, name in enumerate(["STAX B", "STAX D"]):
        table[0x02 + 16 * n] = (name, 1)
        table[0x0A + 16 * n] = (f"LDAX {name[-1]}", 1)
    for n, name in enumerate(["SHLD", "STA"]):
        table[0x22 + 16 * n] = (name, 3)
        table[0x2A + 16 * n] = (["LHLD", "LDA"][n], 3)
    for n, name in enumerate(["RLC", "RRC", "RAL", "RAR", "DAA", "CMA", "STC", "CMC"]):
        table[0x07 + 8 * n] = (name, 1)
    for n, register in enumerate(REGISTERS):
        table[0x04 + 8 * n] = (f"INR {register}", 1)
        table[0x05 + 8 * n] = (f"DCR {register}", 1)
        table[0x06 + 8 * n] = (f"MVI {register}", 2)
        for m, source in enumerate(REGISTERS):
            table[0x40 + 8 * n + m] = (f"MOV {register},{source}", 1)
    table[0x76] = ("HLT", 1)
    for n, name in enumerate(["ADD", "ADC", "SUB", "SBB", "ANA", "XRA", "ORA", "CMP"]):
        for m, source in enumerate(REGISTERS):
            table[0x80 + 8 * n + m] = (f"{name} {source}", 1)
    for n, name in enumerate(["ADI", "ACI", "SUI", "SBI", "ANI", "XRI", "ORI", "CPI"]):
        table[0xC6 + 8 * n] = (name, 2)
    for n, condition in enumerate(CONDITIONS):
        table[0xC0 + 8 * n] = (f"R{condition}", 1)
        table[0xC2 + 8 * n] = (f"J{condition}", 3)
        table[0xC4 + 8 * n] = (f"C{condition}", 3)
        table[0xC7 + 8 * n] = (f"RST {n}", 1)
    table |= {0xC3: ("JMP", 3), 0xC9: ("RET", 1), 0xCD: ("CALL", 3), 0xD3: ("OUT", 2), 0xDB: ("IN", 2)}
    table |= {0xE3: ("XTHL", 1), 0xE9: ("PCHL", 1), 0xEB: ("XCHG", 1), 0xF9: ("SPHL", 1)}
    return table | {0xF3: ("DI", 1), 0xFB: ("EI", 1)}


OPCODES = opcodes()

#: Bit 2 of F is parity after every operation of an 8080 and 8085; a Z80 has overflow there after arithmetic. None
#: of these is needed: the firmware does without.
PARITY = {f"{kind}{condition}" for kind in "JCR" for condition in ("PO", "PE")}
#: DAA agrees on all three only where it corrects an addition: the 8080 knows no other, a Z80 keeps what was done in
#: a flag of its own; AND leaves another half carry on each.
ADDITIONS = ("ADD", "ADC", "ADI", "ACI")

#: Operations of the calculator (asm/calc.asm, ops.asm) with a distance behind them; the last always jumps.
JUMPS = ["QJN", "QJZ", "QJC", "QJMP"]


@dataclass
class Walk:
    """All instructions that can be reached, and the byte-code between them."""

    image: bytes
    names: dict[str, int]
    start: int = 0
    code: set[int] = field(default_factory=set)
    bytecode: set[int] = field(default_factory=set)

    def follow(self, starts: list[int]) -> None:
        """Walk from some addresses on."""
        waiting = list(starts)
        while waiting:
            at = waiting.pop()
            if at in self.code or not self.start <= at < len(self.image):
                continue
            self.code.add(at)
            opcode = self.image[at]
            assert opcode in OPCODES, f"{at:04X}: {opcode:02X} is no documented 8080 opcode"
            name, length = OPCODES[opcode]
            target = int.from_bytes(self.image[at + 1 : at + 3], "little") if length == 3 else 0
            if name in ("JMP", "CALL") or (length == 3 and name[0] in "JC"):
                waiting.append(target)
            if name == "CALL" and target in self.restarts():
                name, length = f"RST {self.restarts()[target]}", 3
            if name == "RST 4":
                waiting.append(at + length + 1)
            elif name == "RST 5":
                waiting += self.calculator(at + length)
            elif name == "CALL" and target == self.names["PUTSI"]:
                waiting.append(1 + next(n for n in range(at + 3, len(self.image)) if self.image[n] & 0x80))
            elif name == "CALL" and target in map(self.names.get, ("DNEXT", "DNEXZ")):
                waiting.append(at + 5)
            elif name == "CALL" and target == self.names.get("WORD"):
                pass  # (it takes the table behind the CALL, and does not come back)
            elif name not in ("JMP", "RET", "PCHL", "RST 1", "HLT"):
                waiting.append(at + length)

    def restarts(self) -> dict[int, int]:
        """The restarts that an image calls which does not own page 0, by their addresses there."""
        names = {"ERROR0": 1, "EXPEC0": 4, "CALC0": 5}
        return {self.names[name]: number for name, number in names.items()} if self.start else {}

    def length(self, at: int) -> int:
        """Bytes of the instruction at an address."""
        return OPCODES[self.image[at]][1]

    def differences(self) -> list[str]:
        """Instructions that do not do the same on 8080, 8085 and Z80, with their addresses."""
        assert len(self.code) > 2000, f"only {len(self.code)} instructions found"
        found = []
        for at in sorted(self.code):
            name = OPCODES[self.image[at]][0]
            before = [OPCODES[self.image[at - n]] for n in (1, 2) if at - n in self.code and self.length(at - n) == n]
            if name in PARITY:
                found.append(f"{at:04X} {name}: a Z80 has no parity after arithmetic")
            if name == "DAA" and not any(text.startswith(ADDITIONS) for text, _ in before):
                found.append(f"{at:04X} DAA: not behind an addition")
        return found

    def calculator(self, start: int) -> list[int]:
        """Walk byte-code; where machine code goes on behind it."""
        after, waiting = [], [start]
        while waiting:
            at = waiting.pop()
            if at in self.bytecode:
                continue
            self.bytecode.add(at)
            operation = self.image[at]
            if operation == self.names["QEND"]:
                after.append(at + 1)
            elif operation in [self.names[jump] for jump in JUMPS]:
                distance = self.image[at + 1]
                waiting.append(at + 1 + distance - (256 if distance > 127 else 0))
                if operation != self.names["QJMP"]:
                    waiting.append(at + 2)
            elif operation < self.names["QRET"]:
                waiting.append(at + 1)
        return after


@dataclass(frozen=True)
class Line:
    """One line of the listing with bytes in the image."""

    at: int
    data: bytes
    mnemonic: str
    operands: str


#: The headers of all images' files.
every = functools.cache(rooms.every)
#: All images are assembled once, for all tests, which stay in one process.
build.build = functools.cache(build.build)
pytestmark = pytest.mark.xdist_group("images")


def built(name: str) -> build.Built:
    """The image assembled anew."""
    return build.build(*VARIANTS)[name]


@functools.cache
def written() -> dict[str, bytes]:
    """The files that `make rom` writes, by their names."""
    with tempfile.TemporaryDirectory() as scratch, pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "argv", ["build.py", "--all", "--sym", f"{scratch}/skg.sym", scratch])
        build.main()
        return {path.name: path.read_bytes() for path in Path(scratch).iterdir()}


def memory(name: str) -> bytes:
    """The committed image as it lies in memory, from address 0."""
    form = VARIANTS[name][0]
    data = (ROMS / name).with_suffix(form).read_bytes()
    if form == ".hex":
        data = b"".join(bytes.fromhex(row[9:-2]) for row in data.decode().split())
    return bytes(labels(name)["ORIGIN"]) + data


def without_lines(name: str) -> bytes:
    """The image as it lies in memory; where the 8085's own lines are looked at or set, NOP, as an 8080 takes them."""
    image = bytearray(memory(name))
    for line in listed(name):
        if line.mnemonic == "DB" and line.operands.strip() in ("SIDIN", "SODOUT"):
            image[line.at] = 0
    return bytes(image)


@functools.cache
def listed(name: str) -> list[Line]:
    """Lines of the assembler's listing that made bytes."""
    names = "|".join({"DB", "DW", "DS"} | {text.split()[0] for text, _ in OPCODES.values()})
    shape = re.compile(rf"([0-9A-F]{{4}})   ((?:[0-9A-F]{{2}} )+) *(?:\w+: +)?({names})(?=   |$)([^;]*)")
    rows = map(shape.match, built(name).listing.splitlines())
    return [Line(int(m[1], 16), bytes.fromhex(m[2]), m[3], m[4].strip()) for m in rows if m]


def labels(name: str) -> dict[str, int]:
    """Addresses by label, of the image built anew."""
    return built(name).symbols


def test_nothing_fetched_is_committed() -> None:
    """Neither the assembler that npm fetches nor a virtual environment."""
    done = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True)
    files = done.stdout.splitlines()
    assert "asm/package.json" in files
    assert [file for file in files if {"node_modules", ".venv"} & set(file.split("/"))] == []


def test_every_image_is_known() -> None:
    files = {Path(name).with_suffix(suffix).name for name, suffixes in VARIANTS.items() for suffix in suffixes}
    assert {path.name for path in ROMS.iterdir()} == files == set(written())


@pytest.mark.parametrize("name", VARIANTS)
def test_built_anew_it_is_the_same(name: str) -> None:
    for suffix in VARIANTS[name]:
        committed = (ROMS / name).with_suffix(suffix)
        assert written()[committed.name] == committed.read_bytes(), f"{committed}: make rom"


@pytest.mark.parametrize("name", VARIANTS)
def test_room(name: str) -> None:
    """No file is longer than its header allows; where restarts are CALLs that counts for an image's own files."""
    images = every()
    image = built(name)
    allowed = {file: space for file, room in images[name].items() if (space := rooms.room_of(room)) is not None}
    sizes = {file: size for file, size in build.bytes_of(image).items() if file in allowed}
    assert sum(sizes.values()) > 7000
    if not build.IMAGES[name].restarts:
        others = {file for other, files in images.items() if build.IMAGES[other].restarts for file in files}
        sizes = {file: size for file, size in sizes.items() if file not in others}
        assert bool(sizes) == bool(set(allowed) - others)
    assert {file: f"{n} of {allowed[file]} bytes" for file, n in sizes.items() if n > allowed[file]} == {}


@pytest.mark.parametrize("name", ROM_IMAGES)
def test_size_and_hex(name: str) -> None:
    image = (ROMS / f"{name}.bin").read_bytes()
    assert len(image) == ROM_SIZE
    assert labels(name)
    rows = (ROMS / f"{name}.hex").read_text().split()
    records = [bytes.fromhex(row[1:]) for row in rows]
    assert all(row[0] == ":" for row in rows)
    assert all(sum(record) & 0xFF == 0 and len(record) == record[0] + 5 for record in records)
    assert records[-1] == bytes([0, 0, 0, 1, 0xFF])
    assert b"".join(record[4:-1] for record in records[:-1]) == image


def test_the_ram_image_is_the_roms() -> None:
    """The same code; what the ROM is filled up with is left out."""
    rom = (ROMS / "skg.bin").read_bytes()
    ram = memory("skg-ram")
    assert ram == rom[: len(ram)]
    assert set(rom[len(ram) :]) == {0xFF}
    assert ram[-1] != 0xFF


def walked(name: str, planted: dict[int, bytes] | None = None) -> Walk:
    """The walk through an image, into which bytes are planted at some addresses: from the restarts and tables on,
    and from what the listing says are instructions."""
    image = bytearray(without_lines(name))
    for at, data in (planted or {}).items():
        image[at : at + len(data)] = data
    walk = Walk(bytes(image), labels(name), labels(name)["ORIGIN"])
    walk.follow(starting(name, walk))
    return walk


def starting(name: str, walk: Walk) -> list[int]:
    """Entries that no other code leads to: the restarts and the addresses in tables; of the calculator's operations
    that are byte-code, the machine code behind it."""
    origin = labels(name)["ORIGIN"]
    starts = [origin] if origin else list(range(0, 0x40, 8))
    first = labels(name)["OPTAB"] + 2 * labels(name)["OPBYTE"]
    for line in listed(name):
        if line.mnemonic == "DW":
            for n in range(0, len(line.data), 2):
                target = int.from_bytes(line.data[n : n + 2], "little")
                bytecode = first <= line.at + n < labels(name)["OPEND"]
                starts += walk.calculator(target) if bytecode else [target]
    return starts


@pytest.mark.parametrize("name", VARIANTS)
def test_the_same_on_8080_8085_and_z80(name: str) -> None:
    walk = walked(name)
    walk.follow([line.at for line in listed(name) if line.mnemonic not in ("DB", "DW", "DS")])
    assert not walk.differences()


@pytest.mark.parametrize("name", VARIANTS)
def test_what_differs_is_found(name: str) -> None:
    """Four are planted at the start of the multiplication, which no image is without, one behind the other."""
    at, planted, found = labels(name)["FMUL"], b"", []
    for opcode in ("JPE", "CPO", "RPE", "DAA"):
        code = next(number for number, (text, _) in OPCODES.items() if text == opcode)
        found.append(f"{at + len(planted):04X} {opcode}")
        planted += bytes([code, 0x00, 0x00])[: OPCODES[code][1]]
    assert [text.split(":")[0] for text in walked(name, {at: planted}).differences()] == found


@pytest.mark.parametrize("opcode", [*range(0x08, 0x40, 8), 0xCB, 0xD9, 0xDD, 0xED, 0xFD])
def test_what_another_processor_takes_for_something_else_is_found(opcode: int) -> None:
    """Twelve opcodes that the 8080 has no use for: the 8085's RIM, SIM and secret ones, a Z80's jumps and prefixes."""
    with pytest.raises(AssertionError, match=pattern("8080 opcode")):
        walked("skg", {labels("skg")["FMUL"]: bytes([opcode])})


def test_a_walk_that_finds_nothing_has_failed() -> None:
    with pytest.raises(AssertionError, match=pattern("0 instructions")):
        Walk(bytes(ROM_SIZE), {}).differences()


@pytest.mark.parametrize("name", VARIANTS)
def test_only_8080_code_is_reached(name: str) -> None:
    image = without_lines(name)
    lines = listed(name)
    walk = Walk(image, labels(name), labels(name)["ORIGIN"])
    walk.follow(starting(name, walk))
    instructions = {line.at for line in lines if line.mnemonic not in ("DB", "DW", "DS")}
    # The walk is the listing's code, but for a DB that skips the one or two bytes behind it.
    strays = walk.code - instructions
    skips = (0xFE, 0x06, 0x01, 0x3A)  # CPI, MVI B, LXI B, LDA: their operand is the instruction that is skipped
    restarts = [0xC7 + 8 * n for n in range(1, 8)]  # written as data: DB CALC,...
    changed = {at for at, (was, now) in enumerate(zip(memory(name), image, strict=True)) if was != now}
    assert bool(changed) == (name == "skg-8085")
    assert all(image[at] in (*skips, *restarts) for at in strays - changed), sorted(map(hex, strays))
    # What no jump leads to by name (an address loaded into a pair and pushed) is little.
    assert len(instructions - walk.code) < len(instructions) / 20
    assert not walk.code & walk.bytecode


@pytest.mark.parametrize("name", VARIANTS)
def test_every_instruction_is_the_8080s(name: str) -> None:
    """The listing's instructions have the names of the test's own table."""
    image = memory(name)
    count = 0
    for line in listed(name):
        assert image[line.at : line.at + len(line.data)] == line.data
        if line.mnemonic in ("DB", "DW", "DS"):
            continue
        text, length = OPCODES[line.data[0]]
        mnemonic, _, registers = text.partition(" ")
        assert (line.mnemonic, len(line.data)) == (mnemonic, length), line
        assert line.operands.replace(" ", "").startswith(registers), line
        count += 1
    assert count > 2000


@pytest.mark.parametrize("name", VARIANTS)
def test_jumps_of_the_calculator_reach_their_labels(name: str) -> None:
    """A distance is a signed byte; the assemblers cut off what is more without a word."""
    places = labels(name)
    found = 0
    for line in listed(name):
        if target := re.fullmatch(r"(\w+)-\$", line.operands.strip()):
            distance = int.from_bytes(line.data, signed=True)
            assert line.at + distance == places[target[1]], line
            found += 1
    assert found > 10


def refused(capsys: pytest.CaptureFixture[str], check: Callable[..., None], *arguments: object) -> str:
    """The message of a check of asm/build.py that ends the build."""
    with pytest.raises(SystemExit):
        check(*arguments)
    return capsys.readouterr().err


def test_what_the_assembler_refuses_has_its_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    fault = {"good": "ORIGIN  EQU     0\n", "bad": "        NOP\n        LXI     H,FOO\n"}
    assert says(refused(capsys, build.assemble, {"skg": fault}, tmp_path), "bad.asm:2", "FOO")


def test_every_image_that_is_too_long_is_named(capsys: pytest.CaptureFixture[str]) -> None:
    longer = {name: built(name)._replace(image=bytes(8193)) for name in ("skg-mill", "skg.com", "skg-drive")}
    assert says(refused(capsys, build.check_sizes, longer), "skg-mill by 1", "skg-drive by 1")
    build.check_sizes({"skg.com": longer["skg.com"]})
    assert says(refused(capsys, build.check_facts, "skg-tty", {"some": ";! 1 == 2 -- nobody\n"}, {}), "skg-tty")


@pytest.mark.parametrize(
    ("line", "fact"),
    [
        ("MB      EQU     5", "MB"),
        ("LINE:   NOP", "LINE"),
        ("        RST     5", "RST"),
        ("X1:     RST     2", "RST"),
        ("        NOP", "no label"),
    ],
)
def test_words_that_an_assembler_refuses(line: str, fact: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert says(refused(capsys, build.check_words, {"some": f"{line}\n"}), fact)


def test_jumps_that_do_not_fit_and_listings_that_are_not_understood(capsys: pytest.CaptureFixture[str]) -> None:
    fit = "\n".join(f"{n:04X}   00  DB      THERE-$" for n in range(100))
    build.check_jumps(fit, {"THERE": 0x20})
    assert says(refused(capsys, build.check_jumps, fit, {"THERE": 0x80}), "0000", "THERE", "128 bytes")
    assert says(refused(capsys, build.check_jumps, fit.lower(), {"THERE": 0x20}), "0 jumps")


def test_what_cannot_be_one_byte_with_qret(capsys: pytest.CaptureFixture[str]) -> None:
    """An assembler cuts off what does not fit; a jump there would be no jump."""
    fit = {"some": "        DB      CALC,LA0,QADD+QRET ; QEND+QRET\n" * 30}
    names = {"QRET": 0xD4, "QEND": 0, "QADD": 0x16, "QFAR": 0x2C, "QJN": 0x1A}
    build.check_returns(fit, names)
    for wrong in ("QFAR", "QJN", "QEND"):
        other = {"other": f"        DB      {wrong}+QRET\n"}
        assert says(refused(capsys, build.check_returns, fit | other, names), "other.asm:1", f"{wrong}+QRET")
    assert says(refused(capsys, build.check_returns, {"some": "        DB      QADD,QRET\n"}, names), 0)


def test_z88dks_listing_is_read() -> None:
    """As release 2.4 writes it; the bytes are the image's."""
    text = """top.asm:
     1                                  ORG 0
     2                          X EQU 5
     3  0000  210000            A1:     LXI H,B1 ; a comment
     4  0003  0102030405060708          DB 1,2,3,4,5,6,7,8,9
              09
     5
in.asm:
     1  000c  00                B1:NOP
"""
    image = bytes([0x21, 0x0C, 0x00, 1, 2, 3, 4, 5, 6, 7, 8, 9, 0])
    assert build.z88dk_listing(text, image).splitlines() == [
        "0000   21 0C 00 A1: LXI H,B1 ; a comment",
        "0003   01 02 03 04 05 06 07 08 09  DB 1,2,3,4,5,6,7,8,9",
        "000C   00 B1: NOP",
    ]


@pytest.mark.parametrize("name", VARIANTS)
def test_o_and_x_lie_in_the_page_of_y(name: str) -> None:
    """FIND loads the address of CONTAB, which is Y, and for O and X changes its low byte alone."""
    assert labels(name)["CONTAB"] % 0x100 + 10 < 0x100


def test_the_program_begins_in_the_page_where_gosubs_stack_ends() -> None:
    """CLRPTR loads the one address and for the other changes its low byte alone."""
    names = labels("skg")
    assert names["PROG"] // 0x100 == names["GSTKE"] // 0x100
