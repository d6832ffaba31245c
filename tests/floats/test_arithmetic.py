"""+ - * / and the square root, correctly rounded; whole numbers; signs. Over a million operands each way."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import floor, isqrt

import numpy as np
import pytest
from floathelp import (
    ERANGE,
    HIDDEN,
    OVERFLOW,
    STACK,
    Firmware,
    Floats,
    X,
    Y,
    difference,
    from_rows,
    nearest,
    operands,
    pairs,
    product,
    quotient,
    total,
    value,
)
from numpy.typing import NDArray

N = 300_000
SAMPLE = 3_000
OPERATIONS = {
    "FADD": (total, lambda a, b: a + b),
    "FSUB": (difference, lambda a, b: a - b),
    "FMUL": (product, lambda a, b: a * b),
    "FDIV": (quotient, lambda a, b: a / b if b else Fraction(2) ** 200),
}
Report = Callable[[str, object], None]


def unlike(got: NDArray[np.uint8], want: NDArray[np.uint8]) -> NDArray[np.int64]:
    """Numbers of the rows that differ."""
    return np.flatnonzero((got != want).any(axis=1))


@pytest.mark.parametrize("name", OPERATIONS)
def test_model(name: str) -> None:
    """The numpy model of each operation is exact arithmetic, rounded once."""
    model, exact = OPERATIONS[name]
    x, y = pairs(np.random.default_rng(1), SAMPLE)
    for row, a, b in zip(model(x, y), x.fractions(), y.fractions(), strict=True):
        want = nearest(exact(a, b))
        assert row.tobytes() == want, (name, a, b)


@pytest.mark.parametrize("name", OPERATIONS)
def test_operation(firmware: Firmware, record_property: Report, name: str) -> None:
    """Every result is the float nearest to the true one; 0 below the range, ERR above."""
    model, _ = OPERATIONS[name]
    x, y = pairs(np.random.default_rng(2), N)
    got, batch = firmware.binary(name, x, y)
    bad = unlike(got, model(x, y))
    assert not len(bad), [(x.bytes()[i].tobytes().hex(), y.bytes()[i].tobytes().hex()) for i in bad[:5]]
    record_property("floats", f"{name} {N} pairs, 0 not correctly rounded, {batch.cycles.mean():.0f} cycles")


def test_same_operand(firmware: Firmware) -> None:
    """x and y may be one float."""
    x = operands(np.random.default_rng(3), 2000)
    for name, model in (("FADD", total), ("FMUL", product), ("FSUB", difference)):
        batch = firmware.batch(name, x.bytes(), X, 5, de=X, hl=X)
        want = model(x, x)
        for i, row in enumerate(np.frombuffer(batch.outputs, np.uint8).reshape(-1, 5)):
            assert batch.ends[i] or row.tobytes() == want[i].tobytes()


def test_judge_of_roots() -> None:
    """A root that is wrong in its last bit is seen."""
    rows = np.array([[0x82, 0, 0, 0, 0]], np.uint8)
    root = from_rows(np.array([[0x81, 0x35, 0x04, 0xF3, 0x34]], np.uint8))
    assert root_error(from_rows(rows), root)[0] < 0.5
    assert root_error(from_rows(rows), Floats(root.sign, root.exponent, root.mantissa + np.uint64(1)))[0] > 1


def root_error(x: Floats, root: Floats) -> list[float]:
    """Errors of the roots of x, in units of their last place (exact, from whole numbers)."""
    errors = []
    for mantissa, exponent, got, power in zip(
        x.mantissa.tolist(), x.exponent.tolist(), root.mantissa.tolist(), root.exponent.tolist(), strict=True
    ):
        # root of mantissa * 2^(exponent-160) in units of 2^(power-160-20)
        shift = exponent - 160 - 2 * (power - 180)
        errors.append(abs(isqrt(mantissa << shift) / 2**20 - got))
    return errors


def test_square_root(firmware: Firmware, record_property: Report) -> None:
    """At most 0.51 units of the last place; exact for squares; ERR below 0."""
    x = operands(np.random.default_rng(4), N)
    got, batch = firmware.unary("FSQR", x)
    negative = (x.sign == 1) & (x.exponent > 0)
    assert (got[negative] == 255).all()
    assert not got[x.exponent == 0].any()
    fine = np.flatnonzero((x.sign == 0) & (x.exponent > 0))
    roots = from_rows(got[fine])
    x = x.take(fine)
    wide = x.mantissa << (np.uint64(31) + (x.exponent % 2 == 0).astype(np.uint64))
    whole = np.sqrt(wide.astype(np.float64)).astype(np.uint64)
    whole -= whole * whole > wide
    whole += wide - whole * whole > np.uint64(2) * whole
    rounded = whole + (wide - whole * whole > whole)
    want = packed_root(rounded, x.exponent)
    bad = unlike(got[fine], want)
    worst = max([0.5, *root_error(x.take(bad), roots.take(bad))])
    assert worst <= 0.51
    cycles = batch.cycles[fine].mean()
    record_property("floats", f"FSQR {len(fine)} operands, worst {worst:.6f} ulp, {cycles:.0f} cycles")
    n = np.arange(1, 3000, dtype=np.uint64)
    squares = from_rows(np.array([list(nearest(Fraction(int(k) ** 2))) for k in n], np.uint8))
    got, _ = firmware.unary("FSQR", squares)
    assert [value(row) for row in got] == list(range(1, 3000))


def packed_root(mantissa: NDArray[np.uint64], exponent: NDArray[np.int64]) -> NDArray[np.uint8]:
    """Roots as rows of bytes, from their mantissas and the exponents of the operands."""
    power = (exponent + 1) // 2 + 64
    carry = mantissa >> np.uint64(32) > 0
    zero = np.zeros(len(mantissa), np.uint64)
    return Floats(zero, power + carry, np.where(carry, HIDDEN, mantissa)).bytes()


def test_floor(firmware: Firmware, record_property: Report) -> None:
    """The greatest whole number not above, exactly."""
    x = operands(np.random.default_rng(5), 40_000)
    got, batch = firmware.unary("FFLR", x)
    for row, number in zip(got, x.fractions(), strict=True):
        assert row.tobytes() == nearest(Fraction(floor(number)))
    record_property("floats", f"FFLR {len(x)} operands, 0 wrong, {batch.cycles.mean():.0f} cycles")


def test_whole_numbers(firmware: Firmware) -> None:
    """0 ... 65535 to floats and back; what is no such number sets carry."""
    machine = firmware.machine
    for number in [*range(0, 65536, 37), 1, 2, 255, 256, 32767, 32768, 65534, 65535]:
        assert machine.call(firmware.symbols["FITOF"], hl=number, de=X, sp=STACK) == "returned"
        assert machine.peek(X, 5) == nearest(Fraction(number))
        assert machine.call(firmware.symbols["FTOI16"], hl=X, sp=STACK) == "returned"
        assert (machine.registers["hl"], machine.registers["f"] & 1) == (number, 0)
    for text in ["65536", "-1", "0.5", "1.5", "65535.5", "1e30", "1e-30", "-0.001", "4294967296", "65535.99998"]:
        machine.poke(X, nearest(Fraction(text)))
        machine.call(firmware.symbols["FTOI16"], hl=X, sp=STACK)
        assert machine.registers["f"] & 1, text


def test_signs(firmware: Firmware) -> None:
    """FNEG, FABS and FSGN; zero stays zero."""
    x = operands(np.random.default_rng(6), 5000)
    numbers = x.fractions()
    for name, function in (("FNEG", lambda number: -number), ("FABS", abs)):
        got, _ = firmware.unary(name, x)
        assert [row.tobytes() for row in got] == [nearest(function(number)) for number in numbers]
    signs = firmware.batch("FSGN", x.bytes(), X, 5, hl=X).registers["a"]
    assert signs.tolist() == [0 if not number else 255 if number < 0 else 1 for number in numbers]


@pytest.mark.parametrize(
    ("name", "x", "y"),
    [("FDIV", "1", "0"), ("FDIV", "0", "0"), ("FMUL", "1e30", "1e30"), ("FADD", "1.5e38", "1e38")],
)
def test_out_of_range(firmware: Firmware, name: str, x: str, y: str) -> None:
    """Division by zero and overflow are ERR 05."""
    machine = firmware.machine
    machine.poke(X, nearest(Fraction(x)))
    machine.poke(Y, nearest(Fraction(y)))
    assert machine.call(firmware.symbols[name], de=X, hl=Y, sp=STACK, stops=[8]) == "stop"
    assert machine.peek(machine.peek16(machine.registers["sp"]))[0] == ERANGE
    assert nearest(Fraction(10) ** 40) == OVERFLOW
