"""Bad input: the right ERR, the prompt again, the program whole, the tape so far kept."""

from __future__ import annotations

import pytest
from romhelp import ERROR, RUN_LIMIT, Board, fault

PROGRAM = ["10 P1=(1,2)", "20 CUT P1,(3,4),(9,-2)", "30 BACK"]


@pytest.fixture
def board() -> Board:
    """A board with a small program in it."""
    board = Board()
    for line in PROGRAM:
        assert board.type(line) == []
    return board


def expect(board: Board, line: str, code: int, number: int | None = None) -> list[str]:
    """The line ends in that ERR and at the prompt, and the program is what it was."""
    before = board.listing()
    paper = board.type(line)
    assert fault(paper) == (code, number), paper
    assert sum(bool(ERROR.match(text)) for text in paper) == 1
    assert board.listing() == before
    assert board.type('PRINT "HERE",1+1') == ["HERE 2"]
    return paper


BAD_LINES = {
    "no statement": ("HELLO", 1),
    "unbalanced left": ("PRINT ((1+2)", 1),
    "unbalanced right": ("PRINT (1+2))", 1),
    "no operand": ("A=1+", 1),
    "two operators": ("A=1*/2", 1),
    "comma outside parentheses": ("P3=25,32", 1),
    "line number 0": ("0 A=1", 1),
    "line number 10000": ("10000 A=1", 1),
    "command in a program": ("40 LIST", 1),
    "open quote": ('PRINT "AB', 1),
    "function without a blank": ("A=SIN30", 1),
    "K without a blank": ("A=K1P", 1),
    "function without an argument": ("A=SQR ", 1),
    "unknown line": ("GOTO 15", 2),
    "RETURN alone": ("RETURN", 2),
    "never set": ("PRINT D7", 3),
    "never set, computed": ("PRINT P[3+4]", 3),
    "O assigned": ("O=(1,2)", 3),
    "X assigned": ("X=P1:P1", 3),
    "Y assigned": ("Y=X", 3),
    "point for a number": ("A=(1,2)", 4),
    "number for a point": ("P=1", 4),
    "point + number": ("PRINT (1,2)+1", 4),
    "line + line": ("PRINT X+Y", 4),
    "turn by itself": ("PRINT 30:O", 4),
    "K3 of a point": ("PRINT K3 O", 4),
    "CUT of a turn": ("CUT 30:O", 4),
    "subscript over 999": ("P1000=(1,2)", 5),
    "computed subscript": ("P[999+1]=(1,2)", 5),
    "broken subscript": ("A[0.5]=1", 5),
    "negative subscript": ("A[-1]=1", 5),
    "1/0": ("PRINT 1/0", 5),
    "SQR of a negative": ("PRINT SQR -1", 5),
    "TG 90": ("PRINT TG 90", 5),
    "overflow": ("PRINT 1E30*1E30", 5),
    "constant too large": ("PRINT 1E39", 5),
    "circle of no radius": ("C=(1,2):0", 5),
    "parallel lines": ("PRINT X*(X:5)", 6),
    "same line": ("PRINT X*X", 6),
    "line beside a circle": ("PRINT (X:20)*(O:5)", 6),
    "circles apart": ("PRINT (O:5)*((20,0):5)", 6),
    "concentric circles": ("PRINT (O:5)*(O:6)", 6),
    "belt of nested circles": ("S=(O:9):((1,0):2)", 6),
    "line of one point": ("S=(1,2):(1,2)", 6),
    "BACK without a route": ("BACK", 6),
    "fillet before the first element": ("CUT SQR 4,X,Y", 6),
    "two fillets": ("CUT X,2,SQR 4,Y", 6),
    "fillet of no size anywhere": ("CUT 1-1,X", 5),
    "two fillets, one of no size": ("CUT X,2,1-1,Y", 5),
    "a fillet that turns right where the corner turns left": ("CUT X,-2,Y:10", 6),
}


@pytest.mark.parametrize("name", BAD_LINES)
def test_line(name: str, board: Board) -> None:
    line, code = BAD_LINES[name]
    expect(board, line, code)


@pytest.mark.parametrize("name", [name for name, (_, code) in BAD_LINES.items() if code > 1])
def test_the_same_in_a_program(name: str, board: Board) -> None:
    """Constants out of range are found when the line is typed, everything else when it runs."""
    line, code = BAD_LINES[name]
    paper = board.type(f"40 {line}")
    if paper:
        assert code == 5 and fault(paper) == (5, None), paper
        assert len(board.listing()) == len(PROGRAM)
    else:
        expect(board, "RUN", code, 40)


def test_variables_stay(board: Board) -> None:
    board.type("A=5")
    for line in ["A=1/0", "A=(1,2)", "A=1+", "A=D9", "A[0]=SQR -1"]:
        board.type(line)
        assert board.type("PRINT A") == ["5"]


def test_tape_so_far_is_kept_and_a_stop_follows(board: Board) -> None:
    board.type("25 A=1/0")
    expect(board, "RUN", 5, 25)
    assert board.machine.punch == b"B1000B2000B2000GYL1\r\nB2000B2000B2000GYL1\r\nD\r\n"


def test_no_stop_when_no_route_is_open(board: Board) -> None:
    board.type("40 A=1/0")
    expect(board, "RUN", 5, 40)
    assert board.machine.punch.split()[-1].startswith(b"B")


def test_line_of_200_characters(board: Board) -> None:
    expect(board, "PRINT " + "1+" * 97 + "1", 9)


def test_program_line_of_200_characters(board: Board) -> None:
    expect(board, "40 REM " + "X" * 200, 9)


def test_parentheses_50_deep(board: Board) -> None:
    """Fifty levels have room; an expression too deep for the stack is memory full."""
    assert board.type("PRINT " + "(" * 50 + "7" + ")" * 50) == ["7"]
    for inner in ["1+(", "-(", "SQR(", "A[", "1#("]:
        paper = board.type("PRINT " + inner * (100 // len(inner)))
        assert fault(paper) in [(1, None), (9, None)], (inner, paper)
    assert board.listing() == PROGRAM


@pytest.mark.parametrize("key", sorted(set(range(1, 32)) - {3, 8, 9, 10, 13, 17, 19, 21}))
def test_control_characters(key: int, board: Board) -> None:
    """Inside a line they are not understood, or they are ignored: never a broken board."""
    before = board.listing()
    paper = board.type(f"PRINT 1{chr(key)}+1")
    assert paper == ["2"] or fault(paper) == (1, None)
    assert board.listing() == before


def test_program_larger_than_the_ram() -> None:
    board = Board(2)
    stored: list[str] = []
    for number in range(10, 9000, 10):
        line = f"{number} REM {'ABCDEFGH' * 5}"
        paper = board.type(line)
        if paper:
            assert fault(paper) == (9, None)
            break
        stored.append(line)
    else:
        pytest.fail("never full")
    assert board.listing() == stored
    assert fault(board.type("PRINT 1")) is None
    board.type(str(10))
    assert board.listing() == stored[1:]


def test_variables_larger_than_the_ram() -> None:
    board = Board()
    for line in ["10 I=0", "20 S[I]=X", "30 I=I+1", "40 IF I<999 GOTO 20"]:
        board.type(line)
    expect(board, "RUN", 9, 20)
    count = int(board.type("PRINT I")[0])
    assert count > 100
    assert board.type(f"PRINT S[{count - 1}]") == ["(0,-1,0)"]


def test_ctrl_c_in_a_loop(board: Board) -> None:
    board.type("15 GOTO 15")
    before = board.listing()
    board.machine.type("RUN\r")
    assert board.machine.run(10_000_000) == "cycles"
    start = len(board.machine.tty)
    board.machine.press(3)
    assert board.machine.run(RUN_LIMIT) == "prompt"
    paper = board.machine.tty[start:].split("\r\n")
    assert fault(paper) == (10, 15)
    assert board.listing() == before


@pytest.mark.parametrize("items", ["X,2,3,Y", "2;3", "X,A,P1", "P2,C1;A[I],O", "A,D,S1"])
def test_a_fillet_without_a_place_is_refused_when_typed(board: Board, items: str) -> None:
    expect(board, f"10 CUT {items}", 1)


@pytest.mark.parametrize(
    "items", ["P1,2,P2", "2,X,2", "X,2,Y,3,S1", "X,A+1,2", "X,2,P1+P2", "X,-2,P1", "C1,SQR A,P1", "A,P1", "X,2,K1 P1"]
)
def test_a_fillet_that_may_have_a_place_is_stored(board: Board, items: str) -> None:
    assert board.type(f"10 CUT {items}") == []


def test_load_stops_at_a_line_that_is_not_understood() -> None:
    board = Board()
    paper = board.load("10 A=1\n20 A=+*\n30 A=3\n")
    assert fault(paper) == (1, None)  # no program is running; the paper shows the line itself
    assert "20 A=+*" in paper
    assert "10 A=1" in board.listing()
    assert "20 A=+*" not in board.listing()


def test_direct_cut_before_any_run() -> None:
    board = Board()
    assert board.type("CUT (1,2),(3,4)") == ["0001 B1000B2000B2000GYL1"]


def test_stop_after_the_first_item(board: Board) -> None:
    """A route is open from its first item on, also when no block has gone out."""
    board.type("NEW")
    board.type("10 R=-6")
    board.type("20 CUT (0,0):5")
    expect(board, "RUN", 7, 20)
    assert board.machine.punch == b"D\r\n"


def test_unknown_line_in_if(board: Board) -> None:
    board.type("40 IF 1=1 GOTO 77")
    expect(board, "RUN", 2, 40)


def test_run_of_an_unknown_line(board: Board) -> None:
    expect(board, "RUN 15", 2)


#: Statements with a number or a subscript that is none, and where which mistake is marked.
@pytest.mark.parametrize("zeros", [0, 1, 36, 60, 98])
def test_exponents_without_end(zeros: int) -> None:
    """A constant's value decides, not its exponent: what is too small is 0."""
    board = Board()
    for statement in (
        "PRINT 1E-99",
        "PRINT 1E-100",
        "PRINT 1E-999",
        f"PRINT 1E-{'9' * 80}",
        f"PRINT 0E{'9' * 80}",
        f"PRINT 0.{'0' * zeros}1E-{200 + zeros}",
    ):
        assert board.type(statement) == ["0"], statement
    assert board.type(f"PRINT 0.{'0' * zeros}1E{zeros + 3}") == ["100"]
    assert board.type(f"PRINT 1{'0' * zeros}E-{zeros + 1}") == ["0.1"]


def test_a_cut_of_fifteen_points_written_out() -> None:
    """A line's words take 254 bytes at most; one more is error 9."""
    points = ",".join(f"({n % 5},{n // 5})" for n in range(15))
    board = Board()
    assert board.type(f"10 CUT {points}") == []
    assert board.listing() == [f"10 CUT {points}"]
    assert board.type(f"20 CUT {points},(1,1)")[-1] == "ERR 09"
    assert board.listing() == [f"10 CUT {points}"]


@pytest.mark.parametrize("count", range(15, 32, 4))
def test_a_line_that_list_would_make_too_long(count: int) -> None:
    """1E7 is listed as eight digits: what LOAD could not take again is not stored, however long."""
    board = Board()
    line = "PRINT " + ",".join(["1E7"] * count)
    assert board.type(f"10 {line}")[-1] == "ERR 09"
    assert board.listing() == []
    assert board.type(f"10 {line[: 6 + 4 * 10 - 1]}") == []
    assert len(board.listing()[0]) <= 126
