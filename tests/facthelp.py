"""Messages by their facts: what a test asks of a message is what it tells, not how it is worded.

A fact is a code with the values that matter, `Phrase("open-end", gap=0.1, advice=Phrase("tolerance-joins"))`; what has
no code, as in what the emulator says, is a place, a number, an option, a name. These stand as a whole: 12 is not in
120, in 12.5 or in -12, `gap` not in `gape`, but in `Gaps`. A compiled pattern is a fact too, for a number that is known
to some places.

A code is looked for in a text by its template, so that no test has a sentence: `pytest --codes` runs the tests with
codes instead of sentences.
"""

from __future__ import annotations

import re
import string
from collections.abc import Iterable, Mapping

from skg.messages.catalogue import template
from skg.messages.finding import Finding, Phrase
from skg.messages.render import Medium, Speech, _Wording, advice, speech, text

#: The beginning of a line that warns and does not refuse.
CARE = text(Phrase("care", text="")).rstrip()


def shape(fact: object) -> str:
    """A regular expression of one fact."""
    if isinstance(fact, re.Pattern):
        return f"(?:{fact.pattern})"
    if isinstance(fact, Phrase):
        return f"(?:{_template_shape(fact)})"
    return _text_shape(str(fact))


def _text_shape(text: str) -> str:
    """A regular expression of a text that stands as a whole."""
    first, last = text[0], text[-1]
    before = behind = ""
    if first.isdigit():
        before = r"(?<![\w.])(?<!^-)(?<!\D-)"
    elif first.isalpha():
        before = r"(?<!\w)"
    if last.isdigit():
        behind = r"(?!\w|\.\d)"
    elif last.isalpha():
        behind = r"(?:e?s)?(?!\w)" if last.islower() else r"(?!\w)"
    whole = before + re.escape(text) + behind
    return f"(?i:{whole})" if text.islower() else whole


def _template_shape(phrase: Phrase) -> str:
    """A regular expression of a code's sentence, with the values that the phrase has, and whatever others."""
    values = dict(phrase.values)
    counts = [values["count"]] if "count" in values else [1, 2]
    forms = dict.fromkeys(template(phrase.code, speech.language, count) for count in counts)
    assert all(form != phrase.code or form == "plain" for form in forms), f"no such code: {phrase.code}"
    parts = [part for form in forms for part in string.Formatter().parse(form)]
    unknown = values.keys() - {field for _, field, _, _ in parts} - {"count"}
    assert not unknown, f"{phrase.code} has no {unknown}"
    assert values or any(re.search(r"\w\w", before) for before, *_ in parts), f"any text is {phrase.code}"
    shapes = (
        "".join(
            re.escape(before) + ("" if field is None else _field_shape(field, spec or "", conversion, values))
            for before, field, spec, conversion in string.Formatter().parse(form)
        )
        for form in forms
    )
    return "|".join(shapes)


def _field_shape(field: str, spec: str, conversion: str | None, values: Mapping[str, object]) -> str:
    """A regular expression of a field: a setting, in the words of any medium; a value, if it is known."""
    if field.startswith("--"):
        name, _, value = field.removeprefix("--").partition("=")
        if value.startswith("$"):
            value = _Wording(speech).format_field(values[value[1:]], spec) if value[1:] in values else "\0"
        words = (_Wording(Speech(speech.language, medium)).setting(name, value or None) for medium in Medium)
        return f"(?:{'|'.join(re.escape(word).replace(re.escape(chr(0)), '.*?') for word in words)})"
    if field not in values:
        return ".*?"
    return re.escape(repr(values[field])) if conversion == "r" else _value_shape(values[field], spec)


def _value_shape(value: object, spec: str) -> str:
    if isinstance(value, Phrase):
        return f"(?:{_template_shape(value)})"
    if isinstance(value, tuple | list) and any(isinstance(item, Phrase) for item in value):
        between = template("sentence-separator" if spec == ";" else "list-separator", speech.language)
        return re.escape(between).join(_value_shape(item, spec) for item in value)
    shown = re.escape(_Wording(speech).format_field(value, spec))
    before = r"(?<![\d.])" if shown[:1].isdigit() else ""
    return before + shown + (r"(?!\d|\.\d)" if shown[-1:].isdigit() else "")


def says(text: object, *facts: object) -> bool:
    """Tell whether one line of a text, or one of some findings, says all these facts, in whatever order."""
    assert facts, "no fact"
    shapes = [re.compile(shape(fact)) for fact in facts]
    lines = [str(finding) for finding in text] if isinstance(text, list) else str(text).splitlines()
    return any(all(fact.search(line) for fact in shapes) for line in lines)


def advised(findings: Iterable[Finding], setting: str) -> list[str | None]:
    """The values that some findings advise a setting to have."""
    return [value for finding in findings for name, value in advice(finding) if name == setting]


def each_says(lines: str | Iterable[object], *facts: object) -> bool:
    """Tell whether there are as many lines as facts, and each says its own; tuples are several facts of a line."""
    told = lines.splitlines() if isinstance(lines, str) else list(lines)
    return len(told) == len(facts) and all(
        says(line, *(fact if isinstance(fact, tuple) else (fact,))) for line, fact in zip(told, facts, strict=True)
    )


def pattern(*facts: object) -> str:
    """A regular expression for `pytest.raises`: a line that says these facts in this order; codes anywhere behind those
    before them."""
    return ".*".join(f"(?=.*{shape(fact)})" if isinstance(fact, Phrase) else shape(fact) for fact in facts)


def facts_of(finding: Finding) -> list[object]:
    """The code of a finding, the numbers of its places (line, column, block), and its values."""
    places = [value for source in finding.source if isinstance(source, Phrase) for _, value in source.values]
    values = [value.code if isinstance(value, Phrase) else value for _, value in finding.values]
    return [finding.code, *places, *(round(value, 3) if isinstance(value, float) else value for value in values)]
