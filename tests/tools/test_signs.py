"""Signs that are not ASCII, at every door of the board: skg80's part, tape, pipe and keyboard, skg and `skg term`."""

from __future__ import annotations

import re
import subprocess
import unicodedata
from pathlib import Path

import pytest
from facthelp import pattern
from toolhelp import SKG

from skg.board.board import Board
from skg.errors import UserError
from skg.files import board_text
from skg.messages.finding import Finding, Phrase
from skg.signs import Keys, with_signs

SKG80 = Path(__file__).parents[2] / "build" / "skg80"
PROGRAM = "10 PRINT “５−3”；５−３，2×3\n20 END\n".replace("；", ",")
#: A few of other planes beside all that two bytes of UTF-16 hold.
CHARACTERS = [*range(0x80, 0xD800), *range(0xE000, 0x10000), 0x1D7CE, 0x1F600, 0x10FFFF]


def skg80(*arguments: str | Path, typed: bytes = b"") -> subprocess.CompletedProcess[bytes]:
    return subprocess.run([SKG80, *arguments], input=typed, capture_output=True, check=False)


def test_the_same_signs_in_c_as_in_python() -> None:
    """Each character in a line of its own at a pipe, behind REM where it has a sign."""
    signs = [with_signs(chr(code)) for code in CHARACTERS]
    lines = [("REM" if sign.isascii() else "") + chr(code) for sign, code in zip(signs, CHARACTERS, strict=True)]
    done = skg80(typed="\n".join(lines).encode())
    refused = {int(line): said for line, said in re.findall(r"line (\d+), column 1: (.*) is not", done.stderr.decode())}
    assert refused.keys() == {line for line, sign in enumerate(signs, 1) if not sign.isascii()}
    assert re.findall(r">REM(.)\r", done.stdout.decode()) == [sign for sign in signs if sign.isascii()]
    assert done.returncode == 1
    # No control, blank, mark on another sign or right-to-left sign is shown as itself.
    seen = [said[1:-1] for said in refused.values() if said[0] == "'"]
    assert not [sign for sign in seen if unicodedata.category(sign) in ("Cc", "Cf", "Zs", "Zl", "Zp", "Mn", "Me")]
    assert not [sign for sign in seen if unicodedata.bidirectional(sign) in ("R", "AL")]
    assert {"'é'", "'≠'", "'扳'", "U+202E", "U+FEFF", "U+0085"} <= set(refused.values())


def test_a_lost_minus(tmp_path: Path) -> None:
    """The same paper by every way in."""
    part = tmp_path / "part.skg"
    part.write_text(PROGRAM, encoding="utf-8")
    wanted = b"5-3 2 6\r\n"
    assert wanted in skg80(part).stderr
    assert wanted in skg80("--tape", part, typed=b"LOAD\nRUN\n").stdout
    assert wanted in skg80(typed=PROGRAM.encode() + b"RUN\n").stdout
    assert wanted in subprocess.run([SKG, "run", part], capture_output=True, check=True).stderr
    assert (
        wanted.decode().strip() in subprocess.run([SKG, "ref", part], capture_output=True, check=True, text=True).stderr
    )
    board = Board()
    assert board.type("PRINT 5−3") == ["2"]
    with pytest.raises(UserError, match=pattern(Phrase("not-ascii-typed", column=8, character="'é'"))):
        board.type("PRINT 5é3")


@pytest.mark.parametrize(
    ("line", "place"),
    [
        ("10 PRINT 5–é3".encode(), "line 2, column 12: 'é'"),
        (b"10 PRINT 5\x963", "line 2, column 11: byte 96H"),
        (b"10 PRINT 5\xe2\x883", "line 2, column 11: byte E2H"),
        (b"10 PRINT 5\xed\xa0\x80", "line 2, column 11: byte EDH"),
        ("10 PRINT 5\u202e".encode(), "line 2, column 11: U+202E"),
    ],
)
def test_what_has_no_sign_is_refused_with_its_place(line: bytes, place: str, tmp_path: Path) -> None:
    text = b"\xef\xbb\xbf5 REM\r\n" + line + b"\n"
    where, _, sign = place.partition(": ")
    line_, column = map(int, re.findall(r"\d+", where))
    with pytest.raises(UserError) as refused:
        board_text(text, "part.skg")
    finding = refused.value.finding
    assert (finding.code, finding["line"], finding["column"]) == ("not-ascii", line_, column)
    assert str(finding["character"]) == sign
    part = tmp_path / "part.skg"
    part.write_bytes(text)
    asks = tmp_path / "asks.skg"
    asks.write_bytes(b"10 INPUT D\n20 INPUT D\n30 END\n")
    for done in (skg80(part), skg80("--tape", part), skg80(asks, "--input", part)):
        assert (done.returncode, done.stdout) == (2, b"")
        assert done.stderr.decode().endswith(f"skg80: {part}: {place} is not ASCII\n")


def parity(data: bytes, kind: str) -> bytes:
    """A paper tape of the period."""
    ones = [byte.bit_count() & 1 for byte in data]
    return bytes(
        byte | 0x80 * (kind == "mark" or odd == (kind == "even")) for byte, odd in zip(data, ones, strict=True)
    )


@pytest.mark.parametrize("kind", ["even", "odd", "mark"])
def test_a_paper_tape_with_parity_is_read(kind: str, tmp_path: Path) -> None:
    tape = tmp_path / "tape"
    tape.write_bytes(bytes(20) + parity(b"10 PRINT 5-3\r\n20 END\r\n", kind) + bytes(20))
    assert b"\r\n2\r\n" in skg80("--tape", tape, typed=b"LOAD\nRUN\n").stdout


def test_keys_of_a_terminal() -> None:
    """A line is dropped from its first strange character on, however it comes in; editing keys count."""
    keys = Keys()
    sent, refused = b"", list[Finding]()
    for byte in "A−1\rPRI\bI\x7fé×\x11 3\nLIST\r😀\x03B\x15\r".encode():
        more, findings = keys.feed(bytes([byte]))
        sent += more
        refused += findings
    assert sent == b"A-1\rPRI\bI\x7f\x15\x11LIST\r\x03B\x15\r"
    assert [(each["column"], each["character"]) for each in refused] == [(3, "'é'"), (1, "'😀'")]
