"""The core against Debian's SIMH (altairz80 as an 8080), which somebody else wrote.

SIMH 3.8's 8080 is a Z80 underneath: bits 1, 3 and 5 of F are what POP PSW left there, and the half carry of
subtraction, AND, DAD and rotates, and with it DAA, is the Z80's. So F is compared without these bits and DAA only
where it follows an addition; what is left out here, compare.c has.
"""

from __future__ import annotations

import random
import shutil
import subprocess
from pathlib import Path

import pytest
from asm8080 import assemble
from emuhelp import ROOT

ALTAIR = shutil.which("altairz80")

#: Opcodes that neither touch memory nor SP nor jump, without DAA: bytes of operand by opcode.
REGISTER_ONLY = {
    opcode: size
    for opcode, size in (
        *((op, 0) for op in range(0x40) if op & 7 in (3, 4, 5) and op >> 3 != 6 and op & 0xF7 != 0x33),
        *((op, 0) for op in range(0x40) if op & 7 == 7 and op != 0x27),
        *((op, 1) for op in range(0x40) if op & 7 == 6 and op != 0x36),
        *((op, 0) for op in (0x09, 0x19, 0x29, 0xEB)),
        *((op, 2) for op in (0x01, 0x11, 0x21)),
        *((op, 0) for op in range(0x40, 0xC0) if op & 7 != 6 and not 0x70 <= op < 0x78),
        *((op, 1) for op in range(0xC6, 0x100, 8)),
    )
}


def program(seed: int) -> bytes:
    """mix.asm with every such opcode, in random order and with random operands, in its list of instructions."""
    source = (ROOT / "tests/emu/mix.asm").read_text()
    head, _, rest = source.partition("LIST:")
    tail = rest[rest.index("MASKS:") :]
    pick = random.Random(seed)
    opcodes = [op for op in REGISTER_ONLY if op]
    pick.shuffle(opcodes)
    lines = ["LIST:"]
    for opcode in opcodes:
        operands = [pick.randrange(256) if i < REGISTER_ONLY[opcode] else 0 for i in range(2)]
        lines.append(f" DB {opcode},{operands[0]},{operands[1]}")
    head = head.replace("ROUNDS: EQU     2400", "ROUNDS: EQU 150").replace("ANI     0D5H", "ANI 0C5H")
    text = head + "\n".join([*lines, " DB 0", tail])
    return assemble(text)[0]


@pytest.mark.skipif(ALTAIR is None, reason="no SIMH: apt-get install simh")
@pytest.mark.parametrize("seed", [1, 2])
def test_same_crc_as_simh(tmp_path: Path, seed: int) -> None:
    """A CRC over the states after some hundred thousand instructions."""
    image = tmp_path / "mix.com"
    image.write_bytes(program(seed))
    ours = subprocess.run([ROOT / "build/skg80", "--com", image], capture_output=True, text=True)
    assert ours.returncode == 0
    # At 0 HLT, at 5 MOV A,E  OUT 11H  RET: the 2SIO's data port is the console.
    (tmp_path / "run.ini").write_text(
        f"set cpu 8080\nload {image.name} 100\n"
        "deposit 0 76\ndeposit 5 7b\ndeposit 6 d3\ndeposit 7 11\ndeposit 8 c9\ngo 100\nquit\n"
    )
    assert ALTAIR
    command = [ALTAIR, "run.ini"]
    theirs = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    assert len(ours.stdout) == 8
    assert ours.stdout in theirs.stdout, theirs.stdout
