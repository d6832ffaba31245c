"""Every citation of a page, in sources, tests and docs, leads to a page and a heading that exist.

A page is cited by its file and, where need be, a section: ``language.md, section 4.5``, ``language.md, sections 3 and
6``, or the heading itself, ``docs/drift.md, section "Back to the drawing"``; in Markdown also by a link, with or
without an #anchor. Nothing else will do: a section's number alone is one of the same file, in Markdown; elsewhere it is
an error.
"""

from __future__ import annotations

import re
import subprocess
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
#: What may cite: sources, tests, programs, docs.
SUFFIXES = {".asm", ".c", ".h", ".S", ".py", ".lark", ".mk", ".md", ".skg", ".toml"}
NAMES = {"Makefile", "run"}
#: This file shows forms that are wrong.
LEFT_OUT = {Path("tests/docs/test_citations.py")}
#: Numbers of tables and sections in these belong to the sources that the specification describes: "its section 1.5".
FOREIGN = re.compile(r"\b(?:its|book's|text's|whose) sections? $")

#: How a line goes on in the next: leaders of comments and of lists, so that a citation may be wrapped.
WRAP = re.compile(r"[ \t]*\n[ \t]*(?:;+|#+:?|//+|\*|>)?[ \t]*")
HEADING = re.compile(r"^#{1,6} +(.+?) *#*$", re.M)
FENCE = re.compile(r"^(```|~~~).*?^\1", re.M | re.S)
LINK = re.compile(r"\]\((?P<target>[^)\s]+)\)")
NUMBERS = r"(?P<numbers>\d+(?:\.\d+)*(?:(?:, | and | to )\d+(?:\.\d+)*)*)"
PAGE = re.compile(
    r"(?P<file>[\w./-]*\w\.md)`?(?:\]\([^)\s]+\))?"
    rf"(?:, sections? (?:{NUMBERS}|(?P<titles>\"[^\"]+\"(?: and \"[^\"]+\")*)))?"
)
#: A section or table that stands behind no page.
ALONE = re.compile(r"\b(?:sections?|tables?|chapters?|§) ?(?P<number>\d+(?:\.\d+)*)")
#: What may not follow a page's name: other ways to write a section.
BADLY = re.compile(r"`?(?:\]\([^)\s]+\))?(?:,? (?:in )?(?:sect\w*|chapters?|tables?|parts?|§)\b|,? ?\d|,? \(?\")")


@dataclass(frozen=True)
class Citation:
    """A place that cites: its file and line, what it says, and what is wrong with it (None: nothing)."""

    file: Path
    line: int
    text: str
    wrong: str | None = None

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.text}: {self.wrong}"


def headings(page: Path) -> list[str]:
    """The headings of a page, without marks of emphasis and code."""
    return [re.sub(r"[`*]", "", title) for title in HEADING.findall(FENCE.sub("", page.read_text()))]


def anchors(page: Path) -> set[str]:
    """The anchors that a heading gets on the web: lower case, without punctuation, a - for each blank."""
    found: Counter[str] = Counter()
    names = set()
    for title in headings(page):
        name = re.sub(r"[^\w\- ]", "", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", title).lower()).replace(" ", "-")
        names.add(f"{name}-{found[name]}" if found[name] else name)
        found[name] += 1
    return names


def numbered(page: Path) -> set[str]:
    """The numbers of a page's sections: `4.5` of `### 4.5 Merging`."""
    return {match[1] for title in headings(page) if (match := re.match(r"(\d+(?:\.\d+)*)\.? ", title))}


class Pages:
    """The pages of a tree, by every name under which they may be cited."""

    def __init__(self, root: Path, files: list[Path]) -> None:
        self.root = root
        self.pages = [file for file in files if file.suffix == ".md"]

    def find(self, name: str, citing: Path) -> Path | None:
        """The page of that name: beside the citing file, from the root, or the only English one of that base name;
        of several the specification's."""
        for folder in (citing.parent, Path()):
            place = Path(*_normal(folder / name))
            if place in self.pages:
                return place
        if "/" in name:
            return None
        same = [page for page in self.pages if page.name == name and page.parent.name != "zh"]
        named = [page for page in same if page.parent.name == "spec"] if len(same) > 1 else same
        return named[0] if len(named) == 1 else None

    def citations(self, citing: Path) -> list[Citation]:
        """All citations in a file."""
        raw = (self.root / citing).read_text()
        starts: list[int] = []  # for each character of `text`, its place in `raw`
        text = ""
        last = 0
        for wrap in WRAP.finditer(raw):
            text += raw[last : wrap.start()] + " "
            starts += [*range(last, wrap.start()), wrap.start()]
            last = wrap.end()
        text += raw[last:]
        starts += range(last, len(raw) + 1)
        found = []

        def cite(start: int, said: str, wrong: str | None) -> None:
            found.append(Citation(citing, raw.count("\n", 0, starts[start]) + 1, said, wrong))

        linked: list[tuple[int, int]] = []
        if citing.suffix == ".md":
            for link in LINK.finditer(text):
                linked.append(link.span("target"))
                if not re.match(r"[a-z]+:", link["target"]):
                    cite(link.start(), link["target"], self._link(link["target"], citing))
        behind: list[tuple[int, int]] = []
        for page in PAGE.finditer(text):
            if any(start <= page.start() < end for start, end in linked):
                continue
            behind.append(page.span())
            target = self.find(page["file"], citing)
            wrong = None
            if target is None:
                wrong = "no such page"
            elif page["numbers"]:
                wrong = self._sections(target, re.findall(r"[\d.]*\d", page["numbers"]))
            elif page["titles"]:
                known = headings(self.root / target)
                missing = [title for title in re.findall(r'"([^"]+)"', page["titles"]) if title not in known]
                wrong = f"no such heading: {', '.join(missing)}" if missing else None
            elif badly := BADLY.match(text, page.end("file")):
                wrong = f'a section is cited as `, section 1.2` or `, section "Title"`, not `{badly[0]}`'
            cite(page.start(), page[0], wrong)
        for alone in ALONE.finditer(text):
            if any(start <= alone.start() < end for start, end in behind):
                continue
            if FOREIGN.search(text[max(alone.start() - 12, 0) : alone.start("number")]):
                continue
            own = citing if citing.suffix == ".md" else None
            wrong = self._sections(own, [alone["number"]]) if own else "a section of which page?"
            cite(alone.start(), alone[0], wrong)
        return found

    def _sections(self, page: Path, numbers: list[str]) -> str | None:
        missing = [number for number in numbers if number not in numbered(self.root / page)]
        return f"no section {', '.join(missing)} in {page}" if missing else None

    def _link(self, target: str, citing: Path) -> str | None:
        name, _, anchor = target.partition("#")
        place = Path(*_normal(citing.parent / name)) if name else citing
        if not (self.root / place).exists():
            return "no such file"
        if anchor and (place.suffix != ".md" or anchor not in anchors(self.root / place)):
            return "no such heading"
        return None


def _normal(path: Path) -> list[str]:
    """The parts of a path without `..`."""
    parts: list[str] = []
    for part in path.parts:
        if part == ".." and parts:
            parts.pop()
        else:
            parts.append(part)
    return parts


def project_files() -> list[Path]:
    """The files that git keeps, or would keep, and that may cite."""
    listed = subprocess.run(
        ["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout
    files = [Path(name) for name in listed.split("\0") if name and (ROOT / name).exists()]
    return [file for file in files if (file.suffix in SUFFIXES or file.name in NAMES) and file not in LEFT_OUT]


def test_every_citation_leads_somewhere() -> None:
    files = project_files()
    pages = Pages(ROOT, files)
    found = [citation for file in files for citation in pages.citations(file)]
    wrong = [str(citation) for citation in found if citation.wrong]
    assert not wrong, "\n".join(wrong)
    kinds = Counter(citation.file.suffix for citation in found)
    assert all(kinds[suffix] for suffix in (".asm", ".py", ".c", ".lark", ".md", ".skg")), kinds
    with_section = [citation for citation in found if "section" in citation.text and citation.file.suffix != ".md"]
    assert len(with_section) >= 20, with_section


GOOD = {
    "a.asm": "; the route (spec.md, section 2.1)\n; and again, docs/spec.md,\n; sections 1 and 2.1\n",
    "b.py": '"""As docs/spec.md, section "Odd words: and more", has it."""\n',
    "docs/c.md": "# C\n[there](spec.md#21-a-part), [own](#c), `spec.md`, and the CNC text, its section 9.9.\n",
}
BAD = {
    "a.asm": "; spec.md, section 2.2\n",
    "b.py": "# as spec.md section 2.1 has it\n",
    "c.c": "/* spec.md, 2 */\n",
    "d.h": "/* see gone.md */\n",
    "e.py": '# docs/spec.md, section "Other words"\n',
    "f.py": "# the rows of table 2.1\n",
    "g.md": "# G\n[gone](docs/gone.md)\n",
    "h.md": "# H\n[no heading](docs/spec.md#nowhere)\n",
    "i.md": "# I\nSee section 3.\n",
    "j.asm": "; spec.md,\n; sections 1 and 3\n",
    "m.py": '# spec.md, sections "Odd words: and more" and "Other words"\n',
    "l.py": '# docs/spec.md ("Odd words: and more")\n',
    "k.md": "# K\n[spec.md](docs/spec.md), section 7\n",
}


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs" / "spec.md").write_text(
        "# Spec\n## 1. Whole\n### 2.1 A part\n```\n# 9. no heading\n```\n## Odd words: and more\n"
    )
    return tmp_path


@pytest.mark.parametrize("name", GOOD)
def test_good_forms(tree: Path, name: str) -> None:
    (tree / name).write_text(GOOD[name])
    found = Pages(tree, [Path("docs/spec.md"), Path(name)]).citations(Path(name))
    assert found
    assert [str(citation) for citation in found if citation.wrong] == []


@pytest.mark.parametrize("name", BAD)
def test_bad_forms(tree: Path, name: str) -> None:
    (tree / name).write_text(BAD[name])
    found = Pages(tree, [Path("docs/spec.md"), Path(name)]).citations(Path(name))
    assert [citation.line for citation in found if citation.wrong]
