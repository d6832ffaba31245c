"""Catalogues without words, for `pytest --codes`: each sentence is its code in brackets, with the values by
their names."""

from __future__ import annotations

import re
import string
from gettext import NullTranslations

from skg.messages import catalogue as catalogues
from skg.messages.catalogue import LANGUAGES

#: The catalogues themselves.
_plain = catalogues.catalogue


class Coded(NullTranslations):
    """A catalogue with each sentence replaced: `[no-tab-here] contour={contour} length={length:.1f}`."""

    def __init__(self, language: str) -> None:
        super().__init__()
        self._plain = _plain(language)

    def gettext(self, message: str) -> str:
        """The code, and the values of the sentence."""
        sentence = self._plain.gettext(message)
        return message if sentence == message else coded(message, sentence)

    def ngettext(self, msgid1: str, msgid2: str, n: int) -> str:
        """The same, of one of several forms."""
        sentence = self._plain.ngettext(msgid1, msgid2, n)
        return sentence if sentence in (msgid1, msgid2) else coded(msgid1, sentence)


def coded(code: str, sentence: str) -> str:
    """A template without words. What has none, such as a comma between values, stays as it is."""
    parts = list(string.Formatter().parse(sentence))
    if not any(re.search(r"\w", before) for before, *_ in parts):
        return sentence
    words = [f"[{code}]"]
    for _, field, spec, conversion in parts:
        if field:
            value = "{" + field + (f"!{conversion}" if conversion else "") + (f":{spec}" if spec else "") + "}"
            words.append(value if field.startswith("--") else f"{field}={value}")
    return " ".join(words)


def replace() -> None:
    """Take the words out of this process's catalogues."""
    made = {language: Coded(language) for language in LANGUAGES}
    catalogues.catalogue = lambda language: made[language] if language in made else _plain(language)
