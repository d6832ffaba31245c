"""Findings as text, in the language and the words of where it is read."""

from __future__ import annotations

import os
import re
import string
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any

from skg.messages.catalogue import template
from skg.messages.finding import Finding, Phrase, written
from skg.messages.settings import KEYS, LISTS, SETTINGS, TOP
from skg.messages.severity import Severity
from skg.wording import short, shown, visible

#: An option in a template, with the value that it is advised to have.
_SETTING = re.compile(r"--(?P<name>[a-z-]+)(?:=(?P<value>.+))?")


class Medium(Enum):
    """The reader's place, which decides the words of advice: options, keys of a job file, fields of the page."""

    COMMAND = "command line"
    JOB = "job file"
    PAGE = "page"


@dataclass
class Speech:
    """The language and the medium of texts."""

    language: str = "en"
    medium: Medium = Medium.COMMAND


#: Those of this process: the command line sets them.
speech = Speech()


def text(phrase: Phrase, audience: Speech | None = None) -> str:
    """The sentence of a finding or phrase. `audience`: its language and medium, else this process's."""
    audience = audience or speech
    values = dict(phrase.values)
    if isinstance(phrase, Finding):
        values |= {"place": phrase.place} if "place" not in values else {}
    count = values.get("count")
    return _Wording(audience).vformat(template(phrase.code, audience.language, count), (), values)


def line(finding: Finding, audience: Speech | None = None) -> str:
    """A finding as a line: its source, a mark of its severity, its sentence."""
    audience = audience or speech
    sentence = text(finding, audience)
    if finding.severity is Severity.CARE:
        sentence = text(Phrase("care", text=sentence), audience)
    separator = template("source-separator", audience.language)
    sources = [visible(source) if isinstance(source, str) else text(source, audience) for source in finding.source]
    return separator.join([*sources, sentence])


def advice(phrase: Phrase) -> Iterator[tuple[str, str | None]]:
    """The settings that a finding advises, with their values."""
    values = dict(phrase.values)
    writer = _Wording(Speech("en", Medium.COMMAND))
    for _, field, spec, _ in string.Formatter().parse(template(phrase.code, "en", values.get("count"))):
        if field and (match := _SETTING.fullmatch(field)):
            yield match["name"], writer.setting_value(match["value"], spec or "", values)
    for value in values.values():
        if isinstance(value, Phrase):
            yield from advice(value)


class _Wording(string.Formatter):
    """Puts values into a template."""

    def __init__(self, audience: Speech) -> None:
        self._audience = audience
        self._values: Mapping[str, Any] = {}

    def vformat(self, format_string: str, args: Sequence[Any], kwargs: Mapping[str, Any]) -> str:
        """Return the template with the values in it."""
        self._values = kwargs
        return "".join(
            before + ("" if field is None else self._field(field, spec or "", conversion))
            for before, field, spec, conversion in self.parse(format_string)
        )

    def _field(self, field: str, spec: str, conversion: str | None) -> str:
        if match := _SETTING.fullmatch(field):
            return self.setting(match["name"], self.setting_value(match["value"], spec, self._values))
        return self.format_field(self.convert_field(self._values[field], conversion), spec)

    def setting_value(self, value: str | None, spec: str, values: Mapping[str, Any]) -> str | None:
        """The advised value of a setting: as it stands, or one of the finding's."""
        return self.format_field(values[value[1:]], spec) if value and value[0] == "$" else value

    def setting(self, name: str, value: str | None) -> str:
        """A setting as its option, its key, or the field of the page."""
        medium, language = self._audience.medium, self._audience.language
        if medium is Medium.COMMAND or name not in SETTINGS:
            return f"--{name}" + (f" {value}" if value else "")
        table, label = SETTINGS[name]
        if medium is Medium.PAGE:
            label = template(label, language)
            known = f"value-{value}"
            shown_value = template(known, language) if value else None
            code = "setting-on-page" if value else "field-on-page"
            return template(code, language).format(label=label, value=value if shown_value == known else shown_value)
        key = KEYS.get(name, name.replace("-", "_"))
        if not value:
            return key
        written = value if re.fullmatch(r"[\d.]+", value) else f'"{value}"'
        written = f"[{written}]" if key in LISTS else written
        if key in TOP:
            return f"{key} = {written}"
        return template("setting-in-job", language).format(key=key, value=written, table=table)

    def format_field(self, value: Any, format_spec: str) -> str:  # noqa: ANN401
        """Write a value: by its type, or as the template says."""
        if value is None:
            return ""
        if isinstance(value, Phrase):
            return text(value, self._audience)
        if format_spec == "xy" and not isinstance(value[0], tuple | list):
            return shown(value)
        if isinstance(value, tuple | list):
            separator = template(
                "sentence-separator" if format_spec == ";" else "list-separator", self._audience.language
            )
            return separator.join(self.format_field(item, format_spec) for item in value)
        if isinstance(value, str):
            return visible(value)
        if not format_spec and not isinstance(value, float):
            return str(value)
        if not format_spec:
            return short(value)
        return format(value, format_spec)


def data(finding: Phrase, audience: Speech | None = None) -> dict[str, Any]:
    """A finding as plain data, for other programs."""
    plain: dict[str, Any] = {"code": finding.code, "values": {name: _plain(value) for name, value in finding.values}}
    if isinstance(finding, Finding):
        plain["severity"] = finding.severity.value
        plain |= {name: value for name in ("contour", "place") if (value := getattr(finding, name)) is not None}
        plain["source"] = [_plain(source) for source in finding.source]
        plain["advice"] = [{"setting": name, "value": value} for name, value in advice(finding)]
        plain["text"] = line(finding, audience)
    return plain


def _plain(value: object) -> object:
    if isinstance(value, Phrase):
        return data(value)
    return [_plain(item) for item in value] if isinstance(value, tuple | list) else value


def language_of_system() -> str:
    """The language that the user's environment asks for, one of `LANGUAGES`."""
    for name in ("LC_ALL", "LC_MESSAGES", "LANG"):
        if value := os.environ.get(name):
            return "zh" if value.lower().startswith("zh") else "en"
    if sys.platform == "win32":
        import ctypes

        # (a language's own number is in the lower ten bits: 4 is Chinese)
        return "zh" if ctypes.windll.kernel32.GetUserDefaultUILanguage() & 0x3FF == 4 else "en"
    return "en"


written.append(lambda phrase: line(phrase) if isinstance(phrase, Finding) else text(phrase))
