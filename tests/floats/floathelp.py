"""The firmware's floats in numpy: as bytes, as mantissa and exponent, and exactly rounded results to hold them against.

A float is sign, exponent 0...255 (0: the number zero) and a mantissa of 32 bits whose first bit is 1; its value is
mantissa * 2^(exponent - 160). The image is `roms/skg.bin`, or the one that the environment variable SKG_ROM names.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from skg.board import ENDS, Batch, Machine, symbols

ROOT = Path(__file__).resolve().parents[2]
ROM = Path(os.environ.get("SKG_ROM", ROOT / "roms" / "skg.bin"))

#: Where the tests keep operands and stack: free RAM, away from the calculator's cells.
X, Y, STACK = 0x3000, 0x3008, 0x3F00
#: Likewise a few instructions of their own.
CODE = 0x3E80
#: Cycles of a CALL.
CALL = 17
ERROR = 0x0008
ESYN, ERANGE = 1, 5
HIDDEN = np.uint64(1 << 31)
RETURNED, STOPPED = ENDS.index("returned"), ENDS.index("stop")
#: What an operation answers when the result is too large: no float has these bytes.
OVERFLOW = bytes([255] * 5)


@dataclass(frozen=True)
class Floats:
    """n floats: `sign` 0 or 1, `exponent` (int64), `mantissa` (uint64; anything where exponent is 0)."""

    sign: NDArray[np.uint64]
    exponent: NDArray[np.int64]
    mantissa: NDArray[np.uint64]

    def __len__(self) -> int:
        return len(self.sign)

    def take(self, which: NDArray[np.int64]) -> Floats:
        """Those at the given places."""
        return Floats(self.sign[which], self.exponent[which], self.mantissa[which])

    def bytes(self) -> NDArray[np.uint8]:
        """As the firmware keeps them: n rows of 5."""
        rows = np.zeros((len(self), 5), np.uint8)
        rows[:, 0] = self.exponent
        word = (self.mantissa & (HIDDEN - np.uint64(1))) | (self.sign << np.uint64(31))
        for i in range(4):
            rows[:, 1 + i] = (word >> np.uint64(24 - 8 * i)) & np.uint64(255)
        rows[self.exponent == 0] = 0
        return rows

    def fractions(self) -> list[Fraction]:
        """Exactly."""
        return [value(row) for row in self.bytes()]


def value(row: bytes | NDArray[np.uint8]) -> Fraction:
    """The number that five bytes stand for."""
    exponent, *rest = (int(byte) for byte in row)
    if not exponent:
        return Fraction(0)
    word = int.from_bytes(bytes(rest), "big")
    number = Fraction(word | 1 << 31) * Fraction(2) ** (exponent - 160)
    return -number if word >> 31 else number


def nearest(number: Fraction) -> bytes:
    """The float nearest to a number, halves away from zero; OVERFLOW when there is none."""
    size = abs(number)
    if not size:
        return bytes(5)
    power = size.numerator.bit_length() - size.denominator.bit_length()
    power += size >= Fraction(2) ** power  # 2^(power-1) <= size < 2^power
    if power + 128 < 1:
        return bytes(5)
    mantissa = int(size * Fraction(2) ** (32 - power) + Fraction(1, 2))
    if mantissa >> 32:
        mantissa, power = mantissa >> 1, power + 1
    if power + 128 > 255:
        return OVERFLOW
    word = mantissa & 0x7FFFFFFF | (number < 0) << 31
    return bytes([power + 128]) + word.to_bytes(4, "big")


def from_rows(rows: NDArray[np.uint8]) -> Floats:
    """n rows of 5 bytes as floats."""
    wide = rows.astype(np.uint64)
    word = wide[:, 1] << np.uint64(24) | wide[:, 2] << np.uint64(16) | wide[:, 3] << np.uint64(8) | wide[:, 4]
    return Floats(word >> np.uint64(31), rows[:, 0].astype(np.int64), word | HIDDEN)


def packed(sign: NDArray, exponent: NDArray[np.int64], mantissa: NDArray[np.uint64]) -> NDArray[np.uint8]:
    """Rows of bytes of results that are not yet checked for range (mantissa 2^32: rounded up to the next power).

    Below the range: zero, by the exponent before rounding; above it: OVERFLOW.
    """
    carry = mantissa >> np.uint64(32) > 0
    underflow = exponent < 1
    mantissa = np.where(carry, HIDDEN, mantissa)
    exponent = np.where(underflow, 0, exponent + carry)
    rows = Floats(np.asarray(sign, np.uint64), np.minimum(exponent, 255), mantissa).bytes()
    rows[exponent > 255] = 255
    return rows


def product(x: Floats, y: Floats) -> NDArray[np.uint8]:
    """x * y, correctly rounded."""
    wide = x.mantissa * y.mantissa
    top = wide >> np.uint64(63) == 1
    kept = np.where(top, wide >> np.uint64(31), wide >> np.uint64(30))  # 33 bits, the last decides
    rows = packed(x.sign ^ y.sign, x.exponent + y.exponent - 129 + top, (kept + np.uint64(1)) >> np.uint64(1))
    rows[(x.exponent == 0) | (y.exponent == 0)] = 0
    return rows


def quotient(x: Floats, y: Floats) -> NDArray[np.uint8]:
    """x / y, correctly rounded; OVERFLOW where y is 0."""
    wide = x.mantissa << np.uint64(32)
    whole, rest = wide // y.mantissa, wide % y.mantissa
    big = whole >> np.uint64(32) > 0
    mantissa = np.where(
        big,
        (whole + np.uint64(1)) >> np.uint64(1),
        whole + (np.uint64(2) * rest >= y.mantissa),
    )
    rows = packed(x.sign ^ y.sign, x.exponent - y.exponent + 128 + big, mantissa)
    rows[x.exponent == 0] = 0
    rows[y.exponent == 0] = 255
    return rows


def total(x: Floats, y: Floats) -> NDArray[np.uint8]:
    """x + y, correctly rounded."""
    swap = (y.exponent > x.exponent) | ((y.exponent == x.exponent) & (y.mantissa > x.mantissa))
    swap = np.where(x.exponent == 0, True, swap & (y.exponent > 0))  # a zero is the smaller
    big = Floats(*(np.where(swap, b, a) for a, b in zip(vars(x).values(), vars(y).values(), strict=True)))
    small = Floats(*(np.where(swap, a, b) for a, b in zip(vars(x).values(), vars(y).values(), strict=True)))
    shift = np.minimum(big.exponent - small.exponent, 63).astype(np.uint64)
    shift = np.where(small.exponent == 0, np.uint64(63), shift)
    high = big.mantissa << np.uint64(31)
    low = np.where(small.exponent == 0, np.uint64(0), small.mantissa << np.uint64(31))
    moved = low >> shift
    moved |= (moved << shift) != low  # what is lost can only decide which side of a half it is
    differ = big.sign != small.sign
    wide = np.where(differ, high - moved, high + moved)
    exponent = big.exponent + 1
    for step in (32, 16, 8, 4, 2, 1):
        short = wide >> np.uint64(64 - step) == 0
        wide = np.where(short, wide << np.uint64(step), wide)
        exponent = exponent - step * short
    rows = packed(big.sign, exponent, ((wide >> np.uint64(31)) + np.uint64(1)) >> np.uint64(1))
    rows[wide == 0] = 0
    return rows


def difference(x: Floats, y: Floats) -> NDArray[np.uint8]:
    """x - y, correctly rounded."""
    return total(x, Floats(y.sign ^ np.uint64(1), y.exponent, y.mantissa))


def operands(random: np.random.Generator, n: int) -> Floats:
    """n floats, half of them of a drawing's size, the others nasty: extreme exponents, odd mantissas, zeros."""
    mantissa = random.integers(1 << 31, 1 << 32, n, dtype=np.uint64)
    sparse = random.integers(0, 1 << 32, (2, n), dtype=np.uint64)
    kinds = [
        np.full(n, 0xFFFFFFFF, np.uint64),
        np.full(n, 0x80000000, np.uint64),
        np.uint64(0x80000000) + random.integers(0, 3, n, dtype=np.uint64),
        np.uint64(0xFFFFFFFF) - random.integers(0, 3, n, dtype=np.uint64),
        sparse[0] & sparse[1] & np.uint64(0xFF00FF00),
        mantissa & np.uint64(0xFF000000),
        ~(np.uint64(1) << random.integers(0, 31, n, dtype=np.uint64)) & np.uint64(0xFFFFFFFF),
        np.uint64(1) << random.integers(0, 31, n, dtype=np.uint64),
    ]
    mantissa = np.where(random.random(n) < 0.5, mantissa, np.choose(random.integers(0, len(kinds), n), kinds))
    extreme = random.choice([1, 2, 3, 63, 64, 65, 127, 128, 129, 191, 192, 193, 253, 254, 255], n)
    exponent = np.select(
        [random.random(n) < 0.5, random.random(n) < 0.5],
        [random.integers(118, 139, n), random.integers(1, 256, n)],
        extreme,
    )
    exponent[random.random(n) < 0.01] = 0
    return Floats(random.integers(0, 2, n, dtype=np.uint64), exponent, mantissa | HIDDEN)


def pairs(random: np.random.Generator, n: int) -> tuple[Floats, Floats]:
    """Operands x and y; of every eight y one is x, x with a neighbouring mantissa, or close to it in size."""
    x, y = operands(random, n), operands(random, n)
    kind = random.integers(0, 24, n)
    near = kind < 3
    step = random.integers(-2, 3, n) * (kind > 0)
    mantissa = np.clip(x.mantissa.astype(np.int64) + step, 1 << 31, (1 << 32) - 1).astype(np.uint64)
    exponent = np.clip(x.exponent + random.integers(-2, 3, n) * (kind > 1), 0, 255)
    return x, Floats(y.sign, np.where(near, exponent, y.exponent), np.where(near, mantissa, y.mantissa))


class Firmware:
    """A board whose subroutines are called."""

    def __init__(self) -> None:
        self.symbols = symbols(ROM.with_suffix(".sym").read_text())
        self.machine = Machine(ROM)
        assert self.machine.run() == "prompt"

    def batch(self, name: str, inputs: NDArray[np.uint8], out: int, length: int, **registers: int) -> Batch:
        """Calls a routine once for each row of `inputs`, which go to X; ERR ends a call as "stop"."""
        return self.machine.batch(
            self.symbols[name],
            len(inputs),
            np.ascontiguousarray(inputs).tobytes(),
            X,
            out,
            length,
            stops=[ERROR],
            sp=STACK,
            **registers,
        )

    def binary(self, name: str, x: Floats, y: Floats) -> tuple[NDArray[np.uint8], Batch]:
        """x op y as rows of bytes (OVERFLOW for ERR), and the calls."""
        inputs = np.concatenate([x.bytes(), np.zeros((len(x), Y - X - 5), np.uint8), y.bytes()], axis=1)
        return results(self.batch(name, inputs, X, 5, de=X, hl=Y))

    def unary(self, name: str, x: Floats) -> tuple[NDArray[np.uint8], Batch]:
        """f(x) as rows of bytes (OVERFLOW for ERR), and the calls. The calculator's stack is as it was."""
        self.machine.call(self.symbols["CALINI"])
        batch = self.batch(name, x.bytes(), X, 5, hl=X)
        assert batch.failures or self.machine.peek16(self.symbols["FSP"]) == self.symbols["FSTK"] + 251
        return results(batch)

    def function(self, name: str, x: Floats) -> tuple[NDArray[np.uint8], Batch]:
        """The same for an operation that takes its number from the calculator's stack; its own cycles alone."""
        names = self.symbols

        def calls(routine: bytes) -> bytes:
            """CALL CALINI; LXI D,X; CALL OOVR; LXI H,FSTK; the routine; LXI D,X; JMP CALPOP."""
            words = [names["CALINI"], X, names["OOVR"], names["FSTK"], X, names["CALPOP"]]
            parts = [word.to_bytes(2, "little") for word in words]
            return b"".join([b"\xcd", parts[0], b"\x11", parts[1], b"\xcd", parts[2], b"\x21", parts[3], routine,
                             b"\x11", parts[4], b"\xc3", parts[5]])  # fmt: skip

        def run(routine: bytes, rows: NDArray[np.uint8]) -> Batch:
            self.machine.poke(CODE, calls(routine))
            return self.machine.batch(
                CODE, len(rows), np.ascontiguousarray(rows).tobytes(), X, X, 5, stops=[ERROR], sp=STACK
            )

        around = run(b"", x.bytes()[:1]).cycles[0]
        batch = run(b"\xcd" + names[name].to_bytes(2, "little"), x.bytes())
        assert batch.failures or self.machine.peek16(names["FSP"]) == names["FSTK"] + 251
        batch.cycles[:] -= around + CALL
        return results(batch)


class Printer(Firmware):
    """A board whose RST 2 writes to memory: a pointer at X, a float behind it, then what is printed."""

    TEXT = X + 2 + 5
    CAPTURE = 0x3E00
    WIDTH = 20

    def __init__(self) -> None:
        super().__init__()
        low, high = X & 255, X >> 8
        # PUSH H; LHLD X; MOV M,A; INX H; SHLD X; POP H; RET
        code = bytes([0xE5, 0x2A, low, high, 0x77, 0x23, 0x22, low, high, 0xE1, 0xC9])
        self.machine.poke(self.CAPTURE, code)
        self.machine.poke(0x0010, bytes([0xC3, self.CAPTURE & 255, self.CAPTURE >> 8]))

    def printed(self, rows: NDArray[np.uint8], digits: int, power: int = 0) -> tuple[list[str], Batch]:
        """The text that DECOUT prints of floats given as rows of bytes, times a power of ten; and the calls."""
        pointer = np.tile(np.array([self.TEXT & 255, self.TEXT >> 8], np.uint8), (len(rows), 1))
        room = np.zeros((len(rows), self.WIDTH), np.uint8)
        inputs = np.concatenate([pointer, rows, room], axis=1)
        batch = self.batch("DECOUT", inputs, self.TEXT, self.WIDTH, hl=X + 2, bc=digits << 8, de=power & 0xFF)
        assert not batch.failures
        starts = range(0, len(rows) * self.WIDTH, self.WIDTH)
        lines = (batch.outputs[start : start + self.WIDTH] for start in starts)
        return [line.rstrip(b"\0").decode("ascii") for line in lines], batch

    def read(self, texts: list[str]) -> tuple[list[bytes], list[str], Batch]:
        """The results of DECIN: floats behind their tokens (OVERFLOW for ERR); the unread rests; the calls."""
        length = max(map(len, texts)) + 1
        inputs = np.array([list(text.encode() + b"\r" * (length - len(text))) for text in texts], np.uint8)
        out = X + 256
        rows, batch = results(self.batch("DECIN", inputs, out, 5, hl=X, de=out - 1))
        ends = batch.registers["hl"].tolist()
        left = [text[end - X :] for text, end in zip(texts, ends, strict=True)]
        return [row.tobytes() for row in rows], left, batch


def results(batch: Batch) -> tuple[NDArray[np.uint8], Batch]:
    """Five bytes a call, OVERFLOW where it came to ERR; any other end is a fault."""
    assert set(np.unique(batch.ends)) <= {RETURNED, STOPPED}, np.unique(batch.ends)
    rows = np.frombuffer(batch.outputs, np.uint8).reshape(-1, 5).copy()
    rows[batch.ends == STOPPED] = 255
    return rows, batch
