"""Arithmetic with 50 decimal digits: MPFR's numbers, each operation rounded to the nearest.

MPFR's precision belongs to a thread. It is set where this module is imported, and where `precision` is used. What has
no value (0/0, the root of -1) is an ArithmeticError.
"""

from __future__ import annotations

from contextlib import AbstractContextManager

import gmpy2
from gmpy2 import asin, atan, atan2, cos, degrees, floor, hypot, log10, radians, sin, sqrt
from gmpy2 import mpfr as Real
from gmpy2 import rint as nint

# fmt: off
__all__ = [
    "BITS", "PI", "Real", "asin", "atan", "atan2", "cos", "degrees", "floor", "hypot", "log10", "nint", "precision",
    "radians", "sin", "sqrt",
]
# fmt: on

#: Bits of a mantissa: 50 digits and a little.
BITS = 169


def precision(bits: int = BITS) -> AbstractContextManager:
    """Compute with mantissas of so many bits while the context lasts."""
    return gmpy2.context(precision=bits, trap_divzero=True, trap_invalid=True)


gmpy2.set_context(precision())
PI = gmpy2.const_pi()
