"""Messages by their facts: what a test asks of a message is what it tells, not how it is worded.

A fact is a place, a number of a line or contour, a quantity, an option, a name of a file; or a noun, where nothing else
tells the message from others. It stands as a whole: 12 is not in 120, in 12.5 or in -12, `gap` not in `gape`, but in
`Gaps`. A compiled pattern is a fact too, for a number that is known to some places.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from skg.messages.finding import Finding, Phrase

#: The beginning of a line that warns and does not refuse.
CARE = "take care"


def shape(fact: object) -> str:
    """A regular expression of one fact."""
    if isinstance(fact, re.Pattern):
        return f"(?:{fact.pattern})"
    text = str(fact)
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


def says(text: object, *facts: object) -> bool:
    """Tell whether one line of a text says all these facts, in whatever order."""
    assert facts, "no fact"
    shapes = [re.compile(shape(fact)) for fact in facts]
    return any(all(fact.search(line) for fact in shapes) for line in str(text).splitlines())


def each_says(lines: str | Iterable[object], *facts: object) -> bool:
    """Tell whether there are as many lines as facts, and each says its own; tuples are several facts of a line."""
    told = lines.splitlines() if isinstance(lines, str) else list(lines)
    return len(told) == len(facts) and all(
        says(line, *(fact if isinstance(fact, tuple) else (fact,))) for line, fact in zip(told, facts, strict=True)
    )


def pattern(*facts: object) -> str:
    """A regular expression for `pytest.raises`: a line that says these facts in this order."""
    return ".*".join(map(shape, facts))


def counts_say(counts: Mapping[str, int], expected: Mapping[object, int]) -> bool:
    """Tell whether texts with a number each are those expected: facts (one, or a tuple) and the number of the one text
    that says them; what says more facts is looked for first."""
    rest = dict(counts)
    groups = [(facts if isinstance(facts, tuple) else (facts,), count) for facts, count in expected.items()]
    for facts, count in sorted(groups, key=lambda group: -len(group[0])):
        saying = [text for text in rest if says(text, *facts)]
        if len(saying) != 1 or rest.pop(saying[0]) != count:
            return False
    return not rest


def facts_of(finding: Finding) -> list[object]:
    """The code of a finding, the numbers of its places (line, column, block), and its values."""
    places = [value for source in finding.source if isinstance(source, Phrase) for _, value in source.values]
    values = [value.code if isinstance(value, Phrase) else value for _, value in finding.values]
    return [finding.code, *places, *(round(value, 3) if isinstance(value, float) else value for value in values)]
