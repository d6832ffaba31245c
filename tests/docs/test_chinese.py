"""The Chinese manual has every section of the English one, with its programs, tapes, prompts, pictures and tables.

Run as a program, this copies what may not differ (fences, pictures) from the English manual. The words are written by
hand.
"""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
ENGLISH = DOCS / "manual.md"
CHINESE = DOCS / "zh" / "manual.md"

#: A fence, or a picture on a line of its own.
BLOCK = re.compile(r"^```.*\n(?:(?!```).*\n)*```$|^!\[(?P<caption>.*)\]\((?P<picture>.*)\)$", re.M)
HEADING = re.compile(r"^(#+) (.*)$", re.M)
CODE = re.compile(r"`([^`\n]+)`")
#: Words that stand in code and are translated.
WORDS = {
    "name=expression": "名字=算式",
    "IF e rel e GOTO n": "IF e 关系 e GOTO n",
    "INPUT name,…": "INPUT 名字,…",
    "PRINT item,…": "PRINT 项,…",
    "READ name,…": "READ 名字,…",
    "REM text": "REM 文字",
    "--punch FILE": "--punch 文件",
    "--tape FILE": "--tape 文件",
}


@dataclass
class Section:
    """A heading and what stands below it until the next one."""

    level: int
    title: str
    body: str
    folder: Path

    @property
    def prose(self) -> str:
        return BLOCK.sub("", self.body)

    @property
    def blocks(self) -> list[str]:
        """Fences as they stand; of a picture, its file."""
        return [
            str((self.folder / block["picture"]).resolve()) if block["picture"] else block[0]
            for block in BLOCK.finditer(self.body)
        ]

    @property
    def codes(self) -> Counter[str]:
        """Words in code, and how often they stand in a row of a table."""
        return Counter(CODE.findall("\n".join(line for line in self.prose.splitlines() if line.startswith("|"))))

    @property
    def rows(self) -> int:
        return len(re.findall(r"^\|", self.prose, re.M))

    @property
    def points(self) -> int:
        return len(re.findall(r"^- ", self.prose, re.M))


def sections(page: Path) -> list[Section]:
    text = page.read_text()
    fences = [(block.start(), block.end()) for block in BLOCK.finditer(text)]
    heads = [head for head in HEADING.finditer(text) if not any(a < head.start() < b for a, b in fences)]
    ends = [head.start() for head in heads[1:]] + [len(text)]
    return [
        Section(len(head[1]), head[2], text[head.end() : end], page.parent)
        for head, end in zip(heads, ends, strict=True)
    ]


PAIRS = list(zip_longest(sections(ENGLISH), sections(CHINESE)))
pairs = pytest.mark.parametrize(("english", "chinese"), PAIRS, ids=lambda each: each.title if each else "missing")


def test_there_is_enough() -> None:
    assert len(PAIRS) > 40
    assert sum(len(english.blocks) for english, _ in PAIRS) > 100


@pairs
def test_section_has_its_counterpart(english: Section | None, chinese: Section | None) -> None:
    assert english is not None, f"only the Chinese manual has: {chinese.title}"
    assert chinese is not None, f"the Chinese manual has not: {english.title}"
    assert chinese.level == english.level
    number = re.match(r"\d+\.|", english.title)[0]
    assert chinese.title.startswith(number)
    if re.fullmatch(r"[A-Z, ]+", english.title):
        assert chinese.title.replace("、", ", ") == english.title


@pairs
def test_blocks_are_the_same(english: Section, chinese: Section) -> None:
    """Programs, tapes, prompts, paper and pictures, in the same order."""
    assert chinese.blocks == english.blocks


@pairs
def test_tables_are_the_same(english: Section, chinese: Section) -> None:
    """As many rows, with the same examples and results."""
    assert chinese.rows == english.rows
    assert chinese.codes == Counter({WORDS.get(code, code): count for code, count in english.codes.items()})


@pairs
def test_code_in_the_text_is_the_same(english: Section, chinese: Section) -> None:
    """Each form, name and example of the prose is in both."""
    said = {WORDS.get(code, code) for code in CODE.findall(english.prose)}
    assert set(CODE.findall(chinese.prose)) == said
    assert chinese.points == english.points


@pairs
def test_is_chinese(english: Section, chinese: Section) -> None:
    """Written in Chinese, with full-width punctuation beside Chinese characters."""
    words = CODE.sub("", re.sub(r"\]\([^)]*\)", "]", chinese.prose))
    if len(english.prose.split()) > 10:
        assert re.search("[\u4e00-\u9fff]{4}", words)
    assert re.findall(r"[\u4e00-\u9fff][,;:?!()]|[,;:?!()][\u4e00-\u9fff]", words) == []


def test_captions_are_chinese() -> None:
    captions = [block["caption"] for block in BLOCK.finditer(CHINESE.read_text()) if block["picture"]]
    assert len(captions) > 20
    assert [caption for caption in captions if not re.search("[\u4e00-\u9fff]", caption)] == []


def rewritten(chinese: str, english: str) -> str:
    """The Chinese page with the English one's fences and pictures in their places."""
    blocks = list(BLOCK.finditer(english))
    if len(blocks) != len(BLOCK.findall(chinese)):
        raise SystemExit(f"{CHINESE}: {len(BLOCK.findall(chinese))} fences and pictures, {ENGLISH} has {len(blocks)}")
    following = iter(blocks)

    def block(match: re.Match[str]) -> str:
        other = next(following)
        if other["picture"]:
            return f"![{match['caption'] or other['caption']}](../{other['picture']})"
        return other[0]

    return BLOCK.sub(block, chinese)


if __name__ == "__main__":
    CHINESE.write_text(rewritten(CHINESE.read_text(), ENGLISH.read_text()))
