"""Makes a .uf2, the file that is dropped on a Pico, of the flash's bytes; adds the sum that the boot ROM wants.

pico/uf2.py FLASH.bin OUT.uf2
"""

from __future__ import annotations

import struct
import sys
from pathlib import Path

#: A block of a .uf2: its magic numbers, the flag "with a family", and the RP2040's family.
#: (https://github.com/microsoft/uf2)
MAGIC, MAGIC_END = (0x0A324655, 0x9E5D5157), 0x0AB16F30
WITH_FAMILY, RP2040 = 0x2000, 0xE48BFF56
FLASH = 0x10000000
#: Bytes in a block; the second stage of the boot, with its sum, has as many.
BLOCK = 256


def boot_sum(data: bytes) -> int:
    """The boot ROM's CRC-32: highest bit first, not inverted at the end (RP2040 data sheet, 2.8.1.3.1)."""
    crc = 0xFFFFFFFF
    for byte in data:
        crc ^= byte << 24
        for _ in range(8):
            crc = (crc << 1 ^ (0x04C11DB7 if crc >> 31 else 0)) & 0xFFFFFFFF
    return crc


def uf2(image: bytes) -> bytes:
    """The blocks of a .uf2 for flash from its beginning; the sum goes behind the first 252 bytes."""
    boot, rest = image[: BLOCK - 4], image[BLOCK:]
    image = boot + struct.pack("<I", boot_sum(boot)) + rest
    image += bytes(-len(image) % BLOCK)
    count = len(image) // BLOCK
    blocks = []
    for number in range(count):
        head = struct.pack("<8I", *MAGIC, WITH_FAMILY, FLASH + BLOCK * number, BLOCK, number, count, RP2040)
        data = image[BLOCK * number : BLOCK * (number + 1)]
        blocks.append(head + data + bytes(476 - BLOCK) + struct.pack("<I", MAGIC_END))
    return b"".join(blocks)


def main() -> None:
    """Command line."""
    if len(sys.argv) != 3:
        sys.exit("uf2.py FLASH.bin OUT.uf2")
    Path(sys.argv[2]).write_bytes(uf2(Path(sys.argv[1]).read_bytes()))


if __name__ == "__main__":
    main()
