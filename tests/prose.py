"""English in the values of messages, which a Chinese sentence shows as they are. Each test that makes a message looks
for it: whatever broken input one feeds, what is said of it in Chinese has names in it, and no English sentence.

A library's own words are the value `detail`, which no Chinese sentence has (test_messages.py).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from skg.messages.finding import Finding, Phrase

#: Two English words in a row are a sentence; one alone is a name: of a file, a layer, a word of a language, an option.
ENGLISH = re.compile(r"\b[A-Za-z]?[a-z]{2,} [a-z]{2,}\b")
#: Values that are sentences of the catalogues, in the language that is spoken, or click's, which are translated; and
#: the words of a command.
_RENDERED = {("care", "text"), ("wrong-usage", "what"), ("wrong-usage", "command")}
#: Values that have a library's words, and what users call their layers, contours, setups, files.
_FOREIGN = {"detail", "layer", "name", "file"}

#: What was found since somebody looked.
found: list[str] = []


def watch() -> None:
    """Look at each message that is made from now on in this process."""
    made = Phrase.__init__

    def init(self: Phrase, code: str, /, **values: object) -> None:
        made(self, code, **values)
        for name, value in values.items():
            if name not in _FOREIGN and (code, name) not in _RENDERED:
                found.extend(f"{code}, {name}: {text}" for text in _texts(value) if ENGLISH.search(text))

    placed = Finding.within

    def within(self: Finding, *source: str | Phrase) -> Finding:
        # (a file's name has a dot or its folders)
        names = [text for text in source if isinstance(text, str) and not re.search(r"[./\\]", text)]
        found.extend(f"{self.code}, in: {text}" for text in names if ENGLISH.search(text))
        return placed(self, *source)

    Phrase.__init__, Finding.within = init, within


def _texts(value: object) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, tuple | list):
        for one in value:
            yield from _texts(one)
