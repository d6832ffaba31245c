"""Decimal in and out: DECIN reads 9 digits correctly rounded, DECOUT prints what they were, PRINT's form.

That holds up to a power of ten of 10^13, which is exact; beyond, the error is bounded.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import floor

import numpy as np
import pytest
from floathelp import ERANGE, ERROR, ESYN, OVERFLOW, STACK, Printer, X, nearest, operands, value

from skg.board import Batch

Report = Callable[[str, object], None]
#: Powers of ten up to this are exact in a float: so far each conversion rounds once.
EXACT = 13
#: Largest relative error of a conversion beyond: ten roundings.
FAR = Fraction(10, 1 << 32)


@pytest.fixture(scope="module")
def printer() -> Printer:
    """A board whose RST 2 writes to memory."""
    return Printer()


def places(number: Fraction) -> int:
    """Digits before the point of a positive number: 3 for 123.4, 0 for 0.5, -1 for 0.05."""
    power = floor((number.numerator.bit_length() - number.denominator.bit_length() - 1) * 0.30103)
    while number >= Fraction(10) ** power:
        power += 1
    return power


def form(number: Fraction, digits: int) -> str:
    """PRINT's form of a number: at most so many digits, rounded half up in size."""
    if not number:
        return "0"
    sign, number = "-" if number < 0 else "", abs(number)
    power = places(number)
    whole = floor(number * Fraction(10) ** (digits - power) + Fraction(1, 2))
    if whole == 10**digits:
        whole, power = whole // 10, power + 1
    text = str(whole).rstrip("0")
    if not -4 <= power <= 8:
        return f"{sign}{text[0]}{'.' * (len(text) > 1)}{text[1:]}E{power - 1}"
    if power <= 0:
        return f"{sign}0.{'0' * -power}{text}"
    text = text.ljust(power, "0")
    return f"{sign}{text[:power]}{'.' * (len(text) > power)}{text[power:]}"


def scaled(number: Fraction, digits: int) -> tuple[int, str]:
    """DECOUT's method: the power of ten that it multiplies by, and the text that it prints.

    It multiplies by the least power of ten that leaves `digits` digits before the point, rounded to a float, and
    rounds that half up. Right where that power is at most 10^EXACT and so exact.
    """
    size = abs(number)
    power = digits - places(size) - 1
    while (product := value(nearest(size * Fraction(10) ** power))) < 10 ** (digits - 1):
        power += 1
    whole = floor(value(nearest(product + Fraction(1, 2))))
    return power, form((-1 if number < 0 else 1) * whole / Fraction(10) ** power, digits)


@pytest.mark.parametrize("digits", [8, 9])
def test_out(printer: Printer, record_property: Report, digits: int) -> None:
    """Scaled by one operation, rounded half up in decimal; beyond 10^EXACT next to the exact value."""
    random = np.random.default_rng(8)
    rows = [
        operands(random, 3000).bytes(),
        *(
            np.frombuffer(nearest(Fraction(int(n), 2**k)), np.uint8)[None]
            for k in range(30)
            for n in random.integers(1, 2**31, 40)
        ),
    ]
    rows = np.concatenate(rows)
    text, batch = printer.printed(rows, digits)
    far, worst = 0, 0.0
    for row, got in zip(rows, text, strict=True):
        number = value(row)
        if not number:
            assert got == "0"
            continue
        power, want = scaled(number, digits)
        if abs(power) <= EXACT or number.denominator == 1 and abs(number) < 1 << 26:
            assert got == want, number
        else:
            unit = Fraction(10) ** (places(abs(number)) - digits)
            error = abs(Fraction(got) - number)
            assert error <= unit / 2 + FAR * abs(number), number
            far, worst = far + 1, max(worst, float(error / abs(number) * 2**32))
    assert far
    record_property(
        "floats",
        f"DECOUT {len(rows)} numbers to {digits} digits, 0 wrong ({far} beyond 10^{EXACT}),"
        f" {batch.cycles.mean():.0f} cycles",
    )


def test_out_ties(printer: Printer) -> None:
    """A number half way between two numbers of 8 digits is rounded up in size."""
    random = np.random.default_rng(13)
    halves = []
    for power in range(8):
        wholes = random.integers(10**7, 10**8, 80).tolist()
        halves += [f for n in wholes if value(nearest(f := Fraction(2 * n + 1, 2 * 10**power))) == f]
    assert len(halves) > 50
    text, _ = printer.printed(np.array([list(nearest(f)) for f in halves], np.uint8), 8)
    assert text == [form(f, 8) for f in halves]


def test_out_whole(printer: Printer, record_property: Report) -> None:
    """Whole numbers of up to 8 digits, as the blocks on the tape have them, exactly; below 2^26 quickly."""
    random = np.random.default_rng(9)
    numbers = [*range(1000), 99999999, 99999998, 90000001, 10000000, (1 << 26) - 1, 1 << 26]
    numbers += np.exp(random.uniform(0, np.log(99999999), 4000)).astype(int).tolist()
    text, batch = printer.printed(np.array([list(nearest(Fraction(n))) for n in numbers], np.uint8), 8)
    assert text == [str(n) for n in numbers]
    cycles = batch.cycles[np.array(numbers) < 1 << 26]
    assert cycles.max() <= 30_000
    record_property("floats", f"DECOUT {len(numbers)} whole numbers, below 2^26 {cycles.mean():.0f} cycles")


def test_out_thousandths(printer: Printer) -> None:
    """Whole micrometres as millimetres, as ISO blocks have them: exactly, up to 99,999.999, and quickly."""
    random = np.random.default_rng(10)
    numbers = [*range(1100), 99999999, 90000001, 10000000, 99999000, (1 << 26) - 1, 1 << 26, (1 << 26) + 1]
    numbers += np.exp(random.uniform(0, np.log(99999999), 2000)).astype(int).tolist()
    numbers += [-n for n in numbers]
    text, batch = printer.printed(np.array([list(nearest(Fraction(n))) for n in numbers], np.uint8), 9, -3)
    assert text == [form(Fraction(n, 1000), 9) for n in numbers]
    assert batch.cycles.max() <= 30_000


@pytest.mark.parametrize(
    ("number", "text"),
    [
        ("0", "0"), ("1", "1"), ("-0.5", "-0.5"), ("0.00001", "0.00001"), ("99999999", "99999999"),
        ("100000000", "1E8"), ("0.0000099", "9.9E-6"), ("1.5e-7", "1.5E-7"), ("-15000000000", "-1.5E10"),
        ("99999999.5", "1E8"), ("12345678.5", "12345679"), ("0.125", "0.125"), ("1e38", "1E38"),
        ("1e-38", "1E-38"), ("0.999999999", "1"), ("1000", "1000"), ("1234.5", "1234.5"),
    ],
)  # fmt: skip
def test_form(printer: Printer, number: str, text: str) -> None:
    """The forms of language.md, with 8 digits."""
    row = np.frombuffer(nearest(Fraction(number)), np.uint8)[None]
    assert printer.printed(row, 8)[0] == [text]


def read_back(printer: Printer, texts: list[str]) -> tuple[int, Batch]:
    """Numbers of up to 9 digits are read as the nearest float, which 9 digits print as the same number again.

    Where the power of ten is not exact they come out next to it. Returns how many of those there were.
    """
    floats, left, batch = printer.read(texts)
    assert not any(left)
    rows = np.array([list(got) for got in floats], np.uint8)
    far = 0
    for text, got, again in zip(texts, floats, printer.printed(rows, 9)[0], strict=True):
        number = Fraction(text)
        mantissa, _, exponent = text.partition("E")
        power = len(mantissa.partition(".")[2]) - int(exponent or 0)
        if abs(power) <= EXACT:
            assert got == nearest(number), text
        else:
            far += 1
            assert abs(value(got) - number) <= FAR * number, text
        if max(abs(power), abs(9 - places(number))) <= EXACT:
            assert Fraction(again) == number, text
        else:
            assert abs(Fraction(again) - number) <= 3 * FAR * number, text
    return far, batch


def test_in(printer: Printer, record_property: Report) -> None:
    """Numbers of up to 9 digits of all sizes."""
    random = np.random.default_rng(10)
    texts = []
    for digits, power in zip(random.integers(1, 10, 20000), random.integers(-46, 38, 20000), strict=True):
        whole = int(random.integers(10 ** (digits - 1), 10**digits))
        power = int(power if random.random() < 0.3 else -random.integers(0, digits + 4))
        if -37 < power + int(digits) <= 38:
            text = form(Fraction(whole) * Fraction(10) ** power, 9)
            texts.append(text if random.random() < 0.5 else f"{whole}E{power}")
    far, batch = read_back(printer, texts)
    assert far
    record_property(
        "floats",
        f"DECIN {len(texts)} texts, 0 not correctly rounded ({far} beyond 10^{EXACT}),"
        f" {batch.cycles.mean():.0f} cycles",
    )


def test_in_nasty(printer: Printer, record_property: Report) -> None:
    """Numbers of 9 digits next to powers of ten and of two, where floats lie widest apart, up to both ends."""
    texts = []
    for power in range(-EXACT, EXACT + 1):
        texts += [
            f"{whole}E{power}"
            for end in (10**8, 10**9 - 1)
            for whole in range(end - 60, end + 60)
            if 10**7 < whole < 10**9
        ]
    for power in range(-16, 74):
        size = Fraction(2) ** power
        unit = 9 - places(size)
        whole = floor(size * Fraction(10) ** unit)
        texts += [f"{n}E{-unit}" for n in range(whole - 40, whole + 40) if n < 10**9]
    far, _ = read_back(printer, texts)
    assert not far
    record_property("floats", f"DECIN and DECOUT {len(texts)} nasty texts, all come back")


def test_out_and_in(printer: Printer) -> None:
    """A number printed with 9 digits is read as a float that prints the same, from 1E-4 to 1E22."""
    rows = operands(np.random.default_rng(11), 2000).bytes()
    rows = np.array([row for row in rows if 10**-4 <= abs(value(row)) < 10**22])
    text, _ = printer.printed(rows, 9)
    signs = [got.startswith("-") for got in text]
    again, _, _ = printer.read([got.lstrip("-") for got in text])
    back = np.array([list(row) for row in again], np.uint8)
    back[:, 1] |= np.where(np.array(signs), 128, 0).astype(np.uint8)
    assert printer.printed(back, 9)[0] == text


@pytest.mark.parametrize(
    ("text", "number", "left"),
    [
        ("1", "1", ""), (".5", "0.5", ""), ("5.", "5", ""), ("00012", "12", ""), ("0.000", "0", ""),
        ("1 2 . 5 E 1 X", "125", "X"), ("1.2.3", "1.2", ".3"), ("7,8", "7", ",8"), ("1=1", "1", "=1"),
        ("1e5", "100000", ""), ("1E+5", "100000", ""), ("15E-1", "1.5", ""), ("2E01", "20", ""),
        ("1234567895", "1234567895", ""), ("4294967295", "4294967295", ""),
        ("429496729599999", "429496729500000", ""), ("0.42949672959999", "0.4294967295", ""),
        ("0." + "0" * 60 + "1E60", "0.1", ""), ("0.1" + "0" * 60, "0.1", ""),
        ("1" + "0" * 60 + "E-60", "1", ""), ("1E-39", "0", ""), ("1E-99", "0", ""), ("0E99", "0", ""),
        ("3END", "3", "END"), ("3E", "3", "E"), ("3EX", "3", "EX"),
    ],
)  # fmt: skip
def test_text(printer: Printer, text: str, number: str, left: str) -> None:
    """DECIN reads a number and stops at the right character; digits past 2^31 change the power alone."""
    floats, rest, _ = printer.read([text])
    assert (floats[0], rest[0]) == (nearest(Fraction(number)), left)


@pytest.mark.parametrize("text", ["2E38", "1E39", "9" * 40, "1E300", "1E99"])
def test_too_large(printer: Printer, text: str) -> None:
    """A number past the range is ERR 05."""
    assert printer.read([text])[0] == [OVERFLOW]


@pytest.mark.parametrize(("text", "error"), [(".", ESYN), (".X", ESYN), (". ", ESYN), ("1E99", ERANGE)])
def test_error_exit(printer: Printer, text: str, error: int) -> None:
    """A point alone is refused, and what is out of range; both leave by RST 1."""
    printer.machine.poke(X, text.encode() + b"\r")
    end = printer.machine.call(printer.symbols["DECIN"], hl=X, de=X + 64, sp=STACK, stops=[ERROR])
    assert end == "stop"
    assert printer.machine.peek(printer.machine.peek16(printer.machine.registers["sp"]))[0] == error
