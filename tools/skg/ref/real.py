"""Numbers of the reference: 50 decimal digits, angles in degrees as the language has them.

The firmware's range is kept: a number of 2^127 or more is error 5, one below 2^-127 is zero.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache, wraps
from typing import TYPE_CHECKING, ParamSpec, TypeVar

import mpmath

from skg.ref import near
from skg.ref.fault import Code, Fault

mp = mpmath.mp.clone()
mp.dps = 50
if TYPE_CHECKING:
    from mpmath import mpf as Real
else:
    Real = mp.mpf

_P = ParamSpec("_P")
_T = TypeVar("_T")


def kept(function: Callable[_P, _T]) -> Callable[_P, _T]:
    """A function that keeps its latest results, for each precision of `mp` its own."""

    def computed(_precision: int, *arguments: _P.args, **named: _P.kwargs) -> _T:
        return function(*arguments, **named)

    result: Callable[..., _T] = lru_cache(maxsize=10_000)(computed)

    @wraps(function)
    def call(*arguments: _P.args, **named: _P.kwargs) -> _T:
        return result(mp.prec, *arguments, **named)

    return call


ZERO, ONE = Real(0), Real(1)
LARGEST, SMALLEST = Real(2) ** 127, Real(2) ** -127
#: 1 µm in mm: the language's tolerance for places and for touching.
MICRON = Real("0.001")
#: Two numbers closer than this, relative to max(1, |a|, |b|), are equal for IF, INT, n and subscripts.
#: As a length in mm or as the sine of an angle it is also where zero begins.
NEARLY = Real("1e-7")
#: Digits of a constant, on either side of the point, beyond which nobody is served by counting.
MOST_DIGITS = 1000


def in_range(value: Real) -> Real:
    """The value as the firmware's range has it: error 5 above, 0 below."""
    size = abs(value)
    if size >= LARGEST:
        raise Fault(Code.RANGE)
    return ZERO if size < SMALLEST else value


def divide(a: Real, b: Real) -> Real:
    """a / b; error 5 for b = 0."""
    if b == 0:
        raise Fault(Code.RANGE)
    return in_range(a / b)


def _whole_quarters(angle: Real) -> int | None:
    """n where the angle is n·90 degrees exactly, else None."""
    n = angle / 90
    return int(n) if n == mp.floor(n) else None


def sin(angle: Real) -> Real:
    """Sine of an angle in degrees, exact at multiples of 90."""
    n = _whole_quarters(angle)
    if n is not None:
        return Real((0, 1, 0, -1)[n % 4])
    return mp.sin(mp.radians(mp.fmod(angle, 360)))


def cos(angle: Real) -> Real:
    """Cosine of an angle in degrees, exact at multiples of 90."""
    n = _whole_quarters(angle)
    if n is not None:
        return Real((1, 0, -1, 0)[n % 4])
    return mp.cos(mp.radians(mp.fmod(angle, 360)))


def tan(angle: Real) -> Real:
    """Tangent of an angle in degrees; error 5 at odd multiples of 90."""
    c = cos(angle)
    if c == 0:
        raise Fault(Code.RANGE)
    near.note("tangent", c, NEARLY)
    return in_range(sin(angle) / c)


def atan(value: Real) -> Real:
    """Arc tangent in degrees, in (-90, 90)."""
    return mp.degrees(mp.atan(value))


def sqrt(value: Real) -> Real:
    """Square root; error 5 for a negative number."""
    if value < 0:
        raise Fault(Code.RANGE)
    return mp.sqrt(value)


def nearly_equal(a: Real, b: Real) -> bool:
    """Equal in the sense of IF (language.md, section 2)."""
    limit = NEARLY * max(ONE, abs(a), abs(b))
    gap = abs(a - b)
    near.note("nearly equal", (gap - limit) / limit, Real("1e-2"))
    return gap < limit


def floor(value: Real) -> Real:
    """INT: the greatest whole number not above `value`; what is nearly whole is whole."""
    nearest = mp.nint(value)
    return nearest if nearly_equal(value, nearest) else mp.floor(value)


def whole(value: Real) -> int:
    """A subscript or a count: error 5 when it is not (nearly) whole."""
    nearest = mp.nint(value)
    if not nearly_equal(value, nearest):
        raise Fault(Code.RANGE)
    return int(nearest)


@kept
def literal(text: str) -> Real:
    """A decimal constant; error 5 when it is out of range."""
    mantissa, _, exponent = text.partition("E")
    units, _, fraction = mantissa.partition(".")
    units, fraction = units.lstrip("0"), fraction[:MOST_DIGITS]
    if len(units) > MOST_DIGITS:
        raise Fault(Code.RANGE)
    value = Real(f"0{units}.{fraction}0")
    if len(exponent) > len("-1000"):  # ten to that power would take for ever
        if value != 0 and not exponent.startswith("-"):
            raise Fault(Code.RANGE)
        return ZERO
    return in_range(value * Real(10) ** int(exponent or 0))


def show(value: Real, most: int = 8) -> str:
    """A number as PRINT writes it: at most 8 significant digits (LIST: 9), an exponent outside 0.00001…99999999."""
    if value == 0:
        return "0"
    sign = "-" if value < 0 else ""
    size = abs(value)
    exponent = int(mp.floor(mp.log10(size)))
    digits = int(mp.floor(size * Real(10) ** (most - 1 - exponent) + Real("0.5")))
    if digits < 10 ** (most - 1):  # the logarithm of a power of ten came out just too large
        exponent -= 1
        digits = int(mp.floor(size * Real(10) ** (most - 1 - exponent) + Real("0.5")))
    if digits >= 10**most:
        exponent += 1
        digits = (digits + 5) // 10
    text = str(digits).rstrip("0")
    if exponent < -5 or exponent > 7:
        mantissa = text[0] + ("." + text[1:] if text[1:] else "")
        return f"{sign}{mantissa}E{exponent}"
    if exponent < 0:
        return f"{sign}0.{'0' * (-exponent - 1)}{text}"
    text = text.ljust(exponent + 1, "0")
    whole_part, fraction = text[: exponent + 1], text[exponent + 1 :]
    return sign + whole_part + ("." + fraction if fraction else "")
