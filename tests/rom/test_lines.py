"""Lines that are refused: firmware and reference agree on the error, on the place, on every limit.

The first place that is wrong decides, whether it is the grammar, a constant out of range or a subscript.
"""

from __future__ import annotations

import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from romhelp import ROM, Board, fault

from skg.ref.listing import listed
from skg.ref.parser import LineFault, parse_line, remark, squeeze

#: For the tests that need no new board each time.
BOARD = Board() if ROM.exists() else None


def verdict(line: str) -> int | None:
    """The error that the reference finds in a line while it reads it."""
    try:
        parse_line(line)
    except LineFault as found:
        return int(found.code)
    return None


MARKED = {
    "PRINT .": ("      ^", 1),
    "PRINT 1,. ,2": ("        ^", 1),
    "PRINT 1E99": ("      ^", 5),
    "PRINT 1,2E38,3": ("        ^", 5),
    "10 A=1E99": ("     ^", 5),
    "PRINT P1000": ("      ^", 5),
    "P1000=(1,2)": ("^", 5),
    "READ A,P1000": ("       ^", 5),
    "PRINT 5,(,1E99": ("         ^", 1),
    "PRINT 5,1E99,(": ("        ^", 5),
    "PRINT )+P1000": ("      ^", 1),
    "IF 1=1E99 GOTO 5": ("     ^", 5),
    "IF A= GOTO 1E99": ("         ^", 1),
    "CUT X,,1E99": ("      ^", 1),
    "CUT X,Y)1E99": ("       ^", 1),
    "PRINT ..5": ("      ^", 1),
    '10 PRINT "A"1E99': ("            ^", 5),
    "10 GOTO 1E99": ("        ^", 5),
    "10 GOTO 70000": ("            ^", 1),
    "READ 1E99": ("     ^", 5),
    "PRINT 5,(1E99,": ("         ^", 5),
    "A=P1000+": ("  ^", 5),
    "1E99 A=1": ("^", 5),
    "A[1E99]=3": ("  ^", 5),
    "GOTO .": ("     ^", 1),
    "PRINT 1E38,1.8E38": ("           ^", 5),
    "PRINT 1E5000": ("      ^", 5),
    'PRINT "1E99",.,': ("             ^", 1),
}


@pytest.mark.parametrize("line", MARKED)
def test_the_first_wrong_place_is_marked(line: str) -> None:
    mark, code = MARKED[line]
    board = Board()
    paper = board.type(line)
    assert fault(paper) == (code, None)
    assert verdict(line) == code
    assert paper[0] == line
    assert paper[1] == mark
    assert board.load(f"10 END\n{line}\n20 END\n") == paper
    assert board.listing() == ["10 END"]
    # The machine is none the worse.
    assert board.type(line) == paper
    assert board.type("PRINT 1/3") == ["0.33333333"]


WHOLE = {
    "1E-99": "0",
    "1E-100": "0",
    "1E-5000": "0",
    "1E-999999999999": "0",
    "0E999": "0",
    "0E-999": "0",
    "0.000E99999": "0",
    "0." + "0" * 100 + "1E101": "1",
    "0." + "0" * 100 + "1E100": "0.1",
    "1" + "0" * 100 + "E-100": "1",
    "1" + "0" * 60 + "E-99": "1E-39",
    "1" + "0" * 60 + "E-40": "1E20",
    "1.5E37": "1.5E37",
    "170000000000000000000000000000000000000": "1.7E38",
    "000000000000000000000000000000000000000000000001": "1",
}


@pytest.mark.parametrize("text", WHOLE)
def test_only_the_value_of_a_constant_counts(text: str) -> None:
    shown = BOARD.type(f"PRINT {text}")
    assert shown == [WHOLE[text]] or (text.endswith("E-99") and shown == ["0"])
    assert verdict(f"PRINT {text}") is None


@pytest.mark.parametrize(
    "text",
    ["1E39", "1E99", "1E100", "1E128", "1E255", "1E256", "1E999", "1E1000", "1E5000", "0.01E41", "1.8E38", "9" * 39,
     "9" * 110, "0." + "0" * 50 + "1E90", "1" + "0" * 100 + "E-50"],
)  # fmt: skip
def test_constants_out_of_range(text: str) -> None:
    paper = BOARD.type(f"PRINT {text}")
    assert paper == [f"PRINT {text}", "      ^", "ERR 05"]
    assert verdict(f"PRINT {text}") == 5


@pytest.mark.parametrize("numbered", ["", "10 "])
@pytest.mark.parametrize("extra", range(9))
def test_room_for_the_words_of_a_line(numbered: str, extra: int) -> None:
    """Byte for byte where the reference draws the line; a line that does not fit is shown."""
    line = f"{numbered}PRINT {'1,' * 34}1,{'-' * extra}A"
    code = verdict(line)
    paper = BOARD.type(line)
    if code is None:
        assert fault(paper) in (None, (3, None))
    else:
        assert code == 9
        assert paper == [line, f"{' ' * len(line)}^", "ERR 09"]
    assert (code is None) == (6 * bool(numbered) + 1 + 35 * 7 + extra + 2 <= 254)
    BOARD.type("NEW")


def test_fifteen_points_in_a_cut() -> None:
    board = Board()
    points = [f"({n % 10},{n // 10})" for n in range(16)]
    assert board.type(f"10 CUT {','.join(points[:15])}") == []
    assert board.type("RUN")[-2].startswith("0014 B")
    assert fault(board.type(f"10 CUT {','.join(points)}")) == (9, None)
    assert len(board.listing()[0]) == len(f"10 CUT {','.join(points[:15])}")


def test_thirty_five_numbers_run() -> None:
    board = Board()
    numbers = ",".join(str(n % 10) for n in range(35))
    for line in (f"10 DATA {numbers}", "20 I=0", "30 READ A", "40 J=J+A", "50 I=I+1", "60 IF I<35 GOTO 30",
                 "15 J=0", "70 PRINT J", f"80 PRINT {numbers}"):  # fmt: skip
        assert board.type(line) == []
    assert board.type("RUN") == ["145", numbers.replace(",", " "), "DD"]
    tape = "".join(f"{line}\n" for line in board.listing())
    board.type("NEW")
    assert board.load(tape) == []
    assert board.type("RUN")[0] == "145"


@pytest.mark.parametrize("count", range(11, 30))
def test_a_line_that_lists_too_long(count: int) -> None:
    """However long LIST would write it (28 times 1E7 are 259 characters), it is refused past 126."""
    line = f"10 DATA {','.join(['1E7'] * count)}"
    assert verdict(line) == (9 if 7 + 9 * count > 126 else None)
    assert (fault(BOARD.type(line)) or (None,))[0] == verdict(line)
    BOARD.type("NEW")


#: The reference looks at the word behind a line's number before it refuses the number: of two mistakes there it
#: reports the second, the firmware the first.
LINE_NUMBER = re.compile(r"(^|GOTO|RESTORE) *[0-9.]")

PIECES = st.sampled_from(
    ["1", "2.5", ".5", "7.", ".", "1E2", "1E99", "1E-99", "3E", "12345678", "1E7", "A", "P", "S5", "P999", "P1000",
     "A[", "]", "(", ")", ",", ",", ";", ":", "#", "+", "-", "*", "/", "=", "<", ">=", '"a  b"', '"', "SIN ", "SQR(",
     "K1 ", "PRINT ", "CUT ", "GOTO ", "IF ", "DATA ", "READ ", "REP ", "RESTORE ", "FIT ", "REM ", " ", "X", "O",
     "60000"]
)  # fmt: skip


@settings(max_examples=240)
@given(
    st.sampled_from(["", "10 ", "10 PRINT ", "10 CUT ", "PRINT ", "10 A=", "10 DATA ", "10 IF A=1 GOTO ", "10 READ "]),
    st.lists(PIECES, max_size=12),
)
def test_any_line(start: str, pieces: list[str]) -> None:
    """Random words: the same error (what a direct line does when it works is not asked here), and LIST's text."""
    line = (start + "".join(pieces)).rstrip()
    if not line:
        return
    code = verdict(line)
    BOARD.type("NEW")
    numbered = line[:1].isdigit()
    paper = BOARD.type(line if numbered or code is not None else f"10 {line}")
    found = fault(paper)
    if code is None and not numbered:
        return
    if code == 5 and found and found[0] == 1 and LINE_NUMBER.search(line):
        return
    assert (found and found[0]) == code, line
    if code is None and line.strip("0123456789.E- "):
        assert BOARD.listing() == [listed(squeeze(line)[0], remark(line))]
