"""A small 8080 assembler for the emulator's own tests: Intel mnemonics, labels, EQU, ORG, DB, DW, DS.

It exists so that these tests need no other tool and no ROM. `assemble(text)` gives the bytes and the symbols;
as a program: asm8080.py source.asm image.bin.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

REGISTERS = {name: number for number, name in enumerate("BCDEHLMA")}
PAIRS = {"B": 0, "D": 1, "H": 2, "SP": 3, "PSW": 3}
CONDITIONS = ("NZ", "Z", "NC", "C", "PO", "PE", "P", "M")

#: Opcodes without operands in the opcode byte: mnemonic -> (opcode, bytes of immediate operand).
PLAIN = {
    "NOP": (0x00, 0), "RLC": (0x07, 0), "RRC": (0x0F, 0), "RAL": (0x17, 0), "RAR": (0x1F, 0),
    "SHLD": (0x22, 2), "DAA": (0x27, 0), "LHLD": (0x2A, 2), "CMA": (0x2F, 0), "STA": (0x32, 2),
    "STC": (0x37, 0), "LDA": (0x3A, 2), "CMC": (0x3F, 0), "HLT": (0x76, 0), "JMP": (0xC3, 2),
    "RET": (0xC9, 0), "CALL": (0xCD, 2), "OUT": (0xD3, 1), "IN": (0xDB, 1), "XTHL": (0xE3, 0),
    "PCHL": (0xE9, 0), "XCHG": (0xEB, 0), "DI": (0xF3, 0), "SPHL": (0xF9, 0), "EI": (0xFB, 0),
    **{f"{kind}{name}": (base + 8 * i, size) for kind, base, size in (("R", 0xC0, 0), ("J", 0xC2, 2), ("C", 0xC4, 2))
       for i, name in enumerate(CONDITIONS)},
    **{name: (0xC6 + 8 * i, 1) for i, name in enumerate(("ADI", "ACI", "SUI", "SBI", "ANI", "XRI", "ORI", "CPI"))},
}  # fmt: skip
#: Register in bits 3-5.
DESTINATION = {"INR": (0x04, 0), "DCR": (0x05, 0), "MVI": (0x06, 1)}
#: Register in bits 0-2.
SOURCE = {n: 0x80 + 8 * i for i, n in enumerate(("ADD", "ADC", "SUB", "SBB", "ANA", "XRA", "ORA", "CMP"))}
#: Pair in bits 4-5.
PAIRED = {"LXI": (0x01, 2), "STAX": (0x02, 0), "INX": (0x03, 0), "DAD": (0x09, 0), "LDAX": (0x0A, 0),
          "DCX": (0x0B, 0), "POP": (0xC1, 0), "PUSH": (0xC5, 0)}  # fmt: skip


class AssemblyError(Exception):
    """A line that cannot be assembled; the message has its number."""


def _number(text: str, symbols: dict[str, int], known: bool) -> int:
    """Value of `a+b-c` with decimal, 0FFH, 'c' and symbols; 0 for unknown symbols while not `known`."""
    total = 0
    for sign, term in re.findall(r"([+-]?)\s*('.'|\$|\w+)", text):
        if term.startswith("'"):
            value = ord(term[1])
        elif re.fullmatch(r"\d[0-9A-Fa-f]*[Hh]", term):
            value = int(term[:-1], 16)
        elif term.isdigit():
            value = int(term)
        elif term.upper() in symbols or not known:
            value = symbols.get(term.upper(), 0)
        else:
            raise KeyError(term)
        total += -value if sign == "-" else value
    return total


def _encode(mnemonic: str, operands: list[str]) -> tuple[int, int, str]:
    """Opcode, bytes of the immediate operand, its text."""
    first = operands[0].upper() if operands else ""
    if mnemonic in PLAIN:
        opcode, size = PLAIN[mnemonic]
        return opcode, size, operands[0] if size else ""
    if mnemonic == "MOV":
        return 0x40 | REGISTERS[first] << 3 | REGISTERS[operands[1].upper()], 0, ""
    if mnemonic in SOURCE:
        return SOURCE[mnemonic] | REGISTERS[first], 0, ""
    if mnemonic in DESTINATION:
        opcode, size = DESTINATION[mnemonic]
        return opcode | REGISTERS[first] << 3, size, operands[1] if size else ""
    if mnemonic in PAIRED:
        opcode, size = PAIRED[mnemonic]
        return opcode | PAIRS[first] << 4, size, operands[1] if size else ""
    if mnemonic == "RST":
        return 0xC7 | int(first) << 3, 0, ""
    raise KeyError(mnemonic)


def assemble(text: str) -> tuple[bytes, dict[str, int]]:
    """Assemble a program; the bytes begin at its first ORG (0 without one), gaps are zero. Raises AssemblyError."""
    symbols: dict[str, int] = {}
    image: dict[int, int] = {}
    for known in (False, True):
        here = 0
        for line_number, line in enumerate(text.splitlines(), 1):
            code = line.split(";")[0]
            match = re.fullmatch(r"\s*(?:(\w+):)?\s*(\w+)?\s*(.*?)\s*", code)
            if not match:
                raise AssemblyError(f"line {line_number}: not understood")
            label, word, rest = match.groups()
            mnemonic = (word or "").upper()
            operands = [o.strip() for o in re.findall(r'"[^"]*"|[^,]+', rest)]
            try:
                if mnemonic == "ORG":
                    here = _number(rest, symbols, True)
                if label:
                    symbols[label.upper()] = _number(rest, symbols, known) if mnemonic == "EQU" else here
                output: list[int] = []
                if mnemonic == "DB":
                    for item in operands:
                        quoted = item.startswith('"')
                        output += item.strip('"').encode() if quoted else [_number(item, symbols, known) & 255]
                elif mnemonic == "DW":
                    for item in operands:
                        output += _number(item, symbols, known).to_bytes(2, "little")
                elif mnemonic == "DS":
                    here += _number(rest, symbols, True)
                elif mnemonic not in ("", "ORG", "EQU"):
                    opcode, size, immediate = _encode(mnemonic, operands)
                    value = _number(immediate, symbols, known) if size else 0
                    output = [opcode, *(value & (1 << 8 * size) - 1).to_bytes(size, "little")]
            except (KeyError, IndexError, ValueError, OverflowError) as error:
                raise AssemblyError(f"line {line_number}: {code.strip()}: {error}") from error
            for byte in output:
                image[here] = byte
                here += 1
    start = min(image, default=0)
    return bytes(image.get(i, 0) for i in range(start, max(image, default=-1) + 1)), symbols


if __name__ == "__main__":
    try:
        Path(sys.argv[2]).write_bytes(assemble(Path(sys.argv[1]).read_text())[0])
    except AssemblyError as error:
        sys.exit(f"{sys.argv[1]}: {error}")
