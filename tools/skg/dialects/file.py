"""Files of dialects: TOML, of the user, or one of those that come with `skg`.

dialect = dialect_of("wire-iso")
dialect = dialect_of("my-machine.toml")
"""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from importlib.resources import files
from string import Formatter
from typing import Any

from skg.errors import UserError
from skg.files import read_bytes
from skg.job import toml, values
from skg.job.file import checked_values, expect_table
from skg.messages.finding import Finding, Phrase
from skg.tape.dialect import ARCS, LINE_ENDS, PLACES, UNITS, Compensation, GcodeDialect

_ENDING = ".toml"


def _word(*letters: str) -> values.Check:
    """Make the check of a text with some fields, and no others."""

    def check(value: object) -> str:
        if not isinstance(value, str) or not value.isascii() or not (value.isprintable()):
            raise values.Wrong(Phrase("value-line"))
        try:
            named = {name for _, name, form, kind in Formatter().parse(value) if name is not None}
        except ValueError:
            named = {"{"}
        if named - set(letters):
            fields = tuple(f"{{{letter}}}" for letter in letters)
            raise values.Wrong(Phrase("value-fields", fields=fields) if fields else Phrase("value-no-fields"))
        return value

    return check


def _lines(*letters: str) -> values.Check:
    """Make the check of a list of lines."""

    def check(value: object) -> tuple[str, ...]:
        if not isinstance(value, list):
            raise values.Wrong(Phrase("value-lines"))
        return tuple(map(_word(*letters), value))

    return check


_TOP: dict[str, values.Check] = {"title": values.text, "source": values.text, "tried": values.text}
_TABLES: dict[str, dict[str, values.Check]] = {
    "numbers": {
        "unit": values.choice(UNITS),
        "decimals": values.whole(0, 3),
        "point": values.flag,
        "places": values.choice(PLACES),
        "arcs": values.choice(ARCS),
    },
    "words": {
        "line_end": values.choice(LINE_ENDS),
        "numbers": values.flag,
        "space": values.flag,
        **dict.fromkeys(("rapid", "line", "clockwise", "counterclockwise"), _word()),
        "feed": _word("feed"),
    },
    "lines": {
        "start": _lines("x", "y"),
        **dict.fromkeys(("head", "begin", "end", "unthread", "thread", "stop", "foot"), _lines()),
    },
    "offset": {
        **dict.fromkeys(("left", "right"), _word("number", "offset")),
        "off": _word(),
        "define": _word("number", "offset"),
    },
}


def names() -> list[str]:
    """The dialects that come with `skg`."""
    folder = files("skg.dialects")
    return sorted(entry.name.removesuffix(_ENDING) for entry in folder.iterdir() if entry.name.endswith(_ENDING))


def dialect_of(name: str) -> GcodeDialect:
    """The dialect of a file whose name ends in .toml, or of one that comes with `skg`, by its name."""
    if name.endswith(_ENDING):
        return decoded(read_bytes(name), name)
    if name not in names():
        near = get_close_matches(name, names(), 1)
        known = tuple(names())
        close = Finding("no-machine-near", name=name, near=near[0], names=known) if near else None
        raise UserError(close or Finding("no-machine", name=name, names=known))
    return decoded((files("skg.dialects") / f"{name}{_ENDING}").read_bytes(), name)


def decoded(data: bytes, name: str) -> GcodeDialect:
    """The dialect of a file's bytes; what is wrong with it is a `UserError` with its table and key."""
    top = toml.parsed(toml.decoded(data, name), name)
    known: dict[str, Any] = {**_TOP, **_TABLES}
    fields = checked_values({key: value for key, value in top.items() if key not in _TABLES}, known, name)
    tables = {
        key: checked_values(expect_table(top.get(key, {}), name, f"[{key}]"), checks, name, f"[{key}]")
        for key, checks in _TABLES.items()
    }
    offset = tables.pop("offset")
    for table, given, needed in (
        ("lines", tables["lines"], ("head", "foot")),
        ("offset", offset, ("left", "right", "off") if offset else ()),
    ):
        for key in needed:
            if key not in given:
                raise UserError(Finding("key-missing", key=key).within(name, f"[{table}]"))
    return GcodeDialect(**fields, **_merged(tables), compensation=Compensation(**offset) if offset else None)


def _merged(tables: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    return {key: value for table in tables.values() for key, value in table.items()}
