"""Square roots rounded up to whole numbers: QROOT and the radius in asm/tape.asm take FSQR at its word."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from floathelp import Firmware, from_rows, nearest, value

#: All whole numbers that matter: above, the square is no longer exact in 32 bits. A third of them, and the last ones.
WHOLE = [*range(1, 64_000, 3), *range(64_000, 65_536)]


def roots(firmware: Firmware, squares: list[int]) -> list[Fraction]:
    """The firmware's roots of whole numbers."""
    rows = np.array([list(nearest(Fraction(square))) for square in squares], np.uint8)
    got, _ = firmware.unary("FSQR", from_rows(rows))
    return [value(row) for row in got]


def test_around_squares(firmware: Firmware) -> None:
    """The root of k² is k; that of k² + 1 is more, that of k² - 1 less, even when it is rounded."""
    assert roots(firmware, [k * k for k in WHOLE]) == WHOLE
    assert all(root > k for k, root in zip(WHOLE, roots(firmware, [k * k + 1 for k in WHOLE]), strict=True))
    assert all(root < k for k, root in zip(WHOLE, roots(firmware, [k * k - 1 for k in WHOLE]), strict=True))
