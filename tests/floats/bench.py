"""Cycles and bytes of the firmware's floats, beside the figures they are held against. `make bench-floats` prints it.

Operands are a drawing's: uniform in -1000...1000; angles in -180...180, ATG of -10...10, SQR of 0...1000; in decimal
whole numbers of 8 digits (below 2^26 to print). In brackets: Microsoft's floats of 24 bits; for SQR DAI's too. A
routine's bytes are those from its label to the next one in the table; what several share is shown by itself.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from floathelp import Floats, Printer, from_rows, nearest
from measured import Measured, judge

from skg.board import Batch

N = 2000
#: Labels of float.asm and decimal.asm: what a part is, the limit for its mean, the known figure; "" ends a file's.
PARTS = {
    "FSUB": ("FADD and FSUB", "1,000", "927"),
    "FNRMC": ("end of + * /", "", ""),
    "FSHR": ("align", "", ""),
    "FMUL": ("FMUL", "3,600", "4,040"),
    "FEXP": ("unpack, exponents of * /", "", ""),
    "FDIV": ("FDIV", "9,000", "8,521"),
    "FADD2": ("FADD, signs differ", "", ""),
    "FNRME": ("normalize, round, pack", "", ""),
    "FABS": ("FABS FNEG FSGN", "", ""),
    "FITOF": ("FITOF FTOI16", "", ""),
    "FFLR": ("FFLR", "", ""),
    "FSQR": ("FSQR", "25,000", "93,326; DAI 27,311"),
    "FTG": ("FTG", "", ""),
    "FCOS": ("FCOS", "", ""),
    "FSIN": ("FSIN", "45,000", "44,617"),
    "FSER": ("series", "", ""),
    "CSIN": ("coefficients", "", ""),
    "FATG": ("FATG", "50,000", "56,939"),
    "FTEN": ("powers of ten, digits", "", ""),
    "DECOUT": ("DECOUT", "60,000", ""),
    "DECIN": ("DECIN", "", ""),
    "FLTEND": ("", "", ""),
    "LEXDEC": ("", "", ""),
}


def uniform(random: np.random.Generator, low: float, high: float) -> Floats:
    """N floats."""
    numbers = (Fraction(number) for number in random.uniform(low, high, N).tolist())
    return from_rows(np.array([list(nearest(number)) for number in numbers], np.uint8))


def measure(board: Printer) -> dict[str, Batch]:
    """Calls of each routine, by its label in PARTS."""
    random = np.random.default_rng(12)
    whole = random.integers(10**7, 10**8, N).tolist()
    lengths = random.integers(10**7, 1 << 26, N).tolist()
    pairs = uniform(random, -1000, 1000), uniform(random, -1000, 1000)
    angles = uniform(random, -180, 180)
    return {
        "FSUB": board.binary("FADD", *pairs)[1],
        "FMUL": board.binary("FMUL", *pairs)[1],
        "FDIV": board.binary("FDIV", *pairs)[1],
        "FFLR": board.unary("FFLR", pairs[0])[1],
        "FSQR": board.unary("FSQR", uniform(random, 0, 1000))[1],
        "FTG": board.function("FTG", angles)[1],
        "FCOS": board.function("FCOS", angles)[1],
        "FSIN": board.function("FSIN", angles)[1],
        "FATG": board.function("FATG", uniform(random, -10, 10))[1],
        "DECOUT": board.printed(np.array([list(nearest(Fraction(n))) for n in lengths], np.uint8), 8)[1],
        "DECIN": board.read([f"{n % 100000 / 1000:.3f}" for n in whole])[2],
    }


def main() -> list[Measured]:
    """The table; what has a limit."""
    board = Printer()
    calls = measure(board)
    print("float.asm, decimal.asm    bytes   mean cycles     max   limit    MBF")
    labels = sorted(PARTS, key=lambda label: (board.symbols[label], PARTS[label][0]))
    total, limited = 0, []
    for label, behind in zip(labels, labels[1:], strict=False):
        what, limit, known = PARTS[label]
        if not what:
            continue
        size = board.symbols[behind] - board.symbols[label]
        total += size
        line = f"{what:24} {size:6}"
        if label in calls:
            cycles = calls[label].cycles
            line += f" {cycles.mean():13,.0f} {cycles.max():7,} {limit:>7}    {known}"
            if limit:
                limited.append(Measured(f"{label}, mean", float(cycles.mean()), int(limit.replace(",", ""))))
        print(line.rstrip())
    print(f"{'all':24} {total:6}                           1,500 bytes")
    return [*limited, Measured("bytes of float.asm and decimal.asm", total, 1500)]


if __name__ == "__main__":
    raise SystemExit(judge(main()))
