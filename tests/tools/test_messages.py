"""Messages: both catalogues complete, their values those that the code gives, advice that can be followed."""

from __future__ import annotations

import ast
import re
import string
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import polib
import pytest

from skg.commands.cut import command
from skg.job.file import _MACHINE, _READ, _TOP
from skg.job.wanted import Overrides
from skg.messages.catalogue import LANGUAGES
from skg.messages.finding import Finding, Phrase
from skg.messages.render import Medium, Speech, advice, line, text
from skg.messages.settings import KEYS, SETTINGS
from skg.messages.severity import _CARE, _GUESS, _LOST, Severity, severity_of

pytestmark = pytest.mark.wording

SKG = Path(__file__).parents[2] / "tools" / "skg"
#: The page's sources.
UI = SKG.parents[1] / "web" / "src" / "ui"
CATALOGUES = {
    language: {entry.msgid: entry for entry in polib.pofile(str(SKG / "messages" / f"{language}.po"))}
    for language in LANGUAGES
}
#: Codes that are put together: a page's labels, words for settings' values.
MADE = re.compile(
    r"(label|value|kind|count|repair|side|error|sheet|meaning|tool)-|(care|plain|.*-separator|setting-in-job|setting-on-page|field-on-page)$"
)


def texts(entry: polib.POEntry) -> list[str]:
    """An entry's sentences: one, or singular and plural."""
    return list(entry.msgstr_plural.values()) or [entry.msgstr]


def fields(template: str) -> Iterator[str]:
    """The fields of a template."""
    return (field for _, field, _, _ in string.Formatter().parse(template) if field)


def values(template: str) -> set[str]:
    """The values that a template has: those of its settings, too."""
    names = (field.split("=$")[-1] if field.startswith("--") else field for field in fields(template))
    return {field for field in names if not field.startswith("--")}


def settings(template: str) -> set[str]:
    """The settings that a template advises."""
    return {field for field in fields(template) if field.startswith("--")}


def uses() -> Iterator[tuple[str, set[str], str]]:
    """The codes that the sources use, with the names of the values, and where."""
    for path in sorted(SKG.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text())):
            if not (isinstance(node, ast.Call) and isinstance(node.func, ast.Name)):
                continue
            if node.func.id not in ("Finding", "Phrase") or not node.args:
                continue
            place = f"{path.relative_to(SKG)}:{node.lineno}"
            names = {keyword.arg or "**" for keyword in node.keywords}
            codes = list(literals(node.args[0]))
            for code in codes:
                yield code, names - ({"contour"} if node.func.id == "Finding" else set()), place


def given() -> Iterator[tuple[str, str]]:
    """The codes that are given to a routine, which makes the finding of its argument, and where."""
    trees = {path: ast.parse(path.read_text()) for path in sorted(SKG.rglob("*.py"))}
    classes = {name: place for tree in trees.values() for name, place in makers(tree).items() if name[0].isupper()}
    for path, tree in trees.items():
        own = classes | makers(tree)
        for node in ast.walk(tree):
            name = getattr(node.func, "id", getattr(node.func, "attr", "")) if isinstance(node, ast.Call) else ""
            if name in own and len(node.args) > own[name]:
                for code in literals(node.args[own[name]]):
                    yield code, f"{path.relative_to(SKG)}:{node.lineno}"


def makers(tree: ast.Module) -> dict[str, int]:
    """Routines, and classes by their `__init__`, that make a finding of a code, with the place of that argument."""
    places = {}
    inits = {id(item): node.name for node in ast.walk(tree) if isinstance(node, ast.ClassDef) for item in node.body}
    for routine in ast.walk(tree):
        if not isinstance(routine, ast.FunctionDef):
            continue
        names = [argument.arg for argument in routine.args.args]
        names = names[1:] if names[:1] == ["self"] else names
        for node in ast.walk(routine):
            is_made = isinstance(node, ast.Call) and getattr(node.func, "id", "") in ("Finding", "Phrase")
            if is_made and node.args and getattr(node.args[0], "id", "") in names:
                name = inits[id(routine)] if routine.name == "__init__" else routine.name
                places[name] = names.index(node.args[0].id)
    return places


def literals(node: ast.expr) -> Iterator[str]:
    """The codes that an expression may have."""
    if isinstance(node, ast.Constant):
        yield node.value
    elif isinstance(node, ast.IfExp):
        yield from (*literals(node.body), *literals(node.orelse))


def test_catalogues_have_the_same_codes_and_values() -> None:
    english, chinese = CATALOGUES["en"], CATALOGUES["zh"]
    assert len(english) > 30 and english.keys() ^ chinese.keys() == set()
    for code, entry in english.items():
        for sentence in texts(entry) + texts(chinese[code]):
            known = values(texts(entry)[-1])
            # (a singular may have the number as a word, a Chinese sentence no plural, and no words of a library)
            assert values(sentence) | {"count", "detail"} == known | {"count", "detail"}, code
            assert settings(sentence) == settings(texts(entry)[-1]), code


def test_chinese_is_chinese() -> None:
    """Each sentence has Han characters, unless the English one has no words either; full-width marks beside them."""
    for code, entry in CATALOGUES["zh"].items():
        words = re.sub(r"\{.*?\}", "", texts(CATALOGUES["en"][code])[0])
        (sentence,) = texts(entry)
        assert "detail" not in values(sentence), f"{code}: the words of a library are English"
        if re.search(r"[a-z]{3}", words) and not code.startswith("label-") and words != sentence:
            assert re.search(r"[\u4e00-\u9fff]", sentence), code
        assert not re.search(r"[\u4e00-\u9fff][,;:?!]|[,;:?!][\u4e00-\u9fff]", sentence), code


def test_codes_that_are_used_are_known_and_all_are_used() -> None:
    used = defaultdict(set)
    for code, names, place in uses():
        assert code in CATALOGUES["en"], f"{place}: {code}"
        used[code] |= names
        wanted = values(texts(CATALOGUES["en"][code])[-1])
        if "**" not in names:
            assert wanted - names <= {"place"}, f"{place}: {code}: {wanted - names}"
            assert names - wanted <= {"place", "count"}, f"{place}: {code}: {names - wanted}"
    assert used
    codes = list(given())
    assert len(codes) > 15
    for code, place in codes:
        assert code in CATALOGUES["en"], f"{place}: {code}"
    mentioned = "".join(path.read_text() for path in SKG.rglob("*.py"))
    unused = [code for code in CATALOGUES["en"] if not MADE.match(code) and f'"{code}"' not in mentioned]
    assert unused == []


def test_severities_are_of_known_codes() -> None:
    assert not _CARE & _LOST and not (_CARE | _LOST) & _GUESS
    assert set(CATALOGUES["en"]) >= _CARE | _LOST | _GUESS
    assert severity_of("drift") is Severity.CARE and not severity_of("plain").is_kept


def test_settings_are_options_and_keys_of_job_files() -> None:
    options = {name for parameter in command.params for name in parameter.opts}
    tables = {"read": _READ, "machine": _MACHINE, "default": vars(Overrides())}
    for name, (table, label) in SETTINGS.items():
        key = KEYS.get(name, name.replace("-", "_"))
        assert f"--{name}" in options
        assert key in tables[table] or key in _TOP
        assert label in CATALOGUES["en"]


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_medium_has_its_words(language: str) -> None:
    finding = Finding("plain", text="").within("part.dxf")
    assert line(finding, Speech(language)).startswith("part.dxf")
    assert "注意" in line(Finding("drift", drift=1.0), Speech("zh"))
    assert text(Phrase("plain", text=("a", "b", 0.25)), Speech("en")) == "a, b, 0.25"


def test_advice_is_in_the_words_of_the_medium(monkeypatch: pytest.MonkeyPatch) -> None:
    from skg.messages import render

    sentence = "{--small=leave} {--tolerance=$gap} {--tab} {--layer=$name}"
    monkeypatch.setattr(render, "template", lambda code, *rest: sentence if code == "x" else template(code, *rest))
    from skg.messages.catalogue import template

    finding = Finding("x", gap=0.35, name="A")
    assert text(finding) == "--small leave --tolerance 0.35 --tab --layer A"
    job = text(finding, Speech("en", Medium.JOB))
    assert job == 'small = "leave" under [machine] tolerance = 0.35 under [read] tab layers = ["A"] under [read]'
    page = text(finding, Speech("zh", Medium.PAGE))
    assert page == "“过小轮廓：不切割” “缺口连接上限：0.35” “暂留量” “图层与轮廓：A”"
    assert list(advice(finding)) == [("small", "leave"), ("tolerance", "0.35"), ("tab", None), ("layer", "A")]


def test_pages_fields_have_the_labels_of_the_page() -> None:
    """Advice on the page names a field as the page does."""
    words = (UI / "words.ts").read_text()
    labels = [label for _, label in SETTINGS.values() if label not in ("label-fit-tolerance", "label-encoding")]
    for label in labels:
        pair = [text(Phrase(label), Speech(language)) for language in LANGUAGES]
        assert f'["{pair[0]}", "{pair[1]}"]' in words, label


def test_page_takes_each_advice() -> None:
    """By a button with its value, or by the field that decides it."""
    known = set(re.findall(r'^  "?([\w-]+(?:=[\w-]+)?)"?: "', (UI / "fixes.ts").read_text(), re.M))
    advised = {field for entry in CATALOGUES["en"].values() for field in settings(texts(entry)[-1])}
    fields = {field.removeprefix("--") for field in advised if field.removeprefix("--").partition("=")[0] in SETTINGS}
    assert len(fields) > 15 and len(known) > 20
    assert {field for field in fields if not {field, field.partition("=")[0]} & known} == set(), "no row in fixes.ts"
    parted = [field.partition("=") for field in fields if "=" in field and "$" not in field]
    unnamed = {value for name, _, value in parted if f"value-{value}" not in CATALOGUES["zh"] and name != "encoding"}
    assert not unnamed, "no word on the page"


def test_inner_packages_know_no_options() -> None:
    """The command line is known to the commands alone: advice stands in the catalogues."""
    looked = 0
    for package in ("reading", "planning", "checking", "cutting", "pipeline", "job"):
        for path in sorted((SKG / package).rglob("*.py")):
            tree = ast.parse(path.read_text())
            docstrings = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
            for node in ast.walk(tree):
                if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docstrings:
                    looked += 1
                    assert not re.search(r"(?<![\w(*])--[a-z]{3}", node.value), f"{path}:{node.lineno}: {node.value}"
    assert looked > 500


def test_sentences_stand_in_the_catalogues() -> None:
    """What is raised or told is a finding. (The reference has its own words: those of the specification.)"""
    takers = {"UserError", "BoardStopped", "Conflict", "Ended", "Stopped", "Misread", "UsageError", "BadParameter"}
    takers |= {"tell", "say", "remark", "warn", "fail", "TextFault", "PlaneError"}
    looked = 0
    for path in sorted(SKG.rglob("*.py")):
        if path.relative_to(SKG).parts[0] == "ref":
            continue
        for node in ast.walk(ast.parse(path.read_text())):
            name = getattr(node.func, "id", getattr(node.func, "attr", "")) if isinstance(node, ast.Call) else ""
            if name not in takers:
                continue
            for argument in node.args[:2]:
                looked += 1
                parts = argument.values if isinstance(argument, ast.JoinedStr) else [argument]
                texts = [part.value for part in parts if isinstance(part, ast.Constant) and isinstance(part.value, str)]
                assert not any(" " in text.strip() for text in texts if text not in ("skg term", "skg ui")), (
                    f"{path}:{node.lineno}"
                )
    assert looked > 100
