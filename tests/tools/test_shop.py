"""The sessions of docs/shop.md are true; run as a program, this updates the page."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from test_docs import EXAMPLE, ROOT, indented, printed, with_links

PAGE = ROOT / "docs" / "shop.md"
#: The page in each language, on a system that speaks it.
PAGES = {"en": PAGE, "zh": ROOT / "docs" / "zh" / "shop.md"}
each = pytest.mark.parametrize("language", PAGES)
#: Only a picture is written of these.
_PICTURE = re.compile(r"(-o|--sheet) docs/pictures/\S+")


@each
@pytest.mark.wording
def test_page(language: str, tmp_path: Path) -> None:
    """All commands in their order, in one folder: later ones read what earlier ones wrote."""
    with_links(tmp_path)
    examples = list(EXAMPLE.finditer(PAGES[language].read_text()))
    assert len(examples) >= 12
    for example in examples:
        command = _PICTURE.sub(rf"\1 {tmp_path}/picture.svg", example["command"])
        assert indented(printed(command, tmp_path, language)) == example["output"], command


@each
@pytest.mark.wording
def test_report_is_explained(language: str) -> None:
    """The report's lines in the page's table are in the report."""
    text = PAGES[language].read_text()
    report = re.search(r"\$ skg cut docs/pictures/bracket.*\n((?:    .*\n)+)", text)[1]
    told = re.search(r"\| (?:the report says|报告里的话) .*\n\|---.*\n((?:\|.*\n)+)", text)[1]
    words = re.findall(r"^\| `(.+?)` \|", told, re.M)
    assert len(words) == len(told.splitlines()) >= 8
    for word in words:
        assert all(part.strip() in report for part in word.split("…")), word


def test_page_is_short() -> None:
    assert len(PAGE.read_text().splitlines()) <= 285


def test_names_of_files() -> None:
    """The version of the wheels is the package's."""
    version = re.search(r'^version = "(.+)"$', (ROOT / "tools" / "pyproject.toml").read_text(), re.M)[1]
    assert set(re.findall(r"skg_nc-([\d.]+)-", PAGE.read_text())) == {version}


if __name__ == "__main__":
    for language, page in PAGES.items():
        page.write_text(
            EXAMPLE.sub(
                lambda match, language=language: (
                    f"    $ {match['command']}\n{indented(printed(match['command'], ROOT, language))}"
                ),
                page.read_text(),
            )
        )
