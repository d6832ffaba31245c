#!/usr/bin/env python3
"""Assemble the SKG firmware and say where the bytes went.

    asm/build.py [--image NAME] [--sym FILE] [--listing FILE] OUT
    asm/build.py --all [--sym FILE] [--listing FILE] FOLDER
    asm/build.py --has-z88dk

writes OUT.bin (padded to 8,192 bytes) and OUT.hex, or every image under its name into FOLDER; the symbols go to one
FILE (lines of value, name and, of a label, its source file below asm/), the assembler's listing to the other: with
--all those of the standard image. asm/images.py says which files an image is made of.
Of the standard image the bytes are printed file by file; of a variant in one line.
The assembler is z88dk-z80asm when it is on the PATH (unless SKG_ASM=asm80), else asm80 from asm/node_modules. With
--has-z88dk the exit code says whether it is the first.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple, NoReturn

ASM = Path(__file__).resolve().parent
sys.path.insert(0, str(ASM))  # for tests, which load this file from elsewhere

import facts  # noqa: E402
import words  # noqa: E402
from images import IMAGES, STANDARD, Image, place  # noqa: E402

ROM_SIZE = 8192
#: Bytes of the standard ROM that this project leaves to those who add something to theirs.
KEPT = 300
#: Fewer jumps of the calculator than this in a listing of all files: it was not understood.
LEAST_JUMPS = 50
#: Likewise of operations that are one byte with QRET.
LEAST_RETURNS = 25
#: Likewise of facts in the sources.
LEAST_FACTS = 25
#: asm80, soonest done with its lines in memory at once.
ASM80 = ("node", "--max-semi-space-size=64", str(ASM / "asm80.js"))
#: Words that an assembler has for itself, so that no label or equate may be called so: each keyword of z88dk's
#: z80asm, release 2.4 and August 2026, of which `-m8080_strict` refuses the definition or a use (MB is one of the
#: later only). The registers and PSW are asm80's words too.
# fmt: off
RESERVED = {
    "A", "ABC", "ADE", "ADL", "AF", "AHL", "AIX", "AIY", "ASMPC", "ASP", "B", "BC", "BCDE", "C", "C_LINE", "D",
    "DE", "DEHL", "E", "EIR", "EQU", "F", "H", "HL", "HTR", "I", "IIR", "IP", "IX", "IXH", "IXL", "IY", "IYH",
    "IYL", "JK", "JKHL", "L", "LINE", "LXPC", "M", "MB", "PBC", "PDE", "PHL", "PIX", "PIY", "PP", "PSP", "PSW",
    "PW", "PX", "PY", "PZ", "R", "SP", "SU", "XBC", "XDE", "XHL", "XIX", "XIY", "XP", "XPC", "XSP", "YBC", "YDE",
    "YHL", "YIX", "YIY", "YP", "YSP", "ZBC", "ZDE", "ZHL", "ZIX", "ZIY", "ZP", "ZSP",
}
# fmt: on

#: The restarts and their routines.
RESTARTS = {
    "ERROR": "ERROR0", "PUTC": "PUTC0", "NEXT": "NEXT0", "EXPECT": "EXPEC0", "CALC": "CALC0", "PEEK": "PEEK0",
    "CHKEND": "CHKEN0",
}  # fmt: skip
#: A line with one: label, its name, further operands, comment.
RESTART = re.compile(rf"(\w+:)?\s+DB\s+({'|'.join(RESTARTS)})\b(?:,([^;]*\S))?\s*(;.*)?$")


def fail(message: str) -> NoReturn:
    """Print one line and end with exit code 1."""
    print(f"build: {message}", file=sys.stderr)
    sys.exit(1)


def top_file(files: list[str], include: str) -> str:
    """The small top file: every source between two labels that measure it."""
    lines = ["        ORG 0"]
    for file in files:
        lines += [f"ZB{file.upper()}:", include.format(f"{file}.asm")]
    return "\n".join([*lines, "ZBEND:", ""])


def run(command: list[str], cwd: Path) -> None:
    """Run an assembler; a failure ends the build with what it said."""
    try:
        result = subprocess.run(command, cwd=cwd, capture_output=True, text=True)
    except FileNotFoundError:
        fail(f"no {command[0]} on the PATH")
    if result.returncode:
        lines = [line for line in (result.stdout + result.stderr).splitlines() if line.strip()]
        fail("the assembler says " + "\n  ".join(lines[-12:]))


def z88dk_assembler() -> str | None:
    """The path of z88dk's z80asm; other programs of the name z80asm do not say z88dk's authors' names."""
    if os.environ.get("SKG_ASM", "") == "asm80":
        return None
    for name in ("z88dk-z80asm", "z88dk.z88dk-z80asm", "z80asm"):
        if path := shutil.which(name):
            if "z88dk" in name:
                return path
            said = subprocess.run([path], capture_output=True, text=True, stdin=subprocess.DEVNULL)
            if "InterLogic" in said.stdout + said.stderr:
                return path
    return None


def z88dk_listing(text: str, image: bytes) -> str:
    """z88dk's listing in the form of asm80's: address, bytes, source line.

    Its lines are number, address, bytes without blanks, source; eight bytes a line, the others follow in lines without
    number and source. What the linker puts in later is not among them: all bytes are taken from the image.
    """
    rows: list[tuple[int, int, str]] = []
    for line in text.splitlines():
        if found := re.match(r"\s*\d+ {2}([0-9a-f]{4}) {2}([0-9a-f]+) (.*)", line):
            rows.append((int(found[1], 16), len(found[2]) // 2, found[3].strip()))
        elif (found := re.fullmatch(r"\s{14}([0-9a-f]+)\s*", line)) and rows:
            rows[-1] = (rows[-1][0], rows[-1][1] + len(found[1]) // 2, rows[-1][2])
    lines = []
    for address, size, source in rows:
        label, statement = re.fullmatch(r"(\w+:)?\s*(.*)", source).groups("")
        data = image[address : address + size].hex(" ").upper()
        lines.append(f"{address:04X}   {data} {label} {statement}")
    return "\n".join([*lines, ""])


def add_unused(symbols: dict[str, int], texts: dict[str, str]) -> None:
    """Add the equates that nobody uses, which z88dk's map leaves out: sums of numbers and of names known by then."""
    for text in texts.values():
        for name, value in re.findall(r"^(\w+)\s+EQU\s+([\w+-]+)", text, re.M):
            terms = re.findall(r"([+-]?)(\w+)", value)
            if name not in symbols and all(term in symbols or term[0].isdigit() for _, term in terms):
                numbers = [symbols.get(term) if term in symbols else number(term) for _, term in terms]
                symbols[name] = sum(-n if sign == "-" else n for (sign, _), n in zip(terms, numbers, strict=True))


def number(text: str) -> int:
    """A number as the assemblers write it: decimal, or hexadecimal with an H behind it."""
    return int(text[:-1], 16) if text.endswith("H") else int(text)


def sources(image: Image) -> dict[str, str]:
    """The text of every source file of an image, by name, in their order; words.asm is made here.

    ValueError when a file is not there, or something is wrong with words.txt.
    """
    texts = {
        file: words.source(image.words) if file == "words" else (ASM / f"{place(file)}.asm").read_text()
        for file in image.files()
    }
    return texts if image.restarts else {file: with_calls(file, text) for file, text in texts.items()}


def sources_of(name: str) -> dict[str, str]:
    """Likewise of an image of IMAGES; what is wrong ends the build."""
    try:
        return sources(IMAGES[name])
    except ValueError as fault:
        fail(f"{name}: {fault}")


def with_calls(file: str, text: str) -> str:
    """A source of an image whose page 0 is somebody else's: `DB ERROR,ESYN` becomes `CALL ERROR0` and `DB ESYN`.

    The restarts' routines then stand one behind the other: the DS lines that fill the gaps between them are left out.
    """
    lines, skips = [], False
    for count, line in enumerate(text.splitlines(), start=1):
        if found := RESTART.match(line):
            if skips:
                fail(f"{file}.asm:{count}: skipped as one byte, but in some images a restart is a CALL")
            label, name, operands, comment = found.groups("")
            lines.append(f"{label:8}CALL    {RESTARTS[name]:16}{comment}")
            if operands:
                lines.append(f"        DB      {operands}")
        elif not re.match(r"GAP\w+:\s+DS\b", line):
            if re.match(rf"(?:\w+:)?\s+DB\b.*\b(?:{'|'.join(RESTARTS)})\b", re.sub(r'"[^"]*"|;.*', "", line)):
                fail(f"{file}.asm:{count}: a restart stands first in its DB")
            lines.append(line)
        if not re.match(r"\s*(;|$)", line):
            skips = bool(re.match(r"(?:\w+:)?\s+DB\s+SKIP\w+", line))
    return "\n".join([*lines, ""])


class Built(NamedTuple):
    """An image with the sources that it is made of, by file, its symbols and the assembler's listing."""

    image: bytes
    symbols: dict[str, int]
    listing: str
    texts: dict[str, str]


def assemble(images: Mapping[str, dict[str, str]], work: Path) -> dict[str, Built]:
    """The images of some sources by name, assembled in the empty directory `work`."""
    z88dk = z88dk_assembler()
    include = 'INCLUDE "{}"' if z88dk else "        .include {}"
    for name, texts in images.items():
        (work / name).mkdir()
        for file, text in {**texts, "top": top_file([*texts], include)}.items():
            (work / name / f"{file}.asm").write_text(text)
    if z88dk:
        for name in images:
            run([z88dk, "-m8080_strict", "-b", "-l", "-m", "top.asm"], work / name)
    elif (ASM / "node_modules" / "asm80").exists():
        run([*ASM80, *images], work)
    else:
        fail("no assembler: neither z88dk's z80asm on the PATH nor asm80 in asm/node_modules (make asm80)")
    return {name: assembled(texts, work / name, bool(z88dk)) for name, texts in images.items()}


def assembled(texts: dict[str, str], folder: Path, z88dk: bool) -> Built:
    """An image out of the files that the assembler has written into its folder."""
    image = (folder / "top.bin").read_bytes()
    if z88dk:
        pattern = re.compile(r"^(\w+)\s*=\s*\$([0-9A-F]+)", re.M)
        rows = pattern.findall((folder / "top.map").read_text())
        symbols = {name.upper(): int(value, 16) for name, value in rows if not name.startswith("__")}
        add_unused(symbols, texts)
        listings = [path for suffix in (".lis", ".lst") if (path := folder / f"top{suffix}").exists()]
        if not listings:
            fail("z88dk's assembler made no listing, top.lis or top.lst")
        listing = z88dk_listing(listings[0].read_text(), image)
    else:
        listing = (folder / "top.lst").read_text()
        pattern = re.compile(r"^([A-Z_]\w*):\s+([0-9A-F]{4}) DEFINED", re.M)
        symbols = {name: int(value, 16) for name, value in pattern.findall(listing)}
    if "ZBEND" not in symbols:
        fail("the assembler's symbols cannot be read")
    return Built(image[symbols["ORIGIN"] : symbols["ZBEND"]], symbols, listing, texts)


def check_words(texts: dict[str, str]) -> None:
    """Fail where a source defines a reserved word or a name twice, or has an RST: what stands behind it differs."""
    names: dict[str, str] = {}
    for file, text in texts.items():
        for count, line in enumerate(text.splitlines(), start=1):
            if found := re.match(r"(\w+)(?::|\s+EQU\b)", line):
                place = f"{file}.asm:{count}"
                if (before := names.setdefault(found[1].upper(), place)) != place:
                    fail(f"{place}: {found[1]} is defined in {before}, too, which asm80 takes without a word")
                if found[1].upper() in RESERVED:
                    fail(f"{file}.asm:{count}: {found[1]} is a word that an assembler has for itself")
            if re.match(r"(?:\w+:)?\s+RST\b", line):
                fail(f"{file}.asm:{count}: not every assembler takes RST 1 to 7: DB and the restart's name")
    if not names:
        fail("no label found in the sources: are they of another form?")


def check_jumps(listing: str, symbols: dict[str, int]) -> None:
    """Fail when a jump of the calculator (`DB TARGET-$`) does not fit its signed byte; assemblers cut it off."""
    jumps = re.findall(r"^([0-9A-F]{4})\s+[0-9A-F]{2}\s+(?:\w+:)?\s*DB\s+(\w+)-\$", listing, re.M)
    if len(jumps) < LEAST_JUMPS:
        fail(f"only {len(jumps)} jumps of the calculator in the listing: is its form another one?")
    for address, target in jumps:
        distance = symbols[target.upper()] - int(address, 16)
        if not -128 <= distance <= 127:
            fail(f"calculator jump at {address} to {target}: {distance} bytes do not fit")


def check_returns(texts: dict[str, str], symbols: dict[str, int]) -> None:
    """Fail where an operation with QRET in one byte (`QADD+QRET`) is none: assemblers cut off what is too large."""
    count = 0
    for file, text in texts.items():
        for line, code in enumerate((line.split(";")[0] for line in text.splitlines()), start=1):
            for name in re.findall(r"(\w+)\+QRET\b", code):
                count += 1
                if not 0 < symbols[name] <= 0xFF - symbols["QRET"] or name.startswith("QJ"):
                    fail(f"{file}.asm:{line}: {name}+QRET is not one byte that does both")
    if count < LEAST_RETURNS:
        fail(f"only {count} operations with QRET in the sources: is their form another one?")


def check_facts(name: str, texts: dict[str, str], symbols: dict[str, int]) -> None:
    """Fail when a fact that the sources rely on does not hold in an image."""
    count, wrong = facts.check(texts, symbols)
    if wrong:
        fail("\n  ".join([f"facts of {name}", *wrong]))
    if count < LEAST_FACTS:
        fail(f"only {count} facts in the sources: is their form another one?")


def label_files(texts: dict[str, str]) -> dict[str, str]:
    """The source file of every label, below asm/; what else has a name is an equate."""
    return {
        label.upper(): file if file == "words" else place(file)
        for file, text in texts.items()
        for label in re.findall(r"^(\w+):", text, re.M)
    }


def intel_hex(image: bytes, origin: int) -> str:
    """Intel hex, 16 bytes a record, from an address on."""
    records = []
    for start in range(0, len(image), 16):
        data = image[start : start + 16]
        record = bytes([len(data), *(origin + start).to_bytes(2, "big"), 0]) + data
        records.append(f":{record.hex().upper()}{-sum(record) & 255:02X}")
    return "\n".join([*records, ":00000001FF", ""])


def build(*names: str) -> dict[str, Built]:
    """Images of IMAGES by name, of which the bytes are printed; ends the build when something is wrong with one."""
    images = {name: sources_of(name) for name in names}
    for texts in images.values():
        check_words(texts)
    with tempfile.TemporaryDirectory() as work:
        built = assemble(images, Path(work))
    print_bytes(built)
    # (first what is too long: there facts do not hold, either)
    check_sizes(built)
    for name, (_, symbols, listing, texts) in built.items():
        check_jumps(listing, symbols)
        check_returns(texts, symbols)
        check_facts(name, texts, symbols)
    return built


def bytes_of(built: Built) -> dict[str, int]:
    """Bytes of each source file of an image."""
    marks = [built.symbols[f"ZB{file.upper()}"] for file in built.texts] + [built.symbols["ZBEND"]]
    return {file: end - begin for file, begin, end in zip(built.texts, marks, marks[1:], strict=False)}


def account(name: str, size: int) -> str:
    """The line of an image's bytes: used, free, and what of the standard ROM's is kept for owners."""
    free = f"   free {ROM_SIZE - size:4} of {ROM_SIZE}" if IMAGES[name].restarts else ""
    kept = f", {KEPT} of them kept for owners' additions" if name == STANDARD else ""
    return f"  {'used' if name == STANDARD else name:14} {size:5}{free}{kept}"


def print_bytes(images: Mapping[str, Built]) -> None:
    """Print the size of images: of the standard one file by file, of a variant in one line."""
    for name, built in images.items():
        if name == STANDARD:
            for file, size in bytes_of(built).items():
                print(f"  {file + '.asm':14} {size:5}")
        print(account(name, len(built.image)), flush=True)


def check_sizes(images: Mapping[str, Built]) -> None:
    """Fail when the ROM has no room for an image."""
    sizes = {name: len(built.image) for name, built in images.items() if IMAGES[name].restarts}
    if excess := [f"{name} by {size - ROM_SIZE}" for name, size in sizes.items() if size > ROM_SIZE]:
        fail(
            f"too long for {ROM_SIZE} bytes: {', '.join(excess)}. Shorten them, or leave something out in\n"
            "  asm/images.py: a statement of yours (`more` and `words`), or TOL (`spans`). See docs/firmware.md,\n"
            '  section "Adding a statement".'
        )


def write(path: Path, data: bytes) -> None:
    """Write a file, in a directory that need not be there yet."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def write_image(name: str, built: Built, out: Path) -> None:
    """The files of an image, by the name of `out`."""
    forms, image = IMAGES[name].forms, built.image
    padded = image.ljust(ROM_SIZE, b"\xff") if ".bin" in forms else image
    for form in forms:
        data = intel_hex(padded, built.symbols["ORIGIN"]).encode() if form == ".hex" else padded
        write(out.with_suffix(form), data)


def write_symbols(built: Built, path: Path) -> None:
    """The table of an image's names."""
    places = label_files(built.texts)
    names = sorted((v, k) for k, v in built.symbols.items() if not k.startswith("ZB"))
    write(path, "\n".join([*(f"{v:04X} {k} {places.get(k, '')}".rstrip() for v, k in names), ""]).encode())


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description="assemble the SKG firmware")
    parser.add_argument("--image", choices=IMAGES, default=STANDARD)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--sym", type=Path, metavar="FILE")
    parser.add_argument("--listing", type=Path, metavar="FILE")
    parser.add_argument("--has-z88dk", action="store_true")
    parser.add_argument("out", type=Path, nargs="?")
    args = parser.parse_args()
    if args.has_z88dk:
        sys.exit(not z88dk_assembler())
    if not args.out:
        parser.error("the name of the image is missing: OUT")
    images = build(*IMAGES) if args.all else build(args.image)
    for name, built in images.items():
        write_image(name, built, args.out / name if args.all else args.out)
    if args.listing:
        write(args.listing, images[args.image].listing.encode())
    if args.sym:
        write_symbols(images[args.image], args.sym)


if __name__ == "__main__":
    main()
