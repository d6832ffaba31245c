"""The SKG program that a translator writes, line by line (docs/spec/xy.md, section 8)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from skg.rivals.formula import SkgText, literal
from skg.rivals.plane import ExactElement, Real
from skg.rivals.statement import TextFault

#: No line of the program is longer, its number included.
WIDTH = 72
#: A statement is no longer: the line's number stands before it.
STATEMENT = WIDTH - len("9999 ")
LAST_SUBSCRIPT = 999
LAST_LINE = 9999


def too_long() -> TextFault:
    """More than SKG takes."""
    return TextFault(0, "rival-too-long")


def plain(title: str) -> str:
    """A title in the letters that SKG has."""
    return "".join(char if char.isascii() and char.isprintable() else "?" for char in title.upper())


def packed(first: str, items: Iterable[str]) -> list[str]:
    """Statements that begin with a word and list items, each no longer than a line."""
    lines: list[str] = []
    for item in items:
        if lines and len(lines[-1]) + 1 + len(item) <= STATEMENT:
            lines[-1] += f",{item}"
        else:
            lines.append(f"{first} {item}")
    return lines


@dataclass
class SkgProgram:
    """Statements, and the REMs at the head: headings, and the names that are others in SKG."""

    body: list[str] = field(default_factory=list)
    headings: list[str] = field(default_factory=list)
    renamed: list[str] = field(default_factory=list)

    def assign(self, name: str, text: SkgText | None, value: ExactElement | Real) -> None:
        """A name's expression, or where that is too long for a line (or there is none) computed numbers."""
        statement = f"{name}={text or literal(value)}"
        self.body.append(statement if len(statement) <= STATEMENT else f"{name}={literal(value)}")

    def rename(self, name: str, skg: str) -> None:
        """Say at the head what a name is in SKG."""
        words = f"{name} IS {skg}"
        if words not in self.renamed:
            self.renamed.append(words)

    def text(self) -> str:
        """The whole program."""
        lines = [f"REM {heading}"[:STATEMENT] for heading in self.headings]
        words = ""
        for renamed in self.renamed:
            if words and len("REM , ") + len(words) + len(renamed) > STATEMENT:
                lines.append(f"REM {words}")
                words = ""
            words += f"{', ' if words else ''}{renamed}"
        lines += [f"REM {words}"] if words else []
        lines += [*self.body, "END"]
        if len(lines) > LAST_LINE:
            raise too_long()
        step = 10 if len(lines) * 10 <= LAST_LINE else 1
        return "".join(f"{number * step} {line}\n" for number, line in enumerate(lines, 1))
