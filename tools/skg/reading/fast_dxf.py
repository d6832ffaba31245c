"""Entities of a DXF drawing that are written as nearly all are, without ezdxf: its lines, circles, arcs and polylines
cost a drawing of 20,000 elements a second.

What stands in a record in any other way (another order, an extrusion, a thickness, extended data, a value that is no
number) is ezdxf's to understand.
"""

from __future__ import annotations

from itertools import pairwise
from math import hypot
from typing import NamedTuple

from skg.reading.dxf_record import Record

#: Group codes beside a record's numbers: handle and owner (before its subclasses alone), layer and line type; colours
#: and weight, whole numbers.
_HANDLES, _NAMES, _WHOLE = (5, 330), (8, 6), (62, 370, 420)
_PLACE, _HIGH = (10, 20), (10, 20, 30)
_OTHER_PLACE, _OTHER_HIGH = (11, 21), (11, 21, 31)
_ENTITY = "AcDbEntity"
#: Subclasses and codes as the kinds have them: of a line two places, of an arc the centre, radius and angles.
_FORMS = {
    "LINE": {
        (*classes, *start, *end)
        for classes in ((), (_ENTITY, "AcDbLine"))
        for start, end in ((_PLACE, _OTHER_PLACE), (_HIGH, _OTHER_HIGH))
    },
    "CIRCLE": {(*classes, *centre, 40) for classes in ((), (_ENTITY, "AcDbCircle")) for centre in (_PLACE, _HIGH)},
    "ARC": {
        (*classes, *centre, 40, *more, 50, 51)
        for classes, more in (((), ()), ((_ENTITY, "AcDbCircle"), ("AcDbArc",)))
        for centre in (_PLACE, _HIGH)
    },
    "ELLIPSE": {
        (*classes, *centre, *axis, 40, 41, 42)
        for classes in ((), (_ENTITY, "AcDbEllipse"))
        for centre, axis in ((_PLACE, _OTHER_PLACE), (_HIGH, _OTHER_HIGH))
    },
}
#: Of polylines what stands before the vertices, and of each vertex of the older kind; the flags are code 70.
_HEADS = {
    "LWPOLYLINE": {
        (*classes, 90, 70, *more)
        for classes in ((), (_ENTITY, "AcDbPolyline"))
        for more in ((), (43,), (38,), (43, 38))
    },
    "POLYLINE": {
        (*classes, *more)
        for classes in ((), (_ENTITY, "AcDb2dPolyline"))
        for more in ((66, 70), (66, 70, *_HIGH), (66, *_HIGH, 70), (70, 66), (66, *_HIGH), (66,))
    },
}
#: The kinds that may be plain.
KINDS, POLYLINES = frozenset(_FORMS), frozenset(_HEADS)
_VERTICES = {
    (*classes, *place, *more)
    for classes in ((), (_ENTITY, "AcDbVertex", "AcDb2dVertex"))
    for place in (_PLACE, _HIGH)
    for more in ((), (42,), (70,), (70, 42), (42, 70))
}
_KNOWN = {10, 20, 30, 11, 21, 31, 38, 40, 41, 42, 43, 50, 51, 66, 70, 90}
_COUNTS = {66, 70, 90}
#: No axis is longer.
_MOST = 1e12


class Polyline(NamedTuple):
    """A flat polyline: x and y of each vertex and the bulge behind it, the height of all."""

    vertices: list[tuple[float, float, float]]
    height: float
    is_closed: bool


def numbers(record: Record) -> list[float] | None:
    """A LINE's two places, a CIRCLE's or ARC's centre, radius and angles (degrees), an ELLIPSE's centre, axis, ratio
    and parameters: places with x, y and z. None if the record is not plain, an axis not one in the plane."""
    numbers = _decoded(record)
    if numbers is None or tuple(numbers[0]) not in _FORMS[record.kind]:
        return None
    values = numbers[1]
    if 30 not in numbers[0]:
        second = [*values[2:4], 0.0, *values[4:]] if record.kind in ("LINE", "ELLIPSE") else values[2:]
        values = [*values[:2], 0.0, *second]
    if record.kind == "ELLIPSE" and (values[5] != 0 or not 0 < hypot(*values[3:5]) < _MOST):
        return None
    return values


def polyline(record: Record) -> Polyline | None:
    """A POLYLINE or LWPOLYLINE; None if the record is not plain."""
    numbers = _decoded(record)
    if numbers is None:
        return None
    codes, values = numbers
    until = codes.index(10) if record.kind == "LWPOLYLINE" and 10 in codes else len(codes)
    if tuple(codes[:until]) not in _HEADS[record.kind]:
        return None
    names = [code for code in codes if not isinstance(code, str)]
    head = dict(zip(names, values, strict=True)) if record.kind == "POLYLINE" else _head(names, values)
    flags = int(head.get(70, 0))
    if flags not in (0, 1):
        return None
    if record.kind == "POLYLINE":
        vertices, height = _parts(record), head.get(30, 0.0)
    else:
        first = len(names) - (len(codes) - until)
        vertices, height = _listed(names[first:], values[first:]), head.get(38, 0.0)
    return None if vertices is None else Polyline(vertices, height, flags == 1)


def _head(names: list[int], values: list[float]) -> dict[int, float]:
    """The groups before the first vertex."""
    until = names.index(10) if 10 in names else len(names)
    return dict(zip(names[:until], values[:until], strict=True))


def _listed(codes: list[int], values: list[float]) -> list[tuple[float, float, float]] | None:
    """The vertices of an LWPOLYLINE: each a place, and maybe a bulge."""
    begins = [index for index, code in enumerate(codes) if code == 10]
    result = []
    for begin, end in pairwise([*begins, len(codes)]):
        if tuple(codes[begin:end]) not in (_PLACE, (*_PLACE, 42)):
            return None
        result.append((values[begin], values[begin + 1], values[begin + 2] if end - begin == 3 else 0.0))
    return result


def _parts(record: Record) -> list[tuple[float, float, float]] | None:
    """The vertices of a POLYLINE, which are records of their own."""
    parts = []
    for part in record.parts:
        if part.kind == "SEQEND":
            continue
        numbers = _decoded(part)
        if part.kind != "VERTEX" or numbers is None or tuple(numbers[0]) not in _VERTICES:
            return None
        values = dict(zip((code for code in numbers[0] if not isinstance(code, str)), numbers[1], strict=True))
        if values.get(70):
            return None
        parts.append((values[10], values[20], values.get(42, 0.0)))
    return parts


def _decoded(record: Record) -> tuple[list[int | str], list[float]] | None:
    """Subclasses and codes of a record's numbers in their order, and the numbers; None if there is anything else."""
    codes: list[int | str] = []
    values: list[float] = []
    has_class = has_place = False
    for code, value in record.groups[1:]:
        if code in _KNOWN:
            codes.append(code)
            has_place = has_place or code == 10
            try:
                values.append(int(value) if code in _COUNTS else float(value))
            except ValueError:
                return None
        elif code == 100:
            has_class = True
            codes.append(value.strip())
        elif has_place:
            # (a group between x and y takes them apart)
            return None
        elif code in _WHOLE:
            if not value.strip().lstrip("-").isdigit():
                return None
        elif code in _HANDLES and has_class or code not in _HANDLES and code not in _NAMES:
            return None
    return codes, values
