"""Job files: TOML, and the same as plain data; every key with the check of its value.

job = load(text, "part.job.toml")
text = dump(job)
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from difflib import get_close_matches
from functools import partial
from typing import Any

from skg.errors import UserError
from skg.job import toml, values
from skg.job.job import KINDS, Chosen, Job, Price, TapeForm
from skg.job.machine import INTO, ROMS, SMALL, BoardOptions, Policy, Setup
from skg.job.placing import MIRRORS, Copies, Place
from skg.job.read_options import OPEN, UNITS, ReadOptions
from skg.job.wanted import CLEARANCE_ON, LEAD_SHAPES, SIDES, Overrides
from skg.messages.finding import Finding, Phrase
from skg.tape.styles import STYLES

#: Tables of a file: their keys with the values.
Tables = Mapping[str, Mapping[str, Any]]
#: The version of the file's form.
SCHEMA = 1

#: The sources of a message: a file or what else has the data, and the part of it.
Where = tuple[str | Phrase, ...]

_READ: dict[str, values.Check] = {
    "units": values.choice(UNITS),
    "open": values.choice(OPEN),
    "tolerance": values.number(0.0, is_open=True),
    "start_layer": values.name,
    "fit_tolerance": values.number(values.LEAST_FIT),
    "encoding": values.text,
    "layers": values.names,
    "bridges": values.pairs,
    "corners": values.pairs,
    "strays": values.places_in_file,
}
_MACHINE: dict[str, values.Check] = {
    "wire": values.number(0.0, 2 * values.MOST_OFFSET, is_open=True),
    "gap": values.number(0.0, values.MOST_OFFSET),
    "offset": values.number(0.0, values.MOST_OFFSET),
    "rom": values.choice(ROMS),
    "ram": values.whole(*values.RAM),
    "feed": values.number(values.LEAST_FEED),
    "small": values.choice(SMALL),
    "into": values.choice(INTO),
    "material": values.text,
    "thickness": values.number(0.0, values.FARTHEST, is_open=True),
    "rates": values.by_pass(is_open=True),
}
_PLACE: dict[str, values.Check] = {
    "origin": values.origin,
    "turn": values.number(-360.0, 360.0),
    "mirror": values.choice(MIRRORS),
    "scale": values.number(1 / values.MOST_SCALE, values.MOST_SCALE),
}
_COPIES: dict[str, values.Check] = {
    "columns": values.whole(1, 1_000_000),
    "rows": values.whole(1, 1_000_000),
    "step": values.place,
    "around": values.whole(1, 1_000_000),
    "about": values.place,
    "every": values.number(-360.0, 360.0),
}
_DEFAULT: dict[str, values.Check] = {
    "cut": values.flag,
    "side": values.choice(SIDES),
    "passes": values.passes,
    "tab": values.number(0.0),
    "slug_tab": values.number(0.0),
    "tabs": values.whole(1, values.MOST_TABS),
    "tab_passes": values.more_passes,
    "overlap": values.number(0.0),
    "lead": values.number(0.0, is_open=True),
    "lead_shape": values.choice(LEAD_SHAPES),
    "reverse": values.flag,
    "clearance": values.number(0.0, values.MOST_OFFSET),
    "clearance_on": values.choice(CLEARANCE_ON),
}
_OFTEN = _DEFAULT | {"offset": values.number(0.0, values.MOST_OFFSET)}
_LAYER = {"name": values.name} | _OFTEN
_CONTOUR: dict[str, values.Check] = {
    "layer": values.name,
    "kind": values.choice(KINDS),
    "at": values.place,
    "size": values.size,
    **{key: check for key, check in _OFTEN.items() if key != "slug_tab"},
    "tabs": values.tabs,
    "start": values.place,
    "entry": values.place,
    "order": values.whole(1, 1_000_000),
}
TAPE: dict[str, values.Check] = {"style": values.choice(STYLES), "short_name": values.flag}
_PRICE: dict[str, values.Check] = {
    "per_area": values.by_pass(),
    "per_hole": values.number(0.0, values.MOST_MONEY),
    "per_pass": values.number(0.0, values.MOST_MONEY),
    "currency": values.text,
}
_TOP: dict[str, values.Check] = {
    "schema": values.whole(SCHEMA, SCHEMA),
    "drawing": values.file_name,
    "sha256": values.checksum,
    "box": values.box,
    "starts": values.places,
}
#: The tables of a file, with their keys; those of lists.
TABLES = {
    "read": _READ,
    "machine": _MACHINE,
    "place": _PLACE,
    "copies": _COPIES,
    "default": _DEFAULT,
    "tape": TAPE,
    "price": _PRICE,
}
_LISTS = {"layer": _LAYER, "contour": _CONTOUR}
#: The fields of a job that each table is made into.
_PARTS: dict[str, dict[str, Callable[..., Any]]] = {
    "read": {"read": partial(ReadOptions, open=None)},
    "machine": {"setup": Setup, "board": BoardOptions, "policy": Policy},
    "place": {"place": Place},
    "copies": {"copies": Copies},
    "default": {"default": Overrides},
    "tape": {"tape": TapeForm},
    "price": {"price": Price},
}
#: The keys that a setup may have: what a shop keeps for one machine and wire.
SETUP: dict[str, tuple[str, ...]] = {
    "machine": ("wire", "gap", "offset", "rom", "ram", "feed", "rates"),
    "default": ("passes", "tab_passes"),
    "tape": tuple(TAPE),
    "price": tuple(_PRICE),
}


def load(text: str, name: str, setup: Tables | None = None) -> Job:
    """Read a job file's text; `name` is the file's name, for messages. `setup`: tables for what it does not say."""
    return from_data(toml.parsed(text, name), name, setup)


def decoded(data: bytes, name: str, setup: Tables | None = None) -> Job:
    """Read a job file's bytes: UTF-8. `setup`: tables for what it does not say."""
    return load(toml.decoded(data, name), name, setup)


def decoded_setup(data: bytes, name: str) -> Tables:
    """Read a setup file's bytes: some keys of a job file's tables."""
    return setup_from_data(toml.parsed(toml.decoded(data, name), name), name)


def setup_from_data(data: object, name: str) -> Tables:
    """Make a setup's tables of plain data; what is wrong with these is a `UserError` as of a job."""
    top = expect_table(data, name)
    _refuse_unknown(top, SETUP, name)
    tables = _tables(top, {table: {key: TABLES[table][key] for key in keys} for table, keys in SETUP.items()}, name)
    _made(tables, name)
    return {table: keys for table, keys in tables.items() if keys}


def encoded_setup(setup: Tables) -> bytes:
    """The bytes of a setup file."""
    lines: list[str] = []
    for table in SETUP:
        if keys := setup.get(table):
            lines += [*[""] * bool(lines), f"[{table}]", *pairs(keys)]
    return "".join(f"{line}\n" for line in lines).encode("utf-8", toml.ODD)


def over(tables: Tables, setup: Tables) -> dict[str, dict[str, Any]]:
    """Tables with those of a setup for what they do not say: a wire takes the place of an offset, and an offset that of
    wire and gap."""
    merged = {table: dict(keys) for table, keys in tables.items()}
    for table, keys in setup.items():
        own = merged.setdefault(table, {})
        instead = {"offset": ("wire", "gap"), "wire": ("offset",)} if table == "machine" else {}
        beaten = {beaten for key in own for beaten in instead.get(key, ())}
        merged[table] = {key: value for key, value in keys.items() if key not in beaten} | own
    return merged


def encoded(job: Job) -> bytes:
    """The bytes of a job file."""
    return dump(job).encode("utf-8", toml.ODD)


def from_data(data: object, name: str | Phrase, setup: Tables | None = None) -> Job:
    """Make the job of plain data; what is wrong with these is a `UserError` that begins with the name and the place.
    `setup`: tables for what they do not say."""
    top = expect_table(data, name)
    _refuse_unknown(top, {**_TOP, **TABLES, **_LISTS}, name)
    settings = checked_values({key: value for key, value in top.items() if key in _TOP}, _TOP, name)
    for key in ("schema", "drawing"):
        if key not in settings:
            missing = Finding("schema-missing", schema=SCHEMA) if key == "schema" else Finding("key-missing", key=key)
            raise UserError(missing.within(name))
    del settings["schema"]
    tables = over(_tables(top, TABLES, name), setup or {})
    layers = _layers(_list(top, "layer", name))
    contours = tuple(_chosen(table, where) for table, where in _list(top, "contour", name))
    _refuse_twins(contours, name)
    return Job(layers=layers, contours=contours, **_made(tables, name), **settings)


def _tables(
    top: Mapping[str, Any], known: Mapping[str, dict[str, values.Check]], name: str | Phrase
) -> dict[str, dict]:
    """The tables that are known, their values checked."""
    return {
        key: checked_values(expect_table(top.get(key, {}), name, f"[{key}]"), keys, name, f"[{key}]")
        for key, keys in known.items()
    }


def _made(tables: Tables, name: str | Phrase) -> dict[str, Any]:
    """The parts of a job that its tables are, by their names as fields."""
    parts: dict[str, Any] = {}
    for key, keys in tables.items():
        try:
            parts |= made({key: keys})
        except UserError as error:
            raise error.within(name, f"[{key}]") from None
    return parts


def made(tables: Tables) -> dict[str, Any]:
    """The parts of a job that tables of checked values are, by their names as fields."""
    return {
        field: part(**{key: value for key, value in keys.items() if key in vars(part())})
        for table, keys in tables.items()
        for field, part in _PARTS[table].items()
    }


def _layers(entries: list[tuple[dict[str, Any], Where]]) -> dict[str, Overrides]:
    layers: dict[str, Overrides] = {}
    for entry, where in entries:
        layer = _required(entry, ("name",), where)[0]
        if layer.lower() in map(str.lower, layers):
            raise UserError(Finding("layer-twice", layer=layer).within(*where))
        layers[layer] = Overrides(**entry)
    return layers


def _chosen(table: dict[str, Any], where: Where) -> Chosen:
    layer, kind, place, size = _required(table, ("layer", "kind", "at", "size"), where)
    return Chosen(layer, kind, place, size, Overrides(**table))


def _required(table: dict[str, Any], keys: tuple[str, ...], where: Where) -> list[Any]:
    """Take values out that must be there."""
    for key in keys:
        if key not in table:
            raise UserError(Finding("key-missing", key=key).within(*where))
    return [table.pop(key) for key in keys]


def _refuse_twins(contours: tuple[Chosen, ...], name: str | Phrase) -> None:
    seen: dict[Chosen, int] = {}
    for number, chosen in enumerate(contours, 1):
        first = seen.setdefault(replace(chosen, overrides=Overrides()), number)
        if first != number:
            raise UserError(Finding("contour-twice", first=first).within(name, f"[[contour]] {number}"))


def _list(top: Mapping[str, Any], key: str, name: str | Phrase) -> list[tuple[dict[str, Any], Where]]:
    """The entries of a list of tables, checked, each with its place."""
    entries = top.get(key, [])
    if not isinstance(entries, list):
        raise UserError(Finding("expected-tables", key=key).within(name))
    tables: list[tuple[dict[str, Any], Where]] = []
    for number, entry in enumerate(entries, 1):
        where = name, f"[[{key}]] {number}"
        tables.append((checked_values(expect_table(entry, *where), _LISTS[key], *where), where))
    return tables


def expect_table(data: object, *where: str | Phrase) -> dict[str, Any]:
    if not isinstance(data, dict):
        raise UserError(Finding("expected-table").within(*where))
    return data


def _refuse_unknown(data: Mapping[str, Any], keys: Mapping[str, object], *where: str | Phrase) -> None:
    for key in data:
        if key not in keys:
            near = get_close_matches(str(key), keys, 1, 0.5)
            short_key = str(key)[:40]
            unknown = Finding("unknown-key", key=short_key, keys=tuple(keys))
            close = Finding("unknown-key-near", key=short_key, near=near[0]) if near else unknown
            raise UserError(close.within(*where))


def checked_values(data: Mapping[str, Any], keys: Mapping[str, values.Check], *where: str | Phrase) -> dict[str, Any]:
    """The values, as the checks return them."""
    _refuse_unknown(data, keys, *where)
    checked = {}
    for key, value in data.items():
        try:
            checked[key] = keys[key](value)
        except values.Wrong as wrong:
            finding = Finding("wrong-value", key=key, value=_told(value), wrong=wrong.why)
            raise UserError(finding.within(*where)) from None
    return checked


def _told(value: object) -> str:
    """A value in a message as TOML has it, the beginning of a long one."""
    text = str(value).lower() if isinstance(value, bool) else " ".join(repr(value).split())
    return text if len(text) <= 40 else f"{text[:40]}…"


def to_data(job: Job) -> dict[str, Any]:
    """The job as plain data: what is not said is left out."""
    tables = {table: _changed(job, table) for table in _PARTS} | {"default": job.default.set_fields()}
    return {
        "schema": SCHEMA,
        "drawing": job.drawing,
        **{key: value for key in ("sha256", "box", "starts") if (value := _plain(getattr(job, key)))},
        **{key: {name: _plain(value) for name, value in tables[key].items()} for key in TABLES if tables[key]},
        **_lists(job),
    }


def table_of(job: Job, table: str) -> dict[str, Any]:
    """The keys of a table with a job's values."""
    return {key: value for field in _PARTS[table] for key, value in vars(getattr(job, field)).items()}


def _changed(job: Job, table: str) -> dict[str, Any]:
    """The keys of a table that are not as usual; those of several parts in the table's order."""
    parts = _PARTS[table]
    usual = {key: value for part in parts.values() for key, value in vars(part()).items()}
    found = {key: value for key, value in table_of(job, table).items() if value != usual[key]}
    return found if len(parts) == 1 else {key: found[key] for key in TABLES[table] if key in found}


def _lists(job: Job) -> dict[str, Any]:
    layers = [
        {"name": name, **{key: _plain(value) for key, value in overrides.set_fields().items()}}
        for name, overrides in job.layers.items()
    ]
    contours = [
        {
            "layer": chosen.layer,
            "kind": chosen.kind,
            "at": list(chosen.place),
            "size": list(chosen.size),
            **{key: _plain(value) for key, value in chosen.overrides.set_fields().items()},
        }
        for chosen in job.contours
    ]
    return {key: tables for key, tables in (("layer", layers), ("contour", contours)) if tables}


def _plain(value: object) -> object:
    """A value with lists in place of tuples."""
    return [_plain(item) for item in value] if isinstance(value, tuple) else value


def dump(job: Job) -> str:
    """The text of a job file."""
    lines: list[str] = []
    data = to_data(job)
    for key in (*_TOP, *TABLES, *_LISTS):
        value = data.get(key)
        if isinstance(value, dict):
            lines += ["", f"[{key}]", *pairs(value)]
        elif key in _LISTS:
            for table in value or []:
                lines += ["", f"[[{key}]]", *pairs(table)]
        elif value is not None:
            lines += pairs({key: value})
    return "\n".join(lines) + "\n"


def pairs(table: Mapping[str, object]) -> list[str]:
    """Keys with their values, as a file has them."""
    return [f"{key} = {_in_toml(_plain(value))}" for key, value in table.items()]


def _in_toml(value: object) -> str:
    """A value as TOML has it: JSON's texts, lists, numbers, true and false are the same there, but for DEL."""
    return json.dumps(value, ensure_ascii=False, allow_nan=False).replace("\x7f", "\\u007f")
