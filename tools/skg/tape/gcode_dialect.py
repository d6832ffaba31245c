"""A dialect's own lines in a program that is read: each becomes what the reader knows, or nothing."""

from __future__ import annotations

import re
from collections.abc import Iterable

from skg.messages.finding import Finding
from skg.tape.dialect import GcodeDialect, Lines
from skg.tape.gcode_line import Findings, Misread, Modes

_NUMBER = re.compile(r"N\s*\d+\s*", re.I)
#: A program's own number, whatever it is.
_PROGRAM = re.compile(r"O\d+")
#: Lines of a stop, and of the end of a program.
_STOP, _END = "M0", "M30"


def understood(text: str, dialect: GcodeDialect) -> tuple[str, tuple[Finding, ...]]:
    """A program of a dialect without the lines that only this has, as many lines; and notes on it."""
    lines = [_NUMBER.sub("", line.strip(), count=1) for line in text.splitlines()]
    if dialect.compensation and dialect.compensation.define:
        # (between head and start)
        define = re.compile(_pattern(dialect.compensation.define))
        lines = ["" if define.fullmatch(_plain(line)) else line for line in lines]
    first = _after(lines, (*dialect.head, *dialect.start))
    last = len(lines) - _after(lines[::-1], dialect.foot[::-1])
    for index in (*range(first), *range(max(first, last), len(lines))):
        lines[index] = _known(lines[index])
    if last < len(lines):
        lines[last] = _END
    words = {_plain(line): "" for line in (*dialect.begin, *dialect.end)}
    for group in (dialect.unthread, dialect.thread, dialect.stop):
        words |= {_plain(line): words.get(_plain(line), "") for line in group[:-1]}
        words |= {_plain(line): _STOP for line in group[-1:]}
    offsets = _offsets(dialect)
    is_offset = False
    for index in range(first, max(first, last)):
        if offsets and offsets.fullmatch(_plain(lines[index])):
            is_offset, lines[index] = True, ""
        elif offsets and (leading := offsets.match(_plain(lines[index]))):
            is_offset, lines[index] = True, _plain(lines[index])[leading.end() :]
        else:
            lines[index] = words.get(_plain(lines[index]), lines[index])
    return "\n".join(lines), (Finding("offsets-in-control"),) * is_offset


def _plain(line: str) -> str:
    """A line as it is compared: without blanks, in capitals."""
    return "".join(line.split()).upper()


def _pattern(template: str) -> str:
    """The pattern of a line with fields in braces, which are numbers."""
    if _PROGRAM.fullmatch(_plain(template)):
        return _PROGRAM.pattern
    return re.sub(r"\\\{\w+\\\}", r"[-+\\d.]+", re.escape(_plain(template)))


def _after(lines: list[str], expected: Lines) -> int:
    """The number of lines that begin with those that are expected; 0 where these are not there. Empty ones count."""
    count = 0
    for line in expected:
        while count < len(lines) and not lines[count]:
            count += 1
        if count == len(lines) or not re.fullmatch(_pattern(line), _plain(lines[count])):
            return 0
        count += 1
    return count


def _known(line: str) -> str:
    """A line of a program's begin or end that says something of the path; else nothing."""
    try:
        block = Modes(Findings(), None).take(line)
    except Misread:
        return ""
    return line if block.codes else ""


def _offsets(dialect: GcodeDialect) -> re.Pattern[str] | None:
    """The lines of offsets, or their begins."""
    if not (words := dialect.compensation):
        return None
    templates: Iterable[str] = filter(None, (words.left, words.right, words.off, words.define))
    return re.compile("|".join(map(_pattern, templates)))
