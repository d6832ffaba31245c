"""Files that are cut off, entities that lack something: the whole drawing's contours or a refusal, nothing made up."""

from __future__ import annotations

import ast
import inspect
import io
from collections.abc import Callable
from random import Random

import pytest
from drawings import ALL, bracket, die_plate, gear_wheel, mirrored_blocks
from ezdxf.document import Drawing
from facthelp import CARE, pattern, says
from test_reading import checked, dxf_bytes, line, polygon, raw, square

from skg.errors import UserError
from skg.messages.finding import Phrase
from skg.reading import slow_dxf
from skg.reading.dxf_record import NEEDED
from skg.reading.read import Reading, ReadOptions, read

#: An entity of each kind that is cut, whole.
WHOLE = {
    "LINE": "LINE 8 0 10 50 20 0 11 60 21 5",
    "CIRCLE": "CIRCLE 8 0 10 50 20 5 40 3",
    "ARC": "ARC 8 0 10 50 20 5 40 3 50 10 51 170",
    "ELLIPSE": "ELLIPSE 8 0 10 50 20 5 11 3 21 1 40 0.5 41 0 42 2",
    "SPLINE": "SPLINE 8 0 70 8 71 1 72 4 73 2 40 0 40 0 40 1 40 1 10 50 20 0 10 55 20 5",
    "LWPOLYLINE": "LWPOLYLINE 8 0 90 3 70 0 10 50 20 0 10 59 20 0 10 54 20 7",
    "POINT": "POINT 8 START 10 5 20 5",
    "INSERT": "INSERT 8 0 2 CORNER 10 50 20 3",
    "MLINE": "MLINE 8 0 2 STANDARD 72 2 11 0 21 0 11 5 21 5",
}
BLOCK = "0 SECTION 2 BLOCKS 0 BLOCK 2 CORNER 10 0 20 0 0 LINE 8 0 10 0 20 0 11 3 21 1 0 ENDBLK 0 ENDSEC "
BLOCK = BLOCK.replace(" ", "\n")


def with_block(*entities: str, block: str = BLOCK) -> bytes:
    return raw(*entities).replace(b"0\nSECTION\n2\nENT", block.encode() + b"0\nSECTION\n2\nENT")


def refused(reading: Reading) -> list[str]:
    return [entity.kind for entity in reading.report.not_understood]


def test_every_kind_that_is_cut_has_what_it_needs() -> None:
    """(A POLYLINE's places are its VERTEX; a HELIX is read as a SPLINE.)"""
    cases = ast.walk(ast.parse(inspect.getsource(slow_dxf._edges)))
    kinds = {node.value.value for node in cases if isinstance(node, ast.MatchValue)} - {"POLYLINE"}
    assert len(kinds) > 7
    assert kinds - NEEDED.keys() == set(), "no row in NEEDED: a place that is not in the file would be made up"
    assert kinds - {"HELIX"} - WHOLE.keys() == set(), "no row in WHOLE"


@pytest.mark.parametrize("kind", [kind for kind in WHOLE if kind != "MLINE"])
@pytest.mark.parametrize("is_odd", [False, True])
def test_each_value_that_is_needed(kind: str, is_odd: bool) -> None:
    """A whole entity is cut (or is a start hole); without any one of its values it is listed. `is_odd`: written so that
    ezdxf reads it."""
    words = WHOLE[kind].split() + ["210", "0", "220", "0", "230", "1"] * is_odd
    whole = checked(with_block(*square(0, 0, 9), " ".join(words)))
    assert not refused(whole) and len(whole.contours) + len(whole.starts) == 2
    pairs = list(zip(words[1::2], words[2::2], strict=False))
    for code in NEEDED[kind]:
        rest = [word for pair in pairs if pair[0] != str(code) for word in pair]
        reading = checked(with_block(*square(0, 0, 9), " ".join([kind, *rest])))
        assert refused(reading) == [kind] and len(reading.contours) == 1 and not reading.starts, code
        assert says(reading.report.report(), Phrase("entity-not-cut", kind=kind))
    assert NEEDED[kind]


@pytest.mark.parametrize(
    "entity",
    [
        "CIRCLE 8 0 10 5 20 5 40 -10",
        "ARC 8 0 10 5 20 5 40 -1e1 50 0 51 90",
        "LWPOLYLINE 8 0 90 6 70 1 10 0 20 0 10 9 20 0 10 4 20 7",
        "LWPOLYLINE 8 0 70 1 10 0 20 0 10 9 10 4 20 7",
        "MLINE 8 0 2 STANDARD 72 3 11 0 21 0 11 5 21 5",
        # Of splines: no knots, a knot too few, a control too few, a weight too few, no points, degree 0.
        "SPLINE 8 0 70 8 71 1 10 50 20 0 10 55 20 5",
        "SPLINE 8 0 70 8 71 1 40 0 40 0 40 1 10 50 20 0 10 55 20 5",
        "SPLINE 8 0 70 8 71 1 73 3 40 0 40 0 40 1 40 1 10 50 20 0 10 55 20 5",
        "SPLINE 8 0 70 8 71 1 40 0 40 0 40 1 40 1 41 1 10 50 20 0 10 55 20 5",
        "SPLINE 8 0 70 8 71 3",
        "SPLINE 8 0 70 8 71 0 40 0 40 1 10 50 20 0",
        polygon((20, 0), (29, 0), (24, 7)).replace("\n0\nSEQEND", ""),
        polygon((20, 0), (29, 0), (24, 7)).replace("\n20\n7", ""),
    ],
)
def test_what_is_not_whole_is_listed(entity: str) -> None:
    reading = checked(raw(*square(0, 0, 9), entity))
    assert refused(reading) == [entity.split()[0]] and len(reading.contours) == 1


@pytest.mark.parametrize("base", ["", "10\n1\n", "10\n1\n20\nx\n", "10\n1\n20\ninf\n"])
def test_a_block_without_its_base_point(base: str) -> None:
    """An entity that refers to it is listed: its place is unknown."""
    block = BLOCK.replace("10\n0\n20\n0\n", base, 1)
    reading = checked(with_block(*square(0, 0, 9), WHOLE["INSERT"], block=block))
    assert refused(reading) == ["INSERT"]


def result(data: bytes) -> object:
    """All that a tape is made of; None for a refusal."""
    try:
        reading = read(data, "part.dxf", ReadOptions(units="mm"))
    except UserError:
        return None
    return reading.contours, reading.starts


def old(drawing: Drawing) -> bytes:
    drawing.dxfversion = "R12"
    text = io.StringIO()
    drawing.write(text)
    return text.getvalue().encode()


def binary(drawing: Drawing) -> bytes:
    return dxf_bytes(drawing, binary=True)


#: Drawings of what release 12 has, too.
OLD = (die_plate, mirrored_blocks, bracket, gear_wheel)


@pytest.mark.parametrize(
    ("make", "written"),
    [*((make, written) for make in ALL for written in (dxf_bytes, binary)), *((make, old) for make in OLD)],
)
def test_a_file_that_is_cut_off(make: Callable[[], Drawing], written: Callable[[Drawing], bytes]) -> None:
    """At random bytes, half of them among its entities: the contours of the whole drawing, or a refusal."""
    data = written(make())
    rng = Random(make.__name__)
    begin = data.find(b"ENTITIES")
    cuts = [rng.randrange(1, len(data)) for _ in range(3)] + [rng.randrange(begin, len(data)) for _ in range(4)]
    whole = result(data)
    assert whole and all(result(data[:cut]) in (None, whole) for cut in cuts)
    assert result(data[: begin + 100]) is None


def test_a_file_that_ends_behind_a_section() -> None:
    """It is cut, with a word; not one that ends a character earlier, or within the next section."""
    data = raw(*square(0, 0, 9))
    end = data.rindex(b"ENDSEC") + 6
    for behind in (b"", b"\n", b"\r\n"):
        reading = checked(data[:end] + behind)
        assert len(reading.contours) == 1 and says(reading.report.findings, CARE, Phrase("no-eof"))
    for wrong in (data[: end - 1], data[:end] + b"\n0\n", data[:end] + b"\n0\nSECTION\n2\nOBJECTS\n0\nDICTIONARY\n"):
        with pytest.raises(UserError, match=pattern(Phrase("cut-off"))):
            checked(wrong)


def test_blocks_too_deep_are_not_parts_of_themselves() -> None:
    """40 blocks, each with a line and the next one; and a block that has itself in it."""

    def block(number: int, within: int) -> str:
        parts = (line(0, number, 9, number), f"INSERT 8 0 2 D{within} 10 0 20 0")
        entities = "".join("0\n" + "\n".join(part.split()) + "\n" for part in parts)
        return f"0\nBLOCK\n2\nD{number}\n10\n0\n20\n0\n{entities}0\nENDBLK\n"

    def lines(*blocks: str) -> tuple[int, str]:
        text = "0\nSECTION\n2\nBLOCKS\n" + "".join(blocks) + "0\nENDSEC\n"
        reading = checked(with_block("INSERT 8 0 2 D0 10 0 20 0", block=text))
        (odd,) = reading.report.not_understood
        return len(reading.contours), odd.reason

    count, why = lines(*(block(number, number + 1) for number in range(40)))
    assert count == 33 and says(why, Phrase("reason-block-deep", name="D33", most=32)) and not says(why, "itself")
    count, why = lines(block(0, 1), block(1, 0))
    assert count == 2 and says(why, Phrase("reason-block-itself", name="D0"))


def test_chinese_names_in_a_file_that_says_western() -> None:
    """They are read as the file says, and there is a hint; none where the letters are western."""
    header = "9\n$DWGCODEPAGE\n3\nANSI_1252\n"
    for name, encoding in (("\u8f6e\u5ed3", "gbk"), ("Ma\xdfe", "cp1252")):
        data = raw(*square(0, 0, 9, name), header=header).decode().encode(encoding)
        hints = [
            note
            for note in checked(data).report.findings
            if says(note, Phrase("encoding-doubtful", name="ANSI_1252"), "--encoding gbk")
        ]
        assert len(hints) == (encoding == "gbk")
        assert checked(data, encoding=encoding).report.layers[0].layer == name
