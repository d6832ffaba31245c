"""The licences of what a release takes in from others, as one text."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from email.parser import Parser
from pathlib import Path

#: Texts of what brings none along, or is no package: `NAME.txt`.
TEXTS = Path(__file__).resolve().parent / "notices"
#: Names of files with a licence.
_LICENCE = re.compile(r"(LICEN[CS]E|COPYING|NOTICE|COPYRIGHT|AUTHORS)([._-].*)?", re.I)
#: Where the sources of what obliges to name them are: package -> a sentence.
SOURCES = {
    "shapely": "GEOS, which comes with Shapely, is under the LGPL 2.1: its sources are at https://libgeos.org, and its "
    "libraries in shapely.libs may be replaced by others that you built.",
    "tqdm": "tqdm is in part under the MPL 2.0, https://mozilla.org/MPL/2.0: its sources are these files themselves.",
}


@dataclass(frozen=True)
class Notice:
    """A thing with its licence: the licence's name, its whole text."""

    name: str
    version: str
    licence: str
    text: str


class NoLicence(Exception):
    """A package whose licence nobody has."""


def of_packages(folder: Path, names: Iterable[str] | None = None) -> Iterator[Notice]:
    """The notices of the packages of a folder, or of those named: what lies in their dist-info, else in TEXTS."""
    wanted = None if names is None else {_plain(name) for name in names}
    for info in sorted(folder.glob("*.dist-info"), key=lambda path: path.name.lower()):
        head = Parser().parsestr((info / "METADATA").read_text(encoding="utf-8"), headersonly=True)
        name = _plain(head["Name"])
        if wanted is not None and name not in wanted:
            continue
        files = sorted(file for file in info.rglob("*") if file.is_file() and _LICENCE.fullmatch(file.name))
        texts = [file.read_text(encoding="utf-8", errors="replace") for file in files]
        texts += [file.read_text(encoding="utf-8") for file in [TEXTS / f"{name}.txt"] if file.exists()]
        if not texts:
            raise NoLicence(f"{head['Name']} brings no licence along: put its text into {TEXTS / name}.txt")
        yield Notice(head["Name"], head["Version"], _licence(head), "\n\n".join(texts))


def _plain(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def _licence(head: object) -> str:
    """The licence's name as the package's metadata have it."""
    for value in (head["License-Expression"], head["License"]):
        if value and "\n" not in value and value != "UNKNOWN" and len(value) < 80:
            return value
    classifiers = head.get_all("Classifier") or []
    return ", ".join(one.rpartition(" :: ")[2] for one in classifiers if one.startswith("License ::")) or "see below"


def of_file(name: str, version: str, licence: str, *files: Path) -> Notice:
    """The notice of a thing that is no package, out of files."""
    return Notice(name, version, licence, "\n\n".join(file.read_text(encoding="utf-8") for file in files))


def written(title: str, notices: Iterable[Notice]) -> str:
    """All notices as a text: a list, then each licence in full."""
    every = list(notices)
    rows = [f"  {one.name:24} {one.version:12} {one.licence}" for one in every]
    sources = [f"{SOURCES[_plain(one.name)]}\n" for one in every if _plain(one.name) in SOURCES]
    parts = [f"{'=' * 78}\n{one.name} {one.version}\n{'=' * 78}\n\n{one.text.strip()}\n" for one in every]
    return "\n".join([f"{title}\n", *rows, "", *sources, *parts]).replace("\r\n", "\n")
