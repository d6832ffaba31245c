"""Advice that messages give: a robot follows each on the command line, in a job file and on the page's server, and all
three come to the same tape."""

from __future__ import annotations

import shutil
import tomllib
from pathlib import Path

import pytest
from test_messages import CATALOGUES, settings, texts
from toolhelp import ROOT, Run

from skg.cutting.progress import in_silence
from skg.job import file as job_files
from skg.messages.render import Medium, Speech, _Wording
from skg.messages.settings import KEYS, SETTINGS, TOP
from skg.ui.desk import Desk

BRACKET = ROOT / "docs/pictures/bracket.dxf"
#: A value for what is advised without one, or with one of the drawing's: as the option has it, as a job has it.
EXAMPLES = {
    "units": ("mm", "mm"),
    "open": ("cut", "cut"),
    "tolerance": ("0.01", 0.01),
    "start-layer": ("NOTES", "NOTES"),
    "fit-tolerance": ("0.001", 0.001),
    "encoding": ("gbk", "gbk"),
    "layer": ("PART", ["PART"]),
    "wire": ("0.2", 0.2),
    "gap": ("0.01", 0.01),
    "offset": ("0.15", 0.15),
    "rom": ("standard", "standard"),
    "ram": ("16", 16),
    "thickness": ("20", 20),
    "side": ("on", "on"),
    "passes": ("0.06,0", [0.06, 0]),
    "tab": ("1", 1),
    "slug-tab": ("1", 1),
    "tabs": ("2", 2),
    "tab-passes": ("0.02", [0.02]),
    "overlap": ("0.5", 0.5),
    "start": ("-5,-5", [[-5, -5]]),
}
#: What an advice needs beside it.
NEEDS = {"tabs": {"tab": ("2", 2)}, "tab-passes": {"tab": ("2", 2), "passes": ("0.06,0", [0.06, 0])}}


def advised() -> list[str]:
    """Each setting, with its value, that a sentence advises, and that a job has."""
    fields = {field for entry in CATALOGUES["en"].values() for field in settings(texts(entry)[-1])}
    return sorted(field for field in fields if field.removeprefix("--").partition("=")[0] in SETTINGS)


def table_of(name: str) -> tuple[str | None, str]:
    """The table of a job and the key of a setting."""
    key = KEYS.get(name, name.replace("-", "_"))
    return (None if key in TOP else SETTINGS[name][0]), key


def in_job(name: str, given: str, value: object) -> tuple[str | None, str, object]:
    """Table, key and value, as the sentence says them beside a job file."""
    written, _, table = _Wording(Speech("en", Medium.JOB)).setting(name, given).rpartition(" under ")
    ((key, loaded),) = tomllib.loads(written).items()
    assert (table.strip("[]"), key) == table_of(name)
    return table.strip("[]"), key, loaded


@pytest.mark.wording
@pytest.mark.parametrize("field", advised())
def test_each_advice_is_followed_in_three_places(run: Run, tmp_path: Path, field: str) -> None:
    name, _, value = field.removeprefix("--").partition("=")
    given, wanted = (value, value) if value and not value.startswith("$") else EXAMPLES[name]
    table, key = table_of(name)
    if value:
        table, key, wanted = in_job(name, given, wanted)
    asked = {(table, key): wanted}
    words = [f"--{name}={given}"]
    base = {"wire": ("0.2", 0.2)} if name not in ("wire", "offset") else {}
    for other, (text, number) in (base | NEEDS.get(name, {})).items():
        asked[table_of(other)] = number
        words.append(f"--{other}={text}")
    part = tmp_path / BRACKET.name
    shutil.copyfile(BRACKET, part)
    tapes = [tmp_path / f"{place}.3b" for place in ("command", "job", "page")]
    assert run("cut", part, "-o", tapes[0], *words).exit_code == 0
    data = {"schema": 1, "drawing": part.name}
    for (where, what), number in asked.items():
        (data if where is None else data.setdefault(where, {}))[what] = number
    job = tmp_path / "part.job.toml"
    job.write_bytes(job_files.encoded(job_files.from_data(data, "job")))
    assert run("cut", job, "-o", tapes[1]).exit_code == 0
    desk = Desk(in_silence)
    page = desk.open(part.read_bytes(), part.name, None)["state"]["job"]
    for (where, what), number in asked.items():
        (page if where is None else page.setdefault(where, {}))[what] = number
    desk.plan(page)
    tapes[2].write_bytes(desk.cut(1)[1]["tape"])
    assert len({tape.read_bytes() for tape in tapes}) == 1


def test_the_robot_knows_every_setting() -> None:
    assert EXAMPLES.keys() <= SETTINGS.keys() and len(advised()) > 20
