"""Memory full, by program lines, by variables, by the route buffer, at every size of RAM: ERR 09, and what was
there before is kept.

With all 56 KiB there is RAM up to the last address, where a sum of an address and a length can wrap.
"""

from __future__ import annotations

import pytest
from romhelp import Board, fault, labels

#: Letter, value, and how it is printed.
KINDS = {"number": ("A", "7", "7"), "point": ("P", "(1,2)", "(1,2)"), "line": ("S", "X", "(0,-1,0)")}
SIZES = [2, 3, 8, 55, 56]


def program(board: Board) -> bytes:
    """The program's records in memory."""
    names = labels()
    return board.machine.peek(names["PROG"], board.machine.peek16(names["PEND"]) - names["PROG"])


def free(board: Board) -> int:
    return int(board.type("FREE")[0])


def fill(board: Board, leave: int = 0) -> int:
    """Type REM lines while more than `leave` bytes are free; how many were stored. With 0: until ERR 09."""
    number = 0
    while leave == 0 or free(board) > leave + 110:
        length = 100 if leave else 60
        if paper := board.type(f"{number + 1} REM {'x' * length}"):
            assert fault(paper) == (9, None)
            break
        number += 1
    if leave and (rest := free(board) - leave) > 12:
        assert board.type(f"{number + 1} REM {'x' * (rest - 10)}") == []
        number += 1
    return number


def sound(board: Board, records: bytes) -> None:
    """The program is whole, the board works."""
    assert program(board) == records
    listed = board.listing()
    assert len(listed) == count(records)
    assert board.type("PRINT 1+1") == ["2"]
    top = labels()["VTOP"]
    assert board.machine.peek16(top) < board.machine.ram_end
    assert board.machine.peek(board.machine.peek16(top)) == b"\0"


def count(records: bytes) -> int:
    """Counts the records, each with a sum of 0."""
    place = n = 0
    while place < len(records):
        record = records[place : place + records[place]]
        assert sum(record) % 256 == 0
        place += len(record)
        n += 1
    return n


@pytest.mark.parametrize("kib", SIZES)
def test_program_lines(kib: int) -> None:
    board = Board(kib)
    number = fill(board)
    assert number > 60 * (kib - 2) // 4
    assert 0 < free(board) <= 66
    records = program(board)
    assert board.type(f"{number + 1} REM {'x' * 60}")[0].startswith(f"{number + 1} REM xxx")
    for line in (1, number // 2, number):
        assert fault(board.type(f"{line} REM {'y' * 115}")) == (9, None)
    sound(board, records)
    assert board.type("1 REM short") == []
    assert free(board) > 50
    assert board.type("9999 END") == []
    assert board.listing()[0] == "1 REM short" and board.listing()[-1] == "9999 END"
    assert board.type("RUN") == ["DD"]


@pytest.mark.parametrize("kib", SIZES)
def test_the_last_bytes_go_line_by_line(kib: int) -> None:
    """Free memory counts down to 1, and never further."""
    board = Board(kib)
    number = fill(board, leave=30)
    left = free(board)
    while left > 1:
        number += 1
        paper = board.type(f"{number} END")
        if left <= 6:
            assert fault(paper) == (9, None)
            break
        assert paper == []
        assert free(board) == left - 6
        left -= 6
    sound(board, program(board))


@pytest.mark.parametrize("kib", SIZES)
def test_a_loaded_tape(kib: int) -> None:
    """The line that had no room any more is shown, the lines before it are kept."""
    board = Board(kib)
    tape = "".join(f"{n} REM {'x' * 55}\n" for n in range(1, 931))
    paper = board.load(tape)
    assert fault(paper) == (9, None)
    kept = board.listing()
    assert f"{len(kept) + 1} REM {'x' * 55}" in paper
    assert kept == tape.splitlines()[: len(kept)]
    assert len(kept) * 63 > (kib - 2) * 1000


@pytest.mark.parametrize("kib", SIZES)
@pytest.mark.parametrize("kind", KINDS)
def test_variables(kib: int, kind: str) -> None:
    board = Board(kib)
    fill(board, leave=100)
    records = program(board)
    letter, value, shown = KINDS[kind]
    for n in range(1, 30):
        if paper := board.type(f"{letter}{n}={value}"):
            assert fault(paper) == (9, None)
            break
    else:
        pytest.fail("never full")
    assert n > 4
    for each in range(1, n):
        assert board.type(f"PRINT {letter}{each}") == [shown]
    assert fault(board.type(f"PRINT {letter}{n}")) == (3, None)
    sound(board, records)
    assert board.type(f"{letter}1={value}") == []


@pytest.mark.parametrize("kib", SIZES)
def test_route_buffer(kib: int) -> None:
    """A route that has outgrown the buffer is cut all the same; only SYM, REP and RECUT are ERR 09."""
    board = Board(kib)
    fill(board, leave=100)
    records = program(board)
    board.machine.clear()
    for n in range(1, 5):
        board.type(f"CUT ({n},0)")
    assert fault(board.type("REP 1,30")) is None
    for n in range(5, 30):
        assert len(board.type(f"CUT ({n},0)")) == 1
    assert fault(board.type("REP 2,30")) == (9, None)
    assert board.machine.punch.split() == [b"B1000B0B1000GXL1"] * 28 + [b"D"]
    sound(board, records)
    board.type("CUT (50,0)")
    assert board.type("REP 1,30") == []


@pytest.mark.parametrize("kib", [8, 56])
def test_all_kinds_of_variables(kib: int) -> None:
    """6,000 bytes of them."""
    board = Board(kib)
    for line in ["10 I=0", "20 I=I+1", "30 S[I]=X", "40 C[I]=O:I", "50 X[I]=Y", "60 T[I]=O:I", "70 GOTO 20",
                 "80 END"]:  # fmt: skip
        assert board.type(line) == []
    number = 80
    while free(board) > 6000:
        number += 1
        assert board.type(f"{number} REM {'x' * 80}") == []
    records = program(board)
    code, line = fault(board.type("RUN")) or (0, 0)
    assert code == 9 and line in (30, 40, 50, 60)
    assert 0 < free(board) <= 17
    last = int(board.type("PRINT I")[0])
    assert last * 4 * 17 > 5000
    for n in (1, last // 2, last - 1):
        assert board.type(f"PRINT S[{n}],C[{n}],X[{n}],T[{n}]") == [f"(0,-1,0) (0,0,{n}) (1,0,0) (0,0,{n})"]
    sound(board, records)


@pytest.mark.parametrize("kib", SIZES)
def test_an_answer_without_room(kib: int) -> None:
    """A variable that does not fit ends the run: no other answer to INPUT would help."""
    board = Board(kib)
    assert board.type("8000 INPUT S") == []
    fill(board, leave=30)
    while free(board) > 12:
        assert board.type(f"{8001 + free(board)} END") == []
    records = program(board)
    start = len(board.machine.tty)
    board.machine.type("RUN 8000\rX\r")
    assert board.machine.run() == "prompt"
    assert board.machine.tty[start:].endswith("? X\r\nERR 09 LINE 8000\r\n>")
    sound(board, records)


@pytest.mark.parametrize("kib", SIZES)
def test_reset_keeps_a_full_memory(kib: int) -> None:
    board = Board(kib)
    fill(board, leave=40)
    for n in range(1, 9):
        board.type(f"A{n}={n}")
    records, left = program(board), free(board)
    board.machine.clear()
    board.machine.reset()
    assert board.machine.run() == "prompt"
    assert board.machine.tty == f"\r\nSKG {left}\r\n>"
    assert board.type("PRINT A1,A2") == ["1 2"]
    sound(board, records)
