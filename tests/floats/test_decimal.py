"""Decimal in and out: DECIN reads 9 digits correctly rounded, DECOUT prints what they were, PRINT's form."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import floor

import numpy as np
import pytest
from floathelp import ERROR, OVERFLOW, STACK, Printer, X, from_rows, nearest, operands, value

Report = Callable[[str, object], None]


@pytest.fixture(scope="module")
def printer() -> Printer:
    """A board whose RST 2 writes to memory."""
    return Printer()


def form(number: Fraction, digits: int) -> str:
    """PRINT's form of a number: at most so many digits, rounded half up in size."""
    if not number:
        return "0"
    sign, number = "-" if number < 0 else "", abs(number)
    power = 0
    while number >= Fraction(10) ** power:
        power += 1
    while number < Fraction(10) ** (power - 1):
        power -= 1
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


@pytest.mark.parametrize("digits", [8, 9])
def test_out(printer: Printer, record_property: Report, digits: int) -> None:
    """The exact value, rounded half up in decimal."""
    random = np.random.default_rng(8)
    rows = [
        operands(random, 3000).bytes(),
        *(np.frombuffer(nearest(Fraction(int(n), 2**k)), np.uint8)[None] for k in range(30)
          for n in random.integers(1, 2**31, 40)),
    ]
    rows = np.concatenate(rows)
    text, batch = printer.printed(rows, digits)
    for row, got in zip(rows, text, strict=True):
        assert got == form(value(row), digits), value(row)
    record_property(
        "floats", f"DECOUT {len(rows)} numbers to {digits} digits, 0 wrong, {batch.cycles.mean():.0f} cycles"
    )


def test_out_whole(printer: Printer, record_property: Report) -> None:
    """Whole numbers of up to 8 digits, as the blocks on the tape have them, exactly and quickly."""
    random = np.random.default_rng(9)
    numbers = [*range(1000), 99999999, 99999998, 90000001, 10000000]
    numbers += np.exp(random.uniform(0, np.log(99999999), 4000)).astype(int).tolist()
    text, batch = printer.printed(np.array([list(nearest(Fraction(n))) for n in numbers], np.uint8), 8)
    assert text == [str(n) for n in numbers]
    cycles = batch.cycles[np.array(numbers) >= 10**7]
    assert cycles.max() <= 30_000
    record_property("floats", f"DECOUT {len(numbers)} whole numbers, 8 digits {cycles.mean():.0f} cycles")


@pytest.mark.parametrize(
    ("number", "text"),
    [
        ("0", "0"), ("1", "1"), ("-0.5", "-0.5"), ("0.00001", "0.00001"), ("99999999", "99999999"),
        ("100000000", "1E8"), ("0.0000099", "9.9E-6"), ("1.5e-7", "1.5E-7"), ("-15000000000", "-1.5E10"),
        ("99999999.5", "1E8"), ("12345678.5", "12345679"), ("0.125", "0.125"), ("1e38", "1E38"),
        ("1e-38", "1E-38"), ("0.999999999", "1"), ("1000", "1000"), ("1234.5", "1234.5"),
    ],
)
def test_form(printer: Printer, number: str, text: str) -> None:
    """The forms of language.md, with 8 digits."""
    row = np.frombuffer(nearest(Fraction(number)), np.uint8)[None]
    assert printer.printed(row, 8)[0] == [text]


def test_in(printer: Printer, record_property: Report) -> None:
    """Numbers of up to 9 digits: the nearest float, and LIST's 9 digits give the text's value back."""
    random = np.random.default_rng(10)
    texts = []
    for digits, power in zip(random.integers(1, 10, 6000), random.integers(-46, 38, 6000), strict=True):
        whole = int(random.integers(10 ** (digits - 1), 10**digits))
        power = int(power if random.random() < 0.3 else -random.integers(0, digits + 4))
        if -38 < power + int(digits) <= 38:
            text = form(Fraction(whole) * Fraction(10) ** power, 9)
            texts.append(text if random.random() < 0.5 else f"{whole}E{power}")
    floats, left, refused, batch = printer.read(texts)
    assert not any(refused)
    assert not any(left)
    for text, got in zip(texts, floats, strict=True):
        assert got == nearest(Fraction(text)), text
    rows = np.array([list(got) for got in floats], np.uint8)
    for text, again in zip(texts, printer.printed(rows, 9)[0], strict=True):
        assert Fraction(again) == Fraction(text)
    record_property(
        "floats", f"DECIN {len(texts)} texts, 0 not correctly rounded, {batch.cycles.mean():.0f} cycles"
    )


def test_out_and_in(printer: Printer) -> None:
    """What is printed with 9 digits is read as a float that prints the same."""
    rows = operands(np.random.default_rng(11), 2000).bytes()
    rows = rows[(rows[:, 0] > 2) & (rows[:, 0] < 255)]
    text, _ = printer.printed(rows, 9)
    signs = [got.startswith("-") for got in text]
    again, _, _, _ = printer.read([got.lstrip("-") for got in text])
    back = np.array([list(row) for row in again], np.uint8)
    back[:, 1] |= np.where(np.array(signs), 128, 0).astype(np.uint8)
    assert printer.printed(back, 9)[0] == text


@pytest.mark.parametrize(
    ("text", "number", "left"),
    [
        ("1", "1", ""), (".5", "0.5", ""), ("5.", "5", ""), ("00012", "12", ""), ("0.000", "0", ""),
        ("1 2 . 5 E 1 X", "125", "X"), ("1.2.3", "1.2", ".3"), ("7,8", "7", ",8"), ("1=1", "1", "=1"),
        ("1e5", "100000", ""), ("1E+5", "100000", ""), ("15E-1", "1.5", ""), ("2E01", "20", ""),
        ("1234567895", "1234567900", ""), ("1234567894", "1234567890", ""),
        ("0.12345678949", "0.123456789", ""), ("9999999996", "10000000000", ""),
        ("123456789012345", "123456789000000", ""), ("0." + "0" * 60 + "1E60", "0.1", ""),
        ("1" + "0" * 60 + "E-60", "1", ""), ("1E-39", "0", ""), ("1E-99", "0", ""), ("0E99", "0", ""),
        ("3END", "3", "END"), ("3E", "3", "E"), ("3EX", "3", "EX"),
    ],
)
def test_text(printer: Printer, text: str, number: str, left: str) -> None:
    """What belongs to a number and what does not; the text counts with 9 digits."""
    floats, rest, refused, _ = printer.read([text])
    assert (floats[0], rest[0], refused[0]) == (nearest(Fraction(number)), left, False)


@pytest.mark.parametrize("text", ["2E38", "1E39", "9" * 40, "1E300", "1E99"])
def test_too_large(printer: Printer, text: str) -> None:
    """A number past the range is ERR 05."""
    assert printer.read([text])[0] == [OVERFLOW]


@pytest.mark.parametrize("text", [".", ".X", ". "])
def test_no_number(printer: Printer, text: str) -> None:
    """A point alone is refused."""
    assert printer.read([text])[2] == [True]


def test_error_exit(printer: Printer) -> None:
    """Out of range leaves by RST 1."""
    printer.machine.poke(X, b"1E99\r")
    end = printer.machine.call(printer.symbols["DECIN"], hl=X, de=X + 64, sp=STACK, stops=[ERROR])
    assert end == "stop"
    assert from_rows(np.frombuffer(OVERFLOW, np.uint8)[None]).exponent[0] == 255
