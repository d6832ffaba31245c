"""Each Chinese page has every section of the English one, with its programs, commands, tapes, pictures and tables.

Run as a program, this copies what may not differ (fences, commands with what they print, pictures) from the English
pages. The words are written by hand.
"""

from __future__ import annotations

import os
import re
from collections import Counter
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
#: Pages, English and Chinese.
PAGES = [
    (DOCS / "manual.md", DOCS / "zh" / "manual.md"),
    (DOCS / "shop.md", DOCS / "zh" / "shop.md"),
    (DOCS / "pico.md", DOCS / "zh" / "pico.md"),
    (DOCS / "about.md", DOCS / "zh" / "about.md"),
    (ROOT / "README.md", ROOT / "README.zh.md"),
]

#: A fence, commands and what they print, or a picture on a line of its own.
BLOCK = re.compile(r"^```.*\n(?:(?!```).*\n)*```$|(?:^    \S.*\n)+|^!\[(?P<caption>.*)\]\((?P<picture>.*)\)$", re.M)
#: What is said of a command behind it is translated.
REMARK = re.compile(r"(?m)^(    (?:make|py|python3) .*?\S) {3,}\S.*$")
#: The output of `skg` is in the page's language; test_shop.py runs it. So are words that a command looks for, and the
#: language that a page shows once.
PRINTED = re.compile(r"^    (?!\$ ).*\n?|(?<=grep -E ')[^']*|(?<=--lang )\w+|(?<=build/)(?:en|zh)(?=\.)", re.M)
#: The beginning of such a block: a command of `skg`, or the report on the first screen of the README.
REPORT = re.compile(r"    (?:\$ skg |70 x 30 mm)")
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
    "--lang zh": "--lang en",
    "warning": "注意",
    "70 x 30 mm, read in mm": "70 x 30 mm，按 mm 读取",
    "layer NOTES: … 1 not cut": "图层 NOTES：… 未切割 1",
    "4 contours: 4 closed": "4 个轮廓：4 个封闭",
    "3 openings, 1 outline; 4 start holes": "3 个内孔、1 个外轮廓；4 个穿丝孔",
    "openings: wire inside, offset 0.1 mm": "内孔：电极丝在内侧，补偿 0.1 mm",
    "cut length … 94 blocks, 6 stops": "切割长度 … 94 个程序段，6 次停机",
    "made by the no-drift ROM": "由 no-drift ROM",
    "at most 1.89 µm off the drawing": "与图纸最大偏差 1.89 µm",
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
        """Fences and commands as they stand, without remarks; of a picture, its file. (NAME-zh.png is NAME.png in
        Chinese)"""
        return [
            re.sub(r"-zh(?=\.png$)", "", str((self.folder / block["picture"]).resolve(strict=True)))
            if block["picture"]
            else PRINTED.sub("", block[0])
            if REPORT.match(block[0])
            else REMARK.sub(r"\1", block[0])
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


PAIRS = [pair for english, chinese in PAGES for pair in zip_longest(sections(english), sections(chinese))]
pairs = pytest.mark.parametrize(("english", "chinese"), PAIRS, ids=lambda each: each.title if each else "missing")


def test_there_is_enough() -> None:
    assert len(PAIRS) > 60
    assert sum(len(english.blocks) for english, _ in PAIRS) > 100


@pairs
def test_section_has_its_counterpart(english: Section | None, chinese: Section | None) -> None:
    assert english is not None, f"only the Chinese page has: {chinese.title}"
    assert chinese is not None, f"the Chinese page has not: {english.title}"
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
    captions = [block["caption"] for _, page in PAGES for block in BLOCK.finditer(page.read_text()) if block["picture"]]
    assert len(captions) > 20
    assert [caption for caption in captions if not re.search("[\u4e00-\u9fff]", caption)] == []


def rewritten(chinese: Path, english: Path) -> str:
    """The Chinese page with the English one's fences, commands and pictures in their places; remarks stay."""
    text = chinese.read_text()
    blocks = list(BLOCK.finditer(english.read_text()))
    if len(blocks) != len(list(BLOCK.finditer(text))):
        raise SystemExit(
            f"{chinese}: {len(list(BLOCK.finditer(text)))} blocks and pictures, {english} has {len(blocks)}"
        )
    following = iter(blocks)

    def block(match: re.Match[str]) -> str:
        other = next(following)
        if other["picture"]:
            picture = english.parent / other["picture"]
            # (a page's picture may have a Chinese sister)
            sister = picture.with_name(f"{picture.stem}-zh{picture.suffix}")
            place = os.path.relpath(sister if sister.exists() else picture, chinese.parent)
            return f"![{match['caption'] or other['caption']}]({place})"
        return match[0] if REMARK.search(other[0]) or REPORT.match(other[0]) else other[0]

    return BLOCK.sub(block, text)


if __name__ == "__main__":
    for english, chinese in PAGES:
        chinese.write_text(rewritten(chinese, english))
