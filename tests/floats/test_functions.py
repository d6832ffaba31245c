"""SIN COS TG ATG in degrees, against mpmath: 2^-30 of the value, near a zero of the argument's last bit."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import mpmath as mp
import numpy as np
import pytest
from floathelp import Firmware, from_rows, nearest, value

N = 6000
BOUND = 2.0**-30
Report = Callable[[str, object], None]

mp.mp.dps = 30
DEGREE = mp.pi / 180
TRUE: dict[str, Callable[[mp.mpf], mp.mpf]] = {
    "FSIN": lambda v: mp.sin(v * DEGREE),
    "FCOS": lambda v: mp.cos(v * DEGREE),
    "FTG": lambda v: mp.tan(v * DEGREE),
    "FATG": lambda v: mp.atan(v) / DEGREE,
}
EXACT = {
    "FSIN": {**{k * 180: 0 for k in range(-4, 5)}, **{90 + k * 360: 1 for k in range(-2, 3)}},
    "FCOS": {**{90 + k * 180: 0 for k in range(-4, 5)}, **{k * 360: 1 for k in range(-2, 3)}},
    "FTG": {**{k * 180: 0 for k in range(-4, 5)}, **{45 + k * 180: 1 for k in range(-4, 5)}},
    "FATG": {0: 0, 1: 45, -1: -45},
}
EXACT["FSIN"] |= {270 + k * 360: -1 for k in range(-2, 3)}
EXACT["FCOS"] |= {180 + k * 360: -1 for k in range(-2, 3)}
EXACT["FTG"] |= {135 + k * 180: -1 for k in range(-4, 5)}
HALF = Fraction(1, 2)
for turn in (-720, -360, 0, 360, 720):
    EXACT["FSIN"] |= {turn + 30: HALF, turn + 150: HALF, turn + 210: -HALF, turn + 330: -HALF}
    EXACT["FCOS"] |= {turn + 60: HALF, turn + 300: HALF, turn + 120: -HALF, turn + 240: -HALF}


def rows(numbers: list[Fraction]) -> np.ndarray:
    """The floats nearest to some numbers, as rows of bytes."""
    return np.array([list(nearest(number)) for number in numbers], np.uint8)


def arguments(name: str) -> list[Fraction]:
    """Angles up to ten turns and small ones (numbers of any size for ATG), and the ones close to multiples of 15."""
    random = np.random.default_rng(7)
    small = np.exp2(random.uniform(-30, 0, N // 4))
    if name == "FATG":
        parts = [small, random.uniform(0, 3, N // 4), np.exp2(random.uniform(0, 40, N // 4))]
    else:
        around = 15 * random.integers(-24, 25, N // 4) + np.exp2(random.uniform(-24, -2, N // 4))
        parts = [small, random.uniform(-360, 360, N // 4), random.uniform(-3600, 3600, N // 4), around]
    numbers = np.concatenate(parts) * random.choice([-1, 1], sum(map(len, parts)))
    return [Fraction(number) for number in numbers.tolist()]


@pytest.mark.parametrize("name", TRUE)
def test_function(firmware: Firmware, record_property: Report, name: str) -> None:
    """Worst relative error below 2^-30; what is not near a zero of the function is held to that alone."""
    inputs = rows(arguments(name))
    got, batch = firmware.function(name, from_rows(inputs))
    assert not batch.failures
    worst = 0.0
    for row, answer in zip(inputs, got, strict=True):
        number, result = (mp.mpf(v.numerator) / v.denominator for v in (value(row), value(answer)))
        true = TRUE[name](number)
        error = float(abs(result - true) / abs(true))
        assert error <= BOUND, (name, float(number), float(result), error / BOUND)
        worst = max(worst, error)
    record_property(
        "floats",
        f"{name} {len(inputs)} operands, worst 2^{np.log2(worst):.2f}, {batch.cycles.mean():.0f} cycles",
    )


@pytest.mark.parametrize("name", EXACT)
def test_exact(firmware: Firmware, name: str) -> None:
    """True values of 0, 1/2, 1 and 45 with exact arguments come out exact."""
    table = EXACT[name]
    got, _ = firmware.function(name, from_rows(rows([Fraction(number) for number in table])))
    assert {n: value(row) for n, row in zip(table, got, strict=True)} == table


def test_no_tangent(firmware: Firmware) -> None:
    """TG of odd multiples of 90 is an error, of their neighbours it is not."""
    angles = [Fraction(90 + 180 * k) for k in range(-4, 5)]
    for angle in angles:
        got, _ = firmware.function("FTG", from_rows(rows([angle])))
        assert (got == 255).all()
    got, _ = firmware.function("FTG", from_rows(rows([angle + Fraction(1, 10**5) for angle in angles])))
    assert all(value(row) < -(10**6) for row in got)


def test_far_away(firmware: Firmware) -> None:
    """Angles: good up to 2^33 degrees, an error beyond; tiny ones keep their size. ATG of the largest is 90."""
    for power in (30, 33, 34):
        number = Fraction(2) ** power - 1000 * (power < 34)
        for name in ("FSIN", "FCOS"):
            got, _ = firmware.function(name, from_rows(rows([number])))
            if power == 34:
                assert (got == 255).all()
            else:
                true = float(TRUE[name](mp.mpf(int(number))))
                assert abs(float(value(got[0])) / true - 1) <= BOUND
    got, _ = firmware.function("FATG", from_rows(rows([Fraction(10) ** 38, -(Fraction(10) ** 38)])))
    assert [value(row) for row in got] == [90, -90]
    tiny = Fraction(1, 10**30)
    for name in ("FSIN", "FTG"):
        got, _ = firmware.function(name, from_rows(rows([tiny, -tiny])))
        up, down = map(value, got)
        assert up == -down
        assert abs(float(up) * 180 / np.pi / 1e-30 - 1) < 1e-8
