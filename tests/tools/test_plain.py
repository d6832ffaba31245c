"""Entities that are read without ezdxf, against ezdxf: whatever is done to their records."""

from __future__ import annotations

import random
from collections import Counter

import pytest

from skg.job.read_options import ReadOptions
from skg.reading import fast_dxf
from skg.reading.account import Content
from skg.reading.dxf_entities import collect
from skg.reading.dxf_file import DxfFile
from skg.reading.dxf_record import Group, Record

ENTITY, PLACE, OTHER = [(5, "1F"), (330, "A"), (100, "AcDbEntity")], [(10, "1.5"), (20, "-2")], [(11, "4"), (21, "7e0")]
LAYER: list[Group] = [(8, "A"), (62, "   7")]
POLYLINE = [(0, "POLYLINE"), *LAYER, (66, "1"), (70, "1")]
CORNERS = [[(10, "0"), (20, "0"), (42, "0.5")], [(10, "8"), (20, "1")], [(10, "3"), (20, "4"), (42, "-1")]]
#: Records as programs write them, each with its parts.
RECORDS: list[list[list[Group]]] = [
    [[(0, "LINE"), *LAYER, *PLACE, *OTHER]],
    [[(0, "LINE"), *ENTITY, *LAYER, (100, "AcDbLine"), *PLACE, (30, "0.0"), *OTHER, (31, "0.0")]],
    [[(0, "CIRCLE"), *LAYER, *PLACE, (30, "0"), (40, "2.5")]],
    [[(0, "CIRCLE"), *ENTITY, *LAYER, (100, "AcDbCircle"), *PLACE, (40, "-2")]],
    [[(0, "ARC"), *LAYER, *PLACE, (40, "2"), (50, "350"), (51, "80.5")]],
    [[(0, "ARC"), *ENTITY, *LAYER, (100, "AcDbCircle"), *PLACE, (40, "2"), (100, "AcDbArc"), (50, "9"), (51, "9")]],
    [[(0, "ELLIPSE"), *LAYER, *PLACE, *OTHER, (40, "0.3"), (41, "0"), (42, "6.283185307179586")]],
    [
        [
            (0, "ELLIPSE"),
            *ENTITY,
            *LAYER,
            (100, "AcDbEllipse"),
            *PLACE,
            (30, "0"),
            *OTHER,
            (31, "0"),
            (40, ".7"),
            (41, "1"),
            (42, "4"),
        ]
    ],
    [[(0, "LWPOLYLINE"), *ENTITY, *LAYER, (100, "AcDbPolyline"), (90, "3"), (70, "1"), (43, "0.0"), *sum(CORNERS, [])]],
    [[(0, "LWPOLYLINE"), *LAYER, (90, "3"), (70, "1"), *sum(CORNERS, [])]],
    [POLYLINE, *([(0, "VERTEX"), *LAYER, *corner] for corner in CORNERS), [(0, "SEQEND"), *LAYER]],
]
#: What may come into a record, and what a value may become.
MORE = [(39, "1"), (30, "5"), (31, "2"), (210, "0"), (230, "-1"), (102, "{X"), (1001, "ACAD"), (100, "AcDbLine"),
        (40, "1"), (42, "1"), (70, "128"), (70, "8"), (70, "16"), (48, "x"), (62, "red"), (38, "3")]  # fmt: skip
VALUES = ["", "x", "nan", "1e400", " 1 ", "1_0", "0", "-1", "1.0", "3"]


def read(records: list[list[Group]]) -> Content:
    record, *parts = map(Record, records)
    record.parts = parts
    return collect(DxfFile(model=[record]), ReadOptions(), 1.0)


def spoilt(records: list[list[Group]], rng: random.Random) -> list[list[Group]]:
    """Records of which one is not as it was."""
    found = [list(record) for record in records]
    record = rng.choice(found)
    at = rng.randrange(1, len(record))
    match rng.randrange(4):
        case 0:
            del record[at]
        case 1:
            record.insert(at, rng.choice(MORE))
        case 2:
            record[at] = record[at][0], rng.choice(VALUES)
        case _:
            other = rng.randrange(1, len(record))
            record[at], record[other] = record[other], record[at]
    return found


@pytest.mark.parametrize("records", RECORDS, ids=lambda records: f"{records[0][0][1]}-{len(records[0])}")
def test_plain_entities_are_those_of_ezdxf(records: list[list[Group]], monkeypatch: pytest.MonkeyPatch) -> None:
    rng = random.Random(1)
    kinds, polylines = fast_dxf.KINDS, fast_dxf.POLYLINES
    ways: Counter[bool] = Counter()
    for tried in [records, *(spoilt(records, rng) for _ in range(60))]:
        monkeypatch.setattr(fast_dxf, "KINDS", kinds)
        monkeypatch.setattr(fast_dxf, "POLYLINES", polylines)
        record, *parts = map(Record, tried)
        record.parts = parts
        understood = fast_dxf.polyline(record) if record.kind in polylines else fast_dxf.numbers(record)
        assert understood or tried is not records
        ways[understood is not None] += 1
        found = read(tried)
        monkeypatch.setattr(fast_dxf, "KINDS", frozenset())
        monkeypatch.setattr(fast_dxf, "POLYLINES", frozenset())
        # (what is no number is not like itself)
        assert repr(found) == repr(read(tried)), tried
    assert min(ways.values()) > 10
